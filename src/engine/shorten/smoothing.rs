//! Post-smoothing of grid paths.

/// The nodes of a path of `count` nodes that are kept, as indices in path order.
///
/// A node is dropped if the one after it is seen from the last node kept, else it is kept. `is_seen(i, j)` is called once for every
/// j from 2 on, with i < j.
///
/// # Source
/// Daniel, Nash, Koenig & Felner, *Theta\*: Any-Angle Path Planning on Grids*, JAIR 39 (2010), Algorithm 2.
pub fn smoothing(count: usize, mut is_seen: impl FnMut(usize, usize) -> bool) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..count.min(1)).collect();
    let mut last = 0;
    for node in 1..count.saturating_sub(1) {
        if !is_seen(last, node + 1) {
            last = node;
            kept.push(node);
        }
    }
    kept.extend((count > 1).then(|| count - 1));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_is_kept_where_the_next_is_out_of_sight() {
        assert_eq!(smoothing(6, |_, _| true), [0, 5]);
        assert_eq!(smoothing(5, |_, _| false), [0, 1, 2, 3, 4]);
        assert_eq!(smoothing(2, |_, _| false), [0, 1]);
        assert_eq!((smoothing(1, |_, _| true), smoothing(0, |_, _| true)), (vec![0], vec![]));
        // 0 sees 1 to 3, and 5; 3 sees all.
        let mut pairs = Vec::new();
        let kept = smoothing(7, |i, j| {
            pairs.push((i, j));
            i == 3 || j < 4 || j == 5
        });
        assert_eq!(kept, [0, 3, 6], "5 is seen from 0, which was given up before");
        assert_eq!(pairs, [(0, 2), (0, 3), (0, 4), (3, 5), (3, 6)]);
    }
}
