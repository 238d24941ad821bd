//! What runs mean: the verdicts that rest on them.
//!
//! Nothing here starts a trial. [`Evidence`](evidence::Evidence) is the stored runs of a paper; a
//! [`check`] judges one claim by them; [`judge`](claims::judge) judges all.

pub mod check;
pub mod claims;
pub mod difference;
pub mod draws;
pub mod effect;
pub mod evidence;
pub mod inclusion;
pub mod metric;
pub mod together;
pub mod verdict;
