use super::*;

/// Grids that are alike but for a few cells each, under all corner rules.
fn grids_of(size_cells: [u32; 2], count: usize) -> Vec<Moves> {
    // Ways round many obstacles come to a cell late and cheaply, and early and at more cost.
    let like = independent_cells(&mut seed::stream(7), size_cells, 0.35, &[0]).unwrap();
    let other = |number: usize| {
        let mut stream = seed::stream(number as u64);
        let mut grid = like.clone();
        for _ in 0..number % 40 {
            let cell = stream.random_range(0..grid.cell_count());
            grid.set_blocked(cell, grid.is_free(cell));
        }
        Moves::new(&grid, RULES[number % 3])
    };
    (0..count).map(other).collect()
}

/// What a grid's own search visits, in the order of cells.
fn alone(moves: &Moves, start: u32, most: u32) -> Vec<(u32, u32)> {
    let mut visits = Vec::new();
    OctileAstar::new(moves).unwrap().flood(start, most, |cell, cost| visits.push((cell, cost)));
    visits.sort_unstable();
    visits
}

#[test]
fn a_flood_of_many_grids_visits_what_floods_of_each_do() {
    let mut shared = 0;
    let mut visits = 0;
    for (width, height, count) in [(9, 7, 1), (32, 25, 3), (30, 30, 63), (40, 26, 64)] {
        let size = [width, height];
        let grids = grids_of(size, count);
        let mut search = ManyGrids::new(&grids).unwrap();
        for (start, most) in
            [(0, u32::MAX), (width * height - 1, 5 * ScaledOctile::STRAIGHT), (width + 2, 9_000)]
        {
            let mut found = vec![Vec::new(); count];
            let mut last = 0;
            search.flood(start, most, |cell, cost, grids: GridSet| {
                assert!(cost >= last && cost <= most, "{cost} after {last}");
                last = cost;
                (shared, visits) = (shared + u32::from(grids.count_ones() > 1), visits + 1);
                for (_, found) in found.iter_mut().enumerate().filter(|(grid, _)| grids >> grid & 1 == 1) {
                    found.push((cell, cost));
                }
                assert_eq!(
                    grids.checked_shr(count as u32).unwrap_or_default(),
                    0,
                    "grids that are not there"
                );
            });
            for (grid, (mut found, moves)) in found.into_iter().zip(&grids).enumerate() {
                found.sort_unstable();
                assert_eq!(found, alone(moves, start, most), "grid {grid} of {count}, from {start}");
            }
        }
    }
    assert!(shared > 1_000 && visits > shared + 1_000, "{shared} of {visits} visits are shared");
}

#[test]
#[should_panic(expected = "65 grids; a search holds 64")]
fn more_grids_than_a_search_holds_are_refused() {
    let grids = grids_of([3, 3], 65);
    let _ = ManyGrids::new(&grids);
}
