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

/// Audits a printed table.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub struct Audit {
    /// What `replan audit --help` lists
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

impl Audit {
    /// Becomes the program, which so has the signals, the streams and the exit code.
    pub fn run(self) -> Result<(), Failure> {
        let own = std::env::current_exe()?;
        let beside = Some(own.with_file_name(PROGRAM)).filter(|path| path.is_file());
        let program = beside.unwrap_or(PathBuf::from(PROGRAM));
        let error = Command::new(&program).args(self.arguments).env("REPLAN", own).exec();
        if error.kind() == ErrorKind::NotFound {
            return Err(Failure::tool(format!(
                "`{PROGRAM}` is neither beside this program nor on the PATH; `cargo build -p {PROGRAM}` builds it"
            )));
        }
        Err(Failure::new(1, format!("{}: {error}", program.display())))
    }
}
