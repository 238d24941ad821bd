//! The arm whose tip is the point: rods among the bodies of a scene, above its floor.
//!
//! Robot files are metres, scenes with an arm centimetres; everything given and returned here is in centimetres
//! but joint angles. Rods meet obstacles and the floor only: the reproduced paper checks nothing else. Parts that the robot's file
//! marks as self-only are left out.

use super::apart::{Apart, SLACK_CM};
use crate::geometry::{
    Aabb, Capsule, Convex, Frame, HalfSpace, Nearest, Segment, Vec3, nearest_segment_convex_printed,
    nearest_segment_half_space,
};
use crate::kinematics::{
    AXES, Arm, Joint, Joints, Robot,
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
    length_cm: f64,
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
        let endless = robot.arm().chain().joints().iter().position(Joint::is_endless);
        if let Some(joint) = endless {
            let robot = robot.name();
            return Err(format!(
                "joint {} of robot `{robot}` turns without end, and its angles are searched between limits here; a revolute \
                 joint is accepted",
                joint + 1
            ));
        }
        let floor = support.floor_m().map(|height| HalfSpace::below(height * CM_PER_M));
        let floor = floor.transpose().map_err(|e| e.to_string())?;
        let arm = robot.arm().placed(support.base());
        let body = found.exposed();
        Ok(Self {
            length_cm: length_m(&arm, &body) * CM_PER_M,
            arm,
            body,
            floor,
            has_pedestal: support.pedestal().is_some(),
        })
    }

    /// Whether the base stands on a block, the last of its world's bodies.
    pub fn has_pedestal(&self) -> bool {
        self.has_pedestal
    }

    /// No point of the arm is farther from the axis of a joint before it than this.
    pub fn length_cm(&self) -> f64 {
        self.length_cm
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

    /// Nothing known yet of how rods lie apart from `bodies`.
    pub fn apart(&self, bodies: &[Convex]) -> Apart {
        Apart::new(self.parts().len(), bodies.len())
    }

    /// The rods at `q`.
    pub fn rods(&self, q: &Joints) -> Vec<Capsule> {
        self.rods_in(&self.arm.chain().frames(q))
    }

    /// The rods where `frames` are those of the links.
    pub fn rods_in(&self, frames: &[Frame; AXES + 1]) -> Vec<Capsule> {
        self.parts().iter().map(|part| in_cm(part.placed(frames))).collect()
    }

    /// Where the tip is when `frames` are those of the links; the same as [`tip`](Self::tip).
    pub fn tip_in(&self, frames: &[Frame; AXES + 1]) -> Vec3 {
        (frames[AXES] * *self.arm.chain().tool()).origin * CM_PER_M
    }

    /// For every obstacle within `reach` of a rod's surface, and the floor last, the rod nearest to it. Distances are
    /// exact, or as printed, and use what is remembered of a near configuration. A body that joint 1 alone moves keeps
    /// its distance to the solid under the base and is not compared with it.
    pub fn contacts_of(
        &self,
        rods: &[Capsule],
        bodies: &[Convex],
        reach: f64,
        printed: bool,
        apart: &Apart,
    ) -> Vec<Contact> {
        let of = |(obstacle, body): (usize, &Convex)| {
            let mut best: Option<Contact> = None;
            for (rod, capsule) in rods.iter().enumerate() {
                if obstacle >= self.among(rod, bodies).len() {
                    continue;
                }
                // Nothing farther than this is of use.
                let within = capsule.radius + best.map_or(reach, |known| known.clearance);
                let found = measured(&capsule.segment, body, within, printed, ([rod, obstacle], apart));
                let Some(Nearest { distance, on_a, on_b }) = found else { continue };
                let clearance = distance - capsule.radius;
                if clearance <= reach && best.is_none_or(|known| clearance < known.clearance) {
                    best = Some(Contact { obstacle, rod, clearance, on_rod: on_a, on_obstacle: on_b });
                }
            }
            best
        };
        let above = |floor: &HalfSpace| self.contact_above(floor, rods, bodies.len(), reach);
        let among = bodies.iter().enumerate().filter_map(of);
        among.chain(self.floor.as_ref().and_then(above)).collect()
    }

    /// The rod nearest to the floor, which counts as obstacle number `floor_number`.
    fn contact_above(
        &self,
        floor: &HalfSpace,
        rods: &[Capsule],
        floor_number: usize,
        reach: f64,
    ) -> Option<Contact> {
        let moving = rods.iter().enumerate().filter(|(rod, _)| self.moves(*rod));
        let all = moving.map(|(rod, capsule)| {
            let Nearest { distance, on_a, on_b } = nearest_segment_half_space(&capsule.segment, floor);
            let clearance = distance - capsule.radius;
            Contact { obstacle: floor_number, rod, clearance, on_rod: on_a, on_obstacle: on_b }
        });
        let least = all.min_by(|a, b| a.clearance.total_cmp(&b.clearance));
        least.filter(|contact| contact.clearance <= reach)
    }

    /// How far the rods' surfaces are from the obstacles, or `reach` if that is further.
    pub fn clearance(&self, q: &Joints, bodies: &[Convex], reach: f64, printed: bool) -> f64 {
        self.clearance_of(&self.rods(q), bodies, reach, printed, &self.apart(bodies))
    }

    /// The clearance of rods that are in place, with what is remembered of a configuration near by.
    pub fn clearance_of(
        &self,
        rods: &[Capsule],
        bodies: &[Convex],
        reach: f64,
        printed: bool,
        apart: &Apart,
    ) -> f64 {
        let mut least = reach;
        let measure = |rod: usize, obstacle: usize, least: f64| {
            let capsule = &rods[rod];
            // Nothing farther than the nearest so far is of use.
            let within = capsule.radius + least;
            let pair = ([rod, obstacle], apart);
            let found = measured(&capsule.segment, &bodies[obstacle], within, printed, pair)?;
            Some(found.distance - capsule.radius).filter(|clearance| *clearance < least)
        };
        // The pair that was nearest before shows most others to be farther.
        let first = apart.closest();
        if let Some([rod, obstacle]) = first {
            least = measure(rod, obstacle, least).unwrap_or(least);
        }
        for (rod, capsule) in rods.iter().enumerate() {
            for obstacle in 0..self.among(rod, bodies).len() {
                if first == Some([rod, obstacle]) {
                    continue;
                }
                if let Some(clearance) = measure(rod, obstacle, least) {
                    least = clearance;
                    apart.set_closest([rod, obstacle]);
                }
            }
            if let Some(floor) = self.floor.filter(|_| self.moves(rod)) {
                let height = nearest_segment_half_space(&capsule.segment, &floor).distance;
                least = least.min(height - capsule.radius);
            }
        }
        least
    }

    /// Whether a rod moves with more than the first joint.
    fn moves(&self, rod: usize) -> bool {
        self.parts()[rod].link() > 1
    }

    /// What a rod is held against, the floor left out: what the base stands on, the last body, only if the rod moves.
    fn among<'a>(&self, rod: usize, bodies: &'a [Convex]) -> &'a [Convex] {
        let is_above = self.has_pedestal && !self.moves(rod);
        &bodies[..bodies.len() - usize::from(is_above)]
    }

    /// Whether every rod's surface is `least` or more from the obstacles. It answers as [`clearance`](Self::clearance)
    /// would, but measures nothing that is plainly farther, and stops at the first that is nearer.
    pub fn is_clear(&self, q: &Joints, bodies: &[Convex], least: f64, printed: bool, apart: &Apart) -> bool {
        let frames = self.arm.chain().frames(q);
        self.parts().iter().enumerate().all(|(rod, part)| {
            let Capsule { segment, radius } = in_cm(part.placed(&frames));
            let is_off = |(obstacle, body): (usize, &Convex)| {
                let found = measured(&segment, body, radius + least, printed, ([rod, obstacle], apart));
                found.is_none_or(|nearest| nearest.distance - radius >= least)
            };
            let above =
                |floor: &HalfSpace| nearest_segment_half_space(&segment, floor).distance - radius >= least;
            let is_above = !self.moves(rod) || self.floor.as_ref().is_none_or(above);
            is_above && self.among(rod, bodies).iter().enumerate().all(is_off)
        })
    }

    /// How a point of a rod's axis (in the world) moves with the joints: centimetres a radian, rows 0 to 2; rows 3 to
    /// 5 are the rod's rotation.
    pub fn rod_jacobian(&self, frames: &[Frame; AXES + 1], rod: usize, point: &Vec3) -> Matrix6<f64> {
        jacobian(frames, self.body.parts()[rod].link(), point)
    }

    /// How the tip moves with the joints, as [`rod_jacobian`](Self::rod_jacobian).
    pub fn tip_jacobian(&self, frames: &[Frame; AXES + 1]) -> Matrix6<f64> {
        jacobian(frames, AXES, &self.tip_in(frames))
    }
}

/// All links one after the other, with the end of a rod that is farthest from its link's frame.
fn length_m(arm: &Arm, body: &Body) -> f64 {
    let frames = arm.chain().frames(&[0.0; AXES]);
    let links: f64 = frames.windows(2).map(|pair| (pair[1].origin - pair[0].origin).norm()).sum();
    let beyond = body.parts().iter().flat_map(|part| {
        let Capsule { segment, .. } = part.placed(&frames);
        [segment.a, segment.b].map(|end| (end - frames[part.link()].origin).norm())
    });
    links + beyond.fold(0.0, f64::max)
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

/// The nearest points of a rod's axis and a body; none where something shows that they are farther apart than `within`. The
/// printed distance may be greater than the true one, so that it is measured wherever the boxes about both meet.
fn measured(
    axis: &Segment,
    body: &Convex,
    within: f64,
    printed: bool,
    (pair, apart): ([usize; 2], &Apart),
) -> Option<Nearest> {
    if !Aabb::of_segment(axis).grown(within + SLACK_CM).overlaps(body.aabb()) {
        return None;
    }
    if printed {
        return Some(nearest_segment_convex_printed(axis, body));
    }
    apart.nearest(pair, axis, body, within)
}
