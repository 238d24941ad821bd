//! Whether a printed length is at least the straight line, or the octile distance, between its ends.

use super::arguments::{digits, shown};
use super::keys::{FROM, OF_PATH, TO};
use super::{Entry, FromRelation, Proof, Test};
use crate::input::{Input, Relation};
use crate::meaning::{Kind, Meaning};
use crate::statistic::Statistic;
use crate::table::{Column, Fault, Quoted};
use proofs::bounds::{Moves, against, apart};
use proofs::exact::{Exact, Print, float, spelled, whole};
use serde_json::json;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "path_bound",
    about: "is a length at least the straight line, or on a lattice the octile distance, between its ends?",
    example: "length [from=22.5:15.5, to=26.5:28.5] = 13.40",
    premises: "the path joins the two ends; its length is in their unit",
    source: "the triangle inequality; compared in squares, exactly",
    tests,
    relation: Some(FromRelation {
        keys: &[
            OF_PATH,
            FROM,
            TO,
            (
                "moves",
                "What the path is made of: `eight` or `four` neighbours' moves; `any` lines if absent.",
            ),
        ],
        build,
    }),
};

struct PathBound {
    numbers: [Quoted; 1],
    /// How far the ends are apart along each axis.
    apart: [Exact; 2],
    moves: Moves,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    let is_length = |kind: &Kind| match kind {
        Kind::Value => true,
        Kind::Statistic(statistic) => !matches!(statistic, Statistic::Sd | Statistic::Se | Statistic::Total),
        _ => false,
    };
    // Where a diagonal move does not count √2, a length may be below the straight line; the check `lattice` looks at it.
    let is_length_of_path =
        |meaning: &Meaning| meaning.lattice.is_none_or(|lattice| lattice.diagonal.is_none());
    let is_meant = |column: &Column| {
        is_length(&column.meaning.kind)
            && is_length_of_path(&column.meaning)
            && column.meaning.ends.iter().all(Option::is_some)
    };
    super::arguments::each_number(input, is_meant, &mut |_, column, _, number| {
        if let [Some(from), Some(to)] = column.meaning.ends {
            // Only moves of cost 1 and √2 on cells have the octile distance.
            let is_octile = column.meaning.lattice.is_some_and(|lattice| lattice.step == whole(1));
            let moves = if is_octile { Moves::Eight } else { Moves::Any };
            give(Box::new(PathBound { numbers: [number], apart: apart(from, to), moves }));
        }
    });
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let missing = || relation.fault("`from` and `to` are needed, points \"X:Y\"");
    let from = relation.point("from")?.ok_or_else(missing)?;
    let to = relation.point("to")?.ok_or_else(missing)?;
    let moves = match relation.word("moves", &["any", "eight", "four"])? {
        "eight" => Moves::Eight,
        "four" => Moves::Four,
        _ => Moves::Any,
    };
    Ok(Box::new(PathBound { numbers: [relation.number("value", input)?], apart: apart(from, to), moves }))
}

impl Test for PathBound {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(against(prints[0], self.apart, self.moves)?.0.is_ge())
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let bound = against(prints[0], self.apart, self.moves)
            .map_or(f64::NAN, |(_, [a, b])| float(a) + float(b).sqrt());
        let what = match self.moves {
            Moves::Any => "the straight line",
            Moves::Eight => "the octile distance",
            Moves::Four => "the Manhattan distance",
        };
        let verb = if is_possible { "is not shorter than" } else { "is shorter than" };
        format!("{} {verb} {what} between the ends, {bound:.4}", prints[0].printed)
    }

    fn premises(&self) -> Vec<String> {
        let [dx, dy] = self.apart.map(|apart| shown(apart, 6));
        let moves = match self.moves {
            Moves::Any => "",
            Moves::Eight => "; moves go to one of eight neighbours",
            Moves::Four => "; moves go to one of four neighbours",
        };
        vec![
            format!("the path joins ends that are ({dx}, {dy}) apart, in the length's unit{moves}"),
            digits(&self.numbers),
        ]
    }

    fn proof(&self, prints: &[Print]) -> Option<Proof> {
        let (_, [a, b]) = against(prints[0], self.apart, self.moves)?;
        let given = json!({ "apart": self.apart.map(spelled), "moves": self.moves.name() });
        Some(Proof { given, steps: json!([{ "plus": spelled(a), "root_of": spelled(b) }]) })
    }
}
