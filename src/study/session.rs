//! A run from beginning to end: resume or reuse, trials, clock, records, manifest.

use super::checked::Study;
use super::choice::Interpretation;
use super::lock::Lock;
use super::manifest::{MadeBy, Manifest, Session};
use super::name::Names;
use super::record::{Batch, Row, Status, Timing};
use super::reuse::{self, Before, Damage, Gathered, Keeps, Moved, Reusable};
use super::runner::{BuiltStudy, Progress, SESSION, pool};
use super::shard::Portion;
use super::store::{
    Columns, GROUP_VALUES, Journal, RecordWriter, Records, Shape, Staged, Traces, finish_put, open_traces,
    read_endings, remove_temporaries, stage_records,
};
use super::unit::Unit;
use super::{Inputs, StudyError};
use base::settings::did_you_mean;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

/// What runs again although it is stored.
#[derive(Debug, Clone, Copy, Default)]
pub struct Again {
    /// Everything that can be repeated, even where it is unchanged.
    pub fresh: bool,
    /// What is recorded, even where it is unchanged.
    pub record: bool,
    /// What damaged files held, which are set aside instead of refused.
    pub replaces_damaged: bool,
}

/// How to run.
pub struct Options<'a> {
    /// The right to write where records go.
    pub lock: &'a Lock,
    /// The interpretations to run; the first is the one that clocks are read under.
    pub points: &'a [Interpretation],
    /// Where input files are.
    pub inputs: &'a Inputs,
    /// The command line, for the manifest.
    pub command: String,
    /// The units to run, of a run that is cut into shards; all if absent. A shard reads no clock: times on several machines,
    /// or beside other shards, are of no session.
    pub portion: Option<&'a Portion>,
    /// Cut down by `--quick`.
    pub quick: bool,
    /// What runs again although it is stored.
    pub again: Again,
    /// How many threads; the machine's number if absent.
    pub threads: Option<usize>,
    /// Set to stop after the units at work.
    pub stop: &'a AtomicBool,
    /// Who watches.
    pub progress: &'a dyn Progress,
}

impl Options<'_> {
    /// The stored run in `folder` if it matches `manifest`, with its trials but without their numbers: nothing of it runs again.
    /// `None` also if it is damaged.
    fn current(&self, folder: &Path, manifest: &Manifest) -> Option<(Manifest, Vec<Row>)> {
        if self.again.fresh || self.again.record {
            return None;
        }
        let before = Manifest::read(folder, &manifest.study).ok().filter(|before| manifest.is_as(before))?;
        let rows = read_endings(folder, &manifest.study, &before.files).ok()?;
        Some((before, rows))
    }

    /// What of the run that `manifest` describes is stored and need not run again.
    fn reusable<'s>(
        &self,
        built: &BuiltStudy<'_>,
        manifest: &Manifest,
        stored: Option<&'s (Manifest, Records)>,
        damage: &Damage,
    ) -> Reusable<'s> {
        let keeps =
            Keeps { repeated: !self.again.fresh && !damage.is_of_trials, recorded: !self.again.record };
        stored.map_or_else(Reusable::default, |(before, old)| {
            Reusable::new(built, manifest, before, old, keeps)
        })
    }

    /// The manifest of the run, without record files yet.
    fn manifest(&self, study: &Study, built: &BuiltStudy<'_>) -> Result<Manifest, StudyError> {
        Manifest::new(study, self.points, built, self.command.clone(), self.quick)
    }
}

/// What a run did.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The manifest that was written.
    pub manifest: Manifest,
    /// How many trials there are.
    pub trials: usize,
    /// How many units came from the journal of an interrupted run.
    pub resumed: usize,
    /// How many units came whole from stored records.
    pub reused: usize,
    /// How many trials of the other units came from stored records: those of contenders that have not changed.
    pub kept: usize,
    /// How many units there are.
    pub units: usize,
    /// Why stored trials were not reused; empty if there were none or all were.
    pub why: Vec<String>,
    /// Trials that were run again and now differ from what was stored under equal dependencies.
    pub moved: Vec<String>,
    /// Damaged files that were set aside.
    pub aside: Vec<PathBuf>,
    /// Trials that ended neither with a path nor with the answer that none exists, by status.
    pub odd: Vec<UnexpectedStatus>,
}

impl Report {
    /// Whether every trial was stored and nothing ran.
    pub fn is_stored(&self) -> bool {
        self.reused == self.units && self.moved.is_empty() && self.aside.is_empty()
    }
}

/// Trials of one status that a reader may not have expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnexpectedStatus {
    /// How they ended.
    pub status: Status,
    /// How many there are.
    pub count: usize,
    /// The first of them.
    pub trial: String,
    /// Why it ended so.
    pub reason: String,
}

/// How much of a run was there before.
struct Counts {
    resumed: usize,
    units: usize,
    reused: usize,
    kept: usize,
}

impl Report {
    fn new(manifest: Manifest, counts: &Counts, tally: Tally<'_>, why: Vec<String>) -> Self {
        let Counts { resumed, units, reused, kept } = *counts;
        let Tally { trials, moved, odd, .. } = tally;
        let odd = odd.into_values().collect();
        Self { manifest, trials, resumed, reused, kept, units, why, moved, aside: Vec::new(), odd }
    }
}

/// What is noted of a run's trials while they pass by, in the order of records.
struct Tally<'r> {
    names: &'r Names,
    trials: usize,
    odd: BTreeMap<Status, UnexpectedStatus>,
    moved: Vec<String>,
    /// How many trials, from the first on, equal those of the run before.
    as_before: usize,
}

impl<'r> Tally<'r> {
    fn new(names: &'r Names) -> Self {
        Self { names, trials: 0, odd: BTreeMap::new(), moved: Vec::new(), as_before: 0 }
    }

    fn note(&mut self, row: &Row, old: &[Row], moved: Option<&Moved<'_>>) {
        if self.as_before == self.trials && old.get(self.trials) == Some(row) {
            self.as_before += 1;
        }
        self.trials += 1;
        let Row { key, status, reason, .. } = row;
        if moved.is_some_and(|moved| moved.has(row)) {
            self.moved.push(self.names.trial(key));
        }
        if ![Status::Solved, Status::NoPath].contains(status) {
            let first = || UnexpectedStatus {
                status: *status,
                count: 0,
                trial: self.names.trial(key),
                reason: reason.clone().unwrap_or_default(),
            };
            self.odd.entry(*status).or_insert_with(first).count += 1;
        }
    }
}

/// Runs the stale parts of `study`; if nothing is stale, the stored run stays as it is.
///
/// # Errors
/// [`StudyError::Interrupted`] if it was stopped, and those of the file system. Records that existed before stay as they
/// are unless the run succeeds.
pub fn run(study: &Study, options: &Options<'_>) -> Result<Report, StudyError> {
    let built = BuiltStudy::new(study, options.points, options.inputs)?;
    let folder = options.lock.folder();
    let mut manifest = options.manifest(study, &built)?;
    let only = options.portion.map(|portion| manifest.cut_to(portion));
    finish_put(folder, &study.name, &Manifest::path(folder, &study.name), |path| {
        Some(Manifest::read_left(path)?.files)
    });
    remove_temporaries(folder, &study.name);
    let units = only.map_or_else(|| built.units().len(), BTreeSet::len);
    let open_journal = || Journal::open(&Journal::path(folder, &study.name), &manifest.depends);
    let mut tally = Tally::new(built.names());
    if let Some((before, rows)) = options.current(folder, &manifest) {
        let journal = open_journal()?;
        let counts = Counts { resumed: journal.units().len(), units, reused: units, kept: 0 };
        journal.remove()?;
        for row in &rows {
            tally.note(row, &[], None);
        }
        let why = manifest.differs_from(&before);
        return Ok(Report::new(before, &counts, tally, why));
    }
    let Before { stored, kept, why, damage } =
        Before::read(folder, &manifest, options.again.replaces_damaged)?;
    let journal = open_journal()?;
    let resumed = journal.units().len();
    let found = options.reusable(&built, &manifest, stored.as_ref(), &damage);
    let counts = Counts { resumed, units, reused: found.units.len(), kept: found.kept() };
    let is_own = |index: &usize| only.is_none_or(|only| only.contains(index));
    let is_left = |index: &usize| !journal.has(*index) && !found.units.contains_key(index);
    let todo: Vec<usize> = (0..built.units().len()).filter(is_own).filter(is_left).collect();
    built.check_programs(&todo, &found.parts)?;
    let journal = Mutex::new(journal);
    let run = || built.run((&todo, units), &found.parts, &journal, options.stop, options.progress);
    pool(options.threads).install(run)?;
    let journal = journal.into_inner().expect("no thread panicked while it wrote");
    let mut gathered = Gathered::new(&built, journal, kept, found);
    let shape = Shape { group_values: group_values(&manifest), ..gathered.shape()? };
    let columns = Columns::new(study);
    let mut staged = Staged::default();
    let mut files = RecordWriter::new(&mut staged, folder, &study.name, &columns, shape)?;
    let old = stored.as_ref().map_or(&[][..], |(_, old)| &old.batch.rows);
    let moved = stored.as_ref().map(|(before, _)| Moved::new(&manifest, before, old));
    for (index, unit) in built.units().enumerate().filter(|(index, _)| is_own(index)) {
        let batch = gathered.unit(index, &unit)?;
        for row in &batch.rows {
            tally.note(row, old, moved.as_ref());
        }
        files.add(batch)?;
    }
    drop(moved);
    let is_as_before = old.len() == tally.trials && tally.as_before == tally.trials;
    let times = match kept_times(study, stored.as_ref(), &mut manifest, counts.reused == units) {
        Some(times) => times,
        None if only.is_some() => Vec::new(),
        None => times_beside(&built, options, stored.as_ref(), &mut manifest, is_as_before)?,
    };
    manifest.files = files.finish(&times)?;
    manifest.stage(&mut staged, folder)?;
    staged.put()?;
    gathered.remove_journal()?;
    Ok(Report { aside: damage.aside, ..Report::new(manifest, &counts, tally, why) })
}

/// Reads the clock of a stored run once more, in a session of its own beside those that are stored; the session's number.
///
/// # Errors
/// [`StudyError::Stored`] if what is stored is not what the spec asks for; those of [`run`].
pub fn read_clock(study: &Study, options: &Options<'_>) -> Result<u32, StudyError> {
    let built = BuiltStudy::new(study, options.points, options.inputs)?;
    let folder = options.lock.folder();
    let manifest = options.manifest(study, &built)?;
    let stored = Before::read(folder, &manifest, false)?.stored.filter(|(before, _)| manifest.is_as(before));
    let Some((mut manifest, mut records)) = stored else {
        let reason = "not what the spec asks for now; run the study first, then read the clock once more";
        return Err(StudyError::stored(Manifest::path(folder, &study.name), reason));
    };
    let number = manifest.sessions.len() as u32 + 1;
    records.times.extend(built.time(number, options.stop, options.progress)?);
    manifest.sessions.push(Session { number, ..Session::here(MadeBy::here()) });
    let stored = open_traces(folder, &study.name, &manifest.files)?;
    let traces = stored.all(&records.batch.rows)?;
    write(study, folder, &mut manifest, &records, traces)?;
    Ok(number)
}

/// The stored times, if no trial ran again and they are as many as the study wants: the records stay those of the run before, and
/// `manifest` names what made them.
fn kept_times(
    study: &Study,
    stored: Option<&(Manifest, Records)>,
    manifest: &mut Manifest,
    none_ran: bool,
) -> Option<Vec<Timing>> {
    let (before, old) = stored.filter(|(before, old)| {
        none_ran && manifest.interpretations == before.interpretations && is_timed_as(study, &old.times)
    })?;
    manifest.sessions.clone_from(&before.sessions);
    manifest.made_by.clone_from(&before.made_by);
    manifest.command.clone_from(&before.command);
    Some(old.times.clone())
}

/// Reads the clock. Stored times stay beside it, as sessions of their own, where every trial that ran again came out as it is
/// stored: they are of the same trials.
fn times_beside(
    built: &BuiltStudy<'_>,
    options: &Options<'_>,
    stored: Option<&(Manifest, Records)>,
    manifest: &mut Manifest,
    is_as_before: bool,
) -> Result<Vec<Timing>, StudyError> {
    let is_of_these = |(before, old): &&(Manifest, Records)| {
        manifest.interpretations == before.interpretations
            && !manifest.sessions.is_empty()
            && is_timed_as(built.study(), &old.times)
            && (is_as_before || old.batch.rows.is_empty() && manifest.depends == before.depends)
    };
    let Some((before, old)) = stored.filter(is_of_these) else {
        return built.time(SESSION, options.stop, options.progress);
    };
    let number = before.sessions.len() as u32 + 1;
    manifest.sessions = before.sessions.clone();
    manifest.sessions.push(Session { number, ..Session::here(MadeBy::here()) });
    Ok([old.times.clone(), built.time(number, options.stop, options.progress)?].concat())
}

/// Whether the clock was read for as many instances, repeats and seeds as `study` asks for. Interpretations are then as good as
/// new ones where no trial ran again, whatever else of the spec has changed.
fn is_timed_as(study: &Study, times: &[Timing]) -> bool {
    let Some(timing) = study.timing else { return times.is_empty() };
    let most = |of: fn(&Timing) -> u32| times.iter().map(|time| of(time) + 1).max().unwrap_or(0);
    let instances = study.groups.iter().map(|group| group.instances).max().unwrap_or(0);
    let seeds = study.contenders.iter().map(|contender| contender.repeats).max().unwrap_or(0);
    most(|time| time.trial.on.instance) == timing.problems.min(instances)
        && most(|time| time.clock_repeat) == timing.repeats
        && most(|time| time.trial.repeat) == timing.seeds.unwrap_or(1).min(seeds)
}

/// The least that a group of a part's traces holds, so that many parts do not make many files of crumbs.
const LEAST_GROUP_VALUES: usize = 1 << 12;

/// How many numbers a group of traces holds: who puts parts together holds a group of each.
fn group_values(manifest: &Manifest) -> usize {
    manifest.shard.as_ref().map_or(GROUP_VALUES, |shard| (GROUP_VALUES / shard.of).max(LEAST_GROUP_VALUES))
}

/// Puts records and manifest in their places, the manifest last: it says which records are whole.
pub(super) fn write(
    study: &Study,
    folder: &Path,
    manifest: &mut Manifest,
    records: &Records,
    mut traces: Traces<'_>,
) -> Result<(), StudyError> {
    traces.group_values = group_values(manifest);
    let columns = Columns::new(study);
    let mut staged = Staged::default();
    manifest.files = stage_records(&mut staged, folder, &study.name, &columns, records, traces)?;
    manifest.stage(&mut staged, folder)?;
    staged.put()
}

/// Runs the trial called `trial` alone, without touching any file, and gives its row beside the stored one.
///
/// # Errors
/// [`StudyError::UnknownTrial`].
pub fn run_one(
    study: &Study,
    points: &[Interpretation],
    inputs: &Inputs,
    folder: &Path,
    trial: &str,
) -> Result<(Batch, Option<Row>), StudyError> {
    let built = BuiltStudy::new(study, points, inputs)?;
    let names = built.names();
    let unknown = || {
        let all = built.units().flat_map(|unit| built.trials(&unit)).map(|key| names.trial(&key));
        unknown_trial(&study.name, trial, &all.collect::<Vec<String>>())
    };
    let is_it = |unit: &Unit<'_>| built.trials(unit).iter().any(|key| names.trial(key) == trial);
    let unit = built.units().find(is_it).ok_or_else(unknown)?;
    let mut batch = built.run_unit(&Unit { keeps_all: true, ..unit.clone() });
    batch.rows.retain(|row| names.trial(&row.key) == trial);
    batch.kept.retain(|kept| names.owner(&kept.owner) == trial);
    let before = if Manifest::path(folder, &study.name).exists() {
        let of_unit = |row: &Row| row.key.on == unit.key;
        let rows = reuse::stored(folder, &study.name)?.1.batch.rows.into_iter();
        rows.filter(of_unit).find(|row| names.trial(&row.key) == trial)
    } else {
        None
    };
    Ok((batch, before))
}

/// The error about a trial that is not among `all` of the study's.
fn unknown_trial(study: &str, trial: &str, all: &[String]) -> StudyError {
    let near = did_you_mean(trial, all.iter().map(String::as_str));
    let hint = format!("its first one is `{study}/{}`", all.first().map_or("", String::as_str));
    StudyError::UnknownTrial { study: study.to_owned(), trial: trial.to_owned(), near, hint }
}
