//! Whether one contender's share of solved queries is always above another's, taken literally.

use super::{Check, Entry};
use crate::analysis::draws::solved_percents;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Finding, Verdict};
use crate::study::Study;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "share_above",
    about: "is one contender's share of solved queries above another's in every draw at every point of the sweep?",
    settings: Accepted::of::<Settings>(),
    example: r#"
study = "success"
problems = "cell"
contender = "Improved A*"
against = "Original A*"
printed = [
    ["t2.improved.100", "t2.original.100"],
    ["t2.improved.200", "t2.original.200"],
    ["t2.improved.300", "t2.original.300"],
    ["t2.improved.400", "t2.original.400"],
    ["t2.improved.500", "t2.original.500"],
    ["t2.improved.600", "t2.original.600"],
    ["t2.improved.700", "t2.original.700"],
    ["t2.improved.800", "t2.original.800"],
    ["t2.improved.900", "t2.original.900"],
    ["t2.improved.1000", "t2.original.1000"],
    ["t2.improved.1100", "t2.original.1100"],
    ["t2.improved.1200", "t2.original.1200"],
    ["t2.improved.1300", "t2.original.1300"],
    ["t2.improved.1400", "t2.original.1400"],
    ["t2.improved.1500", "t2.original.1500"],
]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let contenders = [settings.contender.as_str(), settings.against.as_str()];
        let study = context.study(&settings.study, std::slice::from_ref(&settings.problems), &contenders)?;
        let mut printed = Vec::new();
        for [above, below] in &settings.printed {
            let value = |id: &str| context.printed_of(id).map(|(printed, _)| printed.value());
            printed.push(([above.clone(), below.clone()], [value(above)?, value(below)?]));
        }
        Ok(Box::new(ShareAbove { settings, study, printed }))
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
    /// The contender that it is held against, by its label.
    against: String,
    /// Claims of one printed cell each, the one said to be higher first.
    printed: Vec<[String; 2]>,
}

struct ShareAbove<'a> {
    settings: Settings,
    study: &'a Study,
    printed: Vec<([String; 2], [f64; 2])>,
}

impl Check for ShareAbove<'_> {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let Settings { study, problems, contender, against, .. } = &self.settings;
        let mut finding = Finding::of(ENTRY.name);
        let Some(run) = evidence.run(study) else { return finding };
        let (mut above, mut equal, mut below) = (0, 0, 0);
        for point in self.study.sweep_points() {
            let shares = |who: &str| solved_percents(run, problems, who, &point.key);
            for (own, other) in shares(contender).iter().zip(shares(against)) {
                above += u32::from(*own > other);
                equal += u32::from(*own == other);
                below += u32::from(*own < other);
            }
        }
        finding.because.push(format!(
            "over all draws and points of the sweep, {contender} is above {against} in {above}, equal in {equal}, below in {below}"
        ));
        let not_above = self.printed.iter().filter(|(_, [own, other])| own <= other);
        let printed: Vec<String> = not_above
            .map(|([own, other], [a, b])| format!("`{own}` prints {a} % and `{other}` {b} %"))
            .collect();
        let is_contradicted = !printed.is_empty();
        finding.verdict = Some(match (is_contradicted, equal + below, below) {
            (true, ..) => Verdict::Impossible,
            (false, 0, _) => Verdict::Reproduced,
            (false, _, 0) => Verdict::DirectionOnly,
            (false, ..) => Verdict::NotReproduced,
        });
        if is_contradicted {
            finding
                .because
                .push(format!("the paper's own table contradicts the sentence: {}", printed.join("; ")));
            finding.premises.push("“always higher” means higher at every printed point".to_owned());
        }
        finding
    }
}
