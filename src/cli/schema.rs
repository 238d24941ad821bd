//! `replan schema`: writes a JSON Schema of every kind of TOML file, for editors.

use super::catalogue::{self, Item};
use super::file_schema::{file_name, text};
use super::{Failure, all};
use clap::Args;
use std::fs;
use std::path::PathBuf;

/// Writes JSON Schemas.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Schema {
    /// The folder for the schemas, one `<kind>.schema.json` each
    #[arg(default_value = "docs/schema")]
    folder: PathBuf,
    /// Write nothing; list schemas that are out of date
    #[arg(long)]
    check: bool,
}

const EXAMPLES: &str = "Examples:
  replan schema
  replan schema --check               are the stored schemas up to date?";

impl Schema {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        if !self.check {
            fs::create_dir_all(&self.folder)?;
        }
        let kinds = catalogue::files();
        let mut results: Vec<Result<(), Failure>> = kinds.iter().map(|kind| self.each(kind)).collect();
        if self.check {
            let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
            let of_kind = |name: &str| kinds.iter().any(|kind| name == file_name(kind.name));
            let mut names: Vec<String> =
                entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
            names.sort();
            results.extend(names.iter().filter(|name| !of_kind(name)).map(|name| {
                let path = self.folder.join(name);
                Err(Failure::stale(format!("{} is the schema of no kind of file; remove it", path.display())))
            }));
        }
        all(results, "schemas are not current")?;
        if self.check {
            let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
            say!("{} schemas in {} are current: {}", kinds.len(), self.folder.display(), names.join(", "));
        }
        Ok(())
    }

    fn each(&self, kind: &Item) -> Result<(), Failure> {
        let path = self.folder.join(file_name(kind.name));
        let text = text(kind.name);
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
