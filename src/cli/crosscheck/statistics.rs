//! `replan crosscheck --statistics`: estimates, intervals, outcomes and verdicts before a judge in Python.
//!
//! The judge knows what metrics mean and where papers lie, and nothing else of what is computed here.

use super::super::places::{Places, home, papers};
use super::super::progress::doing;
use super::super::{Failure, Which};
use super::FOLDER;
use super::python::Judge;
use crate::analysis::metric::{METRICS, Metric};
use crate::analysis::verdict::Verdicts;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use study::store::write_whole;

/// The judge's questions, below the folder of cross-checks.
const REQUEST: &str = "statistics.json";

/// Has the statistics of one paper, or of all, computed again; of the runs below `out` if that is given.
///
/// # Errors
/// Code 3 if something differs; code 4 if Python is missing; a paper without verdicts.
pub fn run(paper: Option<&str>, out: Option<&Path>, python: Option<&str>) -> Result<(), Failure> {
    let names = paper.map_or_else(papers, |paper| vec![paper.to_owned()]);
    if names.is_empty() {
        return Err(Failure::input("no paper is here; run replan from the project's own folder"));
    }
    let find = |name: String| Places::find(&Which { paper: name, out: out.map(Path::to_owned) }, "");
    let places = names.into_iter().map(find).collect::<Result<Vec<_>, _>>()?;
    for places in &places {
        let path = Verdicts::path(&places.runs);
        if !path.is_file() {
            let paper = places.folder.display();
            return Err(Failure::input(format!(
                "{}: no verdicts; run `replan judge {paper}` first",
                path.display()
            )));
        }
    }
    let judge = Judge::ready(python, &home(None)?.join(FOLDER))?;
    let request = out.unwrap_or(Path::new("")).join(FOLDER).join(REQUEST);
    std::fs::create_dir_all(request.parent().unwrap_or(Path::new("")))?;
    write_whole(&request, format!("{:#}\n", request_json(&places)).as_bytes())?;
    doing("computing the statistics of stored runs again");
    if judge.recompute(&request)? {
        return Ok(());
    }
    Err(Failure::stale("the statistics computed again differ from verdicts.toml"))
}

/// The request: every metric, and where the papers and their runs lie.
fn request_json(places: &[Places]) -> Value {
    let of_metric = |metric: &Metric| {
        json!({
            "name": metric.name,
            "column": metric.column,
            "scale": metric.scale,
            "at_most": metric.at_most,
            "better": metric.better.name(),
            "clock": metric.is_clock(),
            "status": metric.is_status(),
        })
    };
    let of_paper = |places: &Places| {
        let [experiments, runs] = [&places.folder, &places.runs].map(|path: &PathBuf| path.to_string_lossy());
        json!({ "experiments": experiments, "runs": runs })
    };
    json!({
        "metrics": METRICS.iter().map(of_metric).collect::<Vec<_>>(),
        "papers": places.iter().map(of_paper).collect::<Vec<_>>(),
    })
}
