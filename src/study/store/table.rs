//! Records as data frames and Parquet, and back.

use crate::study::StudyError;
use crate::study::column::{self, Kind};
use crate::study::record::{Kept, PreparedRow, Row, Status, Timing, Values};
use engine::planner::{Exhibit, Value, fill_column};
use polars::prelude::{Column, DataFrame, NamedFrom as _, Series};
use polars_io::prelude::{ParquetCompression, ParquetReader, ParquetWriter, SerReader as _};
use std::collections::BTreeSet;
use std::io::Cursor;
use std::mem::take;
use std::path::PathBuf;

/// The trials as a frame; `columns` are those that the study can fill, in any order.
pub fn trials(rows: &[Row], columns: &[&'static str]) -> DataFrame {
    let mut frame = vec![
        text("trial", rows, |row| Some(row.trial.as_str())),
        text("problem", rows, |row| Some(row.problem.as_str())),
        text("group", rows, |row| Some(row.group.as_str())),
        whole("replicate", rows, |row| Some(u64::from(row.replicate))),
        text("contender", rows, |row| Some(row.contender.as_str())),
        text("sweep", rows, |row| Some(row.sweep.as_str())),
        text("reading", rows, |row| Some(row.reading.as_str())),
        whole("repeat", rows, |row| Some(u64::from(row.repeat))),
        whole("seed", rows, |row| Some(row.seed)),
        text("status", rows, |row| Some(row.status.name())),
        text("reason", rows, |row| row.reason.as_deref()),
    ];
    frame.extend(values(rows, |name| columns.contains(&name), |row| &row.values));
    assemble(rows.len(), frame)
}

/// The prepared objects as a frame, with the columns that any of them fills.
pub fn prepared(rows: &[PreparedRow]) -> DataFrame {
    let mut frame = vec![
        text("prepared", rows, |row| Some(row.prepared.as_str())),
        text("kind", rows, |row| Some(row.kind.as_str())),
        text("group", rows, |row| Some(row.group.as_str())),
        whole("replicate", rows, |row| Some(u64::from(row.replicate))),
        text("reading", rows, |row| Some(row.reading.as_str())),
        whole("seed", rows, |row| Some(row.seed)),
        text("reason", rows, |row| row.reason.as_deref()),
    ];
    let filled: BTreeSet<&str> = rows.iter().flat_map(|row| row.values.keys().map(String::as_str)).collect();
    frame.extend(values(rows, |name| filled.contains(name), |row| &row.values));
    assemble(rows.len(), frame)
}

/// The exhibits as a frame: one row an exhibit, its numbers as a list, row by row of `width` numbers, and the names of the
/// columns that they stand in where these are known.
pub fn exhibits(kept: &[Kept]) -> DataFrame {
    let lists: Vec<Series> =
        kept.iter().map(|kept| Series::new("values".into(), kept.exhibit.values.as_slice())).collect();
    let values = if lists.is_empty() {
        // Without a first list polars cannot know what the lists hold.
        Series::new("values".into(), &[Series::new("values".into(), &[0.0_f64][..])]).clear()
    } else {
        Series::new("values".into(), lists)
    };
    let columns: Vec<Option<String>> =
        kept.iter().map(|kept| column::of_exhibit(&kept.exhibit.name)).collect();
    let frame = vec![
        text("of", kept, |kept| Some(kept.of.as_str())),
        text("name", kept, |kept| Some(kept.exhibit.name.as_str())),
        whole("width", kept, |kept| Some(kept.exhibit.width as u64)),
        Series::new("columns".into(), columns).into(),
        values.into(),
    ];
    assemble(kept.len(), frame)
}

/// The clock readings as a frame.
pub fn times(times: &[Timing]) -> DataFrame {
    let frame = vec![
        text("trial", times, |time| Some(time.trial.as_str())),
        text("group", times, |time| Some(time.group.as_str())),
        text("contender", times, |time| Some(time.contender.as_str())),
        whole("replicate", times, |time| Some(u64::from(time.replicate))),
        whole("repeat", times, |time| Some(u64::from(time.repeat))),
        whole("plan_wall_ns", times, |time| Some(time.plan_wall_ns)),
    ];
    assemble(times.len(), frame)
}

/// The bytes of `frame` as a Parquet file: the same for the same frame.
pub fn to_parquet(mut frame: DataFrame) -> Vec<u8> {
    let mut bytes = Vec::new();
    ParquetWriter::new(&mut bytes)
        .with_compression(ParquetCompression::Zstd(None))
        .set_parallel(false)
        .finish(&mut frame)
        .expect("a frame of equally long columns is written to memory");
    bytes
}

fn assemble(height: usize, columns: Vec<Column>) -> DataFrame {
    DataFrame::new(height, columns).expect("columns are as long as the records are many")
}

fn text<'a, R>(name: &str, rows: &'a [R], get: impl Fn(&'a R) -> Option<&'a str>) -> Column {
    Series::new(name.into(), rows.iter().map(get).collect::<Vec<_>>()).into()
}

fn whole<R>(name: &str, rows: &[R], get: impl Fn(&R) -> Option<u64>) -> Column {
    Series::new(name.into(), rows.iter().map(get).collect::<Vec<_>>()).into()
}

fn values<R>(
    rows: &[R],
    is_wanted: impl Fn(&'static str) -> bool,
    get: impl Fn(&R) -> &Values,
) -> Vec<Column> {
    let wanted = column::COLUMNS.iter().filter(|column| is_wanted(column.name));
    let filled = wanted.map(|column| {
        let cells = rows.iter().map(|row| get(row).get(column.name).copied());
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

/// A Parquet file that was opened.
pub struct Stored {
    path: PathBuf,
    frame: DataFrame,
}

impl Stored {
    /// The frame in `bytes`, read from `path`.
    pub fn open(path: PathBuf, bytes: Vec<u8>) -> Result<Self, StudyError> {
        let frame = ParquetReader::new(Cursor::new(bytes)).finish();
        let frame = frame.map_err(|e| StudyError::stored(&path, format!("is not a Parquet file: {e}")))?;
        Ok(Self { path, frame })
    }

    fn column(&self, name: &str) -> Result<&Column, StudyError> {
        self.frame.column(name).map_err(|_| {
            StudyError::stored(&self.path, format!("has no column `{name}`; run the study again"))
        })
    }

    fn wrong(&self, name: &str) -> StudyError {
        StudyError::stored(
            &self.path,
            format!("column `{name}` does not hold what it should; run the study again"),
        )
    }

    fn maybe_texts(&self, name: &str) -> Result<Vec<Option<String>>, StudyError> {
        let texts = self.column(name)?.str().map_err(|_| self.wrong(name))?;
        Ok(texts.iter().map(|text| text.map(str::to_owned)).collect())
    }

    fn texts(&self, name: &str) -> Result<Vec<String>, StudyError> {
        self.maybe_texts(name)?.into_iter().map(|text| text.ok_or_else(|| self.wrong(name))).collect()
    }

    fn maybe_wholes(&self, name: &str) -> Result<Vec<Option<u64>>, StudyError> {
        Ok(self.column(name)?.u64().map_err(|_| self.wrong(name))?.iter().collect())
    }

    fn wholes(&self, name: &str) -> Result<Vec<u64>, StudyError> {
        self.maybe_wholes(name)?.into_iter().map(|count| count.ok_or_else(|| self.wrong(name))).collect()
    }

    fn values(&self) -> Result<Vec<Values>, StudyError> {
        let mut rows = vec![Values::new(); self.frame.height()];
        for column in column::COLUMNS {
            if self.frame.column(column.name).is_err() {
                continue;
            }
            let cells: Vec<Option<Value>> = match column.kind {
                Kind::Count => {
                    self.maybe_wholes(column.name)?.into_iter().map(|cell| cell.map(Value::Count)).collect()
                }
                Kind::Real => {
                    let cells = self.column(column.name)?.f64().map_err(|_| self.wrong(column.name))?;
                    cells.iter().map(|cell| cell.map(Value::Real)).collect()
                }
            };
            fill_column(&mut rows, column.name, &cells);
        }
        Ok(rows)
    }

    /// The frame as trials.
    pub fn trials(&self) -> Result<Vec<Row>, StudyError> {
        let texts = |name: &str| self.texts(name);
        let (mut trial, mut problem, mut group) = (texts("trial")?, texts("problem")?, texts("group")?);
        let (mut contender, mut sweep, mut reading) =
            (texts("contender")?, texts("sweep")?, texts("reading")?);
        let (status, mut reason) = (texts("status")?, self.maybe_texts("reason")?);
        let (replicate, repeat) = (self.wholes("replicate")?, self.wholes("repeat")?);
        let (seed, mut values) = (self.wholes("seed")?, self.values()?);
        (0..trial.len())
            .map(|i| {
                Ok(Row {
                    trial: take(&mut trial[i]),
                    problem: take(&mut problem[i]),
                    group: take(&mut group[i]),
                    replicate: replicate[i] as u32,
                    contender: take(&mut contender[i]),
                    sweep: take(&mut sweep[i]),
                    reading: take(&mut reading[i]),
                    repeat: repeat[i] as u32,
                    seed: seed[i],
                    status: Status::find(&status[i]).ok_or_else(|| self.wrong("status"))?,
                    reason: take(&mut reason[i]),
                    values: take(&mut values[i]),
                })
            })
            .collect()
    }

    /// The frame as prepared objects.
    pub fn prepared(&self) -> Result<Vec<PreparedRow>, StudyError> {
        let texts = |name: &str| self.texts(name);
        let (mut prepared, mut kind, mut group) = (texts("prepared")?, texts("kind")?, texts("group")?);
        let (mut reading, mut reason) = (texts("reading")?, self.maybe_texts("reason")?);
        let (replicate, seed, mut values) = (self.wholes("replicate")?, self.wholes("seed")?, self.values()?);
        let row = |i: usize| PreparedRow {
            prepared: take(&mut prepared[i]),
            kind: take(&mut kind[i]),
            group: take(&mut group[i]),
            replicate: replicate[i] as u32,
            reading: take(&mut reading[i]),
            seed: seed[i],
            reason: take(&mut reason[i]),
            values: take(&mut values[i]),
        };
        Ok((0..self.frame.height()).map(row).collect())
    }

    /// The frame as exhibits.
    pub fn exhibits(&self) -> Result<Vec<Kept>, StudyError> {
        let (mut of, mut name, width) = (self.texts("of")?, self.texts("name")?, self.wholes("width")?);
        let lists = self.column("values")?.list().map_err(|_| self.wrong("values"))?.clone();
        let mut kept = Vec::new();
        for i in 0..of.len() {
            let list = lists.get_as_series(i).ok_or_else(|| self.wrong("values"))?;
            let values = list.f64().map_err(|_| self.wrong("values"))?.into_no_null_iter().collect();
            let exhibit = Exhibit { name: take(&mut name[i]), width: width[i] as usize, values };
            kept.push(Kept { of: take(&mut of[i]), exhibit });
        }
        Ok(kept)
    }

    /// The frame as clock readings.
    pub fn times(&self) -> Result<Vec<Timing>, StudyError> {
        let (mut trial, mut group, mut contender) =
            (self.texts("trial")?, self.texts("group")?, self.texts("contender")?);
        let (replicate, repeat) = (self.wholes("replicate")?, self.wholes("repeat")?);
        let plan_wall_ns = self.wholes("plan_wall_ns")?;
        let row = |i: usize| Timing {
            trial: take(&mut trial[i]),
            group: take(&mut group[i]),
            contender: take(&mut contender[i]),
            replicate: replicate[i] as u32,
            repeat: repeat[i] as u32,
            plan_wall_ns: plan_wall_ns[i],
        };
        Ok((0..self.frame.height()).map(row).collect())
    }
}
