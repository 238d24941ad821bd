//! A study's TOML as written, before anything in it is looked up.
//!
//! Unknown keys are refused everywhere; settings stay tables and are read by the entry they name.

use base::settings::{AnyTable, AnyValue, Spanned};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Table;

/// One study file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudySpec {
    /// The paper it belongs to: the name of its folder.
    pub paper: Spanned<String>,
    /// The question it answers, one sentence.
    pub question: String,
    /// The root of every seed.
    pub seed: u64,
    /// The root of every seed when `replan confirm` runs it once more; the paper's if absent.
    pub second_seed: Option<u64>,
    /// What is done with the problems; `plan` if absent.
    pub task: Option<Spanned<String>>,
    /// The settings of `task`.
    #[schemars(with = "Option<AnyTable>")]
    pub task_settings: Option<Spanned<Table>>,
    /// Inputs were searched for so that claims would hold: at best *attainable*.
    #[serde(default)]
    pub searched: bool,
    /// Claims that something in the study was chosen to meet: at best *fitted*. The study was calibrated to them, so that an
    /// interpretation under which one of them is contradicted is not what the paper means.
    #[serde(default)]
    pub fitted_to: Vec<Spanned<String>>,
    /// Groups of problems.
    #[serde(default)]
    pub problems: Vec<ProblemsSpec>,
    /// What is compared.
    #[serde(default, rename = "contender")]
    pub contenders: Vec<ContenderSpec>,
    /// Factors that the paper varies.
    #[serde(default, rename = "sweep")]
    pub sweeps: Vec<SweepSpec>,
    /// Choices of the paper that touch what the study runs and that it does not inherit, by name; `all` stands for all of them.
    #[serde(default)]
    pub leaves_out: Vec<Spanned<String>>,
    /// Choices that it does not inherit because its problems draw with each instance what their options set.
    #[serde(default)]
    pub draws: Vec<Spanned<String>>,
    /// Limits on each trial; the paper's if absent.
    pub budget: Option<BudgetSpec>,
    /// How clocks are read.
    pub timing: Option<TimingSpec>,
    /// Trials whose traces are kept besides those that figures name.
    #[serde(default, rename = "keep")]
    pub keeps: Vec<TrialsSpec>,
    /// What `--quick` cuts down to.
    #[serde(default)]
    pub quick: QuickSpec,
    /// Figures drawn from this study.
    #[serde(default, rename = "figure")]
    pub figures: Vec<FigureSpec>,
}

/// A group of problems drawn from one family.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProblemsSpec {
    /// Its name in records.
    pub label: Spanned<String>,
    /// The problem family; that of the group in `like` if absent.
    pub family: Option<Spanned<String>>,
    /// A group above, or one that paper.toml shares with all studies, by its label: this one has everything that it has, with its
    /// own keys and settings in place of those.
    pub like: Option<Spanned<String>>,
    /// Files, such as `maps/*.map`: a group for each, whose label ends in the file's name and in whose settings the file's path
    /// stands for `{file}`.
    pub each: Option<Spanned<String>>,
    /// The file that this group was made for.
    #[serde(skip)]
    pub file: Option<String>,
    /// The number, from 0, of the entry that it was made from.
    #[serde(skip)]
    pub place: usize,
    /// How many independent instances; 1 if absent.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub instances: Option<u32>,
    /// What its instances are called. Groups of one paper whose instances have one name get the same seeds, instance by instance,
    /// and so do the points of a sweep over the group: their settings can then be compared in pairs. The study, the label and the
    /// point of the sweep if absent.
    pub shared_instances: Option<String>,
    /// Settings laid over those of a planner or stage, by its name, in every contender on these problems; options and sweeps lie on
    /// top of them.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, AnyTable>")]
    pub stage: BTreeMap<String, Table>,
    /// The family's settings.
    #[schemars(with = "Option<AnyTable>")]
    pub settings: Option<Spanned<Table>>,
}

/// A pipeline under a label.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContenderSpec {
    /// Its name in records and tables.
    pub label: Spanned<String>,
    /// The planner's name in the registry; that of the contender in `like` if absent.
    pub planner: Option<Spanned<String>>,
    /// A contender above, or one that paper.toml shares with all studies, by its label: this one has everything that it has, with
    /// its own keys and settings in place of those.
    pub like: Option<Spanned<String>>,
    /// The planner's settings.
    #[schemars(with = "Option<AnyTable>")]
    pub settings: Option<Spanned<Table>>,
    /// Stages that tidy the plan, in order.
    pub then: Option<Vec<StageSpec>>,
    /// How many seeds it runs on each problem, 1 if absent; more than 1 only where it draws.
    #[schemars(range(min = 1, max = 100_000))]
    pub repeats: Option<u32>,
    /// Choices that its study leaves out, or that do not touch it, with the option that its settings take. A witness that it gives
    /// counts under these options alone.
    #[serde(default)]
    pub departs: BTreeMap<String, String>,
}

/// A stage of a pipeline.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageSpec {
    /// Its name in the registry.
    pub stage: Spanned<String>,
    /// The stage's settings.
    #[schemars(with = "Option<AnyTable>")]
    pub settings: Option<Spanned<Table>>,
}

/// A factor that the paper varies: a setting of a planner or stage, or of problems.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepSpec {
    /// The setting that it fills.
    pub key: Spanned<String>,
    /// The planner or stage whose setting it is; `problems` stands in its place if it is a setting of problems.
    pub stage: Option<Spanned<String>>,
    /// The problem groups whose setting it is, by label; `*` at the end of one stands for any ending.
    pub problems: Option<Spanned<Vec<String>>>,
    /// The values, in the paper's order.
    #[schemars(with = "Vec<AnyValue>")]
    pub values: Spanned<Vec<toml::Value>>,
    /// Whether its values are drawn within an instance, as roadmaps in a cell are. Claims and figures pool them unless they select
    /// one, and intervals resample whole instances.
    #[serde(default)]
    pub nested: bool,
}

/// Something that the paper leaves open.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ChoiceSpec {
    /// Its name in specs, columns and on the command line.
    pub id: Spanned<String>,
    /// What it settles, as a noun of a few words: it stands before the name where a headline's verdict depends on it.
    pub title: Option<String>,
    /// What the paper leaves open, and why the default was taken.
    pub why: String,
    /// The option taken unless another is named.
    pub default: Spanned<String>,
    /// Whether the default was chosen so that the claims in `fitted_to` hold. For each setting of the other choices, the options
    /// that meet most of these claims count.
    #[serde(default)]
    pub fitted: bool,
    /// Of options that are numbers: which of them vote, and who says so.
    pub bounds: Option<BoundsSpec>,
    /// Where the paper's text says so, with its words, for every option that cites nothing itself and is no probe.
    pub paper: Option<String>,
    /// The practice that does so, with its source, for every option that cites nothing itself and is no probe.
    pub practice: Option<String>,
    /// The ways to settle it, by name.
    pub option: Spanned<BTreeMap<String, OptionSpec>>,
}

/// The numbers of a choice that vote.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundsSpec {
    /// The least number that votes.
    pub least: f64,
    /// The greatest number that votes.
    pub greatest: f64,
    /// The paper's text, or the practice, that says so.
    pub source: String,
}

/// The setting of a problem that is laid over its robot file.
pub const ROBOT_WITH: &str = "robot_with";
/// The setting of a problem that is laid over its scene file.
pub const SCENE_WITH: &str = "scene_with";

/// The settings of one option of a choice, and its source. An option that cites neither the paper nor a practice, nor
/// is a number within sourced bounds, is a probe: its effect is printed and never counted.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OptionSpec {
    /// Where the paper's text says so, with its words: `section 2.2: "meet at a certain point"`.
    pub paper: Option<String>,
    /// The practice that does so, with its source.
    pub practice: Option<String>,
    /// Whether it is a probe, though its choice cites a source for every option without one.
    #[serde(default)]
    pub probe: bool,
    /// The number that it stands for, where the choice has `bounds`.
    pub value: Option<f64>,
    /// Options of other choices that it is explored with, by the choice's name; with every option if absent.
    #[serde(default)]
    pub only_with: BTreeMap<String, Vec<String>>,
    /// Why it cannot be run: claims on studies that inherit the choice then stay open.
    pub cannot_run: Option<String>,
    /// Settings laid over those of every problem whose family has all of them.
    #[serde(default)]
    #[schemars(with = "AnyTable")]
    pub problem: Table,
    /// Settings laid over those of a planner or stage, by its name, in every contender that uses it.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, AnyTable>")]
    pub stage: BTreeMap<String, Table>,
    /// Settings laid over those of one contender, by its label and by the name of its planner or stage.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, BTreeMap<String, AnyTable>>")]
    pub contender: BTreeMap<String, BTreeMap<String, Table>>,
    /// What is laid over the robot file of every problem whose family can: elements of lists go by their number from 0 or their
    /// `name`.
    #[serde(default)]
    #[schemars(with = "AnyTable")]
    pub robot: Table,
    /// What is laid over the scene file of every problem, as for `robot`.
    #[serde(default)]
    #[schemars(with = "AnyTable")]
    pub scene: Table,
    /// What a metric's name stands for under this option: no trial is rerun.
    #[serde(default)]
    pub metric: BTreeMap<String, String>,
    /// How printed digits end, for claims that do not say so themselves: no trial is rerun.
    pub digits: Option<Digits>,
}

/// How a printed number's digits end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Digits {
    /// To the nearest.
    Rounded,
    /// Cut off.
    Truncated,
    /// Either.
    Unknown,
}

/// How far a paper's choices are explored, besides its defaults, every other option by itself and what contenders depart to. Tables
/// go by the names of studies.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExploreSpec {
    /// How many settings of choices are drawn from the product of options that vote, at most and without repetition.
    #[schemars(range(max = 10_000))]
    pub sample: u32,
    /// Options of several choices that are explored together, beside those that are drawn: `{ groove = "90_mm", shelf = "100_mm" }`.
    #[serde(default)]
    pub together: Vec<BTreeMap<String, String>>,
    /// How many trials `replan explore` may run in all, and `replan confirm` once more.
    #[schemars(range(min = 1, max = 1_000_000_000_000_u64))]
    pub trials: u64,
    /// The studies that are explored, each with the instances kept of each problem group.
    pub instances: BTreeMap<String, Count>,
    /// Instances kept of each group under interpretations that leave a claim open or turn it; `instances` if absent.
    #[serde(default)]
    pub more_instances: BTreeMap<String, Count>,
    /// Seeds kept of each contender; all of them if absent.
    #[serde(default)]
    pub repeats: BTreeMap<String, Count>,
    /// By study, the other study whose claims it answers under interpretations other than the defaults; groups and contenders of
    /// both have the same labels. A study answers its own claims if absent.
    #[serde(default)]
    pub stands_for: BTreeMap<String, String>,
    /// Studies that run only under interpretations compatible with what the paper's studies are fitted to; the studies that run
    /// under every interpretation decide which these are.
    #[serde(default)]
    pub where_compatible: Vec<String>,
    /// Where the paper calls its paths free: a result is set apart, and named, if the verifier refuses more than this share, in per
    /// cent, of the paths that the claim looks at.
    #[schemars(range(max = 100))]
    pub refused_above_percent: Option<u32>,
}

/// A number of instances or of seeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Count(#[schemars(range(min = 1, max = 1_000_000))] pub u32);

/// The part of one study that runs under every interpretation explored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExploredStudy {
    /// Instances kept of each problem group.
    pub instances: u32,
    /// Instances kept of each group under interpretations that leave a claim open or turn it.
    pub more_instances: Option<u32>,
    /// Seeds kept of each contender; all of them if absent.
    pub repeats: Option<u32>,
    /// The study whose claims it answers, if not its own.
    pub stands_for: Option<String>,
}

impl ExploreSpec {
    /// What is run of the study called `name`; `None` if it is not explored.
    pub fn study(&self, name: &str) -> Option<ExploredStudy> {
        Some(ExploredStudy {
            instances: self.instances.get(name)?.0,
            more_instances: self.more_instances.get(name).map(|count| count.0),
            repeats: self.repeats.get(name).map(|count| count.0),
            stands_for: self.stands_for.get(name).cloned(),
        })
    }

    /// Whether the study called `name` runs only under interpretations that are compatible.
    pub fn is_late(&self, name: &str) -> bool {
        self.where_compatible.iter().any(|late| late == name)
    }
}

/// Limits on each trial.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BudgetSpec {
    /// At most this many expansions.
    #[schemars(range(min = 1, max = 1_000_000_000_000_u64))]
    pub expansions: u64,
}

/// How clocks are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimingSpec {
    /// How many problems of each group are timed, from the first instance on.
    #[schemars(range(max = 1_000_000))]
    pub problems: u32,
    /// How many timed runs of each.
    #[schemars(range(max = 1_000_000))]
    pub repeats: u32,
    /// How many of a contender's seeds are timed; the first one if absent.
    #[schemars(range(max = 100_000))]
    pub seeds: Option<u32>,
}

/// Which trials.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrialsSpec {
    /// The problem group's label.
    pub problems: String,
    /// The contender's label; all of them if absent.
    pub contender: Option<String>,
    /// Instances below this number.
    pub instances: u32,
    /// Further instances, by their numbers from 0.
    #[serde(default)]
    pub also: Vec<u32>,
    /// Seeds of a contender below this number; all of them if absent.
    pub repeats: Option<u32>,
    /// Names of the traces that are kept of a trial; all that there are if absent.
    pub traces: Option<Vec<String>>,
}

impl TrialsSpec {
    /// Whether the instance of this number is among them.
    pub fn has_instance(&self, instance: u32) -> bool {
        instance < self.instances || self.also.contains(&instance)
    }
}

/// What `--quick` cuts down to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuickSpec {
    /// Instances kept of each problem group.
    #[serde(default = "few")]
    pub instances: u32,
    /// Seeds kept of each contender.
    pub repeats: Option<u32>,
    /// Limits on each trial, in place of the study's.
    pub budget: Option<BudgetSpec>,
    /// How clocks are read, where the study reads any.
    pub timing: Option<TimingSpec>,
    /// Settings laid over those of the task.
    #[schemars(with = "Option<AnyTable>")]
    pub task_settings: Option<Table>,
}

/// Instances kept of each group by `--quick` where the spec does not say: what shows that a study runs, and no more.
fn few() -> u32 {
    2
}

impl Default for QuickSpec {
    fn default() -> Self {
        Self { instances: few(), repeats: None, budget: None, timing: None, task_settings: None }
    }
}

/// A figure: its kind and the settings of that kind.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureSpec {
    /// Its file name, after the paper's figure where there is one.
    pub id: Spanned<String>,
    /// The kind of figure.
    pub kind: Spanned<String>,
    /// What it shows, printed below it.
    pub caption: String,
    /// Name of its table of numbers, if it has one under another name than its own.
    pub table: Option<String>,
    /// What its table shows, if it has one; the figure's caption if absent.
    pub table_caption: Option<String>,
    /// Trials whose traces it needs.
    #[serde(default)]
    pub shows: Vec<TrialsSpec>,
    /// The kind's settings.
    #[schemars(with = "Option<AnyTable>")]
    pub settings: Option<Spanned<Table>>,
}
