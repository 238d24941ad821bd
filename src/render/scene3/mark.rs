//! A scene as a mark on a sheet.

use super::order::{Item, Look, back_to_front};
use super::{Camera, Chain, Scene, Tag, Vec3, dot, sub};
use crate::render::canvas::{Align, Canvas, Rect, Stand, Type};
use crate::render::chart::axis::bounds;
use crate::render::chart::{Axis, Key, Mark, Panel, Trim, View};
use crate::render::style::{BLUE, Fill, GREEN, HAIR_PT, INK, Rgb, Stroke, TextSize, VERMILLION};

/// A bar that shows how long a length looks.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleBar {
    /// Length in the scene.
    pub length: f64,
    /// Text beside it, with unit.
    pub label: String,
}

/// A scene seen by a camera, filling the frame of its panel.
#[derive(Clone, Debug)]
pub struct SceneMark {
    /// What there is to see.
    pub scene: Scene,
    /// From where.
    pub camera: Camera,
    /// The scale bar.
    pub bar: Option<ScaleBar>,
    /// Entries for the legend.
    pub keys: Vec<Key>,
}

/// A panel without axes that shows `scene` alone, with a scale bar of this length and unit.
pub fn panel(
    title: impl Into<String>,
    scene: Scene,
    camera: Camera,
    (length, unit): (f64, &str),
    keys: Vec<Key>,
) -> Panel {
    let bar = Some(ScaleBar { length, label: format!("{length} {unit}") });
    let bare = || Axis::over("", []);
    let mut panel = Panel::new(title, bare(), bare()).trimmed(Trim::Bare);
    panel.add(SceneMark { scene, camera, bar, keys });
    panel
}

/// Height kept free at the foot of the frame for the axes' directions and the scale bar.
const FOOT_PT: f64 = 30.0;

/// The map from the world to the page.
pub(super) struct Lens {
    camera: Camera,
    middle: Vec3,
    scale: f64,
    shift: [f64; 2],
}

impl Lens {
    /// A lens that shows all of `scene` inside `room`.
    pub fn fitting(scene: &Scene, camera: Camera, room: Rect) -> Self {
        let (middle, _) = scene.ball();
        let mut lens = Self { camera, middle, scale: 1.0, shift: [0.0; 2] };
        let [low, high] = bounds(scene.extent().map(|point| lens.at(point)));
        let span = |axis: usize| (high[axis] - low[axis]).max(1e-300);
        lens.scale = (room.w / span(0)).min(room.h / span(1));
        lens.shift = [
            room.x + room.w / 2.0 - lens.scale * low[0].midpoint(high[0]),
            room.y + room.h / 2.0 - lens.scale * low[1].midpoint(high[1]),
        ];
        lens
    }

    /// Where a point of the world lies on the page.
    pub fn at(&self, point: Vec3) -> [f64; 2] {
        let [right, up, _] = self.camera.axes();
        let offset = sub(point, self.middle);
        let place = |axis: Vec3, sign: f64| self.scale * sign * dot(offset, axis);
        [self.shift[0] + place(right, 1.0), self.shift[1] + place(up, -1.0)]
    }
}

impl SceneMark {
    /// Everything to draw, back to front.
    pub(super) fn items(&self) -> Vec<Item> {
        let mut items = Vec::new();
        for (solid, mesh) in self.scene.meshes.iter().enumerate() {
            items.extend(mesh.visible(solid, &self.camera));
        }
        for (index, chain) in self.scene.chains.iter().enumerate() {
            let solid = self.scene.meshes.len() + index;
            let piece = |pair: &[Vec3]| Item { solid, points: pair.to_vec(), look: Look::Line(chain.stroke) };
            items.extend(chain.points.windows(2).map(piece));
        }
        let (_, radius) = self.scene.ball();
        back_to_front(items, self.camera.axes()[2], radius * 1e-7)
    }

    fn triad(&self, canvas: &mut Canvas, foot: Rect) {
        let [right, up, back] = self.camera.axes();
        let centre = [foot.x + 15.0, foot.bottom() - 12.0];
        let mut arms = [(0, "x", VERMILLION), (1, "y", GREEN), (2, "z", BLUE)];
        arms.sort_by(|a, b| back[a.0].total_cmp(&back[b.0]));
        for (axis, name, color) in arms {
            let (dx, dy) = (right[axis], -up[axis]);
            if dx.abs().max(dy.abs()) < 0.15 {
                continue;
            }
            let end = |length: f64| [centre[0] + length * dx, centre[1] + length * dy];
            canvas.polyline(&[centre, end(11.0)], &Stroke::solid(color, 1.0));
            let length = 11.0 + 4.5 / libm::hypot(dx, dy);
            let set = Type::regular(TextSize::TICK).colored(color).aligned(Align::Middle, Stand::Centre);
            canvas.text(end(length), name, &set);
        }
    }

    fn scale_bar(&self, canvas: &mut Canvas, lens: &Lens, foot: Rect) {
        let Some(bar) = &self.bar else { return };
        let right = foot.right() - 4.0;
        let y = foot.bottom() - 5.0;
        let length = bar.length * lens.scale;
        let ink = Stroke::solid(INK, 1.0);
        canvas.polyline(&[[right - length, y], [right, y]], &ink);
        for x in [right - length, right] {
            canvas.polyline(&[[x, y - 2.0], [x, y + 2.0]], &ink);
        }
        let set = Type::regular(TextSize::TICK).aligned(Align::Middle, Stand::Base);
        let half = set.width_pt(&bar.label) / 2.0;
        let middle = (right - length / 2.0).min(foot.right() - half - 1.0);
        canvas.text([middle, y - 3.5], &bar.label, &set);
    }
}

/// Pieces of one look that are drawn together, each with the room it takes on the page.
struct Batch {
    look: Look,
    pieces: Vec<(Vec<[f64; 2]>, [f64; 4])>,
}

/// How many batches back a face looks for one of its colour.
const LOOK_BACK: usize = 2_000;
/// Faces with less on the page, square points, show nothing: the hairs of their neighbours cover them.
const LEAST_FACE: f64 = 0.05;

/// The least box around `points`, with room for a hair.
fn room_of(points: &[[f64; 2]]) -> [f64; 4] {
    let start = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    points.iter().fold(start, |[a, b, c, d], [x, y]| {
        [a.min(x - HAIR_PT), b.min(y - HAIR_PT), c.max(x + HAIR_PT), d.max(y + HAIR_PT)]
    })
}

fn meets(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>().abs() / 2.0
}

/// Items from back to front in batches. A face joins an earlier one of its colour if nothing drawn since meets it. Line
/// pieces that follow each other are one line, so that dashes run on.
fn batches(lens: &Lens, items: &[Item]) -> Vec<Batch> {
    let follows = |a: &Item, b: &Item| {
        let alike = matches!((a.look, b.look), (Look::Line(one), Look::Line(two)) if one == two);
        alike && a.points.last() == b.points.first()
    };
    let mut batches: Vec<Batch> = Vec::new();
    for run in items.chunk_by(follows) {
        let rest = run.iter().skip(1).flat_map(|item| item.points.iter().skip(1));
        let points: Vec<[f64; 2]> = run[0].points.iter().chain(rest).map(|&point| lens.at(point)).collect();
        let look = run[0].look;
        let room = room_of(&points);
        let own = opaque(look);
        if own.is_some() && area(&points) < LEAST_FACE {
            continue;
        }
        let free = |batch: &&mut Batch| !batch.pieces.iter().any(|(_, other)| meets(&room, other));
        let mut before = batches.iter_mut().rev().take(LOOK_BACK);
        let joined = before.find(|batch| own.is_some() && opaque(batch.look) == own || !free(batch));
        match joined.filter(|batch| own.is_some() && opaque(batch.look) == own) {
            Some(batch) => batch.pieces.push((points, room)),
            None => batches.push(Batch { look, pieces: vec![(points, room)] }),
        }
    }
    batches
}

/// The colour of a face that nothing shows through.
fn opaque(look: Look) -> Option<Rgb> {
    match look {
        Look::Face(_, color, opacity) if opacity >= 1.0 => Some(color),
        _ => None,
    }
}

fn draw_items(canvas: &mut Canvas, lens: &Lens, items: &[Item]) {
    for Batch { look, pieces } in batches(lens, items) {
        for (points, _) in &pieces {
            match look {
                Look::Face(_, color, opacity) if opacity >= 1.0 => canvas.face(points, color),
                Look::Face(_, color, opacity) => {
                    canvas.polygon(points, Some(Fill::sheer(color, opacity)), None);
                }
                Look::Line(stroke) => canvas.polyline(points, &stroke),
            }
        }
    }
}

/// A tag: a dotted one stands on that side of its point where least of the lines drawn over everything passes.
fn draw_tag(canvas: &mut Canvas, lens: &Lens, tag: &Tag, overlays: &[Vec<[f64; 2]>]) {
    let set = Type { rim: true, ..Type::regular(TextSize::TICK).aligned(Align::Start, Stand::Centre) };
    let [x, y] = lens.at(tag.at);
    if !tag.dotted {
        canvas.text([x, y], &tag.text, &set.aligned(Align::Middle, Stand::Centre));
        return;
    }
    canvas.circle([x, y], 1.3, Some(Fill::solid(INK)), None);
    let width = set.width_pt(&tag.text);
    let half = TextSize::TICK.pt() / 2.0;
    let sides = [(1.0, -3.0), (-1.0, -3.0), (1.0, 5.0), (-1.0, 5.0)];
    let covered = |(side, down): (f64, f64)| {
        let near = side * (3.5 + width / 2.0);
        let place = Rect { x: x + near - width / 2.0, y: y + down - half, w: width, h: 2.0 * half };
        overlays.iter().map(|line| inside(line, &place)).sum::<usize>()
    };
    let (side, down) = sides.into_iter().min_by_key(|&side| covered(side)).unwrap_or(sides[0]);
    let align = if side > 0.0 { Align::Start } else { Align::End };
    canvas.text([x + side * 3.5, y + down], &tag.text, &set.aligned(align, Stand::Centre));
}

/// How many points of a line, one a point of length, lie in `place`.
fn inside(line: &[[f64; 2]], place: &Rect) -> usize {
    let holds = |[x, y]: [f64; 2]| x > place.x && x < place.right() && y > place.y && y < place.bottom();
    let points = line.windows(2).flat_map(|pair| {
        let [dx, dy] = [0, 1].map(|axis| pair[1][axis] - pair[0][axis]);
        let count = libm::hypot(dx, dy).ceil().max(1.0);
        (0..=count as u32).map(move |k| {
            let share = f64::from(k) / count;
            [pair[0][0] + share * dx, pair[0][1] + share * dy]
        })
    });
    points.filter(|&at| holds(at)).count()
}

impl Mark for SceneMark {
    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let frame = view.frame;
        let room = Rect { x: frame.x + 6.0, y: frame.y + 3.0, w: frame.w - 12.0, h: frame.h - FOOT_PT - 3.0 };
        let lens = Lens::fitting(&self.scene, self.camera, room);
        draw_items(canvas, &lens, &self.items());
        let over = |chain: &Chain| chain.points.iter().map(|&point| lens.at(point)).collect();
        let overlays: Vec<Vec<[f64; 2]>> = self.scene.overlays.iter().map(over).collect();
        for (points, chain) in overlays.iter().zip(&self.scene.overlays) {
            canvas.polyline(points, &chain.stroke);
        }
        let foot = Rect { y: frame.bottom() - FOOT_PT, h: FOOT_PT, ..frame };
        self.triad(canvas, foot);
        self.scale_bar(canvas, &lens, foot);
        for tag in &self.scene.tags {
            draw_tag(canvas, &lens, tag, &overlays);
        }
    }

    fn keys(&self, _: &View) -> Vec<Key> {
        self.keys.clone()
    }
}
