//! The table of verdicts: from a claim's outcomes under every interpretation that counts.
//!
//! Nothing here looks at trials or files. Results that hold, are open and contradict are counted once for equal results (h, o,
//! f of n); d is the default's outcome, s the second seed's. A verdict is as strong as the weakest result that holds; what was
//! searched for is attainable and what was fitted is fitted, never more. The lines of the table are tried from above.

use super::outcome::{Outcome, Polarity};
use serde::{Deserialize, Serialize};

/// The verdict on a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds under every interpretation, or under nine tenths with named exceptions.
    Reproduced,
    /// The same, of the sign of a claim whose size is missed.
    RightInDirection,
    /// More results hold than are open, and none contradicts it.
    Supported,
    /// It can be met: by an input that was searched for, or by one of many.
    Attainable,
    /// It is met where something was chosen so that it would be.
    Fitted,
    /// It holds under some interpretations and is contradicted under others.
    Depends,
    /// Too little is known to say.
    Inconclusive,
    /// More results contradict it than are open, and none holds.
    NotSupported,
    /// It is contradicted under every interpretation, or under nine tenths with named exceptions.
    NotReproduced,
    /// The printed numbers contradict arithmetic, geometry or each other.
    Impossible,
    /// The paper leaves out what is needed.
    NotTestable,
}

/// Where a verdict stands in the overview.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Column {
    /// For the claim.
    For,
    /// Attainable or fitted.
    Chosen,
    /// It depends.
    Depends,
    /// Neither way.
    Inconclusive,
    /// Against the claim.
    Against,
    /// Not testable.
    NotTestable,
}

impl Column {
    /// Every column.
    pub const ALL: [Self; 6] =
        [Self::For, Self::Chosen, Self::Depends, Self::Inconclusive, Self::Against, Self::NotTestable];

    /// Its head.
    pub fn name(self) -> &'static str {
        match self {
            Self::For => "for",
            Self::Chosen => "attainable or fitted",
            Self::Depends => "depends",
            Self::Inconclusive => "inconclusive",
            Self::Against => "against",
            Self::NotTestable => "not testable",
        }
    }
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Self; 11] = [
        Self::Reproduced,
        Self::RightInDirection,
        Self::Supported,
        Self::Attainable,
        Self::Fitted,
        Self::Depends,
        Self::Inconclusive,
        Self::NotSupported,
        Self::NotReproduced,
        Self::Impossible,
        Self::NotTestable,
    ];

    /// Its name in tables and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::RightInDirection => "right in direction",
            Self::Supported => "supported",
            Self::Attainable => "attainable",
            Self::Fitted => "fitted",
            Self::Depends => "depends",
            Self::Inconclusive => "inconclusive",
            Self::NotSupported => "not supported",
            Self::NotReproduced => "not reproduced",
            Self::Impossible => "impossible",
            Self::NotTestable => "not testable",
        }
    }

    /// What it means, in a line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Reproduced => {
                "holds under every interpretation, or under nine tenths with named exceptions"
            }
            Self::RightInDirection => "its sign is reproduced, but its size is not the printed one",
            Self::Supported => {
                "most interpretations agree and none contradicts it, or all agree but a choice was not varied"
            }
            Self::Attainable => "met on an input that was searched for, or on one of many",
            Self::Fitted => "holds, but something in the study was chosen to make it hold",
            Self::Depends => {
                "some interpretations agree and others contradict it; the choice that decides is named"
            }
            Self::Inconclusive => {
                "data or interpretations do not decide; the report names what would settle it"
            }
            Self::NotSupported => {
                "most interpretations contradict it and none agrees, or all contradict it but a choice was not varied"
            }
            Self::NotReproduced => {
                "contradicted under every interpretation, or under nine tenths with named exceptions"
            }
            Self::Impossible => "the printed numbers contradict arithmetic, geometry or each other",
            Self::NotTestable => "the paper leaves out what a test needs",
        }
    }

    /// Its column of the overview.
    pub fn column(self) -> Column {
        match self {
            Self::Reproduced | Self::RightInDirection | Self::Supported => Column::For,
            Self::Attainable | Self::Fitted => Column::Chosen,
            Self::Depends => Column::Depends,
            Self::Inconclusive => Column::Inconclusive,
            Self::NotSupported | Self::NotReproduced | Self::Impossible => Column::Against,
            Self::NotTestable => Column::NotTestable,
        }
    }

    /// How much evidence it takes, either way.
    fn strength(self) -> u8 {
        match self {
            Self::Inconclusive => 0,
            Self::NotTestable => 1,
            Self::Depends => 2,
            Self::Attainable => 3,
            Self::Fitted => 4,
            Self::Supported | Self::NotSupported => 5,
            Self::RightInDirection => 6,
            Self::Reproduced | Self::NotReproduced => 7,
            Self::Impossible => 8,
        }
    }
}

/// How the inputs of a claim were chosen, where that bears on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Chosen {
    /// The study was fitted to the claim.
    Fitted,
    /// They were searched for.
    Searched,
    /// One input among many meets it.
    Existence,
}

impl Chosen {
    /// The verdict of what is met so.
    fn verdict(self) -> Verdict {
        if self == Self::Fitted { Verdict::Fitted } else { Verdict::Attainable }
    }
}

/// What was found of a claim.
#[derive(Debug, Clone)]
pub struct Results<'a> {
    /// The outcome of each result that counts; one against the majority is open unless the second seed confirms it.
    pub outcomes: &'a [Outcome],
    /// Which way the default interpretation speaks.
    pub default: Polarity,
    /// Which way the second seed speaks: the default's where nothing is drawn, open where it was not run.
    pub second: Polarity,
    /// How its inputs were chosen.
    pub chosen: Option<Chosen>,
    /// Whether the claim states a size that can be missed.
    pub states_size: bool,
    /// Whether a choice that touches the claim was not varied.
    pub is_unvaried: bool,
}

/// The line of the table that gave a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// A proof holds under every interpretation.
    Proved,
    /// Every interpretation lacks something.
    Lacking,
    /// Some result meets what can be met.
    Met,
    /// No result meets it, and not all contradict it.
    NoExample,
    /// The second seed contradicts what was fitted.
    Refused,
    /// The default and the second seed speak opposite ways.
    SeedDecides,
    /// All results speak one way.
    All,
    /// Nine tenths do, with exceptions.
    Nine,
    /// More speak one way than are open.
    More,
    /// Results speak both ways.
    Both,
    /// None of these.
    Short,
}

/// Of ten results, how many must speak one way where others do not.
const TENTHS: usize = 9;

impl Results<'_> {
    /// How many results hold, are open, and contradict the claim.
    pub fn counts(&self) -> [usize; 3] {
        let count = |way| self.outcomes.iter().filter(|outcome| outcome.polarity() == way).count();
        [Polarity::For, Polarity::Open, Polarity::Against].map(count)
    }

    /// The verdict by the first line that applies, and that line.
    pub fn verdict(&self) -> (Verdict, Line) {
        let [holds, open, fails] = self.counts();
        let all = self.outcomes.len();
        let are_all = |wanted| all > 0 && self.outcomes.iter().all(|outcome| *outcome == wanted);
        if are_all(Outcome::Proved) {
            return (Verdict::Impossible, Line::Proved);
        }
        if are_all(Outcome::Lacking) {
            return (Verdict::NotTestable, Line::Lacking);
        }
        if let Some(met) = self.met() {
            return match (holds, met) {
                (0, _) if fails > 0 && fails == all => (Verdict::NotReproduced, Line::All),
                (0, _) => (Verdict::Inconclusive, Line::NoExample),
                (_, Verdict::Fitted) if self.second == Polarity::Against => {
                    (Verdict::Inconclusive, Line::Refused)
                }
                (_, met) => (met, Line::Met),
            };
        }
        if self.default != Polarity::Open && self.second == self.default.mirrored() {
            return (Verdict::Inconclusive, Line::SeedDecides);
        }
        let sides = [(Polarity::For, holds, fails), (Polarity::Against, fails, holds)];
        for (way, speak, _) in sides {
            let agree = [self.default, self.second] == [way; 2];
            if speak > 0 && (speak == all || agree && 10 * speak >= TENTHS * all) {
                return (self.firm(way), if speak == all { Line::All } else { Line::Nine });
            }
        }
        for (way, speak, contrary) in sides {
            // A second seed that speaks the opposite way has decided before.
            if contrary == 0 && speak > open && self.default == way {
                let verdict = if way == Polarity::For { Verdict::Supported } else { Verdict::NotSupported };
                return (verdict, Line::More);
            }
        }
        let is_both = holds > 0 && fails > 0;
        if is_both { (Verdict::Depends, Line::Both) } else { (Verdict::Inconclusive, Line::Short) }
    }

    /// The verdict of what is met, where inputs were chosen for the claim or for a result that holds.
    fn met(&self) -> Option<Verdict> {
        let weakest = self.outcomes.iter().copied().filter(|outcome| outcome.is_chosen()).max();
        let of_results =
            weakest.map(|one| if one == Outcome::Fitted { Verdict::Fitted } else { Verdict::Attainable });
        let of_claim = self.chosen.map(Chosen::verdict);
        of_results.into_iter().chain(of_claim).min_by_key(|verdict| verdict.strength())
    }

    /// The verdict where results speak one way.
    fn firm(&self, way: Polarity) -> Verdict {
        let is_sign = self.is_sign_alone();
        match (way, self.is_unvaried) {
            (Polarity::For, false) if is_sign => Verdict::RightInDirection,
            (Polarity::For, false) => Verdict::Reproduced,
            (Polarity::For, true) => Verdict::Supported,
            (_, false) => Verdict::NotReproduced,
            (_, true) => Verdict::NotSupported,
        }
    }

    /// Whether the claim states a size that some result which holds misses.
    pub fn is_sign_alone(&self) -> bool {
        self.states_size && self.outcomes.contains(&Outcome::SignOnly)
    }
}

/// The verdict of a sentence that means one of its parts and does not say which. It depends on the meaning if one part
/// is for it and one against. Otherwise it is the weakest part's verdict.
pub fn of_meanings(meanings: &[Verdict]) -> Verdict {
    let has = |columns: &[Column]| meanings.iter().any(|meaning| columns.contains(&meaning.column()));
    if has(&[Column::For, Column::Chosen]) && has(&[Column::Against]) {
        return Verdict::Depends;
    }
    // A meaning that cannot be tested leaves open what the others say.
    if has(&[Column::NotTestable]) && meanings.iter().any(|meaning| *meaning != Verdict::NotTestable) {
        return Verdict::Inconclusive;
    }
    meanings.iter().copied().min_by_key(|meaning| meaning.strength()).unwrap_or(Verdict::Inconclusive)
}

#[cfg(test)]
mod tests;
