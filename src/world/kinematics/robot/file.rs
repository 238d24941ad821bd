//! The robot file as written, and the way from it to a checked [`Robot`].

mod joints;

use self::joints::JointEntry;
use super::{Body, Part, Robot, attached, tool_frame};
use crate::{
    geometry::{Capsule, Frame, Vec3},
    kinematics::{
        Arm, FARTHEST_MM, KinematicsError,
        serial::{AXES, Chain},
    },
};
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned, did_you_mean};
use base::units::{points_in_metres, radius_in_metres, seems_in_metres, unbent};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeSet, ops::Range, path::Path};

/// What a robot file may hold.
pub const ROBOT_FILE: Accepted = Accepted::shape::<RobotFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RobotFile {
    /// Its name.
    #[schemars(length(min = 1))]
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
struct BodyEntry {
    /// The name of the body.
    name: Spanned<String>,
    /// The capsules that it consists of.
    capsule: Vec<Spanned<CapsuleEntry>>,
    /// Pairs of capsules, by name, that must not touch.
    self_pairs: Vec<Spanned<[Spanned<String>; 2]>>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CapsuleEntry {
    /// Its name.
    name: Spanned<String>,
    /// The link that it moves with: 0 is the base.
    link: Option<Spanned<usize>>,
    /// x, y and z of one end, in the link's frame.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    from_mm: Option<[f64; 3]>,
    /// x, y and z of the other end, in the link's frame.
    #[schemars(inner(range(min = -FARTHEST_MM, max = FARTHEST_MM)))]
    to_mm: Option<[f64; 3]>,
    /// Instead of link and ends: where its axis begins and ends along the tool; the axis is cut so far that the round end
    /// does not reach beyond the tool's tip.
    tool_share: Option<Spanned<[f64; 2]>>,
    /// Whether it counts for collisions of the arm with itself alone.
    #[serde(default)]
    self_only: bool,
    /// The radius.
    #[schemars(range(max = FARTHEST_MM))]
    radius_mm: Spanned<f64>,
}

/// The file being read, which knows the places in it.
struct Source<'a>(&'a Document);

impl Source<'_> {
    fn fault(&self, span: &Range<usize>, message: impl Into<String>) -> SettingsError {
        self.0.error(span.clone(), message)
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
    let file: RobotFile = document.read()?;
    let mut faults = Faults::default();
    let source = Source(&document);
    let tool_length_m = faults.keep(tool_length_m(&source, &file.tool.length_mm));
    let joints = joints::joints(&source, &file, &mut faults);
    let tool = tool_frame(tool_length_m.unwrap_or(SOME_TOOL_M));
    let chain = joints.and_then(|joints| faults.keep(joints::chain(&source, &file, &joints, tool)));
    let (chain, far) = chain.unzip();
    let arm = chain.and_then(|chain| faults.keep(arm(&source, &file, chain)));
    let links = Links {
        chain: arm.as_ref().map(Arm::chain),
        far: far.flatten(),
        tool_length_m: tool_length_m.unwrap_or(SOME_TOOL_M),
    };
    let bodies = bodies(&source, &file.body, &links, &mut faults);
    let (arm, tool_length_m) = faults.or(arm.zip(tool_length_m))?;
    Ok(Robot {
        name: file.name,
        arm,
        flange: Frame::IDENTITY,
        tool_length_m,
        bodies,
        files: Vec::new(),
        notes: Vec::new(),
    })
}

/// What stands in for a tool's length that is not accepted, so that its capsules are checked all the same.
const SOME_TOOL_M: f64 = 1.0;

fn arm(source: &Source, file: &RobotFile, chain: Chain) -> Result<Arm, SettingsError> {
    let solver = file.solver.as_ref();
    let of_solver =
        |error: &KinematicsError| source.fault(&solver.map_or(0..0, Spanned::span), error.to_string());
    Arm::new(chain, solver.map(|name| name.get_ref().as_str()))
        .map_err(|error| joints::about_joint(source, &error).unwrap_or_else(|| of_solver(&error)))
}

/// What capsules are fixed to.
struct Links<'a> {
    /// None if the joints make no arm.
    chain: Option<&'a Chain>,
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
    // No tool is shorter than 2 mm, and few are longer than 2 m.
    if let Some(message) = seems_in_metres("tool.length_mm", found) {
        return Err(source.fault(&length_mm.span(), message));
    }
    Ok(1e-3 * found)
}

/// The longest link of an arm and its body are longer.
const SHORT_MM: f64 = 10.0;

/// Asks whether a length is in metres, for the end of a message.
fn in_metres(found: f64, length: &str) -> String {
    format!("{length} in metres? millimetres are accepted ({found} m is {} mm)", unbent(found * 1e3))
}

/// Asks whether a body is in metres: none of its capsules on links reaches as far as an arm does.
fn body_in_metres(source: &Source, entry: &BodyEntry) -> Option<SettingsError> {
    let size = |capsule: &Spanned<CapsuleEntry>| {
        let CapsuleEntry { from_mm, to_mm, radius_mm, .. } = capsule.get_ref();
        let ends = from_mm.iter().chain(to_mm).flatten();
        let reach = ends.copied().reduce(|a, b| a.abs().max(b.abs()))?;
        Some((reach.abs().max(*radius_mm.get_ref()), capsule.span()))
    };
    let (found, span) = entry.capsule.iter().filter_map(size).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let message = format!(
        "no capsule of body `{}` reaches farther than {found} mm; {}",
        entry.name.get_ref(),
        in_metres(found, "are lengths")
    );
    (f64::MIN_POSITIVE..SHORT_MM).contains(&found).then(|| source.fault(&span, message))
}

fn bodies(
    source: &Source,
    entries: &Spanned<Vec<BodyEntry>>,
    links: &Links,
    faults: &mut Faults,
) -> Vec<Body> {
    let mut names = BTreeSet::new();
    for name in entries.get_ref().iter().map(|entry| &entry.name) {
        if !names.insert(name.get_ref()) {
            let message = format!("body `{}` is given twice; accepted: a name of its own", name.get_ref());
            faults.add(source.fault(&name.span(), message));
        }
    }
    if names.is_empty() {
        faults.add(source.fault(&entries.span(), "no body is given; accepted: at least one"));
    }
    faults.keep_each(entries.get_ref().iter().map(|entry| body(source, entry, links)))
}

fn body(source: &Source, entry: &BodyEntry, links: &Links) -> Result<Body, SettingsError> {
    let mut names = BTreeSet::new();
    let mut faults = Faults::default();
    for capsule in &entry.capsule {
        let CapsuleEntry { name, radius_mm, from_mm, to_mm, .. } = capsule.get_ref();
        let about = |question: String| format!("capsule `{}`: {question}", name.get_ref());
        if let Some(question) = radius_in_metres("radius_mm", *radius_mm.get_ref()) {
            faults.add(source.fault(&radius_mm.span(), about(question)));
        }
        if let Some(question) = points_in_metres("from_mm and to_mm", from_mm.iter().chain(to_mm).flatten()) {
            faults.add(source.fault(&capsule.span(), about(question)));
        }
        if !names.insert(name) {
            let message = format!("capsule `{}` is given twice; accepted: a name of its own", name.get_ref());
            faults.add(source.fault(&name.span(), message));
        }
    }
    if names.is_empty() {
        faults.add(source.fault(&entry.name.span(), "the body has no capsule; accepted: at least one"));
    }
    let parts = faults.keep_each(entry.capsule.iter().map(|capsule| part(source, capsule, links)));
    if let Some(fault) = body_in_metres(source, entry) {
        faults.add(fault);
    }
    faults.done()?;
    if let Some((index, off_m)) = links.chain.and_then(|chain| attached::first_off(&parts, chain)) {
        let Part { name, link, .. } = &parts[index];
        let off_mm = (off_m * 1e6).round() * 1e-3;
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
    let name = name.get_ref();
    let radius_m = radius_mm.get_ref() * 1e-3;
    let of_radius = |error: KinematicsError| source.fault(&radius_mm.span(), error.to_string());
    match (link, from_mm, to_mm, tool_share) {
        (Some(link), Some(from_mm), Some(to_mm), None) => {
            let at = link.span();
            let link = *link.get_ref();
            if link > AXES {
                let message = format!("capsule `{name}` is on link {link}; accepted: 0 (base) to {AXES}");
                return Err(source.fault(&at, message));
            }
            let [from, to] = [from_mm, to_mm].map(|end_mm| links.point(link, end_mm));
            let capsule = Capsule::new(from, to, radius_m).map_err(|error| of_radius(error.into()))?;
            Ok(Part { name: name.clone(), link, tool_share: None, self_only: *self_only, capsule })
        }
        (None, None, None, Some(share)) if !self_only => {
            let [from, to] = *share.get_ref();
            if !(0.0 <= from && from < to && to <= 1.0) {
                let found = format!("capsule `{name}` spans tool_share [{from}, {to}]");
                let message = format!("{found}; accepted: two rising numbers from 0 to 1");
                return Err(source.fault(&share.span(), message));
            }
            Part::of_tool(name, [from, to], radius_m, links.tool_length_m).map_err(|error| match error {
                KinematicsError::NoTool { .. } => source.fault(&share.span(), error.to_string()),
                error => of_radius(error),
            })
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
    pair: &Spanned<[Spanned<String>; 2]>,
) -> Result<[usize; 2], SettingsError> {
    let index = |name: &Spanned<String>| {
        parts.iter().position(|part| part.name == *name.get_ref()).ok_or_else(|| {
            let known: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
            let hint = did_you_mean(name.get_ref(), known.iter().copied());
            let at = name.span();
            let name = name.get_ref();
            let known = known.join(", ");
            let message = format!("self_pairs names capsule `{name}`{hint}; accepted: {known}");
            source.fault(&at, message).about(name).about("name")
        })
    };
    let [first, second] = pair.get_ref();
    let mut faults = Faults::default();
    let found = [first, second].map(|name| faults.keep(index(name)));
    faults.done()?;
    let [first, second] = [first, second].map(Spanned::get_ref);
    let found = found.map(|index| index.expect("a name that is unknown was reported"));
    if found[0] == found[1] || parts[found[0]].link == parts[found[1]].link {
        let message =
            format!("self_pairs joins `{first}` and `{second}`; accepted: capsules on two different links");
        return Err(source.fault(&pair.span(), message));
    }
    Ok(found)
}
