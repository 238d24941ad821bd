//! The links and joints of a URDF file, as a tree.

use super::elements::{Elements, child, elements, place};
use crate::settings::SettingsError;
use crate::solid::Pose;
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};

/// The links and joints of a file.
pub(super) struct Tree<'a, 'input> {
    pub(super) xml: Elements<'a>,
    pub(super) root: Node<'a, 'input>,
    /// The links, by name.
    pub(super) links: BTreeMap<&'a str, Node<'a, 'input>>,
    /// The joints that lead on from each link, in the order of the file.
    ahead: BTreeMap<&'a str, Vec<Node<'a, 'input>>>,
}

impl<'a, 'input> Tree<'a, 'input> {
    pub(super) fn new(xml: Elements<'a>, root: Node<'a, 'input>) -> Result<Self, SettingsError> {
        let mut tree = Self { xml, root, links: BTreeMap::new(), ahead: BTreeMap::new() };
        for link in elements(root, "link") {
            let name = xml.text(link, "name")?;
            if tree.links.insert(name, link).is_some() {
                let message = format!("link `{name}` is given twice; accepted: a name of its own");
                return Err(xml.fault(&link.range(), message));
            }
        }
        let mut led_to = BTreeSet::new();
        let mut joints = BTreeSet::new();
        for joint in elements(root, "joint") {
            let name = xml.text(joint, "name")?;
            if !joints.insert(name) {
                let message = format!("joint `{name}` is given twice; accepted: a name of its own");
                return Err(xml.fault(&joint.range(), message));
            }
            let [parent, child] = [tree.end(joint, "parent")?, tree.end(joint, "child")?];
            if !led_to.insert(child) {
                let message = format!(
                    "a second joint leads to link `{child}`; accepted: one, so that the links are a tree"
                );
                return Err(xml.fault(&joint.range(), message));
            }
            tree.ahead.entry(parent).or_default().push(joint);
        }
        Ok(tree)
    }

    /// The link that a joint names as its parent or child.
    pub(super) fn end(&self, joint: Node<'a, 'input>, what: &'static str) -> Result<&'a str, SettingsError> {
        let end = self.xml.element(joint, what)?;
        let name = self.xml.text(end, "link")?;
        if self.links.contains_key(name) {
            return Ok(name);
        }
        let known = self.links.keys().copied().collect::<Vec<_>>().join(", ");
        let message = format!("there is no link `{name}`; the links are {known}");
        Err(self.xml.fault(&place(end, "link"), message))
    }

    /// The one link that no joint leads to.
    pub(super) fn base(&self) -> Result<&'a str, SettingsError> {
        let children: BTreeSet<&str> = elements(self.root, "joint")
            .filter_map(|joint| child(joint, "child")?.attribute("link"))
            .collect();
        let mut roots = self.links.iter().filter(|(name, _)| !children.contains(*name));
        match (roots.next(), roots.next()) {
            (Some((name, _)), None) => Ok(name),
            (None, _) => Err(self
                .xml
                .fault(&self.root.range(), "no link is the base: every link is led to by a joint")),
            (Some((first, _)), Some((second, node))) => {
                let message =
                    format!("no joint leads to link `{second}`, nor to `{first}`; one base is accepted");
                Err(self.xml.fault(&node.range(), message))
            }
        }
    }

    /// The joints at or beyond `link`, without passing one that moves, each with its frame in that of `link`. Beside
    /// them the links on the way, `link` first, each with its frame and how many joints lead to it.
    #[expect(clippy::type_complexity, reason = "two lists of one walk")]
    pub(super) fn welded(
        &self,
        link: &'a str,
        pose: Pose,
    ) -> Result<(Vec<(Node<'a, 'input>, Pose)>, Vec<(&'a str, Pose, u32)>), SettingsError> {
        let mut moving = Vec::new();
        let mut links = vec![(link, pose, 0)];
        let mut next = 0;
        while let Some(&(link, pose, depth)) = links.get(next) {
            for &joint in self.ahead.get(link).into_iter().flatten() {
                let here = pose.then(&self.origin(joint)?);
                match self.xml.text(joint, "type")? {
                    "fixed" => links.push((self.end(joint, "child")?, here, depth + 1)),
                    _ => moving.push((joint, here)),
                }
            }
            next += 1;
        }
        Ok((moving, links))
    }

    /// The pose in the `origin` of a joint or a solid.
    pub(super) fn origin(&self, of: Node<'a, 'input>) -> Result<Pose, SettingsError> {
        let Some(origin) = child(of, "origin") else { return Ok(Pose::IDENTITY) };
        let xyz = self.xml.numbers::<3>(origin, "xyz")?.unwrap_or([0.0; 3]);
        let rpy = self.xml.numbers::<3>(origin, "rpy")?.unwrap_or([0.0; 3]);
        let xyz = self.xml.0.metres(&place(origin, "xyz"), "xyz", xyz)?;
        let rpy = self.xml.0.radians(&place(origin, "rpy"), "rpy", rpy)?;
        Ok(Pose::from_rpy(xyz, rpy))
    }
}
