//! Runs a study: units of work in parallel, each kept in the journal as soon as it is done.
//!
//! A unit is one preprocessed object with all its trials, so that parallelism and resume follow what is costly.
//! Units are numbered by interpretation, problem group, point of the sweeps over it and instance; results are put together in that order, so the
//! number of threads and the order of completion change nothing.

mod timed;

use super::checked::Study;
use super::choice::Interpretation;
use super::clock;
use super::contender::{Pipelines, SweepPoint};
use super::error::StudyError;
use super::family::Family;
use super::group::{Families, Group};
use super::inputs::Inputs;
use super::key::{InstanceKey, InterpretationKey, Text, TrialKey};
use super::name::{self, Names};
use super::record::{Batch, PreprocessingRow, Row};
use super::store::Journal;
use super::task::Task;
use super::unit::{Entrant, StudyContext, Unit};
use base::hash::sha256;
use base::seed;
use rayon::prelude::*;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
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

/// The number of the session in which a run reads the clock. Its times replace all older ones; later sessions are kept
/// beside it.
pub const SESSION: u32 = 1;

/// What is stored of a unit.
#[derive(Debug, Clone, Default)]
pub struct StoredUnit<'s> {
    /// Its preprocessed objects.
    pub preprocessing: Vec<&'s PreprocessingRow>,
    /// Its trials.
    pub rows: Vec<&'s Row>,
}

/// What is stored of a unit when other contenders' trials of it must run.
#[derive(Debug, Default)]
pub struct Part<'s> {
    /// The contenders whose trials are stored.
    pub contenders: BTreeSet<Text>,
    /// What is stored of the unit.
    pub stored: StoredUnit<'s>,
}

/// A study with everything built that its trials share.
pub struct BuiltStudy<'a> {
    study: &'a Study,
    inputs: &'a Inputs,
    terms: StudyContext<'a>,
    task: Box<dyn Task>,
    points: &'a [Interpretation],
    interpretations: Vec<InterpretationKey>,
    /// Every problem group at every point of the sweeps over it.
    posed: Vec<(&'a Group, Text, &'a SweepPoint)>,
    /// The number of each one's first unit, and after them how many units an interpretation has.
    starts: Vec<usize>,
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
        let posed: Vec<(&Group, Text, &SweepPoint)> =
            study.posed().map(|(group, at)| (group, group.label.as_str().into(), at)).collect();
        let mut starts = vec![0];
        starts.extend(posed.iter().scan(0, |end, (group, ..)| {
            *end += group.instances as usize;
            Some(*end)
        }));
        Ok(Self { study, inputs, terms, task, points, interpretations, posed, starts, families, entrants })
    }

    /// Every unit, in the order of records.
    pub fn units(&self) -> impl ExactSizeIterator<Item = Unit<'_>> {
        (0..self.starts.last().map_or(0, |count| count * self.points.len())).map(|index| self.unit(index))
    }

    /// The unit with this number.
    ///
    /// # Panics
    /// If there is none.
    pub fn unit(&self, index: usize) -> Unit<'_> {
        let each = self.starts[self.posed.len()];
        let (interpretation, number) = (index / each, index % each);
        let place = self.starts.partition_point(|start| *start <= number) - 1;
        let (group, label, at) = &self.posed[place];
        let key = InstanceKey {
            group: label.clone(),
            sweep: at.key.clone(),
            instance: (number - self.starts[place]) as u32,
            interpretation: self.interpretations[interpretation].clone(),
        };
        self.posed_unit(key, group, interpretation, place)
    }

    /// The unit called `key`: of the interpretation at one place, and of `group` at its point of the sweeps at the other.
    fn posed_unit<'s>(
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

    /// Checks that every program and archive is there for the units in `todo` that are not in `parts`.
    ///
    /// # Errors
    /// [`StudyError::Lacks`] or [`StudyError::LacksFiles`] for the first that is not.
    pub fn check_programs(
        &self,
        todo: &[usize],
        parts: &BTreeMap<usize, Part<'_>>,
    ) -> Result<(), StudyError> {
        for index in todo {
            let unit = self.unit(*index);
            let stored = |entrant: &Entrant<'_>| {
                parts.get(index).is_some_and(|part| part.contenders.contains(&entrant.label))
            };
            for entrant in unit.entrants.iter().filter(|entrant| !stored(entrant)) {
                self.check_files(&unit)?;
                if let Some(lacks) = entrant.pipeline.planner.lacks() {
                    let study = self.study.name.clone();
                    let contender = entrant.contender.label.clone();
                    return Err(StudyError::Lacks { study, contender, lacks });
                }
            }
        }
        Ok(())
    }

    /// Seconds of one core that a trial takes, as measured on the first instance of each problem group; its records are dropped.
    /// Of trials that start programs these are seconds on the clock. `None` without trials, and where programs or files are needed that
    /// may not run or are not there.
    pub fn seconds_a_trial(&self, starts_programs: bool) -> Option<f64> {
        let none = BTreeMap::new();
        let is_first = |index: &usize| self.unit(*index).key.instance == 0;
        let first: Vec<usize> = (0..self.units().len()).filter(is_first).collect();
        let can_run = self.study.recorded().next().is_none() && self.check_programs(&first, &none).is_ok();
        let trials: usize = first.iter().map(|index| self.trials(&self.unit(*index)).len()).sum();
        if !can_run || trials == 0 {
            return None;
        }
        let run = || self.alike(&first, &none).iter().for_each(|alike| drop(self.run_alike(alike, &none)));
        let spent = || if starts_programs { clock::timed(run).0 } else { clock::spent_ns(run) };
        let nanoseconds = pool(Some(1)).install(spent);
        Some(nanoseconds as f64 * 1e-9 / trials as f64)
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

    /// How many different trials there are: a contender's trials on a problem run once for all interpretations that set the same of both.
    pub fn different_trials(&self) -> u64 {
        let each = self.starts[self.posed.len()];
        let mut seen = BTreeSet::new();
        let mut count = 0;
        for interpretation in 0..self.points.len() {
            for (place, (group, ..)) in self.posed.iter().enumerate() {
                let unit = self.unit(interpretation * each + self.starts[place]);
                let family = std::ptr::from_ref(unit.family).cast::<()>();
                let own = self.trials(&unit).len() as u64 * u64::from(group.instances);
                let of_all = unit.entrants.iter().map(|entrant| entrant.contender.repeats).sum::<u32>();
                if unit.entrants.is_empty() && seen.insert((place, family, None)) {
                    count += own;
                }
                for (at, entrant) in unit.entrants.iter().enumerate() {
                    let pipeline = (at, Arc::as_ptr(&entrant.pipeline));
                    if seen.insert((place, family, Some(pipeline))) {
                        count += own * u64::from(entrant.contender.repeats) / u64::from(of_all);
                    }
                }
            }
        }
        count
    }

    /// One unit's records.
    pub fn run_unit(&self, unit: &Unit<'_>) -> Batch {
        self.task.run(unit)
    }

    /// One unit's records: those stored in `part`, and those of the other contenders, which run now.
    fn run_rest(&self, unit: &Unit<'_>, part: &Part<'_>) -> Batch {
        let mut rest = unit.clone();
        rest.entrants.retain(|entrant| !part.contenders.contains(&entrant.label));
        let fresh = self.run_unit(&rest);
        let stored = &part.stored;
        let preprocessing = stored.preprocessing.first().copied().or(fresh.preprocessing.first());
        let rows = self.in_order(unit, stored.rows.iter().copied().chain(&fresh.rows));
        Batch { preprocessing: preprocessing.into_iter().cloned().collect(), rows, kept: fresh.kept }
    }

    /// The records of a unit that is stored whole.
    pub fn stored_whole(&self, unit: &Unit<'_>, stored: &StoredUnit<'_>) -> Batch {
        let rows = stored.rows.iter().copied();
        let preprocessing = stored.preprocessing.iter().copied().cloned();
        let (rows, preprocessing) = if unit.entrants.is_empty() {
            (rows.cloned().collect(), preprocessing.collect())
        } else {
            (self.in_order(unit, rows), preprocessing.take(1).collect())
        };
        Batch { preprocessing, rows, kept: Vec::new() }
    }

    /// Those of `rows` that are the unit's, in the order in which a run gives them.
    fn in_order<'r>(&self, unit: &Unit<'_>, rows: impl Iterator<Item = &'r Row>) -> Vec<Row> {
        let rows: BTreeMap<&TrialKey, &Row> = rows.map(|row| (&row.key, row)).collect();
        self.trials(unit).iter().filter_map(|key| rows.get(key).copied().cloned()).collect()
    }

    /// Runs the units in `todo` in the current thread pool and leaves their records in the journal. Where `parts` holds some
    /// contenders' trials of a unit, only the others' run.
    ///
    /// # Errors
    /// [`StudyError::Interrupted`] if `stop` was set, with how many of the run's units, `total` in all, are kept; an error of the
    /// journal.
    pub fn run(
        &self,
        (todo, total): (&[usize], usize),
        parts: &BTreeMap<usize, Part<'_>>,
        journal: &Mutex<Journal>,
        stop: &AtomicBool,
        progress: &dyn Progress,
    ) -> Result<(), StudyError> {
        progress.begin(&format!("{}: trials", self.study.name), todo.len());
        let left = AtomicUsize::new(todo.len());
        let work = |alike: &Vec<usize>| -> Result<(), StudyError> {
            if stop.load(Ordering::Relaxed) {
                return Ok(());
            }
            let found = self.run_alike(alike, parts);
            if external::is_interrupted() && self.study.recorded().next().is_some() {
                // What a planner from outside was cut off in is no result.
                return Ok(());
            }
            for (index, batch) in alike.iter().zip(found) {
                journal.lock().expect("no thread panics while it writes").append(*index, batch)?;
                left.fetch_sub(1, Ordering::Relaxed);
                progress.step();
            }
            Ok(())
        };
        self.alike(todo, parts).par_iter().try_for_each(work)?;
        progress.end();
        match left.into_inner() {
            0 => Ok(()),
            left => {
                Err(StudyError::Interrupted { study: self.study.name.clone(), kept: total - left, total })
            }
        }
    }

    /// The records of the units with these numbers, which share what is prepared.
    fn run_alike(&self, alike: &[usize], parts: &BTreeMap<usize, Part<'_>>) -> Vec<Batch> {
        let units: Vec<Unit<'_>> = alike.iter().map(|index| self.unit(*index)).collect();
        match (&units[..], alike.first().and_then(|index| parts.get(index))) {
            ([unit], Some(part)) => vec![self.run_rest(unit, part)],
            _ => self.task.run_alike(&units.iter().collect::<Vec<_>>()),
        }
    }

    /// The units in `todo`, grouped by family and seed, since such units of several interpretations share what is prepared;
    /// interpretations that change contenders alone go together too. Groups are in the order of their first units.
    fn alike(&self, todo: &[usize], parts: &BTreeMap<usize, Part<'_>>) -> Vec<Vec<usize>> {
        let mut all: Vec<Vec<usize>> = Vec::new();
        let mut places = BTreeMap::new();
        for &index in todo {
            let unit = self.unit(index);
            if self.interpretations.len() == 1 || parts.contains_key(&index) {
                all.push(vec![index]);
                continue;
            }
            let family = std::ptr::from_ref(unit.family).cast::<()>();
            match places.entry((family, std::ptr::from_ref(unit.group), unit.seed)) {
                Entry::Occupied(place) => {
                    let alike: &mut Vec<usize> = &mut all[*place.get()];
                    alike.push(index);
                }
                Entry::Vacant(place) => {
                    place.insert(all.len());
                    all.push(vec![index]);
                }
            }
        }
        all
    }
}

/// A pool of `threads` threads; of the machine's number if absent.
pub(super) fn pool(threads: Option<usize>) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .expect("the system gives a process its first threads")
}
