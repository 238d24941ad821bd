//! Metrics: what can be compared, its unit, which way is better, and how to get it from a record.

use engine::planner::Value;
use std::collections::BTreeSet;
use study::record::{Row, Status};
use study::{clock, column};

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

/// A metric: one column of trials, or the median time of a timed trial.
#[derive(Debug, PartialEq)]
pub struct Metric {
    /// The name that claims and figures use.
    pub name: &'static str,
    /// Its name in tables and on axes, without the unit.
    pub label: &'static str,
    /// Its unit as it is printed; empty for counts.
    pub unit: &'static str,
    /// Which way is better.
    pub better: Better,
    /// The column it is read from.
    pub column: &'static str,
    /// By how much the column is multiplied to give the unit.
    pub scale: f64,
    /// The column that it is held against: the metric is 1 where it is at most as large (to 1e-9 of it), otherwise 0.
    pub at_most: Option<&'static str>,
}

/// What is read from the trial's status in place of a column: 1 where a path came back, refused or not, otherwise 0.
const STATUS: &str = "status";

const fn metric(name: &'static str, label: &'static str, unit: &'static str, better: Better) -> Metric {
    Metric { name, label, unit, better, column: name, scale: 1.0, at_most: None }
}

/// Every metric, in the order of their names.
pub static METRICS: &[Metric] = &[
    metric("adjustments", "Adjustments", "", Better::Neither),
    metric("bends", "Bends", "", Better::Lower),
    metric("checked_states", "Configurations checked by the query", "", Better::Lower),
    metric("closed", "Closed nodes", "", Better::Lower),
    metric("components", "Connected components", "", Better::Neither),
    metric("connected", "Start and goal connected", "", Better::Neither),
    metric("cut_in_cm", "Cut-in depth", "cm", Better::Lower),
    metric("deepest_cm", "Deepest in an obstacle", "cm", Better::Lower),
    metric("expansions", "Expansions", "", Better::Lower),
    metric("first_iterations", "Iterations to the first path", "", Better::Lower),
    metric("first_length_rad", "Joint-space length of the first path", "rad", Better::Lower),
    Metric { column: STATUS, ..metric("found", "Path found", "", Better::Higher) },
    metric("generated", "Generated successors", "", Better::Lower),
    metric("goal_links", "Neighbours of the goal", "", Better::Neither),
    metric("hops", "Hops", "", Better::Lower),
    metric("incumbents", "Paths, each better", "", Better::Neither),
    metric("initial_length_rad", "Joint-space length before simplification", "rad", Better::Lower),
    Metric {
        column: "path_cost_cells",
        at_most: Some("shortest_path_cells"),
        ..metric("is_shortest", "Shortest path found", "", Better::Higher)
    },
    metric("is_unsafe", "Paths that hit an obstacle", "", Better::Lower),
    metric("iterations", "Iterations", "", Better::Lower),
    metric("joint1_travel_deg", "Travel of joint 1", "°", Better::Lower),
    metric("joint2_travel_deg", "Travel of joint 2", "°", Better::Lower),
    metric("joint_jitter_rad", "Joint jitter", "rad", Better::Lower),
    metric("joint_length_rad", "Joint-space length", "rad", Better::Lower),
    metric("joint_peak_deg_s2", "Peak joint acceleration", "°/s²", Better::Lower),
    metric("joint_range_rad", "Joint range", "rad", Better::Neither),
    metric("joint_travel_deg", "Joint travel", "°", Better::Lower),
    metric("joint_travel_rad", "Joint travel", "rad", Better::Lower),
    metric("largest_joint_step_deg", "Largest turn of a joint in one hop", "°", Better::Lower),
    metric("largest_turn_deg", "Largest turn", "°", Better::Lower),
    metric("list_operations", "Linear-scan operations", "", Better::Lower),
    metric("local_paths", "Local paths", "", Better::Lower),
    metric("motion_states", "Configurations checked on motions", "", Better::Lower),
    metric("motions", "Motions checked", "", Better::Lower),
    metric("neighbour_mm", "Neighbour threshold ρ", "mm", Better::Neither),
    metric("opened", "Opened nodes", "", Better::Lower),
    metric("opened_distinct", "Opened nodes, each once", "", Better::Lower),
    metric("optimal_cost_cells", "Optimal cost", "cells", Better::Neither),
    metric("optimal_length_cm", "Optimal length", "cm", Better::Neither),
    Metric {
        column: "own_wall_ns",
        scale: 1e-6,
        ..metric("own_time_ms", "Planning time by its own clock", "ms", Better::Lower)
    },
    metric("path_cost_cells", "Path cost", "cells", Better::Lower),
    metric("path_length_cm", "Path length", "cm", Better::Lower),
    metric("path_length_mm", "Path length", "mm", Better::Lower),
    Metric {
        name: "plan_time_ms",
        label: "Planning time",
        unit: "ms",
        better: Better::Lower,
        column: clock::COLUMN,
        scale: 1e-6,
        at_most: None,
    },
    Metric {
        name: "plan_time_us",
        label: "Planning time",
        unit: "µs",
        better: Better::Lower,
        column: clock::COLUMN,
        scale: 1e-3,
        at_most: None,
    },
    metric("posture_jitter_rad", "Posture jitter", "rad", Better::Lower),
    metric("printed_optimal_cells", "Printed optimal cost", "cells", Better::Neither),
    metric("questions_motion", "Motions checked for the planner", "", Better::Lower),
    metric("questions_valid", "Configurations checked for the planner", "", Better::Lower),
    metric("roadmap_checked_states", "Configurations checked for the roadmap", "", Better::Lower),
    metric("roadmap_edges", "Edges of the roadmap", "", Better::Neither),
    metric("set_problems", "Problems of the set", "", Better::Neither),
    metric("sharp_edges", "Sharp edges", "", Better::Lower),
    metric("shortest_path_cells", "Shortest path", "cells", Better::Neither),
    metric("shots", "Shots at the goal", "", Better::Neither),
    metric("sight_checks", "Lines of sight", "", Better::Lower),
    metric("simplification_states", "Configurations checked to simplify", "", Better::Lower),
    metric("smoothing_checks", "Lines of sight of smoothing", "", Better::Lower),
    Metric {
        name: "solve_time_ms",
        label: "Time to a planner's result",
        unit: "ms",
        better: Better::Lower,
        column: "solve_wall_ns",
        scale: 1e-6,
        at_most: None,
    },
    metric("start_links", "Neighbours of the start", "", Better::Neither),
    metric("tip_jitter_cm", "Tip jitter", "cm", Better::Lower),
    metric("tree_nodes", "Nodes of the trees", "", Better::Lower),
    metric("turn_exterior_deg", "Turn sum, exterior angles", "°", Better::Lower),
    metric("turn_interior_deg", "Turn sum, interior angles", "°", Better::Lower),
    metric("unjoined_legs", "Legs that are no edges", "", Better::Lower),
    metric("unsafe_hops", "Hops that hit an obstacle", "", Better::Lower),
    metric("valid_problems", "Valid problems", "", Better::Neither),
];

/// The metric called `name`.
pub fn find(name: &str) -> Option<&'static Metric> {
    METRICS.iter().find(|metric| metric.name == name)
}

impl Metric {
    /// Label and unit, as an axis shows them.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.label.to_owned() } else { format!("{} ({})", self.label, self.unit) }
    }

    /// What its numbers mean: what the column says that it is read from.
    pub fn meaning(&self) -> &'static str {
        match column::find(self.column) {
            Some(_) if self.at_most.is_some() => {
                "1 where the path is as short as any between corners of cells, otherwise 0"
            }
            Some(column) => column.about,
            None if self.is_clock() => clock::ABOUT,
            None => "1 where a path came back, refused or not, otherwise 0",
        }
    }

    /// Whether a study whose records have these columns gives it.
    pub fn is_produced(&self, columns: &BTreeSet<&str>) -> bool {
        self.is_status() || self.is_read_from(columns)
    }

    /// Whether it is read from some of these columns.
    pub fn is_read_from(&self, columns: &BTreeSet<&str>) -> bool {
        columns.contains(self.column) && self.at_most.is_none_or(|other| columns.contains(other))
    }

    /// Whether it is read from the trial's status: 1 where a path came back, refused or not, otherwise 0.
    pub fn is_status(&self) -> bool {
        self.column == STATUS
    }

    /// It for each row, none where it was not measured; `wall_ns` is the median of a row's times.
    pub fn reader<'r>(
        &'r self,
        wall_ns: impl Fn(&Row) -> Option<f64> + 'r,
    ) -> impl Fn(&Row) -> Option<f64> + 'r {
        let place = column::place(self.column);
        let other = self.at_most.and_then(column::place);
        let number = |row: &Row, place: u16| row.values.at(place).map(Value::as_f64);
        move |row| {
            let raw = if self.is_clock() {
                wall_ns(row)
            } else if self.is_status() {
                Some(f64::from(u8::from(matches!(row.status, Status::Solved | Status::Rejected))))
            } else {
                number(row, place?)
            };
            let raw = match other {
                Some(other) => raw.zip(number(row, other)).map(|(own, most)| is_at_most(own, most)),
                None => raw,
            };
            raw.map(|value| value * self.scale)
        }
    }

    /// Whether it is read from the clock.
    pub fn is_clock(&self) -> bool {
        self.column == clock::COLUMN
    }

    /// Whether a clock decides it, ours or a planner's own: it differs between machines and sessions.
    pub fn is_time(&self) -> bool {
        self.column.ends_with("_wall_ns")
    }
}

/// 1 if `own` is at most `most`, up to rounding, otherwise 0.
fn is_at_most(own: f64, most: f64) -> f64 {
    f64::from(u8::from(own <= most * (1.0 + 1e-9)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_shortest_up_to_rounding_alone() {
        let shortest = 2.0_f64.sqrt();
        assert_eq!(
            [shortest, shortest + 1e-12, shortest + 1e-6].map(|own| is_at_most(own, shortest)),
            [1.0, 1.0, 0.0]
        );
    }

    #[test]
    fn metrics_are_in_order_and_read_columns_that_exist() {
        assert!(METRICS.windows(2).all(|pair| pair[0].name < pair[1].name));
        for metric in METRICS {
            assert!(
                metric.is_clock() || metric.is_status() || column::find(metric.column).is_some(),
                "{}",
                metric.name
            );
        }
    }
}
