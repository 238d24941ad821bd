//! Whether a polyline through cell centres has the printed length and the printed sum of turns, at any angles.

use super::arguments::{digits, up_to_twice};
use super::keys::{FROM, LENGTH, TO, TURNS};
use super::lattice::between;
use super::{Entry, FromRelation, Test, Window, none};
use crate::input::{Input, Relation};
use crate::table::{Fault, Quoted};
use proofs::exact::{Exact, Print, floor, whole};
use proofs::turns::{Cell, distance};
use proofs::turns::{Convention, Polyline, TurnQuery, shortest_polyline};
use stats::interval::Interval;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "any_angle_turns",
    about: "has any polyline through cell centres the printed length and the printed sum of turns?",
    example: "turn sum 229.17 with length 13.70 from 22:15 to 26:28",
    premises: "bends are cell centres; the sum is of changes of direction, or of the angles between segments; a signal, since the search is by floats",
    source: "best-first search from both ends (proofs::turns); the same as the papers' claims",
    tests: none,
    relation: Some(FromRelation {
        keys: &[
            TURNS,
            LENGTH,
            FROM,
            TO,
            (
                "grid",
                "Columns and rows \"X:Y\" of the map that the path stays on; it may leave any if absent.",
            ),
            (
                "angles",
                "What is summed: `exterior`, changes of direction; `interior`, angles between segments; `either` if absent.",
            ),
        ],
        build,
    }),
};

/// How far beyond the straight line paths are looked for, and how long that may be, cells: work grows threefold for each
/// half cell of the first.
const BEYOND: f64 = 2.5;
const APART: f64 = 30.0;
/// Searches for one relation: for what is printed, and for what power is computed from.
const SEARCHES: u32 = 14;

struct AnyAngle {
    /// The turn sum, then the length.
    numbers: [Quoted; 2],
    ends: [Cell; 2],
    size: [i32; 2],
    is_bounded: bool,
    conventions: Vec<Convention>,
    /// What was found, by the prints, since a search takes long.
    found: RefCell<BTreeMap<String, Option<Polyline>>>,
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let missing = || {
        relation
            .fault("`from` and `to` are needed, points \"X:Y\" a whole number of cells apart, 1 to 30 in all")
    };
    let (from, to) = relation.point("from")?.zip(relation.point("to")?).ok_or_else(missing)?;
    let displacement = between(from, to).ok_or_else(missing)?;
    if displacement == [0, 0] || distance([0, 0], displacement) > APART {
        return Err(missing());
    }
    let conventions = match relation.word("angles", &["either", "exterior", "interior"])? {
        "exterior" => vec![Convention::Exterior],
        "interior" => vec![Convention::Interior],
        _ => vec![Convention::Exterior, Convention::Interior],
    };
    let grid = relation.point("grid")?;
    let (start, size) = placed(from, grid).ok_or_else(|| relation.fault(GRID))?;
    let goal = [start[0] + displacement[0], start[1] + displacement[1]];
    if [start, goal].iter().any(|end| (0..2).any(|axis| !(0..size[axis]).contains(&end[axis]))) {
        return Err(relation.fault(GRID));
    }
    let numbers = [relation.number("turns", input)?, relation.number("length", input)?];
    let found = RefCell::default();
    Ok(Box::new(AnyAngle {
        numbers,
        ends: [start, goal],
        size,
        is_bounded: grid.is_some(),
        conventions,
        found,
    }))
}

const GRID: &str = "`grid` is \"COLUMNS:ROWS\", 1 to 200 each, with both ends in it";

/// The cell that the path starts from and the grid's size; without a grid there is room for every path around it.
fn placed(from: [Exact; 2], grid: Option<[Exact; 2]>) -> Option<(Cell, [i32; 2])> {
    let room = (2.0 * (APART + BEYOND)) as i32;
    let Some(grid) = grid else { return Some(([room; 2], [2 * room; 2])) };
    let cell = |point: Exact| i32::try_from(floor(point)).ok();
    let size = [cell(grid[0])?, cell(grid[1])?];
    let is_size = grid.iter().all(|side| *side >= whole(1) && *side <= whole(200));
    is_size.then_some(([cell(from[0])?, cell(from[1])?], size))
}

impl AnyAngle {
    /// A polyline with both; `None` if there is none. The outer none is for lengths that are not looked at.
    #[expect(clippy::option_option, reason = "none found and not looked for are different answers")]
    fn polyline(&self, prints: &[Print]) -> Option<Option<Polyline>> {
        let [turn_deg, length] = [prints[0], prints[1]].map(|print| print.printed.interval(print.digits));
        // Mending asks about many prints, each a search; power takes what searches there are.
        let is_as_printed = prints[1].printed == self.numbers[1].print.printed;
        if !is_as_printed || length.high > distance(self.ends[0], self.ends[1]) + BEYOND {
            return None;
        }
        let key = format!("{turn_deg:?} {length:?}");
        if let Some(known) = self.found.borrow().get(&key) {
            return Some(known.clone());
        }
        if self.found.borrow().len() >= SEARCHES as usize {
            return None;
        }
        let found = self.conventions.iter().find_map(|convention| self.search(*convention, turn_deg, length));
        self.found.borrow_mut().insert(key, found.clone());
        Some(found)
    }

    fn search(&self, convention: Convention, turn_deg: Interval, length: Interval) -> Option<Polyline> {
        let [start, goal] = self.ends;
        let query = |length| TurnQuery {
            size: self.size,
            starts: vec![start],
            goals: vec![goal],
            headings: Vec::new(),
            convention,
            turn_deg,
            length,
        };
        // The search without a length keeps much less, so it runs first.
        let alone = shortest_polyline(&query(Interval::new(0.0, length.high)))?;
        if alone.length >= length.low { Some(alone) } else { shortest_polyline(&query(length)) }
    }
}

impl Test for AnyAngle {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(self.polyline(prints)?.is_some())
    }

    fn sentence(&self, prints: &[Print], _is_possible: bool) -> String {
        let [turns, length] = [prints[0], prints[1]].map(|print| print.printed);
        match self.polyline(prints) {
            None | Some(None) => {
                format!("no polyline through cell centres is {length} long and turns by {turns}° in all")
            }
            Some(Some(found)) => {
                let [start, goal] = self.ends;
                let at = |cell: &Cell| format!("({}, {})", cell[0] - start[0], cell[1] - start[1]);
                let cells: Vec<String> = found.cells.iter().map(at).collect();
                let [dx, dy] = [goal[0] - start[0], goal[1] - start[1]];
                let shown = cells.join(" ");
                format!(
                    "{length} and {turns}° are met together over ({dx}, {dy}) cells, by {shown} from the start"
                )
            }
        }
    }

    fn premises(&self) -> Vec<String> {
        let named = |convention: &Convention| match convention {
            Convention::Exterior => "changes of direction",
            Convention::Interior => "angles between segments",
        };
        let conventions: Vec<&str> = self.conventions.iter().map(named).collect();
        let [columns, rows] = self.size;
        let grid =
            if self.is_bounded { format!("a grid of {columns} by {rows} cells") } else { "any grid".into() };
        vec![
            format!("the path is a polyline whose bends are cell centres of {grid}; obstacles are left out"),
            format!("the sum is of {}", conventions.join(" or of ")),
            digits(&self.numbers),
        ]
    }

    fn window(&self) -> Option<Window> {
        up_to_twice(self.numbers[0].print)
    }

    /// Each print asks for a search of its own.
    fn power_prints(&self) -> Option<i128> {
        Some(i128::from(SEARCHES) - 2)
    }

    fn undecided(&self, prints: &[Print]) -> String {
        format!("a length of {} is more than {BEYOND} cells above the straight line", prints[1].printed)
    }

    fn is_about_digits(&self) -> bool {
        false
    }
}
