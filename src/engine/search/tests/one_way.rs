//! The one-way driver against independent truth.

use super::*;
use base::grid::Offsets;

#[test]
fn astar_costs_what_relaxation_costs_under_every_rule_heuristic_and_tie_order() {
    let mut solved = 0;
    let mut longer = 0;
    let mut count = 0;
    for case in cases(300, 0.35) {
        let [start, goal] = case.ends;
        let truth = relaxed_costs(&case.grid, case.rule, start)[goal as usize];
        let dijkstra = Combined { h: |_| 0.0, combine: sum };
        let mut search = Search::new(Heap::default());
        let blind = solve(&mut search, &mut GridGraph::new(&case.moves), &dijkstra, case.ends);
        for ties in [Ties::Fifo, Ties::Lifo, Ties::LargerG] {
            let h: [&dyn Fn(u32) -> f64; 3] =
                [&|_| 0.0, &euclidean_to(&case.grid, goal), &octile_to(&case.grid, goal)];
            for h in h {
                let mut search = Search::new(Heap::new(ties));
                let graph = &mut GridGraph::new(&case.moves);
                let report = solve(&mut search, graph, &Combined { h, combine: sum }, case.ends);
                let cost = report.outcome.route().map_or(f64::INFINITY, |route| walked(&case, route));
                let place = format!("seed {}, {:?}, {ties:?}", case.seed, case.rule);
                assert!(cost == truth || (cost - truth).abs() < 1e-9, "{place}: {cost} against {truth}");
                assert!(report.counters.expansions <= blind.counters.expansions + 9, "{place}");
            }
        }
        count += 1;
        solved += u32::from(truth.is_finite());
        longer += u32::from(truth.is_finite() && truth > octile_to(&case.grid, goal)(start) + 0.1);
    }
    assert!((count / 4..count).contains(&solved), "one-sided sample: {solved} of {count} solvable");
    assert!(longer > 40, "only {longer} detours");
}

#[test]
fn without_a_goal_every_reachable_cost_is_exact() {
    let mut search = Search::new(Buckets::default());
    for case in cases(60, 0.3) {
        let truth = relaxed_costs(&case.grid, case.rule, case.ends[0]);
        let estimate = ScaledOctile::new(case.grid.width(), None);
        let graph = &mut GridGraph::new(&case.moves);
        let rules = Rules::default();
        let report = search.run(terms(graph, &estimate, &mut ()), case.ends[0], |_| false, rules, &mut ());
        assert_eq!(report.outcome, Outcome::NoPath);
        for (cell, &truth) in (0..).zip(&truth) {
            let got = search.g(cell).map_or(f64::INFINITY, Cost::value);
            assert!(got == truth || (got - truth).abs() < 1e-9, "seed {}: cell {cell}", case.seed);
            assert_eq!(search.path_to(cell).len() > 1, got > 0.0 && got.is_finite());
        }
        let reached = truth.iter().filter(|cost| cost.is_finite()).count() as u64;
        assert_eq!([report.counters.opened, report.counters.closed], [reached; 2]);
    }
}

#[test]
fn wide_neighbourhoods_give_the_lengths_of_their_own_shortest_paths() {
    let mut shorter = 0;
    for case in cases(20, 0.3) {
        let mut before = vec![f64::INFINITY; case.grid.cell_count() as usize];
        for offsets in [Offsets::square(1), Offsets::square(2), Offsets::square(3)] {
            let mut graph = LatticeGraph::new(&case.grid, &offsets, 0.5, |_, _| true);
            let mut search = Search::new(Heap::default());
            let estimate = Combined { h: |_| 0.0, combine: sum };
            let start = case.ends[0];
            let rules = Rules::default();
            search.run(terms(&mut graph, &estimate, &mut ()), start, |_| false, rules, &mut ());
            // The costs are a fixed point: every hop is priced, none improves, and each cost is attained.
            for cell in (0..case.grid.cell_count()).filter(|&cell| search.g(cell).is_some()) {
                let at = search.g(cell).unwrap();
                let mut cheapest = if cell == start { 0.0 } else { f64::INFINITY };
                let [x, y] = case.grid.xy(cell);
                for &[dx, dy] in offsets.steps() {
                    if case.grid.is_free_xy(x + dx, y + dy) {
                        let from = case.grid.cell(x + dx, y + dy).unwrap();
                        let length = 0.5 * libm::hypot(f64::from(dx), f64::from(dy));
                        cheapest = cheapest.min(search.g(from).unwrap() + length);
                    }
                }
                assert!((at - cheapest).abs() < 1e-9, "seed {}: cell {cell}: {at}, {cheapest}", case.seed);
                shorter += u32::from(at < before[cell as usize] - 1e-9 && before[cell as usize].is_finite());
                before[cell as usize] = before[cell as usize].min(at);
            }
        }
    }
    assert!(shorter > 500, "wider neighbourhoods shortened only {shorter} ways");
}

#[test]
fn a_hop_that_is_refused_is_not_taken() {
    let grid = base::grid::parse_text_map(".....\n").unwrap();
    let mut graph = LatticeGraph::new(&grid, &Offsets::square(2), 1.0, |from, by| (from, by) != (1, [1, 0]));
    let estimate = Combined { h: |_| 0.0, combine: sum };
    let report = solve(&mut Search::new(Heap::default()), &mut graph, &estimate, [1, 2]);
    let route = report.outcome.route().unwrap();
    assert_eq!((route.cost, route.nodes.len()), (3.0, 3), "{route:?}");
}

#[test]
fn a_weight_of_w_costs_at_most_w_times_the_optimum() {
    let mut worse = 0;
    let mut fewer = 0;
    for case in cases(200, 0.3) {
        let optimal = astar(&case.grid, &case.moves, case.ends);
        let estimate = Combined { h: euclidean_to(&case.grid, case.ends[1]), combine: weighted(3.0) };
        let graph = &mut GridGraph::new(&case.moves);
        let report = solve(&mut Search::new(Heap::default()), graph, &estimate, case.ends);
        assert_eq!(report.outcome.route().is_some(), optimal.outcome.route().is_some(), "seed {}", case.seed);
        if let (Some(got), Some(best)) = (report.outcome.route(), optimal.outcome.route()) {
            let got = walked(&case, got);
            let best = best.cost.value();
            assert!(best - 1e-9 <= got && got <= 3.0 * best, "seed {}: {got} for {best}", case.seed);
            worse += u32::from(got > best + 1e-9);
            fewer += u32::from(report.counters.expansions < optimal.counters.expansions);
        }
    }
    assert!(worse > 5 && fewer > 50, "weights changed little: {worse} longer, {fewer} quicker");
}
