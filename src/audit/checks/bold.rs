//! Whether the bold numbers are the best of their columns.

use super::{Entry, Test};
use crate::input::Input;
use crate::meaning::Better;
use crate::table::{Quoted, Table, quoted};
use proofs::exact::Print;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "bold",
    about: "is what is printed bold the best of its column?",
    example: "time [lower is better]: **3.1** above 2.9",
    premises: "bold marks the best of the column; a signal, since it may mark something else",
    source: "comparison of what is printed",
    tests,
    relation: None,
};

struct Bold {
    /// The bold number, then the best one.
    numbers: [Quoted; 2],
    better: Better,
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    for (index, table) in input.tables.iter().enumerate() {
        for at in (0..table.columns.len()).filter(|_| table.statistics().is_none()) {
            in_column(index, table, at, give);
        }
    }
}

fn in_column(index: usize, table: &Table, at: usize, give: &mut dyn FnMut(Box<dyn Test>)) {
    let Some(better) = table.columns[at].meaning.better else { return };
    let bold: Vec<usize> = (0..table.rows.len()).filter(|row| table.rows[*row][at].is_bold).collect();
    if bold.is_empty() {
        return;
    }
    let numbers = (0..table.rows.len()).filter_map(|row| quoted(index, table, row, at));
    let best =
        numbers.reduce(|best, next| if is_better(better, next.print, best.print) { next } else { best });
    for row in bold {
        if let (Some(number), Some(best)) = (quoted(index, table, row, at), best.clone()) {
            give(Box::new(Bold { numbers: [number, best], better }));
        }
    }
}

fn is_better(better: Better, a: Print, b: Print) -> bool {
    match better {
        Better::Lower => a.value() < b.value(),
        Better::Higher => a.value() > b.value(),
    }
}

impl Test for Bold {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        Some(!is_better(self.better, prints[1], prints[0]))
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        if is_possible {
            return format!("{} is bold and the best of its column", prints[0].printed);
        }
        format!(
            "{} is bold, but {} of {} is better",
            prints[0].printed, prints[1].printed, self.numbers[1].name
        )
    }

    fn premises(&self) -> Vec<String> {
        let better = if self.better == Better::Lower { "lower" } else { "higher" };
        vec![format!("bold marks the best of the column, and {better} is better")]
    }

    fn is_about_digits(&self) -> bool {
        false
    }
}
