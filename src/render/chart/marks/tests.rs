use super::*;
use crate::render::chart::Axis;
use crate::render::chart::legend::cell_key;
use crate::render::style::{BLUE, ORANGE, Width};
use crate::render::vector::Provenance;
use base::seed;
use rand::RngExt as _;

fn view() -> View {
    let axis = Axis::linear("x", 0.0, 10.0).unwrap();
    View { frame: Rect { x: 40.0, y: 50.0, w: 200.0, h: 100.0 }, x: axis.clone(), y: axis }
}

#[test]
fn data_rise_from_the_lower_left_corner_of_the_frame() {
    assert_eq!(
        view().all(&[[0.0, 0.0], [10.0, 10.0], [5.0, 2.5]]),
        [[40.0, 150.0], [240.0, 50.0], [140.0, 125.0]]
    );
}

#[test]
fn runs_cover_every_coloured_cell_once_and_no_other() {
    let mut random = seed::stream(seed::derive(5, &["cells"]));
    let pick = |random: &mut seed::Stream| [None, Some(BLUE), Some(ORANGE)][random.random_range(0..3)];
    let colors: Vec<Option<Rgb>> = (0..7 * 5).map(|_| pick(&mut random)).collect();
    let cells = Cells {
        corner: [0.0; 2],
        cell: [1.0; 2],
        columns: 7,
        colors: colors.clone(),
        lines: None,
        keys: Vec::new(),
    };
    let mut seen = vec![None; colors.len()];
    for (color, runs) in cells.runs() {
        for [from, row, to] in runs {
            for column in from..to {
                assert_eq!(seen[row * 7 + column].replace(color), None, "cell {column}, {row} twice");
            }
        }
    }
    assert_eq!(seen, colors);
}

fn drawn(draw: impl FnOnce(&mut Canvas)) -> String {
    let mut canvas = Canvas::new(Width::Double, 200.0);
    draw(&mut canvas);
    let command = String::new();
    let spec_hash = String::new();
    let title = String::new();
    canvas.finish(&Provenance { command, spec_hash, title }).unwrap().svg
}

#[test]
fn a_line_that_leaves_the_frame_keeps_its_direction() {
    // From (2, 5) rightwards and down to 500 frames below: on the page from (80, 100) on.
    let stroke = Stroke::solid(BLUE, 1.0).dashed(Dash::Dashed);
    let points = vec![[2.0, 5.0], [7.0, -5000.0], [-200.0, 9.0]];
    let by_plotters = drawn(|canvas| Line::through(points, stroke).draw(canvas, &view()));
    let by_hand = drawn(|canvas| {
        canvas.polyline(&[[80.0, 100.0], [180.0, 50_150.0], [-3960.0, 60.0]], &stroke);
    });
    assert_eq!(by_plotters, by_hand);
}

#[test]
fn a_point_without_a_place_breaks_the_line() {
    let axis = Axis::log("n", 1.0, 100.0).unwrap();
    let view = View { x: axis, ..view() };
    let stroke = Stroke::solid(BLUE, 1.0);
    for missing in [[0.0, 5.0], [f64::NAN, 5.0], [10.0, f64::INFINITY], [-1.0, 5.0]] {
        let points = vec![[1.0, 0.0], [10.0, 10.0], missing, [10.0, 0.0], [100.0, 10.0]];
        let by_plotters = drawn(|canvas| Line::through(points, stroke).draw(canvas, &view));
        let by_hand = drawn(|canvas| {
            canvas.polyline(&[[40.0, 150.0], [140.0, 50.0]], &stroke);
            canvas.polyline(&[[140.0, 150.0], [240.0, 50.0]], &stroke);
        });
        assert_eq!(by_plotters, by_hand, "{missing:?}");
    }
}

#[test]
fn a_band_is_one_outline_of_its_two_curves() {
    let edges = vec![[0.0, 1.0, 2.0], [10.0, 3.0, 5.0]];
    let fill = Fill::sheer(ORANGE, 0.3);
    let band = Band { edges, fill, label: String::new() };
    let outline = [[40.0, 140.0], [240.0, 120.0], [240.0, 100.0], [40.0, 130.0]];
    let by_hand = drawn(|canvas| canvas.polygon(&outline, Some(fill), None));
    assert_eq!(drawn(|canvas| band.draw(canvas, &view())), by_hand);
}

#[test]
fn a_legend_names_what_the_frame_shows() {
    let labels = |mark: &dyn Mark| mark.keys(&view()).into_iter().map(|key| key.label).collect::<Vec<_>>();
    let point = |at| Points::unlabelled(vec![at], Marker::Circle, 2.0, BLUE).labelled("point");
    assert_eq!(labels(&point([3.0, 4.0])), ["point"]);
    assert_eq!(labels(&point([12.0, 4.0])), [""; 0]);
    assert_eq!(labels(&point([f64::NAN, 4.0])), [""; 0]);
    let line = |ends: [[f64; 2]; 2]| Line::through(ends.to_vec(), Stroke::solid(BLUE, 1.0)).labelled("line");
    assert_eq!(labels(&line([[-5.0, 5.0], [15.0, 5.0]])), ["line"], "it passes through");
    assert_eq!(labels(&line([[11.0, 0.0], [14.0, 9.0]])), [""; 0]);
    let cells = Cells {
        corner: [0.0; 2],
        cell: [10.0; 2],
        columns: 2,
        colors: vec![Some(BLUE), Some(ORANGE)],
        lines: None,
        keys: vec![cell_key("in the frame", BLUE), cell_key("beside it", ORANGE)],
    };
    assert_eq!(labels(&cells), ["in the frame"]);
}
