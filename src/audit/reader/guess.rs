//! What a column without annotation probably is.

use super::cells::{Number, number, plain};
use crate::statistic::Statistic;

/// An annotation for the column `name` with these texts; `label` if they are no numbers.
pub fn annotation(name: &str, texts: &[&str]) -> String {
    if super::are_statistics(texts) {
        return "statistic".to_owned();
    }
    let read: Vec<_> = texts.iter().map(|text| number(&plain(text).0)).collect();
    let filled = read.iter().filter(|number| !matches!(number, Ok(Number::Missing))).count();
    let numbers = read.iter().filter(|number| matches!(number, Ok(Number::Plain { .. }))).count();
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
    items.join(", ")
}

/// Whether one of `words` starts a word of `name`.
fn has(name: &str, words: &[&str]) -> bool {
    name.split(|c: char| !c.is_alphanumeric() && c != '%')
        .any(|part| words.iter().any(|word| part.starts_with(word)))
}

fn kind(name: &str, texts: &[&str]) -> String {
    let is_percent = name.contains('%') || texts.iter().any(|text| text.contains('%'));
    let statistic = name.split(|c: char| !c.is_alphanumeric() && c != '%').find_map(Statistic::named);
    if has(name, &["success", "solved", "share", "rate", "accuracy"]) {
        return if is_percent { "% of ?".to_owned() } else { "share of ?".to_owned() };
    }
    if let Some(statistic) = statistic {
        let word = match statistic {
            Statistic::Min => "min".to_owned(),
            Statistic::Max => "max".to_owned(),
            Statistic::Mean => "mean".to_owned(),
            Statistic::Sd => "sd".to_owned(),
            Statistic::Se => "se".to_owned(),
            Statistic::Total => "total".to_owned(),
            Statistic::Quantile(parts) => format!("q{}", f64::from(parts) / 100.0),
        };
        return format!("{word}, n=?");
    }
    if has(name, &["time", "duration", "latency", "runtime"]) {
        return "mean, n=?".to_owned();
    }
    if has(name, &["node", "expan", "iter", "step", "collision", "count"]) {
        return "mean, integers, n=?".to_owned();
    }
    if has(name, &["sample", "budget"]) {
        return "samples".to_owned();
    }
    "value".to_owned()
}

fn better(name: &str) -> Option<&'static str> {
    if has(name, &["success", "solved", "accuracy", "clearance"]) {
        return Some("higher is better");
    }
    let lower =
        ["time", "duration", "latency", "runtime", "cost", "length", "error", "node", "expan", "collision"];
    has(name, &lower).then_some("lower is better")
}
