//! A tree of configurations, and who is near in it.

use super::{Index, Motions};

/// Configurations, each with the one it was reached from.
#[derive(Debug, Clone)]
pub struct Tree {
    configs: Index,
    parents: Vec<u32>,
}

impl Tree {
    /// The tree that has a root alone.
    pub fn new(motions: &Motions<'_>, root: &[f64]) -> Self {
        let mut tree = Self { configs: Index::new(motions.turn_on()), parents: Vec::new() };
        tree.add(root, 0);
        tree
    }

    /// How many nodes it has, at least one.
    pub fn count(&self) -> usize {
        self.parents.len()
    }

    /// Adds a node; gives its number.
    pub fn add(&mut self, config: &[f64], parent: u32) -> u32 {
        self.parents.push(parent);
        self.configs.add(config)
    }

    /// A node's configuration.
    pub fn config(&self, node: u32) -> &[f64] {
        self.configs.point(node)
    }

    /// The node that a node was reached from; the root from itself.
    pub fn parent(&self, node: u32) -> u32 {
        self.parents[node as usize]
    }

    /// Makes another node the one that `node` is reached from.
    pub fn set_parent(&mut self, node: u32, parent: u32) {
        self.parents[node as usize] = parent;
    }

    /// The nodes from the root to a node.
    pub fn way(&self, node: u32) -> Vec<u32> {
        let mut way = vec![node];
        let mut at = node;
        while self.parent(at) != at {
            at = self.parent(at);
            way.push(at);
        }
        way.reverse();
        way
    }

    /// The configurations from the root to a node.
    pub fn path(&self, node: u32) -> Vec<Vec<f64>> {
        self.way(node).into_iter().map(|node| self.config(node).to_vec()).collect()
    }

    /// Cuts off a node whose parent was never changed, with all nodes below it: they are near nothing any more.
    pub fn cut(&mut self, node: u32) {
        self.configs.hide(node);
        for later in node + 1..self.count() as u32 {
            if self.configs.is_hidden(self.parent(later)) {
                self.configs.hide(later);
            }
        }
    }

    /// Hides a node: it is near nothing any more.
    pub fn hide(&mut self, node: u32) {
        self.configs.hide(node);
    }

    /// The node nearest to a configuration, and how far it is; the older of two that are equally far.
    pub fn nearest(&self, config: &[f64]) -> (u32, f64) {
        self.configs.nearest(config)
    }

    /// The `count` nodes nearest to a configuration, nearest first, each with how far it is.
    pub fn nearest_of(&self, config: &[f64], count: usize) -> Vec<(u32, f64)> {
        self.configs.nearest_of(config, count)
    }
}
