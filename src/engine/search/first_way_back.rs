//! The length that A* returns if it never lowers the g of an open node, found backwards from the goal.
//!
//! [`FirstWayAstar`](super::FirstWayAstar) runs that A* forwards and opens hundreds of nodes. Most lengths follow from
//! what few nodes on the way do:
//!
//! - A node is opened by its neighbour that is expanded first, the one of least f, as f falls along no path.
//! - The shortest way to a node bounds its f from below. So neighbours compute their f in the order of these bounds, and
//!   once the bound of the next exceeds the least f found, the rest need not be looked at.
//! - The question to a neighbour is what happens before the asker is opened; nodes with an open question have no part in that.
//!   An answer is kept only if none of them could have changed it.
//!
//! Where neighbours of equal f would open a node with different g, the order among equals decides; where too many nodes
//! have to be looked at, searching forwards is faster. Both are left [`Unsettled`].

use super::cost::{Cost as _, Octile, quantised};
use super::estimate::ScaledOctile;
use base::grid::{DIRECTIONS, Moves};
use std::f64::consts::SQRT_2;

/// Keys of f this close count as equal: rounding moves a key by one.
const CLOSE: u64 = 8;

/// How many nodes are looked at before a query is given up: the settled ones ask 64 on average.
const MOST_ASKED: u32 = 90;

/// A length of a path whose cells no flood has given.
const FAR: f64 = 1e9;

/// The length depends on the order among equals, or would take too long to find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unsettled;

/// The search backwards, built for one grid and used for many queries.
#[derive(Clone, Debug)]
pub struct FirstWayBack {
    width: u32,
    /// Twice the width, so that the difference of two nodes names one offset.
    stride: usize,
    /// The place of the offset 0 in `h`.
    center: usize,
    masks: Vec<u8>,
    steps: [isize; 8],
    /// The length of each offset.
    h: Vec<f64>,
    /// The shortest length from the start to each node.
    shortest: Vec<f64>,
    start: usize,
    goal: usize,
    /// The numbers of diagonal moves by the remainder of a scaled length.
    diagonals: Vec<u32>,
    known: Vec<Known>,
    query: u32,
    left: u32,
}

/// What the query of this number knows of a node.
#[derive(Clone, Copy, Debug, Default)]
struct Known {
    query: u32,
    /// How many nodes wait for it, if its question is open; 0 if it has answered.
    depth: u32,
    answer: Answer,
}

/// The f and g with which a node is opened.
#[derive(Clone, Copy, Debug, Default)]
struct Answer {
    f: u64,
    g: Octile,
}

/// An answer, if there is one within the limit, and the least depth of a waiting node that was left out.
type AnswerWithinLimit = (Option<Answer>, u32);

impl FirstWayBack {
    /// The search over the legal `moves` of a grid.
    pub fn new(moves: &Moves) -> Self {
        let (width, height) = (moves.width(), moves.cell_count() / moves.width());
        let stride = 2 * width as usize + 2;
        let offset = |at: usize| [at % stride, at / stride].map(|part| part as f64);
        let length = |[x, y]: [f64; 2]| {
            let (dx, dy) = (x - f64::from(width), y - f64::from(height));
            (dx * dx + dy * dy).sqrt()
        };
        let mut search = Self {
            width,
            stride,
            center: height as usize * stride + width as usize,
            masks: vec![0; (height as usize + 2) * stride],
            steps: DIRECTIONS.map(|[dx, dy]| dy as isize * stride as isize + dx as isize),
            h: (0..(2 * height as usize + 1) * stride).map(|at| length(offset(at))).collect(),
            shortest: vec![FAR; (height as usize + 2) * stride],
            start: 0,
            goal: 0,
            diagonals: vec![0; ScaledOctile::STRAIGHT as usize],
            known: vec![Known::default(); (height as usize + 2) * stride],
            query: 0,
            left: 0,
        };
        for diagonal in 0..ScaledOctile::STRAIGHT {
            let rest = diagonal * ScaledOctile::DIAGONAL % ScaledOctile::STRAIGHT;
            search.diagonals[rest as usize] = diagonal;
        }
        for cell in 0..moves.cell_count() {
            let node = search.node(cell);
            search.masks[node] = moves.mask(cell);
        }
        search
    }

    fn node(&self, cell: u32) -> usize {
        (cell / self.width + 1) as usize * self.stride + (cell % self.width) as usize + 1
    }

    /// Makes `start` the start of the queries that follow; what is known of another is forgotten.
    pub fn begin(&mut self, start: u32) {
        self.shortest.fill(FAR);
        self.start = self.node(start);
    }

    /// Tells the shortest length from the start to `cell`, in the units of [`ScaledOctile`]. It must be given for all cells up
    /// to the bound of a query.
    #[inline]
    pub fn set_length(&mut self, cell: u32, length: u32) {
        let node = self.node(cell);
        let diagonal = self.diagonals[(length % ScaledOctile::STRAIGHT) as usize];
        let straight = (length - diagonal * ScaledOctile::DIAGONAL) / ScaledOctile::STRAIGHT;
        self.shortest[node] = Octile { straight, diagonal }.value();
    }

    /// The length of the path that this A* returns to `goal`, if there is one of at most `most`, in the units of
    /// [`ScaledOctile`]; it is the same whatever the order among equals.
    ///
    /// # Errors
    /// [`Unsettled`] if that order matters or too many nodes would have to be looked at.
    ///
    /// # Panics
    /// If `goal` is outside the grid.
    pub fn length(&mut self, goal: u32, most: u32) -> Result<Option<Octile>, Unsettled> {
        (self.goal, self.query, self.left) = (self.node(goal), self.query + 1, MOST_ASKED);
        if self.goal == self.start {
            return Ok(Some(Octile::ZERO));
        }
        let first = Answer { f: self.key(0.0, self.start), g: Octile::ZERO };
        self.known[self.start] = Known { query: self.query, depth: 0, answer: first };
        // As in the search forwards.
        let bound = quantised(f64::from(most) * (SQRT_2 / f64::from(ScaledOctile::DIAGONAL))) + 1;
        let (answer, _) = self.ask(self.goal, bound, 1)?;
        Ok(answer.map(|answer| answer.g).filter(|g| ScaledOctile::scaled(*g) <= most))
    }

    #[inline]
    fn key(&self, length: f64, node: usize) -> u64 {
        quantised(length + self.h[node + self.center - self.goal])
    }

    /// With what f and g `node` is opened, if the f of the node that opens it is at most `limit`; `depth` nodes wait for the
    /// answer, the goal's own question counted.
    fn ask(&mut self, node: usize, limit: u64, depth: u32) -> Result<AnswerWithinLimit, Unsettled> {
        self.left = self.left.checked_sub(1).ok_or(Unsettled)?;
        self.known[node] = Known { query: self.query, depth, ..self.known[node] };
        let (mut near, count) = self.neighbours(node, limit);
        let mut first = None;
        let mut least = limit;
        let mut is_tied = false;
        let mut waiting = u32::MAX;
        for place in 0..count {
            let next = (place..count).min_by_key(|place| near[*place]).unwrap_or(place);
            near.swap(place, next);
            let (lower, bit) = near[place];
            if lower > least + CLOSE {
                break;
            }
            let (answer, depth_left_out) = self.answer(node, bit, least + CLOSE, depth)?;
            waiting = waiting.min(depth_left_out);
            let Some(Answer { f, g }) = answer.filter(|answer| answer.f <= least + CLOSE) else { continue };
            let is_earlier = first.is_none() || f + CLOSE < least;
            is_tied = !is_earlier && (is_tied || first != Some(g));
            if is_earlier || f < least {
                (first, least) = (Some(g), f);
            }
        }
        if is_tied {
            return Err(Unsettled);
        }
        // A node that is left out because it is this one changes nothing.
        let waiting = if waiting >= depth { u32::MAX } else { waiting };
        let answer = first.map(|g| Answer { f: self.key(g.value(), node), g });
        let kept = answer.filter(|_| waiting == u32::MAX);
        self.known[node] =
            kept.map_or(Known::default(), |answer| Known { query: self.query, depth: 0, answer });
        Ok((answer, waiting))
    }

    /// The neighbours of `node` as moves, behind the least f that each may have, if that is at most `limit`; how many they are.
    #[inline]
    fn neighbours(&self, node: usize, limit: u64) -> ([(u64, u8); 8], usize) {
        let mut near = [(u64::MAX, 0); 8];
        let mut count = 0;
        let mut left = self.masks[node];
        while left != 0 {
            let bit = left.trailing_zeros() as usize % 8;
            left &= left - 1;
            let next = node.wrapping_add_signed(self.steps[bit]);
            let lower = self.key(self.shortest[next], next);
            if lower <= limit {
                near[count % 8] = (lower, bit as u8);
                count += 1;
            }
        }
        (near, count)
    }

    /// What the neighbour of `node` that move `bit` leads to answers: its f, and the g that it would give `node`.
    #[inline]
    fn answer(
        &mut self,
        node: usize,
        bit: u8,
        limit: u64,
        depth: u32,
    ) -> Result<AnswerWithinLimit, Unsettled> {
        let bit = usize::from(bit) % 8;
        let next = node.wrapping_add_signed(self.steps[bit]);
        let known = self.known[next];
        let (answer, waiting) = match known.depth {
            0 if known.query == self.query => (Some(known.answer), u32::MAX),
            waiting if known.query == self.query => (None, waiting),
            _ => self.ask(next, limit, depth + 1)?,
        };
        let step =
            if DIRECTIONS[bit][0] * DIRECTIONS[bit][1] == 0 { Octile::STRAIGHT } else { Octile::DIAGONAL };
        Ok((answer.map(|answer| Answer { g: answer.g.plus(step), ..answer }), waiting))
    }
}
