//! How far the tip's posture turns along an arm's path, as a stage that changes nothing: what bounds on the turn at each node come to
//! over the whole path.
//!
//! Only configurations at which the tip arrives somewhere count, each once: turns on the spot lie between two of them.
//!
//! # Source
//! Tang, Zhou & Xu (2023), eq. 31, which bounds "the amount of attitude adjustment" without saying from where.

use super::posture::turn_between;
use super::{Build, Entry, Plan, Request, Stage, Value};
use base::settings::{Accepted, Settings};
use schemars::JsonSchema;
use serde::Deserialize;
use world::kinematics::Joints;
use world::space::WorldKind;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "posture_turns",
    about: "counts the nodes of an arm's path at which the tip is turned from its first posture by more than a given angle",
    revision: 1,
    needs: WorldKind::ArmAmongPolyhedra,
    columns: &["beyond_bounds", "posture_nodes"],
    settings: Accepted::shape::<PostureTurns>(),
    example: r"
bounds_rad = [0.2, 0.2, 0.1]
",
    build: Build::Stage(|settings: &Settings| {
        let read: PostureTurns = settings.read()?;
        if let Some(bound) = read.bounds_rad.iter().find(|bound| bound.is_nan() || **bound <= 0.0) {
            return Err(
                settings.error_at("bounds_rad", format!("bounds_rad has {bound}; more than 0 is accepted"))
            );
        }
        Ok(Box::new(read))
    }),
};

/// A turn that was cut to a bound may pass it by this much, by rounding.
const ROUNDING_RAD: f64 = 1e-6;
/// A tip that moves by less stands still.
const STILL_CM: f64 = 1e-6;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PostureTurns {
    /// Turns about x, y and z that are more than one of these count.
    bounds_rad: [f64; 3],
}

impl Stage for PostureTurns {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let trail: Vec<Joints> = plan.path.iter().map(|q| std::array::from_fn(|i| q[i])).collect();
        let Some(first) = trail.first() else { return plan };
        let world = super::polyhedra::polyhedra(request.world);
        let arm = world.arm().expect("a checked study gives this stage an arm");
        let arrives = |pair: &&[Joints]| (arm.tip(&pair[1]) - arm.tip(&pair[0])).norm() > STILL_CM;
        let mut nodes = 1;
        let mut beyond = 0;
        for pair in trail.windows(2).filter(arrives) {
            let turn = turn_between(arm, first, &pair[1]);
            let is_beyond = |(angle, bound): (&f64, f64)| angle.abs() > bound + ROUNDING_RAD;
            nodes += 1;
            beyond += u64::from(turn.iter().zip(self.bounds_rad).any(is_beyond));
        }
        plan.counts.insert("beyond_bounds", Value::Count(beyond));
        plan.counts.insert("posture_nodes", Value::Count(nodes));
        plan
    }
}

#[cfg(test)]
mod tests {
    use super::super::posture::tests::followed;
    use super::super::{Counts, Ending};
    use super::*;

    /// Nodes along lines beside a box, and those at which the tip is turned by more than 0.05 rad.
    fn counted(bounds: &str) -> (u64, u64) {
        let (world, followed) = followed(bounds);
        let mut nodes = 0;
        let mut beyond = 0;
        for (line, plan) in followed {
            let [start, goal] = [line[0], line[line.len() - 1]].map(<[f64; 3]>::from);
            let request =
                Request { world: &world, start: &start, goal: &goal, expansions: 1, seed: 0, trace: false };
            let path = plan.path.clone();
            let is_solved = plan.ending == Ending::Solved;
            let stage = PostureTurns { bounds_rad: [0.05; 3] };
            let plan = stage.refine(&request, Plan { counts: Counts::new(), ..plan });
            assert_eq!(plan.path, path);
            let [own, far] = ["posture_nodes", "beyond_bounds"].map(|name| plan.counts.get(name).copied());
            assert_eq!(own, is_solved.then_some(Value::Count(line.len() as u64)), "one a node of the line");
            let count = |value: Option<Value>| value.map_or(0, |value| value.as_f64() as u64);
            (nodes, beyond) = (nodes + count(own), beyond + count(far));
        }
        (nodes, beyond)
    }

    #[test]
    fn nodes_beyond_the_bounds_are_counted_and_there_are_none_where_bounds_hold_from_the_start() {
        let (nodes, beyond) = counted("per_node");
        assert!(beyond > 20 && beyond < nodes / 2, "{beyond} of {nodes}");
        assert_eq!(counted("from_start").1, 0);
    }
}
