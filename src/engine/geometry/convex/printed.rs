//! A published approximation of the distance between a segment and a convex polyhedron, kept to be measured.
//!
//! A face that the segment pierces makes the distance 0. Otherwise the distance is the least one to the edges and
//! diagonals of the faces, each by a formula that clamps the shares of the two lines' nearest points one after the
//! other. Two things are lost: a segment that lies wholly inside pierces no face, and a nearest point within a
//! face is on no edge or diagonal. The clamped formula is too long where the second share is clamped, because the
//! first is not solved for again.
//!
//! # Source
//! Tang, Zhou & Xu, *Obstacle avoidance path planning of 6-DOF robotic arm based on improved A\* algorithm and
//! artificial potential field method*, Robotica (2023), section 3.1, eqs. 7 to 18.

use super::{Convex, Face};
use crate::geometry::{Nearest, Segment, Vec3};

/// The nearest points of two segments by the clamped formula of eqs. 11 to 18.
///
/// The text clamps the share of the first segment, solves for the second and clamps it; a first share that lies
/// within the segment is never solved for again. Lines without one nearest pair (parallel ones, which the text
/// leaves out) start from the first segment's start.
pub fn nearest_segment_segment_printed(p: &Segment, q: &Segment) -> Nearest {
    let (d1, d2, r) = (p.b - p.a, q.b - q.a, p.a - q.a);
    let (a, b, e) = (d1.dot(&d1), d1.dot(&d2), d2.dot(&d2));
    let (c, f) = (d1.dot(&r), d2.dot(&r));
    let determinant = a * e - b * b;
    let parallel = determinant <= 1e-12 * a * e;
    let (s, t) =
        if parallel { (0.0, f / e) } else { ((b * f - c * e) / determinant, (a * f - b * c) / determinant) };
    let clamped = s.clamp(0.0, 1.0);
    let t = if clamped == s { t } else { (b * clamped + f) / e };
    Nearest::between(p.at(clamped), q.at(t.clamp(0.0, 1.0)))
}

/// The nearest points of a segment and a polyhedron by the edges and diagonals of its faces, or where the segment
/// pierces a face, as Tang et al. (2023) compute them.
pub fn nearest_segment_convex_printed(segment: &Segment, convex: &Convex) -> Nearest {
    let mut best = Nearest { distance: f64::INFINITY, on_a: segment.a, on_b: segment.a };
    for face in convex.faces() {
        if let Some(at) = pierced(segment, face, convex.vertices()) {
            return Nearest { distance: 0.0, on_a: at, on_b: at };
        }
        for (i, &from) in face.corners.iter().enumerate() {
            for &to in &face.corners[i + 1..] {
                let side = Segment::new(convex.vertices()[from], convex.vertices()[to]);
                let found = nearest_segment_segment_printed(segment, &side);
                if found.distance < best.distance {
                    best = found;
                }
            }
        }
    }
    best
}

/// Where the segment passes through the face, its ends strictly on both sides (eqs. 7 to 10).
fn pierced(segment: &Segment, face: &Face, vertices: &[Vec3]) -> Option<Vec3> {
    let (a, b) = (face.plane.height(&segment.a), face.plane.height(&segment.b));
    if a * b >= 0.0 {
        return None;
    }
    let at = segment.at(a / (a - b));
    let inside = (0..face.corners.len()).all(|i| {
        let from = vertices[face.corners[i]];
        let to = vertices[face.corners[(i + 1) % face.corners.len()]];
        (to - from).cross(&(at - from)).dot(&face.plane.normal) >= 0.0
    });
    inside.then_some(at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::nearest_segment_convex;

    fn cube() -> Convex {
        Convex::cuboid(Vec3::zeros(), Vec3::repeat(2.0)).unwrap()
    }

    #[test]
    fn a_segment_within_is_missed_and_a_piercing_one_is_not() {
        let inside = Segment::new(Vec3::new(-0.5, 0.1, 0.0), Vec3::new(0.5, 0.2, 0.1));
        assert!(nearest_segment_convex_printed(&inside, &cube()).distance > 0.5);
        assert_eq!(nearest_segment_convex(&inside, &cube()).distance, 0.0);
        let piercing = Segment::new(Vec3::new(-3.0, 0.1, 0.2), Vec3::new(3.0, 0.3, 0.1));
        assert_eq!(nearest_segment_convex_printed(&piercing, &cube()).distance, 0.0);
    }

    #[test]
    fn a_nearest_point_within_a_face_is_taken_too_far() {
        // Over the upper face, beside its diagonals.
        let end = Vec3::new(0.5, 0.0, 1.5);
        let segment = Segment::new(end, end + Vec3::new(0.2, 0.1, 3.0));
        let truth = nearest_segment_convex(&segment, &cube()).distance;
        let printed = nearest_segment_convex_printed(&segment, &cube()).distance;
        assert!((truth - 0.5).abs() < 1e-12 && printed > 0.55, "{truth} {printed}");
    }

    #[test]
    fn the_clamped_formula_forgets_to_solve_again() {
        // The lines cross at s = 0.5 of the first, beyond the end of the second; from that end the first is nearest
        // at its start.
        let p = Segment::new(Vec3::zeros(), Vec3::new(2.0, 0.0, 0.0));
        let q = Segment::new(Vec3::new(-3.0, 4.0, 0.0), Vec3::new(-1.0, 2.0, 0.0));
        let printed = nearest_segment_segment_printed(&p, &q).distance;
        let truth = crate::geometry::distance_segment_segment(&p, &q);
        assert!((truth - 5.0_f64.sqrt()).abs() < 1e-12 && printed > truth + 0.5, "{truth} {printed}");
    }
}
