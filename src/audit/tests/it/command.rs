//! The program as people call it: lines, exit codes, standard input, files that it writes.

use rand::{RngExt, SeedableRng, rngs::SmallRng};
use std::fs;
use std::io::Write as _;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A folder of its own, and the program run in it.
struct Bench(TempDir);

struct Answer {
    code: Option<i32>,
    out: String,
    err: String,
}

impl Bench {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        fs::create_dir_all(self.at(name).parent().unwrap()).unwrap();
        fs::write(self.at(name), bytes).unwrap();
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_replan-audit"));
        command.current_dir(self.0.path()).args(arguments);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, arguments: &[&str]) -> Answer {
        answer(&self.command(arguments).output().unwrap())
    }

    /// Runs the program, which must succeed, and gives what it printed.
    fn done(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert_eq!(output.code, Some(0), "{arguments:?}\n{}{}", output.out, output.err);
        output.out
    }
}

fn answer(output: &Output) -> Answer {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    Answer { code: output.status.code(), out: text(&output.stdout), err: text(&output.stderr) }
}

const TABLE: &str = "| planner | success [% of 250] |\n|-|-|\n| A | 33.3 |\n| B | 33.2 |\n";

#[test]
fn an_impossible_table_is_reported_in_a_line_with_exit_code_3() {
    let bench = Bench::new();
    bench.write("t.md", TABLE.as_bytes());
    let output = bench.run(&["t.md", "--certificates", "proofs"]);
    assert_eq!(output.code, Some(3), "{}", output.err);
    let first = output.out.lines().next().unwrap();
    assert!(
        first.starts_with("t.md:3:2: impossible: success of A: 33.3 is the mean of no 250 values"),
        "{first}"
    );
    assert_eq!(output.err, "replan: t.md: 1 finding is impossible under the premises named\n");
    assert!(bench.at("proofs/001_3_grim.json").is_file());
}

#[test]
fn a_possible_table_ends_with_0_and_shows_its_data_on_request() {
    let bench = Bench::new();
    bench.write("t.md", TABLE.replace("33.3", "33.6").as_bytes());
    let output = bench.done(&["t.md", "--witness"]);
    assert!(output.contains("data (all of them, 1 of 100000 steps): 84 × 2/5 of 250"), "{output}");
    let json = bench.done(&["t.md", "--json"]);
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
        assert_eq!(bench.run(&["t.csv"]).code, Some(0), "{possible}");
    }
    let second = "p,a [mean],a [min],a [mean],a [min]\nx,2.0,1,5.0,7\n";
    bench.write("t.csv", second.as_bytes());
    assert_eq!(bench.run(&["t.csv"]).code, Some(3), "the second sample is not looked at");
    let quotients = "| p | time [mean, n=2] | it [mean, n=2] | r [mean, n=2, ratio=time/it] |\n|-|-|-|-|\n| x | 5.00 | 2.00 | 2.00 |\n";
    bench.write("t.md", quotients.as_bytes());
    assert_eq!(bench.run(&["t.md"]).code, Some(0), "times 1, 9 and 1, 3 iterations");
}

#[test]
fn a_text_that_includes_others_says_that_they_were_not_read() {
    let bench = Bench::new();
    bench.write("numbers.tex", b"\\newcommand{\\nodes}{45}\n");
    bench.write("paper.tex", b"\\input{numbers}\nWe open \\nodes{} nodes.\n\\input{sections/two}\n");
    let output = bench.run(&["--coverage", "paper.tex", "--macros", "numbers.tex"]);
    assert_eq!(output.code, Some(3), "{}", output.err);
    let unread: Vec<&str> = output.out.lines().filter(|line| line.contains("is included")).collect();
    assert_eq!(unread, ["paper.tex: `sections/two` is included and was not read; ask about it by itself"]);
}

#[test]
fn standard_input_is_read_and_wrong_input_ends_with_2() {
    let bench = Bench::new();
    let mut child = bench.command(&["-"]).stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(TABLE.replace("33.3", "33,3").as_bytes()).unwrap();
    let output = answer(&child.wait_with_output().unwrap());
    assert_eq!(output.code, Some(2));
    assert!(
        output.err.starts_with("replan: stdin:3:2: column `success`: `33,3` has a decimal comma"),
        "{}",
        output.err
    );
}

#[test]
fn a_stub_of_a_csv_is_a_csv_and_a_search_for_no_data_is_refused() {
    let bench = Bench::new();
    bench.write("t.csv", b"planner,Success rate (%),Time (s)\nA,33.2 %,1.2 s\n");
    let output = bench.done(&["t.csv", "--stub", "header.csv"]);
    let stub =
        "planner [label],Success rate (%) [% of ?, higher is better],Time (s) [mean, n=?, lower is better]";
    assert_eq!(std::fs::read_to_string(bench.at("header.csv")).unwrap(), format!("{stub}\n"));
    assert!(output.contains(&format!("correct the header: {stub}")), "{output}");
    let output = bench.run(&["t.csv", "--witness", "0"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
}

#[test]
fn a_spread_that_no_check_looks_at_is_reported() {
    let bench = Bench::new();
    bench.write("t.md", b"| p | success [% of 250] |\n|-|-|\n| A | 33.2 (1.2) |\n");
    let output = bench.done(&["t.md"]);
    let first = output.lines().next().unwrap();
    assert_eq!(
        first,
        "t.md:3:2: column `success`: what stands behind 33.2 (1.2) is not looked at; say `±sd` if it is the deviation or `±se` if it is the standard error"
    );
    let json = bench.done(&["t.md", "--json"]);
    assert!(json.contains("\"unread_spreads\": [") && json.contains("t.md:3:2: column `success`"), "{json}");
}

#[test]
fn a_device_without_end_and_bytes_that_are_no_text_are_wrong_input() {
    let bench = Bench::new();
    bench.write("t.md", b"| a |\n|-|\n| \xff |\n");
    let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    bench.write("wide.csv", &wide("\u{feff}a\n1\n"));
    bench.write("bare.csv", &wide("a,b\n1,2\n"));
    for (file, expected) in [
        (
            "/dev/zero",
            "/dev/zero: it is a folder, a device or a socket; a regular file or a pipe is accepted",
        ),
        (".", ".: it is a folder, a device or a socket; a regular file or a pipe is accepted"),
        ("t.md", "t.md: line 3, byte 12 of the file is not UTF-8; UTF-8 text is accepted"),
        ("wide.csv", "wide.csv: it is UTF-16 text; UTF-8 text is accepted"),
        (
            "bare.csv",
            "bare.csv: it seems to be UTF-16 text without a byte-order mark; UTF-8 text is accepted",
        ),
        ("gone.md", "gone.md: No such file or directory"),
    ] {
        let output = bench.run(&[file]);
        assert!(output.code == Some(2) && output.err.contains(expected), "{}", output.err);
    }
}

#[test]
fn output_that_a_full_disk_loses_is_the_systems_refusal() {
    let full = fs::File::create("/dev/full").unwrap();
    let ended = Bench::new().command(&["--list"]).stdout(full).output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    assert!(answer(&ended).err.starts_with("replan: standard output: "));
}

/// The macros of `text`, checked with a stand-in for `replan` that finds the plots of the paper current, or fails.
fn covered(bench: &Bench, first: &str, value: u32, is_current: bool) -> Answer {
    let check = "[ \"$*\" = 'render --check --only numbers -- mini' ]";
    let ends = if is_current { "" } else { " && echo 'replan: not current: numbers.tex' >&2 && exit 3" };
    bench.write("replan", format!("#!/bin/sh\n{check}{ends}\n").as_bytes());
    fs::set_permissions(bench.at("replan"), fs::Permissions::from_mode(0o755)).unwrap();
    let macros = |value: u32| format!("{first}\\newcommand{{\\nodes}}{{{value}}}\n");
    bench.write("experiments/mini/paper.toml", b"");
    bench.write("plots/mini/numbers.tex", macros(45).as_bytes());
    bench.write("numbers.tex", macros(value).as_bytes());
    let mut command = bench.command(&["--coverage", "paper.tex", "--macros", "numbers.tex"]);
    answer(&command.env("REPLAN", bench.at("replan")).output().unwrap())
}

const FIRST: &str = "% made by `replan render mini --only numbers`\n";

#[test]
fn a_number_that_no_macro_backs_ends_with_3() {
    let bench = Bench::new();
    bench.write("paper.tex", b"We open 31415 nodes on eleven maps.\n");
    let output = covered(&bench, FIRST, 45, true);
    assert_eq!(output.code, Some(3));
    let lines: Vec<&str> = output.out.lines().collect();
    assert_eq!(
        lines,
        ["paper.tex:1:9: 31415 is backed by no macro", "paper.tex:1:24: eleven is backed by no macro"]
    );
    bench.write("paper.tex", b"We open many nodes on eleven maps. % typed: eleven\n");
    let output = covered(&bench, FIRST, 45, true);
    assert_eq!((output.code, &*output.out), (Some(0), ""), "{}", output.err);
}

#[test]
fn a_macro_that_the_papers_plots_do_not_have_is_stale() {
    let bench = Bench::new();
    bench.write("paper.tex", b"No number.\n");
    let output = covered(&bench, FIRST, 31415, true);
    assert_eq!(
        (output.code, &*output.out),
        (Some(3), "numbers.tex:2:1: \\nodes is 31415, but now it is 45\n")
    );
}

#[test]
fn macros_of_which_nobody_can_tell_whether_they_are_stale_do_not_pass() {
    let bench = Bench::new();
    bench.write("paper.tex", b"We open \\nodes{} nodes.\n");
    for (first, is_current, why) in [
        ("", true, "its first line must be as `replan render PAPER` writes it"),
        ("% made by `replan render other --only numbers`\n", true, "its first line must be"),
        (FIRST, false, "not current: numbers.tex\n"),
    ] {
        let output = covered(&bench, first, 45, is_current);
        let text = format!("numbers.tex:1: whether its values are stale is unknown; {why}");
        assert!(output.code == Some(3) && output.out.starts_with(&text), "{}", output.out);
        assert_eq!(output.out.lines().count(), 1);
    }
    let mut gone = bench.command(&["--coverage", "paper.tex", "--macros", "numbers.tex"]);
    let output = answer(&gone.env("REPLAN", Path::new("no/such/replan")).output().unwrap());
    assert!(
        output.out.contains("`no/such/replan`, which checks them, cannot be run: No such"),
        "{}",
        output.out
    );
}

/// `bytes` with one to three places flipped, cut out, repeated, overwritten, or cut off.
fn damaged(bytes: &[u8], rng: &mut SmallRng) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..rng.random_range(1..=3) {
        let at = rng.random_range(0..=bytes.len());
        let to = bytes.len().min(at + rng.random_range(1..30));
        match rng.random_range(0..6) {
            0 if at < bytes.len() => bytes[at] ^= 1 << rng.random_range(0..8),
            1 => drop(bytes.drain(at..to)),
            2 => drop(bytes.splice(at..at, bytes[at..to].to_vec())),
            3 => bytes.insert(at, rng.random()),
            4 => bytes[at..to].reverse(),
            _ => bytes.truncate(at.max(40)),
        }
    }
    bytes
}

#[test]
fn damaged_files_end_with_findings_or_a_refusal_that_says_where() {
    const TOML: &str = "rounding = \"nearest\"\n\n[cells]\na = \"12.50\"\n\n[[table]]\nname = \"t\"\ntext = \"\"\"\n\
        | p | x [% of 20] |\n|-|-|\n| A | 33.3 |\n\"\"\"\n\n[[sample]]\nname = \"s\"\nis = \"integers, n=10\"\nmean = \"2.35\"\n\
        sd = \"1.1\"\n\n[[relation]]\ncheck = \"ratio\"\nvalue = \"2.50\"\nof = \"a\"\nover = \"t/A/x\"\n";
    const CSV: &str = "planner,\"nodes, all [mean, integers, n=10]\",time (s),n\nA,3.45,1.2 ± 0.1,10\nB,2.0,\"1.3\",8\nAverage,2.7,1.25,9\n";
    let bench = Bench::new();
    let mut codes = [0; 4];
    for seed in 0..500 {
        let mut rng = SmallRng::seed_from_u64(seed);
        let (name, whole) = [("t.md", TABLE), ("t.csv", CSV), ("t.toml", TOML)][seed as usize % 3];
        let bytes = damaged(whole.as_bytes(), &mut rng);
        bench.write(name, &bytes);
        let output = bench.run(&[name]);
        let code = output.code.filter(|code| [0, 2, 3].contains(code));
        let code = code.unwrap_or_else(|| panic!("seed {seed}: {:?}\n{}", output.code, output.err)) as usize;
        codes[code] += 1;
        let rest = output.err.strip_prefix(&format!("replan: {name}:")).unwrap_or_default();
        // What is no text has no columns: the common door for text says line and byte in words.
        let is_no_text = rest.starts_with(" line ") && rest.contains(" of the file is not UTF-8");
        let is_located = code != 2 || is_no_text || rest.starts_with(|c: char| c.is_ascii_digit());
        assert!(is_located, "seed {seed}: {}\n{:?}", output.err, String::from_utf8_lossy(&bytes));
    }
    assert!(codes[0] > 20 && codes[2] > 100 && codes[3] > 50, "one-sided sample: {codes:?}");
}
