//! The ledger: everything that a paper prints, and what answers it. It is complete by rule, both ways: each numbered figure,
//! table and equation has a row, each printed number is listed where it is printed, and each claim's number is among them.

use super::Paper;
use base::settings::{Faults, Spanned};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;

/// One thing that the paper prints and what answers it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LedgerRow {
    /// `Fig. 4`, `Table 1`, `Eq. 2`, or the place of a sentence.
    pub item: Spanned<String>,
    /// What it shows or says.
    pub says: String,
    /// Claims that answer it.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// Our figures and tables that stand beside it.
    #[serde(default)]
    pub figures: Vec<Spanned<String>>,
    /// Studies that carry it out.
    #[serde(default)]
    pub studies: Vec<Spanned<String>>,
    /// The numbers printed there.
    #[serde(default)]
    pub numbers: Vec<NumbersRow>,
    /// Why nothing can answer it.
    pub none: Option<String>,
}

/// Printed numbers that are answered in one way.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumbersRow {
    /// The numbers, digits and all, in the order in which they are printed.
    pub printed: Vec<Spanned<String>>,
    /// The claims that answer them: one for all, or one each.
    #[serde(default)]
    pub claims: Vec<Spanned<String>>,
    /// Why no claim does: what else they are.
    pub none: Option<String>,
}

impl NumbersRow {
    /// Each number with the claim that answers it, if one does.
    pub fn answered(&self) -> impl Iterator<Item = (&Spanned<String>, Option<&Spanned<String>>)> {
        let one = if self.claims.len() == 1 { self.claims.first() } else { None };
        self.printed.iter().enumerate().map(move |(at, printed)| (printed, one.or(self.claims.get(at))))
    }
}

impl Paper {
    /// Every row is answered, by what exists, and nothing that is printed is missing.
    pub(super) fn check_ledger(
        &self,
        claims: &BTreeSet<&str>,
        studies: &BTreeSet<&str>,
        figures: &BTreeSet<&str>,
        faults: &mut Faults,
    ) {
        for row in &self.ledger {
            self.known("claim", &row.claims, claims, faults);
            self.known("figure or table", &row.figures, figures, faults);
            self.known("study", &row.studies, studies, faults);
            for numbers in &row.numbers {
                self.known("claim", &numbers.claims, claims, faults);
            }
        }
        // What is not answered or not counted may be what was not understood.
        if self.document.is_part("ledger") {
            return;
        }
        for row in &self.ledger {
            row.numbers.iter().for_each(|numbers| self.check_numbers(numbers, faults));
            self.check_row(row, faults);
        }
        self.check_counts(faults);
        self.check_claims_are_listed(faults);
    }

    /// A row has an answer or the reason why there is none; a figure's is a figure of ours.
    fn check_row(&self, row: &LedgerRow, faults: &mut Faults) {
        let (item, is_figure) = (row.item.get_ref(), row.item.get_ref().starts_with("Fig. "));
        let is_answered = !(row.claims.is_empty() && row.studies.is_empty() && row.figures.is_empty());
        let message = match &row.none {
            Some(_) if !row.figures.is_empty() || is_answered && !is_figure => {
                format!("ledger row `{item}` has an answer and `none`, the reason why there is none")
            }
            None if is_figure && row.figures.is_empty() => {
                format!(
                    "{item} of the paper needs `figures`, ours beside it, or `none`, why there is no such figure"
                )
            }
            None if !is_answered && row.numbers.is_empty() => format!(
                "ledger row `{item}` needs claims, figures, studies or numbers that answer it, or `none` with the reason"
            ),
            _ => return,
        };
        faults.add(self.document.error(row.item.span(), message));
    }

    /// A number is answered by a claim that prints it, or has a reason why not.
    fn check_numbers(&self, numbers: &NumbersRow, faults: &mut Faults) {
        let Some(first) = numbers.printed.first() else { return };
        let (count, claims) = (numbers.printed.len(), numbers.claims.len());
        if claims > 1 && claims != count || (claims == 0) != numbers.none.is_some() {
            let message = format!(
                "{count} numbers have {claims} claims; one for all, one for each, or `none` with the reason is accepted"
            );
            faults.add(self.document.error(first.span(), message));
        }
        for (printed, claim) in numbers.answered() {
            let own = claim.and_then(|claim| self.claim(claim.get_ref())?.printed.as_ref());
            if let (Some(claim), Some(own)) = (claim, own)
                && own != printed.get_ref()
                && claims == count
            {
                let message = format!("claim `{}` prints {own}, not {}", claim.get_ref(), printed.get_ref());
                faults.add(self.document.error(printed.span(), message));
            }
        }
    }

    /// The number of every claim is listed in a row that names the claim.
    fn check_claims_are_listed(&self, faults: &mut Faults) {
        if self.prints.numbers == 0 {
            return;
        }
        let is_listed = |id: &str, number: &str| {
            self.ledger.iter().any(|row| {
                let mut named =
                    row.claims.iter().chain(row.numbers.iter().flat_map(|numbers| &numbers.claims));
                let mut printed = row.numbers.iter().flat_map(|numbers| &numbers.printed);
                named.any(|claim| claim.get_ref() == id) && printed.any(|own| own.get_ref() == number)
            })
        };
        for (index, claim) in self.claims.iter().enumerate() {
            let Some(printed) = &claim.printed else { continue };
            if !is_listed(&claim.id, printed) {
                let message =
                    format!("no row of the ledger lists the number {printed} for claim `{}`", claim.id);
                faults.add(self.document.error_at(&format!("claim.{index}.printed"), message));
            }
        }
    }

    /// Every numbered figure, table and equation has a row, and as many numbers are listed as are printed.
    fn check_counts(&self, faults: &mut Faults) {
        let items: BTreeSet<&str> = self.ledger.iter().map(|row| row.item.get_ref().as_str()).collect();
        for (kind, key, count) in [
            ("Fig.", "figures", self.prints.figures),
            ("Table", "tables", self.prints.tables),
            ("Eq.", "equations", self.prints.equations),
        ] {
            for number in 1..=count {
                let item = format!("{kind} {number}");
                if !items.contains(item.as_str()) {
                    let message =
                        format!("the ledger has no row for {item}; the paper has {count} of its kind");
                    faults.add(self.document.error_at(&format!("prints.{key}"), message));
                }
            }
        }
        let listed: usize = self.ledger.iter().flat_map(|row| &row.numbers).map(|n| n.printed.len()).sum();
        if listed != self.prints.numbers as usize {
            let message =
                format!("the ledger lists {listed} printed numbers; `numbers` says {}", self.prints.numbers);
            faults.add(self.document.error_at("prints.numbers", message));
        }
    }
}
