//! Merges the parts of a run into the same records, to the byte, as one machine would have written.
//!
//! Nothing is merged unless every part is there, whole, of one plan and of one program. A part is refused by the name
//! of its folder, with the plan or program that it should have.

use super::key::{InstanceKey, SweepKey};
use super::manifest::Manifest;
use super::plan::{Plan, brief, unlike};
use super::record::{Batch, Kept, Row};
use super::runner::BuiltStudy;
use super::session::write;
use super::store::{GROUP_VALUES, Records, TraceReader, Traces, journal_units, open_traces, read_numbers};
use super::{Study, StudyError};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// The parts of a run that are fit to be put together.
pub struct Parts<'a> {
    plan: &'a Plan,
    folder: &'a Path,
    /// The shard of every unit of each study.
    cut: Vec<Vec<usize>>,
}

/// What may keep parts from being put together.
#[derive(Default)]
struct Refused {
    reasons: Vec<String>,
    /// The numbers of shards that are not done.
    missing: BTreeSet<usize>,
}

impl<'a> Parts<'a> {
    /// The parts of `plan` in `folder`, of a run of `studies` as they are now.
    ///
    /// # Errors
    /// [`StudyError::Stored`] with everything that is missing, double or of another run.
    pub fn checked(
        plan: &'a Plan,
        folder: &'a Path,
        studies: &[(BuiltStudy<'_>, Manifest)],
    ) -> Result<Self, StudyError> {
        let mut refused = Refused { reasons: strangers(plan, folder), ..Refused::default() };
        for number in 1..=plan.shards {
            for (_, expected) in studies {
                refused.look_at(plan, folder, number, expected);
            }
        }
        let Refused { mut reasons, missing } = refused;
        if !missing.is_empty() {
            reasons.push(how_to_run(plan, folder, &missing));
        }
        if reasons.is_empty() {
            return Ok(Self { plan, folder, cut: plan.cut() });
        }
        let reasons = reasons.join("\n  ");
        Err(StudyError::stored(folder, format!("the parts cannot be put together:\n  {reasons}")))
    }

    /// Writes the records of `study`, at this place of the plan, into the locked folder `into`, and gives how many trials they
    /// hold.
    ///
    /// # Errors
    /// [`StudyError::Stored`] for a part that is damaged or does not hold the units that are its own; those of the file system,
    /// and nothing is written then.
    pub fn merge(
        &self,
        (place, study): (usize, &Study),
        built: &BuiltStudy<'_>,
        mut manifest: Manifest,
        into: &Path,
    ) -> Result<usize, StudyError> {
        let keys: Vec<Arc<InstanceKey>> = built.units().map(|unit| unit.key).collect();
        let units = Units { numbers: keys.iter().cloned().zip(0..).collect(), shards: &self.cut[place] };
        let mut rows = Vec::new();
        let mut preprocessing = Vec::new();
        let mut traces = Vec::new();
        for number in 1..=self.plan.shards {
            let part = self.plan.part(self.folder, number);
            let Manifest { files, .. } = Manifest::read(&part, &study.name)?;
            let batch = read_numbers(&part, &study.name, &files)?.batch;
            rows.push(batch.rows);
            preprocessing.push(batch.preprocessing);
            traces.push(open_traces(&part, &study.name, &files)?);
        }
        let wrong =
            |reason: String| StudyError::stored(self.folder, format!("study `{}`: {reason}", study.name));
        let preprocessing = units.in_order(preprocessing, |row| &row.key).map_err(wrong)?;
        let found: BTreeSet<&Arc<InstanceKey>> = preprocessing.iter().map(|row| &row.key).collect();
        if let Some(gap) = keys.iter().find(|key| !found.contains(key)) {
            return Err(wrong(format!("no part holds {}", built.names().preprocessing(gap))));
        }
        let rows = units.in_order(rows, |row| &row.key.on).map_err(wrong)?;
        // No clock has timed anything yet; `replan run` reads it, on one machine.
        manifest.sessions.clear();
        let sweep = sweep(&traces, &rows)?;
        let trials = rows.len();
        let records = Records { batch: Batch { preprocessing, rows, ..Batch::default() }, times: Vec::new() };
        let each = Box::new(streamed(traces, keys, &self.cut[place]));
        let traces = Traces { each, sweep, group_values: GROUP_VALUES };
        write(study, into, &mut manifest, &records, traces)?;
        Ok(trials)
    }
}

impl Refused {
    /// Notes what is wrong with one study of the part `number`, which should be as `expected` says.
    fn look_at(&mut self, plan: &Plan, folder: &Path, number: usize, expected: &Manifest) {
        let part = plan.part(folder, number);
        let study = &expected.study;
        let name = part.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if !Manifest::path(&part, study).exists() {
            let kept = journal_units(&part, study);
            self.reasons.push(format!("{name}: study `{study}` is not done; {kept} units are kept"));
            self.missing.insert(number);
            return;
        }
        match Manifest::read(&part, study) {
            Err(error) => self.reasons.push(error.to_string()),
            Ok(found) => {
                let reasons = reasons(plan, number, expected, &found);
                self.reasons
                    .extend(reasons.iter().map(|reason| format!("{name}: study `{study}`: {reason}")));
            }
        }
    }
}

/// The sweep of a trial, if any part has a trace of one.
fn sweep(traces: &[TraceReader], rows: &[Row]) -> Result<Option<SweepKey>, StudyError> {
    for reader in traces {
        if reader.has_trials()? {
            return Ok(rows.first().map(|row| row.key.sweep.clone()));
        }
    }
    Ok(None)
}

/// The traces of all parts in the order of units; one group of each part is held at a time.
fn streamed(
    mut parts: Vec<TraceReader>,
    keys: Vec<Arc<InstanceKey>>,
    shards: &[usize],
) -> impl Iterator<Item = Result<Kept, StudyError>> {
    let mut unit = 0;
    std::iter::from_fn(move || {
        while unit < keys.len() {
            let part = &mut parts[shards[unit] - 1];
            match part.peek() {
                Err(error) => return Some(Err(error)),
                Ok(Some(kept)) if *kept.owner.on() == keys[unit] => return part.take().map(Ok),
                Ok(_) => unit += 1,
            }
        }
        let left = parts.iter_mut().find_map(|part| (!matches!(part.peek(), Ok(None))).then_some(part));
        left.map(|part| {
            part.take();
            Err(part.wrong("holds traces of instances that are not its own, or in another order"))
        })
    })
}

/// The units of a study.
struct Units<'s> {
    numbers: BTreeMap<Arc<InstanceKey>, usize>,
    /// The shard of each.
    shards: &'s [usize],
}

impl Units<'_> {
    /// Everything of all parts in the order of units; each part has its own in that order.
    fn in_order<T>(
        &self,
        parts: Vec<Vec<T>>,
        on: impl Fn(&T) -> &Arc<InstanceKey>,
    ) -> Result<Vec<T>, String> {
        let mut runs = Vec::new();
        for (part, all) in parts.iter().enumerate() {
            for run in all.chunk_by(|one, other| Arc::ptr_eq(on(one), on(other))) {
                let key = on(&run[0]);
                let unit = self.numbers.get(key).filter(|unit| self.shards[**unit] == part + 1);
                let unit = unit.ok_or_else(|| {
                    format!(
                        "part {} holds instance {} of `{}`, which is not its own",
                        part + 1,
                        key.instance,
                        key.group
                    )
                })?;
                runs.push((*unit, part, run.len()));
            }
        }
        runs.sort_unstable();
        let mut left: Vec<_> = parts.into_iter().map(Vec::into_iter).collect();
        let mut all = Vec::with_capacity(left.iter().map(ExactSizeIterator::len).sum());
        for (_, part, count) in runs {
            all.extend(left[part].by_ref().take(count));
        }
        Ok(all)
    }
}

/// Folders that look like parts and are none of the plan's.
fn strangers(plan: &Plan, folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let is_stranger = |name: &&String| {
        let numbers =
            name.split_once("-of-").and_then(|(one, all)| one.parse::<usize>().ok().zip(all.parse().ok()));
        numbers.is_some_and(|(number, of)| of != plan.shards || !(1..=of).contains(&number))
    };
    let message = |name: &String| format!("{name}: no part of this run, which has {} shards", plan.shards);
    names.iter().filter(is_stranger).map(message).collect()
}

/// Why the part that `found` describes is not the shard `number` of the run that `expected` describes.
fn reasons(plan: &Plan, number: usize, expected: &Manifest, found: &Manifest) -> Vec<String> {
    let mut reasons = Vec::new();
    match &found.shard {
        None => reasons.push("is a whole run and no part".to_owned()),
        Some(shard) if (shard.number, shard.of) != (number, plan.shards) => {
            reasons.push(format!("holds shard {shard}, not {number}/{}", plan.shards));
        }
        Some(shard) if shard.plan != plan.hash() => reasons.push("was cut by another plan".to_owned()),
        Some(_) => {}
    }
    if found.seed != expected.seed {
        reasons.push(format!("seed {}, not {}", found.seed, expected.seed));
    }
    if found.quick != expected.quick {
        reasons.push(format!("quick {}, not {}", found.quick, expected.quick));
    }
    if (&found.choices, &found.interpretations) != (&expected.choices, &expected.interpretations) {
        reasons.push("ran under other interpretations".to_owned());
    }
    reasons.extend(
        unlike(&found.made_by, &plan.made_by).map(|[what, own, plan]| format!("{what} {own}, not {plan}")),
    );
    if found.spec != expected.spec {
        reasons.push(format!("spec {}, not {}", brief(&found.spec), brief(&expected.spec)));
    }
    if reasons.is_empty() && found.depends != expected.depends {
        reasons.extend(expected.differs_from(found));
    }
    reasons
}

/// The command that runs what is missing.
fn how_to_run(plan: &Plan, folder: &Path, missing: &BTreeSet<usize>) -> String {
    let shards: Vec<String> = missing.iter().map(|number| format!("{number}/{}", plan.shards)).collect();
    let shard = if let [one] = &shards[..] { one.clone() } else { format!("K/{}", plan.shards) };
    let command = base::text::command(&plan.arguments(folder, &shard));
    match &shards[..] {
        [_] => format!("to run it: {command}"),
        several => format!("to run them: {command}, for each of {}", several.join(", ")),
    }
}
