//! The least cost of a path between two cells, with landmarks of the map or without.

use super::search::{Scratch, octile};
use super::{Case, Landmarks};

impl Case<'_> {
    /// The least cost of an 8-connected path from start to goal, straight moves costing 1 and diagonal ones √2; `None` if there is no
    /// path, or if start or goal is not a free cell. Landmarks of the map make it faster.
    ///
    /// Costs are (straight, diagonal) counts, compared as the floats they round to. Two counts of one cost are the same counts, and
    /// others differ by more than bounds are off by rounding.
    pub fn optimal_cost(&self, landmarks: Option<&Landmarks>) -> Option<f64> {
        let (start, goal) = (self.cell(self.start)?, self.cell(self.goal)?);
        if !self.grid.is_free_xy(start[0], start[1]) || !self.grid.is_free_xy(goal[0], goal[1]) {
            return None;
        }
        let straight = |[x, y]: [i32; 2]| {
            let (dx, dy) = (x.abs_diff(goal[0]), y.abs_diff(goal[1]));
            octile(dx.abs_diff(dy), dx.min(dy))
        };
        let Some(landmarks) = landmarks else {
            let mut scratch = Scratch::new(self.grid.cell_count());
            return self.search((start, Some(goal)), |at| self.moves(at), straight, &mut scratch);
        };
        let of_goal = landmarks.costs(self.index(goal));
        let bound = |at| landmarks.costs(self.index(at)).bound(of_goal, straight(at));
        if bound(start).is_infinite() {
            return None;
        }
        let moves = |at| landmarks.moves(self.index(at));
        landmarks.lend(|scratch| self.search((start, Some(goal)), moves, bound, scratch))
    }
}
