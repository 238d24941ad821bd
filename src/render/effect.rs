//! Estimates in words, with their direction.

use crate::analysis::metric::Metric;
use crate::analysis::verdict::Estimate;

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
    /// That of an estimate, from the name of its measure.
    pub fn new(estimate: &Estimate) -> Self {
        let what = estimate.what.as_str();
        let change = what.strip_prefix("change of ").and_then(|rest| rest.split_once(" in %"));
        if let Some((metric, _)) = change {
            return Self::of_change(metric, estimate, |value| value);
        }
        let ratio = what.strip_prefix("ratio of the means of ").and_then(|rest| rest.split_once(", "));
        if let Some((metric, _)) = ratio {
            return Self::of_change(metric, estimate, |value| 100.0 * (value - 1.0));
        }
        if what.starts_with("share of ") {
            return Self::scaled(estimate, |value| 100.0 * value, " %".to_owned());
        }
        if what.contains("difference in points") {
            let words = if estimate.value < 0.0 { " points fewer" } else { " points more" };
            return Self::scaled(estimate, f64::abs, words.to_owned());
        }
        if let Some(rest) = what.strip_prefix("% of the other's ") {
            let metric = rest.split(", ").next().unwrap_or(rest);
            return Self::scaled(estimate, |value| value, format!(" % of the other's {metric}"));
        }
        Self::scaled(estimate, |value| value, String::new())
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
    } else if metric.ends_with('s') {
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
        for (value, interval, what, words) in [
            (
                -2.156,
                [-2.393, -1.921],
                "change of path cost in %, bootstrap 95 % over instances",
                "2.2 % shorter",
            ),
            (0.412, [0.219, 0.661], "change of path length in %, bootstrap 95 %", "0.4 % longer"),
            (15.15, [13.38, 17.04], "change of opened nodes in %, bootstrap 95 %", "15 % more nodes"),
            (-62.7, [-64.4, -61.1], "change of turn sum, exterior angles in %, 95 %", "63 % less turn sum"),
            (0.9169, [0.9153, 0.9185], "ratio of the means of path length, bootstrap 95 %", "8.3 % shorter"),
            (0.534, [0.498, 0.569], "share of trials solved, 95 %", "53 %"),
            (0.505, [0.470, 0.540], "share of trials solved, 95 %", "51 %"),
            (1.0, [0.994, 1.0], "share of instances, 95 %", "100 %"),
            (18.15, [14.4, 21.9], "least mean difference in points, at samples=1500", "18 points more"),
        ] {
            let estimate = Estimate { interval: Some(interval), ..Estimate::bare(value, what, 9) };
            assert_eq!(effect(&estimate).unwrap(), words);
        }
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
