//! Runs from the command line: where outputs go, what repeats, what is reused.

use crate::paper::{Bench, CONTENDERS_END};
use std::fs;

const RUNS: &str = "target/replan/mini/data/runs/mini";

#[test]
fn any_number_of_threads_writes_equal_bytes_and_outputs_repeat() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini", "--threads", "1", "--out", "a"]);
    bench.done(&["repro", "./mini", "--threads", "2", "--out", "b"]);
    let (one, two) = (bench.facts("a"), bench.facts("b"));
    assert_eq!(one.len(), 6, "{:?}", one.keys());
    assert!(one == two, "records differ between 1 thread and 2");
    for name in ["plots/mini/fig1.svg", "plots/mini/fig1.png"] {
        assert!(
            fs::read(bench.at(&format!("a/{name}"))).unwrap()
                == fs::read(bench.at(&format!("b/{name}"))).unwrap()
        );
    }
}

#[test]
fn render_writes_what_repro_wrote_byte_for_byte_and_check_notices_an_edit() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let before = bench.tree("target/replan/mini");
    assert_eq!(bench.done(&["render", "./mini", "--check"]), "6 files are current\n");
    bench.done(&["render", "./mini"]);
    assert!(bench.tree("target/replan/mini") == before, "render changed what repro wrote");
    for name in ["plots/mini/fig1.svg", "plots/mini/table1.tex", "plots/mini/details.md", "paper_repro.md"] {
        let path = bench.at(&format!("target/replan/mini/{name}"));
        let whole = fs::read_to_string(&path).unwrap();
        fs::write(&path, whole.replacen("attainable", "obtainable", 1).replacen("made by", "mad by", 1))
            .unwrap();
        let output = bench.run(&["render", "./mini", "--check"]);
        assert_eq!(
            (output.code, output.err),
            (Some(3), format!("replan: not current: target/replan/mini/{name}\n"))
        );
        fs::write(&path, whole).unwrap();
    }
    fs::remove_file(bench.at("target/replan/mini/plots/mini/fig1.png")).unwrap();
    assert_eq!(bench.run(&["render", "./mini", "--check"]).code, Some(3));
    bench.done(&["render", "./mini", "--only", "fig1"]);
    assert!(bench.tree("target/replan/mini") == before, "--only fig1 did not bring the figure back");
    let output = bench.run(&["render", "./mini", "--only", "fig9"]);
    assert_eq!(output.code, Some(2));
    let known =
        "nothing like a figure or table `fig9` (did you mean `fig1`?); there are fig1, table1, numbers";
    assert!(output.err.contains(known), "{}", output.err);
}

#[test]
fn a_quick_run_is_marked_in_every_output_and_lies_elsewhere() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let before = bench.tree("target/replan/mini");
    let out = bench.done(&["repro", "./mini", "--quick"]);
    assert!(bench.tree("target/replan/mini") == before, "a quick run wrote where full runs lie");
    assert!(out.contains("a quick run: few instances, so these verdicts are not the study's"), "{out}");
    let read = |name: &str| fs::read_to_string(bench.at("target/replan/mini-quick").join(name)).unwrap();
    let marked = "Quick run: few instances, not the study's result.";
    assert!(read("paper_repro.md").contains(marked));
    assert!(read("plots/mini/table1.tex").contains(marked));
    assert!(read("plots/mini/numbers.tex").contains(marked));
    assert!(read("data/runs/mini/draws.manifest.toml").contains("quick = true"));
    assert!(read("data/runs/mini/verdicts.toml").contains("quick = true"));
    let figures = ["target/replan/mini", "target/replan/mini-quick"]
        .map(|root| fs::read_to_string(bench.at(root).join("plots/mini/fig1.svg")).unwrap());
    assert_ne!(figures[0], figures[1], "the quick figure does not say so");
    assert_eq!(bench.facts("target/replan/mini").len(), bench.facts("target/replan/mini-quick").len());
}

#[test]
fn a_trial_run_alone_equals_its_stored_row_and_a_wrong_row_is_noticed() {
    let bench = Bench::new();
    let trial = ["repro", "./mini", "--trial", "draws/drawn/5/two-sided"];
    assert!(bench.done(&trial).ends_with("no stored run has this trial\n"));
    bench.done(&["repro", "./mini"]);
    let before = bench.tree("target/replan/mini");
    let out = bench.done(&trial);
    assert!(out.ends_with("equals the stored row\n"), "{out}");
    assert!(out.contains("\nopened ") && out.contains("\nseed "), "{out}");
    let room = bench.done(&["repro", "./mini", "--trial", "room/room/a-star"]);
    for out in [&out, &room] {
        assert!(out.contains("\npath                   [0.0, 0.0] ["), "the path is not shown: {out}");
    }
    assert!(bench.tree("target/replan/mini") == before, "--trial wrote something");
    bench.edit("mini/draws.toml", "seed = 7", "seed = 9");
    let output = bench.run(&trial);
    assert_eq!(output.code, Some(3), "{}", output.out);
    assert_eq!(
        output.err,
        "replan: trial draws/drawn/5/two-sided is not what is stored; the stored row stands above\n"
    );
}

#[test]
fn what_is_unchanged_is_reused_and_why_says_what_changed() {
    let bench = Bench::new();
    let why = |flags: &[&str]| bench.done(&[&["run", "./mini", "--why"], flags].concat());
    let says =
        |out: &str, line: &str| assert!(out.lines().any(|l| l == line), "{line}\nis missing in\n{out}");
    says(&why(&[]), "draws: 48 trials");
    let manifest = fs::read_to_string(bench.at(&format!("{RUNS}/draws.manifest.toml"))).unwrap();
    assert!(manifest.contains("command = \"replan run ./mini\"\n"), "{manifest}");
    let first = bench.facts(RUNS);
    let records = bench.tree(RUNS);
    let again = why(&[]);
    says(&again, "draws: 48 trials (24 of 24 units reused)");
    says(&again, "  why: nothing that the stored trials depend on has changed");
    let is_record = |path: &std::path::Path| path.extension().is_some_and(|ending| ending == "parquet");
    assert!(bench.tree(RUNS).iter().filter(|(path, _)| is_record(path)).all(|(p, b)| records[p] == *b));

    bench.edit("mini/draws.toml", "instances = 24", "instances = 30");
    says(&why(&[]), "draws: 60 trials (24 of 30 units reused)");
    bench.edit("mini/draws.toml", "instances = 30", "instances = 24");
    says(&why(&[]), "draws: 48 trials (24 of 24 units reused)");
    assert!(bench.facts(RUNS) == first, "reuse brought other records than a run");

    bench.edit("mini/draws.toml", "ties = \"fifo\" }\n\n", "ties = \"lifo\" }\n\n");
    let changed = why(&[]);
    says(&changed, "draws: 48 trials (24 of 48 trials reused)");
    says(&changed, "  why: contender `A*` has changed");
    says(&changed, "room: 1 trial (1 of 1 units reused)");
    bench.edit("mini/draws.toml", "blocked_share = 0.3", "blocked_share = 0.2");
    says(&why(&[]), "  why: problem group `drawn` has changed");
    says(&why(&["--fresh"]), "draws: 48 trials");
}

#[test]
fn trials_that_ended_in_an_unexpected_way_are_counted_with_the_first_reason() {
    let bench = Bench::new();
    let whole = bench.done(&["run", "./mini"]);
    assert!(whole.starts_with("draws: 48 trials\nroom: 1 trial\n"), "{whole}");
    bench.edit("mini/draws.toml", "expansions = 10_000", "expansions = 3");
    let study = "paper = \"mini\"\nquestion = \"q\"\nseed = 9\n[budget]\nexpansions = 9\n[quick]\ninstances = 1\n\
                 [[problems]]\nlabel = \"lake\"\nfamily = \"movingai\"\n\
                 settings = { map = \"m.map\", scenarios = \"m.scen\" }\n\
                 [[contender]]\nlabel = \"A*\"\nplanner = \"astar\"\nsettings = { weight = 1, ties = \"fifo\" }\n";
    bench.write("mini/lake.toml", study.as_bytes());
    bench.write("mini/m.map", b"type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n");
    bench.write("mini/m.scen", b"version 1\n0\tm.map\t3\t2\t1\t0\t2\t0\t6\n0\tm.map\t3\t2\t1\t0\t0\t0\t6\n");
    for again in [false, true] {
        let out = bench.done(&["run", "./mini"]);
        let lines: Vec<&str> = out.lines().collect();
        let [draws, spent, lake, invalid, room, _] = lines[..] else { panic!("again {again}:\n{out}") };
        let studies = [(draws, "draws: 48 trials"), (lake, "lake: 2 trials"), (room, "room: 1 trial")];
        assert!(studies.iter().all(|(line, start)| line.starts_with(start)), "{out}");
        let (count, first) = spent.trim().split_once(' ').unwrap();
        assert!((24..=48).contains(&count.parse::<u32>().unwrap()), "{out}");
        assert!(first.starts_with("budget_spent; the first is draws/drawn/"), "{out}");
        assert!(first.ends_with(": budget of 3 expansions spent"), "{out}");
        let (count, reason) = invalid.split_once(": ").unwrap();
        assert!(count.starts_with("  2 invalid_problem; the first is lake/lake/"), "{out}");
        assert_eq!(reason, "the start [1.0, 1.0] is blocked");
    }
}

#[test]
fn a_figure_or_keep_added_later_gets_its_traces_and_another_timing_its_readings() {
    let bench = Bench::new();
    bench.done(&["run", "./mini"]);
    let before = bench.tree(RUNS);
    let part = |tree: &std::collections::BTreeMap<std::path::PathBuf, Vec<u8>>, name: &str| {
        tree[&bench.at(&format!("{RUNS}/draws.{name}.parquet"))].clone()
    };
    bench.edit(
        "mini/draws.toml",
        CONTENDERS_END,
        &format!("{CONTENDERS_END}\n[[keep]]\nproblems = \"drawn\"\ninstances = 2\n"),
    );
    bench.done(&["run", "./mini"]);
    let kept = bench.tree(RUNS);
    assert!(part(&kept, "traces").len() > part(&before, "traces").len(), "no trace was kept");
    assert!(part(&kept, "trials") == part(&before, "trials"), "keeping traces changed rows");
    bench.edit("mini/draws.toml", "repeats = 2", "repeats = 40");
    bench.done(&["run", "./mini"]);
    assert!(
        part(&bench.tree(RUNS), "times").len() > part(&kept, "times").len(),
        "the clock was not read again"
    );
}

#[test]
fn a_question_a_caption_and_a_comment_make_no_run_stale() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let runs = bench.tree(RUNS);
    bench.edit("mini/draws.toml", "Which side opens more?", "Who opens more?");
    bench.edit("mini/draws.toml", "[timing]", "# Twice on each.\n[timing]");
    bench.edit("mini/room.toml", "A search in a room.", "The search in the room.");
    bench.done(&["judge", "./mini", "--check"]);
    bench.done(&["run", "./mini"]);
    assert!(bench.tree(RUNS) == runs, "words or figures changed what is stored");
}

#[test]
fn a_change_that_runs_no_trial_again_keeps_the_times_and_what_made_them() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let read = |name: &str| fs::read(bench.at(&format!("{RUNS}/draws.{name}"))).unwrap();
    let times = read("times.parquet");
    let manifest = read("manifest.toml");
    bench.edit("mini/draws.toml", "[quick]\ninstances = 3", "[quick]\ninstances = 4");
    bench.done(&["run", "./mini"]);
    let again = String::from_utf8(read("manifest.toml")).unwrap();
    assert!(again.as_bytes() != manifest, "the manifest is of the former spec");
    assert!(again.contains("command = \"replan repro ./mini\"\n"), "{again}");
    assert!(read("times.parquet") == times, "the clock was read again though no trial was");
}

#[test]
fn help_has_examples_and_nothing_is_coloured_in_a_pipe() {
    let bench = Bench::new();
    let help = bench.done(&["--help"]);
    assert!(help.contains("Examples:\n  replan repro zhang "), "{help}");
    for command in ["repro", "check", "run", "judge", "render", "list"] {
        assert!(help.contains(&format!("\n  {command} ")), "{help}");
        assert!(bench.done(&[command, "--help"]).contains("Usage: replan "), "{command}");
    }
    bench.done(&["run", "./mini"]);
    let output = bench.run(&["repro", "./mini", "--quick"]);
    assert!(output.out.contains("verdict"), "{}", output.out);
    for text in [&help, &output.out, &output.err, &bench.run(&["repro"]).err] {
        assert!(!text.contains('\x1b'), "{text}");
    }
}

#[test]
fn repro_runs_what_is_stale_and_fresh_runs_everything_without_losing_a_byte() {
    let bench = Bench::new();
    let repro = |flags: &[&str]| bench.done(&[&["repro", "./mini"], flags].concat());
    assert!(repro(&[]).starts_with("draws: 48 trials\n"));
    let first = bench.tree("target/replan/mini");
    assert!(repro(&[]).starts_with("2 studies: nothing to run, the stored trials are current\n"));
    assert!(repro(&["--all"]).starts_with("draws: 48 trials (24 of 24 units reused)\n"));
    assert!(bench.tree("target/replan/mini") == first, "a run with nothing to do changed something");
    let facts = bench.facts("target/replan/mini");
    assert!(repro(&["--fresh"]).starts_with("draws: 48 trials\n"));
    assert!(bench.facts("target/replan/mini") == facts);
}

#[test]
fn contenders_take_turns_at_the_clock() {
    let bench = Bench::new();
    bench.edit("mini/draws.toml", "repeats = 2", "repeats = 9");
    let out = bench.run(&["run", "./mini"]);
    assert!(out.err.contains("draws: clock: 8 units in "), "2 problems in 4 passes: {}", out.err);
}

#[test]
fn check_names_what_an_earlier_state_of_the_paper_left_behind() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    bench.write("target/replan/mini/plots/mini/fig7.svg", b"old");
    let output = bench.run(&["render", "./mini", "--check"]);
    let left = "replan: left over from before; remove: target/replan/mini/plots/mini/fig7.svg\n";
    assert_eq!((output.code, output.err.as_str()), (Some(3), left));
    let path = bench.at("target/replan/mini/paper_repro.md");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text + "\nMy remark on plots/mini/fig7.svg.\n").unwrap();
    assert!(bench.done(&["render", "./mini", "--check"]).ends_with(" files are current\n"));
}

#[test]
fn a_figure_that_cannot_be_drawn_costs_that_figure_alone() {
    let bench = Bench::new();
    let figure = "\n[[figure]]\nid = \"fig2\"\nkind = \"grid_search\"\ncaption = \"Tidied.\"\n\
                  settings = { problems = [\"room\"], contenders = [\"A*\"], tidying = true }\n";
    let room = fs::read_to_string(bench.at("mini/room.toml")).unwrap();
    bench.write("mini/room.toml", (room + figure).as_bytes());
    let plots = "target/replan/mini/plots/mini";
    bench.write(&format!("{plots}/fig2.png"), b"an older picture");
    let why = "figure `room:fig2`: the stored run and the paper have nothing like";
    let output = bench.run(&["repro", "./mini"]);
    assert_eq!(output.code, Some(3), "{}", output.err);
    assert!(output.err.contains(&format!("replan: 1 figure could not be drawn: {why}")), "{}", output.err);
    for name in ["fig1.svg", "fig1.png", "table1.tex", "numbers.tex"] {
        assert!(bench.at(plots).join(name).is_file(), "{name}");
    }
    assert!(!bench.at(plots).join("fig2.png").exists(), "a picture of something else was left");
    let report = fs::read_to_string(bench.at("target/replan/mini/paper_repro.md")).unwrap();
    assert!(report.contains(&format!("**fig2 could not be drawn: {why}")), "{report}");
    assert!(report.contains("![fig1](plots/mini/fig1.png)") && !report.contains("![fig2]"), "{report}");
    let output = bench.run(&["render", "./mini", "--check"]);
    assert!(output.code == Some(3) && output.err.contains(why), "{}", output.err);
}

#[test]
fn claims_are_judged_again_only_where_something_changed() {
    let bench = Bench::new();
    let judges = |arguments: &[&str]| {
        let output = bench.run(arguments);
        assert_eq!(output.code, Some(0), "{}", output.err);
        output.doing.iter().any(|line| line.starts_with("mini: judging "))
    };
    let is_judged = || judges(&["repro", "./mini"]);
    assert!(is_judged());
    let path = bench.at("target/replan/mini/data/runs/mini/verdicts.toml");
    let verdicts = fs::read(&path).unwrap();
    assert!(!is_judged() && fs::read(&path).unwrap() == verdicts);
    // Verdicts that were edited, or that a changed claim or changed records make old, are judged again.
    fs::write(&path, b"paper = 'mini'\n").unwrap();
    assert!(is_judged() && fs::read(&path).unwrap() == verdicts && !is_judged());
    bench.edit("mini/paper.toml", "two sides open fewer nodes", "two sides open no more nodes");
    assert!(is_judged() && !is_judged());
    bench.edit("mini/draws.toml", "blocked_share = 0.3", "blocked_share = 0.2");
    assert!(is_judged() && !is_judged());
    // So is what an exploration has joined: one that cannot be read is noticed.
    let explored = path.with_file_name("estimates.parquet");
    fs::write(&explored, b"torn").unwrap();
    assert!(bench.run(&["repro", "./mini"]).err.contains("estimates.parquet"));
    fs::remove_file(&explored).unwrap();
    assert!(!is_judged());
    // `judge` believes no stamp, nor does `--fresh`.
    assert!(judges(&["judge", "./mini"]) && judges(&["repro", "./mini", "--fresh"]));
}

#[test]
fn what_is_drawn_is_drawn_again_only_where_something_changed() {
    let bench = Bench::new();
    let is_drawn = || !bench.done(&["repro", "./mini"]).contains("\nnothing to draw: ");
    assert!(is_drawn() && !is_drawn());
    let plots = bench.tree("target/replan/mini/plots");
    let figure = "target/replan/mini/plots/mini/fig1.svg";
    // A file that was touched, or is gone, is drawn again.
    bench.write(figure, b"<svg/>");
    assert!(is_drawn() && bench.tree("target/replan/mini/plots") == plots);
    std::fs::remove_file(bench.at(figure)).unwrap();
    assert!(is_drawn() && bench.tree("target/replan/mini/plots") == plots && !is_drawn());
    bench.edit("target/replan/mini/paper_repro.md", "\n", "\n\n");
    assert!(is_drawn() && !is_drawn());
    // So is what is made from something else: a caption, a claim, records.
    bench.edit("mini/room.toml", "A search in a room.", "A search in one room.");
    assert!(is_drawn() && !is_drawn());
    bench.edit("mini/paper.toml", "two sides open fewer nodes", "two sides open no more nodes");
    assert!(is_drawn() && !is_drawn());
    bench.edit("mini/draws.toml", "blocked_share = 0.3", "blocked_share = 0.2");
    assert!(is_drawn() && !is_drawn());
    // A check believes no stamp, and `--fresh` and `render` draw whatever was drawn.
    bench.write(figure, b"<svg/>");
    assert_eq!(bench.run(&["render", "./mini", "--check"]).code, Some(3));
    assert!(bench.done(&["render", "./mini"]).contains(" files are in "));
    assert!(!bench.done(&["repro", "./mini", "--fresh"]).contains("nothing to draw"));
}
