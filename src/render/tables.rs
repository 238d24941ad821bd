//! The paper's tables with ours beside them, and every number as a macro.

use super::RenderError;
use super::latex::{Cell, Column, Numbers, Table};
use crate::analysis::verdict::{Estimate, Judged, Verdicts};
use crate::study::paper::{Paper, TableSpec};

/// `table` in LaTeX: for each of its rows the printed numbers, ours with their intervals, and the verdicts.
///
/// # Errors
/// Those of [`Table::latex`]; none for a checked paper.
pub fn table(paper: &Paper, table: &TableSpec, verdicts: &Verdicts) -> Result<String, RenderError> {
    let mut columns = vec![Column::Left, Column::Left];
    columns.extend(table.columns.iter().map(|_| Column::Right));
    let label = format!("{}:{}", paper.id, table.id);
    let mut latex = Table::new(label, &table.caption, &columns);
    let mut head = vec![Cell::from(""), Cell::from("")];
    head.extend(table.columns.iter().map(Cell::from));
    latex.head(head);
    for row in &table.rows {
        if row.claims.is_empty() {
            let cells = [row.label.as_str(), ""].into_iter().chain(row.cells.iter().map(String::as_str));
            latex.row(cells.map(Cell::from).collect());
            continue;
        }
        let judged: Vec<Option<&Judged>> =
            row.claims.iter().map(|claim| verdicts.claim(claim.get_ref())).collect();
        let line = |first: &str, second: &str, text: &dyn Fn(&Judged) -> String| {
            let mut cells = vec![Cell::from(first), Cell::from(second)];
            cells.extend(judged.iter().map(|judged| Cell::from(judged.map_or_else(dash, text))));
            cells
        };
        latex.row(line(&row.label, "printed", &|judged| judged.printed.clone().unwrap_or_else(dash)));
        latex.row(line("", "ours", &|judged| judged.ours().map_or_else(dash, short)));
        latex.row(line("", "verdict", &|judged| judged.verdict.name().to_owned()));
    }
    for note in &paper.source.notes {
        latex.note(note);
    }
    if verdicts.quick {
        latex.note(super::output::QUICK);
    }
    latex.latex(&made(paper, &table.id, verdicts))
}

/// One macro for each printed number, each of ours, each end of an interval, each count of draws and each verdict.
///
/// # Errors
/// [`RenderError::DuplicateMacro`] if two claims' names differ in punctuation only.
pub fn numbers(paper: &Paper, verdicts: &Verdicts) -> Result<String, RenderError> {
    let mut numbers = Numbers::default();
    for judged in &verdicts.claims {
        let key = |what: &str| format!("{}.{what}", judged.claim);
        if let Some(printed) = &judged.printed {
            numbers.add(&key("printed"), printed)?;
        }
        if let Some(ours) = judged.ours() {
            numbers.add(&key("ours"), &plain(ours.value))?;
            if let Some([low, high]) = ours.interval {
                numbers.add(&key("low"), &plain(low))?;
                numbers.add(&key("high"), &plain(high))?;
            }
            numbers.add(&key("n"), &ours.n.to_string())?;
        }
        numbers.add(&key("verdict"), judged.verdict.name())?;
    }
    numbers.latex(&paper.id, &made(paper, "numbers", verdicts))
}

pub(super) fn made(paper: &Paper, id: &str, verdicts: &Verdicts) -> String {
    let made = format!("made by `replan render {} --only {id}`", paper.id);
    if verdicts.quick { format!("{made}. {}", super::output::QUICK) } else { made }
}

fn dash() -> String {
    "–".to_owned()
}

/// A number with four decimals at most.
fn plain(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
    if text == "-0" { "0".to_owned() } else { text }
}

/// Our number as tables show it: four decimals at most, two with its interval.
pub fn short(estimate: &Estimate) -> String {
    match estimate.interval {
        Some([low, high]) => {
            let coarse = |value: f64| format!("{value:.2}");
            format!("{} [{}, {}]", coarse(estimate.value), coarse(low), coarse(high))
        }
        None => plain(estimate.value),
    }
}
