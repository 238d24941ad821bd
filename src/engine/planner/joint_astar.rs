//! A* over joint angles, the baseline of Tang et al. after Jia.
//!
//! States are the start's angles plus whole multiples of `delta_deg`; G adds up the Euclidean norms of the steps and H
//! is the greatest difference of one angle to the goal's. H takes no account of how many joints have to move, so it
//! is far below the cost still to come, and the search is wide.
//!
//! # Source
//! Tang, Zhou & Xu (2023), section 4.2, after Jia, *Path planning for space manipulator to avoid obstacle based on
//! A\* algorithm*, J. Mech. Eng. 46(13), 109 (2010).

use super::lattice::{COLUMNS, UPDATE, counted};
use super::polyhedra::polyhedra;
use super::{Build, Ending, Entry, Invalid, Plan, Planner, Request};
use crate::search::{Combined, Graph, Heap, Outcome, Rules, Search, SideInputs, Stop, Ties, sum};
use crate::shorten::path_length;
use base::settings::Accepted;
use base::units::setting_in_radians;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use states::{Around, Cell, States};
use std::cell::RefCell;
use world::geometry::Vec3;
use world::kinematics::{AXES, Joints};
use world::space::polyhedra::{Apart, CarriedArm, DOWN};
use world::space::{PolyhedraWorld, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_astar",
    about: "A* over joint angles in steps of delta_deg, 12 or 728 neighbours, H the greatest angle left",
    revision: 1,
    needs: WorldKind::ArmAmongPolyhedra,
    columns: COLUMNS,
    settings: Accepted::shape::<JointAstar>(),
    example: "
delta_deg = 10.0
neighbours = 12
",
    build: Build::Planner(|settings| {
        let read: JointAstar = settings.read()?;
        settings.accept_without("delta_deg", setting_in_radians("delta_deg", read.delta_deg, 0.0))?;
        if ![12, 728].contains(&read.neighbours) {
            let message =
                format!("neighbours is {}; 12 (one joint) or 728 (any joints) is accepted", read.neighbours);
            return Err(settings.error_at("neighbours", message));
        }
        Ok(Box::new(read))
    }),
};

/// Between two states rods are checked at least this often.
const CHECK_RAD: f64 = 0.04;
/// Rods nearer than this are taken to touch.
const LEAST_CM: f64 = 0.1;
/// How far around the start's clearance is looked for.
const FAR_CM: f64 = 50.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointAstar {
    /// The step of each joint.
    #[schemars(range(max = 45), extend("exclusiveMinimum" = 0))]
    delta_deg: f64,
    /// 12: one joint, up or down; 728: any joints at once.
    neighbours: u32,
    /// On which branch of the inverse kinematics start and goal are.
    #[serde(default)]
    branch: BranchSetting,
    /// How near the goal a state is from which it is reached, in steps: 1 or a half.
    #[serde(default = "one_step")]
    #[schemars(range(max = 1), extend("exclusiveMinimum" = 0))]
    goal_steps: f64,
}

/// A branch on which both ends are free.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum BranchSetting {
    /// The one whose start is farthest from obstacles.
    #[default]
    Clearest,
    /// The one with the least H from start to goal.
    Nearest,
}

fn one_step() -> f64 {
    1.0
}

struct Space<'a> {
    world: &'a PolyhedraWorld,
    arm: &'a CarriedArm,
    start: Joints,
    delta: f64,
    /// Each with how far it leads.
    steps: Vec<(Cell, f64)>,
    states: &'a RefCell<States>,
    apart: Apart,
}

fn angles(start: &Joints, cell: &Cell, delta: f64) -> Joints {
    std::array::from_fn(|i| start[i] + f64::from(cell[i]) * delta)
}

fn greatest_difference(a: &Joints, b: &Joints) -> f64 {
    (0..AXES).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

impl Space<'_> {
    /// Whether the arm can stand at `q` with nothing touching.
    fn is_free(&self, q: &Joints) -> bool {
        self.arm.arm().chain().allows(q) && self.is_apart(q)
    }

    fn is_apart(&self, q: &Joints) -> bool {
        self.arm.is_clear(q, self.world.bodies(), LEAST_CM, false, &self.apart)
    }

    /// Whether nothing touches between `a` and `b`, both left out.
    fn is_clear(&self, a: &Joints, b: &Joints) -> bool {
        let count = (greatest_difference(a, b) / CHECK_RAD).ceil().max(1.0) as u32;
        (1..count).rev().all(|k| {
            let share = f64::from(k) / f64::from(count);
            self.is_apart(&std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share))
        })
    }
}

impl Graph for Space<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.states.borrow().len()
    }

    /// The moves that lower the cost of where they lead; no other is worth asking whether it is free.
    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let (cell, reached) = {
            let states = self.states.borrow();
            (states.cell(node), states.reached(node))
        };
        let mut around = Around::new(&cell);
        let here = angles(&self.start, &cell, self.delta);
        for (step, length) in &self.steps {
            let (to, length): (Cell, f64) = (std::array::from_fn(|i| cell[i] + step[i]), *length);
            if !self.states.borrow().lowers(&to, reached + length, &mut around) {
                continue;
            }
            let there = angles(&self.start, &to, self.delta);
            // Many moves end at one cell: whether the arm can stand there is found out once.
            if !self.states.borrow().is_reached(&to, &mut around) && !self.is_free(&there) {
                self.states.borrow_mut().refuse(&to, &mut around);
                continue;
            }
            if !self.is_clear(&here, &there) {
                continue;
            }
            let number = self.states.borrow_mut().reach(to, reached + length, &mut around);
            visit(number, length);
        }
    }
}

/// How many joints a step moves.
fn moved(step: &Cell) -> usize {
    step.iter().filter(|c| **c != 0).count()
}

/// One joint up or down, or every combination of none, up and down; each with how far it leads.
fn steps(neighbours: u32, delta: f64) -> Vec<(Cell, f64)> {
    let all = (0..729).map(|code| -> Cell { std::array::from_fn(|i| code / 3_i16.pow(i as u32) % 3 - 1) });
    let chosen = all.filter(|step| moved(step) > 0 && (neighbours == 728 || moved(step) == 1));
    chosen.map(|step| (step, delta * (moved(&step) as f64).sqrt())).collect()
}

/// The configurations of the two ends on the best branch on which both are free.
fn ends(
    world: &PolyhedraWorld,
    arm: &CarriedArm,
    [start, goal]: [&Vec3; 2],
    rule: BranchSetting,
) -> Option<[Joints; 2]> {
    let solved = arm.arm().inverse(&CarriedArm::target(start, &DOWN), &[0.0; 6]);
    let mut best: Option<(f64, [Joints; 2])> = None;
    for (branch, from) in solved.iter() {
        let Some(to) = arm.arm().inverse_on(&CarriedArm::target(goal, &DOWN), branch, from) else { continue };
        let clearance = |q: &Joints| arm.clearance(q, world.bodies(), FAR_CM, false);
        if clearance(from).min(clearance(&to)) < LEAST_CM {
            continue;
        }
        let merit = match rule {
            BranchSetting::Clearest => clearance(from),
            BranchSetting::Nearest => -greatest_difference(from, &to),
        };
        if best.is_none_or(|(known, _)| merit > known) {
            best = Some((merit, [*from, to]));
        }
    }
    best.map(|(_, ends)| ends)
}

impl Planner for JointAstar {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let world = polyhedra(request.world);
        let arm = world.arm().expect("a checked study gives this planner an arm");
        let [start, goal] = [("start", request.start), ("goal", request.goal)]
            .map(|(what, end)| world.free_point(what, end).map_err(Invalid));
        let [start, goal] = ends(world, arm, [&start?, &goal?], self.branch).ok_or_else(|| {
            Invalid("no branch of the arm is free at start and goal with its tool down".to_owned())
        })?;
        let delta = self.delta_deg.to_radians();
        let states = RefCell::new(States::of_start());
        let space = |steps| {
            let apart = arm.apart(world.bodies());
            Space { world, arm, start, delta, steps, states: &states, apart }
        };
        let mut graph = space(steps(self.neighbours, delta));
        let probe = space(Vec::new());
        let at = |node: u32| angles(&start, &states.borrow().cell(node), delta);
        let h = |node: u32| greatest_difference(&at(node), &goal);
        let can_end = probe.is_free(&goal);
        let is_goal =
            |node: u32| can_end && h(node) <= delta * self.goal_steps && probe.is_clear(&at(node), &goal);
        let terms = SideInputs {
            graph: &mut graph,
            estimate: &Combined { h, combine: sum },
            observer: &mut (),
            update: UPDATE,
        };
        let rules = Rules { stop: Stop::GoalPopped, max_expansions: request.expansions };
        let report = Search::new(Heap::new(Ties::Fifo)).run(terms, 0, is_goal, rules, &mut ());
        let counts = counted(&[report.counters]);
        let (ending, trail) = match &report.outcome {
            Outcome::Solved(route) => {
                let mut trail: Vec<Joints> = route.nodes.iter().map(|node| at(*node)).collect();
                trail.push(goal);
                trail.dedup();
                (Ending::Solved, trail)
            }
            Outcome::NoPath => (Ending::NoPath, Vec::new()),
            Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new()),
        };
        Ok(joint_plan(arm, ending, &trail, counts, request.trace))
    }
}

/// The plan along `trail`; its cost is the length of the tip's path.
fn joint_plan(
    arm: &CarriedArm,
    ending: Ending,
    trail: &[Joints],
    counts: super::Counts,
    trace: bool,
) -> Plan {
    let tips: Vec<Vec<f64>> = trail.iter().map(|q| arm.tip(q).as_slice().to_vec()).collect();
    let traces = if trace && !trail.is_empty() { super::posture::trails(arm, trail) } else { Vec::new() };
    Plan {
        ending,
        path: trail.iter().map(|q| q.to_vec()).collect(),
        cost: (ending == Ending::Solved).then(|| path_length(&tips)),
        counts,
        traces,
        reason: None,
    }
}

mod states;

#[cfg(test)]
mod tests;
