//! `replan check`: everything that can be wrong with a paper, without running it.

use super::places::{Places, papers};
use super::run::load;
use super::{Failure, How, Which};
use clap::Args;

/// Checks papers and specs.
#[derive(Args)]
pub struct Check {
    /// Papers or folders to check; every paper if none is given
    #[arg(value_name = "PAPER")]
    specs: Vec<String>,
}

impl Check {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let specs = if self.specs.is_empty() { papers() } else { self.specs };
        if specs.is_empty() {
            return Err(Failure::input(
                "there is no paper here to check; run replan from the project's own folder",
            ));
        }
        for spec in specs {
            let which = Which { paper: folder_of(&spec), out: None };
            let how = How { quick: false, seed: None, readings: None, threads: None };
            let paper = load(&Places::find(&which, "")?, &how)?;
            println!(
                "{}: {} studies, {} claims, {} ledger rows are in order",
                paper.id,
                paper.studies.len(),
                paper.claims.len(),
                paper.ledger.len()
            );
        }
        Ok(())
    }
}

/// A study's file stands for its paper: claims and studies are only right together.
fn folder_of(spec: &str) -> String {
    let path = std::path::Path::new(spec);
    match path.parent() {
        Some(folder) if path.extension().is_some_and(|e| e == "toml") && path.is_file() => {
            let folder = if folder.as_os_str().is_empty() { std::path::Path::new(".") } else { folder };
            folder.display().to_string()
        }
        _ => spec.to_owned(),
    }
}
