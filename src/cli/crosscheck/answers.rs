//! Our answers to the questions that Python posed, as Parquet files beside them.
//!
//! `scene.questions.parquet` has one row a configuration: `q1`, `q2`, …, radians, and whether `frames` and `limits` are requested.
//! Beside it are written
//!
//! - `replan.gaps.parquet`: a row a configuration, a column a pair, metres: at most 0 in contact;
//! - `replan.frames.parquet`: a row for each that asks for frames: `link_1.x`, … `link_1.zz`, place and rotation, row by row;
//! - `replan.limits.parquet`: a row for each that asks for limits, a column a joint: whether it is beyond;
//! - `replan.planners.parquet`, if planners check this robot: whether it is `free`, and `of_scene` if it may hit itself.

use super::super::Failure;
use super::subject::{Standable, Subject};
use engine::geometry::Frame;
use polars::prelude::{Column, DataFrame, NamedFrom as _, Series};
use rayon::prelude::*;
use std::fs::File;
use std::path::Path;
use study::parquet::{FrameReader, write_frame};
use study::store::write_whole;

/// The questions about the right model.
pub const QUESTIONS: &str = "scene.questions.parquet";
/// The numbers of a frame: place, and rotation row by row.
const PARTS: [&str; 12] = ["x", "y", "z", "xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];

/// Answers the questions in `folder` by `subject`.
///
/// # Errors
/// Questions that are missing or do not fit the subject.
pub fn answer(subject: &dyn Subject, folder: &Path) -> Result<(), Failure> {
    let questions = Questions::read(folder, subject.joints())?;
    let rows = &questions.q_rad;
    let gaps: Vec<Vec<f64>> = rows.par_iter().map(|q| subject.gaps_m(q)).collect();
    write(folder, "gaps", gaps.len(), numbers(subject.pairs(), &gaps))?;
    let frames: Vec<Vec<f64>> = questions
        .rows(&questions.frames)
        .map(|q| subject.frames(q).iter().flat_map(in_numbers).collect())
        .collect();
    let links = (1..=subject.joints()).map(|link| format!("link_{link}"));
    let names = links.chain(["tool".to_owned()]);
    let names = names.flat_map(|frame| PARTS.map(|part| format!("{frame}.{part}"))).collect();
    write(folder, "frames", frames.len(), numbers(names, &frames))?;
    let limited: Vec<&Vec<f64>> = questions.rows(&questions.limits).collect();
    let limits = (0..subject.joints()).map(|joint| {
        let beyond = limited.iter().map(|q| subject.is_beyond(joint, q[joint])).collect();
        truths(&format!("joint_{}", joint + 1), beyond)
    });
    write(folder, "limits", limited.len(), limits.collect())?;
    let checked: Option<Vec<Standable>> = rows.par_iter().map(|q| subject.standable(q)).collect();
    let Some(checked) = checked else { return Ok(()) };
    let free = truths("free", checked.iter().map(|found| found.is_free).collect());
    let of_scene = truths("of_scene", checked.iter().map(|found| found.of_scene).collect());
    write(folder, "planners", checked.len(), vec![free, of_scene])
}

struct Questions {
    q_rad: Vec<Vec<f64>>,
    frames: Vec<bool>,
    limits: Vec<bool>,
}

impl Questions {
    fn read(folder: &Path, joints: usize) -> Result<Self, Failure> {
        let path = folder.join(QUESTIONS);
        let wrong = |reason: String| Failure::stale(format!("{}: {reason}", path.display()));
        let file = File::open(&path).map_err(|error| wrong(error.to_string()))?;
        let frame = FrameReader::open(file).and_then(|mut file| file.frame());
        let frame = frame.map_err(|error| wrong(format!("is no table of questions: {error}")))?;
        let column = |name: &str| frame.column(name).map_err(|_| wrong(format!("has no column `{name}`")));
        let numbers = |name: String| -> Result<Vec<f64>, Failure> {
            let cells = column(&name)?.f64().map_err(|error| wrong(error.to_string()))?;
            Ok(cells.iter().flatten().collect())
        };
        let flags = |name: &str| -> Result<Vec<bool>, Failure> {
            let cells = column(name)?.bool().map_err(|error| wrong(error.to_string()))?;
            Ok(cells.iter().flatten().collect())
        };
        let angles = (1..=joints).map(|joint| numbers(format!("q{joint}"))).collect::<Result<Vec<_>, _>>()?;
        if angles.iter().any(|column| column.len() != frame.height()) {
            return Err(wrong("an angle is missing".to_owned()));
        }
        let row = |row: usize| angles.iter().map(|column| column[row]).collect();
        Ok(Self {
            q_rad: (0..frame.height()).map(row).collect(),
            frames: flags("frames")?,
            limits: flags("limits")?,
        })
    }

    /// The configurations that ask for something.
    fn rows<'a>(&'a self, asks: &'a [bool]) -> impl Iterator<Item = &'a Vec<f64>> {
        self.q_rad.iter().zip(asks).filter(|(_, asks)| **asks).map(|(q_rad, _)| q_rad)
    }
}

/// Place and rotation, row by row.
fn in_numbers(frame: &Frame) -> Vec<f64> {
    let rotation = frame.rotation.transpose();
    frame.origin.iter().chain(rotation.iter()).copied().collect()
}

/// A column a name from rows of numbers.
fn numbers(names: Vec<String>, rows: &[Vec<f64>]) -> Vec<Column> {
    let column = |(index, name): (usize, String)| {
        Series::new(name.into(), rows.iter().map(|row| row[index]).collect::<Vec<f64>>()).into()
    };
    names.into_iter().enumerate().map(column).collect()
}

fn truths(name: &str, cells: Vec<bool>) -> Column {
    Series::new(name.into(), cells).into()
}

fn write(folder: &Path, part: &str, height: usize, columns: Vec<Column>) -> Result<(), Failure> {
    let frame = DataFrame::new(height, columns).expect("columns are as long as the answers are many");
    let mut bytes = Vec::new();
    write_frame(&mut bytes, frame, Vec::new()).expect("a frame of equally long columns is written to memory");
    Ok(write_whole(&folder.join(format!("replan.{part}.parquet")), &bytes)?)
}
