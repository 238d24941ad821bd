//! Whether n values of a grain can have the printed mean and the printed deviation at once.

use super::arguments::{count, digits, each_of_sample, json_span, shown, spreads, up_to_twice};
use super::keys::{DIVISOR, GRAIN, LEAST, MEAN, MOST, N, SD, SE};
use super::{Entry, FromRelation, Proof, Test, Window};
use crate::input::{Input, Relation};
use crate::meaning::Divisor;
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted};
use crate::witness::{Budget, Moments, Witness, counted};
use proofs::exact::{Exact, Print, Span, ceil, div, float, floor, mul, spelled, whole};
use proofs::reach::{SumQuery, extremes, is_met};
use serde_json::{Value, json};
use std::cell::Cell;
use std::collections::BTreeSet;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grimmer",
    about: "can n values of a grain have the printed mean and the printed deviation at once?",
    example: "time [mean, integers, n=10] = 3.5 with time [sd] = 0.01",
    premises: "mean and deviation, and the least and greatest value if they are printed, are of the same n values; each is a multiple of the grain; the deviation divides by n - 1 or n",
    source: "Anaya, The GRIMMER test, PeerJ Preprints 4:e2400v1 (2016); Allard, Analytic-GRIMMER (2018); exact by proofs::reach",
    tests,
    relation: Some(FromRelation { keys: &[MEAN, SD, SE, N, GRAIN, LEAST, MOST, DIVISOR], build }),
};

/// Mean and deviation of values on a grain.
pub(super) struct Moment {
    /// The deviation, the mean, and the least and the greatest value where they are printed.
    numbers: Vec<Quoted>,
    n: u64,
    grain: Exact,
    /// The bounds that an annotation gives to the values …
    ends: [Option<Exact>; 2],
    /// … and which numbers are the least and the greatest.
    printed_ends: [Option<usize>; 2],
    divisor: Divisor,
    /// Whether the deviation is the mean's standard error.
    is_error: bool,
    values: String,
    steps: Cell<u64>,
}

/// Sums of values that are looked through one by one.
const SUMS: i128 = 2000;

/// Steps that the search for values with one mean and deviation may take.
const STEPS: u64 = 5000;

/// Sums of squares that a certificate may list for one sum and one way to divide.
const GAPS: i128 = 500;

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    let is_meant = |sample: &Sample| sample.trials.is_none() && !sample.is_binary();
    each_of_sample(input, |sample| of_sample(sample).filter(|_| is_meant(sample)), give);
}

/// The test of a sample's mean and deviation.
pub(super) fn of_sample(sample: &Sample) -> Option<Moment> {
    let (is_error, spread) = match sample.get(Statistic::Sd) {
        Some(sd) => (false, sd),
        None => (true, sample.get(Statistic::Se)?),
    };
    let mut numbers = vec![spread.clone(), sample.get(Statistic::Mean)?.clone()];
    let printed_ends = [Statistic::Min, Statistic::Max].map(|end| {
        numbers.push(sample.get(end)?.clone());
        Some(numbers.len() - 1)
    });
    Some(Moment {
        numbers,
        n: sample.n?,
        grain: sample.grain?,
        ends: [sample.least, sample.most],
        printed_ends,
        divisor: sample.divisor,
        is_error,
        values: sample.values(),
        steps: Cell::default(),
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
    let ends = relation.ends()?;
    let values = format!("{n} values, each a multiple of {grain}");
    let numbers = vec![spread, relation.number("mean", input)?];
    let printed_ends = [None; 2];
    Ok(Box::new(Moment {
        numbers,
        n,
        grain,
        ends,
        printed_ends,
        divisor,
        is_error,
        values,
        steps: Cell::default(),
    }))
}

/// The least and the greatest value, in grains, where there are such.
type Ends = [Option<i128>; 2];

/// What the sum of squares has to be for one sum of values, all in grains.
struct Squares {
    n: u64,
    sum: i128,
    ends: Ends,
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

    /// Whether values have one of them; `None` if `steps` do not suffice.
    fn is_met(&self, steps: &mut u64) -> Option<bool> {
        let mut is_decided = true;
        for (first, last) in self.plausible() {
            for squares in (first..=last).step_by(2) {
                let query = SumQuery { n: self.n, sum: self.sum, squares, ends: self.ends };
                match is_met(query, steps) {
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

    /// The plausible sums of squares, for the proof; `None` if they are too many to write down. No sample attains any of them.
    fn gaps(&self) -> Option<BTreeSet<i128>> {
        let all: Vec<(i128, i128)> = self.plausible().collect();
        let is_short = all.iter().all(|(first, last)| last - first < 2 * GAPS);
        is_short.then(|| all.iter().flat_map(|(first, last)| (*first..=*last).step_by(2)).collect())
    }
}

impl Moment {
    /// The least and the greatest sum of the values, in grains, between ends.
    fn sums(&self, mean: Print, [least, most]: Ends) -> Option<(i128, i128)> {
        let n = i128::from(self.n);
        let (mut first, mut last) = mean.span().times(div(whole(n), self.grain)?)?.integers();
        if let Some(least) = least {
            first = first.max(least.checked_mul(n)?);
        }
        if let Some(most) = most {
            last = last.min(most.checked_mul(n)?);
        }
        Some((first, last))
    }

    /// The bounds of the values, in grains: those that an annotation gives, and those that the printed ends allow at most.
    fn ends(&self, prints: &[Print]) -> Option<Ends> {
        let grains = |end: Option<Exact>| end.map_or(Some(None), |end| Some(Some(div(end, self.grain)?)));
        let printed = |at: Option<usize>| {
            at.map_or(Some(None), |at| Some(Some(prints[at].span().times(self.grain.recip())?.integers())))
        };
        let least = [grains(self.ends[0])?.map(ceil), printed(self.printed_ends[0])?.map(|(first, _)| first)];
        let most = [grains(self.ends[1])?.map(floor), printed(self.printed_ends[1])?.map(|(_, last)| last)];
        Some([least.into_iter().flatten().max(), most.into_iter().flatten().min()])
    }

    /// What sums of squares the deviation asks for, by sum; `None` if there are too many sums or digits.
    fn squares(&self, prints: &[Print]) -> Option<Vec<Squares>> {
        let ends = self.ends(prints)?;
        let (first, last) = self.sums(prints[1], ends)?;
        if last.checked_sub(first)? >= SUMS {
            return None;
        }
        let factor = if self.is_error { count(self.n) } else { whole(1) };
        let variance = prints[0].span().squared()?.times(div(factor, mul(self.grain, self.grain)?)?)?;
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
        self.divisor.values(self.n.into())
    }

    fn step(squares: &Squares) -> Option<Value> {
        Some(json!({
            "sum": squares.sum.to_string(),
            "windows": squares.windows.iter().map(json_span).collect::<Vec<_>>(),
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
        let all = self.squares(prints)?;
        let mut steps = STEPS;
        let met: Vec<Option<bool>> = all.iter().map(|squares| squares.is_met(&mut steps)).collect();
        self.steps.set(self.steps.get() + all.len() as u64 + STEPS - steps);
        if met.contains(&Some(true)) { Some(true) } else { (!met.contains(&None)).then_some(false) }
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let [spread, mean] = [prints[0], prints[1]].map(|print| print.printed);
        let what = if self.is_error { "standard error" } else { "standard deviation" };
        if is_possible {
            return format!(
                "{mean} with {what} {spread} is what {}{} can have",
                self.values,
                self.between(prints)
            );
        }
        let mut text =
            format!("{}{} have no mean {mean} with {what} {spread}", self.values, self.between(prints));
        if let Some(least) = self.least_deviation(prints[1]) {
            text +=
                &format!("; with this mean the least is {}", shown(least, spread.decimals() as usize + 2));
        }
        text
    }

    fn premises(&self) -> Vec<String> {
        let divisor = match self.divisor {
            Divisor::Sample => "n − 1",
            Divisor::Population => "n",
            Divisor::Either => "n − 1 or n",
        };
        vec![
            format!(
                "{} are of the same {}; the deviation divides by {divisor}",
                self.statistics(),
                self.values
            ),
            digits(&self.numbers),
        ]
    }

    fn window(&self) -> Option<Window> {
        let prints: Vec<Print> = self.numbers.iter().map(|number| number.print).collect();
        let [Some(least), Some(most)] = self.ends(&prints)? else { return up_to_twice(prints[0]) };
        let ends = [mul(self.grain, whole(least))?, mul(self.grain, whole(most.max(least)))?];
        let by = if self.is_error { whole(1) } else { count(self.n) };
        spreads(prints[0], ends, div(by, whole(*self.divisors().first()?))?)
    }

    fn undecided(&self, _prints: &[Print]) -> String {
        if self.divisors().is_empty() {
            return "one value has no sample deviation".to_owned();
        }
        format!("more than {SUMS} sums, {STEPS} steps of search, or too many digits for exact arithmetic")
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let all = self.squares(prints)?;
        let end = |end: Option<Exact>| end.map(spelled);
        let given = json!({
            "n": self.n.to_string(),
            "grain": spelled(self.grain),
            "least": end(self.ends[0]),
            "most": end(self.ends[1]),
            "printed_ends": self.printed_ends,
            "divisors": self.divisors().iter().map(ToString::to_string).collect::<Vec<_>>(),
            "is_error": self.is_error,
        });
        let steps = all.iter().map(Self::step).collect::<Option<Vec<_>>>()?;
        Some(Proof { given, steps: Value::Array(steps) })
    }

    fn steps_taken(&self) -> Option<u64> {
        Some(self.steps.get())
    }

    fn witness(&self, prints: &[Print], budget: &mut Budget) -> Option<Witness> {
        if self.n > 2000 {
            return None;
        }
        let all = self.squares(prints)?;
        let ends = self.ends(prints)?;
        let before = budget.steps;
        let mut vectors: Vec<String> = Vec::new();
        let most = budget.most;
        let mut is_all = true;
        for squares in &all {
            for (first, last) in squares.plausible() {
                for sum in (first..=last).step_by(2) {
                    let moments = self.moments(ends, squares.sum, sum);
                    is_all &= moments.search(budget, &mut |vector| {
                        let text = counted(vector, |value| {
                            mul(self.grain, whole(value)).map_or_else(String::new, spelled)
                        });
                        if !vectors.contains(&text) {
                            vectors.push(text);
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
    /// The statistics that it is about, in words.
    fn statistics(&self) -> String {
        let names = ["least value", "greatest value"].into_iter().zip(self.printed_ends);
        let ends: Vec<&str> = names.filter_map(|(name, at)| at.map(|_| name)).collect();
        if ends.is_empty() {
            "mean and deviation".to_owned()
        } else {
            format!("mean, deviation, {}", ends.join(", "))
        }
    }

    /// The printed ends, in words.
    fn between(&self, prints: &[Print]) -> String {
        match self.printed_ends.map(|at| at.map(|at| prints[at].printed)) {
            [None, None] => String::new(),
            [Some(least), None] => format!(", {least} the least,"),
            [None, Some(most)] => format!(", {most} the greatest,"),
            [Some(least), Some(most)] => format!(", {least} the least and {most} the greatest,"),
        }
    }

    fn moments(&self, ends: Ends, sum: i128, squares: i128) -> Moments {
        let reach = squares.isqrt();
        let least = ends[0].map_or(-reach, |least| least.max(-reach));
        let most = ends[1].map_or(reach, |most| most.min(reach));
        Moments { n: self.n, least, most, sum, squares }
    }

    /// The least deviation that values with this mean have, by the greatest divisor, rounded down in the sixth digit.
    fn least_deviation(&self, mean: Print) -> Option<Exact> {
        let (first, last) = self.sums(mean, [None, None])?;
        let divisor = *self.divisors().last()?;
        let n = count(self.n);
        let of = |sum: i128| -> Option<f64> {
            let (least, _) = extremes(self.n, sum, [None, None])?;
            let about = whole(least) - div(whole(sum.checked_mul(sum)?), n)?;
            let factor = if self.is_error { n } else { whole(1) };
            let variance = div(about, mul(whole(divisor), factor)?)?;
            Some(float(variance).sqrt())
        };
        let sums = (first..=last.min(first.checked_add(SUMS)?)).map(of).collect::<Option<Vec<_>>>()?;
        let least = sums.into_iter().min_by(f64::total_cmp)?;
        let scaled = Exact::new((least * 1e6) as i128, 1_000_000);
        mul(scaled, self.grain)
    }
}
