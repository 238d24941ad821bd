use std::collections::BTreeMap;

use rand::RngExt as _;

use super::{super::lattice::Octile, *};
use base::seed;

/// What a plain A* did on a map: cost of its path, closed (goal included) and opened cells.
struct Run {
    cost: Octile,
    closed: usize,
    opened: usize,
}

/// A* with a linear scan over a map from cells to (g, closed), exact in g and free in its order of ties.
///
/// `corner` is the least number of free flanks that a diagonal move needs. It shares nothing with the bound
/// but `Octile` and stops when the goal is chosen.
fn astar(
    free: &dyn Fn(Cell) -> bool,
    size: i32,
    ends: [Cell; 2],
    corner: usize,
    newest_first: bool,
) -> Option<Run> {
    let h = |n: Cell| f64::from((n[0] - ends[1][0]).pow(2) + (n[1] - ends[1][1]).pow(2)).sqrt();
    let mut nodes = BTreeMap::from([(ends[0], (Octile { straight: 0, diagonal: 0 }, false, 0))]);
    let mut order = 0;
    loop {
        let open = nodes.iter().filter(|(_, (_, closed, _))| !closed);
        let key = |n: Cell, g: Octile, at: i64| {
            // Equal f up to float noise is one f: then age decides.
            (((g.length() + h(n)) * 1e9).round() as i64, if newest_first { -at } else { at })
        };
        let (&n, &(g, _, at)) = open.min_by_key(|(n, (g, _, at))| key(**n, *g, *at))?;
        nodes.insert(n, (g, true, at));
        if n == ends[1] {
            let closed = nodes.values().filter(|node| node.1).count();
            return Some(Run { cost: g, closed, opened: nodes.len() });
        }
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let to = [n[0] + dx, n[1] + dy];
            let flanks = [[n[0] + dx, n[1]], [n[0], n[1] + dy]].into_iter().filter(|&f| free(f)).count();
            let inside = to.iter().all(|c| (0..size).contains(c));
            if !inside || !free(to) || dx * dy != 0 && flanks < corner {
                continue;
            }
            let diagonal = (dx * dy).unsigned_abs();
            let new = Octile { straight: g.straight + 1 - diagonal, diagonal: g.diagonal + diagonal };
            let known = nodes.get(&to);
            if known.is_none_or(|(old, closed, _)| !closed && new.compare(*old).is_lt()) {
                order += 1;
                nodes.insert(to, (new, false, order));
            }
        }
    }
}

#[test]
fn no_map_makes_astar_exceed_the_bound() {
    let size = 9;
    let mut solved = 0;
    let mut detours = 0;
    let mut tight = 0;
    for map in 0..600 {
        let mut stream = seed::stream(seed::derive(map, &["fvalues"]));
        let share = [0.0, 0.1, 0.2, 0.35][map as usize % 4];
        let blocked: Vec<bool> = (0..size * size).map(|_| stream.random_bool(share)).collect();
        let mut cell = || [stream.random_range(0..size), stream.random_range(0..size)];
        let ends = [cell(), cell()];
        let free =
            |c: Cell| ends.contains(&c) || !blocked[(c[1].clamp(0, 8) * size + c[0].clamp(0, 8)) as usize];
        for (corner, newest_first) in [(0, false), (0, true), (1, false), (2, true)] {
            let Some(run) = astar(&free, size, ends, corner, newest_first) else { continue };
            let bound = astar_count_bound([size, size], ends[0], ends[1], run.cost.length());
            assert!(run.closed <= bound.closed, "map {map} rule {corner}: {} of {bound:?}", run.closed);
            assert!(run.opened <= bound.opened, "map {map} rule {corner}: {} of {bound:?}", run.opened);
            solved += 1;
            let straight = lattice::octile_distance([ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]]);
            detours += u32::from(run.cost != straight);
            tight += u32::from(ends[0] != ends[1] && run.closed == bound.closed);
        }
    }
    assert!(solved > 1500 && detours > 300, "{solved} runs, {detours} with a detour");
    assert!(tight > 50, "the bound is reached on {tight} runs only");
}

#[test]
fn the_grid_papers_counts_are_bounded_as_enumeration_says() {
    let cost = |a, b| Octile { straight: a, diagonal: b }.length();
    let simple = astar_count_bound([30, 30], [22, 15], [26, 28], cost(9, 4));
    assert_eq!((simple.closed, simple.opened), (55, 99));
    let complex = astar_count_bound([30, 30], [28, 19], [13, 16], cost(12, 4));
    assert_eq!((complex.closed, complex.opened), (106, 156));
}

#[test]
fn an_optimum_below_the_octile_distance_leaves_nothing() {
    let bound = astar_count_bound([30, 30], [22, 15], [26, 28], 14.0);
    assert!(bound.closed < 55);
    assert_eq!(astar_count_bound([30, 30], [22, 15], [26, 28], 13.5), CountBound { closed: 0, opened: 0 });
}
