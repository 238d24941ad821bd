//! The specialised search without a goal: exact costs from one cell to all others.

use super::OctileAstar;
use crate::search::cost::Octile;
use crate::search::estimate::ScaledOctile;

impl ScaledOctile {
    /// `cost` in units of 985 and 1393.
    pub fn scaled(cost: Octile) -> u32 {
        Self::STRAIGHT * cost.straight + Self::DIAGONAL * cost.diagonal
    }
}

impl OctileAstar {
    /// Tells `visit` every cell that `start` reaches at a cost up to `most`, once, with its least cost; costs rise
    /// from visit to visit and are in the units of [`ScaledOctile`].
    ///
    /// # Panics
    /// If `start` is outside the grid.
    pub fn flood(&mut self, start: u32, most: u32, mut visit: impl FnMut(u32, u32)) {
        self.begin();
        let width = self.width;
        let shift = self.shift;
        let base = self.base;
        let root = self.padded(start);
        let values = &mut self.values[..];
        let masks = &self.masks[..];
        let open = &mut self.open;
        values[root as usize] = base;
        open.push(0, (root, base));
        while let Some((cost, (node, value))) = open.pop() {
            if cost > u64::from(most) {
                break;
            }
            if values[node as usize] != value {
                continue;
            }
            visit(((node >> shift) - super::BELOW) * width + (node & ((1 << shift) - 1)), value - base);
            let mask = masks[node as usize];
            for (bit, (step, length)) in self.steps.into_iter().zip(super::COSTS).enumerate() {
                let to = node.wrapping_add_signed(step);
                let reached = value + length;
                if reached < super::bound(mask, bit, values[to as usize]) {
                    values[to as usize] = reached;
                    open.push(u64::from(reached - base), (to, reached));
                }
            }
        }
    }
}
