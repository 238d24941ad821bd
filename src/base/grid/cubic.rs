//! Cubic lattices in space: which nodes are free, and the 26 steps to neighbours in a written order.

use super::{GridError, MAX_CELLS, MAX_SIDE_NODES};

/// The 26 steps from a node to its neighbours: dz rises, for each dz dy, for each dy dx.
pub const STEPS_26: [[i32; 3]; 26] = {
    let mut steps = [[0; 3]; 26];
    let mut code = 0;
    let mut at = 0;
    while code < 27 {
        if code != 13 {
            steps[at] = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
            at += 1;
        }
        code += 1;
    }
    steps
};

/// The numbers of a lattice's nodes in space.
///
/// Nodes are numbered row by row with a blocked border around them. A step from a node inside needs no
/// check of bounds: the number of a neighbour is the number of the node plus the step's [`offset`](Self::offset).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nodes3 {
    size: [u32; 3],
}

impl Nodes3 {
    /// Those of `size` nodes along x, y and z.
    ///
    /// # Errors
    /// [`GridError::Space`] unless every side lies in 1..=[`MAX_SIDE_NODES`] and all nodes are at most [`MAX_CELLS`].
    pub fn new(size: [u32; 3]) -> Result<Self, GridError> {
        let is_side = |side: &u32| (1..=MAX_SIDE_NODES).contains(side);
        let nodes = Self { size };
        if !size.iter().all(is_side) || nodes.inside() > u64::from(MAX_CELLS) {
            return Err(GridError::Space { size });
        }
        Ok(nodes)
    }

    /// How many nodes there are along x, y and z.
    pub fn size(&self) -> [u32; 3] {
        self.size
    }

    fn inside(&self) -> u64 {
        self.size.iter().map(|side| u64::from(*side)).product()
    }

    /// A number above every node's.
    pub fn node_count(&self) -> usize {
        self.size.iter().map(|side| *side as usize + 2).product()
    }

    fn number(&self, [x, y, z]: [u32; 3]) -> u32 {
        ((z + 1) * (self.size[1] + 2) + y + 1) * (self.size[0] + 2) + x + 1
    }

    /// The node at whole coordinates, or `None` outside.
    pub fn node(&self, at: [i32; 3]) -> Option<u32> {
        let inside = at.iter().zip(self.size).all(|(c, side)| (0..side as i32).contains(c));
        inside.then(|| self.number(at.map(|c| c as u32)))
    }

    /// Whole coordinates of `node`.
    pub fn xyz(&self, node: u32) -> [i32; 3] {
        let row = self.size[0] + 2;
        let layer = self.size[1] + 2;
        [node % row, node / row % layer, node / row / layer].map(|c| c as i32 - 1)
    }

    /// What a step adds to a node's number.
    pub fn offset(&self, [dx, dy, dz]: [i32; 3]) -> i32 {
        let row = self.size[0] as i32 + 2;
        let layer = self.size[1] as i32 + 2;
        (dz * layer + dy) * row + dx
    }
}

/// A dense lattice of nodes in space, some of them blocked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grid3 {
    nodes: Nodes3,
    free: Vec<bool>,
    free_count: u64,
}

impl std::ops::Deref for Grid3 {
    type Target = Nodes3;

    fn deref(&self) -> &Nodes3 {
        &self.nodes
    }
}

impl Grid3 {
    /// A lattice of these nodes, all free.
    pub fn new(nodes: Nodes3) -> Self {
        let mut grid = Self { nodes, free: vec![false; nodes.node_count()], free_count: nodes.inside() };
        let size = nodes.size;
        for k in 0..size[2] {
            for j in 0..size[1] {
                let row = nodes.number([0, j, k]) as usize;
                grid.free[row..row + size[0] as usize].fill(true);
            }
        }
        grid
    }

    /// Whether `node` can be stood on; nodes of the border cannot.
    ///
    /// # Panics
    /// If there is no such node.
    #[inline]
    pub fn is_free(&self, node: u32) -> bool {
        self.free[node as usize]
    }

    /// Marks `node` as blocked.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn block(&mut self, node: u32) {
        let free = &mut self.free[node as usize];
        self.free_count -= u64::from(*free);
        *free = false;
    }

    /// Number of free nodes.
    pub fn free_count(&self) -> u64 {
        self.free_count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_coordinates_go_round() {
        let grid = Grid3::new(Nodes3::new([4, 3, 5]).unwrap());
        assert_eq!(grid.free_count(), 60);
        let mut inside = 0;
        for (x, y, z) in (0..4).flat_map(|x| (0..3).flat_map(move |y| (0..5).map(move |z| (x, y, z)))) {
            let node = grid.node([x, y, z]).unwrap();
            assert_eq!(grid.xyz(node), [x, y, z]);
            for step in STEPS_26 {
                let to = node.wrapping_add_signed(grid.offset(step));
                let at = [x + step[0], y + step[1], z + step[2]];
                assert_eq!(grid.xyz(to), at);
                assert_eq!(grid.is_free(to), grid.node(at).is_some(), "the border is blocked: {at:?}");
                inside += u32::from(grid.is_free(to));
            }
        }
        assert!(inside > 0 && inside < 60 * 26, "{inside}");
    }

    #[test]
    fn a_node_that_is_blocked_twice_is_missing_once() {
        let mut grid = Grid3::new(Nodes3::new([3, 2, 2]).unwrap());
        for at in [[0, 0, 0], [2, 1, 1], [0, 0, 0]] {
            grid.block(grid.node(at).unwrap());
        }
        grid.block(0);
        let nodes = 0..grid.node_count() as u32;
        assert_eq!(grid.free_count(), nodes.filter(|&node| grid.is_free(node)).count() as u64);
        assert_eq!(grid.free_count(), 10);
    }

    #[test]
    fn steps_come_in_mirrored_pairs_and_without_standing_still() {
        for (step, mirrored) in STEPS_26.iter().zip(STEPS_26.iter().rev()) {
            assert_eq!(mirrored.map(|c| -c), *step);
        }
        assert!(!STEPS_26.contains(&[0, 0, 0]));
    }

    #[test]
    fn a_lattice_without_nodes_or_with_too_many_is_refused() {
        let error = Nodes3::new([3, 0, 2]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a lattice of 3 × 0 × 2 nodes; each side may have 1 to 1023 nodes, and all may have 16777216"
        );
        assert!(Nodes3::new([1024, 1, 1]).is_err());
    }
}
