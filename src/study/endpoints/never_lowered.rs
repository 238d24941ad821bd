//! Pairs when the paper's A* never lowers the g of an open node.
//!
//! Its path then need not be a shortest one, and depends on the goal, so that no single-source search finds it. It is
//! never shorter than a shortest path; pairs are tried whose shortest lengths lie at most a stated excess below
//! the printed ones.

use super::{Case, Pair, search};
use crate::grid::{Grid2, Moves};
use crate::search::{
    Combined, Cost as _, GridGraph, Heap, Octile, OctileAstar, Rules, ScaledOctile, Search, Terms, Ties,
    Update, euclidean_to, sum,
};
use rayon::prelude::*;

/// The pairs for which that A* returns the printed lengths, and what it took.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NeverLowered {
    /// The pairs as start and goal.
    pub pairs: Vec<Pair>,
    /// How many were tried.
    pub candidates: usize,
}

impl NeverLowered {
    /// Tries every ordered pair whose shortest lengths are at most `excess` steps below the printed ones.
    pub fn find(grids: &[&Grid2], moves: &[Moves], cases: &[Case], excess: f64) -> Self {
        let cells = grids.first().map_or(0, |grid| grid.cell_count());
        let searches = || {
            let astar = Search::new(Heap::new(Ties::Fifo));
            (moves.iter().map(search).collect::<Vec<_>>(), astar)
        };
        let found: Vec<(Vec<Pair>, usize)> = (0..cells)
            .into_par_iter()
            .map_init(searches, |(floods, astar), start| {
                let near = near(floods, cases, start, excess);
                let candidates = near.len();
                let is_met = |goal: &u32| {
                    (0..cases.len()).all(|case| {
                        length(astar, grids[case], &moves[case], [start, *goal]) == Some(cases[case].length())
                    })
                };
                (near.into_iter().filter(is_met).map(|goal| [start, goal]).collect(), candidates)
            })
            .collect();
        let candidates = found.iter().map(|(_, candidates)| candidates).sum();
        Self { pairs: found.into_iter().flat_map(|(pairs, _)| pairs).collect(), candidates }
    }
}

/// The goals whose shortest lengths from `start` are within the excess in every case.
fn near(floods: &mut [OctileAstar], cases: &[Case], start: u32, excess: f64) -> Vec<u32> {
    let mut goals: Option<Vec<u32>> = None;
    for (flood, case) in floods.iter_mut().zip(cases) {
        let (target, mut here) = (case.target(), Vec::new());
        let least = target - (excess * f64::from(ScaledOctile::STRAIGHT)) as u32;
        flood.flood(start, target, |cell, cost| {
            if cost >= least {
                here.push(cell);
            }
        });
        here.sort_unstable();
        goals = Some(match goals {
            None => here,
            Some(before) => before.into_iter().filter(|goal| here.binary_search(goal).is_ok()).collect(),
        });
    }
    goals.unwrap_or_default()
}

fn length(
    search: &mut Search<Octile, Heap>,
    grid: &Grid2,
    moves: &Moves,
    [start, goal]: Pair,
) -> Option<Octile> {
    let estimate = Combined { h: euclidean_to(grid, goal), combine: sum };
    let terms = Terms {
        graph: &mut GridGraph::new(moves),
        estimate: &estimate,
        observer: &mut (),
        update: Update { lower_open: false, reopen_closed: false },
    };
    let report = search.run(terms, start, |cell| cell == goal, Rules::default(), &mut ());
    report.outcome.route().map(|route| {
        debug_assert!(route.cost.value() > 0.0, "start and goal differ");
        route.cost
    })
}
