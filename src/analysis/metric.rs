//! Metrics: what can be compared, its unit, which way is better, and how to get it from a record. Every column of records is one; a few
//! more are read from columns.

use engine::planner::Value;
use std::collections::BTreeSet;
use std::sync::LazyLock;
use study::clock;
pub use study::column::Better;
use study::column::{self, Column};
use study::record::{Row, Status};

/// A metric: one column of trials, or what is read from columns, the status or the clock.
#[derive(Debug, PartialEq)]
pub struct Metric {
    /// The name that claims and figures use.
    pub name: &'static str,
    /// Its name in tables and on axes, without the unit.
    pub label: String,
    /// Its unit as it is printed; empty for counts.
    pub unit: String,
    /// Which way is better.
    pub better: Better,
    /// What its numbers mean.
    pub about: &'static str,
    /// The column it is read from.
    pub column: &'static str,
    /// The factor from the column's unit to this unit.
    pub scale: f64,
    /// The column that it is compared with: the metric is 1 where it is at most as large (to 1e-9 of it), otherwise 0.
    pub at_most: Option<&'static str>,
    /// Whether it counts what the search did, which holds even where the verifier refuses the path.
    pub is_of_search: bool,
}

/// What is read from the trial's status in place of a column: 1 where a path came back, refused or not, otherwise 0.
const STATUS: &str = "status";

/// Every metric, in the order of their names.
pub static METRICS: LazyLock<Vec<Metric>> = LazyLock::new(|| {
    let columns = column::COLUMNS.iter().filter(|column| !is_time(column.name)).map(of_column);
    let mut metrics: Vec<Metric> = columns.chain(derived()).collect();
    metrics.sort_by_key(|metric| metric.name);
    metrics
});

fn of_column(column: &Column) -> Metric {
    let unit = column.unit().unwrap_or_default().replace("deg", "°");
    Metric {
        name: column.name,
        label: column.label(),
        unit: if unit == "1" { String::new() } else { unit },
        better: column.better,
        about: column.about,
        column: column.name,
        scale: 1.0,
        at_most: None,
        is_of_search: column.is_of_search,
    }
}

/// Metrics that are no column as it stands.
fn derived() -> [Metric; 6] {
    let metric = |name, label: &str, better, column, about| Metric {
        name,
        label: label.to_owned(),
        unit: String::new(),
        better,
        about,
        column,
        scale: 1.0,
        at_most: None,
        is_of_search: false,
    };
    let time = |name, label, column, (unit, scale): (&str, f64)| {
        let about = column::find(column).map_or(clock::ABOUT, |column| column.about);
        Metric { unit: unit.to_owned(), scale, ..metric(name, label, Better::Lower, column, about) }
    };
    let milliseconds = ("ms", 1e-6);
    let path_found = "1 where a path came back, refused or not, otherwise 0";
    let as_short = "1 where the path is as short as any between corners of cells, otherwise 0";
    let shortest = metric("is_shortest", "Shortest path found", Better::Higher, "path_cost_cells", as_short);
    [
        metric("found", "Path found", Better::Higher, STATUS, path_found),
        Metric { at_most: Some("shortest_path_cells"), ..shortest },
        time("own_time_ms", "Planning time by its own clock", "own_wall_ns", milliseconds),
        time("plan_time_ms", "Planning time", clock::COLUMN, milliseconds),
        time("plan_time_us", "Planning time", clock::COLUMN, ("µs", 1e-3)),
        time("solve_time_ms", "Time to a planner's result", "solve_wall_ns", milliseconds),
    ]
}

/// Whether a column is read from a clock, ours or a planner's own.
fn is_time(column: &str) -> bool {
    column.ends_with("_wall_ns")
}

/// The metric called `name`.
pub fn find(name: &str) -> Option<&'static Metric> {
    METRICS.iter().find(|metric| metric.name == name)
}

impl Metric {
    /// Label and unit, as an axis shows them.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.label.clone() } else { format!("{} ({})", self.label, self.unit) }
    }

    /// Whether a study whose records have these columns gives it.
    pub fn is_produced(&self, columns: &BTreeSet<&str>) -> bool {
        self.is_status() || self.is_read_from(columns)
    }

    /// Whether it is read from some of these columns.
    pub fn is_read_from(&self, columns: &BTreeSet<&str>) -> bool {
        columns.contains(self.column) && self.at_most.is_none_or(|other| columns.contains(other))
    }

    /// Whether it is read from the trial's status: 1 where a path came back, refused or not, otherwise 0.
    pub fn is_status(&self) -> bool {
        self.column == STATUS
    }

    /// It for each row, none where it was not measured; `wall_ns` is the median of a row's times.
    pub fn reader<'r>(
        &'r self,
        wall_ns: impl Fn(&Row) -> Option<f64> + 'r,
    ) -> impl Fn(&Row) -> Option<f64> + 'r {
        let place = column::place(self.column);
        let other = self.at_most.and_then(column::place);
        let number = |row: &Row, place: u16| row.values.at(place).map(Value::as_f64);
        move |row| {
            let raw = if self.is_clock() {
                wall_ns(row)
            } else if self.is_status() {
                Some(f64::from(u8::from(matches!(row.status, Status::Solved | Status::Rejected))))
            } else {
                number(row, place?)
            };
            let raw = match other {
                Some(other) => raw.zip(number(row, other)).map(|(own, most)| is_at_most(own, most)),
                None => raw,
            };
            raw.map(|value| value * self.scale)
        }
    }

    /// Whether it is read from the clock.
    pub fn is_clock(&self) -> bool {
        self.column == clock::COLUMN
    }

    /// Whether a trial that ended so has a number: a solved one or, of what the search did, one whose path is refused.
    pub fn is_given_by(&self, row: &Row) -> bool {
        row.is_solved() || self.is_of_search && row.status == Status::Rejected
    }

    /// Whether a clock decides it, ours or a planner's own: it differs between machines and sessions.
    pub fn is_time(&self) -> bool {
        is_time(self.column)
    }
}

/// 1 if `own` is at most `most`, up to rounding, otherwise 0.
fn is_at_most(own: f64, most: f64) -> f64 {
    f64::from(u8::from(own <= most * (1.0 + 1e-9)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_shortest_up_to_rounding_alone() {
        let shortest = 2.0_f64.sqrt();
        assert_eq!(
            [shortest, shortest + 1e-12, shortest + 1e-6].map(|own| is_at_most(own, shortest)),
            [1.0, 1.0, 0.0]
        );
    }

    #[test]
    fn metrics_are_in_order_and_read_columns_that_exist() {
        assert!(METRICS.windows(2).all(|pair| pair[0].name < pair[1].name));
        for metric in &*METRICS {
            assert!(
                metric.is_clock() || metric.is_status() || column::find(metric.column).is_some(),
                "{}",
                metric.name
            );
        }
    }
}
