//! A* over the tip positions of a planar arm, with a neighbourhood of any size.

use super::pool::Pool;
use super::tips::{
    self, COLUMNS, FreeHops, Heuristic, Manner, OpenSetting, Posed, RegionSetting, TipSearch, TipTies,
};
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::space::WorldKind;
use base::grid::Offsets;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice_astar",
    about: "A* over an arm's tip positions; neighbours are all points of a square, disc or octagon",
    revision: 1,
    needs: WorldKind::Arm,
    columns: COLUMNS,
    settings: Accepted::of::<LatticeAstar>(),
    example: r#"
neighbourhood = { shape = "disc", radius_cells = 2 }
open_node = "lowered"
ties = "fifo"
heuristic = "euclidean"
"#,
    build: Build::Planner(|settings| {
        let read: LatticeAstar = settings.read()?;
        let offsets = read.neighbourhood.offsets(settings)?;
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
}

struct Ready {
    read: LatticeAstar,
    offsets: Offsets,
    pool: Pool<TipSearch>,
}

impl Planner for Ready {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let LatticeAstar { ties, open_node, heuristic, .. } = self.read;
        let manner = Manner { heuristic, open_node, expansions: request.expansions };
        let mut search = self.pool.any(|| TipSearch::new(&self.offsets, ties));
        let (report, scans) = posed.search(&mut search, &self.offsets, &mut FreeHops(posed.world), manner);
        self.pool.keep(search);
        let mut plan = posed.plan(&report, scans, request.trace);
        if request.trace {
            plan.exhibits.push(tips::steps("region", self.offsets.steps()));
        }
        Ok(plan)
    }

    fn is_optimal(&self) -> bool {
        self.read.open_node == OpenSetting::Lowered && self.read.heuristic.is_consistent(self.offsets.steps())
    }

    fn is_complete(&self) -> bool {
        true
    }

    fn steps(&self) -> Option<&[[i32; 2]]> {
        Some(self.offsets.steps())
    }
}
