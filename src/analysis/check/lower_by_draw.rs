//! Whether one contender is lower than another on average over queries, with whole draws as the units of the interval.

use super::{Check, Entry};
use crate::analysis::draws::Compared;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use base::seed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::bootstrap::Resampling;
use stats::paired::change_of_sums_percent;
use stats::proportion::units_for_margin;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lower_by_draw",
    about: "is one contender lower than another on average over queries, with whole draws as the units of the interval?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "length"
problems = "cell"
metric = "local_paths"
lower = "Improved A*"
higher = "Original A*"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.lower.as_str(), settings.higher.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        let metric = context.metric(&settings.metric, study)?;
        let seed = seed::derive(0, &[&context.paper.id, &context.claim.id]);
        Ok(Box::new(LowerByDraw { settings, metric, seed }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender that is claimed to be lower.
    lower: String,
    /// The contender that is claimed to be higher.
    higher: String,
    /// The one query that the claim is about; all if absent.
    query: Option<String>,
}

struct LowerByDraw {
    settings: Settings,
    metric: &'static Metric,
    seed: u64,
}

impl Check for LowerByDraw {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, lower, higher, query, .. } = &self.settings;
        let (contenders, query) = ([higher.as_str(), lower.as_str()], query.as_deref());
        let compared = Compared { group: problems, contenders, query, whole: false };
        let mut finding = Finding::of(ENTRY.name);
        let draws = evidence.run(study).map(|run| compared.values(run, self.metric)).unwrap_or_default();
        let plan = Resampling { resamples: 2000, level: 0.95, seed: self.seed };
        let Some(found) = change_of_sums_percent(&draws, plan) else {
            return finding
                .undecided(format!("{} draws have a query that both solve; 2 are needed", draws.len()));
        };
        finding.verdict = Some(Verdict::below_zero(found.interval));
        let pairs: Vec<&(f64, f64)> = draws.iter().flatten().collect();
        let count = |is: fn(&(f64, f64)) -> bool| pairs.iter().filter(|pair| is(pair)).count();
        finding.because.push(format!(
            "{lower} against {higher}{}: {} changes by {:.1} % in all (95 % interval {:.1} to {:.1}, bootstrap over {} draws); lower \
             on {}, equal on {}, higher on {} of {} queries that both solve",
            query.map_or(String::new(), |name| format!(" on query {name}")),
            self.metric.label.to_lowercase(),
            found.value,
            found.interval.low,
            found.interval.high,
            draws.len(),
            count(|(a, b)| b < a),
            count(|(a, b)| b == a),
            count(|(a, b)| b > a),
            pairs.len()
        ));
        if finding.verdict == Some(Verdict::Undecided) {
            let margin = found.value.abs().max(0.1);
            let needed = units_for_margin(found.interval.half_width(), draws.len(), margin);
            finding.because.push(format!("about {needed} draws would settle a change of this size"));
        }
        let what = format!("change of {} in %, bootstrap over draws, 95 %", self.metric.label.to_lowercase());
        finding.ours = Some(Estimate::new(found.value, found.interval, what, draws.len()));
        finding
    }
}
