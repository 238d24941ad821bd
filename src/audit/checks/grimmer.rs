//! Whether n values of a grain can have the printed mean and the printed deviation at once.

use super::arguments::{count, digits, shown, up_to_twice};
use super::{Entry, FromRelation, Proof, Test};
use crate::exact;
use crate::exact::{Exact, Print, Span, ceil, div, floor, mul, spelled, whole};
use crate::input::Input;
use crate::meaning::Divisor;
use crate::reach::{Asked, is_met};
use crate::relation::{Named as _, Relation};
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted};
use crate::witness::{Budget, Moments, Witness, counted, extremes};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grimmer",
    about: "can n values of a grain have the printed mean and the printed deviation at once?",
    example: "time [mean, integers, n=10] = 3.5 with time [sd] = 0.01",
    premises: "mean and deviation are of the same n values; each is a multiple of the grain; the deviation divides by n - 1 or n",
    source: "Anaya, The GRIMMER test, PeerJ Preprints 4:e2400v1 (2016); Allard, Analytic-GRIMMER (2018); exact by crate::reach",
    tests,
    relation: Some(FromRelation {
        keys: &["mean", "sd", "se", "n", "grain", "least", "most", "divisor"],
        build,
    }),
};

/// Mean and deviation of values on a grain.
pub(super) struct Moment {
    /// The deviation, then the mean.
    pub(super) numbers: [Quoted; 2],
    pub(super) n: u64,
    pub(super) grain: Exact,
    pub(super) ends: [Option<Exact>; 2],
    pub(super) divisor: Divisor,
    /// Whether the deviation is the mean's standard error.
    pub(super) is_error: bool,
    pub(super) values: String,
}

/// Sums of values that are looked through one by one.
const SUMS: i128 = 2000;

/// Steps that the search for values with one mean and deviation may take.
const STEPS: u64 = 5000;

/// Sums of squares that a certificate may list for one sum and one way to divide.
const GAPS: i128 = 500;

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    input.each_sample(&mut |sample| {
        if sample.trials.is_none()
            && !sample.is_binary()
            && let Some(test) = of_sample(sample)
        {
            give(Box::new(test));
        }
    });
}

/// The test of a sample's mean and deviation.
pub(super) fn of_sample(sample: &Sample) -> Option<Moment> {
    let (is_error, spread) = match sample.get(Statistic::Sd) {
        Some(sd) => (false, sd),
        None => (true, sample.get(Statistic::Se)?),
    };
    Some(Moment {
        numbers: [spread.clone(), sample.get(Statistic::Mean)?.clone()],
        n: sample.n?,
        grain: sample.grain?,
        ends: [sample.least, sample.most],
        divisor: sample.divisor,
        is_error,
        values: sample.values(),
    })
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let is_error = relation.has("se");
    let spread = relation.number(if is_error { "se" } else { "sd" }, input)?;
    let n = relation.needed("n")?;
    let grain = relation.exact("grain")?.unwrap_or(whole(1));
    if grain <= whole(0) {
        return Err(relation.fault("`grain` must be above 0"));
    }
    let divisor = match relation.word("divisor", &["either", "sample", "population"])? {
        "sample" => Divisor::Sample,
        "population" => Divisor::Population,
        _ => Divisor::Either,
    };
    let ends = [relation.exact("least")?, relation.exact("most")?];
    let values = format!("{n} values, each a multiple of {grain}");
    let numbers = [spread, relation.number("mean", input)?];
    Ok(Box::new(Moment { numbers, n, grain, ends, divisor, is_error, values }))
}

/// What the sum of squares has to be for one sum of values, all in grains.
struct Squares {
    n: u64,
    sum: i128,
    ends: [Option<i128>; 2],
    /// By each way to divide.
    windows: Vec<Span>,
    least: i128,
    most: Option<i128>,
}

impl Squares {
    /// The sums of squares that have the parity and lie between the extremes, by way to divide: first and last.
    fn plausible(&self) -> impl Iterator<Item = (i128, i128)> + '_ {
        self.windows.iter().filter_map(|window| {
            let (first, last) = window.integers();
            let first = first.max(self.least);
            let first = first + (first - self.sum).rem_euclid(2);
            let last = self.most.map_or(last, |most| last.min(most));
            (first <= last).then_some((first, last))
        })
    }

    /// Whether values have one of them; none if `steps` do not suffice.
    fn is_met(&self, steps: &mut u64) -> Option<bool> {
        let mut is_decided = true;
        for (first, last) in self.plausible() {
            for squares in (first..=last).step_by(2) {
                let asked = Asked { n: self.n, sum: self.sum, squares, ends: self.ends };
                match is_met(asked, steps) {
                    Some(true) => return Some(true),
                    Some(false) => *steps = steps.saturating_sub(1),
                    None => is_decided = false,
                }
                if *steps == 0 {
                    return None;
                }
            }
        }
        is_decided.then_some(false)
    }

    /// The plausible ones, of which none is met, for the proof; none if they are too many to write down.
    fn gaps(&self) -> Option<BTreeSet<i128>> {
        let all: Vec<(i128, i128)> = self.plausible().collect();
        let is_short = all.iter().all(|(first, last)| last - first < 2 * GAPS);
        is_short.then(|| all.iter().flat_map(|(first, last)| (*first..=*last).step_by(2)).collect())
    }
}

impl Moment {
    /// The least and the greatest sum of the values, in grains.
    fn sums(&self, mean: Print) -> Option<(i128, i128)> {
        let n = count(self.n);
        let (mut first, mut last) = mean.span().times(div(n, self.grain)?)?.integers();
        for (index, end) in self.ends.iter().enumerate() {
            let Some(end) = end else { continue };
            let sum = mul(div(*end, self.grain)?, n)?;
            if index == 0 { first = first.max(ceil(sum)) } else { last = last.min(floor(sum)) }
        }
        Some((first, last))
    }

    /// What sums of squares `spread` asks for, by sum; none if there are too many sums or digits.
    fn squares(&self, [spread, mean]: [Print; 2]) -> Option<Vec<Squares>> {
        let (first, last) = self.sums(mean)?;
        if last.checked_sub(first)? >= SUMS {
            return None;
        }
        let factor = if self.is_error { count(self.n) } else { whole(1) };
        let variance = spread.span().squared()?.times(div(factor, mul(self.grain, self.grain)?)?)?;
        let grains = |end: Option<Exact>| end.and_then(|end| div(end, self.grain));
        let ends = [grains(self.ends[0]).map(ceil), grains(self.ends[1]).map(floor)];
        let n = self.n;
        let mut all = Vec::new();
        for sum in first..=last {
            let centre = div(whole(sum.checked_mul(sum)?), count(self.n))?;
            let windows = self.divisors().into_iter().map(|divisor| {
                let about = variance.times(whole(divisor))?;
                about.plus(&Span::point(centre))
            });
            // A divisor of 0 (one value, n − 1) says nothing of the squares.
            let windows = windows.collect::<Option<Vec<_>>>()?;
            let (least, most) = extremes(self.n, sum, ends)?;
            all.push(Squares { n, sum, ends, windows, least, most });
        }
        Some(all)
    }

    fn divisors(&self) -> Vec<i128> {
        let n = i128::from(self.n);
        let all = match self.divisor {
            Divisor::Sample => vec![n - 1],
            Divisor::Population => vec![n],
            Divisor::Either => vec![n - 1, n],
        };
        all.into_iter().filter(|divisor| *divisor > 0).collect()
    }

    fn both(prints: &[Print]) -> [Print; 2] {
        [prints[0], prints[1]]
    }

    fn step(squares: &Squares) -> Option<Value> {
        Some(json!({
            "sum": squares.sum.to_string(),
            "windows": squares.windows.iter().map(exact::span).collect::<Vec<_>>(),
            "least": squares.least.to_string(),
            "most": squares.most.map(|most| most.to_string()),
            "not_met": squares.gaps()?.iter().map(ToString::to_string).collect::<Vec<_>>(),
        }))
    }
}

impl Test for Moment {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        if self.divisors().is_empty() || prints[0].span().not_negative().is_empty() {
            return if self.divisors().is_empty() { None } else { Some(false) };
        }
        let all = self.squares(Self::both(prints))?;
        let mut steps = STEPS;
        let met: Vec<Option<bool>> = all.iter().map(|squares| squares.is_met(&mut steps)).collect();
        if met.contains(&Some(true)) { Some(true) } else { (!met.contains(&None)).then_some(false) }
    }

    fn said(&self, prints: &[Print], is_possible: bool) -> String {
        let [spread, mean] = Self::both(prints).map(|print| print.printed);
        let what = if self.is_error { "standard error" } else { "standard deviation" };
        if is_possible {
            return format!("{mean} with {what} {spread} is what {} can have", self.values);
        }
        let mut said = format!("{} have no mean {mean} with {what} {spread}", self.values);
        if let Some(least) = self.least_deviation(prints[1]) {
            said +=
                &format!("; with this mean the least is {}", shown(least, spread.decimals() as usize + 2));
        }
        said
    }

    fn premises(&self) -> Vec<String> {
        let divisor = match self.divisor {
            Divisor::Sample => "n − 1",
            Divisor::Population => "n",
            Divisor::Either => "n − 1 or n",
        };
        vec![
            format!("mean and deviation are of the same {}; the deviation divides by {divisor}", self.values),
            digits(&self.numbers),
        ]
    }

    fn window(&self) -> Option<[Exact; 2]> {
        up_to_twice(self.numbers[0].print)
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let all = self.squares(Self::both(prints))?;
        let end = |end: Option<Exact>| end.map(spelled);
        let given = json!({
            "n": self.n.to_string(),
            "grain": spelled(self.grain),
            "least": end(self.ends[0]),
            "most": end(self.ends[1]),
            "divisors": self.divisors().iter().map(ToString::to_string).collect::<Vec<_>>(),
            "is_error": self.is_error,
        });
        let steps = all.iter().map(Self::step).collect::<Option<Vec<_>>>()?;
        Some(Proof { given, steps: Value::Array(steps) })
    }

    fn witness(&self, prints: &[Print], budget: &mut Budget) -> Option<Witness> {
        if self.n > 2000 {
            return None;
        }
        let all = self.squares(Self::both(prints))?;
        let before = budget.steps;
        let mut vectors: Vec<String> = Vec::new();
        let most = budget.most;
        let mut is_all = true;
        for squares in &all {
            for (first, last) in squares.plausible() {
                for sum in (first..=last).step_by(2) {
                    let moments = self.moments(squares.sum, sum);
                    is_all &= moments.search(budget, &mut |vector| {
                        let said = counted(vector, |value| {
                            mul(self.grain, whole(value)).map_or_else(String::new, spelled)
                        });
                        if !vectors.contains(&said) {
                            vectors.push(said);
                        }
                        vectors.len() < most
                    });
                    if !is_all {
                        return Some(Witness { vectors, is_all, steps: [before - budget.steps, before] });
                    }
                }
            }
        }
        Some(Witness { vectors, is_all, steps: [before - budget.steps, before] })
    }
}

impl Moment {
    fn moments(&self, sum: i128, squares: i128) -> Moments {
        let reach = squares.isqrt();
        let grains = |end: Option<Exact>| end.and_then(|end| div(end, self.grain));
        let least = grains(self.ends[0]).map_or(-reach, ceil).max(-reach);
        let most = grains(self.ends[1]).map_or(reach, floor).min(reach);
        Moments { n: self.n, least, most, sum, squares }
    }

    /// The least deviation that values with this mean have, by the greatest divisor, rounded down in the sixth digit.
    fn least_deviation(&self, mean: Print) -> Option<Exact> {
        let (first, last) = self.sums(mean)?;
        let divisor = *self.divisors().last()?;
        let n = count(self.n);
        let of = |sum: i128| -> Option<f64> {
            let (least, _) = extremes(self.n, sum, [None, None])?;
            let about = whole(least) - div(whole(sum.checked_mul(sum)?), n)?;
            let factor = if self.is_error { n } else { whole(1) };
            let variance = div(about, mul(whole(divisor), factor)?)?;
            Some((*variance.numer() as f64 / *variance.denom() as f64).sqrt())
        };
        let sums = (first..=last.min(first.checked_add(SUMS)?)).map(of).collect::<Option<Vec<_>>>()?;
        let least = sums.into_iter().min_by(f64::total_cmp)?;
        let scaled = Exact::new((least * 1e6) as i128, 1_000_000);
        mul(scaled, self.grain)
    }
}
