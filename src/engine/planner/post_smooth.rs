//! Post-smoothing of a path on a lattice as a stage.
//!
//! # Source
//! Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), Algorithm 2.

use super::entry::stage;
use super::lattice::{lattice, sees};
use super::{Build, Entry, Plan, Request, Stage, Value};
use crate::shorten::{path_length, smoothing};
use base::grid::Sight;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "post_smooth",
    about: "from one end on, drops every node of a path whose successor is still seen from the last node kept",
    revision: 1,
    needs: WorldKind::Lattice,
    columns: &["smoothing_checks"],
    settings: Accepted::shape::<PostSmooth>(),
    example: r#"
line_of_sight = "exact_interior"
from = "start"
"#,
    build: Build::Stage(stage::<PostSmooth>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PostSmooth {
    /// Which cells a line of sight must find free.
    line_of_sight: Sight,
    /// The end at which smoothing begins.
    from: FirstEnd,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum FirstEnd {
    /// The start.
    Start,
    /// The goal, at which extraction begins.
    Goal,
}

impl Stage for PostSmooth {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let world = lattice(request.world);
        let mut nodes: Vec<[i32; 2]> = plan.path.iter().map(|at| [at[0] as i32, at[1] as i32]).collect();
        if self.from == FirstEnd::Goal {
            nodes.reverse();
        }
        let mut checks = 0;
        let mut kept = smoothing(nodes.len(), |i, j| {
            checks += 1;
            sees(world, self.line_of_sight, nodes[i], nodes[j])
        });
        if self.from == FirstEnd::Goal {
            kept.reverse();
        }
        if request.trace {
            let values = plan.path.concat();
            plan.traces.push(super::Trace { name: "raw_path".to_owned(), width: 2, values });
        }
        plan.path = kept.into_iter().map(|i| nodes[i].map(f64::from).to_vec()).collect();
        plan.cost = Some(path_length(&plan.path));
        plan.counts.insert("smoothing_checks", Value::Count(checks));
        plan
    }
}
