//! `replan-export`: stored runs in the formats of other tools.
//!
//! OMPL's benchmark log and Planner Arena's database have the same tables, which [`benchmark`] makes of records. `replan export`
//! starts this program for all that it does not write itself, with the same arguments.

mod arena;
mod benchmark;
mod frames;
mod log;
mod posthoc;

use benchmark::experiments;
use clap::Parser;
use replan::analysis::compare::StoredRun;
use replan::cli::Failure;
use replan::cli::export::{Export, Format};
use std::io::{self, Write as _};
use std::process::ExitCode;
use study::store::Staged;

#[derive(Parser)]
#[command(version, about, max_term_width = 100)]
struct Cli {
    #[command(flatten)]
    export: Export,
}

fn main() -> ExitCode {
    match run(&Cli::parse().export) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.end("replan-export"),
    }
}

fn run(export: &Export) -> Result<(), Failure> {
    if export.format() == Format::Csv {
        return export.write_csv();
    }
    let [folder, out] = export.places()?;
    let run = StoredRun::read(&folder, &export.paper)?;
    let mut staged = Staged::default();
    let what = match export.format() {
        Format::Csv => unreachable!("it was written above"),
        Format::Parquet => frames::stage(&mut staged, &out, &folder, &run)?,
        Format::OmplLog => {
            let all = experiments(&run)?;
            for experiment in &all {
                staged.add(&out.join(experiment.file()), log::text(experiment).as_bytes())?;
            }
            format!("{} benchmark logs are", all.len())
        }
        Format::PlannerArena => {
            let all = experiments(&run)?;
            let bytes = arena::database(&all).map_err(|error| Failure::input(format!("SQLite: {error}")))?;
            staged.add(&out.join("plannerarena.db"), &bytes)?;
            format!("plannerarena.db with {} experiments is", all.len())
        }
        Format::Posthoc => posthoc::stage(&mut staged, &out, &folder, &run)?,
    };
    staged.put()?;
    // A reader that closed the pipe early needs no answer.
    let _ = writeln!(io::stdout(), "{what} in {}", out.display());
    Ok(())
}
