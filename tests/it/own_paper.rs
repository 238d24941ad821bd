//! Papers of one's own: what `replan new` writes, and every command and file of docs/YOUR_OWN_PAPER.md.

use crate::paper::{Bench, Said};
use std::fs;
use std::path::Path;

#[test]
fn a_new_paper_of_every_template_runs_at_once_and_its_schema_lines_name_files_that_are_there() {
    let bench = Bench::empty();
    for template in ["grid", "arm", "cell"] {
        bench.done(&["new", template, "--from", template]);
        let folder = format!("./{template}");
        bench.done(&["check", &folder]);
        let said = bench.done(&["repro", &folder, "--quick"]);
        assert!(said.contains("sentences and rows: "), "{said}");
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
    assert!(bench.done(&["check", "fresh"]).starts_with("fresh: 1 studies"));
}

#[test]
fn a_folder_that_is_not_empty_or_whose_name_names_no_paper_is_refused_and_left_as_it_was() {
    let bench = Bench::empty();
    bench.write("full/notes.txt", b"mine");
    for (folder, said) in [
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
        assert_eq!((answer.code, answer.err.as_str()), (Some(2), said), "{folder}");
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

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_command_and_file_of_the_page_on_papers_of_ones_own_does_what_the_page_says() {
    let page =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/YOUR_OWN_PAPER.md")).unwrap();
    let (bench, mut commands, mut shown) = (Bench::empty(), 0, 0);
    let mut last = Said { code: None, out: String::new(), err: String::new() };
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
            ("toml", file) if !file.is_empty() => bench.write(file, text.as_bytes()),
            ("text", "") => {
                let said: Vec<String> = last.out.lines().map(words).collect();
                for line in text.lines().map(words) {
                    assert!(
                        said.iter().any(|said| said.contains(&line)),
                        "{line}\nis not said:\n{}",
                        last.out
                    );
                    shown += 1;
                }
            }
            _ => panic!("a block of `{info}`: sh, text or a toml file is accepted"),
        }
    }
    assert!(commands >= 8 && shown >= 6, "{commands} commands, {shown} lines of output");
}
