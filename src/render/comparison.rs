//! Comparisons as text, Markdown, comma-separated values and a figure.

use super::RenderError;
use super::chart::marks::Line;
use super::chart::rows::Interval;
use super::chart::{Axis, Panel, Sheet};
use super::prose;
use super::style::{INK, Stroke, Width, series_color, series_marker};
use super::vector::{Figure, Provenance};
use crate::analysis::compare::{Cell, Change, Comparison, Measured, Outcome, Passed};
use study::store::quoted;

/// A table of texts, to be written in several ways.
struct Table {
    title: String,
    head: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

/// What only CSV has room for: all of a change, number by number.
const CHANGES: &str = "study,contender,metric,unit,better,pairs,first_only,second_only,instances,mean_first,mean_second,\
mean_change,mean_change_low,mean_change_high,mean_change_percent,mean_change_percent_low,mean_change_percent_high,\
median_change,median_change_low,median_change_high,improvement_percent,improvement_percent_low,improvement_percent_high,\
wins,ties,losses,word\n";

const CELLS: &str = "study,interpretation,group,contender,sweep,metric,unit,trials,solved,instances,measured,mean,mean_low,mean_high,\
median,median_low,median_high\n";

/// The comparison as aligned text.
pub fn text(of: &Comparison) -> String {
    let aligned = |table: &Table| {
        let cells = |column: usize| table.rows.iter().map(move |row| row[column].chars().count());
        let widths: Vec<usize> = (0..table.head.len())
            .map(|column| cells(column).max().unwrap_or(0).max(table.head[column].chars().count()))
            .collect();
        let line = |cells: &mut dyn Iterator<Item = &str>| {
            let cells = cells.zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
            format!("  {}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
        };
        let rows: String = table.rows.iter().map(|row| line(&mut row.iter().map(String::as_str))).collect();
        format!("{}\n{}{rows}", table.title, line(&mut table.head.iter().copied()))
    };
    written(of, aligned, "")
}

/// The comparison as Markdown.
pub fn markdown(of: &Comparison) -> String {
    let tabled = |table: &Table| {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let head = line(table.head.iter().map(|name| (*name).to_owned()).collect());
        let rule = line(vec!["---".to_owned(); table.head.len()]);
        let escaped = |row: &Vec<String>| line(row.iter().map(|cell| prose::markdown(cell)).collect());
        format!("### {}\n\n{head}{rule}{}", table.title, table.rows.iter().map(escaped).collect::<String>())
    };
    written(of, tabled, "- ")
}

/// The changes as comma-separated values under a head; what is not known is empty.
pub fn csv(of: &Comparison) -> String {
    let line = |change: &Change| {
        let texts = [&change.study, &change.contender, &change.metric, &change.unit, &change.better];
        let [first, second] = change.one_sided;
        let counts = [change.pairs, first, second, change.instances].map(|n| n.to_string());
        let means = change.means.map_or([None, None], |means| means.map(Some)).map(plain);
        let numbers = [
            change.mean_change,
            change.mean_change_percent,
            change.median_change,
            change.improvement_percent,
        ];
        let signs = [change.wins, change.ties, change.losses].map(|n| n.to_string());
        let numbers = means.into_iter().chain(numbers.into_iter().flat_map(measured));
        let rest = counts.into_iter().chain(numbers).chain(signs).chain([change.word.name().to_owned()]);
        texts.map(|text| quoted(text)).into_iter().chain(rest).collect::<Vec<_>>().join(",") + "\n"
    };
    CHANGES.to_owned() + &of.changes.iter().map(line).collect::<String>()
}

/// What trials come to as comma-separated values under a head.
pub fn cells_csv(cells: &[Cell]) -> String {
    let line = |cell: &Cell| {
        let texts = [
            &cell.study,
            &cell.interpretation,
            &cell.group,
            &cell.contender,
            &cell.sweep,
            &cell.metric,
            &cell.unit,
        ];
        let counts = [cell.trials, cell.solved, cell.instances, cell.measured].map(|n| n.to_string());
        let rest = counts.into_iter().chain([cell.mean, cell.median].into_iter().flat_map(measured));
        texts.map(|text| quoted(text)).into_iter().chain(rest).collect::<Vec<_>>().join(",") + "\n"
    };
    CELLS.to_owned() + &cells.iter().map(line).collect::<String>()
}

/// A number and the ends of its interval, each as [`plain`] has it.
fn measured(of: Option<Measured>) -> [String; 3] {
    let ends = of.and_then(|of| of.interval);
    [of.map(|of| of.value), ends.map(|ends| ends[0]), ends.map(|ends| ends[1])].map(plain)
}

/// What a gate says, in a line.
pub fn gate_line(of: &Passed) -> String {
    let unit = if of.gate.ends_with('%') { " %" } else { "" };
    let change = of.change.map_or_else(String::new, |change| format!("; {}{unit}", with_interval(change)));
    let outcome = match (of.outcome, of.more_instances, &of.why) {
        (Outcome::Worse, ..) => "worse".to_owned(),
        (Outcome::NotWorse, ..) => "not worse".to_owned(),
        (Outcome::CannotTell, Some(more), _) => format!("cannot tell: about {more} more instances"),
        (Outcome::CannotTell, None, why) => {
            format!("cannot tell: {}", why.as_deref().unwrap_or("at the margin"))
        }
    };
    format!("gate {}: {}: {}: {outcome}{change}", of.gate, of.study, of.contender)
}

/// The changes of the means in per cent, and how probable an improvement is, each with its interval, study by study.
///
/// # Errors
/// [`RenderError::NotStored`] if nothing was paired; those of drawing.
pub fn figure(of: &Comparison, from: &Provenance) -> Result<Figure, RenderError> {
    let mut studies: Vec<&str> = of.changes.iter().map(|change| change.study.as_str()).collect();
    studies.dedup();
    if studies.is_empty() {
        return Err(RenderError::NotStored { what: "a pair of trials with one key".to_owned() });
    }
    let most = studies.iter().map(|study| of.changes.iter().filter(|c| c.study == **study).count()).max();
    let mut sheet = Sheet::new(Width::Double, 2, (most.unwrap_or(1) as f64 * 13.0).max(60.0)).level();
    for study in studies {
        let changes: Vec<&Change> = of.changes.iter().filter(|change| change.study == study).collect();
        let names = changes.iter().map(|change| format!("{}: {}", change.contender, change.metric));
        let percent = |change: &Change| match change.metric.as_str() {
            crate::analysis::compare::SOLVED => change.mean_change,
            _ => change.mean_change_percent,
        };
        let title = format!("{study}: change of the mean");
        sheet.add(panel(&title, "change (%; solved: points)", names.collect(), &changes, percent, 0.0));
        let bare = vec![String::new(); changes.len()];
        let title = format!("{study}: probability of improvement");
        sheet.add(panel(
            &title,
            "probability (%)",
            bare,
            &changes,
            |change| change.improvement_percent,
            50.0,
        ));
    }
    let note = format!("From {} to {}; 95 % intervals over instances.", of.sides[0], of.sides[1]);
    sheet.noted(note).draw(from)
}

fn panel(
    title: &str,
    axis: &str,
    names: Vec<String>,
    changes: &[&Change],
    of: impl Fn(&Change) -> Option<Measured>,
    still: f64,
) -> Panel {
    let found: Vec<Option<Measured>> = changes.iter().map(|change| of(change)).collect();
    let ends =
        found.iter().flatten().flat_map(|found| found.interval.into_iter().flatten().chain([found.value]));
    let axis = Axis::over(axis, ends.chain([still]));
    let mut panel = Panel::new(title, axis, Axis::names("", names).reversed());
    panel.add(Line::through(
        vec![[still, -0.5], [still, changes.len() as f64 - 0.5]],
        Stroke::solid(INK, 0.6),
    ));
    for (row, found) in found.iter().enumerate() {
        let Some(found) = found else { continue };
        let [low, high] = found.interval.unwrap_or([found.value; 2]);
        panel.add(Interval {
            row: row as f64,
            values: [low, found.value, high],
            marker: series_marker(0),
            color: series_color(0),
            label: String::new(),
        });
    }
    panel
}

/// All of a comparison, table by table as `table` writes one, with `bullet` before each line that stands alone.
fn written(of: &Comparison, table: impl Fn(&Table) -> String, bullet: &str) -> String {
    let mut parts = vec![format!("From {} to {}\n", of.sides[0], of.sides[1])];
    let lines = |lines: &mut dyn Iterator<Item = String>| {
        lines.fold(String::new(), |text, line| text + bullet + &line + "\n")
    };
    parts.push(lines(&mut of.notes.iter().cloned()));
    parts.extend([solved(of), changes(of)].iter().filter(|table| !table.rows.is_empty()).map(&table));
    parts.extend([only(of)].iter().filter(|table| !table.rows.is_empty()).map(&table));
    parts.push(lines(&mut of.gates.iter().map(gate_line)));
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

fn solved(of: &Comparison) -> Table {
    let row = |solved: &crate::analysis::compare::Solved| {
        let counts =
            [solved.both, solved.first_only, solved.second_only, solved.neither].map(|n| n.to_string());
        let lost = solved.lost.clone().unwrap_or_default();
        [solved.study.clone(), solved.contender.clone()].into_iter().chain(counts).chain([lost]).collect()
    };
    Table {
        title: "Problems solved".to_owned(),
        head: vec![
            "study",
            "contender",
            "by both",
            "by the first",
            "by the second",
            "by neither",
            "first one lost",
        ],
        rows: of.solved.iter().map(row).collect(),
    }
}

fn changes(of: &Comparison) -> Table {
    let shown = |measured: Option<Measured>| measured.map_or_else(|| "–".to_owned(), with_interval);
    let row = |change: &Change| {
        let [first, second] =
            change.means.map_or(["–".to_owned(), "–".to_owned()], |means| means.map(short));
        let unit = if change.unit.is_empty() { String::new() } else { format!(" ({})", change.unit) };
        vec![
            change.study.clone(),
            change.contender.clone(),
            format!("{}{unit}", change.metric),
            format!("{} / {}", change.pairs, change.instances),
            first,
            second,
            shown(change.mean_change),
            shown(change.mean_change_percent),
            shown(change.median_change),
            shown(change.improvement_percent),
            format!("{} / {} / {}", change.wins, change.ties, change.losses),
            change.word.name().to_owned(),
        ]
    };
    Table {
        title: "Changes, with 95 % intervals over instances".to_owned(),
        head: vec![
            "study",
            "contender",
            "metric",
            "pairs / instances",
            "mean before",
            "after",
            "change",
            "change, %",
            "median change",
            "improvement, %",
            "better / equal / worse",
            "is",
        ],
        rows: of.changes.iter().map(row).collect(),
    }
}

fn only(of: &Comparison) -> Table {
    let row = |only: &crate::analysis::compare::Only| {
        vec![of.sides[only.side].clone(), only.study.clone(), only.what.clone(), only.trials.to_string()]
    };
    Table {
        title: "What one side alone has".to_owned(),
        head: vec!["side", "study", "what", "trials"],
        rows: of.only.iter().map(row).collect(),
    }
}

fn with_interval(of: Measured) -> String {
    let interval =
        of.interval.map_or_else(String::new, |[low, high]| format!(" [{}, {}]", short(low), short(high)));
    short(of.value) + &interval
}

/// A number with four digits that count; whole numbers whole.
fn short(value: f64) -> String {
    if !value.is_finite() {
        return if value > 0.0 { "∞".to_owned() } else { "-∞".to_owned() };
    }
    let value = if value == 0.0 { 0.0 } else { value };
    if value.fract() == 0.0 && value.abs() < 1e9 {
        return format!("{value}");
    }
    let whole = if value.abs() < 1.0 { 0 } else { libm::log10(value.abs()).floor() as usize + 1 };
    let decimals = 4_usize.saturating_sub(whole.max(1));
    let text = format!("{value:.decimals$}");
    if text.trim_start_matches('-').bytes().all(|byte| b"0.".contains(&byte)) {
        format!("{value:.1e}")
    } else {
        text
    }
}

/// A number with all of its digits; nothing if it is not known.
fn plain(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}
