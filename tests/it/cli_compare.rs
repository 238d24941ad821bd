//! Comparisons from the command line: runs of the tiny paper beside each other, gates, formats.

use crate::paper::Bench;
use std::fs;

/// A bench with a run in `a`, one of another seed in `b`, and one of a planner made worse on purpose in `worse`.
fn runs() -> Bench {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "instances = 24", "instances = 80");
    bench.edit("mini/draws.toml", "blocked_share = 0.3", "blocked_share = 0.15");
    bench.done(&["run", "./mini", "--out", "a"]);
    bench.done(&["run", "./mini", "--out", "b", "--seed", "99"]);
    bench.edit("mini/draws.toml", "settings = { weight = 1,", "settings = { weight = 0,");
    bench.done(&["run", "./mini", "--out", "worse"]);
    bench
}

#[test]
fn a_gate_catches_a_planner_made_worse_and_passes_an_equal_one() {
    let bench = runs();
    let gate = ["--gate", "expansions +2%", "--study", "draws"];
    let equal = bench.run(&[&["compare", "a", "a"], &gate[..]].concat());
    assert_eq!((equal.code, equal.err.as_str()), (Some(0), ""), "{}", equal.out);
    assert!(equal.out.contains("gate expansions +2%: draws: A*: not worse; 0 [0, 0] %\n"), "{}", equal.out);
    let worse = bench.run(&[&["compare", "a", "worse"], &gate[..]].concat());
    assert_eq!(worse.code, Some(3), "{}", worse.out);
    assert!(worse.err.contains("1 of 2 lines are worse than their gates allow"), "{}", worse.err);
    assert!(worse.err.contains("gate expansions +2%: draws: A*: worse; "), "{}", worse.err);
    assert!(!worse.err.contains("Two-sided"), "the other planner is as before: {}", worse.err);
    // Other maps and wide intervals: a tight gate cannot tell, which is a failure if asked for.
    let open = bench.run(&[&["compare", "a", "b"], &gate[..]].concat());
    assert_eq!(open.code, Some(0), "{}", open.err);
    assert!(
        open.out.contains("cannot tell: about ") && open.out.contains(" more instances; "),
        "{}",
        open.out
    );
    let strict = bench.run(&[&["compare", "a", "b", "--strict"], &gate[..]].concat());
    assert_eq!(strict.code, Some(3), "{}", strict.out);
}

#[test]
fn a_comparison_leaves_as_text_markdown_csv_and_json() {
    let bench = runs();
    let plain = bench.done(&["compare", "a", "worse"]);
    assert!(plain.starts_with("From a to worse\n"), "{plain}");
    let markdown = bench.done(&["compare", "a", "worse", "--markdown"]);
    assert!(markdown.contains("### Problems solved\n\n| study | contender |"), "{markdown}");
    let csv = bench.done(&["compare", "a", "worse", "--csv"]);
    let columns = csv.lines().next().unwrap().split(',').count();
    assert!(csv.lines().count() > 10 && csv.lines().all(|line| line.split(',').count() == columns), "{csv}");
    let json: serde_json::Value =
        serde_json::from_str(&bench.done(&["compare", "a", "worse", "--json"])).unwrap();
    let change =
        json["changes"].as_array().unwrap().iter().find(|change| change["metric"] == "expansions").unwrap();
    assert_eq!((&change["contender"], &change["word"]), (&"A*".into(), &"worse".into()));
    let contenders =
        bench.done(&["compare", "a", "--contenders", "A*", "Two-sided", "--metric", "expansions"]);
    assert!(contenders.contains("Two-sided against A*"), "{contenders}");
}

#[test]
fn a_comparison_fits_a_hundred_columns_and_explains_its_words() {
    let bench = runs();
    for arguments in [
        &["compare", "a", "worse"][..],
        &["compare", "a", "b", "--gate", "expansions +2%"],
        &["compare", "a", "--contenders", "A*", "Two-sided"],
    ] {
        let text = bench.done(arguments);
        let widest = text.lines().max_by_key(|line| line.chars().count()).unwrap();
        assert!(widest.chars().count() <= 100, "{widest}");
        assert!(
            text.contains("\nVerdict: better or worse where the interval excludes no change; open"),
            "{text}"
        );
    }
    let text = bench.done(&["compare", "a", "worse"]);
    let worse = text.lines().find(|line| line.starts_with("  expansions ")).unwrap();
    assert!(worse.contains(" +") && worse.contains(" %  ") && worse.ends_with("  worse"), "{worse}");
    assert!(text.contains("  equal in every pair: solved, "), "{text}");
}

#[test]
fn a_run_is_named_alike_wherever_one_is_read() {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    let none = bench.run(&["export", "mini", "--csv"]);
    let missing = "data/runs/mini: no stored run; `replan repro mini` makes it";
    assert!(none.code == Some(2) && none.err.contains(missing), "{}", none.err);
    bench.done(&["repro", "mini"]);
    for name in ["mini", "experiments/mini", "./experiments/mini", "data/runs/mini"] {
        let shown = bench.done(&["show", name, "nodes"]);
        assert!(shown.starts_with("nodes: "), "{name}: {shown}");
        bench.done(&["export", name, "--csv", "--out", "csv"]);
        let compared = bench.done(&["compare", name, "mini", "--study", "room"]);
        assert!(compared.contains("  equal in every pair: solved, "), "{name}: {compared}");
        assert_eq!(bench.done(&["report", name, "--to", "pages"]).lines().last(), Some("pages/mini.html"));
    }
    // A paper of one's own, and the folder of an earlier `--out`.
    fs::create_dir(bench.at("own")).unwrap();
    fs::rename(bench.at("experiments/mini"), bench.at("own/mini")).unwrap();
    bench.done(&["repro", "own/mini"]);
    bench.done(&["repro", "own/mini", "--out", "kept"]);
    for name in ["own/mini", "kept", "kept/data/runs/mini"] {
        assert!(bench.done(&["show", name, "nodes"]).starts_with("nodes: "));
        bench.done(&["export", name, "--csv", "--out", "csv"]);
        bench.done(&["compare", name, name]);
    }
}

#[test]
fn show_searches_names_and_sentences_of_claims() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini", "--out", "a"]);
    let one = bench.done(&["show", "./mini", "FEWER", "sides", "--out", "a"]);
    assert!(one.starts_with("nodes: ") && one.contains("  says: two sides open fewer nodes\n"), "{one}");
    let several = bench.done(&["show", "a", "o"]);
    assert!(several.contains("cost  ") && several.contains("\n  section 1: two sides open"), "{several}");
    assert!(several.ends_with("2 claims hold “o”; one in full: replan show a CLAIM\n"), "{several}");
    for (misspelt, meant) in [("nodess", "nodes"), ("two fewwer", "fewer")] {
        let arguments = ["show", "a", misspelt];
        let none = bench.run(&arguments);
        let message = format!(
            "no claim and no choice is called `{misspelt}`, and no claim holds it (did you mean `{meant}`?)"
        );
        assert_eq!(none.code, Some(2));
        assert!(none.err.contains(&message), "{}", none.err);
    }
}

#[test]
fn show_and_list_find_a_choice_by_its_id_and_show_by_an_option_of_it() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let choice = "corners\n  options: allow, forbid_any\n  default: allow\n  why: not said\n";
    assert_eq!(bench.done(&["show", "./mini", "corners"]), choice);
    assert_eq!(bench.done(&["show", "./mini", "forbid_any"]), choice);
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    assert_eq!(bench.done(&["list", "choices", "corners"]), choice);
    assert_eq!(bench.done(&["list", "choices", "mini/corners"]), choice);
    let all = bench.done(&["list", "choices", "mini"]);
    assert!(all.contains("mini/corners\n") && all.contains("mini/nodes\n"), "{all}");
}

#[test]
fn a_long_list_of_names_is_no_answer_to_a_wrong_one() {
    let bench = Bench::empty();
    let output = bench.run(&["list", "metrics", "path_cost_cels"]);
    let line = output.err.trim_end();
    assert!(line.contains("(did you mean `path_cost_cells`?); `replan list metrics` lists all "), "{line}");
    assert!(line.len() < 150, "{line}");
}

#[test]
fn show_gives_the_result_under_the_defaults_once() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_replan"));
    let output = command.args(["show", "zhang", "sentence.turns"]).current_dir(root).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.matches("under the defaults").count(), 1, "{text}");
}

#[test]
fn an_export_holds_every_trial_and_what_they_come_to() {
    let bench = runs();
    bench.done(&["export", "a", "--csv", "--out", "csv"]);
    let trials = fs::read_to_string(bench.at("csv/draws.trials.csv")).unwrap();
    assert!(
        trials.starts_with("group,instance,query,contender,choice_corners,repeat,seed,status,reason,"),
        "{trials}"
    );
    assert_eq!(trials.lines().count(), 161);
    let statistics = fs::read_to_string(bench.at("csv/statistics.csv")).unwrap();
    assert!(
        statistics.lines().any(|line| line.starts_with("draws,default,drawn,A*,,expansions,,80,")),
        "{statistics}"
    );
    assert!(bench.at("csv/draws.times.csv").is_file() && bench.at("csv/room.preprocessing.csv").is_file());
}

#[test]
fn a_spreadsheet_computes_no_label_of_an_export() {
    let bench = Bench::new();
    bench.edit("mini/room.toml", "label = \"A*\"", "label = \"=1+1, A*\"");
    bench.edit("mini/room.toml", "contenders = [\"A*\"]", "contenders = [\"=1+1, A*\"]");
    bench.edit("mini/paper.toml", "contenders = [\"A*\"]", "contenders = [\"=1+1, A*\"]");
    bench.done(&["run", "./mini", "--out", "a"]);
    bench.done(&["export", "a", "--csv", "--out", "csv"]);
    for file in ["csv/room.trials.csv", "csv/statistics.csv"] {
        let text = fs::read_to_string(bench.at(file)).unwrap();
        assert!(text.contains(",\"'=1+1, A*\",") && !text.contains(",\"="), "{text}");
    }
}

#[test]
fn the_evidence_shows_what_differs_between_two_encodings_with_other_margins() {
    let bench = Bench::empty();
    bench.done(&["new", "maps", "--from", "grid"]);
    bench.done(&["repro", "./maps", "--out", "a"]);
    bench.edit("maps/paper.toml", "margin = 5", "margin = 50");
    bench.done(&["repro", "./maps", "--out", "b"]);
    let text = bench.done(&["compare", "a", "b", "--verdicts", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let differ = || json["claims"].as_array().unwrap().iter().filter(|pair| pair["is_same"] == false);
    assert!(differ().count() >= 2, "{text}");
    for pair in differ() {
        assert!(!pair["because"].as_array().unwrap().is_empty(), "{pair}");
    }
    let saving = differ().find(|pair| pair["ids"][0] == "table1.weighted.saving").unwrap();
    let because = saving["because"][0].as_str().unwrap();
    assert!(because.starts_with("evidence: ") && because.contains("margin 50"), "{because}");
}

#[test]
fn what_cannot_be_compared_is_reported() {
    let bench = Bench::new();
    bench.done(&["run", "./mini", "--out", "a"]);
    for (arguments, complaint) in [
        (&["compare", "a", "nowhere"][..], "`nowhere` holds no stored run; a folder with *.manifest.toml"),
        (&["compare", "a"], "the following required arguments were not provided:\n  <SECOND>"),
        (&["compare", "a", "a", "--contenders", "A*", "B"], "cannot be used with"),
        (
            &["compare", "a", "--contenders", "A*", "B"],
            "--contenders: there is no stored trial of a contender `B`; there are A*, Two-sided",
        ),
        (
            &["compare", "a", "a", "--study", "hall"],
            "there is no stored run of a study `hall`; there are draws, room",
        ),
        (&["compare", "a", "a", "--metric", "speed"], "`speed` is no metric that can be compared; solved, "),
        (&["compare", "a", "a", "--gate", "expansions"], "is not `METRIC ±NUMBER` or `METRIC ±NUMBER%`"),
        (&["compare", "a", "a", "--gate", "hops +2%"], "no pair of trials has a `hops`"),
        (&["compare", "a", "a", "--strict"], "--gate"),
        (&["export", "a"], "--to <FORMAT>"),
        (&["export", "nowhere", "--csv"], "`nowhere` holds no stored run"),
    ] {
        let output = bench.run(arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}{}", output.out, output.err);
        assert!(output.err.contains(complaint), "{arguments:?} is answered: {}", output.err);
    }
}

#[test]
fn two_encodings_of_one_paper_show_what_they_judge_differently_and_which_default_differs() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini", "--out", "a"]);
    let same = bench.done(&["compare", "a", "a", "--verdicts"]);
    assert!(same.starts_with("0 of ") && !same.contains('|'), "{same}");
    // A stranger asks the opposite, takes another default, and calls a printed cell by another name.
    bench.edit("mini/paper.toml", "is = \"lower\"", "is = \"higher\"");
    bench.edit("mini/paper.toml", "default = \"opened\"", "default = \"closed\"");
    bench.edit("mini/paper.toml", "id = \"table1\"", "id = \"costs\"");
    bench.edit("mini/paper.toml", "cell.cost.id = \"cost\"", "cell.cost.id = \"length\"");
    bench.edit("mini/paper.toml", "figures = [\"table1\"]", "figures = [\"costs\"]");
    bench.done(&["repro", "./mini", "--out", "b"]);
    let output = bench.done(&["compare", "a", "b", "--verdicts"]);
    assert!(output.contains("| `nodes` | "), "{output}");
    assert!(output.contains("- default of `nodes`: opened and closed"), "{output}");
    let json: serde_json::Value =
        serde_json::from_str(&bench.done(&["compare", "a", "b", "--verdicts", "--json"])).unwrap();
    let claims = json["claims"].as_array().unwrap();
    let cell = claims.iter().find(|pair| pair["ids"][0] == "cost");
    assert_eq!(
        cell.map(|pair| &pair["ids"][1]),
        Some(&"length".into()),
        "matched by the printed cell: {json:#}"
    );
    assert!(
        claims.iter().any(|pair| pair["is_same"] == false && !pair["because"].as_array().unwrap().is_empty())
    );
}

#[test]
fn claims_of_other_names_match_by_what_they_mean_and_a_study_that_is_set_otherwise_is_named() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini", "--out", "a"]);
    bench.edit("mini/paper.toml", "[[claim]]\nid = \"nodes\"", "[[claim]]\nid = \"fewer\"");
    bench.edit("mini/paper.toml", "two sides open fewer nodes", "fewer nodes, says a stranger");
    bench.done(&["repro", "./mini", "--out", "b"]);
    let renamed = bench.done(&["compare", "a", "b", "--verdicts"]);
    assert!(renamed.starts_with("0 of ") && !renamed.contains("Only `"), "{renamed}");
    bench.edit("mini/paper.toml", "id = \"fewer\"", "id = \"nodes\"");
    bench.edit("mini/paper.toml", "is = \"lower\"", "is = \"higher\"");
    bench.edit("mini/draws.toml", "seed = 7", "seed = 8");
    bench.edit("mini/draws.toml", "weight = 1, ties = \"fifo\"", "weight = 1, ties = \"lifo\"");
    bench.done(&["repro", "./mini", "--out", "c"]);
    let text = bench.done(&["compare", "a", "c", "--verdicts"]);
    let nodes = text.lines().find(|line| line.starts_with("| `nodes` |")).unwrap_or_else(|| panic!("{text}"));
    let otherwise =
        "study `draws`: seed 7 and 8, problem group `drawn` has changed, contender `A*` has changed";
    assert!(nodes.contains(otherwise) && nodes.contains("evidence: "), "{nodes}");
    assert!(!nodes.contains("default of"), "{nodes}");
}
