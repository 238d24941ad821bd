//! Tables with a row a statistic, as pandas describes its columns, of one or two planners.

use super::{Sheet, Style, moments, quantile, values};
use proofs::exact::{Exact, whole};
use rand::{RngExt, rngs::SmallRng};

const ROWS: [&str; 9] = ["mean", "std", "min", "25%", "50%", "75%", "95%", "max", "total"];

/// Two columns of whole numbers, their sum, and their quotient where the second is above 0.
pub(super) fn table(rng: &mut SmallRng) -> String {
    let planners = rng.random_range(1..=2);
    let n: i128 = rng.random_range(2..50);
    let rule = rng.random_range(1..=9);
    let divisor = n - i128::from(rng.random_bool(0.5));
    let mut sheet = Sheet { rows: planners * ROWS.len(), columns: Vec::new() };
    let names = (0..sheet.rows).map(|row| format!("p{}", row / ROWS.len())).collect();
    sheet.add("planner [label]".to_owned(), names);
    let statistics = (0..sheet.rows).map(|row| ROWS[row % ROWS.len()].to_owned()).collect();
    sheet.add("[statistic]".to_owned(), statistics);
    let has_ratio = rng.random_bool(0.6);
    let pairs: Vec<[Vec<i128>; 2]> =
        (0..planners).map(|_| [(); 2].map(|()| drawn(rng, n, has_ratio))).collect();
    let columns = ["a [integers", "b [integers", "both [integers, sum=a+b"];
    for (index, header) in columns.into_iter().enumerate() {
        let style = Style::drawn(rng);
        let of = |[a, b]: &[Vec<i128>; 2]| -> Vec<i128> {
            (0..a.len()).map(|at| [a[at], b[at], a[at] + b[at]][index]).collect()
        };
        let cells = pairs.iter().flat_map(|pair| described(&of(pair), &style, rule, divisor)).collect();
        sheet.add(format!("{header}, n={n}{}{}]", linear(rule), style.annotation()), cells);
    }
    if has_ratio {
        let style = Style::drawn(rng);
        let cells = pairs.iter().flat_map(|pair| quotients(pair, &style, rule)).collect();
        sheet.add(format!("r [n={n}, ratio=a/b{}]", style.annotation()), cells);
    }
    format!("# t\n\n{}", sheet.markdown())
}

/// Values in the order of problems; above 0 if they are to be divided by.
fn drawn(rng: &mut SmallRng, n: i128, are_positive: bool) -> Vec<i128> {
    let mut all = values(rng, n);
    if are_positive {
        for value in &mut all {
            *value = value.abs() + 1;
        }
    }
    for at in (1..all.len()).rev() {
        all.swap(at, rng.random_range(0..=at));
    }
    all
}

fn linear(rule: usize) -> &'static str {
    if rule == 7 { ", quantiles=linear" } else { "" }
}

/// The quantiles among the rows, the others by `more`.
fn rows(values: &[Exact], rule: usize, style: &Style, more: impl Fn(&str) -> String) -> Vec<String> {
    let row = |name: &&str| match *name {
        "min" => style.value(values[0]),
        "max" => style.value(values[values.len() - 1]),
        other => match other.strip_suffix('%') {
            Some(share) => style.value(quantile(values, Exact::new(share.parse().unwrap(), 100), rule)),
            None => more(other),
        },
    };
    ROWS.iter().map(row).collect()
}

fn described(values: &[i128], style: &Style, rule: usize, divisor: i128) -> Vec<String> {
    let n = values.len() as i128;
    let (sum, about) = moments(values);
    let mut rising: Vec<Exact> = values.iter().map(|value| whole(*value)).collect();
    rising.sort_unstable();
    rows(&rising, rule, style, |name| match name {
        "mean" => style.ratio(sum, n),
        "std" => style.root(about, n * divisor),
        _ => style.ratio(sum, 1),
    })
}

/// Quantiles of a / b; their mean has too long a denominator.
fn quotients([a, b]: &[Vec<i128>; 2], style: &Style, rule: usize) -> Vec<String> {
    let mut all: Vec<Exact> = a.iter().zip(b).map(|(a, b)| Exact::new(*a, *b)).collect();
    all.sort_unstable();
    rows(&all, rule, style, |_| "-".to_owned())
}
