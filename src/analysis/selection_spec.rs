//! Selections as claims write them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A selection as claims write it.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SelectionSpec {
    /// The study whose records are looked at.
    pub study: String,
    /// The problem group, by its label, or several; a label that ends in `*` stands for all that begin so.
    pub problems: Labels,
    /// The contender, by its label, or several; left out where none is looked at.
    #[serde(default)]
    pub contender: Labels,
    /// The contender that it is compared with, on the same problems.
    pub against: Option<String>,
    /// The metric: a name that `replan list metrics` gives, or one that an interpretation gives a meaning.
    pub metric: Option<String>,
    /// The one query of each instance that is looked at, or several; all if absent.
    pub query: Option<Labels>,
    /// The points of the study's sweeps: `samples=100`, a part of them as `samples<=1400` or `samples>200,samples<=1400`, or a list of
    /// such; all if absent.
    pub sweep: Option<Labels>,
    /// Only instances count in which every contender that is compared solves every query.
    #[serde(default)]
    pub whole_instances: bool,
    /// A trial that ends without a path, or with one that is refused, has a number too: what it took. Otherwise solved ones do and,
    /// where the metric counts what the search did, those whose path is refused.
    #[serde(default)]
    pub all_ends: bool,
}

/// One label, or several.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a label, or a list of labels, is accepted")]
pub enum Labels {
    /// One label.
    One(String),
    /// Several labels.
    Several(Vec<String>),
}

impl Default for Labels {
    fn default() -> Self {
        Self::Several(Vec::new())
    }
}

impl Labels {
    /// The labels as they are written.
    pub fn listed(&self) -> Vec<String> {
        match self {
            Self::One(label) => vec![label.clone()],
            Self::Several(labels) => labels.clone(),
        }
    }
}
