//! Records as data frames, and these as Parquet files that say what their columns mean.

use super::describe::{CHOICE, SWEEP, described};
use crate::column::{self, Kind};
use crate::key::{InstanceKey, KeyColumns, Owner, SweepKey, SweepValue, TrialKey};
use crate::record::{Kept, PreprocessingRow, Row, Timing, Values};
use engine::planner::Value;
use polars::prelude::{Column, DataFrame, NamedFrom as _, Series};
use std::collections::BTreeSet;

/// The key of a file's metadata under which its columns are described: JSON, a list of name, unit and meaning.
pub const DESCRIPTION: &str = "columns";

/// The trials as a frame; `columns` are those that the study can fill, in any order. Sweeps are of the kinds that `sweep` has.
pub fn trials(
    rows: &[Row],
    keys: &KeyColumns,
    columns: &[&'static str],
    sweep: Option<&SweepKey>,
) -> DataFrame {
    let mut frame = keys_of(rows, keys, sweep, |row| (&*row.key.on, Some(&row.key)));
    frame.extend([
        whole("seed", rows, |row| row.seed),
        text("status", rows, |row| Some(row.status.name())),
        text("reason", rows, |row| row.reason.as_deref()),
    ]);
    frame.extend(values(rows, |name| columns.contains(&name), |row| &row.values));
    assemble(rows.len(), frame)
}

/// The preprocessed objects as a frame, with the columns that are `filled`.
pub fn preprocessing(
    rows: &[PreprocessingRow],
    keys: &KeyColumns,
    filled: &BTreeSet<&'static str>,
) -> DataFrame {
    let mut frame = instance_keys(rows, keys, |row| &*row.key);
    frame.extend(choice_columns(rows, keys, |row| &*row.key));
    frame.extend([
        text("kind", rows, |row| Some(row.kind.as_str())),
        whole("seed", rows, |row| Some(row.seed)),
        text("reason", rows, |row| row.reason.as_deref()),
    ]);
    frame.extend(values(rows, |name| filled.contains(name), |row| &row.values));
    assemble(rows.len(), frame)
}

/// The traces as a frame: one row a trace, its numbers as a list, row by row of `width` numbers, and the names of the
/// columns that they stand in where these are known. Sweeps are of the kinds that `sweep` has, if any trial has a trace.
pub fn traces(kept: &[Kept], keys: &KeyColumns, sweep: Option<&SweepKey>) -> DataFrame {
    let lists: Vec<Series> =
        kept.iter().map(|kept| Series::new("values".into(), kept.trace.values.as_slice())).collect();
    let values = if lists.is_empty() {
        // Without a first list polars cannot know what the lists hold.
        Series::new("values".into(), &[Series::new("values".into(), &[0.0_f64][..])]).clear()
    } else {
        Series::new("values".into(), lists)
    };
    let columns: Vec<Option<String>> = kept.iter().map(|kept| column::of_trace(&kept.trace.name)).collect();
    let mut frame = keys_of(kept, keys, sweep, |kept| match &kept.owner {
        Owner::Instance(key) => (&**key, None),
        Owner::Trial(key) => (&*key.on, Some(key)),
    });
    frame.extend([
        text("name", kept, |kept| Some(kept.trace.name.as_str())),
        whole("width", kept, |kept| Some(kept.trace.width as u64)),
        Series::new("columns".into(), columns).into(),
        values.into(),
    ]);
    assemble(kept.len(), frame)
}

/// The times as a frame.
pub fn times(times: &[Timing], keys: &KeyColumns) -> DataFrame {
    let mut frame = keys_of(times, keys, None, |time| (&*time.trial.on, Some(&time.trial)));
    frame.extend([
        whole("session", times, |time| Some(u64::from(time.session))),
        whole("clock_repeat", times, |time| Some(u64::from(time.clock_repeat))),
        whole("plan_wall_ns", times, |time| Some(time.plan_wall_ns)),
    ]);
    assemble(times.len(), frame)
}

/// What a file of frames with the columns of `frame` says of them.
pub fn description(frame: &DataFrame, keys: &KeyColumns) -> Vec<(String, String)> {
    let names = frame.columns().iter().map(|column| column.name().as_str());
    let meant = names.map(|name| described(name, keys).expect("every column of records is described"));
    let json = serde_json::to_string(&meant.collect::<Vec<_>>()).expect("descriptions are strings");
    vec![(DESCRIPTION.to_owned(), json)]
}

fn assemble(height: usize, columns: Vec<Column>) -> DataFrame {
    DataFrame::new(height, columns).expect("columns are as long as the records are many")
}

/// The columns that name records which belong to an instance and, if there is one, to a trial on it; sweeps are of the kinds that
/// `sweep` has, or of those found.
fn keys_of<'a, R>(
    rows: &'a [R],
    keys: &KeyColumns,
    sweep: Option<&SweepKey>,
    get: impl Fn(&'a R) -> (&'a InstanceKey, Option<&'a TrialKey>),
) -> Vec<Column> {
    let trial = |row: &'a R| get(row).1;
    let mut frame = instance_keys(rows, keys, |row| get(row).0);
    frame.push(text("query", rows, |row| trial(row)?.query.as_deref()));
    frame.push(text("contender", rows, |row| Some(&*trial(row)?.contender)));
    for (setting, _) in &keys.sweeps {
        let cells = rows.iter().map(|row| trial(row)?.sweep.value(setting));
        let kind = sweep.and_then(|sweep| sweep.value(setting));
        frame.push(sweep_column(&format!("{SWEEP}{setting}"), &cells.collect::<Vec<_>>(), kind));
    }
    frame.extend(choice_columns(rows, keys, |row| get(row).0));
    frame.push(whole("repeat", rows, |row| trial(row).map(|key| u64::from(key.repeat))));
    frame
}

/// The columns that name an instance but for its reading. Sweeps over settings of the problem stand before its number, all others
/// after it.
fn instance_keys<'a, R>(
    rows: &'a [R],
    keys: &KeyColumns,
    key: impl Fn(&'a R) -> &'a InstanceKey,
) -> Vec<Column> {
    let mut frame = vec![text("group", rows, |row| Some(&*key(row).group))];
    for (setting, kind) in &keys.posed {
        let cells: Vec<_> = rows.iter().map(|row| key(row).sweep.value(setting)).collect();
        frame.push(sweep_column(&format!("{SWEEP}{setting}"), &cells, Some(kind)));
    }
    frame.push(whole("instance", rows, |row| Some(u64::from(key(row).instance))));
    frame
}

fn choice_columns<'a, R>(
    rows: &'a [R],
    keys: &KeyColumns,
    key: impl Fn(&'a R) -> &'a InstanceKey,
) -> Vec<Column> {
    let ids = keys.choices.iter().enumerate();
    let column = |(place, id): (usize, _)| {
        text(&format!("{CHOICE}{id}"), rows, |row| Some(&*key(row).interpretation.options().get(place)?.1))
    };
    ids.map(column).collect()
}

/// The values of a sweep, as numbers if they are.
fn sweep_column(name: &str, cells: &[Option<&SweepValue>], kind: Option<&SweepValue>) -> Column {
    match kind.or_else(|| cells.iter().flatten().next().copied()) {
        Some(SweepValue::Flag(_)) => Series::new(
            name.into(),
            picked(cells, |value| match value {
                SweepValue::Flag(flag) => Some(*flag),
                _ => None,
            }),
        ),
        Some(SweepValue::Whole(_)) => Series::new(
            name.into(),
            picked(cells, |value| match value {
                SweepValue::Whole(whole) => Some(*whole),
                _ => None,
            }),
        ),
        Some(SweepValue::Real(_)) => Series::new(name.into(), picked(cells, SweepValue::as_f64)),
        Some(SweepValue::Text(_)) | None => {
            Series::new(name.into(), picked(cells, |value| Some(value.to_string())))
        }
    }
    .into()
}

fn picked<T>(cells: &[Option<&SweepValue>], pick: impl Fn(&SweepValue) -> Option<T>) -> Vec<Option<T>> {
    cells.iter().map(|cell| cell.and_then(&pick)).collect()
}

fn text<'a, R>(name: &str, rows: &'a [R], get: impl Fn(&'a R) -> Option<&'a str>) -> Column {
    Series::new(name.into(), rows.iter().map(get).collect::<Vec<_>>()).into()
}

fn whole<'a, R>(name: &str, rows: &'a [R], get: impl Fn(&'a R) -> Option<u64>) -> Column {
    Series::new(name.into(), rows.iter().map(get).collect::<Vec<_>>()).into()
}

fn values<R>(
    rows: &[R],
    is_wanted: impl Fn(&'static str) -> bool,
    get: impl Fn(&R) -> &Values,
) -> Vec<Column> {
    let wanted = column::COLUMNS.iter().zip(0..).filter(|(column, _)| is_wanted(column.name));
    let filled = wanted.map(|(column, place)| {
        let cells = rows.iter().map(|row| get(row).at(place));
        match column.kind {
            Kind::Count => whole_cells(column.name, cells),
            Kind::Real => {
                let cells: Vec<Option<f64>> = cells.map(|cell| cell.map(Value::as_f64)).collect();
                Series::new(column.name.into(), cells).into()
            }
        }
    });
    filled.collect()
}

fn whole_cells(name: &str, cells: impl Iterator<Item = Option<Value>>) -> Column {
    let cells: Vec<Option<u64>> = cells
        .map(|cell| {
            cell.map(|value| match value {
                Value::Count(count) => count,
                Value::Real(real) => panic!("column `{name}` holds counts, not {real}"),
            })
        })
        .collect();
    Series::new(name.into(), cells).into()
}
