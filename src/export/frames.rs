//! All trials of a run in one Parquet file, and their statistics in another.
//!
//! Studies differ in their columns: the file has those of all of them, and what a study has not is null. A sweep whose values are
//! of several kinds is text.

use polars::prelude::{Column, DataFrame, DataType, NamedFrom as _, Series};
use replan::analysis::compare::{Cell, Measured, StoredRun, cells};
use replan::cli::Failure;
use std::fs::File;
use std::path::Path;
use study::StudyError;
use study::parquet::{FrameReader, write_frame};
use study::store::{Staged, part_path};

/// The key of a file's metadata under which its columns are described.
const DESCRIPTION: &str = "columns";

/// Stages both files, and says what they are.
///
/// # Errors
/// What cannot be read or written.
pub fn stage(staged: &mut Staged, out: &Path, folder: &Path, run: &StoredRun) -> Result<String, Failure> {
    let mut frames = Vec::new();
    let mut described: Vec<serde_json::Value> = vec![
        serde_json::json!({ "name": "study", "unit": null, "about": "study that the trial belongs to" }),
    ];
    for study in run.studies.keys() {
        let path = part_path(folder, study, "trials");
        let file = File::open(&path).map_err(StudyError::io(&path, "opening the file"))?;
        let mut reader = FrameReader::open(file).map_err(|error| failure(&path, &error))?;
        let entry = reader.entry(DESCRIPTION).unwrap_or("[]");
        let own: Vec<serde_json::Value> = serde_json::from_str(entry).unwrap_or_default();
        described.extend(
            own.into_iter()
                .filter(|one| described.iter().all(|known| known["name"] != one["name"]))
                .collect::<Vec<_>>(),
        );
        let mut frame = reader.frame().map_err(|error| failure(&path, &error))?;
        let names = Series::new("study".into(), vec![study.as_str(); frame.height()]);
        frame.insert_column(0, names.into()).map_err(|error| failure(&path, &error))?;
        frames.push(frame);
    }
    let all = stacked(&frames).map_err(|error| failure(folder, &error))?;
    let [trials, statistics] = ["trials.parquet", "statistics.parquet"].map(|name| out.join(name));
    let entry = serde_json::Value::from(described).to_string();
    let count = all.height();
    write(staged, &trials, all, vec![(DESCRIPTION.to_owned(), entry)])?;
    write(staged, &statistics, statistics_frame(&cells(run)), Vec::new())?;
    Ok(format!("{count} trials and their statistics are"))
}

fn write(
    staged: &mut Staged,
    path: &Path,
    frame: DataFrame,
    entries: Vec<(String, String)>,
) -> Result<(), Failure> {
    let mut bytes = Vec::new();
    write_frame(&mut bytes, frame, entries).map_err(|error| failure(path, &error))?;
    Ok(staged.add(path, &bytes)?)
}

fn failure(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    Failure::input(format!("{}: {error}", path.display()))
}

/// The rows of all frames under each other, with the columns of all.
fn stacked(frames: &[DataFrame]) -> polars::prelude::PolarsResult<DataFrame> {
    let mut columns: Vec<(String, DataType)> = Vec::new();
    for column in frames.iter().flat_map(DataFrame::columns) {
        match columns.iter_mut().find(|(name, _)| name == column.name().as_str()) {
            Some((_, kind)) if kind != column.dtype() => *kind = DataType::String,
            Some(_) => {}
            None => columns.push((column.name().to_string(), column.dtype().clone())),
        }
    }
    let mut all: Vec<Column> = Vec::new();
    for (name, kind) in &columns {
        let mut whole: Option<Column> = None;
        for frame in frames {
            let part = match frame.column(name) {
                Ok(column) => column.cast(kind)?,
                Err(_) => Column::full_null(name.as_str().into(), frame.height(), kind),
            };
            match &mut whole {
                Some(whole) => drop(whole.append(&part)?),
                None => whole = Some(part),
            }
        }
        all.extend(whole);
    }
    DataFrame::new(frames.iter().map(DataFrame::height).sum(), all)
}

fn statistics_frame(cells: &[Cell]) -> DataFrame {
    let text = |name: &str, get: fn(&Cell) -> &String| -> Column {
        Series::new(name.into(), cells.iter().map(|cell| get(cell).as_str()).collect::<Vec<_>>()).into()
    };
    let count = |name: &str, get: fn(&Cell) -> usize| -> Column {
        Series::new(name.into(), cells.iter().map(|cell| get(cell) as u64).collect::<Vec<_>>()).into()
    };
    let real = |name: String, get: &dyn Fn(&Cell) -> Option<f64>| -> Column {
        Series::new(name.as_str().into(), cells.iter().map(get).collect::<Vec<_>>()).into()
    };
    let mut columns = vec![
        text("study", |cell| &cell.study),
        text("interpretation", |cell| &cell.interpretation),
        text("group", |cell| &cell.group),
        text("contender", |cell| &cell.contender),
        text("sweep", |cell| &cell.sweep),
        text("metric", |cell| &cell.metric),
        text("unit", |cell| &cell.unit),
        count("trials", |cell| cell.trials),
        count("solved", |cell| cell.solved),
        count("instances", |cell| cell.instances),
        count("measured", |cell| cell.measured),
    ];
    let of: [(&str, fn(&Cell) -> Option<Measured>); 2] =
        [("mean", |cell| cell.mean), ("median", |cell| cell.median)];
    for (name, get) in of {
        columns.push(real(name.to_owned(), &|cell| get(cell).map(|of| of.value)));
        let end = |cell: &Cell, end: usize| Some(get(cell)?.interval?[end]);
        columns.push(real(format!("{name}_low"), &|cell| end(cell, 0)));
        columns.push(real(format!("{name}_high"), &|cell| end(cell, 1)));
    }
    DataFrame::new(cells.len(), columns).expect("columns are as long as the cells are many")
}
