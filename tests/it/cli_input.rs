//! Bad input: what is said, with which exit code, and that nothing which existed before is lost.

use crate::paper::Bench;
use crate::wrong_words::{WRONG, file};
use std::fs::{self, File};

#[test]
fn every_wrong_word_in_a_spec_is_reported_with_its_place_and_what_is_accepted() {
    let bench = Bench::new();
    assert_eq!(
        bench.done(&["check", "./mini"]),
        "mini: 2 studies, 2 claims, 2 inventory rows are in order\n"
    );
    let mut missed = Vec::new();
    for case in WRONG {
        let before = fs::read_to_string(bench.at(&file(case.file))).unwrap();
        bench.edit(&file(case.file), case.from, case.to);
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(
            (output.code, output.out.as_str()),
            (Some(2), ""),
            "{}: {}\n{}",
            case.file,
            case.to,
            output.err
        );
        assert!(output.err.starts_with("replan: "), "{}", output.err);
        if !output.err.contains(case.expected) {
            missed.push(format!(
                "{}: {}\nshould be said: {}\nis said: {}",
                case.file, case.to, case.expected, output.err
            ));
        }
        fs::write(bench.at(&file(case.file)), before).unwrap();
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

#[test]
fn faults_of_several_claims_and_of_several_names_in_one_check_are_reported_at_once() {
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "problems = \"drawn\"", "problems = [\"drown\", \"lost\"]");
    bench.edit("mini/paper.toml", "contender = \"Two-sided\"", "contender = \"Two\"");
    bench.edit("mini/paper.toml", "contenders = [\"A*\"]", "contenders = [\"B*\"]");
    bench.edit("mini/room.toml", "searched = true", "searched = true\nfitted_to = [\"cost\", \"toll\"]");
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    for fault in [
        "mini/paper.toml:27:15: there is no contender `B*`",
        "mini/paper.toml:38:13: study `draws` has no problem group `drown`",
        "mini/paper.toml:38:22: study `draws` has no problem group `lost`",
        "mini/paper.toml:40:13: study `draws` has no contender `Two`",
        "mini/room.toml:5:22: fitted_to: there is no claim `toll`",
    ] {
        assert!(output.err.contains(fault), "{fault}\nis said: {}", output.err);
    }
}

#[test]
fn files_that_are_no_toml_are_distinguished() {
    let bench = Bench::new();
    let whole = fs::read(bench.at("mini/draws.toml")).unwrap();
    let mut broken = whole.clone();
    broken[20] = 0xff;
    for (bytes, complaint) in [
        (&b""[..], "draws.toml:1:1: the file is empty; a TOML table is expected"),
        (b" \n\n", "draws.toml:1:1: the file is empty; a TOML table is expected"),
        (&whole[..whole.len() / 2], "draws.toml:"),
        (&broken, "byte 20 of the file is not UTF-8; UTF-8 text is accepted"),
        (b"\x00\x1bPAR1", "draws.toml:1:7: key with no value, expected `=`\n    ‹NUL›‹escape›PAR1\n"),
    ] {
        fs::write(bench.at("mini/draws.toml"), bytes).unwrap();
        let output = bench.run(&["repro", "./mini"]);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(output.err.contains(complaint), "{complaint}\nis said: {}", output.err);
    }
}

#[test]
fn a_study_cut_anywhere_is_never_taken_for_another_study() {
    let bench = Bench::new();
    let whole = fs::read_to_string(bench.at("mini/room.toml")).unwrap();
    let mut refused = 0;
    for cut in (0..whole.len() - 1).step_by(23) {
        fs::write(bench.at("mini/room.toml"), &whole[..cut]).unwrap();
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(output.code, Some(2), "cut at {cut}: {}{}", output.out, output.err);
        refused += 1;
    }
    assert!(refused > 20, "only {refused} cuts");
}

#[test]
fn papers_and_flags_that_do_not_exist_are_reported() {
    let bench = Bench::new();
    for (arguments, complaint) in [
        (
            &["repro", "zhong"][..],
            "`zhong` is neither a paper nor a folder with a paper.toml; there is no folder `experi",
        ),
        (&["check"], "there is no paper here to check; run replan from the project's own folder"),
        (&["repro", "./mini", "--with", "corners"], "--with: `corners` is not `choice=option`; `all` or"),
        (
            &["repro", "./mini", "--with", "corner=x"],
            "--with: there is no choice `corner` (did you mean `corners`?); there are ",
        ),
        (
            &["repro", "./mini", "--with", "corners=x"],
            "choice `corners` has no option `x`; it has allow, forbid_any",
        ),
        (
            &["repro", "./mini", "--with", "corners=allow,corners=forbid_any"],
            "--with: `corners` is given twice, as `allow` and as `forbid_any`; one option is accepted",
        ),
        (
            &["repro", "./mini", "--threads", "0"],
            "invalid value '0' for '--threads <N>': 0 is not in 1..=1024",
        ),
        (&["repro", "./mini", "--seed", "-1"], "'-1'"),
        (
            &["repro", "./mini", "--trial", "hall/x"],
            "there is no study `hall`; there are draws, room; write STUDY/TRIAL",
        ),
        (
            &["repro", "./mini", "--trial", "draws/x"],
            "study `draws` has no trial `x`; its first one is `draws/drawn/0/a",
        ),
        (
            &["repro", "./mini", "--trial", "draws/drawn/0/a-star/x"],
            "study `draws` has no trial `drawn/0/a-star/x` (did you mean `drawn/0/a-star`?); its first one is `draws/drawn/0/a",
        ),
        (&["judge", "./mini"], "no stored run"),
        (&["render", "./mini"], "verdicts.toml: no verdicts; run `replan judge` first"),
        (&["list", "plotters"], "invalid value 'plotters'"),
        (&["reproduce", "./mini"], "unrecognized subcommand 'reproduce'"),
    ] {
        let output = bench.run(arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        assert!(output.err.contains(complaint), "{arguments:?} is answered: {}", output.err);
    }
    assert!(!bench.at("target/replan/mini").exists(), "a refused command wrote something");
    assert!(!bench.at("target").exists(), "a refused command wrote below target");
}

#[test]
fn a_wrong_spec_leaves_an_older_run_as_it_was() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let before = bench.tree("target/replan/mini");
    assert!(before.len() > 15, "{:?}", before.keys());
    for case in WRONG.iter().step_by(7) {
        let text = fs::read_to_string(bench.at(&file(case.file))).unwrap();
        bench.edit(&file(case.file), case.from, case.to);
        assert_eq!(bench.run(&["repro", "./mini"]).code, Some(2), "{}", case.to);
        assert!(
            bench.tree("target/replan/mini") == before,
            "{}: {} changed what was stored",
            case.file,
            case.to
        );
        fs::write(bench.at(&file(case.file)), text).unwrap();
    }
}

#[test]
fn records_of_another_spec_truncated_or_missing_are_not_judged() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let trials = "target/replan/mini/data/runs/mini/draws.trials.parquet";
    let whole = fs::read(bench.at(trials)).unwrap();
    let refused = |complaint: &str| {
        for command in ["judge", "render"] {
            let output = bench.run(&[command, "./mini"]);
            assert_eq!(output.code, Some(2), "{command}: {}", output.err);
            assert!(output.err.contains(complaint), "{command}: {}", output.err);
        }
    };
    bench.write(trials, &whole[..whole.len() / 2]);
    refused("draws.trials.parquet: is not the file that the manifest names (sha256 ");
    bench
        .write(trials, &fs::read(bench.at("target/replan/mini/data/runs/mini/room.trials.parquet")).unwrap());
    refused("truncated, edited, or from another spec; put back the file");
    fs::remove_file(bench.at(trials)).unwrap();
    refused("draws.trials.parquet: cannot be read (");
    bench.done(&["repro", "./mini", "--replace-damaged"]);
    assert!(fs::read(bench.at(trials)).unwrap() == whole, "the repaired run differs");
    bench.edit("mini/draws.toml", "seed = 7", "seed = 9");
    refused(
        "draws.manifest.toml: the stored run was made by another spec; `replan run` runs study `draws` again",
    );
    bench.write("target/replan/mini/data/runs/mini/draws.manifest.toml", b"study = 3");
    refused(
        "draws.manifest.toml:1:9: is not what replan wrote: truncated, edited, or of another version; put back",
    );
}

#[test]
fn places_that_cannot_be_written_are_reported_with_exit_code_1() {
    let bench = Bench::new();
    bench.write("file", b"in the way");
    let output = bench.run(&["repro", "./mini", "--out", "file/below"]);
    assert_eq!(output.code, Some(1), "{}", output.err);
    assert_eq!(
        output.err,
        "replan: file/below/paper_repro.md: reading the report: Not a directory (os error 20)\n"
    );
    assert_eq!(fs::read(bench.at("file")).unwrap(), b"in the way");
}

#[test]
fn a_folder_where_a_record_belongs_stops_the_run_before_any_record_changes() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let times = "target/replan/mini/data/runs/mini/draws.times.parquet";
    fs::remove_file(bench.at(times)).unwrap();
    fs::create_dir(bench.at(times)).unwrap();
    let before = bench.tree("target/replan/mini");
    bench.edit("mini/draws.toml", "seed = 7", "seed = 9");
    let output = bench.run(&["repro", "./mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(
        output.err.contains("draws.times.parquet: cannot be read (a link, a pipe or a folder"),
        "{}",
        output.err
    );
    let after = bench.tree("target/replan/mini");
    assert!(
        before.iter().all(|(path, bytes)| after.get(path) == Some(bytes)),
        "an older record was replaced"
    );
    assert!(after.len() == before.len(), "something was written");
}

#[test]
fn a_second_run_into_one_folder_is_refused_and_disturbs_nothing() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let before = bench.tree("target/replan/mini");
    let lock = File::open(bench.at("target/replan/mini/data/runs/mini/.lock")).unwrap();
    lock.try_lock().unwrap();
    let output = bench.run(&["repro", "./mini"]);
    assert_eq!(output.code, Some(1), "{}", output.err);
    assert_eq!(
        output.err,
        "replan: target/replan/mini/data/runs/mini: another run is writing here; wait for it or choose another place with \
         --out\n"
    );
    assert!(bench.tree("target/replan/mini") == before, "the refused run changed something");
    drop(lock);
    bench.done(&["repro", "./mini"]);
}

#[test]
fn a_map_or_verdicts_that_are_no_text_are_reported_with_the_byte_and_a_paper_without_study_as_such() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    bench.write("target/replan/mini/data/runs/mini/verdicts.toml", b"paper = \"\xff\"");
    let output = bench.run(&["render", "./mini"]);
    assert_eq!(
        (output.code, output.err.contains("verdicts.toml: line 1, byte 9 of the file is not UTF-8")),
        (Some(2), true),
        "{}",
        output.err
    );
    bench.write("mini/room.map.txt", b"; a room\n..\xff.\n");
    let output = bench.run(&["check", "./mini"]);
    assert!(
        output.err.contains("line 2, byte 11 of the file is not UTF-8; UTF-8 text is accepted"),
        "{}",
        output.err
    );
    for study in ["draws", "room"] {
        fs::remove_file(bench.at(&format!("mini/{study}.toml"))).unwrap();
    }
    let output = bench.run(&["check", "./mini"]);
    assert_eq!(
        (output.code, output.err.as_str()),
        (Some(2), "replan: ./mini: no study; a study is a TOML file beside paper.toml\n")
    );
}

#[test]
fn one_broken_paper_does_not_hide_the_others() {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    bench.write("experiments/abroken/paper.toml", b"[source\n");
    let output = bench.run(&["check"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(output.out.starts_with("mini: 2 studies"), "{}", output.out);
    assert!(output.err.contains("abroken/paper.toml:1:8: "), "{}", output.err);
    assert!(output.err.ends_with("replan: 1 of 2 papers are not in order\n"), "{}", output.err);
    let output = bench.run(&["list"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    for name in ["  mini ", "  mini/draws ", "  astar ", "  grid_search "] {
        assert!(output.out.contains(name), "{name}\n{}", output.out);
    }
    assert!(bench.done(&["list", "planners"]).contains("  astar "), "planners need no paper");
}

#[test]
fn a_contender_that_asks_for_more_of_a_roadmap_than_there_is_is_refused_before_any_trial() {
    let bench = Bench::new();
    bench.add_plane();
    let whole = fs::read(bench.at("mini/plane.toml")).unwrap();
    assert!(bench.done(&["check", "./mini"]).starts_with("mini: 3 studies"));
    let sweep = |values: &str| {
        format!("[[sweep]]\nkey = \"samples\"\nstage = \"roadmap_astar\"\nvalues = [{values}]\n[budget]")
    };
    for (from, to, expected) in [
        (
            "samples = 30, n",
            "samples = 31, n".to_owned(),
            "mini/plane.toml:16:12: contender `Improved A*` on problems `plane`: 31 samples are requested; the roadmap \
             was built with 30",
        ),
        (
            "neighbour_mm = 40",
            "neighbour_mm = 40.5".to_owned(),
            "contender `Improved A*` on problems `plane`: neighbours up to 40.5 mm are requested; the roadmap was built \
             up to 40 mm",
        ),
        (
            "[budget]",
            sweep("20, 31"),
            "contender `Improved A*` at samples=31 on problems `plane`: 31 samples are requested",
        ),
    ] {
        bench.edit("mini/plane.toml", from, &to);
        for command in ["check", "run"] {
            let answer = bench.run(&[command, "./mini"]);
            assert_eq!(answer.code, Some(2), "{}{}", answer.out, answer.err);
            assert!(answer.err.contains(expected), "should be said: {expected}\nis said: {}", answer.err);
        }
        bench.write("mini/plane.toml", &whole);
    }
    bench.edit("bar.toml", "start_mm = [5, 5]", "start_mm = [50, 25]");
    let answer = bench.run(&["check", "./mini"]);
    let expected = "replan: bar.toml:3:12: the start cannot be posed: [50.0, 25.0] is in obstacle 1";
    assert!(answer.code == Some(2) && answer.err.starts_with(expected), "{}", answer.err);
    bench.edit("bar.toml", "start_mm = [50, 25]", "start_mm = [5, 5]");
    // A sweep's own values count, not what it takes the place of.
    bench.edit("mini/plane.toml", "samples = 30, n", "samples = 31, n");
    bench.edit("mini/plane.toml", "[budget]", &sweep("20, 30"));
    bench.done(&["check", "./mini"]);
}

#[test]
fn a_list_takes_studies_as_they_are_written_and_one_alone_is_built() {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    bench.edit("experiments/mini/draws.toml", "size_cells = [12, 12]", "size_cells = [0, 12]");
    assert!(bench.done(&["list", "studies"]).contains("  mini/draws "));
    let output = bench.run(&["list", "studies", "mini/draws"]);
    assert_eq!(output.code, Some(2), "{}", output.out);
    assert!(output.err.contains("size_cells"), "{}", output.err);
}
