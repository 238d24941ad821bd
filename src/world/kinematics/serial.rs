//! Serial arms of six revolute joints, by standard Denavit–Hartenberg rows.
//!
//! Row `i` takes frame `i - 1` to frame `i`: turn by `q + offset` about z, move by `d` along z, move by `a`
//! along x, turn by `alpha` about x. So frame `i` is fixed to link `i`, at its far end; frame 0 is the base
//! and frame 6 the flange. The tool is fixed to the flange.
//!
//! Rows of the modified convention, whose frames are at the near ends, are taken too ([`Chain::modified`]) and become these.
//!
//! # Source
//! Siciliano et al., *Robotics: Modelling, Planning and Control* (2009), section 2.8.2; the modified convention: Craig,
//! *Introduction to Robotics* (3rd ed. 2005), eq. 3.6.

use super::{KinematicsError, angle::nearest_copy};
use crate::geometry::{Frame, Vec3};
use nalgebra::{Matrix3, Matrix6};
use std::f64::consts::{PI, TAU};

/// How many joints an arm has.
pub const AXES: usize = 6;

/// One angle a joint, radians, base first.
pub type Joints = [f64; AXES];

/// A joint and the link that it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Twist: from the joint's axis to the next, about x.
    pub alpha_rad: f64,
    /// Length: along x.
    pub a_m: f64,
    /// Offset: along z.
    pub d_m: f64,
    /// Added to the joint angle.
    pub offset_rad: f64,
    /// The least joint angle; minus infinity, with an infinite greatest, of a joint that turns without end.
    pub lower_rad: f64,
    /// The greatest joint angle; infinite, with an infinite least, of a joint that turns without end.
    pub upper_rad: f64,
    /// The greatest speed.
    pub speed_rad_s: f64,
}

impl Joint {
    /// Whether `angle_rad` is within the limits; the limits are.
    pub fn allows(&self, angle_rad: f64) -> bool {
        (self.lower_rad..=self.upper_rad).contains(&angle_rad)
    }

    /// Whether it turns without end: angles that whole turns part are one.
    pub fn is_endless(&self) -> bool {
        self.lower_rad == f64::NEG_INFINITY && self.upper_rad == f64::INFINITY
    }

    /// Where a motion from `from_rad` to `to_rad` ends: a joint that turns without end takes the shorter way round.
    #[inline]
    pub fn toward(&self, from_rad: f64, to_rad: f64) -> f64 {
        if self.is_endless() { nearest_copy(to_rad, from_rad) } else { to_rad }
    }

    /// Limits that lie at most half a turn to either side for a joint that turns without end, its own otherwise.
    pub fn range_rad(&self) -> [f64; 2] {
        if self.is_endless() { [-PI, PI] } else { [self.lower_rad, self.upper_rad] }
    }

    /// Of the angles within the limits that differ from `angle_rad` by whole turns, the one nearest to
    /// `reference_rad`, the lower one if two are; `None` if there is none.
    #[inline]
    pub fn nearest_allowed_copy(&self, angle_rad: f64, reference_rad: f64) -> Option<f64> {
        let near = nearest_copy(angle_rad, reference_rad);
        if self.allows(near) {
            return Some(near);
        }
        let turns = if near < self.lower_rad {
            ((self.lower_rad - angle_rad) / TAU).ceil()
        } else {
            ((self.upper_rad - angle_rad) / TAU).floor()
        };
        let allowed = angle_rad + TAU * turns;
        self.allows(allowed).then_some(allowed)
    }

    /// Every quantity that cannot be, called as in robot files, with what could.
    pub(super) fn faults(&self) -> Vec<(&'static str, f64, &'static str)> {
        let numbers = [
            ("alpha_deg", self.alpha_rad),
            ("a_mm", self.a_m),
            ("d_mm", self.d_m),
            ("offset_deg", self.offset_rad),
            ("lower_deg", self.lower_rad),
            ("upper_deg", self.upper_rad),
            ("speed_deg_s", self.speed_rad_s),
        ];
        let unmeant = |(key, value): (&'static str, f64)| match value {
            _ if self.is_endless() && ["lower_deg", "upper_deg"].contains(&key) => None,
            _ if !value.is_finite() => Some((key, value, "a finite number")),
            _ if value.abs() > LARGEST && key.ends_with("_mm") => Some((key, value, "-10^9 to 10^9")),
            _ if value.abs() > LARGEST => Some((key, value, "at most 10^6 rad, either way")),
            _ => None,
        };
        let mut faults: Vec<_> = numbers.into_iter().filter_map(unmeant).collect();
        let is_fine = |key: &str| faults.iter().all(|(faulty, ..)| *faulty != key);
        let crossed = self.upper_rad <= self.lower_rad && is_fine("lower_deg") && is_fine("upper_deg");
        let stuck = self.speed_rad_s <= 0.0 && is_fine("speed_deg_s");
        faults.extend(crossed.then_some(("upper_deg", self.upper_rad, "more than lower_deg")));
        faults.extend(stuck.then_some(("speed_deg_s", self.speed_rad_s, "more than 0")));
        faults
    }
}

/// Metres, radians and radians a second beyond which nothing is meant, and beyond which single precision overflows.
const LARGEST: f64 = 1e6;

/// Sine and cosine of a twist. A twist that is a multiple of a right angle to within rounding is taken as one. Its sine and
/// cosine are then 0, 1 or -1 and the closed forms that rely on it are exact.
fn twist(alpha_rad: f64) -> (f64, f64) {
    let (s, c) = libm::sincos(alpha_rad);
    let snap = |v: f64| if (v - v.round()).abs() < 1e-12 { v.round() } else { v };
    (snap(s), snap(c))
}

/// The geometry, limits and speeds of an arm, with its place and its tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    joints: [Joint; AXES],
    twists: [(f64, f64); AXES],
    base: Frame,
    tool: Frame,
    /// Whether the rows were written by the modified convention, which has twist and length one row later.
    was_modified: bool,
}

impl Chain {
    /// The chain of `joints` from `base` (in the world), with a tool at `tool` (in the flange).
    ///
    /// # Errors
    /// [`KinematicsError::Joint`] if a number is not finite, limits are crossed, or a speed is not above 0.
    pub fn new(joints: [Joint; AXES], base: Frame, tool: Frame) -> Result<Self, KinematicsError> {
        for (index, joint) in joints.iter().enumerate() {
            if let Some((key, found, accepted)) = joint.faults().into_iter().next() {
                return Err(KinematicsError::joint(index, key, found, accepted));
            }
        }
        let twists = joints.map(|joint| twist(joint.alpha_rad));
        Ok(Self { joints, twists, base, tool, was_modified: false })
    }

    /// The chain of rows by the modified convention, and the frames of that convention, each in the frame of the same link
    /// here.
    ///
    /// Row `i` of `rows` moves by its `a` along x and turns by its `alpha` about x before it turns by `q + offset` and moves
    /// by `d` along z. Joint angles mean the same; the first row's `a` and `alpha` become a part of the base.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn modified(
        rows: [Joint; AXES],
        base: Frame,
        tool: Frame,
    ) -> Result<(Self, [Frame; AXES + 1]), KinematicsError> {
        Self::new(rows, base, tool)?;
        let before = rows.map(|row| {
            let (s, c) = twist(row.alpha_rad);
            let rotation = Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c);
            Frame { rotation, origin: Vec3::x() * row.a_m }
        });
        let joints = std::array::from_fn(|i| match rows.get(i + 1) {
            Some(next) => Joint { alpha_rad: next.alpha_rad, a_m: next.a_m, ..rows[i] },
            None => Joint { alpha_rad: 0.0, a_m: 0.0, ..rows[i] },
        });
        let near = std::array::from_fn(|link| before.get(link).map_or(Frame::IDENTITY, Frame::inverse));
        let chain = Self::new(joints, base * before[0], tool)?;
        Ok((Self { was_modified: true, ..chain }, near))
    }

    /// The row, from 0, in which the quantity `key` of row `i` was written.
    pub(super) fn written_in(&self, i: usize, key: &str) -> usize {
        i + usize::from(self.was_modified && ["alpha_deg", "a_mm"].contains(&key))
    }

    /// The joints, base first.
    pub fn joints(&self) -> &[Joint; AXES] {
        &self.joints
    }

    /// Sine and cosine of each twist, exact at right angles.
    pub(super) fn twists(&self) -> &[(f64, f64); AXES] {
        &self.twists
    }

    /// The base in the world.
    pub fn base(&self) -> &Frame {
        &self.base
    }

    /// The tool in the flange.
    pub fn tool(&self) -> &Frame {
        &self.tool
    }

    /// The same chain with another tool.
    #[must_use]
    pub fn with_tool(&self, tool: Frame) -> Self {
        Self { tool, ..self.clone() }
    }

    /// The same chain, its world put at `base` of another world.
    #[must_use]
    pub fn placed(&self, base: &Frame) -> Self {
        Self { base: *base * self.base, ..self.clone() }
    }

    /// Where a motion straight in joint space from `from` to `to` ends: `to`, by whole turns of joints that turn without end.
    pub fn toward(&self, from: &Joints, to: &Joints) -> Joints {
        std::array::from_fn(|i| self.joints[i].toward(from[i], to[i]))
    }

    /// Whether every joint is within its limits.
    pub fn allows(&self, q: &Joints) -> bool {
        self.joints.iter().zip(q).all(|(joint, &angle)| joint.allows(angle))
    }

    /// The base, the frame of each link, and so the flange, in the world.
    #[inline]
    pub fn frames(&self, q: &Joints) -> [Frame; AXES + 1] {
        let mut frames = [self.base; AXES + 1];
        for i in 0..AXES {
            frames[i + 1] = self.next(&frames[i], i, q[i]);
        }
        frames
    }

    /// Frame `i + 1` from frame `i`, column by column: a quarter of the work of a matrix product.
    #[inline]
    fn next(&self, frame: &Frame, i: usize, angle_rad: f64) -> Frame {
        let joint = &self.joints[i];
        let (sin_alpha, cos_alpha) = self.twists[i];
        let (s, c) = libm::sincos(angle_rad + joint.offset_rad);
        let [x, y, z] = [frame.axis(0), frame.axis(1), frame.axis(2)];
        let turned_x = x * c + y * s;
        let turned_y = y * c - x * s;
        Frame {
            origin: frame.origin + z * joint.d_m + turned_x * joint.a_m,
            rotation: Matrix3::from_columns(&[
                turned_x,
                turned_y * cos_alpha + z * sin_alpha,
                z * cos_alpha - turned_y * sin_alpha,
            ]),
        }
    }

    /// The flange in the world.
    #[inline]
    pub fn flange(&self, q: &Joints) -> Frame {
        (0..AXES).fold(self.base, |frame, i| self.next(&frame, i, q[i]))
    }

    /// The tool in the world.
    #[inline]
    pub fn forward(&self, q: &Joints) -> Frame {
        self.flange(q) * self.tool
    }

    /// How `point` (in the world), fixed to link `link` (6 for flange and tool), moves with each joint.
    ///
    /// Rows 0 to 2 are its velocity in metres a radian, rows 3 to 5 the link's rotation in radians a radian,
    /// both in the world; columns are joints. Joints beyond the link have zero columns. `frames` are those of
    /// [`frames`](Self::frames).
    ///
    /// # Panics
    /// If `link` is above 6.
    ///
    /// # Source
    /// Siciliano et al. (2009), eq. 3.30.
    pub fn jacobian(frames: &[Frame; AXES + 1], link: usize, point: &Vec3) -> Matrix6<f64> {
        let mut jacobian = Matrix6::zeros();
        for (column, frame) in frames[..link].iter().enumerate() {
            let axis = frame.axis(2);
            jacobian.fixed_view_mut::<3, 1>(0, column).copy_from(&axis.cross(&(point - frame.origin)));
            jacobian.fixed_view_mut::<3, 1>(3, column).copy_from(&axis);
        }
        jacobian
    }
}
