//! How many of a contender's paths the verifier refuses under each option of one reading: a count, no verdict.

use super::{Check, Context, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::Finding;
use crate::study::Study;
use crate::study::record::Status;
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::wilson;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "refused_by_option",
    about: "how many of a contender's paths does the verifier refuse under each option of one reading?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "readings"
problems = ["simple", "complex"]
contender = "Improved A*"
reading = "line_of_sight"
"#,
    build: |context| Ok(Box::new(RefusedByOption::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// A study that explores readings.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
    /// The contender, by its label.
    contender: String,
    /// The reading's name.
    reading: String,
}

struct RefusedByOption<'a> {
    settings: Settings,
    study: &'a Study,
    options: Vec<String>,
}

impl<'a> RefusedByOption<'a> {
    fn new(context: &Context<'a>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let study = context.study(&settings.study, &settings.problems, &[settings.contender.as_str()])?;
        let reading = study.readings.iter().find(|reading| reading.id == settings.reading);
        let options = reading.map(|reading| reading.options.keys().cloned().collect()).ok_or_else(|| {
            let known: Vec<&str> = study.readings.iter().map(|reading| reading.id.as_str()).collect();
            let (name, reading, known) = (&study.name, &settings.reading, known.join(", "));
            let message = format!("study `{name}` has no reading `{reading}`; it has {known}");
            context.settings.error_at("reading", message)
        })?;
        Ok(Self { settings, study, options })
    }

    /// Paths that came back, and those of them that were refused, under every reading with `option`.
    fn counted(&self, option: &String, evidence: &Evidence<'_>) -> [usize; 2] {
        let points = self.study.trial_points().expect("a checked study's readings are in order");
        let mut counted = [0; 2];
        for point in points.into_iter().filter(|point| point.choices()[&self.settings.reading] == *option) {
            let view = evidence.under(point);
            let Some(run) = view.run(&self.settings.study) else { continue };
            for row in self.settings.problems.iter().flat_map(|g| run.rows(g, &self.settings.contender)) {
                counted[0] += usize::from(matches!(row.status, Status::Solved | Status::Rejected));
                counted[1] += usize::from(row.status == Status::Rejected);
            }
        }
        counted
    }
}

impl Check for RefusedByOption<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let mut finding = Finding::of(ENTRY.name);
        for option in &self.options {
            let [paths, refused] = self.counted(option, evidence);
            let Some(share) = wilson(refused, paths, 0.95) else { continue };
            finding.because.push(format!(
                "{}={option}: {refused} of {paths} paths cross the inside of a blocked cell and are refused, {:.1} % ({:.1} \
                 to {:.1} %)",
                self.settings.reading,
                100.0 * refused as f64 / paths as f64,
                100.0 * share.low,
                100.0 * share.high
            ));
        }
        finding
    }
}
