//! The report: one chapter a paper, between markers, so that each is generated alone.

mod chapters;

use super::tables::short;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::{Counts, Finding, Judged, Together, Verdicts};
use crate::study::StudyError;
use crate::study::paper::Paper;
use crate::study::store::write_whole;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// A figure that could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Undrawn {
    /// Its id.
    pub id: String,
    /// Why, with its study.
    pub why: String,
}

const OPENING: &str = "# What the papers claim and what we found

Every chapter stands between markers and is written by a command; do not edit it by hand. `cargo run -- repro <paper>` writes a
paper's chapter, and `cargo run -- render <paper> --check` says whether it is current; `cargo run -- crosscheck <paper>` writes
what MuJoCo says of it, and `crosscheck --check` compares. How to read a verdict stands in README.md.
";

/// The report at `path`; empty if there is none.
///
/// # Errors
/// [`StudyError::Io`] if it cannot be read, [`StudyError::Stored`] if it is not UTF-8 text.
pub fn read(path: &Path) -> Result<String, StudyError> {
    let bytes = match fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(String::new()),
        read => read.map_err(StudyError::io(path, "reading the report"))?,
    };
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        StudyError::stored(path, format!("byte {at} is not UTF-8; {ASIDE}"))
    })
}

const ASIDE: &str = "mend it, move it away, or write elsewhere with --out";

/// `report`, read from `path`, with the chapter called `name` in its place; everything else stays as it is.
///
/// # Errors
/// [`StudyError::Stored`] with the line if the markers of its chapters do not pair up.
pub fn with_chapter(path: &Path, report: &str, name: &str, chapter: &str) -> Result<String, StudyError> {
    let text = chapters::with_chapter(report, OPENING, name, chapter);
    text.map_err(|error| StudyError::stored(path, format!("{error}; {ASIDE}")))
}

/// Puts the chapter called `name` into the report at `path`, which no other run changes meanwhile: `lock` is the file by which
/// runs agree on that.
///
/// # Errors
/// As [`read`] and [`with_chapter`]; the report is as it was then.
pub fn put_chapter(path: &Path, lock: &Path, name: &str, chapter: &str) -> Result<(), StudyError> {
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
    text.map_err(|error| StudyError::stored(path, format!("{error}; {ASIDE}")))
}

/// The chapter of the evidence's paper; `plots` is where its figures are, as seen from the report, and `tables` the names of its
/// tables there. A figure that is among `undrawn` is said to be missing where it would stand.
pub fn chapter(
    evidence: &Evidence<'_>,
    verdicts: &Verdicts,
    plots: &Path,
    tables: &[&str],
    undrawn: &[Undrawn],
) -> String {
    let paper = evidence.paper;
    let mut text = String::new();
    heading(&mut text, paper, verdicts);
    counts(&mut text, verdicts);
    claims(&mut text, verdicts);
    together(&mut text, verdicts);
    reasons(&mut text, verdicts);
    results(&mut text, evidence);
    figures(&mut text, paper, plots, tables, undrawn);
    readings(&mut text, paper);
    studies(&mut text, evidence);
    ledger(&mut text, paper);
    text
}

/// Writing to a string cannot fail; this keeps that in one place.
macro_rules! line {
    ($text:expr) => { $text.push('\n') };
    ($text:expr, $($arguments:tt)*) => {{
        let _ = writeln!($text, $($arguments)*);
    }};
}

fn heading(text: &mut String, paper: &Paper, verdicts: &Verdicts) {
    line!(text, "## {}: {}\n", paper.id, paper.source.title);
    let source: Vec<&str> =
        [paper.source.authors.as_deref(), paper.source.published.as_deref()].into_iter().flatten().collect();
    if !source.is_empty() {
        line!(text, "{}\n", source.join(". "));
    }
    line!(text, "Made by `{}`.", verdicts.command);
    let marks = super::marks(paper, verdicts);
    for mark in &marks {
        line!(text, "\n**{mark}**");
    }
    for study in &verdicts.claims_changed_since {
        line!(text, "\n**Claims or margins changed after study `{study}` was run.**");
    }
    for note in &paper.source.notes {
        line!(text, "\n> {note}");
    }
    // Findings were written on the study's own run; of any other they may be false.
    let findings = if marks.is_empty() { &paper.source.findings[..] } else { &[] };
    if !findings.is_empty() {
        line!(text);
    }
    for finding in findings {
        line!(text, "- {}", super::prose::prose(finding, verdicts));
    }
}

fn counts(text: &mut String, verdicts: &Verdicts) {
    let Counts { classes, parts, asserted } = verdicts.counts();
    line!(text, "\n{classes}.");
    for more in parts.into_iter().chain(asserted) {
        line!(text, "{more}.");
    }
}

fn claims(text: &mut String, verdicts: &Verdicts) {
    line!(text, "\n### Claims\n");
    line!(text, "| claim | place in the paper | printed | ours | n | verdict |");
    line!(text, "|---|---|---|---|---|---|");
    for judged in &verdicts.claims {
        let (ours, n) = judged.ours().map_or_else(
            || ("–".to_owned(), "–".to_owned()),
            |ours| (format!("{} ({})", short(ours), ours.what), ours.n.to_string()),
        );
        let (claim, at, said, verdict) = (&judged.claim, &judged.at, said(judged), judged.outcome());
        line!(text, "| `{claim}` | {at} | {said} | {ours} | {n} | **{verdict}** |");
    }
}

/// What the paper says: its number, its own words in quotation marks, or what its words amount to.
fn said(judged: &Judged) -> String {
    let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
    let printed = judged.printed.as_ref().map(|printed| format!("{printed}{unit}"));
    let quoted = judged.quote.as_ref().map(|quote| format!("“{quote}”"));
    printed.or(quoted).or_else(|| judged.says.clone()).unwrap_or_else(|| "–".to_owned())
}

fn together(text: &mut String, verdicts: &Verdicts) {
    if verdicts.together.is_empty() {
        return;
    }
    line!(text, "\n### What holds together\n");
    let count = verdicts.together.len();
    let listed = match count {
        1 => "one set lies within no other; it is listed".to_owned(),
        2..=LISTED_SETS => format!("{count} sets lie within no other; they are listed"),
        _ => format!(
            "of the {count} sets that lie within no other the {LISTED_SETS} largest are listed, and below them the largest of \
             each further reading, if there is one; all stand in `verdicts.toml` beside the stored run"
        ),
    };
    line!(
        text,
        "Claims met exactly under one reading by one choice of contenders, each environment on one map of ours. Every such \
         choice of maps was looked at; {listed}.\n"
    );
    line!(text, "| reading | study and maps | contenders | hold | fail |");
    line!(text, "|---|---|---|---|---|");
    let (first, rest) = verdicts.together.split_at(LISTED_SETS.min(verdicts.together.len()));
    let listed = |claims: &[String]| claims.iter().map(|c| format!("`{c}`")).collect::<Vec<_>>().join(", ");
    let readings = |set: &Together| set.reading.replace(',', ", ");
    for set in first {
        let (reading, hold, fail) = (readings(set), listed(&set.hold), listed(&set.fail));
        line!(text, "| {reading} | {}: {} | {} | {hold} | {fail} |", set.study, set.problem, set.under);
    }
    let mut seen: BTreeSet<&str> = first.iter().map(|set| set.reading.as_str()).collect();
    let further: Vec<&Together> = rest.iter().filter(|set| seen.insert(&set.reading)).collect();
    if !further.is_empty() {
        line!(text);
    }
    for set in further {
        line!(text, "- {} ({}: {}): {}", readings(set), set.study, set.problem, listed(&set.hold));
    }
}

/// How many sets of claims that hold together are listed with those that fail.
const LISTED_SETS: usize = 5;

fn reasons(text: &mut String, verdicts: &Verdicts) {
    line!(text, "\n### Why\n");
    for judged in &verdicts.claims {
        reason(text, judged);
    }
}

/// Reasons longer than this stand one below another.
const LONG: usize = 200;

fn reason(text: &mut String, judged: &Judged) {
    line!(text, "**`{}`** ({}): {}\n", judged.claim, judged.at, judged.outcome());
    if let Some(theorem) = &judged.theorem {
        line!(text, "- it must hold: {theorem}.");
    }
    if let Some(whole) = &judged.part_of {
        line!(text, "- it counts with `{whole}`.");
    }
    if let Some(why) = &judged.changed_after_run {
        line!(text, "- changed after a run: {why}.");
    }
    for finding in &judged.findings {
        if let [first, .., last] = &finding.because[..]
            && first.len() + last.len() > LONG
        {
            line!(text, "- {}:{}", finding.criterion, aside(finding));
            finding.because.iter().for_each(|reason| line!(text, "  - {reason}"));
        } else {
            line!(text, "- {}: {}.{}", finding.criterion, finding.because.join("; "), aside(finding));
        }
        if let Some(settles) = &finding.settles {
            line!(text, "  - what would settle it: {settles}");
        }
        for premise in &finding.premises {
            line!(text, "  - premise: {premise}");
        }
    }
    line!(text);
}

fn aside(finding: &Finding) -> String {
    let verdict = finding.verdict.map_or_else(String::new, |verdict| format!(" *{}*", verdict.name()));
    let trial = finding.trial.as_ref().map_or_else(String::new, |trial| format!(" Trial `{trial}`."));
    verdict + &trial
}

fn results(text: &mut String, evidence: &Evidence<'_>) {
    for table in &evidence.paper.results {
        match super::results::markdown(evidence, table) {
            Ok(table) => line!(text, "{table}"),
            Err(error) => line!(text, "{}: {error}.\n", table.id.get_ref()),
        }
    }
}

fn figures(text: &mut String, paper: &Paper, plots: &Path, tables: &[&str], undrawn: &[Undrawn]) {
    line!(text, "### Figures and tables\n");
    for study in &paper.studies {
        for figure in &study.figures {
            let id = figure.id.get_ref();
            match undrawn.iter().find(|undrawn| undrawn.id == *id) {
                Some(undrawn) => line!(text, "**{id} could not be drawn: {}.**\n", undrawn.why),
                None => line!(text, "![{id}]({}/{id}.png)\n", plots.display()),
            }
            line!(text, "*{id}: {}*\n", figure.caption);
        }
    }
    let tables: Vec<String> = tables.iter().map(|name| format!("`{}/{name}`", plots.display())).collect();
    if !tables.is_empty() {
        line!(text, "Tables in LaTeX: {}.\n", tables.join(", "));
    }
    line!(text, "Every number as a macro of LaTeX: `{}/numbers.tex`.", plots.display());
}

fn readings(text: &mut String, paper: &Paper) {
    let readings = paper.readings();
    if readings.is_empty() {
        return;
    }
    line!(text, "\n### Readings\n");
    line!(text, "| reading | options (default in bold) | what the paper leaves open |");
    line!(text, "|---|---|---|");
    for reading in readings {
        let option =
            |name: &String| if *name == reading.default { format!("**{name}**") } else { name.clone() };
        let options: Vec<String> = reading.options.keys().map(option).collect();
        line!(text, "| {} | {} | {} |", reading.id, options.join(", "), reading.why);
    }
}

fn studies(text: &mut String, evidence: &Evidence<'_>) {
    line!(text, "\n### Studies\n");
    line!(text, "| study | question | trials | seed | spec |");
    line!(text, "|---|---|---|---|---|");
    for run in evidence.runs() {
        line!(
            text,
            "| {} | {} | {} | {} | `{}` |",
            run.study.name,
            run.study.question,
            run.records.batch.rows.len(),
            run.manifest.seed,
            &run.manifest.spec[..12]
        );
    }
    statuses(text, evidence);
}

fn statuses(text: &mut String, evidence: &Evidence<'_>) {
    line!(text, "\n| study | problems | contender | trials by status |");
    line!(text, "|---|---|---|---|");
    for run in evidence.runs() {
        for group in &run.study.groups {
            for contender in &run.study.contenders {
                let rows = run.rows(&group.label, &contender.label);
                let counted = crate::study::record::Status::ALL.iter().filter_map(|status| {
                    let count = rows.iter().filter(|row| row.status == *status).count();
                    (count > 0).then(|| format!("{count} {status}"))
                });
                let counted: Vec<String> = counted.collect();
                line!(
                    text,
                    "| {} | {} | {} | {} |",
                    run.study.name,
                    group.label,
                    contender.label,
                    counted.join(", ")
                );
            }
        }
    }
}

fn ledger(text: &mut String, paper: &Paper) {
    line!(text, "\n### Ledger\n");
    line!(text, "| in the paper | what it says | answered by |");
    line!(text, "|---|---|---|");
    for row in &paper.ledger {
        let mut answers: Vec<String> =
            row.claims.iter().map(|claim| format!("`{}`", claim.get_ref())).collect();
        answers.extend(row.figures.iter().map(|figure| figure.get_ref().clone()));
        answers.extend(row.studies.iter().map(|study| format!("study {}", study.get_ref())));
        answers.extend(row.none.iter().map(|none| format!("nothing: {none}")));
        line!(text, "| {} | {} | {} |", row.item.get_ref(), row.says, answers.join(", "));
    }
}
