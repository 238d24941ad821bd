//! The engine's worlds as data.

use super::world::{
    Cell, Elbow, Grid, Joint, Motion, Part, PlanarArm, Plane, Polyhedra, Polyhedron, Pose, Shape, Solid,
    Straight, World,
};
use base::grid::Vertices;
use engine::geometry::planar::Touch;
use engine::geometry::{Frame, Solid as EngineSolid, Vec3};
use engine::kinematics::planar_2r::ElbowRule;
use engine::space::cell::{Lines, Path};
use engine::space::roadmap::{Local, PlaneMap, RASTER_MM};
use engine::space::{ArmWorld, HopRule, LatticeWorld, Obstacle, PolyhedraWorld, World as EngineWorld};

/// `world` as data; on a grid, whether steps may go at any angle is the caller's word.
///
/// # Errors
/// A sentence if the protocol has no such world.
pub fn describe(world: &EngineWorld, any_angle: bool) -> Result<World, String> {
    Ok(match world {
        EngineWorld::Lattice(lattice) => World::Grid(grid(lattice, any_angle)),
        EngineWorld::Arm(arm) => World::PlanarArm(planar_arm(arm)),
        EngineWorld::Polyhedra(polyhedra) => World::Polyhedra(among(polyhedra)),
        EngineWorld::Roadmap(roadmap) => match roadmap.local() {
            Local::Arm(lines) => World::Cell(Box::new(cell(lines))),
            Local::Plane(map) => World::Plane(plane(map)),
            Local::Joints(_) => {
                return Err("the protocol has no world of robots that are not six-axis arms".to_owned());
            }
        },
    })
}

fn grid(lattice: &LatticeWorld, any_angle: bool) -> Grid {
    let grid = lattice.cells();
    let cell = |x, y| if grid.is_free_xy(x, y) { '.' } else { '@' };
    let row = |y: i32| (0..grid.width() as i32).map(|x| cell(x, y)).collect();
    Grid {
        size: [grid.width(), grid.height()],
        rows: (0..grid.height() as i32).map(row).collect(),
        corners: lattice.corner_rule(),
        any_angle,
        vertices: lattice.cornered().map(|_| Vertices::Corners),
    }
}

fn planar_arm(world: &ArmWorld) -> PlanarArm {
    let rules = world.rules();
    let shape = |obstacle: &Obstacle| match obstacle {
        Obstacle::Circle(circle) => Shape::Circle { center: circle.center.into(), radius: circle.radius },
        Obstacle::Polygon(polygon) => {
            Shape::Polygon { corners: polygon.vertices().iter().map(|corner| (*corner).into()).collect() }
        }
    };
    PlanarArm {
        links_cm: rules.arm.links(),
        elbow: match rules.elbow {
            ElbowRule::NegativeQ2 => Elbow::NegativeQ2,
            ElbowRule::HigherElbow => Elbow::Higher,
        },
        low_cm: rules.lattice.low_cm(),
        step_cm: rules.lattice.step_cm(),
        size: rules.lattice.size(),
        inner_radius_cm: rules.inner_radius_cm,
        touching_collides: rules.touch == Touch::Contact,
        corners: rules.corner_rule,
        swept: rules.hop == HopRule::Continuous,
        obstacles: world.obstacles().iter().map(shape).collect(),
    }
}

fn among(world: &PolyhedraWorld) -> Polyhedra {
    let polyhedron = |convex: &engine::geometry::Convex| Polyhedron {
        corners_cm: convex.vertices().iter().map(|corner| (*corner).into()).collect(),
        faces: convex.faces().iter().map(|face| plane_of(&face.plane)).collect(),
    };
    Polyhedra {
        low_cm: world.domain().min.into(),
        high_cm: world.domain().max.into(),
        step_cm: world.step(),
        obstacles: world.obstacles().iter().map(polyhedron).collect(),
    }
}

fn plane_of(plane: &engine::geometry::Plane) -> [f64; 4] {
    [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset]
}

fn plane(map: &PlaneMap) -> Plane {
    let polygon = |p: &engine::geometry::planar::ConvexPolygon| {
        p.vertices().iter().map(|corner| (*corner).into()).collect()
    };
    Plane {
        size_mm: map.size_mm(),
        raster_mm: RASTER_MM,
        obstacles: map.polygons().iter().map(polygon).collect(),
    }
}

fn cell(lines: &Lines) -> Cell {
    let cell = lines.cell();
    let rules = lines.rules();
    let chain = cell.robot().arm().chain();
    let joint = |joint: &engine::kinematics::Joint| Joint {
        alpha_rad: joint.alpha_rad,
        a_m: joint.a_m,
        d_m: joint.d_m,
        offset_rad: joint.offset_rad,
        lower_rad: joint.range_rad()[0],
        upper_rad: joint.range_rad()[1],
        is_endless: joint.is_endless(),
        speed_rad_s: joint.speed_rad_s,
    };
    let part = |part: &engine::kinematics::robot::Part| Part {
        link: part.link(),
        from_m: part.capsule().segment.a.into(),
        to_m: part.capsule().segment.b.into(),
        radius_m: part.capsule().radius,
        exposed: !part.is_self_only(),
    };
    Cell {
        joints: chain.joints().iter().map(joint).collect(),
        base: pose(chain.base(), 1.0),
        tool: pose(chain.tool(), 1.0),
        parts: cell.body().parts().iter().map(part).collect(),
        self_pairs: cell.self_pairs().to_vec(),
        obstacles: cell.scene().obstacles().iter().map(|obstacle| solid(&obstacle.solid)).collect(),
        motion: Motion {
            straight: if rules.path == Path::Joints { Straight::Joints } else { Straight::Tool },
            step_m: rules.step_m,
            step_rad: rules.step_rad,
            jump_rad: rules.jump_rad,
            turn_rad: rules.turn_rad,
            speed: rules.speed.map(|law| [law.speed_m_s, law.acceleration_m_s2]),
        },
    }
}

/// `frame` with its origin in units, `scale` to the metre.
pub(super) fn pose(frame: &Frame, scale: f64) -> Pose {
    let row = |i: usize| [0, 1, 2].map(|j| frame.rotation[(i, j)]);
    Pose { position: (frame.origin * scale).iter().copied().collect(), rotation: Some([0, 1, 2].map(row)) }
}

fn solid(solid: &EngineSolid) -> Solid {
    let point = |p: &Vec3| -> [f64; 3] { (*p).into() };
    match solid {
        EngineSolid::Sphere(s) => {
            Solid::Capsule { from_m: point(&s.center), to_m: point(&s.center), radius_m: s.radius }
        }
        EngineSolid::Capsule(c) => {
            Solid::Capsule { from_m: point(&c.segment.a), to_m: point(&c.segment.b), radius_m: c.radius }
        }
        EngineSolid::Box(b) => Solid::Box { pose: pose(b.frame(), 1.0), half_m: point(b.half()) },
        EngineSolid::Convex(c) => Solid::Convex { corners_m: c.vertices().iter().map(point).collect() },
        EngineSolid::HalfSpace(h) => {
            Solid::HalfSpace { normal: point(h.normal()), offset_m: -h.height(&Vec3::zeros()) }
        }
    }
}
