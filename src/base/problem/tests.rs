//! Problem files, right and wrong.

use super::*;
use crate::solid::Form;
use std::f64::consts::FRAC_1_SQRT_2 as H;
use std::path::Path;

const ROBOMETRICS: &str = "shelf_panda:
- goal_ik:
  - - [0.1, 0.2]
  obstacles: {}
  start: [0, 0]
- collision_buffer_ik: 0
  goal_ik:
  - - 0.5
    - -0.25
  goal_pose: {frame: hand, position_xyz: [0, 0, 1], quaternion_wxyz: [1, 0, 0, 0]}
  obstacles:
    cuboid:
      plank:
        dims: [1.2, 1.0, 0.04]
        pose: [0.5, 0, 0.2, 0.7071067811865476, 0, 0, 0.7071067811865476]
    cylinder:
      can: {height: 0.14, radius: 0.02, pose: [0.1, 0.2, 0.3, 1, 0, 0, 0]}
    sphere:
      ball: {radius: 0.1, position: [0, 1, 0]}
  start: [0.0, 1.5]
  world_frame: base
";

const VAMP: &str = r#"{"robot": "panda", "problems": {"shelf": [{"index": 1, "start": [0.0, 1.5], "goals": [[0.5, -0.25]],
      "box": [{"name": "plank", "position": [0.5, 0, 0.2], "orientation_euler_xyz": [0, 0, 1.5707963267948966],
               "half_extents": [0.6, 0.5, 0.02]}],
      "cylinder": [{"name": "can", "position": [0.1, 0.2, 0.3], "orientation_euler_xyz": [0, 0, 0], "radius": 0.02, "length": 0.14}],
      "sphere": [{"name": "ball", "position": [0, 1, 0], "radius": 0.1}]}]}}"#;

fn read(text: &str, set: Option<&str>, index: usize) -> Result<Problem, String> {
    let expected = Expected { robot: "panda", joints: vec!["lift", "turn"] };
    parse_problem(&Document::new(Path::new("p.json"), text.to_owned()), set, index, Some(&expected))
        .map_err(|e| e.to_string())
}

#[test]
fn both_forms_of_a_problem_read_the_same() {
    let text = ROBOMETRICS.replace("- - [0.1, 0.2]", "- [0.1, 0.2]");
    let (one, other) = (read(&text, None, 1).unwrap(), read(VAMP, Some("shelf"), 0).unwrap());
    assert_eq!(one.start.joints, other.start.joints);
    assert_eq!(one.goals[0].joints, [0.5, -0.25]);
    assert_eq!(other.goals[0].joints, [0.5, -0.25]);
    for (a, b) in one.obstacles.iter().zip(&other.obstacles) {
        assert_eq!((&a.name, &a.form), (&b.name, &b.form));
        let [at, by] = [&a.pose, &b.pose].map(|pose| pose.point([0.3, 0.2, 0.1]));
        assert!(at.iter().zip(by).all(|(x, y)| (x - y).abs() < 1e-15), "{}: {at:?} {by:?}", a.name);
    }
    assert_eq!(one.obstacles[0].form, Form::Box([0.6, 0.5, 0.02]));
    let turned = one.obstacles[0].pose.point([1.0, 0.0, 0.0]);
    assert!((turned[1] - 2.0 * H * H).abs() < 1e-12, "{turned:?}: x of the plank is y of the world");
}

#[test]
fn obstacles_of_a_kind_that_is_not_known_are_not_passed_over() {
    let error = read(&VAMP.replacen("\"sphere\":", "\"capsule\":", 1), None, 0).unwrap_err();
    let said = "p.json:5:18: obstacles are `capsule`; box, cylinder, sphere are accepted";
    assert!(error.contains(said), "should say {said}\nsays {error}");
    let kept = VAMP.replacen("\"index\": 1", "\"valid\": true, \"tags\": [1, 2]", 1);
    let kept = read(&kept, None, 0).unwrap();
    assert_eq!((kept.obstacles.len(), kept.notes), (3, vec!["`tags` is not known and not used".to_owned()]));
}

#[test]
fn a_quaternion_with_its_real_part_last_turns_as_one_with_its_real_part_first() {
    let last = format!("\"orientation_quat_xyzw\": [0, 0, {H}, {H}]");
    let text = VAMP.replacen("\"orientation_euler_xyz\": [0, 0, 1.5707963267948966]", &last, 1);
    assert_ne!(text, VAMP);
    let [one, other] = [VAMP, &text].map(|text| read(text, None, 0).unwrap().obstacles[0].pose);
    let [at, by] = [one, other].map(|pose| pose.point([0.3, 0.2, 0.1]));
    assert!(at.iter().zip(by).all(|(x, y)| (x - y).abs() < 1e-15), "{at:?} {by:?}");
    let short =
        read(&text.replacen(&last, "\"orientation_quat_xyzw\": [0, 0, 0.7, 0.8]", 1), None, 0).unwrap_err();
    assert!(
        short.starts_with("p.json:2:") && short.contains("of length 1.0630; 0.99 to 1.01 is accepted"),
        "{short}"
    );
}

/// A change of the file, and the message about it.
const WRONG: &[(&str, &str, &str)] = &[
    (
        "0.7071067811865476]",
        "0.8]",
        "p.json:15:15: pose has the quaternion 0.7071067811865476, 0, 0, 0.8 (w, x, y, z) of length 1.0677",
    ),
    (
        "dims: [1.2,",
        "dims: [1200,",
        "p.json:14:15: dims has the length 1200 m; is it in millimetres? lengths in metres",
    ),
    ("radius: 0.02", "radius: -0.02", "p.json:17:35: radius has the size -0.02; sizes above 0 are accepted"),
    (
        "position: [0, 1, 0]",
        "position: [0, .nan, 0]",
        "p.json:19:41: position is `.nan`; a number is accepted",
    ),
    (
        "position: [0, 1, 0]",
        "position: [0, NaN, 0]",
        "p.json:19:41: position has the number NaN; finite numbers",
    ),
    (
        "start: [0.0, 1.5]",
        "start: [0.0, 90]",
        "p.json:20:10: start has the angle 90; is it in degrees? radians",
    ),
    (
        "start: [0.0, 1.5]",
        "start: [0.0]",
        "p.json:20:10: start has 1 numbers; 2, as the robot has joints, are accepted",
    ),
    (
        "goal_ik:\n  - - 0.5\n    - -0.25",
        "goal_is: 0",
        "p.json:7:12: unknown key `goal_is` (did you mean `goal_ik`?); accepted: goals, goal_ik, goal, obstacles",
    ),
    (
        "    sphere:",
        "    mesh:",
        "p.json:19:7: an obstacle is a `mesh`; cuboid, cylinder and sphere are accepted",
    ),
    ("start: [0.0, 1.5]", "start: [0.0, 1.5", "this is neither YAML nor JSON"),
];

#[test]
fn what_is_wrong_with_a_problem_is_told_at_its_place() {
    for (from, to, said) in WRONG {
        let text = ROBOMETRICS.replace("- - [0.1, 0.2]", "- [0.1, 0.2]");
        assert!(text.contains(*from), "{from}");
        let error = read(&text.replace(*from, to), None, 1).unwrap_err();
        assert!(error.contains(said), "{to}: should say {said}\nsays {error}");
    }
    for (set, index, said) in [
        (Some("shelf"), 0, "p.json:1:1: there is no `shelf`; found are `shelf_panda`"),
        (None, 2, "p.json:2:3: problem 2 is requested; the set has 2, counted from 0"),
    ] {
        let error = read(ROBOMETRICS, set, index).unwrap_err();
        assert!(error.contains(said), "should say {said}\nsays {error}");
    }
}

/// What stands before the problems of VAMP's form, and the start in the order of the chain or the message about it.
const NAMED: &[(&str, Result<[f64; 2], &str>)] = &[
    ("", Ok([0.0, 1.5])),
    (r#""robot": "Panda-Arm", "joints": ["turn", "lift"],"#, Ok([1.5, 0.0])),
    (
        r#""joints": ["turn", "nod"],"#,
        Err("p.json:1:21: `panda` has no joint `nod` that moves; it has lift, turn"),
    ),
    (r#""joints": ["turn", "turn"],"#, Err("p.json:1:21: joint `turn` is given twice; once is accepted")),
    (
        r#""joints": ["turn"],"#,
        Err("p.json:1:12: joint `lift` of `panda` is missing; all joints are accepted"),
    ),
    (r#""robot": "ur5","#, Err("the problems are for the robot `ur5`; `panda` is accepted")),
    (
        r#""jonts": ["turn", "lift"],"#,
        Err("unknown key `jonts` (did you mean `joints`?); accepted: problems, robot"),
    ),
];

#[test]
fn numbers_go_to_the_joints_that_the_file_names_and_other_robots_are_refused() {
    for (before, said) in NAMED {
        let text = VAMP.replacen("\"robot\": \"panda\",", &format!("{before}           "), 1);
        match (read(&text, None, 0), said) {
            (Ok(problem), Ok(start)) => assert_eq!(problem.start.joints, start, "{before}"),
            (Err(error), Err(said)) => assert!(error.contains(said), "should say {said}\nsays {error}"),
            (found, said) => panic!("{before}: should be {said:?}\nis {found:?}"),
        }
    }
}

/// A change of the file in VAMP's form, and the message about it; nothing if it is taken, and then its notes.
const KEYS: &[(&str, &str, Result<&[&str], &str>)] = &[
    ("\"index\": 1", "\"valid\": false, \"index\": 1", Ok(&[])),
    ("\"index\": 1", "\"valid\": 7", Err("valid is `7`; true or false, yes or no, 1 or 0 is accepted")),
    ("\"index\": 1", "\"vaild\": false", Err("unknown key `vaild` (did you mean `valid`?)")),
    (
        "\"index\": 1",
        "\"goal\": [0, 0]",
        Err("a problem has both `goals` and `goal`; one of them is accepted"),
    ),
    (
        "\"goals\": [[0.5, -0.25]]",
        "\"goals\": []",
        Err("the list of goals is empty; at least one is accepted"),
    ),
    (
        "\"radius\": 0.1}",
        "\"radius\": 0.1, \"scale\": 2}",
        Err("unknown key `scale`; accepted: radius, name, position"),
    ),
    (
        "\"length\": 0.14",
        "\"length\": 0.14, \"height\": 0.2",
        Err("unknown key `height`; accepted: radius, length"),
    ),
    (
        "\"half_extents\"",
        "\"orientation_quat_xyzw\": [0, 0, 0, 1], \"half_extents\"",
        Err(
            "orientation_quat_xyzw (x, y, z, w) is another rotation than orientation_euler_xyz; one rotation",
        ),
    ),
    ("\"half_extents\"", "\"orientation_quat_xyzw\": [0, 0, 0.707, 0.707], \"half_extents\"", Ok(&[])),
    (
        "\"orientation_euler_xyz\": [0, 0, 1.5707963267948966]",
        "\"orientation_quat_xyzw\": [0, 0, 0.707, 0.707]",
        Ok(&["quaternions of few digits were made those of length 1"]),
    ),
    (
        "{\"robot\": \"panda\", \"problems\":",
        "{\"world\": {}, \"robot_model_name\": \"panda\", \"problems\":",
        Err("this is a MoveIt scene"),
    ),
    (
        "{\"robot\": \"panda\", \"problems\":",
        "{\"world\": {\"collision_objects\": []}, \"problems\":",
        Err("this is a MoveIt scene"),
    ),
    (
        "{\"robot\": \"panda\", \"problems\":",
        "{\"start_state\": {}, \"problems\":",
        Err("this is a MoveIt request"),
    ),
    ("\"radius\": 0.1}", "\"radius\": NaN}", Err("radius has the number NaN; finite numbers are accepted")),
    (
        "\"radius\": 0.1}",
        "\"radius\": Infinity}",
        Err("radius has the number inf; finite numbers are accepted"),
    ),
];

#[test]
fn every_key_of_a_problem_is_read_ignored_for_a_reason_noted_or_refused() {
    for (from, to, said) in KEYS {
        assert!(VAMP.contains(from), "{from}");
        match (read(&VAMP.replacen(from, to, 1), None, 0), said) {
            (Ok(problem), Ok(notes)) => {
                assert_eq!(problem.notes, *notes, "{to}");
                assert_eq!(problem.is_valid, !to.contains("false"), "{to}");
            }
            (Err(error), Err(said)) => assert!(error.contains(said), "should say {said}\nsays {error}"),
            (found, said) => panic!("{to}: should be {said:?}\nis {found:?}"),
        }
    }
}
