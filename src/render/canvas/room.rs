//! The room that turned texts take.

use super::Rect;

/// Corners of a turned rectangle, in order.
pub(super) type Quad = [[f64; 2]; 4];

/// `bounds` turned by `turn_deg` about the origin and moved to `at`.
pub(super) fn turned(bounds: Rect, at: [f64; 2], turn_deg: f64) -> Quad {
    let (sine, cosine) = libm::sincos(turn_deg.to_radians());
    let place = |x: f64, y: f64| [at[0] + x * cosine - y * sine, at[1] + x * sine + y * cosine];
    let right = bounds.right();
    let bottom = bounds.bottom();
    [place(bounds.x, bounds.y), place(right, bounds.y), place(right, bottom), place(bounds.x, bottom)]
}

/// Whether no side of either rectangle parts the two.
pub(super) fn overlap(one: &Quad, two: &Quad) -> bool {
    let parted = |from: &Quad| {
        (0..2).any(|side| {
            let edge = [from[side + 1][0] - from[side][0], from[side + 1][1] - from[side][1]];
            let span = |quad: &Quad| {
                let along = quad.map(|corner| corner[0] * edge[0] + corner[1] * edge[1]);
                along.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)))
            };
            let ((a, b), (c, d)) = (span(one), span(two));
            b <= c || d <= a
        })
    };
    !parted(one) && !parted(two)
}
