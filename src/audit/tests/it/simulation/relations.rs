//! Relations and samples in TOML whose numbers hold.

use super::{Style, Walk, moments, quantile, values};
use proofs::exact::{Exact, whole};
use proofs::turns::{Convention, turn_sum_deg};
use rand::{RngExt, rngs::SmallRng};
use stats::interval::Interval;
use stats::proportion::{clopper_pearson, wilson};

/// Some relations and samples.
pub(super) fn document(rng: &mut SmallRng) -> String {
    let kinds = [
        sample, cells, cut_sum, total, parts, walk, straight, interval, p_value, grim, grimmer, ticks, rising,
    ];
    // Few, since each is a search; with one decimal it takes a hundred times as long.
    let mut text = if rng.random_bool(0.06) { any_angle_turns(rng) } else { String::new() };
    while text.is_empty() {
        for kind in kinds {
            if rng.random_bool(0.5) {
                text += &kind(rng);
            }
        }
    }
    text
}

/// A relation with its rounding, if that is written; the keys follow.
fn relation(check: &str, style: &Style, keys: &str) -> String {
    let rounding =
        if style.is_written { format!("rounding = \"{}\"\n", style.rounding) } else { String::new() };
    format!("[[relation]]\ncheck = \"{check}\"\n{rounding}{keys}\n")
}

fn sample(rng: &mut SmallRng) -> String {
    let style = Style::drawn(rng);
    let n = rng.random_range(1..40);
    let values = values(rng, n);
    let rule = rng.random_range(1..=9);
    let exact: Vec<Exact> = values.iter().map(|value| whole(*value)).collect();
    let (sum, about) = moments(&values);
    let mut text = format!("[[sample]]\nname = \"s\"\nis = \"integers, n={n}{}\"\n", style.annotation());
    text += &format!("mean = \"{}\"\nmin = \"{}\"\n", style.ratio(sum, n), style.value(exact[0]));
    if n > 1 {
        text += &format!("sd = \"{}\"\n", style.root(about, n * (n - 1)));
    }
    text += &format!("q25 = \"{}\"\n", style.value(quantile(&exact, Exact::new(1, 4), rule)));
    text + &format!("max = \"{}\"\n", style.value(exact[exact.len() - 1]))
}

/// A quotient, a reduction and a speed-up of two cells.
fn cells(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let drawn = |rng: &mut SmallRng, least: i128| rng.random_range(least..4000);
    let (a, b) = (drawn(rng, -500), drawn(rng, 1));
    let [first, second, third] = [(); 3].map(|()| plain.other(rng));
    let mut text = relation(
        "ratio",
        &plain,
        &format!(
            "value = \"{}\"\nof = \"{}\"\nover = \"{}\"",
            first.ratio(a, b),
            second.ratio(a, 9),
            third.ratio(b, 9)
        ),
    );
    let (from, to) = (drawn(rng, 1), drawn(rng, 1));
    let pair = [second.ratio(from, 9), third.ratio(to, 9)];
    let (base, below) = [("from", from), ("to", to), ("either", to)][rng.random_range(0..3)];
    let keys = format!(
        "percent = \"{}\"\nfrom = \"{}\"\nto = \"{}\"\nbase = \"{base}\"",
        first.ratio(100 * (from - to), below),
        pair[0],
        pair[1]
    );
    text += &relation("reduction", &plain, &keys);
    let (means, above) =
        [("times", from), ("times more", from - to), ("either", from)][rng.random_range(0..3)];
    let keys = format!(
        "times = \"{}\"\nbefore = \"{}\"\nafter = \"{}\"\nmeans = \"{means}\"",
        first.ratio(above, to),
        pair[0],
        pair[1]
    );
    text + &relation("speedup", &plain, &keys)
}

/// Means of durations in sevenths that are cut to whole ones, the total on its own.
fn cut_sum(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n = rng.random_range(1..20);
    let count = rng.random_range(2..4);
    let problems: Vec<Vec<i128>> =
        (0..n).map(|_| (0..count).map(|_| rng.random_range(0..300)).collect()).collect();
    let style = plain.other(rng);
    let mean = |sum: i128| style.ratio(sum, n);
    let part = |at: usize| mean(problems.iter().map(|parts| parts[at] / 7).sum());
    let parts: Vec<String> = (0..count).map(|at| format!("\"{}\"", part(at))).collect();
    let total = mean(problems.iter().map(|parts| parts.iter().sum::<i128>() / 7).sum());
    relation(
        "sum_of_means",
        &plain,
        &format!("total = \"{total}\"\nparts = [{}]\ncut = \"1\"", parts.join(", ")),
    )
}

fn total(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n = rng.random_range(1..80);
    let sign = if rng.random_bool(0.2) { -1 } else { 1 };
    let sum = sign * rng.random_range(1..90_000);
    let total = plain.other(rng).ratio(sum, 1000);
    let mean = plain.other(rng).ratio(sum, n);
    let n = if rng.random_bool(0.5) { format!("n = {n}\n") } else { String::new() };
    relation("total_over_mean", &plain, &format!("total = \"{total}\"\nmean = \"{mean}\"\nunit = 1000\n{n}"))
}

fn parts(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let counts: Vec<i128> = (0..rng.random_range(2..6)).map(|_| rng.random_range(0..30)).collect();
    let n = counts.iter().sum::<i128>().max(1);
    let counts = if counts.iter().sum::<i128>() == 0 { vec![1, 0] } else { counts };
    let style = plain.other(rng);
    let parts: Vec<String> =
        counts.iter().map(|count| format!("\"{}\"", style.ratio(100 * count, n))).collect();
    let n = if rng.random_bool(0.5) { format!("\nn = {n}") } else { String::new() };
    relation("shares_sum", &plain, &format!("parts = [{}]{n}", parts.join(", ")))
}

/// The length and the turns of moves to eight neighbours.
fn walk(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let walk = Walk::drawn(rng, 8);
    let [dx, dy] = walk.end();
    let length = walk.length(&plain.other(rng));
    let turns = walk.turns(rng.random_bool(0.5));
    let turns = plain.other(rng).ratio(turns, 1);
    let ends = format!("from = \"3:4\"\nto = \"{}:{}\"", 3 + dx, 4 + dy);
    relation("turn_sum", &plain, &format!("turns = \"{turns}\"\nlength = \"{length}\"\n{ends}"))
        + &relation("lattice", &plain, &format!("value = \"{length}\"\n{ends}"))
        + &relation("path_bound", &plain, &format!("value = \"{length}\"\n{ends}\nmoves = \"eight\""))
}

/// The length of segments along the axes, and of a polyline at any angle.
fn straight(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let bends: Vec<[i128; 2]> =
        (0..rng.random_range(2..5)).map(|_| [rng.random_range(-20..20), rng.random_range(-20..20)]).collect();
    let apart = |pair: &[[i128; 2]]| [0, 1].map(|axis| (pair[0][axis] - pair[1][axis]).abs());
    let along: i128 = bends.windows(2).map(|pair| apart(pair).iter().sum::<i128>()).sum();
    // The root is cut 15 places on, far from what any print here tells apart.
    let root = |[dx, dy]: [i128; 2]| ((dx * dx + dy * dy) * 10_i128.pow(30)).isqrt();
    let length: i128 = bends.windows(2).map(|pair| root(apart(pair))).sum();
    let [from, to] = [bends[0], bends[bends.len() - 1]].map(|[x, y]| format!("\"{x}:{y}\""));
    let keys = |value: String, moves: &str| {
        format!("value = \"{value}\"\nfrom = {from}\nto = {to}\nmoves = \"{moves}\"")
    };
    relation("path_bound", &plain, &keys(plain.ratio(along, 1), "four"))
        + &relation("path_bound", &plain, &keys(plain.ratio(length, 10_i128.pow(15)), "any"))
}

fn interval(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n: usize = rng.random_range(1..200);
    let k = rng.random_range(0..=n);
    let is_exact = rng.random_bool(0.5);
    let of = if is_exact { clopper_pearson(k, n, 0.95) } else { wilson(k, n, 0.95) };
    let Interval { low, high } = of.expect("there are trials");
    let style = plain.other(rng);
    let end = |end: f64| style.ratio((end * 1e14).round() as i128, 10_i128.pow(12));
    let method = if is_exact { "clopper_pearson" } else { "any" };
    let keys =
        format!("low = \"{}\"\nhigh = \"{}\"\nk = {k}\nn = {n}\nmethod = \"{method}\"", end(low), end(high));
    relation("interval", &plain, &keys)
}

/// Fisher's exact test in whole numbers: tables no likelier than the one seen.
fn p_value(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n: [i128; 2] = [0; 2].map(|_| rng.random_range(1..25));
    let k = n.map(|n| rng.random_range(0..=n));
    let choose = |n: i128, k: i128| (0..k).fold(1, |product, at| product * (n - at) / (at + 1));
    let hits = k[0] + k[1];
    let ways = |first: i128| choose(n[0], first) * choose(n[1], hits - first);
    let range = (hits - n[1]).max(0)..=hits.min(n[0]);
    let rare: i128 = range.map(ways).filter(|count| *count <= ways(k[0])).sum();
    let all = choose(n[0] + n[1], hits);
    // One in three is printed as the bound that it keeps.
    let p = match rng.random_range(0..3) {
        0 if rare * 1000 < all => "< 0.001".to_owned(),
        0 if rare * 20 <= all => "≤ 0.05".to_owned(),
        0 => "> 0.05".to_owned(),
        _ => plain.other(rng).ratio(rare, all),
    };
    let keys = format!("p = \"{p}\"\nk1 = {}\nn1 = {}\nk2 = {}\nn2 = {}", k[0], n[0], k[1], n[1]);
    relation("p_value", &plain, &keys)
}

fn grim(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n = rng.random_range(1..300);
    let sum = rng.random_range(-900..900);
    let k = rng.random_range(0..=n);
    let style = plain.other(rng);
    let mean = format!("value = \"{}\"\nn = {n}\ngrain = \"1/4\"", style.ratio(sum, 4 * n));
    let share = format!("value = \"{}\"\nn = {n}\nwhole = 100", style.ratio(100 * k, n));
    let expanded = format!("value = \"{}\"\nfree = {n}", style.ratio(k, 1));
    relation("grim", &plain, &mean)
        + &relation("grim", &plain, &share)
        + &relation("expansions", &plain, &expanded)
}

fn grimmer(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n = rng.random_range(2..30);
    let values = values(rng, n);
    let (sum, about) = moments(&values);
    let mean = plain.other(rng);
    let spread = plain.other(rng);
    let (key, by) = [("sd", 1), ("se", n)][rng.random_range(0..2)];
    let (divisor, below) = [("sample", n - 1), ("population", n), ("either", n)][rng.random_range(0..3)];
    let spread = spread.root(about, n * below * by);
    let mut keys =
        format!("mean = \"{}\"\n{key} = \"{spread}\"\nn = {n}\ndivisor = \"{divisor}\"", mean.ratio(sum, n));
    if rng.random_bool(0.5) {
        keys +=
            &format!("\nleast = {}\nmost = {}", values[0], values[values.len() - 1] + rng.random_range(0..3));
    }
    relation("grimmer", &plain, &keys)
}

fn ticks(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let value = plain.ratio(rng.random_range(-300..3000), 64);
    relation("clock", &plain, &format!("value = \"{value}\"\ntick = \"1/64\""))
}

fn rising(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let n = rng.random_range(1..60);
    let mut solved: Vec<i128> = (0..rng.random_range(2..6)).map(|_| rng.random_range(0..=n)).collect();
    solved.sort_unstable();
    let listed: Vec<String> = solved.iter().map(|k| format!("\"{}\"", plain.ratio(100 * k, n))).collect();
    relation("rises", &plain, &format!("values = [{}]\nanytime = \"yes\"", listed.join(", ")))
}

/// A polyline through cell centres whose length is near the straight line, with its turns.
fn any_angle_turns(rng: &mut SmallRng) -> String {
    let plain = Style::plain(rng);
    let styles = [(); 2].map(|()| Style { decimals: rng.random_range(2..4), ..plain.clone() });
    loop {
        let end = [rng.random_range(2..9), rng.random_range(0..6)];
        let mut cells = vec![[0, 0]];
        let mut x = 0;
        for _ in 0..rng.random_range(1..3) {
            x = rng.random_range(x..=end[0]);
            cells.push([x, rng.random_range(-1..7)]);
        }
        cells.push(end);
        let span = |pair: &[[i32; 2]]| proofs::turns::distance(pair[0], pair[1]);
        let length: f64 = cells.windows(2).map(span).sum();
        if cells.windows(2).any(|pair| pair[0] == pair[1])
            || length > proofs::turns::distance([0, 0], end) + 1.5
        {
            continue;
        }
        let (convention, angles) =
            [(Convention::Exterior, "exterior"), (Convention::Interior, "interior")][rng.random_range(0..2)];
        let printed = |style: &Style, value: f64| style.ratio((value * 1e9).round() as i128, 10_i128.pow(9));
        let keys = format!(
            "turns = \"{}\"\nlength = \"{}\"\nfrom = \"0:0\"\nto = \"{}:{}\"\nangles = \"{angles}\"",
            printed(&styles[0], turn_sum_deg(&cells, convention)),
            printed(&styles[1], length),
            end[0],
            end[1]
        );
        return relation("any_angle_turns", &plain, &keys);
    }
}
