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
    /// The least and the greatest angle.
    pub limits_rad: [f64; 2],
    /// The greatest speed.
    pub speed_rad_s: f64,
}

impl Row {
    fn matrix(&self, angle_rad: f64) -> Matrix4<f64> {
        let (s, c) = libm::sincos(angle_rad + self.offset_rad);
        let (sa, ca) = libm::sincos(self.alpha_rad);
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
    /// The rows, base first.
    pub rows: [Row; 6],
    /// The base in the world.
    pub base: Matrix4<f64>,
    /// The tool in the flange.
    pub tool: Matrix4<f64>,
}

impl Chain {
    /// Base, links and tool in the world.
    pub(super) fn frames(&self, q: &Angles) -> [Matrix4<f64>; 8] {
        let mut frames = [self.base; 8];
        for (i, row) in self.rows.iter().enumerate() {
            frames[i + 1] = frames[i] * row.matrix(q[i]);
        }
        frames[7] = frames[6] * self.tool;
        frames
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
    pub(super) fn near(&self, q: &Angles, wanted: &(Matrix3<f64>, Vector3<f64>)) -> Option<Angles> {
        let mut q = *q;
        for _ in 0..STEPS {
            let frames = self.frames(&q);
            let (rotation, place) = apart(&frames[7]);
            let turned =
                (0..3).map(|i| rotation.column(i).cross(&wanted.0.column(i))).sum::<Vector3<f64>>() * 0.5;
            let moved = wanted.1 - place;
            if moved.norm() < CLOSE && turned.norm() < CLOSE {
                return Some(q);
            }
            let error = Vector6::new(moved.x, moved.y, moved.z, turned.x, turned.y, turned.z);
            let change = jacobian(&frames, &place).lu().solve(&error)?;
            for (angle, change) in q.iter_mut().zip(change.iter()) {
                *angle += change.clamp(-0.2, 0.2);
            }
        }
        None
    }
}

fn apart(frame: &Matrix4<f64>) -> (Matrix3<f64>, Vector3<f64>) {
    (frame.fixed_view::<3, 3>(0, 0).into_owned(), frame.fixed_view::<3, 1>(0, 3).into_owned())
}

fn jacobian(frames: &[Matrix4<f64>; 8], place: &Vector3<f64>) -> Matrix6<f64> {
    let mut jacobian = Matrix6::zeros();
    for (joint, frame) in frames.iter().take(6).enumerate() {
        let axis: Vector3<f64> = frame.fixed_view::<3, 1>(0, 2).into_owned();
        let origin: Vector3<f64> = frame.fixed_view::<3, 1>(0, 3).into_owned();
        jacobian.fixed_view_mut::<3, 1>(0, joint).copy_from(&axis.cross(&(place - origin)));
        jacobian.fixed_view_mut::<3, 1>(3, joint).copy_from(&axis);
    }
    jacobian
}
