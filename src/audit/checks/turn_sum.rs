//! Whether an 8-connected path of the printed length can turn by the printed sum of angles.

use super::arguments::{digits, each_of_cell};
use super::keys::{FROM, LENGTH, TO, TURNS};
use super::lattice::{between, moves};
use super::{Entry, FromRelation, Proof, Test, Window};
use crate::input::{Input, Relation};
use crate::meaning::{Kind, Lattice};
use crate::octile_turns::octile_turn_sums;
use crate::table::{Fault, Quoted, Table, named_by, quoted};
use proofs::exact::{Print, spelled, whole};
use proofs::lattice::Octile;
use proofs::turns::Cell;
use proofs::turns::Convention;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "turn_sum",
    about: "can an 8-connected path of the printed length turn by the printed sum of angles?",
    example: "turn sum 229.17 beside length 14.65 from 22:15 to 26:28",
    premises: "moves go to one of eight neighbours; the sum is of changes of direction, or of the angles between moves",
    source: "enumeration over moves (octile_turns.rs); for any-angle paths see proofs::turns",
    tests: |input, give| each_of_cell(input, of_cell, give),
    relation: Some(FromRelation { keys: &[TURNS, LENGTH, FROM, TO], build }),
};

struct TurnSum {
    /// The turn sum, then the length.
    numbers: [Quoted; 2],
    displacement: Cell,
    /// The sums by length, in multiples of 45°: many tests need the same ones.
    sums: RefCell<BTreeMap<String, Option<BTreeSet<u32>>>>,
    steps: std::cell::Cell<u64>,
}

/// Moves of paths whose turns are enumerated.
const MOVES: u32 = 31;

fn of_cell(index: usize, table: &Table, row: usize, length: usize) -> Option<TurnSum> {
    let meaning = &table.columns[length].meaning;
    let turns = named_by(&table.columns, length, meaning.turns.as_deref()?)?;
    let displacement = super::lattice::displacement(meaning).filter(|_| meaning.kind == Kind::Value)?;
    let numbers = [quoted(index, table, row, turns)?, quoted(index, table, row, length)?];
    Some(TurnSum { numbers, displacement, sums: RefCell::default(), steps: std::cell::Cell::default() })
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let ends = relation.point("from")?.zip(relation.point("to")?);
    let displacement = ends.and_then(|(from, to)| between(from, to));
    let displacement = displacement.ok_or_else(|| {
        relation.fault("`from` and `to` are needed, points \"X:Y\" a whole number of cells apart")
    })?;
    let numbers = [relation.number("turns", input)?, relation.number("length", input)?];
    Ok(Box::new(TurnSum {
        numbers,
        displacement,
        sums: RefCell::default(),
        steps: std::cell::Cell::default(),
    }))
}

impl TurnSum {
    fn moves(&self, length: Print) -> Option<Vec<Octile>> {
        let found = moves(length, Lattice { step: whole(1), diagonal: None }, Some(self.displacement))?;
        found.iter().all(|moves| moves.straight + moves.diagonal <= MOVES).then_some(found)
    }

    /// Every turn sum of paths of that length, in multiples of 45°; `None` if the length allows too many moves.
    fn sums(&self, length: Print) -> Option<BTreeSet<u32>> {
        let key = format!("{} {:?}", length.printed, length.digits);
        if let Some(known) = self.sums.borrow().get(&key) {
            return known.clone();
        }
        let found = self.moves(length).map(|all| {
            let count = |moves: &Octile| u64::from(moves.straight + moves.diagonal);
            self.steps.set(self.steps.get() + all.iter().map(|moves| count(moves).pow(4)).sum::<u64>());
            let sums = all.iter().flat_map(|moves| {
                [Convention::Exterior, Convention::Interior]
                    .into_iter()
                    .flat_map(|convention| octile_turn_sums(*moves, self.displacement, convention))
            });
            sums.collect::<BTreeSet<u32>>()
        });
        self.sums.borrow_mut().insert(key, found.clone());
        found
    }
}

impl Test for TurnSum {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        // Mending asks about many lengths, each an enumeration; only the printed one is looked at.
        if prints[1].printed != self.numbers[1].print.printed {
            return None;
        }
        let span = prints[0].span();
        // A length that no path has is refused by the check `lattice`.
        let sums = self.sums(prints[1])?;
        if sums.is_empty() {
            return None;
        }
        Some(sums.iter().any(|sum| span.contains(whole(45 * *sum))))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let [turns, length] = [prints[0], prints[1]].map(|print| print.printed);
        let verb = if is_possible { "is" } else { "is not" };
        let sums = self.sums(prints[1]).unwrap_or_default();
        let ends = sums.first().zip(sums.last()).map_or("?".to_owned(), |(first, last)| {
            format!("such sums are multiples of 45° from {}° to {}°", 45 * first, 45 * last)
        });
        format!("{turns}° {verb} the turn sum of an 8-connected path of length {length}: {ends}")
    }

    fn premises(&self) -> Vec<String> {
        let [dx, dy] = self.displacement;
        vec![
            format!("moves go to one of eight neighbours, over ({dx}, {dy}) cells in all"),
            "the sum is of changes of direction, or of the angles between moves that differ".to_owned(),
            digits(&self.numbers),
        ]
    }

    fn window(&self) -> Option<Window> {
        let most =
            self.moves(self.numbers[1].print)?.iter().map(|moves| moves.straight + moves.diagonal).max()?;
        let ends = [whole(0), whole(180 * i128::from(most.max(2) - 1))];
        Some(Window { ends, why: "up to half a turn at each bend" })
    }

    fn steps_taken(&self) -> Option<u64> {
        Some(self.steps.get())
    }

    fn undecided(&self, prints: &[Print]) -> String {
        match self.moves(prints[1]) {
            Some(moves) if moves.is_empty() => {
                let [dx, dy] = self.displacement;
                format!(
                    "no 8-connected path over ({dx}, {dy}) cells has the length {} (see `lattice`)",
                    prints[1].printed
                )
            }
            _ => format!("a length of {} is of more than {MOVES} moves", prints[1].printed),
        }
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let listed: Vec<Value> = self
            .moves(prints[1])?
            .iter()
            .map(|moves| json!([moves.straight.to_string(), moves.diagonal.to_string()]))
            .collect();
        let sums: Vec<String> = self.sums(prints[1])?.iter().map(|sum| spelled(whole(45 * *sum))).collect();
        let given = json!({ "displacement": self.displacement.map(|cells| cells.to_string()) });
        Some(Proof { given, steps: json!([{ "moves": listed, "sums_deg": sums }]) })
    }
}
