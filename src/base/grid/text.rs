//! Text maps: a picture of the grid, `#` blocked and `.` free.
//!
//! The first row is the highest y. Lines that start with `;` are comments and blank lines are skipped, so that a
//! map can say where it is from.

use super::{Grid2, GridError, error};
use std::path::Path;

/// The grid drawn in `text`.
///
/// # Errors
/// [`GridError::NoRows`], [`GridError::RowLength`] if the rows differ, [`GridError::Letter`] on any character but
/// `#` and `.`, [`GridError::Size`] if a side is too long.
pub fn parse_text_map(text: &str) -> Result<Grid2, GridError> {
    let rows: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line.trim_end()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with(';'))
        .collect();
    let Some(&(_, first)) = rows.first() else { return Err(GridError::NoRows) };
    let width = first.chars().count();
    let mut grid = Grid2::new(width as u32, rows.len() as u32)?;
    for (&(line, row), y) in rows.iter().zip((0..grid.height()).rev()) {
        let found = row.chars().count();
        if found != width {
            return Err(GridError::RowLength { line, found, accepted: width });
        }
        for (x, letter) in row.chars().enumerate() {
            let blocked = match letter {
                '#' => true,
                '.' => false,
                found => {
                    let accepted = "`#` (blocked) and `.` (free)";
                    return Err(GridError::Letter { line, column: x + 1, found, accepted });
                }
            };
            grid.set_blocked(y * width as u32 + x as u32, blocked);
        }
    }
    Ok(grid)
}

/// The picture of `grid`, as [`parse_text_map`] reads it.
pub fn to_text_map(grid: &Grid2) -> String {
    let cell = |x, y| if grid.is_free_xy(x, y) { '.' } else { '#' };
    let row = |y| (0..grid.width() as i32).map(|x| cell(x, y)).chain(['\n']).collect::<String>();
    (0..grid.height() as i32).rev().map(row).collect()
}

/// The grid drawn in the file at `path`.
///
/// # Errors
/// [`GridError::InFile`] around what [`parse_text_map`] refuses or around [`GridError::Unreadable`].
pub fn read_text_map(path: &Path) -> Result<Grid2, GridError> {
    error::read(path, parse_text_map)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_row_is_the_highest() {
        let grid = parse_text_map("; where it is from\n#..\n\n..#\n").unwrap();
        assert_eq!((grid.width(), grid.height(), grid.free_count()), (3, 2, 4));
        assert!(!grid.is_free_xy(0, 1) && !grid.is_free_xy(2, 0));
        assert_eq!(to_text_map(&grid), "#..\n..#\n");
    }

    #[test]
    fn bad_maps_are_refused_by_line_and_column() {
        for (text, message) in [
            ("", "found no row of cells; at least one is needed"),
            ("; only a comment\n", "found no row of cells; at least one is needed"),
            ("..\n...\n", "line 2: found a row of 3 cells; every row must have 2"),
            ("..\n.x\n", "line 2, column 2: found `x`; a cell is one of `#` (blocked) and `.` (free)"),
        ] {
            assert_eq!(parse_text_map(text).unwrap_err().to_string(), message, "{text:?}");
        }
    }

    #[test]
    fn a_missing_or_binary_file_is_named() {
        let error = read_text_map(Path::new("nowhere/none.map.txt")).unwrap_err().to_string();
        assert!(error.starts_with("nowhere/none.map.txt: cannot be read: "), "{error}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("binary.map.txt");
        std::fs::write(&path, [0xff, 0xfe, b'.']).unwrap();
        let error = read_text_map(&path).unwrap_err().to_string();
        assert!(error.contains("binary.map.txt: cannot be read: ") && error.contains("UTF-8"), "{error}");
    }
}
