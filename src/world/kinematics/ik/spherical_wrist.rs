//! Arms whose last three axes meet in a point: up to eight configurations a pose.
//!
//! The chain must have `alpha = (±90°, 0 or 180°, ±90°, ±90°, ±90°, any)`, `d5 = 0`, `a4 = a5 = 0` and `a2` other than 0, with
//! `d2` and `d3` the shoulder's offset, in either row or shared out. Then the first three joints place the wrist centre, a
//! two-link arm in a plane at the shoulder's offset from axis 1, and the last three turn the hand.
//!
//! What a pose leaves free: with axes 4 and 6 in line (the fifth sine below 1e-10), joint 4 keeps its reference, and joint 6 takes
//! the whole turn. Joints 1 and 2: see `reach`.
//!
//! # Source
//! Pieper, *The Kinematics of Manipulators under Computer Control* (1968), for the decoupling; the formulas
//! below follow from the rows as `form` rewrites them, with `σi` the sign of `alpha i`.

mod rows;

use super::{
    Branch, Chain, Family, Frame, Joints, KinematicsError, LaneSolutions, Solutions, Solver,
    form::{Form, Length, Shape, Twist, without_rounding},
    reach::{Fold, Heading, SINGULAR, fold, heading},
};
use crate::geometry::Vec3;
use crate::geometry::lanes::{self, PoseRows, dispatch};
use std::{f64::consts::PI, sync::Arc};

pub(super) const FAMILY: Family = Family { name: "spherical_wrist", is_complete: true, build };

const SHAPE: Shape = Shape {
    solver: FAMILY.name,
    twists: [Twist::Right, Twist::Made(0.0, 1.0), Twist::Right, Twist::Right, Twist::Right, Twist::Any],
    a: [Length::Any, Length::NotZero, Length::Any, Length::Zero, Length::Zero, Length::Any],
    d: [Length::Any, Length::Any, Length::Any, Length::Any, Length::Zero, Length::Any],
};

#[derive(Debug)]
struct SphericalWrist {
    form: Form,
    offsets: Joints,
    d1: f64,
    a1: f64,
    a2: f64,
    d6: f64,
    /// From axis 1 to the plane in which the arm folds, towards `(h.y, -h.x)`.
    shoulder: f64,
    /// From the elbow to the wrist centre.
    forearm: f64,
    /// From link 3's x axis to the line from elbow to wrist centre.
    forearm_angle: f64,
    /// Signs of `alpha` 1, 3, 4 and 5.
    signs: [f64; 4],
}

fn build(chain: &Chain) -> Result<Arc<dyn Solver>, KinematicsError> {
    let form = Form::new(chain, &SHAPE)?;
    let Form { a, d, .. } = form;
    let forearm = libm::hypot(a[2], d[3]);
    if without_rounding(forearm) == 0.0 {
        let accepted = "another number than 0, since the row before has no a_mm";
        return Err(SHAPE.refusal(chain, 3, "d_mm", d[3], accepted));
    }
    let signs = [0, 2, 3, 4].map(|joint: usize| form.twists[joint].0);
    Ok(Arc::new(SphericalWrist {
        offsets: form.turns.offsets,
        d1: d[0],
        a1: a[0],
        a2: a[1],
        d6: d[5],
        shoulder: without_rounding(signs[0] * (d[1] + d[2])),
        forearm,
        forearm_angle: libm::atan2(signs[1] * d[3], a[2]),
        signs,
        form,
    }))
}

/// The first joint's turn, and the triangle of shoulder, elbow and wrist centre in the arm's plane.
struct Plane {
    heading: Heading,
    fold: Fold,
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
        let turns = &self.form.turns;
        let heading = heading(wrist, self.shoulder, front, turns.theta(0, reference))?;
        let u = wrist.x * heading.h[0] + wrist.y * heading.h[1] - self.a1;
        let v = self.signs[0] * (wrist.z - self.d1);
        let fold = fold([u, v], [self.a2, self.forearm], turns.theta(1, reference))?;
        Some(Plane { heading, fold })
    }

    #[inline]
    fn reached(&self, plane: &Plane, elbow: bool) -> Reached {
        let side = if elbow { 1.0 } else { -1.0 };
        let theta2 = plane.fold.to_point - side * plane.fold.opening;
        let theta3 = side * plane.fold.bend + self.forearm_angle;
        let (s, c) = libm::sincos(theta2 + theta3);
        let [sign1, sign3, ..] = self.signs;
        let [h_x, h_y] = plane.heading.h;
        let ahead = |along: f64, up: f64| Vec3::new(h_x * along, h_y * along, sign1 * up);
        let (x3, z3) = (ahead(c, s), ahead(s, -c) * sign3);
        Reached { theta: [plane.heading.theta, theta2, theta3], x3, y3: z3.cross(&x3), z3 }
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
            let theta4 = self.form.turns.theta(3, reference);
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
            self.form.turns.joints(&[theta[0], theta[1], theta[2], last[0], last[1], last[2]])
        };
        [joints([theta4, theta5, theta6]), joints([theta4 + turn, -theta5, theta6 + turn])]
    }

    /// Lanes are written for arms without a shoulder offset, in the form that they come in.
    fn has_lanes(&self) -> bool {
        let as_given = self.form.turns.keep_directions() && self.form.behind.is_none();
        self.shoulder == 0.0 && as_given
    }

    #[inline]
    fn wrist_center(&self, flange: &Frame) -> Vec3 {
        flange.origin - flange.axis(2) * self.d6
    }
}

impl Solver for SphericalWrist {
    fn branch_of(&self, q: &Joints) -> Branch {
        let theta: Joints = std::array::from_fn(|i| self.form.turns.theta(i, q));
        let bend = theta[2] - self.forearm_angle;
        let ahead = self.a1 + self.a2 * libm::cos(theta[1]) + self.forearm * libm::cos(theta[1] + bend);
        Branch::new(ahead >= 0.0, libm::sin(bend) >= 0.0, libm::sin(theta[4]) >= 0.0)
    }

    fn folds_rad(&self, q: &Joints) -> [f64; 2] {
        [self.form.turns.theta(2, q) - self.forearm_angle, self.form.turns.theta(4, q)]
    }

    fn other_wrist(&self, q: &Joints) -> Option<Joints> {
        // With an offset of the shoulder the arm reaches back at another angle than half a turn.
        let turns = &self.form.turns;
        (self.shoulder == 0.0).then(|| {
            let [first, second, third, fourth, fifth, sixth] = std::array::from_fn(|i| turns.theta(i, q));
            turns.joints(&[first, second, third, fourth + PI, -fifth, sixth + PI])
        })
    }

    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints> {
        let flange = self.form.last_frame(flange);
        let plane = self.plane(&self.wrist_center(&flange), branch.shoulder(), reference)?;
        let reached = self.reached(&plane, branch.elbow());
        Some(self.wrists(&reached, &flange, reference)[usize::from(!branch.wrist())])
    }

    fn solve_lanes(&self, flanges: &PoseRows, branch: Branch) -> Option<LaneSolutions> {
        if !self.has_lanes() {
            return None;
        }
        let level = lanes::level();
        Some(dispatch!(level, simd => self.solve_rows(simd, flanges, branch)))
    }

    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions {
        let flange = self.form.last_frame(flange);
        let wrist = self.wrist_center(&flange);
        let mut solutions = Solutions::none();
        for front in [true, false] {
            let Some(plane) = self.plane(&wrist, front, reference) else { continue };
            for elbow in [true, false] {
                let reached = self.reached(&plane, elbow);
                let [positive, negative] = self.wrists(&reached, &flange, reference);
                solutions.insert(Branch::new(front, elbow, true), positive);
                solutions.insert(Branch::new(front, elbow, false), negative);
            }
        }
        solutions
    }
}
