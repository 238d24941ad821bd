//! Two places of a paper that cannot both be right.

use super::{Check, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Finding, Verdict};
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "text_contradiction",
    about: "two places of the paper, quoted, that cannot both be right",
    build: |context| {
        let settings: TextContradiction = context.settings.read()?;
        if settings.one == settings.other {
            return Err(context
                .settings
                .error("`one` and `other` say the same; two places that differ are needed"));
        }
        Ok(Box::new(settings))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TextContradiction {
    /// One place and what it says.
    one: String,
    /// Another place and what it says.
    other: String,
    /// Why both cannot be right.
    why: String,
}

impl Check for TextContradiction {
    fn judge(&self, _evidence: &Evidence<'_>) -> Finding {
        Finding {
            check: ENTRY.name.to_owned(),
            verdict: Some(Verdict::Impossible),
            because: vec![self.one.clone(), self.other.clone(), self.why.clone()],
            premises: vec!["the text as published is what the authors meant".to_owned()],
            ..Finding::default()
        }
    }
}
