//! Names beside points, each where it meets no other: instead of a legend of many entries.

use super::{Mark, View};
use crate::render::canvas::{Align, Canvas, Rect, Stand, Type};
use crate::render::style::{GREY, Stroke, TextSize};

/// Points in data units with their names.
#[derive(Clone, Debug)]
pub struct Labels {
    /// The points and names.
    pub points: Vec<([f64; 2], String)>,
}

/// How far from its point a name may stand, points.
const FAR_PT: [f64; 6] = [6.0, 14.0, 24.0, 36.0, 50.0, 66.0];
/// In how many directions a place is looked for.
const DIRECTIONS: usize = 16;
/// Room around a point's marker, points.
const MARKER_PT: f64 = 4.0;

fn meets(a: Rect, b: Rect) -> bool {
    a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom()
}

/// The box of a name `width` wide whose edge nearest to `at` is `far` away from it in a direction.
fn place(at: [f64; 2], [width, height]: [f64; 2], far: f64, direction: usize) -> Rect {
    let (sine, cosine) = libm::sincos(std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64);
    let middle = [at[0] + cosine * (far + width / 2.0), at[1] - sine * (far + height / 2.0)];
    Rect { x: middle[0] - width / 2.0, y: middle[1] - height / 2.0, w: width, h: height }
}

impl Mark for Labels {
    fn draw(&self, _: &mut Canvas, _: &View) {}

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        let set = Type { rim: true, ..Type::of(TextSize::TICK).aligned(Align::Start, Stand::Centre) };
        let around = |[x, y]: [f64; 2]| Rect {
            x: x - MARKER_PT,
            y: y - MARKER_PT,
            w: 2.0 * MARKER_PT,
            h: 2.0 * MARKER_PT,
        };
        let all = self.points.iter().map(|(point, _)| view.at(*point));
        let mut taken: Vec<Rect> = all.filter(|at| at.iter().all(|v| v.is_finite())).map(around).collect();
        let mut names: Vec<Rect> = Vec::new();
        let mut leaders: Vec<[f64; 2]> = Vec::new();
        for (point, name) in &self.points {
            let at = view.at(*point);
            let size = [set.width_pt(name) + 2.0, set.size.pt() + 2.0];
            let places =
                FAR_PT.iter().flat_map(|far| (0..DIRECTIONS).map(move |to| place(at, size, *far, to)));
            let places: Vec<Rect> = places.collect();
            let is_free = |place: &&Rect| {
                let corners = [[place.x, place.y], [place.right(), place.bottom()]];
                corners.iter().all(|corner| view.frame.contains(*corner))
                    && !taken.iter().any(|other| meets(**place, *other))
            };
            let is_apart = |place: &&Rect| {
                !leaders.iter().any(|point| place.contains(*point))
                    && !leader(at, **place).iter().any(|point| names.iter().any(|name| name.contains(*point)))
            };
            let found = places.iter().find(|place| is_free(place) && is_apart(place));
            // Where no place is free the first one is taken: the labels then overlap, and the figure is refused.
            let free = found.or_else(|| places.iter().find(is_free)).copied().unwrap_or(places[0]);
            let leader = leader(at, free);
            if let (Some(from), Some(to)) = (leader.first(), leader.last()) {
                canvas.polyline(&[*from, *to], &Stroke::solid(GREY, 0.5));
            }
            canvas.text([free.x + 1.0, free.y + size[1] / 2.0], name, &set);
            leaders.extend(leader);
            taken.push(free);
            names.push(free);
        }
    }
}

/// Points of the line from `at` to a name that does not stand right beside it.
fn leader(at: [f64; 2], name: Rect) -> Vec<[f64; 2]> {
    const STEPS: usize = 24;
    let to = [at[0].clamp(name.x, name.right()), at[1].clamp(name.y, name.bottom())];
    if libm::hypot(to[0] - at[0], to[1] - at[1]) < FAR_PT[0] + 2.0 {
        return Vec::new();
    }
    let step = |n: usize| [0, 1].map(|axis| at[axis] + (to[axis] - at[axis]) * n as f64 / STEPS as f64);
    (0..=STEPS).map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_every_direction_keep_their_distance() {
        for direction in 0..DIRECTIONS {
            let found = place([50.0, 50.0], [30.0, 9.0], 14.0, direction);
            let near = [50.0_f64.clamp(found.x, found.right()), 50.0_f64.clamp(found.y, found.bottom())];
            let far = libm::hypot(near[0] - 50.0, near[1] - 50.0);
            assert!((9.0..20.0).contains(&far), "direction {direction}: {far}");
        }
    }
}
