//! Joint tests by interpretation: which interpretations the printed numbers fit, and which they refuse.

use super::super::criterion::table_means;
use super::super::outcome::Polarity;
use super::super::verdict::p_text;
use super::count::VotingChoices;
use super::glance::Sight;
use super::stored::{Exploration, ExploredResult};
use std::collections::{BTreeMap, BTreeSet};
use study::Choice;
use study::paper::{Claim, Paper};

/// How many interpretations of one result are named.
const NAMED: usize = 4;

/// How many results that are refused are named.
const REFUSED: usize = 10;

/// How the line begins that says which options fit.
pub const FITS: &str = "fits: ";

/// How the line begins that says which options fit with no other.
pub const REFUSES: &str = "refuses: ";

/// How the line of each of these begins, with the printed number that is farthest from ours where its p is greatest.
pub const AGAINST: &str = "against ";

/// The lines of a claim that is tested jointly: which options fit and which do not, and its results, the likeliest first, each with the
/// interpretations that give it.
pub fn tested(paper: &Paper, choices: &VotingChoices, first: &Exploration, claim: &Claim) -> Vec<String> {
    let explored = first.claims.get(&claim.id).filter(|_| claim.check(table_means::ENTRY.name).is_some());
    let mut results: Vec<(f64, &ExploredResult)> = explored
        .into_iter()
        .flat_map(|explored| &explored.results)
        .filter_map(|result| Some((result.value?, result)))
        .collect();
    results.sort_by(|one, other| other.0.total_cmp(&one.0));
    let times = table_means::interpretations(paper, claim);
    let p = |value: f64| format!("p = {}{}", p_text(value), bracketed(value, times));
    let named = |place: &usize| {
        let options = &first.interpretations[*place];
        let options: Vec<String> = options.iter().map(|(id, option)| format!("{id} = {option}")).collect();
        if options.is_empty() { "the defaults".to_owned() } else { options.join(", ") }
    };
    let line = |(value, result): &(f64, &ExploredResult)| {
        let places = &result.interpretations;
        let more = places.len().saturating_sub(NAMED);
        let more = if more > 0 { format!(" · {more} more") } else { String::new() };
        let names: Vec<String> = places.iter().take(NAMED).map(named).collect();
        format!("{}, {}: {}{more}", p(*value), result.outcome.name(), names.join(" · "))
    };
    let (refused, kept): (Vec<&(f64, &ExploredResult)>, Vec<_>) =
        results.iter().partition(|(_, result)| result.outcome.polarity() == Polarity::Against);
    let rest = refused.get(REFUSED).map(|(value, _)| {
        format!("{} or less, contradicted: {} further results", p(*value), refused.len() - REFUSED)
    });
    let named = kept.into_iter().chain(refused.into_iter().take(REFUSED)).map(line);
    let touching = table_means::touching(paper, claim);
    by_option(choices, &touching, first, &results, times).into_iter().chain(named).chain(rest).collect()
}

/// What a probability is after correcting for so many interpretations; `None` for one.
fn corrected(value: f64, times: usize) -> Option<String> {
    (times > 1).then(|| format!("{} after correcting", p_text((value * times as f64).min(1.0))))
}

/// The same in brackets, or nothing.
fn bracketed(value: f64, times: usize) -> String {
    corrected(value, times).map_or_else(String::new, |corrected| format!(" ({corrected})"))
}

/// Which options of the choices `touching` the claim fit, which fit with no option of other choices, and what speaks against each of
/// these, of `results` under interpretations that vote; empty unless there are both.
pub(super) fn by_option(
    choices: &VotingChoices,
    touching: &BTreeMap<&str, &Choice>,
    first: &Exploration,
    results: &[(f64, &ExploredResult)],
    times: usize,
) -> Vec<String> {
    let seen = results.iter().filter(|(_, result)| result.sight == Sight::Looked);
    let each = seen.flat_map(|(value, result)| {
        let places = result.interpretations.iter().map(|place| &first.interpretations[*place]);
        places.map(move |place| (place, (*value, *result), result.outcome.polarity() == Polarity::For))
    });
    let voting: Vec<_> = each.filter(|(place, ..)| choices.votes(place)).collect();
    let options = |choice: &Choice, fitting: bool| -> BTreeSet<String> {
        let of = voting.iter().filter(|(_, _, fits)| *fits || !fitting);
        of.map(|(place, ..)| VotingChoices::option(choice, place).to_owned()).collect()
    };
    let (mut fits, mut refuses, mut any) = (Vec::new(), Vec::new(), Vec::new());
    let (mut against, mut greatest_of_all) = (Vec::new(), 0.0_f64);
    for choice in choices.choices.iter().filter(|choice| touching.contains_key(choice.id.as_str())) {
        let (looked, kept) = (options(choice, false), options(choice, true));
        if looked.len() < 2 || kept.is_empty() {
            continue;
        }
        if looked == kept {
            any.push(choice.id.clone());
            continue;
        }
        let kept_options: Vec<&str> = kept.iter().map(String::as_str).collect();
        fits.push(format!("{} = {}", choice.id, kept_options.join(" or ")));
        let refused: Vec<&str> = looked.difference(&kept).map(String::as_str).collect();
        refuses.push(format!("{} = {}", choice.id, refused.join(" or ")));
        for option in refused {
            let own = voting.iter().filter(|(place, ..)| VotingChoices::option(choice, place) == option);
            let likeliest = own.map(|(_, found, _)| *found).max_by(|one, other| one.0.total_cmp(&other.0));
            let Some((value, result)) = likeliest else { continue };
            greatest_of_all = greatest_of_all.max(value);
            let farthest =
                result.farthest.as_ref().map_or_else(String::new, |far| format!("; farthest off is {far}"));
            let p = format!("p at most {}{}", p_text(value), bracketed(value, times));
            against.push(format!("{AGAINST}{} = {option}: {p}{farthest}", choice.id));
        }
    }
    if fits.is_empty() {
        return Vec::new();
    }
    let with_any =
        if any.is_empty() { String::new() } else { format!(", with every option of {}", any.join(", ")) };
    let fits = format!("{FITS}{}{with_any}", fits.join(", "));
    let corrected = corrected(greatest_of_all, times)
        .map_or_else(String::new, |corrected| format!(", and {corrected} for {times} interpretations"));
    let p = format!("p at most {}{corrected}", p_text(greatest_of_all));
    let refuses = format!("{REFUSES}{} ({p})", refuses.join(", "));
    [fits, refuses].into_iter().chain(against).collect()
}
