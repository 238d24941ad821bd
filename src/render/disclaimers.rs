//! What stands on everything drawn or written of records that are not the study's own: quick runs, other readings, stale ones.

use crate::analysis::claims::claims_hash;
use crate::analysis::evidence::{Evidence, default_point};
use crate::analysis::verdict::Verdicts;
use crate::study::ReadingChoice;
use crate::study::paper::Paper;

/// What every output of a quick run says.
pub const QUICK: &str = "Quick run: few replicates, not the study's result.";

/// The sentences that every output of these verdicts carries; none for a full run under the default readings.
pub fn marks(paper: &Paper, verdicts: &Verdicts) -> Vec<String> {
    let quick = verdicts.quick.then(|| QUICK.to_owned());
    let point = ReadingChoice::new(&paper.readings(), &verdicts.reading).ok();
    let other = point.filter(|point| *point != default_point(paper));
    let reading = other.map(|point| {
        format!(
            "Reading: {}; what captions and notes say of results holds for the default readings.",
            point.name()
        )
    });
    quick.into_iter().chain(reading).collect()
}

/// What a chapter begins with: [`marks`], and what is stale in the stored run and its verdicts.
pub fn state(evidence: &Evidence<'_>, verdicts: &Verdicts) -> Vec<String> {
    let paper = evidence.paper;
    let mut said = marks(paper, verdicts);
    if !verdicts.quick && evidence.runs().any(|run| run.manifest.quick) {
        said.push(QUICK.to_owned());
    }
    let asked = paper.claims.iter().map(|claim| (&claim.id, &claim.printed));
    if !asked.eq(verdicts.claims.iter().map(|judged| (&judged.claim, &judged.printed))) {
        said.push(format!(
            "Stale: the stored verdicts are on other claims than paper.toml has now; run `replan judge {}`.",
            paper.id
        ));
    }
    let hash = claims_hash(paper);
    let changed = evidence.runs().filter(|run| run.manifest.claims != hash).map(|run| &run.study.name);
    let changed: Vec<String> = changed.map(|name| format!("`{name}`")).collect();
    if !changed.is_empty() {
        said.push(format!(
            "Stale: claims or margins changed after study {} was run; run `replan repro {} --fresh`.",
            changed.join(", "),
            paper.id
        ));
    }
    said
}
