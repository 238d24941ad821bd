//! In a paper of many studies one fault is told once, and nothing that follows from it alone.

use crate::paper::Bench;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

/// What `check` says of a committed paper with one change of one of its files, without excerpts.
fn faults_after(paper: &str, file: &str, from: &str, to: &str) -> Vec<String> {
    let bench = Bench::empty();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    symlink(root.join("data"), bench.at("data")).unwrap();
    for entry in fs::read_dir(root.join("experiments").join(paper)).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        bench.write(&format!("{paper}/{name}"), &fs::read(entry.path()).unwrap());
    }
    bench.edit(&format!("{paper}/{file}"), from, to);
    let output = bench.run(&["check", &format!("./{paper}")]);
    assert_eq!(output.code, Some(2), "{from} to {to}: {}{}", output.out, output.err);
    output.err.lines().filter(|line| !line.starts_with("    ")).map(str::to_owned).collect()
}

#[test]
fn a_fault_of_one_study_is_reported_alone_in_a_paper_of_many() {
    for (paper, file, from, to, wanted) in [
        ("fu2018", "success.toml", "[[sweep]]", "[[sweeep]]", "unknown key `sweeep` (did you mean `sweep`?)"),
        ("fu2018", "success.toml", "key = \"samples\"", "key = 5", "`key` is 5; text in quotes is accepted"),
        ("fu2018", "length.toml", "label = \"cell\"", "", "missing key `label`"),
        ("gallery", "movingai.toml", "{ map = ", "{ mapp = ", "unknown key `mapp` (did you mean `map`?)"),
        ("gallery", "movingai.toml", "\"movingai\"", "\"movingay\"", "there is no problem family `movingay`"),
        (
            "gallery",
            "paper.toml",
            "jump_deg = ",
            "jump_deg = 4000 #",
            "`jump_deg` is 4000; a number from 0.001 to 3600",
        ),
        ("tang2023", "postures.toml", "instances = 1000", "instances = \"9\"", "`instances` is \"9\""),
        ("tang2023", "paper.toml", "default = \"paper\"", "default = \"papper\"", "has no option `papper`"),
    ] {
        let message = faults_after(paper, file, from, to);
        let is_meant = message.len() == 1 && message[0].contains(wanted);
        assert!(is_meant, "{paper}/{file}: {from} to {to} is told:\n{}", message.join("\n"));
    }
}

#[test]
fn a_study_that_plans_nothing_is_refused() {
    let bench = Bench::new();
    bench.write(
        "mini/none.toml",
        b"paper = \"mini\"\nquestion = \"?\"\nseed = 1\nbudget = { expansions = 9 }\n",
    );
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}{}", output.out, output.err);
    for list in ["problems", "contender"] {
        assert!(output.err.contains(&format!("nothing is planned without `[[{list}]]`")), "{}", output.err);
    }
}

#[test]
fn text_that_turns_a_terminal_or_a_page_is_refused() {
    for turning in ["\\u0000", "\\u001b[31m", "\\u202e"] {
        let message = faults_after("gallery", "paper.toml", "title = \"", &format!("title = \"{turning}"));
        assert!(
            message.len() == 1 && message[0].contains("`title` holds a control character"),
            "{message:?}"
        );
    }
}
