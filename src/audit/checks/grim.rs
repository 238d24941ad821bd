//! Whether a mean of whole numbers, or a share of trials, can be the printed one, given how many there were.

use super::arguments::{count, digits, each_of_sample, gap, multiple, shown};
use super::keys::{GRAIN, LEAST, MOST, N};
use super::{Entry, FromRelation, Proof, Test, Window};
use crate::input::{Input, Relation};
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted};
use crate::witness::{Budget, Witness};
use proofs::exact::{Exact, Print, Span, div, float, mul, spelled, whole};
use proofs::printed::Digits;
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grim",
    about: "can a mean of whole numbers, or a share of trials, be what is printed, given n?",
    example: "success [% of 250] = 33.3",
    premises: "n is the number of values behind the mean; each is a multiple of the grain; none is left out or weighted",
    source: "Brown & Heathers, The GRIM Test, Social Psychological and Personality Science 8 (2017) 363-369 (preprint 2016)",
    tests: |input, give| each_of_sample(input, of_sample, give),
    relation: Some(FromRelation {
        keys: &[
            ("value", "The mean or share, in quotes: the printed number, or the name of a cell."),
            N,
            (
                "whole",
                "What a success counts where the number is a share: 100 of per cent, or 1; left out where it is a mean.",
            ),
            GRAIN,
            LEAST,
            MOST,
        ],
        build,
    }),
};

struct Grim {
    numbers: [Quoted; 1],
    /// Printed values are multiples of this …
    step: Exact,
    /// … that many values are behind it …
    n: u64,
    /// … each a multiple of this …
    grain: Exact,
    /// … whose sum is printed, or else their mean …
    is_count: bool,
    /// … and they lie between these ends.
    value_ends: [Option<Exact>; 2],
    /// What is printed lies between these.
    ends: [Option<Exact>; 2],
    /// The only count that there can be, where `29/30` stands beside the number.
    successes: Option<u64>,
    values: String,
}

fn of_sample(sample: &Sample) -> Option<Grim> {
    let n = sample.n?;
    let grain = sample.grain?;
    let number = sample.get(Statistic::Mean)?.clone();
    let (step, factor) = if sample.is_count { (grain, count(n)) } else { (div(grain, count(n))?, whole(1)) };
    let value_ends = [sample.least, sample.most];
    let ends = value_ends.map(|end| end.and_then(|end| mul(end, factor)));
    let numbers = [number];
    let is_count = sample.is_count;
    let successes = sample.successes;
    let values = sample.values();
    Some(Grim { numbers, step, n, grain, is_count, value_ends, ends, successes, values })
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let n = relation.needed("n")?;
    let whole_is = relation.exact("whole")?;
    let grain = whole_is.or(relation.exact("grain")?).unwrap_or(whole(1));
    let step = Some(grain).filter(|grain| *grain > whole(0)).and_then(|grain| div(grain, count(n)));
    let step = step.ok_or_else(|| relation.fault("`grain` and `whole` must be above 0"))?;
    if let (Some(_), Some(key)) =
        (whole_is, ["grain", "least", "most"].into_iter().find(|key| relation.has(key)))
    {
        let message = format!(
            "`whole` and `{key}` contradict each other: behind a share stands 0 or the whole; leave one out"
        );
        return Err(relation.fault(message));
    }
    let ends = whole_is.map_or_else(|| relation.ends(), |end| Ok([Some(whole(0)), Some(end)]))?;
    let values = format!("{n} values, each a multiple of {grain}");
    let numbers = [relation.number("value", input)?];
    Ok(Box::new(Grim {
        numbers,
        step,
        n,
        grain,
        is_count: false,
        value_ends: ends,
        ends,
        successes: None,
        values,
    }))
}

impl Grim {
    /// The printed number's span, cut to where the mean can be.
    fn span(&self, print: Print) -> Span {
        print.span().cut(self.ends)
    }

    fn counts(&self, print: Print) -> Option<(i128, i128)> {
        let span = self.span(print);
        if span.is_empty() { Some((1, 0)) } else { Some(span.times(self.step.recip())?.integers()) }
    }
}

/// What programs make of a mean of `count` grains in floats, by the order in which they multiply and divide.
fn floats(count: Exact, grim: &Grim) -> [f64; 2] {
    let count = float(count);
    let n = grim.n as f64;
    let grain = float(grim.grain);
    [count / n * grain, count * grain / n]
}

/// Whether digits that are cut off, or rounded up or down, end as `print` does if floats move the point.
fn is_printed_by(float: f64, print: Print) -> bool {
    let scaled = float * print.printed.scale() as f64;
    let units = print.printed.units() as f64;
    let [cut, down, up] = [scaled.trunc(), scaled.floor(), scaled.ceil()].map(|end| end == units);
    match print.digits {
        Digits::Any => cut || down || up,
        Digits::Truncated | Digits::Unknown => cut,
        Digits::Floor => down,
        Digits::Ceiling => up,
        Digits::Rounded | Digits::HalfUp | Digits::HalfEven => false,
    }
}

impl Test for Grim {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let (first, last) = self.counts(prints[0])?;
        Some(self.successes.map_or(first <= last, |k| (first..=last).contains(&i128::from(k))))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let printed = prints[0].printed;
        let (first, last) = self.counts(prints[0]).unwrap_or((1, 0));
        let places = printed.decimals() as usize + 2;
        let at = |k: i128| format!("{k} × {} = {}", shown(self.step, 6), multiple(self.step, k, places));
        if let Some(k) = self.successes {
            let verb = if is_possible { "is" } else { "is not" };
            return format!(
                "{printed} {verb} {k} of {}, which is {}",
                self.n,
                multiple(self.step, i128::from(k), places)
            );
        }
        if is_possible {
            let more = if last > first { format!(" to {last}") } else { String::new() };
            return format!("{printed} is printed by {}{more}", at(first));
        }
        if self.span(prints[0]).is_empty() {
            return format!("{printed} is outside of what {} can give", self.values);
        }
        format!("{printed} is the mean of no {}: next to it are {} and {}", self.values, at(last), at(first))
    }

    fn premises(&self) -> Vec<String> {
        vec![
            format!("the number is made of {}; none is left out and none is weighted", self.values),
            digits(&self.numbers),
        ]
    }

    fn window(&self) -> Option<Window> {
        Some(Window {
            ends: [self.ends[0]?, self.ends[1]?],
            why: "all that values between the ends can print",
        })
    }

    fn power_key(&self) -> Option<String> {
        self.window().map(|window| format!("{} {:?} {window:?}", self.step, self.successes))
    }

    fn float_slip(&self, prints: &[Print]) -> Option<String> {
        let print = prints[0];
        let unit = Exact::new(1, i128::from(print.printed.scale()));
        [unit, -unit].into_iter().find_map(|by| {
            let mean = print.value() + by;
            let count = div(mean, self.step).filter(|count| *count.denom() == 1 && !self.is_count)?;
            let is_inside = Span::point(mean).cut(self.ends) == Span::point(mean);
            let float = floats(count, self).into_iter().find(|float| is_inside && is_printed_by(*float, print))?;
            let mean = shown(mean, 6);
            Some(format!("no proof: a program that cuts off or rounds up {float}, which floats make of {mean}, prints it"))
        })
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        // That the fraction is of the same trials is no printed number.
        let span = Some(self.span(prints[0])).filter(|_| self.successes.is_none())?;
        let end = |end: Option<Exact>| end.map(spelled);
        let given = json!({
            "n": self.n.to_string(),
            "grain": spelled(self.grain),
            "is_count": self.is_count,
            "least": end(self.value_ends[0]),
            "most": end(self.value_ends[1]),
        });
        let [least, most] = self.ends;
        let outside = || json!([{ "outside": [end(least), end(most)] }]);
        let steps = if span.is_empty() { outside() } else { json!([gap(&span, self.step)?]) };
        Some(Proof { given, steps })
    }

    fn witness(&self, prints: &[Print], budget: &mut Budget) -> Option<Witness> {
        let (first, last) = self.counts(prints[0])?;
        let before = budget.steps;
        let mut vectors = Vec::new();
        let mut k = first;
        while k <= last && vectors.len() < budget.most && budget.step() {
            vectors.push(format!("{k} × {} of {}", spelled(self.step), self.n));
            k += 1;
        }
        Some(Witness { vectors, is_all: k > last, steps: [before - budget.steps, before] })
    }
}
