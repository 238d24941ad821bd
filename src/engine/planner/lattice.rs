//! What the planners on a lattice share: their ends, their settings' words, their plans.

use super::{Counts, Ending, Exhibit, Invalid, Plan, Request, Value};
use crate::search::{Cost, Counters, Outcome, Ties, Update};
use crate::space::{LatticeWorld, World};
use base::grid::{CornerRule, Grid2, Sight};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The columns that every search on a lattice fills.
pub(super) const COLUMNS: &[&str] = &["opened", "closed", "expansions", "generated"];

/// The order among equal f, as settings write it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum TiesSetting {
    /// The node that was put in first.
    #[default]
    Fifo,
    /// The node that was put in last.
    Lifo,
    /// The node with the larger g; among those the one that was put in first.
    LargerG,
}

impl From<TiesSetting> for Ties {
    fn from(setting: TiesSetting) -> Self {
        match setting {
            TiesSetting::Fifo => Self::Fifo,
            TiesSetting::Lifo => Self::Lifo,
            TiesSetting::LargerG => Self::LargerG,
        }
    }
}

/// Which cells a line of sight must find free, as settings write it.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum SightSetting {
    /// Cells whose interior the segment crosses; where it passes through the corner between two cells, neither is
    /// entered.
    ExactInterior,
    /// Cells that the segment touches at all: at a corner also the two that flank it.
    ClosedCells,
    /// Cells of Bresenham's line drawn from the first end to the second.
    Bresenham,
}

impl From<SightSetting> for Sight {
    fn from(setting: SightSetting) -> Self {
        match setting {
            SightSetting::ExactInterior => Self::ExactInterior,
            SightSetting::ClosedCells => Self::ClosedCells,
            SightSetting::Bresenham => Self::Bresenham,
        }
    }
}

/// The lattice of a request with its start and goal cells.
pub(super) struct Posed<'a> {
    pub(super) world: &'a LatticeWorld,
    pub(super) start: u32,
    pub(super) goal: u32,
}

impl<'a> Posed<'a> {
    pub(super) fn new(request: &Request<'a>) -> Result<Self, Invalid> {
        let world = lattice(request.world);
        let start = world.free_cell("start", request.start).map_err(Invalid)?;
        let goal = world.free_cell("goal", request.goal).map_err(Invalid)?;
        Ok(Self { world, start, goal })
    }
}

/// The lattice that `world` is; a checked study gives these planners no other kind.
pub(super) fn lattice(world: &World) -> &LatticeWorld {
    world.as_lattice().expect("a checked study gives a planner the kind of world it needs")
}

/// What a better way changes in Zhang's flow chart and in every textbook: g of an open node is lowered, a closed
/// node stays closed.
pub(super) const UPDATE: Update = Update { lower_open: true, reopen_closed: false };

/// The plan that a search's outcome amounts to.
pub(super) fn plan<C: Cost>(
    grid: &Grid2,
    outcome: &Outcome<C>,
    sides: &[Counters],
    exhibits: Vec<Exhibit>,
) -> Plan {
    let sum = |get: fn(&Counters) -> u64| Value::Count(sides.iter().map(get).sum());
    let counts = Counts::from([
        ("opened", sum(|side| side.opened)),
        ("closed", sum(|side| side.closed)),
        ("expansions", sum(|side| side.expansions)),
        ("generated", sum(|side| side.generated)),
    ]);
    let (ending, path, cost) = match outcome {
        Outcome::Solved(route) => {
            let point = |cell: &u32| grid.xy(*cell).map(f64::from).to_vec();
            (Ending::Solved, route.nodes.iter().map(point).collect(), Some(route.cost.value()))
        }
        Outcome::NoPath => (Ending::NoPath, Vec::new(), None),
        Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new(), None),
    };
    Plan { ending, path, cost, counts, exhibits, reason: None }
}

/// The cells as an exhibit, in the order given.
pub(super) fn cells(grid: &Grid2, name: &str, cells: &[u32]) -> Exhibit {
    let values = cells.iter().flat_map(|cell| grid.xy(*cell).map(f64::from)).collect();
    Exhibit { name: name.to_owned(), width: 2, values }
}

/// Whether the segment is free by the line of sight and cuts no corner that the world's rule forbids.
pub(super) fn sees(world: &LatticeWorld, sight: Sight, from: [i32; 2], to: [i32; 2]) -> bool {
    let grid = world.grid();
    let is_free = |[x, y]: [i32; 2]| grid.is_free_xy(x, y);
    if !sight.all_cells(from, to, is_free) {
        return false;
    }
    let mut before: Option<[i32; 2]> = None;
    Sight::ExactInterior.all_cells(from, to, |cell| {
        let flanks = before.map(|[x, y]| [[cell[0], y], [x, cell[1]]]);
        let cuts = before.is_some_and(|[x, y]| x != cell[0] && y != cell[1]);
        before = Some(cell);
        let Some(flanks) = flanks.filter(|_| cuts) else { return true };
        match world.corner_rule() {
            CornerRule::Allow => true,
            CornerRule::ForbidBoth => flanks.into_iter().any(is_free),
            CornerRule::ForbidAny => flanks.into_iter().all(is_free),
        }
    })
}
