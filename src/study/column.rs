//! The columns that records may have besides what names a trial: one list, so that a number means the same in
//! every study. A column's name ends in its unit; plain counts have none.

use std::collections::BTreeMap;
use std::sync::OnceLock;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A whole number of 0 or more.
    Count,
    /// A measured quantity.
    Real,
}

/// Which way is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Less is better.
    Lower,
    /// More is better.
    Higher,
    /// Neither.
    Neither,
}

impl Better {
    /// Its name in files that other programs read.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Higher => "higher",
            Self::Neither => "neither",
        }
    }
}

/// A column of numbers.
#[derive(Debug)]
pub struct Column {
    /// Its name in records, which ends in the unit of a measured quantity.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// What the number says.
    pub about: &'static str,
    /// What tables and axes call it, without the unit; none where its name says it.
    title: Option<&'static str>,
    /// Which way is better.
    pub better: Better,
    /// Whether it counts what the search did: the count holds even where the verifier refuses the path that was found.
    pub is_of_search: bool,
}

/// How names of measured quantities end, and the unit that this stands for; `1` for a share.
const UNITS: [(&str, &str); 10] = [
    ("_deg_s2", "deg/s²"),
    ("_cells", "cells"),
    ("_cm", "cm"),
    ("_deg", "deg"),
    ("_m", "m"),
    ("_mm", "mm"),
    ("_ns", "ns"),
    ("_percent", "%"),
    ("_rad", "rad"),
    ("_share", "1"),
];

impl Column {
    /// The unit of what it holds; none for a count.
    pub fn unit(&self) -> Option<&'static str> {
        let unit = UNITS.iter().find(|(end, _)| self.name.ends_with(end)).map(|(_, unit)| *unit);
        unit.filter(|_| self.kind == Kind::Real)
    }

    /// What tables and axes call it, without the unit: its title, or the words of its name.
    pub fn label(&self) -> String {
        self.title.map_or_else(|| self.words(), str::to_owned)
    }

    /// Its name in words, without the unit.
    fn words(&self) -> String {
        let end =
            UNITS.iter().map(|(end, _)| *end).find(|end| self.unit().is_some() && self.name.ends_with(end));
        let words = self.name.trim_end_matches(end.unwrap_or_default()).replace('_', " ");
        words[..1].to_uppercase() + &words[1..]
    }

    /// It with a title; less is better.
    const fn lower(self, title: &'static str) -> Self {
        Self { better: Better::Lower, ..self.neither(title) }
    }

    /// It with a title; neither way is better.
    const fn neither(self, title: &'static str) -> Self {
        Self { title: Some(title), ..self }
    }

    /// It, counting what the search did.
    const fn of_search(self) -> Self {
        Self { is_of_search: true, ..self }
    }
}

const fn count(name: &'static str, about: &'static str) -> Column {
    Column { name, kind: Kind::Count, about, title: None, better: Better::Neither, is_of_search: false }
}

const fn real(name: &'static str, about: &'static str) -> Column {
    Column { kind: Kind::Real, ..count(name, about) }
}

/// Every column, in the order in which files have them.
pub static COLUMNS: &[Column] = &[
    real("path_cost_cells", "length of the returned path, cell side = 1").lower("Path cost"),
    real("turn_exterior_deg", "sum of heading changes along the path").lower("Turn sum, exterior angles"),
    real("turn_interior_deg", "sum of interior angles at the path's bends").lower("Turn sum, interior angles"),
    count("bends", "points at which the path changes heading").lower("Bends"),
    real("optimal_cost_cells", "least cost in the lattice's graph, found by the verifier").neither("Optimal cost"),
    real("shortest_path_cells", "length of a shortest path between corners of cells, found by the verifier").neither("Shortest path"),
    real("path_length_cm", "length of the path of the arm's tip").lower("Path length"),
    real("optimal_length_cm", "least length in the planner's graph, found by the verifier").neither("Optimal length"),
    count("hops", "hops from lattice point to lattice point along the path").lower("Hops"),
    count("sharp_edges", "bends of at least 45 degrees").lower("Sharp edges"),
    real("largest_turn_deg", "largest heading change at one bend").lower("Largest turn"),
    real("joint1_travel_deg", "sum of the turns of joint 1 along the path").lower("Travel of joint 1"),
    real("joint2_travel_deg", "sum of the turns of joint 2 along the path").lower("Travel of joint 2"),
    real("largest_joint_step_deg", "largest turn of a joint in one hop").lower("Largest turn of a joint in one hop"),
    count("unsafe_hops", "hops during which the arm hits an obstacle, both links swept").lower("Hops that hit an obstacle"),
    real("deepest_cm", "how deep a link goes into an obstacle along the path, in cm; 0 if it enters none").lower("Deepest in an obstacle"),
    count("is_unsafe", "1 if the arm hits an obstacle anywhere along the path, else 0").lower("Paths that hit an obstacle"),
    count("opened", "nodes ever put on an open list, both sides").lower("Opened nodes").of_search(),
    count("opened_distinct", "nodes ever put on an open list, those of both sides counted once").lower("Opened nodes, each once").of_search(),
    count("closed", "nodes ever put on a closed list, both sides").lower("Closed nodes").of_search(),
    count("expansions", "nodes expanded").lower("Expansions").of_search(),
    count("generated", "successors generated, known ones included").lower("Generated successors").of_search(),
    count("preprocessing_bytes", "memory that the planner prepared for the map, besides its legal moves"),
    count("minimum_comparisons", "comparisons that finding the least f would take in a plain list").of_search(),
    count("membership_comparisons", "comparisons that looking successors up would take in plain lists").of_search(),
    count("list_operations", "minimum and membership comparisons together").lower("Linear-scan operations").of_search(),
    count("iterations", "iterations by the planner's own count").lower("Iterations").of_search(),
    count("question_batches", "batches of questions that a planner from outside asked").of_search(),
    count("questions_valid", "configurations that it asked about").lower("Configurations checked for the planner").of_search(),
    count("questions_motion", "motions that it asked about").lower("Motions checked for the planner").of_search(),
    count("questions_fk", "postures whose tip it asked for").of_search(),
    count("questions_ik", "poses whose postures it asked for").of_search(),
    count("incumbents", "paths that it handed over before its result").neither("Paths, each better"),
    count("is_cut_off", "1 if its time ran out and its last incumbent was taken, else 0"),
    count("promises_determinism", "1 if it promised equal results for equal queries and seeds, else 0"),
    real("solve_wall_ns", "from the query to its end by replan's clock, answers to questions included"),
    real("answer_wall_ns", "of it, what replan took to answer questions"),
    real("own_wall_ns", "planning time by the planner's own clock"),
    count("pairs", "pairs of points that have the printed lengths in all cases"),
    count("free_cells", "cells that are not blocked"),
    count("outer_cells", "lattice points farther away than the arm is long"),
    count("inner_cells", "lattice points within the inner radius"),
    count("obstacle_cells", "lattice points in an obstacle"),
    count("link_cells", "lattice points at which a link would hit an obstacle"),
    count("components", "connected components of the free cells").neither("Connected components"),
    real("octile_distance_cells", "8-connected distance from start to goal without obstacles"),
    real("printed_optimal_cells", "least cost as the benchmark prints it").neither("Printed optimal cost"),
    count("tries", "instances that it took until one was accepted"),
    real("path_length_mm", "way of the tool's tip or the particle along the returned path").lower("Path length"),
    count("local_paths", "local paths that the returned path is made of").lower("Local paths"),
    real("joint_travel_deg", "sum over all joints of how far each turns along the path, there and back").lower("Joint travel"),
    real("joint_peak_deg_s2", "greatest acceleration of a joint if each local path takes the tool at 0.5 m/s, 1 m/s²").lower("Peak joint acceleration"),
    count("connected", "1 if the roadmap's edges join start and goal, else 0").neither("Start and goal connected"),
    count("start_links", "samples that the start is joined with").neither("Neighbours of the start"),
    count("goal_links", "samples that the goal is joined with").neither("Neighbours of the goal"),
    count("unjoined_legs", "nodes of the returned path that no edge joins with the one before").lower("Legs that are no edges"),
    real("neighbour_mm", "how far apart neighbours may be on the roadmap: ρ").neither("Neighbour threshold ρ"),
    count("used_samples", "samples of the part of the roadmap that was searched"),
    count("roadmap_pairs", "pairs of near samples that the whole roadmap was built from"),
    count("roadmap_edges", "pairs of samples that the whole roadmap joins").neither("Edges of the roadmap"),
    count("roadmap_checked_states", "configurations checked for contact for all edges of the roadmap, before any query").lower("Configurations checked for the roadmap"),
    real("straight_mm", "distance of the tool's or the particle's places at start and goal"),
    count("smoothing_checks", "lines of sight that post-smoothing looked at").lower("Lines of sight of smoothing"),
    count("sight_checks", "lines of sight between two cells that were looked at").lower("Lines of sight").of_search(),
    count("shots", "local paths to the goal that were tried before an expansion").neither("Shots at the goal").of_search(),
    count("joins", "local paths that were tried to straighten the path"),
    real("joint_length_rad", "way of all joints together: root of the sum of squares of each leg's changes; a metre of a slide counts as a radian").lower("Joint-space length"),
    count("valid_problems", "problems of the set at whose start and one goal at least the robot can be").neither("Valid problems"),
    count("set_problems", "problems of the set").neither("Problems of the set"),
    count("tree_nodes", "nodes of the planner's trees or roadmap").lower("Nodes of the trees").of_search(),
    count("motions", "straight motions that the planner checked").lower("Motions checked").of_search(),
    count("motion_states", "configurations checked for contact on those motions").lower("Configurations checked on motions").of_search(),
    real("initial_length_rad", "way of all joints together along the planner's path, before any stage").lower("Joint-space length before simplification"),
    count("first_iterations", "iterations until the planner's first path").lower("Iterations to the first path"),
    real("first_length_rad", "way of all joints together along the planner's first path").lower("Joint-space length of the first path"),
    count("simplification_motions", "straight motions that were checked to simplify the path"),
    count("simplification_states", "configurations checked for contact on those").lower("Configurations checked to simplify"),
    count("samples", "samples of a roadmap"),
    count("draws", "configurations drawn for a roadmap, refused ones included"),
    count("edges", "pairs of samples that are joined"),
    count("checked_states", "configurations checked for contact: for a roadmap's edges; of a query, in its shots and when it straightens").lower("Configurations checked by the query").of_search(),
    count("rejected_branch", "pairs on different branches of the inverse kinematics"),
    count("rejected_turn", "pairs whose orientations differ by more than is allowed"),
    count("rejected_unreachable", "pairs whose line leaves the wrist's reach"),
    count("rejected_limits", "pairs whose line leaves the joints' limits"),
    count("rejected_jump", "pairs on whose line a joint jumps"),
    count("rejected_speed", "pairs on whose line a joint is too fast"),
    count("rejected_end", "pairs whose line ends in another configuration"),
    count("rejected_contact", "pairs on whose line the robot touches something"),
    real("straight_line_cm", "distance from start to goal"),
    count("line_blocked", "1 if an obstacle is in the way of the straight line from start to goal, else 0"),
    count("obstacles", "obstacles in the scene"),
    count("free_nodes", "nodes of the cubic lattice that are not blocked"),
    count("fell_back", "1 if the lattice was searched because no key node was left"),
    real("cut_in_cm", "how deep the smoothed path is in an obstacle before it is guarded").lower("Cut-in depth"),
    count("raised_points", "control points that count more often so that the smoothed path is free"),
    count("adjustments", "steps of posture adjustment taken, on all branches tried").neither("Adjustments"),
    count("branches_tried", "branches of the inverse kinematics tried from the start"),
    count("beyond_bounds", "nodes of the followed path at which the posture is turned from the first by more than one node's bounds"),
    count("posture_nodes", "nodes of the path that the arm followed"),
    real("followed_share", "share of the tip path's nodes that the arm followed on its best branch"),
    count("posture_within_bounds", "1 if the node that failed has a free posture within one node's bounds"),
    count("posture_within_rad", "1 if the node that failed has a free posture within a radian about each axis"),
    count("separated", "samples whose exact distance is above 0"),
    count("overestimated", "separated samples whose printed distance is too long"),
    count("colliding", "samples whose exact distance is 0"),
    count("missed", "colliding samples whose printed distance is above 0"),
    count("overestimated_listed", "separated samples whose distance by the listed diagonals is too long"),
    count("overestimated_listed_first", "separated samples whose distance by the first list, without a face's closing edge, is too long"),
    count("segment_pairs", "pairs of segments compared"),
    count("segment_pairs_wrong", "pairs of segments whose printed distance is not the exact one"),
    count("segment_pairs_wrong_literal", "pairs of segments whose distance is wrong by the formula to the letter"),
    real("largest_excess_cm", "the most by which a printed distance is too long"),
    count("pushed", "rods within the range of the repulsive potential, moved along the printed force"),
    count("pushed_uphill", "rods along whose printed force the potential does not fall"),
    real("joint_range_rad", "sum over the joints of the greatest less the least angle").neither("Joint range"),
    real("joint_travel_rad", "sum over the joints of all changes of angle").lower("Joint travel"),
    real("tip_jitter_cm", "sum of the second differences of the tip's place over 200 equal spans of time").lower("Tip jitter"),
    real("posture_jitter_rad", "sum of the changes of the tip's turning over 200 equal spans of time").lower("Posture jitter"),
    real("joint_jitter_rad", "sum of the second differences of all joints over 200 equal spans of time").lower("Joint jitter"),
];

/// Traces whose rows have named columns: the trace, and the columns in order.
pub static TRACES: &[(&str, &[&str])] = &[
    ("pose", POSE),
    (
        "trajectory",
        &[
            "time_s", "q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg", "tip_x_mm", "tip_y_mm",
            "tip_z_mm",
        ],
    ),
];

const POSE: &[&str] = &[
    "q1_deg",
    "q2_deg",
    "q3_deg",
    "q4_deg",
    "q5_deg",
    "q6_deg",
    "flange_x_mm",
    "flange_y_mm",
    "flange_z_mm",
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "direction_x",
    "direction_y",
    "direction_z",
];

/// The columns of the trace called `name`, separated by commas, if they are named; what follows a space in its name is not
/// looked at.
pub fn of_trace(name: &str) -> Option<String> {
    let kind = name.split(' ').next()?;
    TRACES.iter().find(|(known, _)| *known == kind).map(|(_, columns)| columns.join(","))
}

/// The place of the column called `name` in [`COLUMNS`].
pub fn place(name: &str) -> Option<u16> {
    static PLACES: OnceLock<BTreeMap<&str, u16>> = OnceLock::new();
    PLACES.get_or_init(|| COLUMNS.iter().map(|column| column.name).zip(0..).collect()).get(name).copied()
}

/// The column called `name`.
pub fn find(name: &str) -> Option<&'static Column> {
    place(name).map(|place| &COLUMNS[usize::from(place)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measured_column_has_a_unit_and_no_count_has_one() {
        for column in COLUMNS {
            assert_eq!(column.unit().is_some(), column.kind == Kind::Real, "{}", column.name);
        }
    }

    #[test]
    fn every_column_that_an_entry_declares_is_listed_once() {
        let planners = crate::planner::all().flat_map(|entry| entry.columns);
        let families = crate::family::REGISTRY.iter().flat_map(|entry| entry.columns);
        let preprocessing = crate::preprocessing::REGISTRY.iter().flat_map(|entry| entry.columns);
        let tasks = crate::task::REGISTRY.iter().flat_map(|entry| entry.columns);
        for name in planners.chain(families).chain(preprocessing).chain(tasks) {
            assert_eq!(COLUMNS.iter().filter(|column| column.name == *name).count(), 1, "{name}");
        }
    }
}
