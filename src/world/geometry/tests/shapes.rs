//! Shapes that are accepted, why others are not, and how named ones lie.

use crate::geometry::{
    Aabb, Axis, BroadPhase, Capsule, Convex, Face, Frame, GeometryError, HalfSpace, OrientedBox, Segment,
    Solid, Sphere, Vec3, distance_segment_convex, distance_segment_solid,
};
use std::f64::consts::{FRAC_PI_4, TAU};

fn volume(solid: &Convex) -> f64 {
    let middle = solid.vertices().iter().sum::<Vec3>() / solid.vertices().len() as f64;
    let pyramid = |face: &Face| {
        let corner = |i: usize| solid.vertices()[face.corners[i]] - middle;
        let fan = (1..face.corners.len() - 1).map(|i| corner(0).cross(&corner(i)).dot(&corner(i + 1)));
        fan.sum::<f64>() / 6.0
    };
    solid.faces().iter().map(pyramid).sum()
}

#[test]
fn named_polyhedra_have_their_faces_edges_corners_and_volumes() {
    let center = Vec3::new(40.0, 62.0, 45.0);
    let size = Vec3::new(18.0, 16.0, 22.0);
    let regular = |n: f64| n * 0.5 * 100.0 * libm::sin(TAU / n);
    let cases = [
        ("box", Convex::cuboid(center, size), [6, 12, 8], 18.0 * 16.0 * 22.0),
        ("wedge", Convex::wedge(center, size), [5, 9, 6], 9.0 * 16.0 * 22.0),
        ("octahedron", Convex::octahedron(center, 13.0), [8, 12, 6], 4.0 / 3.0 * 13.0_f64.powi(3)),
        ("pyramid", Convex::pyramid(center, 14.0, 18.0), [5, 8, 5], 14.0 * 14.0 * 18.0 / 3.0),
        ("prism", Convex::prism(Axis::Z, center, 10.0, 26.0, 6, 0.2), [8, 18, 12], regular(6.0) * 26.0),
        ("prism", Convex::prism(Axis::X, center, 10.0, 26.0, 32, 0.1), [34, 96, 64], regular(32.0) * 26.0),
    ];
    for (name, solid, counts, expected) in cases {
        let solid = solid.unwrap();
        assert_eq!([solid.faces().len(), solid.edges().len(), solid.vertices().len()], counts, "{name}");
        let found = volume(&solid);
        assert!((found - expected).abs() < 1e-12 * expected, "{name}: volume {found}, not {expected}");
    }
}

#[test]
fn a_prism_lies_along_its_axis_and_a_wedge_keeps_its_lower_left_half() {
    for (axis, along) in [(Axis::X, Vec3::x()), (Axis::Y, Vec3::y()), (Axis::Z, Vec3::z())] {
        let prism = Convex::prism(axis, Vec3::zeros(), 1.0, 10.0, 5, 0.1).unwrap();
        let point = Segment::new(along * 7.0, along * 7.0);
        assert!((distance_segment_convex(&point, &prism) - 2.0).abs() < 1e-12, "{axis:?}");
    }
    let first = Convex::prism(Axis::X, Vec3::zeros(), 1.0, 2.0, 5, 0.0).unwrap();
    assert!(first.vertices().iter().any(|v| (v - Vec3::new(1.0, 1.0, 0.0)).norm() < 1e-12), "{first:?}");
    let wedge = Convex::wedge(Vec3::zeros(), Vec3::new(2.0, 2.0, 2.0)).unwrap();
    assert!(wedge.contains(&Vec3::new(-0.9, 0.0, 0.8)) && !wedge.contains(&Vec3::new(0.9, 0.0, 0.8)));
}

#[test]
fn faces_turn_counter_clockwise_seen_from_outside_and_every_edge_parts_two() {
    let solid = Convex::prism(Axis::Y, Vec3::new(1.0, 2.0, 3.0), 2.0, 3.0, 7, 0.3).unwrap();
    for face in solid.faces() {
        let [a, b, c] = [0, 1, 2].map(|i| solid.vertices()[face.corners[i]]);
        assert!((b - a).cross(&(c - b)).dot(&face.plane.normal) > 0.0, "{face:?}");
    }
    assert!(solid.edges().iter().all(|edge| edge.faces[0] != edge.faces[1]), "{:?}", solid.edges());
}

#[test]
fn planes_and_corners_give_the_same_solid() {
    let solid = Convex::octahedron(Vec3::new(3.0, -1.0, 2.0), 1.5).unwrap();
    let planes: Vec<(Vec3, f64)> =
        solid.faces().iter().map(|f| (f.plane.normal * 3.0, f.plane.offset * 3.0)).collect();
    let again = Convex::from_planes(&planes).unwrap();
    assert_eq!((again.faces().len(), again.edges().len(), again.vertices().len()), (8, 12, 6));
    for vertex in solid.vertices() {
        assert!(again.vertices().iter().any(|v| (v - vertex).norm() < 1e-12), "{vertex:?} is lost");
    }
}

fn cube_planes() -> Vec<(Vec3, f64)> {
    [Vec3::x(), Vec3::y(), Vec3::z()].iter().flat_map(|n| [(*n, 1.0), (-n, 1.0)]).collect()
}

fn refusal(solid: Result<Convex, GeometryError>) -> String {
    solid.unwrap_err().to_string()
}

#[test]
fn impossible_polyhedra_are_refused_with_the_reason() {
    let cube = || Convex::cuboid(Vec3::zeros(), Vec3::repeat(2.0)).unwrap().vertices().to_vec();
    let with = |extra: Vec3| [cube(), vec![extra]].concat();
    let square = || cube().into_iter().filter(|v| v.z > 0.0).collect();
    let planes = |change: fn(&mut Vec<(Vec3, f64)>)| {
        let mut planes = cube_planes();
        change(&mut planes);
        Convex::from_planes(&planes)
    };
    let nan = Vec3::new(0.0, f64::NAN, 0.0);
    let cases = [
        (Convex::from_vertices(with(Vec3::new(0.1, 0.2, 0.3))), "vertex 8 is no corner of the convex hull"),
        (Convex::from_vertices(with(Vec3::new(0.0, 1.0, 1.0))), "vertex 8 is no corner of the convex hull"),
        (Convex::from_vertices(with(Vec3::repeat(1.0))), "vertices 7 and 8 coincide"),
        (Convex::from_vertices(square()), "the 4 vertices enclose nothing"),
        (Convex::from_vertices(cube()[..3].to_vec()), "3 vertices were given; 4 to 64 are accepted"),
        (Convex::from_vertices(with(nan)), "y of vertex 8 is NaN"),
        (Convex::cuboid(Vec3::zeros(), Vec3::new(1.0, -2.0, 1.0)), "the size along y is -2; it must be"),
        (Convex::prism(Axis::Z, Vec3::zeros(), 1.0, 1.0, 2, 0.0), "2 sides were given; 3 to 32"),
        (planes(|p| _ = p.pop()), "the polyhedron is unbounded along [0.0, 0.0, -1.0]"),
        (planes(|p| p[5] = (Vec3::x() + Vec3::y(), 1.0)), "the polyhedron is unbounded along"),
        (planes(|p| p.push((Vec3::x() * 2.0, 5.0))), "planes 0 and 6 have the same normal"),
        (planes(|p| p.push((Vec3::repeat(1.0), 9.0))), "plane 6 bounds no face"),
        (planes(|p| p[0].1 = -3.0), "no point lies behind all 6 planes"),
        (planes(|p| p[0].0 = Vec3::zeros()), "the length of a plane's normal is 0"),
        (planes(|p| p[2].1 = f64::INFINITY), "the offset of plane 2 is inf"),
    ];
    for (solid, expected) in cases {
        let found = refusal(solid);
        assert!(found.contains(expected), "`{found}` does not say `{expected}`");
    }
}

#[test]
fn planes_along_one_line_or_one_plane_only_are_unbounded() {
    let along = |normals: [Vec3; 4]| refusal(Convex::from_planes(&normals.map(|n| (n, 1.0))));
    let (x, y) = (Vec3::x(), Vec3::y());
    assert!(along([x, -x, y, -y]).contains("unbounded along [0.0, 0.0, "));
    let tilted = Vec3::new(1.0, 0.0, 1e-3);
    assert!(along([x, -x, tilted, -tilted]).contains("unbounded along [0.0, "));
}

#[test]
fn negative_and_unreal_sizes_are_refused() {
    let zero = Vec3::zeros();
    let nan = Vec3::new(0.0, 0.0, f64::NAN);
    let refusals = [
        OrientedBox::new(Frame::IDENTITY, Vec3::new(1.0, 1.0, -1.0)).unwrap_err(),
        Capsule::new(zero, nan, 1.0).unwrap_err(),
        Capsule::new(zero, zero, 0.0).unwrap_err(),
        Sphere::new(zero, f64::NAN).unwrap_err(),
        HalfSpace::below(f64::NAN).unwrap_err(),
        HalfSpace::behind(&zero, &zero).unwrap_err(),
    ];
    assert_eq!(refusals[0].to_string(), "the box's size along z is -1; it must be greater than 0");
    assert_eq!(
        refusals[3].to_string(),
        "the sphere's radius is NaN; every coordinate and size must be a finite number"
    );
}

fn solids() -> Vec<(&'static str, Solid)> {
    let yawed = Frame::at(Vec3::new(5.0, 0.0, 0.0)) * Frame::turned(&Vec3::z(), FRAC_PI_4);
    let axis = Segment::new(Vec3::new(5.0, -1.0, 0.0), Vec3::new(5.0, 1.0, 0.0));
    let side = 2.0_f64.sqrt();
    vec![
        ("sphere", Solid::Sphere(Sphere::new(Vec3::new(5.0, 0.0, 0.0), 1.0).unwrap())),
        ("capsule", Solid::Capsule(Capsule::new(axis.a, axis.b, 1.0).unwrap())),
        ("box", Solid::Box(OrientedBox::new(yawed, Vec3::new(side, side, 2.0)).unwrap())),
        ("octahedron", Solid::Convex(Convex::octahedron(Vec3::new(5.0, 0.0, 0.0), 1.0).unwrap())),
        ("wall", Solid::HalfSpace(HalfSpace::behind(&Vec3::new(4.0, 9.0, 9.0), &-Vec3::x()).unwrap())),
    ]
}

#[test]
fn every_solid_is_as_far_from_the_same_side_and_0_from_what_enters_it() {
    let reach = Segment::new(Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    for (name, solid) in solids() {
        assert!((distance_segment_solid(&reach, &solid) - 3.0).abs() < 1e-12, "{name}");
        let inside = Segment::new(reach.a, Vec3::new(5.0, 0.0, 0.0));
        assert_eq!(distance_segment_solid(&inside, &solid), 0.0, "{name}");
        assert!((solid.aabb().min.x - 4.0).abs() < 1e-12 || name == "wall", "{name}: {:?}", solid.aabb());
    }
}

#[test]
fn the_broad_phase_keeps_all_boxes_that_touch_and_no_other() {
    let unit = |x: f64| Aabb { min: Vec3::new(x, 0.0, 0.0), max: Vec3::new(x + 1.0, 1.0, 1.0) };
    let broad = BroadPhase::new(vec![unit(0.0), unit(5.0), Aabb::ALL, unit(2.0)]);
    let query = Aabb::of_segment(&Segment::new(Vec3::new(1.5, 0.5, 0.5), Vec3::new(1.2, 0.5, 0.5)));
    assert_eq!(broad.candidates(&query).collect::<Vec<_>>(), [2]);
    assert_eq!(broad.candidates(&query.grown(0.5)).collect::<Vec<_>>(), [0, 2, 3]);
    assert!(!Aabb::of_points(&[]).overlaps(&unit(0.0)), "nothing touches nothing");
}
