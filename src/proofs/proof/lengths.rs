//! Printed lengths, distances and savings against what the ends allow.

use super::{Ends, Proof, displacement, spelled};
use crate::bounds::{self, Moves, largest_saving_percent};
use crate::exact::{Exact, Print};
use crate::lattice::{Octile, Step, lengths_printing, nearest_lengths};
use crate::printed::Digits;
use crate::turns::{Cell, straight_line_between};
use crate::{at_most, neighbourhood, with_an_end_moved, with_both_ends_moved};
use stats::interval::Interval;

/// Whether a printed distance is the Euclidean one between two printed points; also that distance.
pub fn point_distance(print: Print, from: [f64; 2], to: [f64; 2]) -> (f64, Proof) {
    let distance = bounds::straight_line(from, to);
    let agrees = |digits| print.printed.agrees(distance, digits);
    let how = match (agrees(Digits::Rounded), agrees(Digits::Truncated)) {
        (true, true) => "which prints so, rounded and truncated",
        (true, false) => "which prints so if rounded, and not if truncated",
        (false, true) => "which prints so if truncated, and not if rounded",
        (false, false) => "which does not print so",
    };
    let proof = Proof {
        is_possible: agrees(print.digits),
        because: vec![format!("from {from:?} to {to:?} it is {distance:.4}, {how}")],
        premises: vec!["the distance is Euclidean, in the unit of the coordinates".to_owned()],
    };
    (distance, proof)
}

/// Whether a printed length is at least the straight line between the ends, which are `apart` exactly; with the `size` of the
/// grid the ends are cells, and their neighbours are tried as well.
pub fn straight_line(
    print: Print,
    [start, goal]: [[f64; 2]; 2],
    apart: [Exact; 2],
    size: Option<[i32; 2]>,
) -> Proof {
    let least = bounds::straight_line(start, goal);
    let printed = print.printed;
    let longest = print.interval().high;
    let is_short = bounds::against(print, apart, Moves::Any).is_some_and(|(order, _)| order.is_lt());
    let found = if is_short {
        format!("{printed} is shorter by at least {:.4}, whatever its digits stand for", least - longest)
    } else {
        format!("{printed} is not shorter")
    };
    let mut because = vec![format!("the straight line from {start:?} to {goal:?} is {least:.4} long"), found];
    because.extend(size.filter(|_| is_short).map(|size| {
        let cells = [start, goal].map(|point| point.map(|at| at as i32));
        let [starts, goals] = cells.map(|cell| neighbourhood(cell, size));
        let near = straight_line_between(&starts, &cells[1..])
            .into_iter()
            .chain(straight_line_between(&cells[..1], &goals))
            .fold(f64::INFINITY, f64::min);
        format!(
            "with the start or the goal moved to one of its eight neighbours the straight line is down to {near:.4}, so \
             the proof rests on the printed ends"
        )
    }));
    let premises =
        ["the path joins the printed start and goal", "its printed cost is its length in cells, as A*'s is"];
    Proof { is_possible: !is_short, because, premises: premises.map(str::to_owned).to_vec() }
}

/// Whether a printed length is the length of an 8-connected path, between the ends if they are known. With the `size`
/// of the grid the ends' neighbours are tried as well.
pub fn lattice_length(print: Print, ends: Option<[Cell; 2]>, size: Option<[i32; 2]>) -> Proof {
    let lengths = |digits| lengths_printing(print.printed, digits, Step::ONE, ends.map(displacement));
    let read = [("rounded", Digits::Rounded), ("truncated", Digits::Truncated)].map(|(how, digits)| {
        let listed: Vec<String> = lengths(digits).into_iter().map(spelled).collect();
        let named = if listed.is_empty() { "no such length".to_owned() } else { listed.join(", ") };
        format!("{} read as {how}: {named}", print.printed)
    });
    let mut because = read.to_vec();
    let is_possible = !lengths(print.digits).is_empty();
    if let (false, Some(ends)) = (is_possible, ends) {
        let (below, above) = nearest_lengths(print.printed, displacement(ends));
        let near: Vec<String> = [below, above].into_iter().flatten().map(spelled).collect();
        because.push(format!("the nearest lengths there are: {}", near.join(" and ")));
        because.extend(size.map(|size| rescued(print, ends, size)));
    }
    let path = match ends {
        Some([start, goal]) => {
            format!("the path goes from cell {start:?} to cell {goal:?} by moves to one of eight neighbours")
        }
        None => "the path goes by moves to one of eight neighbours, from and to any cells".to_owned(),
    };
    Proof {
        is_possible,
        because,
        premises: vec![path, "a straight move costs 1 and a diagonal one √2".to_owned()],
    }
}

/// Whether an 8-connected path has the length where one end, or else both, are moved to a neighbour.
fn rescued(print: Print, ends: [Cell; 2], size: [i32; 2]) -> String {
    let met = |ends: [Cell; 2]| {
        let lengths = lengths_printing(print.printed, print.digits, Step::ONE, Some(displacement(ends)));
        lengths.first().map(|length| (ends, spelled(*length)))
    };
    if let Some(([from, to], length)) = with_an_end_moved(ends, size).into_iter().find_map(met) {
        return format!(
            "from {from:?} to {to:?}, one end moved to a neighbour, there is {length}, so the proof rests on the printed ends"
        );
    }
    let neither = "with the start or the goal moved to any of its eight neighbours there is none";
    match with_both_ends_moved(ends, size).into_iter().find_map(met) {
        Some(([from, to], length)) => format!(
            "{neither}; with both moved, from {from:?} to {to:?}, there is {length}, so the proof rests on one of the printed ends"
        ),
        None => format!("{neither}, nor with both moved"),
    }
}

/// The most that a path between two cells can save of a printed baseline, in per cent, and what it is measured against.
fn most_saved(baseline: Print, ends: [Cell; 2]) -> (f64, String) {
    let least = bounds::straight_line(ends[0].map(f64::from), ends[1].map(f64::from));
    let Print { printed, digits } = baseline;
    let lengths = lengths_printing(printed, digits, Step::ONE, Some(displacement(ends)));
    let longest = lengths.iter().copied().map(Octile::length).max_by(f64::total_cmp);
    let (baseline, which) = match longest {
        Some(length) => (
            Interval::new(length, length),
            format!("the longest 8-connected length that prints as {printed} is {length:.4}"),
        ),
        None => (
            printed.interval(digits),
            format!("no 8-connected length prints as {printed}, so it is taken as printed"),
        ),
    };
    (largest_saving_percent(baseline, least), which)
}

/// Whether a printed saving, in per cent of a printed 8-connected baseline, is possible for any path between the ends.
pub fn largest_saving(print: Print, baseline: Print, ends: Ends) -> Proof {
    let Ends { size, start, goal } = ends;
    let least = bounds::straight_line(start.map(f64::from), goal.map(f64::from));
    let (most, which) = most_saved(baseline, [start, goal]);
    let claimed = print.interval().low;
    let is_possible = claimed <= most;
    let compared = if is_possible { "not more than that" } else { "more than any path can save" };
    let mut because = vec![
        which,
        format!(
            "no path is shorter than the straight line of {least:.4}, so it saves at most {} %",
            at_most(most, 2)
        ),
        format!("{} % is {compared}", print.printed),
    ];
    because.extend((!is_possible).then(|| {
        let moved = with_an_end_moved([start, goal], size).into_iter().map(|ends| most_saved(baseline, ends).0);
        let most = moved.fold(f64::NEG_INFINITY, f64::max);
        let rests = if claimed <= most { "rests" } else { "does not rest" };
        format!(
            "with the start or the goal moved to one of its eight neighbours it saves at most {} %, so the proof {rests} \
             on the printed ends",
            at_most(most, 2)
        )
    }));
    let premises = vec![
        format!("both paths go from cell {start:?} to cell {goal:?}"),
        "costs are lengths; the baseline's is that of an 8-connected path".to_owned(),
    ];
    Proof { is_possible, because, premises }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(printed: &str, [start, goal]: [Cell; 2]) -> String {
        let print = Print { printed: printed.parse().unwrap(), digits: Digits::Unknown };
        let proof = lattice_length(print, Some([start, goal]), Some([30, 30]));
        assert!(!proof.is_possible, "{printed}");
        proof.because.last().unwrap().clone()
    }

    #[test]
    fn a_length_between_no_printed_ends_is_tried_with_one_and_with_both_of_them_moved() {
        let complex = [[28, 19], [13, 16]];
        let both = moved("17.56", complex);
        assert!(both.contains("moved to any of its eight neighbours there is none"), "{both}");
        assert!(both.contains("2 + 11√2 = 17.5563"), "{both}");
        let one = moved("15.83", complex);
        assert!(one.contains("one end moved to a neighbour, there is 13 + 2√2 = 15.8284"), "{one}");
        let none = moved("13.05", complex);
        assert!(none.ends_with("nor with both moved"), "{none}");
    }
}
