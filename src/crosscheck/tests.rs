//! Questions and models: that the sample is worth drawing, and that MJCF says what files say.

use super::chapter::{Depicted, MUJOCO, chapter};
use super::mjcf::{Key, mjcf};
use super::model::{Freedom, Pair, Still};
use super::path::{Path as JointPath, Pushed, drawn_paths, pushed};
use super::sample::{Kind, NEAR_M, Sampler, Sizes, least_of};
use super::subject::{SerialArm, Subject, straight};
use engine::geometry::{Frame, OrientedBox, Solid, Sphere, Vec3};
use engine::kinematics::Robot;
use std::path::Path;

const SIZES: Sizes = Sizes {
    random: 200,
    random_frames: 20,
    random_distances: 10,
    near_contact: 40,
    singular: 20,
    piercing: 10,
    drawn_paths: 2,
};

fn robot(name: &str) -> Robot {
    Robot::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("data/robots/{name}.toml"))).unwrap()
}

fn up6() -> SerialArm {
    let cuboid = OrientedBox::from_corners(Vec3::new(0.6, -0.3, 0.0), Vec3::new(0.9, 0.1, 0.5)).unwrap();
    let ball = Sphere::new(Vec3::new(0.2, 0.9, 0.7), 0.15).unwrap();
    let stills = vec![
        Still { name: "box <&>".to_owned(), solid: Solid::Box(cuboid) },
        Still { name: "ball".to_owned(), solid: Solid::Sphere(ball) },
    ];
    SerialArm::new("up6".to_owned(), robot("motoman_up6"), "capsules", stills, true).unwrap()
}

#[test]
fn questions_are_what_their_kind_says() {
    let arm = up6();
    let questions = Sampler::new(&arm, 11).questions(&SIZES);
    let of = |kind: Kind| questions.iter().filter(|question| question.kind == kind).collect::<Vec<_>>();
    let pairs = arm.model().pairs();
    let near = of(Kind::NearContact);
    let mut sides = [0, 0];
    for question in &near {
        let gaps = arm.gaps_m(&question.q_rad);
        let groups = [Some(0), Some(1), None];
        let gap = groups
            .map(|group| least_of(&gaps, &pairs, group))
            .into_iter()
            .min_by(|a, b| a.abs().total_cmp(&b.abs()));
        let gap = gap.unwrap();
        assert!((1e-6..NEAR_M * 1.001).contains(&gap.abs()), "{gap}");
        sides[usize::from(gap < 0.0)] += 1;
    }
    assert!(sides[0] >= 10 && sides[1] >= 10, "one-sided: {sides:?}");
    let singular = of(Kind::Singular);
    assert!(singular.len() >= 15, "{}", singular.len());
    for question in &singular {
        let value = arm.determinant(&question.q_rad);
        assert!(value.abs() < 1e-9, "{value} at {:?}", question.q_rad);
    }
    let usual = of(Kind::Random).iter().filter(|q| arm.determinant(&q.q_rad).abs() > 1e-3).count();
    assert!(usual > 100, "a determinant of 1e-9 would say nothing: {usual}");
    // A configuration in a hundred pierces something here, so that a search ends before it has all ten.
    assert!((2..=10).contains(&of(Kind::Piercing).len()), "{}", of(Kind::Piercing).len());
    assert!(of(Kind::Piercing).iter().all(|question| arm.pierces(&question.q_rad)));
    let beyond = |q: &[f64]| (0..6).filter(|joint| arm.is_beyond(*joint, q[*joint]) == Some(true)).count();
    let limits: Vec<usize> = of(Kind::Limit).iter().map(|question| beyond(&question.q_rad)).collect();
    assert_eq!((limits.len(), limits.iter().filter(|count| **count == 1).count()), (36, 24));
    assert!(of(Kind::Random).iter().all(|question| beyond(&question.q_rad) == 0));
    assert_eq!(questions, Sampler::new(&arm, 11).questions(&SIZES));
}

#[test]
fn a_model_is_written_with_the_numbers_of_its_files() {
    let arm = up6();
    let key = Key { name: "zero".to_owned(), q_rad: vec![0.0; 6] };
    let text = mjcf(arm.model(), &[key]);
    for part in [
        "angle=\"radian\"",
        "<body name=\"link_3\" pos=\"0.13 0.0 0.0\" axisangle=\"1 0 0 -1.5707963267948966\">",
        "<joint name=\"joint_5\" axis=\"0 0 1\" range=\"-2.356194490192345 2.356194490192345\"/>",
        "<body name=\"tool\" pos=\"0 0 0.15\"/>",
        "<geom name=\"still:box &lt;&amp;&gt;\" type=\"mesh\" mesh=\"mesh_0\" contype=\"0\" conaffinity=\"1\"",
        "<geom name=\"part:turret\" type=\"capsule\" fromto=\"-0.15 0.0 0.0 0.0 0.0 0.0\" size=\"0.14\" contype=\"0\"",
        "<pair geom1=\"part:elbow\" geom2=\"part:base\" margin=\"0\" gap=\"0\"/>",
        "<key name=\"zero\" qpos=\"0.0 0.0 0.0 0.0 0.0 0.0\"/>",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert_eq!(text.matches("<body ").count(), text.matches("</body>").count() + 1, "tool closes itself");
}

#[test]
fn errors_on_purpose_change_what_they_say_and_nothing_else() {
    let arm = up6();
    let (longer, link) = arm.model().stretched(1e-3);
    assert!(link == 2 && (longer.rows[1].a_m - 0.571).abs() < 1e-12, "{link} {}", longer.rows[1].a_m);
    let by_m = Vec3::new(0.0, 0.005, 0.0);
    let q = [0.3, -0.8, 0.1, 0.2, 0.7, 0.0];
    let (before, after) = (arm.gaps_m(&q), arm.shifted(0, &by_m).gaps_m(&q));
    for ((pair, a), b) in arm.model().pairs().iter().zip(before).zip(after) {
        assert_eq!(a != b, matches!(pair, Pair::Still(_, 0)), "{pair:?} {a} {b}");
        assert!((a - b).abs() <= 0.005 + 1e-12, "{pair:?} {a} {b}");
    }
}

#[test]
fn a_free_path_that_is_pushed_meets_an_obstacle_and_one_in_contact_is_not_pushed() {
    let arm = up6();
    let least = |q: &Vec<f64>| arm.gaps_m(q).into_iter().fold(f64::INFINITY, f64::min);
    let paths = drawn_paths(&arm, 8, 5);
    assert_eq!(paths.len(), 8);
    assert!(paths.iter().flat_map(|path| &path.stops_rad).all(|q| least(q) > 0.0));
    let met: Vec<(&JointPath, Pushed)> =
        paths.iter().filter_map(|path| Some((path, pushed(&arm, path)?))).collect();
    assert!(met.len() >= 4, "only {} of 8 met anything", met.len());
    for (path, Pushed { path: bent, stop, pair }) in met {
        assert!(arm.model().pairs()[pair].still().is_some(), "pushed into itself");
        assert!(arm.gaps_m(&bent.stops_rad[stop])[pair] <= -1e-3);
        assert!(arm.gaps_m(&path.stops_rad[stop])[pair] > 0.0);
        assert_eq!(pushed(&arm, &bent), None, "a path in contact proves nothing");
    }
}

#[test]
fn a_stored_path_is_followed_on_the_tool_s_straight_line() {
    let arm = up6();
    let from = vec![0.1, -0.9, 0.2, -0.1, 0.8, 0.0];
    let to = vec![0.12, -0.91, 0.21, -0.08, 0.79, 0.02];
    let path = JointPath { name: "p".to_owned(), stops_rad: vec![from.clone(), to.clone()] };
    let finer = path.finer(&arm).unwrap();
    assert_eq!(finer.stops_rad.len(), 5);
    let tool = |q: &[f64]| *arm.frames(q).last().unwrap();
    let (a, b) = (tool(&from), tool(&to));
    for (index, q) in finer.stops_rad.iter().enumerate() {
        let share = index as f64 / 4.0;
        let on_line = a.origin + (b.origin - a.origin) * share;
        assert!((tool(q).origin - on_line).norm() < 1e-12, "{index}");
        let turned: Frame = straight(&a, &b, share);
        assert!((tool(q).rotation - turned.rotation).norm() < 1e-9, "{index}");
    }
    let whole = straight(&a, &b, 1.0);
    assert!((whole.rotation - b.rotation).norm() < 1e-12);
}

#[test]
fn a_promise_is_broken_by_the_contacts_that_it_is_about() {
    let outer = Pair::Still(1, 0);
    let own = Pair::Parts(0, 2);
    let broken = |promise: Freedom| [outer, own].map(|pair| promise.is_broken_by(pair));
    assert_eq!(broken(Freedom::Nothing), [false, false]);
    assert_eq!(broken(Freedom::Scene), [true, false]);
    assert_eq!(broken(Freedom::Contact), [true, true]);
    // Of several, the least promise counts.
    assert!(Freedom::Nothing < Freedom::Scene && Freedom::Scene < Freedom::Contact);
}

#[test]
fn the_version_in_the_report_is_the_one_that_is_installed() {
    let pinned = include_str!("../../crosscheck/requirements.txt");
    assert!(pinned.lines().any(|line| line == format!("mujoco=={MUJOCO}")), "{pinned}");
}

#[test]
fn a_link_too_thin_to_be_seen_has_a_sleeve_that_touches_nothing() {
    let mut model = up6().model().clone();
    model.parts[0].capsule.radius = 1e-7;
    let text = mjcf(&model, &[]);
    let sleeves: Vec<&str> = text.lines().filter(|line| line.contains("size=\"0.004\"")).collect();
    assert_eq!(sleeves.len(), 1, "{text}");
    assert!(
        !sleeves[0].contains("name=") && sleeves[0].contains("contype=\"0\" conaffinity=\"0\""),
        "{text}"
    );
}

#[test]
fn a_chapter_says_that_scenes_are_stand_ins_where_they_are() {
    let of = |note| chapter("p", &[], "c", "v", Depicted::Not("none was drawn"), note);
    assert!(of(Some("Stand-in scenes: lost.")).contains("\nStand-in scenes: lost.\n\n**"));
    assert!(!of(None).contains("Stand-in"));
}
