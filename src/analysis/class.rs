//! The class of a claim, in one place: what a criterion found, lowered by how its trials came about, and combined.
//!
//! A class speaks for a claim (+), against it (−), or leaves it open (0). Evidence on one claim combines as a proof, then
//! −, then 0, then the weakest +. What lowers a class lowers those that speak for a claim only, or makes any measured one
//! open; nothing raises one.

use serde::{Deserialize, Serialize};

/// What we found about a claim, from the best that can be said to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Our interval and the printed value agree within the margin, and nothing was fitted to the claim.
    Reproduced,
    /// They agree, but something in the study was chosen so that they would.
    Fitted,
    /// An input exists on which it holds; it was searched for.
    Attainable,
    /// The sign is right, the size is not.
    DirectionOnly,
    /// The interval straddles the margin, or too little is known to say.
    Undecided,
    /// It is contradicted by what we measured.
    NotReproduced,
    /// The printed numbers contradict arithmetic or geometry.
    Impossible,
    /// The paper leaves out what is needed.
    Untestable,
}

/// Which way a class speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Polarity {
    /// Against the claim.
    Against,
    /// Neither way.
    Open,
    /// For the claim.
    For,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Self; 8] = [
        Self::Reproduced,
        Self::Fitted,
        Self::Attainable,
        Self::DirectionOnly,
        Self::Undecided,
        Self::NotReproduced,
        Self::Impossible,
        Self::Untestable,
    ];

    /// Its name in tables and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Fitted => "fitted",
            Self::Attainable => "attainable",
            Self::DirectionOnly => "direction only",
            Self::Undecided => "undecided",
            Self::NotReproduced => "not reproduced",
            Self::Impossible => "impossible",
            Self::Untestable => "untestable",
        }
    }

    /// Which way it speaks.
    pub fn polarity(self) -> Polarity {
        match self {
            Self::Reproduced | Self::Fitted | Self::Attainable | Self::DirectionOnly => Polarity::For,
            Self::Undecided | Self::Untestable => Polarity::Open,
            Self::NotReproduced | Self::Impossible => Polarity::Against,
        }
    }
}

/// What a criterion found, before anything is said of how its trials came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// What the claim says, to the margin that was set.
    Holds,
    /// The sign is what the claim says, the size is not.
    SignOnly,
    /// Not enough is known to say.
    Open,
    /// The contrary of what the claim says.
    Fails,
    /// The printed numbers cannot be, whatever was measured.
    Proved,
}

impl Outcome {
    /// What an interval says of a claim that a number is at least `bound`.
    pub fn at_least(low: f64, high: f64, bound: f64) -> Self {
        if low >= bound {
            Self::Holds
        } else if high < bound {
            Self::Fails
        } else {
            Self::Open
        }
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
    /// Hardly any printed value could have been refused.
    pub powerless: bool,
    /// Trials without a result could turn it.
    pub censored: bool,
    /// There are fewer instances than it takes to say anything.
    pub few: bool,
    /// It rests on our own clock, and what its sessions say of it.
    pub clock: Option<Sessions>,
    /// The interpretation is none under which the claim is meant.
    pub without_premises: bool,
    /// The paper may mean an option that cannot be run.
    pub not_run: bool,
}

/// What the stored sessions of a clock, judged one by one and never pooled, say of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sessions {
    /// There are fewer than [`SESSIONS`].
    TooFew,
    /// They do not all give the same class.
    Disagree,
    /// They all give the same class.
    Agree,
}

/// Sessions of a clock that it takes to say anything: a machine's load differs from one to the next by more than the
/// interpretations within one show.
pub const SESSIONS: usize = 3;

/// The class of one finding; none where the claim is not meant, whatever is found there.
pub fn of_finding(outcome: Outcome, caps: Caps) -> Option<Verdict> {
    if caps.without_premises {
        return None;
    }
    let measured = match outcome {
        Outcome::Proved => return Some(Verdict::Impossible),
        Outcome::Open => Verdict::Undecided,
        Outcome::Fails => Verdict::NotReproduced,
        Outcome::SignOnly => Verdict::DirectionOnly,
        Outcome::Holds => {
            [(caps.searched || caps.existential, Verdict::Attainable), (caps.fitted, Verdict::Fitted)]
                .into_iter()
                .find_map(|(applies, verdict)| applies.then_some(verdict))
                .unwrap_or(Verdict::Reproduced)
        }
    };
    let no_clock = matches!(caps.clock, Some(Sessions::TooFew | Sessions::Disagree));
    let is_hollow = caps.powerless && measured.polarity() == Polarity::For;
    let is_open = caps.censored || caps.few || caps.not_run || no_clock || is_hollow;
    Some(if is_open { Verdict::Undecided } else { measured })
}

/// The class of a claim from those of its findings, and whether the paper leaves out what it would take.
pub fn combined(findings: impl IntoIterator<Item = Verdict>, untestable: bool) -> Verdict {
    let lacking = untestable.then_some(Verdict::Untestable);
    let found = findings.into_iter().chain(lacking);
    found.max_by_key(|verdict| rank(*verdict)).unwrap_or(Verdict::Undecided)
}

/// How much a finding weighs against others on the same claim.
fn rank(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Reproduced => 0,
        Verdict::Fitted => 1,
        Verdict::Attainable => 2,
        Verdict::DirectionOnly => 3,
        Verdict::Undecided => 4,
        Verdict::Untestable => 5,
        Verdict::NotReproduced => 6,
        Verdict::Impossible => 7,
    }
}

/// The class of a sentence that says all of its parts: the least of theirs (− < 0 < +), of equals the weakest.
///
/// Parts that leave it open make it undecided, unless the paper lacks something for every one of them.
pub fn all_of(parts: &[Verdict]) -> Verdict {
    let least = parts.iter().map(|part| part.polarity()).min();
    let among = |wanted| parts.iter().copied().filter(move |part| part.polarity() == wanted);
    match least {
        None => Verdict::Undecided,
        Some(Polarity::Open) => open(among(Polarity::Open)),
        Some(polarity) => among(polarity).max_by_key(|part| rank(*part)).unwrap_or(Verdict::Undecided),
    }
}

/// The class of a sentence that says some one of its parts: the greatest of theirs, of equals the strongest.
pub fn any_of(parts: &[Verdict]) -> Verdict {
    let greatest = parts.iter().map(|part| part.polarity()).max();
    let among = |wanted| parts.iter().copied().filter(move |part| part.polarity() == wanted);
    match greatest {
        None => Verdict::Undecided,
        Some(Polarity::Open) => open(among(Polarity::Open)),
        Some(polarity) => among(polarity).min_by_key(|part| rank(*part)).unwrap_or(Verdict::Undecided),
    }
}

/// The class of a sentence that means one of its parts and does not say which: that of all of them where they speak one
/// way, undecided where they do not.
pub fn one_meant(parts: &[Verdict]) -> Verdict {
    let all = all_of(parts);
    let any = any_of(parts);
    match (all.polarity(), any.polarity()) {
        (Polarity::For, _) | (Polarity::Open, Polarity::Open) => all,
        (_, Polarity::Against) => any,
        _ => Verdict::Undecided,
    }
}

fn open(mut parts: impl Iterator<Item = Verdict>) -> Verdict {
    if parts.all(|part| part == Verdict::Untestable) { Verdict::Untestable } else { Verdict::Undecided }
}

#[cfg(test)]
mod tests;
