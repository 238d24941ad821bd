//! A small set of ours: what of it is valid, what is wrong and counted, and what happens while its files are missing.

use super::*;
use base::hash::sha256;
use engine::planner::{Ending, Request, find};
use engine::space::World;
use std::fs;
use tempfile::TempDir;

/// Two joints that nod about y, each with a sphere 0.5 m out.
const ROBOT: &str = r#"<robot name="nod">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0 0 0.5"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0 0 0.5"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="one" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/><limit lower="-3" upper="3"/></joint>
  <joint name="two" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/><limit lower="-3" upper="3"/></joint>
</robot>"#;

const SET: &str = r#"{"robot": "nod", "joints": ["two", "one"], "problems": {"wall": [
  {"index": 7, "start": [0, 1.2], "goals": [[0, -1.2]], "sphere": [{"position": [0, 0, 1.5], "radius": 0.2}]},
  {"start": [0, 0], "goals": [[0, -1.2]], "sphere": [{"position": [0, 0, 1.5], "radius": 0.2}]},
  {"start": [0, 1.2], "goals": [[0, -1.2]], "valid": false},
  {"start": [0, 120], "goals": [[0, -1.2]]},
  {"start": [0, 1.2], "goals": [[0, -3.5]]}
]}}"#;

const SETTINGS: &str = r#"
robot = "nod.urdf"
problems = "set.json"
support = { under = "nothing", base_mm = [0, 0, 0], yaw_deg = 0, why = "it hangs" }
self_contact = "neighbours"
step_deg = 2
"#;

fn folder(sums: &str) -> (TempDir, Inputs) {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("nod.urdf", ROBOT), ("set.json", SET), ("sums", sums)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let inputs = Inputs::below(vec![folder.path().to_owned()]);
    (folder, inputs)
}

fn settings(text: &str) -> Settings {
    Settings::composed("a test", text.parse().unwrap())
}

fn built(text: &str, inputs: &Inputs) -> Result<Box<dyn Family>, String> {
    build(&settings(text), inputs).map_err(|error| error.to_string())
}

/// The notes on this set.
fn notes_on(set: &str) -> Vec<String> {
    let (folder, inputs) = folder("");
    fs::write(folder.path().join("set.json"), set).unwrap();
    built(SETTINGS, &inputs).unwrap().notes()
}

#[test]
fn each_problem_is_an_instance_and_what_is_wrong_with_one_is_counted() {
    let (_folder, inputs) = folder("");
    let family = built(SETTINGS, &inputs).unwrap();
    let known = family.known(0);
    let counted = ["valid_problems", "set_problems"].map(|name| known[name].as_f64());
    assert_eq!(counted, [1.0, 5.0]);
    let notes = family.notes();
    let [ignored, called, refused] = &notes[..] else { panic!("{notes:?}") };
    assert_eq!(ignored, "set.json: ignored keys: `index`; docs/FILES.md has the reasons");
    assert_eq!(called, "set.json: problems that the set calls invalid: 1 of 5");
    let expected = "set.json: refused problems, which count as invalid: 3 of 5; the first: ";
    let place = "set.json:3:13: the start cannot be posed: part `lower";
    assert!(refused.starts_with(expected) && refused.contains(place), "{refused}");
    let wrong = |index| family.prepare(index).err().map(|invalid| invalid.0).unwrap_or_default();
    assert!(wrong(2).contains("the problem set calls this problem invalid"), "{}", wrong(2));
    assert!(wrong(3).contains("is it in degrees? radians are accepted"), "{}", wrong(3));
    assert!(wrong(5).contains("the set has 5"), "{}", wrong(5));
    assert!(wrong(3).contains("set.json:5:17: "), "{}", wrong(3));
    let limited = notes_on(&SET.replace("[0, 0]", "[0, 1.2]").replace("120", "1.2")).pop().unwrap();
    let expected = "1 of 5; the first: ";
    let place = "set.json:6:33: the goal cannot be posed: joint `one` is at -3.5 rad, outside -3 to 3";
    assert!(limited.contains(expected) && limited.contains(place), "{limited}");
    let planner = r#"
range = 1
sampler = "halton"
balance = 1
first = "start"
iterations = 1000
nodes = 1000
"#;
    let entry = find("rrt_connect").unwrap();
    let engine::planner::Build::Planner(build) = entry.build else { panic!("it is a planner") };
    let planner = build(&settings(planner)).unwrap();
    let plan = |index| {
        let world: World = family.prepare(index).unwrap().world;
        let query = family.queries_for(index).remove(0);
        let request = Request {
            world: &world,
            start: &query.start,
            goal: &query.goal,
            expansions: 1000,
            seed: 0,
            trace: false,
        };
        planner.plan(&request)
    };
    let solved = plan(0).unwrap();
    assert_eq!(solved.ending, Ending::Solved);
    // The values of each joint stand where the set names it.
    assert_eq!(
        (&solved.path[0][..], solved.path.last().unwrap().as_slice()),
        (&[1.2, 0.0][..], &[-1.2, 0.0][..])
    );
    assert!(solved.counts["iterations"].as_f64() > 0.0, "the ball is in the way: {:?}", solved.counts);
    assert_eq!(plan(0).unwrap(), solved);
    let refused = plan(1).unwrap_err().0;
    assert!(refused.contains("the start cannot be posed: part `lower"), "{refused}");
    let beyond = plan(4).unwrap_err().0;
    assert!(beyond.contains("the goal cannot be posed: joint `one` is at -3.5 rad"), "{beyond}");
}

#[test]
fn names_that_are_empty_and_steps_in_radians_are_refused() {
    let (_folder, inputs) = folder("");
    for (from, to, expected) in [
        (
            "step_deg = 2",
            "step_deg = 2\nrobot_name = ''",
            "`robot_name` is \"\"; text in quotes, not empty, is accepted",
        ),
        (
            "step_deg = 2",
            "step_deg = 2\nboxes_in = ''",
            "`boxes_in` is \"\"; text in quotes, not empty, is accepted",
        ),
        ("step_deg = 2", "step_deg = 0.1745", "step_deg is 0.1745; is it in radians? degrees are accepted"),
    ] {
        let refused = built(&SETTINGS.replacen(from, to, 1), &inputs).err().expect(to);
        assert!(refused.contains(expected), "{to}: {refused}");
    }
}

#[test]
fn files_that_sums_pin_may_be_missing_and_must_be_what_the_sums_say() {
    let pinned = format!("{SETTINGS}archive = {{ install = \"bring it\", sums = \"sums\" }}\n");
    let sums = format!("{}  nod.urdf\n{}  set.json\n", sha256(ROBOT.as_bytes()), sha256(SET.as_bytes()));
    let (folder, inputs) = folder(&sums);
    let there = built(&pinned, &inputs).unwrap();
    assert_eq!(there.lacks(), None);
    fs::remove_file(folder.path().join("set.json")).unwrap();
    let absent = built(&pinned, &inputs).unwrap();
    assert_eq!(absent.lacks().unwrap(), "there is no file `set.json`; to install: bring it");
    // What stored trials depend on is the same.
    assert_eq!(there.inputs(), absent.inputs());
    assert!(built(SETTINGS, &inputs).is_err(), "nothing brings it");
    fs::write(folder.path().join("set.json"), SET.replace("1.2", "1.3")).unwrap();
    let other = built(&pinned, &inputs).err().unwrap();
    assert!(other.contains("`set.json` is not what its sum says; to install it again: bring it"), "{other}");
    fs::write(folder.path().join("sums"), "").unwrap();
    let unknown = built(&pinned, &inputs).err().unwrap();
    assert!(unknown.contains("`sums` has no sum for `nod.urdf`"), "{unknown}");
}

/// One scene and one request as an archive, in this folder.
fn archive(folder: &str) -> Vec<u8> {
    let scene = r"
robot_model_name: nod
world:
  collision_objects:
    - id: can
      primitives: [{type: cylinder, dimensions: [0.2, 0.2]}]
      primitive_poses: [{position: [0, 0, 1.75], orientation: [0, 0, 0, 1]}]
";
    let request = r"
start_state: {joint_state: {name: [one, two], position: [0, 0]}}
goal_constraints: [{joint_constraints: [{joint_name: one, position: 1.2}, {joint_name: two, position: 0}]}]
";
    let mut bytes = Vec::new();
    for (name, text) in [("scene0001.yaml", scene), ("request0001.yaml", request)] {
        let mut header = [0; 512];
        for (at, field) in [(0, format!("{folder}/{name}")), (124, format!("{:011o}", text.len()))] {
            header[at..at + field.len()].copy_from_slice(field.as_bytes());
        }
        header[156] = b'0';
        bytes.extend(header);
        bytes.extend(text.as_bytes());
        bytes.resize(bytes.len().next_multiple_of(512), 0);
    }
    bytes
}

/// Between the highest ball of the robot, up to 1.6 m, and the lower end of the can at 1.65 m there is room; a ball of 0.2 m about that end
/// fills it.
#[test]
fn balls_close_the_ends_of_cylinders_where_they_are_capsules_but_not_where_boxes_stand_for_them() {
    let (folder, inputs) = folder("");
    let archived = SETTINGS.replace("set.json", "set.tar");
    for (name, cylinders, valid, solids) in [
        ("can_nod", "", 1.0, 1),
        ("can_nod", "cylinders = \"prisms\"\nboxes_in = \"can\"", 1.0, 1),
        ("can_nod", "cylinders = \"capsules\"", 0.0, 3),
        ("can_nod", "cylinders = \"capsules\"\nboxes_in = \"box\"", 0.0, 3),
        ("box_nod", "cylinders = \"capsules\"\nboxes_in = \"box\"", 1.0, 1),
    ] {
        fs::write(folder.path().join("set.tar"), archive(name)).unwrap();
        let family = built(&format!("{archived}{cylinders}"), &inputs).unwrap();
        let found = (family.known(0)["valid_problems"].as_f64(), family.cells());
        assert_eq!(found, (valid, solids + 2), "{name}, {cylinders}");
    }
}
