//! A planar arm along its path.

use super::{Case, said};
use engine::planner::Exhibit;
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
    said: String,
    /// Elbow and tip at each station, in centimetres.
    stations: Vec<[f64; 4]>,
}

fn points(exhibit: &Exhibit) -> Vec<[f64; 2]> {
    exhibit.values.chunks(exhibit.width).map(|point| [point[0], point[1]]).collect()
}

/// The paths of `case`; none if it is not of a planar arm.
pub fn scene(case: &Case<'_>) -> Option<Scene> {
    let (run, on) = (case.run, &case.rows[0].key.on);
    let lattice = &run.exhibit(on, "lattice")?.values;
    let (low, step, size) = ([lattice[0], lattice[1]], lattice[2], [lattice[3], lattice[4]]);
    let ends = |axis: usize| [low[axis] - step, low[axis] + step * size[axis]];
    let [x, y] = [ends(0), ends(1)];
    let obstacles =
        (1..).map_while(|index| run.exhibit(on, &format!("obstacle_{index}")).map(points)).collect();
    let lane = |row: &&study::record::Row| {
        let stations = run.exhibit(&row.key, "stations")?;
        let stations = stations.values.chunks(stations.width).map(|s| [s[2], s[3], s[4], s[5]]).collect();
        Some(Lane { label: row.key.contender.to_string(), said: said(row), stations })
    };
    let lanes: Vec<Lane> = case.rows.iter().filter_map(lane).collect();
    (!lanes.is_empty()).then(|| Scene { window: [x[0], x[1], y[0], y[1]], obstacles, lanes })
}
