use super::*;
use base::grid::{corners_see, independent_cells, parse_text_map};
use base::seed::stream;

fn corners(cells: &Grid2) -> Vec<[i32; 2]> {
    let [width, height] = [cells.width() as i32, cells.height() as i32];
    (0..=height).flat_map(|y| (0..=width).map(move |x| [x, y])).collect()
}

/// The length of a shortest path over all corners, each joined with all that it sees: costs are lowered until none can be.
fn over_all_corners(cells: &Grid2, start: [i32; 2], goal: [i32; 2]) -> Option<f64> {
    let all = corners(cells);
    let at = |corner| all.iter().position(|known| *known == corner).unwrap();
    let mut cost = vec![f64::INFINITY; all.len()];
    let mut is_done = vec![false; all.len()];
    cost[at(start)] = 0.0;
    while let Some(near) =
        (0..all.len()).filter(|i| !is_done[*i]).min_by(|i, j| cost[*i].total_cmp(&cost[*j]))
    {
        is_done[near] = true;
        for far in 0..all.len() {
            if corners_see(cells, all[near], all[far]) {
                let [dx, dy] = [0, 1].map(|axis: usize| f64::from(all[near][axis] - all[far][axis]));
                cost[far] = cost[far].min(cost[near] + (dx * dx + dy * dy).sqrt());
            }
        }
    }
    Some(cost[at(goal)]).filter(|cost| cost.is_finite())
}

#[test]
fn the_shortest_path_is_that_of_the_visibility_graph_over_all_corners() {
    let [mut found, mut walled] = [0, 0];
    for seed in 0..120 {
        let size = [[8, 7], [3, 9], [10, 4], [1, 1]][seed as usize % 4];
        let share = [0.1, 0.3, 0.5][seed as usize % 3];
        let cells = independent_cells(&mut stream(seed), size, share, &[]).unwrap();
        let all = corners(&cells);
        for (start, goal) in [(all[0], all[all.len() - 1]), (all[all.len() / 2], all[size[0] as usize])] {
            let ends = [start, goal].map(|corner| corner.map(f64::from));
            let case = CornerCase::new(&cells, [&ends[0], &ends[1]]);
            let is_free = |[x, y]: [i32; 2]| case.corners.is_free_xy(x, y);
            let truth = over_all_corners(&cells, start, goal).filter(|_| is_free(start) && is_free(goal));
            let least = case.least();
            let same = match (least, truth) {
                (Some(least), Some(truth)) => {
                    assert!(least.in_graph > truth - 1e-9, "seed {seed}: {least:?}");
                    (least.shortest - truth).abs() < 1e-9
                }
                (least, truth) => least.is_none() && truth.is_none(),
            };
            assert!(same, "seed {seed}, {start:?} to {goal:?}: {least:?} for {truth:?}\n{cells:?}");
            *(if truth.is_some() { &mut found } else { &mut walled }) += 1;
        }
    }
    assert!(found > 100 && walled > 20, "{found} found, {walled} walled off");
}

#[test]
fn a_leg_is_clear_iff_its_ends_see_each_other() {
    let mut seen = 0;
    for seed in 0..20 {
        let cells = independent_cells(&mut stream(seed), [7, 6], 0.3, &[]).unwrap();
        let case = CornerCase::new(&cells, [&[], &[]]);
        let all = corners(&cells);
        for (from, to) in all.iter().flat_map(|a| all.iter().map(move |b| (*a, *b))).filter(|(a, b)| a != b) {
            let sees = corners_see(&cells, from, to);
            assert_eq!(case.is_clear(from, to), sees, "seed {seed}: {from:?} to {to:?}\n{cells:?}");
            seen += u32::from(sees);
        }
    }
    assert!(seen > 5_000, "{seen}");
}

#[test]
fn a_path_is_refused_where_it_is_not_what_it_claims() {
    let cells = parse_text_map("...\n.#.\n...\n").unwrap();
    let ends = [[0.0, 0.0], [3.0, 3.0]];
    let case = CornerCase::new(&cells, [&ends[0], &ends[1]]);
    let least = case.least();
    let refusal = |points: &[[f64; 2]], cost: f64, in_graph: bool| {
        let path: Vec<Vec<f64>> = points.iter().map(|at| at.to_vec()).collect();
        let answer = Answer { path: &path, cost: Some(cost), in_graph, optimal: false, sight_corners: None };
        case.refuse_path(&answer, least).unwrap_or_default()
    };
    let bent = 2.0 * 5.0_f64.sqrt();
    let on_edges = 2.0 * libm::hypot(0.5, 1.0) + 5.0_f64.sqrt();
    assert_eq!(refusal(&[[0.0, 0.0], [1.0, 2.0], [3.0, 3.0]], bent, false), "");
    assert_eq!(refusal(&[[0.0, 0.0], [0.5, 1.0], [1.0, 2.0], [3.0, 3.0]], on_edges, false), "");
    for (points, cost, in_graph, message) in [
        (&[[0.0, 0.0], [3.0, 3.0]][..], 18.0_f64.sqrt(), false, "is not clear of blocked cells"),
        (&[[0.0, 0.0], [1.0, 2.0], [3.0, 3.0]], bent, true, "is not one of the eight moves"),
        (&[[0.0, 0.0], [1.0, 2.0], [3.0, 3.0]], 4.0, false, "the claimed cost is 4"),
        (&[[0.0, 0.0], [1.5, 1.5], [3.0, 3.0]], 18.0_f64.sqrt(), false, "stays in no free cell"),
        (&[[0.0, 0.0], [0.5, 1.5], [3.0, 3.0]], 4.5, false, "stays in no free cell"),
        (&[[0.0, 0.0], [0.0, 0.0], [3.0, 3.0]], 4.5, false, "stands still"),
        (&[[0.0, 0.0], [1.0, 2.0]], 2.2, false, "not from start to goal"),
    ] {
        let refused = refusal(points, cost, in_graph);
        assert!(refused.contains(message), "{points:?}: {refused:?} lacks {message:?}");
    }
}

#[test]
fn an_open_map_is_seen_once() {
    // As many intervals as rows: were any handed on twice, they would double from row to row.
    let cells = Grid2::new(300, 200).unwrap();
    let ends = [[300.0, 0.0], [299.0, 200.0]];
    let least = CornerCase::new(&cells, [&ends[0], &ends[1]]).least().unwrap();
    assert!((least.shortest - libm::hypot(200.0, 1.0)).abs() < 1e-9, "{least:?}");
}
