//! Whether a contender fails exactly where a condition of the problem says that it must.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Finding, Verdict};
use crate::study::record::Status;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "fails_where",
    about: "does a contender fail on every problem on which a metric is 0, and on no other?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
contender = "Original A*"
metric = "connected"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let problems = std::slice::from_ref(&settings.problems);
        let study = context.study(&settings.study, problems, &[&settings.contender])?;
        let metric = context.metric(&settings.metric, study)?;
        Ok(Box::new(FailsWhere { settings, metric }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The study whose records are looked at.
    study: String,
    /// The problem group, by its label.
    problems: String,
    /// The contender, by its label.
    contender: String,
    /// The metric that is 0 where it should fail.
    metric: String,
}

struct FailsWhere {
    settings: Settings,
    metric: &'static Metric,
}

impl Check for FailsWhere {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let (mut explained, mut unexplained, mut found, mut refused, mut against) = (0, 0, 0, 0, None);
        let rows = run.rows(problems, contender);
        let measured = rows.iter().filter(|row| run.value(row, self.metric).is_some()).count();
        for row in rows {
            let Some(value) = run.value(row, self.metric) else { continue };
            // A path that the verifier refused was found by the search.
            let is_refused = row.status == Status::Rejected;
            refused += u32::from(is_refused);
            let is_found = row.status == Status::Solved || is_refused;
            match (is_found, value == 0.0) {
                (false, true) => explained += 1,
                (true, false) => found += 1,
                (false, false) => unexplained += 1,
                (true, true) => {}
            }
            if is_found == (value == 0.0) || is_refused {
                against = against.or(Some(run.trial(row)));
            }
        }
        let wrongly_found = measured - explained - unexplained - found;
        finding.verdict = Some(match (explained + found, unexplained + wrongly_found) {
            (0, 0) => Verdict::Undecided,
            (_, 0) => Verdict::Reproduced,
            _ => Verdict::NotReproduced,
        });
        finding.trial = against;
        finding.because.push(format!(
            "of {} searches of {contender} that fail, {explained} are where {} is 0; of {} that find a path, {found} are where it \
             is not ({refused} of these paths the verifier refuses)",
            explained + unexplained,
            self.metric.label.to_lowercase(),
            found + wrongly_found
        ));
        finding
    }
}
