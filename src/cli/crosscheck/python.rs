//! The Python side: an environment of its own, made once, and calls of the modules in `crosscheck/`.

use super::super::Failure;
use super::super::progress::note;
use base::hash::sha256;
use std::ffi::OsString;
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Output, Stdio};

/// The exit code that says that Python, the network or an archive is missing.
pub const MISSING: u8 = 4;
/// The exit code by which a judge says that something differs.
const DIFFERS: i32 = 3;
/// The modules, and what they need.
const MODULES: &str = "crosscheck";
const REQUIREMENTS: &str = "crosscheck/requirements.txt";
/// The least Python.
const LEAST: (u32, u32) = (3, 11);
/// What it is usually called.
const PROGRAMS: [&str; 2] = ["python3", "python3.11"];
/// The most lines of a program's complaint that are passed on.
const COMPLAINT_LINES: usize = 5;

/// A Python that can answer.
pub struct Judge {
    python: PathBuf,
}

fn missing(message: String) -> Failure {
    Failure::new(MISSING, message)
}

impl Judge {
    /// The environment below `folder`. If it is not there or its requirements changed, it is made, with `program` or,
    /// if none is given, with the first of the usual ones that is recent enough.
    ///
    /// # Errors
    /// Code 4 with what is missing and what to run.
    pub fn ready(program: Option<&str>, folder: &Path) -> Result<Self, Failure> {
        let venv = std::path::absolute(folder.join("venv"))?;
        let python = venv.join("bin/python");
        let stamp = venv.join("requirements.sha256");
        let wanted = fs::read(REQUIREMENTS).map_err(|e| {
            Failure::input(format!("{REQUIREMENTS}: {e}; run replan from the project's own folder"))
        })?;
        let wanted = sha256(&wanted);
        if python.is_file() && fs::read_to_string(&stamp).is_ok_and(|stamped| stamped == wanted) {
            return Ok(Self { python });
        }
        let program = usable(program)?;
        note(&format!("making a Python environment in {} (once)", venv.display()));
        fs::create_dir_all(folder)?;
        make(program, &venv, &python).map_err(|why| {
            missing(format!(
                "{program} cannot make a virtual environment: {why}\non Debian or Ubuntu run: apt install python3-venv"
            ))
        })?;
        let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", REQUIREMENTS];
        run(Command::new(&python).args(pip)).map_err(|why| {
            missing(format!(
                "the packages of {REQUIREMENTS} cannot be installed: {why}\nthis needs the network once; when it is \
                 there, run the same command again, or by hand: {} {}",
                python.display(),
                pip.join(" ")
            ))
        })?;
        fs::write(stamp, wanted)?;
        Ok(Self { python })
    }

    fn module(&self, name: &str) -> Command {
        let mut command = Command::new(&self.python);
        command.args(["-m", name]).env("PYTHONPATH", MODULES).env("PYTHONDONTWRITEBYTECODE", "1");
        command
    }

    /// Has the questions of a cross-check posed and answered on two processes; `step` is called after each case.
    ///
    /// # Errors
    /// Code 2 or 3 for what the judge refused.
    pub fn pose(&self, places: &[OsString], step: impl Fn()) -> Result<(), Failure> {
        let mut command = self.module("judge");
        command.arg("pose").args(places).args(["--jobs", "2"]);
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
        let lines = BufReader::new(child.stdout.take().expect("its output is a pipe")).lines();
        lines.map_while(Result::ok).for_each(|_| step());
        ended(child.wait()?)
    }

    /// Has the answers of a cross-check compared, and the chapter and the picture written.
    ///
    /// # Errors
    /// Code 3 if something differs, and what the judge refused.
    pub fn report(&self, places: &[OsString], plots: &Path, is_check: bool) -> Result<(), Failure> {
        let mut command = self.module("judge");
        command.arg("report").args(places).arg("--plots").arg(plots);
        command.args(is_check.then_some("--check"));
        ended(command.stdin(Stdio::null()).status()?)
    }

    /// Has the statistics that the file `request` names computed again, on two processes; says whether all agree.
    ///
    /// # Errors
    /// The judge ended otherwise than by saying so.
    pub fn recompute(&self, request: &Path) -> Result<bool, Failure> {
        let mut command = self.module("statistics_judge");
        let status = command.arg(request).args(["--jobs", "2"]).stdin(Stdio::null()).status()?;
        match status.code() {
            Some(0) => Ok(true),
            Some(DIFFERS) => Ok(false),
            _ => {
                let message = format!("the judge ended with {status}; its messages stand above");
                Err(Failure::new(1, message))
            }
        }
    }
}

/// What a judge that ended so means; what it complained of is on standard error.
fn ended(status: ExitStatus) -> Result<(), Failure> {
    match status.code() {
        Some(0) => Ok(()),
        Some(2) => Err(Failure::input("the cross-check cannot be posed; the reason stands above")),
        Some(DIFFERS) => Err(Failure::stale(
            "answers differ, controls went unnoticed or files are not current; they stand above",
        )),
        _ => Err(Failure::new(1, format!("the judge ended with {status}; the reason stands above"))),
    }
}

/// The program that was named, else the first of the usual names that is recent enough.
fn usable(named: Option<&str>) -> Result<&str, Failure> {
    if let Some(named) = named {
        return check_version(named).map(|()| named);
    }
    let found = PROGRAMS.into_iter().find(|program| check_version(program).is_ok());
    found.map_or_else(|| Err(check_version(PROGRAMS[0]).expect_err("none is usable")), Ok)
}

/// Makes the environment; where Python came without the part that puts pip into it (as Debian's does), the pip of
/// `program` does that.
fn make(program: &str, venv: &Path, python: &Path) -> Result<(), String> {
    let create = |options: &[&str]| {
        run(Command::new(program).args(["-m", "venv", "--clear"]).args(options).arg(venv)).map(drop)
    };
    let Err(why) = create(&[]) else { return Ok(()) };
    let pip = |()| {
        run(Command::new(program)
            .args(["-m", "pip", "--python"])
            .arg(python)
            .args(["install", "--quiet", "pip"]))
    };
    create(&["--without-pip"]).and_then(pip).map(drop).map_err(|_| why)
}

fn check_version(program: &str) -> Result<(), Failure> {
    let (major, minor) = LEAST;
    let wanted = format!(
        "Python {major}.{minor} or later is needed; install it (Debian or Ubuntu: apt install python3 python3-venv) or name one \
         with --python"
    );
    let output = run(Command::new(program).args(["-c", "import sys; print(*sys.version_info[:2])"]))
        .map_err(|why| missing(format!("`{program}` does not run: {why}\n{wanted}")))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut numbers = text.split_whitespace().map_while(|word| word.parse::<u32>().ok());
    let found = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    if found < LEAST {
        return Err(missing(format!("`{program}` is Python {}.{}\n{wanted}", found.0, found.1)));
    }
    Ok(())
}

/// Runs a program to its end; the last lines of its complaint if it fails.
fn run(command: &mut Command) -> Result<Output, String> {
    let output = command.stdin(Stdio::null()).output().map_err(|e| e.to_string())?;
    if output.status.success() {
        return Ok(output);
    }
    let both = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&both).trim().to_owned();
    let lines: Vec<&str> = text.lines().collect();
    Err(lines[lines.len().saturating_sub(COMPLAINT_LINES)..].join("\n"))
}
