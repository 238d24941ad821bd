//! Solids seen from a camera: boxes, convex polyhedra, capsules, sheets and chains, exactly ordered.
//!
//! A right-handed world with z up. Faces are shaded flat under a light that stands with the camera, and
//! outlined in a darker tone where two faces meet sharply or the solid ends. What lies behind is drawn
//! first: faces are cut where that is the only way to get it right. Lengths are the caller's; the
//! scale bar names their unit.

mod mark;
mod mesh;
mod order;

pub use mark::{ScaleBar, SceneMark, panel};

use super::chart::axis::bounds;
use super::style::{Rgb, Stroke};
use mesh::Mesh;

/// A point or direction in the world.
pub type Vec3 = [f64; 3];

pub(super) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn along(a: Vec3, direction: Vec3, length: f64) -> Vec3 {
    [a[0] + length * direction[0], a[1] + length * direction[1], a[2] + length * direction[2]]
}

pub(super) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a` at length one; the zero vector stays as it is.
pub(super) fn unit(a: Vec3) -> Vec3 {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|value| value / length) } else { a }
}

/// The corners of the box between two opposite ones: x changes first, z last.
pub fn box_corners(low: Vec3, high: Vec3) -> Vec<Vec3> {
    let corner =
        |index: usize| [0, 1, 2].map(|axis| if index >> axis & 1 == 0 { low[axis] } else { high[axis] });
    (0..8).map(corner).collect()
}

/// From where, and how, a scene is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Direction from the scene to the camera: angle from +x towards +y.
    pub azimuth_deg: f64,
    /// Direction from the scene to the camera: angle above the horizon, in (-90, 90).
    pub elevation_deg: f64,
}

impl Camera {
    /// A parallel view, in which a scale bar is true everywhere.
    pub const fn parallel(azimuth_deg: f64, elevation_deg: f64) -> Self {
        Self { azimuth_deg, elevation_deg }
    }

    /// Unit vectors right, up and towards the eye.
    fn axes(&self) -> [Vec3; 3] {
        let (sin_a, cos_a) = libm::sincos(self.azimuth_deg.to_radians());
        let (sin_e, cos_e) = libm::sincos(self.elevation_deg.to_radians());
        let back = [cos_e * cos_a, cos_e * sin_a, sin_e];
        let right = [-sin_a, cos_a, 0.0];
        [right, cross(back, right), back]
    }
}

/// The look of a solid's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    /// Colour under full light.
    pub color: Rgb,
    /// 1 hides what lies behind.
    pub opacity: f64,
    /// Whether edges and silhouette are outlined.
    pub outlined: bool,
}

impl Paint {
    /// An opaque outlined surface.
    pub const fn solid(color: Rgb) -> Self {
        Self { color, opacity: 1.0, outlined: true }
    }

    /// An opaque surface without outlines, for what is too small for them.
    pub const fn plain(color: Rgb) -> Self {
        Self { color, opacity: 1.0, outlined: false }
    }

    /// An outlined surface that lets what lies behind show through.
    pub const fn sheer(color: Rgb, opacity: f64) -> Self {
        Self { color, opacity, outlined: true }
    }
}

/// A chain of straight pieces in the world.
#[derive(Clone, Debug)]
struct Chain {
    points: Vec<Vec3>,
    stroke: Stroke,
}

/// A text that names a point; it is drawn over everything.
#[derive(Clone, Debug)]
struct Tag {
    at: Vec3,
    text: String,
    /// Whether the point itself is marked, with the text beside it; else the text stands on the point.
    dotted: bool,
}

/// What there is to see.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    meshes: Vec<Mesh>,
    chains: Vec<Chain>,
    overlays: Vec<Chain>,
    tags: Vec<Tag>,
}

impl Scene {
    /// Adds a box by its corners, in the order of [`box_corners`]; it may be turned.
    pub fn cuboid(&mut self, corners: Vec<Vec3>, paint: Paint) {
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        self.polyhedron(corners, faces.map(|face| face.to_vec()).to_vec(), paint);
    }

    /// Adds a convex polyhedron: corners of each face in order around it, in either sense.
    ///
    /// A solid that is not convex must be added in convex parts, or its order is not promised.
    pub fn polyhedron(&mut self, vertices: Vec<Vec3>, faces: Vec<Vec<usize>>, paint: Paint) {
        self.meshes.push(Mesh::convex(vertices, faces, paint));
    }

    /// Adds a flat convex outline seen from both sides: a floor, a wall, a swept area.
    pub fn sheet(&mut self, corners: Vec<Vec3>, paint: Paint) {
        self.meshes.push(Mesh::sheet(corners, paint));
    }

    /// Adds the set of points within `radius` of the segment from `from` to `to`; a ball if they coincide.
    pub fn capsule(&mut self, from: Vec3, to: Vec3, radius: f64, paint: Paint) {
        self.meshes.push(Mesh::capsule(from, to, radius, paint));
    }

    /// Adds a chain of straight pieces, hidden where something stands before it.
    pub fn polyline(&mut self, points: Vec<Vec3>, stroke: Stroke) {
        self.chains.push(Chain { points, stroke });
    }

    /// Adds a chain of straight pieces that is drawn over everything, to be seen where another is hidden.
    pub fn overlay(&mut self, points: Vec<Vec3>, stroke: Stroke) {
        self.overlays.push(Chain { points, stroke });
    }

    /// Names a point; the text is never hidden.
    pub fn tag(&mut self, at: Vec3, text: impl Into<String>) {
        self.tags.push(Tag { at, text: text.into(), dotted: true });
    }

    /// Writes a text across a point; it is never hidden.
    pub fn write(&mut self, at: Vec3, text: impl Into<String>) {
        self.tags.push(Tag { at, text: text.into(), dotted: false });
    }

    /// All points that the picture must hold.
    fn extent(&self) -> impl Iterator<Item = Vec3> + '_ {
        let solid = self.meshes.iter().flat_map(|mesh| mesh.vertices.iter().copied());
        solid.chain(self.chains.iter().flat_map(|chain| chain.points.iter().copied()))
    }

    /// Middle and radius of the box around everything; the unit ball if there is nothing.
    fn ball(&self) -> (Vec3, f64) {
        let [low, high] = bounds(self.extent());
        if low[0] > high[0] {
            return ([0.0; 3], 1.0);
        }
        let half = sub(high, low).map(|value| value / 2.0);
        (along(low, half, 1.0), dot(half, half).sqrt().max(f64::MIN_POSITIVE))
    }
}

#[cfg(test)]
mod tests;
