//! A* on the cubic lattice with 26 neighbours, among polyhedra.

use super::lattice::{COLUMNS, TiesSetting, UPDATE};
use super::polyhedra::{Posed, plan};
use super::pool::Pool;
use super::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request, Value};
use crate::geometry::{Segment, Vec3};
use crate::search::{Combined, Graph, Heap, Outcome, Report, Rules, Search, Stop, Terms, sum};
use crate::space::{PolyhedraWorld, WorldKind};
use base::grid::STEPS_26;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice26_astar",
    about: "A* on the cubic lattice with 26 neighbours and the Euclidean distance, until within a step of the goal",
    revision: 1,
    needs: WorldKind::Polyhedra,
    columns: COLUMNS,
    settings: Accepted::of::<Lattice26>(),
    example: r#"
checked = "segments"
ties = "fifo"
"#,
    build: Build::Planner(|settings| {
        let read: Lattice26 = settings.read()?;
        Ok(Box::new(read))
    }),
};

/// Which part of a move must be free.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(super) enum Checked {
    /// Its end only.
    Nodes,
    /// Every point of it.
    Segments,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Lattice26 {
    /// Which part of a move must be free.
    checked: Checked,
    /// The order among equal f.
    #[serde(default)]
    ties: TiesSetting,
    #[serde(skip)]
    pool: Pool<LatticeSearch>,
}

/// Memory that serves one query after another.
pub(super) type LatticeSearch = Search<f64, Heap>;

/// The free nodes with their 26 neighbours.
struct Neighbours<'a> {
    world: &'a PolyhedraWorld,
    steps: [(i32, f64); 26],
    checked: Checked,
}

impl<'a> Neighbours<'a> {
    fn new(world: &'a PolyhedraWorld, checked: Checked) -> Self {
        let length = |step: [i32; 3]| f64::from(step.map(|c| c * c).iter().sum::<i32>()).sqrt();
        let steps = STEPS_26.map(|step| (world.grid().offset(step), length(step) * world.step()));
        Self { world, steps, checked }
    }
}

impl Graph for Neighbours<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.world.grid().node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let careful = self.checked == Checked::Segments && self.world.is_near(node);
        for (offset, length) in self.steps {
            let to = node.wrapping_add_signed(offset);
            if !self.world.grid().is_free(to) {
                continue;
            }
            if careful && !self.world.is_clear(&Segment::new(self.world.point(node), self.world.point(to))) {
                continue;
            }
            visit(to, length);
        }
    }
}

/// What a search on the lattice found: the points from start to goal, unless there are none.
pub(super) struct Found {
    pub(super) ending: Ending,
    pub(super) points: Vec<Vec3>,
    pub(super) report: Report<f64>,
}

/// Searches from the node nearest to the start until a node less than a step from the goal is taken.
pub(super) fn search(
    posed: &Posed<'_>,
    checked: Checked,
    memory: &mut LatticeSearch,
    max_expansions: u64,
) -> Result<Found, Invalid> {
    let Posed { world, start, goal } = *posed;
    let first = entrance(world, &start).ok_or_else(|| {
        Invalid(format!("no free node of the lattice is seen from the start {:?}", start.as_slice()))
    })?;
    let h = |node: u32| (world.point(node) - goal).norm();
    let is_goal = |node: u32| {
        let at = world.point(node);
        (at - goal).norm() < world.step()
            && (checked == Checked::Nodes || world.is_clear(&Segment::new(at, goal)))
    };
    let terms = Terms {
        graph: &mut Neighbours::new(world, checked),
        estimate: &Combined { h, combine: sum },
        observer: &mut (),
        update: UPDATE,
    };
    let rules = Rules { stop: Stop::GoalPopped, max_expansions };
    let report = memory.run(terms, first, is_goal, rules, &mut ());
    let (ending, mut points) = match &report.outcome {
        Outcome::Solved(route) => {
            let inner = route.nodes.iter().map(|node| world.point(*node));
            (Ending::Solved, [start].into_iter().chain(inner).chain([goal]).collect())
        }
        Outcome::NoPath => (Ending::NoPath, Vec::new()),
        Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new()),
    };
    points.dedup();
    Ok(Found { ending, points, report })
}

/// The free node nearest to `start`, among the corners of the cells around it, that is seen from it.
fn entrance(world: &PolyhedraWorld, start: &Vec3) -> Option<u32> {
    let nearest = world.node(start)?;
    let grid = world.grid();
    let around = STEPS_26.iter().map(|step| nearest.wrapping_add_signed(grid.offset(*step)));
    let free = |node: &u32| grid.is_free(*node) && world.is_clear(&Segment::new(*start, world.point(*node)));
    [nearest].into_iter().filter(free).chain(around.filter(free)).min_by(|a, b| {
        let apart = |node: &u32| (world.point(*node) - start).norm();
        apart(a).total_cmp(&apart(b))
    })
}

impl Planner for Lattice26 {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let mut memory = self.pool.any(|| Search::new(Heap::new(self.ties.into())));
        let found = search(&posed, self.checked, &mut memory, request.expansions);
        self.pool.keep(memory);
        let found = found?;
        Ok(plan(found.ending, &found.points, counts(&found.report)))
    }

    fn is_optimal(&self) -> bool {
        true
    }

    fn is_complete(&self) -> bool {
        false
    }
}

/// A search's counters by column.
pub(super) fn counts(report: &Report<f64>) -> Counts {
    let counters = report.counters;
    Counts::from([
        ("opened", Value::Count(counters.opened)),
        ("closed", Value::Count(counters.closed)),
        ("expansions", Value::Count(counters.expansions)),
        ("generated", Value::Count(counters.generated)),
    ])
}
