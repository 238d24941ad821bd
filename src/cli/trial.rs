//! `replan repro --trial`: one trial alone, against its stored row.

use super::places::Places;
use super::progress::doing;
use super::{Failure, How};
use base::settings::none_called;
use base::text::listed;
use study::name::Names;
use study::paper::Paper;
use study::record::{Kept, Row};
use study::session;

/// Runs the trial called `name` = `study/trial`, prints its record and path, and compares it with the stored row.
pub fn run(paper: &Paper, places: &Places, how: &How, name: &str) -> Result<(), Failure> {
    let (study_name, trial) = name.split_once('/').unwrap_or((name, ""));
    let known = paper.studies.iter().map(|study| study.name.as_str());
    let study = paper.study(study_name).ok_or_else(|| {
        Failure::input(format!(
            "--trial {name}: {}; write STUDY/TRIAL",
            none_called("study", study_name, known)
        ))
    })?;
    let points = how.interpretations(study)?;
    doing(&format!("{}: running trial {name}", paper.id));
    let names = study.names();
    let (batch, stored) = session::run_one(study, &points, &places.inputs, &places.runs, trial)?;
    for row in &batch.rows {
        print_row(row, &names);
    }
    print_traces(&batch.kept);
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
            print_row(&stored, &names);
            Err(Failure::stale(format!("trial {name} is not what is stored; the stored row stands above")))
        }
    }
}

/// The path point by point; how many points everything else has, which may be thousands.
fn print_traces(kept: &[Kept]) {
    for Kept { trace, .. } in kept {
        let points = trace.values.chunks(trace.width);
        let text = if trace.name == "path" {
            points.map(listed).collect::<Vec<String>>().join(" ")
        } else {
            format!("{} points of {} numbers", points.len(), trace.width)
        };
        say!("{:<22} {text}", trace.name);
    }
    if kept.iter().all(|kept| kept.trace.name != "path") {
        say!("{:<22} none", "path");
    }
}

fn print_row(row: &Row, names: &Names) {
    let text = |name: &str, value: &str| say!("{name:<22} {value}");
    text("trial", &names.trial(&row.key));
    text("problem", &names.problem(&row.key.on, row.key.query.as_deref()));
    text("contender", &row.key.contender);
    text("interpretation", &names.interpretation(&row.key.on.interpretation));
    text("seed", &row.seed.map_or_else(|| "unknown".to_owned(), |seed| seed.to_string()));
    text("status", row.status.name());
    if let Some(reason) = &row.reason {
        text("reason", reason);
    }
    for (column, value) in row.values.iter() {
        text(column.name, &value.as_f64().to_string());
    }
}
