//! Runs a study: units of work in parallel, each kept in the journal as soon as it is done.
//!
//! A unit is one preprocessed object with all its trials, so that parallelism and resume follow what is costly.
//! Units are numbered by interpretation, problem group, point of the sweeps over it and instance; results are put together in that order, so the
//! number of threads and the order of completion change nothing.

mod timed;

use super::checked::Study;
use super::choice::Interpretation;
use super::contender::{Pipelines, SweepPoint};
use super::error::StudyError;
use super::family::Family;
use super::group::{Families, Group};
use super::inputs::Inputs;
use super::key::{InstanceKey, InterpretationKey, Text, TrialKey};
use super::name::{self, Names};
use super::record::{Batch, Row};
use super::store::Journal;
use super::task::Task;
use super::unit::{Entrant, StudyContext, Unit};
use base::hash::sha256;
use base::seed;
use engine::space::WorldKind;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
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

/// The number of the session in which a run reads the clock: its times replace all older ones. Later sessions are read
/// beside it.
pub const SESSION: u32 = 1;

/// What is stored of a unit when other contenders' trials of it must run.
#[derive(Debug, Default)]
pub struct Part {
    /// The contenders whose trials are stored.
    pub contenders: BTreeSet<Text>,
    /// What is stored of the unit.
    pub stored: Batch,
}

/// A study with everything built that its trials share.
pub struct BuiltStudy<'a> {
    study: &'a Study,
    inputs: &'a Inputs,
    terms: StudyContext<'a>,
    task: Box<dyn Task>,
    points: &'a [Interpretation],
    interpretations: Vec<InterpretationKey>,
    families: Vec<Vec<Arc<dyn Family>>>,
    /// By interpretation, then by problem group at its points of the sweeps.
    entrants: Vec<Vec<Arc<Vec<Entrant<'a>>>>>,
}

impl<'a> BuiltStudy<'a> {
    /// Builds every family and pipeline under every point.
    ///
    /// # Errors
    /// Those of families and pipelines; none in a study that was loaded with the same inputs.
    pub fn new(
        study: &'a Study,
        points: &'a [Interpretation],
        inputs: &'a Inputs,
    ) -> Result<Self, StudyError> {
        let mut families = Vec::new();
        let mut entrants = Vec::new();
        let mut built = Families::default();
        let mut pipelines = Pipelines::default();
        let labels: Vec<Text> = study.contenders.iter().map(|c| c.label.as_str().into()).collect();
        let sweeps = study.contender_points();
        for point in points {
            let of = |posed| built.family(posed, point, inputs);
            families.push(study.posed().map(of).collect::<Result<Vec<_>, _>>()?);
            let mut line_up = |point: &Interpretation| -> Result<_, StudyError> {
                let mut line_up = Vec::new();
                for (contender, label) in study.contenders.iter().zip(&labels) {
                    for sweep in &sweeps {
                        let (label, sweep) = (label.clone(), sweep.clone());
                        let pipeline = pipelines.pipeline(contender, point, &sweep)?;
                        line_up.push(Entrant { contender, label, sweep, pipeline });
                    }
                }
                Ok(Arc::new(line_up))
            };
            let shared = line_up(point)?;
            let of_group = |(group, _): (&Group, _)| match group.stage {
                Some(_) => line_up(&group.seen_by_contenders(point)),
                None => Ok(shared.clone()),
            };
            entrants.push(study.posed().map(of_group).collect::<Result<Vec<_>, _>>()?);
        }
        let paper = &study.paper;
        let name = &study.name;
        let keeps = study.kept().collect();
        let names = study.names();
        let seed = study.seed;
        let budget = study.budget;
        let terms = StudyContext { paper, study: name, names, seed, budget, keeps };
        let interpretations = points.iter().map(|point| point.key(&study.choices)).collect();
        let task = (study.task.build)(&study.task_settings)?;
        Ok(Self { study, inputs, terms, task, points, interpretations, families, entrants })
    }

    /// Every unit, in the order of records.
    pub fn units(&self) -> Vec<Unit<'_>> {
        let mut units = Vec::new();
        let posed: Vec<(&Group, Text, &SweepPoint)> =
            self.study.posed().map(|(group, at)| (group, group.label.as_str().into(), at)).collect();
        for interpretation in 0..self.points.len() {
            for (place, (group, label, at)) in posed.iter().enumerate() {
                for instance in 0..group.instances {
                    let interpretation_key = self.interpretations[interpretation].clone();
                    let key = InstanceKey {
                        group: label.clone(),
                        sweep: at.key.clone(),
                        instance,
                        interpretation: interpretation_key,
                    };
                    units.push(self.unit(key, group, interpretation, place));
                }
            }
        }
        units
    }

    /// The unit called `key`: of the reading and of the problem group at its point of the sweeps at these places.
    fn unit<'s>(
        &'s self,
        key: InstanceKey,
        group: &'s Group,
        interpretation: usize,
        place: usize,
    ) -> Unit<'s> {
        let number = key.instance.to_string();
        let at = name::sweep(&key.sweep);
        let mut names: Vec<&str> = match &group.shared_instances {
            // Points of a sweep share the seeds of a group whose instances have a name.
            Some(instance) => vec![&self.study.paper, "draw", instance],
            None => vec![&self.study.paper, &self.study.name, "problem", &group.label],
        };
        if group.shared_instances.is_none() && !at.is_empty() {
            names.push(&at);
        }
        names.push(&number);
        let family = self.families[interpretation][place].as_ref();
        let is_numbered = family.numbers_instances();
        Unit {
            terms: &self.terms,
            group,
            family,
            point: &self.points[interpretation],
            entrants: self.entrants[interpretation][place].iter().collect(),
            seed: if is_numbered { key.instance.into() } else { seed::derive(self.study.seed, &names) },
            key: Arc::new(key),
            keeps_all: false,
        }
    }

    /// The SHA-256 of every file that the families read, by the name that a spec gives it.
    ///
    /// # Errors
    /// [`StudyError::Io`] if one has gone.
    pub fn inputs(&self) -> Result<BTreeMap<String, String>, StudyError> {
        let mut all = BTreeMap::new();
        for (interpretation, families) in self.families.iter().enumerate() {
            for place in 0..families.len() {
                all.extend(self.inputs_of(interpretation, place)?);
            }
        }
        Ok(all)
    }

    /// As [`inputs`](Self::inputs), of one problem group at one point of the sweeps under one interpretation, by their places.
    ///
    /// # Errors
    /// As [`inputs`](Self::inputs).
    pub fn inputs_of(
        &self,
        interpretation: usize,
        place: usize,
    ) -> Result<BTreeMap<String, String>, StudyError> {
        let hash = |path: &PathBuf| {
            let bytes = fs::read(path).map_err(StudyError::io(path, "reading an input file"))?;
            Ok((self.inputs.spelled(path), sha256(&bytes)))
        };
        self.families[interpretation][place].inputs().iter().map(hash).collect()
    }

    /// The SHA-256 of every file that the contender called `label` depends on under the interpretation at this place.
    ///
    /// # Errors
    /// As [`inputs`](Self::inputs).
    pub fn files_of(
        &self,
        interpretation: usize,
        label: &str,
    ) -> Result<BTreeMap<String, String>, StudyError> {
        let all = self.entrants[interpretation].iter().flat_map(|line_up| line_up.iter());
        let own = all.filter(|entrant| *entrant.label == *label);
        let files: BTreeSet<&PathBuf> = own.flat_map(|entrant| entrant.pipeline.planner.files()).collect();
        let hash = |path: &PathBuf| {
            let bytes = fs::read(path).map_err(StudyError::io(path, "reading a planner's file"))?;
            Ok((path.display().to_string(), sha256(&bytes)))
        };
        files.into_iter().map(hash).collect()
    }

    /// That the files are there that the problems of a unit need.
    ///
    /// # Errors
    /// [`StudyError::LacksFiles`] if one is not.
    pub fn check_files(&self, unit: &Unit<'_>) -> Result<(), StudyError> {
        let Some(lacks) = unit.family.lacks() else { return Ok(()) };
        let study = self.study.name.clone();
        let group = unit.group.label.clone();
        Err(StudyError::LacksFiles { study, group, lacks })
    }

    /// That every program and every archive is there whose trials are not `done` and not in `parts`.
    ///
    /// # Errors
    /// [`StudyError::Lacks`] or [`StudyError::LacksFiles`] for the first that is not.
    pub fn check_programs(
        &self,
        only: Option<&BTreeSet<usize>>,
        done: &BTreeMap<usize, Batch>,
        parts: &BTreeMap<usize, Part>,
    ) -> Result<(), StudyError> {
        let units = self.units();
        let is_left = |(index, _): &(usize, &Unit<'_>)| {
            !done.contains_key(index) && only.is_none_or(|only| only.contains(index))
        };
        for (index, unit) in units.iter().enumerate().filter(is_left) {
            let stored = |entrant: &Entrant<'_>| {
                parts.get(&index).is_some_and(|part| part.contenders.contains(&entrant.label))
            };
            for entrant in unit.entrants.iter().filter(|entrant| !stored(entrant)) {
                self.check_files(unit)?;
                if let Some(lacks) = entrant.pipeline.planner.lacks() {
                    let study = self.study.name.clone();
                    let contender = entrant.contender.label.clone();
                    return Err(StudyError::Lacks { study, contender, lacks });
                }
            }
        }
        Ok(())
    }

    /// The study that it was built of.
    pub fn study(&self) -> &'a Study {
        self.study
    }

    /// How the study's records are named.
    pub fn names(&self) -> &Names {
        &self.terms.names
    }

    /// What names one unit's trials, in the order of records.
    pub fn trials(&self, unit: &Unit<'_>) -> Vec<TrialKey> {
        self.task.trials(unit)
    }

    /// One unit's records.
    pub fn run_unit(&self, unit: &Unit<'_>) -> Batch {
        self.task.run(unit)
    }

    /// One unit's records: those stored in `part`, and those of the other contenders, which run now.
    fn run_rest(&self, unit: &Unit<'_>, part: &Part) -> Batch {
        let mut rest = unit.clone();
        rest.entrants.retain(|entrant| !part.contenders.contains(&entrant.label));
        let fresh = self.run_unit(&rest);
        self.in_order(unit, [&part.stored, &fresh])
    }

    /// The records of `batches` that are the unit's, in the order in which a run gives them; traces are the last one's.
    pub fn in_order(&self, unit: &Unit<'_>, batches: [&Batch; 2]) -> Batch {
        let rows = batches.iter().flat_map(|batch| &batch.rows);
        let rows: BTreeMap<&TrialKey, &Row> = rows.map(|row| (&row.key, row)).collect();
        let preprocessing = batches.iter().flat_map(|batch| &batch.preprocessing);
        let preprocessing = preprocessing.take(1).cloned().collect();
        let rows =
            self.trials(unit).iter().filter_map(|key| rows.get(key).map(|row| (*row).clone())).collect();
        Batch { preprocessing, rows, kept: batches[1].kept.clone() }
    }

    /// Runs every unit, or those among `only`, that `done` does not hold yet, in the current thread pool. Where
    /// `parts` holds some contenders' trials of a unit, only the others' run. The traces are in the journal, or where the stored
    /// trials are.
    ///
    /// # Errors
    /// [`StudyError::Interrupted`] if `stop` was set; an error of the journal.
    pub fn run(
        &self,
        only: Option<&BTreeSet<usize>>,
        mut done: BTreeMap<usize, Batch>,
        parts: &BTreeMap<usize, Part>,
        journal: &Mutex<Journal>,
        stop: &AtomicBool,
        progress: &dyn Progress,
    ) -> Result<Batch, StudyError> {
        let units = self.units();
        let is_own = |index: &usize| only.is_none_or(|only| only.contains(index));
        let total = only.map_or(units.len(), BTreeSet::len);
        done.retain(|index, _| is_own(index));
        let todo: Vec<usize> =
            (0..units.len()).filter(|index| is_own(index) && !done.contains_key(index)).collect();
        progress.begin(&format!("{}: trials", self.study.name), todo.len());
        let work = |alike: &Vec<usize>| -> Result<Vec<(usize, Batch)>, StudyError> {
            if stop.load(Ordering::Relaxed) {
                return Ok(Vec::new());
            }
            let mut found = self.run_alike(&units, alike, parts);
            if external::is_interrupted() && self.study.recorded().next().is_some() {
                // What a planner from outside was cut off in is no result.
                return Ok(Vec::new());
            }
            for (index, batch) in &mut found {
                journal.lock().expect("no thread panics while it writes").append(*index, batch)?;
                progress.step();
            }
            Ok(found)
        };
        // A trial of an arm or among polyhedra may take seconds, and what it is prepared for little: a stop would wait for all of them.
        let is_apart = |index: usize| {
            let is_long = [WorldKind::Arm, WorldKind::ArmAmongPolyhedra, WorldKind::Polyhedra];
            parts.contains_key(&index) || is_long.contains(&units[index].family.world())
        };
        let todo = alike(&units, &todo, is_apart);
        let fresh: Vec<_> = todo.par_iter().map(work).collect::<Result<_, _>>()?;
        progress.end();
        done.extend(fresh.into_iter().flatten());
        if done.len() < total {
            let study = self.study.name.clone();
            return Err(StudyError::Interrupted { study, kept: done.len(), total });
        }
        Ok(done.into_values().fold(Batch::default(), Batch::with))
    }

    /// The records of the units with these numbers, which share what is prepared.
    fn run_alike(
        &self,
        units: &[Unit<'_>],
        alike: &[usize],
        parts: &BTreeMap<usize, Part>,
    ) -> Vec<(usize, Batch)> {
        let batches = match (alike, alike.first().and_then(|index| parts.get(index))) {
            ([index], Some(part)) => vec![self.run_rest(&units[*index], part)],
            _ => self.task.run_alike(&alike.iter().map(|index| &units[*index]).collect::<Vec<_>>()),
        };
        alike.iter().copied().zip(batches).collect()
    }
}

/// The units in `todo`, grouped by family and seed, since such units share what is prepared; interpretations that
/// change contenders alone go together too. Units that are `apart` stand by themselves. Groups are in the order of their first
/// units.
fn alike(units: &[Unit<'_>], todo: &[usize], apart: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = Vec::new();
    let mut places = BTreeMap::new();
    for &index in todo {
        let unit = &units[index];
        let of = (std::ptr::from_ref(unit.family).cast::<()>(), unit.group.place, &unit.key.group, unit.seed);
        if let Some(place) = places.get(&of).filter(|_| !apart(index)) {
            let of_family: &mut Vec<usize> = &mut all[*place];
            of_family.push(index);
            continue;
        }
        if !apart(index) {
            places.insert(of, all.len());
        }
        all.push(vec![index]);
    }
    all
}
