//! Ends, counts and claimed lengths that planners share that sample.
//!
//! They plan for arms and in the plane. A point among polyhedra is not theirs: no claim asks for one, and studies compare such plans
//! with OMPL's.

use super::roadmap::roadmap;
use super::{Counts, Ending, Invalid, Plan, Planner, Request, Trace, Value};
use crate::sampling::{Motions, Tree};
use crate::shorten::path_length;
use base::settings::{Settings, SettingsError};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use world::space::roadmap::Local;

/// What every planner that samples counts; `joint_length_rad` is the verifier's, beside a length that the planner measures.
pub(super) const COLUMNS: &[&str] =
    &["iterations", "tree_nodes", "motions", "motion_states", "initial_length_rad", "joint_length_rad"];

/// What those count besides that go on after a first path.
pub(super) const IMPROVING_COLUMNS: &[&str] = &[
    "iterations",
    "tree_nodes",
    "motions",
    "motion_states",
    "initial_length_rad",
    "joint_length_rad",
    "first_iterations",
    "first_length_rad",
    "incumbents",
];

/// What a search found by when.
#[derive(Debug, Default)]
pub(super) struct Progress {
    pub(super) path: Vec<Vec<f64>>,
    pub(super) iterations: u64,
    pub(super) nodes: usize,
    /// The iteration and the length of each path that was shorter than all before; not the time, which no second run would repeat.
    pub(super) incumbents: Vec<(u64, f64)>,
}

impl Progress {
    /// Notes a path of this length if it is the shortest so far.
    pub(super) fn note(&mut self, length: f64) -> bool {
        let is_shorter = self.incumbents.last().is_none_or(|(_, known)| length < *known);
        if is_shorter {
            self.incumbents.push((self.iterations, length));
        }
        is_shorter
    }
}

/// A search by samples.
pub(super) trait SampledSearch: Send + Sync {
    /// Whether it goes on after a first path, for shorter ones.
    const IMPROVES: bool;

    /// What it finds between a start and a goal that are apart.
    fn search(&self, motions: &mut Motions<'_>, request: &Request<'_>) -> Progress;

    /// How many iterations its settings give it.
    fn iterations(&self) -> u64;

    /// How many iterations it has: those of its settings, or the study's budget if that is less.
    fn limit(&self, request: &Request<'_>) -> u64 {
        self.iterations().min(request.expansions)
    }

    /// Whether the trial's seed decides anything.
    fn draws(&self) -> bool;
}

/// The planner of a search by samples that is its settings.
pub(super) fn sampled<T: SampledSearch + DeserializeOwned + JsonSchema + 'static>(
    settings: &Settings,
) -> Result<Box<dyn Planner>, SettingsError> {
    Ok(Box::new(SampledPlanner(settings.read::<T>()?)))
}

/// The planner of a search by samples; where the start is the goal, nothing is searched.
pub(super) struct SampledPlanner<S>(pub(super) S);

impl<S: SampledSearch> Planner for SampledPlanner<S> {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let mut motions = posed(request)?;
        let found = if request.start == request.goal {
            let mut found = Progress { path: vec![request.start.to_vec()], ..Progress::default() };
            found.note(0.0);
            found
        } else {
            self.0.search(&mut motions, request)
        };
        // Where its own settings end it, more time would find nothing.
        let is_cut = self.0.iterations() > request.expansions && found.iterations == request.expansions;
        let without = if is_cut { Ending::BudgetSpent } else { Ending::NoPath };
        Ok(plan(request, &motions, found, (without, S::IMPROVES)))
    }

    fn draws(&self) -> bool {
        self.0.draws()
    }
}

/// The space of a request, whose ends the robot can be at.
fn posed<'a>(request: &Request<'a>) -> Result<Motions<'a>, Invalid> {
    let local = local(request);
    for (what, end) in [("start", request.start), ("goal", request.goal)] {
        if let Some(refusal) = local.refusal(end) {
            return Err(Invalid(format!("the {what} cannot be posed: {refusal}")));
        }
    }
    Ok(Motions::new(local))
}

/// The robot of a request and its local paths.
pub(super) fn local<'a>(request: &Request<'a>) -> &'a Local {
    roadmap(request.world).local()
}

/// The length that a planner claims: of a place that goes straight, millimetres; else none.
pub(super) fn claimed(local: &Local, path: &[Vec<f64>]) -> Option<f64> {
    let places: Vec<Vec<f64>> = path.iter().map(|config| local.place_mm(config).to_vec()).collect();
    local.is_straight().then(|| path_length(&places))
}

/// The plan of what was found; `without` is how a search without a path ended.
fn plan(
    request: &Request<'_>,
    motions: &Motions<'_>,
    found: Progress,
    (without, improves): (Ending, bool),
) -> Plan {
    let local = local(request);
    let is_solved = !found.path.is_empty();
    let mut counts = Counts::from([
        ("iterations", Value::Count(found.iterations)),
        ("tree_nodes", Value::Count(found.nodes as u64)),
        ("motions", Value::Count(motions.motions())),
        ("motion_states", Value::Count(motions.checked())),
    ]);
    let in_joints = !matches!(local, Local::Plane(_));
    if is_solved && in_joints {
        counts.insert("initial_length_rad", Value::Real(motions.length(&found.path)));
    }
    if improves {
        counts.insert("incumbents", Value::Count(found.incumbents.len() as u64));
        if let Some((iterations, length)) = found.incumbents.first() {
            counts.insert("first_iterations", Value::Count(*iterations));
            if in_joints {
                counts.insert("first_length_rad", Value::Real(*length));
            }
        }
    }
    let numbers = found.incumbents.iter().flat_map(|(iteration, length)| [*iteration as f64, *length]);
    let incumbents =
        Trace { name: "incumbents_by_iteration".to_owned(), width: 2, values: numbers.collect() };
    Plan {
        ending: if is_solved { Ending::Solved } else { without },
        cost: if is_solved { claimed(local, &found.path) } else { None },
        path: found.path,
        counts,
        traces: if request.trace && improves { vec![incumbents] } else { Vec::new() },
        reason: (!is_solved).then(|| format!("no path after {} iterations", found.iterations)),
    }
}

/// A step of a tree from a node toward a sample: the new configuration, if the motion to it is free.
pub(super) fn extended(
    motions: &mut Motions<'_>,
    tree: &Tree,
    from: u32,
    sample: &[f64],
    range: f64,
) -> Option<Vec<f64>> {
    let to = motions.toward(tree.config(from), sample, range);
    motions.goes(tree.config(from), &to).then_some(to)
}

#[cfg(test)]
mod tests;
