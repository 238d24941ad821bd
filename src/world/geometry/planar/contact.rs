//! Contact in the plane, by exact signs.

use super::{
    Circle, ConvexPolygon, Segment2, Touch,
    exact::{compare_distance_to_line, compare_distance_to_point, side_of_foot, turn},
};
use crate::geometry::Vec2;
use std::cmp::Ordering;

/// Whether a quantity compared with the boundary means contact: less is inside, equal is touching.
fn is_contact(ordering: Ordering, touch: Touch) -> bool {
    ordering == Ordering::Less || (ordering == Ordering::Equal && touch == Touch::Contact)
}

/// Whether a point is in a disc.
pub fn intersects_point_circle(point: &Vec2, circle: &Circle, touch: Touch) -> bool {
    is_contact(compare_distance_to_point(point, &circle.center, circle.radius), touch)
}

/// Whether a segment meets a disc.
pub fn intersects_segment_circle(segment: &Segment2, circle: &Circle, touch: Touch) -> bool {
    let Segment2 { a, b } = segment;
    let nearest = if side_of_foot(a, b, &circle.center) != Ordering::Greater {
        compare_distance_to_point(a, &circle.center, circle.radius)
    } else if side_of_foot(b, a, &circle.center) != Ordering::Greater {
        compare_distance_to_point(b, &circle.center, circle.radius)
    } else {
        compare_distance_to_line(&circle.center, a, b, circle.radius)
    };
    is_contact(nearest, touch)
}

/// Whether a point is in a convex polygon.
pub fn intersects_point_polygon(point: &Vec2, polygon: &ConvexPolygon, touch: Touch) -> bool {
    polygon.sides().all(|side| is_contact(turn(&side.a, &side.b, point).reverse(), touch))
}

/// Whether a segment meets a convex polygon; with [`Touch::Free`], whether it meets its inside.
///
/// Two convex shapes are apart if a line along a side of one of them parts them, and only then.
pub fn intersects_segment_polygon(segment: &Segment2, polygon: &ConvexPolygon, touch: Touch) -> bool {
    let apart = |side: Ordering| !is_contact(side, touch);
    let beyond_a_side = polygon
        .sides()
        .any(|side| [segment.a, segment.b].iter().all(|end| apart(turn(&side.a, &side.b, end).reverse())));
    if beyond_a_side || segment.a == segment.b {
        return !beyond_a_side;
    }
    let sides = || polygon.vertices().iter().map(|v| turn(&segment.a, &segment.b, v));
    !(sides().all(apart) || sides().all(|side| apart(side.reverse())))
}

/// Whether two segments meet; with [`Touch::Free`], whether they cross at a point inside both.
pub fn intersects_segment_segment(p: &Segment2, q: &Segment2, touch: Touch) -> bool {
    let across = |p: &Segment2, q: &Segment2| (turn(&p.a, &p.b, &q.a), turn(&p.a, &p.b, &q.b));
    let ((q1, q2), (p1, p2)) = (across(p, q), across(q, p));
    let opposite = |a: Ordering, b: Ordering| a != Ordering::Equal && a == b.reverse();
    if opposite(q1, q2) && opposite(p1, p2) {
        return true;
    }
    let touches = |side: Ordering, segment: &Segment2, point: &Vec2| {
        side == Ordering::Equal && is_within_box(segment, point)
    };
    touch == Touch::Contact
        && (touches(q1, p, &q.a) || touches(q2, p, &q.b) || touches(p1, q, &p.a) || touches(p2, q, &p.b))
}

/// Whether a point on the segment's line is on the segment.
fn is_within_box(segment: &Segment2, point: &Vec2) -> bool {
    let (low, high) = (segment.a.inf(&segment.b), segment.a.sup(&segment.b));
    low.x <= point.x && point.x <= high.x && low.y <= point.y && point.y <= high.y
}
