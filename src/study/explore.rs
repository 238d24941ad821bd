//! Which readings of a paper are explored: points in the product of its readings.

use super::checked::Study;
use super::contender::{Contender, StageUse, Sweep};
use super::group::Group;
use super::reading::{Reading, ReadingChoice, single_options};
use super::spec::OptionSpec;
use base::hash::sha256;
use base::seed::{self, Stream};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// How far a paper's readings are explored, besides its defaults, every other option by itself and what contenders depart to.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExplorePaper {
    /// How many settings of readings are drawn from the product of options that vote, at most and without repetition.
    #[schemars(range(max = 10_000))]
    pub sample: u32,
    /// How many trials `replan explore` may run in all, and `replan confirm` once more.
    #[schemars(range(min = 1, max = 1_000_000_000_000_u64))]
    pub trials: u64,
    /// Studies that run only under readings that are compatible with what the paper's studies are fitted to, as those that run
    /// under all say.
    #[serde(default)]
    pub where_compatible: Vec<String>,
    /// Where the paper calls its paths free: results are set apart, and named, if the verifier refuses more than so many per cent of
    /// the paths that a claim looks at.
    #[schemars(range(max = 100))]
    pub refused_above_percent: Option<u32>,
}

impl ExplorePaper {
    /// Whether `study` runs only under readings that are compatible.
    pub fn is_late(&self, study: &Study) -> bool {
        self.where_compatible.contains(&study.name)
    }
}

/// The points to explore: those that must be, and those to be added in this order while the budget lasts.
#[derive(Debug)]
pub struct Points {
    /// The defaults, every other option by itself, and what contenders depart to.
    pub alone: Vec<ReadingChoice>,
    /// Points drawn from the product of options that vote.
    pub drawn: Vec<Vec<ReadingChoice>>,
}

/// The points of `readings`, of which `sample` settings are drawn from `seed` with equal chance for every voting option; contenders
/// depart to those in `departures`, under which alone their trials count.
///
/// Each setting of the readings that are not fitted stands with every option of those that are.
///
/// # Errors
/// A reading whose default is not among its options.
pub fn points(
    readings: &[Reading],
    departures: Vec<ReadingChoice>,
    sample: u32,
    seed: u64,
) -> Result<Points, String> {
    let mut known = BTreeSet::new();
    let mut new = |points: Vec<ReadingChoice>| -> Vec<ReadingChoice> {
        points.into_iter().filter(|point| known.insert(point.name().to_owned())).collect()
    };
    let mut alone = Vec::new();
    for point in single_options(readings)?.into_iter().chain(departures) {
        alone.extend(new(with_fitted(readings, &point)?));
    }
    let moving: Vec<&Reading> = readings.iter().filter(|reading| !reading.fitted).collect();
    let voting = |reading: &&Reading| reading.options.keys().filter(|name| reading.votes(name)).count();
    let product = moving.iter().map(voting).fold(1_usize, usize::saturating_mul);
    let (mut drawn, mut seen, mut stream) = (Vec::new(), BTreeSet::new(), seed::stream(seed));
    while seen.len() < product && drawn.len() < sample as usize {
        let choices = draw(&moving, &mut stream);
        if seen.insert(choices.clone()) {
            let points = new(with_fitted(readings, &ReadingChoice::new(readings, &choices)?)?);
            if !points.is_empty() {
                drawn.push(points);
            }
        }
    }
    Ok(Points { alone, drawn })
}

/// A voting option of each reading; the default of one that none votes in.
fn draw(readings: &[&Reading], stream: &mut Stream) -> BTreeMap<String, String> {
    let pick = |reading: &&Reading| {
        let voting: Vec<&String> = reading.options.keys().filter(|name| reading.votes(name)).collect();
        let option = match voting.len() {
            0 => &reading.default,
            count => voting[stream.random_range(0..count)],
        };
        (reading.id.clone(), option.clone())
    };
    readings.iter().map(pick).collect()
}

/// `point` with every option of the fitted readings that stands with the others.
fn with_fitted(readings: &[Reading], point: &ReadingChoice) -> Result<Vec<ReadingChoice>, String> {
    let mut all = vec![point.choices().clone()];
    for reading in readings.iter().filter(|reading| reading.fitted) {
        let each = |choices: &BTreeMap<String, String>| {
            let with = |option: &String| {
                let mut choices = choices.clone();
                choices.insert(reading.id.clone(), option.clone());
                choices
            };
            // The option in hand comes first, so that a point stands before its variations.
            let own = choices[&reading.id].clone();
            let others = reading.options.keys().filter(|option| **option != own);
            std::iter::once(with(&own)).chain(others.map(with)).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(each).collect();
    }
    let points: Result<Vec<_>, _> = all.iter().map(|choices| ReadingChoice::new(readings, choices)).collect();
    Ok(points?.into_iter().filter(ReadingChoice::is_asked).collect())
}

/// A hash of all that trials of `study` depend on under any reading, as its spec and the program say; words and figures do not count.
pub fn stamp(study: &Study) -> String {
    let stage = |stage: &StageUse| {
        format!("{} {} {:?}", stage.entry.name, stage.entry.revision, stage.settings.table())
    };
    let group = |group: &Group| {
        let (family, settings) = (group.family, group.settings.table());
        format!("{} {:?} {} {} {settings:?}", group.label, group.draw, family.name, family.revision)
    };
    let contender = |contender: &Contender| {
        let stages: Vec<String> = contender.stages.iter().map(stage).collect();
        format!("{} {stages:?} {:?}", contender.label, contender.departs)
    };
    let option = |(name, option): (&String, &Arc<OptionSpec>)| {
        format!("{name} {:?} {:?} {:?} {:?}", option.problem, option.stage, option.metric, option.digits)
    };
    let reading = |reading: &Reading| {
        let options: Vec<String> = reading.options.iter().map(option).collect();
        format!("{} {} {options:?}", reading.id, reading.default)
    };
    let sweeps = study.sweeps.iter().map(swept).collect::<Vec<_>>().join(", ");
    let text = format!(
        "{} {} {} {:?} {} {} {:?} {:?} {:?}\n{:?}\n{:?}\n[{sweeps}]\n{:?}",
        study.paper,
        study.name,
        study.seed,
        study.second_seed,
        study.task.name,
        study.task.revision,
        study.task_settings.table(),
        study.budget,
        study.explore,
        study.groups.iter().map(group).collect::<Vec<_>>(),
        study.contenders.iter().map(contender).collect::<Vec<_>>(),
        study.readings.iter().map(reading).collect::<Vec<_>>(),
    );
    sha256(text.as_bytes())[..16].to_owned()
}

/// A sweep as stamps always had it: where it stands is no part of it.
fn swept(Sweep { key, of, values, .. }: &Sweep) -> String {
    format!("Sweep {{ key: {key:?}, of: {of:?}, values: {values:?} }}")
}

#[cfg(test)]
mod tests {
    use super::super::spec::BoundsSpec;
    use super::*;

    /// A reading with the options 0 to `count - 1`, of which those below `cited` cite the paper.
    fn reading(id: &str, count: usize, cited: usize, fitted: bool) -> Reading {
        let option = |i: usize| {
            let paper = (i < cited).then(|| "section 1".to_owned());
            (i.to_string(), Arc::new(OptionSpec { paper, ..OptionSpec::default() }))
        };
        Reading {
            place: None,
            id: id.to_owned(),
            why: String::new(),
            default: "0".to_owned(),
            fitted,
            bounds: None,
            options: (0..count).map(option).collect(),
        }
    }

    fn names(points: &[ReadingChoice]) -> Vec<&str> {
        points.iter().map(ReadingChoice::name).collect()
    }

    #[test]
    fn a_sample_of_the_product_repeats_nothing_and_holds_no_probe() {
        let readings = [reading("a", 3, 2, false), reading("b", 4, 4, false), reading("c", 2, 0, false)];
        for seed in 0..20 {
            let found = points(&readings, Vec::new(), 5, seed).unwrap();
            let alone = ["default", "a=1", "a=2", "b=1", "b=2", "b=3", "c=1"];
            assert_eq!(names(&found.alone), alone, "seed {seed}");
            let all: Vec<ReadingChoice> = points(&readings, Vec::new(), 1000, seed).unwrap().drawn.concat();
            // Of 2 x 4 settings that vote, 5 are the defaults or one option by itself.
            assert_eq!(
                names(&all).iter().collect::<BTreeSet<_>>().len(),
                3,
                "seed {seed}: {:?}",
                names(&all)
            );
            assert!(names(&all).iter().all(|name| !name.contains("a=2") && !name.contains("c=1")));
        }
        let some = |seed| points(&readings, Vec::new(), 2, seed).unwrap().drawn.concat();
        assert!((1..20).any(|seed| some(seed) != some(0)), "every seed draws the same");
    }

    #[test]
    fn a_fitted_reading_stands_with_every_setting_of_the_others() {
        let readings = [reading("a", 2, 2, false), reading("f", 3, 3, true)];
        let found = points(&readings, Vec::new(), 9, 1).unwrap();
        assert_eq!(names(&found.alone), ["default", "f=1", "f=2", "a=1", "a=1,f=1", "a=1,f=2"]);
        assert!(found.drawn.is_empty());
    }

    #[test]
    fn an_option_is_asked_with_those_alone_that_it_names() {
        let only = |reading: &mut Reading, id: &str| {
            let only_with = [(id.to_owned(), vec!["1".to_owned()])].into();
            let paper = Some("section 1".to_owned());
            let option = OptionSpec { paper, only_with, ..OptionSpec::default() };
            reading.options.insert("2".to_owned(), Arc::new(option));
        };
        let mut fitted = reading("f", 3, 3, true);
        only(&mut fitted, "a");
        let readings = [reading("a", 3, 3, false), fitted.clone()];
        let found = points(&readings, Vec::new(), 9, 1).unwrap();
        assert_eq!(names(&found.alone), ["default", "f=1", "a=1", "a=1,f=1", "a=1,f=2", "a=2", "a=2,f=1"]);
        let mut moving = reading("b", 3, 3, false);
        only(&mut moving, "a");
        let all = points(&[reading("a", 2, 2, false), moving], Vec::new(), 99, 1).unwrap();
        assert_eq!(names(&all.alone), ["default", "a=1", "b=1"]);
        let drawn: BTreeSet<String> =
            all.drawn.concat().iter().map(|point| point.name().to_owned()).collect();
        assert_eq!(drawn, ["a=1,b=1", "a=1,b=2"].map(str::to_owned).into());
        // A study without the other reading asks for all options.
        assert_eq!(points(&[fitted], Vec::new(), 9, 1).unwrap().alone.len(), 3);
    }

    #[test]
    fn an_option_votes_by_its_words_or_within_bounds_and_a_reading_without_any_keeps_its_default() {
        let votes = |reading: &Reading| -> Vec<String> {
            reading.options.keys().filter(|name| reading.votes(name)).cloned().collect()
        };
        assert_eq!(votes(&reading("a", 3, 2, false)), ["0", "1"]);
        assert_eq!(votes(&reading("a", 3, 0, false)), ["0"]);
        let mut numbers = reading("a", 4, 0, false);
        numbers.bounds = Some(BoundsSpec { least: 1.0, greatest: 2.0, source: "a handbook".to_owned() });
        for (name, option) in &mut numbers.options {
            let value = name.parse().ok();
            *option = Arc::new(OptionSpec { value, ..OptionSpec::default() });
        }
        assert_eq!(votes(&numbers), ["1", "2"]);
    }
}
