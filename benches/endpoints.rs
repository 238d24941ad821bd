//! The planar arm: workspace analysis, and the enumeration of end points.
//!
//! The workspace is that of the study (101 × 51 points, 4 discs). `workspace/identify` is the enumeration of all pairs of
//! end points in both cases under one interpretation on one thread: worlds, hops, and a flood from every point.

use base::grid::CornerRule;
use criterion::{Criterion, criterion_group, criterion_main};
use engine::geometry::planar::Touch;
use engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use engine::length_inversion::{Match, pairs};
use engine::search::OctileAstar;
use engine::space::{ArmRules, ArmWorld, HopRule, TipLattice};
use std::{hint::black_box, time::Duration};
use study::endpoint_variants::{Case, Variant};
use study::preprocessing::workspace_map::ShapeSetting;

const START: [f64; 2] = [49.0, 3.0];

fn workspace(hop: HopRule) -> ArmWorld {
    let rules = ArmRules {
        arm: Planar2r::new(30.0, 20.0).expect("links have lengths"),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 1.0).expect("1 divides 100 and 50"),
        inner_radius_cm: 20.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop,
    };
    let discs = [[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]];
    let obstacles = discs.map(|at| ShapeSetting::Circle.obstacle(at, 10.0).expect("a disc has a size"));
    ArmWorld::new(rules, obstacles.to_vec())
}

fn analysis(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("workspace");
    group.sample_size(20).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    group.bench_function("end_points", |b| b.iter(|| workspace(black_box(HopRule::EndPoints))));
    group.bench_function("continuous", |b| b.iter(|| workspace(black_box(HopRule::Continuous))));
    let moves = workspace(HopRule::EndPoints).eight_moves();
    let mut search = OctileAstar::new(&moves).expect("a workspace is small");
    let start = workspace(HopRule::EndPoints).rules().lattice.cell(&START).expect("a point of the lattice");
    group.bench_function("flood", |b| {
        b.iter(|| {
            let mut sum = 0_u64;
            search.flood(black_box(start), u32::MAX, |_, cost| sum += u64::from(cost));
            sum
        });
    });
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be had");
    let base = *workspace(HopRule::EndPoints).rules();
    let cases = cases();
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    for (name, shape) in
        [("circles", "'circle'"), ("any_shape", "['circle', 'square', 'hexagon', 'triangle']")]
    {
        let variant = format!("label = '{name}'\nshape = {shape}\ndiameter_cm = 10");
        let variant: Variant = toml::from_str(&variant).expect("it is TOML");
        group.bench_function(format!("identify/{name}"), |b| {
            b.iter(|| pool.install(|| identified(&variant, &base, black_box(&cases))));
        });
    }
    group.finish();
}

fn cases() -> [Case; 2] {
    [
        Case { obstacles_cm: vec![[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]], hops: [29, 31] },
        Case { obstacles_cm: vec![[41.0, 10.0], [7.0, 40.0], [-16.0, 33.0]], hops: [17, 38] },
    ]
}

fn identified(variant: &Variant, base: &ArmRules, cases: &[Case; 2]) -> usize {
    let grids = variant.grids(base, cases).expect("a disc has a size");
    let rule = if variant.is_free() { Match::Freely } else { Match::ByPlace };
    pairs(&grids, &cases.each_ref().map(Case::target), rule)[0].len()
}

criterion_group!(benches, analysis);
criterion_main!(benches);
