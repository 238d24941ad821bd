//! Roadmaps in the verifier's terms.

use super::Verified;
use crate::record::Status;
use engine::geometry::{Frame, Solid, Vec3};
use engine::kinematics::Joints;
use engine::planner::{Counts, Ending, Plan, Request, Trace, Value};
use engine::space::cell::{EdgeEnd, LineRules, Lines, Path};
use engine::space::roadmap::{Local, Roadmap, joints};
use nalgebra::Matrix4;
use verify::{cell, joints as joint_space, plane};

/// The columns of every trial on a roadmap of an arm.
pub const ARM_COLUMNS: &[&str] = &["path_length_mm", "local_paths", "joint_travel_deg", "joint_peak_deg_s2"];

/// The columns of every trial on a roadmap in joint space.
pub const JOINT_COLUMNS: &[&str] = &["path_length_mm", "local_paths", "joint_travel_deg"];

/// The columns of every trial on a roadmap in the plane.
pub const PLANE_COLUMNS: &[&str] = &["path_length_mm", "local_paths"];

/// How far a claimed length may be from the recomputed one, relative.
const LENGTH_TOLERANCE: f64 = 1e-6;

/// A roadmap's robot and surroundings, as the verifier sees them.
#[derive(Debug)]
pub enum Case {
    /// An arm in its cell.
    Arm(Box<cell::Case>),
    /// A robot of any number of axes.
    Joints(Box<joint_space::Case>),
    /// A particle in the plane.
    Plane(plane::Case),
}

impl Case {
    /// The case of `roadmap`.
    pub fn new(roadmap: &Roadmap) -> Self {
        match roadmap.local() {
            Local::Arm(lines) => Self::Arm(Box::new(arm_case(lines))),
            Local::Joints(space) => {
                let robot = space.robot();
                let pairs = space.self_pairs();
                let case = joint_space::Case::new(robot, space.obstacles(), pairs, space.step_rad());
                Self::Joints(Box::new(case.expect("a family's solids enclose something")))
            }
            Local::Plane(map) => {
                let corners = |p: &engine::geometry::planar::ConvexPolygon| {
                    p.vertices().iter().map(|v| [v.x, v.y]).collect::<Vec<_>>()
                };
                let polygons: Vec<_> = map.polygons().iter().map(corners).collect();
                Self::Plane(plane::Case::new(&polygons).expect("a family's map is on the verifier's raster"))
            }
        }
    }

    /// Verifies `plan`, made for `request`.
    pub fn verify(&self, request: &Request<'_>, plan: &Plan) -> Verified {
        let mut values = Counts::new();
        let mut traces = Vec::new();
        let outcome = match plan.ending {
            Ending::Solved => {
                let measured = match self {
                    Self::Arm(case) => measure_arm(case, request, plan, &mut traces),
                    Self::Joints(case) => measure_joints(case, request, plan, &mut traces),
                    Self::Plane(case) => measure_plane(case, request, plan),
                };
                let is_straight = request.world.as_roadmap().is_none_or(|map| map.local().is_straight());
                let refused = |(found, straight_mm)| refuse_length(plan, found, straight_mm, is_straight);
                match measured.and_then(refused) {
                    Ok(found) => {
                        values = found;
                        (Status::Solved, None)
                    }
                    Err(refusal) => (Status::Rejected, Some(refusal)),
                }
            }
            _ => super::outcome(request, plan, None),
        };
        if !request.trace {
            traces.clear();
        }
        Verified { outcome, values, traces }
    }
}

/// Values with the length among them, and the straight line between the ends.
type Measured = Result<(Counts, f64), String>;

fn measure_plane(case: &plane::Case, request: &Request<'_>, plan: &Plan) -> Measured {
    let length_mm = case.length_mm(&plan.path, [request.start, request.goal])?;
    let straight_mm = libm::hypot(request.goal[0] - request.start[0], request.goal[1] - request.start[1]);
    Ok((counts(length_mm, plan), straight_mm))
}

fn measure_joints(
    case: &joint_space::Case,
    request: &Request<'_>,
    plan: &Plan,
    traces: &mut Vec<Trace>,
) -> Measured {
    let motion = case.motion(&plan.path, [request.start, request.goal])?;
    let mut values = counts(motion.length_m * 1e3, plan);
    values.insert("joint_travel_deg", Value::Real(motion.travel_rad.to_degrees()));
    // Beside the length that a planner measures in joint space; others measure their ways otherwise.
    if plan.counts.contains_key("initial_length_rad") {
        values.insert("joint_length_rad", Value::Real(motion.joint_length));
    }
    if request.trace {
        traces.push(Trace { name: "way_mm".to_owned(), width: 3, values: case.way_mm(&plan.path) });
    }
    Ok((values, case.straight_m(request.start, request.goal) * 1e3))
}

fn measure_arm(case: &cell::Case, request: &Request<'_>, plan: &Plan, traces: &mut Vec<Trace>) -> Measured {
    let angles = |config: &[f64]| joints(config).ok_or("a configuration without six angles");
    let path: Vec<Joints> = plan.path.iter().map(|config| angles(config)).collect::<Result<_, _>>()?;
    let (start, goal) = (angles(request.start)?, angles(request.goal)?);
    let motion = case.motion(&path, [&start, &goal])?;
    let mut values = counts(motion.length_m * 1e3, plan);
    values.insert("joint_travel_deg", Value::Real(motion.travel_rad.to_degrees()));
    values.insert("joint_peak_deg_s2", Value::Real(motion.peak_rad_s2.to_degrees()));
    if request.trace {
        let numbers = motion.stops.iter().flat_map(|stop| {
            let q_deg = stop.q.map(f64::to_degrees);
            let tool_mm = stop.tool_m.map(|x| x * 1e3);
            [stop.time_s].into_iter().chain(q_deg).chain(tool_mm)
        });
        traces.push(Trace { name: "trajectory".to_owned(), width: 10, values: numbers.collect() });
    }
    Ok((values, case.straight_m(&start, &goal) * 1e3))
}

fn counts(length_mm: f64, plan: &Plan) -> Counts {
    let legs = plan.path.len().saturating_sub(1) as u64;
    Counts::from([("path_length_mm", Value::Real(length_mm)), ("local_paths", Value::Count(legs))])
}

fn refuse_length(plan: &Plan, found: Counts, straight_mm: f64, is_straight: bool) -> Result<Counts, String> {
    let length_mm = found["path_length_mm"].as_f64();
    let near = |a: f64, b: f64| (a - b).abs() <= LENGTH_TOLERANCE * b.max(1.0);
    match plan.cost {
        Some(claimed) if !near(claimed, length_mm) => {
            return Err(format!("the claimed length is {claimed} mm, the path's {length_mm} mm"));
        }
        None if is_straight => return Err("a solved plan claims no length".to_owned()),
        _ => {}
    }
    if length_mm < straight_mm && !near(length_mm, straight_mm) {
        return Err(format!("the length {length_mm} mm is below the straight line {straight_mm} mm"));
    }
    Ok(found)
}

fn arm_case(lines: &Lines) -> cell::Case {
    let cell = lines.cell();
    let chain = cell.robot().arm().chain();
    let rows = chain.joints().map(|joint| cell::Row {
        alpha_rad: joint.alpha_rad,
        a_m: joint.a_m,
        d_m: joint.d_m,
        offset_rad: joint.offset_rad,
        limits_rad: [joint.lower_rad, joint.upper_rad],
        speed_rad_s: joint.speed_rad_s,
    });
    let part = |part: &engine::kinematics::robot::Part| cell::Part {
        link: part.link(),
        from_m: part.capsule().segment.a.into(),
        to_m: part.capsule().segment.b.into(),
        radius_m: part.capsule().radius,
        exposed: !part.is_self_only(),
    };
    let body = cell::Body {
        parts: cell.body().parts().iter().map(part).collect(),
        pairs: cell.self_pairs().to_vec(),
    };
    let shapes: Vec<cell::Shape> = cell.scene().obstacles().iter().map(|o| shape(&o.solid)).collect();
    let chain = cell::Chain::new(rows, matrix(chain.base()), matrix(chain.tool()));
    cell::Case::new(chain, body, &shapes, rules(lines.rules()))
}

fn rules(rules: &LineRules) -> cell::Rules {
    cell::Rules {
        straight_joints: rules.path == Path::Joints,
        step_m: rules.step_m,
        step_rad: rules.step_rad,
        jump_rad: rules.jump_rad,
        speed: rules.speed.map(|law| [law.speed_m_s, law.acceleration_m_s2]),
        end: match rules.end {
            EdgeEnd::Own => cell::LegEnd::Own,
            EdgeEnd::WholeTurns => cell::LegEnd::WholeTurns,
            EdgeEnd::PoseOnly => cell::LegEnd::PoseOnly,
        },
    }
}

fn shape(solid: &Solid) -> cell::Shape {
    let point = |p: &Vec3| -> [f64; 3] { (*p).into() };
    match solid {
        Solid::Sphere(s) => cell::Shape::Round(point(&s.center), point(&s.center), s.radius),
        Solid::Capsule(c) => cell::Shape::Round(point(&c.segment.a), point(&c.segment.b), c.radius),
        Solid::Box(b) => cell::Shape::Box(matrix(b.frame()), point(b.half())),
        Solid::Convex(c) => cell::Shape::Hull(c.vertices().iter().map(point).collect()),
        Solid::HalfSpace(h) => cell::Shape::Behind(point(h.normal()), -h.height(&Vec3::zeros())),
    }
}

fn matrix(frame: &Frame) -> Matrix4<f64> {
    let mut matrix = Matrix4::identity();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&frame.rotation);
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&frame.origin);
    matrix
}
