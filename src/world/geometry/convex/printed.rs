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
    let Lines { b, e, f, s, t, .. } = Lines::between(p, q);
    let clamped = s.clamp(0.0, 1.0);
    let t = if clamped == s { t } else { (b * clamped + f) / e };
    Nearest::between(p.at(clamped), q.at(t.clamp(0.0, 1.0)))
}

/// The products of eqs. 11 and 12 and the shares of both lines at their nearest points.
struct Lines {
    a: f64,
    b: f64,
    e: f64,
    f: f64,
    s: f64,
    t: f64,
}

impl Lines {
    fn between(p: &Segment, q: &Segment) -> Self {
        let (d1, d2, r) = (p.b - p.a, q.b - q.a, p.a - q.a);
        let (a, b, e) = (d1.dot(&d1), d1.dot(&d2), d2.dot(&d2));
        let (c, f) = (d1.dot(&r), d2.dot(&r));
        let determinant = a * e - b * b;
        let parallel = determinant <= 1e-12 * a * e;
        let (s, t) = if parallel {
            (0.0, f / e)
        } else {
            ((b * f - c * e) / determinant, (a * f - b * c) / determinant)
        };
        Self { a, b, e, f, s, t }
    }
}

/// The nearest points of two segments by eqs. 11 to 18 to the letter: `q` is the rod's segment, `p` the obstacle's.
///
/// Eqs. 11 and 12 give s to the point of the rod and t to that of the obstacle. After eq. 16 it is s that places the obstacle's point
/// at one of its ends. The point of the rod, found anew, is put at the wrong end where it lies beyond one: at q1 for t > 1, at q2
/// for t < 0. An s within 0 to 1 leaves the obstacle's point at t of eq. 12, wherever that is. Lines without one nearest pair start
/// from the rod's first end.
pub fn nearest_segment_segment_literal(rod: &Segment, side: &Segment) -> Nearest {
    let Lines { a, s, t, .. } = Lines::between(rod, side);
    let is_share = |share: f64| (0.0..=1.0).contains(&share);
    if is_share(s) && is_share(t) {
        return Nearest::between(rod.at(s), side.at(t));
    }
    let p = placed(s, [side.a, side.b], side.at(t));
    let anew = (p - rod.a).dot(&(rod.b - rod.a)) / a;
    let q = placed(anew, [rod.b, rod.a], rod.at(anew));
    Nearest::between(q, p)
}

/// What a share below 0 or above 1 places at one of two ends, and any other `within`.
fn placed(share: f64, [below, above]: [Vec3; 2], within: Vec3) -> Vec3 {
    match share {
        share if share > 1.0 => above,
        share if share < 0.0 => below,
        _ => within,
    }
}

/// The nearest points of a segment and a polyhedron as Tang et al. (2023) compute them: by the edges and diagonals of its
/// faces, or where the segment pierces a face. All diagonals count; the text lists fewer.
pub fn nearest_segment_convex_printed(segment: &Segment, convex: &Convex) -> Nearest {
    nearest_by_lines(segment, convex, |_, _, _| true)
}

/// The same with the diagonals that the text lists for a face of five corners, by the rule that they follow: those from the first
/// two corners. Faces of three or four corners have no others.
pub fn nearest_segment_convex_listed(segment: &Segment, convex: &Convex) -> Nearest {
    nearest_by_lines(segment, convex, is_listed)
}

/// The same with the first of the text's two lists, after eq. 10: it leaves out the closing edge too, from the last corner to the first.
pub fn nearest_segment_convex_listed_first(segment: &Segment, convex: &Convex) -> Nearest {
    nearest_by_lines(segment, convex, is_listed_first)
}

/// Whether the list before eq. 11 has the line between the corners `i < j` of `count`, numbered from 0.
fn is_listed(i: usize, j: usize, count: usize) -> bool {
    is_listed_first(i, j, count) || is_closing(i, j, count)
}

/// Whether the list after eq. 10 has it.
fn is_listed_first(i: usize, j: usize, count: usize) -> bool {
    !is_closing(i, j, count) && (i < 2 || j == i + 1)
}

fn is_closing(i: usize, j: usize, count: usize) -> bool {
    (i, j + 1) == (0, count)
}

/// The same by the edges and diagonals for which `is_taken` holds, of the two corners' places and the number of corners.
fn nearest_by_lines(
    segment: &Segment,
    convex: &Convex,
    is_taken: impl Fn(usize, usize, usize) -> bool,
) -> Nearest {
    let mut best = Nearest { distance: f64::INFINITY, on_a: segment.a, on_b: segment.a };
    for face in convex.faces() {
        if let Some(at) = pierced(segment, face, convex.vertices()) {
            return Nearest { distance: 0.0, on_a: at, on_b: at };
        }
        for (i, &from) in face.corners.iter().enumerate() {
            for (j, &to) in face.corners.iter().enumerate().skip(i + 1) {
                if !is_taken(i, j, face.corners.len()) {
                    continue;
                }
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

    #[test]
    fn to_the_letter_the_rod_is_put_at_its_wrong_end_and_within_both_segments_nothing_changes() {
        let side = Segment::new(Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        let crossing = Segment::new(Vec3::new(-1.0, 0.0, 2.0), Vec3::new(1.0, 0.0, 2.0));
        assert!((nearest_segment_segment_literal(&crossing, &side).distance - 2.0).abs() < 1e-12);
        // Nearest is the rod's end at x = 1; the letter takes the one at x = 5.
        let aside = Segment::new(Vec3::new(1.0, 0.0, 0.0), Vec3::new(5.0, 0.0, 0.0));
        let found = nearest_segment_segment_literal(&aside, &side);
        assert!(found.distance >= 5.0, "{found:?}");
        assert!((nearest_segment_segment_printed(&aside, &side).distance - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_listed_diagonals_are_all_of_a_box_and_not_of_a_pentagon() {
        let segment = Segment::new(Vec3::new(-0.3, 0.4, 3.0), Vec3::new(-0.5, 0.1, 5.0));
        let all = nearest_segment_convex_printed(&segment, &cube()).distance;
        assert_eq!(nearest_segment_convex_listed(&segment, &cube()).distance, all);
        let prism = Convex::prism(crate::geometry::Axis::Z, Vec3::zeros(), 1.0, 1.0, 5, 0.0).unwrap();
        let longer = (0..200).filter(|k| {
            let angle = f64::from(*k) * 0.0314;
            let at = Vec3::new(0.4 * libm::cos(angle), 0.4 * libm::sin(angle), 0.6);
            let segment = Segment::new(at, at + Vec3::z());
            let [all, listed] = [nearest_segment_convex_printed, nearest_segment_convex_listed]
                .map(|nearest| nearest(&segment, &prism).distance);
            assert!(listed >= all);
            listed > all + 1e-9
        });
        assert!((5..150).contains(&longer.count()));
    }

    /// The lines of a face of five corners that a list has, as the text names them.
    fn lines(is_taken: fn(usize, usize, usize) -> bool) -> String {
        let pairs = (0..5).flat_map(|i| (i + 1..5).map(move |j| (i, j)));
        let taken = pairs.filter(|&(i, j)| is_taken(i, j, 5));
        taken.map(|(i, j)| format!("p{}p{}", i + 1, j + 1)).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn both_lists_have_the_lines_that_the_text_prints() {
        // After eq. 10, and before eq. 11, where p5p1 is added; both leave out p3p5.
        assert_eq!(lines(is_listed_first), "p1p2 p1p3 p1p4 p2p3 p2p4 p2p5 p3p4 p4p5");
        assert_eq!(lines(is_listed), "p1p2 p1p3 p1p4 p1p5 p2p3 p2p4 p2p5 p3p4 p4p5");
    }

    #[test]
    fn the_first_list_measures_from_a_closing_edge_only_by_the_face_beside_it() {
        let tetrahedron = |order: [usize; 4]| {
            let corners = [Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
            Convex::from_vertices(order.map(|index| corners[index]).to_vec()).unwrap()
        };
        let mut missing = 0;
        let mut present = 0;
        for convex in [tetrahedron([0, 1, 2, 3]), tetrahedron([3, 1, 0, 2]), cube()] {
            let middle = convex.vertices().iter().sum::<Vec3>() / convex.vertices().len() as f64;
            let ends = |face: &Face| -> Vec<(usize, usize)> {
                let next = face.corners.iter().cycle().skip(1);
                face.corners.iter().zip(next).map(|(&a, &b)| (a.min(b), a.max(b))).collect()
            };
            for (a, b) in convex.faces().iter().flat_map(ends) {
                let closing = |face: &&Face| ends(face).last() == Some(&(a, b));
                let edge = [convex.vertices()[a], convex.vertices()[b]];
                let at = edge[0].lerp(&edge[1], 0.45);
                let out = (at - middle).normalize();
                let segment = Segment::new(at + out * 0.01, at + out);
                let truth = nearest_segment_convex(&segment, &convex).distance;
                let first = nearest_segment_convex_listed_first(&segment, &convex).distance;
                let is_missing = convex.faces().iter().filter(closing).count() == 2;
                assert_eq!(first > truth + 1e-6, is_missing, "edge {a}-{b}: {first}, not {truth}");
                missing += u32::from(is_missing);
                present += u32::from(!is_missing);
            }
        }
        assert!(missing > 0 && present > 0, "one-sided: {missing} missing, {present} present");
    }
}
