//! The verdict table on the terminal.

use super::Which;
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::{Column, Verdict};
use crate::render::prose::{columns, wrapped};
use crate::render::tables::short;
use std::io::IsTerminal as _;
use study::paper::Paper;

/// Output fits terminals of this many columns.
pub const COLUMNS: usize = 100;

/// Prints every claim's verdict, and how many there are of each; `which` is the paper as it was named.
pub(super) fn print(paper: Option<&Paper>, verdicts: &Verdicts, which: &Which) {
    say!("{}", table(paper, verdicts, which).trim_end());
}

/// `word` in the colour of `verdict`, on a terminal alone.
pub fn coloured(verdict: Verdict, word: &str) -> String {
    if std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none() {
        format!("\x1b[{}m{word}\x1b[0m", colour(verdict))
    } else {
        word.to_owned()
    }
}

/// The table as text, within [`COLUMNS`].
fn table(paper: Option<&Paper>, verdicts: &Verdicts, which: &Which) -> String {
    let head = ["claim", "printed", "ours", "solved", "verdict"].map(str::to_owned);
    let rows: Vec<[String; 5]> = [head].into_iter().chain(verdicts.claims.iter().map(cells)).collect();
    let lines = columns(&rows, [30, 14, 26, 9, COLUMNS]);
    let mut text = lines[0].clone();
    for (judged, line) in verdicts.claims.iter().zip(&lines[1..]) {
        text += line;
        let what = judged.ours().map(|ours| ours.what.clone());
        let what: Vec<String> = what.into_iter().chain(judged.beside_with_seed()).collect();
        if !what.is_empty() {
            text += &(wrapped("   ", &what.join("; "), 4, COLUMNS) + "\n");
        }
    }
    text + &tallied(paper, verdicts, which, Lines::All)
}

/// Which lines about all claims are printed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lines {
    /// All.
    All,
    /// All but how many parts there are, how many claims are asserted, and whose paths the verifier refuses.
    Few,
}

/// How many there are of each verdict, and what is to be known of them as a whole.
pub(super) fn tallied(paper: Option<&Paper>, verdicts: &Verdicts, which: &Which, lines: Lines) -> String {
    let mut text = String::new();
    let mut counts = verdicts.counts();
    if lines == Lines::Few {
        counts.parts = None;
        counts.asserted = None;
    }
    let of_each = counts.verdicts();
    let quick = verdicts
        .quick
        .then(|| "a quick run: few instances, so these verdicts are not the study's".to_owned());
    for line in [Some(of_each), counts.parts, counts.asserted, quick].into_iter().flatten() {
        text += &(wrapped("", &line, 2, COLUMNS) + "\n");
    }
    let named = if lines == Lines::Few { 1 } else { NAMED };
    let refused = refused_paths(verdicts).filter(|_| lines == Lines::All);
    for line in explored(paper, verdicts, which, named).into_iter().chain(refused).chain(verdicts.changed()) {
        text += &(wrapped("", &line, 2, COLUMNS) + "\n");
    }
    text
}

/// How many stale claims are named where there is room.
const NAMED: usize = 6;

/// What is to be known of interpretations and the second seed as a whole; of stale claims so many are `named`, and the first is located.
fn explored(paper: Option<&Paper>, verdicts: &Verdicts, which: &Which, named: usize) -> Vec<String> {
    let Some(explored) = &verdicts.explored else { return Vec::new() };
    let stale = |claims: &[String], what: &str, command: &str| {
        let first = claims.first()?;
        let command = which.command(command);
        let verb = if claims.len() == 1 { "is" } else { "are" };
        let names: Vec<String> = claims.iter().take(named).map(|id| format!("`{id}`")).collect();
        let more = claims.len().saturating_sub(named);
        let more = if more > 0 { format!(" and {more} more claims") } else { String::new() };
        let message =
            format!("{}{more} {verb} {what}: new, or changed since; run `{command}` again", names.join(", "));
        let test = paper.and_then(|paper| paper.claim(first)).and_then(|first| first.tests().next());
        let located = test.map(|(.., settings)| settings.error_at("", message.clone()).to_string());
        Some(located.and_then(|text| Some(text.lines().next()?.to_owned())).unwrap_or(message))
    };
    let compatible = explored.none_compatible.then(|| {
        "no voting interpretation agrees with all that the studies were calibrated to, so all of them are judged".to_owned()
    });
    let interpretations = stale(&explored.stale, "judged under the default interpretation alone", "explore");
    let second = stale(&explored.second_stale, "without a second seed", "confirm");
    [compatible, interpretations, second].into_iter().flatten().collect()
}

/// Under which options the verifier refused many paths, if under any.
pub fn refused_paths(verdicts: &Verdicts) -> Option<String> {
    let refused = &verdicts.explored.as_ref()?.refused;
    (!refused.is_empty()).then(|| {
        format!(
            "the verifier refuses many paths under {}; `refused_above_percent` in [explore] of paper.toml leaves such interpretations out",
            refused.join(", ")
        )
    })
}

/// A row: the claim, what is printed and ours, how many cases were solved of all, and the verdict.
fn cells(judged: &ClaimVerdict) -> [String; 5] {
    let dash = || "–".to_owned();
    let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
    let printed = judged.printed.as_ref().map_or_else(dash, |printed| format!("{printed}{unit}"));
    let ours = judged.ours();
    let solved =
        ours.and_then(|ours| ours.solved).map_or_else(dash, |[solved, all]| format!("{solved}/{all}"));
    [
        judged.claim.clone(),
        printed,
        ours.map_or_else(dash, short),
        solved,
        coloured(judged.verdict, judged.word()),
    ]
}

fn colour(verdict: Verdict) -> u8 {
    match verdict.column() {
        Column::For => 32,
        Column::Chosen => 36,
        Column::Depends | Column::Inconclusive => 33,
        Column::Against => 31,
        Column::NotTestable => 90,
    }
}
