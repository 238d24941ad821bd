//! `replan explore`: a paper's claims under every interpretation that is explored.

use super::consent::Consent;
use super::explorer::{Explorer, budget, judged};
use super::load::open;
use super::one_shard::RoundArgs;
use super::rounds::{Round, Rounds, unless_planned};
use super::{Failure, How, Which, counted, judge, verdicts};
use crate::analysis::estimates::{Estimates, Explored};
use crate::analysis::evidence::default_point;
use clap::Args;
use std::collections::BTreeSet;
use study::Interpretation;
use study::lock::Lock;
use study::paper::Paper;

/// Explores a paper's choices: runs what each study says under the defaults, every other option by itself and a sample of
/// their product, within the paper's budget of trials, and judges every claim under each.
///
/// What was run stays below target/replan/explore/, or scratch/ below --out, so that a command that was stopped goes on from there; what was found is
/// stored beside the default run, which must be there.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Explore {
    #[command(flatten)]
    round: RoundArgs,
    /// Print what would run and the most that it takes, as timed on the first instances; keep nothing
    #[arg(long, conflicts_with = "shard")]
    plan: bool,
}

const EXAMPLES: &str = "Examples:
  replan explore zhang --plan         what would run, and how long it takes at most
  replan explore zhang";

impl Explore {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        if self.plan {
            return plan(&self.round.which);
        }
        self.round.run(Round::First, first_points, explore)
    }
}

/// The points of the first round.
pub fn first_points(explorer: &Explorer<'_>) -> Result<Vec<Interpretation>, Failure> {
    Ok(explorer.affordable(&budget(explorer.paper)?)?.0)
}

/// Says what would run.
fn plan(which: &Which) -> Result<(), Failure> {
    let (places, paper) = open(which, &How::plain(None))?;
    let explorer = Explorer::new(&paper, &places, None, (None, "explore"));
    let budget = budget(&paper)?;
    let (points, trials) = explorer.affordable(&budget)?;
    for line in anew(&paper) {
        say!("{}: {line}", paper.id);
    }
    let [all, different] = explorer.shared_first(&points)?;
    say!("{}: {different} different trials run for these {all}, which interpretations share", paper.id);
    let each = explorer.seconds_a_trial(&points)?;
    let (more, seconds) = explorer.most_beyond(&points, budget.trials - trials, &each)?;
    say!(
        "{}: then, with more instances where an outcome is near a flip, at most {}",
        paper.id,
        counted(more as usize, ["trial", "trials"])
    );
    let explored = paper.studies.iter().filter(|study| study.explore.is_some()).map(|study| &study.name);
    let untimed: Vec<&str> = explored.filter(|name| !each.contains_key(*name)).map(String::as_str).collect();
    let bound = match &untimed[..] {
        [] => String::new(),
        names => format!("; {}, not timed, as if each search opened all that there is", names.join(", ")),
    };
    say!(
        "{}: in all at most about {} of one core, by what the first instances take{bound}",
        paper.id,
        lasting(seconds)
    );
    Ok(())
}

/// Which choices need new trials of some contenders, and which only count stored trials anew: a line for choices that are alike.
fn anew(paper: &Paper) -> Vec<String> {
    let mut alike: Vec<(BTreeSet<&str>, Vec<&str>)> = Vec::new();
    let mut all = BTreeSet::new();
    for choice in &paper.choices {
        let mut labels = BTreeSet::new();
        for study in paper.studies.iter().filter(|study| study.explore.is_some()) {
            let inherits = study.choices.iter().any(|own| own.id == choice.id);
            all.extend(study.contenders.iter().map(|contender| contender.label.as_str()));
            let own = study.contenders.iter().filter(|contender| inherits && contender.is_set_by(choice));
            labels.extend(own.map(|contender| contender.label.as_str()));
        }
        match alike.iter_mut().find(|(known, _)| *known == labels) {
            Some((_, ids)) => ids.push(&choice.id),
            None => alike.push((labels, vec![&choice.id])),
        }
    }
    let line = |(labels, ids): (BTreeSet<&str>, Vec<&str>)| {
        let named = || labels.iter().map(|label| format!("`{label}`")).collect::<Vec<_>>().join(", ");
        let what = match labels.len() {
            0 => "no new trial; stored ones are counted anew".to_owned(),
            most if most == all.len() => "new trials of every contender".to_owned(),
            _ => format!("new trials of {}", named()),
        };
        format!("{}: {what}", ids.join(", "))
    };
    alike.into_iter().map(line).collect()
}

/// A time in the unit that suits it.
fn lasting(seconds: f64) -> String {
    match seconds {
        ..120.0 => format!("{} s", seconds.ceil()),
        ..7_200.0 => format!("{} minutes", (seconds / 60.0).ceil()),
        _ => format!("{:.1} hours", seconds / 3_600.0),
    }
}

/// Explores the paper that `which` names on this machine, or as far as the parts in `rounds` go; `command` is kept with what
/// is found.
pub fn explore(
    which: &Which,
    threads: Option<u32>,
    rounds: Option<Rounds>,
    (command, consent): (String, Consent),
) -> Result<(), Failure> {
    let (places, paper) = open(which, &How::plain(threads))?;
    consent.check(&paper.studies, &places)?;
    let budget = budget(&paper)?;
    let explorer = Explorer::new(&paper, &places, threads, (rounds, "explore"));
    let (points, trials) = explorer.affordable(&budget)?;
    let _lock = Lock::take(&places.runs)?;
    let verdicts = judged(&paper, &places)?;
    let found = unless_planned(explorer.explore(&points, &budget, trials, &verdicts))?;
    let Some(explored) = found.map(|found| Explored { command, ..found }) else { return Ok(()) };
    let trials = explored.trials;
    // What is damaged is made again, and what was found on the second seed is gone with it.
    let stored = Estimates::read(&paper, &places.runs).unwrap_or_else(|_| Estimates::none(&paper));
    Estimates { first: Some(explored), ..stored }.write(&places.runs)?;
    verdicts::print(Some(&paper), &judge::judge(&paper, default_point(&paper), &places)?, which);
    say!(
        "{} under {}; what was found is in {}",
        counted(trials as usize, ["trial", "trials"]),
        counted(points.len(), ["interpretation", "interpretations"]),
        Estimates::path(&places.runs).display()
    );
    Ok(())
}
