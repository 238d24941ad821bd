//! Every contender plans on every problem; the verifier checks what comes back.

use super::{Entry, Task};
use crate::family::Query;
use crate::key::{InstanceKey, Owner, TrialKey};
use crate::preprocessing::Preprocessing;
use crate::record::{Batch, Kept, Row, Status};
use crate::unit::{Entrant, Unit};
use crate::verification::{self, Guide, Truth};
use base::settings::{Accepted, NoSettings};
use engine::planner::{Counts, Invalid, Plan, Request, Trace};
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "plan",
    about: "every contender plans on every problem; the verifier checks what comes back",
    revision: 1,
    columns: &[],
    settings: Accepted::shape::<NoSettings>(),
    example: "",
    build: |settings| {
        let NoSettings {} = settings.read()?;
        Ok(Box::new(PlanTask))
    },
};

struct PlanTask;

impl Task for PlanTask {
    fn run(&self, unit: &Unit<'_>) -> Batch {
        self.run_alike(&[unit]).remove(0)
    }

    fn run_alike(&self, units: &[&Unit<'_>]) -> Vec<Batch> {
        let [first, ..] = units else { return Vec::new() };
        let queries = first.queries();
        let preprocessing = first.family.prepare(first.seed);
        let guide = guide(&preprocessing, &queries);
        let mut batches = vec![Batch::default(); units.len()];
        for (unit, batch) in units.iter().zip(&mut batches) {
            begin(unit, &preprocessing, batch);
        }
        let run = |index: usize| {
            // What the verifier learns about a query on one unit it need not work out again on the next.
            let truth =
                preprocessing.as_ref().ok().map(|p| verification::truth(&p.world, &queries[index], &guide));
            run_query(units, (preprocessing.as_ref(), truth.as_ref()), (index, &queries[index]))
        };
        // A roadmap numbers the ends of its queries as they come, so that their order matters; a lattice learns nothing.
        let is_lattice = preprocessing.as_ref().is_ok_and(|p| p.world.as_lattice().is_some());
        let done: Vec<Vec<Batch>> = if is_lattice {
            (0..queries.len()).into_par_iter().map(run).collect()
        } else {
            (0..queries.len()).map(run).collect()
        };
        for of_query in done {
            batches.iter_mut().zip(of_query).for_each(|(batch, part)| batch.add(part));
        }
        batches
    }
}

fn guide(preprocessing: &Result<Preprocessing, Invalid>, queries: &[Query]) -> Guide {
    preprocessing.as_ref().map_or_else(|_| Guide::default(), |p| Guide::new(&p.world, queries))
}

/// Writes what is known of the preprocessed object itself.
fn begin(unit: &Unit<'_>, preprocessing: &Result<Preprocessing, Invalid>, batch: &mut Batch) {
    batch.preprocessing.push(super::preprocessing_row(unit, preprocessing.as_ref()));
    if let Ok(preprocessing) = preprocessing
        && unit.is_kept(None, 0)
    {
        batch.keep(&(&unit.key).into(), preprocessing.traces.clone());
    }
}

/// Every contender on one query in each of `units`; one that several units have plans once.
fn run_query(
    units: &[&Unit<'_>],
    (preprocessing, truth): (Result<&Preprocessing, &Invalid>, Option<&Truth>),
    (index, query): (usize, &Query),
) -> Vec<Batch> {
    let known = units[0].family.known(index);
    let run = |(unit, entrant): &(&Unit<'_>, &Entrant<'_>)| {
        let mut batch = Batch::default();
        for repeat in 0..entrant.contender.repeats {
            let trial = Trial { unit, query, entrant, repeat, known: &known };
            match (preprocessing, truth) {
                (Ok(preprocessing), Some(truth)) => trial.run(preprocessing, truth, &mut batch),
                (Err(invalid), _) => batch.rows.push(trial.invalid(invalid)),
                (Ok(_), None) => unreachable!("the truth is known wherever the world is"),
            }
        }
        batch
    };
    let mut different: Vec<(&Unit<'_>, &Entrant<'_>)> = Vec::new();
    let mut places = Vec::new();
    for unit in units {
        let mut of_unit = Vec::new();
        for entrant in unit.entrants.iter().copied() {
            let place = different.iter().position(|(_, known)| entrant.plans_as(known));
            of_unit.push(place.unwrap_or(different.len()));
            if place.is_none() {
                different.push((unit, entrant));
            }
        }
        places.push(of_unit);
    }
    // Nothing is learnt from one trial to the next among polyhedra, where one may take seconds, and on a lattice, where units that
    // share one may be all that there is to do.
    let is_shared_out = preprocessing
        .is_ok_and(|p| p.world.as_polyhedra().is_some() || p.world.as_lattice().is_some() && units.len() > 1);
    let done: Vec<Batch> = if is_shared_out {
        different.par_iter().map(run).collect()
    } else {
        different.iter().map(run).collect()
    };
    if units.len() == 1 {
        return vec![done.into_iter().fold(Batch::default(), Batch::with)];
    }
    let of_unit = |(unit, places): (&&Unit<'_>, Vec<usize>)| {
        let mut batch = Batch::default();
        for place in places {
            batch.add(done[place].under(&unit.key));
        }
        batch
    };
    units.iter().zip(places).map(of_unit).collect()
}

impl Batch {
    /// Adds trials and what is kept of them.
    fn add(&mut self, part: Self) {
        self.rows.extend(part.rows);
        self.kept.extend(part.kept);
    }

    /// The same trials, as those of the instance called `key`.
    fn under(&self, key: &Arc<InstanceKey>) -> Self {
        let row = |row: &Row| Row { key: TrialKey { on: key.clone(), ..row.key.clone() }, ..row.clone() };
        let kept = |kept: &Kept| Kept { owner: kept.owner.clone().moved_to(key.clone()), ..kept.clone() };
        Self {
            preprocessing: Vec::new(),
            rows: self.rows.iter().map(row).collect(),
            kept: self.kept.iter().map(kept).collect(),
        }
    }

    fn keep(&mut self, owner: &Owner, traces: Vec<Trace>) {
        self.kept.extend(traces.into_iter().map(|trace| Kept { owner: owner.clone(), trace }));
    }
}

struct Trial<'a> {
    unit: &'a Unit<'a>,
    query: &'a Query,
    entrant: &'a Entrant<'a>,
    repeat: u32,
    known: &'a Counts,
}

impl Trial<'_> {
    fn run(&self, preprocessing: &Preprocessing, truth: &Truth, batch: &mut Batch) {
        let seed = self.entrant.seed(self.unit.terms, &self.problem(), self.repeat);
        let label = self.entrant.contender.label.as_str();
        let trace = self.unit.is_kept(Some(label), self.repeat);
        let request = Request {
            world: &preprocessing.world,
            start: &self.query.start,
            goal: &self.query.goal,
            expansions: self.unit.terms.budget.expansions,
            seed,
            trace,
        };
        let mut row = self.row(seed);
        match catch_unwind(AssertUnwindSafe(|| self.entrant.pipeline.plan(&request))) {
            Err(panic) => (row.status, row.reason) = (Status::Crashed, Some(panic_text(panic.as_ref()))),
            Ok(Err(invalid)) => (row.status, row.reason) = (Status::InvalidProblem, Some(invalid.0)),
            Ok(Ok(mut plan)) => {
                let verified = verification::verify(&request, &plan, &self.entrant.pipeline, truth);
                (row.status, row.reason) = verified.outcome;
                if row.status == Status::Rejected {
                    // The verifier's word first, then the planner's.
                    row.reason =
                        row.reason.into_iter().chain(plan.reason.take()).reduce(|a, b| format!("{a}; {b}"));
                }
                row.values
                    .extend(plan.counts.iter().chain(&verified.values).map(|(name, value)| (*name, *value)));
                if trace {
                    let mut traces = std::mem::take(&mut plan.traces);
                    traces.extend(verified.traces);
                    traces.retain(|trace| self.unit.keeps(label, self.repeat, &trace.name));
                    batch.keep(&(&row.key).into(), traces);
                    batch.keep(&(&row.key).into(), path_trace(&plan));
                }
            }
        }
        batch.rows.push(row);
    }

    fn invalid(&self, invalid: &Invalid) -> Row {
        let seed = self.entrant.seed(self.unit.terms, &self.problem(), self.repeat);
        let mut row = self.row(seed);
        (row.status, row.reason) = (Status::InvalidProblem, Some(invalid.0.clone()));
        row
    }

    fn problem(&self) -> String {
        self.unit.problem(self.query)
    }

    fn row(&self, seed: u64) -> Row {
        Row {
            key: self.unit.trial(self.query, self.entrant, self.repeat),
            seed: Some(seed),
            status: Status::Crashed,
            reason: None,
            values: super::named(self.known),
        }
    }
}

fn path_trace(plan: &Plan) -> Vec<Trace> {
    let Some(first) = plan.path.first() else { return Vec::new() };
    vec![Trace { name: "path".to_owned(), width: first.len(), values: plan.path.concat() }]
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without a message".to_owned())
}
