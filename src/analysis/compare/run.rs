//! Stored runs as comparisons read them: numbers without traces, by contender.

use super::pair::Instances;
use stats::summary;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use study::StudyError;
use study::key::TrialKey;
use study::manifest::Manifest;
use study::name::Names;
use study::record::Row;
use study::store::{Records, read_numbers};

/// A stored run: the records of every study in a folder, without traces.
pub struct StoredRun {
    /// What it is called.
    pub name: String,
    /// By study, what its records depend on, and the records.
    pub studies: BTreeMap<String, (Manifest, Records)>,
}

/// The median time of each timed trial.
pub type Times<'r> = BTreeMap<&'r TrialKey, f64>;

/// The records of one study on one side, ready for questions.
pub struct Seen<'r> {
    /// What they depend on.
    pub manifest: &'r Manifest,
    /// The trials by contender, in the order of records.
    pub rows: BTreeMap<&'r str, Vec<&'r Row>>,
    /// The instances.
    pub instances: Instances<'r>,
    /// The times of the first session.
    pub times: Times<'r>,
    /// How records are named, as far as the records show it.
    pub names: Names,
}

impl StoredRun {
    /// Reads every study in `folder`.
    ///
    /// # Errors
    /// [`StudyError::Missing`] if no run is stored there, [`StudyError::Stored`] for what is damaged.
    pub fn read(folder: &Path, name: &str) -> Result<Self, StudyError> {
        let mut studies = BTreeMap::new();
        for study in stored_studies(folder) {
            let manifest = Manifest::read(folder, &study)?;
            let records = read_numbers(folder, &study, &manifest.files)?;
            studies.insert(study, (manifest, records));
        }
        if studies.is_empty() {
            let what = "no stored run; a folder with a *.manifest.toml is expected".to_owned();
            return Err(StudyError::Missing { path: folder.to_owned(), what });
        }
        Ok(Self { name: name.to_owned(), studies })
    }
}

/// The studies with a stored run in `folder`, in the order of their names.
pub fn stored_studies(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let name =
        |entry: fs::DirEntry| Some(entry.file_name().to_str()?.strip_suffix(".manifest.toml")?.to_owned());
    let mut studies: Vec<String> = entries.filter_map(name).collect();
    studies.sort();
    studies
}

impl<'r> Seen<'r> {
    /// The numbers of a stored study.
    pub fn new((manifest, records): &'r (Manifest, Records)) -> Self {
        let mut rows: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
        for row in &records.batch.rows {
            rows.entry(&row.key.contender).or_default().push(row);
        }
        let mut times: BTreeMap<&TrialKey, Vec<f64>> = BTreeMap::new();
        for time in records.times.iter().filter(|time| time.session == 1) {
            times.entry(&time.trial).or_default().push(time.plan_wall_ns as f64);
        }
        let times = times.into_iter().filter_map(|(key, times)| Some((key, summary::median(&times)?)));
        let times = times.collect();
        let instances = Instances::new(&records.batch);
        Self { manifest, rows, instances, times, names: names(manifest, &records.batch.rows) }
    }

    /// How many trials there are.
    pub fn count(&self) -> usize {
        self.rows.values().map(Vec::len).sum()
    }
}

/// How trials are named, as far as records alone tell.
fn names(manifest: &Manifest, rows: &[Row]) -> Names {
    let mut groups = BTreeMap::new();
    let mut contenders = BTreeMap::new();
    for row in rows {
        *groups.entry(&*row.key.on.group).or_insert(false) |= row.instance() > 0;
        *contenders.entry(&*row.key.contender).or_insert(false) |= row.key.repeat > 0;
    }
    let defaults = manifest.choices.iter().zip(manifest.interpretations.iter().flatten());
    let defaults = defaults.map(|(choice, option)| (choice.as_str(), option.as_str()));
    Names::new(groups.into_iter(), contenders.into_iter(), defaults)
}
