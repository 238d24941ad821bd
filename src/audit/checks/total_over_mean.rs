//! How many values a total over a mean says there were.

use super::arguments::{digits, each_of_sample, json_span, shown};
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted};
use proofs::exact::{Exact, Print, Span, spelled, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "total_over_mean",
    about: "is a total n times the mean, and for which n? A smaller n than stated says what was dropped",
    example: "total 100.0 s, mean 2.0 s, n = 40",
    premises: "the total is the sum of the values that the mean is of",
    source: "the definition of the mean; interval arithmetic",
    tests: |input, give| each_of_sample(input, of_sample, give),
    relation: Some(FromRelation {
        keys: &[
            ("total", "The sum of all values, in quotes: the printed number, or the name of a cell."),
            ("mean", "Their mean, in quotes: the printed number, or the name of a cell."),
            ("n", "How many values are behind them, a whole number; any if absent."),
            (
                "unit",
                "The total's unit in the mean's, 1000 for s and ms, in quotes if no whole number; 1 if absent.",
            ),
        ],
        build,
    }),
};

struct TotalOverMean {
    /// The total, then the mean.
    numbers: [Quoted; 2],
    n: Option<u64>,
    /// The total's unit in the mean's.
    unit: Exact,
}

fn of_sample(sample: &Sample) -> Option<TotalOverMean> {
    let numbers = [sample.get(Statistic::Total)?.clone(), sample.get(Statistic::Mean)?.clone()];
    Some(TotalOverMean { numbers, n: sample.n, unit: whole(1) })
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let numbers = [relation.number("total", input)?, relation.number("mean", input)?];
    let unit = relation.exact("unit")?.unwrap_or(whole(1));
    if unit <= whole(0) {
        return Err(relation.fault("`unit` must be above 0"));
    }
    Ok(Box::new(TotalOverMean { numbers, n: relation.natural("n")?, unit }))
}

/// The first and the last number of values in a quotient.
fn counts(quotient: &Span) -> (i128, i128) {
    let (first, last) = quotient.integers();
    (first.max(1), last)
}

impl TotalOverMean {
    fn quotient(&self, prints: &[Print]) -> Option<Span> {
        prints[0].span().times(self.unit)?.over(&prints[1].span())
    }
}

impl Test for TotalOverMean {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let quotient = self.quotient(prints)?;
        let (first, last) = counts(&quotient);
        Some(match self.n {
            Some(n) => quotient.contains(whole(n)),
            None => first <= last,
        })
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let quotient = self.quotient(prints).unwrap_or(Span::point(whole(0)));
        let (first, last) = counts(&quotient);
        let found = match (first <= last, first == last) {
            (false, _) => "no whole number".to_owned(),
            (true, true) => format!("n = {first}"),
            (true, false) => format!("n from {first} to {last}"),
        };
        let range = format!("{} to {}", shown(quotient.low, 4), shown(quotient.high, 4));
        let stated = match self.n {
            Some(n) if is_possible => format!(", and {n} is stated"),
            Some(n) => format!(", where {n} is stated"),
            None => String::new(),
        };
        format!("{} over {} is {range}: {found}{stated}", prints[0].printed, prints[1].printed)
    }

    fn premises(&self) -> Vec<String> {
        vec![
            "the total is the sum of the values that the mean is of, in the stated units".to_owned(),
            digits(&self.numbers),
        ]
    }

    fn undecided(&self, prints: &[Print]) -> String {
        format!("the mean {} may be 0", prints[1].printed)
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let given = json!({ "n": self.n.map(|n| n.to_string()), "unit": spelled(self.unit) });
        let excluded = self.n.map_or_else(|| "every whole number above 0".to_owned(), |n| n.to_string());
        let quotient = json_span(&self.quotient(prints)?);
        Some(Proof { given, steps: json!([{ "quotient": quotient, "excludes": excluded }]) })
    }
}
