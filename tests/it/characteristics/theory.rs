//! What theory says of how often a rule errs, and draws of known distributions.

use base::seed::Stream;
use rand::RngExt as _;
use stats::proportion::{normal_multiplier, normal_quantile};

/// Level of every interval.
const LEVEL: f64 = 0.95;

/// A standard normal number.
pub fn normal(stream: &mut Stream) -> f64 {
    normal_quantile(stream.random::<f64>().clamp(1e-12, 1.0 - 1e-12))
}

/// How often one end of a percentile bootstrap interval of a mean of `n` normal instances lies on the wrong side of the truth.
///
/// The bootstrap's standard error has the divisor n, so that its end lies where Student's t is z √((n − 1) / n).
///
/// # Source
/// Hesterberg, "What Teachers Should Know About the Bootstrap", The American Statistician 69 (2015) 371–386, section 5.2.
pub fn one_end(n: usize) -> f64 {
    let n = n as f64;
    student_above(normal_multiplier(LEVEL) * ((n - 1.0) / n).sqrt(), n - 1.0)
}

/// [`one_end`], on the side of the long tail, of instances whose distribution has this skewness.
///
/// # Source
/// Hall, *The Bootstrap and Edgeworth Expansion* (1992), sections 2.4 and 3.4: the first-order error of the percentile
/// method's end, γ (z² + 2) φ(z) / (6 √n).
pub fn one_end_of_skewed(n: usize, skewness: f64) -> f64 {
    let z = normal_multiplier(LEVEL);
    one_end(n) + skewness * (z * z + 2.0) * normal_density(z) / (6.0 * (n as f64).sqrt())
}

/// How often one end of a percentile bootstrap interval of a median of `n` draws lies on the wrong side: the end is an order
/// statistic, so that a binomial tail is exceeded by one of its terms at most.
pub fn one_end_of_median(n: usize) -> f64 {
    let z = normal_multiplier(LEVEL);
    (1.0 - LEVEL) / 2.0 + 2.0 * normal_density(z) / (n as f64).sqrt()
}

/// How often a normal instance that is `shift` standard deviations off lies where 95 % of instances lie.
pub fn taken_for_ordinary(shift: f64) -> f64 {
    let z = normal_multiplier(LEVEL);
    normal_below(z - shift) - normal_below(-z - shift)
}

/// How likely a standard normal number lies below `z`.
pub fn normal_below(z: f64) -> f64 {
    libm::erfc(-z / std::f64::consts::SQRT_2) / 2.0
}

fn normal_density(z: f64) -> f64 {
    libm::exp(-z * z / 2.0) / (2.0 * std::f64::consts::PI).sqrt()
}

/// P(T > t) of Student's t with `degrees` of freedom, t ≥ 0: the density integrated by Simpson's rule from 0 to t.
fn student_above(t: f64, degrees: f64) -> f64 {
    let log_scale = libm::lgamma(f64::midpoint(degrees, 1.0))
        - libm::lgamma(degrees / 2.0)
        - libm::log(degrees * std::f64::consts::PI) / 2.0;
    let density = |x: f64| libm::exp(log_scale - f64::midpoint(degrees, 1.0) * libm::log1p(x * x / degrees));
    let step = t / 1000.0;
    let sum: f64 = (1..1000).map(|i| density(f64::from(i) * step) * if i % 2 == 1 { 4.0 } else { 2.0 }).sum();
    0.5 - (density(0.0) + sum + density(t)) * step / 3.0
}

#[test]
fn tails_are_those_of_the_tables() {
    assert!(
        (student_above(2.228, 10.0) - 0.025).abs() < 1e-4 && (student_above(2.571, 5.0) - 0.025).abs() < 1e-4
    );
    assert!((one_end(100_000) - 0.025).abs() < 1e-4 && (one_end(10) - 0.048).abs() < 1e-3, "{}", one_end(10));
    assert!((taken_for_ordinary(0.0) - 0.95).abs() < 1e-9 && taken_for_ordinary(1.0) < 0.84);
}
