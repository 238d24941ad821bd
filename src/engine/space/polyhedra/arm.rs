//! The arm whose tip is the point: rods among the bodies of a scene, above its floor.
//!
//! Robot files are metres, scenes with an arm centimetres; everything given and returned here is in centimetres
//! but joint angles. Rods meet obstacles and the floor only: the reproduced paper checks nothing else. Parts that the robot's file
//! marks as self-only are left out.

use crate::geometry::{
    Aabb, Capsule, Convex, Frame, HalfSpace, Nearest, Segment, Vec3, nearest_segment_convex,
    nearest_segment_convex_printed, nearest_segment_half_space,
};
use crate::kinematics::{
    AXES, Arm, Joints, Robot,
    robot::{Body, Part},
};
use crate::space::Support;
use nalgebra::{Matrix3, Matrix6};

const CM_PER_M: f64 = 100.0;

/// The tool's axes when it points straight down, its x along the world's.
pub const DOWN: Matrix3<f64> = Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);

/// An arm with the rods that stand for its body.
#[derive(Debug, Clone)]
pub struct CarriedArm {
    arm: Arm,
    body: Body,
    floor: Option<HalfSpace>,
    has_pedestal: bool,
}

/// How near a rod is to an obstacle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The obstacle; as many as there are for the floor.
    pub obstacle: usize,
    /// The rod, as listed in the body.
    pub rod: usize,
    /// From the rod's surface to the obstacle; minus the rod's radius where its axis is in the obstacle.
    pub clearance: f64,
    /// The nearest point of the rod's axis.
    pub on_rod: Vec3,
    /// The nearest point of the obstacle.
    pub on_obstacle: Vec3,
}

impl CarriedArm {
    /// The arm of `robot` with its body called `body`, which stands on `support`; a pedestal is among the bodies of its world.
    ///
    /// # Errors
    /// A sentence with the bodies that there are.
    pub fn new(robot: &Robot, body: &str, support: &Support) -> Result<Self, String> {
        let found = robot.body(body).ok_or_else(|| {
            let known: Vec<&str> = robot.bodies().iter().map(Body::name).collect();
            format!("robot `{}` has no body `{body}`; it has {}", robot.name(), known.join(", "))
        })?;
        let floor = support.floor_m().map(|height| HalfSpace::below(height * CM_PER_M));
        let floor = floor.transpose().map_err(|e| e.to_string())?;
        Ok(Self {
            arm: robot.arm().placed(support.base()),
            body: found.exposed(),
            floor,
            has_pedestal: support.pedestal().is_some(),
        })
    }

    /// Forward and inverse kinematics, in metres.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// The rods in the frames of their links, in metres.
    pub fn parts(&self) -> &[Part] {
        self.body.parts()
    }

    /// How high the floor is, if there is one.
    pub fn floor_cm(&self) -> Option<f64> {
        self.floor.map(|floor| -floor.height(&Vec3::zeros()))
    }

    /// The pose of the tip with the axes `rotation` at `point`, in metres as the kinematics take it.
    pub fn target(point: &Vec3, rotation: &Matrix3<f64>) -> Frame {
        Frame { origin: point / CM_PER_M, rotation: *rotation }
    }

    /// Where the tip is.
    pub fn tip(&self, q: &Joints) -> Vec3 {
        self.arm.chain().forward(q).origin * CM_PER_M
    }

    /// The rods at `q`.
    pub fn rods(&self, q: &Joints) -> Vec<Capsule> {
        let mut rods = Vec::new();
        self.body.place(&self.arm.chain().frames(q), &mut rods);
        for rod in &mut rods {
            *rod = in_cm(*rod);
        }
        rods
    }

    /// For every obstacle within `reach` of a rod's surface, the floor last, the rod nearest to it, by the exact distance or by the
    /// printed one. What the first joint alone moves keeps its distance to what the base stands on and is not held against it.
    pub fn contacts(&self, q: &Joints, bodies: &[Convex], reach: f64, printed: bool) -> Vec<Contact> {
        let rods = self.rods(q);
        let nearest = if printed { nearest_segment_convex_printed } else { nearest_segment_convex };
        let of = |obstacle: usize, body: &Convex| {
            let mut best: Option<Contact> = None;
            for (rod, capsule) in rods.iter().enumerate() {
                let is_under = self.has_pedestal && obstacle + 1 == bodies.len();
                if is_under && self.body.parts()[rod].link() <= 1 {
                    continue;
                }
                if !Aabb::of_capsule(capsule).grown(reach).overlaps(body.aabb())
                    || !printed && is_beyond(&capsule.segment, body, capsule.radius + reach)
                {
                    continue;
                }
                let Nearest { distance, on_a, on_b } = nearest(&capsule.segment, body);
                let clearance = distance - capsule.radius;
                if clearance <= reach && best.is_none_or(|known| clearance < known.clearance) {
                    best = Some(Contact { obstacle, rod, clearance, on_rod: on_a, on_obstacle: on_b });
                }
            }
            best
        };
        let above = |floor: &HalfSpace| {
            let moving = rods.iter().enumerate().filter(|(rod, _)| self.body.parts()[*rod].link() > 1);
            let all = moving.map(|(rod, capsule)| {
                let Nearest { distance, on_a, on_b } = nearest_segment_half_space(&capsule.segment, floor);
                let clearance = distance - capsule.radius;
                Contact { obstacle: bodies.len(), rod, clearance, on_rod: on_a, on_obstacle: on_b }
            });
            let least = all.min_by(|a, b| a.clearance.total_cmp(&b.clearance));
            least.filter(|contact| contact.clearance <= reach)
        };
        let among = bodies.iter().enumerate().filter_map(|(obstacle, body)| of(obstacle, body));
        among.chain(self.floor.as_ref().and_then(above)).collect()
    }

    /// How far the rods' surfaces are from the obstacles, or `reach` if that is further.
    pub fn clearance(&self, q: &Joints, bodies: &[Convex], reach: f64, printed: bool) -> f64 {
        let contacts = self.contacts(q, bodies, reach, printed);
        contacts.iter().map(|contact| contact.clearance).fold(reach, f64::min)
    }

    /// Whether every rod's surface is `least` or more from the obstacles: what [`clearance`](Self::clearance) says, without measuring
    /// what a face's plane shows to be farther, and only up to the first that is not.
    pub fn is_clear(&self, q: &Joints, bodies: &[Convex], least: f64, printed: bool) -> bool {
        let frames = self.arm.chain().frames(q);
        let nearest = if printed { nearest_segment_convex_printed } else { nearest_segment_convex };
        self.parts().iter().all(|part| {
            let Capsule { segment, radius } = in_cm(part.placed(&frames));
            let is_off = |body: &Convex| {
                let reach = radius + 2.0 * least;
                !Aabb::of_segment(&segment).grown(reach).overlaps(body.aabb())
                    || !printed && is_beyond(&segment, body, reach)
                    || nearest(&segment, body).distance - radius >= least
            };
            let moves = part.link() > 1;
            let among = if self.has_pedestal && !moves { &bodies[..bodies.len() - 1] } else { bodies };
            let above =
                |floor: &HalfSpace| nearest_segment_half_space(&segment, floor).distance - radius >= least;
            among.iter().all(is_off) && (!moves || self.floor.as_ref().is_none_or(above))
        })
    }

    /// How a point of a rod's axis (in the world) moves with the joints: centimetres a radian, rows 0 to 2; rows 3 to
    /// 5 are the rod's rotation.
    pub fn rod_jacobian(&self, frames: &[Frame; AXES + 1], rod: usize, point: &Vec3) -> Matrix6<f64> {
        jacobian(frames, self.body.parts()[rod].link(), point)
    }

    /// How the tip moves with the joints, as [`rod_jacobian`](Self::rod_jacobian).
    pub fn tip_jacobian(&self, q: &Joints) -> Matrix6<f64> {
        jacobian(&self.arm.chain().frames(q), AXES, &self.tip(q))
    }
}

fn jacobian(frames: &[Frame; AXES + 1], link: usize, point: &Vec3) -> Matrix6<f64> {
    let mut jacobian = crate::kinematics::Chain::jacobian(frames, link, &(point / CM_PER_M));
    jacobian.fixed_view_mut::<3, 6>(0, 0).scale_mut(CM_PER_M);
    jacobian
}

/// A capsule in metres, in centimetres.
fn in_cm(Capsule { segment: Segment { a, b }, radius }: Capsule) -> Capsule {
    Capsule { segment: Segment::new(a * CM_PER_M, b * CM_PER_M), radius: radius * CM_PER_M }
}

/// Whether the plane of some face shows that the segment is farther from the solid than `reach`, rounding included.
fn is_beyond(segment: &Segment, body: &Convex, reach: f64) -> bool {
    let reach = reach + 1e-6;
    body.faces()
        .iter()
        .any(|face| face.plane.height(&segment.a) > reach && face.plane.height(&segment.b) > reach)
}
