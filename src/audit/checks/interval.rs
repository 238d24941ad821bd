//! Whether a printed interval is one of the usual intervals for k of n.

use super::arguments::digits;
use super::{Entry, FromRelation, Proof, Test, none};
use crate::input::{Input, Relation};
use crate::table::{Fault, Quoted};
use proofs::exact::{Exact, Print, Span, decimal, float, spelled, sub, whole};
use serde_json::json;
use stats::interval::Interval;
use stats::proportion::{clopper_pearson, normal_multiplier, wilson};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "interval",
    about: "is a printed interval that of k of n: Clopper-Pearson, Wilson, Wald or Agresti-Coull?",
    example: "low 90.0, high 99.0 for 97 of 100",
    premises: "trials are independent; a proof only where the header names Clopper and Pearson's, else a signal",
    source: "Clopper & Pearson, Biometrika 26 (1934); Wilson, JASA 22 (1927); Agresti & Coull, The American Statistician 52 (1998)",
    tests: none,
    relation: Some(FromRelation {
        keys: &[
            ("low", "The lower end, in quotes: the printed number, or the name of a cell."),
            ("high", "The upper end, in quotes: the printed number, or the name of a cell."),
            ("k", "How many of n trials succeeded, a whole number."),
            ("n", "How many trials there were, a whole number."),
            ("level", "The confidence level, in quotes; \"0.95\" if absent."),
            ("method", "`clopper_pearson`, `wilson`, `wald` or `agresti_coull`; `any` of them if absent."),
            ("whole", "What a share of all is printed as: 100 for per cent, which holds if absent, or 1."),
        ],
        build,
    }),
};

const METHODS: [&str; 5] = ["any", "clopper_pearson", "wilson", "wald", "agresti_coull"];

struct KofN {
    /// The lower end, then the upper.
    numbers: [Quoted; 2],
    k: u64,
    n: u64,
    level: Exact,
    method: &'static str,
    all: Exact,
}

/// Trials up to which ends are computed; beyond, sums over counts take too long.
const TRIALS: u64 = 20_000;

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let n = relation.needed("n")?;
    let k = relation.exact("k")?.filter(|k| *k.denom() == 1 && *k >= whole(0) && *k <= whole(n));
    let k = k.ok_or_else(|| relation.fault(format!("`k` is missing or not from 0 to n = {n}")))?;
    let level = relation.exact("level")?.unwrap_or(Exact::new(95, 100));
    if level <= whole(0) || level >= whole(1) || n > TRIALS {
        let message =
            format!("`level` must be between 0 and 1, \"0.95\" for instance, and n at most {TRIALS}");
        return Err(relation.fault(message));
    }
    let all = relation.exact("whole")?.unwrap_or(whole(100));
    if all <= whole(0) {
        return Err(relation.fault("`whole` must be above 0"));
    }
    let numbers = [relation.number("low", input)?, relation.number("high", input)?];
    let method = relation.word("method", &METHODS)?;
    Ok(Box::new(KofN { numbers, k: *k.numer() as u64, n, level, method, all }))
}

impl KofN {
    /// The intervals that count, by method, as shares.
    fn intervals(&self) -> Vec<(&'static str, Interval)> {
        let k = self.k as usize;
        let n = self.n as usize;
        let level = float(self.level);
        let z = normal_multiplier(level);
        let about = |share: f64, trials: f64| {
            let half = z * (share * (1.0 - share) / trials).sqrt();
            Interval::new(share - half, share + half)
        };
        let shrunk = n as f64 + z * z;
        let all = [
            ("clopper_pearson", clopper_pearson(k, n, level)),
            ("wilson", wilson(k, n, level)),
            ("wald", Some(about(k as f64 / n as f64, n as f64))),
            ("agresti_coull", Some(about((k as f64 + z * z / 2.0) / shrunk, shrunk))),
        ];
        let counts = all.into_iter().filter(|(name, _)| self.method == "any" || self.method == *name);
        counts.filter_map(|(name, interval)| Some((name, interval?))).collect()
    }

    fn fits(&self, interval: Interval, prints: &[Print]) -> bool {
        let all = float(self.all);
        let is_in = |end: f64, print: Print| print.printed.agrees(end * all, print.digits);
        // Ends that leave 0 to 1 are printed as they are, or cut.
        let either = |end: f64, print| is_in(end, print) || is_in(end.clamp(0.0, 1.0), print);
        either(interval.low, prints[0]) && either(interval.high, prints[1])
    }

    /// Which printed end Clopper and Pearson's misses, and on which side its own lies; `None` if it is not clearly outside.
    fn miss(&self, interval: Interval, prints: &[Print]) -> Option<(&'static str, &'static str)> {
        let all = float(self.all);
        let ends = [("low", interval.low, prints[0]), ("high", interval.high, prints[1])];
        ends.into_iter().find_map(|(which, end, print)| {
            let Span { low, high, .. } = print.span();
            if end > float(high) / all + 1e-12 {
                Some((which, "above"))
            } else {
                (end < float(low) / all - 1e-12).then_some((which, "below"))
            }
        })
    }
}

impl Test for KofN {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(self.intervals().into_iter().any(|(_, interval)| self.fits(interval, prints)))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let verb = if is_possible { "is" } else { "is none of the intervals" };
        let all = float(self.all);
        let places = prints[0].printed.decimals() as usize + 1;
        let listed = self.intervals().into_iter().map(|(name, interval)| {
            format!("{name} {:.places$} to {:.places$}", interval.low * all, interval.high * all)
        });
        let listed: Vec<String> = listed.collect();
        let (low, high) = (prints[0].printed, prints[1].printed);
        format!("{low} to {high} {verb} of {} of {}: {}", self.k, self.n, listed.join("; "))
    }

    fn premises(&self) -> Vec<String> {
        let level = decimal(self.level, 3);
        vec![
            format!("{} of {} independent trials, level {level}, method {}", self.k, self.n, self.method),
            digits(&self.numbers),
        ]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        if self.method != "clopper_pearson" {
            return None;
        }
        let (end, side) = self.miss(self.intervals().first()?.1, prints)?;
        let tail = sub(whole(1), self.level)? / whole(2);
        let given = json!({
            "k": self.k.to_string(),
            "n": self.n.to_string(),
            "tail": spelled(tail),
            "whole": spelled(self.all),
        });
        Some(Proof { given, steps: json!([{ "end": end, "lies": side }]) })
    }
}
