//! `replan audit` and `replan export --to` run a program beside replan or on the PATH, whose arguments, streams and exit code are its
//! own.

use crate::paper::Bench;
use std::io::Write as _;
use std::path::Path;
use std::process::Stdio;

/// Puts a program at `to` by another process: a child of another test would hold what this process has open for writing, and a program
/// that is open for writing cannot be started.
fn install(from: &Path, to: &Path) {
    let status = std::process::Command::new("install").args(["-D", "-m", "755"]).args([from, to]).status();
    assert!(status.unwrap().success(), "{}", to.display());
}

/// Writes a stand-in for the program: it prints the arguments and what it reads, and ends with code 7.
fn stand_in(bench: &Bench, name: &str) {
    let script = "#!/bin/sh\nprintf '%s|' '$0' \"$REPLAN\" \"$@\"\n/bin/cat\necho lost >&2\nexit 7\n";
    bench.write("script", script.replace("$0", name).as_bytes());
    install(&bench.at("script"), &bench.at(name));
}

#[test]
fn the_program_beside_replan_comes_first_then_the_path_and_without_both_the_message_has_the_command() {
    let bench = Bench::empty();
    let replan = bench.at("bin/replan");
    install(Path::new(env!("CARGO_BIN_EXE_replan")), &replan);
    let run = |arguments: &[&str]| {
        let mut command = std::process::Command::new(&replan);
        command.arg("audit").args(arguments).env("PATH", bench.at("path")).current_dir(bench.at("bin"));
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // A program that is not there reads nothing.
        let _ = child.stdin.take().unwrap().write_all(b"table");
        bench.output(&child.wait_with_output().unwrap())
    };
    let missing = run(&["t.md"]);
    let expected = "replan: `replan-audit` is neither beside this program nor on the PATH; `cargo build -p replan-audit` builds it\n";
    assert_eq!((missing.code, &*missing.err), (Some(4), expected));
    for place in ["path/replan-audit", "bin/replan-audit"] {
        stand_in(&bench, place);
        for arguments in [&["--json", "-"][..], &["--help"], &[], &["--", "-t.md"], &["t.md", "--", "--list"]]
        {
            let output = run(arguments);
            let given = [&[place, "[dir]/bin/replan"], arguments].concat();
            assert_eq!(output.out, given.join("|") + "|table");
            assert_eq!((output.code, &*output.err), (Some(7), "lost\n"));
        }
    }
}

#[test]
fn other_formats_than_csv_are_exported_by_the_program_beside_replan() {
    let bench = Bench::empty();
    let replan = bench.at("bin/replan");
    install(Path::new(env!("CARGO_BIN_EXE_replan")), &replan);
    let run = |arguments: &[&str]| {
        let mut command = std::process::Command::new(&replan);
        command.arg("export").args(arguments).env("PATH", bench.at("path")).current_dir(bench.at("bin"));
        bench.output(&command.output().unwrap())
    };
    let missing = run(&["zhang", "--to", "posthoc"]);
    let message = "replan: `replan-export` is neither beside this program nor on the PATH; `cargo build -p replan-export` builds it\n";
    assert_eq!((missing.code, &*missing.err), (Some(4), message));
    stand_in(&bench, "bin/replan-export");
    let done = run(&["zhang", "--to", "posthoc", "--out", "there"]);
    assert_eq!(done.out, "bin/replan-export|[dir]/bin/replan|zhang|--to|posthoc|--out|there|");
    assert_eq!(done.code, Some(7));
    assert_eq!(run(&["nowhere", "--to", "csv"]).code, Some(2), "it is written by replan itself");
}

#[test]
fn replan_is_made_without_the_audit_and_without_a_database() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut tree = std::process::Command::new(env!("CARGO"));
    tree.args([
        "tree",
        "--offline",
        "--locked",
        "--package",
        "replan",
        "--prefix",
        "none",
        "--format",
        "{p}",
    ]);
    let listed = String::from_utf8(tree.current_dir(root).output().unwrap().stdout).unwrap();
    assert!(listed.contains("replan-proofs"), "{listed}");
    assert!(
        !["replan-audit", "replan-export", "rusqlite"].iter().any(|name| listed.contains(name)),
        "{listed}"
    );
}
