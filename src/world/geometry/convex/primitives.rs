//! Named polyhedra.

use super::Convex;
use crate::geometry::{
    Vec3,
    error::{GeometryError, finite, positive},
};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// A coordinate axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along z.
    Z,
}

impl Axis {
    /// The point at `along` this axis and at `(u, v)` along the two that follow it cyclically.
    fn point(self, along: f64, u: f64, v: f64) -> Vec3 {
        match self {
            Self::X => Vec3::new(along, u, v),
            Self::Y => Vec3::new(v, along, u),
            Self::Z => Vec3::new(u, v, along),
        }
    }
}

impl Convex {
    /// The axis-aligned box about `center` with sides `size`.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] or [`GeometryError::NotPositive`]; also for the shapes below.
    pub fn cuboid(center: Vec3, size: Vec3) -> Result<Self, GeometryError> {
        let half = half_size(&size)?;
        let side = |i: usize, bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Self::from_vertices(
            (0..8)
                .map(|i| center + half.component_mul(&Vec3::new(side(i, 0), side(i, 1), side(i, 2))))
                .collect(),
        )
    }

    /// The prism about `center` along `axis`, `height` long, over a regular polygon of `sides` (3 to 32)
    /// corners on a circle of `radius`; the first corner is `turn_rad` from the next axis (y for x).
    ///
    /// # Errors
    /// As for [`cuboid`](Self::cuboid), and [`GeometryError::Count`] for the sides.
    pub fn prism(
        axis: Axis,
        center: Vec3,
        radius: f64,
        height: f64,
        sides: usize,
        turn_rad: f64,
    ) -> Result<Self, GeometryError> {
        positive("the prism's radius", radius)?;
        positive("the prism's height", height)?;
        finite("the prism's turn", turn_rad)?;
        if !(3..=32).contains(&sides) {
            return Err(GeometryError::Count { what: "sides", found: sides, least: 3, most: 32 });
        }
        let corner = |k: usize, along: f64| {
            let (s, c) = libm::sincos(turn_rad + TAU * k as f64 / sides as f64);
            center + axis.point(along, radius * c, radius * s)
        };
        let half = 0.5 * height;
        Self::from_vertices((0..sides).flat_map(|k| [corner(k, -half), corner(k, half)]).collect())
    }

    /// The octahedron with its six corners `radius` from `center` along the axes.
    ///
    /// # Errors
    /// As for [`cuboid`](Self::cuboid).
    pub fn octahedron(center: Vec3, radius: f64) -> Result<Self, GeometryError> {
        positive("the octahedron's radius", radius)?;
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        Self::from_vertices(axes.iter().flat_map(|a| [center - a * radius, center + a * radius]).collect())
    }

    /// The lower half of the box about `center` with sides `size`, cut by the plane through its top -x edge
    /// and its bottom +x edge.
    ///
    /// # Errors
    /// As for [`cuboid`](Self::cuboid).
    pub fn wedge(center: Vec3, size: Vec3) -> Result<Self, GeometryError> {
        let half = half_size(&size)?;
        let profile = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)];
        let corner = |x: f64, y: f64, z: f64| center + half.component_mul(&Vec3::new(x, y, z));
        Self::from_vertices(
            profile.iter().flat_map(|&(x, z)| [corner(x, -1.0, z), corner(x, 1.0, z)]).collect(),
        )
    }

    /// The pyramid over an axis-aligned square of `side` about `base_center`, its tip `height` above.
    ///
    /// # Errors
    /// As for [`cuboid`](Self::cuboid).
    pub fn pyramid(base_center: Vec3, side: f64, height: f64) -> Result<Self, GeometryError> {
        let half = 0.5 * positive("the pyramid's side", side)?;
        positive("the pyramid's height", height)?;
        let corner = |x: f64, y: f64| base_center + Vec3::new(x * half, y * half, 0.0);
        let tip = base_center + Vec3::z() * height;
        Self::from_vertices(vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
            tip,
        ])
    }
}

fn half_size(size: &Vec3) -> Result<Vec3, GeometryError> {
    positive("the size along x", size.x)?;
    positive("the size along y", size.y)?;
    positive("the size along z", size.z)?;
    Ok(size * 0.5)
}
