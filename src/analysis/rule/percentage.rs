//! Whether a printed percentage is what the printed cells give.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::percent::Reduction;
use audit::printed::{Digits, Printed};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "percentage",
    about: "is a printed reduction what the printed cells give?",
    settings: Accepted::of::<Settings>(),
    example: r#"
before = "t1.astar.time"
after = "t1.improved.time"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let (before, digits) = context.printed_of(&settings.before)?;
        let (after, _) = context.printed_of(&settings.after)?;
        let reduction =
            Reduction::between(before, after, digits).map_err(|e| context.settings.error(e.to_string()))?;
        let printed = context.printed()?;
        Ok(Box::new(Percentage { reduction, before, after, printed, digits: context.digits() }))
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

struct Percentage {
    reduction: Reduction,
    before: Printed,
    after: Printed,
    printed: Printed,
    digits: Digits,
}

impl Rule for Percentage {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let cells = format!("({} − {}) / {}", self.before, self.after, self.before);
        let computed = format!("{cells} = {:.3} %", self.reduction.as_printed);
        let possible = self.reduction.possible;
        let range = format!("the cells' digits allow {:.2} to {:.2} %", possible.low, possible.high);
        let (found, outcome) = if self.reduction.gives(self.printed, self.digits) {
            (format!("which prints as {}; {range}", self.printed), None)
        } else if self.reduction.allows(self.printed, self.digits) {
            (format!("{} needs digits that the cells do not show; {range}", self.printed), None)
        } else {
            (format!("{} is outside; {range}", self.printed), Some(Outcome::Proved))
        };
        Found {
            outcome,
            because: vec![computed, found],
            premises: vec!["the percentage was computed from the two cells of the table".to_owned()],
            ..Found::default()
        }
    }
}
