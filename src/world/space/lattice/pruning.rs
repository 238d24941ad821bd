//! Which directions a search by jump points goes on in, from how it came: the pruning rules, tabulated.
//!
//! Say x was entered from p. A neighbour n of x is pruned if some way from p to n costs no more than the way through x.
//! That way must stay within the block of 3 × 3 cells round x and avoid x. If x was entered diagonally, it must cost
//! less. Diagonal moves therefore come before straight ones in the ways that are left. The definition holds under every
//! corner rule, so that the tables are computed from it and no rule needs a list of its own.
//!
//! # Source
//! Harabor & Grastien, *Online graph pruning for pathfinding on grid maps*, AAAI 2011, section 3 (corners may be cut);
//! *Improving jump point search*, ICAPS 2014 (no corner is cut).

use base::grid::{CornerRule, DIRECTIONS};
use std::sync::LazyLock;

/// Costs whose order is that of a + b√2 for ways of a few moves.
const STRAIGHT: u32 = 985;
const DIAGONAL: u32 = 1393;

/// The pruning rules under one corner rule. Sets of directions are masks over [`DIRECTIONS`].
#[derive(Debug)]
pub struct Pruning {
    /// By direction of entering and legal moves.
    onward: [[u8; 256]; 8],
    /// By legal moves, the directions of entering that make the cell a jump point.
    turns: [u8; 256],
}

static ALLOW: LazyLock<Pruning> = LazyLock::new(|| Pruning::new(CornerRule::Allow));
static FORBID_BOTH: LazyLock<Pruning> = LazyLock::new(|| Pruning::new(CornerRule::ForbidBoth));
static FORBID_ANY: LazyLock<Pruning> = LazyLock::new(|| Pruning::new(CornerRule::ForbidAny));

impl Pruning {
    /// The pruning rules under `corners`.
    pub fn under(corners: CornerRule) -> &'static Self {
        match corners {
            CornerRule::Allow => &ALLOW,
            CornerRule::ForbidBoth => &FORBID_BOTH,
            CornerRule::ForbidAny => &FORBID_ANY,
        }
    }

    fn new(corners: CornerRule) -> Self {
        let onward: [[u8; 256]; 8] = std::array::from_fn(|came| {
            std::array::from_fn(|moves| Block { corners, moves: moves as u8 }.onward(came))
        });
        let turns = std::array::from_fn(|moves| {
            (0..8).filter(|came| onward[*came][moves] & !NATURAL[*came] != 0).map(|came| 1 << came).sum()
        });
        Self { onward, turns }
    }

    /// The directions to go on in from a cell with the legal `moves`, entered in direction `came`.
    #[inline]
    pub fn onward(&self, came: usize, moves: u8) -> u8 {
        self.onward[came][moves as usize]
    }

    /// The directions in which a cell with the legal `moves` is a jump point when it is entered. Some way goes on from
    /// it in a direction that a straight run does not take anyway.
    ///
    /// Where no corner is cut, these are straight directions only.
    #[inline]
    pub fn turns(&self, moves: u8) -> u8 {
        self.turns[moves as usize]
    }
}

/// By direction, the directions that a run in it takes: itself and, of a diagonal one, its two parts.
const NATURAL: [u8; 8] = {
    let mut natural = [0; 8];
    let mut came = 0;
    while came < 8 {
        let [dx, dy] = DIRECTIONS[came];
        let mut to = 0;
        while to < 8 {
            let [tx, ty] = DIRECTIONS[to];
            let is_part = dx != 0 && dy != 0 && (tx == dx && ty == 0 || tx == 0 && ty == dy);
            natural[came] |= ((to == came || is_part) as u8) << to;
            to += 1;
        }
        came += 1;
    }
    natural
};

fn is_diagonal(direction: usize) -> bool {
    DIRECTIONS[direction][0] != 0 && DIRECTIONS[direction][1] != 0
}

/// A free cell and the eight around it.
///
/// Neighbours that no legal move leads to count as blocked. A diagonal one may be free and yet be shut off by its flanks;
/// it then matters to no way that the rules compare, because they lead through those flanks.
#[derive(Clone, Copy)]
struct Block {
    corners: CornerRule,
    moves: u8,
}

impl Block {
    fn is_free(self, [x, y]: [i32; 2]) -> bool {
        match DIRECTIONS.iter().position(|step| *step == [x, y]) {
            Some(direction) => self.moves >> direction & 1 == 1,
            None => [x, y] == [0, 0],
        }
    }

    fn is_move(self, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> bool {
        let flanks_free = [self.is_free([x + dx, y]), self.is_free([x, y + dy])];
        self.is_free([x + dx, y + dy]) && (dx == 0 || dy == 0 || self.corners.permits(flanks_free))
    }

    /// The directions that are not pruned; none if the moves are not those of a cell that was entered so.
    fn onward(self, came: usize) -> u8 {
        let [dx, dy] = DIRECTIONS[came];
        let mut moves = DIRECTIONS.into_iter().filter(|step| self.is_free(*step));
        // Moves are symmetric.
        if !self.is_move([0, 0], [-dx, -dy]) || !moves.all(|step| self.is_move([0, 0], step)) {
            return 0;
        }
        let around = self.costs_around([-dx, -dy]);
        let is_pruned = |to: usize| {
            let through = cost(came) + cost(to);
            let around = around[to];
            if is_diagonal(came) { around < through } else { around <= through }
        };
        (0..8).filter(|to| self.is_move([0, 0], DIRECTIONS[*to]) && !is_pruned(*to)).map(|to| 1 << to).sum()
    }

    /// The least cost from the neighbour at `from` to each neighbour, by moves within the block and not through the
    /// centre.
    fn costs_around(self, from: [i32; 2]) -> [u32; 8] {
        let mut costs = DIRECTIONS.map(|at| if at == from { 0 } else { u32::MAX });
        // No shortest way round the centre has more than seven moves.
        for _ in 0..7 {
            for (i, at) in DIRECTIONS.into_iter().enumerate().filter(|(_, at)| self.is_free(*at)) {
                for (direction, step) in DIRECTIONS.into_iter().enumerate() {
                    let to = DIRECTIONS.iter().position(|to| *to == [at[0] + step[0], at[1] + step[1]]);
                    if let Some(to) = to
                        && costs[i] < u32::MAX
                        && self.is_move(at, step)
                    {
                        costs[to] = costs[to].min(costs[i] + cost(direction));
                    }
                }
            }
        }
        costs
    }
}

fn cost(direction: usize) -> u32 {
    if is_diagonal(direction) { DIAGONAL } else { STRAIGHT }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every block of 3 × 3 cells with a free centre, as masks of free neighbours and of legal moves.
    fn blocks(corners: CornerRule) -> impl Iterator<Item = (u8, u8)> {
        (0..=u8::MAX).map(move |free| {
            let block = Block { corners, moves: free };
            let legal = (0..8).filter(|to| block.is_move([0, 0], DIRECTIONS[*to])).map(|to| 1 << to).sum();
            (free, legal)
        })
    }

    fn bit(step: [i32; 2]) -> u8 {
        1 << DIRECTIONS.iter().position(|known| *known == step).unwrap()
    }

    /// The forced neighbours as the papers list them, for a cell entered in the direction `[dx, dy]`.
    fn forced(corners: CornerRule, [dx, dy]: [i32; 2], free: u8) -> u8 {
        let is_free = |step: [i32; 2]| free & bit(step) != 0;
        let mut forced = 0;
        if dx != 0 && dy != 0 {
            for (behind, beside) in [([-dx, 0], [-dx, dy]), ([0, -dy], [dx, -dy])] {
                forced |= if is_free(behind) { 0 } else { bit(beside) };
            }
            return forced;
        }
        for side in [1, -1] {
            let aside = [dy * side, dx * side];
            let (ahead, behind) = ([aside[0] + dx, aside[1] + dy], [aside[0] - dx, aside[1] - dy]);
            if corners == CornerRule::ForbidAny {
                forced |= if is_free(behind) { 0 } else { bit(aside) | bit(ahead) };
            } else {
                forced |= if is_free(aside) { 0 } else { bit(ahead) };
            }
        }
        forced
    }

    #[test]
    fn natural_and_forced_neighbours_are_those_that_the_papers_list() {
        for corners in [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny] {
            let pruning = Pruning::under(corners);
            let mut seen = 0;
            let mut turned = 0;
            for (free, legal) in blocks(corners) {
                for (came, step) in DIRECTIONS.into_iter().enumerate() {
                    if legal >> (7 - came) & 1 == 0 {
                        continue;
                    }
                    let listed = (NATURAL[came] | forced(corners, step, free)) & legal;
                    let found = pruning.onward(came, legal);
                    assert_eq!(found, listed, "{corners:?}, {step:?} among {free:08b}");
                    seen += 1;
                    turned += u32::from(pruning.turns(legal) >> came & 1);
                }
            }
            assert!(turned > 100 && seen > 2 * turned, "{corners:?}: {turned} jump points of {seen}");
        }
    }

    #[test]
    fn only_where_corners_are_cut_does_a_way_turn_after_a_diagonal_move() {
        let rules = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];
        let diagonals: u8 = (0..8).filter(|came| is_diagonal(*came)).map(|came| 1 << came).sum();
        let turns = |rule| (0..=u8::MAX).any(|moves| Pruning::under(rule).turns(moves) & diagonals != 0);
        assert_eq!(rules.map(turns), [true, true, false]);
    }
}
