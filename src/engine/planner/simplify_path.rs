//! Path simplification as a stage: shortcuts, fewer vertices, corners cut, by the straight motions of the robot.
//!
//! # Source
//! The stages and defaults of VAMP (Thomason, Kingston & Kavraki, ICRA 2024); see [`simplify`].

use super::roadmap::roadmap;
use super::sampled::claimed;
use super::{Build, Entry, Plan, Request, Stage, Value};
use crate::sampling::{BSpline, Draw, DrawSetting, Motions, Operation, Reduce, simplify};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "simplify_path",
    about: "shortens a path by shortcuts, by leaving out vertices and by cutting corners, in rounds",
    revision: 2,
    needs: WorldKind::Roadmap,
    columns: &["simplification_motions", "simplification_states"],
    settings: Accepted::shape::<SimplifyPath>(),
    example: r#"
rounds = 5
operations = ["shortcut", "bspline"]
bspline = { rounds = 1, least_change = 0.1, share = 0.5 }
"#,
    build: Build::Stage(|settings| {
        let read: SimplifyPath = settings.read()?;
        for (key, operation, is_given) in [
            ("bspline", Operation::Bspline, read.bspline.is_some()),
            ("reduce", Operation::Reduce, read.reduce.is_some()),
        ] {
            if read.operations.contains(&operation) != is_given {
                let found = if is_given { "given, and not among" } else { "not given, but among" };
                return Err(
                    settings.error(format!("{key} is {found} the operations; both or neither is accepted"))
                );
            }
        }
        Ok(Box::new(read))
    }),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SimplifyPath {
    /// Rounds at most; a round that changes nothing is the last.
    #[schemars(range(min = 1, max = 1000))]
    rounds: u32,
    /// What is done in each round, in this order.
    #[schemars(length(min = 1))]
    operations: Vec<Operation>,
    /// How corners are cut.
    bspline: Option<BSpline>,
    /// How vertices are left out.
    reduce: Option<Reduce>,
}

impl Stage for SimplifyPath {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let local = roadmap(request.world).local();
        let mut draw = Draw::new(DrawSetting::Seeded, seed::derive(request.seed, &["simplify_path"]));
        let bspline = self.bspline.unwrap_or(BSpline { rounds: 0, least_change: 0.0, share: 0.0 });
        let reduce = self.reduce.unwrap_or(Reduce { tries: 0, empty_tries: 0, range_share: 0.0 });
        let mut tried = 0;
        let mut checked = 0;
        // A shortened path may touch something between two checks. It is then shortened again with finer checks of every motion. If that
        // fails too, or rounding in the plane makes the path longer, it stays as it was.
        for mut motions in [Motions::new(local), Motions::finely(local)] {
            let rounds = (self.rounds, &self.operations[..]);
            let short = simplify(&mut motions, &mut draw, plan.path.clone(), rounds, (&bspline, &reduce));
            let is_free = motions.refused_leg(&short).is_none();
            tried += motions.motions();
            checked += motions.checked();
            if is_free {
                if motions.length(&short) <= motions.length(&plan.path) {
                    plan.path = short;
                }
                break;
            }
        }
        plan.cost = claimed(local, &plan.path);
        plan.counts.insert("simplification_motions", Value::Count(tried));
        plan.counts.insert("simplification_states", Value::Count(checked));
        plan
    }
}
