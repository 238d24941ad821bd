//! Tests of the crate from outside: its source, its registries, its planners, its command line.

mod arm;
mod audit;
mod cell_threads;
mod circles;
mod cli_input;
mod cli_places;
mod cli_run;
mod cli_stop;
mod committed;
mod conformance;
mod crosscheck;
mod floors;
mod guards;
mod latex;
mod laws;
mod mutation;
mod paper;
mod polyhedra;
mod registries;
mod shapes;
mod snapshots;
mod source;
mod worlds;
mod wrong_words;
