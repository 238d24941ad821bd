//! `MovingAI` grid maps (`.map`, type octile) and scenarios (`.scen`, versions 0, 1 and 1.0).
//!
//! The files count y downwards from the top row; cells here have y up, and [`Scenario`] is already turned. `.` and `G`
//! are ground and `S` is swamp, all passable. `@`, `O` (out of bounds) and `T` (trees) are blocked. `W` is water:
//! whoever starts in it may cross it, but none may enter it from ground. For a walker on ground it is therefore
//! blocked, and a scenario that starts in water starts in a blocked cell.
//!
//! Source: N. Sturtevant, *Benchmarks for Grid-Based Pathfinding*, IEEE T-CIAIG 4(2), 2012, and the format page of
//! movingai.com. Printed optimal lengths there assume that no corner is cut
//! ([`CornerRule::ForbidAny`](super::CornerRule::ForbidAny)).

use super::{CornerRule, Grid2, GridError, Moves, components, error};
use crate::text::unseen;
use std::cell::LazyCell;
use std::path::Path;
use std::str::FromStr;

/// One query of a scenario file.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Line in the file, from 1.
    pub line: usize,
    /// The benchmark's difficulty class.
    pub bucket: u32,
    /// The map as the file names it.
    pub map: String,
    /// Start cell.
    pub start: u32,
    /// Goal cell.
    pub goal: u32,
    /// Length of the shortest path as printed, in cells; `None` if it is printed as -1 or infinite: there is no path.
    pub optimal_length_cells: Option<f64>,
}

/// The grid in a `.map` text.
///
/// # Errors
/// [`GridError::Text`] on a wrong head, [`GridError::RowCount`], [`GridError::RowLength`], [`GridError::Letter`],
/// [`GridError::Size`].
pub fn parse_movingai_map(text: &str) -> Result<Grid2, GridError> {
    let lines: Vec<&str> = text.trim_end().lines().map(str::trim_end).collect();
    let words = |index: usize| lines.get(index).map_or(Vec::new(), |line| line.split_whitespace().collect());
    let wrong = |index: usize, accepted: &str| {
        let line = index + 1;
        let accepted = format!("`{accepted}`");
        if index < lines.len() {
            GridError::Text { line, found: words(index).join(" "), accepted }
        } else {
            GridError::Ends { line, accepted }
        }
    };
    let side = |index: usize, name: &str| match words(index)[..] {
        [key, value] if key == name => value.parse().map_err(|_| wrong(index, &format!("{name} N"))),
        _ => Err(wrong(index, &format!("{name} N"))),
    };
    if words(0) != ["type", "octile"] {
        return Err(wrong(0, "type octile"));
    }
    let (height, width) = (side(1, "height")?, side(2, "width")?);
    if words(3) != ["map"] {
        return Err(wrong(3, "map"));
    }
    let mut grid = Grid2::new(width, height)?;
    let rows = &lines[4..];
    // Before rows and cells are counted: none of those that are seen is at fault.
    let places =
        rows.iter().zip(5..).flat_map(|(row, line)| row.chars().zip(1..).map(move |(c, x)| (c, line, x)));
    if let Some((found, line, column)) = places.into_iter().find(|(c, ..)| unseen(*c).is_some()) {
        return Err(GridError::Letter { line, column, found, accepted: LETTERS });
    }
    if rows.len() != height as usize {
        return Err(GridError::RowCount { found: rows.len(), accepted: height as usize });
    }
    for (index, row) in rows.iter().enumerate() {
        fill_row(&mut grid, index, row)?;
    }
    Ok(grid)
}

/// The letters that a row may have, in words.
const LETTERS: &str = "`.` `G` `S` (passable) and `@` `O` `T` `W` (blocked)";

fn fill_row(grid: &mut Grid2, index: usize, row: &str) -> Result<(), GridError> {
    let line = index + 5;
    let found = row.chars().count();
    let width = grid.width();
    if found != width as usize {
        return Err(GridError::RowLength { line, found, accepted: width as usize });
    }
    let y = grid.height() - 1 - index as u32;
    for (x, letter) in row.chars().enumerate() {
        let blocked = match letter {
            '.' | 'G' | 'S' => false,
            '@' | 'O' | 'T' | 'W' => true,
            found => {
                return Err(GridError::Letter { line, column: x + 1, found, accepted: LETTERS });
            }
        };
        grid.set_blocked(y * width + x as u32, blocked);
    }
    Ok(())
}

/// The grid in the `.map` file at `path`.
///
/// # Errors
/// [`GridError::InFile`] around what [`parse_movingai_map`] refuses or around [`GridError::Unreadable`].
pub fn read_movingai_map(path: &Path) -> Result<Grid2, GridError> {
    error::read(path, parse_movingai_map)
}

/// The queries of a `.scen` text for `grid`, in the order of the file.
///
/// A text without a version line is of version 0, whose lines name no map size. Whether start and goal are free
/// is not checked here.
///
/// # Errors
/// [`GridError::Text`] on an unknown version, a wrong number of fields, a field that does not parse, a map size
/// that is not the grid's, or a cell outside it. A length that the map contradicts is refused too: -1 where a path
/// cuts no corner, or one where no path leads though all may be cut. A length may not be below the straight line, nor
/// above 0 where the goal is the start.
pub fn parse_scenarios(text: &str, grid: &Grid2) -> Result<Vec<Scenario>, GridError> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).peekable();
    let mut with_size = false;
    if let Some((index, line)) = lines.next_if(|(_, line)| line.starts_with("version")) {
        with_size = match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["version", "0"] => false,
            ["version", "1" | "1.0"] => true,
            _ => return Err(wrong_text(index + 1, line, "`version 0`, `version 1` or `version 1.0`")),
        };
    }
    let records: Vec<Record> = lines.map(|(index, text)| Record { line: index + 1, text }).collect();
    let read = records.iter().map(|record| record.scenario(grid, with_size));
    let scenarios = read.collect::<Result<Vec<Scenario>, GridError>>()?;
    let joined = |rule| components(grid, &Moves::new(grid, rule));
    let (narrow, wide) =
        (LazyCell::new(|| joined(CornerRule::ForbidAny)), LazyCell::new(|| joined(CornerRule::Allow)));
    for (scenario, record) in scenarios.iter().zip(&records) {
        let Scenario { start, goal, .. } = *scenario;
        let accepted = match scenario.optimal_length_cells {
            None if narrow.are_joined(start, goal) => "a length: a path that cuts no corner leads there",
            // What a blocked end has for a length means nothing.
            Some(_) if !grid.is_free(start) || !grid.is_free(goal) => continue,
            Some(length) if start == goal && length > ROUNDED_CELLS => "0: the goal is the start",
            Some(length) if length < straight_cells(grid, start, goal) - ROUNDED_CELLS => {
                "a length: the straight line is longer"
            }
            Some(_) if !wide.are_joined(start, goal) => "-1 or inf: no path leads there",
            _ => continue,
        };
        let found = record.text.split_whitespace().next_back().unwrap_or_default();
        return Err(GridError::Text { line: record.line, found: found.into(), accepted: accepted.into() });
    }
    Ok(scenarios)
}

/// The queries in the `.scen` file at `path`.
///
/// # Errors
/// [`GridError::InFile`] around what [`parse_scenarios`] refuses or around [`GridError::Unreadable`].
pub fn read_scenarios(path: &Path, grid: &Grid2) -> Result<Vec<Scenario>, GridError> {
    error::read(path, |text| parse_scenarios(text, grid))
}

/// How far a printed length may be from what it is: files were written by sums in single precision.
const ROUNDED_CELLS: f64 = 0.01;

fn straight_cells(grid: &Grid2, from: u32, to: u32) -> f64 {
    let [[x, y], [u, v]] = [from, to].map(|cell| grid.xy(cell).map(f64::from));
    libm::hypot(u - x, v - y)
}

fn wrong_text(line: usize, found: &str, accepted: &str) -> GridError {
    GridError::Text { line, found: found.trim().into(), accepted: accepted.into() }
}

/// One line of a scenario file.
struct Record<'a> {
    line: usize,
    text: &'a str,
}

impl Record<'_> {
    fn scenario(&self, grid: &Grid2, with_size: bool) -> Result<Scenario, GridError> {
        let fields: Vec<&str> = self.text.split_whitespace().collect();
        let (bucket, map, size, ends, length) = match fields[..] {
            [bucket, map, sx, sy, gx, gy, length] if !with_size => {
                (bucket, map, None, [sx, sy, gx, gy], length)
            }
            [bucket, map, w, h, sx, sy, gx, gy, length] if with_size => {
                (bucket, map, Some([w, h]), [sx, sy, gx, gy], length)
            }
            _ if with_size => {
                let accepted = "9 fields: bucket map width height start-x start-y goal-x goal-y length";
                return Err(wrong_text(self.line, self.text, accepted));
            }
            _ => {
                let accepted = "7 fields: bucket map start-x start-y goal-x goal-y length";
                return Err(wrong_text(self.line, self.text, accepted));
            }
        };
        if let Some([width, height]) = size {
            self.check_size(grid, width, height)?;
        }
        let accepted = "a length of 0 or more, or -1 or inf where there is no path";
        let printed: f64 = self.field(length, accepted)?;
        let has_path = (0.0..f64::INFINITY).contains(&printed);
        // In digits, an infinity is a number that is too large.
        let is_infinite = printed == f64::INFINITY && !length.contains(|c: char| c.is_ascii_digit());
        if !has_path && printed != -1.0 && !is_infinite {
            return Err(wrong_text(self.line, length, accepted));
        }
        Ok(Scenario {
            line: self.line,
            bucket: self.field(bucket, "a bucket number of 0 or more")?,
            map: map.into(),
            start: self.cell(grid, ends[0], ends[1])?,
            goal: self.cell(grid, ends[2], ends[3])?,
            // Of `-0` no sign is kept.
            optimal_length_cells: has_path.then_some(printed.abs()),
        })
    }

    fn field<T: FromStr>(&self, found: &str, accepted: &str) -> Result<T, GridError> {
        found.parse().map_err(|_| wrong_text(self.line, found, accepted))
    }

    fn check_size(&self, grid: &Grid2, width: &str, height: &str) -> Result<(), GridError> {
        let accepted = format!("the map's size, {} {}", grid.width(), grid.height());
        let found: [u32; 2] = [self.field(width, &accepted)?, self.field(height, &accepted)?];
        if found == [grid.width(), grid.height()] {
            return Ok(());
        }
        Err(wrong_text(self.line, &format!("{width} {height}"), &accepted))
    }

    /// The cell at `x` from the left and `y` from the top.
    fn cell(&self, grid: &Grid2, x: &str, y: &str) -> Result<u32, GridError> {
        let accepted = format!("a cell with x below {} and y below {}", grid.width(), grid.height());
        let [x, y]: [i32; 2] = [self.field(x, &accepted)?, self.field(y, &accepted)?];
        let from_bottom = (grid.height() as i32 - 1).checked_sub(y);
        from_bottom
            .and_then(|up| grid.cell(x, up))
            .ok_or_else(|| wrong_text(self.line, &format!("{x} {y}"), &accepted))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAP: &str = "type octile\nheight 2\nwidth 7\nmap\n.GS@OTW\n.......\n";

    #[test]
    fn letters_mean_what_the_benchmark_says_and_the_first_row_is_the_top() {
        for text in [MAP, &MAP.replace('\n', "\r\n"), MAP.trim_end()] {
            let grid = parse_movingai_map(text).unwrap();
            let top: Vec<bool> = (0..7).map(|x| grid.is_free_xy(x, 1)).collect();
            assert_eq!(top, [true, true, true, false, false, false, false]);
            assert_eq!(grid.free_count(), 10);
        }
    }

    #[test]
    fn bad_maps_are_refused_with_line_and_what_is_accepted() {
        let letters = LETTERS;
        for (text, message) in [
            (String::new(), "the file is empty; accepted is `type octile`".to_owned()),
            ("\n \n".to_owned(), "the file is empty; accepted is `type octile`".to_owned()),
            ("type octile\n".to_owned(), "the file ends before line 2; accepted is `height N`".to_owned()),
            (MAP.replace("octile", "tile"), "line 1: found `type tile`; accepted is `type octile`".into()),
            (
                MAP.replace("height 2", "height two"),
                "line 2: found `height two`; accepted is `height N`".into(),
            ),
            (MAP.replace("width 7", "width"), "line 3: found `width`; accepted is `width N`".into()),
            (MAP.replace("map", "grid"), "line 4: found `grid`; accepted is `map`".into()),
            (MAP.replace("height 2", "height 3"), "found 2 rows of cells; the header promises 3".into()),
            (MAP.replace("TW", "T"), "line 5: found a row of 6 cells; every row must have 7".into()),
            (MAP.replace('O', "x"), format!("line 5, column 5: found `x`; a cell is one of {letters}")),
            (
                MAP.replace("OT", "O\u{200b}T"),
                format!("line 5, column 6: found `‹zero-width space›`; a cell is one of {letters}"),
            ),
            (format!("{MAP}\0\0\n"), format!("line 7, column 1: found `‹NUL›`; a cell is one of {letters}")),
            (
                MAP.replace("width 7", "width 0"),
                "a grid of 0 × 2 cells; each side may have 1 to 65535 cells, and all may have 16777216"
                    .into(),
            ),
        ] {
            assert_eq!(parse_movingai_map(&text).unwrap_err().to_string(), message, "{text:?}");
        }
    }

    #[test]
    fn all_versions_read_the_same_queries_with_y_up() {
        let grid = parse_movingai_map(MAP).unwrap();
        let without_size = "3\tm.map\t0\t0\t6\t1\t6.41421356\n";
        let with_size = "3\tm.map\t7\t2\t0\t0\t6\t1\t6.41421356\n";
        let texts = [
            without_size.to_owned(),
            format!("version 0\n{without_size}"),
            format!("version 1\n{with_size}"),
            format!("version 1.0\n{with_size}"),
        ];
        for text in texts {
            let [query] = &parse_scenarios(&text, &grid).unwrap()[..] else { panic!("{text}") };
            assert_eq!((grid.xy(query.start), grid.xy(query.goal)), ([0, 1], [6, 0]), "{text}");
            assert_eq!(
                (query.bucket, &query.map[..], query.optimal_length_cells),
                (3, "m.map", Some(6.414_213_56))
            );
        }
    }

    #[test]
    fn a_length_of_minus_one_or_infinity_says_that_there_is_no_path() {
        let grid = parse_movingai_map(MAP).unwrap();
        // The goal is blocked.
        for (length, read) in
            [("-1", None), ("-1.0", None), ("inf", None), ("Infinity", None), ("3", Some(3.0))]
        {
            let [query] = &parse_scenarios(&format!("0 m 0 0 3 0 {length}\n"), &grid).unwrap()[..] else {
                panic!()
            };
            assert_eq!(query.optimal_length_cells, read, "{length}");
        }
        let unsigned = parse_scenarios("0 m 0 0 0 0 -0\n", &grid).unwrap()[0].optimal_length_cells;
        assert_eq!(unsigned.map(f64::to_bits), Some(0));
        for length in ["-2", "-inf", "NaN", "1e400"] {
            assert!(parse_scenarios(&format!("0 m 0 0 1 1 {length}\n"), &grid).is_err(), "{length}");
        }
    }

    #[test]
    fn a_length_that_the_map_contradicts_is_refused_at_its_line() {
        // The upper left part touches the lower right one at a corner, and the last column nothing.
        let grid = parse_movingai_map("type octile\nheight 2\nwidth 5\nmap\n..@@.\n@@.@.\n").unwrap();
        let read = |ends: &str, length: &str| {
            let text = format!("version 0\n0 m 0 0 0 0 0\n0 m {ends} {length}\n");
            parse_scenarios(&text, &grid).map_err(|error| error.to_string())
        };
        for (ends, length) in
            [("0 0 1 0", "1"), ("0 0 2 1", "-1"), ("0 0 2 1", "2.414"), ("0 0 4 0", "-1"), ("0 0 3 0", "9")]
        {
            assert_eq!(read(ends, length).map(|all| all.len()), Ok(2), "{ends} {length}");
        }
        for (ends, length, accepted) in [
            ("0 0 1 0", "-1", "a length: a path that cuts no corner leads there"),
            ("0 0 0 0", "inf", "a length: a path that cuts no corner leads there"),
            ("0 0 4 0", "4.0", "-1 or inf: no path leads there"),
            ("0 0 1 0", "0.98", "a length: the straight line is longer"),
            ("0 0 0 0", "1", "0: the goal is the start"),
        ] {
            let expected = format!("line 3: found `{length}`; accepted is {accepted}");
            assert_eq!(read(ends, length), Err(expected), "{ends} {length}");
        }
    }

    #[test]
    fn bad_scenarios_are_refused_with_line_and_what_is_accepted() {
        let grid = parse_movingai_map(MAP).unwrap();
        let nine = "9 fields: bucket map width height start-x start-y goal-x goal-y length";
        for (text, message) in [
            (
                "version 2\n",
                "line 1: found `version 2`; accepted is `version 0`, `version 1` or `version 1.0`".to_owned(),
            ),
            ("version 1\n0 m 0 0 1 1 1\n", format!("line 2: found `0 m 0 0 1 1 1`; accepted is {nine}")),
            ("version 1\n0 m 7 3 0 0 1 1 1\n", "line 2: found `7 3`; accepted is the map's size, 7 2".into()),
            (
                "0 m 0 0 1 2 1\n",
                "line 1: found `1 2`; accepted is a cell with x below 7 and y below 2".into(),
            ),
            (
                "0 m -1 0 1 1 1\n",
                "line 1: found `-1 0`; accepted is a cell with x below 7 and y below 2".into(),
            ),
            (
                "0 m 0 0 1 1 far\n",
                "line 1: found `far`; accepted is a length of 0 or more, or -1 or inf where there is no path"
                    .into(),
            ),
            (
                "0 m 0 0 1 1 NaN\n",
                "line 1: found `NaN`; accepted is a length of 0 or more, or -1 or inf where there is no path"
                    .into(),
            ),
            ("x m 0 0 1 1 1\n", "line 1: found `x`; accepted is a bucket number of 0 or more".into()),
        ] {
            assert_eq!(parse_scenarios(text, &grid).unwrap_err().to_string(), message, "{text:?}");
        }
        let error = read_scenarios(Path::new("nowhere/none.scen"), &grid).unwrap_err().to_string();
        assert!(error.starts_with("nowhere/none.scen: cannot be read: "), "{error}");
    }
}
