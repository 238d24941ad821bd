//! The ways from the starts of a query that use up at most half of its turn.

use std::{
    cmp::Reverse,
    collections::{BTreeMap, BinaryHeap},
};

use super::{Cell, SLACK, TurnQuery, fits, net::Net, reserve::Reserve};

/// A way to a cell. `parent` leads back to the start; there is none for the first segment, or for what stands at a start
/// with a heading and has no length yet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Label {
    cell: usize,
    direction: usize,
    pub(super) length: f64,
    pub(super) turn_deg: f64,
    parent: Option<usize>,
    from: usize,
}

/// All ways worth keeping, by cell and direction of arrival.
pub(super) struct Half {
    net: Net,
    labels: Vec<Label>,
    kept: Vec<Vec<Label>>,
    arrival: Option<Label>,
}

struct Search<'a> {
    net: &'a Net,
    reserve: Reserve,
    query: &'a TurnQuery,
    /// An open-ended turn has no half: then ways are followed to the goal.
    most_deg: f64,
    labels: Vec<Label>,
    /// By cell and direction of arrival, the best label of those that are alike.
    best: Vec<BTreeMap<(i64, i64), Best>>,
    /// Least estimate first (as the bits of a non-negative float), then the older label.
    queue: BinaryHeap<Reverse<(u64, usize)>>,
}

/// The label that is taken from the queue before all that are alike.
struct Best {
    /// The bits of its estimate.
    estimate: u64,
    id: usize,
    is_settled: bool,
}

impl Half {
    /// The ways from `query`'s starts; up to the first that answers it alone. If each goes on in one of the directions `onward` from its
    /// goal, which adds a bend there, none answers alone.
    pub(super) fn new(query: &TurnQuery, onward: &[Cell]) -> Self {
        let net = Net::new(query);
        let mut search = Search {
            net: &net,
            reserve: Reserve::new(&net, query.turn_deg.low - SLACK, |arrival| {
                net.most_onward_deg(arrival, onward)
            }),
            query,
            most_deg: (query.turn_deg.high / 2.0) + SLACK,
            labels: Vec::new(),
            best: (0..net.len() * net.directions()).map(|_| BTreeMap::new()).collect(),
            queue: BinaryHeap::new(),
        };
        for &start in net.starts() {
            if net.headings().is_empty() {
                search.extend(start, None);
            }
            for &direction in net.headings() {
                let at_start =
                    Label { cell: start, direction, length: 0.0, turn_deg: 0.0, parent: None, from: start };
                search.queue(0.0, at_start);
            }
        }
        let mut arrival = None;
        while let Some(Reverse((_, id))) = search.queue.pop() {
            let label = search.labels[id];
            if !search.settle(id, &label) {
                continue;
            }
            if onward.is_empty() && search.is_answer(&label) {
                arrival = Some(label);
                break;
            }
            search.extend(label.cell, Some(id));
        }
        let labels = search.labels;
        let best = search.best;
        let settled = |alike: BTreeMap<_, Best>| {
            let settled = alike.into_values().filter(|best| best.is_settled);
            settled.map(|best| labels[best.id]).collect()
        };
        Self { kept: best.into_iter().map(settled).collect(), net, labels, arrival }
    }

    /// The shortest way that answers the query without a second half.
    pub(super) fn arrival(&self) -> Option<&Label> {
        self.arrival.as_ref()
    }

    pub(super) fn net(&self) -> &Net {
        &self.net
    }

    /// Cells with directions of arrival.
    pub(super) fn states(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.net.len())
            .flat_map(|cell| (0..self.net.directions()).map(move |direction| (cell, direction)))
    }

    /// The ways to `cell` that arrive in `direction`, by rising turn.
    pub(super) fn labels(&self, cell: usize, direction: usize) -> &[Label] {
        &self.kept[cell * self.net.directions() + direction]
    }

    /// The corners from the start to the label's cell.
    pub(super) fn chain(&self, label: &Label) -> Vec<Cell> {
        let mut cells = vec![self.net.cell(label.cell)];
        let mut next = Some(label);
        while let Some(label) = next.filter(|label| label.length > 0.0) {
            cells.push(self.net.cell(label.from));
            next = label.parent.map(|id| &self.labels[id]);
        }
        cells.reverse();
        cells
    }
}

impl Search<'_> {
    /// What two labels at one cell and direction must share for one of them to be superfluous.
    fn key(&self, label: &Label) -> (i64, i64) {
        let told_apart = |quantity: f64| (quantity * 1e7).round() as i64;
        let length = if self.query.length.low > 0.0 { told_apart(label.length) } else { 0 };
        (told_apart(label.turn_deg), length)
    }

    /// Whether the label is the best of its like, which is settled with it.
    fn settle(&mut self, id: usize, label: &Label) -> bool {
        let key = self.key(label);
        let state = self.state(label);
        let best = self.best[state].get_mut(&key).filter(|best| best.id == id);
        best.map(|best| best.is_settled = true).is_some()
    }

    /// Queues a label unless one like it leaves the queue first.
    fn queue(&mut self, estimate: f64, label: Label) {
        let key = self.key(&label);
        let state = self.state(&label);
        let id = self.labels.len();
        let next = Best { estimate: estimate.to_bits(), id, is_settled: false };
        let best = self.best[state].entry(key).or_insert(Best { estimate: u64::MAX, ..next });
        if !best.is_settled && next.estimate < best.estimate {
            self.queue.push(Reverse((next.estimate, id)));
            self.labels.push(label);
            *best = next;
        }
    }

    fn state(&self, label: &Label) -> usize {
        label.cell * self.net.directions() + label.direction
    }

    fn is_answer(&self, label: &Label) -> bool {
        self.net.is_goal(label.cell)
            && label.length > 0.0
            && label.turn_deg >= self.query.turn_deg.low - SLACK
            && fits(self.query, label.length)
    }

    /// Queues every segment that leaves `cell` with a bend, and every one that leaves a start.
    fn extend(&mut self, cell: usize, parent: Option<usize>) {
        let (length, turn_deg, arrival) = parent.map_or((0.0, 0.0, None), |id| {
            let label = &self.labels[id];
            (label.length, label.turn_deg, Some(label.direction))
        });
        let longest = self.net.longest();
        let high_deg = self.query.turn_deg.high + SLACK;
        for segment in self.net.segments(cell) {
            if length + segment.least_total > longest {
                break;
            }
            let bend_deg = match arrival {
                None => 0.0,
                Some(straight_on) if straight_on == segment.direction && length > 0.0 => continue,
                Some(arrival) => self.net.turn_deg(arrival, segment.direction),
            };
            let length = length + segment.length;
            let turn_deg = turn_deg + bend_deg;
            let to = segment.to;
            let direction = segment.direction;
            if turn_deg > self.most_deg || turn_deg + self.net.least_turn_deg(to, direction) > high_deg {
                continue;
            }
            let least_total = length + self.reserve.least_length(to, direction, turn_deg);
            if least_total <= longest {
                self.queue(least_total, Label { cell: to, direction, length, turn_deg, parent, from: cell });
            }
        }
    }
}
