//! Units of work: one preprocessed object with everything that runs on it.

use super::choice::Interpretation;
use super::contender::{Contender, Pipeline, SweepPoint};
use super::family::{Family, Query};
use super::group::Group;
use super::key::{InstanceKey, Text, TrialKey};
use super::name::Names;
use super::spec::{BudgetSpec, TrialsSpec};
use base::seed;
use std::sync::Arc;

/// What all units of a study share.
pub struct StudyContext<'a> {
    /// The paper's name.
    pub paper: &'a str,
    /// The study's name.
    pub study: &'a str,
    /// How its records are named.
    pub names: Names,
    /// The root of every seed.
    pub seed: u64,
    /// Limits on each trial.
    pub budget: BudgetSpec,
    /// Trials whose traces are kept.
    pub keeps: Vec<&'a TrialsSpec>,
}

/// One preprocessed object and the trials that share it.
#[derive(Clone)]
pub struct Unit<'a> {
    /// What it shares with the study's other units.
    pub terms: &'a StudyContext<'a>,
    /// What names it in records.
    pub key: Arc<InstanceKey>,
    /// The group its problems belong to.
    pub group: &'a Group,
    /// The group's family under this interpretation.
    pub family: &'a dyn Family,
    /// The interpretation.
    pub point: &'a Interpretation,
    /// Who runs on it.
    pub entrants: Vec<&'a Entrant<'a>>,
    /// The instance's seed; the same under every interpretation and for every contender.
    pub seed: u64,
    /// Keeps every trace, whatever the study asks for.
    pub keeps_all: bool,
}

/// A contender at one point of the sweeps over contenders, ready to run.
pub struct Entrant<'a> {
    /// The contender as the study names it.
    pub contender: &'a Contender,
    /// Its label, shared among keys.
    pub label: Text,
    /// The sweeps' values.
    pub sweep: SweepPoint,
    /// The pipeline built from both; interpretations that set nothing of it share it.
    pub pipeline: Arc<Pipeline>,
}

impl Unit<'_> {
    /// The queries of this instance.
    pub fn queries(&self) -> Vec<Query> {
        self.family.queries_for(self.seed)
    }

    /// The name of the problem that `query` poses in this unit: seeds derive from it.
    pub fn problem(&self, query: &Query) -> String {
        self.terms.names.problem(&self.key, query_key(query).as_deref())
    }

    /// What names a trial in this unit.
    pub fn trial(&self, query: &Query, entrant: &Entrant<'_>, repeat: u32) -> TrialKey {
        TrialKey {
            on: self.key.clone(),
            query: query_key(query),
            contender: entrant.label.clone(),
            sweep: self.key.sweep.and(&entrant.sweep.key),
            repeat,
        }
    }

    /// Whether traces of this unit (of `contender`'s seed number `repeat`, if given) are kept.
    pub fn is_kept(&self, contender: Option<&str>, repeat: u32) -> bool {
        self.keeps_all || self.keeping(contender, repeat).next().is_some()
    }

    /// Whether the trace called `name` of a trial is kept.
    pub fn keeps(&self, contender: &str, repeat: u32, name: &str) -> bool {
        let is_named = |trials: &TrialsSpec| {
            trials.traces.as_ref().is_none_or(|names| names.iter().any(|known| known == name))
        };
        self.keeps_all || self.keeping(Some(contender), repeat).any(is_named)
    }

    /// What has traces kept of this unit (of `contender`'s seed number `repeat`, if given).
    fn keeping<'s>(
        &'s self,
        contender: Option<&'s str>,
        repeat: u32,
    ) -> impl Iterator<Item = &'s TrialsSpec> + 's {
        let wanted = self.terms.keeps.iter().filter(|trials| trials.problems == self.group.label);
        let keeps = move |trials: &&TrialsSpec| {
            let named = match (contender, &trials.contender) {
                (Some(contender), Some(wanted)) => contender == wanted,
                _ => true,
            };
            let is_early = contender.is_none() || trials.repeats.is_none_or(|repeats| repeat < repeats);
            named && is_early && trials.has_instance(self.key.instance)
        };
        wanted.copied().filter(keeps)
    }
}

fn query_key(query: &Query) -> Option<Text> {
    (!query.name.is_empty()).then(|| query.name.as_str().into())
}

impl Entrant<'_> {
    /// Whether its trials on a problem are also those of `other`, whose seeds are derived from the same names.
    pub fn plans_as(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.pipeline, &other.pipeline)
            && self.sweep.key == other.sweep.key
            && !self.contender.is_recorded()
    }

    /// The seed of one run: it depends on names only, so that adding a contender moves no other.
    pub fn seed(&self, terms: &StudyContext<'_>, problem: &str, repeat: u32) -> u64 {
        let label = &self.contender.label;
        let names = [terms.paper, terms.study, "contender", problem, label, &repeat.to_string()];
        seed::derive(terms.seed, &names)
    }
}
