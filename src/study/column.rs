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
    count("components", "connected components: of the free cells, or of a roadmap's samples"),
    real("octile_distance_cells", "8-connected distance from start to goal without obstacles"),
    real("path_length_mm", "way of the tool's tip or the particle along the returned path"),
    count("local_paths", "local paths that the returned path is made of"),
    real("joint_travel_deg", "sum over all joints of how far each turns along the path, there and back"),
    real("joint_peak_deg_s2", "greatest acceleration of a joint if each local path takes the tool at 0.5 m/s, 1 m/s²"),
    count("connected", "1 if the roadmap's edges join start and goal, else 0"),
    count("shots", "local paths to the goal that were tried before an expansion"),
    count("joins", "local paths that were tried to straighten the path"),
    count("samples", "samples of a roadmap"),
    count("draws", "configurations drawn for a roadmap, refused ones included"),
    count("pairs", "pairs of samples within the radius"),
    count("edges", "pairs of samples that are joined"),
    count("rejected_branch", "pairs on different branches of the inverse kinematics"),
    count("rejected_turn", "pairs whose orientations differ by more than is allowed"),
    count("rejected_unreachable", "pairs whose line leaves the wrist's reach"),
    count("rejected_limits", "pairs whose line leaves the joints' limits"),
    count("rejected_jump", "pairs on whose line a joint jumps"),
    count("rejected_speed", "pairs on whose line a joint is too fast"),
    count("rejected_end", "pairs whose line ends in another configuration"),
    count("rejected_contact", "pairs on whose line the robot touches something"),
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
