//! Tang's local path optimisation as a stage.

use super::entry::stage;
use super::polyhedra::{points, polyhedra, replace, trace};
use super::{Build, Entry, Plan, Request, Stage};
use crate::shorten::{Resume, stepwise_straightening};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::geometry::Segment;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "straighten_from_previous",
    about: "from a node on, joins the following ones until one is hidden, keeps the one before it, and goes on",
    revision: 1,
    needs: WorldKind::Polyhedra,
    columns: &[],
    settings: Accepted::shape::<Straighten>(),
    example: r#"
resume = "last_joined"
"#,
    build: Build::Stage(stage::<Straighten>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Straighten {
    /// The node from which the next stretch starts.
    resume: ResumeSetting,
}

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum ResumeSetting {
    /// At the last node that was joined, P(m − 1): what the procedure needs to stay on the path it drew.
    LastJoined,
    /// At the node that could not be joined, P(m), as the text says.
    FirstRefused,
    /// Nowhere: the path stays as it is, because the planner straightened it between its key nodes.
    Off,
}

impl Stage for Straighten {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let world = polyhedra(request.world);
        let nodes = points(&plan);
        let resume = match self.resume {
            ResumeSetting::LastJoined => Resume::LastJoined,
            ResumeSetting::FirstRefused => Resume::FirstRefused,
            ResumeSetting::Off => return plan,
        };
        let can_join = |i: usize, j: usize| world.is_clear(&Segment::new(nodes[i], nodes[j]));
        let kept = stepwise_straightening(nodes.len(), resume, can_join);
        if request.trace {
            plan.traces.push(trace("raw_path", &nodes));
        }
        replace(&mut plan, &kept.into_iter().map(|i| nodes[i]).collect::<Vec<_>>());
        plan
    }
}
