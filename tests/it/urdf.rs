//! The URDF robots that are shipped: MuJoCo's frames are ours, and the UR5 is the one of the robot file.

use crate::paper::Bench;
use base::robot::read_urdf;
use base::settings::Settings;
use engine::geometry::Frame;
use engine::kinematics::open_chain::OpenChain;
use engine::kinematics::{AXES, Robot};
use nalgebra::Matrix4;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use study::{Inputs, family, reuse};
use verify::joints;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn robots() -> Vec<PathBuf> {
    let folders =
        ["data/robots", "tests/it/crosscheck/urdf"].map(|folder| fs::read_dir(root().join(folder)).unwrap());
    let files = folders.into_iter().flatten().map(|entry| entry.unwrap().path());
    let mut urdf: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|end| end == "urdf")).collect();
    urdf.sort();
    urdf
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn forward_kinematics_of_every_urdf_robot_are_those_of_mujoco_to_a_billionth() {
    let mut compared = 0;
    for path in robots() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let stored = root().join(format!("tests/it/crosscheck/urdf/{name}.json"));
        let text = fs::read_to_string(&stored).expect("crosscheck/urdf_frames.py writes it");
        let text: Value = serde_json::from_str(&text).unwrap();
        let robot = read_urdf(&path).unwrap();
        let judged = joints::Case::new(&robot, &[], &[], 1.0).unwrap();
        let open = OpenChain::new(&robot);
        let arm = Robot::load(&path).ok();
        let angles = text["angles_rad"].as_array().unwrap();
        let frames = text["frames"].as_array().unwrap();
        for (q, frame) in angles.iter().zip(frames) {
            let q = numbers(q);
            let frame = numbers(frame);
            let mut ours = vec![open.forward(&q)];
            if let Some(arm) = &arm {
                let six: [f64; AXES] = q.clone().try_into().unwrap();
                ours.push(arm.arm().chain().forward(&six));
            }
            let apart = |(own, verified): (&Frame, &Matrix4<f64>)| {
                (own.rotation - verified.fixed_view::<3, 3>(0, 0)).norm()
                    + (own.origin - verified.fixed_view::<3, 1>(0, 3)).norm()
            };
            let apart = open.frames(&q).iter().zip(&judged.frames(&q)).map(apart).fold(0.0, f64::max);
            assert!(apart < 1e-9, "{name} at {q:?}: links of the verifier are off by {apart}");
            for tip in ours {
                let own: Vec<f64> =
                    tip.origin.iter().chain(tip.rotation.transpose().iter()).copied().collect();
                let off = own.iter().zip(&frame).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off < 1e-9, "{name} at {q:?}: off by {off}\n{own:?}\n{frame:?}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 800, "only {compared} frames");
}

#[test]
fn robots_by_rows_are_all_given_to_mujoco_by_the_cross_check_of_some_paper() {
    let papers = fs::read_dir(root().join("experiments")).unwrap();
    let specs =
        papers.filter_map(|entry| fs::read_to_string(entry.unwrap().path().join("crosscheck.toml")).ok());
    let specs: Vec<toml::Table> = specs.map(|text| toml::from_str(&text).unwrap()).collect();
    let robots = specs.iter().filter_map(|spec| spec.get("robot")?.as_array());
    let given: Vec<&str> = robots.flatten().map(|robot| robot["file"].as_str().unwrap()).collect();
    let mut files = 0;
    for entry in fs::read_dir(root().join("data/robots")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "toml") {
            let name = path.file_name().unwrap().to_string_lossy();
            assert!(
                given.contains(&format!("data/robots/{name}").as_str()),
                "{name} is in no crosscheck.toml"
            );
            files += 1;
        }
    }
    assert!(files >= 4, "only {files} robots by rows");
}

/// A UR5 whose fifth axis is turned by 0.1 rad, so that no closed form fits, with a box and a mesh at the wrist.
fn skewed_ur5(bench: &Bench) {
    let text = fs::read_to_string(root().join("data/robots/ur5.urdf")).unwrap();
    let solids = "<link name=\"wrist_3\"><collision><geometry><box size=\"0.02 0.02 0.01\"/></geometry></collision>\
                  <collision><geometry><mesh filename=\"tool.stl\"/></geometry></collision></link>";
    let skewed = text
        .replace(
            "<origin xyz=\"0 0 0.10915\" rpy=\"1.5707963267948966 0 0\"/>",
            "<origin xyz=\"0 0 0.10915\" rpy=\"1.47 0 0\"/>",
        )
        .replace("<link name=\"wrist_3\"/>", solids);
    assert!(skewed.contains("1.47") && skewed.contains("tool.stl"), "ur5.urdf is written otherwise");
    bench.write("toy/my.urdf", skewed.as_bytes());
    let stl = "solid\nvertex 0 0 0\nvertex 0.02 0 0\nvertex 0 0.02 0\nvertex 0 0 0.02\nendsolid\n";
    bench.write("toy/tool.stl", stl.as_bytes());
}

#[test]
fn check_tells_what_capsules_stand_for_and_that_a_search_may_miss_configurations() {
    let bench = Bench::empty();
    bench.done(&["new", "toy", "--from", "cell"]);
    assert!(!bench.done(&["check", "./toy"]).contains("capsules"), "rows and capsules are as written");
    skewed_ur5(&bench);
    bench.edit("toy/cell.toml", "robot = \"robot.toml\"", "robot = \"my.urdf\"");
    bench.edit(
        "toy/cell.toml",
        "obstacles = true\nself_collision = true",
        "obstacles = false\nself_collision = false",
    );
    let output = bench.done(&["check", "./toy"]);
    for note in [
        "  my.urdf: the capsules around them stand for its solids (boxes: 1; cylinders: 8; meshes, by the hulls of their STL \
         vertices: 1); contact is never missed and sometimes seen too early\n",
        "  my.urdf: ignored keys: `limit/@effort`; docs/FILES.md has the reasons\n",
        "  my.urdf: inverse kinematics by `numerical`, which may miss configurations; ",
    ] {
        assert!(output.contains(note), "no `{note}` in\n{output}");
    }
}

#[test]
fn the_ur5_by_urdf_is_the_ur5_by_rows() {
    let [urdf, rows] =
        ["ur5.urdf", "ur5.toml"].map(|name| Robot::load(&root().join("data/robots").join(name)).unwrap());
    assert_eq!(urdf.arm().solver().name, rows.arm().solver().name, "the closed form");
    for q in [[0.0; AXES], [0.3, -1.2, 1.4, -0.7, 0.9, 2.0]] {
        let (a, b) = (urdf.arm().chain().forward(&q), rows.arm().chain().forward(&q));
        assert!((a.origin - b.origin).norm() + (a.rotation - b.rotation).norm() < 1e-12, "{q:?}");
        let place = |robot: &Robot| -> Vec<f64> {
            let frames = robot.arm().chain().frames(&q);
            let parts = robot.bodies()[0].parts().iter().map(|part| part.placed(&frames));
            let ends =
                parts.map(|capsule| [capsule.segment.a.norm() + capsule.segment.b.norm(), capsule.radius]);
            ends.flatten().collect()
        };
        let off = place(&urdf).iter().zip(place(&rows)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(
            off < 1e-9 && urdf.bodies()[0].parts().len() == rows.bodies()[0].parts().len(),
            "capsules off by {off}"
        );
    }
}

/// A query of a UR5 on straight ways of its joints, or of its tool: what `[path]` stands for.
const ROUND: &str = r#"
[[problems]]
label = "[path]"
family = "cell_queries"
instances = 1
[problems.settings]
robot = "arm.urdf"
scene = "empty.toml"
queries = "poses.toml"
obstacles = false
self_collision = false
samples = 40
region = "full"
counted = "accepted"
radius_mm = 9000
path = "[path]"
step_mm = 20
step_deg = 4
jump_deg = 20
turn_deg = 180
end = "own"
"#;

#[test]
fn in_a_cell_a_joint_that_turns_without_end_takes_the_shorter_way_round() {
    let bench = Bench::empty();
    bench.write("round/paper.toml", crate::files::PAPER.as_bytes());
    bench.write(
        "round/poses.toml",
        b"[pose_deg]\nA = [172, -60, 90, -120, -90, 176]\nB = [-172, -60, 90, -120, -90, -178]\n\
          [[group]]\nname = \"low\"\nfrom = \"A\"\nto = \"B\"\n",
    );
    let empty = b"name = \"nothing\"\n[support]\nunder = \"floor\"\nbase_mm = [0, 0, 0]\nyaw_deg = 0\n";
    bench.write("round/empty.toml", empty);
    let groups = ["joints", "tool"].map(|path| ROUND.replace("[path]", path)).concat();
    let study = crate::files::study(&groups, crate::files::STRAIGHT);
    bench.write("round/cell.toml", study.replace("\"files\"", "\"round\"").as_bytes());
    let file = fs::read_to_string(root().join("data/robots/ur5.urdf")).unwrap();
    let mut endless = file.clone();
    for joint in [1, 6] {
        let revolute = format!("joint_{joint}\" type=\"revolute\"");
        assert!(file.contains(&revolute), "ur5.urdf is written otherwise");
        endless = endless.replace(&revolute, &format!("joint_{joint}\" type=\"continuous\""));
    }
    // 16 and 6 degrees the shorter way round, or 344 and 354.
    for (text, travel_deg) in [(&endless, 22.0), (&file, 698.0)] {
        bench.write("round/arm.urdf", text.as_bytes());
        bench.done(&["run", "./round"]);
        let (_, records) = reuse::stored(&bench.at("target/replan/round/data/runs/round"), "cell").unwrap();
        let row = |group: &str| records.batch.rows.iter().find(|row| *row.key.on.group == *group).unwrap();
        let [joints, tool] = ["joints", "tool"].map(row);
        assert_eq!(joints.status.name(), "solved", "{:?}", joints.reason);
        let travel = joints.value("joint_travel_deg").unwrap();
        assert!((travel - travel_deg).abs() < 1e-6, "{travel}");
        if travel_deg < 180.0 {
            assert_eq!(tool.status.name(), "solved", "{:?}", tool.reason);
            assert!(tool.value("joint_travel_deg").unwrap() < 180.0);
        } else {
            assert_ne!(tool.status.name(), "solved", "the joints arrive a turn from the goal");
        }
    }
}

#[test]
fn an_srdf_file_decides_which_links_of_a_six_axis_robot_are_held_against_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let srdf = folder.path().join("ur5.srdf");
    let urdf = root().join("data/robots/ur5.urdf");
    let read = read_urdf(&urdf).unwrap();
    let held = |robot: &Robot| -> BTreeSet<[String; 2]> {
        let pairs = robot.bodies()[0].self_pairs().iter();
        pairs.map(|pair| pair.map(|part| read.owners[part].clone())).collect()
    };
    let pairs = (0..read.owners.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let apart = pairs.filter(|pair| read.solids[pair[0]].0 != read.solids[pair[1]].0);
    let all: BTreeSet<[String; 2]> = apart.map(|pair| pair.map(|part| read.owners[part].clone())).collect();
    let plain = held(&Robot::load(&urdf).unwrap());
    let listed: BTreeSet<[String; 2]> = plain.iter().skip(1).cloned().collect();
    let line = |[a, b]: &[String; 2]| {
        format!("<disable_collisions link1=\"{b}\" link2=\"{a}\" reason=\"Never\"/>\n")
    };
    let lines: String = listed.iter().map(line).collect();
    fs::write(&srdf, format!("<robot name=\"ur5\">\n{lines}</robot>\n")).unwrap();
    let robot = Robot::load_with_srdf(&urdf, &srdf).unwrap();
    assert_eq!(held(&robot), all.difference(&listed).cloned().collect());
    assert!(held(&robot) != plain && robot.files().contains(&srdf));
    let built = |changes: &str| {
        let entry = family::find("cell_queries").unwrap();
        let settings = Settings::composed("the cell", toml::from_str(entry.example).unwrap());
        let changes = format!("queries = 2\nsrdf = 'ur5.srdf'\n{changes}");
        let settings = settings.overlaid(&toml::from_str(&changes).unwrap(), "the test");
        let inputs = Inputs::below(vec![root().to_owned(), folder.path().to_owned()]);
        (entry.build)(&settings, &inputs).map_err(|error| error.to_string())
    };
    let family = built("robot = 'data/robots/ur5.urdf'").unwrap();
    assert!(family.inputs().contains(&srdf), "{:?}", family.inputs());
    for (changes, expected) in [
        ("", "srdf is given, and the robot is no URDF file as it is"),
        (
            "robot = 'data/robots/ur5.urdf'\nself_collision = false",
            "srdf says which links may touch, and self_collision",
        ),
    ] {
        let refused = built(changes).err().unwrap();
        assert!(refused.contains(expected), "should say {expected}\nsays {refused}");
    }
}
