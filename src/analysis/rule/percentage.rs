//! Whether a printed percentage is what the printed cells give.

use super::{Entry, refused, rule};
use base::settings::Accepted;
use proofs::proof;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "percentage",
    about: "is a printed reduction what the printed cells give?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
before = "table1.astar.length"
after = "table1.weighted.length"
"#,
    build: |context| {
        let Settings { before, after } = context.settings.read()?;
        let print = context.print()?;
        let cells = [context.print_of("before", &before)?, context.print_of("after", &after)?];
        let proof = proof::percentage(print, cells).ok_or_else(|| {
            let [before, after] = cells.map(|cell| cell.printed);
            context.settings.error(format!(
                "a reduction from {before} to {after} has no meaning: the first must be positive and the second not \
                 negative, whatever their digits stand for"
            ))
        })?;
        Ok(rule(move |_, _| refused(proof.clone())))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The claim that prints the number before.
    before: String,
    /// The claim that prints the number after.
    after: String,
}
