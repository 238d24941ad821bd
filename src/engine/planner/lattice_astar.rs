//! A* over the tip positions of a planar arm, with a neighbourhood of any size.

use super::pool::Pool;
use super::tips::{
    self, COLUMNS, FreeHops, Heuristic, OpenSetting, Posed, RegionSetting, RegionShape, TipSearch,
    TipSearchOptions, TipTies,
};
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::Successors;
use base::grid::Offsets;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::space::{ArmWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice_astar",
    about: "A* over an arm's tip positions; neighbours are all points of a square, disc or octagon",
    revision: 1,
    needs: WorldKind::Arm,
    columns: COLUMNS,
    settings: Accepted::shape::<LatticeAstar>(),
    example: r#"
neighbourhood = { shape = "disc", radius_cells = 2 }
open_node = "lowered"
ties = "fifo"
heuristic = "euclidean"
sets = "all"
"#,
    build: Build::Planner(|settings| {
        let read: LatticeAstar = settings.read()?;
        let offsets = read.neighbourhood.offsets();
        Ok(Box::new(Ready { read, offsets, pool: Pool::default() }))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct LatticeAstar {
    /// Which points are neighbours.
    neighbourhood: RegionSetting,
    /// Whether a better way to an open node is taken.
    open_node: OpenSetting,
    /// The order among equal f.
    #[serde(default)]
    ties: TipTies,
    /// The distance to the goal that is added to g.
    #[serde(default)]
    heuristic: Heuristic,
    /// Which of a square's points are used; discs and octagons have no sets.
    #[serde(default)]
    sets: Sets,
}

/// The sets of neighbours that a square consists of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Sets {
    /// All of them.
    #[default]
    All,
    /// Where the whole square is free, its rim alone and the goal; where anything in it is not, all of them.
    OuterWhereFree,
}

/// The free hops to the rim of a square where the square is free, else to all of it.
struct OuterHops<'a> {
    world: &'a ArmWorld,
    reach: i32,
    goal: u32,
    /// Whether the square about the cell in hand is free.
    is_free: bool,
}

impl Successors for OuterHops<'_> {
    fn expands(&mut self, cell: u32) {
        let grid = self.world.grid();
        let reach = self.reach;
        let [x, y] = grid.xy(cell);
        self.is_free = (-reach..=reach).all(|dx| (-reach..=reach).all(|dy| grid.is_free_xy(x + dx, y + dy)));
    }

    fn kept(&mut self, cell: u32, dx: i32, reach: i32, free: u64) -> u64 {
        let [[x, y], [goal_x, goal_y]] = [cell, self.goal].map(|cell| self.world.grid().xy(cell));
        let rim = if dx.abs() == self.reach { !0 } else { 1 | 1 << (2 * reach) };
        let is_near = goal_x - x == dx && (goal_y - y).abs() <= reach;
        let goal = if is_near { 1 << (reach - (goal_y - y)) } else { 0 };
        let used = if self.is_free { rim | goal } else { !0 };
        self.world.hops(cell, dx, reach, free & used)
    }
}

struct Ready {
    read: LatticeAstar,
    offsets: Offsets,
    pool: Pool<TipSearch>,
}

impl Ready {
    /// Whether some neighbours are left out.
    fn uses_sets(&self) -> bool {
        self.read.sets == Sets::OuterWhereFree && self.read.neighbourhood.shape == RegionShape::Square
    }
}

impl Planner for Ready {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let LatticeAstar { ties, open_node, heuristic, .. } = self.read;
        let manner = TipSearchOptions { heuristic, open_node, expansions: request.expansions };
        let mut search = self.pool.any(|| TipSearch::new(&self.offsets, ties));
        let reach = i32::from(self.read.neighbourhood.radius_cells);
        let (report, scans) = if self.uses_sets() {
            let mut hops = OuterHops { world: posed.world, reach, goal: posed.goal, is_free: false };
            posed.search(&mut search, &self.offsets, &mut hops, manner)
        } else {
            posed.search(&mut search, &self.offsets, &mut FreeHops(posed.world), manner)
        };
        self.pool.keep(search);
        let mut plan = posed.plan(&report, scans, request.trace);
        if request.trace {
            plan.traces.push(tips::steps("region", self.offsets.steps()));
        }
        Ok(plan)
    }

    fn is_optimal(&self) -> bool {
        self.read.open_node == OpenSetting::Lowered
            && !self.uses_sets()
            && self.read.heuristic.is_consistent(self.offsets.steps())
    }

    fn is_complete(&self) -> bool {
        !self.uses_sets()
    }

    fn steps(&self) -> Option<&[[i32; 2]]> {
        Some(self.offsets.steps())
    }
}
