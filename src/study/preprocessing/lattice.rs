//! A map turned into a lattice of moves, with what it is like.

use super::{Entry, Preprocessing};
use base::grid::{CornerRule, Grid2, components};
use engine::planner::{Counts, Invalid, Trace, Value};
use engine::space::{LatticeWorld, World};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice",
    about: "a map, the moves its corner rule leaves, and its connected components",
    columns: &["free_cells", "components", "octile_distance_cells", "tries"],
};

/// The corner rule as settings write it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CornerSetting {
    /// Every corner may be cut.
    Allow,
    /// A corner may be cut unless both cells that flank it are blocked.
    ForbidBoth,
    /// A corner may be cut only if both cells that flank it are free.
    ForbidAny,
}

impl From<CornerSetting> for CornerRule {
    fn from(setting: CornerSetting) -> Self {
        match setting {
            CornerSetting::Allow => Self::Allow,
            CornerSetting::ForbidBoth => Self::ForbidBoth,
            CornerSetting::ForbidAny => Self::ForbidAny,
        }
    }
}

/// The lattice of `grid`, for queries from a start to a goal ([x, y] in cells); of a single one the octile distance is noted.
///
/// # Errors
/// [`Invalid`] if a start or goal is outside or blocked.
pub fn prepare<'q>(
    grid: Grid2,
    corners: CornerSetting,
    queries: impl ExactSizeIterator<Item = [&'q [f64]; 2]>,
) -> Result<Preprocessing, Invalid> {
    let mut preprocessing = prepare_map(grid, corners);
    let world = preprocessing.world.as_lattice().expect("it was just made of a lattice");
    let is_single = queries.len() == 1;
    for [start, goal] in queries {
        for (what, cell) in [("start", start), ("goal", goal)] {
            world.free_cell(what, cell).map_err(Invalid)?;
        }
        if is_single {
            let [dx, dy] = [0, 1].map(|axis: usize| (start[axis] - goal[axis]).abs());
            let octile = (dx - dy).abs() + dx.min(dy) * std::f64::consts::SQRT_2;
            preprocessing.values.insert("octile_distance_cells", Value::Real(octile));
        }
    }
    Ok(preprocessing)
}

/// The lattice of `grid`, for any number of queries.
pub fn prepare_map(grid: Grid2, corners: CornerSetting) -> Preprocessing {
    let world = LatticeWorld::new(grid, corners.into());
    let grid = world.grid();
    let parts = components(grid, world.moves()).sizes().len();
    let values = Counts::from([
        ("free_cells", Value::Count(u64::from(grid.free_count()))),
        ("components", Value::Count(parts as u64)),
    ]);
    let traces = vec![size(grid), blocked(grid)];
    Preprocessing { world: World::Lattice(world), values, traces }
}

fn size(grid: &Grid2) -> Trace {
    let values = vec![f64::from(grid.width()), f64::from(grid.height())];
    Trace { name: "size_cells".to_owned(), width: 2, values }
}

fn blocked(grid: &Grid2) -> Trace {
    Trace { name: "blocked".to_owned(), width: 2, values: grid.blocked_xy() }
}
