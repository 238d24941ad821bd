//! The improved A* of Tang et al.: straight at the goal, and over an edge of each obstacle in the way.
//!
//! As printed it is a walk (`literal`): it steps towards the goal. Where the next step is in an obstacle it takes the
//! key node of least cost on the faces in front of it. A key node lies on an edge, where no face of that obstacle is in
//! front any more, so the printed walk often stops at its first one. A walk that returns to an earlier place and takes
//! the same step again goes round in circles: it has no path. `greedy` adds guards against that. `open_list` keeps the
//! key nodes on an open list, which makes the search an A*.
//!
//! # Source
//! Tang, Zhou & Xu, *Obstacle avoidance path planning of 6-DOF robotic arm based on improved A\* algorithm and
//! artificial potential field method*, Robotica (2023), section 2.3, eqs. 4 and 5.

mod open;
#[cfg(test)]
mod tests;
mod walk;

use super::lattice26_astar::{self, Checked, LatticeSearch};
use super::polyhedra::{Posed, plan};
use super::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request, Value};
use crate::search::Ties;
use crate::shorten::{Resume, stepwise_straightening};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use walk::Guards;
use world::geometry::{Segment, Vec3};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "keynode_astar",
    about: "steps straight at the goal and over the key node of least cost on an edge of what stands in the way",
    revision: 2,
    needs: WorldKind::Polyhedra,
    columns: &["opened", "expansions", "generated", "fell_back"],
    settings: Accepted::shape::<Keynode>(),
    example: r#"
search = "greedy"
cluster = false
last_resort = false
legs = "as_walked"
guards = ["faces", "off", "free", "once", "whole"]
"#,
    build: Build::Planner(|settings| {
        let read: Keynode = settings.read()?;
        if read.search != Mode::OpenList && (read.cluster || read.last_resort) {
            let key = if read.cluster { "cluster" } else { "last_resort" };
            let message = format!("{key} belongs to search = \"open_list\"; false is accepted here");
            return Err(settings.error_at(key, message));
        }
        if read.search != Mode::Greedy && read.guards.is_some() {
            let message = "guards belong to search = \"greedy\"; no such key is accepted here".to_owned();
            return Err(settings.error_at("guards", message));
        }
        Ok(Box::new(read))
    }),
};

/// How key nodes are followed.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Mode {
    /// The walk as printed: over the key node of least cost on the faces in front of it.
    Literal,
    /// The same walk with the guards without which it stops at its first key node.
    Greedy,
    /// Key nodes wait on an open list, as in an A*.
    OpenList,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Keynode {
    /// How key nodes are followed.
    search: Mode,
    /// Whether a node that sees no way round an obstacle looks round all that touch it.
    cluster: bool,
    /// Whether the lattice is searched when no key node is left.
    last_resort: bool,
    /// What becomes of the stretch between two key nodes once the second one is reached.
    #[serde(default)]
    legs: Legs,
    /// Which guards the greedy walk has; all of them if absent.
    guards: Option<Vec<Guard>>,
}

/// What the printed walk lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Guard {
    /// A face on whose plane the walk stands is in front of it.
    Faces,
    /// Key nodes stand off their edge.
    Off,
    /// Key nodes in an obstacle, outside the domain, or where the walk stands are passed over.
    Free,
    /// No edge is taken twice.
    Once,
    /// Ways are tested whole, not at their nodes alone.
    Whole,
}

impl Keynode {
    /// The guards of the greedy walk.
    fn guards(&self) -> Guards {
        let Some(named) = &self.guards else { return Guards::ALL };
        let has = |guard| named.contains(&guard);
        Guards {
            faces: has(Guard::Faces),
            off: has(Guard::Off),
            free: has(Guard::Free),
            once: has(Guard::Once),
            whole: has(Guard::Whole),
        }
    }
}

/// What becomes of the nodes between two key nodes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Legs {
    /// They stay; a stage may straighten the whole path.
    #[default]
    AsWalked,
    /// Straightened from key node to key node, each stretch going on from the last node that was joined.
    LastJoined,
    /// The same, each stretch going on from the first node that could not be joined, as the text says.
    FirstRefused,
}

/// What was counted: `opened` nodes are steps walked and key nodes computed.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    opened: u64,
    generated: u64,
    expansions: u64,
}

/// How a search for key nodes ended.
struct Walked {
    ending: Ending,
    points: Vec<Vec3>,
    /// Which of the points are key nodes, besides the first and the last, in order.
    keys: Vec<usize>,
    tally: Tally,
}

impl Walked {
    /// Straightens every stretch between two key nodes by itself.
    fn straighten(&mut self, world: &PolyhedraWorld, resume: Resume) {
        let last = self.points.len().saturating_sub(1);
        let stops: Vec<usize> = [0].into_iter().chain(self.keys.iter().copied()).chain([last]).collect();
        let mut kept: Vec<Vec3> = self.points.first().into_iter().copied().collect();
        for pair in stops.windows(2).filter(|pair| pair[0] < pair[1]) {
            let nodes = &self.points[pair[0]..=pair[1]];
            let can_join = |i: usize, j: usize| world.is_clear(&Segment::new(nodes[i], nodes[j]));
            let joined = stepwise_straightening(nodes.len(), resume, can_join);
            kept.extend(joined.into_iter().skip(1).map(|i| nodes[i]));
        }
        self.points = kept;
    }
}

impl Planner for Keynode {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let posed = Posed::new(request)?;
        let mut walked = match self.search {
            Mode::Literal => walk::walk(&posed, Guards::NONE, request.expansions),
            Mode::Greedy => walk::walk(&posed, self.guards(), request.expansions),
            Mode::OpenList => open::search(&posed, self.cluster, request.expansions),
        };
        let falls_back = self.last_resort && walked.ending == Ending::NoPath;
        if falls_back {
            let mut memory = LatticeSearch::new(Ties::Fifo);
            let left = request.expansions - walked.tally.expansions;
            // From a start that sees no node of the lattice there is nothing left to try.
            if let Ok(found) = lattice26_astar::search(&posed, Checked::Segments, &mut memory, left) {
                let counters = found.report.counters;
                walked.tally.opened += counters.opened;
                walked.tally.generated += counters.generated;
                walked.tally.expansions += counters.expansions;
                (walked.ending, walked.points, walked.keys) = (found.ending, found.points, Vec::new());
            }
        }
        match self.legs {
            Legs::AsWalked => {}
            Legs::LastJoined => walked.straighten(posed.world, Resume::LastJoined),
            Legs::FirstRefused => walked.straighten(posed.world, Resume::FirstRefused),
        }
        let counts = Counts::from([
            ("opened", Value::Count(walked.tally.opened)),
            ("generated", Value::Count(walked.tally.generated)),
            ("expansions", Value::Count(walked.tally.expansions)),
            ("fell_back", Value::Count(u64::from(falls_back))),
        ]);
        Ok(plan(walked.ending, &walked.points, counts))
    }
}
