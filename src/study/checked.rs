//! Checked studies: every name is looked up, every settings table is understood, before a trial runs.

mod check;
mod each;
mod load;
mod shared;
mod sizes;
mod work;

use super::choice::{self, Choice, Interpretation};
use super::contender::{Contender, Sweep, SweepPoint};
use super::error::StudyError;
use super::group::Group;
use super::key::{KeyColumns, SweepKey, SweepValue, Text};
use super::name::{self, Names};
use super::preprocessing;
use super::spec::{BudgetSpec, ExploredStudy, FigureSpec, QuickSpec, TimingSpec, TrialsSpec};
use super::task;
use base::hash::sha256;
use base::settings::{Document, Settings, none_called};
pub use shared::Shared;
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::sync::Arc;
use toml::Table;

/// A checked study.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its name: the stem of its file.
    pub name: String,
    /// The paper's name: the folder's.
    pub paper: String,
    /// The question it answers.
    pub question: String,
    /// The root of every seed.
    pub seed: u64,
    /// The root of every seed when `replan confirm` runs it once more.
    pub second_seed: Option<u64>,
    /// What is done with the problems.
    pub task: &'static task::Entry,
    /// The task's settings.
    pub task_settings: Settings,
    /// Inputs were searched for.
    pub searched: bool,
    /// Claims that something was fitted to.
    pub fitted_to: Vec<String>,
    /// Groups of problems.
    pub groups: Vec<Group>,
    /// What is compared.
    pub contenders: Vec<Contender>,
    /// Factors that the paper varies.
    pub sweeps: Vec<Sweep>,
    /// The choices of its paper that touch what it runs or how it is judged, but for those that it leaves out.
    pub choices: Vec<Choice>,
    /// The choices that touch what it runs and that it leaves out.
    pub leaves_out: Vec<String>,
    /// Those of them that its problems draw with each instance.
    pub draws: Vec<String>,
    /// What `replan explore` runs of it under every interpretation.
    pub explore: Option<ExploredStudy>,
    /// To how many instances of each group and repeats it is cut down, if it is explored.
    pub cut_to: Option<[u32; 2]>,
    /// Limits on each trial.
    pub budget: BudgetSpec,
    /// How clocks are read.
    pub timing: Option<TimingSpec>,
    /// Trials whose traces are kept.
    pub keeps: Vec<TrialsSpec>,
    /// What `--quick` cuts down to.
    pub quick: QuickSpec,
    /// Figures drawn from it.
    pub figures: Vec<FigureSpec>,
    /// What its paper leaves out, and what holds there.
    pub of_paper: Vec<String>,
    /// The file it was read from.
    pub document: Arc<Document>,
}

/// Whether a point of sweeps meets every condition in `text`.
fn meets(point: &SweepKey, text: &str) -> bool {
    text.split(',').all(|condition| {
        let Some((operator, accepted)) = OPERATORS.iter().find(|(operator, _)| condition.contains(operator))
        else {
            return false;
        };
        let Some((key, value)) =
            condition.split_once(operator).map(|(key, value)| (key.trim(), value.trim()))
        else {
            return false;
        };
        point.values().iter().any(|(own, swept)| {
            let order = match (swept.as_f64(), value.parse::<f64>()) {
                (Some(swept), Ok(value)) => swept.partial_cmp(&value),
                _ if swept.to_string() == value => Some(Ordering::Equal),
                _ => None,
            };
            **own == *key && order.is_some_and(|order| accepted.contains(&order))
        })
    })
}

/// How a condition on a sweep compares, and what it accepts; those that hold others go first.
const OPERATORS: [(&str, &[Ordering]); 5] = [
    ("<=", &[Ordering::Less, Ordering::Equal]),
    (">=", &[Ordering::Greater, Ordering::Equal]),
    ("<", &[Ordering::Less]),
    (">", &[Ordering::Greater]),
    ("=", &[Ordering::Equal]),
];

/// What the columns of the study called `name` are called where they may be unread.
pub fn columns_of(name: &str) -> String {
    format!("columns of {name}")
}

/// What the labels of the study called `name` are called where one of them may be unread.
pub fn labels_of(name: &str) -> String {
    format!("labels of {name}")
}

/// What the sweeps of the study called `name` are called where one of them may be unread.
pub fn sweeps_of(name: &str) -> String {
    format!("sweeps of {name}")
}

/// The remark beside anything that shows `labels`: the contenders among them that a study marks as recorded. `None` if
/// there are none.
pub fn recorded_mark<'a>(labels: impl Iterator<Item = &'a str>) -> Option<String> {
    let labels: Vec<&str> = labels.collect();
    (!labels.is_empty())
        .then(|| format!("Bound to a clock, so recorded and not repeated: {}.", labels.join(", ")))
}

/// The same of contenders whose trials were recorded elsewhere.
pub fn elsewhere_mark<'a>(labels: impl Iterator<Item = &'a str>) -> Option<String> {
    let labels: Vec<&str> = labels.collect();
    (!labels.is_empty()).then(|| {
        let labels = labels.join(", ");
        format!(
            "Recorded elsewhere and imported, with unknown seeds and paths that nobody verified: {labels}."
        )
    })
}

impl Study {
    /// Whether the seed decides anything of what is posed in a problem group: one instance is then one of many.
    pub fn is_drawn(&self, group: &str) -> bool {
        self.groups.iter().any(|own| own.label == group && own.is_drawn)
    }

    /// The defaults and, for every other option that trials depend on, the interpretation that differs in it alone.
    ///
    /// # Errors
    /// A choice whose default is not among its options.
    pub fn trial_interpretations(&self) -> Result<Vec<Interpretation>, StudyError> {
        choice::single_options_of_trials(&self.choices)
            .map_err(|message| StudyError::from(self.document.error_at("", message)))
    }

    /// `interpretations` of the paper as trials of the study see them: those that run the same trials appear once.
    pub fn as_trials_see(&self, interpretations: &[Interpretation]) -> Vec<Interpretation> {
        let mut seen = BTreeSet::new();
        let as_seen = interpretations.iter().map(|one| one.for_trials(&self.choices));
        as_seen.filter(|one| seen.insert(one.key(&self.choices))).collect()
    }

    /// The study on its second seed, if it has one; no clock is read and nothing is kept for figures.
    #[must_use]
    pub fn reseeded(mut self) -> Self {
        self.seed = self.second_seed.unwrap_or(self.seed);
        self.untimed()
    }

    /// The study without clocks and figures, and with nothing kept for these.
    fn untimed(self) -> Self {
        Self { timing: None, keeps: Vec::new(), figures: Vec::new(), ..self }
    }

    /// Leaves at most so many instances of each group and repeats of each contender.
    fn cut(&mut self, instances: u32, repeats: u32) {
        for group in &mut self.groups {
            group.instances = group.instances.min(instances);
        }
        for contender in &mut self.contenders {
            contender.repeats = contender.repeats.min(repeats);
        }
    }

    /// The study cut down to what is explored of it under each interpretation: no clock is read, and nothing is kept for figures.
    #[must_use]
    pub fn explored(mut self, explore: &ExploredStudy, instances: u32) -> Self {
        let repeats = explore.repeats.unwrap_or(u32::MAX);
        self.cut_to = Some([instances, repeats]);
        self.cut(instances, repeats);
        self.untimed()
    }

    /// Every point of the sweeps over contenders, the first sweep varying slowest; one empty point without such sweeps.
    pub fn contender_points(&self) -> Vec<SweepPoint> {
        SweepPoint::all(self.sweeps.iter().filter(|sweep| sweep.entry().is_some()))
    }

    /// Every problem group with every point of the sweeps over its settings.
    pub fn posed(&self) -> impl Iterator<Item = (&Group, &SweepPoint)> {
        self.groups.iter().flat_map(|group| group.points.iter().map(move |point| (group, point)))
    }

    /// Every point of the sweeps that a trial can have: those over problems vary slowest; one empty point without sweeps.
    pub fn sweep_points(&self) -> Vec<SweepPoint> {
        self.sweep_points_of(|_| true)
    }

    /// The points of [`sweep_points`](Self::sweep_points) that a trial can have on a problem group whose label `is_meant`.
    pub fn sweep_points_of(&self, is_meant: impl Fn(&str) -> bool) -> Vec<SweepPoint> {
        let contenders = self.contender_points();
        let mut posed: Vec<&SweepPoint> = Vec::new();
        for (_, point) in self.posed().filter(|(group, _)| is_meant(&group.label)) {
            if posed.iter().all(|known| known.key != point.key) {
                posed.push(point);
            }
        }
        let none = SweepPoint::default();
        let posed = if posed.is_empty() { vec![&none] } else { posed };
        posed.iter().flat_map(|posed| contenders.iter().map(|own| posed.and(own))).collect()
    }

    /// The points of [`sweep_points_of`](Self::sweep_points_of) without the values that are drawn within an instance, each once.
    pub fn pooled_points_of(&self, is_meant: impl Fn(&str) -> bool) -> Vec<SweepKey> {
        let nested = |name: &str| self.sweeps.iter().any(|sweep| sweep.nested && sweep.key == name);
        let mut points: Vec<SweepKey> = Vec::new();
        for point in self.sweep_points_of(is_meant) {
            let pooled = point.key.without(nested);
            if !points.contains(&pooled) {
                points.push(pooled);
            }
        }
        points
    }

    /// The point of the sweeps that people write as `text`: empty without sweeps.
    ///
    /// # Errors
    /// There is none, in words.
    pub fn sweep_called(&self, text: &str) -> Result<SweepKey, String> {
        let points = self.sweep_points();
        let known: Vec<String> = points.iter().map(|point| name::sweep(&point.key)).collect();
        let found = known.iter().position(|name| name == text);
        found.map(|place| points[place].key.clone()).ok_or_else(|| {
            // Groups that no sweep is over have a point without a name.
            let named: Vec<&str> = known.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
            format!("study `{}` has no sweep `{text}`; it has {}", self.name, named.join(", "))
        })
    }

    /// The points of the sweeps that trials on `groups` can have and that meet one of `texts`. A text is a condition
    /// (`samples<=1400`), several conditions joined by commas that must all hold, or a point's own name.
    ///
    /// # Errors
    /// A text that no point meets, by its place, in words.
    pub fn sweeps_called(
        &self,
        groups: &[String],
        texts: &[String],
    ) -> Result<Vec<SweepKey>, (usize, String)> {
        let points = self.sweep_points_of(|label| groups.iter().any(|group| group == label));
        let names: Vec<String> = points.iter().map(|point| name::sweep(&point.key)).collect();
        let is_met = |place: usize, text: &String| names[place] == *text || meets(&points[place].key, text);
        let all = || 0..points.len();
        if let Some((place, text)) =
            texts.iter().enumerate().find(|(_, text)| !all().any(|place| is_met(place, text)))
        {
            // Groups that no sweep is over have a point without a name.
            let named: Vec<&str> = names.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
            let has = if named.is_empty() {
                "it sweeps nothing there".to_owned()
            } else {
                format!("it has {}", named.join(", "))
            };
            return Err((place, format!("study `{}` has no sweep `{text}`; {has}", self.name)));
        }
        let meant = all().filter(|place| texts.iter().any(|text| is_met(*place, text)));
        Ok(meant.map(|place| points[place].key.clone()).collect())
    }

    /// Labels in the contender column of its trials: its contenders, or the alternatives that its task tries instead.
    pub fn labels(&self) -> Vec<String> {
        if self.contenders.is_empty() {
            return (self.task.build)(&self.task_settings).map_or_else(|_| Vec::new(), |task| task.labels());
        }
        self.contenders.iter().map(|contender| contender.label.clone()).collect()
    }

    /// SHA-256 of its spec as written.
    pub fn spec_hash(&self) -> String {
        sha256(self.document.text().as_bytes())
    }

    /// SHA-256 of what its spec asks to run, and of how an exploration cuts it down: comments, the question and figures change nothing.
    pub fn run_hash(&self) -> String {
        let mut run: Table = self.document.read_stored().expect("the spec of a checked study is TOML");
        run.retain(|key, _| !["question", "figure"].contains(&key));
        run.extend(self.cut_to.map(|cut| ("cut_to".to_owned(), cut.to_vec().into())));
        sha256(run.to_string().as_bytes())
    }

    /// Why there is no query called `name` in the problem groups `labels`; `None` if there is one, or if some group's queries are not known.
    pub fn lacks_query(&self, labels: &[&str], name: &str) -> Option<String> {
        let groups = || self.groups.iter().filter(|group| labels.contains(&group.label.as_str()));
        let known: BTreeSet<&str> = groups().flat_map(|group| &group.queries).map(String::as_str).collect();
        let is_known = known.contains(name) || groups().any(|group| group.queries.is_empty());
        (!is_known && !known.is_empty()).then(|| {
            let what = format!("query of {}", labels.join(", "));
            none_called(&what, name, known.iter().copied())
        })
    }

    /// How its records are named.
    pub fn names(&self) -> Names {
        Names::new(
            self.groups.iter().map(|group| (group.label.as_str(), group.is_numbered)),
            self.contenders.iter().map(|contender| (contender.label.as_str(), contender.is_numbered)),
            self.choices.iter().map(|choice| (choice.id.as_str(), choice.default.as_str())),
        )
    }

    /// The columns of its records' keys besides those that every study has.
    pub fn key_columns(&self) -> KeyColumns {
        let sweep = |sweep: &Sweep| Some((sweep.key.as_str().into(), sweep.entry()?.into()));
        let moving = self.choices.iter().filter(|choice| choice.touches_trials);
        let mut posed: Vec<(Text, SweepValue)> = Vec::new();
        for (key, value) in self.posed().flat_map(|(_, point)| point.key.values()) {
            if posed.iter().all(|(known, _)| known != key) {
                posed.push((key.clone(), value.clone()));
            }
        }
        // In the order of the sweeps, whatever group has the first.
        posed.sort_by_key(|(key, _)| self.sweeps.iter().position(|sweep| *sweep.key == **key));
        KeyColumns {
            posed,
            sweeps: self.sweeps.iter().filter_map(sweep).collect(),
            choices: moving.map(|choice| choice.id.as_str().into()).collect(),
        }
    }

    /// The contenders whose trials depend on a clock and on programs of others. They are recorded; neither a fresh run nor a sample
    /// of stored trials repeats them.
    pub fn recorded(&self) -> impl Iterator<Item = &str> {
        self.contenders.iter().filter(|contender| contender.is_recorded()).map(|one| one.label.as_str())
    }

    /// Its contenders that depend on a clock and on a program that can run here.
    pub fn clock_bound(&self) -> impl Iterator<Item = &str> {
        let is_bound = |contender: &&Contender| contender.is_recorded() && !contender.is_elsewhere();
        self.contenders.iter().filter(is_bound).map(|one| one.label.as_str())
    }

    /// Its contenders whose trials were recorded elsewhere and imported.
    pub fn elsewhere(&self) -> impl Iterator<Item = &str> {
        self.contenders.iter().filter(|contender| contender.is_elsewhere()).map(|one| one.label.as_str())
    }

    /// Every column that what it prepares can have.
    pub fn preprocessing_columns(&self) -> BTreeSet<&'static str> {
        let entries = self.groups.iter().filter_map(|group| preprocessing::find(group.family.preprocessing));
        entries.flat_map(|entry| entry.columns).copied().collect()
    }

    /// Every column that its records can have.
    pub fn columns(&self) -> BTreeSet<&'static str> {
        let counted = self.contenders.iter().flat_map(|c| &c.stages).flat_map(|stage| stage.entry.columns);
        let posed = self.groups.iter().flat_map(Group::columns);
        let timed = self.timing.iter().flat_map(|_| [super::clock::COLUMN].iter());
        counted.chain(self.task.columns).chain(timed).copied().chain(posed).collect()
    }

    /// Trials that keep their traces: those that figures show, and `keep`.
    pub fn kept(&self) -> impl Iterator<Item = &TrialsSpec> {
        self.figures.iter().flat_map(|figure| &figure.shows).chain(&self.keeps)
    }

    /// The study cut down to what `--quick` keeps.
    #[must_use]
    pub fn quick(mut self) -> Self {
        self.cut(self.quick.instances, self.quick.repeats.unwrap_or(u32::MAX));
        self.budget = self.quick.budget.unwrap_or(self.budget);
        self.timing = self.timing.map(|full| self.quick.timing.unwrap_or(full));
        self.task_settings = self.quick_task_settings();
        self
    }

    fn quick_task_settings(&self) -> Settings {
        let over = self.quick.task_settings.as_ref();
        over.map_or_else(|| self.task_settings.clone(), |over| self.task_settings.overlaid(over, "--quick"))
    }
}
