//! Numbers, paths and paints as SVG writes them.

use crate::render::style::{Fill, HAIR_PT, Stroke};
use std::fmt::Write as _;

/// The number to a hundredth of a point, without idle digits.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A line through `points` with so many decimals: the first as it is, the others as steps from the one before.
pub(super) fn path_data(points: &[[f64; 2]], decimals: i32) -> String {
    let unit = 10.0_f64.powi(decimals);
    let (mut path, mut last): (String, Option<[f64; 2]>) = (String::new(), None);
    for point in points.iter().map(|point| point.map(|value| (value * unit).round())) {
        match last {
            None => path += &format!("M{} {}", short(point[0] / unit), short(point[1] / unit)),
            Some(before) if before == point => continue,
            Some([x, y]) => {
                let first = if path.contains('l') { "" } else { "l" };
                path += first;
                for step in [point[0] - x, point[1] - y] {
                    let step = short(step / unit);
                    let step = match step.strip_prefix("-0.") {
                        Some(rest) => format!("-.{rest}"),
                        None => step.strip_prefix("0.").map_or(step.clone(), |rest| format!(".{rest}")),
                    };
                    let is_apart = path.ends_with('l') || step.starts_with('-');
                    path += if is_apart { "" } else { " " };
                    path += &step;
                }
            }
        }
        last = Some(point);
    }
    path
}

/// The attributes of a fill, or of none.
pub(super) fn surface(fill: Option<Fill>) -> String {
    match fill {
        None => " fill=\"none\"".to_owned(),
        Some(fill) if fill.opacity >= 1.0 => format!(" fill=\"{}\"", fill.color.hex()),
        Some(fill) => format!(" fill=\"{}\" fill-opacity=\"{}\"", fill.color.hex(), short(fill.opacity)),
    }
}

/// The attributes of a stroke.
pub(super) fn ink(stroke: &Stroke) -> String {
    let mut text = format!(" stroke=\"{}\"", stroke.color.hex());
    if stroke.width_pt != HAIR_PT {
        write!(text, " stroke-width=\"{}\"", short(stroke.width_pt)).expect("a string takes everything");
    }
    if stroke.opacity < 1.0 {
        write!(text, " stroke-opacity=\"{}\"", short(stroke.opacity)).expect("a string takes everything");
    }
    let pattern = stroke.dash.pattern();
    if !pattern.is_empty() {
        let lengths: Vec<String> = pattern.iter().map(|share| short(share * stroke.width_pt)).collect();
        write!(text, " stroke-dasharray=\"{}\"", lengths.join(" ")).expect("a string takes everything");
    }
    text
}
