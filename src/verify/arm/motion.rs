//! Motions between two postures, whether the arm stays clear on them, and how deep it goes where it does not.

use super::body::Joints;
use super::{Case, Hops, RESOLUTION_CM, turned};

/// How far the depth that is found may be below the greatest.
const DEPTH_TOLERANCE_CM: f64 = 1e-4;

/// Parts of a motion shorter than this share of it are not halved further.
const LEAST_PART: f64 = 1e-13;

/// Slack for the side of a stretched or folded arm.
const STRAIGHT_RAD: f64 = 1e-7;

/// A hop under way.
#[derive(Debug, Clone, Copy)]
pub(super) enum Motion {
    /// The joints turn evenly.
    Even { from: [f64; 2], by: [f64; 2] },
    /// The tip moves along the straight line, the elbow to its left (1) or right (−1).
    Line { from: [f64; 2], by: [f64; 2], side: f64 },
}

/// A part of a motion as it was looked at: the arm in its middle, and how far no point of it gets from there.
struct Part {
    joints: Joints,
    reach_cm: f64,
}

impl Case<'_> {
    /// The motion from one lattice point to another, in the postures there; none if the arm would have to jump or the tip come
    /// too near to the base.
    pub(super) fn motion(&self, points: [[i32; 2]; 2], postures: [[f64; 2]; 2]) -> Option<Motion> {
        let [from, to] = postures;
        if self.hops != Hops::TipLine {
            return Some(Motion::Even { from, by: turned(from, to) });
        }
        let [side, other] = postures.map(|[_, q2]| {
            let bent = libm::sin(q2);
            if bent.abs() < STRAIGHT_RAD { 0.0 } else { -bent.signum() }
        });
        let [from, to] = points.map(|point| self.at(point));
        let by = [to[0] - from[0], to[1] - from[1]];
        // The height of the triangle over the hop, if its foot lies on it.
        let along = [from, to].map(|[x, y]| x * by[0] + y * by[1]);
        let area = from[0] * to[1] - from[1] * to[0];
        let nearest = self.nearest_cm();
        let dips = along[0] < 0.0
            && along[1] > 0.0
            && area * area < nearest * nearest * (by[0] * by[0] + by[1] * by[1]);
        let side = if side == 0.0 { other } else { side };
        let jumps = side * other < 0.0;
        (!dips && !jumps).then_some(Motion::Line { from, by, side: if side == 0.0 { 1.0 } else { side } })
    }

    /// Whether both links stay clear all the way.
    pub(super) fn is_clear(&self, motion: &Motion) -> bool {
        // An explicit stack: parts [low, high] of the motion that are still to be proved.
        let mut open = vec![[0.0_f64, 1.0]];
        while let Some([low, high]) = open.pop() {
            let Part { joints, reach_cm } = self.part(motion, [low, high]);
            let least = self.gap(&joints);
            if least > reach_cm {
                continue;
            }
            let resolved = reach_cm < RESOLUTION_CM || high - low < LEAST_PART;
            let is_touching = least <= 0.0 || resolved;
            if is_touching && (self.touching_is_contact || (least <= 0.0 && !self.grazes(&joints))) {
                return false;
            }
            if resolved {
                continue;
            }
            let middle = low.midpoint(high);
            open.push([low, middle]);
            open.push([middle, high]);
        }
        true
    }

    /// How deep a link gets into an obstacle on the way: the least shift that would part the two, at its greatest; at most
    /// `DEPTH_TOLERANCE_CM` too little, and 0 if nothing is entered.
    pub(super) fn depth_cm(&self, motion: &Motion) -> f64 {
        let mut open = vec![[0.0_f64, 1.0]];
        let mut deepest = 0.0_f64;
        while let Some([low, high]) = open.pop() {
            let Part { joints, reach_cm } = self.part(motion, [low, high]);
            let here = self.signed_depth(&joints);
            deepest = deepest.max(here);
            // A depth changes by no more than the arm moves.
            if here + reach_cm <= deepest + DEPTH_TOLERANCE_CM || high - low < LEAST_PART {
                continue;
            }
            let middle = low.midpoint(high);
            open.push([low, middle]);
            open.push([middle, high]);
        }
        deepest
    }

    fn part(&self, motion: &Motion, [low, high]: [f64; 2]) -> Part {
        let middle = low.midpoint(high);
        let at = |from: &[f64; 2], by: &[f64; 2], share: f64| [0, 1].map(|i| from[i] + share * by[i]);
        match motion {
            Motion::Even { from, by } => {
                let [l1, l2] = self.links_cm;
                let most = l1 * by[0].abs() + l2 * (by[0] + by[1]).abs();
                Part { joints: self.joints(at(from, by, middle)), reach_cm: (high - low) / 2.0 * most }
            }
            Motion::Line { from, by, side } => {
                let [start, tip, end] = [low, middle, high].map(|share| at(from, by, share));
                let joints = [[0.0, 0.0], self.elbow_beside(tip, *side), tip];
                let tip_cm = (high - low) / 2.0 * (by[0] * by[0] + by[1] * by[1]).sqrt();
                Part { joints, reach_cm: tip_cm.max(self.elbow_reach_cm(start, tip, end)) }
            }
        }
    }

    /// No elbow is farther than this from the one in the middle of the part from `start` to `end` of a line.
    ///
    /// The elbow is `along` the way from base to tip and `beside` it; both depend on the tip's distance alone, and as a
    /// whole they turn with the tip's direction.
    fn elbow_reach_cm(&self, start: [f64; 2], tip: [f64; 2], end: [f64; 2]) -> f64 {
        let [l1, l2] = self.links_cm;
        let norm = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
        let by = [end[0] - start[0], end[1] - start[1]];
        let foot = -(start[0] * by[0] + start[1] * by[1]) / (by[0] * by[0] + by[1] * by[1]);
        let foot = foot.clamp(0.0, 1.0);
        let far = norm(start).max(norm(end));
        let near = norm([start[0] + foot * by[0], start[1] + foot * by[1]]);
        let along = |r: f64| (r * r + l1 * l1 - l2 * l2) / (2.0 * r);
        let beside = |along: f64| (l1 * l1 - along * along).max(0.0).sqrt();
        // Least where its derivative in r vanishes, else at an end.
        let turning = (l1 * l1 - l2 * l2).max(0.0).sqrt().clamp(near, far);
        let span = [near, far, turning].map(along);
        let here = along(norm(tip));
        let most = |of: &dyn Fn(f64) -> f64| {
            span.iter().map(|along| (of(*along) - of(here)).abs()).fold(0.0, f64::max)
        };
        let turn = |to: [f64; 2]| {
            libm::atan2((tip[0] * to[1] - tip[1] * to[0]).abs(), tip[0] * to[0] + tip[1] * to[1])
        };
        most(&|along| along) + most(&beside) + l1 * turn(start).max(turn(end))
    }
}
