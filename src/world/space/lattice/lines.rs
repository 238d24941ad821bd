//! Rows and columns of a lattice as bits, so that a straight run is followed 64 cells at a time.

use super::{Jumps, LatticeWorld, Pruning};
use base::grid::{DIRECTIONS, Moves};
use std::sync::Arc;

/// Where straight runs end: for each of the four straight directions a bit for every wall and every jump point.
///
/// Jump points are those of the map: goals are no part of it. Building takes one pass over the cells and knows nothing
/// of distances; a search over it is an online one, and scans blocks of bits (Harabor & Grastien 2014, section 4).
#[derive(Debug)]
pub struct JumpLines {
    moves: Arc<Moves>,
    pruning: &'static Pruning,
    /// By direction; those of diagonal directions are empty.
    lines: [Lines; 8],
}

/// Lines of cells, each in words of 64 bits: jump points, walls. Cell `i` of a line is its bit `i + 1`; what lies before
/// and behind a line is wall.
#[derive(Debug, Default)]
struct Lines {
    words: Vec<[u64; 2]>,
    words_per_line: usize,
}

impl JumpLines {
    /// The lines of `world`.
    pub fn new(world: &LatticeWorld) -> Self {
        let moves = Arc::clone(world.moves());
        let pruning = Pruning::under(world.corner_rule());
        let (width, height) = (moves.width(), moves.cell_count() / moves.width());
        let mut lines = DIRECTIONS.map(|direction| match direction {
            [_, 0] => Lines::walls(width, height),
            [0, _] => Lines::walls(height, width),
            _ => Lines::default(),
        });
        for [y, x] in (0..height).flat_map(|y| (0..width).map(move |x| [y, x])) {
            let mask = moves.mask(y * width + x);
            // A free cell without moves is no part of any run.
            if mask != 0 {
                let turns = pruning.turns(mask);
                for (direction, line, at) in [(1, y, x), (6, y, x), (3, x, y), (4, x, y)] {
                    lines[direction].free(line, at, turns >> direction & 1 == 1);
                }
            }
        }
        Self { moves, pruning, lines }
    }

    /// The memory it takes besides the legal moves.
    pub fn bytes(&self) -> usize {
        self.lines.iter().map(|lines| size_of_val(lines.words.as_slice())).sum()
    }
}

impl Lines {
    /// `count` lines of `length` cells that are all wall.
    fn walls(length: u32, count: u32) -> Self {
        let words_per_line = (length as usize + 2).div_ceil(64);
        Self { words: vec![[0, u64::MAX]; words_per_line * count as usize], words_per_line }
    }

    /// Frees cell `at` of a line.
    #[inline]
    fn free(&mut self, line: u32, at: u32, is_jump: bool) {
        let word = (at + 1) as usize / 64;
        let bit = (at + 1) % 64;
        let [jumps, walls] = &mut self.words[line as usize * self.words_per_line + word];
        *walls &= !(1 << bit);
        *jumps |= u64::from(is_jump) << bit;
    }

    /// How many cells are free above cell `at` of a line, and whether the last of them is a jump point: the first.
    #[inline]
    fn above(&self, line: u32, at: u32) -> (u32, bool) {
        let words = &self.words[line as usize * self.words_per_line..];
        let bit = at + 1;
        let mut word = bit as usize / 64;
        let mut kept = (u64::MAX << (bit % 64)) << 1;
        loop {
            let [jumps, walls] = words[word];
            let stops = (jumps | walls) & kept;
            if stops != 0 {
                let stop = stops.trailing_zeros();
                let is_jump = jumps >> stop & 1 == 1;
                return (word as u32 * 64 + stop - bit - u32::from(!is_jump), is_jump);
            }
            (word, kept) = (word + 1, u64::MAX);
        }
    }

    /// The same below cell `at`.
    #[inline]
    fn below(&self, line: u32, at: u32) -> (u32, bool) {
        let words = &self.words[line as usize * self.words_per_line..];
        let bit = at + 1;
        let mut word = bit as usize / 64;
        let mut kept = !(u64::MAX << (bit % 64));
        loop {
            let [jumps, walls] = words[word];
            let stops = (jumps | walls) & kept;
            if stops != 0 {
                let stop = stops.ilog2();
                let is_jump = jumps >> stop & 1 == 1;
                return (bit - word as u32 * 64 - stop - u32::from(!is_jump), is_jump);
            }
            (word, kept) = (word - 1, u64::MAX);
        }
    }
}

impl Jumps for JumpLines {
    fn moves(&self) -> &Moves {
        &self.moves
    }

    fn pruning(&self) -> &Pruning {
        self.pruning
    }

    #[inline]
    fn ahead<const DIRECTION: usize>(&self, [x, y]: [u32; 2]) -> (u32, bool) {
        let lines = &self.lines[DIRECTION];
        match DIRECTIONS[DIRECTION] {
            [1, _] => lines.above(y, x),
            [-1, _] => lines.below(y, x),
            [_, 1] => lines.above(x, y),
            _ => lines.below(x, y),
        }
    }

    #[inline]
    fn hop<const DIRECTION: usize>(&self, cell: u32, _wanted: u32) -> u32 {
        u32::from(self.moves.mask(cell) >> DIRECTION & 1)
    }
}
