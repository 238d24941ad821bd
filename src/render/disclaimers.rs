//! Marks on figures and text from records that are not the study's own: quick runs, other interpretations, stale
//! records.

use crate::analysis::claims::records;
use crate::analysis::evidence::{Evidence, Run, default_point};
use crate::analysis::meaning::digest;
use crate::analysis::verdict::Verdicts;
use study::paper::Paper;
use study::{Choice, Interpretation, Study};

/// What every output of a quick run says.
pub const QUICK: &str = "Quick run: few instances, not the study's result.";

/// The sentences that every output of these verdicts carries; none for a full run under the default interpretation.
pub fn marks(paper: &Paper, verdicts: &Verdicts) -> Vec<String> {
    let quick = verdicts.quick.then(|| QUICK.to_owned());
    let point = Interpretation::new(&paper.choices, &verdicts.interpretation).ok();
    let other = point.filter(|point| *point != default_point(paper));
    let interpretation = other.map(|point| {
        format!(
            "Interpretation: {}; what captions and notes say of results holds for the default interpretation.",
            point.name()
        )
    });
    quick.into_iter().chain(interpretation).collect()
}

/// Which studies leave out a part of the interpretation that trials were run under, so that claims on them are judged without it.
fn untouched(paper: &Paper, verdicts: &Verdicts) -> Option<String> {
    let is_away = |choice: &&Choice| {
        verdicts.interpretation.get(&choice.id).is_some_and(|option| *option != choice.default)
    };
    let away: Vec<&Choice> = paper.choices.iter().filter(is_away).collect();
    let lacks = |study: &&Study| away.iter().any(|choice| study.leaves_out.contains(&choice.id));
    let names: Vec<String> =
        paper.studies.iter().filter(lacks).map(|study| format!("`{}`", study.name)).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Without all of this interpretation: {}; claims on what ran there are judged as they are by default, and `replan explore {}` \
             judges under it those that it can.",
            names.join(", "),
            paper.id
        )
    })
}

/// The first lines of a chapter: [`marks`], and what is stale in the stored run and its verdicts.
pub fn state(evidence: &Evidence<'_>, verdicts: &Verdicts) -> Vec<String> {
    let paper = evidence.paper;
    let mut lines = marks(paper, verdicts);
    lines.extend(untouched(paper, verdicts));
    if !verdicts.quick && evidence.runs().any(|run| run.manifest.quick) {
        lines.push(QUICK.to_owned());
    }
    lines.extend(verdicts.changed());
    if digest(paper) != verdicts.meanings {
        lines.push(format!(
            "Stale: the stored verdicts are on other claims than paper.toml has now; run `replan judge {}`.",
            paper.id
        ));
    }
    let stored = records(evidence);
    let again = evidence.runs().filter(|run| {
        let name = &run.study.name;
        stored.get(name) != verdicts.records.get(name)
    });
    let again = listed(again);
    if !again.is_empty() {
        lines.push(format!(
            "Stale: records of study {again} are others than the claims were judged from; run `replan judge {}`.",
            paper.id
        ));
    }
    lines
}

/// The studies of `runs`, named.
fn listed<'r>(runs: impl Iterator<Item = &'r Run<'r>>) -> String {
    runs.map(|run| format!("`{}`", run.study.name)).collect::<Vec<String>>().join(", ")
}
