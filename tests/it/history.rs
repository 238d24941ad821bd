//! The history of claims: what no command can hide, and what changes no meaning.

use crate::paper::Bench;
use replan::analysis::meaning::hash;
use std::collections::BTreeMap;
use std::fs;
use study::Inputs;
use study::paper::Paper;

const RUNS: &str = "target/replan/mini/data/runs/mini";
const HISTORY: &str = "target/replan/mini/data/runs/mini/history.toml";
const DETAILS: &str = "target/replan/mini/plots/mini/details.md";
const PAPER: &str = "mini/paper.toml";
const UNEXPLAINED: &str = "changed after its data were seen, without a reason given";

/// A claim with a margin, and one that names it.
const MARGIN: &str = r#"
[[claim]]
id = "length"
at = "section 2"
says = "half as many nodes"
printed = "0.5"
[claim.check.within]
select = { study = "draws", problems = "drawn", metric = "nodes", contender = "Two-sided", against = "A*" }
statistic = "ratio"
margin = 0.25

[[claim]]
id = "again"
at = "section 3"
printed = "0.5"
[claim.check.within]
select = { study = "draws", problems = "drawn", metric = "nodes", contender = "Two-sided", against = "A*" }
statistic = "ratio"
margin = 0.25
printed_ratio = ["length", "cost"]
"#;

fn text(bench: &Bench, name: &str) -> String {
    fs::read_to_string(bench.at(name)).unwrap()
}

/// The paper with the two claims of [`MARGIN`].
fn bench() -> Bench {
    let bench = Bench::new();
    let whole = text(&bench, PAPER).replace("[[table]]\n", &format!("{MARGIN}\n[[table]]\n"));
    bench.write(PAPER, whole.as_bytes());
    bench
}

/// What each claim means, by id.
fn hashes(bench: &Bench) -> BTreeMap<String, String> {
    let paper = Paper::load(&bench.at("mini"), &Inputs::below(vec![bench.at("mini")])).unwrap();
    paper.claims.iter().map(|claim| (claim.id.clone(), hash(&paper, claim))).collect()
}

/// The numbers of the claims of [`bench`] whose hash changes if `from` becomes `to` in the file of the paper.
fn changed_by(from: &str, to: &str) -> Vec<String> {
    let bench = bench();
    let before = hashes(&bench);
    bench.edit(PAPER, from, to);
    let after = hashes(&bench);
    after.into_iter().filter(|(id, hash)| before.get(id) != Some(hash)).map(|(id, _)| id).collect()
}

/// Every place that says how the claim `length` was changed must say it.
fn assert_reported(bench: &Bench, when: &str) {
    let entries = text(bench, HISTORY);
    let after = entries.split("[entry.after_data]\n").nth(1).unwrap_or_else(|| panic!("{when}: {entries}"));
    assert!(after.starts_with("length = ["), "{when}: {entries}");
    let shown = bench.done(&["show", "./mini", "length"]).replace("\n    ", " ");
    assert!(shown.contains(UNEXPLAINED) && shown.contains("entry 3: "), "{when}: {shown}");
    let details = text(bench, DETAILS).replace("\n  ", " ");
    assert!(details.contains(UNEXPLAINED) && details.contains("entry 3: "), "{when}: {details}");
    let report = text(bench, "target/replan/mini/paper_repro.md");
    assert!(
        report.contains("Changed after their data were seen, without a reason given: `length`"),
        "{when}"
    );
    bench.done(&["report", "./mini", "--to", "page"]);
    let page = text(bench, "page/mini.html");
    assert!(page.contains(UNEXPLAINED), "{when}: the page is silent");
    bench.done(&["judge", "./mini", "--check"]);
    bench.done(&["render", "./mini", "--check"]);
}

#[test]
fn a_margin_that_moves_after_the_run_is_reported_for_good() {
    let bench = bench();
    let mark = "Changed after their data were seen, without a reason given: `length`.";
    let first = bench.done(&["repro", "./mini"]);
    assert!(!first.contains("Changed after their data"), "{first}");
    assert!(text(&bench, DETAILS).contains("No claim was changed after its data had been seen.\n"));
    bench.edit(PAPER, "margin = 0.25", "margin = 3.0");
    let output = bench.done(&["repro", "./mini"]);
    assert!(output.contains(mark) && output.starts_with("2 studies: nothing to run, "), "{output}");
    assert_reported(&bench, "repro");
    assert!(bench.done(&["repro", "./mini", "--fresh"]).contains(mark));
    assert_reported(&bench, "--fresh");
    for study in ["draws", "room"] {
        fs::remove_file(bench.at(&format!("{RUNS}/{study}.manifest.toml"))).unwrap();
    }
    assert!(bench.done(&["repro", "./mini"]).contains(mark));
    assert_reported(&bench, "manifests removed");
    fs::remove_file(bench.at(&format!("{RUNS}/verdicts.toml"))).unwrap();
    bench.edit(PAPER, "margin = 3.0", "margin = 0.25");
    let output = bench.done(&["repro", "./mini"]);
    assert!(output.contains(mark), "taking a change back hides it: {output}");
    let reason = "changed_after_run = \"the margin was a slip\"\n[claim.check.within]";
    bench.edit(PAPER, "[claim.check.within]", reason);
    let output = bench.done(&["repro", "./mini"]);
    assert!(!output.contains("without a reason"), "{output}");
    let details = text(&bench, DETAILS).replace("\n  ", " ");
    assert!(details.contains("the margin was a slip (`history.toml`: entry 3: "), "{details}");
}

#[test]
fn a_change_is_reported_where_trials_are_recorded_and_recorded_again() {
    let bench = bench();
    let outside = "\n[[contender]]\nlabel = \"Outside\"\nplanner = \"external\"\nsettings = { command = [\"sh\", \"-c\", \"exit 0\"], \
                   files = [], version = \"1\", time_s = 5.0, memory_mb = 128, output_mb = 4, install = \"a shell\" }\n\n[[contender]]";
    bench.edit("mini/draws.toml", "\n[[contender]]", outside);
    bench.edit("mini/draws.toml", "instances = 24", "instances = 12");
    let first = bench.done(&["repro", "./mini", "--trust"]);
    assert!(!first.contains("Changed after"), "{first}");
    bench.edit(PAPER, "margin = 0.25", "margin = 3.0");
    for again in [&[][..], &["--fresh"], &["--record"], &["--fresh", "--record"]] {
        let output = bench.done(&[&["repro", "./mini"], again].concat());
        assert!(output.contains("Changed after their data were seen"), "{again:?}: {output}");
        assert!(!output.contains("run it again"), "{again:?}: {output}");
        assert_reported(&bench, &again.concat());
    }
}

#[test]
fn wording_order_names_and_what_holds_anyway_change_no_meaning() {
    let nothing: [String; 0] = [];
    for (from, to) in [
        ("says = \"half as many nodes\"", "says = \"one half\"\nunit = \"nodes\""),
        ("at = \"section 2\"", "at = \"section 9\" # it stands there"),
        ("statistic = \"ratio\"\nmargin = 0.25", "margin = 0.250\nstatistic = \"ratio\""),
        (", contender = \"Two-sided\"", ", all_ends = false, contender = [\"Two-sided\"]"),
        ("is = \"lower\"\n", "by_percent = 0\n"),
        ("at = \"section 2\"", "changed_after_run = \"a slip\"\nat = \"section 2\""),
    ] {
        assert_eq!(changed_by(from, to), nothing, "{from} as {to}");
    }
    let bench = bench();
    let before = hashes(&bench);
    let whole = text(&bench, PAPER).replace("\"length\"", "\"half\"");
    let (head, tail) = whole.split_once("[[table]]\nid = \"table1\"").unwrap();
    let (table, tail) = tail.split_once("[[claim]]\nid = \"nodes\"").unwrap();
    bench.write(
        PAPER,
        format!("{head}[[claim]]\nid = \"nodes\"{tail}\n[[table]]\nid = \"table1\"{table}").as_bytes(),
    );
    let mut after = hashes(&bench);
    let half = after.remove("half").unwrap();
    after.insert("length".to_owned(), half);
    assert_eq!(after, before, "a renamed claim, and one that moved");
}

#[test]
fn what_decides_a_claim_changes_its_meaning_and_that_of_claims_that_name_it() {
    for (from, to, claims) in [
        (
            "printed = \"0.5\"\n[claim.check.within]",
            "printed = \"0.50\"\n[claim.check.within]",
            &["again", "length"][..],
        ),
        ("margin = 0.25", "margin = 0.26", &["length"]),
        ("statistic = \"ratio\"", "statistic = \"reduction_percent\"", &["length"]),
        ("metric = \"nodes\", contender", "metric = \"expansions\", contender", &["length"]),
        (
            "contender = \"Two-sided\", against = \"A*\"",
            "contender = \"A*\", against = \"Two-sided\"",
            &["length"],
        ),
        ("margin = 0.25", "accepted = [0.25, 0.75]", &["length"]),
        ("is = \"lower\"", "is = \"higher\"", &["nodes"]),
        ("[\"7.83\"]", "[\"7.84\"]", &["again", "cost"]),
        ("[\"7.83\"]", "[\"7.83\"], cell.cost.digits = \"truncated\"", &["again", "cost"]),
        ("id = \"length\"", "holds_when = { corners = [\"allow\"] }\nid = \"length\"", &["length"]),
        ("[\"length\", \"cost\"]", "[\"cost\", \"length\"]", &["again"]),
    ] {
        assert_eq!(changed_by(from, to), claims, "{from} as {to}");
    }
}

#[test]
fn a_claim_that_is_renamed_keeps_its_history_and_one_that_is_new_or_gone_is_named() {
    let bench = bench();
    bench.done(&["repro", "./mini"]);
    let whole = text(&bench, PAPER);
    let named = |name: &str, margin: &str| {
        let margin = format!("margin = {margin}");
        whole.replace("\"length\"", &format!("\"{name}\"")).replacen("margin = 0.25", &margin, 1)
    };
    bench.write(PAPER, named("half", "0.25").as_bytes());
    let output = bench.done(&["repro", "./mini"]);
    assert!(!output.contains("after their data"), "{output}");
    bench.write(PAPER, named("half", "2.5").as_bytes());
    bench.done(&["repro", "./mini"]);
    bench.write(PAPER, named("ratio", "2.5").as_bytes());
    let output = bench.done(&["repro", "./mini"]);
    assert!(output.contains("without a reason given: `ratio`."), "a new name hides a change: {output}");
    // A new name with a new margin is one claim less and one more.
    bench.write(PAPER, named("other", "1.5").as_bytes());
    let output = bench.done(&["repro", "./mini"]);
    assert!(output.contains("without a reason given: `other`."), "{output}");
    assert!(output.contains("Withdrawn after their data were seen: `ratio` (entry "), "{output}");
    let reason = "\n[[withdrawn]]\nclaims = [\"ratio\"]\nwhy = \"`other` asks the same\"\n";
    bench.write(PAPER, (named("other", "1.5") + reason).as_bytes());
    let output = bench.done(&["repro", "./mini"]);
    assert!(!output.contains("Withdrawn after"), "a reason is given: {output}");
    bench.edit(PAPER, "[\"ratio\"]", "[\"other\"]");
    let refused = bench.run(&["check", "./mini"]);
    assert!(
        refused.err.contains("claim `other` is withdrawn, and there is a claim of this name"),
        "{}",
        refused.err
    );
    bench.edit(PAPER, "[\"other\"]", "[\"ratio\"]");
    let shown = bench.done(&["show", "./mini", "other"]);
    assert!(shown.contains("written then, "), "{shown}");
}

#[test]
fn claims_may_change_before_their_data_are_there() {
    let bench = bench();
    bench.done(&["run", "./mini", "--quick"]);
    bench.edit(PAPER, "margin = 0.25", "margin = 3.0");
    let output = bench.done(&["repro", "./mini"]);
    assert!(!output.contains("after their data"), "a quick run is not the study's: {output}");
    bench.edit(PAPER, "[\"7.83\"]", "[\"7.84\"]");
    let quick = bench.done(&["repro", "./mini", "--quick"]);
    let both = "without a reason given: `cost`, `length`, `again`.";
    assert!(quick.contains(both), "the quick run has a history of its own: {quick}");
    assert!(bench.done(&["repro", "./mini"]).contains("without a reason given: `cost`, `again`."));
}

#[test]
fn entries_are_added_and_the_others_stay_as_they_are() {
    let bench = bench();
    let mut before = String::new();
    let mut grows = |change: &dyn Fn(), command: &[&str], more: usize| {
        change();
        bench.done(command);
        let after = text(&bench, HISTORY);
        assert!(after.starts_with(&before), "{command:?} changed an entry:\n{before}\nbecame\n{after}");
        let count = |text: &str| text.matches("[[entry]]").count();
        assert_eq!(count(&after), count(&before) + more, "{command:?}: {after}");
        before = after;
    };
    grows(&|| (), &["run", "./mini"], 2);
    grows(&|| (), &["run", "./mini"], 0);
    grows(&|| (), &["judge", "./mini"], 0);
    grows(&|| (), &["repro", "./mini"], 0);
    grows(&|| (), &["run", "./mini", "--clock"], 1);
    grows(&|| bench.edit(PAPER, "margin = 0.25", "margin = 0.5"), &["judge", "./mini"], 1);
    grows(&|| bench.edit("mini/draws.toml", "instances = 24", "instances = 25"), &["repro", "./mini"], 1);
    let last = before.rsplit("[[entry]]").next().unwrap();
    assert!(
        !last.contains("nodes") && last.contains("draws = "),
        "an entry repeats what has not changed: {last}"
    );
}

#[test]
fn an_edited_history_is_damage() {
    let bench = bench();
    bench.done(&["repro", "./mini"]);
    bench.edit(PAPER, "margin = 0.25", "margin = 3.0");
    bench.done(&["repro", "./mini"]);
    let whole = text(&bench, HISTORY);
    let ends: Vec<usize> = whole.match_indices("\n[[entry]]").map(|(at, _)| at).collect();
    let forged = whole.replacen("number = 1", "number = 1 ", 1);
    for (what, edited, complaint) in [
        ("an entry was edited", forged, "an entry was edited or cut off"),
        (
            "the last entry is gone",
            whole[..ends[2]].to_owned(),
            "entries are gone on which the stored verdicts rest",
        ),
        (
            "a line is missing at the end",
            whole[..whole.len() - 70].to_owned(),
            "an entry was edited or cut off",
        ),
        ("an entry was written by hand", format!("{whole}\n[[entry]]\n"), "an entry was edited or cut off"),
        (
            "an entry was taken out",
            whole[..ends[1]].to_owned() + &whole[ends[2]..],
            "an entry was edited or cut off",
        ),
        ("nothing is left", String::new(), "an entry was edited or cut off"),
    ] {
        bench.write(HISTORY, edited.as_bytes());
        for (command, code) in [
            (&["judge", "./mini", "--check"][..], 3),
            (&["render", "./mini", "--check"], 3),
            (&["check", "./mini"], 3),
            (&["judge", "./mini"], 2),
            (&["repro", "./mini", "--fresh"], 2),
            (&["run", "./mini"], 2),
            (&["show", "./mini"], 2),
        ] {
            let output = bench.run(command);
            assert_eq!(output.code, Some(code), "{what}: {command:?}: {}{}", output.out, output.err);
            assert!(output.err.contains(&format!("history.toml: {complaint}; ")), "{what}: {}", output.err);
        }
        assert_eq!(text(&bench, HISTORY), edited, "{what}: a refused history was written to");
    }
    bench.write(HISTORY, whole.as_bytes());
    bench.done(&["judge", "./mini", "--check"]);
}

#[test]
fn without_its_history_a_stored_run_says_so() {
    let bench = bench();
    bench.done(&["repro", "./mini"]);
    fs::remove_file(bench.at(HISTORY)).unwrap();
    let output = bench.done(&["check", "./mini"]);
    assert!(output.contains("history.toml: there is no history of claims for the stored runs"), "{output}");
    assert_eq!(bench.run(&["judge", "./mini", "--check"]).code, Some(3));
    bench.done(&["render", "./mini"]);
    let report = text(&bench, "target/replan/mini/paper_repro.md");
    assert!(report.contains("No history of claims lies beside this run"), "{report}");
    assert!(!text(&bench, DETAILS).contains("No claim was changed"));
    bench.edit(PAPER, "id = \"length\"", "changed_after_run = \"a slip\"\nid = \"length\"");
    bench.done(&["repro", "./mini"]);
    let report = text(&bench, "target/replan/mini/paper_repro.md").replace('\n', " ");
    assert!(report.contains("An earlier history of claims was removed."), "{report}");
    assert!(report.contains("begins with runs that were stored already"), "{report}");
    let details = text(&bench, DETAILS).replace('\n', " ");
    assert!(details.contains("[`length`](#length): a slip."), "{details}");
    bench.edit(PAPER, "changed_after_run = \"a slip\"\n", "");
    let shown = bench.done(&["repro", "./mini"]);
    assert!(
        shown.contains("Changed after their data were seen, without a reason given: `length`."),
        "{shown}"
    );
}

#[test]
fn a_change_between_shards_and_their_merging_is_reported() {
    let bench = bench();
    bench.done(&["run", "./mini", "--shard", "1/1", "--out", "parts"]);
    bench.edit(PAPER, "margin = 0.25", "margin = 3.0");
    bench.done(&["merge", "parts", "--out", "whole"]);
    let output = bench.done(&["judge", "./mini", "--out", "whole"]);
    assert!(
        output.contains("Changed after their data were seen, without a reason given: `length`."),
        "{output}"
    );
    let entries = text(&bench, "whole/data/runs/mini/history.toml");
    bench.done(&["merge", "parts", "--out", "whole"]);
    assert_eq!(
        text(&bench, "whole/data/runs/mini/history.toml"),
        entries,
        "older parts bring older claims back"
    );
}

#[test]
fn a_new_form_of_hashes_is_an_entry_and_no_change_of_claims() {
    let bench = bench();
    bench.done(&["repro", "./mini"]);
    let seal = "# SHA-256 of the text above: ";
    let mut older = String::new();
    for entry in text(&bench, HISTORY).split_inclusive(seal).filter(|entry| entry.contains("[[entry]]")) {
        let entry = entry.trim_start_matches(|c: char| c.is_ascii_hexdigit()).trim_end_matches(seal);
        older += &entry.replace("form = 1", "form = 0").replace("length = [\"", "length = [\"0");
        older += &format!("{seal}{}\n", base::hash::sha256(older.as_bytes()));
    }
    bench.write(HISTORY, older.as_bytes());
    fs::remove_file(bench.at(&format!("{RUNS}/verdicts.toml"))).unwrap();
    let output = bench.done(&["repro", "./mini"]);
    assert!(!output.contains("after their data"), "{output}");
    assert!(text(&bench, HISTORY).starts_with(&older));
    assert!(text(&bench, HISTORY).contains("form = 1"), "{}", text(&bench, HISTORY));
    let report = text(&bench, "target/replan/mini/paper_repro.md").replace('\n', " ");
    assert!(
        report.contains("From entry 3 of `history.toml` on, claims are hashed in another form"),
        "{report}"
    );
}

#[test]
fn a_killed_command_leaves_the_history_whole() {
    let bench = bench();
    bench.done(&["run", "./mini"]);
    // Names alone: a file that is listed may be gone before it is read.
    let half_written = || {
        let names = fs::read_dir(bench.at(RUNS)).unwrap().map(|entry| entry.unwrap().file_name());
        names.into_iter().any(|name| name.to_string_lossy().starts_with("history.toml."))
    };
    for round in 0..8 {
        bench.edit(PAPER, "margin = 0.", &format!("margin = 0.{round}"));
        let before = text(&bench, HISTORY);
        let mut run = bench.command(&["judge", "./mini"]).spawn().unwrap();
        while run.try_wait().unwrap().is_none() && !half_written() && text(&bench, HISTORY) == before {}
        run.kill().unwrap();
        run.wait().unwrap();
        assert!(text(&bench, HISTORY).starts_with(&before), "round {round}: an entry was lost");
        bench.done(&["check", "./mini"]);
    }
    bench.write(&format!("{HISTORY}.1.tmp"), b"[[ent");
    bench.edit(PAPER, "margin = 0.", "margin = 1.");
    bench.done(&["judge", "./mini"]);
    assert!(!half_written(), "what a killed command left is still there");
}
