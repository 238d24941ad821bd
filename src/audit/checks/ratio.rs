//! Whether a printed quotient is that of two printed cells.

use super::arguments::{digits, each_of_cell, json_span, shown_span};
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::meaning::Kind;
use crate::table::{Fault, Quoted, Table, named_by, quoted};
use proofs::exact::{Print, Span};
use proofs::form::Form;
use serde_json::{Value, json};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "ratio",
    about: "is a printed quotient that of the two printed cells?",
    example: "ratio 2.00 of 3.1 and 1.5",
    premises: "the quotient was taken of the true values behind the two cells, not problem by problem",
    source: "interval arithmetic",
    tests: |input, give| each_of_cell(input, of_cell, give),
    relation: Some(FromRelation {
        keys: &[
            ("value", "The ratio, in quotes: the printed number, or the name of a cell."),
            ("of", "What is divided, in quotes: the printed number, or the name of a cell."),
            ("over", "What it is divided by, in quotes: the printed number, or the name of a cell."),
        ],
        build,
    }),
};

/// A printed number that is one of some forms of two cells.
pub(super) struct Formed {
    /// The number, then a and b.
    pub(super) numbers: [Quoted; 3],
    /// The forms that count.
    pub(super) forms: Vec<Form>,
    /// What is assumed.
    pub(super) premise: &'static str,
}

fn of_cell(index: usize, table: &Table, row: usize, at: usize) -> Option<Formed> {
    let meaning = &table.columns[at].meaning;
    if table.statistics().is_some() {
        return None;
    }
    // A mean, or an extreme, of quotients is not the quotient of the means.
    let [a, b] = meaning.ratio.as_ref().filter(|_| !matches!(meaning.kind, Kind::Statistic(_)))?;
    let cell = |at| quoted(index, table, row, at);
    let numbers =
        [cell(at)?, cell(named_by(&table.columns, at, a)?)?, cell(named_by(&table.columns, at, b)?)?];
    Some(Formed { numbers, forms: vec![Form::Quotient], premise: ENTRY.premises })
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let numbers =
        [relation.number("value", input)?, relation.number("of", input)?, relation.number("over", input)?];
    Ok(Box::new(Formed { numbers, forms: vec![Form::Quotient], premise: ENTRY.premises }))
}

impl Formed {
    fn allowed(&self, prints: &[Print]) -> Option<Vec<(Form, Span)>> {
        let (a, b) = (prints[1].span(), prints[2].span());
        self.forms.iter().map(|form| Some((*form, form.span(&a, &b)?))).collect()
    }
}

impl Test for Formed {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let printed = prints[0].span();
        Some(self.allowed(prints)?.iter().any(|(_, span)| span.meets(&printed)))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let allowed = self.allowed(prints).unwrap_or_default();
        let [value, a, b] = [prints[0], prints[1], prints[2]].map(|print| print.printed);
        let verb = if is_possible { "follows from" } else { "does not follow from" };
        let ranges = allowed.iter().map(|(form, span)| format!("{} is {}", form.name(), shown_span(span, 4)));
        let ranges: Vec<String> = ranges.collect();
        format!("{value} {verb} a = {a} and b = {b}: {}", ranges.join("; "))
    }

    fn premises(&self) -> Vec<String> {
        let forms: Vec<&str> = self.forms.iter().map(|form| form.name()).collect();
        vec![format!("{}, by {}", self.premise, forms.join(" or ")), digits(&self.numbers)]
    }

    fn undecided(&self, prints: &[Print]) -> String {
        let [a, b] = [prints[1], prints[2]].map(|print| print.printed);
        format!("with a = {a} and b = {b} a divisor may be 0")
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let step = |(form, span): &(Form, Span)| json!({ "form": form.name(), "span": json_span(span) });
        let steps: Vec<Value> = self.allowed(prints)?.iter().map(step).collect();
        let forms: Vec<&str> = self.forms.iter().map(|form| form.name()).collect();
        Some(Proof { given: json!({ "forms": forms }), steps: Value::Array(steps) })
    }
}
