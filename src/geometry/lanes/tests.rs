//! Lanes against the scalar code, on the instructions of this machine and on the least its architecture has.

use super::*;
use crate::geometry::tests::sample;
use crate::geometry::{HalfSpace, Segment, distance_segment_box, distance_segment_segment};
use crate::seed::{self, Stream};
use rand::RngExt as _;
use std::cell::Cell;

thread_local! {
    /// What [`level`] gives on this thread instead of what the machine has.
    pub(super) static FORCED: Cell<Option<Level>> = const { Cell::new(None) };
}

/// The instructions of this machine, and the least that its architecture has.
pub fn levels() -> [Level; 2] {
    [Level::new(), Level::baseline()]
}

/// What `task` gives when lanes run on the instructions of `level`, on this thread alone.
pub fn on_level<R>(level: Level, task: impl FnOnce() -> R) -> R {
    FORCED.set(Some(level));
    let result = task();
    FORCED.set(None);
    result
}

/// The two ends of four segments as rows: x, y and z of the first, then of the second.
type SegmentRows = [Row; 6];

fn rows(segments: &[Segment; LANES]) -> SegmentRows {
    std::array::from_fn(|row| segments.map(|s| if row < 3 { s.a[row] } else { s.b[row - 3] }))
}

#[inline(always)]
fn axis<S: Simd>(simd: S, rows: &SegmentRows) -> [Point<S>; 2] {
    let lane = |row: usize| Lane::load_array(simd, rows[row]);
    [Point { x: lane(0), y: lane(1), z: lane(2) }, Point { x: lane(3), y: lane(4), z: lane(5) }]
}

#[test]
fn sines_cosines_and_arc_tangents_are_right_to_two_last_places() {
    let mut stream = seed::stream(41);
    for index in 0..50_000 {
        let angles: Row = std::array::from_fn(|_| stream.random_range(-20.0..20.0));
        let points: [Row; 2] =
            std::array::from_fn(|_| std::array::from_fn(|_| stream.random_range(-1.0..1.0)));
        for level in levels() {
            let (s, c, arc) = dispatch!(level, simd => {
                let (s, c) = sincos(Lane::load_array(simd, angles));
                let arc = atan2(Lane::load_array(simd, points[0]), Lane::load_array(simd, points[1]));
                (s.to_array(), c.to_array(), arc.to_array())
            });
            for lane in 0..LANES {
                let (sine, cosine) = libm::sincos(angles[lane]);
                let place = format!("seed 41 case {index} on {level:?}: {} {points:?}", angles[lane]);
                assert!((s[lane] - sine).abs() < 4.5e-16 && (c[lane] - cosine).abs() < 4.5e-16, "{place}");
                let exact = libm::atan2(points[0][lane], points[1][lane]);
                assert!((arc[lane] - exact).abs() < 9e-16, "{place}: {} for {exact}", arc[lane]);
            }
        }
    }
}

/// Two segments, a fifth of the time parallel and a fifth of the time crossing.
fn pair(stream: &mut Stream) -> [Segment; 2] {
    let [a, b, c] = [0; 3].map(|_| sample::point(stream));
    let p = Segment::new(a, b);
    let q = match stream.random_range(0..5) {
        0 => Segment::new(c, c + (b - a) * stream.random_range(-1.5..1.5)),
        1 => {
            let on = p.at(stream.random_range(0.0..1.0));
            Segment::new(c, on + (on - c) * stream.random_range(0.0..1.0))
        }
        _ => Segment::new(c, sample::point(stream)),
    };
    [p, q]
}

#[test]
fn distances_are_those_of_the_scalar_code() {
    let (mut stream, mut pierced) = (seed::stream(42), 0);
    for index in 0..25_000 {
        let pairs: [[Segment; 2]; LANES] = std::array::from_fn(|_| pair(&mut stream));
        let shape = sample::oriented_box(&mut stream);
        let wall = HalfSpace::behind(&sample::point(&mut stream), &sample::direction(&mut stream)).unwrap();
        let (p, q) = (rows(&pairs.map(|pair| pair[0])), rows(&pairs.map(|pair| pair[1])));
        for level in levels() {
            let [between, to_box, height] = dispatch!(level, simd => {
                let (p, q) = (axis(simd, &p), axis(simd, &q));
                [
                    squared_distance_segment_segment_lanes(p, q).sqrt().to_array(),
                    squared_distance_segment_box_lanes(simd, p, &shape).sqrt().to_array(),
                    height_half_space(simd, p[0], p[1], &wall).to_array(),
                ]
            });
            for (lane, [p, q]) in pairs.iter().enumerate() {
                let place = format!("seed 42 case {index} lane {lane} on {level:?}: {p:?} {q:?} {shape:?}");
                assert!((between[lane] - distance_segment_segment(p, q)).abs() < 1e-11, "{place}");
                let exact = distance_segment_box(p, &shape);
                assert!((to_box[lane] - exact).abs() < 1e-11, "{place}: {} for {exact}", to_box[lane]);
                let exact = wall.height(&p.a).min(wall.height(&p.b));
                assert!((height[lane] - exact).abs() < 1e-14, "{place}");
                pierced += u32::from(distance_segment_box(p, &shape) == 0.0);
            }
        }
    }
    assert!(pierced > 5_000, "one-sided sample: {pierced} pierced boxes");
}

#[test]
fn a_segment_without_length_is_no_number() {
    let point = Segment::new(Vec3::x(), Vec3::x());
    let (p, q) = (rows(&[point; LANES]), rows(&[Segment::new(Vec3::x(), Vec3::y()); LANES]));
    for (p, q) in [(&p, &q), (&q, &p)] {
        let found = dispatch!(level(), simd => {
            squared_distance_segment_segment_lanes(axis(simd, p), axis(simd, q)).to_array()
        });
        assert!(found.iter().all(|d| d.is_nan()), "{found:?}");
    }
}
