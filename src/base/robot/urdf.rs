//! URDF files: the chain from the root link to the last one, with what is fixed to its links.
//!
//! Read are `link` with its `collision` solids (boxes, cylinders, spheres; a mesh is taken for the convex hull of its STL vertices)
//! and `joint` (`revolute`, `continuous` from -180° to 180°, `fixed`). What is only seen or weighed is passed over. Every fault is
//! told at its place: the XML library keeps the places of elements and attributes.
//!
//! Source: the XML format of wiki.ros.org/urdf/XML (link, joint).

use super::{Joint, Robot, stl};
use crate::settings::{Document, SettingsError};
use crate::solid::{Form, Pose, Solid, Source};
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::ops::Range;
use std::path::Path;

/// The robot in the URDF file at `path`; meshes are looked for beside it.
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
    let source = Source(document);
    let parsed = roxmltree::Document::parse(document.text()).map_err(|error| {
        let at = parsed_to(document.text(), error.pos());
        source.fault(&at, format!("this is no XML: {error}"))
    })?;
    let root = parsed.root_element();
    if root.tag_name().name() != "robot" {
        let message = format!("found the element `{}`; `robot` is accepted", root.tag_name().name());
        return Err(source.fault(&root.range(), message));
    }
    if let Some(at) = document.text().find("${") {
        return Err(source.fault(&(at..at), "this is xacro; what `xacro` makes of it is accepted"));
    }
    Tree::new(source, root)?.robot()
}

/// The byte at a place that the XML library names by line and column.
fn parsed_to(text: &str, place: roxmltree::TextPos) -> Range<usize> {
    let line: usize = text.split_inclusive('\n').take(place.row as usize - 1).map(str::len).sum();
    let at = text[line..].char_indices().nth(place.col as usize - 1).map_or(text.len(), |(at, _)| line + at);
    at..at
}

/// The links and joints of a file.
struct Tree<'a, 'input> {
    source: Source<'a>,
    root: Node<'a, 'input>,
    links: BTreeMap<&'a str, Node<'a, 'input>>,
    /// The joints that lead on from each link, in the order of the file.
    ahead: BTreeMap<&'a str, Vec<Node<'a, 'input>>>,
}

impl<'a, 'input> Tree<'a, 'input> {
    fn new(source: Source<'a>, root: Node<'a, 'input>) -> Result<Self, SettingsError> {
        let mut tree = Self { source, root, links: BTreeMap::new(), ahead: BTreeMap::new() };
        for link in elements(root, "link") {
            let name = tree.text(link, "name")?;
            if tree.links.insert(name, link).is_some() {
                let message = format!("link `{name}` is given twice; accepted: a name of its own");
                return Err(source.fault(&link.range(), message));
            }
        }
        let (mut led_to, mut joints) = (BTreeSet::new(), BTreeSet::new());
        for joint in elements(root, "joint") {
            let name = tree.text(joint, "name")?;
            if !joints.insert(name) {
                let message = format!("joint `{name}` is given twice; accepted: a name of its own");
                return Err(source.fault(&joint.range(), message));
            }
            let [parent, child] = [tree.end(joint, "parent")?, tree.end(joint, "child")?];
            if !led_to.insert(child) {
                let message = format!(
                    "a second joint leads to link `{child}`; accepted: one, so that the links are a tree"
                );
                return Err(source.fault(&joint.range(), message));
            }
            tree.ahead.entry(parent).or_default().push(joint);
        }
        Ok(tree)
    }

    /// The link that a joint names as its parent or child.
    fn end(&self, joint: Node<'a, 'input>, what: &'static str) -> Result<&'a str, SettingsError> {
        let end = self.element(joint, what)?;
        let name = self.text(end, "link")?;
        if self.links.contains_key(name) {
            return Ok(name);
        }
        let known = self.links.keys().copied().collect::<Vec<_>>().join(", ");
        let message = format!("there is no link `{name}`; the links are {known}");
        Err(self.source.fault(&place(end, "link"), message))
    }

    fn robot(&self) -> Result<Robot, SettingsError> {
        let name = self.root.attribute("name").unwrap_or("robot").to_owned();
        let mut walk = Walk {
            tree: self,
            robot: Robot {
                name,
                joints: Vec::new(),
                solids: Vec::new(),
                tip: Pose::IDENTITY,
                files: Vec::new(),
            },
            passed: BTreeSet::new(),
        };
        let mut at = Some((self.base()?, Pose::IDENTITY));
        while let Some((link, pose)) = at {
            at = walk.link(link, pose)?;
        }
        if let Some((name, lost)) = self.links.iter().find(|(name, _)| !walk.passed.contains(*name)) {
            let message = format!("no joints lead from the base to link `{name}`; one chain is accepted");
            return Err(self.source.fault(&lost.range(), message));
        }
        let Robot { joints, solids, .. } = &walk.robot;
        let lacks = match (joints.is_empty(), solids.is_empty()) {
            (true, _) => "no joint turns; at least one is accepted",
            (_, true) => "no link has a `collision`: nothing could be touched; at least one is accepted",
            (false, false) => return Ok(walk.robot),
        };
        Err(self.source.fault(&self.root.range(), lacks))
    }

    /// The one link that no joint leads to.
    fn base(&self) -> Result<&'a str, SettingsError> {
        let children: BTreeSet<&str> = elements(self.root, "joint")
            .filter_map(|joint| child(joint, "child")?.attribute("link"))
            .collect();
        let mut roots = self.links.iter().filter(|(name, _)| !children.contains(*name));
        match (roots.next(), roots.next()) {
            (Some((name, _)), None) => Ok(name),
            (None, _) => Err(self
                .source
                .fault(&self.root.range(), "no link is the base: every link is led to by a joint")),
            (Some((first, _)), Some((second, node))) => {
                let message =
                    format!("no joint leads to link `{second}`, nor to `{first}`; one base is accepted");
                Err(self.source.fault(&node.range(), message))
            }
        }
    }

    /// The joints at or beyond `link`, without passing one that moves, each with its frame in that of `link`; and the links on
    /// the way, `link` first, each with its frame and how many joints lead to it.
    #[expect(clippy::type_complexity, reason = "two lists of one walk")]
    fn welded(
        &self,
        link: &'a str,
        pose: Pose,
    ) -> Result<(Vec<(Node<'a, 'input>, Pose)>, Vec<(&'a str, Pose, u32)>), SettingsError> {
        let (mut moving, mut links) = (Vec::new(), vec![(link, pose, 0)]);
        let mut next = 0;
        while let Some(&(link, pose, depth)) = links.get(next) {
            for &joint in self.ahead.get(link).into_iter().flatten() {
                let here = pose.then(&self.origin(joint)?);
                match self.text(joint, "type")? {
                    "fixed" => links.push((self.end(joint, "child")?, here, depth + 1)),
                    _ => moving.push((joint, here)),
                }
            }
            next += 1;
        }
        Ok((moving, links))
    }

    /// The pose in the `origin` of a joint or a solid.
    fn origin(&self, of: Node<'a, 'input>) -> Result<Pose, SettingsError> {
        let Some(origin) = child(of, "origin") else { return Ok(Pose::IDENTITY) };
        let xyz = self.numbers::<3>(origin, "xyz")?.unwrap_or([0.0; 3]);
        let rpy = self.numbers::<3>(origin, "rpy")?.unwrap_or([0.0; 3]);
        let xyz = self.source.metres(&place(origin, "xyz"), "xyz", xyz)?;
        if let Some(angle) = rpy.iter().find(|angle| angle.abs() > 4.0 * PI) {
            let message = format!("rpy has the angle {angle}; is it in degrees? radians are accepted");
            return Err(self.source.fault(&place(origin, "rpy"), message));
        }
        Ok(Pose::from_rpy(xyz, rpy))
    }

    fn element(&self, of: Node<'a, 'input>, name: &'static str) -> Result<Node<'a, 'input>, SettingsError> {
        child(of, name).ok_or_else(|| {
            let (what, whose) = (of.tag_name().name(), of.attribute("name").unwrap_or_default());
            self.source.fault(&of.range(), format!("{what} `{whose}` has no `{name}`; one is accepted"))
        })
    }

    fn text(&self, of: Node<'a, 'input>, key: &'static str) -> Result<&'a str, SettingsError> {
        of.attribute(key).ok_or_else(|| {
            let what = of.tag_name().name();
            self.source.fault(&of.range(), format!("the element `{what}` has no `{key}`; one is accepted"))
        })
    }

    /// `N` finite numbers in an attribute, if it is there.
    fn numbers<const N: usize>(
        &self,
        of: Node<'a, 'input>,
        key: &'static str,
    ) -> Result<Option<[f64; N]>, SettingsError> {
        let Some(text) = of.attribute(key) else { return Ok(None) };
        let numbers: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        let wrong = || {
            let many = if N == 1 { "a number is".to_owned() } else { format!("{N} numbers are") };
            self.source.fault(&place(of, key), format!("{key} is `{text}`; {many} accepted"))
        };
        Ok(Some(self.source.finite(&place(of, key), key, numbers.ok_or_else(wrong)?)?))
    }

    fn number(&self, of: Node<'a, 'input>, key: &'static str) -> Result<f64, SettingsError> {
        self.text(of, key)?;
        Ok(self.numbers::<1>(of, key)?.expect("the attribute is there")[0])
    }
}

fn elements<'a, 'input>(of: Node<'a, 'input>, name: &'static str) -> impl Iterator<Item = Node<'a, 'input>> {
    of.children().filter(move |node| node.has_tag_name(name))
}

fn child<'a, 'input>(of: Node<'a, 'input>, name: &'static str) -> Option<Node<'a, 'input>> {
    elements(of, name).next()
}

/// Where an attribute stands; its element if there is none.
fn place(of: Node<'_, '_>, key: &str) -> Range<usize> {
    of.attribute_node(key).map_or(of.range(), |attribute| attribute.range())
}

/// The robot as far as the chain was followed.
struct Walk<'t, 'a, 'input> {
    tree: &'t Tree<'a, 'input>,
    robot: Robot,
    passed: BTreeSet<&'a str>,
}

impl<'a, 'input> Walk<'_, 'a, 'input> {
    /// Adds everything that is welded to `link`, whose frame is at `pose` in that of the last joint, and the joint that follows;
    /// gives the next link.
    fn link(&mut self, link: &'a str, pose: Pose) -> Result<Option<(&'a str, Pose)>, SettingsError> {
        let (moving, links) = self.tree.welded(link, pose)?;
        for (name, pose, _) in &links {
            self.passed.insert(name);
            for collision in elements(self.tree.links[name], "collision") {
                let solid = self.solid(name, *pose, collision)?;
                self.robot.solids.push((self.robot.joints.len(), solid));
            }
        }
        match moving[..] {
            [] => {
                let deepest = links.iter().map(|(.., depth)| *depth).max().unwrap_or_default();
                let tip = links.iter().find(|(.., depth)| *depth == deepest);
                self.robot.tip = tip.map_or(pose, |(_, pose, _)| *pose);
                Ok(None)
            }
            [(joint, before)] => {
                let joint_read = self.joint(joint, before)?;
                self.robot.joints.push(joint_read);
                Ok(Some((self.tree.end(joint, "child")?, Pose::IDENTITY)))
            }
            [(first, _), (second, _), ..] => {
                let names = [first, second].map(|joint| joint.attribute("name").unwrap_or_default());
                let message = format!(
                    "the tree branches at link `{link}`: joints `{}` and `{}` both move; one chain is accepted (a gripper's \
                     fingers can be made `fixed`)",
                    names[0], names[1]
                );
                Err(self.tree.source.fault(&second.range(), message))
            }
        }
    }

    fn joint(&self, joint: Node<'a, 'input>, before: Pose) -> Result<Joint, SettingsError> {
        let (tree, source) = (self.tree, self.tree.source);
        let name = tree.text(joint, "name")?;
        let kind = tree.text(joint, "type")?;
        if !["revolute", "continuous"].contains(&kind) {
            let message = format!("joint `{name}` is {kind}; revolute, continuous and fixed are accepted");
            return Err(source.fault(&place(joint, "type"), message));
        }
        if let Some(mimic) = child(joint, "mimic") {
            let message =
                format!("joint `{name}` follows another one; joints that move by themselves are accepted");
            return Err(source.fault(&mimic.range(), message));
        }
        let axis = match child(joint, "axis") {
            Some(axis) => tree.numbers::<3>(axis, "xyz")?.unwrap_or([1.0, 0.0, 0.0]),
            None => [1.0, 0.0, 0.0],
        };
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length < 1e-6 {
            let message = format!("the axis of joint `{name}` is {axis:?}; a direction is accepted");
            return Err(source.fault(&child(joint, "axis").unwrap_or(joint).range(), message));
        }
        let limit = tree.element(joint, "limit").map_err(|error| {
            error.prefixed(&format!(
                "a {kind} joint needs a limit (lower, upper and velocity; continuous: velocity): "
            ))
        })?;
        let limits_rad = if kind == "continuous" { [-PI, PI] } else { self.limits(name, limit)? };
        let speed_rad_s = tree.number(limit, "velocity")?;
        if speed_rad_s <= 0.0 {
            let message =
                format!("the velocity of joint `{name}` is {speed_rad_s}; a number above 0 is accepted");
            return Err(source.fault(&place(limit, "velocity"), message));
        }
        Ok(Joint { name: name.to_owned(), before, axis: axis.map(|x| x / length), limits_rad, speed_rad_s })
    }

    fn limits(&self, name: &str, limit: Node<'a, 'input>) -> Result<[f64; 2], SettingsError> {
        let [lower, upper] = [self.tree.number(limit, "lower")?, self.tree.number(limit, "upper")?];
        let fault = |key, message: String| Err(self.tree.source.fault(&place(limit, key), message));
        for (key, angle) in [("lower", lower), ("upper", upper)] {
            if angle.abs() > 4.0 * PI {
                return fault(
                    key,
                    format!("{key} of joint `{name}` is {angle}; is it in degrees? radians are accepted"),
                );
            }
        }
        if upper <= lower {
            return fault(
                "upper",
                format!("upper of joint `{name}` is {upper}; more than lower, {lower}, is accepted"),
            );
        }
        Ok([lower, upper])
    }

    fn solid(&mut self, link: &str, pose: Pose, collision: Node<'a, 'input>) -> Result<Solid, SettingsError> {
        let (tree, source) = (self.tree, self.tree.source);
        let count = self.robot.solids.iter().filter(|(_, solid)| solid.name.starts_with(link)).count();
        let name = if count == 0 { link.to_owned() } else { format!("{link} {}", count + 1) };
        let pose = pose.then(&tree.origin(collision)?);
        let geometry = tree.element(collision, "geometry")?;
        let Some(shape) = geometry.children().find(Node::is_element) else {
            return Err(source.fault(&geometry.range(), "the geometry is empty; a solid is accepted"));
        };
        let sized = |key: &'static str| -> Result<f64, SettingsError> {
            let size = tree.number(shape, key)?;
            Ok(source.sizes(&place(shape, key), key, [size])?[0])
        };
        let form = match shape.tag_name().name() {
            "box" => {
                tree.text(shape, "size")?;
                let size = tree.numbers::<3>(shape, "size")?.expect("the attribute is there");
                Form::Box(source.sizes(&place(shape, "size"), "size", size)?.map(|side| 0.5 * side))
            }
            "cylinder" => Form::Cylinder(sized("radius")?, sized("length")?),
            "sphere" => Form::Sphere(sized("radius")?),
            "mesh" => self.mesh(shape)?,
            other => {
                let message = format!("a solid is `{other}`; box, cylinder, sphere and mesh are accepted");
                return Err(source.fault(&shape.range(), message));
            }
        };
        Ok(Solid { name, pose, form })
    }

    /// The hull of a mesh, scaled as the element says.
    fn mesh(&mut self, mesh: Node<'a, 'input>) -> Result<Form, SettingsError> {
        let (tree, source) = (self.tree, self.tree.source);
        let (given, at) = (tree.text(mesh, "filename")?, place(mesh, "filename"));
        if !Path::new(given).extension().is_some_and(|end| end.eq_ignore_ascii_case("stl")) {
            return Err(
                source.fault(&at, format!("the mesh `{given}` is no STL file; STL files are accepted"))
            );
        }
        let tried = stl::places(source.0.path(), given);
        let Some(file) = tried.iter().find(|path| path.is_file()) else {
            let places: Vec<String> = tried.iter().map(|path| path.display().to_string()).collect();
            return Err(
                source.fault(&at, format!("there is no mesh `{given}`; looked for {}", places.join(", ")))
            );
        };
        let scale = tree.numbers::<3>(mesh, "scale")?.unwrap_or([1.0; 3]);
        let points =
            stl::read(file).map_err(|message| source.fault(&at, format!("{}: {message}", file.display())))?;
        let scaled = |[x, y, z]: [f64; 3]| [x * scale[0], y * scale[1], z * scale[2]];
        let points: Vec<[f64; 3]> = points.into_iter().map(scaled).collect();
        for point in &points {
            source.metres(&at, "the mesh", *point).map_err(|error| {
                error.prefixed("a mesh in millimetres wants scale=\"0.001 0.001 0.001\": ")
            })?;
        }
        if !self.robot.files.contains(file) {
            self.robot.files.push(file.clone());
        }
        Ok(Form::Hull(points))
    }
}
