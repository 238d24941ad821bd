//! Judges paths of a planar arm's tip, continuously in joint space.
//!
//! Kinematics is written here once more, as products of rotation matrices, and the inverse by intersecting the circles that the
//! elbow lies on; distances are parry2d's. A hop is judged by the joints moving evenly between its postures, or by the tip moving
//! along the straight line ([`Hops`]). An interval of the motion is clear if no point of a link can reach what it is nearest to.
//! Otherwise it is halved, down to `RESOLUTION_CM`, below which contact is assumed.

mod body;
#[cfg(test)]
mod depth;
mod motion;
mod optimum;
#[cfg(test)]
mod tests;

pub use body::Body;

use base::grid::CornerRule;
use base::text::listed;

/// Gaps that are not proved to be wider than this are contact.
const RESOLUTION_CM: f64 = 1e-7;

/// How far a claimed length may be from the recomputed one, relative: room for another order of summation.
const LENGTH_TOLERANCE: f64 = 1e-9;

/// A query to be judged; lengths in centimetres, the arm's base at the origin.
#[derive(Debug, Clone)]
pub struct Case<'a> {
    /// Lengths of both links, the one at the base first.
    pub links_cm: [f64; 2],
    /// Whether the posture with the higher elbow is taken, instead of the one that bends clockwise.
    pub higher_elbow: bool,
    /// The lower left point of the lattice.
    pub low_cm: [f64; 2],
    /// How far lattice points are apart.
    pub step_cm: f64,
    /// Columns and rows.
    pub size: [u32; 2],
    /// Points nearer to the base are forbidden.
    pub inner_radius_cm: f64,
    /// Whether touching an obstacle is contact.
    pub touching_is_contact: bool,
    /// Which diagonal hops of one cell are refused.
    pub corner_rule: CornerRule,
    /// How far joint 2 turns to either side; infinite without stops.
    pub q2_limit_rad: f64,
    /// What decides whether a hop may be made.
    pub hops: Hops,
    /// The obstacles.
    pub bodies: Vec<Body>,
    /// The start.
    pub start: &'a [f64],
    /// The goal.
    pub goal: &'a [f64],
}

/// What decides whether a hop between two points where the arm may stand may be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hops {
    /// Nothing; audits still tell which are unsafe, by joints that move evenly.
    EndPoints,
    /// The joints move evenly and the arm must be clear all the way.
    EvenJoints,
    /// The tip moves along the straight line, the arm bent to one side; it must be clear all the way, and no nearer to the
    /// base than points may be.
    TipLine,
}

/// What a planner claims.
#[derive(Debug, Clone, Copy)]
pub struct Answer<'a> {
    /// Points from start to goal, centimetres.
    pub path: &'a [Vec<f64>],
    /// The claimed length.
    pub cost: Option<f64>,
    /// Steps that the path may be made of, in columns and rows; any if absent.
    pub steps: Option<&'a [[i32; 2]]>,
    /// The length must be the least there is with these steps.
    pub optimal: bool,
}

/// What was found about a path that is as claimed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Audit {
    /// Its length.
    pub length_cm: f64,
    /// Hops during which the arm hits an obstacle.
    pub unsafe_hops: u64,
    /// How deep a link goes into an obstacle during them, to a micrometre; 0 without any.
    pub deepest_cm: f64,
    /// How far each joint turns in all.
    pub joint_travel_deg: [f64; 2],
    /// The farthest that a joint turns in one hop.
    pub largest_joint_step_deg: f64,
    /// The least length with the claimed steps, if it had to be found.
    pub optimal_cm: Option<f64>,
}

impl Case<'_> {
    /// What `answer` amounts to.
    ///
    /// # Errors
    /// Why it is not a path as claimed.
    pub fn audit(&self, answer: &Answer<'_>) -> Result<Audit, String> {
        let points: Option<Vec<[i32; 2]>> = answer.path.iter().map(|point| self.point(point)).collect();
        let points = points.ok_or("a point of the path is not a point of the lattice")?;
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Err("the path is empty".to_owned());
        };
        if (Some(*first), Some(*last)) != (self.point(self.start), self.point(self.goal)) {
            let [first, last] = [first, last].map(|point| listed(self.at(*point)));
            return Err(format!("the path goes from {first} to {last}, not from start to goal"));
        }
        let mut postures = Vec::new();
        for point in &points {
            let free = self.free_posture(*point);
            postures
                .push(free.ok_or_else(|| format!("the arm may not stand at {}", listed(self.at(*point))))?);
        }
        let mut joint_travel_deg = [0.0; 2];
        let mut largest_joint_step_deg = 0.0_f64;
        let mut unsafe_hops = 0;
        let mut deepest_cm = 0.0_f64;
        for (pair, postures) in points.windows(2).zip(postures.windows(2)) {
            self.refuse_step(pair, answer.steps).map_or(Ok(()), Err)?;
            let by = turned(postures[0], postures[1]);
            for (travel, turn) in joint_travel_deg.iter_mut().zip(by) {
                *travel += turn.abs().to_degrees();
                largest_joint_step_deg = largest_joint_step_deg.max(turn.abs().to_degrees());
            }
            if let Some(depth_cm) = self.hit(pair, postures)? {
                unsafe_hops += 1;
                deepest_cm = deepest_cm.max(depth_cm);
            }
        }
        let (length_cm, optimal_cm) = self.judged_length(answer, &points)?;
        Ok(Audit { length_cm, unsafe_hops, deepest_cm, joint_travel_deg, largest_joint_step_deg, optimal_cm })
    }

    /// How deep the arm hits an obstacle during a hop, if it does.
    fn hit(&self, pair: &[[i32; 2]], postures: &[[f64; 2]]) -> Result<Option<f64>, String> {
        let [from, to] = [self.at(pair[0]), self.at(pair[1])];
        let motion = self.motion([pair[0], pair[1]], [postures[0], postures[1]]).ok_or_else(|| {
            format!(
                "the tip cannot go straight from {from} to {to}: the arm jumps or comes too near to its base",
                from = listed(from),
                to = listed(to)
            )
        })?;
        match self.is_clear(&motion) {
            true => Ok(None),
            false if self.hops == Hops::EndPoints => Ok(Some(self.depth_cm(&motion))),
            false => Err(format!(
                "the arm hits an obstacle between {from} and {to}",
                from = listed(from),
                to = listed(to)
            )),
        }
    }

    /// Why a claim that there is no path with `steps` is wrong; `None` if it is right.
    pub fn refuse_no_path(&self, steps: &[[i32; 2]]) -> Option<String> {
        let found = self.optimal_length(steps)?;
        Some(format!("no path is claimed where the verifier finds one of {found} cm"))
    }

    fn refuse_step(&self, pair: &[[i32; 2]], steps: Option<&[[i32; 2]]>) -> Option<String> {
        let step = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let (from, to) = (self.at(pair[0]), self.at(pair[1]));
        if step == [0, 0] {
            return Some(format!("the path stands still at {from}", from = listed(from)));
        }
        if steps.is_some_and(|steps| !steps.contains(&step)) {
            return Some(format!(
                "the hop from {from} to {to} is none of the planner's",
                from = listed(from),
                to = listed(to)
            ));
        }
        (!self.corner_is_free(pair[0], step)).then(|| {
            format!(
                "the hop from {from} to {to} cuts a corner, which the corner rule forbids",
                from = listed(from),
                to = listed(to)
            )
        })
    }

    fn judged_length(&self, answer: &Answer<'_>, points: &[[i32; 2]]) -> Result<(f64, Option<f64>), String> {
        let length = |pair: &[[i32; 2]]| self.length([pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]]);
        let length_cm: f64 = points.windows(2).map(length).sum();
        let near = |a: f64, b: f64| (a - b).abs() <= LENGTH_TOLERANCE * b.max(1.0);
        let claimed = answer.cost.ok_or("a solved plan claims no length")?;
        if !near(claimed, length_cm) {
            return Err(format!("the claimed length is {claimed} cm, the path's {length_cm} cm"));
        }
        let (first, last) = (points[0], points[points.len() - 1]);
        let straight = self.length([last[0] - first[0], last[1] - first[1]]);
        if length_cm < straight && !near(length_cm, straight) {
            return Err(format!("the length {length_cm} cm is below the straight line {straight} cm"));
        }
        let Some(steps) = answer.steps.filter(|_| answer.optimal) else { return Ok((length_cm, None)) };
        let optimal = self.optimal_length(steps).ok_or("a path is claimed where the verifier finds none")?;
        if near(length_cm, optimal) {
            Ok((length_cm, Some(optimal)))
        } else {
            Err(format!("the length {length_cm} cm is not the optimum {optimal} cm"))
        }
    }

    fn length(&self, [dx, dy]: [i32; 2]) -> f64 {
        let [dx, dy] = [dx, dy].map(|d| f64::from(d) * self.step_cm);
        (dx * dx + dy * dy).sqrt()
    }

    fn at(&self, [column, row]: [i32; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.low_cm[axis] + self.step_cm * f64::from([column, row][axis]))
    }

    fn point(&self, point: &[f64]) -> Option<[i32; 2]> {
        let index = |axis: usize| {
            let steps = (point[axis] - self.low_cm[axis]) / self.step_cm;
            let nearest = steps.round();
            ((steps - nearest).abs() < 1e-6 && (0.0..f64::from(self.size[axis])).contains(&nearest))
                .then_some(nearest as i32)
        };
        (point.len() == 2).then(|| Some([index(0)?, index(1)?]))?
    }
}

/// By how much each joint turns from one posture to the other, the shorter way round.
fn turned(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|joint| {
        let (s, c) = libm::sincos(to[joint] - from[joint]);
        libm::atan2(s, c)
    })
}
