//! The checks: one a file, each with its example, premises and source.
//!
//! A check turns samples, tables and relations into [`Test`]s. A test knows the printed numbers that it is about and decides
//! whether any data can print them. [`report`](super::report) does the rest in one way for all: how digits are read, power, mend
//! and ranking.

use super::input::{Input, Relation};
use super::table::{Fault, Quoted};
use super::witness::{Budget, Witness};
use proofs::exact::{Exact, Print};
use serde_json::Value;

mod any_angle_turns;
pub mod arguments;
mod bold;
mod clock;
mod debit;
mod expansions;
mod grim;
mod grimmer;
mod interval;
mod keys;
mod lattice;
mod order;
mod p_value;
mod path_bound;
mod quantile;
mod ratio;
mod ratio_label;
mod reduction;
mod rises;
mod sd_range;
mod seed_spread;
mod shares_sum;
mod speedup;
mod sum_of_means;
pub mod summary;
mod total_over_mean;
mod turn_sum;

/// What a test found in exact numbers, for the certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// What was given beside the printed numbers: n, a grain, a step.
    pub given: Value,
    /// Why nothing prints these numbers, in steps that can be verified one by one.
    pub steps: Value,
}

/// One application of a check to printed numbers.
pub trait Test {
    /// The numbers that it is about; power is stated for the first.
    fn numbers(&self) -> &[Quoted];

    /// Whether any data could print `prints`, given in the order of [`numbers`](Self::numbers); `None` if exact arithmetic or
    /// the search's bound does not reach.
    fn is_possible(&self, prints: &[Print]) -> Option<bool>;

    /// What holds, with the numbers that show it.
    fn sentence(&self, prints: &[Print], is_possible: bool) -> String;

    /// The premises that the answer rests on.
    fn premises(&self) -> Vec<String>;

    /// The range of the first number over which power is stated; if none, between 0 and twice the printed one, and
    /// 100 units of the last place at least.
    fn window(&self) -> Option<Window> {
        None
    }

    /// The most prints that power is computed from, where each takes long.
    fn power_prints(&self) -> Option<i128> {
        None
    }

    /// Why [`is_possible`](Self::is_possible) gives no answer.
    fn undecided(&self, _prints: &[Print]) -> String {
        "too many digits or too many cases for exact arithmetic".to_owned()
    }

    /// A key under which power is the same, so that it is computed once.
    fn power_key(&self) -> Option<String> {
        None
    }

    /// The proof that nothing prints `prints`; `None` if the check gives a signal and proves nothing.
    fn proof(&self, _prints: &[Print]) -> Option<Proof> {
        None
    }

    /// Data that print `prints`; `None` if the check has none to show.
    fn witness(&self, _prints: &[Print], _budget: &mut Budget) -> Option<Witness> {
        None
    }

    /// How floats may have ended digits as no exact number ends: a cut 57 of 0.58 × 100 = 57.99999999999999, in words.
    fn float_slip(&self, _prints: &[Print]) -> Option<String> {
        None
    }

    /// Whether another reading of the digits could matter.
    fn is_about_digits(&self) -> bool {
        true
    }

    /// Whether it asks of a summary whether it is one; other tests take summaries for rows like the others.
    fn is_about_summaries(&self) -> bool {
        false
    }

    /// The cases that were looked through so far; `None` where a decision takes no search.
    fn steps_taken(&self) -> Option<u64> {
        None
    }
}

/// Prints of a test's first number over which its power is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// The least and the greatest.
    pub ends: [Exact; 2],
    /// Why these, for people.
    pub why: &'static str,
}

/// How a relation of a TOML file becomes a test.
pub struct FromRelation {
    /// The keys that it has beside `check`, `name` and `rounding`, with what each means.
    pub keys: &'static [keys::Key],
    /// Builds the test.
    pub build: fn(&Relation, &Input) -> Result<Box<dyn Test>, Fault>,
}

impl FromRelation {
    /// The names of its keys.
    pub fn names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|(key, _)| *key).collect()
    }
}

/// A check in the registry.
pub struct Entry {
    /// Its name, which is its file's.
    pub name: &'static str,
    /// The question that it answers.
    pub about: &'static str,
    /// An input that it refuses.
    pub example: &'static str,
    /// What is assumed.
    pub premises: &'static str,
    /// Where the mathematics is from.
    pub source: &'static str,
    /// Gives every test that tables and samples call for.
    pub tests: fn(&Input, &mut dyn FnMut(Box<dyn Test>)),
    /// The form in TOML, if it has one.
    pub relation: Option<FromRelation>,
}

/// Every check, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &any_angle_turns::ENTRY,
    &bold::ENTRY,
    &clock::ENTRY,
    &debit::ENTRY,
    &expansions::ENTRY,
    &grim::ENTRY,
    &grimmer::ENTRY,
    &interval::ENTRY,
    &lattice::ENTRY,
    &order::ENTRY,
    &p_value::ENTRY,
    &path_bound::ENTRY,
    &quantile::ENTRY,
    &ratio::ENTRY,
    &ratio_label::ENTRY,
    &reduction::ENTRY,
    &rises::ENTRY,
    &sd_range::ENTRY,
    &seed_spread::ENTRY,
    &shares_sum::ENTRY,
    &speedup::ENTRY,
    &sum_of_means::ENTRY,
    &summary::ENTRY,
    &total_over_mean::ENTRY,
    &turn_sum::ENTRY,
];

/// The check called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().find(|entry| entry.name == name).copied()
}

/// Gives no test: for checks that only relations ask for.
fn none(_input: &Input, _give: &mut dyn FnMut(Box<dyn Test>)) {}
