//! Checks: how a claim is judged; one a file, all in [`REGISTRY`].
//!
//! A check either proves something from the printed numbers alone, and can then only refuse, or compares them
//! with stored records. What a check compares with is written in the claim, before the first run.

mod across_readings;
mod all_in_draw;
mod as_printed;
mod attained;
mod clock_ticks;
mod compare;
mod count_bound;
mod equals_least;
mod fails_where;
mod failure_causes;
mod finds_whenever;
mod how_often;
mod joint_length_turn;
mod largest_saving;
mod lattice_length;
mod listed_points;
mod lower_by_draw;
mod lowest_median;
mod mean_curve_above;
mod octagon_nodes;
mod oracle;
mod ordering;
mod over_claims;
mod percentage;
mod point_distance;
mod printed_ratio;
mod ratio;
mod reach_ring;
mod refused_by_option;
mod repulsion;
mod row_among_draws;
mod saving_per_draw;
mod savings_within;
mod share;
mod share_above;
mod share_beyond;
mod share_of_paths;
mod sight_bound;
mod straight_line;
mod table_cell;
mod table_row;
mod trend;
mod turn_needs_length;
mod varies;
mod zero_everywhere;

use super::evidence::Evidence;
use super::metric::Metric;
use super::verdict::{Finding, Verdict};
use crate::study::paper::{self, Claim, Paper};
use crate::study::{ReadingChoice, Study};
use audit::printed::{Digits, Printed};
use base::settings::{Accepted, Faults, Settings, SettingsError, did_you_mean, none_called};

/// A check with its settings.
pub trait Check {
    /// What it finds in the stored runs.
    fn judge(&self, evidence: &Evidence<'_>) -> Finding;

    /// Whether what it asks holds under the evidence's reading in the study that explores readings for it, and that
    /// study's name; `None` if it explores none or was not run under this one.
    fn holds(&self, _evidence: &Evidence<'_>) -> Option<(String, bool)> {
        None
    }

    /// The verdict of [`judge`](Self::judge) alone, for who does not need the reasons.
    fn verdict(&self, evidence: &Evidence<'_>) -> Option<Verdict> {
        self.judge(evidence).verdict
    }
}

/// Under how many of the readings that `study` explores what `check` asks holds.
fn explored_share(check: &dyn Check, study: Option<&Study>, evidence: &Evidence<'_>) -> Option<String> {
    let study = study?;
    let points = study.explored().ok()?;
    let held =
        points.iter().filter_map(|point| Some((point, check.holds(&evidence.under(point.clone()))?.1)));
    let (yes, no): (Vec<_>, Vec<_>) = held.partition(|(_, holds)| *holds);
    let all = yes.len() + no.len();
    let single = |of: &[(&ReadingChoice, bool)]| {
        let names = of.iter().map(|(point, _)| point.name()).filter(|name| !name.contains(','));
        names.collect::<Vec<_>>().join(", ")
    };
    let (few, verb) = if yes.len() * 2 > all { (&no, "not under") } else { (&yes, "under") };
    let named = single(few);
    let tail =
        if named.is_empty() { String::new() } else { format!("; of the single options {verb} {named}") };
    (all > 0)
        .then(|| format!("it holds under {} of {all} readings explored in {}{tail}", yes.len(), study.name))
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
    /// The reading that the claim is judged under.
    pub point: &'a ReadingChoice,
}

/// A registered check.
pub struct Entry {
    /// The name that claims use; also its file's name.
    pub name: &'static str,
    /// One line for `replan list`.
    pub about: &'static str,
    /// The shape of its settings, which documents them.
    pub settings: Accepted,
    /// Settings that it can be built from, as TOML: for `replan list`, and for a test that builds it from them.
    pub example: &'static str,
    /// How to build it.
    pub build: for<'a> fn(&Context<'a>) -> Result<Box<dyn Check + 'a>, SettingsError>,
}

/// Every check, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &across_readings::ENTRY,
    &all_in_draw::ENTRY,
    &as_printed::ENTRY,
    &attained::ENTRY,
    &clock_ticks::ENTRY,
    &compare::ENTRY,
    &count_bound::ENTRY,
    &equals_least::ENTRY,
    &fails_where::ENTRY,
    &failure_causes::ENTRY,
    &finds_whenever::ENTRY,
    &how_often::ENTRY,
    &joint_length_turn::ENTRY,
    &largest_saving::ENTRY,
    &lattice_length::ENTRY,
    &listed_points::ENTRY,
    &lower_by_draw::ENTRY,
    &lowest_median::ENTRY,
    &mean_curve_above::ENTRY,
    &octagon_nodes::ENTRY,
    &oracle::ENTRY,
    &ordering::ENTRY,
    &over_claims::ENTRY,
    &percentage::ENTRY,
    &point_distance::ENTRY,
    &printed_ratio::ENTRY,
    &ratio::ENTRY,
    &reach_ring::ENTRY,
    &refused_by_option::ENTRY,
    &repulsion::ENTRY,
    &row_among_draws::ENTRY,
    &saving_per_draw::ENTRY,
    &savings_within::ENTRY,
    &share::ENTRY,
    &share_above::ENTRY,
    &share_beyond::ENTRY,
    &share_of_paths::ENTRY,
    &sight_bound::ENTRY,
    &straight_line::ENTRY,
    &table_cell::ENTRY,
    &table_row::ENTRY,
    &trend::ENTRY,
    &turn_needs_length::ENTRY,
    &varies::ENTRY,
    &zero_everywhere::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}

/// The checks of a claim, built.
///
/// # Errors
/// All at once: a check that does not exist, and what a check refuses of its settings.
pub fn checks<'a>(
    paper: &'a Paper,
    point: &'a ReadingChoice,
    claim: &'a Claim,
) -> Result<Vec<(&'static str, Box<dyn Check + 'a>)>, SettingsError> {
    let (mut built, mut faults) = (Vec::new(), Faults::default());
    for (name, settings) in &claim.checks {
        let check = entry(claim, name, settings)
            .and_then(|entry| Ok((entry.name, (entry.build)(&Context { claim, settings, paper, point })?)));
        built.extend(faults.keep(check));
    }
    faults.done()?;
    Ok(built)
}

/// The entry that a claim asks for as `name`.
fn entry(claim: &Claim, name: &str, settings: &Settings) -> Result<&'static Entry, SettingsError> {
    find(name).ok_or_else(|| {
        let known: Vec<&str> = REGISTRY.iter().map(|entry| entry.name).collect();
        let message = format!(
            "claim `{}` asks for the check `{name}`, which does not exist{}; the checks are {}",
            claim.id,
            did_you_mean(name, known.iter().copied()),
            known.join(", ")
        );
        settings.error(message)
    })
}

/// The verdict on one claim under the evidence's reading, without the reasons.
///
/// # Errors
/// Those of [`validate`].
fn verdict_on(evidence: &Evidence<'_>, claim: &Claim) -> Result<Verdict, SettingsError> {
    let checks = checks(evidence.paper, &evidence.point, claim)?;
    let untestable = claim.untestable.as_ref().map(|_| Verdict::Untestable);
    let found = checks.iter().filter_map(|(_, check)| check.verdict(evidence)).chain(untestable);
    Ok(found.max().unwrap_or(Verdict::Undecided))
}

#[cfg(test)]
mod tests;

pub use across_readings::Outcome;
pub use attained::Attained;
pub use row_among_draws::Draws;

/// The draws that the claim called `id` is ranked among, as its check `row_among_draws` says.
///
/// # Errors
/// There is no such claim or it has no such check.
pub fn draws(evidence: &Evidence<'_>, asker: &Settings, id: &str) -> Result<Vec<Draws>, SettingsError> {
    row_among_draws::draws(&context(evidence, asker, id, row_among_draws::ENTRY.name)?, evidence)
}

/// What is found about the claim called `id` under every reading, as its check `across_readings` says.
///
/// # Errors
/// There is no such claim or it has no such check.
pub fn outcomes(evidence: &Evidence<'_>, asker: &Settings, id: &str) -> Result<Vec<Outcome>, SettingsError> {
    across_readings::outcomes(&context(evidence, asker, id, across_readings::ENTRY.name)?, evidence)
}

/// The claim called `id` with its check called `check`, asked for by settings `asker`.
fn context<'a>(
    evidence: &'a Evidence<'_>,
    asker: &Settings,
    id: &str,
    check: &str,
) -> Result<Context<'a>, SettingsError> {
    let (paper, point) = (evidence.paper, &evidence.point);
    let claim = paper.claim(id).ok_or_else(|| {
        asker.error_about(
            "",
            &["claim"],
            id,
            none_called("claim", id, paper.claims.iter().map(|c| c.id.as_str())),
        )
    })?;
    let settings = claim.checks.get(check).ok_or_else(|| {
        asker.error_about(
            "",
            &["claim"],
            id,
            format!("claim `{id}` has no check `{check}`, which says what is to be shown"),
        )
    })?;
    Ok(Context { claim, settings, paper, point })
}

impl From<paper::Digits> for Digits {
    fn from(digits: paper::Digits) -> Self {
        match digits {
            paper::Digits::Rounded => Self::Rounded,
            paper::Digits::Truncated => Self::Truncated,
            paper::Digits::Unknown => Self::Unknown,
        }
    }
}

/// Problem groups in a sentence: their names, or how many there are.
fn listed(problems: &[String]) -> String {
    if problems.len() > 3 { format!("{} problem groups", problems.len()) } else { problems.join(", ") }
}

/// How the keys start that name studies, problem groups, contenders and metrics.
const STUDY_KEYS: [&str; 2] = ["stud", "explored"];
const PROBLEM_KEYS: [&str; 4] = ["problem", "searched", "rows", "in"];
const CONTENDER_KEYS: [&str; 6] = ["contender", "against", "lower", "higher", "whenever", "of"];
const METRIC_KEYS: [&str; 2] = ["metric", "over"];

impl<'a> Context<'a> {
    /// The claim's printed number.
    fn printed(&self) -> Result<Printed, SettingsError> {
        let missing = || format!("claim `{}` prints no number, which this check needs", self.claim.id);
        let text = self.claim.printed.as_ref().ok_or_else(|| self.settings.error(missing()))?;
        text.parse().map_err(|e: audit::AuditError| self.settings.error(e.to_string()))
    }

    /// The printed number of another claim.
    fn printed_of(&self, id: &str) -> Result<(Printed, Digits), SettingsError> {
        let other = self.claim_called(id)?;
        let context = Context { claim: other, ..*self };
        Ok((context.printed()?, context.digits()))
    }

    fn claim_called(&self, id: &str) -> Result<&'a Claim, SettingsError> {
        self.paper.claim(id).ok_or_else(|| {
            let known = self.paper.claims.iter().map(|claim| claim.id.as_str());
            self.settings.error_about("", &[""], id, none_called("claim", id, known))
        })
    }

    fn digits(&self) -> Digits {
        let digits = self.claim.digits.or_else(|| self.point.digits());
        digits.unwrap_or(paper::Digits::Unknown).into()
    }

    /// The study called `name`, which must have the problem groups and contenders named.
    fn study(
        &self,
        name: &str,
        problems: &[String],
        contenders: &[&str],
    ) -> Result<&'a Study, SettingsError> {
        self.study_in("", name, problems, contenders)
    }

    /// The same of names that stand in the part of the settings that `within` leads to.
    fn study_in(
        &self,
        within: &str,
        name: &str,
        problems: &[String],
        contenders: &[&str],
    ) -> Result<&'a Study, SettingsError> {
        let study = self.paper.study(name).ok_or_else(|| {
            let known = self.paper.studies.iter().map(|study| study.name.as_str());
            self.settings.error_about(within, &STUDY_KEYS, name, none_called("study", name, known))
        })?;
        let mut faults = Faults::default();
        for problem in problems {
            if !study.groups.iter().any(|group| group.label == *problem) {
                let known: Vec<&str> = study.groups.iter().map(|group| group.label.as_str()).collect();
                let hint = did_you_mean(problem, known.iter().copied());
                let message = format!(
                    "study `{name}` has no problem group `{problem}`{hint}; it has {}",
                    known.join(", ")
                );
                faults.add(self.settings.error_about(within, &PROBLEM_KEYS, problem, message));
            }
        }
        for wanted in contenders {
            if !study.contenders.iter().any(|contender| contender.label == **wanted) {
                let known: Vec<&str> = study.contenders.iter().map(|c| c.label.as_str()).collect();
                let hint = did_you_mean(wanted, known.iter().copied());
                let message =
                    format!("study `{name}` has no contender `{wanted}`{hint}; it has {}", known.join(", "));
                faults.add(self.settings.error_about(within, &CONTENDER_KEYS, wanted, message));
            }
        }
        faults.done()?;
        Ok(study)
    }

    /// The metric that `name` stands for under the reading.
    fn known_metric(&self, name: &str) -> Result<&'static Metric, SettingsError> {
        super::metric::find(self.point.metric(name)).ok_or_else(|| {
            let known: Vec<&str> = super::metric::METRICS.iter().map(|metric| metric.name).collect();
            let hint = did_you_mean(name, known.iter().copied());
            let message = format!(
                "there is no metric `{name}`, nor a reading that gives the name a meaning{hint}; the metrics are {}",
                known.join(", ")
            );
            self.settings.error_about("", &METRIC_KEYS, name, message)
        })
    }

    /// The metric that `name` stands for under the reading; `study` must produce it.
    fn metric(&self, name: &str, study: &Study) -> Result<&'static Metric, SettingsError> {
        let metric = self.known_metric(name)?;
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
            return Err(self.settings.error_about("", &METRIC_KEYS, name, message));
        }
        Ok(metric)
    }
}
