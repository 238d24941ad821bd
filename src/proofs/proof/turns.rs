//! Printed turn sums, and the lengths that they need, on any map.

use super::{Ends, Proof};
use crate::exact::Print;
use crate::neighbourhood;
use crate::turns::{Cell, Convention, Polyline, TurnQuery};
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

/// What a path may have other than as printed.
#[derive(Clone, Copy)]
struct Varied<'a> {
    /// Whether the start, and whether the goal, may be any neighbour of its cell.
    near: [bool; 2],
    /// Headings: the first move turns from any of these; none as printed.
    headings: &'a [Cell],
}

const AS_PRINTED: Varied<'_> = Varied { near: [false, false], headings: &[] };
const START_NEAR: Varied<'_> = Varied { near: [true, false], ..AS_PRINTED };
const GOAL_NEAR: Varied<'_> = Varied { near: [false, true], ..AS_PRINTED };

/// The eight headings from which a first move may turn.
fn eight_headings() -> Vec<Cell> {
    let steps = neighbourhood([1, 1], [3, 3]).into_iter().map(|[x, y]| [x - 1, y - 1]);
    steps.filter(|step| *step != [0, 0]).collect()
}

impl Search<'_> {
    /// The shortest polyline with a turn sum and a length in the windows.
    fn find(
        &self,
        convention: Convention,
        turn_deg: Interval,
        length: Interval,
        Varied { near, headings }: Varied<'_>,
    ) -> Option<Polyline> {
        let Ends { size, start, goal } = self.ends;
        let cells = |cell, near| if near { neighbourhood(cell, size) } else { vec![cell] };
        let (starts, goals) = (cells(start, near[0]), cells(goal, near[1]));
        let headings = headings.to_owned();
        (self.shortest)(&TurnQuery { size, starts, goals, headings, convention, turn_deg, length })
    }

    /// The least length with a turn sum in the window.
    fn least(&self, convention: Convention, turn_deg: Interval, varied: Varied<'_>) -> Option<f64> {
        let length = Interval::new(0.0, self.longest);
        self.find(convention, turn_deg, length, varied).map(|found| found.length)
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
    let pair =
        |varied: Varied<'_>| search.find(convention, search.turn.interval(), length.interval(), varied);
    let both = format!("{} and {turn}", length.printed);
    if let Some(found) = pair(AS_PRINTED) {
        let met = format!("{name} angles: {both} are met together by {:?}", found.cells);
        return (false, vec![alone, met]);
    }
    let moved = [("start", START_NEAR), ("goal", GOAL_NEAR)];
    let rescued = moved.into_iter().filter(|(_, varied)| pair(*varied).is_some()).map(|(end, _)| end);
    let rescued = rescued.collect::<Vec<_>>().join(" or the ");
    let ends = if rescued.is_empty() {
        "nor with the start or the goal moved to any of its eight neighbours".to_owned()
    } else {
        format!("but moving the {rescued} to a neighbour would allow it")
    };
    // The search without a least length keeps much less, so it runs first.
    let no_longer = Interval::new(0.0, length.interval().high);
    let is_met_from = |headings: &[Cell]| {
        let varied = Varied { headings, ..AS_PRINTED };
        search.find(convention, search.turn.interval(), no_longer, varied).is_some() && pair(varied).is_some()
    };
    let mut turning = eight_headings();
    if is_met_from(&turning) {
        turning.retain(|heading| is_met_from(&[*heading]));
    } else {
        turning.clear();
    }
    let turning: Vec<String> = turning.iter().map(|heading| format!("{heading:?}")).collect();
    let headings = if turning.is_empty() {
        format!("no polyline has {both} if the first move turns from one of the eight headings")
    } else {
        format!("a first move that turns from heading {} would allow {both}", turning.join(" or "))
    };
    let printed = format!("{name} angles: no polyline has {both}, {ends}");
    (true, vec![alone, printed, format!("{name} angles: {headings}")])
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
    if is_refused {
        let least = |varied| search.least(search.meant, search.turn.interval(), varied);
        let (start, goal) = rayon::join(|| least(START_NEAR), || least(GOAL_NEAR));
        let least = [start, goal].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let rests = if least > beside.interval().high { "does not rest" } else { "rests" };
        because.push(format!(
            "with the start or the goal moved to one of its eight neighbours such a path is at least {least:.4} cells long, \
             so the proof {rests} on the printed ends"
        ));
        let no_longer = Interval::new(0.0, beside.interval().high);
        let turning = Varied { headings: &eight_headings(), ..AS_PRINTED };
        let is_rescued = search.find(search.meant, search.turn.interval(), no_longer, turning).is_some();
        let (is, rests) = if is_rescued { ("may be no", "rests") } else { ("is", "does not rest") };
        because.push(format!(
            "with a first move that turns from one of the eight headings such a path {is} longer than {}, so the proof {rests} \
             on its turning from none",
            beside.printed
        ));
    }
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
    use std::collections::BTreeSet;

    #[test]
    fn the_headings_that_would_allow_a_pair_are_those_that_allow_it_alone() {
        let print = |text: &str| Print { printed: text.parse().unwrap(), digits: Digits::Rounded };
        let mut counts = BTreeSet::new();
        for (goal, turn, length) in
            [([5, 5], "45.00", "7.07"), ([5, 3], "30.96", "5.83"), ([5, 3], "30.00", "5.0")]
        {
            let search = Search {
                ends: Ends { size: [8, 8], start: [0, 0], goal },
                turn: print(turn),
                meant: Convention::Exterior,
                longest: 9.0,
                is_explained: true,
                shortest: &shortest_polyline,
            };
            let length = print(length);
            let (is_impossible, because) = both_impossible(&search, length, Convention::Exterior, "exterior");
            let alone = eight_headings().into_iter().filter(|heading| {
                let varied = Varied { headings: &[*heading], ..AS_PRINTED };
                search.find(search.meant, search.turn.interval(), length.interval(), varied).is_some()
            });
            let alone: Vec<String> = alone.map(|heading| format!("{heading:?}")).collect();
            if is_impossible {
                counts.insert(alone.len().min(2));
                let words = if alone.is_empty() { "no polyline".to_owned() } else { alone.join(" or ") };
                assert!(because[2].contains(&words), "{turn} {}: {because:?}, not {words}", length.printed);
            }
        }
        assert_eq!(counts, BTreeSet::from([0, 1, 2]), "an answer never came out");
    }

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
