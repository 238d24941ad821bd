//! The walk: straight at the goal, and over a key node whenever an obstacle stands in the way.

use super::{Tally, Walked};
use crate::planner::Ending;
use crate::planner::key_nodes::{Front, GUARDED, Key, PRINTED, keys};
use crate::planner::polyhedra::{Posed, is_within, steps};
use std::collections::BTreeSet;
use world::geometry::{Segment, Vec3};
use world::space::PolyhedraWorld;

/// A key node this near is where the walk already stands.
const SAME_PLACE: f64 = 1e-3;

/// What the walk has that the paper does not print.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each guard is there or not whatever the others are")]
pub(super) struct Guards {
    /// A face on whose plane the walk stands is in front of it.
    pub(super) faces: bool,
    /// Key nodes stand off their edge.
    pub(super) off: bool,
    /// Key nodes in an obstacle, outside the domain, or where the walk stands are passed over.
    pub(super) free: bool,
    /// No edge is taken twice.
    pub(super) once: bool,
    /// Ways are tested whole, not at their nodes alone.
    pub(super) whole: bool,
}

impl Guards {
    /// As printed.
    pub(super) const NONE: Self = Self { faces: false, off: false, free: false, once: false, whole: false };
    /// Those without which the walk stops on the first edge, or comes back to it.
    pub(super) const ALL: Self = Self { faces: true, off: true, free: true, once: true, whole: true };

    fn front(self) -> Front {
        let above = if self.faces { GUARDED.above } else { PRINTED.above };
        Front { above, push: if self.off { GUARDED.push } else { PRINTED.push } }
    }
}

/// How a stretch of the walk ended.
enum Leg {
    Arrived,
    Blocked { obstacle: usize },
}

/// A walk under way.
struct Walk<'a> {
    posed: &'a Posed<'a>,
    guards: Guards,
    points: Vec<Vec3>,
    keys: Vec<usize>,
    used: BTreeSet<(usize, usize)>,
    seen: BTreeSet<State>,
    tally: Tally,
}

/// All that the rest of a walk depends on: where it stands, where it goes, and how many edges it has taken.
type State = ([u64; 3], [u64; 3], usize);

/// Walks from start to goal, with these guards beside what is printed.
pub(super) fn walk(posed: &Posed<'_>, guards: Guards, max_legs: u64) -> Walked {
    let mut walk = Walk {
        posed,
        guards,
        points: vec![posed.start],
        keys: Vec::new(),
        used: BTreeSet::new(),
        seen: BTreeSet::new(),
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
            if !self.seen.insert(self.state(target)) {
                // It stands where it stood before and goes on as it did then, in circles.
                return Ending::NoPath;
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

    fn state(&self, target: Vec3) -> State {
        let exact = |point: Vec3| [point.x, point.y, point.z].map(f64::to_bits);
        (exact(self.here()), exact(target), self.used.len())
    }

    fn here(&self) -> Vec3 {
        self.points[self.points.len() - 1]
    }

    /// Steps towards `target` until it is reached or the next step touches an obstacle.
    fn advance(&mut self, target: Vec3) -> Leg {
        let Posed { world, .. } = *self.posed;
        let from = self.here();
        let step = world.step();
        let way = Segment::new(from, target);
        let length = (target - from).norm();
        let count = steps(length, step);
        let hit = if self.guards.whole { world.first_hit(&way) } else { None };
        for k in 1..=count {
            let share = if k == count { 1.0 } else { k as f64 * step / length };
            self.tally.opened += 1;
            let child = way.at(share);
            let blocking = match (self.guards.whole, hit) {
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
        let guards = self.guards;
        let found = keys(&world.obstacles()[obstacle], &here, &goal, guards.front());
        self.tally.opened += found.len() as u64;
        self.tally.generated += found.len() as u64;
        let is_elsewhere = |key: &Key| (key.point - here).norm() > SAME_PLACE;
        let is_open =
            |key: &Key| is_elsewhere(key) && world.is_free(&key.point) && is_within(world, &key.point);
        let is_new = |key: &Key| !self.used.contains(&(obstacle, key.edge));
        let is_allowed = |key: &&Key| (!guards.free || is_open(key)) && (!guards.once || is_new(key));
        let best = found.iter().filter(is_allowed).min_by(|a, b| a.detour.total_cmp(&b.detour)).copied()?;
        self.used.insert((obstacle, best.edge));
        // As printed the best key node may be the point that the walk stands on: it has nowhere to go.
        is_elsewhere(&best).then_some(best)
    }
}

/// The first obstacle that `point` is within, as printed (eq. 3): behind every plane, on none.
fn interior(world: &PolyhedraWorld, point: &Vec3) -> Option<usize> {
    let is_within =
        |convex: &world::geometry::Convex| convex.faces().iter().all(|face| face.plane.height(point) < 0.0);
    world.obstacles().iter().position(is_within)
}
