//! What runs mean: audits of printed numbers and the statistics that verdicts rest on.

pub mod audit;
pub mod interval;
pub mod stats;
