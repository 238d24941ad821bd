//! What stands beside a class across readings: under how many it holds, or what it hangs on.

use super::super::class::{Polarity, Verdict};
use super::count::{Axes, Group};
use super::stored::Exploration;
use crate::study::Reading;
use std::collections::BTreeMap;

/// In a few words what the readings make of the claim called `id`.
pub fn said(
    axes: &Axes,
    first: &Exploration,
    id: &str,
    groups: &[Group],
    votes: &[Verdict],
    class: Verdict,
    is_existential: bool,
) -> String {
    let count = |wanted| votes.iter().filter(|vote| vote.polarity() == wanted).count();
    let (holds, fails, all) = (count(Polarity::For), count(Polarity::Against), votes.len());
    if all == 1 {
        return "no reading moves it".to_owned();
    }
    if is_existential && holds > 0 {
        let met = groups.iter().zip(votes).find(|(_, vote)| vote.polarity() == Polarity::For);
        // A contender of a study may depart from the defaults by itself, so that they are not what carries it.
        let departs = met.filter(|(group, _)| !first.readings[group.reading].is_empty());
        let named = departs
            .map_or_else(String::new, |(group, _)| format!(", {} among them", name(first, group.reading)));
        return format!("met under {holds} of {all}{named}");
    }
    if holds > 0 && fails > 0 {
        return hangs(axes, first, id, groups, votes);
    }
    let open = all - holds - fails;
    let tail = if open > 0 { format!(", open under {open}") } else { String::new() };
    match class.polarity() {
        Polarity::For => format!("holds under {holds} of {all}{tail}"),
        Polarity::Against => format!("fails under {fails} of {all}{tail}"),
        Polarity::Open if holds > 0 => format!("holds under {holds} of {all} only, open under {open}"),
        Polarity::Open if fails > 0 => format!("fails under {fails} of {all} only, open under {open}"),
        Polarity::Open => format!("open under {open} of {all}"),
    }
}

/// A reading by what differs from the defaults.
fn name(first: &Exploration, place: usize) -> String {
    let parts: Vec<String> =
        first.readings[place].iter().map(|(id, option)| format!("{id} = {option}")).collect();
    if parts.is_empty() { "the default".to_owned() } else { parts.join(", ") }
}

/// How often a claim holds and fails under an option of an axis.
type Split<'a> = BTreeMap<&'a str, [usize; 2]>;

/// What a claim hangs on that holds under some results and fails under others.
fn hangs(axes: &Axes, first: &Exploration, id: &str, groups: &[Group], votes: &[Verdict]) -> String {
    let class = votes.iter().filter(|vote| vote.polarity() == Polarity::For).max().copied();
    let class = class.unwrap_or(Verdict::Undecided).name();
    let splits = axes.readings.iter().map(|axis| (axis, split(axis, first, groups, votes)));
    let right = |split: &Split<'_>| split.values().map(|[holds, fails]| holds.max(fails)).sum::<usize>();
    let holds = votes.iter().filter(|vote| vote.polarity() == Polarity::For).count();
    let fails = votes.iter().filter(|vote| vote.polarity() == Polarity::Against).count();
    // Of equals the first.
    let best = splits.fold(None, |best: Option<(&Reading, Split<'_>)>, next| match best {
        Some(best) if right(&best.1) >= right(&next.1) => Some(best),
        _ => Some(next),
    });
    let all = votes.len();
    match best {
        Some((axis, split)) if right(&split) == holds + fails && decides(axis, &split, first, id) => {
            let options: Vec<&str> =
                split.iter().filter(|(_, [holds, _])| *holds > 0).map(|(option, _)| *option).collect();
            format!("hangs on {}: {class} if {} ({holds} of {all})", axis.id, options.join(" or "))
        }
        Some((axis, split)) if right(&split) > holds.max(fails) => {
            let shares = split.iter().filter(|(_, counts)| counts.iter().sum::<usize>() > 0);
            let shares: Vec<String> = shares
                .map(|(option, [holds, fails])| format!("{option} {holds} of {}", holds + fails))
                .collect();
            format!("hangs on {} and others: {class} under {holds} of {all} ({})", axis.id, shares.join(", "))
        }
        _ => format!("hangs on several readings: {class} under {holds} of {all}"),
    }
}

/// Whether each option of `axis` under which the claim holds does so by itself, all else at its default, as far as that was
/// looked at: in a sample of combinations an axis may part by chance what others decide.
fn decides(axis: &Reading, split: &Split<'_>, first: &Exploration, id: &str) -> bool {
    let holding = split.iter().filter(|(_, [holds, _])| *holds > 0).map(|(option, _)| *option);
    let alone = holding.filter(|option| *option != axis.default).filter_map(|option| {
        let place = first.place(&BTreeMap::from([(axis.id.clone(), option.to_owned())]))?;
        first.result(id, place)
    });
    alone.into_iter().all(|result| result.class.polarity() == Polarity::For)
}

/// By option of `axis`, under how many results a claim holds and fails; a result under several options belongs to the first.
fn split<'a>(axis: &'a Reading, first: &'a Exploration, groups: &[Group], votes: &[Verdict]) -> Split<'a> {
    let mut split = Split::new();
    for (group, vote) in groups.iter().zip(votes) {
        let counts = split.entry(Axes::option(axis, &first.readings[group.reading])).or_default();
        match vote.polarity() {
            Polarity::For => counts[0] += 1,
            Polarity::Against => counts[1] += 1,
            Polarity::Open => {}
        }
    }
    split
}
