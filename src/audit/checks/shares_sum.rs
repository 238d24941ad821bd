//! Whether the shares of one whole sum to one.

use super::arguments::{count, digits, json_span, shown_span, spans};
use super::{Entry, FromRelation, Proof, Test, Window};
use crate::input::{Input, Relation};
use crate::meaning::{Count, Kind};
use crate::table::{Fault, Quoted, Table, quoted};
use proofs::exact::{Exact, Print, Span, div, spelled, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "shares_sum",
    about: "do the shares of one whole sum to one, as far as digits tell?",
    example: "parts 50.1 %, 30.2 %, 20.3 % of one whole",
    premises: "the parts are all there are, and none overlaps another",
    source: "interval arithmetic; with n, sums of whole counts",
    tests,
    relation: Some(FromRelation {
        keys: &[
            ("parts", "The printed shares, each in quotes or the name of a cell."),
            ("whole", "What they are shares of: 100 for per cent, which holds if absent, or 1."),
            ("n", "How many trials the shares are of, a whole number; any if absent."),
        ],
        build,
    }),
};

struct SharesSum {
    numbers: Vec<Quoted>,
    all: Exact,
    n: Option<u64>,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    for (index, table) in input.tables.iter().enumerate() {
        let mut names: Vec<&str> =
            table.columns.iter().filter_map(|column| column.meaning.parts.as_deref()).collect();
        names.sort_unstable();
        names.dedup();
        for name in names {
            let of = |at: &usize| table.columns[*at].meaning.parts.as_deref() == Some(name);
            let columns: Vec<usize> = (0..table.columns.len()).filter(of).collect();
            in_table(index, table, &columns, give);
        }
    }
}

fn in_table(index: usize, table: &Table, columns: &[usize], give: &mut dyn FnMut(Box<dyn Test>)) {
    let meaning = &table.columns[columns[0]].meaning;
    let all = whole(if meaning.kind == (Kind::Share { whole: 1 }) { 1 } else { 100 });
    let n = match meaning.n {
        Some(Count::Number(n)) => Some(n),
        _ => None,
    };
    // Where a part is not printed, the others sum to nothing known.
    let mut give = |cells: Option<Vec<Quoted>>| {
        if let Some(numbers) = cells.filter(|cells| cells.len() > 1) {
            give(Box::new(SharesSum { numbers, all, n }));
        }
    };
    let rows = 0..table.rows.len();
    if columns.len() == 1 {
        give(rows.map(|row| quoted(index, table, row, columns[0])).collect());
    } else {
        rows.for_each(|row| give(columns.iter().map(|at| quoted(index, table, row, *at)).collect()));
    }
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let all = relation.exact("whole")?.unwrap_or(whole(100));
    if all <= whole(0) {
        return Err(relation.fault("`whole` must be above 0"));
    }
    Ok(Box::new(SharesSum { numbers: relation.numbers("parts", input)?, all, n: relation.natural("n")? }))
}

impl SharesSum {
    fn sum(prints: &[Print]) -> Option<Span> {
        spans(prints).iter().try_fold(Span::point(whole(0)), |sum, span| sum.plus(span))
    }

    /// For each part the counts that print it; none without n.
    fn counts(&self, prints: &[Print]) -> Option<Vec<(i128, i128)>> {
        let factor = div(count(self.n?), self.all)?;
        prints.iter().map(|print| Some(print.span().times(factor)?.integers())).collect()
    }
}

impl Test for SharesSum {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        if !Self::sum(prints)?.contains(self.all) {
            return Some(false);
        }
        let Some(n) = self.n else { return Some(true) };
        let counts = self.counts(prints)?;
        let (low, high) = counts.iter().fold((0, 0), |(low, high), (first, last)| (low + first, high + last));
        let is_each = counts.iter().all(|(first, last)| first <= last);
        Some(is_each && low <= i128::from(n) && i128::from(n) <= high)
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let sum = Self::sum(prints).map_or("?".to_owned(), |sum| shown_span(&sum, 6));
        let n = self.n.map_or(String::new(), |n| format!(" as counts of {n}"));
        let verb = if is_possible { "can sum" } else { "cannot sum" };
        format!("{} parts {verb} to {}{n}: their digits allow {sum}", prints.len(), self.all)
    }

    fn premises(&self) -> Vec<String> {
        vec!["the parts are all there are, and none overlaps another".to_owned(), digits(&self.numbers)]
    }

    fn window(&self) -> Option<Window> {
        Some(Window { ends: [whole(0), self.all], why: "from nothing to the whole" })
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let given = |n: Option<u64>| json!({ "whole": spelled(self.all), "n": n.map(|n| n.to_string()) });
        let sum = Self::sum(prints)?;
        if !sum.contains(self.all) {
            let steps = json!([{ "sum": json_span(&sum), "misses": spelled(self.all) }]);
            return Some(Proof { given: given(None), steps });
        }
        let ends = |(first, last): (i128, i128)| json!([first.to_string(), last.to_string()]);
        let counts: Vec<_> = self.counts(prints)?.into_iter().map(ends).collect();
        let of = [self.n.map(|n| n.to_string()), Some(spelled(self.all))];
        Some(Proof { given: given(self.n), steps: json!([{ "counts": counts, "of": of }]) })
    }
}
