use super::marks::{Line, Note, Points};
use super::rules::Rules;
use super::*;
use crate::render::RenderError;
use crate::render::style::{BLUE, Marker, Stroke, Width, series_stroke};
use crate::render::vector::{Figure, Provenance};

fn provenance() -> Provenance {
    Provenance { command: "replan render demo".into(), spec_hash: "0".into(), title: "demo".into() }
}

fn sheet(panels: usize, columns: usize) -> Sheet {
    let mut sheet = Sheet::new(Width::Double, columns, 110.0).titled("A title").noted("A note.");
    for index in 0..panels {
        let axes = (Axis::linear("step", 0.0, 100.0), Axis::linear("angle / °", -180.0, 180.0));
        let mut panel = Panel::new("wave", axes.0.unwrap(), axes.1.unwrap());
        let wave = (0..=100).map(|x| [f64::from(x), 170.0 * libm::sin(f64::from(x) / 9.0)]).collect();
        panel.add(Line::through(wave, series_stroke(index)).labelled(format!("joint {index}")));
        panel.add(Rules {
            marks: vec![(40.0, "here".into()), (45.0, "there".into())],
            stroke: Stroke::solid(BLUE, 1.0),
        });
        panel.add(Note::beside([10.0, 0.0], "start"));
        sheet.add(panel);
    }
    sheet
}

fn draw(sheet: &Sheet) -> Figure {
    sheet.draw(&provenance()).unwrap()
}

#[test]
fn labels_of_a_sheet_never_overlap_or_leave_it() {
    for (panels, columns) in [(1, 1), (2, 2), (3, 3), (5, 2), (4, 4)] {
        let figure = draw(&sheet(panels, columns));
        assert_eq!(figure.flaws, Vec::<String>::new(), "{panels} panels in {columns} columns");
    }
}

#[test]
fn several_panels_are_lettered_and_one_is_not() {
    assert!(draw(&sheet(3, 3)).svg.contains("aria-label=\"(c)\""));
    assert!(!draw(&sheet(1, 1)).svg.contains("aria-label=\"(a)\""));
}

#[test]
fn an_entry_of_the_legend_appears_once_however_many_panels_use_it() {
    let mut sheet = Sheet::new(Width::Single, 2, 60.0);
    for _ in 0..2 {
        let mut panel = Panel::new("", Axis::over("x", [0.0, 2.0]), Axis::over("y", [0.0, 2.0]));
        let points = vec![[1.0, 1.0]];
        let label = "both".to_owned();
        panel.add(Points { points, marker: Marker::Plus, radius_pt: 2.0, is_hollow: false, color: BLUE, label });
        sheet.add(panel);
    }
    assert_eq!(draw(&sheet).svg.matches("aria-label=\"both\"").count(), 1);
}

#[test]
fn equal_scales_make_a_unit_as_long_upwards_as_across() {
    let mut sheet = Sheet::new(Width::Single, 1, 150.0);
    let axes = (Axis::linear("x / m", 0.0, 3.0).unwrap(), Axis::linear("y / m", 0.0, 2.0).unwrap());
    let mut panel = Panel::new("", axes.0, axes.1).with_equal_scales();
    panel.add(Probe);
    sheet.add(panel);
    draw(&sheet);
}

struct Probe;

impl Mark for Probe {
    fn draw(&self, _: &mut Canvas, view: &View) {
        let ([x0, y0], [x1, y1]) = (view.at([0.0, 0.0]), view.at([1.0, 1.0]));
        assert!(((x1 - x0) - (y0 - y1)).abs() < 1e-9, "{view:?}");
    }
}

#[test]
fn a_panel_without_room_is_refused_with_the_room_it_has() {
    let error = sheet(12, 12).draw(&provenance()).unwrap_err();
    assert!(
        matches!(error, RenderError::NoRoom { .. }) && error.to_string().contains("30 × 30 pt"),
        "{error}"
    );
}

#[test]
fn every_tick_of_a_panel_is_named_and_has_its_line_in_the_grid() {
    let (x, y) = (Axis::linear("step", 0.0, 100.0).unwrap(), Axis::log("time / s", 0.1, 1000.0).unwrap());
    let labels: Vec<String> = y.ticks(110.0, false).into_iter().map(|tick| tick.label).collect();
    let named = labels.iter().filter(|label| !label.is_empty()).count();
    assert!(named == 5 && labels.len() > 30, "{labels:?}");
    for (trim, lines) in [(Trim::Grid, 1), (Trim::Frame, 0)] {
        let mut sheet = Sheet::new(Width::Single, 1, 110.0);
        sheet.add(Panel::new("", x.clone(), y.clone()).trimmed(trim));
        let svg = draw(&sheet).svg;
        for label in
            labels.iter().filter(|label| !label.is_empty()).chain(&["step".into(), "time / s".into()])
        {
            assert!(svg.contains(&format!("aria-label=\"{label}\"")), "{label} is missing");
        }
        // Lines that are painted alike may share a path.
        let of = |color: crate::render::style::Rgb| -> usize {
            let stroke = format!("stroke=\"{}\"", color.hex());
            let own = svg.lines().filter(|line| line.contains(&stroke));
            own.map(|line| line.matches('M').count().max(1)).sum()
        };
        let all = labels.len() + x.ticks(200.0, true).len();
        let named = named + x.ticks(200.0, true).len();
        assert_eq!(of(crate::render::style::GRID), lines * named, "{trim:?}");
        // Two axis lines and the frame are in the ink of ticks.
        assert_eq!(of(crate::render::style::INK), all + 3, "{trim:?}");
    }
}
