//! Fu's post-processing as a stage: each node is joined with the furthest later one that a local path reaches.

use super::entry::stage;
use super::roadmap::{roadmap, solved};
use super::{Build, Entry, Plan, Request, Stage, Value};
use crate::shorten::{LastNode, straightening};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "straighten",
    about: "from the start on, joins each node of a roadmap's path with the furthest one that a local path reaches",
    revision: 2,
    needs: WorldKind::Roadmap,
    columns: &["joins", "checked_states"],
    settings: Accepted::shape::<Straighten>(),
    example: r#"
last = "goal"
"#,
    build: Build::Stage(stage::<Straighten>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Straighten {
    /// Which nodes may be joined to an earlier one.
    last: LastNode,
}

impl Stage for Straighten {
    fn tidied(&self, request: &Request<'_>, plan: Plan) -> Plan {
        let map = roadmap(request.world);
        let number = |config: &Vec<f64>| map.number("node", config).expect("a path's nodes are free");
        let nodes: Vec<u32> = plan.path.iter().map(number).collect();
        let mut joins = 0;
        let mut checked = 0;
        let kept = straightening(nodes.len(), self.last, |i, j| {
            let (found, states) = map.join_counted(nodes[i], nodes[j]);
            joins += 1;
            checked += states;
            found.is_ok()
        });
        let kept: Vec<u32> = kept.into_iter().map(|index| nodes[index]).collect();
        let mut counts = plan.counts;
        counts.insert("joins", Value::Count(joins));
        let before = counts.get("checked_states").map_or(0.0, |value| value.as_f64());
        counts.insert("checked_states", Value::Count(before as u64 + checked));
        let mut traces = plan.traces;
        if request.trace {
            let values = plan.path.concat();
            traces.push(super::Trace { name: "raw_path".to_owned(), width: map.local().width(), values });
        }
        Plan { traces, ..solved(map, &kept, counts) }
    }
}
