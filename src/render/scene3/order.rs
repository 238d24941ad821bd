//! Back to front: binary space partition of faces and line pieces.
//!
//! A region that holds one convex solid needs no order. Else it is parted by a plane that cuts nothing
//! between solids, if one along an axis exists, or by the plane of the face that cuts least.
//!
//! # Source
//! Fuchs, Kedem & Naylor, *On visible surface generation by a priori tree structures* (1980).

use super::{Vec3, dot};
use crate::render::style::{Rgb, Stroke};
use engine::geometry::heights_over;

/// The points x with `normal · x = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub normal: Vec3,
    pub offset: f64,
}

/// How an item is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Look {
    /// A face in its plane, which looks at the eye: colour and opacity.
    Face(Plane, Rgb, f64),
    /// A piece of a line.
    Line(Stroke),
}

/// A convex face or a piece of a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Item {
    /// What it belongs to.
    pub solid: usize,
    /// Corners, or the two ends.
    pub points: Vec<Vec3>,
    pub look: Look,
}

/// How many faces are tried as cutting planes.
const TRIES: usize = 24;

/// `items` so that nothing is followed by things that lie behind it, as seen from the direction `eye`.
/// Points closer than `slack` to a plane count as lying in it.
pub(super) fn back_to_front(items: Vec<Item>, eye: Vec3, slack: f64) -> Vec<Item> {
    let mut sorted = Vec::with_capacity(items.len());
    let mut todo = vec![items];
    while let Some(region) = todo.pop() {
        match parting(&region, slack) {
            None => {
                let (faces, lines): (Vec<Item>, Vec<Item>) =
                    region.into_iter().partition(|item| matches!(item.look, Look::Face(..)));
                sorted.extend(faces);
                sorted.extend(lines);
            }
            Some(plane) => {
                let Sides { above, within, below } = divided(region, plane, slack);
                let is_above = dot(plane.normal, eye) >= 0.0;
                let (mut near, far) = if is_above { (above, below) } else { (below, above) };
                // Lines in the plane are edges of what stands on it, or are drawn on it: not to be covered.
                let (lines, within): (Vec<Item>, Vec<Item>) =
                    within.into_iter().partition(|item| matches!(item.look, Look::Line(_)));
                near.extend(lines);
                // Faces in one plane cannot hide each other.
                let within = within.into_iter().map(|face| Item { solid: usize::MAX, ..face }).collect();
                todo.extend([near, within, far].into_iter().filter(|part: &Vec<Item>| !part.is_empty()));
            }
        }
    }
    sorted
}

/// The plane that parts a region best; none if its items can be drawn as they come.
fn parting(region: &[Item], slack: f64) -> Option<Plane> {
    let first = region.first()?.solid;
    if region.iter().all(|item| item.solid == first) {
        return None;
    }
    gap(region, slack).or_else(|| least_cutting(region, slack))
}

/// A plane across an axis that has whole solids on either side, nearest to halving the region.
fn gap(region: &[Item], slack: f64) -> Option<Plane> {
    let mut best: Option<(usize, Plane)> = None;
    for axis in 0..3 {
        let mut spans: Vec<(f64, f64)> = region
            .iter()
            .map(|item| {
                let values = || item.points.iter().map(|point| point[axis]);
                (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
            })
            .collect();
        spans.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut reach = f64::NEG_INFINITY;
        for (index, &(low, high)) in spans.iter().enumerate() {
            let uneven = index.abs_diff(spans.len() - index);
            if index > 0 && low > reach + 2.0 * slack && best.is_none_or(|(least, _)| uneven < least) {
                let mut normal = [0.0; 3];
                normal[axis] = 1.0;
                best = Some((uneven, Plane { normal, offset: low.midpoint(reach) }));
            }
            reach = reach.max(high);
        }
    }
    best.map(|(_, plane)| plane)
}

/// The plane, out of those of up to [`TRIES`] faces, that cuts few items and parts the others evenly.
fn least_cutting(region: &[Item], slack: f64) -> Option<Plane> {
    let planes: Vec<Plane> = region
        .iter()
        .filter_map(|item| if let Look::Face(plane, ..) = item.look { Some(plane) } else { None })
        .collect();
    let stride = planes.len().div_ceil(TRIES).max(1);
    let cost = |plane: &Plane| {
        let mut cut = 0_i64;
        let mut above = 0_i64;
        let mut below = 0_i64;
        for item in region {
            let (low, high) = heights(item, *plane);
            cut += i64::from(low < -slack && high > slack);
            above += i64::from(low >= -slack && high > slack);
            below += i64::from(high <= slack && low < -slack);
        }
        8 * cut + (above - below).abs()
    };
    let best =
        planes.into_iter().step_by(stride).map(|plane| (cost(&plane), plane)).min_by_key(|(cost, _)| *cost);
    best.map(|(_, plane)| plane)
}

fn heights(item: &Item, plane: Plane) -> (f64, f64) {
    heights_over(&item.points, plane.normal, plane.offset)
}

#[derive(Default)]
struct Sides {
    above: Vec<Item>,
    within: Vec<Item>,
    below: Vec<Item>,
}

fn divided(region: Vec<Item>, plane: Plane, slack: f64) -> Sides {
    let mut sides = Sides::default();
    for item in region {
        let (low, high) = heights(&item, plane);
        match (low < -slack, high > slack) {
            (false, true) => sides.above.push(item),
            (true, false) => sides.below.push(item),
            (true, true) => {
                sides.above.push(Item { points: kept(&item.points, plane, 1.0), ..item.clone() });
                sides.below.push(Item { points: kept(&item.points, plane, -1.0), ..item });
            }
            (false, false) => sides.within.push(item),
        }
    }
    sides
}

/// The part of a face or line piece on the side of `plane` that `sign` names.
fn kept(points: &[Vec3], plane: Plane, sign: f64) -> Vec<Vec3> {
    let height = |point: Vec3| sign * (dot(plane.normal, point) - plane.offset);
    let pieces = if points.len() == 2 { 1 } else { points.len() };
    let mut part = Vec::new();
    for index in 0..points.len() {
        let (a, b) = (points[index], points[(index + 1) % points.len()]);
        let up = height(a);
        let next = height(b);
        if up >= 0.0 {
            part.push(a);
        }
        if index < pieces && up * next < 0.0 {
            let share = up / (up - next);
            part.push([0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis])));
        }
    }
    part
}
