//! Names that people see, made from typed keys here and nowhere else, and never taken apart again.

use super::key::{DrawKey, Owner, ReadingKey, SweepKey, Text, TrialKey};
use std::collections::{BTreeMap, BTreeSet};

/// How a study's records are named: what is left out of a name because it goes without saying.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// Problem groups of more than one draw: their draws carry a number.
    pub numbered_groups: BTreeSet<String>,
    /// Whether a contender has more than one seed: its trials then carry a number. What is none of these is a variant.
    pub contenders: BTreeMap<String, bool>,
    /// The option of each reading that a name leaves out.
    pub defaults: BTreeMap<String, String>,
}

impl Names {
    /// `group[/draw][/reading]`.
    pub fn prepared(&self, key: &DrawKey) -> String {
        self.problem(key, None) + &self.reading_part(&key.reading)
    }

    /// `group[/draw][/query]`: what is to be solved, whatever the reading.
    pub fn problem(&self, key: &DrawKey, query: Option<&str>) -> String {
        let mut name = slug(&key.group);
        if self.numbered_groups.contains(&*key.group) {
            name += &format!("/{}", key.draw);
        }
        query.iter().for_each(|query| name += &format!("/{query}"));
        name
    }

    /// `group[/draw][/query]/contender[/sweep][/repeat][/reading]`.
    pub fn trial(&self, key: &TrialKey) -> String {
        let mut name = self.problem(&key.on, key.query.as_deref());
        name += &format!("/{}", slug(&key.contender));
        if !key.sweep.values().is_empty() {
            name += &format!("/{}", sweep(&key.sweep));
        }
        match (self.contenders.get(&*key.contender), key.repeat) {
            (Some(true), repeat) => name += &format!("/{repeat}"),
            (None, repeat @ 1..) => name += &format!("/pair-{}", repeat - 1),
            (Some(false), _) | (None, 0) => {}
        }
        name + &self.reading_part(&key.on.reading)
    }

    /// The name of what an exhibit belongs to.
    pub fn owner(&self, owner: &Owner) -> String {
        match owner {
            Owner::Draw(key) => self.prepared(key),
            Owner::Trial(key) => self.trial(key),
        }
    }

    /// The options that are not the defaults; `default` if there is none.
    pub fn reading(&self, key: &ReadingKey) -> String {
        let is_other =
            |(id, option): &(&str, &str)| self.defaults.get(*id).is_none_or(|usual| usual != option);
        let options = key.options().iter().map(|(id, option)| (&**id, &**option));
        choice(options.filter(is_other))
    }

    fn reading_part(&self, key: &ReadingKey) -> String {
        let is_default =
            |(id, option): &(Text, Text)| self.defaults.get(&**id).is_some_and(|usual| **usual == **option);
        if key.options().iter().all(is_default) { String::new() } else { format!("/{}", self.reading(key)) }
    }
}

/// `reading=option,…` of the options that are not the defaults; `default` if there is none.
pub fn choice<'a>(other: impl Iterator<Item = (&'a str, &'a str)>) -> String {
    let parts: Vec<String> = other.map(|(id, option)| format!("{id}={option}")).collect();
    if parts.is_empty() { "default".to_owned() } else { parts.join(",") }
}

/// `setting=value,…`.
pub fn sweep(key: &SweepKey) -> String {
    let parts: Vec<String> = key.values().iter().map(|(name, value)| format!("{name}={value}")).collect();
    parts.join(",")
}

/// `label` in lower case with everything but letters and digits turned into dashes, `*` spelled out: part of a
/// trial's name that any shell takes as it is.
pub fn slug(label: &str) -> String {
    let spelled = label.to_lowercase().replace('*', "-star").replace('+', "-plus");
    let dashed: String = spelled.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    dashed.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}
