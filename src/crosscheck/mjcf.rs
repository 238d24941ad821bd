//! Models in MuJoCo's own language (MJCF).
//!
//! The numbers are those of the robot and scene files, with all their digits, and each Denavit–Hartenberg row is
//! two nested bodies: one that turns about `0 0 1`, one that is moved by `(a, 0, d)` and twisted about x. Nothing
//! is worked out here that a wrong kinematics of ours could make wrong on both sides.
//!
//! MuJoCo's capsule–box primitive misses a capsule whose axis pierces deep through the box, so boxes are given as
//! meshes of eight vertices. Links and obstacles meet by masks, parts of the robot by explicit pairs.

use super::model::{Model, Part, Still};
use engine::geometry::{Solid, Vec3};
use std::fmt::Write as _;

/// The thickness of a picture's floor and half its side, metres; for contact it is a half-space.
const FLOOR_SIZE: &str = "3 3 0.05";

/// The least radius that a picture shows.
const SEEN_M: f64 = 4e-3;

/// A named configuration that the viewer can be put into.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Its name.
    pub name: String,
    /// The joint angles.
    pub q_rad: Vec<f64>,
}

/// Writing to a string cannot fail; this keeps that in one place.
macro_rules! line {
    ($text:expr, $($arguments:tt)*) => {{
        let _ = writeln!($text, $($arguments)*);
    }};
}

/// The model as an MJCF file with these keyframes.
pub fn mjcf(model: &Model, keys: &[Key]) -> String {
    let mut text = String::new();
    line!(text, "<mujoco model=\"{}\">", escaped(&model.name));
    line!(text, "  <compiler angle=\"radian\" autolimits=\"true\"/>");
    line!(text, "  <option gravity=\"0 0 0\"/>\n  <size memory=\"64M\"/>");
    line!(text, "  <visual>\n    <global offwidth=\"1600\" offheight=\"1200\"/>");
    line!(
        text,
        "    <headlight ambient=\"0.35 0.35 0.35\" diffuse=\"0.4 0.4 0.4\" specular=\"0 0 0\"/>\n  </visual>"
    );
    line!(text, "  <asset>");
    line!(
        text,
        "    <texture type=\"skybox\" builtin=\"flat\" rgb1=\"1 1 1\" rgb2=\"1 1 1\" width=\"16\" height=\"96\"/>"
    );
    for (index, still) in model.stills.iter().enumerate() {
        if let Some(vertices) = mesh(&still.solid) {
            let numbers: Vec<String> = vertices.iter().map(numbers).collect();
            line!(text, "    <mesh name=\"mesh_{index}\" vertex=\"{}\"/>", numbers.join(" "));
        }
    }
    line!(text, "  </asset>\n  <worldbody>");
    line!(text, "    <light pos=\"1 -2 4\" dir=\"-0.2 0.4 -0.9\" diffuse=\"0.7 0.7 0.7\"/>");
    for (index, still) in model.stills.iter().enumerate() {
        line!(text, "    {}", still_geom(index, still));
    }
    robot(&mut text, model);
    line!(text, "  </worldbody>\n  <contact>");
    contact(&mut text, model);
    line!(text, "  </contact>\n  <keyframe>");
    for key in keys {
        let angles: Vec<String> = key.q_rad.iter().map(|angle| number(*angle)).collect();
        line!(text, "    <key name=\"{}\" qpos=\"{}\"/>", escaped(&key.name), angles.join(" "));
    }
    line!(text, "  </keyframe>\n</mujoco>");
    text
}

/// The pairs of the robot's own parts that may touch.
fn contact(text: &mut String, model: &Model) {
    for [a, b] in &model.self_pairs {
        let names = [a, b].map(|part| escaped(&model.parts[*part].name));
        line!(
            text,
            "    <pair geom1=\"part:{}\" geom2=\"part:{}\" margin=\"0\" gap=\"0\"/>",
            names[0],
            names[1]
        );
    }
}

fn robot(text: &mut String, model: &Model) {
    let (x, y) = (model.base.axis(0), model.base.axis(1));
    let origin = numbers(&model.base.origin);
    line!(text, "    <body name=\"link_0\" pos=\"{origin}\" xyaxes=\"{} {}\">", numbers(&x), numbers(&y));
    parts(text, model, 0);
    for (index, row) in model.rows.iter().enumerate() {
        let link = index + 1;
        let offset = number(row.offset_rad);
        let [lower, upper] = row.limits_rad.map(number);
        line!(text, "    <body name=\"turned_{link}\" axisangle=\"0 0 1 {offset}\">");
        line!(text, "      <joint name=\"joint_{link}\" axis=\"0 0 1\" range=\"{lower} {upper}\"/>");
        line!(text, "      <inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>");
        let place = numbers(&Vec3::new(row.a_m, 0.0, row.d_m));
        let twist = number(row.alpha_rad);
        line!(text, "    <body name=\"link_{link}\" pos=\"{place}\" axisangle=\"1 0 0 {twist}\">");
        parts(text, model, link);
    }
    line!(text, "    <body name=\"tool\" pos=\"0 0 {}\"/>", number(model.tool_m));
    line!(text, "    {}", "</body>".repeat(2 * model.rows.len() + 1));
}

fn parts(text: &mut String, model: &Model, link: usize) {
    for part in model.parts.iter().filter(|part| part.link == link) {
        line!(text, "      {}", part_geom(part));
        if part.capsule.radius < SEEN_M {
            line!(text, "      {}", sleeve(part));
        }
    }
}

fn part_geom(part: &Part) -> String {
    let segment = &part.capsule.segment;
    let colour = if part.exposed { "0.90 0.55 0.20 1" } else { "0.45 0.45 0.50 1" };
    format!(
        "<geom name=\"part:{}\" type=\"capsule\" fromto=\"{} {}\" size=\"{}\" contype=\"{}\" conaffinity=\"0\" \
         mass=\"0\" rgba=\"{colour}\"/>",
        escaped(&part.name),
        numbers(&segment.a),
        numbers(&segment.b),
        number(part.capsule.radius),
        u8::from(part.exposed)
    )
}

/// Around a part that is too thin to be seen, one that touches nothing.
fn sleeve(part: &Part) -> String {
    let [from, to] = [part.capsule.segment.a, part.capsule.segment.b].map(|end| numbers(&end));
    format!(
        "<geom type=\"capsule\" fromto=\"{from} {to}\" size=\"{SEEN_M}\" contype=\"0\" conaffinity=\"0\" mass=\"0\" \
         rgba=\"0.90 0.55 0.20 1\"/>"
    )
}

/// The vertices of a shape that is given as a mesh.
fn mesh(solid: &Solid) -> Option<Vec<Vec3>> {
    match solid {
        Solid::Box(b) => Some(b.corners().to_vec()),
        Solid::Convex(c) => Some(c.vertices().to_vec()),
        Solid::Sphere(_) | Solid::Capsule(_) | Solid::HalfSpace(_) => None,
    }
}

fn still_geom(index: usize, still: &Still) -> String {
    let (shape, colour) = match &still.solid {
        Solid::Box(_) | Solid::Convex(_) => {
            (format!("type=\"mesh\" mesh=\"mesh_{index}\""), "0.35 0.50 0.70 1")
        }
        Solid::Sphere(s) => {
            let place = numbers(&s.center);
            (format!("type=\"sphere\" pos=\"{place}\" size=\"{}\"", number(s.radius)), "0.35 0.50 0.70 1")
        }
        Solid::Capsule(c) => {
            let [a, b] = [numbers(&c.segment.a), numbers(&c.segment.b)];
            let size = number(c.radius);
            (format!("type=\"capsule\" fromto=\"{a} {b}\" size=\"{size}\""), "0.35 0.50 0.70 1")
        }
        Solid::HalfSpace(h) => {
            let [place, normal] = [h.normal() * -h.height(&Vec3::zeros()), *h.normal()].map(|v| numbers(&v));
            (
                format!("type=\"plane\" pos=\"{place}\" zaxis=\"{normal}\" size=\"{FLOOR_SIZE}\""),
                "0.80 0.80 0.78 1",
            )
        }
    };
    let name = escaped(&still.name);
    format!("<geom name=\"still:{name}\" {shape} contype=\"0\" conaffinity=\"1\" rgba=\"{colour}\"/>")
}

/// A number with all its digits; `-0` is written as `0`.
fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

fn numbers(v: &Vec3) -> String {
    format!("{} {} {}", number(v.x), number(v.y), number(v.z))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
