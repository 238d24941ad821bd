//! Each fault of a file stands at the line and column of its own key or value, and one fault is told once, alone.

use crate::hidden_faults::{Change, assert_faults};
use crate::paper::Bench;

/// That the template with one change is told to be wrong in one place.
fn assert_alone(template: &str, change: Change<'_>, wanted: &str) {
    assert_faults(template, &[change], &[wanted]);
}

#[test]
fn a_number_that_is_none_is_reported_where_it_is_printed() {
    for (written, shown) in [("1e400", "1e400"), ("nan", "nan"), ("inf", "inf")] {
        let change = format!("printed = [\"50.9\", \"{written}\"]");
        let wanted =
            format!("paper.toml:71:20: claim `table1.weighted.saving`: `{shown}` is not a printed number");
        assert_alone("grid", ("paper.toml", "printed = [\"50.9\", \"60\"]", &change), &wanted);
    }
}

#[test]
fn a_misspelt_criterion_is_reported_at_its_name() {
    let header = ("paper.toml", "[claim.check.lower]", "[claim.check.lowr]");
    let wanted = "claim `fewer_nodes`: there is no criterion `lowr` (did you mean `lower`?)";
    assert_alone("grid", header, &format!("paper.toml:82:14: {wanted}"));
    let shown = ("paper.toml", "[claim.check.lower]", "[[claim.shows.lowr]]");
    assert_faults("grid", &[shown], &[&format!("paper.toml:82:15: {wanted}")]);
    let inline = (
        "paper.toml",
        "[claim.check.lower]\nselect = { study = \"compare\", problems = \"maps\", contender = \"Weighted A*\", against = \"A*\", \
         metric = \"opened\" }",
        "check.lowr = { select = { study = \"compare\", problems = \"maps\", contender = \"Weighted A*\", against = \"A*\", \
         metric = \"opened\" } }",
    );
    assert_alone("grid", inline, &format!("paper.toml:82:7: {wanted}"));
}

#[test]
fn what_follows_from_a_fault_of_a_claim_is_not_reported() {
    let bound = ("paper.toml", "bound = 1.1", "bound = inf");
    assert_alone("grid", bound, "paper.toml:93:9: `bound` is inf; a finite number is accepted");
    let number = ("paper.toml", "printed = [\"50.2\"", "printed = [50.2");
    assert_alone("grid", number, "paper.toml:65:12: `printed[0]` is 50.2; text in quotes is accepted");
    let metric = ("paper.toml", "against = \"A*\", metric = \"opened\"", "against = \"A*\", metric = 5");
    assert_alone("grid", metric, "paper.toml:83:102: `metric` is 5; text in quotes is accepted");
}

#[test]
fn what_bears_a_name_that_cannot_be_read_is_missed_nowhere() {
    let claim = ("paper.toml", "id = \"fewer_nodes\"", "id = 5");
    assert_alone("grid", claim, "paper.toml:78:6: `id` is 5; text in quotes is accepted");
    let table = ("paper.toml", "id = \"table1\"", "id = 5");
    assert_alone("grid", table, "paper.toml:40:6: `id` is 5; text in quotes is accepted");
    let capsule = ("robot.toml", "name = \"forearm\"", "name = 5");
    assert_alone("cell", capsule, "robot.toml:122:8: `name` is 5; text in quotes is accepted");
}

#[test]
fn a_figure_called_like_another_is_reported_once() {
    let from = "id = \"maps\"";
    let text = "id = \"maps\"\nkind = \"grid_search\"\ncaption = \"c\"\n";
    let settings = "settings = { problems = [\"maps\"], contenders = [\"A*\"] }\n";
    let shows = "shows = [{ problems = \"maps\", instances = 1 }]\n";
    let twice = format!("{text}{settings}{shows}[[figure]]\n{from}");
    let wanted = "compare.toml:46:6: another figure or table of the paper is called `maps` already";
    assert_alone("grid", ("compare.toml", from, &twice), wanted);
}

#[test]
fn nothing_is_reported_of_the_contents_of_a_study_that_is_no_toml() {
    for (template, file) in [("grid", "compare.toml"), ("arm", "lengths.toml"), ("cell", "cell.toml")] {
        assert_alone(template, (file, "seed = 1", "seed = = 1"), &format!("{file}:8:8: "));
    }
    // What it does not say anywhere is told.
    let other = ("paper.toml", "\"maps\"]", "\"mapps\"]");
    let wanted = ["compare.toml:8:8: ", "paper.toml:19:22: there is no figure or table `mapps`"];
    assert_faults("grid", &[("compare.toml", "seed = 1", "seed = = 1"), other], &wanted);
}

#[test]
fn a_number_too_large_is_reported_once_with_its_limit() {
    let weight = ("compare.toml", "weight = 2", "weight = 1e308");
    assert_alone(
        "grid",
        weight,
        "compare.toml:36:23: `weight` is 1e308; a number from -1e9 to 1e9 is accepted",
    );
    let margin = ("paper.toml", "margin = 5", "margin = 1e308");
    assert_alone("grid", margin, "paper.toml:59:60: `margin` is 1e308; a number from 0 to 1e9 is accepted");
    // Whatever it is written like.
    let written = ("compare.toml", "weight = 2", "weight = -1_500.50");
    assert_alone("grid", written, "compare.toml:36:23: weight is -1500.5; 0 (Dijkstra)");
}

#[test]
fn a_value_out_of_range_hides_no_fault_of_another_table() {
    let changes = [
        ("compare.toml", "weight = 2", "weight = 1e308"),
        ("compare.toml", "weight = 1,", "weight = -1,"),
        ("compare.toml", "goal = [36, 30]", "goal = [46, 30]"),
        ("paper.toml", "\"50.9\", \"60\"", "\"50.9\", \"nan\""),
    ];
    let wanted = [
        "compare.toml:22:8: goal is [46, 30]",
        "compare.toml:31:23: weight is -1",
        "compare.toml:36:23: `weight` is 1e308",
        "paper.toml:71:20: claim `table1.weighted.saving`: `nan`",
    ];
    assert_faults("grid", &changes, &wanted);
}

#[test]
fn a_fault_of_the_first_claim_hides_none_of_the_second() {
    let second = ("paper.toml", "metric = \"path_cost_cells\" }\nthat", "metric = \"path_cost\" }\nthat");
    let first = (
        "paper.toml",
        "problems = \"maps\", contender = \"Weighted A*\"",
        "problems = \"maps\", contender = \"WA\"",
    );
    let wanted = ["paper.toml:83:62: study `compare` has no contender `WA`", "paper.toml:91:"];
    assert_faults("grid", &[first, second], &wanted);
}

#[test]
fn ids_that_would_break_tables_and_links_are_refused() {
    for id in ["", "a|b", "a*", "`a`", "a b", "a\\nb", "ä", "a\\\\b", "50%"] {
        let change = format!("id = \"{id}\"");
        let is_one_line = !id.contains("\\n");
        let wanted = if is_one_line { "the claim is called \"" } else { "`id` holds a control character" };
        let wanted = &format!("paper.toml:78:6: {wanted}");
        assert_alone("grid", ("paper.toml", "id = \"fewer_nodes\"", &change), wanted);
    }
    let figure = ("compare.toml", "id = \"maps\"", "id = \"ma|ps\"");
    assert_alone("grid", figure, "compare.toml:40:6: the id `ma|ps` names files");
}

#[test]
fn a_study_is_a_file_of_a_plain_name() {
    let bench = Bench::empty();
    bench.done(&["new", "toy", "--from", "grid"]);
    std::fs::rename(bench.at("toy/compare.toml"), bench.at("toy/com pare.toml")).unwrap();
    let output = bench.run(&["check", "./toy"]);
    let lines: Vec<&str> = output.err.lines().filter(|line| !line.starts_with("    ")).collect();
    assert!(
        lines.len() == 1 && lines[0].contains("com pare.toml:1:1: the study is called \"com pare\""),
        "{lines:?}"
    );
}

#[test]
fn files_of_other_tools_are_left_alone() {
    let bench = Bench::empty();
    bench.done(&["new", "toy", "--from", "cell"]);
    for (name, text) in [
        ("pyproject", "[project]\nname = 'a'\n[tool.ruff]\nline-length = 9\n"),
        ("only_tool", "[tool.black]\nline-length = 9\n"),
        ("only_name", "name = 'a'\nnote = 'b'\n"),
        ("source", "name = 'a'\nsource = 'b'\n"),
    ] {
        bench.write(&format!("toy/{name}.toml"), text.as_bytes());
    }
    let output = bench.done(&["check", "./toy"]);
    for name in ["pyproject", "only_tool", "only_name", "source"] {
        assert!(output.contains(&format!("{name}.toml is taken for a file of something else")), "{output}");
    }
}

#[test]
fn a_robot_that_no_study_names_is_checked_as_one() {
    let bench = Bench::empty();
    bench.done(&["new", "toy", "--from", "cell"]);
    for (from, to, wanted) in [
        ("[tool]", "[tol]", "unknown key `tol` (did you mean `tool`?)"),
        ("[[body]]", "[[bodies]]", "unknown key `bodies`"),
        ("name = \"ur5\"", "nome = \"ur5\"", "unknown key `nome`"),
        ("lower_deg = -360\n", "", "missing key `lower_deg`"),
    ] {
        let text = std::fs::read_to_string(bench.at("toy/robot.toml")).unwrap();
        assert!(text.contains(from), "{from}");
        bench.write("toy/spare.toml", text.replacen(from, to, 1).as_bytes());
        let output = bench.run(&["check", "./toy"]).err;
        assert!(
            output.contains("spare.toml:") && output.contains("but a robot: ") && output.contains(wanted),
            "{output}"
        );
    }
}
