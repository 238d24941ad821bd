//! What makes a shape impossible.

use base::text::listed;
use thiserror::Error;

/// A shape that cannot be built; the message says what was found and what would be accepted.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GeometryError {
    /// A coordinate or size is NaN or infinite.
    #[error("{what} is {found}; every coordinate and size must be a finite number")]
    NotFinite {
        /// Which quantity.
        what: String,
        /// Its value.
        found: f64,
    },
    /// A size is zero or negative.
    #[error("{what} is {found}; it must be greater than 0")]
    NotPositive {
        /// Which quantity.
        what: &'static str,
        /// Its value.
        found: f64,
    },
    /// A prism or polygon has too few sides, or a polyhedron too few or too many vertices or planes.
    #[error("{found} {what} were given; {least} to {most} are accepted")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// The fewest accepted.
        least: usize,
        /// The most accepted.
        most: usize,
    },
    /// The vertices lie in one plane (or, for a polygon, on one line).
    #[error("the {found} vertices enclose nothing; they must not all lie in one plane or on one line")]
    Flat {
        /// How many vertices there are.
        found: usize,
    },
    /// Two vertices coincide.
    #[error("vertices {first} and {second} coincide; each vertex may be given once")]
    DuplicateVertex {
        /// Index of the first.
        first: usize,
        /// Index of the second.
        second: usize,
    },
    /// A vertex is not a corner of the convex hull of all.
    #[error("vertex {vertex} is no corner of the convex hull; every vertex of a convex shape must be one")]
    NotConvex {
        /// Index of the vertex.
        vertex: usize,
    },
    /// A polygon's corners are not in counter-clockwise order.
    #[error(
        "the corner at vertex {vertex} turns clockwise or not at all; corners must turn counter-clockwise"
    )]
    NotCounterClockwise {
        /// Index of the vertex.
        vertex: usize,
    },
    /// Two planes bound the same half-space direction.
    #[error("planes {first} and {second} have the same normal; each face may be given once")]
    DuplicatePlane {
        /// Index of the first.
        first: usize,
        /// Index of the second.
        second: usize,
    },
    /// A plane that bounds no face.
    #[error("plane {plane} bounds no face of the polyhedron; leave it out or move it inwards")]
    IdlePlane {
        /// Index of the plane.
        plane: usize,
    },
    /// The half-spaces do not close.
    #[error(
        "the polyhedron is unbounded along {}; its planes must enclose it on every side",
        listed(direction)
    )]
    Unbounded {
        /// A direction in which one can leave for ever.
        direction: [f64; 3],
    },
    /// The half-spaces have no common interior.
    #[error("no point lies behind all {planes} planes; normals must point out of the polyhedron")]
    Empty {
        /// How many planes there are.
        planes: usize,
    },
}

impl GeometryError {
    /// The way from a shape's table to what is wrong, where tables call quantities as messages do, and corners `corners`.
    pub(crate) fn place(&self, corners: &str) -> String {
        match self {
            Self::NotPositive { what, .. } => {
                let axis = ["x", "y", "z"].iter().position(|axis| what.ends_with(&format!("along {axis}")));
                let word = what.rsplit(' ').next().unwrap_or_default();
                axis.map_or_else(|| word.to_owned(), |axis| format!("size.{axis}"))
            }
            Self::Count { what: "sides", .. } => "sides".to_owned(),
            Self::Count { .. } | Self::Flat { .. } => corners.to_owned(),
            Self::DuplicateVertex { second: vertex, .. } | Self::NotConvex { vertex } => {
                format!("{corners}.{vertex}")
            }
            Self::DuplicatePlane { second: plane, .. } | Self::IdlePlane { plane } => {
                format!("planes.{plane}")
            }
            Self::Unbounded { .. } | Self::Empty { .. } => "planes".to_owned(),
            Self::NotFinite { .. } | Self::NotCounterClockwise { .. } => String::new(),
        }
    }
}

/// `value` if it is finite.
pub(super) fn finite(what: &str, value: f64) -> Result<f64, GeometryError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(GeometryError::NotFinite { what: what.to_owned(), found: value })
    }
}

/// `value` if it is finite and greater than zero.
pub(super) fn positive(what: &'static str, value: f64) -> Result<f64, GeometryError> {
    if finite(what, value)? > 0.0 {
        Ok(value)
    } else {
        Err(GeometryError::NotPositive { what, found: value })
    }
}

/// Refuses a point with a coordinate that is not finite.
pub(super) fn finite_point(what: &str, point: &[f64]) -> Result<(), GeometryError> {
    for (axis, &value) in ["x", "y", "z"].iter().zip(point) {
        finite(&format!("{axis} of {what}"), value)?;
    }
    Ok(())
}
