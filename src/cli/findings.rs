//! What `repro` ends with: the finding, and the headline claims with their verdicts.

use super::Which;
use super::verdicts::{COLUMNS, Lines, coloured, tallied};
use crate::analysis::outcome::Outcome;
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::Verdict;
use crate::render::headline::{Headline, headlines};
use crate::render::prose::{plain, prose};
use study::paper::Paper;

/// How many claims that cannot be true are named.
const IMPOSSIBLE: usize = 6;

/// How many lines of 40 the terminal leaves beside those that `repro` prints before and after.
const LINES: usize = 32;

/// Columns for a verdict.
const VERDICT: usize = 24;

/// Prints the finding and the headline claims, a line for what it says and one for what its verdict rests on.
pub(super) fn print(paper: &Paper, verdicts: &Verdicts, which: &Which) {
    let full = text(paper, verdicts, which, true);
    let fits = full.lines().count() <= LINES;
    let text = if fits { full } else { text(paper, verdicts, which, false) };
    say!("{}", text.trim_end());
}

/// The text; `is_full` adds on what verdicts depend, and their exceptions.
fn text(paper: &Paper, verdicts: &Verdicts, which: &Which, is_full: bool) -> String {
    let mut text = String::from("\n");
    if let Some(finding) = &paper.report.finding {
        text += &(plain("", &prose(finding, verdicts), 0, COLUMNS) + "\n\n");
    }
    for headline in headlines(paper, verdicts) {
        let words = if is_full { headline.rests_on(verdicts) } else { headline.beside(verdicts) };
        text += &lines(&headline, words);
    }
    text.extend(impossible(verdicts).map(|line| plain("\n", &line, 2, COLUMNS) + "\n"));
    text + "\n" + &tallied(verdicts, which, Lines::Few)
}

/// The claims that a proof refuses, with what they print; of a row its cells.
fn impossible(verdicts: &Verdicts) -> Option<String> {
    let is_proved = |judged: &&ClaimVerdict| {
        let is_whole = verdicts.claims.iter().any(|part| part.part_of.as_ref() == Some(&judged.claim));
        !is_whole && judged.findings.iter().any(|finding| finding.outcome == Some(Outcome::Proved))
    };
    let name = |judged: &ClaimVerdict| {
        let printed = judged.printed.as_ref().map_or_else(String::new, |printed| format!(" ({printed})"));
        judged.claim.clone() + &printed
    };
    let proved = verdicts.claims.iter().filter(|judged| judged.verdict == Verdict::Impossible);
    let names: Vec<String> = proved.filter(is_proved).map(name).collect();
    let more = names.len().saturating_sub(IMPOSSIBLE);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let listed = names.iter().take(IMPOSSIBLE).cloned().collect::<Vec<_>>().join(", ");
    (!names.is_empty()).then(|| format!("cannot be true: {listed}{more}"))
}

/// The verdict, what the paper says and our number; below, the claim and what its verdict rests on.
fn lines(headline: &Headline<'_>, rests_on: Option<String>) -> String {
    let judged = headline.judged;
    let word = judged.verdict_text();
    let pad = " ".repeat((VERDICT + 1).saturating_sub(word.chars().count()));
    let first = coloured(judged.verdict, &word) + &pad;
    let ours = headline.ours.as_ref().map_or_else(String::new, |ours| format!(": {ours}"));
    let beside = rests_on.map_or_else(String::new, |words| format!(": {words}"));
    let indent = VERDICT + 2;
    let says = plain(&(first + " "), &format!("{}{ours}", headline.says), indent, COLUMNS);
    let rests = plain(&" ".repeat(indent), &(judged.claim.clone() + &beside), indent, COLUMNS);
    format!("{says}\n{rests}\n")
}
