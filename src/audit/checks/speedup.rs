//! Whether "x times faster" is what two printed times give.

use super::ratio::Formed;
use super::{Entry, FromRelation, Test, none};
use crate::input::{Input, Relation};
use crate::table::Fault;
use proofs::form::Form;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "speedup",
    about: "is \"x times faster\" what the two printed times give, as before/after or that less one?",
    example: "times 3.0 before 10.0 after 5.0",
    premises: "the factor was computed from the two cells; both ways to say \"times faster\" count unless one is named",
    source: "interval arithmetic",
    tests: none,
    relation: Some(FromRelation {
        keys: &[
            ("times", "The printed factor, in quotes: the printed number, or the name of a cell."),
            ("before", "The slower time, in quotes: the printed number, or the name of a cell."),
            ("after", "The faster time, in quotes: the printed number, or the name of a cell."),
            ("means", "How the factor is meant: `times` as fast, `times more`; `either` if absent."),
        ],
        build,
    }),
};

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let numbers = [
        relation.number("times", input)?,
        relation.number("before", input)?,
        relation.number("after", input)?,
    ];
    let forms = match relation.word("means", &["either", "times", "times more"])? {
        "times" => vec![Form::Times],
        "times more" => vec![Form::TimesMore],
        _ => vec![Form::Times, Form::TimesMore],
    };
    Ok(Box::new(Formed { numbers, forms, premise: "the factor was computed from the two cells a and b" }))
}
