//! Ends, settings and plans that the planners share that move an arm's tip over its lattice.

use super::lattice::counted;
use super::roadmap::unsolved;
use super::{Ending, Invalid, Plan, Request, Trace, Value};
use crate::search::{
    Bent, BentGraph, ColumnGraph, Combined, Cost as _, Graph, Heap, LatticeAstar, LatticeQuery, ListScans,
    Outcome, Report, Route, Rules, Search, SideInputs, Stop, Successors, Ties, Update, sum,
};
use base::grid::{MAX_REACH_CELLS, Offsets};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::SQRT_2;
use world::geometry::Vec2;
use world::space::ArmWorld;

/// The columns that every search over tip positions fills.
pub(super) const COLUMNS: &[&str] = &[
    "opened",
    "closed",
    "expansions",
    "generated",
    "minimum_comparisons",
    "membership_comparisons",
    "list_operations",
];

/// A neighbourhood as settings write it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionSetting {
    /// Its shape.
    pub(super) shape: RegionShape,
    /// How far it reaches.
    #[schemars(range(min = 1, max = MAX_REACH_CELLS))]
    pub(super) radius_cells: u8,
}

/// The shape of a neighbourhood.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum RegionShape {
    /// All cells of a square.
    Square,
    /// The cells of it that lie within a circle.
    Disc,
    /// With sides square to the axes.
    Octagon,
    /// With corners on the axes.
    OctagonOnCorners,
}

impl RegionSetting {
    pub(super) fn offsets(self) -> Offsets {
        let radius = self.radius_cells;
        match self.shape {
            RegionShape::Square => Offsets::square(radius),
            RegionShape::Disc => Offsets::disc(radius),
            RegionShape::Octagon => Offsets::octagon(radius),
            RegionShape::OctagonOnCorners => Offsets::octagon_on_corners(radius),
        }
    }
}

/// What happens to an open node to which a better way is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum OpenSetting {
    /// It takes the better way.
    Lowered,
    /// It keeps the way that it was first reached by.
    Never,
}

impl From<OpenSetting> for Update {
    fn from(setting: OpenSetting) -> Self {
        Self { lower_open: setting == OpenSetting::Lowered, ..Self::default() }
    }
}

/// The order among equal f, as settings write it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum TipTies {
    /// The node that was put in first.
    #[default]
    Fifo,
    /// The node that was put in last.
    Lifo,
    /// The node with the larger g; among those the one that was put in first.
    LargerG,
    /// The node whose way has turned least, then the one that was put in first; of equally long ways to an open node the one
    /// that turns less is kept.
    Straight,
}

impl From<TipTies> for Ties {
    fn from(setting: TipTies) -> Self {
        match setting {
            TipTies::Fifo => Self::Fifo,
            TipTies::Lifo => Self::Lifo,
            TipTies::LargerG => Self::LargerG,
            TipTies::Straight => Self::Smaller,
        }
    }
}

/// The distance to the goal that is added to g, as settings write it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Heuristic {
    /// The length of the straight line.
    #[default]
    Euclidean,
    /// The way along x added to the way along y.
    Manhattan,
    /// The length of a shortest way by eight neighbours.
    Octile,
}

impl Heuristic {
    fn over(self, way: Vec2) -> f64 {
        let (x, y) = (way.x.abs(), way.y.abs());
        match self {
            Self::Euclidean => way.norm(),
            Self::Manhattan => x + y,
            Self::Octile => (x - y).abs() + SQRT_2 * x.min(y),
        }
    }

    /// Whether no step is shorter than it, so that A* with these steps finds shortest paths: every heuristic here is a norm.
    pub(super) fn is_consistent(self, steps: &[[i32; 2]]) -> bool {
        steps.iter().all(|step| {
            let way = Vec2::from(step.map(f64::from));
            self.over(way) <= way.norm() * (1.0 + 1e-12)
        })
    }
}

/// A search over tip positions; its memory serves one query after another.
pub(super) enum TipSearch {
    /// With neighbours looked up a column at a time.
    Columns(Box<LatticeAstar>),
    /// For the orders among equal f that the other does not know.
    General(Search<f64, Heap>),
    /// For the order by how far ways turn.
    Straight(Search<Bent, Heap>),
}

impl TipSearch {
    /// A search of the neighbourhood `offsets` that takes open nodes of equal f in the order of `ties`.
    pub(super) fn new(offsets: &Offsets, ties: TipTies) -> Self {
        if ties == TipTies::Straight {
            return Self::Straight(Search::new(Heap::new(ties.into())));
        }
        let fast = LatticeAstar::new(offsets, ties.into());
        fast.map_or_else(
            || Self::General(Search::new(Heap::new(ties.into()))),
            |fast| Self::Columns(Box::new(fast)),
        )
    }
}

/// What an A* over tip positions does beside choosing neighbours.
#[derive(Clone, Copy)]
pub(super) struct TipSearchOptions {
    pub(super) heuristic: Heuristic,
    pub(super) open_node: OpenSetting,
    pub(super) expansions: u64,
}

/// The free hops of a workspace as successors.
pub(super) struct FreeHops<'a>(pub(super) &'a ArmWorld);

impl Successors for FreeHops<'_> {
    #[inline]
    fn kept(&mut self, cell: u32, dx: i32, reach: i32, free: u64) -> u64 {
        self.0.hops(cell, dx, reach, free)
    }
}

/// The workspace of a request with its start and goal cells.
pub(super) struct Posed<'a> {
    pub(super) world: &'a ArmWorld,
    pub(super) start: u32,
    pub(super) goal: u32,
}

impl<'a> Posed<'a> {
    pub(super) fn new(request: &Request<'a>) -> Result<Self, Invalid> {
        let world =
            request.world.as_arm().expect("a checked study gives a planner the kind of world it needs");
        let start = world.free_cell("start", request.start).map_err(Invalid)?;
        let goal = world.free_cell("goal", request.goal).map_err(Invalid)?;
        Ok(Self { world, start, goal })
    }

    /// A* with f = g + heuristic, both in centimetres; ends when the goal is popped.
    pub(super) fn search(
        &self,
        search: &mut TipSearch,
        offsets: &Offsets,
        successors: &mut impl Successors,
        manner: TipSearchOptions,
    ) -> (Report<f64>, ListScans) {
        let lattice = self.world.rules().lattice;
        let columns = self.world.columns();
        let spacing = lattice.step_cm();
        let goal = lattice.point(self.goal);
        let [width, height] = lattice.size();
        // Part of the heuristic stands here by column and by row: every node that is opened asks for it.
        let along_x: Vec<f64> = (0..width).map(|x| lattice.point(x).x - goal.x).collect();
        let along_y: Vec<f64> = (0..height).map(|y| lattice.point(y * width).y - goal.y).collect();
        let way = |[x, y]: [u32; 2]| Vec2::new(along_x[x as usize], along_y[y as usize]);
        let at = |xy: [u32; 2]| manner.heuristic.over(way(xy));
        let h = |cell: u32| at([cell % width, cell / width]);
        match search {
            TipSearch::Columns(search) => search.run(LatticeQuery {
                columns,
                spacing,
                successors,
                h: at,
                ends: [self.start, self.goal],
                lower_open: manner.open_node == OpenSetting::Lowered,
                max_expansions: manner.expansions,
            }),
            TipSearch::General(search) => {
                self.general(search, &mut ColumnGraph::new(columns, offsets, spacing, successors), h, manner)
            }
            TipSearch::Straight(search) => {
                let plain = ColumnGraph::new(columns, offsets, spacing, successors);
                self.general(search, &mut BentGraph::new(plain, columns.width()), h, manner)
            }
        }
    }

    /// The same by the general search.
    fn general<G: Graph>(
        &self,
        search: &mut Search<G::Cost, Heap>,
        graph: &mut G,
        h: impl Fn(u32) -> f64,
        manner: TipSearchOptions,
    ) -> (Report<f64>, ListScans) {
        let mut scans = ListScans::default();
        let estimate = &Combined { h, combine: sum };
        let terms = SideInputs { graph, estimate, observer: &mut scans, update: manner.open_node.into() };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: manner.expansions };
        let report = search.run(terms, self.start, |cell| cell == self.goal, rules, &mut ());
        let outcome = match report.outcome {
            Outcome::NoPath => Outcome::NoPath,
            Outcome::BudgetSpent => Outcome::BudgetSpent,
            Outcome::Solved(Route { nodes, cost }) => Outcome::Solved(Route { nodes, cost: cost.value() }),
        };
        (Report { outcome, counters: report.counters }, scans)
    }

    /// The plan that a search's report amounts to; with `trace`, the arm's stations along its path.
    pub(super) fn plan(&self, report: &Report<f64>, scans: ListScans, trace: bool) -> Plan {
        let ListScans { minimum_comparisons, membership_comparisons } = scans;
        let mut counts = counted(&[report.counters]);
        counts.extend([
            ("minimum_comparisons", Value::Count(minimum_comparisons)),
            ("membership_comparisons", Value::Count(membership_comparisons)),
            ("list_operations", Value::Count(minimum_comparisons + membership_comparisons)),
        ]);
        let mut plan = unsolved(Ending::NoPath, counts);
        match &report.outcome {
            Outcome::NoPath => {}
            Outcome::BudgetSpent => plan.ending = Ending::BudgetSpent,
            Outcome::Solved(route) => {
                plan.ending = Ending::Solved;
                plan.cost = Some(route.cost);
                let point = |cell: &u32| {
                    let at = self.world.rules().lattice.point(*cell);
                    vec![at.x, at.y]
                };
                plan.path = route.nodes.iter().map(point).collect();
                if trace {
                    plan.traces.push(self.stations(&route.nodes));
                }
            }
        }
        plan
    }

    /// Joint angles in degrees, elbow and tip in centimetres at each cell: six numbers a station.
    fn stations(&self, cells: &[u32]) -> Trace {
        let arm = self.world.rules().arm;
        let station = |cell: &u32| {
            let posture = self.world.posture(*cell);
            let elbow = arm.elbow(posture);
            let tip = arm.forward(posture);
            [posture[0].to_degrees(), posture[1].to_degrees(), elbow.x, elbow.y, tip.x, tip.y]
        };
        Trace { name: "stations".to_owned(), width: 6, values: cells.iter().flat_map(station).collect() }
    }
}

/// Steps as a trace.
pub(super) fn steps(name: &str, steps: &[[i32; 2]]) -> Trace {
    let values = steps.iter().flat_map(|step| step.map(f64::from)).collect();
    Trace { name: name.to_owned(), width: 2, values }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_heuristic_is_its_own_norm_and_steps_below_it_are_refused() {
        let way = Vec2::new(-3.0, 4.0);
        for (heuristic, expected) in [
            (Heuristic::Euclidean, 5.0),
            (Heuristic::Manhattan, 7.0),
            (Heuristic::Octile, 1.0 + 3.0 * SQRT_2),
        ] {
            assert!((heuristic.over(way) - expected).abs() < 1e-12, "{heuristic:?}");
        }
        // Of eight steps the diagonal ones are shorter than Manhattan says; a knight's step is shorter than octile says.
        let straight = [1, 0];
        let diagonal = [1, 1];
        let knight = [2, 1];
        for (steps, expected) in [
            (&[straight][..], [true, true, true]),
            (&[straight, diagonal], [true, false, true]),
            (&[straight, diagonal, knight], [true, false, false]),
        ] {
            let all = [Heuristic::Euclidean, Heuristic::Manhattan, Heuristic::Octile];
            assert_eq!(all.map(|heuristic| heuristic.is_consistent(steps)), expected, "{steps:?}");
        }
    }
}
