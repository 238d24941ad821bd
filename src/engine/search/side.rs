//! One side of a search: its records, its frontier, and the step that every driver repeats.

use super::cost::Cost;
use super::estimate::Estimate;
use super::frontier::{Best, Frontier, Offer};
use super::graph::Graph;
use super::observe::{Lists, Observer, Place};
use super::{Counters, Outcome, Route};

const NONE: u32 = u32::MAX;

/// What happens when a better way to a known node is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Update {
    /// Whether an open node takes the better way.
    pub lower_open: bool,
    /// Whether a closed node takes it and returns to OPEN.
    pub reopen_closed: bool,
    /// Whether an open node that may take a better way takes one that is as good, too.
    pub take_equal: bool,
}

impl Default for Update {
    /// Open nodes are lowered, closed nodes stay closed.
    fn default() -> Self {
        Self { lower_open: true, reopen_closed: false, take_equal: false }
    }
}

/// What a side searches, how it values nodes, and who watches.
#[derive(Debug)]
pub struct SideInputs<'a, G, E, O> {
    /// The successor rule.
    pub graph: &'a mut G,
    /// The key of open nodes.
    pub estimate: &'a E,
    /// Who watches.
    pub observer: &'a mut O,
    /// What a better way changes.
    pub update: Update,
}

#[derive(Clone, Copy, Debug)]
struct Record<C> {
    g: C,
    /// The heuristic, once the node was opened.
    h: f64,
    parent: u32,
    /// How many nodes were opened before, or `NONE` if the node was never opened.
    rank: u32,
    /// The stamp of the node's last offer while it is open, else 0.
    stamp: u32,
}

impl<C: Cost> Record<C> {
    const UNSEEN: Self = Self { g: C::ZERO, h: 0.0, parent: NONE, rank: NONE, stamp: 0 };

    fn place(&self) -> Place {
        match self {
            Self { stamp: 1.., .. } => Place::Open,
            Self { rank: NONE, .. } => Place::Unseen,
            _ => Place::Closed,
        }
    }
}

/// Records and frontier of one side; memory is kept from search to search.
#[derive(Clone, Debug)]
pub(super) struct Side<C, Q> {
    records: Vec<Record<C>>,
    frontier: Q,
    opened: Vec<u32>,
    open: u64,
    stamp: u32,
    pub(super) counters: Counters,
}

impl<C: Cost, Q: Frontier> Side<C, Q> {
    pub(super) fn new(frontier: Q) -> Self {
        let counters = Counters::default();
        Self { records: Vec::new(), frontier, opened: Vec::new(), open: 0, stamp: 0, counters }
    }

    /// Forgets the last search and opens `root`.
    pub(super) fn begin<G, E, O>(&mut self, root: u32, terms: &mut SideInputs<'_, G, E, O>)
    where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        for node in self.opened.drain(..) {
            self.records[node as usize] = Record::UNSEEN;
        }
        self.frontier.clear();
        (self.open, self.stamp, self.counters) = (0, 0, Counters::default());
        if self.records.len() < terms.graph.node_count() {
            self.records.resize(terms.graph.node_count(), Record::UNSEEN);
        }
        self.receive(root, NONE, C::ZERO, terms.estimate, terms.observer, terms.update);
        self.counters.peak_open = 1;
    }

    /// The best open node, still open.
    pub(super) fn best(&mut self) -> Option<Best> {
        loop {
            let best = self.frontier.first()?;
            if self.records[best.node as usize].stamp == best.stamp {
                return Some(best);
            }
            self.frontier.pop();
        }
    }

    /// Moves `node`, which [`best`](Self::best) just gave, from OPEN to CLOSED.
    pub(super) fn close(&mut self, node: u32, observer: &mut impl Observer) {
        observer.selecting(self.lists());
        self.frontier.pop();
        self.records[node as usize].stamp = 0;
        self.open -= 1;
        self.counters.closed += 1;
        observer.closed(node);
    }

    /// Generates the successors of `node` and deals with each; `each` is called with every one after that, and says whether to
    /// go on.
    pub(super) fn expand<G, E, O>(
        &mut self,
        node: u32,
        terms: &mut SideInputs<'_, G, E, O>,
        each: impl FnMut(&Self, u32) -> bool,
    ) where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        let g = self.records[node as usize].g;
        self.expand_by(node, terms, |_, _, cost| (node, g.plus(cost)), each);
    }

    /// As [`expand`](Self::expand), by the parent and g that `way` gives a successor from the cost of the step to it.
    pub(super) fn expand_by<G, E, O>(
        &mut self,
        node: u32,
        terms: &mut SideInputs<'_, G, E, O>,
        mut way: impl FnMut(&Self, u32, C) -> (u32, C),
        mut each: impl FnMut(&Self, u32) -> bool,
    ) where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        let SideInputs { graph, estimate, observer, update } = terms;
        self.counters.expansions += 1;
        let mut goes_on = true;
        graph.successors(node, |to, cost| {
            if !goes_on {
                return;
            }
            self.counters.generated += 1;
            let (parent, g) = way(self, to, cost);
            self.receive(to, parent, g, *estimate, *observer, *update);
            goes_on = each(self, to);
        });
        self.counters.peak_open = self.counters.peak_open.max(self.open);
    }

    /// Searches from the first of `ends` until the second is taken from OPEN; `expand` expands each node that is closed before.
    pub(super) fn run<G, E, O>(
        &mut self,
        ends: [u32; 2],
        max_expansions: u64,
        terms: &mut SideInputs<'_, G, E, O>,
        mut expand: impl FnMut(&mut Self, u32, &mut SideInputs<'_, G, E, O>),
    ) -> Outcome<C>
    where
        G: Graph<Cost = C>,
        E: Estimate<C>,
        O: Observer,
    {
        let [start, goal] = ends;
        self.begin(start, terms);
        loop {
            let Some(Best { node, .. }) = self.best() else { return Outcome::NoPath };
            if node == goal {
                let cost = self.g(goal).expect("a node that ends a search was opened");
                return Outcome::Solved(Route { nodes: self.chain(goal), cost });
            }
            if self.counters.expansions >= max_expansions {
                return Outcome::BudgetSpent;
            }
            self.close(node, terms.observer);
            expand(self, node, terms);
        }
    }

    /// Gives an open node another parent, and the cost of the way over it; its place in OPEN stays.
    pub(super) fn hang(&mut self, node: u32, parent: u32, g: C, observer: &mut impl Observer) {
        observer.reached(node, parent);
        let record = &mut self.records[node as usize];
        (record.parent, record.g) = (parent, g);
    }

    /// The node before `node` on the best way known to it; none for the root and for what was not opened.
    pub(super) fn parent(&self, node: u32) -> Option<u32> {
        self.records.get(node as usize).map(|record| record.parent).filter(|parent| *parent != NONE)
    }

    /// Deals with a way to `node`. Most ways lead to nodes that have a better one: those end here.
    #[inline]
    fn receive(
        &mut self,
        node: u32,
        parent: u32,
        g: C,
        estimate: &impl Estimate<C>,
        observer: &mut impl Observer,
        update: Update,
    ) {
        if self.records.len() <= node as usize {
            self.records.resize(node as usize + 1, Record::UNSEEN);
        }
        let lists = self.lists();
        let record = &self.records[node as usize];
        let place = record.place();
        if parent != NONE {
            observer.generated(place, lists);
        }
        let is_taken = match place {
            Place::Unseen => true,
            Place::Open if update.take_equal => update.lower_open && !record.g.is_below(g),
            Place::Open => update.lower_open && g.is_below(record.g),
            Place::Closed => update.reopen_closed && g.is_below(record.g),
        };
        if is_taken {
            if place == Place::Unseen {
                self.records[node as usize].h = estimate.h(node);
            }
            let Record { h, rank, stamp, .. } = self.take(node, place, parent, g, observer);
            let f = estimate.key(g, h);
            let tie = g.tie();
            self.frontier.push(Offer { f, g: g.value(), tie, rank, stamp, node });
        }
    }

    /// Notes the way to `node` over `parent` at cost `g`; the node was in `place` and is open now.
    fn take(
        &mut self,
        node: u32,
        place: Place,
        parent: u32,
        g: C,
        observer: &mut impl Observer,
    ) -> Record<C> {
        let record = &mut self.records[node as usize];
        match place {
            Place::Open => {}
            Place::Closed => {
                self.counters.closed -= 1;
                self.open += 1;
            }
            Place::Unseen => {
                record.rank = self.opened.len() as u32;
                self.opened.push(node);
                self.counters.opened += 1;
                self.open += 1;
                observer.opened(node);
            }
        }
        if parent != NONE {
            observer.reached(node, parent);
        }
        self.stamp += 1;
        (record.g, record.parent, record.stamp) = (g, parent, self.stamp);
        *record
    }

    fn lists(&self) -> Lists {
        Lists { open: self.open, closed: self.counters.closed }
    }

    /// Where `node` is.
    pub(super) fn place(&self, node: u32) -> Place {
        self.records.get(node as usize).map_or(Place::Unseen, Record::place)
    }

    /// The cost of the best way known to `node`, if it was opened.
    pub(super) fn g(&self, node: u32) -> Option<C> {
        self.records.get(node as usize).filter(|record| record.rank != NONE).map(|record| record.g)
    }

    /// The nodes from the root to `node`, both included; empty if `node` was not opened.
    pub(super) fn chain(&self, node: u32) -> Vec<u32> {
        let mut nodes = Vec::new();
        let mut at = if self.g(node).is_some() { node } else { NONE };
        while at != NONE {
            nodes.push(at);
            at = self.records[at as usize].parent;
        }
        nodes.reverse();
        nodes
    }

    /// The nodes ever opened, in that order.
    pub(super) fn opened(&self) -> &[u32] {
        &self.opened
    }
}
