//! One conversation: a query is handed over, questions are answered, a result comes back or does not.

use super::answer::{QuestionCounts, Space, Unanswered};
use super::interrupt::is_interrupted;
use super::message::{Counters, FromPlanner, Hello, Limits, PROTOCOL, QueryResult, Solve, Status, ToPlanner};
use super::process::{Clock, Process, Program};
use super::world::World;
use base::text::{fault_of_name, listed};
use std::time::Duration;

/// A result is waited for this much longer than a planner is given, so that one that looks at the clock itself is not cut off
/// while it writes.
const GRACE_S: f64 = 0.25;

/// How often it is looked whether replan was interrupted, in seconds.
const LOOK_S: f64 = 0.05;
const LOOK: Duration = Duration::from_millis(50);

/// What keeps most planners silent that are at work.
const SILENT: &str = "; it wrote nothing: an output that is buffered must be flushed after each line";

/// How a conversation ended.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// With a path.
    Solved,
    /// There is none, the planner says.
    NoPath,
    /// A limit of the planner's own was reached.
    BudgetSpent,
    /// Its time ran out.
    TimeSpent,
    /// It did what no planner should: why, and the end of its log.
    Broken(String),
}

/// The message.
#[derive(Debug, Clone, PartialEq)]
pub struct Talk {
    /// How it ended.
    pub end: End,
    /// The path; the last incumbent where the time ran out. Empty unless solved.
    pub path: Vec<Vec<f64>>,
    /// The cost that the planner claims.
    pub cost: Option<f64>,
    /// What it counted.
    pub counters: Counters,
    /// Incumbents that its own questions would have been answered for: seconds since the query, and the path.
    pub incumbents: Vec<(f64, Vec<Vec<f64>>)>,
    /// Questions.
    pub questions: QuestionCounts,
    /// From the query to its end by replan's clock.
    pub wall_ns: u64,
    /// Of it, what replan took to answer questions.
    pub answering_ns: u64,
    /// Whether the planner was cut off while it had an incumbent.
    pub is_cut_off: bool,
    /// The end of the planner's log by then.
    pub log: String,
    /// Whether it wrote nothing at all.
    pub was_silent: bool,
}

impl Talk {
    fn new(end: End) -> Self {
        Self {
            end,
            path: Vec::new(),
            cost: None,
            counters: Counters::default(),
            incumbents: Vec::new(),
            questions: QuestionCounts::default(),
            wall_ns: 0,
            answering_ns: 0,
            is_cut_off: false,
            log: String::new(),
            was_silent: false,
        }
    }

    /// The reason why its time ran out, as far as it shows from outside.
    pub fn hint(&self) -> &'static str {
        if self.was_silent { SILENT } else { "" }
    }

    /// A conversation that did not come about.
    pub fn broken(why: String) -> Self {
        Self::new(End::Broken(why))
    }
}

/// A query to a planner.
#[derive(Debug)]
pub struct Query<'a> {
    /// The number of the query.
    pub id: u64,
    /// The seed.
    pub seed: u64,
    /// The world as data.
    pub world: World,
    /// The start configuration.
    pub start: &'a [f64],
    /// The goal configuration.
    pub goal: &'a [f64],
}

/// Waits for a planner's first line.
///
/// # Errors
/// A sentence: it sent nothing in time, or something else.
pub fn greet(process: &mut Process, program: &Program) -> Result<Hello, String> {
    let mut looks = (program.hello_s / LOOK_S).ceil() as u64;
    let mut first = process.next(LOOK);
    while looks > 1 && matches!(first, Ok(None)) && !is_interrupted() {
        looks -= 1;
        first = process.next(LOOK);
    }
    let hello = match first {
        Ok(Some(FromPlanner::Hello(hello))) if hello.protocol == PROTOCOL => match fault_of(&hello) {
            None => hello,
            Some(fault) => return Err(with_log(process, &fault)),
        },
        Ok(Some(FromPlanner::Hello(hello))) => {
            let spoken = hello.protocol;
            return Err(with_log(
                process,
                &format!("the planner speaks protocol {spoken}; {PROTOCOL} is accepted"),
            ));
        }
        Ok(Some(_)) => return Err(with_log(process, "the planner's first line is no `hello`")),
        Ok(None) => {
            let seconds = program.hello_s;
            let hint = if process.is_silent() { SILENT } else { "" };
            return Err(with_log(process, &format!("the planner sent no `hello` within {seconds} s{hint}")));
        }
        Err(why) => return Err(with_log(process, &why)),
    };
    process.hello = Some(hello.clone());
    Ok(hello)
}

/// What is wrong with what a planner says of itself.
fn fault_of(hello: &Hello) -> Option<String> {
    let named = fault_of_name(&hello.name).map(|fault| format!("the planner's name {fault}"));
    let is_blank =
        || hello.name.trim().is_empty().then(|| "the planner's name is empty; one is accepted".to_owned());
    let no_world =
        || hello.worlds.is_empty().then(|| "the planner names no world; at least one is accepted".to_owned());
    named.or_else(is_blank).or_else(no_world)
}

/// `why` with how the planner ended, if it has, and the end of its log.
fn with_log(process: &mut Process, why: &str) -> String {
    let ended = process.ended().map(|status| format!(" ({status})")).unwrap_or_default();
    let log = process.log();
    if log.is_empty() { format!("{why}{ended}") } else { format!("{why}{ended}; its log ends: {log}") }
}

/// Poses `query` to a planner that has sent `hello`, and answers its questions until it is done.
pub fn solve(
    process: &mut Process,
    query: Query<'_>,
    limits: Limits,
    space: &mut Space<'_>,
    clock: Clock,
) -> Talk {
    let id = query.id;
    let talk = Talk::new(End::TimeSpent);
    if let Err(why) = process.begin() {
        return Talk::broken(with_log(process, &why));
    }
    let begun = clock();
    let (start, goal) = (query.start.to_vec(), query.goal.to_vec());
    let Query { seed, world, .. } = query;
    process.send(&ToPlanner::Solve(Box::new(Solve { id, seed, limits, world, start, goal })));
    let mut held = Conversation { id, limits, space, clock, begun, talk };
    let end = loop {
        let left_s = limits.time_s + GRACE_S - held.passed_s();
        if left_s <= 0.0 || is_interrupted() {
            break End::TimeSpent;
        }
        match process.next(Duration::from_secs_f64(left_s.min(LOOK_S))) {
            Ok(None) => {}
            Ok(Some(message)) => match held.take(process, message) {
                Ok(None) => {}
                Ok(Some(end)) => break end,
                Err(why) => break End::Broken(with_log(process, &why)),
            },
            Err(why) => break End::Broken(with_log(process, &why)),
        }
    };
    let was_silent = process.is_silent();
    Talk { log: process.log(), was_silent, ..held.finish(end) }
}

struct Conversation<'a, 'w> {
    id: u64,
    limits: Limits,
    space: &'a mut Space<'w>,
    clock: Clock,
    begun: u64,
    talk: Talk,
}

impl Conversation<'_, '_> {
    fn passed_s(&self) -> f64 {
        ((self.clock)() - self.begun) as f64 * 1e-9
    }

    /// Takes one message; how the conversation ended, if it has.
    fn take(&mut self, process: &mut Process, message: FromPlanner) -> Result<Option<End>, String> {
        match message {
            FromPlanner::Hello(_) => Err("the planner says `hello` again".to_owned()),
            FromPlanner::Ask(ask) => {
                let before = (self.clock)();
                let Self { clock, begun, .. } = *self;
                let most_s = self.limits.time_s + GRACE_S;
                let goes_on = || !is_interrupted() && (clock() - begun) as f64 * 1e-9 < most_s;
                let answer = self.space.answer_while(&ask, &goes_on);
                self.talk.answering_ns += (self.clock)() - before;
                match answer {
                    Ok(answer) => process.send(&ToPlanner::Answer(answer)),
                    Err(Unanswered::Stopped) => return Ok(Some(End::TimeSpent)),
                    Err(Unanswered::Refused(why)) => return Err(why),
                }
                Ok(None)
            }
            FromPlanner::Incumbent(incumbent) => {
                self.own(incumbent.id)?;
                self.check(&incumbent.path)?;
                let passed_s = self.passed_s();
                if passed_s <= self.limits.time_s {
                    self.talk.incumbents.push((passed_s, incumbent.path));
                }
                Ok(None)
            }
            FromPlanner::Result(found) => self.result(found).map(Some),
        }
    }

    fn own(&self, id: u64) -> Result<(), String> {
        let current = self.id;
        if id == current {
            Ok(())
        } else {
            Err(format!("the planner answers query {id}; its query is {current}"))
        }
    }

    /// Refuses a path that is none of this world.
    fn check(&self, path: &[Vec<f64>]) -> Result<(), String> {
        let width = self.space.width();
        match path.iter().position(|at| at.len() != width || at.iter().any(|x| !x.is_finite())) {
            Some(index) => Err(format!(
                "point {} of a path is {}; {width} finite numbers are accepted",
                index + 1,
                listed(&path[index])
            )),
            None => Ok(()),
        }
    }

    fn result(&mut self, found: QueryResult) -> Result<End, String> {
        self.own(found.id)?;
        self.check(&found.path)?;
        self.talk.counters = found.counters;
        let (end, status) = match found.status {
            Status::Solved => {
                (self.talk.path, self.talk.cost) = (found.path, found.cost);
                return Ok(End::Solved);
            }
            Status::NoPath => (End::NoPath, "no_path"),
            Status::BudgetSpent => (End::BudgetSpent, "budget_spent"),
            Status::TimeSpent => (End::TimeSpent, "time_spent"),
        };
        let surplus = match (found.path.len(), found.cost) {
            (0, None) => return Ok(end),
            (0, Some(cost)) => format!("a cost, {cost}"),
            (points, _) => format!("a path of {points} points"),
        };
        Err(format!("the planner's result is `{status}` with {surplus}; it is accepted with `solved` alone"))
    }

    fn finish(mut self, end: End) -> Talk {
        self.talk.wall_ns = (self.clock)() - self.begun;
        self.talk.questions = self.space.question_counts();
        self.talk.end = end;
        if self.talk.end == End::TimeSpent
            && let Some((_, path)) = self.talk.incumbents.last()
        {
            self.talk.path.clone_from(path);
            (self.talk.end, self.talk.is_cut_off) = (End::Solved, true);
        }
        self.talk
    }
}
