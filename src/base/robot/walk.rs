//! The walk along the chain of a URDF file: its joints and the solids of its links.

use super::elements::{Elements, child, elements, place};
use super::tree::Tree;
use super::{Joint, Kind, Robot, stl};
use crate::settings::SettingsError;
use crate::solid::{FAR_M, FAR_RAD, Form, Pose, Solid};
use roxmltree::Node;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::path::Path;

/// The robot of a tree that is one chain.
pub(super) fn robot(tree: &Tree<'_, '_>) -> Result<Robot, SettingsError> {
    let robot = Robot {
        name: tree.root.attribute("name").unwrap_or("robot").to_owned(),
        base: tree.base()?.to_owned(),
        joints: Vec::new(),
        solids: Vec::new(),
        owners: Vec::new(),
        tip: Pose::IDENTITY,
        files: Vec::new(),
        notes: Vec::new(),
    };
    let mut walk = Walk { tree, robot, passed: BTreeSet::new() };
    let mut at = Some((tree.base()?, Pose::IDENTITY));
    while let Some((link, pose)) = at {
        at = walk.link(link, pose)?;
    }
    if let Some((name, lost)) = tree.links.iter().find(|(name, _)| !walk.passed.contains(*name)) {
        let message = format!("no joints lead from the base to link `{name}`; one chain is accepted");
        return Err(tree.xml.fault(&lost.range(), message));
    }
    let Robot { joints, solids, .. } = &walk.robot;
    let lacks = match (joints.is_empty(), solids.is_empty()) {
        (true, _) => "no joint moves; at least one is accepted",
        (_, true) => "no link has a `collision`: nothing could be touched; at least one is accepted",
        (false, false) => return Ok(walk.robot),
    };
    Err(tree.xml.fault(&tree.root.range(), lacks))
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
            for (before, collision) in elements(self.tree.links[name], "collision").enumerate() {
                let solid_name =
                    if before == 0 { (*name).to_owned() } else { format!("{name} {}", before + 1) };
                let solid = self.solid(solid_name, *pose, collision)?;
                self.robot.solids.push((self.robot.joints.len(), solid));
                self.robot.owners.push((*name).to_owned());
            }
        }
        for (joint, _) in &moving {
            self.refuse_mimic(*joint)?;
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
                Err(self.tree.xml.fault(&second.range(), message))
            }
        }
    }

    /// A joint that follows another one would have to be moved with it.
    fn refuse_mimic(&self, joint: Node<'a, 'input>) -> Result<(), SettingsError> {
        let Some(mimic) = child(joint, "mimic") else { return Ok(()) };
        let [name, leader] =
            [joint.attribute("name"), mimic.attribute("joint")].map(Option::unwrap_or_default);
        let message = format!(
            "joint `{name}` follows `{leader}`; joints that move by themselves are accepted (one that need not move can be made \
             `fixed`)"
        );
        Err(self.tree.xml.fault(&mimic.range(), message))
    }

    fn joint(&self, joint: Node<'a, 'input>, before: Pose) -> Result<Joint, SettingsError> {
        let xml = self.tree.xml;
        let name = xml.text(joint, "name")?;
        let kind = kind(xml, name, joint)?;
        let axis = child(joint, "axis").map(|axis| xml.numbers::<3>(axis, "xyz")).transpose()?.flatten();
        let axis = axis.unwrap_or([1.0, 0.0, 0.0]);
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length < 1e-6 {
            let [x, y, z] = axis;
            let message = format!("the axis of joint `{name}` is {x} {y} {z}; a direction is accepted");
            return Err(xml.fault(&child(joint, "axis").unwrap_or(joint).range(), message));
        }
        let limit = child(joint, "limit");
        let limits = match (kind, limit) {
            (Kind::TurnsOn, _) => [-PI, PI],
            (_, Some(limit)) => limits(xml, name, kind, limit)?,
            (_, None) => {
                let message = format!("joint `{name}` has no `limit`; one is accepted (lower, upper)");
                return Err(xml.fault(&joint.range(), message));
            }
        };
        let speed = limit.map_or(Ok(None), |limit| speed(xml, name, limit))?;
        Ok(Joint { name: name.to_owned(), kind, before, axis: axis.map(|x| x / length), limits, speed })
    }

    fn solid(
        &mut self,
        name: String,
        pose: Pose,
        collision: Node<'a, 'input>,
    ) -> Result<Solid, SettingsError> {
        let tree = self.tree;
        let xml = self.tree.xml;
        let pose = pose.then(&tree.origin(collision)?);
        let geometry = xml.element(collision, "geometry")?;
        let Some(shape) = geometry.children().find(Node::is_element) else {
            return Err(xml.fault(&geometry.range(), "the geometry is empty; a solid is accepted"));
        };
        let sized = |key: &'static str| -> Result<f64, SettingsError> {
            let size = xml.number(shape, key)?;
            Ok(xml.0.sizes(&place(shape, key), key, [size])?[0])
        };
        let form = match shape.tag_name().name() {
            "box" => {
                xml.text(shape, "size")?;
                let size = xml.numbers::<3>(shape, "size")?.expect("the attribute is there");
                Form::Box(xml.0.sizes(&place(shape, "size"), "size", size)?.map(|side| 0.5 * side))
            }
            "cylinder" => Form::Cylinder(sized("radius")?, sized("length")?),
            "sphere" => Form::Sphere(sized("radius")?),
            "mesh" => self.mesh(shape)?,
            other => {
                let message = format!("a solid is `{other}`; box, cylinder, sphere and mesh are accepted");
                return Err(xml.fault(&shape.range(), message));
            }
        };
        Ok(Solid { name, pose, form })
    }

    /// The hull of a mesh, scaled as the element says.
    fn mesh(&mut self, mesh: Node<'a, 'input>) -> Result<Form, SettingsError> {
        let xml = self.tree.xml;
        let given = xml.text(mesh, "filename")?;
        let at = place(mesh, "filename");
        if !Path::new(given).extension().is_some_and(|end| end.eq_ignore_ascii_case("stl")) {
            return Err(xml.fault(&at, format!("the mesh `{given}` is no STL file; STL files are accepted")));
        }
        let tried = stl::places(xml.0.0.path(), given);
        let Some(file) = tried.iter().find(|path| path.exists()) else {
            let places: Vec<String> = tried.iter().map(|path| path.display().to_string()).collect();
            return Err(
                xml.fault(&at, format!("there is no mesh `{given}`; looked for {}", places.join(", ")))
            );
        };
        let scale = xml.numbers::<3>(mesh, "scale")?.unwrap_or([1.0; 3]);
        let points =
            stl::read(file).map_err(|message| xml.fault(&at, format!("{}: {message}", file.display())))?;
        let scaled = |[x, y, z]: [f64; 3]| [x * scale[0], y * scale[1], z * scale[2]];
        let points: Vec<[f64; 3]> = points.into_iter().map(scaled).collect();
        for point in &points {
            xml.0.metres(&at, "the mesh", *point).map_err(|error| {
                error.prefixed("a mesh in millimetres wants scale=\"0.001 0.001 0.001\": ")
            })?;
        }
        if !self.robot.files.contains(file) {
            self.robot.files.push(file.clone());
        }
        Ok(Form::Hull(points))
    }
}

/// How a joint moves, by its type.
fn kind(xml: Elements<'_>, name: &str, joint: Node<'_, '_>) -> Result<Kind, SettingsError> {
    match xml.text(joint, "type")? {
        "revolute" => Ok(Kind::Turns),
        "continuous" => Ok(Kind::TurnsOn),
        "prismatic" => Ok(Kind::Slides),
        other => {
            let message =
                format!("joint `{name}` is {other}; revolute, continuous, prismatic and fixed are accepted");
            Err(xml.fault(&place(joint, "type"), message))
        }
    }
}

/// The greatest speed, if there is one above 0: files write 0 for one that is not known.
fn speed(xml: Elements<'_>, name: &str, limit: Node<'_, '_>) -> Result<Option<f64>, SettingsError> {
    let speed = xml.number_or(limit, "velocity", 0.0)?;
    if speed >= 0.0 {
        return Ok(Some(speed).filter(|speed| *speed > 0.0));
    }
    let message = format!("the velocity of joint `{name}` is {speed}; 0 (unknown) or more is accepted");
    Err(xml.fault(&place(limit, "velocity"), message))
}

/// The limits of a joint that does not turn on; one that is left out is 0.
fn limits(xml: Elements<'_>, name: &str, kind: Kind, limit: Node<'_, '_>) -> Result<[f64; 2], SettingsError> {
    let [lower, upper] = [xml.number_or(limit, "lower", 0.0)?, xml.number_or(limit, "upper", 0.0)?];
    let fault = |key, message: String| Err(xml.fault(&place(limit, key), message));
    for (key, value) in [("lower", lower), ("upper", upper)] {
        let (most, accepted) = match kind {
            Kind::Slides => (FAR_M, "is it in millimetres? metres are accepted"),
            Kind::Turns | Kind::TurnsOn => (FAR_RAD, "is it in degrees? radians are accepted"),
        };
        if value.abs() > most {
            return fault(key, format!("{key} of joint `{name}` is {value}; {accepted}"));
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
