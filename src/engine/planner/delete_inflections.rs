//! Zhang's inflection-point deletion as a stage.

use super::entry::stage;
use super::lattice::{SightCorners, lattice, sees_under};
use super::{Build, Entry, Plan, Request, Stage};
use crate::shorten::{bends, inflection_deletion, path_length};
use base::grid::{CornerRule, Sight};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "delete_inflections",
    about: "from the goal backwards, drops bends while the line of sight to the bend before is free",
    revision: 3,
    needs: WorldKind::Lattice,
    columns: &[],
    settings: Accepted::shape::<DeleteInflections>(),
    example: r#"
line_of_sight = "exact_interior"
"#,
    build: Build::Stage(stage::<DeleteInflections>),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DeleteInflections {
    /// Which cells a line of sight must find free.
    line_of_sight: Sight,
    /// Which corners it may pass.
    #[serde(default)]
    sight_corners: SightCorners,
}

impl Stage for DeleteInflections {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let world = lattice(request.world);
        let corners: Vec<[i32; 2]> =
            bends(&plan.path).into_iter().map(|i| [plan.path[i][0] as i32, plan.path[i][1] as i32]).collect();
        let sight = self.line_of_sight;
        let corner_rule = self.sight_corners.own().unwrap_or(world.corner_rule());
        let mut refused = Vec::new();
        let kept = inflection_deletion(corners.len(), |i, j| {
            let is_free = sees_under(world, corner_rule, sight, corners[i], corners[j]);
            if !is_free && request.trace {
                refused.extend([corners[i], corners[j]].concat().into_iter().map(f64::from));
            }
            is_free
        });
        if request.trace {
            let values = plan.path.concat();
            plan.traces.push(super::Trace { name: "raw_path".to_owned(), width: 2, values });
            plan.traces.push(super::Trace { name: "refused_sight".to_owned(), width: 4, values: refused });
        }
        plan.path = kept.into_iter().map(|i| corners[i].map(f64::from).to_vec()).collect();
        plan.cost = Some(path_length(&plan.path));
        plan
    }

    fn sight_corners(&self) -> Option<CornerRule> {
        self.sight_corners.own()
    }
}
