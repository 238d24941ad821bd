//! A planar arm along its path.

use super::{Case, outcome_text};
use engine::planner::Trace;
use serde::Serialize;

/// The plane with its obstacles, and the arm of each trial at the stations of its path.
#[derive(Serialize)]
pub struct Scene {
    /// x from and to, y from and to, in centimetres.
    window: [f64; 4],
    obstacles: Vec<Vec<[f64; 2]>>,
    lanes: Vec<Lane>,
}

/// One trial.
#[derive(Serialize)]
struct Lane {
    label: String,
    ending: String,
    /// Elbow and tip at each station, in centimetres.
    stations: Vec<[f64; 4]>,
}

fn points(trace: &Trace) -> Vec<[f64; 2]> {
    trace.values.chunks(trace.width).map(|point| [point[0], point[1]]).collect()
}

/// The paths of `case`; none if it is not of a planar arm.
pub fn scene(case: &Case<'_>) -> Option<Scene> {
    let run = case.run;
    let on = &case.rows[0].key.on;
    let lattice = &run.trace(on, "lattice")?.values;
    let low = [lattice[0], lattice[1]];
    let step = lattice[2];
    let size = [lattice[3], lattice[4]];
    let ends = |axis: usize| [low[axis] - step, low[axis] + step * size[axis]];
    let [x, y] = [ends(0), ends(1)];
    let obstacles =
        (1..).map_while(|index| run.trace(on, &format!("obstacle_{index}")).map(points)).collect();
    let lane = |row: &&study::record::Row| {
        let stations = run.trace(&row.key, "stations")?;
        let stations = stations.values.chunks(stations.width).map(|s| [s[2], s[3], s[4], s[5]]).collect();
        Some(Lane { label: row.key.contender.to_string(), ending: outcome_text(row), stations })
    };
    let lanes: Vec<Lane> = case.rows.iter().filter_map(lane).collect();
    (!lanes.is_empty()).then(|| Scene { window: [x[0], x[1], y[0], y[1]], obstacles, lanes })
}
