//! A six- or seven-axis arm in its cell or scene, or a point among polyhedra; millimetres.
//!
//! Meshes stand once; frames are whole multiples of a step, as 16-bit numbers in base64.

use super::{Case, outcome_text};
use crate::analysis::evidence::Evidence;
use crate::page::PageError;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use engine::planner::Trace;
use serde::Serialize;
use study::Inputs;
use study::family::{ArmPlacement, Family};
use study::record::Row;

/// The most frames of a replay: a motion looks steady at that.
const FRAMES: usize = 100;
/// Polyhedra are stored in centimetres.
const MM_PER_CM: f64 = 10.0;

/// What stands in the cell, and what moves.
#[derive(Serialize)]
pub struct Scene {
    /// Convex solids: vertices, and faces by their vertices.
    solids: Vec<Solid>,
    /// Round obstacles: both ends and radius.
    rounds: Vec<Vec<f64>>,
    /// The height of the floor, if there is one.
    floor: Option<f64>,
    lanes: Vec<Lane>,
}

/// A convex solid.
#[derive(Serialize)]
struct Solid {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
}

/// One trial.
#[derive(Serialize)]
struct Lane {
    label: String,
    ending: String,
    /// The radius of each part.
    radii: Vec<f64>,
    /// How long a step of the frames is.
    step: f64,
    /// Both ends of each part in each frame, then the tip, in steps.
    frames: String,
    /// From the arm to the nearest obstacle in each frame; empty where it is not known.
    clearance: Vec<f64>,
    /// The way that was to be followed, or that a point goes.
    way: Vec<[f64; 3]>,
}

/// The motion of `case`; none if there is nothing in space to show.
///
/// # Errors
/// A family that cannot be built again.
pub fn scene(evidence: &Evidence<'_>, case: &Case<'_>, inputs: &Inputs) -> Result<Option<Scene>, PageError> {
    let run = case.run;
    let on = &case.rows[0].key.on;
    let (solids, rounds) = match (run.trace(on, "boxes"), run.trace(on, "bodies_vertices")) {
        (Some(boxes), _) => (boxes.values.chunks(24).map(cuboid).collect(), run.trace(on, "rounds")),
        (None, Some(vertices)) => (polyhedra(vertices, run.trace(on, "bodies_faces")), None),
        (None, None) => return Ok(None),
    };
    let family =
        case.group.family(case.group.point(&on.sweep), &evidence.point.within(&run.study.choices), inputs)?;
    let lanes: Vec<Lane> = case.rows.iter().filter_map(|row| lane(case, family.as_ref(), row)).collect();
    let floor = match run.trace(on, "floor") {
        Some(floor) => floor.values.first().copied(),
        None => run.trace(on, "boxes").map(|_| 0.0),
    };
    let rounds = rounds.into_iter().flat_map(|rounds| rounds.values.chunks(7).map(<[f64]>::to_vec)).collect();
    let moves = lanes.iter().any(|lane| !lane.radii.is_empty() || !lane.way.is_empty());
    Ok(moves.then_some(Scene { solids, rounds, floor, lanes }))
}

fn lane(case: &Case<'_>, family: &dyn Family, row: &Row) -> Option<Lane> {
    let kept = |name: &str| case.run.trace(&row.key, name);
    let configurations = kept("trajectory")
        .map(|kept| taken(kept, |at| at[1..at.len() - 3].iter().map(|q| q.to_radians()).collect()))
        .or_else(|| kept("path").map(|kept| taken(kept, <[f64]>::to_vec)));
    let stances: Vec<ArmPlacement> =
        configurations.into_iter().flatten().filter_map(|q| family.stance(&q)).collect();
    let stances = if stances.is_empty() { kept("rods").map(stored).unwrap_or_default() } else { stances };
    let way = ["tip_path", "raw_path"].iter().find_map(|name| kept(name)).filter(|way| way.width == 3);
    let way = way.or_else(|| kept("path").filter(|way| way.width == 3));
    let way: Vec<[f64; 3]> = way.map(in_mm).unwrap_or_default();
    // One that found no path is named beside the others.
    if stances.is_empty() && way.is_empty() && row.is_solved() {
        return None;
    }
    let (radii, step, frames) = steps(&stances);
    let clearance = stances.iter().filter_map(|stance| Some((stance.clearance_mm? * 10.0).round() / 10.0));
    Some(Lane {
        label: row.key.contender.to_string(),
        ending: outcome_text(row),
        radii,
        step,
        frames,
        clearance: clearance.collect(),
        way,
    })
}

/// At most [`FRAMES`] rows of what was kept, the ends among them.
fn taken(kept: &Trace, of: impl Fn(&[f64]) -> Vec<f64>) -> Vec<Vec<f64>> {
    let rows: Vec<&[f64]> = kept.values.chunks(kept.width).collect();
    let count = rows.len().min(FRAMES);
    let place = |k: usize| if count < 2 { 0 } else { k * (rows.len() - 1) / (count - 1) };
    (0..count).map(|k| of(rows[place(k)])).collect()
}

/// Postures that were stored as rods: number of the posture, both ends, radius, in centimetres.
fn stored(rods: &Trace) -> Vec<ArmPlacement> {
    let rows: Vec<&[f64]> = rods.values.chunks(rods.width).collect();
    let stance = |rods: &[&[f64]]| {
        let mm = |rod: &&[f64]| std::array::from_fn(|i| rod[i + 1] * MM_PER_CM);
        let capsules_mm: Vec<[f64; 7]> = rods.iter().map(mm).collect();
        let tip_mm = capsules_mm.last().map_or([0.0; 3], |last| [last[3], last[4], last[5]]);
        ArmPlacement { capsules_mm, tip_mm, clearance_mm: None }
    };
    rows.chunk_by(|a, b| a[0] == b[0]).map(stance).collect()
}

/// The radii of the parts, how long a step is, and the frames in steps.
fn steps(stances: &[ArmPlacement]) -> (Vec<f64>, f64, String) {
    let places = |stance: &ArmPlacement| -> Vec<f64> {
        let ends = stance.capsules_mm.iter().flat_map(|capsule| capsule[..6].to_vec());
        ends.chain(stance.tip_mm).collect()
    };
    let all: Vec<f64> = stances.iter().flat_map(places).collect();
    let reach = all.iter().fold(1.0_f64, |reach, value| reach.max(value.abs()));
    let step = reach / f64::from(i16::MAX);
    let bytes: Vec<u8> = all.iter().flat_map(|value| ((value / step).round() as i16).to_le_bytes()).collect();
    let radii = stances.first().map(|stance| stance.capsules_mm.iter().map(|c| c[6]).collect());
    (radii.unwrap_or_default(), step, STANDARD.encode(bytes))
}

fn in_mm(points: &Trace) -> Vec<[f64; 3]> {
    points.values.chunks(3).map(|p| [p[0], p[1], p[2]].map(|x| x * MM_PER_CM)).collect()
}

/// A box by its eight corners, x before y before z.
fn cuboid(corners: &[f64]) -> Solid {
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    Solid {
        vertices: corners.chunks(3).map(|p| [p[0], p[1], p[2]]).collect(),
        faces: faces.map(|face| face.to_vec()).to_vec(),
    }
}

/// Polyhedra whose faces are listed as pairs of face and vertex.
fn polyhedra(vertices: &Trace, faces: Option<&Trace>) -> Vec<Solid> {
    let pairs: Vec<&[f64]> = faces.map(|faces| faces.values.chunks(2).collect()).unwrap_or_default();
    let faces = pairs.chunk_by(|a, b| a[0] == b[0]).map(|face| face.iter().map(|p| p[1] as usize).collect());
    vec![Solid { vertices: in_mm(vertices), faces: faces.collect() }]
}
