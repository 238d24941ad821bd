//! An index of points: which of them are near a configuration.
//!
//! Results are those of measuring every point; of equally far points the older one is nearer. Points are measured eight side by side. The
//! newest are measured all. Older ones lie in packs of 512, 1024, 2048, ... points, each below a hierarchy of boxes, eight in a box; boxes
//! farther away than what is found are passed over. Two packs of a size become one of twice the size, so whatever the order of points, a pack's boxes
//! are those of a balanced k-d tree, and a point is moved once per doubling.
//!
//! Crates for k-d trees (kiddo) were not measured beside it, since they lack what planners need here. The number of axes is known at run
//! time only. Joints that turn on are near across the turn. The older of two equally far points is first, and points are hidden one by one.
//!
//! # Source
//! Bentley & Saxe, *Decomposable Searching Problems I*, J. Algorithms 1(4), 301 (1980).

use std::collections::BinaryHeap;
use std::f64::consts::TAU;
use world::geometry::lanes::{dispatch, level};

/// How many points or boxes are measured side by side.
const GROUP: usize = 8;

/// How many points the least pack holds: a power of two, and of eight.
const LEAST_PACK: usize = 512;

/// How much nearer than computed a box of angles may be, radians: far more than rounding.
const SLACK_RAD: f64 = 1e-9;

/// A value of each of eight points or boxes.
type Row = [f64; GROUP];

/// A number that orders as the square of a distance does, and a point: of equal squares the older point comes first.
type Rank = (u64, u32);

/// Points in space, numbered as they were added.
#[derive(Debug, Clone)]
pub struct Index {
    turn_on: Vec<bool>,
    /// All coordinates, point by point.
    points: Vec<f64>,
    /// Which points are near nothing any more.
    hidden: Vec<bool>,
    /// From the largest to the smallest, no two of a size.
    packs: Vec<Pack>,
    /// The points in no pack, by group, then by coordinate; what fills the last group is infinitely far.
    newest: Vec<Row>,
}

/// Points whose order is that of a balanced tree.
#[derive(Debug, Clone)]
struct Pack {
    numbers: Vec<u32>,
    /// By group, then by coordinate.
    points: Vec<Row>,
    /// The boxes of groups of points, the boxes of groups of those, and so on up to a single group.
    levels: Vec<Vec<[Row; 2]>>,
}

/// A group of boxes or, on level 0, of points that is still to be measured.
struct Waiting {
    square: f64,
    pack: usize,
    level: usize,
    group: usize,
}

impl Index {
    /// An index without points; `turn_on` says which coordinates are angles of joints that turn without end.
    pub fn new(turn_on: &[bool]) -> Self {
        Self {
            turn_on: turn_on.to_vec(),
            points: Vec::new(),
            hidden: Vec::new(),
            packs: Vec::new(),
            newest: Vec::new(),
        }
    }

    /// How many points it has.
    pub fn count(&self) -> usize {
        self.hidden.len()
    }

    /// A point.
    pub fn point(&self, number: u32) -> &[f64] {
        let axes = self.turn_on.len();
        &self.points[number as usize * axes..][..axes]
    }

    /// Adds a point; gives its number.
    pub fn add(&mut self, point: &[f64]) -> u32 {
        let number = self.count();
        let axes = self.turn_on.len();
        self.points.extend_from_slice(point);
        self.hidden.push(false);
        let lane = number % GROUP;
        if lane == 0 {
            self.newest.resize(self.newest.len() + axes, [f64::INFINITY; GROUP]);
        }
        let group = self.newest.len() - axes;
        for (row, value) in self.newest[group..].iter_mut().zip(point) {
            row[lane] = *value;
        }
        let count = number + 1;
        if count.is_multiple_of(LEAST_PACK) {
            let mut numbers: Vec<u32> = ((count - LEAST_PACK) as u32..count as u32).collect();
            while let Some(last) = self.packs.pop_if(|pack| pack.numbers.len() == numbers.len()) {
                numbers.extend(last.numbers);
            }
            self.newest.clear();
            self.packs.push(Pack::new(numbers, &self.points, &self.turn_on));
        }
        number as u32
    }

    /// Hides a point: it keeps its number and is near nothing any more.
    pub fn hide(&mut self, number: u32) {
        self.hidden[number as usize] = true;
    }

    /// Whether a point is hidden.
    pub fn is_hidden(&self, number: u32) -> bool {
        self.hidden[number as usize]
    }

    /// The point nearest to a configuration, and how far it is; (0, infinity) without points.
    pub fn nearest(&self, config: &[f64]) -> (u32, f64) {
        let mut best: Rank = (f64::INFINITY.to_bits(), 0);
        self.search(config, |rank| {
            best = best.min(rank);
            best.0
        });
        (best.1, f64::from_bits(best.0).sqrt())
    }

    /// The `count` points nearest to a configuration, nearest first, each with how far it is.
    pub fn nearest_of(&self, config: &[f64], count: usize) -> Vec<(u32, f64)> {
        let mut best: BinaryHeap<Rank> = BinaryHeap::with_capacity(count + 1);
        self.search(config, |rank| {
            best.push(rank);
            if best.len() > count {
                best.pop();
            }
            if best.len() < count { f64::INFINITY.to_bits() } else { best.peek().map_or(0, |last| last.0) }
        });
        best.into_sorted_vec()
            .into_iter()
            .map(|(square, node)| (node, f64::from_bits(square).sqrt()))
            .collect()
    }

    /// Shows every point that is at most as far as `visit` last answered.
    fn search(&self, config: &[f64], mut visit: impl FnMut(Rank) -> u64) {
        let mut last = f64::INFINITY.to_bits();
        let visit = |rank: Rank| {
            if !self.is_hidden(rank.1) {
                last = visit(rank);
            }
            last
        };
        dispatch!(level(), _simd => self.descend(config, visit));
    }

    #[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
    #[inline(always)]
    fn descend(&self, config: &[f64], mut visit: impl FnMut(Rank) -> u64) {
        let axes = config.len();
        let mut reach = f64::INFINITY;
        let first = self.count() / LEAST_PACK * LEAST_PACK;
        for (group, rows) in self.newest.chunks_exact(axes).enumerate() {
            let squares = squares_of_points(config, &self.turn_on, rows);
            show(squares, |lane| (first + group * GROUP + lane) as u32, &mut reach, &mut visit);
        }
        let top =
            |(pack, of): (usize, &Pack)| Waiting { square: 0.0, pack, level: of.levels.len(), group: 0 };
        let mut waiting: Vec<Waiting> = self.packs.iter().enumerate().rev().map(top).collect();
        while let Some(Waiting { square, pack, level, group }) = waiting.pop() {
            if square > reach {
                continue;
            }
            let of = &self.packs[pack];
            let Some(below) = level.checked_sub(1) else {
                let squares = squares_of_points(config, &self.turn_on, &of.points[group * axes..][..axes]);
                show(squares, |lane| of.numbers[group * GROUP + lane], &mut reach, &mut visit);
                continue;
            };
            let squares = squares_of_boxes(config, &self.turn_on, &of.levels[below][group * axes..][..axes]);
            let boxes = waiting.len();
            for (lane, square) in squares.into_iter().enumerate() {
                if square <= reach && square < f64::INFINITY {
                    waiting.push(Waiting { square, pack, level: below, group: group * GROUP + lane });
                }
            }
            waiting[boxes..].sort_unstable_by(|a, b| b.square.total_cmp(&a.square));
        }
    }
}

impl Pack {
    fn new(mut numbers: Vec<u32>, points: &[f64], turn_on: &[bool]) -> Self {
        let axes = turn_on.len();
        arrange(&mut numbers, points, axes);
        let of = |number: &u32| &points[*number as usize * axes..][..axes];
        let mut boxes: Vec<[f64; 2]> = numbers.iter().flat_map(of).map(|value| [*value; 2]).collect();
        let rows = in_rows(&boxes, axes, |[value, _]| [value; 2]);
        let points = rows.into_iter().map(|[row, _]| row).collect();
        let mut levels = Vec::new();
        while boxes.len() > GROUP * axes {
            boxes = boxes.chunks(GROUP * axes).flat_map(|group| hull(group, axes)).collect();
            levels.push(in_rows(&boxes, axes, |ends| ends));
        }
        for (row, turns_on) in levels.iter_mut().flatten().zip(turn_on.iter().cycle()) {
            if *turns_on {
                *row = middles_and_halves(*row);
            }
        }
        Self { numbers, points, levels }
    }
}

/// Puts points in the order of a balanced tree: half of them below the median of the widest axis, and so on down to groups.
fn arrange(numbers: &mut [u32], points: &[f64], axes: usize) {
    if numbers.len() <= GROUP {
        return;
    }
    let value = |number: u32, axis: usize| points[number as usize * axes + axis];
    let width = |axis: usize| {
        let (low, high) = numbers.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
            (value(*number, axis).min(low), value(*number, axis).max(high))
        });
        high - low
    };
    let widths: Vec<f64> = (0..axes).map(width).collect();
    let widest = (0..axes).max_by(|a, b| widths[*a].total_cmp(&widths[*b])).unwrap_or(0);
    let middle = numbers.len() / 2;
    numbers.select_nth_unstable_by(middle, |a, b| value(*a, widest).total_cmp(&value(*b, widest)));
    let (below, above) = numbers.split_at_mut(middle);
    arrange(below, points, axes);
    arrange(above, points, axes);
}

/// The box about boxes: the least and the greatest value of each coordinate.
fn hull(boxes: &[[f64; 2]], axes: usize) -> Vec<[f64; 2]> {
    let mut hull = boxes[..axes].to_vec();
    for (place, [low, high]) in boxes.iter().enumerate().skip(axes) {
        let [least, greatest] = &mut hull[place % axes];
        (*least, *greatest) = (least.min(*low), greatest.max(*high));
    }
    hull
}

/// Boxes side by side, by group, then by coordinate; what fills the last group is infinitely far.
fn in_rows(boxes: &[[f64; 2]], axes: usize, ends: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[Row; 2]> {
    let mut rows = vec![[[f64::INFINITY; GROUP]; 2]; boxes.len().div_ceil(GROUP * axes) * axes];
    for (place, of) in boxes.iter().enumerate() {
        let (number, axis) = (place / axes, place % axes);
        let [low, high] = ends(*of);
        let row = &mut rows[number / GROUP * axes + axis];
        (row[0][number % GROUP], row[1][number % GROUP]) = (low, high);
    }
    rows
}

/// What is kept of angles: the middle between both ends and how far they are from it.
fn middles_and_halves([low, high]: [Row; 2]) -> [Row; 2] {
    let mut kept = [low, [0.0; GROUP]];
    for lane in (0..GROUP).filter(|lane| low[*lane] < f64::INFINITY) {
        kept[0][lane] = 0.5 * (low[lane] + high[lane]);
        kept[1][lane] = 0.5 * (high[lane] - low[lane]) + SLACK_RAD;
    }
    kept
}

/// Shows the points of a group that are within reach, and takes the new reach.
#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn show(squares: Row, number: impl Fn(usize) -> u32, reach: &mut f64, mut visit: impl FnMut(Rank) -> u64) {
    for (lane, square) in squares.into_iter().enumerate() {
        if square <= *reach && square < f64::INFINITY {
            *reach = f64::from_bits(visit((square.to_bits(), number(lane))));
        }
    }
}

/// An angle the shorter way round.
#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn turned(gap: f64) -> f64 {
    if gap.is_finite() { gap - TAU * (gap / TAU).round() } else { gap }
}

/// The squares of how far points are from a configuration.
#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn squares_of_points(config: &[f64], turn_on: &[bool], points: &[Row]) -> Row {
    let mut squares = [0.0; GROUP];
    for ((values, own), turns_on) in points.iter().zip(config).zip(turn_on) {
        for (square, value) in squares.iter_mut().zip(values) {
            let gap = if *turns_on { turned(value - own) } else { value - own };
            *square += gap * gap;
        }
    }
    squares
}

/// The squares of how far the nearest points of boxes are from a configuration, none greater than the computed square of a point in the box.
#[expect(clippy::inline_always, reason = "it is compiled for the instructions of its caller")]
#[inline(always)]
fn squares_of_boxes(config: &[f64], turn_on: &[bool], boxes: &[[Row; 2]]) -> Row {
    let mut squares = [0.0; GROUP];
    for (([one, other], own), turns_on) in boxes.iter().zip(config).zip(turn_on) {
        for lane in 0..GROUP {
            let gap = if *turns_on {
                turned(one[lane] - own).abs() - other[lane]
            } else {
                (one[lane] - own).max(own - other[lane])
            };
            let gap = gap.max(0.0);
            squares[lane] += gap * gap;
        }
    }
    squares
}
