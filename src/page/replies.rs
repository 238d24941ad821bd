//! Replies of authors and others, beside the verdicts, and how to cite a verdict.

use super::html::escaped;
use crate::analysis::citation::{citation, version_in};
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use study::paper::{Paper, Reply};

/// Beside a verdict: who replied.
pub(super) fn mark(verdicts: &Verdicts, judged: &ClaimVerdict) -> String {
    let who = verdicts.replies_to(&judged.claim).map(|reply| escaped(&reply.who));
    let who = who.collect::<Vec<_>>().join(", ");
    if who.is_empty() { who } else { format!("<div class=\"second\">reply of {who}</div>") }
}

/// In the evidence of a claim: the replies, and the text that cites the verdict.
pub(super) fn lines(paper: &Paper, verdicts: &Verdicts, judged: &ClaimVerdict) -> String {
    let version = version_in(paper, verdicts, judged);
    let cited = version.map(|version| format!("cite as: {}", citation(verdicts, judged, &version)));
    let lines: Vec<String> = verdicts.replies_to(&judged.claim).map(Reply::line).chain(cited).collect();
    if lines.is_empty() {
        String::new()
    } else {
        format!("<p>{}</p>", escaped(&lines.join("\n")).replace('\n', "</p><p>"))
    }
}
