//! Nine broken papers: each is one of `replan new` with several mistakes, all of which one round of `check` must tell.

use crate::paper::Bench;
use std::collections::BTreeMap;

/// A mistake: the file, what stands there, what is written instead, and what must be said of it.
type Mistake = (&'static str, &'static str, &'static str, &'static str);

/// What was done wrong, the template, and the mistakes.
const BROKEN: [(&str, &str, &[Mistake]); 9] = [
    (
        "keys misspelt in three tables of two files",
        "grid",
        &[
            ("compare.toml", "question = ", "qestion = ", "compare.toml:7:1: unknown key `qestion`"),
            ("compare.toml", "expansions = ", "expantions = ", "compare.toml:12:1: unknown key `expantions`"),
            ("paper.toml", "margin = 5", "margn = 5", "paper.toml:59:51: unknown key `margn`"),
        ],
    ),
    (
        "names of a planner, a family and a criterion that do not exist",
        "grid",
        &[
            (
                "compare.toml",
                "planner = \"astar\"",
                "planner = \"a_star\"",
                "compare.toml:30:11: contender `A*` asks for planner `a_star`",
            ),
            (
                "compare.toml",
                "family = \"random_rectangles\"",
                "family = \"rectangles\"",
                "compare.toml:17:10: there is no problem family `rectangles`",
            ),
            ("paper.toml", "[claim.check.lower]", "[claim.check.less]", "there is no criterion `less`"),
        ],
    ),
    (
        "claims that ask for a study, a contender and a metric that are not there",
        "grid",
        &[
            (
                "paper.toml",
                "[claim.check.lower]\nselect = { study = \"compare\"",
                "[claim.check.lower]\nselect = { study = \"comparison\"",
                "paper.toml:83:20: there is no study `comparison`",
            ),
            (
                "paper.toml",
                "contender = \"Weighted A*\"",
                "contender = \"WA*\"",
                "paper.toml:70:24: study `compare` has no contender `WA*`",
            ),
            (
                "paper.toml",
                "metric = \"opened\"",
                "metric = \"nodes\"",
                "paper.toml:58:21: there is no metric `nodes`",
            ),
        ],
    ),
    (
        "an inventory that leaves out a table and names claims that are not there",
        "grid",
        &[
            (
                "paper.toml",
                "tables = 1",
                "tables = 2",
                "paper.toml:12:10: the inventory has no row for Table 2",
            ),
            ("paper.toml", "\"fewer_nodes\", ", "\"fewer\", ", "paper.toml:24:11: there is no claim `fewer`"),
            (
                "paper.toml",
                "figures = [\"table1\", \"maps\"]",
                "figures = [\"table1\", \"map\"]",
                "paper.toml:19:22: there is no figure or table `map`",
            ),
        ],
    ),
    (
        "numbers as text, out of range and missing",
        "grid",
        &[
            ("compare.toml", "seed = 1\n", "", "compare.toml:1:1: missing key `seed`"),
            (
                "compare.toml",
                "instances = 60",
                "instances = \"60\"",
                "compare.toml:17:13: `instances` is \"60\"",
            ),
            (
                "paper.toml",
                "\"60\"]",
                "\"60 %\"]",
                "paper.toml:71:20: claim `table1.weighted.saving`: printed is `60 %`",
            ),
        ],
    ),
    (
        "an arm whose goal is out of reach and a figure of a problem that is not there",
        "arm",
        &[
            (
                "lengths.toml",
                "goal_cm = [-35, 20]",
                "goal_cm = [0, 55]",
                "lengths.toml:31:11: the goal [0.0, 55.0] is not a point of the workspace",
            ),
            (
                "lengths.toml",
                "problems = \"case 1\", instances",
                "problems = \"case 2\", instances",
                "lengths.toml:49:23: no problem group is called `case 2`",
            ),
        ],
    ),
    (
        "a setting that a planner does not know and one without its unit",
        "arm",
        &[
            (
                "lengths.toml",
                "open_node = \"lowered\"",
                "open_nodes = \"lowered\"",
                "lengths.toml:37:70: unknown key `open_nodes`",
            ),
            ("lengths.toml", "step_cm = 1", "step = 1", "lengths.toml:21:1: unknown key `step`"),
        ],
    ),
    (
        "a scene with a box turned inside out, a pose with five angles, a claim without a place",
        "cell",
        &[
            (
                "scene.toml",
                "max_mm = [800, -300, 60]",
                "max_mm = [300, -300, 60]",
                "scene.toml:19:11: obstacle `shelf`",
            ),
            ("poses.toml", "-120, -90, 0]", "-120, -90]", "poses.toml:5:5: "),
            ("paper.toml", "at = \"section 3\"\n", "", "missing key `at`"),
        ],
    ),
    (
        "a robot with a limit missing and a capsule of a link that it has not",
        "cell",
        &[
            ("robot.toml", "upper_deg = 360\n", "", "missing key `upper_deg`"),
            ("robot.toml", "radius_mm = 75", "radius = 75", "unknown key `radius`"),
        ],
    ),
];

/// The paper called `toy`, of a template, with every mistake made.
fn broken(template: &str, mistakes: &[Mistake]) -> Bench {
    let bench = Bench::empty();
    bench.done(&["new", "toy", "--from", template]);
    bench.done(&["check", "./toy"]);
    for (file, from, to, _) in mistakes {
        bench.edit(&format!("toy/{file}"), from, to);
    }
    bench
}

#[test]
fn one_round_of_check_tells_every_mistake_of_nine_broken_papers() {
    let mut messages = BTreeMap::new();
    let mut missed = Vec::new();
    for (what, template, mistakes) in BROKEN {
        let answer = broken(template, mistakes).run(&["check", "./toy"]);
        assert_eq!((answer.code, answer.out.as_str()), (Some(2), ""), "{what}: {}", answer.err);
        let unreported = mistakes.iter().filter(|(.., place)| !answer.err.contains(place));
        missed.extend(
            unreported.map(|(file, _, to, place)| format!("{what}: {file}: {to}: {place}\n{}", answer.err)),
        );
        messages.insert(what, answer.err);
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    let lines: Vec<String> =
        BROKEN.iter().map(|(what, ..)| format!("# {what}\n{}", messages[what])).collect();
    insta::assert_snapshot!(lines.join("\n"));
}
