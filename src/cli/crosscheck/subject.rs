//! Our answers: the engine's kinematics, distances and the checks that planners use, by name of pair, frame and joint.

use base::robot::MayTouch;
use base::settings::{Document, SettingsError};
use base::solid::Form;
use engine::geometry::planar::{Segment2, Touch, distance_point_segment};
use engine::geometry::{
    Capsule, Convex, Frame, Solid, Sphere, Vec2, Vec3, distance_segment_segment, distance_segment_solid,
};
use engine::kinematics::open_chain::OpenChain;
use engine::kinematics::planar_2r::Planar2r;
use engine::kinematics::robot::{Body, capsule_around, links_at_zero, listed_pairs};
use engine::kinematics::{AXES, Chain, Joints, KinematicsError, Robot};
use engine::space::cell::{Cell, Scene, Standing};
use engine::space::polyhedra::{CarriedArm, read_scene};
use engine::space::{ArmWorld, JointSpace, Obstacle, Support};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;

/// Metres in a centimetre.
const M: f64 = 1e-2;

/// How a scene file is written.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SceneFormat {
    /// A robot's cell, in millimetres.
    Cell,
    /// Convex solids, in centimetres.
    Polyhedra,
}

/// The result of the check that planners use.
#[derive(Debug, Clone, Copy)]
pub struct Standable {
    /// Whether the robot can be there.
    pub is_free: bool,
    /// Whether only what stands around the robot counts; else it may not hit itself either.
    pub of_scene: bool,
}

/// A robot among obstacles that answers with our code.
pub trait Subject: Send + Sync {
    /// How many joints it has.
    fn joints(&self) -> usize;

    /// Everything that may touch: `part|obstacle`, and `part|part` in alphabetical order.
    fn pairs(&self) -> Vec<String>;

    /// The frame of every link, and the tool's, in the world.
    fn frames(&self, q_rad: &[f64]) -> Vec<Frame>;

    /// The gap of each pair, metres: above 0 the distance, at most 0 in contact.
    fn gaps_m(&self, q_rad: &[f64]) -> Vec<f64>;

    /// What the check that planners use finds; `None` if no planner moves this robot here.
    fn standable(&self, q_rad: &[f64]) -> Option<Standable>;

    /// Whether a joint, counted from 0, may not be at this angle.
    fn is_beyond(&self, joint: usize, angle_rad: f64) -> bool;
}

/// What stands around a robot, by name.
type Stills = Vec<(String, Solid)>;

/// How planners check a six-axis arm for contact.
enum Check {
    /// As in a cell: with all that stands there, and with itself.
    Cell(Box<Cell>),
    /// As rods among solids, in centimetres, and nothing else.
    Rods(Box<CarriedArm>, Vec<Convex>),
}

/// A six-axis arm with the capsules of its body.
pub struct SerialArm {
    robot: Robot,
    body: Body,
    stills: Stills,
    check: Option<Check>,
}

impl SerialArm {
    /// `robot` with its body called `body`, which it has, in the scene in the file at `path`.
    ///
    /// # Errors
    /// What is wrong with the scene.
    pub fn new(robot: &Robot, body: &str, format: SceneFormat, path: &Path) -> Result<Self, SettingsError> {
        let found = robot.body(body).cloned().expect("the body's name was checked");
        match format {
            SceneFormat::Cell => Ok(Self::in_cell(robot, found, Scene::load(path)?)),
            SceneFormat::Polyhedra => Self::among_polyhedra(robot, found, path),
        }
    }

    fn in_cell(robot: &Robot, body: Body, scene: Scene) -> Self {
        let stills = stills_of(&scene);
        let placed = robot.clone().placed(scene.base());
        // Cells know a robot's first body only.
        let is_first = robot.bodies().first().is_some_and(|first| first.name() == body.name());
        let check = is_first.then(|| Check::Cell(Box::new(Cell::new(robot.clone(), scene, true))));
        Self { robot: placed, body, stills, check }
    }

    fn among_polyhedra(robot: &Robot, body: Body, path: &Path) -> Result<Self, SettingsError> {
        let (bodies, support, stills) = polyhedra(path)?;
        let arm = CarriedArm::new(robot, body.name(), &support).ok();
        let check = arm.map(|arm| Check::Rods(Box::new(arm), bodies));
        Ok(Self { robot: robot.clone().placed(support.base()), body, stills, check })
    }

    fn chain(&self) -> &Chain {
        self.robot.arm().chain()
    }
}

/// What stands in a cell.
fn stills_of(scene: &Scene) -> Stills {
    scene.obstacles().iter().map(|o| (o.name.clone(), o.solid.clone())).collect()
}

/// The solids in the file at `path`, in centimetres, what holds the base, and all that stands around it.
fn polyhedra(path: &Path) -> Result<(Vec<Convex>, Support, Stills), SettingsError> {
    let document = Document::open(path)?;
    let armed = read_scene(path)?.with_arm();
    let (bodies, support) = armed.map_err(|message| document.error(0..0, message))?;
    let mut stills = Stills::new();
    for (index, solid) in bodies.iter().enumerate() {
        // The block under the base stands last.
        let is_block = support.pedestal().is_some() && index + 1 == bodies.len();
        let name = if is_block { "pedestal".to_owned() } else { format!("obstacle {}", index + 1) };
        let vertices = solid.vertices().iter().map(|vertex| vertex * M).collect();
        let solid = Convex::from_vertices(vertices).expect("a solid stays one in another unit");
        stills.push((name, Solid::Convex(solid)));
    }
    for (name, solid) in support.solids().unwrap_or_default() {
        if matches!(solid, Solid::HalfSpace(_)) {
            stills.push((name.to_owned(), solid));
        }
    }
    Ok((bodies, support, stills))
}

/// `part|obstacle` for parts that the scene can touch, then `part|part` in alphabetical order.
fn pair_names(parts: &[(&str, bool)], stills: &[(String, Solid)], self_pairs: &[[usize; 2]]) -> Vec<String> {
    let exposed = parts.iter().filter(|(_, is_exposed)| *is_exposed);
    let outer = exposed.flat_map(|(part, _)| stills.iter().map(move |(still, _)| format!("{part}|{still}")));
    let own = self_pairs.iter().map(|pair| {
        let [a, b] = pair.map(|part| parts[part].0);
        format!("{}|{}", a.min(b), a.max(b))
    });
    outer.chain(own).collect()
}

/// The gaps of the same pairs in the same order, metres.
fn gaps_m(parts: &[(Capsule, bool)], stills: &[(String, Solid)], self_pairs: &[[usize; 2]]) -> Vec<f64> {
    let exposed = parts.iter().filter(|(_, is_exposed)| *is_exposed);
    let to_still =
        |capsule: &Capsule, solid: &Solid| distance_segment_solid(&capsule.segment, solid) - capsule.radius;
    let outer =
        exposed.flat_map(|(capsule, _)| stills.iter().map(move |(_, solid)| to_still(capsule, solid)));
    let own = self_pairs.iter().map(|pair| {
        let [a, b] = pair.map(|part| &parts[part].0);
        distance_segment_segment(&a.segment, &b.segment) - a.radius - b.radius
    });
    outer.chain(own).collect()
}

fn six(q_rad: &[f64]) -> Joints {
    q_rad.try_into().expect("a six-axis arm is given six angles")
}

impl Subject for SerialArm {
    fn joints(&self) -> usize {
        AXES
    }

    fn pairs(&self) -> Vec<String> {
        let parts: Vec<_> =
            self.body.parts().iter().map(|part| (part.name(), !part.is_self_only())).collect();
        pair_names(&parts, &self.stills, self.body.self_pairs())
    }

    fn frames(&self, q_rad: &[f64]) -> Vec<Frame> {
        let q = six(q_rad);
        let mut frames = self.chain().frames(&q)[1..].to_vec();
        frames.push(self.chain().forward(&q));
        frames
    }

    fn gaps_m(&self, q_rad: &[f64]) -> Vec<f64> {
        let placed = self.body.at(self.chain(), &six(q_rad)).into_iter();
        let parts: Vec<_> =
            placed.zip(self.body.parts()).map(|(capsule, part)| (capsule, !part.is_self_only())).collect();
        gaps_m(&parts, &self.stills, self.body.self_pairs())
    }

    fn standable(&self, q_rad: &[f64]) -> Option<Standable> {
        /// How far around rods obstacles are looked for.
        const REACH_CM: f64 = 1.0;
        let q = six(q_rad);
        match self.check.as_ref()? {
            Check::Cell(cell) => {
                let mut placed = Vec::new();
                cell.place(&q, &mut placed);
                let is_free = cell.standing(&placed, |_| 0.0) != Standing::Contact;
                Some(Standable { is_free, of_scene: false })
            }
            Check::Rods(arm, bodies) => {
                let is_free = arm.clearance(&q, bodies, REACH_CM, false) > 0.0;
                Some(Standable { is_free, of_scene: true })
            }
        }
    }

    fn is_beyond(&self, joint: usize, angle_rad: f64) -> bool {
        !self.chain().joints()[joint].allows(angle_rad)
    }
}

/// A robot by a URDF file, of any number of joints that turn or slide, with capsules around its solids.
pub struct OpenArm {
    base: Frame,
    chain: OpenChain,
    /// The frame of each link as rows have it, in that of its joint.
    links: Vec<Frame>,
    /// Name, joint and capsule of each solid; joint 0 is the base.
    parts: Vec<(String, usize, Capsule)>,
    self_pairs: Vec<[usize; 2]>,
    stills: Stills,
    /// Where planners move it, if they do.
    space: Option<Box<JointSpace>>,
}

impl OpenArm {
    /// `robot`, whose links may touch as an SRDF file says, in the scene in the file at `path`.
    ///
    /// # Errors
    /// What is wrong with the scene, and a solid that encloses nothing.
    pub fn new(
        robot: &base::robot::Robot,
        may_touch: &MayTouch,
        format: SceneFormat,
        path: &Path,
    ) -> Result<Self, KinematicsError> {
        let (base, stills) = match format {
            SceneFormat::Cell => {
                let scene = Scene::load(path)?;
                (*scene.base(), stills_of(&scene))
            }
            SceneFormat::Polyhedra => {
                let (_, support, stills) = polyhedra(path)?;
                (*support.base(), stills)
            }
        };
        Self::among(robot, listed_pairs(robot, may_touch), base, stills)
    }

    /// The robot of `space` where planners move it. What stands around it has numbers after its names, which need not differ.
    ///
    /// # Errors
    /// A solid that encloses nothing.
    pub fn in_space(space: &JointSpace) -> Result<Self, KinematicsError> {
        let still = |(place, solid): (usize, &base::solid::Solid)| {
            let (points, radius_m) = solid.rounded();
            let points: Vec<Vec3> = points.into_iter().map(Vec3::from).collect();
            let name = format!("{} {}", solid.name, place + 1);
            Ok(match solid.form {
                Form::Sphere(_) => (name, Solid::Sphere(Sphere::new(points[0], radius_m)?)),
                _ => (name, Solid::Convex(Convex::from_vertices(points)?)),
            })
        };
        let stills = space.obstacles().iter().enumerate().map(still);
        let stills = stills.collect::<Result<_, KinematicsError>>()?;
        let arm = Self::among(space.robot(), space.self_pairs().to_vec(), Frame::IDENTITY, stills)?;
        Ok(Self { space: Some(Box::new(space.clone())), ..arm })
    }

    fn among(
        robot: &base::robot::Robot,
        self_pairs: Vec<[usize; 2]>,
        base: Frame,
        stills: Stills,
    ) -> Result<Self, KinematicsError> {
        let chain = OpenChain::new(robot);
        let at_zero = chain.frames(&vec![0.0; chain.joints().len()]);
        let links = at_zero.iter().zip(links_at_zero(&chain)).map(|(frame, link)| frame.inverse() * link);
        let parts = robot
            .solids
            .iter()
            .map(|(joint, solid)| Ok((solid.name.clone(), *joint, capsule_around(solid, &Frame::IDENTITY)?)));
        let parts = parts.collect::<Result<_, KinematicsError>>()?;
        let links = links.collect();
        Ok(Self { base, chain, links, parts, self_pairs, stills, space: None })
    }

    fn placed(&self, q: &[f64]) -> Vec<Frame> {
        self.chain.frames(q).into_iter().map(|frame| self.base * frame).collect()
    }
}

impl Subject for OpenArm {
    fn joints(&self) -> usize {
        self.chain.joints().len()
    }

    fn pairs(&self) -> Vec<String> {
        let parts: Vec<_> = self.parts.iter().map(|(name, joint, _)| (name.as_str(), *joint > 0)).collect();
        pair_names(&parts, &self.stills, &self.self_pairs)
    }

    fn frames(&self, q: &[f64]) -> Vec<Frame> {
        let placed = self.placed(q);
        let links = placed.iter().zip(&self.links).skip(1).map(|(frame, link)| *frame * *link);
        links.chain([placed[self.joints()] * *self.chain.tip()]).collect()
    }

    fn gaps_m(&self, q: &[f64]) -> Vec<f64> {
        let placed = self.placed(q);
        let parts = self.parts.iter();
        let parts: Vec<_> =
            parts.map(|(_, joint, capsule)| (capsule.placed(&placed[*joint]), *joint > 0)).collect();
        gaps_m(&parts, &self.stills, &self.self_pairs)
    }

    fn standable(&self, q: &[f64]) -> Option<Standable> {
        self.space.as_ref().map(|space| Standable { is_free: space.is_clear(q), of_scene: false })
    }

    fn is_beyond(&self, joint: usize, value: f64) -> bool {
        !self.chain.joints()[joint].joint.allows(value)
    }
}

/// An arm of two links among obstacles in the plane.
pub struct PlanarArm {
    arm: Planar2r,
    obstacles: Vec<Obstacle>,
    touch: Touch,
}

impl PlanarArm {
    /// The arm and the obstacles of `world`.
    pub fn new(world: &ArmWorld) -> Self {
        Self { arm: world.rules().arm, obstacles: world.obstacles().to_vec(), touch: world.rules().touch }
    }
}

fn two(q_rad: &[f64]) -> [f64; 2] {
    q_rad.try_into().expect("a planar arm is given two angles")
}

/// The gap in centimetres: in contact minus how deep the axis is in a disc, and of unknown depth in a polygon.
fn gap_cm(link: &Segment2, obstacle: &Obstacle, touch: Touch) -> f64 {
    if !obstacle.meets(link, touch) {
        return obstacle.distance(link);
    }
    match obstacle {
        Obstacle::Circle(circle) => distance_point_segment(&circle.center, link) - circle.radius,
        Obstacle::Polygon(_) => f64::NEG_INFINITY,
    }
}

impl Subject for PlanarArm {
    fn joints(&self) -> usize {
        2
    }

    fn pairs(&self) -> Vec<String> {
        let of_link =
            |link| (1..=self.obstacles.len()).map(move |obstacle| format!("link {link}|obstacle {obstacle}"));
        (1..=2).flat_map(of_link).collect()
    }

    fn frames(&self, q_rad: &[f64]) -> Vec<Frame> {
        let q = two(q_rad);
        let frame = |place: Vec2, angle: f64| Frame {
            origin: Vec3::new(place.x * M, place.y * M, 0.0),
            rotation: Frame::turned(&Vec3::z(), angle).rotation,
        };
        let tip = frame(self.arm.forward(q), q[0] + q[1]);
        vec![frame(self.arm.elbow(q), q[0]), tip, tip]
    }

    fn gaps_m(&self, q_rad: &[f64]) -> Vec<f64> {
        let q = two(q_rad);
        let elbow = self.arm.elbow(q);
        let links = [Segment2::new(Vec2::zeros(), elbow), Segment2::new(elbow, self.arm.forward(q))];
        let of_link =
            |link| self.obstacles.iter().map(move |obstacle| gap_cm(link, obstacle, self.touch) * M);
        links.iter().flat_map(of_link).collect()
    }

    fn standable(&self, _q_rad: &[f64]) -> Option<Standable> {
        // Planners ask for the gaps, and nothing on top of them.
        None
    }

    fn is_beyond(&self, _joint: usize, _angle_rad: f64) -> bool {
        false
    }
}
