//! Acceptance: the two maps found for the zhang study, and laws that hold the drivers to each other.

use super::*;
use crate::grid::{CornerRule, DIRECTIONS, Grid2, Moves, Offsets, independent_cells, read_text_map};
use crate::seed;
use std::path::Path;

const RULES: [CornerRule; 3] = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];

fn terms<'a, G, E>(graph: &'a mut G, estimate: &'a E, observer: &'a mut ()) -> Terms<'a, G, E, ()> {
    Terms { graph, estimate, observer, update: Update::default() }
}

/// A* with the Euclidean distance and first-opened ties.
fn astar(grid: &Grid2, moves: &Moves, [start, goal]: [u32; 2]) -> Report<Octile> {
    let estimate = Combined { h: euclidean_to(grid, goal), combine: sum };
    let mut search = Search::new(Heap::new(Ties::Fifo));
    let (mut graph, is_goal) = (GridGraph::new(moves), |node| node == goal);
    search.run(terms(&mut graph, &estimate, &mut ()), start, is_goal, Rules::default(), &mut ())
}

fn witness(name: &str, ends: [[i32; 2]; 2]) -> (Grid2, [u32; 2]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/maps").join(name);
    let grid = read_text_map(&path).unwrap();
    let ends = ends.map(|[x, y]| grid.cell(x, y).unwrap());
    assert!(ends.iter().all(|&cell| grid.is_free(cell)));
    (grid, ends)
}

fn w1() -> (Grid2, [u32; 2]) {
    witness("zhang_w1.map.txt", [[22, 15], [26, 28]])
}

fn w2() -> (Grid2, [u32; 2]) {
    witness("zhang_w2.map.txt", [[28, 19], [13, 16]])
}

/// How often the direction changes along a path of unit moves; each change in the maps below is by 45°.
fn bend_angles_deg(grid: &Grid2, nodes: &[u32]) -> f64 {
    let steps: Vec<[i32; 2]> = nodes
        .windows(2)
        .map(|pair| {
            let ([ax, ay], [bx, by]) = (grid.xy(pair[0]), grid.xy(pair[1]));
            [bx - ax, by - ay]
        })
        .collect();
    let angle = |[x, y]: [i32; 2]| libm::atan2(f64::from(y), f64::from(x)).to_degrees();
    steps.windows(2).map(|pair| (angle(pair[0]) - angle(pair[1])).abs()).map(|turn| turn.min(360.0 - turn)).sum()
}

#[test]
fn astar_gives_the_printed_rows_on_the_witness_maps() {
    for ((grid, ends), straight, opened, turn_deg) in [(w1(), 9, 69, 270.0), (w2(), 12, 89, 315.0)] {
        let report = astar(&grid, &Moves::new(&grid, CornerRule::Allow), ends);
        let route = report.outcome.route().unwrap();
        assert_eq!(route.cost, Octile { straight, diagonal: 4 });
        assert_eq!(report.counters.opened, opened);
        assert!((bend_angles_deg(&grid, &route.nodes) - turn_deg).abs() < 1e-9);
    }
}

fn improved(grid: &Grid2, ends: [u32; 2], meeting: Meeting) -> BidirectionalReport<Octile> {
    let reference = euclidean_to(grid, ends[1])(ends[0]);
    let side = |target: u32| Combined { h: euclidean_to(grid, target), combine: falling(reference) };
    let moves = Moves::new(grid, CornerRule::Allow);
    let rules = BidirectionalRules {
        meeting,
        choice: SideChoice::Alternate,
        update: Update::default(),
        max_expansions: u64::MAX,
    };
    Bidirectional::new(Heap::new(Ties::Fifo)).run(
        &mut GridGraph::new(&moves),
        &[side(ends[1]), side(ends[0])],
        &mut [(), ()],
        ends,
        rules,
    )
}

fn named(grid: &Grid2, nodes: &[u32]) -> Vec<[i32; 2]> {
    nodes.iter().map(|&node| grid.xy(node)).collect()
}

#[test]
fn the_improved_search_opens_the_printed_numbers_on_the_witness_maps() {
    for ((grid, ends), meeting, opened) in [(w1(), Meeting::GeneratedAny, 45), (w2(), Meeting::BothClosed, 46)] {
        let report = improved(&grid, ends, meeting);
        assert_eq!(report.sides.iter().map(|side| side.opened).sum::<u64>(), opened);
        println!("{:?} {:?}", named(&grid, &report.outcome.route().unwrap().nodes), report);
    }
}
