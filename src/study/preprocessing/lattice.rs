//! A map turned into a lattice of moves, with measures of the map.

use super::{Entry, Preprocessing};
use base::grid::{CornerRule, Grid2, Vertices, components};
use base::settings::{Settings, SettingsError};
use engine::planner::{Counts, Invalid, Trace, Value};
use engine::space::{LatticeWorld, World, WorldKind};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "lattice",
    about: "a map, the moves its corner rule leaves, and its connected components",
    columns: &["free_cells", "components", "octile_distance_cells", "tries"],
};

/// The lattice on `cells`.
pub fn world(cells: Grid2, corners: CornerRule, vertices: Vertices) -> LatticeWorld {
    match vertices {
        Vertices::Centres => LatticeWorld::new(cells, corners),
        Vertices::Corners => LatticeWorld::of_corners(cells),
    }
}

/// The kind of such a world.
pub fn kind(vertices: Vertices) -> WorldKind {
    match vertices {
        Vertices::Centres => WorldKind::Lattice,
        Vertices::Corners => WorldKind::CornerLattice,
    }
}

/// Refuses a corner rule that lattices with these vertices do not have.
///
/// # Errors
/// Vertices at corners of cells, and a rule that forbids to pass some of them.
pub fn check_rule(settings: &Settings, corners: CornerRule, vertices: Vertices) -> Result<(), SettingsError> {
    if vertices == Vertices::Centres || corners == CornerRule::Allow {
        return Ok(());
    }
    let message = "with vertices = \"corners\", paths may pass between two blocked cells that touch at a corner, and corner_rule = \
                   \"allow\" is accepted";
    Err(settings.error_at("corner_rule", message))
}

/// The lattice `world`, for queries from a start to a goal ([x, y] in cells); of a single one the octile distance is noted.
///
/// # Errors
/// [`Invalid`] if a start or goal is outside or blocked.
pub fn prepare<'q>(
    world: LatticeWorld,
    queries: impl ExactSizeIterator<Item = [&'q [f64]; 2]>,
) -> Result<Preprocessing, Invalid> {
    let mut preprocessing = prepare_map(world);
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

/// The lattice `world`, for any number of queries.
pub fn prepare_map(world: LatticeWorld) -> Preprocessing {
    let parts = components(world.grid(), world.moves()).sizes().len();
    let values = Counts::from([
        ("free_cells", Value::Count(u64::from(world.cells().free_count()))),
        ("components", Value::Count(parts as u64)),
    ]);
    let traces = vec![size(world.grid()), blocked(&world)];
    Preprocessing { world: World::Lattice(world), values, traces }
}

fn size(grid: &Grid2) -> Trace {
    let values = vec![f64::from(grid.width()), f64::from(grid.height())];
    Trace { name: "size_cells".to_owned(), width: 2, values }
}

/// The middle of each blocked cell; where vertices are corners of cells, it lies between four of them.
fn blocked(world: &LatticeWorld) -> Trace {
    let shift = if world.vertices() == Vertices::Corners { 0.5 } else { 0.0 };
    let values = world.cells().blocked_xy().into_iter().map(|value| value + shift).collect();
    Trace { name: "blocked".to_owned(), width: 2, values }
}
