//! Forward kinematics by products of 4 × 4 matrices, and Newton's method for its inverse.

use super::Angles;
use nalgebra::{Matrix3, Matrix4, Matrix6, Vector3, Vector6};

/// How near Newton's method must come, metres and radians alike.
const CLOSE: f64 = 1e-10;
/// How many of its steps are made at most.
const STEPS: u32 = 20;

/// One row of standard Denavit–Hartenberg parameters with its joint's limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Twist.
    pub alpha_rad: f64,
    /// Length.
    pub a_m: f64,
    /// Offset.
    pub d_m: f64,
    /// Added to the joint angle.
    pub offset_rad: f64,
    /// The least and the greatest angle; infinite both of a joint that turns without end.
    pub limits_rad: [f64; 2],
    /// The greatest speed.
    pub speed_rad_s: f64,
}

/// Base, links and tool in the world.
pub(super) type Frames = [Matrix4<f64>; 8];

impl Row {
    /// Whether whole turns are the same angle.
    pub(super) fn is_endless(&self) -> bool {
        self.limits_rad.iter().all(|limit| limit.is_infinite())
    }

    /// The row's frame in the one before, given the sine and cosine of its twist.
    fn matrix(&self, (sa, ca): (f64, f64), angle_rad: f64) -> Matrix4<f64> {
        let (s, c) = libm::sincos(angle_rad + self.offset_rad);
        let (a, d) = (self.a_m, self.d_m);
        #[rustfmt::skip]
        let matrix = Matrix4::new(
            c, -s * ca, s * sa, a * c,
            s, c * ca, -c * sa, a * s,
            0.0, sa, ca, d,
            0.0, 0.0, 0.0, 1.0,
        );
        matrix
    }
}

/// An arm's rows between its base and its tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    rows: [Row; 6],
    /// Sines and cosines of the rows' twists.
    twists: [(f64, f64); 6],
    base: Matrix4<f64>,
    tool: Matrix4<f64>,
}

impl Chain {
    /// The chain of `rows`, base first, with the base in the world and the tool in the flange, both of them poses.
    pub fn new(rows: [Row; 6], base: Matrix4<f64>, tool: Matrix4<f64>) -> Self {
        Self { rows, twists: rows.map(|row| libm::sincos(row.alpha_rad)), base, tool }
    }

    /// The rows, base first.
    pub(super) fn rows(&self) -> &[Row; 6] {
        &self.rows
    }

    /// Base, links and tool in the world.
    pub(super) fn frames(&self, q: &Angles) -> Frames {
        let mut frames = [self.base; 8];
        self.write_frames(q, &mut frames);
        frames
    }

    /// The same into `frames`, whose first is the base.
    pub(super) fn write_frames(&self, q: &Angles, frames: &mut Frames) {
        for (i, row) in self.rows.iter().enumerate() {
            frames[i + 1] = product(&frames[i], &row.matrix(self.twists[i], q[i]));
        }
        frames[7] = product(&frames[6], &self.tool);
    }

    /// Orientation and place of the tool.
    pub(super) fn tool(&self, q: &Angles) -> (Matrix3<f64>, Vector3<f64>) {
        apart(&self.frames(q)[7])
    }

    /// The first joint that is outside its limits, in words.
    pub(super) fn limits_refusal(&self, q: &Angles) -> Option<String> {
        let outside = |(row, angle): (&Row, &f64)| {
            *angle < row.limits_rad[0] - 1e-9 || *angle > row.limits_rad[1] + 1e-9
        };
        let joint = self.rows.iter().zip(q).position(outside)?;
        Some(format!("joint {} is outside its limits at {:.3}°", joint + 1, q[joint].to_degrees()))
    }

    /// The configuration near `q` with the tool at `wanted`; `None` if Newton's method does not find one.
    ///
    /// `frames` must be those of some configuration, and are those of the one that is found.
    pub(super) fn near(
        &self,
        q: &Angles,
        wanted: &(Matrix3<f64>, Vector3<f64>),
        frames: &mut Frames,
    ) -> Option<Angles> {
        let mut q = *q;
        for _ in 0..STEPS {
            self.write_frames(&q, frames);
            let (rotation, place) = apart(&frames[7]);
            let turned =
                (0..3).map(|i| rotation.column(i).cross(&wanted.0.column(i))).sum::<Vector3<f64>>() * 0.5;
            let moved = wanted.1 - place;
            if moved.norm() < CLOSE && turned.norm() < CLOSE {
                return Some(q);
            }
            let error = Vector6::new(moved.x, moved.y, moved.z, turned.x, turned.y, turned.z);
            let change = jacobian(frames, &place).lu().solve(&error)?;
            for (angle, change) in q.iter_mut().zip(change.iter()) {
                *angle += change.clamp(-0.2, 0.2);
            }
        }
        None
    }
}

/// The product of two poses: what that of the matrices is, without their last rows.
fn product(a: &Matrix4<f64>, b: &Matrix4<f64>) -> Matrix4<f64> {
    let mut product = Matrix4::identity();
    for column in 0..4 {
        for row in 0..3 {
            let turned =
                a[(row, 0)] * b[(0, column)] + a[(row, 1)] * b[(1, column)] + a[(row, 2)] * b[(2, column)];
            product[(row, column)] = if column == 3 { turned + a[(row, 3)] } else { turned };
        }
    }
    product
}

/// Where the tool is.
pub(super) fn tip(frames: &Frames) -> Vector3<f64> {
    frames[7].fixed_view::<3, 1>(0, 3).into_owned()
}

fn apart(frame: &Matrix4<f64>) -> (Matrix3<f64>, Vector3<f64>) {
    (frame.fixed_view::<3, 3>(0, 0).into_owned(), frame.fixed_view::<3, 1>(0, 3).into_owned())
}

fn jacobian(frames: &Frames, place: &Vector3<f64>) -> Matrix6<f64> {
    let mut jacobian = Matrix6::zeros();
    for (joint, frame) in frames.iter().take(6).enumerate() {
        let axis: Vector3<f64> = frame.fixed_view::<3, 1>(0, 2).into_owned();
        let origin: Vector3<f64> = frame.fixed_view::<3, 1>(0, 3).into_owned();
        jacobian.fixed_view_mut::<3, 1>(0, joint).copy_from(&axis.cross(&(place - origin)));
        jacobian.fixed_view_mut::<3, 1>(3, joint).copy_from(&axis);
    }
    jacobian
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_poses_are_those_of_matrices_to_the_last_bit() {
        let mut last = Matrix4::identity();
        for step in 0..1000 {
            let [angle, alpha] = [f64::from(step) * 0.37 - 90.0, f64::from(step % 7) * 0.9];
            let row = Row {
                alpha_rad: alpha,
                a_m: 0.1 + f64::from(step % 11) * 0.03,
                d_m: -0.2 + f64::from(step % 5) * 0.17,
                offset_rad: 0.3,
                limits_rad: [-9.0, 9.0],
                speed_rad_s: 1.0,
            };
            let next = row.matrix(libm::sincos(alpha), angle);
            assert_eq!(product(&last, &next), last * next, "step {step}");
            last = next;
        }
    }
}
