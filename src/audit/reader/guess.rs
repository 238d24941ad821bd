//! The probable meaning of a column without annotation.

use super::cells::{Number, is_unit, number, plain};
use crate::meaning::{Better, Kind, Meaning, natural};
use crate::statistic::Statistic;
use crate::table::Column;
use proofs::printed::Printed;

/// An annotation for the column `name`, whose header names `unit` or nothing, with these texts; `label` if they are no numbers.
pub fn annotation(name: &str, unit: &str, texts: &[&str]) -> String {
    if super::are_statistics(texts) {
        return "statistic".to_owned();
    }
    let read: Vec<_> = texts.iter().map(|text| number(&plain(text).0)).collect();
    let filled = read.iter().filter(|number| !matches!(number, Ok(Number::Missing))).count();
    let lower = name.to_lowercase();
    let names_numbers = !unit.is_empty() || super::unit_of(name).is_some() || kind(&lower, texts) != "value";
    // Decimal commas, marks of thousands, footnotes and minutes are of numbers too: the reader names them.
    let is_number = |number: &&Result<Number, String>| match number {
        Ok(number) => *number != Number::Missing,
        Err(message) => {
            let has = |words: &[&str]| words.iter().any(|word| message.contains(word));
            has(&["decimal comma", "thousands separator", "has an exponent", "has a power of ten"])
                || names_numbers && has(&OF_NUMBERS)
        }
    };
    let numbers = read.iter().filter(is_number).count();
    // A column with a few faulty numbers is one of numbers, so that its faults are reported.
    if numbers == 0 || 2 * numbers < filled {
        return "label".to_owned();
    }
    let spread = |number: &Result<Number, String>| match number {
        Ok(Number::Plain { spread, .. }) => *spread,
        _ => None,
    };
    let spreads: Vec<f64> = read.iter().filter_map(spread).map(Printed::value).collect();
    let mut items = vec![fractions(&read).unwrap_or_else(|| kind(&lower, texts))];
    if !spreads.is_empty() && !are_multiples(&spreads) {
        items.push("±sd".to_owned());
    }
    items.extend(better(&lower).map(str::to_owned));
    if !unit.is_empty() {
        items.push(format!("unit={unit}"));
    }
    items.join(", ")
}

/// What the reader says of cells that are numbers where their column is one of numbers.
const OF_NUMBERS: [&str; 8] = [
    "has more than 15 digits",
    "has the mark",
    "is a time in",
    "is struck out",
    "ends in a point",
    "leaves digits out",
    "is a range",
    "is a bound",
];

/// Whether what stands in brackets may be multiples of the best, as pytest-benchmark prints them: 1.0 and more, and one is 1.0.
pub fn are_multiples(brackets: &[f64]) -> bool {
    brackets.contains(&1.0) && brackets.iter().all(|multiple| *multiple >= 1.0)
}

/// What a column of fractions holds: counts, or percentages that have fractions beside them; `None` if it holds no fraction.
fn fractions(read: &[Result<Number, String>]) -> Option<String> {
    let found = read.iter().filter_map(|number| match number {
        Ok(Number::Fraction { k_of_n: [_, n], percent }) => Some((*n, percent.is_some())),
        _ => None,
    });
    let all: Vec<(u64, bool)> = found.collect();
    let (n, _) = all.first()?;
    let n = if all.iter().all(|(other, _)| other == n) { n.to_string() } else { "?".to_owned() };
    let word = if all.iter().any(|(_, has_percent)| *has_percent) { "%" } else { "count" };
    Some(format!("{word} of {n}"))
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

/// Takes the column that probably holds n for the n of guessed columns; rows without n are not looked at.
pub fn take_n(columns: &mut [Column], rows: &[(usize, Vec<String>)]) {
    let is_n = |column: &Column| {
        ["n", "runs", "trials", "episodes", "problems"].contains(&column.name.to_lowercase().as_str())
            && !matches!(column.meaning.kind, Kind::Skip | Kind::Statistics)
    };
    let Some(of) = columns.iter().position(is_n) else { return };
    let name = columns[of].name.clone();
    let is_alone = columns.iter().filter(|column| column.name == name).count() == 1;
    for (at, column) in columns.iter_mut().enumerate() {
        if column.written.is_some() || column.name == name || !column.annotation.contains('?') {
            continue;
        }
        // Whole numbers up to n are counts more often than percentages.
        let text = |row: &[String], at: usize| row.get(at).map_or_else(String::new, |text| plain(text).0);
        let is_up_to_n = |(_, row): &(usize, Vec<String>)| {
            let k = text(row, at);
            let pair = k.parse::<u64>().ok().zip(natural(&text(row, of)));
            number(&k) == Ok(Number::Missing) || pair.is_some_and(|(k, n)| k <= n)
        };
        let is_count = !column.name.contains('%') && rows.iter().all(is_up_to_n);
        let share = if is_count { "count of ?" } else { "% of ?" };
        column.annotation = column.annotation.replace("% of ?", share).replace('?', &name);
        if is_alone {
            column.meaning = Meaning::parse(&column.annotation).unwrap_or_default();
        }
    }
}

/// What a guessed column's statistic is of: its name without the statistic, n and units; `None` if it holds no statistic.
fn base(column: &Column) -> Option<String> {
    if column.written.is_some() || !matches!(column.meaning.kind, Kind::Statistic(_) | Kind::Share { .. }) {
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

/// Which way is better by the arrow in a name, if there is one.
pub fn better_by_arrow(name: &str) -> Option<Better> {
    let has = |arrows: [&str; 2]| arrows.iter().any(|arrow| name.contains(arrow));
    if has(["↑", "\\uparrow"]) {
        return Some(Better::Higher);
    }
    has(["↓", "\\downarrow"]).then_some(Better::Lower)
}

fn better(name: &str) -> Option<&'static str> {
    match better_by_arrow(name) {
        Some(Better::Higher) => return Some("higher is better"),
        Some(Better::Lower) => return Some("lower is better"),
        None => {}
    }
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
