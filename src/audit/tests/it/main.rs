//! Tests of the audit from outside: the library, the program, and what its page and schema say of both.

mod boundaries;
mod cells;
mod claims;
mod command;
mod contradictions;
mod coverage;
mod elsewhere;
mod false_alarms;
mod octile_turns;
mod package;
mod pages;
mod people;
mod power;
mod report;
mod simulation;
mod witness;
mod wording;
