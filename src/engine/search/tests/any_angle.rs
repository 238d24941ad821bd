//! Theta* and Lazy Theta* against programs with plain lists, and the laws of polylines.

use super::*;
use base::grid::Sight;

/// Theta* or Lazy Theta* as the papers write them, on lists: cost, expansions and lines of sight looked at.
struct Plain<'a, S> {
    on: &'a Sighted<'a, S>,
    when: When,
    /// g and parent of every node that was opened, by node.
    known: std::collections::BTreeMap<u32, (f64, u32)>,
    /// The nodes of OPEN with the f that they were put in with, in the order in which they were first opened.
    order: Vec<u32>,
    open: std::collections::BTreeMap<u32, f64>,
    closed: Vec<u32>,
    looks: u64,
}

impl<S: Fn([i32; 2], [i32; 2]) -> bool> Plain<'_, S> {
    fn apart(&self, a: u32, b: u32) -> f64 {
        let ([ax, ay], [bx, by]) = (self.on.grid.xy(a), self.on.grid.xy(b));
        f64::from((ax - bx).pow(2) + (ay - by).pow(2)).sqrt()
    }

    fn look(&mut self, from: u32, to: u32) -> bool {
        self.looks += 1;
        (self.on.sees)(self.on.grid.xy(from), self.on.grid.xy(to))
    }

    fn set_vertex(&mut self, node: u32) {
        let parent = self.known[&node].1;
        if parent == node || self.look(parent, node) {
            return;
        }
        let near = self.on.moves.from_cell(node).filter(|(near, _)| self.closed.contains(near));
        let ways = near.map(|(near, _)| (self.known[&near].0 + self.apart(near, node), near));
        self.known.insert(node, ways.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap());
    }

    fn update(&mut self, node: u32, to: u32, goal: u32) {
        let (g, parent) = self.known[&node];
        let before = self.known.get(&to).map_or(f64::INFINITY, |known| known.0);
        let straight = self.known[&parent].0 + self.apart(parent, to);
        if straight >= before {
            return;
        }
        let is_taken = parent == node || self.when == When::Taken || self.look(parent, to);
        let (reached, over) = if is_taken { (straight, parent) } else { (g + self.apart(node, to), node) };
        if reached < before {
            self.known.insert(to, (reached, over));
            if !self.order.contains(&to) {
                self.order.push(to);
            }
            self.open.insert(to, reached + self.apart(to, goal));
        }
    }

    fn solve(&mut self, [start, goal]: [u32; 2]) -> Option<f64> {
        self.known.insert(start, (0.0, start));
        self.order.push(start);
        self.open.insert(start, self.apart(start, goal));
        while !self.open.is_empty() {
            let open = self.order.iter().copied().filter(|node| self.open.contains_key(node));
            let node = open.min_by_key(|node| quantised(self.open[node])).unwrap();
            if self.when == When::Taken {
                self.set_vertex(node);
            }
            if node == goal {
                return Some(self.known[&goal].0);
            }
            self.open.remove(&node);
            self.closed.push(node);
            let successors: Vec<u32> = self.on.moves.from_cell(node).map(|(to, _)| to).collect();
            for to in successors {
                if !self.closed.contains(&to) {
                    self.update(node, to, goal);
                }
            }
        }
        None
    }
}

fn sighted(case: &Case) -> Sighted<'_, impl Fn([i32; 2], [i32; 2]) -> bool> {
    // Closed cells see no more than any corner rule lets through.
    let sees =
        |from, to| Sight::ClosedCells.all_cells(from, to, |[x, y]: [i32; 2]| case.grid.is_free_xy(x, y));
    Sighted { grid: &case.grid, moves: &case.moves, sees }
}

fn run(case: &Case, when: When) -> Seen {
    AnyAngle::new(Heap::new(Ties::Fifo)).solve(
        &sighted(case),
        AnyAngleRules::new(when, u64::MAX),
        case.ends,
        &mut (),
    )
}

#[test]
fn both_do_what_programs_with_plain_lists_do() {
    let mut solved = 0;
    let mut bent = 0;
    for (case, when) in cases(250, 0.3).flat_map(|case| {
        let again = Case { grid: case.grid.clone(), moves: case.moves.clone(), ..case };
        [(case, When::Generated), (again, When::Taken)]
    }) {
        let on = sighted(&case);
        let mut plain = Plain {
            on: &on,
            when,
            known: [].into(),
            order: Vec::new(),
            open: [].into(),
            closed: Vec::new(),
            looks: 0,
        };
        let truth = plain.solve(case.ends);
        let got = run(&case, when);
        let cost = got.report.outcome.route().map(|route| route.cost);
        assert_eq!(cost.map(quantised), truth.map(quantised), "seed {}, {when:?}", case.seed);
        assert_eq!(got.report.counters.expansions, plain.closed.len() as u64, "seed {}, {when:?}", case.seed);
        assert_eq!(got.sight_checks, plain.looks, "seed {}, {when:?}", case.seed);
        solved += u32::from(truth.is_some());
        bent += u32::from(got.report.outcome.route().is_some_and(|route| route.nodes.len() > 2));
    }
    assert!(solved > 200 && bent > 60, "{solved} solved, {bent} with a bend");
}

#[test]
fn a_path_is_a_polyline_of_free_segments_and_moves_as_long_as_it_says() {
    let mut shorter = 0;
    for case in cases(300, 0.25) {
        let on = sighted(&case);
        let lattice =
            astar(&case.grid, &case.moves, case.ends).outcome.route().map(|route| route.cost.value());
        for when in [When::Generated, When::Taken] {
            let report = run(&case, when).report;
            let route = report.outcome.route();
            assert_eq!(route.is_some(), lattice.is_some(), "seed {}", case.seed);
            let (Some(route), Some(lattice)) = (route, lattice) else { continue };
            let mut length = 0.0;
            for pair in route.nodes.windows(2) {
                let is_move = case.moves.from_cell(pair[0]).any(|(to, _)| to == pair[1]);
                assert!(
                    is_move || (on.sees)(on.grid.xy(pair[0]), on.grid.xy(pair[1])),
                    "seed {}: {pair:?}",
                    case.seed
                );
                length += euclidean_to(&case.grid, pair[1])(pair[0]);
            }
            assert!((length - route.cost).abs() < 1e-9, "seed {}", case.seed);
            let straight = euclidean_to(&case.grid, case.ends[1])(case.ends[0]);
            assert!(length >= straight - 1e-9, "seed {}", case.seed);
            shorter += u32::from(length < lattice - 1e-9);
        }
    }
    assert!(shorter > 100, "only {shorter} paths are shorter than the lattice allows");
}

#[test]
fn an_empty_map_is_crossed_in_one_line() {
    let grid = Grid2::new(30, 20).unwrap();
    let moves = Moves::new(&grid, CornerRule::ForbidAny);
    let case = Case { seed: 0, rule: CornerRule::ForbidAny, ends: [0, grid.cell_count() - 1], grid, moves };
    for when in [When::Generated, When::Taken] {
        let report = run(&case, when).report;
        let route = report.outcome.route().unwrap();
        assert_eq!(route.nodes, case.ends);
        assert_eq!(route.cost, f64::from(29 * 29 + 19 * 19).sqrt());
    }
}

#[test]
fn a_budget_ends_the_search_before_the_expansion_that_it_does_not_allow() {
    let case = cases(40, 0.2).find(|case| run(case, When::Generated).report.counters.expansions > 4).unwrap();
    let full = run(&case, When::Generated).report.counters.expansions;
    let with = |budget| {
        let mut search = AnyAngle::new(Heap::new(Ties::Fifo));
        let rules = AnyAngleRules::new(When::Generated, budget);
        search.solve(&sighted(&case), rules, case.ends, &mut ()).report
    };
    assert_ne!(with(full).outcome, Outcome::BudgetSpent);
    assert_eq!(
        (with(full - 1).outcome, with(full - 1).counters.expansions),
        (Outcome::BudgetSpent, full - 1)
    );
}

#[test]
fn rules_change_what_they_name() {
    let plain = AnyAngleRules::new(When::Generated, u64::MAX);
    let mut lengths = [0.0; 5];
    let mut expanded = [0; 5];
    for case in cases(150, 0.25) {
        let with = |rules| {
            AnyAngle::new(Heap::new(Ties::SmallerG)).solve(&sighted(&case), rules, case.ends, &mut ())
        };
        let seen = with(plain);
        if seen.report.outcome.route().is_none() {
            continue;
        }
        // The printed procedure looks at one line to each successor that is not closed.
        let printed = with(AnyAngleRules { counts_all: true, ..plain });
        let cases = (printed.sight_checks, printed.report == seen.report);
        assert!(
            cases.1 && (seen.sight_checks..=seen.report.counters.generated).contains(&cases.0),
            "{cases:?}"
        );
        let sixteen = with(AnyAngleRules { branching: Branching::Sixteen, ..plain });
        let four = with(AnyAngleRules { branching: Branching::Four, ..plain });
        let light = AnyAngleRules { weight: 0.5, ..plain };
        let all = [four, seen.clone(), sixteen, with(light), with(AnyAngleRules { reopens: true, ..plain })];
        let routes: Vec<_> = all.iter().map(|seen| seen.report.outcome.route()).collect();
        assert!(routes[1..].iter().all(Option::is_some), "seed {}", case.seed);
        if let Some(four) = routes[0] {
            let costs = [four.cost, routes[1].unwrap().cost, routes[2].unwrap().cost];
            let more = [routes[3].unwrap().cost, routes[4].unwrap().cost];
            for (sum, cost) in lengths.iter_mut().zip(costs.into_iter().chain(more)) {
                *sum += cost;
            }
            for (sum, seen) in expanded.iter_mut().zip(&all) {
                *sum += seen.report.counters.expansions;
            }
        }
    }
    assert!(lengths[0] > lengths[1] + 1.0 && lengths[1] > lengths[2] && lengths[2] > 500.0, "{lengths:?}");
    assert!(lengths[1] > lengths[3] && lengths[1] > lengths[4], "{lengths:?}");
    assert!(expanded[1] < expanded[3] && expanded[1] < expanded[4], "{expanded:?}");
}
