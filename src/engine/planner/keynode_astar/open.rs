//! Key nodes as the nodes of A*: what is seen round each obstacle in the way, searched best first.

use super::{Tally, Walked};
use crate::planner::Ending;
use crate::planner::key_nodes::{GUARDED, Key, key, keys};
use crate::planner::polyhedra::{Posed, densified, is_within, steps};
use crate::search::{Combined, Graph, Heap, Outcome, Rules, Search, SideInputs, Stop, Ties, Update, sum};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use world::geometry::{Segment, Vec3, distance_segment_convex};
use world::space::PolyhedraWorld;

const START: u32 = 0;
const GOAL: u32 = 1;

/// The states met so far.
struct States {
    points: Vec<Vec3>,
    /// The length of the last way found to each.
    reached_over: Vec<f64>,
    known: BTreeMap<(usize, usize, u64), u32>,
}

/// What can be walked to from a key node.
struct Keys<'a> {
    posed: &'a Posed<'a>,
    cluster: bool,
    states: &'a RefCell<States>,
    tally: Tally,
}

/// Searches key nodes best first; `cluster` says whether a node that sees no way round the obstacle before it
/// looks round all that touch it.
pub(super) fn search(posed: &Posed<'_>, cluster: bool, max_expansions: u64) -> Walked {
    let states = RefCell::new(States {
        points: vec![posed.start, posed.goal],
        reached_over: vec![0.0; 2],
        known: BTreeMap::new(),
    });
    let mut graph = Keys { posed, cluster, states: &states, tally: Tally::default() };
    let h = |node: u32| (states.borrow().points[node as usize] - posed.goal).norm();
    let terms = SideInputs {
        graph: &mut graph,
        estimate: &Combined { h, combine: sum },
        observer: &mut (),
        update: Update { reopen_closed: true, ..Update::default() },
    };
    let rules = Rules { stop: Stop::GoalPopped, max_expansions };
    let mut search = Search::new(Heap::new(Ties::LargerG));
    let report = search.run(terms, START, |node| node == GOAL, rules, &mut ());
    let mut tally = graph.tally;
    tally.expansions = report.counters.expansions;
    let (ending, corners) = match &report.outcome {
        Outcome::Solved(route) => {
            let states = states.borrow();
            (Ending::Solved, route.nodes.iter().map(|node| states.points[*node as usize]).collect())
        }
        Outcome::NoPath => (Ending::NoPath, Vec::new()),
        Outcome::BudgetSpent => (Ending::BudgetSpent, Vec::new()),
    };
    let step = posed.world.step();
    let walked = |pair: &[Vec3]| steps((pair[1] - pair[0]).norm(), step).max(1) as usize;
    let mut at = 0;
    let ends = corners.windows(2).map(|pair| {
        at += walked(pair);
        at
    });
    let keys = ends.take(corners.len().saturating_sub(2)).collect();
    Walked { ending, points: densified(&corners, step), keys, tally }
}

impl Graph for Keys<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.states.borrow().points.len()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        let Posed { world, goal, .. } = *self.posed;
        let (x, walked) = {
            let states = self.states.borrow();
            (states.points[node as usize], states.reached_over[node as usize])
        };
        let apart = (goal - x).norm();
        let hit = world.first_hit(&Segment::new(x, goal));
        let straight = hit.map_or(apart, |hit| hit.share * apart);
        self.tally.opened += steps(walked, world.step()) + steps(straight, world.step());
        let Some(hit) = hit else {
            visit(GOAL, apart);
            return;
        };
        let mut accepted = self.seen_round(&x, hit.obstacle);
        if accepted.is_empty() && self.cluster {
            accepted = self.seen_round_cluster(&x, hit.obstacle);
        }
        for (to, length) in accepted {
            self.states.borrow_mut().reached_over[to as usize] = length;
            visit(to, length);
        }
    }
}

impl Keys<'_> {
    /// The key nodes seen from `x` on the obstacle in the way, and on those that stand in the way to them.
    fn seen_round(&mut self, x: &Vec3, first: usize) -> Vec<(u32, f64)> {
        let world = self.posed.world;
        let mut queue = VecDeque::from([first]);
        let mut met = BTreeSet::from([first]);
        let mut accepted = Vec::new();
        while let Some(obstacle) = queue.pop_front() {
            let found = keys(&world.obstacles()[obstacle], x, &self.posed.goal, GUARDED);
            for key in found {
                match self.offer(x, obstacle, &key) {
                    Ok(step) => accepted.extend(step),
                    Err(other) if met.insert(other) => queue.push_back(other),
                    Err(_) => {}
                }
            }
        }
        accepted
    }

    /// The key nodes seen from `x` on every edge of the obstacles that hang together with `first`.
    fn seen_round_cluster(&mut self, x: &Vec3, first: usize) -> Vec<(u32, f64)> {
        let world = self.posed.world;
        let mut accepted = Vec::new();
        for obstacle in touching(world, first) {
            let convex = &world.obstacles()[obstacle];
            for edge in 0..convex.edges().len() {
                let key = key(convex, edge, x, &self.posed.goal, GUARDED.push);
                accepted.extend(self.offer(x, obstacle, &key).ok().flatten());
            }
        }
        accepted
    }

    /// The state of a key node and the way to it; `None` if it is where `x` is.
    ///
    /// # Errors
    /// The obstacle that holds it or stands in the way.
    fn offer(&mut self, x: &Vec3, obstacle: usize, key: &Key) -> Result<Option<(u32, f64)>, usize> {
        let world = self.posed.world;
        self.tally.opened += 1;
        self.tally.generated += 1;
        let bin = (key.along / (world.step() / 2.0)) as u64;
        let mut states = self.states.borrow_mut();
        let known = states.known.get(&(obstacle, key.edge, bin)).copied();
        let point = known.map_or(key.point, |state| states.points[state as usize]);
        let length = (point - x).norm();
        // At a wall of the domain a key node may stand off its edge and out of the domain: there is no way over it.
        if length <= 1e-9 || !is_within(world, &point) {
            return Ok(None);
        }
        if let Some(holder) = world.obstacles().iter().position(|convex| world.holds(convex, &point)) {
            return Err(holder);
        }
        if let Some(hit) = world.first_hit(&Segment::new(*x, point)) {
            return Err(hit.obstacle);
        }
        let state = known.unwrap_or_else(|| {
            let state = states.points.len() as u32;
            states.points.push(point);
            states.reached_over.push(0.0);
            states.known.insert((obstacle, key.edge, bin), state);
            state
        });
        Ok(Some((state, length)))
    }
}

/// The obstacles that hang together with `first`, itself included, nearest links first.
fn touching(world: &PolyhedraWorld, first: usize) -> Vec<usize> {
    let obstacles = world.obstacles();
    let mut found = vec![first];
    let mut at = 0;
    while at < found.len() {
        let one = &obstacles[found[at]];
        for (index, other) in obstacles.iter().enumerate() {
            if !found.contains(&index) && one.aabb().overlaps(other.aabb()) && touch(one, other) {
                found.push(index);
            }
        }
        at += 1;
    }
    found
}

/// Whether two polyhedra share a point: an edge of one then meets the other, unless one lies within the other,
/// and then its edges do.
fn touch(a: &world::geometry::Convex, b: &world::geometry::Convex) -> bool {
    let edges_meet = |one: &world::geometry::Convex, other: &world::geometry::Convex| {
        one.edges().iter().any(|edge| {
            let [from, to] = edge.ends.map(|end| one.vertices()[end]);
            distance_segment_convex(&Segment::new(from, to), other) <= 1e-9
        })
    };
    edges_meet(a, b) || edges_meet(b, a)
}
