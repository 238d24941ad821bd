//! Premises and words that several checks share.

use super::{Test, Window};
use crate::input::Input;
use crate::sample::Sample;
use crate::table::{Column, Quoted, Table, quoted};
use proofs::exact::{Exact, Print, Span, decimal, mul, root_above, spelled, sub, whole};
use proofs::printed::Digits;
use serde_json::{Value, json};

/// How the digits are read, as a premise: of each number, where they are not read alike.
pub fn digits(numbers: &[Quoted]) -> String {
    let way = |number: &Quoted| match number.print.digits {
        Digits::Any => "in any usual way: rounded, cut off, up or down".to_owned(),
        other => format!("by {}", other.name()),
    };
    let mut ways: Vec<(String, &str)> = Vec::new();
    for number in numbers {
        if ways.iter().all(|(known, _)| *known != way(number)) {
            ways.push((way(number), &number.name));
        }
    }
    let mut text = match ways.as_slice() {
        [] => String::new(),
        [(way, _)] => format!("digits end {way}"),
        several => {
            let of = several.iter().map(|(way, name)| format!("those of {name} end {way}"));
            format!("digits of numbers end in different ways: {}", of.collect::<Vec<_>>().join("; "))
        }
    };
    let widened = numbers
        .iter()
        .map(|number| number.print.printed)
        .find(|printed| printed.as_typed().decimals() < printed.decimals());
    if let Some((printed, digits)) = widened.and_then(|printed| Some((printed, printed.significant()?))) {
        let full = printed.as_read();
        text += &format!(
            "; {digits} digits count and zeros at the end are left out, so that {printed} is read as {full}"
        );
    }
    text
}

/// Gives every number in columns that `is_meant` picks.
pub fn each_number(
    input: &Input,
    is_meant: impl Fn(&Column) -> bool,
    give: &mut dyn FnMut(&Table, &Column, usize, Quoted),
) {
    // Where rows are statistics, a cell is none of the values.
    let of_values = input.tables.iter().enumerate().filter(|(_, table)| table.statistics().is_none());
    for (index, table) in of_values {
        for (at, column) in table.columns.iter().enumerate().filter(|(_, column)| is_meant(column)) {
            for row in 0..table.rows.len() {
                if let Some(number) = quoted(index, table, row, at) {
                    give(table, column, row, number);
                }
            }
        }
    }
}

/// Gives the tests that `of_sample` makes of samples.
pub fn each_of_sample<T: Test + 'static>(
    input: &Input,
    of_sample: impl Fn(&Sample) -> Option<T>,
    give: &mut dyn FnMut(Box<dyn Test>),
) {
    input.each_sample(&mut |sample| {
        if let Some(test) = of_sample(sample) {
            give(Box::new(test));
        }
    });
}

/// Gives the tests that `of_cell` makes of cells, by number of the table, row and column.
pub fn each_of_cell<T: Test + 'static>(
    input: &Input,
    of_cell: impl Fn(usize, &Table, usize, usize) -> Option<T>,
    give: &mut dyn FnMut(Box<dyn Test>),
) {
    for (index, table) in input.tables.iter().enumerate() {
        for column in 0..table.columns.len() {
            let tests = (0..table.rows.len()).filter_map(|row| of_cell(index, table, row, column));
            tests.for_each(|test| give(Box::new(test)));
        }
    }
}

/// A value for people: as a whole number, or with up to `decimals` decimals and no zeros at the end.
pub fn shown(value: Exact, decimals: usize) -> String {
    let text = decimal(value, decimals);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A span for people.
pub fn shown_span(span: &Span, decimals: usize) -> String {
    format!("{} to {}", shown(span.low, decimals), shown(span.high, decimals))
}

/// The multiples of `step` on either side of a span that holds none, as a step of a proof; the one fact is that nothing
/// stands between them.
pub fn gap(span: &Span, step: Exact) -> Option<Value> {
    let (above, below) = span.times(step.recip())?.integers();
    Some(json!({ "step": spelled(step), "below": below.to_string(), "above": above.to_string() }))
}

/// A count of units as an exact number.
pub fn count(n: u64) -> Exact {
    whole(n)
}

/// The prints' spans.
pub fn spans(prints: &[Print]) -> Vec<Span> {
    prints.iter().map(|print| print.span()).collect()
}

/// `k` times a step, for people.
pub fn multiple(step: Exact, k: i128, decimals: usize) -> String {
    mul(step, whole(k)).map_or_else(|| "too long a number".to_owned(), |value| shown(value, decimals))
}

/// From 0 to twice what is printed, and 100 units of the last place at least.
pub fn up_to_twice(print: Print) -> Option<Window> {
    let least = Exact::new(100, i128::from(print.printed.scale()));
    let twice = mul(whole(2), print.value())?;
    let why = if twice < least {
        "100 units of the last place, since nothing bounds it"
    } else {
        "up to twice what is printed, since nothing bounds it"
    };
    Some(Window { ends: [whole(0), twice.max(least)], why })
}

/// From 0 to the greatest deviation of values between `ends`, whatever their mean (Popoviciu 1935). That is the root of
/// `factor` times the square of half the range, with n / (n − 1) for a sample's deviation and 1 for a population's.
pub fn spreads(print: Print, ends: [Exact; 2], factor: Exact) -> Option<Window> {
    let half = sub(ends[1], ends[0])? / whole(2);
    let ends = [whole(0), root_above(mul(mul(half, half)?, factor)?, print.printed.scale())?];
    Some(Window { ends, why: "up to the greatest that values between the ends have" })
}

/// A span as `["[", "1/2", "3/4", ")"]`: a bracket for an end that is a member, a parenthesis for one that is not.
pub fn json_span(span: &Span) -> Value {
    json!([
        if span.low_closed { "[" } else { "(" },
        spelled(span.low),
        spelled(span.high),
        if span.high_closed { "]" } else { ")" },
    ])
}
