//! Judges paths between corners of square cells, exactly.
//!
//! Corner (x, y) is the lower left one of cell (x, y). A leg of a path may lie on edges of blocked cells, but cross none of them, nor
//! lie between two that share an edge; outside the map all is blocked. A path whose planner leaves corners bends at edges of cells too:
//! its legs each stay in one free cell.

use super::search::{Scratch, octile};
use super::shortest::shortest;
use super::{Answer, Case};
use base::grid::{CornerRule, Grid2};
use base::text::listed;

/// A query between corners of cells, to be judged.
#[derive(Debug, Clone)]
pub struct CornerCase<'a> {
    cells: &'a Grid2,
    /// A cell for every corner, blocked if the corner touches no free cell.
    corners: Grid2,
    ends: [&'a [f64]; 2],
}

/// What is known of a query before a planner runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Least {
    /// The least cost of a path that moves from corner to corner, along edges and across cells.
    pub in_graph: f64,
    /// The length of a shortest path.
    pub shortest: f64,
}

impl<'a> CornerCase<'a> {
    /// The query from the first to the second of `ends` on the map `cells`.
    pub fn new(cells: &'a Grid2, ends: [&'a [f64]; 2]) -> Self {
        let mut corners =
            Grid2::new(cells.width() + 1, cells.height() + 1).expect("a map has room for corners");
        for corner in 0..corners.cell_count() {
            let [x, y] = corners.xy(corner);
            let is_free = |[x, y]: [i32; 2]| cells.is_free_xy(x, y);
            let touches = [[x, y], [x - 1, y], [x, y - 1], [x - 1, y - 1]].into_iter().any(is_free);
            corners.set_blocked(corner, !touches);
        }
        Self { cells, corners, ends }
    }

    /// The same as a query between cells that stand for the corners.
    fn plain(&self) -> Case<'_> {
        let [start, goal] = self.ends;
        Case { grid: &self.corners, corner_rule: CornerRule::Allow, start, goal }
    }

    /// The least costs; `None` if there is no path, or start or goal is no corner of a free cell.
    pub fn least(&self) -> Option<Least> {
        let plain = self.plain();
        let [start, goal] = self.ends.map(|end| plain.cell(end));
        let (start, goal) = start.zip(goal)?;
        if ![start, goal].iter().all(|[x, y]| self.corners.is_free_xy(*x, *y)) {
            return None;
        }
        let bound = |[x, y]: [i32; 2]| {
            let (dx, dy) = (x.abs_diff(goal[0]), y.abs_diff(goal[1]));
            octile(dx.abs_diff(dy), dx.min(dy))
        };
        let mut scratch = Scratch::new(self.corners.cell_count());
        let moves = |at| Case::steps_by(|step| self.is_clear(at, [at[0] + step[0], at[1] + step[1]]));
        let in_graph = plain.search((start, Some(goal)), moves, bound, &mut scratch)?;
        Some(Least { in_graph, shortest: shortest(self.cells, start, goal)? })
    }

    /// Why `answer` is not a path as claimed; `None` if it is.
    pub fn refuse_path(&self, answer: &Answer<'_>, least: Option<Least>) -> Option<String> {
        let Some(least) = least else {
            return Some("a path is claimed where the verifier finds none".to_owned());
        };
        let [Some(first), Some(last)] = [answer.path.first(), answer.path.last()] else {
            return Some("the path is empty".to_owned());
        };
        if [first.as_slice(), last.as_slice()] != self.ends {
            let [first, last] = [first, last].map(listed);
            return Some(format!("the path goes from {first} to {last}, not from start to goal"));
        }
        let refused = |two: &[Vec<f64>]| self.refuse_leg(&two[0], &two[1], answer.in_graph);
        if let Some(refusal) = answer.path.windows(2).find_map(refused) {
            return Some(refusal);
        }
        let leg = |two: &[Vec<f64>]| {
            let [dx, dy] = [0, 1].map(|axis: usize| two[1][axis] - two[0][axis]);
            (dx * dx + dy * dy).sqrt()
        };
        let length = answer.path.windows(2).map(leg).sum();
        let of_graph = Answer { optimal: answer.optimal && answer.in_graph, ..*answer };
        if let Some(refusal) = self.plain().refuse_length(&of_graph, length, least.in_graph) {
            return Some(refusal);
        }
        let shortest = least.shortest;
        let error = (length - shortest) / shortest.max(1.0);
        if error < -super::COST_TOLERANCE {
            return Some(format!("the length {length} is below {shortest}, that of a shortest path"));
        }
        let must_be_shortest = answer.optimal && !answer.in_graph;
        (must_be_shortest && error > super::COST_TOLERANCE)
            .then(|| format!("the length {length} is not {shortest}, that of a shortest path"))
    }

    /// Why a claim that there is no path is wrong; `None` if it is right.
    pub fn refuse_no_path(&self, least: Option<Least>) -> Option<String> {
        self.plain().refuse_no_path(least.map(|least| least.in_graph))
    }

    fn refuse_leg(&self, from: &[f64], to: &[f64], in_graph: bool) -> Option<String> {
        let plain = self.plain();
        let leg = || format!("the leg from {} to {}", listed(from), listed(to));
        let Some((a, b)) = plain.cell(from).zip(plain.cell(to)) else {
            let fits = !in_graph && self.is_in_one_cell(from, to);
            return (!fits).then(|| format!("{} joins no corners and stays in no free cell", leg()));
        };
        if a == b {
            return Some(format!("the path stands still at {}", listed(a)));
        }
        if in_graph && (a[0].abs_diff(b[0]) > 1 || a[1].abs_diff(b[1]) > 1) {
            return Some(format!("{} is not one of the eight moves", leg()));
        }
        (!self.is_clear(a, b)).then(|| format!("{} is not clear of blocked cells", leg()))
    }

    /// Whether both points lie in one free cell, its edges included.
    fn is_in_one_cell(&self, from: &[f64], to: &[f64]) -> bool {
        let low = |axis: usize| from[axis].min(to[axis]);
        let high = |axis: usize| from[axis].max(to[axis]);
        let first = |axis: usize| high(axis).ceil() as i32 - 1;
        let is_free = |[x, y]: [i32; 2]| {
            self.cells.is_free_xy(x, y) && f64::from(x) <= low(0) && f64::from(y) <= low(1)
        };
        let inside = [from, to].iter().all(|at| at.len() == 2 && at.iter().all(|value| value.is_finite()));
        let columns = || first(0)..=first(0) + 1;
        inside
            && (first(1)..=first(1) + 1).any(|y| {
                columns()
                    .any(|x| is_free([x, y]) && high(0) <= f64::from(x + 1) && high(1) <= f64::from(y + 1))
            })
    }

    /// Whether no blocked cell is crossed between two corners: looked at column by column.
    fn is_clear(&self, from: [i32; 2], to: [i32; 2]) -> bool {
        let is_free = |x: i32, y: i32| self.cells.is_free_xy(x, y);
        let between = |axis: usize| from[axis].min(to[axis])..from[axis].max(to[axis]);
        if from[0] == to[0] {
            return between(1).all(|y| is_free(from[0], y) || is_free(from[0] - 1, y));
        }
        if from[1] == to[1] {
            return between(0).all(|x| is_free(x, from[1]) || is_free(x, from[1] - 1));
        }
        let [dx, dy] = [i64::from(to[0] - from[0]), i64::from(to[1] - from[1])];
        between(0).all(|x| {
            // The heights at which the leg enters and leaves the column, times |dx|.
            let height = |x: i32| i64::from(from[1]) * dx.abs() + dy * i64::from(x - from[0]) * dx.signum();
            let (one, other) = (height(x), height(x + 1));
            let low = one.min(other).div_euclid(dx.abs());
            let high = -(-one.max(other)).div_euclid(dx.abs());
            (low..high).all(|y| is_free(x, y as i32))
        })
    }
}

#[cfg(test)]
mod tests;
