//! `replan list`: everything that specs can name, and what is known of one of these, within 80 columns.
//!
//! Everything registered has one form here, [`Item`]: for this command, for the schemas of files, and for tests of both.

use super::explorer::Explorer;
use super::places::{Places, experiments, home, papers};
use super::progress::doing;
use super::{Failure, Which, all, counted};
use crate::analysis::verdict_rule::Verdict;
use crate::analysis::{criterion, metric, rule};
use crate::render::figure;
use crate::render::prose::plain;
use base::file::read_text;
use base::robot::read_urdf;
use base::settings::describe::{Default, Field, fields};
use base::settings::{Accepted, none_called};
use clap::{Args, ValueEnum};
use engine::kinematics::{AXES, Robot, robot::Body};
use engine::planner::{self, Build};
use rayon::prelude::*;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use study::files::{self, FileKind};
use study::paper::{self, Paper};
use study::{Contender, Group, Inputs, Study, elsewhere_mark, family, preprocessing, recorded_mark, task};

/// Where robots are shipped.
const ROBOTS: &str = "data/robots";

/// Lists what there is.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct List {
    /// The kind to list; everything if absent
    what: Option<What>,
    /// One entry, with its settings and an example
    name: Option<String>,
}

const EXAMPLES: &str = "Examples:
  replan list planners
  replan list criteria one_instance   one entry with its settings and an example";

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum What {
    Papers,
    Studies,
    Choices,
    Robots,
    Planners,
    Stages,
    Families,
    Preprocessing,
    Tasks,
    /// Criteria that claims are judged by.
    #[value(alias = "checks")]
    Criteria,
    Rules,
    Metrics,
    Verdicts,
    Figures,
    Files,
}

impl List {
    /// Runs the command.
    pub(super) fn run(self) -> Result<(), Failure> {
        if let (Some(what), Some(name)) = (self.what, &self.name) {
            return one(what, name);
        }
        let (found, results) = LoadedFiles::read(|kind| self.what.is_none_or(|what| kind.contains(&what)));
        for what in What::value_variants() {
            if self.what.is_none_or(|wanted| wanted == *what) {
                say!("{}", title(*what));
                for (name, about) in rows(*what, &found) {
                    say!("{}", wrapped(&format!("  {name:<26} "), &about, 29));
                }
            }
        }
        all(results, "papers and robots cannot be listed")
    }
}

/// What is read from files.
struct LoadedFiles {
    papers: Vec<Paper>,
    /// Names of robots, and what one line says of each.
    robots: Vec<(String, String)>,
}

impl LoadedFiles {
    /// The papers and robots that can be read, if a kind that needs them is requested, and how reading each went.
    fn read(is_wanted: impl Fn(&[What]) -> bool) -> (Self, Vec<Result<(), Failure>>) {
        let papers = is_wanted(&[What::Papers, What::Studies, What::Choices]).then(loaded);
        let (papers, mut results) = papers.unwrap_or_default();
        let read = is_wanted(&[What::Robots]).then(robots);
        let (robots, faults) = read.unwrap_or_default();
        results.extend(faults);
        (Self { papers, robots }, results)
    }

    /// The text on a paper or study by itself; none for what has one line only.
    fn described(&self, what: What, name: &str) -> Result<Option<String>, Failure> {
        let find = |id: &str| self.papers.iter().find(|paper| paper.id == id);
        Ok(match (what, name.split_once('/')) {
            (What::Papers, _) => find(name).map(paper_alone),
            (What::Studies, Some((id, study))) => {
                let found = find(id).and_then(|paper| Some((paper, paper.study(study)?)));
                found.map(|(paper, study)| study_alone(paper, study)).transpose()?
            }
            _ => None,
        })
    }
}

fn title(what: What) -> String {
    what.to_possible_value().expect("no variant is hidden").get_name().to_owned()
}

/// What one of a kind is called, and how its entries are listed if a registry has them.
fn kind(what: What) -> (&'static str, Option<fn() -> Vec<Item>>) {
    match what {
        What::Papers => ("paper", None),
        What::Studies => ("study", None),
        What::Choices => ("choice", None),
        What::Robots => ("robot", None),
        What::Planners => ("planner", Some(planners)),
        What::Stages => ("stage", Some(stages)),
        What::Families => ("family", Some(families)),
        What::Preprocessing => ("kind of preprocessed object", Some(preprocessing)),
        What::Tasks => ("task", Some(tasks)),
        What::Criteria => ("criterion", Some(criteria)),
        What::Rules => ("rule", Some(rules)),
        What::Metrics => ("metric", None),
        What::Verdicts => ("verdict", None),
        What::Figures => ("kind of figure", Some(figures)),
        What::Files => ("kind of file", Some(files)),
    }
}

/// What the one thing of the kind `what` that is called `name` is.
fn one(what: What, name: &str) -> Result<(), Failure> {
    let (singular, items) = kind(what);
    let Some(items) = items else {
        let (found, results) = LoadedFiles::read(|kind| kind.contains(&what));
        let rows = rows(what, &found);
        let known = rows.iter().map(|(known, _)| known.as_str());
        let row = rows.iter().find(|(known, _)| known == name);
        let (_, about) = row.ok_or_else(|| Failure::input(none_called(singular, name, known)))?;
        let described = found.described(what, name)?;
        say!("{}", described.unwrap_or_else(|| format!("{name}\n{}", wrapped("  ", about, 2))));
        if let Some(metric) = metric::find(name).filter(|_| what == What::Metrics) {
            let unit = if metric.unit.is_empty() { "none: it is a count or a flag" } else { &metric.unit };
            say!("{}", wrapped("  unit: ", unit, 2));
            say!("{}", wrapped("  better: ", metric.better.name(), 2));
            say!("{}", wrapped("  read from: ", metric.column, 2));
        }
        return all(results, "papers and robots cannot be listed");
    };
    let items = items();
    let known = items.iter().map(|item| item.name);
    let item = items.iter().find(|item| item.name == name);
    let item = item.ok_or_else(|| Failure::input(none_called(singular, name, known)))?;
    say!("{}", explained(item));
    Ok(())
}

fn rows(what: What, LoadedFiles { papers, robots }: &LoadedFiles) -> Vec<(String, String)> {
    let row = |name: &str, about: &str| (name.to_owned(), about.to_owned());
    if let Some(items) = kind(what).1 {
        return items().iter().map(|item| row(item.name, item.about)).collect();
    }
    match what {
        What::Papers => papers.iter().map(|paper| row(&paper.id, &paper.source.title)).collect(),
        What::Studies => {
            let studies = papers.iter().flat_map(|paper| &paper.studies);
            let about = |study: &Study| {
                let mark = recorded_mark(study.clock_bound());
                [Some(study.question.clone()), mark].into_iter().flatten().collect::<Vec<_>>().join(" ")
            };
            studies.map(|study| (format!("{}/{}", study.paper, study.name), about(study))).collect()
        }
        What::Choices => papers
            .iter()
            .flat_map(|paper| paper.choices.iter().map(move |choice| (paper, choice)))
            .map(|(paper, choice)| {
                let options: Vec<&str> = choice.options.keys().map(String::as_str).collect();
                let about = format!("{} (default {}): {}", options.join(" | "), choice.default, choice.why);
                (format!("{}/{}", paper.id, choice.id), about)
            })
            .collect(),
        What::Robots => robots.clone(),
        What::Verdicts => Verdict::ALL.iter().map(|verdict| row(verdict.name(), verdict.about())).collect(),
        _ => metric::METRICS.iter().map(|m| row(m.name, &format!("{}: {}", m.title(), m.about))).collect(),
    }
}

/// What one line says of a robot.
fn about(robot: &Robot) -> String {
    let bodies: Vec<&str> = robot.bodies().iter().map(Body::name).collect();
    format!("{}; bodies: {}", robot.arm().solver(), bodies.join(", "))
}

/// The text on the robot in `file`: one of URDF goes by the name of its file, since the same robot may be written in rows too.
fn described(file: &Path) -> Result<(String, String), Failure> {
    let wrong = |error: &dyn std::fmt::Display| Failure::input(error.to_string());
    let Some(name) = file.file_name().filter(|_| is_urdf(file)) else {
        let robot = Robot::load(file).map_err(|error| wrong(&error))?;
        return Ok((robot.name().to_owned(), about(&robot)));
    };
    let name = name.to_string_lossy().into_owned();
    match read_urdf(file).map_err(|error| wrong(&error))?.joints.len() {
        AXES => Ok((name, about(&Robot::load(file).map_err(|error| wrong(&error))?))),
        axes => Ok((name, format!("{axes} axes: planned in joint space, by `joint_queries`"))),
    }
}

fn is_urdf(file: &Path) -> bool {
    file.extension().is_some_and(|end| end == "urdf")
}

/// Every robot of the project that can be read, by name of its file, and what is wrong with the others.
fn robots() -> (Vec<(String, String)>, Vec<Result<(), Failure>>) {
    let files = std::fs::read_dir(ROBOTS).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<PathBuf> =
        files.filter(|file| is_urdf(file) || file.extension().is_some_and(|e| e == "toml")).collect();
    files.sort_unstable();
    let mut robots = Vec::new();
    let mut faults = Vec::new();
    for robot in files.iter().map(|file| described(file)) {
        match robot {
            Ok(robot) => robots.push(robot),
            Err(fault) => faults.push(Err(fault)),
        }
    }
    (robots, faults)
}

/// Every paper that can be read, and how reading each went.
fn loaded() -> (Vec<Paper>, Vec<Result<(), Failure>>) {
    let load = |name: String| -> Result<Paper, Failure> {
        let folder = experiments().join(name);
        let inputs = Inputs { roots: vec![folder.clone(), home(None)?] };
        Ok(Paper::load(&folder, &inputs)?)
    };
    doing("reading the papers");
    let read: Vec<Result<Paper, Failure>> = papers().into_par_iter().map(load).collect();
    let mut papers = Vec::new();
    let mut results = Vec::new();
    for paper in read {
        results.push(paper.map(|paper| papers.push(paper)));
    }
    (papers, results)
}

/// A paper: its source, studies and claims, and how it is run.
fn paper_alone(paper: &Paper) -> String {
    let source = &paper.source;
    let mut lines = vec![paper.id.clone(), wrapped("  ", &source.title, 2)];
    for text in [&source.authors, &source.published].into_iter().flatten() {
        lines.push(wrapped("  ", text, 2));
    }
    let claims = counted(paper.claims.len(), ["claim", "claims"]);
    lines.push(format!("  {claims}, {}", counted(paper.studies.len(), ["study", "studies"])));
    lines.push("\nStudies".to_owned());
    lines.extend(
        paper.studies.iter().map(|study| wrapped(&format!("  {}: ", study.name), &study.question, 6)),
    );
    lines.push("\nExamples".to_owned());
    for (command, about) in [
        ("repro", "run what has changed, judge the claims, draw the figures"),
        ("show", "every claim with its verdict"),
        ("report", "the report as a page"),
    ] {
        lines.push(wrapped(&format!("  replan {command} {}   ", paper.id), about, 6));
    }
    lines.join("\n")
}

/// A study of `paper`: its question, what it runs, and how.
///
/// # Errors
/// Problems that cannot be built.
fn study_alone(paper: &Paper, study: &Study) -> Result<String, Failure> {
    let id = &paper.id;
    let name = &study.name;
    let places = Places::find(&Which { paper: id.clone(), out: None }, "")?;
    doing(&format!("{id}/{name}: counting its trials"));
    let trials = Explorer::new(paper, &places, None, PathBuf::new()).trials_of(study)?;
    let mut lines = vec![
        format!("{id}/{name}"),
        wrapped("  ", &study.question, 2),
        wrapped("  paper: ", &paper.source.title, 6),
        wrapped("  task: ", study.task.name, 6),
        format!("  {} under the default interpretation", counted(trials as usize, ["trial", "trials"])),
    ];
    let marks = [recorded_mark(study.clock_bound()), elsewhere_mark(study.elsewhere())];
    lines.extend(marks.into_iter().flatten().map(|mark| wrapped("  ", &mark, 6)));
    lines.extend(compared(study));
    let of = |label: &str, ids: Vec<&str>| (!ids.is_empty()).then(|| wrapped(label, &ids.join(", "), 2));
    lines.extend(of("\nSweeps over: ", study.sweeps.iter().map(|sweep| sweep.key.as_str()).collect()));
    lines.extend(of("\nChoices: ", study.choices.iter().map(|choice| choice.id.as_str()).collect()));
    lines.push("\nExample".to_owned());
    lines.push(wrapped(
        &format!("  replan run {id}   "),
        "run what has changed of all of the paper's studies",
        6,
    ));
    Ok(lines.join("\n"))
}

/// The groups of problems of a study, and its contenders.
fn compared(study: &Study) -> Vec<String> {
    let group = |group: &Group| {
        let instances = counted(group.instances as usize, ["instance", "instances"]);
        wrapped(&format!("  {}: ", group.label), &format!("{instances} of `{}`", group.family.name), 6)
    };
    let contender = |contender: &Contender| {
        let stages: Vec<&str> = contender.stages.iter().map(|stage| stage.entry.name).collect();
        let seeds = counted(contender.repeats as usize, ["seed", "seeds"]);
        wrapped(&format!("  {}: ", contender.label), &format!("{}; {seeds}", stages.join(", then ")), 6)
    };
    let problems = std::iter::once("\nProblems".to_owned()).chain(study.groups.iter().map(group));
    let contenders = std::iter::once("\nContenders".to_owned()).chain(study.contenders.iter().map(contender));
    problems.chain(contenders).collect()
}

/// Terminals have at least this many columns.
const COLUMNS: usize = 80;
/// And so many rows.
const ROWS: usize = 24;

/// `first` and then the words of `text`, on lines of 80 columns, those after the first indented by `indent`.
fn wrapped(first: &str, text: &str, indent: usize) -> String {
    plain(first, text, indent, COLUMNS)
}

/// Everything that is known of `item`.
fn explained(item: &Item) -> String {
    let mut parts = vec![item.name.to_owned(), wrapped("  ", item.about, 2)];
    if !item.columns.is_empty() {
        parts.push(wrapped("  It fills the columns ", &format!("{}.", item.columns.join(", ")), 2));
    }
    match item.settings.map(|accepted| fields(&accepted.schema())) {
        Some(keys) if keys.is_empty() => parts.push("\nIt has no settings.".to_owned()),
        Some(keys) => {
            parts.push("\nKeys".to_owned());
            parts.extend(keys.iter().map(key));
        }
        None => {
            parts.push("\nIt has no settings of its own; the family of the problems has them.".to_owned());
        }
    }
    if let Some(file) = item.file {
        parts.push(format!("\nExample\n  {file}"));
        parts.extend(short(file));
    }
    if let Some(example) = item.shown() {
        parts.push("\nExample".to_owned());
        parts.extend(example.lines().map(|line| format!("  {line}")));
    }
    parts.join("\n")
}

/// What the project's `file` says without its comments, indented, if it is here and fits a terminal.
fn short(file: &str) -> Option<String> {
    let text = read_text(&home(None).ok()?.join(file)).ok()?;
    let lines: Vec<String> =
        text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("    {line}")).collect();
    let fits = lines.len() <= ROWS && lines.iter().all(|line| line.chars().count() <= COLUMNS);
    fits.then(|| lines.join("\n").replace("    \n", "\n").trim_end().to_owned())
}

fn key(field: &Field) -> String {
    let unit = field.unit.map_or_else(String::new, |unit| format!(" ({unit})"));
    let default = match &field.default {
        Default::Required => "; required".to_owned(),
        Default::Value(value) => format!("; {value} if left out"),
        Default::Absent => "; may be left out".to_owned(),
    };
    let mut lines =
        vec![wrapped(&format!("  {}: ", field.name), &format!("{}{unit}{default}", field.accepted), 6)];
    if !field.meaning.is_empty() {
        lines.push(wrapped("      ", &field.meaning, 6));
    }
    for (word, about) in &field.words {
        lines.push(wrapped(&format!("      \"{word}\": "), about, 10));
    }
    lines.join("\n")
}

/// What names an entry in a file, and the table of its settings; `{}` stands for its name.
#[derive(Clone, Copy)]
pub struct Frame(&'static str, &'static str);

const PLANNER: Frame = Frame("[[contender]]\nlabel = \"mine\"\nplanner = \"{}\"", "contender.settings");
const STAGE: Frame = Frame("[[contender.then]]\nstage = \"{}\"", "contender.then.settings");
const FAMILY: Frame = Frame("[[problems]]\nlabel = \"mine\"\nfamily = \"{}\"", "problems.settings");
const TASK: Frame = Frame("task = \"{}\"", "task_settings");
const CRITERION: Frame = Frame("[[claim]]\nid = \"mine\"\nat = \"section 1\"", "claim.check.{}");
const RULE: Frame = Frame("[[claim]]\nid = \"mine\"\nat = \"section 1\"", "claim.rule.{}");
const FIGURE: Frame = Frame("[[figure]]\nid = \"mine\"\nkind = \"{}\"\ncaption = \"…\"", "figure.settings");
const NONE: Frame = Frame("", "");

impl Item {
    /// Its example as a file has it; `None` if it takes no settings.
    pub fn shown(&self) -> Option<String> {
        let place = self.place();
        let mut text = self.frame.0.replace("{}", self.name);
        if !self.example.is_empty() {
            text += &format!("\n[{place}]");
        }
        for line in self.example.trim().lines() {
            // What is indented continues an array; brackets at the beginning of a line are a table's.
            let (brackets, rest) = line.split_at(line.len() - line.trim_start_matches('[').len());
            let within = if brackets.is_empty() { String::new() } else { format!("{brackets}{place}.") };
            text += &format!("\n{within}{rest}");
        }
        (!place.is_empty()).then_some(text)
    }

    /// The table of its settings in a file: `contender.settings`.
    pub fn place(&self) -> String {
        self.frame.1.replace("{}", self.name)
    }
}

/// Something that specs name.
pub struct Item {
    /// Its name.
    pub name: &'static str,
    /// One line on it.
    pub about: &'static str,
    /// Its settings, if it is a thing that is set.
    pub settings: Option<Accepted>,
    /// Settings that it can be built from; empty if it needs none.
    pub example: &'static str,
    /// A file of this repository that is one, if it is a kind of file.
    pub file: Option<&'static str>,
    /// The text before its settings in a file, with `{}` for its name, and the table of the settings.
    pub frame: Frame,
    /// The columns that it fills.
    pub columns: &'static [&'static str],
}

/// A thing that is set, from what its registry has of it.
fn item(
    frame: Frame,
    [name, about, example]: [&'static str; 3],
    settings: Accepted,
    columns: &'static [&'static str],
) -> Item {
    Item { name, about, settings: Some(settings), example, file: None, frame, columns }
}

fn planners_or_stages(first: bool) -> Vec<Item> {
    let fits = |entry: &&planner::Entry| matches!(entry.build, Build::Planner(_)) == first;
    let frame = if first { PLANNER } else { STAGE };
    let planners = study::planner::all().filter(fits);
    planners.map(|e| item(frame, [e.name, e.about, e.example], e.settings, e.columns)).collect()
}

/// Planners: the first in a contender's pipeline.
pub fn planners() -> Vec<Item> {
    planners_or_stages(true)
}

/// Stages: the others.
pub fn stages() -> Vec<Item> {
    planners_or_stages(false)
}

/// Families of problems.
pub fn families() -> Vec<Item> {
    let families = family::REGISTRY.iter();
    families.map(|e| item(FAMILY, [e.name, e.about, e.example], e.settings, e.columns)).collect()
}

/// Tasks.
pub fn tasks() -> Vec<Item> {
    task::REGISTRY.iter().map(|e| item(TASK, [e.name, e.about, e.example], e.settings, e.columns)).collect()
}

/// Criteria of claims.
pub fn criteria() -> Vec<Item> {
    criteria_or_rules(criterion::REGISTRY, CRITERION)
}

/// Rules of arithmetic on printed numbers.
pub fn rules() -> Vec<Item> {
    criteria_or_rules(rule::REGISTRY, RULE)
}

fn criteria_or_rules(registry: &[&criterion::Entry], frame: Frame) -> Vec<Item> {
    registry.iter().map(|e| item(frame, [e.name, e.about, e.example], e.settings, &[])).collect()
}

/// Kinds of figure.
pub fn figures() -> Vec<Item> {
    figure::REGISTRY.iter().map(|e| item(FIGURE, [e.name, e.about, e.example], e.settings, &[])).collect()
}

/// Kinds of preprocessed object, which have no settings of their own: their family's make them.
pub fn preprocessing() -> Vec<Item> {
    let kind = |e: &&preprocessing::Entry| Item {
        name: e.name,
        about: e.about,
        settings: None,
        example: "",
        file: None,
        frame: NONE,
        columns: e.columns,
    };
    preprocessing::REGISTRY.iter().map(kind).collect()
}

/// What `replan-audit` reads: the committed schema, which its tests hold to its checks.
struct AuditTables;

impl JsonSchema for AuditTables {
    fn schema_name() -> Cow<'static, str> {
        "AuditTables".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        serde_json::from_str(include_str!("../../docs/schema/audit_tables.schema.json"))
            .expect("it is a schema")
    }
}

/// Kinds of TOML file that replan reads, in the order of their names.
pub fn files() -> Vec<Item> {
    let named = [
        FileKind {
            name: "audit_tables",
            about: "printed tables, samples and relations for replan audit: docs/audit/zhang.toml",
            accepted: Accepted::shape::<AuditTables>(),
            example: "docs/audit/fu2018.toml",
        },
        FileKind {
            name: "crosscheck",
            about: "the questions to an independent judge: crosscheck.toml in a paper's folder",
            accepted: super::crosscheck::FILE,
            example: "experiments/gallery/crosscheck.toml",
        },
        FileKind {
            name: "paper",
            about: "a paper's source, inventory, claims and tables: paper.toml in its folder",
            accepted: paper::FILE,
            example: "experiments/movingai_sample/paper.toml",
        },
        FileKind {
            name: "planner_protocol",
            about: "lines of JSON that planners from outside and replan write: docs/PLANNER_PROTOCOL.md",
            accepted: Accepted::shape::<external::message::Messages>(),
            example: "docs/PLANNER_PROTOCOL.md",
        },
    ];
    let kind = |kind: &FileKind| Item {
        file: Some(kind.example),
        ..item(NONE, [kind.name, kind.about, ""], kind.accepted, &[])
    };
    let mut all: Vec<Item> = named.iter().chain(files::KINDS).map(kind).collect();
    all.sort_by_key(|item| item.name);
    all
}
