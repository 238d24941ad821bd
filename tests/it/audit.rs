//! `replan audit` as people call it: lines, exit codes, standard input, files that it writes; and what its package knows of others.

use crate::paper::Bench;
use crate::source::PACKAGES;
use std::io::Write as _;
use std::path::Path;
use std::process::Stdio;

const TABLE: &str = "| planner | success [% of 250] |\n|-|-|\n| A | 33.3 |\n| B | 33.2 |\n";

#[test]
fn an_impossible_table_is_told_in_a_line_with_exit_code_3() {
    let bench = Bench::new();
    bench.write("t.md", TABLE.as_bytes());
    let said = bench.run(&["audit", "t.md", "--certificates", "proofs"]);
    assert_eq!(said.code, Some(3), "{}", said.err);
    let first = said.out.lines().next().unwrap();
    assert!(
        first.starts_with("t.md:3:2: impossible: success of A: 33.3 is the mean of no 250 values"),
        "{first}"
    );
    assert_eq!(said.err, "replan: t.md: 1 finding is impossible under the premises named\n");
    assert!(bench.at("proofs/001_3_grim.json").is_file());
}

#[test]
fn a_possible_table_ends_with_0_and_shows_its_data_if_asked() {
    let bench = Bench::new();
    bench.write("t.md", TABLE.replace("33.3", "33.6").as_bytes());
    let said = bench.done(&["audit", "t.md", "--witness"]);
    assert!(said.contains("data (all of them, 1 of 100000 steps): 84 × 2/5 of 250"), "{said}");
    let json = bench.done(&["audit", "t.md", "--json"]);
    assert!(json.contains("\"check\": \"grim\"") && json.contains("\"power\""), "{json}");
    assert!(json.contains("\"guessed\"") && json.contains("planner [label]"), "{json}");
}

#[test]
fn samples_of_other_methods_are_not_taken_for_one() {
    let bench = Bench::new();
    for possible in [
        "planner,stat,time\nA,min,1\nA,mean,2.00\nA,max,3\nB,min,9\nB,mean,10.00\nB,max,11\n",
        "stat,time\nmin,1\nmean,2.00\nmax,3\nmin,9\nmean,10.00\nmax,11\n",
        "p,time [min],time [max],time [min],time [max]\nx,1,3,9,11\n",
    ] {
        bench.write("t.csv", possible.as_bytes());
        assert_eq!(bench.run(&["audit", "t.csv"]).code, Some(0), "{possible}");
    }
    let second = "p,a [mean],a [min],a [mean],a [min]\nx,2.0,1,5.0,7\n";
    bench.write("t.csv", second.as_bytes());
    assert_eq!(bench.run(&["audit", "t.csv"]).code, Some(3), "the second sample is not looked at");
    let quotients = "| p | time [mean, n=2] | it [mean, n=2] | r [mean, n=2, ratio=time/it] |\n|-|-|-|-|\n| x | 5.00 | 2.00 | 2.00 |\n";
    bench.write("t.md", quotients.as_bytes());
    assert_eq!(bench.run(&["audit", "t.md"]).code, Some(0), "times 1, 9 and 1, 3 iterations");
}

#[test]
fn a_text_that_includes_others_says_that_they_were_not_read() {
    let bench = Bench::new();
    bench.write("numbers.tex", b"\\newcommand{\\nodes}{45}\n");
    bench.write("paper.tex", b"\\input{numbers}\nWe open \\nodes{} nodes.\n\\input{sections/two}\n");
    let said = bench.run(&["audit", "--coverage", "paper.tex", "--macros", "numbers.tex"]);
    assert_eq!(said.code, Some(3), "{}", said.err);
    let unread: Vec<&str> = said.out.lines().filter(|line| line.contains("is included")).collect();
    assert_eq!(unread, ["paper.tex: `sections/two` is included and was not read; ask about it by itself"]);
}

#[test]
fn standard_input_is_read_and_wrong_input_ends_with_2() {
    let bench = Bench::new();
    let mut child = bench.command(&["audit", "-"]).stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(TABLE.replace("33.3", "33,3").as_bytes()).unwrap();
    let said = bench.said(&child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(2));
    assert!(
        said.err.starts_with("replan: stdin:3:2: column `success`: `33,3` has a decimal comma"),
        "{}",
        said.err
    );
}

#[test]
fn a_number_that_no_macro_backs_ends_with_3() {
    let bench = Bench::new();
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = bench.at("paper.tex");
    let called = || {
        let mut command =
            bench.command(&["audit", "--macros", "plots/movingai_sample/numbers.tex", "--coverage"]);
        bench.said(&command.arg(&text).current_dir(home).output().unwrap())
    };
    bench.write("paper.tex", b"We open 31415 nodes on eleven maps.\n");
    let said = called();
    assert_eq!(said.code, Some(3));
    let lines: Vec<&str> = said.out.lines().map(|line| line.rsplit("paper.tex:").next().unwrap()).collect();
    assert_eq!(lines, ["1:9: 31415 is backed by no macro", "1:24: eleven is backed by no macro"]);
    bench.write("paper.tex", b"We open many nodes on eleven maps. % typed: eleven\n");
    assert_eq!(called().code, Some(0));
}

#[test]
fn macros_of_which_nobody_can_tell_whether_they_are_stale_do_not_pass() {
    let bench = Bench::new();
    bench.write("numbers.tex", b"\\newcommand{\\nodes}{45}\n");
    bench.write("paper.tex", b"We open \\nodes{} nodes.\n");
    for first in ["", "% made by `replan render no_such_paper --only numbers`\n"] {
        bench.write("numbers.tex", format!("{first}\\newcommand{{\\nodes}}{{45}}\n").as_bytes());
        let said = bench.run(&["audit", "--coverage", "paper.tex", "--macros", "numbers.tex"]);
        assert_eq!(said.code, Some(3), "{}", said.err);
        assert!(
            said.out.starts_with("numbers.tex:1: whether its values are stale cannot be told; "),
            "{}",
            said.out
        );
        assert_eq!(said.out.lines().count(), 1);
    }
}

#[test]
fn a_stub_of_a_csv_is_a_csv_and_no_data_can_not_be_asked_for() {
    let bench = Bench::new();
    bench.write("t.csv", b"planner,Success rate (%),Time (s)\nA,33.2 %,1.2 s\n");
    let said = bench.done(&["audit", "t.csv", "--stub", "header.csv"]);
    let stub =
        "planner [label],Success rate (%) [% of ?, higher is better],Time (s) [mean, n=?, lower is better]";
    assert_eq!(std::fs::read_to_string(bench.at("header.csv")).unwrap(), format!("{stub}\n"));
    assert!(said.contains(&format!("correct the header: {stub}")), "{said}");
    let said = bench.run(&["audit", "t.csv", "--witness", "0"]);
    assert_eq!(said.code, Some(2), "{}", said.err);
}

#[test]
fn a_spread_that_no_check_looks_at_is_asked_for() {
    let bench = Bench::new();
    bench.write("t.md", b"| p | success [% of 250] |\n|-|-|\n| A | 33.2 (1.2) |\n");
    let said = bench.done(&["audit", "t.md"]);
    let first = said.lines().next().unwrap();
    assert_eq!(
        first,
        "t.md:3:2: column `success`: what stands behind 33.2 (1.2) is not looked at; say `±sd` if it is the deviation or `±se` if it is the standard error"
    );
    let json = bench.done(&["audit", "t.md", "--json"]);
    assert!(json.contains("\"unread_spreads\": [") && json.contains("t.md:3:2: column `success`"), "{json}");
}

#[test]
fn a_macro_that_the_stored_run_does_not_give_is_stale() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bench = Bench::new();
    let stored = std::fs::read_to_string(home.join("plots/movingai_sample/numbers.tex")).unwrap();
    let line = stored.lines().position(|line| line.contains("Ours}{")).unwrap();
    let value = stored.lines().nth(line).unwrap().split(['{', '}']).nth(3).unwrap().to_owned();
    let wrong = stored.replacen(&format!("Ours}}{{{value}}}"), "Ours}{31415}", 1);
    bench.write("copy.tex", wrong.as_bytes());
    bench.write("paper.tex", b"No number.\n");
    let (text, copy) = (bench.at("paper.tex"), bench.at("copy.tex"));
    let called = |macros: &Path| {
        let mut command = bench.command(&["audit", "--coverage"]);
        command.arg(&text).arg("--macros").arg(macros).current_dir(home);
        bench.said(&command.output().unwrap())
    };
    let said = called(&copy);
    assert_eq!(said.code, Some(3), "{}", said.err);
    let expected = format!("copy.tex:{}:1: ", line + 1);
    assert!(said.out.contains(&expected) && said.out.contains("is 31415, but now it is"), "{}", said.out);
    assert_eq!(said.out.lines().count(), 1);
    assert_eq!(called(Path::new("plots/movingai_sample/numbers.tex")).code, Some(0));
}

#[test]
fn the_audit_depends_on_nothing_that_plans() {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/audit/Cargo.toml");
    let manifest: toml::Table = std::fs::read_to_string(manifest).unwrap().parse().unwrap();
    let own = |name: &&String| PACKAGES.contains(&name.as_str());
    let found: Vec<&String> = manifest["dependencies"].as_table().unwrap().keys().filter(own).collect();
    assert_eq!(found, ["stats", "turns"]);
}
