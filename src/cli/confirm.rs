//! `replan confirm`: a paper's claims on the second seed.

use super::consent::Consent;
use super::explorer::{Explorer, judged, most_instances, within};
use super::load::open;
use super::one_shard::RoundArgs;
use super::progress::doing;
use super::rounds::{Halt, Round, Rounds, unless_planned};
use super::{Failure, How, Which, counted, judge, verdicts};
use crate::analysis::across::stored::Exploration;
use crate::analysis::across::to_confirm;
use crate::analysis::estimates::{Estimates, Explored};
use crate::analysis::evidence::{Evidence, default_point};
use crate::analysis::verdict::Verdicts;
use clap::Args;
use std::collections::BTreeMap;
use study::Interpretation;
use study::lock::Lock;
use study::paper::Paper;

/// Runs a paper's studies once more on the second seed that each spec writes down. Every interpretation that turns a
/// claim runs too, with more instances: an outcome that turns counts only if it turns twice.
///
/// The interpretations are taken in order while the paper's budget of trials lasts; one that is left out stays
/// unconfirmed.
///
/// No clock is read. What was run stays below target/replan/confirm/, so that a command that was stopped goes on from
/// there.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Confirm {
    #[command(flatten)]
    round: RoundArgs,
}

const EXAMPLES: &str = "Examples:
  replan confirm zhang";

impl Confirm {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        self.round.run(Round::Default, first_points, confirm)
    }
}

/// The point of the first round, if the paper can be confirmed.
pub fn first_points(explorer: &Explorer<'_>) -> Result<Vec<Interpretation>, Failure> {
    check_seeds(explorer.paper)?;
    affordable(explorer)?;
    Ok(vec![default_point(explorer.paper)])
}

/// Confirms the paper that `which` names on this machine, or as far as the parts in `rounds` go; `command` is kept with what
/// is found.
pub fn confirm(
    which: &Which,
    threads: Option<u32>,
    rounds: Option<Rounds>,
    (command, consent): (String, Consent),
) -> Result<(), Failure> {
    let (places, paper) = open(which, &How::plain(threads))?;
    consent.check(&paper.studies, &places)?;
    check_seeds(&paper)?;
    let _lock = Lock::take(&places.runs)?;
    let explorer =
        Explorer { second_seed: true, ..Explorer::new(&paper, &places, threads, (rounds, "confirm")) };
    let found = unless_planned(confirmed(&explorer))?;
    let Some(second) = found.map(|found| Explored { command, ..found }) else { return Ok(()) };
    let trials = second.trials;
    let interpretations = second.interpretations.len();
    let stored = Estimates::read(&paper, &places.runs)?;
    Estimates { second: Some(second), ..stored }.write(&places.runs)?;
    verdicts::print(Some(&paper), &judge::judge(&paper, default_point(&paper), &places)?, which);
    say!(
        "{} on the second seed, {} besides the default; what was found is in {}",
        counted(trials as usize, ["trial", "trials"]),
        counted(interpretations - 1, ["interpretation", "interpretations"]),
        Estimates::path(&places.runs).display()
    );
    Ok(())
}

/// Refuses a paper in which a study has no second seed.
fn check_seeds(paper: &Paper) -> Result<(), Failure> {
    let without: Vec<&str> = paper
        .studies
        .iter()
        .filter(|study| study.second_seed.is_none())
        .map(|study| study.name.as_str())
        .collect();
    if without.is_empty() {
        return Ok(());
    }
    Err(Failure::input(format!(
        "{}: `second_seed` is missing in {}; a number other than `seed` is accepted, written before the first run",
        paper.folder.display(),
        without.join(", ")
    )))
}

/// Every claim on the second seed: under the default interpretation with all instances, and under interpretations that turn a claim.
fn confirmed(explorer: &Explorer<'_>) -> Result<Explored, Halt> {
    let paper = explorer.paper;
    let places = explorer.places;
    let default = default_point(paper);
    let mut all_trials = affordable(explorer)?;
    let verdicts = judged(paper, places)?;
    explorer.put_together(Round::Default, std::slice::from_ref(&default))?;
    let mut stored = BTreeMap::new();
    for study in paper.studies.iter().map(|study| study.clone().reseeded()) {
        let run = explorer.run(&study, std::slice::from_ref(&default), Round::Default)?;
        stored.insert(study.name.clone(), run);
    }
    let evidence = Evidence::held(paper, default.clone(), stored);
    let (mut found, _) = explorer.judge_under(&evidence, std::slice::from_ref(&default))?;
    let mut points = vec![default];
    if let Some(first) = Estimates::read(paper, &places.runs)?.first {
        let first = explorer.weighed(&first)?;
        let each = explorer.trials_each(most_instances, |_| true)?;
        let all = turned(paper, &verdicts, &first);
        let budget = paper.explore.as_ref().map_or(u64::MAX, |explore| explore.trials);
        let (_, some) = within(budget, &mut all_trials, &each, &all, (0..all.len()).collect());
        if some.len() < all.len() {
            let why = "interpretations that turn a claim and for which the budget has no room";
            say!("{}: {why}: {}", paper.id, all.len() - some.len());
        }
        if !some.is_empty() {
            found.extend(explorer.look(&some, Round::Turned)?.0);
            points.extend(some);
        }
    }
    Ok(Explored { trials: all_trials, ..explorer.explored(&points, &found) })
}

/// How many trials the default interpretation takes on the second seed; refused if the paper's budget has no room for them.
fn affordable(explorer: &Explorer<'_>) -> Result<u64, Failure> {
    let mut needed = 0;
    doing(&format!("{}: counting the trials on the second seed", explorer.paper.id));
    for study in explorer.paper.studies.iter().map(|study| study.clone().reseeded()) {
        needed += explorer.trials_of(&study)?;
    }
    match &explorer.paper.explore {
        Some(budget) if needed > budget.trials => {
            let message = format!(
                "the default interpretation takes {needed} trials on the second seed; `trials` is {}: a larger budget is accepted",
                budget.trials
            );
            Err(explorer.paper.document.error_at("explore.trials", message).into())
        }
        _ => Ok(needed),
    }
}

/// The interpretations of `first` that turn a claim.
fn turned(paper: &Paper, verdicts: &Verdicts, first: &Exploration) -> Vec<Interpretation> {
    let choices = &paper.choices;
    let places = to_confirm(paper, verdicts, first).into_iter().filter(|place| *place > 0);
    // A choice that the paper no longer has belongs to an exploration that is stale.
    places.filter_map(|place| Interpretation::new(choices, &first.interpretations[place]).ok()).collect()
}
