//! `replan schema`: writes a JSON Schema of every kind of TOML file, for editors.

use super::catalogue::{self, Item};
use super::file_schema::{path, text};
use super::{Failure, all};
use clap::Args;
use std::fs;
use std::path::PathBuf;

/// Writes JSON Schemas.
#[derive(Args)]
pub struct Schema {
    /// Where they are written, one `<kind>.schema.json` each
    #[arg(default_value = "docs/schema")]
    folder: PathBuf,
    /// Write nothing; say which of them are not current
    #[arg(long)]
    check: bool,
}

impl Schema {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        if !self.check {
            fs::create_dir_all(&self.folder)?;
        }
        let results = catalogue::files().iter().map(|kind| self.each(kind)).collect();
        all(results, "schemas are not current")
    }

    fn each(&self, kind: &Item) -> Result<(), Failure> {
        let (path, text) = (path(&self.folder, kind.name), text(kind.name));
        if self.check {
            let stored = fs::read_to_string(&path).unwrap_or_default();
            let stale = || Failure::stale(format!("{} is not current; run `replan schema`", path.display()));
            return if stored == text { Ok(()) } else { Err(stale()) };
        }
        fs::write(&path, text)?;
        say!("{}", path.display());
        Ok(())
    }
}
