//! Readings: ways to fill in what a paper leaves open, and points in their product.

use super::key::ReadingKey;
use super::name;
use super::spec::{BoundsSpec, Digits, OptionSpec};
use base::settings::{Place, Settings, did_you_mean, none_called};
use std::collections::BTreeMap;
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
    /// Its default was chosen so that claims hold, and is chosen again for each setting of the others.
    pub fitted: bool,
    /// Of options that are numbers: which of them vote.
    pub bounds: Option<BoundsSpec>,
    /// What each option changes.
    pub options: BTreeMap<String, Arc<OptionSpec>>,
    /// Where the options stand, if a file holds them.
    pub place: Option<Place>,
}

impl Reading {
    /// Whether the option called `name` is a way in which the paper may be meant, and not a probe: it cites the paper or a
    /// practice, or is a number within sourced bounds. Of a reading none of whose options is cited, the default alone is.
    pub fn votes(&self, name: &str) -> bool {
        let is_cited = |option: &OptionSpec| {
            let is_within =
                |(bounds, value): (&BoundsSpec, f64)| (bounds.least..=bounds.greatest).contains(&value);
            option.paper.is_some()
                || option.practice.is_some()
                || self.bounds.as_ref().zip(option.value).is_some_and(is_within)
        };
        let option = self.options.get(name);
        option.is_some_and(|option| is_cited(option))
            || (*name == *self.default && !self.options.values().any(|option| is_cited(option)))
    }

    /// Takes from another study's table of the same reading what this one leaves out.
    pub fn complete(&mut self, other: &Self) {
        self.fitted |= other.fitted;
        self.bounds = self.bounds.take().or_else(|| other.bounds.clone());
        for (name, option) in &mut self.options {
            let Some(theirs) = other.options.get(name).filter(|theirs| *theirs != option) else { continue };
            let own = Arc::make_mut(option);
            let first = |own: &mut Option<String>, theirs: &Option<String>| {
                *own = own.take().or_else(|| theirs.clone());
            };
            first(&mut own.paper, &theirs.paper);
            first(&mut own.practice, &theirs.practice);
            own.value = own.value.or(theirs.value);
            own.digits = own.digits.or(theirs.digits);
            for (id, options) in &theirs.only_with {
                own.only_with.entry(id.clone()).or_insert_with(|| options.clone());
            }
            for (name, metric) in &theirs.metric {
                own.metric.entry(name.clone()).or_insert_with(|| metric.clone());
            }
        }
    }

    /// Whether the option called `name` does otherwise than the default to a problem, or to one of these planners and stages.
    ///
    /// # Panics
    /// If there is no such option.
    pub fn touches<'a>(&self, name: &str, mut entries: impl Iterator<Item = &'a str>) -> bool {
        let (own, default) = (&self.options[name], &self.options[&self.default]);
        own.problem != default.problem
            || entries.any(|entry| own.stage.get(entry) != default.stage.get(entry))
    }

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
                return Err(none_called("reading", id, known));
            }
        }
        let mut point = Self::default();
        let mut differs = Vec::new();
        for reading in readings {
            let option = other.get(&reading.id).unwrap_or(&reading.default);
            let change = reading.options.get(option).ok_or_else(|| {
                let known: Vec<&str> = reading.options.keys().map(String::as_str).collect();
                let hint = did_you_mean(option, known.iter().copied());
                format!(
                    "reading `{}` has no option `{option}`{hint}; it has {}",
                    reading.id,
                    known.join(", ")
                )
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

    /// Whether each option stands with those of other readings that it asks for; of readings that are not here it asks nothing.
    pub fn is_asked(&self) -> bool {
        let stands = |(id, options): (&String, &Vec<String>)| {
            self.choices.get(id).is_none_or(|option| options.contains(option))
        };
        self.changes.iter().all(|change| change.option.only_with.iter().all(stands))
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
            let places = place.iter().map(|place| place.inside(&["problem"])).collect();
            settings.overlaid_from(&option.problem, by, places)
        };
        self.changes.iter().fold(settings, laid)
    }

    /// The settings of the planner or stage called `entry` with what the options lay over them.
    #[must_use]
    pub fn over_stage(&self, entry: &str, settings: Settings) -> Settings {
        let laid = |settings: Settings, Change { by, option, place }: &Change| {
            let Some(over) = option.stage.get(entry) else { return settings };
            let places = place.iter().map(|place| place.inside(&["stage", entry])).collect();
            settings.overlaid_from(over, by, places)
        };
        self.changes.iter().fold(settings, laid)
    }

    /// The metric that `name` stands for.
    pub fn metric<'a>(&'a self, name: &'a str) -> &'a str {
        let found = self.changes.iter().find_map(|change| change.option.metric.get(name));
        found.map_or(name, String::as_str)
    }
}

/// The default point, and every point that differs from it in one option and is explored.
///
/// # Errors
/// A reading whose default is not among its options.
pub fn single_options(readings: &[Reading]) -> Result<Vec<ReadingChoice>, String> {
    let mut points = vec![ReadingChoice::new(readings, &BTreeMap::new())?];
    for reading in readings {
        for option in reading.options.keys().filter(|option| **option != reading.default) {
            let point = ReadingChoice::new(readings, &[(reading.id.clone(), option.clone())].into())?;
            points.extend(point.is_asked().then_some(point));
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings() -> Vec<Reading> {
        let option = |metric: &str| OptionSpec {
            metric: BTreeMap::from([("nodes".to_owned(), metric.to_owned())]),
            ..OptionSpec::default()
        };
        vec![Reading {
            id: "nodes".to_owned(),
            why: "not stated".to_owned(),
            default: "opened".to_owned(),
            fitted: false,
            bounds: None,
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
            "there is no reading `node` (did you mean `nodes`?); there are nodes"
        );
    }
}
