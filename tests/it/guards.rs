//! What guards the product: whoever touches a verdict, a record, a figure or a chapter by hand is found out.

use crate::across::Toy;
use crate::paper::Bench;
use base::hash::sha256;
use polars::prelude::{DataFrame, IntoColumn as _, NamedFrom as _, Series};
use std::fs;
use std::io::Cursor;
use std::path::Path;
use study::parquet::{FrameReader, write_frame};

const RUNS: &str = "data/runs/movingai_sample";
const REPORT: &str = "paper_repro.md";

/// A copy of the committed paper `movingai_sample` with all that is stored of it.
fn committed() -> Bench {
    let bench = Bench::empty();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["experiments", "data/runs", "plots"] {
        copy(&bench, root, &format!("{name}/movingai_sample"));
    }
    copy(&bench, root, "data/maps");
    bench.write(REPORT, &fs::read(root.join(REPORT)).unwrap());
    bench
}

/// Copies the files of the folder `name` below `root`.
fn copy(bench: &Bench, root: &Path, name: &str) {
    for entry in fs::read_dir(root.join(name)).unwrap() {
        let entry = entry.unwrap();
        let file = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            continue;
        }
        bench.write(&format!("{name}/{file}"), &fs::read(entry.path()).unwrap());
    }
}

/// The program run on the copy, which must end with exit code 3; what it said.
fn refused(bench: &Bench, arguments: &[&str]) -> String {
    let output = bench.run(arguments);
    assert_eq!(output.code, Some(3), "{arguments:?}: {}{}", output.out, output.err);
    output.err
}

/// Multiplies the first value of `column` in the stored trials by 1.5 and gives the file's hash.
fn touch(bench: &Bench, column: &str) -> String {
    let path = format!("{RUNS}/scenarios.trials.parquet");
    let bytes = fs::read(bench.at(&path)).unwrap();
    let mut frame: DataFrame = FrameReader::open(Cursor::new(bytes)).unwrap().frame().unwrap();
    let values = frame.column(column).unwrap().f64().unwrap();
    let mut values: Vec<Option<f64>> = values.iter().collect();
    values[0] = values[0].map(|value| 1.5 * value);
    frame.with_column(Series::new(column.into(), values).into_column()).unwrap();
    let mut bytes = Vec::new();
    write_frame(&mut bytes, frame, Vec::new()).unwrap();
    bench.write(&path, &bytes);
    sha256(&bytes)
}

#[test]
fn a_committed_paper_passes_every_check_of_the_gate() {
    let bench = committed();
    let before = bench.tree("");
    assert_eq!(
        bench.done(&["judge", "movingai_sample", "--check"]),
        "movingai_sample: 3 verdicts are what the stored run gives\n"
    );
    bench.done(&["render", "movingai_sample", "--check"]);
    bench.done(&["check", "movingai_sample", "--rerun", "2"]);
    assert!(bench.tree("") == before, "a check wrote something");
    let gate = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(".ci/run")).unwrap();
    for guard in ["judge", "render"] {
        assert!(gate.contains(&format!("\"$replan\" {guard} \"$1\" --check")), "{guard} is not in the gate");
    }
}

#[test]
fn a_flipped_verdict_is_shown_by_nobody() {
    let bench = committed();
    let verdicts = format!("{RUNS}/verdicts.toml");
    bench.edit(&verdicts, "verdict = \"reproduced\"", "verdict = \"not_reproduced\"");
    assert_eq!(bench.run(&["render", "movingai_sample"]).code, Some(2));
    let text = fs::read_to_string(bench.at(REPORT)).unwrap();
    let chapter = text.split("<!-- replan begin movingai_sample -->").nth(1).unwrap();
    let first = chapter.lines().filter(|line| !line.is_empty()).nth(1).unwrap();
    assert!(
        first.starts_with(&format!("**Nothing is shown: {verdicts}: is not what replan wrote")),
        "{first}"
    );
    refused(&bench, &["render", "movingai_sample", "--check"]);
    refused(&bench, &["judge", "movingai_sample", "--check"]);
}

#[test]
fn a_flipped_verdict_under_a_forged_seal_is_caught_by_judge_though_render_believes_it() {
    let bench = committed();
    let verdicts = format!("{RUNS}/verdicts.toml");
    bench.edit(&verdicts, "verdict = \"reproduced\"", "verdict = \"not_reproduced\"");
    let text = fs::read_to_string(bench.at(&verdicts)).unwrap();
    let (above, seal) = text.split_at(text.rfind("# SHA-256").unwrap());
    let (words, _) = seal.rsplit_once(' ').unwrap();
    bench.write(&verdicts, format!("{above}{words} {}\n", sha256(above.as_bytes())).as_bytes());
    bench.done(&["render", "movingai_sample"]);
    bench.done(&["render", "movingai_sample", "--check"]);
    let message = refused(&bench, &["judge", "movingai_sample", "--check"]);
    let named = format!(
        "replan: {verdicts}: not what the stored run gives:\n  \
         claim `lengths.astar`: stored not reproduced, judged reproduced\n"
    );
    assert_eq!(message, named);
}

#[test]
fn whatever_else_is_edited_in_stored_verdicts_is_caught_and_named() {
    for (from, to, expected) in [
        (
            "value = 1.0",
            "value = 0.5",
            "claim `lengths.astar`: reproduced as stored, but number of `equals`: stored ",
        ),
        ("on 60 of 60 trials", "on 61 of 61 trials", "but the reasons of `equals` read otherwise"),
        ("criterion = \"equals\"", "criterion = \"share\"", "but criterion: stored `share`, judged `equals`"),
        (
            "criterion = \"equals\"\noutcome = \"holds\"",
            "criterion = \"equals\"\noutcome = \"contradicted\"",
            "but outcome of `equals`: stored `contradicted`, judged `holds`",
        ),
        (
            "says = \"A*",
            "says = \"B*",
            "claim `lengths.astar`: reproduced as stored, but the claim's own words",
        ),
        ("quick = false", "quick = true", "quick: stored true, judged false"),
        (
            "claim = \"lengths.astar\"",
            "claim = \"old\"",
            "claim `old`: stored, but the paper has no such claim",
        ),
        (
            "quick = false",
            "# by hand\nquick = false",
            "the same verdicts in other words than `replan judge` writes",
        ),
    ] {
        let bench = committed();
        bench.edit(&format!("{RUNS}/verdicts.toml"), from, to);
        let found = refused(&bench, &["judge", "movingai_sample", "--check"]);
        assert!(found.contains(expected), "{to}: {found}");
    }
}

#[test]
fn a_touched_record_is_caught_by_its_hash_and_by_the_verdict_if_the_hash_is_touched_too() {
    let bench = committed();
    let manifest = format!("{RUNS}/scenarios.manifest.toml");
    let text = fs::read_to_string(bench.at(&manifest)).unwrap();
    let stored = sha256(&fs::read(bench.at(&format!("{RUNS}/scenarios.trials.parquet"))).unwrap());
    let touched = touch(&bench, "path_cost_cells");
    let checks: [&[&str]; 3] = [
        &["judge", "movingai_sample", "--check"],
        &["render", "movingai_sample", "--check"],
        &["check", "movingai_sample", "--rerun", "2"],
    ];
    for check in checks {
        let message = refused(&bench, check);
        assert!(message.contains("trials.parquet: is not the file that the manifest names"), "{message}");
    }
    assert_eq!(bench.run(&["judge", "movingai_sample"]).code, Some(2), "what is not there to check is input");
    assert!(text.contains(&stored));
    // Whoever touches both leaves no seal either.
    let (_, unsealed) = text.split_once('\n').unwrap();
    bench.write(&manifest, unsealed.replace(&stored, &touched).as_bytes());
    let message = refused(&bench, &["judge", "movingai_sample", "--check"]);
    assert!(message.contains("claim `lengths.astar`: stored reproduced, judged not reproduced"), "{message}");
    bench.done(&["judge", "movingai_sample"]);
    bench.done(&["judge", "movingai_sample", "--check"]);
    let message = refused(&bench, &["check", "movingai_sample", "--rerun", "1000"]);
    assert!(message.contains("trials of study `scenarios` are not what is stored"), "{message}");
}

#[test]
fn stored_texts_that_cannot_be_read_are_reported_in_words_of_ours() {
    for (name, again) in [
        ("verdicts", "`replan judge` writes it again"),
        (
            "scenarios.manifest",
            "put back the file that was written, or `run` with --replace-damaged, which sets it aside and keeps what is sound",
        ),
    ] {
        for to in ["quick = 3", "quick = "] {
            let bench = committed();
            let file = format!("{RUNS}/{name}.toml");
            bench.edit(&file, "quick = false", to);
            let message = refused(&bench, &["judge", "movingai_sample", "--check"]);
            let words = "is not what replan wrote: truncated, edited, or of another version; ";
            assert!(message.starts_with(&format!("replan: {file}:3:9: ")), "{message}");
            assert!(message.contains(&format!("{words}{again}\n    {}", to.trim_end())), "{message}");
        }
    }
}

#[test]
fn every_stale_file_of_a_figure_is_caught() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    for name in ["fig1.svg", "fig1.png", "table1.tex", "numbers.tex"] {
        let place = format!("target/replan/mini/plots/mini/{name}");
        let whole = fs::read(bench.at(&place)).unwrap();
        for at in [whole.len() / 3, whole.len() / 2, whole.len() - 20] {
            let mut stale = whole.clone();
            stale[at] ^= 1;
            bench.write(&place, &stale);
            let message = refused(&bench, &["render", "./mini", "--check"]);
            assert_eq!(message, format!("replan: not current: {place}\n"), "byte {at}");
        }
        bench.done(&["render", "./mini"]);
        assert!(fs::read(bench.at(&place)).unwrap() == whole, "{name} was not mended");
    }
}

#[test]
fn a_chapter_edited_by_hand_is_caught_and_words_around_it_are_left_alone() {
    let bench = committed();
    bench.edit(REPORT, "# ", "# My own title: ");
    bench.done(&["render", "movingai_sample", "--check"]);
    let text = fs::read_to_string(bench.at(REPORT)).unwrap();
    let (before, chapter) = text.split_once("<!-- replan begin movingai_sample -->").unwrap();
    let edited = chapter.replacen("reproduced", "rather well reproduced", 1);
    bench.write(REPORT, format!("{before}<!-- replan begin movingai_sample -->{edited}").as_bytes());
    let message = refused(&bench, &["render", "movingai_sample", "--check"]);
    assert_eq!(message, format!("replan: not current: {REPORT}\n"));
}

#[test]
fn each_exit_code_means_what_the_help_says() {
    let bench = committed();
    let code = |arguments: &[&str]| bench.run(arguments).code.unwrap();
    assert_eq!(code(&["judge", "movingai_sample"]), 0);
    assert_eq!(code(&["judge", "no_such_paper"]), 2);
    assert_eq!(code(&["judge", "--no-such-flag"]), 2);
    bench.edit(&format!("{RUNS}/verdicts.toml"), "value = 1.0", "value = 0.5");
    assert_eq!(code(&["judge", "movingai_sample", "--check"]), 3);
    bench.write("in_the_way", b"");
    assert_eq!(code(&["repro", "movingai_sample", "--out", "in_the_way/below"]), 1);
    fs::remove_file(bench.at(&format!("{RUNS}/verdicts.toml"))).unwrap();
    assert_eq!(code(&["judge", "movingai_sample", "--check"]), 3, "what was stored is gone");
    fs::remove_dir_all(bench.at(RUNS)).unwrap();
    assert_eq!(code(&["judge", "movingai_sample", "--check"]), 2, "nothing is stored");
}

#[test]
fn a_record_that_is_gone_is_reported_by_every_command_that_reads_the_run() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let runs = "target/replan/mini/data/runs/mini";
    for part in
        ["trials.parquet", "preprocessing.parquet", "times.parquet", "traces.parquet", "manifest.toml"]
    {
        let file = format!("{runs}/draws.{part}");
        let whole = fs::read(bench.at(&file)).unwrap();
        fs::remove_file(bench.at(&file)).unwrap();
        let output = refused(&bench, &["judge", "./mini", "--check"]);
        assert!(output.contains(&file), "{output}");
        if part != "manifest.toml" {
            for command in [&["show", "./mini"][..], &["export", "target/replan/mini", "--csv"]] {
                let output = bench.run(command);
                assert_eq!(output.code, Some(2), "{command:?}: {}{}", output.out, output.err);
                assert!(output.err.contains(&file), "{}", output.err);
            }
        }
        bench.write(&file, &whole);
    }
    bench.done(&["judge", "./mini", "--check"]);
}

#[test]
fn a_touched_record_is_neither_shown_nor_exported() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    for part in ["trials", "traces"] {
        let file = format!("target/replan/mini/data/runs/mini/draws.{part}.parquet");
        let whole = fs::read(bench.at(&file)).unwrap();
        let mut touched = whole.clone();
        touched[whole.len() / 2] ^= 1;
        bench.write(&file, &touched);
        for command in [&["show", "./mini", "nodes"][..], &["export", "target/replan/mini", "--csv"]] {
            let output = bench.run(command);
            assert_eq!((output.code, output.out.as_str()), (Some(2), ""), "{command:?}: {}", output.err);
            assert!(
                output.err.contains(&format!("{file}: is not the file that the manifest names")),
                "{}",
                output.err
            );
        }
        bench.write(&file, &whole);
    }
    bench.done(&["show", "./mini", "nodes"]);
}

#[test]
fn a_manifest_edited_by_hand_is_caught_by_judge() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let file = "target/replan/mini/data/runs/mini/draws.manifest.toml";
    let whole = fs::read_to_string(bench.at(file)).unwrap();
    let edits: Vec<(String, String)> = whole
        .lines()
        .filter_map(|line| {
            let edited = match line.split_once(" = ")? {
                // What cannot be found out again is believed; the hashes of files are held against the files.
                ("command" | "claims" | "replan" | "git" | "clean" | "rustc" | "lock" | "cpu", _) => {
                    return None;
                }
                (key, "false") => format!("{key} = true"),
                (key, value) if value.parse::<u64>().is_ok() => format!("{key} = {value}1"),
                (key, value) if value.starts_with('"') => format!("{key} = \"0{}", &value[2..]),
                (key, value) if value.starts_with("[[\"") => format!("{key} = [[\"0{}", &value[4..]),
                (key, value) if value.starts_with("[\"") => format!("{key} = [\"0{}", &value[3..]),
                _ if line.len() > 16 && line.chars().take(16).all(|c| c.is_ascii_hexdigit()) => {
                    format!("{}{}", if line.starts_with('0') { '1' } else { '0' }, &line[1..])
                }
                _ => return None,
            };
            (edited != line).then(|| (line.to_owned(), edited))
        })
        .collect();
    assert!(edits.len() > 12, "{edits:?}");
    for (line, edited) in edits {
        bench.write(file, whole.replacen(&line, &edited, 1).as_bytes());
        let output = bench.run(&["judge", "./mini", "--check"]);
        assert!(output.code != Some(0), "{line} was edited to {edited}, and nothing noticed it");
    }
    bench.write(file, whole.as_bytes());
    bench.done(&["judge", "./mini", "--check"]);
}

#[test]
fn records_of_a_study_that_is_no_more_are_reported() {
    let bench = committed();
    for part in ["trials.parquet", "manifest.toml"] {
        let whole = fs::read(bench.at(&format!("{RUNS}/scenarios.{part}"))).unwrap();
        bench.write(&format!("{RUNS}/gone.{part}"), &whole);
    }
    let message = refused(&bench, &["judge", "movingai_sample", "--check"]);
    assert!(
        message.contains("left over from a study that is no more; remove: ") && message.contains("gone.*"),
        "{message}"
    );
}

#[test]
fn what_must_hold_and_does_not_is_refused() {
    let own = "check.lower.select = { study = \"draws\", problems = \"drawn\", metric = \"expansions\", contender = \"A*\", against = \
               \"Two-sided\" }";
    let judged = |accepted: &str| {
        let of = "{ study = \"draws\", problems = \"drawn\", metric = \"expansions\", contender = \"A*\" }";
        let check =
            format!("check.within = {{ statistic = \"mean\", accepted = {accepted}, select = {of} }}");
        Toy::unexplored(&[(own, &format!("theorem = \"nodes are counted\"\n{check}"))])
    };
    let true_one = judged("[0.0, 1e6]");
    true_one.0.done(&["judge", "./toy"]);
    true_one.0.done(&["judge", "./toy", "--check"]);
    let false_one = judged("[1e6, 2e6]");
    for arguments in [&["judge", "./toy"][..], &["judge", "./toy", "--check"], &["repro", "./toy"]] {
        let message = refused(&false_one.0, arguments);
        assert!(message.contains("toy: `fewer` must hold whatever was drawn, and does not"), "{message}");
    }
}
