//! `replan crosscheck --statistics`: estimates, intervals, outcomes and verdicts before a judge in Python.
//!
//! The judge receives the meanings of metrics, the folders of papers, and the numbers of explorations, whose trials are
//! not kept. It receives nothing else that is computed here.

use super::super::judge::polylines;
use super::super::load::load;
use super::super::places::{Places, home, papers};
use super::super::progress::doing;
use super::super::{Failure, How, Which};
use super::FOLDER;
use super::python::Judge;
use crate::analysis::across::Stored;
use crate::analysis::estimates::Estimates;
use crate::analysis::metric::{METRICS, Metric};
use crate::analysis::polylines::Polylines;
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
    let folder = out.unwrap_or(Path::new("")).join(FOLDER);
    std::fs::create_dir_all(&folder)?;
    let explored =
        places.iter().map(|places| write_explored(places, &folder)).collect::<Result<Vec<_>, _>>()?;
    let request = folder.join(REQUEST);
    write_whole(&request, format!("{:#}\n", request_json(&places, &explored)).as_bytes())?;
    doing("computing the statistics of stored runs again");
    if judge.recompute(&request)? {
        return Ok(());
    }
    Err(Failure::stale("the statistics computed again differ from verdicts.toml"))
}

/// Writes what the explorations of a paper amount to, first and on the second seed, into `folder`.
fn write_explored(places: &Places, folder: &Path) -> Result<PathBuf, Failure> {
    let name = places.runs.file_name().unwrap_or_default().to_string_lossy();
    let path = folder.join(format!("{name}.explored.json"));
    let stored = if Estimates::path(&places.runs).exists() {
        let paper = load(places, &How::plain(None))?;
        Stored::read(&paper, &places.runs, &Polylines::kept_in(&polylines(places)))?
    } else {
        Stored::default()
    };
    write_whole(&path, format!("{}\n", json!([stored.first, stored.second])).as_bytes())?;
    Ok(path)
}

/// The request: every metric, where the papers and their runs lie, and what was explored of each.
fn request_json(places: &[Places], explored: &[PathBuf]) -> Value {
    let of_metric = |metric: &Metric| {
        json!({
            "name": metric.name,
            "column": metric.column,
            "scale": metric.scale,
            "at_most": metric.at_most,
            "better": metric.better.name(),
            "clock": metric.is_clock(),
            "status": metric.is_status(),
            "of_search": metric.is_of_search,
        })
    };
    let of_paper = |(places, explored): (&Places, &PathBuf)| {
        let paths = [&places.folder, &places.runs, explored];
        let [experiments, runs, explored] = paths.map(|path: &PathBuf| path.to_string_lossy());
        json!({ "experiments": experiments, "runs": runs, "explored": explored })
    };
    json!({
        "metrics": METRICS.iter().map(of_metric).collect::<Vec<_>>(),
        "papers": places.iter().zip(explored).map(of_paper).collect::<Vec<_>>(),
    })
}
