//! The statistics that verdicts rest on: pure functions of numbers already drawn.
//!
//! A value that was not measured never reaches this module; a failure may, as an infinite cost. Functions that
//! have no answer for their sample say so by `None`. NaN is a caller's mistake and panics. Every random step
//! takes a seed and the number of its repetitions; sums run in the order given.

pub mod bands;
pub mod beta;
pub mod bootstrap;
pub mod gate;
pub mod interval;
pub mod means;
pub mod paired;
pub mod pooled;
pub mod proportion;
pub mod rows;
pub mod summary;
