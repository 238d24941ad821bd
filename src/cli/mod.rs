//! The command line: one subcommand a file.
//!
//! Exit codes:
//! - 0: done.
//! - 1: the system refused (disk, permissions, a busy folder).
//! - 2: wrong words on the command line or wrong input files.
//! - 3: a check failed. Something is not as stored, worse than a gate allows, judged otherwise or impossible, or an independent
//!   judge disagrees.
//! - 4: a tool is missing: Python, the network or an archive for `crosscheck`, `replan-audit`, `replan-export`, a planner from outside.
//! - 130: interrupted, and what was done is kept.
//!
//! A stored file that is edited, damaged, gone, or of a spec that has changed is the answer that a check gives: code 3 under
//! `--check` and `--rerun`. A command that needs it as its input ends with code 2, and so does a check where nothing was ever
//! stored.

/// Whether something could not be printed, as on a disk that is full.
static IS_LOST: AtomicBool = AtomicBool::new(false);

/// Remembers that something could not be printed; a reader that closed the pipe early (`head`) is no failure of ours.
fn print_failed(error: &io::Error) {
    if error.kind() != io::ErrorKind::BrokenPipe && !IS_LOST.swap(true, Ordering::Relaxed) {
        let _ = writeln!(io::stderr(), "replan: standard output: {error}");
    }
}

/// Prints a line.
macro_rules! say {
    ($($arguments:tt)*) => {{
        use std::io::Write as _;
        if let Err(error) = writeln!(std::io::stdout(), "{}", base::text::shown(&format!($($arguments)*))) {
            $crate::cli::print_failed(&error);
        }
    }};
}

mod beside;
mod check;
mod compare;
mod confirm;
mod conformance;
mod consent;
pub mod crosscheck;
mod explore;
mod explorer;
pub mod export;
mod findings;
mod import;
mod judge;
mod list;
mod load;
mod merge;
mod new;
mod one_shard;
mod pack;
mod places;
mod progress;
mod render;
mod report;
mod repro;
mod rounds;
mod run;
pub mod schema;
mod shard;
mod sharded;
mod show;
mod stamp;
mod status;
mod summary;
mod trial;
mod verdicts;
mod witness;

use base::settings::SettingsError;
use base::text::shell_word;
use clap::{Args, Parser, Subcommand};
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use study::StudyError;

/// `1 study`, `2 studies`.
fn counted(count: usize, [one, more]: [&str; 2]) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {more}") }
}

#[derive(Parser)]
#[command(version, about, after_help = EXAMPLES, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "Examples:
  replan repro zhang                     run the paper's studies, judge its claims, draw its figures
  replan repro zhang --quick             the same with few instances, below target/replan/
  replan new ./my/paper --from grid      a small paper to change into your own
  replan repro ./my/paper                a paper of your own: a folder with paper.toml and studies
  replan repro zhang --trial witness/w1/a-star
  replan report zhang --open             the paper's report as a page, with replays
  replan show zhang t1.improved.cost     one claim with its evidence
  replan render zhang --check            do the committed plots and tables match the stored run?
  replan list planners                   what contenders can name
  replan list criteria one_instance      the settings of one criterion, with an example";

#[derive(Subcommand)]
enum Command {
    /// Write a small paper that runs, as a start for your own
    New(new::New),
    /// Run every study of a paper, judge its claims, draw its figures and write its report
    Repro(repro::Repro),
    /// Check papers and specs without running anything
    Check(check::Check),
    /// Run the studies of a paper that are stale; reuse other stored trials
    Run(run::Run),
    /// Merge the shards of a run, an exploration or a confirmation
    Merge(merge::Merge),
    /// Show the progress of a sharded run: done, running, stopped, left
    Status(status::Status),
    /// Split a run into jobs for a cluster: Slurm, GNU parallel or Python
    Shard(shard::Shard),
    /// Judge a paper's claims under every interpretation that has a source
    Explore(explore::Explore),
    /// Judge a paper's claims on a second seed
    Confirm(confirm::Confirm),
    /// Judge a paper's claims again from its stored run
    Judge(judge::Judge),
    /// Draw a paper's figures and tables again from its stored run and verdicts
    Render(render::Render),
    /// Write a paper's report as one HTML page: claims, evidence, figures, replays
    Report(report::Report),
    /// Compare two stored runs, or two contenders of one, with intervals and gates
    Compare(compare::Compare),
    /// Write stored trials and their statistics for other programs
    Export(export::Export),
    /// Write a folder for reviewers: specs, records, verdicts, tables, page and hashes
    Pack(pack::Pack),
    /// Turn results that were recorded elsewhere into records of a study
    Import(import::Import),
    /// Show one claim with its evidence, search claims by words, or list them all
    Show(show::Show),
    /// Search for a map on which several claims hold together
    Witness(witness::Witness),
    /// Test whether your own planner follows the protocol
    Conformance(conformance::Conformance),
    /// Let MuJoCo check robots, scenes and stored paths; needs Python
    Crosscheck(crosscheck::Crosscheck),
    /// Check by arithmetic whether a printed table is possible
    Audit(beside::Audit),
    /// Write a JSON Schema of every kind of TOML file, for editors
    Schema(schema::Schema),
    /// List papers, studies, planners, criteria, metrics, figures, choices and more
    List(list::List),
}

/// What to run: shared by the subcommands that read a paper.
#[derive(Args, Clone)]
struct Which {
    /// A paper's name, or a folder that holds a paper.toml
    paper: String,
    /// Write below this folder instead of the committed places
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// How to run.
#[derive(Args, Clone)]
struct How {
    /// Few instances; every output is marked as quick
    #[arg(long)]
    quick: bool,
    /// Root of all seeds; the seeds of the studies if absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    seed: Option<u64>,
    /// Options of choices, as in `corner_cutting=forbid_any,ties=lifo`; `all` runs every other option in turn
    #[arg(long, value_name = "OPTIONS")]
    with: Option<String>,
    /// Threads for the trials; all cores if absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,
}

impl Which {
    /// The command `name` on the same paper, as it is typed.
    fn command(&self, name: &str) -> String {
        let out = self.out.as_ref().map(|out| format!(" --out {}", shell_word(&out.to_string_lossy())));
        format!("replan {name} {}{}", shell_word(&self.paper), out.unwrap_or_default())
    }
}

impl How {
    /// As the specs say.
    fn plain(threads: Option<u32>) -> Self {
        Self { quick: false, seed: None, with: None, threads }
    }
}

/// What of the stored trials runs again although nothing it depends on has changed.
#[derive(Args, Clone, Copy, Default)]
struct Again {
    /// Run all trials again, except those of external planners
    #[arg(long)]
    fresh: bool,
    /// Run the trials of external planners again, which `--fresh` keeps
    #[arg(long)]
    record: bool,
    /// Set damaged files of the stored run aside, and run again what they held; what is sound is kept
    #[arg(long)]
    replace_damaged: bool,
}

impl From<Again> for study::session::Again {
    fn from(Again { fresh, record, replace_damaged }: Again) -> Self {
        Self { fresh, record, replaces_damaged: replace_damaged }
    }
}

/// Why a command ended without success.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    message: String,
    /// Something that is stored is not what would be written now.
    is_touched: bool,
}

impl Failure {
    /// Wrong words on the command line, or wrong input files.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(2, message)
    }

    /// Prints it as the command called `program` does, and gives its exit code.
    pub fn end(&self, program: &str) -> ExitCode {
        // A reader that closed the pipe early (head) is no failure of ours, and gets no message.
        let _ = writeln!(io::stderr(), "{program}: {}", base::text::shown(&self.message));
        ExitCode::from(self.code)
    }

    /// Something stored that is not what would be written now, and is needed.
    fn touched(message: impl Into<String>) -> Self {
        Self { is_touched: true, ..Self::new(2, message) }
    }

    fn stale(message: impl Into<String>) -> Self {
        Self::new(3, message)
    }

    fn tool(message: impl Into<String>) -> Self {
        Self::new(4, message)
    }

    fn new(code: u8, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), is_touched: false }
    }

    /// The same as what a check says: that something is not as stored is its answer, and no wrong input.
    fn in_check(self) -> Self {
        Self { code: if self.is_touched { 3 } else { self.code }, ..self }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        let code = match &error {
            StudyError::Interrupted { .. } => 130,
            StudyError::Io { .. } | StudyError::Busy { .. } => 1,
            StudyError::Lacks { .. } | StudyError::LacksFiles { .. } => 4,
            _ => 2,
        };
        Self { is_touched: matches!(error, StudyError::Touched(_)), ..Self::new(code, error.to_string()) }
    }
}

impl From<SettingsError> for Failure {
    fn from(error: SettingsError) -> Self {
        Self::input(error.to_string())
    }
}

impl From<crate::render::RenderError> for Failure {
    fn from(error: crate::render::RenderError) -> Self {
        let code = if matches!(error, crate::render::RenderError::Interrupted) { 130 } else { 2 };
        Self::new(code, error.to_string())
    }
}

impl From<crate::page::PageError> for Failure {
    fn from(error: crate::page::PageError) -> Self {
        match error {
            crate::page::PageError::Render(error) => error.into(),
            crate::page::PageError::Study(error) => error.into(),
            other => Self::new(1, other.to_string()),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::new(1, error.to_string())
    }
}

/// Success if all of `results` are; otherwise the one failure, or every failure printed and the worst code with `what`.
fn all(results: Vec<Result<(), Failure>>, what: &str) -> Result<(), Failure> {
    let count = results.len();
    let mut failures: Vec<Failure> = results.into_iter().filter_map(Result::err).collect();
    if count == 1 || failures.is_empty() {
        return failures.pop().map_or(Ok(()), Err);
    }
    for failure in &failures {
        let _ = writeln!(io::stderr(), "replan: {}", base::text::shown(&failure.message));
    }
    let code = if failures.iter().any(|failure| failure.code == 2) { 2 } else { failures[0].code };
    Err(Failure::new(code, format!("{} of {count} {what}", failures.len())))
}

/// Runs the command that the process was called with.
pub fn run() -> ExitCode {
    if let Some(code) = external::launcher() {
        return code;
    }
    if let Some(message) = renamed(std::env::args().skip(1)) {
        let _ = writeln!(io::stderr(), "replan: {message}");
        return ExitCode::from(2);
    }
    let done = match Cli::parse().command {
        Command::New(command) => command.run(),
        Command::Repro(command) => command.run(),
        Command::Check(command) => command.run(),
        Command::Run(command) => command.run(),
        Command::Merge(command) => command.run(),
        Command::Status(command) => command.run(),
        Command::Shard(command) => command.run(),
        Command::Explore(command) => command.run(),
        Command::Confirm(command) => command.run(),
        Command::Judge(command) => command.run(),
        Command::Render(command) => command.run(),
        Command::Report(command) => command.run(),
        Command::Compare(command) => command.run(),
        Command::Export(command) => command.run(),
        Command::Import(command) => command.run(),
        Command::Pack(command) => command.run(),
        Command::Show(command) => command.run(),
        Command::Witness(command) => command.run(),
        Command::Conformance(command) => command.run(),
        Command::Crosscheck(command) => command.run(),
        Command::Audit(_) => beside::become_program("replan-audit"),
        Command::List(command) => command.run(),
        Command::Schema(command) => command.run(),
    };
    match done {
        Ok(()) if IS_LOST.load(Ordering::Relaxed) => ExitCode::from(1),
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.end("replan"),
    }
}

/// That `words` have a word that was renamed, if they do.
fn renamed(words: impl Iterator<Item = String>) -> Option<String> {
    let words: Vec<String> =
        words.map(|word| word.split('=').next().unwrap_or_default().to_owned()).collect();
    let is_typed = |old: &str| {
        let old: Vec<&str> = old.split(' ').collect();
        words.windows(old.len()).any(|typed| typed == old)
    };
    let (old, new) = base::settings::renamed("command_line").iter().find(|(old, _)| is_typed(old))?;
    Some(format!("`{old}` is now `{new}`"))
}

/// The command line as it would be typed for the same results: what only talks, and the trust that people give, is left out.
fn command_line() -> String {
    let words = std::env::args().skip(1).filter(|word| word != "--why" && word != "--trust");
    base::text::command(&words.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    /// The words of a command line, with what stands in quotation marks as one.
    fn words(line: &str) -> Vec<String> {
        let pieces = line.split('\'').enumerate();
        let words = pieces.map(|(at, piece)| {
            let words: Vec<&str> = if at % 2 == 1 { vec![piece] } else { piece.split_whitespace().collect() };
            words.into_iter().map(str::to_owned).collect::<Vec<_>>()
        });
        words.collect::<Vec<_>>().concat()
    }

    #[test]
    fn every_help_has_examples_that_can_be_typed_within_the_terminal() {
        let program = Cli::command();
        let own = program.get_subcommands().filter(|command| command.get_name() != "audit");
        let mut typed = 0;
        for command in own.chain([&program]) {
            let name = command.get_name();
            let text = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let lines: Vec<&str> = text.strip_prefix("Examples:\n").unwrap_or_default().lines().collect();
            assert!(!lines.is_empty(), "{name} --help has no examples");
            let is_own = |line: &&str| line.contains(&format!("replan {name} ")) || name == "replan";
            assert!(lines.iter().any(is_own), "no example of {name} has {name}: {text}");
            for line in lines {
                assert!(line.chars().count() <= 100, "{name}: too wide: {line}");
                let example = line.trim().split("  ").next().unwrap_or_default();
                let parsed = Cli::try_parse_from(words(example));
                assert!(
                    parsed.is_ok(),
                    "{name}: {example}: {}",
                    parsed.err().map(|e| e.to_string()).unwrap()
                );
                typed += 1;
            }
        }
        assert!(typed > 40, "{typed} examples");
    }
}
