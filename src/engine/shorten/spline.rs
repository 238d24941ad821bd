//! Cubic B-splines in space, uniform, with control points that may be repeated.

/// Points on the cubic B-spline of `control`, `per_span` a span, from its first control point to its last.
///
/// `multiplicity` says how often each control point counts, 1 to 3; the two ends always count three times, so that
/// the curve starts and ends there. A point that counts three times is passed through, along the straight lines to
/// its neighbours. Each returned point carries the index of the control point at whose place the span stands.
///
/// # Source
/// Piegl & Tiller, *The NURBS Book* (1997), section 2.2, with uniform knots.
pub fn cubic_spline(control: &[[f64; 3]], multiplicity: &[u8], per_span: u32) -> Vec<(usize, [f64; 3])> {
    let Some(last) = control.len().checked_sub(1) else { return Vec::new() };
    let times = |i: usize| if i == 0 || i == last { 3 } else { usize::from(multiplicity[i].clamp(1, 3)) };
    let repeated: Vec<usize> = (0..control.len()).flat_map(|i| std::iter::repeat_n(i, times(i))).collect();
    let mut points = vec![(0, control[0])];
    for span in repeated.windows(4) {
        for k in 1..=per_span {
            let weights = basis(f64::from(k) / f64::from(per_span));
            let mut point = [0.0; 3];
            for (&index, weight) in span.iter().zip(weights) {
                for (at, from) in point.iter_mut().zip(control[index]) {
                    *at += weight * from;
                }
            }
            points.push((span[1], point));
        }
    }
    points
}

/// The weights of a span's four control points.
fn basis(u: f64) -> [f64; 4] {
    let v = 1.0 - u;
    [
        v * v * v / 6.0,
        (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
        (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0,
        u * u * u / 6.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNER: [[f64; 3]; 5] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [2.0, 2.0, 1.0]];

    #[test]
    fn the_curve_goes_from_end_to_end_and_rounds_a_corner_unless_it_counts_three_times() {
        let nearest = |multiplicity: [u8; 5]| {
            let curve = cubic_spline(&CORNER, &multiplicity, 16);
            assert_eq!(curve[0].1, CORNER[0]);
            assert!(curve[curve.len() - 1].1.iter().zip(CORNER[4]).all(|(a, b)| (a - b).abs() < 1e-12));
            let apart = |p: &[f64; 3]| p.iter().zip(CORNER[2]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            curve.iter().map(|(_, p)| apart(p).sqrt()).fold(f64::INFINITY, f64::min)
        };
        // At an even corner the curve passes at a sixth of both legs: (1 + 1)/6 of the way, √2 / 6 off.
        assert!((nearest([1; 5]) - 2.0_f64.sqrt() / 6.0).abs() < 1e-12);
        assert!(nearest([1, 1, 3, 1, 1]) < 1e-12);
    }

    #[test]
    fn weights_add_up_to_one_and_spans_join_with_two_derivatives() {
        let third = 1e-4;
        for u in [0.0, 0.3, 1.0] {
            assert!((basis(u).iter().sum::<f64>() - 1.0).abs() < 1e-15);
        }
        // The end of one span and the start of the next see the same curve, one control point on.
        let second = |at: f64| {
            let [a, b, c] = [at - third, at, at + third].map(basis);
            std::array::from_fn::<f64, 4, _>(|i| (a[i] - 2.0 * b[i] + c[i]) / (third * third))
        };
        let (end, start) = (second(1.0), second(0.0));
        for i in 0..3 {
            assert!((basis(1.0)[i + 1] - basis(0.0)[i]).abs() < 1e-15);
            assert!((end[i + 1] - start[i]).abs() < 1e-5, "{end:?} {start:?}");
        }
    }
}
