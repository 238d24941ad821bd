//! How many sentences and table rows there are of each verdict.

use super::verdict::{ClaimVerdict, Verdicts};
use super::verdict_rule::{Column, Verdict};
use study::paper::Paper;

/// How many sentences and table rows there are of each verdict, in words: the same on the terminal and in the report. What
/// is a part of a sentence or a cell of a row counts with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Counts {
    /// How many there are.
    pub whole: String,
    /// How many there are of each verdict that some have.
    pub of_each: Vec<(usize, Verdict)>,
    /// How many parts and cells they have.
    pub parts: Option<String>,
    /// How many must hold by a theorem, if any.
    pub asserted: Option<String>,
}

impl Counts {
    /// How many there are, and of each verdict.
    pub fn verdicts(&self) -> String {
        let of_each = self.of_each.iter().map(|(count, verdict)| format!("{count} {}", verdict.name()));
        format!("{}: {}", self.whole, of_each.collect::<Vec<_>>().join(", "))
    }
}

impl Verdicts {
    /// The verdicts of sentences and table rows that do not hold by a theorem.
    fn whole(&self) -> impl Iterator<Item = Verdict> {
        self.claims.iter().filter(|judged| judged.is_counted()).map(|judged| judged.verdict)
    }

    /// How many sentences and table rows there are in each column of the overview, without those that hold by a theorem.
    pub fn tally(&self) -> [usize; Column::ALL.len()] {
        Column::ALL.map(|column| self.whole().filter(|own| own.column() == column).count())
    }

    /// How many sentences and table rows there are of each verdict.
    pub fn counts(&self) -> Counts {
        let (parts, whole): (Vec<&ClaimVerdict>, Vec<&ClaimVerdict>) =
            self.claims.iter().partition(|judged| judged.part_of.is_some());
        let asserted = whole.iter().filter(|judged| judged.theorem.is_some()).count();
        let of = |verdict: Verdict| (self.whole().filter(|own| *own == verdict).count(), verdict);
        let of_each = Verdict::ALL.map(of).into_iter().filter(|(count, _)| *count > 0).collect();
        let all = self.whole().count();
        let what = if all == 1 { "sentence or row" } else { "sentences and rows" };
        let whole = format!("{all} {what}");
        let parts = (!parts.is_empty()).then(|| {
            format!("{} parts and cells have verdicts of their own and count with these", parts.len())
        });
        let asserted = (asserted > 0).then(|| {
            format!("{asserted} more must hold whatever was drawn; they are asserted and count for nothing")
        });
        Counts { whole, of_each, parts, asserted }
    }

    /// The headline claims of their paper that were judged.
    pub fn headlines<'a>(&'a self, paper: &'a Paper) -> impl Iterator<Item = &'a ClaimVerdict> {
        let headlines = paper.claims.iter().filter(|claim| claim.headline);
        headlines.filter_map(|claim| self.claim(&claim.id))
    }
}
