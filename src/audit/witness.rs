//! Data behind what is printed: outcome vectors that give a cell.

use std::collections::BTreeMap;

/// How far a search for data may go.
#[derive(Debug, Clone, PartialEq)]
pub struct Budget {
    /// The most vectors to give; the search stops there.
    pub most: usize,
    /// Steps that the search may still take for one cell.
    pub steps: u64,
    /// The seed of the order in which vectors are tried; none for all in their order.
    pub seed: Option<u64>,
}

impl Default for Budget {
    fn default() -> Self {
        Self { most: 20, steps: 100_000, seed: None }
    }
}

impl Budget {
    /// Takes a step; false if none is left.
    pub fn step(&mut self) -> bool {
        let is_left = self.steps > 0;
        self.steps = self.steps.saturating_sub(1);
        is_left
    }
}

/// What a search for data found.
#[derive(Debug, Clone, PartialEq)]
pub struct Witness {
    /// The vectors, each in words: `83 of 250`, or values with how often each occurs.
    pub vectors: Vec<String>,
    /// Whether these are all there are.
    pub is_all: bool,
    /// Steps that the search took, and steps that it might take.
    pub steps: [u64; 2],
}

/// Vectors of `n` whole numbers between two ends with a given sum and sum of squares.
#[derive(Debug, Clone, Copy)]
pub struct Moments {
    /// How many values.
    pub n: u64,
    /// No value is below …
    pub least: i128,
    /// … or above.
    pub most: i128,
    /// Their sum.
    pub sum: i128,
    /// The sum of their squares.
    pub squares: i128,
}

impl Moments {
    /// Gives vectors with these moments to `found`, as counts of each value, until it refuses more or the budget ends;
    /// true if the search was complete.
    ///
    /// Values are taken in falling order, so every multiset comes once. A branch is left when the rest's mean or sum of
    /// squares cannot be reached any more.
    pub fn search(self, budget: &mut Budget, found: &mut dyn FnMut(&[i128]) -> bool) -> bool {
        let mut rng = budget.seed;
        let mut taken = Vec::new();
        matches!(self.descend(&mut taken, budget, &mut rng, found), Some(true))
    }

    fn descend(
        self,
        taken: &mut Vec<i128>,
        budget: &mut Budget,
        rng: &mut Option<u64>,
        found: &mut dyn FnMut(&[i128]) -> bool,
    ) -> Option<bool> {
        if !budget.step() {
            return Some(false);
        }
        if self.n == 0 {
            let is_met = self.sum == 0 && self.squares == 0;
            return if is_met && !found(taken) { None } else { Some(true) };
        }
        if !self.is_within_reach()? {
            return Some(true);
        }
        let n = i128::from(self.n);
        let top = self.most.min(self.squares.max(0).isqrt());
        let bottom = self.least.max(-((-self.sum).div_euclid(n)));
        let count = top - bottom + 1;
        let mut is_complete = true;
        let turn = rng.as_mut().map_or(0, |state| i128::from(next(state) >> 1) % count.max(1));
        for index in 0..count.max(0) {
            let value = bottom + (index + turn) % count;
            taken.push(value);
            let outcome = self.without(value).descend(taken, budget, rng, found);
            taken.pop();
            is_complete &= outcome?;
            if budget.steps == 0 {
                return Some(false);
            }
        }
        Some(is_complete)
    }

    /// What is left to be met after `value`, which no later value exceeds.
    fn without(self, value: i128) -> Self {
        Self {
            n: self.n - 1,
            most: value,
            sum: self.sum - value,
            squares: self.squares - value * value,
            ..self
        }
    }

    /// Whether sum and sum of squares can still be met; none if 128 bits do not suffice.
    fn is_within_reach(&self) -> Option<bool> {
        let (least, most) = extremes(self.n, self.sum, [Some(self.least), Some(self.most)])?;
        Some(least <= self.squares && most.is_none_or(|most| self.squares <= most))
    }
}

/// The least and the greatest sum of squares of `n` whole numbers with this sum, between two ends where they are given.
/// The least is above the greatest if there are no such numbers. None if 128 bits do not suffice.
pub fn extremes(n: u64, sum: i128, [least, most]: [Option<i128>; 2]) -> Option<(i128, Option<i128>)> {
    let n = i128::from(n);
    let (base, rest) = divided(sum, n);
    if least.is_some_and(|least| base < least) || most.is_some_and(|most| base + i128::from(rest > 0) > most)
    {
        return Some((1, Some(0)));
    }
    let square = |x: i128| x.checked_mul(x);
    let even =
        square(base)?.checked_mul(n - rest)?.checked_add(square(base.checked_add(1)?)?.checked_mul(rest)?)?;
    // One end alone implies the other: all values but one stand at it.
    let rest_at = |end: i128| sum.checked_sub(end.checked_mul(n - 1)?);
    let [least, most] = match (least, most) {
        (None, None) => return Some((even, None)),
        (Some(least), None) => [least, rest_at(least)?],
        (None, Some(most)) => [rest_at(most)?, most],
        (Some(least), Some(most)) => [least, most],
    };
    if least == most {
        return Some((even, Some(even)));
    }
    // As many at the ends as the sum allows, and one between them.
    let above = sum.checked_sub(n.checked_mul(least)?)?;
    let (high, between) = divided(above, most - least);
    let mut spread = square(most)?.checked_mul(high)?;
    if high < n {
        let middle = square(least + between)?;
        spread = spread.checked_add(middle)?.checked_add(square(least)?.checked_mul(n - high - 1)?)?;
    }
    Some((even, Some(spread)))
}

/// Quotient and rest of a division, the rest not negative. 64 bits mostly suffice, and a processor divides these by itself.
fn divided(a: i128, by: i128) -> (i128, i128) {
    match (i64::try_from(a), i64::try_from(by)) {
        (Ok(a), Ok(by)) if by > 0 => (i128::from(a.div_euclid(by)), i128::from(a.rem_euclid(by))),
        _ => (a.div_euclid(by), a.rem_euclid(by)),
    }
}

/// Values with how often each occurs: `0 ×7, 1 ×3`.
pub fn counted(values: &[i128], spelled: impl Fn(i128) -> String) -> String {
    let mut counts: BTreeMap<i128, usize> = BTreeMap::new();
    for value in values {
        *counts.entry(*value).or_default() += 1;
    }
    let words = counts.iter().map(|(value, count)| format!("{} ×{count}", spelled(*value)));
    words.collect::<Vec<_>>().join(", ")
}

/// `SplitMix64`: Steele, Lea & Flood, OOPSLA 2014.
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_search_finds_every_multiset_once() {
        // The oracle writes out all vectors of four values from 0 to 5.
        let mut all: BTreeMap<(i128, i128), std::collections::BTreeSet<Vec<i128>>> = BTreeMap::new();
        for code in 0..6_i128.pow(4) {
            let mut vector: Vec<i128> = (0..4).map(|place| code / 6_i128.pow(place) % 6).collect();
            vector.sort_unstable_by(|a, b| b.cmp(a));
            let moments = (vector.iter().sum(), vector.iter().map(|x| x * x).sum());
            all.entry(moments).or_default().insert(vector);
        }
        for sum in 0..=20 {
            for squares in 0..=100 {
                for seed in [None, Some(7)] {
                    let mut budget = Budget { steps: 10_000, most: 100, seed };
                    let mut found = Vec::new();
                    let moments = Moments { n: 4, least: 0, most: 5, sum, squares };
                    let is_all = moments.search(&mut budget, &mut |vector| {
                        found.push(vector.to_vec());
                        true
                    });
                    found.sort();
                    let oracle: Vec<_> = all.get(&(sum, squares)).into_iter().flatten().cloned().collect();
                    assert_eq!((is_all, found), (true, oracle), "{sum} {squares}");
                }
            }
        }
    }

    #[test]
    fn extremes_are_met_and_not_passed() {
        for n in 1..=4_u32 {
            for sum in -8..=12_i128 {
                let vectors = (0..6_i128.pow(n))
                    .map(|code| (0..n).map(|at| code / 6_i128.pow(at) % 6 - 2).collect::<Vec<_>>());
                let squares: Vec<i128> = vectors
                    .filter(|v| v.iter().sum::<i128>() == sum)
                    .map(|v| v.iter().map(|x| x * x).sum())
                    .collect();
                let (least, most) = extremes(u64::from(n), sum, [Some(-2), Some(3)]).unwrap();
                match (squares.iter().min(), squares.iter().max()) {
                    (Some(&low), Some(&high)) => assert_eq!((least, most), (low, Some(high)), "{n} {sum}"),
                    _ => assert!(least > most.unwrap(), "{n} {sum}"),
                }
            }
        }
    }
}
