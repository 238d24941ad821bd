//! One map from a file of any kind, with one start and one goal.

use super::{Entry, Family, Query};
use crate::StudyError;
use crate::prepared::{Prepared, lattice};
use crate::verification::LATTICE_COLUMNS;
use base::grid::{FileMap, read_map};
use base::settings::{Accepted, Faults};
use engine::planner::Invalid;
use engine::space::{LatticeWorld, WorldKind};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grid_map",
    about: "one map from a file (text, PNG, ROS, Moving AI), one start and one goal",
    revision: 1,
    is_drawn: false,
    prepared: lattice::ENTRY.name,
    columns: LATTICE_COLUMNS,
    settings: Accepted::of::<GridMap>(),
    example: r#"
map = "data/maps/zhang_w1.map.txt"
start = [22, 15]
goal = [26, 28]
corner_rule = "allow"
"#,
    build: |settings, inputs| {
        let read: GridMap = settings.read()?;
        let file = inputs.locate(&read.map).map_err(|message| settings.error_at("map", message))?;
        let map = read_map(&file).map_err(|e| settings.error_at("map", e.to_string()))?;
        let world = LatticeWorld::new(map.grid.clone(), read.corner_rule.into());
        let mut faults = Faults::default();
        for (what, cell) in [("start", read.start), ("goal", read.goal)] {
            let free = world.free_cell(what, &cell.map(f64::from));
            faults.keep(free.map_err(|message| settings.error_at(what, message)));
        }
        faults.done()?;
        let [start, goal] = [read.start, read.goal].map(|cell| cell.map(f64::from).to_vec());
        let queries = [Query { name: String::new(), start, goal }];
        Ok::<Box<dyn Family>, StudyError>(Box::new(Posed { read, map, queries }))
    },
};

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct GridMap {
    /// The map file: text (`.` free, `#` blocked), an image (`.png`, `.pgm`: free where it is bright), a ROS map (`.yaml`) or a Moving AI
    /// map (`.map`).
    map: String,
    /// The column and row of the start cell, counted from 0 at the lower left.
    start: [u32; 2],
    /// The column and row of the goal cell, counted from 0 at the lower left.
    goal: [u32; 2],
    /// When a diagonal move past blocked cells is allowed.
    corner_rule: lattice::CornerSetting,
}

struct Posed {
    read: GridMap,
    map: FileMap,
    queries: [Query; 1],
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        WorldKind::Lattice
    }

    fn prepare(&self, _seed: u64) -> Result<Prepared, Invalid> {
        lattice::prepare(self.map.grid.clone(), self.read.corner_rule, self.read.start, self.read.goal)
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn cells(&self) -> u64 {
        u64::from(self.map.grid.cell_count())
    }

    fn notes(&self) -> Vec<String> {
        self.map.notes.clone()
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.map.files
    }
}
