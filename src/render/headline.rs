//! Headline claims in a few words: what the paper says, our number with its direction, and the verdict.
//!
//! The terminal, the report and the page open with them.

use super::effect::{Effect, effect, rounded};
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
    /// Our number in words with how many instances it rests on; `None` if there is none, or if the parts of the claim measure
    /// different things.
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
    /// The verdict with the counts over interpretations, where they were explored, or with how many meanings have which verdict.
    pub fn verdict(&self, verdicts: &Verdicts) -> String {
        let verdict = self.judged.verdict_text();
        match self.beside(verdicts) {
            Some(counts) => format!("{verdict}, {counts}"),
            None => verdict,
        }
    }

    /// The counts over interpretations, or how many meanings have which verdict.
    pub fn beside(&self, verdicts: &Verdicts) -> Option<String> {
        match self.judged.beside.as_deref()? {
            counts if counts.starts_with("meanings: ") => meanings(self.judged, verdicts),
            counts => counts.split("; ").next().map(str::to_owned),
        }
    }
}

/// How many of the meanings of a sentence have each verdict, if they differ.
fn meanings(judged: &ClaimVerdict, verdicts: &Verdicts) -> Option<String> {
    let parts = verdicts.claims.iter().filter(|part| part.part_of.as_ref() == Some(&judged.claim));
    let mut counts: Vec<(String, usize)> = Vec::new();
    for verdict in parts.map(ClaimVerdict::verdict_text) {
        match counts.iter_mut().find(|(known, _)| *known == verdict) {
            Some((_, count)) => *count += 1,
            None => counts.push((verdict, 1)),
        }
    }
    let of_each: Vec<String> = counts.iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
    (counts.len() > 1).then(|| format!("by meaning: {}", of_each.join(", ")))
}

/// How much was explored, and the command that does it again. A headline names the choices that were not varied for it.
pub fn evidence(verdicts: &Verdicts) -> String {
    let again = format!("`replan repro {}` computes it again.", verdicts.paper);
    let Some(explored) = &verdicts.explored else {
        return format!("Judged under the defaults alone. {again}");
    };
    let seed = if explored.second_seed { "and a second seed" } else { "but no second seed" };
    format!("Explored: {} interpretations, {seed}. {again}", explored.interpretations)
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
        return (!is_rank).then(|| format!("{printed}{letter}{}{unit} (n = {})", number(), ours.n));
    }
    let parts = verdicts.claims.iter().filter(|part| part.part_of.as_ref() == Some(&judged.claim));
    let estimates: Vec<&Estimate> = parts.filter_map(ClaimVerdict::ours).collect();
    // Whatever the events are: the sentence that they are parts of says what is counted.
    let subject = |estimate: &Estimate| match estimate.what.split(", ").next() {
        Some(what) if what.starts_with("share of events") => Some("share of events".to_owned()),
        what => what.map(str::to_owned),
    };
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
    let number = |size: &f64| rounded(*size, decimals);
    let mut counts: Vec<usize> = estimates.iter().map(|estimate| estimate.n).collect();
    if counts.iter().all(|n| *n == counts[0]) {
        counts.truncate(1);
    }
    if sizes.len() <= LISTED {
        let joined = |all: Vec<String>| all.join(" / ");
        let n = joined(counts.iter().map(ToString::to_string).collect());
        return Some(format!("{}{words} (n = {n})", joined(sizes.iter().map(number).collect())));
    }
    sizes.sort_by(f64::total_cmp);
    counts.sort_unstable();
    let n = if counts.len() == 1 {
        counts[0].to_string()
    } else {
        format!("{} to {}", counts[0], counts.last()?)
    };
    Some(format!("{} to {}{words} (n = {n})", number(sizes.first()?), number(sizes.last()?)))
}
