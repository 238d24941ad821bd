//! The contents of a paper's chapter of the report: findings, with places for our numbers, and the figures, tables and
//! claims shown.

use super::{Paper, names_of};
use base::settings::{Faults, Spanned, did_you_mean};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;

/// The chapter of a paper. Its texts may hold `{claim}`, which our number beside that claim replaces, and
/// `{claim:form}` with one of `FORMS`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReportSpec {
    /// What was found, in one sentence, for the overview.
    pub finding: Option<String>,
    /// What was found, with numbers: each `{claim}` is replaced by our number.
    #[schemars(length(max = 5))]
    pub findings: Vec<String>,
    /// Its figures; the first of the studies' if absent.
    #[schemars(length(max = 6))]
    pub figures: Option<Vec<Spanned<String>>>,
    /// Tables of our results that it shows beside the paper's own.
    pub tables: Vec<Spanned<String>>,
    /// The paper's own tables that stand in the details and not in the chapter.
    pub in_details: Vec<Spanned<String>>,
}

/// How many figures a chapter shows at most.
pub const FIGURES: usize = 6;

/// The forms in which a text can show our number beside a claim. It may stand with one decimal, as a percentage (or the least of it) with
/// the digits of its interval, or in words with a direction. Of a claim with parts the words are those of its parts. Other forms give a
/// shown number that decides nothing, the interval or one of its ends, the number of instances, or that of the cases that could be posed.
/// The rest give the verdict, the words beside it, or the printed values that would have been refused. The ends of an interval have three
/// significant digits. Of a joint test two give the options that fit and those that do not.
pub const FORMS: [&str; 15] = [
    "tenths",
    "percent",
    "percent_low",
    "effect",
    "shown",
    "interval",
    "low",
    "high",
    "n",
    "cases",
    "verdict",
    "interpretations",
    "power",
    "fits",
    "refuses",
];

/// `text` with every `{claim}` or `{claim:form}` replaced by `with` of claim and form.
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
    /// Every claim, form, figure and table that the chapter names exists.
    pub(super) fn check_report(
        &self,
        claims: &BTreeSet<&str>,
        figures: &BTreeSet<&str>,
        faults: &mut Faults,
    ) {
        let report = &self.report;
        let finding = report.finding.iter().map(|text| ("report.finding".to_owned(), text));
        let findings = report
            .findings
            .iter()
            .enumerate()
            .map(|(index, text)| (format!("report.findings.{index}"), text));
        for (place, text) in finding.chain(findings) {
            filled(text, |claim, form| {
                if !claims.contains(claim) {
                    let hint = did_you_mean(claim, claims.iter().copied());
                    let message = format!("the text speaks of `{{{claim}}}`; there is no such claim{hint}");
                    let error = self.document.error_at(&place, message).about(claim).about("id");
                    faults.add(error.about(&names_of("claim")));
                } else if !form.is_empty() && !FORMS.contains(&form) {
                    let message = format!(
                        "the text asks for `{{{claim}:{form}}}`; the forms are {}, or none",
                        FORMS.join(", ")
                    );
                    faults.add(self.document.error_at(&place, message));
                }
                String::new()
            });
        }
        let results: BTreeSet<&str> = self.results.iter().map(|table| table.id.get_ref().as_str()).collect();
        self.known("figure", report.figures.as_deref().unwrap_or_default(), figures, faults);
        self.known("table of results", &report.tables, &results, faults);
        let printed = self.tables.iter().map(|table| table.id.as_str()).collect();
        self.known("table", &report.in_details, &printed, faults);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_filled_and_all_else_is_kept() {
        let text =
            filled("of {a.b} we find {a.b:percent}, {c:n}.", |claim, form| format!("<{claim}|{form}>"));
        assert_eq!(text, "of <a.b|> we find <a.b|percent>, <c|n>.");
        assert_eq!(filled("nothing to fill", |_, _| String::new()), "nothing to fill");
    }
}
