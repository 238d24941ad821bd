//! The joints of a robot file: each fault is reported at its own key, and all that are wrong at once.

use super::{Convention, RobotFile, SHORT_MM, Source, in_metres};
use crate::{
    geometry::Frame,
    kinematics::{
        FARTHEST_MM, KinematicsError,
        serial::{AXES, Chain, Joint},
    },
};
use base::settings::{Faults, SettingsError, Spanned};
use base::units::{FASTEST_RAD_S, seems_in_metres, seems_in_radians};
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct JointEntry {
    /// The twist: the turn about x from this joint's axis to the next one's.
    #[schemars(range(min = -360, max = 360))]
    alpha_deg: f64,
    /// The link's length: the way along x to the next axis.
    #[schemars(range(min = -FARTHEST_MM, max = FARTHEST_MM))]
    a_mm: f64,
    /// The offset: the way along this joint's axis.
    #[schemars(range(min = -FARTHEST_MM, max = FARTHEST_MM))]
    d_mm: f64,
    /// What is added to the joint's angle.
    #[schemars(range(min = -360, max = 360))]
    offset_deg: f64,
    /// The least angle.
    #[schemars(range(min = -3600, max = 3600))]
    lower_deg: f64,
    /// The greatest angle.
    #[schemars(range(min = -3600, max = 3600))]
    upper_deg: f64,
    /// The greatest speed; given like this or as `speed_rad_s`.
    speed_deg_s: Option<f64>,
    /// The greatest speed; given like this or as `speed_deg_s`.
    speed_rad_s: Option<Spanned<f64>>,
}

/// What is wrong with the joint of the number `index`, from 0, at the number that `key` names.
fn fault_at(source: &Source, index: usize, key: &str, message: impl Into<String>) -> SettingsError {
    source.0.error_at(&format!("joint.{index}.{key}"), message)
}

/// An error of a chain or a solver, at the number that it is about; `None` if it is about no joint.
pub(super) fn about_joint(source: &Source, error: &KinematicsError) -> Option<SettingsError> {
    let KinematicsError::Joint { joint, key, .. } = error else { return None };
    Some(fault_at(source, joint - 1, key, error.to_string()))
}

/// The joints of `file`; what is wrong with them goes to `faults`.
pub(super) fn joints(source: &Source, file: &RobotFile, faults: &mut Faults) -> Option<[Joint; AXES]> {
    let entries = file.joint.get_ref();
    let joints =
        faults.keep_each(entries.iter().enumerate().map(|(index, entry)| joint(source, index, entry)));
    let count = entries.len();
    if count != AXES {
        let span = entries.last().map_or(file.joint.span(), Spanned::span);
        faults.add(source.fault(&span, format!("{count} joints were given; accepted: {AXES}")));
    }
    for fault in other_units(source, entries) {
        faults.add(fault);
    }
    joints.try_into().ok()
}

/// A key of joints, and the number there.
type Column = (&'static str, fn(&JointEntry) -> Option<f64>);

const LENGTHS: [Column; 2] = [("a_mm", |joint| Some(joint.a_mm)), ("d_mm", |joint| Some(joint.d_mm))];
const LIMITS: [Column; 2] =
    [("lower_deg", |joint| Some(joint.lower_deg)), ("upper_deg", |joint| Some(joint.upper_deg))];
const TURNS: [Column; 2] =
    [("alpha_deg", |joint| Some(joint.alpha_deg)), ("offset_deg", |joint| Some(joint.offset_deg))];
const SPEEDS_DEG_S: [Column; 1] = [("speed_deg_s", |joint| joint.speed_deg_s)];
const SPEEDS_RAD_S: [Column; 1] =
    [("speed_rad_s", |joint| joint.speed_rad_s.as_ref().map(|speed| *speed.get_ref()))];

/// The numbers in a column, each with the number of its joint.
fn numbers<'e>(
    entries: &'e [Spanned<JointEntry>],
    (_, of): &Column,
) -> impl Iterator<Item = (usize, f64)> + use<'e> {
    let of = *of;
    entries.iter().enumerate().filter_map(move |(index, entry)| Some((index, of(entry.get_ref())?)))
}

/// The number farthest from 0 in these columns: how far it is, its joint and its key; `None` if all are 0.
fn farthest(entries: &[Spanned<JointEntry>], columns: &[Column]) -> Option<(f64, usize, &'static str)> {
    let all = columns
        .iter()
        .flat_map(|column| numbers(entries, column).map(|(index, number)| (number.abs(), index, column.0)));
    all.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(size, ..)| *size > 0.0)
}

/// The message about an arm that is a thousandth of its size, does not turn, or is too fast: it is written in metres or radians.
fn other_units(source: &Source, entries: &[Spanned<JointEntry>]) -> Vec<SettingsError> {
    // Some joint of an arm turns farther in degrees; radians are less.
    const LITTLE_DEG: f64 = 7.0;
    // The fastest joint of an arm is faster.
    const SLOW_DEG_S: f64 = 15.0;
    let mut faults = Vec::new();
    let mut fault = |index, key, message: String| faults.push(fault_at(source, index, key, message));
    let longest = farthest(entries, &LENGTHS);
    if let Some((size, index, key)) = longest.filter(|(size, ..)| *size < SHORT_MM) {
        fault(index, key, format!("no link is longer than {size} mm; {}", in_metres(size, "are lengths")));
    }
    // One short length may be an offset that was measured; of several some is a link's.
    for column in LENGTHS.iter().filter(|_| longest.is_some_and(|(size, ..)| size >= SHORT_MM)) {
        let written = numbers(entries, column).filter(|(_, length)| *length != 0.0).count();
        let found = farthest(entries, std::slice::from_ref(column)).filter(|_| written > 1);
        let doubt = found.and_then(|(size, index, key)| {
            Some((index, key, seems_in_metres(&format!("the longest {key} of {written}"), size)?))
        });
        if let Some((index, key, message)) = doubt {
            fault(index, key, message);
        }
    }
    let widest = farthest(entries, &LIMITS).filter(|(size, ..)| *size < LITTLE_DEG);
    if let Some((size, index, key)) = widest {
        let message = format!(
            "no joint turns beyond {size}°; are limits in radians? degrees are accepted ({size} rad is {:.1}°)",
            size.to_degrees()
        );
        fault(index, key, message);
    }
    for column in &TURNS {
        let angles: Vec<f64> = numbers(entries, column).map(|(_, angle)| angle).collect();
        let doubt = seems_in_radians(column.0, &angles);
        if let Some((index, message)) = doubt {
            fault(index, column.0, message);
        }
    }
    // One joint may have limits in radians where the others' are in degrees.
    for (index, entry) in entries.iter().enumerate().filter(|_| widest.is_none()) {
        let limits = LIMITS.map(|(_, of)| of(entry.get_ref()).unwrap_or_default());
        let doubt = seems_in_radians("a limit", &limits);
        if let Some((limit, message)) = doubt {
            fault(index, LIMITS[limit].0, message);
        }
    }
    if let Some((speed, index, key)) = farthest(entries, &SPEEDS_DEG_S) {
        let fastest = FASTEST_RAD_S.to_degrees();
        if speed < SLOW_DEG_S {
            let message = format!(
                "no joint is faster than {speed}°/s; are speeds in radians? degrees are accepted ({speed} rad/s is {:.1}°/s)",
                speed.to_degrees()
            );
            fault(index, key, message);
        } else if speed > fastest {
            fault(
                index,
                key,
                format!("{key} is {speed}; no joint is faster than {fastest:.0}; less is accepted"),
            );
        }
    }
    if let Some((speed, index, key)) =
        farthest(entries, &SPEEDS_RAD_S).filter(|found| found.0 > FASTEST_RAD_S)
    {
        fault(index, key, format!("{key} is {speed}; is it in degrees? `speed_deg_s` is accepted for those"));
    }
    faults
}

/// The chain, and the file's frames in its frames if they differ.
pub(super) fn chain(
    source: &Source,
    file: &RobotFile,
    joints: &[Joint; AXES],
    tool: Frame,
) -> Result<(Chain, Option<[Frame; AXES + 1]>), SettingsError> {
    let chain = match file.convention {
        Convention::Distal => Chain::new(*joints, Frame::IDENTITY, tool).map(|chain| (chain, None)),
        Convention::Modified => {
            Chain::modified(*joints, Frame::IDENTITY, tool).map(|(chain, far)| (chain, Some(far)))
        }
    };
    let fault = |error: KinematicsError| {
        about_joint(source, &error).unwrap_or_else(|| source.fault(&file.joint.span(), error.to_string()))
    };
    chain.map_err(fault)
}

fn joint(source: &Source, index: usize, entry: &Spanned<JointEntry>) -> Result<Joint, SettingsError> {
    let joint = entry.get_ref();
    let (speed_key, speed_rad_s) = match (joint.speed_deg_s, &joint.speed_rad_s) {
        (Some(speed_deg_s), None) => ("speed_deg_s", speed_deg_s.to_radians()),
        (None, Some(speed_rad_s)) => ("speed_rad_s", *speed_rad_s.get_ref()),
        (given, other) => {
            let found = if given.is_some() { "both" } else { "neither" };
            let message = format!("{found} of speed_deg_s and speed_rad_s is given; accepted: exactly one");
            return Err(source.fault(&other.as_ref().map_or(entry.span(), Spanned::span), message));
        }
    };
    let read = Joint {
        alpha_rad: joint.alpha_deg.to_radians(),
        a_m: joint.a_mm * 1e-3,
        d_m: joint.d_mm * 1e-3,
        offset_rad: joint.offset_deg.to_radians(),
        lower_rad: joint.lower_deg.to_radians(),
        upper_rad: joint.upper_deg.to_radians(),
        speed_rad_s,
    };
    let mut faults = Faults::default();
    for (key, found, accepted) in read.faults() {
        let key = if key == "speed_deg_s" { speed_key } else { key };
        let error = KinematicsError::joint(index, key, found, accepted);
        faults.add(fault_at(source, index, key, error.to_string()));
    }
    faults.or(Some(read))
}
