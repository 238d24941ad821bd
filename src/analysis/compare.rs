//! Two stored runs, or two contenders of one, beside each other.
//!
//! Trials of both sides are paired by their typed key; the others stand apart. A [`Change`] goes from the first side to
//! the second. Its intervals resample what was drawn independently (`pair`). Trials that one side alone solved have no
//! change of a mean. They count as an infinite loss of the other side in medians, wins and the probability of
//! improvement.

mod cells;
mod change;
mod gate;
mod pair;
mod run;

pub use cells::{Cell, cells};
pub use change::{Change, Measured, SOLVED, Word};
pub use gate::{Gate, Outcome, Passed};
pub use run::{StoredRun, stored_studies};

use self::change::Sample;
use self::gate::unknown_metric;
use self::pair::{Pair, paired};
use self::run::{Seen, Times};
use super::metric::{self, Better, Metric};
use base::settings::none_called;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use study::key::{InterpretationKey, Text};
use study::manifest::Manifest;
use study::name::Names;
use study::record::{Row, Status};

/// What is set beside each other.
pub enum Sides<'a> {
    /// Two runs.
    Runs([&'a StoredRun; 2]),
    /// Two contenders of one run.
    Contenders(&'a StoredRun, [&'a str; 2]),
}

/// The options of a comparison.
#[derive(Debug, Default)]
pub struct CompareOptions {
    /// The studies; all if empty.
    pub studies: Vec<String>,
    /// The metrics; if empty, all that are better one way.
    pub metrics: Vec<String>,
    /// What must not become worse.
    pub gates: Vec<Gate>,
}

/// Two sides beside each other.
#[derive(Debug, Serialize)]
pub struct Comparison {
    /// What the sides are called.
    pub sides: [String; 2],
    /// What a reader must know of both.
    pub notes: Vec<String>,
    /// Who solved what.
    pub solved: Vec<Solved>,
    /// What has changed.
    pub changes: Vec<Change>,
    /// What only one side has.
    pub only: Vec<Only>,
    /// What the gates say.
    pub gates: Vec<Passed>,
}

/// How many problems the sides solved.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Solved {
    /// The study.
    pub study: String,
    /// The contender, or the two.
    pub contender: String,
    /// Both solved them.
    pub both: usize,
    /// The first side alone.
    pub first_only: usize,
    /// The second side alone.
    pub second_only: usize,
    /// Neither.
    pub neither: usize,
    /// One that the second side alone did not solve, if there is one.
    pub lost: Option<String>,
}

/// What only one side has.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Only {
    /// The side that has it: 0 or 1.
    pub side: usize,
    /// The study.
    pub study: String,
    /// What it is.
    pub what: String,
    /// How many trials it has.
    pub trials: usize,
}

/// One contender, or two, with all that is paired.
struct Line<'r> {
    study: &'r str,
    label: String,
    pairs: Vec<Pair<'r>>,
    times: [&'r Times<'r>; 2],
    names: &'r Names,
}

/// Sets the two sides beside each other.
///
/// # Errors
/// A study, contender or metric of the options that is not there, with those that are.
pub fn compare(sides: &Sides<'_>, options: &CompareOptions) -> Result<Comparison, String> {
    let runs = sides.runs();
    for study in &options.studies {
        if !runs.iter().any(|run| run.studies.contains_key(study)) {
            let known: BTreeSet<&str> =
                runs.iter().flat_map(|run| run.studies.keys().map(String::as_str)).collect();
            return Err(format!("--study: {}", none_called("stored run of a study", study, known)));
        }
    }
    let metrics = metrics(&options.metrics)?;
    let is_chosen =
        |study: &str| options.studies.is_empty() || options.studies.iter().any(|own| own == study);
    let seen = runs.map(|run| {
        let studies = run.studies.iter().filter(|(study, _)| is_chosen(study));
        studies.map(|(study, stored)| (study.as_str(), Seen::new(stored))).collect::<BTreeMap<_, _>>()
    });
    let mut lines = Vec::new();
    let mut only = Vec::new();
    match sides {
        Sides::Runs(_) => only.extend(of_runs(&seen, &mut lines)),
        Sides::Contenders(_, labels) => only.extend(of_contenders(&seen[0], *labels, &mut lines)?),
    }
    let samples: Vec<Sample<'_>> = lines.iter().flat_map(|line| line.samples(&metrics)).collect();
    let of_two_runs = matches!(sides, Sides::Runs(_));
    Ok(Comparison {
        sides: sides.names(),
        notes: if of_two_runs {
            notes(&seen, &lines)
        } else {
            seen[0].iter().filter_map(|(study, own)| elsewhere(study, own.manifest)).collect()
        },
        solved: lines.iter().map(Line::solved).collect(),
        changes: samples.iter().map(Sample::change).collect(),
        gates: gate::pass(&options.gates, &samples, of_two_runs)?,
        only,
    })
}

impl<'a> Sides<'a> {
    fn runs(&self) -> [&'a StoredRun; 2] {
        match self {
            Self::Runs(runs) => *runs,
            Self::Contenders(run, _) => [run, run],
        }
    }

    fn names(&self) -> [String; 2] {
        match self {
            Self::Runs(runs) => runs.map(|run| run.name.clone()),
            Self::Contenders(_, labels) => labels.map(str::to_owned),
        }
    }
}

/// The metrics called so; without a name, all that are better one way.
fn metrics(names: &[String]) -> Result<Vec<&'static Metric>, String> {
    let is_better = |metric: &&Metric| metric.better != Better::Neither;
    if names.is_empty() {
        // Who solved what stands above them all.
        return Ok(metric::METRICS.iter().filter(is_better).filter(|metric| !metric.is_status()).collect());
    }
    let named = names.iter().filter(|name| *name != SOLVED);
    named
        .map(|name| metric::find(name).filter(is_better).ok_or_else(|| unknown_metric("--metric", name)))
        .collect()
}

/// Every contender of every study that both runs have; also what only one has.
fn of_runs<'r>(seen: &'r [BTreeMap<&'r str, Seen<'r>>; 2], lines: &mut Vec<Line<'r>>) -> Vec<Only> {
    let mut only = Vec::new();
    for side in [0, 1] {
        for (study, own) in seen[side].iter().filter(|(study, _)| !seen[1 - side].contains_key(*study)) {
            let study = (*study).to_owned();
            let what = "the study".to_owned();
            only.push(Only { side, study, what, trials: own.count() });
        }
    }
    for (study, first) in &seen[0] {
        if let Some(second) = seen[1].get(study) {
            only.extend(of_study(study, [first, second], lines));
        }
    }
    only
}

/// Every contender of one study that both runs have; also what only one has.
fn of_study<'r>(study: &'r str, sides: [&'r Seen<'r>; 2], lines: &mut Vec<Line<'r>>) -> Vec<Only> {
    let labels: BTreeSet<&str> = sides.iter().flat_map(|side| side.rows.keys().copied()).collect();
    let mut lone = [Vec::new(), Vec::new()];
    for label in labels {
        let rows = sides.map(|side| side.rows.get(label).map_or(&[][..], Vec::as_slice));
        let found = paired(rows, sides.map(|side| &side.instances));
        lone[0].extend(found.lone[0].iter().copied());
        lone[1].extend(found.lone[1].iter().copied());
        if !found.pairs.is_empty() {
            let times = sides.map(|side| &side.times);
            let names = &sides[0].names;
            lines.push(Line { study, label: label.to_owned(), pairs: found.pairs, times, names });
        }
    }
    let only = |side: usize| only_on_one_side(side, study, &lone[side], sides[1 - side]);
    [only(0), only(1)].concat()
}

/// The second contender against the first in every study that has both; also what only one was run on.
fn of_contenders<'r>(
    seen: &'r BTreeMap<&'r str, Seen<'r>>,
    labels: [&str; 2],
    lines: &mut Vec<Line<'r>>,
) -> Result<Vec<Only>, String> {
    let known: BTreeSet<&str> = seen.values().flat_map(|study| study.rows.keys().copied()).collect();
    if let Some(other) = labels.iter().find(|label| !known.contains(*label)) {
        return Err(format!("--contenders: {}", none_called("stored trial of a contender", other, known)));
    }
    let mut only = Vec::new();
    for (study, own) in seen {
        let [Some(first), Some(second)] = labels.map(|label| own.rows.get(label)) else { continue };
        let found = paired([first, second], [&own.instances; 2]);
        for (side, lone) in found.lone.iter().enumerate().filter(|(_, lone)| !lone.is_empty()) {
            let what = format!("trials of contender `{}`", labels[side]);
            only.push(Only { side, study: (*study).to_owned(), what, trials: lone.len() });
        }
        let label = format!("{} against {}", labels[1], labels[0]);
        lines.push(Line { study, label, pairs: found.pairs, times: [&own.times; 2], names: &own.names });
    }
    if lines.is_empty() {
        return Err(format!("--contenders: no study has both `{}` and `{}`", labels[0], labels[1]));
    }
    Ok(only)
}

/// What of these trials the other side lacks, most general first.
fn only_on_one_side(side: usize, study: &str, lone: &[&Row], other: &Seen<'_>) -> Vec<Only> {
    let rows = || other.rows.values().flatten();
    let groups: BTreeSet<&Text> = rows().map(|row| &row.key.on.group).collect();
    let interpretations: BTreeSet<&InterpretationKey> =
        rows().map(|row| &row.key.on.interpretation).collect();
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    for row in lone {
        let on = &row.key.on;
        let what = if !other.rows.contains_key(&*row.key.contender) {
            format!("contender `{}`", row.key.contender)
        } else if !groups.contains(&on.group) {
            format!("problem group `{}`", on.group)
        } else if !interpretations.contains(&on.interpretation) {
            format!("interpretation {}", other.names.interpretation(&on.interpretation))
        } else {
            format!("instances, queries, sweep points or seeds of `{}`", row.key.contender)
        };
        *found.entry(what).or_default() += 1;
    }
    let only = |(what, trials)| Only { side, study: study.to_owned(), what, trials };
    found.into_iter().map(only).collect()
}

/// That the records of a study are nobody's here, if they were imported.
fn elsewhere(study: &str, of: &Manifest) -> Option<String> {
    let source = of.elsewhere.as_ref()?;
    Some(format!("{study}: recorded elsewhere, with unknown seeds and paths that nobody verified: {source}"))
}

/// What a reader must know of two runs.
fn notes(seen: &[BTreeMap<&str, Seen<'_>>; 2], lines: &[Line<'_>]) -> Vec<String> {
    let mut notes = Vec::new();
    let mut timed: BTreeMap<[String; 2], Vec<&str>> = BTreeMap::new();
    for (study, first) in &seen[0] {
        let Some(second) = seen[1].get(study) else { continue };
        let (one, other) = (first.manifest, second.manifest);
        notes.extend([one, other].into_iter().filter_map(|of| elsewhere(study, of)));
        if one.quick != other.quick {
            notes.push(format!("{study}: one of the runs is quick and the other full"));
        }
        if one.choices != other.choices {
            notes.push(format!("{study}: other choices touch trials in each run, so no keys agree"));
        }
        let pairs = || lines.iter().filter(|line| line.study == *study).flat_map(|line| &line.pairs);
        let others = pairs().filter(|pair| !pair.is_same_instance).count();
        if others > 0 {
            notes.push(format!(
                "{study}: {others} of {} pairs have other seeds (the runs' are {} and {}): pairing removes no spread, and wins may be luck",
                pairs().count(),
                one.seed,
                other.seed
            ));
        }
        if !first.times.is_empty() && !second.times.is_empty() {
            let cpu = |of: &Manifest| of.made_by.cpu.clone().unwrap_or_else(|| "unknown".to_owned());
            timed.entry([one, other].map(cpu)).or_default().push(study);
        }
    }
    notes.extend(timed.into_iter().map(|([one, other], studies)| {
        format!(
            "{}: clocks were read in two sessions (on {one} and on {other}), and no interval covers how much sessions differ",
            studies.join(", ")
        )
    }));
    notes
}

impl Line<'_> {
    fn solved(&self) -> Solved {
        let is_solved = |row: &Row| row.status == Status::Solved;
        let count =
            |wanted: [bool; 2]| self.pairs.iter().filter(|pair| pair.rows.map(is_solved) == wanted).count();
        let lost = self.pairs.iter().find(|pair| pair.rows.map(is_solved) == [true, false]);
        Solved {
            study: self.study.to_owned(),
            contender: self.label.clone(),
            both: count([true, true]),
            first_only: count([true, false]),
            second_only: count([false, true]),
            neither: count([false, false]),
            lost: lost.map(|pair| format!("{}/{}", self.study, self.names.trial(&pair.rows[1].key))),
        }
    }

    /// What is measured of it: whether a problem is solved, and each metric that some pair has.
    fn samples(&self, metrics: &[&'static Metric]) -> Vec<Sample<'_>> {
        let solved = Sample::solved(self.study, &self.label, &self.pairs);
        let of = |metric: &&'static Metric| {
            Sample::of_metric(self.study, &self.label, metric, &self.pairs, self.times)
        };
        std::iter::once(solved).chain(metrics.iter().map(of)).filter(|sample| sample.pairs() > 0).collect()
    }
}

#[cfg(test)]
mod tests;
