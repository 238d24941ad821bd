//! A polyhedron from its vertices: every triple whose plane has all vertices behind it spans a face.
//!
//! Trying all triples is slow beside an incremental hull and has no order-dependent state to go wrong; 64
//! vertices, the most accepted, take milliseconds once per scene.

use super::{Convex, Edge, Face, MOST, Plane};
use crate::geometry::{
    Aabb, Vec3,
    error::{GeometryError, finite_point},
};
use std::collections::BTreeMap;

/// A vertex this close to a plane, as a share of the solid's extent, lies in it.
const IN_PLANE: f64 = 1e-10;

impl Convex {
    /// The solid whose corners are exactly `vertices`, 4 to 64 in any order.
    ///
    /// # Errors
    /// [`GeometryError::Count`], [`GeometryError::NotFinite`], [`GeometryError::DuplicateVertex`],
    /// [`GeometryError::Flat`], or [`GeometryError::NotConvex`] if a vertex is no corner of the hull of all.
    pub fn from_vertices(vertices: Vec<Vec3>) -> Result<Self, GeometryError> {
        let found = vertices.len();
        if !(4..=MOST).contains(&found) {
            return Err(GeometryError::Count { what: "vertices", found, least: 4, most: MOST });
        }
        for (i, vertex) in vertices.iter().enumerate() {
            finite_point(&format!("vertex {i}"), vertex.as_slice())?;
        }
        let aabb = Aabb::of_points(&vertices);
        let tolerance = IN_PLANE * (aabb.max - aabb.min).norm();
        refuse_duplicates(&vertices, tolerance)?;
        let faces = faces(&vertices, tolerance);
        if faces.len() < 4 {
            return Err(GeometryError::Flat { found });
        }
        if let Some(vertex) = (0..found).find(|v| !faces.iter().any(|face| face.corners.contains(v))) {
            return Err(GeometryError::NotConvex { vertex });
        }
        let edges = edges(&faces);
        Ok(Self { vertices, faces, edges, aabb })
    }
}

fn refuse_duplicates(vertices: &[Vec3], tolerance: f64) -> Result<(), GeometryError> {
    for (first, a) in vertices.iter().enumerate() {
        for (second, b) in vertices.iter().enumerate().skip(first + 1) {
            if (a - b).norm() <= tolerance {
                return Err(GeometryError::DuplicateVertex { first, second });
            }
        }
    }
    Ok(())
}

/// Every face once: it is kept at the first triple of its corners.
fn faces(vertices: &[Vec3], tolerance: f64) -> Vec<Face> {
    let mut faces: Vec<Face> = Vec::new();
    for i in 0..vertices.len() {
        for j in i + 1..vertices.len() {
            for k in j + 1..vertices.len() {
                let known = |face: &Face| [i, j, k].iter().all(|v| face.corners.contains(v));
                if faces.iter().any(known) {
                    continue;
                }
                if let Some(plane) = supporting_plane(vertices, [i, j, k], tolerance)
                    && let Some(face) = face_in(vertices, plane, tolerance)
                {
                    faces.push(face);
                }
            }
        }
    }
    faces
}

/// The plane through three vertices, facing away from all others; `None` if they are on a line, if there
/// are vertices on both sides, or if all vertices are in it.
fn supporting_plane(vertices: &[Vec3], [i, j, k]: [usize; 3], tolerance: f64) -> Option<Plane> {
    let (a, b) = (vertices[j] - vertices[i], vertices[k] - vertices[i]);
    let normal = a.cross(&b);
    if normal.norm() <= tolerance * a.norm().max(b.norm()) {
        return None;
    }
    let normal = normal.normalize();
    let heights = || vertices.iter().map(|v| normal.dot(&(v - vertices[i])));
    let (low, high) = (heights().fold(0.0, f64::min), heights().fold(0.0, f64::max));
    let sign = match (low < -tolerance, high > tolerance) {
        (true, false) => 1.0,
        (false, true) => -1.0,
        _ => return None,
    };
    let normal = normal * sign;
    // The offset is the furthest vertex, so that no vertex is in front of its own face.
    let offset = vertices.iter().map(|v| normal.dot(v)).fold(f64::NEG_INFINITY, f64::max);
    Some(Plane { normal, offset })
}

/// The face that the vertices in `plane` span; vertices on its sides are no corners.
fn face_in(vertices: &[Vec3], plane: Plane, tolerance: f64) -> Option<Face> {
    let inside: Vec<usize> =
        (0..vertices.len()).filter(|&v| plane.height(&vertices[v]) >= -2.0 * tolerance).collect();
    let sum: Vec3 = inside.iter().map(|&v| vertices[v]).sum();
    let middle = sum / inside.len() as f64;
    let x = (vertices[inside[0]] - middle).normalize();
    let y = plane.normal.cross(&x);
    let angle = |v: usize| {
        let r = vertices[v] - middle;
        libm::atan2(r.dot(&y), r.dot(&x))
    };
    let mut ring = inside;
    ring.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    let n = ring.len();
    let is_corner = |at: usize| {
        let before = vertices[ring[(at + n - 1) % n]];
        let here = vertices[ring[at]];
        let after = vertices[ring[(at + 1) % n]];
        let into = here - before;
        let out = after - here;
        into.cross(&out).norm() > tolerance * into.norm().max(out.norm())
    };
    let corners: Vec<usize> = (0..n).filter(|&at| is_corner(at)).map(|at| ring[at]).collect();
    (corners.len() >= 3).then_some(Face { plane, corners })
}

fn edges(faces: &[Face]) -> Vec<Edge> {
    let mut sides: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (index, face) in faces.iter().enumerate() {
        for (at, &a) in face.corners.iter().enumerate() {
            let b = face.corners[(at + 1) % face.corners.len()];
            sides.entry([a.min(b), a.max(b)]).or_default().push(index);
        }
    }
    sides.into_iter().map(|(ends, faces)| Edge { ends, faces: [faces[0], faces[faces.len() - 1]] }).collect()
}
