//! The columns that records may have besides what names a trial: one list, so that a number means the same in
//! every study. A column's name ends in its unit; plain counts have none.

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A count.
    Count,
    /// A measured quantity.
    Real,
}

/// A column of numbers.
#[derive(Debug)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// What the number says.
    pub about: &'static str,
}

const fn count(name: &'static str, about: &'static str) -> Column {
    Column { name, kind: Kind::Count, about }
}

const fn real(name: &'static str, about: &'static str) -> Column {
    Column { name, kind: Kind::Real, about }
}

/// Every column, in the order in which files have them.
pub static COLUMNS: &[Column] = &[
    real("path_cost_cells", "length of the returned path, cell side = 1"),
    real("turn_exterior_deg", "sum of heading changes along the path"),
    real("turn_interior_deg", "sum of interior angles at the path's bends"),
    count("bends", "points at which the path changes heading"),
    real("optimal_cost_cells", "least cost in the lattice's graph, found by the verifier"),
    count("opened", "nodes ever put on an open list, both sides"),
    count("closed", "nodes ever put on a closed list, both sides"),
    count("expansions", "nodes expanded"),
    count("generated", "successors generated, known ones included"),
    count("free_cells", "cells that are not blocked"),
    count("components", "connected components of the free cells"),
    real("octile_distance_cells", "8-connected distance from start to goal without obstacles"),
    real("path_length_cm", "length of the returned path of the tip"),
    real("straight_line_cm", "distance from start to goal"),
    count("obstacles", "obstacles in the scene"),
    count("free_nodes", "nodes of the cubic lattice that are not blocked"),
    count("fell_back", "1 if the lattice was searched because no key node was left"),
    real("cut_in_cm", "how deep the smoothed path is in an obstacle before it is guarded"),
    count("raised_points", "control points that count more often so that the smoothed path is free"),
    count("adjustments", "steps of posture adjustment taken, on all branches tried"),
    count("branches_tried", "branches of the inverse kinematics tried from the start"),
    real("followed_share", "share of the tip path's nodes that the arm followed on its best branch"),
    count("posture_within_bounds", "1 if the node that failed has a free posture within one node's bounds"),
    count(
        "posture_within_rad",
        "1 if the node that failed has a free posture within a radian about each axis",
    ),
    count("separated", "samples whose exact distance is above 0"),
    count("overestimated", "separated samples whose printed distance is too long"),
    count("colliding", "samples whose exact distance is 0"),
    count("missed", "colliding samples whose printed distance is above 0"),
    count("segment_pairs", "pairs of segments compared"),
    count("segment_pairs_wrong", "pairs of segments whose printed distance is not the exact one"),
    real("largest_excess_cm", "the most by which a printed distance is too long"),
    real("joint_range_rad", "sum over the joints of the greatest less the least angle"),
    real("joint_travel_rad", "sum over the joints of all changes of angle"),
    real("tip_jitter_cm", "sum of the second differences of the tip's place over 200 equal spans of time"),
    real("posture_jitter_rad", "sum of the changes of the tip's turning over 200 equal spans of time"),
    real("joint_jitter_rad", "sum of the second differences of all joints over 200 equal spans of time"),
];

/// The column called `name`.
pub fn find(name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|column| column.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_that_an_entry_declares_is_listed_once() {
        let planners = crate::planner::REGISTRY.iter().flat_map(|entry| entry.columns);
        let families = crate::study::family::REGISTRY.iter().flat_map(|entry| entry.columns);
        let prepared = crate::study::prepared::REGISTRY.iter().flat_map(|entry| entry.columns);
        let tasks = crate::study::task::REGISTRY.iter().flat_map(|entry| entry.columns);
        for name in planners.chain(families).chain(prepared).chain(tasks) {
            assert_eq!(COLUMNS.iter().filter(|column| column.name == *name).count(), 1, "{name}");
        }
    }
}
