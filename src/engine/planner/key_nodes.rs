//! Key nodes: where the way round an obstacle's edge is shortest.

use world::geometry::{Convex, Vec3};

/// The point of an edge at which a detour over it is shortest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Key {
    /// The edge, as the polyhedron lists it.
    pub(super) edge: usize,
    /// Where it is.
    pub(super) point: Vec3,
    /// How far along the edge.
    pub(super) along: f64,
    /// From here over it to the goal.
    pub(super) detour: f64,
}

/// What counts as a face in front of a point, and how far key nodes are moved off the solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Front {
    /// The face's plane is lower than the point by more than this.
    pub(super) above: f64,
    /// Key nodes are moved out by this along the sum of the edge's two normals.
    pub(super) push: f64,
}

/// As printed: T > 0, key nodes on the edge itself.
pub(super) const PRINTED: Front = Front { above: 0.0, push: 0.0 };

/// A face on whose plane the point stands is in front of it, and key nodes stand off the edge.
pub(super) const GUARDED: Front = Front { above: -1e-6, push: 0.01 };

/// The key nodes of every edge of every face in front of `x`, once each, in the order of edges.
///
/// # Source
/// Tang, Zhou & Xu (2023), section 2.3, eq. 5: the point q of an edge for which g(x) + |x − q| + h(q) is least.
pub(super) fn keys(convex: &Convex, x: &Vec3, goal: &Vec3, front: Front) -> Vec<Key> {
    let in_front = |face: usize| convex.faces()[face].plane.height(x) > front.above;
    let visible =
        convex.edges().iter().enumerate().filter(|(_, edge)| edge.faces.iter().any(|&f| in_front(f)));
    visible.map(|(index, _)| key(convex, index, x, goal, front.push)).collect()
}

/// The key node of one edge.
pub(super) fn key(convex: &Convex, index: usize, x: &Vec3, goal: &Vec3, push: f64) -> Key {
    let edge = &convex.edges()[index];
    let [a, b] = edge.ends.map(|end| convex.vertices()[end]);
    let length = (b - a).norm();
    let direction = (b - a) / length;
    let along = shortest_over((x - a).dot(&direction), off(x, &a, &direction), goal, &a, &direction);
    let along = along.clamp(0.0, length);
    let out: Vec3 = edge.faces.iter().map(|&face| convex.faces()[face].plane.normal).sum();
    let point = a + direction * along + out * push;
    Key { edge: index, point, along, detour: (x - point).norm() + (goal - point).norm() }
}

/// How far `point` is from the line through `a`.
fn off(point: &Vec3, a: &Vec3, direction: &Vec3) -> f64 {
    let r = point - a;
    (r - direction * r.dot(direction)).norm()
}

/// Where on the line the broken way over it is shortest: turning one point about the line into the plane of the
/// other, on the other side, makes it straight.
fn shortest_over(at_x: f64, off_x: f64, goal: &Vec3, a: &Vec3, direction: &Vec3) -> f64 {
    let at_goal = (goal - a).dot(direction);
    let off_goal = off(goal, a, direction);
    let sum = off_x + off_goal;
    if sum > 0.0 { (at_x * off_goal + at_goal * off_x) / sum } else { at_x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::seed;
    use rand::RngExt as _;

    #[test]
    fn no_other_point_of_the_edge_makes_a_shorter_detour() {
        let mut clamped = 0;
        for seed in 0..200 {
            let mut stream = seed::stream(seed);
            let mut draw = |reach: f64| Vec3::from_fn(|_, _| stream.random_range(-reach..reach));
            let x = draw(9.0);
            let goal = draw(9.0);
            let cube = Convex::cuboid(draw(2.0), Vec3::new(2.0, 3.0, 4.0)).unwrap();
            for index in 0..cube.edges().len() {
                let found = key(&cube, index, &x, &goal, 0.0);
                let [a, b] = cube.edges()[index].ends.map(|end| cube.vertices()[end]);
                clamped += u32::from(found.along == 0.0 || found.along == (b - a).norm());
                for k in 0..=50 {
                    let q = a + (b - a) * (f64::from(k) / 50.0);
                    let detour = (x - q).norm() + (goal - q).norm();
                    assert!(found.detour <= detour + 1e-9, "seed {seed}, edge {index}: {detour}");
                }
            }
        }
        assert!((200..2200).contains(&clamped), "one-sided sample: {clamped} of 2400 at an end");
    }

    #[test]
    fn a_point_on_an_edge_has_no_face_in_front_as_printed_and_two_with_the_guard() {
        let cube = Convex::cuboid(Vec3::zeros(), Vec3::repeat(2.0)).unwrap();
        let x = Vec3::new(1.0, 1.0, 0.3);
        let goal = Vec3::new(-5.0, -5.0, 0.0);
        assert!(keys(&cube, &x, &goal, PRINTED).is_empty());
        assert_eq!(keys(&cube, &x, &goal, GUARDED).len(), 7);
    }
}
