//! Printed turn sums, and the lengths that they need, on any map.

use super::{Ends, Proof};
use crate::exact::Print;
use crate::neighbourhood;
use crate::turns::{Convention, Polyline, TurnQuery};
use stats::interval::Interval;

/// Polylines between printed ends that turn by a printed sum.
pub struct Search<'a> {
    /// The ends.
    pub ends: Ends,
    /// The printed turn sum, degrees.
    pub turn: Print,
    /// How the paper's angles count.
    pub meant: Convention,
    /// How far to look, cells.
    pub longest: f64,
    /// Whether reasons are given: they take most of the time, since they also say what the other convention and other ends give.
    pub is_explained: bool,
    /// Gives the shortest polyline; it may remember what it has found.
    pub shortest: &'a (dyn Fn(&TurnQuery) -> Option<Polyline> + Sync),
}

/// Both conventions, with their names.
const BOTH: [(Convention, &str); 2] =
    [(Convention::Exterior, "exterior"), (Convention::Interior, "interior")];

/// Whether the start, and whether the goal, may be any neighbour of its cell: neither.
const AS_PRINTED: [bool; 2] = [false, false];
/// The start alone.
const START_NEAR: [bool; 2] = [true, false];
/// The goal alone.
const GOAL_NEAR: [bool; 2] = [false, true];

impl Search<'_> {
    /// The shortest polyline with a turn sum and a length in the windows; `near` says which ends may be their neighbours.
    fn find(
        &self,
        convention: Convention,
        turn_deg: Interval,
        length: Interval,
        near: [bool; 2],
    ) -> Option<Polyline> {
        let Ends { size, start, goal } = self.ends;
        let cells = |cell, near| if near { neighbourhood(cell, size) } else { vec![cell] };
        let (starts, goals) = (cells(start, near[0]), cells(goal, near[1]));
        (self.shortest)(&TurnQuery { size, starts, goals, convention, turn_deg, length })
    }

    /// The least length with a turn sum in the window.
    fn least(&self, convention: Convention, turn_deg: Interval, near: [bool; 2]) -> Option<f64> {
        let length = Interval::new(0.0, self.longest);
        self.find(convention, turn_deg, length, near).map(|found| found.length)
    }

    fn premises(&self, sums: &str) -> Vec<String> {
        let Ends { start, goal, .. } = self.ends;
        let path = "whose bends are cell centres";
        let heading = "the first move turns from no heading: the paper names none";
        vec![
            format!("the path is a polyline from cell {start:?} to cell {goal:?} {path}"),
            sums.to_owned(),
            heading.to_owned(),
        ]
    }
}

/// Whether any polyline through cell centres has both the printed length and the printed turn sum.
pub fn joint_length_turn(search: &Search<'_>, length: Print) -> Proof {
    let sums = "its cost is its Euclidean length in cells; its turn sum adds one angle at every bend";
    if !search.is_explained {
        let is_possible =
            search.find(search.meant, search.turn.interval(), length.interval(), AS_PRINTED).is_some();
        return Proof { is_possible, because: Vec::new(), premises: search.premises(sums) };
    }
    let mut because = Vec::new();
    let impossible = BOTH.map(|(convention, name)| {
        let (is_impossible, reasons) = both_impossible(search, length, convention, name);
        because.extend(reasons);
        is_impossible && convention == search.meant
    });
    Proof { is_possible: impossible == [false; 2], because, premises: search.premises(sums) }
}

/// Whether no polyline has both under `convention`, and how that was found.
fn both_impossible(
    search: &Search<'_>,
    length: Print,
    convention: Convention,
    name: &str,
) -> (bool, Vec<String>) {
    let turn = search.turn.printed;
    let alone = match search.least(convention, search.turn.interval(), AS_PRINTED) {
        Some(least) => {
            format!("{name} angles: a turn sum of {turn} needs a length of {least:.4} at least, on any map")
        }
        None => {
            format!("{name} angles: no path of up to {} cells has a turn sum of {turn}", search.longest)
        }
    };
    let pair = |near| search.find(convention, search.turn.interval(), length.interval(), near);
    let both = format!("{} and {turn}", length.printed);
    if let Some(found) = pair(AS_PRINTED) {
        let met = format!("{name} angles: {both} are met together by {:?}", found.cells);
        return (false, vec![alone, met]);
    }
    let moved = [("start", START_NEAR), ("goal", GOAL_NEAR)];
    let rescued = moved.into_iter().filter(|(_, near)| pair(*near).is_some()).map(|(end, _)| end);
    let rescued = rescued.collect::<Vec<_>>().join(" or the ");
    let ends = if rescued.is_empty() {
        "nor with the start or the goal moved to any of its eight neighbours".to_owned()
    } else {
        format!("but moving the {rescued} to a neighbour would allow it")
    };
    (true, vec![alone, format!("{name} angles: no polyline has {both}, {ends}")])
}

/// How long a polyline through cell centres with the printed turn sum is at least, beside another printed length. Refused if
/// `is_shorter` says that the path is claimed to be shorter than that, and it cannot be.
pub fn turn_needs_length(search: &Search<'_>, beside: Print, is_shorter: bool) -> Proof {
    let sums = "lengths are Euclidean, in cells; a turn sum adds one angle at every bend";
    if !search.is_explained {
        let high = beside.interval().high;
        let length = Interval::new(0.0, high.min(search.longest));
        let found = search.find(search.meant, search.turn.interval(), length, AS_PRINTED);
        let is_possible = !is_shorter || found.is_some_and(|found| found.length <= high);
        return Proof { is_possible, because: Vec::new(), premises: search.premises(sums) };
    }
    let mut because = Vec::new();
    let longer = BOTH.map(|(convention, name)| {
        let (is_longer, reason) = needed(search, beside, convention, name);
        because.push(reason);
        is_longer && convention == search.meant
    });
    let is_refused = is_shorter && longer != [false; 2];
    because.extend(is_refused.then(|| {
        let least = |near| search.least(search.meant, search.turn.interval(), near);
        let (start, goal) = rayon::join(|| least(START_NEAR), || least(GOAL_NEAR));
        let least = [start, goal].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let rests = if least > beside.interval().high { "does not rest" } else { "rests" };
        format!(
            "with the start or the goal moved to one of its eight neighbours such a path is at least {least:.4} cells long, \
             so the proof {rests} on the printed ends"
        )
    }));
    Proof { is_possible: !is_refused, because, premises: search.premises(sums) }
}

/// Whether the path is longer than the printed length can stand for, and how that was found.
fn needed(search: &Search<'_>, beside: Print, convention: Convention, name: &str) -> (bool, String) {
    let Print { printed: turn, .. } = search.turn;
    let exact = search.turn.interval();
    let least = |turn_deg| search.least(convention, turn_deg, AS_PRINTED);
    let further = Interval { high: f64::INFINITY, ..exact };
    let least: [Option<f64>; 2] = rayon::join(|| least(exact), || least(further)).into();
    let in_words = |least: Option<f64>| match least {
        Some(least) => {
            let change = 100.0 * (least / beside.printed.value() - 1.0);
            format!("at least {least:.4} ({change:+.1} % from {})", beside.printed)
        }
        None => format!("more than {}", search.longest),
    };
    let [so_far, or_further] = least.map(in_words);
    let text = format!(
        "{name} angles: a path that turns by {turn} is {so_far} cells long on any map; one that turns so far or further, \
         {or_further}"
    );
    (least[0].is_none_or(|least| least > beside.interval().high), text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printed::Digits;
    use crate::turns::shortest_polyline;

    #[test]
    fn what_is_refused_does_not_depend_on_whether_it_is_explained() {
        let print = |text: &str, digits| Print { printed: text.parse().unwrap(), digits };
        let mut seen = [false; 4];
        for (text, length) in
            [("45.00", "7.2"), ("45.00", "6.0"), ("90.00", "6.99"), ("81.87", "8.94"), ("30.00", "5.0")]
        {
            for meant in [Convention::Exterior, Convention::Interior] {
                for digits in [Digits::Rounded, Digits::Truncated] {
                    let both = [true, false].map(|is_explained| {
                        let search = Search {
                            ends: Ends { size: [8, 8], start: [0, 0], goal: [5, 3] },
                            turn: print(text, digits),
                            meant,
                            longest: 9.0,
                            is_explained,
                            shortest: &shortest_polyline,
                        };
                        let length = print(length, digits);
                        [joint_length_turn(&search, length), turn_needs_length(&search, length, true)]
                            .map(|proof| proof.is_possible)
                    });
                    assert_eq!(both[0], both[1], "{text} {length} {meant:?} {digits:?}");
                    let [joint, needs] = both[0];
                    seen[usize::from(joint)] = true;
                    seen[2 + usize::from(needs)] = true;
                }
            }
        }
        assert_eq!(seen, [true; 4], "an answer never came out");
    }
}
