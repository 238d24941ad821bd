//! The end of `repro`: the finding, and the headline claims with their verdicts.

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
const LINES: usize = 34;

/// What counts mean, below the claims.
const LEGEND: &str =
    "for/open/against: interpretations (one option for each choice) that agree, cannot tell, contradict";

/// Columns for a verdict.
const VERDICT: usize = 18;

/// Prints the finding and the headline claims, a line for what it says and one for what its verdict rests on.
pub(super) fn print(paper: &Paper, verdicts: &Verdicts, which: &Which) {
    let shapes = [Below::Everything, Below::Counts, Below::Nothing];
    let mut texts = shapes.map(|below| text(paper, verdicts, which, below)).into_iter();
    let fits = |text: &String| text.lines().count() <= LINES;
    let shortest = texts.next_back().unwrap_or_default();
    say!("{}", texts.find(fits).unwrap_or(shortest).trim_end());
}

/// What stands below a headline claim.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Below {
    /// Its id, the counts, on what its verdict depends, and the exceptions.
    Everything,
    /// Its id and the counts.
    Counts,
    /// Nothing: its id stands behind our number.
    Nothing,
}

fn text(paper: &Paper, verdicts: &Verdicts, which: &Which, below: Below) -> String {
    let mut text = String::from("\n");
    if let Some(finding) = &paper.report.finding {
        text += &(plain("", &prose(finding, verdicts), 0, COLUMNS) + "\n\n");
    }
    for headline in headlines(paper, verdicts) {
        let words = match below {
            Below::Everything => headline.rests_on(verdicts),
            Below::Counts | Below::Nothing => headline.beside(verdicts),
        };
        text += &lines(&headline, words, below == Below::Nothing);
    }
    let legend = verdicts.explored.is_some().then(|| format!("{LEGEND}\n"));
    let proved = impossible(verdicts).map(|line| plain("", &line, 2, COLUMNS) + "\n");
    let notes: String = legend.into_iter().chain(proved).collect();
    if !notes.is_empty() {
        text += &format!("\n{notes}");
    }
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

/// The verdict, what the paper says and our number; below, or with `is_one` behind them, the claim and what its verdict rests on,
/// which names the choices that it depends on.
fn lines(headline: &Headline<'_>, rests_on: Option<String>, is_one: bool) -> String {
    let judged = headline.judged;
    let word = judged.word();
    let pad = " ".repeat((VERDICT + 1).saturating_sub(word.chars().count()));
    let first = coloured(judged.verdict, word) + &pad;
    let ours = headline.ours.as_ref().map_or_else(String::new, |ours| format!(": {ours}"));
    let beside = rests_on.map_or_else(String::new, |words| format!(": {words}"));
    let indent = VERDICT + 2;
    let says = format!("{}{ours}", headline.says);
    let rests = format!("({}{beside})", judged.claim);
    if is_one {
        return plain(&(first + " "), &format!("{says} {rests}"), indent, COLUMNS) + "\n";
    }
    let says = plain(&(first + " "), &says, indent, COLUMNS);
    format!("{says}\n{}\n", plain(&" ".repeat(indent), &rests, indent, COLUMNS))
}
