//! Pairs when each obstacle may have a shape of its own, in each case anew.
//!
//! Blocked points only lengthen ways. With the points that every shape blocks, lengths are at most, and with the
//! points that any shape blocks at least, what any choice of shapes gives; only pairs whose printed lengths lie
//! between the two are searched choice by choice.

use super::{Case, Pair, Variant, moves_where, search};
use crate::grid::{CornerRule, Moves};
use crate::search::OctileAstar;
use crate::seed::Stream;
use crate::space::{ArmRules, Zone};
use crate::study::prepared::workspace_map::ShapeSetting;
use rand::RngExt as _;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// The pairs that some choice of shapes gives the printed lengths, and what it took.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FreeShapes {
    /// The pairs, in rising order.
    pub pairs: Vec<Pair>,
    /// How many pairs had to be searched choice by choice.
    pub candidates: usize,
}

/// For each obstacle and shape, which points it blocks.
type Blocked = Vec<[Vec<bool>; 4]>;

impl FreeShapes {
    /// Enumerates every pair under every choice. Hops are judged by their end points.
    ///
    /// # Errors
    /// A sentence if an obstacle cannot be made.
    pub fn find(variant: &Variant, base: &ArmRules, cases: &[Case]) -> Result<Self, String> {
        let rules = variant.rules(base);
        let blocked = cases.iter().map(|case| blocked(variant, base, case)).collect::<Result<Vec<_>, _>>()?;
        let all: Vec<Choices<'_>> = cases
            .iter()
            .zip(&blocked)
            .map(|(case, blocked)| Choices {
                size: rules.lattice.size(),
                corner_rule: rules.corner_rule,
                target: case.target(),
                straight: case.hops[0],
                blocked,
            })
            .collect();
        let cells = rules.lattice.grid().cell_count();
        let mut live: Live = (0..cells).map(|start| (start, (start + 1..cells).collect())).collect();
        for choices in &all {
            live = choices.between(&live);
        }
        let candidates = live.values().map(BTreeSet::len).sum();
        let mut order: Vec<&Choices<'_>> = all.iter().collect();
        order.sort_by_key(|choices| choices.blocked.len());
        for choices in order {
            live = choices.attained(&live);
        }
        let pairs =
            live.into_iter().flat_map(|(start, goals)| goals.into_iter().map(move |goal| [start, goal]));
        Ok(Self { pairs: pairs.collect(), candidates })
    }
}

/// The free hops of each case when every obstacle has a shape drawn from `stream`. Hops are judged by their end points.
///
/// # Errors
/// A sentence if an obstacle cannot be made.
pub fn drawn_moves(
    variant: &Variant,
    base: &ArmRules,
    cases: &[Case; 2],
    stream: &mut Stream,
) -> Result<[Moves; 2], String> {
    let rules = variant.rules(base);
    let mut drawn = |case: &Case| {
        let blocked = blocked(variant, base, case)?;
        let shapes: Vec<usize> = blocked.iter().map(|shapes| stream.random_range(0..shapes.len())).collect();
        let is_blocked = |cell: usize| blocked.iter().zip(&shapes).any(|(of, shape)| of[*shape][cell]);
        Ok::<_, String>(moves_where(rules.lattice.size(), rules.corner_rule, is_blocked))
    };
    Ok([drawn(&cases[0])?, drawn(&cases[1])?])
}

fn blocked(variant: &Variant, base: &ArmRules, case: &Case) -> Result<Blocked, String> {
    let single = |center: &[f64; 2], shape| {
        let alone = Case { obstacles_cm: vec![*center], hops: case.hops };
        let world = variant.world(base, &alone, shape)?;
        Ok::<_, String>(world.zones().iter().map(|zone| *zone != Zone::Free).collect::<Vec<bool>>())
    };
    let shapes = case.obstacles_cm.iter().map(|center| {
        let [a, b, c, d] = ShapeSetting::ALL.map(|shape| single(center, shape));
        Ok([a?, b?, c?, d?])
    });
    shapes.collect()
}

/// Goals by start.
type Live = BTreeMap<u32, BTreeSet<u32>>;

/// The same pairs, each under one of its two points, so that few points have any: a search serves all pairs of a point.
///
/// Points with the most pairs take theirs first.
fn few_roots(live: &Live) -> Live {
    let mut ends = Live::new();
    for (start, goals) in live {
        for goal in goals {
            ends.entry(*start).or_default().insert(*goal);
            ends.entry(*goal).or_default().insert(*start);
        }
    }
    let mut order: Vec<(usize, u32)> = ends.iter().map(|(point, others)| (others.len(), *point)).collect();
    order.sort_by_key(|&(pairs, point)| (Reverse(pairs), point));
    let mut roots = Live::new();
    for (_, root) in order {
        let others = ends.remove(&root).unwrap_or_default();
        for other in &others {
            ends.entry(*other).or_default().remove(&root);
        }
        if !others.is_empty() {
            roots.insert(root, others);
        }
    }
    roots
}

/// The choices of one case: a shape for each obstacle.
struct Choices<'a> {
    size: [u32; 2],
    corner_rule: CornerRule,
    target: u32,
    straight: u32,
    blocked: &'a Blocked,
}

impl Choices<'_> {
    /// The pairs among `live` that some choice puts exactly the target apart.
    fn attained(&self, live: &Live) -> Live {
        let (mut met, roots) = (Live::new(), few_roots(live));
        let (count, levels) = (ShapeSetting::ALL.len(), self.blocked.len() as u32);
        for choice in 0..count.pow(levels) {
            let shape_of = |obstacle: usize| choice / count.pow(obstacle as u32) % count;
            let moves = moves_where(self.size, self.corner_rule, |cell| {
                self.blocked.iter().enumerate().any(|(index, shapes)| shapes[shape_of(index)][cell])
            });
            let find = |search: &mut OctileAstar, (root, others): (&u32, &BTreeSet<u32>)| {
                let mut found = Vec::new();
                search.flood(*root, self.target, |cell, cost| {
                    if cost == self.target && others.contains(&cell) {
                        found.push([*root.min(&cell), *root.max(&cell)]);
                    }
                });
                found
            };
            let found: Vec<Vec<Pair>> = roots.par_iter().map_init(|| search(&moves), find).collect();
            for [start, goal] in found.into_iter().flatten() {
                met.entry(start).or_default().insert(goal);
            }
        }
        met
    }

    /// The pairs among `live` whose length is at most the target with what every choice blocks, and at least the
    /// target with what any choice blocks, and whose parity a walk of the target's length has.
    fn between(&self, live: &Live) -> Live {
        let moves = |is_blocked: fn(&[Vec<bool>; 4], usize) -> bool| {
            moves_where(self.size, self.corner_rule, |cell| self.blocked.iter().any(|s| is_blocked(s, cell)))
        };
        let open = moves(|shapes, cell| shapes.iter().all(|shape| shape[cell]));
        let shut = moves(|shapes, cell| shapes.iter().any(|shape| shape[cell]));
        // A diagonal hop keeps the parity of column plus row, a straight one changes it.
        let parity = |cell: u32| (cell % self.size[0] + cell / self.size[0]) % 2;
        let find = |(open, shut): &mut (OctileAstar, OctileAstar),
                    (start, before): (&u32, &BTreeSet<u32>)| {
            let mut goals = BTreeSet::new();
            open.flood(*start, self.target, |cell, _| {
                if (parity(cell) + parity(*start) + self.straight).is_multiple_of(2) && before.contains(&cell)
                {
                    goals.insert(cell);
                }
            });
            shut.flood(*start, self.target - 1, |cell, _| {
                goals.remove(&cell);
            });
            (!goals.is_empty()).then_some((*start, goals))
        };
        let searches = || (search(&open), search(&shut));
        live.par_iter().map_init(searches, find).flatten_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_has_one_root_and_a_star_of_pairs_has_its_centre() {
        let live: Live =
            [(1, BTreeSet::from([5])), (2, BTreeSet::from([5, 7])), (3, BTreeSet::from([5]))].into();
        let roots = few_roots(&live);
        assert_eq!(roots, Live::from([(2, BTreeSet::from([7])), (5, BTreeSet::from([1, 2, 3]))]));
        assert!(few_roots(&Live::new()).is_empty());
    }
}
