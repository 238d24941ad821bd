//! Whether a printed p-value is that of any usual test of two shares.

use super::arguments::digits;
use super::{Entry, FromRelation, Test, Window, none};
use crate::input::{Input, Relation};
use crate::table::{Fault, Quoted};
use proofs::exact::{Exact, Print, whole};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "p_value",
    about: "is a printed p-value that of a usual test of two shares?",
    example: "p 0.001 for 90 of 100 against 88 of 100",
    premises: "the shares are of independent trials; tests looked at: Fisher, chi-squared, chi-squared by Yates, z, one- and two-sided; a signal",
    source: "Nuijten et al., Behavior Research Methods 48 (2016) 1205-1226 (statcheck); Fisher (1935); Yates (1934)",
    tests: none,
    relation: Some(FromRelation {
        keys: &[
            (
                "p",
                "The p-value, in quotes: as printed, with `<` or `>` before a bound, or the name of a cell.",
            ),
            ("k1", "How many of the first n trials succeeded, a whole number."),
            ("n1", "How many trials the first had, a whole number."),
            ("k2", "How many of the second n trials succeeded, a whole number."),
            ("n2", "How many trials the second had, a whole number."),
        ],
        build,
    }),
};

struct PValue {
    numbers: [Quoted; 1],
    /// What stands before it, if it is printed as a bound: `p < 0.001`.
    bound: Option<Bound>,
    k: [u64; 2],
    n: [u64; 2],
}

/// Marks before a p-value that is printed as a bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Bound {
    Below,
    AtMost,
    Above,
    AtLeast,
}

impl Bound {
    /// Every mark; the longer ones first, since texts are looked through in this order.
    const MARKS: [(&'static str, Self); 6] = [
        ("<=", Self::AtMost),
        (">=", Self::AtLeast),
        ("≤", Self::AtMost),
        ("≥", Self::AtLeast),
        ("<", Self::Below),
        (">", Self::Above),
    ];

    /// The mark before a text, and the rest; none before a plain number.
    fn read(text: &str) -> (Option<Self>, &str) {
        let text = text.trim();
        let marked = Self::MARKS
            .iter()
            .find_map(|(mark, bound)| Some((Some(*bound), text.strip_prefix(mark)?.trim())));
        marked.unwrap_or((None, text))
    }

    /// Whether `p` is on its side of `end`, which is printed in full.
    fn holds(self, p: f64, end: f64) -> bool {
        match self {
            Self::Below => p < end,
            Self::AtMost => p <= end,
            Self::Above => p > end,
            Self::AtLeast => p >= end,
        }
    }

    fn mark(self) -> &'static str {
        match self {
            Self::Below => "<",
            Self::AtMost => "≤",
            Self::Above => ">",
            Self::AtLeast => "≥",
        }
    }
}

/// Trials up to which Fisher's sum is taken.
const TRIALS: u64 = 1_000_000;

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let n = [relation.needed("n1")?, relation.needed("n2")?];
    let mut k = [0; 2];
    for (at, key) in ["k1", "k2"].into_iter().enumerate() {
        let count =
            relation.exact(key)?.filter(|k: &Exact| *k.denom() == 1 && *k >= whole(0) && *k <= whole(n[at]));
        let count =
            count.ok_or_else(|| relation.fault(format!("`{key}` is missing or not from 0 to {}", n[at])))?;
        k[at] = *count.numer() as u64;
    }
    if n.iter().any(|n| *n > TRIALS) {
        return Err(relation.fault(format!("`n1` and `n2` are {TRIALS} at most")));
    }
    let (bound, value) = Bound::read(relation.text("p")?.unwrap_or_default());
    let number =
        if bound.is_some() { relation.resolve("p", value, input)? } else { relation.number("p", input)? };
    Ok(Box::new(PValue { numbers: [number], bound, k, n }))
}

impl PValue {
    /// The p-values of the tests, with their names.
    fn values(&self) -> Vec<(&'static str, f64)> {
        let [k1, k2] = self.k.map(|k| k as f64);
        let [n1, n2] = self.n.map(|n| n as f64);
        let pooled = (k1 + k2) / (n1 + n2);
        let difference = (k1 / n1 - k2 / n2).abs();
        let upper = |z: f64| libm::erfc(z / std::f64::consts::SQRT_2) / 2.0;
        let z =
            |difference: f64, variance: f64| if variance > 0.0 { difference / variance.sqrt() } else { 0.0 };
        let together = pooled * (1.0 - pooled) * (1.0 / n1 + 1.0 / n2);
        let apart = k1 / n1 * (1.0 - k1 / n1) / n1 + k2 / n2 * (1.0 - k2 / n2) / n2;
        let corrected = (difference - f64::midpoint(1.0 / n1, 1.0 / n2)).max(0.0);
        let [fisher_two, fisher_one] = self.fisher();
        vec![
            ("Fisher, two-sided", fisher_two),
            ("Fisher, one-sided", fisher_one),
            ("chi-squared or pooled z", 2.0 * upper(z(difference, together))),
            ("pooled z, one-sided", upper(z(difference, together))),
            ("chi-squared by Yates", 2.0 * upper(z(corrected, together))),
            ("z, not pooled", 2.0 * upper(z(difference, apart))),
        ]
    }

    /// Fisher's exact test: two-sided by the tables no likelier than this one, and the smaller tail.
    fn fisher(&self) -> [f64; 2] {
        let ([k1, k2], [n1, n2]) = (self.k, self.n);
        let choose = |n: u64, k: u64| {
            libm::lgamma(n as f64 + 1.0) - libm::lgamma(k as f64 + 1.0) - libm::lgamma((n - k) as f64 + 1.0)
        };
        let hits = k1 + k2;
        let all = choose(n1 + n2, hits);
        let chance = |k: u64| libm::exp(choose(n1, k) + choose(n2, hits - k) - all);
        let range = hits.saturating_sub(n2)..=hits.min(n1);
        let own = chance(k1);
        let mut two = 0.0;
        let mut low = 0.0;
        let mut high = 0.0;
        for k in range {
            let p = chance(k);
            two += if p <= own * (1.0 + 1e-7) { p } else { 0.0 };
            low += if k <= k1 { p } else { 0.0 };
            high += if k >= k1 { p } else { 0.0 };
        }
        [f64::min(two, 1.0), f64::min(low, high)]
    }

    fn fitting(&self, print: Print) -> Vec<&'static str> {
        let fits = |(_, p): &(&str, f64)| match self.bound {
            Some(bound) => bound.holds(*p, print.printed.value()),
            None => print.printed.agrees(*p, print.digits),
        };
        self.values().into_iter().filter(fits).map(|(name, _)| name).collect()
    }
}

impl Test for PValue {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(!self.fitting(prints[0]).is_empty())
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let ([k1, k2], [n1, n2]) = (self.k, self.n);
        let p = format!("{} {}", self.bound.map_or("=", Bound::mark), prints[0].printed);
        if is_possible {
            return format!(
                "p {p} for {k1} of {n1} against {k2} of {n2}: {}",
                self.fitting(prints[0]).join("; ")
            );
        }
        let listed: Vec<String> = self.values().iter().map(|(name, p)| format!("{name} {p:.4}")).collect();
        format!("p {p} for {k1} of {n1} against {k2} of {n2} is none of: {}", listed.join("; "))
    }

    fn premises(&self) -> Vec<String> {
        let way = if self.bound.is_some() {
            "the bound is meant as printed".to_owned()
        } else {
            digits(&self.numbers)
        };
        vec!["trials are independent and the test is one of those listed".to_owned(), way]
    }

    fn is_about_digits(&self) -> bool {
        self.bound.is_none()
    }

    fn window(&self) -> Option<Window> {
        Some(Window { ends: [whole(0), whole(1)], why: "all probabilities" })
    }
}
