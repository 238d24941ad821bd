//! Ways distinguished by how far they turn where they are equally long.

use super::cost::{Cost, quantised};
use super::graph::Graph;
use std::cmp::Ordering;

/// The length of a way and, among equals, how far it has turned.
///
/// How far a way turns depends on how it arrives, so that the best way to a node need not begin the best way beyond it. A search
/// over these costs finds a shortest path and prefers straight ones, but not always the straightest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bent {
    /// The length.
    pub length: f64,
    /// The sum of the angles between one step and the next, in degrees.
    pub turned_deg: f64,
    /// The last step, in columns and rows; [0, 0] where none was made.
    way: [i32; 2],
}

impl Bent {
    fn step(length: f64, way: [i32; 2]) -> Self {
        Self { length, turned_deg: 0.0, way }
    }
}

impl Cost for Bent {
    const ZERO: Self = Self { length: 0.0, turned_deg: 0.0, way: [0, 0] };

    fn plus(self, other: Self) -> Self {
        let ([ax, ay], [bx, by]) = (self.way, other.way);
        let cross = ax * by - ay * bx;
        let dot = ax * bx + ay * by;
        // atan2(0, 0) is 0: the first step turns from nothing.
        let turn_deg = libm::atan2(f64::from(cross.abs()), f64::from(dot)).to_degrees();
        let turned_deg = self.turned_deg + other.turned_deg + turn_deg;
        Self { length: self.length + other.length, turned_deg, way: other.way }
    }

    fn compare(self, other: Self) -> Ordering {
        let key = |cost: Self| (quantised(cost.length), cost.tie());
        key(self).cmp(&key(other))
    }

    fn value(self) -> f64 {
        self.length
    }

    fn tie(self) -> u64 {
        quantised(self.turned_deg)
    }
}

/// A graph on a grid whose steps know their direction.
#[derive(Debug)]
pub struct BentGraph<G> {
    plain: G,
    width: u32,
}

impl<G: Graph<Cost = f64>> BentGraph<G> {
    /// The graph `plain`, whose nodes are the cells of a grid of `width` columns, row by row.
    pub fn new(plain: G, width: u32) -> Self {
        Self { plain, width }
    }
}

impl<G: Graph<Cost = f64>> Graph for BentGraph<G> {
    type Cost = Bent;

    fn node_count(&self) -> usize {
        self.plain.node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, Bent)) {
        let width = self.width;
        let at = |cell: u32| [(cell % width) as i32, (cell / width) as i32];
        let [x, y] = at(node);
        self.plain.successors(node, |to, length| {
            let [to_x, to_y] = at(to);
            visit(to, Bent::step(length, [to_x - x, to_y - y]));
        });
    }
}
