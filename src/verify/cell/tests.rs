use super::*;
use nalgebra::Matrix4;

/// A UP6-like arm above a floor, with a box beside it.
fn case(end: LegEnd) -> Case {
    let row = |alpha_deg: f64, a_m, d_m, low: f64, high: f64| Row {
        alpha_rad: alpha_deg.to_radians(),
        a_m,
        d_m,
        offset_rad: 0.0,
        limits_rad: [low.to_radians(), high.to_radians()],
        speed_rad_s: 3.0,
    };
    let rows = [
        row(-90.0, 0.15, 0.45, -170.0, 170.0),
        row(0.0, 0.57, 0.0, -180.0, 65.0),
        row(-90.0, 0.13, 0.0, -190.0, 170.0),
        row(90.0, 0.0, 0.64, -180.0, 180.0),
        row(-90.0, 0.0, 0.0, -135.0, 135.0),
        row(0.0, 0.0, 0.095, -360.0, 360.0),
    ];
    let tool = Matrix4::new_translation(&nalgebra::Vector3::new(0.0, 0.0, 0.15));
    let chain = Chain::new(rows, Matrix4::identity(), tool);
    let finger = Part { link: 6, from_m: [0.0; 3], to_m: [0.0, 0.0, 0.15], radius_m: 0.02, exposed: true };
    let body = Body { parts: vec![finger], pairs: Vec::new() };
    let frame = Matrix4::new_translation(&nalgebra::Vector3::new(0.79, -0.3, 0.9));
    let shapes = [Shape::Behind([0.0, 0.0, 1.0], 0.0), Shape::Box(frame, [0.05, 0.05, 0.2])];
    let rules = Rules {
        straight_joints: false,
        step_m: 0.02,
        step_rad: 4_f64.to_radians(),
        jump_rad: 20_f64.to_radians(),
        speed: None,
        end,
    };
    Case::new(chain, body, &shapes, rules)
}

fn angles(degrees: [f64; 6]) -> Angles {
    degrees.map(f64::to_radians)
}

/// The configuration with the tool where `near` has it, moved by `by` (metres) with the same orientation.
fn moved(case: &Case, near: &Angles, by: [f64; 3]) -> Angles {
    let (rotation, place) = case.chain.tool(near);
    let mut at = *near;
    for step in 1..=20 {
        let share = f64::from(step) / 20.0;
        let wanted = (rotation, place + nalgebra::Vector3::from(by) * share);
        at = case.chain.near(&at, &wanted, &mut case.chain.frames(&at)).unwrap();
    }
    at
}

const HOME: [f64; 6] = [0.0, -90.0, 0.0, 0.0, 90.0, 0.0];

#[test]
fn the_tool_is_where_the_printed_home_pose_puts_it() {
    let (rotation, place) = case(LegEnd::Own).chain.tool(&angles(HOME));
    assert!((place - nalgebra::Vector3::new(0.79, 0.0, 0.905)).norm() < 1e-12, "{place:?}");
    assert!((rotation.column(2) + nalgebra::Vector3::z()).norm() < 1e-12);
}

#[test]
fn a_straight_leg_is_as_long_as_it_is_and_takes_as_long_as_the_law_says() {
    let case = case(LegEnd::Own);
    let home = angles(HOME);
    let up = moved(&case, &home, [0.0, 0.25, 0.0]);
    let motion = case.motion(&[home, up], [&home, &up]).unwrap();
    assert!((motion.length_m - 0.25).abs() < 1e-6, "{}", motion.length_m);
    // 0.125 m of ramp at either end and nothing between: 0.5 s each.
    let last = motion.stops.last().unwrap();
    assert!((last.time_s - 1.0).abs() < 1e-9, "{}", last.time_s);
    assert_eq!(motion.stops.len(), 26);
    let gaps = motion.stops.windows(2).map(|w| w[1].time_s - w[0].time_s);
    assert!(gaps.into_iter().all(|gap| (gap - follow::STOP_S).abs() < 1e-9));
    // A quarter of the ramp's time is a sixteenth of its way.
    let early = motion.stops[3].tool_m[1] - motion.stops[0].tool_m[1];
    assert!((early - 0.12 * 0.12 / 2.0).abs() < 1e-5, "{early}");
    let least: f64 = home.iter().zip(&up).map(|(a, b)| (a - b).abs()).sum();
    assert!(motion.travel_rad >= least - 1e-9 && motion.travel_rad < 3.0 * least, "{}", motion.travel_rad);
    assert!(motion.peak_rad_s2 > 0.5 && motion.peak_rad_s2 < 20.0, "{}", motion.peak_rad_s2);
}

#[test]
fn every_way_of_being_wrong_is_refused_in_words() {
    let own = case(LegEnd::Own);
    let home = angles(HOME);
    let far = moved(&own, &home, [0.0, 0.3, 0.1]);
    let refusal = |case: &Case, path: &[Angles], ends: [&Angles; 2]| case.motion(path, ends).unwrap_err();
    assert!(refusal(&own, &[home], [&home, &far]).contains("start to goal"));
    assert!(refusal(&own, &[], [&home, &far]).contains("without a path"));
    let through = {
        let mut around = moved(&own, &home, [-0.2, 0.0, 0.0]);
        around = moved(&own, &around, [0.0, -0.6, 0.0]);
        moved(&own, &around, [0.2, 0.0, 0.0])
    };
    let hit = refusal(&own, &[home, through], [&home, &through]);
    assert!(hit.contains("leg 1") && hit.contains("touches obstacle 2"), "{hit}");
    let mut turned = far;
    turned[5] += std::f64::consts::TAU;
    turned[5] -= if turned[5] > 6.0 { 2.0 * std::f64::consts::TAU } else { 0.0 };
    let end = refusal(&own, &[home, turned], [&home, &turned]);
    assert!(end.contains("joint 6 arrives"), "{end}");
    assert!(case(LegEnd::WholeTurns).motion(&[home, turned], [&home, &turned]).is_ok());
    let mut beyond = home;
    beyond[0] = 3.0;
    let limits = refusal(&own, &[beyond, home], [&beyond, &home]);
    assert!(limits.contains("joint 1 is outside its limits"), "{limits}");
    let down = angles([0.0, 0.0, 60.0, 0.0, 30.0, 0.0]);
    let floor = refusal(&own, &[down, home], [&down, &home]);
    assert!(floor.contains("obstacle 1"), "{floor}");
}

#[test]
fn a_tool_that_is_too_fast_for_a_joint_is_refused() {
    let mut case = case(LegEnd::Own);
    let home = angles(HOME);
    let far = moved(&case, &home, [0.0, 0.3, 0.0]);
    assert!(case.motion(&[home, far], [&home, &far]).is_ok());
    case.rules.speed = Some([20.0, 400.0]);
    case.known().clear();
    let refusal = case.motion(&[home, far], [&home, &far]).unwrap_err();
    assert!(refusal.contains("faster than it can be"), "{refusal}");
}

/// The planner asks neither a jump nor a speed where joints go straight: the path is theirs, not the tool's.
#[test]
fn joints_that_go_straight_need_no_speed_of_the_tool() {
    let mut case = case(LegEnd::Own);
    let home = angles(HOME);
    let far = moved(&case, &home, [0.0, 0.3, 0.0]);
    case.rules.speed = Some([20.0, 400.0]);
    assert!(case.motion(&[home, far], [&home, &far]).unwrap_err().contains("faster than it can be"));
    case.rules.straight_joints = true;
    case.known().clear();
    assert!(case.motion(&[home, far], [&home, &far]).is_ok());
}
