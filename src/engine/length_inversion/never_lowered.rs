//! Pairs when the paper's A* never lowers the g of an open node.
//!
//! Its path then need not be a shortest one, and depends on the goal, so that no single-source search finds it. It is
//! never shorter than a shortest path; pairs are tried whose shortest lengths lie at most a stated excess below
//! those asked for. The same trial serves one pair of printed lengths and all targets around it.

use super::{Pair, Targets, search, union};
use crate::search::{FirstWayAstar, OctileAstar, ScaledOctile, Ties};
use base::grid::Moves;
use rayon::prelude::*;
use std::cmp::Reverse;

/// The pairs for which that A* returns the printed lengths, and what it took.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NeverLowered {
    /// The pairs as start and goal, in rising order.
    pub pairs: Vec<Pair>,
    /// How many were tried.
    pub candidates: usize,
}

impl NeverLowered {
    /// Tries every ordered pair whose shortest lengths are at most `excess` steps below `lengths`, one a case.
    pub fn find(moves: &[Moves], lengths: &[u32], excess: f64, ties: Ties) -> Self {
        let cells = moves.first().map_or(0, Moves::cell_count);
        let printed = || Trial::new(moves, lengths.iter().map(|length| [*length; 2]), excess, ties);
        let found: Vec<(Vec<Pair>, usize)> = (0..cells)
            .into_par_iter()
            .map_init(printed, |trial, goal| {
                let mut pairs = Vec::new();
                let candidates = trial.towards(goal, |start, _| pairs.push([start, goal]));
                (pairs, candidates)
            })
            .collect();
        let candidates = found.iter().map(|(_, candidates)| candidates).sum();
        let mut pairs: Vec<Pair> = found.into_iter().flat_map(|(pairs, _)| pairs).collect();
        pairs.sort_unstable();
        Self { pairs, candidates }
    }

    /// Which `targets`, by number, this search would have found a pair for.
    pub fn hits(targets: &Targets, moves: &[Moves; 2], excess: f64, ties: Ties) -> Vec<bool> {
        let bounds = || [0, 1].map(|case| targets.bounds(case));
        let begun = || (Trial::new(moves, bounds(), excess, ties), targets.none());
        let mark = |(mut trial, mut hits): (Trial, Vec<bool>), goal| {
            trial.towards(goal, |_, lengths| targets.mark(&mut hits, [lengths[0], lengths[1]]));
            (trial, hits)
        };
        let goals = (0..moves[0].cell_count()).into_par_iter();
        goals.fold(begun, mark).map(|(_, hits)| hits).reduce(|| targets.none(), union)
    }
}

/// That A* in all cases, with what the trials of one thread share. Lengths are in the units of [`ScaledOctile`].
struct Trial {
    cases: Vec<CaseTrial>,
    excess: u32,
    lengths: Vec<u32>,
}

struct CaseTrial {
    /// The least and the largest length that is asked for.
    bounds: [u32; 2],
    flood: OctileAstar,
    astar: FirstWayAstar,
    /// The shortest length from each cell to the goal where it is worth a try.
    shortest: Vec<Option<u32>>,
    /// The shortest length from each cell to the goal, `u32::MAX` where that is above what is asked for.
    least: Vec<u32>,
    /// How many searches were in vain.
    vain: usize,
}

impl Trial {
    fn new(
        moves: &[Moves],
        bounds: impl IntoIterator<Item = [u32; 2]>,
        excess_steps: f64,
        ties: Ties,
    ) -> Self {
        let case = |(moves, bounds): (&Moves, [u32; 2])| CaseTrial {
            bounds,
            flood: search(moves),
            astar: FirstWayAstar::new(moves, ties),
            shortest: vec![None; moves.cell_count() as usize],
            least: vec![u32::MAX; moves.cell_count() as usize],
            vain: 0,
        };
        Self {
            cases: moves.iter().zip(bounds).map(case).collect(),
            excess: (excess_steps * f64::from(ScaledOctile::STRAIGHT)) as u32,
            lengths: Vec::new(),
        }
    }

    /// Tells `meet` each start from which A* reaches `goal` at a length within the bounds and the excess in every case,
    /// with these lengths; gives how many starts were tried.
    fn towards(&mut self, goal: u32, mut meet: impl FnMut(u32, &[u32])) -> usize {
        let mut starts: Option<Vec<u32>> = None;
        for case in &mut self.cases {
            let near = case.near(goal, self.excess);
            starts = Some(match starts {
                None => near,
                Some(before) => {
                    before.into_iter().filter(|start| case.shortest[*start as usize].is_some()).collect()
                }
            });
        }
        let starts = starts.unwrap_or_default();
        if !starts.is_empty() {
            self.cases.iter_mut().for_each(|case| case.astar.aim_within(goal, &case.least));
        }
        // One case in vain spares the others: the one that mostly is goes first.
        let mut order: Vec<usize> = (0..self.cases.len()).collect();
        order.sort_by_key(|case| Reverse(self.cases[*case].vain));
        for start in &starts {
            if self.reaches(*start, &order) {
                meet(*start, &self.lengths);
            }
        }
        starts.len()
    }

    /// Whether A* from `start` has a length within the bounds and the excess in every case, looked at in this `order`; the
    /// lengths are kept.
    fn reaches(&mut self, start: u32, order: &[usize]) -> bool {
        self.lengths.clear();
        self.lengths.resize(self.cases.len(), 0);
        order.iter().all(|index| {
            let found = self.cases[*index].length(start, self.excess);
            self.lengths[*index] = found.unwrap_or_default();
            found.is_some()
        })
    }
}

impl CaseTrial {
    /// The starts whose shortest lengths to `goal` are worth a try; moves are symmetric, so one search from the goal
    /// finds them.
    fn near(&mut self, goal: u32, excess: u32) -> Vec<u32> {
        let ([lowest, highest], mut near) = (self.bounds, Vec::new());
        let (shortest, least) = (&mut self.shortest, &mut self.least);
        shortest.fill(None);
        least.fill(u32::MAX);
        self.flood.flood(goal, highest, |cell, cost| {
            least[cell as usize] = cost;
            if cost + excess >= lowest {
                shortest[cell as usize] = Some(cost);
                near.push(cell);
            }
        });
        near
    }

    /// What A* from `start` returns if that is within the bounds and the excess.
    fn length(&mut self, start: u32, excess: u32) -> Option<u32> {
        let ([lowest, highest], shortest) = (self.bounds, self.shortest[start as usize]?);
        let length = self.astar.length(start, highest.min(shortest + excess)).map(ScaledOctile::scaled);
        let found = length.filter(|length| *length >= lowest);
        self.vain += usize::from(found.is_none());
        found
    }
}
