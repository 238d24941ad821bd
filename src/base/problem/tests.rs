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
    let expected = Expected { robot: "panda", base: "base", joints: vec!["lift", "turn"] };
    ProblemFile::parse(Document::new(Path::new("p.json"), text.to_owned()))
        .and_then(|file| file.problem(set, index, Some(&expected)))
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
    let expected = "p.json:5:18: obstacles are `capsule`; box, cylinder, sphere are accepted";
    assert!(error.contains(expected), "should say {expected}\nsays {error}");
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
        "p.json:19:41: position is `NaN`; a finite number is accepted",
    ),
    (
        "start: [0.0, 1.5]",
        "start: [0.0, 90]",
        "p.json:20:16: start has the angle 90; is it in degrees? radians",
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
    (
        "position: [0, 1, 0]",
        "position: [0, 1e400, 0]",
        "p.json:19:41: position is `1e400`; a finite number is accepted",
    ),
    ("start: [0.0, 1.5]", "start: [0.0, 1.5", "this is neither YAML nor JSON"),
    ("world_frame: base\n", "world_frame: base\n---\nb: 1\n", "p.json:22:1: a second document begins here"),
    ("world_frame: base\n", "world_frame: base\n...\nb: 1\n", "p.json:23:1: a second document begins here"),
    ("world_frame: base\n", "world_frame: base\n...\nb: [\n", "a second document begins here"),
    ("world_frame: base\n", "world_frame: base\ninflate: 0.1\n", "unknown key `inflate`; accepted: problems"),
    ("world_frame: base\n", "world_frame: base\ntool: hand\n", "unknown key `tool`; accepted: problems"),
    ("world_frame: base\n", "world_frame: base\nlower: [0, 0]\n", "unknown key `lower`; accepted: problems"),
    ("world_frame: base\n", "world_frame: base\nupper: [0, 0]\n", "unknown key `upper`; accepted: problems"),
    (
        "world_frame: base\n",
        "world_frame: base\nwaypoints: [[0, 0]]\n",
        "unknown key `waypoints`; accepted: problems",
    ),
];

#[test]
fn what_is_wrong_with_a_problem_is_reported_at_its_place() {
    for (from, to, expected) in WRONG {
        let text = ROBOMETRICS.replace("- - [0.1, 0.2]", "- [0.1, 0.2]");
        assert!(text.contains(*from), "{from}");
        let error = read(&text.replace(*from, to), None, 1).unwrap_err();
        assert!(error.contains(expected), "{to}: should say {expected}\nsays {error}");
    }
    for (set, index, expected) in [
        (Some("shelf"), 0, "p.json:1:1: there is no `shelf`; found are `shelf_panda`"),
        (None, 2, "p.json:2:3: problem 2 is requested; the set has 2, counted from 0"),
    ] {
        let error = read(ROBOMETRICS, set, index).unwrap_err();
        assert!(error.contains(expected), "should say {expected}\nsays {error}");
    }
}

#[test]
fn the_page_of_files_lists_the_words_that_refuse_a_key() {
    let page = include_str!("../../../docs/FILES.md");
    let listed =
        page.split_once("one of these words or their plurals: `").unwrap().1.split_once('`').unwrap().0;
    assert_eq!(listed.split_whitespace().collect::<Vec<_>>(), reader::MEANT);
}

/// What stands before the problems of VAMP's form, and the start in the order of the chain or the message about it.
const NAMED: &[(&str, Result<[f64; 2], &str>)] = &[
    ("", Ok([0.0, 1.5])),
    (r#""robot": "PAN-da", "joints": ["turn", "lift"],"#, Ok([1.5, 0.0])),
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
    (r#""robot": "pand","#, Err("the problems are for the robot `pand`; `panda` is accepted")),
    (r#""robot": "panda10","#, Err("the problems are for the robot `panda10`; `panda` is accepted")),
    (r#""robot": "","#, Err("the problems are for the robot ``; `panda` is accepted")),
    (
        r#""joint_names": ["turn", "lift"],"#,
        Err("unknown key `joint_names`; accepted: problems, robot, joints"),
    ),
    (r#""units": "mm","#, Err("unknown key `units`; accepted: problems, robot, joints")),
    (
        r#""jonts": ["turn", "lift"],"#,
        Err("unknown key `jonts` (did you mean `joints`?); accepted: problems, robot"),
    ),
];

#[test]
fn numbers_go_to_the_joints_that_the_file_names_and_other_robots_are_refused() {
    for (before, expected) in NAMED {
        let text = VAMP.replacen("\"robot\": \"panda\",", &format!("{before}           "), 1);
        match (read(&text, None, 0), expected) {
            (Ok(problem), Ok(start)) => assert_eq!(problem.start.joints, start, "{before}"),
            (Err(error), Err(expected)) => {
                assert!(error.contains(expected), "should say {expected}\nsays {error}");
            }
            (found, expected) => panic!("{before}: should be {expected:?}\nis {found:?}"),
        }
        // Beside the sets of the other form, which have no name for all of them, it is the same.
        let plain = before.trim_end_matches(',').replace('"', "");
        let text = ROBOMETRICS.replace("- - [0.1, 0.2]", "- [0.1, 0.2]");
        let other = read(
            &format!("{}\n{text}", plain.replace("], ", "]\n").replace("da, ", "da\n")),
            Some("shelf_panda"),
            1,
        );
        assert_eq!(other.is_ok(), expected.is_ok(), "{before}: {other:?}");
        if let (Ok(other), Ok(start)) = (&other, expected) {
            assert_eq!(other.start.joints, start, "{before}");
        }
    }
    let named = VAMP.replacen("\"index\": 1", "\"joints\": [\"turn\", \"lift\"], \"robot\": \"panda\"", 1);
    assert_eq!(read(&named, None, 0).unwrap().start.joints, [1.5, 0.0]);
}

/// A change of the file in VAMP's form, and the message about it; nothing if it is taken, and then its notes.
const KEYS: &[(&str, &str, Result<&[&str], &str>)] = &[
    ("\"index\": 1", "\"valid\": false, \"index\": 1", Ok(&[])),
    ("\"index\": 1", "\"robot\": \"ur5\"", Err("the problems are for the robot `ur5`; `panda` is accepted")),
    (
        "\"index\": 1",
        "\"joint_names\": [\"turn\", \"lift\"]",
        Err("unknown key `joint_names`; accepted: goals"),
    ),
    ("\"index\": 1", "\"mesh\": \"a.stl\"", Err("unknown key `mesh`; accepted: goals, goal_ik, goal, box")),
    ("\"index\": 1", "\"pointcloud\": [[0, 0, 1]]", Err("unknown key `pointcloud`; accepted: ")),
    ("\"index\": 1", "\"padding\": 0.1", Err("unknown key `padding`; accepted: ")),
    ("\"index\": 1", "\"attached\": [\"cup\"]", Err("unknown key `attached`; accepted: ")),
    ("\"index\": 1", "\"attached_meshes\": 1", Err("unknown key `attached_meshes`; accepted: ")),
    ("\"index\": 1", "\"units\": \"mm\"", Err("unknown key `units`; accepted: ")),
    ("\"index\": 1", "\"unit\": \"deg\"", Err("unknown key `unit`; accepted: ")),
    ("\"index\": 1", "\"author\": \"us\"", Ok(&["`author` is not known and not used"])),
    ("\"index\": 1", "\"world_frame\": \"base\"", Ok(&[])),
    (
        "\"index\": 1",
        "\"world_frame\": \"table_top\"",
        Ok(&["poses in the frame `table_top` are taken as relative to the robot's base `base`"]),
    ),
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
    ("\"index\": 1", "\"is_valid\": false", Err("unknown key `is_valid`; accepted: goals")),
    ("\"index\": 1", "\"solvable\": false", Err("unknown key `solvable`; accepted: goals")),
    ("\"radius\": 0.1}", "\"radius\": NaN}", Err("radius is `NaN`; a finite number is accepted")),
    ("\"radius\": 0.1}", "\"radius\": Infinity}", Err("radius is `Infinity`; a finite number is accepted")),
];

#[test]
fn every_key_of_a_problem_is_read_ignored_for_a_reason_noted_or_refused() {
    for (from, to, expected) in KEYS {
        assert!(VAMP.contains(from), "{from}");
        match (read(&VAMP.replacen(from, to, 1), None, 0), expected) {
            (Ok(problem), Ok(notes)) => {
                assert_eq!(problem.notes, *notes, "{to}");
                assert_eq!(problem.is_valid, !to.contains("false"), "{to}");
                let ignored = ["index", "orientation_quat_xyzw", "world_frame"];
                let text = VAMP.replacen(from, to, 1);
                let is_there = |key: &&str| {
                    text.contains(*key) && (*key != ignored[1] || text.contains("euler_xyz\": [0, 0, 1.57"))
                };
                let ignored: Vec<&str> = ignored.into_iter().filter(is_there).collect();
                assert_eq!(problem.ignored.iter().collect::<Vec<_>>(), ignored, "{to}");
            }
            (Err(error), Err(expected)) => {
                assert!(error.contains(expected), "should say {expected}\nsays {error}");
            }
            (found, expected) => panic!("{to}: should be {expected:?}\nis {found:?}"),
        }
    }
}

const SCENE: &str = "robot_model_name: panda
robot_state: {joint_state: {name: [lift, turn], position: [0, 0]}}
allowed_collision_matrix: {entry_names: [hand]}
fixed_frame_transforms: [{header: {frame_id: base}, child_frame_id: world, transform: {translation: [0, 0, 0], rotation: [0, 0, 0, 1]}}]
name: \"\"
world:
  collision_objects:
    - header: {frame_id: world}
      id: plank
      pose: {position: [0.5, 0, 0], orientation: [0, 0, 0.7071067811865476, 0.7071067811865476]}
      primitives: [{type: box, dimensions: [1.2, 1.0, 0.04]}]
      primitive_poses: [{position: [0, 0, 0.2], orientation: [0, 0, 0, 1]}]
    - id: can
      primitive_poses: [{position: [0.1, 0.2, 0.3], orientation: [0, 0, 0, 1]}]
      primitives: [{type: cylinder, dimensions: [0.14, 0.02]}]
    - id: ball
      primitive_poses: [{position: [0, 1, 0]}]
      primitives: [{type: sphere, dimensions: [0.1]}]
";

const REQUEST: &str = "group_name: arm
start_state: {joint_state: {name: [turn, finger, lift], position: [1.5, 0.04, 0.0]}}
goal_constraints:
  - joint_constraints: [{joint_name: turn, position: -0.25}, {position: 0.5, joint_name: lift}]
";

fn moveit(scene: &str, request: &str) -> Result<Problem, String> {
    let expected = Expected { robot: "panda", base: "base", joints: vec!["lift", "turn"] };
    let [scene, request] = [("scene.yaml", scene), ("request.yaml", request)]
        .map(|(path, text)| Document::new(Path::new(path), text.to_owned()));
    parse_moveit(&scene, &request, &expected).map_err(|e| e.to_string())
}

#[test]
fn a_scene_and_its_request_are_the_problem_that_vamp_makes_of_them() {
    let (one, other) = (moveit(SCENE, REQUEST).unwrap(), read(VAMP, None, 0).unwrap());
    assert_eq!((&one.start.joints, &one.goals[0].joints), (&other.start.joints, &other.goals[0].joints));
    assert_eq!(one.obstacles.len(), 3);
    for (a, b) in one.obstacles.iter().zip(&other.obstacles) {
        assert_eq!((&a.name, &a.form), (&b.name, &b.form));
        let [at, by] = [&a.pose, &b.pose].map(|pose| pose.point([0.3, 0.2, 0.1]));
        assert!(at.iter().zip(by).all(|(x, y)| (x - y).abs() < 1e-12), "{}: {at:?} {by:?}", a.name);
    }
}

/// A change of a scene, and the message about it.
const WRONG_SCENES: &[(&str, &str, &str)] = &[
    ("name: \"\"", "robot_state_diff: [1]", "scene.yaml:5:19: `robot_state_diff` is not read"),
    (
        "[lift, turn], position: [0, 0]}",
        "[lift], position: [0]}, attached_collision_objects: [{id: cup}]",
        "`attached_collision_objects` is not read",
    ),
    ("    - id: ball\n", "    - id: ball\n      meshes: [{vertices: [0]}]\n", "`meshes` is not read"),
    ("type: sphere", "type: cone", "a primitive is a `cone`; box, cylinder and sphere are accepted"),
    (
        "translation: [0, 0, 0]",
        "translation: [0, 0, 1]",
        "the translation of a frame is not that of the robot's base",
    ),
    ("panda", "fetch", "the problems are for the robot `fetch`"),
    (
        "- header: {frame_id: world}",
        "- header: {frame_id: table}",
        "scene.yaml:8:26: the frame is `table`; that of the robot's base is accepted: `base`, `world`",
    ),
    (
        "{frame_id: base}",
        "{frame_id: map}",
        "the frame is `map`; that of the robot's base is accepted: `base`",
    ),
    ("translation: [0, 0, 0]", "scale: 2, translation: [0, 0, 0]", "`scale` is not read; an empty one and"),
    ("position: [0, 0]}", "position: [0, 0], foo: 3}", "`foo` is not read; an empty one and name, position"),
    ("position: [0, 0]}", "position: [0]}", "1 numbers for 2 joints"),
    ("dimensions: [0.14, 0.02]", "dimensions: [140, 20]", "is it in millimetres"),
];

/// A change of a request, and the message about it.
const WRONG_REQUESTS: &[(&str, &str, &str)] = &[
    ("joint_name: lift", "joint_name: drop", "the goal has no joint `lift` of `panda`"),
    ("finger, lift", "finger, drop", "the start has no joint `lift` of `panda`"),
    (
        "position: -0.25",
        "position: -45",
        "request.yaml:4:54: joint `turn` of the goal has the angle -45; is it in degrees",
    ),
    (
        "position: -0.25",
        "posture: 0.2, position: -0.25",
        "`posture` is not read; an empty one and joint_name",
    ),
    (
        "position: -0.25",
        "tolerance_above: 0.2, position: -0.25",
        "tolerance_above is 0.2; 0 to 0.001 is accepted: a goal is one configuration",
    ),
    (
        "position: -0.25",
        "tolerance_below: -1, position: -0.25",
        "tolerance_below is -1; 0 to 0.001 is accepted",
    ),
    ("joint_name: turn", "joint_name: lift", "the goal gives joint `lift` twice; once is accepted"),
    ("finger, lift", "lift, lift", "the start gives joint `lift` twice; once is accepted"),
    (
        "position: [1.5",
        "joint_units: deg, position: [1.5",
        "`joint_units` is not read; an empty one and name",
    ),
    (
        "position: [1.5",
        "velocity: [0, 0, 1], position: [1.5",
        "`velocity` is not read; an empty one and name",
    ),
    ("[1.5, 0.04, 0.0]", "[1.5, 0.04]", "2 numbers for 3 joints"),
    (
        "joint_state:",
        "multi_dof_joint_state: {joint_names: [base], transforms: [{translation: [1, 0, 0], rotation: [0, 0, 0, 1]}]}, joint_state:",
        "the translation of a frame is not that of the robot's base",
    ),
    ("group_name: arm", "path_constraints: {name: up}", "request.yaml:1:19: `path_constraints` is not read"),
];

#[test]
fn what_a_scene_or_a_request_holds_besides_is_refused_at_its_place() {
    for (from, to, message) in WRONG_SCENES {
        assert!(SCENE.contains(from), "{from}");
        let error = moveit(&SCENE.replacen(from, to, 1), REQUEST).unwrap_err();
        assert!(error.contains(message), "should say {message}\nsays {error}");
    }
    for (from, to, message) in WRONG_REQUESTS {
        assert!(REQUEST.contains(from), "{from}");
        let error = moveit(SCENE, &REQUEST.replacen(from, to, 1)).unwrap_err();
        assert!(error.contains(message), "should say {message}\nsays {error}");
    }
}

#[test]
fn what_of_a_scene_and_a_request_is_ignored_is_named() {
    let request = REQUEST.replacen(
        "position: -0.25",
        "position: -0.25, tolerance_above: 0.0001, tolerance_below: 0, weight: 1",
        1,
    );
    let request = request.replacen("position: [1.5", "velocity: [0, 0, 0], effort: [], position: [1.5", 1);
    let problem = moveit(SCENE, &request).unwrap();
    let ignored = [
        "allowed_collision_matrix",
        "group_name",
        "header",
        "tolerance_above",
        "tolerance_below",
        "velocity",
        "weight",
    ];
    assert_eq!(problem.ignored.iter().collect::<Vec<_>>(), ignored);
    let differs = "the start is that of the request; the `robot_state` of the scene is another one";
    let fixed = "joints of the start that do not move in `panda`: `finger`";
    assert_eq!(problem.notes, [fixed, differs]);
    let same = SCENE.replacen("position: [0, 0]}", "position: [0, 1.5]}", 1);
    assert_eq!(moveit(&same, REQUEST).unwrap().notes, [fixed]);
}

/// An archive of files.
fn tar(files: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = Vec::new();
    for (name, text) in files {
        let mut header = vec![0; 512];
        header[..name.len()].copy_from_slice(name.as_bytes());
        header[124..135].copy_from_slice(format!("{:011o}", text.len()).as_bytes());
        header[156] = b'0';
        archive.extend(header);
        archive.extend(text.as_bytes());
        archive.resize(archive.len().next_multiple_of(512), 0);
    }
    archive.extend([0; 1024]);
    archive
}

#[test]
fn an_archive_of_pairs_is_a_set_and_a_fault_in_one_leaves_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("set.tar");
    let files = [
        ("problems/shelf_panda/request0001.yaml", REQUEST),
        ("problems/shelf_panda/scene0002.yaml", SCENE),
        ("problems/shelf_panda/scene0001.yaml", SCENE),
        ("problems/box_panda/scene0001.yaml", "world: {}"),
        ("problems/box_panda/request0001.yaml", REQUEST),
        ("problems/readme.txt", "text"),
    ];
    std::fs::write(&path, tar(&files)).unwrap();
    let expected = Expected { robot: "panda", base: "base", joints: vec!["lift", "turn"] };
    let all = ProblemSet::open(&path, None).unwrap();
    assert_eq!(all.count(), 3);
    let found = |index| {
        all.problem(index, &expected).map(|problem| problem.obstacles.len()).map_err(|e| e.to_string())
    };
    let wrong = found(0).unwrap_err();
    assert!(wrong.contains("box_panda/scene0001.yaml:1:8: there is no `collision_objects`"), "{wrong}");
    assert_eq!(found(1), Ok(3));
    assert!(found(2).unwrap_err().contains("scene0002.yaml:1:1: the scene has no request"));
    assert!(found(3).unwrap_err().contains("the set has 3"));
    assert_eq!(ProblemSet::open(&path, Some("shelf")).unwrap().count(), 2);
    let none = ProblemSet::open(&path, Some("cage")).unwrap_err().to_string();
    assert!(none.contains("no scene and no request of a folder `cage`"), "{none}");
    std::fs::write(&path, &tar(&files)[..700]).unwrap();
    let cut = ProblemSet::open(&path, None).unwrap_err().to_string();
    assert!(cut.contains("it ends within `problems/shelf_panda/request0001.yaml`"), "{cut}");
}
