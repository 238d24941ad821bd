//! Tests of the crate from outside: its source, its registries, its planners, its command line.

mod cli_input;
mod cli_run;
mod cli_stop;
mod crosscheck;
mod floors;
mod paper;
mod registries;
mod source;
