//! Criteria: how statistics of stored trials are held against what a paper says; one a file, all in [`REGISTRY`].
//!
//! A criterion selects trials, takes a statistic of each instance, and says what it finds; what lowers that is decided in
//! [`outcome`](super::outcome). Arithmetic on printed numbers alone is a [`rule`](super::rule).

mod equals;
mod exists;
mod least_of;
mod lower;
mod mean_of;
mod on_every;
mod one_instance;
mod prints_as;
mod row_one_instance;
mod share;
pub mod table_means;
mod trend;
mod within;

pub use exists::{Attained, ENTRY as EXISTS, Seen};
pub use one_instance::{Instances, instances, is_powerless};

use super::context::Context;
use super::criterion_result::CriterionResult;
use super::evidence::{Evidence, Run};
use super::number::Number;
use super::polylines::Polylines;
use super::selection::Selection;
use base::settings::{Accepted, SettingsError};
use study::Study;
use toml::Table;

/// A criterion with its settings, every name looked up.
pub trait Criterion {
    /// The numbers that it weighs, as the evidence's interpretation, and session of the clock, show them.
    fn numbers(&self, evidence: &Evidence<'_>) -> Vec<Number>;

    /// What these numbers say of the claim; no trial is looked at.
    fn weigh(&self, numbers: &[Number]) -> CriterionResult;

    /// Adds the trial that shows what was found in `numbers`, and what trials alone can tell.
    fn show(&self, _evidence: &Evidence<'_>, _numbers: &[Number], _found: &mut CriterionResult) {}

    /// What a rule proves by arithmetic on printed numbers; polylines are kept for later rules. Without an explanation it only
    /// finds out whether the claim is refused.
    fn proof(&self, _polylines: &Polylines, _is_explained: bool) -> Option<CriterionResult> {
        None
    }

    /// What it selects; none if it looks for trials in a way of its own.
    fn selections(&self) -> Vec<&Selection<'_>> {
        Vec::new()
    }

    /// The studies whose trials it looks at.
    fn studies(&self) -> Vec<&Study> {
        self.selections().iter().map(|selection| selection.study).collect()
    }

    /// Whether what it finds rests on our own clock.
    fn is_clock(&self) -> bool {
        self.selections().iter().any(|selection| selection.is_clock())
    }

    /// Whether trials with refused paths have numbers, since these count what the search did.
    fn counts_refused(&self) -> bool {
        self.selections().iter().any(|selection| selection.counts_refused())
    }

    /// Whether trials ran under the evidence's interpretation of all that it looks at; of anything at all, if one witness would do.
    fn is_covered(&self, evidence: &Evidence<'_>) -> bool {
        let is_run = |study: &&Study| evidence.run(&study.name).is_some_and(Run::is_covered);
        self.studies().iter().all(is_run)
            && self.selections().iter().all(|selection| has_all(selection, evidence))
    }

    /// Whether each problem group that it looks at could be posed under the evidence's interpretation: one that could not says nothing.
    fn is_posed(&self, evidence: &Evidence<'_>) -> bool {
        self.selections().iter().all(|selection| selection.is_posed(evidence))
    }

    /// The results that it rests on under the evidence's interpretation, whatever the interpretation is called: equal text, equal results.
    fn results(&self, evidence: &Evidence<'_>) -> String {
        self.selections()
            .into_iter()
            .filter_map(|selection| Some(selected(selection, selection.run(evidence)?)))
            .collect()
    }
}

/// Whether the study that stands for the selection's has all of its groups and contenders.
fn has_all(selection: &Selection<'_>, evidence: &Evidence<'_>) -> bool {
    selection.run(evidence).is_some_and(|run| {
        let labels: Vec<&str> = run.study.contenders.iter().map(|own| own.label.as_str()).collect();
        let has_group = |label: &String| run.study.groups.iter().any(|group| group.label == *label);
        let mut contenders = selection.contenders.iter().chain(&selection.against);
        selection.groups.iter().all(has_group)
            && (labels.is_empty() || contenders.all(|label| labels.contains(&label.as_str())))
    })
}

/// What `run` has of a selection, a trial a line.
fn selected(selection: &Selection<'_>, run: &Run<'_>) -> String {
    let mut text = String::new();
    let reader = selection.metric.map(|metric| (metric.name, run.reader(metric)));
    for group in &selection.groups {
        for contender in selection.contenders.iter().chain(&selection.against) {
            for row in selection.rows(run, group, contender) {
                let value = reader.as_ref().and_then(|(_, read)| read(row)).map(f64::to_bits);
                let name = reader.as_ref().map(|(name, _)| *name);
                let key = &row.key;
                text += &format!(
                    "{group} {contender} {} {:?} {:?} {} {} {name:?} {value:?}\n",
                    row.instance(),
                    key.query,
                    key.sweep,
                    key.repeat,
                    row.status
                );
            }
        }
    }
    text
}

/// Takes what is only weighed out of the settings.
fn without(settings: &mut Table, keys: &[&str]) {
    settings.retain(|key, _| keys.iter().all(|own| *own != key));
}

/// A registered criterion or rule.
pub struct Entry {
    /// The name that claims use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// Gives the revision for these settings. It is raised when a change moves what the criterion finds in the same trials; what
    /// was found under interpretations is then computed again.
    pub revision: fn(&Table) -> u32,
    /// Takes out of its settings what only weighs its numbers, and gives the name of these numbers with a revision. Criteria that
    /// leave the same settings share their numbers. `None` of a rule, which looks at no trial.
    pub question: fn(&mut Table) -> Option<&'static str>,
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it.
    pub build: for<'a> fn(&Context<'a>) -> Result<Box<dyn Criterion + 'a>, SettingsError>,
}

/// Every criterion, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &equals::ENTRY,
    &exists::ENTRY,
    &least_of::ENTRY,
    &lower::ENTRY,
    &mean_of::ENTRY,
    &on_every::ENTRY,
    &one_instance::ENTRY,
    &prints_as::ENTRY,
    &row_one_instance::ENTRY,
    &share::ENTRY,
    &table_means::ENTRY,
    &trend::ENTRY,
    &within::ENTRY,
];

/// The criterion called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
