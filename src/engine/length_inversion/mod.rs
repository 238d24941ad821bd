//! Which pairs of cells have given path lengths in several cases at once: the inverse of planning.
//!
//! A paper may print the lengths of its paths and not where they start and end. Every pair is enumerated here, by exact
//! single-source searches (h = 0) from all cells but those that lie too near to each other; lengths are sums of straight and diagonal moves and are compared
//! exactly, in the units of [`ScaledOctile`](crate::search::ScaledOctile). [`Targets`] asks how many other lengths would
//! have been met as well. [`NeverLowered`] does both for an A* whose paths need not be shortest.
//!
//! What is left open gives each case several grids; [`Match`] says which of them go together.

mod choices;
mod never_lowered;
mod targets;
#[cfg(test)]
mod tests;

use crate::search::{GridSet, OctileAstar};
use base::grid::Moves;
use choices::{Choices, Starts};
use rayon::prelude::*;

pub use choices::Match;
pub use never_lowered::NeverLowered;
pub use targets::{Met, Targets};

/// Two cells: start and goal, or the smaller number first where both ways are as long.
pub type Pair = [u32; 2];

/// For each alternative every pair whose shortest lengths are `lengths`, one a case, in rising order.
///
/// `cases` are the grids of each case. There is one alternative for each grid of a case if they are matched
/// [`Match::ByPlace`], and a single one if [`Match::Freely`].
///
/// # Panics
/// If grids differ in size, or places are to match and cases have different numbers of grids.
pub fn pairs(cases: &[Vec<Moves>], lengths: &[u32], rule: Match) -> Vec<Vec<Pair>> {
    let batches = choices::batches(cases, rule);
    let found = batches.into_iter().flat_map(|(alternatives, cases)| {
        let starts = Starts::new(&cases, lengths);
        let of_start = |cases: &mut Vec<Choices>, start: u32| {
            let goals = goals(cases, lengths, |goal| starts.counts(start, goal), start);
            let pair = |(goal, met): (u32, GridSet)| ([start.min(goal), start.max(goal)], met);
            goals.into_iter().map(pair).collect::<Vec<_>>()
        };
        let mut found: Vec<(Pair, GridSet)> =
            starts.cells().map_init(|| cases.clone(), of_start).flatten_iter().collect();
        found.sort_unstable();
        (0..alternatives).map(move |place| {
            found.iter().filter(|(_, met)| met >> place & 1 == 1).map(|(pair, _)| *pair).collect()
        })
    });
    found.collect()
}

/// The goals that count and are at the length of every case, with the alternatives for which they are; a case is searched only
/// while goals remain, those that take few searches first.
fn goals(
    cases: &mut [Choices],
    lengths: &[u32],
    counts: impl Fn(u32) -> bool,
    start: u32,
) -> Vec<(u32, GridSet)> {
    let mut order: Vec<usize> = (0..cases.len()).collect();
    order.sort_by_key(|case| cases[*case].search_count());
    let mut goals: Option<Vec<(u32, GridSet)>> = None;
    for case in order {
        let mut here = Vec::new();
        cases[case].flood(start, lengths[case], |cell, cost, met| {
            if cost == lengths[case] && counts(cell) {
                here.push((cell, met));
            }
        });
        goals = Some(match goals {
            None => merged(here),
            Some(before) => both(&before, &merged(here)),
        });
        if goals.as_ref().is_some_and(Vec::is_empty) {
            break;
        }
    }
    goals.unwrap_or_default()
}

/// Each cell once, in rising order.
fn merged(mut cells: Vec<(u32, GridSet)>) -> Vec<(u32, GridSet)> {
    cells.sort_unstable();
    cells.dedup_by(|later, kept| {
        let is_same = later.0 == kept.0;
        kept.1 |= if is_same { later.1 } else { 0 };
        is_same
    });
    cells
}

/// The cells of both, with what is met in both.
fn both(one: &[(u32, GridSet)], other: &[(u32, GridSet)]) -> Vec<(u32, GridSet)> {
    let in_other = |cell: u32| other.binary_search_by_key(&cell, |found| found.0).map_or(0, |at| other[at].1);
    let kept = one.iter().map(|&(cell, met)| (cell, met & in_other(cell)));
    kept.filter(|(_, met)| *met != 0).collect()
}

/// What is set in either.
pub fn union<T: Copy + std::ops::BitOrAssign>(mut one: Vec<T>, other: Vec<T>) -> Vec<T> {
    one.iter_mut().zip(other).for_each(|(one, other)| *one |= other);
    one
}

fn search(moves: &Moves) -> OctileAstar {
    OctileAstar::new(moves).expect("a workspace is smaller than the search's largest grid")
}
