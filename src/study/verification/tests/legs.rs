//! What the local path planner joins, the verifier follows, in either direction; but for what leaves the reach between two steps.

use super::super::roadmap::Case;
use base::seed::{derive, stream};
use engine::kinematics::{Joints, Robot};
use engine::space::cell::{Cell, EdgeEnd, LineRules, Lines, Path, Rejection, Scene, Scratch};
use engine::space::roadmap::{Counted, Local, Near, Roadmap};
use rand::RngExt as _;
use std::path::Path as FilePath;

fn lines(end: EdgeEnd) -> Lines {
    let file = |name: &str| FilePath::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name);
    let robot = Robot::load(&file("robots/motoman_up6.toml")).unwrap();
    let scene = Scene::load(&file("scenes/fu2018_cell.toml")).unwrap();
    let rules = LineRules {
        path: Path::Tool,
        step_m: 0.02,
        step_rad: 4_f64.to_radians(),
        jump_rad: 20_f64.to_radians(),
        turn_rad: std::f64::consts::PI,
        speed: None,
        end,
    };
    Lines::new(Cell::new(robot, scene, true), rules)
}

fn case(end: EdgeEnd) -> (Lines, Box<verify::cell::Case>) {
    let lines = lines(end);
    let map =
        Roadmap::build(Local::Arm(Box::new(lines.clone())), Vec::new(), Near::Places(1.0), Counted::Accepted);
    let Case::Arm(case) = Case::new(&map) else { panic!("the roadmap is an arm's") };
    (lines, case)
}

/// Whether the planner joins two configurations; if so, the verifier must follow both ways.
fn is_followed(lines: &Lines, case: &verify::cell::Case, ends: [&Joints; 2], scratch: &mut Scratch) -> bool {
    let [a, b] = ends.map(|q| lines.pose(q));
    if lines.join(&a, &b, scratch).is_err() {
        return false;
    }
    for [from, to] in [[&a.q, &b.q], [&b.q, &a.q]] {
        let motion = case.motion(&[*from, *to], [from, to]);
        assert!(motion.is_ok(), "{:?}: {from:?} to {to:?}", motion.unwrap_err());
    }
    true
}

/// Legs that the planner joins, with an end at which the wrist stands within a millimetre of the first axis: Newton's method fails
/// there at the verifier's own step. Found among 33 718 joined pairs, seed 1.
const BESIDE_SINGULARITIES: [[Joints; 2]; 3] = [
    [
        [
            0.516_330_466_057_780_8,
            -2.893_375_500_955_993,
            0.614_759_028_934_506_6,
            0.706_034_285_374_322_2,
            -1.673_677_319_377_313_6,
            0.100_800_451_815_866_94,
        ],
        [
            0.726_755_850_098_859_1,
            -2.692_007_483_037_884_6,
            -0.490_094_450_948_218_35,
            1.283_075_829_600_938_4,
            -0.390_020_581_099_198_35,
            1.992_512_916_071_093_7,
        ],
    ],
    [
        [
            -0.723_468_205_712_383_1,
            -0.714_842_104_288_988_5,
            2.964_183_399_259_586,
            -0.584_267_274_799_159_1,
            1.927_559_501_607_922_8,
            -1.844_355_811_279_457_4,
        ],
        [
            -0.391_751_162_500_776_13,
            0.041_970_229_230_192_224,
            2.728_484_637_993_856_3,
            -0.752_153_721_576_452_2,
            1.302_372_159_742_172,
            -2.395_802_489_180_689,
        ],
    ],
    [
        [
            0.474_010_779_926_122_6,
            -1.387_936_193_456_463_6,
            -3.144_881_704_142_308_7,
            -2.672_067_097_090_332,
            -2.139_126_447_927_411,
            0.393_630_941_167_015_8,
        ],
        [
            0.214_019_710_784_541_4,
            -0.996_428_487_975_405_7,
            -2.726_799_140_212_426_3,
            -2.209_567_359_157_611,
            -1.292_304_060_775_732_3,
            1.402_398_148_938_164_3,
        ],
    ],
];

/// A leg on which the wrist leaves its reach by 0.017 mm between two steps, 6.6 % of the way.
const OUT_OF_REACH: [Joints; 2] = [
    [
        -0.724_588_538_199_967_5,
        -1.228_950_403_911_366_6,
        -1.306_353_262_972_208_6,
        -2.522_120_337_301_767,
        -1.843_187_340_937_705_5,
        1.714_438_998_201_732_7,
    ],
    [
        -0.470_588_558_063_005_37,
        -1.733_793_051_461_403_3,
        -0.448_860_538_805_130_55,
        -1.909_188_128_507_582_7,
        -1.486_004_828_643_245,
        2.986_561_822_015_554,
    ],
];

#[test]
fn a_leg_out_of_reach_between_two_steps_is_joined_by_no_planner_and_refused() {
    let (lines, case) = case(EdgeEnd::Own);
    let mut scratch = Scratch::default();
    let [from, to] = OUT_OF_REACH;
    assert_eq!(lines.join(&lines.pose(&from), &lines.pose(&to), &mut scratch), Err(Rejection::Unreachable));
    let refusal = case.motion(&[from, to], [&from, &to]).unwrap_err();
    assert_eq!(refusal, "leg 1: the joints cannot follow the line at 6.5 %");
}

#[test]
fn legs_beside_singularities_are_followed_both_ways() {
    let (lines, case) = case(EdgeEnd::Own);
    let mut scratch = Scratch::default();
    for [from, to] in &BESIDE_SINGULARITIES {
        assert!(is_followed(&lines, &case, [from, to], &mut scratch), "not joined: {from:?} to {to:?}");
    }
}

#[test]
fn what_the_planner_joins_the_verifier_follows_both_ways() {
    let (lines, case) = case(EdgeEnd::Own);
    let mut scratch = Scratch::default();
    let mut stream = stream(derive(1, &["legs"]));
    let mut poses: Vec<Joints> = Vec::new();
    while poses.len() < 250 {
        let q = lines
            .cell()
            .robot()
            .arm()
            .chain()
            .joints()
            .map(|joint| stream.random_range(joint.lower_rad.max(-3.15)..joint.upper_rad.min(3.15)));
        poses.extend(lines.cell().is_free(&q).then_some(q));
    }
    let pairs = (0..poses.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    let joined =
        pairs.filter(|(a, b)| is_followed(&lines, &case, [&poses[*a], &poses[*b]], &mut scratch)).count();
    assert!(joined > 300, "{joined} of 31 125 pairs were joined");
}

#[test]
fn a_joint_that_turns_back_at_its_limit_within_a_step_is_followed_or_not_joined() {
    let (lines, case) = case(EdgeEnd::Own);
    let mut scratch = Scratch::default();
    let mut stream = stream(derive(1, &["legs at the limit of the sixth joint"]));
    let upper_rad = lines.cell().robot().arm().chain().joints()[5].upper_rad;
    let mut joined = 0;
    for _ in 0..20_000 {
        let mut near = |middle: f64| middle + stream.random_range(-0.3..0.3);
        let mut from = [0.0, -90.0, 0.0, 0.0, 60.0, 0.0].map(|deg: f64| near(deg.to_radians()));
        let mut to = from.map(&mut near);
        // Both ends lie a thousandth of a turn from the limit at most: what is between may pass it.
        for q in [&mut from, &mut to] {
            q[5] = upper_rad - stream.random_range(0.0..0.006);
        }
        let is_free = [&from, &to].iter().all(|q| lines.cell().is_free(q));
        joined += usize::from(is_free && is_followed(&lines, &case, [&from, &to], &mut scratch));
    }
    assert!(joined > 300, "{joined} were joined");
}

#[test]
fn whole_turns_add_up_along_a_path_until_the_sixth_joint_ends() {
    let (lines, case) = case(EdgeEnd::WholeTurns);
    let mut scratch = Scratch::default();
    let home = |last: f64| [0.0, -90.0, 0.0, 0.0, 90.0, last].map(f64::to_radians);
    let path = [home(150.0), home(-90.0), home(30.0)];
    for leg in path.windows(2) {
        assert!(lines.join(&lines.pose(&leg[0]), &lines.pose(&leg[1]), &mut scratch).is_ok(), "{leg:?}");
        assert!(case.motion(leg, [&leg[0], &leg[1]]).is_ok(), "{leg:?}");
    }
    // The first leg arrives at 270 degrees, from where the second would end at 390.
    let refusal = case.motion(&path, [&path[0], &path[2]]).unwrap_err();
    assert!(refusal.starts_with("leg 2: joint 6 is outside its limits at "), "{refusal}");
}
