//! How many other lengths some pair would have met as well: the null rate of an identification.

use super::choices::{self, Choices, Match, Starts};
use super::union;
use crate::search::{GridSet, Octile, ScaledOctile};
use base::grid::Moves;
use rayon::prelude::*;

/// How random lengths fare: of all targets that could have been printed, those that some pair meets.
///
/// A target is one length for each of two cases, each within a window of the printed one, whose numbers of straight hops
/// are both even or both odd, as walks between the same two points have them.
#[derive(Debug, Clone)]
pub struct Targets {
    pub(super) lengths: [Vec<Octile>; 2],
    lowest: [u32; 2],
    /// The place of each scaled length among `lengths`.
    places: [Vec<Option<u32>>; 2],
}

impl Targets {
    /// The targets within `window` steps of two printed lengths.
    pub fn new(printed: [Octile; 2], window: f64) -> Self {
        let lengths = printed.map(|length| lengths_near(length, window));
        let scaled =
            lengths.each_ref().map(|all| all.iter().map(|l| ScaledOctile::scaled(*l)).collect::<Vec<_>>());
        let lowest = scaled.each_ref().map(|all| all.iter().copied().min().unwrap_or_default());
        let places = [0, 1].map(|case| {
            let highest = scaled[case].iter().copied().max().unwrap_or_default();
            let mut places = vec![None; (highest - lowest[case] + 1) as usize];
            for (place, value) in (0..).zip(&scaled[case]) {
                places[(value - lowest[case]) as usize] = Some(place);
            }
            places
        });
        Self { lengths, lowest, places }
    }

    /// How many targets there are.
    pub fn count(&self) -> usize {
        let odd = |case: usize| self.lengths[case].iter().filter(|l| !l.straight.is_multiple_of(2)).count();
        let odds = [odd(0), odd(1)];
        let all = [self.lengths[0].len(), self.lengths[1].len()];
        odds[0] * odds[1] + (all[0] - odds[0]) * (all[1] - odds[1])
    }

    /// For each alternative, as in [`pairs`](super::pairs), what is met.
    ///
    /// # Panics
    /// As [`pairs`](super::pairs) does.
    pub fn met(&self, cases: &[Vec<Moves>; 2], rule: Match) -> Vec<Met> {
        let met = choices::batches(cases, rule).into_iter().flat_map(|(alternatives, cases)| {
            let (hits, attained) = self.met_by(&cases);
            (0..alternatives).map(move |place| {
                let in_it =
                    |all: &[GridSet]| all.iter().map(|met| met >> place & 1 == 1).collect::<Vec<bool>>();
                Met {
                    hits: in_it(&hits),
                    attainable: self.attainable(&attained.each_ref().map(|all| in_it(all))),
                }
            })
        });
        met.collect()
    }

    /// The targets whose every length is that of some pair in its case.
    fn attainable(&self, attained: &[Vec<bool>; 2]) -> Vec<bool> {
        let mut all = self.none();
        for (one, first) in self.lengths[0].iter().enumerate() {
            for (two, second) in self.lengths[1].iter().enumerate() {
                let is_target = first.straight % 2 == second.straight % 2;
                all[self.number(one as u32, two as u32)] = is_target && attained[0][one] && attained[1][two];
            }
        }
        all
    }

    /// For each target the alternatives for which some pair meets it, and for each length of a case those for which some pair has
    /// it there.
    fn met_by(&self, cases: &[Choices]) -> (Vec<GridSet>, [Vec<GridSet>; 2]) {
        let cells = cases[0].cell_count();
        let none = || vec![0; self.lengths[0].len() * self.lengths[1].len()];
        let unmet = || (none(), self.lengths.each_ref().map(|lengths| vec![0; lengths.len()]));
        let begun = || (cases.to_vec(), vec![Vec::new(); cells as usize], unmet());
        let starts = Starts::new(cases, &self.lowest);
        let mark = |(mut cases, mut first, (mut hits, mut attained)): Marking, start| {
            first.iter_mut().for_each(Vec::clear);
            cases[0].flood(start, self.highest(0), |cell, cost, met| {
                if let Some(place) = self.place(0, cost).filter(|_| starts.counts(start, cell)) {
                    note(&mut first[cell as usize], place, met);
                    attained[0][place as usize] |= met;
                }
            });
            cases[1].flood(start, self.highest(1), |cell, cost, met| {
                if let Some(place) = self.place(1, cost).filter(|_| starts.counts(start, cell)) {
                    attained[1][place as usize] |= met;
                    for (before, met_before) in &first[cell as usize] {
                        hits[self.number(*before, place)] |= met & met_before;
                    }
                }
            });
            (cases, first, (hits, attained))
        };
        let met = starts.cells().fold(begun, mark).map(|(_, _, met)| met);
        met.reduce(unmet, |(hits, [one, two]), (more, [other_one, other_two])| {
            (union(hits, more), [union(one, other_one), union(two, other_two)])
        })
    }

    /// No target is hit.
    pub fn none(&self) -> Vec<bool> {
        vec![false; self.lengths[0].len() * self.lengths[1].len()]
    }

    /// Marks the target of these scaled lengths among `hits`, if there is one.
    pub(super) fn mark(&self, hits: &mut [bool], lengths: [u32; 2]) {
        if let (Some(one), Some(two)) = (self.place(0, lengths[0]), self.place(1, lengths[1])) {
            hits[self.number(one, two)] = true;
        }
    }

    /// The least and the largest scaled length of a case.
    pub(super) fn bounds(&self, case: usize) -> [u32; 2] {
        [self.lowest[case], self.highest(case)]
    }

    fn highest(&self, case: usize) -> u32 {
        self.lowest[case] + self.places[case].len() as u32 - 1
    }

    /// The place of a scaled length among those of a case.
    pub(super) fn place(&self, case: usize, cost: u32) -> Option<u32> {
        self.places[case].get(cost.checked_sub(self.lowest[case])? as usize).copied().flatten()
    }

    /// The number of the target of two lengths.
    pub(super) fn number(&self, one: u32, two: u32) -> usize {
        one as usize * self.lengths[1].len() + two as usize
    }
}

/// Which targets are met.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Met {
    /// By number: some pair has both lengths.
    pub hits: Vec<bool>,
    /// By number: some pair has one length in the first case and some pair, the same or another, the other in the second.
    pub attainable: Vec<bool>,
}

/// The searches, the lengths that cells have in the first case, and what is met so far.
type Marking = (Vec<Choices>, Vec<Lengths>, (Vec<GridSet>, [Vec<GridSet>; 2]));

/// The places of the lengths of a cell, and for which alternatives it has them.
type Lengths = Vec<(u32, GridSet)>;

fn note(lengths: &mut Lengths, place: u32, met: GridSet) {
    match lengths.iter_mut().find(|(known, _)| *known == place) {
        Some((_, before)) => *before |= met,
        None => lengths.push((place, met)),
    }
}

/// Every `a + b√2` within `window` of `centre`, in steps.
fn lengths_near(centre: Octile, window: f64) -> Vec<Octile> {
    use crate::search::Cost as _;
    let most = (centre.value() + window) as u32;
    let all = (0..=most).flat_map(|straight| (0..=most).map(move |diagonal| Octile { straight, diagonal }));
    all.filter(|length| (length.value() - centre.value()).abs() <= window).collect()
}
