//! The table of estimates: every number that claims ask of a paper's explorations, in one Parquet file.
//!
//! A row is one number of one question under the interpretations that it lists: equal numbers of equal trials are stored once. Outcomes are
//! not stored. They are weighed from the numbers, so that a margin or a printed number may change without a trial.

use super::claim_test::{ClaimTest, claim_tests};
use super::evidence::Evidence;
use super::number::{Ends, Number, Numbers};
use super::verdict::Together;
use base::hash::sha256;
use base::settings::SettingsError;
use polars::prelude::{ChunkedArray, Column, DataFrame, NamedFrom as _, PolarsError, PolarsResult, Series};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use stats::interval::Interval;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use study::StudyError;
use study::name;
use study::paper::{Claim, Paper};
use study::parquet::{FrameReader, write_frame};
use study::store::write_whole;

/// The numbers of every question that a paper's claims ask under one interpretation.
pub type Measured = BTreeMap<String, (About, Numbers)>;

/// What is stored of a paper's explorations.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Estimates {
    /// The paper.
    pub paper: String,
    /// Its interpretations, explored.
    pub first: Option<Explored>,
    /// The defaults and interpretations that turn a claim, on the second seed.
    pub second: Option<Explored>,
}

/// Interpretations under which trials ran, with the numbers that they gave.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explored {
    /// The command that ran them.
    pub command: String,
    /// How many trials it took.
    pub trials: u64,
    /// The options that differ from the defaults of each choice, the default interpretation first.
    pub interpretations: Vec<BTreeMap<String, String>>,
    /// What the studies were, by name: hashes.
    pub studies: BTreeMap<String, String>,
    /// A hash of what the claims meant that are met exactly.
    pub meant: String,
    /// Which of them are met together under some interpretation.
    pub together: Vec<Together>,
    /// The numbers.
    #[serde(skip)]
    pub answers: Vec<Answer>,
}

/// The numbers of one question, under the interpretations that give them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Answer {
    /// The question, by a hash.
    pub question: String,
    /// What it asks.
    pub about: About,
    /// Whether these are of the round with more instances.
    pub is_more: bool,
    /// The interpretations, by their places.
    pub places: Vec<usize>,
    /// The numbers.
    pub numbers: Numbers,
}

/// What a question asks, in words.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct About {
    /// The claims that ask it, separated by commas.
    pub claim: String,
    /// The statistic.
    pub statistic: String,
    /// The studies.
    pub study: String,
    /// The problem groups.
    pub groups: String,
    /// The contenders.
    pub contender: String,
    /// The contender that they are compared with.
    pub against: String,
    /// The metric.
    pub metric: String,
    /// The metric's unit; empty for counts.
    pub unit: String,
    /// The queries.
    pub query: String,
    /// The points of the sweeps.
    pub sweep: String,
}

impl About {
    fn new(claim: &Claim, test: &ClaimTest<'_>) -> Self {
        let own = test.criterion();
        let studies: BTreeSet<&str> = own.studies().iter().map(|study| study.name.as_str()).collect();
        let selections = own.selections();
        let first = selections.first();
        let joined = |all: Option<&Vec<String>>| all.map_or_else(String::new, |all| all.join(", "));
        let points = first
            .and_then(|selection| selection.sweep.as_ref())
            .map(|all| all.iter().map(name::sweep).collect());
        let metric = first.and_then(|selection| selection.metric);
        Self {
            claim: claim.id.clone(),
            statistic: test.statistic().to_owned(),
            study: studies.into_iter().collect::<Vec<_>>().join(", "),
            groups: joined(first.map(|selection| &selection.groups)),
            contender: joined(first.map(|selection| &selection.contenders)),
            against: first.and_then(|selection| selection.against.clone()).unwrap_or_default(),
            metric: metric.map_or_else(String::new, |metric| metric.name.to_owned()),
            unit: metric.map_or_else(String::new, |metric| metric.unit.clone()),
            query: joined(first.and_then(|selection| selection.query.as_ref())),
            sweep: joined(points.as_ref()),
        }
    }
}

/// A question whose numbers are of trials with refused paths too: without such trials it is the question itself.
pub fn with_refused(question: &str) -> String {
    format!("{question} with refused paths")
}

/// The numbers of every question that decides a claim, under the evidence's interpretation.
///
/// # Errors
/// Those of [`validate`](super::claims::validate).
pub fn measured(evidence: &Evidence<'_>) -> Result<Measured, SettingsError> {
    let of_claim = |claim: &Claim| {
        let mut found = Vec::new();
        for test in claim_tests(evidence.paper, claim, &evidence.point) {
            let test = test?;
            let Some(question) = test.question().filter(|_| !test.is_shown()) else { continue };
            let numbers = test.numbers(evidence, true);
            let is_other = numbers.refused > 0.0 && test.criterion().counts_refused();
            let question = if is_other { with_refused(&question) } else { question };
            found.push((question, (About::new(claim, &test), numbers)));
        }
        Ok(found)
    };
    // Gathered in order before any error is passed on, so that it is the first claim's.
    let all: Vec<Result<Vec<_>, _>> = evidence.paper.claims.par_iter().map(of_claim).collect();
    let mut found = Measured::new();
    for one in all {
        for (question, (about, numbers)) in one? {
            match found.entry(question) {
                Entry::Vacant(place) => {
                    place.insert((about, numbers));
                }
                Entry::Occupied(mut known) => {
                    let claims = &mut known.get_mut().0.claim;
                    if !claims.split(", ").any(|claim| claim == about.claim) {
                        *claims += &format!(", {}", about.claim);
                    }
                }
            }
        }
    }
    Ok(found)
}

impl Explored {
    /// Adds what was measured under interpretations by their places; equal numbers of a question once.
    pub fn add<'m>(&mut self, measured: impl IntoIterator<Item = (usize, &'m Measured)>, is_more: bool) {
        let mut known: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (place, measured) in measured {
            for (question, (about, numbers)) in measured {
                let of_question = known.entry(question).or_default();
                let at = of_question.iter().copied().find(|at| self.answers[*at].numbers == *numbers);
                let at = at.unwrap_or_else(|| {
                    self.answers.push(Answer {
                        question: question.clone(),
                        about: about.clone(),
                        is_more,
                        places: Vec::new(),
                        numbers: numbers.clone(),
                    });
                    of_question.push(self.answers.len() - 1);
                    self.answers.len() - 1
                });
                self.answers[at].places.push(place);
            }
        }
    }

    /// Where the answer of each question stands, with whether it is of more instances, under the interpretation at each place.
    pub fn places(&self) -> BTreeMap<(&str, bool, usize), usize> {
        let of_answer = |(at, answer): (usize, &'_ Answer)| {
            answer.places.iter().map(move |place| (*place, at)).collect::<Vec<_>>()
        };
        let all = self.answers.iter().enumerate().flat_map(of_answer);
        let key = |(place, at): (usize, usize)| {
            let Answer { question, is_more, .. } = &self.answers[at];
            ((question.as_str(), *is_more, place), at)
        };
        all.map(key).collect()
    }

    /// The interpretations, by their places, that ran once more with more instances.
    pub fn answers_with_more(&self) -> impl Iterator<Item = usize> {
        self.answers.iter().filter(|answer| answer.is_more).flat_map(|answer| answer.places.iter().copied())
    }
}

/// What stands before the hash that seals a file, in its metadata.
const SEAL: &str = "sha256 of this file with zeros here: ";

/// The name under which the metadata has all that is not a number.
const HEAD: &str = "explored";

/// How long a hash is, as text.
const HASH: usize = 64;

impl Estimates {
    /// The file of estimates of the paper whose runs are in `folder`.
    pub fn path(folder: &Path) -> PathBuf {
        folder.join("estimates.parquet")
    }

    /// The estimates of `paper` if nothing was explored.
    pub fn none(paper: &Paper) -> Self {
        Self { paper: paper.id.clone(), ..Self::default() }
    }

    /// What is stored of `paper` in `folder`, if anything is.
    ///
    /// # Errors
    /// [`StudyError::Touched`] if it was edited, is of another paper or cannot be understood.
    pub fn read(paper: &Paper, folder: &Path) -> Result<Self, StudyError> {
        let path = Self::path(folder);
        if !path.exists() {
            return Ok(Self::none(paper));
        }
        let touched = |reason: String| {
            StudyError::Touched(format!("{}: {reason}; explore and confirm the paper again", path.display()))
        };
        let bytes = fs::read(&path).map_err(StudyError::io(&path, "reading the file"))?;
        if !is_sealed(&bytes) {
            return Err(touched(
                "is not what replan wrote: damaged, edited, or of another version".to_owned(),
            ));
        }
        let found =
            Self::from_bytes(bytes).map_err(|reason| touched(format!("cannot be understood: {reason}")))?;
        if found.paper != paper.id {
            return Err(touched(format!("is of the paper `{}`, not of `{}`", found.paper, paper.id)));
        }
        Ok(found)
    }

    /// Writes it into `folder`.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        write_whole(&Self::path(folder), &self.bytes())
    }

    /// It as a sealed Parquet file.
    fn bytes(&self) -> Vec<u8> {
        let head = serde_json::to_string(self).expect("texts, numbers and tables of them");
        let entries =
            vec![(HEAD.to_owned(), head), ("seal".to_owned(), format!("{SEAL}{}", "0".repeat(HASH)))];
        let mut bytes = Vec::new();
        write_frame(&mut bytes, frame(self), entries).expect("columns of equal length are written to memory");
        let at = seal_of(&bytes).expect("it was written");
        let hash = sha256(&bytes);
        bytes[at..at + HASH].copy_from_slice(hash.as_bytes());
        bytes
    }

    fn from_bytes(bytes: Vec<u8>) -> Result<Self, String> {
        let mut reader = FrameReader::open(Cursor::new(bytes)).map_err(|error| error.to_string())?;
        let head = reader.entry(HEAD).ok_or("its metadata lacks what was explored")?;
        let mut found: Self = serde_json::from_str(head).map_err(|error| error.to_string())?;
        let frame = reader.frame().map_err(|error| error.to_string())?;
        let [first, second] = answers(&frame).map_err(|error| error.to_string())?;
        for (explored, answers) in [(&mut found.first, first), (&mut found.second, second)] {
            let known = explored.as_ref().map_or(0, |explored| explored.interpretations.len());
            if answers.iter().flat_map(|answer| &answer.places).any(|place| *place >= known) {
                return Err("a number names an interpretation that is not listed".to_owned());
            }
            if let Some(explored) = explored {
                explored.answers = answers;
            }
        }
        Ok(found)
    }
}

/// Where the hash stands that seals a file.
fn seal_of(bytes: &[u8]) -> Option<usize> {
    let at = bytes.windows(SEAL.len()).rposition(|window| window == SEAL.as_bytes())? + SEAL.len();
    (at + HASH <= bytes.len()).then_some(at)
}

/// Whether a file is what its seal says.
fn is_sealed(bytes: &[u8]) -> bool {
    let Some(at) = seal_of(bytes) else { return false };
    let mut zeroed = bytes.to_vec();
    zeroed[at..at + HASH].fill(b'0');
    sha256(&zeroed).as_bytes() == &bytes[at..at + HASH]
}

/// Where a column's value is kept in a row.
type Lens<T> = (&'static str, fn(&mut Row) -> &mut T);

/// A row of the table: a number with all that names it.
#[derive(Clone, Default)]
struct Row {
    is_second: bool,
    /// The place of its answer among all of the table.
    place: usize,
    answer: Answer,
    session: usize,
    number: Number,
}

const TEXTS: [Lens<String>; 13] = [
    ("question", |row| &mut row.answer.question),
    ("claim", |row| &mut row.answer.about.claim),
    ("statistic", |row| &mut row.answer.about.statistic),
    ("study", |row| &mut row.answer.about.study),
    ("groups", |row| &mut row.answer.about.groups),
    ("contender", |row| &mut row.answer.about.contender),
    ("against", |row| &mut row.answer.about.against),
    ("metric", |row| &mut row.answer.about.metric),
    ("unit", |row| &mut row.answer.about.unit),
    ("query", |row| &mut row.answer.about.query),
    ("sweep", |row| &mut row.answer.about.sweep),
    ("trials", |row| &mut row.answer.numbers.trials),
    ("part", |row| &mut row.number.part),
];

const COUNTS: [Lens<usize>; 16] = [
    ("answer", |row| &mut row.place),
    ("session", |row| &mut row.session),
    ("sessions", |row| &mut row.answer.numbers.sessions),
    ("left_out", |row| &mut row.answer.numbers.left_out),
    ("n", |row| &mut row.number.n),
    ("ran", |row| &mut row.number.ran),
    ("measured", |row| &mut row.number.measured),
    ("solved", |row| &mut row.number.solved),
    ("total", |row| &mut row.number.total),
    ("unended", |row| &mut row.number.unended),
    ("censored", |row| &mut row.number.censored),
    ("refused", |row| &mut row.number.refused),
    ("outside", |row| &mut row.number.outside),
    ("below", |row| &mut row.number.below),
    ("equal", |row| &mut row.number.equal),
    ("above", |row| &mut row.number.above),
];

const NUMBERS: [Lens<f64>; 3] = [
    ("refused_share", |row| &mut row.answer.numbers.refused),
    ("hits", |row| &mut row.number.hits),
    ("chances", |row| &mut row.number.chances),
];

/// Numbers that may be missing.
const MEASURES: [Lens<Option<f64>>; 4] = [
    ("value", |row| &mut row.number.value),
    ("least", |row| &mut row.number.least),
    ("greatest", |row| &mut row.number.greatest),
    ("deviation", |row| &mut row.number.deviation),
];

const FACTS: [Lens<bool>; 6] = [
    ("is_second_seed", |row| &mut row.is_second),
    ("has_more_instances", |row| &mut row.answer.is_more),
    ("is_covered", |row| &mut row.answer.numbers.is_covered),
    ("is_posed", |row| &mut row.answer.numbers.is_posed),
    ("is_agreed", |row| &mut row.number.is_agreed),
    ("is_exact", |row| &mut row.number.is_exact),
];

/// The rows of the table, those of the first seed first.
fn rows(estimates: &Estimates) -> Vec<Row> {
    let mut rows = Vec::new();
    let seeds = [(false, &estimates.first), (true, &estimates.second)].into_iter();
    let all = seeds.flat_map(|(is_second, seed)| {
        seed.iter().flat_map(move |seed| seed.answers.iter().map(move |one| (is_second, one)))
    });
    for (place, (is_second, one)) in all.enumerate() {
        let numbers = Numbers { by_session: Vec::new(), ..one.numbers.clone() };
        let answer = Answer { numbers, ..one.clone() };
        for (session, numbers) in one.numbers.by_session.iter().enumerate() {
            let row = |number: &Number| Row {
                is_second,
                place,
                answer: answer.clone(),
                session: session + 1,
                number: number.clone(),
            };
            rows.extend(numbers.iter().map(row));
        }
    }
    rows
}

/// The table as a frame.
fn frame(estimates: &Estimates) -> DataFrame {
    let mut rows = rows(estimates);
    let mut columns: Vec<Column> = Vec::new();
    for (name, field) in TEXTS {
        let cells: Vec<&str> = rows.iter_mut().map(|row| &**field(row)).collect();
        columns.push(Series::new(name.into(), cells).into());
    }
    for (name, field) in COUNTS {
        let cells: Vec<u64> = rows.iter_mut().map(|row| *field(row) as u64).collect();
        columns.push(Series::new(name.into(), cells).into());
    }
    for (name, field) in NUMBERS {
        let cells: Vec<f64> = rows.iter_mut().map(|row| *field(row)).collect();
        columns.push(Series::new(name.into(), cells).into());
    }
    for (name, field) in MEASURES {
        let cells: Vec<Option<f64>> = rows.iter_mut().map(|row| *field(row)).collect();
        columns.push(Series::new(name.into(), cells).into());
    }
    for (name, field) in FACTS {
        let cells: Vec<bool> = rows.iter_mut().map(|row| *field(row)).collect();
        columns.push(Series::new(name.into(), cells).into());
    }
    let ends: Vec<&str> = rows.iter().map(|row| row.number.ends.name()).collect();
    let drawn: Vec<Option<u64>> = rows.iter().map(|row| row.number.drawn.map(|drawn| drawn as u64)).collect();
    let [low, high] = [|ends: Interval| ends.low, |ends: Interval| ends.high]
        .map(|end| rows.iter().map(|row| row.number.interval.map(end)).collect::<Vec<Option<f64>>>());
    let places = |row: &Row| row.answer.places.iter().map(|place| *place as u64).collect::<Vec<u64>>();
    columns.extend([
        Series::new("ends".into(), ends).into(),
        Series::new("drawn".into(), drawn).into(),
        Series::new("low".into(), low).into(),
        Series::new("high".into(), high).into(),
        lists("interpretations", rows.iter().map(|row| Series::new("".into(), places(row)))),
        lists("values", rows.iter().map(|row| Series::new("".into(), row.number.values.as_slice()))),
    ]);
    DataFrame::new(rows.len(), columns).expect("every column has a cell a row")
}

fn lists(name: &'static str, cells: impl Iterator<Item = Series>) -> Column {
    Series::new(name.into(), cells.collect::<Vec<Series>>()).into()
}

/// The answers of both seeds that a frame has.
fn answers(frame: &DataFrame) -> PolarsResult<[Vec<Answer>; 2]> {
    let mut rows = vec![Row::default(); frame.height()];
    for (name, field) in TEXTS {
        let cells = frame.column(name)?.str()?.iter();
        rows.iter_mut().zip(cells).for_each(|(row, cell)| cell.unwrap_or_default().clone_into(field(row)));
    }
    for (name, field) in COUNTS {
        let cells = frame.column(name)?.u64()?.iter();
        rows.iter_mut().zip(cells).for_each(|(row, cell)| *field(row) = cell.unwrap_or_default() as usize);
    }
    for (name, field) in NUMBERS {
        let cells = frame.column(name)?.f64()?.iter();
        rows.iter_mut().zip(cells).for_each(|(row, cell)| *field(row) = cell.unwrap_or_default());
    }
    for (name, field) in MEASURES {
        rows.iter_mut().zip(frame.column(name)?.f64()?.iter()).for_each(|(row, cell)| *field(row) = cell);
    }
    for (name, field) in FACTS {
        let cells = frame.column(name)?.bool()?.iter();
        rows.iter_mut().zip(cells).for_each(|(row, cell)| *field(row) = cell.unwrap_or_default());
    }
    for (row, cell) in rows.iter_mut().zip(frame.column("ends")?.str()?.iter()) {
        row.number.ends = Ends::ALL.into_iter().find(|ends| Some(ends.name()) == cell).unwrap_or_default();
    }
    for (row, cell) in rows.iter_mut().zip(frame.column("drawn")?.u64()?.iter()) {
        row.number.drawn = cell.map(|drawn| drawn as usize);
    }
    let ends = frame.column("low")?.f64()?.iter().zip(frame.column("high")?.f64()?.iter());
    for (row, (low, high)) in rows.iter_mut().zip(ends) {
        row.number.interval = low.zip(high).map(|(low, high)| Interval::new(low, high));
    }
    let (places, values) = (frame.column("interpretations")?.list()?, frame.column("values")?.list()?);
    for (at, row) in rows.iter_mut().enumerate() {
        let (places, values) = (places.get_as_series(at), values.get_as_series(at));
        for place in places.as_ref().map(Series::u64).transpose()?.into_iter().flat_map(ChunkedArray::iter) {
            row.answer.places.push(place.unwrap_or_default() as usize);
        }
        for value in values.as_ref().map(Series::f64).transpose()?.into_iter().flat_map(ChunkedArray::iter) {
            row.number.values.push(value.unwrap_or_default());
        }
    }
    let mut found = [Vec::new(), Vec::new()];
    let mut last = None;
    for Row { is_second, place, mut answer, session, number } in rows {
        let own: &mut Vec<Answer> = &mut found[usize::from(is_second)];
        if last.replace(place) != Some(place) {
            answer.numbers.by_session.clear();
            own.push(answer);
        }
        let sessions =
            &mut own.last_mut().expect("a row of another answer is pushed first").numbers.by_session;
        let session = session.checked_sub(1).ok_or_else(|| {
            PolarsError::OutOfBounds("a number names session 0; sessions count from 1".into())
        })?;
        sessions.resize_with(sessions.len().max(session + 1), Vec::new);
        sessions[session].push(number);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Estimates with every kind of number, on both seeds.
    fn stored() -> Estimates {
        let whole = Number {
            value: Some(0.1),
            interval: Some(Interval::new(f64::NEG_INFINITY, 0.3)),
            ..Number::default()
        };
        let part = Number {
            part: "cell 1".to_owned(),
            ends: Ends::Most,
            drawn: Some(7),
            is_exact: true,
            values: vec![1.0, f64::INFINITY],
            ..Number::default()
        };
        let numbers = Numbers {
            by_session: vec![vec![whole.clone(), part], vec![whole]],
            sessions: 2,
            is_covered: true,
            refused: 0.25,
            trials: "ab".to_owned(),
            ..Numbers::default()
        };
        let about = About { claim: "fewer".to_owned(), ..About::default() };
        let measured: Measured = [("q".to_owned(), (about, numbers))].into();
        let other: Measured = [(
            "q".to_owned(),
            (About::default(), Numbers { by_session: vec![vec![Number::default()]], ..Numbers::default() }),
        )]
        .into();
        let options = BTreeMap::from([("ties".to_owned(), "fifo".to_owned())]);
        let mut first = Explored {
            trials: 3,
            interpretations: vec![BTreeMap::new(), options.clone(), options],
            ..Explored::default()
        };
        first.add([(0, &measured), (1, &other), (2, &measured)], false);
        first.add([(0, &other)], true);
        let mut second = Explored { interpretations: vec![BTreeMap::new()], ..Explored::default() };
        second.add([(0, &other)], false);
        Estimates { paper: "toy".to_owned(), first: Some(first), second: Some(second) }
    }

    #[test]
    fn estimates_are_read_as_they_were_written_and_equal_numbers_are_stored_once() {
        let stored = stored();
        let first = stored.first.as_ref().unwrap();
        let places: Vec<&[usize]> = first.answers.iter().map(|answer| &*answer.places).collect();
        assert_eq!(places, [&[0, 2][..], &[1], &[0]]);
        assert_eq!(first.answers_with_more().collect::<Vec<_>>(), [0]);
        assert_eq!(first.places()[&("q", false, 2)], 0);
        assert!(Estimates::from_bytes(stored.bytes()).unwrap() == stored);
        assert!(stored.bytes() == stored.bytes(), "the same estimates give other bytes");
    }

    #[test]
    fn a_place_or_a_session_that_does_not_exist_is_refused() {
        let read = |stored: &Estimates| Estimates::from_bytes(stored.bytes()).unwrap_err();
        let mut beyond = stored();
        beyond.first.as_mut().unwrap().answers[0].places.push(3);
        assert_eq!(read(&beyond), "a number names an interpretation that is not listed");
        let mut columns = frame(&stored());
        let sessions = Series::new("session".into(), vec![0_u64; columns.height()]);
        columns.with_column(sessions.into()).unwrap();
        let refused = answers(&columns).unwrap_err().to_string();
        assert!(refused.contains("session 0"), "{refused}");
    }

    #[test]
    fn any_flipped_bit_of_a_file_of_estimates_is_seen() {
        let whole = stored().bytes();
        assert!(is_sealed(&whole));
        for at in (0..whole.len()).step_by(7) {
            let mut bytes = whole.clone();
            bytes[at] ^= 4;
            assert!(!is_sealed(&bytes), "byte {at}");
        }
        assert!(!is_sealed(&whole[..whole.len() - 1]) && !is_sealed(b""));
    }
}
