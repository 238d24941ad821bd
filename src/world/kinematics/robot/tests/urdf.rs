//! URDF files of six axes: the same kinematics as the rows they were written from, and closed forms where there are any.

use super::super::urdf;
use super::*;
use crate::geometry::{Solid, Sphere, Vec3, distance_segment_solid};
use crate::kinematics::open_chain::OpenChain;
use crate::kinematics::{AXES, Arm, Chain};
use base::robot::parse_urdf;
use base::settings::Document;
use rand::RngExt as _;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::fmt::Write as _;

/// A solid, without which a robot is refused.
const BALL: &str = "<collision><geometry><sphere radius=\"0.01\"/></geometry></collision>";

/// The chain's rows as URDF: a link welded on is turned by a row's offset, each joint turns about the z of its frame, and a row's
/// length and twist lead to the next.
fn urdf(chain: &Chain, solids: &str) -> String {
    let mut text = "<robot name=\"rows\"><link name=\"l0\"/>".to_owned();
    let mut xyz = [0.0; 3];
    let mut roll = 0.0;
    for (i, joint) in chain.joints().iter().enumerate() {
        let [x, y, z] = xyz;
        let lower = joint.lower_rad;
        let upper = joint.upper_rad;
        let speed = joint.speed_rad_s;
        let next = i + 1;
        let offset = joint.offset_rad;
        let _ = write!(
            text,
            "<joint name=\"w{next}\" type=\"fixed\"><parent link=\"l{i}\"/><child link=\"w{next}\"/>\
             <origin xyz=\"{x:?} {y:?} {z:?}\" rpy=\"{roll:?} 0 0\"/></joint><link name=\"w{next}\"/>\
             <joint name=\"j{next}\" type=\"revolute\"><parent link=\"w{next}\"/><child link=\"l{next}\"/>\
             <origin rpy=\"0 0 {offset:?}\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"{lower:?}\" upper=\"{upper:?}\" velocity=\"{speed:?}\"/></joint><link name=\"l{next}\">{solids}</link>"
        );
        (xyz, roll) = ([joint.a_m, 0.0, joint.d_m], joint.alpha_rad);
    }
    let [x, y, z] = xyz;
    let _ = write!(
        text,
        "<joint name=\"tip\" type=\"fixed\"><parent link=\"l6\"/><child link=\"tip\"/><origin xyz=\"{x:?} {y:?} {z:?}\" \
         rpy=\"{roll:?} 0 0\"/></joint><link name=\"tip\"/></robot>"
    );
    text
}

/// The arm, which stands at the origin without a tool, as a URDF file of it is read.
pub fn read_back(arm: &Arm) -> Arm {
    urdf::robot(&parsed(urdf(arm.chain(), BALL)), None).unwrap().arm().clone()
}

fn parsed(text: String) -> base::robot::Robot {
    parse_urdf(&Document::new(Path::new("rows.urdf"), text)).unwrap()
}

fn shipped(name: &str) -> Robot {
    let file = format!("{}/../../data/robots/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Robot::load(Path::new(&file)).unwrap()
}

#[test]
fn shipped_arms_written_as_urdf_keep_their_kinematics_and_their_closed_form() {
    let shipped_arms = [
        (1, "ur5", "offset_wrist"),
        (2, "puma560", "spherical_wrist"),
        (3, "motoman_up6", "spherical_wrist"),
        (4, "aubo_i10", "offset_wrist"),
    ];
    for (seed, name, solver) in shipped_arms {
        let bare = shipped(name).arm().with_tool(Frame::IDENTITY);
        let chain = bare.chain();
        let read = read_back(&bare);
        assert_eq!((read.solver().name, read.solver().is_complete), (solver, true), "{name}");
        let mut stream = seed::stream(seed);
        for case in 0..100_000 {
            let [q, reference] = [draw(&mut stream, chain), draw(&mut stream, chain)];
            let (ours, theirs) = (read.chain().forward(&q), chain.forward(&q));
            let off = (ours.origin - theirs.origin).norm() + (ours.rotation - theirs.rotation).norm();
            assert!(off < 1e-12, "{name}, seed {seed} case {case}: off by {off}");
            let all = read.inverse(&theirs, &reference);
            assert!(all.iter().count() > 0, "{name}, seed {seed} case {case}: no configuration");
            for (_, found) in all.iter() {
                let again = read.chain().forward(found);
                let off = (again.origin - theirs.origin).norm() + (again.rotation - theirs.rotation).norm();
                assert!(off < 1e-9, "{name}, seed {seed} case {case}: off by {off}");
            }
        }
    }
}

#[test]
fn skew_axes_in_frames_of_any_kind_keep_their_kinematics_and_take_the_search() {
    let mut stream = seed::stream(3);
    for case in 0..20 {
        let mut text = format!("<robot name=\"skew\"><link name=\"l0\">{BALL}</link>");
        for i in 0..AXES {
            let mut three = |size: f64| {
                let numbers = [0; 3].map(|_| format!("{:?}", stream.random_range(-size..size)));
                numbers.join(" ")
            };
            let _ = write!(
                text,
                "<joint name=\"j{i}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{}\"/><origin xyz=\"{}\" rpy=\"{}\"/>\
                 <axis xyz=\"{}\"/><limit lower=\"-2\" upper=\"2\" velocity=\"1\"/></joint><link name=\"l{}\"/>",
                i + 1,
                three(0.5),
                three(3.0),
                three(1.0),
                i + 1
            );
        }
        let read = parsed(text + "</robot>");
        let robot = urdf::robot(&read, None).unwrap();
        let open = OpenChain::new(&read);
        assert_eq!(robot.arm().solver().name, "numerical");
        assert!(robot.notes()[0].contains("by `numerical`, which may miss configurations"));
        for _ in 0..50 {
            let q = draw(&mut stream, robot.arm().chain());
            let rows = robot.arm().chain().forward(&q);
            let frames = open.forward(&q);
            let off = (rows.origin - frames.origin).norm() + (rows.rotation - frames.rotation).norm();
            assert!(off < 1e-11, "case {case}: off by {off}");
        }
    }
}

#[test]
fn a_velocity_that_no_joint_has_is_asked_about() {
    let robot = |velocity: &str| {
        let text = urdf(shipped("ur5").arm().chain(), BALL);
        let at = text.find("velocity=\"").unwrap() + "velocity=\"".len();
        let end = at + text[at..].find('"').unwrap();
        let read = parsed(format!("{}{velocity}{}", &text[..at], &text[end..]));
        (urdf::robot(&read, None).map_err(|error| error.to_string()), read.notes)
    };
    let (fit, notes) = robot("23.6");
    assert!(fit.is_ok() && notes.is_empty(), "1350° a second, which an arm has: {notes:?}");
    let (refused, notes) = robot("180");
    let expected = "joint `j1` has a `velocity` that no joint has, is it in degrees a second? A cell's arm needs one in radians";
    assert!(refused.unwrap_err().starts_with(expected));
    assert_eq!(
        notes,
        ["the velocity of joint `j1` is 180; is it in degrees a second? The format has radians"]
    );
}

#[test]
fn capsules_hold_the_solids_that_they_stand_for() {
    let forms = [
        r#"<box size="0.05 0.2 0.03"/>"#,
        r#"<cylinder radius="0.04" length="0.3"/>"#,
        r#"<sphere radius="0.07"/>"#,
    ];
    for form in forms {
        let solids = format!(
            "<collision><origin xyz=\"0.01 0.02 0.03\" rpy=\"0.3 -0.2 0.1\"/><geometry>{form}</geometry></collision>"
        );
        let read = parsed(urdf(shipped("ur5").arm().chain(), &solids));
        let robot = urdf::robot(&read, None).unwrap();
        let open = OpenChain::new(&read);
        assert_eq!(robot.notes().len(), usize::from(!form.contains("sphere")), "{form}: {:?}", robot.notes());
        let mut stream = seed::stream(4);
        let q = draw(&mut stream, robot.arm().chain());
        let frames = open.frames(&q);
        let links = robot.arm().chain().frames(&q);
        let mut held = 0;
        let body = &robot.bodies()[0];
        for (part, (link, solid)) in body.parts().iter().zip(&read.solids) {
            let capsule = part.placed(&links);
            let (points, radius) = solid.rounded();
            for point in points {
                let center = frames[*link].point(&Vec3::from(point));
                // A prism around a cylinder stands out by less than a hundredth of its radius.
                let ball =
                    Solid::Sphere(Sphere::new(center, radius.max(0.01 * capsule.radius + 1e-9)).unwrap());
                held += u32::from(distance_segment_solid(&capsule.segment, &ball) <= capsule.radius);
            }
        }
        let all: usize = read.solids.iter().map(|(_, solid)| solid.rounded().0.len()).sum();
        assert_eq!(held as usize, all, "{form}");
    }
}

#[test]
fn the_shipped_panda_stands_and_has_too_many_axes_for_rows() {
    let file = format!("{}/../../data/robots/panda.urdf", env!("CARGO_MANIFEST_DIR"));
    let refusal = Robot::load(Path::new(&file)).unwrap_err().to_string();
    assert_eq!(
        refusal,
        "robot `panda` has 7 joints that move; 6 are accepted here, and any number in problems in joint space"
    );
    let read = base::robot::read_urdf(Path::new(&file)).unwrap();
    let open = OpenChain::new(&read);
    // A common start pose: by the published frames the tip is 0.307 m ahead and 0.487 m up.
    let tip = open.forward(&[0.0, -FRAC_PI_4, 0.0, -3.0 * FRAC_PI_4, 0.0, FRAC_PI_2, FRAC_PI_4]);
    assert!((tip.origin - Vec3::new(0.306_890_6, 0.0, 0.486_882_1)).norm() < 1e-6, "{:?}", tip.origin);
    assert!((tip.axis(2) + Vec3::z()).norm() < 1e-12, "the hand points down");
}
