//! The cross-check from the command line: what replan answers, what it refuses, and how it starts the judge in Python.

use crate::paper::Bench;
use polars::prelude::DataFrame;
use std::fs;
use std::path::{Path, PathBuf};
use study::parquet::FrameReader;

/// Where answers lie in a bench.
const ANSWERS: &str = "out/target/replan/crosscheck/judged";
/// What a case must be asked before anything of it is answered.
const CASES: [&str; 2] = ["up6-in-room", "gantry-in-room"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Questions about the cases of the paper `judged`, and what replan answers to them.
fn kept() -> PathBuf {
    root().join("crosscheck/tests/fixtures")
}

/// A folder with the paper `judged`.
fn bench() -> Bench {
    let bench = Bench::new();
    for name in ["paper.toml", "crosscheck.toml", "room.toml", "gantry.urdf", "gantry.srdf"] {
        let file = root().join("tests/it/crosscheck").join(name);
        bench.write(&format!("judged/{name}"), &fs::read(file).unwrap());
    }
    let robot = root().join("data/robots/motoman_up6.toml");
    bench.write("data/robots/motoman_up6.toml", &fs::read(robot).unwrap());
    bench.write("crosscheck/requirements.txt", b"mujoco==4.0.0\n");
    bench
}

/// Puts a Python into the bench that runs `body` when it is called for the module `judge`.
fn python(bench: &Bench, body: &str) {
    let script = format!(
        "#!/bin/sh\ncase \"$2\" in\n  venv) mkdir -p \"$4/bin\" && cp \"$0\" \"$4/bin/python\";;\n  pip) ;;\n  judge) {body};;\n\
         \x20 *) echo 3 11;;\nesac\n"
    );
    bench.write("python", script.as_bytes());
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    fs::set_permissions(bench.at("python"), mode).unwrap();
}

/// A shell's words that bring the questions about `cases` that are kept to where the judge would write them.
fn copied(cases: [&str; 2]) -> String {
    let of_case = |case: &str| {
        format!("mkdir -p \"$4/{case}\" && cp {}/{case}/*.questions.parquet \"$4/{case}/\"", kept().display())
    };
    cases.map(of_case).join(" && ")
}

fn frame_at(path: &Path) -> DataFrame {
    FrameReader::open(fs::File::open(path).unwrap()).unwrap().frame().unwrap()
}

#[test]
fn what_replan_answers_is_what_the_judge_is_tested_with() {
    let bench = bench();
    python(&bench, &format!("{}; echo done", copied(CASES)));
    let output = bench.run(&["crosscheck", "./judged", "--out", "out", "--python", "./python"]);
    assert_eq!(output.code, Some(0), "{}{}", output.out, output.err);
    for case in CASES {
        for part in ["gaps", "frames", "limits", "planners"] {
            let name = format!("{case}/replan.{part}.parquet");
            // Planners have no check of a robot with slides in a cell.
            if case == "gantry-in-room" && part == "planners" {
                assert!(!bench.at(&format!("{ANSWERS}/{name}")).exists());
                continue;
            }
            let answered = frame_at(&bench.at(&format!("{ANSWERS}/{name}")));
            assert!(answered.height() > 20, "{name}");
            assert!(
                answered.equals(&frame_at(&kept().join(&name))),
                "{name} differs from the one that is kept"
            );
        }
    }
}

#[test]
fn the_exit_code_is_the_judges() {
    let bench = bench();
    let copy = copied(CASES);
    for (pose, report, code) in [(0, 0, 0), (0, 3, 3), (2, 0, 2), (3, 0, 3), (0, 1, 1)] {
        let made = bench.at("target/replan/crosscheck/venv/requirements.sha256");
        if made.exists() {
            fs::remove_file(made).unwrap();
        }
        python(&bench, &format!("if [ $3 = pose ]; then {copy}; exit {pose}; else exit {report}; fi"));
        let output = bench.run(&["crosscheck", "./judged", "--out", "out", "--python", "./python"]);
        assert_eq!(output.code, Some(code), "{pose} {report}: {}{}", output.out, output.err);
    }
}

#[test]
fn questions_that_do_not_fit_are_refused_by_name() {
    let bench = bench();
    let copy = "mkdir -p \"$4/up6-in-room\" && echo no > \"$4/up6-in-room/scene.questions.parquet\"";
    python(&bench, copy);
    let output = bench.run(&["crosscheck", "./judged", "--out", "out", "--python", "./python"]);
    let is_named = output.err.contains("up6-in-room/scene.questions.parquet: is no table of questions");
    assert!(output.code == Some(3) && is_named, "{}", output.err);
}

#[test]
fn without_python_or_its_packages_the_exit_code_is_4_and_the_message_says_what_to_run() {
    let bench = bench();
    let ask = |program: &str| bench.run(&["crosscheck", "./judged", "--out", "out", "--python", program]);
    let output = ask("./no-such-python");
    assert_eq!(output.code, Some(4), "{}", output.err);
    assert!(
        output.err.contains("Python 3.11 or later is needed") && output.err.contains("apt install"),
        "{}",
        output.err
    );
    // A Python that is too old, and one whose pip has no network.
    let script = |body: &str| {
        bench.write("python", format!("#!/bin/sh\n{body}\n").as_bytes());
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(bench.at("python"), mode).unwrap();
        ask("./python")
    };
    let output = script("echo 3 9");
    assert!(output.code == Some(4) && output.err.contains("`./python` is Python 3.9"), "{}", output.err);
    let output = script(
        "case \"$2\" in\n  venv) mkdir -p \"$4/bin\" && cp \"$0\" \"$4/bin/python\";;\n  pip) echo 'no route to host' >&2; exit 1;;\n\
         \x20 *) echo 3 11;;\nesac",
    );
    assert_eq!(output.code, Some(4), "{}{}", output.out, output.err);
    let is_reported = output.err.contains("no route to host") && output.err.contains("-m pip install");
    assert!(is_reported, "{}", output.err);
}

#[test]
fn a_spec_that_names_what_is_not_there_is_refused_at_its_line() {
    for (from, to, parts) in [
        ("body = \"capsules\"", "body = \"bones\"", ["crosscheck.toml:27:8", "no body `bones`"]),
        ("motoman_up6.toml", "ur5.urdf", ["crosscheck.toml:26:8", "`data/robots/ur5.urdf`"]),
        ("room.toml", "hall.toml", ["crosscheck.toml:32:8", "`hall.toml` does not exist"]),
        ("singular = 5", "single = 5", ["crosscheck.toml:13:1", "unknown key `single`"]),
    ] {
        let bench = bench();
        bench.edit("judged/crosscheck.toml", from, to);
        let output = bench.run(&["crosscheck", "./judged", "--out", "out"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(parts.iter().all(|part| output.err.contains(part)), "{parts:?}\n{}", output.err);
    }
}

#[test]
fn answers_without_a_question_are_wrong_input_and_nothing_is_written() {
    let bench = bench();
    let judged = || bench.run(&["crosscheck", "./judged", "--answered", "--out", "out"]);
    let output = judged();
    assert_eq!((output.code, output.out.as_str()), (Some(2), ""), "{}", output.err);
    let expected = "there are no answers to judge; run `replan crosscheck judged` without --answered";
    assert!(
        output.err.contains(expected) && output.err.contains("out/target/replan/crosscheck/judged: "),
        "{}",
        output.err
    );
    // Questions alone are no answers.
    bench.write(&format!("{ANSWERS}/up6-in-room/scene.questions.parquet"), b"");
    assert_eq!(judged().code, Some(2));
    assert!(!bench.at("out/plots/judged/crosscheck.md").exists());
}

#[test]
fn the_judge_of_statistics_is_given_metrics_and_papers() {
    let bench = bench();
    bench.write("crosscheck/requirements.txt", b"scipy==1.17.1\n");
    let ask =
        || bench.run(&["crosscheck", "./judged", "--statistics", "--out", "out", "--python", "./python"]);
    // A Python whose judge ends as it is told.
    let script = |code: u8| {
        let body = format!(
            "#!/bin/sh\ncase \"$2\" in\n  venv) mkdir -p \"$4/bin\" && cp \"$0\" \"$4/bin/python\";;\n  pip) ;;\n\
             \x20 statistics_judge) echo \"asked in $3\"; exit {code};;\n  *) echo 3 11;;\nesac\n"
        );
        bench.write("python", body.as_bytes());
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(bench.at("python"), mode).unwrap();
        let made = bench.at("target/replan/crosscheck/venv/requirements.sha256");
        if made.exists() {
            fs::remove_file(made).unwrap();
        }
    };
    script(0);
    let output = ask();
    assert!(output.code == Some(2) && output.err.contains("no verdicts"), "{}", output.err);
    bench.write("out/data/runs/judged/verdicts.toml", b"");
    for (ends, expected, message) in
        [(0, 0, ""), (3, 3, "differ from verdicts.toml"), (1, 1, "the judge ended")]
    {
        script(ends);
        let output = ask();
        assert_eq!(output.code, Some(expected), "{}{}", output.out, output.err);
        assert!(
            output.err.contains(message) && output.out.contains("asked in out/"),
            "{}{}",
            output.out,
            output.err
        );
    }
    let text = fs::read_to_string(bench.at("out/target/replan/crosscheck/statistics.json")).unwrap();
    let request: serde_json::Value = serde_json::from_str(&text).unwrap();
    let metric =
        request["metrics"].as_array().unwrap().iter().find(|metric| metric["name"] == "plan_time_ms");
    let expected = serde_json::json!({
        "name": "plan_time_ms", "column": "plan_wall_ns", "scale": 1e-6, "better": "lower", "clock": true, "status": false, "of_search": false, "at_most": null,
    });
    assert_eq!(metric, Some(&expected));
    assert_eq!(request["papers"].as_array().unwrap().len(), 1, "{request}");
}

/// What a set of two problems is judged in.
const SAMPLE: [&str; 2] = ["nod-1", "nod-2"];

/// A folder with the paper `set`, whose study was run.
fn bench_with_set() -> Bench {
    let bench = Bench::new();
    for entry in fs::read_dir(root().join("tests/it/crosscheck/set")).unwrap() {
        let path = entry.unwrap().path();
        bench.write(&format!("set/{}", path.file_name().unwrap().display()), &fs::read(&path).unwrap());
    }
    bench.write("crosscheck/requirements.txt", b"mujoco==4.0.0\n");
    bench.done(&["run", "./set"]);
    bench
}

#[test]
fn a_sample_of_a_set_is_run_again_and_answered_each_among_its_own_obstacles() {
    let bench = bench_with_set();
    python(&bench, &format!("if [ $3 = pose ]; then {}; fi", copied(SAMPLE)));
    let judged = || bench.run(&["crosscheck", "./set", "--out", "out", "--python", "./python"]);
    let output = judged();
    assert_eq!(output.code, Some(0), "{}{}", output.out, output.err);
    let answers = bench.at("out/target/replan/crosscheck/set");
    assert_eq!(frame_at(&answers.join("nod.traces.parquet")).height(), 2);
    for name in SAMPLE {
        for part in ["gaps", "frames", "limits", "planners"] {
            let name = format!("{name}/replan.{part}.parquet");
            let is_kept = frame_at(&answers.join(&name)).equals(&frame_at(&kept().join(&name)));
            assert!(is_kept, "{name} differs from the one that is kept");
        }
    }
    bench.edit("set/nod.toml", "seed = 4", "seed = 5");
    let output = judged();
    assert_eq!(output.code, Some(3), "{}{}", output.out, output.err);
    assert!(output.err.contains("/rrt-connect` does not come out as it is stored"), "{}", output.err);
}

#[test]
fn a_sample_is_of_trials_that_are_solved() {
    let bench = bench_with_set();
    bench.edit("set/crosscheck.toml", "sample = 2", "sample = 3");
    let output = bench.run(&["crosscheck", "./set", "--out", "out"]);
    let expected = "crosscheck.toml:27:10: `sample` is 3; 2 trials are solved in the stored run";
    assert!(output.code == Some(2) && output.err.contains(expected), "{}", output.err);
}

#[test]
fn without_the_archive_of_a_set_the_message_says_what_to_run_and_a_check_compares_nothing() {
    let bench = bench_with_set();
    fs::remove_file(bench.at("set/set.tar")).unwrap();
    let expected = "there is no file `set.tar`; to install: bring it";
    let output = bench.run(&["crosscheck", "./set", "--out", "out"]);
    assert!(output.code == Some(4) && output.err.contains(expected), "{}", output.err);
    let output = bench.run(&["crosscheck", "./set", "--out", "out", "--check"]);
    assert!(output.code == Some(0) && output.out.contains(expected), "{}{}", output.out, output.err);
    assert!(output.out.starts_with("set: nothing is compared: "), "{}", output.out);
    let output = bench.run(&["check", "./set"]);
    assert_eq!(output.code, Some(0), "{}{}", output.out, output.err);
}
