//! What the page says of runs that cannot be shown, or are not the study's own; the index; `--open`.

use super::first_line;
use crate::paper::Bench;
use replan::analysis::verdict::Verdicts;
use std::fs;
use std::path::Path;

#[test]
fn text_of_a_paper_never_becomes_part_of_the_page() {
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "title = \"", "title = \"<script>document.title = 'taken'</script> ");
    bench.done(&["repro", "mini", "--quick", "--out", "quick"]);
    bench.done(&["report", "mini", "--out", "quick", "--to", "pages"]);
    let file = bench.at("pages/mini.html");
    let text = fs::read_to_string(&file).unwrap();
    assert!(!text.contains("<script>document.title") && text.contains("&lt;script&gt;document.title"));
    assert!(first_line(&file).starts_with("<p class=\"state\">Quick run"), "{}", first_line(&file));
}

#[test]
fn missing_stale_and_damaged_runs_are_reported_in_the_first_line() {
    let bench = Bench::new();
    let output = bench.run(&["report", "mini", "--to", "pages"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    let first = || first_line(&bench.at("pages/mini.html"));
    assert!(first().contains("Nothing is shown: ") && first().contains("no verdicts"), "{}", first());

    bench.done(&["repro", "mini", "--out", "run"]);
    let draws = fs::read_dir(bench.at("run/data/runs/mini")).unwrap().map(|entry| entry.unwrap().path());
    let trials = draws.into_iter().find(|path| path.to_string_lossy().ends_with(".trials.parquet")).unwrap();
    let bytes = fs::read(&trials).unwrap();
    fs::write(&trials, &bytes[..bytes.len() - 9]).unwrap();
    assert_ne!(bench.run(&["report", "mini", "--out", "run", "--to", "pages"]).code, Some(0));
    assert!(first().contains("Nothing is shown: ") && first().contains("trials.parquet"), "{}", first());

    fs::write(&trials, &bytes).unwrap();
    bench.done(&["report", "mini", "--out", "run", "--to", "pages"]);
    assert!(first().starts_with("<main>"), "{}", first());
    bench.edit("mini/paper.toml", "printed = [\"7.83\"]", "printed = [\"7.84\"]");
    bench.done(&["report", "mini", "--out", "run", "--to", "pages"]);
    assert!(first().starts_with("<p class=\"state\">Stale: "), "{}", first());
    bench.edit("mini/draws.toml", "instances = 24", "instances = 25");
    assert_ne!(bench.run(&["report", "mini", "--out", "run", "--to", "pages"]).code, Some(0));
    assert!(first().contains("Nothing is shown: ") && first().contains("draws"), "{}", first());
}

/// The paper `mini` with its run below `run`.
fn ran() -> Bench {
    let bench = Bench::new();
    bench.done(&["repro", "mini", "--out", "run"]);
    bench
}

const REPORT: [&str; 6] = ["report", "mini", "--out", "run", "--to", "pages"];
const VERDICTS: &str = "run/data/runs/mini/verdicts.toml";

#[test]
fn verdicts_that_were_edited_by_hand_are_reported_in_the_first_line() {
    let bench = ran();
    let first = || first_line(&bench.at("pages/mini.html"));
    let whole = fs::read_to_string(bench.at(VERDICTS)).unwrap();
    let (text, seal) = whole.trim_end().rsplit_once('\n').unwrap();
    assert!(seal.starts_with("# SHA-256 of the text above: "), "{seal}");
    let edited = whole.replacen("verdict = \"reproduced\"", "verdict = \"impossible\"", 1);
    let again = whole.replacen("because = [", "# by hand\nbecause = [", 1);
    for touched in
        [edited, again, format!("{text}\n"), format!("{whole}# more\n"), format!("# more\n{whole}")]
    {
        assert_ne!(touched, whole);
        bench.write(VERDICTS, touched.as_bytes());
        assert_eq!(bench.run(&REPORT).code, Some(2));
        assert!(first().starts_with("<p class=\"state\">Nothing is shown: "), "{}", first());
        assert!(first().contains("verdicts.toml: is not what replan wrote"), "{}", first());
        let shown = bench.run(&["show", "mini", "cost", "--out", "run"]);
        assert!(shown.code == Some(2) && shown.out.is_empty(), "{}", shown.out);
    }
    bench.done(&["judge", "mini", "--out", "run"]);
    bench.done(&REPORT);
    assert!(first().starts_with("<main>"), "{}", first());
}

#[test]
fn records_that_are_newer_than_the_verdicts_are_reported_in_the_first_line() {
    let bench = ran();
    let first = || first_line(&bench.at("pages/mini.html"));
    // The clock is read again, so that times differ though no trial does.
    bench.done(&["run", "mini", "--out", "run", "--fresh"]);
    bench.done(&REPORT);
    let expected =
        "<p class=\"state\">Stale: records of study `draws` are others than the claims were judged from";
    assert!(first().starts_with(expected), "{}", first());
    bench.done(&["judge", "mini", "--out", "run"]);
    bench.done(&REPORT);
    assert!(first().starts_with("<main>"), "{}", first());
}

#[test]
fn the_index_says_of_each_paper_what_its_first_line_says() {
    let bench = Bench::new();
    fs::create_dir(bench.at("experiments")).unwrap();
    fs::rename(bench.at("mini"), bench.at("experiments/mini")).unwrap();
    let index = || {
        bench.run(&["report", "--to", "pages"]);
        fs::read_to_string(bench.at("pages/index.html")).unwrap()
    };
    assert!(index().contains("<td>Nothing is shown: "), "{}", index());
    bench.edit(
        "experiments/mini/paper.toml",
        "authors = \"N. N.\"\n",
        "[report]\nfinding = \"Two sides open fewer.\"\n",
    );
    bench.done(&["repro", "mini"]);
    assert!(index().contains("<td>Two sides open fewer.</td><td>2 sentences and rows: "), "{}", index());
    bench.edit("experiments/mini/paper.toml", "printed = [\"7.83\"]", "printed = [\"7.84\"]");
    assert!(index().contains("<td></td><td>Stale: "), "{}", index());
    let page = fs::read_to_string(bench.at("pages/mini.html")).unwrap();
    assert!(page.contains("<a href=\"index.html\">All papers</a></nav>"));
}

#[test]
fn the_second_seeds_outcome_stands_beside_the_verdict() {
    let runs = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/runs");
    let mut seen = 0;
    let mut others = 0;
    for name in ["zhang", "fu2018"] {
        let text = fs::read_to_string(super::page(name)).unwrap();
        for judged in Verdicts::read(&runs.join(name)).unwrap().claims {
            let line = text.split(&format!("<tbody id=\"claim={}\"", judged.claim)).nth(1).unwrap();
            let line = line.split("<tr class=\"evidence\"").next().unwrap();
            let Some(second) = judged.second else {
                assert!(!line.contains("second seed"), "{}", judged.claim);
                continue;
            };
            let class = second.name().replace(' ', "-");
            let message = format!("second seed: <span class=\"class {class}\">{}</span>", second.name());
            assert!(line.contains(&message), "{}: {line}", judged.claim);
            (seen, others) = (seen + 1, others + usize::from(second != judged.outcome));
        }
    }
    assert!(seen > 20 && others > 0, "{seen} claims, {others} of another outcome");
}

#[cfg(unix)]
#[test]
fn the_page_is_opened_by_the_desktops_own_program() {
    use std::os::unix::fs::PermissionsExt as _;
    let bench = ran();
    bench.write("bin/xdg-open", b"#!/bin/sh\necho \"$1\" > opened\n");
    fs::set_permissions(bench.at("bin/xdg-open"), fs::Permissions::from_mode(0o755)).unwrap();
    let with = |path: String| {
        let mut command = bench.command(&REPORT);
        bench.output(&command.arg("--open").env("PATH", path).output().unwrap())
    };
    let path = std::env::var("PATH").unwrap();
    assert_eq!(with(format!("{}:{path}", bench.at("bin").display())).code, Some(0));
    let opened = || fs::read_to_string(bench.at("opened")).unwrap_or_default();
    for _ in 0..100 {
        if opened().is_empty() {
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
    }
    assert_eq!(opened(), "pages/mini.html\n");
    let none = with(String::new());
    assert!(none.code == Some(4) && none.err.contains("open pages/mini.html yourself"), "{}", none.err);
}
