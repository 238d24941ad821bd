//! A* on a lattice with the Euclidean or the octile heuristic.

use super::lattice::{COLUMNS_DISTINCT, Posed, UPDATE};
use super::one_side::{Found, OneSided};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{
    BucketHeap, Combined, Estimate, GridGraph, Observer, Octile, Report, Rules, Search, SideInputs, Stop,
    Ties, Update, euclidean_to, falling, octile_to, weighted,
};
use base::grid::NeighbourOrder;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "astar",
    about: "A* with f = g + weight · h, h the Euclidean distance, the weight constant or Zhang's (R + r) / R",
    revision: 3,
    needs: WorldKind::Lattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<Astar>(),
    example: r#"
weight = 1
ties = "fifo"
"#,
    build: Build::Planner(|settings| {
        let read: Astar = settings.read()?;
        if let Weight::Constant(weight) = read.weight
            && (!weight.is_finite() || weight < 0.0)
        {
            let message = format!(
                "weight is {weight}; 0 (Dijkstra), 1 (A*), any larger number, or \"falling\" is accepted"
            );
            return Err(settings.error_at("weight", message));
        }
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Astar {
    /// What h is multiplied by.
    #[serde(default = "one")]
    weight: Weight,
    /// The order among equal f.
    #[serde(default)]
    ties: Ties,
    /// The order in which neighbours are generated; it decides among the first opened of equal f.
    #[serde(default)]
    neighbours: NeighbourOrder,
    /// Of two equally long ways to an open node, the one that is kept; `first` if absent.
    equal_ways: Option<EqualWays>,
    /// The distance to the goal that h is; `euclidean` if absent.
    heuristic: Option<Heuristic>,
    #[serde(skip)]
    pool: Pool<Search<Octile, BucketHeap>>,
}

/// f = g + h.
fn one() -> Weight {
    Weight::Constant(1.0)
}

#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, PartialEq)]
#[serde(untagged, expecting = "a number, or `falling`, is accepted as a weight")]
enum Weight {
    /// The same everywhere.
    Constant(f64),
    /// By a rule.
    Ruled(Rule),
}

/// The distance that h is.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Heuristic {
    /// The straight line.
    Euclidean,
    /// The shortest path by the eight moves, were no cell blocked.
    Octile,
}

/// Which of two equally long ways is kept.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum EqualWays {
    /// The one that was found first.
    First,
    /// The one that was found last.
    Last,
}

#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Rule {
    /// (R + r) / R, as Zhang's eq. 2.
    Falling,
}

impl OneSided for Astar {
    type Cost = Octile;

    fn search<O: Observer>(&self, posed: &Posed<'_>, expansions: u64, observer: &mut O) -> Found<Octile> {
        let grid = posed.world.grid();
        let goal = posed.goal;
        let report = match self.heuristic.unwrap_or(Heuristic::Euclidean) {
            Heuristic::Euclidean => self.run_by(posed, euclidean_to(grid, goal), expansions, observer),
            Heuristic::Octile => self.run_by(posed, octile_to(grid, goal), expansions, observer),
        };
        report.into()
    }
}

impl Astar {
    fn run_by<O: Observer>(
        &self,
        posed: &Posed<'_>,
        h: impl Fn(u32) -> f64,
        expansions: u64,
        observer: &mut O,
    ) -> Report<Octile> {
        match self.weight {
            Weight::Constant(weight) => {
                self.run_with(posed, &Combined { h, combine: weighted(weight) }, expansions, observer)
            }
            Weight::Ruled(Rule::Falling) => {
                let combine = falling(h(posed.start));
                self.run_with(posed, &Combined { h, combine }, expansions, observer)
            }
        }
    }

    fn run_with<O: Observer>(
        &self,
        posed: &Posed<'_>,
        estimate: &impl Estimate<Octile>,
        expansions: u64,
        observer: &mut O,
    ) -> Report<Octile> {
        let goal = posed.goal;
        let terms = SideInputs {
            graph: &mut GridGraph::in_order(posed.world.moves(), self.neighbours),
            estimate,
            observer,
            update: Update { take_equal: self.equal_ways == Some(EqualWays::Last), ..UPDATE },
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: expansions };
        let mut search = self.pool.any(|| Search::new(BucketHeap::new(self.ties)));
        let report = search.run(terms, posed.start, |cell| cell == goal, rules, &mut ());
        self.pool.keep(search);
        report
    }
}

impl Planner for Astar {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        Ok(self.planned(request, &Posed::new(request)?))
    }

    fn is_optimal(&self) -> bool {
        matches!(self.weight, Weight::Constant(weight) if weight <= 1.0)
    }

    fn is_complete(&self) -> bool {
        true
    }
}
