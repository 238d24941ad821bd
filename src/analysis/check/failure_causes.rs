//! Why searches fail: because an end has no neighbour, or because both have and lie in separate parts of the roadmap.

use super::{Check, Entry};
use crate::analysis::draws::both;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::record::{Row, Status};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::{Resampling, percentile};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "failure_causes",
    about: "do most failing searches have neighbours at both ends, so that parts of the roadmap are separate and not an end alone?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
contender = "Original A*"
relief = "Improved A*"
at_least = 0.5
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.relief.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        for name in ["start_links", "goal_links", "shots"] {
            context.metric(name, study)?;
        }
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(FailureCauses { settings, seed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// Whose failures are looked at.
    contender: String,
    /// Who finds paths where it fails, by shots at the goal.
    relief: String,
    /// The claim is kept if at least this share of failures lie between separate parts.
    at_least: f64,
}

struct FailureCauses {
    settings: Settings,
    seed: u64,
}

/// Counts of one draw.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
struct Tally {
    failures: usize,
    no_start: usize,
    no_goal: usize,
    apart: usize,
    relieved: usize,
    first_shot: usize,
}

fn value(run: &Run<'_>, row: &Row, name: &str) -> Option<f64> {
    run.value(row, metric::find(name).expect("the metric was found when the check was built"))
}

impl Tally {
    fn of(run: &Run<'_>, pairs: &[[&Row; 2]]) -> Self {
        let mut tally = Self::default();
        for [row, relief] in pairs {
            let ends = ["start_links", "goal_links"].map(|name| value(run, row, name));
            let ([Some(start), Some(goal)], Status::NoPath) = (ends, row.status) else { continue };
            tally.failures += 1;
            tally.no_start += usize::from(start == 0.0);
            tally.no_goal += usize::from(goal == 0.0);
            tally.apart += usize::from(start > 0.0 && goal > 0.0);
            if relief.status == Status::Solved {
                tally.relieved += 1;
                tally.first_shot += usize::from(value(run, relief, "shots") == Some(1.0));
            }
        }
        tally
    }
}

/// The share of failures between separate parts.
fn share(draws: &[&Tally]) -> Option<f64> {
    let sum = |get: fn(&Tally) -> usize| draws.iter().map(|draw| get(draw)).sum::<usize>() as f64;
    let failures = sum(|tally| tally.failures);
    (failures > 0.0).then(|| sum(|tally| tally.apart) / failures)
}

impl Check for FailureCauses {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, relief, at_least } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let pairs = both(run, problems, contender, relief);
        let draws: Vec<Tally> = pairs.values().map(|pairs| Tally::of(run, pairs)).collect();
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let Some(found) = percentile(&draws, share, plan) else {
            return finding.undecided("fewer than two draws, or no search fails");
        };
        finding.verdict = Some(Verdict::at_least(found.interval, *at_least));
        let what = "share of failing searches with neighbours at both ends, bootstrap over draws, 95 %";
        finding.ours = Some(Estimate::new(found.value, found.interval, what, draws.len()));
        let sum = |get: fn(&Tally) -> usize| draws.iter().map(get).sum::<usize>();
        let failures = sum(|tally| tally.failures);
        let percent = |part: usize, all: usize| 100.0 * part as f64 / all.max(1) as f64;
        let [no_start, no_goal, apart] =
            [sum(|t| t.no_start), sum(|t| t.no_goal), sum(|t| t.apart)].map(|part| percent(part, failures));
        finding.because.push(format!(
            "of {failures} failing searches of {contender} {no_start:.1} % have no neighbour of the start, {no_goal:.1} % none of \
             the goal, and {apart:.1} % have both and lie in separate parts of the roadmap; kept if at least {:.0} %",
            100.0 * at_least
        ));
        let (relieved, first) = (sum(|t| t.relieved), sum(|t| t.first_shot));
        finding.because.push(format!(
            "{relief} finds a path on {relieved} of them, on {first} ({:.1} %) by the shot from the start itself, which asks nothing \
             of the roadmap, and on {} by a shot from a later node",
            percent(first, relieved),
            relieved - first
        ));
        finding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_weigh_alike_whatever_draw_they_are_of() {
        let draw = |failures, apart| Tally { failures, apart, ..Tally::default() };
        assert_eq!(share(&[&draw(3, 3), &draw(1, 0)]), Some(0.75));
        assert_eq!(share(&[&draw(0, 0)]), None);
    }
}
