//! The segments that a turn query may use, with what each costs at least.

use std::collections::BTreeMap;

use super::{Cell, Convention, SLACK, TurnQuery, change_deg, difference, distance};

/// A segment from some cell.
pub(super) struct Segment {
    pub(super) to: usize,
    pub(super) direction: usize,
    pub(super) length: f64,
    /// Its length and the straight line from its end to the nearest goal.
    pub(super) least_total: f64,
}

/// Cells within the query's ellipse, the segments between them, and the angles between directions.
pub(super) struct Net {
    cells: Vec<Cell>,
    starts: Vec<usize>,
    /// The directions that the query may turn from at a start.
    headings: Vec<usize>,
    convention: Convention,
    /// By cell, the straight line from the nearest start.
    from_start: Vec<f64>,
    is_goal: Vec<bool>,
    longest: f64,
    /// By cell, least total first.
    segments: Vec<Vec<Segment>>,
    vectors: Vec<Cell>,
    /// By direction of arrival, then of departure.
    bends_deg: Vec<Vec<f64>>,
    /// By cell, then by direction of arrival: no way on to a goal turns less.
    least_turns_deg: Vec<Vec<f64>>,
}

impl Net {
    pub(super) fn new(query: &TurnQuery) -> Self {
        let longest = query.length.high + SLACK;
        let nearest = |cell: Cell, ends: &[Cell]| {
            ends.iter().map(|&end| distance(cell, end)).fold(f64::INFINITY, f64::min)
        };
        let all = (0..query.size[1]).flat_map(|y| (0..query.size[0]).map(move |x| [x, y]));
        let is_near = |&c: &Cell| nearest(c, &query.starts) + nearest(c, &query.goals) <= longest;
        let cells: Vec<Cell> = all.filter(is_near).collect();
        let from_start: Vec<f64> = cells.iter().map(|&c| nearest(c, &query.starts)).collect();
        let to_goal: Vec<f64> = cells.iter().map(|&c| nearest(c, &query.goals)).collect();
        let mut directions = BTreeMap::new();
        let mut segments: Vec<Vec<Segment>> = Vec::new();
        for (i, &from) in cells.iter().enumerate() {
            let mut leaving = Vec::new();
            for (j, &to) in cells.iter().enumerate() {
                let length = distance(from, to);
                let least_total = length + to_goal[j];
                if i != j && from_start[i] + least_total <= longest {
                    let direction = index_of(primitive(difference(from, to)), &mut directions);
                    leaving.push(Segment { to: j, direction, length, least_total });
                }
            }
            leaving.sort_by(|a, b| a.least_total.total_cmp(&b.least_total));
            segments.push(leaving);
        }
        let headings = query.headings.iter().map(|&heading| index_of(heading, &mut directions)).collect();
        let starts = (0..cells.len()).filter(|&i| query.starts.contains(&cells[i])).collect();
        let is_goal = cells.iter().map(|cell| query.goals.contains(cell)).collect();
        let vectors = by_index(&directions);
        let bends_deg = bends_deg(&vectors, query.convention);
        let least_turns_deg = least_turns_deg(&cells, &vectors, query);
        let convention = query.convention;
        Self {
            cells,
            starts,
            headings,
            convention,
            from_start,
            is_goal,
            longest,
            segments,
            vectors,
            bends_deg,
            least_turns_deg,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.cells.len()
    }

    pub(super) fn directions(&self) -> usize {
        self.bends_deg.len()
    }

    pub(super) fn starts(&self) -> &[usize] {
        &self.starts
    }

    pub(super) fn headings(&self) -> &[usize] {
        &self.headings
    }

    pub(super) fn least_from_start(&self, cell: usize) -> f64 {
        self.from_start[cell]
    }

    pub(super) fn is_goal(&self, cell: usize) -> bool {
        self.is_goal[cell]
    }

    /// What no polyline may exceed, slack included.
    pub(super) fn longest(&self) -> f64 {
        self.longest
    }

    pub(super) fn cell(&self, cell: usize) -> Cell {
        self.cells[cell]
    }

    /// The shortest lattice vector in a direction.
    pub(super) fn vector(&self, direction: usize) -> Cell {
        self.vectors[direction]
    }

    pub(super) fn segments(&self, cell: usize) -> &[Segment] {
        &self.segments[cell]
    }

    pub(super) fn bend_deg(&self, arrival: usize, departure: usize) -> f64 {
        self.bends_deg[arrival][departure]
    }

    /// What going on in `departure` adds: nothing straight on.
    pub(super) fn turn_deg(&self, arrival: usize, departure: usize) -> f64 {
        if arrival == departure { 0.0 } else { self.bends_deg[arrival][departure] }
    }

    /// The most that going on from a goal in one of the directions `onward` adds; nothing if there are none.
    pub(super) fn most_onward_deg(&self, arrival: usize, onward: &[Cell]) -> f64 {
        let changes = onward.iter().map(|&onward| change_deg(self.vectors[arrival], onward));
        changes
            .filter(|&change| change > 0.0)
            .map(|change| self.convention.bend_deg(change))
            .fold(0.0, f64::max)
    }

    pub(super) fn least_turn_deg(&self, cell: usize, direction: usize) -> f64 {
        self.least_turns_deg[cell][direction]
    }
}

fn index_of(vector: Cell, directions: &mut BTreeMap<Cell, usize>) -> usize {
    let known = directions.len();
    *directions.entry(vector).or_insert(known)
}

fn by_index(directions: &BTreeMap<Cell, usize>) -> Vec<Cell> {
    let mut vectors = vec![[0, 0]; directions.len()];
    for (&vector, &index) in directions {
        vectors[index] = vector;
    }
    vectors
}

fn bends_deg(vectors: &[Cell], convention: Convention) -> Vec<Vec<f64>> {
    let row = |&u: &Cell| vectors.iter().map(|&v| convention.bend_deg(change_deg(u, v))).collect();
    vectors.iter().map(row).collect()
}

/// A way from `cell` to a goal ends up displaced towards the goal, so some segment of it deviates from the
/// arrival by at least the angle to the goal. Interior angles shrink as bends sharpen: there the bound is 0.
fn least_turns_deg(cells: &[Cell], vectors: &[Cell], query: &TurnQuery) -> Vec<Vec<f64>> {
    let least = |cell: Cell, arrival: Cell| {
        let towards = query.goals.iter().map(|&goal| difference(cell, goal));
        towards.map(|ahead| change_deg(arrival, ahead)).fold(f64::INFINITY, f64::min)
    };
    let row = |&cell: &Cell| {
        let of = |&arrival: &Cell| match query.convention {
            Convention::Exterior => least(cell, arrival),
            Convention::Interior => 0.0,
        };
        vectors.iter().map(of).collect()
    };
    cells.iter().map(row).collect()
}

fn primitive(vector: Cell) -> Cell {
    let (mut a, mut b) = (vector[0].abs(), vector[1].abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    vector.map(|component| component / a)
}
