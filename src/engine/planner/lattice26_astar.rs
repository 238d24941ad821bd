//! A* on the cubic lattice with 26 neighbours, among polyhedra.

use super::entry::planner;
use super::lattice::{COLUMNS, UPDATE, counted};
use super::polyhedra::{Posed, plan};
use super::pool::Pool;
use super::{Build, Ending, Entry, Invalid, Plan, Planner, Request};
use crate::search::{
    Combined, CubicAstar, CubicQuery, Graph, Heap, Outcome, Report, Rules, Search, SideInputs, Stop, Ties,
    sum,
};
use base::grid::STEPS_26;
use base::settings::Accepted;
use base::text::listed;
use schemars::JsonSchema;
use serde::Deserialize;
use world::geometry::{Segment, Vec3};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice26_astar",
    about: "A* on the cubic lattice with 26 neighbours and the Euclidean distance, until within a step of the goal",
    revision: 1,
    needs: WorldKind::Polyhedra,
    columns: COLUMNS,
    settings: Accepted::shape::<Lattice26>(),
    example: r#"
checked = "segments"
ties = "fifo"
"#,
    build: Build::Planner(planner::<Lattice26>),
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
    ties: Ties,
    #[serde(skip)]
    pool: Pool<LatticeSearch>,
}

/// A search that serves one query after another.
pub(super) enum LatticeSearch {
    /// For the orders that it knows.
    Cubic(Box<CubicAstar>),
    /// For the others.
    General(Search<f64, Heap>),
}

impl LatticeSearch {
    /// A search that takes open nodes of equal f in the order of `ties`.
    pub(super) fn new(ties: Ties) -> Self {
        match CubicAstar::new(ties) {
            Some(search) => Self::Cubic(Box::new(search)),
            None => Self::General(Search::new(Heap::new(ties))),
        }
    }

    fn run(
        &mut self,
        mut neighbours: Neighbours<'_>,
        start: u32,
        h: impl Fn(u32) -> f64,
        is_goal: impl Fn(u32) -> bool,
        max_expansions: u64,
    ) -> Report<f64> {
        match self {
            Self::Cubic(search) => search.run(&CubicQuery {
                grid: neighbours.world.grid(),
                spacing: neighbours.world.step(),
                may_step: |node, to| neighbours.may_step(node, to),
                is_near: |node| neighbours.is_near(node),
                h,
                is_goal,
                start,
                max_expansions,
            }),
            Self::General(search) => {
                let estimate = &Combined { h, combine: sum };
                let terms =
                    SideInputs { graph: &mut neighbours, estimate, observer: &mut (), update: UPDATE };
                let rules = Rules { stop: Stop::GoalPopped, max_expansions };
                search.run(terms, start, is_goal, rules, &mut ())
            }
        }
    }
}

/// The free nodes with their 26 neighbours.
#[derive(Clone, Copy)]
struct Neighbours<'a> {
    world: &'a PolyhedraWorld,
    checked: Checked,
}

impl Neighbours<'_> {
    /// Whether a move from `node` to a free neighbour may touch an obstacle that matters.
    fn is_near(&self, node: u32) -> bool {
        self.checked == Checked::Segments && self.world.is_near(node)
    }

    /// Whether a move from a node that is near obstacles to a free one is free.
    fn may_step(&self, node: u32, to: u32) -> bool {
        self.world.is_clear(&Segment::new(self.world.point(node), self.world.point(to)))
    }
}

impl Graph for Neighbours<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.world.grid().node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let grid = self.world.grid();
        let is_near = self.is_near(node);
        for step in STEPS_26 {
            let to = node.wrapping_add_signed(grid.offset(step));
            if grid.is_free(to) && (!is_near || self.may_step(node, to)) {
                let length = f64::from(step.map(|c| c * c).iter().sum::<i32>()).sqrt();
                visit(to, length * self.world.step());
            }
        }
    }
}

/// What a search on the lattice found: the points from start to goal, unless there are none.
pub(super) struct LatticePath {
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
) -> Result<LatticePath, Invalid> {
    let Posed { world, start, goal } = *posed;
    let first = entrance(world, &start).ok_or_else(|| {
        Invalid(format!("no free node of the lattice is seen from the start {}", listed(start)))
    })?;
    let h = |node: u32| (world.point(node) - goal).norm();
    let is_goal = |node: u32| {
        let at = world.point(node);
        (at - goal).norm() < world.step()
            && (checked == Checked::Nodes || world.is_clear(&Segment::new(at, goal)))
    };
    let report = memory.run(Neighbours { world, checked }, first, h, is_goal, max_expansions);
    let (ending, mut points) = match &report.outcome {
        Outcome::Solved(route) => {
            let inner = route.nodes.iter().map(|node| world.point(*node));
            (Ending::Solved, [start].into_iter().chain(inner).chain([goal]).collect())
        }
        Outcome::NoPath => (Ending::NoPath, Vec::new()),
        Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new()),
    };
    points.dedup();
    Ok(LatticePath { ending, points, report })
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
        let mut memory = self.pool.any(|| LatticeSearch::new(self.ties));
        let found = search(&posed, self.checked, &mut memory, request.expansions);
        self.pool.keep(memory);
        let found = found?;
        Ok(plan(found.ending, &found.points, counted(&[found.report.counters])))
    }

    fn is_optimal(&self) -> bool {
        true
    }
}
