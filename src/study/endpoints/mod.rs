//! Which pairs of lattice points have given shortest lengths in several cases of obstacles at once.
//!
//! A paper may print the lengths of its paths and not where they start and end. The inverse problem is enumerated
//! here: one exact single-source search (h = 0) a start and case, every goal read off it. Lengths are pairs of
//! straight and diagonal hops and are compared exactly. What the paper leaves open is a [`Variant`].

mod free_shapes;
mod never_lowered;
#[cfg(test)]
mod tests;

use crate::grid::{CornerRule, Grid2, Moves};
use crate::search::{Octile, OctileAstar, ScaledOctile, Ties};
use crate::space::{ArmRules, ArmWorld, Obstacle};
use crate::study::prepared::lattice::CornerSetting;
use crate::study::prepared::workspace_map::{ElbowSetting, HopSetting, ShapeSetting, TouchSetting};
use rayon::prelude::*;
use serde::Deserialize;

pub use free_shapes::{FreeShapes, drawn_moves};
pub use never_lowered::NeverLowered;

/// One case: where the obstacles are and how long the printed path is.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Centres of the obstacles.
    pub obstacles_cm: Vec<[f64; 2]>,
    /// Straight and diagonal hops of the printed path, one step of the lattice each.
    pub hops: [u32; 2],
}

impl Case {
    /// The printed length.
    pub fn length(&self) -> Octile {
        Octile { straight: self.hops[0], diagonal: self.hops[1] }
    }

    /// The printed length in the units of [`ScaledOctile`].
    pub fn target(&self) -> u32 {
        ScaledOctile::scaled(self.length())
    }
}

/// One way to fill in what the paper leaves open; what is absent is as the problem group has it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Its name in records.
    pub label: String,
    /// The shape of every obstacle.
    pub shape: ShapeChoice,
    /// The diameter of every obstacle.
    pub diameter_cm: f64,
    touching: Option<TouchSetting>,
    inner_radius_cm: Option<f64>,
    elbow: Option<ElbowSetting>,
    corner_rule: Option<CornerSetting>,
    hop_check: Option<HopSetting>,
    /// Whether the paper's A* lowers the g of an open node; lowered if absent.
    open_node: Option<OpenNode>,
    /// The order among equal f of that A*, which matters only where open nodes are never lowered; first in first out
    /// if absent.
    ties: Option<TieOrder>,
}

/// The shapes that obstacles may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub enum ShapeChoice {
    /// All have this one.
    Uniform(ShapeSetting),
    /// Each has any, in each case anew.
    Free(FreeWord),
}

/// The word for free shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FreeWord {
    /// `free`.
    Free,
}

/// What the paper's A* does with an open node to which a better way is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OpenNode {
    /// It takes it, so that lengths are shortest.
    Lowered,
    /// It does not, as the pseudocode may be read.
    Never,
}

/// The order among equal f.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TieOrder {
    /// The one opened first.
    Fifo,
    /// The one opened last.
    Lifo,
    /// The one with the larger g.
    LargerG,
}

impl From<TieOrder> for Ties {
    fn from(order: TieOrder) -> Self {
        match order {
            TieOrder::Fifo => Self::Fifo,
            TieOrder::Lifo => Self::Lifo,
            TieOrder::LargerG => Self::LargerG,
        }
    }
}

/// Two cells, the one with the smaller number first.
pub type Pair = [u32; 2];

impl Variant {
    /// The order among equal f where A* never lowers open nodes; nothing where lengths are shortest.
    pub fn never_lowered(&self) -> Option<Ties> {
        let ties = self.ties.map_or(Ties::Fifo, Into::into);
        self.open_node.filter(|rule| *rule == OpenNode::Never).map(|_| ties)
    }

    /// What is wrong with it, if anything: ties that do not matter, or shapes left open as well as lengths that are not
    /// shortest.
    pub fn fault(&self) -> Option<String> {
        let (label, never) = (&self.label, self.never_lowered().is_some());
        if self.ties.is_some() && !never {
            return Some(format!("variant `{label}` has ties, which only matter with open_node = \"never\""));
        }
        let is_free = matches!(self.shape, ShapeChoice::Free(_));
        (is_free && never).then(|| {
            format!("variant `{label}` leaves shapes open; open nodes are never lowered with one shape only")
        })
    }

    /// The rules of `base` with this variant's laid over them.
    pub fn rules(&self, base: &ArmRules) -> ArmRules {
        ArmRules {
            touch: self.touching.map_or(base.touch, Into::into),
            inner_radius_cm: self.inner_radius_cm.unwrap_or(base.inner_radius_cm),
            elbow: self.elbow.map_or(base.elbow, Into::into),
            corner_rule: self.corner_rule.map_or(base.corner_rule, Into::into),
            hop: self.hop_check.map_or(base.hop, Into::into),
            ..*base
        }
    }

    /// The workspace of `case` with every obstacle of one shape.
    ///
    /// # Errors
    /// A sentence if an obstacle cannot be made.
    pub fn world(&self, base: &ArmRules, case: &Case, shape: ShapeSetting) -> Result<ArmWorld, String> {
        let obstacles = case.obstacles_cm.iter().map(|center| shape.obstacle(*center, self.diameter_cm));
        Ok(ArmWorld::new(self.rules(base), obstacles.collect::<Result<Vec<Obstacle>, _>>()?))
    }
}

/// Every pair whose shortest 8-connected lengths are those of all `cases`, in rising order; `moves` are the free
/// hops in each case.
pub fn pairs(moves: &[Moves], cases: &[Case]) -> Vec<Pair> {
    let starts = 0..moves.first().map_or(0, Moves::cell_count);
    let found = starts.into_par_iter().map_init(
        || moves.iter().map(search).collect::<Vec<_>>(),
        |searches, start| {
            goals(searches, cases, start).into_iter().map(|goal| [start, goal]).collect::<Vec<_>>()
        },
    );
    found.flatten_iter().collect()
}

fn search(moves: &Moves) -> OctileAstar {
    OctileAstar::new(moves).expect("a workspace is smaller than the search's largest grid")
}

/// The goals above `start` that are at the printed length in every case; a case is searched only while goals remain.
fn goals(searches: &mut [OctileAstar], cases: &[Case], start: u32) -> Vec<u32> {
    let mut goals: Option<Vec<u32>> = None;
    for (search, case) in searches.iter_mut().zip(cases) {
        let mut here = Vec::new();
        search.flood(start, case.target(), |cell, cost| {
            if cost == case.target() && cell > start {
                here.push(cell);
            }
        });
        here.sort_unstable();
        let kept = match goals {
            None => here,
            Some(before) => before.into_iter().filter(|goal| here.binary_search(goal).is_ok()).collect(),
        };
        if kept.is_empty() {
            return kept;
        }
        goals = Some(kept);
    }
    goals.unwrap_or_default()
}

/// How random lengths fare: of all targets that could have been printed, those that some pair meets.
///
/// A target is one length for each of two cases, each within `window_cm` of the printed one, whose numbers of
/// straight hops are both even or both odd, as walks between the same two points have them.
#[derive(Debug, Clone)]
pub struct Targets {
    lengths: [Vec<Octile>; 2],
    lowest: [u32; 2],
    /// The place of each scaled length among `lengths`.
    places: [Vec<Option<usize>>; 2],
}

impl Targets {
    /// The targets around the lengths of two `cases`.
    pub fn new(cases: &[Case; 2], window: f64) -> Self {
        let lengths = cases.each_ref().map(|case| lengths_near(case.length(), window));
        let scaled =
            lengths.each_ref().map(|all| all.iter().map(|l| ScaledOctile::scaled(*l)).collect::<Vec<_>>());
        let lowest = scaled.each_ref().map(|all| all.iter().copied().min().unwrap_or_default());
        let places = [0, 1].map(|case| {
            let highest = scaled[case].iter().copied().max().unwrap_or_default();
            let mut places = vec![None; (highest - lowest[case] + 1) as usize];
            for (place, value) in scaled[case].iter().enumerate() {
                places[(value - lowest[case]) as usize] = Some(place);
            }
            places
        });
        Self { lengths, lowest, places }
    }

    /// How many targets there are.
    pub fn count(&self) -> usize {
        let odd = |case: usize| self.lengths[case].iter().filter(|l| !l.straight.is_multiple_of(2)).count();
        let (odds, all) = ([odd(0), odd(1)], [self.lengths[0].len(), self.lengths[1].len()]);
        odds[0] * odds[1] + (all[0] - odds[0]) * (all[1] - odds[1])
    }

    /// Which targets some pair meets, by number.
    pub fn hits(&self, moves: &[Moves; 2]) -> Vec<bool> {
        let starts = (0..moves[0].cell_count()).into_par_iter();
        let mark = |(mut searches, mut hits): ([OctileAstar; 2], Vec<bool>), start| {
            let mut first = vec![None; moves[0].cell_count() as usize];
            let [one, two] = &mut searches;
            one.flood(start, self.highest(0), |cell, cost| first[cell as usize] = Some(cost));
            two.flood(start, self.highest(1), |cell, cost| {
                if let Some(first) = first[cell as usize] {
                    self.mark(&mut hits, [first, cost]);
                }
            });
            (searches, hits)
        };
        let begun = || (moves.each_ref().map(search), self.none());
        starts.fold(begun, mark).map(|(_, hits)| hits).reduce(|| self.none(), either)
    }

    /// No target is hit.
    fn none(&self) -> Vec<bool> {
        vec![false; self.lengths[0].len() * self.lengths[1].len()]
    }

    /// Marks the target of these scaled lengths among `hits`, if there is one.
    fn mark(&self, hits: &mut [bool], lengths: [u32; 2]) {
        if let (Some(a), Some(b)) = (self.place(0, lengths[0]), self.place(1, lengths[1])) {
            hits[a * self.lengths[1].len() + b] = true;
        }
    }

    fn highest(&self, case: usize) -> u32 {
        self.lowest[case] + self.places[case].len() as u32 - 1
    }

    fn place(&self, case: usize, cost: u32) -> Option<usize> {
        self.places[case].get(cost.checked_sub(self.lowest[case])? as usize).copied().flatten()
    }
}

/// What is hit in one of the two.
fn either(mut one: Vec<bool>, other: Vec<bool>) -> Vec<bool> {
    one.iter_mut().zip(other).for_each(|(one, other)| *one |= other);
    one
}

/// Every `a + b√2` within `window` of `centre`, in steps.
fn lengths_near(centre: Octile, window: f64) -> Vec<Octile> {
    use crate::search::Cost as _;
    let most = (centre.value() + window) as u32;
    let all = (0..=most).flat_map(|straight| (0..=most).map(move |diagonal| Octile { straight, diagonal }));
    all.filter(|length| (length.value() - centre.value()).abs() <= window).collect()
}

/// The moves of a grid on which a cell is blocked if `is_blocked` says so of it.
fn moves_where(size: [u32; 2], corner_rule: CornerRule, is_blocked: impl Fn(usize) -> bool) -> Moves {
    let mut grid = Grid2::new(size[0], size[1]).expect("the size is that of a workspace");
    for cell in 0..grid.cell_count() {
        grid.set_blocked(cell, is_blocked(cell as usize));
    }
    Moves::new(&grid, corner_rule)
}
