//! What is wrong in the files that a study names, in tables of settings and in an option of a choice is told in one round, each at its
//! own place, and nothing is said that follows from another fault alone. A file that its schema refuses is looked into no further.

use crate::paper::Bench;

/// A change of a file of a template, and what must be said of it.
pub type Change<'a> = (&'a str, &'a str, &'a str);

/// What `check` says of the template with the changes made, line by line without excerpts.
fn faults_after(template: &str, changes: &[Change<'_>]) -> Vec<String> {
    let bench = Bench::empty();
    bench.done(&["new", "toy", "--from", template]);
    for (file, from, to) in changes {
        bench.edit(&format!("toy/{file}"), from, to);
    }
    let output = bench.run(&["check", "./toy"]);
    assert_eq!(output.code, Some(2), "{}{}", output.out, output.err);
    let lines = output.err.lines().filter(|line| !line.starts_with("    "));
    let place = |line: &str| line.trim_start_matches("replan: ").trim_start_matches("./toy/").to_owned();
    lines.map(place).collect()
}

/// That exactly `wanted` is told, each line by how it begins.
pub fn assert_faults(template: &str, changes: &[Change<'_>], wanted: &[&str]) {
    let message = faults_after(template, changes);
    let fits = message.len() == wanted.len()
        && message.iter().zip(wanted).all(|(line, wanted)| line.starts_with(wanted));
    assert!(fits, "{changes:?}\nshould be told:\n{}\nis told:\n{}", wanted.join("\n"), message.join("\n"));
}

const ROBOT: Change<'_> = ("robot.toml", "upper_deg = 360", "upper_deg = -500");
const SCENE: Change<'_> = ("scene.toml", "max_mm = [800, -300, 60]", "max_mm = [300, -300, 60]");
const POSES: Change<'_> = ("poses.toml", "-120, -90, 0]", "-120, -90]");
const IN_FILES: [&str; 3] = [
    "poses.toml:5:5: `A` is an array of 5",
    "robot.toml:21:13: joint 1: upper_deg is -500",
    "scene.toml:19:11: obstacle `shelf`: `max_mm[0]` is 300",
];

#[test]
fn faults_of_a_robot_a_scene_and_poses_are_reported_together() {
    assert_faults("cell", &[ROBOT, SCENE, POSES], &IN_FILES);
}

#[test]
fn every_fault_of_one_robot_file_is_reported() {
    let capsules = ("robot.toml", "radius_mm = 75", "radius_mm = -75");
    let speeds = ("robot.toml", "speed_deg_s = ", "speed_rad_s = 1\nspeed_deg_s = ");
    let tool = ("robot.toml", "length_mm = 0", "length_mm = -5");
    let message = faults_after("cell", &[speeds, tool]);
    assert_eq!(message.len(), 2, "{message:?}");
    assert!(message.iter().any(|line| line.contains("both of speed_deg_s and speed_rad_s")), "{message:?}");
    assert!(message.iter().any(|line| line.contains("tool.length_mm is -")), "{message:?}");
    let message = self::faults_after("cell", &[capsules, SCENE]);
    assert_eq!(message.len(), 2, "{message:?}");
}

#[test]
fn a_key_too_many_and_a_key_too_few_in_one_table_are_both_reported() {
    let unknown =
        ("lengths.toml", "radius_cells = 1 }, open_node = \"lowered\"", "radius_cells = 1 }, colour = 1");
    let wanted = ["lengths.toml:37:12: missing key `open_node`", "lengths.toml:37:70: unknown key `colour`"];
    assert_faults("arm", &[unknown], &wanted);
    // What is missing in one contender is told although another's is only misspelt.
    let misspelt = ("lengths.toml", "radius_cells = 2 }, open_node", "radius_cells = 2 }, open_nodes");
    let wanted = [wanted[0], wanted[1], "lengths.toml:42:70: unknown key `open_nodes`"];
    assert_faults("arm", &[unknown, misspelt], &wanted);
}

#[test]
fn several_values_of_one_table_that_make_no_sense_are_reported_together() {
    let changes = [
        ("compare.toml", "start = [2, 2]", "start = [2, 200]"),
        ("compare.toml", "goal = [36, 30]", "goal = [360, 30]"),
        ("compare.toml", "side_cells = [2, 8]", "side_cells = [8, 2]"),
    ];
    let wanted = [
        "compare.toml:21:9: start is [2, 200]",
        "compare.toml:22:8: goal is [360, 30]",
        "compare.toml:24:14: side_cells is [8, 2]",
    ];
    assert_faults("grid", &changes, &wanted);
    // Values that are wrong by themselves are told together too.
    let negative = ("compare.toml", "start = [2, 2]", "start = [2, -2]");
    let none = ("compare.toml", "side_cells = [2, 8]", "side_cells = [0, 8]");
    let wanted = ["compare.toml:21:13: `start[1]` is -2", "compare.toml:24:15: `side_cells[0]` is 0"];
    assert_faults("grid", &[negative, none], &wanted);
}

#[test]
fn what_an_option_lays_over_settings_is_reported_at_its_own_key() {
    let of_problem = ("paper.toml", "problem = { tool_mm = 160 }", "problem = { tool_mm = -160 }");
    assert_faults("cell", &[of_problem], &["paper.toml:34:32: `tool_mm` is -160"]);
    let unknown = ("paper.toml", "problem = { tool_mm = 160 }", "problem = { tol_mm = 160 }");
    let wanted = "paper.toml:34:20: choice `tool`: option `long` sets `tol_mm`, which no problem has of a study that inherits the choice \
         (did you mean `tool_mm`?)";
    assert_faults("cell", &[unknown], &[wanted]);
    let of_stage = ("paper.toml", "ties = \"lifo\" } }", "ties = \"lilo\" } }");
    assert_faults("grid", &[of_stage], &["paper.toml:34:33: `ties` is \"lilo\""]);
    // What the option does not touch is told where it stands, once.
    let other = ("compare.toml", "settings = { weight = 2,", "settings = { weight = -2,");
    assert_faults("grid", &[other], &["compare.toml:36:23: weight is -2"]);
}

#[test]
fn a_label_without_a_name_is_reported_and_nothing_that_follows_from_it() {
    let group = ("compare.toml", "label = \"maps\"", "label = \"\"");
    assert_faults("grid", &[group], &["compare.toml:16:9: problem group `` has no letter"]);
    let contender = ("compare.toml", "label = \"A*\"", "label = \"\"");
    assert_faults("grid", &[contender], &["compare.toml:29:9: contender `` has no letter"]);
    let number = ("compare.toml", "label = \"A*\"", "label = 3");
    assert_faults("grid", &[number], &["compare.toml:29:9: `label` is 3"]);
}

#[test]
fn a_figure_of_a_pose_or_a_claim_of_a_query_that_is_not_there_is_refused() {
    let pose = ("cell.toml", "\"high/goal\", \"C\"", "\"hugh/goal\", \"C\"");
    assert_faults(
        "cell",
        &[pose],
        &["cell.toml:54:82: there is no query of cell `hugh` (did you mean `high`?); there are high, low"],
    );
    let end = ("cell.toml", "\"high/goal\", \"C\"", "\"high/end\", \"C\"");
    assert_faults("cell", &[end], &["cell.toml:54:82: `high/end` is no end of a query"]);
    let query = ("paper.toml", "problems = \"cell\", ", "problems = \"cell\", query = \"hugh\", ");
    let message = faults_after("cell", &[query]);
    assert!(message.len() == 1 && message[0].contains("there is no query of cell `hugh`"), "{message:?}");
}

/// Before what a sweep may stand in the template of grids.
const FIGURE: &str = "# A figure, drawn";

/// A sweep in the template of grids.
fn swept(key: &str, values: &str) -> String {
    format!("[[sweep]]\nkey = \"{key}\"\nstage = \"astar\"\nvalues = {values}\n\n{FIGURE}")
}

/// The template of grids with that sweep, both contenders of one weight.
fn assert_swept(key: &str, values: &str, wanted: &[&str]) {
    let sweep = swept(key, values);
    let agreed = ("compare.toml", "weight = 2", "weight = 1");
    assert_faults("grid", &[agreed, ("compare.toml", FIGURE, &sweep)], wanted);
}

#[test]
fn what_is_wrong_with_a_sweep_is_reported_there_and_once() {
    assert_swept(
        "wheight",
        "[1, 2]",
        &["compare.toml:39:7: unknown key `wheight` (did you mean `weight`?); accepted: "],
    );
    assert_swept(
        "weight",
        "[1, \"two\"]",
        &["compare.toml:41:14: `weight` is \"two\"; a number or \"falling\""],
    );
    for twice in ["[1, 2, 1]", "[1, 1.0]"] {
        assert_swept(
            "weight",
            twice,
            &["compare.toml:39:7: sweep `weight` has a value twice; each once is accepted"],
        );
    }
}

#[test]
fn a_sweep_that_would_make_two_contenders_one_is_refused() {
    let sweep = swept("weight", "[1, 2]");
    let wanted = "compare.toml:39:7: sweep `weight` would hide that contender `A*` says 1 and contender `Weighted A*` 2; ";
    assert_faults("grid", &[("compare.toml", FIGURE, &sweep)], &[wanted]);
}

#[test]
fn a_misspelt_value_is_reported_as_such_where_the_default_of_a_choice_would_hide_it() {
    let misspelt = ("compare.toml", "weight = 1, ties = \"fifo\"", "weight = 1, ties = \"fifoo\"");
    assert_faults("grid", &[misspelt], &["compare.toml:31:33: `ties` is \"fifoo\" (did you mean `fifo`?); "]);
}

#[test]
fn queries_that_records_could_not_tell_apart_are_refused() {
    let twice = ("poses.toml", "name = \"high\"", "name = \"low\"");
    let wanted = "poses.toml:15:8: query 2 is the second called `low`; one name each is accepted";
    assert_faults("cell", &[twice], &[wanted]);
}

#[test]
fn a_ratio_to_a_printed_zero_is_refused() {
    let zero = ("paper.toml", "\"60\"]", "\"0\"]");
    let saving = "table1.weighted.saving";
    let change = format!("margin = 5, printed_ratio = [\"{saving}\", \"{saving}\"]");
    let ratio = ("paper.toml", "margin = 5", change.as_str());
    let wanted =
        "paper.toml:59:106: claim `table1.weighted.saving` prints 0; a number to divide by is accepted";
    assert_faults("grid", &[zero, ratio], &[wanted]);
}

#[test]
fn what_nothing_could_speak_against_is_refused() {
    let own = ("paper.toml", "against = \"8 neighbours\"", "against = \"24 neighbours\"");
    let wanted = "paper.toml:71:91: `24 neighbours` is held against itself; another contender is accepted";
    assert_faults("arm", &[own], &[wanted]);
    let any =
        ("paper.toml", "[claim.check.on_every]", "[claim.check.share]\nhits = \"lower\"\naccepted = [0, 1]");
    let that = ("paper.toml", "that = \"lower\"\n", "");
    let wanted = "paper.toml:72:12: every share lies between 0 and 1; bounds that refuse some are accepted";
    assert_faults("arm", &[any, that], &[wanted]);
}

#[test]
fn contenders_that_are_on_both_sides_are_refused() {
    let both = (
        "paper.toml",
        "[claim.check.on_every]",
        "[claim.check.least_of]\nlower = \"24 neighbours\"\nhigher = [\"8 neighbours\", \"24 neighbours\"]",
    );
    let of = (
        "paper.toml",
        "select = { study = \"lengths\", problems = \"case 1\", contender = \"24 neighbours\", against = \"8 neighbours\", metric",
        "select = { study = \"lengths\", problems = \"case 1\", metric",
    );
    let that = ("paper.toml", "that = \"lower\"\n", "");
    let wanted = "paper.toml:72:10: `24 neighbours` is held against itself; another contender is accepted";
    assert_faults("arm", &[both, of, that], &[wanted]);
}
