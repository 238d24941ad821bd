//! Whether a printed number is at most a limit that is printed too.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::exact::Print;
use proofs::proof;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "at_most",
    about: "is a printed number at most a limit that the source itself sets?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
limit = 1_000_000
says = "at most 1 000 000 iterations, as the script sets them"
"#,
    build: |context| {
        let Settings { limit, says } = context.settings.read()?;
        let print: Print = context.print()?;
        Ok(rule(move |_, _| refused(proof::at_most(print, limit, &says))))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The limit, in the unit of the printed number.
    limit: f64,
    /// Where and how the source sets it.
    says: String,
}
