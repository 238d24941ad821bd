//! Sweeps over settings of problems: keys, seeds, what runs again, and what is refused.

use crate::paper::Bench;
use study::key::SweepValue;
use study::record::{Batch, PreprocessingRow, Row};
use study::reuse::stored;

const PAPER: &str = r#"[source]
title = "A tiny paper"
authors = "N. N."
[[inventory]]
item = "section 1"
says = "it solves more"
claims = ["more", "cost"]
figures = ["share"]
[[claim]]
id = "more"
at = "section 1"
says = "A* solves more on maps of every share"
[claim.check.lower]
select = { study = "study", problems = "maps", contender = "A*", against = "JPS" }
is = "higher"
[[claim]]
id = "cost"
at = "section 1"
printed = "10.0"
unit = "cells"
[claim.check.within]
select = { study = "study", problems = "maps", contender = "A*", metric = "path_cost_cells", sweep = "blocked_share=0.4" }
statistic = "mean"
margin = 1
"#;

/// A study of two queries on maps of several shares of blocked cells, of a group that is not swept, and of one swept otherwise.
const STUDY: &str = r#"paper = "mini"
question = "What does the share of blocked cells do?"
seed = 3
[budget]
expansions = 10_000
[[problems]]
label = "maps"
family = "random_cells"
instances = 6
settings = { size_cells = 14, start = "drawn", goal = { x = 13 }, queries = 2, corner_rule = "forbid_any" }
[[problems]]
label = "plain"
family = "random_cells"
instances = 3
settings = { size_cells = 14, start = [0, 0], goal = [13, 13], blocked_share = 0.3, corner_rule = "forbid_any" }
[[problems]]
label = "rectangles"
family = "random_rectangles"
instances = 3
settings = { start = "drawn", goal = "drawn", count = 4, side_cells = [2, 4], corner_rule = "forbid_any" }
[[sweep]]
key = "blocked_share"
problems = ["maps"]
values = [0.2, 0.4]
[[sweep]]
key = "size_cells"
problems = ["rect*"]
values = [12, 20]
[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 1, ties = "fifo" }
[[contender]]
label = "JPS"
planner = "jps"
[[keep]]
problems = "maps"
instances = 1
[[figure]]
id = "share"
kind = "statistics"
caption = "Solved queries over the share of blocked cells."
settings = { panels = [{ x = "blocked_share", y = "solved", axis = "share of blocked cells", problems = ["maps"], contenders = ["A*"] }] }
"#;

fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("mini/paper.toml", PAPER.as_bytes());
    bench.write("mini/study.toml", STUDY.as_bytes());
    bench
}

/// The records of a run into `out`, with `arguments` besides.
fn run(bench: &Bench, out: &str, arguments: &[&str]) -> Batch {
    bench.done(&[&["run", "./mini", "--out", out], arguments].concat());
    stored(&bench.at(&format!("{out}/data/runs/mini")), "study").unwrap().1.batch
}

/// The value of the sweep over `setting`, as trials name it.
fn at(row: &Row, setting: &str) -> Option<f64> {
    row.key.sweep.value(setting).and_then(SweepValue::as_f64)
}

#[test]
fn a_sweep_over_problems_has_a_typed_column_that_is_null_on_other_groups() {
    let bench = bench();
    let batch = run(&bench, "one", &[]);
    assert_eq!(batch.rows.len(), 2 * 2 * (6 * 2) + 2 * 3 + 2 * 2 * 3);
    for row in &batch.rows {
        let share = at(row, "blocked_share");
        let size = at(row, "size_cells");
        let group = &*row.key.on.group;
        assert_eq!((share.is_some(), size.is_some()), (group == "maps", group == "rectangles"), "{group}");
        assert_eq!(row.key.on.sweep, row.key.sweep, "no sweep here is over a contender");
    }
    let cells = |row: &PreprocessingRow| row.values.get("free_cells").unwrap().as_f64();
    let of = |share: f64| {
        let is_own =
            |row: &&PreprocessingRow| row.key.sweep.value("blocked_share") == Some(&SweepValue::Real(share));
        batch.preprocessing.iter().filter(is_own).map(cells).sum::<f64>() / 6.0
    };
    assert!(
        (of(0.2) - 0.8 * 196.0).abs() < 20.0 && (of(0.4) - 0.6 * 196.0).abs() < 20.0,
        "{} {}",
        of(0.2),
        of(0.4)
    );
    bench.done(&["repro", "./mini"]);
    let shown = bench.done(&["show", "./mini", "more"]);
    assert!(shown.contains("at blocked_share=0."), "the claim along the sweep: {shown}");
    let trial = "study/maps/blocked_share=0.4/3/2/jps";
    assert!(bench.done(&["repro", "./mini", "--trial", trial]).contains("equals the stored row"));
}

#[test]
fn a_sweep_over_problems_gives_equal_bytes_at_any_number_of_threads_and_in_shards() {
    let bench = bench();
    run(&bench, "one", &["--threads", "1"]);
    run(&bench, "eight", &["--threads", "8"]);
    for number in ["1/2", "2/2"] {
        bench.done(&["run", "./mini", "--shard", number, "--out", "parts"]);
    }
    bench.done(&["merge", "parts", "--out", "merged"]);
    let one = bench.facts("one");
    assert_eq!(one.len(), 3, "{:?}", one.keys());
    assert!(one == bench.facts("eight") && one == bench.facts("merged"));
}

#[test]
fn another_value_of_a_sweep_runs_alone_and_changes_no_other_row() {
    let bench = bench();
    let before = run(&bench, "out", &[]);
    bench.edit("mini/study.toml", "[0.2, 0.4]", "[0.1, 0.2, 0.4]");
    let output = bench.done(&["run", "./mini", "--out", "out", "--why"]);
    assert!(output.contains("(21 of 27 units reused)"), "{output}");
    assert!(output.contains("why: problem group `maps/blocked_share=0.1` is new\n"), "{output}");
    let after = run(&bench, "fresh", &[]);
    let rest: Vec<&Row> = after.rows.iter().filter(|row| at(row, "blocked_share") != Some(0.1)).collect();
    assert_eq!(rest, before.rows.iter().collect::<Vec<_>>());
    assert_eq!(after.rows.len(), before.rows.len() + 2 * 6 * 2);
}

#[test]
fn points_of_a_sweep_have_seeds_of_their_own_unless_the_group_names_its_instances() {
    let seeds = |named: bool| {
        let bench = bench();
        if named {
            bench.edit("mini/study.toml", "instances = 6", "instances = 6\nshared_instances = \"shared\"");
        }
        let preprocessing = run(&bench, "out", &[]).preprocessing;
        let maps = preprocessing.into_iter().filter(|row| *row.key.group == *"maps");
        maps.map(|row| row.seed).collect::<Vec<u64>>()
    };
    let own = seeds(false);
    let shared = seeds(true);
    assert!(own[..6].iter().all(|seed| !own[6..].contains(seed)), "{own:?}");
    assert_eq!(shared[..6], shared[6..]);
}

#[test]
fn copied_groups_whose_instances_share_a_name_give_the_rows_of_a_sweep() {
    let swept = bench();
    let copied = bench();
    swept.edit("mini/study.toml", "instances = 6", "instances = 6\nshared_instances = \"shared\"");
    let (_, rest) = STUDY.split_once("[[problems]]\nlabel = \"plain\"").unwrap();
    let (head, _) = STUDY.split_once("[[problems]]").unwrap();
    let group = |share: &str| {
        format!(
            "[[problems]]\nlabel = \"maps {share}\"\nfamily = \"random_cells\"\ninstances = 6\nshared_instances = \"shared\"\n\
             settings = {{ size_cells = 14, start = \"drawn\", goal = {{ x = 13 }}, queries = 2, corner_rule = \
             \"forbid_any\", blocked_share = {share} }}\n"
        )
    };
    let (rest, _) = rest.split_once("[[keep]]").unwrap();
    let rest =
        rest.replace("[[sweep]]\nkey = \"blocked_share\"\nproblems = [\"maps\"]\nvalues = [0.2, 0.4]\n", "");
    let text = format!("{head}{}{}[[problems]]\nlabel = \"plain\"{rest}", group("0.2"), group("0.4"));
    copied.write("mini/study.toml", text.as_bytes());
    copied.write("mini/paper.toml", b"[source]\ntitle = \"A tiny paper\"\nauthors = \"N. N.\"\n");
    let rows = |bench: &Bench| {
        let rows = run(bench, "out", &[]).rows;
        let named = rows.into_iter().filter(|row| row.key.on.group.starts_with("maps")).map(|row| {
            let share = at(&row, "blocked_share").map(|share| format!("maps {share}"));
            let group = share.unwrap_or_else(|| row.key.on.group.to_string());
            (group, row.instance(), row.key.query.clone(), row.key.contender.clone(), row.status, row.values)
        });
        named.collect::<Vec<_>>()
    };
    let (ours, theirs) = (rows(&swept), rows(&copied));
    assert_eq!(ours.len(), 48);
    assert_eq!(ours, theirs);
    let solved = ours.iter().filter(|row| row.4 == study::record::Status::Solved).count();
    assert!((8..44).contains(&solved), "one-sided sample: {solved} of 48 solved");
}

#[test]
fn a_sweep_that_cannot_be_is_refused_at_its_key() {
    for (from, to, expected) in [
        (
            "problems = [\"maps\"]",
            "problems = [\"map\"]",
            "mini/study.toml:23:13: there is no problem group `map` (did you mean `maps`?)",
        ),
        (
            "problems = [\"maps\"]",
            "stage = \"astar\"\nproblems = [\"maps\"]",
            "mini/study.toml:22:7: sweep `blocked_share` has both `stage` and `problems`",
        ),
        (
            "problems = [\"maps\"]",
            "of = \"astar\"",
            "mini/study.toml:23:1: `of` is no key here: the `of` of a criterion or table is `select`, that of a sweep is `stage`",
        ),
        (
            "problems = [\"maps\"]\n",
            "",
            "mini/study.toml:22:7: sweep `blocked_share` has neither `stage` nor `problems`; `stage`, a planner or stage, or \
             `problems`, labels of groups, is accepted",
        ),
        (
            "problems = [\"maps\"]",
            "problems = [\"maps\", \"plain\"]",
            "mini/study.toml:22:7: sweep `blocked_share` would hide that problems `plain` say 0.3",
        ),
        (
            "key = \"blocked_share\"",
            "key = \"blocked\"",
            "mini/study.toml:22:7: unknown key `blocked` (did you mean `blocked_share`?)",
        ),
        ("[0.2, 0.4]", "[1.4, 0.4]", "mini/study.toml:24:11: blocked_share is 1.4; 0 to below 1 is accepted"),
        (
            "problems = [\"maps\"]",
            "problems = []",
            "mini/study.toml:22:7: sweep `blocked_share` has no label among its `problems`",
        ),
        ("[0.2, 0.4]", "[0.2, 0.2]", "mini/study.toml:22:7: sweep `blocked_share` has a value twice"),
        (
            "key = \"size_cells\"",
            "key = \"blocked_share\"",
            "mini/study.toml:26:7: sweep `blocked_share` is the second over this setting",
        ),
    ] {
        let bench = bench();
        bench.edit("mini/study.toml", from, to);
        let answer = bench.run(&["check", "./mini"]);
        assert_eq!(answer.code, Some(2), "{to}: {}{}", answer.out, answer.err);
        assert!(answer.err.contains(expected), "should be said: {expected}\nis said: {}", answer.err);
        // A setting of another name is missing as well; nothing else follows.
        let faults = answer.err.lines().filter(|line| line.contains("mini/")).count();
        assert!(faults == 1 || to.starts_with("key"), "what follows is said as well: {}", answer.err);
    }
}

#[test]
fn groups_that_share_no_sweep_may_sweep_one_setting_each_with_values_of_its_own() {
    let bench = bench();
    let plain =
        "settings = { size_cells = 14, start = [0, 0], goal = [13, 13], blocked_share = 0.3, corner_rule";
    bench.edit("mini/study.toml", plain, &plain.replace("blocked_share = 0.3, ", ""));
    let other = "[[sweep]]\nkey = \"blocked_share\"\nproblems = [\"plain\"]\nvalues = [0.25]\n[[contender]]";
    bench.edit("mini/study.toml", "[[contender]]", other);
    let rows = run(&bench, "out", &[]).rows;
    let shares = |group: &str| {
        let own = rows.iter().filter(|row| *row.key.on.group == *group);
        let mut shares: Vec<f64> = own.filter_map(|row| at(row, "blocked_share")).collect();
        shares.dedup();
        shares
    };
    assert_eq!((shares("maps"), shares("plain"), shares("rectangles")), (vec![0.2, 0.4], vec![0.25], vec![]));
}

#[test]
fn what_a_group_lays_over_a_planner_holds_on_its_problems_alone() {
    let [plain, laid, everywhere] = [bench(), bench(), bench()];
    let group = "label = \"plain\"\n";
    laid.edit("mini/study.toml", group, &format!("{group}stage.astar = {{ weight = 9 }}\n"));
    everywhere.edit("mini/study.toml", "weight = 1,", "weight = 9,");
    let [plain, laid, everywhere] = [plain, laid, everywhere].map(|bench| run(&bench, "out", &[]).rows);
    let of = |rows: &[Row], is_own: bool| -> Vec<Row> {
        rows.iter().filter(|row| (*row.key.on.group == *"plain") == is_own).cloned().collect()
    };
    assert_eq!(of(&laid, true), of(&everywhere, true));
    assert_eq!(of(&laid, false), of(&plain, false));
    assert_ne!(of(&laid, true), of(&plain, true), "a weight of 9 changes nothing here");
    assert_ne!(of(&laid, false), of(&everywhere, false), "a weight of 9 changes nothing here");
}

#[test]
fn what_a_group_lays_over_a_planner_runs_its_trials_again_and_no_other() {
    let bench = bench();
    run(&bench, "out", &[]);
    let group = "label = \"plain\"\n";
    bench.edit("mini/study.toml", group, &format!("{group}stage.astar = {{ weight = 9 }}\n"));
    let output = bench.done(&["run", "./mini", "--out", "out", "--why"]);
    assert!(output.contains("(18 of 21 units reused)"), "{output}");
    assert!(output.contains("why: problem group `plain` has changed\n"), "{output}");
}

#[test]
fn what_a_group_lays_over_no_contender_or_under_a_sweep_is_refused_at_its_key() {
    let group = "label = \"plain\"\n";
    for (laid, sweep, expected) in [
        (
            "stage.astarr = { weight = 9 }",
            "",
            "no contender uses `astarr` (did you mean `astar`?); they use astar, jps",
        ),
        ("stage.astar = { weigth = 9 }", "", "unknown key `weigth` (did you mean `weight`?)"),
        (
            "stage.astar = { weight = 9 }",
            "[[sweep]]\nkey = \"weight\"\nstage = \"astar\"\nvalues = [1, 2]\n",
            "sweep `weight` would hide this `weight` of problems `plain`; one of both is accepted",
        ),
    ] {
        let bench = bench();
        bench.edit("mini/study.toml", group, &format!("{group}{laid}\n"));
        bench.edit("mini/study.toml", "[[contender]]", &format!("{sweep}[[contender]]"));
        let answer = bench.run(&["check", "./mini"]);
        assert_eq!(answer.code, Some(2), "{laid}: {}{}", answer.out, answer.err);
        assert!(answer.err.contains(expected), "should be said: {expected}\nis said: {}", answer.err);
        let at = answer.err.lines().find(|line| line.contains(expected)).unwrap();
        assert!(at.contains("mini/study.toml:13:"), "{at}");
    }
}
