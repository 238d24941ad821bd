//! What a paper's file says was found, with places for our numbers.

use super::Paper;
use base::settings::{Faults, did_you_mean};
use std::collections::BTreeSet;

/// `text` with every `{claim}` or `{claim:form}` replaced by what `with` says of the claim in that form.
pub fn filled(text: &str, mut with: impl FnMut(&str, &str) -> String) -> String {
    let mut pieces = text.split('{');
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once('}').unwrap_or((piece, ""));
        let (claim, form) = name.split_once(':').unwrap_or((name, ""));
        whole += &with(claim, form);
        whole += rest;
    }
    whole
}

impl Paper {
    /// Every claim that the findings speak of exists.
    pub(super) fn check_findings(&self, claims: &BTreeSet<&str>, faults: &mut Faults) {
        for (index, text) in self.source.findings.iter().enumerate() {
            filled(text, |claim, _| {
                if !claims.contains(claim) {
                    let hint = did_you_mean(claim, claims.iter().copied());
                    let message = format!("`findings` speaks of `{{{claim}}}`; there is no such claim{hint}");
                    let fault = self.document.error_at(&format!("source.findings.{index}"), message);
                    faults.add(fault.about(claim));
                }
                String::new()
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled_and_all_else_is_kept() {
        let said =
            filled("of {a.b} we find {a.b:percent}, {c:n}.", |claim, form| format!("<{claim}|{form}>"));
        assert_eq!(said, "of <a.b|> we find <a.b|percent>, <c|n>.");
        assert_eq!(filled("nothing to fill", |_, _| String::new()), "nothing to fill");
    }
}
