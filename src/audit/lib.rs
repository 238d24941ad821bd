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
//! [`reader`] makes an [`input`] of CSV, Markdown or TOML; [`checks`] are one a file, each a question with its source;
//! [`report`] asks them all, with power and mends; [`certificate`] and [`witness`] are what a finding rests on; [`coverage`]
//! looks for numbers that no macro backs. What a column can be is [`meaning::ITEMS`]. [`reach`], [`form`], [`clock`],
//! [`lattice`], [`bounds`], [`mod@turns`], [`octile_turns`] and [`fvalues`] are the mathematics; [`proof`] is what claims of papers ask of
//! it, one number at a time.
//!
//! Nothing here reads a record. Every bound states its premises and takes the printed digits' slack in the
//! paper's favour, so that "impossible" is a proof under those premises. Decisions about lattice lengths are
//! made in integers; angles come from `libm`. Cells are `[x, y]` and stand for their centres, one unit apart.

mod asked;
pub mod bounds;
pub mod certificate;
pub mod checks;
pub mod clock;
pub mod coverage;
pub mod exact;
pub mod form;
pub mod formula;
pub mod fvalues;
pub mod input;
pub mod lattice;
pub mod meaning;
pub mod octile_turns;
pub mod output;
pub mod printed;
pub mod proof;
pub mod reach;
pub mod reader;
pub mod relation;
pub mod report;
pub mod sample;
pub mod statistic;
pub mod table;
pub mod witness;

pub use turns::Cell;
use turns::distance;

/// Why an audit could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AuditError {
    /// A text is no printed decimal number.
    #[error("`{text}` is not a printed number; one looks like 14.65, -0.5 or 270, with 15 digits at most")]
    NotANumber {
        /// The text found.
        text: String,
    },
}

/// The cell itself and its neighbours within the grid of `size` = `[columns, rows]`, by rows.
pub fn neighbourhood(cell: Cell, size: [i32; 2]) -> Vec<Cell> {
    (-1..=1)
        .flat_map(|dy| (-1..=1).map(move |dx| [cell[0] + dx, cell[1] + dy]))
        .filter(|near| (0..2).all(|axis| (0..size[axis]).contains(&near[axis])))
        .collect()
}

/// The pairs of a start and a goal in which one of the two is moved to one of its neighbours, never onto the other.
pub fn with_an_end_moved([start, goal]: [Cell; 2], size: [i32; 2]) -> Vec<[Cell; 2]> {
    let starts = neighbourhood(start, size).into_iter().map(|near| [near, goal]);
    let goals = neighbourhood(goal, size).into_iter().map(|near| [start, near]);
    starts.chain(goals).filter(|pair| *pair != [start, goal] && pair[0] != pair[1]).collect()
}

/// An upper bound in words: `decimals` of it, rounded up so that it stays one.
pub fn at_most(bound: f64, decimals: usize) -> String {
    let scale = libm::pow(10.0, decimals as f64);
    format!("{:.decimals$}", libm::ceil(bound * scale - 1e-9) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_upper_bound_in_words_is_no_lower_than_the_bound() {
        for (bound, decimals, said) in
            [(6.4150, 2, "6.42"), (7.2006, 2, "7.21"), (7.2, 2, "7.20"), (-1.237, 2, "-1.23"), (3.0, 0, "3")]
        {
            assert_eq!(at_most(bound, decimals), said);
            assert!(said.parse::<f64>().unwrap() >= bound - 1e-9);
        }
    }

    #[test]
    fn one_end_moves_at_a_time_and_stays_on_the_grid() {
        let moved = with_an_end_moved([[0, 0], [1, 0]], [30, 30]);
        assert_eq!(moved.len(), 2 + 4, "{moved:?}");
        assert!(moved.iter().all(|[a, b]| a != b && (*a == [0, 0]) != (*b == [1, 0])));
        assert_eq!(with_an_end_moved([[22, 15], [26, 28]], [30, 30]).len(), 16);
    }
}
