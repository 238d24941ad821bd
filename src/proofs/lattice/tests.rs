use std::collections::BTreeSet;

use super::*;

fn printed(text: &str) -> Printed {
    text.parse().unwrap()
}

fn octile(straight: u32, diagonal: u32) -> Octile {
    Octile { straight, diagonal }
}

#[test]
fn exact_comparison_agrees_with_floats_where_floats_can_tell() {
    let mut decided = 0;
    for a in -60..=60_i128 {
        for b in -60..=60_i128 {
            let x = a as f64 + b as f64 * std::f64::consts::SQRT_2;
            if x.abs() > 1e-9 {
                assert_eq!(sign(a, b), x.total_cmp(&0.0), "{a} + {b}√2");
                decided += 1;
            }
        }
    }
    assert_eq!(decided, 121 * 121 - 1, "only 0 + 0√2 is zero");
    // 665857/470832 is a convergent of √2 within 1.6e-12 of it.
    assert_eq!(sign(665_857, -470_832), Ordering::Greater);
    assert_eq!(sign(-665_857, 470_832), Ordering::Less);
}

#[test]
fn joining_is_what_walking_finds() {
    // The oracle walks: it keeps the set of cells reached by each pair of counts, move by move.
    let moves = |diagonal: bool| -> Vec<Cell> {
        let all = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy]));
        all.filter(|d: &Cell| d[0].abs() + d[1].abs() == if diagonal { 2 } else { 1 }).collect()
    };
    let (mut yes, mut no) = (0, 0);
    for a in 0..6 {
        for b in 0..5 {
            let mut reached = BTreeSet::from([[0, 0]]);
            for diagonal in std::iter::repeat_n(false, a).chain(std::iter::repeat_n(true, b)) {
                let ways = moves(diagonal);
                let step = |c: Cell| ways.iter().map(move |d| [c[0] + d[0], c[1] + d[1]]);
                reached = reached.into_iter().flat_map(step).collect();
            }
            for dx in -12..=12 {
                for dy in -12..=12 {
                    let walked = reached.contains(&[dx, dy]);
                    assert_eq!(joins(octile(a as u32, b as u32), [dx, dy]), walked, "{a} {b} to {dx},{dy}");
                    if walked { yes += 1 } else { no += 1 }
                }
            }
        }
    }
    assert!(yes > 1500 && no > 1500, "one-sided sample: {yes} and {no}");
}

#[test]
fn octile_distance_is_the_shortest_joining_length() {
    for dx in -7..=7 {
        for dy in -7..=7 {
            let nearest = (0..16)
                .flat_map(|a| (0..16).map(move |b| octile(a, b)))
                .filter(|&moves| joins(moves, [dx, dy]))
                .min_by(|a, b| a.compare(*b))
                .unwrap();
            assert_eq!(octile_distance([dx, dy]), nearest, "{dx},{dy}");
        }
    }
}

#[test]
fn the_grid_papers_lengths_read_as_they_do_by_hand() {
    let simple = [4, 13];
    let complex = [-15, -3];
    let found = |text, digits, trip| lengths_printing(printed(text), digits, Step::ONE, Some(trip));
    assert_eq!(found("14.65", Digits::Truncated, simple), [octile(9, 4)]);
    assert_eq!(found("14.65", Digits::Rounded, simple), []);
    assert_eq!(found("17.56", Digits::Unknown, complex), []);
    assert_eq!(found("17.65", Digits::Truncated, complex), [octile(12, 4)]);
    assert_eq!(octile_distance(simple), octile(9, 4));
    let (below, above) = nearest_lengths(printed("17.56"), complex);
    assert_eq!((below, above), (Some(octile(16, 1)), Some(octile(12, 4))));
}

#[test]
fn the_arm_papers_lengths_are_unique_at_one_centimetre_and_no_coarser() {
    let found = |denominator| {
        let step = Step { numerator: 50, denominator };
        [printed("72.8406"), printed("70.7401")]
            .map(|length| lengths_printing(length, Digits::Rounded, step, None))
    };
    let coarsest = (1..=50).find(|denominator| found(*denominator).iter().all(|lengths| !lengths.is_empty()));
    assert_eq!(coarsest, Some(50), "parts of 50 cm");
    assert_eq!(found(50), [vec![octile(29, 31)], vec![octile(17, 38)]]);
}

#[test]
fn a_scaled_lattice_is_the_unit_lattice_of_scaled_digits() {
    // 0.25 (a + b√2) prints as d/10000·0.25 … held by enumeration over floats away from ties.
    let step = Step { numerator: 1, denominator: 4 };
    let mut hits = 0;
    for units in 1000..1400 {
        let target = Printed::from_units(units, 2);
        let mut expected = Vec::new();
        for diagonal in 0..60 {
            for straight in 0..60 {
                let x = octile(straight, diagonal).length() / 4.0;
                if target.agrees(x, Digits::Unknown) {
                    expected.push(octile(straight, diagonal));
                }
            }
        }
        hits += expected.len();
        assert_eq!(lengths_printing(target, Digits::Unknown, step, None), expected, "{target}");
    }
    assert!(hits > 400, "only {hits} hits");
}

#[test]
fn the_lengths_that_print_a_number_are_those_of_all_pairs_of_moves() {
    let third = Step { numerator: 1, denominator: 3 };
    let mut found = 0;
    for (text, step) in
        [("0", Step::ONE), ("7", Step::ONE), ("41.4", Step::ONE), ("12.07", third), ("49.497", Step::ONE)]
    {
        for units in printed(text).units()..printed(text).units() + 40 {
            let number = Printed::from_units(units, printed(text).decimals());
            for (_, digits) in Digits::NAMED {
                let pairs =
                    (0..70).flat_map(|diagonal| (0..100).map(move |straight| octile(straight, diagonal)));
                let all: Vec<Octile> =
                    pairs.filter(|moves| prints_as(*moves, step, number, digits)).collect();
                assert_eq!(lengths_printing(number, digits, step, None), all, "{number} by {digits:?}");
                found += all.len();
            }
        }
    }
    assert!(found > 1000, "{found} lengths");
}
