//! Judges paths on a lattice of square cells, exactly.
//!
//! Cell (x, y) is the unit square around the integer point (x, y). A segment between two cell centres is judged
//! in integers: it enters a cell if it meets the cell's open interior. Where it passes exactly through the corner
//! between two diagonal cells, the corner rule decides by the two cells that flank it.

mod corners;
mod landmarks;
mod optimum;
mod search;
mod shortest;

pub use corners::{CornerCase, Least};
pub use landmarks::Landmarks;

use base::grid::{CornerRule, Grid2};
use base::text::listed;

/// How far a claimed cost may be from the recomputed one, relative: room for another order of summation.
const COST_TOLERANCE: f64 = 1e-9;

/// A query to be judged.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    /// The cells.
    pub grid: &'a Grid2,
    /// Which corners may be cut.
    pub corner_rule: CornerRule,
    /// The start, [x, y] in cells.
    pub start: &'a [f64],
    /// The goal, [x, y] in cells.
    pub goal: &'a [f64],
}

/// What a planner claims.
#[derive(Debug, Clone, Copy)]
pub struct Answer<'a> {
    /// Points from start to goal, [x, y] in cells.
    pub path: &'a [Vec<f64>],
    /// The claimed cost.
    pub cost: Option<f64>,
    /// Every step must be one of the eight moves.
    pub in_graph: bool,
    /// The cost must be the least there is in the graph.
    pub optimal: bool,
    /// The corners that a segment off the graph may pass, if not those of the case: it must keep one of the two rules.
    pub sight_corners: Option<CornerRule>,
}

impl Case<'_> {
    /// Why `answer` is not a path as claimed; `None` if it is.
    pub fn refuse_path(&self, answer: &Answer<'_>, optimal: Option<f64>) -> Option<String> {
        let Some(optimal) = optimal else {
            return Some("a path is claimed where the verifier finds none".to_owned());
        };
        let points: Option<Vec<[i32; 2]>> = answer.path.iter().map(|point| self.cell(point)).collect();
        let Some(points) = points else {
            return Some("a point of the path is not a cell centre of the map".to_owned());
        };
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Some("the path is empty".to_owned());
        };
        if (Some(*first), Some(*last)) != (self.cell(self.start), self.cell(self.goal)) {
            let [first, last] = [first, last].map(listed);
            return Some(format!("the path goes from {first} to {last}, not from start to goal"));
        }
        if let Some(refusal) = points.windows(2).find_map(|pair| self.refuse_step(pair, answer)) {
            return Some(refusal);
        }
        let length = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        self.refuse_length(answer, length, optimal)
    }

    /// Why a claim that there is no path is wrong; `None` if it is right.
    pub fn refuse_no_path(&self, optimal: Option<f64>) -> Option<String> {
        optimal.map(|cost| format!("no path is claimed where the verifier finds one of cost {cost}"))
    }

    fn refuse_step(&self, pair: &[[i32; 2]], answer: &Answer<'_>) -> Option<String> {
        let (from, to) = (pair[0], pair[1]);
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        if [dx, dy] == [0, 0] {
            return Some(format!("the path stands still at {from}", from = listed(from)));
        }
        if answer.in_graph && (dx.abs() > 1 || dy.abs() > 1) {
            return Some(format!(
                "the step from {from} to {to} is not one of the eight moves",
                from = listed(from),
                to = listed(to)
            ));
        }
        let (xs, ys) = (from[0].min(to[0])..=from[0].max(to[0]), from[1].min(to[1])..=from[1].max(to[1]));
        for cell in ys.flat_map(|y| xs.clone().map(move |x| [x, y])) {
            if enters(from, to, cell) && !self.grid.is_free_xy(cell[0], cell[1]) {
                return Some(format!(
                    "the segment from {from} to {to} enters the blocked cell {cell}",
                    from = listed(from),
                    to = listed(to),
                    cell = listed(cell)
                ));
            }
        }
        let refusal = self.refuse_corners(from, [dx, dy]);
        let own = answer.sight_corners.filter(|_| !answer.in_graph);
        refusal.filter(|_| {
            own.is_none_or(|corner_rule| {
                Self { corner_rule, ..*self }.refuse_corners(from, [dx, dy]).is_some()
            })
        })
    }

    /// A segment meets lattice corners at even fractions of its way only if both reduced components are odd.
    fn refuse_corners(&self, from: [i32; 2], [dx, dy]: [i32; 2]) -> Option<String> {
        let parts = gcd(dx.unsigned_abs(), dy.unsigned_abs()) as i32;
        let (step_x, step_y) = (dx / parts, dy / parts);
        if step_x % 2 == 0 || step_y % 2 == 0 {
            return None;
        }
        let unit = [step_x.signum(), step_y.signum()];
        let cells_before = [(step_x - unit[0]) / 2, (step_y - unit[1]) / 2];
        (0..parts).find_map(|part| {
            let at = [from[0] + part * step_x + cells_before[0], from[1] + part * step_y + cells_before[1]];
            (!self.may_step(at, unit)).then(|| {
                format!("the path cuts the corner after {at}, which the corner rule forbids", at = listed(at))
            })
        })
    }

    fn refuse_length(&self, answer: &Answer<'_>, length: f64, optimal: f64) -> Option<String> {
        let Some(claimed) = answer.cost else { return Some("a solved plan claims no cost".to_owned()) };
        let near = |a: f64, b: f64| (a - b).abs() <= COST_TOLERANCE * b.max(1.0);
        if !near(claimed, length) {
            return Some(format!("the claimed cost is {claimed}, the path's length {length}"));
        }
        if answer.in_graph && length < optimal && !near(length, optimal) {
            return Some(format!("the length {length} is below the optimum {optimal}"));
        }
        if answer.optimal && !near(length, optimal) {
            return Some(format!("the length {length} is not the optimum {optimal}"));
        }
        let start = self.cell(self.start).zip(self.cell(self.goal));
        let straight = start.map(|(start, goal)| distance(start, goal))?;
        (length < straight && !near(length, straight))
            .then(|| format!("the length {length} is below the straight line {straight}"))
    }

    fn may_step(&self, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> bool {
        if dx == 0 || dy == 0 {
            return true;
        }
        let blocked = [!self.grid.is_free_xy(x + dx, y), !self.grid.is_free_xy(x, y + dy)];
        match self.corner_rule {
            CornerRule::Allow => true,
            CornerRule::ForbidBoth => blocked != [true, true],
            CornerRule::ForbidAny => blocked == [false, false],
        }
    }

    fn cell(&self, point: &[f64]) -> Option<[i32; 2]> {
        let inside = |value: f64, side: u32| value.fract() == 0.0 && (0.0..f64::from(side)).contains(&value);
        let [x, y] = *point else { return None };
        (inside(x, self.grid.width()) && inside(y, self.grid.height())).then_some([x as i32, y as i32])
    }
}

/// Whether the segment between two cell centres meets the open interior of `cell`, by separating axes.
fn enters(from: [i32; 2], to: [i32; 2], cell: [i32; 2]) -> bool {
    let doubled = |[x, y]: [i32; 2]| [2 * i64::from(x), 2 * i64::from(y)];
    let (a, b, c) = (doubled(from), doubled(to), doubled(cell));
    let apart = |axis: usize| a[axis].max(b[axis]) < c[axis] || a[axis].min(b[axis]) > c[axis];
    if apart(0) || apart(1) {
        return false;
    }
    let side = |x: i64, y: i64| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
    let corners = [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(|[dx, dy]| side(c[0] + dx, c[1] + dy));
    let strictly_left = corners.iter().any(|s| *s > 0);
    let strictly_right = corners.iter().any(|s| *s < 0);
    from == to || (strictly_left && strictly_right)
}

fn distance(a: [i32; 2], b: [i32; 2]) -> f64 {
    let [dx, dy] = [a[0] - b[0], a[1] - b[1]].map(f64::from);
    (dx * dx + dy * dy).sqrt()
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests;
