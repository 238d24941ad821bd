use super::*;
use base::grid::{CornerRule, Grid2, Sight, independent_cells};
use base::seed;
use verify::lattice::Case;

/// Length of the shortest path from `start` to `goal` whose segments are seen by `sight`, by Dijkstra over all pairs.
fn shortest_free(grid: &Grid2, start: Cell, goal: Cell, sight: Sight) -> f64 {
    let cells: Vec<Cell> = (0..grid.cell_count()).filter(|c| grid.is_free(*c)).map(|c| grid.xy(c)).collect();
    let mut known: Vec<(f64, bool)> =
        cells.iter().map(|c| (if *c == start { 0.0 } else { f64::INFINITY }, false)).collect();
    loop {
        let open = (0..cells.len()).filter(|i| !known[*i].1);
        let Some(at) = open.min_by(|a, b| known[*a].0.total_cmp(&known[*b].0)) else { return f64::INFINITY };
        if cells[at] == goal || known[at].0.is_infinite() {
            return known[at].0;
        }
        known[at].1 = true;
        for to in 0..cells.len() {
            if sight.all_cells(cells[at], cells[to], |[x, y]| grid.is_free_xy(x, y)) {
                known[to].0 = known[to].0.min(known[at].0 + distance(cells[at], cells[to]));
            }
        }
    }
}

fn moves_of(cost: f64) -> Octile {
    let pairs = (0..40).flat_map(|diagonal| (0..40).map(move |straight| Octile { straight, diagonal }));
    pairs.into_iter().find(|moves| (moves.length() - cost).abs() < 1e-9).unwrap()
}

#[test]
fn no_free_path_on_any_drawn_map_is_shorter_than_its_bound() {
    let ([start, goal], size) = ([[0, 1], [5, 3]], [6, 5]);
    let (mut detours, mut close) = (0, 0);
    let mut bounds: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    for seed in 0..1500 {
        let grid = independent_cells(&mut seed::stream(seed), [6, 5], 0.4, &[6, 23]).unwrap();
        for (corner_rule, sight) in [
            (CornerRule::Allow, Sight::ExactInterior),
            (CornerRule::Allow, Sight::Bresenham),
            (CornerRule::Allow, Sight::ClosedCells),
        ] {
            let ends = [start, goal].map(|cell| cell.map(f64::from).to_vec());
            let case = Case { grid: &grid, corner_rule, start: &ends[0], goal: &ends[1] };
            let Some(cost) = case.optimal_cost() else { continue };
            let moves = moves_of(cost);
            let key = (moves.straight, moves.diagonal);
            let bound =
                *bounds.entry(key).or_insert_with(|| shortest_seen(size, [start, goal], moves).length);
            let truth = shortest_free(&grid, start, goal, sight);
            assert!(truth >= bound - 1e-9, "seed {seed}: {truth} below {bound} at C* = {cost} by {sight:?}");
            detours += usize::from(bound > distance(start, goal) + 1e-9);
            close += usize::from(bound > distance(start, goal) + 1e-9 && truth < bound + 1e-9);
        }
    }
    assert!(
        detours > 300 && close > 0,
        "weak sample: {detours} detours, {close} of them as short as the bound"
    );
}

#[test]
fn the_grid_papers_complex_path_is_longer_than_printed() {
    let ends = [[28, 19], [13, 16]];
    let found = shortest_seen([30, 30], ends, Octile { straight: 12, diagonal: 4 });
    assert!((found.length - 16.524).abs() < 5e-4, "{found:?}");
    let length: f64 = found.cells.windows(2).map(|w| distance(w[0], w[1])).sum();
    assert!((found.length - length).abs() < 1e-12);
    let moves = found.cells.windows(2).map(|w| octile_distance([w[1][0] - w[0][0], w[1][1] - w[0][1]]));
    let sum: f64 = moves.map(Octile::length).sum();
    assert!(sum >= 12.0 + 4.0 * std::f64::consts::SQRT_2 - 1e-9, "{found:?}");
    let free = shortest_seen([30, 30], ends, octile_distance([-15, -3]));
    assert!(
        (free.length - distance(ends[0], ends[1])).abs() < 1e-9,
        "an unobstructed optimum allows the straight line"
    );
}
