//! How often one contender is below, at or above another, with an interval for each share: a count, no verdict.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::Finding;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::paired::EQUAL;
use stats::proportion::wilson;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "how_often",
    about: "on what share of problems is one contender below, at or above another, set by set?",
    settings: Accepted::of::<Settings>(),
    example: r#"
metric = "nodes"
contender = "Improved A*"
against = "A*"
sets = [
    { label = "simple, all maps", study = "ensemble", problems = ["simple cells 10 %", "simple cells 20 %", "simple cells 30 %", "simple rectangles 10 %", "simple rectangles 20 %", "simple rectangles 30 %", "simple bars 10 %", "simple bars 20 %", "simple bars 30 %"] },
    { label = "simple, given A*'s cost", study = "conditioned", problems = ["simple given cost"] },
    { label = "simple, given also its turn sum", study = "conditioned", problems = ["simple given cost, turn"] },
    { label = "simple, given also its nodes within 10 %", study = "conditioned", problems = ["simple given cost, turn, opened"] },
    { label = "complex, all maps", study = "ensemble", problems = ["complex cells 10 %", "complex cells 20 %", "complex cells 30 %", "complex rectangles 10 %", "complex rectangles 20 %", "complex rectangles 30 %", "complex bars 10 %", "complex bars 20 %", "complex bars 30 %"] },
    { label = "complex, given A*'s cost (17.65 for 17.56)", study = "conditioned", problems = ["complex given cost"] },
    { label = "complex, given also its turn sum", study = "conditioned", problems = ["complex given cost, turn"] },
    { label = "complex, given also its nodes within 10 %", study = "conditioned", problems = ["complex given cost, turn, opened"] },
]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let mut metric = None;
        for (index, set) in settings.sets.iter().enumerate() {
            let contenders = [settings.contender.as_str(), settings.against.as_str()];
            let study = context.study_in(&format!("sets.{index}"), &set.study, &set.problems, &contenders)?;
            metric = Some(context.metric(&settings.metric, study)?);
        }
        let metric = metric.ok_or_else(|| context.settings.error_at("sets", "`sets` names no problems"))?;
        Ok(Box::new(HowOften { settings, metric }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that it is held against, by its label.
    against: String,
    /// The problems that are looked at, by study.
    sets: Vec<SetSpec>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SetSpec {
    /// What these problems are.
    label: String,
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
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
