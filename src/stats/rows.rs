//! What a printed row of several cells says as a whole.

use super::summary;

/// The probability that a row with one independent draw per cell never falls from a cell to the next.
///
/// Each cell's distribution is that of its `draws`, one list per cell in the order of the row. The probability
/// is computed exactly by running through the values in rising order, not simulated. A row without cells
/// never falls; none if a cell has no draws.
///
/// # Panics
/// If a draw is NaN.
pub fn monotone_probability(cells: &[Vec<f64>]) -> Option<f64> {
    // Values the row may stand at, rising, with the probability that it got there without a fall.
    let mut reached: Vec<(f64, f64)> = vec![(f64::NEG_INFINITY, 1.0)];
    for cell in cells {
        let draws = summary::sorted(cell);
        let each = 1.0 / draws.len() as f64;
        let (mut below, mut so_far, mut next) = (reached.iter().peekable(), 0.0, Vec::new());
        for &draw in &draws {
            while let Some((_, mass)) = below.next_if(|(value, _)| *value <= draw) {
                so_far += mass;
            }
            next.push((draw, so_far * each));
        }
        reached = next;
    }
    (!reached.is_empty()).then(|| reached.iter().map(|(_, mass)| mass).sum())
}

/// The distance of a row from the mean curve, in standard deviations of each cell: `√ mean ((y - m) / s)²`.
///
/// Cells at which the draws do not vary count only if the row differs there, and then make the distance
/// infinite. Where it ranks among the distances of our own draws says how typical the row is.
///
/// # Panics
/// If the lists differ in length.
pub fn distance_to_mean(row: &[f64], mean: &[f64], deviation: &[f64]) -> f64 {
    assert!(row.len() == mean.len() && row.len() == deviation.len(), "rows of {} cells", row.len());
    let cells = row.iter().zip(mean).zip(deviation);
    let squares = cells.map(|((y, m), s)| if y == m { 0.0 } else { (y - m) * (y - m) / (s * s) });
    (squares.sum::<f64>() / row.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use rand::RngExt as _;

    use super::*;
    use base::seed;

    #[test]
    fn the_probability_is_what_drawing_rows_finds() {
        let mut stream = seed::stream(seed::derive(77, &["rows"]));
        let (mut least, mut most) = (1.0_f64, 0.0_f64);
        for row in 0..12 {
            // Shares in tenths that rise with the cell, as success rates of ten queries do.
            let cells: Vec<Vec<f64>> = (0..5)
                .map(|cell| {
                    (0..30).map(|_| f64::from(stream.random_range(0..=3) + cell * (row % 4)) / 10.0).collect()
                })
                .collect();
            let exact = monotone_probability(&cells).unwrap();
            let rises = (0..20_000).filter(|_| {
                let drawn: Vec<f64> = cells.iter().map(|c| c[stream.random_range(0..c.len())]).collect();
                drawn.is_sorted()
            });
            let found = rises.count() as f64 / 20_000.0;
            assert!((found - exact).abs() < 0.015, "seed 77 row {row}: {found}, not {exact}");
            (least, most) = (least.min(exact), most.max(exact));
        }
        assert!(least < 0.1 && most > 0.7, "one-sided sample: {least} to {most}");
    }

    #[test]
    fn rows_that_must_rise_do_and_rows_that_must_fall_do_not() {
        assert_eq!(monotone_probability(&[vec![0.0], vec![0.0], vec![1.0]]), Some(1.0));
        assert_eq!(monotone_probability(&[vec![1.0], vec![0.0, 0.5]]), Some(0.0));
        // Three draws of one continuous distribution with no ties across cells: 1/3! on average; here by hand.
        assert_eq!(monotone_probability(&[vec![1.0, 4.0], vec![2.0, 3.0]]), Some(0.5));
        assert_eq!(monotone_probability(&[]), Some(1.0));
        assert_eq!(monotone_probability(&[vec![1.0], vec![]]), None);
    }

    #[test]
    fn the_distance_is_one_for_a_row_one_deviation_off_everywhere() {
        assert_eq!(distance_to_mean(&[1.0, 5.0], &[0.0, 3.0], &[1.0, 2.0]), 1.0);
        assert_eq!(distance_to_mean(&[1.0, 3.0], &[1.0, 3.0], &[0.0, 2.0]), 0.0);
        assert_eq!(distance_to_mean(&[2.0, 3.0], &[1.0, 3.0], &[0.0, 2.0]), f64::INFINITY);
    }
}
