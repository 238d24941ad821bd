//! Tables printed from simulated data, each by one rounding, in exact integers throughout.

use rand::{RngExt, SeedableRng, rngs::SmallRng};

/// Every way to end digits that a program can have.
pub(super) const ROUNDINGS: [&str; 5] = ["half up", "half even", "floor", "ceiling", "truncation"];

/// A source of data and the rounding that prints them.
struct Printer {
    rng: SmallRng,
    rounding: &'static str,
    decimals: u32,
}

impl Printer {
    fn new(seed: u64) -> Self {
        let mut rng = SmallRng::seed_from_u64(seed);
        let rounding = ROUNDINGS[rng.random_range(0..5)];
        let decimals = rng.random_range(0..4);
        Self { rng, rounding, decimals }
    }

    /// `above / below`, which is not negative, as it is printed.
    fn ratio(&self, above: i128, below: i128) -> String {
        let scaled = above * 10_i128.pow(self.decimals);
        let (down, rest) = (scaled.div_euclid(below), scaled.rem_euclid(below));
        let tie = (2 * rest).cmp(&below);
        self.units(down, rest > 0, tie)
    }

    /// The root of `above / below` as it is printed.
    fn root(&self, above: i128, below: i128) -> String {
        let scale = 10_i128.pow(2 * self.decimals);
        let down = (above * scale / below).isqrt();
        let middle = (2 * down + 1) * (2 * down + 1) * below;
        self.units(down, down * down * below < above * scale, (4 * above * scale).cmp(&middle))
    }

    /// The printed number next to `down` units; `has_rest` if the value is above them, `tie` how it compares with the middle.
    fn units(&self, down: i128, has_rest: bool, tie: std::cmp::Ordering) -> String {
        let is_up = match self.rounding {
            "half up" => tie.is_ge(),
            "half even" => tie.is_gt() || tie.is_eq() && down % 2 == 1,
            "ceiling" => has_rest,
            _ => false,
        };
        let units = i64::try_from(down + i128::from(is_up)).unwrap();
        crate::printed::Printed::from_units(units, self.decimals).to_string()
    }

    /// `, rounding=…` in half of the tables.
    fn said(&mut self) -> String {
        if self.rng.random_bool(0.5) { format!(", rounding={}", self.rounding) } else { String::new() }
    }

    /// `n` whole numbers, sometimes all alike, sometimes spread out.
    fn values(&mut self, n: i128) -> Vec<i128> {
        let most = [0, 1, 3, 20, 1000][self.rng.random_range(0..5)];
        let mut values: Vec<i128> = (0..n).map(|_| self.rng.random_range(0..=most)).collect();
        values.sort_unstable();
        values
    }
}

/// Sum and n times the sum of squared deviations.
fn moments(values: &[i128]) -> (i128, i128) {
    let (n, sum) = (values.len() as i128, values.iter().sum::<i128>());
    (sum, n * values.iter().map(|x| x * x).sum::<i128>() - sum * sum)
}

/// A table of shares, statistics of whole numbers, sums and quotients, and lengths on a lattice.
pub(super) fn table(seed: u64) -> String {
    let mut printer = Printer::new(seed);
    let mut columns: Vec<(String, String)> = vec![("planner [label]".to_owned(), "A".to_owned())];
    shares(&mut printer, &mut columns);
    statistics(&mut printer, &mut columns);
    over_seeds(&mut printer, &mut columns);
    sums(&mut printer, &mut columns);
    length(&mut printer, &mut columns);
    let line = |cells: Vec<&str>| format!("| {} |\n", cells.join(" | "));
    let header = line(columns.iter().map(|(header, _)| header.as_str()).collect());
    let cells = line(columns.iter().map(|(_, cell)| cell.as_str()).collect());
    format!("{header}{}\n{cells}", "|-".repeat(columns.len()) + "|")
}

fn shares(printer: &mut Printer, columns: &mut Vec<(String, String)>) {
    let said = printer.said();
    let n: i128 = printer.rng.random_range(1..300);
    let k = printer.rng.random_range(0..=n);
    let first = printer.rng.random_range(0..=k);
    for (name, count) in [("solved", first), ("late", k - first), ("never", n - k)] {
        columns.push((format!("{name} [% of {n}, parts=all{said}]"), printer.ratio(100 * count, n)));
    }
    let deviation = if n > 1 { printer.root(k * (n - k), n * (n - 1)) } else { "0".to_owned() };
    columns.push((
        format!("share [share of {n}, ±sd, sample{said}]"),
        format!("{} ± {deviation}", printer.ratio(k, n)),
    ));
}

fn statistics(printer: &mut Printer, columns: &mut Vec<(String, String)>) {
    let said = printer.said();
    let n: i128 = printer.rng.random_range(2..60);
    let values = printer.values(n);
    let (sum, about) = moments(&values);
    let (name, divisor) = if printer.rng.random_bool(0.5) { ("sample", n - 1) } else { ("population", n) };
    let quantile = |printer: &Printer, quarters: i128| {
        let place = (n - 1) * quarters;
        let (at, rest) = ((place / 4) as usize, place % 4);
        let next = values[(at + 1).min(values.len() - 1)];
        printer.ratio(4 * values[at] + rest * (next - values[at]), 4)
    };
    let mean = format!("x [mean, integers, n={n}, {name}, quantiles=linear{said}]");
    columns.push((mean, printer.ratio(sum, n)));
    columns.push((format!("x [sd, n={n}{said}]"), printer.root(about, n * divisor)));
    for (word, quarters) in [("min", 0), ("q25", 1), ("median", 2), ("q75", 3), ("max", 4)] {
        columns.push((format!("x [{word}{said}]"), quantile(printer, quarters)));
    }
    columns.push((format!("x [total{said}]"), printer.ratio(sum, 1)));
}

fn over_seeds(printer: &mut Printer, columns: &mut Vec<(String, String)>) {
    let said = printer.said();
    let (seeds, trials): (i128, i128) = (printer.rng.random_range(2..12), printer.rng.random_range(1..60));
    let hits: Vec<i128> = (0..seeds).map(|_| printer.rng.random_range(0..=trials)).collect();
    let (sum, about) = moments(&hits);
    let mean = printer.ratio(100 * sum, seeds * trials);
    let is_error = printer.rng.random_bool(0.5);
    // The error's square is the deviation's over the number of seeds.
    let by = if is_error { seeds } else { 1 };
    let spread = printer.root(10_000 * about, seeds * (seeds - 1) * trials * trials * by);
    let word = if is_error { "±se" } else { "±sd" };
    columns.push((
        format!("rate [% of {trials}, seeds={seeds}, {word}, sample{said}]"),
        format!("{mean} ± {spread}"),
    ));
}

fn sums(printer: &mut Printer, columns: &mut Vec<(String, String)>) {
    let said = printer.said();
    let n: i128 = printer.rng.random_range(1..60);
    let [a, b]: [i128; 2] = [0; 2].map(|_| printer.rng.random_range(1..5000));
    for (header, above, below) in [
        (format!("a [value{said}]"), a, n),
        (format!("b [value{said}]"), b, n),
        (format!("both [value, sum=a+b{said}]"), a + b, n),
        (format!("times [value, ratio=a/b{said}]"), a, b),
    ] {
        columns.push((header, printer.ratio(above, below)));
    }
}

fn length(printer: &mut Printer, columns: &mut Vec<(String, String)>) {
    let said = printer.said();
    let mut at = [0_i128; 2];
    let (mut straight, mut diagonal) = (0, 0);
    for _ in 0..printer.rng.random_range(1..25) {
        let step = [printer.rng.random_range(-1..=1), printer.rng.random_range(-1..=1)];
        if step == [0, 0] {
            continue;
        }
        at = [at[0] + step[0], at[1] + step[1]];
        *(if step.contains(&0) { &mut straight } else { &mut diagonal }) += 1;
    }
    let scale = 10_i128.pow(printer.decimals);
    let root = 2 * diagonal * diagonal * scale * scale;
    let down = straight * scale + root.isqrt();
    // The length is whole or irrational, so that it never lies in the middle.
    let doubled = 2 * straight * scale + (4 * root).isqrt();
    let tie = if doubled > 2 * down { std::cmp::Ordering::Greater } else { std::cmp::Ordering::Less };
    let cell = printer.units(down, diagonal > 0, tie);
    columns.push((format!("length [a+b√2, from=0:0, to={}:{}{said}]", at[0], at[1]), cell));
}
