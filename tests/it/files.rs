//! Files of others, from the file to the row: what is asked is what their authors mean.

use crate::paper::Bench;
use base::settings::Settings;
use std::fs;
use std::path::Path;
use study::{Inputs, family, reuse};

/// The least that a paper has.
pub const PAPER: &str =
    "[source]\ntitle = \"Files\"\nauthors = \"N. N.\"\n\n[prints]\nfigures = 0\ntables = 0\nequations = 0\n";

/// An arm of two rods that nod about y, before limits and kinds of its joints are put in.
const ROBOT: &str = r#"<?xml version="1.0"?>
<robot name="pair">
<link name="foot"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.06 0.06 0.16"/></geometry></collision></link>
<joint name="low" type="[low]"><parent link="foot"/><child link="shin"/><origin xyz="0 0 0.2"/><axis xyz="[along]"/>[limit]</joint>
<link name="shin"><collision><origin xyz="0 0 0.14"/><geometry><cylinder radius="0.03" length="0.2"/></geometry></collision></link>
<joint name="high" type="revolute"><parent link="shin"/><child link="hand"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/>
<limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
<link name="hand"><collision><origin xyz="0 0 0.14"/><geometry><sphere radius="0.04"/></geometry></collision></link>
</robot>
"#;

/// A query of the arm, by what its robot and its problem file say, and what becomes of it.
struct Arm {
    name: &'static str,
    low: &'static str,
    along: &'static str,
    limit: &'static str,
    problem: &'static str,
    /// The status, and what the row says: joint travel in degrees, or the beginning of the reason.
    row: (&'static str, Result<f64, &'static str>),
}

const NODS: &str = "0 1 0";
const TURN: &str = "<limit lower=\"-3\" upper=\"3\" velocity=\"2\"/>";
const THERE: &str = r#"{"problems": {"set": [{"start": [0.3, 0.2], "goals": [[-0.4, 0.5]]}]}}"#;

const ARMS: &[Arm] = &[
    Arm {
        name: "plain",
        low: "revolute",
        along: NODS,
        limit: TURN,
        problem: THERE,
        row: ("solved", Ok(1.0)),
    },
    // 3.1 to -3.1 rad is 0.0832 rad the shorter way round, and 6.2 the other.
    Arm {
        name: "round",
        low: "continuous",
        along: NODS,
        limit: "",
        problem: r#"{"problems": {"set": [{"start": [3.1, 0.1], "goals": [[-3.1, 0.1]]}]}}"#,
        row: ("solved", Ok(0.083_185_307_179_586_23)),
    },
    Arm {
        name: "beyond",
        low: "continuous",
        along: NODS,
        limit: "<limit effort=\"1\"/>",
        problem: r#"{"problems": {"set": [{"start": [-3.5, 0.1], "goals": [[3.3, 0.1]]}]}}"#,
        row: ("solved", Ok(0.516_814_692_820_414)),
    },
    // A slide of 0.3 m is no turn.
    Arm {
        name: "lift",
        low: "prismatic",
        along: "0 0 1",
        limit: "<limit lower=\"0\" upper=\"0.4\"/>",
        problem: r#"{"problems": {"set": [{"start": [0.05, 0.2], "goals": [[0.35, 0.5]]}]}}"#,
        row: ("solved", Ok(0.3)),
    },
    Arm {
        name: "invalid",
        low: "revolute",
        along: NODS,
        limit: TURN,
        problem: r#"{"problems": {"set": [{"valid": false, "start": [0.3, 0.2], "goals": [[-0.4, 0.5]],
                    "sphere": [{"position": [0, 0, 0.4], "radius": 0.1}]}]}}"#,
        row: ("invalid_problem", Err("the problem set calls this problem invalid")),
    },
    Arm {
        name: "by-name",
        low: "revolute",
        along: NODS,
        limit: "<limit lower=\"-0.5\" upper=\"0.5\"/>",
        problem: r#"{"robot": "pair", "joints": ["high", "low"], "problems": {"set": [{"start": [2.0, 0.3], "goals": [[1.5, 0.3]]}]}}"#,
        row: ("solved", Ok(0.5)),
    },
    Arm {
        name: "there-already",
        low: "revolute",
        along: NODS,
        limit: TURN,
        problem: r#"{"problems": {"set": [{"start": [0.3, 0.2], "goals": [[0.3, 0.2]]}]}}"#,
        row: ("solved", Ok(0.0)),
    },
];

fn joint_group(name: &str) -> String {
    format!(
        "\n[[problems]]\nlabel = \"{name}\"\nfamily = \"joint_queries\"\ninstances = 1\n[problems.settings]\nrobot = \"{name}.urdf\"\n\
         problem = \"{name}.json\"\nself_collision = true\nsamples = 30\nradius_deg = 170\nstep_deg = 4\n\
         support = {{ under = \"nothing\", why = \"a test\", base_mm = [0, 0, 0], yaw_deg = 0 }}\n"
    )
}

/// The same as a set of problems.
const SET: &str = "\n[[problems]]\nlabel = \"set\"\nfamily = \"joint_problems\"\ninstances = 1\n[problems.settings]\n\
    robot = \"arm.urdf\"\nproblems = \"arm.json\"\nself_contact = \"all\"\nstep_deg = 4\n\
    support = { under = \"nothing\", why = \"a test\", base_mm = [0, 0, 0], yaw_deg = 0 }\n";

/// A study of these groups of problems and one contender.
pub fn study(groups: &str, contender: &str) -> String {
    format!(
        "paper = \"files\"\nquestion = \"What is meant?\"\nseed = 9\n\n[budget]\nexpansions = 100_000\n{groups}\n[[contender]]\n{contender}\n"
    )
}

/// A straight shot at the goal, so that the path is the query itself.
pub const STRAIGHT: &str = "label = \"straight\"\nplanner = \"direct\"";

/// The shortest way on a roadmap.
const ON_A_ROADMAP: &str = "[[contender]]\nlabel = \"to roadmap\"\nplanner = \"roadmap_astar\"\n\
    settings = { samples = 30, neighbour_mm = 500, cost = \"length\", goal_shot = \"never\", path = \"parents\" }";

#[test]
fn joints_move_as_their_urdf_file_means_and_go_where_the_problem_file_names_them() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    let mut groups = String::new();
    for arm in ARMS {
        let robot =
            ROBOT.replace("[low]", arm.low).replace("[along]", arm.along).replace("[limit]", arm.limit);
        bench.write(&format!("files/{}.urdf", arm.name), robot.as_bytes());
        // Whether the file begins with a byte-order mark changes nothing.
        let mark = if arm.low == "revolute" { "\u{feff}" } else { "" };
        bench.write(&format!("files/{}.json", arm.name), format!("{mark}{}", arm.problem).as_bytes());
        groups += &joint_group(arm.name);
    }
    bench.write("files/arms.toml", study(&groups, &format!("{STRAIGHT}\n{ON_A_ROADMAP}")).as_bytes());
    let output = bench.done(&["check", "./files"]);
    assert!(
        output.contains("invalid.json: the set calls problem 0 invalid; it is counted as such"),
        "{output}"
    );
    bench.done(&["run", "./files"]);
    let (_, records) = reuse::stored(&bench.at("target/replan/files/data/runs/files"), "arms").unwrap();
    for arm in ARMS {
        let mut rows = records.batch.rows.iter().filter(|row| *row.key.on.group == *arm.name);
        let [row, mapped] = [rows.next().unwrap(), rows.next().unwrap()];
        let reason = row.reason.clone().unwrap_or_default();
        assert_eq!(row.status.name(), arm.row.0, "{}: {reason}", arm.name);
        assert_eq!(mapped.status.name(), arm.row.0, "{}: {:?}", arm.name, mapped.reason);
        match arm.row.1 {
            Ok(turned_rad) => {
                let [travel_deg, longer_deg] =
                    [row, mapped].map(|row| row.value("joint_travel_deg").unwrap());
                assert!((travel_deg - turned_rad.to_degrees()).abs() < 1e-9, "{}: {travel_deg}", arm.name);
                // A roadmap takes no way that is shorter, and none the other way round.
                let most = if arm.low == "continuous" { 180.0 } else { 720.0 };
                assert!((travel_deg - 1e-9..most).contains(&longer_deg), "{}: {longer_deg}", arm.name);
            }
            Err(output) => assert!(reason.starts_with(output), "{}: {reason}", arm.name),
        }
    }
}

#[test]
fn a_study_says_that_problems_call_its_robot_otherwise_and_names_problems_that_are_refused() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    let robot = ROBOT.replace("[low]", "revolute").replace("[along]", NODS).replace("[limit]", TURN);
    bench.write("files/arm.urdf", robot.as_bytes());
    bench.write("files/arm.json", THERE.replacen('{', "{\"robot\": \"double\", ", 1).as_bytes());
    let one = joint_group("arm");
    let written = |groups: &str| {
        let named = groups.replace("robot = \"arm.urdf\"", "robot = \"arm.urdf\"\nrobot_name = \"double\"");
        [study(groups, STRAIGHT), study(&named, STRAIGHT)]
    };
    let [as_it_is, named] = written(&one);
    bench.write("files/arms.toml", as_it_is.as_bytes());
    let output = bench.run(&["check", "./files"]);
    let expected =
        "the problems are for the robot `double`; `pair` is accepted (a study says by `robot_name`";
    assert!(output.code == Some(2) && output.err.contains(expected), "{}", output.err);
    let note = "arm.json: its robot `double` is taken as `pair` of the URDF file, as `robot_name` says";
    bench.write("files/arms.toml", named.as_bytes());
    let output = bench.done(&["check", "./files"]);
    assert!(output.contains(note), "{output}");
    let [as_it_is, named] = written(SET);
    bench.write("files/arms.toml", as_it_is.as_bytes());
    let output = bench.done(&["check", "./files"]);
    let refused = "arm.json: refused problems, which count as invalid: 1 of 1; the first: ";
    assert!(output.contains(refused) && output.contains("for the robot `double`"), "{output}");
    bench.write("files/arms.toml", named.as_bytes());
    let output = bench.done(&["check", "./files"]);
    assert!(output.contains(note) && !output.contains("refused"), "{output}");
    bench.write("files/arm.json", THERE.as_bytes());
    for groups in [&one, SET] {
        bench.write("files/arms.toml", written(groups)[1].as_bytes());
        let output = bench.done(&["check", "./files"]);
        let note = "arm.json: it names no robot, so `robot_name` is not used";
        assert!(output.contains(note) && !output.contains("taken as"), "{output}");
    }
}

#[test]
fn check_names_starts_and_goals_beyond_the_limits_of_a_joint() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    let robot = ROBOT.replace("[low]", "revolute").replace("[along]", NODS).replace("[limit]", TURN);
    bench.write("files/arm.urdf", robot.as_bytes());
    let beyond = THERE.replace("-0.4", "-3.25");
    bench.write("files/arm.json", beyond.as_bytes());
    bench.write("files/arms.toml", study(&joint_group("arm"), STRAIGHT).as_bytes());
    let expected = "arm.json:1:55: the goal cannot be posed: joint `low` is at -3.25 rad, outside -3 to 3";
    let output = bench.run(&["check", "./files"]);
    assert!(output.code == Some(2) && output.err.contains(expected), "{}", output.err);
    bench.write("files/arms.toml", study(SET, STRAIGHT).as_bytes());
    let output = bench.done(&["check", "./files"]);
    let refused = "arm.json: refused problems, which count as invalid: 1 of 1; the first: ";
    assert!(output.contains(refused) && output.contains(expected), "{output}");
    bench.done(&["run", "./files"]);
    let (_, records) = reuse::stored(&bench.at("target/replan/files/data/runs/files"), "arms").unwrap();
    assert_eq!(records.batch.rows[0].status.name(), "invalid_problem");
}

#[test]
fn a_page_shows_a_slide_as_its_length_and_a_whole_turn_of_an_endless_joint_as_nothing() {
    let bench = Bench::empty();
    let tip_mm = |name: &str, q: [f64; 2]| {
        let arm = ARMS.iter().find(|arm| arm.name == name).unwrap();
        let robot =
            ROBOT.replace("[low]", arm.low).replace("[along]", arm.along).replace("[limit]", arm.limit);
        bench.write("arm.urdf", robot.as_bytes());
        bench.write("arm.json", arm.problem.as_bytes());
        let group: toml::Table = toml::from_str(&joint_group("arm")).unwrap();
        let settings = group["problems"][0]["settings"].as_table().unwrap().clone();
        let inputs = Inputs::below(vec![bench.at("")]);
        let build = family::find("joint_queries").unwrap().build;
        let family = build(&Settings::composed("an arm", settings), &inputs).unwrap();
        family.stance(&q).unwrap().tip_mm
    };
    let is_so = |[x, y, z]: [f64; 3], wanted: [f64; 3]| {
        libm::hypot(libm::hypot(x - wanted[0], y - wanted[1]), z - wanted[2]) < 1e-9
    };
    let [x, y, z] = tip_mm("lift", [0.05, 0.2]);
    assert!(is_so(tip_mm("lift", [0.35, 0.2]), [x, y, z + 300.0]));
    assert!(is_so(tip_mm("round", [3.1, 0.1]), tip_mm("round", [3.1 - std::f64::consts::TAU, 0.1])));
    assert!(!is_so(tip_mm("round", [3.1, 0.1]), tip_mm("round", [-3.1, 0.1])));
}

#[test]
fn an_srdf_file_decides_which_links_are_held_against_each_other() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    let robot = ROBOT.replace("[low]", "revolute").replace("[along]", NODS).replace("[limit]", TURN);
    bench.write("files/fold.urdf", robot.as_bytes());
    // Folded, so that the hand is in the foot; shin and hand, which a joint joins, are apart.
    let problem = r#"{"problems": {"set": [{"start": [0.0, 0.0], "goals": [[2.6, 2.4]]}]}}"#;
    bench.write("files/fold.json", problem.as_bytes());
    let group = joint_group("fold").replace("self_collision", "srdf = \"fold.srdf\"\nself_collision");
    bench.write("files/arms.toml", study(&group, STRAIGHT).as_bytes());
    let srdf = |pairs: &[[&str; 2]]| {
        let pair = |[a, b]: &[&str; 2]| format!("<disable_collisions link1=\"{a}\" link2=\"{b}\"/>");
        let pairs: String = pairs.iter().map(pair).collect();
        bench.write("files/fold.srdf", format!("<robot name=\"pair\">{pairs}</robot>").as_bytes());
    };
    srdf(&[["foot", "shin"], ["shin", "hand"]]);
    let refused = bench.run(&["check", "./files"]).err;
    let expected = "the goal cannot be posed: parts `foot` and `hand` are in contact";
    assert!(refused.contains(expected), "should say {expected}\nsays {refused}");
    srdf(&[["foot", "shin"], ["hand", "foot"], ["tail", "foot"]]);
    let expected = bench.done(&["check", "./files"]);
    assert!(expected.contains("fold.srdf: no solid stands for the links `tail` of its pairs"), "{expected}");
    bench.edit("files/arms.toml", "self_collision = true", "self_collision = false");
    let refused = bench.run(&["check", "./files"]).err;
    assert!(refused.contains("srdf says which links may touch, and self_collision is false"), "{refused}");
}

/// Groups of queries whose goal is their start, one a family that is given both.
const HERE: &str = r#"
[[problems]]
label = "map"
family = "grid_map"
settings = { map = "room.map.txt", start = [0, 0], goal = [0, 0], corner_rule = "allow" }

[[problems]]
label = "benchmark"
family = "movingai"
settings = { map = "room.map", scenarios = "room.scen" }

[[problems]]
label = "drawn"
family = "random_cells"
instances = 2
settings = { size_cells = [8, 8], blocked_share = 0.2, start = [3, 3], goal = [3, 3], corner_rule = "allow" }
"#;

#[test]
fn a_goal_that_is_the_start_and_one_without_a_way_are_queries_like_any_other_in_every_family() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    bench.write("files/room.map.txt", "\u{feff}.#.\r\n.#.\r\n".as_bytes());
    bench.write(
        "files/room.map",
        "\u{feff}type octile\r\nheight 2\r\nwidth 3\r\nmap\r\n.@.\r\n.@.\r\n".as_bytes(),
    );
    let scenarios =
        "\u{feff}version 1\n0\troom.map\t3\t2\t0\t0\t0\t0\t0\n0\troom.map\t3\t2\t0\t0\t2\t0\t-1\n";
    bench.write("files/room.scen", scenarios.as_bytes());
    bench.write(
        "files/grids.toml",
        study(HERE, "label = \"A*\"\nplanner = \"astar\"\nsettings = { weight = 1 }").as_bytes(),
    );
    let output = bench.done(&["check", "./files"]);
    assert!(output.contains("room.scen: 1 of its queries have no path, it says"), "{output}");
    assert!(output.contains("room.scen: ignored keys: `bucket`; docs/FILES.md has the reasons"), "{output}");
    bench.done(&["run", "./files"]);
    let (_, records) = reuse::stored(&bench.at("target/replan/files/data/runs/files"), "grids").unwrap();
    let rows = records.batch.rows;
    assert_eq!(rows.len(), 5);
    for row in &rows {
        if row.key.query.as_deref() == Some("line-3") {
            assert_eq!(
                (row.status.name(), row.value("printed_optimal_cells")),
                ("no_path", None),
                "{:?}",
                row.reason
            );
            continue;
        }
        assert_eq!(row.status.name(), "solved", "{:?}: {:?}", row.key, row.reason);
        for column in ["path_cost_cells", "turn_exterior_deg"] {
            let bits = row.value(column).map(f64::to_bits);
            assert_eq!(bits, Some(0), "{column} of {:?}: 0, not -0", row.key);
        }
    }
}

/// A lake and a wall; below it, blank lines.
const LAKE: &str = "type octile\r\nheight 3\r\nwidth 5\r\nmap\r\n.WWW.\r\n.@T@.\r\n.....\r\n\r\n\r\n";

/// Ends in the wall and in the lake, a tab behind the last field, and a way round.
const ON_THE_LAKE: &str = "version 1.0\n0\tlake.map\t5\t3\t1\t1\t4\t0\t0\n0\tlake.map\t5\t3\t1\t0\t2\t0\t1.00000000\n\
    0\tlake.map\t5\t3\t0\t0\t4\t0\t8.00000000\t\n";

/// A map in text, its ends, the corner rule, and the square of the shortest path's length at any angle, if there is a path.
type Small = (&'static str, &'static str, &'static str, &'static str, Option<f64>);

/// A diagonal between walls.
const SLIT: &str = "###.\n##.#\n#.##\n.###\n";

/// Two cells alone, the diagonal under two rules, and a straight line close to blocked cells.
const SMALL: [Small; 4] = [
    ("two", "..\n", "start = [0, 0], goal = [1, 0]", "forbid_any", Some(1.0)),
    ("slit", SLIT, "start = [0, 0], goal = [3, 3]", "allow", Some(18.0)),
    ("shut", SLIT, "start = [0, 0], goal = [3, 3]", "forbid_both", None),
    (
        "past",
        "...#..\n..#...\n.#..#.\n#..#..\n..#...\n",
        "start = [0, 0], goal = [5, 4]",
        "allow",
        Some(41.0),
    ),
];

/// Planners that go from cell to cell, and Theta* with every line of sight.
const PLANNERS: &str = r#"label = "astar"
planner = "astar"
settings = { weight = 1, ties = "fifo" }
[[contender]]
label = "octile"
planner = "astar_octile"
[[contender]]
label = "jps"
planner = "jps"
[[contender]]
label = "jps+"
planner = "jps_plus"
[[contender]]
label = "both ways"
planner = "bidirectional"
settings = { meeting = "optimal_stop", side = "alternate", weight = "one" }
[[contender]]
label = "theta"
planner = "theta_star"
settings = { line_of_sight = "exact_interior" }
[[contender]]
label = "lazy theta"
planner = "lazy_theta_star"
settings = { line_of_sight = "exact_interior" }
[[contender]]
label = "careful theta"
planner = "theta_star"
settings = { line_of_sight = "closed_cells" }
[[contender]]
label = "careless theta"
planner = "theta_star"
settings = { line_of_sight = "bresenham" }
"#;

#[test]
fn small_maps_by_hand_have_the_costs_that_can_be_counted_on_them_for_every_planner() {
    let bench = Bench::empty();
    bench.write("files/paper.toml", PAPER.as_bytes());
    bench.write("files/lake.map", LAKE.as_bytes());
    bench.write("files/lake.scen", ON_THE_LAKE.as_bytes());
    let mut groups = "\n[[problems]]\nlabel = \"lake\"\nfamily = \"movingai\"\nsettings = { map = \"lake.map\", scenarios = \"lake.scen\" }\n".to_owned();
    for (name, map, ends, rule, _) in SMALL {
        bench.write(&format!("files/{name}.map.txt"), map.as_bytes());
        groups += &format!(
            "\n[[problems]]\nlabel = \"{name}\"\nfamily = \"grid_map\"\nsettings = {{ map = \"{name}.map.txt\", {ends}, corner_rule = \"{rule}\" }}\n"
        );
    }
    // A spec as an editor of another system writes it.
    let spec = study(&groups, PLANNERS).replace('\n', "\r\n");
    bench.write("files/grids.toml", format!("\u{feff}{spec}").as_bytes());
    bench.done(&["run", "./files"]);
    let (_, records) = reuse::stored(&bench.at("target/replan/files/data/runs/files"), "grids").unwrap();
    let rows = &records.batch.rows;
    assert_eq!(rows.len(), 9 * (3 + SMALL.len()));
    for row in rows {
        let reason = row.reason.as_deref().unwrap_or_default();
        let small = SMALL.iter().find(|small| *small.0 == *row.key.on.group);
        let squared = match (small, row.key.query.as_deref()) {
            (Some((.., squared)), _) => *squared,
            (None, Some("line-4")) => Some(64.0),
            (None, _) => {
                assert_eq!(row.status.name(), "invalid_problem", "{:?}: {reason}", row.key);
                assert!(reason.contains("is blocked"), "{reason}");
                continue;
            }
        };
        let status = if squared.is_some() { "solved" } else { "no_path" };
        assert_eq!(row.status.name(), status, "{:?}: {reason}", row.key);
        let Some(straight) = squared.map(f64::sqrt) else { continue };
        // Four diagonal moves and a straight one, where a planner knows no other; lines of sight in cells may see less.
        let by_moves = if *row.key.on.group == *"past" { 4.0 * 2_f64.sqrt() + 1.0 } else { straight };
        let [least, most] = match &*row.key.contender {
            "theta" | "lazy theta" => [straight; 2],
            "careful theta" | "careless theta" => [straight, by_moves],
            _ => [by_moves; 2],
        };
        let cost = row.value("path_cost_cells").unwrap();
        assert!((least - 1e-9..most + 1e-9).contains(&cost), "{:?}: {cost}, not {least} to {most}", row.key);
    }
}

#[test]
fn the_page_of_files_shows_every_key_that_is_passed_over() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/FILES.md")).unwrap();
    let table: Vec<&str> = page.lines().filter(|line| line.starts_with("| ")).collect();
    let rows = base::ignored::IGNORED;
    let rows: Vec<String> =
        rows.iter().map(|row| format!("| {} | `{}` | {} |", row.format, row.key, row.why)).collect();
    let start = table.iter().position(|line| *line == "| format | key | why |").unwrap();
    assert_eq!(table[start + 1..], rows, "docs/FILES.md should hold\n{}", rows.join("\n"));
}

/// How many lines of a file have `{:?}` and make no message: text that is hashed or compared, lists of numbers, code for tests alone.
const NO_MESSAGES: &[(&str, usize)] = &[
    ("analysis/across/glance.rs", 1),
    ("analysis/citation.rs", 1),
    ("analysis/claim_test.rs", 2),
    ("analysis/claims.rs", 2),
    ("analysis/criterion/exists.rs", 1),
    ("analysis/criterion/exists/differs.rs", 1),
    ("analysis/criterion/mod.rs", 1),
    ("analysis/meaning.rs", 4),
    ("analysis/polylines.rs", 1),
    ("audit/checks/any_angle_turns.rs", 1),
    ("audit/checks/grim.rs", 1),
    ("audit/checks/turn_sum.rs", 1),
    ("audit/report.rs", 1),
    ("base/text.rs", 1),
    ("engine/planner/mirrors.rs", 2),
    ("proofs/proof/counts.rs", 1),
    ("proofs/proof/lengths.rs", 6),
    ("proofs/proof/turns.rs", 3),
    ("study/choice.rs", 1),
    ("study/explore.rs", 9),
    ("study/family/conditioned.rs", 2),
    ("study/manifest.rs", 2),
    ("study/manifest/hashes.rs", 8),
    ("study/plan.rs", 1),
    ("verify/arm/depth.rs", 3),
];

#[test]
fn no_message_shows_values_as_rust_debugs_them() {
    let mut found = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for file in crate::source::files() {
        let path = file.path.to_str().unwrap();
        if path.contains("tests") {
            continue;
        }
        let text = fs::read_to_string(root.join(&file.path)).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let shown: Vec<String> = (1..)
            .zip(code.lines())
            .filter(|(_, line)| line.contains("?}"))
            .map(|(number, line)| format!("{path}:{number}: {}", line.trim()))
            .collect();
        let known = NO_MESSAGES.iter().find(|(known, _)| *known == path).map_or(0, |(_, count)| *count);
        if shown.len() != known {
            found.push(format!("{path} has {} lines, not {known}:\n{}", shown.len(), shown.join("\n")));
        }
    }
    assert_eq!(found, [""; 0], "\n{}", found.join("\n"));
}
