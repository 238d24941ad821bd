//! Arms with three parallel axes (2, 3 and 4) and a wrist whose axes do not meet: up to eight configurations.
//!
//! The chain must have `alpha = (90°, 180°, 180°, -90°, 90°, 0)`, `d2 = d3 = 0`, `a1 = a4 = a5 = a6 = 0` and
//! `a2, a3 > 0`, as the AUBO i series has. The shoulder angle follows from the flange's position, then the
//! fifth and sixth from its orientation, then a two-link arm is left.
//!
//! What a pose leaves free: where axes 4 and 6 are parallel (the fifth sine below 1e-9), joint 6 keeps its
//! reference, also if the pose is out of reach that way and within it another way. A flange nearer to axis 1 than
//! the shoulder offset has no configuration.
//!
//! # Source
//! Derived from the rows; with `θ = q + (0, 90°, 0, -90°, 0, 0)`, `k` along axis 2, `h` ahead of the arm and
//! `n, o, a` the flange's axes, the formulas are those in the functions below.

use super::{
    Branch, Chain, Family, Frame, Joints, KinematicsError, Shape, Solutions, Solver, opening_cosine,
};
use crate::geometry::Vec3;
use std::{f64::consts::FRAC_PI_2, sync::Arc};

/// The fifth sine below which axes 4 and 6 count as parallel.
const SINGULAR: f64 = 1e-9;

/// Row angles at which the arm stands upright, where the formulas count from.
const UPRIGHT: Joints = [0.0, FRAC_PI_2, 0.0, -FRAC_PI_2, 0.0, 0.0];

pub(super) const FAMILY: Family = Family { name: "offset_wrist", build };

#[derive(Debug)]
struct OffsetWrist {
    /// What is added to a joint angle to count it from upright.
    from_upright: Joints,
    d1: f64,
    /// Between axis 1 and the plane in which the arm folds.
    shoulder: f64,
    a2: f64,
    a3: f64,
    d5: f64,
    d6: f64,
}

fn build(chain: &Chain) -> Result<Arc<dyn Solver>, KinematicsError> {
    let back = Some((0.0, -1.0));
    let shape = Shape {
        name: FAMILY.name,
        twists: [Some((1.0, 0.0)), back, back, Some((-1.0, 0.0)), Some((1.0, 0.0)), Some((0.0, 1.0))],
        a_zero: [true, false, false, true, true, true],
        d_zero: [false, true, true, false, false, false],
    };
    shape.check(chain)?;
    let [first, second, third, fourth, fifth, sixth] = chain.joints();
    Ok(Arc::new(OffsetWrist {
        from_upright: std::array::from_fn(|i| chain.joints()[i].offset_rad - UPRIGHT[i]),
        d1: first.d_m,
        shoulder: fourth.d_m,
        a2: second.a_m,
        a3: third.a_m,
        d5: fifth.d_m,
        d6: sixth.d_m,
    }))
}

/// The shoulder angle with the arm's own directions, and the wrist's center (on axis 6, `d6` behind).
struct Ahead {
    q1: f64,
    h: Vec3,
    k: Vec3,
    wrist: Vec3,
}

/// The last two angles, and what is left for the two links to reach.
struct Hand {
    q5: f64,
    q6: f64,
    /// The direction of axis 5, in the arm's plane.
    e: Vec3,
    bend: f64,
    opening: f64,
    to_wrist: f64,
}

impl OffsetWrist {
    #[inline]
    fn ahead(&self, flange: &Frame, front: bool) -> Option<Ahead> {
        let wrist = flange.origin - flange.axis(2) * self.d6;
        let radius2 = wrist.x * wrist.x + wrist.y * wrist.y;
        let along = (radius2 - self.shoulder * self.shoulder).max(0.0).sqrt();
        if radius2 * (1.0 + 1e-12) < self.shoulder * self.shoulder || radius2 == 0.0 {
            return None;
        }
        let along = if front { along } else { -along };
        // The direction h with wrist · h = along and wrist · k = shoulder, where k = (h.y, -h.x).
        let c = (along * wrist.x - self.shoulder * wrist.y) / radius2;
        let s = (along * wrist.y + self.shoulder * wrist.x) / radius2;
        let (h, k) = (Vec3::new(c, s, 0.0), Vec3::new(s, -c, 0.0));
        Some(Ahead { q1: libm::atan2(s, c), h, k, wrist })
    }

    #[inline]
    fn hand(&self, flange: &Frame, ahead: &Ahead, positive: bool, reference: &Joints) -> Option<Hand> {
        let [n, o, a] = [flange.axis(0), flange.axis(1), flange.axis(2)];
        let (n_k, o_k) = (n.dot(&ahead.k), o.dot(&ahead.k));
        let magnitude = (n_k * n_k + o_k * o_k).sqrt();
        let sin5 = if positive { magnitude } else { -magnitude };
        let (q6, s6, c6) = if magnitude < SINGULAR {
            let q6 = reference[5] + self.from_upright[5];
            let (s, c) = libm::sincos(q6);
            (q6, s, c)
        } else {
            (libm::atan2(o_k / sin5, -n_k / sin5), o_k / sin5, -n_k / sin5)
        };
        let e = n * s6 + o * c6;
        let x = ahead.wrist.dot(&ahead.h) - self.d5 * e.dot(&ahead.h);
        let z = ahead.wrist.z - self.d1 - self.d5 * e.z;
        let cosine = opening_cosine(x * x + z * z, self.a2, self.a3)?;
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        Some(Hand {
            q5: libm::atan2(sin5, a.dot(&ahead.k)),
            q6,
            e,
            bend: libm::atan2(sine, cosine),
            opening: libm::atan2(self.a3 * sine, self.a2 + self.a3 * cosine),
            to_wrist: libm::atan2(-x, z),
        })
    }

    #[inline]
    fn joints(&self, ahead: &Ahead, hand: &Hand, elbow: bool) -> Joints {
        let side = if elbow { 1.0 } else { -1.0 };
        let q3 = side * hand.bend;
        let q2 = hand.to_wrist + side * hand.opening;
        let q4 = libm::atan2(-hand.e.dot(&ahead.h), hand.e.z) - q2 + q3;
        let all = [ahead.q1, q2, q3, q4, hand.q5, hand.q6];
        std::array::from_fn(|i| all[i] - self.from_upright[i])
    }
}

impl Solver for OffsetWrist {
    fn branch_of(&self, q: &Joints) -> Branch {
        let q: Joints = std::array::from_fn(|i| q[i] + self.from_upright[i]);
        let forearm = q[1] - q[2];
        let behind =
            self.a2 * libm::sin(q[1]) + self.a3 * libm::sin(forearm) + self.d5 * libm::sin(forearm + q[3]);
        Branch::new(behind <= 0.0, libm::sin(q[2]) >= 0.0, libm::sin(q[4]) >= 0.0)
    }

    fn folds_rad(&self, q: &Joints) -> [f64; 2] {
        [q[2] + self.from_upright[2], q[4] + self.from_upright[4]]
    }

    fn solve(&self, flange: &Frame, branch: Branch, reference: &Joints) -> Option<Joints> {
        let ahead = self.ahead(flange, branch.shoulder())?;
        let hand = self.hand(flange, &ahead, branch.wrist(), reference)?;
        Some(self.joints(&ahead, &hand, branch.elbow()))
    }

    fn solve_all(&self, flange: &Frame, reference: &Joints) -> Solutions {
        let mut solutions = Solutions::none();
        for front in [true, false] {
            let Some(ahead) = self.ahead(flange, front) else { continue };
            for wrist in [true, false] {
                let Some(hand) = self.hand(flange, &ahead, wrist, reference) else { continue };
                for elbow in [true, false] {
                    solutions.insert(Branch::new(front, elbow, wrist), self.joints(&ahead, &hand, elbow));
                }
            }
        }
        solutions
    }
}
