//! Whether the mean of a sum is the sum of the means.

use super::arguments::{digits, each_of_cell, json_span, shown_span, spans};
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::meaning::Kind;
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted, Table, named_by, quoted};
use proofs::exact::{Exact, Print, Span, mul, spelled, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sum_of_means",
    about: "is the mean of a sum the sum of the means?",
    example: "total 10.0 of parts 4.0 and 5.0",
    premises: "the total is the sum of the parts on every problem; all means are over the same problems",
    source: "linearity of the mean; interval arithmetic",
    tests: |input, give| each_of_cell(input, of_cell, give),
    relation: Some(FromRelation {
        keys: &[
            ("total", "The mean of the whole, in quotes: the printed number, or the name of a cell."),
            ("parts", "The means of its parts, each in quotes or the name of a cell."),
            (
                "cut",
                "What each measured value was cut to a multiple of, in quotes if no whole number; nothing was cut if absent.",
            ),
        ],
        build,
    }),
};

struct SumOfMeans {
    /// The total, then its parts.
    numbers: Vec<Quoted>,
    /// Every measured value is cut to a multiple of this, the total on its own.
    cut: Option<Exact>,
}

/// Whether the cell holds something that adds up: a mean, a total, or a value of its own.
fn is_additive(table: &Table, row: usize, column: usize) -> bool {
    let statistic = match (table.statistics(), &table.columns[column].meaning.kind) {
        (Some(at), _) => Statistic::named(&table.rows[row][at].text),
        (None, Kind::Statistic(statistic)) => Some(*statistic),
        (None, kind) => return matches!(kind, Kind::Value | Kind::Share { .. }),
    };
    matches!(statistic, Some(Statistic::Mean | Statistic::Total))
}

fn of_cell(index: usize, table: &Table, row: usize, total: usize) -> Option<SumOfMeans> {
    let columns = &table.columns;
    if columns[total].meaning.sum.is_empty() || !is_additive(table, row, total) {
        return None;
    }
    let parts = columns[total].meaning.sum.iter();
    let parts = parts.map(|name| quoted(index, table, row, named_by(columns, total, name)?));
    let numbers =
        std::iter::once(quoted(index, table, row, total)).chain(parts).collect::<Option<Vec<_>>>()?;
    Some(SumOfMeans { numbers, cut: None })
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let mut numbers = vec![relation.number("total", input)?];
    numbers.extend(relation.numbers("parts", input)?);
    Ok(Box::new(SumOfMeans { numbers, cut: relation.exact("cut")?.filter(|cut| *cut > whole(0)) }))
}

impl SumOfMeans {
    /// What the parts allow the total to be.
    fn allowed(&self, prints: &[Print]) -> Option<Span> {
        let sum = spans(&prints[1..]).iter().try_fold(Span::point(whole(0)), |sum, span| sum.plus(span))?;
        match self.cut {
            None => Some(sum),
            // Each part loses less than one tick by being cut, so the total keeps 0 to one tick fewer than there are parts.
            Some(cut) => sum.plus(&Span::closed(whole(0), mul(cut, whole(prints.len() as i128 - 2))?)),
        }
    }
}

impl Test for SumOfMeans {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(self.allowed(prints)?.meets(&prints[0].span()))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let allowed = self.allowed(prints).map_or("?".to_owned(), |span| shown_span(&span, 6));
        let verb = if is_possible { "is" } else { "is not" };
        format!("{} {verb} the sum of the parts, which is {allowed}", prints[0].printed)
    }

    fn premises(&self) -> Vec<String> {
        let sum =
            "the total is the sum of the parts on every problem, and all means are over the same problems";
        let cut =
            self.cut.map(|cut| format!("each time is cut to a multiple of {cut}, the total on its own"));
        [Some(sum.to_owned()), cut, Some(digits(&self.numbers))].into_iter().flatten().collect()
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let given = json!({ "cut": self.cut.map(spelled) });
        Some(Proof { given, steps: json!([{ "sum": json_span(&self.allowed(prints)?) }]) })
    }
}
