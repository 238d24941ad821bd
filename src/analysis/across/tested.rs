//! Joint tests by interpretation: which interpretations the printed numbers fit, and which they refuse.

use super::super::criterion::table_means::{self, p_text};
use super::super::outcome::Polarity;
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
pub const REFUSES: &str = "refuses, each with its greatest p: ";

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
    let p = |value: f64| match times {
        1 => format!("p = {}", p_text(value)),
        _ => format!("p = {}, times {times} {}", p_text(value), p_text((value * times as f64).min(1.0))),
    };
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
    by_option(choices, &touching, first, &results, &p)
        .into_iter()
        .flatten()
        .chain(named)
        .chain(rest)
        .collect()
}

/// Which options of the choices `touching` the claim fit, and which fit with no option of other choices, of `results` under
/// interpretations that vote; `None` unless there are both.
pub(super) fn by_option(
    choices: &VotingChoices,
    touching: &BTreeMap<&str, &Choice>,
    first: &Exploration,
    results: &[(f64, &ExploredResult)],
    p: &impl Fn(f64) -> String,
) -> Option<[String; 2]> {
    let seen = results.iter().filter(|(_, result)| result.sight == Sight::Looked);
    let each = seen.flat_map(|(value, result)| {
        let places = result.interpretations.iter().map(|place| &first.interpretations[*place]);
        places.map(move |place| (place, *value, result.outcome.polarity() == Polarity::For))
    });
    let voting: Vec<_> = each.filter(|(place, ..)| choices.votes(place)).collect();
    let options = |choice: &Choice, fitting: bool| -> BTreeSet<String> {
        let of = voting.iter().filter(|(_, _, fits)| *fits || !fitting);
        of.map(|(place, ..)| VotingChoices::option(choice, place).to_owned()).collect()
    };
    let (mut fits, mut refuses, mut any) = (Vec::new(), Vec::new(), Vec::new());
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
        for option in looked.difference(&kept) {
            let own = voting.iter().filter(|(place, ..)| VotingChoices::option(choice, place) == *option);
            let greatest = own.map(|(_, value, _)| *value).fold(0.0, f64::max);
            refuses.push(format!("{} = {option} ({})", choice.id, p(greatest)));
        }
    }
    let with_any = if any.is_empty() { String::new() } else { format!(", with any {}", any.join(", ")) };
    (!fits.is_empty())
        .then(|| [format!("{FITS}{}{with_any}", fits.join(", ")), REFUSES.to_owned() + &refuses.join(", ")])
}
