//! `replan list`: everything that specs can name, and what is known of one of these, within 80 columns.

use super::explorer::Explorer;
use super::places::{Places, experiments, home, papers};
use super::progress::doing;
use super::schema::{self, Item};
use super::{Failure, Which, all, counted};
use crate::analysis::metric;
use crate::analysis::verdict_rule::Verdict;
use crate::render::prose::plain;
use base::file::read_text;
use base::robot::read_urdf;
use base::settings::describe::{Default, Field, fields};
use base::settings::did_you_mean;
use clap::{Args, ValueEnum};
use engine::kinematics::{AXES, Robot, robot::Body};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use study::paper::Paper;
use study::{Choice, Contender, Group, Inputs, Study, StudyError, elsewhere_mark, recorded_mark};

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
  replan list criteria one_instance   one entry with its settings and an example
  replan list choices ties            a choice, in every paper that leaves it open";

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
    pub fn run(self) -> Result<(), Failure> {
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
        let papers = is_wanted(&[What::Papers, What::Studies, What::Choices]).then(outlined);
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
            (What::Choices, Some((id, choice))) => {
                let choices = find(id).into_iter().flat_map(|paper| &paper.choices);
                choices.filter(|own| own.id == choice).map(choice_alone).next()
            }
            (What::Studies, Some((id, study))) => {
                // Its trials are counted, which takes what its problems are built from.
                let paper = find(id).map(|_| read(id, Paper::load)).transpose()?;
                let found = paper.as_ref().and_then(|paper| Some((paper, paper.study(study)?)));
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
        What::Planners => ("planner", Some(schema::planners)),
        What::Stages => ("stage", Some(schema::stages)),
        What::Families => ("family", Some(schema::families)),
        What::Preprocessing => ("kind of preprocessed object", Some(schema::preprocessing)),
        What::Tasks => ("task", Some(schema::tasks)),
        What::Criteria => ("criterion", Some(schema::criteria)),
        What::Rules => ("rule", Some(schema::rules)),
        What::Metrics => ("metric", None),
        What::Verdicts => ("verdict", None),
        What::Figures => ("kind of figure", Some(schema::figures)),
        What::Files => ("kind of file", Some(schema::files)),
    }
}

/// A message names so many things of a kind at most.
const NAMED: usize = 30;

/// That nothing of the kind `what` is called `name`, with the nearest name; with all if they are few.
fn none_listed(what: What, name: &str, known: &[&str]) -> Failure {
    let singular = kind(what).0;
    let ends = known.iter().filter_map(|known| Some(known.rsplit_once('/')?.1));
    let hint = did_you_mean(name, known.iter().copied().chain(ends));
    let there_are = match known.len() {
        0 => "there are none at all".to_owned(),
        1..=NAMED => format!("there are {}", known.join(", ")),
        count => format!("`replan list {}` lists all {count}", title(what)),
    };
    Failure::input(format!("there is no {singular} `{name}`{hint}; {there_are}"))
}

/// The row called `name`, with or without the paper before it; or all of the paper called `name`.
fn named<'r>(rows: &'r [(String, String)], name: &str) -> Vec<(&'r str, &'r str)> {
    let is_named = |known: &str| {
        known == name || known.split_once('/').is_some_and(|(paper, own)| own == name || paper == name)
    };
    let rows = rows.iter().map(|(known, about)| (known.as_str(), about.as_str()));
    rows.filter(|(known, _)| is_named(known)).collect()
}

/// What the one thing of the kind `what` that is called `name` is.
fn one(what: What, name: &str) -> Result<(), Failure> {
    let items = kind(what).1;
    let Some(items) = items else {
        let (found, results) = LoadedFiles::read(|kind| kind.contains(&what));
        let rows = rows(what, &found);
        let named = named(&rows, name);
        if named.is_empty() {
            let known: Vec<&str> = rows.iter().map(|(known, _)| known.as_str()).collect();
            return Err(none_listed(what, name, &known));
        }
        for (known, about) in &named {
            let described = if named.len() == 1 { found.described(what, known)? } else { None };
            say!("{}", described.unwrap_or_else(|| format!("{known}\n{}", wrapped("  ", about, 2))));
        }
        if let Some(metric) = metric::find(name).filter(|_| what == What::Metrics) {
            let unit = if metric.unit.is_empty() { "none: it is a count or a flag" } else { &metric.unit };
            say!("{}", wrapped("  unit: ", unit, 2));
            say!("{}", wrapped("  better: ", metric.better.name(), 2));
            say!("{}", wrapped("  read from: ", metric.column, 2));
        }
        return all(results, "papers and robots cannot be listed");
    };
    let items = items();
    let known: Vec<&str> = items.iter().map(|item| item.name).collect();
    let item = items.iter().find(|item| item.name == name);
    let item = item.ok_or_else(|| none_listed(what, name, &known))?;
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

/// The paper called `name`, read as `how` reads it.
fn read(name: &str, how: impl Fn(&Path, &Inputs) -> Result<Paper, StudyError>) -> Result<Paper, Failure> {
    let folder = experiments().join(name);
    let inputs = Inputs::below(vec![folder.clone(), home(None)?]);
    Ok(how(&folder, &inputs)?)
}

/// Every paper that can be read, as it is written, and how reading each went.
fn outlined() -> (Vec<Paper>, Vec<Result<(), Failure>>) {
    doing("reading the papers");
    let read: Vec<Result<Paper, Failure>> =
        papers().into_par_iter().map(|name| read(&name, Paper::outline)).collect();
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

/// A choice that a paper leaves open: its options, and why it is one.
pub(super) fn choice_alone(choice: &Choice) -> String {
    let options: Vec<&str> = choice.options.keys().map(String::as_str).collect();
    let lines = [
        choice.title.as_ref().map_or_else(|| choice.id.clone(), |title| format!("{}: {title}", choice.id)),
        wrapped("  options: ", &options.join(", "), 6),
        wrapped("  default: ", &choice.default, 6),
        wrapped("  why: ", &choice.why, 6),
    ];
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
    let trials = Explorer::new(paper, &places, None, (None, "explore")).trials_of(study)?;
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
