//! A planar arm as the judge sees it: in the plane z = 0, links as capsules too thin to matter.

use super::model::{Freedom, Model, Pair, Part, Row, Still};
use super::subject::Subject;
use engine::geometry::planar::{Circle, ConvexPolygon, Segment2, Touch, distance_point_segment};
use engine::geometry::{Capsule, Convex, Frame, GeometryError, Solid, Sphere, Vec2, Vec3};
use engine::kinematics::planar_2r::{Planar2r, continued};
use engine::space::{ArmWorld, HopRule, Obstacle};
use std::f64::consts::PI;

/// The radius of a link for the judge, a tenth of the tolerance: our links have no width.
pub const LINK_RADIUS_M: f64 = 1e-7;
/// How far prisms reach above and below the plane.
const HALF_HEIGHT_M: f64 = 0.05;
/// Metres in a centimetre.
const M: f64 = 1e-2;

/// An arm of two links among obstacles in the plane.
pub struct PlanarArm {
    arm: Planar2r,
    obstacles: Vec<Obstacle>,
    touch: Touch,
    hop: HopRule,
    model: Model,
    pairs: Vec<Pair>,
}

impl PlanarArm {
    /// The arm and the obstacles of `world`.
    ///
    /// # Errors
    /// [`GeometryError`] for an obstacle that is no solid; none in a world that was built.
    pub fn new(name: String, world: &ArmWorld) -> Result<Self, GeometryError> {
        let arm = world.rules().arm;
        let links_cm = arm.links();
        let row = |length_cm: f64| Row {
            alpha_rad: 0.0,
            a_m: length_cm * M,
            d_m: 0.0,
            offset_rad: 0.0,
            limits_rad: [-PI, PI],
        };
        let part = |index: usize| -> Result<Part, GeometryError> {
            let start = Vec3::new(-links_cm[index] * M, 0.0, 0.0);
            Ok(Part {
                name: format!("link {}", index + 1),
                link: index + 1,
                capsule: Capsule::new(start, Vec3::zeros(), LINK_RADIUS_M)?,
                exposed: true,
            })
        };
        let still = |(index, obstacle): (usize, &Obstacle)| -> Result<Still, GeometryError> {
            Ok(Still { name: format!("obstacle {}", index + 1), solid: solid(obstacle)? })
        };
        let obstacles = world.obstacles().to_vec();
        let model = Model {
            name,
            base: Frame::IDENTITY,
            rows: links_cm.map(row).to_vec(),
            tool_m: 0.0,
            parts: vec![part(0)?, part(1)?],
            self_pairs: Vec::new(),
            stills: obstacles.iter().enumerate().map(still).collect::<Result<_, _>>()?,
        };
        let pairs = model.pairs();
        Ok(Self { arm, obstacles, touch: world.rules().touch, hop: world.rules().hop, model, pairs })
    }

    fn links(&self, q_rad: &[f64]) -> [Segment2; 2] {
        let q = two(q_rad);
        let elbow = self.arm.elbow(q);
        let tip = self.arm.forward(q);
        [Segment2::new(Vec2::zeros(), elbow), Segment2::new(elbow, tip)]
    }
}

fn two(q_rad: &[f64]) -> [f64; 2] {
    q_rad.try_into().expect("a planar arm is asked for two angles")
}

/// The obstacle as a solid that the plane z = 0 cuts in it.
fn solid(obstacle: &Obstacle) -> Result<Solid, GeometryError> {
    let at = |p: &Vec2, z: f64| Vec3::new(p.x * M, p.y * M, z);
    match obstacle {
        Obstacle::Circle(circle) => {
            Ok(Solid::Sphere(Sphere::new(at(&circle.center, 0.0), circle.radius * M)?))
        }
        Obstacle::Polygon(polygon) => {
            let corners = polygon.vertices().iter();
            let both = corners.flat_map(|corner| [-HALF_HEIGHT_M, HALF_HEIGHT_M].map(|z| at(corner, z)));
            Ok(Solid::Convex(Convex::from_vertices(both.collect())?))
        }
    }
}

/// `obstacle` elsewhere.
fn moved(obstacle: &Obstacle, by_cm: &Vec2) -> Obstacle {
    match obstacle {
        Obstacle::Circle(circle) => {
            Obstacle::Circle(Circle { center: circle.center + by_cm, radius: circle.radius })
        }
        Obstacle::Polygon(polygon) => {
            let corners = polygon.vertices().iter().map(|corner| corner + by_cm).collect();
            let moved = ConvexPolygon::new(corners).expect("a polygon stays one where it is moved to");
            Obstacle::Polygon(moved)
        }
    }
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
    fn model(&self) -> &Model {
        &self.model
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

    fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    fn gaps_of_m(&self, q_rad: &[f64], pairs: &[Pair]) -> Vec<f64> {
        let links = self.links(q_rad);
        let gap = |pair: &Pair| match *pair {
            Pair::Still(part, still) => gap_cm(&links[part], &self.obstacles[still], self.touch) * M,
            Pair::Parts(..) => unreachable!("a planar arm's links are not kept apart"),
        };
        pairs.iter().map(gap).collect()
    }

    fn planners_check(&self, _q_rad: &[f64]) -> Option<(bool, Freedom)> {
        // Planners ask what `gaps_m` asks, and nothing on top of it.
        None
    }

    fn is_beyond(&self, _joint: usize, _angle_rad: f64) -> Option<bool> {
        None
    }

    fn shifted(&self, still: usize, by_m: &Vec3) -> Box<dyn Subject> {
        let by_cm = Vec2::new(by_m.x / M, by_m.y / M);
        let mut obstacles = self.obstacles.clone();
        obstacles[still] = moved(&obstacles[still], &by_cm);
        let model = self.model.shifted(still, by_m);
        Box::new(Self {
            arm: self.arm,
            obstacles,
            touch: self.touch,
            hop: self.hop,
            model,
            pairs: self.pairs.clone(),
        })
    }

    fn pierces(&self, q_rad: &[f64]) -> bool {
        let links = self.links(q_rad);
        let goes_through = |link: &Segment2, obstacle: &Obstacle| {
            obstacle.meets(link, self.touch)
                && ![link.a, link.b].iter().any(|end| obstacle.holds(end, self.touch))
        };
        links.iter().any(|link| self.obstacles.iter().any(|obstacle| goes_through(link, obstacle)))
    }

    fn determinant(&self, q_rad: &[f64]) -> f64 {
        self.arm.jacobian_determinant(two(q_rad)) * M * M
    }

    fn between(&self, from_rad: &[f64], to_rad: &[f64], share: f64) -> Option<Vec<f64>> {
        let (from, to) = (two(from_rad), continued(two(from_rad), two(to_rad)));
        if self.hop == HopRule::TipLine {
            let [one, other] = [from, to].map(|q| self.arm.forward(q));
            let tip = one + (other - one) * share;
            // A chord of the reach stays within it but for rounding at its ends.
            let both = self.arm.inverse(&tip).or_else(|_| self.arm.inverse(&(tip * (1.0 - 1e-12)))).ok()?;
            let q = if from[1] + to[1] > 0.0 { both.positive } else { both.negative };
            return Some(continued(from, q).to_vec());
        }
        Some(vec![from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share])
    }
}
