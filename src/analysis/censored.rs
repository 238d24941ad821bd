//! Cases without a number.
//!
//! The instances are filled in with the least or the greatest values that could speak against the finding. Two more
//! counts are reported: cases whose paths the verifier refuses, and cases outside a claim about solved ones.

use super::evidence::Evidence;
use super::metric::Better;
use super::selection::{Case, Instance, Selection, by_instance, cases, censored};
use std::collections::BTreeSet;
use study::record::{Row, Status};

/// The pairs of every instance, with censored cases filled in by a difference that outweighs every observed one.
///
/// Where the contender alone failed, the difference is against it; where the other alone failed, it is for it. No
/// number is below 0. A side that did not come to an end might have been the better one with more budget: there the sign
/// is unknown, and both are tried. A result found with either sign does not hang on these cases. Nothing is returned
/// where nothing is censored.
pub fn filled(selection: &Selection<'_>, instances: &[Instance<'_>]) -> Vec<Vec<Vec<(f64, f64)>>> {
    let seen = || cases(instances).filter_map(Case::pair);
    let count = seen().count();
    if censored(instances) == 0 || count == 0 {
        return Vec::new();
    }
    let middle = seen().map(|(base, _)| base).sum::<f64>() / count as f64;
    // Where all that were seen agree, those that were not may differ by as much as they are.
    let most = seen().map(|(base, own)| (own - base).abs()).fold(middle.abs(), f64::max) * count as f64;
    let worse = match selection.metric.map(|metric| metric.better) {
        Some(Better::Lower) => 1.0,
        Some(Better::Higher) => -1.0,
        Some(Better::Neither) | None => 0.0,
    };
    let number = |case: &Case<'_>, unknown: f64| {
        let way = match (case.base_value, case.value) {
            _ if worse == 0.0 || case.is_unended() => unknown,
            (Some(_), None) => worse,
            (None, Some(_)) => -worse,
            _ => unknown,
        };
        let filled = || (middle, (middle + way * most).max(0.0));
        case.pair().or_else(|| case.is_censored().then(filled))
    };
    [1.0, -1.0].map(|unknown| by_instance(instances, |case| number(case, unknown))).to_vec()
}

/// The instances as they would be if each case without an end had given the number that `given` says of its instance.
pub fn ended<'e>(instances: &[Instance<'e>], given: impl Fn(&Instance<'e>) -> f64) -> Vec<Instance<'e>> {
    let of_instance = |instance: &Instance<'e>| {
        let number = given(instance);
        let ended =
            |case: &Case<'e>| if case.is_unended() { Case { value: Some(number), ..*case } } else { *case };
        Instance { group: instance.group, cases: instance.cases.iter().map(ended).collect() }
    };
    instances.iter().map(of_instance).collect()
}

/// How many cases have no number because the verifier refuses a path.
pub fn refused(instances: &[Instance<'_>]) -> usize {
    let is_refused = |row: &Row| row.status == Status::Rejected;
    let refused =
        |case: &&Case<'_>| case.is_censored() && (is_refused(case.row) || case.base.is_some_and(is_refused));
    cases(instances).filter(refused).count()
}

/// How many cases are outside a claim about cases that all compared contenders solve. A refused path that gave a number is inside.
pub fn outside(instances: &[Instance<'_>]) -> usize {
    let is_outside = |case: &&Case<'_>| {
        let is_counted = case.base.map_or(case.value, |_| case.pair().map(|(_, own)| own)).is_some();
        !is_counted && !case.is_solved() && !case.might_be_solved()
    };
    cases(instances).filter(is_outside).count()
}

/// The sentence that `count` cases are outside a claim about `selection`; `None` if none is.
pub fn outside_in_words(selection: &Selection<'_>, count: usize) -> Option<String> {
    let why = match (selection.counts_refused(), selection.against.is_some()) {
        (true, true) => "no path of one at least",
        (true, false) => "no path",
        (false, true) => "not solved by both",
        (false, false) => "not solved",
    };
    (count > 0).then(|| format!("{count} more cases are outside of the claim: {why}"))
}

/// How many problems of `selection` cannot be posed, with the reason of the first, in words; `None` if all can.
pub fn not_posed(selection: &Selection<'_>, evidence: &Evidence<'_>) -> Option<String> {
    let run = selection.run(evidence)?;
    let contenders = || selection.contenders.iter().chain(&selection.against);
    let rows: Vec<&Row> = selection
        .groups
        .iter()
        .flat_map(|group| contenders().flat_map(|contender| run.rows(group, contender)))
        .collect();
    let problems: BTreeSet<_> = rows.iter().map(|row| (&row.key.on, &row.key.query)).collect();
    let mut invalid = rows.iter().filter(|row| row.status == Status::InvalidProblem);
    let left: BTreeSet<_> = invalid.clone().map(|row| (&row.key.on, &row.key.query)).collect();
    let reason = invalid.find_map(|row| row.reason.as_deref()).unwrap_or("no reason is stored");
    (!left.is_empty())
        .then(|| format!("no problem could be posed in {} of {}: {reason}", left.len(), problems.len()))
}

/// The share of returned paths, of everything selected, that the verifier refuses.
pub fn refused_share(selections: &[&Selection<'_>], evidence: &Evidence<'_>) -> f64 {
    let [mut refused, mut returned] = [0_usize; 2];
    for selection in selections {
        let Some(run) = selection.run(evidence) else { continue };
        let contenders = selection.contenders.iter().chain(&selection.against);
        let cases =
            contenders.flat_map(|contender| selection.groups.iter().map(move |group| (group, contender)));
        for row in cases.flat_map(|(group, contender)| selection.rows(run, group, contender)) {
            returned += usize::from(row.is_returned());
            refused += usize::from(row.status == Status::Rejected);
        }
    }
    if returned == 0 { 0.0 } else { refused as f64 / returned as f64 }
}
