//! Whether printed times are whole numbers of a clock's ticks.

use super::arguments::{digits, each_number, gap, multiple};
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::meaning::Kind;
use crate::table::{Fault, Quoted};
use proofs::clock::ticks;
use proofs::exact::{Exact, Print, spelled, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "clock",
    about: "is a single time a whole number of the clock's ticks?",
    example: "time [tick=1/64] = 0.020",
    premises: "each number is one reading of a clock with that tick, not a mean",
    source: "multiples of a rational (proofs::clock)",
    tests,
    relation: Some(FromRelation {
        keys: &[
            ("value", "The time, in quotes: the printed number, or the name of a cell."),
            ("tick", "The clock's step in the same unit, a decimal or a fraction in quotes: \"1/64\"."),
        ],
        build,
    }),
};

struct Clock {
    numbers: [Quoted; 1],
    tick: Exact,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    let is_meant = |column: &crate::table::Column| {
        column.meaning.kind == Kind::Value && column.meaning.grain.is_some() && column.meaning.n.is_none()
    };
    each_number(input, is_meant, &mut |_, column, _, number| {
        if let Some(tick) = column.meaning.grain {
            give(Box::new(Clock { numbers: [number], tick }));
        }
    });
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let tick = relation.exact("tick")?.filter(|tick| *tick > whole(0));
    let tick =
        tick.ok_or_else(|| relation.fault("`tick` is missing or not above 0; \"1/64\" is accepted"))?;
    Ok(Box::new(Clock { numbers: [relation.number("value", input)?], tick }))
}

impl Test for Clock {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let (first, last) = ticks(prints[0], self.tick)?;
        Some(first <= last)
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let printed = prints[0].printed;
        let (first, last) = ticks(prints[0], self.tick).unwrap_or((1, 0));
        let tick = self.tick;
        if is_possible {
            return format!("{first} ticks of {tick} print as {printed}");
        }
        let places = printed.decimals() as usize + 2;
        let at = |k: i128| multiple(tick, k, places);
        format!(
            "{printed} is not a multiple of {tick}; the nearest multiples are {} and {}",
            at(last),
            at(first)
        )
    }

    fn premises(&self) -> Vec<String> {
        vec![
            format!("the number is one value on a grain of {}, and no mean", self.tick),
            digits(&self.numbers),
        ]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let steps = json!([gap(&prints[0].span(), self.tick)?]);
        Some(Proof { given: json!({ "step": spelled(self.tick) }), steps })
    }
}
