//! Tables with a row a planner: shares, statistics side by side, sums, quotients, lengths, ticks, expansions, bold.

use super::{Sheet, Style, Walk, moments, values};
use rand::{RngExt, rngs::SmallRng, seq::SliceRandom as _};

/// A table of one to three rows with some of the groups of columns that there are.
pub(super) fn table(rng: &mut SmallRng) -> String {
    let rows = rng.random_range(1..=3);
    let mut sheet = Sheet { rows, columns: Vec::new() };
    sheet.add("planner [label]".to_owned(), vec!["A".to_owned(); rows]);
    let groups = [shares, statistics, over_seeds, sums, lengths, counts, best, rising];
    for group in groups {
        if rng.random_bool(0.6) {
            group(rng, &mut sheet);
        }
    }
    if sheet.columns.len() == 1 {
        shares(rng, &mut sheet);
    }
    sheet.markdown()
}

fn shares(rng: &mut SmallRng, sheet: &mut Sheet) {
    let n: i128 = rng.random_range(1..300);
    let all: Vec<[i128; 2]> = (0..sheet.rows)
        .map(|_| {
            let k = rng.random_range(0..=n);
            [k, rng.random_range(0..=k)]
        })
        .collect();
    for (index, name) in ["solved", "late", "never"].into_iter().enumerate() {
        let style = Style::drawn(rng);
        let count = |[k, first]: &[i128; 2]| [*first, k - first, n - k][index];
        let cells = all.iter().map(|pair| style.ratio(100 * count(pair), n)).collect();
        sheet.add(format!("{name} [% of {n}, parts=all{}]", style.annotation()), cells);
    }
    let style = Style::drawn(rng);
    let counts = all.iter().map(|[k, _]| style.ratio(*k, 1)).collect();
    sheet.add(format!("hits [count of {n}{}]", style.annotation()), counts);
    let (word, divisor) =
        if rng.random_bool(0.5) && n > 1 { (", sample", n - 1) } else { (", population", n) };
    let word = if rng.random_bool(0.5) { word } else { "" };
    let style = Style::drawn(rng);
    let cell =
        |[k, _]: &[i128; 2]| format!("{} ± {}", style.ratio(*k, n), style.root(k * (n - k), n * divisor));
    sheet.add(
        format!("share [share of {n}, ±sd{word}{}]", style.annotation()),
        all.iter().map(cell).collect(),
    );
}

fn statistics(rng: &mut SmallRng, sheet: &mut Sheet) {
    let has_runs = rng.random_bool(0.5);
    let common: i128 = rng.random_range(2..60);
    let n: Vec<i128> =
        (0..sheet.rows).map(|_| if has_runs { rng.random_range(2..60) } else { common }).collect();
    let samples: Vec<Vec<i128>> = n.iter().map(|n| values(rng, *n)).collect();
    // Values are multiples of 1 / grain.
    let (message, grain) = [("integers", 1), ("tick=1/4", 4), ("tick=0.1", 10)][rng.random_range(0..3)];
    let mut of = format!("{message}, n={}", if has_runs { "runs".to_owned() } else { common.to_string() });
    if rng.random_bool(0.3) {
        let (least, most) =
            (samples.iter().flatten().min().unwrap(), samples.iter().flatten().max().unwrap());
        of += &format!(", least={least}/{grain}, most={}/{grain}", most + rng.random_range(0..3));
    }
    if has_runs {
        sheet.add("runs [value]".to_owned(), n.iter().map(ToString::to_string).collect());
    }
    means_and_deviations(rng, sheet, &samples, &of, grain);
    for (word, quarters) in [("min", 0), ("q25", 1), ("median", 2), ("q75", 3), ("max", 4)] {
        let style = Style::drawn(rng);
        let cell = |values: &Vec<i128>| {
            let place = (values.len() as i128 - 1) * quarters;
            let at = (place / 4) as usize;
            let rest = place % 4;
            let next = values[(at + 1).min(values.len() - 1)];
            style.ratio(4 * values[at] + rest * (next - values[at]), 4 * grain)
        };
        if rng.random_bool(0.7) {
            sheet.add(format!("x [{word}{}]", style.annotation()), samples.iter().map(cell).collect());
        }
    }
    let style = Style::drawn(rng);
    let totals = samples.iter().map(|values| style.ratio(values.iter().sum(), grain)).collect();
    sheet.add(format!("x [total{}]", style.annotation()), totals);
}

fn means_and_deviations(rng: &mut SmallRng, sheet: &mut Sheet, samples: &[Vec<i128>], of: &str, grain: i128) {
    let is_sample = rng.random_bool(0.5);
    let is_error = rng.random_bool(0.3);
    let word = if rng.random_bool(0.6) { [", population", ", sample"][usize::from(is_sample)] } else { "" };
    let spread = |style: &Style, values: &Vec<i128>| {
        let n = values.len() as i128;
        let divisor = n - i128::from(is_sample);
        style.root(moments(values).1, n * divisor * grain * grain * if is_error { n } else { 1 })
    };
    let mean =
        |style: &Style, values: &Vec<i128>| style.ratio(moments(values).0, values.len() as i128 * grain);
    let kind = if is_error { "se" } else { "sd" };
    let style = Style::drawn(rng);
    let header = format!("mean, {of}{word}, quantiles=linear{}", style.annotation());
    if rng.random_bool(0.5) {
        let cell = |values: &Vec<i128>| format!("{} ± {}", mean(&style, values), spread(&style, values));
        sheet.add(format!("x [{header}, ±{kind}]"), samples.iter().map(cell).collect());
        return;
    }
    sheet.add(format!("x [{header}]"), samples.iter().map(|values| mean(&style, values)).collect());
    let style = Style::drawn(rng);
    let spreads = samples.iter().map(|values| spread(&style, values)).collect();
    sheet.add(format!("x [{kind}{}]", style.annotation()), spreads);
}

fn over_seeds(rng: &mut SmallRng, sheet: &mut Sheet) {
    let style = Style::drawn(rng);
    let (seeds, trials): (i128, i128) = (rng.random_range(2..12), rng.random_range(1..60));
    let is_error = rng.random_bool(0.5);
    // The error's square is the deviation's over the number of seeds.
    let by = if is_error { seeds } else { 1 };
    let cells = (0..sheet.rows).map(|_| {
        let hits: Vec<i128> = (0..seeds).map(|_| rng.random_range(0..=trials)).collect();
        let (sum, about) = moments(&hits);
        let spread = style.root(10_000 * about, seeds * (seeds - 1) * trials * trials * by);
        format!("{} ± {spread}", style.ratio(100 * sum, seeds * trials))
    });
    let cells = cells.collect();
    let word = if is_error { "±se" } else { "±sd" };
    sheet.add(format!("rate [% of {trials}, seeds={seeds}, {word}, sample{}]", style.annotation()), cells);
}

fn sums(rng: &mut SmallRng, sheet: &mut Sheet) {
    let n: i128 = rng.random_range(1..60);
    let mut drawn = |least: i128| loop {
        let value = rng.random_range(least..5000);
        if value != 0 {
            break value;
        }
    };
    let all: Vec<[i128; 2]> = (0..sheet.rows).map(|_| [drawn(-5000), drawn(-5000)]).collect();
    let styles: Vec<Style> = (0..4).map(|_| Style::drawn(rng)).collect();
    let headers = ["a [value", "b [value", "both [value, sum=a+b", "times [value, ratio=a/b"];
    for (index, (header, style)) in headers.into_iter().zip(styles).enumerate() {
        let cell = |[a, b]: &[i128; 2]| {
            let (above, below) = [(*a, n), (*b, n), (a + b, n), (a * b.signum(), b.abs())][index];
            style.ratio(above, below)
        };
        sheet.add(format!("{header}{}]", style.annotation()), all.iter().map(cell).collect());
    }
}

/// Walks over one displacement: the moves of the first in other orders.
fn lengths(rng: &mut SmallRng, sheet: &mut Sheet) {
    let mut walk = Walk::drawn(rng, 9);
    let [dx, dy] = walk.end();
    let style = Style::drawn(rng);
    let turned = Style::drawn(rng);
    let step = [1, 2][rng.random_range(0..2)];
    let is_interior = rng.random_bool(0.5);
    let mut lengths = Vec::new();
    let mut turns = Vec::new();
    let mut short = Vec::new();
    for _ in 0..sheet.rows {
        walk.moves.shuffle(rng);
        lengths.push(walk.length(&style));
        turns.push(turned.ratio(walk.turns(is_interior), 1));
        short.push(turned.ratio(10 * walk.straight() + 14 * walk.diagonal(), 10 * step));
    }
    sheet.add(format!("length [a+b√2, from=0:0, to={dx}:{dy}, turns=turn{}]", style.annotation()), lengths);
    sheet.add(format!("turn [value{}]", turned.annotation()), turns);
    let ends = if step == 1 { format!(", from=0:0, to={dx}:{dy}") } else { String::new() };
    sheet.add(format!("short [a+b1.4, step=1/{step}{ends}{}]", turned.annotation()), short);
}

/// Readings of a clock, and expansions.
fn counts(rng: &mut SmallRng, sheet: &mut Sheet) {
    let (tick, above, below) = [("1/64", 1, 64), ("0.01", 1, 100), ("3/7", 3, 7)][rng.random_range(0..3)];
    let style = Style::drawn(rng);
    let ticks: Vec<i128> = (0..sheet.rows).map(|_| rng.random_range(-200..2000)).collect();
    let cells = ticks.iter().map(|ticks| style.ratio(ticks * above, below)).collect();
    sheet.add(format!("time [tick={tick}{}]", style.annotation()), cells);
    let free: i128 = rng.random_range(1..1000);
    let style = Style::drawn(rng);
    let expanded = (0..sheet.rows).map(|_| style.ratio(rng.random_range(0..=3 * free), 3)).collect();
    let kind = ["value", "mean", "max", "median"][rng.random_range(0..4)];
    sheet.add(format!("expanded [{kind}, free={free}{}]", style.annotation()), expanded);
}

/// The best is bold, by the true values, as printed ones may be alike.
fn best(rng: &mut SmallRng, sheet: &mut Sheet) {
    let style = Style::drawn(rng);
    let is_lower = rng.random_bool(0.5);
    let values: Vec<i128> = (0..sheet.rows).map(|_| rng.random_range(-300..300)).collect();
    let best = if is_lower { values.iter().min() } else { values.iter().max() }.unwrap();
    let cell = |value: &i128| {
        let text = style.ratio(*value, 7);
        if value == best { format!("**{text}**") } else { text }
    };
    let better = if is_lower { "lower" } else { "higher" };
    sheet.add(
        format!("cost [value, {better} is better{}]", style.annotation()),
        values.iter().map(cell).collect(),
    );
}

/// What is solved with fewer samples is solved with more.
fn rising(rng: &mut SmallRng, sheet: &mut Sheet) {
    let style = Style::drawn(rng);
    let n = rng.random_range(1..100);
    let mut solved: Vec<i128> = (0..sheet.rows).map(|_| rng.random_range(0..=n)).collect();
    solved.sort_unstable();
    let samples = (1..=sheet.rows).map(|row| (100 * row).to_string()).collect();
    sheet.add("samples [samples]".to_owned(), samples);
    let cells = solved.iter().map(|solved| style.ratio(100 * solved, n)).collect();
    sheet.add(format!("success [% of {n}, anytime{}]", style.annotation()), cells);
}
