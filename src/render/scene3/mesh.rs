//! Surfaces as flat faces, and what of them a camera sees.

use super::order::{Item, Look, Plane};
use super::{Camera, Paint, Vec3, along, cross, dot, sub, unit};
use crate::render::style::{BLACK, Rgb, Stroke, WHITE};
use std::collections::BTreeMap;

/// Facets around a capsule.
const SIDES: usize = 8;
/// Rings of facets on each of its caps.
const RINGS: usize = 2;
/// Faces that meet at an angle whose cosine is below this are parted by an outline.
const SHARP_COS: f64 = 0.6;

/// A convex solid's surface, or one flat sheet.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub vertices: Vec<Vec3>,
    /// Corners counter-clockwise seen from outside.
    faces: Vec<Vec<usize>>,
    two_sided: bool,
    paint: Paint,
}

/// Normal of a face by Newell's sum, which does not mind collinear corners.
fn normal(corners: &[Vec3]) -> Vec3 {
    let mut sum = [0.0; 3];
    for (index, &a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        sum = along(sum, cross(sub(a, corners[0]), sub(b, corners[0])), 1.0);
    }
    unit(sum)
}

impl Mesh {
    pub fn convex(vertices: Vec<Vec3>, mut faces: Vec<Vec<usize>>, paint: Paint) -> Self {
        let mut middle = [0.0; 3];
        for &vertex in &vertices {
            middle = along(middle, vertex, 1.0 / vertices.len() as f64);
        }
        for face in &mut faces {
            let corners: Vec<Vec3> = face.iter().map(|&index| vertices[index]).collect();
            if dot(normal(&corners), sub(corners[0], middle)) < 0.0 {
                face.reverse();
            }
        }
        Self { vertices, faces, two_sided: false, paint }
    }

    pub fn sheet(corners: Vec<Vec3>, paint: Paint) -> Self {
        let faces = vec![(0..corners.len()).collect()];
        Self { vertices: corners, faces, two_sided: true, paint }
    }

    pub fn capsule(from: Vec3, to: Vec3, radius: f64, paint: Paint) -> Self {
        let span = sub(to, from);
        let axis = if dot(span, span) > 0.0 { unit(span) } else { [0.0, 0.0, 1.0] };
        let aside = if axis[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
        let right = unit(cross(axis, aside));
        let up = cross(axis, unit(cross(axis, aside)));
        let quarter = std::f64::consts::FRAC_PI_2;
        let latitudes = (1..=RINGS).map(|ring| (from, -quarter + quarter * ring as f64 / RINGS as f64));
        let latitudes = latitudes.chain((0..RINGS).map(|ring| (to, quarter * ring as f64 / RINGS as f64)));
        let mut vertices = vec![along(from, axis, -radius)];
        for (centre, latitude) in latitudes {
            let (height, reach) = libm::sincos(latitude);
            for side in 0..SIDES {
                let (sine, cosine) = libm::sincos(std::f64::consts::TAU * side as f64 / SIDES as f64);
                let outward = along(along([0.0; 3], right, cosine * reach), up, sine * reach);
                vertices.push(along(along(centre, outward, radius), axis, height * radius));
            }
        }
        vertices.push(along(to, axis, radius));
        Self::convex(vertices, capsule_faces(), paint)
    }

    fn corners(&self, face: &[usize]) -> Vec<Vec3> {
        face.iter().map(|&index| self.vertices[index]).collect()
    }

    /// Faces that look at the camera, then the outlines that part them; all belong to `solid`.
    pub fn visible(&self, solid: usize, camera: &Camera) -> Vec<Item> {
        let mut items = Vec::new();
        let mut fronts = vec![None; self.faces.len()];
        for (index, face) in self.faces.iter().enumerate() {
            let mut corners = self.corners(face);
            let mut outward = normal(&corners);
            let towards = camera.axes()[2];
            if dot(outward, towards) < 0.0 && self.two_sided {
                corners.reverse();
                outward = outward.map(|value| -value);
            }
            if dot(outward, towards) > 1e-9 * dot(towards, towards).sqrt() {
                fronts[index] = Some(outward);
                let color = lit(self.paint.color, outward, camera);
                let plane = Plane { normal: outward, offset: dot(outward, corners[0]) };
                items.push(Item {
                    solid,
                    points: corners,
                    look: Look::Face(plane, color, self.paint.opacity),
                });
            }
        }
        if self.paint.outlined {
            items.extend(self.outlines(solid, &fronts));
        }
        items
    }

    fn outlines(&self, solid: usize, fronts: &[Option<Vec3>]) -> Vec<Item> {
        let mut edges: BTreeMap<(usize, usize), Vec<Vec3>> = BTreeMap::new();
        for (face, front) in self.faces.iter().zip(fronts) {
            let Some(front) = front else { continue };
            for (index, &a) in face.iter().enumerate() {
                let b = face[(index + 1) % face.len()];
                edges.entry((a.min(b), a.max(b))).or_default().push(*front);
            }
        }
        let stroke = Stroke::solid(self.paint.color.mixed(BLACK, 0.55), 0.4);
        let sharp = |normals: &[Vec3]| normals.len() < 2 || dot(normals[0], normals[1]) < SHARP_COS;
        edges
            .into_iter()
            .filter(|(_, normals)| sharp(normals))
            .map(|((a, b), _)| {
                let points = vec![self.vertices[a], self.vertices[b]];
                Item { solid, points, look: Look::Line(stroke) }
            })
            .collect()
    }
}

fn capsule_faces() -> Vec<Vec<usize>> {
    let rings = 2 * RINGS;
    let last = 2 * RINGS * SIDES + 1;
    let at = |ring: usize, side: usize| 1 + ring * SIDES + side % SIDES;
    let mut faces = Vec::new();
    for side in 0..SIDES {
        faces.push(vec![0, at(0, side + 1), at(0, side)]);
        for ring in 0..rings - 1 {
            faces.push(vec![at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)]);
        }
        faces.push(vec![at(rings - 1, side), at(rings - 1, side + 1), last]);
    }
    faces
}

/// The colour of a face under a light above the camera's left shoulder.
fn lit(color: Rgb, outward: Vec3, camera: &Camera) -> Rgb {
    let [right, up, back] = camera.axes();
    let light = unit(along(along(along([0.0; 3], right, -0.45), up, 0.75), back, 0.7));
    // In steps, so that most neighbours share a colour and one path of the SVG.
    let share = (dot(outward, light).max(0.0) * 12.0).round() / 12.0;
    if share > 0.8 {
        color.mixed(WHITE, (share - 0.8) * 1.2)
    } else {
        color.mixed(BLACK, (0.8 - share) * 0.48)
    }
}
