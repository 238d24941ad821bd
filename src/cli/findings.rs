//! The end of `repro`: the finding, and the headline claims with their verdicts.

use super::Which;
use super::verdicts::{COLUMNS, Lines, coloured, tallied};
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::Verdict;
use crate::render::headline::{Headline, headlines};
use crate::render::prose::{plain, prose};
use study::paper::Paper;

/// How many claims that cannot be true are named.
const IMPOSSIBLE: usize = 6;

/// How many lines of 40 the terminal leaves beside those that `repro` prints before and after.
const LINES: usize = 34;

/// What stands beside verdicts, and its meaning below the claims. An interpretation takes one option for each choice.
const LEGEND: [(&str, &str); 4] = [
    ("for/open/against", "interpretations (one option for each choice) that agree, cannot tell, contradict"),
    ("same under all", "no interpretation changes the result"),
    ("met under", "where our number meets the printed one"),
    ("choices not varied", "other options of these were not tried for the claim"),
];

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
    let mut named = String::new();
    for headline in headlines(paper, verdicts) {
        let words = match below {
            Below::Everything => headline.rests_on(verdicts),
            Below::Counts | Below::Nothing => headline.beside(verdicts),
        };
        named += words.as_deref().unwrap_or_default();
        text += &lines(&headline, words, below == Below::Nothing);
    }
    let legend = LEGEND.iter().filter(|(words, _)| named.contains(words));
    let mut notes: Vec<String> = legend.map(|(words, meaning)| format!("{words}: {meaning}")).collect();
    if below == Below::Nothing {
        notes = vec![notes.join("; ")];
    }
    notes.extend(impossible(verdicts));
    let notes: String =
        notes.iter().filter(|line| !line.is_empty()).map(|line| plain("", line, 2, COLUMNS) + "\n").collect();
    if !notes.is_empty() {
        text += &format!("\n{notes}");
    }
    text + "\n" + &tallied(Some(paper), verdicts, which, Lines::Few)
}

/// The sentences and rows that a proof refuses, with what they or their cells print.
fn impossible(verdicts: &Verdicts) -> Option<String> {
    let is_refused = |judged: &&ClaimVerdict| judged.verdict == Verdict::Impossible;
    let name = |whole: &ClaimVerdict| {
        let is_own = |judged: &&ClaimVerdict| {
            judged.claim == whole.claim || judged.part_of.as_ref() == Some(&whole.claim)
        };
        let own = verdicts.claims.iter().filter(is_own).filter(is_refused);
        let printed: Vec<&str> = own.filter_map(|judged| judged.printed.as_deref()).collect();
        let printed = if printed.is_empty() { String::new() } else { format!(" ({})", printed.join(", ")) };
        whole.claim.clone() + &printed
    };
    let refused = verdicts.claims.iter().filter(|judged| judged.is_counted()).filter(is_refused);
    let names: Vec<String> = refused.map(name).collect();
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
    let says = format!("{}{ours}.", headline.says);
    let rests = format!("({}{beside})", judged.claim);
    if is_one {
        return plain(&(first + " "), &format!("{says} {rests}"), indent, COLUMNS) + "\n";
    }
    let says = plain(&(first + " "), &says, indent, COLUMNS);
    format!("{says}\n{}\n", plain(&" ".repeat(indent), &rests, indent, COLUMNS))
}
