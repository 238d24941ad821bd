//! `replan explore`: a paper's claims under every reading that is explored.

use super::judge;
use super::load::load;
use super::places::Places;
use super::progress::{Bar, doing, safe_point, stop_flag};
use super::{Failure, How, Which, command_line, verdicts};
use crate::analysis::across::glance::{Glance, glances};
use crate::analysis::across::near_a_flip;
use crate::analysis::across::stored::Exploration;
use crate::analysis::claims;
use crate::analysis::evidence::{Evidence, default_point};
use crate::analysis::together::{greatest, together};
use crate::analysis::verdict::{Together, Verdicts};
use crate::study::explore::{ExplorePaper, Points, points};
use crate::study::lock::Lock;
use crate::study::manifest::{MadeBy, Manifest};
use crate::study::paper::Paper;
use crate::study::runner::BuiltStudy;
use crate::study::session::{self, Options};
use crate::study::store::{Records, read_records};
use crate::study::{ReadingChoice, Study};
use base::seed;
use clap::Args;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Explores a paper's readings: runs what each study says under the defaults, every other option by itself and a sample of
/// their product, within the paper's budget of trials, and judges every claim under each.
///
/// What was run stays below target/replan/explore/, so that a command that was stopped goes on from there; what was found is
/// stored beside the default run, which must be there.
///
/// Example: replan explore zhang
#[derive(Args)]
pub struct Explore {
    #[command(flatten)]
    which: Which,
    /// Threads for the trials; the machine's number if absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,
    /// Say what would run, and run nothing
    #[arg(long)]
    plan: bool,
}

/// What every claim is found to be under one reading.
pub type Glances = BTreeMap<String, Glance>;

/// A study cut down to what is explored of it, and the study whose claims it answers.
struct Ran<'p> {
    study: Study,
    answers: &'p Study,
}

/// A paper whose readings are explored.
pub struct Explorer<'p> {
    /// The paper.
    pub paper: &'p Paper,
    /// Its places.
    pub places: &'p Places,
    /// Threads for the trials.
    pub threads: Option<usize>,
    /// Where trials are kept.
    pub folder: PathBuf,
    /// Every seed is the second one.
    pub second_seed: bool,
}

impl Explore {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        MadeBy::here();
        let how = How { quick: false, seed: None, readings: None, threads: self.threads };
        let places = Places::find(&self.which, "")?;
        let paper = load(&places, &how)?;
        let budget = budget(&paper)?;
        let explorer = Explorer {
            paper: &paper,
            places: &places,
            threads: self.threads.map(|threads| threads as usize),
            folder: scratch(&places, &paper, "explore"),
            second_seed: false,
        };
        let (points, trials) = explorer.affordable(&budget)?;
        say!("{}: {} readings, {trials} trials of at most {}", paper.id, points.len(), budget.trials);
        if self.plan {
            return Ok(());
        }
        let _lock = Lock::take(&places.runs)?;
        let verdicts = judged(&paper, &places)?;
        let exploration = explorer.explore(&points, &budget, trials, &verdicts)?;
        let path = Exploration::first(&places.runs);
        exploration.write(&path)?;
        verdicts::print(&judge::judge(&paper, default_point(&paper), &places)?);
        say!(
            "{} trials under {} readings; what was found is in {}",
            exploration.trials,
            points.len(),
            path.display()
        );
        Ok(())
    }
}

/// The paper's budget.
fn budget(paper: &Paper) -> Result<ExplorePaper, Failure> {
    let missing = || {
        let path = paper.folder.join("paper.toml");
        Failure::input(format!(
            "{}: explores no readings; `[explore]` with `sample` and `trials`, and `[explore]` with `draws` in a study, are accepted",
            path.display()
        ))
    };
    let budget = paper.explore.ok_or_else(missing)?;
    if paper.studies.iter().all(|study| study.explore.is_none()) {
        return Err(missing());
    }
    Ok(budget)
}

/// Where the trials of `command` are kept: they are large, and what was found in them is not.
pub fn scratch(places: &Places, paper: &Paper, command: &str) -> PathBuf {
    places.home.join("target/replan").join(command).join(&paper.id)
}

/// The claims' verdicts by the stored default run.
pub fn judged(paper: &Paper, places: &Places) -> Result<Verdicts, Failure> {
    doing(&format!("{}: judging {} claims", paper.id, paper.claims.len()));
    Ok(claims::judge(&judge::read(paper, default_point(paper), places)?)?)
}

impl<'p> Explorer<'p> {
    /// The points that the budget has room for, and how many trials they take: all that must be, and drawn ones in order.
    fn affordable(&self, budget: &ExplorePaper) -> Result<(Vec<ReadingChoice>, u64), Failure> {
        let paper = self.paper;
        let seed = seed::derive(0, &[&paper.id, "explore"]);
        let refuse = |message: String| Failure::from(paper.document.error_at("explore", message));
        let Points { alone, drawn } = points(&paper.readings(), budget.sample, seed).map_err(refuse)?;
        let each = self.trials_each(|study| study.explore.as_ref().map_or(0, |explore| explore.draws))?;
        let mut chosen = alone;
        let mut trials = trials(&each, &chosen);
        if trials > budget.trials {
            let message = format!(
                "the defaults and every other option by itself take {trials} trials under {} readings; `trials` is {}: fewer \
                 draws or a larger budget are accepted",
                chosen.len(),
                budget.trials
            );
            return Err(paper.document.error_at("explore.trials", message).into());
        }
        for more in drawn {
            let with = [&chosen[..], &more[..]].concat();
            let needed = self::trials(&each, &with);
            if needed > budget.trials {
                break;
            }
            (chosen, trials) = (with, needed);
        }
        Ok((chosen, trials))
    }

    /// The studies that are explored, cut down to `draws` of each group.
    fn studies(&self, draws: impl Fn(&Study) -> u32) -> Vec<Ran<'p>> {
        let ran = |study: &'p Study| {
            let explore = study.explore.as_ref()?;
            let answers =
                explore.stands_for.as_ref().and_then(|name| self.paper.study(name)).unwrap_or(study);
            let mut cut = study.clone().explored(explore, draws(study));
            if self.second_seed {
                cut.seed = study.second_seed?;
            }
            Some(Ran { study: cut, answers })
        };
        self.paper.studies.iter().filter_map(ran).collect()
    }

    /// How many trials each explored study runs under one reading.
    fn trials_each(&self, draws: impl Fn(&Study) -> u32) -> Result<Vec<(&'p Study, u64)>, Failure> {
        let mut each = Vec::new();
        for ran in self.studies(draws) {
            let point = default_point(self.paper).for_trials(&ran.study.readings);
            let points = [point];
            let built = BuiltStudy::new(&ran.study, &points, &self.places.inputs)?;
            let count: usize = built.units().iter().map(|unit| built.trials(unit).len()).sum();
            let study = self.paper.study(&ran.study.name).expect("it is a study of the paper");
            each.push((study, count as u64));
        }
        Ok(each)
    }

    /// Runs and judges `points`, and once more with more draws where a class is near a flip.
    fn explore(
        &self,
        points: &[ReadingChoice],
        budget: &ExplorePaper,
        spent: u64,
        verdicts: &Verdicts,
    ) -> Result<Exploration, Failure> {
        let draws = |study: &Study| study.explore.as_ref().map_or(0, |explore| explore.draws);
        let (found, sets) = self.look(points, "round-1", &draws)?;
        let mut first = Exploration::of(self.paper, points, &found, &BTreeMap::new());
        first.trials = spent;
        let more = |study: &Study| {
            study.explore.as_ref().map_or(0, |explore| explore.more_draws.unwrap_or(explore.draws))
        };
        let each = self.trials_each(more)?;
        let mut chosen: Vec<usize> = Vec::new();
        let has_more = self.paper.studies.iter().any(|study| more(study) > draws(study));
        let near = if has_more { near_a_flip(self.paper, verdicts, &first) } else { BTreeSet::new() };
        for place in near {
            let with: Vec<ReadingChoice> =
                chosen.iter().chain([&place]).map(|place| points[*place].clone()).collect();
            if trials(&each, &with) + spent <= budget.trials {
                chosen.push(place);
            }
        }
        let again: Vec<ReadingChoice> = chosen.iter().map(|place| points[*place].clone()).collect();
        let mut with_more = BTreeMap::new();
        if !again.is_empty() {
            let (found, _) = self.look(&again, "round-2", &more)?;
            with_more = chosen.into_iter().zip(found).collect();
        }
        let trials = spent + trials(&each, &again);
        let (together, command) = (greatest(sets), command_line());
        let all = Exploration::of(self.paper, points, &found, &with_more);
        Ok(Exploration { command, trials, together, ..all })
    }

    /// What every claim is under each of `points`, with so many draws, and which claims hold jointly there.
    pub fn look(
        &self,
        points: &[ReadingChoice],
        round: &str,
        draws: &dyn Fn(&Study) -> u32,
    ) -> Result<(Vec<Glances>, Vec<Together>), Failure> {
        let studies = self.studies(draws);
        let folder = self.folder.join(round);
        let mut stored = Vec::new();
        for ran in &studies {
            let (manifest, records) = self.run(&ran.study, points, &folder)?;
            stored.push((&ran.study, ran.answers, manifest, records));
        }
        let evidence = judge::read(self.paper, default_point(self.paper), self.places)?.with(stored);
        self.judge_under(&evidence, points)
    }

    /// Judges every claim of `evidence` under each of `points`.
    pub fn judge_under(
        &self,
        evidence: &Evidence<'_>,
        points: &[ReadingChoice],
    ) -> Result<(Vec<Glances>, Vec<Together>), Failure> {
        let (mut found, mut sets) = (Vec::new(), Vec::new());
        let bar = Bar::default();
        crate::study::runner::Progress::begin(
            &bar,
            &format!("{}: judging readings", self.paper.id),
            points.len(),
        );
        for point in points {
            safe_point(stop_flag(), "the trials are kept")?;
            let view = evidence.under(point.clone());
            found.push(glances(&view)?);
            sets.extend(together(&view)?);
            crate::study::runner::Progress::step(&bar);
        }
        crate::study::runner::Progress::end(&bar);
        Ok((found, sets))
    }

    /// Runs what is not stored of `study` under `points`.
    pub fn run(
        &self,
        study: &Study,
        points: &[ReadingChoice],
        folder: &std::path::Path,
    ) -> Result<(Manifest, Records), Failure> {
        let lock = Lock::take(folder)?;
        let report = session::run(
            study,
            &Options {
                lock: &lock,
                points: &study.as_trials_see(points),
                inputs: &self.places.inputs,
                command: command_line(),
                claims: claims::claims_hash(self.paper),
                portion: None,
                quick: false,
                record: false,
                fresh: false,
                threads: self.threads,
                stop: stop_flag(),
                progress: &Bar::default(),
            },
        )?;
        let records = read_records(folder, &study.name, &report.manifest.files)?;
        Ok((report.manifest, records))
    }
}

/// How many trials `points` take, each study running those apart that it tells apart.
fn trials(each: &[(&Study, u64)], points: &[ReadingChoice]) -> u64 {
    each.iter().map(|(study, count)| study.as_trials_see(points).len() as u64 * count).sum()
}
