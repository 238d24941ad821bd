//! Programs of the project that replan hands over to, as cargo runs `cargo-x`: `replan audit` and `replan export --to`.

use super::Failure;
use clap::Args;
use std::ffi::OsString;
use std::io::ErrorKind;
use std::os::unix::process::CommandExt as _;
use std::path::PathBuf;
use std::process::Command;

/// What `replan-audit` takes.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub struct Audit {
    /// What `replan audit --help` lists
    #[arg(value_name = "ARGUMENTS", trailing_var_arg = true, allow_hyphen_values = true)]
    _parsed: Vec<OsString>,
}

/// Becomes `program`, which so has the signals, the streams and the exit code: the one beside this program, or the one on the PATH.
pub fn become_program(program: &str) -> Result<(), Failure> {
    let own = std::env::current_exe()?;
    let beside = Some(own.with_file_name(program)).filter(|path| path.is_file());
    let path = beside.unwrap_or(PathBuf::from(program));
    // As they were written: what is parsed lacks a leading `--`.
    let arguments = std::env::args_os().skip(2);
    let error = Command::new(&path).args(arguments).env("REPLAN", own).exec();
    if error.kind() == ErrorKind::NotFound {
        return Err(Failure::tool(format!(
            "`{program}` is neither beside this program nor on the PATH; `cargo build -p {program}` builds it"
        )));
    }
    Err(Failure::new(1, format!("{}: {error}", path.display())))
}
