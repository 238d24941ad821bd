//! `replan witness` and `run --clock` from the outside.

use crate::paper::Bench;
use base::grid::parse_text_map;
use std::collections::BTreeSet;
use std::fs;

#[test]
fn a_map_is_found_on_which_the_claim_holds_and_the_same_at_any_number_of_threads() {
    let bench = Bench::new();
    let ask = |out: &str, threads: &str| {
        let mut command =
            bench.command(&["witness", "./mini", "--claims", "cost", "--seed", "3", "--out", out]);
        let output = bench.output(&command.env("RAYON_NUM_THREADS", threads).output().unwrap());
        assert_eq!(output.code, Some(0), "{}{}", output.out, output.err);
        output.out
    };
    let one = ask("one", "1");
    assert!(one.contains("holds: cost, printed 7.83, here 7.8"), "{one}");
    assert_eq!(ask("two", "2").replace("two/", "one/"), one);
    assert_eq!(
        bench.tree("one").into_values().collect::<Vec<_>>(),
        bench.tree("two").into_values().collect::<Vec<_>>()
    );
    // The map that was written is one of the study's size, and the study run on it gives what was said.
    let (path, text) = bench.tree("one").into_iter().next().unwrap();
    let map = parse_text_map(&String::from_utf8(text).unwrap()).unwrap();
    let room = parse_text_map(&fs::read_to_string(bench.at("mini/room.map.txt")).unwrap()).unwrap();
    assert_eq!((map.width(), map.height()), (room.width(), room.height()));
    fs::copy(bench.at("one").join(path), bench.at("mini/room.map.txt")).unwrap();
    let judged = bench.done(&["repro", "./mini"]);
    assert_eq!(class_of("cost", &judged), "attainable", "{judged}");
}

/// The verdict of a claim: the first word of the line above the one that its id begins.
fn class_of<'t>(claim: &str, table: &'t str) -> &'t str {
    let is_its = |id: &str| id.trim().trim_matches(['(', ')']).split(':').next() == Some(claim);
    let line = table.lines().zip(table.lines().skip(1)).find(|(_, id)| is_its(id)).map(|(line, _)| line);
    line.and_then(|line| line.split_whitespace().next()).unwrap_or_default()
}

#[test]
fn under_any_interpretation_each_search_draws_one_and_the_study_agrees_under_it() {
    let bench = Bench::new();
    bench.edit("mini/room.toml", "corner_rule = \"forbid_any\"", "corner_rule = \"allow\"");
    bench.edit("mini/room.toml", "leaves_out = [\"corners\"]\n", "");
    for option in ["allow", "forbid_any"] {
        let cited = format!("[choice.option.{option}]\npractice = \"some program\"");
        bench.edit("mini/paper.toml", &format!("[choice.option.{option}]"), &cited);
    }
    let mut interpretations = BTreeSet::new();
    let mut attained = 0;
    for seed in 1..=8 {
        let seed = seed.to_string();
        let out = format!("any{seed}");
        let ask = ["witness", "./mini", "--claims", "cost", "--with", "any", "--seed", &seed, "--out", &out];
        let output = bench.done(&ask);
        let interpretation = output.lines().find_map(|line| line.strip_prefix("interpretation: ")).unwrap();
        let interpretation = interpretation.split(';').next().unwrap().to_owned();
        let (path, _) = bench.tree(&out).into_iter().next().unwrap();
        fs::copy(bench.at(&out).join(path), bench.at("mini/room.map.txt")).unwrap();
        let under = interpretation.replace("default", "corners=allow");
        let judged = bench.done(&["repro", "./mini", "--with", &under, "--out", &format!("{out}/run")]);
        attained += u32::from(class_of("cost", &judged) == "attainable");
        interpretations.insert(interpretation);
    }
    assert_eq!(attained, 8, "of 8 maps");
    let both = ["corners=forbid_any".to_owned(), "default".to_owned()];
    assert_eq!(interpretations, BTreeSet::from(both), "a one-sided sample");
}

#[test]
fn what_no_search_finds_is_reported_with_their_number_and_remembered() {
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "7.83", "0.31");
    let ask = |searches: &str| {
        bench.done(&[
            "witness",
            "./mini",
            "--claims",
            "cost",
            "--searches",
            searches,
            "--maps",
            "20",
            "--out",
            "out",
        ])
    };
    assert!(ask("3").starts_with("none found in 3 searches of 20 maps each, for cost"), "{}", ask("3"));
    let more = ask("11");
    assert!(more.starts_with("3 searches found none before\nnone found in 11 searches"), "{more}");
}

#[test]
fn a_claim_that_asks_for_no_number_is_refused_with_its_name() {
    let output = Bench::new().run(&["witness", "./mini", "--claims", "nodes"]);
    assert_eq!(output.code, Some(2));
    assert!(output.err.contains("claim `nodes` asks for no number that a trial may meet"), "{}", output.err);
}

#[test]
fn a_clock_that_is_read_again_adds_a_session_and_moves_no_trial() {
    let bench = Bench::new();
    bench.edit("mini/room.toml", "[quick]", "[timing]\nproblems = 1\nrepeats = 2\n\n[quick]");
    let output = bench.run(&["run", "./mini", "--clock"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    bench.done(&["run", "./mini"]);
    let before = bench.facts("target/replan/mini");
    let out = bench.done(&["run", "./mini", "--clock"]);
    assert!(out.contains("session 2 of the clock"), "{out}");
    assert_eq!(bench.facts("target/replan/mini"), before);
    let manifests = bench.tree("target/replan/mini");
    let numbers = |text: &[u8]| String::from_utf8_lossy(text).matches("\nnumber = 2").count();
    assert!(manifests.iter().any(|(path, text)| path.ends_with("room.manifest.toml") && numbers(text) == 1));
    assert!(bench.done(&["run", "./mini", "--clock"]).contains("session 3"));
    assert!(bench.done(&["run", "./mini"]).contains("reused"), "a session made the trials stale");
}

#[test]
fn trials_that_run_again_keep_the_sessions_of_the_clock_only_where_they_come_out_the_same() {
    let bench = Bench::new();
    bench.edit("mini/room.toml", "[quick]", "[timing]\nproblems = 1\nrepeats = 2\n\n[quick]");
    bench.done(&["run", "./mini"]);
    bench.done(&["run", "./mini", "--clock"]);
    let sessions = |bench: &Bench| {
        let files = bench.tree("target/replan/mini");
        let (_, text) = files.iter().find(|(path, _)| path.ends_with("room.manifest.toml")).unwrap();
        String::from_utf8_lossy(text).matches("[[session]]").count()
    };
    assert_eq!(sessions(&bench), 2);
    bench.done(&["run", "./mini", "--fresh"]);
    assert_eq!(sessions(&bench), 3, "a session that reads the same trials is lost");
    bench.edit("mini/room.toml", "expansions = 10_000", "expansions = 3");
    bench.done(&["run", "./mini", "--fresh"]);
    assert_eq!(sessions(&bench), 1, "the clock read other trials");
}

#[test]
fn what_failed_on_draws_that_were_not_timed_is_no_failure_among_the_timed() {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "problems = 2", "problems = 12");
    bench.edit("mini/paper.toml", "metric = \"nodes\"", "metric = \"plan_time_us\"");
    let judged = bench.done(&["repro", "./mini", "--all"]);
    let line = judged.lines().find(|line| line.starts_with("nodes ")).unwrap();
    let solved = line.split_whitespace().find(|word| word.contains('/')).unwrap();
    let failed = judged_failures(&bench);
    assert!(failed > 0, "no instance fails, so that none could be counted wrongly");
    assert!(solved.ends_with("/12"), "12 of 24 instances are timed, and {solved} are counted\n{judged}");
}

/// A table of the times of every session.
const TIMES: &str = "[[results]]\nid = \"times\"\ncaption = \"Times\"\nstudy = \"draws\"\nrows = [\"A*\"]\n\
     cells = [{ metric = \"plan_time_us\", show = \"sessions\", decimals = 6 }]\n\
     [[results.block]]\ntitle = \"Drawn\"\nproblems = \"drawn\"\n";

#[test]
fn a_claim_about_time_says_what_each_session_of_the_clock_found() {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "problems = 2", "problems = 12");
    bench.edit("mini/paper.toml", "metric = \"nodes\"", "metric = \"plan_time_us\"");
    bench.edit("mini/paper.toml", "[[claim]]", &format!("{TIMES}\n[[claim]]"));
    bench.done(&["repro", "./mini"]);
    let found = |bench: &Bench| -> Vec<String> {
        let shown = bench.done(&["show", "./mini", "nodes"]).split_whitespace().collect::<Vec<_>>().join(" ");
        let after = |text: &str| shown.split_once(text).unwrap().1.to_owned();
        let ours = after("ours: ").split_once(']').unwrap().0.to_owned() + "]";
        let sessions = after("sessions of the clock, each judged by itself: ");
        let found: Vec<String> =
            sessions.split_inclusive(']').map(|one| one.trim_start_matches("; ").to_owned()).collect();
        // Beside the claim it is rounded to its interval.
        let whole = |text: &str| {
            text.split(['[', ',', ']']).filter_map(|one| one.trim().parse().ok()).collect::<Vec<f64>>()
        };
        let [own, rounded] = [whole(&found[0]), whole(&ours)];
        assert!(
            own.len() == 3 && own.iter().zip(&rounded).all(|(own, rounded)| (own - rounded).abs() < 1.0),
            "{shown}"
        );
        found.into_iter().take_while(|one| one.ends_with(']')).collect()
    };
    assert_eq!(found(&bench).len(), 1);
    bench.done(&["run", "./mini", "--clock"]);
    bench.done(&["run", "./mini", "--clock"]);
    bench.done(&["judge", "./mini"]);
    let three = found(&bench);
    assert_eq!(three.len(), 3, "{three:?}");
    assert!(three[0] != three[1] && three[1] != three[2], "{three:?}");
    bench.done(&["render", "./mini"]);
    let table = fs::read_to_string(bench.at("target/replan/mini/plots/mini/times.tex")).unwrap();
    let row = table.lines().find(|line| line.contains("A*") && line.contains("cdot")).unwrap();
    let medians: Vec<f64> = row
        .trim_end_matches(['\\', ' '])
        .rsplit('&')
        .next()
        .unwrap()
        .split("\\ensuremath{\\cdot}")
        .map(|median| median.trim().parse().unwrap())
        .collect();
    assert_eq!(medians.len(), 3, "{row}");
    assert!(medians.iter().all(|median| *median > 0.0) && medians[0] != medians[1], "{row}");
}

/// How many instances the same paper counts as failed when it asks for what every trial has.
fn judged_failures(bench: &Bench) -> u32 {
    bench.edit("mini/paper.toml", "metric = \"plan_time_us\"", "metric = \"nodes\"");
    let judged = bench.done(&["judge", "./mini"]);
    let line = judged.lines().find(|line| line.starts_with("nodes ")).unwrap();
    let (solved, all) = line.split_whitespace().find_map(|word| word.split_once('/')).unwrap();
    all.parse::<u32>().unwrap() - solved.parse::<u32>().unwrap()
}
