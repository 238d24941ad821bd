//! Damaged files of a stored run: refused by every command, set aside where that is asked for, never written over.

use crate::paper::Bench;
use std::fs;
use study::manifest::Manifest;
use study::reuse;

const RUNS: &str = "target/replan/mini/data/runs/mini";

fn flip(bench: &Bench, file: &str, at: usize) {
    let path = bench.at(&format!("{RUNS}/{file}"));
    let mut bytes = fs::read(&path).unwrap();
    let at = at.min(bytes.len() - 1);
    bytes[at] ^= 1;
    fs::write(path, bytes).unwrap();
}

fn sessions(bench: &Bench) -> usize {
    Manifest::read(&bench.at(RUNS), "draws").unwrap().sessions.len()
}

#[test]
fn a_damaged_file_is_refused_by_runs_and_checks_and_replaced_only_beside_its_old_bytes() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    bench.done(&["run", "./mini", "--clock"]);
    assert_eq!(sessions(&bench), 2);
    let facts = bench.facts("target/replan/mini");
    // How many sessions are there afterwards: what ran again is timed once more, beside what is stored.
    for (part, count) in [("traces", 3), ("preprocessing", 4), ("trials", 5), ("times", 1)] {
        let file = format!("draws.{part}.parquet");
        flip(&bench, &file, 40);
        let damaged = fs::read(bench.at(&format!("{RUNS}/{file}"))).unwrap();
        for (command, code) in [
            (&["repro", "./mini"][..], 2),
            (&["run", "./mini"], 2),
            (&["judge", "./mini"], 2),
            (&["judge", "./mini", "--check"], 3),
        ] {
            let refused = bench.run(command);
            assert_eq!(refused.code, Some(code), "{part}: {command:?}: {}{}", refused.out, refused.err);
            let message = format!("{}{}", refused.out, refused.err);
            assert!(
                message.contains(&file) && message.contains("--replace-damaged"),
                "{part}: {command:?}: {message}"
            );
        }
        assert_eq!(
            fs::read(bench.at(&format!("{RUNS}/{file}"))).unwrap(),
            damaged,
            "{part} was written over"
        );
        let message = bench.done(&["run", "./mini", "--replace-damaged"]);
        assert!(message.contains(&format!("{RUNS}/{file}.damaged-1")), "{message}");
        let aside = bench.at(&format!("{RUNS}/{file}.damaged-1"));
        assert_eq!(fs::read(&aside).unwrap(), damaged);
        fs::remove_file(aside).unwrap();
        assert_eq!(sessions(&bench), count, "{part}");
        assert!(bench.facts("target/replan/mini") == facts, "{part}: other facts than before");
    }
}

#[test]
fn one_bit_of_a_manifest_flipped_anywhere_is_noticed() {
    let bench = Bench::new();
    bench.done(&["run", "./mini"]);
    let path = bench.at(&format!("{RUNS}/draws.manifest.toml"));
    let whole = fs::read(&path).unwrap();
    let text = String::from_utf8(whole.clone()).unwrap();
    let begin = text.find('\n').unwrap() + 1;
    let mut tried = 0;
    for at in (begin..whole.len()).step_by(7) {
        flip(&bench, "draws.manifest.toml", at);
        let read = reuse::stored(&bench.at(RUNS), "draws");
        assert!(read.is_err(), "byte {at}: {}", text[at..].lines().next().unwrap());
        fs::write(&path, &whole).unwrap();
        tried += 1;
    }
    assert!(tried > 100, "{tried}");
    fs::write(&path, b"").unwrap();
    assert_eq!(bench.run(&["run", "./mini"]).code, Some(2));
    assert_eq!(fs::read(&path).unwrap(), b"", "an emptied manifest was written over");
    fs::write(&path, &whole).unwrap();
    // Even where it names the machine: nothing else is held against that.
    let at = text.find("rustc = ").unwrap() + 12;
    flip(&bench, "draws.manifest.toml", at);
    let refused = bench.run(&["repro", "./mini"]);
    assert_eq!(refused.code, Some(2), "{}", refused.err);
    let output = bench.done(&["run", "./mini", "--replace-damaged"]);
    assert!(output.contains("(24 of 24 units reused)"), "{output}");
    assert_eq!(reuse::stored(&bench.at(RUNS), "draws").unwrap().0.sessions.len(), 1);
}

#[test]
fn a_manifest_of_before_there_were_seals_is_read() {
    let bench = Bench::new();
    bench.done(&["run", "./mini"]);
    let path = bench.at(&format!("{RUNS}/draws.manifest.toml"));
    let text = fs::read_to_string(&path).unwrap();
    let (seal, rest) = text.split_once('\n').unwrap();
    assert!(seal.starts_with("# seal: "), "{seal}");
    fs::write(&path, rest).unwrap();
    assert!(bench.done(&["run", "./mini"]).contains("(24 of 24 units reused)"));
}

#[test]
fn no_link_or_pipe_in_a_folder_of_runs_is_followed_or_waited_for() {
    for name in [".lock", "draws.journal", "draws.trials.parquet", "draws.manifest.toml"] {
        for plants_link in [true, false] {
            let bench = Bench::new();
            bench.done(&["run", "./mini"]);
            bench.write("precious", b"precious");
            let place = bench.at(&format!("{RUNS}/{name}"));
            let _ = fs::remove_file(&place);
            if plants_link {
                std::os::unix::fs::symlink(bench.at("precious"), &place).unwrap();
            } else {
                assert!(std::process::Command::new("mkfifo").arg(&place).status().unwrap().success());
            }
            let refused = bench.run(&["run", "./mini", "--fresh"]);
            assert!(matches!(refused.code, Some(1 | 2)), "{name}: {:?} {}", refused.code, refused.err);
            assert!(refused.err.contains(name), "{name}: {}", refused.err);
            assert_eq!(fs::read(bench.at("precious")).unwrap(), b"precious", "{name} was followed");
        }
    }
}
