//! What runs mean: the verdicts that rest on them.
//!
//! Nothing here starts a trial. [`Evidence`](evidence::Evidence) is the stored runs of a paper. A [`selection`] of trials and a
//! [`statistic`] of each instance go into a [`criterion`], which holds them against what the paper says; a [`rule`] is
//! arithmetic on what it prints. What either finds under one interpretation becomes an [`outcome`], for one
//! claim after the other ([`judge`](claims::judge)); over all interpretations a claim has a verdict, by one
//! [table](verdict_rule).

pub mod across;
pub mod agreement;
mod censored;
pub mod citation;
pub mod claim_test;
pub mod claims;
pub mod compare;
pub mod context;
pub mod criterion;
pub mod criterion_result;
pub mod difference;
pub mod estimates;
pub mod evidence;
pub mod history;
pub mod inclusion;
pub mod joint_test;
pub mod meaning;
pub mod metric;
pub mod number;
pub mod outcome;
pub mod polylines;
pub mod rule;
pub mod selection;
pub mod selection_spec;
pub mod settle;
pub mod shown;
pub mod statistic;
pub mod tabulated;
pub mod tally;
pub mod together;
pub mod verdict;
mod verdict_file;
pub mod verdict_rule;
pub mod witness;
