//! What `repro` ends with: the finding, and the headline claims with their verdicts.

use super::verdicts::{COLUMNS, coloured, tallied};
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::render::prose::{plain, prose};
use crate::render::tables::short;
use study::paper::Paper;

/// So many claims stand there if a paper names no headline.
const CLAIMS: usize = 8;

/// Prints the finding and the headline claims, a line for each number and one for what the paper says.
pub fn print(paper: &Paper, verdicts: &Verdicts) {
    say!("{}", text(paper, verdicts).trim_end());
}

fn text(paper: &Paper, verdicts: &Verdicts) -> String {
    let mut text = String::from("\n");
    if let Some(finding) = &paper.report.finding {
        text += &(plain("", &prose(finding, verdicts), 0, COLUMNS) + "\n\n");
    }
    let mut shown: Vec<&ClaimVerdict> = verdicts.headlines(paper).collect();
    if shown.is_empty() {
        shown = verdicts.claims.iter().filter(|judged| judged.is_counted()).take(CLAIMS).collect();
    }
    let rows: Vec<[String; 3]> = shown.iter().map(|judged| cells(judged)).collect();
    let width = |at: usize| rows.iter().map(|row| row[at].chars().count()).max().unwrap_or(0);
    let widths = [width(0), width(1)];
    for (judged, [claim, ours, verdict]) in shown.iter().zip(&rows) {
        let verdict = coloured(judged.verdict, verdict);
        text += &format!("{claim:0$}  {ours:1$}  {verdict}\n", widths[0], widths[1]);
        text += &format!("  {}\n", cut(&statement(judged), COLUMNS - 2));
    }
    text + "\n" + &tallied(verdicts)
}

/// The claim, our number, and the verdict with what it depends on.
fn cells(judged: &ClaimVerdict) -> [String; 3] {
    let ours = judged.ours().map_or_else(|| "–".to_owned(), short);
    [judged.claim.clone(), ours, judged.verdict_said()]
}

/// What the paper says, or prints.
fn statement(judged: &ClaimVerdict) -> String {
    let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
    let printed = judged.printed.as_ref().map(|printed| format!("printed: {printed}{unit}"));
    let what = judged.ours().map(|ours| format!("ours: {}", ours.what));
    let said = judged.quote.as_ref().map(|quote| format!("“{quote}”")).or_else(|| judged.says.clone());
    said.into_iter().chain(printed).chain(what).collect::<Vec<_>>().join("; ")
}

/// `text` on one line, its end left out where it is longer than `columns`.
fn cut(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    text.chars().take(columns - 1).chain(['…']).collect()
}
