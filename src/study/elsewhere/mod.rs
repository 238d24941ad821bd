//! Trials that were recorded elsewhere, as records.
//!
//! A table of results (comma-separated values, Parquet, a benchmark log of OMPL) becomes rows through a [`Mapping`] of its columns to
//! keys and metrics. Seeds are unknown, and no path was verified: a trial is solved if its table says so. With a study whose
//! problems and planners are `recorded`, the records are that study's, and claims are judged by them; without one they can be
//! compared and gated.

mod log;
mod mapping;
mod table;

pub use log::read_log;
pub use mapping::Mapping;
pub use table::Table;

use crate::choice::Interpretation;
use crate::error::StudyError;
use crate::inputs::Inputs;
use crate::key::{InstanceKey, InterpretationKey, KeyColumns, SweepKey, TrialKey};
use crate::manifest::{MadeBy, Manifest};
use crate::record::{Batch, Row};
use crate::runner::BuiltStudy;
use crate::store::{Columns, Records, Staged, Traces, stage_records};
use crate::{Study, column};
use base::hash::sha256;
use base::settings::none_called;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

/// What of a row is known before it is one of a study.
#[derive(Debug, Clone)]
struct Trial {
    line: usize,
    group: String,
    instance: String,
    contender: String,
    repeat: u32,
    row: Row,
}

/// Rows that were recorded elsewhere.
#[derive(Debug)]
pub struct Imported {
    trials: Vec<Trial>,
    source: String,
}

impl Imported {
    /// The rows of `table` by `mapping`.
    ///
    /// # Errors
    /// A column that the table lacks, a cell that cannot be read, a trial that stands there twice: each at its line.
    pub fn new(table: &Table, mapping: &Mapping) -> Result<Self, StudyError> {
        let mut trials = mapping.trials(table)?;
        number_instances(&mut trials);
        trials.sort_by(|one, other| one.row.key.cmp(&other.row.key));
        if let Some(twice) = trials.windows(2).find(|pair| pair[0].row.key == pair[1].row.key) {
            let [first, second] = [twice[0].line, twice[1].line];
            let [before, after] = [first.min(second), first.max(second)];
            let message = format!(
                "{} is the same trial as {}: `{}` on instance `{}` of `{}`, repeat {}; a `repeat` column tells trials apart",
                table.place(after),
                table.place(before),
                twice[0].contender,
                twice[0].instance,
                twice[0].group,
                twice[0].repeat
            );
            return Err(table.error(&message));
        }
        Ok(Self { trials, source: table.source() })
    }

    /// How many trials there are.
    pub fn count(&self) -> usize {
        self.trials.len()
    }

    /// Stages the rows in `folder` as records of a study called `name` that no spec describes.
    ///
    /// # Errors
    /// [`StudyError::Io`].
    pub fn stage_alone(
        &self,
        staged: &mut Staged,
        folder: &Path,
        name: &str,
        command: String,
    ) -> Result<(), StudyError> {
        let contenders: BTreeSet<&str> = self.trials.iter().map(|trial| trial.contender.as_str()).collect();
        let spec = sha256(self.source.as_bytes());
        let manifest = Manifest {
            study: name.to_owned(),
            command,
            interpretations: vec![Vec::new()],
            depends: spec.clone(),
            spec,
            recorded: contenders.into_iter().map(str::to_owned).collect(),
            made_by: MadeBy { replan: env!("CARGO_PKG_VERSION").to_owned(), ..MadeBy::default() },
            ..Manifest::default()
        };
        let filled: BTreeSet<&str> = self
            .trials
            .iter()
            .flat_map(|trial| trial.row.values.iter().map(|(column, _)| column.name))
            .collect();
        let values = column::COLUMNS.iter().map(|column| column.name).filter(|name| filled.contains(name));
        let columns = Columns { keys: KeyColumns::default(), values: values.collect() };
        let rows = self.trials.iter().map(|trial| trial.row.clone()).collect();
        self.stage(staged, folder, manifest, &columns, Batch { rows, ..Batch::default() })
    }

    /// Stages the rows in `folder` as the records of `study`, under its defaults.
    ///
    /// # Errors
    /// A study with parts that are not recorded elsewhere; a row whose group, instance or contender it lacks; a trial of it without
    /// a row; [`StudyError::Io`].
    pub fn stage_of(
        &self,
        staged: &mut Staged,
        folder: &Path,
        study: &Study,
        inputs: &Inputs,
        command: String,
    ) -> Result<(), StudyError> {
        let refused = |message: String| StudyError::Settings(study.document.error_at("", message));
        let ours = study.contenders.iter().find(|contender| !contender.is_elsewhere());
        if let Some(ours) = ours.map(|own| &own.label).or(study.contenders.is_empty().then_some(&study.name))
        {
            return Err(refused(format!(
                "`{ours}` can run here; contenders with `planner = \"recorded\"` are accepted"
            )));
        }
        let points = vec![Interpretation::new(&study.choices, &BTreeMap::new()).map_err(refused)?];
        let built = BuiltStudy::new(study, &points, inputs)?;
        let mut wanted: BTreeSet<TrialKey> = built.units().flat_map(|unit| built.trials(&unit)).collect();
        let key = points[0].key(&study.choices);
        // Of every unit its object, without which no stored trial is used again.
        let preprocessing = built.units().flat_map(|unit| built.run_unit(&unit).preprocessing).collect();
        let mut rows = Vec::new();
        for trial in &self.trials {
            let mut trial = trial.clone();
            trial.row.key.on =
                Arc::new(InstanceKey { interpretation: key.clone(), ..(*trial.row.key.on).clone() });
            if !wanted.remove(&trial.row.key) {
                return Err(refused(lacks(study, &trial)));
            }
            rows.push(trial.row);
        }
        if let Some(missing) = wanted.first() {
            let name = study.names().trial(missing);
            return Err(refused(format!(
                "no row of the table is the trial {}/{name}; a trial that failed is a row with a status",
                study.name
            )));
        }
        let manifest = Manifest::new(study, &points, &built, command, false)?;
        let columns = Columns::new(study);
        let batch = Batch { rows, preprocessing, kept: Vec::new() };
        self.stage(staged, folder, manifest, &columns, batch)
    }

    fn stage(
        &self,
        staged: &mut Staged,
        folder: &Path,
        manifest: Manifest,
        columns: &Columns,
        batch: Batch,
    ) -> Result<(), StudyError> {
        let records = Records { batch, times: Vec::new() };
        let files = stage_records(staged, folder, &manifest.study, columns, &records, Traces::held(&[]))?;
        Manifest { files, elsewhere: Some(self.source.clone()), ..manifest }.stage(staged, folder)
    }
}

/// Why `study` has no place for a trial.
fn lacks(study: &Study, trial: &Trial) -> String {
    let groups = study.groups.iter().map(|group| group.label.as_str());
    let contenders = study.contenders.iter().map(|contender| contender.label.as_str());
    let line = trial.line;
    let Some(group) = study.groups.iter().find(|group| group.label == trial.group) else {
        return format!("row {line}: {}", none_called("problem group", &trial.group, groups));
    };
    if !contenders.clone().any(|label| label == trial.contender) {
        return format!("row {line}: {}", none_called("contender", &trial.contender, contenders));
    }
    format!(
        "row {line}: instance `{}` of `{}` is number {}, repeat {}; the study has {} instances, and contender `{}` its repeats",
        trial.instance,
        trial.group,
        trial.row.key.on.instance + 1,
        trial.repeat,
        group.instances,
        trial.contender
    )
}

/// Gives each instance the number at which its group first names it.
fn number_instances(trials: &mut [Trial]) {
    let mut known: BTreeMap<String, BTreeMap<String, u32>> = BTreeMap::new();
    for trial in trials {
        let of_group = known.entry(trial.group.clone()).or_default();
        let next = of_group.len() as u32;
        let instance = *of_group.entry(trial.instance.clone()).or_insert(next);
        trial.row.key = TrialKey {
            on: Arc::new(InstanceKey {
                group: trial.group.as_str().into(),
                sweep: SweepKey::default(),
                instance,
                interpretation: InterpretationKey::default(),
            }),
            query: None,
            contender: trial.contender.as_str().into(),
            sweep: SweepKey::default(),
            repeat: trial.repeat,
        };
    }
}
