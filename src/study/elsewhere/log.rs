//! OMPL's benchmark log as a table: one row a run, its planner and its number before its properties.
//!
//! # Source
//! OMPL, `src/ompl/tools/benchmark/src/Benchmark.cpp`, `saveResultsToStream`, versions 1.0 to 2.0.

use super::table::{Table, bytes};
use crate::error::StudyError;
use crate::record::Status;
use base::text::decoded;
use std::collections::BTreeMap;
use std::path::Path;

/// A log as it was read.
#[derive(Debug)]
pub struct Log {
    /// Its runs.
    pub table: Table,
    /// The experiment's name in the log's head.
    pub experiment: String,
    /// By our status the numbers that mean it.
    pub statuses: BTreeMap<String, Vec<String>>,
}

/// What OMPL calls its statuses, and what they are here. A solution that misses its goal is none.
const STATUSES: [(&str, Status); 10] = [
    ("Unknown status", Status::Crashed),
    ("Invalid start", Status::InvalidProblem),
    ("Invalid goal", Status::InvalidProblem),
    ("Unrecognized goal type", Status::InvalidProblem),
    ("Timeout", Status::TimeSpent),
    ("Approximate solution", Status::TimeSpent),
    ("Exact solution", Status::Solved),
    ("Crash", Status::Crashed),
    ("Abort", Status::Crashed),
    ("Infeasible", Status::NoPath),
];

/// Lines with their numbers.
struct Lines<'t> {
    left: std::iter::Enumerate<std::str::Lines<'t>>,
    at: usize,
}

impl<'t> Lines<'t> {
    fn next(&mut self, wanted: &str) -> Result<&'t str, String> {
        let (at, line) = self
            .left
            .next()
            .ok_or_else(|| format!("line {}: the log ends where {wanted} is expected", self.at + 1))?;
        self.at = at + 1;
        Ok(line)
    }

    fn wrong(&self, line: &str, wanted: &str) -> String {
        format!("line {}: `{}` stands where {wanted} is expected", self.at, base::text::brief(line))
    }

    /// The count at the beginning of a line that ends in `words`.
    fn count(&mut self, words: &str) -> Result<usize, String> {
        let wanted = format!("`N {words}`");
        let line = self.next(&wanted)?;
        let count = line.strip_suffix(words).and_then(|count| count.trim().parse().ok());
        count.ok_or_else(|| self.wrong(line, &wanted))
    }

    /// Skips to the line behind the first that ends in `words`, and gives what stands before them.
    fn skip_to(&mut self, words: &str) -> Result<&'t str, String> {
        loop {
            let line = self.next(&format!("`{words}`"))?;
            if let Some(before) = line.strip_suffix(words) {
                return Ok(before.trim());
            }
        }
    }
}

/// Reads the log at `path`.
///
/// # Errors
/// A file that cannot be read, is no such log, or is cut off: the line, and what was expected there.
pub fn read_log(path: &Path) -> Result<Log, StudyError> {
    let bytes = bytes(path)?;
    let mut table = Table::new(path, &bytes, "line");
    let text = decoded(bytes).map_err(|what| table.error(&what))?;
    let mut lines = Lines { left: text.lines().enumerate(), at: 0 };
    match parse(&mut lines, &mut table) {
        Ok((experiment, statuses)) => Ok(Log { table, experiment, statuses }),
        Err(message) => Err(table.error(&message)),
    }
}

type Statuses = BTreeMap<String, Vec<String>>;

fn parse(lines: &mut Lines<'_>, table: &mut Table) -> Result<(String, Statuses), String> {
    let first = lines.next("`Experiment NAME`")?;
    let named = if first.contains(" version ") { lines.next("`Experiment NAME`")? } else { first };
    let experiment =
        named.strip_prefix("Experiment ").ok_or_else(|| lines.wrong(named, "`Experiment NAME`"))?;
    lines.skip_to("seconds spent to collect the data")?;
    let mut statuses = Statuses::new();
    let planners = loop {
        let line = lines.next("`N planners`")?;
        if let Some(count) = line.strip_suffix(" planners") {
            break count.parse::<usize>().map_err(|_| lines.wrong(line, "`N planners`"))?;
        }
        if let Some(named) = line.strip_prefix("status|") {
            for (number, name) in named.split('|').enumerate() {
                let known = STATUSES.iter().find(|(known, _)| *known == name).map(|(_, status)| *status);
                let status = known.unwrap_or(Status::Crashed);
                statuses.entry(status.name().to_owned()).or_default().push(number.to_string());
            }
        }
    };
    if statuses.is_empty() {
        return Err(format!(
            "line {}: no `status|…` names the statuses; logs of OMPL 1.0 and later have one",
            lines.at
        ));
    }
    let mut heads = vec!["planner".to_owned(), "run".to_owned()];
    let mut runs: Vec<(usize, BTreeMap<String, String>)> = Vec::new();
    for _ in 0..planners {
        planner(lines, &mut heads, &mut runs)?;
    }
    table.rows = runs
        .into_iter()
        .map(|(line, run)| {
            (line, heads.iter().map(|head| run.get(head).cloned().unwrap_or_default()).collect())
        })
        .collect();
    table.heads = heads;
    if table.rows.is_empty() {
        Err("holds no run".to_owned())
    } else {
        Ok((experiment.trim().to_owned(), statuses))
    }
}

/// The runs of one planner.
fn planner(
    lines: &mut Lines<'_>,
    heads: &mut Vec<String>,
    runs: &mut Vec<(usize, BTreeMap<String, String>)>,
) -> Result<(), String> {
    let name = lines.next("a planner's name")?.to_owned();
    for _ in 0..lines.count("common properties")? {
        lines.next("a common property")?;
    }
    let mut properties = Vec::new();
    for _ in 0..lines.count("properties for each run")? {
        let line = lines.next("a property with its type")?;
        let (property, _) =
            line.rsplit_once(' ').ok_or_else(|| lines.wrong(line, "a property with its type"))?;
        properties.push(property.to_owned());
        if !heads.iter().any(|head| head == property) {
            heads.push(property.to_owned());
        }
    }
    for number in 0..lines.count("runs")? {
        let line = lines.next("a run")?;
        let mut cells: Vec<&str> = line.split(';').map(str::trim).collect();
        cells.pop();
        if cells.len() != properties.len() {
            let wanted = format!("a run with {} values, each before a `;`,", properties.len());
            return Err(lines.wrong(line, &wanted));
        }
        let mut run: BTreeMap<String, String> =
            properties.iter().cloned().zip(cells.into_iter().map(str::to_owned)).collect();
        run.insert("planner".to_owned(), name.clone());
        run.insert("run".to_owned(), number.to_string());
        runs.push((lines.at, run));
    }
    // Progress over time may stand before the full stop.
    lines.skip_to(".").map(drop)
}
