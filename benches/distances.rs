//! Our exact distance between segments and convex solids against parry3d's, on the same random segments and solids, whose answers are
//! held equal first.

use base::seed;
use criterion::{Criterion, criterion_group, criterion_main};
use engine::geometry::{Convex, Segment, Vec3, distance_segment_convex};
use parry3d::math::{Pose, Vector};
use parry3d::query;
use parry3d::shape::{self, ConvexPolyhedron};
use rand::RngExt as _;
use std::time::Duration;

fn distances(criterion: &mut Criterion) {
    let mut stream = seed::stream(31);
    let mut pairs = Vec::new();
    while pairs.len() < 200 {
        let mut point = |reach: f64| Vec3::from_fn(|_, _| stream.random_range(-reach..reach));
        let solid = Convex::cuboid(point(2.0), Vec3::new(3.0, 4.0, 5.0)).unwrap();
        let segment = Segment::new(point(9.0), point(9.0));
        let vector = |v: &Vec3| Vector::new(v.x, v.y, v.z);
        let corners: Vec<Vector> = solid.vertices().iter().map(vector).collect();
        let theirs = (
            shape::Segment::new(vector(&segment.a), vector(&segment.b)),
            ConvexPolyhedron::from_convex_hull(&corners).unwrap(),
        );
        pairs.push((segment, solid, theirs));
    }
    let parry = |(segment, solid): &(shape::Segment, ConvexPolyhedron)| {
        query::distance(&Pose::IDENTITY, segment, &Pose::IDENTITY, solid).unwrap().distance
    };
    for (segment, solid, theirs) in &pairs {
        assert!((distance_segment_convex(segment, solid) - parry(theirs)).abs() < 1e-5);
    }
    let mut group = criterion.benchmark_group("segment_polyhedron");
    group.bench_function("exact_x200", |bencher| {
        bencher.iter(|| {
            pairs.iter().map(|(segment, solid, _)| distance_segment_convex(segment, solid)).sum::<f64>()
        });
    });
    group.bench_function("parry3d_x200", |bencher| {
        bencher.iter(|| pairs.iter().map(|(_, _, theirs)| parry(theirs)).sum::<f64>());
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    targets = distances
}
criterion_main!(benches);
