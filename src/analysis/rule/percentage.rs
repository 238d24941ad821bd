//! Whether a printed percentage is what the printed cells give.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use audit::exact::{Exact, Print, Span, decimal};
use audit::form::Form;
use audit::printed::Printed;
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
        let cells = [before, after].map(|printed| Print { printed, digits });
        let [from, to] = cells.map(Print::span);
        let [exact_from, exact_to] = cells.map(|cell| Span::point(cell.value()));
        let spans = Form::OfFirst.span(&exact_from, &exact_to).zip(Form::OfFirst.span(&from, &to));
        let (exact, possible) = spans.filter(|_| before.units() > 0 && after.units() >= 0).ok_or_else(|| {
            context.settings.error(format!(
                "a reduction from {before} to {after} has no meaning: the first must be positive and the second not \
                 negative, whatever their digits stand for"
            ))
        })?;
        let printed = Print { printed: context.printed()?, digits: context.digits() };
        Ok(Box::new(Percentage { as_printed: exact.low, possible, before, after, printed }))
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
    /// Per cent, of the cells exactly as printed.
    as_printed: Exact,
    /// Per cent, over everything that the cells' digits can stand for.
    possible: Span,
    before: Printed,
    after: Printed,
    printed: Print,
}

impl Rule for Percentage {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let cells = format!("({} − {}) / {}", self.before, self.after, self.before);
        let computed = format!("{cells} = {} %", decimal(self.as_printed, 3));
        let [low, high] = [self.possible.low, self.possible.high].map(|end| decimal(end, 2));
        let range = format!("the cells' digits allow {low} to {high} %");
        let (span, printed) = (self.printed.span(), self.printed.printed);
        let (found, outcome) = if span.contains(self.as_printed) {
            (format!("which prints as {printed}; {range}"), None)
        } else if self.possible.meets(&span) {
            (format!("{printed} needs digits that the cells do not show; {range}"), None)
        } else {
            (format!("{printed} is outside; {range}"), Some(Outcome::Proved))
        };
        Found {
            outcome,
            because: vec![computed, found],
            premises: vec!["the percentage was computed from the two cells of the table".to_owned()],
            ..Found::default()
        }
    }
}
