//! Obstacles in the plane.

use crate::geometry::Vec2;
use crate::geometry::planar::{
    Circle, ConvexPolygon, Segment2, Touch, distance_segment_circle, distance_segment_polygon,
    intersects_point_circle, intersects_point_polygon, intersects_segment_circle, intersects_segment_polygon,
};

/// A solid that does not move.
#[derive(Debug, Clone, PartialEq)]
pub enum Obstacle {
    /// A disc.
    Circle(Circle),
    /// A convex polygon.
    Polygon(ConvexPolygon),
}

impl Obstacle {
    /// Whether `point` is in contact with it.
    pub fn holds(&self, point: &Vec2, touch: Touch) -> bool {
        match self {
            Self::Circle(circle) => intersects_point_circle(point, circle, touch),
            Self::Polygon(polygon) => intersects_point_polygon(point, polygon, touch),
        }
    }

    /// Whether `link` is in contact with it.
    pub fn meets(&self, link: &Segment2, touch: Touch) -> bool {
        match self {
            Self::Circle(circle) => intersects_segment_circle(link, circle, touch),
            Self::Polygon(polygon) => intersects_segment_polygon(link, polygon, touch),
        }
    }

    /// Its distance from `link`; 0 in contact.
    pub fn distance(&self, link: &Segment2) -> f64 {
        match self {
            Self::Circle(circle) => distance_segment_circle(link, circle),
            Self::Polygon(polygon) => distance_segment_polygon(link, polygon),
        }
    }

    /// Its outline as points, counter-clockwise; a disc's is drawn with 72 corners.
    pub fn outline(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Polygon(polygon) => polygon.vertices().iter().map(|v| (*v).into()).collect(),
            Self::Circle(Circle { center, radius }) => (0..72)
                .map(|k| {
                    let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 72.0);
                    [center.x + radius * c, center.y + radius * s]
                })
                .collect(),
        }
    }
}
