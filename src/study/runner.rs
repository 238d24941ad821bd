//! Runs a study: units of work in parallel, each kept in the journal as soon as it is done.
//!
//! A unit is one prepared object with all its trials, so that parallelism and resume follow what is costly.
//! Units are numbered by reading, problem group and replicate; results are put together in that order, so the
//! number of threads and the order of completion change nothing.

use super::checked::Study;
use super::clock;
use super::error::StudyError;
use super::family::Family;
use super::group::{Families, Group};
use super::inputs::Inputs;
use super::prepared::Prepared;
use super::reading::ReadingChoice;
use super::record::{Batch, Timing};
use super::spec::TimingSpec;
use super::store::Journal;
use super::task::Task;
use super::unit::{Entrant, Terms, Unit, draw_name, reading_suffix};
use base::seed;
use engine::planner::Request;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

/// Who watches a run.
pub trait Progress: Sync {
    /// A pass over `total` steps begins.
    fn begin(&self, what: &str, total: usize);
    /// One more step is done.
    fn step(&self);
    /// The pass is over.
    fn end(&self);
}

/// Nobody watches.
#[derive(Debug, Clone, Copy)]
pub struct Unwatched;

impl Progress for Unwatched {
    fn begin(&self, _what: &str, _total: usize) {}
    fn step(&self) {}
    fn end(&self) {}
}

/// How many times the clock's sample is gone through; each time takes its share of the repeats.
const PASSES: u32 = 4;

/// A study with everything built that its trials share.
pub struct BuiltStudy<'a> {
    study: &'a Study,
    terms: Terms<'a>,
    task: Box<dyn Task>,
    points: &'a [ReadingChoice],
    families: Vec<Vec<Arc<dyn Family>>>,
    entrants: Vec<Vec<Entrant<'a>>>,
}

impl<'a> BuiltStudy<'a> {
    /// Builds every family and pipeline under every point.
    ///
    /// # Errors
    /// Those of families and pipelines; none in a study that was loaded with the same inputs.
    pub fn new(study: &'a Study, points: &'a [ReadingChoice], inputs: &Inputs) -> Result<Self, StudyError> {
        let (mut families, mut built) = (Vec::new(), Families::default());
        let mut entrants = Vec::new();
        for point in points {
            let of = |group| built.of(group, point, inputs);
            families.push(study.groups.iter().map(of).collect::<Result<Vec<_>, _>>()?);
            let mut line_up = Vec::new();
            for contender in &study.contenders {
                for sweep in study.sweep_points() {
                    let pipeline = contender.pipeline(point, &sweep)?;
                    line_up.push(Entrant { contender, sweep, pipeline });
                }
            }
            entrants.push(line_up);
        }
        let (paper, name, keeps) = (&study.paper, &study.name, study.kept().collect());
        let terms = Terms { paper, study: name, seed: study.seed, budget: study.budget, keeps };
        Ok(Self { study, terms, task: (study.task.build)(&study.task_settings)?, points, families, entrants })
    }

    /// Every unit, in the order of records.
    pub fn units(&self) -> Vec<Unit<'_>> {
        let mut units = Vec::new();
        for (i, point) in self.points.iter().enumerate() {
            for (group, family) in self.study.groups.iter().zip(&self.families[i]) {
                for replicate in 0..group.replicates {
                    units.push(self.unit(point, &self.entrants[i], group, family.as_ref(), replicate));
                }
            }
        }
        units
    }

    fn unit<'b>(
        &'b self,
        point: &'b ReadingChoice,
        entrants: &'b [Entrant<'b>],
        group: &'b Group,
        family: &'b dyn Family,
        replicate: u32,
    ) -> Unit<'b> {
        let number = replicate.to_string();
        let names: &[&str] = match &group.draw {
            Some(draw) => &[&self.study.paper, "draw", draw, &number],
            None => &[&self.study.paper, &self.study.name, "problem", &group.label, &number],
        };
        Unit {
            terms: &self.terms,
            name: draw_name(group, replicate) + &reading_suffix(point),
            group,
            family,
            point,
            entrants,
            replicate,
            seed: seed::derive(self.study.seed, names),
            keeps_all: false,
            wanted: None,
        }
    }

    /// Files that the families read.
    pub fn inputs(&self) -> Vec<std::path::PathBuf> {
        let mut files: Vec<_> =
            self.families.iter().flatten().flat_map(|family| family.inputs().to_vec()).collect();
        files.sort();
        files.dedup();
        files
    }

    /// The names of one unit's trials.
    pub fn trials(&self, unit: &Unit<'_>) -> Vec<String> {
        self.task.trials(unit)
    }

    /// One unit's records.
    pub fn run_unit(&self, unit: &Unit<'_>) -> Batch {
        self.task.run(unit)
    }

    /// Runs every unit that `done` does not hold yet, in the current thread pool.
    ///
    /// # Errors
    /// [`StudyError::Interrupted`] if `stop` was set; an error of the journal.
    pub fn run(
        &self,
        mut done: BTreeMap<usize, Batch>,
        journal: &Mutex<Journal>,
        stop: &AtomicBool,
        progress: &dyn Progress,
    ) -> Result<Batch, StudyError> {
        let units = self.units();
        let todo: Vec<usize> = (0..units.len()).filter(|index| !done.contains_key(index)).collect();
        progress.begin(&format!("{}: trials", self.study.name), todo.len());
        let work = |index: &usize| -> Result<Option<(usize, Batch)>, StudyError> {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let batch = self.run_unit(&units[*index]);
            journal.lock().expect("no thread panics while it writes").append(*index, &batch)?;
            progress.step();
            Ok(Some((*index, batch)))
        };
        let fresh: Vec<_> = todo.par_iter().map(work).collect::<Result<_, _>>()?;
        progress.end();
        done.extend(fresh.into_iter().flatten());
        if done.len() < units.len() {
            let study = self.study.name.clone();
            return Err(StudyError::Interrupted { study, kept: done.len(), total: units.len() });
        }
        Ok(done.into_values().fold(Batch::default(), |mut all, batch| {
            all.prepared.extend(batch.prepared);
            all.rows.extend(batch.rows);
            all.kept.extend(batch.kept);
            all
        }))
    }

    /// The timed passes: one thread, warmed up, with only the pipeline's call between two readings of the clock.
    ///
    /// They time the first draws of every group under the first point, every contender and sweep. A machine that gets
    /// slower or faster meanwhile must not favour anyone: contenders take turns within each repeat, forwards and backwards,
    /// and the repeats are spread over several passes through the whole sample.
    ///
    /// # Errors
    /// [`StudyError::Interrupted`] if `stop` was set: half a sample would favour the first groups.
    pub fn time(&self, stop: &AtomicBool, progress: &dyn Progress) -> Result<Vec<Timing>, StudyError> {
        let Some(timing) = self.study.timing else { return Ok(Vec::new()) };
        let units = self.units();
        let total = units.len();
        let is_timed = |unit: &&Unit<'_>| *unit.point == self.points[0] && unit.replicate < timing.problems;
        let sample: Vec<(&Unit<'_>, Prepared)> = units
            .iter()
            .filter(is_timed)
            .filter_map(|unit| Some((unit, unit.family.prepare(unit.seed).ok()?)))
            .collect();
        let passes = PASSES.min(timing.repeats);
        progress.begin(&format!("{}: clock", self.study.name), sample.len() * passes as usize);
        let mut readings = Vec::new();
        for pass in 0..passes {
            for (unit, prepared) in &sample {
                if stop.load(Ordering::Relaxed) {
                    progress.end();
                    let study = self.study.name.clone();
                    return Err(StudyError::Interrupted { study, kept: total, total });
                }
                let repeats: Vec<u32> = (pass..timing.repeats).step_by(passes as usize).collect();
                self.time_unit(unit, prepared, timing, &repeats, &mut readings);
                progress.step();
            }
        }
        progress.end();
        Ok(readings)
    }

    fn time_unit(
        &self,
        unit: &Unit<'_>,
        prepared: &Prepared,
        timing: TimingSpec,
        repeats: &[u32],
        readings: &mut Vec<Timing>,
    ) {
        for query in &unit.queries() {
            let seeds = |entrant: &Entrant<'_>| entrant.contender.repeats.min(timing.seeds.unwrap_or(1));
            let of_entrant = |entrant| (0..seeds(entrant)).map(move |seed| (entrant, seed));
            let runs = unit.entrants.iter().flat_map(of_entrant);
            let request = |(entrant, seed): &(&Entrant<'_>, u32)| Request {
                world: &prepared.world,
                start: &query.start,
                goal: &query.goal,
                expansions: self.study.budget.expansions,
                seed: entrant.seed(&self.terms, &unit.problem(query), *seed),
                trace: false,
            };
            let warmed: Vec<_> = runs.filter(|run| run.0.pipeline.plan(&request(run)).is_ok()).collect();
            let mut read = |run: &(&Entrant<'_>, u32), repeat: u32| {
                let request = request(run);
                readings.push(Timing {
                    trial: unit.trial(query, run.0, run.1),
                    group: unit.group.label.clone(),
                    contender: run.0.contender.label.clone(),
                    replicate: unit.replicate,
                    repeat,
                    plan_wall_ns: clock::timed(|| run.0.pipeline.plan(&request)).0,
                });
            };
            for (turn, repeat) in repeats.iter().enumerate() {
                for place in 0..warmed.len() {
                    let whose = if turn % 2 == 0 { place } else { warmed.len() - 1 - place };
                    read(&warmed[whose], *repeat);
                }
            }
        }
    }
}
