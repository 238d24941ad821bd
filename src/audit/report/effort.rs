//! The limits of an audit, counted in cases and not in seconds: the same table gives the same report on every machine.

use crate::checks::Test;
use proofs::exact::Print;
use std::cell::Cell;

/// Cases that searches may look through before decisions stay open.
const CASES: u64 = 100_000_000;
/// Decisions and cases that power and least changes may take in all.
const CHANGES: u64 = 10_000_000;

/// Why a decision stays open for which nothing is left.
pub(super) fn spent() -> String {
    format!("the table's budget of {CASES} cases is used up; audit its rows in several files")
}

/// What is left.
pub(super) struct Effort {
    cases: Cell<u64>,
    changes: Cell<u64>,
}

impl Default for Effort {
    fn default() -> Self {
        Self { cases: Cell::new(CASES), changes: Cell::new(CHANGES) }
    }
}

/// What `test` answers, with the cases that it took.
fn decided(test: &dyn Test, prints: &[Print]) -> (Option<bool>, u64) {
    let before = test.steps_taken().unwrap_or(0);
    let answer = test.is_possible(prints);
    (answer, test.steps_taken().unwrap_or(0) - before)
}

impl Effort {
    /// Whether `prints` are possible; none as well if the search has nothing left.
    pub(super) fn decide(&self, test: &dyn Test, prints: &[Print]) -> Option<bool> {
        if self.is_spent(test) {
            return None;
        }
        let (answer, cases) = decided(test, prints);
        self.cases.set(self.cases.get().saturating_sub(cases));
        answer
    }

    /// The same of a changed print, for power and least changes; ask [`is_used_up`](Self::is_used_up) before.
    pub(super) fn decide_change(&self, test: &dyn Test, prints: &[Print]) -> Option<bool> {
        let (answer, cases) = decided(test, prints);
        self.changes.set(self.changes.get().saturating_sub(1 + cases));
        answer
    }

    /// Whether nothing is left for a test that searches.
    pub(super) fn is_spent(&self, test: &dyn Test) -> bool {
        test.steps_taken().is_some() && self.cases.get() == 0
    }

    /// Whether nothing is left for power and least changes.
    pub(super) fn is_used_up(&self) -> bool {
        self.changes.get() == 0
    }
}
