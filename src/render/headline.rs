//! Headline claims in a few words: what the paper says, our number with its direction, and the verdict.
//!
//! The terminal, the report and the page open with them.

use super::effect::{Effect, effect, rounded};
use super::prose::number;
use super::tables::short;
use crate::analysis::verdict::{ClaimVerdict, Estimate, Quantity, Verdicts};
use crate::analysis::verdict_rule::Verdict;
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
    /// Whether the sentence means one of several claims, whose verdicts make its own.
    has_meanings: bool,
}

/// The headline claims of a paper, in the order of its claims.
pub fn headlines<'a>(paper: &'a Paper, verdicts: &'a Verdicts) -> Vec<Headline<'a>> {
    let mut shown: Vec<&ClaimVerdict> = verdicts.headlines(paper).collect();
    if shown.is_empty() {
        shown = verdicts.claims.iter().filter(|judged| judged.is_counted()).take(CLAIMS).collect();
    }
    let headline = |judged: &'a ClaimVerdict| {
        let sentences = [&judged.short, &judged.says, &judged.quote];
        let says = sentences.into_iter().flatten().next().unwrap_or(&judged.at);
        let has_meanings = paper.claim(&judged.claim).is_some_and(|claim| claim.meanings().is_some());
        Headline { judged, says: says.clone(), ours: ours(judged, verdicts), has_meanings }
    };
    shown.into_iter().map(headline).collect()
}

impl Headline<'_> {
    /// The verdict with the counts over interpretations, where they were explored, or with how many meanings have which verdict.
    pub fn verdict(&self, verdicts: &Verdicts) -> String {
        self.verdict_with(self.beside(verdicts))
    }

    /// The same, with what it depends on and its exceptions.
    pub fn verdict_in_full(&self, verdicts: &Verdicts) -> String {
        self.verdict_with(self.rests_on(verdicts))
    }

    fn verdict_with(&self, words: Option<String>) -> String {
        let verdict = self.judged.verdict_text();
        words.map_or_else(|| verdict.clone(), |words| format!("{verdict}, {words}"))
    }

    /// The counts over interpretations, or how many meanings have which verdict.
    pub fn beside(&self, verdicts: &Verdicts) -> Option<String> {
        if self.has_meanings { meanings(self.judged, verdicts) } else { self.judged.beside.first().cloned() }
    }

    /// The same, with what it depends on, its exceptions, and what would settle it if it is inconclusive.
    pub fn rests_on(&self, verdicts: &Verdicts) -> Option<String> {
        let judged = self.judged;
        let words = if self.has_meanings { meanings(judged, verdicts) } else { judged.rests_on() };
        let settles = judged.settles().filter(|_| judged.verdict == Verdict::Inconclusive);
        let settles = settles.map(|settles| format!("what would settle it: {settles}"));
        words.into_iter().chain(settles).reduce(|one, two| format!("{one}; {two}"))
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
        let number = match ours.quantity {
            Quantity::Rank => {
                return Some(format!("{:.0} % of ours as far out (n = {})", 100.0 * ours.value, ours.n));
            }
            Quantity::Probability => format!("p = {}", number(ours.value)),
            _ => effect(ours).unwrap_or_else(|| short(ours) + &unit),
        };
        return Some(format!("{printed}{number} (n = {})", ours.n));
    }
    let parts = verdicts.claims.iter().filter(|part| part.part_of.as_ref() == Some(&judged.claim));
    let estimates: Vec<&Estimate> = parts.filter_map(ClaimVerdict::ours).collect();
    let first = estimates.first()?;
    let words = Effect::new(first).words;
    let is_alike = |estimate: &&Estimate| {
        (estimate.quantity, &estimate.subject) == (first.quantity, &first.subject)
            && Effect::new(estimate).words == words
            && (!estimate.quantity.is_number() || estimate.what == first.what)
    };
    if !estimates.iter().all(is_alike) {
        return None;
    }
    let effects: Vec<Effect> = estimates.iter().map(|estimate| Effect::new(estimate)).collect();
    let decimals = effects.iter().map(|effect| effect.decimals).min()?;
    let mut sizes: Vec<f64> = effects.iter().map(|effect| effect.size).collect();
    let in_digits = |size: &f64| rounded(*size, decimals);
    let mut counts: Vec<usize> = estimates.iter().map(|estimate| estimate.n).collect();
    if counts.iter().all(|n| *n == counts[0]) {
        counts.truncate(1);
    }
    if sizes.len() <= LISTED {
        let joined = |all: Vec<String>| all.join(" / ");
        let n = joined(counts.iter().map(ToString::to_string).collect());
        return Some(format!("{}{words} (n = {n})", joined(sizes.iter().map(in_digits).collect())));
    }
    sizes.sort_by(f64::total_cmp);
    counts.sort_unstable();
    let n = if counts.len() == 1 {
        counts[0].to_string()
    } else {
        format!("{} to {}", counts[0], counts.last()?)
    };
    Some(format!("{} to {}{words} (n = {n})", in_digits(sizes.first()?), in_digits(sizes.last()?)))
}
