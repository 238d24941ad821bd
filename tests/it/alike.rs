//! Problem groups and contenders that are like another: what they have, what stands in the place of it, and what is refused.

use crate::paper::Bench;
use std::collections::BTreeMap;
use std::path::Path;
use study::paper::Paper;
use study::{Contender, Group, Inputs, Study};

/// What the paper shares with all studies.
const SHARED: &str = r#"
[[problems]]
label = "wide"
family = "random_cells"
instances = 5
settings = { size_cells = [12, 12], start = [0, 0], goal = [11, 9], blocked_share = 0.3, corner_rule = "allow" }

[[contender]]
label = "Two-sided"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "fifo" }
then = [{ stage = "delete_inflections", settings = { line_of_sight = "exact_interior" } }]
"#;

const STUDY: &str = r#"paper = "mini"
question = "Which side opens more?"
seed = 7
[budget]
expansions = 10_000
[quick]
instances = 3

[[problems]]
label = "wide"
like = "wide"

[[problems]]
label = "full"
like = "wide"
instances = 2
settings = { blocked_share = 0.4 }

[[problems]]
label = "fuller"
like = "full"
[problems.settings]
blocked_share = 0.45
goal = [10, 10]

[[contender]]
label = "Two-sided"
like = "Two-sided"

[[contender]]
label = "By turns"
like = "Two-sided"
settings = { ties = "lifo" }

[[contender]]
label = "As searched"
like = "By turns"
repeats = 1
then = []
"#;

/// The same, written out.
const WHOLE: &str = r#"paper = "mini"
question = "Which side opens more?"
seed = 7
[budget]
expansions = 10_000
[quick]
instances = 3

[[problems]]
label = "wide"
family = "random_cells"
instances = 5
settings = { size_cells = [12, 12], start = [0, 0], goal = [11, 9], blocked_share = 0.3, corner_rule = "allow" }

[[problems]]
label = "full"
family = "random_cells"
instances = 2
settings = { size_cells = [12, 12], start = [0, 0], goal = [11, 9], blocked_share = 0.4, corner_rule = "allow" }

[[problems]]
label = "fuller"
family = "random_cells"
instances = 2
settings = { size_cells = [12, 12], start = [0, 0], goal = [10, 10], blocked_share = 0.45, corner_rule = "allow" }

[[contender]]
label = "Two-sided"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "fifo" }
then = [{ stage = "delete_inflections", settings = { line_of_sight = "exact_interior" } }]

[[contender]]
label = "By turns"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "lifo" }
then = [{ stage = "delete_inflections", settings = { line_of_sight = "exact_interior" } }]

[[contender]]
label = "As searched"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "lifo" }
"#;

/// A bench whose paper shares what is above, with the study in `text`.
fn bench(text: &str) -> Bench {
    let bench = Bench::new();
    let paper = std::fs::read_to_string(bench.at("mini/paper.toml")).unwrap() + SHARED;
    bench.write("mini/paper.toml", paper.as_bytes());
    bench.write("mini/sides.toml", text.as_bytes());
    bench
}

fn study(text: &str) -> Study {
    let bench = bench(text);
    let folder = bench.at("mini");
    let paper = Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap();
    paper.study("sides").unwrap().clone()
}

/// What trials of a group and of a contender depend on.
fn parts(study: &Study) -> (Vec<String>, Vec<String>) {
    let group = |group: &Group| {
        let Group { label, family, instances, is_numbered, settings, .. } = group;
        format!("{label} {} {instances} {is_numbered} {:?}", family.name, settings.table())
    };
    let contender = |contender: &Contender| {
        let stages = contender.stages.iter().map(|stage| (stage.entry.name, stage.settings.table()));
        format!("{} {} {:?}", contender.label, contender.repeats, stages.collect::<Vec<_>>())
    };
    (study.groups.iter().map(group).collect(), study.contenders.iter().map(contender).collect())
}

#[test]
fn what_is_like_another_has_what_that_one_has_and_its_own_keys_in_their_places() {
    assert_eq!(parts(&study(STUDY)), parts(&study(WHOLE)));
}

#[test]
fn records_of_a_study_that_says_it_once_are_those_of_the_study_written_out() {
    let bench = bench(WHOLE);
    let rows = || std::fs::read(bench.at("target/replan/mini/data/runs/mini/sides.trials.parquet")).unwrap();
    bench.done(&["run", "./mini"]);
    let before = rows();
    bench.write("mini/sides.toml", STUDY.as_bytes());
    let output = bench.done(&["run", "./mini"]);
    assert!(output.contains("sides: 27 trials (9 of 9 units reused)"), "{output}");
    assert!(rows() == before, "other rows");
}

/// What is changed, where, into what, and what is said of it.
const REFUSED: [(&str, &str, &str, &str); 9] = [
    (
        "paper",
        "\n[[contender]]\nlabel = \"Two-sided\"",
        "\n[[contender]]\nlabel = \"Nobody\"\nplanner = \"direct\"\n\n[[contender]]\nlabel = \"Two-sided\"",
        "no study has an entry that is `like` `Nobody`",
    ),
    (
        "sides",
        "label = \"full\"\nlike = \"wide\"",
        "label = \"full\"\nlike = \"wild\"",
        "15:8: there is no problem group above or in paper.toml `wild`; there are wide",
    ),
    (
        "sides",
        "label = \"full\"\nlike = \"wide\"",
        "label = \"full\"\nlike = \"fuller\"",
        "there is no problem group above or in paper.toml `fuller`",
    ),
    (
        "sides",
        "like = \"full\"",
        "like = \"full\"\nfamily = \"random_cells\"",
        "problem group `fuller` has both of `family` and `like`; one of them is accepted",
    ),
    (
        "sides",
        "like = \"By turns\"\n",
        "",
        "contender `As searched` has neither of `planner` and `like`; one of them is accepted",
    ),
    ("sides", "goal = [10, 10]", "gaol = [10, 10]", "24:1: unknown key `gaol` (did you mean `goal`?)"),
    ("sides", "ties = \"lifo\"", "ties = \"fofo\"", "33:21: `ties` is \"fofo\" (did you mean `fifo`?)"),
    ("paper", "blocked_share = 0.3", "blocked_share = 3", "blocked_share is 3"),
    (
        "sides",
        "like = \"full\"",
        "like = \"full\"\neach = \"*.map\"",
        "`each` is accepted in a study, in groups that are `like` no other",
    ),
];

#[test]
fn what_cannot_be_like_another_is_refused_once_where_it_stands() {
    bench(STUDY).done(&["check", "./mini"]);
    for (file, from, to, refused) in REFUSED {
        let bench = bench(STUDY);
        bench.edit(&format!("mini/{file}.toml"), from, to);
        let output = bench.run(&["check", "./mini"]);
        assert_eq!(output.code, Some(2), "{to}: {}{}", output.out, output.err);
        let lines: Vec<&str> = output.err.lines().filter(|line| line.contains("mini/")).collect();
        assert!(lines.len() == 1 && lines[0].contains(refused), "{to}\n{}", output.err);
        assert!(lines[0].contains(&format!("/mini/{file}.toml:")), "{to}: {}", lines[0]);
    }
}

#[test]
fn no_group_and_no_contender_of_a_committed_study_is_written_twice() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut twice = Vec::new();
    for name in crate::paper::committed() {
        let folder = root.join("experiments").join(&name);
        let mut seen = BTreeMap::new();
        for path in std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            let spec: toml::Table = std::fs::read_to_string(&path).unwrap().parse().unwrap();
            for (part, key) in [("problems", "family"), ("contender", "planner")] {
                let entries = spec.get(part).and_then(toml::Value::as_array).into_iter().flatten();
                for entry in entries.filter(|entry| entry.get(key).is_some()) {
                    let settings = entry.get("settings").and_then(toml::Value::as_table);
                    let Some(settings) = settings.filter(|settings| settings.len() > 3) else { continue };
                    let text = format!("{key} {} {settings}", entry[key]);
                    let place = format!("{}: {}", path.display(), entry["label"]);
                    if let Some(first) = seen.insert(text, place.clone()) {
                        twice.push(format!("{first} and {place}"));
                    }
                }
            }
        }
    }
    assert_eq!(twice, [""; 0], "say `like`:\n{}", twice.join("\n"));
}
