//! Scene files: obstacles by name of their shape, or by vertices or planes.

use crate::geometry::{Aabb, Axis, Convex, GeometryError, Vec3};
use base::settings::{Accepted, Document, SettingsError, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;

/// Obstacles and the domain they stand in, as read.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// The obstacles, in the file's order.
    pub bodies: Vec<Convex>,
    /// Where the point may be.
    pub domain: Aabb,
}

/// What a scene file may hold.
pub const SCENE_FILE: Accepted = Accepted::of::<SceneFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    name: String,
    #[expect(dead_code, reason = "for the reader of the file: every scene must say where it is from")]
    source: String,
    domain: DomainEntry,
    #[serde(default)]
    obstacle: Vec<Spanned<Shape>>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DomainEntry {
    min: [f64; 3],
    max: [f64; 3],
}

#[derive(Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
enum Shape {
    Box { center: [f64; 3], size: [f64; 3] },
    Prism { axis: AxisName, center: [f64; 3], radius: f64, height: f64, sides: usize, turn_rad: f64 },
    Octahedron { center: [f64; 3], radius: f64 },
    Wedge { center: [f64; 3], size: [f64; 3] },
    Pyramid { base_center: [f64; 3], side: f64, height: f64 },
    Vertices { points: Vec<[f64; 3]> },
    Planes { planes: Vec<PlaneEntry> },
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlaneEntry {
    normal: [f64; 3],
    offset: f64,
}

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum AxisName {
    X,
    Y,
    Z,
}

impl From<AxisName> for Axis {
    fn from(name: AxisName) -> Self {
        match name {
            AxisName::X => Self::X,
            AxisName::Y => Self::Y,
            AxisName::Z => Self::Z,
        }
    }
}

impl Shape {
    fn solid(&self) -> Result<Convex, GeometryError> {
        match self {
            Self::Box { center, size } => Convex::cuboid((*center).into(), (*size).into()),
            Self::Prism { axis, center, radius, height, sides, turn_rad } => {
                Convex::prism((*axis).into(), (*center).into(), *radius, *height, *sides, *turn_rad)
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
    scene(&Document::open(path)?)
}

pub(super) fn scene(document: &Arc<Document>) -> Result<Scene, SettingsError> {
    let file: SceneFile = document.read()?;
    let solid = |entry: &Spanned<Shape>| {
        entry.get_ref().solid().map_err(|e| document.error(entry.span(), e.to_string()))
    };
    Ok(Scene {
        name: file.name,
        bodies: file.obstacle.iter().map(solid).collect::<Result<_, _>>()?,
        domain: Aabb { min: file.domain.min.into(), max: file.domain.max.into() },
    })
}
