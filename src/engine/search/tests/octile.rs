//! The specialisation is the general form.

use super::*;
use base::grid::rectangles;

#[test]
fn the_specialised_search_costs_and_counts_what_the_general_one_does() {
    let mut solved = 0;
    let mut count = 0;
    for case in cases(400, 0.35) {
        let mut fast = OctileAstar::new(&case.moves).unwrap();
        let mut general = Search::new(Buckets::default());
        let mut stream = seed::stream(case.seed);
        // Several queries each, so that what one leaves behind could mislead the next.
        for _ in 0..6 {
            let ends = [0, 1].map(|_| stream.random_range(0..case.grid.cell_count()));
            let case = Case { ends, grid: case.grid.clone(), moves: case.moves.clone(), ..case };
            if !ends.iter().all(|&cell| case.grid.is_free(cell)) {
                continue;
            }
            let estimate = ScaledOctile::new(case.grid.width(), Some(ends[1]));
            let truth = solve(&mut general, &mut GridGraph::new(&case.moves), &estimate, ends);
            let got = fast.solve(ends[0], ends[1], u64::MAX);
            assert_eq!(got.counters, truth.counters, "seed {}, {ends:?}", case.seed);
            let cost = |report: &Report<Octile>| report.outcome.route().map(|route| walked(&case, route));
            assert_eq!(cost(&got), cost(&truth), "seed {}, {ends:?}", case.seed);
            let exact = astar(&case.grid, &case.moves, ends).outcome.route().map(|route| route.cost);
            assert_eq!(got.outcome.route().map(|route| route.cost), exact, "seed {}, {ends:?}", case.seed);
            (solved, count) = (solved + u32::from(exact.is_some()), count + 1);
        }
    }
    assert!((count / 4..count).contains(&solved), "one-sided sample: {solved} of {count} solvable");
}

#[test]
fn long_queries_in_numbers_that_lower_the_base_past_zero_stay_right() {
    let grid = rectangles(&mut seed::stream(9), [257, 200], 150, [5, 25], &[]).unwrap();
    let moves = Moves::new(&grid, CornerRule::ForbidAny);
    let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
    let mut fast = OctileAstar::new(&moves).unwrap();
    let mut general = Search::new(Buckets::default());
    let mut stream = seed::stream(10);
    let mut solved = 0;
    // 257 · 200 · 1393 fits 59 times into 32 bits.
    for query in 0..130 {
        let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
        let estimate = ScaledOctile::new(grid.width(), Some(ends[1]));
        let truth = solve(&mut general, &mut GridGraph::new(&moves), &estimate, ends);
        let got = fast.solve(ends[0], ends[1], u64::MAX);
        assert_eq!(got.counters, truth.counters, "query {query}");
        let cost = |report: &Report<Octile>| report.outcome.route().map(|route| route.cost);
        assert_eq!(cost(&got), cost(&truth), "query {query}");
        solved += u32::from(cost(&got).is_some());
    }
    assert!(solved > 65, "only {solved} queries had a path");
}

#[test]
fn a_budget_ends_it_where_it_ends_the_general_form() {
    let grid = Grid2::new(20, 10).unwrap();
    let ends = [0, grid.cell_count() - 1];
    let mut fast = OctileAstar::new(&Moves::new(&grid, CornerRule::Allow)).unwrap();
    let full = fast.solve(ends[0], ends[1], u64::MAX).counters.expansions;
    assert!(full > 3);
    assert!(fast.solve(ends[0], ends[1], full).outcome.route().is_some());
    let spent = fast.solve(ends[0], ends[1], full - 1);
    assert_eq!((spent.outcome, spent.counters.expansions), (Outcome::BudgetSpent, full - 1));
}

#[test]
fn a_grid_whose_costs_could_overflow_is_refused() {
    let moves = Moves::new(&Grid2::new(1_100, 1_600).unwrap(), CornerRule::Allow);
    let message = |height, cells| {
        format!(
            "a grid of 1100 × {height} cells, {cells} with what surrounds them; up to 3083250 are accepted"
        )
    };
    assert_eq!(OctileAstar::new(&moves).unwrap_err().to_string(), message(1_600, 3_282_945));
}
