//! Contacts by parry3d, where it is exact: segments against boxes, polyhedra and points. Capsules against capsules are
//! reduced to segments here, whose distance is the least of five candidates.

use super::chain::Frames;
use super::{Angles, Chain};
use nalgebra::{Matrix4, Vector3, Vector4};
use parry3d::bounding_volume::{Aabb, BoundingVolume as _};
use parry3d::math::{Pose, Vector};
use parry3d::query;
use parry3d::shape::{ConvexPolyhedron, Cuboid, Segment, SharedShape};

/// What may be missing from a gap by rounding: metres.
const ROUNDING_M: f64 = 1e-7;

/// One capsule of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The link it is fixed to; 0 is the base.
    pub link: usize,
    /// One end of its axis in the link's frame.
    pub from_m: [f64; 3],
    /// The other end.
    pub to_m: [f64; 3],
    /// Its radius.
    pub radius_m: f64,
    /// Whether the scene can touch it.
    pub exposed: bool,
}

/// The robot's capsules and which of them must stay apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The capsules.
    pub parts: Vec<Part>,
    /// Pairs by index.
    pub pairs: Vec<[usize; 2]>,
}

/// One obstacle.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// All points within a radius of a segment; a ball if its ends coincide.
    Round([f64; 3], [f64; 3], f64),
    /// A box: its frame at its middle, and half its sides.
    Box(Matrix4<f64>, [f64; 3]),
    /// The hull of points.
    Hull(Vec<[f64; 3]>),
    /// All points whose product with the unit vector is at most the number.
    Behind([f64; 3], f64),
}

/// What a segment is measured against.
enum Still {
    Solid(Pose, SharedShape, Aabb),
    Round(Segment, f64),
    Behind(Vector3<f64>, f64),
}

impl std::fmt::Debug for Still {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Solid(..) => "solid",
            Self::Round(..) => "round",
            Self::Behind(..) => "behind",
        })
    }
}

/// The robot's body and what it must not touch.
#[derive(Debug)]
pub(super) struct Obstacles {
    body: Body,
    stills: Vec<Still>,
}

fn vector(v: &[f64; 3]) -> Vector {
    Vector::new(v[0], v[1], v[2])
}

fn solid(at: Pose, shape: SharedShape) -> Still {
    let bounds = shape.compute_aabb(&at);
    Still::Solid(at, shape, bounds)
}

impl Obstacles {
    pub(super) fn new(body: Body, shapes: &[Shape]) -> Self {
        let still = |shape: &Shape| match shape {
            Shape::Round(a, b, radius_m) => Still::Round(Segment::new(vector(a), vector(b)), *radius_m),
            Shape::Behind(normal, offset_m) => Still::Behind(Vector3::from(*normal), *offset_m),
            Shape::Box(frame, half_m) => solid(pose(frame), SharedShape::new(Cuboid::new(vector(half_m)))),
            Shape::Hull(points) => {
                let points: Vec<Vector> = points.iter().map(vector).collect();
                let hull = ConvexPolyhedron::from_convex_hull(&points).expect("a scene's hulls were checked");
                solid(Pose::IDENTITY, SharedShape::new(hull))
            }
        };
        Self { body, stills: shapes.iter().map(still).collect() }
    }

    /// What the robot touches at `q`, which puts its links at `frames`, or which joint is outside its limits.
    pub(super) fn refusal(&self, chain: &Chain, q: &Angles, frames: &Frames) -> Option<String> {
        if let Some(refusal) = chain.limits_refusal(q) {
            return Some(refusal);
        }
        let axis = |part: &Part| {
            let [a, b] = [part.from_m, part.to_m].map(|p| {
                let placed = frames[part.link] * Vector4::new(p[0], p[1], p[2], 1.0);
                Vector::new(placed.x, placed.y, placed.z)
            });
            Segment::new(a, b)
        };
        let axes: Vec<Segment> = self.body.parts.iter().map(axis).collect();
        let parts = self.body.parts.iter().enumerate();
        for (index, part) in parts.filter(|(_, part)| part.exposed) {
            let axis = &axes[index];
            let reach_m = part.radius_m - ROUNDING_M;
            let bounds = Aabb::new(axis.a.min(axis.b), axis.a.max(axis.b));
            let is_hit = |still: &Still| is_within(axis, &bounds, still, reach_m);
            if let Some(hit) = self.stills.iter().position(is_hit) {
                return Some(format!("part {} touches obstacle {}", index + 1, hit + 1));
            }
        }
        let touching = self.body.pairs.iter().find(|[a, b]| {
            let reach_m = self.body.parts[*a].radius_m + self.body.parts[*b].radius_m - ROUNDING_M;
            !are_far(&axes[*a], &axes[*b], reach_m) && segments_m(&axes[*a], &axes[*b]) < reach_m
        });
        touching.map(|[a, b]| format!("part {} touches part {}", a + 1, b + 1))
    }
}

fn pose(frame: &Matrix4<f64>) -> Pose {
    // A box turns about the vertical or not at all in a scene file, but any rotation is read here.
    let r = frame.fixed_view::<3, 3>(0, 0);
    let columns = [0, 1, 2].map(|i| parry3d::math::Vector::new(r[(0, i)], r[(1, i)], r[(2, i)]));
    let rotation = parry3d::math::Matrix::from_cols(columns[0], columns[1], columns[2]);
    Pose::from_parts(
        Vector::new(frame[(0, 3)], frame[(1, 3)], frame[(2, 3)]),
        parry3d::math::Rotation::from_mat3(&rotation),
    )
}

/// Whether an axis, which lies in `bounds`, is nearer to something still than `reach_m`.
fn is_within(axis: &Segment, bounds: &Aabb, still: &Still, reach_m: f64) -> bool {
    match still {
        Still::Behind(normal, offset_m) => {
            let height = |p: Vector| normal.x * p.x + normal.y * p.y + normal.z * p.z - offset_m;
            height(axis.a).min(height(axis.b)) < reach_m
        }
        Still::Round(other, radius_m) => segments_m(axis, other) < reach_m + radius_m,
        Still::Solid(at, shape, about) => {
            let gap_m =
                || query::distance(&Pose::IDENTITY, axis, at, &**shape).expect("parry knows these shapes");
            about.loosened(reach_m.max(0.0)).intersects(bounds) && gap_m().distance < reach_m
        }
    }
}

/// Whether the balls about two segments are surely further apart than `reach_m`: most pairs are, and need no distance.
fn are_far(p: &Segment, q: &Segment, reach_m: f64) -> bool {
    let apart_m = ((p.a + p.b) - (q.a + q.b)).length();
    apart_m > (p.b - p.a).length() + (q.b - q.a).length() + 2.0 * (reach_m + ROUNDING_M)
}

/// The distance between two segments: of an end to the other segment, or between points inside both.
fn segments_m(p: &Segment, q: &Segment) -> f64 {
    let to_segment = |point: Vector, s: &Segment| {
        let d = s.b - s.a;
        let share = if d.length_squared() > 0.0 { (point - s.a).dot(d) / d.length_squared() } else { 0.0 };
        (point - (s.a + d * share.clamp(0.0, 1.0))).length()
    };
    let ends = [to_segment(p.a, q), to_segment(p.b, q), to_segment(q.a, p), to_segment(q.b, p)];
    let least = ends.into_iter().fold(f64::INFINITY, f64::min);
    let (u, v, w) = (p.b - p.a, q.b - q.a, p.a - q.a);
    let normal = u.cross(v);
    if normal.length_squared() <= 1e-18 * u.length_squared() * v.length_squared() {
        return least;
    }
    let n2 = normal.length_squared();
    let (s, t) = (v.cross(w).dot(normal) / n2, u.cross(w).dot(normal) / n2);
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        least.min(w.dot(normal).abs() / normal.length())
    } else {
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;

    #[test]
    fn segments_that_are_far_are_no_nearer_than_their_reach() {
        let mut stream = seed::stream(61);
        let mut far = 0;
        let mut others = 0;
        for index in 0..200_000 {
            let mut point = || Vector::from([0; 3].map(|_| stream.random_range(-1.0..1.0)));
            let p = Segment::new(point(), point());
            let apart = point();
            // One in three is parallel to the other, one in three goes on where the other ends.
            let q = match index % 3 {
                0 => Segment::new(p.a + apart, p.b + apart),
                1 => Segment::new(p.b + (p.b - p.a) * 0.3, p.b + (p.b - p.a)),
                _ => Segment::new(apart, point()),
            };
            // As far as they are, or somewhat less or more.
            let reach_m = segments_m(&p, &q) * [1.0, 1.0 - 1e-9, 0.9, 0.3, 1.1][index % 5];
            let is_far = are_far(&p, &q, reach_m);
            assert!(!is_far || segments_m(&p, &q) >= reach_m, "seed 61 case {index}: {p:?} {q:?} {reach_m}");
            (far, others) = (far + u32::from(is_far), others + u32::from(!is_far));
        }
        assert!(far > 20_000 && others > 20_000, "one-sided sample: {far} far, {others} not");
    }
}
