//! The incomplete beta function, and the tails of Student's t and Fisher's F that follow from it; tails of Pearson's χ².

use super::proportion::bisect;

/// The regularised incomplete beta function, by its continued fraction; relative errors stay near 1e-14.
///
/// # Source
/// Press et al., *Numerical Recipes*, 3rd edition (2007), section 6.4, evaluated by the modified Lentz method.
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return f64::from(x >= 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let log_scale = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    let front = libm::exp(log_scale + a * libm::log(x) + b * libm::log1p(-x)) / a;
    let not_zero = |value: f64| if value.abs() < 1e-300 { 1e-300 } else { value };
    let mut above = 1.0;
    let mut below = 1.0 / not_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = below;
    for step in 1..10_000 {
        let m = f64::from(step);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for term in [even, odd] {
            below = 1.0 / not_zero(1.0 + term * below);
            above = not_zero(1.0 + term / above);
            change = above * below;
            fraction *= change;
        }
        if (change - 1.0).abs() < 1e-15 {
            break;
        }
    }
    front * fraction
}

/// P(F > `statistic`) of Fisher's F with these degrees of freedom above and below.
pub fn f_above(statistic: f64, above: f64, below: f64) -> f64 {
    incomplete_beta(below / (below + above * statistic.max(0.0)), below / 2.0, above / 2.0)
}

/// The two-sided multiplier of Student's t at a `level`: 2.228 for 0.95 and ten degrees of freedom.
///
/// # Panics
/// If `level` is not inside (0, 1), or there are no degrees of freedom.
pub fn student_multiplier(level: f64, degrees: f64) -> f64 {
    assert!(level > 0.0 && level < 1.0 && degrees > 0.0, "level {level}, {degrees} degrees of freedom");
    // T² is an F with one degree of freedom above.
    bisect(0.0, 1e6, |t| f_above(t * t, 1.0, degrees) > 1.0 - level)
}

/// P(χ² > `statistic`) with twice `pairs` degrees of freedom.
pub fn chi_square_above(statistic: f64, pairs: usize) -> f64 {
    let half = statistic / 2.0;
    let terms = (1..pairs).scan(1.0, |term, j| {
        *term *= half / j as f64;
        Some(*term)
    });
    libm::exp(-half) * (1.0 + terms.sum::<f64>())
}

/// The probability of numbers as small as these independent p-values, taken together.
///
/// # Source
/// Fisher, *Statistical Methods for Research Workers*, 4th edition (1932), section 21.1.
pub fn combined(p_values: &[f64]) -> f64 {
    if p_values.contains(&0.0) {
        return 0.0;
    }
    chi_square_above(-2.0 * p_values.iter().map(|p| libm::log(*p)).sum::<f64>(), p_values.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, printed: f64) {
        assert!((found / printed - 1.0).abs() < 1e-9, "{found:e}, not {printed:e}");
    }

    #[test]
    fn tails_and_multipliers_are_those_that_scipy_gives() {
        // scipy.stats: f.sf, t.ppf, chi2.sf.
        near(f_above(4.2, 3.0, 12.0), 0.030_102_077_575_266_634);
        near(f_above(0.3, 20.0, 480.0), 0.998_793_714_905_627);
        near(f_above(60.0, 6.0, 494.0), 1.058_226_054_532_502_9e-55);
        near(student_multiplier(0.95, 10.0), 2.228_138_851_986_274);
        near(student_multiplier(0.95, 499.0), 1.964_729_390_987_688_6);
        near(student_multiplier(0.99, 1.0), 63.656_741_162_871_53);
        near(chi_square_above(18.307_038_053_275_14, 5), 0.05);
        near(chi_square_above(300.0, 2), 1.083_439_491_947_837e-63);
    }

    #[test]
    fn independent_p_values_are_taken_together_as_fisher_did() {
        near(combined(&[0.37]), 0.37);
        let product: f64 = 0.2 * 0.05;
        near(combined(&[0.2, 0.05]), product * (1.0 - libm::log(product)));
        assert_eq!(combined(&[0.5, 0.0]), 0.0);
    }
}
