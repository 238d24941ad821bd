//! A peer that is a Python package: a process that holds the question, tells its answers once, and then times itself.
//!
//! Rust writes one line of JSON, the question; the script writes one line of JSON, its answers, which the bench holds to its own.
//! Then every line from Rust is a number of rounds, and the script answers with the nanoseconds that they took it, by its own
//! clock, so that neither starting Python nor the pipe is counted.

use serde_json::Value;
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

/// A script at work.
pub struct Peer {
    child: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

/// The folder that builds go to.
fn target() -> PathBuf {
    let named = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    named.unwrap_or_else(|| root().join("target"))
}

/// The project's folder, from whichever package a bench belongs to.
fn root() -> &'static Path {
    let inside = Path::new(env!("CARGO_MANIFEST_DIR"));
    inside.ancestors().find(|folder| folder.join("benches/peer").is_dir()).expect("a bench of the project")
}

impl Peer {
    /// Start `script` of this folder under the environment `venv` with `inputs`, all but the script below `target/replan`, and
    /// ask it `question`; its answers. None, and a line that tells `hint`, if something of that is not there.
    pub fn start(
        [venv, script, hint]: [&str; 3],
        inputs: &[&str],
        question: &Value,
    ) -> Option<(Self, Value)> {
        let made = target().join("replan");
        let python = made.join(venv).join("bin/python");
        let inputs: Vec<PathBuf> = inputs.iter().map(|input| made.join(input)).collect();
        if let Some(lacks) = std::iter::once(&python).chain(&inputs).find(|path| !path.exists()) {
            println!("skipped: {script} needs {}; {hint}", lacks.display());
            return None;
        }
        let mut child = Command::new(python)
            .arg(root().join("benches/peer").join(script))
            .args(inputs)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("Python starts");
        let questions = child.stdin.take().expect("its input is ours");
        let answers = BufReader::new(child.stdout.take().expect("its output is ours"));
        let mut peer = Self { child, questions, answers };
        let answer = peer.ask(&question.to_string());
        Some((peer, serde_json::from_str(&answer).expect("answers in JSON")))
    }

    fn ask(&mut self, question: &str) -> String {
        writeln!(self.questions, "{question}").expect("it reads");
        let mut line = String::new();
        self.answers.read_line(&mut line).expect("it writes");
        line
    }

    /// How long `rounds` took it.
    pub fn time(&mut self, rounds: u64) -> Duration {
        Duration::from_nanos(self.ask(&rounds.to_string()).trim().parse().expect("nanoseconds"))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // It may have gone already, and there is nothing left to ask it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
