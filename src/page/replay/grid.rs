//! A search on a grid: cells in the order in which they were opened and closed.

use super::{Case, outcome_text};
use engine::planner::Trace;
use serde::Serialize;

/// A map with what each trial did on it.
#[derive(Serialize)]
pub struct Scene {
    size: [usize; 2],
    blocked: Vec<[u32; 2]>,
    lanes: Vec<Lane>,
}

/// One trial.
#[derive(Serialize)]
struct Lane {
    label: String,
    ending: String,
    /// Opened cells of each side, in their order.
    opened: [Vec<[u32; 2]>; 2],
    /// Closed cells in their order: the cell, the side that closed it, and how many each side had opened before.
    closings: Vec<[u32; 5]>,
    raw: Vec<[f64; 2]>,
    path: Vec<[f64; 2]>,
}

/// The rows of what was kept, cut to `N` whole numbers each; none of what is narrower or was not kept.
fn rows<const N: usize>(trace: Option<&Trace>) -> Vec<[u32; N]> {
    let rows = trace.into_iter().flat_map(|trace| trace.values.chunks(trace.width));
    rows.filter_map(|row| row.first_chunk::<N>()).map(|row| row.map(|value| value as u32)).collect()
}

fn cells(trace: Option<&Trace>) -> Vec<[u32; 2]> {
    rows(trace)
}

fn centres(trace: Option<&Trace>) -> Vec<[f64; 2]> {
    cells(trace).into_iter().map(|[x, y]| [f64::from(x) + 0.5, f64::from(y) + 0.5]).collect()
}

/// The search of `case`; none if it is not on a grid.
pub fn scene(case: &Case<'_>) -> Option<Scene> {
    let run = case.run;
    let kept = |name: &str| run.trace(&case.rows[0].key.on, name);
    let size = kept("size_cells")?;
    let blocked = kept("blocked")?;
    let lane = |row: &&study::record::Row| {
        let kept = |name: &str| run.trace(&row.key, name);
        Lane {
            label: row.key.contender.to_string(),
            ending: outcome_text(row),
            opened: ["opened_start_side", "opened_goal_side"].map(|name| cells(kept(name))),
            closings: rows(kept("closings")),
            raw: centres(kept("raw_path")),
            path: centres(kept("path")),
        }
    };
    Some(Scene {
        size: [size.values[0] as usize, size.values[1] as usize],
        blocked: cells(Some(blocked)),
        lanes: case.rows.iter().map(lane).collect(),
    })
}
