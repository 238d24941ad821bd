//! Whether a share lies within bounds: of trials that are solved, of trials with a mark, or of events counted in draws.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::record::{Row, Status};
use crate::study::{Study, column};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{self, Resampling};
use stats::interval::Interval;
use stats::proportion::wilson;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share",
    about: "does a share lie within bounds: of trials solved, of trials with a mark, of events counted in draws?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "postures"
problems = ["C1", "C2"]
contender = "A*"
hits = "solved"
accepted = [0.995, 1.0]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let mut study = context.study(&settings.study, &settings.problems, &[])?;
        if !study.contenders.is_empty() {
            study = context.study(&settings.study, &settings.problems, &[&settings.contender])?;
        }
        let named = settings.of.iter().chain((settings.hits != SOLVED).then_some(&settings.hits));
        for name in named {
            if column::find(name).is_none() {
                let message =
                    format!("there is no column `{name}`; a column's name or `{SOLVED}` is accepted");
                let key = if settings.of.as_ref() == Some(name) { "of" } else { "hits" };
                return Err(context.settings.error_at(key, message));
            }
        }
        let [low, high] = settings.accepted;
        if !(0.0..=high).contains(&low) || high > 1.0 {
            let message = format!("accepted is [{low}, {high}]; two rising shares from 0 to 1 are accepted");
            return Err(context.settings.error_at("accepted", message));
        }
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(Share { settings, study, seed }))
    },
};

/// The name of the share of trials that are solved.
const SOLVED: &str = "solved";

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// The contender, or what stands in its place in a study that measures without contenders.
    contender: String,
    /// `solved`, or a column: a mark that is above 0, or with `of` a count of events.
    hits: String,
    /// The column that counts the chances for `hits`.
    of: Option<String>,
    /// The least and the greatest share under which the claim counts as reproduced.
    accepted: [f64; 2],
}

struct Share<'a> {
    settings: Settings,
    study: &'a Study,
    seed: u64,
}

impl Share<'_> {
    fn rows<'b>(&self, evidence: &'b Evidence<'_>) -> Vec<&'b Row> {
        let Some(run) = evidence.run(&self.settings.study) else { return Vec::new() };
        self.settings.problems.iter().flat_map(|group| run.rows(group, &self.settings.contender)).collect()
    }

    /// The share of trials that are hit, with the hits and the trials.
    fn of_trials(&self, rows: &[&Row]) -> Option<(Estimate, String)> {
        let hit = |row: &&Row| match self.settings.hits.as_str() {
            SOLVED => Some(row.status == Status::Solved),
            column => row.value(column).map(|value| value > 0.0),
        };
        let seen: Vec<bool> = rows.iter().filter_map(hit).collect();
        let hits = seen.iter().filter(|hit| **hit).count();
        let interval = wilson(hits, seen.len(), 0.95)?;
        let share = hits as f64 / seen.len() as f64;
        let what = format!("share of trials: {}, Wilson 95 %", self.settings.hits);
        Some((Estimate::new(share, interval, what, seen.len()), format!("{hits} of {}", seen.len())))
    }

    /// The share of events among chances, over draws.
    fn of_events(&self, rows: &[&Row], of: &str) -> Option<(Estimate, String)> {
        let pair = |row: &&Row| Some((row.value(&self.settings.hits)?, row.value(of)?));
        let pairs: Vec<(f64, f64)> = rows.iter().filter_map(pair).collect();
        let sums = |units: &[&(f64, f64)]| {
            units.iter().fold((0.0, 0.0), |sum, unit| (sum.0 + unit.0, sum.1 + unit.1))
        };
        let ratio = |units: &[&(f64, f64)]| {
            let (hits, chances) = sums(units);
            (chances > 0.0).then(|| hits / chances)
        };
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let found = bootstrap::percentile(&pairs, ratio, plan)?;
        let (hits, chances) = sums(&pairs.iter().collect::<Vec<_>>());
        let what = format!("{} of {of}, bootstrap 95 % over draws", self.settings.hits);
        let counted = format!("{hits} of {chances} in {} draws", pairs.len());
        Some((Estimate::new(found.value, found.interval, what, pairs.len()), counted))
    }

    fn verdict(&self, interval: Interval) -> Verdict {
        let [low, high] = self.settings.accepted;
        let accepted = Interval::new(low, high);
        if accepted.contains(interval.low) && accepted.contains(interval.high) {
            if self.study.searched { Verdict::Attainable } else { Verdict::Reproduced }
        } else if accepted.meets(interval) {
            Verdict::Undecided
        } else {
            Verdict::NotReproduced
        }
    }
}

impl Check for Share<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let rows = self.rows(evidence);
        let mut finding = Finding::of(ENTRY.name);
        let found = match &self.settings.of {
            Some(of) => self.of_events(&rows, of),
            None => self.of_trials(&rows),
        };
        let Some((estimate, counted)) = found else {
            return finding.undecided(format!("none of {} trials counts {}", rows.len(), self.settings.hits));
        };
        let [low, high] = estimate.interval.expect("a share is estimated with its interval");
        finding.verdict = Some(self.verdict(Interval::new(low, high)));
        finding.because.push(format!(
            "{} on {} of {}: {} {counted}, {:.2} % (95 % interval {:.2} to {:.2}); accepted {} to {} %",
            self.settings.contender,
            self.settings.problems.join(", "),
            self.settings.study,
            self.settings.hits,
            100.0 * estimate.value,
            100.0 * low,
            100.0 * high,
            100.0 * self.settings.accepted[0],
            100.0 * self.settings.accepted[1]
        ));
        finding.ours = Some(estimate);
        let units = if self.settings.of.is_some() { "draws" } else { "trials" };
        finding.say_what_settles(&self.settings.accepted, units);
        finding
    }
}
