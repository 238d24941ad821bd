//! Straightening node by node, up to the first that cannot be joined.

/// Where the next stretch starts after one ended before a node that could not be joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resume {
    /// At the last node that was joined, P(m − 1): what the procedure needs to stay on the path it drew.
    LastJoined,
    /// At the node that could not be joined, P(m), as the text says; the leg to it stays as it was.
    FirstRefused,
}

/// The nodes of a path of `count` nodes that are kept, as indices in path order.
///
/// From a node on, the following ones are joined to it one after another until one cannot be. The last that could be is
/// kept, and is the next to join from. `can_join(i, j)` is called with `i < j`, for rising j, and never for neighbours
/// on the path.
///
/// # Source
/// Tang, Zhou & Xu, *Obstacle avoidance path planning of 6-DOF robotic arm based on improved A\* algorithm and
/// artificial potential field method*, Robotica (2023), section 2.3, after Fig. 3.
pub fn stepwise_straightening(
    count: usize,
    resume: Resume,
    mut can_join: impl FnMut(usize, usize) -> bool,
) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..count.min(1)).collect();
    let mut from = 0;
    while from + 1 < count {
        let mut joined = from + 1;
        while joined + 1 < count && can_join(from, joined + 1) {
            joined += 1;
        }
        kept.push(joined);
        from = joined;
        if resume == Resume::FirstRefused && from + 1 < count {
            from += 1;
            kept.push(from);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_ends_before_the_first_node_that_cannot_be_joined() {
        // From 0 nodes 2 and 3 are joined, 4 is not; 5 would be, but is never tried.
        let joins = [(0, 2), (0, 3), (0, 5), (3, 5), (3, 6), (4, 6)];
        let can = |i, j| joins.contains(&(i, j));
        assert_eq!(stepwise_straightening(7, Resume::LastJoined, can), [0, 3, 6]);
        assert_eq!(stepwise_straightening(7, Resume::FirstRefused, can), [0, 3, 4, 6]);
    }

    #[test]
    fn ends_are_kept_and_neighbours_are_never_tried() {
        for resume in [Resume::LastJoined, Resume::FirstRefused] {
            assert_eq!(stepwise_straightening(4, resume, |_, _| true), [0, 3]);
            assert_eq!(stepwise_straightening(4, resume, |i, j| j <= i + 1), [0, 1, 2, 3]);
            assert_eq!(stepwise_straightening(1, resume, |_, _| panic!("nothing to join")), [0]);
            assert!(stepwise_straightening(0, resume, |_, _| panic!("nothing to join")).is_empty());
        }
    }
}
