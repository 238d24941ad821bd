use super::*;
use crate::geometry::planar::{Circle, ConvexPolygon};
use base::seed;
use rand::RngExt as _;

/// The rules of the reproduced workspace.
fn rules(hop: HopRule) -> ArmRules {
    ArmRules {
        arm: Planar2r::new(30.0, 20.0).unwrap(),
        elbow: ElbowRule::NegativeQ2,
        lattice: TipLattice::new([-50.0, 50.0], [0.0, 50.0], 1.0).unwrap(),
        inner_radius_cm: 20.0,
        q2_limit_rad: f64::INFINITY,
        touch: Touch::Contact,
        corner_rule: CornerRule::Allow,
        hop,
    }
}

fn circle(x: f64, y: f64) -> Obstacle {
    Obstacle::Circle(Circle::new(Vec2::new(x, y), 5.0).unwrap())
}

fn square(x: f64, y: f64) -> Obstacle {
    let (low, high) = (Vec2::new(x - 5.0, y - 5.0), Vec2::new(x + 5.0, y + 5.0));
    Obstacle::Polygon(ConvexPolygon::rectangle(low, high).unwrap())
}

const CASE_1: [[f64; 2]; 4] = [[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]];

fn case_1(hop: HopRule) -> ArmWorld {
    ArmWorld::new(rules(hop), CASE_1.into_iter().map(|[x, y]| circle(x, y)).collect())
}

#[test]
fn without_obstacles_the_free_points_are_the_upper_half_of_the_ring() {
    let world = ArmWorld::new(rules(HopRule::EndPoints), Vec::new());
    let mut counts = [0; 3];
    for x in -50_i64..=50 {
        for y in 0_i64..=50 {
            let cell = world.rules().lattice.cell(&[x as f64, y as f64]).unwrap();
            let (truth, slot) = match x * x + y * y {
                d if d > 2500 => (Zone::OuterReach, 0),
                d if d < 400 => (Zone::InnerReach, 1),
                _ => (Zone::Free, 2),
            };
            assert_eq!(world.zones()[cell as usize], truth, "({x}, {y})");
            counts[slot] += 1;
        }
    }
    assert_eq!(counts.iter().sum::<i32>(), 101 * 51);
    assert_eq!(world.grid().free_count(), counts[2] as u32);
}

/// The obstacles of case 1 as regular polygons on circles of 5 cm, or as squares 10 cm wide.
fn polygons(sides: usize) -> Vec<ConvexPolygon> {
    let polygon = |at: [f64; 2]| match (sides, Vec2::from(at)) {
        (4, at) => ConvexPolygon::rectangle(at - Vec2::new(5.0, 5.0), at + Vec2::new(5.0, 5.0)).unwrap(),
        (_, at) => ConvexPolygon::regular(at, 5.0, sides, std::f64::consts::FRAC_PI_2).unwrap(),
    };
    CASE_1.map(polygon).to_vec()
}

/// How far `at` is in front of the polygon's sides: below its distance where a corner is nearest, but of the same sign.
fn height(polygon: &ConvexPolygon, at: &Vec2) -> f64 {
    let corners = polygon.vertices();
    let side = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let way = b - a;
        let off = at - a;
        (off.x * way.y - off.y * way.x) / way.norm()
    };
    (0..corners.len()).map(side).fold(f64::NEG_INFINITY, f64::max)
}

/// The least `gap` of points every 0.05 cm of the links.
fn nearest(world: &ArmWorld, cell: u32, gap: impl Fn(&Vec2) -> f64) -> f64 {
    let arm = world.rules().arm;
    let posture = world.posture(cell);
    let elbow = arm.elbow(posture);
    let tip = arm.forward(posture);
    assert!((tip - world.rules().lattice.point(cell)).norm() < 1e-9);
    let points = (0..=1000).map(|k| {
        let s = f64::from(k) / 20.0;
        if s <= 30.0 { elbow * (s / 30.0) } else { elbow + (tip - elbow) * ((s - 30.0) / 20.0) }
    });
    points.map(|at| gap(&at)).fold(f64::INFINITY, f64::min)
}

/// Free postures keep sampled points out, postures with a link in an obstacle come within `slack` of it.
fn assert_zones(world: &ArmWorld, slack: f64, gap: impl Fn(&Vec2) -> f64) {
    let mut free = 0;
    let mut hit = 0;
    for cell in 0..world.grid().cell_count() {
        match world.zones()[cell as usize] {
            Zone::Free => {
                assert!(nearest(world, cell, &gap) > 0.0, "{cell} is not free");
                free += 1;
            }
            Zone::Link => {
                assert!(nearest(world, cell, &gap) < slack, "{cell} is not hit");
                hit += 1;
            }
            _ => {}
        }
    }
    assert!(free > 400 && hit > 400, "one-sided workspace: {free} free, {hit} hit");
}

#[test]
fn every_free_posture_puts_the_tip_on_its_point_and_keeps_sampled_link_points_clear() {
    // Against the circles' own equation.
    assert_zones(&case_1(HopRule::EndPoints), 0.001, |at| {
        CASE_1.map(|c| (at - Vec2::from(c)).norm() - 5.0).into_iter().fold(f64::INFINITY, f64::min)
    });
}

#[test]
fn squares_hexagons_and_triangles_block_the_postures_whose_sampled_link_points_they_hold() {
    for sides in [3, 4, 6] {
        let solids = polygons(sides);
        let obstacles = solids.iter().cloned().map(Obstacle::Polygon).collect();
        let world = ArmWorld::new(rules(HopRule::EndPoints), obstacles);
        // A link that cuts a corner between two samples is half their distance from one of them.
        assert_zones(&world, 0.026, |at| {
            solids.iter().map(|polygon| height(polygon, at)).fold(f64::INFINITY, f64::min)
        });
        let inside = |cell: u32| {
            let at = world.rules().lattice.point(cell);
            solids.iter().any(|polygon| height(polygon, &at) < -1e-9)
        };
        let reached = (0..world.grid().cell_count()).filter(|&cell| inside(cell));
        let zones: Vec<Zone> = reached.map(|cell| world.zones()[cell as usize]).collect();
        assert!(zones.len() > 100 && zones.iter().all(|zone| *zone != Zone::Free), "{sides} sides");
    }
}

/// The posture at a share of the way from one cell to another, as the hop rule moves the arm.
fn under_way(world: &ArmWorld, [from, to]: [u32; 2], share: f64) -> [f64; 2] {
    let arm = world.rules().arm;
    let lattice = world.rules().lattice;
    let (a, b) = (world.posture(from), world.posture(to));
    if world.rules().hop == HopRule::TipLine {
        let (from, to) = (lattice.point(from), lattice.point(to));
        // Rounding may put a tip that the arm reaches stretched a hair too far.
        let tip = (from + (to - from) * share) * (1.0 - 1e-12);
        return arm.pick(&arm.inverse(&tip).unwrap(), world.rules().elbow);
    }
    [0, 1].map(|joint| a[joint] + share * (b[joint] - a[joint]))
}

#[test]
fn a_hop_with_even_joints_is_free_iff_postures_sampled_along_it_are() {
    // Every posture bends to one side here, so that no joint jumps.
    let [clear, jumped, undecided] = sampled_against(&case_1(HopRule::Continuous), 0.1);
    assert!(clear > 3_000 && jumped > 20 && undecided < 10, "{clear} {jumped} {undecided}");
}

#[test]
fn a_hop_with_a_straight_tip_is_free_iff_postures_sampled_along_it_are() {
    // Near full stretch the elbow moves faster than the tip.
    let [clear, jumped, undecided] = sampled_against(&case_1(HopRule::TipLine), 0.6);
    assert!(clear > 3_000 && jumped > 20 && undecided < 10, "{clear} {jumped} {undecided}");
}

/// How many random hops were free, hit an obstacle at a sample, and are refused with all samples less than `spare` cm clear.
fn sampled_against(world: &ArmWorld, spare: f64) -> [u32; 3] {
    let grid = world.grid();
    let free: Vec<u32> = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).collect();
    let seed = 41;
    let mut stream = seed::stream(seed);
    let mut clear = 0;
    let mut jumped = 0;
    let mut undecided = 0;
    for draw in 0..12_000 {
        let from = free[stream.random_range(0..free.len())];
        let [x, y] = grid.xy(from);
        let to = grid.cell(x + stream.random_range(-6..=6), y + stream.random_range(-6..=6));
        let Some(to) = to.filter(|&to| to != from && grid.is_free(to)) else { continue };
        let links = |share: f64| {
            let posture = under_way(world, [from, to], share);
            let arm = world.rules().arm;
            let elbow = arm.elbow(posture);
            let tip = arm.forward(posture);
            [Segment2::new(Vec2::zeros(), elbow), Segment2::new(elbow, tip)]
        };
        let tips = (0..=300).map(|k| links(f64::from(k) / 300.0)[1].b.norm());
        if tips.fold(f64::INFINITY, f64::min) < world.rules().nearest_cm() - 1e-6 {
            assert!(!world.may_hop(from, to), "seed {seed} draw {draw}: the tip comes too near to the base");
            continue;
        }
        let least = (0..=300)
            .flat_map(|k| links(f64::from(k) / 300.0))
            .flat_map(|link| world.obstacles().iter().map(move |o| o.distance(&link)))
            .fold(f64::INFINITY, f64::min);
        match (world.may_hop(from, to), least) {
            (true, least) => {
                assert!(least > 0.0, "seed {seed} draw {draw}: a hit on the way from {from} to {to}");
                clear += 1;
            }
            (false, 0.0) => jumped += 1,
            // Between two samples no point moves farther: a hit may hide there, and nothing else may.
            (false, least) => {
                assert!(least < spare, "seed {seed} draw {draw}: refused with {least} cm to spare");
                undecided += 1;
            }
        }
    }
    [clear, jumped, undecided]
}

#[test]
fn a_straight_tip_goes_nowhere_nearer_to_the_base_than_points_may_lie_and_changes_no_side() {
    let world = ArmWorld::new(rules(HopRule::TipLine), Vec::new());
    let cell = |x: f64, y: f64| world.rules().lattice.cell(&[x, y]).unwrap();
    // The chords at height 20 touch the forbidden disc, those below enter it.
    assert!(world.may_hop(cell(-1.0, 20.0), cell(1.0, 20.0)));
    assert!(!world.may_hop(cell(-12.0, 16.0), cell(12.0, 16.0)));
    let even = ArmWorld::new(rules(HopRule::Continuous), Vec::new());
    assert!(even.may_hop(cell(-12.0, 16.0), cell(12.0, 16.0)), "the joints know another way");
    let higher = ArmRules { elbow: ElbowRule::HigherElbow, ..rules(HopRule::TipLine) };
    let higher = ArmWorld::new(higher, Vec::new());
    assert!(!higher.may_hop(cell(-1.0, 30.0), cell(1.0, 30.0)), "the elbow would jump");
    assert!(higher.may_hop(cell(1.0, 30.0), cell(4.0, 31.0)));
}

#[test]
fn a_stop_of_joint_2_forbids_the_disc_that_the_text_gives_the_inner_region() {
    // cos 138.59° = −3/4: 30² + 20² − 3/4 · 2 · 30 · 20 = 20².
    let stopped =
        ArmRules { inner_radius_cm: 0.0, q2_limit_rad: 138.6_f64.to_radians(), ..rules(HopRule::EndPoints) };
    let obstacles: Vec<Obstacle> = CASE_1.into_iter().map(|[x, y]| circle(x, y)).collect();
    let world = ArmWorld::new(stopped, obstacles);
    let truth = case_1(HopRule::EndPoints);
    assert_eq!(world.zones(), truth.zones());
    assert!((world.rules().nearest_cm() - 20.0).abs() < 0.01);
    let free = ArmRules { q2_limit_rad: f64::INFINITY, ..stopped };
    assert_eq!(free.nearest_cm(), 10.0);
    assert_ne!(ArmWorld::new(free, Vec::new()).zones(), ArmWorld::new(stopped, Vec::new()).zones());
}

#[test]
fn touching_decides_for_points_on_a_rim() {
    // (30, 18) is on the rim of the disc about (35, 18), and the arm comes to it from the other side.
    for (touch, free) in [(Touch::Contact, false), (Touch::Free, true)] {
        let world = ArmWorld::new(ArmRules { touch, ..rules(HopRule::EndPoints) }, vec![circle(35.0, 18.0)]);
        let cell = world.rules().lattice.cell(&[30.0, 18.0]).unwrap();
        assert_eq!(world.grid().is_free(cell), free, "{touch:?}");
    }
}

#[test]
fn a_corner_rule_binds_diagonal_hops_of_one_cell_only() {
    let world = |corner_rule| {
        ArmWorld::new(ArmRules { corner_rule, ..rules(HopRule::EndPoints) }, vec![square(30.0, 20.0)])
    };
    let allowed = |corner_rule| {
        let world = world(corner_rule);
        let grid = world.grid();
        let hops = (0..grid.cell_count()).filter(|&cell| grid.is_free(cell)).flat_map(|cell| {
            let [x, y] = grid.xy(cell);
            let to = |by: i32| grid.cell(x + by, y - by).filter(|&to| grid.is_free(to));
            [to(1), to(2)].map(|to| to.is_some_and(|to| world.may_hop(cell, to)))
        });
        let hops: Vec<bool> = hops.collect();
        [0, 1].map(|kind| hops.iter().skip(kind).step_by(2).filter(|allowed| **allowed).count())
    };
    let [any, both, all] = [CornerRule::ForbidAny, CornerRule::ForbidBoth, CornerRule::Allow].map(allowed);
    assert!(any[0] < all[0] && both[0] <= all[0] && any[0] < both[0], "{any:?} {both:?} {all:?}");
    assert_eq!([any[1], both[1]], [all[1]; 2]);
}

#[test]
fn a_lattice_and_a_query_that_do_not_fit_say_why() {
    let lattice = |x: [f64; 2], step| TipLattice::new(x, [0.0, 50.0], step).unwrap_err().1;
    assert_eq!(
        lattice([-50.0, 50.0], 0.3),
        "step_cm is 0.3, which does not divide x_cm of 100 cm; a whole number of steps is accepted"
    );
    assert_eq!(lattice([-50.0, 50.0], 0.0), "step_cm is 0; a step above 0 is accepted");
    assert!(lattice([50.0, -50.0], 1.0).starts_with("x_cm runs from 50 to -50; "));
    assert!(lattice([-50.0, 50.0], 0.001).contains("makes 100001 × 50001 points; "));
    let world = case_1(HopRule::EndPoints);
    let refused = |point: &[f64]| world.free_cell("goal", point).unwrap_err();
    assert_eq!(refused(&[35.0, 18.0]), "the goal [35.0, 18.0] lies in obstacle 1");
    assert!(refused(&[0.0, 5.0]).ends_with("is 5.0000 cm from the base; the arm may stand from 20 to 50 cm"));
    assert!(refused(&[50.0, 50.0]).contains("70.7107 cm"));
    assert!(refused(&[0.5, 30.0]).ends_with("x -50 to 50 and y 0 to 50 in steps of 1 cm"));
    assert!(refused(&[0.0]).contains("is not a point of the workspace"));
    let zones = world.zones();
    let behind = zones.iter().position(|zone| *zone == Zone::Link).unwrap() as u32;
    let at = world.rules().lattice.point(behind);
    assert!(refused(&[at.x, at.y]).starts_with("with the tip on the goal"));
}
