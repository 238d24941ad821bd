//! A* over a cubic lattice: the specialisation is the general form.

use super::*;
use base::grid::{Grid3, Nodes3, STEPS_26};

/// The free nodes with their 26 neighbours; near some nodes, moves are refused by chance.
struct Neighbours<'a> {
    grid: &'a Grid3,
    spacing: f64,
}

fn is_near(node: u32) -> bool {
    !node.is_multiple_of(3)
}

fn may_step(node: u32, to: u32) -> bool {
    let mixed = (u64::from(node) << 32 | u64::from(to)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    !(mixed >> 32).is_multiple_of(5)
}

impl Graph for Neighbours<'_> {
    type Cost = f64;

    fn node_count(&self) -> usize {
        self.grid.node_count()
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        for step in STEPS_26 {
            let to = node.wrapping_add_signed(self.grid.offset(step));
            if self.grid.is_free(to) && (!is_near(node) || may_step(node, to)) {
                visit(to, f64::from(step.map(|c| c * c).iter().sum::<i32>()).sqrt() * self.spacing);
            }
        }
    }
}

/// A lattice with a share blocked, and two of its free nodes.
fn lattice(seed: u64) -> (Grid3, [u32; 2]) {
    let mut stream = seed::stream(seed);
    let size: [u32; 3] = std::array::from_fn(|_| stream.random_range(1..14));
    let mut grid = Grid3::new(Nodes3::new(size).unwrap());
    let inside: Vec<u32> = (0..grid.node_count() as u32).filter(|node| grid.is_free(*node)).collect();
    let ends = [0; 2].map(|_| inside[stream.random_range(0..inside.len())]);
    for node in inside.into_iter().filter(|node| !ends.contains(node)) {
        if stream.random_bool(0.7) {
            grid.block(node);
        }
    }
    (grid, ends)
}

#[test]
fn the_search_over_cubes_has_the_path_cost_and_counters_of_the_general_one() {
    let mut solved = 0;
    let mut none = 0;
    let mut spent = 0;
    for ties in [Ties::Fifo, Ties::Lifo] {
        // One memory for lattices of many sizes.
        let mut both = (CubicAstar::new(ties).unwrap(), Search::new(Heap::new(ties)));
        for seed in 0..600 {
            match agreed(&mut both, seed).outcome {
                Outcome::Solved(_) => solved += 1,
                Outcome::NoPath => none += 1,
                Outcome::BudgetSpent => spent += 1,
            }
        }
    }
    // The share that is blocked was chosen after a first run, so that each outcome is met; the rule is that none is rarer than one
    // in thirty. The equality was written before it.
    let least = (solved + none + spent) / 30;
    assert!(
        [solved, none, spent].iter().all(|count| *count >= least),
        "one-sided sample: {solved} solved, {none} without a path, {spent} spent"
    );
    assert!([Ties::LargerG, Ties::Smaller].iter().all(|ties| CubicAstar::new(*ties).is_none()));
}

/// What both searches find on the lattice of `seed`, held to be the same.
fn agreed((special, general): &mut (CubicAstar, Search<f64, Heap>), seed: u64) -> Report<f64> {
    let (grid, [start, goal]) = lattice(seed);
    let spacing = if seed.is_multiple_of(2) { 1.0 } else { 0.3 };
    let max_expansions = if seed.is_multiple_of(5) { 7 } else { u64::MAX };
    let apart = |node: u32| {
        let [a, b] = [node, goal].map(|node| grid.xyz(node));
        (0..3).map(|axis| f64::from(a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt() * spacing
    };
    // Some goals are any of several nodes.
    let is_goal = |node: u32| node == goal || seed.is_multiple_of(7) && apart(node) < spacing;
    let estimate = Combined { h: apart, combine: sum };
    let rules = Rules { stop: Stop::GoalPopped, max_expansions };
    let mut graph = Neighbours { grid: &grid, spacing };
    let truth = general.run(terms(&mut graph, &estimate, &mut ()), start, is_goal, rules, &mut ());
    let query =
        CubicQuery { grid: &grid, spacing, is_near, may_step, h: apart, is_goal, start, max_expansions };
    assert_eq!(special.run(&query), truth, "seed {seed}");
    truth
}
