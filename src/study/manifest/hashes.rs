//! What each problem group and contender depends on, as hashes.

use crate::choice::Interpretation;
use crate::contender::SweepPoint;
use crate::name;
use crate::runner::BuiltStudy;
use crate::{Study, StudyError};
use base::hash::sha256;
use base::settings::in_first_words;
use std::collections::BTreeMap;

/// The dependencies of a thing, by label: a hash, and the numbers of the interpretations that share it.
pub type Hashes = BTreeMap<String, BTreeMap<String, Vec<usize>>>;

/// What each problem group of `study`, at each point of the sweeps over it, depends on under `points`.
pub(super) fn problem_hashes(
    study: &Study,
    points: &[Interpretation],
    built: &BuiltStudy<'_>,
) -> Result<Hashes, StudyError> {
    let mut hashes = Hashes::new();
    for (interpretation, point) in points.iter().enumerate() {
        for (place, (group, at)) in study.posed().enumerate() {
            let settings = group.settings_under(at, point);
            // The object's own traces are kept for every instance with a kept trial.
            let kept: Vec<_> = study.kept().filter(|trials| trials.problems == group.label).collect();
            let text = format!(
                "{} {} {} {} {:?} {} {} {} {} {:?} {:?} {:?} {:?}",
                study.paper,
                study.name,
                study.seed,
                group.label,
                group.shared_instances,
                study.task.name,
                study.task.revision,
                group.family.name,
                group.family.revision,
                study.budget,
                (in_first_words(settings.table()), study.task_settings.table()),
                kept.iter().map(|trials| trials.instances).max(),
                built.inputs_of(interpretation, place)?,
            );
            let also: Vec<u32> = kept.iter().flat_map(|trials| trials.also.iter().copied()).collect();
            let text = if also.is_empty() { text } else { format!("{text} {also:?}") };
            let laid = group.stage.as_ref().map(|change| format!(" {:?}", change.stage()));
            let text = text + &laid.unwrap_or_default();
            note(&mut hashes, &name::group(&group.label, &at.key), &text, interpretation);
        }
    }
    Ok(hashes)
}

/// What each contender of `study` depends on under `points`.
pub(super) fn contender_hashes(
    study: &Study,
    points: &[Interpretation],
    built: &BuiltStudy<'_>,
) -> Result<Hashes, StudyError> {
    let mut hashes = Hashes::new();
    let sweeps: Vec<SweepPoint> = study.contender_points();
    for (interpretation, point) in points.iter().enumerate() {
        for contender in &study.contenders {
            let mut text = format!("{} {}", contender.label, contender.repeats);
            for stage in &contender.stages {
                let entry = stage.entry;
                text += &format!("\n{} {}", entry.name, entry.revision);
                for sweep in &sweeps {
                    let settings = stage.effective(&contender.label, point, sweep);
                    text += &format!(" {} {:?}", name::sweep(&sweep.key), settings.table());
                }
            }
            let is_own = |of: &Option<String>| of.as_ref().is_none_or(|label| *label == contender.label);
            for trials in study.kept().filter(|trials| is_own(&trials.contender)) {
                text += &format!("\n{} {} {:?}", trials.problems, trials.instances, trials.repeats);
                if !trials.also.is_empty() {
                    text += &format!(" and {:?}", trials.also);
                }
                if let Some(traces) = &trials.traces {
                    text += &format!(" {traces:?}");
                }
            }
            let files = built.files_of(interpretation, &contender.label)?;
            if !files.is_empty() {
                text += &format!("\n{files:?}");
            }
            note(&mut hashes, &contender.label, &text, interpretation);
        }
    }
    Ok(hashes)
}

/// How many digits of a hash tell what trials depend on apart.
const DIGITS: usize = 16;

/// Notes that the thing called `label` depends on what `text` says under the interpretation of this number.
fn note(hashes: &mut Hashes, label: &str, text: &str, interpretation: usize) {
    let hash = sha256(text.as_bytes())[..DIGITS].to_owned();
    hashes.entry(label.to_owned()).or_default().entry(hash).or_default().push(interpretation);
}

/// What is new, has changed or is gone among the things called `what`; `both` are the interpretations of both runs.
pub(super) fn changes(what: &str, ours: &Hashes, theirs: &Hashes, both: &[[usize; 2]]) -> Vec<String> {
    let mut changes = Vec::new();
    for label in ours.keys() {
        let is_other =
            |[own, other]: &&[usize; 2]| hash_of(ours, label, *own) != hash_of(theirs, label, *other);
        let changed = both.iter().filter(is_other).count();
        if !theirs.contains_key(label) {
            changes.push(format!("{what} `{label}` is new"));
        } else if changed > 0 {
            let under = match both.len() {
                1 => String::new(),
                all => format!(" under {changed} of {all} interpretations"),
            };
            changes.push(format!("{what} `{label}` has changed{under}"));
        }
    }
    let gone = theirs.keys().filter(|label| !ours.contains_key(*label));
    changes.extend(gone.map(|label| format!("{what} `{label}` is gone")));
    changes
}

/// What the thing called `label` depends on under the interpretation of this number.
pub(super) fn hash_of<'h>(hashes: &'h Hashes, label: &str, interpretation: usize) -> Option<&'h str> {
    let under = hashes.get(label)?.iter();
    under
        .filter(|(_, interpretations)| interpretations.contains(&interpretation))
        .map(|(hash, _)| hash.as_str())
        .next()
}
