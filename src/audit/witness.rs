//! Data behind what is printed: outcome vectors that give a cell.

use proofs::reach::extremes;
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

    /// Whether sum and sum of squares can still be met; `None` if 128 bits do not suffice.
    fn is_within_reach(&self) -> Option<bool> {
        let (least, most) = extremes(self.n, self.sum, [Some(self.least), Some(self.most)])?;
        Some(least <= self.squares && most.is_none_or(|most| self.squares <= most))
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
