//! The turn sums that 8-connected walks of a given length can have.
//!
//! Such a walk bends by multiples of 45°. Obstacles are left out: a sum not listed occurs on no map, one that
//! is listed occurs on an empty grid for some walk with these moves, which need not be what a planner returns.

use proofs::lattice::{Octile, joins};
use proofs::turns::{Cell, Convention};
use std::collections::BTreeMap;

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

/// The moves left after `made`, `diagonal` of these diagonal; `None` if that is more than there are.
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
