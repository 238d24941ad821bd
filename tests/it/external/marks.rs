//! What a reader sees of studies in which planners from outside race ours: what is bound to a clock, and what a roadmap cost.

use super::scripts::PRELUDE;
use super::{PAPER, contender};
use crate::paper::Bench;
use std::fs;
use study::reuse;

const STUDY: &str = r#"paper = "outside"
question = "Who goes round the bar?"
seed = 3

[budget]
expansions = 1_000

[[problems]]
label = "plane"
family = "plane_queries"
settings = { map = "bar.toml", samples = 60, radius_mm = 40 }

[[contender]]
label = "Improved A*"
planner = "roadmap_astar"
settings = { samples = 60, neighbour_mm = 40, cost = "hops", goal_shot = "never", path = "parents" }
"#;

const SHOWN: &str = r#"
[report]
tables = ["checks"]

[[results]]
id = "checks"
caption = "Checks."
study = "study"
rows = ["Improved A*", "theirs"]
cells = [
  { metric = "path_length_mm", show = "solved", label = "Solved", decimals = 0 },
  { metric = "components", show = "preprocessing", label = "Parts of the roadmap", decimals = 0 },
]
[[results.block]]
title = "plane"
problems = "plane"
"#;

const ROUND: &str = r#"world=plane; hello; while query; do result "[$start,[5.0,95.0],$goal]"; done"#;

/// The project's paper `outside`, in which a planner from outside and ours go round a bar.
fn project() -> Bench {
    let bench = Bench::empty();
    bench.add_plane();
    let script = "experiments/outside/round.sh";
    bench.write(script, format!("{PRELUDE}{ROUND}\n").as_bytes());
    let theirs = contender("theirs", &format!("[\"sh\", \"{script}\"]"), &format!("[\"{script}\"]"));
    let theirs = theirs.replace("any_angle = true, ", "");
    bench.write("experiments/outside/paper.toml", format!("{PAPER}{SHOWN}").as_bytes());
    bench.write("experiments/outside/study.toml", format!("{STUDY}{theirs}").as_bytes());
    bench
}

#[test]
fn a_study_bound_to_a_clock_says_so_wherever_it_is_shown() {
    let bench = project();
    bench.done(&["repro", "outside", "--trust"]);
    let mark = "Bound to a clock, so recorded and not repeated: theirs.";
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let read = |name: &str| words(&fs::read_to_string(bench.at(name)).unwrap());
    for place in ["paper_repro.md", "plots/outside/details.md", "plots/outside/checks.tex"] {
        assert!(read(place).contains(mark), "{place}: {}", read(place));
    }
    assert!(words(&bench.done(&["list", "studies"])).contains(mark));
    let manifest = "data/runs/outside/study.manifest.toml";
    assert!(read(manifest).contains("recorded = [\"theirs\"]"), "{}", read(manifest));
    bench.edit(manifest, "recorded = [\"theirs\"]\n", "");
    let output = bench.run(&["judge", "outside", "--check"]);
    assert_eq!(output.code, Some(3), "{}{}", output.out, output.err);
    assert!(
        format!("{}{}", output.out, output.err).contains("`recorded` is not what the study"),
        "{}",
        output.out
    );
    // The next run puts the mark back, and runs no trial for it.
    let output = bench.done(&["run", "outside", "--trust"]);
    assert!(output.contains("study: 2 trials (1 of 1 units reused)"), "{output}");
    assert!(read(manifest).contains("recorded = [\"theirs\"]"), "{}", read(manifest));
}

#[test]
fn a_table_shows_what_a_roadmap_cost_those_who_search_it_and_nobody_else() {
    let bench = project();
    bench.done(&["repro", "outside", "--trust"]);
    let (_, records) = reuse::stored(&bench.at("data/runs/outside"), "study").unwrap();
    let parts = records.batch.preprocessing[0].values.get("components").unwrap().as_f64();
    assert!(parts >= 1.0, "{parts} parts");
    let report = fs::read_to_string(bench.at("paper_repro.md")).unwrap();
    for row in [format!("| Improved A* | 100 | {parts} |"), "| theirs | 100 | – |".to_owned()] {
        assert!(report.contains(&row), "{row} is not in {report}");
    }
    let paper = "experiments/outside/paper.toml";
    bench.edit(paper, "\"components\"", "\"hops\"");
    let output = bench.run(&["check", "outside"]);
    let known = "study `study` does not produce the metric `hops`; it produces checked_states";
    assert!(output.err.contains(known), "{}", output.err);
}
