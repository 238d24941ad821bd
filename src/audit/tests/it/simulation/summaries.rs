//! Tables whose last rows and column sum up the others, in one or two blocks.

use super::{Sheet, Style};
use proofs::exact::{Exact, whole};
use rand::{RngExt, rngs::SmallRng};

/// What a row sums up, and how.
#[derive(Clone, Copy, PartialEq)]
enum Row {
    /// Values of its own.
    Own,
    /// The mean of the rows since the last mean.
    Mean,
    /// The mean of all rows with values of their own.
    Overall,
}

/// Shares of one n, shares of the runs in a column, times, counts, and times of three maps with their mean.
pub(super) fn table(rng: &mut SmallRng) -> String {
    let mut kinds = Vec::new();
    let blocks = rng.random_range(1..=2);
    for _ in 0..blocks {
        kinds.extend(vec![Row::Own; rng.random_range(2..=5)]);
        kinds.push(Row::Mean);
    }
    if blocks == 2 {
        kinds.push(Row::Overall);
    }
    let mean_word =
        ["Average", "**Mean**", "Avg.", "average (all maps)", "Mean of runs"][rng.random_range(0..5)];
    let name = |row: &Row| match row {
        Row::Own => "A",
        Row::Mean => mean_word,
        Row::Overall => "Overall",
    };
    let mut sheet = Sheet { rows: kinds.len(), columns: Vec::new() };
    sheet.add("planner [label]".to_owned(), kinds.iter().map(|row| name(row).to_owned()).collect());

    let n: i128 = rng.random_range(2..60);
    let shares = own(&kinds, || Exact::new(100 * rng.random_range(0..=n), n));
    add(&mut sheet, rng, &format!("solved [% of {n}"), &summed(&kinds, &shares, &[]));

    let runs = own(&kinds, || whole(rng.random_range(1..40)));
    let pooled = rng.random_bool(0.5);
    let rates: Vec<Exact> =
        runs.iter().map(|runs| whole(rng.random_range(0..=runs.to_integer())) / *runs).collect();
    sheet.add("runs [value]".to_owned(), totals(&kinds, &runs).iter().map(ToString::to_string).collect());
    let weights = if pooled { runs.as_slice() } else { &[] };
    add(&mut sheet, rng, "rate [share of runs", &summed(&kinds, &rates, weights));

    let maps: Vec<Vec<Exact>> = (0..3)
        .map(|_| summed(&kinds, &own(&kinds, || Exact::new(rng.random_range(0..4000), 4)), &[]))
        .collect();
    let across = (0..kinds.len()).map(|row| maps.iter().fold(whole(0), |sum, map| sum + map[row]));
    let across: Vec<Exact> = across.collect();
    for (at, map) in maps.iter().enumerate() {
        add(&mut sheet, rng, &format!("map {at} [value, unit=s"), map);
    }
    if rng.random_bool(0.5) {
        let means: Vec<Exact> = across.iter().map(|sum| *sum / whole(3)).collect();
        add(&mut sheet, rng, "Average [value, unit=s", &means);
    } else {
        add(&mut sheet, rng, "Total (s) [value, unit=s", &across);
    }
    sheet.markdown()
}

fn add(sheet: &mut Sheet, rng: &mut SmallRng, header: &str, values: &[Exact]) {
    let style = Style::plain(rng);
    sheet.add(
        format!("{header}{}]", style.annotation()),
        values.iter().map(|value| style.value(*value)).collect(),
    );
}

/// A value for each row of its own, in order.
fn own(kinds: &[Row], mut value: impl FnMut() -> Exact) -> Vec<Exact> {
    kinds.iter().filter(|row| **row == Row::Own).map(|_| value()).collect()
}

/// Every row's value: the means of `values`, weighted if there are weights.
fn summed(kinds: &[Row], values: &[Exact], weights: &[Exact]) -> Vec<Exact> {
    let mean = |from: usize, to: usize| {
        let weight = |at: usize| weights.get(at).copied().unwrap_or(whole(1));
        let all = (from..to).fold(whole(0), |sum, at| sum + weight(at));
        (from..to).fold(whole(0), |sum, at| sum + weight(at) * values[at]) / all
    };
    each(kinds, values, mean)
}

/// Every row's value: the sums of `values`.
fn totals(kinds: &[Row], values: &[Exact]) -> Vec<Exact> {
    each(kinds, values, |from, to| (from..to).fold(whole(0), |sum, at| sum + values[at]))
}

fn each(kinds: &[Row], values: &[Exact], of: impl Fn(usize, usize) -> Exact) -> Vec<Exact> {
    let mut first = 0;
    let mut next = 0;
    let value = |row: &Row| match row {
        Row::Own => {
            next += 1;
            values[next - 1]
        }
        Row::Mean => of(std::mem::replace(&mut first, next), next),
        Row::Overall => of(0, next),
    };
    kinds.iter().map(value).collect()
}
