//! Headline claims in a few words: what the paper says, our number with its direction, and the verdict.
//!
//! The terminal, the report and the page open with them.

use super::effect::{effect, percentage, side_by_side};
use super::figure::noun;
use super::prose::number;
use super::tables::short;
use crate::analysis::across::wording::SEED_DECIDES;
use crate::analysis::settle::COMBINATION;
use crate::analysis::verdict::{ClaimVerdict, Estimate, LEAST_P, Quantity, Verdicts};
use crate::analysis::verdict_rule::Verdict;
use study::Choice;
use study::paper::Paper;

/// A paper without headlines shows its first claims instead, at most so many.
const CLAIMS: usize = 8;

/// What verdicts mean where no paper makes the claims.
const OURS: &str = "No paper makes these claims: “reproduced” means that a claim of ours holds, “not reproduced” that it does not. ";

/// A headline claim.
pub struct Headline<'a> {
    /// The claim.
    pub judged: &'a ClaimVerdict,
    /// What the paper says.
    pub says: String,
    /// Our number in words with how many instances it rests on; `None` if there is none, or if the parts of the claim measure
    /// more than two things.
    pub ours: Option<String>,
    /// Whether the sentence means one of several claims, whose verdicts make its own.
    has_meanings: bool,
    /// The choices of the paper.
    choices: &'a [Choice],
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
        let ours = ours(judged, paper, verdicts);
        Headline { judged, says: says.clone(), ours, has_meanings, choices: &paper.choices }
    };
    shown.into_iter().map(headline).collect()
}

impl Headline<'_> {
    /// The verdict with the counts over interpretations, where they were explored, or with how many meanings have which verdict.
    pub fn verdict(&self, verdicts: &Verdicts) -> String {
        self.verdict_with(self.counts(verdicts))
    }

    /// The same, with what it depends on and its exceptions.
    pub fn verdict_in_full(&self, verdicts: &Verdicts) -> String {
        self.verdict_with(self.all_words(verdicts))
    }

    fn verdict_with(&self, words: Option<String>) -> String {
        let on = self.judged.depends_on.as_ref().filter(|on| !self.has_meanings && *on != COMBINATION);
        let verdict = match on.filter(|_| self.judged.verdict == Verdict::Depends) {
            Some(on) => format!("{} on {on}", self.judged.word()),
            None => self.judged.word().to_owned(),
        };
        let text = words.map_or_else(|| verdict.clone(), |words| format!("{verdict}, {words}"));
        titled(&text, self.choices)
    }

    /// The counts over interpretations, with the options on which it depends; or how many meanings have which verdict.
    pub fn beside(&self, verdicts: &Verdicts) -> Option<String> {
        self.counts(verdicts).map(|words| titled(&words, self.choices))
    }

    /// The same, with what it depends on, its exceptions, and what would settle it if it is inconclusive.
    pub fn rests_on(&self, verdicts: &Verdicts) -> Option<String> {
        self.all_words(verdicts).map(|words| titled(&words, self.choices))
    }

    fn counts(&self, verdicts: &Verdicts) -> Option<String> {
        if self.has_meanings {
            return meanings(self.judged, verdicts);
        }
        let shown = if self.judged.verdict == Verdict::Depends { 2 } else { 1 };
        let words = self.judged.beside.iter().take(shown).map(|words| without_zeros(words));
        let by_seed = self.judged.beside.iter().any(|words| words.starts_with(SEED_DECIDES));
        words.chain(by_seed.then(|| SEED_DECIDES.to_owned())).reduce(|one, two| format!("{one}; {two}"))
    }

    fn all_words(&self, verdicts: &Verdicts) -> Option<String> {
        let judged = self.judged;
        let words = if self.has_meanings { meanings(judged, verdicts) } else { judged.rests_on() };
        let settles = judged.settles().filter(|_| judged.verdict == Verdict::Inconclusive);
        let settles = settles.map(|settles| format!("what would settle it: {settles}"));
        words.into_iter().chain(settles).reduce(|one, two| format!("{one}; {two}"))
    }
}

/// `words` beside a verdict with the title of each choice before its name, where it is named first.
fn titled(words: &str, choices: &[Choice]) -> String {
    let all: Vec<&str> = words.split(' ').collect();
    let mut left: Vec<(&str, &str)> =
        choices.iter().filter_map(|choice| Some((choice.id.as_str(), choice.title.as_deref()?))).collect();
    let mut is_listed = false;
    let mut text: Vec<String> = Vec::new();
    for (at, word) in all.iter().enumerate() {
        let bare = word.trim_end_matches([',', ';']);
        // An id may be a plain word too, so what stands around it decides.
        let is_behind = at > 0 && ["on", "and"].contains(&all[at - 1]);
        let is_before = all.get(at + 1).is_some_and(|next| ["=", "matters"].contains(next));
        let known = left.iter().position(|(id, _)| *id == bare);
        text.push(match known.filter(|_| is_listed || is_behind || is_before) {
            Some(place) => {
                let (id, title) = left.remove(place);
                format!("{title} ({id}){}", &word[id.len()..])
            }
            None => (*word).to_owned(),
        });
        is_listed = (is_listed || *word == "varied:") && !word.ends_with(';');
    }
    text.join(" ")
}

/// `words` without the options that none of their results contradict, where there are several.
fn without_zeros(words: &str) -> String {
    let (zeros, others): (Vec<&str>, Vec<&str>) =
        words.split(", ").partition(|part| part.starts_with("0 of "));
    if zeros.len() < 2 {
        return words.to_owned();
    }
    format!("{}, none otherwise", others.join(", "))
}

/// How many of the meanings of a sentence have each verdict, if they differ.
fn meanings(judged: &ClaimVerdict, verdicts: &Verdicts) -> Option<String> {
    let parts = verdicts.claims.iter().filter(|part| part.part_of.as_ref() == Some(&judged.claim));
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for verdict in parts.map(ClaimVerdict::word) {
        match counts.iter_mut().find(|(known, _)| *known == verdict) {
            Some((_, count)) => *count += 1,
            None => counts.push((verdict, 1)),
        }
    }
    let of_each: Vec<String> = counts.iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
    let all: usize = counts.iter().map(|(_, count)| count).sum();
    let all = ["two", "three", "four", "five", "six", "seven", "eight", "nine"]
        .get(all.wrapping_sub(2))
        .map_or_else(|| all.to_string(), ToString::to_string);
    (counts.len() > 1).then(|| format!("{all} readings of the sentence: {}", of_each.join(", ")))
}

/// How much was explored, and the command that does it again. A headline names the choices that were not varied for it.
pub fn evidence(paper: &Paper, verdicts: &Verdicts) -> String {
    let again = format!("`replan repro {}` computes it again.", verdicts.paper);
    let Some(explored) = &verdicts.explored else {
        let ours = if paper.source.ours { OURS } else { "" };
        return format!("{ours}Judged under the defaults alone. {again}");
    };
    let seed = if explored.second_seed { "and a second seed" } else { "but no second seed" };
    let explored = explored.interpretations;
    format!("Explored: {explored} interpretations, {seed}. Numbers are those of the defaults. {again}")
}

/// Our number beside a claim, or those of its parts, with how many instances they rest on.
pub fn ours(judged: &ClaimVerdict, paper: &Paper, verdicts: &Verdicts) -> Option<String> {
    let noun = noun(paper.studies_of(&judged.claim));
    if let Some(ours) = judged.ours() {
        let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
        let printed =
            judged.printed.as_ref().map_or_else(String::new, |printed| format!("printed {printed}, ours "));
        let number = match ours.quantity {
            Quantity::Rank => rank(ours, noun),
            Quantity::Probability => probability(ours.value, judged),
            _ => effect(ours).unwrap_or_else(|| short(ours) + &unit),
        };
        // One instance may hold many cases, such as the queries of one map.
        let cases = ours.solved.map(|[_, cases]| cases).filter(|&cases| ours.n == 1 && cases > 1);
        let cases = cases.map_or_else(String::new, |cases| format!(" with {cases} cases"));
        return Some(format!("{printed}{number} (n = {} {}{cases})", ours.n, counted(ours.n, noun)));
    }
    let [numbers, n] = side_by_side(&verdicts.parts_ours(judged))?;
    let noun = if n == "1" { counted(1, noun) } else { noun };
    Some(format!("{numbers} (n = {n} {noun})"))
}

/// A probability, with what it is after a correction and on the second seed.
fn probability(p: f64, judged: &ClaimVerdict) -> String {
    let is_least = p < LEAST_P;
    let first = if is_least { format!("p below {LEAST_P}") } else { format!("p = {}", number(p)) };
    let corrected = judged.corrected().filter(|_| !is_least);
    let corrected =
        corrected.map_or_else(String::new, |(what, corrected)| format!(", and {corrected} after {what}"));
    let second = judged.second_p.map_or_else(String::new, |p| {
        let p = if p < LEAST_P { format!("below {LEAST_P}") } else { number(p) };
        format!("; second seed {p}")
    });
    first + &corrected + &second
}

/// From this share on the printed numbers are called typical among ours.
const TYPICAL: f64 = 0.2;

/// How many of our instances are at least as far from the mean as the printed numbers.
fn rank(ours: &Estimate, noun: &str) -> String {
    let share = percentage(ours);
    if ours.value < TYPICAL {
        format!("unusual: only {share} of our {noun} lie as far from the mean or farther")
    } else {
        format!("typical: {share} of our {noun} lie as far from the mean or farther")
    }
}

/// The noun for so many instances: the plural without its s for one.
fn counted(n: usize, plural: &str) -> &str {
    plural.strip_suffix('s').filter(|_| n == 1).unwrap_or(plural)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_has_its_title_where_a_verdict_names_it_first_and_no_plain_word_has() {
        let choices = ["side_choice", "end", "rho"].map(|id| Choice {
            id: id.to_owned(),
            title: Some(format!("T{}", id.len())),
            why: String::new(),
            default: "a".to_owned(),
            fitted: false,
            bounds: None,
            options: std::collections::BTreeMap::new(),
            touches_trials: true,
            place: None,
        });
        let titled = |words: &str| titled(words, &choices);
        let counts =
            "53/0/9 for/open/against; side_choice matters most: 8 of 15 against with end, 1 of 47 with any";
        assert_eq!(titled(counts), counts.replace("side_choice", "T11 (side_choice)"));
        assert_eq!(
            titled("depends on end, holds only if end = a"),
            "depends on T3 (end), holds only if end = a"
        );
        let listed = "choices not varied: tool, end, rho and 3 more; the end of rho";
        assert_eq!(titled(listed), "choices not varied: tool, T3 (end), T3 (rho) and 3 more; the end of rho");
    }

    #[test]
    fn of_several_options_that_nothing_contradicts_none_is_named() {
        let words = "meeting matters most: 6 of 6 against with a, 0 of 4 with b";
        assert_eq!(without_zeros(words), words);
        let more = format!("{words}, 0 of 10 with c");
        assert_eq!(without_zeros(&more), "meeting matters most: 6 of 6 against with a, none otherwise");
    }
}
