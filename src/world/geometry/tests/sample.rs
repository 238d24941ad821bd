//! Drawn pairs, a written share of them parallel, touching or piercing.

use crate::geometry::{Convex, Edge, Frame, OrientedBox, Segment, Vec3};
use base::seed::Stream;
use rand::RngExt as _;
use std::f64::consts::TAU;

pub fn range(stream: &mut Stream, low: f64, high: f64) -> f64 {
    stream.random_range(low..high)
}

/// A point in the cube of half side 2.
pub fn point(stream: &mut Stream) -> Vec3 {
    Vec3::from_fn(|_, _| range(stream, -2.0, 2.0))
}

pub fn direction(stream: &mut Stream) -> Vec3 {
    loop {
        let v = Vec3::from_fn(|_, _| range(stream, -1.0, 1.0));
        if (0.1..1.0).contains(&v.norm()) {
            return v.normalize();
        }
    }
}

pub fn frame(stream: &mut Stream) -> Frame {
    let axis = direction(stream);
    Frame::at(point(stream)) * Frame::turned(&axis, range(stream, 0.0, TAU))
}

pub fn oriented_box(stream: &mut Stream) -> OrientedBox {
    let size = Vec3::from_fn(|_, _| range(stream, 0.1, 2.0));
    OrientedBox::new(frame(stream), size).unwrap()
}

/// A random polyhedron: its corners are on an ellipsoid, hence all on the hull.
///
/// No two faces are within 0.01 rad of one plane: there the reference, which knows corners only as crossings
/// of planes, loses digits that the fast distance keeps.
pub fn polyhedron(stream: &mut Stream) -> Convex {
    loop {
        let frame = frame(stream);
        let radii = Vec3::from_fn(|_, _| range(stream, 0.2, 1.5));
        let count = stream.random_range(4..9);
        let corners = (0..count).map(|_| frame.point(&direction(stream).component_mul(&radii))).collect();
        let solid = Convex::from_vertices(corners).unwrap();
        let normal = |face: usize| solid.faces()[face].plane.normal;
        let is_flat = |edge: &Edge| normal(edge.faces[0]).cross(&normal(edge.faces[1])).norm() < 0.01;
        if !solid.edges().iter().any(is_flat) {
            return solid;
        }
    }
}

/// A pair of segments: one in five parallel (half of those off by 1e-8 rad), one in ten crossing or meeting
/// in a common point, the rest anyhow, a few of no length.
pub fn segment_pair(stream: &mut Stream) -> (Segment, Segment) {
    let p = Segment::new(point(stream), point(stream));
    let d = p.b - p.a;
    let q = match stream.random_range(0..20) {
        0 | 1 => parallel(stream, &p, Vec3::zeros()),
        2 | 3 => {
            let off = direction(stream) * 1e-8;
            parallel(stream, &p, off)
        }
        4 | 5 => {
            let meet = p.at(range(stream, 0.0, 1.0));
            let along = direction(stream);
            let before = if stream.random_range(0..2) == 0 { 0.0 } else { range(stream, 0.0, 1.0) };
            Segment::new(meet - along * before, meet + along * range(stream, 0.0, 1.0))
        }
        6 => {
            // Nearly parallel and crossing: where the textbook determinant loses its digits.
            let meet = p.at(range(stream, 0.0, 1.0));
            let along = (d + direction(stream) * 1e-7) * range(stream, 0.1, 1.0);
            Segment::new(meet - along, meet + along)
        }
        7 => {
            let q = point(stream);
            Segment::new(q, q)
        }
        _ => Segment::new(point(stream), point(stream)),
    };
    if stream.random_range(0..40) == 0 { (Segment::new(p.a, p.a), q) } else { (p, q) }
}

fn parallel(stream: &mut Stream, p: &Segment, off: Vec3) -> Segment {
    let d = p.b - p.a + off;
    let start = p.a + d * range(stream, -1.0, 1.0) + direction(stream) * range(stream, 0.0, 1.0);
    Segment::new(start, start + d * range(stream, -1.5, 1.5))
}

/// The corners of each face of a solid, with the face's outward normal.
pub type Faces = Vec<(Vec3, Vec<Vec3>)>;

/// A segment beside a solid with these faces: a fifth parallel to a side, a tenth touching, a tenth
/// piercing, the rest anyhow.
pub fn segment_beside(stream: &mut Stream, faces: &Faces) -> Segment {
    let (normal, corners) = &faces[stream.random_range(0..faces.len())];
    let along = corners[1] - corners[0];
    match stream.random_range(0..10) {
        0 | 1 => {
            let start = point(stream);
            Segment::new(start, start + along * range(stream, 0.1, 3.0))
        }
        2 => {
            // On the face, an edge or a corner, and away from the solid.
            let weights: Vec<f64> =
                corners.iter().map(|_| range(stream, -0.7, 1.0).max(0.0) + 1e-300).collect();
            let sum: f64 = weights.iter().sum();
            let on: Vec3 = corners.iter().zip(&weights).map(|(c, w)| c * (w / sum)).sum();
            let away = direction(stream);
            let away = away - normal * (away.dot(normal).min(0.0));
            Segment::new(on, on + away)
        }
        3 => {
            let all: Vec<&Vec3> = faces.iter().flat_map(|(_, corners)| corners).collect();
            let middle = all.iter().copied().sum::<Vec3>() / all.len() as f64;
            let through = direction(stream);
            Segment::new(
                middle - through * range(stream, 0.0, 4.0),
                middle + through * range(stream, 0.0, 4.0),
            )
        }
        _ => Segment::new(point(stream), point(stream)),
    }
}

pub fn box_planes(shape: &OrientedBox) -> Vec<(Vec3, f64)> {
    let frame = shape.frame();
    (0..6)
        .map(|i| {
            let normal = frame.axis(i / 2) * if i % 2 == 0 { 1.0 } else { -1.0 };
            (normal, normal.dot(&frame.origin) + shape.half()[i / 2])
        })
        .collect()
}

pub fn box_faces(shape: &OrientedBox) -> Faces {
    let corners = shape.corners();
    let face = |(normal, offset): (Vec3, f64)| {
        let on = corners.iter().filter(|c| (normal.dot(c) - offset).abs() < 1e-9).copied().collect();
        (normal, on)
    };
    box_planes(shape).into_iter().map(face).collect()
}

pub fn convex_planes(solid: &Convex) -> Vec<(Vec3, f64)> {
    solid.faces().iter().map(|face| (face.plane.normal, face.plane.offset)).collect()
}

pub fn convex_faces(solid: &Convex) -> Faces {
    let corners = |face: &[usize]| face.iter().map(|&c| solid.vertices()[c]).collect();
    solid.faces().iter().map(|face| (face.plane.normal, corners(&face.corners))).collect()
}
