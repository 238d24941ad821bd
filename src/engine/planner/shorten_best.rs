//! The shortest path that leaves out nodes of a roadmap's path: a yardstick for straightening.

use super::entry::stage;
use super::roadmap::{roadmap, solved};
use super::{Build, Entry, Plan, Request, Stage, Value};
use crate::shorten::least_selection;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "shorten_best",
    about: "keeps those nodes of a roadmap's path that make it shortest, or that are fewest, of all ways to leave nodes out",
    revision: 1,
    needs: WorldKind::Roadmap,
    columns: &["joins"],
    settings: Accepted::shape::<ShortenBest>(),
    example: r#"
least = "nodes"
"#,
    build: Build::Stage(stage::<ShortenBest>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ShortenBest {
    /// What is least.
    least: Least,
}

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum Least {
    /// The path's length.
    Length,
    /// How many nodes the path has.
    Nodes,
}

impl Stage for ShortenBest {
    fn tidied(&self, request: &Request<'_>, plan: Plan) -> Plan {
        let map = roadmap(request.world);
        let number = |config: &Vec<f64>| map.number("node", config).expect("a path's nodes are free");
        let nodes: Vec<u32> = plan.path.iter().map(number).collect();
        let mut joins = 0;
        let kept = least_selection(nodes.len(), |i, j| {
            let is_own = j == i + 1;
            joins += u64::from(!is_own);
            (is_own || map.join(nodes[i], nodes[j]).is_ok()).then(|| match self.least {
                Least::Length => map.gap_mm(nodes[i], nodes[j]),
                Least::Nodes => 1.0,
            })
        });
        let kept: Vec<u32> = kept.into_iter().map(|index| nodes[index]).collect();
        let mut counts = plan.counts;
        counts.insert("joins", Value::Count(joins));
        Plan { traces: plan.traces, ..solved(map, &kept, counts) }
    }
}
