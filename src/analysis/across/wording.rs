//! The words beside a verdict: over how many interpretations it is the same, its exceptions, or on what it depends.

use super::super::outcome::{Outcome, Polarity};
use super::super::settle::COMBINATION;
use super::super::verdict_rule::{Chosen, Line, Results};
use super::count::{Counted, Group, VotingChoices};
use super::depends::{Rule, Sides};
use super::stored::Exploration;

/// How many exceptions, or choices of a kind, are listed one by one.
const LISTED: usize = 3;

/// An exception with more options than these is counted and not listed.
const OPTIONS: usize = 2;

/// The words beside every verdict on trials that no run of ours made, which caps it at supported and not supported.
pub const ELSEWHERE: &str = "on trials recorded elsewhere, not reproduced here";

/// Where the two seeds speak opposite ways.
pub const SEED_DECIDES: &str = "the seed decides";

/// Of what holds by its sign and misses the printed size.
const SIGN_ALONE: &str = "the sign alone";

/// The first of `choices` after `what`, and how many more there are; `None` if there are none.
pub fn listed(what: &str, choices: &[String]) -> Option<String> {
    let listed = choices.iter().take(LISTED).cloned().collect::<Vec<_>>().join(", ");
    let more = choices.len().saturating_sub(LISTED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    (!choices.is_empty()).then(|| format!("{what}: {listed}{more}"))
}

/// The results of a claim that count, and where they come from.
pub struct View<'a> {
    /// The choices of the paper.
    pub choices: &'a VotingChoices,
    /// What was explored; `None` if the default alone was judged.
    pub first: Option<&'a Exploration>,
    /// The claim.
    pub id: &'a str,
    /// The interpretations that count.
    pub counted: &'a Counted,
    /// What each result counts as.
    pub results: &'a Results<'a>,
}

/// The words beside a verdict, and on what it depends.
pub struct Wording {
    /// What stands beside the verdict, the counts first.
    pub beside: Vec<String>,
    /// The choices on which the verdict depends.
    pub depends_on: Option<String>,
}

impl View<'_> {
    /// The words for a verdict by this line of the table.
    pub fn wording(&self, line: Line) -> Wording {
        let [holds, _, fails] = self.results.counts();
        let all = self.results.outcomes.len();
        let mut depends_on = None;
        let is_witness = self.results.chosen == Some(Chosen::Existence);
        let beside = match line {
            Line::Met if all > 1 => vec![format!("met under {holds} of {all}{}", self.met())],
            Line::Proved | Line::Lacking | Line::All | Line::Met => {
                let is_same = self.counted.looked > 1 && !self.results.is_unvaried;
                let alike = self.results.outcomes.windows(2).all(|pair| pair[0] == pair[1]);
                let what = if alike { "same" } else { "same direction" };
                let same = is_same.then(|| format!("{what} under all {}", self.counted.looked));
                // Where a choice was not varied, the verdict's own word does not say so.
                let is_sign =
                    self.results.is_unvaried && matches!(line, Line::All) && self.results.is_sign_alone();
                same.into_iter().chain(is_sign.then(|| SIGN_ALONE.to_owned())).collect()
            }
            Line::NoExample if !is_witness => vec![format!("met under none of {all}")],
            Line::NoExample if all > 1 => vec![format!("no example found under {all}")],
            Line::NoExample => vec!["no example found".to_owned()],
            Line::Refused => vec!["the second seed contradicts what was fitted".to_owned()],
            Line::SeedDecides => {
                let [one, two] = [self.results.default, self.results.second].map(way);
                self.with_counts([Some(format!("{SEED_DECIDES}: the first {one}, the second {two}")), None])
            }
            Line::Nine | Line::More => {
                let speaks = if holds > fails { Polarity::For } else { Polarity::Against };
                let is_sign = speaks == Polarity::For && self.results.is_sign_alone();
                let sign = is_sign.then(|| SIGN_ALONE.to_owned());
                self.with_counts([sign, self.exceptions(speaks)])
            }
            Line::Both => {
                let (on, rule) = self.rule();
                depends_on = Some(on);
                self.with_counts([Some(rule), None])
            }
            Line::Short => self.with_counts([None, None]),
        };
        Wording { beside, depends_on }
    }

    /// The counts of several results, and more.
    fn with_counts(&self, more: [Option<String>; 2]) -> Vec<String> {
        let [holds, open, fails] = self.results.counts();
        let is_counted = self.results.outcomes.len() > 1;
        let counts = is_counted.then(|| format!("{holds}/{open}/{fails} for/open/against"));
        counts.into_iter().chain(more.into_iter().flatten()).collect()
    }

    /// The first interpretation that meets the claim, if it is not the default.
    fn met(&self) -> String {
        let named = self.first_met().and_then(|group| self.named(group));
        named.map_or_else(String::new, |name| format!(", {name} among them"))
    }

    fn first_met(&self) -> Option<&Group> {
        let mut both = self.counted.groups.iter().zip(self.results.outcomes);
        both.find(|(_, outcome)| outcome.polarity() == Polarity::For).map(|(group, _)| group)
    }

    /// Which printed values would have been refused under the first interpretation that meets the claim, if it is not the default.
    pub fn power(&self) -> Option<String> {
        let group = self.first_met()?;
        let power = self.first?.result(self.id, group.interpretation)?.power.as_ref()?;
        Some(format!("power under {}: {power}", self.named(group)?))
    }

    /// A result, named after the options of its first interpretation that differ from the defaults; `None` of the defaults.
    fn named(&self, group: &Group) -> Option<String> {
        let departures = self.departures(group);
        (!departures.is_empty()).then(|| departures.join(", "))
    }

    /// The options of a result's first interpretation that differ from the defaults: those of choices that can move the claim, or
    /// all if none of these differs. A witness needs all options that its contender ran under.
    fn departures(&self, group: &Group) -> Vec<String> {
        let Some(first) = self.first else { return Vec::new() };
        let sides = self.sides(first, |_| None);
        let moving: Vec<&String> = sides.moving().map(|choice| &choice.id).collect();
        let all = &first.interpretations[group.interpretation];
        let is_moving = |(id, _): &(&String, &String)| moving.contains(id);
        let lists_all =
            self.results.chosen == Some(Chosen::Existence) || !all.iter().any(|one| is_moving(&one));
        let is_listed = |one: &(&String, &String)| lists_all || is_moving(one);
        all.iter().filter(is_listed).map(|(id, option)| format!("{id} = {option}")).collect()
    }

    /// The sides of the results as `of` parts them.
    fn sides<'s>(&'s self, first: &'s Exploration, of: impl Fn(Polarity) -> Option<bool>) -> Sides<'s> {
        let sides = self.results.outcomes.iter().map(|outcome: &Outcome| of(outcome.polarity())).collect();
        Sides { choices: self.choices, first, id: self.id, groups: &self.counted.groups, sides }
    }

    /// The results that do not speak as most do: what they share, or their names.
    fn exceptions(&self, speaks: Polarity) -> Option<String> {
        let sides = self.sides(self.first?, |way| Some(way != speaks));
        let apart: Vec<&Group> = sides
            .groups
            .iter()
            .zip(&sides.sides)
            .filter(|(_, side)| **side == Some(true))
            .map(|(group, _)| group)
            .collect();
        let all = match apart.len() {
            0 => return None,
            1 => "the exception has".to_owned(),
            count => format!("all {count} exceptions have"),
        };
        if let Some(rule) = sides.rule(false) {
            return Some(format!("{all} {}", rule.in_words()));
        }
        let name = |group: &&Group| self.named(group).unwrap_or_else(|| "the defaults".to_owned());
        let short = apart.iter().filter(|group| self.departures(group).len() <= OPTIONS);
        let mut names: Vec<String> = short.take(LISTED).map(name).collect();
        let more = apart.len() - names.len();
        names.extend((more > 0).then(|| format!("{more} more")));
        Some(format!("exceptions: {}", names.join(" · ")))
    }

    /// On what it depends which way the results speak, in few words and with its counts.
    fn rule(&self) -> (String, String) {
        let Some(first) = self.first else { return (COMBINATION.to_owned(), String::new()) };
        let sides = self.sides(first, |way| match way {
            Polarity::Against => Some(true),
            Polarity::Open => None,
            Polarity::For => Some(false),
        });
        let rule = sides.rule(true);
        let words = |rule: &Rule| {
            let verb = if rule.is_first_side { "contradicted" } else { "holds" };
            format!("{verb} only if {} ({} of {})", rule.in_words(), rule.hits, rule.covered)
        };
        if let Some(rule) = rule.as_ref().filter(|rule| rule.is_exact) {
            return (rule.choices(), words(rule));
        }
        let separates = sides.separating().map(|(choice, shares)| format!("{choice} matters most: {shares}"));
        let words = separates.or_else(|| rule.as_ref().map(words));
        (COMBINATION.to_owned(), words.unwrap_or_else(|| "no option separates them".to_owned()))
    }
}

fn way(way: Polarity) -> &'static str {
    match way {
        Polarity::For => "holds",
        Polarity::Open => "is open",
        Polarity::Against => "contradicts",
    }
}
