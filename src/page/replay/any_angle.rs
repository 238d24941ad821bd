//! An any-angle search: nodes in the order in which they were closed, each joined with its parent by a straight line.
//!
//! Node (x, y) stands at (x + 0.5, y + 0.5), in the middle of its cell or at a corner of four cells; lengths are cells.

use super::{Case, outcome_text};
use engine::planner::Trace;
use serde::Serialize;
use study::record::Row;

/// A map with what each trial did on it.
#[derive(Serialize)]
pub struct Scene {
    /// Columns and rows of nodes.
    size: [f64; 2],
    /// The middle of each blocked cell.
    blocked: Vec<[f64; 2]>,
    lanes: Vec<Lane>,
}

/// One trial.
#[derive(Serialize)]
struct Lane {
    label: String,
    ending: String,
    /// Closed nodes in their order: x and y of the node, then of its parent.
    closed: Vec<[f64; 4]>,
    raw: Vec<[f64; 2]>,
    path: Vec<[f64; 2]>,
}

/// The middles of what was kept, two numbers of each row; none of what was not kept.
fn middles(trace: Option<&Trace>) -> Vec<[f64; 2]> {
    let rows = trace.into_iter().flat_map(|trace| trace.values.chunks(trace.width));
    rows.map(|row| [row[0] + 0.5, row[1] + 0.5]).collect()
}

/// The search of `case`; none if no trial of it kept the parents of what it closed.
pub fn scene(case: &Case<'_>) -> Option<Scene> {
    let run = case.run;
    let kept = |name: &str| run.trace(&case.rows[0].key.on, name);
    let size = &kept("size_cells")?.values;
    let lane = |row: &&Row| {
        let kept = |name: &str| run.trace(&row.key, name);
        let closed = middles(kept("closings"));
        let parents = kept("parents").map(|kept| middles(Some(kept)));
        // Without them, every node stands for itself.
        let parents = parents.unwrap_or_else(|| closed.clone());
        let joined = closed.into_iter().zip(parents).map(|([x, y], [u, v])| [x, y, u, v]);
        Lane {
            label: row.key.contender.to_string(),
            ending: outcome_text(row),
            closed: joined.collect(),
            raw: middles(kept("raw_path")),
            path: middles(kept("path")),
        }
    };
    let has_parents = case.rows.iter().any(|row| run.trace(&row.key, "parents").is_some());
    has_parents.then(|| Scene {
        size: [size[0], size[1]],
        blocked: middles(kept("blocked")),
        lanes: case.rows.iter().map(lane).collect(),
    })
}
