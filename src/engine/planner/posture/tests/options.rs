//! What each option of the stage does, one at a time.

use super::*;
use nalgebra::Matrix3;
use world::geometry::Convex;

/// A box beside lines along y, near which postures are adjusted.
fn beside() -> World {
    world(&[([70.0, 15.0, 48.0], [10.0, 14.0, 22.0])])
}

/// Lines past the box, node by node.
fn lines(step: f64) -> Vec<Vec<Vec3>> {
    let line = |x: f64, z: f64| densified(&[Vec3::new(x, -15.0, z), Vec3::new(x, 40.0, z)], step);
    (52..62).flat_map(|x| (34..64).step_by(5).map(move |z| line(f64::from(x), f64::from(z)))).collect()
}

/// Every line followed with bounds of 0.05 rad about each axis, which count from where `bounds` says; and in which world.
pub(in crate::planner) fn followed(bounds: &str) -> (World, Vec<(Vec<Vec3>, Plan)>) {
    let world = beside();
    let text = RECIPE.replace("[0.2, 0.2, 0.1]", "[0.05, 0.05, 0.05]").replace("per_node", bounds);
    let settings = Posture::read(&Settings::composed("test", toml::from_str(&text).unwrap())).unwrap();
    let follow = |nodes: Vec<Vec3>| {
        let plan = along(&settings, &world, nodes[0].into(), nodes[nodes.len() - 1].into());
        (nodes, plan)
    };
    let plans = lines(1.0).into_iter().map(follow).collect();
    (world, plans)
}

/// What was stored on one line, how the posture stood at its nodes, and which way it went.
struct Way {
    nodes: Vec<Vec3>,
    trail: Vec<Joints>,
    stood: Vec<Matrix3<f64>>,
    adjustments: u64,
}

/// Follows every line as far as it goes, on the branch with the most clearance.
fn ways(settings: &Posture, world: &World) -> Vec<Way> {
    let polyhedra = world.as_polyhedra().unwrap();
    let arm = polyhedra.arm().unwrap();
    let follow = |nodes: Vec<Vec3>| {
        let (branch, q) = settings.starts(polyhedra, arm, &nodes[0]).first().copied()?;
        let mut follower = Follower::new((settings, polyhedra, arm), branch, q, DOWN);
        let mut stood = vec![DOWN];
        for pair in nodes.windows(2) {
            if follower.follow(pair).is_err() {
                break;
            }
            stood.push(follower.rotation);
        }
        Some(Way { nodes, trail: follower.trail, stood, adjustments: follower.adjustments })
    };
    lines(polyhedra.step()).into_iter().filter_map(follow).collect()
}

/// How often a turn from `from` to `to` met its bound about some axis; a turn beyond it fails.
fn assert_bounded(from: &Matrix3<f64>, to: &Matrix3<f64>, bounds: [f64; 3]) -> u32 {
    let turn = rotation::log(&(to * from.transpose()));
    for (angle, bound) in turn.iter().zip(bounds) {
        assert!(angle.abs() <= bound + 1e-9, "{turn} is beyond {bounds:?}");
    }
    u32::from(turn.iter().zip(bounds).any(|(angle, bound)| angle.abs() > bound - 1e-6))
}

#[test]
fn the_turn_at_each_node_stays_within_its_bounds() {
    let world = beside();
    let bounds = [0.06, 0.05, 0.04];
    let settings = posture(("bounds_rad = [0.2, 0.2, 0.1]", "bounds_rad = [0.06, 0.05, 0.04]")).unwrap();
    let mut met = 0;
    let mut far = 0;
    for way in ways(&settings, &world) {
        for pair in way.stood.windows(2) {
            met += assert_bounded(&pair[0], &pair[1], bounds);
        }
        far += way.stood.iter().filter(|to| rotation::log(&(*to * DOWN.transpose())).amax() > 0.07).count();
    }
    assert!(
        met > 5 && far > 5,
        "one-sided sample: the bounds were met {met} times, and passed over nodes {far}"
    );
}

#[test]
fn from_the_start_the_whole_turn_stays_within_the_bounds() {
    let world = beside();
    let bounds = [0.2, 0.2, 0.1];
    let settings = posture(("bounds = 'per_node'", "bounds = 'from_start'")).unwrap();
    let met: u32 = ways(&settings, &world)
        .iter()
        .flat_map(|way| &way.stood)
        .map(|stood| assert_bounded(&DOWN, stood, bounds))
        .sum();
    assert!(met > 5, "the bounds were met {met} times");
}

#[test]
fn turns_in_place_are_stored_step_by_step() {
    let world = beside();
    let arm = world.as_polyhedra().unwrap().arm().unwrap().clone();
    let settings = posture(("", "")).unwrap();
    let mut turns = 0;
    let mut longest = 0;
    for way in ways(&settings, &world) {
        assert!(way.adjustments > 0 || way.trail.len() == way.stood.len());
        let mut together = 0;
        for pair in way.trail.windows(2) {
            if (arm.tip(&pair[1]) - arm.tip(&pair[0])).norm() > 1e-6 {
                together = 0;
                continue;
            }
            let [from, to] = [0, 1].map(|i| arm.arm().chain().forward(&pair[i]).rotation);
            let angle = rotation::log(&(to * from.transpose())).norm();
            assert!(angle <= settings.step_rad + 1e-9, "a turn of {angle} in one step");
            (turns, together) = (turns + 1, together + 1);
            longest = longest.max(together);
        }
    }
    assert!(turns > 20 && longest >= 3, "{turns} steps in place, {longest} of them together");
}

#[test]
fn joints_moved_by_the_jacobian_leave_the_line_and_solved_ones_do_not() {
    let world = beside();
    let arm = world.as_polyhedra().unwrap().arm().unwrap().clone();
    let off = |change: (&str, &str)| {
        let of_way = |way: &Way| {
            let (from, to) = (way.nodes[0], way.nodes[way.nodes.len() - 1]);
            let along = (to - from).normalize();
            let off = |q: &Joints| {
                let to = arm.tip(q) - from;
                (to - along * to.dot(&along)).norm()
            };
            way.trail.iter().map(off).fold(0.0, f64::max)
        };
        ways(&posture(change).unwrap(), &world).iter().map(of_way).fold(0.0, f64::max)
    };
    let solved = off(("", ""));
    let moved = off(("pose = 'inverse'", "pose = 'jacobian'"));
    assert!(solved < 1e-6 && moved > 1e-3 && moved < 5.0, "{solved} cm and {moved} cm off the line");
}

#[test]
fn a_distance_clamped_to_nothing_has_an_infinite_potential_and_no_direction() {
    let q: Joints = [0.3, -0.7, 1.1, 0.4, 0.9, -0.2];
    let free = world(&[]);
    let arm = free.as_polyhedra().unwrap().arm().unwrap().clone();
    // Beside the forearm's axis and within its radius.
    let rod = arm.rods(&q)[2];
    let along = (rod.segment.b - rod.segment.a).normalize();
    let at = rod.segment.at(0.5) + along.cross(&Vec3::z()).normalize() * (rod.radius - 2.0);
    let touched = world(&[(at.into(), [1.0; 3])]);
    let polyhedra = touched.as_polyhedra().unwrap();
    let [floor, literal] =
        [("", ""), ("clamp = 'floor'", "clamp = 'literal'")].map(|change| posture(change).unwrap());
    let [floored, clamped] = [&floor, &literal]
        .map(|settings| field(settings, polyhedra, &arm, &arm.rods(&q), &arm.apart(polyhedra.bodies())));
    assert!(floored.clearance < 0.0 && floored.clearance == clamped.clearance, "{}", floored.clearance);
    assert!(floored.potential.is_finite() && clamped.potential.is_infinite());
    let frames = arm.arm().chain().frames(&q);
    assert!(direction(&floor, &arm, &frames, &floored).is_some());
    assert_eq!(direction(&literal, &arm, &frames, &clamped), None);
}

#[test]
fn only_the_clearest_branch_is_tried_on_request() {
    let world = beside();
    let polyhedra = world.as_polyhedra().unwrap();
    let arm = polyhedra.arm().unwrap();
    let [all, clearest] =
        [("", ""), ("branches = 'all'", "branches = 'clearest'")].map(|change| posture(change).unwrap());
    let (start, goal) = ([60.0, -15.0, 40.0], [60.0, 40.0, 40.0]);
    let [tried, one] = [&all, &clearest].map(|settings| settings.starts(polyhedra, arm, &start.into()));
    assert!(tried.len() > 1 && one == tried[..1], "{tried:?} and {one:?}");
    let clearance = |q: &Joints| arm.clearance(q, polyhedra.bodies(), 50.0, false);
    assert!(tried.iter().all(|(_, q)| clearance(q) <= clearance(&one[0].1)));
    // A wall across the line, which no branch passes.
    let shut = self::world(&[([60.0, 15.0, 40.0], [80.0, 2.0, 80.0])]);
    let tries =
        [&all, &clearest].map(|settings| along(settings, &shut, start, goal).counts["branches_tried"]);
    assert!(tries[0].as_f64() > 1.0 && tries[1] == Value::Count(1), "{tries:?}");
}

#[test]
fn printed_distances_stand_in_for_the_exact_ones_on_request() {
    let bodies = [Convex::cuboid(Vec3::new(70.0, 15.0, 48.0), Vec3::new(10.0, 14.0, 22.0)).unwrap()];
    let world = beside();
    let polyhedra = world.as_polyhedra().unwrap();
    let arm = polyhedra.arm().unwrap();
    let [exact, printed] =
        [("", ""), ("distance = 'exact'", "distance = 'printed'")].map(|change| posture(change).unwrap());
    let mut differ = 0;
    for way in ways(&exact, &world) {
        for q in way.trail.iter().step_by(3) {
            let [one, other] = [&exact, &printed]
                .map(|settings| field(settings, polyhedra, arm, &arm.rods(q), &arm.apart(&bodies)).clearance);
            let [truth, formula] = [false, true].map(|is_printed| arm.clearance(q, &bodies, 5.0, is_printed));
            assert_eq!((one, other), (truth, formula));
            differ += u32::from((one - other).abs() > 1e-6);
        }
    }
    assert!(differ > 0, "the two distances were the same everywhere");
}
