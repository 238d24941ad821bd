//! Scenes and their refusals; rods against solids.

use super::*;
use crate::geometry::Frame;
use crate::kinematics::{Joints, Robot};
use crate::space::Support;
use base::settings::Document;
use rand::RngExt as _;
use std::path::Path;

fn parse(text: &str) -> Result<Scene, String> {
    let head = "name = 'x'\nsource = 'test'\ndomain = { min = [0, 0, 0], max = [10, 10, 10] }\n";
    let document = Document::new(Path::new("s.toml"), format!("{head}{text}"));
    scene::parse_scene(&document).map_err(|e| e.to_string())
}

fn unit_planes(last: &str) -> String {
    let faces = ["[1, 0, 0]", "[-1, 0, 0]", "[0, 1, 0]", "[0, -1, 0]", "[0, 0, 1]", last];
    let planes = faces.map(|normal| format!("{{ normal = {normal}, offset = 1 }}"));
    format!("[[obstacle]]\nshape = 'planes'\nplanes = [{}]\n", planes.join(", "))
}

#[test]
fn a_solid_that_cannot_be_is_refused_at_its_line() {
    for (text, part) in [
        (unit_planes("[0, 0.6, 0.8]"), "unbounded"),
        (unit_planes("[0, 0, 2]"), "planes 4 and 5 have the same normal"),
        (
            "[[obstacle]]\nshape = 'vertices'\npoints = [[0,0,0],[4,0,0],[0,4,0],[0,0,4],[1,1,1]]\n"
                .to_owned(),
            "vertex 4 is no corner",
        ),
        (
            "[[obstacle]]\nshape = 'vertices'\npoints = [[0,0,0],[4,0,0],[0,4,0],[4,4,0]]\n".to_owned(),
            "enclose nothing",
        ),
        ("[[obstacle]]\nshape = 'box'\ncenter = [5, 5, 5]\nsize = [1, 0, 1]\n".to_owned(), "greater than 0"),
        ("[[obstacle]]\nshape = 'cone'\ncenter = [5, 5, 5]\n".to_owned(), "cone"),
    ] {
        let error = parse(&text).unwrap_err();
        assert!(error.starts_with("s.toml:") && error.contains(part), "{text}\n{error}");
    }
    assert_eq!(parse(&unit_planes("[0, 0, -1]")).unwrap().bodies[0].vertices().len(), 8);
}

#[test]
fn a_domain_or_step_that_does_not_fit_is_refused() {
    let new = |max: f64, step: f64, growth: f64| {
        let domain = Aabb { min: Vec3::zeros(), max: Vec3::new(max, 10.0, 10.0) };
        PolyhedraWorld::new(Vec::new(), domain, step, growth).map(|_| ()).map_err(|e| e.to_string())
    };
    assert_eq!(new(10.0, 1.0, 0.0), Ok(()));
    for (max, step, growth, part) in [
        (0.0, 1.0, 0.0, "the domain goes from"),
        (8.0, 8.5, 0.0, "at most the domain's shortest side, 8, is accepted"),
        (8.0, 0.0, 0.0, "step is 0"),
        (8.0, f64::NAN, 0.0, "step is NaN"),
        (8.0, 0.001, 0.0, "each side may have 1 to 1023 nodes"),
        (8.0, 1.0, -1.0, "grow by -1"),
    ] {
        let error = new(max, step, growth).unwrap_err();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn the_lattice_is_blocked_where_and_only_where_a_point_is_in_an_obstacle() {
    let bodies = vec![
        Convex::octahedron(Vec3::new(6.0, 5.5, 5.2), 3.7).unwrap(),
        Convex::cuboid(Vec3::new(1.0, 9.0, 5.0), Vec3::new(4.0, 4.0, 3.0)).unwrap(),
    ];
    let domain = Aabb { min: Vec3::new(-1.0, 0.0, 0.5), max: Vec3::new(11.0, 10.0, 9.5) };
    let world = PolyhedraWorld::new(bodies, domain, 0.5, 0.4).unwrap();
    assert_eq!(world.grid().size(), [25, 21, 19]);
    let mut blocked = 0;
    let mut near = 0;
    for (x, y, z) in (0..25).flat_map(|x| (0..21).flat_map(move |y| (0..19).map(move |z| (x, y, z)))) {
        let node = world.grid().node([x, y, z]).unwrap();
        assert_eq!(world.grid().is_free(node), world.is_free(&world.point(node)), "{x} {y} {z}");
        assert_eq!(world.node(&world.point(node)), Some(node));
        let touches = base::grid::STEPS_26.iter().any(|step| {
            let to = world.point(node) + Vec3::from(step.map(f64::from)) * world.step();
            !world.is_clear(&Segment::new(world.point(node), to))
        });
        assert!(!touches || world.is_near(node), "{x} {y} {z} was called far");
        blocked += u32::from(!world.grid().is_free(node));
        near += u32::from(world.is_near(node));
    }
    assert!(blocked > 300 && near > blocked && near < 9975, "{blocked} {near}");
}

#[test]
fn the_first_obstacle_met_is_found_and_a_face_is_part_of_it() {
    let at = |x: f64| Convex::cuboid(Vec3::new(x, 5.0, 5.0), Vec3::repeat(2.0)).unwrap();
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(10.0) };
    let world = PolyhedraWorld::new(vec![at(7.0), at(3.0)], domain, 1.0, 0.0).unwrap();
    let hit = world.first_hit(&Segment::new(Vec3::new(0.0, 5.0, 5.0), Vec3::new(10.0, 5.0, 5.0))).unwrap();
    assert_eq!((hit.obstacle, (hit.share * 10.0).round()), (1, 2.0));
    let along_face = Segment::new(Vec3::new(0.0, 6.0, 5.0), Vec3::new(10.0, 6.0, 5.0));
    assert!(!world.is_clear(&along_face));
    assert!(world.is_clear(&Segment::new(Vec3::new(0.0, 6.1, 5.0), Vec3::new(10.0, 6.1, 5.0))));
}

#[test]
fn a_point_that_cannot_be_an_end_is_refused_with_what_is_wrong() {
    let bodies = vec![Convex::cuboid(Vec3::repeat(5.0), Vec3::repeat(2.0)).unwrap()];
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(10.0) };
    let world = PolyhedraWorld::new(bodies, domain, 1.0, 0.0).unwrap();
    for (point, part) in [
        (vec![-1.0, 3.0, 3.0], "the goal [-1.0, 3.0, 3.0] is outside the domain; it goes from"),
        (vec![f64::NAN, 3.0, 3.0], "is outside the domain"),
        (vec![5.0, 5.0, 6.0], "the goal [5.0, 5.0, 6.0] is inside obstacle 1"),
        (vec![3.0, 3.0], "the goal [3.0, 3.0] is not a point in space; [x, y, z] is accepted"),
    ] {
        let refusal = world.free_point("goal", &point).unwrap_err();
        assert!(refusal.contains(part), "{refusal}");
    }
    assert_eq!(world.free_point("goal", &[3.0; 3]), Ok(Vec3::repeat(3.0)));
}

#[test]
fn a_grown_box_keeps_its_corners_and_is_called_grown() {
    let body = Convex::cuboid(Vec3::repeat(10.0), Vec3::repeat(2.0)).unwrap();
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(20.0) };
    let world = PolyhedraWorld::new(vec![body.clone()], domain, 1.0, 3.0).unwrap();
    // 5 cm from the body, and yet in the corner of the grown one, which reaches to 14 on every axis.
    let corner = [11.0 + 5.0 / 3.0_f64.sqrt(); 3];
    let at = Vec3::from(corner);
    assert!((crate::geometry::distance_segment_convex(&Segment::new(at, at), &body) - 5.0).abs() < 1e-9);
    assert_eq!(
        world.free_point("start", &corner).unwrap_err(),
        format!("the start {corner:?} is inside obstacle 1 grown by 3 cm")
    );
    assert_eq!(world.obstacles()[0].edges().len(), 12);
    assert!(world.free_point("start", &[14.01, 10.0, 10.0]).is_ok());
}

fn aubo() -> Robot {
    Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots/aubo_i10.toml")).unwrap()
}

/// The contacts at `q`, measured exactly with nothing remembered.
fn contacts(arm: &CarriedArm, q: &Joints, bodies: &[Convex], reach: f64) -> Vec<Contact> {
    arm.contacts_of(&arm.rods(q), bodies, reach, false, &arm.apart(bodies))
}

#[test]
fn a_box_pierced_by_a_rod_is_touched_and_one_beside_it_is_as_far_as_its_face() {
    let arm = CarriedArm::new(&aubo(), "paper", &Support::on_floor(Frame::IDENTITY)).unwrap();
    // Upright, the upper arm stands on z at y = -20.13 and is 8 thick.
    let beside = |y: f64| vec![Convex::cuboid(Vec3::new(0.0, y, 50.0), Vec3::new(6.0, 6.0, 6.0)).unwrap()];
    let pierced = contacts(&arm, &[0.0; 6], &beside(-20.13), 5.0);
    assert_eq!((pierced.len(), pierced[0].clearance), (1, -8.0));
    let near = contacts(&arm, &[0.0; 6], &beside(-34.13), 5.0);
    assert_eq!(near.len(), 1);
    assert!((near[0].clearance - 3.0).abs() < 1e-9, "{near:?}");
    assert!(contacts(&arm, &[0.0; 6], &beside(-40.13), 5.0).is_empty(), "9 cm is out of reach");
    assert_eq!(
        CarriedArm::new(&aubo(), "bones", &Support::on_floor(Frame::IDENTITY)).unwrap_err(),
        "robot `aubo_i10` has no body `bones`; it has paper, mesh"
    );
}

#[test]
fn rods_and_tip_move_as_their_jacobians_say() {
    let arm = CarriedArm::new(&aubo(), "paper", &Support::on_floor(Frame::IDENTITY)).unwrap();
    let q = [0.3, -0.7, 1.1, 0.4, 0.9, -0.2];
    for rod in 0..arm.parts().len() {
        let at = arm.rods(&q)[rod].segment.b;
        let jacobian = arm.rod_jacobian(&arm.arm().chain().frames(&q), rod, &at);
        for joint in 0..6 {
            let moved = |by: f64| {
                let mut other = q;
                other[joint] += by;
                arm.rods(&other)[rod].segment.b
            };
            let measured = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            let column = jacobian.fixed_view::<3, 1>(0, joint);
            assert!((measured - column).norm() < 1e-5, "rod {rod}, joint {joint}: {measured} {column}");
        }
    }
    let column = arm.tip_jacobian(&arm.arm().chain().frames(&q)).fixed_view::<3, 1>(0, 1).into_owned();
    let mut other = q;
    other[1] += 1e-6;
    assert!(((arm.tip(&other) - arm.tip(&q)) / 1e-6 - column).norm() < 1e-3);
}

#[test]
fn what_is_remembered_of_rods_and_obstacles_changes_no_answer() {
    let pedestal = Convex::cuboid(Vec3::new(0.0, 0.0, -30.0), Vec3::new(20.0, 20.0, 60.0)).unwrap();
    let boxes = [([60.0, 10.0, 45.0], 12.0), ([40.0, -30.0, 70.0], 20.0)];
    let cuboid = |(center, side): ([f64; 3], f64)| Convex::cuboid(center.into(), Vec3::repeat(side)).unwrap();
    let bodies: Vec<Convex> = boxes.into_iter().map(cuboid).chain([pedestal]).collect();
    let arm = CarriedArm::new(&aubo(), "paper", &Support::on_floor(Frame::IDENTITY)).unwrap();
    let seed = 77;
    let apart = arm.apart(&bodies);
    let mut stream = base::seed::stream(seed);
    let mut q = [0.4, -0.9, 1.2, 0.3, 1.5, 0.1];
    let mut clear = 0;
    let mut near = 0;
    for step in 0..3_000 {
        for angle in &mut q {
            *angle += stream.random_range(-0.2..0.2);
        }
        let fresh = || arm.apart(&bodies);
        for least in [0.1, 2.0] {
            let found = arm.is_clear(&q, &bodies, least, false, &apart);
            let all = contacts(&arm, &q, &bodies, 50.0);
            let measured = all.iter().map(|contact| contact.clearance).fold(50.0, f64::min);
            assert_eq!(found, measured >= least, "seed {seed} step {step}: {measured}");
            assert_eq!(found, arm.is_clear(&q, &bodies, least, false, &fresh()));
            clear += u32::from(found);
        }
        let rods = arm.rods(&q);
        let found = arm.contacts_of(&rods, &bodies, 5.0, false, &apart);
        assert_eq!(found, contacts(&arm, &q, &bodies, 5.0), "seed {seed} step {step}");
        let clearance = arm.clearance_of(&rods, &bodies, 6.0, false, &apart);
        assert_eq!(clearance, arm.clearance(&q, &bodies, 6.0, false), "seed {seed} step {step}");
        near += u32::from(!found.is_empty());
    }
    assert!((600..5_400).contains(&clear) && (300..2_900).contains(&near), "one-sided: {clear}, {near}");
}

#[test]
fn where_touching_is_free_a_path_glides_along_a_face_and_still_enters_nothing() {
    let body = Convex::cuboid(Vec3::new(5.0, 5.0, 5.0), Vec3::repeat(4.0)).unwrap();
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(10.0) };
    let closed = PolyhedraWorld::new(vec![body], domain, 1.0, 0.0).unwrap();
    let open = closed.clone().touched_freely();
    let way = |height: f64| Segment::new(Vec3::new(1.0, 5.0, height), Vec3::new(9.0, 5.0, height));
    for (height, by_closed, by_open) in [(7.0, false, true), (7.0 - 1e-6, false, false), (7.1, true, true)] {
        let found = [&closed, &open].map(|world| world.is_clear(&way(height)));
        assert_eq!(found, [by_closed, by_open], "{height}");
        let found = [&closed, &open].map(|world| world.first_hit(&way(height)).is_none());
        assert_eq!(found, [by_closed, by_open], "{height}");
    }
    // 27 nodes lie inside the cube, 125 in it or on its faces.
    assert_eq!(open.grid().free_count() - closed.grid().free_count(), 125 - 27);
    assert!(open.free_point("start", &[7.0, 5.0, 5.0]).is_ok());
    assert!(closed.free_point("start", &[7.0, 5.0, 5.0]).is_err());
}
