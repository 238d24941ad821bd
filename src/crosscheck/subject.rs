//! What is judged: our kinematics and our distances, asked through one door for every kind of robot.

use super::model::{Freedom, Model, Pair, Part, Row, Still};
use engine::geometry::{
    Convex, Frame, Solid, Vec3, distance_point_solid, distance_segment_segment, distance_segment_solid,
};
use engine::kinematics::robot::Body;
use engine::kinematics::{Chain, Joints, Robot};
use engine::space::cell::{Cell, Standing};
use engine::space::polyhedra::CarriedArm;
use nalgebra::Matrix3;

/// A robot among obstacles that answers with our code.
pub trait Subject: Send + Sync {
    /// The same in the judge's terms.
    fn model(&self) -> &Model;

    /// The frame of every link, and the tool's, in the world.
    fn frames(&self, q_rad: &[f64]) -> Vec<Frame>;

    /// The model's pairs.
    fn pairs(&self) -> &[Pair];

    /// The gap of each of `pairs`, metres: above 0 the distance, at most 0 in contact.
    fn gaps_of_m(&self, q_rad: &[f64], pairs: &[Pair]) -> Vec<f64>;

    /// The gap of each of the model's pairs.
    fn gaps_m(&self, q_rad: &[f64]) -> Vec<f64> {
        self.gaps_of_m(q_rad, self.pairs())
    }

    /// What the check that planners use says of contact at `q_rad`, and what contact it looks for: `true` if the robot
    /// can be there. `None` if no planner moves this robot here.
    fn planners_check(&self, q_rad: &[f64]) -> Option<(bool, Freedom)>;

    /// Whether a joint, counted from 0, may not be at this angle; `None` if the robot has no limits.
    fn is_beyond(&self, joint: usize, angle_rad: f64) -> Option<bool>;

    /// The same robot with one still thing of the model elsewhere.
    fn shifted(&self, still: usize, by_m: &Vec3) -> Box<dyn Subject>;

    /// Whether the axis of a capsule passes through an obstacle with both ends outside.
    fn pierces(&self, q_rad: &[f64]) -> bool;

    /// The determinant of the Jacobian of the last link's frame, 0 at a singular pose.
    fn determinant(&self, q_rad: &[f64]) -> f64;

    /// The configuration at `share` of the way between two, on the path that joins them.
    fn between(&self, from_rad: &[f64], to_rad: &[f64], share: f64) -> Option<Vec<f64>>;
}

/// How planners check a six-axis arm for contact.
#[derive(Debug, Clone)]
pub enum Check {
    /// As in a cell: with all that stands there, and with itself.
    Cell(Box<Cell>),
    /// As rods among solids, in centimetres, and nothing else.
    Rods(Box<CarriedArm>, Vec<Convex>),
}

/// A six-axis arm with the capsules of its body.
#[derive(Debug, Clone)]
pub struct SerialArm {
    robot: Robot,
    body: Body,
    model: Model,
    pairs: Vec<Pair>,
    check: Option<Check>,
    /// Whether the tool goes straight between configurations of a path; else the joints do.
    tool_is_straight: bool,
}

impl SerialArm {
    /// `robot` with its body called `body` among `stills`.
    ///
    /// # Errors
    /// A sentence with the bodies that there are.
    pub fn new(
        name: String,
        robot: Robot,
        body: &str,
        stills: Vec<Still>,
        tool_is_straight: bool,
    ) -> Result<Self, String> {
        let body = robot.body(body).cloned().ok_or_else(|| {
            let known: Vec<&str> = robot.bodies().iter().map(Body::name).collect();
            format!("robot `{}` has no body `{body}`; it has {}", robot.name(), known.join(", "))
        })?;
        let chain = robot.arm().chain();
        let row = |joint: &engine::kinematics::Joint| Row {
            alpha_rad: joint.alpha_rad,
            a_m: joint.a_m,
            d_m: joint.d_m,
            offset_rad: joint.offset_rad,
            limits_rad: [joint.lower_rad, joint.upper_rad],
        };
        let part = |part: &engine::kinematics::robot::Part| Part {
            name: part.name().to_owned(),
            link: part.link(),
            capsule: *part.capsule(),
            exposed: !part.is_self_only(),
        };
        let model = Model {
            name,
            base: *chain.base(),
            rows: chain.joints().iter().map(row).collect(),
            tool_m: robot.tool_length_m(),
            parts: body.parts().iter().map(part).collect(),
            self_pairs: body.self_pairs().to_vec(),
            stills,
        };
        let pairs = model.pairs();
        Ok(Self { robot, body, model, pairs, check: None, tool_is_straight })
    }

    /// The same, whose contacts planners check as `check` does.
    pub fn checked_by(self, check: Option<Check>) -> Self {
        Self { check, ..self }
    }

    fn chain(&self) -> &Chain {
        self.robot.arm().chain()
    }

    fn placed(&self, q_rad: &[f64]) -> Vec<engine::geometry::Capsule> {
        self.body.at(self.chain(), &six(q_rad))
    }
}

fn six(q_rad: &[f64]) -> Joints {
    q_rad.try_into().expect("a six-axis arm is asked for six angles")
}

impl Subject for SerialArm {
    fn model(&self) -> &Model {
        &self.model
    }

    fn frames(&self, q_rad: &[f64]) -> Vec<Frame> {
        let q = six(q_rad);
        let mut frames = self.chain().frames(&q)[1..].to_vec();
        frames.push(self.chain().forward(&q));
        frames
    }

    fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    fn gaps_of_m(&self, q_rad: &[f64], pairs: &[Pair]) -> Vec<f64> {
        let placed = self.placed(q_rad);
        let gap = |pair: &Pair| match *pair {
            Pair::Still(part, still) => {
                distance_segment_solid(&placed[part].segment, &self.model.stills[still].solid)
                    - placed[part].radius
            }
            Pair::Parts(a, b) => {
                distance_segment_segment(&placed[a].segment, &placed[b].segment)
                    - placed[a].radius
                    - placed[b].radius
            }
        };
        pairs.iter().map(gap).collect()
    }

    fn planners_check(&self, q_rad: &[f64]) -> Option<(bool, Freedom)> {
        /// How far around rods obstacles are looked for.
        const REACH_CM: f64 = 1.0;
        match self.check.as_ref()? {
            Check::Cell(cell) => {
                let mut placed = Vec::new();
                cell.place(&six(q_rad), &mut placed);
                Some((cell.standing(&placed, |_| 0.0) != Standing::Contact, Freedom::Contact))
            }
            Check::Rods(arm, bodies) => {
                Some((arm.clearance(&six(q_rad), bodies, REACH_CM, false) > 0.0, Freedom::Scene))
            }
        }
    }

    fn is_beyond(&self, joint: usize, angle_rad: f64) -> Option<bool> {
        Some(!self.chain().joints()[joint].allows(angle_rad))
    }

    fn shifted(&self, still: usize, by_m: &Vec3) -> Box<dyn Subject> {
        Box::new(Self { model: self.model.shifted(still, by_m), check: None, ..self.clone() })
    }

    fn pierces(&self, q_rad: &[f64]) -> bool {
        let placed = self.placed(q_rad);
        self.pairs.iter().any(|pair| {
            let Pair::Still(part, still) = *pair else { return false };
            let axis = &placed[part].segment;
            let solid = &self.model.stills[still].solid;
            !matches!(solid, Solid::HalfSpace(_))
                && distance_segment_solid(axis, solid) == 0.0
                && [axis.a, axis.b].iter().all(|end| distance_point_solid(end, solid) > 0.0)
        })
    }

    fn determinant(&self, q_rad: &[f64]) -> f64 {
        self.chain().jacobian_determinant(&six(q_rad))
    }

    fn between(&self, from_rad: &[f64], to_rad: &[f64], share: f64) -> Option<Vec<f64>> {
        let mixed: Vec<f64> = from_rad.iter().zip(to_rad).map(|(a, b)| a + (b - a) * share).collect();
        if !self.tool_is_straight {
            return Some(mixed);
        }
        let arm = self.robot.arm();
        let from = six(from_rad);
        let to = six(to_rad);
        let ends = [self.chain().forward(&from), self.chain().forward(&to)];
        let target = straight(&ends[0], &ends[1], share);
        let q = arm.inverse_on(&target, arm.branch_of(&from), &six(&mixed))?;
        Some(q.to_vec())
    }
}

/// The frame at `share` of the way from one to another: on a straight line, turned evenly about one axis.
pub fn straight(from: &Frame, to: &Frame, share: f64) -> Frame {
    let origin = from.origin + (to.origin - from.origin) * share;
    let turn = to.rotation * from.rotation.transpose();
    let skew =
        Vec3::new(turn[(2, 1)] - turn[(1, 2)], turn[(0, 2)] - turn[(2, 0)], turn[(1, 0)] - turn[(0, 1)]);
    let angle = libm::atan2(skew.norm(), turn.trace() - 1.0);
    // One step of a path turns by far less than half a turn, so the axis is known wherever it matters.
    let rotation = if skew.norm() < 1e-12 {
        Matrix3::identity()
    } else {
        Frame::turned(&(skew / skew.norm()), angle * share).rotation
    };
    Frame { rotation: rotation * from.rotation, origin }
}
