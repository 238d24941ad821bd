//! Whether a printed length is that of straight and diagonal moves.

use super::arguments::digits;
use super::keys::OF_PATH;
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::meaning::{Kind, Lattice, Meaning};
use crate::table::{Column, Fault, Quoted};
use crate::witness::{Budget, Witness};
use proofs::exact::{Exact, Print, Span, add, div, floor, mul, spelled, whole};
use proofs::lattice::{Octile, Step, joins, lengths_printing};
use proofs::turns::Cell;
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice",
    about: "is a printed length a + b√2 for whole a and b (or a + 1.4141 b), between the ends if they are known?",
    example: "length [a+b√2] = 13.40",
    premises: "the path is of moves to one of eight neighbours, which cost the step and √2 (or what the header states) steps",
    source: "the norm of a + b√2; decided in integers",
    tests,
    relation: Some(FromRelation {
        keys: &[
            OF_PATH,
            ("step", "What a straight move costs, in quotes if no whole number; 1 if absent."),
            ("diagonal", "What a diagonal move costs, in quotes if no whole number; √2 steps if absent."),
            ("from", "The start \"X:Y\", in cells; given with `to` or not at all."),
            ("to", "The goal \"X:Y\", in cells; given with `from` or not at all."),
        ],
        build,
    }),
};

struct Length {
    numbers: [Quoted; 1],
    lattice: Lattice,
    displacement: Option<Cell>,
    steps: std::cell::Cell<u64>,
}

/// Moves of lengths that are looked through.
const MOVES: i128 = 3000;

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    let is_meant = |column: &Column| column.meaning.kind == Kind::Value && column.meaning.lattice.is_some();
    super::arguments::each_number(input, is_meant, &mut |_, column, _, number| {
        if let Some(lattice) = column.meaning.lattice {
            let displacement = displacement(&column.meaning);
            give(Box::new(Length {
                numbers: [number],
                lattice,
                displacement,
                steps: std::cell::Cell::default(),
            }));
        }
    });
}

/// From the first cell to the last, if both are known and whole.
pub(super) fn displacement(meaning: &Meaning) -> Option<Cell> {
    between(meaning.ends[0]?, meaning.ends[1]?)
}

pub(super) fn between(from: [Exact; 2], to: [Exact; 2]) -> Option<Cell> {
    let whole_ones = |at: usize| {
        let apart = to[at] - from[at];
        (*apart.denom() == 1)
            .then(|| i32::try_from(*apart.numer()).ok())
            .flatten()
            .filter(|d| d.abs() < 1_000_000)
    };
    Some([whole_ones(0)?, whole_ones(1)?])
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let above_0 = |key: &str| match relation.exact(key)? {
        Some(value) if value <= whole(0) => Err(relation.fault(format!("`{key}` must be above 0"))),
        other => Ok(other),
    };
    let lattice = Lattice { step: above_0("step")?.unwrap_or(whole(1)), diagonal: above_0("diagonal")? };
    let ends = [relation.point("from")?, relation.point("to")?];
    let displacement = match ends {
        [Some(from), Some(to)] => {
            let whole_ones = between(from, to);
            Some(
                whole_ones
                    .ok_or_else(|| relation.fault("`from` and `to` must be whole numbers of cells apart"))?,
            )
        }
        [None, None] => None,
        _ => return Err(relation.fault("`from` and `to` are given together or not at all")),
    };
    let numbers = [relation.number("value", input)?];
    Ok(Box::new(Length { numbers, lattice, displacement, steps: std::cell::Cell::default() }))
}

/// How many numbers of diagonal moves are looked through for a length, at most.
fn cases(print: Print, lattice: Lattice, displacement: Option<Cell>) -> u64 {
    let steps = print.span().not_negative().times(lattice.step.recip());
    let is_long = |steps: &Span| displacement.is_none_or(|ends| !is_short(steps, lattice.diagonal, ends));
    steps.filter(is_long).map_or(0, |steps| floor(steps.high).clamp(0, MOVES) as u64)
}

/// The moves that print a length; `None` if there are too many to look through.
pub(super) fn moves(print: Print, lattice: Lattice, displacement: Option<Cell>) -> Option<Vec<Octile>> {
    let span = print.span().not_negative();
    if span.is_empty() {
        return Some(Vec::new());
    }
    let steps = span.times(lattice.step.recip())?;
    if displacement.is_some_and(|displacement| is_short(&steps, lattice.diagonal, displacement)) {
        return Some(Vec::new());
    }
    if floor(steps.high) > MOVES {
        return None;
    }
    match lattice.diagonal {
        None => {
            let step = Step {
                numerator: u32::try_from(*lattice.step.numer()).ok()?,
                denominator: u32::try_from(*lattice.step.denom()).ok()?,
            };
            Some(lengths_printing(print.printed, print.digits, step, displacement))
        }
        Some(diagonal) => rational(steps, diagonal, displacement),
    }
}

/// Whether every length in a span, in steps, is below that of the fewest moves between the ends: nothing is to be looked through.
fn is_short(steps: &Span, diagonal: Option<Exact>, displacement: Cell) -> bool {
    let [dx, dy] = displacement.map(|d| i128::from(d.unsigned_abs()));
    // There are as many moves as the longer axis has cells at least, and each has this many steps at least.
    let least = diagonal.unwrap_or(whole(1)).min(whole(1));
    mul(least, whole(dx.max(dy))).is_some_and(|least| steps.high < least)
}

/// The same where a diagonal counts a rational number of steps.
fn rational(steps: Span, diagonal: Exact, displacement: Option<Cell>) -> Option<Vec<Octile>> {
    let most = floor(div(steps.high, diagonal)?);
    if most > MOVES {
        return None;
    }
    let mut found = Vec::new();
    for count in 0..=most {
        let part = mul(diagonal, whole(-count))?;
        let (first, last) = steps.plus(&Span::point(part))?.integers();
        for straight in first.max(0)..=last {
            let moves =
                Octile { straight: u32::try_from(straight).ok()?, diagonal: u32::try_from(count).ok()? };
            if displacement.is_none_or(|displacement| joins(moves, displacement)) {
                found.push(moves);
            }
        }
    }
    Some(found)
}

/// The length of moves, exactly where a diagonal is rational, in decimals for people.
fn spelled_moves(moves: Octile, lattice: Lattice) -> String {
    let unit = lattice.diagonal.map_or("√2".to_owned(), |diagonal| format!("·{diagonal}"));
    format!("{} + {}{unit}", moves.straight, moves.diagonal)
}

impl Test for Length {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        self.steps.set(self.steps.get() + cases(prints[0], self.lattice, self.displacement));
        Some(!moves(prints[0], self.lattice, self.displacement)?.is_empty())
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let printed = prints[0].printed;
        let between = self.displacement.map_or(String::new(), |[dx, dy]| format!(" over ({dx}, {dy}) cells"));
        if !is_possible {
            return format!("no number of straight and diagonal moves{between} is {printed} long");
        }
        let found = moves(prints[0], self.lattice, self.displacement).unwrap_or_default();
        let listed: Vec<String> =
            found.iter().take(3).map(|moves| spelled_moves(*moves, self.lattice)).collect();
        format!("{printed} is printed by {}{between}", listed.join(", "))
    }

    fn premises(&self) -> Vec<String> {
        let diagonal = self.lattice.diagonal.map_or("√2".to_owned(), |diagonal| diagonal.to_string());
        let moves = format!(
            "moves go to one of eight neighbours and cost {} or {diagonal} times that",
            self.lattice.step
        );
        let ends = self.displacement.map(|[dx, dy]| format!("the path's ends are ({dx}, {dy}) cells apart"));
        [Some(moves), ends, Some(digits(&self.numbers))].into_iter().flatten().collect()
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let steps = prints[0].span().times(self.lattice.step.recip())?;
        let given = json!({
            "step": spelled(self.lattice.step),
            "diagonal": self.lattice.diagonal.map(spelled),
            "displacement": self.displacement.map(|cells| cells.map(|cell| cell.to_string())),
        });
        let shortest = self.lattice.diagonal.unwrap_or(whole(1)).min(whole(1));
        let most = floor(add(div(steps.high.max(whole(0)), shortest)?, whole(1))?);
        Some(Proof { given, steps: json!([{ "moves_at_most": most.to_string() }]) })
    }

    fn steps_taken(&self) -> Option<u64> {
        Some(self.steps.get())
    }

    fn witness(&self, prints: &[Print], budget: &mut Budget) -> Option<Witness> {
        let found = moves(prints[0], self.lattice, self.displacement)?;
        let before = budget.steps;
        let shown = found.iter().take(budget.most).take_while(|_| budget.steps > 0);
        let vectors: Vec<String> = shown.map(|moves| spelled_moves(*moves, self.lattice)).collect();
        let is_all = vectors.len() == found.len();
        Some(Witness { vectors, is_all, steps: [found.len() as u64, before] })
    }
}
