//! Seven axes among a ball, and spheres in lanes against the scalar code.

use super::*;
use base::robot::{Joint, Kind};
use base::solid::{Form, Pose};

/// Seven joints in a row that turn about z, y, z, ..., each with a rod of 0.2 m.
fn seven() -> Robot {
    let up = |z: f64| Pose { origin_m: [0.0, 0.0, z], ..Pose::IDENTITY };
    let joint = |i: usize| Joint {
        name: format!("joint {i}"),
        before: up(0.2),
        axis: if i.is_multiple_of(2) { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] },
        kind: Kind::Turns,
        limits: [-2.5, 2.5],
        speed: None,
    };
    let rod = |i: usize| Solid { name: format!("rod {i}"), pose: up(0.1), form: Form::Cylinder(0.03, 0.18) };
    Robot {
        name: "seven".to_owned(),
        base: "base".to_owned(),
        joints: (0..7).map(joint).collect(),
        solids: (0..=7).map(|i| (i, rod(i))).collect(),
        owners: (0..=7).map(|i| rod(i).name).collect(),
        tip: up(0.2),
        files: Vec::new(),
        notes: Vec::new(),
    }
}

fn ball(x: f64, z: f64) -> Solid {
    let pose = Pose { origin_m: [x, 0.0, z], ..Pose::IDENTITY };
    Solid { name: "ball".to_owned(), pose, form: Form::Sphere(0.1) }
}

#[test]
fn seven_axes_move_and_stop_at_what_is_in_the_way() {
    let space = JointSpace::new(seven(), vec![ball(0.8, 0.4)], &SelfContact::Apart, 0.05);
    let up = [0.0; 7];
    assert!((space.chain().forward(&up).origin - Vec3::z() * 1.6).norm() < 1e-12);
    assert_eq!(space.refusal(&up), None);
    let mut level = up;
    level[1] = std::f64::consts::FRAC_PI_2;
    assert_eq!(space.refusal(&level).unwrap(), "part `rod 5` is in contact with `ball`");
    let mut below = up;
    below[1] = 2.2;
    let mut checked = 0;
    assert!(space.is_free(&below) && !space.joins(&up, &below, &mut checked), "the ball is between the two");
    assert!(checked > 10, "{checked}");
    level[0] = 3.0;
    assert!(space.refusal(&level).unwrap().contains("joint `joint 0` is at 3 rad, outside -2.5 to 2.5"));
}

#[test]
fn a_robot_that_keeps_a_clearance_is_refused_beside_what_it_does_not_touch() {
    let level = [0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0];
    // The ball ends 40 mm below the axis of the rods, whose prisms end 30.3 mm below it at most.
    let below = || vec![ball(0.8, 0.26)];
    let space =
        |clearance_m| JointSpace::with_clearance(seven(), below(), &SelfContact::Apart, 0.05, clearance_m);
    assert_eq!(space(0.009).refusal(&level), None);
    assert!(space(0.011).refusal(&level).is_some_and(|text| text.contains("`ball`")));
}

#[test]
fn a_robot_that_folds_onto_itself_is_reported_unless_nobody_asks() {
    let mut folded = [0.0; 7];
    (folded[1], folded[3], folded[5]) = (0.0, 2.4, 2.4);
    let refusal = JointSpace::new(seven(), Vec::new(), &SelfContact::Apart, 0.05).refusal(&folded);
    assert!(refusal.is_some_and(|text| text.contains("are in contact")), "it must touch");
    assert!(JointSpace::new(seven(), Vec::new(), &SelfContact::Unchecked, 0.05).is_free(&folded));
}

/// The arm of seven joints with four spheres a link; its first joint turns on and its last slides.
fn of_spheres() -> Robot {
    let robot = seven();
    let sphere = |(link, rod): &(usize, Solid)| {
        let at = |k: usize| Pose { origin_m: [0.01 * k as f64, 0.0, 0.05 * k as f64], ..Pose::IDENTITY };
        let ball = |k| Solid { name: rod.name.clone(), pose: at(k), form: Form::Sphere(0.04) };
        (0..4).map(move |k| (*link, ball(k))).collect::<Vec<_>>()
    };
    let solids: Vec<(usize, Solid)> = robot.solids.iter().flat_map(sphere).collect();
    let owners = solids.iter().map(|(_, solid)| solid.name.clone()).collect();
    let mut joints = robot.joints.clone();
    joints[0].kind = Kind::TurnsOn;
    (joints[6].kind, joints[6].limits) = (Kind::Slides, [0.0, 0.4]);
    joints[3].axis = [0.6, 0.0, 0.8];
    joints[4].axis = [0.0, 0.0, -1.0];
    Robot { joints, solids, owners, ..robot }
}

#[test]
fn motions_in_lanes_are_free_where_the_scalar_code_finds_them_free() {
    let place = |x: f64, z: f64| Pose::from_rpy([x, 0.1, z], [0.3, -0.4, 0.5]);
    let solid = |name: &str, pose, form| Solid { name: name.to_owned(), pose, form };
    let obstacles = vec![
        ball(0.9, 0.4),
        solid("box", place(-0.5, 0.9), Form::Box([0.2, 0.3, 0.1])),
        solid("can", place(0.3, 1.3), Form::Cylinder(0.15, 0.4)),
        solid(
            "hull",
            place(0.2, -0.6),
            Form::Hull(vec![[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]]),
        ),
    ];
    for clearance_m in [0.0, 0.02] {
        compare_with_the_scalar_code(obstacles.clone(), clearance_m);
    }
}

fn compare_with_the_scalar_code(obstacles: Vec<Solid>, clearance_m: f64) {
    let space = JointSpace::with_clearance(of_spheres(), obstacles, &SelfContact::Apart, 0.1, clearance_m);
    assert!(space.spheres.is_some(), "the robot is made of spheres");
    let scalar = JointSpace { spheres: None, ..space.clone() };
    let mut stream = base::seed::stream(23);
    let mut draw = || -> Vec<f64> {
        let joints = &space.robot().joints;
        joints
            .iter()
            .map(|joint| rand::RngExt::random_range(&mut stream, joint.limits[0]..=joint.limits[1]))
            .collect()
    };
    let (mut free, mut hit) = (0, 0);
    for case in 0..400 {
        let (from, to) = (draw(), draw());
        let to = space.chain().change(&from, &to).zip(&from).map(|(by, a)| a + 0.2 * by).collect::<Vec<_>>();
        let mut memory = MotionMemory::default();
        let mut plain = 0;
        let truth = scalar.goes([&from, &to], 1.0, &mut memory, &mut plain);
        for level in crate::geometry::lanes::levels() {
            let mut wide = 0;
            let found = crate::geometry::lanes::on_level(level, || {
                space.goes([&from, &to], 1.0, &mut memory, &mut wide)
            });
            assert_eq!(
                (found, wide),
                (truth, plain),
                "seed 23 case {case} on {level:?}, {clearance_m} m apart: {from:?} {to:?}"
            );
        }
        if truth { free += 1 } else { hit += 1 }
    }
    assert!(free > 60 && hit > 60, "one-sided sample: {free} free, {hit} in contact");
}

#[test]
fn few_configurations_are_left_to_the_scalar_code() {
    let space = JointSpace::new(of_spheres(), vec![ball(0.9, 0.4)], &SelfContact::Apart, 0.1);
    let spheres = space.spheres.as_ref().unwrap();
    let mut lanes = lanes::Memory::default();
    let mut stream = base::seed::stream(29);
    let mut doubts = 0;
    for _ in 0..500 {
        let rows: Vec<RoughRow> = (0..7)
            .map(|_| std::array::from_fn(|_| rand::RngExt::random_range(&mut stream, -0.4_f32..0.4)))
            .collect();
        if !dispatch!(level(), simd => spheres.touches(simd, &rows, false, &mut lanes)) {
            doubts += lanes.doubts.iter().flat_map(|doubt| doubt.is_at).filter(|is_in| *is_in).count();
        }
    }
    assert!(doubts < 10, "{doubts} of 4000 configurations in doubt");
}

/// What is thinner than a step may stand between two configurations that are checked; a finer look meets it.
#[test]
fn a_motion_that_slips_past_something_thin_is_refused_by_a_finer_look() {
    let thin = Solid {
        name: "thin".to_owned(),
        pose: Pose { origin_m: [1.1, 0.0, 0.4], ..Pose::IDENTITY },
        form: Form::Sphere(0.001),
    };
    let space = JointSpace::new(of_spheres(), vec![thin], &SelfContact::Unchecked, 0.2);
    let mut slipped = 0;
    for case in 0..40 {
        let mut from = [0.0; 7];
        from[1] = 0.6 + 0.005 * f64::from(case);
        let mut to = from;
        to[1] += 1.6;
        let mut memory = MotionMemory::default();
        let mut goes = |finer| space.goes([&from, &to], finer, &mut memory, &mut 0);
        slipped += u32::from(goes(1.0));
        assert!(!goes(4.0), "case {case}: the arm passes what is thin");
    }
    assert!((10..35).contains(&slipped), "one-sided sample: {slipped} of 40 slipped");
}

#[test]
fn what_has_room_for_all_between_is_free_at_each_of_many_configurations() {
    let mut stream = base::seed::stream(31);
    let mut near = |middle: f64, by: f64| rand::RngExt::random_range(&mut stream, middle - by..middle + by);
    let mut thin = |k: u32| {
        let pose = Pose { origin_m: [near(0.8, 0.4), near(0.0, 0.3), near(0.5, 0.3)], ..Pose::IDENTITY };
        Solid { name: format!("thin {k}"), pose, form: Form::Sphere(0.001) }
    };
    let thin = (0..300).map(&mut thin).collect();
    let mut robot = of_spheres();
    robot.solids.iter_mut().for_each(|(_, solid)| solid.form = Form::Sphere(0.01));
    let mut space = JointSpace::new(robot, thin, &SelfContact::Apart, 0.2);
    let mut memory = MotionMemory::default();
    let (mut free, mut slipped) = (0, 0);
    for case in 0..4000 {
        let most = near(0.3, 0.3);
        let from = [0.0, 0.9, 0.0, 0.0, 0.0, 0.0, 0.2].map(|at| near(at, 0.2));
        let to = from.map(|at| near(at, most));
        space.self_pairs.truncate(if case % 2 == 0 { 0 } else { 1000 });
        let is_free = space.goes([&from, &to], 64.0, &mut memory, &mut 0);
        let holds = space.holds([&from, &to], &mut memory, &mut 0);
        assert!(is_free || !holds, "case {case}: {from:?} {to:?}");
        free += u32::from(holds);
        slipped += u32::from(!is_free && space.goes([&from, &to], 1.0, &mut memory, &mut 0));
    }
    assert!(free > 60 && slipped > 20, "one-sided sample: {free} have room, {slipped} slip past something");
}

/// A ball may graze another between two configurations at which both are apart; a path's motions are looked at as finely as that takes.
#[test]
fn a_graze_between_two_looks_is_refused_where_a_path_is_returned() {
    let of = |z: f64| {
        let mut robot = of_spheres();
        robot.solids.retain(|(link, _)| *link == 6);
        robot.solids.truncate(1);
        robot.owners.truncate(1);
        let ball = Solid { pose: Pose { origin_m: [0.0, 0.0, z], ..Pose::IDENTITY }, ..ball(0.0, 0.0) };
        JointSpace::new(robot, vec![ball], &SelfContact::Unchecked, 0.05)
    };
    // The robot's only ball goes a circle whose top is at 1.2 m; the obstacle stands above it, 0.01 mm too low or too high.
    let top_m = 1.2 + 0.04 + 0.1;
    let mut memory = MotionMemory::default();
    let (mut slipped, mut refused) = (0, 0);
    for case in 0..40 {
        let mut from = [0.0; 7];
        from[1] = -0.7 - 0.0007 * f64::from(case);
        let mut to = from;
        to[1] += 1.4;
        let grazing = of(top_m - 1e-5);
        slipped += u32::from(grazing.goes([&from, &to], 4.0, &mut memory, &mut 0));
        refused += u32::from(!grazing.holds([&from, &to], &mut memory, &mut 0));
        let apart = of(top_m + 1e-5);
        assert!(apart.holds([&from, &to], &mut memory, &mut 0), "case {case}: nothing touches");
    }
    assert!((5..35).contains(&slipped), "one-sided sample: {slipped} of 40 slip past");
    assert_eq!(refused, 40, "every graze is refused");
}
