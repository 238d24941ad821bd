//! The grids that a case may be on, searched together.

use crate::search::{GridSet, ManyGrids};
use base::grid::Moves;
use rayon::prelude::*;

/// Which grids of two cases may be the ones of one pair of printed lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Match {
    /// Grid `k` of one case and grid `k` of the other: alternative `k`.
    ByPlace,
    /// Any grid of one and any of the other.
    Freely,
}

/// The grids of one case.
#[derive(Clone, Debug)]
pub(super) struct Choices {
    rule: Match,
    searches: Vec<ManyGrids>,
}

/// The grids of all cases in batches that one search a case can hold, with the number of alternatives of each batch.
pub(super) fn batches(cases: &[Vec<Moves>], rule: Match) -> Vec<(usize, Vec<Choices>)> {
    let size = |moves: &Moves| (moves.width(), moves.cell_count());
    let mut sizes = cases.iter().flatten().map(size);
    let first = sizes.next();
    assert!(sizes.all(|size| Some(size) == first), "grids have one size in all cases");
    if rule == Match::Freely {
        return vec![(1, cases.iter().map(|grids| Choices::new(grids, rule)).collect())];
    }
    let count = cases[0].len();
    assert!(cases.iter().all(|grids| grids.len() == count), "grids match by place in all cases");
    let batch = |from: usize| {
        let places = from..count.min(from + ManyGrids::MOST);
        let of_case = |grids: &Vec<Moves>| Choices::new(&grids[places.clone()], rule);
        (places.len(), cases.iter().map(of_case).collect())
    };
    (0..count).step_by(ManyGrids::MOST).map(batch).collect()
}

impl Choices {
    fn new(grids: &[Moves], rule: Match) -> Self {
        let search = |grids: &[Moves]| {
            ManyGrids::new(grids).expect("a workspace is smaller than the search's largest grid")
        };
        Self { rule, searches: grids.chunks(ManyGrids::MOST).map(search).collect() }
    }

    pub(super) fn cell_count(&self) -> u32 {
        self.searches[0].cell_count()
    }

    /// The cells that are within `radius` of `centre` on every grid on which a move leads from them.
    fn ball(&mut self, centre: u32, radius: u32) -> Vec<bool> {
        let mut inside = vec![true; self.cell_count() as usize];
        for search in &mut self.searches {
            let mut missing: Vec<GridSet> =
                (0..search.cell_count()).map(|cell| search.leaving(cell)).collect();
            search.flood(centre, radius, |cell, _, grids| missing[cell as usize] &= !grids);
            inside.iter_mut().zip(missing).for_each(|(inside, missing)| *inside &= missing == 0);
        }
        inside
    }

    /// How many searches a flood takes.
    pub(super) fn search_count(&self) -> usize {
        self.searches.len()
    }

    /// Tells `visit` the cells and costs of [`ManyGrids::flood`], with the alternatives that have them: the only one
    /// there is if grids match freely.
    pub(super) fn flood(&mut self, start: u32, most: u32, mut visit: impl FnMut(u32, u32, GridSet)) {
        for search in &mut self.searches {
            search.flood(start, most, |cell, cost, grids| {
                visit(cell, cost, if self.rule == Match::Freely { 1 } else { grids });
            });
        }
    }
}

/// From which cells searches start so that they find every pair that is far enough apart.
///
/// Of two cells of a ball whose diameter is below all lengths that are requested, none is a pair. Every other pair has a cell
/// outside it, and no search has to start inside.
pub(super) struct Starts {
    /// Whether each cell is in the ball, in every case.
    inside: Vec<bool>,
}

impl Starts {
    /// How many cells are tried as the centre of the ball.
    const CENTRES: u32 = 50;

    /// For pairs whose length is at least `least` in each of `cases`.
    pub(super) fn new(cases: &[Choices], least: &[u32]) -> Self {
        let cells = cases[0].cell_count();
        let ball = |cases: &mut Vec<Choices>, centre: u32| {
            let mut inside = vec![true; cells as usize];
            for (case, least) in cases.iter_mut().zip(least) {
                let ball = case.ball(centre, least.saturating_sub(1) / 2);
                inside.iter_mut().zip(ball).for_each(|(inside, in_ball)| *inside &= in_ball);
            }
            inside
        };
        let centres: Vec<u32> = (0..cells).step_by(cells.div_ceil(Self::CENTRES) as usize).collect();
        let balls = centres.into_par_iter().map_init(|| cases.to_vec(), ball);
        let size = |inside: &Vec<bool>| inside.iter().filter(|inside| **inside).count();
        Self { inside: balls.max_by_key(size).unwrap_or_default() }
    }

    /// The cells outside the ball.
    pub(super) fn cells(&self) -> impl IndexedParallelIterator<Item = u32> {
        let outside = (0..).zip(&self.inside).filter(|(_, inside)| !**inside);
        outside.map(|(cell, _)| cell).collect::<Vec<u32>>().into_par_iter()
    }

    /// Whether it is the search from `start` that counts its pair with `goal`.
    pub(super) fn counts(&self, start: u32, goal: u32) -> bool {
        goal > start || self.inside[goal as usize]
    }
}
