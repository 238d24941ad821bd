//! `replan status`: the progress of a run that was cut into shards.

use super::Failure;
use super::rounds::at_work;
use clap::Args;
use std::path::{Path, PathBuf};
use study::plan::{Plan, Progressed, State};

/// Says how far the shards are.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Status {
    /// The folder that holds the shards
    parts: PathBuf,
}

const EXAMPLES: &str = "Examples:
  replan status parts";

impl Status {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let parts = at_work(&self.parts);
        say!("{}", progress_text(&Plan::read(&parts)?, &self.parts, &parts));
        Ok(())
    }
}

/// The progress of `plan` in words, of the parts in `folder`, which is that of the round at work in `all`.
fn progress_text(plan: &Plan, all: &Path, folder: &Path) -> String {
    let found: Vec<Progressed> = (1..=plan.shards).map(|number| plan.progressed(folder, number)).collect();
    let with = |state: State| -> Vec<usize> {
        (1..=plan.shards).filter(|number| found[number - 1].state == state).collect()
    };
    let [done, running, stopped, waiting] =
        [State::Done, State::Running, State::Stopped, State::Waiting].map(with);
    let units_done: usize = found.iter().map(|found| found.units).sum();
    let listed = |numbers: &[usize]| match numbers.len() {
        1..=20 => format!(" ({})", numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
        0 | 21.. => String::new(),
    };
    let mut text = plan.round.as_ref().map_or_else(String::new, |round| format!("round `{}`: ", round.name));
    text += &format!(
        "{} of {} shards are done, {} running{}, {} stopped{}, {} waiting; {units_done} of {} units",
        done.len(),
        plan.shards,
        running.len(),
        listed(&running),
        stopped.len(),
        listed(&stopped),
        waiting.len(),
        plan.units()
    );
    if done.len() == plan.shards {
        let out = if plan.round.is_some() { "" } else { " --out DIR" };
        let merge = base::text::command(&["merge".to_owned(), all.display().to_string()]);
        return text + &format!("\nput together by: {merge}{out}");
    }
    if let Some(first) = stopped.first() {
        let shard = format!("{first}/{}", plan.shards);
        text += &format!("\nto go on: {}", base::text::command(&plan.arguments(folder, &shard)));
    }
    text
}
