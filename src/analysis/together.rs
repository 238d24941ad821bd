//! Which claims hold together under one interpretation.
//!
//! A paper's claims speak of several maps, but of one algorithm. So one set is made under one interpretation and one choice
//! of contenders: claims that look at the same problems share a problem, and each such group of claims takes one
//! of its problems. Every choice of problems is looked at, unless there are so many that one is taken and the set says so.

use super::context::Context;
use super::criterion::{Attained, EXISTS, Seen};
use super::evidence::Evidence;
use super::verdict::Together;
use base::settings::SettingsError;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use study::record::Row;

/// Whether each claim is met exactly.
type Outcomes<'a> = BTreeMap<&'a str, bool>;

/// Outcomes on one problem by contender.
type Contenders<'a> = BTreeMap<&'a str, Outcomes<'a>>;

/// Outcomes of one study: by problem, then contender.
type Problems<'a> = BTreeMap<String, Contenders<'a>>;

/// Most choices of problems that are all looked at.
const MOST_CHOICES: f64 = 64.0;

/// The sets of claims that are met exactly together, none within another, under the evidence's interpretation; the largest first.
///
/// # Errors
/// A settings error of a criterion.
pub fn together(evidence: &Evidence<'_>) -> Result<Vec<Together>, SettingsError> {
    let attained = attained_claims(evidence)?;
    let met = met(evidence, &attained);
    Ok(greatest(met.iter().flat_map(|(study, met)| sets_of(study, met, evidence.point.name())).collect()))
}

/// The criteria `exists` of all claims that print a number.
fn attained_claims<'a>(evidence: &'a Evidence<'_>) -> Result<Vec<Attained<'a>>, SettingsError> {
    let paper = evidence.paper;
    let point = &evidence.point;
    let contexts = paper.claims.iter().filter_map(|claim| {
        let settings = claim.check(EXISTS.name).filter(|_| claim.printed.is_some())?;
        Some(Context { claim, settings, paper, point })
    });
    contexts.map(|context| Attained::new(&context)).collect()
}

/// What each study shows under one interpretation.
fn met<'e>(view: &'e Evidence<'_>, claims: &'e [Attained<'_>]) -> BTreeMap<&'e str, Problems<'e>> {
    let mut all: BTreeMap<&str, BTreeMap<_, (Contenders<'e>, &'e Row)>> = BTreeMap::new();
    let each: Vec<_> = claims.par_iter().map(|attained| (attained.claim(), met_by(attained, view))).collect();
    for (claim, looked_at) in each {
        for (seen, is_met) in looked_at {
            let (study, group, instance, query) = seen.problem();
            let problems = all.entry(study).or_default();
            let by_contender =
                problems.entry((group, instance, query)).or_insert_with(|| (BTreeMap::new(), seen.row));
            by_contender.0.entry(seen.contender).or_default().insert(claim, is_met);
        }
    }
    // A problem's name is made once, however many claims look at it.
    let named = |(study, problems): (&'e str, BTreeMap<_, (Contenders<'e>, &'e Row)>)| {
        let run = view.run(study).expect("it was seen there");
        (study, problems.into_values().map(|(of, row)| (run.problem(row), of)).collect())
    };
    all.into_iter().map(named).collect()
}

/// Every trial in which a claim's number is looked for, and whether it is met there.
fn met_by<'e>(attained: &'e Attained<'_>, view: &'e Evidence<'_>) -> Vec<(Seen<'e>, bool)> {
    // A claim about the printed row of another contender is not met on a map without that row.
    let eligible: Option<BTreeSet<_>> = (!attained.is_unconditional())
        .then(|| attained.eligible(view).iter().map(|seen| (seen.problem(), seen.contender)).collect());
    let is_eligible = |seen: &Seen<'_>| {
        eligible.as_ref().is_none_or(|eligible| eligible.contains(&(seen.problem(), seen.contender)))
    };
    let with_outcome = |seen: Seen<'e>| {
        let is_met = attained.is_met(seen.value) && is_eligible(&seen);
        (seen, is_met)
    };
    attained.seen(view).into_iter().map(with_outcome).collect()
}

/// The sets of every contender that is an alternative for another; a contender that has none belongs to every set.
fn sets_of(study: &str, problems: &Problems<'_>, interpretation: &str) -> Vec<Together> {
    let mut claims: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (contender, outcomes) in problems.values().flatten() {
        claims.entry(*contender).or_default().extend(outcomes.keys().copied());
    }
    let rivals = |label: &&str| {
        claims.iter().any(|(other, theirs)| other != label && !theirs.is_disjoint(&claims[label]))
    };
    let (alternatives, fixed): (Vec<&str>, Vec<&str>) = claims.keys().partition(|label| rivals(label));
    let choices: Vec<Option<&str>> =
        if alternatives.is_empty() { vec![None] } else { alternatives.into_iter().map(Some).collect() };
    let of_choice = |choice: Option<&str>| {
        let labels: Vec<&str> = fixed.iter().copied().chain(choice).collect();
        let under = labels.join(" and ");
        let (choices, count) = choices_of_problems(problems, &labels);
        let mut sets: Vec<Together> =
            choices.iter().map(|chosen| set(study, interpretation, &under, chosen)).collect();
        if count > MOST_CHOICES {
            for set in &mut sets {
                set.problem += &format!(" (the largest of {count:.3e} choices)");
            }
        }
        sets
    };
    choices.into_iter().flat_map(of_choice).collect()
}

fn set(study: &str, interpretation: &str, under: &str, chosen: &[(&str, Outcomes<'_>)]) -> Together {
    let (mut hold, mut fail) = (Vec::new(), Vec::new());
    for (claim, is_met) in chosen.iter().flat_map(|(_, outcomes)| outcomes) {
        if *is_met { hold.push((*claim).to_owned()) } else { fail.push((*claim).to_owned()) }
    }
    hold.sort();
    fail.sort();
    Together {
        study: study.to_owned(),
        problem: chosen.iter().map(|(problem, _)| *problem).collect::<Vec<_>>().join(" and "),
        interpretation: interpretation.to_owned(),
        under: under.to_owned(),
        hold,
        fail,
    }
}

/// Every choice of one problem for each group of claims, but for problems on which no more of the group holds than on
/// another. Where there are more than [`MOST_CHOICES`], the one on which most of each group holds; then how many there are.
fn choices_of_problems<'a>(
    problems: &'a Problems<'_>,
    labels: &[&str],
) -> (Vec<Vec<(&'a str, Outcomes<'a>)>>, f64) {
    let mut groups: Vec<Vec<(&str, Outcomes<'_>)>> = Vec::new();
    let mut group_of: BTreeMap<&str, usize> = BTreeMap::new();
    for (problem, by_contender) in problems {
        let of = labels.iter().filter_map(|label| by_contender.get(*label)).flatten();
        let outcomes: Outcomes<'_> = of.map(|(claim, is_met)| (*claim, *is_met)).collect();
        // A contender that does not solve a problem leaves fewer claims there.
        let known = outcomes.keys().filter_map(|claim| group_of.get(claim)).min();
        let group = known.copied().unwrap_or(groups.len());
        if group == groups.len() {
            groups.push(Vec::new());
        }
        for claim in outcomes.keys() {
            group_of.entry(claim).and_modify(|known| *known = group.min(*known)).or_insert(group);
        }
        groups[group].push((problem, outcomes));
    }
    let kept = groups.into_iter().map(greatest_problems);
    let mut kept: Vec<_> = kept.filter(|of_group| !of_group.is_empty()).collect();
    // A float: twenty groups of ten problems each have more choices than a whole number holds.
    let count: f64 = kept.iter().map(|of_group| of_group.len() as f64).product();
    if count > MOST_CHOICES {
        for of_group in &mut kept {
            let largest =
                of_group.iter().enumerate().rev().max_by_key(|(_, (_, outcomes))| held(outcomes).len());
            *of_group = largest.map(|(place, _)| vec![of_group[place].clone()]).unwrap_or_default();
        }
    }
    let choices = kept.into_iter().fold(vec![Vec::new()], |choices, of_group| {
        let with = |choice: &Vec<(&'a str, Outcomes<'a>)>| {
            let one = |next: &(&'a str, Outcomes<'a>)| [&choice[..], std::slice::from_ref(next)].concat();
            of_group.iter().map(one).collect::<Vec<_>>()
        };
        choices.iter().flat_map(with).collect()
    });
    (choices, count)
}

/// The claims that are met.
fn held<'a>(outcomes: &Outcomes<'a>) -> BTreeSet<&'a str> {
    outcomes.iter().filter(|(_, is_met)| **is_met).map(|(claim, _)| *claim).collect()
}

/// The problems on which something holds and no other has all that holds and more; of equals the first.
fn greatest_problems<'a>(of_group: Vec<(&'a str, Outcomes<'a>)>) -> Vec<(&'a str, Outcomes<'a>)> {
    let mut first: BTreeMap<BTreeSet<&str>, usize> = BTreeMap::new();
    for (place, (_, outcomes)) in of_group.iter().enumerate() {
        first.entry(held(outcomes)).or_insert(place);
    }
    first.remove(&BTreeSet::new());
    let mut sets: Vec<(BTreeSet<&str>, usize)> = first.into_iter().collect();
    sets.sort_by_key(|(held, _)| std::cmp::Reverse(held.len()));
    let mut greatest: Vec<(BTreeSet<&str>, usize)> = Vec::new();
    for (held, place) in sets {
        if !greatest.iter().any(|(other, _)| held.is_subset(other)) {
            greatest.push((held, place));
        }
    }
    let places: BTreeSet<usize> = greatest.into_iter().map(|(_, place)| place).collect();
    of_group.into_iter().enumerate().filter(|(place, _)| places.contains(place)).map(|(_, one)| one).collect()
}

/// The sets of more than one claim that lie within no other, the largest first and of equals the first.
pub fn greatest(mut sets: Vec<Together>) -> Vec<Together> {
    sets.retain(|set| set.hold.len() > 1);
    sets.sort_by_key(|set| std::cmp::Reverse(set.hold.len()));
    let mut kept: Vec<Together> = Vec::new();
    let mut held: Vec<BTreeSet<String>> = Vec::new();
    for set in sets {
        if !held.iter().any(|other| set.hold.iter().all(|claim| other.contains(claim))) {
            held.push(set.hold.iter().cloned().collect());
            kept.push(set);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcomes<'a>(of: &[(&'a str, bool)]) -> Outcomes<'a> {
        of.iter().copied().collect()
    }

    #[test]
    fn claims_of_two_maps_join_under_one_contender_and_rivals_stay_apart() {
        let problem = |base: &[_], one: &[_], two: &[_]| {
            Contenders::from([("base", outcomes(base)), ("one", outcomes(one)), ("two", outcomes(two))])
        };
        let problems = BTreeMap::from([
            ("a1".to_owned(), problem(&[("a", true)], &[("b", true)], &[("b", false)])),
            ("a2".to_owned(), problem(&[("a", true)], &[("b", false)], &[("b", false)])),
            ("z1".to_owned(), problem(&[("y", false)], &[("z", false)], &[("z", true)])),
        ]);
        let sets = sets_of("s", &problems, "r=2");
        let seen: Vec<_> =
            sets.iter().map(|s| (s.under.as_str(), s.problem.as_str(), s.hold.join(" "))).collect();
        assert_eq!(
            seen,
            [("base and one", "a1", "a b".to_owned()), ("base and two", "a1 and z1", "a z".to_owned())]
        );
        assert_eq!(sets[1].fail, ["b", "y"]);
        assert_eq!([&sets[0].interpretation, &sets[1].interpretation], ["r=2", "r=2"]);
    }

    #[test]
    fn a_map_with_fewer_but_other_claims_makes_a_set_of_its_own() {
        let problem = |of: &[_]| Contenders::from([("base", outcomes(of))]);
        let problems = BTreeMap::from([
            ("m1".to_owned(), problem(&[("a", true), ("b", true), ("c", false)])),
            ("m2".to_owned(), problem(&[("a", false), ("b", false), ("c", true)])),
            ("m3".to_owned(), problem(&[("a", true), ("b", false), ("c", false)])),
        ]);
        let sets = sets_of("s", &problems, "default");
        let seen: Vec<_> = sets.iter().map(|s| (s.problem.as_str(), s.hold.join(" "))).collect();
        assert_eq!(seen, [("m1", "a b".to_owned()), ("m2", "c".to_owned())]);
    }

    #[test]
    fn of_too_many_choices_the_largest_is_taken_and_the_set_says_so() {
        let names: Vec<[String; 3]> = (0..20).map(|g| ["a", "b", "c"].map(|id| format!("{id}{g}"))).collect();
        let mut problems = Problems::new();
        for (group, [a, b, c]) in names.iter().enumerate() {
            for (problem, met) in [[true, false, false], [false, true, true]].iter().enumerate() {
                let of: Vec<(&str, bool)> = [a, b, c].iter().map(|id| id.as_str()).zip(*met).collect();
                problems.insert(format!("m{group}.{problem}"), Contenders::from([("base", outcomes(&of))]));
            }
        }
        let sets = sets_of("s", &problems, "default");
        assert_eq!(sets.len(), 1);
        assert_eq!([sets[0].hold.len(), sets[0].fail.len()], [40, 20]);
        assert!(sets[0].problem.ends_with("m9.1 (the largest of 1.049e6 choices)"), "{}", sets[0].problem);
    }

    #[test]
    fn only_sets_within_no_other_are_listed() {
        let set = |hold: &str| Together {
            study: String::new(),
            problem: String::new(),
            interpretation: String::new(),
            under: String::new(),
            hold: hold.split(' ').map(str::to_owned).collect(),
            fail: Vec::new(),
        };
        let kept = greatest(["a b", "a", "c d", "a b c", "b c", "c d"].map(set).to_vec());
        assert_eq!(kept.iter().map(|set| set.hold.join(" ")).collect::<Vec<_>>(), ["a b c", "c d"]);
    }
}
