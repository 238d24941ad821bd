//! Chains in the form that a closed form is written for.
//!
//! One arm has many Denavit–Hartenberg tables: an axis may point either way, a length may be negative, and an offset along
//! parallel axes may stand in the row of any of them. A [`Shape`] says which tables a closed form covers; [`Form`] rewrites such
//! a table, by steps that leave the flange where it is:
//!
//! - an axis turned round, by `Rx(π) Rz(θ) Tz(d) = Rz(-θ) Tz(-d) Rx(π)`;
//! - a negative length made positive, by `Tx(-a) Rx(α) = Rz(π) Tx(a) Rx(-α) Rz(-π)`;
//! - length and twist of the sixth row taken off the flange.
//!
//! What needs none of them is left as it is, to the last bit.

use super::{AXES, Chain, Frame, Joints, KinematicsError};
use crate::geometry::Vec3;
use std::f64::consts::PI;

/// Below this many metres, a length counts as 0: it is left by rounding where frames were computed.
const ROUNDING_M: f64 = 1e-12;

/// Which twists a row may have.
#[derive(Debug, Clone, Copy)]
pub(super) enum Twist {
    Any,
    /// A right angle; its sign is the formulas' concern.
    Right,
    /// The twist with this sine and cosine or the one half a turn away, which is made this one.
    Made(f64, f64),
}

/// Which lengths or offsets a row may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Length {
    Any,
    Zero,
    /// Made positive.
    NotZero,
}

/// Which tables a closed form covers.
pub(super) struct Shape {
    pub solver: &'static str,
    pub twists: [Twist; AXES],
    pub a: [Length; AXES],
    pub d: [Length; AXES],
}

impl Shape {
    /// Refuses a chain that has another shape.
    fn check(&self, chain: &Chain) -> Result<(), KinematicsError> {
        for (i, joint) in chain.joints().iter().enumerate() {
            let (s, c) = chain.twists()[i];
            let accepted = match self.twists[i] {
                Twist::Right | Twist::Made(_, 0.0) if c != 0.0 => Some("90 or -90"),
                Twist::Made(0.0, _) if s != 0.0 => Some("0 or 180"),
                _ => None,
            };
            let twist = accepted.map(|accepted| ("alpha_deg", joint.alpha_rad, accepted));
            let length = |key, found_m: f64, accepted| match accepted {
                Length::Zero if found_m.abs() > ROUNDING_M => Some((key, found_m, "0")),
                Length::NotZero if found_m.abs() <= ROUNDING_M => {
                    Some((key, found_m, "another number than 0"))
                }
                _ => None,
            };
            let fault = twist
                .or_else(|| length("a_mm", joint.a_m, self.a[i]))
                .or_else(|| length("d_mm", joint.d_m, self.d[i]));
            if let Some((key, found, accepted)) = fault {
                return Err(self.refusal(chain, i, key, found, accepted));
            }
        }
        Ok(())
    }

    /// The refusal of a row, counted from 0, for a quantity in metres or radians.
    pub fn refusal(
        &self,
        chain: &Chain,
        row: usize,
        key: &'static str,
        found: f64,
        accepted: &str,
    ) -> KinematicsError {
        let accepted = format!("{accepted}, for the solver `{}`", self.solver);
        KinematicsError::joint(chain.written_in(row, key), key, found, &accepted)
    }
}

/// From joint angles to the angles of the rewritten rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turns {
    pub signs: Joints,
    pub offsets: Joints,
}

impl Turns {
    #[inline]
    pub fn theta(&self, i: usize, q: &Joints) -> f64 {
        self.signs[i] * q[i] + self.offsets[i]
    }

    #[inline]
    pub fn joints(&self, theta: &Joints) -> Joints {
        std::array::from_fn(|i| self.signs[i] * (theta[i] - self.offsets[i]))
    }

    /// The same with other angles counted as zero.
    pub fn counted_from(mut self, zero: &Joints) -> Self {
        self.offsets.iter_mut().zip(zero).for_each(|(offset, zero)| *offset -= zero);
        self
    }

    /// Whether joint angles equal those of the original rows, apart from offsets.
    pub fn keep_directions(&self) -> bool {
        self.signs == [1.0; AXES]
    }
}

/// A chain's rows as its closed form wants them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form {
    pub turns: Turns,
    pub a: Joints,
    pub d: Joints,
    pub twists: [(f64, f64); AXES],
    /// From the flange back to frame 6 of the rewritten rows.
    pub behind: Option<Frame>,
}

impl Form {
    /// The form of `chain` in `shape`.
    pub fn new(chain: &Chain, shape: &Shape) -> Result<Self, KinematicsError> {
        shape.check(chain)?;
        let joints = chain.joints();
        let mut form = Self {
            turns: Turns { signs: [1.0; AXES], offsets: joints.map(|joint| joint.offset_rad) },
            a: joints.map(|joint| joint.a_m),
            d: joints.map(|joint| joint.d_m),
            twists: *chain.twists(),
            behind: None,
        };
        for i in 0..AXES - 1 {
            if shape.a[i] == Length::NotZero && form.a[i] < 0.0 {
                form.make_positive(i);
            }
            if let Twist::Made(s, c) = shape.twists[i]
                && form.twists[i] != (s, c)
            {
                form.twists[i] = (s, c);
                form.turn_round(i + 1);
            }
        }
        form.take_off_flange();
        Ok(form)
    }

    fn make_positive(&mut self, i: usize) {
        self.a[i] = -self.a[i];
        self.twists[i].0 = -self.twists[i].0;
        self.turns.offsets[i] += PI;
        self.turns.offsets[i + 1] += PI;
    }

    /// Lets the axis of joint `i` point the other way; the twist of the row before it is the caller's.
    fn turn_round(&mut self, i: usize) {
        self.turns.signs[i] = -self.turns.signs[i];
        self.turns.offsets[i] = -self.turns.offsets[i];
        self.d[i] = -self.d[i];
        let (s, c) = self.twists[i];
        self.twists[i] = (-s, -c);
    }

    fn take_off_flange(&mut self) {
        let (a, (s, c)) = (self.a[AXES - 1], self.twists[AXES - 1]);
        if a != 0.0 || (s, c) != (0.0, 1.0) {
            let last = Frame::at(Vec3::x() * a) * Frame::turned(&Vec3::x(), libm::atan2(s, c));
            self.behind = Some(last.inverse());
        }
    }

    /// Frame 6 of the rewritten rows, where the flange is at `flange`.
    #[inline]
    pub fn last_frame(&self, flange: &Frame) -> Frame {
        match &self.behind {
            Some(behind) => *flange * *behind,
            None => *flange,
        }
    }
}

/// `length_m`, or 0 if it is left by rounding.
pub(super) fn without_rounding(length_m: f64) -> f64 {
    if length_m.abs() <= ROUNDING_M { 0.0 } else { length_m }
}
