//! Joint tests by interpretation: which interpretations the printed numbers fit, and which they refuse.

use super::stored::{Exploration, ExploredResult};
use study::paper::Claim;

/// The criterion whose number is a probability.
const JOINT: &str = "table_means";

/// How many interpretations of one result are named.
const NAMED: usize = 4;

/// The results of a claim that is tested jointly, the likeliest first, each with the interpretations that give it.
pub fn tested(first: &Exploration, claim: &Claim) -> Vec<String> {
    let explored = first.claims.get(&claim.id).filter(|_| claim.check(JOINT).is_some());
    let mut results: Vec<(f64, &ExploredResult)> = explored
        .into_iter()
        .flat_map(|explored| &explored.results)
        .filter_map(|result| Some((result.value?, result)))
        .collect();
    results.sort_by(|one, other| other.0.total_cmp(&one.0));
    let named = |place: &usize| {
        let options = &first.interpretations[*place];
        let options: Vec<String> = options.iter().map(|(id, option)| format!("{id} = {option}")).collect();
        if options.is_empty() { "the defaults".to_owned() } else { options.join(", ") }
    };
    let line = |(p, result): &(f64, &ExploredResult)| {
        let places = &result.interpretations;
        let more = places.len().saturating_sub(NAMED);
        let more = if more > 0 { format!(" · {more} more") } else { String::new() };
        let names: Vec<String> = places.iter().take(NAMED).map(named).collect();
        format!("p = {p:.2e}, {}: {}{more}", result.outcome.name(), names.join(" · "))
    };
    results.iter().map(line).collect()
}
