use super::*;
use crate::render::chart::Axis;
use crate::render::style::{BLUE, ORANGE};
use crate::seed;
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
fn an_ecdf_ends_at_the_share_of_finite_values() {
    let line = Line::ecdf(&[2.0, f64::INFINITY, 1.0, 2.0], Stroke::solid(BLUE, 1.0));
    assert_eq!(line.points, [[1.0, 0.0], [1.0, 0.25], [2.0, 0.25], [2.0, 0.5], [2.0, 0.5], [2.0, 0.75]]);
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
