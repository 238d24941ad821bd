//! Readings: ways to fill in what a paper leaves open, and points in their product.

use super::key::ReadingKey;
use super::name;
use super::spec::{Digits, OptionSpec};
use base::seed::{self, Stream};
use base::settings::{Place, Settings};
use rand::RngExt as _;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// One axis of readings.
#[derive(Debug, Clone)]
pub struct Reading {
    /// Its name.
    pub id: String,
    /// What the paper leaves open, and why the default was taken.
    pub why: String,
    /// The option taken unless asked otherwise.
    pub default: String,
    /// What each option changes.
    pub options: BTreeMap<String, Arc<OptionSpec>>,
    /// Where the options stand, if a file holds them.
    pub place: Option<Place>,
}

impl Reading {
    /// Whether any option changes a problem or a contender; otherwise no trial depends on it.
    pub fn touches_trials(&self) -> bool {
        self.options.values().any(|option| !option.problem.is_empty() || !option.stage.is_empty())
    }
}

/// One option of every reading.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadingChoice {
    choices: BTreeMap<String, String>,
    name: String,
    changes: Vec<Change>,
}

/// What an option changes, who says so, and where.
#[derive(Debug, Clone, PartialEq)]
struct Change {
    by: String,
    option: Arc<OptionSpec>,
    place: Option<Place>,
}

impl ReadingChoice {
    /// The point that takes each reading's default, but for the choices in `other`.
    ///
    /// Its name lists only what differs from the defaults, in the order of the readings' names; the default
    /// point is called `default`.
    ///
    /// # Errors
    /// A message that names the unknown reading or option and those that exist.
    pub fn new(readings: &[Reading], other: &BTreeMap<String, String>) -> Result<Self, String> {
        for id in other.keys() {
            if !readings.iter().any(|reading| reading.id == *id) {
                let known: Vec<&str> = readings.iter().map(|reading| reading.id.as_str()).collect();
                return Err(format!("there is no reading `{id}`; the readings are {}", known.join(", ")));
            }
        }
        let mut point = Self::default();
        let mut differs = Vec::new();
        for reading in readings {
            let option = other.get(&reading.id).unwrap_or(&reading.default);
            let change = reading.options.get(option).ok_or_else(|| {
                let known: Vec<&str> = reading.options.keys().map(String::as_str).collect();
                format!("reading `{}` has no option `{option}`; it has {}", reading.id, known.join(", "))
            })?;
            if *option != reading.default {
                differs.push((reading.id.as_str(), option.as_str()));
            }
            point.choices.insert(reading.id.clone(), option.clone());
            let place = reading.place.as_ref().map(|place| place.inside(&[option]));
            let by = format!("reading {}={option}", reading.id);
            point.changes.push(Change { by, option: change.clone(), place });
        }
        point.name = name::choice(differs.into_iter());
        Ok(point)
    }

    /// The same choices for those readings alone: the point of a study that has no others.
    #[must_use]
    pub fn within(&self, readings: &[Reading]) -> Self {
        let is_had = |id: &String| readings.iter().any(|reading| reading.id == *id);
        let choices = self.choices.iter().filter(|(id, _)| is_had(id));
        Self::new(readings, &choices.map(|(id, option)| (id.clone(), option.clone())).collect())
            .expect("readings of one name have the same options in every study of a paper")
    }

    /// Its name in records.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The option taken of each reading.
    pub fn choices(&self) -> &BTreeMap<String, String> {
        &self.choices
    }

    /// The point of `readings` under which the same trials run: readings that touch no trial are at their defaults.
    ///
    /// # Panics
    /// As [`within`](Self::within).
    #[must_use]
    pub fn for_trials(&self, readings: &[Reading]) -> Self {
        let mut moving = self.within(readings).choices;
        moving.retain(|id, _| readings.iter().any(|reading| reading.id == *id && reading.touches_trials()));
        Self::new(readings, &moving).expect("the options were just found")
    }

    /// What names this choice in the records of a study with these readings: the option of each that touches trials.
    pub fn key(&self, readings: &[Reading]) -> ReadingKey {
        let moving = readings.iter().filter(|reading| reading.touches_trials());
        let option =
            |reading: &Reading| self.choices.get(&reading.id).unwrap_or(&reading.default).as_str().into();
        ReadingKey::new(moving.map(|reading| (reading.id.as_str().into(), option(reading))).collect())
    }

    /// How printed digits end under this point, if a reading says so.
    pub fn digits(&self) -> Option<Digits> {
        self.changes.iter().find_map(|change| change.option.digits)
    }

    /// The settings of a problem with what the options lay over them.
    #[must_use]
    pub fn over_problem(&self, settings: Settings) -> Settings {
        let laid = |settings: Settings, Change { by, option, place }: &Change| {
            let place = place.as_ref().map(|place| place.inside(&["problem"]));
            settings.overlaid_from(&option.problem, by, place)
        };
        self.changes.iter().fold(settings, laid)
    }

    /// The settings of the planner or stage called `entry` with what the options lay over them.
    #[must_use]
    pub fn over_stage(&self, entry: &str, settings: Settings) -> Settings {
        let laid = |settings: Settings, Change { by, option, place }: &Change| {
            let Some(over) = option.stage.get(entry) else { return settings };
            let place = place.as_ref().map(|place| place.inside(&["stage", entry]));
            settings.overlaid_from(over, by, place)
        };
        self.changes.iter().fold(settings, laid)
    }

    /// The metric that `name` stands for.
    pub fn metric<'a>(&'a self, name: &'a str) -> &'a str {
        let found = self.changes.iter().find_map(|change| change.option.metric.get(name));
        found.map_or(name, String::as_str)
    }
}

/// The default point, every point that differs from it in one option, and `sample` further points of the product.
///
/// The further points are drawn from `seed`, every reading's option with equal chance, without repetition; there are
/// fewer if the product is exhausted.
///
/// # Errors
/// A reading whose default is not among its options.
pub fn explored(readings: &[Reading], sample: u32, seed: u64) -> Result<Vec<ReadingChoice>, String> {
    let mut points = vec![ReadingChoice::new(readings, &BTreeMap::new())?];
    for reading in readings {
        for option in reading.options.keys().filter(|option| **option != reading.default) {
            points.push(ReadingChoice::new(readings, &[(reading.id.clone(), option.clone())].into())?);
        }
    }
    let product = readings.iter().fold(1_usize, |all, reading| all.saturating_mul(reading.options.len()));
    let wanted = points.len().saturating_add(sample as usize).min(product);
    let mut known: BTreeSet<String> = points.iter().map(|point| point.name.clone()).collect();
    let mut stream = seed::stream(seed);
    while points.len() < wanted {
        let point = drawn(readings, &mut stream)?;
        if known.insert(point.name.clone()) {
            points.push(point);
        }
    }
    Ok(points)
}

fn drawn(readings: &[Reading], stream: &mut Stream) -> Result<ReadingChoice, String> {
    let pick = |reading: &Reading, stream: &mut Stream| {
        let index = stream.random_range(0..reading.options.len());
        (
            reading.id.clone(),
            reading.options.keys().nth(index).expect("the index is below the length").clone(),
        )
    };
    let choices = readings.iter().map(|reading| pick(reading, stream)).collect();
    ReadingChoice::new(readings, &choices)
}

#[cfg(test)]
mod tests {
    use super::*;
    use toml::Table;

    #[test]
    fn a_sample_of_the_product_repeats_nothing_and_stops_where_the_product_does() {
        let reading = |id: &str, count: usize, moves: bool| Reading {
            id: id.to_owned(),
            why: String::new(),
            default: "0".to_owned(),
            options: (0..count)
                .map(|i| {
                    let problem = if moves {
                        toml::toml! { key = 1 }
                    } else {
                        Table::new()
                    };
                    (i.to_string(), Arc::new(OptionSpec { problem, ..OptionSpec::default() }))
                })
                .collect(),
            place: None,
        };
        let readings = [reading("a", 3, true), reading("b", 4, false), reading("c", 2, true)];
        let names = |sample, seed| {
            let points = explored(&readings, sample, seed).unwrap();
            points.iter().map(|point| point.name().to_owned()).collect::<Vec<_>>()
        };
        let seven = names(0, 9);
        assert_eq!(seven, ["default", "a=1", "a=2", "b=1", "b=2", "b=3", "c=1"]);
        for seed in 0..20 {
            let some = names(5, seed);
            assert_eq!((&some[..7], some.len()), (&seven[..], 12), "seed {seed}");
            assert_eq!(some.iter().collect::<BTreeSet<_>>().len(), 12, "seed {seed}: {some:?}");
            assert_eq!(names(1000, seed).len(), 24, "seed {seed}");
        }
        assert_ne!(names(5, 1), names(5, 2));
        let point = ReadingChoice::new(
            &readings,
            &[("b", "2"), ("c", "1")].map(|(a, b)| (a.into(), b.into())).into(),
        );
        let point = point.unwrap();
        assert_eq!(point.for_trials(&readings).name(), "c=1");
        assert_eq!(point.within(&readings[..2]).name(), "b=2");
    }

    fn readings() -> Vec<Reading> {
        let option = |metric: &str| OptionSpec {
            metric: BTreeMap::from([("nodes".to_owned(), metric.to_owned())]),
            ..OptionSpec::default()
        };
        vec![Reading {
            id: "nodes".to_owned(),
            why: "not stated".to_owned(),
            default: "opened".to_owned(),
            options: [("opened", option("opened")), ("closed", option("closed"))]
                .map(|(name, option)| (name.to_owned(), Arc::new(option)))
                .into(),
            place: None,
        }]
    }

    #[test]
    fn a_point_is_named_after_what_differs_from_the_defaults() {
        let point = |other: &[(&str, &str)]| {
            let other = other.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
            ReadingChoice::new(&readings(), &other)
        };
        assert_eq!(point(&[]).unwrap().name(), "default");
        assert_eq!(point(&[("nodes", "opened")]).unwrap().name(), "default");
        let closed = point(&[("nodes", "closed")]).unwrap();
        assert_eq!((closed.name(), closed.metric("nodes")), ("nodes=closed", "closed"));
        assert_eq!(closed.metric("opened"), "opened");
        assert_eq!(
            point(&[("nodes", "all")]).unwrap_err(),
            "reading `nodes` has no option `all`; it has closed, opened"
        );
        assert_eq!(
            point(&[("node", "all")]).unwrap_err(),
            "there is no reading `node`; the readings are nodes"
        );
    }
}
