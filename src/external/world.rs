//! Worlds as data, so complete that a planner can rebuild the collision check. A world's units are in its fields' names.

use base::grid::{CornerRule, Vertices};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The kinds of world, as `hello` names them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Square cells, some of them blocked.
    Grid,
    /// A planar arm of two links whose tip moves over a lattice.
    PlanarArm,
    /// A six-axis arm in its cell.
    Cell,
    /// A point among convex polyhedra.
    Polyhedra,
    /// A particle in the plane.
    Plane,
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Grid => "grid",
            Self::PlanarArm => "planar_arm",
            Self::Cell => "cell",
            Self::Polyhedra => "polyhedra",
            Self::Plane => "plane",
        })
    }
}

/// What is planned in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum World {
    /// Square cells; a configuration is the centre of a cell, `[column, row]`, and a path is a list of them.
    Grid(Grid),
    /// A planar arm; a configuration is a lattice point where the tip stands, `[x, y]` in centimetres.
    PlanarArm(PlanarArm),
    /// A six-axis arm; a configuration is its six joint angles in radians.
    Cell(Box<Cell>),
    /// A point in space; a configuration is `[x, y, z]` in centimetres.
    Polyhedra(Polyhedra),
    /// A particle in the plane; a configuration is `[x, y]` in millimetres.
    Plane(Plane),
}

impl World {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Grid(_) => Kind::Grid,
            Self::PlanarArm(_) => Kind::PlanarArm,
            Self::Cell(_) => Kind::Cell,
            Self::Polyhedra(_) => Kind::Polyhedra,
            Self::Plane(_) => Kind::Plane,
        }
    }
}

/// Square cells. A path's cost is its length, the side of a cell being 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Grid {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Row 0 first, a character a cell: `.` is free and `@` blocked.
    pub rows: Vec<String>,
    /// Which diagonal steps are refused for the two cells that flank them.
    pub corners: CornerRule,
    /// Whether a step may join any two cells: it must then not cross the inside of a blocked cell, and where it runs through
    /// the corner of cells the rule of corners holds. Otherwise a step leads to one of the eight neighbours.
    pub any_angle: bool,
    /// Where configurations are: at the `centres` of cells, where the field is absent, or at their `corners`. Corner `[column, row]` is
    /// the one before both of the cell of that column and row, and there is one more of each than there are cells. A step may then run
    /// along edges of blocked cells, but not between two that share an edge; it may pass between two that touch at a corner.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vertices: Option<Vertices>,
}

/// A planar arm with its base at the origin, `q1` measured from +x and `q2` from the first link, both counter-clockwise. A
/// path's cost is the length of the tip's polyline in centimetres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlanarArm {
    /// The two links, without width.
    pub links_cm: [f64; 2],
    /// Which of two postures the arm takes.
    pub elbow: Elbow,
    /// The lower left point of the tip's lattice.
    pub low_cm: [f64; 2],
    /// How far its points are apart.
    pub step_cm: f64,
    /// Its columns and rows.
    pub size: [u32; 2],
    /// Points nearer to the base than this are forbidden.
    pub inner_radius_cm: f64,
    /// Whether touching an obstacle is a collision.
    pub touching_collides: bool,
    /// Which diagonal steps to a next lattice point are refused for the two points that flank them.
    pub corners: CornerRule,
    /// Whether both links are swept between two points, the joints moving evenly; otherwise the end points alone count.
    pub swept: bool,
    /// What must not be touched by tip and links.
    pub obstacles: Vec<Shape>,
}

/// Which posture a planar arm takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Elbow {
    /// That with `q2` ≤ 0.
    NegativeQ2,
    /// That whose elbow has the greater y; the one with `q2` ≤ 0 if both are equally high.
    Higher,
}

/// An obstacle in the plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case")]
pub enum Shape {
    /// A disc.
    Circle {
        /// Its centre.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
    },
    /// A convex polygon.
    Polygon {
        /// Its corners, counter-clockwise.
        corners: Vec<[f64; 2]>,
    },
}

/// A six-axis arm in its cell. A path's cost is the way of the tool's tip in millimetres; touching is a collision.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cell {
    /// The joints by standard Denavit–Hartenberg rows, base first: turn by `q + offset` about z, move by `d` along z, move by `a`
    /// along x, turn by `alpha` about x.
    pub joints: Vec<Joint>,
    /// The base in the world.
    pub base: Pose,
    /// The tool in the flange, the frame of the last joint.
    pub tool: Pose,
    /// The capsules that stand for the arm.
    pub parts: Vec<Part>,
    /// Pairs of parts, by their places in the list, that must not touch.
    pub self_pairs: Vec<[usize; 2]>,
    /// What the exposed parts must not touch.
    pub obstacles: Vec<Solid>,
    /// What joins two configurations of a path.
    pub motion: Motion,
}

/// A joint and the link that it moves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Joint {
    /// Twist about x.
    pub alpha_rad: f64,
    /// Length along x.
    pub a_m: f64,
    /// Offset along z.
    pub d_m: f64,
    /// Added to the joint angle.
    pub offset_rad: f64,
    /// The least angle.
    pub lower_rad: f64,
    /// The greatest angle.
    pub upper_rad: f64,
    /// Whether it turns without end: the limits are then half a turn to either side, and angles that whole turns part are one.
    #[serde(default, rename = "endless")]
    pub is_endless: bool,
    /// The greatest speed.
    pub speed_rad_s: f64,
}

/// A pose: where an origin is and, row by row, what turns its axes into those of the frame that it is given in. Lengths are in
/// the unit of the configurations' world: metres in a cell, centimetres elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Pose {
    /// The origin.
    pub position: Vec<f64>,
    /// The rotation matrix, row by row; absent in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[[f64; 3]; 3]>,
}

/// A capsule of the arm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Part {
    /// The link that it is fixed to: 0 is the base, `i` the link that joint `i` moves.
    pub link: usize,
    /// One end of its axis, in the frame of the link.
    pub from_m: [f64; 3],
    /// The other end.
    pub to_m: [f64; 3],
    /// Its radius.
    pub radius_m: f64,
    /// Whether it must keep clear of the obstacles; others keep clear of parts alone.
    pub exposed: bool,
}

/// A solid that does not move.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case")]
pub enum Solid {
    /// All within `radius_m` of the segment between two points; a ball if they are one.
    Capsule {
        /// One end of the axis.
        from_m: [f64; 3],
        /// The other end.
        to_m: [f64; 3],
        /// The radius.
        radius_m: f64,
    },
    /// A box in any orientation.
    Box {
        /// Its middle and axes.
        pose: Pose,
        /// Half its sides.
        half_m: [f64; 3],
    },
    /// A convex polyhedron.
    Convex {
        /// Its corners.
        corners_m: Vec<[f64; 3]>,
    },
    /// All points `x` with `normal · x <= offset_m`.
    HalfSpace {
        /// The outward normal, of length 1.
        normal: [f64; 3],
        /// How far the face is from the origin along it.
        offset_m: f64,
    },
}

/// What joins two configurations of an arm's path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Motion {
    /// What goes straight.
    pub straight: Straight,
    /// The longest step of the tool between two configurations that are checked, if the tool goes straight.
    pub step_m: f64,
    /// The longest step of its orientation; of any joint, if joints go straight.
    pub step_rad: f64,
    /// The most that a joint may change in one step of the tool.
    pub jump_rad: f64,
    /// The most that the tool may turn between two configurations of a path, if it goes straight.
    pub turn_rad: f64,
    /// The tool's greatest speed (m/s) and acceleration (m/s²) under which joint speeds are checked, if they are.
    pub speed: Option<[f64; 2]>,
}

/// What goes straight between two configurations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Straight {
    /// The tool, which turns about one axis; the joints follow by inverse kinematics on the branch in hand.
    Tool,
    /// The joints.
    Joints,
}

/// A point among convex polyhedra. A path's cost is its length in centimetres. Obstacles are closed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Polyhedra {
    /// The least corner of where the point may be.
    pub low_cm: [f64; 3],
    /// The greatest corner.
    pub high_cm: [f64; 3],
    /// The spacing of the lattice on which our own planners search it.
    pub step_cm: f64,
    /// What the point must not touch.
    pub obstacles: Vec<Polyhedron>,
}

/// A convex polyhedron.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Polyhedron {
    /// Its corners.
    pub corners_cm: Vec<[f64; 3]>,
    /// Its faces, `[nx, ny, nz, d]`: inside is where `n · x <= d` for all of them.
    pub faces: Vec<[f64; 4]>,
}

/// A particle among convex polygons. A path's cost is its length in millimetres; touching is a collision.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Plane {
    /// Width and height of the rectangle, with a corner at the origin, that the particle keeps to.
    pub size_mm: [f64; 2],
    /// Coordinates of configurations are whole multiples of this, so that contact is decided exactly.
    pub raster_mm: f64,
    /// What it must not touch: corners, counter-clockwise.
    pub obstacles: Vec<Vec<[f64; 2]>>,
}
