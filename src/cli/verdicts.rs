//! The verdict table on the terminal.

use crate::analysis::class::Verdict;
use crate::analysis::verdict::{Counts, Estimate, Judged, Verdicts};
use std::io::IsTerminal as _;

/// Prints every claim's verdict, and how many there are of each.
pub fn print(verdicts: &Verdicts) {
    let is_coloured = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    say!("{}", table(verdicts, is_coloured).trim_end());
}

/// The table as text.
fn table(verdicts: &Verdicts, is_coloured: bool) -> String {
    let width = verdicts.claims.iter().map(|judged| judged.claim.len()).max().unwrap_or(0).max(5);
    let ours: Vec<String> = verdicts.claims.iter().map(ours).collect();
    let wide = ours.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(4);
    let mut text = format!("{:<width$}  {:>9}  {:<wide$}  verdict\n", "claim", "printed", "ours");
    for (judged, ours) in verdicts.claims.iter().zip(ours) {
        let printed = judged.printed.as_deref().unwrap_or("–");
        let name = judged.outcome();
        let verdict = if is_coloured {
            format!("\x1b[{}m{name}\x1b[0m", colour(judged.verdict))
        } else {
            name.to_owned()
        };
        let what = judged
            .ours()
            .filter(|_| judged.printed.is_some())
            .map(|estimate| format!("  ({})", estimate.what));
        let what = what.unwrap_or_default();
        text += &format!("{:<width$}  {printed:>9}  {ours:<wide$}  {verdict}{what}\n", judged.claim);
    }
    let Counts { classes, parts, asserted } = verdicts.counts();
    text += &format!("{classes}\n");
    for more in parts.into_iter().chain(asserted) {
        text += &format!("{more}\n");
    }
    if verdicts.quick {
        text += "a quick run: few replicates, so these verdicts are not the study's\n";
    }
    if !verdicts.claims_changed_since.is_empty() {
        let studies = verdicts.claims_changed_since.join(", ");
        text += &format!("claims or margins changed after the run of {studies}; run it again with --fresh\n");
    }
    text
}

fn ours(judged: &Judged) -> String {
    judged.ours().map_or_else(|| "–".to_owned(), estimate)
}

fn estimate(estimate: &Estimate) -> String {
    match estimate.interval {
        Some([low, high]) => {
            format!("{:.4} [{low:.4}, {high:.4}] n={}", estimate.value, estimate.n)
        }
        None => format!("{:.4}", estimate.value),
    }
}

fn colour(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Reproduced => 32,
        Verdict::Fitted | Verdict::Attainable => 36,
        Verdict::DirectionOnly | Verdict::Undecided => 33,
        Verdict::NotReproduced | Verdict::Impossible => 31,
        Verdict::Untestable => 90,
    }
}
