//! Judges joint paths of an arm whose body is rods, among convex solids: certified between configurations too.
//!
//! Frames come from products of 4 × 4 matrices, distances from parry. Between two configurations the joints move in
//! proportion; a stretch is free if the clearance at its middle is more than any point can move from there to its
//! ends, otherwise it is halved. A rod that comes nearer than [`FINEST_CM`] is refused, so nothing is accepted
//! unproved.

use super::polyhedra::{Point, Solid, distance, refuse_length};
use nalgebra::{Matrix4, Vector4};
use parry3d::math::{Pose, Vector};
use parry3d::query;
use parry3d::shape::Segment;

/// The clearance below which a rod counts as touching.
pub const FINEST_CM: f64 = 0.01;
/// How far the tip may be from start and goal.
const TIP_CM: f64 = 1e-5;
/// Beyond what rounding can do to a distance.
const ROUNDING_CM: f64 = 1e-6;

/// One row of a standard Denavit–Hartenberg table with the joint's limits; centimetres and radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Twist.
    pub alpha: f64,
    /// Length.
    pub a: f64,
    /// Offset along the axis.
    pub d: f64,
    /// Added to the joint angle.
    pub offset: f64,
    /// The least joint angle.
    pub lower: f64,
    /// The greatest joint angle.
    pub upper: f64,
}

/// A rod in the frame of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rod {
    /// The link; 0 is the base.
    pub link: usize,
    /// One end of its axis.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// Its radius.
    pub radius: f64,
}

/// An arm.
#[derive(Debug, Clone)]
pub struct Arm {
    /// The base in the world.
    pub base: Matrix4<f64>,
    /// The joints, base first.
    pub rows: [Row; 6],
    /// The tip in the last link's frame.
    pub tip: Point,
    /// The rods.
    pub rods: Vec<Rod>,
    /// How high the floor is, if there is one.
    pub floor: Option<f64>,
}

/// A query to be judged.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// The solids.
    pub solids: &'a [Solid],
    /// Where the tip starts.
    pub start: Point,
    /// Where it must end.
    pub goal: Point,
}

impl Arm {
    /// The base, the frame of each link, in the world.
    fn frames(&self, q: &[f64; 6]) -> [Matrix4<f64>; 7] {
        let mut frames = [self.base; 7];
        for (i, row) in self.rows.iter().enumerate() {
            frames[i + 1] = frames[i] * matrix(row, q[i]);
        }
        frames
    }

    /// Where the tip is.
    pub fn tip(&self, q: &[f64; 6]) -> Point {
        moved(&self.frames(q)[6], self.tip)
    }

    /// The distance from the rods' surfaces to the solids and the floor if it is at most `enough`; else anything that is more.
    fn clearance(&self, solids: &[Solid], q: &[f64; 6], enough: f64) -> f64 {
        let frames = self.frames(q);
        let mut least = f64::INFINITY;
        for rod in &self.rods {
            let [a, b] = [rod.from, rod.to].map(|end| moved(&frames[rod.link], end));
            if let Some(floor) = self.floor {
                least = least.min(a[2].min(b[2]) - floor - rod.radius);
            }
            let axis = Segment::new(Vector::new(a[0], a[1], a[2]), Vector::new(b[0], b[1], b[2]));
            for solid in solids {
                // What cannot be the least is not measured.
                if solid.keeps_at_least(a, b) - rod.radius > least.min(enough) + ROUNDING_CM {
                    continue;
                }
                let found = query::distance(&Pose::IDENTITY, &axis, &Pose::IDENTITY, solid.shape());
                let apart = found.expect("parry measures segments against convex polyhedra").distance;
                least = least.min(apart - rod.radius);
            }
        }
        least
    }

    /// For each joint, more than the distance from its axis to any point of the rods beyond it.
    fn reaches(&self) -> [f64; 6] {
        let size = |p: Point| distance(p, [0.0; 3]);
        let rods = |link: usize| {
            let on = self.rods.iter().filter(move |rod| rod.link == link);
            on.map(|rod| size(rod.from).max(size(rod.to)) + rod.radius).fold(0.0, f64::max)
        };
        std::array::from_fn(|joint| {
            let mut links = 0.0;
            let mut reach = 0.0_f64;
            for link in joint..6 {
                links += (self.rows[link].a.powi(2) + self.rows[link].d.powi(2)).sqrt();
                reach = reach.max(links + rods(link + 1));
            }
            reach
        })
    }
}

fn matrix(row: &Row, angle: f64) -> Matrix4<f64> {
    let (st, ct) = libm::sincos(angle + row.offset);
    let (sa, ca) = libm::sincos(row.alpha);
    Matrix4::new(
        ct,
        -st * ca,
        st * sa,
        row.a * ct, //
        st,
        ct * ca,
        -ct * sa,
        row.a * st, //
        0.0,
        sa,
        ca,
        row.d, //
        0.0,
        0.0,
        0.0,
        1.0,
    )
}

fn moved(frame: &Matrix4<f64>, p: Point) -> Point {
    let at = frame * Vector4::new(p[0], p[1], p[2], 1.0);
    [at.x, at.y, at.z]
}

impl Case<'_> {
    /// Why `path`, of claimed tip length `cost`, is not a path as claimed; `None` if it is.
    pub fn refuse_path(&self, path: &[Vec<f64>], cost: Option<f64>) -> Option<String> {
        let joints: Option<Vec<[f64; 6]>> = path.iter().map(|q| q.as_slice().try_into().ok()).collect();
        let Some(joints) = joints else { return Some("a configuration does not have six angles".to_owned()) };
        let (Some(first), Some(last)) = (joints.first(), joints.last()) else {
            return Some("a solved plan has no path".to_owned());
        };
        let off = distance(self.arm.tip(first), self.start).max(distance(self.arm.tip(last), self.goal));
        if off > TIP_CM {
            return Some(format!("the tip misses start or goal by {off} cm"));
        }
        for (index, q) in joints.iter().enumerate() {
            let allowed = |(row, angle): (&Row, &f64)| (row.lower..=row.upper).contains(angle);
            if let Some(joint) = self.arm.rows.iter().zip(q).position(|pair| !allowed(pair)) {
                return Some(format!("configuration {index}: joint {} is beyond its limits", joint + 1));
            }
        }
        let reaches = self.arm.reaches();
        let stretch = |pair: &[[f64; 6]]| self.refuse_stretch(&reaches, &pair[0], &pair[1]);
        if let Some((index, clearance)) =
            joints.windows(2).enumerate().find_map(|(index, pair)| Some((index, stretch(pair)?)))
        {
            return Some(format!("after configuration {index} a rod comes within {clearance:.4} cm"));
        }
        let tips: Vec<Point> = joints.iter().map(|q| self.arm.tip(q)).collect();
        refuse_length(&tips, cost, distance(self.start, self.goal))
    }

    /// The clearance of a configuration between `a` and `b` that is too near a solid; `None` if all are proved free.
    fn refuse_stretch(&self, reaches: &[f64; 6], a: &[f64; 6], b: &[f64; 6]) -> Option<f64> {
        let middle: [f64; 6] = std::array::from_fn(|i| f64::midpoint(a[i], b[i]));
        let sway: f64 = (0..6).map(|i| reaches[i] * (b[i] - a[i]).abs() / 2.0).sum();
        let clearance = self.arm.clearance(self.solids, &middle, sway.max(FINEST_CM));
        if clearance > sway {
            return None;
        }
        if clearance < FINEST_CM || sway < FINEST_CM / 4.0 {
            return Some(clearance);
        }
        self.refuse_stretch(reaches, a, &middle).or_else(|| self.refuse_stretch(reaches, &middle, b))
    }
}

#[cfg(test)]
mod tests;
