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

/// `size` with so many decimals; a half goes away from zero.
pub fn rounded(size: f64, decimals: usize) -> String {
    let unit = libm::pow(10.0, decimals as f64);
    format!("{:.decimals$}", libm::round(size * unit) / unit)
}

/// An estimate in words, and its size.
pub struct Effect {
    /// Its size, without a sign where the words give the direction.
    pub size: f64,
    /// How many decimals its interval leaves certain.
    pub decimals: usize,
    /// The unit and the direction; empty if the number is shown as it is.
    pub words: String,
}

impl Effect {
    /// That of an estimate, from the kind of number that it is.
    pub fn new(estimate: &Estimate) -> Self {
        let subject = estimate.subject.as_str();
        match estimate.quantity {
            Quantity::MorePercent => Self::of_change(subject, estimate, |value| value),
            Quantity::LessPercent => Self::of_change(subject, estimate, |value| -value),
            Quantity::Ratio => Self::of_change(subject, estimate, |value| 100.0 * (value - 1.0)),
            Quantity::Share => Self::scaled(estimate, |value| 100.0 * value, " %".to_owned()),
            Quantity::MorePoints => {
                let words = if estimate.value < 0.0 { " points fewer" } else { " points more" };
                Self::scaled(estimate, f64::abs, words.to_owned())
            }
            Quantity::PercentOfOther => {
                Self::scaled(estimate, |value| value, format!(" % of the other's {subject}"))
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

/// The comparative for more or less of a metric.
fn direction(metric: &str, is_more: bool) -> String {
    let metric = metric.split(", ").next().unwrap_or(metric);
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
            (18.15, [14.4, 21.9], MorePoints, "solved queries", "18 points more"),
            (99.87, [99.2, 100.4], PercentOfOther, "median bends", "99.9 % of the other's median bends"),
        ] {
            let ours = Estimate { interval: Some(interval), ..Estimate::bare(value, "as it is", 9) };
            assert_eq!(effect(&ours.measures(quantity, subject)).unwrap(), words);
        }
        assert_eq!(effect(&Estimate::bare(3.0, "change of path cost in %", 9)), None);
    }

    #[test]
    fn a_percentage_has_the_digits_of_its_interval() {
        for (value, interval, text) in [
            (0.0058, [0.0055, 0.0060], "0.58 %"),
            (0.505, [0.470, 0.540], "51 %"),
            (1.0, [0.9965, 1.0], "100 %"),
        ] {
            let share = Estimate { interval: Some(interval), ..Estimate::bare(value, "share", 9) };
            assert_eq!(percentage(&share), text);
        }
    }
}
