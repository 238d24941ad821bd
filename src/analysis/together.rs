//! Which claims hold together under one reading.
//!
//! A paper's claims speak of several maps, but of one algorithm. So one set is made under one reading and one choice
//! of contenders: claims that are asked of the same problems share a problem, and each such group of claims takes the
//! problem on which most of it holds.

use super::check::{Context, attained_problems};
use super::evidence::Evidence;
use super::verdict::Together;
use crate::settings::SettingsError;
use crate::study::{Point, StudyError};
use std::collections::{BTreeMap, BTreeSet};

/// How many sets are listed, the largest first.
const LISTED_SETS: usize = 5;

/// Outcomes by study, then problem, then contender, then claim: whether it is met exactly.
type Met = BTreeMap<String, BTreeMap<String, BTreeMap<String, BTreeMap<String, bool>>>>;

/// The largest sets of claims that are met exactly together, none within another, over every reading that any study
/// explores.
///
/// # Errors
/// A settings error of a check.
pub fn together(evidence: &Evidence<'_>) -> Result<Vec<Together>, SettingsError> {
    let mut sets = Vec::new();
    for point in points(evidence) {
        let met = met(&evidence.under(point.clone()))?;
        sets.extend(met.into_iter().flat_map(|(study, problems)| sets_of(&study, &problems, point.name())));
    }
    Ok(greatest(sets))
}

/// The reading in hand, and those that studies explore.
fn points(evidence: &Evidence<'_>) -> Vec<Point> {
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

fn met(view: &Evidence<'_>) -> Result<Met, SettingsError> {
    let mut all = Met::new();
    for claim in &view.paper.claims {
        let Some(settings) = claim.checks.get("attained") else { continue };
        let context = Context { claim, settings, paper: view.paper, point: &view.point };
        for (study, problem, contender, is_met) in attained_problems(&context, view)? {
            let by_contender = all.entry(study).or_default().entry(problem).or_default();
            by_contender.entry(contender).or_default().insert(claim.id.clone(), is_met);
        }
    }
    Ok(all)
}

/// One set per contender that is an alternative for another; contenders without alternative belong to every set.
fn sets_of(
    study: &str,
    problems: &BTreeMap<String, BTreeMap<String, BTreeMap<String, bool>>>,
    reading: &str,
) -> Vec<Together> {
    let mut claims: BTreeMap<&String, BTreeSet<&String>> = BTreeMap::new();
    for (contender, outcomes) in problems.values().flatten() {
        claims.entry(contender).or_default().extend(outcomes.keys());
    }
    let rivals = |label: &String| {
        claims.iter().any(|(other, theirs)| *other != label && !theirs.is_disjoint(&claims[label]))
    };
    let (alternatives, fixed): (Vec<&String>, Vec<&String>) = claims.keys().partition(|label| rivals(label));
    let choices: Vec<Option<&String>> =
        if alternatives.is_empty() { vec![None] } else { alternatives.into_iter().map(Some).collect() };
    let set = |choice: Option<&String>| {
        let labels: Vec<&String> = fixed.iter().copied().chain(choice).collect();
        let best = best_problems(problems, &labels);
        let (mut hold, mut fail) = (Vec::new(), Vec::new());
        for (claim, is_met) in best.iter().flat_map(|(_, outcomes)| outcomes) {
            if *is_met { hold.push((*claim).clone()) } else { fail.push((*claim).clone()) }
        }
        hold.sort();
        fail.sort();
        Together {
            study: study.to_owned(),
            problem: best.iter().map(|(problem, _)| *problem).cloned().collect::<Vec<_>>().join(" and "),
            reading: reading.to_owned(),
            under: labels.into_iter().cloned().collect::<Vec<_>>().join(" and "),
            hold,
            fail,
        }
    };
    choices.into_iter().map(set).collect()
}

type Outcomes<'a> = BTreeMap<&'a String, bool>;

/// Of all problems that claims share, the first on which most of these hold.
fn best_problems<'a>(
    problems: &'a BTreeMap<String, BTreeMap<String, BTreeMap<String, bool>>>,
    labels: &[&String],
) -> Vec<(&'a String, Outcomes<'a>)> {
    let count = |outcomes: &Outcomes<'_>| outcomes.values().filter(|is_met| **is_met).count();
    let mut groups: Vec<(BTreeSet<&String>, &String, Outcomes<'_>)> = Vec::new();
    for (problem, by_contender) in problems {
        let of = labels.iter().filter_map(|label| by_contender.get(*label)).flatten();
        let outcomes: Outcomes<'_> = of.map(|(claim, is_met)| (claim, *is_met)).collect();
        let claims: BTreeSet<&String> = outcomes.keys().copied().collect();
        // A contender that does not solve a problem leaves fewer claims there.
        match groups.iter_mut().find(|(known, _, _)| !known.is_disjoint(&claims)) {
            Some((known, best, of_best)) => {
                known.extend(claims);
                if count(&outcomes) > count(of_best) {
                    (*best, *of_best) = (problem, outcomes);
                }
            }
            None => groups.push((claims, problem, outcomes)),
        }
    }
    groups.retain(|(_, _, outcomes)| count(outcomes) > 0);
    groups.into_iter().map(|(_, problem, outcomes)| (problem, outcomes)).collect()
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
    kept.truncate(LISTED_SETS);
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
        let sets = sets_of("s", &problems, "default");
        let seen: Vec<_> =
            sets.iter().map(|s| (s.under.as_str(), s.problem.as_str(), s.hold.join(" "))).collect();
        assert_eq!(
            seen,
            [("base and one", "a1", "a b".to_owned()), ("base and two", "a1 and z1", "a z".to_owned())]
        );
        assert_eq!(sets[1].fail, ["b", "y"]);
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
