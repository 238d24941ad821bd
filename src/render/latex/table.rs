//! Tables: heads, rows and groups, with lines broken so that they fit the text.

use super::{RenderError, escaped};
use std::fmt::Write as _;

/// How many characters fit a line of an article's text in footnotesize.
const TEXT_CHARACTERS: usize = 80;

/// The longest lines of cells that are tried, one after another.
const LINE_WIDTHS: [usize; 9] = [60, 40, 30, 24, 18, 14, 11, 8, 6];

/// Sets the table in box 0, scaled to the text if it is wider and `graphicx` is there to do so.
const FITTED: &str = "\\ifdim\\wd0>\\textwidth\\ifdefined\\resizebox\\resizebox{\\textwidth}{!}{\\usebox0}\\else\\usebox0\\fi\\else\\usebox0\\fi\n";

/// `text` in lines of at most `most` characters, broken at spaces only.
fn lines(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.last_mut().expect("there is always a line");
        if last.is_empty() {
            last.push_str(word);
        } else if last.chars().count() + 1 + word.chars().count() <= most {
            last.push(' ');
            last.push_str(word);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// What must stand before `line`: a bracket or star behind `\\` would be read as an argument of it.
fn guard(line: &str) -> &'static str {
    if line.starts_with(['[', '*']) { "{}" } else { "" }
}

/// `text`, escaped, as it stands or one line above another.
fn stacked(text: &str, most: usize, column: Column, corner: char) -> String {
    let lines: Vec<String> = lines(text, most).iter().map(|line| escaped(line)).collect();
    if let [line] = &lines[..] {
        return line.clone();
    }
    let letter = column_letter(column);
    let safe: Vec<String> = lines.iter().map(|line| format!("{}{line}", guard(line))).collect();
    let body = safe.join("\\\\");
    format!("\\begin{{tabular}}[{corner}]{{@{{}}{letter}@{{}}}}{body}\\end{{tabular}}")
}

/// Where a column's cells stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Text.
    Left,
    /// Short marks.
    Centre,
    /// Numbers with equal decimals.
    Right,
}

/// One cell of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cell {
    /// Text; it is escaped.
    Text(String),
    /// Text in bold; it is escaped.
    Bold(String),
    /// The inside of `$…$`, as written.
    Math(String),
    /// Text across several columns, centred; it is escaped. With a rule below it in a head.
    Across(usize, String),
}

impl Cell {
    fn columns(&self) -> usize {
        if let Self::Across(columns, _) = self { *columns } else { 1 }
    }

    /// The cell with lines of at most `most` characters, `column`'s way; words are never broken.
    fn latex(&self, most: usize, column: Column, corner: char) -> String {
        match self {
            Self::Text(text) => stacked(text, most, column, corner),
            Self::Bold(text) => format!("\\textbf{{{}}}", stacked(text, most, column, corner)),
            Self::Math(source) => format!("${source}$"),
            Self::Across(columns, text) => {
                let lines = stacked(text, most * columns, Column::Centre, corner);
                format!("\\multicolumn{{{columns}}}{{c}}{{{lines}}}")
            }
        }
    }

    /// How many characters its longest line has if lines have at most `most` where words allow it.
    fn width(&self, most: usize) -> usize {
        match self {
            Self::Text(text) | Self::Bold(text) => {
                lines(text, most).iter().map(|line| line.chars().count()).max().unwrap_or(0)
            }
            Self::Math(source) => source.len(),
            Self::Across(..) => 0,
        }
    }
}

impl<S: Into<String>> From<S> for Cell {
    fn from(text: S) -> Self {
        Self::Text(text.into())
    }
}

#[derive(Clone, Debug)]
enum Line {
    Head(Vec<Cell>),
    Row(Vec<Cell>),
    Group(String),
    Rule,
}

/// A table under construction: heads first, then rows.
#[derive(Clone, Debug)]
pub struct Table {
    label: String,
    caption: String,
    columns: Vec<Column>,
    lines: Vec<Line>,
    notes: Vec<String>,
}

impl Table {
    /// An empty table; `label` becomes `tab:label`.
    pub fn new(label: impl Into<String>, caption: impl Into<String>, columns: &[Column]) -> Self {
        let (label, caption) = (label.into(), caption.into());
        Self { label, caption, columns: columns.to_vec(), lines: Vec::new(), notes: Vec::new() }
    }

    /// Adds a line of the head.
    pub fn head(&mut self, cells: Vec<Cell>) -> &mut Self {
        self.lines.push(Line::Head(cells));
        self
    }

    /// Adds a row.
    pub fn row(&mut self, cells: Vec<Cell>) -> &mut Self {
        self.lines.push(Line::Row(cells));
        self
    }

    /// Adds a line in italics that opens a group of rows, with a rule above it unless it comes first.
    pub fn group(&mut self, name: impl Into<String>) -> &mut Self {
        if self.lines.iter().any(|line| matches!(line, Line::Row(_))) {
            self.lines.push(Line::Rule);
        }
        self.lines.push(Line::Group(name.into()));
        self
    }

    /// Adds a note below the table.
    pub fn note(&mut self, text: impl Into<String>) -> &mut Self {
        self.notes.push(text.into());
        self
    }

    /// The table as a `table` environment, under a comment that says how it was `made`.
    ///
    /// # Errors
    /// [`RenderError::RowWidth`] if a line does not fill the columns.
    pub fn latex(&self, made: &str) -> Result<String, RenderError> {
        let comment: String = made.lines().fold(String::new(), |all, line| all + "% " + line + "\n");
        let columns: String = self.columns.iter().map(|column| column_letter(*column)).collect();
        let (caption, label, most) = (escaped(&self.caption), &self.label, self.line_width());
        let mut text = format!(
            "{comment}\\begin{{table}}[htbp]\n\\centering\n\\caption{{{caption}}}\n\\label{{tab:{label}}}\n\
             \\footnotesize\\setlength{{\\tabcolsep}}{{4pt}}%\n\
             \\sbox0{{\\begin{{tabular}}{{@{{}}{columns}@{{}}}}\n\\toprule\n"
        );
        let mut in_head = self.lines.iter().any(|line| matches!(line, Line::Head(_)));
        for (index, line) in self.lines.iter().enumerate() {
            if in_head && !matches!(line, Line::Head(_)) {
                text.push_str("\\midrule\n");
                in_head = false;
            }
            text.push_str(&self.line(index, line, most)?);
        }
        text.push_str("\\bottomrule\n\\end{tabular}}%\n");
        text.push_str(FITTED);
        for note in &self.notes {
            writeln!(text, "\\par\\smallskip{{{}}}", escaped(note)).expect("a string takes everything");
        }
        text.push_str("\\end{table}\n");
        Ok(text)
    }

    /// The longest lines that cells may have for the table to fit the text, as far as counting characters tells.
    fn line_width(&self) -> usize {
        let cells = |line: &Line| match line {
            Line::Head(cells) | Line::Row(cells) => cells.clone(),
            Line::Group(_) | Line::Rule => Vec::new(),
        };
        let rows: Vec<Vec<Cell>> = self.lines.iter().map(cells).collect();
        let column = |column: usize, most: usize| {
            rows.iter().filter_map(|cells| cells.get(column)).map(|cell| cell.width(most)).max().unwrap_or(0)
        };
        let width = |most: usize| -> usize { (0..self.columns.len()).map(|c| column(c, most) + 2).sum() };
        let fits = |most: &usize| width(*most) <= TEXT_CHARACTERS;
        LINE_WIDTHS.into_iter().find(fits).unwrap_or(LINE_WIDTHS[LINE_WIDTHS.len() - 1])
    }

    fn line(&self, index: usize, line: &Line, most: usize) -> Result<String, RenderError> {
        let expected = self.columns.len();
        Ok(match line {
            Line::Rule => "\\midrule\n".to_owned(),
            Line::Group(name) => {
                format!("\\multicolumn{{{expected}}}{{@{{}}l}}{{\\textit{{{}}}}} \\\\\n", escaped(name))
            }
            Line::Head(cells) | Line::Row(cells) => {
                let found: usize = cells.iter().map(Cell::columns).sum();
                if found != expected {
                    let table = self.label.clone();
                    return Err(RenderError::RowWidth { table, row: index, found, expected });
                }
                let is_head = matches!(line, Line::Head(_));
                let corner = if is_head { 'b' } else { 't' };
                let mut at = 0;
                let row: Vec<String> = cells
                    .iter()
                    .map(|cell| {
                        let column = self.columns[at];
                        at += cell.columns();
                        cell.latex(most, column, corner)
                    })
                    .collect();
                let rules = if is_head { head_rules(cells) } else { String::new() };
                let guard = guard(&row[0]);
                format!("{guard}{} \\\\\n{rules}", row.join(" & "))
            }
        })
    }
}

fn column_letter(column: Column) -> char {
    match column {
        Column::Left => 'l',
        Column::Centre => 'c',
        Column::Right => 'r',
    }
}

/// Rules below the cells of a head that lie across several columns.
fn head_rules(cells: &[Cell]) -> String {
    let (mut first, mut rules) = (1, String::new());
    for cell in cells {
        let next = first + cell.columns();
        if matches!(cell, Cell::Across(_, text) if !text.is_empty()) {
            write!(rules, "\\cmidrule(lr){{{first}-{}}}", next - 1).expect("a string takes everything");
        }
        first = next;
    }
    if rules.is_empty() { rules } else { rules + "\n" }
}
