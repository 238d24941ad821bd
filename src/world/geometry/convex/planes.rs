//! A polyhedron from its bounding planes.

use super::{Convex, MOST};
use crate::geometry::{
    Vec3,
    error::{GeometryError, finite, finite_point, positive},
};
use nalgebra::Matrix3;

/// Unit normals closer than this are one direction; corners closer than this share of the extent are one.
const SAME: f64 = 1e-9;

impl Convex {
    /// The solid of all `x` with `normal · x <= offset` for each `(normal, offset)`, 4 to 64 of them; normals
    /// have any length above 0, and offsets are meant for them as given.
    ///
    /// # Errors
    /// [`GeometryError::Count`], [`GeometryError::NotFinite`], [`GeometryError::NotPositive`] for a normal
    /// without length, [`GeometryError::DuplicatePlane`], [`GeometryError::Unbounded`],
    /// [`GeometryError::Empty`], or [`GeometryError::IdlePlane`] for a plane without a face.
    pub fn from_planes(planes: &[(Vec3, f64)]) -> Result<Self, GeometryError> {
        let planes = unit_planes(planes)?;
        refuse_unbounded(&planes)?;
        let vertices = corners(&planes);
        if vertices.len() < 4 {
            return Err(GeometryError::Empty { planes: planes.len() });
        }
        let solid = Self::from_vertices(vertices)?;
        let bounds = |n: &Vec3| solid.faces.iter().any(|face| (face.plane.normal - n).norm() <= 1e-6);
        if let Some(plane) = planes.iter().position(|(n, _)| !bounds(n)) {
            return Err(GeometryError::IdlePlane { plane });
        }
        Ok(solid)
    }
}

fn unit_planes(planes: &[(Vec3, f64)]) -> Result<Vec<(Vec3, f64)>, GeometryError> {
    if !(4..=MOST).contains(&planes.len()) {
        return Err(GeometryError::Count { what: "planes", found: planes.len(), least: 4, most: MOST });
    }
    let mut unit: Vec<(Vec3, f64)> = Vec::with_capacity(planes.len());
    for (second, (normal, offset)) in planes.iter().enumerate() {
        finite_point(&format!("the normal of plane {second}"), normal.as_slice())?;
        finite(&format!("the offset of plane {second}"), *offset)?;
        let length = positive("the length of a plane's normal", normal.norm())?;
        let normal = normal / length;
        if let Some(first) = unit.iter().position(|(n, _)| (n - normal).norm() <= SAME) {
            return Err(GeometryError::DuplicatePlane { first, second });
        }
        unit.push((normal, offset / length));
    }
    Ok(unit)
}

/// A polyhedron is unbounded if some direction rises along no normal. If the normals span space, the extreme
/// ones of such directions lie along crossings of two planes, so those are enough to try.
fn refuse_unbounded(planes: &[(Vec3, f64)]) -> Result<(), GeometryError> {
    let first = planes[0].0;
    let other = planes.iter().map(|(n, _)| first.cross(n)).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let across = other.expect("at least four planes");
    let spanned = across.norm() > SAME && planes.iter().any(|(n, _)| n.dot(&across).abs() > SAME);
    if !spanned {
        let off_axis = Vec3::from_fn(|i, _| f64::from(first.iamin() == i));
        let direction = if across.norm() > SAME { across } else { first.cross(&off_axis) };
        return Err(GeometryError::Unbounded { direction: direction.normalize().into() });
    }
    for (i, (a, _)) in planes.iter().enumerate() {
        for (b, _) in &planes[i + 1..] {
            let Some(along) = a.cross(b).try_normalize(SAME) else { continue };
            for direction in [along, -along] {
                if planes.iter().all(|(n, _)| n.dot(&direction) <= SAME) {
                    // Adding zero turns a printed -0.0 into 0.0.
                    return Err(GeometryError::Unbounded { direction: direction.add_scalar(0.0).into() });
                }
            }
        }
    }
    Ok(())
}

/// The points where three planes meet and no other plane is in between.
fn corners(planes: &[(Vec3, f64)]) -> Vec<Vec3> {
    let extent = planes.iter().map(|(_, offset)| offset.abs()).fold(0.0, f64::max);
    let mut corners: Vec<Vec3> = Vec::new();
    for (i, (a, at_a)) in planes.iter().enumerate() {
        for (j, (b, at_b)) in planes.iter().enumerate().skip(i + 1) {
            for (c, at_c) in &planes[j + 1..] {
                let normals = Matrix3::from_rows(&[a.transpose(), b.transpose(), c.transpose()]);
                if normals.determinant().abs() <= SAME {
                    continue;
                }
                let Some(inverse) = normals.try_inverse() else { continue };
                let corner = inverse * Vec3::new(*at_a, *at_b, *at_c);
                let behind = planes.iter().all(|(n, offset)| n.dot(&corner) - offset <= SAME * extent);
                if behind && corners.iter().all(|known| (known - corner).norm() > SAME * extent) {
                    corners.push(corner);
                }
            }
        }
    }
    corners
}
