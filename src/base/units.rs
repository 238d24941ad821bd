//! Angles in degrees that seem to be written in radians, and lengths in millimetres that seem to be in metres.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

/// No joint of a robot is faster, radians a second; the fastest that we know turns at 23.6, 1350° a second.
///
/// # Source
/// The tool roll of the A255, in CRS Robotics, *A255 Robot Arm User Guide* (1999), p. 8.
pub const FASTEST_RAD_S: f64 = 25.0;

/// How near to a multiple of an eighth of a turn an angle is that was rounded to two digits behind the point.
const ROUNDED_RAD: f64 = 2e-3;

/// So many digits behind the point make a multiple of a quarter of a turn in radians certain.
const CERTAIN_DIGITS: usize = 3;

/// What settings are often multiples of, in degrees, and how many digits in radians make one certain.
const SETTINGS_DEG: [(f64, usize); 2] = [(5.0, CERTAIN_DIGITS), (1.0, 4)];

/// A tool, a block or a way is longer, and neighbours are farther apart.
const SHORT_MM: f64 = 2.0;

/// No link or obstacle has a smaller radius.
const THIN_MM: f64 = 1.0;

/// The message about a length under the key `key` that seems to be in metres: it is above 0 and shorter than two millimetres.
pub fn seems_in_metres(key: &str, length_mm: f64) -> Option<String> {
    below(SHORT_MM, key, length_mm)
}

/// The message about a radius under the key `key` that seems to be in metres: it is above 0 and below a millimetre.
pub fn radius_in_metres(key: &str, radius_mm: f64) -> Option<String> {
    below(THIN_MM, key, radius_mm)
}

/// The message about points under the keys `keys` that seem to be in metres: some coordinate is not 0, and all are below two millimetres.
pub fn points_in_metres<'a>(keys: &str, points_mm: impl IntoIterator<Item = &'a f64>) -> Option<String> {
    let farthest_mm =
        points_mm.into_iter().fold(0.0, |farthest: f64, coordinate| farthest.max(coordinate.abs()));
    seems_in_metres(&format!("the greatest coordinate of {keys}"), farthest_mm)
}

/// A number worked out from a printed one, without the last digits, which the arithmetic bends: 94.65 for 0.09465 · 1000.
pub fn unbent(number: f64) -> f64 {
    format!("{number:.14e}").parse().expect("what Rust writes as a number is one")
}

fn below(least_mm: f64, key: &str, length_mm: f64) -> Option<String> {
    (f64::MIN_POSITIVE..least_mm).contains(&length_mm).then(|| {
        format!(
            "{key} is {length_mm}; is it in metres? millimetres are accepted ({length_mm} m is {} mm)",
            unbent(length_mm * 1e3)
        )
    })
}

/// The message about an angle under `key` that seems to be in radians. It is a multiple of 5° in radians to three
/// digits or more, of 1° to four, a right angle or half of one to two, or below `least_deg`.
pub fn setting_in_radians(key: &str, angle_deg: f64, least_deg: f64) -> Option<String> {
    let is_less = (f64::MIN_POSITIVE..least_deg).contains(&angle_deg);
    let is_multiple =
        |(part_deg, digits): (f64, usize)| is_multiple(angle_deg, part_deg.to_radians(), digits);
    if is_less || SETTINGS_DEG.into_iter().any(is_multiple) {
        return Some(in_radians(key, angle_deg));
    }
    seems_in_radians(key, &[angle_deg]).map(|(_, message)| message)
}

/// Asks whether an angle is in radians.
fn in_radians(key: &str, angle: f64) -> String {
    format!(
        "{key} is {angle}; is it in radians? degrees are accepted ({angle} rad is {:.1}°)",
        angle.to_degrees()
    )
}

/// Whether `angle` is less than a turn and a multiple of `part`, both in radians, to so many digits or more, rounded or cut.
fn is_multiple(angle: f64, part: f64, least_digits: usize) -> bool {
    let parts = (angle / part).round();
    let written = angle.to_string();
    let digits = written.split_once('.').map_or(0, |(_, digits)| digits.len());
    let last = libm::pow(10.0, -(digits.min(12) as f64));
    parts != 0.0 && is_small(angle) && digits >= least_digits && (angle - parts * part).abs() < last
}

/// Whether an angle is no more than a turn in radians.
fn is_small(angle: f64) -> bool {
    angle.abs() < TAU + ROUNDED_RAD
}

/// The first of `angles_deg` that seems to be in radians, by its number, with the message about the key `key`.
///
/// It is a multiple of a quarter of a turn in radians to three digits or more, rounded or cut, or of an eighth to two
/// digits. In the second case no angle is beyond a turn in radians.
pub fn seems_in_radians(key: &str, angles_deg: &[f64]) -> Option<(usize, String)> {
    let is_eighth = |angle: &f64| {
        let eighths = (angle / FRAC_PI_4).round();
        eighths != 0.0 && (angle - eighths * FRAC_PI_4).abs() < ROUNDED_RAD
    };
    let certain = angles_deg.iter().position(|angle| is_multiple(*angle, FRAC_PI_2, CERTAIN_DIGITS));
    let index = certain.or_else(|| angles_deg.iter().position(is_eighth))?;
    let is_seen = certain.is_some() || angles_deg.iter().all(|angle| is_small(*angle));
    is_seen.then(|| (index, in_radians(key, angles_deg[index])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_angles_in_radians_and_short_tools_are_queried_and_small_angles_in_degrees_are_not() {
        for (text, index) in [
            ("0 1.5708 -1.5708", Some(1)),
            ("3.14", Some(0)),
            ("-0.785", Some(0)),
            ("0.3 6.2832", Some(1)),
            ("90 1.5708", Some(1)),
            ("90 0 -3.1416", Some(2)),
            ("90 1.571", Some(1)),
            ("90 3.1415", Some(1)),
            ("90 -1.570796326794897", Some(1)),
            ("90 1.57", None),
            ("90 1.575", None),
            ("90 1.5718", None),
            ("355 90", None),
            ("1.5 3 6", None),
            ("0 0", None),
            ("", None),
        ] {
            let angles: Vec<f64> = text.split_whitespace().map(|angle| angle.parse().unwrap()).collect();
            assert_eq!(seems_in_radians("alpha_deg", &angles).map(|message| message.0), index, "{text}");
        }
        assert_eq!(
            seems_in_metres("tool_mm", 0.15).unwrap(),
            "tool_mm is 0.15; is it in metres? millimetres are accepted (0.15 m is 150 mm)"
        );
        assert_eq!(
            [0.0, 2.0, 150.0].map(|length_mm| seems_in_metres("tool_mm", length_mm)),
            [None, None, None]
        );
        assert_eq!(
            radius_in_metres("radius_mm", 0.075).unwrap(),
            "radius_mm is 0.075; is it in metres? millimetres are accepted (0.075 m is 75 mm)"
        );
        let bent = radius_in_metres("radius_mm", 0.09465).unwrap();
        assert!(bent.ends_with("(0.09465 m is 94.65 mm)"), "{bent}");
        for radius_mm in [-1.0, 0.0, 1.0, 75.0] {
            assert_eq!(radius_in_metres("radius_mm", radius_mm), None);
        }
        for (angle_deg, is_asked) in [
            ("0.349", true),
            ("0.3491", true),
            ("0.1745", true),
            ("1.57", true),
            ("0.9", true),
            ("2.182", true),
            ("1.0472", true),
            ("2.1642", true),
            ("2.164", false),
            ("2.17", false),
            ("20", false),
            ("1.05", false),
            ("2.5", false),
            ("1.125", false),
            ("110", false),
        ] {
            let doubt = setting_in_radians("jump_deg", angle_deg.parse().unwrap(), 1.0);
            assert_eq!(doubt.is_some(), is_asked, "{angle_deg}: {doubt:?}");
        }
        assert_eq!(
            points_in_metres("from_mm and to_mm", &[0.0, -0.4, 0.0, 0.3]).unwrap(),
            "the greatest coordinate of from_mm and to_mm is 0.4; is it in metres? millimetres are accepted (0.4 m is 400 mm)"
        );
        for points_mm in [[0.0; 3], [0.3, 0.0, -80.0]] {
            assert_eq!(points_in_metres("from_mm and to_mm", &points_mm), None);
        }
        let message = seems_in_radians("yaw_deg", &["1.5708".parse().unwrap()]).unwrap().1;
        assert_eq!(
            message,
            "yaw_deg is 1.5708; is it in radians? degrees are accepted (1.5708 rad is 90.0°)"
        );
    }
}
