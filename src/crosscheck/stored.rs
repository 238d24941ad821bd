//! Paths that a study kept, and the worlds that it posed.

use super::CrosscheckError;
use super::model::Freedom;
use super::path::Path as JointPath;
use base::settings::SettingsError;
use engine::space::World;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use study::key::Owner;
use study::manifest::Manifest;
use study::name::Names;
use study::record::{Kept, Row, Status};
use study::store::{open_traces, read_numbers};
use study::{Inputs, Interpretation, Study, StudyError};

/// Which paths of a study are judged.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StoredPaths {
    /// The study.
    pub study: String,
    /// The label of its problem group.
    pub problems: String,
    /// The trace that holds configurations, one a point.
    pub trace: String,
    /// Which of a point's numbers is the first joint's angle, from 0.
    pub first_joint: usize,
    /// The unit of the angles.
    pub unit: AngleUnit,
    /// What the study says the paths are free of, all the way.
    pub free_of: Freedom,
}

/// A unit of angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AngleUnit {
    /// Degrees.
    Deg,
    /// Radians.
    Rad,
}

impl StoredPaths {
    /// The paths of solved trials in the records below `runs`, of a robot with this many joints; the study lies in the
    /// paper's `folder`.
    ///
    /// # Errors
    /// A study that is wrong; a run that is missing or damaged, or that kept no such path.
    pub fn read(
        &self,
        folder: &Path,
        inputs: &Inputs,
        runs: &Path,
        joints: usize,
    ) -> Result<Vec<JointPath>, CrosscheckError> {
        let names = self.study(folder, inputs)?.names();
        let manifest = Manifest::read(runs, &self.study)?;
        let records = read_numbers(runs, &self.study, &manifest.files)?;
        let rows = records.batch.rows.iter();
        let is_solved = |row: &&Row| row.status == Status::Solved && *row.key.on.group == *self.problems;
        let solved: BTreeSet<Owner> = rows.filter(is_solved).map(|row| Owner::from(&row.key)).collect();
        // A group may also hold paths of a bare point, which are narrower.
        let is_wanted = |kept: &Kept| {
            kept.trace.name == self.trace
                && kept.trace.width >= self.first_joint + joints
                && solved.contains(&kept.of)
        };
        let mut paths = Vec::new();
        let mut stored = open_traces(runs, &self.study, &manifest.files)?;
        while let Some(kept) = stored.next_one()? {
            let path = is_wanted(&kept).then(|| self.path(&kept, &names, joints));
            paths.extend(path.filter(|path| path.stops_rad.len() > 1));
        }
        if paths.is_empty() {
            let reason = format!(
                "the stored run of study `{}` kept no trace `{}` of a solved trial of problems `{}`",
                self.study, self.trace, self.problems
            );
            return Err(StudyError::stored(Manifest::path(runs, &self.study), reason).into());
        }
        Ok(paths)
    }

    fn path(&self, kept: &Kept, names: &Names, joints: usize) -> JointPath {
        let angle = |value: &f64| if self.unit == AngleUnit::Deg { value.to_radians() } else { *value };
        let stop = |row: &[f64]| row.iter().skip(self.first_joint).take(joints).map(angle).collect();
        let rows = kept.trace.values.chunks_exact(kept.trace.width);
        JointPath { name: names.owner(&kept.of), stops_rad: rows.map(stop).collect() }
    }

    fn study(&self, folder: &Path, inputs: &Inputs) -> Result<Study, StudyError> {
        Study::load(&folder.join(format!("{}.toml", self.study)), inputs)
    }

    /// The world that the study, in the paper's `folder`, poses under its default interpretation; `misnamed` makes an error about
    /// one of these settings.
    ///
    /// # Errors
    /// A study or problem group that does not exist or is wrong.
    pub fn world(
        &self,
        folder: &Path,
        inputs: &Inputs,
        misnamed: &dyn Fn(&str, String) -> SettingsError,
    ) -> Result<World, CrosscheckError> {
        let study = self.study(folder, inputs)?;
        let group = study.groups.iter().find(|group| group.label == self.problems).ok_or_else(|| {
            let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
            let message =
                format!("there are no problems `{}`; there are {}", self.problems, known.join(", "));
            misnamed("problems", message)
        })?;
        let point = Interpretation::new(&study.choices, &BTreeMap::new());
        let point = point.expect("a loaded study's defaults are among its options");
        let preprocessing = group.family(&group.points[0], &point, inputs)?.prepare(0);
        Ok(preprocessing.map_err(|invalid| misnamed("problems", invalid.0))?.world)
    }
}
