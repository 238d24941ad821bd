//! Formulas of one paper each, evaluated as they are printed and held against what the text says of them.

use crate::proof::Proof;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_8, SQRT_2};

/// A formula with what the text says of it.
pub struct Formula {
    /// Its name in claims.
    pub name: &'static str,
    /// The question to it.
    pub about: &'static str,
    /// What it is evaluated with, each above 0.
    pub takes: &'static [&'static str],
    /// Whether one case among many meets what the text says.
    pub is_existential: bool,
    /// Whether what the text says can be, of numbers in the order of `takes`.
    pub prove: fn(&[f64]) -> Proof,
}

/// Every formula, in the order of their names.
pub static REGISTRY: &[Formula] = &[
    Formula {
        name: "fewest_listed",
        about: "does the row of a table that lists the fewest points list as many as the text says of every row?",
        takes: &["fewest", "said"],
        is_existential: false,
        prove: |with| fewest_listed(with[0], with[1]),
    },
    Formula {
        name: "forbidden_disc",
        about: "can reach, singularity or a stop of joint 2 of a planar two-link arm forbid an inner disc of this radius?",
        takes: &["l1", "l2", "radius"],
        is_existential: false,
        prove: |with| forbidden_disc(with[0], with[1], with[2]),
    },
    Formula {
        name: "octagon_nodes",
        about: "does a regular octagon about a lattice point hold so many other lattice points?",
        takes: &["nodes"],
        is_existential: true,
        prove: |with| octagon_nodes(with[0] as usize),
    },
    Formula {
        name: "repulsion_along_force",
        about: "does a repulsive potential of this range fall along the printed force?",
        takes: &["range"],
        is_existential: false,
        prove: |with| repulsion_along_force(with[0]),
    },
];

/// Largest number that a formula is evaluated with; an octagon of so many nodes is counted in a moment.
const MOST: f64 = 10_000.0;

/// The formula called `name`.
pub fn find(name: &str) -> Option<&'static Formula> {
    REGISTRY.iter().find(|formula| formula.name == name)
}

impl Formula {
    /// The numbers that it takes, in its order.
    ///
    /// # Errors
    /// If others are given than it takes, or one that is not above 0 and at most 10 000.
    pub fn numbers(&self, with: &BTreeMap<String, f64>) -> Result<Vec<f64>, String> {
        let is_taken = |name: &String| self.takes.contains(&name.as_str());
        if with.len() != self.takes.len() || !with.keys().all(is_taken) {
            let given: Vec<&str> = with.keys().map(String::as_str).collect();
            return Err(format!(
                "`{}` is given {}; it takes {}",
                self.name,
                given.join(", "),
                self.takes.join(", ")
            ));
        }
        if let Some((name, value)) = with.iter().find(|(_, value)| !(**value > 0.0 && **value <= MOST)) {
            return Err(format!("{name} is {value}; more than 0 and at most {MOST} is accepted"));
        }
        Ok(self.takes.iter().map(|name| with[*name]).collect())
    }
}

/// Whether a table's shortest row lists as many points as stated.
fn fewest_listed(fewest: f64, stated: f64) -> Proof {
    let because = format!("the shortest row lists {fewest} points, and the text says {stated} of every row");
    let premise = "the text speaks of every row, and a dash is no point".to_owned();
    Proof { is_possible: fewest >= stated, because: vec![because], premises: vec![premise] }
}

/// Whether the points that a planar two-link arm cannot take, or takes only stretched or folded, reach as far from its base
/// as stated. Lengths in centimetres.
fn forbidden_disc(l1: f64, l2: f64, radius_cm: f64) -> Proof {
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
fn repulsion_along_force(d0: f64) -> Proof {
    let step = 1e-6 * d0;
    let lowers = |k: &usize| {
        let d = d0 * *k as f64 / (TRIED + 1) as f64;
        potential(d + step * force(d, d0).signum(), d0) < potential(d, d0)
    };
    let falls = (1..=TRIED).filter(lowers).count();
    let reason = format!(
        "a step along f lowers U at {falls} of {TRIED} distances between 0 and d0; f is +∂U/∂X, as eq. 23 says, so U rises \
         along it"
    );
    let premise = "eqs. 21, 23 and 24 are read as printed".to_owned();
    Proof { is_possible: falls == TRIED, because: vec![reason], premises: vec![premise] }
}

/// Whether any regular octagon about a lattice point holds `nodes` other lattice points.
fn octagon_nodes(nodes: usize) -> Proof {
    let turned = [(true, "with corners on the axes"), (false, "with sides square to the axes")];
    let found = turned.map(|(is_cornered, how)| {
        let found = octagon_counts(nodes, is_cornered);
        let listed: Vec<String> = found.iter().map(|(count, _)| count.to_string()).collect();
        let hit = found.iter().find(|(count, _)| *count == nodes);
        let onset = match hit {
            Some((_, radius)) => format!("{nodes} from a circumradius of {radius:.4} on"),
            None => format!("never {nodes}"),
        };
        let listed = listed.join(", ");
        let text = format!(
            "regular octagons of any size about a lattice point, {how}, hold {listed} others: {onset}"
        );
        (hit.is_some(), text)
    });
    let premise = "the octagon is regular, centred on the node, and turned in one of these two ways";
    Proof {
        is_possible: found.iter().any(|(is_hit, _)| *is_hit),
        because: found.map(|(_, text)| text).to_vec(),
        premises: vec![premise.to_owned()],
    }
}

/// The least circumradius of an octagon about the origin that holds the point; with corners on the axes, or with sides
/// square to them.
fn circumradius([x, y]: [i32; 2], is_cornered: bool) -> f64 {
    let (s, c) = libm::sincos(FRAC_PI_8);
    let (x, y) = (f64::from(x.abs()), f64::from(y.abs()));
    let apothem =
        if is_cornered { f64::max(x * c + y * s, x * s + y * c) } else { x.max(y).max((x + y) / SQRT_2) };
    apothem / c
}

/// How many points octagons of rising size hold, up to `nodes` or the first above, with the circumradius from which each does.
fn octagon_counts(nodes: usize, is_cornered: bool) -> Vec<(usize, f64)> {
    // An octagon of apothem a holds the block of side 2 ⌊a/√2⌋ + 1, so that this reach is enough.
    let reach = libm::sqrt(nodes as f64) as i32 + 3;
    let axis = || -reach..=reach;
    let points = axis().flat_map(|x| axis().map(move |y| [x, y])).filter(|point| *point != [0, 0]);
    let mut radii: Vec<f64> = points.map(|point| circumradius(point, is_cornered)).collect();
    radii.sort_by(f64::total_cmp);
    let is_last = |k: &usize| radii.get(k + 1).is_none_or(|next| next - radii[*k] > 1e-9);
    let counts: Vec<(usize, f64)> = (0..radii.len()).filter(is_last).map(|k| (k + 1, radii[k])).collect();
    let below = counts.iter().take_while(|(count, _)| *count < nodes).count();
    counts[..counts.len().min(below + 1)].to_vec()
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
        let proof = forbidden_disc(30.0, 20.0, 10.0);
        assert!(proof.is_possible && !proof.because.concat().contains("stop"), "{proof:?}");
        let proof = forbidden_disc(30.0, 20.0, 20.0);
        assert!(proof.is_possible && proof.because[1].contains("θ2 is -153.6°"), "{proof:?}");
        assert!(proof.because[3].contains("|θ2| = 138.59°"), "{proof:?}");
        assert!(
            !forbidden_disc(30.0, 20.0, 9.0).is_possible && !forbidden_disc(30.0, 20.0, 51.0).is_possible
        );
    }

    #[test]
    fn a_row_with_a_point_too_few_contradicts_the_text() {
        assert!(fewest_listed(4.0, 4.0).is_possible && !fewest_listed(3.0, 4.0).is_possible);
    }

    #[test]
    fn counts_are_those_of_pointing_at_every_lattice_point() {
        let at = |is_cornered: bool, radius: f64| {
            let all = (-9..=9).flat_map(|x| (-9..=9).map(move |y| [x, y]));
            all.filter(|p| *p != [0, 0] && circumradius(*p, is_cornered) <= radius + 1e-9).count()
        };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 5.0].map(|r| at(true, r)), [4, 12, 28, 48, 72]);
        let apothems = [1.0, 2.0, 3.0, 4.0, 5.0].map(|a: f64| at(false, a / libm::cos(FRAC_PI_8)));
        assert_eq!(apothems, [4, 12, 36, 56, 96]);
        let counts = octagon_counts(48, true);
        assert!(counts.iter().any(|(count, radius)| *count == 48 && (radius - 4.0).abs() < 1e-9));
        assert_eq!(counts.last().map(|(count, _)| *count), Some(48), "it stops there");
        assert!(octagon_nodes(48).is_possible && !octagon_nodes(47).is_possible);
    }

    #[test]
    fn a_formula_takes_its_own_numbers_and_no_others() {
        let given =
            |pairs: &[(&str, f64)]| pairs.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        let disc = find("forbidden_disc").unwrap();
        assert_eq!(
            disc.numbers(&given(&[("radius", 20.0), ("l2", 2.0), ("l1", 3.0)])),
            Ok(vec![3.0, 2.0, 20.0])
        );
        for wrong in [
            &[("l1", 3.0)][..],
            &[("l1", 3.0), ("l2", 2.0), ("r", 1.0)],
            &[("l1", 3.0), ("l2", 0.0), ("radius", 1.0)],
        ] {
            assert!(disc.numbers(&given(wrong)).is_err(), "{wrong:?}");
        }
        assert!(REGISTRY.is_sorted_by_key(|formula| formula.name) && find("none").is_none());
    }
}
