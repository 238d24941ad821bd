//! The report as people read it: links that lead somewhere, pages of bounded length, chapters that say what is wrong with them.

use crate::paper::{Bench, committed};
use replan::analysis::verdict::Verdicts;
use replan::render::prose::prose;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use study::Inputs;
use study::paper::Paper;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn loaded(name: &str) -> Paper {
    let folder = root().join("experiments").join(name);
    Paper::load(&folder, &Inputs::below(vec![folder.clone(), root().to_owned()])).unwrap()
}

/// Where the links and images of a page lead.
fn targets(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split_once(')').map(|(target, _)| target))
}

fn anchors(text: &str) -> BTreeSet<&str> {
    text.split("<a id=\"").skip(1).filter_map(|rest| rest.split_once('"').map(|(name, _)| name)).collect()
}

/// Links of `page` that lead nowhere, and how many it has.
fn broken(page: &Path) -> (Vec<String>, usize) {
    let text = read(page);
    let mut lost = Vec::new();
    let mut count = 0;
    for target in targets(&text) {
        count += 1;
        let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
        let file = if file.is_empty() { page.to_owned() } else { page.parent().unwrap().join(file) };
        let is_there = file.is_file() && (anchor.is_empty() || anchors(&read(&file)).contains(anchor));
        if !is_there {
            lost.push(format!("{}: {target}", page.display()));
        }
    }
    (lost, count)
}

fn pages() -> Vec<PathBuf> {
    let papers = committed();
    let details = papers.iter().map(|paper| root().join(format!("plots/{paper}/details.md")));
    let judged = papers.iter().map(|paper| root().join(format!("plots/{paper}/crosscheck.md")));
    let pages = std::iter::once(root().join("paper_repro.md")).chain(details);
    pages.chain(judged.filter(|page| page.is_file())).collect()
}

#[test]
fn every_link_or_image_of_the_report_and_its_details_leads_somewhere() {
    let found: Vec<_> = pages().iter().map(|page| broken(page)).collect();
    let count: usize = found.iter().map(|(_, count)| count).sum();
    let lost: Vec<String> = found.into_iter().flat_map(|(lost, _)| lost).collect();
    assert!(lost.is_empty(), "{} of {count}: {lost:#?}", lost.len());
    assert!(count > 1000, "only {count} links");
}

#[test]
fn anchors_of_a_page_are_each_there_once() {
    for page in pages() {
        let text = read(&page);
        let count = text.matches("<a id=\"").count();
        assert_eq!(anchors(&text).len(), count, "{}", page.display());
    }
}

#[test]
fn the_report_is_short_and_no_line_of_the_details_is_long() {
    let report = read(&root().join("paper_repro.md"));
    assert!(report.len() < 100_000, "{} bytes", report.len());
    for page in pages().iter().filter(|page| page.ends_with("details.md")) {
        for (line, at) in read(page).lines().zip(1..) {
            let length = line.chars().count();
            assert!(length <= 400, "{}:{at}: {length} characters", page.display());
        }
    }
    for chapter in report.split("<!-- replan begin ").skip(2) {
        let name = chapter.split(' ').next().unwrap();
        let lines = |begin: &str| chapter.lines().filter(|line| line.starts_with(begin)).count();
        assert!(lines("![") <= 6 && lines("| [") <= 8 && lines("| [") > 0, "{name}");
    }
}

#[test]
fn whether_a_cost_below_the_straight_line_is_possible_is_answered_within_three_clicks() {
    let report = read(&root().join("paper_repro.md"));
    // First click: what was found in the paper. Second: the printed number's verdict.
    let found = report.split("### [zhang](#zhang)").nth(1).unwrap().split("###").next().unwrap();
    assert!(found.contains("Two printed costs cannot be true"), "{found}");
    let chapter = report.split("<a id=\"zhang\"></a>").nth(1).unwrap();
    let target = "plots/zhang/details.md#t1.improved.cost";
    assert!(
        chapter.split_whitespace().collect::<Vec<_>>().join(" ").contains(&format!(
            "13.40 is shorter than the straight line between its ends, 13.60 ([`t1.improved.cost`]({target}))"
        )),
        "{chapter}"
    );
    let evidence = read(&root().join("plots/zhang/details.md"));
    let evidence = evidence.split("<a id=\"t1.improved.cost\"></a>").nth(1).unwrap();
    let evidence = evidence.split("<a id=").next().unwrap();
    for part in ["impossible", "straight_line", "13.6015"] {
        assert!(evidence.contains(part), "{part}: {evidence}");
    }
}

#[test]
fn every_number_that_the_findings_ask_for_is_there() {
    for name in committed() {
        let paper = loaded(&name);
        let folder = root().join("data/runs").join(&name);
        let verdicts = Verdicts::read(&folder).unwrap();
        for text in paper.report.findings.iter().chain(&paper.report.finding) {
            assert!(!prose(text, &verdicts).contains('–'), "{name}: {text}");
        }
    }
}

#[test]
fn every_figure_of_the_papers_has_a_file_of_ours_or_the_reason_why_not() {
    for name in committed() {
        let paper = loaded(&name);
        let plots = root().join("plots").join(&name);
        for row in paper.inventory.iter().filter(|row| row.item.get_ref().starts_with("Fig. ")) {
            assert!(!row.figures.is_empty() || row.none.is_some(), "{name}: {}", row.item.get_ref());
            for id in &row.figures {
                let id = id.get_ref();
                let is_there = |ending: &str| plots.join(format!("{id}.{ending}")).is_file();
                assert!(is_there("tex") || is_there("png") && is_there("svg"), "{name}: {id}");
            }
        }
    }
}

#[test]
fn no_figure_computes_itself_what_one_contender_saves() {
    let mut files = crate::source::files();
    files.retain(|file| file.modules().starts_with(&["render".to_owned(), "figure".to_owned()]));
    assert!(files.len() > 12, "{} files of figures", files.len());
    for file in files {
        let saving = "100.0 * (1.0 -";
        assert!(!file.code.contains(saving), "{}: a saving is analysis::selection's", file.path.display());
    }
}

#[test]
fn no_committed_svg_is_too_large_to_open() {
    let mut count = 0;
    for name in committed() {
        for entry in fs::read_dir(root().join("plots").join(name)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "svg") {
                let size = fs::metadata(&path).unwrap().len();
                assert!(size <= 300_000, "{}: {size} bytes", path.display());
                count += 1;
            }
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn a_inventory_that_misses_a_number_or_names_what_does_not_exist_is_refused() {
    let numbers = "claims = [\"nodes\"]\nnumbers = [{ claims = [\"cost\"] }]";
    let with = |numbers: &str, count: u32| {
        let bench = Bench::new();
        bench.edit("mini/paper.toml", "equations = 0", &format!("equations = 0\nnumbers = {count}"));
        let row = format!("says = \"cost and nodes\"\n{numbers}");
        bench.edit("mini/paper.toml", "says = \"cost and nodes\"", &row);
        bench.run(&["check", "./mini"])
    };
    assert_eq!(with(numbers, 1).code, Some(0), "{}", with(numbers, 1).err);
    for (numbers, count, expected) in [
        (numbers.to_owned(), 2, "9:11: the inventory lists 1 printed numbers; `numbers` says 2".to_owned()),
        (
            numbers.replace("{ claims", "{ printed = [\"7.83\"], claims"),
            1,
            "claim `cost` prints 7.83 itself; without `printed` it is accepted".to_owned(),
        ),
        (
            numbers.replace("[\"cost\"]", "[\"cost\", \"nodes\"]"),
            1,
            "claim `nodes` prints no number; `printed` is needed".to_owned(),
        ),
        (
            numbers.replace("{ claims = [\"cost\"] }", "{ table = \"table1\" }"),
            2,
            "the inventory lists 1 printed".to_owned(),
        ),
        (
            numbers.replace("{ claims = [\"cost\"] }", "{ table = \"table2\" }"),
            1,
            "there is no table of the paper `table2`".to_owned(),
        ),
        (
            "numbers = [{ printed = [\"9\"], none = \"a setting\" }]".to_owned(),
            1,
            "no row of the inventory lists the number 7.83 for claim `cost`".to_owned(),
        ),
        (
            numbers.replace("claims = [\"cost\"] }", "claims = [\"costs\"] }"),
            1,
            "there is no claim `costs` (did you mean `cost`?)".to_owned(),
        ),
        (
            numbers.replace("{ claims = [\"cost\"] }", "{ printed = [\"7.83\"] }"),
            1,
            "or `printed` with one claim that answers them or with `none`, the reason why none does"
                .to_owned(),
        ),
    ] {
        let answer = with(&numbers, count);
        assert!(answer.code == Some(2) && answer.err.contains(&expected), "{expected}\n{}", answer.err);
    }
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "figures = [\"fig1\"]", "studies = [\"room\"]");
    let expected = "Fig. 1 of the paper needs `figures`, ours beside it, or `none`";
    assert!(bench.run(&["check", "./mini"]).err.contains(expected));
}

#[test]
fn a_chapter_that_asks_for_what_is_not_there_is_refused_with_its_place() {
    for (report, expected) in [
        (
            "finding = \"it costs {costs}\"",
            "the text speaks of `{costs}`; there is no such claim (did you mean `cost`?)",
        ),
        (
            "findings = [\"{cost:high} and {cost:low}\", \"{cost:mean}\"]",
            "the text asks for `{cost:mean}`; the forms are tenths",
        ),
        ("figures = [\"fig2\"]", "there is no figure `fig2`"),
        ("figures = [\"fig1\", \"fig1\", \"fig1\", \"fig1\", \"fig1\", \"fig1\", \"fig1\"]", "6"),
        ("tables = [\"tabel\"]", "there is no table of results `tabel`"),
    ] {
        let bench = Bench::new();
        bench.edit("mini/paper.toml", "[prints]", &format!("[report]\n{report}\n\n[prints]"));
        let answer = bench.run(&["check", "./mini"]);
        assert!(answer.code == Some(2) && answer.err.contains(expected), "{report}: {}", answer.err);
        assert!(answer.err.contains("mini/paper.toml:6:"), "{report}: {}", answer.err);
    }
}

const REPORT: &str = "target/replan/mini/paper_repro.md";

/// The first line of text in the chapter, behind its heading.
fn first_line(bench: &Bench) -> String {
    let text = read(&bench.at(REPORT));
    let chapter = text.split("<!-- replan begin mini -->").nth(1).unwrap();
    chapter.lines().filter(|line| !line.is_empty()).nth(1).unwrap().to_owned()
}

#[test]
fn chapters_of_missing_quick_stale_and_damaged_runs_say_so_in_their_first_line() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    assert_eq!(first_line(&bench), "A tiny paper. N. N.");
    let runs = "target/replan/mini/data/runs/mini";
    let trials = format!("{runs}/draws.trials.parquet");
    let whole = fs::read(bench.at(&trials)).unwrap();
    bench.write(&trials, &whole[..whole.len() / 2]);
    assert_eq!(bench.run(&["render", "./mini"]).code, Some(2));
    assert!(
        first_line(&bench).starts_with("**Nothing is shown: ") && first_line(&bench).contains("draws.trials")
    );
    bench.write(&trials, &whole);
    bench.done(&["render", "./mini"]);
    fs::rename(bench.at(&format!("{runs}/draws.manifest.toml")), bench.at("aside")).unwrap();
    assert_eq!(bench.run(&["render", "./mini"]).code, Some(2));
    assert!(first_line(&bench).starts_with("**Nothing is shown: ") && first_line(&bench).contains("draws"));
    fs::rename(bench.at("aside"), bench.at(&format!("{runs}/draws.manifest.toml"))).unwrap();
    bench.edit("mini/paper.toml", "printed = [\"7.83\"]", "printed = [\"7.84\"]");
    bench.done(&["render", "./mini"]);
    assert!(
        first_line(&bench)
            .starts_with("**Stale: the stored verdicts are on other claims than paper.toml has now")
    );
    bench.done(&["judge", "./mini"]);
    bench.done(&["render", "./mini"]);
    let changed = "**Changed after their data were seen, without a reason given: `cost`.";
    assert!(first_line(&bench).starts_with(changed), "{}", first_line(&bench));
    bench.done(&["repro", "./mini", "--quick", "--out", "quick"]);
    let quick = read(&bench.at("quick/paper_repro.md"));
    assert!(quick.contains("<a id=\"mini\"></a>\n\n**Quick run: "), "{quick}");
}

#[test]
fn marks_of_markdown_html_and_mathematics_in_a_title_stay_text() {
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "A tiny paper", "A | B <script>alert(1)</script> for $5 & [x](y)");
    bench.edit("mini/paper.toml", "two sides open", "two | sides <b>open</b> $n$");
    bench.done(&["repro", "./mini"]);
    for page in [REPORT, "target/replan/mini/plots/mini/details.md"] {
        let text = read(&bench.at(page));
        assert!(!text.contains("<script") && !text.contains("<b>") && !text.contains(" $n$"), "{text}");
        let rows = text.lines().filter(|line| line.starts_with("| ") && line.contains("two \\| sides"));
        for row in rows {
            assert_eq!(row.replace("\\|", "").matches('|').count(), 5, "{row}");
        }
    }
    let text = read(&bench.at(REPORT));
    assert!(text.contains("A \\| B &lt;script>alert(1)&lt;/script> for \\$5 & [x\\](y). N. N."), "{text}");
}

#[test]
fn one_claim_is_shown_with_its_evidence_within_100_columns() {
    let bench = Bench::new();
    bench.done(&["repro", "./mini"]);
    let output = bench.done(&["show", "./mini", "nodes"]);
    assert!(output.starts_with("nodes: reproduced\n") && output.contains("trial: draws/"), "{output}");
    assert_eq!(bench.done(&["show", "./mini", "node"]), output);
    for (arguments, least) in [(&["show", "zhang"][..], 120), (&["show", "zhang", "t1.improved.cost"], 10)] {
        let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_replan"));
        let out = program.args(arguments).current_dir(root()).output().unwrap().stdout;
        let text = String::from_utf8(out).unwrap();
        assert!(text.lines().count() >= least, "{text}");
        let long: Vec<&str> = text.lines().filter(|line| line.chars().count() > 100).collect();
        assert!(long.is_empty(), "{long:#?}");
    }
}

#[test]
fn repro_ends_with_the_finding_and_its_headline_claims_within_a_screen() {
    let bench = Bench::new();
    bench.edit("mini/paper.toml", "at = \"section 1\"\n", "at = \"section 1\"\nheadline = true\n");
    bench.done(&["repro", "./mini"]);
    let output = bench.done(&["repro", "./mini"]);
    let lines: Vec<&str> = output.lines().collect();
    assert!(lines.len() <= 40 && lines.iter().all(|line| line.chars().count() <= 100), "{output}");
    let is_claim =
        |line: &str, id: &str| line.trim_start_matches([' ', '(']).split([' ', ':', ')']).next() == Some(id);
    let claims = |text: &str| ["nodes", "cost"].map(|id| text.lines().any(|line| is_claim(line, id)));
    assert_eq!(claims(&output), [true, false], "{output}");
    assert_eq!(claims(&bench.done(&["repro", "./mini", "--all"])), [true, true]);
    assert!(lines.iter().any(|line| line.starts_with("why: replan show ./mini NAME; ")), "{output}");
    let verdict = bench.done(&["show", "./mini", "nodes"]);
    let at = lines.iter().position(|line| is_claim(line, "nodes")).unwrap();
    let word = lines[at - 1].split("  ").next().unwrap();
    assert!(lines[at - 1].ends_with("maps)."), "{output}");
    assert!(!word.is_empty() && verdict.contains(word), "{word}: {verdict}");
}
