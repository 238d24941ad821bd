//! Whether success rises with the number of samples.

use super::arguments::digits;
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::meaning::Kind;
use crate::table::{Fault, Quoted, Table, quoted};
use proofs::exact::Print;
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "rises",
    about: "does success never fall as samples grow?",
    example: "100 samples: 90.0 %; 200 samples: 88.0 %",
    premises: "a proof only if the larger sample contains the smaller (anytime); otherwise chance can do it, and it is a signal",
    source: "set inclusion",
    tests,
    relation: Some(FromRelation {
        keys: &[
            ("values", "The printed numbers, each in quotes or the name of a cell, by rising budget."),
            ("anytime", "Whether one run was looked at as it went on, `yes`; `no` if absent."),
        ],
        build,
    }),
};

struct Rises {
    /// The value at more samples, then the one at fewer.
    numbers: [Quoted; 2],
    is_anytime: bool,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    for (index, table) in input.tables.iter().enumerate() {
        let samples = table.columns.iter().position(|column| column.meaning.kind == Kind::Samples);
        let Some(samples) = samples else { continue };
        for at in 0..table.columns.len() {
            if let Some(is_anytime) = table.columns[at].meaning.rises {
                in_column(index, table, [samples, at], is_anytime, give);
            }
        }
    }
}

fn in_column(
    index: usize,
    table: &Table,
    [samples, at]: [usize; 2],
    is_anytime: bool,
    give: &mut dyn FnMut(Box<dyn Test>),
) {
    let rows = (0..table.rows.len()).filter_map(|row| {
        let count = table.print(row, samples)?.value();
        let labels = (0..table.columns.len()).filter(|at| table.columns[*at].meaning.kind == Kind::Skip);
        let name: Vec<&str> = labels.map(|at| table.rows[row][at].text.as_str()).collect();
        Some((name, count, quoted(index, table, row, at)?))
    });
    let mut rows: Vec<_> = rows.collect();
    rows.sort_by(|a, b| (&a.0, a.1).cmp(&(&b.0, b.1)));
    let value = |row: &(_, _, Quoted)| row.2.print.value();
    for same in rows.chunk_by(|a, b| a.0 == b.0) {
        // The greatest value with fewer samples: a slow fall shows against it, not against the row before.
        let mut greatest = None;
        for level in same.chunk_by(|a, b| a.1 == b.1) {
            for (more, fewer) in level.iter().zip(std::iter::repeat(greatest)) {
                let Some(fewer): Option<&(_, _, Quoted)> = fewer else { break };
                give(Box::new(Rises { numbers: [more.2.clone(), fewer.2.clone()], is_anytime }));
            }
            greatest = greatest.into_iter().chain(level).max_by(|a, b| value(a).cmp(&value(b)));
        }
    }
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let values = relation.numbers("values", input)?;
    let is_anytime = relation.word("anytime", &["no", "yes"])? == "yes";
    // One relation is one test; the steepest fall is the one to ask about.
    let pairs = (0..values.len()).flat_map(|fewer| (fewer + 1..values.len()).map(move |more| [more, fewer]));
    let fall = |[more, fewer]: &[usize; 2]| values[*fewer].print.value() - values[*more].print.value();
    let steepest = pairs.max_by(|a, b| fall(a).cmp(&fall(b)));
    let pair =
        steepest.ok_or_else(|| relation.fault("`values` needs two numbers or more, by rising samples"))?;
    Ok(Box::new(Rises { numbers: pair.map(|at| values[at].clone()), is_anytime }))
}

impl Test for Rises {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(prints[1].span().low <= prints[0].span().high)
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let verb = if is_possible { "does not fall" } else { "falls" };
        format!("success {verb} from {} to {} as samples grow", prints[1].printed, prints[0].printed)
    }

    fn premises(&self) -> Vec<String> {
        let premise = if self.is_anytime {
            "what is solved with fewer samples is solved with more"
        } else {
            "success is expected to rise with samples; different draws may still let it fall"
        };
        vec![premise.to_owned(), digits(&self.numbers)]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let more = prints[0].span();
        let fewer = prints[1].span();
        let steps =
            json!([{ "fewer_at_least": fewer.low.to_string(), "more_at_most": more.high.to_string() }]);
        self.is_anytime.then(|| Proof { given: json!({}), steps })
    }
}
