//! What can be wrong with a grid or with a file that describes one.

use super::{MAX_CELLS, MAX_SIDE_CELLS, MAX_SIDE_NODES};
use crate::file;
use crate::text::{brief, visible};
use std::path::{Path, PathBuf};

/// Why a grid, a map file or a scenario file was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// A side is zero or too long, or the cells are too many.
    #[error(
        "a grid of {width} × {height} cells; each side may have 1 to {MAX_SIDE_CELLS} cells, and all may have {MAX_CELLS}"
    )]
    Size {
        /// Columns requested.
        width: u32,
        /// Rows requested.
        height: u32,
    },
    /// A side of a lattice in space is zero or too long, or the nodes are too many.
    #[error(
        "a lattice of {} × {} × {} nodes; each side may have 1 to {MAX_SIDE_NODES} nodes, and all may have {MAX_CELLS}",
        size[0], size[1], size[2]
    )]
    Space {
        /// Nodes along x, y and z.
        size: [u32; 3],
    },
    /// A map without a single row.
    #[error("found no row of cells; at least one is needed")]
    NoRows,
    /// A row is shorter or longer than it must be.
    #[error("line {line}: found a row of {found} cells; every row must have {accepted}")]
    RowLength {
        /// Line in the file, from 1.
        line: usize,
        /// Cells in the row.
        found: usize,
        /// Cells it must have.
        accepted: usize,
    },
    /// More or fewer rows than the header promises.
    #[error("found {found} rows of cells; the header promises {accepted}")]
    RowCount {
        /// Rows present.
        found: usize,
        /// Rows promised.
        accepted: usize,
    },
    /// A character that stands for no kind of cell.
    #[error("line {line}, column {column}: found `{}`; a cell is one of {accepted}", visible(&found.to_string()))]
    Letter {
        /// Line in the file, from 1.
        line: usize,
        /// Column in the line, from 1.
        column: usize,
        /// The character.
        found: char,
        /// The characters that are read, in words.
        accepted: &'static str,
    },
    /// A line of a file's head or a field of a record does not read as it must.
    #[error("line {line}: found `{}`; accepted is {accepted}", brief(found))]
    Text {
        /// Line in the file, from 1.
        line: usize,
        /// What stands there.
        found: String,
        /// What may stand there.
        accepted: String,
    },
    /// A file ends before a line of its head.
    #[error("the file {}; accepted is {accepted}", ending(*line))]
    Ends {
        /// The line that it has not, from 1.
        line: usize,
        /// What may stand there.
        accepted: String,
    },
    /// The file cannot be read as text.
    #[error("cannot be read: {reason}")]
    Unreadable {
        /// The system's reason.
        reason: String,
    },
    /// What stands beside a map, such as the YAML file of an image, is wrong, at its place.
    #[error("{message}")]
    Reported {
        /// The place and what is wrong.
        message: String,
    },
    /// Any of the above, in a file.
    #[error("{}: {source}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong in it.
        source: Box<GridError>,
    },
}

/// Where a file ends that has no line of this number, from 1.
fn ending(line: usize) -> String {
    if line == 1 { "is empty".to_owned() } else { format!("ends before line {line}") }
}

/// Reads the file at `path` and parses it, so that every error names the file once.
pub(super) fn read<T>(path: &Path, parse: impl Fn(&str) -> Result<T, GridError>) -> Result<T, GridError> {
    file::read_text(path)
        .map_err(|error| GridError::Unreadable { reason: error.to_string() })
        .and_then(|text| parse(&text))
        .map_err(|source| GridError::InFile { path: path.to_owned(), source: Box::new(source) })
}
