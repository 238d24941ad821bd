//! Neighbourhoods of any size, looked at a column at a time.

use super::graph::Graph;
use base::grid::{Columns, MAX_REACH_CELLS, Offsets};
use world::geometry::lanes::{LANES, Row};

/// Rows that the window of the widest neighbourhood fills.
pub(super) const MOST_ROWS: usize = (2 * MAX_REACH_CELLS as usize + 1).div_ceil(LANES);

/// Which of the free cells of a neighbourhood are successors.
pub trait Successors {
    /// Tells that `cell` is expanded; the columns of its neighbourhood are requested next, from the right to the left.
    fn expands(&mut self, cell: u32) {
        let _ = cell;
    }

    /// Those of the `free` cells of the column `dx` from `cell` that are its successors; bit `i` is the cell `reach - i`
    /// rows up.
    fn kept(&mut self, cell: u32, dx: i32, reach: i32, free: u64) -> u64;
}

/// Every free cell of the neighbourhood is a successor.
impl Successors for () {
    #[inline]
    fn kept(&mut self, _: u32, _: i32, _: i32, free: u64) -> u64 {
        free
    }
}

/// The neighbourhood on one kind of lattice.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    pub(super) spacing: f64,
    /// What a step to the right adds to a place and a step up to a cell.
    pub(super) strides: [i32; 2],
    /// The largest step along either axis.
    pub(super) reach: i32,
    /// How many rows of lanes a window fills.
    pub(super) rows: usize,
    /// The columns from the right to the left, as many together as have bits in a word.
    pub(super) blocks: Vec<Block>,
}

/// Columns whose windows fill one word, one behind the other.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) columns: Vec<Column>,
    /// By bit; steps that are none are as long as infinity.
    pub(super) steps: Vec<Step>,
}

/// A step from a cell to a neighbour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) length: f64,
    /// What it adds to a place.
    pub(super) place: i32,
    /// What it adds to the column and the row.
    pub(super) xy: [i32; 2],
}

/// The steps of a neighbourhood along one column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub(super) dx: i32,
    /// From a place to the first of the column's window.
    pub(super) first: i32,
    /// Which cells of the window are neighbours.
    pub(super) mask: u64,
    /// The first bit of the window in the word of the block.
    pub(super) shift: u32,
    /// The lengths of the steps, infinite where there is none.
    pub(super) lengths: [Row; MOST_ROWS],
}

impl Shape {
    pub(super) fn new(offsets: &Offsets, columns: &Columns, spacing: f64) -> Self {
        let reach = reach(offsets);
        let side = 2 * reach as usize + 1;
        let from_the_right: Vec<i32> = (-reach..=reach).rev().collect();
        let block = |dxs: &[i32]| Block::new(dxs, offsets, columns, spacing);
        let blocks = from_the_right.chunks(u64::BITS as usize / side).map(block).collect();
        Self { spacing, strides: strides(columns), reach, rows: side.div_ceil(LANES), blocks }
    }

    /// The longest step.
    pub(super) fn longest(&self) -> f64 {
        let lengths = self.blocks.iter().flat_map(|block| &block.steps).map(|step| step.length);
        lengths.filter(|length| length.is_finite()).fold(0.0, f64::max)
    }
}

impl Block {
    fn new(dxs: &[i32], offsets: &Offsets, columns: &Columns, spacing: f64) -> Self {
        let reach = reach(offsets);
        let mut block = Self { columns: Vec::new(), steps: Vec::new() };
        for &dx in dxs {
            let shift = block.steps.len() as u32;
            let first = columns.offset([dx, reach]);
            let mut column =
                Column { dx, first, mask: 0, shift, lengths: [[f64::INFINITY; LANES]; MOST_ROWS] };
            for (bit, dy) in (-reach..=reach).rev().enumerate() {
                if offsets.steps().contains(&[dx, dy]) {
                    column.mask |= 1 << bit;
                    column.lengths[bit / LANES][bit % LANES] = spacing * f64::from(dx * dx + dy * dy).sqrt();
                }
                let length = column.lengths[bit / LANES][bit % LANES];
                let xy = [dx, dy];
                block.steps.push(Step { length, place: columns.offset(xy), xy });
            }
            block.columns.push(column);
        }
        block
    }
}

impl Column {
    /// The free neighbours of the cell at `place`.
    #[inline]
    pub(super) fn free(&self, columns: &Columns, place: u32) -> u64 {
        columns.free().window(place.wrapping_add_signed(self.first)) & self.mask
    }
}

/// The largest step along either axis.
pub(super) fn reach(offsets: &Offsets) -> i32 {
    offsets.steps().iter().flatten().map(|d| d.abs()).max().unwrap_or_default()
}

/// What a step to the right adds to a place and a step up to a cell.
pub(super) fn strides(columns: &Columns) -> [i32; 2] {
    [columns.offset([1, 0]), columns.width() as i32]
}

/// The lattice of all free cells with a neighbourhood, and of its cells those that are successors.
#[derive(Debug)]
pub struct ColumnGraph<'a, S> {
    columns: &'a Columns,
    successors: &'a mut S,
    shape: Shape,
}

impl<'a, S: Successors> ColumnGraph<'a, S> {
    /// The lattice of `columns` whose cells are `spacing` apart; costs are in the unit of `spacing`.
    pub fn new(columns: &'a Columns, offsets: &Offsets, spacing: f64, successors: &'a mut S) -> Self {
        Self { columns, successors, shape: Shape::new(offsets, columns, spacing) }
    }
}

impl<S: Successors> Graph for ColumnGraph<'_, S> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.columns.cell_count() as usize
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        self.successors.expands(node);
        let place = self.columns.place(node);
        let width = self.columns.width() as i32;
        for block in &self.shape.blocks {
            for column in &block.columns {
                let free = column.free(self.columns, place);
                let mut kept = self.successors.kept(node, column.dx, self.shape.reach, free);
                while kept != 0 {
                    let step = block.steps[(column.shift + kept.trailing_zeros()) as usize];
                    kept &= kept - 1;
                    let [dx, dy] = step.xy;
                    visit(node.wrapping_add_signed(dy * width + dx), step.length);
                }
            }
        }
    }
}
