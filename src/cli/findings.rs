//! What `repro` ends with: the finding, and the headline claims with their verdicts.

use super::verdicts::{COLUMNS, coloured, tallied};
use crate::analysis::verdict::Verdicts;
use crate::render::headline::{Headline, headlines};
use crate::render::prose::{plain, prose};
use study::paper::Paper;

/// Columns for what the paper says.
const SAYS: usize = 44;

/// Prints the finding and the headline claims, a line for what it says and one for what its verdict rests on.
pub fn print(paper: &Paper, verdicts: &Verdicts) {
    say!("{}", text(paper, verdicts).trim_end());
}

fn text(paper: &Paper, verdicts: &Verdicts) -> String {
    let mut text = String::from("\n");
    if let Some(finding) = &paper.report.finding {
        text += &(plain("", &prose(finding, verdicts), 0, COLUMNS) + "\n\n");
    }
    let shown = headlines(paper, verdicts);
    let rows: Vec<[String; 2]> = shown.iter().map(cells).collect();
    let width = |at: usize| rows.iter().map(|row| row[at].chars().count()).max().unwrap_or(0);
    let widths = [width(0), width(1)];
    for (headline, [says, ours]) in shown.iter().zip(&rows) {
        let judged = headline.judged;
        let verdict = coloured(judged.verdict, &judged.verdict_said());
        text += &format!("{says:0$}  {ours:1$}  {verdict}\n", widths[0], widths[1]);
        let beside = judged.said.as_ref().map_or_else(String::new, |said| format!(": {said}"));
        text += &format!("  {}\n", cut(&(judged.claim.clone() + &beside), COLUMNS - 2));
    }
    text + "\n" + &tallied(verdicts)
}

/// What the paper says, and our number.
fn cells(headline: &Headline<'_>) -> [String; 2] {
    [cut(&headline.says, SAYS), headline.ours.clone().unwrap_or_else(|| "–".to_owned())]
}

/// `text` on one line, its end left out where it is longer than `columns`.
fn cut(text: &str, columns: usize) -> String {
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    text.chars().take(columns - 1).chain(['…']).collect()
}
