//! Criteria: how statistics of stored trials are held against what a paper says; one a file, all in [`REGISTRY`].
//!
//! A criterion selects trials, takes a statistic of each draw, and says what it finds; its class is decided in
//! [`class`](super::class). Arithmetic on printed numbers alone is a [`rule`](super::rule).

mod equals;
mod exists;
mod least_of;
mod lower;
mod on_every;
mod one_draw;
mod prints_as;
mod row_one_draw;
mod share;
mod trend;
mod within;

pub use exists::{Attained, ENTRY as EXISTS};
pub use one_draw::{Draws, draws};

use super::context::Context;
use super::evidence::Evidence;
use super::found::Found;
use super::selection::Selection;
use crate::study::Study;
use base::settings::{Accepted, SettingsError};

/// A criterion with its settings, every name looked up.
pub trait Criterion {
    /// What it finds in the stored runs as the evidence's reading, and session of the clock, show them.
    fn find(&self, evidence: &Evidence<'_>) -> Found;

    /// What it selects; none if it looks for trials in a way of its own.
    fn selections(&self) -> Vec<&Selection<'_>> {
        Vec::new()
    }

    /// The studies whose trials it looks at.
    fn studies(&self) -> Vec<&Study> {
        self.selections().iter().map(|of| of.study).collect()
    }

    /// Whether what it finds rests on our own clock.
    fn is_clock(&self) -> bool {
        self.selections().iter().any(|of| of.is_clock())
    }
}

/// A registered criterion.
pub struct Entry {
    /// The name that claims use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it.
    pub build: for<'a> fn(&Context<'a>) -> Result<Box<dyn Criterion + 'a>, SettingsError>,
}

/// Every criterion, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &equals::ENTRY,
    &exists::ENTRY,
    &least_of::ENTRY,
    &lower::ENTRY,
    &on_every::ENTRY,
    &one_draw::ENTRY,
    &prints_as::ENTRY,
    &row_one_draw::ENTRY,
    &share::ENTRY,
    &trend::ENTRY,
    &within::ENTRY,
];

/// The criterion called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
