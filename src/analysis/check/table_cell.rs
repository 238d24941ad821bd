//! Whether a printed share of solved queries could be that of one more of our draws.

use super::{Check, Entry};
use crate::analysis::draws::solved_percents;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Estimate, Finding, Verdict};
use crate::study::Study;
use crate::study::key::SweepKey;
use crate::study::name;
use audit::printed::Printed;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::predictive;
use stats::summary::mean;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "table_cell",
    about: "does the printed share of solved queries lie where one more draw of ours would, with 95 % probability?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
contender = "Original A*"
sweep = "samples=100"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let problems = std::slice::from_ref(&settings.problems);
        let study = context.study(&settings.study, problems, &[&settings.contender])?;
        let point = study.sweep_point(&settings.sweep).ok_or_else(|| {
            let known: Vec<String> =
                study.sweep_points().iter().map(|point| name::sweep(&point.key)).collect();
            let known = known.join(", ");
            let message = format!("study `{}` has no sweep `{}`; it has {known}", study.name, settings.sweep);
            context.settings.error_at("sweep", message)
        })?;
        let is_fitted = study.fitted_to.contains(&context.claim.id);
        Ok(Box::new(TableCell { settings, study, sweep: point.key, printed: context.printed()?, is_fitted }))
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
    /// The point of the study's sweeps, as trials name it: `samples=100`.
    sweep: String,
}

/// An interval that covers this much of all percentages refuses next to nothing: it decides nothing either.
const NO_POWER_POINTS: f64 = 80.0;

struct TableCell<'a> {
    settings: Settings,
    study: &'a Study,
    sweep: SweepKey,
    printed: Printed,
    is_fitted: bool,
}

impl Check for TableCell<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, sweep } = &self.settings;
        let run = evidence.run(study);
        let draws = run.map(|run| solved_percents(run, problems, contender, &self.sweep)).unwrap_or_default();
        let mut finding = Finding::of(ENTRY.name);
        let (Some(interval), Some(mean)) = (predictive(&draws, 0.95), mean(&draws)) else {
            return finding
                .undecided(format!("{} draws; a 95 % predictive interval takes at least 39", draws.len()));
        };
        let printed = self.printed.value();
        let has_power = interval.high - interval.low < NO_POWER_POINTS;
        finding.verdict = Some(match interval.contains(printed) {
            true if !has_power => Verdict::Undecided,
            true if self.is_fitted => Verdict::Fitted,
            true if self.study.searched => Verdict::Attainable,
            true => Verdict::Reproduced,
            false => Verdict::NotReproduced,
        });
        let at_most = draws.iter().filter(|draw| **draw <= printed).count();
        let what = "mean share solved in %, 95 % predictive interval of one draw";
        finding.ours = Some(Estimate::new(mean, interval, what, draws.len()));
        finding.because.push(format!(
            "{contender} at {sweep}: mean {mean:.1} %; one more draw lies in [{:.0}, {:.0}] % with 95 % probability; \
             printed {} %, at or above {at_most} of {} draws",
            interval.low,
            interval.high,
            self.printed,
            draws.len()
        ));
        if !has_power {
            finding.because.push(format!(
                "no power: the interval covers {NO_POWER_POINTS} points or more of the 100 there are, so hardly any printed value \
                 could be refused; no number of draws of ours narrows it, for the printed row is one draw"
            ));
        }
        finding
    }
}
