//! Criteria of printed means: `mean_of`, and `table_means` for cells that share their instances.

use super::numbers::{never_firm, never_reproduced};
use super::scenario::{Bounds, Scenario, World};
use super::synthetic::{End, Made, Sample};
use super::theory::{normal, one_end_of_skewed};
use base::seed::Stream;
use rand::RngExt as _;

/// Instances of the paper.
const THEIRS: usize = 500;

/// How often an interval of 95 % misses.
const MISSES: f64 = 0.05;

/// Spread of the logarithm of a cost, and the skewness that follows.
const LOG_SPREAD: f64 = 0.6;
const SKEWNESS: f64 = 2.3;

pub fn scenarios() -> Vec<Scenario> {
    mean_of().into_iter().chain(table_means()).collect()
}

fn cost(stream: &mut Stream) -> f64 {
    50.0 * libm::exp(LOG_SPREAD * normal(stream))
}

/// The standard deviation of a cost.
fn deviation() -> f64 {
    let square = libm::exp(LOG_SPREAD * LOG_SPREAD);
    50.0 * (square * (square - 1.0)).sqrt()
}

const OF: &str =
    "select = { study = \"drawn\", problems = \"map\", contender = \"A\", metric = \"path_cost_cells\" }\n";

fn at_most(false_against: f64) -> Bounds {
    Bounds { false_against: Some(false_against), ..Bounds::default() }
}

/// A mean of their instances, `off` standard errors of it beyond what these gave, beside `ours` of the same distribution.
fn printed(
    truth: &'static str,
    (theirs, ours): (usize, usize),
    off: f64,
    made: Made,
    bounds: Bounds,
) -> Scenario {
    let is_censored = truth == "censored";
    let world = move |stream: &mut Stream| {
        let sum: f64 = (0..theirs).map(|_| cost(stream)).sum();
        let printed = sum / theirs as f64 + off * deviation() / (theirs as f64).sqrt();
        let mut sample = Sample::default();
        for index in 0..ours {
            sample.instance();
            let is_spent = is_censored && (index == 0 || stream.random_range(0..5) == 0);
            sample.trial("A", if is_spent { End::Spent } else { End::At(cost(stream)) });
        }
        World::new(sample.records(), off == 0.0 && !is_censored).printing(format!("{printed:.2}"))
    };
    let tail = if is_censored { "; A spends its budget on a fifth" } else { "" };
    let by = if off == 0.0 { String::new() } else { format!(", {off} standard errors off") };
    let about = format!(
        "a lognormal cost (skewness 2.3), printed as the mean of {theirs} other maps{by}; {ours} maps{tail}"
    );
    let claim = format!(
        "[[claim]]\nid = \"asked\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.mean_of]\n{OF}instances = {theirs}\n"
    );
    Scenario { criterion: "mean_of", truth, about, claim, made, world: Box::new(world), bounds }
}

fn mean_of() -> Vec<Scenario> {
    let right = |false_against: f64, least: f64| Bounds { right: Some(least), ..at_most(false_against) };
    let plain = Made::Plainly;
    // Both sides are resampled: each misses as a bootstrap of so few does.
    let few = 2.0 * one_end_of_skewed(20, SKEWNESS);
    vec![
        printed("true", (THEIRS, 500), 0.0, plain, right(MISSES, 0.9)),
        printed("true", (THEIRS, 2000), 0.0, plain, right(MISSES, 0.9)),
        printed("true", (20, 100), 0.0, plain, at_most(few)),
        printed("false", (THEIRS, 2000), 5.0, plain, right(MISSES, 0.95)),
        printed("false by a little", (THEIRS, 2000), 1.0, plain, at_most(0.0)),
        printed("underpowered", (THEIRS, 5), 0.0, plain, never_firm()),
        printed("fitted", (THEIRS, 500), 0.0, Made::Fitted, never_reproduced()),
        printed("searched", (THEIRS, 500), 0.0, Made::Searched, never_reproduced()),
        printed("censored", (THEIRS, 500), 0.0, plain, never_firm()),
    ]
}

/// Costs of A and B on a map of a group: they correlate at 0.99.
fn pair(stream: &mut Stream, scale: f64) -> [f64; 2] {
    let base = scale * cost(stream);
    [base, base + 0.1 * scale * deviation() * normal(stream)]
}

/// The means of A and B on two groups, each `off` standard errors from what their instances gave, B's the other way than A's.
fn printed_table(
    truth: &'static str,
    (theirs, ours): (usize, usize),
    off: f64,
    made: Made,
    bounds: Bounds,
) -> Scenario {
    let is_censored = truth == "censored";
    let world = move |stream: &mut Stream| {
        let mut printed = Vec::new();
        let mut sample = Sample::default();
        for (group, ids, scale) in [("map", ["a1", "b1"], 1.0), ("other", ["a2", "b2"], 3.0)] {
            let mut sums = [0.0; 2];
            for _ in 0..theirs {
                let [a, b] = pair(stream, scale);
                sums = [sums[0] + a, sums[1] + b];
            }
            let shift = off * scale * deviation() / (theirs as f64).sqrt();
            for ((id, sum), sign) in ids.into_iter().zip(sums).zip([1.0, -1.0]) {
                printed.push((id, format!("{:.2}", sum / theirs as f64 + sign * shift)));
            }
            for index in 0..ours {
                sample.instance_on(group);
                let [a, b] = pair(stream, scale);
                sample.trial("A", End::At(a));
                sample.trial("B", if is_censored && index == 0 { End::Spent } else { End::At(b) });
            }
        }
        World { printed, ..World::new(sample.records(), off == 0.0 && !is_censored) }
    };
    let cell = |id: &str, group: &str, contender: &str| {
        format!(
            "[[claim]]\nid = \"{id}\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.mean_of]\nselect = {{ study = \"drawn\", problems = \
             \"{group}\", contender = \"{contender}\", metric = \"path_cost_cells\" }}\ninstances = {theirs}\n"
        )
    };
    let cells = [("a1", "map", "A"), ("b1", "map", "B"), ("a2", "other", "A"), ("b2", "other", "B")];
    let cells: String = cells.iter().map(|(id, group, contender)| cell(id, group, contender)).collect();
    let claim = format!(
        "[[claim]]\nid = \"asked\"\nat = \"here\"\n[claim.check.table_means]\nin = [{{ study = \"drawn\", claims = [\"a1\", \"b1\", \"a2\", \
         \"b2\"] }}]\nrefused_below = 0.05\n{cells}"
    );
    let by = if off == 0.0 {
        String::new()
    } else {
        format!(", each {off} standard errors off against the other")
    };
    let tail = if is_censored { "; B spends its budget on one" } else { "" };
    let about = format!(
        "two rows of two cells that correlate at 0.99, printed from {theirs} other maps{by}; {ours} maps a row{tail}"
    );
    Scenario { criterion: "table_means", truth, about, claim, made, world: Box::new(world), bounds }
}

fn table_means() -> Vec<Scenario> {
    let right = |least: f64| Bounds { right: Some(least), ..at_most(MISSES) };
    let plain = Made::Plainly;
    vec![
        printed_table("true", (THEIRS, 500), 0.0, plain, right(0.9)),
        printed_table("true", (THEIRS, 2000), 0.0, plain, right(0.9)),
        printed_table("false", (THEIRS, 500), 0.5, plain, right(0.95)),
        printed_table("false by a little", (THEIRS, 500), 0.05, plain, Bounds::default()),
        printed_table("underpowered", (THEIRS, 20), 0.0, plain, never_firm()),
        printed_table("fitted", (THEIRS, 500), 0.0, Made::Fitted, never_reproduced()),
        printed_table("searched", (THEIRS, 500), 0.0, Made::Searched, never_reproduced()),
        printed_table("censored", (THEIRS, 500), 0.0, plain, never_firm()),
    ]
}
