//! Postures and obstacles as the verifier sees them.

use super::{Case, turned};
use parry2d::math::{Pose, Vector};
use parry2d::query;
use parry2d::shape::{Ball, ConvexPolygon, Segment};

/// An obstacle.
#[derive(Debug, Clone)]
pub struct Body(Outline);

#[derive(Debug, Clone)]
enum Outline {
    Disc { center_cm: [f64; 2], shape: Ball },
    Polygon { corners_cm: Vec<[f64; 2]>, shape: ConvexPolygon },
}

/// Base, elbow and tip.
pub(super) type Joints = [[f64; 2]; 3];

impl Body {
    /// A disc.
    pub fn disc(center_cm: [f64; 2], radius_cm: f64) -> Self {
        Self(Outline::Disc { center_cm, shape: Ball::new(radius_cm) })
    }

    /// A convex polygon, its corners counter-clockwise.
    ///
    /// # Panics
    /// If the corners are not those of a convex polygon.
    pub fn polygon(corners_cm: Vec<[f64; 2]>) -> Self {
        let corners = corners_cm.iter().copied().map(vector).collect();
        let shape = ConvexPolygon::from_convex_polyline(corners).expect("the corners are in convex order");
        Self(Outline::Polygon { corners_cm, shape })
    }

    /// The distance from a segment, 0 in contact.
    fn distance(&self, [a, b]: [[f64; 2]; 2]) -> f64 {
        let link = Segment::new(vector(a), vector(b));
        // Of known shapes, so that the search is compiled, and optimised, with this package.
        match &self.0 {
            Outline::Disc { center_cm: [x, y], shape } => {
                let from_disc = Pose::translation(*x, *y).inverse();
                query::details::distance_ball_convex_polyhedron(&from_disc, shape, &link)
            }
            Outline::Polygon { shape, .. } => {
                query::details::distance_support_map_support_map(&Pose::IDENTITY, shape, &link)
            }
        }
    }

    /// The least shift that takes a segment in contact out of the body.
    fn depth(&self, [a, b]: [[f64; 2]; 2]) -> f64 {
        let way = [b[0] - a[0], b[1] - a[1]];
        match &self.0 {
            Outline::Disc { center_cm: c, shape } => {
                let square = way[0] * way[0] + way[1] * way[1];
                let foot = ((c[0] - a[0]) * way[0] + (c[1] - a[1]) * way[1]) / square;
                let foot = foot.clamp(0.0, 1.0);
                let off = [0, 1].map(|i| a[i] + foot * way[i] - c[i]);
                (shape.radius - (off[0] * off[0] + off[1] * off[1]).sqrt()).max(0.0)
            }
            // The sides of the sum of the polygon and the mirrored segment are square to these ways.
            Outline::Polygon { corners_cm, .. } => {
                let count = corners_cm.len();
                let sides = (0..count).map(|i| {
                    let ([ax, ay], [bx, by]) = (corners_cm[i], corners_cm[(i + 1) % count]);
                    [by - ay, ax - bx]
                });
                let outward = sides.chain([[-way[1], way[0]], [way[1], -way[0]]]);
                let shift = |[nx, ny]: [f64; 2]| {
                    let norm = (nx * nx + ny * ny).sqrt();
                    let on = |[x, y]: [f64; 2]| (nx * x + ny * y) / norm;
                    let farthest =
                        corners_cm.iter().map(|corner| on(*corner)).fold(f64::NEG_INFINITY, f64::max);
                    farthest - on(a).min(on(b))
                };
                outward.map(shift).fold(f64::INFINITY, f64::min).max(0.0)
            }
        }
    }

    /// How far outside of the body a point is: negative inside, exactly 0 on the rim of a body with whole numbers.
    fn outside(&self, [x, y]: [f64; 2]) -> f64 {
        match &self.0 {
            Outline::Disc { center_cm: [cx, cy], shape } => {
                let d = [x - cx, y - cy];
                d[0] * d[0] + d[1] * d[1] - shape.radius * shape.radius
            }
            Outline::Polygon { corners_cm, .. } => (0..corners_cm.len())
                .map(|i| {
                    let ([ax, ay], [bx, by]) = (corners_cm[i], corners_cm[(i + 1) % corners_cm.len()]);
                    (by - ay) * (x - ax) - (bx - ax) * (y - ay)
                })
                .fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

impl Case<'_> {
    /// The posture at a lattice point, if the arm may stand there.
    pub(super) fn free_posture(&self, point: [i32; 2]) -> Option<[f64; 2]> {
        let [x, y] = self.at(point);
        if x * x + y * y < self.inner_radius_cm * self.inner_radius_cm {
            return None;
        }
        let posture = self.posture([x, y])?;
        let contact = |gap: f64| if self.touching_is_contact { gap <= 0.0 } else { gap < 0.0 };
        if self.bodies.iter().any(|body| contact(body.outside([x, y]))) {
            return None;
        }
        if turned([0.0; 2], posture)[1].abs() > self.q2_limit_rad {
            return None;
        }
        let joints = self.joints(posture);
        (self.gap(&joints) > 0.0 || self.grazes(&joints)).then_some(posture)
    }

    /// How near to the base the tip may come.
    pub(super) fn nearest_cm(&self) -> f64 {
        let [l1, l2] = self.links_cm;
        let folded = if self.q2_limit_rad < std::f64::consts::PI {
            // The third side of the triangle of both links and the way from base to tip.
            let opposite = std::f64::consts::PI - self.q2_limit_rad;
            (l1 * l1 + l2 * l2 - 2.0 * l1 * l2 * libm::cos(opposite)).max(0.0).sqrt()
        } else {
            (l1 - l2).abs()
        };
        self.inner_radius_cm.max(folded)
    }

    /// Whether the arm only touches: with touching allowed, its links shortened by a hair are clear.
    pub(super) fn grazes(&self, [base, elbow, tip]: &Joints) -> bool {
        let shorter = |a: [f64; 2], b: [f64; 2]| [a, [0, 1].map(|axis| b[axis] - 1e-9 * (b[axis] - a[axis]))];
        let clear = |link| self.bodies.iter().all(|body| body.distance(link) > 0.0);
        !self.touching_is_contact && clear(shorter(*base, *elbow)) && clear(shorter(*elbow, *tip))
    }

    /// Joint angles that put the tip at `target`: the elbow lies on a circle about the base and on one about the tip.
    pub(super) fn posture(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let ([l1, l2], d2) = (self.links_cm, x * x + y * y);
        let (least, most) = ((l1 - l2) * (l1 - l2), (l1 + l2) * (l1 + l2));
        if d2 < least || d2 > most || d2 == 0.0 {
            return None;
        }
        let (left, right) = (self.elbow_beside([x, y], 1.0), self.elbow_beside([x, y], -1.0));
        let [ex, ey] = if self.higher_elbow && right[1] > left[1] { right } else { left };
        let q1 = libm::atan2(ey, ex);
        Some([q1, libm::atan2(y - ey, x - ex) - q1])
    }

    /// The elbow to the left (1) or right (−1) of the way to a tip within reach.
    pub(super) fn elbow_beside(&self, [x, y]: [f64; 2], side: f64) -> [f64; 2] {
        let ([l1, l2], d2) = (self.links_cm, x * x + y * y);
        // The foot of the elbow on the way to the tip, and how far beside it the elbow is, as shares of that way.
        let along = (d2 + l1 * l1 - l2 * l2) / (2.0 * d2);
        let beside = (l1 * l1 / d2 - along * along).max(0.0).sqrt();
        [x * along - side * beside * y, y * along + side * beside * x]
    }

    /// The distance of either link from the nearest obstacle.
    pub(super) fn gap(&self, joints: &Joints) -> f64 {
        let links = links(joints);
        let gaps = self.bodies.iter().flat_map(|body| links.map(|link| body.distance(link)));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// How deep a link is in an obstacle; minus the distance of what is clear.
    pub(super) fn signed_depth(&self, joints: &Joints) -> f64 {
        let links = links(joints);
        let signed = |body: &Body, link: [[f64; 2]; 2]| match body.distance(link) {
            gap if gap > 0.0 => -gap,
            _ => body.depth(link),
        };
        let depths = self.bodies.iter().flat_map(|body| links.map(|link| signed(body, link)));
        depths.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Base, elbow and tip, by products of homogeneous matrices.
    pub(super) fn joints(&self, posture: [f64; 2]) -> Joints {
        let one = product(&IDENTITY, &link(posture[0], self.links_cm[0]));
        let two = product(&one, &link(posture[1], self.links_cm[1]));
        [[0.0, 0.0], [one[0][2], one[1][2]], [two[0][2], two[1][2]]]
    }
}

fn links([base, elbow, tip]: &Joints) -> [[[f64; 2]; 2]; 2] {
    [[*base, *elbow], [*elbow, *tip]]
}

type Matrix = [[f64; 3]; 3];

const IDENTITY: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A turn by `angle`, then a move by `length` along the turned x axis.
fn link(angle: f64, length: f64) -> Matrix {
    let (s, c) = libm::sincos(angle);
    [[c, -s, length * c], [s, c, length * s], [0.0, 0.0, 1.0]]
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let cell = |row: usize, column: usize| (0..3).map(|k| a[row][k] * b[k][column]).sum();
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| cell(row, column)))
}

fn vector([x, y]: [f64; 2]) -> Vector {
    Vector::new(x, y)
}
