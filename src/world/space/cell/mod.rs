//! A robot in its work cell: which configurations are free, and by how much.
//!
//! The robot is its body's capsules; the scene is what [`Scene`] holds. Lengths are metres, angles radians. Touching is
//! contact. Parts that the robot's file marks as self-only are not checked against the scene: base and turret
//! stand on the floor.

mod doubt;
mod lanes;
mod limits;
mod line;
mod lines;
mod scene;
#[cfg(test)]
mod tests;
mod time_law;
mod way;

pub use line::Scratch;
pub use lines::{EdgeEnd, LineRules, Lines, Path, Pose, Rejection};
pub use scene::{Obstacle, SCENE_FILE, Scene};
pub use time_law::SpeedRule;

use lanes::Outline;

use crate::geometry::{
    Aabb, BroadPhase, Capsule, distance_capsule_capsule, distance_segment_segment, distance_segment_solid,
};
use crate::kinematics::robot::Body;
use crate::kinematics::{Joints, Robot};

/// A robot, its scene, and what of the two can touch.
#[derive(Debug, Clone)]
pub struct Cell {
    robot: Robot,
    body: Body,
    scene: Scene,
    broad: BroadPhase,
    /// Parts that the scene can touch, those that reach out furthest first.
    exposed: Vec<usize>,
    self_pairs: Vec<[usize; 2]>,
    outline: Outline,
}

/// Whether a configuration is free when its parts are thickened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// Free even with every part thickened.
    Clear,
    /// Free, but not with every part thickened.
    Near,
    /// In contact.
    Contact,
}

impl Cell {
    /// The cell of `robot` (with its first body), which stands where `scene` says; without self-collision if `checks_itself` is false.
    ///
    /// # Panics
    /// If the robot has no body, which no robot file allows.
    pub fn new(robot: Robot, scene: Scene, checks_itself: bool) -> Self {
        let robot = robot.placed(scene.base());
        let body = robot.bodies().first().expect("a robot file has a body").clone();
        let boxes = scene.obstacles().iter().map(|obstacle| obstacle.solid.aabb()).collect();
        let exposed = (0..body.parts().len()).rev().filter(|part| !body.parts()[*part].is_self_only());
        let self_pairs = if checks_itself { body.self_pairs().to_vec() } else { Vec::new() };
        let exposed = exposed.collect::<Vec<_>>();
        let broad = BroadPhase::new(boxes);
        let outline = Outline::new(robot.arm().chain(), &body, &scene, &exposed, &self_pairs);
        Self { robot, body, scene, broad, exposed, self_pairs, outline }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The capsules that stand for the robot.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Pairs of the body's parts that are kept apart.
    pub fn self_pairs(&self) -> &[[usize; 2]] {
        &self.self_pairs
    }

    /// Writes the body at `q` into `placed`; what was in it is dropped.
    #[inline]
    pub fn place(&self, q: &Joints, placed: &mut Vec<Capsule>) {
        self.body.place(&self.robot.arm().chain().frames(q), placed);
    }

    /// Why the robot cannot be at `q`; `None` if it can.
    pub fn refusal(&self, q: &Joints) -> Option<String> {
        for (i, (joint, angle)) in self.robot.arm().chain().joints().iter().zip(q).enumerate() {
            if !joint.allows(*angle) {
                return Some(format!(
                    "joint {} is at {:.2}°; it turns from {:.2}° to {:.2}°",
                    i + 1,
                    angle.to_degrees(),
                    joint.lower_rad.to_degrees(),
                    joint.upper_rad.to_degrees()
                ));
            }
        }
        let mut placed = Vec::new();
        self.place(q, &mut placed);
        self.contact(&placed)
    }

    /// Whether the robot can be at `q`.
    pub fn is_free(&self, q: &Joints) -> bool {
        self.robot.arm().chain().allows(q) && {
            let mut placed = Vec::new();
            self.place(q, &mut placed);
            self.standing(&placed, |_| 0.0) != Standing::Contact
        }
    }

    /// The first contact of the placed body, in words.
    fn contact(&self, placed: &[Capsule]) -> Option<String> {
        let name = |part: usize| self.body.parts()[part].name();
        for &part in &self.exposed {
            for obstacle in self.scene.obstacles() {
                let gap = distance_segment_solid(&placed[part].segment, &obstacle.solid);
                if gap <= placed[part].radius {
                    return Some(format!("part `{}` is in contact with `{}`", name(part), obstacle.name));
                }
            }
        }
        let touching =
            self.self_pairs.iter().find(|[a, b]| distance_capsule_capsule(&placed[*a], &placed[*b]) == 0.0);
        touching.map(|[a, b]| format!("part `{}` is in contact with part `{}`", name(*a), name(*b)))
    }

    /// Whether the placed body is free when part `i` is thickened by `margin_m(i)`.
    #[inline]
    pub fn standing(&self, placed: &[Capsule], margin_m: impl Fn(usize) -> f64) -> Standing {
        let mut standing = Standing::Clear;
        for &part in &self.exposed {
            let capsule = &placed[part];
            let margin = margin_m(part);
            let reach = Aabb::of_capsule(capsule).grown(margin);
            for index in self.broad.candidates(&reach) {
                let gap = distance_segment_solid(&capsule.segment, &self.scene.obstacles()[index].solid);
                match stand(gap, [capsule.radius, capsule.radius + margin]) {
                    Standing::Contact => return Standing::Contact,
                    found => standing = standing.max(found),
                }
            }
        }
        for [a, b] in &self.self_pairs {
            let margin = margin_m(*a) + margin_m(*b);
            if are_far(&placed[*a], &placed[*b], margin) {
                continue;
            }
            let gap = distance_segment_segment(&placed[*a].segment, &placed[*b].segment)
                - placed[*a].radius
                - placed[*b].radius;
            match stand(gap, [0.0, margin]) {
                Standing::Contact => return Standing::Contact,
                found => standing = standing.max(found),
            }
        }
        standing
    }

    /// The distance from the robot at `q` to the scene and between its parts, metres, and the obstacle that is that near; `None`
    /// where another part of the robot is nearer. The distance is 0 in contact, infinite if nothing can touch.
    pub fn clearance_m(&self, q: &Joints) -> (f64, Option<&Obstacle>) {
        let mut placed = Vec::new();
        self.place(q, &mut placed);
        let to_part = |obstacle: &Obstacle, part: &usize| {
            distance_segment_solid(&placed[*part].segment, &obstacle.solid) - placed[*part].radius
        };
        let to_robot =
            |o| (self.exposed.iter().map(|part| to_part(o, part)).fold(f64::INFINITY, f64::min), Some(o));
        let outer = self.scene.obstacles().iter().map(to_robot);
        let inner =
            self.self_pairs.iter().map(|[a, b]| (distance_capsule_capsule(&placed[*a], &placed[*b]), None));
        let nearest = outer.chain(inner).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or((f64::INFINITY, None), |(gap_m, near)| (gap_m.max(0.0), near))
    }
}

/// Classifies a gap: contact up to the first bound, near up to the second.
#[inline]
fn stand(gap_m: f64, [touching_m, near_m]: [f64; 2]) -> Standing {
    if gap_m <= touching_m {
        Standing::Contact
    } else if gap_m <= near_m {
        Standing::Near
    } else {
        Standing::Clear
    }
}

/// Whether the bounding spheres of two capsules are further apart than `margin_m`; a third of the cost of their distance.
#[inline]
fn are_far(a: &Capsule, b: &Capsule, margin_m: f64) -> bool {
    let (p, q) = (a.segment, b.segment);
    // Twice the vector between the middles, and twice the sum of the radii of the balls.
    let apart = (p.a + p.b) - (q.a + q.b);
    let lengths = (p.b - p.a).norm() + (q.b - q.a).norm();
    let reach = lengths + 2.0 * (a.radius + b.radius + margin_m);
    apart.norm_squared() > reach * reach
}
