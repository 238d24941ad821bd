//! `replan new`: a small paper that runs, to be changed into one's own.
//!
//! The templates are the files below `new/`. Each opens with the `#:schema` line by which editors find the JSON Schema of its
//! kind; the schemas are written beside the paper, unless it lies in a project that has them.

use super::{Failure, schema};
use clap::{Args, ValueEnum};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes a new paper.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct New {
    /// The new folder; its name becomes the name of the paper
    folder: PathBuf,
    /// The subject of the paper
    #[arg(long)]
    from: Template,
}

const EXAMPLES: &str = "Examples:
  replan new ./my/paper --from grid
  replan repro ./my/paper             run it";

/// What a paper can begin as.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Template {
    /// Two searches on random grid maps
    Grid,
    /// A planar arm of two links, its tip on a lattice
    Arm,
    /// A six-axis arm among boxes, on roadmaps
    Cell,
}

/// Where the schemas of a paper outside a project are, below its folder.
const OWN_SCHEMAS: &str = ".schema";

/// Where those of a project are, seen from a paper's folder.
const PROJECT_SCHEMAS: &str = "../../docs/schema";

impl Template {
    /// Its files, each with its text.
    fn files(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Grid => &[
                ("paper.toml", include_str!("new/grid/paper.toml")),
                ("compare.toml", include_str!("new/grid/compare.toml")),
            ],
            Self::Arm => &[
                ("paper.toml", include_str!("new/arm/paper.toml")),
                ("lengths.toml", include_str!("new/arm/lengths.toml")),
            ],
            Self::Cell => &[
                ("paper.toml", include_str!("new/cell/paper.toml")),
                ("cell.toml", include_str!("new/cell/cell.toml")),
                ("poses.toml", include_str!("new/cell/poses.toml")),
                ("robot.toml", include_str!("../../data/robots/ur5.toml")),
                ("scene.toml", include_str!("new/cell/scene.toml")),
            ],
        }
    }
}

impl New {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let name = paper_name(&self.folder)?;
        if fs::read_dir(&self.folder).is_ok_and(|mut entries| entries.next().is_some()) {
            let message = format!("{} is not empty; a new folder is accepted", self.folder.display());
            return Err(Failure::input(message));
        }
        fs::create_dir_all(&self.folder)?;
        let is_in_project = self.folder.join(PROJECT_SCHEMAS).is_dir();
        let schemas = if is_in_project { PROJECT_SCHEMAS } else { OWN_SCHEMAS };
        for (file, text) in self.from.files() {
            let text = text.replace("SCHEMA/", &format!("{schemas}/"));
            let text = text.replace("paper = \"PAPER\"", &format!("paper = \"{name}\""));
            let path = self.folder.join(file);
            fs::write(&path, with_schema(&text, file, schemas))?;
            say!("{}", path.display());
        }
        if !is_in_project {
            schema::write_all(&self.folder.join(OWN_SCHEMAS))?;
        }
        // A bare name would be taken for a paper of the project.
        let is_bare = self.folder.components().count() == 1 && !self.folder.starts_with(".");
        let given = if is_bare { Path::new(".").join(&self.folder) } else { self.folder.clone() };
        let given = given.display();
        say!("`replan check {given}` checks it, `replan repro {given}` runs it and judges its claims");
        Ok(())
    }
}

/// A robot file is shipped without the line that the templates have.
fn with_schema(text: &str, file: &str, schemas: &str) -> String {
    if text.starts_with("#:schema") {
        return text.to_owned();
    }
    let kind = file.trim_end_matches(".toml");
    format!("#:schema {schemas}/{kind}.schema.json\n{text}")
}

/// The name of the paper in `folder`: it becomes a part of paths and of specs.
fn paper_name(folder: &Path) -> Result<String, Failure> {
    let name = folder.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(is_plain) {
        return Ok(name.to_owned());
    }
    Err(Failure::input(format!(
        "the folder's name `{name}` is the paper's; letters from a to z, digits, `_` and `-` are accepted"
    )))
}
