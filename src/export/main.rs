//! `replan-export`: stored runs in the formats of other tools.
//!
//! OMPL's benchmark log and Planner Arena's database have the same tables, which [`benchmark`] makes of records. `replan export`
//! starts this program for all that it does not write itself, with the same arguments.

mod arena;
mod benchmark;
mod file_names;
mod frames;
mod log;
mod posthoc;

use benchmark::experiments;
use clap::Parser;
use file_names::FileNames;
use replan::analysis::compare::StoredRun;
use replan::cli::Failure;
use replan::cli::export::{Export, Format, Stage};
use std::path::Path;
use std::process::ExitCode;
use study::store::Staged;

#[derive(Parser)]
#[command(version, about, max_term_width = 100)]
struct Cli {
    #[command(flatten)]
    export: Export,
}

fn main() -> ExitCode {
    let export = Cli::parse().export;
    let format = export.format();
    let done = match format {
        Format::Csv | Format::RoCrate => export.run(),
        _ => export.write(|staged, out, folder, run| stage(format, staged, out, folder, run)),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.end("replan-export"),
    }
}

fn stage(format: Format, staged: &mut Staged, out: &Path, folder: &Path, run: &StoredRun) -> Stage {
    match format {
        Format::Csv | Format::RoCrate => unreachable!("`Export` writes these itself"),
        Format::Parquet => frames::stage(staged, out, folder, run),
        Format::OmplLog => {
            let all = experiments(run);
            let mut names = FileNames::default();
            for experiment in &all {
                let file = out.join(names.next(&experiment.name, ".log"));
                staged.add(&file, log::text(experiment).as_bytes())?;
            }
            Ok(format!("{} benchmark logs are", all.len()))
        }
        Format::PlannerArena => {
            let all = experiments(run);
            let bytes = arena::database(&all).map_err(|error| Failure::input(format!("SQLite: {error}")))?;
            staged.add(&out.join("plannerarena.db"), &bytes)?;
            Ok(format!("plannerarena.db with {} experiments is", all.len()))
        }
        Format::Posthoc => posthoc::stage(staged, out, folder, run),
    }
}
