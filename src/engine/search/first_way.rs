//! The lengths that A* returns on 8-connected grids if it never lowers the g of an open node, specialised for speed.
//!
//! It is [`Search`](super::Search) over [`GridGraph`](super::GridGraph) with [`euclidean_to`](super::euclidean_to),
//! [`sum`](super::sum) and [`Heap`](super::Heap), where [`Update`](super::Update) lowers and reopens nothing, and
//! returns the same lengths up to a bound; a test holds the two equal. What makes it fast:
//!
//! - The first way to a node is final. The length is known when the goal is opened, and an opened cell is never looked at again.
//! - Unopened cells are bits; the neighbours of a cell are nine of them.
//! - A node whose f exceeds the bound is marked as opened and never enters OPEN.
//! - Open nodes lie in buckets of f, and only the current bucket is sorted.

use super::buckets::Buckets;
use super::cost::{Cost as _, Octile, quantised};
use super::estimate::ScaledOctile;
use super::frontier::Ties;
use base::grid::{DIRECTIONS, Moves};
use std::cmp::Reverse;
use std::f64::consts::SQRT_2;

/// A bucket spans 2^20 keys, 0.001 cells: few hold two nodes. A move raises f by at most 2√2, 2698 buckets, which keeps
/// the promise that [`Buckets`] asks for.
const BUCKET_BITS: u32 = 20;

/// Which of the [`DIRECTIONS`] lead to cells whose bits are set, three each of the row below, a cell's own and the one
/// above, every row from left to right.
const TOWARDS: [u8; 512] = {
    let mut table = [0; 512];
    let mut around = 0;
    while around < table.len() {
        let mut bit = 0;
        while bit < 8 {
            let [dx, dy] = DIRECTIONS[bit];
            table[around] |= ((around >> (3 * (dy + 1) + dx + 1) & 1) << bit) as u8;
            bit += 1;
        }
        around += 1;
    }
    table
};

/// Bit `i` is set if `DIRECTIONS[i]` is diagonal.
const DIAGONAL: usize = {
    let mut bits = 0;
    let mut bit = 0;
    while bit < 8 {
        bits |= ((DIRECTIONS[bit][0] * DIRECTIONS[bit][1] != 0) as usize) << bit;
        bit += 1;
    }
    bits
};

/// The specialised search, built for one grid and used for many queries.
#[derive(Clone, Debug)]
pub struct FirstWayAstar {
    width: u32,
    /// The legal moves of each cell, between an empty row and a cell on either side; so are all cells numbered here.
    masks: Vec<u8>,
    steps: [i32; 8],
    goal: u32,
    /// The distance of each cell to the goal.
    h: Vec<f64>,
    /// A bit a cell: whether it was not opened yet.
    unopened: Vec<u8>,
    open: Queue,
}

#[derive(Clone, Copy, Debug)]
struct Open {
    f: u64,
    /// How many nodes were opened before.
    rank: u32,
    node: u32,
    g: Octile,
}

impl FirstWayAstar {
    /// The search over the legal `moves` of a grid, with the order of `ties` among equal f, towards cell 0.
    pub fn new(moves: &Moves, ties: Ties) -> Self {
        let width = moves.width();
        let beside = moves.width() as usize + 1;
        let mut masks = vec![0; moves.cell_count() as usize + 2 * beside];
        for cell in 0..moves.cell_count() {
            masks[cell as usize + beside] = moves.mask(cell);
        }
        let mut search = Self {
            width,
            steps: DIRECTIONS.map(|[dx, dy]| dy * width as i32 + dx),
            goal: 0,
            h: vec![0.0; masks.len()],
            unopened: vec![0; masks.len() / 8 + 2],
            masks,
            open: Queue { ties, buckets: Buckets::default(), bucket: 0, now: Vec::new() },
        };
        search.aim(0);
        search
    }

    /// Makes `goal` the goal of the queries that follow.
    pub fn aim(&mut self, goal: u32) {
        let width = self.width;
        let beside = self.width + 1;
        let cells = &mut self.h[beside as usize..];
        for (row, cells) in (0..).zip(cells.chunks_mut(width as usize)) {
            let dy = f64::from((goal / width).abs_diff(row));
            for (column, h) in (0..).zip(cells) {
                let dx = f64::from((goal % width).abs_diff(column));
                *h = (dx * dx + dy * dy).sqrt();
            }
        }
        self.goal = goal + beside;
    }

    /// The length of the path that this A* returns from `start`, if there is one of at most `most`, in the units of
    /// [`ScaledOctile`].
    ///
    /// # Panics
    /// If `start` is outside the grid.
    pub fn length(&mut self, start: u32, most: u32) -> Option<Octile> {
        let start = start + self.width + 1;
        if start == self.goal {
            return Some(Octile::ZERO);
        }
        // 1393 / 985 is below √2, so that no such length is longer; f falls on no path to the goal but by its rounding.
        let bound = quantised(f64::from(most) * (SQRT_2 / f64::from(ScaledOctile::DIAGONAL))) + 1;
        let masks = &self.masks[..];
        let h = &self.h[..];
        let unopened = &mut self.unopened[..];
        unopened.fill(u8::MAX);
        unopened[start as usize / 8] &= !(1 << (start % 8));
        let first = Open { f: quantised(h[start as usize]), rank: 0, node: start, g: Octile::ZERO };
        let mut at = self.open.begin(first);
        let mut opened = 1;
        loop {
            let mut left = masks[at.node as usize] & TOWARDS[around(unopened, at.node, self.width)];
            let reached = [Octile::STRAIGHT, Octile::DIAGONAL].map(|cost| at.g.plus(cost));
            let lengths = reached.map(Octile::value);
            while left != 0 {
                let bit = left.trailing_zeros() as usize % 8;
                left &= left - 1;
                let node = at.node.wrapping_add_signed(self.steps[bit]);
                let kind = DIAGONAL >> bit & 1;
                let g = reached[kind];
                if node == self.goal {
                    return (ScaledOctile::scaled(g) <= most).then_some(g);
                }
                unopened[node as usize / 8] &= !(1 << (node % 8));
                let f = quantised(lengths[kind] + h[node as usize]);
                let rank = opened;
                opened += 1;
                if f <= bound {
                    self.open.offer(Open { f, rank, node, g });
                }
            }
            at = self.open.take()?;
        }
    }
}

/// The bits of a cell and of those around it: three of the row below, three of its own, three of the one above.
#[inline]
fn around(bits: &[u8], cell: u32, width: u32) -> usize {
    let row = |middle: u32| {
        let byte = (middle - 1) as usize / 8;
        let bit = (middle - 1) % 8;
        usize::from(u16::from_le_bytes([bits[byte], bits[byte + 1]]) >> bit & 7)
    };
    row(cell - width) | row(cell) << 3 | row(cell + width) << 6
}

/// Open nodes by f, then by the order among equals.
#[derive(Clone, Debug)]
struct Queue {
    ties: Ties,
    buckets: Buckets<Open>,
    /// The bucket in hand.
    bucket: u64,
    /// What is open in it or below, the first of them last.
    now: Vec<Open>,
}

impl Queue {
    /// Forgets everything; `first` is in hand.
    fn begin(&mut self, first: Open) -> Open {
        self.buckets.clear();
        self.now.clear();
        self.bucket = first.f >> BUCKET_BITS;
        // The buckets count from the first key.
        self.buckets.push(self.bucket, first);
        self.buckets.pop().map_or(first, |(_, first)| first)
    }

    #[inline]
    fn offer(&mut self, open: Open) {
        let bucket = open.f >> BUCKET_BITS;
        if bucket <= self.bucket { self.insert(open) } else { self.buckets.push(bucket, open) }
    }

    #[inline]
    fn take(&mut self) -> Option<Open> {
        if self.now.is_empty() {
            let (bucket, first) = self.buckets.pop()?;
            self.bucket = bucket;
            self.now.push(first);
            while let Some(other) = self.buckets.pop_equal() {
                self.insert(other);
            }
        }
        self.now.pop()
    }

    /// Puts `offer` at its place among what is in hand.
    #[inline]
    fn insert(&mut self, offer: Open) {
        let mut place = self.now.len();
        self.now.push(offer);
        while place > 0 && comes_after(&offer, &self.now[place - 1], self.ties) {
            self.now[place] = self.now[place - 1];
            place -= 1;
        }
        self.now[place] = offer;
    }
}

fn comes_after(one: &Open, other: &Open, ties: Ties) -> bool {
    if one.f != other.f {
        return one.f > other.f;
    }
    match ties {
        // Costs of lattice moves have nothing more to tell equals apart by.
        Ties::Fifo | Ties::Smaller => one.rank > other.rank,
        Ties::Lifo => one.rank < other.rank,
        Ties::SmallerG => {
            let key = |open: &Open| (quantised(open.g.value()), open.rank);
            key(one) > key(other)
        }
        Ties::LargerG => {
            let key = |open: &Open| (Reverse(quantised(open.g.value())), open.rank);
            key(one) > key(other)
        }
    }
}
