//! Whether a row or a column called `Average` or `Total` is the mean or the sum of those that it sums up.
//!
//! Which numbers it sums up is not printed, so every usual choice counts: the rows of its block, all rows above, the summaries
//! above; and of columns those right before it. Only what no choice gives is refused.

use super::arguments::{count, digits, shown_span, spans};
use super::{Entry, FromRelation, Test};
use crate::input::{Input, Relation};
use crate::meaning::{Count, Kind, Meaning};
use crate::reader::unit;
use crate::sample::groups;
use crate::statistic::Statistic;
use crate::table::{Column, Fault, Quoted, Table, named_by, quoted};
use proofs::exact::{Exact, Print, Span, add, div, float, whole};
use std::cell::Cell;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "summary",
    about: "is a row or a column called Average or Total the mean or the sum of those that it sums up?",
    example: "Average 52.0 below 50.0 and 60.0",
    premises: "it sums up the rows above it, or the columns before it; a signal, since other rows may be meant",
    source: "interval arithmetic",
    tests,
    relation: Some(FromRelation {
        keys: &[
            ("value", "The mean or the sum, in quotes: the printed number, or the name of a cell."),
            ("parts", "What it sums up, each in quotes or the name of a cell."),
            ("is", "What it is of them: `mean`, which holds if absent, or `sum`."),
        ],
        build,
    }),
};

/// What a name says that a row or a column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Word {
    Mean,
    /// `Sum`: nothing else.
    Sum,
    /// `Total`: a sum, or where means are printed, perhaps the mean of all.
    Total,
    /// `Overall`: a mean, weighted or not, or a sum.
    Either,
}

impl Word {
    fn is_sum(self) -> bool {
        matches!(self, Self::Sum | Self::Total)
    }
}

/// How a number may follow from others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Mean,
    /// The mean weighted by how many trials are behind each.
    Pooled,
    /// A mean of some weights, or a quotient of sums.
    Between,
    Sum,
    /// The geometric mean, of numbers above 0.
    Geometric,
    /// The harmonic mean, of numbers above 0.
    Harmonic,
}

impl Form {
    fn name(self) -> &'static str {
        match self {
            Self::Mean => "the mean",
            Self::Pooled => "the mean by number of trials",
            Self::Between => "between the least and the greatest",
            Self::Sum => "the sum",
            Self::Geometric => "the geometric mean",
            Self::Harmonic => "the harmonic mean",
        }
    }

    /// The geometric or harmonic mean of numbers of 0 or more, in floats.
    fn mean_of(self, numbers: impl ExactSizeIterator<Item = f64>) -> f64 {
        let count = numbers.len() as f64;
        match self {
            Self::Harmonic => count / numbers.map(|number| 1.0 / number).sum::<f64>(),
            _ => libm::exp(numbers.map(libm::log).sum::<f64>() / count),
        }
    }
}

/// Means that an `Average` may be without its name saying so.
const OTHER_MEANS: [Form; 2] = [Form::Geometric, Form::Harmonic];

/// A span around one that floats work out, wider by more than they lose.
fn around_floats([low, high]: [f64; 2]) -> Option<Span> {
    const SCALE: i64 = 1_000_000_000;
    let scaled = |end: f64| (end.abs() < 1e28).then_some(end * SCALE as f64);
    let [low, high] = [scaled(low * (1.0 - 1e-9))?.floor(), scaled(high * (1.0 + 1e-9))?.ceil()];
    let [low, high] = [low, high].map(|end| Exact::new(end as i128, SCALE.into()));
    Some(Span::closed(low, high))
}

struct Summary {
    /// The number that sums up, then the others.
    numbers: Vec<Quoted>,
    /// What it may sum up, by places in `numbers`.
    choices: Vec<Vec<usize>>,
    forms: Vec<Form>,
    /// How many trials are behind each number; empty if that is not printed.
    weights: Vec<Exact>,
    premise: &'static str,
    /// A number that it sums up and that is not printed, in words.
    gap: Option<String>,
    /// The same of one that may be none: its row may begin a block.
    perhaps_gap: Option<String>,
    /// Whether it sums up counts, which are not rounded.
    of_counts: bool,
    steps: Cell<u64>,
}

/// The most numbers that one is held against.
const MOST: usize = 1000;

/// Words behind a name that make it the mean of some rows alone, or another mean.
const OTHERWISE: [&str; 16] = [
    "w/o", "without", "exclu", "except", "other", "solved", "common", "only", "top", "best", "geo", "harm",
    "weight", "median", "trim", "log",
];

/// What a name says: `Average`, `Avg.`, `Mean (all maps)`, `Total:`, `Overall`.
fn word(name: &str) -> Option<Word> {
    let name = name.to_lowercase();
    if OTHERWISE.iter().any(|word| name.contains(word)) {
        return None;
    }
    let alone = name.split(['(', '[', ':']).next().unwrap_or_default().trim();
    let alone = alone.trim_end_matches(['.', '*', '†', '‡', '§']);
    let start =
        ["of", "over", "across"].iter().find_map(|word| Some(alone.split_once(&format!(" {word} "))?.0));
    let alone = start.unwrap_or(alone).trim();
    match alone.strip_prefix("overall ").unwrap_or(alone) {
        "average" | "averaged" | "averages" | "avg" | "mean" | "means" | "arithmetic mean" | "ø" => {
            Some(Word::Mean)
        }
        "sum" => Some(Word::Sum),
        "total" | "totals" | "grand total" | "subtotal" | "sub-total" => Some(Word::Total),
        "overall" => Some(Word::Either),
        _ => None,
    }
}

/// The cell of a row that says that it sums up others.
pub fn label(table: &Table, row: usize) -> Option<usize> {
    let is_summary = |at: &usize| {
        let cell = &table.rows[row][*at];
        cell.value.is_none() && word(&cell.text).is_some()
    };
    (0..table.rows[row].len()).find(is_summary).filter(|_| table.statistics().is_none())
}

fn labels(table: &Table) -> Vec<Option<usize>> {
    (0..table.rows.len()).map(|row| label(table, row)).collect()
}

fn tests(input: &Input, give: &mut dyn FnMut(Box<dyn Test>)) {
    summaries(input, &mut |_, summary| give(Box::new(summary)));
}

/// Numbers of rows and columns called a total that are a mean of numbers that could be summed up, each at its place.
pub fn totals_that_are_means(input: &Input) -> Vec<Fault> {
    let mut found = Vec::new();
    summaries(input, &mut |word, summary| {
        let Quoted { name, place, cell, .. } = &summary.numbers[0];
        let is_share = cell.is_some_and(|[table, _, column]| {
            matches!(input.tables[table].columns[column].meaning.kind, Kind::Share { .. })
        });
        if !word.is_sum() || is_share || summary.gap.is_some() {
            return;
        }
        let prints: Vec<Print> = summary.numbers.iter().map(|number| number.print).collect();
        let own = prints[0].span();
        let fits = |(form, _, span): (Form, usize, Option<Span>)| span?.meets(&own).then_some(form);
        let forms: Vec<Form> = summary.all(&prints).filter_map(fits).collect();
        if let Some(form) = forms.first().filter(|_| !forms.contains(&Form::Sum)) {
            let message =
                format!("{name}: {} is {} of the others, not their sum", prints[0].printed, form.name());
            found.push(Fault::new(*place, message));
        }
    });
    found
}

/// Gives every number that says that it sums up others, with what its name says.
fn summaries(input: &Input, give: &mut dyn FnMut(Word, Summary)) {
    for (index, table) in input.tables.iter().enumerate().filter(|(_, table)| table.statistics().is_none()) {
        let labels = labels(table);
        let columns = 0..table.columns.len();
        let rows = || 0..table.rows.len();
        for row in rows().filter(|row| labels[*row].is_some()) {
            let of_rows = columns.clone().filter_map(|column| of_row(index, table, &labels, [row, column]));
            of_rows.for_each(|(word, summary)| give(word, summary));
        }
        for column in columns.filter(|column| word(&table.columns[*column].name).is_some()) {
            let of_columns = rows().filter_map(|row| of_column(index, table, row, column));
            of_columns.for_each(|(word, summary)| give(word, summary));
        }
    }
}

/// Whether a cell stands in a row or column of a summary, and is what it says it is.
pub fn is_true(input: &Input, [index, row, column]: [usize; 3]) -> bool {
    let table = &input.tables[index];
    let of_row = || {
        label(table, row)?;
        of_row(index, table, &labels(table), [row, column])
    };
    let holds = |(_, test): (Word, Summary)| {
        let prints: Vec<Print> = test.numbers.iter().map(|number| number.print).collect();
        test.is_possible(&prints) == Some(true)
    };
    table.statistics().is_none()
        && (of_row().is_some_and(holds) || of_column(index, table, row, column).is_some_and(holds))
}

/// The test of a cell in a row that sums up those above; `None` if it sums up nothing that is known.
fn of_row(
    index: usize,
    table: &Table,
    labels: &[Option<usize>],
    [row, column]: [usize; 2],
) -> Option<(Word, Summary)> {
    let own = labels[row]?;
    table.print(row, column)?;
    let word = word(&table.rows[row][own].text)?;
    let mut forms = forms(table, column, word)?;
    // A row `Average` of one planner sums up the rows of that planner, if there are any.
    let others = |at: &usize| {
        let cell = &table.rows[row][*at];
        *at != own && table.columns[*at].meaning.kind == Kind::Skip && !cell.text.is_empty()
    };
    let same: Vec<usize> = (0..table.columns.len()).filter(others).collect();
    let is_alike =
        |other: usize| same.iter().all(|at| table.rows[other][*at].text == table.rows[row][*at].text);
    let Above { block, all, before, gap, perhaps_gap } = rows_above(table, labels, [row, column], is_alike)?;
    if all.len() < 2 && gap.is_none() {
        return None;
    }
    let rows: Vec<usize> = all.iter().chain(&before).copied().collect();
    let at = |rows_of: &[usize]| {
        rows_of.iter().filter_map(|of| rows.iter().position(|row| row == of)).map(|at| at + 1).collect()
    };
    let choices = [&block, &all, &before]
        .map(|rows| at(rows))
        .into_iter()
        .filter(|choice: &Vec<usize>| !choice.is_empty());
    let weights = weights(table, column, &rows);
    if weights.is_empty() && forms.contains(&Form::Pooled) && word != Word::Mean {
        forms.push(Form::Between);
    }
    forms.extend(OTHER_MEANS.iter().filter(|_| !word.is_sum()));
    let numbers = std::iter::once(&row).chain(&rows).map(|row| quoted(index, table, *row, column));
    let summary = Summary {
        numbers: numbers.collect::<Option<_>>()?,
        choices: choices.collect(),
        forms,
        weights,
        premise: "the row sums up rows above it",
        gap,
        perhaps_gap,
        of_counts: are_counts(table, column),
        steps: Cell::default(),
    };
    Some((word, summary))
}

/// The rows that a summary may sum up.
#[derive(Default)]
struct Above {
    /// Those of its block.
    block: Vec<usize>,
    /// All that are no summaries.
    all: Vec<usize>,
    /// Other summaries.
    before: Vec<usize>,
    /// Which row has no number.
    gap: Option<String>,
    /// Which row has no number, unless it begins a block.
    perhaps_gap: Option<String>,
}

/// The rows that the summary in `row` may sum up in `column`, of those that are alike; `None` if they are too many.
fn rows_above(
    table: &Table,
    labels: &[Option<usize>],
    [row, column]: [usize; 2],
    is_alike: impl Fn(usize) -> bool,
) -> Option<Above> {
    // A row that divides blocks holds its name alone; where a dash stands, something is not printed.
    let is_empty = |other: usize| {
        let cells = table.rows[other].iter().zip(&table.columns);
        cells.filter(|(_, column)| column.meaning.kind != Kind::Skip).all(|(cell, _)| cell.text.is_empty())
    };
    let mut found = Above::default();
    let mut is_in_block = true;
    let line = |other: usize| table.rows[other][column].place.line;
    for other in neighbours(table, labels, row) {
        // A row without numbers right below one with them may begin a block, or its numbers may be missing.
        let is_below_a_row = other > 0
            && labels[other - 1].is_none()
            && !is_empty(other - 1)
            && !is_statistic(table, other - 1);
        if is_empty(other) && is_below_a_row && is_alike(other) {
            found.perhaps_gap = Some(format!("line {} has no number here, or begins a block", line(other)));
        }
        if is_empty(other) || labels[other].is_some() || is_statistic(table, other) {
            is_in_block &= found.block.is_empty();
            if labels[other].is_some() && is_alike(other) && table.print(other, column).is_some() {
                found.before.push(other);
            }
            continue;
        }
        if !is_alike(other) {
            continue;
        }
        // Where one is not printed, what the others give is not known.
        if table.print(other, column).is_none() {
            found.gap = Some(format!("line {} has no number here", line(other)));
            continue;
        }
        if found.all.len() == MOST {
            return None;
        }
        found.all.push(other);
        if is_in_block {
            found.block.push(other);
        }
    }
    Some(found)
}

/// The rows that a summary may be of, the nearest first: those above, or below if there are none above.
fn neighbours(table: &Table, labels: &[Option<usize>], row: usize) -> Vec<usize> {
    let is_first = labels[..row].iter().all(Option::is_some);
    if is_first { (row + 1..table.rows.len()).collect() } else { (0..row).rev().collect() }
}

/// Whether a row holds another statistic of the rows: `Std`, `Median`. Queries may be called `q1`, `q2`.
fn is_statistic(table: &Table, row: usize) -> bool {
    let of_rows = |text: &str| {
        let statistic =
            Statistic::named(text.trim_end_matches('.')).filter(|_| !text.starts_with(['q', 'Q']));
        let is_other = ["std. dev", "std dev", "standard deviation", "variance", "range"]
            .contains(&text.to_lowercase().trim_end_matches('.'));
        is_other
            || statistic
                .is_some_and(|statistic| !matches!(statistic, Statistic::Quantile(share) if share != 5000))
    };
    table.rows[row].iter().any(|cell| cell.value.is_none() && of_rows(&cell.text))
}

/// The number of trials behind the numbers in `rows`, 0 for the summary itself; empty if one is not known.
fn weights(table: &Table, column: usize, rows: &[usize]) -> Vec<Exact> {
    let n = |row: usize| match &table.columns[column].meaning.n {
        Some(Count::Number(_)) => Some(whole(1)),
        Some(Count::Column(name)) => Some(table.print(row, named_by(&table.columns, column, name)?)?.value()),
        None => table.rows[row][column].k_of_n.map(|[_, n]| count(n)).or_else(|| {
            let named = table.columns.iter().position(is_count)?;
            Some(table.print(row, named)?.value())
        }),
    };
    let all = rows.iter().map(|row| n(*row).filter(|n| *n > whole(0))).collect::<Option<Vec<Exact>>>();
    all.map_or_else(Vec::new, |all| std::iter::once(whole(0)).chain(all).collect())
}

/// Whether a column holds counts of solved trials.
fn are_counts(table: &Table, column: usize) -> bool {
    table.columns[column].meaning.kind == Kind::Share { whole: 0 }
}

/// Whether a column is called as numbers of trials are, though no other column says that it has them.
fn is_count(column: &Column) -> bool {
    let name = column.name.trim().trim_start_matches('#').trim().to_lowercase();
    column.meaning.kind == Kind::Value && ["n", "runs", "trials", "instances"].contains(&name.as_str())
}

/// How numbers of a column may follow from others of it; `None` where no mean or sum does.
fn forms(table: &Table, at: usize, word: Word) -> Option<Vec<Form>> {
    let Column { name, meaning, .. } = &table.columns[at];
    let is_n = table.columns.iter().any(|column| column.meaning.n == Some(Count::Column(name.clone())));
    if is_n || is_count(&table.columns[at]) {
        return Some(vec![Form::Mean, Form::Sum]);
    }
    if is_quotient(table, at) {
        return (!word.is_sum()).then(|| vec![Form::Between]);
    }
    let forms: &[Form] = match (&meaning.kind, word) {
        (
            Kind::Share { whole: 0 } | Kind::Statistic(Statistic::Total | Statistic::Quantile(_)),
            Word::Mean,
        ) => &[Form::Mean],
        (
            Kind::Share { whole: 0 } | Kind::Statistic(Statistic::Total) | Kind::Value,
            Word::Sum | Word::Total,
        )
        | (Kind::Statistic(Statistic::Mean), Word::Sum) => &[Form::Sum],
        (Kind::Share { whole: 0 } | Kind::Statistic(Statistic::Total), Word::Either) => {
            &[Form::Mean, Form::Sum]
        }
        (Kind::Statistic(Statistic::Min | Statistic::Max), Word::Mean | Word::Either) => &[Form::Between],
        (Kind::Share { .. } | Kind::Statistic(Statistic::Mean) | Kind::Value, Word::Mean) => {
            &[Form::Mean, Form::Pooled]
        }
        (Kind::Share { .. } | Kind::Statistic(Statistic::Mean) | Kind::Value, _) => {
            &[Form::Mean, Form::Sum, Form::Pooled]
        }
        _ => return None,
    };
    Some(forms.to_vec())
}

/// Whether a column holds quotients: their mean may be geometric, or a quotient of means.
fn is_quotient(table: &Table, at: usize) -> bool {
    let Column { name, meaning, .. } = &table.columns[at];
    let name = name.to_lowercase();
    let words = [
        "speed", "ratio", "factor", "relative", "improve", "reduc", "saving", "gain", "gap", "increase", "/",
        "per ",
    ];
    let is_named =
        words.iter().any(|word| name.contains(word)) || meaning.kind == Kind::Value && name.contains('%');
    let cell = table.rows.iter().filter_map(|row| row.get(at)).find(|cell| cell.value.is_some());
    let has_unit = |cell: &crate::table::Cell| ["x", "×"].contains(&unit(&cell.text).1);
    is_named || meaning.ratio.is_some() || cell.is_some_and(has_unit)
}

/// The test of a cell in a column that sums up those before it; `None` if it sums up nothing that is known.
fn of_column(index: usize, table: &Table, row: usize, at: usize) -> Option<(Word, Summary)> {
    let Column { name, meaning, .. } = &table.columns[at];
    let word = word(name)?;
    table.print(row, at)?;
    // A column `mean` beside `sd` or `max` is a statistic of what is not printed.
    let is_statistic = groups(&table.columns)
        .iter()
        .any(|group| group.columns.len() > 1 && group.columns.iter().any(|(column, _)| *column == at));
    if is_statistic || !meaning.sum.is_empty() || meaning.spread.is_some() {
        return None;
    }
    let alike = |a: &Meaning, b: &Meaning| {
        (&a.kind, &a.unit, a.grain, a.better) == (&b.kind, &b.unit, b.grain, b.better)
    };
    let is_number =
        |column: &usize| !matches!(table.columns[*column].meaning.kind, Kind::Skip | Kind::Samples);
    let mut columns: Vec<usize> = (0..at).rev().take_while(is_number).collect();
    columns.drain(
        ..columns.iter().take_while(|column| self::word(&table.columns[**column].name).is_some()).count(),
    );
    let last = &table.columns[*columns.first()?].meaning;
    let run = columns.iter().take_while(|column| {
        let Column { name, meaning, .. } = &table.columns[**column];
        alike(meaning, last) && self::word(name).is_none()
    });
    columns.truncate(run.count());
    let is_same = meaning.kind == last.kind
        || table.columns[at].written.is_none() && matches!(meaning.kind, Kind::Statistic(_) | Kind::Value);
    if columns.len() < 2 || !is_same || meaning.unit.is_some() && meaning.unit != last.unit {
        return None;
    }
    let mut forms = forms(table, columns[0], word)?;
    forms.retain(|form| *form != Form::Pooled);
    if word == Word::Either {
        forms.push(Form::Between);
    }
    forms.extend(OTHER_MEANS.iter().filter(|_| !word.is_sum()));
    let missing = columns.iter().find(|column| table.print(row, **column).is_none());
    let gap = missing.map(|column| format!("column `{}` has no number here", table.columns[*column].name));
    let of_counts = are_counts(table, columns[0]);
    columns.retain(|column| table.print(row, *column).is_some());
    let numbers = std::iter::once(&at).chain(&columns).map(|column| quoted(index, table, row, *column));
    let summary = Summary {
        numbers: numbers.collect::<Option<_>>()?,
        choices: (2..=columns.len()).map(|most| (1..=most).collect()).collect(),
        forms,
        weights: Vec::new(),
        premise: "the column sums up columns right before it",
        gap,
        perhaps_gap: None,
        of_counts,
        steps: Cell::default(),
    };
    Some((word, summary))
}

fn build(relation: &Relation, input: &Input) -> Result<Box<dyn Test>, Fault> {
    let form = if relation.word("is", &["mean", "sum"])? == "sum" { Form::Sum } else { Form::Mean };
    let mut numbers = vec![relation.number("value", input)?];
    numbers.extend(relation.numbers("parts", input)?);
    let choices = vec![(1..numbers.len()).collect()];
    let premise = "these are all that it sums up";
    Ok(Box::new(Summary {
        numbers,
        choices,
        forms: vec![form],
        weights: Vec::new(),
        premise,
        gap: None,
        perhaps_gap: None,
        of_counts: false,
        steps: Cell::default(),
    }))
}

impl Summary {
    /// What one choice allows by one form; `None` if 128 bits do not suffice.
    fn allowed(&self, spans: &[Span], choice: &[usize], form: Form) -> Option<Span> {
        if form == Form::Between {
            let low = choice.iter().map(|at| spans[*at].low).min()?;
            return Some(Span::closed(low, choice.iter().map(|at| spans[*at].high).max()?));
        }
        if OTHER_MEANS.contains(&form) {
            let ends =
                choice.iter().map(|at| [spans[*at].low, spans[*at].high].map(|end| float(end).max(0.0)));
            let low = form.mean_of(ends.clone().map(|[low, _]| low));
            let high = form.mean_of(ends.map(|[_, high]| high));
            return around_floats([low, high]);
        }
        let weight = |at: usize| if form == Form::Pooled { self.weights[at] } else { whole(1) };
        let all = choice.iter().try_fold(whole(0), |all, at| add(all, weight(*at)))?;
        let add_weighted = |sum: Span, at: &usize| sum.plus(&spans[*at].times(weight(*at))?);
        let sum = choice.iter().try_fold(Span::point(whole(0)), add_weighted)?;
        if form == Form::Sum { Some(sum) } else { sum.times(div(whole(1), all)?) }
    }

    /// Every form of every choice with what it allows.
    fn all(&self, prints: &[Print]) -> impl Iterator<Item = (Form, usize, Option<Span>)> {
        let mut spans = spans(prints);
        if self.of_counts {
            let points = prints.iter().map(|print| Span::point(print.value()));
            spans.iter_mut().zip(points).skip(1).for_each(|(span, point)| *span = point);
        }
        self.steps.set(self.steps.get() + prints.len() as u64);
        let pairs = self.choices.iter().flat_map(|choice| self.forms.iter().map(move |form| (choice, *form)));
        let needs = pairs.filter(|(_, form)| *form != Form::Pooled || !self.weights.is_empty());
        needs.filter_map(move |(choice, form)| {
            let is_positive = || choice.iter().all(|at| spans[*at].high > whole(0));
            let is_there = !OTHER_MEANS.contains(&form) || is_positive();
            is_there.then(|| (form, choice.len(), self.allowed(&spans, choice, form)))
        })
    }
}

impl Test for Summary {
    fn numbers(&self) -> &[Quoted] {
        &self.numbers
    }

    fn is_possible(&self, prints: &[Print]) -> Option<bool> {
        if self.gap.is_some() {
            return None;
        }
        let printed = prints[0].span();
        let mut is_open = false;
        for (_, _, span) in self.all(prints) {
            match span {
                Some(span) if span.meets(&printed) => return Some(true),
                Some(_) => {}
                None => is_open = true,
            }
        }
        (!is_open && self.perhaps_gap.is_none()).then_some(false)
    }

    fn sentence(&self, prints: &[Print], is_possible: bool) -> String {
        let own = prints[0].span();
        let mut ways: Vec<String> = Vec::new();
        for (form, many, span) in self.all(prints) {
            let Some(span) = span else { continue };
            if span.meets(&own) != is_possible {
                continue;
            }
            let way = format!("{} of {many} is {}", form.name(), shown_span(&span, 4));
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
        ways.truncate(3);
        let verb = if is_possible { "sums up" } else { "does not sum up" };
        format!("{} {verb} the others: {}", prints[0].printed, ways.join("; "))
    }

    fn premises(&self) -> Vec<String> {
        vec![self.premise.to_owned(), digits(&self.numbers)]
    }

    fn undecided(&self, _prints: &[Print]) -> String {
        let gap = self.gap.clone().or_else(|| self.perhaps_gap.clone());
        gap.unwrap_or_else(|| "too many digits for exact arithmetic".to_owned())
    }

    fn is_about_digits(&self) -> bool {
        false
    }

    fn is_about_summaries(&self) -> bool {
        true
    }

    fn steps_taken(&self) -> Option<u64> {
        Some(self.steps.get())
    }
}
