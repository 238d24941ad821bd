//! What runs mean: the verdicts that rest on them.
//!
//! Nothing here starts a trial. [`Evidence`](evidence::Evidence) is the stored runs of a paper. A [`selection`] of trials and a
//! [`statistic`] of each instance go into a [`criterion`], which holds them against what the paper says; a [`rule`] is
//! arithmetic on what it prints. What either finds becomes a [`class`] in one place, for one claim after the other
//! ([`judge`](claims::judge)).

pub mod across;
mod censored;
pub mod claims;
pub mod class;
pub mod compare;
pub mod context;
pub mod criterion;
pub mod criterion_result;
pub mod difference;
pub mod evidence;
pub mod history;
pub mod inclusion;
pub mod meaning;
pub mod metric;
mod polylines;
pub mod rule;
pub mod selection;
pub mod selection_spec;
pub mod settle;
pub mod shown;
pub mod statistic;
pub mod tabulated;
pub mod together;
pub mod verdict;
mod verdict_file;
pub mod witness;
