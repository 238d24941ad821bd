//! A scene of polyhedra with its rasterised lattice.

use super::{Entry, Preprocessing};
use engine::geometry::Convex;
use engine::planner::{Counts, Trace, Value};
use engine::space::{PolyhedraWorld, World};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "polyhedra",
    about: "convex polyhedra, the cubic lattice among them rasterised, and the arm if there is one",
    columns: &["obstacles", "free_nodes"],
};

/// `world` with what it is like.
pub fn prepare(world: PolyhedraWorld) -> Preprocessing {
    let values = Counts::from([
        ("obstacles", Value::Count(world.obstacles().len() as u64)),
        ("free_nodes", Value::Count(world.grid().free_count())),
    ]);
    let [low, high] = [world.domain().min, world.domain().max];
    let domain = [low, high].iter().flat_map(|corner| corner.as_slice().to_vec()).collect();
    let mut traces = vec![Trace { name: "domain".to_owned(), width: 3, values: domain }];
    traces.extend(solids("bodies", world.bodies()));
    traces.extend(floor(&world));
    traces.extend(pedestal(&world));
    Preprocessing { world: World::Polyhedra(Box::new(world)), values, traces }
}

/// The part of the floor under the bodies and the arm's base, as a rectangle in order around it.
fn floor(world: &PolyhedraWorld) -> Option<Trace> {
    let arm = world.arm()?;
    let height = arm.floor_cm()?;
    let base = arm.arm().chain().base().origin * 100.0;
    let all = world.bodies().iter().flat_map(|body| [body.aabb().min, body.aabb().max]).chain([base]);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for corner in all {
        for axis in 0..2 {
            low[axis] = low[axis].min(corner[axis] - FLOOR_CM);
            high[axis] = high[axis].max(corner[axis] + FLOOR_CM);
        }
    }
    let corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
    let values = corners.iter().flat_map(|[x, y]| [*x, *y, height]).collect();
    Some(Trace { name: "floor".to_owned(), width: 3, values })
}

/// The number of the body that the arm's base stands on.
fn pedestal(world: &PolyhedraWorld) -> Option<Trace> {
    let block = world.arm()?.has_pedestal().then(|| world.bodies().len() - 1)?;
    Some(Trace { name: "pedestal".to_owned(), width: 1, values: vec![block as f64] })
}

/// How far the floor is drawn beyond what stands on it.
const FLOOR_CM: f64 = 20.0;

/// Vertices, and the numbers of the vertices of each face: (face, vertex) in order around it, counted through.
fn solids(name: &str, solids: &[Convex]) -> [Trace; 2] {
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    let mut face_count = 0;
    for solid in solids {
        let first = vertices.len() / 3;
        vertices.extend(solid.vertices().iter().flat_map(|v| v.as_slice().to_vec()));
        for face in solid.faces() {
            faces.extend(face.corners.iter().flat_map(|v| [f64::from(face_count), (first + v) as f64]));
            face_count += 1;
        }
    }
    let trace = |suffix: &str, width, values| Trace { name: format!("{name}_{suffix}"), width, values };
    [trace("vertices", 3, vertices), trace("faces", 2, faces)]
}
