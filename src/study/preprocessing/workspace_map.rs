//! A planar arm's workspace, analysed point by point as the reproduced paper does before it plans.

use super::{Entry, Preprocessing};
use engine::geometry::Vec2;
use engine::geometry::planar::{Circle, ConvexPolygon};
use engine::planner::{Counts, Trace, Value};
use engine::space::{ArmWorld, Obstacle, World, Zone};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "workspace_map",
    about: "a planar arm's workspace: which tip positions are free, and why others are not",
    columns: &["free_cells", "outer_cells", "inner_cells", "obstacle_cells", "link_cells"],
};

/// The shape of an obstacle whose size is one number, its diameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShapeSetting {
    /// A disc.
    Circle,
    /// A square whose sides are as long as the diameter and parallel to the axes.
    Square,
    /// A square whose diagonals are as long as the diameter and whose sides are parallel to the axes.
    SquareInscribed,
    /// A regular hexagon with its corners on the circle of the diameter, two of them level with its centre.
    Hexagon,
    /// The hexagon turned so that two of its corners stand above each other.
    HexagonTurned,
    /// A regular triangle with its corners on the circle of the diameter, one of them on top.
    Triangle,
    /// The triangle turned so that one of its corners is at the bottom.
    TriangleTurned,
}

impl ShapeSetting {
    /// The four shapes, each standing as it is usually drawn.
    pub const ALL: [Self; 4] = [Self::Circle, Self::Square, Self::Hexagon, Self::Triangle];

    /// The obstacle of this shape about `center`.
    ///
    /// # Errors
    /// A sentence if a number is not finite or the diameter is not above 0.
    pub fn obstacle(self, center_cm: [f64; 2], diameter_cm: f64) -> Result<Obstacle, String> {
        let center = Vec2::from(center_cm);
        let radius = diameter_cm / 2.0;
        // Sizes are refused in one place, by the disc around the shape.
        let circle = Circle::new(center, radius).map_err(|e| e.to_string())?;
        let regular = |sides, turn_rad| ConvexPolygon::regular(center, radius, sides, turn_rad);
        let polygon = match self {
            Self::Circle => return Ok(Obstacle::Circle(circle)),
            Self::Square => {
                let half = Vec2::new(radius, radius);
                ConvexPolygon::rectangle(center - half, center + half)
            }
            Self::SquareInscribed => regular(4, PI / 4.0),
            Self::Hexagon => regular(6, 0.0),
            Self::HexagonTurned => regular(6, PI / 2.0),
            Self::Triangle => regular(3, PI / 2.0),
            Self::TriangleTurned => regular(3, -PI / 2.0),
        };
        polygon.map(Obstacle::Polygon).map_err(|e| e.to_string())
    }
}

/// The analysed `world`; with `branches_at`, also both postures that reach this point.
pub fn prepare(world: ArmWorld, branches_at: Option<[f64; 2]>) -> Preprocessing {
    let counted = |zone: Zone| {
        let count = world.zones().iter().filter(|found| **found == zone).count();
        Value::Count(count as u64)
    };
    let values = Counts::from([
        ("free_cells", counted(Zone::Free)),
        ("outer_cells", counted(Zone::OuterReach)),
        ("inner_cells", counted(Zone::InnerReach)),
        ("obstacle_cells", counted(Zone::Obstacle)),
        ("link_cells", counted(Zone::Link)),
    ]);
    let mut traces = vec![lattice(&world), zones(&world)];
    traces.extend(world.obstacles().iter().enumerate().map(|(index, obstacle)| Trace {
        name: format!("obstacle_{}", index + 1),
        width: 2,
        values: obstacle.outline().concat(),
    }));
    traces.extend(branches_at.and_then(|target| branches(&world, target)));
    Preprocessing { world: World::Arm(world), values, traces }
}

/// Lower left point, step, columns and rows.
fn lattice(world: &ArmWorld) -> Trace {
    let lattice = world.rules().lattice;
    let [x, y] = lattice.low_cm();
    let [columns, rows] = lattice.size().map(f64::from);
    Trace { name: "lattice".to_owned(), width: 5, values: vec![x, y, lattice.step_cm(), columns, rows] }
}

/// One number a point, row by row: 0 free, 1 out of reach, 2 too near, 3 in an obstacle, 4 a link hits one.
fn zones(world: &ArmWorld) -> Trace {
    let code = |zone: &Zone| match zone {
        Zone::Free => 0.0,
        Zone::OuterReach => 1.0,
        Zone::InnerReach => 2.0,
        Zone::Obstacle => 3.0,
        Zone::Link => 4.0,
    };
    Trace { name: "zones".to_owned(), width: 1, values: world.zones().iter().map(code).collect() }
}

/// Both postures at `target`, θ2 negative first: joint angles in degrees, elbow, tip.
fn branches(world: &ArmWorld, target: [f64; 2]) -> Option<Trace> {
    let arm = world.rules().arm;
    let both = arm.inverse(&target.into()).ok()?;
    let station = |posture: [f64; 2]| {
        let elbow = arm.elbow(posture);
        let tip = arm.forward(posture);
        [posture[0].to_degrees(), posture[1].to_degrees(), elbow.x, elbow.y, tip.x, tip.y]
    };
    let values = [both.negative, both.positive].into_iter().flat_map(station).collect();
    Some(Trace { name: "branches".to_owned(), width: 6, values })
}
