//! Whether every printed number that is said to be above another is.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "printed_above",
    about: "is every printed number that is said to be above another one above it?",
    settings: Accepted::of::<Settings>(),
    example: r#"
above = ["t2.improved.100", "t2.improved.200"]
below = ["t2.original.100", "t2.original.200"]
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        if settings.above.len() != settings.below.len() {
            let (above, below) = (settings.above.len(), settings.below.len());
            let message = format!("`above` names {above} claims and `below` {below}; as many are accepted");
            return Err(context.settings.error_at("below", message));
        }
        let value = |id: &String| Ok(context.printed_of(id)?.0.value());
        let mut equal = Vec::new();
        for (above, below) in settings.above.iter().zip(&settings.below) {
            let (more, less) = (value(above)?, value(below)?);
            if more <= less {
                equal.push(format!("`{above}` prints {more} and `{below}` {less}"));
            }
        }
        Ok(Box::new(PrintedAbove { contrary: equal, all: settings.above.len() }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The claims that print what is said to be higher.
    above: Vec<String>,
    /// The claims that print what each of them is above.
    below: Vec<String>,
}

struct PrintedAbove {
    /// Where it is not.
    contrary: Vec<String>,
    all: usize,
}

impl Rule for PrintedAbove {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let said = match &self.contrary[..] {
            [] => format!("each of the {} printed pairs is as the sentence says", self.all),
            contrary => format!("the paper's own numbers contradict the sentence: {}", contrary.join("; ")),
        };
        Found {
            outcome: (!self.contrary.is_empty()).then_some(Outcome::Proved),
            because: vec![said],
            premises: vec!["the sentence speaks of every printed pair, and above is not equal".to_owned()],
            ..Found::default()
        }
    }
}
