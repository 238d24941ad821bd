//! The planar arm over a lattice of tip positions, among obstacles.
//!
//! The base is the origin; lengths are centimetres, angles radians. A state is a lattice point at which the tip stands, with the
//! one posture that the elbow rule names. It is free if the arm reaches it outside of the inner radius and if both links (without
//! width) and the tip are clear of every obstacle; what touching is, the world says ([`Touch`]). A motion is a hop between two
//! free states. Its end points alone are looked at, or both links are swept while the joints move evenly from one posture to the
//! other or the tip moves along the straight line ([`HopRule`]).

mod hops;
mod lattice;
mod obstacle;
mod sweep;
#[cfg(test)]
mod tests;
mod tip_line;

pub use lattice::TipLattice;
pub use obstacle::Obstacle;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::geometry::Vec2;
use crate::geometry::planar::{Segment2, Touch};
use crate::kinematics::planar_2r::{ElbowRule, Planar2r};
use base::grid::{Columns, CornerRule, Grid2};
use base::text::listed;
use hops::Hops;
use sweep::Sweep;
use tip_line::TipLine;

/// What decides whether a hop between free states is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HopRule {
    /// Nothing: free end points make a free hop, whatever lies between.
    EndPoints,
    /// The joints move evenly from one posture to the other and both links must stay clear all the way.
    Continuous,
    /// The tip moves along the straight line between its points, the arm bent to one side; both links must stay clear, and
    /// the tip may come no nearer to the base than points may lie.
    TipLine,
}

/// Everything about a workspace but its obstacles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmRules {
    /// The arm, in centimetres.
    pub arm: Planar2r,
    /// Which of the two postures is taken.
    pub elbow: ElbowRule,
    /// Where the tip may stand.
    pub lattice: TipLattice,
    /// Points nearer to the base than this are forbidden.
    pub inner_radius_cm: f64,
    /// How far joint 2 turns to either side; infinite without stops.
    pub q2_limit_rad: f64,
    /// Whether touching an obstacle is contact.
    pub touch: Touch,
    /// Which diagonal hops of one cell are refused for the cells that flank them.
    pub corner_rule: CornerRule,
    /// Which hops are free.
    pub hop: HopRule,
}

impl ArmRules {
    /// How near to the base the tip may come.
    pub fn nearest_cm(&self) -> f64 {
        let [l1, l2] = self.arm.links();
        let [inner, _] = self.arm.reach();
        let squared = l1 * l1 + l2 * l2 + 2.0 * l1 * l2 * libm::cos(self.q2_limit_rad);
        let is_stopped = self.q2_limit_rad < std::f64::consts::PI;
        self.inner_radius_cm.max(if is_stopped { squared.max(0.0).sqrt() } else { inner })
    }
}

/// What a lattice point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zone {
    /// The tip may stand here.
    Free,
    /// Farther away than the arm is long.
    OuterReach,
    /// Within the inner radius, or nearer to the base than the arm can fold or its stops let it.
    InnerReach,
    /// Inside an obstacle.
    Obstacle,
    /// Clear itself, but a link would hit an obstacle.
    Link,
}

/// A workspace, analysed point by point.
#[derive(Debug)]
pub struct ArmWorld {
    rules: ArmRules,
    obstacles: Vec<Obstacle>,
    zones: Vec<Zone>,
    postures: Vec<[f64; 2]>,
    clearances_cm: Vec<f64>,
    grid: Grid2,
    /// The free cells of the grid as bits.
    columns: Box<Columns>,
    /// The hops that were looked at, unless every hop between free cells may be made.
    hops: Option<Hops>,
}

impl ArmWorld {
    /// Analyses every lattice point.
    pub fn new(rules: ArmRules, obstacles: Vec<Obstacle>) -> Self {
        let mut grid = rules.lattice.grid();
        let mut zones = Vec::new();
        let mut postures = Vec::new();
        for cell in 0..grid.cell_count() {
            let (zone, posture) = analysed(&rules, &obstacles, &rules.lattice.point(cell));
            grid.set_blocked(cell, zone != Zone::Free);
            zones.push(zone);
            postures.push(posture.unwrap_or([f64::NAN; 2]));
        }
        let sweep = Sweep { arm: &rules.arm, obstacles: &obstacles, touch: rules.touch };
        let clearance = |cell: u32| match rules.hop {
            HopRule::Continuous if grid.is_free(cell) => sweep.clearance(postures[cell as usize]),
            HopRule::Continuous | HopRule::EndPoints | HopRule::TipLine => 0.0,
        };
        let clearances_cm = (0..grid.cell_count()).map(clearance).collect();
        let any_hop = rules.hop == HopRule::EndPoints && rules.corner_rule == CornerRule::Allow;
        let hops = (!any_hop).then(|| Hops::new(grid.cell_count()));
        let columns = Box::new(Columns::new(&grid));
        Self { rules, obstacles, zones, postures, clearances_cm, grid, columns, hops }
    }

    /// Everything but the obstacles.
    pub fn rules(&self) -> &ArmRules {
        &self.rules
    }

    /// The obstacles.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// The lattice with every point blocked that is not free.
    pub fn grid(&self) -> &Grid2 {
        &self.grid
    }

    /// The free cells of [`grid`](Self::grid) as bits.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// What each lattice point is, by cell.
    pub fn zones(&self) -> &[Zone] {
        &self.zones
    }

    /// The joint angles with the tip on `cell`, `[q1, q2]`; NaN where the arm does not reach.
    pub fn posture(&self, cell: u32) -> [f64; 2] {
        self.postures[cell as usize]
    }

    /// Whether the hop between two free cells may be made.
    pub fn may_hop(&self, from: u32, to: u32) -> bool {
        let [[x, y], [to_x, to_y]] = [self.grid.xy(from), self.grid.xy(to)];
        self.may_step(from, [to_x - x, to_y - y])
    }

    /// Whether the hop by `step` cells, `[dx, dy]`, from one free cell to another may be made.
    #[inline]
    pub fn may_step(&self, from: u32, step: [i32; 2]) -> bool {
        self.hops.as_ref().is_none_or(|hops| hops.is_free(from, step, |step| self.is_step_free(from, step)))
    }

    /// Those of the `free` cells of the column `dx` from a free cell to which a hop may be made; bit `i` is the cell
    /// `reach - i` rows up.
    #[inline]
    pub fn hops(&self, from: u32, dx: i32, reach: i32, free: u64) -> u64 {
        if self.hops.is_none() { free } else { self.checked_hops(from, dx, reach, free) }
    }

    fn checked_hops(&self, from: u32, dx: i32, reach: i32, free: u64) -> u64 {
        let find = |step| self.is_step_free(from, step);
        self.hops.as_ref().map_or(free, |hops| hops.free(from, dx, reach, free, find))
    }

    fn is_step_free(&self, from: u32, [dx, dy]: [i32; 2]) -> bool {
        let [x, y] = self.grid.xy(from);
        let flanks = || [self.grid.is_free_xy(x + dx, y), self.grid.is_free_xy(x, y + dy)];
        if dx.abs() == 1 && dy.abs() == 1 && !self.rules.corner_rule.permits(flanks()) {
            return false;
        }
        let to = from.wrapping_add_signed(dy * self.grid.width() as i32 + dx);
        self.rules.hop == HopRule::EndPoints || self.is_swept_free(from, to)
    }

    fn is_swept_free(&self, from: u32, to: u32) -> bool {
        let Self { rules, obstacles, .. } = self;
        let sweep = Sweep { arm: &rules.arm, obstacles, touch: rules.touch };
        if rules.hop == HopRule::TipLine {
            let tips = [from, to].map(|cell| rules.lattice.point(cell));
            let line = TipLine::new(tips, [self.posture(from), self.posture(to)]);
            return line.is_some_and(|line| !line.dips_below(rules.nearest_cm()) && sweep.is_line_free(line));
        }
        let clearances_cm = [from, to].map(|cell| self.clearances_cm[cell as usize]);
        sweep.is_free(self.posture(from), self.posture(to), clearances_cm)
    }

    /// The free cell at `point` = [x, y], centimetres.
    ///
    /// # Errors
    /// A sentence about `what` (start or goal): no lattice point, or forbidden and why.
    pub fn free_cell(&self, what: &str, point: &[f64]) -> Result<u32, String> {
        let cell = self.rules.lattice.cell(point).ok_or_else(|| {
            format!(
                "the {what} {point} is not a point of the workspace; {}",
                self.rules.lattice,
                point = listed(point)
            )
        })?;
        let at = self.rules.lattice.point(cell);
        let [_, outer] = self.rules.arm.reach();
        match self.zones[cell as usize] {
            Zone::Free => Ok(cell),
            Zone::OuterReach | Zone::InnerReach => Err(format!(
                "the {what} {point} is {:.4} cm from the base; the arm may stand from {} to {outer} cm",
                at.norm(),
                self.rules.nearest_cm(),
                point = listed(point)
            )),
            Zone::Obstacle => {
                Err(format!("the {what} {point} lies in {}", self.culprit(&at), point = listed(point)))
            }
            Zone::Link => Err(format!(
                "with the tip on the {what} {point} a link hits an obstacle",
                point = listed(point)
            )),
        }
    }

    fn culprit(&self, tip: &Vec2) -> String {
        let found = self.obstacles.iter().position(|obstacle| obstacle.holds(tip, self.rules.touch));
        found.map_or_else(|| "an obstacle".to_owned(), |index| format!("obstacle {}", index + 1))
    }
}

/// What the point at `tip` is, and the posture that reaches it, if any does.
fn analysed(rules: &ArmRules, obstacles: &[Obstacle], tip: &Vec2) -> (Zone, Option<[f64; 2]>) {
    let Ok(branches) = rules.arm.inverse(tip) else {
        let is_outer = tip.norm() > rules.arm.reach()[1];
        return (if is_outer { Zone::OuterReach } else { Zone::InnerReach }, None);
    };
    let posture = rules.arm.pick(&branches, rules.elbow);
    let is_too_near = tip.norm_squared() < rules.inner_radius_cm * rules.inner_radius_cm;
    let zone = if is_too_near || posture[1].abs() > rules.q2_limit_rad {
        Zone::InnerReach
    } else if obstacles.iter().any(|obstacle| obstacle.holds(tip, rules.touch)) {
        Zone::Obstacle
    } else {
        let elbow = rules.arm.elbow(posture);
        let links = [Segment2::new(Vec2::zeros(), elbow), Segment2::new(elbow, *tip)];
        let is_hit = |obstacle: &Obstacle| links.iter().any(|link| obstacle.meets(link, rules.touch));
        if obstacles.iter().any(is_hit) { Zone::Link } else { Zone::Free }
    };
    (zone, Some(posture))
}
