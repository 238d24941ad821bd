//! Statements of a paper about its own numbers and formulas.

use super::Proof;

/// Whether every printed number that is said to be above another is: of each pair what it is called and what it prints, the
/// higher one first.
pub fn printed_above(pairs: &[[(String, f64); 2]]) -> Proof {
    let contrary = pairs.iter().filter(|[above, below]| above.1 <= below.1);
    let contrary = contrary
        .map(|[(above, more), (below, less)]| format!("`{above}` prints {more} and `{below}` {less}"));
    let contrary: Vec<String> = contrary.collect();
    let said = match &contrary[..] {
        [] => format!("each of the {} printed pairs is as the sentence says", pairs.len()),
        contrary => format!("the paper's own numbers contradict the sentence: {}", contrary.join("; ")),
    };
    let premise = "the sentence speaks of every printed pair, and above is not equal";
    Proof { is_possible: contrary.is_empty(), because: vec![said], premises: vec![premise.to_owned()] }
}

/// Whether each row of `table` lists as many `points` as the text says; of each row its label and how many it lists.
pub fn listed_points(table: &str, rows: &[(String, usize)], points: usize) -> Proof {
    let said = |(row, count): &(String, usize)| {
        format!("{row} of {table} lists {count} points, and the text says {points}")
    };
    Proof {
        is_possible: rows.iter().all(|(_, count)| *count == points),
        because: rows.iter().map(said).collect(),
        premises: vec![format!("the text speaks of every row of {table}, and a dash is no point")],
    }
}

/// Whether the points that a planar two-link arm cannot take, or takes only stretched or folded, reach as far from its base
/// as stated. Lengths in centimetres.
pub fn reach_ring([l1, l2]: [f64; 2], radius_cm: f64) -> Proof {
    let inner = (l1 - l2).abs();
    let mut because =
        vec![format!("arms of {l1} and {l2} cm reach every point from |{l1} - {l2}| = {inner} cm on")];
    let between = inner.midpoint(radius_cm);
    let cos_q2 = (between * between - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
    because.extend((cos_q2.abs() <= 1.0).then(|| {
        let q2 = -libm::acos(cos_q2);
        format!(
            "at {between} cm from the base, between the two radii, θ2 is {:.1}° and |sin θ2| {:.2}: reached, and not \
             singular",
            q2.to_degrees(),
            libm::sin(q2).abs()
        )
    }));
    let is_right = (inner - radius_cm).abs() < 1e-9;
    let compared = if is_right { "are" } else { "are not" };
    because.push(format!("the stated {radius_cm} cm {compared} that radius"));
    // A stop of joint 2 forbids all that is nearer to the base than the tip at the stop.
    let cos_stop = (radius_cm * radius_cm - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
    let is_stopped = cos_stop.abs() <= 1.0 && !is_right;
    because.extend(is_stopped.then(|| {
        let stop = libm::acos(cos_stop).to_degrees();
        format!("a stop of joint 2 at |θ2| = {stop:.2}° would forbid exactly the disc of {radius_cm} cm")
    }));
    let premise = "the disc is forbidden by what the arm cannot reach, reaches only stretched or folded, or by a stop of \
                   joint 2";
    Proof { is_possible: is_right || is_stopped, because, premises: vec![premise.to_owned()] }
}

/// The repulsive potential of range `d0` at the distance `d`, with the gain left out.
///
/// # Source
/// Tang et al. (2023), eq. 21.
fn potential(d: f64, d0: f64) -> f64 {
    0.5 * (1.0 / d - 1.0 / d0).powi(2)
}

/// The printed force per unit of distance.
///
/// # Source
/// Tang et al. (2023), eq. 24.
fn force(d: f64, d0: f64) -> f64 {
    (1.0 / d0 - 1.0 / d) / (d * d)
}

/// Distances at which the sign of a force is tried, as shares of the range.
const TRIED: usize = 99;

/// Whether the printed repulsive potential of range `d0` falls along the printed force.
pub fn repulsion_along_force(d0: f64) -> Proof {
    let step = 1e-6 * d0;
    let lowers = |k: &usize| {
        let d = d0 * *k as f64 / (TRIED + 1) as f64;
        potential(d + step * force(d, d0).signum(), d0) < potential(d, d0)
    };
    let falls = (1..=TRIED).filter(lowers).count();
    let said = format!(
        "a step along f lowers U at {falls} of {TRIED} distances between 0 and d0; f is +∂U/∂X, as eq. 23 says, so U rises \
         along it"
    );
    let premise = "eqs. 21, 23 and 24 are read as printed".to_owned();
    Proof { is_possible: falls == TRIED, because: vec![said], premises: vec![premise] }
}

/// Whether that potential has a value at the distance 0 to which the paper clamps it.
pub fn repulsion_at_contact(d0: f64) -> Proof {
    let at_contact = potential(0.0, d0);
    let said = format!("U(0) is {at_contact}: 1/d has no value where eq. 6 sets d to 0");
    let premise = "the distance of eq. 6 is the one in eq. 21, as eq. 19 says".to_owned();
    Proof { is_possible: at_contact.is_finite(), because: vec![said], premises: vec![premise] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_force_is_the_potentials_slope_so_that_the_potential_rises_along_it() {
        for d in [0.5, 2.0, 4.9] {
            let slope = (potential(d + 1e-6, 5.0) - potential(d - 1e-6, 5.0)) / 2e-6;
            assert!((slope - force(d, 5.0)).abs() < 1e-6 * slope.abs().max(1.0), "{d}");
        }
        let proof = repulsion_along_force(5.0);
        assert!(!proof.is_possible && proof.because[0].contains("at 0 of 99 distances"), "{proof:?}");
    }

    #[test]
    fn an_inner_disc_has_the_radius_of_the_links_difference_unless_joint_2_has_a_stop() {
        let proof = reach_ring([30.0, 20.0], 10.0);
        assert!(proof.is_possible && !proof.because.concat().contains("stop"), "{proof:?}");
        let proof = reach_ring([30.0, 20.0], 20.0);
        assert!(proof.is_possible && proof.because[1].contains("θ2 is -153.6°"), "{proof:?}");
        assert!(proof.because[3].contains("|θ2| = 138.59°"), "{proof:?}");
        assert!(!reach_ring([30.0, 20.0], 9.0).is_possible && !reach_ring([30.0, 20.0], 51.0).is_possible);
    }
}
