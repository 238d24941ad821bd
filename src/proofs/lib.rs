//! The values that printed numbers can stand for, and numbers that no input could have given: the arithmetic and
//! geometry of claims and of the audit.
//!
//! [`printed`] keeps a number as its digits. [`exact`] computes with the values behind them, in integers and fractions.
//! [`reach`], [`form`], [`clock`], [`lattice`], [`bounds`], [`fvalues`] and [`mod@turns`] hold the mathematics.
//! [`formula`] has formulas of one paper each. [`proof`] applies them to one number at a time and answers in words.
//!
//! Nothing here reads a record. Every bound states its premises and takes the printed digits' slack in the paper's
//! favour, so that "impossible" is a proof under those premises. Decisions about lattice lengths are made in integers;
//! angles come from `libm`. Cells are `[x, y]` and stand for their centres, one unit apart.

pub mod bounds;
pub mod clock;
pub mod exact;
pub mod form;
pub mod formula;
pub mod fvalues;
pub mod lattice;
pub mod printed;
pub mod proof;
pub mod reach;
pub mod turns;

use turns::Cell;

/// The cell itself and its neighbours within the grid of `size` = `[columns, rows]`, by rows.
pub fn neighbourhood(cell: Cell, size: [i32; 2]) -> Vec<Cell> {
    (-1..=1)
        .flat_map(|dy| (-1..=1).map(move |dx| [cell[0] + dx, cell[1] + dy]))
        .filter(|near| (0..2).all(|axis| (0..size[axis]).contains(&near[axis])))
        .collect()
}

/// Pairs of a start and a goal, one of them moved to a neighbour, never onto the other.
pub fn with_an_end_moved([start, goal]: [Cell; 2], size: [i32; 2]) -> Vec<[Cell; 2]> {
    let starts = neighbourhood(start, size).into_iter().map(|near| [near, goal]);
    let goals = neighbourhood(goal, size).into_iter().map(|near| [start, near]);
    starts.chain(goals).filter(|pair| *pair != [start, goal] && pair[0] != pair[1]).collect()
}

/// The pairs of a start and a goal that are both moved to one of their neighbours, never to the same cell.
pub fn with_both_ends_moved([start, goal]: [Cell; 2], size: [i32; 2]) -> Vec<[Cell; 2]> {
    let moved = |cell| neighbourhood(cell, size).into_iter().filter(move |near| *near != cell);
    let goals: Vec<Cell> = moved(goal).collect();
    let pairs = moved(start).flat_map(|start| goals.iter().map(move |&goal| [start, goal]));
    pairs.filter(|[start, goal]| start != goal).collect()
}

/// An upper bound in words: `decimals` of it, rounded up so that it stays one.
pub fn at_most(bound: f64, decimals: usize) -> String {
    let scale = libm::pow(10.0, decimals as f64);
    format!("{:.decimals$}", libm::ceil(bound * scale - 1e-9) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_upper_bound_in_words_is_no_lower_than_the_bound() {
        for (bound, decimals, expected) in
            [(6.4150, 2, "6.42"), (7.2006, 2, "7.21"), (7.2, 2, "7.20"), (-1.237, 2, "-1.23"), (3.0, 0, "3")]
        {
            assert_eq!(at_most(bound, decimals), expected);
            assert!(expected.parse::<f64>().unwrap() >= bound - 1e-9);
        }
    }

    #[test]
    fn one_end_moves_at_a_time_and_stays_on_the_grid() {
        let moved = with_an_end_moved([[0, 0], [1, 0]], [30, 30]);
        assert_eq!(moved.len(), 2 + 4, "{moved:?}");
        assert!(moved.iter().all(|[a, b]| a != b && (*a == [0, 0]) != (*b == [1, 0])));
        assert_eq!(with_an_end_moved([[22, 15], [26, 28]], [30, 30]).len(), 16);
    }

    #[test]
    fn both_ends_move_and_stay_on_the_grid_and_apart() {
        let moved = with_both_ends_moved([[0, 0], [1, 0]], [30, 30]);
        assert_eq!(moved.len(), 3 * 5 - 2, "{moved:?}");
        assert!(moved.iter().all(|[a, b]| a != b && *a != [0, 0] && *b != [1, 0]));
        assert_eq!(with_both_ends_moved([[22, 15], [26, 28]], [30, 30]).len(), 64);
    }
}
