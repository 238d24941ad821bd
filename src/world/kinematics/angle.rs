//! Angles modulo a turn.

use std::f64::consts::TAU;

/// The angle that differs from `angle_rad` by whole turns and is nearest to `reference_rad`; the lower one
/// if two are.
#[inline]
pub fn nearest_copy(angle_rad: f64, reference_rad: f64) -> f64 {
    let turns = (reference_rad - angle_rad) * (1.0 / TAU) - 0.5;
    // Most angles are near already, and rounding up is a call on plain x86-64.
    if turns > -1.0 && turns <= 0.0 { angle_rad } else { angle_rad + TAU * turns.ceil() }
}

/// `angle_rad` modulo a turn, in `[-π, π)`.
#[inline]
pub fn wrapped(angle_rad: f64) -> f64 {
    nearest_copy(angle_rad, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_copy_is_whole_turns_away_and_at_most_half_a_turn_from_the_reference() {
        for step in -400..400 {
            let angle = f64::from(step) * 0.07;
            let reference = f64::from(step % 37) * 0.31;
            let copy = nearest_copy(angle, reference);
            let turns = (copy - angle) / TAU;
            assert!((turns - turns.round()).abs() < 1e-12, "{angle} near {reference}: {copy}");
            assert!((copy - reference).abs() <= PI + 1e-12, "{angle} near {reference}: {copy}");
        }
    }

    #[test]
    fn of_two_equally_near_copies_the_lower_is_taken() {
        assert_eq!(wrapped(PI), -PI);
        assert_eq!(wrapped(-PI), -PI);
        assert_eq!(nearest_copy(0.0, PI), 0.0);
        assert_eq!(nearest_copy(0.0, 3.0 * PI), TAU);
    }
}
