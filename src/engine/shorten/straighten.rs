//! Greedy straightening from the start.

use schemars::JsonSchema;
use serde::Deserialize;

/// Which nodes may be joined to an earlier one directly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LastNode {
    /// As the steps are printed: with nodes 1..=n, `i + 1 < j < n - 1`, and the procedure ends at node n − 1, so
    /// neither the goal nor the node before it is ever joined to an earlier one.
    AsPrinted,
    /// Every later node, the goal included.
    Goal,
}

/// The nodes of a path of `count` nodes that are kept, as indices in path order.
///
/// From the start on, the furthest node that `can_join` the current one becomes the current one. If none can, the next
/// node does. `can_join(i, j)` is called with `i < j`, for falling j, and never for neighbours on the path.
///
/// # Source
/// Fu et al., *An improved A\* algorithm for the industrial robot path planning with high success rate and short
/// length*, Robotics and Autonomous Systems 106 (2018), section 3.3, steps 1–7.
pub fn straightening(
    count: usize,
    last: LastNode,
    mut can_join: impl FnMut(usize, usize) -> bool,
) -> Vec<usize> {
    let end = match last {
        LastNode::AsPrinted => count.saturating_sub(2),
        LastNode::Goal => count,
    };
    let mut kept: Vec<usize> = (0..count.min(1)).collect();
    let mut at = 0;
    while at + 1 < count {
        at = (at + 2..end).rev().find(|&j| can_join(at, j)).unwrap_or(at + 1);
        kept.push(at);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_indices_never_reach_the_last_two_nodes() {
        assert_eq!(straightening(7, LastNode::Goal, |_, _| true), [0, 6]);
        assert_eq!(straightening(7, LastNode::AsPrinted, |_, _| true), [0, 4, 5, 6]);
        for last in [LastNode::Goal, LastNode::AsPrinted] {
            assert_eq!(straightening(5, last, |_, _| false), [0, 1, 2, 3, 4]);
            assert_eq!(straightening(1, last, |_, _| true), [0]);
            assert!(straightening(0, last, |_, _| true).is_empty());
        }
        assert_eq!(straightening(3, LastNode::AsPrinted, |_, _| true), [0, 1, 2]);
        assert_eq!(straightening(3, LastNode::Goal, |_, _| true), [0, 2]);
    }

    #[test]
    fn the_furthest_node_that_can_be_joined_is_taken_even_past_one_that_cannot() {
        let joins = [(0, 2), (0, 4), (4, 6)];
        assert_eq!(straightening(8, LastNode::Goal, |i, j| joins.contains(&(i, j))), [0, 4, 6, 7]);
    }
}
