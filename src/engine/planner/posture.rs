//! Posture adjustment as a stage: the whole arm follows a tip path, turning its tip away from obstacles.
//!
//! The stage takes a tip path and gives joint angles. It starts with the tool pointing down on the branch of the inverse
//! kinematics that has most clearance and goes node by node. Where a rod would come nearer than `act_cm` at the next node, the
//! tip is turned down the repulsive potential before the arm moves on.
//!
//! # Source
//! Tang, Zhou & Xu (2023), sections 3.2 and 3.3, eqs. 21 to 31.

mod follow;
mod place;
mod potential;
mod rotation;
mod settings;
#[cfg(test)]
pub(super) mod tests;

use super::polyhedra::{densified, points, polyhedra, trace};
use super::{Build, Ending, Entry, Plan, Request, Stage, Trace, Value};
use crate::shorten::path_length;
use base::settings::Accepted;
use follow::Follower;
use settings::{Branches, Posture};
use world::geometry::{Capsule, Vec3};
use world::kinematics::Joints;
use world::kinematics::ik::Branch;
use world::space::polyhedra::{CarriedArm, DOWN};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "posture",
    about: "the whole arm follows a tip path, turning its tip down the rods' repulsive potential",
    revision: 1,
    needs: WorldKind::ArmAmongPolyhedra,
    columns: &[
        "adjustments",
        "branches_tried",
        "followed_share",
        "posture_within_bounds",
        "posture_within_rad",
    ],
    settings: Accepted::shape::<Posture>(),
    example: r#"
adjust = true
sign = "down"
clamp = "floor"
distance = "exact"
pose = "inverse"
damping = 0.02
act_cm = 2.0
d0_cm = 5.0
step_rad = 0.03
iterations = 20
bounds_rad = [0.2, 0.2, 0.1]
bounds = "per_node"
recovery_rad = 0.02
branches = "all"
diagnose = true
"#,
    build: Build::Stage(|settings| Ok(Box::new(Posture::read(settings)?))),
};

/// How many postures of the arm a figure shows along its path.
const SHOWN: usize = 7;

/// How far the arm came on one branch.
struct Attempt<'a> {
    follower: Follower<'a>,
    failed_at: Option<usize>,
}

impl Stage for Posture {
    fn tidied(&self, request: &Request<'_>, mut plan: Plan) -> Plan {
        let world = polyhedra(request.world);
        let arm = world.arm().expect("a checked study gives this stage an arm");
        let nodes = densified(&points(&plan), world.step());
        let mut best: Option<Attempt<'_>> = None;
        let mut adjustments = 0;
        let mut tried = 0;
        for (branch, q) in self.starts(world, arm, &nodes[0]) {
            let attempt = self.attempt(world, arm, branch, q, &nodes);
            adjustments += attempt.follower.adjustments;
            tried += 1;
            let reached = |attempt: &Attempt<'_>| attempt.failed_at.unwrap_or(nodes.len());
            if best.as_ref().is_none_or(|known| reached(&attempt) > reached(known)) {
                best = Some(attempt);
            }
            if best.as_ref().is_some_and(|best| best.failed_at.is_none()) {
                break;
            }
        }
        plan.counts.insert("adjustments", Value::Count(adjustments));
        plan.counts.insert("branches_tried", Value::Count(tried));
        if request.trace {
            plan.traces.push(trace("tip_path", &nodes));
        }
        self.conclude(request, plan, best, &nodes)
    }
}

impl Posture {
    /// The free configurations at the start with the tool down, the one with most clearance first.
    fn starts(&self, world: &PolyhedraWorld, arm: &CarriedArm, start: &Vec3) -> Vec<(Branch, Joints)> {
        let reach = self.d0_cm.max(50.0);
        let solved = arm.arm().inverse(&CarriedArm::target(start, &DOWN), &[0.0; 6]);
        let mut starts: Vec<(f64, Branch, Joints)> = solved
            .iter()
            .map(|(branch, q)| {
                (arm.clearance(q, world.bodies(), reach, self.uses_printed_distance()), branch, *q)
            })
            .filter(|(clearance, ..)| *clearance >= self.margin_cm)
            .collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0));
        if self.branches == Branches::Clearest {
            starts.truncate(1);
        }
        starts.into_iter().map(|(_, branch, q)| (branch, q)).collect()
    }

    fn attempt<'a>(
        &'a self,
        world: &'a PolyhedraWorld,
        arm: &'a CarriedArm,
        branch: Branch,
        q: Joints,
        nodes: &[Vec3],
    ) -> Attempt<'a> {
        let mut follower = Follower::new((self, world, arm), branch, q, DOWN);
        let failed_at = follower.follow(nodes).err();
        Attempt { follower, failed_at }
    }

    fn conclude(
        &self,
        request: &Request<'_>,
        mut plan: Plan,
        best: Option<Attempt<'_>>,
        nodes: &[Vec3],
    ) -> Plan {
        let last = nodes.len().saturating_sub(1).max(1);
        let share = best
            .as_ref()
            .map_or(0.0, |best| best.failed_at.map_or(1.0, |node| (node - 1) as f64 / last as f64));
        plan.counts.insert("followed_share", Value::Real(share));
        let Some(Attempt { follower, failed_at }) = best else {
            return without_path(plan);
        };
        if request.trace {
            plan.traces.extend(trails(follower.arm, &follower.trail));
        }
        if let Some(node) = failed_at {
            if request.trace {
                plan.traces.extend(follower.blocking(&nodes[node]).map(|rod| blocking(&rod)));
            }
            if self.diagnose {
                let [near, wide] =
                    [self.bounds_rad, [1.0; 3]].map(|reach| other(&follower, &nodes[node], reach));
                plan.counts.insert("posture_within_bounds", Value::Count(u64::from(near)));
                plan.counts.insert("posture_within_rad", Value::Count(u64::from(near || wide)));
            }
            return without_path(plan);
        }
        plan.cost = Some(path_length(&follower.tips));
        plan.path = follower.trail.iter().map(|q| q.to_vec()).collect();
        plan
    }
}

fn without_path(mut plan: Plan) -> Plan {
    (plan.ending, plan.cost) = (Ending::NoPath, None);
    plan.path.clear();
    plan
}

/// Whether some posture within `reach` of the present one would be free at `tip`, on a grid of 9 × 9 × 9 turns.
fn other(follower: &Follower<'_>, tip: &Vec3, reach: [f64; 3]) -> bool {
    let turn = |code: usize, axis: usize| (code as f64 / 4.0 - 1.0) * reach[axis];
    (0..729).any(|code| {
        let w = Vec3::new(turn(code % 9, 0), turn(code / 9 % 9, 1), turn(code / 81, 2));
        let target = CarriedArm::target(tip, &(rotation::exp(&w) * follower.rotation));
        let solved = follower.arm.arm().inverse_on(&target, follower.branch, &follower.here.q);
        solved.is_some_and(|q| {
            follower.arm.is_clear(
                &q,
                follower.world.bodies(),
                follower.settings.margin_cm,
                false,
                &follower.apart,
            )
        })
    })
}

/// What figures need of a trail: rods, the tip's way, and its turns from pointing down.
pub(super) fn trails(arm: &CarriedArm, trail: &[Joints]) -> Vec<Trace> {
    let tips: Vec<Vec3> = trail.iter().map(|q| arm.tip(q)).collect();
    let turn = |q: &Joints| rotation::log(&(arm.arm().chain().forward(q).rotation * DOWN.transpose()));
    let turns: Vec<Vec3> = trail.iter().map(turn).collect();
    vec![rods(arm, trail), trace("tip_trail", &tips), trace("posture_trail", &turns)]
}

/// The rotation vector that takes the tip's posture at `from` to that at `to`.
pub(super) fn turn_between(arm: &CarriedArm, from: &Joints, to: &Joints) -> Vec3 {
    let [from, to] = [from, to].map(|q| arm.arm().chain().forward(q).rotation);
    rotation::log(&(to * from.transpose()))
}

/// The rod that would touch at the next node: both ends, radius.
fn blocking(rod: &Capsule) -> Trace {
    let ends = rod.segment.a.iter().chain(rod.segment.b.iter());
    let values = ends.copied().chain([rod.radius]).collect();
    Trace { name: "blocking_rod".to_owned(), width: 7, values }
}

/// The rods at configurations spread evenly over the trail: number of the posture, both ends, radius.
fn rods(arm: &CarriedArm, trail: &[Joints]) -> Trace {
    let last = trail.len() - 1;
    let mut values = Vec::new();
    for k in 0..SHOWN {
        for rod in arm.rods(&trail[k * last / (SHOWN - 1)]) {
            values.push(k as f64);
            values.extend(rod.segment.a.iter().chain(rod.segment.b.iter()));
            values.push(rod.radius);
        }
    }
    Trace { name: "rods".to_owned(), width: 8, values }
}
