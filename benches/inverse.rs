//! Inverse kinematics: the closed forms on the shipped robots, and the search on published arms that no closed form fits.
//!
//! - `closed/<robot>/one` and `/all`: the configuration on one branch, and those on all.
//! - `search/<arm>/one` and `/all`: the same by the search, from a reference that has nothing to do with the pose. Before it is
//!   timed, the share of 10 000 reachable poses that it solves is printed; a test holds it above 99 in 100.

use base::seed::{self, Stream};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use engine::geometry::Frame;
use engine::kinematics::{AXES, Arm, Chain, Joint, Joints, Robot};
use rand::RngExt as _;
use std::f64::consts::PI;
use std::hint::black_box;
use std::path::Path;

const SEED: u64 = 7;

/// Rows of `alpha` in degrees, `a` and `d` in millimetres.
type Table = [[f64; 3]; AXES];

/// Two wrist sections of the Jaco along an axis: 74.3 sin 30° / sin 60°.
const SECTION: f64 = 74.3 * 0.577_350_269_189_625_8;

/// Sources: see the tests of `engine::kinematics::ik`; offsets of angles are left out, since they move no time.
const GENERAL: [(&str, Table); 3] = [
    (
        "jaco",
        [
            [90.0, 0.0, 275.5],
            [180.0, 410.0, 0.0],
            [90.0, 0.0, -9.8],
            [60.0, 0.0, -207.3 - SECTION],
            [60.0, 0.0, -2.0 * SECTION],
            [180.0, 0.0, -168.7 - SECTION],
        ],
    ),
    (
        "xarm6",
        [
            [-90.0, 0.0, 267.0],
            [0.0, 289.488_66, 0.0],
            [-90.0, 77.5, 0.0],
            [90.0, 0.0, 342.5],
            [-90.0, 76.0, 0.0],
            [0.0, 0.0, 97.0],
        ],
    ),
    (
        "crx10ia",
        [
            [-90.0, 0.0, 0.0],
            [180.0, 540.0, 0.0],
            [-90.0, 0.0, 0.0],
            [90.0, 0.0, -540.0],
            [-90.0, 0.0, 150.0],
            [180.0, 0.0, -160.0],
        ],
    ),
];

fn arm(table: &Table) -> Arm {
    let joints = table.map(|[alpha_deg, a_mm, d_mm]| Joint {
        alpha_rad: alpha_deg.to_radians(),
        a_m: a_mm * 1e-3,
        d_m: d_mm * 1e-3,
        offset_rad: 0.0,
        lower_rad: -PI,
        upper_rad: PI,
        speed_rad_s: 1.0,
    });
    let chain = Chain::new(joints, Frame::IDENTITY, Frame::IDENTITY).expect("a published table");
    Arm::new(chain, None).expect("a published table")
}

fn draw(stream: &mut Stream, arm: &Arm) -> Joints {
    arm.chain().joints().map(|joint| stream.random_range(joint.lower_rad..joint.upper_rad))
}

/// A configuration with its pose, and a reference that has nothing to do with it.
fn cases(arm: &Arm, count: usize) -> Vec<(Joints, Frame, Joints)> {
    let mut stream = seed::stream(SEED);
    let case = |_| {
        let q = draw(&mut stream, arm);
        (q, arm.chain().forward(&q), draw(&mut stream, arm))
    };
    (0..count).map(case).collect()
}

fn measure(c: &mut Criterion, group: &str, name: &str, arm: &Arm) {
    let cases = cases(arm, 1024);
    // Which branch a configuration is on is found by solving for all of them: that is not what is timed.
    let branches: Vec<_> = cases.iter().map(|(q, ..)| arm.branch_of(q)).collect();
    let mut next = (0..cases.len()).cycle();
    let mut group = c.benchmark_group(group);
    group.bench_function(BenchmarkId::new(name, "one"), |b| {
        b.iter(|| {
            let at = next.next().expect("endless");
            let (_, pose, reference) = &cases[at];
            black_box(arm.inverse_on(pose, branches[at], reference))
        });
    });
    group.bench_function(BenchmarkId::new(name, "all"), |b| {
        b.iter(|| {
            let (_, pose, reference) = &cases[next.next().expect("endless")];
            black_box(arm.inverse(pose, reference))
        });
    });
    group.finish();
}

fn closed(c: &mut Criterion) {
    for name in ["motoman_up6", "puma560", "aubo_i10", "ur5"] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("data/robots/{name}.toml"));
        measure(c, "closed", name, Robot::load(&file).expect("the robot is there").arm());
    }
}

fn search(c: &mut Criterion) {
    for (name, table) in GENERAL {
        let arm = arm(&table);
        let cases = cases(&arm, 10_000);
        let is_solved = |(q, pose, reference): &&(Joints, Frame, Joints)| {
            arm.inverse_on(pose, arm.branch_of(q), reference).is_some()
        };
        println!(
            "search/{name}: {} of 10000 reachable poses are solved",
            cases.iter().filter(is_solved).count()
        );
        measure(c, "search", name, &arm);
    }
}

criterion_group!(benches, closed, search);
criterion_main!(benches);
