//! `replan import`: turns results that others recorded into records.

use super::load::open;
use super::{Failure, How, Which, command_line};
use crate::analysis::history::History;
use base::settings::none_called;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use study::elsewhere::{Imported, Mapping, Table, read_log};
use study::lock::Lock;
use study::store::Staged;

/// Imports results.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Import {
    /// The file of results
    file: PathBuf,
    /// The format of the file
    #[arg(long, value_name = "FORMAT")]
    from: From,
    /// A TOML file that names the columns of keys and metrics; for a log, the further properties that are metrics
    #[arg(long, value_name = "FILE", required_if_eq_any = [("from", "csv"), ("from", "parquet")])]
    columns: Option<PathBuf>,
    /// The study that takes them as its records, as `./my/paper/results`; its planners are `recorded`
    #[arg(long, value_name = "PAPER/STUDY", required_unless_present = "out", conflicts_with = "out")]
    into: Option<String>,
    /// Write records that belong to no paper into this folder, for `replan compare`
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  replan import results.csv --from csv --columns columns.toml --into ./my/paper/results
  replan import benchmark.log --from ompl-log --out outside
  replan compare outside --contenders geometric_RRT geometric_PRM";

/// A format of results.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum From {
    /// Comma-separated values under a line of heads
    Csv,
    /// A Parquet file
    Parquet,
    /// A benchmark log of OMPL
    OmplLog,
}

impl Import {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let mapping = self.columns.as_deref().map(Mapping::read).transpose()?;
        let (table, mapping) = match (self.from, mapping) {
            (From::OmplLog, more) => {
                let log = read_log(&self.file)?;
                let mapping =
                    Mapping::of_log(&log.experiment, log.statuses, |head| log.table.has(head), more);
                (log.table, mapping)
            }
            (From::Csv, Some(mapping)) => (Table::read_csv(&self.file)?, mapping),
            (From::Parquet, Some(mapping)) => (Table::read_parquet(&self.file)?, mapping),
            (From::Csv | From::Parquet, None) => return Err(Failure::input("--columns is missing")),
        };
        let imported = Imported::new(&table, &mapping)?;
        let folder = match (&self.into, &self.out) {
            (Some(into), _) => into_study(&imported, into)?,
            (None, Some(out)) => {
                let name = self.file.file_stem().unwrap_or_default().to_string_lossy();
                let name = study::slug(&name);
                let mut staged = Staged::default();
                imported.stage_alone(&mut staged, out, &name, command_line())?;
                staged.put()?;
                out.clone()
            }
            (None, None) => return Err(Failure::input("--into or --out is missing")),
        };
        say!("{} trials that were recorded elsewhere are in {}", imported.count(), folder.display());
        Ok(())
    }
}

/// Writes them as the records of the study that `into` names; the folder.
fn into_study(imported: &Imported, into: &str) -> Result<PathBuf, Failure> {
    let (paper, name) = into.rsplit_once('/').ok_or_else(|| {
        Failure::input(format!(
            "--into `{into}` names no study; a paper and its study as `zhang/results` are accepted"
        ))
    })?;
    let (places, paper) = open(&Which { paper: paper.to_owned(), out: None }, &How::plain(None))?;
    let study = paper.study(name).ok_or_else(|| {
        let known = paper.studies.iter().map(|study| study.name.as_str());
        Failure::input(format!("--into: {}", none_called("study", name, known)))
    })?;
    let lock = Lock::take(&places.runs)?;
    // What claims mean is written down before their data can be seen.
    History::note(&paper, lock.folder(), &command_line())?;
    let mut staged = Staged::default();
    imported.stage_of(&mut staged, lock.folder(), study, &places.inputs, command_line())?;
    staged.put()?;
    History::note(&paper, lock.folder(), &command_line())?;
    Ok(places.runs)
}
