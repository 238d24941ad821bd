//! `replan export`: stored trials and their statistics in the formats of other programs.
//!
//! Comma-separated values are written here. What needs a database or another reader of records is written by the program
//! `replan-export`, which takes the same arguments.

use super::Failure;
use super::beside::become_program;
use super::pack::{Pack, day};
use super::places::{check_stored, stored_run};
use super::progress::doing;
use crate::analysis::compare::{StoredRun, cells};
use crate::render::comparison::cells_csv;
use clap::{Args, ValueEnum};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use study::store::{Staged, csv};

/// Exports a stored run.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Export {
    /// A paper's name, a folder that holds a paper.toml, or a stored run: an earlier `--out` or its records
    pub paper: String,
    /// The same as `--to csv`
    #[arg(long)]
    csv: bool,
    /// The format
    #[arg(long, value_name = "FORMAT", required_unless_present = "csv", conflicts_with = "csv")]
    to: Option<Format>,
    /// Write into this folder; below target/replan/export/ if absent
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Day of publication for an RO-Crate, as 2026-01-31
    #[arg(long, value_name = "DAY", value_parser = day, required_if_eq("to", "ro-crate"))]
    date: Option<String>,
    /// Address of the licence for an RO-Crate; the LICENSE file of the project if absent
    #[arg(long, value_name = "URL")]
    license: Option<String>,
}

const EXAMPLES: &str = "Examples:
  replan export zhang --to csv
  replan export zhang --to parquet --out trials";

/// A format that stored runs are exported in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Comma-separated values: trials, preprocessed objects and times of each study, and statistics.csv
    Csv,
    /// One Parquet file of all trials, and one of their statistics
    Parquet,
    /// A benchmark log of OMPL for each problem group
    OmplLog,
    /// A database (SQL) that Planner Arena reads
    PlannerArena,
    /// A trace for posthoc of each stored search on a grid
    Posthoc,
    /// The same as `replan pack`
    RoCrate,
}

/// The kinds of record that are exported; traces are lists of numbers without a table's shape.
const PARTS: [&str; 3] = ["trials", "preprocessing", "times"];

impl Export {
    /// Runs the command.
    ///
    /// # Errors
    /// No sound run is stored there, a file cannot be written, or `replan-export` is missing.
    pub fn run(self) -> Result<(), Failure> {
        match (self.format(), self.date.clone()) {
            (Format::Csv, _) => self.write(stage_csv),
            (Format::RoCrate, Some(date)) => {
                let name = PathBuf::from(&self.paper);
                let to = self.folder(name.file_name().unwrap_or_default());
                Pack::new(self.paper, to, date, self.license).run()
            }
            _ => become_program("replan-export"),
        }
    }

    /// Where it writes what is called `name`.
    fn folder(&self, name: &OsStr) -> PathBuf {
        self.out.clone().unwrap_or_else(|| PathBuf::from("target/replan/export").join(name))
    }

    /// The format.
    pub fn format(&self) -> Format {
        self.to.unwrap_or(Format::Csv)
    }

    /// Writes the files that `stage` makes of the stored run. `stage` gets the folder to write into, the folder of the
    /// run, and the run; it returns the names of its files.
    ///
    /// # Errors
    /// No run is stored there, one of its files is damaged, those of `stage`, and those of the file system.
    pub fn write(
        &self,
        stage: impl FnOnce(&mut Staged, &Path, &Path, &StoredRun) -> Stage,
    ) -> Result<(), Failure> {
        doing(&format!("{}: reading its records and computing their statistics", self.paper));
        let folder = stored_run(&self.paper)?;
        check_stored(&folder)?;
        let out = self.folder(folder.file_name().unwrap_or_default());
        let mut staged = Staged::default();
        let what = stage(&mut staged, &out, &folder, &StoredRun::read(&folder, &self.paper)?)?;
        staged.put()?;
        say!("{what} in {}", out.display());
        Ok(())
    }
}

/// What was staged, as `3 traces are`.
pub type Stage = Result<String, Failure>;

/// Stages comma-separated values.
fn stage_csv(staged: &mut Staged, out: &Path, folder: &Path, run: &StoredRun) -> Stage {
    for (study, (manifest, _)) in &run.studies {
        doing(&format!("{}/{study}: writing its records", run.name));
        for part in PARTS {
            let text = csv(folder, study, part, &manifest.files)?;
            staged.add(&out.join(format!("{study}.{part}.csv")), text.as_bytes())?;
        }
    }
    let cells = cells(run);
    staged.add(&out.join("statistics.csv"), cells_csv(&cells).as_bytes())?;
    Ok(format!("trials and {} statistics are", cells.len()))
}
