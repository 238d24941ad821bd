//! The robot file as written, and the way from it to a checked [`Robot`].

use super::{Body, Part, Robot, attached, tool_frame};
use crate::{
    geometry::{Capsule, Frame, Vec3},
    kinematics::{
        Arm, FARTHEST_MM, KinematicsError,
        serial::{AXES, Chain, Joint},
    },
};
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeSet, ops::Range, path::Path};

/// What a robot file may hold.
pub const ROBOT_FILE: Accepted = Accepted::of::<RobotFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RobotFile {
    /// Its name.
    name: String,
    /// The solver of inverse kinematics; without it, the most special one that fits the rows.
    solver: Option<Spanned<String>>,
    /// Which Denavit–Hartenberg convention rows and frames follow.
    #[serde(default)]
    convention: Convention,
    /// The tool at the flange.
    tool: ToolEntry,
    /// The joints, from the base on, by Denavit-Hartenberg parameters in its convention.
    joint: Spanned<Vec<Spanned<JointEntry>>>,
    /// Bodies: sets of capsules that stand for the arm and its tool; a study picks one.
    body: Spanned<Vec<BodyEntry>>,
}

#[derive(Serialize, Deserialize, JsonSchema, Default, Clone, Copy, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Convention {
    /// Frames at the far ends of links: `alpha` and `a` lead from a joint's axis to the next one.
    #[default]
    Distal,
    /// Frames at the near ends: `alpha` and `a` lead from the axis before to the joint's own.
    Modified,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ToolEntry {
    /// How far the tool's tip is from the flange.
    #[schemars(range(max = FARTHEST_MM))]
    length_mm: Spanned<f64>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointEntry {
    /// The twist: the turn about x from this joint's axis to the next one's.
    alpha_deg: f64,
    /// The link's length: the way along x to the next axis.
    #[schemars(range(min = -FARTHEST_MM, max = FARTHEST_MM))]
    a_mm: f64,
    /// The offset: the way along this joint's axis.
    #[schemars(range(min = -FARTHEST_MM, max = FARTHEST_MM))]
    d_mm: f64,
    /// What is added to the joint's angle.
    offset_deg: f64,
    /// The least angle.
    lower_deg: f64,
    /// The greatest angle.
    upper_deg: f64,
    /// The greatest speed; given like this or as `speed_rad_s`.
    speed_deg_s: Option<f64>,
    /// The greatest speed; given like this or as `speed_deg_s`.
    speed_rad_s: Option<f64>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct BodyEntry {
    /// Its name.
    name: Spanned<String>,
    /// Its capsules.
    capsule: Vec<Spanned<CapsuleEntry>>,
    /// Pairs of capsules, by name, that must not touch.
    self_pairs: Vec<Spanned<[String; 2]>>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CapsuleEntry {
    /// Its name.
    name: String,
    /// The link that it moves with: 0 is the base.
    link: Option<usize>,
    /// x, y and z of one end, in the link's frame.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    from_mm: Option<[f64; 3]>,
    /// x, y and z of the other end, in the link's frame.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    to_mm: Option<[f64; 3]>,
    /// Instead of link and ends: where its axis begins and ends along the tool; the axis is cut so far that the round end
    /// does not reach beyond the tool's tip.
    tool_share: Option<[f64; 2]>,
    /// Whether it counts for collisions of the arm with itself alone.
    #[serde(default)]
    self_only: bool,
    /// The radius.
    #[schemars(range(max = FARTHEST_MM))]
    radius_mm: f64,
}

/// The file being read, which knows the places in it.
struct Source<'a>(&'a Document);

impl Source<'_> {
    fn fault(&self, span: &Range<usize>, message: impl Into<String>) -> SettingsError {
        self.0.error(span.clone(), message)
    }

    /// A function that says where an error of a lower floor comes from.
    fn at(&self, span: Range<usize>) -> impl Fn(KinematicsError) -> SettingsError {
        move |error| self.fault(&span, error.to_string())
    }

    fn finite(&self, key: &str, value: &Spanned<f64>) -> Result<f64, SettingsError> {
        let found = *value.get_ref();
        if found.is_finite() {
            return Ok(found);
        }
        Err(self.fault(&value.span(), format!("{key} is {found}; accepted: a finite number")))
    }
}

pub(super) fn parse(text: &str, path: &Path) -> Result<Robot, KinematicsError> {
    let document = Document::new(path, text.to_owned());
    let source = Source(&document);
    let file: RobotFile = document.read()?;
    let mut faults = Faults::default();
    let tool_length_m = faults.keep(tool_length_m(&source, &file.tool.length_mm));
    let joints = faults.keep(joints(&source, &file.joint));
    let (tool_length_m, joints) = faults.or(tool_length_m.zip(joints))?;
    let (chain, far) = chain(&source, &file, &joints, tool_frame(tool_length_m))?;
    let solver = file.solver.as_ref();
    let arm = Arm::new(chain, solver.map(|name| name.get_ref().as_str())).map_err(|error| {
        let span = match &error {
            KinematicsError::Joint { joint, .. } => file.joint.get_ref()[joint - 1].span(),
            _ => solver.map_or(0..0, Spanned::span),
        };
        source.fault(&span, error.to_string())
    })?;
    let links = Links { chain: arm.chain(), far, tool_length_m };
    let bodies = bodies(&source, &file.body, &links)?;
    Ok(Robot {
        name: file.name,
        arm,
        flange: Frame::IDENTITY,
        tool_length_m,
        bodies,
        files: Vec::new(),
        enclosed: None,
    })
}

/// What capsules are fixed to.
struct Links<'a> {
    chain: &'a Chain,
    /// The file's frames in those of the chain, if they differ.
    far: Option<[Frame; AXES + 1]>,
    tool_length_m: f64,
}

impl Links<'_> {
    /// A point given in millimetres in the file's frame of a link.
    fn point(&self, link: usize, point_mm: &[f64; 3]) -> Vec3 {
        let point = Vec3::from(*point_mm) * 1e-3;
        self.far.as_ref().map_or(point, |far| far[link].point(&point))
    }
}

fn tool_length_m(source: &Source, length_mm: &Spanned<f64>) -> Result<f64, SettingsError> {
    let found = source.finite("tool.length_mm", length_mm)?;
    if found < 0.0 {
        let message = format!("tool.length_mm is {found}; accepted: 0 (no tool) or more");
        return Err(source.fault(&length_mm.span(), message));
    }
    Ok(1e-3 * found)
}

fn joints(
    source: &Source,
    entries: &Spanned<Vec<Spanned<JointEntry>>>,
) -> Result<[Joint; AXES], SettingsError> {
    let mut faults = Faults::default();
    let count = entries.get_ref().len();
    if count != AXES {
        let span = entries.get_ref().last().map_or(entries.span(), Spanned::span);
        faults.add(source.fault(&span, format!("{count} joints were given; accepted: {AXES}")));
    }
    let joints = faults.keep_each(entries.get_ref().iter().map(|entry| joint(source, entry)));
    for fault in other_units(source, entries.get_ref()) {
        faults.add(fault);
    }
    faults.or(joints.try_into().ok())
}

/// What is said of an arm that is a thousandth of its size, or does not turn: it is written in metres or radians.
fn other_units(source: &Source, entries: &[Spanned<JointEntry>]) -> Vec<SettingsError> {
    // The longest link of an arm is longer, and some joint turns farther; metres and radians are less.
    const SHORT_MM: f64 = 10.0;
    const LITTLE_DEG: f64 = 7.0;
    let greatest = |of: fn(&JointEntry) -> [f64; 2]| {
        let sizes = entries.iter().map(|entry| {
            let [a, b] = of(entry.get_ref()).map(f64::abs);
            (a.max(b), entry.span())
        });
        sizes.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(size, _)| *size > 0.0)
    };
    let mut faults = Vec::new();
    if let Some((size, at)) = greatest(|joint| [joint.a_mm, joint.d_mm]).filter(|(size, _)| *size < SHORT_MM)
    {
        let message = format!(
            "no link is longer than {size} mm; are lengths in metres? millimetres are accepted ({size} m is {} mm)",
            size * 1e3
        );
        faults.push(source.fault(&at, message));
    }
    if let Some((size, at)) =
        greatest(|joint| [joint.lower_deg, joint.upper_deg]).filter(|(size, _)| *size < LITTLE_DEG)
    {
        let message = format!(
            "no joint turns beyond {size}°; are limits in radians? degrees are accepted ({size} rad is {:.1}°)",
            size.to_degrees()
        );
        faults.push(source.fault(&at, message));
    }
    faults
}

/// The chain, and the file's frames in its frames if they differ.
fn chain(
    source: &Source,
    file: &RobotFile,
    joints: &[Joint; AXES],
    tool: Frame,
) -> Result<(Chain, Option<[Frame; AXES + 1]>), SettingsError> {
    let entries = &file.joint;
    let chain = match file.convention {
        Convention::Distal => Chain::new(*joints, Frame::IDENTITY, tool).map(|chain| (chain, None)),
        Convention::Modified => {
            Chain::modified(*joints, Frame::IDENTITY, tool).map(|(chain, far)| (chain, Some(far)))
        }
    };
    chain.map_err(|error| {
        let at = match &error {
            KinematicsError::Joint { joint, .. } => entries.get_ref()[joint - 1].span(),
            _ => entries.span(),
        };
        source.fault(&at, error.to_string())
    })
}

fn joint(source: &Source, entry: &Spanned<JointEntry>) -> Result<Joint, SettingsError> {
    let joint = entry.get_ref();
    let speed_rad_s = match (joint.speed_deg_s, joint.speed_rad_s) {
        (Some(speed_deg_s), None) => speed_deg_s.to_radians(),
        (None, Some(speed_rad_s)) => speed_rad_s,
        (given, _) => {
            let found = if given.is_some() { "both" } else { "neither" };
            let message = format!("{found} of speed_deg_s and speed_rad_s is given; accepted: exactly one");
            return Err(source.fault(&entry.span(), message));
        }
    };
    Ok(Joint {
        alpha_rad: joint.alpha_deg.to_radians(),
        a_m: joint.a_mm * 1e-3,
        d_m: joint.d_mm * 1e-3,
        offset_rad: joint.offset_deg.to_radians(),
        lower_rad: joint.lower_deg.to_radians(),
        upper_rad: joint.upper_deg.to_radians(),
        speed_rad_s,
    })
}

fn bodies(
    source: &Source,
    entries: &Spanned<Vec<BodyEntry>>,
    links: &Links,
) -> Result<Vec<Body>, SettingsError> {
    let (mut names, mut faults) = (BTreeSet::new(), Faults::default());
    for name in entries.get_ref().iter().map(|entry| &entry.name) {
        if !names.insert(name.get_ref()) {
            let message = format!("body `{}` is given twice; accepted: a name of its own", name.get_ref());
            faults.add(source.fault(&name.span(), message));
        }
    }
    if names.is_empty() {
        faults.add(source.fault(&entries.span(), "no body is given; accepted: at least one"));
    }
    let bodies = faults.keep_each(entries.get_ref().iter().map(|entry| body(source, entry, links)));
    faults.or(Some(bodies))
}

fn body(source: &Source, entry: &BodyEntry, links: &Links) -> Result<Body, SettingsError> {
    let (mut names, mut faults) = (BTreeSet::new(), Faults::default());
    for capsule in &entry.capsule {
        let name = &capsule.get_ref().name;
        if !names.insert(name) {
            let message = format!("capsule `{name}` is given twice; accepted: a name of its own");
            faults.add(source.fault(&capsule.span(), message));
        }
    }
    if names.is_empty() {
        faults.add(source.fault(&entry.name.span(), "the body has no capsule; accepted: at least one"));
    }
    let parts = faults.keep_each(entry.capsule.iter().map(|capsule| part(source, capsule, links)));
    faults.done()?;
    if let Some((index, off_m)) = attached::first_off(&parts, links.chain) {
        let (Part { name, link, .. }, off_mm) = (&parts[index], (off_m * 1e6).round() * 1e-3);
        let message = format!(
            "capsule `{name}` is {off_mm} mm off link {link}; accepted: one that reaches an axis of the link, the line \
             between its axes, or another capsule of the link that does"
        );
        return Err(source.fault(&entry.capsule[index].span(), message));
    }
    let mut faults = Faults::default();
    let self_pairs = faults.keep_each(entry.self_pairs.iter().map(|pair| self_pair(source, &parts, pair)));
    faults.or(Some(Body { name: entry.name.get_ref().clone(), self_pairs, parts }))
}

fn part(source: &Source, entry: &Spanned<CapsuleEntry>, links: &Links) -> Result<Part, SettingsError> {
    let CapsuleEntry { name, link, from_mm, to_mm, tool_share, self_only, radius_mm } = entry.get_ref();
    let (radius_m, at) = (radius_mm * 1e-3, source.at(entry.span()));
    match (link, from_mm, to_mm, tool_share) {
        (Some(link), Some(from_mm), Some(to_mm), None) => {
            if *link > AXES {
                let message = format!("capsule `{name}` is on link {link}; accepted: 0 (base) to {AXES}");
                return Err(source.fault(&entry.span(), message));
            }
            let [from, to] = [from_mm, to_mm].map(|end_mm| links.point(*link, end_mm));
            let capsule = Capsule::new(from, to, radius_m).map_err(|error| at(error.into()))?;
            Ok(Part { name: name.clone(), link: *link, tool_share: None, self_only: *self_only, capsule })
        }
        (None, None, None, Some([from, to])) if !self_only => {
            if !(0.0 <= *from && from < to && *to <= 1.0) {
                let found = format!("capsule `{name}` spans tool_share [{from}, {to}]");
                let message = format!("{found}; accepted: two rising numbers from 0 to 1");
                return Err(source.fault(&entry.span(), message));
            }
            Part::of_tool(name, [*from, *to], radius_m, links.tool_length_m).map_err(at)
        }
        _ => {
            let message = format!(
                "capsule `{name}` does not say where it is; accepted: link, from_mm and to_mm \
                 (and self_only), or tool_share"
            );
            Err(source.fault(&entry.span(), message))
        }
    }
}

fn self_pair(
    source: &Source,
    parts: &[Part],
    pair: &Spanned<[String; 2]>,
) -> Result<[usize; 2], SettingsError> {
    let index = |name: &String| {
        parts.iter().position(|part| part.name == *name).ok_or_else(|| {
            let known = parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>().join(", ");
            let message = format!("self_pairs names capsule `{name}`; accepted: {known}");
            source.fault(&pair.span(), message)
        })
    };
    let [first, second] = pair.get_ref();
    let found = [index(first)?, index(second)?];
    if found[0] == found[1] || parts[found[0]].link == parts[found[1]].link {
        let message =
            format!("self_pairs joins `{first}` and `{second}`; accepted: capsules on two different links");
        return Err(source.fault(&pair.span(), message));
    }
    Ok(found)
}
