//! Contact of any two convex solids that are points and a radius: spheres, boxes, cylinders as prisms, hulls of meshes.
//!
//! The exact distances elsewhere on this floor know a few shapes and are fast; this knows all and iterates.
//!
//! # Source
//! Gilbert, Johnson and Keerthi, IEEE J. Robotics and Automation 4(2), 1988; the nearest points of triangles and tetrahedra as in
//! Ericson, *Real-Time Collision Detection* (2005), sections 5.1.5 and 5.1.6.

use super::{Frame, Vec3};

/// How near two solids may be without touching: what rounding leaves of a distance, metres.
const TOUCH_M: f64 = 1e-9;

/// Rounds before two solids that cannot be distinguished count as touching.
const ROUNDS: usize = 64;

/// All points within a radius of the convex hull of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Rounded {
    points: Vec<Vec3>,
    radius: f64,
    /// The middle of the points, and how far from it the solid reaches.
    ball: (Vec3, f64),
}

impl Rounded {
    /// The solid of these points, at least one.
    pub fn new(points: Vec<Vec3>, radius: f64) -> Self {
        let low = points.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = points.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let middle = (low + high) * 0.5;
        let reach = points.iter().map(|point| (point - middle).norm()).fold(0.0, f64::max);
        Self { points, radius, ball: (middle, reach + radius) }
    }

    /// The points.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// How far around their hull the solid reaches.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The point that is farthest in a direction.
    fn farthest(&self, direction: &Vec3) -> Vec3 {
        let mut best = (f64::NEG_INFINITY, Vec3::zeros());
        for point in &self.points {
            let height = point.dot(direction);
            if height > best.0 {
                best = (height, *point);
            }
        }
        best.1
    }
}

/// A solid where a frame puts it.
#[derive(Debug, Clone, Copy)]
pub struct Placed<'a> {
    /// The solid in its own frame.
    pub solid: &'a Rounded,
    /// Where that frame is.
    pub frame: &'a Frame,
}

impl Placed<'_> {
    fn farthest(&self, direction: &Vec3) -> Vec3 {
        self.frame.point(&self.solid.farthest(&self.frame.rotation.tr_mul(direction)))
    }
}

/// Whether two solids share a point; touching is sharing.
pub fn intersects_placed_placed(a: &Placed<'_>, b: &Placed<'_>) -> bool {
    let reach = a.solid.radius + b.solid.radius + TOUCH_M;
    let [middle_a, middle_b] = [a, b].map(|one| one.frame.point(&one.solid.ball.0));
    if (middle_a - middle_b).norm() > a.solid.ball.1 + b.solid.ball.1 + TOUCH_M {
        return false;
    }
    // The point nearest to the origin of what was seen so far of all differences of a point of `a` and one of `b`.
    let mut nearest = middle_a - middle_b;
    let mut corners: Vec<Vec3> = Vec::with_capacity(4);
    for _ in 0..ROUNDS {
        let distance = nearest.norm();
        if distance <= reach && !corners.is_empty() || distance == 0.0 {
            return true;
        }
        let next = a.farthest(&-nearest) - b.farthest(&nearest);
        // No difference is nearer than this.
        if nearest.dot(&next) > reach * distance {
            return false;
        }
        let is_known = corners.iter().any(|corner| (corner - next).norm_squared() <= 1e-24);
        if is_known || (distance * distance - nearest.dot(&next)).abs() <= 1e-13 * distance * distance {
            return distance <= reach;
        }
        corners.push(next);
        nearest = nearest_of(&mut corners);
    }
    true
}

/// The point of the hull of one to four corners that is nearest to the origin; corners that are not needed for it go.
fn nearest_of(corners: &mut Vec<Vec3>) -> Vec3 {
    let (point, kept) = match corners[..] {
        [a] => (a, vec![a]),
        [a, b] => of_segment(a, b),
        [a, b, c] => of_triangle(a, b, c),
        [a, b, c, d] => of_tetrahedron([a, b, c, d]),
        _ => unreachable!("one to four corners are kept"),
    };
    *corners = kept;
    point
}

fn of_segment(a: Vec3, b: Vec3) -> (Vec3, Vec<Vec3>) {
    let along = b - a;
    let share = -a.dot(&along) / along.norm_squared();
    if share <= 0.0 {
        (a, vec![a])
    } else if share >= 1.0 {
        (b, vec![b])
    } else {
        (a + along * share, vec![a, b])
    }
}

fn of_triangle(a: Vec3, b: Vec3, c: Vec3) -> (Vec3, Vec<Vec3>) {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (-ab.dot(&a), -ac.dot(&a));
    let (d3, d4) = (-ab.dot(&b), -ac.dot(&b));
    let (d5, d6) = (-ab.dot(&c), -ac.dot(&c));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if va > 0.0 && vb > 0.0 && vc > 0.0 {
        let sum = va + vb + vc;
        return (a + ab * (vb / sum) + ac * (vc / sum), vec![a, b, c]);
    }
    // Outside, or the corners are on a line: the nearest point is on a side.
    best([of_segment(a, b), of_segment(b, c), of_segment(a, c)])
}

fn of_tetrahedron([a, b, c, d]: [Vec3; 4]) -> (Vec3, Vec<Vec3>) {
    let faces = [[a, b, c, d], [a, b, d, c], [a, c, d, b], [b, c, d, a]];
    let is_outside = |[p, q, r, other]: &[Vec3; 4]| {
        let normal = (q - p).cross(&(r - p));
        let inner = normal.dot(&(other - p));
        let origin = -normal.dot(p);
        // A flat tetrahedron has no inside.
        inner * origin <= 0.0 || inner.abs() <= 1e-14 * normal.norm() * (other - p).norm()
    };
    let outside: Vec<_> = faces.iter().filter(|face| is_outside(face)).collect();
    if outside.is_empty() {
        return (Vec3::zeros(), vec![a, b, c, d]);
    }
    best(outside.into_iter().map(|[p, q, r, _]| of_triangle(*p, *q, *r)))
}

fn best(candidates: impl IntoIterator<Item = (Vec3, Vec<Vec3>)>) -> (Vec3, Vec<Vec3>) {
    let mut best: Option<(Vec3, Vec<Vec3>)> = None;
    for candidate in candidates {
        if best.as_ref().is_none_or(|(point, _)| candidate.0.norm_squared() < point.norm_squared()) {
            best = Some(candidate);
        }
    }
    best.expect("a triangle has sides and a tetrahedron faces")
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use parry3d::math::{Matrix, Pose, Rotation, Vector};
    use parry3d::query;
    use parry3d::shape::ConvexPolyhedron;
    use rand::RngExt as _;

    fn pose(frame: &Frame) -> Pose {
        let column = |i| Vector::new(frame.rotation[(0, i)], frame.rotation[(1, i)], frame.rotation[(2, i)]);
        let turned = Rotation::from_mat3(&Matrix::from_cols(column(0), column(1), column(2)));
        Pose::from_parts(Vector::new(frame.origin.x, frame.origin.y, frame.origin.z), turned)
    }

    #[test]
    fn contact_is_where_another_library_finds_no_distance() {
        let mut stream = seed::stream(31);
        let mut apart = [0, 0];
        for case in 0..3000 {
            let mut draw = |low: f64, high: f64| stream.random_range(low..high);
            let mut solid = || {
                let corners: Vec<Vec3> = (0..9).map(|_| Vec3::from_fn(|_, _| draw(-0.3, 0.3))).collect();
                let axis = Vec3::from_fn(|_, _| draw(-1.0, 1.0)).normalize();
                let frame =
                    Frame::at(Vec3::from_fn(|_, _| draw(-0.4, 0.4))) * Frame::turned(&axis, draw(-3.0, 3.0));
                (Rounded::new(corners, draw(0.0, 0.1)), frame)
            };
            let [one, other] = [solid(), solid()];
            let hull = |solid: &Rounded| {
                let points: Vec<Vector> = solid.points().iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
                ConvexPolyhedron::from_convex_hull(&points).unwrap()
            };
            let gap = query::distance(&pose(&one.1), &hull(&one.0), &pose(&other.1), &hull(&other.0))
                .unwrap()
                .distance
                - one.0.radius()
                - other.0.radius();
            if gap.abs() < 1e-6 {
                continue;
            }
            let [a, b] = [&one, &other].map(|(solid, frame)| Placed { solid, frame });
            assert_eq!(intersects_placed_placed(&a, &b), gap < 0.0, "case {case}: gap {gap}");
            assert_eq!(intersects_placed_placed(&b, &a), gap < 0.0, "case {case} the other way");
            apart[usize::from(gap > 0.0)] += 1;
        }
        assert!(apart.iter().all(|count| *count > 500), "one-sided sample: {apart:?}");
    }

    #[test]
    fn boxes_face_to_face_touch_and_apart_by_a_thousandth_do_not() {
        let corner = |i: usize| Vec3::from_fn(|axis, _| if i >> axis & 1 == 1 { 0.5 } else { -0.5 });
        let cube = Rounded::new((0..8).map(corner).collect(), 0.0);
        let ball = Rounded::new(vec![Vec3::zeros()], 0.5);
        for (other, gap) in [(&cube, 0.0), (&ball, 0.0), (&cube, 1e-3), (&ball, 1e-3)] {
            let frame = Frame::at(Vec3::new(1.0 + gap, 0.2, -0.1));
            let placed =
                [Placed { solid: &cube, frame: &Frame::IDENTITY }, Placed { solid: other, frame: &frame }];
            assert_eq!(intersects_placed_placed(&placed[0], &placed[1]), gap == 0.0, "gap {gap}");
        }
        let inside = Placed { solid: &ball, frame: &Frame::IDENTITY };
        assert!(
            intersects_placed_placed(&inside, &Placed { solid: &cube, frame: &Frame::IDENTITY }),
            "one in another"
        );
    }
}
