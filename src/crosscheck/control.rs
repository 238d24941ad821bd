//! Negative controls: errors made on purpose, which the comparison must notice.

use super::compare::{AnswerFiles, Compared, TIE_M};
use super::model::Model;
use super::path::{Path, Pushed, pushed};
use super::sample::{Kind, Question};
use super::subject::Subject;
use engine::geometry::Vec3;

/// By how much the longest link is made longer for the judge.
pub const STRETCH_M: f64 = 1e-3;
/// By how much an obstacle is moved for the judge.
pub const SHIFT_M: f64 = 5e-3;
/// How many drawn configurations are asked of the model with the longer link.
const STRETCHED_ROWS: usize = 200;
/// How many configurations near contact are asked of the model with the moved obstacle.
const SHIFTED_ROWS: usize = 400;

/// An error made on purpose, and whether it was noticed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Control {
    /// What was done.
    pub what: String,
    /// How many answers had to differ.
    pub listed: usize,
    /// How many of them did.
    pub caught: usize,
}

impl Control {
    /// Whether the error was noticed wherever it had to be.
    pub fn is_caught(&self) -> bool {
        self.listed > 0 && self.caught == self.listed
    }
}

/// A model with an error, and what is asked of it.
pub struct Wrong {
    /// The model as the judge gets it.
    pub model: Model,
    /// What was done.
    pub what: String,
    /// The questions.
    pub questions: Vec<Question>,
    /// The answers that must differ from ours of the right model: row and pair, by index; empty if every row must
    /// differ in a frame.
    pub listed: Vec<(usize, usize)>,
}

impl Wrong {
    /// The longest link is longer.
    pub fn stretched(subject: &dyn Subject, questions: &[Question]) -> Self {
        let (model, link) = subject.model().stretched(STRETCH_M);
        let drawn = questions.iter().filter(|question| question.frames).take(STRETCHED_ROWS);
        let questions = drawn.map(|question| Question { gaps: false, limits: false, ..question.clone() });
        let what = format!("link {link} 1 mm longer");
        Self { model, what, questions: questions.collect(), listed: Vec::new() }
    }

    /// One obstacle stands elsewhere: of all obstacles and of six directions, where most of the answers near
    /// contact flip.
    pub fn shifted(subject: &dyn Subject, questions: &[Question]) -> Self {
        let near = questions.iter().filter(|question| question.kind == Kind::NearContact).take(SHIFTED_ROWS);
        let plain = |q: &Question| Question { gaps: false, frames: false, ..q.clone() };
        let questions: Vec<Question> = near.map(plain).collect();
        let ours: Vec<Vec<f64>> = questions.iter().map(|question| subject.gaps_m(&question.q_rad)).collect();
        let mut best: Option<(usize, Vec3, Vec<(usize, usize)>)> = None;
        for still in 0..subject.model().stills.len() {
            for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
                let mut by_m = Vec3::zeros();
                by_m[axis] = sign * SHIFT_M;
                let listed = flips(subject.shifted(still, &by_m).as_ref(), &questions, &ours);
                if best.as_ref().is_none_or(|(.., most)| listed.len() > most.len()) {
                    best = Some((still, by_m, listed));
                }
            }
        }
        let (still, by_m, listed) = best.unwrap_or((0, Vec3::zeros(), Vec::new()));
        let name = subject.model().stills.get(still).map_or("nothing", |still| still.name.as_str());
        let what = format!("`{name}` shifted by {} mm", base::text::listed(by_m * 1e3));
        let model =
            if listed.is_empty() { subject.model().clone() } else { subject.model().shifted(still, &by_m) };
        Self { model, what, questions, listed }
    }

    /// Whether the comparison with ours of the right model notices the error.
    pub fn control(&self, compared: &Compared) -> Control {
        let differs = |row: usize, of: Option<&str>| {
            let fits = |d: &&super::compare::Disagreement| d.row == row + 1 && of.is_none_or(|of| d.of == of);
            compared.disagreements.iter().any(|d| fits(&d))
        };
        let (listed, caught) = if self.listed.is_empty() && self.questions.iter().any(|q| q.frames) {
            (self.questions.len(), (0..self.questions.len()).filter(|row| differs(*row, None)).count())
        } else {
            let pairs = self.model.pairs();
            let is_caught =
                |(row, pair): &&(usize, usize)| differs(*row, Some(&self.model.pair_name(pairs[*pair])));
            (self.listed.len(), self.listed.iter().filter(is_caught).count())
        };
        Control { what: self.what.clone(), listed, caught }
    }
}

/// Which answers differ, beyond doubt, between ours of the right model and those of `other`.
fn flips(other: &dyn Subject, questions: &[Question], ours: &[Vec<f64>]) -> Vec<(usize, usize)> {
    let mut flips = Vec::new();
    for (row, (question, gaps)) in questions.iter().zip(ours).enumerate() {
        for (pair, (a, b)) in gaps.iter().zip(other.gaps_m(&question.q_rad)).enumerate() {
            if a.abs() > TIE_M && b.abs() > TIE_M && (*a <= 0.0) != (b <= 0.0) {
                flips.push((row, pair));
            }
        }
    }
    flips
}

/// The first of `paths` that is free and can be pushed into something that stands still, pushed.
pub fn pushed_path(subject: &dyn Subject, mut paths: impl Iterator<Item = Path>) -> Option<Pushed> {
    paths.find_map(|path| pushed(subject, &path))
}

/// Whether the judge finds the pushed path in contact where it was pushed to, with what it was pushed into.
pub fn pushed_control(asked: &AnswerFiles<'_>, compared: &Compared, pushed: Option<&Pushed>) -> Control {
    let Some(Pushed { path, stop, pair }) = pushed else {
        return Control { what: "no path can be pushed into anything".to_owned(), listed: 0, caught: 0 };
    };
    let model = asked.subject.model();
    let first = asked.questions.iter().position(|question| question.kind == Kind::Pushed);
    let caught = first.is_some_and(|first| compared.touches.contains(&(first + stop, *pair)));
    // A bar would end the cell of a table.
    let pair = model.pair_name(model.pairs()[*pair]).replace('|', " on ");
    let what = format!("path `{}` pushed, {pair}", path.name);
    Control { what, listed: 1, caught: usize::from(caught) }
}
