//! The exchangeable parts: updates, stop rules, shots, budgets, observers, graphs that grow.

use super::*;
use std::collections::BTreeMap;

/// A directed graph written out.
struct Written(BTreeMap<u32, Vec<(u32, f64)>>);

impl Written {
    fn new(edges: &[(u32, u32, f64)]) -> Self {
        let mut graph = BTreeMap::new();
        for &(from, to, cost) in edges {
            graph.entry(from).or_insert_with(Vec::new).push((to, cost));
        }
        Self(graph)
    }
}

impl Graph for Written {
    type Cost = f64;

    fn node_count(&self) -> usize {
        0
    }

    fn successors(&mut self, node: u32, mut visit: impl FnMut(u32, f64)) {
        for &(to, cost) in self.0.get(&node).into_iter().flatten() {
            visit(to, cost);
        }
    }
}

fn run(graph: &mut Written, h: impl Fn(u32) -> f64, goal: u32, update: Update, rules: Rules) -> Report<f64> {
    let estimate = Combined { h, combine: sum };
    let terms = SideInputs { graph, estimate: &estimate, observer: &mut (), update };
    Search::new(Heap::default()).run(terms, 0, |node| node == goal, rules, &mut ())
}

fn nodes(report: &Report<f64>) -> &[u32] {
    &report.outcome.route().expect("the graph is connected").nodes
}

#[test]
fn an_open_node_takes_a_better_way_only_if_it_may() {
    // 3 is opened from 0 at cost 5, then offered from 1 at cost 2.
    let mut graph = Written::new(&[(0, 3, 5.0), (0, 1, 1.0), (1, 3, 1.0), (3, 4, 1.0)]);
    let never = Update { lower_open: false, ..Update::default() };
    assert_eq!(nodes(&run(&mut graph, |_| 0.0, 4, Update::default(), Rules::default())), [0, 1, 3, 4]);
    assert_eq!(nodes(&run(&mut graph, |_| 0.0, 4, never, Rules::default())), [0, 3, 4]);
}

#[test]
fn of_equally_long_ways_to_an_open_node_the_last_is_taken_only_if_it_may_be() {
    let mut graph = Written::new(&[(0, 1, 1.0), (0, 2, 1.0), (1, 3, 1.0), (2, 3, 1.0), (3, 4, 1.0)]);
    let last = Update { take_equal: true, ..Update::default() };
    let never = Update { lower_open: false, ..last };
    for (update, path) in [(Update::default(), [0, 1, 3, 4]), (last, [0, 2, 3, 4]), (never, [0, 1, 3, 4])] {
        assert_eq!(nodes(&run(&mut graph, |_| 0.0, 4, update, Rules::default())), path, "{update:?}");
    }
}

#[test]
fn a_closed_node_reopens_only_if_it_may() {
    // Admissible but inconsistent: 1 looks far, so 2 is closed by its dear way before 1 is.
    let mut graph = Written::new(&[(0, 1, 1.0), (0, 2, 3.0), (1, 2, 1.0), (2, 3, 5.0)]);
    let h = |node: u32| [0.0, 5.5, 0.0, 0.0][node as usize];
    let reopen = Update { reopen_closed: true, ..Update::default() };
    let kept = run(&mut graph, h, 3, Update::default(), Rules::default());
    assert_eq!((nodes(&kept), kept.counters.expansions, kept.counters.closed), (&[0, 2, 3][..], 3, 3));
    let reopened = run(&mut graph, h, 3, reopen, Rules::default());
    assert_eq!((nodes(&reopened), reopened.counters.expansions), (&[0, 1, 2, 3][..], 4));
    assert_eq!((reopened.counters.closed, reopened.counters.opened), (3, 4));
}

#[test]
fn a_goal_may_be_taken_when_generated() {
    let mut graph = Written::new(&[(0, 1, 1.0), (0, 9, 5.0), (0, 2, 1.0), (1, 9, 1.0)]);
    let generated = Rules { stop: Stop::GoalGenerated, ..Rules::default() };
    let report = run(&mut graph, |_| 0.0, 9, Update::default(), generated);
    assert_eq!((nodes(&report), report.counters.expansions), (&[0, 9][..], 1));
    assert_eq!((report.counters.opened, report.counters.generated), (4, 3), "the expansion is finished");
    let report = run(&mut graph, |_| 0.0, 0, Update::default(), generated);
    assert_eq!((nodes(&report), report.counters.expansions), (&[0][..], 0));
    assert_eq!(nodes(&run(&mut graph, |_| 0.0, 9, Update::default(), Rules::default())), [0, 1, 9]);
}

#[test]
fn a_budget_is_never_exceeded_and_a_popped_goal_needs_none() {
    let edges: Vec<(u32, u32, f64)> = (0..10).map(|node| (node, node + 1, 1.0)).collect();
    let mut graph = Written::new(&edges);
    for max_expansions in 0..=11 {
        let rules = Rules { max_expansions, ..Rules::default() };
        let report = run(&mut graph, |_| 0.0, 10, Update::default(), rules);
        assert_eq!(report.outcome.route().is_some(), max_expansions >= 10);
        assert_eq!(report.counters.expansions, max_expansions.min(10));
        assert_eq!(report.outcome == Outcome::BudgetSpent, max_expansions < 10);
    }
}

#[test]
fn a_shot_ends_the_search_with_the_way_so_far_and_the_goal() {
    let mut graph = Written::new(&[(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0)]);
    let estimate = Combined { h: |_| 0.0, combine: sum };
    let mut tried = Vec::new();
    let mut shoot = |node: u32, g: f64| {
        tried.push((node, g));
        (node == 1).then_some(Shot { goal: 7, cost: 2.5 })
    };
    let mut search = Search::new(Heap::default());
    let report =
        search.run(terms(&mut graph, &estimate, &mut ()), 0, |node| node == 7, Rules::default(), &mut shoot);
    assert_eq!(report.outcome, Outcome::Solved(Route { nodes: vec![0, 1, 7], cost: 3.5 }));
    assert_eq!(tried, [(0, 0.0), (1, 1.0)]);
    let counters = Counters { opened: 2, closed: 2, expansions: 1, generated: 1, peak_open: 1 };
    assert_eq!(report.counters, counters);
}

/// A* that keeps OPEN and CLOSED as plain lists and counts what it compares.
fn list_astar(case: &Case) -> (ListScans, VisitOrder, u64) {
    let h = euclidean_to(&case.grid, case.ends[1]);
    let f = |node, g: Octile| quantised(g.value() + h(node));
    let mut open = vec![(case.ends[0], Octile::ZERO)];
    let mut closed = Vec::new();
    let mut scans = ListScans::default();
    let mut peak = 1;
    let mut opened = vec![case.ends[0]];
    while !open.is_empty() {
        // `min_by_key` gives the first of equals, and nodes stand in the order in which they were opened.
        let (best, &(node, g)) =
            open.iter().enumerate().min_by_key(|(_, entry)| f(entry.0, entry.1)).unwrap();
        if node == case.ends[1] {
            break;
        }
        scans.minimum_comparisons += open.len() as u64;
        open.remove(best);
        closed.push(node);
        for (to, diagonal) in case.moves.from_cell(node) {
            scans.membership_comparisons += closed.len() as u64;
            if closed.contains(&to) {
                continue;
            }
            scans.membership_comparisons += open.len() as u64;
            let reached = g.plus(if diagonal { Octile::DIAGONAL } else { Octile::STRAIGHT });
            match open.iter_mut().find(|(known, _)| *known == to) {
                Some((_, known)) if reached.compare(*known).is_lt() => *known = reached,
                Some(_) => {}
                None => {
                    open.push((to, reached));
                    opened.push(to);
                }
            }
        }
        peak = peak.max(open.len() as u64);
    }
    (scans, VisitOrder { opened, closed }, peak)
}

#[test]
fn observers_and_counters_see_what_a_program_with_plain_lists_does() {
    let mut expansions = 0;
    for case in cases(150, 0.3) {
        let estimate = Combined { h: euclidean_to(&case.grid, case.ends[1]), combine: sum };
        let mut observer = (ListScans::default(), VisitOrder::default());
        let mut search = Search::new(Heap::new(Ties::Fifo));
        let graph = &mut GridGraph::new(&case.moves);
        let terms =
            SideInputs { graph, estimate: &estimate, observer: &mut observer, update: Update::default() };
        let goal = case.ends[1];
        let report = search.run(terms, case.ends[0], |node| node == goal, Rules::default(), &mut ());
        let (scans, trace, peak_open) = list_astar(&case);
        assert_eq!(observer.0, scans, "seed {}", case.seed);
        assert_eq!(observer.1, trace, "seed {}", case.seed);
        assert_eq!(search.opened(), trace.opened, "seed {}", case.seed);
        let made = trace.closed.len() as u64;
        let generated = trace.closed.iter().map(|&cell| case.moves.from_cell(cell).count() as u64).sum();
        let opened = trace.opened.len() as u64;
        let counters = Counters { opened, closed: made, expansions: made, generated, peak_open };
        assert_eq!(report.counters, counters, "seed {}", case.seed);
        expansions += made;
    }
    assert!(expansions > 3_000, "only {expansions} expansions compared");
}

#[test]
fn a_search_leaves_nothing_behind_for_the_next() {
    let mut search = Search::new(Heap::default());
    for case in cases(40, 0.3) {
        let estimate = Combined { h: euclidean_to(&case.grid, case.ends[1]), combine: sum };
        let used = solve(&mut search, &mut GridGraph::new(&case.moves), &estimate, case.ends);
        assert_eq!(used, astar(&case.grid, &case.moves, case.ends), "seed {}", case.seed);
    }
}

#[test]
fn an_offer_that_was_replaced_no_longer_counts_even_if_it_comes_first() {
    // f falls with g: when 3 is lowered from g = 5 to 2, its f rises from 105 to 108, past that of 4.
    let mut graph = Written::new(&[(0, 3, 5.0), (0, 1, 1.0), (0, 4, 1.0), (1, 3, 1.0)]);
    let h = |node: u32| [0.0, 0.0, 0.0, 10.0, 8.0][node as usize];
    let estimate = Combined { h, combine: |g, h| 100.0 + h - g };
    let mut observer = VisitOrder::default();
    let update = Update::default();
    let terms = SideInputs { graph: &mut graph, estimate: &estimate, observer: &mut observer, update };
    Search::new(Heap::default()).run(terms, 0, |_| false, Rules::default(), &mut ());
    assert_eq!(observer.closed, [0, 1, 4, 3]);
}
