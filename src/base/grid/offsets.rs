//! Neighbourhoods wider than one cell, as lists of steps in a written order.

/// Steps `[dx, dy]` from a cell to its neighbours: dx falls, and for each dx, dy falls. Radius 1 of
/// [`Offsets::square`] is therefore [`DIRECTIONS`](super::DIRECTIONS).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offsets {
    steps: Vec<[i32; 2]>,
}

impl Offsets {
    /// The square block of side `2 · radius_cells + 1` without its centre: 8, 24, 48, 80 … steps.
    pub fn square(radius_cells: u8) -> Self {
        Self::within(radius_cells, |_, _| true)
    }

    /// The steps no longer than `radius_cells`: 4, 12, 28, 48, 80, 112 … of them.
    pub fn disc(radius_cells: u8) -> Self {
        let reach = i32::from(radius_cells);
        Self::within(radius_cells, |dx, dy| dx * dx + dy * dy <= reach * reach)
    }

    /// The steps in the regular octagon with sides at `radius_cells`: 4, 12, 36, 56, 96 … of them.
    pub fn octagon(radius_cells: u8) -> Self {
        let reach = i32::from(radius_cells);
        // |dx| + |dy| <= √2 · reach, in squares.
        Self::within(radius_cells, |dx, dy| (dx.abs() + dy.abs()).pow(2) <= 2 * reach * reach)
    }

    /// The steps in the regular octagon with corners on the axes at `radius_cells`: 4, 12, 28, 48, 72 … of them.
    pub fn octagon_on_corners(radius_cells: u8) -> Self {
        let reach = i32::from(radius_cells);
        // long + (√2 − 1) · short <= reach for the longer and the shorter of |dx| and |dy|, in squares.
        Self::within(radius_cells, |dx, dy| {
            let (long, short) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
            2 * short * short <= (reach - long + short).pow(2)
        })
    }

    fn within(radius_cells: u8, keep: impl Fn(i32, i32) -> bool) -> Self {
        let reach = i32::from(radius_cells);
        let falling = || (-reach..=reach).rev();
        let steps = falling()
            .flat_map(|dx| falling().map(move |dy| [dx, dy]))
            .filter(|&[dx, dy]| (dx, dy) != (0, 0) && keep(dx, dy))
            .collect();
        Self { steps }
    }

    /// The steps in their order.
    pub fn steps(&self) -> &[[i32; 2]] {
        &self.steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::DIRECTIONS;

    #[test]
    fn blocks_and_discs_have_the_known_sizes() {
        assert_eq!(Offsets::square(1).steps(), DIRECTIONS);
        assert_eq!([1, 2, 3, 4].map(|k| Offsets::square(k).steps().len()), [8, 24, 48, 80]);
        // Lattice points in a circle less its centre: OEIS A000328.
        assert_eq!([1, 2, 3, 4, 5].map(|r| Offsets::octagon(r).steps().len()), [4, 12, 36, 56, 96]);
        assert_eq!(
            [1, 2, 3, 4, 5].map(|r| Offsets::octagon_on_corners(r).steps().len()),
            [4, 12, 28, 48, 72]
        );
        assert_eq!([1, 2, 3, 4, 5, 6].map(|r| Offsets::disc(r).steps().len()), [4, 12, 28, 48, 80, 112]);
    }

    #[test]
    fn small_octagons_are_squares_and_large_ones_discs() {
        assert_eq!(Offsets::octagon_on_corners(4), Offsets::disc(4));
        assert_ne!(Offsets::octagon_on_corners(5), Offsets::disc(5));
        // Of these none but 48 has a whole radius.
        let octagon = |radius: f64| {
            let is_in = |dx: i32, dy: i32| {
                let (long, short) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
                f64::from(long) + (2.0_f64.sqrt() - 1.0) * f64::from(short) <= radius
            };
            Offsets::within(9, is_in)
        };
        let same = [Offsets::square(1), Offsets::square(2), Offsets::disc(4), Offsets::disc(5)];
        assert_eq!([1.5, 2.9, 4.0, 5.25].map(octagon), same);
    }

    #[test]
    fn every_step_has_its_reverse_at_the_mirrored_place() {
        for offsets in [Offsets::square(3), Offsets::disc(5)] {
            let steps = offsets.steps();
            for (&[dx, dy], &mirrored) in steps.iter().zip(steps.iter().rev()) {
                assert_eq!(mirrored, [-dx, -dy]);
            }
        }
    }
}
