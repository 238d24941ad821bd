//! Whether a column's quantiles can belong to the quotient that its label names.

use super::arguments::{count, digits, shown};
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::sample::{self, Sample};
use crate::statistic::Statistic;
use crate::table::{Fault, Quoted, named_by};
use proofs::exact::{Exact, Print, add, div, mul, spelled, sub, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "ratio_label",
    about: "can a column be the quotient, problem by problem, of the two that its label names?",
    example: "quartiles of time per iteration above what quartiles of time and of iterations allow",
    premises: "the quotient was taken on every problem, and its quantiles are over the same n problems as the others",
    source: "counting: of n problems, those with r at least R and a at most A have b at most A / R",
    tests,
    relation: Some(FromRelation {
        keys: &[
            ("ratio", "The sample, by its name, whose values the table calls ratios."),
            ("of", "The sample, by its name, of what is divided."),
            ("over", "The sample, by its name, of what it is divided by."),
        ],
        build,
    }),
};

struct RatioLabel {
    /// Every quantile of r, a and b.
    numbers: Vec<Quoted>,
    /// Which of the three, and its share.
    kinds: Vec<(usize, Exact)>,
    n: u64,
    names: [String; 3],
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    for (index, table) in input.tables.iter().enumerate().filter(|(_, table)| table.statistics().is_some()) {
        let mut samples = Vec::new();
        sample::each(index, table, &mut |sample| samples.push(sample.clone()));
        for (at, column) in table.columns.iter().enumerate() {
            let Some([a, b]) = &column.meaning.ratio else { continue };
            let named = |name: &str| named_by(&table.columns, at, name);
            let (Some(a), Some(b)) = (named(a), named(b)) else { continue };
            for r in samples.iter().filter(|sample| stands(sample)[0][1] == at) {
                let (Some(a), Some(b)) = (beside(r, a, &samples), beside(r, b, &samples)) else { continue };
                if let Some(test) = of_samples([r.clone(), a.clone(), b.clone()]) {
                    give(Box::new(test));
                }
            }
        }
    }
}

/// The row and the column of each of a sample's numbers.
fn stands(sample: &Sample) -> Vec<[usize; 2]> {
    sample
        .numbers
        .iter()
        .filter_map(|(_, number)| number.cell.map(|[_, row, column]| [row, column]))
        .collect()
}

/// The sample in `column` with a number in a row of `r`; a table may hold statistics of several contenders.
fn beside<'a>(r: &Sample, column: usize, samples: &'a [Sample]) -> Option<&'a Sample> {
    let rows: Vec<usize> = stands(r).iter().map(|[row, _]| *row).collect();
    samples.iter().find(|sample| stands(sample).iter().any(|[row, at]| *at == column && rows.contains(row)))
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let samples =
        [relation.sample("ratio", input)?, relation.sample("of", input)?, relation.sample("over", input)?];
    let found: Vec<String> = samples.iter().map(described).collect();
    let test = of_samples(samples).ok_or_else(|| {
        let found = found.join(", ");
        relation.fault(format!("the three samples need quantiles and the same n; found: {found}"))
    })?;
    Ok(Box::new(test))
}

/// A sample's name with its n and how many quantiles are printed of it.
fn described(sample: &Sample) -> String {
    let n = sample.n.map_or_else(|| "no n".to_owned(), |n| format!("n = {n}"));
    let quantiles = sample.numbers.iter().filter(|(statistic, _)| share(*statistic).is_some()).count();
    format!("`{}` with {n} and {quantiles} quantiles", sample.name)
}

/// The share of values at or below a quantile; `None` for other statistics.
fn share(statistic: Statistic) -> Option<Exact> {
    match statistic {
        Statistic::Min => Some(whole(0)),
        Statistic::Max => Some(whole(1)),
        Statistic::Quantile(parts) => Some(Exact::new(i128::from(parts), 10_000)),
        _ => None,
    }
}

fn of_samples(samples: [Sample; 3]) -> Option<RatioLabel> {
    let n = samples[0].n?;
    if samples.iter().any(|sample| sample.n != Some(n)) {
        return None;
    }
    let mut numbers = Vec::new();
    let mut kinds = Vec::new();
    for (which, sample) in samples.iter().enumerate() {
        for (statistic, number) in &sample.numbers {
            let Some(share) = share(*statistic) else { continue };
            numbers.push(number.clone());
            kinds.push((which, share));
        }
    }
    (0..3).all(|which| kinds.iter().any(|(kind, _)| *kind == which)).then_some(())?;
    // Power is stated for the quotient's first quantile that is not an end.
    let inner = kinds.iter().position(|(kind, share)| *kind == 0 && *share > whole(0)).unwrap_or(0);
    numbers.swap(0, inner);
    kinds.swap(0, inner);
    Some(RatioLabel { numbers, kinds, n, names: samples.map(|sample| sample.name) })
}

/// Quantiles of r, a and b that contradict each other.
struct Contradiction {
    at: [usize; 3],
    bound: Exact,
    /// Problems that have b at most the bound: at least this many …
    at_least: Exact,
    /// … and at most this many.
    at_most: Exact,
}

/// What the search for a contradiction gave.
enum Search {
    Found(Contradiction),
    Nothing,
}

impl RatioLabel {
    /// Looks for R, A, B with more problems at b ≤ A / R than there are below B > A / R. `order` says which of the three
    /// samples plays r, a and b.
    fn contradiction(&self, prints: &[Print], order: [usize; 3]) -> Option<Search> {
        let of = |which: usize| {
            let which = order[which];
            (0..prints.len()).filter(move |at| self.kinds[*at].0 == which)
        };
        for r in of(0) {
            let least = prints[r].span().low;
            if least <= whole(0) {
                continue;
            }
            for a in of(1) {
                let bound = div(prints[a].span().high, least)?;
                for b in of(2) {
                    if bound >= prints[b].span().low {
                        continue;
                    }
                    let [at_least, at_most] = self.counts([r, a, b])?;
                    if at_least > at_most {
                        return Some(Search::Found(Contradiction {
                            at: [r, a, b],
                            bound,
                            at_least,
                            at_most,
                        }));
                    }
                }
            }
        }
        Some(Search::Nothing)
    }

    /// The least number of problems with r ≥ R and a ≤ A, and the greatest with b < B. Any usual rule puts a quantile within
    /// one place of n p; the ends are exact.
    fn counts(&self, [r, a, b]: [usize; 3]) -> Option<[Exact; 2]> {
        let n = count(self.n);
        let slack = |share: Exact| if share == whole(0) || share == whole(1) { whole(0) } else { whole(1) };
        let [p, q, s] = [r, a, b].map(|at| self.kinds[at].1);
        let above = sub(sub(n, mul(n, p)?)?, slack(p))?;
        let below = sub(mul(n, q)?, slack(q))?;
        let at_least = sub(add(above, below)?, n)?;
        // Where B is the greatest value, all others may be below it.
        let at_most = if s == whole(1) { sub(n, whole(1))? } else { add(mul(n, s)?, slack(s))? };
        Some([at_least, at_most])
    }
}

impl Test for RatioLabel {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(matches!(self.contradiction(prints, [0, 1, 2])?, Search::Nothing))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let [r, a, b] = &self.names;
        if is_possible {
            return format!("{r} may be {a} over {b}");
        }
        let Some(Search::Found(found)) = self.contradiction(prints, [0, 1, 2]) else { return String::new() };
        let [of_r, of_a, of_b] =
            found.at.map(|at| format!("{} {}", self.numbers[at].name, prints[at].printed));
        let inverse = match self.contradiction(prints, [0, 2, 1]) {
            Some(Search::Nothing) => format!("; {b} over {a} is not excluded"),
            _ => String::new(),
        };
        format!(
            "{r} is not {a} over {b}; by {of_r} and {of_a}, at least {} of {} problems have {b} at most {}; by {of_b} at most {} do{inverse}",
            shown(found.at_least, 2),
            self.n,
            shown(found.bound, 2),
            shown(found.at_most, 2)
        )
    }

    fn premises(&self) -> Vec<String> {
        let [r, a, b] = &self.names;
        vec![
            format!("{r} is {a} over {b} on each of the same {} problems, neither of them negative", self.n),
            "quantiles are within one place of n p, as all usual rules put them".to_owned(),
            digits(&self.numbers),
        ]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let Search::Found(found) = self.contradiction(prints, [0, 1, 2])? else { return None };
        let quantile = |at: usize| json!([at, spelled(self.kinds[at].1)]);
        let [r, a, b] = found.at.map(quantile);
        let given = json!({ "n": self.n.to_string(), "r": r, "a": a, "b": b });
        let steps = json!([{
            "bound": spelled(found.bound),
            "below": spelled(prints[found.at[2]].span().low),
            "at_least": spelled(found.at_least),
            "at_most": spelled(found.at_most),
        }]);
        Some(Proof { given, steps })
    }
}
