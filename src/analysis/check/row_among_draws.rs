//! Where a printed number stands among our draws.
//!
//! A printed row is one draw. Its rank says how unusual it would be among the maps that we draw; it neither proves
//! nor refutes a number, because the paper's map need not be like ours. So this check gives no verdict.

use super::{Check, Context, Entry};
use crate::analysis::evidence::Evidence;
use crate::analysis::metric::Metric;
use crate::analysis::verdict::{Estimate, Finding};
use audit::printed::{Digits, Printed};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use stats::proportion::{Rank, predictive};
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "row_among_draws",
    about: "where does the printed number, or reduction, rank among our draws, with an exact interval?",
    settings: Accepted::of::<Settings>(),
    example: r#"
metric = "nodes"
contender = "Improved A*"
against = "A*"
sets = [
    { label = "all maps", study = "ensemble", problems = ["simple cells 10 %", "simple cells 20 %", "simple cells 30 %", "simple rectangles 10 %", "simple rectangles 20 %", "simple rectangles 30 %", "simple bars 10 %", "simple bars 20 %", "simple bars 30 %"] },
    { label = "given A*'s cost (14.65; 17.65 for 17.56)", study = "conditioned", problems = ["simple given cost"] },
    { label = "given also its turn sum", study = "conditioned", problems = ["simple given cost, turn"] },
    { label = "given also its nodes within 10 %", study = "conditioned", problems = ["simple given cost, turn, opened"] },
]
"#,
    build: |context| Ok(Box::new(RowAmongDraws::new(context)?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The metric: a name that `replan list metrics` gives, or one that a reading gives a meaning.
    metric: String,
    /// The contender, by its label.
    contender: String,
    /// The contender that the reduction is from; without it the printed number is the metric itself.
    against: Option<String>,
    /// The problems that are looked at, by study.
    sets: Vec<SetSpec>,
    /// What the draws take for granted besides.
    #[serde(default)]
    premises: Vec<String>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SetSpec {
    /// What these draws are.
    label: String,
    /// The study whose records are looked at.
    study: String,
    /// The problem groups, by their labels.
    problems: Vec<String>,
}

/// Draws of one kind.
#[derive(Debug, Clone)]
pub struct Draws {
    /// What they are.
    pub label: String,
    /// The metric, or its reduction in per cent, on every map that both contenders solved; printed twins of the
    /// claim's number are set to it.
    pub values: Vec<f64>,
    /// Maps on which one contender or both found no path.
    pub unsolved: usize,
    /// Accepted maps and maps tried, where draws were conditioned.
    pub acceptance: Option<[u64; 2]>,
}

struct RowAmongDraws {
    settings: Settings,
    metric: &'static Metric,
    printed: Printed,
    digits: Digits,
}

/// The draws that the check in `context` ranks its claim among.
///
/// # Errors
/// A settings error of the check.
pub fn draws(context: &Context<'_>, evidence: &Evidence<'_>) -> Result<Vec<Draws>, SettingsError> {
    Ok(RowAmongDraws::new(context)?.draws(evidence))
}

impl RowAmongDraws {
    fn new(context: &Context<'_>) -> Result<Self, SettingsError> {
        let settings: Settings = context.settings.read()?;
        let mut metric = None;
        for (index, set) in settings.sets.iter().enumerate() {
            let mut contenders = vec![settings.contender.as_str()];
            contenders.extend(settings.against.as_deref());
            let study = context.study_in(&format!("sets.{index}"), &set.study, &set.problems, &contenders)?;
            metric = Some(context.metric(&settings.metric, study)?);
        }
        let metric = metric.ok_or_else(|| context.settings.error_at("sets", "`sets` names no draws"))?;
        Ok(Self { settings, metric, printed: context.printed()?, digits: context.digits() })
    }

    fn draws(&self, evidence: &Evidence<'_>) -> Vec<Draws> {
        self.settings.sets.iter().map(|set| self.set(set, evidence)).collect()
    }

    fn set(&self, set: &SetSpec, evidence: &Evidence<'_>) -> Draws {
        let mut draws = Draws { label: set.label.clone(), values: Vec::new(), unsolved: 0, acceptance: None };
        let Some(run) = evidence.run(&set.study) else { return draws };
        for group in &set.problems {
            let values =
                run.changes(group, &self.settings.contender, self.settings.against.as_deref(), self.metric);
            let base = self.settings.against.as_ref().unwrap_or(&self.settings.contender);
            draws.unsolved += run.rows(group, &self.settings.contender).len()
                - run.pairs(group, base, &self.settings.contender).len();
            draws.values.extend(values);
        }
        for value in &mut draws.values {
            if self.printed.agrees(*value, self.digits) {
                *value = self.printed.value();
            }
        }
        let prepared = set.problems.iter().flat_map(|group| run.prepared(group));
        let tried: Vec<u64> =
            prepared.filter_map(|row| row.values.get("tries").map(|tries| tries.as_f64() as u64)).collect();
        if !tried.is_empty() {
            draws.acceptance = Some([tried.len() as u64, tried.iter().sum()]);
        }
        draws
    }
}

/// The rank of `printed` among `draws` in words.
fn said(draws: &Draws, printed: f64) -> String {
    let rank = Rank::of(printed, &draws.values);
    let Some((share, interval)) = rank.share_at_most().zip(rank.interval_at_most(LEVEL)) else {
        return format!("{}: no map was solved", draws.label);
    };
    let middle = median(&draws.values).map_or(String::new(), |median| format!("median {median:.2}"));
    let range = predictive(&draws.values, LEVEL)
        .map_or(String::new(), |range| format!(", 95 % of draws in {:.2} to {:.2}", range.low, range.high));
    let unsolved =
        if draws.unsolved > 0 { format!(" ({} more unsolved)", draws.unsolved) } else { String::new() };
    let accepted = draws.acceptance.map_or(String::new(), |[accepted, tried]| {
        format!(
            ", {accepted} accepted of {tried} maps tried ({:.3} %)",
            100.0 * accepted as f64 / tried as f64
        )
    });
    format!(
        "{}: {:.1} % of {} maps{unsolved} are at or below it ({:.1} to {:.1} %), {} equal it; {middle}{range}{accepted}",
        draws.label,
        100.0 * share,
        draws.values.len(),
        100.0 * interval.low,
        100.0 * interval.high,
        rank.equal,
    )
}

/// Level of every interval.
const LEVEL: f64 = 0.95;

impl Check for RowAmongDraws {
    fn judge(&self, evidence: &Evidence<'_>) -> Finding {
        let draws = self.draws(evidence);
        let printed = self.printed.value();
        let mut finding = Finding::of(ENTRY.name);
        finding.because = draws.iter().map(|draws| said(draws, printed)).collect();
        if let Some(last) = draws.last() {
            let rank = Rank::of(printed, &last.values);
            if let Some((share, interval)) = rank.share_at_most().zip(rank.interval_at_most(LEVEL)) {
                let what = format!("share of draws at or below, {}", last.label);
                finding.ours = Some(Estimate::new(share, interval, what, last.values.len()));
            }
        }
        finding.premises = vec!["the paper's map is like ours: none of its maps is known".to_owned()];
        finding.premises.extend(self.settings.premises.iter().cloned());
        finding
    }
}
