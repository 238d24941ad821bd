//! Whether values on a grain can have the printed quantile.

use super::arguments::{count, digits, gap, shown};
use super::{Entry, Proof, Test};
use crate::input::Input;
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::Quoted;
use proofs::exact::{Exact, Print, add, mul, spelled, whole};
use serde_json::{Value, json};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "quantile",
    about: "can a quantile of n whole numbers be what is printed?",
    example: "median of 11 whole numbers = 3.5",
    premises: "values are multiples of the grain; the quantile is one of the nine usual ones, or linear if the header states it",
    source: "Hyndman & Fan, The American Statistician 50 (1996) 361-365",
    tests,
    relation: None,
};

struct Quantile {
    numbers: [Quoted; 1],
    n: u64,
    /// The share, in ten-thousandths; 0 and 10000 for the ends.
    parts: u32,
    grain: Exact,
    is_linear: bool,
    values: String,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    input.each_sample(&mut |sample| of_sample(sample, give));
}

fn of_sample(sample: &Sample, give: &mut dyn FnMut(Box<dyn Test>)) {
    let (Some(n), Some(grain)) = (sample.n, sample.grain) else { return };
    for (statistic, number) in &sample.numbers {
        let parts = match statistic {
            Statistic::Min => 0,
            Statistic::Quantile(parts) => *parts,
            Statistic::Max => 10_000,
            _ => continue,
        };
        let numbers = [number.clone()];
        give(Box::new(Quantile {
            numbers,
            n,
            parts,
            grain,
            is_linear: sample.is_linear,
            values: sample.values(),
        }));
    }
}

impl Quantile {
    /// What quantiles can be multiples of, by each rule: the grain over the denominator of the place between two values.
    fn steps(&self) -> Option<Vec<Exact>> {
        if [0, 10_000].contains(&self.parts) {
            return Some(vec![self.grain]);
        }
        let n = count(self.n);
        let share = Exact::new(i128::from(self.parts), 10_000);
        // Hyndman and Fan's rules 4 to 9 put the quantile at place n p + m.
        let linear = add(whole(1), mul(share, whole(-1))?)?;
        let mut offsets = vec![linear];
        if !self.is_linear {
            let third = Exact::new(1, 3);
            offsets.extend([whole(0), Exact::new(1, 2), share]);
            offsets.push(mul(add(share, whole(1))?, third)?);
            offsets.push(add(mul(share, Exact::new(1, 4))?, Exact::new(3, 8))?);
        }
        // Rules 1 and 3 take a value; rule 2 takes the middle of two where n p is whole.
        let place = mul(n, share)?;
        let is_middle = !self.is_linear && *place.denom() == 1;
        let mut denominators =
            if self.is_linear { Vec::new() } else { vec![1, if is_middle { 2 } else { 1 }] };
        for offset in offsets {
            denominators.push(*add(place, offset)?.denom());
        }
        denominators.sort_unstable();
        denominators.dedup();
        denominators.into_iter().map(|denominator| mul(self.grain, Exact::new(1, denominator))).collect()
    }
}

impl Test for Quantile {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let span = prints[0].span();
        let found =
            self.steps()?.into_iter().map(|step| span.has_multiple_of(step)).collect::<Option<Vec<_>>>()?;
        Some(found.contains(&true))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let finest = self.steps().and_then(|steps| steps.into_iter().min());
        let verb = if is_possible { "can be" } else { "is no" };
        let steps =
            finest.map_or(String::new(), |step| format!("; these are multiples of {step} or coarser"));
        let share = shown(Exact::new(i128::from(self.parts), 100), 2);
        format!("{} {verb} {share} % quantile of {}{steps}", prints[0].printed, self.values)
    }

    fn premises(&self) -> Vec<String> {
        let rule = if self.is_linear {
            "quantiles interpolate linearly"
        } else {
            "the rule is one of Hyndman and Fan's nine"
        };
        vec![format!("the quantile is of {}; {rule}", self.values), digits(&self.numbers)]
    }

    fn power_key(&self) -> Option<String> {
        let units = self.numbers[0].print.printed.units();
        Some(format!("{} {} {} {} {units}", self.n, self.parts, self.grain, self.is_linear))
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let span = prints[0].span();
        let gaps = self.steps()?.into_iter().map(|step| gap(&span, step)).collect::<Option<Vec<Value>>>()?;
        let given = json!({
            "n": self.n.to_string(),
            "share": spelled(Exact::new(i128::from(self.parts), 10_000)),
            "grain": spelled(self.grain),
            "rule": if self.is_linear { "linear" } else { "any" },
        });
        Some(Proof { given, steps: Value::Array(gaps) })
    }
}
