//! A robot of any number of joints among convex solids: where it can be, and which straight motions it can make.
//!
//! Solids are points and a radius ([`Rounded`]); a cylinder is a prism around it. Touching is contact. Links that a joint joins are
//! never held against each other, unless an SRDF file says which links may touch. A motion straight in joint space is checked at both
//! ends and wherever the joint that moves most has gone one more step; a metre of a joint that slides counts as a radian, and a joint
//! that turns without end goes the shorter way round.

use crate::geometry::{Frame, Placed, Rounded, Vec3, intersects_placed_placed};
use crate::kinematics::open_chain::OpenChain;
use base::robot::{Kind, MayTouch, Robot};
use base::solid::Solid;

/// A robot among obstacles.
#[derive(Debug, Clone)]
pub struct JointSpace {
    robot: Robot,
    chain: OpenChain,
    /// Each with its link.
    parts: Vec<(usize, Rounded)>,
    obstacles: Vec<Solid>,
    stills: Vec<Rounded>,
    self_pairs: Vec<[usize; 2]>,
    step_rad: f64,
}

/// Which parts of a robot must not touch each other.
#[derive(Debug, Clone)]
pub enum SelfContact {
    /// None: the robot may touch itself.
    Unchecked,
    /// Those of links that no joint joins.
    Apart,
    /// Those of links that are not one and may not touch.
    Except(MayTouch),
}

impl SelfContact {
    fn is_checked(&self, robot: &Robot, [a, b]: [usize; 2]) -> bool {
        let apart = robot.solids[a].0.abs_diff(robot.solids[b].0);
        match self {
            Self::Unchecked => false,
            Self::Apart => apart > 1,
            Self::Except(may_touch) => apart > 0 && !may_touch.allows(&robot.owners[a], &robot.owners[b]),
        }
    }
}

fn rounded(solid: &Solid) -> Rounded {
    let (points, radius_m) = solid.rounded();
    Rounded::new(points.into_iter().map(Vec3::from).collect(), radius_m)
}

impl JointSpace {
    /// The robot among these obstacles, its motions checked every `step_rad`; it must not touch itself as `contact` says.
    pub fn new(robot: Robot, obstacles: Vec<Solid>, contact: &SelfContact, step_rad: f64) -> Self {
        let count = robot.solids.len();
        let pairs = (0..count).flat_map(|b| (0..b).map(move |a| [a, b]));
        let self_pairs = pairs.filter(|pair| contact.is_checked(&robot, *pair)).collect();
        Self {
            chain: OpenChain::new(&robot),
            parts: robot.solids.iter().map(|(link, solid)| (*link, rounded(solid))).collect(),
            stills: obstacles.iter().map(rounded).collect(),
            robot,
            obstacles,
            self_pairs,
            step_rad,
        }
    }

    /// The robot as its file gives it.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Its chain.
    pub fn chain(&self) -> &OpenChain {
        &self.chain
    }

    /// What stands around it.
    pub fn obstacles(&self) -> &[Solid] {
        &self.obstacles
    }

    /// Pairs of the robot's solids that must not touch, by index.
    pub fn self_pairs(&self) -> &[[usize; 2]] {
        &self.self_pairs
    }

    /// How far a joint may move between two configurations that are checked.
    pub fn step_rad(&self) -> f64 {
        self.step_rad
    }

    /// Why the robot cannot be at `q`; `None` if it can.
    pub fn refusal(&self, q: &[f64]) -> Option<String> {
        if let Some(joint) = self.chain.outside(q) {
            let name = &self.robot.joints[joint].name;
            let [lower, upper] = self.robot.joints[joint].limits;
            let unit = if self.robot.joints[joint].kind == Kind::Slides { "m" } else { "rad" };
            return Some(format!("joint `{name}` is at {} {unit}, outside {lower} to {upper}", q[joint]));
        }
        let frames = self.chain.frames(q);
        let name = |part: usize| &self.robot.solids[part].1.name;
        if let Some((part, still)) = self.touched(&frames) {
            return Some(format!(
                "part `{}` is in contact with `{}`",
                name(part),
                self.obstacles[still].name
            ));
        }
        let pair = self.self_touching(&frames)?;
        Some(format!("parts `{}` and `{}` are in contact", name(pair[0]), name(pair[1])))
    }

    /// Whether the robot can be at `q`.
    pub fn is_free(&self, q: &[f64]) -> bool {
        if self.chain.outside(q).is_some() {
            return false;
        }
        let frames = self.chain.frames(q);
        self.touched(&frames).is_none() && self.self_touching(&frames).is_none()
    }

    /// Whether it can go straight from one configuration to another; counts every configuration that is checked.
    pub fn joins(&self, from: &[f64], to: &[f64], checked: &mut u64) -> bool {
        let changes: Vec<f64> = self.chain.change(from, to).collect();
        let change = changes.iter().map(|change| change.abs()).fold(0.0, f64::max);
        let steps = (change / self.step_rad).ceil().max(1.0) as u32;
        (0..=steps).all(|step| {
            *checked += 1;
            let share = f64::from(step) / f64::from(steps);
            let q: Vec<f64> = from.iter().zip(&changes).map(|(a, change)| a + change * share).collect();
            self.is_free(&q)
        })
    }

    fn placed<'a>(&'a self, part: usize, frames: &'a [Frame]) -> Placed<'a> {
        let (link, solid) = &self.parts[part];
        Placed { solid, frame: &frames[*link] }
    }

    /// The first part and obstacle in contact. What is welded to the base stands as it does, and is not checked.
    fn touched(&self, frames: &[Frame]) -> Option<(usize, usize)> {
        let moving = (0..self.parts.len()).filter(|part| self.parts[*part].0 > 0);
        moving.into_iter().find_map(|part| {
            let placed = self.placed(part, frames);
            let hit = |still: &Rounded| {
                intersects_placed_placed(&placed, &Placed { solid: still, frame: &Frame::IDENTITY })
            };
            self.stills.iter().position(hit).map(|still| (part, still))
        })
    }

    fn self_touching(&self, frames: &[Frame]) -> Option<[usize; 2]> {
        let touch = |[a, b]: &&[usize; 2]| {
            intersects_placed_placed(&self.placed(*a, frames), &self.placed(*b, frames))
        };
        self.self_pairs.iter().find(touch).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::robot::Joint;
    use base::solid::{Form, Pose};

    /// Seven joints in a row that turn about z, y, z, ..., each with a rod of 0.2 m.
    fn seven() -> Robot {
        let up = |z: f64| Pose { origin_m: [0.0, 0.0, z], ..Pose::IDENTITY };
        let joint = |i: usize| Joint {
            name: format!("joint {i}"),
            before: up(0.2),
            axis: if i.is_multiple_of(2) { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] },
            kind: Kind::Turns,
            limits: [-2.5, 2.5],
            speed: None,
        };
        let rod =
            |i: usize| Solid { name: format!("rod {i}"), pose: up(0.1), form: Form::Cylinder(0.03, 0.18) };
        Robot {
            name: "seven".to_owned(),
            joints: (0..7).map(joint).collect(),
            solids: (0..=7).map(|i| (i, rod(i))).collect(),
            owners: (0..=7).map(|i| rod(i).name).collect(),
            tip: up(0.2),
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    fn ball(x: f64, z: f64) -> Solid {
        let pose = Pose { origin_m: [x, 0.0, z], ..Pose::IDENTITY };
        Solid { name: "ball".to_owned(), pose, form: Form::Sphere(0.1) }
    }

    #[test]
    fn seven_axes_move_and_stop_at_what_is_in_the_way() {
        let space = JointSpace::new(seven(), vec![ball(0.8, 0.4)], &SelfContact::Apart, 0.05);
        let up = [0.0; 7];
        assert!((space.chain().forward(&up).origin - Vec3::z() * 1.6).norm() < 1e-12);
        assert_eq!(space.refusal(&up), None);
        let mut level = up;
        level[1] = std::f64::consts::FRAC_PI_2;
        assert_eq!(space.refusal(&level).unwrap(), "part `rod 5` is in contact with `ball`");
        let mut below = up;
        below[1] = 2.2;
        let mut checked = 0;
        assert!(
            space.is_free(&below) && !space.joins(&up, &below, &mut checked),
            "the ball is between the two"
        );
        assert!(checked > 10, "{checked}");
        level[0] = 3.0;
        assert!(space.refusal(&level).unwrap().contains("joint `joint 0` is at 3 rad, outside -2.5 to 2.5"));
    }

    #[test]
    fn a_robot_that_folds_onto_itself_is_told_unless_nobody_asks() {
        let mut folded = [0.0; 7];
        (folded[1], folded[3], folded[5]) = (0.0, 2.4, 2.4);
        let refusal = JointSpace::new(seven(), Vec::new(), &SelfContact::Apart, 0.05).refusal(&folded);
        assert!(refusal.is_some_and(|text| text.contains("are in contact")), "it must touch");
        assert!(JointSpace::new(seven(), Vec::new(), &SelfContact::Unchecked, 0.05).is_free(&folded));
    }
}
