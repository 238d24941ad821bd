//! Length and turns of a polyline.

/// Legs that turn by less than this go straight on.
const STRAIGHT_RAD: f64 = 1e-9;

/// Which angle at a bend is summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnAngle {
    /// By how much the direction changes: 45° where an octile path leaves a straight for a diagonal.
    Exterior,
    /// The angle between the two legs, 180° less the exterior one; straight joints are no bends and add nothing.
    Interior,
}

/// The length of the polyline through `points`, in their unit; 0 for fewer than two.
pub fn path_length<P: AsRef<[f64]>>(points: &[P]) -> f64 {
    points.windows(2).fold(0.0, |length, pair| length + norm(leg([pair[0].as_ref(), pair[1].as_ref()])))
}

/// The sum of the angles at all bends of the polyline through `points`, in degrees. Repeated points are passed
/// over; two legs bend if they turn by at least 1e-9 rad.
pub fn turn_sum_deg<P: AsRef<[f64]>>(points: &[P], angle: TurnAngle) -> f64 {
    let mut before = None;
    let legs = points.windows(2).map(|pair| [pair[0].as_ref(), pair[1].as_ref()]);
    let turns = legs.filter(|ends| norm(leg(*ends)) > 0.0).filter_map(|ends| {
        let before = before.replace(ends)?;
        Some(angle_between(before, ends))
    });
    turns
        .filter(|&turn_rad| turn_rad >= STRAIGHT_RAD)
        .map(f64::to_degrees)
        .map(|turn_deg| match angle {
            TurnAngle::Exterior => turn_deg,
            TurnAngle::Interior => 180.0 - turn_deg,
        })
        .sum()
}

/// The vector from the first to the second of two points.
pub(super) fn leg([from, to]: [&[f64]; 2]) -> impl Iterator<Item = f64> + Clone {
    from.iter().zip(to).map(|(from, to)| to - from)
}

fn norm(vector: impl Iterator<Item = f64>) -> f64 {
    vector.map(|x| x * x).sum::<f64>().sqrt()
}

/// The angle between two legs by Kahan's formula, accurate for small and for large angles; in 0..=π.
fn angle_between(u: [&[f64]; 2], v: [&[f64]; 2]) -> f64 {
    let [of_u, of_v] = [u, v].map(|ends| norm(leg(ends)));
    let scaled = |sign: f64| norm(leg(u).zip(leg(v)).map(|(u, v)| u * of_v + sign * v * of_u));
    2.0 * libm::atan2(scaled(-1.0), scaled(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_turns_of_known_polylines() {
        let cases: [(&[[f64; 2]], f64, f64, f64); 5] = [
            (&[[1.0, 1.0]], 0.0, 0.0, 0.0),
            (&[[0.0, 0.0], [3.0, 4.0]], 5.0, 0.0, 0.0),
            (&[[0.0, 0.0], [1.0, 1.0], [4.0, 4.0], [4.0, 6.0]], 4.0 * 2.0_f64.sqrt() + 2.0, 45.0, 135.0),
            (&[[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0]], 4.0, 90.0, 90.0),
            (&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]], 3.0, 180.0, 0.0),
        ];
        for (points, length, exterior_deg, interior_deg) in cases {
            assert!((path_length(points) - length).abs() < 1e-12, "{points:?}");
            for (angle, truth) in [(TurnAngle::Exterior, exterior_deg), (TurnAngle::Interior, interior_deg)] {
                let got = turn_sum_deg(points, angle);
                assert!((got - truth).abs() < 1e-9, "{points:?} {angle:?}: {got}");
            }
        }
    }

    #[test]
    fn a_turn_in_space_is_the_angle_of_its_plane() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 1.0]];
        assert!((turn_sum_deg(&points, TurnAngle::Exterior) - 90.0).abs() < 1e-12);
        assert!((path_length(&points) - (1.0 + 2.0_f64.sqrt())).abs() < 1e-15);
    }

    #[test]
    fn collinear_points_add_no_interior_angle() {
        // Legs of 1, 2 … steps along a direction whose norm is irrational.
        for [dx, dy] in [[1.0, 1.0], [3.0, 7.0], [-5.0, 2.0], [1.0, -9.0]] {
            let points: Vec<[f64; 2]> = [0.0, 1.0, 3.0, 6.0, 13.0].iter().map(|t| [t * dx, t * dy]).collect();
            assert_eq!(turn_sum_deg(&points, TurnAngle::Interior), 0.0, "({dx}, {dy})");
        }
    }
}
