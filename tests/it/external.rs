//! Planners from outside: whatever one does is the outcome of its own trial and of no other.

mod arm;
mod endings;
pub mod law;
mod marks;
mod scripts;
mod trust;

use crate::paper::Bench;
use scripts::{CASES, Case, PRELUDE, SHORTER, SILENT};
use std::collections::BTreeMap;
use std::fs;
use study::record::Row;
use study::reuse;

const STUDY: &str = r#"paper = "outside"
question = "Who misbehaves?"
seed = 3

[budget]
expansions = 100_000

[[problems]]
label = "wall"
family = "grid_map"
settings = { map = "wall.map.txt", start = [0, 1], goal = [299, 200], corner_rule = "allow" }

[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 1, ties = "fifo" }
"#;

const PAPER: &str = "[source]\ntitle = \"Outside\"\nauthors = \"N. N.\"\n\n[prints]\nfigures = 0\ntables = 0\nequations = 0\n";

fn contender(name: &str, command: &str, files: &str) -> String {
    format!(
        "\n[[contender]]\nlabel = \"{name}\"\nplanner = \"external\"\nsettings = {{ command = {command}, files = {files}, version = \"1\", \
         time_s = 60.0, memory_mb = 128, output_mb = 4, any_angle = true, install = \"a shell\" }}\n"
    )
}

/// A map of 300 by 210 cells, too large for a pipe; one cell of its first and of its last row is blocked.
fn map() -> String {
    let row = |y: usize| {
        (0..300).map(|x| if x == 150 && [0, 209].contains(&y) { '#' } else { '.' }).collect::<String>()
    };
    (0..210).map(|y| row(y) + "\n").collect()
}

/// A paper whose study has A* and these planners.
fn bench(cases: &[&Case]) -> Bench {
    let bench = Bench::empty();
    let mut study = STUDY.to_owned();
    for case in cases {
        let file = format!("outside/{}.sh", case.name);
        bench.write(&file, format!("{PRELUDE}{}\n", case.script).as_bytes());
        let text = contender(case.name, &format!("[\"sh\", \"{file}\"]"), &format!("[\"{file}\"]"));
        study += &text.replace("time_s = 60.0", &format!("time_s = {}", case.time_s()));
    }
    bench.write("outside/paper.toml", PAPER.as_bytes());
    bench.write("outside/study.toml", study.as_bytes());
    bench.write("outside/wall.map.txt", map().as_bytes());
    bench
}

fn rows(bench: &Bench) -> BTreeMap<String, Row> {
    let (_, records) = reuse::stored(&bench.at("target/replan/outside/data/runs/outside"), "study").unwrap();
    records.batch.rows.into_iter().map(|row| (row.key.contender.to_string(), row)).collect()
}

/// Processes of this machine whose command line holds `text`: the number and the command line of each.
fn processes(text: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir("/proc").unwrap().flatten();
    let lines = entries.filter_map(|entry| {
        let line = fs::read(entry.path().join("cmdline")).ok()?;
        let line = String::from_utf8_lossy(&line).replace('\0', " ");
        Some((entry.file_name().into_string().ok()?, line))
    });
    lines.filter(|(_, line)| line.contains(text)).collect()
}

/// Their command lines.
fn alive(text: &str) -> Vec<String> {
    processes(text).into_iter().map(|(_, line)| line).collect()
}

fn check(row: &Row, case: &Case) {
    let reason = row.reason.clone().unwrap_or_default();
    assert_eq!(row.status.name(), case.status, "{}: {reason}", case.name);
    assert!(reason.contains(case.reason), "{}: should say {}\nsays {reason}", case.name, case.reason);
}

#[test]
fn every_way_to_misbehave_is_the_status_of_one_row_and_costs_no_other_trial() {
    let cases: Vec<&Case> = CASES.iter().collect();
    let bench = bench(&cases);
    let mut runs = 0;
    for control_groups in ["", "off"] {
        let mut run = bench.command(&["run", "./outside", "--trust", "--record"]);
        let run = run.env("REPLAN_TEST_SECRET", "secret").env("REPLAN_CONTROL_GROUPS", control_groups);
        let run = run.output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let rows = rows(&bench);
        assert_eq!(rows.len(), cases.len() + 1);
        for case in &cases {
            check(&rows[case.name], case);
            runs += 1;
        }
        assert!(rows["A*"].is_solved());
        let straight = libm::hypot(299.0, 199.0);
        for name in ["good", "one-query-each", "loud-log", "cut-off", "good-after-all"] {
            let length = rows[name].value("path_cost_cells").unwrap();
            assert!((length - straight).abs() < 1e-9, "{name}: {length}");
        }
        assert_eq!(rows["cut-off"].value("is_cut_off"), Some(1.0));
        assert_eq!(rows["good"].value("is_cut_off"), Some(0.0));
        let named = String::from_utf8_lossy(&run.stderr).into_owned();
        let is_over = || alive("fork-chain.sh on").is_empty();
        assert!(soon(is_over) || named.contains("could not be ended"), "a chain of forks goes on: {named}");
        for seconds in ["sleep 1001", "sleep 1002", "sleep 1003", "sleep 1004"] {
            assert_eq!(alive(seconds), [""; 0], "left alone");
        }
    }
    assert!(runs >= 90, "{runs} runs of planners");
}

/// Whether `is_so` within three seconds.
fn soon(is_so: impl Fn() -> bool) -> bool {
    soon_within(3, is_so)
}

/// Whether `is_so` within so many seconds, or longer on a busy machine: rounds are counted.
fn soon_within(seconds: u32, is_so: impl Fn() -> bool) -> bool {
    (0..seconds * 100).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        is_so()
    })
}

/// Whether the process has ended, though nobody has waited for it.
fn run_has_ended(pid: u32) -> bool {
    fs::read_to_string(format!("/proc/{pid}/stat")).map_or(true, |stat| stat.contains(") Z "))
}

#[test]
fn a_path_shorter_than_the_optimum_is_refused_with_the_end_of_the_planners_log() {
    // Over a step that the grid has not, and through a blocked cell.
    for (any_angle, [start, goal], refused) in [
        (false, [[0, 1], [299, 200]], "is not one of the eight moves"),
        (true, [[149, 0], [151, 0]], "enters the blocked cell [150, 0]"),
    ] {
        let bench = bench(&[&SHORTER]);
        bench.edit("outside/study.toml", "any_angle = true", &format!("any_angle = {any_angle}"));
        let ends = format!("start = {start:?}, goal = {goal:?}");
        bench.edit("outside/study.toml", "start = [0, 1], goal = [299, 200]", &ends);
        bench.done(&["run", "./outside", "--trust"]);
        let rows = rows(&bench);
        let row = &rows[SHORTER.name];
        check(row, &SHORTER);
        assert!(row.reason.as_ref().unwrap().contains(refused), "{:?}", row.reason);
        let straight = libm::hypot(f64::from(goal[0] - start[0]), f64::from(goal[1] - start[1]));
        let optimal = row.value("optimal_cost_cells").unwrap();
        assert!(straight < optimal, "{straight} is no shorter than {optimal}");
    }
}

#[test]
fn a_planner_that_never_says_hello_is_given_up_after_ten_seconds() {
    let bench = bench(&[&SILENT]);
    bench.done(&["run", "./outside", "--trust"]);
    let rows = rows(&bench);
    check(&rows[SILENT.name], &SILENT);
    assert!(rows["A*"].is_solved());
}

#[test]
fn recorded_trials_are_kept_by_fresh_and_run_again_by_record_or_where_a_file_changed() {
    let good = CASES.iter().find(|case| case.name == "good").unwrap();
    let bench = bench(&[good]);
    bench.done(&["run", "./outside", "--trust"]);
    let clock = |bench: &Bench| rows(bench)["good"].value("solve_wall_ns").unwrap();
    let first = clock(&bench);
    bench.done(&["run", "./outside", "--trust", "--fresh"]);
    assert_eq!(clock(&bench), first, "--fresh ran a recorded trial again");
    bench.done(&["run", "./outside", "--trust", "--record"]);
    let second = clock(&bench);
    assert_ne!(second, first, "--record kept a recorded trial");
    let text = fs::read_to_string(bench.at("outside/good.sh")).unwrap();
    bench.write("outside/good.sh", format!("{text}# another\n").as_bytes());
    bench.done(&["run", "./outside", "--trust"]);
    assert_ne!(clock(&bench), second, "a changed program's trial was kept");
}

#[test]
fn recorded_trials_outlive_a_damaged_file_that_is_not_theirs() {
    let good = CASES.iter().find(|case| case.name == "good").unwrap();
    let bench = bench(&[good]);
    bench.done(&["run", "./outside", "--trust"]);
    let clock = |bench: &Bench| rows(bench)["good"].value("solve_wall_ns").unwrap();
    let first = clock(&bench);
    for (part, is_kept) in [("preprocessing", true), ("trials", false)] {
        let file = format!("target/replan/outside/data/runs/outside/study.{part}.parquet");
        let mut bytes = fs::read(bench.at(&file)).unwrap();
        bytes[20] ^= 1;
        bench.write(&file, &bytes);
        assert_eq!(bench.run(&["run", "./outside", "--trust"]).code, Some(2));
        bench.done(&["run", "./outside", "--trust", "--replace-damaged"]);
        assert_eq!(rows(&bench).len(), 2, "{part}");
        assert_eq!(clock(&bench) == first, is_kept, "{part}");
        assert_eq!(fs::read(bench.at(&format!("{file}.damaged-1"))).unwrap(), bytes);
    }
}

#[test]
fn without_its_program_a_run_says_what_to_install_and_stored_trials_stay_readable() {
    let bench = bench(&[]);
    let program = "[\"./outside/planner\"]";
    let study =
        STUDY.to_owned() + &contender("theirs", program, "[]").replace("a shell", "pip install theirs");
    bench.write("outside/study.toml", study.as_bytes());
    let output = bench.run(&["run", "./outside", "--trust"]);
    assert_eq!(output.code, Some(4), "{}", output.err);
    let lacks = "contender `theirs` cannot run: there is no program `./outside/planner`; to install: pip install theirs";
    assert!(output.err.contains(lacks), "{}", output.err);
    let good = CASES.iter().find(|case| case.name == "good").unwrap();
    bench.write("outside/planner", format!("{PRELUDE}{}\n", good.script).as_bytes());
    let mut mode = fs::metadata(bench.at("outside/planner")).unwrap().permissions();
    std::os::unix::fs::PermissionsExt::set_mode(&mut mode, 0o755);
    fs::set_permissions(bench.at("outside/planner"), mode).unwrap();
    bench.done(&["run", "./outside", "--trust"]);
    fs::remove_file(bench.at("outside/planner")).unwrap();
    bench.done(&["run", "./outside", "--trust"]);
    bench.done(&["judge", "./outside"]);
    assert!(rows(&bench)["theirs"].is_solved());
}

#[test]
fn conformance_keeps_count_of_what_is_broken_and_its_exit_code_says_so() {
    let cases = ["crash", "other-id", "rubbish-first", "no-cost", "counter-in-parts", "nowhere", "hang"];
    let bench = bench(&CASES.iter().filter(|case| cases.contains(&case.name)).collect::<Vec<_>>());
    for (name, broken) in [
        ("crash", "BROKEN  query 1 ends with a result: the planner ended before its result"),
        ("other-id", "BROKEN  query 1 ends with a result: the planner answers query 77"),
        ("rubbish-first", "BROKEN  it says `hello` within ten seconds: the planner wrote `Welcome!`"),
        ("no-cost", "which is no message: JSON has no number `-Infinity`, at column"),
        (
            "counter-in-parts",
            "BROKEN  query 1 ends with a result: the planner counts 1.5 `samples`; a whole number",
        ),
        (
            "nowhere",
            "BROKEN  query 1 is solved and the verifier accepts its path: rejected: the path is empty",
        ),
        (
            "hang",
            "BROKEN  query 1 ends in time: 2 s were not enough; it wrote nothing: an output that is buffered",
        ),
    ] {
        let output = bench.run(&["conformance", "--", "sh", &format!("outside/{name}.sh")]);
        assert!(
            output.out.contains(broken),
            "{name}: should say {broken}\nsays {}{}",
            output.out,
            output.err
        );
        assert_eq!(output.code, Some(3), "{name}: {}", output.err);
        if name == "nowhere" {
            assert!(output.out.contains("BROKEN  some query is solved: none was"), "{}", output.out);
        }
    }
    let honest = r#"hello; query; printf '{"type":"result","id":%s,"status":"no_path"}\n' "$id"; query"#;
    bench.write("outside/honest.sh", format!("{PRELUDE}{honest}\n").as_bytes());
    let output = bench.run(&["conformance", "--", "sh", "outside/honest.sh"]);
    assert!(output.out.contains("BROKEN  some query is solved: none was"), "{}", output.out);
    assert_eq!(bench.run(&["conformance", "--", "./no/such/planner"]).code, Some(4));
}
