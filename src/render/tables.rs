//! The paper's tables with ours beside them, and every number as a macro.

use super::latex::{Cell, Column, Numbers, Table};
use super::prose::{markdown as safe, number};
use super::{RenderError, marks};
use crate::analysis::evidence::Evidence;
use crate::analysis::outcome::Outcome;
use crate::analysis::tabulated;
use crate::analysis::verdict::{ClaimVerdict, Estimate, Verdicts};
use crate::analysis::verdict_rule::Verdict;
use study::paper::{Claim, Paper, PrintedRow, PrintedTable};

/// A row of one of the paper's tables beside ours: in each column the printed number, ours, and the claim with its
/// verdict.
pub struct Beside<'a> {
    /// What the paper printed, a cell a column.
    pub printed: Vec<String>,
    /// Ours.
    pub ours: Vec<String>,
    /// The claim of the cell.
    pub claims: Vec<Option<&'a ClaimVerdict>>,
}

/// The row of the table; none if it holds no claims.
///
/// # Errors
/// [`RenderError::NotStored`] if ours was not stored.
pub fn beside<'a>(
    evidence: &Evidence<'_>,
    table: &PrintedTable,
    row: &PrintedRow,
    verdicts: &'a Verdicts,
) -> Result<Option<Beside<'a>>, RenderError> {
    if row.cells.iter().all(|cell| cell.claim.is_none()) {
        return Ok(None);
    }
    let mut found = Beside { printed: Vec::new(), ours: Vec::new(), claims: Vec::new() };
    for cell in &row.cells {
        let judged = cell.claim.as_ref().and_then(|claim| verdicts.claim(claim));
        let ours = match (&cell.claim, &cell.beside) {
            (Some(claim), Some(settings)) => {
                let own = tabulated::beside(evidence, claim, settings);
                let own = own.map_err(|what| RenderError::NotStored { what })?;
                let is_saving = settings.table()["select"].get("against").is_some();
                own.map(|value| if is_saving { format!("{value:.2}") } else { number(value) })
            }
            _ => judged.and_then(ClaimVerdict::ours).map(|ours| rounded(ours, table.decimals)),
        };
        found.printed.push(cell.printed.clone());
        found.ours.push(ours.unwrap_or_else(dash));
        found.claims.push(judged);
    }
    Ok(Some(found))
}

/// `table` in LaTeX: for each of its rows the printed numbers, ours with their intervals, and the verdicts.
///
/// # Errors
/// Those of [`Table::latex`]; none for a checked paper.
pub fn table(
    evidence: &Evidence<'_>,
    table: &PrintedTable,
    verdicts: &Verdicts,
) -> Result<String, RenderError> {
    let paper = evidence.paper;
    let mut columns = vec![Column::Left, Column::Left];
    columns.extend(table.columns.iter().map(|_| Column::Right));
    let label = format!("{}:{}", paper.id, table.id);
    let mut latex = Table::new(label, &table.caption, &columns);
    let line = |first: &str, second: &str, cells: &[String]| {
        [first, second]
            .into_iter()
            .chain(cells.iter().map(String::as_str))
            .map(Cell::from)
            .collect::<Vec<_>>()
    };
    latex.head(line("", "", &table.columns));
    for row in &table.rows {
        let Some(beside) = beside(evidence, table, row, verdicts)? else {
            latex.row(line(&row.label, "", &printed(row)));
            continue;
        };
        latex.row(line(&row.label, "printed", &beside.printed));
        latex.row(line("", "ours", &beside.ours));
        let verdict = |judged: Option<&ClaimVerdict>| judged.map_or_else(dash, ClaimVerdict::verdict_text);
        let mut claims = line("", "verdict", &beside.claims.iter().copied().map(verdict).collect::<Vec<_>>());
        for (cell, judged) in claims.iter_mut().skip(2).zip(&beside.claims) {
            let notes = granted(paper, *judged, verdicts);
            if !notes.is_empty() {
                latex.footnote(cell, notes.join(" "));
            }
        }
        latex.row(claims);
    }
    for note in table.notes.iter().chain(&marks(paper, verdicts)) {
        latex.note(note);
    }
    latex.latex(&made(paper, &table.id, verdicts))
}

/// What stands in a row of the paper's.
fn printed(row: &PrintedRow) -> Vec<String> {
    row.cells.iter().map(|cell| cell.printed.clone()).collect()
}

/// What the proofs of a cell's verdict take for granted, those of claims that are no cells and speak of its number among them.
fn granted(paper: &Paper, judged: Option<&ClaimVerdict>, verdicts: &Verdicts) -> Vec<String> {
    let Some(judged) = judged else { return Vec::new() };
    let speaks = |claim: &&Claim| {
        claim.printed.is_none() && claim.tests().any(|(.., settings)| settings.names(&judged.claim))
    };
    let beside = paper.claims.iter().filter(speaks).filter_map(|claim| verdicts.claim(&claim.id));
    std::iter::once(judged).chain(beside).filter_map(premises).collect()
}

/// `table` in Markdown. Up to two columns stand side by side, each as printed, ours and verdict; more stand one line above
/// another. `link` is what a claim's verdict leads to.
///
/// # Errors
/// As [`table`].
pub fn markdown(
    evidence: &Evidence<'_>,
    table: &PrintedTable,
    verdicts: &Verdicts,
    link: impl Fn(&ClaimVerdict) -> String,
) -> Result<String, RenderError> {
    let mut lines: Vec<Vec<String>> = Vec::new();
    let is_wide = table.columns.len() > 2
        || !table.rows.iter().all(|row| row.cells.iter().any(|cell| cell.claim.is_some()));
    let verdict = |judged: Option<&ClaimVerdict>| judged.map_or_else(dash, &link);
    let escaped = |cells: &[String]| cells.iter().map(|cell| safe(cell)).collect::<Vec<_>>();
    let line = |first: &str, second: &str, cells: Vec<String>| {
        [first, second].map(str::to_owned).into_iter().chain(cells).collect::<Vec<_>>()
    };
    for row in &table.rows {
        let label = safe(&row.label);
        match beside(evidence, table, row, verdicts)? {
            None => lines.push(line(&label, "", escaped(&printed(row)))),
            Some(Beside { printed, ours, claims }) if is_wide => {
                lines.push(line(&label, "printed", escaped(&printed)));
                lines.push(line("", "ours", escaped(&ours)));
                lines.push(line("", "verdict", claims.iter().copied().map(verdict).collect()));
            }
            Some(Beside { printed, ours, claims }) => {
                let cells = printed.iter().zip(&ours).zip(&claims);
                let cells =
                    cells.flat_map(|((printed, ours), judged)| [safe(printed), safe(ours), verdict(*judged)]);
                lines.push(std::iter::once(label).chain(cells).collect());
            }
        }
    }
    let columns = escaped(&table.columns);
    let head = if is_wide { line("", "", columns) } else { side_by_side(columns) };
    let rule = vec!["---".to_owned(); head.len()];
    let lines = [head, rule].into_iter().chain(lines);
    Ok(lines.map(|cells| format!("| {} |\n", cells.join(" | "))).collect::<Vec<_>>().concat())
}

/// The head of a table that has printed, ours and verdict side by side.
fn side_by_side(columns: Vec<String>) -> Vec<String> {
    let named = columns
        .into_iter()
        .flat_map(|name| [format!("{name}: printed"), "ours".to_owned(), "verdict".to_owned()]);
    std::iter::once(String::new()).chain(named).collect()
}

/// What a proof that a claim is impossible takes for granted.
fn premises(judged: &ClaimVerdict) -> Option<String> {
    if judged.verdict != Verdict::Impossible {
        return None;
    }
    let proof = judged.findings.iter().find(|finding| finding.outcome == Some(Outcome::Proved))?;
    let what = match (&judged.printed, &judged.says) {
        (Some(printed), _) => format!("{printed} is"),
        (None, Some(says)) => format!("That {says} is"),
        (None, None) => format!("{} is", judged.at),
    };
    let beside = judged.printed.as_ref().and(judged.says.as_deref()).map(|says| format!(" ({says})"));
    Some(format!("{what} impossible{} where {}.", beside.unwrap_or_default(), proof.premises.join("; ")))
}

/// One macro for each printed number, each of ours, each end of an interval, each count of instances, each verdict, and each
/// cell of ours in the paper's tables and in tables of results.
///
/// # Errors
/// [`RenderError::DuplicateMacro`] if two names differ in punctuation only; those of [`table`].
pub fn numbers(evidence: &Evidence<'_>, verdicts: &Verdicts) -> Result<String, RenderError> {
    let paper = evidence.paper;
    let mut numbers = Numbers::default();
    for (key, cell) in own_cells(evidence, verdicts)? {
        numbers.add(&key, &cell, "a cell of ours: table, row, column")?;
    }
    for judged in &verdicts.claims {
        let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(", {unit}"));
        let mut add = |key: &str, value: &str, what: &str| {
            numbers.add(&format!("{}.{key}", judged.claim), value, &format!("{what}{unit}; {}", judged.at))
        };
        if let Some(printed) = &judged.printed {
            add("printed", printed, "as printed")?;
        }
        if let Some(ours) = judged.ours() {
            add("ours", &number(ours.value), &ours.what)?;
            if let Some([low, high]) = ours.interval {
                add("low", &number(low), "lower end of our interval")?;
                add("high", &number(high), "upper end of our interval")?;
            }
            add("n", &ours.n.to_string(), "independent instances behind it")?;
        }
        add("verdict", &judged.verdict_text(), "our verdict")?;
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
fn own_cells(evidence: &Evidence<'_>, verdicts: &Verdicts) -> Result<Vec<(String, String)>, RenderError> {
    let mut cells = Vec::new();
    for table in &evidence.paper.tables {
        for row in table.rows.iter().filter(|row| row.cells.iter().any(|cell| cell.beside.is_some())) {
            let Some(own) = beside(evidence, table, row, verdicts)?.map(|row| row.ours) else { continue };
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

/// Digits of a half-width from which on its first digit alone counts, as the Particle Data Group rounds errors.
const ONE_DIGIT: f64 = 3.55;

/// Our number as lists show it: four decimals at most, or with its interval as many as the half-width of that leaves certain.
pub fn short(estimate: &Estimate) -> String {
    let half = estimate.interval.map_or(0.0, |[low, high]| (high - low) / 2.0);
    if half == 0.0 || !half.is_finite() {
        return rounded(estimate, 2);
    }
    let leading = libm::log10(half).floor();
    let more = if half / libm::pow(10.0, leading) < ONE_DIGIT { 1.0 } else { 0.0 };
    rounded(estimate, (more - leading).clamp(0.0, 10.0) as usize)
}

/// Our number with what it is, how many instances and how many of its cases are behind it.
pub fn in_full(ours: &Estimate) -> String {
    let solved = ours.solved.map_or_else(String::new, |[solved, all]| format!(", {solved} of {all} solved"));
    format!("{} ({}; n = {}{solved})", short(ours), ours.what, ours.n)
}

/// The same with so many decimals where it has an interval that is more than the number itself.
fn rounded(estimate: &Estimate, decimals: usize) -> String {
    match estimate.interval {
        Some([low, high]) if low < high => {
            let coarse = |value: f64| {
                let text = format!("{value:.decimals$}");
                let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
                if is_zero { text.replace('-', "") } else { text }
            };
            format!("{} [{}, {}]", coarse(estimate.value), coarse(low), coarse(high))
        }
        _ => number(estimate.value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use study::{Inputs, Interpretation};

    #[test]
    fn a_file_of_numbers_says_that_inputs_are_stand_ins_where_they_are() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let inputs = Inputs::below(vec![root.to_owned()]);
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
                interpretation: std::collections::BTreeMap::new(),
                explored: None,
                records: std::collections::BTreeMap::new(),
                meanings: String::new(),
                history: None,
                remarks: Vec::new(),
                withdrawn: Vec::new(),
                claims: Vec::new(),
                together: Vec::new(),
                replies: Vec::new(),
            };
            let evidence = Evidence::read(&paper, Interpretation::default(), root).unwrap();
            let text = numbers(&evidence, &verdicts).unwrap();
            assert_eq!(text.contains("\n% Stand-in environments: "), has, "{text}");
        }
    }

    #[test]
    fn a_number_beside_its_interval_keeps_the_digits_that_this_leaves_certain() {
        for (value, low, high, text) in [
            (-0.0004, -0.002, 0.001, "-0.0004 [-0.0020, 0.0010]"),
            (0.0043, 0.0038, 0.0048, "0.0043 [0.0038, 0.0048]"),
            (-0.0193, -0.0388, -0.0012, "-0.019 [-0.039, -0.001]"),
            (0.0, 0.0, 0.03, "0.000 [0.000, 0.030]"),
            (-0.001, -0.002, 18.0, "0 [0, 18]"),
            (0.0, 0.0, 0.0, "0"),
            (1.42, 1.42, 1.42, "1.42"),
            (3e-9, 1e-9, 4e-9, "0.0000000030 [0.0000000010, 0.0000000040]"),
            (18.149, 14.3, 22.0, "18 [14, 22]"),
            (40.52, 38.37, 42.75, "40.5 [38.4, 42.8]"),
            (1016.51, 653.88, 1379.13, "1017 [654, 1379]"),
            (99.4321, 99.4318, 99.4323, "99.43210 [99.43180, 99.43230]"),
            (f64::INFINITY, 1.0, f64::INFINITY, "inf [1.00, inf]"),
        ] {
            let estimate = Estimate { interval: Some([low, high]), ..Estimate::bare(value, "", 1) };
            assert_eq!(short(&estimate), text);
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
