//! Estimates in words, with their direction.

use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Quantity};

/// An estimate in words: `2.2 % shorter`; `None` where there is nothing to say beyond its number.
pub fn effect(estimate: &Estimate) -> Option<String> {
    let Effect { size, decimals, words } = Effect::new(estimate);
    (!words.is_empty()).then(|| rounded(size, decimals) + &words)
}

/// A share as a percentage, with the digits that its interval leaves certain.
pub fn percentage(share: &Estimate) -> String {
    let Effect { size, decimals, words } = Effect::scaled(share, |value| 100.0 * value, " %".to_owned());
    rounded(size, decimals) + &words
}

/// `size` with so many decimals; a half goes away from zero, also where it is a half but for rounding, as 100 times 0.145 is.
pub(super) fn rounded(size: f64, decimals: usize) -> String {
    let unit = libm::pow(10.0, decimals as f64);
    let exact = libm::round(size * unit * 1e6) / 1e6;
    format!("{:.decimals$}", libm::round(exact) / unit)
}

/// More numbers of one kind are shown as a range.
const LISTED: usize = 3;

/// Numbers of more kinds than these are not shown side by side.
const KINDS: usize = 2;

/// The numbers of a claim's parts, and how many instances they rest on: `2.2 / 2.3 % shorter`, or `2.2 % (C1) / 2.3 % (C2)` where all parts
/// have names. Two kinds stand one after the other, if words tell them apart.
pub fn side_by_side(parts: &[(&Estimate, Option<&str>)]) -> Option<[String; 2]> {
    let mut kinds: Vec<Vec<(&Estimate, Option<&str>)>> = Vec::new();
    for part in parts {
        match kinds.iter_mut().find(|kind| is_alike(kind[0].0, part.0)) {
            Some(kind) => kind.push(*part),
            None => kinds.push(vec![*part]),
        }
    }
    let has_words = |kind: &Vec<(&Estimate, _)>| !["", " %"].contains(&Effect::new(kind[0].0).words.as_str());
    if kinds.is_empty() || kinds.len() > KINDS || kinds.len() > 1 && !kinds.iter().all(has_words) {
        return None;
    }
    let (numbers, mut counts): (Vec<String>, Vec<String>) =
        kinds.iter().map(|kind| of_one_kind(kind)).unzip();
    counts.dedup();
    Some([numbers.join("; "), counts.join("; ")])
}

/// Whether two numbers measure the same, in the same direction.
fn is_alike(one: &Estimate, other: &Estimate) -> bool {
    (one.quantity, &one.subject, Effect::new(one).words)
        == (other.quantity, &other.subject, Effect::new(other).words)
        && (!one.quantity.is_number() || one.what == other.what)
}

/// Numbers that measure the same, in the digits that all their intervals leave certain, and their counts of instances.
fn of_one_kind(parts: &[(&Estimate, Option<&str>)]) -> (String, String) {
    let mut effects: Vec<(Effect, Option<&str>)> =
        parts.iter().map(|(estimate, name)| (Effect::new(estimate), *name)).collect();
    let decimals = effects.iter().map(|(effect, _)| effect.decimals).min().unwrap_or_default();
    let words = effects[0].0.words.clone();
    let are_named = effects.iter().all(|(_, name)| name.is_some());
    let mut counts: Vec<usize> = parts.iter().map(|(estimate, _)| estimate.n).collect();
    let [first, between] = if effects.len() <= LISTED {
        ["", " / "]
    } else {
        effects.sort_by(|(one, _), (other, _)| one.size.total_cmp(&other.size));
        effects.drain(1..effects.len() - 1);
        counts.sort_unstable();
        counts = vec![counts[0], counts[counts.len() - 1]];
        [if are_named { "from " } else { "" }, " to "]
    };
    if counts.iter().all(|n| *n == counts[0]) {
        counts.truncate(1);
    }
    let in_words = |(effect, name): &(Effect, Option<&str>)| match name.filter(|_| are_named) {
        Some(name) => format!("{}{words} ({name})", rounded(effect.size, decimals)),
        None => rounded(effect.size, decimals),
    };
    let sizes: Vec<String> = effects.iter().map(in_words).collect();
    let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
    (first.to_owned() + &sizes.join(between) + if are_named { "" } else { &words }, counts.join(between))
}

/// An estimate in words, and its size.
struct Effect {
    /// Its size, without a sign where the words give the direction.
    size: f64,
    /// How many decimals its interval leaves certain.
    decimals: usize,
    /// The unit and the direction; empty if the number is shown as it is.
    words: String,
}

impl Effect {
    /// That of an estimate, from the kind of number that it is.
    fn new(estimate: &Estimate) -> Self {
        let subject = estimate.subject.as_str();
        match estimate.quantity {
            Quantity::MorePercent => Self::of_change(subject, estimate, |value| value),
            Quantity::LessPercent => Self::of_change(subject, estimate, |value| -value),
            Quantity::Ratio => Self::of_change(subject, estimate, |value| 100.0 * (value - 1.0)),
            Quantity::Share => Self::scaled(estimate, |value| 100.0 * value, " %".to_owned()),
            Quantity::MorePoints => {
                let direction = if estimate.value < 0.0 { "fewer" } else { "more" };
                Self::scaled(estimate, f64::abs, format!(" percentage points {direction}"))
            }
            Quantity::PercentOfOther => {
                let subject = bare(subject);
                Self::scaled(estimate, |value| value, format!(" % of the best rival's {subject}"))
            }
            Quantity::Number | Quantity::Probability | Quantity::Rank => {
                Self::scaled(estimate, |value| value, String::new())
            }
        }
    }

    /// A change of a metric in per cent, which `percent` gives.
    fn of_change(metric: &str, estimate: &Estimate, percent: impl Fn(f64) -> f64) -> Self {
        let direction = direction(metric, percent(estimate.value) > 0.0);
        Self::scaled(estimate, |value| percent(value).abs(), format!(" % {direction}"))
    }

    fn scaled(estimate: &Estimate, scale: impl Fn(f64) -> f64, words: String) -> Self {
        let [low, high] = estimate.interval.unwrap_or([estimate.value; 2]).map(&scale);
        let half = (high - low).abs() / 2.0;
        let size = scale(estimate.value);
        let is_whole = words == " %" && (size == 0.0 || size == 100.0);
        let is_exact = half == 0.0 || is_whole;
        let decimals = if is_exact { 0 } else { (-libm::log10(half)).ceil().clamp(0.0, 2.0) as usize };
        Self { size, decimals, words }
    }
}

/// The title of an axis along which `metric` is less than with `base`, in per cent: what is more stands below zero.
pub fn less_than(metric: &Metric, base: &str) -> String {
    let less = direction(&metric.label.to_lowercase(), false);
    let first = less[..1].to_uppercase();
    format!("{first}{} than {base} (%)", &less[1..])
}

/// A metric without what its label adds after a comma.
fn bare(metric: &str) -> &str {
    metric.split(", ").next().unwrap_or(metric)
}

/// The comparative for more or less of a metric.
fn direction(metric: &str, is_more: bool) -> String {
    let metric = bare(metric);
    let metric = metric.strip_prefix("opened ").unwrap_or(metric);
    let [less, more] = if metric == "path cost" || metric == "path length" {
        return if is_more { "longer" } else { "shorter" }.to_owned();
    } else if metric.split(" of ").next().is_some_and(|noun| noun.ends_with('s')) {
        ["fewer", "more"]
    } else {
        ["less", "more"]
    };
    format!("{} {metric}", if is_more { more } else { less })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_has_a_direction_in_words_and_the_digits_of_its_interval() {
        use Quantity::{LessPercent, MorePercent, MorePoints, PercentOfOther, Ratio, Share};
        for (value, interval, quantity, subject, words) in [
            (-2.156, [-2.393, -1.921], MorePercent, "path cost", "2.2 % shorter"),
            (0.412, [0.219, 0.661], MorePercent, "path length", "0.4 % longer"),
            (15.15, [13.38, 17.04], MorePercent, "opened nodes", "15 % more nodes"),
            (-62.7, [-64.4, -61.1], MorePercent, "turn sum, exterior angles", "63 % less turn sum"),
            (40.52, [38.37, 42.75], LessPercent, "path cost", "41 % shorter"),
            (-3.1, [-3.9, -2.3], LessPercent, "expansions", "3.1 % more expansions"),
            (-99.857, [-99.860, -99.854], MorePercent, "lines of sight", "99.86 % fewer lines of sight"),
            (0.9169, [0.9153, 0.9185], Ratio, "path length", "8.3 % shorter"),
            (0.534, [0.498, 0.569], Share, "trials solved", "53 %"),
            (0.505, [0.470, 0.540], Share, "trials solved", "51 %"),
            (1.0, [0.994, 1.0], Share, "instances", "100 %"),
            (18.15, [14.4, 21.9], MorePoints, "solved queries", "18 percentage points more"),
            (99.87, [99.2, 100.4], PercentOfOther, "median bends", "99.9 % of the best rival's median bends"),
        ] {
            let ours = Estimate { interval: Some(interval), ..Estimate::bare(value, "as it is", 9) };
            assert_eq!(effect(&ours.measures(quantity, subject)).unwrap(), words);
        }
        assert_eq!(effect(&Estimate::bare(3.0, "change of path cost in %", 9)), None);
    }

    #[test]
    fn numbers_of_parts_stand_side_by_side_if_words_tell_their_kinds_apart() {
        use Quantity::{MorePercent, PercentOfOther, Share};
        let of = |value: f64, quantity, subject: &str, n| {
            Estimate { interval: Some([value - 0.5, value + 0.5]), ..Estimate::bare(value, "as it is", n) }
                .measures(quantity, subject)
        };
        let shown =
            |parts: &[Estimate]| side_by_side(&parts.iter().map(|part| (part, None)).collect::<Vec<_>>());
        let [shorter, longer] =
            [-2.0, 3.0].map(|value| of(value, MorePercent, "path cost", if value < 0.0 { 9 } else { 8 }));
        let work = [10.0, 20.0].map(|value| of(value, PercentOfOther, "closed nodes", 9));
        assert_eq!(shown(&[]), None);
        assert_eq!(shown(&[shorter.clone(), longer]).unwrap(), ["2.0 % shorter; 3.0 % longer", "9; 8"]);
        assert_eq!(shown(&work).unwrap(), ["10.0 / 20.0 % of the best rival's closed nodes", "9"]);
        let named = [(&shorter, Some("C1")), (&shorter, Some("C2"))];
        assert_eq!(side_by_side(&named).unwrap()[0], "2.0 % shorter (C1) / 2.0 % shorter (C2)");
        assert_eq!(
            shown(&[&work[..], &work[..]].concat()).unwrap()[0],
            "10.0 to 20.0 % of the best rival's closed nodes"
        );
        let two = [&work[..1], std::slice::from_ref(&shorter)].concat();
        assert_eq!(shown(&two).unwrap(), ["10.0 % of the best rival's closed nodes; 2.0 % shorter", "9"]);
        let nameless = [of(0.5, Share, "trials solved", 9), of(0.5, Share, "instances", 9)];
        assert_eq!(shown(&nameless), None, "two shares would not say of what");
        let third = of(10.0, PercentOfOther, "generated successors", 9);
        assert_eq!(shown(&[&two[..], &[third]].concat()), None, "three kinds");
    }

    #[test]
    fn a_percentage_has_the_digits_of_its_interval() {
        for (value, interval, text) in [
            (0.0058, [0.0055, 0.0060], "0.58 %"),
            (0.505, [0.470, 0.540], "51 %"),
            (0.145, [0.10, 0.20], "15 %"),
            (0.105, [0.07, 0.16], "11 %"),
            (1.0, [0.9965, 1.0], "100 %"),
        ] {
            let share = Estimate { interval: Some(interval), ..Estimate::bare(value, "share", 9) };
            assert_eq!(percentage(&share), text);
        }
    }
}
