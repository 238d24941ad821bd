//! The steps that planners between corners of cells share.

use super::lattice::{Posed, TiesSetting};
use super::one_side::{Found, OneSided};
use super::pool::Pool;
use super::{Invalid, Plan, Planner, Request};
use crate::search::{AngleRanges, BucketHeap, Cornered, Interpolated, Observer};
use base::settings::{Settings, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::LatticeWorld;

/// The corners of the cells of `world`; a checked study gives these planners no other lattice.
pub(super) fn cornered(world: &LatticeWorld) -> Cornered<'_> {
    let cells = world.cornered().expect("a checked study gives a planner the kind of world it needs");
    Cornered { cells, grid: world.grid(), moves: world.moves() }
}

/// The settings of a planner that has a choice of ties alone.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TiesAlone {
    /// The order among equal f.
    ties: TiesSetting,
}

/// A search between corners of cells.
pub(super) trait CornerSearch: Send + 'static {
    /// With an empty memory.
    fn new(frontier: BucketHeap) -> Self;

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
    fn new(frontier: BucketHeap) -> Self {
        Self::new(frontier)
    }

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
    fn new(frontier: BucketHeap) -> Self {
        Self::new(frontier)
    }

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

/// The planner that searches by `S`.
///
/// # Errors
/// Settings other than [`TiesAlone`].
pub(super) fn built<S: CornerSearch>(settings: &Settings) -> Result<Box<dyn Planner>, SettingsError> {
    let TiesAlone { ties } = settings.read()?;
    Ok(Box::new(BetweenCorners::<S> { ties, pool: Pool::default() }))
}

struct BetweenCorners<S> {
    ties: TiesSetting,
    pool: Pool<S>,
}

impl<S: CornerSearch> OneSided for BetweenCorners<S> {
    type Cost = f64;

    fn search<O: Observer>(&self, posed: &Posed<'_>, expansions: u64, observer: &mut O) -> Found<f64> {
        let mut search = self.pool.any(|| S::new(BucketHeap::new(self.ties.into())));
        let found = search.solve(&cornered(posed.world), [posed.start, posed.goal], expansions, observer);
        self.pool.keep(search);
        found
    }
}

impl<S: CornerSearch> Planner for BetweenCorners<S> {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        Ok(self.planned(request, &Posed::new(request)?))
    }

    fn is_optimal(&self) -> bool {
        false
    }

    fn is_complete(&self) -> bool {
        true
    }

    fn is_any_angle(&self) -> bool {
        true
    }
}
