//! `replan status`: the progress of a run that was cut into shards.

use super::Failure;
use super::rounds::at_work;
use clap::Args;
use serde::Serialize;
use std::path::{Path, PathBuf};
use study::plan::{Plan, Progressed, State};

/// Says how far the shards are.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Status {
    /// The folder that holds the shards
    parts: PathBuf,
    /// Print it as JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "Examples:
  replan status parts";

/// How far the shards are.
#[derive(Serialize)]
struct ShardProgress {
    /// The round that is at work, of an exploration or a confirmation.
    #[serde(skip_serializing_if = "Option::is_none")]
    round: Option<String>,
    shards: usize,
    done: Vec<usize>,
    running: Vec<usize>,
    stopped: Vec<usize>,
    waiting: usize,
    units: usize,
    units_done: usize,
}

impl Status {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let parts = at_work(&self.parts);
        let plan = Plan::read(&parts)?;
        let found: Vec<Progressed> =
            (1..=plan.shards).map(|number| plan.progressed(&parts, number)).collect();
        let with = |state: State| -> Vec<usize> {
            (1..=plan.shards).filter(|number| found[number - 1].state == state).collect()
        };
        let found = ShardProgress {
            round: plan.round.as_ref().map(|round| round.name.clone()),
            shards: plan.shards,
            done: with(State::Done),
            running: with(State::Running),
            stopped: with(State::Stopped),
            waiting: with(State::Waiting).len(),
            units: plan.units(),
            units_done: found.iter().map(|found| found.units).sum(),
        };
        if self.json {
            say!("{}", serde_json::to_string(&found).expect("a state is numbers"));
        } else {
            say!("{}", progress_text(&found, &plan, &self.parts, &parts));
        }
        Ok(())
    }
}

/// It in words, of the parts in `folder`, which is that of the round at work in `all`.
fn progress_text(found: &ShardProgress, plan: &Plan, all: &Path, folder: &Path) -> String {
    let listed = |numbers: &[usize]| match numbers.len() {
        1..=20 => format!(" ({})", numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
        0 | 21.. => String::new(),
    };
    let mut text = found.round.as_ref().map_or_else(String::new, |round| format!("round `{round}`: "));
    text += &format!(
        "{} of {} shards are done, {} running{}, {} stopped{}, {} waiting; {} of {} units",
        found.done.len(),
        found.shards,
        found.running.len(),
        listed(&found.running),
        found.stopped.len(),
        listed(&found.stopped),
        found.waiting,
        found.units_done,
        found.units
    );
    if found.done.len() == found.shards {
        let out = if plan.round.is_some() { "" } else { " --out DIR" };
        let merge = base::text::command(&["merge".to_owned(), all.display().to_string()]);
        return text + &format!("\nput together by: {merge}{out}");
    }
    if let Some(first) = found.stopped.first() {
        let shard = format!("{first}/{}", plan.shards);
        text += &format!("\nto go on: {}", base::text::command(&plan.arguments(folder, &shard)));
    }
    text
}
