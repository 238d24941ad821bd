//! Whether mean and deviation of values that are 0 or the whole fit each other: one is a function of the other.

use super::arguments::{count, digits, each_of_sample, shown, spreads};
use super::{Entry, Proof, Test, Window};
use crate::meaning::Divisor;
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::Quoted;
use proofs::exact::{Exact, Print, div, float, mul, spelled, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "debit",
    about: "do mean and deviation of values that are 0 or 1 fit each other and n?",
    example: "success [share of 20, ±sd] = 0.25 ± 0.30",
    premises: "every value is 0 or the whole; mean and deviation are of the same n values",
    source: "Heathers & Brown, DEBIT: A Simple Consistency Test for Binary Data (2019)",
    tests: |input, give| each_of_sample(input, of_sample, give),
    relation: None,
};

struct Debit {
    /// The deviation, then the mean.
    numbers: [Quoted; 2],
    n: u64,
    all: Exact,
    divisor: Divisor,
}

/// Counts that are looked through one by one.
const COUNTS: i128 = 20_000;

fn of_sample(sample: &Sample) -> Option<Debit> {
    if !sample.is_binary() || sample.is_count || sample.trials.is_some() {
        return None;
    }
    let numbers = [sample.get(Statistic::Sd)?.clone(), sample.get(Statistic::Mean)?.clone()];
    let n = sample.n.filter(|n| *n > 1)?;
    Some(Debit { numbers, n, all: sample.most?, divisor: sample.divisor })
}

impl Debit {
    /// The counts that print the mean, each with its variances.
    fn variances(&self, mean: Print) -> Option<Vec<(i128, Vec<Exact>)>> {
        let (first, last) = mean.span().times(div(count(self.n), self.all)?)?.integers();
        let (first, last) = (first.max(0), last.min(i128::from(self.n)));
        if last - first >= COUNTS {
            return None;
        }
        (first..=last).map(|k| Some((k, self.variances_of(k)?))).collect()
    }

    fn variances_of(&self, k: i128) -> Option<Vec<Exact>> {
        let n = i128::from(self.n);
        let about = mul(mul(self.all, self.all)?, Exact::new(k.checked_mul(n - k)?, n))?;
        self.divisor.values(n).into_iter().map(|divisor| div(about, whole(divisor))).collect()
    }
}

impl Test for Debit {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        let span = prints[0].span();
        if span.not_negative().is_empty() {
            return Some(false);
        }
        let squared = span.squared()?;
        let all = self.variances(prints[1])?;
        Some(all.iter().any(|(_, variances)| variances.iter().any(|variance| squared.contains(*variance))))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let [sd, mean] = [prints[0].printed, prints[1].printed];
        let listed = self.variances(prints[1]).unwrap_or_default();
        let shown_ones = listed.iter().take(3).map(|(k, variances)| {
            let roots: Vec<String> =
                variances.iter().map(|variance| format!("{:.4}", float(*variance).sqrt())).collect();
            format!("{k} of {} gives {}", self.n, roots.join(" or "))
        });
        let shown_ones: Vec<String> = shown_ones.collect();
        let verb = if is_possible { "is" } else { "is not" };
        let seeds = if is_possible { "" } else { "; if it is over seeds, `seeds=S` says so" };
        let detail =
            if shown_ones.is_empty() { "no count prints the mean".to_owned() } else { shown_ones.join("; ") };
        format!(
            "deviation {sd} {verb} that of {} values of 0 or {} with mean {mean}: {detail}{seeds}",
            self.n,
            shown(self.all, 0)
        )
    }

    fn premises(&self) -> Vec<String> {
        vec![
            format!("mean and deviation are of the same {} values, each 0 or {}", self.n, self.all),
            digits(&self.numbers),
        ]
    }

    fn window(&self) -> Option<Window> {
        let least = if self.divisor == Divisor::Population { self.n } else { self.n - 1 };
        spreads(self.numbers[0].print, [whole(0), self.all], div(count(self.n), count(least))?)
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let divisors = self.divisor.values(self.n.into());
        let divisors: Vec<String> = divisors.iter().map(ToString::to_string).collect();
        let given = json!({ "n": self.n.to_string(), "whole": spelled(self.all), "divisors": divisors });
        let step = |(k, variances): &(i128, Vec<Exact>)| {
            let variances: Vec<String> = variances.iter().map(|variance| spelled(*variance)).collect();
            json!({ "count": k.to_string(), "variances": variances })
        };
        Some(Proof { given, steps: self.variances(prints[1])?.iter().map(step).collect() })
    }
}
