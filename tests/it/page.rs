//! The page that `replan report` writes: what it says of runs that cannot be shown, and how it behaves in a browser.

mod cell;
mod curves;
mod driver;
mod interpretations;
mod look;
mod states;

use crate::paper::{Bench, committed};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use driver::Browser;
use flate2::read::GzDecoder;
use replan::analysis::verdict::Verdicts;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use study::Inputs;
use study::paper::Paper;

/// A page may take so many bytes.
const PAGE_BYTES: usize = 4_000_000;

/// The committed paper `name` as a page, which is made once for all tests.
fn page(name: &str) -> PathBuf {
    static MADE: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let to = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pages");
    let mut made = MADE.lock().unwrap();
    if !made.contains(name) {
        let mut report = Command::new(env!("CARGO_BIN_EXE_replan"));
        report.current_dir(env!("CARGO_MANIFEST_DIR")).args(["report", name, "--to"]).arg(&to);
        let output = report.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        made.insert(name.to_owned());
    }
    to.join(format!("{name}.html"))
}

/// What a page's script unpacks: everything of one kind.
fn packed(page: &Path, kind: &str) -> Vec<Value> {
    let text = fs::read_to_string(page).unwrap();
    let begin = format!("data-kind=\"{kind}\"");
    let each = text.split(&begin).skip(1).map(|rest| {
        let base64 = rest.split_once('>').unwrap().1.split_once('<').unwrap().0;
        let gzip = STANDARD.decode(base64).unwrap();
        serde_json::from_reader(GzDecoder::new(&gzip[..])).unwrap()
    });
    each.collect()
}

/// The first line of the page's body.
fn first_line(page: &Path) -> String {
    let text = fs::read_to_string(page).unwrap();
    text.split("<body>\n").nth(1).unwrap().lines().next().unwrap().to_owned()
}

#[test]
fn every_committed_paper_fits_into_four_megabytes_and_asks_nothing_of_the_network() {
    for name in committed() {
        let text = fs::read_to_string(page(&name)).unwrap();
        assert!(text.len() < PAGE_BYTES, "{name}: {} bytes", text.len());
        let (body, _) = text.split_once("<script>").unwrap();
        for outside in ["src=\"http", "href=\"http", "url(http", "@import"] {
            assert!(!body.contains(outside), "{name}: {outside}");
        }
    }
}

#[test]
fn a_page_begins_with_the_finding_the_headline_claims_and_the_counts() {
    let text = fs::read_to_string(page("zhang")).unwrap();
    let (head, _) = text.split_once("<nav").unwrap();
    let verdicts = Verdicts::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("data/runs/zhang")).unwrap();
    let inputs = Inputs::below(vec![PathBuf::from(env!("CARGO_MANIFEST_DIR"))]);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/zhang");
    let paper = Paper::load(&folder, &inputs).unwrap();
    assert!(head.contains(&format!("<strong>{}", &paper.report.finding.as_ref().unwrap()[..20])), "{head}");
    let headlines: Vec<_> = paper.claims.iter().filter(|claim| claim.headline).collect();
    assert_eq!(headlines.len(), 8);
    for claim in headlines {
        let verdict = verdicts.claim(&claim.id).unwrap().verdict_text();
        let line = head.lines().find(|line| line.contains(&format!("href=\"#claim={}\"", claim.id))).unwrap();
        assert!(line.contains(&format!(">{verdict}</span>")), "{line}");
    }
    let counted = verdicts.claims.iter().filter(|judged| judged.is_counted()).count();
    let tally =
        head.lines().find(|line| line.contains(&format!("<p>{counted} sentences and rows: "))).unwrap();
    let number = |badge: &str| badge.split_once('>').unwrap().1.split(' ').next().unwrap().parse::<usize>();
    let badges = tally.split("<span class=\"class").skip(1);
    assert_eq!(badges.map(|badge| number(badge).unwrap()).sum::<usize>(), counted, "{tally}");
}

const SHOWN: &str =
    "return [...document.getElementById('claimed').tBodies].filter((line) => !line.hidden).length";

#[test]
fn claims_filter_sort_and_open_in_a_browser() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("zhang");
    browser.go(&file, "claims");
    let all = browser.run(SHOWN).as_u64().unwrap();
    browser.picture("zhang-claims-1280");
    browser.run("const f = document.getElementById('filter'); f.elements.class.value = 'impossible'; f.dispatchEvent(new Event('input'))");
    let impossible = browser.run(SHOWN).as_u64().unwrap();
    assert!((1..all).contains(&impossible), "{impossible} of {all}");
    let ranks = || -> Vec<u64> {
        browser.run("document.querySelector('[data-sort=class]').click()");
        let read =
            "return [...document.getElementById('claimed').tBodies].map((line) => Number(line.dataset.rank))";
        serde_json::from_value(browser.run(read)).unwrap()
    };
    let (up, down) = (ranks(), ranks());
    assert!(up.is_sorted() && down.is_sorted_by(|a, b| a >= b) && up.first() != up.last(), "{up:?} {down:?}");
    browser.go(&file, "claim=t1.improved.cost");
    assert_eq!(
        browser.run(
            "return document.getElementById('claim=t1.improved.cost').querySelector('.evidence').hidden"
        ),
        json!(false)
    );
    browser.picture("zhang-claim-1280");
    assert_eq!(browser.console(), json!([]));
}

/// The drawn pixels of the replay, as the browser gives them.
const PIXELS: &str =
    "return [...document.querySelectorAll('.stage canvas')].map((canvas) => canvas.toDataURL()).join()";

/// Pictures of the replay of `trial` in `page` at these steps; no two are equal.
fn moves(browser: &Browser, page: &Path, trial: &str, steps: &[u32], name: &str) {
    let mut drawn: Vec<Value> = Vec::new();
    for step in steps {
        browser.go(page, &format!("replay={trial}&step={step}"));
        browser.wait(&format!("return document.querySelector('[name=step]').value === '{step}'"));
        let pixels = browser.run(PIXELS);
        assert!(
            pixels.as_str().unwrap().len() > 1_000 && !drawn.contains(&pixels),
            "{trial} stands still at {step}"
        );
        drawn.push(pixels);
    }
    browser.picture(name);
    assert_eq!(browser.console(), json!([]), "{trial}");
}

#[test]
fn replays_change_from_step_to_step_in_wide_and_narrow_windows() {
    let replays = [
        ("zhang", "witness/w1/a-star", [1, 8, 16]),
        ("planar", "methods/case-1/a-star-8", [0, 10, 20]),
        ("theta", "replays/40-20/theta-star", [1, 40, 367]),
        ("gallery", "puma560/cell/0/high/shortest", [0, 30, 60]),
    ];
    for [width, height] in [[1280, 800], [390, 844]] {
        let Some(browser) = Browser::open([width, height]) else { return };
        for (paper, trial, steps) in replays {
            moves(&browser, &page(paper), trial, &steps, &format!("{paper}-replay-{width}"));
        }
    }
}

/// The study of a room with a second contender, which searches from both sides.
fn two_sided(bench: &Bench) {
    let both = "contenders = [\"A*\", \"Two-sided\"]";
    bench.edit("mini/room.toml", "contenders = [\"A*\"]", both);
    bench.edit(
        "mini/room.toml",
        "[[figure]]",
        "[[contender]]\nlabel = \"Two-sided\"\nplanner = \"bidirectional\"\n\
         settings = { weight = \"one\", meeting = \"both_closed\", side = \"alternate\", ties = \"fifo\" }\n[[figure]]",
    );
}

#[test]
fn a_search_closes_a_cell_a_step_and_its_sides_are_distinguished() {
    let bench = Bench::new();
    two_sided(&bench);
    bench.done(&["repro", "mini", "--quick", "--out", "quick"]);
    bench.done(&["report", "mini", "--out", "quick", "--to", "pages"]);
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = bench.at("pages/mini.html");
    let mut seen = Vec::new();
    for step in 0..5_usize {
        browser.go(&file, &format!("replay=room/room/two-sided&step={step}"));
        let output = browser.run("return document.querySelector('.controls output').textContent");
        let output = output.as_str().unwrap().to_owned();
        let closed = |side: &str| -> usize {
            let of = output.split(side).nth(1).unwrap().split(" closed").next().unwrap();
            of.rsplit(' ').next().unwrap().parse().unwrap()
        };
        let [one, start, goal] = ["A* ", "from the start ", "from the goal "].map(closed);
        assert_eq!((one, start, goal), (step, step.div_ceil(2), step / 2), "{output}");
        let pixels = browser.run(PIXELS);
        assert!(!seen.contains(&pixels), "step {step} looks as one before");
        seen.push(pixels);
    }
    browser.picture("mini-sides-1280");
    assert_eq!(browser.console(), json!([]));
}

#[test]
fn the_play_button_plays() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    browser.go(&page("planar"), "replay=methods/case-1/a-star-8");
    browser.run("document.querySelector('[name=play]').click()");
    browser.wait("return Number(document.querySelector('[name=step]').value) > 2");
    assert_eq!(browser.console(), json!([]));
}
