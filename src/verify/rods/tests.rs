//! One swing of an arm past a box, and what must not be accepted of it.

use super::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Two links of 50 cm in the plane z = 0 and four joints that do nothing; one rod along each link.
fn arm() -> Arm {
    let row = |a: f64| Row { alpha: 0.0, a, d: 0.0, offset: 0.0, lower: -PI, upper: PI };
    let rod = |link: usize| Rod { link, from: [-50.0, 0.0, 0.0], to: [0.0; 3], radius: 4.0 };
    Arm {
        base: Matrix4::identity(),
        rows: [row(50.0), row(50.0), row(0.0), row(0.0), row(0.0), row(0.0)],
        tip: [0.0; 3],
        rods: vec![rod(1), rod(2)],
        floor: None,
    }
}

fn cube(center: Point, half: f64) -> Solid {
    let side = |i: usize, bit: usize| if i >> bit & 1 == 1 { half } else { -half };
    let corners: Vec<Point> = (0..8).map(|i| [0, 1, 2].map(|axis| center[axis] + side(i, axis))).collect();
    Solid::new(&corners).unwrap()
}

fn q(first: f64, second: f64) -> Vec<f64> {
    vec![first, second, 0.0, 0.0, 0.0, 0.0]
}

fn tip_length(arm: &Arm, path: &[Vec<f64>]) -> f64 {
    let tip = |q: &Vec<f64>| arm.tip(&[q[0], q[1], q[2], q[3], q[4], q[5]]);
    path.windows(2).map(|pair| distance(tip(&pair[0]), tip(&pair[1]))).sum()
}

#[test]
fn frames_put_the_tip_where_plane_geometry_does() {
    let tip = arm().tip(&[FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0]);
    assert!(distance(tip, [50.0, 50.0, 0.0]) < 1e-12, "{tip:?}");
}

#[test]
fn a_free_swing_is_accepted_and_every_mutation_of_it_is_not() {
    let arm = arm();
    // Folded past a box that the stretched arm would sweep.
    let path = [q(0.0, 0.0), q(0.0, 2.4), q(FRAC_PI_2, 2.4), q(FRAC_PI_2, 0.0)];
    let solids = [cube([60.0, 60.0, 0.0], 4.0)];
    let case = Case { arm: &arm, solids: &solids, start: [100.0, 0.0, 0.0], goal: [0.0, 100.0, 0.0] };
    let cost = Some(tip_length(&arm, &path));
    assert_eq!(case.refuse_path(&path, cost), None);
    let refused = |path: &[Vec<f64>], cost: Option<f64>, part: &str| {
        let refusal = case.refuse_path(path, cost).expect(part);
        assert!(refusal.contains(part), "{refusal}");
    };
    let straight = [q(0.0, 0.0), q(FRAC_PI_2, 0.0)];
    refused(&straight, Some(tip_length(&arm, &straight)), "a rod comes within");
    refused(&path, cost.map(|cost| cost - 1e-3), "claimed cost");
    refused(&path, None, "claims no cost");
    refused(&path[1..], cost, "the tip misses start or goal");
    refused(&[], cost, "has no path");
    let beyond = [q(0.0, 0.0), q(0.0, 3.2), q(FRAC_PI_2, 2.4), q(FRAC_PI_2, 0.0)];
    refused(&beyond, Some(tip_length(&arm, &beyond)), "configuration 1: joint 2 is beyond its limits");
    refused(&[vec![0.0; 5]], cost, "six angles");
}

#[test]
fn a_box_between_two_free_configurations_is_found_however_small() {
    let arm = arm();
    let path = [q(-0.4, 0.0), q(0.4, 0.0)];
    let ends = [path[0].clone(), path[1].clone()].map(|q| arm.tip(&[q[0], q[1], 0.0, 0.0, 0.0, 0.0]));
    // The rods are 4 thick, the box begins 0.15 below its middle; nearer than a tenth of a millimetre is refused.
    for (height, refused) in [(0.0, true), (4.1, true), (4.155, true), (4.2, false)] {
        let solids = [cube([80.0, 0.0, height], 0.15)];
        let case = Case { arm: &arm, solids: &solids, start: ends[0], goal: ends[1] };
        let refusal = case.refuse_path(&path, Some(tip_length(&arm, &path)));
        assert_eq!(refusal.is_some(), refused, "{height}: {refusal:?}");
    }
}

#[test]
fn solids_that_are_not_measured_are_none_that_could_be_nearest() {
    let arm = Arm { floor: Some(-7.0), ..arm() };
    let corners =
        [[70.0, 40.0, 0.0], [90.0, 44.0, 3.0], [76.0, 60.0, 2.0], [80.0, 46.0, 21.0], [65.0, 52.0, 9.0]];
    let solids = [cube([60.0, 60.0, 0.0], 4.0), cube([-30.0, 40.0, 8.0], 9.0), Solid::new(&corners).unwrap()];
    let exact = |q: &[f64; 6]| {
        let frames = arm.frames(q);
        let of_rod = |rod: &Rod| {
            let [a, b] = [rod.from, rod.to].map(|end| moved(&frames[rod.link], end));
            let [from, to] = [a, b].map(|[x, y, z]| Vector::new(x, y, z));
            let apart = |solid: &Solid| {
                let axis = Segment::new(from, to);
                query::distance(&Pose::IDENTITY, &axis, &Pose::IDENTITY, solid.shape()).unwrap().distance
            };
            solids.iter().map(apart).fold(a[2].min(b[2]) + 7.0, f64::min) - rod.radius
        };
        arm.rods.iter().map(of_rod).fold(f64::INFINITY, f64::min)
    };
    let (mut near, mut far) = (0, 0);
    for k in 0..4_000 {
        let share = f64::from(k) / 4_000.0;
        // Turns that fill the plane.
        let q = [2.0 * PI * share, 2.0 * PI * (share * 61.8) % (2.0 * PI) - PI, 0.3 * share, 0.0, 0.0, 0.0];
        for enough in [0.01, 1.0, 2.5, 30.0] {
            let found = arm.clearance(&solids, &q, enough);
            let truth = exact(&q);
            if truth <= enough {
                assert_eq!(found, truth, "configuration {k}, {enough}");
                near += 1;
            } else {
                assert!(found > enough, "configuration {k}: {found}, not {truth}, {enough}");
                far += 1;
            }
        }
    }
    assert!(near > 1_000 && far > 1_000, "one-sided: {near} near, {far} far");
}
