//! A running planner: its program, its pipes, and the limits that hold for it.

use super::end::{end_all, name_survivors};
use super::interrupt::{self, MARK, guard};
use super::launch::launch;
use super::linux::close_control_group;
use super::message::{FromPlanner, Hello, Limits, Object, ToPlanner};
use base::settings::did_you_mean;
use base::text::{around, brief, one_line};
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, ErrorKind, PipeReader, Read, Write};
use std::os::unix::process::CommandExt as _;
use std::process::{Child, ChildStderr, ChildStdin, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Reads a clock: nanoseconds since some moment.
pub type Clock = fn() -> u64;

/// How much of a planner's log is kept.
const LOG_BYTES: usize = 2000;
/// Lines that wait to be read; a planner that writes more waits.
const WAITING_LINES: usize = 64;
/// How often it is looked whether a planner that says nothing has ended.
const LOOK: Duration = Duration::from_millis(50);
/// How long a planner may take to end after `quit`.
const QUIT: Duration = Duration::from_millis(500);

/// The variables of the environment that a planner gets.
pub const PASSED: [&str; 14] = [
    "PATH",
    "HOME",
    "USER",
    "LANG",
    "LC_ALL",
    "LC_CTYPE",
    "TZ",
    "TMPDIR",
    "LD_LIBRARY_PATH",
    "PYTHONPATH",
    "VIRTUAL_ENV",
    "JAVA_HOME",
    "OMP_NUM_THREADS",
    "SHELL",
];

/// How long a line is waited for that was written before there was a query.
const EARLY: Duration = Duration::from_millis(1);

/// A program that plans.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// The program and its arguments.
    pub command: Vec<String>,
    /// Limits on each query.
    pub limits: Limits,
    /// How long it may take to say `hello`, in seconds.
    pub hello_s: f64,
}

/// Why a program did not start.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Start {
    /// There is no such program.
    #[error("there is no program `{0}`")]
    Missing(String),
    /// The system refused.
    #[error("`{0}` does not start: {1}")]
    Refused(String, String),
}

/// What came from a planner.
#[derive(Debug)]
pub(super) enum PlannerOutput {
    /// A line that is not empty.
    Line(Vec<u8>),
    /// More than it may write for one query.
    Flood,
    /// Its output ended.
    End,
}

/// A planner that runs; ended, with all that it started, when it is dropped.
pub struct Process {
    child: Child,
    mark: String,
    to: Option<Sender<String>>,
    from: Receiver<PlannerOutput>,
    written: Arc<AtomicU64>,
    log: Arc<Mutex<VecDeque<u8>>>,
    /// Reads the log until nothing can write to it any more.
    logging: JoinHandle<()>,
    /// Its greeting, once it has.
    pub hello: Option<Hello>,
}

impl Process {
    /// Starts `program` under its limits, in a process group of its own.
    ///
    /// # Errors
    /// [`Start::Missing`] if there is no such program, [`Start::Refused`] if it cannot be run.
    pub fn start(program: &Program) -> Result<Self, Start> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let mark = format!("{}.{}", std::process::id(), NUMBER.fetch_add(1, Ordering::Relaxed));
        let Some((name, arguments)) = program.command.split_first() else {
            return Err(Start::Missing(String::new()));
        };
        guard();
        // It counts as at work before it starts: nobody takes it for another planner's orphan.
        interrupt::note(&mark, None);
        let memory_bytes = program.limits.memory_mb << 20;
        let started = launch(name, arguments, &mark, memory_bytes, |command| {
            let passed = PASSED.iter().filter_map(|name| Some((name, std::env::var_os(name)?)));
            command.env_clear().envs(passed).env(MARK, &mark).process_group(0);
            command.stdin(Stdio::piped()).stderr(Stdio::piped());
        });
        let (mut child, stdout) = started.map_err(|error| {
            interrupt::forget(&mark);
            match error.kind() {
                ErrorKind::NotFound => Start::Missing(name.clone()),
                _ => Start::Refused(name.clone(), error.to_string()),
            }
        })?;
        interrupt::note(&mark, Some(child.id() as i32));
        let stdin = child.stdin.take();
        let stderr = child.stderr.take();
        let (to, lines) = channel();
        let (sender, from) = sync_channel(WAITING_LINES);
        let written = Arc::new(AtomicU64::new(0));
        let log = Arc::default();
        let count = written.clone();
        let tail = Arc::clone(&log);
        let most = program.limits.output_mb << 20;
        let piped = "its pipes were requested";
        thread::spawn(move || write_lines(stdin.expect(piped), &lines));
        thread::spawn(move || read_lines(stdout, &sender, &count, most));
        let logging = thread::spawn(move || read_log(stderr.expect(piped), &tail));
        Ok(Self { child, mark, to: Some(to), from, written, log, logging, hello: None })
    }

    /// Hands a message over; a planner that does not read it keeps nobody waiting.
    pub(super) fn send(&self, message: &ToPlanner) {
        let line = serde_json::to_string(message).expect("messages are numbers, words and lists of them");
        if let Some(to) = &self.to {
            // A planner that is gone is noticed by the end of its output.
            let _ = to.send(line);
        }
    }

    /// From now on its output counts from 0.
    ///
    /// # Errors
    /// A sentence: it has written something already that nobody requested.
    pub(super) fn begin(&mut self) -> Result<(), String> {
        if let Ok(PlannerOutput::Line(line)) = self.from.recv_timeout(EARLY) {
            return Err(format!(
                "the planner wrote `{}` before it had a query",
                around(&String::from_utf8_lossy(&line), 0)
            ));
        }
        self.written.store(0, Ordering::Relaxed);
        Ok(())
    }

    /// The next message; none if there is none in time.
    ///
    /// # Errors
    /// A sentence: it wrote too much, ended, or wrote something that is no message.
    pub(super) fn next(&mut self, within: Duration) -> Result<Option<FromPlanner>, String> {
        let line = match self.next_output(within) {
            Ok(PlannerOutput::Line(line)) => line,
            Ok(PlannerOutput::Flood) => {
                return Err("the planner wrote more than its limit of output".to_owned());
            }
            Ok(PlannerOutput::End) | Err(RecvTimeoutError::Disconnected) => {
                return Err("the planner ended before its result".to_owned());
            }
            Err(RecvTimeoutError::Timeout) => return Ok(None),
        };
        read_message(&line).map(Some)
    }

    /// Whether it has written nothing since its output counts from 0.
    pub(super) fn is_silent(&self) -> bool {
        self.written.load(Ordering::Relaxed) == 0
    }

    /// What comes next from the planner. One that has ended may have left others who hold its output open.
    fn next_output(&mut self, within: Duration) -> Result<PlannerOutput, RecvTimeoutError> {
        let mut left = within;
        loop {
            let slice = left.min(LOOK);
            let has_ended = matches!(self.child.try_wait(), Ok(Some(_)));
            match self.from.recv_timeout(slice) {
                Err(RecvTimeoutError::Timeout) if has_ended => return Ok(PlannerOutput::End),
                Err(RecvTimeoutError::Timeout) if left > slice => left -= slice,
                other => return other,
            }
        }
    }

    /// The end of its log.
    pub fn log(&self) -> String {
        let log = self.log.lock().expect("no thread panics while it keeps the log");
        let (a, b) = log.as_slices();
        one_line(String::from_utf8_lossy(&[a, b].concat()).trim())
    }

    /// How it ended, once it has and its log has arrived; a child of its own may keep the log open, which is not waited for.
    pub(super) fn ended(&mut self) -> Option<String> {
        let mut status = None;
        for _ in 0..40 {
            status = status.or_else(|| self.child.try_wait().ok().flatten());
            if status.is_some() && self.logging.is_finished() {
                break;
            }
            thread::sleep(Duration::from_millis(5));
        }
        status.map(|status| status.to_string())
    }

    /// Ends it as a planner expects: `quit`, a moment, then SIGTERM and SIGKILL to all that is left. Whether it ended by itself.
    pub fn quit(mut self) -> bool {
        self.send(&ToPlanner::Quit);
        self.to = None;
        let step = Duration::from_millis(5);
        for _ in 0..QUIT.as_millis() / step.as_millis() {
            if matches!(self.child.try_wait(), Ok(Some(_)) | Err(_)) {
                return true;
            }
            thread::sleep(step);
        }
        false
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        name_survivors(&end_all(&mut self.child, &self.mark));
        close_control_group(&self.mark);
        interrupt::forget(&self.mark);
    }
}

/// The message in a line that a planner wrote, without a byte-order mark before it.
///
/// # Errors
/// A sentence: what is wrong and where.
pub fn read_message(line: &[u8]) -> Result<FromPlanner, String> {
    let line = line.strip_prefix("\u{feff}".as_bytes()).unwrap_or(line).trim_ascii();
    let text = std::str::from_utf8(line).map_err(|error| {
        let at = error.valid_up_to();
        let shown = String::from_utf8_lossy(line);
        let column = shown.char_indices().take_while(|(begin, _)| *begin < at).count();
        format!(
            "the planner wrote `{}`, which is no message: byte {} is not UTF-8",
            around(&shown, column),
            at + 1
        )
    })?;
    let Object(message) = serde_json::from_str(text).map_err(|error| no_message(text, &error))?;
    if let FromPlanner::Result(found) = &message
        && let Some(name) = found.counters.misfit()
    {
        let written = counter(text, name);
        let accepted = "a whole number of 0 or more and below 2^53 is accepted";
        return Err(format!("the planner counts {} `{name}`; {accepted}", brief(written)));
    }
    Ok(message)
}

/// The counter called `name` as the planner wrote it: to the last digit.
fn counter<'a>(line: &'a str, name: &str) -> &'a str {
    let (_, after) = line.rsplit_once(&format!("\"{name}\"")).unwrap_or_default();
    let number = after.trim_start().trim_start_matches(':').trim_start();
    number.split([',', '}', ' ', '\t']).next().unwrap_or_default()
}

/// What is wrong with a line, shown around its place; numbers that other languages write and JSON has none of by name.
fn no_message(line: &str, error: &serde_json::Error) -> String {
    let column = error.column().saturating_sub(1);
    let at: String = line.chars().skip(column.saturating_sub(1)).take(10).collect();
    let number =
        ["NaN", "-Infinity", "Infinity", "-nan", "nan", "-inf", "inf"].into_iter().find(|n| at.contains(n));
    let why = match number {
        Some(number) => format!("JSON has no number `{number}`, at column {}", column + 1),
        // The library repeats names as long as they are.
        None => around(&in_words(&error.to_string()), 0),
    };
    format!("the planner wrote `{}`, which is no message: {why}", around(line, column))
}

/// A message of the JSON library, with words for Rust's types of numbers and the name that one may be meant for that is unknown.
fn in_words(message: &str) -> String {
    let whole = "expected a whole number of 0 or more";
    let mut names = message.split('`').skip(1).step_by(2);
    let unknown = names.next().filter(|_| message.starts_with("unknown "));
    let hint = unknown.map_or_else(String::new, |name| did_you_mean(name, names));
    message
        .replacen("`, expected", &format!("`{hint}, expected"), 1)
        .replace("expected u64", whole)
        .replace("expected u32", whole)
        .replace("expected f64", "expected a number")
}

fn write_lines(mut stdin: ChildStdin, lines: &Receiver<String>) {
    for line in lines {
        if stdin.write_all(line.as_bytes()).and_then(|()| stdin.write_all(b"\n")).is_err() {
            return;
        }
    }
}

fn read_lines(stdout: PipeReader, sender: &SyncSender<PlannerOutput>, written: &AtomicU64, most: u64) {
    let mut reader = BufReader::new(stdout);
    let mut line = Vec::new();
    loop {
        let chunk = match reader.fill_buf() {
            Ok(chunk) if !chunk.is_empty() => chunk,
            _ => break,
        };
        // Empty lines are passed over together: a flood of them is as quick to refuse as any other.
        let empty = if line.is_empty() { chunk.iter().take_while(|byte| **byte == b'\n').count() } else { 0 };
        let end = empty.checked_sub(1).or_else(|| chunk.iter().position(|byte| *byte == b'\n'));
        let used = end.map_or(chunk.len(), |end| end + 1);
        line.extend_from_slice(&chunk[..used]);
        reader.consume(used);
        if written.fetch_add(used as u64, Ordering::Relaxed) + used as u64 > most {
            let _ = sender.send(PlannerOutput::Flood);
            return;
        }
        if end.is_some() {
            let whole = std::mem::take(&mut line);
            if !whole.trim_ascii().is_empty() && sender.send(PlannerOutput::Line(whole)).is_err() {
                return;
            }
        }
    }
    let _ = sender.send(PlannerOutput::End);
}

fn read_log(mut stderr: ChildStderr, log: &Mutex<VecDeque<u8>>) {
    let mut chunk = [0; 4096];
    while let Ok(count @ 1..) = stderr.read(&mut chunk) {
        let mut log = log.lock().expect("no thread panics while it keeps the log");
        log.extend(&chunk[..count]);
        let over = log.len().saturating_sub(LOG_BYTES);
        log.drain(..over);
    }
}
