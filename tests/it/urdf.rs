//! The URDF robots that are shipped: MuJoCo's frames are ours, and the UR5 is the one of the robot file.

use base::robot::read_urdf;
use engine::kinematics::open_chain::OpenChain;
use engine::kinematics::{AXES, Robot};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn robots() -> Vec<PathBuf> {
    let files = fs::read_dir(root().join("data/robots")).unwrap().map(|entry| entry.unwrap().path());
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
        let told = fs::read_to_string(&stored).expect("crosscheck/urdf_frames.py writes it");
        let told: Value = serde_json::from_str(&told).unwrap();
        let open = OpenChain::new(&read_urdf(&path).unwrap());
        let arm = Robot::load(&path).ok();
        let (angles, frames) = (told["angles_rad"].as_array().unwrap(), told["frames"].as_array().unwrap());
        for (q, frame) in angles.iter().zip(frames) {
            let (q, frame) = (numbers(q), numbers(frame));
            let mut ours = vec![open.forward(&q)];
            if let Some(arm) = &arm {
                let six: [f64; AXES] = q.clone().try_into().unwrap();
                ours.push(arm.arm().chain().forward(&six));
            }
            for tip in ours {
                let own: Vec<f64> =
                    tip.origin.iter().chain(tip.rotation.transpose().iter()).copied().collect();
                let off = own.iter().zip(&frame).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off < 1e-9, "{name} at {q:?}: off by {off}\n{own:?}\n{frame:?}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 600, "only {compared} frames");
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
