//! Names beside points, each where it meets no other: instead of a legend of many entries.

use super::{Mark, View};
use crate::render::canvas::{Align, Canvas, Rect, Stand, Type};
use crate::render::style::{GREY, Stroke, TextSize};

/// Points in data units with their names.
#[derive(Clone, Debug)]
pub struct Labels {
    /// The points and names.
    pub points: Vec<([f64; 2], String)>,
    /// Pieces of line in data units that no name covers: the bars of intervals.
    pub bars: Vec<[[f64; 2]; 2]>,
}

/// How far from its point a name may stand, points.
const FAR_PT: [f64; 7] = [6.0, 14.0, 24.0, 36.0, 50.0, 66.0, 84.0];
/// In how many directions a place is looked for.
const DIRECTIONS: usize = 24;
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

/// How often names are looked at again, each against all others.
const ROUNDS: usize = 12;
/// What it costs, in points of leader, that two names overlap …
const OVERLAP: f64 = 4000.0;
/// … that a leader passes through a name or that two leaders cross …
const CROSSING: f64 = 1500.0;
/// … and that a leader passes over the marker of another point.
const OVER: f64 = 120.0;

/// A name where it stands, with the line that leads to it, if one is needed.
#[derive(Clone)]
struct Placed {
    name: Rect,
    leader: Option<[[f64; 2]; 2]>,
    length: f64,
}

impl Placed {
    fn new(at: [f64; 2], name: Rect) -> Self {
        let to = [at[0].clamp(name.x, name.right()), at[1].clamp(name.y, name.bottom())];
        let length = libm::hypot(to[0] - at[0], to[1] - at[1]);
        Self { name, leader: (length >= FAR_PT[0] + 2.0).then_some([at, to]), length }
    }

    /// What it costs to have both.
    fn against(&self, other: &Self) -> f64 {
        let through = |one: &Self, two: &Self| one.leader.is_some_and(|line| passes(line, two.name));
        let (a, b) = (through(self, other), through(other, self));
        let is_crossed = self.leader.zip(other.leader).is_some_and(|(a, b)| cross(a, b));
        let cost = |is: bool, cost: f64| if is { cost } else { 0.0 };
        cost(meets(self.name, other.name), OVERLAP)
            + cost(a, CROSSING)
            + cost(b, CROSSING)
            + cost(is_crossed, CROSSING)
    }

    /// What it costs by itself, beside the markers of other points.
    fn alone(&self, others: &[Rect]) -> f64 {
        let over = others.iter().filter(|marker| self.leader.is_some_and(|line| passes(line, **marker)));
        self.length + OVER * over.count() as f64
    }
}

/// Whether two pieces of line cross.
fn cross([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side =
        |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Whether a piece of line passes through a box: what is left of it between the box's sides, axis by axis.
fn passes([from, to]: [[f64; 2]; 2], room: Rect) -> bool {
    let sides = [[room.x, room.right()], [room.y, room.bottom()]];
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let along = to[axis] - from[axis];
        if along == 0.0 {
            if !(sides[axis][0]..=sides[axis][1]).contains(&from[axis]) {
                return false;
            }
            continue;
        }
        let a = (sides[axis][0] - from[axis]) / along;
        let b = (sides[axis][1] - from[axis]) / along;
        (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
    }
    low <= high
}

/// Places for names, one to be taken for each.
struct Choice<'p> {
    places: &'p [Vec<Placed>],
    /// What each place costs by itself.
    alone: Vec<Vec<f64>>,
}

impl<'p> Choice<'p> {
    fn new(places: &'p [Vec<Placed>], markers: &[Rect]) -> Self {
        let others = |own: usize| -> Vec<Rect> {
            let other = markers.iter().enumerate().filter(|(index, _)| *index != own);
            other.map(|(_, marker)| *marker).collect()
        };
        let cost = |(own, all): (usize, &Vec<Placed>)| {
            let others = others(own);
            all.iter().map(|place| place.alone(&others)).collect()
        };
        Self { places, alone: places.iter().enumerate().map(cost).collect() }
    }

    /// What it costs that name `own` stands at its place `at`, beside all others that have one; from `most` on, some number
    /// that is no less.
    fn cost(&self, own: usize, at: usize, taken: &[Option<usize>], most: f64) -> f64 {
        let alone = self.alone[own][at];
        let mut beside = 0.0;
        for (other, stands) in taken.iter().enumerate() {
            if alone + beside >= most {
                break;
            }
            if let Some(stands) = stands.filter(|_| other != own) {
                beside += self.places[own][at].against(&self.places[other][stands]);
            }
        }
        alone + beside
    }

    /// The cheapest place of name `own` beside all others that have one; of equal ones the first.
    fn cheapest(&self, own: usize, taken: &[Option<usize>]) -> Option<usize> {
        let mut least = f64::INFINITY;
        let mut cheapest = None;
        for at in 0..self.places[own].len() {
            let cost = self.cost(own, at, taken, least);
            if cost < least {
                (least, cheapest) = (cost, Some(at));
            }
        }
        cheapest
    }

    /// Each name in turn, name `first` first, takes the cheapest of its places, until none moves; and what that costs.
    fn settled(&self, first: usize, step: usize) -> (f64, Vec<Option<usize>>) {
        let count = self.places.len();
        let mut taken: Vec<Option<usize>> = vec![None; count];
        for _ in 0..ROUNDS {
            let before = taken.clone();
            for own in (0..count).map(|turn| (first + turn * step) % count) {
                taken[own] = self.cheapest(own, &taken);
            }
            if taken == before {
                break;
            }
        }
        let cost = |(own, at): (usize, &Option<usize>)| {
            at.map_or(0.0, |at| self.cost(own, at, &taken, f64::INFINITY))
        };
        let all = taken.iter().enumerate().map(cost).sum();
        (all, taken)
    }
}

/// The best place of each name that was found: names settle from several orders, and the cheapest end counts.
fn settled(places: &[Vec<Placed>], markers: &[Rect]) -> Vec<Placed> {
    let choice = Choice::new(places, markers);
    let is_order = |step: &usize| {
        (2..=places.len()).all(|of| !step.is_multiple_of(of) || !places.len().is_multiple_of(of))
    };
    let steps: Vec<usize> = (1..places.len().max(2)).filter(is_order).collect();
    let starts = (0..places.len()).flat_map(|first| steps.iter().map(move |step| (first, *step)));
    let ends = starts.map(|(first, step)| choice.settled(first, step));
    let Some((_, taken)) = ends.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Vec::new() };
    places.iter().zip(taken).filter_map(|(all, at)| Some(all[at?].clone())).collect()
}

/// Where a name of this size about `at` lies in the frame and covers no marker and no bar.
///
/// Where no place is free the first one is taken: the labels then overlap, and the figure is refused.
fn free(at: [f64; 2], size: [f64; 2], frame: Rect, markers: &[Rect], bars: &[[[f64; 2]; 2]]) -> Vec<Placed> {
    let every = FAR_PT.iter().flat_map(|far| (0..DIRECTIONS).map(move |to| place(at, size, *far, to)));
    let is_free = |place: &Rect| {
        let corners = [[place.x, place.y], [place.right(), place.bottom()]];
        corners.iter().all(|corner| frame.contains(*corner))
            && !markers.iter().any(|marker| meets(*place, *marker))
            && !bars.iter().any(|bar| passes(*bar, *place))
    };
    let free: Vec<Placed> = every.filter(is_free).map(|name| Placed::new(at, name)).collect();
    if free.is_empty() { vec![Placed::new(at, place(at, size, FAR_PT[0], 0))] } else { free }
}

impl Mark for Labels {
    fn draw(&self, _: &mut Canvas, _: &View) {}

    fn draw_over(&self, canvas: &mut Canvas, view: &View) {
        let set = Type { rim: true, ..Type::regular(TextSize::TICK).aligned(Align::Start, Stand::Centre) };
        let side = 2.0 * MARKER_PT;
        let around = |at: [f64; 2]| Rect { x: at[0] - MARKER_PT, y: at[1] - MARKER_PT, w: side, h: side };
        let is_placed = |at: &[f64; 2]| at.iter().all(|value| value.is_finite());
        let all: Vec<([f64; 2], &String)> =
            self.points.iter().map(|(point, name)| (view.at(*point), name)).collect();
        let markers: Vec<Rect> =
            all.iter().filter(|(at, _)| is_placed(at)).map(|(at, _)| around(*at)).collect();
        let bars: Vec<[[f64; 2]; 2]> = self.bars.iter().map(|bar| bar.map(|end| view.at(end))).collect();
        let places = |at: [f64; 2], name: &str| {
            let size = [set.width_pt(name) + 2.0, set.size.pt() + 2.0];
            free(at, size, view.frame, &markers, &bars)
        };
        let named: Vec<Vec<Placed>> = all.iter().map(|(at, name)| places(*at, name)).collect();
        let settled = settled(&named, &markers);
        for [from, to] in settled.iter().filter_map(|placed| placed.leader) {
            canvas.polyline(&[from, to], &Stroke::solid(GREY, 0.5));
        }
        for (placed, (_, name)) in settled.iter().zip(&all) {
            let Rect { x, y, h, .. } = placed.name;
            canvas.text([x + 1.0, y + h / 2.0], name, &set);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes of 30 by 9 in every place about each of these points.
    fn named(points: &[[f64; 2]]) -> (Vec<Vec<Placed>>, Vec<Rect>) {
        let places = |at: &[f64; 2]| {
            let every = FAR_PT.iter().flat_map(|far| (0..DIRECTIONS).map(move |to| (*far, to)));
            every.map(|(far, to)| Placed::new(*at, place(*at, [30.0, 9.0], far, to))).collect()
        };
        let marker = |at: &[f64; 2]| Rect { x: at[0] - 4.0, y: at[1] - 4.0, w: 8.0, h: 8.0 };
        (points.iter().map(places).collect(), points.iter().map(marker).collect())
    }

    #[test]
    fn names_of_a_crowd_neither_overlap_nor_do_their_leaders_cross() {
        let crowd: Vec<[f64; 2]> =
            (0..14_i32).map(|n| [100.0 + 6.0 * f64::from(n % 4), 100.0 + 7.0 * f64::from(n / 4)]).collect();
        let (places, markers) = named(&crowd);
        let settled = settled(&places, &markers);
        let led = settled.iter().filter(|placed| placed.leader.is_some()).count();
        assert!(led >= 4, "no crowd: {led} of 14 names need a leader");
        for (index, one) in settled.iter().enumerate() {
            for (other, two) in settled.iter().enumerate().skip(index + 1) {
                assert!(one.against(two) == 0.0, "names {index} and {other} are in each other's way");
            }
        }
    }

    #[test]
    fn no_name_covers_a_bar() {
        let at = [100.0, 100.0];
        let size = [30.0, 9.0];
        let frame = Rect { x: 0.0, y: 0.0, w: 200.0, h: 200.0 };
        let bars = [[[70.0, 100.0], [130.0, 100.0]], [[100.0, 85.0], [100.0, 115.0]]];
        let covering = |places: &[Placed]| {
            places.iter().filter(|one| bars.iter().any(|bar| passes(*bar, one.name))).count()
        };
        assert!(covering(&free(at, size, frame, &[], &[])) > 0, "no place is in the bars' way");
        let places = free(at, size, frame, &[], &bars);
        assert!(covering(&places) == 0 && places.len() > DIRECTIONS, "{} places", places.len());
    }

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
