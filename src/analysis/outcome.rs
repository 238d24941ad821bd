//! The outcome of one criterion or rule under one interpretation, lowered by the origin of its trials, and outcomes
//! combined.
//!
//! An outcome speaks for a claim (+), against it (−), or leaves it open (0). Outcomes of one claim combine as a proof,
//! then −, then 0, then the weakest +. A cap lowers only outcomes that speak for a claim, or opens any measured one;
//! nothing raises one. Over all interpretations a claim has a [verdict](super::verdict_rule).

use serde::{Deserialize, Serialize};

/// How our number compares with what the paper says under one interpretation, from the best to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// What the claim says, to the margin that was set.
    Holds,
    /// It holds, but something in the study was chosen so that it would.
    Fitted,
    /// It holds on an input that was searched for, or on one of many.
    Attainable,
    /// The sign is what the claim says, the size is not.
    #[serde(rename = "right_in_direction")]
    SignOnly,
    /// Too little is known to say.
    Open,
    /// The paper leaves out what is needed.
    #[serde(rename = "not_testable")]
    Lacking,
    /// The contrary of what the claim says.
    #[serde(rename = "contradicted")]
    Fails,
    /// The printed numbers contradict arithmetic, geometry or each other, whatever was measured.
    #[serde(rename = "impossible")]
    Proved,
}

/// Which way an outcome speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Polarity {
    /// Against the claim.
    Against,
    /// Neither way.
    Open,
    /// For the claim.
    For,
}

impl Polarity {
    /// The other way.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Against => Self::For,
            Self::Open => Self::Open,
            Self::For => Self::Against,
        }
    }
}

impl Outcome {
    /// Every outcome.
    pub const ALL: [Self; 8] = [
        Self::Holds,
        Self::Fitted,
        Self::Attainable,
        Self::SignOnly,
        Self::Open,
        Self::Lacking,
        Self::Fails,
        Self::Proved,
    ];

    /// Its name in evidence.
    pub fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fitted => "fitted",
            Self::Attainable => "attainable",
            Self::SignOnly => "right in direction",
            Self::Open => "open",
            Self::Lacking => "not testable",
            Self::Fails => "contradicted",
            Self::Proved => "impossible",
        }
    }

    /// Which way it speaks.
    pub fn polarity(self) -> Polarity {
        match self {
            Self::Holds | Self::Fitted | Self::Attainable | Self::SignOnly => Polarity::For,
            Self::Open | Self::Lacking => Polarity::Open,
            Self::Fails | Self::Proved => Polarity::Against,
        }
    }

    /// Whether its inputs were searched for or fitted: it never speaks as loud as one that was measured.
    pub fn is_chosen(self) -> bool {
        matches!(self, Self::Fitted | Self::Attainable)
    }
}

/// How the trials behind a finding came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a cap by itself, and any of them may hold beside any other"
)]
pub struct Caps {
    /// Their inputs were searched for.
    pub searched: bool,
    /// Their study was fitted to the claim.
    pub fitted: bool,
    /// The claim is met by one input among many: it can be met.
    pub existential: bool,
    /// Our spread is so wide that almost any printed value would fit.
    pub powerless: bool,
    /// Trials without a result could turn it.
    pub censored: bool,
    /// There are fewer instances than it takes to say anything.
    pub few: bool,
    /// It rests on our own clock: what the stored sessions say of it.
    pub clock: Option<Sessions>,
    /// The paper does not mean the claim under this interpretation.
    pub without_premises: bool,
    /// The paper may mean an option that cannot be run.
    pub not_run: bool,
}

/// What the stored sessions of a clock, judged one by one and never pooled, say of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sessions {
    /// There are fewer than [`SESSIONS`].
    TooFew,
    /// They do not all give the same outcome.
    Disagree,
    /// They all give the same outcome.
    Agree,
    /// The sentence is about a time of the authors', which our clock does not test.
    OfAnother,
}

/// Sessions of a clock that are needed to say anything: a machine's load differs between sessions by more than the times
/// within one show.
pub const SESSIONS: usize = 3;

/// The outcome of one finding; `None` where the claim is not meant, whatever is found there.
pub fn of_finding(found: Outcome, caps: Caps) -> Option<Outcome> {
    if caps.without_premises {
        return None;
    }
    if matches!(found, Outcome::Proved | Outcome::Lacking) {
        return Some(found);
    }
    if caps.clock == Some(Sessions::OfAnother) {
        return Some(Outcome::Lacking);
    }
    let is_searched = caps.searched || caps.existential;
    let measured = match found {
        Outcome::Holds if is_searched => Outcome::Attainable,
        Outcome::Holds if caps.fitted => Outcome::Fitted,
        // An input that was chosen to meet a size and meets its sign alone meets nothing.
        Outcome::SignOnly if caps.searched || caps.fitted => Outcome::Open,
        other => other,
    };
    let no_clock = matches!(caps.clock, Some(Sessions::TooFew | Sessions::Disagree));
    let is_hollow = caps.powerless && measured.polarity() == Polarity::For;
    let is_open = caps.censored || caps.few || caps.not_run || no_clock || is_hollow;
    Some(if is_open { Outcome::Open } else { measured })
}

/// The outcome of a claim from those of its findings, and whether the paper leaves out what a test needs.
pub fn combined(findings: impl IntoIterator<Item = Outcome>, lacking: bool) -> Outcome {
    let lacking = lacking.then_some(Outcome::Lacking);
    findings.into_iter().chain(lacking).max().unwrap_or(Outcome::Open)
}

/// The outcome of a sentence that says all of its parts: the least of theirs (− < 0 < +), of equals the weakest.
///
/// Parts that leave it open make it open, unless the paper lacks something for every one of them.
pub fn all_of(parts: &[Outcome]) -> Outcome {
    let least = parts.iter().map(|part| part.polarity()).min();
    extreme(parts, least, |among| among.max())
}

/// The outcome of a sentence that says some one of its parts: the greatest of theirs, of equals the strongest.
pub fn any_of(parts: &[Outcome]) -> Outcome {
    let greatest = parts.iter().map(|part| part.polarity()).max();
    extreme(parts, greatest, |among| among.min())
}

/// The outcome of a sentence that means one of its parts and does not say which. If all parts speak one way it is
/// theirs, otherwise it is open.
pub fn one_meant(parts: &[Outcome]) -> Outcome {
    let all = all_of(parts);
    let any = any_of(parts);
    match (all.polarity(), any.polarity()) {
        (Polarity::For, _) | (Polarity::Open, Polarity::Open) => all,
        (_, Polarity::Against) => any,
        _ => Outcome::Open,
    }
}

fn extreme(
    parts: &[Outcome],
    way: Option<Polarity>,
    pick: fn(&mut dyn Iterator<Item = Outcome>) -> Option<Outcome>,
) -> Outcome {
    let mut among = parts.iter().copied().filter(|part| Some(part.polarity()) == way);
    match way {
        Some(Polarity::Open) if among.all(|part| part == Outcome::Lacking) => Outcome::Lacking,
        None | Some(Polarity::Open) => Outcome::Open,
        Some(_) => pick(&mut among).unwrap_or(Outcome::Open),
    }
}

#[cfg(test)]
mod tests;
