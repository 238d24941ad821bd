//! Robot files: what the committed ones say, and what is refused.

use super::*;
use crate::{
    geometry::{distance_capsule_capsule, intersects_capsule_capsule},
    kinematics::{
        Joints,
        tests::{UP6_POSES, draw, radians, robot},
    },
};
use base::seed;

mod hull;
pub(in crate::kinematics) mod urdf;

const FILE: &str = include_str!("../../../../data/robots/motoman_up6.toml");

fn refusal(find: &str, put: &str) -> String {
    assert!(FILE.contains(find), "the file has no `{find}`");
    let text = FILE.replacen(find, put, 1);
    Robot::parse(&text, Path::new("up6.toml")).unwrap_err().to_string()
}

/// What is written in the file, what is put there instead, and what the refusal says.
const REFUSALS: &[(&str, &str, &str)] = &[
    (
        "a_mm = 150\n",
        "a_mm = nan\n",
        "up6.toml:20:8: `a_mm` is nan; a finite number from -100000 to 100000 is accepted",
    ),
    (
        "a_mm = 150\n",
        "a_mm = -200000\n",
        "up6.toml:20:8: `a_mm` is -200000; a number from -100000 to 100000 is accepted",
    ),
    (
        "length_mm = 150",
        "length_mm = 200000",
        "`length_mm` is 200000; a number of 100000 or less is accepted",
    ),
    ("a_mm = 150\n", "a_m = 0.15\n", "up6.toml:20:1: unknown key `a_m` (did you mean"),
    ("a_mm = 150\n", "", "missing key `a_mm` (The link's length"),
    (
        "a_mm = 150\n",
        "a_mm = \"150\"\n",
        "up6.toml:20:8: `a_mm` is \"150\"; a number from -100000 to 100000 is accepted",
    ),
    ("a_mm = 150\n", "a_mm 150\n", "up6.toml:20:"),
    (
        "lower_deg = -170",
        "lower_deg = 170",
        "up6.toml:24:13: joint 1: upper_deg is 170; accepted: more than lower_deg",
    ),
    (
        "speed_deg_s = 140",
        "speed_deg_s = 0",
        "up6.toml:25:15: joint 1: speed_deg_s is 0; accepted: more than 0",
    ),
    ("speed_deg_s = 140", "", "neither of speed_deg_s and speed_rad_s is given; accepted: exactly one"),
    ("speed_deg_s = 140", "speed_deg_s = 1\nspeed_rad_s = 1", "both of speed_deg_s and speed_rad_s"),
    (
        "alpha_deg = -90",
        "alpha_deg = -80",
        "up6.toml:19:13: joint 1: alpha_deg is -80; accepted: 90 or -90, for the solver `spherical_wrist`",
    ),
    (
        "d_mm = 0\noffset_deg = 0\nlower_deg = -135",
        "d_mm = 9\noffset_deg = 0\nlower_deg = -135",
        "joint 5: d_mm is 9; accepted: 0",
    ),
    ("\"spherical_wrist\"", "\"pieper\"", "up6.toml:6:10: solver `pieper` does not exist"),
    ("length_mm = 150", "length_mm = -1", "tool.length_mm is -1; accepted: 0 (no tool) or more"),
    (
        "length_mm = 150",
        "length_mm = inf",
        "`length_mm` is inf; a finite number of 100000 or less is accepted",
    ),
    ("length_mm = 150", "length_mm = 0", "capsule `tool_body` spans a share of the tool"),
    ("radius_mm = 150", "radius_mm = -150", "the capsule's radius is -0.15; it must be greater than 0"),
    ("link = 0", "link = 7", "capsule `base` is on link 7; accepted: 0 (base) to 6"),
    (
        "link = 0\n",
        "",
        "capsule `base` does not say where it is; accepted: link, from_mm and to_mm (and self_only), or",
    ),
    ("[0.0, 0.55]", "[0.6, 0.55]", "spans tool_share [0.6, 0.55]; accepted: two rising numbers"),
    (
        "[\"elbow\", \"base\"]",
        "[\"elbow\", \"bas\"]",
        "self_pairs names capsule `bas` (did you mean `base`?); accepted: base, turret",
    ),
    ("[\"elbow\", \"base\"]", "[\"elbow\", \"forearm\"]", "accepted: capsules on two different links"),
    ("name = \"turret\"", "name = \"base\"", "capsule `base` is given twice"),
    (
        "from_mm = [-570, 0, 0]\nto_mm = [0, 0, 0]",
        "from_mm = [-570, 500, 0]\nto_mm = [0, 500, 0]",
        "capsule `upper_arm` is 410 mm off link 2; accepted: one that reaches an axis of the link",
    ),
    (
        "name = \"motoman_up6\"\n",
        "name = \"motoman_up6\"\nconvention = \"craig\"\n",
        "`convention` is \"craig\"; \"distal\" or \"modified\" is accepted",
    ),
    (
        "\"spherical_wrist\"",
        "\"offset_wrist\"",
        "up6.toml:20:8: joint 1: a_mm is 150; accepted: 0, for the solver `offset_wrist`; `spherical_wrist` fits",
    ),
];

#[test]
fn a_file_that_cannot_be_is_refused_with_its_place_and_what_is_accepted() {
    let message = |(find, put, expected): &(&str, &str, &str)| {
        let found = refusal(find, put);
        let is_reported = found.starts_with("up6.toml:") && found.contains(expected);
        (!is_reported).then(|| format!("`{found}` has no `{expected}`"))
    };
    let missed: Vec<String> = REFUSALS.iter().filter_map(message).collect();
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

/// The file with the numbers of some keys of its joints multiplied.
fn scaled(keys: [&str; 2], by: f64) -> String {
    let joints = FILE.find("[tool]").unwrap();
    let line = |line: &str| match line.split_once(" = ") {
        Some((key, number)) if keys.contains(&key) => {
            format!("{key} = {:?}", number.parse::<f64>().unwrap() * by)
        }
        _ => line.to_owned(),
    };
    let rows: Vec<String> = FILE[..joints].lines().map(line).collect();
    rows.join("\n") + "\n" + &FILE[joints..]
}

#[test]
fn rows_in_metres_and_limits_in_radians_are_queried() {
    let message = |text: &str| Robot::parse(text, Path::new("up6.toml")).map_err(|error| error.to_string());
    let metres = message(&scaled(["a_mm", "d_mm"], 1e-3)).unwrap_err();
    let expected =
        "no link is longer than 0.64 mm; are lengths in metres? millimetres are accepted (0.64 m is 640 mm)";
    assert!(metres.starts_with("up6.toml:") && metres.contains(expected), "{metres}");
    let radians = message(&scaled(["lower_deg", "upper_deg"], 1_f64.to_radians())).unwrap_err();
    let expected = "are limits in radians? degrees are accepted (6.28";
    assert!(radians.starts_with("up6.toml:") && radians.contains(expected), "{radians}");
    let turns = message(&scaled(["alpha_deg", "offset_deg"], 1_f64.to_radians())).unwrap_err();
    let expected = "alpha_deg is -1.5707963267948966; is it in radians? degrees are accepted (-1.5707963267948966 rad is -90.0°)";
    assert!(turns.starts_with("up6.toml:") && turns.contains(expected), "{turns}");
    let tool = message(&FILE.replacen("length_mm = 150", "length_mm = 0.15", 1)).unwrap_err();
    let expected = "tool.length_mm is 0.15; is it in metres? millimetres are accepted (0.15 m is 150 mm)";
    assert!(tool.starts_with("up6.toml:") && tool.contains(expected), "{tool}");
    let slow = message(&scaled(["speed_deg_s", "speed_deg_s"], 1_f64.to_radians())).unwrap_err();
    let expected = "no joint is faster than 8.726";
    assert!(slow.starts_with("up6.toml:") && slow.contains(expected), "{slow}");
    let fast = message(&FILE.replace("speed_deg_s", "speed_rad_s")).unwrap_err();
    let expected = "speed_rad_s is 500; is it in degrees? `speed_deg_s` is accepted for those";
    assert!(fast.starts_with("up6.toml:") && fast.contains(expected), "{fast}");
    let faster = message(&FILE.replacen("speed_deg_s = 500", "speed_deg_s = 5000", 1)).unwrap_err();
    let expected = "speed_deg_s is 5000; no joint is faster than 1432; less is accepted";
    assert!(faster.starts_with("up6.toml:") && faster.contains(expected), "{faster}");
    for (key, length, doubt) in [
        ("d_mm", "d_mm = 640", "the longest d_mm of 3 is 0.64"),
        ("a_mm", "a_mm = 570", "the longest a_mm of 3 is 0.57"),
    ] {
        let column = message(&scaled([key, key], 1e-3)).unwrap_err();
        let line = FILE[..FILE.find(length).unwrap()].lines().count() + 1;
        assert!(column.starts_with(&format!("up6.toml:{line}:8: {doubt}")), "{column}");
        assert!(column.contains("; is it in metres? millimetres are accepted ("), "{column}");
    }
    let offsets = FILE.replacen(
        "d_mm = 0\noffset_deg = 0\nlower_deg = -180",
        "d_mm = 0.3\noffset_deg = 0\nlower_deg = -180",
        1,
    );
    assert!(
        offsets != FILE && message(&offsets.replacen("solver = \"spherical_wrist\"\n", "", 1)).is_ok(),
        "a calibrated arm"
    );
    let turned = |limits: &str| message(&FILE.replacen("lower_deg = -135\nupper_deg = 135", limits, 1));
    for (limits, line, doubt) in [
        ("lower_deg = -1.5708\nupper_deg = 1.5708", "up6.toml:59:13", "a limit is -1.5708"),
        ("lower_deg = -1.57\nupper_deg = 1.57", "up6.toml:59:13", "a limit is -1.57"),
        ("lower_deg = -90\nupper_deg = 1.5708", "up6.toml:60:13", "a limit is 1.5708"),
    ] {
        let turned = turned(limits).unwrap_err();
        let expected = format!("{line}: {doubt}; is it in radians? degrees are accepted");
        assert!(turned.contains(&expected), "should say {expected}\nsays {turned}");
    }
    assert!(turned("lower_deg = -1.57\nupper_deg = 90").is_ok(), "of two digits, beside one in degrees");
    let bodies = &FILE[FILE.find("[[body]]").unwrap()..];
    let thin = "[[body]]\nname = 'thin'\nself_pairs = []\n[[body.capsule]]\nname = 'arm'\nlink = 2\nfrom_mm = [-0.09465, 0, 0]\n\
        to_mm = [0, 0, 0]\nradius_mm = 0.09\n";
    let body = message(&FILE.replacen(bodies, thin, 1)).unwrap_err();
    let expected = "reaches farther than 0.09465 mm; are lengths in metres? millimetres are accepted (0.09465 m is 94.65 mm)";
    assert!(body.starts_with("up6.toml:") && body.contains(expected), "{body}");
    let wire = message(&FILE.replacen("radius_mm = 75", "radius_mm = 0.075", 1)).unwrap_err();
    let expected = ": radius_mm is 0.075; is it in metres? millimetres are accepted (0.075 m is 75 mm)";
    assert!(wire.starts_with("up6.toml:") && wire.contains(expected), "{wire}");
    let rod = message(&FILE.replacen("from_mm = [-570, 0, 0]", "from_mm = [-0.57, 0, 0]", 1)).unwrap_err();
    let expected = ": the greatest coordinate of from_mm and to_mm is 0.57; is it in metres?";
    assert!(rod.starts_with("up6.toml:") && rod.contains(expected), "{rod}");
    assert!(
        message(&scaled(["a_mm", "d_mm"], 0.1)).is_ok_and(|robot| robot.notes().is_empty()),
        "a small arm"
    );
}

#[test]
fn an_arm_has_six_joints_and_a_robot_a_body() {
    let joint = &FILE[FILE.find("[[joint]]").unwrap()..FILE.find("[tool]").unwrap()];
    let seventh = &joint[joint.rfind("[[joint]]").unwrap()..];
    assert!(refusal(seventh, &seventh.repeat(2)).contains("7 joints were given; accepted: 6"));
    assert!(refusal(seventh, "").contains("5 joints were given; accepted: 6"));
    let bodies = &FILE[FILE.find("[[body]]").unwrap()..];
    assert!(refusal(bodies, "").contains("missing key `body`"));
    let missing = Robot::load(Path::new("data/robots/none.toml")).unwrap_err().to_string();
    assert!(missing.starts_with("data/robots/none.toml: "), "{missing}");
}

#[test]
fn without_a_solver_the_most_special_one_that_fits_is_taken_and_says_why_no_other_was() {
    let message = |text: &str| Robot::parse(text, Path::new("up6.toml")).unwrap().arm().solver().to_string();
    assert_eq!(message(FILE), "inverse kinematics by `spherical_wrist`");
    let open = FILE.replace("solver = \"spherical_wrist\"\n", "");
    assert_eq!(message(&open), message(FILE));
    assert_eq!(robot("ur5").arm().solver().to_string(), "inverse kinematics by `offset_wrist`");
    assert_eq!(robot("puma560").arm().solver().to_string(), "inverse kinematics by `spherical_wrist`");
    let general = open.replacen(
        "d_mm = 0\noffset_deg = 0\nlower_deg = -135",
        "d_mm = 9\noffset_deg = 0\nlower_deg = -135",
        1,
    );
    assert_eq!(
        message(&general),
        "inverse kinematics by `numerical`, which may miss configurations; joint 1: a_mm is 150; accepted: 0, for the \
         solver `offset_wrist`; joint 5: d_mm is 9; accepted: 0, for the solver `spherical_wrist`"
    );
}

/// The UP6 by the modified convention: twists and lengths one row later, capsules in the frames at the near ends.
fn modified_up6() -> String {
    let rows: Vec<Vec<&str>> = FILE.split("[[joint]]\n").skip(1).map(|row| row.lines().collect()).collect();
    let body = &FILE[FILE.find("[tool]").unwrap()..FILE.find("[[body]]").unwrap()];
    let mut text = "name = \"up6\"\nconvention = \"modified\"\n".to_owned() + body;
    for (i, row) in rows.iter().enumerate() {
        let before = if i == 0 { vec!["alpha_deg = 0", "a_mm = 0"] } else { rows[i - 1][..2].to_vec() };
        text += &format!("[[joint]]\n{}\n{}\n", before.join("\n"), row[2..7].join("\n"));
    }
    text + "[[body]]\nname = 'capsules'\nself_pairs = []\n\
        [[body.capsule]]\nname = 'upper_arm'\nlink = 2\nfrom_mm = [0, 0, 0]\nto_mm = [570, 0, 0]\nradius_mm = 90\n\
        [[body.capsule]]\nname = 'forearm'\nlink = 3\nfrom_mm = [130, -150, 0]\nto_mm = [130, 640, 0]\nradius_mm = 75\n"
}

#[test]
fn a_robot_by_the_modified_convention_is_the_same_robot() {
    let seed = 733;
    let up6 = robot("motoman_up6");
    let text = modified_up6();
    let modified = Robot::parse(&text, Path::new("modified.toml")).unwrap();
    assert_eq!(modified.arm().solver().name, "spherical_wrist");
    let mut stream = seed::stream(seed);
    for _ in 0..100 {
        let q = draw(&mut stream, up6.arm().chain());
        assert_eq!(modified.arm().chain().flange(&q), up6.arm().chain().flange(&q));
        let frames = [&modified, &up6].map(|robot| robot.arm().chain().frames(&q));
        for (ours, name) in modified.bodies()[0].parts().iter().zip(["upper_arm", "forearm"]) {
            let theirs = up6.bodies()[0].parts().iter().find(|part| part.name() == name).unwrap();
            let [a, b] = [ours.placed(&frames[0]), theirs.placed(&frames[1])];
            let off = (a.segment.a - b.segment.a).norm().max((a.segment.b - b.segment.b).norm());
            assert!(off < 1e-12, "seed {seed}: {name} is off by {off} m at {q:?}");
        }
    }
    let refused = text
        .replacen("alpha_deg = 90\n", "alpha_deg = 80\n", 1)
        .replace("name = \"up6\"", "name = \"up6\"\nsolver = \"spherical_wrist\"");
    let refused = Robot::parse(&refused, Path::new("modified.toml")).unwrap_err().to_string();
    assert!(refused.contains("joint 5: alpha_deg is 80; accepted: 90 or -90"), "{refused}");
}

#[test]
fn millimetres_become_metres_and_degrees_radians() {
    let up6 = robot("motoman_up6");
    let aubo = robot("aubo_i10");
    let joint = up6.arm().chain().joints()[0];
    assert!((joint.a_m - 0.15).abs() < 1e-15 && (joint.d_m - 0.45).abs() < 1e-15, "{joint:?}");
    assert!((joint.lower_rad + 2.967_059_728).abs() < 1e-9, "{joint:?}");
    assert!((joint.speed_rad_s - 2.443_460_953).abs() < 1e-9, "{joint:?}");
    assert!((up6.arm().chain().joints()[5].upper_rad - std::f64::consts::TAU).abs() < 1e-15);
    assert!((aubo.arm().chain().joints()[2].speed_rad_s - 2.5656).abs() < 1e-15);
    let moved =
        up6.clone().placed(&(Frame::at(Vec3::y() * 1.5) * Frame::turned(&Vec3::z(), 450_f64.to_radians())));
    let base = moved.arm().chain().base();
    assert!((base.origin.y - 1.5).abs() < 1e-15 && (base.axis(0).y - 1.0).abs() < 1e-12, "{base:?}");
}

/// Whether a pair that the body declares is in contact.
fn hits_itself(body: &Body, robot: &Robot, q: &Joints) -> bool {
    let mut placed = Vec::new();
    body.place(&robot.arm().chain().frames(q), &mut placed);
    body.self_pairs().iter().any(|[a, b]| intersects_capsule_capsule(&placed[*a], &placed[*b]))
}

#[test]
fn robots_are_clear_of_themselves_where_papers_put_them_and_not_everywhere() {
    let seed = 731;
    let up6 = robot("motoman_up6");
    let aubo = robot("aubo_i10");
    for pose in UP6_POSES {
        assert!(!hits_itself(&up6.bodies()[0], &up6, &radians(pose.degrees)), "{}", pose.name);
    }
    for body in aubo.bodies() {
        assert!(!hits_itself(body, &aubo, &[0.0; AXES]), "{}", body.name());
    }
    let ur5 = robot("ur5");
    let puma = robot("puma560");
    assert!(!hits_itself(&ur5.bodies()[0], &ur5, &radians([0.0, -90.0, 90.0, 0.0, 0.0, 0.0])), "ur5");
    assert!(!hits_itself(&puma.bodies()[0], &puma, &radians([0.0, 90.0, -90.0, 0.0, 0.0, 0.0])), "puma560");
    let rods = [(&ur5, "rods"), (&puma, "rods")];
    for (robot, body) in [(&up6, "capsules"), (&aubo, "paper"), (&aubo, "mesh")].into_iter().chain(rods) {
        let mut stream = seed::stream(seed);
        let body = robot.body(body).unwrap();
        let drawn = (0..5_000).map(|_| draw(&mut stream, robot.arm().chain()));
        let hits = drawn.filter(|q| hits_itself(body, robot, q)).count();
        assert!((100..4_000).contains(&hits), "{}: {hits} of 5000 hit themselves", body.name());
    }
}

#[test]
fn capsules_join_where_links_do() {
    let seed = 732;
    let up6 = robot("motoman_up6");
    let aubo = robot("aubo_i10");
    let neighbours =
        [(&up6, "capsules", vec![[1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7]])].into_iter().chain([
            (&aubo, "paper", vec![[0, 1], [1, 2], [2, 3], [3, 4]]),
            (&aubo, "mesh", vec![[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6]]),
        ]);
    for (robot, body, pairs) in neighbours {
        let mut stream = seed::stream(seed);
        let body = robot.body(body).unwrap();
        let mut placed = Vec::new();
        for _ in 0..200 {
            let q = draw(&mut stream, robot.arm().chain());
            body.place(&robot.arm().chain().frames(&q), &mut placed);
            for [a, b] in &pairs {
                let gap = crate::geometry::distance_segment_segment(&placed[*a].segment, &placed[*b].segment);
                assert!(gap < 1e-12, "{}: {a} and {b} are {gap} apart at {q:?}", body.name());
            }
        }
    }
}

#[test]
fn a_longer_tool_takes_its_capsules_along_and_moves_nothing_else() {
    let up6 = robot("motoman_up6");
    let longer = up6.with_tool_length(0.25).unwrap();
    assert_eq!((up6.tool_length_m(), longer.tool_length_m()), (0.15, 0.25));
    let q = radians(UP6_POSES[3].degrees);
    let reach = |robot: &Robot| robot.arm().chain().forward(&q).origin;
    assert!(((reach(&longer) - reach(&up6)).norm() - 0.1).abs() < 1e-12);
    let target = longer.arm().chain().forward(&q);
    let (_, found) = longer.arm().inverse_nearest(&target, &q).unwrap();
    assert!(found.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
    let [before, after] = [&up6, &longer].map(|robot| robot.bodies()[0].parts().to_vec());
    assert_eq!(before[..6], after[..6]);
    let placed = after[7].placed(&longer.arm().chain().frames(&q));
    let short_m = (placed.segment.b - reach(&longer)).norm() - placed.radius;
    assert!(short_m.abs() < 1e-12, "the finger ends at {placed:?}");
    let finger = after[7].capsule();
    assert!((finger.segment.a.z - 0.1375).abs() < 1e-15 && (finger.segment.b.z - 0.235).abs() < 1e-15);
    assert!(distance_capsule_capsule(after[6].capsule(), finger) == 0.0);
    let self_only = before.iter().filter(|part| part.is_self_only()).map(Part::name);
    assert_eq!(self_only.collect::<Vec<_>>(), ["base", "turret"]);
    let none = up6.with_tool_length(0.0).unwrap_err().to_string();
    assert!(none.starts_with("capsule `tool_body` spans a share of the tool"), "{none}");
    assert!(up6.with_tool_length(f64::NAN).is_err());
}

#[test]
fn a_value_that_makes_no_sense_hides_no_fault_of_another_joint_or_capsule() {
    let text = FILE
        .replacen("lower_deg = -135", "lower_deg = 500", 1)
        .replacen("radius_mm = 150", "radius_mm = -150", 1)
        .replacen("length_mm = 150", "length_mm = -150", 1);
    let refused = Robot::parse(&text, Path::new("up6.toml")).unwrap_err().to_string();
    let lines: Vec<&str> = refused.lines().filter(|line| line.starts_with("up6.toml:")).collect();
    let parts = [
        "joint 5: upper_deg is 135; accepted: more than lower_deg",
        "tool.length_mm is -150",
        "the capsule's radius is -0.15",
    ];
    assert!(lines.len() == 3 && lines.iter().zip(parts).all(|(line, part)| line.contains(part)), "{refused}");
}

#[test]
fn a_speed_is_reported_in_the_unit_that_it_is_given_in() {
    let refused = refusal("speed_deg_s = 140", "speed_rad_s = -2");
    assert!(
        refused.starts_with("up6.toml:25:15: joint 1: speed_rad_s is -2; accepted: more than 0"),
        "{refused}"
    );
}
