//! Pairs when the paper's A* never lowers the g of an open node.
//!
//! Its path then need not be a shortest one, and depends on the goal, so that no single-source search finds it. It is
//! never shorter than a shortest path; pairs are tried whose shortest lengths lie at most a stated excess below
//! those requested. The same trial serves one pair of printed lengths and all targets around it, and all orders among equal
//! f where these do not matter.

use super::{Pair, Targets, search, union};
use crate::search::{FirstWayAstar, FirstWayBack, OctileAstar, ScaledOctile, Ties};
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
    /// Tries every ordered pair whose shortest lengths are at most `excess` steps below `lengths`, one a case, for each order of
    /// `ties`.
    pub fn find(moves: &[Moves], lengths: &[u32], excess: f64, ties: &[Ties]) -> Vec<Self> {
        let bounds: Vec<[u32; 2]> = lengths.iter().map(|length| [*length; 2]).collect();
        let Tried { candidates, met, open } = Tried::all(moves, &bounds, excess);
        let found = |ties: &Ties| {
            let forwards = settled(&open, moves, &bounds, *ties);
            let mut pairs: Vec<Pair> = met.iter().chain(&forwards).map(|met| met.pair).collect();
            pairs.sort_unstable();
            Self { pairs, candidates }
        };
        ties.iter().map(found).collect()
    }

    /// Which `targets`, by number, this search would have found a pair for, for each order of `ties`.
    pub fn hits(targets: &Targets, moves: &[Moves; 2], excess: f64, ties: &[Ties]) -> Vec<Vec<bool>> {
        let bounds = [0, 1].map(|case| targets.bounds(case));
        let Tried { met, open, .. } = Tried::all(moves, &bounds, excess);
        let marked = |met: &[Met]| {
            let mut hits = targets.none();
            for met in met {
                targets.mark(&mut hits, [met.lengths[0], met.lengths[1]]);
            }
            hits
        };
        let of_all = marked(&met);
        let hits = |ties: &Ties| union(of_all.clone(), marked(&settled(&open, moves, &bounds, *ties)));
        ties.iter().map(hits).collect()
    }
}

/// A pair with the lengths that A* returns, one a case, in the units of [`ScaledOctile`].
struct Met {
    pair: Pair,
    lengths: Vec<u32>,
}

/// A pair whose lengths in some cases take a search forwards.
struct Open {
    pair: Pair,
    cases: Vec<Length>,
}

/// A length, in the units of [`ScaledOctile`].
#[derive(Clone, Copy)]
enum Length {
    /// It is this one.
    Known(u32),
    /// It is not known; beyond this it is of no use.
    AtMost(u32),
}

/// What comes out where the order among equals does not matter.
#[derive(Default)]
struct Tried {
    /// How many pairs were tried.
    candidates: usize,
    met: Vec<Met>,
    open: Vec<Open>,
}

impl Tried {
    /// All pairs whose shortest lengths are within `bounds`, or by an excess below them.
    fn all(moves: &[Moves], bounds: &[[u32; 2]], excess_steps: f64) -> Self {
        let excess = (excess_steps * f64::from(ScaledOctile::STRAIGHT)) as u32;
        let begun = || {
            let case = |(moves, bounds): (&Moves, &[u32; 2])| CaseTrial::new(moves, *bounds);
            (moves.iter().zip(bounds).map(case).collect(), Self::default())
        };
        let starts = (0..moves.first().map_or(0, Moves::cell_count)).into_par_iter();
        let tried = starts.fold(begun, |(mut cases, mut tried): (Vec<CaseTrial>, Self), start| {
            tried.try_start(&mut cases, start, excess);
            (cases, tried)
        });
        tried.map(|(_, tried)| tried).reduce(Self::default, |mut one, other| {
            one.candidates += other.candidates;
            one.met.extend(other.met);
            one.open.extend(other.open);
            one
        })
    }

    fn try_start(&mut self, cases: &mut [CaseTrial], start: u32, excess: u32) {
        let mut goals: Option<Vec<u32>> = None;
        for case in &mut *cases {
            let near = case.near(start, excess);
            goals = Some(match goals {
                None => near,
                Some(before) => {
                    before.into_iter().filter(|goal| case.shortest[*goal as usize].is_some()).collect()
                }
            });
        }
        for goal in goals.unwrap_or_default() {
            self.candidates += 1;
            let lengths: Option<Vec<Length>> =
                cases.iter_mut().map(|case| case.length(goal, excess)).collect();
            let (Some(cases), pair) = (lengths, [start, goal]) else { continue };
            let known = |length: &Length| match length {
                Length::Known(length) => Some(*length),
                Length::AtMost(_) => None,
            };
            match cases.iter().map(known).collect() {
                Some(lengths) => self.met.push(Met { pair, lengths }),
                None => self.open.push(Open { pair, cases }),
            }
        }
    }
}

/// What the trials of one thread share in a case. Lengths are in the units of [`ScaledOctile`].
struct CaseTrial {
    /// The least and the largest length that is requested.
    bounds: [u32; 2],
    flood: OctileAstar,
    back: FirstWayBack,
    /// The shortest length from the start to each cell where it is worth a try.
    shortest: Vec<Option<u32>>,
}

impl CaseTrial {
    fn new(moves: &Moves, bounds: [u32; 2]) -> Self {
        let shortest = vec![None; moves.cell_count() as usize];
        Self { bounds, flood: search(moves), back: FirstWayBack::new(moves), shortest }
    }

    /// The goals whose shortest lengths from `start` are worth a try.
    fn near(&mut self, start: u32, excess: u32) -> Vec<u32> {
        let [lowest, highest] = self.bounds;
        let mut near = Vec::new();
        let shortest = &mut self.shortest;
        let back = &mut self.back;
        shortest.fill(None);
        back.begin(start);
        self.flood.flood(start, highest, |cell, cost| {
            back.set_length(cell, cost);
            if cost + excess >= lowest {
                shortest[cell as usize] = Some(cost);
                near.push(cell);
            }
        });
        near
    }

    /// What A* returns to `goal`; nothing if that is not within the bounds and the excess.
    fn length(&mut self, goal: u32, excess: u32) -> Option<Length> {
        let [lowest, highest] = self.bounds;
        let shortest = self.shortest[goal as usize]?;
        let most = highest.min(shortest + excess);
        let Ok(length) = self.back.length(goal, most) else { return Some(Length::AtMost(most)) };
        length.map(ScaledOctile::scaled).filter(|length| *length >= lowest).map(Length::Known)
    }
}

/// Those of `open` whose lengths A* returns within `bounds`; one search is aimed at all starts of a goal.
fn settled(open: &[Open], moves: &[Moves], bounds: &[[u32; 2]], ties: Ties) -> Vec<Met> {
    let mut by_goal: Vec<&Open> = open.iter().collect();
    by_goal.sort_unstable_by_key(|open| [open.pair[1], open.pair[0]]);
    let groups: Vec<&[&Open]> = by_goal.chunk_by(|one, other| one.pair[1] == other.pair[1]).collect();
    let searches = || moves.iter().map(|moves| FirstWayAstar::new(moves, ties)).collect();
    let of_goal = |searches: &mut Vec<FirstWayAstar>, group: &&[&Open]| {
        for search in &mut *searches {
            search.aim(group[0].pair[1]);
        }
        let met = |open: &&Open| {
            let cases = searches.iter_mut().zip(&open.cases).zip(bounds);
            let length = |((search, length), bounds): ((&mut FirstWayAstar, &Length), &[u32; 2])| match length
            {
                Length::Known(length) => Some(*length),
                Length::AtMost(most) => {
                    let length = search.length(open.pair[0], *most)?;
                    Some(ScaledOctile::scaled(length)).filter(|length| *length >= bounds[0])
                }
            };
            Some(Met { pair: open.pair, lengths: cases.map(length).collect::<Option<Vec<u32>>>()? })
        };
        group.iter().filter_map(met).collect::<Vec<Met>>()
    };
    groups.par_iter().map_init(searches, of_goal).flatten_iter().collect()
}
