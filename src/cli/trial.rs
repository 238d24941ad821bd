//! `replan repro --trial`: one trial alone, against its stored row.

use super::places::Places;
use super::{Failure, How};
use crate::study::paper::Paper;
use crate::study::record::Row;
use crate::study::session;

/// Runs the trial called `name` = `study/trial`, prints its record and path, and compares it with the stored row.
pub fn run(paper: &Paper, places: &Places, how: &How, name: &str) -> Result<(), Failure> {
    let (study_name, trial) = name.split_once('/').unwrap_or((name, ""));
    let known = || paper.studies.iter().map(|study| study.name.as_str()).collect::<Vec<_>>().join(", ");
    let study = paper.study(study_name).ok_or_else(|| {
        Failure::input(format!(
            "--trial {name}: there is no study `{study_name}`; write STUDY/TRIAL, with a study of {}",
            known()
        ))
    })?;
    let points = how.points(study)?;
    let (batch, stored) = session::run_one(study, &points, &places.inputs, &places.runs, trial)?;
    for row in &batch.rows {
        print_row(row);
    }
    for kept in &batch.kept {
        let points = kept.exhibit.values.chunks(kept.exhibit.width);
        let listed: Vec<String> = points.map(|point| format!("{point:?}")).collect();
        say!("{:<22} {}", kept.exhibit.name, listed.join(" "));
    }
    match (batch.rows.first(), stored) {
        (_, None) => {
            say!("no stored run has this trial");
            Ok(())
        }
        (Some(row), Some(stored)) if *row == stored => {
            say!("equals the stored row");
            Ok(())
        }
        (_, Some(stored)) => {
            print_row(&stored);
            Err(Failure::stale(format!("trial {name} is not what is stored; the stored row stands above")))
        }
    }
}

fn print_row(row: &Row) {
    let text = |name: &str, value: &str| say!("{name:<22} {value}");
    text("trial", &row.trial);
    text("problem", &row.problem);
    text("contender", &row.contender);
    text("reading", &row.reading);
    text("seed", &row.seed.to_string());
    text("status", row.status.name());
    if let Some(reason) = &row.reason {
        text("reason", reason);
    }
    for (name, value) in &row.values {
        text(name, &value.as_f64().to_string());
    }
}
