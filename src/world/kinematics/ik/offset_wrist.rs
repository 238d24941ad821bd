//! Arms with three parallel axes (2, 3 and 4) and a wrist whose axes do not meet: up to eight configurations.
//!
//! The chain must have `alpha = (±90°, 0 or 180°, 0 or 180°, ±90°, ±90°, any)`, `a1 = a4 = a5 = 0` and `a2`, `a3` other
//! than 0, as the UR series and the AUBO i series have; `d2`, `d3` and `d4` together are the shoulder's offset. The
//! shoulder angle follows from the flange's position, then the fifth and sixth from its orientation, then a two-link
//! arm is left.
//!
//! Free joints: where axes 4 and 6 are parallel (the fifth sine below 1e-10), joint 6 keeps its reference. It does so
//! even if the pose is out of reach that way and within it another way. A flange nearer to axis 1 than the shoulder's
//! offset has no configuration. Joints 1 and 2: see `reach`.
//!
//! # Source
//! Derived from the rows as `form` rewrites them, to `alpha = (90°, 180°, 180°, -90°, 90°)`. With angles counted from upright,
//! `k` along axis 2, `h` ahead of the arm and `n, o, a` the flange's axes, the formulas are those in the functions below.

use super::{
    AXES, Branch, Chain, Family, Frame, Joints, KinematicsError, Solutions, Solver,
    form::{Form, Length, Shape, Turns, Twist, without_rounding},
    reach::{Fold, SINGULAR, fold, heading},
};
use crate::geometry::Vec3;
use std::{f64::consts::FRAC_PI_2, sync::Arc};

/// Row angles at which the arm stands upright, where the formulas count from.
const UPRIGHT: Joints = [0.0, FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0];

pub(super) const FAMILY: Family = Family { name: "offset_wrist", is_complete: true, build };

const SHAPE: Shape = Shape {
    solver: FAMILY.name,
    twists: [
        Twist::Made(1.0, 0.0),
        Twist::Made(0.0, -1.0),
        Twist::Made(0.0, -1.0),
        Twist::Made(-1.0, 0.0),
        Twist::Made(1.0, 0.0),
        Twist::Any,
    ],
    a: [Length::Zero, Length::NotZero, Length::NotZero, Length::Zero, Length::Zero, Length::Any],
    d: [Length::Any; AXES],
};

#[derive(Debug)]
struct OffsetWrist {
    form: Form,
    /// Joint angles counted from upright.
    upright: Turns,
    d1: f64,
    /// Between axis 1 and the plane in which the arm folds.
    shoulder: f64,
    a2: f64,
    a3: f64,
    d5: f64,
    d6: f64,
}

fn build(chain: &Chain) -> Result<Arc<dyn Solver>, KinematicsError> {
    let form = Form::new(chain, &SHAPE)?;
    let Form { a, d, .. } = form;
    Ok(Arc::new(OffsetWrist {
        upright: form.turns.counted_from(&UPRIGHT),
        d1: d[0],
        // Axis 3 points the other way than axes 2 and 4.
        shoulder: without_rounding(d[1] - d[2] + d[3]),
        a2: a[1],
        a3: a[2],
        d5: d[4],
        d6: d[5],
        form,
    }))
}

/// The shoulder angle with the arm's own directions, and the wrist's center (on axis 6, `d6` behind).
struct ShoulderSolution {
    q1: f64,
    h: Vec3,
    k: Vec3,
    wrist: Vec3,
}

/// The last two angles, and what is left for the two links to reach.
struct WristSolution {
    q5: f64,
    q6: f64,
    /// The direction of axis 5, in the arm's plane.
    e: Vec3,
    fold: Fold,
}

impl OffsetWrist {
    #[inline]
    fn shoulder(&self, flange: &Frame, front: bool, reference: &Joints) -> Option<ShoulderSolution> {
        let wrist = flange.origin - flange.axis(2) * self.d6;
        let heading = heading(&wrist, self.shoulder, front, self.upright.theta(0, reference))?;
        let [c, s] = heading.h;
        let (h, k) = (Vec3::new(c, s, 0.0), Vec3::new(s, -c, 0.0));
        Some(ShoulderSolution { q1: heading.theta, h, k, wrist })
    }

    #[inline]
    fn wrist(
        &self,
        flange: &Frame,
        ahead: &ShoulderSolution,
        positive: bool,
        reference: &Joints,
    ) -> Option<WristSolution> {
        let [n, o, a] = [flange.axis(0), flange.axis(1), flange.axis(2)];
        let (n_k, o_k) = (n.dot(&ahead.k), o.dot(&ahead.k));
        let magnitude = (n_k * n_k + o_k * o_k).sqrt();
        let sin5 = if positive { magnitude } else { -magnitude };
        let (q6, s6, c6) = if magnitude < SINGULAR {
            let q6 = self.upright.theta(5, reference);
            let (s, c) = libm::sincos(q6);
            (q6, s, c)
        } else {
            (libm::atan2(o_k / sin5, -n_k / sin5), o_k / sin5, -n_k / sin5)
        };
        let e = n * s6 + o * c6;
        let x = ahead.wrist.dot(&ahead.h) - self.d5 * e.dot(&ahead.h);
        let z = ahead.wrist.z - self.d1 - self.d5 * e.z;
        Some(WristSolution {
            q5: libm::atan2(sin5, a.dot(&ahead.k)),
            q6,
            e,
            fold: fold([z, -x], [self.a2, self.a3], self.upright.theta(1, reference))?,
        })
    }

    #[inline]
    fn joints(&self, ahead: &ShoulderSolution, hand: &WristSolution, elbow: bool) -> Joints {
        let side = if elbow { 1.0 } else { -1.0 };
        let q3 = side * hand.fold.bend;
        let q2 = hand.fold.to_point + side * hand.fold.opening;
        let q4 = libm::atan2(-hand.e.dot(&ahead.h), hand.e.z) - q2 + q3;
        self.upright.joints(&[ahead.q1, q2, q3, q4, hand.q5, hand.q6])
    }
}

impl Solver for OffsetWrist {
    fn branch_of(&self, q: &Joints) -> Branch {
        let q: Joints = std::array::from_fn(|i| self.upright.theta(i, q));
        let forearm = q[1] - q[2];
        let behind =
            self.a2 * libm::sin(q[1]) + self.a3 * libm::sin(forearm) + self.d5 * libm::sin(forearm + q[3]);
        Branch::new(behind <= 0.0, libm::sin(q[2]) >= 0.0, libm::sin(q[4]) >= 0.0)
    }

    fn folds_rad(&self, q: &Joints) -> [f64; 2] {
        [self.upright.theta(2, q), self.upright.theta(4, q)]
    }

    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints> {
        let flange = self.form.last_frame(flange);
        let ahead = self.shoulder(&flange, branch.shoulder(), reference)?;
        let hand = self.wrist(&flange, &ahead, branch.wrist(), reference)?;
        Some(self.joints(&ahead, &hand, branch.elbow()))
    }

    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions {
        let flange = self.form.last_frame(flange);
        let mut solutions = Solutions::none();
        for front in [true, false] {
            let Some(ahead) = self.shoulder(&flange, front, reference) else { continue };
            for wrist in [true, false] {
                let Some(hand) = self.wrist(&flange, &ahead, wrist, reference) else { continue };
                for elbow in [true, false] {
                    solutions.insert(Branch::new(front, elbow, wrist), self.joints(&ahead, &hand, elbow));
                }
            }
        }
        solutions
    }
}
