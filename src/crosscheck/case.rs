//! One robot in one scene: what is asked, and what comes of the answers.

use super::CrosscheckError;
use super::compare::{AnswerFiles, Compared, Disagreement, Line};
use super::control::{Control, Wrong, pushed_control, pushed_path};
use super::mjcf::{Key, mjcf};
use super::model::{Freedom, Model};
use super::path::{Path, Pushed, drawn_paths};
use super::sample::{Kind, Question, Sampler, Sizes};
use super::subject::Subject;
use super::table::{place, write_questions};
use base::text::listed;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path as FilePath, PathBuf};

/// The model that is judged, and those with an error.
const RIGHT: &str = "scene";
const STRETCHED: &str = "longer_link";
const SHIFTED: &str = "shifted_obstacle";

/// One robot in one scene.
pub struct Case {
    name: String,
    subject: Box<dyn Subject>,
    paths: Vec<Path>,
    are_stored: bool,
    free_of: Freedom,
    pushed: Option<Pushed>,
    questions: Vec<Question>,
    stretched: Wrong,
    shifted: Wrong,
    keys: Vec<Key>,
}

/// What came of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The case.
    pub case: String,
    /// One line a question and kind of configuration.
    pub lines: Vec<Line>,
    /// Every answer on which the two differ.
    pub disagreements: Vec<Disagreement>,
    /// Paths that we say are free, and how many the judge finds in contact; the first contact of each.
    pub paths: Paths,
    /// The errors made on purpose.
    pub controls: Vec<Control>,
}

/// What the judge says of a case's paths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Paths {
    /// How many there are.
    pub count: usize,
    /// Whether they come from a stored run; else they were drawn for want of one.
    pub are_stored: bool,
    /// What they are said to be free of.
    pub free_of: Freedom,
    /// Paths that should be free and are not, each with its first contact.
    pub blocked: Vec<String>,
}

impl Outcome {
    /// Whether everything agrees and every error made on purpose was noticed.
    pub fn is_agreed(&self) -> bool {
        self.disagreements.is_empty()
            && self.paths.blocked.is_empty()
            && self.controls.iter().all(Control::is_caught)
    }
}

/// The paths of a case.
pub struct Given {
    /// The paths, at our own steps.
    pub paths: Vec<Path>,
    /// What the studies say that they are free of.
    pub free_of: Freedom,
}

impl Case {
    /// The case called `name`: `subject` asked as `sizes` and `seed` say, and along the stored paths if there are any.
    ///
    /// # Errors
    /// A step of a stored path that cannot be followed.
    pub fn new(
        name: String,
        subject: Box<dyn Subject>,
        sizes: &Sizes,
        seed: u64,
        given: Given,
    ) -> Result<Self, String> {
        let of = subject.as_ref();
        let Given { paths: stored, free_of: promised } = given;
        let mut questions = Sampler::new(of, seed).questions(sizes);
        let are_stored = !stored.is_empty();
        let paths = if are_stored {
            stored.iter().map(|path| path.finer(of)).collect::<Result<Vec<_>, _>>()?
        } else {
            drawn_paths(of, sizes.drawn_paths, seed)
        };
        for (index, path) in paths.iter().enumerate() {
            questions.extend(path.questions(index, Kind::Path));
        }
        // Frames are asked along one path at least, also where nothing is drawn.
        let first = questions.iter_mut().filter(|question| question.kind == Kind::Path && question.path == 0);
        first.for_each(|question| question.frames = true);
        let spare = || if are_stored { drawn_paths(of, sizes.drawn_paths, seed) } else { Vec::new() };
        let pushed = pushed_path(of, paths.iter().cloned().chain(std::iter::once_with(spare).flatten()));
        if let Some(pushed) = &pushed {
            questions.extend(pushed.path.questions(0, Kind::Pushed));
        }
        let (stretched, shifted) = (Wrong::stretched(of, &questions), Wrong::shifted(of, &questions));
        let keys = keys(of.model(), &questions, &paths);
        let free_of = if are_stored { promised } else { Freedom::Contact };
        Ok(Self { name, subject, paths, are_stored, free_of, pushed, questions, stretched, shifted, keys })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The names of its keyframes.
    pub fn keys(&self) -> Vec<&str> {
        self.keys.iter().map(|key| key.name.as_str()).collect()
    }

    /// Where the models and questions lie below `folder`.
    pub fn folder(&self, folder: &FilePath) -> PathBuf {
        folder.join(&self.name)
    }

    /// Writes models and questions below `folder`; what was there of this case is dropped.
    ///
    /// # Errors
    /// [`CrosscheckError::Io`].
    pub fn write(&self, folder: &FilePath) -> Result<(), CrosscheckError> {
        let folder = self.folder(folder);
        let io = |source| CrosscheckError::Io { path: folder.clone(), source };
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(io)?;
        }
        fs::create_dir_all(&folder).map_err(io)?;
        self.write_model(&folder, RIGHT, self.subject.model(), &self.questions)?;
        self.write_model(&folder, STRETCHED, &self.stretched.model, &self.stretched.questions)?;
        self.write_model(&folder, SHIFTED, &self.shifted.model, &self.shifted.questions)
    }

    fn write_model(
        &self,
        folder: &FilePath,
        name: &str,
        model: &Model,
        questions: &[Question],
    ) -> Result<(), CrosscheckError> {
        let path = folder.join(format!("{name}.xml"));
        fs::write(&path, mjcf(model, &self.keys)).map_err(|source| CrosscheckError::Io { path, source })?;
        write_questions(&place(folder, name, "questions"), model.rows.len(), questions)
    }

    /// Compares the answers below `folder` with ours.
    ///
    /// # Errors
    /// [`CrosscheckError::Answer`] for answers that are missing or do not fit the questions.
    pub fn compare(&self, folder: &FilePath) -> Result<Outcome, CrosscheckError> {
        let folder = self.folder(folder);
        let asked = |name, questions| AnswerFiles {
            subject: self.subject.as_ref(),
            folder: &folder,
            name,
            questions,
        };
        let right = asked(RIGHT, &self.questions);
        let compared = right.compare()?;
        let of_wrong = |name, wrong: &Wrong| -> Result<Control, CrosscheckError> {
            let questions: &[Question] = &wrong.questions;
            Ok(wrong.control(
                &AnswerFiles { subject: self.subject.as_ref(), folder: &folder, name, questions }
                    .compare()?,
            ))
        };
        let controls = vec![
            of_wrong(STRETCHED, &self.stretched)?,
            of_wrong(SHIFTED, &self.shifted)?,
            pushed_control(&right, &compared, self.pushed.as_ref()),
        ];
        let paths = Paths {
            count: self.paths.len(),
            are_stored: self.are_stored,
            free_of: self.free_of,
            blocked: self.blocked(&compared),
        };
        let Compared { lines, disagreements, .. } = compared;
        Ok(Outcome { case: self.name.clone(), lines, disagreements, paths, controls })
    }

    /// The first contact of every path that should be free.
    fn blocked(&self, compared: &Compared) -> Vec<String> {
        let model = self.subject.model();
        let pairs = self.subject.model().pairs();
        let mut seen = BTreeSet::new();
        let on_path = |(row, _): &&(usize, usize)| self.questions[*row].kind == Kind::Path;
        let is_broken = |(_, pair): &&(usize, usize)| self.free_of.is_broken_by(pairs[*pair]);
        let touches = compared.touches.iter().filter(on_path).filter(is_broken);
        let first = touches.filter(|(row, _)| seen.insert(self.questions[*row].path));
        first
            .map(|(row, pair)| {
                let Question { path, q_rad, .. } = &self.questions[*row];
                let name = &self.paths[*path].name;
                let pair = model.pair_name(pairs[*pair]);
                format!("path `{name}` touches {pair} at {q_rad}", q_rad = listed(q_rad))
            })
            .collect()
    }
}

/// What the viewer can be put into: zero within the limits, the first configurations near contact and of each path.
fn keys(model: &Model, questions: &[Question], paths: &[Path]) -> Vec<Key> {
    const NEAR: usize = 10;
    const PATHS: usize = 10;
    let zero = model.rows.iter().map(|row| 0.0_f64.clamp(row.limits_rad[0], row.limits_rad[1])).collect();
    let mut keys = vec![Key { name: "zero".to_owned(), q_rad: zero }];
    for (index, path) in paths.iter().take(PATHS).enumerate() {
        for (what, share) in [("start", 0), ("middle", 1), ("end", 2)] {
            let q_rad = path.stops_rad[(path.stops_rad.len() - 1) * share / 2].clone();
            keys.push(Key { name: format!("path {} {what}", index + 1), q_rad });
        }
    }
    let near = questions.iter().filter(|question| question.kind == Kind::NearContact).take(NEAR);
    keys.extend(near.enumerate().map(|(index, question)| Key {
        name: format!("near contact {}", index + 1),
        q_rad: question.q_rad.clone(),
    }));
    keys
}
