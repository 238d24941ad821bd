//! The numbers of reductions and savings as a table: a name a row.

use super::numbers::{Point, Series};
use super::{Along, Statistic, StatisticsPanel};
use crate::analysis::metric::Metric;
use crate::analysis::shown::Spread;
use crate::analysis::statistic::{INTERVALS, OverallStatistic};
use crate::render::RenderError;
use crate::render::figure::Scene;
use crate::render::latex::{Cell, Column, Table};

/// A column: its head, what is printed, and the cell of a number.
struct Numbers<'a> {
    head: String,
    printed: Option<f64>,
    series: &'a Series,
    cell: fn(&Point) -> String,
}

fn dash() -> String {
    "–".to_owned()
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(dash, |value| format!("{value:.1}"))
}

fn range(ends: Option<[f64; 2]>) -> String {
    format!("{} to {}", number(ends.map(|ends| ends[0])), number(ends.map(|ends| ends[1])))
}

/// The columns of one series of a panel.
fn columns<'a>(panel: &StatisticsPanel, series: &'a Series) -> Vec<Numbers<'a>> {
    let column = |head: &str, cell| Numbers { head: head.to_owned(), printed: None, series, cell };
    match panel.statistic {
        Statistic::Spreads => vec![column(&series.label, |point| number(point.spread.median()))],
        Statistic::Savings => vec![
            column("n", |point| point.n.to_string()),
            column("mean saving (%)", |point| number(point.spread.mean)),
            column("5 % to 95 %", |point| range(point.spread.quantiles.map(|q| [q[0], q[4]]))),
            column("least to greatest", |point| range(Spread::ends(&point.spread))),
        ],
        _ => {
            let cell = |point: &Point| {
                format!("{:.1} [{:.1}, {:.1}]", point.at[1], point.interval.low, point.interval.high)
            };
            vec![Numbers { printed: panel.rules.first().copied(), ..column(&panel.spec.title, cell) }]
        }
    }
}

/// The table of a figure whose panels are all along the same names.
///
/// # Errors
/// What is not stored.
pub(super) fn table(
    panels: &[StatisticsPanel],
    scene: &Scene<'_>,
    (label, caption): (&str, &str),
) -> Result<Table, RenderError> {
    let all = panels.iter().map(|panel| panel.series(scene)).collect::<Result<Vec<_>, _>>()?;
    let both = panels.iter().zip(&all);
    let columns: Vec<Numbers<'_>> =
        both.flat_map(|(panel, all)| all.iter().flat_map(|series| columns(panel, series))).collect();
    let last = &panels[panels.len() - 1];
    let is_by_query = last.along == Along::Queries;
    let names = if is_by_query { last.query_names(scene) } else { last.contenders.clone() };
    let kinds: Vec<Column> =
        [Column::Left].into_iter().chain(columns.iter().map(|_| Column::Right)).collect();
    let mut table = Table::new(label, caption, &kinds);
    let row = |first: &str, cells: &dyn Fn(&Numbers<'_>) -> String| {
        [first.to_owned()].into_iter().chain(columns.iter().map(cells)).map(Cell::from).collect::<Vec<_>>()
    };
    table.head(row(if is_by_query { "query" } else { "Reduction in %" }, &|column| column.head.clone()));
    if columns.iter().any(|column| column.printed.is_some()) {
        table.row(row("printed", &|column| column.printed.map_or_else(dash, |printed| printed.to_string())));
    }
    for (place, name) in names.iter().enumerate() {
        let cell = |column: &Numbers<'_>| {
            let own = column.series.points.iter().find(|point| point.place == place);
            own.map_or_else(dash, column.cell)
        };
        table.row(row(name, &cell));
    }
    let against = last.spec.against.as_deref().unwrap_or_default();
    let metric = last.metric.map_or_else(String::new, Metric::title);
    table.note(if is_by_query {
        format!("{metric}: medians over instances; savings against {against}, instance by instance.")
    } else {
        let what = OverallStatistic::ReductionPercent.name();
        format!("The {what} against {against}, with 95 % intervals over instances: {INTERVALS}.")
    });
    Ok(table)
}
