//! The cross-check from the command line, with answers that MuJoCo gave once and that are kept beside this file.

use crate::paper::{Bench, ProgramOutput};
use polars::prelude::{Column, DataFrame, NamedFrom as _, Series};
use std::fs;
use std::path::{Path, PathBuf};
use study::parquet::{FrameReader, write_frame};

/// Where answers lie in a bench.
const ANSWERS: &str = "out/target/replan/crosscheck/judged/up6-in-room";

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/crosscheck")
}

/// A folder with the paper `judged` and the kept answers.
fn bench() -> Bench {
    let bench = Bench::new();
    for name in ["paper.toml", "crosscheck.toml", "room.toml"] {
        bench.write(&format!("judged/{name}"), &fs::read(here().join(name)).unwrap());
    }
    let robot = here().join("../../../data/robots/motoman_up6.toml");
    bench.write("data/robots/motoman_up6.toml", &fs::read(robot).unwrap());
    for file in fs::read_dir(here().join("answers")).unwrap() {
        let path = file.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        bench.write(&format!("{ANSWERS}/{name}"), &fs::read(&path).unwrap());
    }
    bench
}

fn judged(bench: &Bench) -> ProgramOutput {
    bench.run(&["crosscheck", "./judged", "--answered", "--out", "out"])
}

fn frame_at(path: &Path) -> DataFrame {
    FrameReader::open(fs::File::open(path).unwrap()).unwrap().frame().unwrap()
}

fn write_at(path: &Path, frame: DataFrame) {
    write_frame(fs::File::create(path).unwrap(), frame, Vec::new()).unwrap();
}

/// Changes one cell of a table of answers.
fn edit(bench: &Bench, file: &str, column: &str, change: impl Fn(&Column) -> Series) {
    let path = bench.at(&format!("{ANSWERS}/{file}"));
    let mut frame = frame_at(&path);
    let series = change(frame.column(column).unwrap());
    frame.with_column(series.into()).unwrap();
    write_at(&path, frame);
}

fn flipped(column: &Column, row: usize) -> Series {
    let mut cells: Vec<bool> = column.bool().unwrap().iter().flatten().collect();
    cells[row] = !cells[row];
    Series::new(column.name().clone(), cells)
}

fn raised(column: &Column, row: usize, by: f64) -> Series {
    let mut cells: Vec<f64> = column.f64().unwrap().iter().flatten().collect();
    cells[row] += by;
    Series::new(column.name().clone(), cells)
}

#[test]
fn right_answers_agree_and_every_control_is_noticed() {
    let bench = bench();
    let said = judged(&bench);
    assert_eq!(said.code, Some(0), "{}{}", said.out, said.err);
    assert!(!said.out.contains("DIFFER") && !said.out.contains("NOT NOTICED"), "{}", said.out);
    assert_eq!(said.out.matches("  noticed").count(), 3, "{}", said.out);
    let report = fs::read_to_string(bench.at(REPORT)).unwrap();
    assert!(report.starts_with("# judged: "), "{report}");
    assert!(
        report.contains("Nothing differs.") && report.contains("**MuJoCo agrees with every answer"),
        "{report}"
    );
    // The sample was worth drawing: both outcomes, adversarial and singular poses, pierced obstacles.
    for kind in ["random", "within 1 mm of contact", "singular", "axis pierces an obstacle", "paths"] {
        assert!(said.out.contains(kind), "{kind} was not asked:\n{}", said.out);
    }
}

/// A wrong answer: what is listed, how many answers differ then, and the edit that makes it.
type Wrong = (&'static str, usize, fn(&Bench));

const WRONG_ANSWERS: [Wrong; 6] = [
    // The fifth configuration is in contact anyway, so that planners are right to refuse it; the fourth is free.
    ("contact of finger|box", 1, |bench| {
        edit(bench, "scene.touch.parquet", "finger|box", |column| flipped(column, 4));
    }),
    ("planners of the whole robot", 2, |bench| {
        edit(bench, "scene.touch.parquet", "finger|box", |column| flipped(column, 3));
    }),
    ("distance of wrist|ball", 1, |bench| {
        edit(bench, "scene.gaps.parquet", "wrist|ball", |column| raised(column, 2, 2e-6));
    }),
    ("distance of base|finger", 1, |bench| {
        edit(bench, "scene.gaps.parquet", "base|finger", |column| raised(column, 2, f64::NAN));
    }),
    ("frame of tool", 1, |bench| {
        edit(bench, "scene.frames.parquet", "tool.zx", |column| raised(column, 5, 2e-9));
    }),
    ("limit of joint_4", 1, |bench| {
        edit(bench, "scene.limits.parquet", "joint_4", |column| flipped(column, 7));
    }),
];

#[test]
fn a_wrong_answer_is_listed_with_both_values_and_turns_the_verdict_red() {
    for (listed, differ, change) in WRONG_ANSWERS {
        let bench = bench();
        change(&bench);
        let said = judged(&bench);
        assert_eq!(said.code, Some(3), "{listed}\n{}{}", said.out, said.err);
        assert_eq!(said.out.matches("DIFFER").count(), differ, "{listed}\n{}", said.out);
        assert!(said.err.contains(listed) && said.err.contains("ours "), "{listed}\n{}", said.err);
        assert!(said.err.contains(&format!("replan: {differ} answers differ")), "{}", said.err);
        let report = fs::read_to_string(bench.at(REPORT)).unwrap();
        assert!(report.contains(&format!("- up6-in-room, {listed}")), "{report}");
        assert!(report.contains(&format!("**MuJoCo DIFFERS: {differ} answers, 0 paths")), "{report}");
    }
}

/// The first row of a kind of configuration: contacts are tabulated in the order of the questions.
fn first_row(table: &str, kind: &str) -> usize {
    let lines = table.lines().filter_map(|line| line.strip_prefix("up6-in-room  contact   "));
    let before = lines.take_while(|line| !line.starts_with(kind));
    before.map(|line| line[24..].split_whitespace().next().unwrap().parse::<usize>().unwrap()).sum()
}

#[test]
fn a_path_that_is_not_free_for_the_judge_is_named() {
    let bench = bench();
    let row = first_row(&judged(&bench).out, "paths") + 5;
    edit(&bench, "scene.touch.parquet", "finger|box", |column| flipped(column, row));
    let said = judged(&bench);
    assert_eq!(said.code, Some(3), "{}{}", said.out, said.err);
    assert!(said.err.contains("path `drawn 1` touches finger|box at ["), "{}", said.err);
    assert!(said.err.contains("contact of finger|box, paths configuration"), "{}", said.err);
}

#[test]
fn a_pushed_path_that_the_judge_lets_through_fails_the_run() {
    let bench = bench();
    let said = judged(&bench);
    let (_, rest) = said.out.split_once("control: path `drawn 1` pushed, ").unwrap();
    let pair = rest.split_once(':').unwrap().0.replace(" on ", "|");
    let first = first_row(&said.out, "pushed path");
    edit(&bench, "scene.touch.parquet", &pair, |column| {
        let cells = column.bool().unwrap().iter().flatten().enumerate();
        let cells: Vec<bool> = cells.map(|(row, touches)| touches && row < first).collect();
        Series::new(column.name().clone(), cells)
    });
    let said = judged(&bench);
    assert_eq!(said.code, Some(3), "{}{}", said.out, said.err);
    assert!(said.err.contains("control not noticed: path `drawn 1` pushed"), "{}", said.err);
}

#[test]
fn an_error_on_purpose_that_goes_unnoticed_fails_the_run() {
    for (name, control) in
        [("longer_link.frames", "link 2 1 mm longer"), ("shifted_obstacle.touch", "shifted by")]
    {
        let bench = bench();
        // The judge answers as if nothing were wrong: its answers to the right model, for the rows that were asked.
        let (wrong, part) = name.split_once('.').unwrap();
        let read = |file: &str| frame_at(&bench.at(&format!("{ANSWERS}/{file}.{part}.parquet")));
        let right = read("scene");
        let height = read(wrong).height();
        // Questions about frames start with the drawn ones; those near contact stand after the 40 drawn ones.
        let first = if part == "touch" { 40 } else { 0 };
        write_at(&bench.at(&format!("{ANSWERS}/{name}.parquet")), right.slice(first, height));
        let said = judged(&bench);
        assert_eq!(said.code, Some(3), "{name}\n{}{}", said.out, said.err);
        let is_told = said.err.contains("control not noticed") && said.err.contains(control);
        assert!(is_told && said.out.contains("NOT NOTICED"), "{name}\n{}{}", said.out, said.err);
    }
}

#[test]
fn answers_that_are_missing_or_do_not_fit_are_refused_by_name() {
    let bench = bench();
    let path = bench.at(&format!("{ANSWERS}/scene.touch.parquet"));
    let whole = fs::read(&path).unwrap();
    let mut frame = frame_at(&path);
    write_at(&path, frame.slice(0, 9));
    let said = judged(&bench);
    assert!(said.code == Some(3) && said.err.contains("has 9 rows"), "{}", said.err);
    let _ = frame.drop_in_place("finger|box").unwrap();
    write_at(&path, frame);
    let said = judged(&bench);
    assert!(said.code == Some(3) && said.err.contains("no column `finger|box`"), "{}", said.err);
    fs::write(&path, &whole[..200]).unwrap();
    assert!(judged(&bench).err.contains("is not a Parquet file"));
    fs::remove_file(&path).unwrap();
    assert!(judged(&bench).err.contains("scene.touch.parquet: cannot be read"));
}

#[test]
fn without_python_or_its_packages_the_exit_code_is_4_and_the_message_says_what_to_run() {
    let bench = bench();
    bench.write("crosscheck/requirements.txt", b"mujoco==4.0.0\n");
    let ask = |program: &str| bench.run(&["crosscheck", "./judged", "--out", "out", "--python", program]);
    let said = ask("./no-such-python");
    assert_eq!(said.code, Some(4), "{}", said.err);
    assert!(
        said.err.contains("Python 3.11 or later is needed") && said.err.contains("apt install"),
        "{}",
        said.err
    );
    // A Python that is too old, and one whose pip has no network.
    let script = |body: &str| {
        bench.write("python", format!("#!/bin/sh\n{body}\n").as_bytes());
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(bench.at("python"), mode).unwrap();
        ask("./python")
    };
    let said = script("echo 3 9");
    assert!(said.code == Some(4) && said.err.contains("`./python` is Python 3.9"), "{}", said.err);
    let said = script(
        "case \"$2\" in\n  venv) mkdir -p \"$4/bin\" && cp \"$0\" \"$4/bin/python\";;\n  pip) echo 'no route to host' >&2; exit 1;;\n\
         \x20 *) echo 3 11;;\nesac",
    );
    assert_eq!(said.code, Some(4), "{}{}", said.out, said.err);
    let is_told = said.err.contains("no route to host") && said.err.contains("-m pip install");
    assert!(is_told, "{}", said.err);
}

#[test]
fn a_spec_that_names_what_is_not_there_is_refused_at_its_line() {
    for (from, to, parts) in [
        ("body = \"capsules\"", "body = \"bones\"", ["crosscheck.toml:24:1", "no body `bones`"]),
        ("room.toml", "hall.toml", ["crosscheck.toml:30:1", "`hall.toml` does not exist"]),
        (
            "case = \"up6-in-room\"",
            "case = \"up6-in-hall\"",
            ["crosscheck.toml:18:8", "the cases are up6-in-room"],
        ),
        (
            "key = \"zero\"",
            "key = \"one\"",
            ["crosscheck.toml:19:7", "no keyframe `one`; it has zero, path 1 start"],
        ),
        ("singular = 5", "single = 5", ["crosscheck.toml:13:1", "unknown key `single`"]),
    ] {
        let bench = bench();
        bench.edit("judged/crosscheck.toml", from, to);
        let said = judged(&bench);
        assert_eq!(said.code, Some(2), "{}", said.err);
        assert!(parts.iter().all(|part| said.err.contains(part)), "{parts:?}\n{}", said.err);
    }
}

/// What an independent judge said.
const REPORT: &str = "out/plots/judged/crosscheck.md";

/// A picture of an earlier run.
const PICTURE: &str = "out/plots/judged/scene_mujoco.png";

fn report(bench: &Bench) -> String {
    fs::read_to_string(bench.at(REPORT)).unwrap()
}

#[test]
fn a_report_without_a_new_picture_says_why_and_a_check_takes_either() {
    let unasked = "none was asked for when this was written, since the answers were there already.";
    let link = "![the scene as MuJoCo sees it](scene_mujoco.png)\n\n";
    let bench = bench();
    assert_eq!(judged(&bench).code, Some(0));
    assert!(report(&bench).contains(&format!("\nNo picture: {unasked}\n")), "{}", report(&bench));
    bench.write(PICTURE, b"older");
    assert_eq!(judged(&bench).code, Some(0));
    let before = format!("{link}The picture is of an earlier run: {unasked}\n\n");
    assert!(report(&bench).contains(&before), "{}", report(&bench));
    let check = || bench.run(&["crosscheck", "./judged", "--answered", "--out", "out", "--check"]).code;
    assert_eq!(check(), Some(0));
    bench.write(REPORT, report(&bench).replace(&before, link).as_bytes());
    assert_eq!(check(), Some(0), "a chapter written where the picture was drawn");
    bench.write(REPORT, report(&bench).replace(link, "").as_bytes());
    assert_eq!(check(), Some(3));
}

#[test]
fn a_picture_that_cannot_be_drawn_is_not_passed_off_as_a_new_one() {
    let bench = bench();
    bench.write("crosscheck/requirements.txt", b"mujoco==4.0.0\n");
    // A Python whose judge gives the kept answers and has no renderer.
    let script = "#!/bin/sh\ncase \"$2 $3\" in\n  'venv --clear') mkdir -p \"$4/bin\" && cp \"$0\" \"$4/bin/python\";;\n\
                  \x20 'judge answer') cp kept/* \"$4/up6-in-room/\";;\n  'judge draw') echo 'no display' >&2; exit 1;;\n\
                  \x20 pip*) ;;\n  *) echo 3 11;;\nesac\n";
    bench.write("python", script.as_bytes());
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    fs::set_permissions(bench.at("python"), mode).unwrap();
    for file in fs::read_dir(here().join("answers")).unwrap() {
        let path = file.unwrap().path();
        bench.write(&format!("kept/{}", path.file_name().unwrap().display()), &fs::read(&path).unwrap());
    }
    for (is_there, said) in [(false, "No picture: "), (true, "The picture is of an earlier run: ")] {
        if is_there {
            bench.write(PICTURE, b"older");
        }
        let asked = bench.run(&["crosscheck", "./judged", "--out", "out", "--python", "./python"]);
        assert_eq!(asked.code, Some(0), "{}{}", asked.out, asked.err);
        assert!(
            asked.err.contains("judged: no picture: ") && asked.err.contains("no display"),
            "{}",
            asked.err
        );
        let line = format!("\n{said}it could not be drawn when this was written; most often no renderer");
        assert!(report(&bench).contains(&line), "{}", report(&bench));
        assert_eq!(report(&bench).contains("scene_mujoco.png"), is_there);
    }
}

#[test]
fn answers_that_were_never_asked_for_are_wrong_input_and_nothing_is_written() {
    let bench = bench();
    fs::remove_dir_all(bench.at(ANSWERS)).unwrap();
    let said = judged(&bench);
    assert_eq!((said.code, said.out.as_str()), (Some(2), ""), "{}", said.err);
    let told = "there are no answers to judge; run `replan crosscheck judged` without --answered";
    assert!(
        said.err.contains(told) && said.err.contains("out/target/replan/crosscheck/judged: "),
        "{}",
        said.err
    );
    // Questions alone are no answers.
    bench.write(&format!("{ANSWERS}/scene.questions.parquet"), b"");
    assert_eq!(judged(&bench).code, Some(2));
    assert!(!bench.at(REPORT).exists());
}

#[test]
fn the_judge_of_statistics_is_told_metrics_and_papers() {
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
    let said = ask();
    assert!(said.code == Some(2) && said.err.contains("no verdicts"), "{}", said.err);
    bench.write("out/data/runs/judged/verdicts.toml", b"");
    for (ends, expected, message) in
        [(0, 0, ""), (3, 3, "differ from verdicts.toml"), (1, 1, "the judge ended")]
    {
        script(ends);
        let said = ask();
        assert_eq!(said.code, Some(expected), "{}{}", said.out, said.err);
        assert!(said.err.contains(message) && said.out.contains("asked in out/"), "{}{}", said.out, said.err);
    }
    let asked = fs::read_to_string(bench.at("out/target/replan/crosscheck/statistics.json")).unwrap();
    let asked: serde_json::Value = serde_json::from_str(&asked).unwrap();
    let metric = asked["metrics"].as_array().unwrap().iter().find(|metric| metric["name"] == "plan_time_ms");
    let expected = serde_json::json!({
        "name": "plan_time_ms", "column": "plan_wall_ns", "scale": 1e-6, "better": "lower", "clock": true, "status": false,
    });
    assert_eq!(metric, Some(&expected));
    assert_eq!(asked["papers"].as_array().unwrap().len(), 1, "{asked}");
}
