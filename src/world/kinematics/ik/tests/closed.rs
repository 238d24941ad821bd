//! Closed forms on published tables, and on tables drawn within their shapes.

use super::{
    change, draw,
    tables::{
        PUMA, PUMA_D2, PUMA_MODIFIED, PUMA_SHARED, UR5, UR5_MODIFIED, UR5_TURNED, arm, joints, modified_arm,
    },
    *,
};
use crate::geometry::tests::thoroughly;
use crate::kinematics::{Joint, angle::wrapped, robot::tests::urdf::read_back};
use base::seed::Stream;

/// How far two poses are apart: metres and radians.
pub fn residual(a: &Frame, b: &Frame) -> (f64, f64) {
    ((a.origin - b.origin).norm(), (a.rotation - b.rotation).norm() / 2_f64.sqrt())
}

/// Arms by their published rows, and three of them as read from a URDF file.
fn published() -> Vec<(&'static str, Arm, &'static str)> {
    let mut arms = vec![
        ("puma", arm(&PUMA), "spherical_wrist"),
        ("puma, d2", arm(&PUMA_D2), "spherical_wrist"),
        ("puma, d2 and d3", arm(&PUMA_SHARED), "spherical_wrist"),
        ("puma, modified", modified_arm(&PUMA_MODIFIED), "spherical_wrist"),
        ("ur5", arm(&UR5), "offset_wrist"),
        ("ur5, modified", modified_arm(&UR5_MODIFIED), "offset_wrist"),
        ("ur5, turned", arm(&UR5_TURNED), "offset_wrist"),
        ("up6", shipped("motoman_up6"), "spherical_wrist"),
    ];
    let by_urdf =
        [("puma, urdf", arm(&PUMA)), ("ur5, urdf", arm(&UR5)), ("up6, urdf", shipped("motoman_up6"))];
    arms.extend(by_urdf.map(|(name, arm)| (name, read_back(&arm), arm.solver().name)));
    arms.push(("aubo", shipped("aubo_i10"), "offset_wrist"));
    arms
}

/// The rows of a shipped arm with joints that turn half a turn either way.
fn shipped(name: &str) -> Arm {
    let rows =
        robot(name).arm().chain().joints().map(|joint| Joint { lower_rad: -PI, upper_rad: PI, ..joint });
    Arm::new(Chain::new(rows, Frame::IDENTITY, Frame::IDENTITY).unwrap(), None).unwrap()
}

/// Every solution leads to the pose of `q`, and is also found alone; returns how many there are.
fn held(arm: &Arm, q: &Joints, reference: &Joints, place: &str) -> usize {
    let target = arm.chain().forward(q);
    let solutions = arm.inverse(&target, reference);
    for (branch, found) in solutions.iter() {
        let (off_m, turned_rad) = residual(&arm.chain().forward(found), &target);
        assert!(off_m < 1e-9 && turned_rad < 1e-9, "{place}: {branch:?} off {off_m} m, {turned_rad} rad");
        let single = arm.inverse_on(&target, branch, reference).unwrap();
        assert!(change(found, &single) < 1e-12, "{place}: {found:?} and {single:?}");
    }
    solutions.iter().count()
}

#[test]
fn published_arms_get_every_branch_to_a_nanometre_and_the_configuration_drawn_is_one_of_them() {
    for (seed, (name, arm, solver)) in (741..).zip(published()) {
        assert_eq!(arm.solver().name, solver, "{name}");
        let mut stream = seed::stream(seed);
        let mut count = 0;
        for index in 0..thoroughly(100_000) {
            let q = draw(&mut stream, arm.chain());
            let place = format!("{name}, seed {seed} case {index}: {q:?}");
            count += held(&arm, &q, &q, &place);
            let solutions = arm.inverse(&arm.chain().forward(&q), &q);
            let own = arm.branch_of(&q);
            let again = solutions.on(own).unwrap_or_else(|| panic!("{place}: {own:?} is lost"));
            assert!(change(again, &q) < 1e-5, "{place}: became {again:?}");
            let misplaced = solutions.iter().find(|(branch, found)| arm.branch_of(found) != *branch);
            assert_eq!(misplaced, None, "{place}");
        }
        let poses = thoroughly(100_000);
        assert!(count > 4 * poses, "{name}: only {count} solutions in {poses} poses");
    }
}

#[test]
fn besides_the_other_wrist_all_have_the_other_elbow_or_joint_1_half_a_turn_away() {
    let near = |a: f64, b: f64| wrapped(a - b).abs() < 1e-5;
    for (seed, (name, arm, _)) in (771..).zip(published()) {
        let mut stream = seed::stream(seed);
        let mut count = 0;
        for index in 0..2_000 {
            let q = draw(&mut stream, arm.chain());
            let Some(other) = arm.other_wrist(&q) else { continue };
            let own = arm.branch_of(&q);
            let place = format!("{name}, seed {seed} case {index}: {q:?}");
            for (branch, found) in arm.inverse(&arm.chain().forward(&q), &q).iter() {
                if branch.shoulder() != own.shoulder() {
                    assert!(near(found[0], q[0] + PI), "{place}: {found:?}");
                } else if branch.elbow() != own.elbow() {
                    let [there, here] = [found, &q].map(|q| arm.elbow_fold_rad(q));
                    assert!(near(there, -here), "{place}: {found:?}");
                } else if branch.wrist() != own.wrist() {
                    assert!((0..6).all(|i| near(found[i], other[i])), "{place}: {found:?} and {other:?}");
                    count += 1;
                }
            }
        }
        let has_law = name.starts_with("up6");
        assert_eq!(count > 1_900, has_law, "{name}: {count}");
    }
}

/// A table of the shape of a solver with any signs, turns and offsets.
fn drawn_table(stream: &mut Stream, is_spherical: bool) -> tables::Table {
    let mut either = |a: f64, b: f64| if stream.random_bool(0.5) { a } else { b };
    let right = [0; 6].map(|_| either(90.0, -90.0));
    let straight = [0; 6].map(|_| either(0.0, 180.0));
    let mut long = || either(1.0, -1.0) * either(300.0, 450.0) + either(0.0, 33.0);
    let [a2, a3, d4] = [long(), long(), long()];
    let mut short =
        |scale: f64| if stream.random_bool(0.3) { 0.0 } else { stream.random_range(-scale..scale) };
    let d = [0; 6].map(|_| short(150.0));
    let a1 = short(100.0);
    let a3_short = short(100.0);
    let a6 = short(50.0);
    let alpha6 = short(180.0);
    let mut table = if is_spherical {
        [
            [right[0], a1, d[0], 0.0],
            [straight[1], a2, d[1], 0.0],
            [right[2], a3_short, d[2], 0.0],
            [right[3], 0.0, d4, 0.0],
            [right[4], 0.0, 0.0, 0.0],
            [alpha6, a6, d[5], 0.0],
        ]
    } else {
        [
            [right[0], 0.0, d[0], 0.0],
            [straight[1], a2, d[1], 0.0],
            [straight[2], a3, d[2], 0.0],
            [right[3], 0.0, d[3], 0.0],
            [right[4], 0.0, d[4], 0.0],
            [alpha6, a6, d[5], 0.0],
        ]
    };
    for row in &mut table {
        row[3] = stream.random_range(-180.0..180.0);
    }
    table
}

#[test]
fn closed_forms_hold_for_any_signs_turned_axes_and_shared_offsets() {
    let seed = 748;
    let mut stream = seed::stream(seed);
    let base = Frame::at(Vec3::new(0.3, -0.2, 0.5)) * Frame::turned(&Vec3::y(), 0.6);
    for index in 0..2_000 {
        let is_spherical = index % 2 == 0;
        let table = drawn_table(&mut stream, is_spherical);
        let chain = Chain::new(joints(&table), base, Frame::at(Vec3::new(0.1, 0.05, 0.2))).unwrap();
        let arm = Arm::new(chain, None).unwrap();
        let solver = if is_spherical { "spherical_wrist" } else { "offset_wrist" };
        assert_eq!(arm.solver().name, solver, "seed {seed} case {index}: {table:?}");
        for _ in 0..50 {
            let q = draw(&mut stream, arm.chain());
            let place = format!("seed {seed} case {index}: {q:?} of {table:?}");
            held(&arm, &q, &draw(&mut stream, arm.chain()), &place);
            let own = arm.inverse_on(&arm.chain().forward(&q), arm.branch_of(&q), &q);
            let own = own.unwrap_or_else(|| panic!("{place}: its branch is lost"));
            assert!(change(&own, &q) < 1e-5, "{place}: became {own:?}");
        }
    }
}

/// `q` with the fold `which` (0 elbow, 1 wrist) at `at_rad`.
fn folded(arm: &Arm, q: &Joints, which: usize, at_rad: f64) -> Joints {
    let joint = [2, 4][which];
    let off = wrapped(arm.solver.folds_rad(q)[which] - at_rad);
    let moved = |by: f64| {
        let mut q = *q;
        q[joint] = wrapped(q[joint] + by);
        q
    };
    let rest = |q: &Joints| wrapped(arm.solver.folds_rad(q)[which] - at_rad).abs();
    let [down, up] = [moved(-off), moved(off)];
    if rest(&down) < rest(&up) { down } else { up }
}

/// `q` with joint 2 where the wrist is as near to axis 1 as the shoulder's offset lets it.
fn at_the_shoulder(arm: &Arm, q: &Joints) -> Joints {
    let wrist = if arm.solver().name == "spherical_wrist" { 4 } else { 5 };
    let at = |q2: f64| {
        let mut q = *q;
        q[1] = q2;
        q
    };
    let along = |q2: f64| {
        let frames = arm.chain().frames(&at(q2));
        frames[wrist].origin.dot(&frames[1].axis(2).cross(&Vec3::z()))
    };
    let (mut low, mut high) = (-PI, 0.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if (along(low) > 0.0) == (along(middle) > 0.0) { low = middle } else { high = middle }
    }
    at(low)
}

#[test]
fn singular_poses_are_reached_to_a_nanometre() {
    let nearly = [0.0, 1e-14, 1e-12, 9e-11, 1.1e-10, 1e-9, 1e-8, 1e-6];
    for (seed, (name, arm, _)) in (751..).zip(published()) {
        let mut stream = seed::stream(seed);
        let mut refused = 0;
        let mut twice = 0;
        for index in 0..thoroughly(100_000) {
            let mut q = draw(&mut stream, arm.chain());
            let by = nearly[index / 24 % nearly.len()] * if index % 2 == 0 { 1.0 } else { -1.0 };
            let kind = index % 24 / 2;
            if kind & 1 != 0 {
                q = folded(&arm, &q, 1, by);
            }
            if kind & 2 != 0 {
                q = folded(&arm, &q, 0, if kind & 1 == 0 { by } else { PI - by });
            }
            if kind >= 4 {
                q = at_the_shoulder(&arm, &q);
                q[1] += if kind >= 8 { by } else { 0.0 };
            }
            let place = format!("{name}, seed {seed} case {index}: {q:?}");
            // Where joint 6 keeps its reference, another one may put the pose out of reach.
            let mut reference = draw(&mut stream, arm.chain());
            reference[5] = q[5];
            let found = held(&arm, &q, &reference, &place);
            // At the edge of reach in two ways at once, rounding decides. So it does where one of them comes by chance: an elbow
            // within a milliradian of the edge leaves some 1e-7 m, as much as a wrist of 1e-10 rad leaves open.
            let [elbow, wrist] = arm.solver.folds_rad(&q).map(|fold| libm::sin(fold).abs() < 1e-3);
            let is_by_chance = kind & 3 != 3 && elbow && (wrist || kind >= 4);
            let is_twice_at_the_edge = kind & 2 != 0 && kind >= 4 || is_by_chance;
            assert!(found > 0 || is_twice_at_the_edge, "{place}: not reached");
            refused += u32::from(found == 0);
            twice += u32::from(is_twice_at_the_edge);
        }
        assert!(refused * 10 < twice, "{name}, seed {seed}: {refused} of {twice} refused");
    }
}

#[test]
fn what_a_pose_leaves_free_keeps_its_reference() {
    let reference = [0.3, -0.4, 0.5, 0.6, 0.7, 0.8];
    let kept = |arm: &Arm, q: &Joints, joint: usize| {
        let found = arm.inverse(&arm.chain().forward(q), &reference);
        let keeping =
            found.iter().filter(|(_, found)| (found[joint] - reference[joint]).abs() < 1e-9).count();
        (keeping, found.iter().count())
    };
    for (arm, joint) in [(arm(&PUMA), 3), (arm(&UR5), 5)] {
        let q = folded(&arm, &[0.1, 0.2, 0.9, 0.4, 0.5, 0.6], 1, 0.0);
        let (keeping, all) = kept(&arm, &q, joint);
        assert!(keeping > 0 && keeping <= all, "{keeping} of {all} keep joint {}", joint + 1);
    }
    let mut no_offset = PUMA;
    no_offset[2][2] = 0.0;
    let no_offset = arm(&no_offset);
    let q = at_the_shoulder(&no_offset, &[0.1, 0.2, 0.9, 0.4, 0.5, 0.6]);
    assert_eq!(kept(&no_offset, &q, 0), (8, 8), "joint 1 with the wrist on axis 1");
    let mut equal = PUMA;
    (equal[2][1], equal[3][2]) = (0.0, 431.8);
    let equal = arm(&equal);
    let q = folded(&equal, &[0.1, 0.2, 0.9, 0.4, 0.5, 0.6], 0, PI);
    let (keeping, all) = kept(&equal, &q, 1);
    assert_eq!((keeping, all), (8, 8), "joint 2 with the wrist on axis 2");
}
