//! Pairs when the paper's A* never lowers the g of an open node.
//!
//! Its path then need not be a shortest one, and depends on the goal, so that no single-source search finds it. It is
//! never shorter than a shortest path; pairs are tried whose shortest lengths lie at most a stated excess below
//! those asked for. The same trial serves one pair of printed lengths and all targets around it.

use super::{Pair, Targets, search, union};
use crate::search::{FirstWayAstar, OctileAstar, ScaledOctile, Ties};
use base::grid::Moves;
use rayon::prelude::*;

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
            self.cases.iter_mut().for_each(|case| case.astar.aim(goal));
        }
        for start in &starts {
            self.lengths.clear();
            let (cases, excess) = (&mut self.cases, self.excess);
            self.lengths.extend(cases.iter_mut().map_while(|case| case.length(*start, excess)));
            if self.lengths.len() == self.cases.len() {
                meet(*start, &self.lengths);
            }
        }
        starts.len()
    }
}

impl CaseTrial {
    /// The starts whose shortest lengths to `goal` are worth a try; moves are symmetric, so one search from the goal
    /// finds them.
    fn near(&mut self, goal: u32, excess: u32) -> Vec<u32> {
        let ([lowest, highest], mut near) = (self.bounds, Vec::new());
        let shortest = &mut self.shortest;
        shortest.fill(None);
        self.flood.flood(goal, highest, |cell, cost| {
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
        let length = self.astar.length(start, highest.min(shortest + excess))?;
        Some(ScaledOctile::scaled(length)).filter(|length| *length >= lowest)
    }
}
