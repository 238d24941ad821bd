//! SRDF files: which links of a robot may touch each other.
//!
//! Source: the page "SRDF" of <https://wiki.ros.org/srdf>: pairs under `disable_collisions` are not checked, all others are.

use super::Robot;
use super::elements::{Elements, Keys, elements, parsed};
use crate::settings::{Document, SettingsError};
use crate::solid::Source;
use std::collections::BTreeSet;
use std::path::Path;

/// What is read, by element.
const READ: &[(&str, &[&str])] =
    &[("robot", &["@name", "disable_collisions"]), ("disable_collisions", &["@link1", "@link2"])];

/// What an SRDF file says of a robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MayTouch {
    /// The pairs of links that are not held against each other, by name, each in order.
    pairs: BTreeSet<[String; 2]>,
    /// What a reader of results should know, a sentence each.
    pub notes: Vec<String>,
}

impl MayTouch {
    /// Whether the two links may touch.
    pub fn allows(&self, a: &str, b: &str) -> bool {
        self.pairs.contains(&ordered(a, b))
    }
}

fn ordered(a: &str, b: &str) -> [String; 2] {
    if a < b { [a.to_owned(), b.to_owned()] } else { [b.to_owned(), a.to_owned()] }
}

/// The pairs in the SRDF file at `path`, which must be of `robot`.
///
/// # Errors
/// Every fault at its place: another robot, elements that decide on contact and are not known.
pub fn read_srdf(path: &Path, robot: &Robot) -> Result<MayTouch, SettingsError> {
    parse_srdf(&*Document::open(path)?, robot)
}

/// The pairs that `document` gives.
///
/// # Errors
/// As [`read_srdf`].
pub fn parse_srdf(document: &Document, robot: &Robot) -> Result<MayTouch, SettingsError> {
    let parsed = parsed(document)?;
    let xml = Elements(Source(document));
    let root = parsed.root_element();
    let name = root.attribute("name").unwrap_or(&robot.name);
    if name != robot.name {
        let message = format!("the file is of the robot `{name}`; `{}` is accepted", robot.name);
        return Err(xml.fault(&root.range(), message));
    }
    let decides = |name: &str| name.contains("collision") && name != "disable_collisions";
    if let Some(other) = root.children().find(|node| decides(node.tag_name().name())) {
        let message = format!("`{}` is not read; `disable_collisions` is accepted", other.tag_name().name());
        return Err(xml.fault(&other.range(), message));
    }
    let mut notes = Keys { xml, format: "SRDF", read: READ }.unread(root)?;
    let mut pairs = BTreeSet::new();
    let mut unknown = BTreeSet::new();
    for pair in elements(root, "disable_collisions") {
        let [a, b] = [xml.text(pair, "link1")?, xml.text(pair, "link2")?];
        unknown.extend([a, b].into_iter().filter(|link| !robot.owners.iter().any(|owner| owner == link)));
        pairs.insert(ordered(a, b));
    }
    if !unknown.is_empty() {
        let links = unknown.into_iter().collect::<Vec<_>>().join("`, `");
        notes.push(format!("no solid stands for the links `{links}` of its pairs"));
    }
    Ok(MayTouch { pairs, notes })
}
