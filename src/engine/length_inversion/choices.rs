//! The grids that a case may be on, searched together.

use crate::search::{GridSet, ManyGrids};
use base::grid::Moves;

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
