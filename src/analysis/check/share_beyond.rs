//! On what share of draws a contender's metric is above a number, group by group.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Finding, Verdict};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::wilson;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share_beyond",
    about: "on what share of draws is a contender's metric above a number; optionally, is it on every one?",
    settings: Accepted::of::<Settings>(),
    example: r#"
metric = "bends"
contender = "A*"
sets = [
    { study = "ensemble", problems = ["simple cells 10 %", "simple cells 20 %", "simple cells 30 %", "simple rectangles 10 %", "simple rectangles 20 %", "simple rectangles 30 %", "simple bars 10 %", "simple bars 20 %", "simple bars 30 %"], above = 2.0 },
    { study = "ensemble", problems = ["complex cells 10 %", "complex cells 20 %", "complex cells 30 %", "complex rectangles 10 %", "complex rectangles 20 %", "complex rectangles 30 %", "complex bars 10 %", "complex bars 20 %", "complex bars 30 %"], above = 2.0 },
]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let mut metric = None;
        for (index, set) in settings.sets.iter().enumerate() {
            let study = context.study_in(
                &format!("sets.{index}"),
                &set.study,
                &set.problems,
                &[settings.contender.as_str()],
            )?;
            metric = Some(context.metric(&settings.metric, study)?);
        }
        let metric = metric.ok_or_else(|| context.settings.error_at("sets", "`sets` names no problems"))?;
        Ok(Box::new(ShareBeyond { settings, metric }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// Whether the claim is that it is above on every draw; otherwise the shares are shown and nothing is judged.
    #[serde(default)]
    every: bool,
    /// The problems that are looked at, by study.
    sets: Vec<SetSpec>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SetSpec {
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// In the metric's unit; a value this close above it is not above it.
    above: f64,
}

struct ShareBeyond {
    settings: Settings,
    metric: &'static Metric,
}

/// Values closer than this differ by the order of a sum alone.
const EQUAL: f64 = 1e-9;

impl Check for ShareBeyond {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        let (mut below, mut all) = (None, 0);
        for set in &self.settings.sets {
            let Some(run) = evidence.run(&set.study) else { continue };
            for group in &set.problems {
                let contender = &self.settings.contender;
                let pairs = run.pairs(group, contender, contender);
                let known = pairs.iter().filter_map(|pair| Some((pair, run.value(pair.other, self.metric)?)));
                let (beyond, not): (Vec<_>, Vec<_>) =
                    known.partition(|(_, value)| *value > set.above + EQUAL);
                let n = beyond.len() + not.len();
                all += n;
                below = below.or(not.first().map(|(pair, _)| run.trial(pair.other)));
                let Some(interval) = wilson(beyond.len(), n, 0.95) else { continue };
                finding.because.push(format!(
                    "{group}: {} above {} on {:.1} % of {n} maps ({:.1} to {:.1} %)",
                    self.metric.title().to_lowercase(),
                    set.above,
                    100.0 * beyond.len() as f64 / n as f64,
                    100.0 * interval.low,
                    100.0 * interval.high
                ));
            }
        }
        if self.settings.every {
            finding.verdict = Some(match (all, &below) {
                (0, _) => Verdict::Undecided,
                (_, None) => Verdict::Reproduced,
                (_, Some(_)) => Verdict::NotReproduced,
            });
            finding.trial = below;
        }
        finding
    }
}
