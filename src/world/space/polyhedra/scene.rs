//! Scene files: obstacles by name of their shape, or by vertices or planes; and where an arm stands among them, if one may.

use crate::geometry::{Aabb, Axis, Convex, GeometryError, Vec3};
use crate::space::{Support, SupportEntry};
use base::settings::{Accepted, Document, Faults, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;

/// Obstacles and the domain they stand in, as read.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// The obstacles, in the file's order.
    pub bodies: Vec<Convex>,
    /// Where the point may be.
    pub domain: Aabb,
    /// Where an arm stands, if the scene is one for an arm.
    pub support: Option<Support>,
}

impl Scene {
    /// The parts of a scene with an arm: the bodies, with the block under the base as the last one, and where the arm
    /// stands.
    ///
    /// # Errors
    /// A sentence if the scene does not say what is under an arm.
    pub fn with_arm(self) -> Result<(Vec<Convex>, Support), String> {
        const CM_PER_M: f64 = 100.0;
        let support = Support::declared(self.support.as_ref())?.clone();
        let mut bodies = self.bodies;
        if let Some(block) = support.pedestal() {
            let corners = block.corners().iter().map(|corner| corner * CM_PER_M).collect();
            bodies.push(Convex::from_vertices(corners).map_err(|e| e.to_string())?);
        }
        Ok((bodies, support))
    }
}

/// What a scene file may hold.
pub const SCENE_FILE: Accepted = Accepted::shape::<SceneFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    /// Its name.
    name: String,
    /// Where it is from, for the reader of the file.
    #[expect(dead_code, reason = "for the reader of the file: every scene must say where it is from")]
    source: String,
    /// The box that the point may be in.
    domain: DomainEntry,
    /// Where an arm's base stands and what is under it; without it the scene is one for points alone.
    support: Option<SupportEntry>,
    /// The obstacles.
    #[serde(default)]
    obstacle: Vec<Shape>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DomainEntry {
    /// x, y and z of its lowest corner, in centimetres.
    min: [f64; 3],
    /// x, y and z of its highest corner, in centimetres.
    max: [f64; 3],
}

#[derive(Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
enum Shape {
    /// A box along the axes.
    Box {
        /// x, y and z of its middle, in centimetres.
        center: [f64; 3],
        /// Its sides along x, y and z, in centimetres.
        size: [f64; 3],
    },
    /// A prism with a regular base.
    Prism {
        /// The direction of its axis.
        axis: Axis,
        /// x, y and z of its middle, in centimetres.
        center: [f64; 3],
        /// How far the base's corners are from the axis, in centimetres.
        radius: f64,
        /// Its length along the axis, in centimetres.
        height: f64,
        /// How many corners the base has.
        sides: usize,
        /// How far the base is turned about the axis.
        turn_rad: f64,
    },
    /// A regular octahedron.
    Octahedron {
        /// x, y and z of its middle, in centimetres.
        center: [f64; 3],
        /// How far its corners are from its middle, in centimetres.
        radius: f64,
    },
    /// A box cut in two along a diagonal.
    Wedge {
        /// x, y and z of the box's middle, in centimetres.
        center: [f64; 3],
        /// The box's sides along x, y and z, in centimetres.
        size: [f64; 3],
    },
    /// A pyramid with a square base.
    Pyramid {
        /// x, y and z of the middle of its base, in centimetres.
        base_center: [f64; 3],
        /// The side of its base, in centimetres.
        side: f64,
        /// Its height, in centimetres.
        height: f64,
    },
    /// The convex hull of points.
    Vertices {
        /// x, y and z of each point, in centimetres.
        points: Vec<[f64; 3]>,
    },
    /// All that lies behind every one of some planes.
    Planes {
        /// The planes.
        planes: Vec<PlaneEntry>,
    },
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlaneEntry {
    /// The direction out of the solid.
    normal: [f64; 3],
    /// How far the plane is from the origin along the normal, in lengths of the normal.
    offset: f64,
}

impl Shape {
    fn solid(&self) -> Result<Convex, GeometryError> {
        match self {
            Self::Box { center, size } => Convex::cuboid((*center).into(), (*size).into()),
            Self::Prism { axis, center, radius, height, sides, turn_rad } => {
                Convex::prism(*axis, (*center).into(), *radius, *height, *sides, *turn_rad)
            }
            Self::Octahedron { center, radius } => Convex::octahedron((*center).into(), *radius),
            Self::Wedge { center, size } => Convex::wedge((*center).into(), (*size).into()),
            Self::Pyramid { base_center, side, height } => {
                Convex::pyramid((*base_center).into(), *side, *height)
            }
            Self::Vertices { points } => {
                Convex::from_vertices(points.iter().map(|point| Vec3::from(*point)).collect())
            }
            Self::Planes { planes } => {
                let planes: Vec<(Vec3, f64)> =
                    planes.iter().map(|plane| (plane.normal.into(), plane.offset)).collect();
                Convex::from_planes(&planes)
            }
        }
    }
}

/// The scene in the file at `path`.
///
/// # Errors
/// A [`SettingsError`] with line and column for what is not TOML, not known or missing, and for an obstacle that
/// is not convex, unbounded, flat or has a plane twice.
pub fn read_scene(path: &Path) -> Result<Scene, SettingsError> {
    parse_scene(&*Document::open(path)?)
}

/// The scene that `document` describes.
///
/// # Errors
/// As [`read_scene`], but for a file that cannot be read.
pub fn parse_scene(document: &Document) -> Result<Scene, SettingsError> {
    let file: SceneFile = document.read()?;
    let mut faults = Faults::default();
    let solid = |(index, entry): (usize, &Shape)| {
        let wrong = |e: GeometryError| {
            document.error_at(&format!("obstacle.{index}.{}", e.place("points")), e.to_string())
        };
        entry.solid().map_err(wrong)
    };
    let support = |entry: &SupportEntry| {
        entry.support().map_err(|(key, message)| document.error_at(&format!("support.{key}"), message))
    };
    let bodies = faults.keep_each(file.obstacle.iter().enumerate().map(solid));
    let support = faults.keep(file.support.as_ref().map(support).transpose()).flatten();
    let DomainEntry { min, max } = file.domain;
    let turned = min.iter().zip(&max).enumerate().filter(|(_, (low, high))| low >= high);
    for (axis, (low, high)) in turned {
        let message = format!("`max[{axis}]` is {high}; a number above `min[{axis}]`, {low}, is accepted");
        faults.add(document.error_at(&format!("domain.max.{axis}"), message));
    }
    let domain = Aabb { min: min.into(), max: max.into() };
    faults.or(Some(Scene { support, name: file.name, bodies, domain }))
}
