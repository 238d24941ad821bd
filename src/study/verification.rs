//! Hands what a planner returned to the verifier, in the verifier's own terms.
//!
//! The verifier shares no code with planners; this module only takes worlds apart for it and turns its answer
//! into the trial's status and measured values.

mod arm;
mod polyhedra;
pub mod roadmap;

pub use arm::ARM_COLUMNS;
pub use polyhedra::{CARRIED_COLUMNS, POLYHEDRA_COLUMNS};

use super::contender::Pipeline;
use super::family::Query;
use super::record::Status;
use engine::planner::{Counts, Ending, Plan, Request, Trace, Value};
use engine::shorten::{TurnAngle, bends, path_length, turn_sum_deg};
use engine::space::{LatticeWorld, World};
use verify::lattice::{Answer, Case, CornerCase, Landmarks, Least};

/// The columns of every trial on a lattice.
pub const LATTICE_COLUMNS: &[&str] =
    &["path_cost_cells", "turn_exterior_deg", "turn_interior_deg", "bends", "optimal_cost_cells"];

/// The columns of every trial between corners of cells, besides.
pub const CORNER_COLUMNS: &[&str] = &["shortest_path_cells"];

/// What the verifier found out about a query before any planner ran.
#[derive(Debug)]
pub enum Truth {
    /// On a lattice: the least cost in the world's graph; `None` if the goal cannot be reached.
    Lattice(Option<f64>),
    /// On a lattice of corners: the least costs; `None` if the goal cannot be reached.
    Corners(Option<Least>),
    /// Among polyhedra: the solids, and the arm if there is one.
    Polyhedra(Box<polyhedra::Truth>),
    /// On a roadmap: its robot and surroundings.
    Roadmap(roadmap::Case),
    /// For a planar arm nothing is known beforehand.
    Arm,
}

#[cfg(test)]
impl Truth {
    /// The least cost in a lattice's graph.
    pub fn optimal(&self) -> Option<f64> {
        match self {
            Self::Lattice(optimal) => *optimal,
            Self::Corners(_) | Self::Polyhedra(_) | Self::Roadmap(_) | Self::Arm => {
                panic!("a lattice is tested")
            }
        }
    }
}

/// The verifier's answer about one plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Verified {
    /// The trial's status, and the reason unless solved.
    pub outcome: (Status, Option<String>),
    /// What was measured.
    pub values: Counts,
    /// What figures need of what was measured, if the request wanted it.
    pub traces: Vec<Trace>,
}

/// Fewest queries of one map that make landmarks worth their distances.
const MANY: usize = 32;

/// What helps to find the truth about each of many queries in one world.
#[derive(Debug, Default)]
pub struct Guide(Option<Landmarks>);

impl Guide {
    /// Landmarks for `queries` in `world`; nothing for few queries, or where `world` is no grid.
    pub fn new(world: &World, queries: &[Query]) -> Self {
        let lattice = world.as_lattice().filter(|lattice| lattice.cornered().is_none());
        let lattice = lattice.filter(|_| queries.len() >= MANY);
        // A query may begin in a part of the map that no other query is in.
        let middle = queries.get(queries.len() / 2);
        Self(lattice.zip(middle).and_then(|(lattice, q)| Landmarks::new(&case(lattice, &q.start, &q.goal))))
    }
}

/// The truth about `query` in `world`.
pub fn truth(world: &World, query: &Query, guide: &Guide) -> Truth {
    match world {
        // Its optimum depends on the planner's neighbourhood and is found when a plan is verified.
        World::Arm(_) => Truth::Arm,
        World::Lattice(lattice) if let Some(cells) = lattice.cornered() => {
            Truth::Corners(CornerCase::new(cells, query.ends()).least())
        }
        World::Lattice(lattice) => {
            Truth::Lattice(case(lattice, &query.start, &query.goal).optimal_cost(guide.0.as_ref()))
        }
        World::Roadmap(roadmap) => Truth::Roadmap(roadmap::Case::new(roadmap)),
        World::Polyhedra(world) => Truth::Polyhedra(Box::new(polyhedra::truth(world))),
    }
}

/// Verifies `plan`, which `pipeline` returned for `request`.
pub fn verify(request: &Request<'_>, plan: &Plan, pipeline: &Pipeline, truth: &Truth) -> Verified {
    match (request.world, truth) {
        (World::Arm(world), _) => arm::verify(world, request, plan, pipeline),
        (World::Lattice(lattice), Truth::Lattice(optimal)) => {
            verify_lattice(lattice, request, plan, pipeline, *optimal)
        }
        (World::Lattice(lattice), Truth::Corners(least)) => {
            verify_corners(lattice, request, plan, pipeline, *least)
        }
        (World::Polyhedra(world), Truth::Polyhedra(truth)) => polyhedra::verify(world, request, plan, truth),
        (_, Truth::Roadmap(case)) => case.verify(request, plan),
        _ => unreachable!("the truth is about the request's world"),
    }
}

fn case<'a>(lattice: &'a LatticeWorld, start: &'a [f64], goal: &'a [f64]) -> Case<'a> {
    Case { grid: lattice.grid(), corner_rule: lattice.corner_rule(), start, goal }
}

fn verify_lattice(
    lattice: &LatticeWorld,
    request: &Request<'_>,
    plan: &Plan,
    pipeline: &Pipeline,
    optimal: Option<f64>,
) -> Verified {
    let case = case(lattice, request.start, request.goal);
    let known = optimal.map(|optimal| ("optimal_cost_cells", optimal));
    let refusal = |answer: &Answer<'_>| case.refuse_path(answer, optimal);
    verify_on_grid(request, plan, pipeline, known.as_slice(), refusal, || case.refuse_no_path(optimal))
}

fn verify_corners(
    lattice: &LatticeWorld,
    request: &Request<'_>,
    plan: &Plan,
    pipeline: &Pipeline,
    least: Option<Least>,
) -> Verified {
    let case = CornerCase::new(lattice.cells(), [request.start, request.goal]);
    let known = least.map(|Least { in_graph, shortest }| {
        [("optimal_cost_cells", in_graph), ("shortest_path_cells", shortest)]
    });
    let refusal = |answer: &Answer<'_>| case.refuse_path(answer, least);
    verify_on_grid(request, plan, pipeline, known.as_slice().as_flattened(), refusal, || {
        case.refuse_no_path(least)
    })
}

fn verify_on_grid(
    request: &Request<'_>,
    plan: &Plan,
    pipeline: &Pipeline,
    known: &[(&'static str, f64)],
    refuse_path: impl Fn(&Answer<'_>) -> Option<String>,
    refuse_no_path: impl Fn() -> Option<String>,
) -> Verified {
    let mut values: Counts = known.iter().map(|(name, value)| (*name, Value::Real(*value))).collect();
    let untouched = pipeline.stages.is_empty();
    let answer = Answer {
        path: &plan.path,
        cost: plan.cost,
        in_graph: untouched && !pipeline.planner.is_any_angle(),
        optimal: untouched && pipeline.planner.is_optimal(),
        sight_corners: pipeline.stages.iter().find_map(|stage| stage.sight_corners()),
    };
    let refusal = refuse_ending(request, plan).or_else(|| match plan.ending {
        Ending::Solved => refuse_path(&answer),
        Ending::NoPath if pipeline.planner.is_complete() => refuse_no_path(),
        _ => None,
    });
    if plan.ending == Ending::Solved && refusal.is_none() {
        values.extend(measured(&plan.path));
    }
    Verified { outcome: outcome(request, plan, refusal), values, traces: Vec::new() }
}

/// The status of a trial that ended as `plan` did and was refused for `refusal`, if it was, and the reason.
fn outcome(request: &Request<'_>, plan: &Plan, refusal: Option<String>) -> (Status, Option<String>) {
    let why = |usual: &str| Some(plan.reason.clone().unwrap_or_else(|| usual.to_owned()));
    match (refusal, plan.ending) {
        (Some(refusal), _) => (Status::Rejected, Some(refusal)),
        (None, Ending::Solved) => (Status::Solved, None),
        (None, Ending::NoPath) => (Status::NoPath, why("the planner found no path")),
        (None, Ending::BudgetSpent) => {
            (Status::BudgetSpent, why(&format!("budget of {} expansions spent", request.expansions)))
        }
        (None, Ending::TimeSpent) => (Status::TimeSpent, why("the time ran out")),
        (None, Ending::Crashed) => (Status::Crashed, why("the planner broke down")),
    }
}

/// What is measured of an accepted path on a lattice: each column and its value.
pub const MEASURES: [(&str, fn(&[Vec<f64>]) -> Value); 4] = [
    ("path_cost_cells", |path| Value::Real(path_length(path))),
    ("turn_exterior_deg", |path| Value::Real(turn_sum_deg(path, TurnAngle::Exterior))),
    ("turn_interior_deg", |path| Value::Real(turn_sum_deg(path, TurnAngle::Interior))),
    ("bends", |path| Value::Count(bends(path).len().saturating_sub(2) as u64)),
];

/// All of [`MEASURES`] of `path`.
pub fn measured(path: &[Vec<f64>]) -> Counts {
    MEASURES.into_iter().map(|(name, value)| (name, value(path))).collect()
}

/// Why `plan` contradicts its own ending; `None` if it does not, or counts no expansions.
fn refuse_ending(request: &Request<'_>, plan: &Plan) -> Option<String> {
    if plan.ending != Ending::Solved && (!plan.path.is_empty() || plan.cost.is_some()) {
        return Some("a path or a cost is given although none is claimed".to_owned());
    }
    let expansions = plan.counts.get("expansions")?.as_f64();
    (plan.ending == Ending::BudgetSpent && expansions < request.expansions as f64).then(|| {
        format!("the planner calls the budget spent after {expansions} of {} expansions", request.expansions)
    })
}

#[cfg(test)]
mod tests;
