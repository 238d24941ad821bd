//! Lanes against the scalar code, on the instructions of this machine and on the least its architecture has.

use super::*;
use crate::geometry::tests::sample;
use crate::geometry::tests::thoroughly;
use crate::geometry::{HalfSpace, Segment, Solid, distance_segment_box, distance_segment_segment};
use base::seed::{self, Stream};
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

/// The two ends of eight segments as rows: x, y and z of the first, then of the second.
type SegmentRows = [RoughRow; 6];

fn rows(segments: &[Segment; ROUGH_LANES]) -> SegmentRows {
    std::array::from_fn(|row| segments.map(|s| if row < 3 { s.a[row] } else { s.b[row - 3] } as f32))
}

fn axis<S: Simd>(simd: S, [ax, ay, az, bx, by, bz]: &SegmentRows) -> [Point<Rough<S>>; 2] {
    [Point::load(simd, [ax, ay, az]), Point::load(simd, [bx, by, bz])]
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

#[test]
fn rough_sines_and_cosines_are_right_to_seven_digits() {
    let mut stream = seed::stream(43);
    for index in 0..50_000 {
        let angles: RoughRow = std::array::from_fn(|_| stream.random_range(-20.0..20.0));
        for level in levels() {
            let (s, c) = dispatch!(level, simd => {
                let (s, c) = sincos_rough(Rough::load_array(simd, angles));
                (s.to_array(), c.to_array())
            });
            for lane in 0..ROUGH_LANES {
                let (sine, cosine) = libm::sincos(f64::from(angles[lane]));
                let [s, c] = [s[lane], c[lane]].map(f64::from);
                let place = format!("seed 43 case {index} on {level:?}: {}", angles[lane]);
                assert!((s - sine).abs() < 1.2e-7 && (c - cosine).abs() < 1.2e-7, "{place}: {s} {c}");
            }
        }
    }
}

/// Two segments, a fifth of the time nearly parallel and a fifth of the time crossing.
fn pair(stream: &mut Stream) -> [Segment; 2] {
    let [a, b, c] = [0; 3].map(|_| sample::point(stream));
    let p = Segment::new(a, b);
    let q = match stream.random_range(0..5) {
        0 => {
            let skew = sample::point(stream) * libm::pow(10.0, stream.random_range(-9.0..-1.0));
            Segment::new(c, c + (b - a) * stream.random_range(-1.5..1.5) + skew)
        }
        1 => {
            let on = p.at(stream.random_range(0.0..1.0));
            Segment::new(c, on + (on - c) * stream.random_range(0.0..1.0))
        }
        _ => Segment::new(c, sample::point(stream)),
    };
    [p, q]
}

/// How far apart two distances are that matter from `least` on.
fn apart(found: f32, exact: f64, least: f64) -> f64 {
    (f64::from(found).max(least) - exact.max(least)).abs()
}

/// The greatest of what the cases are reckoned with.
fn extent(points: &[Vec3], wall: &HalfSpace) -> f64 {
    points.iter().map(Vec3::norm).fold(wall.height(&Vec3::zeros()).abs(), f64::max)
}

#[test]
fn rough_distances_are_those_of_the_scalar_code_to_half_the_roughness() {
    let mut stream = seed::stream(42);
    let mut pierced = 0;
    let mut worst = [0_f64; 3];
    for index in 0..thoroughly(25_000) {
        let pairs: [[Segment; 2]; ROUGH_LANES] = std::array::from_fn(|_| pair(&mut stream));
        let shape = sample::oriented_box(&mut stream);
        let wall = HalfSpace::behind(&sample::point(&mut stream), &sample::direction(&mut stream)).unwrap();
        let solids =
            [Solid::Box(shape), Solid::HalfSpace(wall)].map(|solid| RoughSolid::from_solid(&solid).unwrap());
        let (p, q) = (rows(&pairs.map(|pair| pair[0])), rows(&pairs.map(|pair| pair[1])));
        for level in levels() {
            let [between, to_box, height] = dispatch!(level, simd => {
                let (p, q) = (axis(simd, &p), axis(simd, &q));
                [
                    squared_distance_segment_segment_lanes(p, q).sqrt().to_array(),
                    solids[0].distance(simd, p).to_array(),
                    solids[1].distance(simd, p).to_array(),
                ]
            });
            for (lane, [p, q]) in pairs.iter().enumerate() {
                let exact = [
                    distance_segment_segment(p, q),
                    distance_segment_box(p, &shape),
                    wall.height(&p.a).min(wall.height(&p.b)),
                ];
                let extent = extent(&[p.a, p.b, q.a, q.b, shape.aabb().min, shape.aabb().max], &wall);
                let found = [between[lane], to_box[lane], height[lane]];
                for (kind, (found, exact)) in found.into_iter().zip(exact).enumerate() {
                    let least = if kind == 0 { ROUGH_LEAST * extent } else { f64::NEG_INFINITY };
                    let off = apart(found, exact, least) / extent;
                    let place =
                        format!("seed 42 case {index} lane {lane} on {level:?}: {p:?} {q:?} {shape:?}");
                    assert!(off < 0.5 * ROUGHNESS, "{place}: kind {kind}: {found} for {exact}");
                    worst[kind] = worst[kind].max(off);
                }
                pierced += u32::from(exact[1] == 0.0);
            }
        }
    }
    assert!(pierced as usize > 2 * thoroughly(25_000) / 5, "one-sided sample: {pierced} pierced boxes");
    assert!(worst.iter().all(|off| *off > 1e-8), "{worst:?}");
}

#[test]
fn a_segment_without_length_is_no_number() {
    let point = Segment::new(Vec3::x(), Vec3::x());
    let (p, q) = (rows(&[point; ROUGH_LANES]), rows(&[Segment::new(Vec3::x(), Vec3::y()); ROUGH_LANES]));
    for (p, q) in [(&p, &q), (&q, &p)] {
        let found = dispatch!(level(), simd => {
            squared_distance_segment_segment_lanes(axis(simd, p), axis(simd, q)).to_array()
        });
        assert!(found.iter().all(|d| d.is_nan()), "{found:?}");
    }
}
