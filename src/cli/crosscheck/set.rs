//! A sample of a study's solved trials on a set of problems: run again for their paths, which runs need not keep, and judged each among its own
//! obstacles.

use super::super::Failure;
use super::super::places::Places;
use super::spec::{Case, SetEntry, Spec};
use super::subject::OpenArm;
use base::seed;
use engine::space::roadmap::Local;
use rand::seq::SliceRandom as _;
use rayon::prelude::*;
use std::path::Path;
use study::family::Family;
use study::manifest::Manifest;
use study::record::{Batch, Row};
use study::session::run_one;
use study::store::{Columns, Records, Staged, Traces, read_endings, stage_records};
use study::{Interpretation, Study, StudyError, slug};

/// The sample of a set.
pub struct Sample<'a> {
    entry: &'a SetEntry,
    study: Study,
    point: Interpretation,
    family: Box<dyn Family>,
    rows: Vec<Row>,
}

impl<'a> Sample<'a> {
    /// Draws the trials of the set at `place` in `spec`.
    ///
    /// # Errors
    /// Code 4 if an archive is missing, with the command that brings it; fewer solved trials than the sample.
    pub fn draw(
        spec: &Spec,
        (place, entry): (String, &'a SetEntry),
        places: &Places,
    ) -> Result<Self, Failure> {
        let paths = &entry.paths;
        let (study, point, family) =
            spec.posed(paths, &format!("{place}.paths"), &places.folder, &places.inputs)?;
        if let Some(lacks) = family.lacks() {
            return Err(
                StudyError::LacksFiles { study: study.name, group: paths.problems.clone(), lacks }.into()
            );
        }
        let manifest = Manifest::read(&places.runs, &study.name)?;
        let mut rows = read_endings(&places.runs, &study.name, &manifest.files)?;
        let interpretation = point.key(&study.choices);
        let is_meant =
            |row: &Row| *row.key.on.group == *paths.problems && row.key.on.interpretation == interpretation;
        rows.retain(|row| row.is_solved() && is_meant(row));
        let count = entry.sample as usize;
        let solved = rows.len();
        if solved < count {
            let message = format!(
                "`sample` is {count}; {solved} trials are solved in the stored run, and as many are accepted"
            );
            return Err(spec.fault(&format!("{place}.sample"), message).into());
        }
        let seed = seed::derive(spec.seed(), &["sample", &entry.label]);
        let mut order: Vec<usize> = (0..solved).collect();
        let (drawn, _) = order.partial_shuffle(&mut seed::stream(seed), count);
        drawn.sort_unstable();
        let rows = drawn.iter().map(|place| rows[*place].clone()).collect();
        Ok(Self { entry, study, point, family, rows })
    }

    /// What the judge calls the set's cases: by their numbers in the sample.
    fn names(&self) -> impl Iterator<Item = String> {
        (1..=self.rows.len()).map(|number| slug(&format!("{} {number}", self.entry.label)))
    }

    /// The robot in each problem.
    ///
    /// # Errors
    /// The study's group is no set of problems in joint space.
    pub fn cases(&self) -> Result<Vec<Case>, Failure> {
        let case = |(name, row): (String, &Row)| {
            let wrong = |message: String| {
                Failure::input(format!("crosscheck.toml: set `{}`: {message}", self.entry.label))
            };
            let prepared =
                self.family.prepare(u64::from(row.instance())).map_err(|invalid| wrong(invalid.0))?;
            let local = prepared.world.as_roadmap().map(engine::space::roadmap::Roadmap::local);
            let (Some(Local::Joints(space)), true) = (local, self.family.numbers_instances()) else {
                return Err(wrong(format!(
                    "`{}` is no set of problems in joint space; one is accepted",
                    self.entry.paths.problems
                )));
            };
            let arm = OpenArm::in_space(space).map_err(|error| wrong(error.to_string()))?;
            Ok((name, Box::new(arm) as _))
        };
        self.names().zip(&self.rows).map(case).collect()
    }

    /// Runs the trials again and writes them with their paths to `folder`, as a run is stored.
    ///
    /// # Errors
    /// Code 3 if one does not come out as it is stored.
    pub fn write(&self, places: &Places, folder: &Path) -> Result<(), Failure> {
        let study = &self.study;
        let again = |row: &Row| {
            let trial = study.names().trial(&row.key);
            let points = [self.point.clone()];
            let (batch, stored) = run_one(study, &points, &places.inputs, &places.runs, &trial)?;
            if batch.rows.first() == stored.as_ref() {
                return Ok(batch);
            }
            Err(Failure::stale(format!("trial `{}/{trial}` does not come out as it is stored", study.name)))
        };
        let batches = self.rows.par_iter().map(again).collect::<Result<Vec<_>, Failure>>()?;
        let mut batch = batches.into_iter().fold(Batch::default(), Batch::with);
        batch.kept.retain(|kept| kept.trace.name == self.entry.paths.trace);
        let records = Records { batch, times: Vec::new() };
        let columns = Columns::new(study);
        let mut staged = Staged::default();
        let traces = Traces::held(&records.batch.kept);
        stage_records(&mut staged, folder, &study.name, &columns, &records, traces)?;
        Ok(staged.put()?)
    }
}
