//! `replan list`: what there is.

use super::Failure;
use super::places::{EXPERIMENTS, papers};
use crate::analysis::{check, metric};
use crate::planner::{self, Build};
use crate::render::figure;
use crate::study::paper::Paper;
use crate::study::{Inputs, family, prepared, task};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

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
        for what in What::value_variants() {
            if self.what.is_none_or(|wanted| wanted == *what) {
                let name = what.to_possible_value().expect("no variant is hidden");
                say!("{}", name.get_name());
                for (name, about) in rows(*what)? {
                    say!("  {name:<26} {about}");
                }
            }
        }
        Ok(())
    }
}

fn rows(what: What) -> Result<Vec<(String, String)>, Failure> {
    let row = |name: &str, about: &str| (name.to_owned(), about.to_owned());
    let planners = |first: bool| {
        let fits = move |entry: &&planner::Entry| matches!(entry.build, Build::Planner(_)) == first;
        planner::REGISTRY.iter().copied().filter(fits).map(|e| row(e.name, e.about)).collect()
    };
    Ok(match what {
        What::Papers => loaded()?.iter().map(|paper| row(&paper.id, &paper.source.title)).collect(),
        What::Studies => {
            let papers = loaded()?;
            let studies = papers.iter().flat_map(|paper| &paper.studies);
            studies.map(|s| (format!("{}/{}", s.paper, s.name), s.question.clone())).collect()
        }
        What::Readings => {
            let papers = loaded()?;
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
        What::Planners => planners(true),
        What::Stages => planners(false),
        What::Families => family::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Prepared => prepared::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Tasks => task::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Checks => check::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
        What::Metrics => metric::METRICS.iter().map(|m| row(m.name, &m.title())).collect(),
        What::Figures => figure::REGISTRY.iter().map(|e| row(e.name, e.about)).collect(),
    })
}

fn loaded() -> Result<Vec<Paper>, Failure> {
    let load = |name: String| {
        let folder = Path::new(EXPERIMENTS).join(name);
        let inputs = Inputs { roots: vec![folder.clone(), PathBuf::new()] };
        Ok(Paper::load(&folder, &inputs)?)
    };
    papers().into_iter().map(load).collect()
}
