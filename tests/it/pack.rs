//! Packs: what a reviewer opens in an empty folder, and what is found where it was changed.

use crate::paper::Bench;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

const PACK: [&str; 8] =
    ["pack", "./mini", "--to", "pack", "--date", "2026-01-31", "--license", "https://spdx.org/licenses/MIT"];

fn packed() -> Bench {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    bench.done(&PACK);
    bench
}

#[test]
fn a_pack_is_judged_and_drawn_alone_in_an_empty_folder() {
    let bench = packed();
    let empty = Bench::empty();
    let status = std::process::Command::new("cp").arg("-r").args([bench.at("pack/."), empty.at("")]).status();
    assert!(status.unwrap().success());
    empty.done(&["check", "."]);
    for command in [&["check", "mini"][..], &["judge", "mini", "--check"], &["repro", "mini"]] {
        empty.done(command);
    }
    assert!(fs::read_to_string(empty.at("page/mini.html")).unwrap().contains("A tiny paper"));
    let mut sums = std::process::Command::new("sha256sum");
    sums.args(["--check", "--quiet", "SHA256SUMS"]);
    assert!(sums.current_dir(bench.at("pack")).status().unwrap().success());
}

#[test]
fn every_file_of_a_pack_is_described_in_its_crate() {
    let bench = packed();
    let text = fs::read_to_string(bench.at("pack/ro-crate-metadata.json")).unwrap();
    let metadata: Value = serde_json::from_str(&text).unwrap();
    let graph = metadata["@graph"].as_array().unwrap();
    let named = |kind: &str| -> BTreeSet<&str> {
        graph.iter().filter(|one| one["@type"] == kind).map(|one| one["@id"].as_str().unwrap()).collect()
    };
    let described = named("File");
    let sums = fs::read_to_string(bench.at("pack/SHA256SUMS")).unwrap();
    let files: BTreeSet<&str> =
        sums.lines().map(|line| &line[66..]).filter(|name| !name.starts_with("ro-crate")).collect();
    assert_eq!(described, files);
    for file in [
        "experiments/mini/paper.toml",
        "data/runs/mini/draws.trials.parquet",
        "plots/mini/table1.tex",
        "page/mini.html",
    ] {
        assert!(described.contains(file), "{file} is not among {described:?}");
    }
    let root = graph.iter().find(|one| one["@id"] == "./").unwrap();
    assert_eq!(
        (&root["datePublished"], &root["license"]["@id"]),
        (&"2026-01-31".into(), &"https://spdx.org/licenses/MIT".into())
    );
    assert_eq!(named("SoftwareApplication").len(), 1);
    let one = |id: &str| {
        let mut found = graph.iter().filter(|one| one["@id"] == id);
        (found.next().unwrap(), found.count())
    };
    let (replan, others) = one("#replan");
    assert_eq!((replan["license"]["@id"].as_str(), others), (Some("https://spdx.org/licenses/MIT"), 0));
    assert_eq!(one("https://spdx.org/licenses/MIT").1, 0, "an address stands there once");
    let (run, _) = one("#run");
    assert!(run["description"].as_str().unwrap().starts_with("replan "), "{run}");
    assert!(one("#paper").0.get("creditText").is_none_or(Value::is_string));
}

#[test]
fn a_pack_has_the_files_of_planners_and_of_the_cross_check_that_specs_name() {
    let empty = Bench::empty();
    for paper in ["baselines", "gallery"] {
        let pack = empty.at(paper);
        let command = ["pack", paper, "--to", pack.to_str().unwrap(), "--date", "2026-01-31"];
        let done = empty.command(&command).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        for command in [&["check", "."][..], &["check", paper], &["judge", paper, "--check"]] {
            let done = empty.output(&empty.command(command).current_dir(&pack).output().unwrap());
            assert_eq!(done.code, Some(0), "{paper}, {command:?}: {}", done.err);
        }
    }
}

#[test]
fn an_exported_crate_is_the_pack() {
    let bench = packed();
    bench.done(&[
        "export",
        "./mini",
        "--to",
        "ro-crate",
        "--out",
        "crate",
        "--date",
        "2026-01-31",
        "--license",
        PACK[7],
    ]);
    let sums = |folder: &str| fs::read_to_string(bench.at(folder).join("SHA256SUMS")).unwrap();
    assert_eq!(sums("crate"), sums("pack"));
    let output = bench.run(&["export", "./mini", "--to", "ro-crate", "--out", "other"]);
    assert!(output.code == Some(2) && output.err.contains("--date <DAY>"), "{}", output.err);
    assert!(!bench.at("other").exists());
}

#[test]
fn a_pack_is_refused_whose_verdicts_or_figures_are_not_of_today() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let refused = |message: &str| {
        let output = bench.run(&PACK);
        assert_eq!(output.code, Some(3), "{message}: {}", output.err);
        assert!(output.err.contains(message), "{message}\nis not in\n{}", output.err);
        assert!(!bench.at("pack").exists(), "{message}");
    };
    bench.edit("mini/paper.toml", "is = \"lower\"", "is = \"higher\"");
    refused("verdicts.toml: not what the stored run gives");
    bench.edit("mini/paper.toml", "is = \"higher\"", "is = \"lower\"");
    fs::remove_file(bench.at("target/replan/mini/plots/mini/table1.tex")).unwrap();
    refused("table1.tex");
    bench.done(&["render", "./mini"]);
    bench.done(&PACK);
}

#[test]
fn a_file_that_is_changed_gone_or_added_is_named_and_a_place_that_is_taken_is_left_as_it_is() {
    let bench = packed();
    bench.write("pack/plots/mini/table1.tex", b"edited");
    fs::remove_file(bench.at("pack/page/mini.html")).unwrap();
    bench.write("pack/more.txt", b"added");
    let output = bench.run(&["check", "pack"]);
    assert_eq!(output.code, Some(3), "{}", output.err);
    for line in
        ["table1.tex: is not the file that was packed", "page/mini.html: ", "more.txt: was not packed"]
    {
        assert!(output.err.contains(line), "{line}\n{}", output.err);
    }
    let again = bench.run(&PACK);
    assert_eq!(again.code, Some(2));
    assert!(again.err.contains("pack is not empty; a new folder is accepted"), "{}", again.err);
    for (date, message) in [("31.1.2026", "a day as 2026-01-31 is accepted"), ("2026-13-01", "a day as")] {
        let output = bench.run(&["pack", "./mini", "--to", "other", "--date", date]);
        assert!(output.code == Some(2) && output.err.contains(message), "{}", output.err);
    }
    let output = bench.run(&["pack", "./mini", "--to", "other", "--date", "2026-01-31"]);
    assert!(output.code == Some(2) && output.err.contains("has no LICENSE; `--license`"), "{}", output.err);
    assert!(!bench.at("other").exists());
}
