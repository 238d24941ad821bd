//! How stored verdicts differ from those that the stored records give, claim by claim.

use super::outcome::Outcome;
use super::verdict::{ClaimVerdict, CriterionFinding, Verdicts};
use serde::Serialize;
use serde_json::Value;

/// The differences of `now` from `stored`, one sentence each, every claim named; empty if they are equal.
pub fn differences(stored: &Verdicts, now: &Verdicts) -> Vec<String> {
    let mut found = heads(stored, now);
    for judged in &now.claims {
        let Some(before) = stored.claim(&judged.claim) else {
            found.push(format!(
                "claim `{}`: no verdict is stored, judged {}",
                judged.claim,
                judged.verdict.name()
            ));
            continue;
        };
        if let Some(what) = of_claim(before, judged) {
            found.push(format!("claim `{}`: {what}", judged.claim));
        }
    }
    let gone = stored.claims.iter().filter(|before| now.claim(&before.claim).is_none());
    found.extend(
        gone.map(|before| format!("claim `{}`: stored, but the paper has no such claim", before.claim)),
    );
    if found.is_empty() && stored.claims != now.claims {
        found.push("claims stand in another order, or one stands twice".to_owned());
    }
    if stored.together != now.together {
        found.push(format!(
            "claims that hold together: stored {} sets, judged {}, or other ones",
            stored.together.len(),
            now.together.len()
        ));
    }
    found
}

/// What differs of all that stands above the claims.
fn heads(stored: &Verdicts, now: &Verdicts) -> Vec<String> {
    let pairs = [
        unlike("paper", &stored.paper, &now.paper),
        unlike("command", &stored.command, &now.command),
        unlike("quick", &stored.quick, &now.quick),
        unlike("interpretation", &stored.interpretation, &now.interpretation),
        unlike("hash of what the claims mean", &stored.meanings, &now.meanings),
        unlike("seal of the history", &stored.history, &now.history),
        unlike("remarks on the history", &stored.remarks, &now.remarks),
        unlike("withdrawn claims", &stored.withdrawn, &now.withdrawn),
        unlike("replies", &stored.replies, &now.replies),
    ];
    let other = now.records.iter().filter(|(study, hash)| stored.records.get(*study) != Some(hash));
    let other = other.map(|(study, _)| format!("records of study `{study}`: judged before from others"));
    pairs.into_iter().flatten().chain(other).collect()
}

/// What differs of one claim: its verdict if that does, otherwise the first thing behind it.
fn of_claim(stored: &ClaimVerdict, now: &ClaimVerdict) -> Option<String> {
    if stored == now {
        return None;
    }
    if stored.verdict != now.verdict {
        return Some(format!("stored {}, judged {}", stored.verdict.name(), now.verdict.name()));
    }
    let verdict = now.verdict.name();
    let behind = unlike("interpretation", &stored.interpretation, &now.interpretation)
        .or_else(|| unlike("number of findings", &stored.findings.len(), &now.findings.len()))
        .or_else(|| stored.findings.iter().zip(&now.findings).find_map(|(a, b)| of_finding(a, b)))
        .unwrap_or_else(|| "the claim's own words are not the paper's".to_owned());
    Some(format!("{verdict} as stored, but {behind}"))
}

/// The first thing that differs of one finding.
fn of_finding(stored: &CriterionFinding, now: &CriterionFinding) -> Option<String> {
    let check = &now.criterion;
    unlike("criterion", &stored.criterion, check)
        .or_else(|| {
            unlike(
                &format!("outcome of `{check}`"),
                &stored.outcome.map(Outcome::name),
                &now.outcome.map(Outcome::name),
            )
        })
        .or_else(|| unlike(&format!("number of `{check}`"), &number(stored), &number(now)))
        .or_else(|| (stored != now).then(|| format!("the reasons of `{check}` read otherwise")))
}

/// Our number as people read it, with all of its digits.
fn number(of: &CriterionFinding) -> String {
    of.ours.as_ref().map_or_else(
        || "none".to_owned(),
        |ours| {
            let interval = ours.interval.map_or_else(String::new, |[low, high]| format!(" [{low}, {high}]"));
            let solved =
                ours.solved.map_or_else(String::new, |[solved, all]| format!(", {solved} of {all} solved"));
            format!("{}{interval} (n = {}{solved}; {})", ours.value, ours.n, ours.what)
        },
    )
}

fn unlike<T: PartialEq + Serialize>(what: &str, stored: &T, now: &T) -> Option<String> {
    (stored != now).then(|| format!("{what}: stored {}, judged {}", shown(stored), shown(now)))
}

/// A value as a message shows it: text in backticks, what is absent as `none`, all else as JSON.
fn shown(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(Value::String(text)) => format!("`{text}`"),
        Ok(Value::Null) | Err(_) => "none".to_owned(),
        Ok(other) => other.to_string(),
    }
}
