//! Solids with a name and a place, as robot and problem files give them: metres, and rotations as matrices.

use crate::settings::{Document, SettingsError};
use crate::units::unbent;
use std::ops::Range;

/// Beyond this many metres a length is taken for one in millimetres: no robot and no scene around one is as large.
pub const FAR_M: f64 = 10.0;

/// Beyond this many radians, two turns, an angle is taken for one in degrees.
pub const FAR_RAD: f64 = 4.0 * std::f64::consts::PI;

/// How far the length of a quaternion may be from 1: two digits that are written by hand.
const UNIT: f64 = 1e-2;
/// Beyond this its digits are few enough for a message.
const ROUNDED: f64 = 1e-4;

/// A place and an orientation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Row by row: its columns are the axes of the frame.
    pub rotation: [[f64; 3]; 3],
    /// The origin of the frame.
    pub origin_m: [f64; 3],
}

impl Pose {
    /// The pose that moves nothing.
    pub const IDENTITY: Self =
        Self { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], origin_m: [0.0; 3] };

    /// The pose at `origin_m` turned by `rpy_rad` about the fixed axes x, then y, then z.
    ///
    /// An angle within 5e-6 of a multiple of a right angle is taken for it: files write 1.5708 and mean a right angle.
    pub fn from_rpy(origin_m: [f64; 3], rpy_rad: [f64; 3]) -> Self {
        let [(sr, cr), (sp, cp), (sy, cy)] = rpy_rad.map(sin_cos);
        let rotation = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ];
        Self { rotation, origin_m }
    }

    /// The pose at `origin_m` turned by a quaternion, whose real part is first; its length does not matter.
    pub fn from_quaternion(origin_m: [f64; 3], wxyz: [f64; 4]) -> Self {
        let length = wxyz.iter().map(|part| part * part).sum::<f64>().sqrt();
        let [w, x, y, z] = wxyz.map(|part| part / length);
        let rotation = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ];
        Self { rotation, origin_m }
    }

    /// A point of the frame, in the frame that the pose is given in.
    pub fn point(&self, point: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.origin_m[i] + dot(self.rotation[i], point))
    }

    /// `other`, given in this frame, in the frame that this one is given in.
    #[must_use]
    pub fn then(&self, other: &Self) -> Self {
        let column = |j: usize| std::array::from_fn(|k| other.rotation[k][j]);
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| dot(self.rotation[i], column(j))));
        Self { rotation, origin_m: self.point(other.origin_m) }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sin_cos(angle_rad: f64) -> (f64, f64) {
    let turns = angle_rad / std::f64::consts::FRAC_PI_2;
    let whole = turns.round();
    if (angle_rad - whole * std::f64::consts::FRAC_PI_2).abs() > 5e-6 {
        return libm::sincos(angle_rad);
    }
    match whole.rem_euclid(4.0) as u8 {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// What a solid is, about the origin of its frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// A box with these half sides.
    Box([f64; 3]),
    /// A cylinder about z, by its radius and its length.
    Cylinder(f64, f64),
    /// A sphere by its radius.
    Sphere(f64),
    /// The convex hull of points.
    Hull(Vec<[f64; 3]>),
}

/// A solid with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Its name in messages and pictures.
    pub name: String,
    /// Where it is.
    pub pose: Pose,
    /// What it is.
    pub form: Form,
}

/// Sides of the prism that stands for a cylinder.
const SIDES: usize = 24;

/// How far the corners are from the axis of the prism that stands for a cylinder of this radius.
pub fn prism_radius_m(radius_m: f64) -> f64 {
    radius_m / libm::cos(std::f64::consts::PI / SIDES as f64)
}

impl Solid {
    /// Points and a radius such that all within the radius of their hull is the solid: exactly for boxes, spheres and hulls; a
    /// cylinder is a prism of 24 sides around it, 0.9 % wider.
    pub fn rounded(&self) -> (Vec<[f64; 3]>, f64) {
        let signs = [-1.0, 1.0];
        let (points, radius_m) = match &self.form {
            Form::Box([x, y, z]) => {
                let corner = |sx: f64, sy: f64| signs.map(|sz| [sx * x, sy * y, sz * z]);
                (signs.iter().flat_map(|sx| signs.iter().flat_map(move |sy| corner(*sx, *sy))).collect(), 0.0)
            }
            Form::Cylinder(radius_m, length_m) => {
                let half_turn = std::f64::consts::PI;
                let wide = prism_radius_m(*radius_m);
                let rim = |side: usize| {
                    let (s, c) = libm::sincos(2.0 * half_turn * side as f64 / SIDES as f64);
                    signs.map(|sign| [wide * c, wide * s, 0.5 * sign * length_m])
                };
                ((0..SIDES).flat_map(rim).collect(), 0.0)
            }
            Form::Sphere(radius_m) => (vec![[0.0; 3]], *radius_m),
            Form::Hull(points) => (points.clone(), 0.0),
        };
        (points.into_iter().map(|point| self.pose.point(point)).collect(), radius_m)
    }
}

/// The file being read, which knows the places in it. Its numbers are finite.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a>(pub &'a Document);

impl Source<'_> {
    pub fn fault(self, at: &Range<usize>, message: impl Into<String>) -> SettingsError {
        self.0.error(at.clone(), message)
    }

    /// `N` lengths in metres; one beyond 10 m is taken for one in millimetres.
    pub fn metres<const N: usize>(
        self,
        at: &Range<usize>,
        key: &str,
        lengths: [f64; N],
    ) -> Result<[f64; N], SettingsError> {
        match lengths.iter().find(|length| length.abs() > FAR_M) {
            None => Ok(lengths),
            Some(found) => Err(self.fault(
                at,
                format!(
                    "{key} has the length {found} m; is it in millimetres? lengths in metres are accepted, up to {FAR_M} m \
                     ({found} mm is {} m)",
                    unbent(found * 1e-3)
                ),
            )),
        }
    }

    /// `N` angles in radians; one beyond two turns is taken for one in degrees.
    pub fn radians<const N: usize>(
        self,
        at: &Range<usize>,
        key: &str,
        angles: [f64; N],
    ) -> Result<[f64; N], SettingsError> {
        match angles.iter().find(|angle| angle.abs() > FAR_RAD) {
            None => Ok(angles),
            Some(found) => Err(self
                .fault(at, format!("{key} has the angle {found}; is it in degrees? radians are accepted"))),
        }
    }

    /// `N` sizes in metres, all above 0.
    pub fn sizes<const N: usize>(
        self,
        at: &Range<usize>,
        key: &str,
        sizes: [f64; N],
    ) -> Result<[f64; N], SettingsError> {
        let sizes = self.metres(at, key, sizes)?;
        match sizes.iter().find(|size| **size <= 0.0) {
            None => Ok(sizes),
            Some(found) => {
                Err(self.fault(at, format!("{key} has the size {found}; sizes above 0 are accepted")))
            }
        }
    }

    /// The pose of a place and a quaternion of length 1, real part first; and whether its length was made 1 visibly.
    pub fn pose(
        self,
        at: &Range<usize>,
        key: &str,
        [x, y, z, w, a, b, c]: [f64; 7],
    ) -> Result<(Pose, bool), SettingsError> {
        let origin_m = self.metres(at, key, [x, y, z])?;
        let wxyz = [w, a, b, c];
        let length = wxyz.iter().map(|part| part * part).sum::<f64>().sqrt();
        if (length - 1.0).abs() > UNIT {
            let message = format!(
                "{key} has the quaternion {w}, {a}, {b}, {c} (w, x, y, z) of length {length:.4}; 0.99 to 1.01 is accepted"
            );
            return Err(self.fault(at, message));
        }
        Ok((Pose::from_quaternion(origin_m, wxyz), (length - 1.0).abs() > ROUNDED))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

    #[test]
    fn a_quarter_turn_by_angles_is_the_one_by_a_quaternion_and_rounded_angles_are_right_angles() {
        let by_angles = Pose::from_rpy([1.0, 2.0, 3.0], [0.0, 0.0, FRAC_PI_2 + 4e-6]);
        let by_quaternion = Pose::from_quaternion([1.0, 2.0, 3.0], [FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2]);
        assert_eq!(by_angles.point([1.0, 0.0, 0.0]), [1.0, 3.0, 3.0]);
        for (a, b) in by_angles.rotation.iter().flatten().zip(by_quaternion.rotation.iter().flatten()) {
            assert!((a - b).abs() < 1e-15, "{by_angles:?}\n{by_quaternion:?}");
        }
    }

    #[test]
    fn turns_about_fixed_axes_are_made_in_the_order_x_y_z() {
        // x goes to x, then by pitch to -z, then by yaw nowhere.
        let turned = Pose::from_rpy([0.0; 3], [FRAC_PI_2, FRAC_PI_2, FRAC_PI_2]);
        assert_eq!(turned.point([1.0, 0.0, 0.0]), [0.0, 0.0, -1.0]);
        let one = Pose::from_rpy([0.1, 0.2, 0.3], [0.3, -0.4, 0.5]);
        let both = one.then(&turned).point([0.7, -0.2, 0.4]);
        let apart = one.point(turned.point([0.7, -0.2, 0.4]));
        assert!(both.iter().zip(apart).all(|(a, b)| (a - b).abs() < 1e-15), "{both:?} {apart:?}");
    }

    #[test]
    fn a_cylinder_is_inside_the_prism_that_stands_for_it() {
        let solid = |form| Solid { name: "s".to_owned(), pose: Pose::IDENTITY, form };
        let (points, radius_m) = solid(Form::Cylinder(0.5, 2.0)).rounded();
        assert_eq!((points.len(), radius_m), (48, 0.0));
        for side in 0..24 {
            let [a, b] = [points[2 * side], points[2 * ((side + 1) % 24)]];
            let middle = libm::hypot(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
            assert!((middle - 0.5).abs() < 1e-12, "side {side}: {middle}");
        }
        assert_eq!(solid(Form::Box([1.0, 2.0, 3.0])).rounded().0.len(), 8);
        assert_eq!(solid(Form::Sphere(0.3)).rounded(), (vec![[0.0; 3]], 0.3));
    }
}
