//! A sample of every helper, held free of overlapping labels.
//!
//! `REPLAN_DEMO_DIR=target/demo cargo test --lib render::tests` also writes the files, to be looked at.

use super::canvas::{Align, Stand, Type};
use super::chart::legend::cell_key;
use super::chart::marks::{Band, Cells, Line, Note, Points, Shape};
use super::chart::rows::{Bars, BoxStrip, Whiskers};
use super::chart::rules::Rules;
use super::chart::{Axis, Panel, Sheet, Trim};
use super::scene3::{Camera, Paint, ScaleBar, Scene, SceneMark, Vec3, box_corners};
use super::style::{
    BLACK, BLUE, Dash, Fill, GREEN, GREY, GRID, Marker, ORANGE, PURPLE, SKY, Stroke, TextSize, VERMILLION,
    WHITE, Width, YELLOW, series_color, series_marker, series_stroke,
};
use super::vector::Provenance;
use crate::analysis::shown::Distribution;
use crate::analysis::statistic::Interval;
use base::seed;
use rand::RngExt as _;

fn hold(name: &str, sheet: &Sheet) {
    let provenance = Provenance {
        command: format!("cargo run -- render demo --only {name}"),
        spec_hash: "0".into(),
        title: name.into(),
    };
    let figure = sheet.draw(&provenance).unwrap();
    if let Some(folder) = std::env::var_os("REPLAN_DEMO_DIR").map(std::path::PathBuf::from) {
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join(format!("{name}.svg")), &figure.svg).unwrap();
        std::fs::write(folder.join(format!("{name}.png")), &figure.png).unwrap();
    }
    assert_eq!(figure.flaws, Vec::<String>::new(), "{name}");
    assert!(figure.svg.len() + figure.png.len() < 1_500_000, "{name} is too large to commit");
}

fn map_panel(title: &str) -> Panel {
    let mut random = seed::stream(seed::derive(3, &["map"]));
    let side = 30;
    let colors = (0..side * side)
        .map(|index| {
            let (column, row) = (index % side, index / side);
            let near = (column as f64 - row as f64).abs() < 6.0;
            if column.min(row) > 2 && column.max(row) < 27 && random.random_range(0.0..1.0) < 0.25 {
                Some(GREY)
            } else if near && column < 20 {
                Some(SKY.mixed(WHITE, 0.5))
            } else if near {
                Some(ORANGE.mixed(WHITE, 0.5))
            } else {
                None
            }
        })
        .collect();
    let axes = (Axis::linear("x / cells", 0.0, 30.0).unwrap(), Axis::linear("y / cells", 0.0, 30.0).unwrap());
    let mut panel = Panel::new(title, axes.0, axes.1).trimmed(Trim::Frame).with_equal_scales();
    let keys = vec![
        cell_key("obstacle", GREY),
        cell_key("opened from start", SKY.mixed(WHITE, 0.5)),
        cell_key("opened from goal", ORANGE.mixed(WHITE, 0.5)),
    ];
    let lines = Some(Stroke::solid(GRID, 0.25));
    panel.add(Cells { corner: [0.0; 2], cell: [1.0; 2], columns: side, colors, lines, keys });
    let raw = (0..30)
        .map(|step| [f64::from(step) + 0.5, f64::from(step) + 0.5 + f64::from(step % 3 % 2)])
        .collect();
    panel.add(Line::through(raw, Stroke::solid(BLUE, 1.1).dashed(Dash::Dashed)).labelled("path as found"));
    let tidy = vec![[0.5, 0.5], [8.0, 10.5], [22.0, 19.0], [29.5, 29.5]];
    panel.add(Line::through(tidy, Stroke::solid(VERMILLION, 1.4)).labelled("path after deletion"));
    let ends =
        [("start", [0.5, 0.5], GREEN, Marker::Circle), ("goal", [29.5, 29.5], PURPLE, Marker::Diamond)];
    for (label, at, color, marker) in ends {
        panel.add(Points {
            points: vec![at],
            marker,
            radius_pt: 3.0,
            is_hollow: false,
            color,
            label: label.into(),
        });
    }
    panel
}

#[test]
fn grid_maps_side_by_side() {
    let mut sheet = Sheet::new(Width::Double, 2, 200.0).noted(
        "Interpretation: corners may not be cut; costs in cells. Cells opened by each side are tinted; \
         the path as found is drawn before inflection points are deleted.",
    );
    sheet.add(map_panel("A*: 30 × 30 cells, √2 per diagonal"));
    sheet.add(map_panel("improved bidirectional A*"));
    hold("maps", &sheet);
    let mut narrow = Sheet::new(Width::Single, 1, 210.0);
    narrow.add(map_panel("map 1"));
    hold("map_single", &narrow);
}

#[test]
fn success_bands_with_printed_rows() {
    let mut sheet = Sheet::new(Width::Double, 3, 105.0);
    for group in 0..6 {
        let axes = (Axis::linear("nodes N", 100.0, 1500.0), Axis::linear("success / %", 0.0, 100.0));
        let mut panel = Panel::new(format!("group {}", group + 1), axes.0.unwrap(), axes.1.unwrap());
        for (index, label) in ["original A*", "improved A*"].into_iter().enumerate() {
            let level = |n: f64| {
                100.0 * (1.0 - libm::exp(-n / (500.0 - 150.0 * index as f64 + 60.0 * f64::from(group))))
            };
            let at: Vec<f64> = (1..=15).map(|step| f64::from(step) * 100.0).collect();
            let edges = at.iter().map(|&n| [n, level(n) - 6.0, level(n) + 5.0]).collect();
            let color = series_color(index);
            panel.add(Band { edges, fill: Fill::sheer(color, 0.22), label: format!("{label}, 95 % band") });
            let mean = at.iter().map(|&n| [n, level(n)]).collect();
            panel.add(Line::through(mean, series_stroke(index)).labelled(format!("{label}, mean")));
            let printed = [200.0, 400.0, 800.0].map(|n| [n, level(n) - 4.0 + n / 100.0]).to_vec();
            let marker = series_marker(index);
            let label = format!("{label}, printed");
            panel.add(Points { points: printed, marker, radius_pt: 2.6, is_hollow: false, color, label });
        }
        sheet.add(panel);
    }
    hold("success", &sheet);
}

fn boxes(values: &[f64]) -> Panel {
    let names = ["cost", "turns", "opened", "closed", "plan time"];
    let mut third =
        Panel::new("by metric", Axis::names("", names), Axis::linear("reduction / %", -30.0, 50.0).unwrap());
    for (index, part) in values.chunks(120).enumerate() {
        let mut sorted = part.to_vec();
        sorted.sort_by(f64::total_cmp);
        let quantiles = [6, 30, 60, 90, 113].map(|rank| sorted[rank]);
        let at = index as f64;
        let color = series_color(index);
        third.add(BoxStrip {
            at,
            width: 0.45,
            quantiles,
            values: part.to_vec(),
            color,
            label: String::new(),
        });
    }
    third
}

#[test]
fn distributions_with_marked_values() {
    let mut random = seed::stream(seed::derive(1, &["distributions"]));
    let mut draw = || (0..12).map(|_| random.random_range(0.0..8.0)).sum::<f64>() - 40.0;
    let values: Vec<f64> = (0..600).map(|_| draw()).collect();
    let mut sheet =
        Sheet::new(Width::Double, 3, 120.0).titled("Reductions on random maps against the printed ones");
    let mut first = Panel::new(
        "histogram",
        Axis::linear("reduction / %", -20.0, 40.0).unwrap(),
        Axis::linear("maps", 0.0, 120.0).unwrap(),
    );
    let count = |low: f64| values.iter().filter(|&&value| (low..low + 4.0).contains(&value)).count() as f64;
    let bars = (-5..10).map(|bin| 4.0 * f64::from(bin)).map(|low| [low, low + 4.0, count(low)]).collect();
    first.add(Bars { bars, fill: Fill::solid(SKY), label: "random maps".into() });
    let marks = [(8.5, "map 1"), (17.2, "map 2")].map(|(x, text)| (x, format!("{text}: {x} %"))).to_vec();
    first.add(Rules { marks, stroke: Stroke::solid(VERMILLION, 1.0).dashed(Dash::Dashed) });
    sheet.add(first);
    let mut second = Panel::new(
        "share at most x",
        Axis::linear("reduction / %", -20.0, 40.0).unwrap(),
        Axis::linear("share of maps", 0.0, 1.0).unwrap(),
    );
    for (index, part) in values.chunks(200).enumerate() {
        second.add(
            Line::through(Distribution::new(part).steps, series_stroke(index))
                .labelled(format!("density {}", index + 1)),
        );
    }
    let marks = (0..6).map(|index| (5.0 + 1.5 * f64::from(index), format!("printed {index}"))).collect();
    second.add(Rules { marks, stroke: Stroke::solid(BLACK, 0.6).dashed(Dash::Dotted) });
    sheet.add(second);
    sheet.add(boxes(&values));
    hold("distributions", &sheet);
}

#[test]
fn interval_rows_of_interpretations() {
    let options = [
        "corner cutting: allowed",
        "corner cutting: forbidden",
        "line of sight: exact",
        "line of sight: sampled",
        "ties: smallest h",
        "ties: last in",
        "meeting: first touch",
        "meeting: proven",
    ];
    let rows = Axis::names("", options).reversed();
    let mut panel =
        Panel::new("", Axis::linear("ratio of opened cells, improved / A*", 0.2, 1.4).unwrap(), rows);
    for (index, _) in options.iter().enumerate() {
        let at = 0.5 + 0.06 * index as f64;
        let values = Interval::new(at - 0.1, if index == 6 { f64::INFINITY } else { at + 0.12 });
        let color = if index % 3 == 0 { VERMILLION } else { BLUE };
        let label = if color == BLUE { "contradicts the claim" } else { "carries the claim" };
        panel.add(Whiskers {
            at: [at, index as f64],
            ends: [values, Interval::new(index as f64, index as f64)],
            is_hollow: false,
            marker: series_marker(index % 3),
            color,
            label: label.into(),
        });
    }
    panel.add(Rules { marks: vec![(1.0, "equal".into())], stroke: Stroke::solid(GREY, 0.8) });
    let mut sheet = Sheet::new(Width::Single, 1, 130.0);
    sheet.add(panel);
    hold("interpretations", &sheet);
}

#[test]
fn joint_curves_and_a_log_plot() {
    let mut sheet = Sheet::new(Width::Double, 2, 130.0);
    let axes = (Axis::linear("time / s", 0.0, 4.0), Axis::linear("joint angle / °", -180.0, 180.0));
    let mut joints = Panel::new("joints along the path", axes.0.unwrap(), axes.1.unwrap());
    for joint in 0..6 {
        let wave =
            |t: f64| (150.0 - 20.0 * f64::from(joint)) * libm::sin(t * (0.5 + 0.25 * f64::from(joint)));
        let points = (0..=200).map(|step| f64::from(step) * 0.02).map(|t| [t, wave(t)]).collect();
        let name = format!("θ{}", ['₁', '₂', '₃', '₄', '₅', '₆'][joint as usize]);
        joints.add(Line::through(points, series_stroke(joint as usize)).labelled(name));
    }
    sheet.add(joints);
    let axes = (Axis::log("expansions", 10.0, 1e6).unwrap(), Axis::log("time / ms", 0.01, 1000.0).unwrap());
    let mut work = Panel::new(
        "work against N, all contenders, with a title that is too long for one line",
        axes.0,
        axes.1,
    );
    for (index, name) in ["8 neighbours", "24 neighbours", "48 neighbours", "CHS"].into_iter().enumerate() {
        let points =
            (0..5).map(|k| libm::pow(10.0, 1.2 + f64::from(k))).map(|n| [n, n * 1e-3 * (index + 1) as f64]);
        let line = Line::through(points.filter(|point| point[1] < 900.0).collect(), series_stroke(index));
        work.add(line.labelled(name).marked(series_marker(index)));
    }
    work.add(Note::beside([2e3, 0.05], "slope 1, as theory has it"));
    sheet.add(work);
    hold("joints", &sheet);
}

#[test]
fn an_arm_in_the_plane_and_a_crowd_of_names() {
    let mut sheet = Sheet::new(Width::Double, 2, 170.0);
    let axes = (Axis::linear("x / m", -0.5, 0.5).unwrap(), Axis::linear("y / m", 0.0, 0.6).unwrap());
    let mut arm = Panel::new("arm at five stations", axes.0, axes.1).with_equal_scales();
    let disc: Vec<[f64; 2]> = (0..60)
        .map(|k| libm::sincos(f64::from(k) * 0.105))
        .map(|(s, c)| [0.2 + 0.07 * c, 0.35 + 0.07 * s])
        .collect();
    let edge = Some(Stroke::solid(BLACK, 0.5));
    arm.add(Shape { corners: disc, fill: Some(Fill::solid(YELLOW)), stroke: edge, label: "obstacle".into() });
    for station in 0..5 {
        let (q1, q2) = (0.4 + 0.45 * f64::from(station), 1.1 - 0.1 * f64::from(station));
        let elbow = [0.3 * libm::cos(q1), 0.3 * libm::sin(q1)];
        let tip = [elbow[0] + 0.25 * libm::cos(q1 + q2), elbow[1] + 0.25 * libm::sin(q1 + q2)];
        let stroke = Stroke { opacity: 0.4 + 0.15 * f64::from(station), ..Stroke::solid(BLUE, 2.2) };
        arm.add(Line::through(vec![[0.0, 0.0], elbow, tip], stroke).marked(Marker::Circle));
    }
    let set = Type { rim: true, ..Type::regular(TextSize::TICK).aligned(Align::Middle, Stand::Below) };
    arm.add(Note { at: [0.0, 0.0], shift_pt: [0.0, -14.0], text: "base".into(), set });
    sheet.add(arm);
    let names: Vec<String> = (0..12).map(|k| format!("contender {k}")).collect();
    let mut crowd = Panel::new(
        "names that need a tilt",
        Axis::names("contender", names),
        Axis::linear("cost / cells", 0.0, 40.0).unwrap(),
    );
    let bars = (0..12).map(|k| [f64::from(k) - 0.4, f64::from(k) + 0.4, 10.0 + 2.0 * f64::from(k)]).collect();
    crowd.add(Bars { bars, fill: Fill::solid(GREEN), label: "mean cost".into() });
    sheet.add(crowd);
    hold("arm", &sheet);
}

fn cell() -> Scene {
    let mut scene = Scene::default();
    let floor =
        vec![[-900.0, -900.0, 0.0], [1500.0, -900.0, 0.0], [1500.0, 900.0, 0.0], [-900.0, 900.0, 0.0]];
    scene.sheet(floor, Paint::solid(GRID));
    for step in -4..=7 {
        let x = f64::from(step) * 200.0;
        scene.polyline(vec![[x, -900.0, 0.0], [x, 900.0, 0.0]], Stroke::solid(WHITE, 0.4));
    }
    for step in -4..=4 {
        let y = f64::from(step) * 200.0;
        scene.polyline(vec![[-900.0, y, 0.0], [1500.0, y, 0.0]], Stroke::solid(WHITE, 0.4));
    }
    scene.cuboid(box_corners([600.0, -700.0, 0.0], [1200.0, -200.0, 500.0]), Paint::solid(SKY));
    scene.cuboid(box_corners([700.0, 250.0, 0.0], [1300.0, 800.0, 350.0]), Paint::solid(YELLOW));
    scene.cuboid(box_corners([900.0, 400.0, 350.0], [1100.0, 600.0, 600.0]), Paint::solid(GREEN));
    let joints: [Vec3; 6] = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 450.0],
        [150.0, 60.0, 1000.0],
        [600.0, 120.0, 1150.0],
        [800.0, 150.0, 950.0],
        [820.0, 160.0, 800.0],
    ];
    for (pair, radius) in joints.windows(2).zip([160.0, 110.0, 90.0, 70.0, 50.0]) {
        scene.capsule(pair[0], pair[1], radius, Paint::solid(ORANGE));
    }
    let path = (0..=60)
        .map(|k| f64::from(k) / 60.0)
        .map(|t| [820.0 - 250.0 * t, 160.0 - 700.0 * t, 800.0 - 600.0 * t * (1.0 - t)]);
    scene.polyline(path.collect(), Stroke::solid(VERMILLION, 1.4));
    scene.tag([820.0, 160.0, 800.0], "P1");
    scene.tag([570.0, -540.0, 800.0], "P2");
    scene
}

#[test]
fn a_robot_cell_from_two_sides() {
    let mut sheet = Sheet::new(Width::Double, 2, 210.0);
    let cameras =
        [("from one side", Camera::parallel(35.0, 25.0)), ("from the other", Camera::parallel(-55.0, 20.0))];
    for (title, camera) in cameras {
        let bare = || Axis::linear("", 0.0, 1.0).unwrap();
        let mut panel = Panel::new(title, bare(), bare()).trimmed(Trim::Bare);
        let bar = Some(ScaleBar { length: 500.0, label: "500 mm".into() });
        let keys = vec![cell_key("robot", ORANGE), cell_key("table", SKY), cell_key("fixture", YELLOW)];
        panel.add(SceneMark { scene: cell(), camera, bar, keys });
        sheet.add(panel);
    }
    hold("cell", &sheet);
}
