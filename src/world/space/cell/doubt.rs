//! Steps of a path on which a part may touch something between the two checked ends: they are halved and checked again.

use super::lines::between;
use super::way::Way;
use super::{Lines, Rejection, Standing};
use crate::geometry::Capsule;
use crate::kinematics::Joints;
use crate::kinematics::ik::Branch;

/// Half the chord between two places of an axis end, with 2 % for the arc being longer than its chord.
pub(super) const HALF_WAY: f64 = 0.51;
/// How many times a step is halved at most.
pub(super) const HALVINGS: u32 = 3;

/// A path with a step that must be halved.
pub(super) struct UnsettledPath<'a> {
    pub(super) lines: &'a Lines,
    pub(super) way: Option<&'a Way>,
    pub(super) branch: Branch,
    /// The first and the last configuration.
    pub(super) ends_q: [Joints; 2],
}

/// A share of the path, the joints there, and the body placed.
pub(super) type Stop<'a> = (f64, Joints, &'a [Capsule]);

impl UnsettledPath<'_> {
    /// Whether the path is free between two stops.
    pub(super) fn settle(&self, [a, b]: [Stop<'_>; 2], halvings: u32) -> Result<(), Rejection> {
        let cell = self.lines.cell();
        let share = f64::midpoint(a.0, b.0);
        let q = match self.way {
            Some(way) => {
                let found = cell.robot().arm().follow(&way.at(share), self.branch, &a.1);
                found.map_err(|_| Rejection::Unreachable)?
            }
            None => between(&self.ends_q[0], &self.ends_q[1], share),
        };
        let mut placed = Vec::with_capacity(a.2.len());
        cell.place(&q, &mut placed);
        let reach = |part: usize| {
            2.0 * HALF_WAY * axis_way_m(&a.2[part], &placed[part]).max(axis_way_m(&placed[part], &b.2[part]))
        };
        match cell.standing(&placed, reach) {
            Standing::Contact => Err(Rejection::Contact),
            Standing::Near if halvings > 1 => {
                let middle: Stop<'_> = (share, q, &placed);
                self.settle([a, middle], halvings - 1)?;
                self.settle([middle, b], halvings - 1)
            }
            Standing::Clear | Standing::Near => Ok(()),
        }
    }
}

/// The longest distance that an end of a capsule's axis moves in a step.
#[inline]
pub(super) fn axis_way_m(from: &Capsule, to: &Capsule) -> f64 {
    let a = (to.segment.a - from.segment.a).norm_squared();
    let b = (to.segment.b - from.segment.b).norm_squared();
    a.max(b).sqrt()
}
