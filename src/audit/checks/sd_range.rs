//! Whether a deviation is possible between the least and the greatest value.

use super::arguments::{count, digits, shown, spreads};
use super::{Entry, Proof, Test, Window};
use crate::input::Input;
use crate::meaning::Divisor;
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::Quoted;
use proofs::exact::{Exact, Print, Span, add, div, float, mul, spelled, sub, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sd_range",
    about: "is SD² ≤ (max − mean)(mean − min), not too small for the range, and not below 0?",
    example: "mean 2.0, sd 3.0, min 1.0, max 4.0",
    premises: "all four are of the same values; the least and the greatest printed are among them",
    source: "Bhatia & Davis, American Mathematical Monthly 107 (2000) 353-357; Nagy (1918) for the lower bound",
    tests,
    relation: None,
};

struct SdRange {
    /// Deviation, mean, and the least and the greatest where they are printed.
    numbers: Vec<Quoted>,
    /// The ends where they are only known.
    ends: Option<[Exact; 2]>,
    n: Option<u64>,
    divisor: Divisor,
}

/// A deviation that is printed below 0; no mean and no range is needed to refuse it.
struct Negative {
    numbers: [Quoted; 1],
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    input.each_sample(&mut |sample| {
        let negative =
            [Statistic::Sd, Statistic::Se].into_iter().filter_map(|statistic| sample.get(statistic));
        for number in negative.filter(|number| is_negative(number.print)) {
            give(Box::new(Negative { numbers: [number.clone()] }));
        }
        if let Some(test) = of_sample(sample) {
            give(Box::new(test));
        }
    });
}

fn of_sample(sample: &Sample) -> Option<SdRange> {
    let sd = sample.get(Statistic::Sd).filter(|sd| !is_negative(sd.print))?;
    let mut numbers = vec![sd.clone(), sample.get(Statistic::Mean)?.clone()];
    let ends = match (sample.get(Statistic::Min), sample.get(Statistic::Max)) {
        (Some(min), Some(max)) => {
            numbers.extend([min.clone(), max.clone()]);
            None
        }
        _ if sample.is_count => return None,
        _ => Some([sample.least?, sample.most?]),
    };
    Some(SdRange { numbers, ends, n: sample.n.filter(|n| *n > 1), divisor: sample.divisor })
}

/// Whether every value that prints so is below 0.
fn is_negative(print: Print) -> bool {
    print.span().not_negative().is_empty()
}

impl SdRange {
    fn range(&self, prints: &[Print]) -> [Span; 2] {
        match self.ends {
            Some(ends) => ends.map(Span::point),
            None => [prints[2].span(), prints[3].span()],
        }
    }

    /// By how much the variance may exceed the population's.
    fn factor(&self) -> Option<Exact> {
        match (self.divisor, self.n) {
            (Divisor::Population, _) => Some(whole(1)),
            (_, Some(n)) => div(count(n), count(n - 1)),
            (_, None) => Some(whole(2)),
        }
    }

    /// The greatest variance there can be.
    fn most(&self, prints: &[Print]) -> Option<Exact> {
        let [min, max] = self.range(prints);
        let mean = prints[1].span();
        let centre = div(add(min.low, max.high)?, whole(2))?;
        let at = centre.max(mean.low).min(mean.high);
        let product = mul(sub(max.high, at)?, sub(at, min.low)?)?;
        mul(product.max(whole(0)), self.factor()?)
    }

    /// The least variance there can be if both ends are attained; `None` if that is not known.
    fn least(&self, prints: &[Print]) -> Option<Exact> {
        let (n, None) = (self.n?, self.ends) else { return None };
        let [min, max] = self.range(prints);
        let range = sub(max.low, min.high)?.max(whole(0));
        let divisor = if self.divisor == Divisor::Sample { n - 1 } else { n };
        div(mul(range, range)?, mul(whole(2), count(divisor))?)
    }
}

impl Test for SdRange {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        if is_negative(prints[0]) {
            return Some(false);
        }
        let squared = prints[0].span().squared()?;
        let is_enough = self.least(prints).is_none_or(|least| least <= squared.high);
        Some(squared.low <= self.most(prints)? && is_enough)
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let sd = prints[0].printed;
        let places = sd.decimals() as usize + 2;
        let end = |value: Option<Exact>| {
            value.map_or("?".to_owned(), |value| format!("{:.places$}", float(value).sqrt()))
        };
        let [min, max] = self.range(prints);
        let verb = if is_possible { "is within" } else { "is outside" };
        let least = self.least(prints).map_or("0".to_owned(), |least| end(Some(least)));
        format!(
            "deviation {sd} {verb} {least} to {}, which mean {} between {} and {} allows",
            end(self.most(prints)),
            prints[1].printed,
            shown(min.low, 6),
            shown(max.high, 6)
        )
    }

    fn premises(&self) -> Vec<String> {
        let n = self.n.map_or(String::new(), |n| format!(" {n}"));
        vec![format!("mean, deviation and range are of the same{n} values"), digits(&self.numbers)]
    }

    fn window(&self) -> Option<Window> {
        let prints: Vec<Print> = self.numbers.iter().map(|number| number.print).collect();
        let [min, max] = self.range(&prints);
        spreads(prints[0], [min.low, max.high.max(min.low)], self.factor()?)
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let given = json!({
            "n": self.n.map(|n| n.to_string()),
            "divisor": match self.divisor {
                Divisor::Sample => "sample",
                Divisor::Population => "population",
                Divisor::Either => "either",
            },
            "ends": self.ends.map(|ends| ends.map(spelled)),
        });
        let squared = prints[0].span().squared()?;
        let most = self.most(prints)?;
        let steps = if squared.low > most {
            json!([{ "squared_at_least": spelled(squared.low), "most": spelled(most) }])
        } else {
            json!([{ "squared_at_most": spelled(squared.high), "least": spelled(self.least(prints)?) }])
        };
        Some(Proof { given, steps })
    }
}

impl Test for Negative {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(!is_negative(prints[0]))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let verb = if is_possible { "is not below 0" } else { "is below 0, as no deviation is" };
        format!("{} {verb}", prints[0].printed)
    }

    fn premises(&self) -> Vec<String> {
        vec!["the number is a deviation or standard error".to_owned(), digits(&self.numbers)]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let given = json!({ "n": null, "divisor": "either", "ends": null });
        Some(Proof { given, steps: json!([{ "at_most": spelled(prints[0].span().high) }]) })
    }
}
