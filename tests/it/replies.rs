//! Replies to verdicts, and versions by which verdicts are cited.

use crate::paper::Bench;
use std::fs;

const REPLY: &str = "\n[[reply]]\nwho = \"N. N., first <author>\"\ndate = \"2026-01-31\"\n\
                     text = \"\"\"Our map was *another* one;\nit is in the appendix.\"\"\"\nclaims = [\"cost\", \"nodes\"]\n";

/// The places that show a claim: `show`, the report's chapter and details, the page.
fn shown(bench: &Bench) -> [String; 4] {
    bench.done(&["repro", "./mini"]);
    bench.done(&["report", "./mini", "--to", "pages"]);
    let read = |file: &str| fs::read_to_string(bench.at(file)).unwrap();
    [
        bench.done(&["show", "./mini", "nodes"]),
        read("target/replan/mini/paper_repro.md"),
        read("target/replan/mini/plots/mini/details.md"),
        read("pages/mini.html"),
    ]
}

/// The version of the claim `nodes`.
fn version(bench: &Bench) -> String {
    let output = bench.done(&["show", "./mini", "nodes"]);
    let words = output.split_whitespace().collect::<Vec<_>>().join(" ");
    words
        .split(", version ")
        .nth(1)
        .unwrap_or_else(|| panic!("{output}"))
        .split(' ')
        .next()
        .unwrap()
        .to_owned()
}

#[test]
fn a_reply_stands_beside_the_verdicts_that_it_is_about_and_changes_none() {
    let bench = Bench::new();
    let before = shown(&bench);
    let cited = version(&bench);
    bench.edit("mini/paper.toml", "\n[[choice]]", &(REPLY.to_owned() + "\n[[choice]]"));
    let check = bench.run(&["judge", "./mini", "--check"]);
    assert!(check.code == Some(3) && check.err.contains("replies"), "{}", check.err);
    let after = shown(&bench);
    assert_eq!(version(&bench), cited);
    for (before, after, parts) in [
        (
            &before[0],
            &after[0],
            &["reply of N. N., first <author>, 2026-01-31: Our map was *another* one; it"][..],
        ),
        (
            &before[1],
            &after[1],
            &[
                "first &lt;author>, 2026-01-31, on [`cost`](plots/mini/details.md#cost) (",
                "\\*another* one; it is",
            ],
        ),
        (&before[2], &after[2], &["- reply of N. N., first &lt;author>, 2026-01-31: Our map was"]),
        (
            &before[3],
            &after[3],
            &["<div class=\"second\">reply of N. N., first &lt;author&gt;</div>", "appendix."],
        ),
    ] {
        let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in parts {
            assert!(words(after).contains(part), "{part}\nis not in\n{after}");
            assert!(!words(before).contains(part), "{part}");
        }
    }
}

#[test]
fn a_reply_that_names_no_claim_has_no_day_or_is_too_long_is_refused_at_its_place() {
    let bench = Bench::new();
    let paper = fs::read_to_string(bench.at("mini/paper.toml")).unwrap();
    let line = paper.lines().count() + 1;
    let long = "a".repeat(2001);
    for (from, to, message) in [
        (
            "\"cost\"",
            "\"costs\"",
            format!("paper.toml:{}:11: there is no claim `costs` (did you mean `cost`?)", line + 6),
        ),
        (
            "2026-01-31",
            "2026-02-30",
            format!("paper.toml:{}:8: `date` is \"2026-02-30\"; a day as 2026-01-31", line + 3),
        ),
        ("date = \"2026-01-31\"\n", "", format!("paper.toml:{}:1: missing key `date`", line + 1)),
        (
            "it is in the appendix.",
            &long,
            format!("paper.toml:{}:8: `text` has 2028 characters; 1 to 2000", line + 4),
        ),
        ("N. N., first <author>", "", format!("paper.toml:{}:7: `who` has 0 characters; 1 to 200", line + 2)),
        ("[\"cost\", \"nodes\"]", "[]", format!("paper.toml:{}:10: `claims` is an array of 0", line + 6)),
        ("who", "whom", format!("paper.toml:{}:1: unknown key `whom` (did you mean `who`?)", line + 2)),
    ] {
        assert!(REPLY.contains(from), "{from}");
        bench.write("mini/paper.toml", (paper.clone() + &REPLY.replacen(from, to, 1)).as_bytes());
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(output.code, Some(2), "{message}: {}", output.out);
        assert!(output.err.contains(&message), "{message}\nis not in\n{}", output.err);
    }
    bench.write("mini/paper.toml", (paper + REPLY).as_bytes());
    bench.done(&["check", "./mini"]);
}

#[test]
fn a_version_is_of_what_a_claim_means_and_of_its_records_and_not_of_words() {
    let bench = Bench::new();
    let [message, _, details, page] = shown(&bench);
    let first = version(&bench);
    assert_eq!(first.len(), 12, "{message}");
    assert!(
        details.contains(&format!("Version `{first}`")) && page.contains(&format!("version {first} (replan"))
    );
    bench.edit("mini/paper.toml", "two sides open fewer nodes", "fewer nodes are opened by two sides");
    bench.done(&["judge", "./mini"]);
    assert_eq!(version(&bench), first);
    bench.edit("mini/paper.toml", "is = \"lower\"", "is = \"higher\"");
    bench.done(&["judge", "./mini"]);
    let other = version(&bench);
    assert_ne!(other, first, "it means the opposite");
    bench.edit("mini/paper.toml", "is = \"higher\"", "is = \"lower\"");
    let stale = bench.done(&["show", "./mini", "nodes"]);
    assert!(stale.contains(&other), "{stale}");
    bench.done(&["judge", "./mini"]);
    assert_eq!(version(&bench), first);
    bench.edit("mini/draws.toml", "seed = 7", "seed = 8");
    bench.done(&["run", "./mini"]);
    let unjudged = bench.done(&["show", "./mini", "nodes"]);
    assert!(!unjudged.contains("version"), "records changed since it was judged: {unjudged}");
    bench.done(&["judge", "./mini"]);
    assert_ne!(version(&bench), first, "it rests on other records");
}
