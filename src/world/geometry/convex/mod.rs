//! Convex polyhedra: planes, faces, edges and vertices, checked when built.
//!
//! A polyhedron grown by a radius ("true offset") is not another polyhedron: it has round edges, and none is built
//! here. Rods with a thickness compare their radius with the exact distance, [`distance_segment_convex`].
//! A point that keeps a margin is treated otherwise: its world and its verifier move the planes out by the margin. That
//! keeps corners sharp, since a path over an obstacle needs edges to go over, and forbids more than the margin there.

mod distance;
mod hull;
mod planes;
mod primitives;
mod printed;

pub use distance::{distance_segment_convex, nearest_by_edge, nearest_segment_convex};
pub use primitives::Axis;
pub use printed::{
    nearest_segment_convex_listed, nearest_segment_convex_listed_first, nearest_segment_convex_printed,
    nearest_segment_segment_literal, nearest_segment_segment_printed,
};

use super::{Aabb, Segment, Vec3};

/// The most vertices, planes or faces a polyhedron may have.
///
/// Construction tries all triples, and one bit a face must fit a `u128`: 64 vertices have at most 124 faces.
const MOST: usize = 64;

/// A bounding plane: the solid is where `normal · x <= offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// The unit vector out of the solid.
    pub normal: Vec3,
    /// How far the plane is from the origin along the normal.
    pub offset: f64,
}

impl Plane {
    /// How far `point` is in front of the plane; negative behind.
    #[inline]
    pub fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// A flat side.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// The plane it lies in.
    pub plane: Plane,
    /// Its vertices by index, counter-clockwise seen from outside.
    pub corners: Vec<usize>,
}

/// Where two faces meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// The vertices it joins, by index, the smaller first.
    pub ends: [usize; 2],
    /// The faces it parts, by index.
    pub faces: [usize; 2],
}

/// A bounded convex solid with a volume.
#[derive(Debug, Clone, PartialEq)]
pub struct Convex {
    vertices: Vec<Vec3>,
    faces: Vec<Face>,
    edges: Vec<Edge>,
    aabb: Aabb,
}

impl Convex {
    /// The corners, in the order in which they were given or found.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// The flat sides; coplanar triangles are one face.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The edges between faces, ordered by their vertices.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Edge number `edge` as a segment.
    fn side(&self, edge: usize) -> Segment {
        let [from, to] = self.edges[edge].ends.map(|end| self.vertices[end]);
        Segment::new(from, to)
    }

    /// The smallest axis-aligned box about the solid.
    pub fn aabb(&self) -> &Aabb {
        &self.aabb
    }

    /// Whether `point` is in the solid, its surface included.
    #[inline]
    pub fn contains(&self, point: &Vec3) -> bool {
        self.faces.iter().all(|face| face.plane.height(point) <= 0.0)
    }
}
