//! What would settle an inconclusive claim: more instances where they help, and otherwise the obstacle.

use super::criterion_result::{CriterionResult, Narrows};
use super::outcome::{Caps, Outcome, Polarity, SESSIONS, Sessions};
use super::statistic::LEVEL;
use super::verdict::{Across, ClaimVerdict};
use super::verdict_rule::{Line, Verdict};
use stats::proportion::{agreeing_for_width, units_for_margin};
use study::paper::Parts;

/// On what a claim depends where no option and no two tell its sides apart.
pub const COMBINATION: &str = "several choices";

/// A sentence depends on this if its parts speak both ways.
pub const MEANT: &str = "what is meant";

/// A hundred times as many instances tell apart what differs by a tenth of what can be seen now; a larger number is an estimate of
/// noise.
const MANY: f64 = 100.0;

/// A sentence: what would settle this finding.
pub fn settles(found: &CriterionResult, caps: Caps) -> String {
    match caps.clock {
        Some(Sessions::TooFew) => {
            return format!(
                "{SESSIONS} sessions of the clock that agree: one session's interval does not know by how much sessions differ"
            );
        }
        Some(Sessions::Disagree) => {
            return "a clock whose sessions agree: those that are stored do not".to_owned();
        }
        Some(Sessions::Agree | Sessions::OfAnother) | None => {}
    }
    if caps.censored && found.refused > 0 {
        return format!(
            "paths that the verifier accepts: of the {} cases without a number, which could turn it, it refuses {}",
            found.censored, found.refused
        );
    }
    if caps.censored {
        return format!("results of the {} cases without a number, which could turn it", found.censored);
    }
    if found.ties > 0 {
        return format!("no more instances: {} tie, and the claim is strict", found.ties);
    }
    if caps.powerless {
        return "a paper that prints more than one instance: no number of ours narrows what one instance may be"
            .to_owned();
    }
    if let Some(needed) = found.needs {
        return format!("at least {needed} instances that have what is compared");
    }
    if found.existential {
        return "the paper's own input, on which one trial would do".to_owned();
    }
    if found.narrows == Narrows::AsTheNumber {
        return agreeing_instances(found);
    }
    more_instances(found)
        .unwrap_or_else(|| "the paper's own inputs: what is measured here stands neither way".to_owned())
}

/// What would settle a claim that nothing decides. `premises` say where alone it is meant, and `is_possible` whether
/// arithmetic found it possible.
pub fn nothing_decides(premises: &[String], is_possible: bool) -> String {
    if !premises.is_empty() {
        format!("an interpretation under which it is meant: {}", premises.join(", and "))
    } else if is_possible {
        "the paper's own input: arithmetic alone can only refuse, and did not".to_owned()
    } else {
        "a bound, or a number that the paper prints: what is measured is shown and held against nothing"
            .to_owned()
    }
}

/// What would settle a sentence whose parts leave it open.
pub fn parts_settle(parts: &Parts, outcomes: &[Outcome]) -> String {
    let speaks = |wanted| outcomes.iter().any(|outcome| outcome.polarity() == wanted);
    if matches!(parts, Parts::MeansOneOf(_)) && speaks(Polarity::For) && speaks(Polarity::Against) {
        return "which of its parts is meant: the paper does not say, and they speak both ways".to_owned();
    }
    let is_open = |(_, outcome): &(&String, &Outcome)| outcome.polarity() == Polarity::Open;
    let open: Vec<_> = parts.ids().iter().zip(outcomes).filter(is_open).collect();
    let named = |wanted: Outcome| -> Option<String> {
        let ids: Vec<String> =
            open.iter().filter(|(_, own)| **own == wanted).map(|(id, _)| format!("`{id}`")).collect();
        (!ids.is_empty()).then(|| ids.join(", "))
    };
    let lacking = named(Outcome::Lacking).map(|ids| format!("what the paper leaves out for {ids}"));
    let measured = named(Outcome::Open).map(|ids| format!("what settles {ids}"));
    measured.into_iter().chain(lacking).collect::<Vec<_>>().join(", and ")
}

/// What would settle a claim on which interpretations leave something open; `None` if they do not.
pub fn across_settles(across: &Across, judged: &ClaimVerdict, line: Line) -> Option<String> {
    match judged.verdict {
        Verdict::Depends => return Some(depends_settles(judged.depends_on.as_deref())),
        Verdict::Inconclusive => {}
        _ => return None,
    }
    match line {
        Line::SeedDecides => return Some("more instances: the two seeds disagree".to_owned()),
        Line::Refused => {
            return Some("more instances: the second seed contradicts what was fitted".to_owned());
        }
        Line::NoExample => return Some("the paper's own input, on which one trial would do".to_owned()),
        _ => {}
    }
    let measured = across.open - across.unconfirmed.min(across.open);
    // What stands in the way under the defaults is known better than what does elsewhere.
    let own = judged.findings.iter().find_map(|finding| finding.settles.clone());
    let own = own.filter(|_| judged.outcome == Outcome::Open).map(|own| format!("under the defaults {own}"));
    let instances = (measured > 0).then(|| {
        let under = format!("the {measured} of {} results that stand neither way", across.counted);
        own.map_or_else(|| format!("more instances under {under}"), |own| format!("{own}; {under} likewise"))
    });
    let seeds = (across.unconfirmed > 0).then(|| {
        format!("a second seed that says the same under the {} that it did not confirm", across.unconfirmed)
    });
    let ways: Vec<String> = instances.into_iter().chain(seeds).collect();
    Some(format!("{}, or the paper's own interpretation if it is none of these", ways.join(", ")))
}

/// What would settle a sentence that means one of its parts; `None` if it is settled.
pub fn meanings_settle(verdict: Verdict, depends_on: Option<&str>) -> Option<String> {
    match verdict {
        Verdict::Depends => Some(depends_settles(depends_on)),
        Verdict::Inconclusive => Some("what settles the meanings that are inconclusive".to_owned()),
        _ => None,
    }
}

/// What would settle a claim that depends on a choice, or on which of its parts is meant.
fn depends_settles(on: Option<&str>) -> String {
    match on {
        Some(MEANT) => {
            "which of its parts is meant: the paper does not say, and they speak both ways".to_owned()
        }
        None | Some(COMBINATION) => "which options the authors took together".to_owned(),
        Some(on) => format!("which option the authors took for {on}"),
    }
}

/// How many units would tell our number from the limit that its interval holds; none if no number would.
fn more_instances(found: &CriterionResult) -> Option<String> {
    let ours = found.ours.as_ref()?;
    let [low, high] = ours.interval?;
    let straddled = found.limits.iter().filter(|limit| (low..=high).contains(*limit));
    let margin = straddled.map(|limit| (ours.value - limit).abs()).fold(f64::INFINITY, f64::min);
    if margin == 0.0 || !margin.is_finite() {
        return None;
    }
    // Half of a lopsided interval may be less than the distance that it covers.
    let needed = units_for_margin((high - low) / 2.0, ours.n, margin).max(ours.n + 1);
    if needed as f64 > MANY * ours.n as f64 {
        return Some(format!(
            "no number of {} within reach: ours is too close to the limit to tell them apart",
            found.units
        ));
    }
    Some(format!("about {needed} {}, not {}, if our number is what it seems to be", found.units, ours.n))
}

/// How many units that all agree, as ours do, would bring the interval to this side of every limit.
fn agreeing_instances(found: &CriterionResult) -> String {
    let ours = found.ours.as_ref().filter(|ours| ours.interval.is_some_and(|[low, high]| low < high));
    let Some((ours, [low, high])) = ours.and_then(|ours| ours.interval.map(|interval| (ours, interval)))
    else {
        return "units to count among".to_owned();
    };
    // How far each limit is, in the part of the interval on its side.
    let far = |limit: &f64| {
        let side = if *limit < ours.value { ours.value - low } else { high - ours.value };
        (ours.value - limit).abs() / side
    };
    let others = found.limits.iter().filter(|limit| **limit != ours.value);
    let nearest = others.map(far).fold(f64::INFINITY, f64::min);
    if nearest >= 1.0 {
        return format!("more {} cannot settle it: the next may always disagree", found.units);
    }
    // Unequal chances make ours wider than as many equal ones do; they will do so of more.
    let of_equal = -libm::expm1(libm::log((1.0 - LEVEL) / 2.0) / ours.n as f64);
    let needed = agreeing_for_width(nearest * of_equal, LEVEL);
    format!("{needed} {}, not {}, if all agree as ours do", found.units, ours.n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::verdict::Estimate;
    use stats::interval::Interval;

    fn found([low, value, high]: [f64; 3]) -> CriterionResult {
        let ours = Some(Estimate::new(value, Interval::new(low, high), "a share", 10));
        CriterionResult { ours, limits: vec![0.5, 1.0], units: "trials", ..CriterionResult::default() }
    }

    #[test]
    fn an_interval_around_a_limit_asks_for_more_units() {
        let settled = |ends| settles(&found(ends), Caps::default());
        // Half a width of 1/4 against a distance of 1/8: four times as many.
        assert!(
            settled([0.25, 0.375, 0.75]).starts_with("about 40 trials, not 10"),
            "{}",
            settled([0.25, 0.375, 0.75])
        );
        // A distance of 1/400: ten thousand times as many.
        assert!(settled([0.25, 0.4975, 0.75]).starts_with("no number of trials within reach"));
        for no_number in [[0.4, 0.5, 0.6], [0.6, 0.7, 0.8]] {
            assert!(settled(no_number).starts_with("the paper's own inputs"), "{no_number:?}");
        }
    }

    #[test]
    fn instances_that_agree_ask_for_as_many_agreeing_ones_as_reach_the_limit() {
        let settled = |limits: [f64; 2], [low, value, high]: [f64; 3]| {
            let ours = Some(Estimate::new(value, Interval::new(low, high), "a share", 20));
            let limits = limits.to_vec();
            let units = "instances";
            settles(
                &CriterionResult {
                    ours,
                    limits,
                    units,
                    narrows: Narrows::AsTheNumber,
                    ..CriterionResult::default()
                },
                Caps::default(),
            )
        };
        let low = libm::pow(0.025, 0.05);
        assert_eq!(settled([0.9, 1.0], [low, 1.0, 1.0]), "36 instances, not 20, if all agree as ours do");
        assert_eq!(
            settled([0.0, 0.1], [0.0, 0.0, 1.0 - low]),
            "36 instances, not 20, if all agree as ours do"
        );
        assert!(settled([1.0, 1.0], [low, 1.0, 1.0]).starts_with("more instances cannot settle it"));
        // Between the ends a limit is seen by the part of the interval on its side.
        let ends = |share: f64| [share - share * (1.0 - low), share, share + (1.0 - share) * (1.0 - low)];
        assert_eq!(settled([0.675, 1.0], ends(0.75)), "36 instances, not 20, if all agree as ours do");
    }

    #[test]
    fn refused_paths_and_ties_are_named_and_more_instances_are_not() {
        let refused = CriterionResult { censored: 7, refused: 5, ..found([0.25, 0.375, 0.75]) };
        let words = settles(&refused, Caps { censored: true, ..Caps::default() });
        assert!(
            words.starts_with("paths that the verifier accepts") && words.ends_with("it refuses 5"),
            "{words}"
        );
        let tied = CriterionResult { ties: 9, ..found([0.25, 0.375, 0.75]) };
        assert_eq!(settles(&tied, Caps::default()), "no more instances: 9 tie, and the claim is strict");
    }

    #[test]
    fn parts_that_lack_facts_are_named_beside_those_that_were_measured() {
        let parts = Parts::AllOf(["a", "b", "c"].map(str::to_owned).to_vec());
        let words = parts_settle(&parts, &[Outcome::Holds, Outcome::Lacking, Outcome::Open]);
        assert_eq!(words, "what settles `c`, and what the paper leaves out for `b`");
    }

    #[test]
    fn what_stands_in_the_way_is_named_before_the_number_of_instances() {
        let found = CriterionResult { censored: 7, ..found([0.25, 0.375, 0.75]) };
        for (caps, expected) in [
            (Caps { censored: true, ..Caps::default() }, "7 cases"),
            (Caps { powerless: true, ..Caps::default() }, "more than one instance"),
            (Caps { clock: Some(Sessions::TooFew), ..Caps::default() }, "3 sessions"),
            (Caps { clock: Some(Sessions::Disagree), ..Caps::default() }, "sessions agree"),
        ] {
            assert!(settles(&found, caps).contains(expected), "{caps:?}: {}", settles(&found, caps));
        }
        let few = CriterionResult { needs: Some(39), ..CriterionResult::default() };
        assert_eq!(settles(&few, Caps::default()), "at least 39 instances that have what is compared");
    }
}
