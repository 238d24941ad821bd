//! Choices that a paper declares once: what a study inherits of them, what it leaves out, and what is refused.

use crate::across::{CITED, Toy};
use crate::paper::{Bench, CONTENDERS_END};
use engine::space::World;
use engine::space::roadmap::Local;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use study::paper::Paper;
use study::{Inputs, Interpretation};
use toml::{Table, Value};

/// The paper in `folder` of a bench, as the program reads it.
fn loaded(bench: &Bench, folder: &str) -> Paper {
    let folder = bench.at(folder);
    Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap()
}

/// The choices that the study called `name` inherits, each with whether its trials depend on it.
fn inherited<'p>(paper: &'p Paper, name: &str) -> Vec<(&'p str, bool)> {
    let choices = &paper.study(name).unwrap().choices;
    choices.iter().map(|choice| (choice.id.as_str(), choice.touches_trials)).collect()
}

#[test]
fn a_study_inherits_what_touches_it_and_may_leave_it_out() {
    let bench = Bench::new();
    let both = [("nodes", false), ("corners", true)];
    assert_eq!(inherited(&loaded(&bench, "mini"), "draws"), both);
    // What gives a name a meaning holds in every study.
    let paper = loaded(&bench, "mini");
    assert_eq!(inherited(&paper, "room"), both[..1]);
    assert_eq!(paper.study("room").unwrap().leaves_out, ["corners"]);
    bench.edit("mini/room.toml", "leaves_out = [\"corners\"]", "leaves_out = [\"all\"]");
    assert_eq!(inherited(&loaded(&bench, "mini"), "room"), both[..1]);
    // An option of a planner that the room does not run does not touch it.
    let option = "problem = { corner_rule = \"forbid_any\" }";
    bench.edit("mini/paper.toml", "problem = { corner_rule = \"allow\" }", "");
    bench.edit("mini/paper.toml", option, "stage.bidirectional = { end = \"contact\" }");
    bench.edit("mini/room.toml", "leaves_out = [\"all\"]\n", "");
    let paper = loaded(&bench, "mini");
    assert_eq!((inherited(&paper, "draws"), inherited(&paper, "room")), (both.to_vec(), both[..1].to_vec()));
}

#[test]
fn what_all_studies_share_stands_in_the_paper_and_a_study_says_what_differs() {
    let toy = Toy::written(&[]);
    let shared = "second_seed = 99\n[source]\ntitle = \"A toy\"\n[budget]\nexpansions = 77\n";
    toy.0.edit("toy/paper.toml", "[source]\ntitle = \"A toy\"\n", shared);
    toy.0.edit("toy/draws.toml", "second_seed = 8\n[budget]\nexpansions = 10_000\n", "");
    let paper = loaded(&toy.0, "toy");
    let message = |name: &str| {
        let study = paper.study(name).unwrap();
        (study.second_seed, study.budget.expansions)
    };
    assert_eq!((message("draws"), message("room")), ((Some(99), 77), (Some(8), 10_000)));
}

#[test]
fn an_option_of_one_contender_changes_its_trials_alone() {
    let bench = Bench::new();
    let option = "problem = { corner_rule = \"forbid_any\" }";
    bench.edit("mini/paper.toml", "problem = { corner_rule = \"allow\" }", "");
    bench.edit("mini/paper.toml", option, "contender.\"Slow\".astar = { weight = 0 }");
    let slow = format!(
        "{CONTENDERS_END}\n[[contender]]\nlabel = \"Slow\"\nplanner = \"astar\"\nsettings = {{ weight = 1, ties = \"fifo\" }}\n"
    );
    bench.edit("mini/draws.toml", CONTENDERS_END, &slow);
    bench.edit("mini/room.toml", "leaves_out = [\"corners\"]\n", "");
    assert_eq!(inherited(&loaded(&bench, "mini"), "room"), [("nodes", false)]);
    bench.done(&["run", "./mini", "--with", "corners=allow", "--out", "one"]);
    bench.done(&["run", "./mini", "--with", "corners=forbid_any", "--out", "other"]);
    let expansions = |out: &str| {
        bench.done(&["export", out, "--csv", "--out", &format!("{out}/csv")]);
        let text = fs::read_to_string(bench.at(&format!("{out}/csv/draws.trials.csv"))).unwrap();
        let mut lines = text.lines();
        let head: Vec<&str> = lines.next().unwrap().split(',').collect();
        let at = |name: &str| head.iter().position(|column| *column == name).unwrap();
        let contender = at("contender");
        let expansions = at("expansions");
        let mut sums: BTreeMap<String, u64> = BTreeMap::new();
        for line in lines {
            let cells: Vec<&str> = line.split(',').collect();
            *sums.entry(cells[contender].to_owned()).or_default() +=
                cells[expansions].parse::<u64>().unwrap();
        }
        sums
    };
    let (one, other) = (expansions("one"), expansions("other"));
    assert_eq!((one["A*"], one["Two-sided"]), (other["A*"], other["Two-sided"]));
    assert_eq!(one["A*"], one["Slow"]);
    assert!(other["Slow"] > one["Slow"], "{one:?} {other:?}");
}

#[test]
fn an_option_is_laid_over_the_files_of_a_robot_and_of_its_scene() {
    let bench = Bench::new();
    bench.done(&["new", "./arm", "--from", "cell"]);
    let over =
        |robot: &str, scene: &str| format!("long = {{ robot = {{ {robot} }}, scene = {{ {scene} }} }}");
    let [robot, scene] = ["tool.length_mm = 160", "box.wall.max_mm = [900, 40, 700]"];
    bench.edit("arm/paper.toml", "short = { problem = { tool_mm = 100 } }", "short = {}");
    bench.edit("arm/paper.toml", "long = { problem = { tool_mm = 160 } }", &over(robot, scene));
    let wall = "[[choice]]\nid = \"wall\"\nwhy = \"its width is lost\"\ndefault = \"thin\"\n[choice.option]\nthin = {}\n\
                thick = { scene = { box.wall.max_mm.1 = 70 } }\n";
    bench.edit("arm/paper.toml", "[[table]]", &format!("{wall}\n[[table]]"));
    let built = |paper: &Paper, option: &str, wall: &str| {
        let study = &paper.studies[0];
        let taken =
            [("tool", option), ("wall", wall)].map(|(id, option)| (id.to_owned(), option.to_owned())).into();
        let interpretation = Interpretation::new(&study.choices, &taken).unwrap();
        let inputs = Inputs::below(vec![bench.at("arm")]);
        let preprocessing = study.groups[0]
            .family(&study.groups[0].points[0], &interpretation, &inputs)
            .unwrap()
            .prepare(1)
            .unwrap();
        let World::Roadmap(map) = preprocessing.world else { panic!("an arm's world is a roadmap") };
        let Local::Arm(lines) = map.local() else { panic!("it is that of an arm in a cell") };
        let scene = lines.cell().scene();
        let wall = scene.obstacles().iter().find(|obstacle| obstacle.name == "wall").unwrap();
        let top = wall.solid.aabb().max;
        [lines.cell().robot().tool_length_m(), top.z, top.y].map(|metres| (metres * 1e3).round() as u32)
    };
    let paper = loaded(&bench, "arm");
    let [short, long] = ["short", "long"].map(|option| built(&paper, option, "thin"));
    assert_eq!(long, [160, 700, 40]);
    assert!(short[0] < 160 && short[1] == 550, "{short:?}");
    // What two choices lay over one file stands side by side: whole lists below, numbers in them above.
    assert_eq!(built(&paper, "long", "thick"), [160, 700, 70]);
    assert_eq!(built(&paper, "short", "thick")[1..], [550, 70]);
    for (robot, scene, refused) in [
        ("tool.length = 160", scene, "unknown key `length` (did you mean `length_mm`?)"),
        (
            robot,
            "box.wal.max_mm = [9, 9, 9]",
            "scene_with.box: there is no table `wal`; a number from 0 or a `name`",
        ),
        (robot, "box.wall.max_mm = [900, 40]", "`max_mm` is an array of 2; "),
    ] {
        let text = fs::read(bench.at("arm/paper.toml")).unwrap();
        bench.edit(
            "arm/paper.toml",
            &over("tool.length_mm = 160", "box.wall.max_mm = [900, 40, 700]"),
            &over(robot, scene),
        );
        let output = bench.run(&["check", "./arm"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        let reported: Vec<&str> = output.err.lines().filter(|line| line.contains("arm/")).collect();
        assert!(
            reported.len() == 1
                && reported[0].contains("arm/paper.toml:34:")
                && reported[0].contains(refused),
            "{}",
            output.err
        );
        bench.write("arm/paper.toml", &text);
    }
}

/// An option without a weight that the paper may mean and that cannot be run.
const LOST: (&str, &str) = (
    "[choice.option.none]\nstage.astar = { weight = 0 }",
    "[choice.option.none]\npaper = \"section 2: as in our earlier work\"\ncannot_run = \"that work is lost\"",
);

#[test]
fn an_option_that_cannot_be_run_leaves_open_what_it_touches_and_is_shown() {
    let toy = Toy::new(&[LOST]);
    for claim in ["fewer", "shorter", "witness", "calibrated"] {
        assert_eq!(toy.claim(claim).verdict.name(), "inconclusive", "{claim}");
        let finding = &toy.claim(claim).findings[0];
        let settles = finding.settles.as_deref().unwrap_or_default();
        assert!(settles.contains("hurry = none: that work is lost"), "{claim}: {settles}");
    }
    let explored = toy.first();
    assert!(
        explored.interpretations.iter().all(|one| !one.contains_key("hurry")),
        "{:?}",
        explored.interpretations
    );
    let output = toy.0.run(&["run", "./toy", "--with", "hurry=none"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(output.err.contains("--with: option `none` of choice `hurry` cannot be run: that work is lost"));
    toy.0.done(&["render", "./toy"]);
    let details = fs::read_to_string(toy.0.at("target/replan/toy/plots/toy/details.md")).unwrap();
    assert!(details.contains("none cannot be run here: that work is lost"), "{details}");
    // A probe says nothing of what the paper means, and a claim that is not meant under the option is not touched by it.
    let probe = ("[choice.option.none]", "[choice.option.none]\ncannot_run = \"it is lost\"");
    assert_eq!(Toy::new(&[probe]).claim("fewer").verdict.name(), "reproduced");
    let when = ("id = \"fewer\"\n", "id = \"fewer\"\nholds_when = { hurry = [\"three\"] }\n");
    let toy = Toy::new(&[LOST, when]);
    assert_eq!(
        [toy.claim("fewer"), toy.claim("shorter")].map(|one| one.verdict.name()),
        ["reproduced", "inconclusive"]
    );
}

/// The file, what is replaced in it, and what `check` then says of one place.
const REFUSED: [(&str, &str, &str, &str); 19] = [
    (
        "paper",
        "{ weight = 0 }",
        "{ weight = 0 }\nproblem = { corner_rul = \"allow\" }",
        "option `none` sets `corner_rul`, which no problem has of a study that inherits the choice (did you mean `corner_rule`?)",
    ),
    (
        "paper",
        "{ weight = 0 }",
        "{ weight = 0 }\nproblem = { map = \"room.txt\", size_cells = [9, 9] }",
        "option `none` sets `map`, `size_cells`, which no problem has together of a study that inherits the choice",
    ),
    (
        "paper",
        "{ weight = 0 }",
        "{ weight = 0 }\nstage.joint_astar = { delta_deg = 1 }",
        "option `none` sets `joint_astar`, which no study that inherits the choice runs",
    ),
    (
        "paper",
        "{ weight = 0 }",
        "{ weight = 0 }\ncontender.\"B*\".astar = { weight = 2 }",
        "choice `hurry`: option `none`: there is no contender `B*`; there are A*, Lazy, Two-sided",
    ),
    (
        "paper",
        "{ weight = 0 }",
        "{ weight = 0 }\ncontender.\"Lazy\".astar = { weight = 2 }",
        "option `none` sets `astar`, which contender `Lazy` does not use",
    ),
    (
        "paper",
        "default = \"three\"",
        "default = \"tree\"",
        "choice `hurry` has no option `tree` (did you mean `three`?)",
    ),
    (
        "paper",
        "paper = \"section 1: the weight is three\"",
        "paper = \"section 1\"\ncannot_run = \"it is lost\"",
        "the default of choice `hurry` cannot be run; another option is accepted",
    ),
    ("paper", "id = \"idle\"", "id = \"hurry\"", "choice `hurry` stands twice"),
    ("paper", "id = \"idle\"", "id = \"all\"", "a choice is called `all`, which stands for every choice"),
    ("paper", "room = 1 }", "hall = 1 }", "there is no study `hall`; there are draws, room"),
    ("paper", "room = 1 }", "room = 0 }", "`room` is 0; a whole number from 1 to 1000000 is accepted"),
    (
        "paper",
        "room = 1 }",
        "room = 1 }\nmore_instances = { draws = 19 }",
        "`more_instances` of `draws` is 19, below its `instances`, 20; 20 or more are accepted",
    ),
    ("draws", "[budget]\nexpansions = 10_000\n", "", "missing key `budget`"),
    (
        "draws",
        "seed = 7",
        "leaves_out = [\"hury\"]\nseed = 7",
        "there is no choice `hury` (did you mean `hurry`?); there are hurry",
    ),
    (
        "draws",
        "seed = 7",
        "leaves_out = [\"idle\"]\nseed = 7",
        "choice `idle` sets nothing that study `draws` runs; those that do are hurry",
    ),
    (
        "draws",
        "[budget]",
        "[explore]\ndraws = 3\n[budget]",
        "`explore` is no key here: `[explore]` is written in paper.toml",
    ),
    (
        "draws",
        "[budget]",
        "[[reading]]\nid = \"hurry\"\n[budget]",
        "`reading` is no key here: what the paper leaves open is a `[[choice]]` of paper.toml",
    ),
    (
        "draws",
        "[budget]",
        "[[choice]]\nid = \"hurry\"\n[budget]",
        "`choice` is no key here: choices are written in paper.toml",
    ),
    ("paper", "select =", "of =", "`of` is no key here: the `of` of a criterion or table is `select`"),
];

#[test]
fn what_a_choice_cannot_be_is_refused_once_where_it_stands() {
    let toy = Toy::written(&[CITED]);
    toy.0.done(&["check", "./toy"]);
    for (file, from, to, refused) in REFUSED {
        let name = format!("toy/{file}.toml");
        let whole = fs::read(toy.0.at(&name)).unwrap();
        toy.0.edit(&name, from, to);
        let output = toy.0.run(&["check", "./toy"]);
        assert_eq!(output.code, Some(2), "{to}: {}{}", output.out, output.err);
        let lines: Vec<&str> = output.err.lines().filter(|line| line.contains("toy/")).collect();
        assert!(lines.len() == 1 && lines[0].contains(refused), "{to}\n{}", output.err);
        assert!(lines[0].contains(&format!("/toy/{file}.toml:")), "{}", lines[0]);
        toy.0.write(&name, &whole);
    }
}

#[test]
fn a_premise_that_the_claims_study_leaves_out_is_refused() {
    let bench = Bench::new();
    let when = "cell.cost.id = \"cost\", cell.cost.holds_when = { corners = [\"allow\"] }";
    bench.edit("mini/paper.toml", "cell.cost.id = \"cost\"", when);
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    let refused = "claim `cost` is meant under options of choice `corners`, which study `room` leaves out";
    assert!(output.err.contains(refused), "{}", output.err);
}

#[test]
fn words_of_the_command_line_that_were_renamed_are_answered_with_the_new_ones() {
    let bench = Bench::new();
    for (words, new) in [
        (&["repro", "./mini", "--readings", "all"][..], "`--readings` is now `--with`"),
        (&["repro", "./mini", "--readings=all"], "`--readings` is now `--with`"),
        (&["list", "readings"], "`list readings` is now `list choices`"),
    ] {
        let output = bench.run(words);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(output.err.contains(new), "{words:?}: {}", output.err);
    }
}

/// The TOML files of every committed paper: its name, that of the file, and what it says.
fn committed() -> Vec<(String, String, Table)> {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/experiments");
    let mut all = Vec::new();
    for paper in fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()) {
        for file in fs::read_dir(&paper).unwrap().map(|entry| entry.unwrap().path()) {
            let name = |path: &std::path::Path| path.file_stem().unwrap().to_string_lossy().into_owned();
            let text = fs::read_to_string(&file).unwrap();
            all.push((name(&paper), name(&file), text.parse().unwrap()));
        }
    }
    assert!(all.len() > 40, "{} files", all.len());
    all
}

/// Notes `what` as said; panics if it was said before.
fn once<T: Ord + std::fmt::Debug>(message: &mut BTreeSet<T>, what: T) {
    let shown = format!("{what:?}");
    assert!(message.insert(what), "written twice: {shown}");
}

#[test]
fn nothing_of_choices_is_written_twice_in_the_committed_specs() {
    let files = committed();
    let mut options = 0;
    let mut choices = 0;
    for (paper, _, spec) in files.iter().filter(|(_, file, _)| file == "paper") {
        let mut seen = BTreeSet::new();
        for choice in spec.get("choice").and_then(Value::as_array).into_iter().flatten() {
            choices += 1;
            let id = choice["id"].as_str().unwrap();
            once(&mut seen, (paper, id, "its name".to_owned()));
            once(&mut seen, (paper, "why", choice["why"].to_string()));
            for (name, option) in choice["option"].as_table().unwrap() {
                options += 1;
                let option = option.as_table().unwrap();
                // Several options may rest on one sentence: then it is the choice's.
                for key in ["paper", "practice"] {
                    if let Some(source) = option.get(key) {
                        once(&mut seen, (paper, id, format!("{key} {source}")));
                        assert_ne!(choice.get(key), Some(source), "{paper}, {id} = {name}: {key} twice");
                    }
                }
                let sets = ["problem", "robot", "scene", "stage", "contender", "metric", "digits"]
                    .map(|key| option.get(key).map(|value| format!("{key} = {value}")).unwrap_or_default());
                let sets = sets.concat();
                // An option that sets nothing is the only one of its choice; what options set, no other one of the paper sets.
                once(&mut seen, (paper, if sets.is_empty() { id } else { "" }, format!("sets {sets}")));
            }
        }
    }
    assert!(choices > 50 && options > 150, "{choices} choices with {options} options");
    // What the paper says for all studies, no study says again.
    for (paper, file, study) in files.iter().filter(|(_, _, spec)| spec.contains_key("question")) {
        let (_, _, shared) = files.iter().find(|(own, file, _)| own == paper && file == "paper").unwrap();
        for key in ["budget", "second_seed"] {
            assert!(
                study.get(key).is_none() || study.get(key) != shared.get(key),
                "{paper}/{file}: {key} twice"
            );
        }
    }
}
