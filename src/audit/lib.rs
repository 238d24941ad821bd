//! Arithmetic on what a paper prints: what its digits can mean and what no input could have given.
//!
//! A table comes in as text, its header says what each column is, and findings come out: which cells no data could have
//! printed, under which premises, with a certificate that another program can verify.
//!
//! ```
//! use replan_audit::reader::{Format, read};
//! use replan_audit::report::{Class, Options, audit};
//!
//! let table = "| planner | success [% of 250] |\n|---|---|\n| A | 33.3 |\n| B | 33.2 |\n";
//! let input = read(table, Format::Markdown).expect("the table is well formed");
//! let report = audit(&input, &Options::default()).expect("no relation is wrong");
//!
//! // No k of 250 prints as 33.3 %, by any usual rounding: 83 give 33.2 and 84 give 33.6.
//! let finding = &report.findings[0];
//! assert_eq!((finding.check, finding.class), ("grim", Class::Impossible));
//! assert_eq!(finding.mend.as_ref().map(|mend| mend.to.to_string()), Some("33.2".to_owned()));
//! assert_eq!(finding.certificate.as_ref().map(|proof| &proof["steps"][0]["below"]), Some(&"83".into()));
//! ```
//!
//! [`reader`] makes an [`input`] of CSV, Markdown, LaTeX or TOML. [`checks`] are one a file, each a question with its source, and
//! [`report`] runs them all, with power and mends. [`certificate`] and [`witness`] are what a finding rests on. [`coverage`]
//! looks for numbers that no macro backs. What a column can be is [`meaning::ITEMS`]. The mathematics is the package `proofs`.

pub mod certificate;
pub mod checks;
pub mod claims;
pub mod coverage;
pub mod input;
pub mod meaning;
mod named_check;
pub mod octile_turns;
pub mod output;
pub mod reader;
pub mod relation;
pub mod report;
pub mod sample;
pub mod statistic;
pub mod table;
pub mod witness;
