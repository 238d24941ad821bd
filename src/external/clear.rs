//! Steps at any angle between cell centres: what the verifier of grids accepts, in integers.

use base::grid::{CornerRule, Grid2, Sight};

/// Whether the straight step between two cells meets no blocked cell and cuts no corner that the rule forbids.
pub(super) fn is_clear(grid: &Grid2, rule: CornerRule, from: u32, to: u32) -> bool {
    Sight::ExactInterior.is_clear(grid, from, to) && keeps_corners(grid, rule, grid.xy(from), grid.xy(to))
}

/// A segment between centres runs through corners of cells only if both reduced components are odd: midway between two
/// diagonal neighbours, once in each reduced step.
fn keeps_corners(grid: &Grid2, rule: CornerRule, from: [i32; 2], to: [i32; 2]) -> bool {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let parts = gcd(dx.unsigned_abs(), dy.unsigned_abs()).max(1) as i32;
    let step = [dx / parts, dy / parts];
    if step[0] % 2 == 0 || step[1] % 2 == 0 {
        return true;
    }
    let unit = step.map(i32::signum);
    (0..parts).all(|part| {
        let [x, y] = [0, 1].map(|axis: usize| from[axis] + part * step[axis] + (step[axis] - unit[axis]) / 2);
        rule.permits([grid.is_free_xy(x + unit[0], y), grid.is_free_xy(x, y + unit[1])])
    })
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
