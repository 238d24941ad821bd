//! What a column without annotation probably is.

use super::cells::{Number, is_unit, number, plain};
use crate::meaning::{Kind, Meaning, natural};
use crate::statistic::Statistic;
use crate::table::Column;

/// An annotation for the column `name`, whose header names `unit` or nothing, with these texts; `label` if they are no numbers.
pub fn annotation(name: &str, unit: &str, texts: &[&str]) -> String {
    if super::are_statistics(texts) {
        return "statistic".to_owned();
    }
    let read: Vec<_> = texts.iter().map(|text| number(&plain(text).0)).collect();
    let filled = read.iter().filter(|number| !matches!(number, Ok(Number::Missing))).count();
    // Decimal commas and marks of thousands are of numbers too, so that they are told.
    let is_number = |number: &&Result<Number, String>| match number {
        Ok(number) => matches!(number, Number::Plain { .. }),
        Err(message) => message.contains("decimal comma") || message.contains("thousands separator"),
    };
    let numbers = read.iter().filter(is_number).count();
    // A column with a few faulty numbers is one of numbers, so that they are told.
    if numbers == 0 || 2 * numbers < filled {
        return "label".to_owned();
    }
    let has_spread = read.iter().any(|number| matches!(number, Ok(Number::Plain { spread: Some(_), .. })));
    let mut items = vec![kind(&name.to_lowercase(), texts)];
    if has_spread {
        items.push("±sd".to_owned());
    }
    items.extend(better(&name.to_lowercase()).map(str::to_owned));
    if !unit.is_empty() {
        items.push(format!("unit={unit}"));
    }
    items.join(", ")
}

/// Lets guessed columns belong together whose names differ by the statistic alone: `mean` and `sd`, `time mean` and `time max`.
pub fn join(columns: &mut [Column]) {
    let bases: Vec<Option<String>> = columns.iter().map(base).collect();
    for at in 0..columns.len() {
        let Some(own) = &bases[at] else { continue };
        let alike = |(other, base): (usize, &Option<String>)| {
            base.as_ref() == Some(own) && columns[other].name != columns[at].name
        };
        if bases.iter().enumerate().any(alike) {
            let name = if own.is_empty() { "values" } else { own };
            let column = &mut columns[at];
            column.annotation += &format!(", of={name}");
            column.meaning = Meaning::parse(&column.annotation).unwrap_or_default();
        }
    }
}

/// Proposes the column that probably holds n, for the stub alone: a row without n is no fault of a guess.
pub fn propose_n(columns: &mut [Column]) {
    let is_n = |column: &&Column| {
        ["n", "runs", "trials", "episodes", "problems"].contains(&column.name.to_lowercase().as_str())
            && !matches!(column.meaning.kind, Kind::Skip | Kind::Statistics)
    };
    let Some(name) = columns.iter().find(is_n).map(|column| column.name.clone()) else { return };
    for column in columns.iter_mut().filter(|column| column.written.is_none() && column.name != name) {
        column.annotation = column.annotation.replace('?', &name);
    }
}

/// What a guessed column's statistic is of: its name without the statistic, n and units; none if it holds no statistic.
fn base(column: &Column) -> Option<String> {
    if column.written.is_some() || !matches!(column.meaning.kind, Kind::Of(_) | Kind::Share { .. }) {
        return None;
    }
    let is_rest = |word: &&str| {
        let is_filler =
            ["", "n", "of", "out", "over", "trials", "runs", "dev", "deviation", "standard", "value"]
                .contains(word);
        !is_filler
            && !is_unit(word)
            && Statistic::named(word).is_none()
            && natural(word).is_none()
            && *word != "%"
    };
    let lower = column.name.to_lowercase();
    Some(words(&lower).filter(is_rest).collect::<Vec<_>>().join(" "))
}

/// The words of a name; a percentage stays with its number.
fn words(name: &str) -> impl Iterator<Item = &str> {
    name.split(|c: char| !c.is_alphanumeric() && c != '%')
}

/// Whether one of `starts` starts a word of `name`.
fn has(name: &str, starts: &[&str]) -> bool {
    words(name).any(|part| starts.iter().any(|word| part.starts_with(word)))
}

/// The number of values that a header names: `of 250`, `n = 250`, `250 trials`; `?` if it names none.
fn n(name: &str) -> String {
    let all: Vec<&str> = words(name).filter(|word| !word.is_empty()).collect();
    let named = all.windows(2).find_map(|pair| {
        let [before, after] = [pair[0], pair[1]];
        let is_before = ["of", "n", "over"].contains(&before);
        let is_behind = ["trials", "runs", "problems", "queries", "seeds", "episodes"].contains(&after);
        let count = if is_before { after } else { before };
        (is_before || is_behind).then(|| natural(count)).flatten()
    });
    named.map_or_else(|| "?".to_owned(), |n| n.to_string())
}

/// How a share is printed: with `%` or above 1 as a percentage, and whole numbers up to a known n as counts.
fn share(name: &str, n: &str, texts: &[&str]) -> &'static str {
    if name.contains('%') || texts.iter().any(|text| text.contains('%')) {
        return "%";
    }
    let values = || texts.iter().filter_map(|text| plain(text).0.parse::<f64>().ok());
    let greatest = values().fold(0.0, f64::max);
    let are_counts =
        natural(n).is_some_and(|n| greatest <= n as f64) && values().all(|value| value.fract() == 0.0);
    match greatest > 1.0 {
        false => "share",
        true if are_counts && !texts.iter().any(|text| text.contains('.')) => "count",
        true => "%",
    }
}

/// Whether a word names a statistic that no check knows, which must not be taken for a mean: `variance`, `95th`, `p95`, `110%`.
fn is_other_statistic(word: &str) -> bool {
    const OTHERS: [&str; 13] = [
        "ci",
        "cv",
        "geomean",
        "geometric",
        "harmonic",
        "iqr",
        "mode",
        "range",
        "rms",
        "rmse",
        "var",
        "variance",
        "worst",
    ];
    let is_number = |text: &str| text.parse::<f64>().is_ok();
    let has_unknown_share = word.strip_suffix('%').is_some_and(is_number) && Statistic::named(word).is_none();
    let is_percentile = word.strip_prefix('p').or(word.strip_suffix("th")).is_some_and(is_number);
    OTHERS.contains(&word) || has_unknown_share || is_percentile
}

fn kind(name: &str, texts: &[&str]) -> String {
    if words(name).any(is_other_statistic) {
        return "value".to_owned();
    }
    let statistic = words(name).find_map(Statistic::named);
    let is_mean = matches!(statistic, None | Some(Statistic::Mean));
    let n = n(name);
    if is_mean && has(name, &["success", "solved", "share", "rate", "accuracy"]) {
        return format!("{} of {n}", share(name, &n, texts));
    }
    if let Some(statistic) = statistic {
        let word = match statistic {
            Statistic::Min => "min".to_owned(),
            Statistic::Max => "max".to_owned(),
            Statistic::Mean => "mean".to_owned(),
            Statistic::Sd => "sd".to_owned(),
            Statistic::Se => "se".to_owned(),
            Statistic::Total => "total".to_owned(),
            Statistic::Quantile(5000) => "median".to_owned(),
            Statistic::Quantile(parts) => format!("{}%", f64::from(parts) / 100.0),
        };
        return format!("{word}, n={n}");
    }
    if has(name, &["time", "duration", "latency", "runtime"]) {
        return format!("mean, n={n}");
    }
    if has(name, &["node", "expan", "iter", "collision", "count"]) {
        return format!("mean, integers, n={n}");
    }
    if has(name, &["sample", "budget"]) {
        return "samples".to_owned();
    }
    "value".to_owned()
}

fn better(name: &str) -> Option<&'static str> {
    if words(name).find_map(Statistic::named).is_some_and(|statistic| statistic != Statistic::Mean) {
        return None;
    }
    if has(name, &["success", "solved", "accuracy", "clearance"]) {
        return Some("higher is better");
    }
    let lower =
        ["time", "duration", "latency", "runtime", "cost", "length", "error", "node", "expan", "collision"];
    has(name, &lower).then_some("lower is better")
}
