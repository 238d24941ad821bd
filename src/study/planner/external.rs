//! A planner from outside: a program that speaks `docs/PLANNER_PROTOCOL.md`.
//!
//! A process is kept for the next query if its planner can be seeded with every query and did nothing wrong; each thread has
//! one of its own. Whatever a planner does is the outcome of one trial. Its trials are recorded and not repeated: they depend
//! on a clock and on a program of others.

use crate::clock;
use base::file::missing;
use base::settings::{Accepted, Settings, SettingsError};
use base::text::listed;
use engine::planner::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request, Trace, Value};
use engine::space::WorldKind;
use external::message::{Limits, Seeding};
use external::{End, Process, Program, Query, Space, Talk, describe, greet, solve};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "external",
    about: "a program that speaks the planner protocol, docs/PLANNER_PROTOCOL.md",
    revision: 1,
    needs: WorldKind::Any,
    columns: &[
        "question_batches",
        "questions_valid",
        "questions_motion",
        "questions_fk",
        "questions_ik",
        "incumbents",
        "is_cut_off",
        "promises_determinism",
        "solve_wall_ns",
        "answer_wall_ns",
        "own_wall_ns",
        "expansions",
        "iterations",
        "samples",
    ],
    settings: Accepted::shape::<Written>(),
    example: r#"
command = ["python3", "planners/python/examples/grid_astar.py"]
files = [
    "planners/python/examples/grid_astar.py",
    "planners/python/replan_planner/__init__.py",
]
version = "1"
time_s = 2.0
memory_mb = 1024
output_mb = 16
install = "Python 3.10 or later"
"#,
    build: Build::Planner(|settings| Ok(Box::new(External::new(settings)?))),
};

/// How long a planner may take to say `hello`, in seconds.
const HELLO_S: f64 = 10.0;

/// A seed that every language can read from JSON is below 2⁵³.
const SEED_BITS: u32 = 53;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Written {
    /// The program and its arguments; paths start from the folder that replan runs in.
    #[schemars(length(min = 1))]
    command: Vec<String>,
    /// Its files, which trials depend on; paths as in `command`.
    files: Vec<String>,
    /// The version that it says it is: another one is refused.
    version: String,
    /// From a query to its result, by replan's clock.
    #[schemars(range(max = 3600), extend("exclusiveMinimum" = 0))]
    time_s: f64,
    /// Address space of each of its processes.
    #[schemars(range(min = 16, max = 1_000_000))]
    memory_mb: u32,
    /// What it may write for one query.
    #[schemars(range(min = 1, max = 1000))]
    output_mb: u32,
    /// On a grid, whether steps may go at any angle; a step to one of the eight neighbours otherwise.
    #[serde(default)]
    any_angle: bool,
    /// What to install where the program is missing.
    install: String,
}

/// A program from outside with the processes that wait for their next query.
struct External {
    program: Program,
    version: String,
    files: Vec<PathBuf>,
    any_angle: bool,
    install: String,
    idle: Mutex<Vec<Process>>,
    queries: AtomicU64,
}

impl External {
    fn new(settings: &Settings) -> Result<Self, SettingsError> {
        let Written { command, files, version, time_s, memory_mb, output_mb, any_angle, install } =
            settings.read()?;
        let files: Vec<PathBuf> = files.into_iter().map(PathBuf::from).collect();
        if let Some(gone) = files.iter().find(|file| !file.is_file()) {
            let message = format!("the planner's file `{}` {}", gone.display(), missing(gone));
            return Err(settings.error_at("files", message));
        }
        let limits = Limits { time_s, memory_mb: memory_mb.into(), output_mb: output_mb.into() };
        let program = Program { command, limits, hello_s: HELLO_S };
        let idle = Mutex::default();
        let queries = AtomicU64::new(1);
        Ok(Self { program, version, files, any_angle, install, idle, queries })
    }

    /// A process that has sent `hello`.
    fn process(&self) -> Result<Process, String> {
        if let Some(idle) = self.idle.lock().expect("no thread panics with the list").pop() {
            return Ok(idle);
        }
        let mut process = Process::start(&self.program).map_err(|error| error.to_string())?;
        let hello = greet(&mut process, &self.program)?;
        let found = base::text::one_line(&hello.version);
        let wanted = &self.version;
        if found == *wanted {
            return Ok(process);
        }
        Err(format!("the planner says that it is version `{found}`; the study asks for `{wanted}`"))
    }

    /// One conversation on a process of its own, or on one that waits.
    fn talk(&self, request: &Request<'_>, space: &mut Space<'_>) -> Result<(Talk, bool), Invalid> {
        let world = describe(request.world, self.any_angle).map_err(Invalid)?;
        let broken = |why| (Talk::broken(why), false);
        let mut process = match self.process() {
            Ok(process) => process,
            Err(why) => return Ok(broken(why)),
        };
        let hello = process.hello.clone().expect("it was greeted");
        if !hello.worlds.contains(&world.kind()) {
            let name = &hello.name;
            let kind = world.kind();
            return Ok(broken(format!("{name} does not plan in worlds of kind {kind}, its `hello` says")));
        }
        let (start, goal) = (request.start, request.goal);
        let id = self.queries.fetch_add(1, Ordering::Relaxed);
        let seed = request.seed >> (64 - SEED_BITS);
        let query = Query { id, seed, world, start, goal };
        let talk = solve(&mut process, query, self.program.limits, space, clock::now_ns);
        let is_sound = !matches!(talk.end, End::Broken(_)) && !talk.is_cut_off && talk.end != End::TimeSpent;
        match hello.seeding {
            Seeding::Query if is_sound => {
                self.idle.lock().expect("no thread panics with the list").push(process);
            }
            Seeding::Process if is_sound => {
                process.quit();
            }
            Seeding::Query | Seeding::Process => drop(process),
        }
        Ok((talk, hello.deterministic))
    }
}

impl Drop for External {
    fn drop(&mut self) {
        for process in std::mem::take(self.idle.get_mut().expect("no thread panics with the list")) {
            process.quit();
        }
    }
}

impl Planner for External {
    fn plan(&self, request: &Request<'_>) -> Result<Plan, Invalid> {
        let mut space = Space::new(request.world, self.any_angle);
        for (what, end) in [("start", request.start), ("goal", request.goal)] {
            if space.is_valid(end) != Ok(true) {
                return Err(Invalid(format!("the {what} {end} is not free", end = listed(end))));
            }
        }
        let (talk, promises) = self.talk(request, &mut space)?;
        let traces = if request.trace { incumbents(&talk, &mut space) } else { Vec::new() };
        let mut counts = counts(&talk);
        counts.insert("promises_determinism", Value::Count(promises.into()));
        let cost = talk.cost.or_else(|| space.cost(&talk.path)).filter(|_| !talk.path.is_empty());
        let (ending, reason) = ended(&talk, self.program.limits.time_s);
        Ok(Plan { ending, path: talk.path, cost, counts, traces, reason })
    }

    fn draws(&self) -> bool {
        true
    }

    fn is_any_angle(&self) -> bool {
        self.any_angle
    }

    fn files(&self) -> &[PathBuf] {
        &self.files
    }

    fn lacks(&self) -> Option<String> {
        let install = &self.install;
        let name = &self.program.command[0];
        let missing = format!("there is no program `{name}`; to install: {install}");
        if name.contains('/') {
            return (!Path::new(name).is_file()).then_some(missing);
        }
        let folders = std::env::var_os("PATH").unwrap_or_default();
        let is_there = std::env::split_paths(&folders).any(|folder| folder.join(name).is_file());
        (!is_there).then_some(missing)
    }
}

/// How the trial ended and why. A path has a reason too, the end of the planner's log: it is read where the path is refused.
fn ended(talk: &Talk, time_s: f64) -> (Ending, Option<String>) {
    let log = (!talk.log.is_empty()).then(|| format!("its log ends: {}", talk.log));
    match &talk.end {
        End::Solved => (Ending::Solved, log),
        End::NoPath => (Ending::NoPath, None),
        End::BudgetSpent => {
            (Ending::BudgetSpent, Some("a limit of the planner's own was reached".to_owned()))
        }
        End::TimeSpent => {
            let spent = format!("{time_s} s were spent{}", talk.hint());
            (Ending::TimeSpent, Some(log.map_or(spent.clone(), |log| format!("{spent}; {log}"))))
        }
        End::Broken(why) => (Ending::Crashed, Some(why.clone())),
    }
}

fn counts(talk: &Talk) -> Counts {
    let questions = &talk.questions;
    let mut counts = Counts::from([
        ("question_batches", Value::Count(questions.batches)),
        ("questions_valid", Value::Count(questions.valid)),
        ("questions_motion", Value::Count(questions.motion)),
        ("questions_fk", Value::Count(questions.fk)),
        ("questions_ik", Value::Count(questions.ik)),
        ("incumbents", Value::Count(talk.incumbents.len() as u64)),
        ("is_cut_off", Value::Count(talk.is_cut_off.into())),
        ("solve_wall_ns", Value::Real(talk.wall_ns as f64)),
        ("answer_wall_ns", Value::Real(talk.answering_ns as f64)),
    ]);
    for (name, found) in talk.counters.named() {
        let Some(found) = found else { continue };
        // The sum makes 0 of -0.
        let value = if name.ends_with("_ns") { Value::Real(found + 0.0) } else { Value::Count(found as u64) };
        counts.insert(name, value);
    }
    counts
}

/// The incumbents that are better than all before and free by replan's own checks: when each came, in seconds, and its cost.
fn incumbents(talk: &Talk, space: &mut Space<'_>) -> Vec<Trace> {
    let mut values = Vec::new();
    let mut best = f64::INFINITY;
    for (passed_s, path) in talk.incumbents.iter().filter(|(_, path)| !path.is_empty()) {
        let Some(cost) = space.length(path).filter(|cost| *cost < best) else { continue };
        if path.windows(2).all(|two| space.is_free(&two[0], &two[1]) == Ok(true)) {
            values.extend([*passed_s, cost]);
            best = cost;
        }
    }
    if values.is_empty() {
        return Vec::new();
    }
    vec![Trace { name: "incumbents".to_owned(), width: 2, values }]
}
