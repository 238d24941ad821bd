//! Headline claims in a few words: what the paper says, our number with its direction, and the verdict.
//!
//! The terminal, the report and the page open with them.

use super::effect::{Effect, effect};
use super::tables::short;
use crate::analysis::verdict::{ClaimVerdict, Estimate, Verdicts};
use study::paper::Paper;

/// A paper without headlines shows its first claims instead, at most so many.
const CLAIMS: usize = 8;

/// The numbers of a claim with more parts are shown as a range.
const LISTED: usize = 3;

/// A headline claim.
pub struct Headline<'a> {
    /// The claim.
    pub judged: &'a ClaimVerdict,
    /// What the paper says.
    pub says: String,
    /// Our number in words; `None` if there is none, or if the parts of the claim measure different things.
    pub ours: Option<String>,
}

/// The headline claims of a paper, in the order of its claims.
pub fn headlines<'a>(paper: &'a Paper, verdicts: &'a Verdicts) -> Vec<Headline<'a>> {
    let mut shown: Vec<&ClaimVerdict> = verdicts.headlines(paper).collect();
    if shown.is_empty() {
        shown = verdicts.claims.iter().filter(|judged| judged.is_counted()).take(CLAIMS).collect();
    }
    let headline = |judged: &'a ClaimVerdict| {
        let short = paper.claim(&judged.claim).and_then(|claim| claim.short.as_ref());
        let says = short.or(judged.says.as_ref()).or(judged.quote.as_ref()).unwrap_or(&judged.at);
        Headline { judged, says: says.clone(), ours: ours(judged, verdicts) }
    };
    shown.into_iter().map(headline).collect()
}

impl Headline<'_> {
    /// The verdict with the counts over interpretations, where they were explored.
    pub fn verdict(&self) -> String {
        let verdict = self.judged.verdict_said();
        let beside = self.judged.said.as_deref().filter(|counts| !counts.starts_with("meanings: "));
        match beside.and_then(|counts| counts.split("; ").next()) {
            Some(counts) => format!("{verdict}, {counts}"),
            None => verdict,
        }
    }
}

/// Our number beside a claim, or those of its parts where they measure the same.
fn ours(judged: &ClaimVerdict, verdicts: &Verdicts) -> Option<String> {
    if let Some(ours) = judged.ours() {
        let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
        let printed =
            judged.printed.as_ref().map_or_else(String::new, |printed| format!("printed {printed}, ours "));
        // A rank among instances is a probability, not a size that a reader could compare.
        let is_rank = ours.what.starts_with("the lesser rank");
        let letter = if ours.what.starts_with("p of") { "p = " } else { "" };
        let number = || effect(ours).unwrap_or_else(|| short(ours));
        return (!is_rank).then(|| format!("{printed}{letter}{}{unit}", number()));
    }
    let parts = verdicts.claims.iter().filter(|part| part.part_of.as_ref() == Some(&judged.claim));
    let estimates: Vec<&Estimate> = parts.filter_map(ClaimVerdict::ours).collect();
    let subject = |estimate: &Estimate| estimate.what.split(", ").next().map(str::to_owned);
    let first = estimates.first().and_then(|estimate| subject(estimate))?;
    let effects: Vec<Effect> = estimates.iter().map(|estimate| Effect::new(estimate)).collect();
    let words = &effects[0].words;
    let is_one = estimates.iter().all(|estimate| subject(estimate).as_ref() == Some(&first))
        && effects.iter().all(|effect| effect.words == *words);
    if !is_one {
        return None;
    }
    let decimals = effects.iter().map(|effect| effect.decimals).min()?;
    let mut sizes: Vec<f64> = effects.iter().map(|effect| effect.size).collect();
    let number = |size: &f64| format!("{size:.decimals$}");
    if sizes.len() <= LISTED {
        return Some(format!("{}{words}", sizes.iter().map(number).collect::<Vec<_>>().join(" / ")));
    }
    sizes.sort_by(f64::total_cmp);
    Some(format!("{} to {}{words}", number(sizes.first()?), number(sizes.last()?)))
}
