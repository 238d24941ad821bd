//! Solvers against forward kinematics, on drawn configurations and at the singular ones.

use super::*;
use crate::{
    geometry::{
        Vec3,
        lanes::{LANES, levels, on_level},
    },
    kinematics::{
        Arm,
        tests::{UP6_POSES, draw, radians, robot},
    },
};
use base::seed;
use rand::RngExt as _;
use std::{f64::consts::PI, f64::consts::TAU, fs, path::Path};

mod closed;
mod numerical;
mod tables;

const ROBOTS: [(u64, &str); 2] = [(721, "motoman_up6"), (722, "aubo_i10")];

/// How far two poses are apart: metres, and the largest difference of a direction cosine.
fn miss(a: &Frame, b: &Frame) -> (f64, f64) {
    ((a.origin - b.origin).norm(), (a.rotation - b.rotation).abs().max())
}

fn change(a: &Joints, b: &Joints) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn every_file_here_is_a_solver_registered_under_its_own_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("kinematics/ik");
    let mut files: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .filter(|stem| !["form", "mod", "reach", "tests"].contains(&stem.as_str()))
        .collect();
    files.sort_unstable();
    // A solver may have a folder beside its file.
    files.dedup();
    let names: Vec<&str> = SOLVERS.iter().map(|family| family.name).collect();
    assert_eq!(files, names);
}

#[test]
fn every_branch_leads_to_the_pose_and_one_of_them_is_the_configuration_drawn() {
    for (seed, name) in ROBOTS {
        let robot = robot(name);
        let arm = robot.arm();
        let mut stream = seed::stream(seed);
        let mut worst_m = 0.0_f64;
        let mut count = 0;
        for index in 0..100_000 {
            let q = draw(&mut stream, arm.chain());
            let target = arm.chain().forward(&q);
            let solutions = arm.inverse(&target, &q);
            let place = format!("{name}, seed {seed} case {index}: {q:?}");
            for (branch, found) in solutions.iter() {
                let (off_m, turned) = miss(&arm.chain().forward(found), &target);
                assert!(turned < 1e-11, "{place}: {branch:?} turned by {turned}");
                assert_eq!(arm.branch_of(found), branch, "{place}: {found:?}");
                assert!(arm.chain().allows(found), "{place}: {found:?}");
                worst_m = worst_m.max(off_m);
                count += 1;
            }
            let own = arm.branch_of(&q);
            let again = solutions.on(own).unwrap_or_else(|| panic!("{place}: {own:?} is lost"));
            assert!(change(again, &q) < 1e-6, "{place}: became {again:?}");
            let single = arm.inverse_on(&target, own, &q).unwrap();
            assert!(change(again, &single) < 1e-12, "{place}: {again:?} and {single:?}");
            let (_, nearest) = arm.inverse_nearest(&target, &q).unwrap();
            assert!(change(&nearest, &q) < 1e-6, "{place}: nearest is {nearest:?}");
        }
        assert!(worst_m < 1e-13, "{name}: worst {worst_m} m");
        assert!(count > 300_000, "{name}: only {count} solutions in 100000 poses");
    }
}

#[test]
fn all_branches_and_single_branches_agree_also_where_there_is_none() {
    for (seed, name) in ROBOTS {
        let robot = robot(name);
        let arm = robot.arm();
        let mut stream = seed::stream(seed);
        let mut unreachable = 0;
        for index in 0..10_000 {
            let reference = draw(&mut stream, arm.chain());
            let mut target = arm.chain().forward(&draw(&mut stream, arm.chain()));
            target.origin += Vec3::from_fn(|_, _| stream.random_range(-0.5..0.5));
            let all = arm.inverse(&target, &reference);
            for branch in Branch::ALL {
                let single = arm.inverse_on(&target, branch, &reference);
                let same = match (all.on(branch), &single) {
                    (Some(a), Some(b)) => change(a, b) < 1e-12,
                    (a, b) => a.is_none() && b.is_none(),
                };
                assert!(same, "{name}, seed {seed} case {index}: {branch:?} {all:?} {single:?}");
            }
            unreachable += u32::from(all.iter().next().is_none());
        }
        assert!((500..9_500).contains(&unreachable), "{name}: {unreachable} of 10000 out of reach");
    }
}

#[test]
fn all_six_poses_of_the_up6_are_in_front_elbow_alike_and_turn_the_wrist_the_same_way() {
    let up6 = robot("motoman_up6");
    let branches: Vec<Branch> =
        UP6_POSES.iter().map(|pose| up6.arm().branch_of(&radians(pose.degrees))).collect();
    assert!(branches.iter().all(|branch| *branch == branches[0]), "{branches:?}");
    assert!(branches[0].shoulder() && branches[0].wrist(), "{branches:?}");
}

#[test]
fn a_singular_wrist_keeps_the_reference_of_one_axis_and_still_reaches_the_pose() {
    for ((seed, name), kept) in ROBOTS.into_iter().zip([3, 5]) {
        let robot = robot(name);
        let arm = robot.arm();
        let mut stream = seed::stream(seed);
        let mut kept_its_reference = 0;
        for index in 0..2_000 {
            let mut q = draw(&mut stream, arm.chain());
            q[4] = [0.0, 1e-12, 1e-8, -1e-7][index % 4];
            let target = arm.chain().forward(&q);
            let reference = draw(&mut stream, arm.chain());
            let place = format!("{name}, seed {seed} case {index}: {q:?}");
            let solutions = arm.inverse(&target, &reference);
            for (branch, found) in solutions.iter() {
                let (off_m, turned) = miss(&arm.chain().forward(found), &target);
                assert!(off_m < 1e-9 && turned < 2e-9, "{place}: {branch:?} off {off_m} m, {turned}");
                if found[4].abs() < 1e-9 {
                    assert!((found[kept] - reference[kept]).abs() < 1e-12, "{place}: {found:?}");
                    kept_its_reference += 1;
                }
            }
            // Close to the singularity the pose fixes only a sum of two angles well.
            let (_, again) = arm.inverse_nearest(&target, &q).unwrap();
            assert!(change(&again, &q) < 1e-3, "{place}: nearest is {again:?}");
        }
        assert!(kept_its_reference > 1_000, "{name}: only {kept_its_reference} singular solutions");
    }
}

#[test]
fn a_wrist_centre_on_axis_1_keeps_the_reference_of_joint_1() {
    let up6 = robot("motoman_up6");
    let arm = up6.arm();
    let target = Frame::at(Vec3::new(0.0, 0.0, 1.0 + 0.095 + 0.15));
    for q1 in [-2.0, 0.0, 1.3] {
        let reference = [q1, -1.0, 0.5, 0.2, 0.3, 0.4];
        let (_, found) = arm.inverse_nearest(&target, &reference).unwrap();
        assert_eq!(found[0], q1, "{found:?}");
        let (off_m, turned) = miss(&arm.chain().forward(&found), &target);
        assert!(off_m < 1e-12 && turned < 1e-12, "{found:?}: off {off_m} m, {turned}");
    }
}

#[test]
fn full_stretch_is_reached_and_a_millimetre_beyond_is_not() {
    let aubo = robot("aubo_i10");
    let arm = aubo.arm();
    let mut target = arm.chain().forward(&[0.0; AXES]);
    let (_, found) = arm.inverse_nearest(&target, &[0.1, 0.1, 0.1, 0.1, 0.1, 0.0]).unwrap();
    let (off_m, turned) = miss(&arm.chain().forward(&found), &target);
    assert!(off_m < 1e-9 && turned < 1e-9, "{found:?}: off {off_m} m, {turned}");
    target.origin.z += 1e-3;
    assert!(arm.inverse_nearest(&target, &[0.0; AXES]).is_none());
    let mut stream = seed::stream(724);
    for index in 0..2_000 {
        let mut q = draw(&mut stream, arm.chain());
        q[2] = 0.0;
        let target = arm.chain().forward(&q);
        let found = arm.inverse_on(&target, arm.branch_of(&q), &q);
        let found = found.unwrap_or_else(|| panic!("seed 724 case {index}: {q:?} is refused"));
        let (off_m, turned) = miss(&arm.chain().forward(&found), &target);
        assert!(off_m < 1e-11 && turned < 1e-11, "seed 724 case {index}: off {off_m} m, {turned}");
    }
    let near_axis = Frame::at(Vec3::new(0.1, 0.0, 1.0));
    assert!(arm.inverse(&near_axis, &[0.0; AXES]).iter().next().is_none(), "inside the shoulder offset");
}

#[test]
fn joints_that_turn_more_than_once_take_the_copy_nearest_to_the_reference() {
    let up6 = robot("motoman_up6");
    let arm = up6.arm();
    let q = radians([10.0, -49.0, -53.0, -7.0, 100.0, 170.0]);
    let target = arm.chain().forward(&q);
    for (reference_deg, expected_deg) in [(170.0, 170.0), (-170.0, -190.0), (-350.0, -190.0), (349.0, 170.0)]
    {
        let mut reference = q;
        reference[5] = f64::to_radians(reference_deg);
        let found = arm.inverse_on(&target, arm.branch_of(&q), &reference).unwrap();
        assert!((found[5].to_degrees() - expected_deg).abs() < 1e-9, "from {reference_deg}: {found:?}");
    }
    let joint = arm.chain().joints()[5];
    assert_eq!(joint.nearest_allowed_copy(0.0, 100.0), Some(TAU.min(joint.upper_rad)));
    assert_eq!(arm.chain().joints()[4].nearest_allowed_copy(PI, PI), None);
}

#[test]
fn of_equally_near_configurations_the_first_branch_is_taken() {
    let up6 = robot("motoman_up6");
    let arm = up6.arm();
    let q = radians([10.0, -49.0, -53.0, 0.0, 40.0, 0.0]);
    let flip = radians([10.0, -49.0, -53.0, 180.0, -40.0, 180.0]);
    let middle: Joints = std::array::from_fn(|i| 0.5 * (q[i] + flip[i]));
    let target = arm.chain().forward(&q);
    let change2 = |p: &Joints| p.iter().zip(&middle).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    assert!((change2(&q) - change2(&flip)).abs() < 1e-12);
    let (branch, _) = arm.inverse_nearest(&target, &middle).unwrap();
    let solutions = arm.inverse(&target, &middle);
    let least = solutions.iter().map(|(_, q)| change2(q)).fold(f64::INFINITY, f64::min);
    let first = solutions.iter().find(|(_, q)| change2(q) == least).unwrap().0;
    assert_eq!(branch, first);
}

#[test]
fn closed_forms_hold_for_other_signs_offsets_bases_and_tools_than_the_robots_have() {
    let base = Frame::at(Vec3::new(0.3, -0.2, 0.5)) * Frame::turned(&Vec3::y(), 0.6);
    let tool = Frame::at(Vec3::new(0.1, 0.05, 0.2)) * Frame::turned(&Vec3::x(), 1.1);
    let up6 = robot("motoman_up6");
    let aubo = robot("aubo_i10");
    for signs in 0..16_u32 {
        let mut joints = *up6.arm().chain().joints();
        for (bit, joint) in [0, 2, 3, 4].into_iter().enumerate() {
            let sign = if signs >> bit & 1 == 1 { 1.0 } else { -1.0 };
            joints[joint].alpha_rad = sign * joints[joint].alpha_rad.abs();
            joints[joint].offset_rad = 0.3 * f64::from(signs) - 2.0;
        }
        joints[2].a_m = 0.02 * f64::from(signs) - 0.1;
        assert_round_trips(
            &Arm::new(Chain::new(joints, base, tool).unwrap(), Some("spherical_wrist")).unwrap(),
        );
    }
    let mut joints = *aubo.arm().chain().joints();
    for (i, joint) in joints.iter_mut().enumerate() {
        joint.offset_rad = i as f64 - 2.5;
    }
    assert_round_trips(&Arm::new(Chain::new(joints, base, tool).unwrap(), Some("offset_wrist")).unwrap());
}

fn assert_round_trips(arm: &Arm) {
    let seed = 723;
    let mut stream = seed::stream(seed);
    for index in 0..500 {
        let q = draw(&mut stream, arm.chain());
        let target = arm.chain().forward(&q);
        let place = format!("seed {seed} case {index}: {q:?} of {arm:?}");
        let again = arm.inverse_on(&target, arm.branch_of(&q), &q).unwrap_or_else(|| panic!("{place}"));
        assert!(change(&again, &q) < 1e-7, "{place}: became {again:?}");
    }
}

#[test]
fn a_chain_of_another_family_is_refused_with_the_joint_and_the_number() {
    let refusal = |name: &str, edit: fn(&mut [crate::kinematics::Joint; AXES]), solver_name: &str| {
        let robot = robot(name);
        let mut joints = *robot.arm().chain().joints();
        edit(&mut joints);
        let chain = Chain::new(joints, Frame::IDENTITY, Frame::IDENTITY).unwrap();
        solver(solver_name, &chain).unwrap_err().to_string()
    };
    let cases = [
        (
            refusal("aubo_i10", |_| (), "spherical_wrist"),
            "joint 3: alpha_deg is 180; accepted: 90 or -90, for the solver `spherical_wrist`; `offset_wrist` fits",
        ),
        (refusal("motoman_up6", |_| (), "offset_wrist"), "joint 1: a_mm is 150; accepted: 0, for"),
        (refusal("motoman_up6", |j| j[4].d_m = 0.01, "spherical_wrist"), "joint 5: d_mm is 10; accepted: 0"),
        (refusal("motoman_up6", |j| j[3].a_m = 0.02, "spherical_wrist"), "joint 4: a_mm is 20; accepted: 0"),
        (
            refusal("motoman_up6", |j| j[1].a_m = 0.0, "spherical_wrist"),
            "joint 2: a_mm is 0; accepted: another",
        ),
        (
            refusal("motoman_up6", |j| j[3].alpha_rad = 1.4, "spherical_wrist"),
            "joint 4: alpha_deg is 80.2140",
        ),
        (
            refusal("motoman_up6", |_| (), "newton"),
            "solver `newton` does not exist; the solvers are numerical, offset_wrist, spherical_wrist",
        ),
    ];
    for (found, expected) in cases {
        assert!(found.starts_with(expected), "`{found}` does not begin `{expected}`");
    }
}

/// What a lane says (0: an answer, 1: out of reach, 2: left to the scalar code), held to `single`.
fn lane_outcome(found: &LaneSolutions, lane: usize, single: Option<Joints>, place: &str) -> usize {
    if found.unreachable >> lane & 1 == 1 {
        assert_eq!(single, None, "{place}");
        return 1;
    }
    if found.solved >> lane & 1 == 0 {
        return 2;
    }
    let single = single.unwrap_or_else(|| panic!("{place}: out of reach"));
    for (joint, angle) in single.iter().enumerate() {
        let off = crate::kinematics::angle::wrapped(found.q[joint][lane] - angle);
        assert!(off.abs() < 1e-11, "{place}: joint {joint} is off by {off}");
    }
    0
}

#[test]
fn four_lanes_find_what_one_branch_at_a_time_finds_and_pass_on_what_is_singular() {
    let robot = robot("motoman_up6");
    let mut stream = seed::stream(723);
    let arm = robot.arm();
    let mut counts = [[0; 3]; 2];
    for index in 0..25_000 {
        let drawn: [Joints; LANES] = std::array::from_fn(|_| {
            let mut q = draw(&mut stream, arm.chain());
            q[4] *= if stream.random_bool(0.1) { 1e-2 } else { 1.0 };
            q
        });
        // A tool pulled outwards is out of reach now and then.
        let targets = drawn.map(|q| {
            let tool = arm.chain().forward(&q);
            let pull = if stream.random_bool(0.3) { stream.random_range(1.0..1.3) } else { 1.0 };
            Frame { origin: tool.origin * pull, ..tool }
        });
        let number =
            |t: Frame, row: usize| if row < 9 { t.rotation[(row % 3, row / 3)] } else { t.origin[row - 9] };
        let rows = std::array::from_fn(|row| targets.map(|t| number(t, row)));
        for (lane, (target, q)) in targets.iter().zip(&drawn).enumerate() {
            let place = format!("seed 723 case {index} lane {lane}: {q:?}");
            let branch = arm.branch_of(q);
            let single = arm.solver.solve(&arm.flange(target), branch, q);
            for (level, counts) in levels().into_iter().zip(&mut counts) {
                let found = on_level(level, || arm.solve_lanes(&rows, branch)).unwrap();
                counts[lane_outcome(&found, lane, single, &format!("{place} on {level:?}"))] += 1;
            }
        }
    }
    for [sure, lost, passed] in counts {
        assert!(sure > 60_000 && lost > 2_000 && (1_000..10_000).contains(&passed), "{sure} {lost} {passed}");
    }
}

const UP6_BITS: &str = "7396362d56cba7e1f3faee5b578395c1fcaaa51cae4847b9ae8502dd02bcd9ae";
const AUBO_BITS: &str = "b41aeac5017c533e677b0c25be8ea042c795c4a63dd1f52bf9ec6a38e6718826";

/// The bits of every configuration and branch for drawn poses, as one fingerprint; each fourth pose has a straight wrist or an
/// elbow at full stretch.
fn fingerprint(name: &str) -> String {
    let robot = robot(name);
    let arm = robot.arm();
    let mut stream = seed::stream(725);
    let mut bytes = Vec::new();
    for index in 0..20_000 {
        let mut q = draw(&mut stream, arm.chain());
        match index % 8 {
            0 => q[4] = [0.0, 1e-12, 1e-8, -1e-7][index / 8 % 4],
            4 => q[2] = 0.0,
            _ => {}
        }
        let reference = draw(&mut stream, arm.chain());
        for (branch, found) in arm.inverse(&arm.chain().forward(&q), &reference).iter() {
            bytes.push(branch.0);
            bytes.extend(found.iter().flat_map(|angle| angle.to_bits().to_le_bytes()));
        }
        bytes.push(arm.branch_of(&q).0);
        bytes.extend(arm.nearest_flip_rad(&q, &reference).to_bits().to_le_bytes());
    }
    base::hash::sha256(&bytes)
}

#[test]
fn the_up6_and_the_aubo_answer_with_the_bits_that_stored_trials_were_run_with() {
    assert_eq!(fingerprint("motoman_up6"), UP6_BITS);
    assert_eq!(fingerprint("aubo_i10"), AUBO_BITS);
}
