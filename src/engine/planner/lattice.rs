//! Ends, settings and plans that the planners on a lattice share.

use super::{Counts, Ending, Invalid, Plan, Request, Trace, Value};
use crate::search::{Closing, Closings, Cost, Counters, Outcome, Update};
use base::grid::{CornerRule, Grid2, Sight, corners_see};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::space::{LatticeWorld, World};

/// The columns that every search on a lattice fills.
pub(super) const COLUMNS: &[&str] = &["opened", "closed", "expansions", "generated"];

/// The same, and how many different nodes were opened, for planners that stand beside one with two sides.
pub(super) const COLUMNS_DISTINCT: &[&str] =
    &["opened", "opened_distinct", "closed", "expansions", "generated"];

/// Which corners a line of sight may pass, as settings write it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum SightCorners {
    /// Those that the map's rule lets moves cut.
    #[default]
    AsMoves,
    /// All: a line of sight needs no more than cells that are free.
    Allow,
    /// Those that are not flanked by two blocked cells.
    ForbidBoth,
    /// Those that no blocked cell flanks.
    ForbidAny,
}

impl SightCorners {
    /// The rule of its own, if it has one.
    pub(super) fn own(self) -> Option<CornerRule> {
        match self {
            Self::AsMoves => None,
            Self::Allow => Some(CornerRule::Allow),
            Self::ForbidBoth => Some(CornerRule::ForbidBoth),
            Self::ForbidAny => Some(CornerRule::ForbidAny),
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

/// That lines of sight in `world` are looked at by a definition that its vertices have.
///
/// # Errors
/// [`Invalid`] between corners of cells, if it is not that of [`corners_see`].
pub(super) fn check_sight(world: &LatticeWorld, sight: Sight) -> Result<(), Invalid> {
    if world.cornered().is_none() || sight == Sight::ExactInterior {
        return Ok(());
    }
    Err(Invalid("between corners of cells, line_of_sight = \"exact_interior\" is accepted".to_owned()))
}

/// The lattice that `world` is; a checked study gives these planners no other kind.
pub(super) fn lattice(world: &World) -> &LatticeWorld {
    world.as_lattice().expect("a checked study gives a planner the kind of world it needs")
}

/// What a better way changes in Zhang's flow chart and in every textbook: g of an open node is lowered, a closed
/// node stays closed.
pub(super) const UPDATE: Update = Update { lower_open: true, reopen_closed: false, take_equal: false };

/// The counts of a search's sides together: those of [`COLUMNS`].
pub(super) fn counted(sides: &[Counters]) -> Counts {
    let sum = |get: fn(&Counters) -> u64| Value::Count(sides.iter().map(get).sum());
    Counts::from([
        ("opened", sum(|side| side.opened)),
        ("closed", sum(|side| side.closed)),
        ("expansions", sum(|side| side.expansions)),
        ("generated", sum(|side| side.generated)),
    ])
}

/// The plan that a search's outcome amounts to.
pub(super) fn plan<C: Cost>(
    grid: &Grid2,
    outcome: &Outcome<C>,
    sides: &[Counters],
    traces: Vec<Trace>,
) -> Plan {
    let counts = counted(sides);
    let (ending, path, cost) = match outcome {
        Outcome::Solved(route) => {
            let point = |cell: &u32| grid.xy(*cell).map(f64::from).to_vec();
            (Ending::Solved, route.nodes.iter().map(point).collect(), Some(route.cost.value()))
        }
        Outcome::NoPath => (Ending::NoPath, Vec::new(), None),
        Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new(), None),
    };
    Plan { ending, path, cost, counts, traces, reason: None }
}

/// The same plan, with how many different nodes were opened: those of [`COLUMNS_DISTINCT`].
pub(super) fn with_distinct(mut plan: Plan, opened: u64) -> Plan {
    plan.counts.insert("opened_distinct", Value::Count(opened));
    plan
}

/// The cells as a trace, in the order given.
pub(super) fn cells(grid: &Grid2, name: &str, cells: &[u32]) -> Trace {
    let values = cells.iter().flat_map(|cell| grid.xy(*cell).map(f64::from)).collect();
    Trace { name: name.to_owned(), width: 2, values }
}

/// Cells in the order in which they were closed, as a trace. Columns: x, y, the side that closed it (0 from the start, 1 from the
/// goal), and how many cells the start's and the goal's side had opened before.
pub(super) fn closings(grid: &Grid2, closings: Closings) -> Trace {
    let row = |Closing { node, side, opened }| {
        let [x, y] = grid.xy(node).map(f64::from);
        [x, y, f64::from(side), f64::from(opened[0]), f64::from(opened[1])]
    };
    Trace {
        name: "closings".to_owned(),
        width: 5,
        values: closings.all().into_iter().flat_map(row).collect(),
    }
}

/// Whether the segment is free by the line of sight and cuts no corner that the world's rule forbids.
pub(super) fn sees(world: &LatticeWorld, sight: Sight, from: [i32; 2], to: [i32; 2]) -> bool {
    sees_under(world, world.corner_rule(), sight, from, to)
}

/// The same under another rule; between corners of cells there is one alone.
pub(super) fn sees_under(
    world: &LatticeWorld,
    rule: CornerRule,
    sight: Sight,
    from: [i32; 2],
    to: [i32; 2],
) -> bool {
    match world.cornered() {
        Some(cells) => corners_see(cells, from, to),
        None => sees_by(world.grid(), rule, sight, from, to),
    }
}

/// Whether the segment is free by the line of sight and cuts no corner that `corners` forbids.
fn sees_by(grid: &Grid2, corners: CornerRule, sight: Sight, from: [i32; 2], to: [i32; 2]) -> bool {
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
        corners.permits(flanks.map(is_free))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::grid::independent_cells;
    use base::seed;

    const RULES: [CornerRule; 3] = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];

    #[test]
    fn a_line_of_sight_is_free_both_ways_under_every_corner_rule() {
        // Bresenham's line is drawn from one end and may differ from the one drawn back.
        let mut free = 0;
        let mut parted = 0;
        for seed in 0..40 {
            let grid = independent_cells(&mut seed::stream(seed), [9, 8], 0.2, &[]).unwrap();
            let cells: Vec<[i32; 2]> = (0..grid.cell_count()).map(|cell| grid.xy(cell)).collect();
            for sight in [Sight::ExactInterior, Sight::ClosedCells] {
                for (from, to) in cells.iter().flat_map(|a| cells.iter().map(move |b| (*a, *b))) {
                    let there = RULES.map(|rule| sees_by(&grid, rule, sight, from, to));
                    let back = RULES.map(|rule| sees_by(&grid, rule, sight, to, from));
                    assert_eq!(there, back, "seed {seed}, {sight:?}, {from:?} and {to:?}");
                    // From the rule that allows most on: what a stricter one lets through, it lets through.
                    assert!(there.windows(2).all(|two| two[0] || !two[1]), "{there:?}");
                    free += u32::from(there[2]);
                    parted += u32::from(there[0] != there[2]);
                }
            }
        }
        assert!(free > 5_000 && parted > 500, "{free} free, {parted} that hang on the rule");
    }
}
