//! Puts the parts of a run together: the same records, to the byte, as one machine would have written.
//!
//! Nothing is put together unless every part is there, whole, of one plan and of one program. A part is refused by the name of
//! its folder, with what it should be.

use super::key::{DrawKey, Owner};
use super::manifest::Manifest;
use super::plan::{Plan, brief, unlike};
use super::record::Batch;
use super::runner::BuiltStudy;
use super::session::write;
use super::store::{Records, journal_units, read_records};
use super::{Study, StudyError};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// The parts of a run, all of which may be put together.
pub struct Parts<'a> {
    plan: &'a Plan,
    folder: &'a Path,
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
        let mut refused = strangers(plan, folder);
        let mut missing = Vec::new();
        for number in 1..=plan.shards {
            let part = plan.part(folder, number);
            let name = part.file_name().unwrap_or_default().to_string_lossy().into_owned();
            for (_, expected) in studies {
                let study = &expected.study;
                if !Manifest::path(&part, study).exists() {
                    let kept = journal_units(&part, study);
                    missing.push((
                        number,
                        format!("{name}: study `{study}` is not done; {kept} units are kept"),
                    ));
                    continue;
                }
                match Manifest::read(&part, study) {
                    Err(error) => refused.push(error.to_string()),
                    Ok(found) => {
                        let reasons = reasons(plan, number, expected, &found);
                        refused.extend(
                            reasons.iter().map(|reason| format!("{name}: study `{study}`: {reason}")),
                        );
                    }
                }
            }
        }
        refused.extend(missing.iter().map(|(_, what)| what.clone()));
        let numbers: BTreeSet<usize> = missing.iter().map(|(number, _)| *number).collect();
        refused.extend(numbers.iter().next().map(|_| how_to_run(plan, folder, &numbers)));
        if refused.is_empty() {
            return Ok(Self { plan, folder });
        }
        Err(StudyError::stored(
            folder,
            format!("the parts cannot be put together:\n  {}", refused.join("\n  ")),
        ))
    }

    /// Writes the records of `study` into `into`, which is locked; how many trials they are.
    ///
    /// # Errors
    /// [`StudyError::Stored`] for a part that is damaged or does not hold the units that are its own; those of the file system,
    /// and nothing is written then.
    pub fn merge(
        &self,
        study: &Study,
        built: &BuiltStudy<'_>,
        mut manifest: Manifest,
        into: &Path,
    ) -> Result<usize, StudyError> {
        let units: BTreeMap<Arc<DrawKey>, usize> =
            built.units().into_iter().enumerate().map(|(index, unit)| (unit.key, index)).collect();
        let (mut rows, mut prepared, mut kept) = (Vec::new(), Vec::new(), Vec::new());
        for number in 1..=self.plan.shards {
            let part = self.plan.part(self.folder, number);
            let files = Manifest::read(&part, &study.name)?.files;
            let batch = read_records(&part, &study.name, &files)?.batch;
            rows.push(batch.rows);
            prepared.push(batch.prepared);
            kept.push(batch.kept);
        }
        let wrong =
            |reason: String| StudyError::stored(self.folder, format!("study `{}`: {reason}", study.name));
        let prepared = interleaved(prepared, |row| &row.key, &units).map_err(wrong)?;
        let found: BTreeSet<&Arc<DrawKey>> = prepared.iter().map(|row| &row.key).collect();
        if let Some(gap) = units.keys().find(|key| !found.contains(key)) {
            return Err(wrong(format!("no part holds {}", built.names().prepared(gap))));
        }
        let rows = interleaved(rows, |row| &row.key.on, &units).map_err(wrong)?;
        let kept = interleaved(kept, |kept| drawn(&kept.of), &units).map_err(wrong)?;
        let batch = Batch { prepared, rows, kept };
        // What no clock has timed yet; `replan run` reads it, on one machine.
        manifest.sessions.clear();
        let trials = batch.rows.len();
        write(study, into, &mut manifest, &Records { batch, times: Vec::new() })?;
        Ok(trials)
    }
}

/// The draw that something belongs to.
fn drawn(of: &Owner) -> &Arc<DrawKey> {
    match of {
        Owner::Draw(key) => key,
        Owner::Trial(key) => &key.on,
    }
}

/// Everything of all parts in the order of units; each part has its own in that order.
fn interleaved<T>(
    parts: Vec<Vec<T>>,
    on: impl Fn(&T) -> &Arc<DrawKey>,
    units: &BTreeMap<Arc<DrawKey>, usize>,
) -> Result<Vec<T>, String> {
    let mut runs = Vec::new();
    for (part, all) in parts.iter().enumerate() {
        for run in all.chunk_by(|one, other| Arc::ptr_eq(on(one), on(other))) {
            let key = on(&run[0]);
            let unit = units.get(key).ok_or_else(|| {
                format!(
                    "part {} holds draw {} of `{}`, which the study has not",
                    part + 1,
                    key.draw,
                    key.group
                )
            })?;
            runs.push((*unit, part, run.len()));
        }
    }
    runs.sort_unstable();
    if let Some(double) = runs.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(format!(
            "parts {} and {} both hold unit {}",
            double[0].1 + 1,
            double[1].1 + 1,
            double[0].0
        ));
    }
    let mut left: Vec<_> = parts.into_iter().map(Vec::into_iter).collect();
    let mut all = Vec::with_capacity(left.iter().map(ExactSizeIterator::len).sum());
    for (_, part, count) in runs {
        all.extend(left[part].by_ref().take(count));
    }
    Ok(all)
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
    let said = |name: &String| format!("{name}: no part of this run, which has {} shards", plan.shards);
    names.iter().filter(is_stranger).map(said).collect()
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
    if (&found.axes, &found.readings) != (&expected.axes, &expected.readings) {
        reasons.push("ran under other readings".to_owned());
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
    let command = format!("replan {}", plan.arguments(folder, &shard).join(" "));
    match &shards[..] {
        [_] => format!("to run it: {command}"),
        several => format!("to run them: {command}, for each of {}", several.join(", ")),
    }
}
