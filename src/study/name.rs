//! Names that people see, made from typed keys here and nowhere else, and never parsed again.

pub use base::slug::slug;

use super::key::{InstanceKey, InterpretationKey, Owner, SweepKey, SweepValue, Text, TrialKey};
use std::collections::{BTreeMap, BTreeSet};

/// How a study's records are named: what is left out of a name because it goes without saying.
#[derive(Debug, Clone, Default)]
pub struct Names {
    /// Problem groups: the instances of one that has more than one carry a number.
    groups: BTreeMap<String, Labelled>,
    /// Contenders: the trials of one that has more than one seed carry a number. What is none of these is a variant.
    contenders: BTreeMap<String, Labelled>,
    /// The option of each choice that a name leaves out.
    defaults: BTreeMap<String, String>,
}

/// A label as names have it.
#[derive(Debug, Clone)]
struct Labelled {
    slug: String,
    is_numbered: bool,
}

impl Names {
    /// From the labels of groups and contenders, each with whether it is numbered, and the default of each interpretation.
    pub fn new<'a>(
        groups: impl Iterator<Item = (&'a str, bool)>,
        contenders: impl Iterator<Item = (&'a str, bool)>,
        defaults: impl Iterator<Item = (&'a str, &'a str)>,
    ) -> Self {
        let labelled = |(label, is_numbered): (&str, bool)| {
            (label.to_owned(), Labelled { slug: slug(label), is_numbered })
        };
        Self {
            groups: groups.map(labelled).collect(),
            contenders: contenders.map(labelled).collect(),
            defaults: defaults.map(|(id, option)| (id.to_owned(), option.to_owned())).collect(),
        }
    }

    /// `group[/sweep][/instance][/interpretation]`.
    pub fn preprocessing(&self, key: &InstanceKey) -> String {
        self.problem(key, None) + &self.interpretation_part(&key.interpretation)
    }

    /// `group[/sweep][/instance][/query]`: the problem, whatever the interpretation.
    pub fn problem(&self, key: &InstanceKey, query: Option<&str>) -> String {
        let group = self.groups.get(&*key.group);
        let label = group.map_or_else(|| slug(&key.group), |group| group.slug.clone());
        let mut name = self::group(&label, &key.sweep);
        if group.is_some_and(|group| group.is_numbered) {
            name += &format!("/{}", key.instance);
        }
        if let Some(query) = query {
            name += &format!("/{query}");
        }
        name
    }

    /// `group[/sweep][/instance][/query]/contender[/sweep][/repeat][/interpretation]`: sweeps over settings of the problem, then the others.
    pub fn trial(&self, key: &TrialKey) -> String {
        let mut name = self.problem(&key.on, key.query.as_deref());
        let contender = self.contenders.get(&*key.contender);
        name.push('/');
        name += &contender.map_or_else(|| slug(&key.contender), |contender| contender.slug.clone());
        let swept = key.sweep.after(&key.on.sweep);
        if !swept.is_empty() {
            name += &format!("/{}", sweep(&swept));
        }
        match (contender.map(|contender| contender.is_numbered), key.repeat) {
            (Some(true), repeat) => name += &format!("/{repeat}"),
            (None, repeat @ 1..) => name += &format!("/pair-{}", repeat - 1),
            (Some(false), _) | (None, 0) => {}
        }
        name + &self.interpretation_part(&key.on.interpretation)
    }

    /// The name of what a trace belongs to.
    pub fn owner(&self, owner: &Owner) -> String {
        match owner {
            Owner::Instance(key) => self.preprocessing(key),
            Owner::Trial(key) => self.trial(key),
        }
    }

    /// The options that are not the defaults; `default` if there is none.
    pub fn interpretation(&self, key: &InterpretationKey) -> String {
        let is_other =
            |(id, option): &(&str, &str)| self.defaults.get(*id).is_none_or(|usual| usual != option);
        let options = key.options().iter().map(|(id, option)| (&**id, &**option));
        choice(options.filter(is_other))
    }

    fn interpretation_part(&self, key: &InterpretationKey) -> String {
        let is_default =
            |(id, option): &(Text, Text)| self.defaults.get(&**id).is_some_and(|usual| **usual == **option);
        if key.options().iter().all(is_default) {
            String::new()
        } else {
            format!("/{}", self.interpretation(key))
        }
    }
}

/// `interpretation=option,…` of the options that are not the defaults; `default` if there is none.
pub fn choice<'a>(other: impl Iterator<Item = (&'a str, &'a str)>) -> String {
    let parts: Vec<String> = other.map(|(id, option)| format!("{id}={option}")).collect();
    if parts.is_empty() { "default".to_owned() } else { parts.join(",") }
}

/// What the problem group called `label` is called at a point of the sweeps over it: `label[/setting=value,…]`.
pub fn group(label: &str, at: &SweepKey) -> String {
    if at.is_empty() { label.to_owned() } else { format!("{label}/{}", sweep(at)) }
}

/// `setting=value,…`.
pub fn sweep(key: &SweepKey) -> String {
    let parts: Vec<String> = key.values().iter().map(sweep_value).collect();
    parts.join(",")
}

/// `setting=value`.
pub fn sweep_value((setting, value): &(Text, SweepValue)) -> String {
    format!("{setting}={value}")
}

/// Of the queries of one instance, those whose name another before them has, by their place: records could not tell them apart.
pub fn repeated<'a>(queries: impl Iterator<Item = &'a str>) -> Vec<(usize, String)> {
    let mut seen = BTreeSet::new();
    let again = queries.enumerate().filter(|(_, name)| !seen.insert(*name));
    let refused = |(place, name): (usize, &str)| {
        let named = if name.is_empty() { "without a name".to_owned() } else { format!("called `{name}`") };
        (place, format!("query {} is the second {named}; one name each is accepted", place + 1))
    };
    again.map(refused).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    /// One numbered group and one that is not, two contenders, two interpretations.
    fn names() -> Names {
        Names::new(
            [("Maps, drawn", true), ("W1", false)].into_iter(),
            [("A*", false), ("Chaos", true)].into_iter(),
            [("corners", "allow"), ("ties", "fifo")].into_iter(),
        )
    }

    fn key(group: &str, instance: u32, corners: &str, contender: &str, repeat: u32) -> TrialKey {
        let options = [("corners", corners), ("ties", "fifo")];
        let interpretation =
            InterpretationKey::new(options.map(|(id, option)| (id.into(), option.into())).into());
        let on = Arc::new(InstanceKey {
            group: group.into(),
            sweep: SweepKey::default(),
            instance,
            interpretation,
        });
        TrialKey { on, query: None, contender: contender.into(), sweep: SweepKey::default(), repeat }
    }

    #[test]
    fn a_name_leaves_out_what_goes_without_saying() {
        let sweep = SweepKey::new(vec![
            ("weight".into(), SweepValue::Real(12.0)),
            ("samples".into(), SweepValue::Whole(100)),
            ("kind".into(), SweepValue::Text("a".into())),
        ]);
        let swept =
            TrialKey { sweep, query: Some("7".into()), ..key("Maps, drawn", 3, "forbid", "Chaos", 2) };
        for (key, name) in [
            (key("W1", 0, "allow", "A*", 0), "w1/a-star"),
            (key("Maps, drawn", 3, "allow", "A*", 0), "maps-drawn/3/a-star"),
            (key("W1", 0, "allow", "Chaos", 0), "w1/chaos/0"),
            (key("W1", 0, "forbid", "A*", 0), "w1/a-star/corners=forbid"),
            (key("W1", 0, "allow", "a variant", 0), "w1/a-variant"),
            (key("W1", 0, "allow", "a variant", 1), "w1/a-variant/pair-0"),
            (swept, "maps-drawn/3/7/chaos/weight=12.0,samples=100,kind=a/2/corners=forbid"),
        ] {
            assert_eq!(names().trial(&key), name);
        }
        let drawn = key("Maps, drawn", 3, "forbid", "A*", 0);
        assert_eq!(names().preprocessing(&drawn.on), "maps-drawn/3/corners=forbid");
        assert_eq!(names().problem(&drawn.on, Some("7")), "maps-drawn/3/7");
        assert_eq!(names().interpretation(&drawn.on.interpretation), "corners=forbid");
        assert_eq!(names().interpretation(&key("W1", 0, "allow", "A*", 0).on.interpretation), "default");
    }
}
