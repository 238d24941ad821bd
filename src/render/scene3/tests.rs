use super::mark::Lens;
use super::order::{Item, Look};
use super::*;
use crate::render::canvas::Rect;
use crate::render::style::{BLUE, GREEN, ORANGE};
use base::seed;
use rand::RngExt as _;

const ROOM: Rect = Rect { x: 0.0, y: 0.0, w: 200.0, h: 200.0 };

fn marked(scene: Scene, camera: Camera) -> SceneMark {
    SceneMark { scene, camera, bar: None, keys: Vec::new() }
}

/// Depth towards the eye at which the sight line through `page` meets the face, if it does.
fn depth_at(item: &Item, lens: &Lens, camera: &Camera, page: [f64; 2]) -> Option<f64> {
    let Look::Face(plane, ..) = item.look else { return None };
    let corners: Vec<[f64; 2]> = item.points.iter().map(|&point| lens.at(point)).collect();
    let side = |index: usize| {
        let (a, b) = (corners[index], corners[(index + 1) % corners.len()]);
        (b[0] - a[0]) * (page[1] - a[1]) - (b[1] - a[1]) * (page[0] - a[0])
    };
    let sides: Vec<f64> = (0..corners.len()).map(side).collect();
    let inside = sides.iter().all(|&side| side > 1e-6) || sides.iter().all(|&side| side < -1e-6);
    let [right, up, back] = camera.axes();
    // In a parallel view the page's axes come from two probes of the lens.
    let origin = lens.at([0.0; 3]);
    let scale = lens.at(right)[0] - origin[0];
    let base =
        along(along([0.0; 3], right, (page[0] - origin[0]) / scale), up, (origin[1] - page[1]) / scale);
    inside.then(|| (plane.offset - dot(plane.normal, base)) / dot(plane.normal, back))
}

fn crowded(case: u64) -> Scene {
    let mut random = seed::stream(seed::derive(case, &["scene"]));
    let mut scene = Scene::default();
    let mut point = || -> Vec3 { [0, 1, 2].map(|_| random.random_range(-1.0..1.0)) };
    for color in [BLUE, ORANGE, GREEN] {
        let (a, b) = (point(), point());
        let (low, high) =
            ([0, 1, 2].map(|i: usize| a[i].min(b[i])), [0, 1, 2].map(|i: usize| a[i].max(b[i])));
        scene.cuboid(box_corners(low, high), Paint::solid(color));
        scene.capsule(point(), point(), 0.2, Paint::solid(color));
    }
    scene
}

#[test]
fn nothing_is_followed_by_what_lies_behind_it_even_where_solids_pierce_each_other() {
    let mut compared = 0;
    let mut pierced = 0;
    for case in 0..12 {
        let camera = Camera::parallel(30.0 * case as f64 + 7.0, 25.0);
        let scene = marked(crowded(case), camera);
        let lens = Lens::fitting(&scene.scene, camera, ROOM);
        let items = scene.items();
        let whole: usize = scene.scene.meshes.iter().map(|mesh| mesh.visible(0, &camera).len()).sum();
        pierced += items.len() - whole;
        let mut random = seed::stream(seed::derive(case, &["sight"]));
        for _ in 0..400 {
            let page = [random.random_range(0.0..200.0), random.random_range(0.0..200.0)];
            let depths: Vec<f64> =
                items.iter().filter_map(|item| depth_at(item, &lens, &camera, page)).collect();
            for pair in depths.windows(2) {
                assert!(pair[0] <= pair[1] + 1e-6, "case {case}, {page:?}: {depths:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 1000 && pierced > 500, "sample too easy: {compared} compared, {pierced} cuts");
}

#[test]
fn cutting_keeps_the_area_that_is_seen() {
    let area = |items: &[Item], lens: &Lens| -> f64 {
        let shoelace = |item: &Item| {
            let at: Vec<[f64; 2]> = item.points.iter().map(|&point| lens.at(point)).collect();
            let term = |i: usize| at[i][0] * at[(i + 1) % at.len()][1] - at[i][1] * at[(i + 1) % at.len()][0];
            (0..at.len()).map(term).sum::<f64>().abs() / 2.0
        };
        items.iter().filter(|item| matches!(item.look, Look::Face(..))).map(shoelace).sum()
    };
    for case in 0..12 {
        let camera = Camera::parallel(30.0 * case as f64 + 7.0, 25.0);
        let scene = marked(crowded(case), camera);
        let lens = Lens::fitting(&scene.scene, camera, ROOM);
        let whole: Vec<Item> = scene.scene.meshes.iter().flat_map(|mesh| mesh.visible(0, &camera)).collect();
        let (before, after) = (area(&whole, &lens), area(&scene.items(), &lens));
        assert!((before - after).abs() < 1e-6 * before, "case {case}: {before} became {after}");
    }
}

#[test]
fn a_camera_sees_z_up_and_from_x_has_y_to_the_right() {
    let mut scene = Scene::default();
    scene.cuboid(box_corners([-1.0; 3], [1.0; 3]), Paint::solid(BLUE));
    let lens = Lens::fitting(&scene, Camera::parallel(0.0, 10.0), ROOM);
    assert!(lens.at([0.0, 0.0, 1.0])[1] < lens.at([0.0, 0.0, -1.0])[1]);
    assert!(lens.at([0.0, 1.0, 0.0])[0] > lens.at([0.0, -1.0, 0.0])[0]);
}

#[test]
fn a_line_behind_a_solid_comes_first_and_a_line_before_it_last() {
    let mut scene = Scene::default();
    scene.cuboid(box_corners([-1.0; 3], [1.0; 3]), Paint::solid(BLUE));
    scene.polyline(vec![[-3.0, -1.0, 0.0], [-3.0, 1.0, 0.0]], Stroke::solid(ORANGE, 1.0));
    scene.polyline(vec![[3.0, -1.0, 0.0], [3.0, 1.0, 0.0]], Stroke::solid(GREEN, 1.0));
    let camera = Camera::parallel(10.0, 10.0);
    let scene = marked(scene, camera);
    let items = scene.items();
    let color = |item: &Item| if let Look::Line(stroke) = item.look { Some(stroke.color) } else { None };
    assert_eq!((color(&items[0]), color(&items[items.len() - 1])), (Some(ORANGE), Some(GREEN)));
    assert!(items.len() > 5);
}

#[test]
fn no_face_that_an_edge_bounds_is_drawn_over_it_not_even_the_floor() {
    let mut scene = Scene::default();
    let floor = vec![[-3.0, -3.0, 0.0], [3.0, -3.0, 0.0], [3.0, 3.0, 0.0], [-3.0, 3.0, 0.0]];
    scene.sheet(floor, Paint::solid(GREEN));
    scene.cuboid(box_corners([-1.0, -1.0, 0.0], [1.0; 3]), Paint::solid(BLUE));
    let camera = Camera::parallel(30.0, 20.0);
    let scene = marked(scene, camera);
    let items = scene.items();
    let is_face = |item: &Item| matches!(item.look, Look::Face(..));
    let touches = |face: &Item, point: Vec3| {
        (0..3).all(|axis| {
            let values = || face.points.iter().map(|corner| corner[axis]);
            let (low, high) = (values().fold(f64::MAX, f64::min), values().fold(f64::MIN, f64::max));
            (low - 1e-9..=high + 1e-9).contains(&point[axis])
        })
    };
    let mut drawn = 0.0;
    for (index, line) in items.iter().enumerate().filter(|(_, item)| !is_face(item)) {
        let span = sub(line.points[1], line.points[0]);
        let middle = along(line.points[0], line.points[1], 1.0);
        let later = items[index..].iter().filter(|item| is_face(item));
        assert!(!later.into_iter().any(|face| touches(face, middle.map(|v| v / 2.0))), "{line:?} is covered");
        drawn += dot(span, span).sqrt();
    }
    // Six long and three short edges of the box and four of the floor.
    assert!((drawn - (6.0 * 2.0 + 3.0 + 4.0 * 6.0)).abs() < 1e-9, "{drawn}");
}
