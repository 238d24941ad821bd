//! The report: an overview with a line a paper, and one chapter a paper between markers, so that each is generated alone.

mod chapter;
mod chapters;
mod details;
mod interpretations;
mod replies;

pub use chapter::{Chapter, Page, unread};
pub use interpretations::across_lines;

use super::prose::{COLUMNS, markdown, wrapped};
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::Column;
use base::text::shown;
use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use study::StudyError;
use study::paper::{Paper, PrintedTable};
use study::store::write_whole;

/// A figure that could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Undrawn {
    /// Its id.
    pub id: String,
    /// Why, with its study.
    pub why: String,
}

/// The parts of the details with their anchors.
const SECTIONS: [(&str, &str); 7] = [
    ("Claims", "claims"),
    ("What holds together", "together"),
    ("Interpretations", "interpretations"),
    ("Changes after a run", "changes"),
    ("Further figures and tables", "figures"),
    ("Inventory", "inventory"),
    ("Studies", "studies"),
];

const OPENING: &str = "# What the papers claim and what we found

Each paper has a chapter below. [README](README.md) explains the words of a verdict. Counts such as 50/0/9 for/open/against are
of interpretations: 50 agree with the claim, 0 cannot tell and 9 contradict it. `replan repro PAPER` writes what stands
between the markers.
";

/// The heading of the table of counts, behind what was found in each paper.
const ALL: &str = "### All claims";

/// What that table counts.
const COUNTED: &str = "How many sentences and table rows of each paper have which verdict.";

/// The name of the overview among the chapters: it sorts before the name of any paper.
const OVERVIEW: &str = "! overview";

/// The report at `path`; empty if there is none.
///
/// # Errors
/// [`StudyError::Io`] if it cannot be read, [`StudyError::Touched`] if it is not UTF-8 text.
pub fn read(path: &Path) -> Result<String, StudyError> {
    let bytes = match fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(String::new()),
        read => read.map_err(StudyError::io(path, "reading the report"))?,
    };
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        touched(path, &format!("byte {at} is not UTF-8"))
    })
}

/// The message about the report at `path` in which something stands that `replan` did not write there.
fn touched(path: &Path, what: &str) -> StudyError {
    let aside = "mend it, move it away, or write elsewhere with --out";
    StudyError::Touched(format!("{}: {what}; {aside}", path.display()))
}

/// `report`, read from `path`, with the chapter of the paper `name` and its entry of the overview in their places.
/// Everything else stays as it is.
///
/// # Errors
/// [`StudyError::Touched`] with the line if the markers of its chapters do not pair up.
pub fn with_chapter(path: &Path, report: &str, name: &str, chapter: &Chapter) -> Result<String, StudyError> {
    let put = || {
        let overview = overview(chapters::chapter(report, OVERVIEW)?, name, chapter);
        let report = chapters::with_chapter(report, OPENING, OVERVIEW, &overview)?;
        chapters::with_chapter(&report, OPENING, name, &shown(&chapter.text))
    };
    put().map_err(|error: chapters::MarkerError| touched(path, &error.to_string()))
}

/// Puts a paper's chapter into the report at `path`. The file `lock` keeps other runs from changing the report
/// meanwhile.
///
/// # Errors
/// As [`read`] and [`with_chapter`]; the report is as it was then.
pub fn put_chapter(path: &Path, lock: &Path, name: &str, chapter: &Chapter) -> Result<(), StudyError> {
    let folder = lock.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder).map_err(StudyError::io(folder, "creating the folder"))?;
    let held = fs::File::create(lock).and_then(|file| file.lock().map(|()| file));
    let _held = held.map_err(StudyError::io(lock, "locking the report"))?;
    write_whole(path, with_chapter(path, &read(path)?, name, chapter)?.as_bytes())
}

/// What the report at `path` says besides the chapter called `name`.
///
/// # Errors
/// As [`read`] and [`with_chapter`].
pub fn besides(path: &Path, name: &str) -> Result<String, StudyError> {
    let text = chapters::without_chapter(&read(path)?, name);
    text.map_err(|error| touched(path, &error.to_string()))
}

/// The overview, `before` its former text, with what was found in the paper `name`.
fn overview(before: &str, name: &str, chapter: &Chapter) -> String {
    let (found, rows) = before.split_once(ALL).unwrap_or((before, ""));
    let parts = found.split("### [").skip(1).filter_map(|part| Some((part.split_once(']')?.0, part.trim())));
    let mut found: BTreeMap<&str, &str> = parts.collect();
    let [own, row] = [&chapter.found, &chapter.row].map(|text| shown(text));
    found.insert(name, own.trim().trim_start_matches("### ["));
    let found: Vec<String> = found.into_values().map(|part| format!("### [{part}\n\n")).collect();
    let found = found.concat();
    let begin = begin_of_row(name);
    let is_row = |line: &&str| line.starts_with("| [") && !line.starts_with(&begin);
    let mut rows: Vec<&str> = rows.lines().filter(is_row).chain([&*row]).collect();
    rows.sort_unstable();
    let columns = Column::ALL.map(Column::name);
    let rule = "---:|".repeat(columns.len());
    let rows = rows.join("\n");
    format!("{found}{ALL}\n\n{COUNTED}\n\n| paper | {} |\n|---|{rule}\n{rows}", columns.join(" | "))
}

/// How the row of the paper `name` begins: with a link to its chapter.
fn begin_of_row(name: &str) -> String {
    format!("| [`{name}`](#{}) |", anchor(name))
}

/// The anchor of `name` in links.
pub fn anchor(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || "._-".contains(c) { c } else { '-' }).collect()
}

/// A place that links lead to.
fn place(name: &str) -> String {
    format!("<a id=\"{}\"></a>", anchor(name))
}

/// `text` as Markdown, in which claims of `verdicts` that are named as code lead to their evidence in the file `details`.
fn linked(text: &str, verdicts: &Verdicts, details: &str) -> String {
    let safe = markdown(text);
    let pieces: Vec<&str> = safe.split('`').collect();
    if pieces.len().is_multiple_of(2) {
        return safe;
    }
    let piece = |(at, piece): (usize, &&str)| match (at % 2, verdicts.claim(piece)) {
        (0, _) => (*piece).to_owned(),
        (_, Some(judged)) => link(judged, &format!("`{piece}`"), details),
        (_, None) => format!("`{piece}`"),
    };
    pieces.iter().enumerate().map(piece).collect()
}

/// A link from `words` to the evidence of a claim in the file `details`.
fn link(judged: &ClaimVerdict, words: &str, details: &str) -> String {
    format!("[{words}]({details}#{})", anchor(&judged.claim))
}

/// Links to the evidence of `claims` within the details.
fn links(claims: &[impl AsRef<str>]) -> String {
    let link = |claim: &str| format!("[`{claim}`](#{})", anchor(claim));
    claims.iter().map(|claim| link(claim.as_ref())).collect::<Vec<_>>().join(", ")
}

/// A paragraph, its text shown as it is.
fn paragraph(text: &str) -> String {
    wrapped("", &markdown(text), 0, COLUMNS) + "\n\n"
}

/// Whether the chapter shows one of the paper's own tables; the details show the others.
fn is_in_chapter(paper: &Paper, table: &PrintedTable) -> bool {
    let is_left = paper.report.in_details.iter().any(|id| *id.get_ref() == table.id);
    table.has_claims() && !table.compares && !is_left
}

/// A table in Markdown between its caption and its notes.
fn with_caption(table: &PrintedTable, markdown: &str) -> String {
    let notes = if table.notes.is_empty() { String::new() } else { paragraph(&table.notes.join(" ")) };
    format!("{}{markdown}\n{notes}", paragraph(&table.caption))
}

/// An item of a list, its text taken as Markdown.
fn item(depth: usize, text: &str) -> String {
    let indent = 2 * depth;
    wrapped(&format!("{}- ", " ".repeat(indent)), text, indent + 2, COLUMNS) + "\n"
}
