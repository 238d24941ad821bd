//! `replan export`: stored trials and what they come to, for other programs.

use super::Failure;
use super::places::stored_run;
use super::progress::doing;
use crate::analysis::compare::{StoredRun, cells, stored_studies};
use crate::render::comparison::cells_csv;
use clap::Args;
use std::path::{Path, PathBuf};
use study::manifest::Manifest;
use study::store::{Staged, check_records, csv};

/// Exports a stored run.
#[derive(Args)]
pub struct Export {
    /// A stored run: a paper's name, the folder of an earlier `--out`, or a folder of records
    paper: String,
    /// As comma-separated values: trials, preprocessed objects and times of each study, and statistics.csv
    #[arg(long, required = true)]
    csv: bool,
    /// Write into this folder; below target/replan/export/ if absent
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// The kinds of record that are exported; traces are lists of numbers without a table's shape.
const PARTS: [&str; 3] = ["trials", "preprocessing", "times"];

/// Refuses a folder of which some record is gone or is not what its manifest names.
pub(super) fn check_stored(folder: &Path) -> Result<(), Failure> {
    for study in stored_studies(folder) {
        check_records(folder, &study, &Manifest::read(folder, &study)?.files)?;
    }
    Ok(())
}

impl Export {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let folder = stored_run(&self.paper)?;
        let name = folder.file_name().unwrap_or_default();
        doing(&format!("{}: reading its records and computing their statistics", self.paper));
        check_stored(&folder)?;
        let out = self.out.unwrap_or_else(|| PathBuf::from("target/replan/export").join(name));
        let mut staged = Staged::default();
        let cells = cells(&StoredRun::read(&folder, &self.paper)?);
        for study in stored_studies(&folder) {
            doing(&format!("{}/{study}: writing its records", self.paper));
            let manifest = Manifest::read(&folder, &study)?;
            for part in PARTS {
                let text = csv(&folder, &study, part, &manifest.files)?;
                staged.add(&out.join(format!("{study}.{part}.csv")), text.as_bytes())?;
            }
        }
        staged.add(&out.join("statistics.csv"), cells_csv(&cells).as_bytes())?;
        staged.put()?;
        say!("trials and {} statistics are in {}", cells.len(), out.display());
        Ok(())
    }
}
