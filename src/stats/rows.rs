//! Whether a printed row of several cells, as a whole, could be one of ours.

use super::proportion::Rank;
use super::summary;
use super::summary::{mean, standard_deviation};

/// The probability that a row with one independent instance per cell never falls from a cell to the next.
///
/// `instances` has one list per cell, in the order of the row; a cell draws from its list. The probability is computed
/// exactly, by running through the values in rising order. A row without cells never falls; none if a cell has no
/// instances.
///
/// # Panics
/// If an instance is NaN.
pub fn monotone_probability(cells: &[Vec<f64>]) -> Option<f64> {
    // Values the row may stand at, rising, with the probability that it got there without a fall.
    let mut reached: Vec<(f64, f64)> = vec![(f64::NEG_INFINITY, 1.0)];
    for cell in cells {
        let instances = summary::sorted(cell);
        let each = 1.0 / instances.len() as f64;
        let mut below = reached.iter().peekable();
        let mut so_far = 0.0;
        let mut next = Vec::new();
        for &instance in &instances {
            while let Some((_, mass)) = below.next_if(|(value, _)| *value <= instance) {
                so_far += mass;
            }
            next.push((instance, so_far * each));
        }
        reached = next;
    }
    (!reached.is_empty()).then(|| reached.iter().map(|(_, mass)| mass).sum())
}

/// The distance of a row from the mean curve, in standard deviations of each cell: `√ mean ((y - m) / s)²`.
///
/// Cells at which the instances do not vary count only if the row differs there, and then make the distance
/// infinite. Where it ranks among the distances of our own instances says how typical the row is.
///
/// # Panics
/// If the lists differ in length.
pub fn distance_to_mean(row: &[f64], mean: &[f64], deviation: &[f64]) -> f64 {
    assert!(row.len() == mean.len() && row.len() == deviation.len(), "rows of {} cells", row.len());
    let cells = row.iter().zip(mean).zip(deviation);
    let squares = cells.map(|((y, m), s)| if y == m { 0.0 } else { (y - m) * (y - m) / (s * s) });
    (squares.sum::<f64>() / row.len().max(1) as f64).sqrt()
}

/// A row's distance to the mean row of instances, and how many of the instances, each against the mean of the others, are at least as
/// far.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// The row's distance to the mean row, in standard deviations a cell.
    pub distance: f64,
    /// Instances that are as far from the mean of the others.
    pub as_far: usize,
    /// All instances.
    pub instances: usize,
}

impl Place {
    /// Where `row` stands among the instances whose values by cell are `cells`; none below three instances.
    pub fn new(row: &[f64], cells: &[Vec<f64>]) -> Option<Self> {
        let instances = cells.iter().map(Vec::len).min().filter(|instances| *instances > 2)?;
        let curve = |left_out: Option<usize>| -> Option<(Vec<f64>, Vec<f64>)> {
            let kept = |cell: &Vec<f64>| -> Vec<f64> {
                cell.iter().enumerate().filter(|(i, _)| Some(*i) != left_out).map(|(_, y)| *y).collect()
            };
            let kept: Vec<Vec<f64>> = cells.iter().map(kept).collect();
            let means = kept.iter().map(|cell| mean(cell)).collect::<Option<_>>()?;
            // A cell at which all instances agree is given the spread of one query in ten of one instance in all.
            let least = 10.0 / (instances as f64).sqrt();
            let spreads =
                kept.iter().map(|cell| Some(standard_deviation(cell)?.max(least))).collect::<Option<_>>()?;
            Some((means, spreads))
        };
        let (means, spreads) = curve(None)?;
        let distance = distance_to_mean(row, &means, &spreads);
        let mut as_far = 0;
        for instance in 0..instances {
            let (means, spreads) = curve(Some(instance))?;
            let own: Vec<f64> = cells.iter().map(|cell| cell[instance]).collect();
            as_far += usize::from(distance_to_mean(&own, &means, &spreads) >= distance);
        }
        Some(Self { distance, as_far, instances })
    }
}

/// On which side of the mean row of instances a row lies.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Cells in which the mean is below the row, and all.
    pub short: [usize; 2],
    /// The mean over cells of the mean row less the row.
    pub difference: f64,
    /// The row's mean among the means of the instances.
    pub rank: Rank,
    /// Instances that are at or above the row in every cell.
    pub dominating: usize,
}

impl Level {
    /// The level of `row` beside the instances whose values by cell are `cells`; none without instances.
    pub fn new(row: &[f64], cells: &[Vec<f64>]) -> Option<Self> {
        let means: Vec<f64> = cells.iter().map(|cell| mean(cell)).collect::<Option<_>>()?;
        let instances = cells.iter().map(Vec::len).min()?;
        let of_instance = |instance: usize| cells.iter().map(move |cell| cell[instance]);
        let levels: Vec<f64> =
            (0..instances).filter_map(|instance| mean(&of_instance(instance).collect::<Vec<_>>())).collect();
        let dominates =
            |instance: &usize| of_instance(*instance).zip(row).all(|(own, printed)| own >= *printed);
        Some(Self {
            short: [means.iter().zip(row).filter(|(own, printed)| own < printed).count(), row.len()],
            difference: mean(&means)? - mean(row)?,
            rank: Rank::new(mean(row)?, &levels),
            dominating: (0..instances).filter(dominates).count(),
        })
    }
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
        // Three instances of one continuous distribution with no ties across cells: 1/3! on average; here by hand.
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

    #[test]
    fn a_row_like_the_instances_is_near_and_an_opposite_one_is_far() {
        // Forty instances of three cells that rise from about 10 to about 90 with a spread of ten.
        let cells: Vec<Vec<f64>> = [10.0, 50.0, 90.0]
            .iter()
            .map(|middle| (0..40).map(|i| middle + f64::from(i * 7 % 21) - 10.0).collect())
            .collect();
        let near = Place::new(&[12.0, 47.0, 93.0], &cells).unwrap();
        assert!(near.as_far > 25, "{} of {}", near.as_far, near.instances);
        let far = Place::new(&[90.0, 50.0, 10.0], &cells).unwrap();
        assert_eq!((far.as_far, far.instances), (0, 40));
        assert!(Place::new(&[0.0], &[vec![0.0, 1.0]]).is_none());
    }

    #[test]
    fn cells_without_spread_do_not_make_every_other_value_infinitely_far() {
        let cells = vec![vec![100.0; 50], (0..50).map(|i| f64::from(i % 11) * 10.0).collect()];
        let place = Place::new(&[90.0, 50.0], &cells).unwrap();
        assert!(place.distance.is_finite() && place.distance > 1.0, "{}", place.distance);
    }
}
