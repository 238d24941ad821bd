//! Tables of our own results, in LaTeX and for the report.

use super::RenderError;
use super::latex::{Cell, Column, Table};
use super::prose::markdown as safe;
use crate::analysis::evidence::Evidence;
use crate::analysis::metric;
use crate::analysis::tabulated::{Grid, grid, table_caption};
use base::settings::{Faults, SettingsError};
use study::columns_of;
use study::paper::Paper;
use study::paper::results::{ResultsSpec, Show};

/// Every metric of every table of results exists, and its study produces it.
///
/// # Errors
/// Each that does not, with those that do.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    for table in &paper.results {
        // A study that is not there is reported by the paper's own check.
        let Some(study) = paper.study(table.study.get_ref()) else { continue };
        let [counted, preprocessing] = [study.columns(), study.preprocessing_columns()];
        for cell in &table.cells {
            let columns = if cell.show == Show::Preprocessing { &preprocessing } else { &counted };
            let name = cell.metric.get_ref();
            let is_given = |metric: &metric::Metric| metric.is_read_from(columns);
            if !metric::find(name).is_some_and(is_given) {
                let known: Vec<&str> =
                    metric::METRICS.iter().filter(|m| is_given(m)).map(|m| m.name).collect();
                let message = format!(
                    "study `{}` does not produce the metric `{name}`; it produces {}",
                    table.study.get_ref(),
                    known.join(", ")
                );
                let fault = paper.document.error(cell.metric.span(), message);
                faults.add(fault.about(&columns_of(table.study.get_ref())));
            }
        }
    }
    faults.done()
}

fn stored(evidence: &Evidence<'_>, table: &ResultsSpec) -> Result<Grid, RenderError> {
    grid(evidence, table).map_err(|what| RenderError::NotStored { what })
}

/// `table` in LaTeX.
///
/// # Errors
/// [`RenderError::NotStored`] if its study was not run.
pub fn latex(evidence: &Evidence<'_>, table: &ResultsSpec, marks: &[String]) -> Result<String, RenderError> {
    let grid = stored(evidence, table)?;
    let paper = evidence.paper;
    let id = table.id.get_ref();
    let mut columns = vec![Column::Left];
    columns.extend(table.cells.iter().map(|_| Column::Right));
    let mut text = Table::new(format!("{}:{id}", paper.id), table_caption(evidence, table), &columns);
    text.head(grid.head.iter().map(Cell::from).collect());
    for (title, rows) in &grid.blocks {
        text.group(title);
        for row in rows {
            text.row(row.iter().map(Cell::from).collect());
        }
    }
    for note in paper.source.stand_ins.iter().chain(marks) {
        text.note(note);
    }
    text.latex(&format!("made by `replan render {} --only {id}`", paper.id))
}

/// Every cell of `table` under a key of block, row and column.
///
/// # Errors
/// As [`latex`].
pub fn cells(evidence: &Evidence<'_>, table: &ResultsSpec) -> Result<Vec<(String, String)>, RenderError> {
    let grid = stored(evidence, table)?;
    let id = table.id.get_ref();
    // What stands beside a column is named after it too: "swept" alone could be of any.
    let column = |at: usize| {
        let before = &grid.head[at];
        let own = &grid.head[at + 1];
        if table.cells[at].beside { format!("{before} {own}") } else { own.clone() }
    };
    let columns: Vec<String> = (0..table.cells.len()).map(column).collect();
    let mut cells = Vec::new();
    for (title, rows) in &grid.blocks {
        for row in rows {
            let key = |column: &String| [id, title, &row[0], column].map(String::as_str).join(".");
            cells.extend(columns.iter().zip(&row[1..]).map(|(column, cell)| (key(column), cell.clone())));
        }
    }
    Ok(cells)
}

/// `table` in Markdown, its caption above it.
///
/// # Errors
/// As [`latex`].
pub fn markdown(evidence: &Evidence<'_>, table: &ResultsSpec) -> Result<String, RenderError> {
    let grid = stored(evidence, table)?;
    let line = |cells: &[String]| {
        let safe: Vec<String> = cells.iter().map(|cell| safe(cell)).collect();
        format!("| {} |\n", safe.join(" | "))
    };
    let caption = super::prose::wrapped("", &safe(&table_caption(evidence, table)), 0, super::prose::COLUMNS);
    let mut text = format!("{caption}\n\n{}|{}\n", line(&grid.head), "---|".repeat(grid.head.len()));
    for (title, rows) in &grid.blocks {
        text += &format!("| **{}** |{}\n", safe(title), " |".repeat(grid.head.len() - 1));
        text.extend(rows.iter().map(|row| line(row)));
    }
    Ok(text)
}
