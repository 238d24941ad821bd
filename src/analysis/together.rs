//! Which claims hold together under one reading.
//!
//! A paper's claims speak of several maps, but of one algorithm. So one set is made under one reading and one choice
//! of contenders: claims that are asked of the same problems share a problem, and each such group of claims takes one
//! of its problems. Every choice of problems is looked at.

use super::class::{Polarity, Verdict};
use super::criterion::{Attained, Context, EXISTS};
use super::evidence::Evidence;
use super::verdict::Together;
use crate::study::{ReadingChoice, StudyError};
use base::settings::SettingsError;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Whether each claim is met exactly.
type Outcomes = BTreeMap<String, bool>;

/// Outcomes of one study: by problem, then contender.
type Problems = BTreeMap<String, BTreeMap<String, Outcomes>>;

/// What a criterion says of a claim under each reading that a study explores.
#[derive(Debug, Clone)]
pub struct Explored {
    /// The claim.
    pub claim: String,
    /// The study.
    pub study: String,
    /// Each reading with the class there; none if it was not run.
    pub readings: Vec<(ReadingChoice, Option<Verdict>)>,
}

impl Explored {
    /// Under how many readings it holds, in a sentence.
    pub fn said(&self) -> Option<String> {
        let known: Vec<(&ReadingChoice, Polarity)> =
            self.readings.iter().filter_map(|(point, verdict)| Some((point, (*verdict)?.polarity()))).collect();
        let count = |wanted| known.iter().filter(|(_, polarity)| *polarity == wanted).count();
        let (held, open) = (count(Polarity::For), count(Polarity::Open));
        let rarer = if held * 2 > known.len() { Polarity::Against } else { Polarity::For };
        let single = known.iter().filter(|(point, polarity)| *polarity == rarer && !point.name().contains(','));
        let named = single.map(|(point, _)| point.name()).collect::<Vec<_>>().join(", ");
        let verb = if rarer == Polarity::For { "under" } else { "not under" };
        let tail = if named.is_empty() { String::new() } else { format!("; of the single options {verb} {named}") };
        (!known.is_empty()).then(|| {
            format!(
                "it holds under {held} of {} readings explored in {} and is open under {open}{tail}",
                known.len(),
                self.study
            )
        })
    }
}

/// What one study shows under one reading.
#[derive(Default)]
struct Met {
    problems: Problems,
    /// The reading that each contender runs under.
    readings: BTreeMap<String, String>,
}

/// The sets of claims that are met exactly together, none within another, over every reading that any study explores; the
/// largest first.
///
/// # Errors
/// A settings error of a check.
pub fn together(evidence: &Evidence<'_>, explored: &[Explored]) -> Result<Vec<Together>, SettingsError> {
    let under = |point| {
        let view = evidence.under(point);
        let mut sets = held(view.point.name(), explored);
        sets.extend(met(&view)?.iter().flat_map(|(study, met)| sets_of(study, met, view.point.name())));
        Ok(sets)
    };
    // Gathered in order before any error is passed on, so that it is the first reading's.
    let found: Vec<Result<Vec<Together>, SettingsError>> =
        points(evidence).into_par_iter().map(under).collect();
    Ok(greatest(found.into_iter().collect::<Result<Vec<_>, _>>()?.concat()))
}

/// The reading in hand, and those that studies explore.
fn points(evidence: &Evidence<'_>) -> Vec<ReadingChoice> {
    let readings = evidence.paper.readings();
    let mut points = vec![evidence.point.clone()];
    let explored = evidence.paper.studies.iter().filter(|study| study.explore.is_some());
    for point in explored.flat_map(|study| study.explored().unwrap_or_else(|_: StudyError| Vec::new())) {
        let point = point.within(&readings);
        if !points.contains(&point) {
            points.push(point);
        }
    }
    points
}

fn met(view: &Evidence<'_>) -> Result<BTreeMap<String, Met>, SettingsError> {
    let mut all: BTreeMap<String, Met> = BTreeMap::new();
    for claim in &view.paper.claims {
        let Some(settings) = claim.check(EXISTS.name).filter(|_| claim.printed.is_some()) else { continue };
        let attained = Attained::new(&Context { claim, settings, paper: view.paper, point: &view.point })?;
        for seen in attained.seen(view) {
            let met = all.entry(seen.run.study.name.clone()).or_default();
            met.readings.insert(seen.contender.to_owned(), seen.reading.to_string());
            let by_contender = met.problems.entry(seen.run.problem(seen.row)).or_default();
            let outcomes = by_contender.entry(seen.contender.to_owned()).or_default();
            outcomes.insert(claim.id.clone(), attained.is_met(seen.value));
        }
    }
    Ok(all)
}

/// One set per study that explores readings: the claims that hold there under the reading, each by the contenders and on the
/// problems that it names.
fn held(reading: &str, explored: &[Explored]) -> Vec<Together> {
    let mut studies: BTreeMap<&str, [BTreeSet<String>; 2]> = BTreeMap::new();
    for one in explored {
        let found = one.readings.iter().find(|(point, _)| point.name() == reading);
        let Some(verdict) = found.and_then(|(_, verdict)| *verdict) else { continue };
        let [hold, fail] = studies.entry(&one.study).or_default();
        if verdict.polarity() == Polarity::For { hold } else { fail }.insert(one.claim.clone());
    }
    let set = |(study, [hold, fail]): (&str, [BTreeSet<String>; 2])| Together {
        study: study.to_owned(),
        problem: "those that each claim names".to_owned(),
        reading: reading.to_owned(),
        under: "those that each claim names".to_owned(),
        hold: hold.difference(&fail).cloned().collect(),
        fail: fail.into_iter().collect(),
    };
    studies.into_iter().map(set).collect()
}

/// The sets of every contender that is an alternative for another; contenders without alternative belong to all.
fn sets_of(study: &str, met: &Met, reading: &str) -> Vec<Together> {
    let mut claims: BTreeMap<&String, BTreeSet<&String>> = BTreeMap::new();
    for (contender, outcomes) in met.problems.values().flatten() {
        claims.entry(contender).or_default().extend(outcomes.keys());
    }
    let rivals = |label: &String| {
        claims.iter().any(|(other, theirs)| *other != label && !theirs.is_disjoint(&claims[label]))
    };
    let (alternatives, fixed): (Vec<&String>, Vec<&String>) = claims.keys().partition(|label| rivals(label));
    let choices: Vec<Option<&String>> =
        if alternatives.is_empty() { vec![None] } else { alternatives.into_iter().map(Some).collect() };
    let of_choice = |choice: Option<&String>| {
        let labels: Vec<&String> = fixed.iter().copied().chain(choice).collect();
        let departed = labels.iter().filter_map(|label| met.readings.get(*label));
        let reading = departed.into_iter().find(|own| *own != reading).map_or(reading, String::as_str);
        let under = labels.iter().map(|label| label.as_str()).collect::<Vec<_>>().join(" and ");
        let choices = choices_of_problems(&met.problems, &labels).into_iter();
        choices.map(|chosen| set(study, reading, &under, &chosen)).collect::<Vec<_>>()
    };
    choices.into_iter().flat_map(of_choice).collect()
}

fn set(study: &str, reading: &str, under: &str, chosen: &[(&String, Outcomes)]) -> Together {
    let (mut hold, mut fail) = (Vec::new(), Vec::new());
    for (claim, is_met) in chosen.iter().flat_map(|(_, outcomes)| outcomes) {
        if *is_met { hold.push(claim.clone()) } else { fail.push(claim.clone()) }
    }
    hold.sort();
    fail.sort();
    Together {
        study: study.to_owned(),
        problem: chosen.iter().map(|(problem, _)| problem.as_str()).collect::<Vec<_>>().join(" and "),
        reading: reading.to_owned(),
        under: under.to_owned(),
        hold,
        fail,
    }
}

/// Every choice of one problem for each group of claims, but for problems on which no more of the group holds than on
/// another.
fn choices_of_problems<'a>(problems: &'a Problems, labels: &[&String]) -> Vec<Vec<(&'a String, Outcomes)>> {
    let mut groups: Vec<(BTreeSet<String>, Vec<(&String, Outcomes)>)> = Vec::new();
    for (problem, by_contender) in problems {
        let of = labels.iter().filter_map(|label| by_contender.get(*label)).flatten();
        let outcomes: Outcomes = of.map(|(claim, is_met)| (claim.clone(), *is_met)).collect();
        let claims: BTreeSet<String> = outcomes.keys().cloned().collect();
        // A contender that does not solve a problem leaves fewer claims there.
        match groups.iter_mut().find(|(known, _)| !known.is_disjoint(&claims)) {
            Some((known, of_group)) => {
                known.extend(claims);
                of_group.push((problem, outcomes));
            }
            None => groups.push((claims, vec![(problem, outcomes)])),
        }
    }
    let kept = groups.into_iter().map(|(_, of_group)| greatest_problems(of_group));
    kept.filter(|of_group| !of_group.is_empty()).fold(vec![Vec::new()], |choices, of_group| {
        let with = |choice: &Vec<(&'a String, Outcomes)>| {
            let one = |next: &(&'a String, Outcomes)| [&choice[..], std::slice::from_ref(next)].concat();
            of_group.iter().map(one).collect::<Vec<_>>()
        };
        choices.iter().flat_map(with).collect()
    })
}

/// The problems on which something holds and no other has all that holds and more; of equals the first.
fn greatest_problems(of_group: Vec<(&String, Outcomes)>) -> Vec<(&String, Outcomes)> {
    let hold = |outcomes: &Outcomes| {
        outcomes
            .iter()
            .filter(|(_, is_met)| **is_met)
            .map(|(claim, _)| claim.clone())
            .collect::<BTreeSet<_>>()
    };
    let mut sets: Vec<BTreeSet<String>> = Vec::new();
    let mut distinct = Vec::new();
    for (problem, outcomes) in of_group {
        let held = hold(&outcomes);
        if !held.is_empty() && !sets.contains(&held) {
            sets.push(held.clone());
            distinct.push((held, problem, outcomes));
        }
    }
    let is_greatest =
        |held: &BTreeSet<String>| !sets.iter().any(|other| other != held && held.is_subset(other));
    distinct.retain(|(held, _, _)| is_greatest(held));
    distinct.into_iter().map(|(_, problem, outcomes)| (problem, outcomes)).collect()
}

/// The sets of more than one claim that lie within no other, the largest first and of equals the first.
fn greatest(mut sets: Vec<Together>) -> Vec<Together> {
    sets.sort_by_key(|set| std::cmp::Reverse(set.hold.len()));
    let mut kept: Vec<Together> = Vec::new();
    for set in sets {
        let is_within = kept.iter().any(|other| set.hold.iter().all(|claim| other.hold.contains(claim)));
        if set.hold.len() > 1 && !is_within {
            kept.push(set);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcomes(of: &[(&str, bool)]) -> BTreeMap<String, bool> {
        of.iter().map(|(claim, is_met)| ((*claim).to_owned(), *is_met)).collect()
    }

    #[test]
    fn claims_of_two_maps_join_under_one_contender_and_rivals_stay_apart() {
        let problem = |base: &[(&str, bool)], one: &[(&str, bool)], two: &[(&str, bool)]| {
            [("base", base), ("one", one), ("two", two)]
                .into_iter()
                .map(|(label, of)| (label.to_owned(), outcomes(of)))
                .collect::<BTreeMap<_, _>>()
        };
        let problems = BTreeMap::from([
            ("a1".to_owned(), problem(&[("a", true)], &[("b", true)], &[("b", false)])),
            ("a2".to_owned(), problem(&[("a", true)], &[("b", false)], &[("b", false)])),
            ("z1".to_owned(), problem(&[("y", false)], &[("z", false)], &[("z", true)])),
        ]);
        let readings = [("base", "default"), ("one", "default"), ("two", "r=2")];
        let readings = readings.map(|(label, reading)| (label.to_owned(), reading.to_owned())).into();
        let sets = sets_of("s", &Met { problems, readings }, "default");
        let seen: Vec<_> =
            sets.iter().map(|s| (s.under.as_str(), s.problem.as_str(), s.hold.join(" "))).collect();
        assert_eq!(
            seen,
            [("base and one", "a1", "a b".to_owned()), ("base and two", "a1 and z1", "a z".to_owned())]
        );
        assert_eq!(sets[1].fail, ["b", "y"]);
        assert_eq!([&sets[0].reading, &sets[1].reading], ["default", "r=2"]);
    }

    #[test]
    fn a_map_with_fewer_but_other_claims_makes_a_set_of_its_own() {
        let problem = |of: &[(&str, bool)]| BTreeMap::from([("base".to_owned(), outcomes(of))]);
        let problems = BTreeMap::from([
            ("m1".to_owned(), problem(&[("a", true), ("b", true), ("c", false)])),
            ("m2".to_owned(), problem(&[("a", false), ("b", false), ("c", true)])),
            ("m3".to_owned(), problem(&[("a", true), ("b", false), ("c", false)])),
        ]);
        let sets = sets_of("s", &Met { problems, readings: BTreeMap::new() }, "default");
        let seen: Vec<_> = sets.iter().map(|s| (s.problem.as_str(), s.hold.join(" "))).collect();
        assert_eq!(seen, [("m1", "a b".to_owned()), ("m2", "c".to_owned())]);
    }

    #[test]
    fn only_sets_within_no_other_are_listed() {
        let set = |hold: &str| Together {
            study: String::new(),
            problem: String::new(),
            reading: String::new(),
            under: String::new(),
            hold: hold.split(' ').map(str::to_owned).collect(),
            fail: Vec::new(),
        };
        let kept = greatest(["a b", "a", "c d", "a b c", "b c", "c d"].map(set).to_vec());
        assert_eq!(kept.iter().map(|set| set.hold.join(" ")).collect::<Vec<_>>(), ["a b c", "c d"]);
    }
}
