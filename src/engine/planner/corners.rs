//! The steps that planners between corners of cells share.

use super::lattice::Posed;
use super::one_side::{Found, OneSided};
use super::pool::Pool;
use super::{Invalid, Plan, Planner, Request};
use crate::search::{AngleRanges, BucketHeap, Cornered, Interpolated, Observer};
use world::space::LatticeWorld;

/// The corners of the cells of `world`; a checked study gives these planners no other lattice.
pub(super) fn cornered(world: &LatticeWorld) -> Cornered<'_> {
    let cells = world.cornered().expect("a checked study gives a planner the kind of world it needs");
    Cornered { cells, grid: world.grid(), moves: world.moves() }
}

/// A search between corners of cells.
pub(super) trait CornerSearch: Send + 'static {
    /// What it finds between `ends`.
    fn solve(
        &mut self,
        on: &Cornered<'_>,
        ends: [u32; 2],
        expansions: u64,
        observer: &mut impl Observer,
    ) -> Found<f64>;
}

impl CornerSearch for AngleRanges<BucketHeap> {
    fn solve(
        &mut self,
        on: &Cornered<'_>,
        ends: [u32; 2],
        expansions: u64,
        observer: &mut impl Observer,
    ) -> Found<f64> {
        self.solve(on, ends, expansions, observer).into()
    }
}

impl CornerSearch for Interpolated<BucketHeap> {
    fn solve(
        &mut self,
        on: &Cornered<'_>,
        ends: [u32; 2],
        expansions: u64,
        observer: &mut impl Observer,
    ) -> Found<f64> {
        let field = self.solve(on, ends, expansions, observer);
        let path = field.path.into_iter().map(|at| at.to_vec()).collect();
        Found { path: Some(path), ..field.report.into() }
    }
}

/// The planner whose searches `fresh` makes, one for each thread.
pub(super) fn planner<S: CornerSearch>(fresh: impl Fn() -> S + Send + Sync + 'static) -> Box<dyn Planner> {
    Box::new(BetweenCorners { fresh, pool: Pool::default() })
}

struct BetweenCorners<S, F> {
    fresh: F,
    pool: Pool<S>,
}

impl<S: CornerSearch, F: Fn() -> S + Send + Sync> OneSided for BetweenCorners<S, F> {
    type Cost = f64;

    fn search<O: Observer>(&self, posed: &Posed<'_>, expansions: u64, observer: &mut O) -> Found<f64> {
        let mut search = self.pool.any(&self.fresh);
        let found = search.solve(&cornered(posed.world), [posed.start, posed.goal], expansions, observer);
        self.pool.keep(search);
        found
    }
}

impl<S: CornerSearch, F: Fn() -> S + Send + Sync> Planner for BetweenCorners<S, F> {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        Ok(self.planned(request, &Posed::new(request)?))
    }

    fn is_complete(&self) -> bool {
        true
    }

    fn is_any_angle(&self) -> bool {
        true
    }
}
