//! The name of a record: typed columns, never a text that is parsed again.
//!
//! Labels are shared, not copied: a study has millions of keys and few labels.

use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::fmt;
use std::sync::Arc;

/// A label that many keys share.
pub type Text = Arc<str>;

/// The option taken of each choice that touches trials, defaults written out, in the order of the study's interpretations.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct InterpretationKey(Arc<[(Text, Text)]>);

impl InterpretationKey {
    /// The key of these options, by choice.
    pub fn new(options: Vec<(Text, Text)>) -> Self {
        Self(options.into())
    }

    /// Each interpretation and the option taken.
    pub fn options(&self) -> &[(Text, Text)] {
        &self.0
    }
}

impl Ord for InterpretationKey {
    fn cmp(&self, other: &Self) -> Ordering {
        if Arc::ptr_eq(&self.0, &other.0) { Ordering::Equal } else { self.0.cmp(&other.0) }
    }
}

impl PartialOrd for InterpretationKey {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What names a preprocessed object: an instance of a problem group, at a point of the sweeps over its settings, under an interpretation.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct InstanceKey {
    /// The problem group's label.
    pub group: Text,
    /// The values of the sweeps over its settings; empty without such sweeps.
    #[serde(default, skip_serializing_if = "SweepKey::is_empty")]
    pub sweep: SweepKey,
    /// Which independent instance of the group: the unit of replication.
    pub instance: u32,
    /// The interpretation.
    pub interpretation: InterpretationKey,
}

/// One value along a sweep, as the study writes it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(untagged)]
pub enum SweepValue {
    /// Yes or no.
    Flag(bool),
    /// A whole number.
    Whole(i64),
    /// A number.
    Real(f64),
    /// A word.
    Text(Text),
}

impl SweepValue {
    /// The number, if it is one.
    pub fn as_f64(&self) -> Option<f64> {
        match self {
            Self::Whole(whole) => Some(*whole as f64),
            Self::Real(real) => Some(*real),
            Self::Flag(_) | Self::Text(_) => None,
        }
    }
}

/// As TOML writes it, words without quotes.
impl fmt::Display for SweepValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag(flag) => flag.fmt(f),
            Self::Whole(whole) => whole.fmt(f),
            Self::Real(real) => toml::Value::Float(*real).fmt(f),
            Self::Text(text) => text.fmt(f),
        }
    }
}

impl Ord for SweepValue {
    fn cmp(&self, other: &Self) -> Ordering {
        let kind = |value: &Self| match value {
            Self::Flag(_) => 0,
            Self::Whole(_) => 1,
            Self::Real(_) => 2,
            Self::Text(_) => 3,
        };
        match (self, other) {
            (Self::Flag(a), Self::Flag(b)) => a.cmp(b),
            (Self::Whole(a), Self::Whole(b)) => a.cmp(b),
            (Self::Real(a), Self::Real(b)) => a.total_cmp(b),
            (Self::Text(a), Self::Text(b)) => a.cmp(b),
            _ => kind(self).cmp(&kind(other)),
        }
    }
}

impl PartialOrd for SweepValue {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for SweepValue {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for SweepValue {}

/// The value of each sweep, in the order of the study's sweeps; empty without sweeps.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SweepKey(Arc<[(Text, SweepValue)]>);

impl SweepKey {
    /// The key of these values, by the setting that each sweep fills.
    pub fn new(values: Vec<(Text, SweepValue)>) -> Self {
        Self(values.into())
    }

    /// Whether there are no sweeps.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Its values, followed by those of `other`.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => Self(self.0.iter().chain(&*other.0).cloned().collect()),
        }
    }

    /// Its values behind those of `first`, with which it begins.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        if first.is_empty() { self.clone() } else { Self(self.0[first.0.len()..].into()) }
    }

    /// Each sweep's setting and its value.
    pub fn values(&self) -> &[(Text, SweepValue)] {
        &self.0
    }

    /// Whether it is the same point. Most trials share one, which is found out at once.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self == other
    }

    /// It without the values of the settings that `is_dropped`.
    #[must_use]
    pub fn without(&self, is_dropped: impl Fn(&str) -> bool) -> Self {
        if !self.0.iter().any(|(name, _)| is_dropped(name)) {
            return self.clone();
        }
        Self(self.0.iter().filter(|(name, _)| !is_dropped(name)).cloned().collect())
    }

    /// Whether it has every value of `part`.
    pub fn has(&self, part: &Self) -> bool {
        self.is_same(part) || part.0.iter().all(|value| self.0.contains(value))
    }

    /// The value of the sweep over the setting `key`.
    pub fn value(&self, key: &str) -> Option<&SweepValue> {
        self.0.iter().find(|(name, _)| **name == *key).map(|(_, value)| value)
    }
}

impl Ord for SweepKey {
    fn cmp(&self, other: &Self) -> Ordering {
        if Arc::ptr_eq(&self.0, &other.0) { Ordering::Equal } else { self.0.cmp(&other.0) }
    }
}

impl PartialOrd for SweepKey {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What names a trial.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrialKey {
    /// The preprocessed object that it ran on.
    pub on: Arc<InstanceKey>,
    /// The query; `None` where an instance has one query only.
    pub query: Option<Text>,
    /// The contender's label, or the variant's in a study that has variants.
    pub contender: Text,
    /// The sweeps' values: those over the problem's settings first.
    pub sweep: SweepKey,
    /// Which of the contender's seeds.
    pub repeat: u32,
}

impl Ord for TrialKey {
    fn cmp(&self, other: &Self) -> Ordering {
        let on = || if Arc::ptr_eq(&self.on, &other.on) { Ordering::Equal } else { self.on.cmp(&other.on) };
        on().then_with(|| self.query.cmp(&other.query))
            .then_with(|| self.contender.cmp(&other.contender))
            .then_with(|| self.sweep.cmp(&other.sweep))
            .then(self.repeat.cmp(&other.repeat))
    }
}

impl PartialOrd for TrialKey {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The columns of keys that a study adds to those that every study has.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct KeyColumns {
    /// Each setting of problems that is swept, and one of its values: the others are of the same kind.
    pub posed: Vec<(Text, SweepValue)>,
    /// The setting of each other sweep, and the planner or stage whose setting it is.
    pub sweeps: Vec<(Text, Text)>,
    /// Each choice that touches trials.
    pub choices: Vec<Text>,
}

/// The owner of a trace. Trials come after the object that they ran on.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Owner {
    /// A preprocessed object.
    Instance(Arc<InstanceKey>),
    /// One run of a contender on a query.
    Trial(TrialKey),
}

impl Owner {
    /// The instance that it belongs to.
    pub fn on(&self) -> &Arc<InstanceKey> {
        match self {
            Self::Instance(key) => key,
            Self::Trial(key) => &key.on,
        }
    }

    /// The same on another instance.
    #[must_use]
    pub fn moved_to(self, on: Arc<InstanceKey>) -> Self {
        match self {
            Self::Instance(_) => Self::Instance(on),
            Self::Trial(key) => Self::Trial(TrialKey { on, ..key }),
        }
    }
}

impl From<&Arc<InstanceKey>> for Owner {
    fn from(key: &Arc<InstanceKey>) -> Self {
        Self::Instance(key.clone())
    }
}

impl From<&TrialKey> for Owner {
    fn from(key: &TrialKey) -> Self {
        Self::Trial(key.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_has_its_parts_and_loses_what_is_dropped() {
        let of = |values: &[(&str, i64)]| {
            let value = |(name, whole): &(&str, i64)| ((*name).into(), SweepValue::Whole(*whole));
            SweepKey::new(values.iter().map(value).collect())
        };
        let whole = of(&[("roadmap", 2), ("samples", 100)]);
        let pooled = whole.without(|name| name == "roadmap");
        assert_eq!(pooled, of(&[("samples", 100)]));
        assert!(whole.has(&pooled) && whole.has(&whole) && whole.has(&SweepKey::default()));
        assert!(!pooled.has(&whole) && !whole.has(&of(&[("samples", 200)])));
    }
}
