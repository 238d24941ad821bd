//! Many points at once.

/// The least and the greatest height of `points` over the plane of all x with `normal · x = offset`, in units of the
/// normal's length; infinite the wrong way round if there are no points.
pub fn heights_over(points: &[[f64; 3]], normal: [f64; 3], offset: f64) -> (f64, f64) {
    let height = |p: &[f64; 3]| normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset;
    points
        .iter()
        .map(height)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| (low.min(height), high.max(height)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_signed_and_those_of_the_outermost_points() {
        let points = [[0.0, 0.0, 3.0], [5.0, -7.0, -1.0], [1.0, 1.0, 2.0]];
        assert_eq!(heights_over(&points, [0.0, 0.0, 1.0], 1.0), (-2.0, 2.0));
        assert_eq!(heights_over(&points, [0.0, -2.0, 0.0], 0.0), (-2.0, 14.0));
        assert_eq!(heights_over(&[], [1.0, 0.0, 0.0], 0.0), (f64::INFINITY, f64::NEG_INFINITY));
    }
}
