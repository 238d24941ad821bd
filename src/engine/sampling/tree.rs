//! A tree of configurations, and who is near in it.
//!
//! All nodes are measured, eight side by side: below some ten thousand nodes of six to eight coordinates that takes less than the
//! motions which follow each question. Of equally far nodes the older one is nearer.

use super::Motions;
use crate::geometry::lanes::{dispatch, level};
use std::f64::consts::TAU;

/// How many nodes are measured side by side.
const GROUP: usize = 8;

/// Configurations, each with the one it was reached from.
#[derive(Debug, Clone)]
pub struct Tree {
    turn_on: Vec<bool>,
    configs: Vec<f64>,
    parents: Vec<u32>,
    /// By group, then by coordinate; what fills the last group is infinitely far.
    groups: Vec<[f64; GROUP]>,
}

impl Tree {
    /// The tree that has a root alone.
    pub fn new(motions: &Motions<'_>, root: &[f64]) -> Self {
        let turn_on = motions.turn_on().to_vec();
        let mut tree = Self { turn_on, configs: Vec::new(), parents: Vec::new(), groups: Vec::new() };
        tree.add(root, 0);
        tree
    }

    /// How many nodes it has, at least one.
    pub fn count(&self) -> usize {
        self.parents.len()
    }

    /// Adds a node; gives its number.
    pub fn add(&mut self, config: &[f64], parent: u32) -> u32 {
        let (node, axes) = (self.parents.len(), config.len());
        if node.is_multiple_of(GROUP) {
            self.groups.resize(self.groups.len() + axes, [f64::INFINITY; GROUP]);
        }
        for (axis, value) in config.iter().enumerate() {
            self.groups[node / GROUP * axes + axis][node % GROUP] = *value;
        }
        self.configs.extend_from_slice(config);
        self.parents.push(parent);
        node as u32
    }

    /// A node's configuration.
    pub fn config(&self, node: u32) -> &[f64] {
        let axes = self.turn_on.len();
        &self.configs[node as usize * axes..][..axes]
    }

    /// The node that a node was reached from; the root from itself.
    pub fn parent(&self, node: u32) -> u32 {
        self.parents[node as usize]
    }

    /// Makes another node the one that `node` is reached from.
    pub fn set_parent(&mut self, node: u32, parent: u32) {
        self.parents[node as usize] = parent;
    }

    /// The configurations from the root to a node.
    pub fn path(&self, node: u32) -> Vec<Vec<f64>> {
        let mut path = vec![self.config(node).to_vec()];
        let mut at = node;
        while self.parent(at) != at {
            at = self.parent(at);
            path.push(self.config(at).to_vec());
        }
        path.reverse();
        path
    }

    /// The node nearest to a configuration, and how far it is.
    pub fn nearest(&self, config: &[f64]) -> (u32, f64) {
        let mut best = (0, f64::INFINITY);
        self.each_group(config, |group, squares| {
            for (lane, square) in squares.iter().enumerate() {
                if *square < best.1 {
                    best = (group * GROUP + lane, *square);
                }
            }
        });
        (best.0 as u32, best.1.sqrt())
    }

    /// The `count` nodes nearest to a configuration, nearest first, each with how far it is.
    pub fn nearest_of(&self, config: &[f64], count: usize) -> Vec<(u32, f64)> {
        let mut all = Vec::with_capacity(self.count());
        self.each_group(config, |group, squares| {
            all.extend(
                squares.iter().enumerate().map(|(lane, square)| ((group * GROUP + lane) as u32, *square)),
            );
        });
        all.truncate(self.count());
        let order = |a: &(u32, f64), b: &(u32, f64)| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0));
        if count < all.len() {
            all.select_nth_unstable_by(count, order);
            all.truncate(count);
        }
        all.sort_unstable_by(order);
        all.into_iter().map(|(node, square)| (node, square.sqrt())).collect()
    }

    /// The squares of the distances from a configuration, a group at a time.
    fn each_group(&self, config: &[f64], visit: impl FnMut(usize, &[f64; GROUP])) {
        dispatch!(level(), _simd => measure(config, &self.turn_on, &self.groups, visit));
    }
}

#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn measure(
    config: &[f64],
    turn_on: &[bool],
    groups: &[[f64; GROUP]],
    mut visit: impl FnMut(usize, &[f64; GROUP]),
) {
    for (number, group) in groups.chunks_exact(config.len()).enumerate() {
        let mut squares = [0.0; GROUP];
        for ((values, own), turns_on) in group.iter().zip(config).zip(turn_on) {
            for (square, value) in squares.iter_mut().zip(values) {
                let gap = value - own;
                let gap = if *turns_on && gap.is_finite() { gap - TAU * (gap / TAU).round() } else { gap };
                *square += gap * gap;
            }
        }
        visit(number, &squares);
    }
}
