//! The hull of every robot file ends at the tip that the file declares: what a study plans for is what it names.

use super::super::urdf::capsule_around;
use super::*;
use crate::geometry::{Frame, Vec3};
use crate::kinematics::open_chain::OpenChain;
use base::robot::Kind;
use std::fs;
use std::path::PathBuf;

/// A chain that ends a hull this near its tip ends it there: the Panda's fingers are boxes, in capsules 0.4 mm too short.
const NEAR_M: f64 = 1e-3;

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// How far a capsule, placed in the world, reaches beyond the tip along the tool's direction.
fn beyond_m(tip: &Frame, Capsule { segment, radius }: &Capsule) -> f64 {
    let ahead = |end: &Vec3| (end - tip.origin).dot(&tip.axis(2)) + radius;
    ahead(&segment.a).max(ahead(&segment.b))
}

/// Whether a part moves with the tool, or lies on the last joint's axis, about which the tool turns.
fn is_of_the_hand(part: &Part) -> bool {
    let on_axis = |end: &Vec3| end.xy().norm() < 1e-9;
    let ends = part.capsule.segment;
    part.link == AXES || part.link + 1 == AXES && on_axis(&ends.a) && on_axis(&ends.b)
}

/// Where the hull ends beyond the tip, body by body.
fn hull_ends_m(file: &Path) -> Vec<(String, f64)> {
    if let Ok(robot) = Robot::load(file) {
        let chain = robot.arm().chain();
        let q = [0.3; AXES];
        let frames = chain.frames(&q);
        let tip = chain.forward(&q);
        let end = |body: &Body| {
            let hand = body.parts.iter().filter(|part| is_of_the_hand(part));
            hand.map(|part| beyond_m(&tip, &part.placed(&frames))).fold(f64::NEG_INFINITY, f64::max)
        };
        return robot.bodies().iter().map(|body| (body.name.clone(), end(body))).collect();
    }
    let read = base::robot::read_urdf(file).unwrap();
    if read.joints.iter().all(|joint| joint.kind == Kind::Slides) {
        // What slides alone is a point with a body about it.
        return Vec::new();
    }
    let open = OpenChain::new(&read);
    let zero = vec![0.0; read.joints.len()];
    let frames = open.frames(&zero);
    let tip = open.forward(&zero);
    let hand = read.solids.iter().filter(|(link, _)| *link == zero.len());
    let ends = hand.map(|(link, solid)| beyond_m(&tip, &capsule_around(solid, &frames[*link]).unwrap()));
    vec![("urdf".to_owned(), ends.fold(f64::NEG_INFINITY, f64::max))]
}

#[test]
fn the_hull_of_every_robot_ends_at_its_declared_tip() {
    for file in files() {
        for (body, end_m) in hull_ends_m(&file) {
            let end_mm = end_m * 1e3;
            assert!(end_m.abs() < NEAR_M, "{}: {body} ends {end_mm} mm beyond the tip", file.display());
        }
    }
}

#[test]
fn no_tool_capsule_reaches_beyond_the_tip_however_short_the_tool() {
    let up6 = robot("motoman_up6");
    for tool_mm in [1.0, 20.0, 50.0, 100.0, 150.0, 250.0, 400.0] {
        let robot = up6.with_tool_length(tool_mm * 1e-3).unwrap();
        let tip = Frame::at(Vec3::z() * robot.tool_length_m());
        for part in robot.bodies()[0].parts().iter().filter(|part| part.tool_share.is_some()) {
            let beyond_m = beyond_m(&tip, part.capsule());
            assert!(beyond_m < 1e-12, "tool of {tool_mm} mm: {} reaches {beyond_m} m beyond", part.name());
        }
    }
}
