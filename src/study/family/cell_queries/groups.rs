//! The file of groups: named poses of an arm, and the queries that join two of them.

use super::Query;
use crate::name;
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned, none_called};
use base::units::seems_in_radians;
use engine::kinematics::Joints;
use engine::space::cell::Cell;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;

/// What a file of groups may hold.
pub const GROUPS_FILE: Accepted = Accepted::shape::<GroupsFile>();

/// The file of poses and of groups that join two of them.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct GroupsFile {
    /// The poses by name: the angle of each joint, from the base on.
    pose_deg: BTreeMap<String, Joints>,
    /// The queries.
    #[serde(rename = "group")]
    groups: Vec<GroupEntry>,
}

/// A query from one pose to another.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct GroupEntry {
    /// Its name, which no other query has.
    name: Spanned<String>,
    /// The pose that it starts from, by name.
    from: Spanned<String>,
    /// The pose that it goes to, by name.
    to: Spanned<String>,
}

/// The queries of a file, and where the ends of each are named in it.
pub(super) type Placed = (Vec<Query>, Vec<[Range<usize>; 2]>);

/// The queries of a file of groups.
pub(super) fn read_queries(document: &Document) -> Result<Placed, SettingsError> {
    let file: GroupsFile = document.read()?;
    let mut faults = Faults::default();
    let mut pose = |name: &Spanned<String>| {
        let found = file.pose_deg.get(name.get_ref()).ok_or_else(|| {
            let known = file.pose_deg.keys().map(String::as_str);
            document.error(name.span(), none_called("pose", name.get_ref(), known)).about(name.get_ref())
        });
        let found = faults.keep(found)?;
        if let Some(number) = found.iter().find(|number| !number.is_finite()) {
            let message =
                format!("pose `{}` has the angle {number}; finite angles are accepted", name.get_ref());
            faults.add(document.error(name.span(), message));
            return None;
        }
        let key = format!("an angle of pose `{}`", name.get_ref());
        if let Some((index, message)) = seems_in_radians(&key, found) {
            faults.add(document.error_at(&format!("pose_deg.{}.{index}", name.get_ref()), message));
            return None;
        }
        Some(found.map(f64::to_radians).to_vec())
    };
    let query = |group: &GroupEntry| {
        let (start, goal) = (pose(&group.from), pose(&group.to));
        Some(Query { name: group.name.get_ref().clone(), start: start?, goal: goal? })
    };
    let queries: Vec<Query> = file.groups.iter().filter_map(query).collect();
    faults.keep(all_in_degrees(&file.pose_deg, document));
    for (place, message) in name::repeated(file.groups.iter().map(|group| group.name.get_ref().as_str())) {
        faults.add(document.error(file.groups[place].name.span(), message));
    }
    if file.groups.is_empty() {
        faults.add(document.error_at("group", "there is no group; at least one is accepted"));
    }
    let places = file.groups.iter().map(|group| [group.from.span(), group.to.span()]).collect();
    faults.or(Some((queries, places)))
}

/// That poses are in degrees: some joint turns farther than a turn in radians, in every pose that turns half of its joints by more
/// than 1, and in some pose of the file.
fn all_in_degrees(poses: &BTreeMap<String, Joints>, document: &Document) -> Result<(), SettingsError> {
    let farthest = |pose: &Joints| {
        let angles = pose.iter().copied().enumerate();
        angles.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).expect("a pose has six angles")
    };
    let is_plain = |pose: &Joints| pose.iter().all(|angle| angle.fract() == 0.0);
    let is_bent = |pose: &Joints| pose.iter().filter(|angle| angle.abs() > 1.0).count() >= pose.len() / 2;
    let in_all = poses.values().all(|pose| farthest(pose).1.abs() <= TAU);
    let mut small = poses.iter().filter(|(_, pose)| farthest(pose).1.abs() <= TAU && !is_plain(pose));
    let Some((name, pose)) = small.find(|(_, pose)| in_all || is_bent(pose)) else { return Ok(()) };
    let (index, angle) = farthest(pose);
    let message = format!(
        "pose `{name}` turns no joint beyond {angle}°; is it in radians? degrees are accepted ({angle} rad is {:.1}°)",
        angle.to_degrees()
    );
    Err(document.error_at(&format!("pose_deg.{name}.{index}"), message))
}

/// That the arm can stand at all ends of queries in `cell`.
pub(super) fn posed(
    cell: &Cell,
    document: &Document,
    (queries, places): &Placed,
) -> Result<(), SettingsError> {
    let mut faults = Faults::default();
    for (query, places) in queries.iter().zip(places) {
        for ((what, end), place) in [("start", &query.start), ("goal", &query.goal)].into_iter().zip(places) {
            let pose: Joints = end.as_slice().try_into().expect("a pose has six angles");
            if let Some(refusal) = cell.refusal(&pose) {
                let message = format!("the {what} of group `{}` cannot be posed: {refusal}", query.name);
                faults.add(document.error(place.clone(), message));
            }
        }
    }
    faults.done()
}
