//! Searches by jump points cost what the fast A* costs, whichever way they follow their runs.

use super::*;
use base::grid::{GridError, bars, maze, read_movingai_map, read_scenarios, rectangles, rooms, streets};
use base::seed::Stream;
use std::path::Path;
use world::space::LatticeWorld;

/// A world with every search over it.
struct Searched {
    world: LatticeWorld,
    oracle: OctileAstar,
    jumps: JumpSearch,
}

impl Searched {
    fn new(grid: Grid2, rule: CornerRule) -> Self {
        let world = LatticeWorld::new(grid, rule);
        let oracle = OctileAstar::new(world.moves()).unwrap();
        let jumps = JumpSearch::new([world.grid().width(), world.grid().height()]).unwrap();
        Self { world, oracle, jumps }
    }

    /// Asserts that all agree on a query, and returns what the search by jump points reports.
    fn agreed(&mut self, [start, goal]: [u32; 2], what: &str) -> Report<Octile> {
        let world = &self.world;
        let truth = self.oracle.solve(start, goal, u64::MAX);
        let scanned = self.jumps.solve(world.jump_lines(), start, goal, u64::MAX);
        let looked_up = self.jumps.solve(world.jump_table(), start, goal, u64::MAX);
        let what = format!("{what}, {:?}, {start} to {goal}", world.corner_rule());
        assert_eq!(scanned, looked_up, "{what}: scanned and looked up");
        let cost = |report: &Report<Octile>| report.outcome.route().map(|route| route.cost);
        assert_eq!(cost(&scanned), cost(&truth), "{what}");
        if let Some(route) = scanned.outcome.route() {
            check_steps(world.moves(), route, [start, goal], &what);
        }
        scanned
    }
}

/// Asserts that `route` walks legal moves between the ends and costs what they cost.
fn check_steps(moves: &Moves, route: &Route<Octile>, ends: [u32; 2], what: &str) {
    assert_eq!([route.nodes[0], route.nodes[route.nodes.len() - 1]], ends, "{what}");
    let mut cost = Octile::ZERO;
    for pair in route.nodes.windows(2) {
        let step = moves.from_cell(pair[0]).find(|&(to, _)| to == pair[1]);
        let (_, diagonal) = step.unwrap_or_else(|| panic!("{what}: {pair:?} is no move"));
        cost = cost.plus(if diagonal { Octile::DIAGONAL } else { Octile::STRAIGHT });
    }
    assert_eq!(cost, route.cost, "{what}");
}

/// A map of one of eleven kinds.
fn drawn(stream: &mut Stream, kind: u64) -> Result<Grid2, GridError> {
    // Lines of fewer than 62 cells, of 62 and of more take one word of bits, a full one and several.
    let most = [6, 30, 70, 140][stream.random_range(0..4)];
    let size = [0, 1].map(|_| stream.random_range(1..=most));
    let count = size[0] * size[1] / 40 + 1;
    match kind {
        0..6 => independent_cells(stream, size, [0.0, 0.03, 0.1, 0.2, 0.35, 0.5][kind as usize], &[]),
        6 => rectangles(stream, size, count / 4 + 1, [1, 12], &[]),
        7 => bars(stream, size, count, [2, 15], &[]),
        8 => rooms(stream, size, 3 + size[0] % 7, 0.8),
        9 => streets(stream, size, [2, 9], 2, 1),
        _ => maze(stream, size),
    }
}

#[test]
fn a_hundred_thousand_queries_cost_what_the_fast_astar_finds() {
    let [mut solved, mut unsolved, mut standing, mut again] = [0_u32; 4];
    for seed in 0..1_100 {
        let mut stream = seed::stream(seed);
        let grid = drawn(&mut stream, seed % 11).unwrap();
        let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
        if free.is_empty() {
            continue;
        }
        let mut searched = Searched::new(grid, RULES[seed as usize / 11 % 3]);
        for _ in 0..100 {
            let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
            let report = searched.agreed(ends, &format!("seed {seed}"));
            let is_solved = u32::from(report.outcome.route().is_some());
            (solved, unsolved) = (solved + is_solved, unsolved + 1 - is_solved);
            standing += u32::from(ends[0] == ends[1]);
            again += u32::from(report.counters.expansions > report.counters.closed);
        }
    }
    assert!(solved + unsolved > 100_000, "{solved} solved, {unsolved} unsolved");
    assert!(unsolved > 10_000 && standing > 500, "{unsolved} unsolved, {standing} that start at the goal");
    assert!(again > 0, "no node was expanded twice");
}

#[test]
fn the_lengths_that_a_scenario_file_prints_are_those_found() {
    let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/maps");
    let grid = read_movingai_map(&maps.join("movingai_sample.map")).unwrap();
    let queries = read_scenarios(&maps.join("movingai_sample.scen"), &grid).unwrap();
    assert!(queries.len() > 50, "{} queries", queries.len());
    let mut searched = Searched::new(grid, CornerRule::ForbidAny);
    for query in queries {
        let report = searched.agreed([query.start, query.goal], &format!("line {}", query.line));
        let length = report.outcome.route().unwrap().cost.value();
        assert!((length - query.optimal_length_cells.unwrap()).abs() < 1e-4, "line {}: {length}", query.line);
    }
}

#[test]
fn far_fewer_nodes_are_opened_than_cells_where_rooms_are_wide() {
    let grid = rooms(&mut seed::stream(11), [200, 200], 24, 0.9).unwrap();
    let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
    let mut searched = Searched::new(grid, CornerRule::ForbidAny);
    let mut stream = seed::stream(12);
    let mut jumped = 0;
    let mut walked = 0;
    for _ in 0..50 {
        let ends = [0, 1].map(|_| free[stream.random_range(0..free.len())]);
        jumped += searched.agreed(ends, "rooms").counters.opened;
        walked += searched.oracle.solve(ends[0], ends[1], u64::MAX).counters.opened;
    }
    assert!(jumped * 20 < walked, "{jumped} jump points and {walked} cells opened");
}

#[test]
fn a_budget_ends_it_after_as_many_expansions() {
    let grid = independent_cells(&mut seed::stream(13), [60, 40], 0.2, &[0, 2_399]).unwrap();
    let mut searched = Searched::new(grid, CornerRule::ForbidAny);
    let full = searched.agreed([0, 2_399], "the whole way").counters.expansions;
    assert!(full > 30, "{full} expansions");
    for budget in [0, 1, full / 2, full - 1] {
        let spent = searched.jumps.solve(searched.world.jump_lines(), 0, 2_399, budget);
        assert_eq!((spent.outcome, spent.counters.expansions), (Outcome::BudgetSpent, budget));
    }
    let enough = searched.jumps.solve(searched.world.jump_table(), 0, 2_399, full);
    assert!(enough.outcome.route().is_some());
}

#[test]
fn a_hop_longer_than_the_table_can_hold_is_made_in_several() {
    let mut searched = Searched::new(Grid2::new(40_000, 3).unwrap(), CornerRule::ForbidAny);
    let (start, goal) = (0, 3 * 40_000 - 1);
    let truth = Octile { straight: 39_997, diagonal: 2 };
    for ends in [[start, goal], [goal, start]] {
        let reports = [
            searched.jumps.solve(searched.world.jump_lines(), ends[0], ends[1], u64::MAX),
            searched.jumps.solve(searched.world.jump_table(), ends[0], ends[1], u64::MAX),
        ];
        for report in reports {
            let route = report.outcome.route().unwrap();
            assert_eq!(route.cost, truth);
            check_steps(searched.world.moves(), route, ends, "a long corridor");
        }
    }
}

#[test]
fn a_grid_whose_costs_could_overflow_is_refused() {
    let error = JumpSearch::new([1_100, 2_801]).unwrap_err().to_string();
    let message = "a grid of 1100 × 2801 cells, 3085002 with what surrounds them; up to 3083250 are accepted";
    assert_eq!(error, message);
    assert!(JumpSearch::new([1_100, 2_799]).is_ok());
}
