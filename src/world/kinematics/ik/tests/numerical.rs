//! The search, on published arms that no closed form fits.

use super::{
    closed::residual,
    draw,
    tables::{CRX10IA, JACO, UR5, XARM6, arm, joints},
    *,
};

/// Each with the reason against the closed form that is nearest.
fn general() -> [(&'static str, Arm, &'static str); 3] {
    [
        (
            "jaco",
            arm(&JACO),
            "joint 4: alpha_deg is 60; accepted: 90 or -90, for the solver `spherical_wrist`",
        ),
        ("xarm6", arm(&XARM6), "joint 5: a_mm is 76; accepted: 0, for the solver `spherical_wrist`"),
        ("crx10ia", arm(&CRX10IA), "joint 5: d_mm is 150; accepted: 0, for the solver `spherical_wrist`"),
    ]
}

#[test]
fn of_ten_thousand_reachable_poses_at_least_99_in_100_are_solved() {
    for (seed, (name, arm, reason)) in (761..).zip(general()) {
        assert_eq!((arm.solver().name, arm.solver().is_complete), ("numerical", false), "{name}");
        let text = arm.solver().to_string();
        assert!(text.contains("may miss configurations") && text.contains(reason), "{text}");
        let mut stream = seed::stream(seed);
        let mut solved = 0;
        for index in 0..10_000 {
            let [q, reference] = [draw(&mut stream, arm.chain()), draw(&mut stream, arm.chain())];
            let target = arm.chain().forward(&q);
            let branch = arm.branch_of(&q);
            let Some(found) = arm.inverse_on(&target, branch, &reference) else { continue };
            let (off_m, turned_rad) = residual(&arm.chain().forward(&found), &target);
            let place = format!("{name}, seed {seed} case {index}: {q:?} from {reference:?}");
            assert!(off_m < 1e-9 && turned_rad < 1e-9, "{place}: off {off_m} m, {turned_rad} rad");
            assert_eq!(arm.branch_of(&found), branch, "{place}");
            solved += 1;
        }
        assert!(solved >= 9_900, "{name}: {solved} of 10000");
    }
}

#[test]
fn from_a_near_reference_the_near_configuration_is_found_and_a_step_on_stays_near() {
    for (seed, (name, arm, _)) in (771..).zip(general()) {
        let mut stream = seed::stream(seed);
        let mut near = 0;
        for _ in 0..1_000 {
            let q = draw(&mut stream, arm.chain());
            let reference = q.map(|angle| (angle + stream.random_range(-0.02..0.02)).clamp(-PI, PI));
            let found = arm.inverse_on(&arm.chain().forward(&q), arm.branch_of(&q), &reference);
            near += u32::from(found.is_some_and(|found| change(&found, &q) < 1e-6));
        }
        // The rest are next to a singularity.
        assert!(near >= 970, "{name}: {near} of 1000");
    }
}

#[test]
fn distinct_configurations_are_given_once_each_and_the_same_on_every_call() {
    let seed = 781;
    let mut most = 0;
    for (name, arm, _) in general() {
        let mut stream = seed::stream(seed);
        for _ in 0..50 {
            let [q, reference] = [draw(&mut stream, arm.chain()), draw(&mut stream, arm.chain())];
            let target = arm.chain().forward(&q);
            let all = arm.inverse(&target, &reference);
            assert_eq!(all, arm.inverse(&target, &reference), "{name}, seed {seed}");
            let found: Vec<_> = all.iter().collect();
            for (i, (branch, a)) in found.iter().enumerate() {
                assert!(found[..i].iter().all(|(_, b)| change(a, b) > 1e-6), "{name}, seed {seed}: {q:?}");
                assert_eq!(arm.branch_of(a), *branch, "{name}, seed {seed}: {q:?}");
            }
            most = most.max(found.len());
        }
    }
    assert!(most > 8, "at most {most} configurations: no pose with more than a closed form has");
}

#[test]
fn the_search_finds_what_a_closed_form_finds() {
    let closed = arm(&UR5);
    let chain = Chain::new(joints(&UR5), Frame::IDENTITY, Frame::IDENTITY).unwrap();
    let search = Arm::new(chain, Some("numerical")).unwrap();
    let seed = 782;
    let mut lost = 0;
    let mut count = 0;
    let mut stream = seed::stream(seed);
    for _ in 0..300 {
        let q = draw(&mut stream, closed.chain());
        let target = closed.chain().forward(&q);
        let found = search.inverse(&target, &q);
        let all = closed.inverse(&target, &q);
        for (_, known) in all.iter() {
            lost += u32::from(!found.iter().any(|(_, one)| change(one, known) < 1e-5));
            count += 1;
        }
        assert!(found.iter().count() <= all.iter().count(), "seed {seed}: more than there are, at {q:?}");
    }
    assert!(lost * 50 < count, "{lost} of {count} are missed");
}

#[test]
fn what_is_out_of_reach_is_reported_as_such() {
    for (name, arm, _) in general() {
        let far = Frame::at(Vec3::new(2.0, 0.0, 0.5));
        assert!(arm.inverse_nearest(&far, &[0.1; AXES]).is_none(), "{name}");
    }
}
