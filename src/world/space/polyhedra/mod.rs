//! A point among convex polyhedra, on a cubic lattice and off it; and, if there is one, the arm that carries it.
//!
//! Obstacles are closed unless set otherwise: a point of a face is in contact, so that two boxes that touch leave no gap. What the
//! point must keep clear of are the obstacles grown by a margin, every plane moved out by it; the arm's rods must
//! keep clear of the obstacles themselves. Lengths are centimetres.

mod apart;
mod arm;
mod error;
mod motion;
mod scene;
#[cfg(test)]
mod tests;

pub use apart::Apart;
pub use arm::{CarriedArm, Contact, DOWN};
pub use error::PolyhedraError;
pub use motion::{Motion, motion};
pub use scene::{SCENE_FILE, Scene, parse_scene, read_scene};

use crate::geometry::{Aabb, Convex, Segment, Vec3};
use base::grid::{Grid3, Nodes3};
use base::text::listed;
use std::sync::{Arc, OnceLock};

/// What blocks, where, and how finely it is searched.
#[derive(Debug, Clone)]
pub struct PolyhedraWorld {
    obstacles: Vec<Convex>,
    bodies: Vec<Convex>,
    growth: f64,
    domain: Aabb,
    step: f64,
    nodes: Nodes3,
    /// Shared by copies of the world.
    raster: Arc<OnceLock<Raster>>,
    touching_blocks: bool,
    arm: Option<CarriedArm>,
}

/// The lattice among the obstacles.
#[derive(Debug, Clone)]
struct Raster {
    /// Nodes in obstacles are blocked.
    grid: Grid3,
    /// Whether a step from each node may touch an obstacle.
    near: Vec<bool>,
}

/// Where a segment first meets an obstacle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The obstacle.
    pub obstacle: usize,
    /// The share of the way at which it is met; 0 if the segment starts in it.
    pub share: f64,
}

impl PolyhedraWorld {
    /// The world of `bodies` within `domain`, searched in steps of `step`; the point keeps out of the bodies grown
    /// by `growth`.
    ///
    /// # Errors
    /// [`PolyhedraError`] for a domain without extent, a step that does not fit it, a negative growth, or a body
    /// that cannot be grown.
    pub fn new(bodies: Vec<Convex>, domain: Aabb, step: f64, growth: f64) -> Result<Self, PolyhedraError> {
        let sides = domain.max - domain.min;
        if !sides.iter().all(|side| side.is_finite() && *side > 0.0) {
            return Err(PolyhedraError::Domain { min: domain.min.into(), max: domain.max.into() });
        }
        let most = sides.min();
        if !(step > 0.0 && step <= most) {
            return Err(PolyhedraError::Step { step, most });
        }
        if !(growth.is_finite() && growth >= 0.0) {
            return Err(PolyhedraError::Growth { found: growth });
        }
        let obstacles: Vec<Convex> = bodies
            .iter()
            .enumerate()
            .map(|(index, body)| grown(body, growth).map_err(|source| obstacle(index, source)))
            .collect::<Result<_, _>>()?;
        // Room for the rounding of a side that is a whole number of steps.
        let size = sides.map(|side| ((side / step + 1e-9) as u32).saturating_add(1));
        let nodes = Nodes3::new(size.into())?;
        let raster = Arc::default();
        Ok(Self { obstacles, bodies, growth, domain, step, nodes, raster, touching_blocks: true, arm: None })
    }

    /// The same world in which a point on an obstacle's face is free: only what lies behind all its planes is blocked.
    #[must_use]
    pub fn touched_freely(mut self) -> Self {
        self.touching_blocks = false;
        self.raster = Arc::default();
        self
    }

    /// The same world with an arm whose tip is the point.
    #[must_use]
    pub fn with_arm(mut self, arm: CarriedArm) -> Self {
        self.arm = Some(arm);
        self
    }

    /// The lattice with every node in an obstacle blocked and those marked from which a step may touch one.
    fn rasterised(&self) -> Raster {
        let size = self.nodes.size();
        let mut grid = Grid3::new(self.nodes);
        let mut near = vec![false; grid.node_count()];
        for index in 0..self.obstacles.len() {
            let reach = self.obstacles[index].aabb().grown(self.step);
            let corner = |v: &Vec3| (v - self.domain.min) / self.step;
            let (low, high) = (corner(&reach.min), corner(&reach.max));
            let range = |axis: usize| {
                let last = i64::from(size[axis]) - 1;
                (low[axis].floor() as i64).clamp(0, last)..=(high[axis].ceil() as i64).clamp(-1, last)
            };
            for (z, y) in range(2).flat_map(|z| range(1).map(move |y| (z, y))) {
                let row = grid.node([0, y as i32, z as i32]).expect("the range was clamped to the lattice");
                for x in range(0) {
                    let node = row + x as u32;
                    near[node as usize] = true;
                    if self.holds(&self.obstacles[index], &self.point(node)) {
                        grid.block(node);
                    }
                }
            }
        }
        Raster { grid, near }
    }

    /// The lattice among the obstacles, made when it is first needed: to read a paper takes none.
    #[inline]
    fn raster(&self) -> &Raster {
        self.raster.get_or_init(|| self.rasterised())
    }

    /// Whether `point` may not be where it is because of `obstacle`.
    #[inline]
    pub fn holds(&self, obstacle: &Convex, point: &Vec3) -> bool {
        if self.touching_blocks {
            return obstacle.contains(point);
        }
        obstacle.faces().iter().all(|face| face.plane.height(point) < 0.0)
    }

    /// The share of the way at which the segment enters the obstacle; `None` if it passes by.
    #[inline]
    fn entry(&self, segment: &Segment, obstacle: &Convex) -> Option<f64> {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for face in obstacle.faces() {
            let [a, b] = [segment.a, segment.b].map(|end| face.plane.height(&end));
            let is_beside = if self.touching_blocks { a > 0.0 && b > 0.0 } else { a >= 0.0 && b >= 0.0 };
            if is_beside {
                return None;
            }
            if a > 0.0 {
                enter = enter.max(a / (a - b));
            } else if b > 0.0 {
                leave = leave.min(a / (a - b));
            }
        }
        let is_entered = if self.touching_blocks { enter <= leave } else { enter < leave };
        is_entered.then_some(enter)
    }

    /// What the point must keep clear of.
    pub fn obstacles(&self) -> &[Convex] {
        &self.obstacles
    }

    /// The obstacles before they were grown: what the arm's rods must keep clear of.
    pub fn bodies(&self) -> &[Convex] {
        &self.bodies
    }

    /// By how much they were grown.
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// Where the point may be.
    pub fn domain(&self) -> &Aabb {
        &self.domain
    }

    /// The search step: the lattice's spacing.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// How many nodes the lattice has.
    pub fn node_count(&self) -> usize {
        self.nodes.node_count()
    }

    /// The lattice; nodes in obstacles are blocked.
    pub fn grid(&self) -> &Grid3 {
        &self.raster().grid
    }

    /// The arm that carries the point.
    pub fn arm(&self) -> Option<&CarriedArm> {
        self.arm.as_ref()
    }

    /// Where `node` is.
    #[inline]
    pub fn point(&self, node: u32) -> Vec3 {
        self.domain.min + Vec3::from(self.nodes.xyz(node).map(f64::from)) * self.step
    }

    /// The node nearest to `point`, if it lies in the domain.
    pub fn node(&self, point: &Vec3) -> Option<u32> {
        let at = (point - self.domain.min) / self.step;
        self.nodes.node([0, 1, 2].map(|axis: usize| at[axis].round() as i32))
    }

    /// Whether a step from `node` to a free neighbour may touch an obstacle; most nodes are far from all.
    #[inline]
    pub fn is_near(&self, node: u32) -> bool {
        self.raster().near[node as usize]
    }

    /// Whether `point` touches no obstacle.
    pub fn is_free(&self, point: &Vec3) -> bool {
        !self.obstacles.iter().any(|obstacle| self.holds(obstacle, point))
    }

    /// The first obstacle that the segment touches on its way, the one listed first if several are met at once.
    pub fn first_hit(&self, segment: &Segment) -> Option<Hit> {
        let reach = Aabb::of_segment(segment);
        let mut first: Option<Hit> = None;
        for (obstacle, convex) in self.obstacles.iter().enumerate() {
            if !convex.aabb().overlaps(&reach) {
                continue;
            }
            if let Some(share) = self.entry(segment, convex)
                && first.is_none_or(|hit| share < hit.share)
            {
                first = Some(Hit { obstacle, share });
            }
        }
        first
    }

    /// Whether the segment touches no obstacle.
    pub fn is_clear(&self, segment: &Segment) -> bool {
        let reach = Aabb::of_segment(segment);
        !self
            .obstacles
            .iter()
            .any(|convex| convex.aabb().overlaps(&reach) && self.entry(segment, convex).is_some())
    }

    /// `point` as a start or goal, called `what` in the message.
    ///
    /// # Errors
    /// A sentence if it is no point in space, outside the domain, or in an obstacle.
    pub fn free_point(&self, what: &str, point: &[f64]) -> Result<Vec3, String> {
        let [x, y, z] = *point else {
            return Err(format!(
                "the {what} {point} is not a point in space; [x, y, z] is accepted",
                point = listed(point)
            ));
        };
        let at = Vec3::new(x, y, z);
        let (min, max) = (&self.domain.min, &self.domain.max);
        if !(0..3).all(|axis| (min[axis]..=max[axis]).contains(&at[axis])) {
            return Err(error::outside(what, &at, min, max));
        }
        match self.obstacles.iter().position(|obstacle| self.holds(obstacle, &at)) {
            Some(index) if self.growth > 0.0 => {
                let grown = format!("grown by {} cm", self.growth);
                Err(format!(
                    "the {what} {point} is inside obstacle {} {grown}",
                    index + 1,
                    point = listed(point)
                ))
            }
            Some(index) => {
                Err(format!("the {what} {point} is inside obstacle {}", index + 1, point = listed(point)))
            }
            None => Ok(at),
        }
    }
}

fn obstacle(index: usize, source: crate::geometry::GeometryError) -> PolyhedraError {
    PolyhedraError::Obstacle { index: index + 1, source }
}

/// `body` with every plane moved out by `growth`: corners stay sharp, and are farther from the body's than `growth`. Key
/// nodes lie on edges, which a true offset has none of.
fn grown(body: &Convex, growth: f64) -> Result<Convex, crate::geometry::GeometryError> {
    if growth == 0.0 {
        return Ok(body.clone());
    }
    let planes: Vec<(Vec3, f64)> =
        body.faces().iter().map(|face| (face.plane.normal, face.plane.offset + growth)).collect();
    Convex::from_planes(&planes)
}
