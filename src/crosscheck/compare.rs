//! Our answers beside the judge's.

use super::CrosscheckError;
use super::model::{Model, Pair};
use super::sample::{Kind, Question};
use super::subject::Subject;
use super::table::{Table, place};
use base::text::listed;
use engine::geometry::Frame;
use std::path::Path;

/// How far frames may differ: metres, and entries of rotation matrices. Both sides round a few dozen operations
/// on numbers of the order of 1.
pub const FRAME_TOLERANCE: f64 = 1e-9;
/// How far distances may differ, and how near to contact either answer is right. MuJoCo keeps the vertices of
/// meshes in single precision, which moves faces by up to 6e-8 m at 1 m from a mesh's middle.
pub const TIE_M: f64 = 1e-6;

/// One answer on which the two differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Disagreement {
    /// What was asked.
    pub question: &'static str,
    /// Why the configuration was asked about.
    pub kind: Kind,
    /// Its number among the questions, from 1.
    pub row: usize,
    /// The configuration.
    pub q_rad: Vec<f64>,
    /// The pair, frame or joint.
    pub of: String,
    /// What we say.
    pub ours: String,
    /// What the judge says.
    pub theirs: String,
}

/// What was asked, and how much of it the two agree on.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What was asked.
    pub question: &'static str,
    /// Why these configurations were asked about.
    pub kind: Kind,
    /// How many configurations.
    pub asked: usize,
    /// How many of them are in contact, if that was asked.
    pub in_contact: Option<usize>,
    /// Pairs so near to contact that either answer is right.
    pub ties: usize,
    /// The largest difference of numbers.
    pub largest: Option<f64>,
    /// On how many answers they differ.
    pub disagreements: usize,
}

/// Everything that came of comparing one model's answers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Compared {
    /// One line a question and kind.
    pub lines: Vec<Line>,
    /// Every difference.
    pub disagreements: Vec<Disagreement>,
    /// Which rows and pairs the judge says are in contact, ties left out: for paths and controls.
    pub touches: Vec<(usize, usize)>,
}

/// The files of one model's answers, and what was asked.
pub struct AnswerFiles<'a> {
    /// Who answers for us.
    pub subject: &'a dyn Subject,
    /// Where the answers lie.
    pub folder: &'a Path,
    /// The model's name there.
    pub name: &'a str,
    /// The questions.
    pub questions: &'a [Question],
}

impl AnswerFiles<'_> {
    /// Compares every answer.
    ///
    /// # Errors
    /// [`CrosscheckError::Answer`] for a file that is missing or does not answer what was asked.
    pub fn compare(&self) -> Result<Compared, CrosscheckError> {
        let mut compared = Compared::default();
        self.contacts(&mut compared)?;
        self.distances(&mut compared)?;
        self.frames(&mut compared)?;
        self.limits(&mut compared)?;
        Ok(compared)
    }

    fn model(&self) -> &Model {
        self.subject.model()
    }

    fn rows(&self, is_asked: fn(&Question) -> bool) -> Vec<usize> {
        (0..self.questions.len()).filter(|row| is_asked(&self.questions[*row])).collect()
    }

    fn table(&self, part: &str, rows: usize) -> Result<Table, CrosscheckError> {
        Table::read(place(self.folder, self.name, part), rows)
    }

    /// The judge's columns, one a pair, in the model's order.
    fn columns<T>(
        &self,
        table: &Table,
        get: fn(&Table, &str) -> Result<Vec<T>, CrosscheckError>,
    ) -> Result<(Vec<Pair>, Vec<Vec<T>>), CrosscheckError> {
        let pairs = self.model().pairs();
        let columns =
            pairs.iter().map(|pair| get(table, &self.model().pair_name(*pair))).collect::<Result<_, _>>()?;
        Ok((pairs, columns))
    }

    fn disagreement(&self, question: &'static str, row: usize, of: String) -> Disagreement {
        let Question { kind, q_rad, .. } = &self.questions[row];
        let (ours, theirs) = (String::new(), String::new());
        Disagreement { question, kind: *kind, row: row + 1, q_rad: q_rad.clone(), of, ours, theirs }
    }

    fn contacts(&self, compared: &mut Compared) -> Result<(), CrosscheckError> {
        let table = self.table("touch", self.questions.len())?;
        let (pairs, columns) = self.columns(&table, Table::truths)?;
        for (row, question) in self.questions.iter().enumerate() {
            let gaps_m = self.subject.gaps_m(&question.q_rad);
            let line = compared.line("contact", question.kind);
            line.asked += 1;
            *line.in_contact.get_or_insert(0) += usize::from(gaps_m.iter().any(|gap| *gap <= 0.0));
            for (index, (gap_m, column)) in gaps_m.iter().zip(&columns).enumerate() {
                let touches = column[row];
                if gap_m.abs() <= TIE_M {
                    compared.line("contact", question.kind).ties += 1;
                    continue;
                }
                if touches {
                    compared.touches.push((row, index));
                }
                if touches != (*gap_m <= 0.0) {
                    let found = Disagreement {
                        ours: format!("gap {gap_m:e} m"),
                        theirs: contact(touches),
                        ..self.disagreement("contact", row, self.model().pair_name(pairs[index]))
                    };
                    compared.differ(found);
                }
            }
            let near = |index: usize| gaps_m[index].abs() <= TIE_M;
            let theirs = |index: usize| (!near(index)).then_some(columns[index][row]);
            self.planners_check(compared, row, &pairs, theirs);
        }
        Ok(())
    }

    /// Compares what planners' own check says of a row with the judge's answers by pair, which are `None` for ties.
    fn planners_check(
        &self,
        compared: &mut Compared,
        row: usize,
        pairs: &[Pair],
        theirs: impl Fn(usize) -> Option<bool>,
    ) {
        let question = &self.questions[row];
        let Some((is_free, of)) = self.subject.planners_check(&question.q_rad) else { return };
        let sought = (0..pairs.len()).filter(|index| of.is_broken_by(pairs[*index]));
        let answers: Vec<Option<bool>> = sought.map(theirs).collect();
        let touches = answers.contains(&Some(true));
        let line = compared.line("planners", question.kind);
        line.asked += 1;
        *line.in_contact.get_or_insert(0) += usize::from(!is_free);
        if !touches && answers.contains(&None) {
            line.ties += 1;
        } else if is_free == touches {
            let found = Disagreement {
                ours: contact(!is_free),
                theirs: contact(touches),
                ..self.disagreement("planners", row, "the whole robot".to_owned())
            };
            compared.differ(found);
        }
    }

    fn distances(&self, compared: &mut Compared) -> Result<(), CrosscheckError> {
        let rows = self.rows(|question| question.gaps);
        if rows.is_empty() {
            return Ok(());
        }
        let table = self.table("gaps", rows.len())?;
        let (pairs, columns) = self.columns(&table, Table::numbers)?;
        for (place, &row) in rows.iter().enumerate() {
            let question = &self.questions[row];
            compared.line("distance", question.kind).asked += 1;
            for (index, gap_m) in self.subject.gaps_m(&question.q_rad).into_iter().enumerate() {
                let theirs_m = columns[index][place];
                if gap_m <= TIE_M {
                    continue;
                }
                let of = || self.model().pair_name(pairs[index]);
                let found = || Disagreement {
                    ours: format!("{gap_m:e} m"),
                    theirs: format!("{theirs_m:e} m"),
                    ..self.disagreement("distance", row, of())
                };
                compared.measure("distance", question.kind, (gap_m - theirs_m).abs(), TIE_M, found);
            }
        }
        Ok(())
    }

    fn frames(&self, compared: &mut Compared) -> Result<(), CrosscheckError> {
        let rows = self.rows(|question| question.frames);
        if rows.is_empty() {
            return Ok(());
        }
        let table = self.table("frames", rows.len())?;
        let names = self.model().frame_names();
        let parts = ["x", "y", "z", "xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];
        let column = |name: &str| parts.iter().map(|part| table.numbers(&format!("{name}.{part}"))).collect();
        let columns: Vec<Vec<Vec<f64>>> = names.iter().map(|name| column(name)).collect::<Result<_, _>>()?;
        for (place, &row) in rows.iter().enumerate() {
            let question = &self.questions[row];
            compared.line("frame", question.kind).asked += 1;
            for (index, frame) in self.subject.frames(&question.q_rad).iter().enumerate() {
                let (ours, theirs) = (numbers(frame), columns[index].iter().map(|cells| cells[place]));
                let theirs: Vec<f64> = theirs.collect();
                let largest = largest_difference(&ours, &theirs);
                let found = || Disagreement {
                    ours: format!("{} m", listed(&ours[..3])),
                    theirs: format!("{} m", listed(&theirs[..3])),
                    ..self.disagreement("frame", row, names[index].clone())
                };
                compared.measure("frame", question.kind, largest, FRAME_TOLERANCE, found);
            }
        }
        Ok(())
    }

    fn limits(&self, compared: &mut Compared) -> Result<(), CrosscheckError> {
        let rows = self.rows(|question| question.limits);
        if rows.is_empty() {
            return Ok(());
        }
        let table = self.table("limits", rows.len())?;
        for joint in 0..self.model().rows.len() {
            let name = format!("joint_{}", joint + 1);
            let beyond = table.truths(&name)?;
            for (place, &row) in rows.iter().enumerate() {
                let question = &self.questions[row];
                compared.line("limit", question.kind).asked += usize::from(joint == 0);
                let ours = self.subject.is_beyond(joint, question.q_rad[joint]) == Some(true);
                if ours != beyond[place] {
                    let word = |is: bool| (if is { "beyond" } else { "within" }).to_owned();
                    let found = Disagreement {
                        ours: word(ours),
                        theirs: word(beyond[place]),
                        ..self.disagreement("limit", row, name.clone())
                    };
                    compared.differ(found);
                }
            }
        }
        Ok(())
    }
}

fn contact(is: bool) -> String {
    (if is { "contact" } else { "no contact" }).to_owned()
}

/// Place and rotation, row by row.
fn numbers(frame: &Frame) -> Vec<f64> {
    let rotation = frame.rotation.transpose();
    frame.origin.iter().chain(rotation.iter()).copied().collect()
}

/// The largest difference of two rows; NaN if a difference is.
fn largest_difference(ours: &[f64], theirs: &[f64]) -> f64 {
    let differences = ours.iter().zip(theirs).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |most, d| if d.is_nan() || d > most { d } else { most })
}

impl Compared {
    fn line(&mut self, question: &'static str, kind: Kind) -> &mut Line {
        let at = self.lines.iter().position(|line| line.question == question && line.kind == kind);
        let at = at.unwrap_or_else(|| {
            let new =
                Line { question, kind, asked: 0, in_contact: None, ties: 0, largest: None, disagreements: 0 };
            self.lines.push(new);
            self.lines.len() - 1
        });
        &mut self.lines[at]
    }

    fn differ(&mut self, found: Disagreement) {
        self.line(found.question, found.kind).disagreements += 1;
        self.disagreements.push(found);
    }

    /// Notes a difference of numbers, and a disagreement if it is more than `tolerance` or no number.
    fn measure(
        &mut self,
        question: &'static str,
        kind: Kind,
        difference: f64,
        tolerance: f64,
        found: impl FnOnce() -> Disagreement,
    ) {
        let line = self.line(question, kind);
        line.largest = Some(line.largest.map_or(difference, |largest| largest.max(difference)));
        if difference.is_nan() || difference > tolerance {
            self.differ(found());
        }
    }
}
