//! The description of one paper or study that `replan list` prints, within 80 columns.

use super::explain::wrapped;
use super::explorer::Explorer;
use super::places::Places;
use super::progress::doing;
use super::{Failure, Which, counted};
use std::path::PathBuf;
use study::paper::Paper;
use study::{Choice, Contender, Group, Study, elsewhere_mark, recorded_mark};

/// A paper: its source, studies and claims, and how it is run.
pub fn paper(paper: &Paper) -> String {
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
pub fn choice(choice: &Choice) -> String {
    let options: Vec<&str> = choice.options.keys().map(String::as_str).collect();
    let lines = [
        choice.id.clone(),
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
pub fn study(paper: &Paper, study: &Study) -> Result<String, Failure> {
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
