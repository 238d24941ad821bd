//! The steps that both closed forms share: the turn of joint 1, and the triangle of the two links.
//!
//! A joint that a pose leaves free keeps its reference. Joint 1 is free where the wrist is on axis 1 and the arm has no
//! shoulder offset. Joint 2 is free where links of equal length are folded onto each other and the wrist is on axis 2.
//! At full stretch, fully folded, and at the shoulder offset's distance from axis 1, two branches coincide and both are
//! given. Where the last two of these meet, rounding decides whether the pose is within reach.

use crate::geometry::Vec3;

/// Below this, a distance (metres) counts as 0 and a sine as that of axes in line.
pub(super) const SINGULAR: f64 = 1e-10;

/// Joint 1's turn.
pub(super) struct Heading {
    pub theta: f64,
    /// Ahead of the arm, in the plane of the floor.
    pub h: [f64; 2],
}

/// The turn of joint 1 that puts the plane of the arm `shoulder` away from axis 1, towards `(h.y, -h.x)`, and the wrist in it,
/// in front of axis 1 or behind it.
///
/// `None` if the wrist is nearer to axis 1 than `shoulder`; nearer by rounding is as near.
#[inline]
pub(super) fn heading(wrist: &Vec3, shoulder: f64, front: bool, reference: f64) -> Option<Heading> {
    let radius2 = wrist.x * wrist.x + wrist.y * wrist.y;
    if shoulder == 0.0 {
        let radius = radius2.sqrt();
        let side = if front { 1.0 } else { -1.0 };
        return Some(if radius > SINGULAR {
            let h = [side * wrist.x / radius, side * wrist.y / radius];
            Heading { theta: libm::atan2(h[1], h[0]), h }
        } else {
            let (s, c) = libm::sincos(reference);
            Heading { theta: reference, h: [c, s] }
        });
    }
    let along = (radius2 - shoulder * shoulder).max(0.0).sqrt();
    if radius2 * (1.0 + 1e-12) < shoulder * shoulder || radius2 == 0.0 {
        return None;
    }
    let along = if front { along } else { -along };
    // The direction h with wrist · h = along and wrist · (h.y, -h.x) = shoulder.
    let c = (along * wrist.x - shoulder * wrist.y) / radius2;
    let s = (along * wrist.y + shoulder * wrist.x) / radius2;
    Some(Heading { theta: libm::atan2(s, c), h: [c, s] })
}

/// The triangle of two links from an origin to a point in their plane.
pub(super) struct Fold {
    /// The angle by which the second link turns from the first.
    pub bend: f64,
    /// The angle at the origin from the first link to the point.
    pub opening: f64,
    /// The direction of the point.
    pub to_point: f64,
}

/// The triangle of links `first` and `second` to the point `[x, y]`; with the point at the origin it is in the direction
/// `reference`.
///
/// `None` out of reach; beyond it by rounding is within.
#[inline]
pub(super) fn fold([x, y]: [f64; 2], [first, second]: [f64; 2], reference: f64) -> Option<Fold> {
    let distance2 = x * x + y * y;
    let cosine = (distance2 - first * first - second * second) / (2.0 * first * second);
    if cosine.abs() > 1.0 + 1e-12 {
        return None;
    }
    let cosine = cosine.clamp(-1.0, 1.0);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let bend = libm::atan2(sine, cosine);
    if distance2 < SINGULAR * SINGULAR {
        return Some(Fold { bend, opening: 0.0, to_point: reference });
    }
    let opening = libm::atan2(second * sine, first + second * cosine);
    Some(Fold { bend, opening, to_point: libm::atan2(y, x) })
}
