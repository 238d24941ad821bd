//! Our distances against parry3d's, where parry3d is exact.
//!
//! It is not exact between capsules: its iterative solver is off by up to a hundredth of a millimetre a metre on two of a
//! hundred pairs of this sample. Those are held against the ternary search alone.

use super::sample;
use crate::geometry::{
    Segment, Vec3, distance_segment_box, distance_segment_convex, distance_segment_segment, nearest_by_edge,
};
use base::seed;
use parry3d::{
    math::{Pose, Vector},
    query,
    shape::{self, Shape},
};

fn vector(v: &Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn segment(p: &Segment) -> shape::Segment {
    shape::Segment::new(vector(&p.a), vector(&p.b))
}

fn distance(a: &dyn Shape, b: &dyn Shape) -> f64 {
    query::distance(&Pose::IDENTITY, a, &Pose::IDENTITY, b).unwrap().distance
}

#[test]
fn segments_are_as_far_apart_as_parry_finds_them_within_the_tolerance_of_its_solver() {
    let seed = 601;
    let mut stream = seed::stream(seed);
    for index in 0..20_000 {
        let (p, q) = sample::segment_pair(&mut stream);
        let (ours, theirs) = (distance_segment_segment(&p, &q), distance(&segment(&p), &segment(&q)));
        assert!((ours - theirs).abs() < 1e-6, "seed {seed} pair {index}: {ours}, not {theirs}");
    }
}

#[test]
fn segments_and_boxes_are_as_far_apart_as_parry_finds_them() {
    let seed = 602;
    let mut stream = seed::stream(seed);
    for index in 0..20_000 {
        let shape = sample::oriented_box(&mut stream);
        let p = sample::segment_beside(&mut stream, &sample::box_faces(&shape));
        let local = Segment::new(shape.frame().local(&p.a), shape.frame().local(&p.b));
        let theirs = distance(&segment(&local), &shape::Cuboid::new(vector(shape.half())));
        let ours = distance_segment_box(&p, &shape);
        assert!((ours - theirs).abs() < 1e-12, "seed {seed} pair {index}: {ours}, not {theirs}");
    }
}

#[test]
fn the_nearest_points_are_the_same_wherever_they_are_looked_for_first() {
    let seed = 605;
    let mut stream = seed::stream(seed);
    let mut on_edges = 0;
    for index in 0..2_000 {
        let solid = sample::polyhedron(&mut stream);
        let p = sample::segment_beside(&mut stream, &sample::convex_faces(&solid));
        let (found, edge) = nearest_by_edge(&p, &solid, None);
        for likely in 0..solid.edges().len() {
            let other = nearest_by_edge(&p, &solid, Some(likely));
            assert_eq!(other, (found, edge), "seed {seed} pair {index}, edge {likely}");
        }
        let sides = solid.edges().iter().map(|edge| edge.ends.map(|end| solid.vertices()[end]));
        let least = sides.map(|[a, b]| distance_segment_segment(&p, &Segment::new(a, b)));
        let least = least.fold(f64::INFINITY, f64::min);
        let apart = least - found.distance;
        assert!(apart >= -1e-12 && (edge.is_none() || apart < 1e-12), "seed {seed} pair {index}: {apart}");
        on_edges += u32::from(edge.is_some());
    }
    assert!((400..1_800).contains(&on_edges), "one-sided sample: {on_edges} of 2000 on edges");
}

#[test]
fn segments_and_polyhedra_are_as_far_apart_as_parry_finds_them() {
    let seed = 603;
    let mut stream = seed::stream(seed);
    for index in 0..20_000 {
        let solid = sample::polyhedron(&mut stream);
        let p = sample::segment_beside(&mut stream, &sample::convex_faces(&solid));
        let points: Vec<Vector> = solid.vertices().iter().map(vector).collect();
        let hull = shape::ConvexPolyhedron::from_convex_hull(&points).unwrap();
        let (ours, theirs) = (distance_segment_convex(&p, &solid), distance(&segment(&p), &hull));
        assert!((ours - theirs).abs() < 1e-12, "seed {seed} pair {index}: {ours}, not {theirs}");
    }
}
