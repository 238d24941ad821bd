//! Judges paths of a robot of any number of joints that turn or slide among convex solids, straight in joint space.
//!
//! Everything is worked out again by other means than planners use: forward kinematics by products of 4 × 4 matrices of quaternions'
//! rotations, contact by parry3d with true cylinders, at a quarter of the planner's step. Lengths are metres and angles radians; what
//! counts steps takes a metre of a slide for a radian. Joints that turn without end have no limits and go the shorter way round.

use base::robot::{Joint, Kind, Robot};
use base::solid::{Form, Pose as Place, Solid};
use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector3, Vector4};
use parry3d::bounding_volume::{BoundingSphere, BoundingVolume as _};
use parry3d::math::{Matrix, Pose, Rotation, Vector};
use parry3d::query;
use parry3d::shape::{Ball, ConvexPolyhedron, Cuboid, Cylinder, SharedShape};
use std::f64::consts::TAU;

/// How many steps of ours make one of the planner's.
const FINER: f64 = 4.0;

/// Into how many pieces a leg is cut where it is only shown.
const SEEN: u32 = 24;

/// How far from a limit rounding may take a joint, radians or metres.
const LIMIT: f64 = 1e-9;

/// A robot among obstacles.
pub struct Case {
    robot: Robot,
    parts: Vec<(Matrix4<f64>, Shape)>,
    stills: Vec<Placed>,
    pairs: Vec<[usize; 2]>,
    step_rad: f64,
}

/// A shape and a ball about it.
struct Shape {
    shape: SharedShape,
    ball: BoundingSphere,
}

/// A shape where it is, and the ball about it there.
struct Placed {
    at: Pose,
    shape: SharedShape,
    ball: BoundingSphere,
}

impl Shape {
    fn new(shape: SharedShape) -> Self {
        Self { ball: shape.compute_local_bounding_sphere(), shape }
    }

    fn placed(&self, at: Pose) -> Placed {
        Placed { at, shape: self.shape.clone(), ball: self.ball.transform_by(&at) }
    }
}

impl Placed {
    /// Whether two shapes touch. Those whose balls are apart do not.
    fn touches(&self, other: &Self) -> bool {
        self.ball.intersects(&other.ball)
            && query::intersection_test(&self.at, &*self.shape, &other.at, &*other.shape)
                .expect("parry knows these shapes")
                .intersecting
    }
}

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} among {} obstacles", self.robot.name, self.stills.len())
    }
}

/// What the motion along a path amounts to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// The way of the tip.
    pub length_m: f64,
    /// The sum of the changes of all joints that turn.
    pub travel_rad: f64,
    /// The sum over the legs of the root of the sum of squares of all changes.
    pub joint_length: f64,
}

impl Case {
    /// The case of a robot among obstacles, with the pairs of solids that must stay apart.
    ///
    /// # Errors
    /// If points enclose nothing.
    pub fn new(
        robot: &Robot,
        obstacles: &[Solid],
        pairs: &[[usize; 2]],
        step_rad: f64,
    ) -> Result<Self, String> {
        let parts = robot
            .solids
            .iter()
            .map(|(_, solid)| Ok((matrix(&solid.pose) * about(&solid.form), Shape::new(shape(solid)?))));
        let stills = obstacles.iter().map(|solid| {
            Ok(Shape::new(shape(solid)?).placed(pose(&(matrix(&solid.pose) * about(&solid.form)))))
        });
        Ok(Self {
            robot: robot.clone(),
            parts: parts.collect::<Result<_, String>>()?,
            stills: stills.collect::<Result<_, String>>()?,
            pairs: pairs.to_vec(),
            step_rad: step_rad / FINER,
        })
    }

    /// The motion along `path`, which must go from `start` to `goal` and touch nothing.
    ///
    /// # Errors
    /// Why the path cannot be executed as claimed.
    pub fn motion(&self, path: &[Vec<f64>], [start, goal]: [&[f64]; 2]) -> Result<Motion, String> {
        let count = self.robot.joints.len();
        if path.iter().any(|q| q.len() != count || q.iter().any(|angle| !angle.is_finite())) {
            return Err(format!("a configuration is not made of {count} numbers"));
        }
        if path.first().map(Vec::as_slice) != Some(start) || path.last().map(Vec::as_slice) != Some(goal) {
            return Err("the path does not go from start to goal".to_owned());
        }
        self.refusal(&path[0]).map_or(Ok(()), |refusal| Err(format!("at the start, {refusal}")))?;
        let mut motion = Motion { length_m: 0.0, travel_rad: 0.0, joint_length: 0.0 };
        for (index, leg) in path.windows(2).enumerate() {
            let to = self.reached(leg);
            let change = leg[0].iter().zip(&to).map(|(a, b)| (b - a).abs());
            let turns =
                change.clone().zip(&self.robot.joints).filter(|(_, joint)| joint.kind != Kind::Slides);
            motion.travel_rad += turns.map(|(by, _)| by).sum::<f64>();
            motion.joint_length += change.clone().map(|by| by * by).sum::<f64>().sqrt();
            let steps = (change.fold(0.0, f64::max) / self.step_rad).ceil().max(1.0) as u32;
            let mut at = self.tip(&leg[0]);
            for step in 1..=steps {
                let share = f64::from(step) / f64::from(steps);
                let q = between(&leg[0], &to, share);
                if let Some(refusal) = self.refusal(&q) {
                    return Err(format!("leg {}: {refusal}", index + 1));
                }
                let next = self.tip(&q);
                motion.length_m += (next - at).norm();
                at = next;
            }
        }
        Ok(motion)
    }

    /// The tip's places along `path`, 25 a leg, one after another, millimetres.
    pub fn way_mm(&self, path: &[Vec<f64>]) -> Vec<f64> {
        let legs = path.windows(2).flat_map(|leg| {
            let to = self.reached(leg);
            (0..=SEEN)
                .map(move |step| self.tip(&between(&leg[0], &to, f64::from(step) / f64::from(SEEN))) * 1e3)
        });
        legs.flat_map(|at| [at.x, at.y, at.z]).collect()
    }

    /// Where a leg ends, counted on from its start: what turns without end is half a turn away at most.
    fn reached(&self, leg: &[Vec<f64>]) -> Vec<f64> {
        let to = |(joint, (a, b)): (&Joint, (&f64, &f64))| match joint.kind {
            Kind::TurnsOn => a + libm::remainder(b - a, TAU),
            Kind::Turns | Kind::Slides => *b,
        };
        self.robot.joints.iter().zip(leg[0].iter().zip(&leg[1])).map(to).collect()
    }

    /// The straight distance between the tip's places in two configurations.
    pub fn straight_m(&self, a: &[f64], b: &[f64]) -> f64 {
        (self.tip(a) - self.tip(b)).norm()
    }

    /// Base and links in the world.
    pub fn frames(&self, q: &[f64]) -> Vec<Matrix4<f64>> {
        let mut frames = vec![Matrix4::identity()];
        for (joint, value) in self.robot.joints.iter().zip(q) {
            let moved = if joint.kind == Kind::Slides {
                Matrix4::new_translation(&(Vector3::from(joint.axis) * *value))
            } else {
                let (s, c) = libm::sincos(0.5 * value);
                let [x, y, z] = joint.axis.map(|part| part * s);
                UnitQuaternion::new_unchecked(Quaternion::new(c, x, y, z)).to_homogeneous()
            };
            let last = frames[frames.len() - 1];
            frames.push(last * matrix(&joint.before) * moved);
        }
        frames
    }

    fn tip(&self, q: &[f64]) -> Vector3<f64> {
        let frames = self.frames(q);
        let tip = Vector3::from(self.robot.tip.origin_m);
        (frames[frames.len() - 1] * Vector4::new(tip.x, tip.y, tip.z, 1.0)).xyz()
    }

    /// What is wrong with the robot at `q`.
    fn refusal(&self, q: &[f64]) -> Option<String> {
        let outside = self.robot.joints.iter().zip(q).position(|(joint, value)| {
            let [lower, upper] = joint.limits;
            joint.kind != Kind::TurnsOn && !(lower - LIMIT..=upper + LIMIT).contains(value)
        });
        if let Some(joint) = outside {
            let unit = if self.robot.joints[joint].kind == Kind::Slides { "m" } else { "rad" };
            return Some(format!("joint {} is outside its limits at {:.4} {unit}", joint + 1, q[joint]));
        }
        let frames = self.frames(q);
        let links = self.robot.solids.iter().map(|(link, _)| *link);
        let place =
            |(link, (at, shape)): (usize, &(Matrix4<f64>, Shape))| shape.placed(pose(&(frames[link] * at)));
        let placed: Vec<Placed> = links.clone().zip(&self.parts).map(place).collect();
        for (part, _) in links.enumerate().filter(|(_, link)| *link > 0) {
            if let Some(hit) = self.stills.iter().position(|still| placed[part].touches(still)) {
                return Some(format!("part {} touches obstacle {}", part + 1, hit + 1));
            }
        }
        let pair = self.pairs.iter().find(|[a, b]| placed[*a].touches(&placed[*b]))?;
        Some(format!("part {} touches part {}", pair[0] + 1, pair[1] + 1))
    }
}

/// The configuration at `share` of the way from one to another.
fn between(from: &[f64], to: &[f64], share: f64) -> Vec<f64> {
    from.iter().zip(to).map(|(a, b)| a * (1.0 - share) + b * share).collect()
}

fn matrix(place: &Place) -> Matrix4<f64> {
    let ([x, y, z], o) = (place.rotation, place.origin_m);
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        x[0], x[1], x[2], o[0],
        y[0], y[1], y[2], o[1],
        z[0], z[1], z[2], o[2],
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

/// From the frame in which parry has a shape to that of the file: parry's cylinders are about y, the file's about z.
fn about(form: &Form) -> Matrix4<f64> {
    match form {
        Form::Cylinder(..) => {
            Matrix4::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        }
        _ => Matrix4::identity(),
    }
}

fn shape(solid: &Solid) -> Result<SharedShape, String> {
    Ok(match &solid.form {
        Form::Box(half) => SharedShape::new(Cuboid::new(Vector::new(half[0], half[1], half[2]))),
        Form::Cylinder(radius, length) => SharedShape::new(Cylinder::new(0.5 * length, *radius)),
        Form::Sphere(radius) => SharedShape::new(Ball::new(*radius)),
        Form::Hull(points) => {
            let points: Vec<Vector> = points.iter().map(|p| Vector::new(p[0], p[1], p[2])).collect();
            let hull = ConvexPolyhedron::from_convex_hull(&points);
            SharedShape::new(hull.ok_or_else(|| format!("the points of `{}` enclose nothing", solid.name))?)
        }
    })
}

fn pose(frame: &Matrix4<f64>) -> Pose {
    let column = |i| Vector::new(frame[(0, i)], frame[(1, i)], frame[(2, i)]);
    let turned = Rotation::from_mat3(&Matrix::from_cols(column(0), column(1), column(2)));
    Pose::from_parts(column(3), turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(x: f64, z: f64) -> Place {
        Place { origin_m: [x, 0.0, z], ..Place::IDENTITY }
    }

    /// A rod of 1 m that nods about y at the origin, up at 0 and along x at a right angle.
    fn rod() -> Robot {
        let joint = Joint {
            name: "nod".to_owned(),
            before: Place::IDENTITY,
            axis: [0.0, 1.0, 0.0],
            kind: Kind::Turns,
            limits: [-2.0, 2.0],
            speed: Some(1.0),
        };
        let solid = Solid { name: "rod".to_owned(), pose: place(0.0, 0.5), form: Form::Cylinder(0.05, 1.0) };
        Robot {
            name: "rod".to_owned(),
            base: "base".to_owned(),
            joints: vec![joint],
            solids: vec![(1, solid)],
            owners: vec!["rod".to_owned()],
            tip: place(0.0, 1.0),
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    fn ball(x: f64, z: f64) -> Solid {
        Solid { name: "ball".to_owned(), pose: place(x, z), form: Form::Sphere(0.1) }
    }

    fn judged(obstacles: &[Solid], path: &[f64]) -> Result<Motion, String> {
        let case = Case::new(&rod(), obstacles, &[], 0.1).unwrap();
        let path: Vec<Vec<f64>> = path.iter().map(|q| vec![*q]).collect();
        case.motion(&path, [&path[0], &path[path.len() - 1]])
    }

    #[test]
    fn the_way_of_the_tip_is_an_arc_and_what_is_on_it_is_touched() {
        let motion = judged(&[ball(0.3, -0.5)], &[-1.0, 0.0, 1.0]).unwrap();
        assert!((motion.length_m - 2.0).abs() < 1e-4, "{motion:?}");
        assert!((motion.travel_rad - 2.0).abs() < 1e-12, "{motion:?}");
        assert!((motion.joint_length - 2.0).abs() < 1e-12, "{motion:?}");
        // At 45 degrees between two stops of the path.
        let refusal = judged(&[ball(0.6, 0.6)], &[0.0, 1.5]).unwrap_err();
        assert_eq!(refusal, "leg 1: part 1 touches obstacle 1");
        let missed = judged(&[ball(0.86, 0.86)], &[0.0, 1.5]);
        assert!(missed.is_ok(), "beyond the end of the rod: {missed:?}");
    }

    #[test]
    fn paths_that_are_not_what_was_wanted_are_refused() {
        assert!(judged(&[], &[0.0, 2.5]).unwrap_err().contains("joint 1 is outside its limits at 2.0"));
        assert_eq!(
            judged(&[ball(0.0, 0.5)], &[0.0, 1.0]).unwrap_err(),
            "at the start, part 1 touches obstacle 1"
        );
        let case = Case::new(&rod(), &[], &[], 0.1).unwrap();
        assert_eq!(
            case.motion(&[vec![0.0]], [&[0.0], &[1.0]]).unwrap_err(),
            "the path does not go from start to goal"
        );
        assert_eq!(
            case.motion(&[vec![0.0, 1.0]], [&[0.0], &[1.0]]).unwrap_err(),
            "a configuration is not made of 1 numbers"
        );
    }
}
