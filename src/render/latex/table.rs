//! Tables as wide as the text: `tabularx` breaks their cells, `booktabs` rules them.

use super::{RenderError, comment, escaped};

/// Where a column's cells stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Text.
    Left,
    /// Numbers with equal decimals.
    Right,
}

/// One cell of a table: text, which is escaped, and the letter of a footnote.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    text: String,
    note: Option<char>,
}

impl Cell {
    fn latex(&self) -> String {
        let note = self.note.map_or_else(String::new, |letter| format!("\\textsuperscript{{{letter}}}"));
        escaped(&self.text) + &note
    }

    /// How wide it should be, in characters: its longest word fits, and long texts get more.
    fn width(&self) -> usize {
        let words = self.text.split(' ').map(|word| word.chars().count());
        words.max().unwrap_or(0).max(self.text.chars().count().min(60) / 3)
    }
}

impl<S: Into<String>> From<S> for Cell {
    fn from(text: S) -> Self {
        Self { text: text.into(), note: None }
    }
}

#[derive(Clone, Debug)]
enum Line {
    Head(Vec<Cell>),
    Row(Vec<Cell>),
    Group(String),
}

/// A table under construction: heads first, then rows.
#[derive(Clone, Debug)]
pub struct Table {
    label: String,
    caption: String,
    columns: Vec<Column>,
    lines: Vec<Line>,
    footnotes: Vec<String>,
    notes: Vec<String>,
}

/// Sizes of type, with the characters that the text of an article holds a line.
const SIZES: [(usize, &str); 3] = [(72, "footnotesize"), (88, "scriptsize"), (usize::MAX, "tiny")];

impl Table {
    /// An empty table; `label` becomes `tab:label`.
    pub fn new(label: impl Into<String>, caption: impl Into<String>, columns: &[Column]) -> Self {
        Self {
            label: label.into(),
            caption: caption.into(),
            columns: columns.to_vec(),
            lines: Vec::new(),
            footnotes: Vec::new(),
            notes: Vec::new(),
        }
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
        self.lines.push(Line::Group(name.into()));
        self
    }

    /// Gives `cell` a footnote; one that says what an earlier one says is the same.
    pub fn footnote(&mut self, cell: &mut Cell, text: String) {
        let known = self.footnotes.iter().position(|footnote| *footnote == text);
        let at = known.unwrap_or(self.footnotes.len());
        if known.is_none() {
            self.footnotes.push(text);
        }
        cell.note = char::from_u32('a' as u32 + at as u32);
    }

    /// Adds a note on the whole table, below it.
    pub fn note(&mut self, text: impl Into<String>) -> &mut Self {
        self.notes.push(text.into());
        self
    }

    /// The table as a `table` environment, under a comment that says how it was `made`.
    ///
    /// # Errors
    /// [`RenderError::RowWidth`] if a line does not fill the columns.
    pub fn latex(&self, made: &str) -> Result<String, RenderError> {
        let comment = comment(made);
        let caption = escaped(&self.caption);
        let label = &self.label;
        let widths = self.widths();
        let characters: usize = widths.iter().sum::<usize>() + 2 * widths.len();
        let size = SIZES.iter().find(|(most, _)| characters <= *most).map_or("tiny", |(_, size)| size);
        let mut text = format!(
            "{comment}\\begin{{table}}[htbp]\n\\centering\n\\caption{{{caption}}}\n\\label{{tab:{label}}}\n\
             \\{size}\\setlength{{\\tabcolsep}}{{3pt}}%\n\
             \\begin{{tabularx}}{{\\textwidth}}{{@{{}}{}@{{}}}}\n\\toprule\n",
            self.columns(&widths)
        );
        for (index, line) in self.lines.iter().enumerate() {
            let before = index.checked_sub(1).and_then(|before| self.lines.get(before));
            let begins = matches!((before, line), (Some(Line::Head(_)), Line::Row(_) | Line::Group(_)));
            if begins || matches!((before, line), (Some(Line::Row(_)), Line::Group(_))) {
                text += "\\midrule\n";
            }
            text += &self.line(index, line)?;
        }
        text += "\\bottomrule\n\\end{tabularx}\n";
        for (footnote, letter) in self.footnotes.iter().zip('a'..) {
            text += &format!("\\par\\smallskip{{\\textsuperscript{{{letter}}} {}}}\n", escaped(footnote));
        }
        for note in &self.notes {
            text += &format!("\\par\\smallskip{{{}}}\n", escaped(note));
        }
        Ok(text + "\\end{table}\n")
    }

    /// The widths that the columns should have, in characters.
    fn widths(&self) -> Vec<usize> {
        let cells = |line: &Line, column: usize| match line {
            Line::Head(cells) | Line::Row(cells) => cells.get(column).map_or(0, Cell::width),
            Line::Group(_) => 0,
        };
        let width = |column| self.lines.iter().map(|line| cells(line, column)).max().unwrap_or(0).max(1);
        (0..self.columns.len()).map(width).collect()
    }

    /// The columns as `tabularx` takes them: their shares of the width sum to their number.
    fn columns(&self, widths: &[usize]) -> String {
        let sum: usize = widths.iter().sum();
        let column = |(column, width): (&Column, &usize)| {
            let share = (*width * widths.len()) as f64 / sum.max(1) as f64;
            let side = if *column == Column::Left { "right" } else { "left" };
            format!(">{{\\hsize={share:.3}\\hsize\\ragged{side}\\arraybackslash}}X")
        };
        self.columns.iter().zip(widths).map(column).collect()
    }

    fn line(&self, row: usize, line: &Line) -> Result<String, RenderError> {
        let expected = self.columns.len();
        let cells = match line {
            Line::Group(name) => {
                let name = escaped(name);
                return Ok(format!("\\multicolumn{{{expected}}}{{@{{}}l}}{{\\textit{{{name}}}}} \\\\\n"));
            }
            Line::Head(cells) | Line::Row(cells) => cells,
        };
        if cells.len() != expected {
            let table = self.label.clone();
            let found = cells.len();
            return Err(RenderError::RowWidth { table, row, found, expected });
        }
        let row: Vec<String> = cells.iter().map(Cell::latex).collect();
        // A bracket or star behind the `\\` of the line above would be read as an argument of it.
        let guard = if row[0].starts_with(['[', '*']) { "{}" } else { "" };
        Ok(format!("{guard}{} \\\\\n", row.join(" & ")))
    }
}
