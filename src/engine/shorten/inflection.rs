//! Inflection-point deletion.

use super::measure::leg;

/// The points at which the path bends, as indices into `points`, with both ends; straight joints are left out.
///
/// Directions are compared exactly, as fits coordinates that are whole numbers of half cells.
pub fn bends<P: AsRef<[f64]>>(points: &[P]) -> Vec<usize> {
    let last = points.len().saturating_sub(1);
    let is_bend = |i: usize| {
        let [before, at, after] = [i - 1, i, i + 1].map(|i| points[i].as_ref());
        let (u, v) = ([before, at], [at, after]);
        let dot = |a: [&[f64]; 2], b: [&[f64]; 2]| leg(a).zip(leg(b)).map(|(a, b)| a * b).sum::<f64>();
        let along = dot(u, v);
        along <= 0.0 || along * along != dot(u, u) * dot(v, v)
    };
    (0..points.len()).filter(|&i| i == 0 || i == last || is_bend(i)).collect()
}

/// The nodes of a path of `count` inflection points that are kept, as indices in path order.
///
/// It works from the goal backwards. A node that `can_join` its grandfather loses its father and tries the next
/// grandfather. At the first one that it cannot join, its father is the next node to try from. `can_join(i, j)` is
/// called with `i > j`.
///
/// # Source
/// Zhang & Zhang, *Path Planning for Mobile Robots Based on Improved A-star Algorithm*, section 2.4.
pub fn inflection_deletion(count: usize, mut can_join: impl FnMut(usize, usize) -> bool) -> Vec<usize> {
    let Some(mut at) = count.checked_sub(1) else { return Vec::new() };
    let mut kept = vec![at];
    while at > 0 {
        let mut father = at - 1;
        while father > 0 && can_join(at, father - 1) {
            father -= 1;
        }
        kept.push(father);
        at = father;
    }
    kept.reverse();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_ends_and_changes_of_direction_are_bends() {
        let path = [[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [4.0, 3.0], [5.0, 3.0], [4.0, 3.0], [4.0, 5.0]];
        assert_eq!(bends(&path), [0, 2, 4, 5, 6]);
        assert_eq!(bends(&[[1.0, 2.0]]), [0]);
        assert_eq!(bends::<[f64; 2]>(&[]), Vec::<usize>::new());
    }

    #[test]
    fn a_node_jumps_back_until_the_first_grandfather_it_cannot_join() {
        assert_eq!(inflection_deletion(6, |_, _| true), [0, 5]);
        assert_eq!(inflection_deletion(6, |_, _| false), [0, 1, 2, 3, 4, 5]);
        // 5 joins 3 but not 2: from 3 on, although 5 could join 1 and 0. 3 then joins 1 and 0.
        assert_eq!(inflection_deletion(6, |i, j| (i, j) != (5, 2)), [0, 3, 5]);
        assert_eq!(inflection_deletion(6, |i, j| (i, j) != (3, 0) && (i, j) != (5, 2)), [0, 1, 3, 5]);
        assert_eq!(inflection_deletion(1, |_, _| panic!("nothing to join")), [0]);
        assert!(inflection_deletion(0, |_, _| panic!("nothing to join")).is_empty());
    }

    #[test]
    fn every_leg_kept_is_an_old_one_or_was_allowed() {
        for pattern in 0..2_u32.pow(10) {
            let mut allowed = Vec::new();
            // Pairs (i, j) with i - j > 1 of five nodes, in bits.
            let kept = inflection_deletion(5, |i, j| {
                let joins = pattern >> ((i * 5 + j) % 10) & 1 == 1;
                allowed.extend(joins.then_some((i, j)));
                joins
            });
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, 4));
            for leg in kept.windows(2) {
                assert!(
                    leg[1] - leg[0] == 1 || allowed.contains(&(leg[1], leg[0])),
                    "pattern {pattern}: {kept:?}"
                );
            }
        }
    }
}
