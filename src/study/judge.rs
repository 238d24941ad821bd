//! Hands what a planner returned to the verifier, in the verifier's own terms.
//!
//! The verifier shares no code with planners; this module only takes worlds apart for it and turns its answer
//! into the trial's status and measured values.

pub mod roadmap;

use super::checked::Pipeline;
use super::family::Query;
use super::record::Status;
use crate::planner::{Counts, Ending, Exhibit, Plan, Request, Value};
use crate::shorten::{TurnAngle, bends, path_length, turn_sum_deg};
use crate::space::{LatticeWorld, World};
use crate::verify::lattice::{Answer, Case};

/// The columns of every trial on a lattice.
pub const LATTICE_COLUMNS: &[&str] =
    &["path_cost_cells", "turn_exterior_deg", "turn_interior_deg", "bends", "optimal_cost_cells"];

/// What the verifier found out about a query before any planner ran.
#[derive(Debug)]
pub enum Truth {
    /// On a lattice: the least cost in the world's graph; `None` if the goal cannot be reached.
    Lattice(Option<f64>),
    /// On a roadmap: its robot and surroundings.
    Roadmap(roadmap::Case),
}

/// The verifier's answer about one plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The trial's status, and the reason unless solved.
    pub outcome: (Status, Option<String>),
    /// What was measured.
    pub values: Counts,
    /// What figures need of what was measured, if the request asked for it.
    pub exhibits: Vec<Exhibit>,
}

/// The truth about `query` in `world`.
pub fn truth(world: &World, query: &Query) -> Truth {
    match world {
        World::Lattice(lattice) => Truth::Lattice(case(lattice, &query.start, &query.goal).optimal_cost()),
        World::Roadmap(roadmap) => Truth::Roadmap(roadmap::Case::new(roadmap)),
    }
}

/// Judges `plan`, which `pipeline` returned for `request`.
pub fn judge(request: &Request<'_>, plan: &Plan, pipeline: &Pipeline, truth: &Truth) -> Judged {
    match (request.world, truth) {
        (World::Lattice(lattice), Truth::Lattice(optimal)) => {
            judge_lattice(lattice, request, plan, pipeline, *optimal)
        }
        (_, Truth::Roadmap(case)) => case.judge(request, plan),
        (World::Roadmap(_), Truth::Lattice(_)) => unreachable!("the truth is about the request's world"),
    }
}

fn case<'a>(lattice: &'a LatticeWorld, start: &'a [f64], goal: &'a [f64]) -> Case<'a> {
    Case { grid: lattice.grid(), corner_rule: lattice.corner_rule(), start, goal }
}

fn judge_lattice(
    lattice: &LatticeWorld,
    request: &Request<'_>,
    plan: &Plan,
    pipeline: &Pipeline,
    optimal: Option<f64>,
) -> Judged {
    let case = case(lattice, request.start, request.goal);
    let mut values = Counts::new();
    if let Some(optimal) = optimal {
        values.insert("optimal_cost_cells", Value::Real(optimal));
    }
    let untouched = pipeline.stages.is_empty();
    let answer = Answer {
        path: &plan.path,
        cost: plan.cost,
        in_graph: untouched,
        optimal: untouched && pipeline.planner.is_optimal(),
    };
    let refusal = match plan.ending {
        Ending::Solved => case.refuse_path(&answer, optimal),
        Ending::NoPath if pipeline.planner.is_complete() => case.refuse_no_path(optimal),
        Ending::NoPath | Ending::BudgetSpent => None,
    };
    if plan.ending == Ending::Solved && refusal.is_none() {
        values.extend(measured(&plan.path));
    }
    let outcome = match (refusal, plan.ending) {
        (Some(refusal), _) => (Status::Rejected, Some(refusal)),
        (None, Ending::Solved) => (Status::Solved, None),
        (None, Ending::NoPath) => (Status::NoPath, Some("the planner found no path".to_owned())),
        (None, Ending::BudgetSpent) => {
            (Status::BudgetSpent, Some(format!("budget of {} expansions spent", request.expansions)))
        }
    };
    Judged { outcome, values, exhibits: Vec::new() }
}

/// What is measured of an accepted path on a lattice.
fn measured(path: &[Vec<f64>]) -> Counts {
    let inner = bends(path).len().saturating_sub(2);
    Counts::from([
        ("path_cost_cells", Value::Real(path_length(path))),
        ("turn_exterior_deg", Value::Real(turn_sum_deg(path, TurnAngle::Exterior))),
        ("turn_interior_deg", Value::Real(turn_sum_deg(path, TurnAngle::Interior))),
        ("bends", Value::Count(inner as u64)),
    ])
}
