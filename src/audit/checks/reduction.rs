//! Whether a printed percentage reduction is that of two printed cells.

use super::ratio::Formed;
use super::{Entry, FromRelation, Test, none};
use crate::input::{Input, Relation};
use crate::table::Fault;
use proofs::form::Form;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "reduction",
    about: "is a printed percentage reduction that of the two printed cells?",
    example: "percent 6.6 from 17.65 to 16.40",
    premises: "the percentage was computed from the two cells, of the first (or as `base` says)",
    source: "interval arithmetic",
    tests: none,
    relation: Some(FromRelation {
        keys: &[
            ("percent", "The change in per cent, in quotes: the printed number, or the name of a cell."),
            ("from", "The number before, in quotes: the printed number, or the name of a cell."),
            ("to", "The number after, in quotes: the printed number, or the name of a cell."),
            ("base", "What the per cent are of: `from`, which holds if absent, `to`, or `either`."),
        ],
        build,
    }),
};

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let numbers =
        [relation.number("percent", input)?, relation.number("from", input)?, relation.number("to", input)?];
    let forms = match relation.word("base", &["from", "to", "either"])? {
        "to" => vec![Form::OfSecond],
        "either" => vec![Form::OfFirst, Form::OfSecond],
        _ => vec![Form::OfFirst],
    };
    Ok(Box::new(Formed { numbers, forms, premise: "the percentage was computed from the two cells a and b" }))
}
