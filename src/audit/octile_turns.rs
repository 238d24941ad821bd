//! The turn sums that 8-connected walks of a given length can have.
//!
//! Such a walk bends by multiples of 45°. Obstacles are left out: a sum not listed occurs on no map, one that
//! is listed occurs on an empty grid for some walk with these moves, which need not be what a planner returns.

use super::Cell;
use super::lattice::{Octile, joins};
use std::collections::BTreeMap;
use turns::Convention;

/// The eight moves in order of angle, so that a bend is a difference of indices; even ones are straight.
const MOVES: [Cell; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

/// Every turn sum, in multiples of 45° and rising, of walks with exactly these moves over `displacement`.
///
/// # Panics
/// With more than 31 moves: a set of sums is held in 128 bits, and a bend takes up to four.
pub fn octile_turn_sums(moves: Octile, displacement: Cell, convention: Convention) -> Vec<u32> {
    let count = moves.straight + moves.diagonal;
    assert!(count <= 31, "{count} moves; at most 31 are supported");
    // Where walks stand: diagonal moves made and cell; and by their last move the set of their turn sums as bits.
    let mut walks: BTreeMap<(u32, Cell), [u128; MOVES.len()]> = BTreeMap::from([((0, [0, 0]), [1; 8])]);
    for made in 0..count {
        let mut longer = BTreeMap::new();
        for (&(diagonal, at), sums) in &walks {
            for (turn, vector) in MOVES.iter().enumerate() {
                let diagonal = diagonal + turn as u32 % 2;
                let Some(left) = remaining(moves, made + 1, diagonal) else { continue };
                let to = [at[0] + vector[0], at[1] + vector[1]];
                if joins(left, [displacement[0] - to[0], displacement[1] - to[1]]) {
                    let bent = |last| if made == 0 { 0 } else { bend(last, turn, convention) };
                    let sums = (0..MOVES.len()).fold(0, |all, last| all | sums[last] << bent(last));
                    longer.entry((diagonal, to)).or_insert([0; 8])[turn] |= sums;
                }
            }
        }
        walks = longer;
    }
    let sums = walks.values().flatten().fold(0, |all, sums| all | sums);
    let arrived = if joins(moves, displacement) { sums } else { 0 };
    (0..128).filter(|bit| arrived >> bit & 1 == 1).collect()
}

/// The moves left after `made` of which `diagonal` were diagonal; none if that is more than there are.
fn remaining(moves: Octile, made: u32, diagonal: u32) -> Option<Octile> {
    Some(Octile {
        straight: moves.straight.checked_sub(made - diagonal)?,
        diagonal: moves.diagonal.checked_sub(diagonal)?,
    })
}

/// What the bend between two moves adds, in multiples of 45°; no bend adds nothing in either convention.
fn bend(last: usize, next: usize, convention: Convention) -> u32 {
    let apart = last.abs_diff(next);
    let change = apart.min(8 - apart) as u32;
    match convention {
        Convention::Exterior => change,
        Convention::Interior if change == 0 => 0,
        Convention::Interior => 4 - change,
    }
}

#[cfg(test)]
mod tests {
    use super::super::lattice::octile_distance;
    use super::*;
    use std::collections::BTreeSet;
    use turns::turn_sum_deg;

    /// Turn sums of all walks with exactly `left` over what remains, by walking them.
    fn walk(left: Octile, to: Cell, path: &mut Vec<Cell>, convention: Convention, sums: &mut BTreeSet<u32>) {
        if left.straight + left.diagonal == 0 && to == path[path.len() - 1] {
            sums.insert((turn_sum_deg(path, convention) / 45.0).round() as u32);
        }
        let at = path[path.len() - 1];
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let diagonal = u32::from(dx * dy != 0);
            let straight = u32::from(dx != 0 || dy != 0) - diagonal;
            let (Some(s), Some(d)) =
                (left.straight.checked_sub(straight), left.diagonal.checked_sub(diagonal))
            else {
                continue;
            };
            if straight + diagonal > 0 {
                path.push([at[0] + dx, at[1] + dy]);
                walk(Octile { straight: s, diagonal: d }, to, path, convention, sums);
                path.pop();
            }
        }
    }

    #[test]
    fn octile_turn_sums_are_those_of_the_walks() {
        let mut listed = 0;
        for convention in [Convention::Exterior, Convention::Interior] {
            for (straight, diagonal, to) in
                [(2, 1, [3, 1]), (3, 2, [3, 2]), (1, 3, [2, 1]), (4, 1, [1, 0]), (2, 2, [2, 2])]
            {
                let moves = Octile { straight, diagonal };
                let mut sums = BTreeSet::new();
                walk(moves, to, &mut vec![[0, 0]], convention, &mut sums);
                listed += sums.len();
                assert_eq!(
                    octile_turn_sums(moves, to, convention),
                    sums.into_iter().collect::<Vec<_>>(),
                    "{moves:?}"
                );
            }
        }
        assert!(listed > 40, "only {listed} sums");
        assert_eq!(
            octile_turn_sums(Octile { straight: 1, diagonal: 0 }, [5, 5], Convention::Exterior),
            [0_u32; 0]
        );
    }

    #[test]
    fn the_grid_papers_astar_rows_are_attainable_pairs() {
        let simple = octile_turn_sums(Octile { straight: 9, diagonal: 4 }, [4, 13], Convention::Exterior);
        assert!(simple.contains(&(270 / 45)), "{simple:?}");
        let complex = octile_turn_sums(Octile { straight: 12, diagonal: 4 }, [-15, -3], Convention::Exterior);
        assert!(complex.contains(&(315 / 45)), "{complex:?}");
        // 17.6569 is longer than the octile distance 12 + 3√2 by one diagonal for a straight move.
        assert_eq!(octile_distance([-15, -3]), Octile { straight: 12, diagonal: 3 });
    }
}
