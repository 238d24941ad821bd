//! The walk: straight at the goal, and over a key node whenever an obstacle stands in the way.

use super::{Tally, Walked};
use crate::geometry::{Segment, Vec3};
use crate::planner::Ending;
use crate::planner::key_nodes::{GUARDED, Key, PRINTED, keys};
use crate::planner::polyhedra::{Posed, is_within, steps};
use crate::space::PolyhedraWorld;
use std::collections::BTreeSet;

/// A key node this near is where the walk already stands.
const SAME_PLACE: f64 = 1e-3;

/// How a stretch of the walk ended.
enum Leg {
    Arrived,
    Blocked { obstacle: usize },
}

/// A walk under way.
struct Walk<'a> {
    posed: &'a Posed<'a>,
    guarded: bool,
    points: Vec<Vec3>,
    keys: Vec<usize>,
    used: BTreeSet<(usize, usize)>,
    tally: Tally,
}

/// Walks from start to goal, as printed or with the guards that keep it from stopping on the first edge.
pub(super) fn walk(posed: &Posed<'_>, guarded: bool, max_legs: u64) -> Walked {
    let mut walk = Walk {
        posed,
        guarded,
        points: vec![posed.start],
        keys: Vec::new(),
        used: BTreeSet::new(),
        tally: Tally::default(),
    };
    let ending = walk.run(max_legs);
    Walked { ending, points: walk.points, keys: walk.keys, tally: walk.tally }
}

impl Walk<'_> {
    fn run(&mut self, max_legs: u64) -> Ending {
        let mut target = self.posed.goal;
        loop {
            if self.tally.expansions >= max_legs {
                return Ending::BudgetSpent;
            }
            self.tally.expansions += 1;
            match self.advance(target) {
                Leg::Arrived if target == self.posed.goal => return Ending::Solved,
                Leg::Arrived => {
                    self.keys.push(self.points.len() - 1);
                    target = self.posed.goal;
                }
                Leg::Blocked { obstacle } => match self.choose(obstacle) {
                    Some(key) => target = key.point,
                    None => return Ending::NoPath,
                },
            }
        }
    }

    fn here(&self) -> Vec3 {
        self.points[self.points.len() - 1]
    }

    /// Steps towards `target` until it is reached or the next step touches an obstacle.
    fn advance(&mut self, target: Vec3) -> Leg {
        let Posed { world, .. } = *self.posed;
        let (from, step) = (self.here(), world.step());
        let way = Segment::new(from, target);
        let length = (target - from).norm();
        let count = steps(length, step);
        let hit = if self.guarded { world.first_hit(&way) } else { None };
        for k in 1..=count {
            let share = if k == count { 1.0 } else { k as f64 * step / length };
            self.tally.opened += 1;
            let child = way.at(share);
            let blocking = match (self.guarded, hit) {
                (true, Some(hit)) => (hit.share <= share).then_some(hit.obstacle),
                (true, None) => None,
                (false, _) => interior(world, &child),
            };
            if let Some(obstacle) = blocking {
                return Leg::Blocked { obstacle };
            }
            self.points.push(child);
        }
        Leg::Arrived
    }

    /// The key node with the least cost; `None` if there is none to go to.
    fn choose(&mut self, obstacle: usize) -> Option<Key> {
        let Posed { world, goal, .. } = *self.posed;
        let here = self.here();
        let front = if self.guarded { GUARDED } else { PRINTED };
        let found = keys(&world.obstacles()[obstacle], &here, &goal, front);
        self.tally.opened += found.len() as u64;
        self.tally.generated += found.len() as u64;
        let is_allowed = |key: &&Key| {
            !self.guarded
                || ((key.point - here).norm() > SAME_PLACE
                    && world.is_free(&key.point)
                    && is_within(world, &key.point)
                    && !self.used.contains(&(obstacle, key.edge)))
        };
        let best = found.iter().filter(is_allowed).min_by(|a, b| a.detour.total_cmp(&b.detour)).copied()?;
        self.used.insert((obstacle, best.edge));
        // Without guards the best key node may be the point that the walk stands on: it has nowhere to go.
        (self.guarded || (best.point - here).norm() > SAME_PLACE).then_some(best)
    }
}

/// The first obstacle that `point` is within, as printed (eq. 3): behind every plane, on none.
fn interior(world: &PolyhedraWorld, point: &Vec3) -> Option<usize> {
    let is_within =
        |convex: &crate::geometry::Convex| convex.faces().iter().all(|face| face.plane.height(point) < 0.0);
    world.obstacles().iter().position(is_within)
}
