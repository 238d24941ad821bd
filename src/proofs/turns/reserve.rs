//! The least length on which a missing turn can still be had.
//!
//! Computed backwards from the goals, shortest way first, over (cell, direction of arrival). A way is kept if it turns
//! more than every shorter one; turn beyond the missing one does not count. Asking for enough turn, and not for the
//! exact one, leaves few ways and makes the answer a lower bound.

use std::{cmp::Reverse, collections::BinaryHeap};

use super::net::Net;

/// For each cell and direction of arrival, ways on to a goal: turn and length, both rising.
pub(super) struct Reserve {
    wanted_deg: f64,
    directions: usize,
    ways: Vec<Vec<(f64, f64)>>,
}

/// A way on from `cell`, leaving it in `direction`; the bend at the cell is not in it yet.
struct Way {
    cell: usize,
    direction: usize,
    length: f64,
    turn_deg: f64,
}

struct Backward<'a> {
    net: &'a Net,
    reserve: Reserve,
    /// By cell and direction of arrival: where segments come from and how long they are.
    incoming: Vec<Vec<(usize, f64)>>,
    found: Vec<Way>,
    queue: BinaryHeap<Reverse<(u64, usize)>>,
}

impl Reserve {
    /// The ways of `net` towards a turn sum of `wanted_deg`; arriving at a goal in a direction adds `at_goal_deg` of it.
    pub(super) fn new(net: &Net, wanted_deg: f64, at_goal_deg: impl Fn(usize) -> f64) -> Self {
        let directions = net.directions();
        let states = net.len() * net.directions();
        let mut incoming = vec![Vec::new(); states];
        for from in 0..net.len() {
            for segment in net.segments(from) {
                incoming[segment.to * directions + segment.direction].push((from, segment.length));
            }
        }
        let reserve = Self { wanted_deg, directions, ways: vec![Vec::new(); states] };
        let mut backward = Backward { net, reserve, incoming, found: Vec::new(), queue: BinaryHeap::new() };
        backward.run(at_goal_deg);
        backward.reserve
    }

    /// The least length from `cell`, reached in `direction` with `turn_deg` so far, to a goal with the turn
    /// wanted or more; infinite if the query's longest does not allow it.
    pub(super) fn least_length(&self, cell: usize, direction: usize, turn_deg: f64) -> f64 {
        let ways = &self.ways[cell * self.directions + direction];
        let enough = ways.partition_point(|way| way.0 < self.wanted_deg - turn_deg - ROUNDING_DEG);
        ways.get(enough).map_or(f64::INFINITY, |way| way.1)
    }
}

/// Sums of the same angles in another order differ by less.
const ROUNDING_DEG: f64 = 1e-9;

impl Backward<'_> {
    fn run(&mut self, at_goal_deg: impl Fn(usize) -> f64) {
        let directions = self.net.directions();
        for goal in (0..self.net.len()).filter(|&cell| self.net.is_goal(cell)) {
            for direction in 0..directions {
                self.arrive(goal, direction, 0.0, at_goal_deg(direction));
            }
        }
        let mut most_deg = vec![-1.0; self.net.len() * directions];
        while let Some(Reverse((_, id))) = self.queue.pop() {
            let Way { cell, direction, length, turn_deg } = self.found[id];
            let most = &mut most_deg[cell * directions + direction];
            if turn_deg <= *most {
                continue;
            }
            *most = turn_deg;
            for arrival in (0..directions).filter(|&arrival| arrival != direction) {
                self.arrive(cell, arrival, length, turn_deg + self.net.bend_deg(arrival, direction));
            }
        }
    }

    /// Keeps a way on from an arrival if it turns more than the shorter ones, and queues what leads there.
    fn arrive(&mut self, cell: usize, direction: usize, length: f64, turn_deg: f64) {
        let state = cell * self.reserve.directions + direction;
        let turn_deg = turn_deg.min(self.reserve.wanted_deg.max(0.0));
        if self.reserve.ways[state].last().is_some_and(|most| turn_deg <= most.0) {
            return;
        }
        self.reserve.ways[state].push((turn_deg, length));
        for &(from, step) in &self.incoming[state] {
            let length = length + step;
            if self.net.least_from_start(from) + length <= self.net.longest() {
                self.queue.push(Reverse((length.to_bits(), self.found.len())));
                self.found.push(Way { cell: from, direction, length, turn_deg });
            }
        }
    }
}
