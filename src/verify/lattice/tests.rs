use super::*;
use base::grid::{maze, parse_text_map, rooms};
use base::seed::{derive, stream};
use rand::RngExt as _;

const RULES: [CornerRule; 3] = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];

/// Whether the segment meets the open unit square around `cell`, by clipping its parameter in exact fractions.
fn clips(from: [i32; 2], to: [i32; 2], cell: [i32; 2]) -> bool {
    let (mut low, mut high) = ((0_i64, 1_i64), (1_i64, 1_i64));
    for axis in 0..2 {
        let step = 2 * i64::from(to[axis] - from[axis]);
        let near = 2 * i64::from(cell[axis] - from[axis]) - 1;
        let far = near + 2;
        if step == 0 {
            if near >= 0 || far <= 0 {
                return false;
            }
            continue;
        }
        let (enter, leave) =
            if step > 0 { ((near, step), (far, step)) } else { ((-far, -step), (-near, -step)) };
        low = if enter.0 * low.1 > low.0 * enter.1 { enter } else { low };
        high = if leave.0 * high.1 < high.0 * leave.1 { leave } else { high };
    }
    low.0 * high.1 < high.0 * low.1 || from == to
}

/// The corners of cells that lie on the segment, as the cells to their lower left.
fn corners_on(from: [i32; 2], to: [i32; 2]) -> Vec<[i32; 2]> {
    let (xs, ys) = (from[0].min(to[0])..from[0].max(to[0]), from[1].min(to[1])..from[1].max(to[1]));
    let cross = |[x, y]: [i32; 2]| {
        let (px, py) = (2 * (x - from[0]) + 1, 2 * (y - from[1]) + 1);
        px * (to[1] - from[1]) - py * (to[0] - from[0])
    };
    ys.flat_map(|y| xs.clone().map(move |x| [x, y])).filter(|corner| cross(*corner) == 0).collect()
}

/// Whether the corner rule lets a segment through the upper right corner of `[x, y]`, rising or falling there.
fn passes(grid: &Grid2, rule: CornerRule, [x, y]: [i32; 2], is_rising: bool) -> bool {
    let flanks = if is_rising { [[x + 1, y], [x, y + 1]] } else { [[x, y], [x + 1, y + 1]] };
    let blocked = flanks.iter().filter(|[x, y]| !grid.is_free_xy(*x, *y)).count();
    match rule {
        CornerRule::Allow => true,
        CornerRule::ForbidBoth => blocked < 2,
        CornerRule::ForbidAny => blocked == 0,
    }
}

/// An answer whose steps alone are judged.
fn answer(in_graph: bool, sight_corners: Option<CornerRule>) -> Answer<'static> {
    Answer { path: &[], cost: None, in_graph, optimal: false, sight_corners }
}

fn grid(seed: u64, side: u32, share: f64) -> Grid2 {
    let mut stream = stream(derive(seed, &["verify"]));
    let mut grid = Grid2::new(side, side).unwrap();
    (0..grid.cell_count()).for_each(|cell| grid.set_blocked(cell, stream.random_bool(share)));
    grid
}

#[test]
fn a_segment_enters_the_cells_that_exact_clipping_finds() {
    let mut entered = 0;
    for x in -6..=6 {
        for y in -6..=6 {
            for (cx, cy) in (-7..=7).flat_map(|cx| (-7..=7).map(move |cy| (cx, cy))) {
                let from = [2, -1];
                let to = [2 + x, y - 1];
                let cell = [2 + cx, cy - 1];
                let truth = clips(from, to, cell) || cell == from && from == to;
                let same_cell = from != to || cell == from;
                assert!(!same_cell || enters(from, to, cell) == truth, "{from:?} to {to:?} in {cell:?}");
                entered += u32::from(truth);
            }
        }
    }
    assert!(entered > 1000, "{entered}");
}

#[test]
fn a_step_is_refused_exactly_where_it_enters_a_blocked_cell_or_cuts_a_forbidden_corner() {
    let mut by_reason = [0; 3];
    for seed in 0..60 {
        let grid = grid(seed, 7, 0.12);
        for rule in RULES {
            let case = Case { grid: &grid, corner_rule: rule, start: &[], goal: &[] };
            for (from, to) in (0..49).flat_map(|a| (0..49).map(move |b| (grid_xy(a), grid_xy(b)))) {
                if from == to {
                    continue;
                }
                let cells = (0..49).map(grid_xy).filter(|cell| clips(from, to, *cell));
                let is_free = cells.into_iter().all(|[x, y]| grid.is_free_xy(x, y));
                let is_rising = (to[0] - from[0]) * (to[1] - from[1]) > 0;
                let keeps = |rule| corners_on(from, to).iter().all(|at| passes(&grid, rule, *at, is_rising));
                for own in [None].into_iter().chain(RULES.map(Some)) {
                    let is_open = keeps(rule) || own.is_some_and(keeps);
                    let got = case.refuse_step(&[from, to], &answer(false, own));
                    assert_eq!(
                        got.is_none(),
                        is_free && is_open,
                        "seed {seed}, {rule:?}, {own:?}, {from:?} to {to:?}: {got:?}"
                    );
                    by_reason[if is_free { usize::from(!is_open) } else { 2 }] += 1;
                }
                let moves_keep_their_rule =
                    case.refuse_step(&[from, to], &answer(true, Some(CornerRule::Allow)));
                assert!(moves_keep_their_rule.is_some() || keeps(rule), "{rule:?}, {from:?} to {to:?}");
            }
        }
    }
    assert!(by_reason.iter().all(|count| *count > 500), "{by_reason:?}");
}

fn grid_xy(cell: i32) -> [i32; 2] {
    [cell % 7, cell / 7]
}

/// Least costs from `start` by relaxing every move until nothing changes (Bellman and Ford).
fn relaxed(grid: &Grid2, rule: CornerRule, start: u32) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; grid.cell_count() as usize];
    best[start as usize] = 0.0;
    let moves = base::grid::Moves::new(grid, rule);
    loop {
        let mut changed = false;
        for from in (0..grid.cell_count()).filter(|cell| grid.is_free(*cell)) {
            for (to, is_diagonal) in moves.from_cell(from) {
                let cost = best[from as usize] + if is_diagonal { std::f64::consts::SQRT_2 } else { 1.0 };
                if cost < best[to as usize] - 1e-9 {
                    best[to as usize] = cost;
                    changed = true;
                }
            }
        }
        if !changed {
            return best;
        }
    }
}

#[test]
fn the_optimum_is_what_relaxing_every_move_gives() {
    let mut joined = 0;
    let mut parted = 0;
    for seed in 0..90 {
        let grid = grid(seed, 9, 0.35);
        let rule = RULES[(seed % 3) as usize];
        let Some(start) = (0..81).find(|cell| grid.is_free(*cell)) else { continue };
        let truth = relaxed(&grid, rule, start);
        let start = grid.xy(start).map(f64::from);
        for goal in 0..81 {
            let end = grid.xy(goal).map(f64::from);
            let case = Case { grid: &grid, corner_rule: rule, start: &start, goal: &end };
            let wanted = Some(truth[goal as usize]).filter(|cost| cost.is_finite());
            let got = case.optimal_cost(None);
            assert_eq!(got.is_some(), wanted.is_some(), "seed {seed}, {rule:?}, {start:?} to {end:?}");
            let (got, wanted) = (got.unwrap_or_default(), wanted.unwrap_or_default());
            assert!((got - wanted).abs() < 1e-9, "seed {seed}, {rule:?}, to {end:?}: {got}, not {wanted}");
            let is_free = grid.is_free(goal);
            joined += u32::from(is_free && truth[goal as usize].is_finite());
            parted += u32::from(is_free && truth[goal as usize].is_infinite());
        }
    }
    assert!(joined > 1000 && parted > 500, "{joined} joined, {parted} parted");
}

#[test]
fn corner_rules_judge_the_same_diagonal_differently() {
    for (map, allowed) in [
        ("..\n..\n", [true, true, true]),
        (".#\n..\n", [true, true, true]),
        ("..\n.#\n", [true, true, false]),
        ("#.\n..\n", [true, true, false]),
        ("#.\n.#\n", [true, false, false]),
    ] {
        let grid = parse_text_map(map).unwrap();
        for (rule, is_allowed) in RULES.into_iter().zip(allowed) {
            let (start, goal) = ([0.0, 0.0], [1.0, 1.0]);
            let case = Case { grid: &grid, corner_rule: rule, start: &start, goal: &goal };
            let is_free = grid.is_free_xy(1, 1);
            let refused = case.refuse_step(&[[0, 0], [1, 1]], &answer(true, None));
            assert_eq!(refused.is_none(), is_allowed && is_free, "{rule:?} on\n{map}{refused:?}");
        }
    }
}

#[test]
fn jump_points_alone_are_a_path_at_any_angle_and_no_path_from_cell_to_cell() {
    let grid = parse_text_map("....\n....\n").unwrap();
    let case = Case { grid: &grid, corner_rule: CornerRule::Allow, start: &[], goal: &[] };
    for (in_graph, refused) in
        [(false, None), (true, Some("the step from [1, 0] to [3, 0] is not one of the eight moves"))]
    {
        let found = case.refuse_step(&[[1, 0], [3, 0]], &answer(in_graph, None));
        assert_eq!(found.as_deref(), refused);
    }
}

/// Maps whose ways are short, winding and roundabout.
fn large_grid(seed: u64) -> Grid2 {
    let mut stream = stream(derive(seed, &["large"]));
    match seed % 3 {
        0 => grid(seed, 41, 0.35),
        1 => maze(&mut stream, [41, 41]).unwrap(),
        _ => rooms(&mut stream, [41, 41], 6, 0.6).unwrap(),
    }
}

#[test]
fn landmarks_change_no_optimum_and_know_where_there_is_no_path() {
    let mut solved = 0;
    let mut unsolved = 0;
    let mut longest = 0.0_f64;
    for seed in 100..112 {
        let grid = large_grid(seed);
        let mut stream = stream(derive(seed, &["queries"]));
        for rule in RULES {
            let mut point = || [stream.random_range(0..41), stream.random_range(0..41)].map(f64::from);
            let first = point();
            let landmarks =
                Landmarks::new(&Case { grid: &grid, corner_rule: rule, start: &first, goal: &first });
            for start in [point(), point(), point()] {
                let cell = |[x, y]: [f64; 2]| grid.cell(x as i32, y as i32).unwrap();
                let truth = relaxed(&grid, rule, cell(start));
                for _ in 0..60 {
                    let goal = point();
                    let case = Case { grid: &grid, corner_rule: rule, start: &start, goal: &goal };
                    let is_free = grid.is_free(cell(start)) && grid.is_free(cell(goal));
                    let truth = Some(truth[cell(goal) as usize]).filter(|cost| is_free && cost.is_finite());
                    let with = case.optimal_cost(landmarks.as_ref());
                    let without = case.optimal_cost(None);
                    let off = with.zip(truth).map_or(0.0, |(with, truth)| (with - truth).abs());
                    let place =
                        format!("seed {seed}, {rule:?}: {start:?} to {goal:?}: {with:?}, not {truth:?}");
                    assert!(with == without && with.is_some() == truth.is_some() && off < 1e-9, "{place}");
                    if landmarks.is_some() {
                        (solved, unsolved) =
                            (solved + u32::from(with.is_some()), unsolved + u32::from(with.is_none()));
                    }
                    longest = longest.max(truth.unwrap_or_default());
                }
            }
        }
    }
    assert!(solved > 200 && unsolved > 200, "one-sided sample: {solved} with a path, {unsolved} without");
    assert!(longest > 150.0, "no way is roundabout: {longest}");
}

/// One way of 82 straight moves and two around its corners, and one of 60 diagonal moves, which is longer by 0.0244: less than a
/// bucket.
#[test]
fn of_two_ways_in_one_bucket_the_shorter_is_found() {
    let mut grid = Grid2::new(61, 44).unwrap();
    let diagonal = (0..=60).map(|x: i32| [x, 43 - (x - 30).abs()]);
    let straight = (0..=60).map(|x| [x, 0]).chain((0..=13).flat_map(|y| [[0, y], [60, y]]));
    let free: Vec<[i32; 2]> = diagonal.chain(straight).collect();
    for cell in 0..grid.cell_count() {
        let is_free = free.contains(&grid.xy(cell));
        grid.set_blocked(cell, !is_free);
    }
    let ends = [[0.0, 13.0], [60.0, 13.0]];
    let least = Some(82.0 + 2.0 * std::f64::consts::SQRT_2);
    for [start, goal] in [ends, [ends[1], ends[0]]] {
        let case = Case { grid: &grid, corner_rule: CornerRule::Allow, start: &start, goal: &goal };
        let landmarks = Landmarks::new(&case);
        assert_eq!([case.optimal_cost(None), case.optimal_cost(landmarks.as_ref())], [least; 2]);
    }
}
