//! A table of results as it was found: texts under heads, each row with its place.

use crate::error::StudyError;
use crate::parquet::FrameReader;
use crate::store::{UNREADABLE, unpanicked};
use base::hash::sha256;
use base::text::decoded;
use polars::prelude::{AnyValue, PolarsError};
use std::io::Cursor;
use std::panic::AssertUnwindSafe;
use std::path::{Path, PathBuf};

/// Texts under heads.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    hash: String,
    /// What a row's number is called in messages.
    pub(super) unit: &'static str,
    /// The columns' heads, from the left.
    pub(super) heads: Vec<String>,
    /// The heads of columns whose cells are neither texts nor numbers nor booleans.
    others: Vec<String>,
    /// The rows, each with its number in the file.
    pub(super) rows: Vec<(usize, Vec<String>)>,
}

impl Table {
    pub(super) fn new(path: &Path, bytes: &[u8], unit: &'static str) -> Self {
        Self {
            path: path.to_owned(),
            hash: sha256(bytes),
            unit,
            heads: Vec::new(),
            others: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// The table in the file at `path`, comma-separated values under a line of heads.
    ///
    /// # Errors
    /// A file that cannot be read; a line that has not as many cells as the first.
    pub fn read_csv(path: &Path) -> Result<Self, StudyError> {
        let bytes = bytes(path)?;
        let mut table = Self::new(path, &bytes, "line");
        let text = decoded(bytes).map_err(|what| table.error(&what))?;
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
        for record in reader.records() {
            let record = record.map_err(|error| {
                let line = error.position().map_or(0, csv::Position::line);
                let message = match error.kind() {
                    csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                        format!("line {line}: has {len} cells; {expected_len} are accepted, as many as the first line has")
                    }
                    _ => format!("line {line}: {error}"),
                };
                table.error(&message)
            })?;
            let cells = record.iter().map(|cell| cell.trim().to_owned()).collect();
            let line = record.position().map_or(0, |position| position.line() as usize);
            if table.heads.is_empty() { table.heads = cells } else { table.rows.push((line, cells)) }
        }
        // The reader takes the end of the file for the quote that is missing.
        if text.matches('"').count() % 2 == 1 {
            let line = table.rows.last().map_or(1, |(line, _)| *line);
            return Err(
                table.error(&format!("line {line}: a `\"` that opens a cell has no other that ends it"))
            );
        }
        table.checked()
    }

    /// The table in the Parquet file at `path`: its columns of texts, numbers and booleans.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read_parquet(path: &Path) -> Result<Self, StudyError> {
        let bytes = bytes(path)?;
        let mut table = Self::new(path, &bytes, "row");
        let read = || {
            let mut reader = FrameReader::open(Cursor::new(bytes))?;
            let others = reader.leave_out_others();
            Ok::<_, PolarsError>((reader.frame()?, others))
        };
        let frame = match unpanicked(AssertUnwindSafe(read)) {
            Some(Ok((frame, others))) => {
                table.others = others;
                frame
            }
            Some(Err(error)) => {
                let packed = "columns packed by gzip, snappy, zstd or not at all are accepted";
                return Err(table.error(&format!("{UNREADABLE} ({error}); {packed}")));
            }
            None => return Err(table.error(&format!("{UNREADABLE}: its lengths do not fit"))),
        };
        table.heads = frame.columns().iter().map(|column| column.name().to_string()).collect();
        let cell = |row: usize| {
            move |column: &polars::prelude::Column| match column.get(row) {
                Ok(AnyValue::Null) | Err(_) => String::new(),
                Ok(AnyValue::String(text)) => text.to_owned(),
                Ok(AnyValue::Float32(real)) => real.to_string(),
                Ok(AnyValue::Float64(real)) => real.to_string(),
                Ok(other) => other.to_string(),
            }
        };
        table.rows = (0..frame.height())
            .map(|row| (row + 1, frame.columns().iter().map(cell(row)).collect()))
            .collect();
        table.checked()
    }

    fn checked(self) -> Result<Self, StudyError> {
        if self.rows.is_empty() {
            return Err(self.error("holds no row below its heads"));
        }
        Ok(self)
    }

    /// The place of the column called `head`.
    pub(super) fn column(&self, head: &str) -> Result<usize, StudyError> {
        let mut found = (0..self.heads.len()).filter(|place| self.heads[*place] == head);
        match (found.next(), found.next()) {
            (Some(place), None) => Ok(place),
            (Some(_), Some(_)) => Err(self.error(&format!("has two columns `{head}`"))),
            (None, _) if self.others.iter().any(|other| other == head) => {
                Err(self.error(&format!("column `{head}` holds neither texts nor numbers nor booleans")))
            }
            (None, _) => {
                let known = self.heads.iter().map(String::as_str);
                Err(self.error(&base::settings::none_called("column", head, known)))
            }
        }
    }

    /// Whether it has a column called `head`.
    pub fn has(&self, head: &str) -> bool {
        self.heads.iter().any(|own| own == head)
    }

    /// `line 7`.
    pub(super) fn place(&self, number: usize) -> String {
        format!("{} {number}", self.unit)
    }

    /// An error about the file.
    pub fn error(&self, message: &str) -> StudyError {
        StudyError::Missing { path: self.path.clone(), what: base::text::one_line(message) }
    }

    /// The file's name and its hash.
    pub fn source(&self) -> String {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        format!("{} (sha256 {})", base::text::one_line(&name), self.hash)
    }
}

/// The bytes of the file at `path`, which is no database.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>, StudyError> {
    let bytes = base::file::read(path).map_err(StudyError::io(path, "reading the table"))?;
    if bytes.starts_with(b"SQLite format 3\0") {
        let what = "is an SQLite database, as Planner Arena has; the benchmark logs that it was made of are accepted";
        return Err(StudyError::Missing { path: path.to_owned(), what: what.to_owned() });
    }
    Ok(bytes)
}
