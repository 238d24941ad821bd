//! Tests of the crate from outside: its source, its registries, its planners, its command line.

mod floors;
mod registries;
mod source;
