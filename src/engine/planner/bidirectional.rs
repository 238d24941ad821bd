//! Bidirectional A* on a lattice, with Zhang's falling weight or a constant one.

use super::entry::planner;
use super::lattice::{self, COLUMNS_DISTINCT, Posed, UPDATE};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{
    Bidirectional, BidirectionalReport, BidirectionalRules, Closings, Combined, End, GridGraph, Heap,
    Meeting, Observer, Octile, SideChoice, Ties, euclidean_to, falling, sum,
};
use base::grid::NeighbourOrder;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::cell::Cell;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "bidirectional",
    about: "two A* searches towards each other, with a constant weight on h or Zhang's (R + r) / R",
    revision: 2,
    needs: WorldKind::Lattice,
    columns: COLUMNS_DISTINCT,
    settings: Accepted::shape::<TwoSided>(),
    example: r#"
weight = "one"
meeting = "generated_any"
side = "alternate"
ties = "fifo"
"#,
    build: Build::Planner(planner::<TwoSided>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TwoSided {
    /// What h is multiplied by.
    weight: Weight,
    /// When the two sides have met.
    meeting: Meeting,
    /// What is done once they have met while a node is expanded.
    #[serde(default)]
    end: End,
    /// What a side's h is the distance to.
    #[serde(default)]
    aim: Aim,
    /// Which side moves next.
    side: SideChoice,
    /// The order among equal f.
    #[serde(default)]
    ties: Ties,
    /// The order in which neighbours are generated; it decides among the first opened of equal f.
    #[serde(default)]
    neighbours: NeighbourOrder,
    #[serde(skip)]
    pool: Pool<Memory>,
}

type Memory = Bidirectional<Octile, Heap>;

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Weight {
    /// 1: f = g + h.
    One,
    /// (R + r) / R, as Zhang's eq. 2.
    Falling,
}

#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Default, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Aim {
    /// Where the other side began.
    #[default]
    Root,
    /// The node that the other side expanded last; h is measured when a node is opened. R stays the distance from start
    /// to goal.
    Front,
}

/// The node that a side expanded last.
struct Front<'a>(&'a Cell<u32>);

impl Observer for Front<'_> {
    fn closed(&mut self, node: u32) {
        self.0.set(node);
    }
}

impl TwoSided {
    fn rules(&self, max_expansions: u64) -> BidirectionalRules {
        BidirectionalRules {
            meeting: self.meeting,
            end: self.end,
            choice: self.side,
            update: UPDATE,
            max_expansions,
        }
    }

    /// Searches with the settings' weight; `observers` watch both sides.
    fn run<O: Observer>(
        &self,
        memory: &mut Memory,
        posed: &Posed<'_>,
        expansions: u64,
        observers: [O; 2],
    ) -> BidirectionalReport<Octile> {
        match self.weight {
            Weight::One => self.run_with(memory, posed, sum, expansions, observers),
            Weight::Falling => {
                let apart = euclidean_to(posed.world.grid(), posed.goal)(posed.start);
                let combine = falling(apart);
                self.run_with(memory, posed, &combine, expansions, observers)
            }
        }
    }

    fn run_with<O: Observer>(
        &self,
        memory: &mut Memory,
        posed: &Posed<'_>,
        combine: impl Fn(f64, f64) -> f64 + Copy,
        expansions: u64,
        mut observers: [O; 2],
    ) -> BidirectionalReport<Octile> {
        let grid = posed.world.grid();
        let rules = self.rules(expansions);
        let ends = [posed.start, posed.goal];
        let mut graph = GridGraph::in_order(posed.world.moves(), self.neighbours);
        match self.aim {
            Aim::Root => {
                let estimates =
                    [1, 0].map(|target| Combined { h: euclidean_to(grid, ends[target]), combine });
                memory.run(&mut graph, &estimates, &mut observers, ends, rules)
            }
            Aim::Front => {
                let fronts = ends.map(Cell::new);
                let to_front = |target: usize| {
                    let front = &fronts[target];
                    move |cell: u32| euclidean_to(grid, front.get())(cell)
                };
                let estimates = [1, 0].map(|target| Combined { h: to_front(target), combine });
                let [start, goal] = observers;
                let mut both = [(Front(&fronts[0]), start), (Front(&fronts[1]), goal)];
                memory.run(&mut graph, &estimates, &mut both, ends, rules)
            }
        }
    }
}

impl Planner for TwoSided {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let grid = posed.world.grid();
        let mut memory = self.pool.any(|| Bidirectional::new(Heap::new(self.ties)));
        let closings = Closings::default();
        let report = if request.trace {
            self.run(&mut memory, &posed, request.expansions, [0, 1].map(|side| closings.one_side(side)))
        } else {
            self.run(&mut memory, &posed, request.expansions, [(), ()])
        };
        let mut traces = Vec::new();
        if request.trace {
            traces.push(lattice::cells(grid, "opened_start_side", memory.opened(0)));
            traces.push(lattice::cells(grid, "opened_goal_side", memory.opened(1)));
            traces.push(lattice::closings(grid, closings));
            traces.extend(report.meeting.map(|cell| lattice::cells(grid, "meeting", &[cell])));
        }
        let opened = memory.opened_distinct();
        self.pool.keep(memory);
        Ok(lattice::with_distinct(lattice::plan(grid, &report.outcome, &report.sides, traces), opened))
    }

    fn is_optimal(&self) -> bool {
        // The distance to a front is no bound on the way to the goal.
        self.weight == Weight::One && self.meeting == Meeting::OptimalStop && self.aim == Aim::Root
    }

    fn is_complete(&self) -> bool {
        true
    }
}
