//! How panels share a page.

use super::axis::{Axis, Tick};
use super::legend::{self, Key};
use super::{Panel, TAKES_ALL, Trim, View};
use crate::render::RenderError;
use crate::render::canvas::pen::{Pen, text_style, units};
use crate::render::canvas::{Align, Canvas, Rect, Stand, Type};
use crate::render::font::{LINE_EM, Weight, wrapped};
use crate::render::style::{Dash, GREY, GRID, INK, Stroke, TextSize, Width};
use crate::render::vector::{Figure, Provenance};
use plotters::chart::ChartBuilder;
use plotters::coord::combinators::BindKeyPoints as _;
use plotters::prelude::DrawingArea;

const EDGE_PT: f64 = 3.0;
const TICK_PT: f64 = 2.25;
/// From the frame to a tick's label: twice the tick, as plotters has it.
const LABEL_PT: f64 = 2.0 * TICK_PT;
/// Room that an axis label needs below its baseline.
const DROP_PT: f64 = 2.5;
const TICK: Type = Type::regular(TextSize::TICK);
const LABEL: Type = Type::regular(TextSize::LABEL);
/// Turn of names under a horizontal axis that is too short for them.
const TILT_DEG: f64 = -35.0;

/// Panels in equal columns under one title, above one legend and one note.
pub struct Sheet {
    width: Width,
    columns: usize,
    plot_pt: f64,
    title: String,
    note: String,
    panels: Vec<Panel>,
    level: bool,
}

/// Room left of and above the plot of one panel: for its axis, its title and what its marks ask for.
#[derive(Clone, Copy, Default)]
struct Margin {
    left: f64,
    head: f64,
    over: f64,
}

fn line_pt(size: TextSize) -> f64 {
    size.pt() * LINE_EM
}

impl Sheet {
    /// A sheet of `columns` columns (at least one) whose plots are at most `plot_pt` points high.
    pub fn new(width: Width, columns: usize, plot_pt: f64) -> Self {
        let title = String::new();
        let note = String::new();
        Self { width, columns: columns.max(1), plot_pt, title, note, panels: Vec::new(), level: false }
    }

    /// The same under a title in bold; it is wrapped to the page.
    #[must_use]
    pub fn titled(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    /// The same with one more note below the legend; notes are wrapped to the page.
    #[must_use]
    pub fn noted(self, note: impl Into<String>) -> Self {
        let note = note.into();
        let gap = if self.note.is_empty() || note.is_empty() { "" } else { " " };
        Self { note: [self.note.as_str(), note.as_str()].join(gap), ..self }
    }

    /// The same with plots of equal width in all columns, whatever room their labels take.
    #[must_use]
    pub fn level(self) -> Self {
        Self { level: true, ..self }
    }

    /// Puts `panel` in the next place, row by row.
    pub fn add(&mut self, panel: Panel) {
        self.panels.push(panel);
    }

    /// The same with `panels` in the next places.
    #[must_use]
    pub fn with(mut self, panels: impl IntoIterator<Item = Panel>) -> Self {
        self.panels.extend(panels);
        self
    }

    /// Draws everything.
    ///
    /// # Errors
    /// [`RenderError::NoRoom`] if labels leave a panel too little room; the errors of [`Canvas::finish`].
    pub fn draw(&self, provenance: &Provenance) -> Result<Figure, RenderError> {
        let inner_pt = self.width.pt() - 2.0 * EDGE_PT;
        let title = wrapped(&self.title, Weight::Bold, inner_pt / TextSize::TITLE.pt());
        let note = wrapped(&self.note, Weight::Regular, inner_pt / TextSize::TICK.pt());
        let mut y = EDGE_PT + title.len() as f64 * line_pt(TextSize::TITLE);
        let mut views = Vec::new();
        for (row, panels) in self.panels.chunks(self.columns).enumerate() {
            let (placed, height) = self.row(row, panels, y)?;
            views.extend(placed);
            y += height;
        }
        let keys = self.keys(&views);
        let legend = Rect { x: EDGE_PT, y, w: inner_pt, h: legend::height_pt(&keys, inner_pt) };
        let below = legend.bottom() + if note.is_empty() { 0.0 } else { 3.0 };
        let height_pt = below + note.len() as f64 * line_pt(TextSize::TICK) + EDGE_PT;
        let mut canvas = Canvas::new(self.width, height_pt);
        let set = Type::regular(TextSize::TITLE).bold().aligned(Align::Start, Stand::Below);
        lines(&mut canvas, &title, [EDGE_PT, EDGE_PT], &set);
        for (index, (panel, (view, margin))) in self.panels.iter().zip(&views).enumerate() {
            self.heading(&mut canvas, index, view, margin);
            panel.draw(&mut canvas, view);
        }
        legend::draw(&mut canvas, &keys, legend);
        let set = TICK.colored(GREY.mixed(INK, 0.4)).aligned(Align::Start, Stand::Below);
        lines(&mut canvas, &note, [EDGE_PT, below], &set);
        canvas.finish(provenance)
    }

    fn keys(&self, views: &[(View, Margin)]) -> Vec<Key> {
        let mut keys: Vec<Key> = Vec::new();
        for (panel, (view, _)) in self.panels.iter().zip(views) {
            for key in panel.marks.iter().flat_map(|mark| mark.keys(view)) {
                if !keys.contains(&key) {
                    keys.push(key);
                }
            }
        }
        keys
    }

    fn cell_pt(&self) -> (f64, f64) {
        let gap = if self.columns > 1 { 9.0 } else { 0.0 };
        let gaps = gap * (self.columns - 1) as f64;
        ((self.width.pt() - 2.0 * EDGE_PT - gaps) / self.columns as f64, gap)
    }

    /// Where each column begins and how wide it is.
    fn column_spans(&self) -> Vec<(f64, f64)> {
        let (cell, gap) = self.cell_pt();
        let widths: Vec<f64> = if self.level {
            let sides: Vec<f64> = self.sides(cell).iter().map(|(left, right)| left + right).collect();
            let plot = cell - sides.iter().sum::<f64>() / self.columns as f64;
            sides.iter().map(|side| side + plot).collect()
        } else {
            vec![cell; self.columns]
        };
        let spans = widths.iter().scan(EDGE_PT, |x, width| {
            let from = *x;
            *x += width + gap;
            Some((from, *width))
        });
        spans.collect()
    }

    /// Places one row of panels at height `y`; also the height that it takes.
    fn row(&self, row: usize, panels: &[Panel], y: f64) -> Result<(Vec<(View, Margin)>, f64), RenderError> {
        let columns = self.column_spans();
        let side = self.sides(self.cell_pt().0);
        let mut placed = Vec::new();
        let mut head = 0.0_f64;
        let mut over = 0.0_f64;
        let mut tallest = 0.0_f64;
        let mut foot = 0.0_f64;
        for (column, panel) in panels.iter().enumerate() {
            let (left, right) = if panel.trim == Trim::Bare { (0.0, 0.0) } else { side[column] };
            let (from, cell) = columns[column];
            let x = from + left;
            let frame = panel.fitted(Rect { x, y: 0.0, w: cell - left - right, h: self.plot_pt });
            if frame.w < 30.0 || frame.h < 30.0 {
                let panel = row * self.columns + column;
                return Err(RenderError::NoRoom { panel, width_pt: frame.w, height_pt: frame.h });
            }
            let view = View { frame, x: panel.x.clone(), y: panel.y.clone() };
            let heading = self.heading_lines(row * self.columns + column, cell).len();
            head = head.max(if heading > 0 { heading as f64 * line_pt(TextSize::LABEL) + 4.0 } else { 4.0 });
            over = panel.marks.iter().map(|mark| mark.headroom_pt(&view)).fold(over, f64::max);
            tallest = tallest.max(frame.h);
            foot = foot.max(panel.foot(&view));
            placed.push((view, Margin { left: frame.x - (x - left), ..Margin::default() }));
        }
        for (view, margin) in &mut placed {
            view.frame.y = y + head + over;
            *margin = Margin { head, over, ..*margin };
        }
        Ok((placed, head + over + tallest + foot + 5.0))
    }

    /// Room left and right of the plots of each column, so that they line up.
    fn sides(&self, cell: f64) -> Vec<(f64, f64)> {
        let mut side = vec![(0.0_f64, 4.0_f64); self.columns];
        for (index, panel) in self.panels.iter().enumerate().filter(|(_, panel)| panel.trim != Trim::Bare) {
            let (left, right) = &mut side[index % self.columns];
            let guess = panel.fitted(Rect { x: 0.0, y: 0.0, w: cell * 0.8, h: self.plot_pt });
            *left = left.max(panel.left(guess.h)).max(panel.left(self.plot_pt.min(guess.h * 1.25)));
            *right = right.max(panel.right(guess.w));
        }
        side
    }

    fn heading_lines(&self, index: usize, cell: f64) -> Vec<String> {
        let indent = if self.panels.len() > 1 { 16.0 } else { 0.0 };
        let lines =
            wrapped(&self.panels[index].title, Weight::Regular, (cell - indent) / TextSize::LABEL.pt());
        if lines.is_empty() && self.panels.len() > 1 { vec![String::new()] } else { lines }
    }

    fn heading(&self, canvas: &mut Canvas, index: usize, view: &View, margin: &Margin) {
        let (_, cell) = self.column_spans()[index % self.columns];
        let set = LABEL.aligned(Align::Start, Stand::Below);
        let (x, y) = (view.frame.x - margin.left, view.frame.y - margin.over - margin.head + 2.0);
        let several = self.panels.len() > 1;
        if several {
            canvas.text([x, y], &format!("({})", letter(index)), &set.bold());
        }
        let indent = if several { 16.0 } else { 0.0 };
        lines(canvas, &self.heading_lines(index, cell), [x + indent, y], &set);
    }
}

/// a…z, then aa, ab and so on.
fn letter(index: usize) -> String {
    let last = char::from(b'a' + (index % 26) as u8);
    if index < 26 { last.to_string() } else { letter(index / 26 - 1) + &last.to_string() }
}

fn lines(canvas: &mut Canvas, lines: &[String], [x, y]: [f64; 2], set: &Type) {
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| !line.is_empty()) {
        canvas.text([x, y + index as f64 * line_pt(set.size)], line, set);
    }
}

impl Panel {
    /// The plot inside `room`: all of it, or as much as equal scales allow, centred.
    fn fitted(&self, room: Rect) -> Rect {
        let span = |axis: &Axis| (axis.ends()[1] - axis.ends()[0]).abs();
        if !self.equal {
            return room;
        }
        let shape = span(&self.y) / span(&self.x);
        let w = room.w.min(room.h / shape);
        Rect { x: room.x + (room.w - w) / 2.0, y: room.y, w, h: w * shape }
    }

    fn left(&self, height_pt: f64) -> f64 {
        let widest =
            self.y.ticks(height_pt, false).iter().map(|tick| TICK.width_pt(&tick.label)).fold(0.0, f64::max);
        let label = if self.y.label().is_empty() { 0.0 } else { line_pt(TextSize::LABEL) };
        label + widest + LABEL_PT + 0.5
    }

    fn right(&self, width_pt: f64) -> f64 {
        let over = |tick: &Tick| TICK.width_pt(&tick.label) / 2.0 - (1.0 - self.x.share(tick.at)) * width_pt;
        let ticks = self.x.ticks(width_pt, true);
        if self.x.fits(&ticks, width_pt) { ticks.iter().map(over).fold(0.0, f64::max) + 1.0 } else { 1.0 }
    }

    fn foot(&self, view: &View) -> f64 {
        if self.trim == Trim::Bare {
            return 0.0;
        }
        let ticks = self.x.ticks(view.frame.w, true);
        let label = if self.x.label().is_empty() { 0.0 } else { line_pt(TextSize::LABEL) };
        LABEL_PT + self.names_height(&ticks, view.frame.w) + label
    }

    fn names_height(&self, ticks: &[Tick], width_pt: f64) -> f64 {
        if self.x.fits(ticks, width_pt) {
            return line_pt(TextSize::TICK);
        }
        let widest = ticks.iter().map(|tick| TICK.width_pt(&tick.label)).fold(0.0, f64::max);
        let (sine, cosine) = libm::sincos(-TILT_DEG.to_radians());
        widest * sine + TextSize::TICK.pt() * cosine
    }

    fn draw(&self, canvas: &mut Canvas, view: &View) {
        let frame = view.frame;
        let (xs, ys) = (view.x.ticks(frame.w, true), view.y.ticks(frame.h, false));
        if self.trim != Trim::Bare {
            self.mesh(canvas, view, &xs, &ys);
        }
        canvas.clipped(frame, |canvas| self.marks.iter().for_each(|mark| mark.draw(canvas, view)));
        if self.trim != Trim::Bare {
            canvas.rect(frame, None, Some(&Stroke::solid(INK, 0.6)));
            minor_ticks(canvas, view, &xs, &ys);
            if !self.x.fits(&xs, frame.w) {
                tilted_names(canvas, view, &xs);
            }
        }
        self.marks.iter().for_each(|mark| mark.draw_over(canvas, view));
    }

    /// The mesh of plotters: grid, ticks, their labels, labels of the axes.
    fn mesh(&self, canvas: &mut Canvas, view: &View, xs: &[Tick], ys: &[Tick]) {
        let frame = view.frame;
        let left = self.left(view.frame.h);
        let foot = self.foot(view) - DROP_PT;
        let area = DrawingArea::from(Pen::new(canvas, Dash::Solid))
            .shrink((units(frame.x - left), units(frame.y)), (units(left + frame.w), units(frame.h + foot)));
        let (x, y) = (view.x.clone(), view.y.clone());
        let mut chart = ChartBuilder::on(&area)
            .x_label_area_size(units(foot))
            .y_label_area_size(units(left))
            .build_cartesian_2d(x.with_key_points(places(xs)), y.with_key_points(places(ys)))
            .expect(TAKES_ALL);
        let level = self.x.fits(xs, frame.w);
        let name_x = |at: &f64| if level { name(xs, *at) } else { String::new() };
        let name_y = |at: &f64| name(ys, *at);
        let mut mesh = chart.configure_mesh();
        mesh.bold_line_style(Stroke::solid(GRID, 0.4)).axis_style(Stroke::solid(INK, 0.5));
        mesh.label_style(text_style(&TICK)).axis_desc_style(text_style(&LABEL));
        mesh.x_label_formatter(&name_x).y_label_formatter(&name_y);
        mesh.x_desc(self.x.label()).y_desc(self.y.label()).set_all_tick_mark_size(units(TICK_PT));
        if self.trim == Trim::Frame {
            mesh.disable_mesh();
        }
        mesh.draw().expect(TAKES_ALL);
    }
}

/// Where the named ticks stand, for plotters to draw.
fn places(ticks: &[Tick]) -> Vec<f64> {
    ticks.iter().filter(|tick| !tick.label.is_empty()).map(|tick| tick.at).collect()
}

fn name(ticks: &[Tick], at: f64) -> String {
    ticks.iter().find(|tick| tick.at == at).map(|tick| tick.label.clone()).unwrap_or_default()
}

/// Short ticks without grid line and label, which the mesh of plotters does not have.
fn minor_ticks(canvas: &mut Canvas, view: &View, xs: &[Tick], ys: &[Tick]) {
    let [left, bottom] = [view.frame.x, view.frame.bottom()];
    let thin = Stroke::solid(INK, 0.5);
    let [low_x, low_y] = [view.x.ends()[0], view.y.ends()[0]];
    for tick in xs.iter().filter(|tick| tick.label.is_empty()) {
        let [x, _] = view.at([tick.at, low_y]);
        canvas.polyline(&[[x, bottom], [x, bottom + TICK_PT * 0.6]], &thin);
    }
    for tick in ys.iter().filter(|tick| tick.label.is_empty()) {
        let [_, y] = view.at([low_x, tick.at]);
        canvas.polyline(&[[left - TICK_PT * 0.6, y], [left, y]], &thin);
    }
}

/// Names that are too long to stand side by side; plotters turns text by right angles only.
fn tilted_names(canvas: &mut Canvas, view: &View, ticks: &[Tick]) {
    let set = Type { turn_deg: TILT_DEG, ..TICK.aligned(Align::End, Stand::Centre) };
    for tick in ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let [x, _] = view.at([tick.at, view.y.ends()[0]]);
        canvas.text([x + 1.0, view.frame.bottom() + LABEL_PT + 1.0], &tick.label, &set);
    }
}
