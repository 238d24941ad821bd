//! How many other lengths some pair would have met as well: the null rate of an identification.

use super::choices::{self, Choices, Match};
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
        let (odds, all) = ([odd(0), odd(1)], [self.lengths[0].len(), self.lengths[1].len()]);
        odds[0] * odds[1] + (all[0] - odds[0]) * (all[1] - odds[1])
    }

    /// For each alternative, as in [`pairs`](super::pairs), which targets some pair meets, by number.
    ///
    /// # Panics
    /// As [`pairs`](super::pairs) does.
    pub fn hits(&self, cases: &[Vec<Moves>; 2], rule: Match) -> Vec<Vec<bool>> {
        let hits = choices::batches(cases, rule).into_iter().flat_map(|(alternatives, cases)| {
            let hits = self.hits_of(&cases);
            (0..alternatives).map(move |place| hits.iter().map(|met| met >> place & 1 == 1).collect())
        });
        hits.collect()
    }

    /// For each target the alternatives for which some pair meets it.
    fn hits_of(&self, cases: &[Choices]) -> Vec<GridSet> {
        let cells = cases[0].cell_count();
        let none = || vec![0; self.lengths[0].len() * self.lengths[1].len()];
        let begun = || (cases.to_vec(), vec![Vec::new(); cells as usize], none());
        let mark = |(mut cases, mut first, mut hits): (Vec<Choices>, Vec<Lengths>, Vec<GridSet>), start| {
            first[start as usize + 1..].iter_mut().for_each(Vec::clear);
            cases[0].flood(start, self.highest(0), |cell, cost, met| {
                if let Some(place) = self.place(0, cost).filter(|_| cell > start) {
                    note(&mut first[cell as usize], place, met);
                }
            });
            cases[1].flood(start, self.highest(1), |cell, cost, met| {
                if let Some(place) = self.place(1, cost).filter(|_| cell > start) {
                    for (before, met_before) in &first[cell as usize] {
                        hits[self.number(*before, place)] |= met & met_before;
                    }
                }
            });
            (cases, first, hits)
        };
        let hits = (0..cells).into_par_iter().fold(begun, mark).map(|(_, _, hits)| hits);
        hits.reduce(none, union)
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
