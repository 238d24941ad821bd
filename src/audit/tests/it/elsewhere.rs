//! The audit in repositories of others: what the GitHub Action and the pre-commit hooks run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

fn root() -> PathBuf {
    fs::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")).unwrap()
}

/// A folder with a possible and an impossible table, and a text with a number of its own.
fn repository() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let table = "| planner | success [% of 250] |\n|-|-|\n| A | 33.6 |\n| B | 33.2 |\n";
    for (name, text) in [
        ("good table.md", table),
        ("good.md", table),
        ("bad.md", &table.replace("33.6", "33.3")),
        ("numbers.tex", "% made by `replan render zhang --only numbers`\n"),
        ("paper.tex", "Ours opens 42 nodes.\n"),
        ("plain.tex", "No number.\n"),
    ] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// The exit code of a program of bash with the audit on the PATH.
fn code(folder: &TempDir, script: &str, arguments: &[&str], environment: &[(&str, &str)]) -> Option<i32> {
    let bin = Path::new(env!("CARGO_BIN_EXE_replan-audit")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("bash");
    command.args(["-c", &format!("{script} \"$@\""), "bash"]).args(arguments);
    command.current_dir(folder.path()).env("PATH", path).envs(environment.iter().copied());
    command.output().unwrap().status.code()
}

#[test]
fn the_action_audits_every_table_and_text_and_ends_with_the_worst_answer() {
    let action = fs::read_to_string(root().join("action.yml")).unwrap();
    let script =
        action.lines().find_map(|line| line.trim().strip_prefix("run: '")?.strip_suffix('\'')).unwrap();
    let folder = repository();
    let place = root();
    let run = |tables: &str, texts: &str| {
        let given = [
            ("GITHUB_ACTION_PATH", place.to_str().unwrap()),
            ("TABLES", tables),
            ("TEXTS", texts),
            ("MACROS", "numbers.tex"),
        ];
        code(&folder, script, &[], &given)
    };
    assert_eq!(run("good.md", ""), Some(0));
    assert_eq!(run("bad.md good.md", ""), Some(3));
    assert_eq!(run("good.md\nnone.md", ""), Some(2));
    assert_eq!(run("", "paper.tex"), Some(3));
    assert_eq!(run("", ""), Some(2));
    for variable in ["TABLES", "TEXTS", "MACROS"] {
        assert!(action.contains(&format!("{variable}: ${{{{ inputs.{} }}}}", variable.to_lowercase())));
    }
}

#[test]
fn the_hooks_look_at_every_file_that_they_are_given() {
    let hooks = fs::read_to_string(root().join(".pre-commit-hooks.yaml")).unwrap();
    let entries: Vec<&str> = hooks.lines().filter_map(|line| line.strip_prefix("  entry: ")).collect();
    let [audit, coverage] = entries[..] else { panic!("{entries:?}") };
    let folder = repository();
    assert_eq!(code(&folder, audit, &["good.md", "good table.md"], &[]), Some(0));
    assert_eq!(code(&folder, audit, &["bad.md", "good.md"], &[]), Some(3));
    assert_eq!(code(&folder, coverage, &["numbers.tex", "paper.tex", "plain.tex"], &[]), Some(3));
}
