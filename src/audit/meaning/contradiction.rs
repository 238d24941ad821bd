//! Items of annotations that contradict each other. Such an annotation is refused, since every number would be
//! impossible under it.

use super::{Kind, Meaning};
use proofs::exact::{Exact, whole};

/// Whether both say something, and not the same.
fn differ<T: PartialEq>(a: &T, b: &T, unset: &T) -> bool {
    a != unset && b != unset && a != b
}

/// What two meanings of the same values say differently; `None` if they can both hold.
pub fn of_values(a: &Meaning, b: &Meaning) -> Option<&'static str> {
    let unset = Meaning::default();
    [
        (differ(&a.n, &b.n, &unset.n), "how many values there are"),
        (differ(&a.grain, &b.grain, &unset.grain), "what values are multiples of"),
        (differ(&a.least, &b.least, &unset.least), "the least value"),
        (differ(&a.most, &b.most, &unset.most), "the greatest value"),
        (differ(&a.seeds, &b.seeds, &unset.seeds), "how many seeds there are"),
        (differ(&a.divisor, &b.divisor, &unset.divisor), "how a deviation divides"),
        (differ(&a.unit, &b.unit, &unset.unit), "the unit"),
    ]
    .into_iter()
    .find_map(|(is_contrary, what)| is_contrary.then_some(what))
}

/// What two items of one annotation say differently; `None` if they can both hold.
pub(super) fn of_items(a: &Meaning, b: &Meaning) -> Option<&'static str> {
    let unset = Meaning::default();
    let step =
        |meaning: &Meaning| meaning.lattice.map(|lattice| lattice.step).filter(|step| *step != whole(1));
    let diagonal = |meaning: &Meaning| meaning.lattice.and_then(|lattice| lattice.diagonal);
    let of_column = [
        (differ(&a.kind, &b.kind, &unset.kind), "what kind of number the column holds"),
        (differ(&a.spread, &b.spread, &unset.spread), "what stands after ±"),
        (differ(&a.digits, &b.digits, &unset.digits), "how digits end"),
        (differ(&a.significant, &b.significant, &unset.significant), "how many digits count"),
        (differ(&a.of, &b.of, &unset.of), "what the statistics are of"),
        (differ(&a.parts, &b.parts, &unset.parts), "the whole whose parts these are"),
        (differ(&a.sum, &b.sum, &unset.sum), "what is summed"),
        (differ(&a.ratio, &b.ratio, &unset.ratio), "what is divided"),
        (differ(&step(a), &step(b), &None), "the lattice's step"),
        (differ(&diagonal(a), &diagonal(b), &None), "what a diagonal move counts"),
        (differ(&a.ends[0], &b.ends[0], &None), "where paths start"),
        (differ(&a.ends[1], &b.ends[1], &None), "where paths end"),
        (differ(&a.turns, &b.turns, &unset.turns), "where the turn sums stand"),
        (differ(&a.free, &b.free, &unset.free), "how many cells are free"),
        (differ(&a.better, &b.better, &unset.better), "which way is better"),
    ];
    let contrary = of_column.into_iter().find_map(|(is_contrary, what)| is_contrary.then_some(what));
    of_values(a, b).or(contrary)
}

/// Why ends of values exclude each other, in words; `None` if they do not.
pub fn of_ends(least: Option<Exact>, most: Option<Exact>) -> Option<String> {
    let (least, most) = least.zip(most).filter(|(least, most)| least > most)?;
    Some(format!("least={least} is above most={most}, so that no value is allowed; least is at most most"))
}

/// Why an annotation as a whole holds of no values, in words; `None` if it may.
pub(super) fn of_whole(meaning: &Meaning) -> Option<String> {
    let is_share = matches!(meaning.kind, Kind::Share { .. });
    if is_share && (meaning.grain.is_some() || meaning.least.is_some() || meaning.most.is_some()) {
        let message = "behind a share every value is 0 or the whole, so that `integers`, `tick`, `binary`, `least` and `most` \
                    contradict it or say nothing; leave them out, or say `mean` for the share";
        return Some(message.to_owned());
    }
    if meaning.seeds.is_some() && !is_share {
        return Some(
            "`seeds=S` is for shares averaged over seeds; `% of T, seeds=S`, T trials each, is accepted"
                .to_owned(),
        );
    }
    of_ends(meaning.least, meaning.most)
}
