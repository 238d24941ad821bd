//! The printed A* rows, and the printed node counts of the improved search, hold on the witness maps.

use super::*;
use base::grid::read_text_map;
use std::path::Path;

fn witness(name: &str, ends: [[i32; 2]; 2]) -> (Grid2, [u32; 2]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/maps").join(name);
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

/// The sum of all changes of direction along a path of unit moves.
fn turn_sum_deg(grid: &Grid2, nodes: &[u32]) -> f64 {
    let headings = nodes.windows(2).map(|pair| {
        let ([ax, ay], [bx, by]) = (grid.xy(pair[0]), grid.xy(pair[1]));
        libm::atan2(f64::from(by - ay), f64::from(bx - ax)).to_degrees()
    });
    let headings: Vec<f64> = headings.collect();
    headings.windows(2).map(|pair| (pair[0] - pair[1]).abs()).map(|turn| turn.min(360.0 - turn)).sum()
}

#[test]
fn astar_gives_the_printed_rows_on_the_witness_maps() {
    for ((grid, ends), straight, opened, turn_deg) in [(w1(), 9, 69, 270.0), (w2(), 12, 89, 315.0)] {
        let report = astar(&grid, &Moves::new(&grid, CornerRule::Allow), ends);
        let route = report.outcome.route().unwrap();
        assert_eq!(route.cost, Octile { straight, diagonal: 4 });
        assert_eq!(report.counters.opened, opened);
        assert!((turn_sum_deg(&grid, &route.nodes) - turn_deg).abs() < 1e-9);
    }
}

fn improved(grid: &Grid2, ends: [u32; 2], meeting: Meeting) -> BidirectionalReport<Octile> {
    let reference = euclidean_to(grid, ends[1])(ends[0]);
    let side = |target: u32| Combined { h: euclidean_to(grid, target), combine: falling(reference) };
    let moves = Moves::new(grid, CornerRule::Allow);
    let choice = SideChoice::Alternate;
    let rules = BidirectionalRules {
        meeting,
        end: End::Expansion,
        choice,
        update: Update::default(),
        max_expansions: u64::MAX,
    };
    let mut graph = GridGraph::new(&moves);
    let estimates = [side(ends[1]), side(ends[0])];
    Bidirectional::new(Heap::new(Ties::Fifo)).run(&mut graph, &estimates, &mut [(), ()], ends, rules)
}

#[test]
fn the_improved_search_opens_the_printed_numbers_on_the_witness_maps() {
    // The paths are those that the tests of inflection deletion start from.
    let path1 = [[22, 15], [23, 16], [24, 17], [25, 18], [25, 19], [26, 20], [26, 21], [25, 22], [24, 23]];
    let path1 = [&path1[..], &[[24, 24], [24, 25], [25, 26], [25, 27], [26, 28]]].concat();
    let path2 = [[28, 19], [27, 18], [26, 18], [25, 17], [24, 17], [23, 17], [22, 17], [21, 18], [20, 17]];
    let path2 =
        [&path2[..], &[[19, 17], [18, 16], [17, 16], [16, 17], [15, 16], [14, 17], [13, 16]]].concat();
    for ((grid, ends), meeting, opened, path) in
        [(w1(), Meeting::GeneratedAny, 45, path1), (w2(), Meeting::BothClosed, 46, path2)]
    {
        let report = improved(&grid, ends, meeting);
        assert_eq!(report.sides.iter().map(|side| side.opened).sum::<u64>(), opened);
        let route = report.outcome.route().unwrap();
        assert_eq!(route.nodes.iter().map(|&node| grid.xy(node)).collect::<Vec<_>>(), path);
    }
}
