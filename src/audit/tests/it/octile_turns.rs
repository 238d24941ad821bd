//! The turn sums of 8-connected walks, by walking them.

use proofs::lattice::{Octile, octile_distance};
use proofs::turns::{Cell, Convention, turn_sum_deg};
use replan_audit::octile_turns::octile_turn_sums;
use std::collections::BTreeSet;

/// Turn sums of all walks with exactly `left` over what remains, by walking them.
fn walk(left: Octile, to: Cell, path: &mut Vec<Cell>, convention: Convention, sums: &mut BTreeSet<u32>) {
    if left.straight + left.diagonal == 0 && to == path[path.len() - 1] {
        sums.insert((turn_sum_deg(path, convention) / 45.0).round() as u32);
    }
    let at = path[path.len() - 1];
    for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
        let diagonal = u32::from(dx * dy != 0);
        let straight = u32::from(dx != 0 || dy != 0) - diagonal;
        let (Some(s), Some(d)) = (left.straight.checked_sub(straight), left.diagonal.checked_sub(diagonal))
        else {
            continue;
        };
        if straight + diagonal > 0 {
            path.push([at[0] + dx, at[1] + dy]);
            walk(Octile { straight: s, diagonal: d }, to, path, convention, sums);
            path.pop();
        }
    }
}

#[test]
fn octile_turn_sums_are_those_of_the_walks() {
    let mut listed = 0;
    for convention in [Convention::Exterior, Convention::Interior] {
        for (straight, diagonal, to) in
            [(2, 1, [3, 1]), (3, 2, [3, 2]), (1, 3, [2, 1]), (4, 1, [1, 0]), (2, 2, [2, 2])]
        {
            let moves = Octile { straight, diagonal };
            let mut sums = BTreeSet::new();
            walk(moves, to, &mut vec![[0, 0]], convention, &mut sums);
            listed += sums.len();
            assert_eq!(
                octile_turn_sums(moves, to, convention),
                sums.into_iter().collect::<Vec<_>>(),
                "{moves:?}"
            );
        }
    }
    assert!(listed > 40, "only {listed} sums");
    assert_eq!(
        octile_turn_sums(Octile { straight: 1, diagonal: 0 }, [5, 5], Convention::Exterior),
        [0_u32; 0]
    );
}

#[test]
fn the_grid_papers_astar_rows_are_attainable_pairs() {
    let simple = octile_turn_sums(Octile { straight: 9, diagonal: 4 }, [4, 13], Convention::Exterior);
    assert!(simple.contains(&(270 / 45)), "{simple:?}");
    let complex = octile_turn_sums(Octile { straight: 12, diagonal: 4 }, [-15, -3], Convention::Exterior);
    assert!(complex.contains(&(315 / 45)), "{complex:?}");
    // 17.6569 is longer than the octile distance 12 + 3√2 by one diagonal for a straight move.
    assert_eq!(octile_distance([-15, -3]), Octile { straight: 12, diagonal: 3 });
}
