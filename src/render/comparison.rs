//! Comparisons as text, Markdown and comma-separated values.

use super::prose;
use crate::analysis::compare::{Cell, Change, Comparison, Measured, Outcome, Passed, SOLVED, Solved, Word};
use study::store::quoted;

/// A table of texts.
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

/// What the words of a comparison mean.
const WORDS: [&str; 3] = [
    "Change: of the mean over pairs that both sides solved, with its 95 % interval over instances.",
    "Better, equal, worse: pairs in which the second side is better, neither is, or the first is.",
    "Verdict: better or worse where the interval excludes no change; open where it holds it, or instances are too few.",
];

/// The comparison as text of at most so many columns, a block a contender.
pub fn text(comparison: &Comparison, columns: usize) -> String {
    let paragraph = |text: &str| prose::plain("", text, 2, columns) + "\n";
    let mut parts = vec![paragraph(&format!("From {} to {}", comparison.sides[0], comparison.sides[1]))];
    parts.push(comparison.notes.iter().map(|note| paragraph(note)).collect());
    parts.extend(comparison.solved.iter().map(|solved| block(comparison, solved, columns)));
    let only = comparison.only.iter().map(|only| {
        let side = &comparison.sides[only.side];
        paragraph(&format!("only in {side}: {}: {}, {} trials", only.study, only.what, only.trials))
    });
    parts.push(only.collect());
    parts.push(comparison.gates.iter().map(|gate| paragraph(&gate_line(gate))).collect());
    if !comparison.changes.is_empty() {
        parts.push(WORDS.iter().map(|word| paragraph(word)).collect());
    }
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

/// What has changed of one contender: how many problems are solved, a line a metric that differs, and those that are equal.
fn block(comparison: &Comparison, solved: &Solved, columns: usize) -> String {
    let mut text = prose::plain("", &format!("{}: {}", solved.study, solved.contender), 2, columns) + "\n";
    let lost = solved.lost.as_ref().map_or_else(String::new, |lost| format!(", as {lost}"));
    let counts = format!(
        "solved by both {}, by the first alone {}{lost}, by the second alone {}, by neither {}",
        solved.both, solved.first_only, solved.second_only, solved.neither
    );
    text += &(prose::plain("  ", &counts, 4, columns) + "\n");
    let own = |change: &&Change| change.study == solved.study && change.contender == solved.contender;
    let (equal, other): (Vec<&Change>, Vec<&Change>) =
        comparison.changes.iter().filter(own).partition(|change| change.word == Word::Equal);
    if !other.is_empty() {
        let head =
            ["metric", "before", "after", "change", "better/equal/worse", "verdict"].map(str::to_owned);
        let rows: Vec<[String; 6]> = [head].into_iter().chain(other.into_iter().map(cells)).collect();
        let lines = prose::columns(&rows, [20, 8, 8, 26, 18, 8]);
        text.extend(lines.iter().map(|line| format!("  {line}")));
    }
    if !equal.is_empty() {
        let names: Vec<&str> = equal.iter().map(|change| change.metric.as_str()).collect();
        text += &(prose::plain("  equal in every pair: ", &names.join(", "), 4, columns) + "\n");
    }
    text
}

/// A change in the columns of a terminal.
fn cells(change: &Change) -> [String; 6] {
    let dash = || "–".to_owned();
    let [before, after] = change.means.map_or_else(|| [dash(), dash()], |means| means.map(short));
    let unit = if change.metric == SOLVED { "points" } else { change.unit.as_str() };
    let percent = change.mean_change_percent.filter(|_| change.metric != SOLVED).map(|change| (change, "%"));
    let of_mean = percent.or(change.mean_change.map(|change| (change, unit)));
    let of_mean = of_mean.map_or_else(dash, |(change, unit)| format!("{} {unit}", to_interval(change)));
    let pairs = format!("{}/{}/{}", change.wins, change.ties, change.losses);
    let word = change.word.name().to_owned();
    [change.metric.clone(), before, after, of_mean.trim_end().to_owned(), pairs, word]
}

/// A change and its interval with the digits that the interval leaves certain.
fn to_interval(number: Measured) -> String {
    let ends = number.interval.filter(|[low, high]| low.is_finite() && high.is_finite() && low < high);
    let Some([low, high]) = ends else { return with_interval(number) };
    let decimals = (1.0 - libm::log10((high - low) / 2.0).floor()).clamp(0.0, 6.0) as usize;
    format!("{:+.decimals$} [{low:.decimals$}, {high:.decimals$}]", number.value)
}

/// The comparison as Markdown.
pub fn markdown(comparison: &Comparison) -> String {
    let lines = |lines: &mut dyn Iterator<Item = String>| {
        lines.fold(String::new(), |text, line| format!("{text}- {line}\n"))
    };
    let mut parts = vec![format!("From {} to {}\n", comparison.sides[0], comparison.sides[1])];
    parts.push(lines(&mut comparison.notes.iter().cloned()));
    parts.extend(
        [solved(comparison), changes(comparison), only(comparison)]
            .iter()
            .filter(|table| !table.rows.is_empty())
            .map(tabled),
    );
    parts.push(lines(&mut comparison.gates.iter().map(gate_line)));
    parts.push(lines(&mut WORDS.map(str::to_owned).into_iter()));
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

/// A table in Markdown.
fn tabled(table: &Table) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let head = line(table.head.iter().map(|name| (*name).to_owned()).collect());
    let rule = line(vec!["---".to_owned(); table.head.len()]);
    let escaped = |row: &Vec<String>| line(row.iter().map(|cell| prose::markdown(cell)).collect());
    format!("### {}\n\n{head}{rule}{}", table.title, table.rows.iter().map(escaped).collect::<String>())
}

/// The changes as comma-separated values under a head; what is not known is empty.
pub fn csv(comparison: &Comparison) -> String {
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
    CHANGES.to_owned() + &comparison.changes.iter().map(line).collect::<String>()
}

/// Statistics of trials as comma-separated values under a line of heads.
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
fn measured(number: Option<Measured>) -> [String; 3] {
    let ends = number.and_then(|number| number.interval);
    [number.map(|number| number.value), ends.map(|ends| ends[0]), ends.map(|ends| ends[1])].map(plain)
}

/// What a gate says, in a line.
pub fn gate_line(passed: &Passed) -> String {
    let unit = if passed.gate.ends_with('%') { " %" } else { "" };
    let change =
        passed.change.map_or_else(String::new, |change| format!("; {}{unit}", with_interval(change)));
    let outcome = match (passed.outcome, passed.more_instances, &passed.why) {
        (Outcome::Worse, ..) => "worse".to_owned(),
        (Outcome::NotWorse, ..) => "not worse".to_owned(),
        (Outcome::CannotTell, Some(more), _) => format!("cannot tell: about {more} more instances"),
        (Outcome::CannotTell, None, why) => {
            format!("cannot tell: {}", why.as_deref().unwrap_or("at the margin"))
        }
    };
    format!("gate {}: {}: {}: {outcome}{change}", passed.gate, passed.study, passed.contender)
}

fn solved(comparison: &Comparison) -> Table {
    let row = |solved: &Solved| {
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
        rows: comparison.solved.iter().map(row).collect(),
    }
}

fn changes(comparison: &Comparison) -> Table {
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
            "second better, %",
            "better / equal / worse",
            "verdict",
        ],
        rows: comparison.changes.iter().map(row).collect(),
    }
}

fn only(comparison: &Comparison) -> Table {
    let row = |only: &crate::analysis::compare::Only| {
        vec![
            comparison.sides[only.side].clone(),
            only.study.clone(),
            only.what.clone(),
            only.trials.to_string(),
        ]
    };
    Table {
        title: "What one side alone has".to_owned(),
        head: vec!["side", "study", "what", "trials"],
        rows: comparison.only.iter().map(row).collect(),
    }
}

fn with_interval(number: Measured) -> String {
    let interval =
        number.interval.map_or_else(String::new, |[low, high]| format!(" [{}, {}]", short(low), short(high)));
    short(number.value) + &interval
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
