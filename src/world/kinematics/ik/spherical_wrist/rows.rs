//! The same closed form for four flanges at once.
#![expect(
    clippy::inline_always,
    reason = "lanes are compiled for the instructions of the function they end up in"
)]

use super::{Branch, LaneSolutions, SphericalWrist};
use crate::geometry::lanes::{
    Frames, Lane, Point, PoseRows, Simd, SimdBase, SimdFloat, SimdMask, atan2, sincos,
};

/// Below these sines of wrist and elbow, and below as many metres of the wrist's centre from axis 1, angles lose more digits than
/// the lanes may. An error grows by the inverse of each, and by both near a folded arm with a straight wrist.
const NEARLY_SINGULAR: f64 = 1e-2;
/// How far the elbow's cosine must be beyond 1 to be out of reach; the scalar code allows for less.
const BEYOND_REACH: f64 = 1e-9;

fn sign(positive: bool) -> f64 {
    if positive { 1.0 } else { -1.0 }
}

impl SphericalWrist {
    #[inline(always)]
    pub(super) fn solve_rows<S: Simd>(&self, simd: S, flanges: &PoseRows, branch: Branch) -> LaneSolutions {
        let flange = Frames::from_rows(simd, flanges);
        let wrist = flange.origin.plus(Lane::splat(simd, -self.d6), flange.axes[2]);
        let side = sign(branch.shoulder());
        let radius = wrist.x.mul_add(wrist.x, wrist.y * wrist.y).sqrt();
        let h = [wrist.x * side / radius, wrist.y * side / radius];
        let u = wrist.x.mul_add(h[0], wrist.y * h[1]) - self.a1;
        let v = (wrist.z - self.d1) * self.signs[0];
        let a2 = self.a2;
        let forearm = self.forearm;
        let cosine = (u.mul_add(u, v * v) - (a2 * a2 + forearm * forearm)) * (1.0 / (2.0 * a2 * forearm));
        let sine = ((-cosine + 1.0) * (cosine + 1.0)).sqrt();
        let elbow = sign(branch.elbow());
        let theta2 = atan2(v, u) - atan2(sine * forearm, cosine * forearm + a2) * elbow;
        let theta3 = atan2(sine, cosine) * elbow + self.forearm_angle;
        let (s, c) = sincos(theta2 + theta3);
        let [sign1, sign3, ..] = self.signs;
        let x3 = Point { x: h[0] * c, y: h[1] * c, z: s * sign1 };
        let z3 = Point { x: h[0] * s * sign3, y: h[1] * s * sign3, z: -c * (sign1 * sign3) };
        let ([theta4, theta5, theta6], sin5) =
            self.wrist_rows([x3, z3.cross(x3), z3], &flange, branch.wrist());
        let theta1 = atan2(h[1], h[0]);
        let offsets = &self.offsets;
        let regular = radius.simd_gt(NEARLY_SINGULAR) & sin5.simd_gt(NEARLY_SINGULAR);
        let solved = regular & sine.simd_gt(NEARLY_SINGULAR);
        let unreachable = radius.simd_gt(NEARLY_SINGULAR) & cosine.abs().simd_gt(1.0 + BEYOND_REACH);
        LaneSolutions {
            q: [
                (theta1 - offsets[0]).to_array(),
                (theta2 - offsets[1]).to_array(),
                (theta3 - offsets[2]).to_array(),
                (theta4 - offsets[3]).to_array(),
                (theta5 - offsets[4]).to_array(),
                (theta6 - offsets[5]).to_array(),
            ],
            solved: solved.to_bitmask(),
            unreachable: unreachable.to_bitmask(),
        }
    }

    /// The last three angles, and the sine of the fifth's size.
    #[inline(always)]
    fn wrist_rows<S: Simd>(
        &self,
        [x3, y3, z3]: [Point<Lane<S>>; 3],
        flange: &Frames<Lane<S>>,
        positive: bool,
    ) -> ([Lane<S>; 3], Lane<S>) {
        let [_, _, sign4, sign5] = self.signs;
        // The other turn of the wrist is a half turn of joint 4 and of joint 6 away: all three signs change.
        let side = sign(positive);
        let [x, y, z] = flange.axes;
        let (across_x, across_y) = (x3.dot(z) * (sign5 * side), y3.dot(z) * (sign5 * side));
        let sin5 = across_x.mul_add(across_x, across_y * across_y).sqrt();
        let theta4 = atan2(across_y, across_x);
        let theta5 = atan2(sin5 * side, z3.dot(z) * (-sign4 * sign5));
        let (s4, c4) = (across_y / sin5, across_x / sin5);
        let y4 = y3.scaled(c4) - x3.scaled(s4);
        let turned = -sign4 * sign5;
        let theta6 = atan2(y4.dot(x) * turned, y4.dot(y) * turned);
        ([theta4, theta5, theta6], sin5)
    }
}
