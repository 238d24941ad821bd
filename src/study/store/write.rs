//! Records on their way to their files: of each file one group of rows is in memory.

use super::traces::GROUP_VALUES;
use super::{Columns, Hashed, Staged, Traces, part_path, table};
use crate::StudyError;
use crate::key::{KeyColumns, SweepKey};
use crate::parquet::{FrameWriter, GROUP_ROWS};
use crate::record::{Batch, Kept, PreprocessingRow, Row, Timing};
use polars::prelude::{DataFrame, PolarsError};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::mem;
use std::path::{Path, PathBuf};

/// A file at work whose rows come one by one and are written in groups.
pub struct GroupWriter<'k, T, W: Write> {
    /// Where the file goes until the first group says which columns it has.
    out: Option<W>,
    file: Option<FrameWriter<W>>,
    keys: &'k KeyColumns,
    frame: Box<dyn FnMut(&[T]) -> DataFrame + 'k>,
    weight: fn(&T) -> usize,
    most: usize,
    group: Vec<T>,
    held: usize,
}

impl<'k, T, W: Write> GroupWriter<'k, T, W> {
    /// Begins a file in `out` of what `frame` makes of rows. The weights of a group add up to `most`, unless one row weighs more.
    pub fn new(
        out: W,
        keys: &'k KeyColumns,
        (weight, most): (fn(&T) -> usize, usize),
        frame: impl FnMut(&[T]) -> DataFrame + 'k,
    ) -> Self {
        let frame = Box::new(frame);
        Self { out: Some(out), file: None, keys, frame, weight, most, group: Vec::new(), held: 0 }
    }

    /// Adds a row; rows come in the order of records.
    ///
    /// # Errors
    /// What the system refused.
    pub fn add(&mut self, row: T) -> io::Result<()> {
        let weight = (self.weight)(&row);
        if !self.group.is_empty() && self.held + weight > self.most {
            self.flush()?;
        }
        self.held += weight;
        self.group.push(row);
        Ok(())
    }

    /// Ends the file, which has its columns even if no row came.
    ///
    /// # Errors
    /// As [`add`](Self::add).
    pub fn finish(mut self) -> io::Result<W> {
        self.flush()?;
        self.file.expect("a group was written").finish().map_err(io_error)
    }

    fn flush(&mut self) -> io::Result<()> {
        let frame = (self.frame)(&mem::take(&mut self.group));
        self.held = 0;
        if let Some(out) = self.out.take() {
            let entries = table::description(&frame, self.keys);
            self.file = Some(FrameWriter::new(out, &frame, entries).map_err(io_error)?);
        }
        self.file.as_mut().expect("it was begun").write(frame).map_err(io_error)
    }
}

fn io_error(error: PolarsError) -> io::Error {
    match error {
        PolarsError::IO { error, .. } => io::Error::new(error.kind(), error.to_string()),
        // The Parquet library words what the system refused as a fault of the format.
        other => {
            let text = other.to_string();
            io::Error::other(text.rsplit("underlying IO error: ").next().unwrap_or_default().to_owned())
        }
    }
}

/// What must be known of records before the first of them is written.
#[derive(Debug, Clone, Default)]
pub struct Shape {
    /// The columns that preprocessed objects fill.
    pub filled: BTreeSet<&'static str>,
    /// The sweep of a trace that belongs to a trial, if any does.
    pub sweep: Option<SweepKey>,
    /// How many numbers of traces at most are read back at a time.
    pub group_values: usize,
}

impl Shape {
    /// The writer of traces with this `sweep`, beside objects whose columns are not noted yet.
    pub fn new(sweep: Option<SweepKey>) -> Self {
        Self { sweep, group_values: GROUP_VALUES, ..Self::default() }
    }

    /// Notes the columns of `rows`.
    pub fn note<'r>(&mut self, rows: impl IntoIterator<Item = &'r PreprocessingRow>) {
        let names = rows.into_iter().flat_map(|row| row.values.iter().map(|(column, _)| column.name));
        self.filled.extend(names);
    }
}

/// One file of a study's records.
struct PartFile<'k, T> {
    path: PathBuf,
    file: GroupWriter<'k, T, Hashed>,
}

impl<T> PartFile<'_, T> {
    fn add(&mut self, row: T) -> Result<(), StudyError> {
        self.file.add(row).map_err(StudyError::io(&self.path, "writing the file"))
    }

    fn finish(self) -> Result<String, StudyError> {
        self.file.finish().and_then(Hashed::finish).map_err(StudyError::io(&self.path, "writing the file"))
    }
}

/// The files of a study's records at work.
pub struct RecordWriter<'c> {
    trials: PartFile<'c, Row>,
    preprocessing: PartFile<'c, PreprocessingRow>,
    traces: PartFile<'c, Kept>,
    times: PartFile<'c, Timing>,
}

impl<'c> RecordWriter<'c> {
    /// Begins the files of `study`'s records, staged for `folder`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn new(
        staged: &mut Staged,
        folder: &Path,
        study: &str,
        columns: &'c Columns,
        shape: Shape,
    ) -> Result<Self, StudyError> {
        let keys = &columns.keys;
        let mut begin = |part: &str| -> Result<(PathBuf, Hashed), StudyError> {
            let path = part_path(folder, study, part);
            let out = staged.begin(&path)?;
            Ok((path, out))
        };
        let Shape { filled, sweep, group_values } = shape;
        let (path, out) = begin("trials")?;
        let mut first = None;
        let frame = move |rows: &[Row]| {
            // Later groups have sweeps of the kinds that the first has.
            first = first.take().or_else(|| rows.first().map(|row| row.key.sweep.clone()));
            table::trials(rows, keys, &columns.values, first.as_ref())
        };
        let trials = PartFile { path, file: GroupWriter::new(out, keys, (|_| 1, GROUP_ROWS), frame) };
        let (path, out) = begin("preprocessing")?;
        let frame = move |rows: &[PreprocessingRow]| table::preprocessing(rows, keys, &filled);
        let preprocessing = PartFile { path, file: GroupWriter::new(out, keys, (|_| 1, GROUP_ROWS), frame) };
        let (path, out) = begin("traces")?;
        let frame = move |kept: &[Kept]| table::traces(kept, keys, sweep.as_ref());
        let weight = |kept: &Kept| kept.trace.values.len();
        let traces = PartFile { path, file: GroupWriter::new(out, keys, (weight, group_values), frame) };
        let (path, out) = begin("times")?;
        let frame = move |times: &[Timing]| table::times(times, keys);
        let times = PartFile { path, file: GroupWriter::new(out, keys, (|_| 1, GROUP_ROWS), frame) };
        Ok(Self { trials, preprocessing, traces, times })
    }

    /// Adds what one unit gave; units come in the order of records.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn add(&mut self, batch: Batch) -> Result<(), StudyError> {
        batch.rows.into_iter().try_for_each(|row| self.trials.add(row))?;
        batch.preprocessing.into_iter().try_for_each(|row| self.preprocessing.add(row))?;
        batch.kept.into_iter().try_for_each(|kept| self.traces.add(kept))
    }

    /// Ends the files with these times; the hash of each by its part.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn finish(mut self, times: &[Timing]) -> Result<BTreeMap<String, String>, StudyError> {
        times.iter().cloned().try_for_each(|time| self.times.add(time))?;
        let hashes = [
            ("trials", self.trials.finish()?),
            ("preprocessing", self.preprocessing.finish()?),
            ("traces", self.traces.finish()?),
            ("times", self.times.finish()?),
        ];
        Ok(hashes.map(|(part, hash)| (part.to_owned(), hash)).into())
    }

    /// Adds the rows and preprocessed objects of `batch`, then `traces` in place of its own.
    pub(super) fn add_with(&mut self, batch: &Batch, mut traces: Traces<'_>) -> Result<(), StudyError> {
        batch.rows.iter().cloned().try_for_each(|row| self.trials.add(row))?;
        batch.preprocessing.iter().cloned().try_for_each(|row| self.preprocessing.add(row))?;
        traces.each.try_for_each(|kept| self.traces.add(kept?))
    }
}
