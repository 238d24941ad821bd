//! Arms whose last three axes meet in a point: up to eight configurations a pose.
//!
//! The chain must have `alpha = (±90°, 0, ±90°, ±90°, ±90°, 0)`, `d2 = d3 = d5 = 0`, `a4 = a5 = a6 = 0` and
//! `a2 > 0`: six-axis arms without a shoulder offset. Then the first three joints place the wrist centre, a
//! two-link arm in a vertical plane, and the last three turn the hand.
//!
//! What a pose leaves free: with the wrist centre on axis 1 (within 1 nm), joint 1 keeps its reference; with
//! axes 4 and 6 in line (within 1e-9 rad), joint 4 does, and joint 6 takes the whole turn.
//!
//! # Source
//! Pieper, *The Kinematics of Manipulators under Computer Control* (1968), for the decoupling; the formulas
//! below follow from the rows, with `σi` the sign of `alpha i` and `θi = qi + offset i`.

mod rows;

use super::{
    Branch, Chain, Family, Frame, Joints, KinematicsError, LaneSolutions, Shape, Solutions, Solver,
    opening_cosine,
};
use crate::geometry::Vec3;
use crate::geometry::lanes::{self, PoseRows, dispatch};
use std::{f64::consts::PI, sync::Arc};

/// Where axes count as in line or a centre as on an axis: radians or metres.
const SINGULAR: f64 = 1e-9;

pub(super) const FAMILY: Family = Family { name: "spherical_wrist", build };

#[derive(Debug)]
struct SphericalWrist {
    offsets: Joints,
    d1: f64,
    a1: f64,
    a2: f64,
    d6: f64,
    /// From the elbow to the wrist centre.
    forearm: f64,
    /// From link 3's x axis to the line from elbow to wrist centre.
    forearm_angle: f64,
    /// Signs of `alpha` 1, 3, 4 and 5.
    signs: [f64; 4],
}

fn build(chain: &Chain) -> Result<Arc<dyn Solver>, KinematicsError> {
    let straight = Some((0.0, 1.0));
    let shape = Shape {
        name: FAMILY.name,
        twists: [None, straight, None, None, None, straight],
        a_zero: [false, false, false, true, true, true],
        d_zero: [false, true, true, false, true, false],
    };
    shape.check(chain)?;
    let [first, second, third, fourth, _, sixth] = chain.joints();
    let sign = |joint: usize| chain.twists()[joint].0;
    Ok(Arc::new(SphericalWrist {
        offsets: chain.joints().map(|joint| joint.offset_rad),
        d1: first.d_m,
        a1: first.a_m,
        a2: second.a_m,
        d6: sixth.d_m,
        forearm: libm::hypot(third.a_m, fourth.d_m),
        forearm_angle: libm::atan2(sign(2) * fourth.d_m, third.a_m),
        signs: [sign(0), sign(2), sign(3), sign(4)],
    }))
}

/// The first joint's turn, and the triangle of shoulder, elbow and wrist centre in the arm's plane.
struct Plane {
    theta1: f64,
    /// Ahead of the arm, in the plane of the floor.
    h: [f64; 2],
    /// The angle by which the forearm turns from the upper arm, and the angles at the shoulder from the upper
    /// arm to the line to the wrist centre, and from level to that line.
    bend: f64,
    opening: f64,
    to_wrist: f64,
}

/// The first three angles and the axes of frame 3.
struct Reached {
    theta: [f64; 3],
    x3: Vec3,
    y3: Vec3,
    z3: Vec3,
}

impl SphericalWrist {
    /// The arm's plane, if the wrist centre is within reach.
    #[inline]
    fn plane(&self, wrist: &Vec3, front: bool, reference: &Joints) -> Option<Plane> {
        let radius = (wrist.x * wrist.x + wrist.y * wrist.y).sqrt();
        let side = if front { 1.0 } else { -1.0 };
        let (theta1, h) = if radius > SINGULAR {
            let h = [side * wrist.x / radius, side * wrist.y / radius];
            (libm::atan2(h[1], h[0]), h)
        } else {
            let theta1 = reference[0] + self.offsets[0];
            let (s, c) = libm::sincos(theta1);
            (theta1, [c, s])
        };
        let u = wrist.x * h[0] + wrist.y * h[1] - self.a1;
        let v = self.signs[0] * (wrist.z - self.d1);
        let cosine = opening_cosine(u * u + v * v, self.a2, self.forearm)?;
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        Some(Plane {
            theta1,
            h,
            bend: libm::atan2(sine, cosine),
            opening: libm::atan2(self.forearm * sine, self.a2 + self.forearm * cosine),
            to_wrist: libm::atan2(v, u),
        })
    }

    #[inline]
    fn reached(&self, plane: &Plane, elbow: bool) -> Reached {
        let side = if elbow { 1.0 } else { -1.0 };
        let theta2 = plane.to_wrist - side * plane.opening;
        let theta3 = side * plane.bend + self.forearm_angle;
        let (s, c) = libm::sincos(theta2 + theta3);
        let [sign1, sign3, ..] = self.signs;
        let ahead = |along: f64, up: f64| Vec3::new(plane.h[0] * along, plane.h[1] * along, sign1 * up);
        let (x3, z3) = (ahead(c, s), ahead(s, -c) * sign3);
        Reached { theta: [plane.theta1, theta2, theta3], x3, y3: z3.cross(&x3), z3 }
    }

    /// Both turns of the wrist, the one with a positive fifth sine first.
    #[inline]
    fn wrists(&self, reached: &Reached, flange: &Frame, reference: &Joints) -> [Joints; 2] {
        let [_, _, sign4, sign5] = self.signs;
        let [x, y, z] = [flange.axis(0), flange.axis(1), flange.axis(2)];
        let Reached { theta, x3, y3, z3 } = reached;
        let (across_x, across_y) = (sign5 * x3.dot(&z), sign5 * y3.dot(&z));
        let sin5 = (across_x * across_x + across_y * across_y).sqrt();
        let theta5 = libm::atan2(sin5, -sign4 * sign5 * z3.dot(&z));
        let is_singular = sin5 < SINGULAR;
        let (theta4, s4, c4) = if is_singular {
            let theta4 = reference[3] + self.offsets[3];
            let (s, c) = libm::sincos(theta4);
            (theta4, s, c)
        } else {
            (libm::atan2(across_y, across_x), across_y / sin5, across_x / sin5)
        };
        // The sixth angle is found with the fourth in place, so that near the singularity, where each is
        // uncertain, their sum is not.
        let y4 = (y3 * c4 - x3 * s4) * (-sign4 * sign5);
        let theta6 = libm::atan2(y4.dot(&x), y4.dot(&y));
        let turn = if is_singular { 0.0 } else { PI };
        let joints = |last: [f64; 3]| {
            let all = [theta[0], theta[1], theta[2], last[0], last[1], last[2]];
            std::array::from_fn(|i| all[i] - self.offsets[i])
        };
        [joints([theta4, theta5, theta6]), joints([theta4 + turn, -theta5, theta6 + turn])]
    }

    #[inline]
    fn wrist_center(&self, flange: &Frame) -> Vec3 {
        flange.origin - flange.axis(2) * self.d6
    }
}

impl Solver for SphericalWrist {
    fn branch_of(&self, q: &Joints) -> Branch {
        let theta: Joints = std::array::from_fn(|i| q[i] + self.offsets[i]);
        let bend = theta[2] - self.forearm_angle;
        let ahead = self.a1 + self.a2 * libm::cos(theta[1]) + self.forearm * libm::cos(theta[1] + bend);
        Branch::new(ahead >= 0.0, libm::sin(bend) >= 0.0, libm::sin(theta[4]) >= 0.0)
    }

    fn folds_rad(&self, q: &Joints) -> [f64; 2] {
        [q[2] + self.offsets[2] - self.forearm_angle, q[4] + self.offsets[4]]
    }

    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints> {
        let plane = self.plane(&self.wrist_center(flange), branch.shoulder(), reference)?;
        let reached = self.reached(&plane, branch.elbow());
        Some(self.wrists(&reached, flange, reference)[usize::from(!branch.wrist())])
    }

    fn solve_lanes(&self, flanges: &PoseRows, branch: Branch) -> Option<LaneSolutions> {
        let level = lanes::level();
        Some(dispatch!(level, simd => self.solve_rows(simd, flanges, branch)))
    }

    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions {
        let (wrist, mut solutions) = (self.wrist_center(flange), Solutions::none());
        for front in [true, false] {
            let Some(plane) = self.plane(&wrist, front, reference) else { continue };
            for elbow in [true, false] {
                let reached = self.reached(&plane, elbow);
                let [positive, negative] = self.wrists(&reached, flange, reference);
                solutions.insert(Branch::new(front, elbow, true), positive);
                solutions.insert(Branch::new(front, elbow, false), negative);
            }
        }
        solutions
    }
}
