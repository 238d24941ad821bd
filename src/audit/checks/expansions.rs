//! Whether a planner expands no more cells than are free.

use super::arguments::{count, digits, each_number, up_to_twice};
use super::{Entry, FromRelation, Proof, Test, Window};
use crate::input::{Input, Relation};
use crate::meaning::Kind;
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted};
use proofs::exact::{Print, mul, spelled, sub, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "expansions",
    about: "are there no more expansions than free cells?",
    example: "expanded [free=900] = 1024",
    premises: "a cell is expanded once at most, as with a consistent heuristic; the count is of distinct cells",
    source: "Hart, Nilsson & Raphael (1968), lemma 2; with known ends and length see proofs::fvalues",
    tests,
    relation: Some(FromRelation {
        keys: &[
            ("value", "How many nodes were opened, in quotes: the printed number, or the name of a cell."),
            ("free", "How many free cells the map has, a whole number."),
        ],
        build,
    }),
};

struct Expansions {
    numbers: [Quoted; 1],
    free: u64,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    let is_bounded = |kind: &Kind| match kind {
        Kind::Value | Kind::Samples => true,
        Kind::Statistic(statistic) => !matches!(statistic, Statistic::Sd | Statistic::Se | Statistic::Total),
        _ => false,
    };
    let is_meant =
        |column: &crate::table::Column| column.meaning.free.is_some() && is_bounded(&column.meaning.kind);
    each_number(input, is_meant, &mut |_, column, _, number| {
        if let Some(free) = column.meaning.free {
            give(Box::new(Expansions { numbers: [number], free }));
        }
    });
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    Ok(Box::new(Expansions { numbers: [relation.number("value", input)?], free: relation.needed("free")? }))
}

impl Test for Expansions {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let span = prints[0].span().cut([Some(whole(0)), Some(count(self.free))]);
        Some(!span.is_empty())
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let verb = if is_possible { "no more than" } else { "not between 0 and" };
        format!("{} expansions are {verb} the {} free cells", prints[0].printed, self.free)
    }

    fn premises(&self) -> Vec<String> {
        vec![format!("each of {} free cells is expanded once at most", self.free), digits(&self.numbers)]
    }

    fn window(&self) -> Option<Window> {
        up_to_twice(self.numbers[0].print)
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let span = prints[0].span();
        let past = sub(span.low, count(self.free))?.max(mul(span.high, whole(-1))?);
        let given = json!({ "free": self.free.to_string() });
        Some(Proof { given, steps: json!([{ "outside_by": spelled(past) }]) })
    }
}
