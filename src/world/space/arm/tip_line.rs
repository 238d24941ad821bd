//! Whether both links stay clear while the tip moves along a straight line, the arm bent to one side.
//!
//! A part of the line is proved clear as in [`sweep`](super::sweep): in its middle, each link is farther from every
//! obstacle than any of its points can be from there on the part. Points of link 1 move less than the elbow does, those of
//! link 2 less than the elbow or the tip does.

use super::sweep::{RESOLUTION_CM, Sweep};
use crate::geometry::Vec2;
use crate::geometry::planar::Touch;

/// Parts of the line shorter than this share of it are not halved further.
const LEAST_PART: f64 = 1e-12;

/// A straight way of the tip.
#[derive(Clone, Copy)]
pub(super) struct TipLine {
    pub(super) from: Vec2,
    pub(super) to: Vec2,
    /// Whether θ2 is positive along it.
    pub(super) is_positive: bool,
}

impl TipLine {
    /// The way from one tip and posture to another; `None` where the arm bends to different sides at its ends, so that it
    /// would have to jump.
    pub(super) fn new(tips: [Vec2; 2], postures: [[f64; 2]; 2]) -> Option<Self> {
        let [one, two] = postures.map(|[_, q2]| q2);
        let [from, to] = tips;
        (one * two >= 0.0).then_some(Self { from, to, is_positive: one + two > 0.0 })
    }

    /// Whether it comes nearer to the base than `radius_cm` between its ends.
    pub(super) fn dips_below(&self, radius_cm: f64) -> bool {
        let way = self.to - self.from;
        let is_between = self.from.dot(&way) < 0.0 && self.to.dot(&way) > 0.0;
        let cross = self.from.x * way.y - self.from.y * way.x;
        is_between && cross * cross < radius_cm * radius_cm * way.norm_squared()
    }

    fn at(&self, share: f64) -> Vec2 {
        self.from + (self.to - self.from) * share
    }
}

impl Sweep<'_> {
    /// Whether the motion along `line` is clear.
    pub(super) fn is_line_free(&self, line: TipLine) -> bool {
        self.is_line_part_free(line, [0.0, 1.0])
    }

    fn is_line_part_free(&self, line: TipLine, [low, high]: [f64; 2]) -> bool {
        let middle = low.midpoint(high);
        let [start, tip, end] = [low, middle, high].map(|share| line.at(share));
        let Ok(branches) = self.arm.inverse(&tip) else { return false };
        let posture = if line.is_positive { branches.positive } else { branches.negative };
        let elbow_cm = self.elbow_travel_cm([start, tip, end]);
        let travel_cm = [elbow_cm, elbow_cm.max((end - start).norm() / 2.0)];
        let links = self.links(posture);
        let distances = self.distances(&links);
        if (0..2).all(|link| distances[link] > travel_cm[link] + RESOLUTION_CM) {
            return true;
        }
        if distances.contains(&0.0) && links.iter().any(|link| self.meets(link)) {
            return false;
        }
        if travel_cm[1] < RESOLUTION_CM || high - low < LEAST_PART {
            return self.touch == Touch::Free;
        }
        [[low, middle], [middle, high]].into_iter().all(|part| self.is_line_part_free(line, part))
    }

    /// No elbow on the part from `start` to `end` is farther from the one at `tip`, its middle.
    ///
    /// Link 1 lies at the tip's polar angle, which rises or falls all along a line, plus or minus its angle to the way from
    /// base to tip. That angle depends on the tip's distance alone and is largest where link 2 is square to that way.
    fn elbow_travel_cm(&self, [start, tip, end]: [Vec2; 3]) -> f64 {
        let [l1, l2] = self.arm.links();
        let turned = |to: Vec2| {
            let cross = tip.x * to.y - tip.y * to.x;
            libm::atan2(cross, tip.dot(&to)).abs()
        };
        let way = end - start;
        let foot = (-start.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        let nearest = (start + way * foot).norm();
        let farthest = start.norm().max(end.norm());
        let square = (l1 * l1 - l2 * l2).max(0.0).sqrt().clamp(nearest, farthest);
        let opening = |r: f64| libm::acos(((r * r + l1 * l1 - l2 * l2) / (2.0 * l1 * r)).clamp(-1.0, 1.0));
        let here = opening(tip.norm());
        let opened = [nearest, farthest, square].map(|r| (opening(r) - here).abs());
        let opened = opened.into_iter().fold(0.0, f64::max);
        l1 * (turned(start).max(turned(end)) + opened)
    }
}
