//! Pair distances on drawn pairs.

use super::{reference, sample};
use crate::geometry::{
    Capsule, Convex, Edge, Nearest, Segment, Vec3, distance_capsule_capsule, distance_point_segment,
    distance_segment_box, distance_segment_convex, distance_segment_segment, intersects_capsule_capsule,
    nearest_point_segment, nearest_segment_convex, nearest_segment_segment,
};
use base::seed;

const EXACT: f64 = 1e-9;

/// What a sample held, so that a test can show that it was worth drawing.
#[derive(Default)]
struct Sampled {
    pairs: u32,
    special: u32,
    apart: u32,
}

impl Sampled {
    /// Counts a pair as special if its distance is 0 or the segment runs along a direction of the other.
    fn count(&mut self, distance: f64, p: &Segment, directions: &[Vec3]) {
        let d = (p.b - p.a).try_normalize(1e-12);
        let is_along = |e: &Vec3| {
            let e = e.try_normalize(1e-12);
            d.zip(e).is_none_or(|(d, e)| d.cross(&e).norm() < 1e-6)
        };
        self.pairs += 1;
        self.special += u32::from(distance < EXACT || directions.iter().any(is_along));
        self.apart += u32::from(distance > 0.01);
    }

    fn assert_worth_drawing(&self) {
        let Self { pairs, special, apart } = self;
        assert!(special * 5 >= *pairs, "{special} of {pairs} are parallel, touching or piercing");
        assert!(apart * 5 >= *pairs, "{apart} of {pairs} are apart");
    }
}

fn assert_attained(found: &Nearest, seed: u64, index: u32) {
    let between = (found.on_a - found.on_b).norm();
    assert!((between - found.distance).abs() < EXACT, "seed {seed} pair {index}: {found:?}");
}

#[test]
fn segments_are_as_far_apart_as_a_ternary_search_finds_them() {
    let seed = 501;
    let mut stream = seed::stream(seed);
    let mut sampled = Sampled::default();
    for index in 0..100_000 {
        let (p, q) = sample::segment_pair(&mut stream);
        let (slow, fast) = (reference::segment_segment(&p, &q), nearest_segment_segment(&p, &q));
        assert!((fast.distance - slow).abs() < EXACT, "seed {seed} pair {index}: {fast:?}, not {slow}");
        assert_attained(&fast, seed, index);
        assert_eq!(fast.distance, distance_segment_segment(&p, &q), "seed {seed} pair {index}");
        sampled.count(slow, &p, &[q.b - q.a]);
        let end = reference::segment_segment(&q, &Segment::new(p.a, p.a));
        assert!((distance_point_segment(&p.a, &q) - end).abs() < EXACT, "seed {seed} pair {index}");
        assert_attained(&nearest_point_segment(&p.a, &q), seed, index);
        let (c, d) = (Capsule::new(p.a, p.b, 0.2).unwrap(), Capsule::new(q.a, q.b, 0.1).unwrap());
        let gap = (slow - 0.3).max(0.0);
        assert!((distance_capsule_capsule(&c, &d) - gap).abs() < EXACT, "seed {seed} pair {index}");
        assert_threshold(slow, |reach| {
            let thick = |p: &Segment| Capsule { segment: *p, radius: 0.5 * reach };
            intersects_capsule_capsule(&thick(&p), &thick(&q))
        });
    }
    sampled.assert_worth_drawing();
}

#[test]
fn segments_and_boxes_are_as_far_apart_as_a_quadratic_program_finds_them() {
    let seed = 502;
    let mut stream = seed::stream(seed);
    let mut sampled = Sampled::default();
    for index in 0..100_000 {
        let shape = sample::oriented_box(&mut stream);
        let p = sample::segment_beside(&mut stream, &sample::box_faces(&shape));
        let slow = reference::segment_polyhedron(&p, &sample::box_planes(&shape));
        let fast = distance_segment_box(&p, &shape);
        assert!((fast - slow).abs() < EXACT, "seed {seed} pair {index}: {fast}, not {slow}");
        sampled.count(slow, &p, &[0, 1, 2].map(|axis| shape.frame().axis(axis)));
    }
    sampled.assert_worth_drawing();
}

#[test]
fn segments_and_polyhedra_are_as_far_apart_as_a_quadratic_program_finds_them() {
    let seed = 503;
    let mut stream = seed::stream(seed);
    let mut sampled = Sampled::default();
    for index in 0..100_000 {
        let solid = sample::polyhedron(&mut stream);
        let p = sample::segment_beside(&mut stream, &sample::convex_faces(&solid));
        let slow = reference::segment_polyhedron(&p, &sample::convex_planes(&solid));
        let fast = nearest_segment_convex(&p, &solid);
        assert!((fast.distance - slow).abs() < EXACT, "seed {seed} pair {index}: {fast:?}, not {slow}");
        assert_attained(&fast, seed, index);
        let outside = solid.faces().iter().map(|f| f.plane.height(&fast.on_b)).fold(-1.0, f64::max);
        assert!(outside < EXACT, "seed {seed} pair {index}: nearest point {outside} outside");
        let edge = |e: &Edge| solid.vertices()[e.ends[1]] - solid.vertices()[e.ends[0]];
        sampled.count(slow, &p, &solid.edges().iter().map(edge).collect::<Vec<_>>());
    }
    sampled.assert_worth_drawing();
}

#[test]
fn a_box_and_the_polyhedron_of_its_corners_are_equally_far_from_everything() {
    let seed = 504;
    let mut stream = seed::stream(seed);
    for index in 0..2_000 {
        let shape = sample::oriented_box(&mut stream);
        let solid = Convex::from_vertices(shape.corners().to_vec()).unwrap();
        let p = sample::segment_beside(&mut stream, &sample::box_faces(&shape));
        let (a, b) = (distance_segment_box(&p, &shape), distance_segment_convex(&p, &solid));
        assert!((a - b).abs() < EXACT, "seed {seed} pair {index}: {a} and {b}");
    }
}

/// Contact begins at the distance and nowhere else.
fn assert_threshold(distance: f64, intersects: impl Fn(f64) -> bool) {
    assert!(intersects(distance + 2e-9), "free at {distance}");
    assert!(distance < 1e-8 || !intersects(distance - 2e-9), "in contact at {distance}");
}
