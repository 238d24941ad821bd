//! Printed counts, percentages and times against what whole numbers allow.

use super::{Ends, Proof, spelled};
use crate::clock::Tick;
use crate::exact::{Print, Span, decimal};
use crate::form::Form;
use crate::fvalues::{CountBound, astar_count_bound};
use crate::lattice::Octile;

/// Whether a printed count is at most the number of cells that A* with the Euclidean heuristic can close and open, on
/// any map on which its path has the moves of `optimum`. `applies` picks the bound of closed or of opened cells, if the
/// number has one.
pub fn count_bound(
    print: Print,
    ends: Ends,
    optimum: Octile,
    applies: Option<fn(CountBound) -> usize>,
) -> Proof {
    let Ends { size, start, goal } = ends;
    let bound = astar_count_bound(size, start, goal, optimum.length());
    let least = print.interval().low;
    let limit = |what: &str, most: usize| {
        let compared = if least > most as f64 { "cannot" } else { "may" };
        format!("at most {most} nodes are {what}, so it {compared} count them")
    };
    Proof {
        is_possible: applies.is_none_or(|applies| least <= applies(bound) as f64),
        because: vec![
            format!("{} on any map of {} × {} cells", print.printed, size[0], size[1]),
            limit("closed", bound.closed),
            limit("ever opened", bound.opened),
        ],
        premises: vec![
            format!(
                "A* from cell {start:?} to cell {goal:?} with the Euclidean heuristic, stopped at the goal"
            ),
            format!("its path costs {}", spelled(optimum)),
        ],
    }
}

/// Whether a printed number is at most `limit`; `says` names the source of that limit.
pub fn at_most(print: Print, limit: f64, says: &str) -> Proof {
    let least = print.interval().low;
    let is_possible = least <= limit;
    let compared = if is_possible { "may keep" } else { "exceeds" };
    Proof {
        is_possible,
        because: vec![format!(
            "{} {compared} the limit of {limit}, whatever its digits stand for",
            print.printed
        )],
        premises: vec![format!("the limit holds for the printed number: {says}")],
    }
}

/// Whether a printed percentage is the reduction from one printed number to another. None if there is no such reduction: the
/// first must be positive and the second not negative, whatever their digits stand for.
pub fn percentage(print: Print, [before, after]: [Print; 2]) -> Option<Proof> {
    let of_cells = |[before, after]: [Span; 2]| Form::OfFirst.span(&before, &after);
    let exact = of_cells([before, after].map(|cell| Span::point(cell.value())))?.low;
    let has_meaning = before.printed.units() > 0 && after.printed.units() >= 0;
    let possible = of_cells([before, after].map(Print::span)).filter(|_| has_meaning)?;
    let [low, high] = [possible.low, possible.high].map(|end| decimal(end, 2));
    let range = format!("the cells' digits allow {low} to {high} %");
    let span = print.span();
    let printed = print.printed;
    let (is_possible, found) = if span.contains(exact) {
        (true, format!("which prints as {printed}; {range}"))
    } else if possible.meets(&span) {
        (true, format!("{printed} needs digits that the cells do not show; {range}"))
    } else {
        (false, format!("{printed} is outside; {range}"))
    };
    let [before, after] = [before, after].map(|cell| cell.printed);
    let computed = format!("({before} − {after}) / {before} = {} %", decimal(exact, 3));
    let premise = "the percentage was computed from the two cells of the table".to_owned();
    Some(Proof { is_possible, because: vec![computed, found], premises: vec![premise] })
}

/// Whether a printed time, the last of `times`, is a whole number of ticks, and how likely it is of random digits that all of
/// `times` are; `chosen` says how the tick came into question. Nothing is refused.
pub fn clock_ticks(tick: Tick, times: &[Print], chosen: &str) -> Proof {
    let spelled = format!("{}/{} s", tick.numerator, tick.denominator);
    let digits = times[times.len() - 1].digits;
    let times: Vec<_> = times.iter().map(|time| time.printed).collect();
    let counts: Vec<Option<u64>> = times.iter().map(|time| tick.count(*time, digits)).collect();
    let own = times[times.len() - 1];
    let all = times.len();
    let reason = match counts[counts.len() - 1] {
        Some(ticks) => format!("{own} s prints {ticks} ticks of {spelled}"),
        None => format!("{own} s is no whole number of ticks of {spelled}"),
    };
    let chance = format!(
        "{} of {all} printed times are; random digits would all be with probability {:.6}",
        counts.iter().flatten().count(),
        tick.chance(&times, digits)
    );
    let premises = vec![format!("the tick of {spelled}: {chosen}")];
    Proof { is_possible: true, because: vec![reason, chance], premises }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printed::Digits;

    #[test]
    fn a_number_above_its_limit_is_impossible_and_one_that_may_round_to_it_is_not() {
        let is_possible = |text: &str, limit| {
            let print = Print { printed: text.parse().unwrap(), digits: Digits::Rounded };
            at_most(print, limit, "so it says").is_possible
        };
        assert!(!is_possible("881990", 100_000.0));
        assert!(is_possible("100000", 100_000.0) && is_possible("97944.2", 100_000.0));
        assert!(is_possible("1.3", 1.26) && !is_possible("1.3", 1.2));
    }
}
