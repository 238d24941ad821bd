//! Printed counts, percentages and times against what whole numbers allow.

use super::{Ends, Proof, spelled};
use crate::clock::Tick;
use crate::exact::{Print, Span, decimal};
use crate::form::Form;
use crate::fvalues::{CountBound, astar_count_bound};
use crate::lattice::Octile;
use std::f64::consts::{FRAC_PI_8, SQRT_2};

/// Whether a printed count is at most what A* with the Euclidean heuristic can close and open on any map on which its path
/// has the moves of `optimum`; `applies` picks the bound that the number is under, if it is under either.
pub fn count_bound(
    print: Print,
    ends: Ends,
    optimum: Octile,
    applies: Option<fn(CountBound) -> usize>,
) -> Proof {
    let Ends { size, start, goal } = ends;
    let bound = astar_count_bound(size, start, goal, optimum.length());
    let least = print.interval().low;
    let said = |what: &str, most: usize| {
        let compared = if least > most as f64 { "cannot" } else { "may" };
        format!("at most {most} nodes are {what}, so it {compared} count them")
    };
    Proof {
        is_possible: applies.is_none_or(|applies| least <= applies(bound) as f64),
        because: vec![
            format!("{} on any map of {} × {} cells", print.printed, size[0], size[1]),
            said("closed", bound.closed),
            said("ever opened", bound.opened),
        ],
        premises: vec![
            format!(
                "A* from cell {start:?} to cell {goal:?} with the Euclidean heuristic, stopped at the goal"
            ),
            format!("its path costs {}", spelled(optimum)),
        ],
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
    let (span, printed) = (print.span(), print.printed);
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
/// `times` are; `chosen` says how the tick came to be asked about. Nothing is refused.
pub fn clock_ticks(tick: Tick, times: &[Print], chosen: &str) -> Proof {
    let spelled = format!("{}/{} s", tick.numerator, tick.denominator);
    let digits = times[times.len() - 1].digits;
    let times: Vec<_> = times.iter().map(|time| time.printed).collect();
    let counts: Vec<Option<u64>> = times.iter().map(|time| tick.count(*time, digits)).collect();
    let (own, all) = (times[times.len() - 1], times.len());
    let said = match counts[counts.len() - 1] {
        Some(ticks) => format!("{own} s prints {ticks} ticks of {spelled}"),
        None => format!("{own} s is no whole number of ticks of {spelled}"),
    };
    let chance = format!(
        "{} of {all} printed times are; random digits would all be with probability {:.6}",
        counts.iter().flatten().count(),
        tick.chance(&times, digits)
    );
    let premises = vec![format!("the tick of {spelled}: {chosen}")];
    Proof { is_possible: true, because: vec![said, chance], premises }
}

/// Whether any regular octagon about a lattice point holds `nodes` other lattice points.
pub fn octagon_nodes(nodes: usize) -> Proof {
    let turned = [(true, "with corners on the axes"), (false, "with sides square to the axes")];
    let found = turned.map(|(is_cornered, how)| {
        let found = octagon_counts(nodes, is_cornered);
        let listed: Vec<String> = found.iter().map(|(count, _)| count.to_string()).collect();
        let hit = found.iter().find(|(count, _)| *count == nodes);
        let said = match hit {
            Some((_, radius)) => format!("{nodes} from a circumradius of {radius:.4} on"),
            None => format!("never {nodes}"),
        };
        let listed = listed.join(", ");
        let text = format!(
            "regular octagons of any size about a lattice point, {how}, hold {listed} others: {said}"
        );
        (hit.is_some(), text)
    });
    let premise = "the octagon is regular, centred on the node, and turned in one of these two ways";
    Proof {
        is_possible: found.iter().any(|(is_hit, _)| *is_hit),
        because: found.map(|(_, text)| text).to_vec(),
        premises: vec![premise.to_owned()],
    }
}

/// The least circumradius of an octagon about the origin that holds the point; with corners on the axes, or with sides
/// square to them.
fn circumradius([x, y]: [i32; 2], is_cornered: bool) -> f64 {
    let (s, c) = libm::sincos(FRAC_PI_8);
    let (x, y) = (f64::from(x.abs()), f64::from(y.abs()));
    let apothem =
        if is_cornered { f64::max(x * c + y * s, x * s + y * c) } else { x.max(y).max((x + y) / SQRT_2) };
    apothem / c
}

/// How many points octagons of rising size hold, up to `nodes` or the first above, with the circumradius from which each does.
fn octagon_counts(nodes: usize, is_cornered: bool) -> Vec<(usize, f64)> {
    // An octagon of apothem a holds the block of side 2 ⌊a/√2⌋ + 1, so that this reach is enough.
    let reach = libm::sqrt(nodes as f64) as i32 + 3;
    let axis = || -reach..=reach;
    let points = axis().flat_map(|x| axis().map(move |y| [x, y])).filter(|point| *point != [0, 0]);
    let mut radii: Vec<f64> = points.map(|point| circumradius(point, is_cornered)).collect();
    radii.sort_by(f64::total_cmp);
    let is_last = |k: &usize| radii.get(k + 1).is_none_or(|next| next - radii[*k] > 1e-9);
    let counts: Vec<(usize, f64)> = (0..radii.len()).filter(is_last).map(|k| (k + 1, radii[k])).collect();
    let below = counts.iter().take_while(|(count, _)| *count < nodes).count();
    counts[..counts.len().min(below + 1)].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_pointing_at_every_lattice_point() {
        let at = |is_cornered: bool, radius: f64| {
            let all = (-9..=9).flat_map(|x| (-9..=9).map(move |y| [x, y]));
            all.filter(|p| *p != [0, 0] && circumradius(*p, is_cornered) <= radius + 1e-9).count()
        };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 5.0].map(|r| at(true, r)), [4, 12, 28, 48, 72]);
        let apothems = [1.0, 2.0, 3.0, 4.0, 5.0].map(|a: f64| at(false, a / libm::cos(FRAC_PI_8)));
        assert_eq!(apothems, [4, 12, 36, 56, 96]);
        let counts = octagon_counts(48, true);
        assert!(counts.iter().any(|(count, radius)| *count == 48 && (radius - 4.0).abs() < 1e-9));
        assert_eq!(counts.last().map(|(count, _)| *count), Some(48), "it stops there");
        assert!(octagon_nodes(48).is_possible && !octagon_nodes(47).is_possible);
    }
}
