//! Judges paths of a point among convex polyhedra.
//!
//! The solids' planes come from parry's hull of their vertices, not from the planner's; a segment is clipped by
//! them. Solids are grown as the studies mean it, by moving their planes out, so that corners stay sharp. A path may touch a solid to within [`TOLERANCE_CM`], the room that two ways of rounding need.

use base::text::listed;
use parry3d::math::Vector;
use parry3d::shape::ConvexPolyhedron;

/// How deep a path may be in a solid, or how far an end or a length may be off.
pub const TOLERANCE_CM: f64 = 1e-7;

/// A point in space.
pub type Point = [f64; 3];

/// A convex solid by the planes behind which it lies.
#[derive(Debug, Clone)]
pub struct Solid {
    /// Unit normals out of the solid and offsets along them.
    planes: Vec<(Point, f64)>,
    shape: ConvexPolyhedron,
}

impl Solid {
    /// The hull of `vertices`; `None` if they enclose nothing.
    pub fn new(vertices: &[Point]) -> Option<Self> {
        let points: Vec<Vector> = vertices.iter().map(|&[x, y, z]| Vector::new(x, y, z)).collect();
        let shape = ConvexPolyhedron::from_convex_hull(&points)?;
        let plane = |normal: Vector| {
            let normal = [normal.x, normal.y, normal.z];
            let offset = vertices.iter().map(|v| dot(*v, normal)).fold(f64::NEG_INFINITY, f64::max);
            (normal, offset)
        };
        let planes = shape.faces().iter().map(|face| plane(face.normal)).collect();
        Some(Self { planes, shape })
    }

    /// The solid as parry knows it.
    pub(super) fn shape(&self) -> &ConvexPolyhedron {
        &self.shape
    }

    /// A length that the segment keeps from the solid at least, cheap to tell: how far both its ends are beyond that plane of the
    /// solid that parts them best.
    pub(super) fn keeps_at_least(&self, from: Point, to: Point) -> f64 {
        let beyond = |(normal, offset): &(Point, f64)| dot(from, *normal).min(dot(to, *normal)) - offset;
        self.planes.iter().map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether the segment comes deeper than the tolerance into the solid with its planes moved out by `growth`.
    fn is_entered(&self, from: Point, to: Point, growth: f64) -> bool {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (normal, offset) in &self.planes {
            let height = |point| dot(point, *normal) - offset - growth + TOLERANCE_CM;
            let (a, b) = (height(from), height(to));
            if a >= 0.0 && b >= 0.0 {
                return false;
            }
            if a > 0.0 {
                enter = enter.max(a / (a - b));
            } else if b > 0.0 {
                leave = leave.min(a / (a - b));
            }
        }
        enter <= leave
    }
}

/// A query to be judged.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    /// The solids.
    pub solids: &'a [Solid],
    /// By how much they are grown.
    pub growth: f64,
    /// The lower and the upper corner of where the point may be.
    pub domain: [Point; 2],
    /// The start.
    pub start: Point,
    /// The goal.
    pub goal: Point,
}

impl Case<'_> {
    /// Why `path`, of claimed length `cost`, is not a path as claimed; `None` if it is.
    pub fn refuse_path(&self, path: &[Vec<f64>], cost: Option<f64>) -> Option<String> {
        let points: Option<Vec<Point>> = path.iter().map(|p| p.as_slice().try_into().ok()).collect();
        let Some(points) = points else {
            return Some("a point of the path is not a point in space".to_owned());
        };
        if let Some(refusal) = self.refuse_ends(&points) {
            return Some(refusal);
        }
        if let Some(point) = points.iter().find(|point| !self.is_in_domain(**point)) {
            return Some(format!("the path leaves the domain at {point}", point = listed(point)));
        }
        for pair in points.windows(2) {
            let entered =
                self.solids.iter().position(|solid| solid.is_entered(pair[0], pair[1], self.growth));
            if let Some(index) = entered {
                return Some(format!(
                    "the segment from {} to {} enters obstacle {}",
                    listed(pair[0]),
                    listed(pair[1]),
                    index + 1
                ));
            }
        }
        refuse_length(&points, cost, distance(self.start, self.goal))
    }

    fn refuse_ends(&self, points: &[Point]) -> Option<String> {
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Some("a solved plan has no path".to_owned());
        };
        let off = distance(*first, self.start).max(distance(*last, self.goal));
        (off > TOLERANCE_CM).then(|| {
            format!(
                "the path goes from {first} to {last}, not from start to goal",
                first = listed(first),
                last = listed(last)
            )
        })
    }

    fn is_in_domain(&self, point: Point) -> bool {
        let [low, high] = self.domain;
        (0..3).all(|i| (low[i] - TOLERANCE_CM..=high[i] + TOLERANCE_CM).contains(&point[i]))
    }
}

/// Why the length claimed for the polyline through `points` cannot be, `straight` being the least there is.
pub(super) fn refuse_length(points: &[Point], cost: Option<f64>, straight: f64) -> Option<String> {
    let Some(claimed) = cost else { return Some("a solved plan claims no cost".to_owned()) };
    let length: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    let slack = TOLERANCE_CM * straight.max(1.0);
    if (claimed - length).abs() > slack {
        return Some(format!("the claimed cost is {claimed}, the path's length {length}"));
    }
    (length < straight - slack).then(|| format!("the length {length} is below the straight line {straight}"))
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    dot(d, d).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(center: Point, half: f64) -> Solid {
        let side = |i: usize, bit: usize| if i >> bit & 1 == 1 { half } else { -half };
        let corners: Vec<Point> =
            (0..8).map(|i| [0, 1, 2].map(|axis| center[axis] + side(i, axis))).collect();
        Solid::new(&corners).unwrap()
    }

    fn length(path: &[Vec<f64>]) -> f64 {
        let point = |p: &Vec<f64>| [p[0], p[1], p[2]];
        path.windows(2).map(|pair| distance(point(&pair[0]), point(&pair[1]))).sum()
    }

    #[test]
    fn a_path_round_a_cube_is_accepted_and_every_mutation_of_it_is_not() {
        let solids = [cube([5.0; 3], 1.0)];
        let domain = [[0.0; 3], [10.0; 3]];
        let case =
            Case { solids: &solids, growth: 0.5, domain, start: [5.0, 5.0, 1.0], goal: [5.0, 5.0, 9.0] };
        let path = vec![vec![5.0, 5.0, 1.0], vec![7.0, 5.0, 3.0], vec![7.0, 5.0, 7.0], vec![5.0, 5.0, 9.0]];
        assert_eq!(case.refuse_path(&path, Some(length(&path))), None);
        let refused = |path: &[Vec<f64>], cost: Option<f64>, part: &str| {
            let refusal = case.refuse_path(path, cost).expect(part);
            assert!(refusal.contains(part), "{refusal}");
        };
        for (at, axis, by, part) in [
            (0, 0, 1e-3, "not from start to goal"),
            (3, 2, -1e-3, "not from start to goal"),
            (1, 0, -0.6, "enters obstacle 1"),
            (2, 1, 9.0, "leaves the domain"),
        ] {
            let mut mutated = path.clone();
            mutated[at][axis] += by;
            refused(&mutated, Some(length(&mutated)), part);
        }
        refused(&path, Some(length(&path) - 1e-3), "claimed cost");
        refused(&path, None, "claims no cost");
        refused(&[], Some(0.0), "has no path");
        refused(&[path[0].clone(), path[3].clone()], Some(8.0), "enters obstacle 1");
        refused(
            &path[..2].iter().cloned().chain([vec![5.0]]).collect::<Vec<_>>(),
            Some(1.0),
            "point in space",
        );
    }

    #[test]
    fn gliding_along_a_face_is_touching_and_a_micrometre_deeper_is_not() {
        let solids = [cube([0.0; 3], 1.0)];
        let domain = [[-5.0; 3], [5.0; 3]];
        for (height, accepted) in [(1.0, true), (1.0 - 1e-4, false)] {
            let (start, goal) = ([-3.0, 0.2, height], [3.0, 0.2, height]);
            let case = Case { solids: &solids, growth: 0.0, domain, start, goal };
            let path = [start.to_vec(), goal.to_vec()];
            assert_eq!(case.refuse_path(&path, Some(6.0)).is_none(), accepted, "{height}");
        }
    }
}
