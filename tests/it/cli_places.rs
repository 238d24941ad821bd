//! Where outputs go: the committed places belong to full runs of the project's papers, a user's own paper keeps its own.

use crate::paper::Bench;
use std::fs;
use std::os::unix::fs::symlink;

#[test]
fn another_seed_and_another_option_write_elsewhere() {
    let bench = Bench::new();
    for (flags, place) in [
        (&["--seed", "9"][..], "target/replan/mini-seed-9"),
        (&["--with", "corners=forbid_any"], "target/replan/mini-with-corners-forbid-any"),
        (&["--with", "all"], "target/replan/mini-with-all"),
        (&["--quick", "--seed", "9"], "target/replan/mini-quick-seed-9"),
    ] {
        bench.done(&[&["repro", "./mini"], flags].concat());
        assert_eq!(bench.facts(place).len(), 6, "{flags:?}");
    }
    assert!(!bench.at("target/replan/mini").exists());
    let trials = |place: &str| bench.facts(place)["draws.trials.parquet"].clone();
    let all = ["seed-9", "with-corners-forbid-any", "with-all"]
        .map(|name| trials(&format!("target/replan/mini-{name}")));
    assert!(all[0] != all[1] && all[1] != all[2] && all[0] != all[2]);
}

#[test]
fn a_chapter_names_the_studies_that_leave_out_what_it_was_judged_under() {
    let bench = Bench::new();
    let untouched = |place: &str, flags: &[&str]| {
        bench.done(&[&["repro", "./mini"], flags].concat());
        let report = fs::read_to_string(bench.at(&format!("target/replan/{place}/paper_repro.md"))).unwrap();
        report.contains("Without all of this interpretation: `room`; claims")
    };
    assert!(!untouched("mini", &[]));
    assert!(untouched("mini-with-corners-forbid-any", &["--with", "corners=forbid_any"]));
}

#[test]
fn a_paper_of_the_project_is_found_by_name_and_writes_the_committed_places() {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    bench.done(&["repro", "mini"]);
    for place in ["data/runs/mini/verdicts.toml", "plots/mini/fig1.png", "paper_repro.md"] {
        assert!(bench.at(place).is_file(), "{place}");
    }
    assert!(bench.done(&["check"]).starts_with("mini: 2 studies"));
    assert!(bench.done(&["check", "experiments/mini/draws.toml"]).starts_with("mini: 2 studies"));
    let listed = bench.done(&["list"]);
    for name in ["  mini ", "  mini/draws ", "  mini/corners ", "  astar ", "  grid_search ", "  lower "] {
        assert!(listed.contains(name), "{name}\n{listed}");
    }
}

#[test]
fn robots_are_listed_with_the_solver_that_fits_and_a_broken_file_is_called_broken() {
    let bench = Bench::new();
    let ur5 = include_str!("../../data/robots/ur5.toml");
    bench.write("data/robots/ur5.toml", ur5.as_bytes());
    // Lines are broken at the terminal's width.
    let list =
        |bench: &Bench| bench.done(&["list", "robots"]).split_whitespace().collect::<Vec<_>>().join(" ");
    let listed = list(&bench);
    assert!(listed.contains("robots ur5 "), "{listed}");
    assert!(listed.contains("inverse kinematics by `offset_wrist`; bodies: rods"), "{listed}");
    bench.write("data/robots/panda.urdf", include_bytes!("../../data/robots/panda.urdf"));
    let listed = list(&bench);
    assert!(listed.contains("panda.urdf 7 axes: planned in joint space"), "{listed}");
    let bent = ur5.replacen("alpha_deg = -90", "alpha_deg = -80", 1);
    bench.write("data/robots/bent.toml", bent.replace("\"ur5\"", "\"bent\"").as_bytes());
    let listed = list(&bench);
    assert!(
        listed.contains("by `numerical`, which may miss configurations; joint 5: alpha_deg is -80"),
        "{listed}"
    );
    bench.write("data/robots/bent.toml", bent.replace("d_mm = 82.3", "").as_bytes());
    let output = bench.run(&["list", "robots"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert!(
        output.out.contains("  ur5 ") && output.err.contains("missing key `d_mm`"),
        "{}\n{}",
        output.out,
        output.err
    );
}

/// A bench that is a project: its paper lies in `experiments`.
fn project() -> Bench {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    bench
}

#[test]
fn a_run_that_is_not_a_full_one_is_refused_the_committed_places_however_they_are_written() {
    let bench = project();
    bench.done(&["repro", "mini"]);
    let before = bench.tree("");
    let here = bench.at("").display().to_string();
    for out in [".", "./", "experiments/..", "new/..", "new/deep/../..", &here] {
        for flags in [&["--quick"][..], &["--seed", "5"], &["--with", "all"], &["--quick", "--fresh"]] {
            let output = bench.run(&[&["repro", "mini", "--out", out], flags].concat());
            assert_eq!(output.code, Some(2), "--out {out} {flags:?}: {}", output.err);
            assert!(
                output.err.contains("is where full runs are kept, and this is not one ("),
                "{}",
                output.err
            );
        }
    }
    assert!(bench.tree("") == before, "a refused run wrote something");
    let own = Bench::new();
    let output = own.run(&["repro", "./mini", "--quick", "--out", "target/replan/mini"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    bench.done(&["repro", "mini", "--quick", "--out", "elsewhere"]);
    bench.done(&["repro", "mini", "--out", "."]);
}

#[test]
fn an_own_paper_writes_below_target_and_neither_into_the_project_nor_its_own_folder() {
    let bench = project();
    let own = Bench::new();
    let before = bench.tree("experiments");
    let folder = own.tree("");
    bench.done(&["repro", own.at("mini").to_str().unwrap()]);
    assert!(own.tree("") == folder, "the paper's own folder was written to");
    assert!(bench.tree("experiments") == before, "the project was written to");
    for place in ["data", "plots", "paper_repro.md"] {
        assert!(!bench.at(place).exists(), "{place} of the project was written to");
        assert!(bench.at("target/replan/mini").join(place).exists(), "{place} is missing");
    }
}

#[test]
fn an_own_paper_whose_path_is_spelled_otherwise_runs_nothing_again() {
    let bench = Bench::new();
    let absolute = bench.at("mini").display().to_string();
    assert!(!bench.done(&["run", "./mini"]).contains("reused"));
    let before = bench.tree("target");
    for spelled in ["mini", "mini/", "../mini/../mini", "./mini/.", &absolute] {
        let spelled = spelled.replace("../mini/..", "./mini/..");
        let out = bench.done(&["repro", &spelled]);
        assert!(out.starts_with("2 studies: nothing to run, "), "{spelled}: {out}");
    }
    let after = bench.tree("target");
    assert!(before.iter().all(|(path, bytes)| after[path] == *bytes), "a record was written again");
}

#[test]
fn a_paper_of_the_project_is_the_same_however_it_is_named() {
    let bench = project();
    let absolute = bench.at("experiments/mini").display().to_string();
    bench.done(&["repro", "mini"]);
    let before = bench.tree("");
    for name in ["experiments/mini", "./experiments/mini", &absolute] {
        let out = bench.done(&["repro", name]);
        assert!(out.starts_with("2 studies: nothing to run, "), "{name}: {out}");
        assert!(bench.tree("") == before, "{name} wrote elsewhere");
    }
}

#[test]
fn an_own_paper_runs_from_within_its_folder_and_through_a_link() {
    let bench = Bench::new();
    symlink(bench.at("mini"), bench.at("link")).unwrap();
    for (folder, name) in [("mini", "."), ("mini", "./"), ("mini", "../mini"), ("", "./link"), ("", "link")] {
        let output =
            bench.output(&bench.command(&["run", name]).current_dir(bench.at(folder)).output().unwrap());
        assert_eq!(output.code, Some(0), "{name} in `{folder}`: {}", output.err);
        let again = output.out.contains("draws: 48 trials (24 of 24 units reused)");
        assert!(again || (folder, name) == ("mini", "."), "{name} in `{folder}`: {}", output.out);
        assert!(bench.at("target/replan/mini/data/runs/mini/draws.manifest.toml").is_file());
        assert!(!bench.at("mini/target").exists(), "{name} in `{folder}` wrote into the paper's folder");
    }
    let check = bench.command(&["check", "paper.toml"]).current_dir(bench.at("mini")).output().unwrap();
    assert_eq!(bench.output(&check).out, "mini: 2 studies, 2 claims, 2 inventory rows are in order\n");
}

#[test]
fn a_paper_of_the_project_writes_the_committed_places_from_within_its_folder_too() {
    let bench = project();
    bench.done(&["repro", "mini"]);
    let before = bench.tree("");
    for (folder, name) in [("experiments/mini", "."), ("experiments", "mini"), ("experiments", "./mini")] {
        let command = bench.command(&["repro", name]).current_dir(bench.at(folder)).output().unwrap();
        let output = bench.output(&command);
        assert_eq!(output.code, Some(0), "{name} in `{folder}`: {}", output.err);
        assert!(
            output.out.starts_with("2 studies: nothing to run, "),
            "{name} in `{folder}`: {}",
            output.out
        );
        let after = bench.tree("");
        assert!(after.keys().eq(before.keys()) && after == before, "{name} in `{folder}` wrote elsewhere");
    }
}

#[test]
fn the_report_keeps_what_others_wrote_and_is_refused_where_it_cannot() {
    let bench = Bench::new();
    let report = "target/replan/mini/paper_repro.md";
    let mine = "# My notes\n\nA remark.\n\n<!-- replan begin zz other -->\n\nx\n\n<!-- replan end zz other -->\n\nThe end";
    bench.write(report, mine.as_bytes());
    bench.done(&["repro", "./mini"]);
    let text = fs::read_to_string(bench.at(report)).unwrap();
    let (before, after) = mine.split_once("<!-- replan begin zz").unwrap();
    assert!(text.starts_with(before) && text.ends_with(after), "{text}");
    let runs = bench.tree("target/replan/mini/data");
    for (broken, expected) in [
        (text.replace("<!-- replan end mini -->", "").into_bytes(), "`zz other` begins within `mini`"),
        (text.replace("<!-- replan end zz other -->", "").into_bytes(), "`zz other` begins and has no end"),
        (
            [text.as_bytes(), b"\xff"].concat(),
            "is not UTF-8; mend it, move it away, or write elsewhere with --out",
        ),
    ] {
        bench.write(report, &broken);
        for command in [&["repro", "./mini", "--fresh"][..], &["render", "./mini"]] {
            let answer = bench.run(command);
            assert_eq!(answer.code, Some(2), "{command:?}: {}", answer.err);
            assert!(answer.err.contains(expected), "{command:?}: {}", answer.err);
        }
        assert!(fs::read(bench.at(report)).unwrap() == broken, "the broken report was touched");
        assert!(bench.tree("target/replan/mini/data") == runs, "a refused command ran something");
    }
}

#[test]
fn a_paper_file_that_is_no_regular_file_is_refused_with_that_cause() {
    let bench = Bench::new();
    fs::remove_file(bench.at("mini/paper.toml")).unwrap();
    symlink("/dev/zero", bench.at("mini/paper.toml")).unwrap();
    let output = bench.run(&["check", "./mini"]);
    let cause = "./mini/paper.toml: it is a device, a pipe or a socket; a regular file is accepted";
    assert!(output.err.contains(cause), "{}", output.err);
    assert_eq!(output.code, Some(2));
}
