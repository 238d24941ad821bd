//! URDF files: the chain from the root link to the last one, with what is fixed to its links.
//!
//! Read are `link` with its `collision` solids (boxes, cylinders, spheres; a mesh is taken for the convex hull of its STL vertices)
//! and `joint` (`revolute`, `continuous`, `prismatic`, `fixed`). What else the format has is in the table of ignored keys; what it does
//! not have is noted. Every fault is reported at its place.
//!
//! Source: the XML format of wiki.ros.org/urdf/XML (link, joint).

use super::Robot;
use super::elements::{Elements, parsed, unread};
use super::tree::Tree;
use super::walk;
use crate::settings::{Document, SettingsError};
use crate::solid::Source;
use std::path::Path;

/// What is read, by element.
const READ: &[(&str, &[&str])] = &[
    ("robot", &["@name", "link", "joint"]),
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
    let robot = walk::robot(&Tree::new(Elements(Source(document)), root)?)?;
    Ok(Robot { notes: unread(root, "URDF", READ), ..robot })
}
