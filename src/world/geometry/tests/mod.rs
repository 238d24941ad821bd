//! Fast closed forms against a slow reference that shares nothing with them, on drawn and named cases.

mod pairs;
mod parry;
mod reference;
pub(super) mod sample;
mod shapes;

/// Of `all` cases that a test draws, those that it draws now: a fifth, or all where `REPLAN_THOROUGH` is set.
pub fn thoroughly(all: usize) -> usize {
    if std::env::var_os("REPLAN_THOROUGH").is_some() { all } else { all / 5 }
}
