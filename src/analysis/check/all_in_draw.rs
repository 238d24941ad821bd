//! In what share of draws one contender is lower than another on every query.

use super::{Check, Entry};
use crate::analysis::draws::Compared;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::{trials_for_margin, wilson};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "all_in_draw",
    about: "is one contender lower than another on every query of a draw, in at least a given share of draws?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "length"
problems = "cell"
metric = "path_length_mm"
lower = "Improved A*"
higher = "Original A*"
in_share = 0.5
whole_draws = true
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.lower.as_str(), settings.higher.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        if !(0.0..=1.0).contains(&settings.in_share) {
            let message = format!("in_share is {}; 0 to 1 is accepted", settings.in_share);
            return Err(context.settings.error_at("in_share", message));
        }
        let metric = context.metric(&settings.metric, study)?;
        Ok(Box::new(AllInDraw { settings, metric }))
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
    /// The claim is kept if it holds in at least this share of draws.
    in_share: f64,
    /// Whether only draws count of which both solve every query.
    whole_draws: bool,
}

struct AllInDraw {
    settings: Settings,
    metric: &'static Metric,
}

impl Check for AllInDraw {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, lower, higher, in_share, whole_draws, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let compared =
            Compared { group: problems, contenders: [higher, lower], query: None, whole: *whole_draws };
        let draws = compared.values(run, self.metric);
        let all = draws.iter().filter(|draw| draw.iter().all(|(base, other)| other < base)).count();
        let Some(interval) = wilson(all, draws.len(), 0.95) else {
            return finding.undecided("no draw has a query that both solve");
        };
        finding.verdict = Some(Verdict::at_least(interval, *in_share));
        let share = all as f64 / draws.len() as f64;
        let queries: Vec<&(f64, f64)> = draws.iter().flatten().collect();
        let count = |is: fn(&&&(f64, f64)) -> bool| queries.iter().filter(is).count();
        let what = "share of draws in which it is lower on every query, Wilson 95 %";
        finding.ours = Some(Estimate::new(share, interval, what, draws.len()));
        finding.because.push(format!(
            "{lower} against {higher}: {} is lower on every query that both solve in {all} of {} draws{}; of {} \
             queries it is lower on {}, equal on {}, higher on {}; kept if in at least {in_share} of draws",
            self.metric.label.to_lowercase(),
            draws.len(),
            if *whole_draws { " of which both solve every query" } else { "" },
            queries.len(),
            count(|(base, other)| other < base),
            count(|(base, other)| other == base),
            count(|(base, other)| other > base)
        ));
        if finding.verdict == Some(Verdict::Undecided) {
            let margin = (share - in_share).abs().max(0.005);
            let needed = trials_for_margin(share, margin, 0.95);
            finding.because.push(format!("about {needed} draws would settle it"));
        }
        finding
    }
}
