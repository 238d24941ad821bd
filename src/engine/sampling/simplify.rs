//! Shorter paths from paths: shortcuts, fewer vertices, corners cut as by a B-spline.
//!
//! # Source
//! Thomason, Kingston & Kavraki, *Motions in Microseconds via Vectorized Sampling-Based Planning*, ICRA 2024, and the planner's own
//! `simplify.hh` (VAMP 0.6.4); after Geraerts & Overmars, *Int. J. Robotics Research* 26(8), 845 (2007), and OMPL's
//! `PathSimplifier`.

use super::{Draw, Motions};
use schemars::JsonSchema;
use serde::Deserialize;

/// One way to shorten a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Operation {
    /// From the start on, each point is joined with the last one that a motion reaches.
    Shortcut,
    /// Points between two that are drawn are left out if a motion joins the two.
    Reduce,
    /// Points are put in the middle of every leg, and corners between them are cut.
    Bspline,
}

/// How corners are cut.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BSpline {
    /// Rounds at most.
    pub rounds: u32,
    /// A point that would move less is left where it is.
    #[schemars(range(min = 0))]
    pub least_change: f64,
    /// How far along both legs from a corner the points are whose middle takes its place.
    #[schemars(range(min = 0, max = 1))]
    pub share: f64,
}

/// How vertices are left out.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reduce {
    /// Tries at least.
    pub tries: u32,
    /// Tries without success after which it stops.
    pub empty_tries: u32,
    /// How many points apart the two that are drawn may be, as a share of all.
    #[schemars(range(min = 0, max = 1))]
    pub range_share: f64,
}

/// The path, shortened in at most `rounds` rounds of `operations`; a motion from end to end ends it at once.
pub fn simplify(
    motions: &mut Motions<'_>,
    draw: &mut Draw,
    mut path: Vec<Vec<f64>>,
    (rounds, operations): (u32, &[Operation]),
    (bspline, reduce): (&BSpline, &Reduce),
) -> Vec<Vec<f64>> {
    if path.len() < 3 {
        return path;
    }
    if motions.goes(&path[0], &path[path.len() - 1]) {
        path.drain(1..path.len() - 1);
        return path;
    }
    for _ in 0..rounds {
        let mut changed = false;
        for operation in operations {
            changed |= path.len() > 2
                && match operation {
                    Operation::Shortcut => shortcut(motions, &mut path),
                    Operation::Reduce => leave_out(motions, draw, &mut path, reduce),
                    Operation::Bspline => cut_corners(motions, &mut path, bspline),
                };
        }
        if !changed {
            break;
        }
    }
    path
}

fn shortcut(motions: &mut Motions<'_>, path: &mut Vec<Vec<f64>>) -> bool {
    let mut changed = false;
    let mut from = 0;
    while from + 2 < path.len() {
        let reached = (from + 2..path.len()).rev().find(|to| motions.goes(&path[from], &path[*to]));
        if let Some(to) = reached {
            path.drain(from + 1..to);
            changed = true;
        }
        from += 1;
    }
    changed
}

fn leave_out(motions: &mut Motions<'_>, draw: &mut Draw, path: &mut Vec<Vec<f64>>, rule: &Reduce) -> bool {
    let mut changed = false;
    let (mut tries, mut empty) = (0, 0);
    while tries < rule.tries || empty < rule.empty_tries {
        tries += 1;
        empty += 1;
        let last = path.len() - 1;
        let range = 1 + (0.5 + path.len() as f64 * rule.range_share).floor() as usize;
        let one = draw.whole(0, last);
        let mut other = draw.whole(one.saturating_sub(range), last.min(one + range));
        if one.abs_diff(other) < 2 {
            other = match one {
                _ if one + 1 < last => one + 2,
                2.. => one - 2,
                _ => continue,
            };
        }
        let (from, to) = (one.min(other), one.max(other));
        if motions.goes(&path[from], &path[to]) {
            path.drain(from + 1..to);
            empty = 0;
            changed = true;
        }
    }
    changed
}

/// The middle of a leg, or its first end where the motions over the middle differ from the leg's and are not free.
/// Middles are rounded in the plane, and a tool that goes straight does not pass the middle of the joints' change.
fn halfway(motions: &mut Motions<'_>, [from, to]: [&Vec<f64>; 2]) -> Vec<f64> {
    let middle = motions.between(from, to, 0.5);
    let is_free = motions.pass_middles() || motions.goes(from, &middle) && motions.goes(&middle, to);
    if is_free { middle } else { from.clone() }
}

fn cut_corners(motions: &mut Motions<'_>, path: &mut Vec<Vec<f64>>, rule: &BSpline) -> bool {
    let mut changed = false;
    for _ in 0..rule.rounds {
        let mut halved = vec![path[0].clone()];
        for leg in path.windows(2) {
            halved.push(halfway(motions, [&leg[0], &leg[1]]));
            halved.push(leg[1].clone());
        }
        *path = halved;
        let mut moved = false;
        for corner in (2..path.len() - 1).step_by(2) {
            let [before, after] = [corner - 1, corner + 1]
                .map(|beside| motions.between(&path[corner], &path[beside], rule.share));
            let middle = motions.between(&before, &after, 0.5);
            if motions.distance(&path[corner], &middle) > rule.least_change
                && motions.goes(&path[corner - 1], &middle)
                && motions.goes(&middle, &path[corner + 1])
            {
                path[corner] = middle;
                moved = true;
            }
        }
        changed |= moved;
        if !moved {
            break;
        }
    }
    path.dedup();
    changed
}
