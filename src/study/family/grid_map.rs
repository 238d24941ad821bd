//! One map from a file of any kind; start and goal are written, or drawn with each instance.

use super::ends::{Ends, PlaneEnd};
use super::random_maps::{draw_vertex, ends_on};
use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::{Preprocessing, lattice};
use crate::verification::LATTICE_COLUMNS;
use base::grid::{CornerRule, FileMap, Vertices, read_map};
use base::settings::{Accepted, Faults};
use engine::planner::Invalid;
use engine::space::{LatticeWorld, WorldKind};
use schemars::JsonSchema;
use serde::Deserialize;
use std::num::NonZeroU32;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "grid_map",
    about: "one map from a file (text, PNG, ROS, Moving AI); start and goal are written, or drawn with each instance",
    instances: "maps",
    revision: 1,
    is_drawn: false,
    preprocessing: lattice::ENTRY.name,
    columns: LATTICE_COLUMNS,
    settings: Accepted::shape::<GridMap>(),
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
        let vertices = read.vertices.unwrap_or_default();
        let world = lattice::world(map.grid.clone(), read.corner_rule, vertices);
        let mut faults = Faults::default();
        faults.keep(lattice::check_rule(settings, read.corner_rule, vertices));
        for (what, end) in [("start", &read.start), ("goal", &read.goal)] {
            if let PlaneEnd::Written(cell) = end {
                let free = world.free_cell(what, &cell.map(f64::from));
                faults.keep(free.map_err(|message| settings.error_at(what, message)));
            }
        }
        faults.done()?;
        let size = [map.grid.width(), map.grid.height()];
        let ends = ends_on(settings, size, vertices, [&read.start, &read.goal], read.queries, 0)?;
        Ok::<Box<dyn Family>, StudyError>(Box::new(Posed { world, map, ends }))
    },
};

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct GridMap {
    /// The map file: text (`.` free, `#` blocked), an image (`.png`, `.pgm`: free where it is bright), a ROS map (`.yaml`) or a Moving AI
    /// map (`.map`).
    map: String,
    /// The column and row of the start cell, counted from 0 at the lower left; `drawn` with each instance
    /// among free cells; or limits within which it is drawn, as in `{ x = [0, 9], y = 3 }`.
    start: PlaneEnd<u32>,
    /// The goal cell, written or drawn as a start is.
    goal: PlaneEnd<u32>,
    /// How many queries an instance has, each with ends of its own; 1 if absent.
    #[schemars(range(max = 10_000))]
    queries: Option<NonZeroU32>,
    /// When a diagonal move past blocked cells is allowed.
    corner_rule: CornerRule,
    /// Where the vertices are that paths lead over; `centres` of cells if absent. At `corners`, a start or goal [x, y] is the lower
    /// left corner of that cell.
    vertices: Option<Vertices>,
}

struct Posed {
    world: LatticeWorld,
    map: FileMap,
    ends: Ends,
}

impl Posed {
    fn drawn(&self, seed: u64) -> Result<Vec<Query>, Invalid> {
        self.ends.drawn(seed, |stream, limits| draw_vertex(self.world.grid(), stream, limits))
    }
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        lattice::kind(self.world.vertices())
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let queries = self.drawn(seed)?;
        lattice::prepare(self.world.again(), queries.iter().map(Query::ends))
    }

    fn queries(&self) -> &[Query] {
        self.ends.queries()
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        self.drawn(seed).unwrap_or_else(|_| self.queries().to_vec())
    }

    fn draws_ends(&self) -> bool {
        self.ends.are_drawn()
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
