//! Tables of our own results, in LaTeX and for the report.

use super::RenderError;
use super::latex::{Cell, Column, Table};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::metric::{self, Metric};
use crate::analysis::statistic;
use crate::study::columns_of;
use crate::study::paper::Paper;
use crate::study::paper::results::{CellSpec, ResultsSpec, Show};
use crate::study::record::{Row, Status};
use base::settings::{Faults, SettingsError};
use std::fmt::Write as _;

/// Every metric of every table of results exists, and its study produces it.
///
/// # Errors
/// Each that does not, with those that do.
pub fn validate(paper: &Paper) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    for table in &paper.results {
        // A study that is not there is told by the paper's own check.
        let Some(study) = paper.study(table.study.get_ref()) else { continue };
        let columns = study.columns();
        for cell in &table.cells {
            let name = cell.metric.get_ref();
            if !metric::find(name).is_some_and(|metric| columns.contains(metric.column)) {
                let known: Vec<&str> =
                    metric::METRICS.iter().filter(|m| columns.contains(m.column)).map(|m| m.name).collect();
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

/// The head of a table and, block by block, its rows.
struct Grid {
    head: Vec<String>,
    blocks: Vec<(String, Vec<Vec<String>>)>,
}

fn grid(evidence: &Evidence<'_>, table: &ResultsSpec) -> Result<Grid, RenderError> {
    let run = evidence
        .run(table.study.get_ref())
        .ok_or_else(|| RenderError::NotStored { what: format!("a run of `{}`", table.study.get_ref()) })?;
    let metric = |cell: &CellSpec| {
        metric::find(cell.metric.get_ref())
            .ok_or_else(|| RenderError::NotStored { what: format!("the metric `{}`", cell.metric.get_ref()) })
    };
    let metrics = table.cells.iter().map(metric).collect::<Result<Vec<&Metric>, _>>()?;
    let titles =
        table.cells.iter().zip(&metrics).map(|(cell, m)| cell.label.clone().unwrap_or_else(|| m.title()));
    let head = std::iter::once(String::new()).chain(titles).collect();
    let row = |block: &crate::study::paper::results::BlockSpec, label: &String| {
        let own = run.rows(block.problems.get_ref(), label);
        let other = block.beside.as_ref().map(|beside| run.rows(beside.get_ref(), label)).unwrap_or_default();
        let cells = table.cells.iter().zip(&metrics).map(|(cell, metric)| {
            let rows = if cell.beside { &other } else { &own };
            shown(run, rows, cell, metric)
        });
        std::iter::once(label.clone()).chain(cells).collect::<Vec<String>>()
    };
    let block = |block: &crate::study::paper::results::BlockSpec| {
        let rows = table.rows.iter().map(|label| row(block, label));
        (block.title.clone(), rows.collect())
    };
    Ok(Grid { head, blocks: table.blocks.iter().map(block).collect() })
}

fn shown(run: &Run<'_>, rows: &[&Row], cell: &CellSpec, metric: &Metric) -> String {
    let number = |value: f64| {
        if value.is_finite() { format!("{value:.*}", cell.decimals) } else { "∞".to_owned() }
    };
    let solved = |row: &Row| row.status == Status::Solved;
    // What the clock did not read has not failed.
    let value = |row: &&Row| match (solved(row), run.value(row, metric)) {
        (true, value) => value,
        (false, None) if metric.is_clock() => None,
        (false, _) => Some(f64::INFINITY),
    };
    let values: Vec<f64> = rows.iter().filter_map(value).collect();
    let quantile = |share: f64| statistic::quantile(&values, share);
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let found = match cell.show {
        Show::Median => quantile(0.5).map(number),
        Show::Quartiles if values.len() < 2 => quantile(0.5).map(number),
        Show::Quartiles => [0.5, 0.25, 0.75]
            .map(quantile)
            .into_iter()
            .collect::<Option<Vec<f64>>>()
            .map(|q| format!("{} [{}, {}]", number(q[0]), number(q[1]), number(q[2]))),
        Show::Percent => statistic::mean(&finite).map(|share| number(100.0 * share)),
        Show::Solved => (!rows.is_empty()).then(|| {
            let count = rows.iter().filter(|row| solved(row)).count();
            number(100.0 * count as f64 / rows.len() as f64)
        }),
        Show::Failed => {
            let failed: Vec<f64> =
                rows.iter().filter(|row| !solved(row)).filter_map(|row| run.value(row, metric)).collect();
            statistic::median(&failed).map(number)
        }
        Show::Value => rows.iter().find_map(|row| run.value(row, metric)).map(number),
    };
    found.unwrap_or_else(|| "–".to_owned())
}

/// `table` in LaTeX.
///
/// # Errors
/// [`RenderError::NotStored`] if its study was not run.
pub fn latex(evidence: &Evidence<'_>, table: &ResultsSpec, marks: &[String]) -> Result<String, RenderError> {
    let (grid, paper, id) = (grid(evidence, table)?, evidence.paper, table.id.get_ref());
    let mut columns = vec![Column::Left];
    columns.extend(table.cells.iter().map(|_| Column::Right));
    let mut text = Table::new(format!("{}:{id}", paper.id), &table.caption, &columns);
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
    let (grid, id) = (grid(evidence, table)?, table.id.get_ref());
    // What stands beside a column is named after it too: "swept" alone could be of any.
    let column = |at: usize| {
        let (before, own) = (&grid.head[at], &grid.head[at + 1]);
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

/// `table` in Markdown, its caption below it.
///
/// # Errors
/// As [`latex`].
pub fn markdown(evidence: &Evidence<'_>, table: &ResultsSpec) -> Result<String, RenderError> {
    let grid = grid(evidence, table)?;
    let mut text = String::new();
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    text += &line(&grid.head);
    text += &format!("|{}\n", "---|".repeat(grid.head.len()));
    for (title, rows) in &grid.blocks {
        let mut heading = vec![String::new(); grid.head.len()];
        heading[0] = format!("**{title}**");
        text += &line(&heading);
        for row in rows {
            text += &line(row);
        }
    }
    let _ = write!(text, "\n*{}: {}*\n", table.id.get_ref(), table.caption);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use crate::render::latex::escaped;

    #[test]
    fn an_infinite_median_and_a_missing_one_can_be_set() {
        assert!(escaped("∞").contains("infty"), "{}", escaped("∞"));
        assert!(!escaped("–").is_empty());
    }
}
