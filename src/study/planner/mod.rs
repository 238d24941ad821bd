//! Planners and stages that specs can name: those of the engine, and those that need more than it, one a file, in [`REGISTRY`].

pub mod external;
pub mod recorded;

use engine::planner::Entry;

/// Every planner that is not the engine's own, in the order of their names.
pub static REGISTRY: &[&Entry] = &[&external::ENTRY, &recorded::ENTRY];

/// Whether the trials of `entry` are recorded and not repeated: they depend on a clock and on programs of others, or come from
/// elsewhere.
pub fn is_recorded(entry: &Entry) -> bool {
    REGISTRY.iter().any(|own| own.name == entry.name)
}

/// Every planner and stage there is.
pub fn all() -> impl Iterator<Item = &'static Entry> {
    engine::planner::REGISTRY.iter().chain(REGISTRY).copied()
}

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    all().find(|entry| entry.name == name)
}
