//! The least change that mends a finding, and findings of one cause.
//!
//! A mean that no n values have makes its deviation impossible too, and its place among quantiles. A reader wants the cause
//! once. A finding that the mend of a smaller one mends as well follows from it, and is reported beside it.

use super::effort::Effort;
use super::{Class, Finding};
use crate::checks::Test;
use crate::input::Input;
use crate::table::Place;
use proofs::exact::Print;
use proofs::printed::{Digits, Printed};
use std::collections::{BTreeMap, BTreeSet};

/// The least change of one printed number that makes the finding possible.
#[derive(Debug, Clone, PartialEq)]
pub struct Mend {
    /// Which number.
    pub name: String,
    /// Where it stands.
    pub place: Place,
    /// As printed.
    pub from: Printed,
    /// As it would have to be.
    pub to: Printed,
    /// Whether the order of the rows by that column changes with it; `None` where there is no column.
    pub changes_ranking: Option<bool>,
}

/// How many changed prints are tried for a mend.
const MENDS: i64 = 2000;

/// The least change, in units of the last place, of one number of a test that refuses `prints`; `None` if the effort does not
/// suffice.
pub(super) fn least(input: &Input, test: &dyn Test, prints: &[Print], effort: &Effort) -> Option<Mend> {
    let tries = MENDS / (2 * prints.len().max(1) as i64);
    let (index, to) = (1..=tries).find_map(|by| {
        (0..prints.len()).find_map(|index| {
            [by, -by].into_iter().find_map(|by| {
                let printed = prints[index].printed;
                let changed = printed.with_units(printed.units().checked_add(by)?)?;
                let mut all = prints.to_vec();
                all[index].printed = changed;
                let is_possible = !effort.is_used_up() && effort.decide_change(test, &all) == Some(true);
                is_possible.then_some((index, changed))
            })
        })
    })?;
    let number = &test.numbers()[index];
    let from = number.print.printed;
    let changes_ranking = number.cell.and_then(|cell| changes_ranking(input, cell, from, to));
    Some(Mend { name: number.name.clone(), place: number.place, from, to, changes_ranking })
}

fn changes_ranking(
    input: &Input,
    [table, row, column]: [usize; 3],
    from: Printed,
    to: Printed,
) -> Option<bool> {
    let table = input.tables.get(table)?;
    if table.statistics().is_some() {
        return None;
    }
    let value = |printed: Printed| Print { printed, digits: Digits::Rounded }.value();
    let mut others = (0..table.rows.len()).filter(|other| *other != row);
    let (from, to) = (value(from), value(to));
    Some(others.any(|other| {
        let Some(other) = table.print(other, column) else { return false };
        from.cmp(&other.value()) != to.cmp(&other.value())
    }))
}

/// A test that refuses what is printed, and the finding that says so, by its index.
pub(super) struct Refusal {
    /// The finding's place in the list of findings.
    pub(super) finding: usize,
    /// The test that refuses.
    pub(super) test: Box<dyn Test>,
    /// Whether the author wrote the relation that it breaks: it is then reported by itself in any case.
    pub(super) is_written: bool,
}

/// Removes findings that follow from smaller ones, and names them there; gives the checks of those removed.
pub(super) fn one_a_cause(
    findings: &mut Vec<Finding>,
    mut refusals: Vec<Refusal>,
) -> Vec<(&'static str, Class)> {
    let size = |refusal: &Refusal| (refusal.test.numbers().len(), findings[refusal.finding].place);
    refusals.sort_by_key(size);
    let mut mended: BTreeMap<(Place, String), (Printed, usize)> = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for Refusal { finding, test, is_written } in &refusals {
        let mut prints: Vec<Print> = test.numbers().iter().map(|number| number.print).collect();
        let mut cause = None;
        for (print, number) in prints.iter_mut().zip(test.numbers()) {
            if let Some((to, by)) = mended.get(&(number.place, number.name.clone())) {
                (print.printed, cause) = (*to, cause.or(Some(*by)));
            }
        }
        if let Some(cause) = cause.filter(|_| !is_written && test.is_possible(&prints) == Some(true)) {
            let Finding { check, name, .. } = &findings[*finding];
            let consequence = format!("{check} of {name}");
            findings[cause].follows.push(consequence);
            taken.insert(*finding);
        } else if let Some(Mend { name, place, to, .. }) = &findings[*finding].mend {
            mended.entry((*place, name.clone())).or_insert((*to, *finding));
        }
    }
    let gone = taken.iter().map(|at| (findings[*at].check, findings[*at].class)).collect();
    let mut at = 0;
    findings.retain(|_| {
        at += 1;
        !taken.contains(&(at - 1))
    });
    gone
}
