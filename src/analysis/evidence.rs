//! The records that claims are judged by.

use super::metric::Metric;
use super::polylines::Polylines;
use engine::planner::Trace;
use rayon::prelude::*;
use stats::summary;
use std::collections::BTreeMap;
use std::mem;
use std::path::Path;
use std::sync::Arc;
use study::key::{InterpretationKey, Owner, Text, TrialKey};
use study::manifest::Manifest;
use study::name::Names;
use study::paper::Paper;
use study::record::{PreprocessingRow, Row, Status};
use study::store::{KeptTraces, Records, read_numbers};
use study::{Interpretation, Study, StudyError};

/// A paper with the stored runs of its studies.
pub struct Evidence<'a> {
    /// The paper.
    pub paper: &'a Paper,
    /// The interpretation that claims are judged under.
    pub point: Interpretation,
    runs: BTreeMap<&'a str, Run<'a>>,
    polylines: Arc<Polylines>,
}

/// The stored run of one study, as seen under one interpretation.
#[derive(Clone)]
pub struct Run<'a> {
    /// The study.
    pub study: &'a Study,
    /// What the records depend on.
    pub manifest: Arc<Manifest>,
    /// The records, without traces.
    pub records: Arc<Records>,
    kept: Arc<KeptTraces>,
    interpretation: InterpretationKey,
    /// The session of the clock, from 1.
    session: u32,
    index: Arc<Index>,
}

/// Where things are in the records.
#[derive(Default)]
struct Index {
    /// How records are named.
    names: Names,
    /// Rows by interpretation, group and contender, in the order of records.
    rows: BTreeMap<InterpretationKey, Groups>,
    /// The times of each timed trial in nanoseconds, by session, from 1; times of several sessions are never pooled.
    times_ns: Vec<BTreeMap<TrialKey, Vec<f64>>>,
}

/// Rows by group and contender.
type Groups = BTreeMap<Text, BTreeMap<Text, Vec<usize>>>;

/// Trials of two contenders on one problem.
pub struct Pair<'a> {
    /// The one that the other is compared with.
    pub base: &'a Row,
    /// The other.
    pub other: &'a Row,
}

impl<'a> Evidence<'a> {
    /// Reads the runs of every study of `paper` from `folder`, to be judged under the interpretation `point`.
    ///
    /// # Errors
    /// [`StudyError::Stored`] for a run that is missing, [`StudyError::Touched`] for one that is damaged or made by another spec.
    pub fn read(paper: &'a Paper, point: Interpretation, folder: &Path) -> Result<Self, StudyError> {
        let read = |study: &'a Study| Ok((study.name.as_str(), Run::read(study, &point, folder)?));
        // Gathered in order before any error is passed on, so that it is the first study's.
        let runs: Vec<Result<_, StudyError>> = paper.studies.par_iter().map(read).collect();
        let runs = runs.into_iter().collect::<Result<_, _>>()?;
        Ok(Self { paper, point, runs, polylines: Arc::default() })
    }

    /// Runs of the studies of `paper` that were not read from a folder, to be judged under the interpretation `point`.
    /// Each study's name leads to its manifest and its records. Studies that are not named have no run.
    pub fn held(
        paper: &'a Paper,
        point: Interpretation,
        mut stored: BTreeMap<String, (Manifest, Records)>,
    ) -> Self {
        let run = |study: &'a Study| {
            let (manifest, records) = stored.remove(&study.name)?;
            Some((study.name.as_str(), Run::new(study, &point, manifest, records)))
        };
        let runs = paper.studies.iter().filter_map(run).collect();
        Self { paper, point, runs, polylines: Arc::default() }
    }

    /// The same, but for studies that were run under other interpretations elsewhere: each given by the study that ran and the one
    /// whose claims it answers.
    #[must_use]
    pub fn with(mut self, explored: Vec<(&'a Study, &'a Study, Manifest, Records)>) -> Self {
        for (ran, answers, manifest, records) in explored {
            let run = Run::new(ran, &self.point, manifest, records);
            self.runs.insert(ran.name.as_str(), run.under(&self.point));
            self.runs.insert(answers.name.as_str(), run);
        }
        self
    }

    /// The shortest polylines, searched once however many rules ask under however many interpretations.
    pub fn polylines(&self) -> &Polylines {
        &self.polylines
    }

    /// It, with polylines that an earlier command found and kept in `file`.
    #[must_use]
    pub fn remembering(self, file: &Path) -> Self {
        Self { polylines: Arc::new(Polylines::kept_in(file)), ..self }
    }

    /// Keeps the polylines that were found for a later command.
    pub fn keep_polylines(&self) {
        self.polylines.keep();
    }

    /// The same records, to be judged under another interpretation.
    #[must_use]
    pub fn under(&self, point: Interpretation) -> Self {
        let runs = self.runs.iter().map(|(name, run)| (*name, run.under(&point))).collect();
        Self { paper: self.paper, point, runs, polylines: self.polylines.clone() }
    }

    /// The same records, with the clock as it was read in the session of this number, from 1.
    #[must_use]
    pub fn in_session(&self, session: u32) -> Self {
        let runs =
            self.runs.iter().map(|(name, run)| (*name, Run { session, ..run.under(&self.point) })).collect();
        Self { paper: self.paper, point: self.point.clone(), runs, polylines: self.polylines.clone() }
    }

    /// The run of the study called `name`.
    pub fn run(&self, name: &str) -> Option<&Run<'a>> {
        self.runs.get(name)
    }

    /// Every run, in the order of the studies' names.
    pub fn runs(&self) -> impl Iterator<Item = &Run<'a>> {
        self.runs.values()
    }

    /// That every wanted trace could be read.
    ///
    /// # Errors
    /// [`StudyError::Touched`] for the first file that could not.
    pub fn traces_read(&self) -> Result<(), StudyError> {
        self.runs().try_for_each(|run| run.kept.damage())
    }
}

/// The default point over the interpretations of all studies of `paper`.
pub fn default_point(paper: &Paper) -> Interpretation {
    Interpretation::new(&paper.choices, &BTreeMap::new())
        .expect("a loaded study's defaults are among its options")
}

impl<'a> Run<'a> {
    fn read(study: &'a Study, point: &Interpretation, folder: &Path) -> Result<Self, StudyError> {
        let manifest = Manifest::read(folder, &study.name)?;
        if manifest.spec != study.run_hash() {
            let path = Manifest::path(folder, &study.name);
            let reason = format!(
                "the stored run was made by another spec; `replan run` runs study `{}` again",
                study.name
            );
            return Err(StudyError::Touched(format!("{}: {reason}", path.display())));
        }
        let records = read_numbers(folder, &study.name, &manifest.files)?;
        let kept = KeptTraces::stored(folder, &study.name, &manifest.files)?;
        Ok(Self { kept: Arc::new(kept), ..Self::new(study, point, manifest, records) })
    }

    fn new(study: &'a Study, point: &Interpretation, manifest: Manifest, mut records: Records) -> Self {
        let kept = Arc::new(KeptTraces::held(mem::take(&mut records.batch.kept)));
        let index = Arc::new(Index::new(study.names(), &records));
        let interpretation = point.for_trials(&study.choices).key(&study.choices);
        let manifest = Arc::new(manifest);
        let records = Arc::new(records);
        Self { study, manifest, records, kept, interpretation, session: 1, index }
    }

    fn under(&self, point: &Interpretation) -> Self {
        let interpretation = point.for_trials(&self.study.choices).key(&self.study.choices);
        Self { interpretation, ..self.clone() }
    }

    /// The run with the times of one stored session of the clock, from 1.
    pub(super) fn in_session(&self, session: u32) -> Self {
        Self { session, ..self.clone() }
    }

    /// How many sessions of the clock are stored.
    pub fn sessions(&self) -> usize {
        self.index.times_ns.len()
    }

    fn times(&self, row: &Row) -> Option<&Vec<f64>> {
        self.index.times_ns.get(self.session as usize - 1)?.get(&row.key)
    }

    /// Whether its trials ran under the interpretation.
    pub fn is_covered(&self) -> bool {
        self.manifest.covers(&self.interpretation)
    }

    /// What `metric` is for `row`; `None` if it was not measured.
    pub fn value(&self, row: &Row, metric: &Metric) -> Option<f64> {
        self.reader(metric)(row)
    }

    /// [`value`](Self::value) for many rows: where the metric stands is looked up once.
    pub fn reader<'r>(&'r self, metric: &'r Metric) -> impl Fn(&Row) -> Option<f64> + 'r {
        metric.reader(|row| self.times(row).and_then(|times| summary::median(times)))
    }

    /// Every time of `row` in the unit of `metric`; none if it was not timed or `metric` is not of the clock.
    pub fn repeats(&self, row: &Row, metric: &Metric) -> Vec<f64> {
        let times = self.times(row).filter(|_| metric.is_clock());
        times.into_iter().flatten().map(|time| time * metric.scale).collect()
    }

    /// The trials of `contender` in the problem group `group` under the interpretation, in the order of instances.
    pub fn rows(&self, group: &str, contender: &str) -> Vec<&Row> {
        let of_interpretation = self.index.rows.get(&self.interpretation);
        let found = of_interpretation.and_then(|groups| groups.get(group)?.get(contender));
        found.into_iter().flatten().map(|row| &self.records.batch.rows[*row]).collect()
    }

    /// The name of a trial, with its study, as `--trial` takes it.
    pub fn trial(&self, row: &Row) -> String {
        format!("{}/{}", self.study.name, self.index.names.trial(&row.key))
    }

    /// The name of the problem that a trial is about: group, instance and query.
    pub fn problem(&self, row: &Row) -> String {
        self.index.names.problem(&row.key.on, row.key.query.as_deref())
    }

    /// The name of a preprocessed object or a trial.
    pub fn owner(&self, of: &Owner) -> String {
        self.index.names.owner(of)
    }

    /// The trials of two contenders on the same problems, solved by both.
    pub fn pairs(&self, group: &str, base: &str, other: &str) -> Vec<Pair<'_>> {
        if base == other {
            let solved = self.rows(group, base).into_iter().filter(|row| row.status == Status::Solved);
            return solved.map(|row| Pair { base: row, other: row }).collect();
        }
        let solved = |row: &&Row| row.status == Status::Solved;
        let [bases, others] =
            [base, other].map(|contender| self.rows(group, contender).into_iter().filter(solved).collect());
        paired(others, bases).into_iter().map(|(other, base)| Pair { base, other }).collect()
    }

    /// How many queries of the problem group `group` can be posed on its first instance, and how many it has.
    pub fn posed_queries(&self, group: &str) -> [usize; 2] {
        let mut queries: BTreeMap<&str, bool> = BTreeMap::new();
        for contender in &self.study.contenders {
            for row in self.rows(group, &contender.label).iter().filter(|row| row.instance() == 0) {
                *queries.entry(row.query()).or_default() |= row.status != Status::InvalidProblem;
            }
        }
        [queries.values().filter(|is_posed| **is_posed).count(), queries.len()]
    }

    /// The preprocessed objects of the problem group `group` under the interpretation, in the order of instances.
    pub fn preprocessing(&self, group: &str) -> impl Iterator<Item = &PreprocessingRow> {
        let is_own = move |row: &&PreprocessingRow| {
            *row.key.group == *group && row.key.interpretation == self.interpretation
        };
        self.records.batch.preprocessing.iter().filter(is_own)
    }

    /// The traces of a trial or preprocessed object.
    pub fn traces(&self, of: impl Into<Owner>) -> impl Iterator<Item = &Trace> {
        self.kept.owned_by(&of.into())
    }

    /// The trace called `name` of a trial or preprocessed object.
    pub fn trace(&self, of: impl Into<Owner>, name: &str) -> Option<&Trace> {
        self.traces(of).find(|trace| trace.name == name)
    }
}

/// The trials `own` and `bases` of two contenders on one problem group, paired where instance, query, point of the sweeps and seed are
/// the same, in the order of `own`. A contender with a single seed stands beside each seed of the other.
pub fn paired<'r>(own: Vec<&'r Row>, bases: Vec<&'r Row>) -> Vec<(&'r Row, &'r Row)> {
    let [own_seeds, base_seeds] = [&own, &bases].map(|rows| rows.iter().any(|row| row.key.repeat > 0));
    let by_seed = own_seeds && base_seeds;
    let mut instances: BTreeMap<u32, Vec<&Row>> = BTreeMap::new();
    for base in bases {
        instances.entry(base.instance()).or_default().push(base);
    }
    let is_same = |one: &TrialKey, other: &TrialKey| {
        let is_same_seed = !by_seed || one.repeat == other.repeat;
        is_same_seed && one.query == other.query && one.sweep.is_same(&other.sweep)
    };
    let mut pairs = Vec::with_capacity(own.len());
    let mut next = 0;
    for row in own {
        let of_instance = instances.get(&row.instance()).map_or(&[][..], Vec::as_slice);
        let is_base = |base: &Row| is_same(&base.key, &row.key);
        if own_seeds != base_seeds {
            pairs.extend(of_instance.iter().filter(|base| is_base(base)).map(|base| (row, *base)));
            continue;
        }
        // One at most, and mostly the one after the last: both come in the same order.
        let mut places = (next..of_instance.len()).chain(0..next.min(of_instance.len()));
        if let Some(place) = places.find(|place| is_base(of_instance[*place])) {
            pairs.push((row, of_instance[place]));
            next = place + 1;
        }
    }
    pairs
}

impl Index {
    fn new(names: Names, records: &Records) -> Self {
        let mut index = Self { names, ..Self::default() };
        let mut rows = records.batch.rows.iter().enumerate().peekable();
        while let Some((_, first)) = rows.peek() {
            let on = first.key.on.clone();
            let of_interpretation = index.rows.entry(on.interpretation.clone()).or_default();
            let of_group = of_interpretation.entry(on.group.clone()).or_default();
            while let Some((place, row)) = rows.next_if(|(_, row)| Arc::ptr_eq(&row.key.on, &on)) {
                match of_group.get_mut(&row.key.contender) {
                    Some(places) => places.push(place),
                    None => {
                        of_group.insert(row.key.contender.clone(), vec![place]);
                    }
                }
            }
        }
        for time in &records.times {
            let session = time.session.max(1) as usize;
            if index.times_ns.len() < session {
                index.times_ns.resize_with(session, BTreeMap::new);
            }
            let of_trial = index.times_ns[session - 1].entry(time.trial.clone()).or_default();
            of_trial.push(time.plan_wall_ns as f64);
        }
        index
    }
}
