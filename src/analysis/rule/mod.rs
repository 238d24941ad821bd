//! Rules: arithmetic and geometry of printed numbers alone; one a file, all in [`REGISTRY`].
//!
//! A rule proves that a claim cannot be, or says that it can; it looks at no trial. The arithmetic itself is the package
//! `audit`'s.

mod clock_ticks;
mod count_bound;
mod joint_length_turn;
mod largest_saving;
mod lattice_length;
mod listed_points;
mod octagon_nodes;
mod percentage;
mod point_distance;
mod printed_above;
mod reach_ring;
mod repulsion;
mod sight_bound;
mod straight_line;
mod turn_needs_length;

use super::context::Context;
use super::evidence::Evidence;
use super::found::Found;
use base::settings::{Accepted, SettingsError};

/// A rule with its settings.
pub trait Rule {
    /// What it finds; the evidence only remembers what other claims have asked.
    fn find(&self, evidence: &Evidence<'_>) -> Found;
}

/// A registered rule.
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
    pub build: for<'a> fn(&Context<'a>) -> Result<Box<dyn Rule + 'a>, SettingsError>,
}

/// Every rule, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &clock_ticks::ENTRY,
    &count_bound::ENTRY,
    &joint_length_turn::ENTRY,
    &largest_saving::ENTRY,
    &lattice_length::ENTRY,
    &listed_points::ENTRY,
    &octagon_nodes::ENTRY,
    &percentage::ENTRY,
    &point_distance::ENTRY,
    &printed_above::ENTRY,
    &reach_ring::ENTRY,
    &repulsion::ENTRY,
    &sight_bound::ENTRY,
    &straight_line::ENTRY,
    &turn_needs_length::ENTRY,
];

/// The rule called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
