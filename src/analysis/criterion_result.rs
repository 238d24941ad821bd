//! The finding of a criterion or rule, before the origin of its trials counts.

use super::outcome::Outcome;
use super::verdict::Estimate;
use stats::interval::Interval;

/// What was found about a claim, before how its trials came about counts.
#[derive(Debug, Default)]
pub struct CriterionResult {
    /// What it amounts to; none if it is only shown, or can only refuse and does not.
    pub outcome: Option<Outcome>,
    /// Our number, without words about its interval.
    pub ours: Option<Estimate>,
    /// These words, as they follow the others.
    pub about_interval: String,
    /// The trial that shows it, as `--trial` takes it.
    pub trial: Option<String>,
    /// The computation, step by step.
    pub because: Vec<String>,
    /// What it takes for granted.
    pub premises: Vec<String>,
    /// Bounds for the interval around our number: it decides if it lies beyond one of them.
    pub limits: Vec<f64>,
    /// The noun, in the plural, of what narrows that interval if there is more of it.
    pub units: &'static str,
    /// How that interval narrows.
    pub narrows: Narrows,
    /// The claim is met by one input among many.
    pub existential: bool,
    /// Our spread is so wide that almost any printed value would fit.
    pub powerless: bool,
    /// How many cases without a number could turn it.
    pub censored: usize,
    /// How many of these have a path that the verifier refuses.
    pub refused: usize,
    /// How many cases tie, where that keeps it open.
    pub ties: usize,
    /// What printed value would have been refused.
    pub power: Option<String>,
    /// The instances that it takes at least, where there are fewer.
    pub needs: Option<usize>,
    /// The printed number that is farthest from ours, with both, in words.
    pub farthest: Option<String>,
}

/// How an interval narrows as there are more units.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Narrows {
    /// As one over the square root of their number.
    #[default]
    AsTheRoot,
    /// About as one over their number: a share, a ratio or a difference on which all of them agree.
    AsTheNumber,
}

/// Which printed values would have been refused: those outside of an interval.
pub fn refused_beyond(accepted: Interval) -> String {
    format!(
        "power: a printed value below {:.2} or above {:.2} would have been refused",
        accepted.low, accepted.high
    )
}

impl CriterionResult {
    /// Open for this reason.
    pub fn open(because: impl Into<String>) -> Self {
        Self { outcome: Some(Outcome::Open), because: vec![because.into()], ..Self::default() }
    }

    /// Open, because only `instances` of the `ran` instances have the numbers that are compared, fewer than `needs`.
    pub fn too_few(instances: usize, ran: usize, needs: usize) -> Self {
        let because =
            format!("{instances} of {ran} instances have what is compared; at least {needs} are needed");
        Self { needs: Some(needs), ..Self::open(because) }
    }

    /// The result with so many cases without an end, whose numbers are missing.
    #[must_use]
    pub fn hanging_on(self, unended: usize) -> Self {
        Self { censored: unended, ..self }
    }
}
