//! What authors and others reply, beside the verdicts that they reply to.

use super::{item, link};
use crate::analysis::verdict::Verdicts;
use crate::render::prose::markdown;
use study::paper::Reply;

/// How many claims a reply names in a chapter.
const LISTED: usize = 6;

/// Every reply with the verdicts that it is about; claims lead to their evidence in the file `details`.
pub(super) fn replies(verdicts: &Verdicts, details: &str) -> String {
    let all: String = verdicts.replies.iter().map(|reply| line(reply, verdicts, details)).collect();
    if all.is_empty() { all } else { format!("Replies:\n\n{all}\n") }
}

fn line(reply: &Reply, verdicts: &Verdicts, details: &str) -> String {
    let about = reply.claims.iter().filter_map(|id| verdicts.claim(id));
    let linked = |judged| {
        format!("{} ({})", link(judged, &format!("`{}`", judged.claim), details), judged.verdict_text())
    };
    let mut named: Vec<String> = about.clone().take(LISTED).map(linked).collect();
    let more = about.count().saturating_sub(LISTED);
    if more > 0 {
        named.push(format!("{more} more"));
    }
    let [who, text] = [&reply.who, &reply.text].map(|text| markdown(text));
    item(0, &format!("{who}, {}, on {}: {text}", reply.date, named.join(", ")))
}
