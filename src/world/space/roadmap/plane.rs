//! A particle among convex polygons in a rectangle: the simplest place for a roadmap.

use crate::geometry::Vec2;
use crate::geometry::planar::{
    ConvexPolygon, Segment2, Touch, intersects_point_polygon, intersects_segment_polygon,
};
use base::text::listed;

/// Samples, steps and ends lie on this raster, on which the verifier is exact.
pub const RASTER_MM: f64 = 1.0 / 16.0;

/// Polygons in the rectangle from the origin to `size_mm`; touching a polygon is contact.
#[derive(Debug, Clone)]
pub struct PlaneMap {
    size_mm: [f64; 2],
    polygons: Vec<ConvexPolygon>,
}

impl PlaneMap {
    /// The map with these obstacles.
    pub fn new(size_mm: [f64; 2], polygons: Vec<ConvexPolygon>) -> Self {
        Self { size_mm, polygons }
    }

    /// Width and height.
    pub fn size_mm(&self) -> [f64; 2] {
        self.size_mm
    }

    /// The obstacles.
    pub fn polygons(&self) -> &[ConvexPolygon] {
        &self.polygons
    }

    /// Why the particle cannot be at `point`; `None` if it can.
    pub fn refusal(&self, point: [f64; 2]) -> Option<String> {
        let [width, height] = self.size_mm;
        if !(0.0..=width).contains(&point[0]) || !(0.0..=height).contains(&point[1]) {
            return Some(format!(
                "{point} is outside the map of {width} × {height} mm",
                point = listed(point)
            ));
        }
        let at = Vec2::from(point);
        let hit = self.polygons.iter().position(|p| intersects_point_polygon(&at, p, Touch::Contact));
        hit.map(|index| format!("{point} is in obstacle {}", index + 1, point = listed(point)))
    }

    /// Whether the straight way between two points meets no obstacle.
    pub fn sees(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let way = Segment2::new(Vec2::from(from), Vec2::from(to));
        !self.polygons.iter().any(|polygon| intersects_segment_polygon(&way, polygon, Touch::Contact))
    }
}
