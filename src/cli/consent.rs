//! Consent for unusually large work, and for programs that papers from elsewhere start.
//!
//! A paper of the repository that replan was built from is trusted. Any other paper that names planners from outside
//! needs `--trust`. The user's folder of states remembers it by the paper's folder and a hash: of what the paper says
//! of each planner, and of the files that it names. So a program that changes needs `--trust` again.

use super::Failure;
use super::places::Places;
use crate::analysis::tabulated::texts_in;
use base::hash::sha256;
use base::text::{around, one_line};
use clap::Args;
use engine::planner::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use study::{Study, planner};
use toml::Table;

/// The most commands that are listed.
const MOST_LISTED: usize = 10;

/// What people allow.
#[derive(Args, Clone, Copy)]
pub struct Consent {
    #[command(flatten)]
    large: AllowLarge,
    /// Let a paper from elsewhere start the programs that it names; remembered until they change
    #[arg(long)]
    trust: bool,
}

/// Whether studies may be large.
#[derive(Args, Clone, Copy)]
pub struct AllowLarge {
    /// Accept studies that ask for more than 10⁶ trials, 1 GB a thread or a day of one core
    #[arg(long)]
    allow_large: bool,
}

impl AllowLarge {
    /// Refuses the first of `studies` that is unusually large.
    ///
    /// # Errors
    /// What it asks for, at its file.
    pub fn check<'s>(
        self,
        studies: impl IntoIterator<Item = &'s Study>,
        places: &Places,
    ) -> Result<(), Failure> {
        for study in studies.into_iter().filter(|_| !self.allow_large) {
            if let Some(excess) = study.work(&places.inputs)?.excess() {
                return Err(Failure::input(format!(
                    "{}: the study {excess}; `--allow-large` accepts that",
                    study.document.path().display()
                )));
            }
        }
        Ok(())
    }
}

impl Consent {
    /// Whether studies may be large.
    pub fn is_large_allowed(self) -> bool {
        self.large.allow_large
    }

    /// Refuses `studies` that are large, and those of a paper from elsewhere that name programs, unless people allow them.
    ///
    /// # Errors
    /// What the studies ask for, or the commands, and how to allow them.
    pub fn check<'s>(
        self,
        studies: impl IntoIterator<Item = &'s Study> + Clone,
        places: &Places,
    ) -> Result<(), Failure> {
        self.large.check(studies.clone(), places)?;
        let programs: Vec<Table> = studies.into_iter().flat_map(programs).collect();
        if programs.is_empty() || is_of_repository(&places.folder) {
            return Ok(());
        }
        let folder = fs::canonicalize(&places.folder)?;
        let line = |program: &Table| one_line(&format!("{} {}", hash(program), folder.display()));
        let memory = memory();
        let known = memory.as_ref().and_then(|file| fs::read_to_string(file).ok()).unwrap_or_default();
        let known: BTreeSet<&str> = known.lines().collect();
        let new: BTreeMap<String, &Table> = programs.iter().map(|program| (line(program), program)).collect();
        let new: Vec<(&String, &&Table)> =
            new.iter().filter(|(line, _)| !known.contains(line.as_str())).collect();
        match memory {
            _ if new.is_empty() => Ok(()),
            Some(file) if self.trust => remember(&file, new.iter().map(|(line, _)| line.as_str())),
            None if self.trust => Ok(()),
            _ => Err(refused(&places.folder, new.iter().map(|(_, program)| **program))),
        }
    }
}

/// That the programs of the paper in `folder` are not trusted.
fn refused<'p>(folder: &Path, programs: impl Iterator<Item = &'p Table>) -> Failure {
    let commands: BTreeSet<String> = programs.map(command).collect();
    let listed = commands.iter().take(MOST_LISTED).map(|command| format!("\n  {}", around(command, 0)));
    let more = commands.len().saturating_sub(MOST_LISTED);
    let more = if more == 0 { String::new() } else { format!("\n  and {more} more") };
    Failure::input(format!(
        "{}: the paper is from elsewhere and starts programs with your rights:{}{more}\nRead them; `--trust` accepts them until they \
         change",
        folder.display(),
        listed.collect::<String>()
    ))
}

/// Whether `folder` is that of a paper of the repository that this program was built from.
fn is_of_repository(folder: &Path) -> bool {
    let own = fs::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments"));
    matches!((own, fs::canonicalize(folder)), (Ok(own), Ok(folder)) if folder.starts_with(&own))
}

/// What a study says of planners from outside: in contenders, in options of choices and in sweeps.
pub(super) fn programs(study: &Study) -> Vec<Table> {
    // Trials that were imported start nothing.
    let is_started =
        |entry: &&Entry| planner::is_recorded(entry) && entry.name != planner::recorded::ENTRY.name;
    let is_outside = |entry: &str| planner::find(entry).as_ref().is_some_and(is_started);
    let stages = study.contenders.iter().flat_map(|own| &own.stages);
    let own = stages.filter(|stage| is_outside(stage.entry.name)).map(|stage| stage.settings.table().clone());
    let sweeps = study.sweeps.iter().filter(|sweep| sweep.entry().is_some_and(is_outside));
    let swept = sweeps.map(|sweep| Table::from_iter([(sweep.key.clone(), sweep.values.clone().into())]));
    let options = study.choices.iter().flat_map(|choice| choice.options.values());
    let laid = options.flat_map(|option| option.stage.iter().chain(option.contender.values().flatten()));
    let laid = laid.filter(|(entry, _)| is_outside(entry)).map(|(_, over)| over.clone());
    own.chain(swept).chain(laid).collect()
}

/// The hash of the description of a program, and of every file that is named there.
fn hash(program: &Table) -> String {
    let mut text = program.to_string();
    for name in program.values().flat_map(texts_in) {
        if let Ok(bytes) = base::file::read(Path::new(name)) {
            text += &format!("\n{name} {}", sha256(&bytes));
        }
    }
    sha256(text.as_bytes())
}

/// The command in `program` as people read it; what is laid over one, as it is written.
fn command(program: &Table) -> String {
    one_line(
        &program.get("command").map_or_else(|| program.to_string(), |command| texts_in(command).join(" ")),
    )
}

/// The file of what is trusted; none without a home.
fn memory() -> Option<PathBuf> {
    let folder = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let states = folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")))?;
    Some(states.join("replan/trusted"))
}

fn remember<'l>(file: &Path, lines: impl Iterator<Item = &'l str>) -> Result<(), Failure> {
    let text = lines.collect::<Vec<_>>().join("\n") + "\n";
    let add = || {
        fs::create_dir_all(file.parent().unwrap_or(Path::new("")))?;
        OpenOptions::new().create(true).append(true).open(file)?.write_all(text.as_bytes())
    };
    add().map_err(|error| Failure::new(1, format!("{}: {error}", file.display())))
}
