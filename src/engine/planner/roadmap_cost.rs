//! The cost of building the roadmap of a plan, as counts; the plan itself stays as it is.

use super::entry::stage;
use super::roadmap::roadmap;
use super::{Build, Entry, Plan, Request, Stage, Value};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "roadmap_cost",
    about: "leaves a plan as it is and counts what its whole roadmap took before any query: pairs, edges, contact checks",
    revision: 1,
    needs: WorldKind::Roadmap,
    columns: &["roadmap_pairs", "roadmap_edges", "roadmap_checked_states"],
    settings: Accepted::shape::<RoadmapCost>(),
    example: "",
    build: Build::Stage(stage::<RoadmapCost>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RoadmapCost {}

impl Stage for RoadmapCost {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let tally = roadmap(request.world).tally();
        plan.counts.extend([
            ("roadmap_pairs", Value::Count(tally.pairs)),
            ("roadmap_edges", Value::Count(tally.edges)),
            ("roadmap_checked_states", Value::Count(tally.checked)),
        ]);
        plan
    }

    /// What the roadmap cost, whatever became of the plan.
    fn refine(&self, request: &Request<'_>, plan: Plan) -> Plan {
        self.tidied(request, plan)
    }
}
