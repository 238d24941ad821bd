//! Checks: how a claim is judged; one a file, all in [`REGISTRY`].
//!
//! A check either proves something from the printed numbers alone, and can then only refuse, or compares them
//! with stored records. What a check compares with is written in the claim, before the first run.

mod all_in_draw;
mod attained;
mod compare;
mod fails_where;
mod finds_whenever;
mod largest_saving;
mod lattice_length;
mod ordering;
mod percentage;
mod point_distance;
mod saving_per_draw;
mod share_above;
mod straight_line;
mod table_cell;
mod table_row;

use super::audit::printed::{Digits, Printed};
use super::evidence::Evidence;
use super::metric::Metric;
use super::verdict::Finding;
use crate::settings::{Settings, SettingsError};
use crate::study::Study;
use crate::study::paper::{self, Claim, Paper};

/// A check with its settings.
pub trait Check {
    /// What it finds in the stored runs.
    fn judge(&self, evidence: &Evidence<'_>) -> Finding;
}

/// What a check is built from.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// The check's settings in the claim.
    pub settings: &'a Settings,
    /// The paper.
    pub paper: &'a Paper,
}

/// A registered check.
pub struct Entry {
    /// The name that claims use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// How to build it.
    pub build: for<'a> fn(&Context<'a>) -> Result<Box<dyn Check + 'a>, SettingsError>,
}

/// Every check, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &all_in_draw::ENTRY,
    &attained::ENTRY,
    &compare::ENTRY,
    &fails_where::ENTRY,
    &finds_whenever::ENTRY,
    &largest_saving::ENTRY,
    &lattice_length::ENTRY,
    &ordering::ENTRY,
    &percentage::ENTRY,
    &point_distance::ENTRY,
    &saving_per_draw::ENTRY,
    &share_above::ENTRY,
    &straight_line::ENTRY,
    &table_cell::ENTRY,
    &table_row::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}

pub use attained::problems as attained_problems;

impl From<paper::Digits> for Digits {
    fn from(digits: paper::Digits) -> Self {
        match digits {
            paper::Digits::Rounded => Self::Rounded,
            paper::Digits::Truncated => Self::Truncated,
            paper::Digits::Unknown => Self::Unknown,
        }
    }
}

impl<'a> Context<'a> {
    /// The claim's printed number.
    fn printed(&self) -> Result<Printed, SettingsError> {
        let missing = || format!("claim `{}` prints no number, which this check needs", self.claim.id);
        let text = self.claim.printed.as_ref().ok_or_else(|| self.settings.error(missing()))?;
        text.parse().map_err(|e: super::audit::AuditError| self.settings.error(e.to_string()))
    }

    /// The printed number of another claim.
    fn printed_of(&self, id: &str) -> Result<(Printed, Digits), SettingsError> {
        let other = self.claim_called(id)?;
        let context = Context { claim: other, ..*self };
        Ok((context.printed()?, other.digits.into()))
    }

    fn claim_called(&self, id: &str) -> Result<&'a Claim, SettingsError> {
        self.paper.claim(id).ok_or_else(|| {
            let known: Vec<&str> = self.paper.claims.iter().map(|claim| claim.id.as_str()).collect();
            self.settings.error(format!("there is no claim `{id}`; there are {}", known.join(", ")))
        })
    }

    fn digits(&self) -> Digits {
        self.claim.digits.into()
    }

    /// The study called `name`, which must have the problem groups and contenders named.
    fn study(
        &self,
        name: &str,
        problems: &[String],
        contenders: &[&str],
    ) -> Result<&'a Study, SettingsError> {
        let study = self.paper.study(name).ok_or_else(|| {
            let known: Vec<&str> = self.paper.studies.iter().map(|study| study.name.as_str()).collect();
            self.settings.error(format!("there is no study `{name}`; there are {}", known.join(", ")))
        })?;
        for problem in problems {
            if !study.groups.iter().any(|group| group.label == *problem) {
                let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
                let message =
                    format!("study `{name}` has no problem group `{problem}`; it has {}", known.join(", "));
                return Err(self.settings.error(message));
            }
        }
        for wanted in contenders {
            if !study.contenders.iter().any(|contender| contender.label == **wanted) {
                let known: Vec<&str> = study.contenders.iter().map(|c| c.label.as_str()).collect();
                let message =
                    format!("study `{name}` has no contender `{wanted}`; it has {}", known.join(", "));
                return Err(self.settings.error(message));
            }
        }
        Ok(study)
    }

    /// The metric that `name` stands for under the default reading; `study` must produce it.
    fn metric(&self, name: &str, study: &Study) -> Result<&'static Metric, SettingsError> {
        let point = super::evidence::default_point(self.paper);
        let metric = super::metric::find(point.metric(name)).ok_or_else(|| {
            let known: Vec<&str> = super::metric::METRICS.iter().map(|metric| metric.name).collect();
            let message = format!(
                "there is no metric `{name}`, nor a reading that gives the name a meaning; the metrics are {}",
                known.join(", ")
            );
            self.settings.error(message)
        })?;
        let columns = study.columns();
        if !columns.contains(metric.column) {
            let produced: Vec<&str> = super::metric::METRICS
                .iter()
                .filter(|metric| columns.contains(metric.column))
                .map(|metric| metric.name)
                .collect();
            let message = format!(
                "study `{}` does not produce the metric `{}`; it produces {}",
                study.name,
                metric.name,
                produced.join(", ")
            );
            return Err(self.settings.error(message));
        }
        Ok(metric)
    }
}
