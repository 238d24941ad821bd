//! `replan audit`: runs the program `replan-audit`, as cargo runs `cargo-x`.

use super::Failure;
use clap::Args;
use std::ffi::OsString;
use std::io::ErrorKind;
use std::os::unix::process::CommandExt as _;
use std::path::PathBuf;
use std::process::Command;

/// Where it is looked for: beside this program, then on the PATH.
const PROGRAM: &str = "replan-audit";

/// What the program takes.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub struct Audit {
    /// What `replan audit --help` lists
    #[arg(value_name = "ARGUMENTS", trailing_var_arg = true, allow_hyphen_values = true)]
    _parsed: Vec<OsString>,
}

/// Becomes the program, which so has the signals, the streams and the exit code.
pub fn run() -> Result<(), Failure> {
    let own = std::env::current_exe()?;
    let beside = Some(own.with_file_name(PROGRAM)).filter(|path| path.is_file());
    let program = beside.unwrap_or(PathBuf::from(PROGRAM));
    // As they were written: what is parsed lacks a leading `--`.
    let arguments = std::env::args_os().skip(2);
    let error = Command::new(&program).args(arguments).env("REPLAN", own).exec();
    if error.kind() == ErrorKind::NotFound {
        return Err(Failure::tool(format!(
            "`{PROGRAM}` is neither beside this program nor on the PATH; `cargo build -p {PROGRAM}` builds it"
        )));
    }
    Err(Failure::new(1, format!("{}: {error}", program.display())))
}
