//! The joint test of a printed table of means, whose cells share their instances, against instances of our own.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use stats::beta::f_above;
use stats::means::FEWEST_NORMAL;

/// How far a printed mean is from ours, in standard errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Apart {
    /// The cell.
    pub cell: usize,
    /// The cell that it is taken from, where the difference of two is meant.
    pub from: Option<usize>,
    /// The number of standard errors, above 0 where more is printed.
    pub errors: f64,
}

/// Means of cells that share their instances, with what they vary by together.
pub struct Products {
    /// The means, by cell.
    pub means: Vec<f64>,
    /// The sums of products of what each instance is apart from the means, by cell and cell.
    pub products: DMatrix<f64>,
    /// How many instances.
    pub units: usize,
}

impl Products {
    /// The products of `instances`, each with `cells` cells in one order.
    ///
    /// # Panics
    /// If an instance lacks a cell.
    pub fn new(instances: &[Vec<f64>], cells: usize) -> Self {
        let units = instances.len();
        let means: Vec<f64> = (0..cells)
            .map(|cell| instances.iter().map(|instance| instance[cell]).sum::<f64>() / units as f64)
            .collect();
        let centred = DMatrix::from_fn(units, cells, |unit, cell| instances[unit][cell] - means[cell]);
        Self { means, products: centred.tr_mul(&centred), units }
    }
}

/// The joint test of printed means that share their instances.
pub struct JointTest {
    /// Our means, by cell.
    pub means: Vec<f64>,
    covariance: DMatrix<f64>,
    root: Cholesky<f64, Dyn>,
    units: usize,
}

impl JointTest {
    /// The test of our means against means of `printed_of` instances that are rounded by up to `rounding` in each cell.
    /// None unless instances outnumber cells by [`FEWEST_NORMAL`].
    pub fn new(ours: Products, printed_of: usize, rounding: &[f64]) -> Option<Self> {
        let Products { means, products, units } = ours;
        let cells = rounding.len();
        if cells == 0 || printed_of == 0 || units < cells + FEWEST_NORMAL {
            return None;
        }
        let scale = (1.0 / printed_of as f64 + 1.0 / units as f64) / (units - 1) as f64;
        let rounded = DVector::from_iterator(cells, rounding.iter().map(|half| half * half / 3.0));
        let covariance = products * scale + DMatrix::from_diagonal(&rounded);
        let root = covariance.clone().cholesky()?;
        Some(Self { means, covariance, root, units })
    }

    /// T² of printed means that are `apart` from ours: δᵀ [(1/N + 1/M) S + ρ²/3 I]⁻¹ δ.
    pub fn statistic(&self, apart: &[f64]) -> f64 {
        let apart = DVector::from_column_slice(apart);
        apart.dot(&self.root.solve(&apart))
    }

    /// The probability of a T² as large as this one: the upper tail of an F with k and M − k degrees of freedom.
    ///
    /// # Source
    /// Hotelling, "The generalization of Student's ratio", Annals of Mathematical Statistics 2 (1931) 360–378.
    pub fn probability(&self, statistic: f64) -> f64 {
        let cells = self.means.len() as f64;
        let units = self.units as f64;
        f_above(statistic * (units - cells) / (cells * (units - 1.0)), cells, units - cells)
    }

    /// The cells, and the differences of two cells, that are farthest from what is printed; the farthest first.
    pub fn loudest(&self, apart: &[f64], count: usize) -> Vec<Apart> {
        let cells = apart.len();
        let variance = |one: usize, other: usize| self.covariance[(one, other)];
        let alone = (0..cells).map(|cell| Apart {
            cell,
            from: None,
            errors: apart[cell] / variance(cell, cell).sqrt(),
        });
        let pairs = (0..cells).flat_map(|cell| (0..cell).map(move |from| (cell, from)));
        let differences = pairs.map(|(cell, from)| {
            let variance = variance(cell, cell) + variance(from, from) - 2.0 * variance(cell, from);
            Apart { cell, from: Some(from), errors: (apart[cell] - apart[from]) / variance.sqrt() }
        });
        let mut all: Vec<Apart> = alone.chain(differences).collect();
        all.sort_by(|one, other| other.errors.abs().total_cmp(&one.errors.abs()));
        all.truncate(count);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed::{self, Stream};
    use rand::RngExt as _;
    use stats::proportion::normal_quantile;

    fn normal(stream: &mut Stream) -> f64 {
        normal_quantile(stream.random::<f64>().clamp(1e-12, 1.0 - 1e-12))
    }

    /// Instances of three cells that correlate: two up to 0.99, one of another size.
    fn correlated(stream: &mut Stream, count: usize) -> Vec<Vec<f64>> {
        let one = |_| {
            let shared = normal(stream);
            vec![
                100.0 + 10.0 * shared,
                101.0 + 10.0 * shared + normal(stream),
                1000.0 + 50.0 * shared + 200.0 * normal(stream),
            ]
        };
        (0..count).map(one).collect()
    }

    fn mean_row(instances: &[Vec<f64>]) -> Vec<f64> {
        let mean = |cell: usize| instances.iter().map(|one| one[cell]).sum::<f64>() / instances.len() as f64;
        (0..3).map(mean).collect()
    }

    #[test]
    fn a_joint_test_of_correlated_cells_refuses_as_often_as_it_says_and_sees_differences() {
        let mut stream = seed::stream(seed::derive(62, &["means"]));
        let mut refused = 0;
        let mut seen = 0;
        let mut cells_seen = 0;
        for _ in 0..400 {
            let theirs = mean_row(&correlated(&mut stream, 100));
            let test =
                JointTest::new(Products::new(&correlated(&mut stream, 200), 3), 100, &[0.005; 3]).unwrap();
            let apart: Vec<f64> = theirs.iter().zip(&test.means).map(|(own, mean)| own - mean).collect();
            refused += u32::from(test.probability(test.statistic(&apart)) < 0.05);
            // The second cell less the first is off by half a unit; each cell by itself hides it.
            let shifted = [apart[0], apart[1] + 0.7, apart[2]];
            seen += u32::from(test.probability(test.statistic(&shifted)) < 0.05);
            let loudest = test.loudest(&shifted, 1)[0];
            cells_seen += u32::from((loudest.cell, loudest.from) == (1, Some(0)));
        }
        assert!((8..=36).contains(&refused), "seed 62: {refused} of 400 at 5 %");
        assert!(seen > 380 && cells_seen > 380, "seed 62: {seen} and {cells_seen} of 400");
    }

    #[test]
    fn cells_that_are_equal_on_every_instance_are_apart_by_rounding_alone() {
        let instances: Vec<Vec<f64>> = (0..100).map(|i| vec![f64::from(i); 2]).collect();
        let test = JointTest::new(Products::new(&instances, 2), 100, &[0.005; 2]).unwrap();
        let p = |apart: [f64; 2]| test.probability(test.statistic(&apart));
        assert!(p([1.0, 1.0]) > 0.9, "{}", p([1.0, 1.0]));
        assert!(p([1.0, 1.004]) > 0.05 && p([1.0, 1.1]) < 1e-6, "{} {}", p([1.0, 1.004]), p([1.0, 1.1]));
        assert!(JointTest::new(Products::new(&instances[..31], 2), 100, &[0.005; 2]).is_none());
    }
}
