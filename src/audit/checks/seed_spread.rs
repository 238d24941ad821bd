//! Whether shares of trials, one a seed, can have the printed mean and spread over the seeds.

use super::arguments::each_of_sample;
use super::{Entry, Test, grimmer};
use crate::input::Input;
use crate::sample::Sample;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "seed_spread",
    about: "can shares of T trials, one a seed, have the printed mean and spread over S seeds?",
    example: "success [% of 25, seeds=10, ±sd] = 1.2 ± 0.07",
    premises: "every seed has the same number of trials; the spread is over the seeds' shares",
    source: "the argument of GRIMMER with seeds as values and 1/T as grain",
    tests,
    relation: None,
};

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    let of_seeds = |sample: &Sample| grimmer::of_sample(sample).filter(|_| sample.trials.is_some());
    each_of_sample(input, of_seeds, give);
}
