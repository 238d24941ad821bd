//! `replan list`: what there is.

use super::places::{EXPERIMENTS, papers};
use super::{Failure, all};
use crate::analysis::{check, metric};
use crate::render::figure;
use crate::study::paper::Paper;
use crate::study::{Inputs, family, prepared, task};
use clap::{Args, ValueEnum};
use engine::kinematics::{Robot, robot::Body};
use engine::planner::{self, Build};
use std::path::{Path, PathBuf};

/// Where robots are shipped.
const ROBOTS: &str = "data/robots";

/// Lists what there is.
#[derive(Args)]
pub struct List {
    /// What to list; everything if absent
    what: Option<What>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum What {
    Papers,
    Studies,
    Readings,
    Robots,
    Planners,
    Stages,
    Families,
    Prepared,
    Tasks,
    Checks,
    Metrics,
    Figures,
}

impl List {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let wanted = [What::Papers, What::Studies, What::Readings];
        let is_about_papers = self.what.is_none_or(|what| wanted.contains(&what));
        let (papers, mut results) = if is_about_papers { loaded() } else { (Vec::new(), Vec::new()) };
        let robots = if self.what.is_none_or(|what| what == What::Robots) { robots() } else { Vec::new() };
        let (robots, broken): (Vec<_>, Vec<_>) = robots.into_iter().partition(Result::is_ok);
        let robots: Vec<Robot> = robots.into_iter().flatten().collect();
        results.extend(broken.into_iter().map(|robot| robot.map(drop)));
        for what in What::value_variants() {
            if self.what.is_none_or(|wanted| wanted == *what) {
                let name = what.to_possible_value().expect("no variant is hidden");
                say!("{}", name.get_name());
                for (name, about) in rows(*what, &papers, &robots) {
                    say!("  {name:<26} {about}");
                }
            }
        }
        all(results, "papers and robots cannot be listed")
    }
}

fn rows(what: What, papers: &[Paper], robots: &[Robot]) -> Vec<(String, String)> {
    let row = |name: &str, about: &str| (name.to_owned(), about.to_owned());
    let planners = |first: bool| {
        let fits = move |entry: &&planner::Entry| matches!(entry.build, Build::Planner(_)) == first;
        planner::REGISTRY.iter().copied().filter(fits).map(|e| row(e.name, e.about)).collect()
    };
    match what {
        What::Papers => papers.iter().map(|paper| row(&paper.id, &paper.source.title)).collect(),
        What::Studies => {
            let studies = papers.iter().flat_map(|paper| &paper.studies);
            studies.map(|s| (format!("{}/{}", s.paper, s.name), s.question.clone())).collect()
        }
        What::Readings => {
            let readings =
                papers.iter().flat_map(|paper| paper.readings().into_iter().map(|r| (&paper.id, r)));
            readings
                .map(|(paper, reading)| {
                    let options: Vec<&str> = reading.options.keys().map(String::as_str).collect();
                    let about =
                        format!("{} (default {}): {}", options.join(" | "), reading.default, reading.why);
                    (format!("{paper}/{}", reading.id), about)
                })
                .collect()
        }
        What::Robots => robots.iter().map(|robot| row(robot.name(), &about(robot))).collect(),
        What::Planners => planners(true),
        What::Stages => planners(false),
        What::Families => family::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Prepared => prepared::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Tasks => task::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Checks => check::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Metrics => metric::METRICS.iter().map(|m| row(m.name, &m.title())).collect(),
        What::Figures => figure::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
    }
}

/// What one line says of a robot.
fn about(robot: &Robot) -> String {
    let bodies: Vec<&str> = robot.bodies().iter().map(Body::name).collect();
    format!("{}; bodies: {}", robot.arm().solver(), bodies.join(", "))
}

/// Every robot file of the project, by name.
fn robots() -> Vec<Result<Robot, Failure>> {
    let files = std::fs::read_dir(ROBOTS).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<PathBuf> =
        files.filter(|file| file.extension().is_some_and(|e| e == "toml")).collect();
    files.sort_unstable();
    files.iter().map(|file| Robot::load(file).map_err(|error| Failure::input(error.to_string()))).collect()
}

/// Every paper that can be read, and how reading each went.
fn loaded() -> (Vec<Paper>, Vec<Result<(), Failure>>) {
    let load = |name: String| -> Result<Paper, Failure> {
        let folder = Path::new(EXPERIMENTS).join(name);
        let inputs = Inputs { roots: vec![folder.clone(), PathBuf::new()] };
        Ok(Paper::load(&folder, &inputs)?)
    };
    let read: Vec<Result<Paper, Failure>> = papers().into_iter().map(load).collect();
    let (mut papers, mut results) = (Vec::new(), Vec::new());
    for paper in read {
        results.push(paper.map(|paper| papers.push(paper)));
    }
    (papers, results)
}
