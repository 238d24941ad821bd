//! The paper's tables with ours beside them, and every number as a macro.

use super::latex::{Cell, Column, Numbers, Table};
use super::{RenderError, marks};
use crate::analysis::class::Verdict;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Estimate, Judged, Verdicts};
use crate::study::paper::{OursSpec, Paper, TableRow, TableSpec};

/// `table` in LaTeX: for each of its rows the printed numbers, ours with their intervals, and the verdicts.
///
/// # Errors
/// Those of [`Table::latex`]; none for a checked paper.
pub fn table(evidence: &Evidence<'_>, table: &TableSpec, verdicts: &Verdicts) -> Result<String, RenderError> {
    let paper = evidence.paper;
    let mut columns = vec![Column::Left, Column::Left];
    columns.extend(table.columns.iter().map(|_| Column::Right));
    let label = format!("{}:{}", paper.id, table.id);
    let mut latex = Table::new(label, &table.caption, &columns);
    let mut head = vec![Cell::from(""), Cell::from("")];
    head.extend(table.columns.iter().map(Cell::from));
    latex.head(head);
    for row in &table.rows {
        for line in lines(evidence, table, row, verdicts)? {
            latex.row(line);
        }
    }
    for note in table.notes.as_ref().unwrap_or(&paper.source.notes) {
        latex.note(note);
    }
    if let Some(ours) = &table.ours {
        latex.note(&ours.note);
    }
    let claims = table.rows.iter().flat_map(|row| &row.claims).chain(&table.jointly);
    for note in claims.filter_map(|claim| verdicts.claim(claim.get_ref())).filter_map(premises) {
        latex.note(note);
    }
    for mark in marks(paper, verdicts) {
        latex.note(&mark);
    }
    latex.latex(&made(paper, &table.id, verdicts))
}

/// The lines that a row of the paper's takes: its own cells, or what it printed, ours, and the verdicts.
fn lines(
    evidence: &Evidence<'_>,
    table: &TableSpec,
    row: &TableRow,
    verdicts: &Verdicts,
) -> Result<Vec<Vec<Cell>>, RenderError> {
    if row.claims.is_empty() {
        let cells = [row.label.as_str(), ""].into_iter().chain(row.cells.iter().map(String::as_str));
        return Ok(vec![cells.map(Cell::from).collect()]);
    }
    let judged: Vec<Option<&Judged>> =
        row.claims.iter().map(|claim| verdicts.claim(claim.get_ref())).collect();
    let line = |first: &str, second: &str, text: &dyn Fn(&Judged) -> String| {
        let mut cells = vec![Cell::from(first), Cell::from(second)];
        cells.extend(judged.iter().map(|judged| Cell::from(judged.map_or_else(dash, text))));
        cells
    };
    let shown = |estimate: &Estimate| rounded(estimate, table.decimals.unwrap_or(2));
    let ours = match &table.ours {
        Some(ours) => {
            let own = own_values(evidence, ours, row)?;
            ["", "ours"].map(Cell::from).into_iter().chain(own.iter().map(Cell::from)).collect()
        }
        None => line("", "ours", &|judged| judged.ours().map_or_else(dash, shown)),
    };
    let printed = line(&row.label, "printed", &|judged| judged.printed.clone().unwrap_or_else(dash));
    Ok(vec![printed, ours, line("", "verdict", &|judged| judged.outcome().to_owned())])
}

/// The row of trials of one contender on one problem, or what it saves there of another's.
fn own_values(evidence: &Evidence<'_>, ours: &OursSpec, row: &TableRow) -> Result<Vec<String>, RenderError> {
    let missing = |what: String| RenderError::NotStored { what };
    let study = ours.study.get_ref();
    let run = evidence.run(study).ok_or_else(|| missing(format!("a run of `{study}`")))?;
    let value = |metric: &str, contender: &String| {
        let row = run.rows(&ours.problems, contender).into_iter().next();
        let row = row.ok_or_else(|| missing(format!("`{contender}` on `{}` of `{study}`", ours.problems)))?;
        let metric = evidence.metric(metric).ok_or_else(|| missing(format!("the metric `{metric}`")))?;
        Ok::<_, RenderError>(run.value(row, metric))
    };
    let contender =
        row.contender.as_ref().ok_or_else(|| missing(format!("a contender for `{}`", row.label)))?;
    let cell = |metric: &String| {
        let own = value(metric, contender)?;
        let text = match &row.reduced_from {
            None => own.map(number),
            Some(base) => {
                let base = value(metric, base)?;
                own.zip(base).map(|(own, base)| format!("{:.2}", 100.0 * (base - own) / base))
            }
        };
        Ok(text.unwrap_or_else(dash))
    };
    ours.metrics.iter().map(cell).collect()
}

/// What a proof that a claim is impossible takes for granted.
fn premises(judged: &Judged) -> Option<String> {
    if judged.verdict != Verdict::Impossible {
        return None;
    }
    let proof = judged.findings.iter().find(|finding| finding.verdict == Some(judged.verdict))?;
    let what = match (&judged.printed, &judged.says) {
        (Some(printed), _) => format!("{printed} is"),
        (None, Some(says)) => format!("That {says} is"),
        (None, None) => format!("{} is", judged.at),
    };
    let beside = judged.printed.as_ref().and(judged.says.as_deref()).map(|says| format!(" ({says})"));
    Some(format!("{what} impossible{} where {}.", beside.unwrap_or_default(), proof.premises.join("; ")))
}

/// One macro for each printed number, each of ours, each end of an interval, each count of draws, each verdict, and each
/// cell of ours in the paper's tables and in tables of results.
///
/// # Errors
/// [`RenderError::DuplicateMacro`] if two names differ in punctuation only; those of [`table`].
pub fn numbers(evidence: &Evidence<'_>, verdicts: &Verdicts) -> Result<String, RenderError> {
    let paper = evidence.paper;
    let mut numbers = Numbers::default();
    for (key, cell) in own_cells(evidence)? {
        numbers.add(&key, &cell)?;
    }
    for judged in &verdicts.claims {
        let key = |what: &str| format!("{}.{what}", judged.claim);
        if let Some(printed) = &judged.printed {
            numbers.add(&key("printed"), printed)?;
        }
        if let Some(ours) = judged.ours() {
            numbers.add(&key("ours"), &number(ours.value))?;
            if let Some([low, high]) = ours.interval {
                numbers.add(&key("low"), &number(low))?;
                numbers.add(&key("high"), &number(high))?;
            }
            numbers.add(&key("n"), &ours.n.to_string())?;
        }
        numbers.add(&key("verdict"), judged.outcome())?;
    }
    let made = made(paper, "numbers", verdicts);
    let notes = paper.source.stand_ins.as_ref().map_or(made.clone(), |note| format!("{made}\n{note}"));
    numbers.latex(&paper.id, &notes)
}

pub(super) fn made(paper: &Paper, id: &str, verdicts: &Verdicts) -> String {
    let made = format!("made by `replan render {} --only {id}`", paper.id);
    [made].into_iter().chain(marks(paper, verdicts)).collect::<Vec<_>>().join(". ")
}

/// The cells of ours that stand in tables and belong to no one claim, under keys of table, row and column.
fn own_cells(evidence: &Evidence<'_>) -> Result<Vec<(String, String)>, RenderError> {
    let mut cells = Vec::new();
    for table in &evidence.paper.tables {
        let Some(ours) = &table.ours else { continue };
        for row in table.rows.iter().filter(|row| !row.claims.is_empty()) {
            let own = own_values(evidence, ours, row)?;
            let keys = table
                .columns
                .iter()
                .map(|column| [&table.id, &row.label, column].map(String::as_str).join("."));
            cells.extend(keys.zip(own));
        }
    }
    for table in &evidence.paper.results {
        cells.extend(super::results::cells(evidence, table)?);
    }
    Ok(cells)
}

fn dash() -> String {
    "–".to_owned()
}

/// Our number as tables show it: four decimals at most, two with its interval.
pub fn short(estimate: &Estimate) -> String {
    rounded(estimate, 2)
}

/// The same with so many decimals where it has an interval.
fn rounded(estimate: &Estimate, decimals: usize) -> String {
    match estimate.interval {
        Some([low, high]) => {
            let coarse = |value: f64| format!("{value:.decimals$}");
            format!("{} [{}, {}]", coarse(estimate.value), coarse(low), coarse(high))
        }
        None => number(estimate.value),
    }
}

/// A number with four decimals at most; what these would show as zero stands as a power of ten.
pub(super) fn number(value: f64) -> String {
    if value != 0.0 && value.abs() < 5e-5 {
        return format!("{value:.1e}");
    }
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
    if text == "-0" { "0".to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Inputs, ReadingChoice};
    use std::path::Path;

    #[test]
    fn a_file_of_numbers_says_that_inputs_are_stand_ins_where_they_are() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let inputs = Inputs { roots: vec![root.to_owned()] };
        for (name, has) in [("tang2023", true), ("movingai_sample", false)] {
            let mut paper = Paper::load(&root.join("experiments").join(name), &inputs).unwrap();
            paper.claims.clear();
            paper.tables.clear();
            paper.results.clear();
            paper.studies.clear();
            let verdicts = Verdicts {
                paper: name.to_owned(),
                command: String::new(),
                quick: false,
                reading: std::collections::BTreeMap::new(),
                claims_changed_since: Vec::new(),
                claims: Vec::new(),
                together: Vec::new(),
            };
            let evidence = Evidence::read(&paper, ReadingChoice::default(), root).unwrap();
            let text = numbers(&evidence, &verdicts).unwrap();
            assert_eq!(text.contains("\n% Stand-in environments: "), has, "{text}");
        }
    }

    #[test]
    fn a_number_that_is_not_zero_is_not_shown_as_zero() {
        for (value, text) in [(5e-9, "5.0e-9"), (-0.0, "0"), (0.0, "0"), (14.65, "14.65"), (0.0018, "0.0018")]
        {
            assert_eq!(number(value), text);
        }
    }
}
