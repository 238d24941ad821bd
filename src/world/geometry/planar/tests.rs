use super::*;
use base::seed;
use rand::RngExt as _;
use std::f64::consts::FRAC_PI_4;

fn at(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn segment(ax: f64, ay: f64, bx: f64, by: f64) -> Segment2 {
    Segment2::new(at(ax, ay), at(bx, by))
}

/// Contact by integers: the least numerator of the squared distance from `c` to the segment, over `d · d`.
fn integer_contact(a: [i128; 2], b: [i128; 2], c: [i128; 2], radius: i128, touch: Touch) -> bool {
    let (d, r) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let along = d[0] * r[0] + d[1] * r[1];
    let length2 = d[0] * d[0] + d[1] * d[1];
    let e = [c[0] - b[0], c[1] - b[1]];
    let (distance2, scale) = if along <= 0 {
        (r[0] * r[0] + r[1] * r[1], 1)
    } else if along >= length2 {
        (e[0] * e[0] + e[1] * e[1], 1)
    } else {
        let cross = d[0] * r[1] - d[1] * r[0];
        (cross * cross, length2)
    };
    let limit = radius * radius * scale;
    distance2 < limit || (distance2 == limit && touch == Touch::Contact)
}

#[test]
fn circles_are_touched_where_integers_say_so_however_large_they_are() {
    let seed = 511;
    let mut stream = seed::stream(seed);
    let mut touching = 0;
    for index in 0..100_000 {
        // Odd coordinates of 29 bits: products of their squares fit no float, so the exact path is taken.
        let scale = if index % 2 == 0 { 1 } else { (1 << 24) - 3 };
        let mut draw = || i128::from(stream.random_range(-12..13)) * scale;
        let (a, b, c) = ([draw(), draw()], [draw(), draw()], [draw(), draw()]);
        let radius = 5 * scale;
        let float = |p: [i128; 2]| at(p[0] as f64, p[1] as f64);
        let p = Segment2::new(float(a), float(b));
        let circle = Circle::new(float(c), radius as f64).unwrap();
        let found = [Touch::Contact, Touch::Free].map(|t| intersects_segment_circle(&p, &circle, t));
        let truth = [Touch::Contact, Touch::Free].map(|t| integer_contact(a, b, c, radius, t));
        assert_eq!(found, truth, "seed {seed} case {index}: {p:?} {circle:?}");
        assert_eq!(
            intersects_point_circle(&p.a, &circle, Touch::Free),
            integer_contact(a, a, c, radius, Touch::Free)
        );
        touching += u32::from(truth[0] != truth[1]);
    }
    assert!(touching > 1_000, "only {touching} of 100000 segments touch a circle");
}

#[test]
fn a_circle_missed_by_the_last_bit_is_missed_and_one_touched_is_touched() {
    let circle = Circle::new(at(0.0, 0.0), 5.0).unwrap();
    let tangent = |y: f64| segment(-7.0, y, 9.0, y);
    let next = f64::from_bits(5.0_f64.to_bits() + 1);
    let before = f64::from_bits(5.0_f64.to_bits() - 1);
    for (y, closed, open) in [(before, true, true), (5.0, true, false), (next, false, false)] {
        assert_eq!(intersects_segment_circle(&tangent(y), &circle, Touch::Contact), closed, "{y}");
        assert_eq!(intersects_segment_circle(&tangent(y), &circle, Touch::Free), open, "{y}");
    }
    // 3-4-5 in the direction of no axis.
    let slanted = segment(3.0 - 8.0, 4.0 + 6.0, 3.0 + 8.0, 4.0 - 6.0);
    assert!(intersects_segment_circle(&slanted, &circle, Touch::Contact));
    assert!(!intersects_segment_circle(&slanted, &circle, Touch::Free));
}

/// The least distance along a finely divided segment, by closed point distances: slow and independent of the
/// side that anything is on.
fn sampled(segment: &Segment2, distance: impl Fn(&Vec2) -> f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    let at = |t: f64| distance(&(segment.a + (segment.b - segment.a) * t));
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if at(low + third) <= at(high - third) { high -= third } else { low += third }
    }
    at(0.5 * (low + high)).min(at(0.0)).min(at(1.0))
}

/// The distance from a point to a polygon as a quadratic program over its sides.
fn point_polygon(point: &Vec2, polygon: &ConvexPolygon) -> f64 {
    let behind = |p: &Vec2, slack: f64| polygon.sides().all(|s| (s.b - s.a).perp(&(p - s.a)) >= -slack);
    if behind(point, 0.0) {
        return 0.0;
    }
    let foot = |s: Segment2| {
        let d = (s.b - s.a).normalize();
        s.a + d * d.dot(&(point - s.a))
    };
    let feet = polygon.sides().map(foot).filter(|p| behind(p, 1e-12));
    feet.chain(polygon.vertices().iter().copied()).map(|p| (p - point).norm()).fold(f64::INFINITY, f64::min)
}

#[test]
fn distances_in_the_plane_are_those_of_a_ternary_search() {
    let seed = 512;
    let mut stream = seed::stream(seed);
    let mut apart = 0;
    let mut meeting = 0;
    for index in 0..20_000 {
        let mut draw = || at(stream.random_range(-6..7).into(), stream.random_range(-6..7).into());
        let (p, q) = (Segment2::new(draw(), draw()), Segment2::new(draw(), draw()));
        let center = draw();
        let sides = 3 + index % 5;
        let turn_rad = stream.random_range(0.0..1.0);
        let polygon = ConvexPolygon::regular(center, 2.0, sides, turn_rad).unwrap();
        let circle = Circle::new(center, 2.0).unwrap();
        let pairs = [
            (distance_segment_segment(&p, &q), sampled(&p, |x| distance_point_segment(x, &q))),
            (
                distance_segment_circle(&p, &circle),
                sampled(&p, |x| ((x - circle.center).norm() - circle.radius).max(0.0)),
            ),
            (distance_segment_polygon(&p, &polygon), sampled(&p, |x| point_polygon(x, &polygon))),
        ];
        for (kind, (fast, slow)) in pairs.iter().enumerate() {
            assert!((fast - slow).abs() < 1e-9, "seed {seed} case {index} kind {kind}: {fast}, not {slow}");
        }
        let contact = intersects_segment_polygon(&p, &polygon, Touch::Contact);
        assert!(contact == (pairs[2].1 < 1e-12) || (1e-15..1e-9).contains(&pairs[2].1), "case {index}");
        apart += u32::from(pairs[2].1 > 0.1);
        meeting += u32::from(contact);
    }
    assert!(apart > 3_000 && meeting > 3_000, "one-sided sample: {apart} apart, {meeting} meeting");
}

#[test]
fn touching_a_square_is_contact_only_if_the_caller_says_so() {
    let square = ConvexPolygon::rectangle(at(0.0, 0.0), at(2.0, 2.0)).unwrap();
    let cases = [
        ("through a corner", segment(-1.0, 1.0, 1.0, -1.0), true, false),
        ("along a side", segment(-1.0, 2.0, 3.0, 2.0), true, false),
        ("ending on a side", segment(1.0, 2.0, 1.0, 5.0), true, false),
        ("a point on a side", segment(1.0, 2.0, 1.0, 2.0), true, false),
        ("a point inside", segment(1.0, 1.0, 1.0, 1.0), true, true),
        ("a point outside", segment(3.0, 1.0, 3.0, 1.0), false, false),
        ("inside", segment(0.5, 0.5, 1.5, 1.0), true, true),
        ("corner to corner", segment(0.0, 0.0, 2.0, 2.0), true, true),
        ("cutting a corner", segment(-0.5, 1.0, 1.0, -0.5), true, true),
        ("past a corner", segment(-1.0, 0.5, 0.5, -1.0), false, false),
        ("in line with a side", segment(3.0, 2.0, 5.0, 2.0), false, false),
    ];
    for (name, p, closed, open) in cases {
        assert_eq!(intersects_segment_polygon(&p, &square, Touch::Contact), closed, "{name}");
        assert_eq!(intersects_segment_polygon(&p, &square, Touch::Free), open, "{name}");
        let back = Segment2::new(p.b, p.a);
        assert_eq!(intersects_segment_polygon(&back, &square, Touch::Free), open, "{name}, backwards");
    }
    for (point, closed, open) in
        [(at(2.0, 1.0), true, false), (at(1.0, 1.0), true, true), (at(2.0, 2.1), false, false)]
    {
        assert_eq!(intersects_point_polygon(&point, &square, Touch::Contact), closed, "{point:?}");
        assert_eq!(intersects_point_polygon(&point, &square, Touch::Free), open, "{point:?}");
    }
}

#[test]
fn segments_that_share_an_end_or_a_stretch_touch_and_only_a_crossing_is_more() {
    let p = segment(0.0, 0.0, 4.0, 0.0);
    let cases = [
        ("crossing", segment(1.0, -1.0, 1.0, 1.0), true, true),
        ("ending on it", segment(1.0, 0.0, 1.0, 1.0), true, false),
        ("end to end", segment(4.0, 0.0, 5.0, 1.0), true, false),
        ("overlapping", segment(3.0, 0.0, 9.0, 0.0), true, false),
        ("beyond in line", segment(5.0, 0.0, 9.0, 0.0), false, false),
        ("parallel", segment(0.0, 1.0, 4.0, 1.0), false, false),
        ("a point on it", segment(2.0, 0.0, 2.0, 0.0), true, false),
        ("short of it", segment(2.0, 1e-300, 2.0, 1.0), false, false),
    ];
    for (name, q, closed, open) in cases {
        for (p, q) in [(p, q), (q, p)] {
            assert_eq!(intersects_segment_segment(&p, &q, Touch::Contact), closed, "{name}");
            assert_eq!(intersects_segment_segment(&p, &q, Touch::Free), open, "{name}");
        }
    }
}

#[test]
fn impossible_polygons_and_circles_are_refused_with_the_reason() {
    let polygon = |corners: &[(f64, f64)]| {
        ConvexPolygon::new(corners.iter().map(|&(x, y)| at(x, y)).collect()).unwrap_err().to_string()
    };
    let star: Vec<(f64, f64)> = (0..5)
        .map(|k| libm::sincos(f64::from(k) * 4.0 * std::f64::consts::PI / 5.0))
        .map(|(s, c)| (c, s))
        .collect();
    let cases = [
        (polygon(&[(0.0, 0.0), (1.0, 0.0)]), "2 vertices were given; 3 to 64"),
        (polygon(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)]), "turns clockwise or not at all"),
        (polygon(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0)]), "vertex 2 turns clockwise or not"),
        (polygon(&star), "turns clockwise or not at all"),
        (polygon(&[(0.0, 0.0), (1.0, f64::NAN), (0.0, 1.0)]), "y of vertex 1 is NaN"),
        (Circle::new(at(0.0, 0.0), -5.0).unwrap_err().to_string(), "the circle's radius is -5"),
        (
            ConvexPolygon::regular(at(0.0, 0.0), 0.0, 4, FRAC_PI_4).unwrap_err().to_string(),
            "the polygon's radius is 0",
        ),
    ];
    for (found, expected) in cases {
        assert!(found.contains(expected), "`{found}` does not say `{expected}`");
    }
}
