//! Whether least value, quantiles, greatest value and mean stand in their order.

use super::arguments::{digits, each_of_sample};
use super::{Entry, Proof, Test};
use crate::sample::Sample;
use crate::statistic::Statistic;
use crate::table::Quoted;
use proofs::exact::{Exact, Print, spelled};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "order",
    about: "do minimum, quantiles and maximum rise, with the mean between the ends?",
    example: "median 5.0 with 75 % quantile 4.0",
    premises: "all are of the same values",
    source: "the definition of quantiles",
    tests: |input, give| each_of_sample(input, of_sample, give),
    relation: None,
};

struct Order {
    numbers: Vec<Quoted>,
    /// Pairs of numbers: the first may not be above the second.
    pairs: Vec<[usize; 2]>,
    /// The share of values below each; none for the mean.
    ranks: Vec<Option<Exact>>,
}

fn of_sample(sample: &Sample) -> Option<Order> {
    let ranked = |statistic: Statistic| match statistic {
        Statistic::Min => Some(0),
        Statistic::Quantile(parts) => Some(parts),
        Statistic::Max => Some(10_000),
        _ => None,
    };
    let mut known: Vec<(u32, Quoted)> = sample
        .numbers
        .iter()
        .filter_map(|(statistic, number)| Some((ranked(*statistic)?, number.clone())))
        .collect();
    // Power is stated for the one nearest to the median.
    known.sort_by_key(|(rank, _)| rank.abs_diff(5000));
    let indices = 0..known.len();
    let all = indices.clone().flat_map(|i| indices.clone().map(move |j| [i, j]));
    let mut pairs: Vec<[usize; 2]> = all.filter(|[i, j]| known[*i].0 < known[*j].0).collect();
    let mut numbers: Vec<Quoted> = known.iter().map(|(_, number)| number.clone()).collect();
    let mut ranks: Vec<Option<Exact>> =
        known.iter().map(|(rank, _)| Some(Exact::new(i128::from(*rank), 10_000))).collect();
    if let Some(mean) = sample.get(Statistic::Mean) {
        let at = numbers.len();
        ranks.push(None);
        numbers.push(mean.clone());
        for (index, (rank, _)) in known.iter().enumerate() {
            match rank {
                0 => pairs.push([index, at]),
                10_000 => pairs.push([at, index]),
                _ => {}
            }
        }
    }
    (!pairs.is_empty()).then_some(Order { numbers, pairs, ranks })
}

impl Order {
    fn broken(&self, prints: &[Print]) -> Option<[usize; 2]> {
        self.pairs.iter().copied().find(|[i, j]| prints[*i].span().low > prints[*j].span().high)
    }
}

impl Test for Order {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(self.broken(prints).is_none())
    }

    fn sentence(&self, prints: &[Print], _is_possible: bool) -> String {
        match self.broken(prints) {
            Some([i, j]) => format!(
                "{} {} is above {} {}",
                self.numbers[i].name, prints[i].printed, self.numbers[j].name, prints[j].printed
            ),
            None => format!("{} statistics stand in order", prints.len()),
        }
    }

    fn premises(&self) -> Vec<String> {
        vec!["all statistics are of the same values".to_owned(), digits(&self.numbers)]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let pair = self.broken(prints)?;
        let given = json!({ "pair": pair, "ranks": pair.map(|at| self.ranks[at].map(spelled)) });
        let [low, high] = pair.map(|at| prints[at].span());
        let steps = json!([{ "at_least": spelled(low.low), "at_most": spelled(high.high) }]);
        Some(Proof { given, steps })
    }
}
