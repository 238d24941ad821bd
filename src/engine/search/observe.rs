//! Watching a search without changing it.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

/// Follows what a search does. Every method does nothing unless written, and `()` watches nothing at no cost.
pub trait Observer {
    /// `node` entered OPEN for the first time.
    fn opened(&mut self, node: u32) {
        let _ = node;
    }

    /// `node` is reached over `parent` from now on.
    fn reached(&mut self, node: u32, parent: u32) {
        let _ = (node, parent);
    }

    /// `node` was taken from OPEN and closed.
    fn closed(&mut self, node: u32) {
        let _ = node;
    }

    /// The best open node is about to be taken.
    fn selecting(&mut self, lists: Lists) {
        let _ = lists;
    }

    /// A successor was generated and found in `place`; `lists` are as they were before it was dealt with.
    fn generated(&mut self, place: Place, lists: Lists) {
        let _ = (place, lists);
    }
}

/// How long the two lists are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lists {
    /// Nodes in OPEN.
    pub open: u64,
    /// Nodes in CLOSED.
    pub closed: u64,
}

/// Where a generated node is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In neither list.
    Unseen,
    /// In OPEN.
    Open,
    /// In CLOSED.
    Closed,
}

impl Observer for () {}

/// The order in which nodes were opened and closed, for figures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VisitOrder {
    /// Nodes in the order in which they first entered OPEN.
    pub opened: Vec<u32>,
    /// Nodes in the order in which they were closed; a node that reopened stands here again.
    pub closed: Vec<u32>,
}

impl Observer for VisitOrder {
    fn opened(&mut self, node: u32) {
        self.opened.push(node);
    }

    fn closed(&mut self, node: u32) {
        self.closed.push(node);
    }
}

/// The parent that each node had when it was closed, for figures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Parents {
    now: BTreeMap<u32, u32>,
    /// Parents in the order in which nodes were closed; the root is its own.
    pub closed: Vec<u32>,
}

impl Observer for Parents {
    fn reached(&mut self, node: u32, parent: u32) {
        self.now.insert(node, parent);
    }

    fn closed(&mut self, node: u32) {
        self.closed.push(self.now.get(&node).copied().unwrap_or(node));
    }
}

/// The order in which both sides of a search closed nodes, with what each had opened by then.
#[derive(Debug, Default)]
pub struct Closings {
    opened: [Cell<u32>; 2],
    closed: RefCell<Vec<Closing>>,
}

/// A node that was closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Closing {
    /// The node.
    pub node: u32,
    /// Who closed it: the start's side (0) or the goal's (1).
    pub side: u32,
    /// How many nodes each side had opened before.
    pub opened: [u32; 2],
}

impl Closings {
    /// Who watches the start's side (0), which is the only one of a search in one direction, or the goal's (1).
    pub fn one_side(&self, side: u32) -> OneSide<'_> {
        OneSide { both: self, side }
    }

    /// What was closed, in order; a node that reopened stands there again.
    pub fn all(self) -> Vec<Closing> {
        self.closed.into_inner()
    }
}

/// Notes in [`Closings`] what one side does.
#[derive(Clone, Copy, Debug)]
pub struct OneSide<'a> {
    both: &'a Closings,
    side: u32,
}

impl Observer for OneSide<'_> {
    fn opened(&mut self, _: u32) {
        self.both.opened[self.side as usize].update(|count| count + 1);
    }

    fn closed(&mut self, node: u32) {
        let opened = self.both.opened.each_ref().map(Cell::get);
        self.both.closed.borrow_mut().push(Closing { node, side: self.side, opened });
    }
}

/// What the same search would compare if OPEN and CLOSED were plain lists scanned from end to end, as short MATLAB
/// programs keep them.
///
/// Taking the best of n open nodes costs n comparisons. Looking a successor up costs the length of CLOSED and,
/// unless it is found there, the length of OPEN; scans do not stop early.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ListScans {
    /// Comparisons of f to find the smallest in OPEN.
    pub minimum_comparisons: u64,
    /// Comparisons of nodes to look successors up.
    pub membership_comparisons: u64,
}

impl Observer for ListScans {
    fn selecting(&mut self, lists: Lists) {
        self.minimum_comparisons += lists.open;
    }

    fn generated(&mut self, place: Place, lists: Lists) {
        let in_open = if place == Place::Closed { 0 } else { lists.open };
        self.membership_comparisons += lists.closed + in_open;
    }
}

impl<O: Observer + ?Sized> Observer for &mut O {
    fn opened(&mut self, node: u32) {
        (**self).opened(node);
    }

    fn reached(&mut self, node: u32, parent: u32) {
        (**self).reached(node, parent);
    }

    fn closed(&mut self, node: u32) {
        (**self).closed(node);
    }

    fn selecting(&mut self, lists: Lists) {
        (**self).selecting(lists);
    }

    fn generated(&mut self, place: Place, lists: Lists) {
        (**self).generated(place, lists);
    }
}

impl<A: Observer, B: Observer> Observer for (A, B) {
    fn opened(&mut self, node: u32) {
        self.0.opened(node);
        self.1.opened(node);
    }

    fn reached(&mut self, node: u32, parent: u32) {
        self.0.reached(node, parent);
        self.1.reached(node, parent);
    }

    fn closed(&mut self, node: u32) {
        self.0.closed(node);
        self.1.closed(node);
    }

    fn selecting(&mut self, lists: Lists) {
        self.0.selecting(lists);
        self.1.selecting(lists);
    }

    fn generated(&mut self, place: Place, lists: Lists) {
        self.0.generated(place, lists);
        self.1.generated(place, lists);
    }
}
