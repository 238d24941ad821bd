//! Papers of one's own: what `replan new` writes, and every command and file of `docs/YOUR_OWN_PAPER.md`.

use crate::import::LOG;
use crate::paper::{Bench, ProgramOutput};
use std::fs;
use std::path::Path;

#[test]
fn a_new_paper_of_every_template_runs_at_once_and_its_schema_lines_name_files_that_are_there() {
    let bench = Bench::empty();
    for template in ["grid", "arm", "cell"] {
        bench.done(&["new", template, "--from", template]);
        let folder = format!("./{template}");
        bench.done(&["check", &folder]);
        let output = bench.done(&["repro", &folder, "--quick"]);
        assert!(output.contains("sentences and rows: "), "{output}");
        for entry in fs::read_dir(bench.at(template)).unwrap().map(Result::unwrap) {
            if entry.path().is_dir() {
                continue;
            }
            let text = fs::read_to_string(entry.path()).unwrap();
            let schema = text.lines().next().unwrap().strip_prefix("#:schema ").unwrap();
            assert!(bench.at(template).join(schema).is_file(), "{schema} of {:?}", entry.path());
            assert!(!text.contains("SCHEMA") && !text.contains("PAPER\""), "{:?}", entry.path());
        }
    }
}

#[test]
fn a_new_paper_of_a_project_names_the_schemas_of_the_project() {
    let bench = Bench::empty();
    bench.done(&["schema", "docs/schema"]);
    bench.done(&["new", "experiments/fresh", "--from", "grid"]);
    assert!(!bench.at("experiments/fresh/.schema").exists());
    let text = fs::read_to_string(bench.at("experiments/fresh/paper.toml")).unwrap();
    let schema = text.lines().next().unwrap().strip_prefix("#:schema ").unwrap();
    assert!(bench.at("experiments/fresh").join(schema).is_file(), "{schema}");
    assert!(bench.done(&["check", "fresh"]).starts_with("fresh: 1 study, "));
}

#[test]
fn a_folder_that_is_not_empty_or_whose_name_names_no_paper_is_refused_and_left_as_it_was() {
    let bench = Bench::empty();
    bench.write("full/notes.txt", b"mine");
    for (folder, expected) in [
        ("full", "replan: full is not empty; a new folder is accepted\n"),
        (
            "a b",
            "replan: the folder's name `a b` is the paper's; letters from a to z, digits, `_` and `-` are accepted\n",
        ),
        (
            "..",
            "replan: the folder's name `` is the paper's; letters from a to z, digits, `_` and `-` are accepted\n",
        ),
    ] {
        let answer = bench.run(&["new", folder, "--from", "grid"]);
        assert_eq!((answer.code, answer.err.as_str()), (Some(2), expected), "{folder}");
    }
    assert_eq!(bench.tree(".").len(), 1);
}

/// A fenced block of a page: what stands behind its fence, and its text.
struct Block<'a> {
    info: &'a str,
    text: &'a str,
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let inside = page.split("\n```").skip(1).step_by(2);
    inside.map(|part| part.split_once('\n').unwrap()).map(|(info, text)| Block { info, text }).collect()
}

/// The text without its spaces, which only align.
fn letters(text: &str) -> String {
    text.split_whitespace().collect()
}

/// Runs the commands of a page in order, writes its files, and holds what it shows against what the last command prints; how many
/// commands and lines of output there are.
fn followed(page: &str, bench: &Bench) -> [usize; 2] {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(page)).unwrap();
    let mut commands = 0;
    let mut shown = 0;
    let mut last = ProgramOutput { code: None, out: String::new(), err: String::new(), doing: Vec::new() };
    for Block { info, text } in blocks(&page) {
        match info.split_once(' ').unwrap_or((info, "")) {
            ("sh", "") => {
                for line in text.lines() {
                    let arguments: Vec<&str> = line.split_whitespace().collect();
                    assert_eq!(arguments[0], "replan", "{line}");
                    last = bench.run(&arguments[1..]);
                    assert_eq!(last.code, Some(0), "{line}\n{}{}", last.out, last.err);
                    commands += 1;
                }
            }
            ("toml" | "python" | "csv", file) if !file.is_empty() => bench.write(file, text.as_bytes()),
            ("text", "") => {
                let lines: Vec<String> = last.out.lines().map(letters).collect();
                for line in text.lines().map(letters) {
                    assert!(
                        lines.iter().any(|lines| lines.contains(&line)),
                        "{line}\nis not said:\n{}",
                        last.out
                    );
                    shown += 1;
                }
            }
            _ => panic!("a block of `{info}`: sh, text or a file in toml, python or csv is accepted"),
        }
    }
    [commands, shown]
}

#[test]
fn every_command_and_file_of_the_page_on_papers_of_ones_own_does_what_the_page_says() {
    let [commands, shown] = followed("docs/YOUR_OWN_PAPER.md", &Bench::empty());
    assert!(commands >= 12 && shown >= 8, "{commands} commands, {shown} lines of output");
}

#[test]
fn every_command_and_file_of_the_page_on_results_that_exist_does_what_the_page_says() {
    let bench = Bench::empty();
    bench.write("benchmark.log", LOG.as_bytes());
    let [commands, shown] = followed("docs/AUTHORS_DATA.md", &bench);
    assert!(commands >= 4 && shown >= 3, "{commands} commands, {shown} lines of output");
    bench.done(&["repro", "./mine"]);
    for file in ["verdicts.toml", "results.trials.parquet"] {
        assert!(bench.at("target/replan/mine/data/runs/mine").join(file).is_file(), "{file}");
    }
    let report = fs::read_to_string(bench.at("target/replan/mine/paper_repro.md")).unwrap();
    assert!(report.contains("recorded elsewhere") && !report.contains("**reproduced**"), "{report}");
}

#[test]
fn a_folder_of_maps_is_one_group_each_and_a_pattern_without_a_file_is_reported() {
    let bench = Bench::empty();
    bench.done(&["new", "maps", "--from", "grid"]);
    for (name, row) in [("b", "....\n"), ("a", ".#..\n")] {
        bench.write(&format!("maps/rooms/{name}.txt"), format!("{row}....\n").as_bytes());
    }
    bench.edit(
        "maps/compare.toml",
        "family = \"random_rectangles\"\ninstances = 60",
        "family = \"grid_map\"\neach = \"rooms/*.txt\"",
    );
    let text = fs::read_to_string(bench.at("maps/compare.toml")).unwrap();
    let (from, to) = (text.find("[problems.settings]").unwrap(), text.find("# What is compared").unwrap());
    let settings =
        "settings = { map = \"{file}\", start = [0, 1], goal = [3, 1], corner_rule = \"allow\" }\n\n";
    let figure = text.find("# A figure, drawn").unwrap();
    bench.write("maps/compare.toml", [&text[..from], settings, &text[to..figure]].concat().as_bytes());
    let paper = fs::read_to_string(bench.at("maps/paper.toml")).unwrap();
    let paper = paper.replace("problems = \"maps\"", "problems = \"maps *\"").replace(", \"maps\"]", "]");
    bench.write("maps/paper.toml", paper.as_bytes());
    assert!(bench.done(&["run", "./maps"]).starts_with("compare: 4 trials"));
    bench.done(&["repro", "./maps", "--trial", "compare/maps-a/a-star"]);
    for (pattern, expected) in [
        (
            "rooms/*.map",
            "maps/compare.toml:18:8: no file is `rooms/*.map`; looked for ./maps/rooms/*.map, rooms/*.map",
        ),
        (
            "rooms/a.txt",
            "maps/compare.toml:18:8: `rooms/a.txt` has no `*` in its last part; `maps/*.map` is accepted",
        ),
    ] {
        bench.write("maps/compare.toml", text_with(&bench, pattern).as_bytes());
        let answer = bench.run(&["check", "./maps"]);
        assert!(
            answer.code == Some(2) && answer.err.contains(expected),
            "should say {expected}\nsays {}",
            answer.err
        );
    }
}

/// The study of the folder of maps with another pattern.
fn text_with(bench: &Bench, pattern: &str) -> String {
    let text = fs::read_to_string(bench.at("maps/compare.toml")).unwrap();
    let line = text.lines().find(|line| line.starts_with("each = ")).unwrap();
    text.replace(line, &format!("each = \"{pattern}\""))
}
