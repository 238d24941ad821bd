//! How often one contender is below, at or above another, with an interval for each share: a count, no verdict.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::Finding;
use serde::Deserialize;
use stats::paired::EQUAL;
use stats::proportion::wilson;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "how_often",
    about: "on what share of problems is one contender below, at or above another, set by set?",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let mut metric = None;
        for set in &settings.sets {
            let contenders = [settings.contender.as_str(), settings.against.as_str()];
            let study = context.study(&set.study, &set.problems, &contenders)?;
            metric = Some(context.metric(&settings.metric, study)?);
        }
        let metric = metric.ok_or_else(|| context.settings.error("`sets` names no problems"))?;
        Ok(Box::new(HowOften { settings, metric }))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    metric: String,
    contender: String,
    against: String,
    sets: Vec<SetSpec>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SetSpec {
    /// What these problems are.
    label: String,
    study: String,
    problems: Vec<String>,
}

struct HowOften {
    settings: Settings,
    metric: &'static Metric,
}

impl HowOften {
    fn said(&self, set: &SetSpec, evidence: &Evidence<'_>) -> String {
        let Settings { contender, against, .. } = &self.settings;
        let found = evidence.measured(&set.study, &set.problems, self.metric, against, contender);
        let gap = found.iter().map(|measured| measured.values.1 - measured.values.0);
        let (below, above) = gap.fold((0, 0), |(below, above), gap| {
            (below + usize::from(gap < -EQUAL), above + usize::from(gap > EQUAL))
        });
        let share = |count: usize| {
            let share = wilson(count, found.len(), 0.95).map(|interval| {
                let percent = 100.0 * count as f64 / found.len() as f64;
                format!("{percent:.1} % ({:.1} to {:.1} %)", 100.0 * interval.low, 100.0 * interval.high)
            });
            share.unwrap_or_else(|| "–".to_owned())
        };
        format!(
            "{}, {} maps: higher on {}, equal on {}, lower on {}",
            set.label,
            found.len(),
            share(above),
            share(found.len() - above - below),
            share(below)
        )
    }
}

impl Check for HowOften {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { contender, against, sets, .. } = &self.settings;
        let asked = format!(
            "{} of {contender} against that of {against} on problems that both solve, with Wilson 95 % intervals",
            self.metric.title()
        );
        let said = sets.iter().map(|set| self.said(set, evidence));
        let because = std::iter::once(asked).chain(said).collect();
        Finding { check: ENTRY.name.to_owned(), because, ..Finding::default() }
    }
}
