//! The summary of a run on the terminal.

use super::counted;
use study::session::{Report, UnexpectedStatus};

/// What a run did, in a few words.
pub fn summary(report: &Report, why: bool) -> String {
    let mut text = format!("{}: {}", report.manifest.study, counted(report.trials, ["trial", "trials"]));
    let parts = [
        (report.resumed, report.units, "units resumed"),
        (report.reused, report.units, "units reused"),
        (report.kept, report.trials, "trials reused"),
    ];
    let parts = parts.iter().filter(|(count, ..)| *count > 0);
    let shares: Vec<String> = parts.map(|(count, all, what)| format!("{count} of {all} {what}")).collect();
    if !shares.is_empty() {
        text += &format!(" ({})", shares.join(", "));
    }
    for UnexpectedStatus { status, count, trial, reason } in &report.odd {
        text += &format!("\n  {count} {status}; the first is {}/{trial}: {reason}", report.manifest.study);
    }
    for aside in &report.aside {
        text += &format!("\n  damaged, and kept as {}", aside.display());
    }
    if !report.moved.is_empty() {
        let first = &report.moved[0];
        text += &format!(
            "\n  {} from what was stored although nothing that could change it has changed; the first is {}/{first}",
            counted(report.moved.len(), ["trial differs", "trials differ"]),
            report.manifest.study
        );
    }
    if why {
        let reasons = if report.why.is_empty() && report.reused > 0 {
            vec!["nothing that the stored trials depend on has changed".to_owned()]
        } else if report.why.is_empty() {
            vec!["there were no stored trials, or --fresh was given".to_owned()]
        } else {
            report.why.clone()
        };
        for reason in reasons {
            text += &format!("\n  why: {reason}");
        }
    }
    text
}
