//! How a paper's interpretations are explored: the trials of each round, and the claims judged after it.

use super::consent::programs;
use super::judge;
use super::places::Places;
use super::progress::{Bar, doing, safe_point, stop_flag};
use super::rounds::{Halt, Round, Rounds};
use super::sharded::{Sharded, options};
use super::{Failure, How, counted};
use crate::analysis::across::stored::{Exploration, differing, met_exactly};
use crate::analysis::across::{compatible, near_a_flip};
use crate::analysis::claims;
use crate::analysis::estimates::{Explored, Measured, measured};
use crate::analysis::evidence::{Evidence, default_point};
use crate::analysis::polylines::Polylines;
use crate::analysis::together::{greatest, together};
use crate::analysis::verdict::{Together, Verdicts};
use base::seed;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use study::explore::{Interpretations, interpretations, stamp};
use study::lock::Lock;
use study::manifest::Manifest;
use study::paper::Paper;
use study::runner::BuiltStudy;
use study::session::{self, Options};
use study::spec::ExploreSpec;
use study::store::{Records, read_numbers};
use study::{Interpretation, Study};

/// The most interpretations under which a study's first instances are timed.
const TIMED: usize = 8;

/// A study cut down to what is explored of it, and the study whose claims it answers.
struct Ran<'p> {
    study: Study,
    answers: &'p Study,
}

/// A paper whose interpretations are explored.
pub struct Explorer<'p> {
    /// The paper.
    pub paper: &'p Paper,
    /// Its places.
    pub places: &'p Places,
    /// Threads for the trials.
    pub threads: Option<u32>,
    /// Where trials are kept.
    pub folder: PathBuf,
    /// Every seed is the second one.
    pub second_seed: bool,
    /// The parts that rounds are put together of, if they are run in shards.
    pub rounds: Option<Rounds>,
}

/// The paper's budget.
pub fn budget(paper: &Paper) -> Result<ExploreSpec, Failure> {
    let missing = || {
        let path = paper.folder.join("paper.toml");
        Failure::input(format!(
            "{}: explores no interpretations; `[explore]` with `sample`, `trials` and, by study, `instances` is accepted",
            path.display()
        ))
    };
    paper.explore.clone().filter(|explore| !explore.instances.is_empty()).ok_or_else(missing)
}

/// The claims' verdicts by the stored default run.
pub fn judged(paper: &Paper, places: &Places) -> Result<Verdicts, Failure> {
    doing(&format!("{}: judging {} claims and parts of claims", paper.id, paper.claims.len()));
    let evidence = judge::read(paper, default_point(paper), places)?.remembering(&judge::polylines(places));
    let verdicts = claims::judge(&evidence)?;
    evidence.keep_polylines();
    Ok(verdicts)
}

impl<'p> Explorer<'p> {
    /// One for `command` that explores on this machine alone, or as far as the parts in `rounds` go.
    pub fn new(
        paper: &'p Paper,
        places: &'p Places,
        threads: Option<u32>,
        (rounds, command): (Option<Rounds>, &str),
    ) -> Self {
        // Trials are large, and what was found in them is not.
        let alone = || places.scratch.join(command).join(&paper.id);
        let folder = rounds.as_ref().map_or_else(alone, |rounds| Rounds::merged(&rounds.parts));
        Self { paper, places, threads, folder, second_seed: false, rounds }
    }

    /// The points that the budget has room for, and how many trials they take: all mandatory ones, and drawn ones in
    /// order. Both are printed.
    pub fn affordable(&self, budget: &ExploreSpec) -> Result<(Vec<Interpretation>, u64), Failure> {
        let paper = self.paper;
        doing(&format!("{}: counting the trials of its interpretations", paper.id));
        let seed = seed::derive(0, &[&paper.id, "explore"]);
        let refuse = |message: String| Failure::from(paper.document.error_at("explore", message));
        let together = budget.together.iter().map(|options| Interpretation::new(&paper.choices, options));
        let together = together.collect::<Result<Vec<_>, _>>().map_err(refuse)?;
        let others = [paper.departures(), together].concat();
        let found = interpretations(&paper.choices, others, budget.sample, seed);
        let Interpretations { alone, drawn } = found.map_err(refuse)?;
        let each = self.trials_each(first_instances, |study| !budget.is_late(&study.name))?;
        let mut chosen = alone;
        let mut trials = trials(&each, &chosen);
        if trials > budget.trials {
            let message = format!(
                "the defaults and every other option by itself take {trials} trials under {} interpretations; `trials` is {}: fewer \
                 instances or a larger budget are accepted",
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
        let interpretations = counted(chosen.len(), ["interpretation", "interpretations"]);
        let count = counted(trials as usize, ["trial", "trials"]);
        say!("{}: {interpretations}, {count} of at most {}", paper.id, budget.trials);
        Ok((chosen, trials))
    }

    /// Whether `study` runs where interpretations are compatible alone.
    fn is_late(&self, study: &Study) -> bool {
        self.paper.explore.as_ref().is_some_and(|all| all.is_late(&study.name))
    }

    /// Whether some study runs more instances where an outcome is near a flip.
    fn draws_more(&self) -> bool {
        self.paper.studies.iter().any(|study| most_instances(study) > first_instances(study))
    }

    /// What a trial of each explored study takes, in seconds of one core: the mean over the first instances, under some of `points`.
    /// Studies without first instances that can run here are left out.
    pub fn seconds_a_trial(&self, points: &[Interpretation]) -> Result<BTreeMap<String, f64>, Failure> {
        let mut found = BTreeMap::new();
        for Ran { study, .. } in self.studies(first_instances) {
            doing(&format!("{}: timing the first instances of {}", self.paper.id, study.name));
            let seen = study.as_trials_see(points);
            let some: Vec<Interpretation> =
                seen.iter().step_by(seen.len().div_ceil(TIMED)).cloned().collect();
            let seconds = BuiltStudy::new(&study, &some, &self.places.inputs)?
                .seconds_a_trial(!programs(&study).is_empty());
            found.extend(seconds.map(|seconds| (study.name.clone(), seconds)));
        }
        Ok(found)
    }

    /// The most trials that run beyond the first round where `room` trials are left, and the most seconds of one core for all rounds.
    /// A trial of a study takes as long as `each` says. Of the other studies every search is taken to open all that there is.
    pub fn most_beyond(
        &self,
        points: &[Interpretation],
        room: u64,
        each: &BTreeMap<String, f64>,
    ) -> Result<(u64, f64), Failure> {
        let of_study = |study: &Study| -> Result<f64, Failure> {
            match each.get(&study.name) {
                Some(seconds) => Ok(self.trials_of(study)? as f64 * seconds),
                None => Ok(study.work(&self.places.inputs)?.seconds),
            }
        };
        let seconds = |round: Round| {
            let each = self.studies_in(round).into_iter().map(|ran| {
                let [all, different] = self.shared(&ran.study, points)?;
                let alone = ran.study.as_trials_see(points).len() as f64;
                Ok(different as f64 / all as f64 * alone * of_study(&ran.study)?)
            });
            each.sum::<Result<f64, Failure>>()
        };
        let mut wanted = trials(&self.trials_each(first_instances, |study| self.is_late(study))?, points);
        let mut more = seconds(Round::Compatible)?;
        if self.draws_more() {
            wanted += trials(&self.trials_each(most_instances, |_| true)?, points);
            more += seconds(Round::Again)?;
        }
        let beyond = wanted.min(room);
        let share = if wanted > 0 { beyond as f64 / wanted as f64 } else { 0.0 };
        Ok((beyond, seconds(Round::First)? + share * more))
    }

    /// How many trials `study` keeps under `points`, and how many different ones run for them.
    fn shared(&self, study: &Study, points: &[Interpretation]) -> Result<[u64; 2], Failure> {
        let points = study.as_trials_see(points);
        let different = BuiltStudy::new(study, &points, &self.places.inputs)?.different_trials();
        Ok([self.trials_of(study)? * points.len() as u64, different])
    }

    /// How many trials the first round keeps under `points`, and how many different ones run for them.
    pub fn shared_first(&self, points: &[Interpretation]) -> Result<[u64; 2], Failure> {
        let mut each = self.studies_in(Round::First).into_iter().map(|ran| self.shared(&ran.study, points));
        each.try_fold([0; 2], |[all, different], of| of.map(|[more, new]| [all + more, different + new]))
    }

    /// The studies that run in `round`.
    fn studies_in(&self, round: Round) -> Vec<Ran<'p>> {
        let first = |late: bool| {
            self.studies(first_instances).into_iter().filter(|ran| self.is_late(&ran.study) == late).collect()
        };
        match round {
            Round::First => first(false),
            Round::Compatible => first(true),
            Round::Again | Round::Turned => self.studies(most_instances),
            Round::Default => {
                let again = |study: &'p Study| Ran { study: study.clone().reseeded(), answers: study };
                self.paper.studies.iter().map(again).collect()
            }
        }
    }

    /// The work of `round` under `points`, to be cut into shards; `named` is the paper as the command line called it.
    pub fn sharded(&self, named: &str, round: Round, points: &[Interpretation]) -> Sharded {
        let run = |ran: Ran<'_>| {
            let points = ran.study.as_trials_see(points);
            (ran.study, points)
        };
        let runs = self.studies_in(round).into_iter().map(run).collect();
        let planned = round.planned(self.paper, points);
        Sharded::of_round(named, self.places, self.threads, planned, runs)
    }

    /// The studies that are explored, cut down to `instances` of each group.
    fn studies(&self, instances: impl Fn(&Study) -> u32) -> Vec<Ran<'p>> {
        let ran = |study: &'p Study| {
            let explore = study.explore.as_ref()?;
            let answers =
                explore.stands_for.as_ref().and_then(|name| self.paper.study(name)).unwrap_or(study);
            let mut cut = study.clone().explored(explore, instances(study));
            if self.second_seed {
                cut.seed = study.second_seed?;
            }
            Some(Ran { study: cut, answers })
        };
        self.paper.studies.iter().filter_map(ran).collect()
    }

    /// How many trials each explored study that `is_meant` runs under one interpretation.
    pub fn trials_each(
        &self,
        instances: impl Fn(&Study) -> u32,
        is_meant: impl Fn(&Study) -> bool,
    ) -> Result<Vec<(&'p Study, u64)>, Failure> {
        let mut each = Vec::new();
        for ran in self.studies(instances).into_iter().filter(|ran| is_meant(&ran.study)) {
            let study = self.paper.study(&ran.study.name).expect("it is a study of the paper");
            each.push((study, self.trials_of(&ran.study)?));
        }
        Ok(each)
    }

    /// How many trials `study` runs under one interpretation.
    pub fn trials_of(&self, study: &Study) -> Result<u64, Failure> {
        let points = [default_point(self.paper).for_trials(&study.choices)];
        let built = BuiltStudy::new(study, &points, &self.places.inputs)?;
        Ok(built.units().map(|unit| built.trials(&unit).len() as u64).sum())
    }

    /// Runs and judges `points` in rounds. Studies that need compatible interpretations run under those alone. Where an
    /// outcome is near a flip, it runs once more with more instances.
    pub fn explore(
        &self,
        points: &[Interpretation],
        budget: &ExploreSpec,
        spent: u64,
        verdicts: &Verdicts,
    ) -> Result<Explored, Halt> {
        let (early, late) = (self.studies_in(Round::First), self.studies_in(Round::Compatible));
        self.put_together(Round::First, points)?;
        let (mut found, mut sets) =
            self.judge_run(vec![self.stored(&early, points, Round::First)?], points)?;
        let mut trials = spent;
        if !late.is_empty() {
            let each = self.trials_each(first_instances, |study| budget.is_late(&study.name))?;
            let first = self.weighed(&self.explored(points, &found))?;
            let fits = compatible(self.paper, verdicts, &first);
            let (places, some) = within(budget.trials, &mut trials, &each, points, fits);
            self.put_together(Round::Compatible, &some)?;
            let runs = vec![
                self.stored(&early, points, Round::First)?,
                self.stored(&late, &some, Round::Compatible)?,
            ];
            let (measured, more) = self.judge_run(runs, &some)?;
            sets.extend(more);
            places.into_iter().zip(measured).for_each(|(place, measured)| found[place] = measured);
        }
        let mut all = Explored { trials, ..self.explored(points, &found) };
        let (with_more, trials) = self.once_more(points, budget, verdicts, &all)?;
        all.add(with_more.iter().map(|(place, measured)| (*place, measured)), true);
        Ok(Explored { trials, together: greatest(sets), ..all })
    }

    /// What is found with more instances, by the places of interpretations near a flip, and how many trials it took in all.
    fn once_more(
        &self,
        points: &[Interpretation],
        budget: &ExploreSpec,
        verdicts: &Verdicts,
        first: &Explored,
    ) -> Result<(BTreeMap<usize, Measured>, u64), Halt> {
        if !self.draws_more() {
            return Ok((BTreeMap::new(), first.trials));
        }
        let mut trials = first.trials;
        let mut near = near_a_flip(self.paper, verdicts, &self.weighed(first)?);
        // What parts from the defaults with more instances is seen only beside them.
        near.extend((!near.is_empty()).then_some(0));
        let near = self.alike(points, &near);
        let each = self.trials_each(most_instances, |_| true)?;
        let (places, again) = within(budget.trials, &mut trials, &each, points, near);
        if again.is_empty() {
            return Ok((BTreeMap::new(), trials));
        }
        let (found, _) = self.look(&again, Round::Again)?;
        Ok((places.into_iter().zip(found).collect(), trials))
    }

    /// The places of `points` under which studies run the trials that they run under those at `places`.
    fn alike(&self, points: &[Interpretation], places: &BTreeSet<usize>) -> BTreeSet<usize> {
        let studies = self.studies(most_instances);
        let trials = |place: &usize| -> Vec<String> {
            let seen = studies.iter().map(|ran| points[*place].for_trials(&ran.study.choices));
            seen.map(|point| point.name().to_owned()).collect()
        };
        let known: BTreeSet<Vec<String>> = places.iter().map(trials).collect();
        (0..points.len()).filter(|place| known.contains(&trials(place))).collect()
    }

    /// What was measured under `points`, all in this order.
    pub fn explored(&self, points: &[Interpretation], found: &[Measured]) -> Explored {
        let mut explored = Explored {
            interpretations: points.iter().map(|point| differing(self.paper, point)).collect(),
            studies: self.paper.studies.iter().map(|study| (study.name.clone(), stamp(study))).collect(),
            meant: met_exactly(self.paper),
            ..Explored::default()
        };
        explored.add(found.iter().enumerate(), false);
        explored
    }

    /// What the numbers of an exploration say of every claim.
    pub fn weighed(&self, explored: &Explored) -> Result<Exploration, Failure> {
        let polylines = Polylines::kept_in(&judge::polylines(self.places));
        let found = Exploration::weighed(self.paper, explored, &polylines)?;
        polylines.keep();
        Ok(found)
    }

    /// The measurements of every claim under each of `points` in the trials of `round`, and which claims hold jointly
    /// there.
    pub fn look(
        &self,
        points: &[Interpretation],
        round: Round,
    ) -> Result<(Vec<Measured>, Vec<Together>), Halt> {
        let studies = self.studies_in(round);
        self.put_together(round, points)?;
        Ok(self.judge_run(vec![self.stored(&studies, points, round)?], points)?)
    }

    /// Puts the parts of `round` together, if it is run in shards.
    pub fn put_together(&self, round: Round, points: &[Interpretation]) -> Result<(), Halt> {
        let rounds = self.rounds.as_ref().filter(|_| !points.is_empty());
        rounds.map_or(Ok(()), |rounds| {
            let sharded = self.sharded(&rounds.paper, round, points);
            rounds.put_together(&sharded, round, points.len(), &self.folder)
        })
    }

    /// The records of `studies` under `points`, run where they are not stored.
    fn stored<'r>(
        &self,
        studies: &'r [Ran<'r>],
        points: &[Interpretation],
        round: Round,
    ) -> Result<Vec<(&'r Study, &'r Study, Manifest, Records)>, Failure> {
        let run = |ran: &'r Ran<'r>| {
            let (manifest, records) = self.run(&ran.study, points, round)?;
            Ok((&ran.study, ran.answers, manifest, records))
        };
        studies.iter().map(run).collect()
    }

    /// What every claim asks under each of `points` of these records and the stored default run.
    fn judge_run<'r>(
        &'r self,
        runs: Vec<Vec<(&'r Study, &'r Study, Manifest, Records)>>,
        points: &[Interpretation],
    ) -> Result<(Vec<Measured>, Vec<Together>), Failure> {
        let evidence = judge::read(self.paper, default_point(self.paper), self.places)?;
        self.judge_under(&evidence.with(runs.into_iter().flatten().collect()), points)
    }

    /// What every claim asks of `evidence` under each of `points`.
    pub fn judge_under(
        &self,
        evidence: &Evidence<'_>,
        points: &[Interpretation],
    ) -> Result<(Vec<Measured>, Vec<Together>), Failure> {
        let mut found = Vec::new();
        let mut sets = Vec::new();
        let bar = Bar::default();
        study::runner::Progress::begin(
            &bar,
            &format!("{}: judging interpretations", self.paper.id),
            points.len(),
        );
        for point in points {
            safe_point(stop_flag(), "the trials are kept")?;
            let view = evidence.under(point.clone());
            found.push(measured(&view)?);
            sets.extend(together(&view)?);
            study::runner::Progress::step(&bar);
        }
        study::runner::Progress::end(&bar);
        Ok((found, sets))
    }

    /// Runs what is not stored of `study` under `points` in `round`.
    pub fn run(
        &self,
        study: &Study,
        points: &[Interpretation],
        round: Round,
    ) -> Result<(Manifest, Records), Failure> {
        let folder = self.folder.join(round.name());
        let lock = Lock::take(&folder)?;
        let points = study.as_trials_see(points);
        let bar = Bar::default();
        let whole = options((&points, &bar), self.places, &How::plain(self.threads), &lock);
        // What an exploration left is its own and can be had again.
        let again = session::Again { replaces_damaged: true, ..session::Again::default() };
        let report = session::run(study, &Options { again, ..whole })?;
        let records = read_numbers(&folder, &study.name, &report.manifest.files)?;
        Ok((report.manifest, records))
    }
}

/// The instances that an explored study begins with.
fn first_instances(study: &Study) -> u32 {
    study.explore.as_ref().map_or(0, |explore| explore.instances)
}

/// The instances that it ends with, where an outcome is near a flip or turned.
pub fn most_instances(study: &Study) -> u32 {
    study.explore.as_ref().map_or(0, |explore| explore.more_instances.unwrap_or(explore.instances))
}

/// Those of `points` at these places, in order, for which `budget` has room beside `spent`, which grows by them.
pub fn within(
    budget: u64,
    spent: &mut u64,
    each: &[(&Study, u64)],
    points: &[Interpretation],
    places: BTreeSet<usize>,
) -> (Vec<usize>, Vec<Interpretation>) {
    let mut chosen = Vec::new();
    let mut some = Vec::new();
    let mut needed = 0;
    for place in places {
        some.push(points[place].clone());
        let with = trials(each, &some);
        if with + *spent > budget {
            some.pop();
            continue;
        }
        needed = with;
        chosen.push(place);
    }
    *spent += needed;
    (chosen, some)
}

/// How many trials `points` take, each study running those apart that it tells apart.
fn trials(each: &[(&Study, u64)], points: &[Interpretation]) -> u64 {
    each.iter().map(|(study, count)| study.as_trials_see(points).len() as u64 * count).sum()
}
