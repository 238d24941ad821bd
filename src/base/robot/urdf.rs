//! URDF files: the chain from the root link to the last one, with what is fixed to its links.
//!
//! Read are `link` with its `collision` solids (boxes, cylinders, spheres; a mesh is taken for the convex hull of its STL vertices)
//! and `joint` (`revolute`, `continuous`, `prismatic`, `fixed`). What else the format has is in the table of ignored keys. What it does
//! not have is refused, but for elements of `robot` itself, which are noted. Every fault is reported at its place.
//!
//! Source: the XML format of wiki.ros.org/urdf/XML (link, joint), version 1.0. Version 1.1 (ros/urdfdom, pull request 235) adds `quat_xyzw`
//! to `origin`; it is refused.

use super::elements::{Elements, Keys, parsed, place};
use super::tree::Tree;
use super::walk;
use super::{Kind, Robot};
use crate::settings::{Document, SettingsError};
use crate::solid::Source;
use std::path::Path;

/// What is read, by element.
const READ: &[(&str, &[&str])] = &[
    ("robot", &["@name", "@version", "link", "joint"]),
    ("link", &["@name", "collision"]),
    ("collision", &["origin", "geometry"]),
    ("geometry", &["box", "cylinder", "sphere", "mesh"]),
    ("box", &["@size"]),
    ("cylinder", &["@radius", "@length"]),
    ("sphere", &["@radius"]),
    ("mesh", &["@filename", "@scale"]),
    ("origin", &["@xyz", "@rpy"]),
    ("joint", &["@name", "@type", "parent", "child", "origin", "axis", "limit", "mimic"]),
    ("parent", &["@link"]),
    ("child", &["@link"]),
    ("axis", &["@xyz"]),
    ("limit", &["@lower", "@upper", "@velocity"]),
    ("mimic", &["@joint", "@multiplier", "@offset"]),
];

/// The robot in the URDF file at `path`; meshes are looked for beside it and in the folders above it.
///
/// # Errors
/// Every fault of the first part that has any, each at its place.
pub fn read_urdf(path: &Path) -> Result<Robot, SettingsError> {
    parse_urdf(Document::open(path)?.as_ref())
}

/// The robot that `document` describes.
///
/// # Errors
/// As [`read_urdf`].
pub fn parse_urdf(document: &Document) -> Result<Robot, SettingsError> {
    let parsed = parsed(document)?;
    let root = parsed.root_element();
    let xml = Elements(Source(document));
    if let Some(version) = root.attribute("version").filter(|version| *version != "1.0") {
        let message = format!("version is `{}`; `1.0` is accepted", crate::text::brief(version));
        return Err(xml.fault(&place(root, "version"), message));
    }
    let mut notes = Keys { xml, format: "URDF", read: READ }.unread(root)?;
    let robot = walk::robot(&Tree::new(xml, root)?)?;
    notes.extend(robot.joints.iter().filter(|joint| joint.is_too_fast()).map(|joint| {
        let (accepted, other_unit) =
            if joint.kind == Kind::Slides { ("metres", "millimetres") } else { ("radians", "degrees") };
        let speed = joint.speed.unwrap_or_default();
        format!(
            "the velocity of joint `{}` is {speed}; is it in {other_unit} a second? The format has {accepted}",
            joint.name
        )
    }));
    Ok(Robot { notes, ..robot })
}
