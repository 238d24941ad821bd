use super::*;

const SIZE: [i32; 2] = [30, 30];
const SIMPLE: [Cell; 2] = [[22, 15], [26, 28]];
const COMPLEX: [Cell; 2] = [[28, 19], [13, 16]];

fn shortest(ends: [Cell; 2], low: f64, high: f64, longest: f64, convention: Convention) -> Option<Polyline> {
    let (starts, goals) = (vec![ends[0]], vec![ends[1]]);
    let turn_deg = Interval::new(low, high);
    shortest_polyline(&TurnQuery {
        size: SIZE,
        starts,
        goals,
        headings: Vec::new(),
        convention,
        turn_deg,
        length: Interval::new(0.0, longest),
    })
}

#[test]
fn the_grid_papers_turns_need_the_lengths_that_the_search_finds() {
    use Convention::{Exterior, Interior};
    for (ends, low, high, convention, length, turn) in [
        (SIMPLE, 229.165, 229.18, Exterior, 16.0375, 229.1654),
        (SIMPLE, 229.16, f64::INFINITY, Exterior, 14.0486, 233.1301),
        (COMPLEX, 309.135, 309.15, Exterior, 17.0703, 309.1427),
        (COMPLEX, 309.13, f64::INFINITY, Exterior, 16.4237, 314.3327),
        (SIMPLE, 229.165, 229.18, Interior, 18.5275, 229.1654),
        (COMPLEX, 309.135, 309.15, Interior, 16.6808, 309.1440),
    ] {
        let found = shortest(ends, low, high, 25.0, convention).unwrap();
        assert!((found.length - length).abs() < 5e-5, "{found:?}");
        assert!((found.turn_deg - turn).abs() < 5e-5, "{found:?}");
        assert!(found.turn_deg >= low && found.turn_deg <= high, "{found:?}");
        assert_eq!((found.cells[0], found.cells[found.cells.len() - 1]), (ends[0], ends[1]));
        assert_eq!(shortest(ends, low, high, found.length - 1e-4, convention), None);
    }
}

#[test]
fn an_end_off_by_a_cell_does_not_rescue_the_grid_papers_pairs() {
    for ([start, goal], low, high, length) in
        [(SIMPLE, 229.165, 229.18, [13.395, 13.41]), (COMPLEX, 309.135, 309.15, [16.395, 16.41])]
    {
        let (near_start, near_goal) = (with_neighbours(start), with_neighbours(goal));
        for (starts, goals) in [(near_start, vec![goal]), (vec![start], near_goal)] {
            let convention = Convention::Exterior;
            let turn_deg = Interval::new(low, high);
            let pair = Interval::new(length[0], length[1]);
            let headings = Vec::new();
            let mut query =
                TurnQuery { size: SIZE, starts, goals, headings, convention, turn_deg, length: pair };
            assert_eq!(shortest_polyline(&query), None);
            // The turn alone is within reach of the complex pair: only both together are not.
            query.length = Interval::new(0.0, length[1]);
            assert_eq!(shortest_polyline(&query).is_some(), start == COMPLEX[0]);
        }
    }
}

/// A cell that is not on the rim, and its eight neighbours.
fn with_neighbours([x, y]: Cell) -> Vec<Cell> {
    (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy])).collect()
}

/// Every polyline of at most `longest` on a grid: its length and its turn sum by arc cosine.
fn enumerate(
    size: i32,
    path: &mut Vec<Cell>,
    goal: Cell,
    longest: f64,
    turns: (Option<Cell>, Convention),
    out: &mut Vec<[f64; 2]>,
) {
    let (heading, convention) = turns;
    let length: f64 = path.windows(2).map(|w| distance(w[0], w[1])).sum();
    if path.len() > 1 && path[path.len() - 1] == goal {
        let before = heading.map(|heading| difference(heading, path[0]));
        let with_heading: Vec<Cell> = before.into_iter().chain(path.iter().copied()).collect();
        let turns = with_heading.windows(3).map(|w| {
            let (u, v) = (difference(w[0], w[1]), difference(w[1], w[2]));
            let dot = f64::from(u[0] * v[0] + u[1] * v[1]);
            libm::acos((dot / distance(w[0], w[1]) / distance(w[1], w[2])).clamp(-1.0, 1.0)).to_degrees()
        });
        let bends = turns.filter(|&turn| turn > 1e-5);
        out.push([
            length,
            bends.map(|turn| if convention == Convention::Exterior { turn } else { 180.0 - turn }).sum(),
        ]);
    }
    let at = path[path.len() - 1];
    for to in (0..size).flat_map(|x| (0..size).map(move |y| [x, y])) {
        if to != at && length + distance(at, to) + distance(to, goal) <= longest {
            path.push(to);
            enumerate(size, path, goal, longest, turns, out);
            path.pop();
        }
    }
}

#[test]
fn no_enumerated_polyline_is_shorter_and_one_is_as_short() {
    let mut found = 0;
    let mut missing = 0;
    // A start in the corner has headings whose step before it is off the map.
    for (start, goal, longest) in [([0, 0], [3, 2], 6.9), ([1, 1], [2, 2], 6.1), ([0, 3], [3, 3], 6.7)] {
        for (headings, convention) in [
            (vec![], Convention::Exterior),
            (vec![], Convention::Interior),
            (vec![[1, 0]], Convention::Exterior),
            (vec![[-1, -1]], Convention::Exterior),
            (vec![[0, -1]], Convention::Interior),
            (vec![[0, -1], [1, 1], [-1, 0]], Convention::Exterior),
            (vec![[1, 0], [-1, 1]], Convention::Interior),
        ] {
            let mut all = Vec::new();
            let each =
                if headings.is_empty() { vec![None] } else { headings.iter().copied().map(Some).collect() };
            for heading in each {
                enumerate(4, &mut vec![start], goal, longest, (heading, convention), &mut all);
            }
            assert!(all.len() > 300, "only {} polylines", all.len());
            for i in 0..130 {
                let low = f64::from(i) * 2.7 + 0.013;
                let turn_deg = Interval::new(low, if i % 10 == 0 { f64::INFINITY } else { low + 3.1 });
                let least = if i % 3 == 0 { longest - 0.61 } else { 0.0 };
                let length = Interval::new(least, longest);
                let fits = |p: &&[f64; 2]| length.contains(p[0]) && turn_deg.contains(p[1]);
                let expected = all.iter().filter(fits).map(|p| p[0]).min_by(f64::total_cmp);
                let (starts, goals) = (vec![start], vec![goal]);
                let headings = headings.clone();
                let query = TurnQuery { size: [4, 4], starts, goals, headings, convention, turn_deg, length };
                let got = shortest_polyline(&query);
                *if got.is_some() { &mut found } else { &mut missing } += 1;
                assert!(got.iter().all(|p| turn_deg.contains(p.turn_deg)), "{query:?}: {got:?}");
                let got = got.map_or(-1.0, |p| p.length);
                let expected = expected.unwrap_or(-1.0);
                assert!((got - expected).abs() < 1e-9, "{query:?}: {got}, not {expected}");
            }
        }
    }
    assert!(found > 400 && missing > 250, "one-sided sample: {found} and {missing}");
}

/// The shortest from one of these headings, by a best-first search in C++ that was written from the definition alone.
#[test]
fn the_first_segment_turns_from_the_heading() {
    for (heading, length) in [
        (None, Some(14.7528)),
        (Some([1, 1]), Some(13.9244)),
        (Some([0, 1]), Some(15.3702)),
        (Some([-1, 1]), Some(13.9244)),
        (Some([1, -1]), Some(13.6026)),
        (Some([1, 0]), None),
        (Some([-1, 0]), None),
        (Some([-1, -1]), None),
        (Some([0, -1]), None),
    ] {
        let (starts, goals) = (vec![SIMPLE[0]], vec![SIMPLE[1]]);
        let convention = Convention::Exterior;
        let turn_deg = Interval::new(120.0, 120.05);
        let longest = Interval::new(0.0, 15.6);
        let headings = heading.into_iter().collect();
        let query = TurnQuery { size: SIZE, starts, goals, headings, convention, turn_deg, length: longest };
        let found = shortest_polyline(&query);
        let ends = found.iter().map(|found| (found.cells[0], found.cells[found.cells.len() - 1]));
        assert!(ends.into_iter().all(|ends| ends == SIMPLE.into()), "{found:?}");
        let found = found.map(|found| (found.length * 1e4).round() / 1e4);
        assert_eq!(found, length, "{heading:?}");
    }
}

#[test]
fn several_ends_give_the_best_pair() {
    let (starts, goals) = (vec![[3, 3], [4, 3], [3, 5]], vec![[8, 9], [9, 7]]);
    let convention = Convention::Exterior;
    for low in [0.0, 30.0, 77.0, 120.0, 165.0] {
        let turn_deg = Interval::new(low, low + 4.0);
        let one = |start, goal| shortest([start, goal], low, low + 4.0, 10.0, convention).map(|p| p.length);
        let pairs = starts.iter().flat_map(|&s| goals.iter().filter_map(move |&g| one(s, g)));
        let best = pairs.min_by(f64::total_cmp).unwrap();
        let (starts, goals) = (starts.clone(), goals.clone());
        let length = Interval::new(0.0, 10.0);
        let query =
            TurnQuery { size: SIZE, starts, goals, headings: Vec::new(), convention, turn_deg, length };
        let found = shortest_polyline(&query).unwrap();
        assert!((found.length - best).abs() < 1e-9, "from {low}: {found:?}, not {best}");
    }
}
