//! Questions and answers as Parquet files.
//!
//! Beside `<model>.xml` lie `<model>.questions.parquet` (one row a configuration: `q1`, `q2`, …, radians, and what is
//! asked besides contact: `frames`, `gaps`, `limits`), and, once the judge has answered,
//!
//! - `<model>.touch.parquet`: one row a configuration, one column a pair, whether the two touch;
//! - `<model>.gaps.parquet`, `.frames.parquet`, `.limits.parquet`: one row a configuration that was asked for
//!   distances (a column a pair, metres), frames (`link_1.x`, … `link_1.zz`: place and rotation, row by row) or limits
//!   (a column a joint, whether it is beyond), in the order of the questions.

use super::CrosscheckError;
use super::sample::Question;
use polars::prelude::{Column, DataFrame, NamedFrom as _, Series};
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use study::parquet::{FrameReader, write_frame};

/// How the name of the table ends that every answered model has.
pub const ANSWERED: &str = ".touch.parquet";

/// A table that was read.
pub struct Table {
    path: PathBuf,
    frame: DataFrame,
}

/// Where the table `part` of `model` lies in `folder`.
pub fn place(folder: &Path, model: &str, part: &str) -> PathBuf {
    folder.join(format!("{model}.{part}.parquet"))
}

/// Writes the questions about a model with this many joints.
pub fn write_questions(path: &Path, joints: usize, questions: &[Question]) -> Result<(), CrosscheckError> {
    let flag = |name: &str, get: fn(&Question) -> bool| -> Column {
        Series::new(name.into(), questions.iter().map(get).collect::<Vec<bool>>()).into()
    };
    let mut columns: Vec<Column> = (0..joints)
        .map(|joint| {
            let angles: Vec<f64> = questions.iter().map(|question| question.q_rad[joint]).collect();
            Series::new(format!("q{}", joint + 1).into(), angles).into()
        })
        .collect();
    columns.push(flag("frames", |question| question.frames));
    columns.push(flag("gaps", |question| question.gaps));
    columns.push(flag("limits", |question| question.limits));
    write(path, questions.len(), columns)
}

fn write(path: &Path, height: usize, columns: Vec<Column>) -> Result<(), CrosscheckError> {
    let frame = DataFrame::new(height, columns).expect("columns are as long as the questions are many");
    let mut bytes = Vec::new();
    write_frame(&mut bytes, frame, Vec::new()).expect("a frame of equally long columns is written to memory");
    fs::write(path, bytes).map_err(|source| CrosscheckError::Io { path: path.to_owned(), source })
}

impl Table {
    /// Reads the table at `path`, which must have `rows` rows.
    ///
    /// # Errors
    /// [`CrosscheckError::Answer`] if it is missing, no Parquet file, or of another height.
    pub fn read(path: PathBuf, rows: usize) -> Result<Self, CrosscheckError> {
        let wrong = |reason: String| CrosscheckError::Answer { path: path.clone(), reason };
        let bytes = fs::read(&path).map_err(|e| wrong(format!("cannot be read ({e})")))?;
        let frame = FrameReader::open(Cursor::new(bytes)).and_then(|mut file| file.frame());
        let frame = frame.map_err(|e| wrong(format!("is not a Parquet file: {e}")))?;
        if frame.height() != rows {
            return Err(wrong(format!("has {} rows; {rows} were asked for", frame.height())));
        }
        Ok(Self { path, frame })
    }

    fn wrong(&self, reason: String) -> CrosscheckError {
        CrosscheckError::Answer { path: self.path.clone(), reason }
    }

    fn column(&self, name: &str) -> Result<&Column, CrosscheckError> {
        self.frame
            .column(name)
            .map_err(|_| self.wrong(format!("has no column `{name}`, which was asked for")))
    }

    /// A column of numbers.
    ///
    /// # Errors
    /// [`CrosscheckError::Answer`] if it is missing, not numbers, or has gaps.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, CrosscheckError> {
        let cells = self.column(name)?.f64().ok().filter(|cells| cells.null_count() == 0);
        let cells = cells
            .ok_or_else(|| self.wrong(format!("column `{name}` does not hold a number in every row")))?;
        Ok(cells.into_no_null_iter().collect())
    }

    /// A column of truths.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub fn truths(&self, name: &str) -> Result<Vec<bool>, CrosscheckError> {
        let cells = self.column(name)?.bool().ok().filter(|cells| cells.null_count() == 0);
        let cells = cells
            .ok_or_else(|| self.wrong(format!("column `{name}` does not say yes or no in every row")))?;
        Ok(cells.iter().flatten().collect())
    }
}
