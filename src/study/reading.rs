//! Readings: ways to fill in what a paper leaves open, and points in their product.

use super::spec::OptionSpec;
use std::collections::BTreeMap;
use toml::Table;

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
    pub options: BTreeMap<String, OptionSpec>,
}

/// One option of every reading.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Point {
    choices: BTreeMap<String, String>,
    name: String,
    changes: Vec<(String, OptionSpec)>,
}

impl Point {
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
                differs.push(format!("{}={option}", reading.id));
            }
            point.choices.insert(reading.id.clone(), option.clone());
            point.changes.push((format!("reading {}={option}", reading.id), change.clone()));
        }
        point.name = if differs.is_empty() { "default".to_owned() } else { differs.join(",") };
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

    /// What is laid over every problem's settings, with who says so.
    pub fn over_problem(&self) -> impl Iterator<Item = (&Table, &str)> {
        self.changes.iter().map(|(origin, change)| (&change.problem, origin.as_str()))
    }

    /// What is laid over the settings of the planner or stage called `entry`, with who says so.
    pub fn over_stage<'a>(&'a self, entry: &'a str) -> impl Iterator<Item = (&'a Table, &'a str)> {
        self.changes
            .iter()
            .filter_map(move |(origin, change)| change.stage.get(entry).map(|table| (table, origin.as_str())))
    }

    /// The metric that `name` stands for.
    pub fn metric<'a>(&'a self, name: &'a str) -> &'a str {
        let found = self.changes.iter().find_map(|(_, change)| change.metric.get(name));
        found.map_or(name, String::as_str)
    }
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
            options: [("opened", option("opened")), ("closed", option("closed"))]
                .map(|(name, option)| (name.to_owned(), option))
                .into(),
        }]
    }

    #[test]
    fn a_point_is_named_after_what_differs_from_the_defaults() {
        let point = |other: &[(&str, &str)]| {
            let other = other.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
            Point::new(&readings(), &other)
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
