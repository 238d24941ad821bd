//! Shorter paths from paths: shortcuts, corners cut as by a B-spline.
//!
//! # Source
//! Thomason, Kingston & Kavraki, *Motions in Microseconds via Vectorized Sampling-Based Planning*, ICRA 2024, and the planner's own
//! `simplify.hh` (VAMP 0.6.4); after Geraerts & Overmars, *Int. J. Robotics Research* 26(8), 845 (2007), and OMPL's
//! `PathSimplifier`.

use super::Motions;
use schemars::JsonSchema;
use serde::Deserialize;

/// One way to shorten a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Operation {
    /// From the start on, each point is joined with the last one that a motion reaches.
    Shortcut,
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

/// The path, shortened in at most `rounds` rounds of `operations`; a motion from end to end ends it at once.
pub fn simplify(
    motions: &mut Motions<'_>,
    mut path: Vec<Vec<f64>>,
    (rounds, operations): (u32, &[Operation]),
    bspline: &BSpline,
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

/// The middle of a leg, or its first end where the motions over the middle are others than the leg's and not free: middles are rounded
/// in the plane, and a tool that goes straight does not pass the middle of the joints' change.
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
