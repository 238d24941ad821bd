//! Bidirectional A* on a lattice, with Zhang's falling weight or a constant one.

use super::lattice::{self, COLUMNS, Posed, TiesSetting, UPDATE};
use super::pool::Pool;
use super::{Build, Entry, Invalid, Plan, Planner, Request};
use crate::search::{
    Bidirectional, BidirectionalReport, BidirectionalRules, Combined, GridGraph, Heap, Meeting, Octile,
    SideChoice, euclidean_to, falling, sum,
};
use crate::space::WorldKind;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "bidirectional",
    about: "two A* searches towards each other, with a constant weight on h or Zhang's (R + r) / R",
    revision: 1,
    needs: WorldKind::Lattice,
    columns: COLUMNS,
    settings: Accepted::of::<TwoSided>(),
    example: r#"
weight = "one"
meeting = "generated_any"
side = "alternate"
ties = "fifo"
"#,
    build: Build::Planner(|settings| {
        let read: TwoSided = settings.read()?;
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TwoSided {
    /// What h is multiplied by.
    weight: Weight,
    /// When the two sides have met.
    meeting: MeetingSetting,
    /// Which side moves next.
    side: SideSetting,
    /// The order among equal f.
    #[serde(default)]
    ties: TiesSetting,
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

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum MeetingSetting {
    /// A side generates a node that the other has generated before, be it open or closed there.
    GeneratedAny,
    /// A side generates a node that the other has closed.
    ClosedByOther,
    /// A side closes a node that the other has closed; the node is not expanded again.
    BothClosed,
    /// The best sum found is no more than the smallest f on either side.
    OptimalStop,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum SideSetting {
    /// Strictly in turn, the start's side first.
    Alternate,
    /// The side with the smaller least f; the start's side if they are equal.
    SmallerF,
}

impl TwoSided {
    fn rules(&self, max_expansions: u64) -> BidirectionalRules {
        BidirectionalRules {
            meeting: match self.meeting {
                MeetingSetting::GeneratedAny => Meeting::GeneratedAny,
                MeetingSetting::ClosedByOther => Meeting::ClosedByOther,
                MeetingSetting::BothClosed => Meeting::BothClosed,
                MeetingSetting::OptimalStop => Meeting::OptimalStop,
            },
            choice: match self.side {
                SideSetting::Alternate => SideChoice::Alternate,
                SideSetting::SmallerF => SideChoice::SmallerF,
            },
            update: UPDATE,
            max_expansions,
        }
    }

    fn run(
        &self,
        memory: &mut Memory,
        posed: &Posed<'_>,
        combine: impl Fn(f64, f64) -> f64 + Copy,
        expansions: u64,
    ) -> BidirectionalReport<Octile> {
        let grid = posed.world.grid();
        let estimates =
            [posed.goal, posed.start].map(|target| Combined { h: euclidean_to(grid, target), combine });
        let mut graph = GridGraph::new(posed.world.moves());
        let ends = [posed.start, posed.goal];
        memory.run(&mut graph, &estimates, &mut [(), ()], ends, self.rules(expansions))
    }
}

impl Planner for TwoSided {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let grid = posed.world.grid();
        let mut memory = self.pool.any(|| Bidirectional::new(Heap::new(self.ties.into())));
        let report = match self.weight {
            Weight::One => self.run(&mut memory, &posed, sum, request.expansions),
            Weight::Falling => {
                let apart = euclidean_to(grid, posed.goal)(posed.start);
                let combine = falling(apart);
                self.run(&mut memory, &posed, &combine, request.expansions)
            }
        };
        let mut exhibits = Vec::new();
        if request.trace {
            exhibits.push(lattice::cells(grid, "opened_start_side", memory.opened(0)));
            exhibits.push(lattice::cells(grid, "opened_goal_side", memory.opened(1)));
            exhibits.extend(report.meeting.map(|cell| lattice::cells(grid, "meeting", &[cell])));
        }
        self.pool.keep(memory);
        Ok(lattice::plan(grid, &report.outcome, &report.sides, exhibits))
    }

    fn is_optimal(&self) -> bool {
        self.weight == Weight::One && self.meeting == MeetingSetting::OptimalStop
    }

    fn is_complete(&self) -> bool {
        true
    }
}
