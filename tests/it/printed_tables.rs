//! The paper's own tables: numbers as they are printed become claims, and what is wrong with them is told at its place.

use crate::paper::Bench;
use replan::analysis::claims::claim_hash;
use replan::analysis::meaning;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use study::Inputs;
use study::paper::{Paper, TestRole};

const STUDY: &str = r#"paper = "forty"
question = "What does a weight save?"
seed = 4
budget = { expansions = 100_000 }
problems = [
GROUPS
]

[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 1, ties = "fifo" }

[[contender]]
label = "Weighted"
planner = "astar"
settings = { weight = 2, ties = "fifo" }
"#;

const TABLE: &str = r#"[source]
title = "A paper of forty numbers"

[[table]]
id = "t"
at = "Table 1"
caption = "Means over twelve maps."
select = { study = "maps" }
check.within = { statistic = "mean", margin = 2.0 }
row = [
ROWS
]

[[table.column]]
id = "length"
select = { metric = "path_cost_cells" }
unit = "cells"

[[table.column]]
id = "nodes"
select = { metric = "opened" }
check.within = { margin = 20.0 }

[[table.column]]
id = "expansions"
select = { metric = "expansions" }
check.within = { margin = 20.0 }

[[table.column]]
id = "bends"
check.within.select = { metric = "bends" }
"#;

/// A paper with a table of forty numbers, in a folder called `forty`.
fn forty() -> Bench {
    let bench = Bench::empty();
    let mut groups = String::new();
    let mut rows = String::new();
    for (number, share) in [0.0, 0.1, 0.2, 0.3, 0.35].into_iter().enumerate() {
        writeln!(
            groups,
            "  {{ label = \"{number}\", family = \"random_cells\", instances = 12, settings = {{ size_cells = [20, 20], start = [1, 1], \
             goal = [18, 15], blocked_share = {share}, corner_rule = \"allow\" }} }},"
        )
        .unwrap();
        for (id, label) in [("astar", "A*"), ("weighted", "Weighted")] {
            writeln!(
                rows,
                "  {{ id = \"{id}{number}\", select = {{ contender = \"{label}\", problems = \"{number}\" }}, printed = [\"23.5\", \"120\", \
                 \"60.0\", \"6.5\"] }},"
            )
            .unwrap();
        }
    }
    let study = STUDY.replace("GROUPS", groups.trim_end());
    let table = TABLE.replace("ROWS", rows.trim_end());
    let lines = study.lines().count() + table.lines().count();
    assert!(lines <= 80, "{lines} lines");
    bench.write("forty/maps.toml", study.as_bytes());
    bench.write("forty/paper.toml", table.as_bytes());
    bench
}

#[test]
fn forty_printed_cells_in_eighty_lines_of_toml_are_checked_run_and_judged() {
    let bench = forty();
    assert!(bench.done(&["check", "./forty"]).contains("50 claims"), "forty cells, ten rows");
    let output = bench.done(&["repro", "./forty", "--all"]);
    for cell in ["t.astar0.length", "t.weighted4.bends", "t.astar2 "] {
        assert!(output.lines().any(|line| line.starts_with(cell)), "{cell}: {output}");
    }
    // On an empty map both go straight to the goal's row: 14 diagonals and 3 steps.
    let straight = output.lines().find(|line| line.starts_with("t.astar0.length")).unwrap();
    assert!(straight.contains("23.5 cells") && straight.contains("reproduced"), "{straight}");
    assert!(
        output.contains(" not reproduced"),
        "every row prints the same, so that some must differ: {output}"
    );
    let report = std::fs::read_to_string(bench.at("target/replan/forty/paper_repro.md")).unwrap();
    assert!(report.contains("| weighted3 | printed | 23.5 | 120 | 60.0 | 6.5 |"), "{report}");
}

/// The paper of `bench` in the folder `name`.
fn loaded(bench: &Bench, name: &str) -> Paper {
    let folder = bench.at(name);
    Paper::load(&folder, &Inputs::below(vec![folder.clone()])).unwrap()
}

#[test]
fn a_claim_that_moves_into_a_table_asks_the_same() {
    let bench = forty();
    let paper = loaded(&bench, "forty");
    let mut written = String::new();
    let text = std::fs::read_to_string(bench.at("forty/maps.toml")).unwrap();
    for (number, label, id) in [(0, "A*", "astar0"), (3, "Weighted", "weighted3")] {
        let cells = [
            ("length", "path_cost_cells", "23.5", 2.0),
            ("nodes", "opened", "120", 20.0),
            ("expansions", "expansions", "60.0", 20.0),
            ("bends", "bends", "6.5", 2.0),
        ];
        for (column, metric, printed, margin) in cells {
            write!(
                written,
                "[[claim]]\nid = \"t.{id}.{column}\"\nat = \"elsewhere\"\nprinted = \"{printed}\"\n[claim.check.within]\nstatistic = \"mean\"\n\
                 margin = {margin:?}\nselect = {{ study = \"maps\", problems = \"{number}\", contender = \"{label}\", metric = \"{metric}\" }}\n"
            )
            .unwrap();
        }
    }
    bench.write("apart/maps.toml", text.replace("\"forty\"", "\"apart\"").as_bytes());
    bench.write("apart/paper.toml", format!("[source]\ntitle = \"t\"\n{written}").as_bytes());
    let apart = loaded(&bench, "apart");
    assert_eq!(apart.claims.len(), 8);
    for claim in &apart.claims {
        let moved = paper.claim(&claim.id).unwrap();
        assert_eq!(meaning::hash(&apart, claim), meaning::hash(&paper, moved), "{}", claim.id);
        assert_eq!(claim_hash(&apart, claim), claim_hash(&paper, moved), "{}", claim.id);
    }
    // Another margin is another question.
    bench.edit("forty/paper.toml", "margin = 2.0", "margin = 2.5");
    let claim = &apart.claims[0];
    let changed = loaded(&bench, "forty");
    assert_ne!(meaning::hash(&apart, claim), meaning::hash(&changed, changed.claim(&claim.id).unwrap()));
}

/// What is changed in the table, into what, and what is told of it.
const WRONG: [(&str, &str, &str); 13] = [
    (
        "\"23.5\", \"120\", \"60.0\", \"6.5\"]",
        "\"23.5\", \"120\", \"60.0\"]",
        "11:77: row `astar0` of table `t` has 3 cells for 4 columns; one for each is accepted, `N/A` where",
    ),
    (
        "\"120\"",
        "\"few\"",
        "11:86: claim `t.astar0.nodes`: printed is `few`; the digits of one number as the paper prints them are accepted",
    ),
    (
        "check.within = { statistic = \"mean\", margin = 2.0 }\n",
        "",
        "23:6: column `length` of table `t`: its cells are printed, and nothing says how they are judged",
    ),
    ("id = \"weighted0\"", "id = \"astar0\"", "12:10: another claim or cell is called `t.astar0` already"),
    (
        "\"6.5\"]",
        "\"N/A\"], cell.bends.headline = true",
        "11:114: table `t`: row `astar0`, column `bends`: the cell is no claim, so nothing is set for it",
    ),
    (
        "\"23.5\", \"120\", \"60.0\", \"6.5\"]",
        "\"23.5\", \"N/A\", \"N/A\", \"N/A\"], whole.headline = true",
        "11:108: row `astar0` of table `t` is no claim by itself: fewer than two of its cells can be tested",
    ),
    ("id = \"bends\"", "id = \"nodes\"", "39:6: table `t` has another column `nodes`"),
    (
        "id = \"weighted0\"",
        "id = \"weighted0\", cell.lenght.headline = true",
        "12:28: table `t`: there is no column `lenght` (did you mean `length`?); there are length, nodes, expansions, bends",
    ),
    (
        "metric = \"bends\"",
        "metric = \"bend\"",
        "40:34: there is no metric `bend`, nor a choice that gives the name a meaning (did you mean `bends`?)",
    ),
    (
        "study = \"maps\"",
        "study = \"map\"",
        "8:20: there is no study `map` (did you mean `maps`?); there are maps",
    ),
    (
        "problems = \"0\" }",
        "problems = \"9\" }",
        "11:60: study `maps` has no problem group `9`; it has 0, 1, 2, 3, 4",
    ),
    ("margin = 20.0", "margn = 20.0", "31:18: unknown key `margn` (did you mean `margin`?)"),
    (
        "check.within = { margin = 20.0 }",
        "check.witin = { margin = 20.0 }",
        "31:7: claim `t.astar0.nodes`: there is no criterion `witin` (did you mean `within`?)",
    ),
];

#[test]
fn what_is_wrong_with_a_table_is_reported_once_at_its_own_place() {
    for (from, to, wanted) in WRONG {
        let bench = forty();
        bench.edit("forty/paper.toml", from, to);
        let output = bench.run(&["check", "./forty"]);
        let lines = output.err.lines().filter(|line| line.contains("forty/paper.toml:")).collect::<Vec<_>>();
        let first = lines.first().copied().unwrap_or_default();
        assert!(
            output.code == Some(2) && first.contains(&format!("paper.toml:{wanted}")),
            "{to}: {}",
            output.err
        );
        let is_repeated =
            lines.iter().skip(1).any(|line| line.split(": ").nth(1) == first.split(": ").nth(1));
        assert!(!is_repeated, "{to}: {}", output.err);
    }
}

const COMPARED: &str = r#"
[[table]]
id = "u"
at = "Table 2"
caption = "Means over twelve maps."
select = { study = "maps", metric = "opened" }
check.mean_of = { instances = 12 }

[[table.column]]
id = "astar"
select = { contender = "A*" }

[[table.column]]
id = "weighted"
select = { contender = "Weighted" }

[[table.column]]
id = "more"
difference = ["astar", "weighted"]
select = { contender = "A*", against = "Weighted" }

[[table.row]]
id = "one"
printed = ["120.5", "9000"]
select = { problems = "1" }

[[table.row]]
id = "two"
printed = ["N/A", "60"]
select = { problems = "2" }

[[claim]]
id = "whole"
at = "Table 2"
says = "its numbers come from the same maps"
[claim.check.table_means]
in = [{ study = "maps", claims = ["u.*"] }]
refused_below = 0.05
"#;

/// The table of forty numbers beside one with a column that the paper does not print.
fn compared() -> Bench {
    let bench = forty();
    let text = std::fs::read_to_string(bench.at("forty/paper.toml")).unwrap() + COMPARED;
    bench.write("forty/paper.toml", text.as_bytes());
    bench
}

#[test]
fn what_one_column_has_more_than_another_is_a_claim_in_a_table_of_its_own() {
    let bench = compared();
    let paper = loaded(&bench, "forty");
    let ids: Vec<&str> = paper.claims.iter().map(|claim| claim.id.as_str()).collect();
    assert!(ids.contains(&"u.one.more") && !ids.contains(&"u.two.more"), "one number of it is not printed");
    let more = paper.claim("u.one.more").unwrap();
    assert_eq!(more.printed.as_deref(), Some("-8879.5"));
    assert_eq!(more.difference, Some(["u.one.astar", "u.one.weighted"].map(str::to_owned)));
    let output = bench.done(&["repro", "./forty", "--all"]);
    let line = |id: &str| output.lines().find(|line| line.starts_with(id)).unwrap_or_default();
    assert!(line("u.one.more").contains("not reproduced"), "A* opens more: {output}");
    assert!(line("whole").contains("inconclusive"), "twelve maps are too few: {output}");
    let report = std::fs::read_to_string(bench.at("target/replan/forty/paper_repro.md")).unwrap();
    assert!(!report.contains("| one | -8879.5 |"), "the paper does not print it: {report}");
    let details = std::fs::read_to_string(bench.at("target/replan/forty/plots/forty/details.md")).unwrap();
    assert!(details.contains("| one | -8879.5 |"), "{details}");
    assert!(!details.contains("| two | N/A |"), "a row without a difference: {details}");
}

const REPEATED: &str = r#"
[[table]]
id = "again"
at = "Table 2"
caption = "One row of Table 1, printed again."
select = { study = "maps", metric = "path_cost_cells", contender = "A*", problems = "0" }
check.within = { statistic = "mean", margin = 2.0 }
column = [{ id = "length" }]
row = [{ id = "one", printed = ["23.5"] }]
"#;

#[test]
fn a_number_that_two_tables_print_of_the_same_trials_counts_once() {
    let bench = forty();
    let text = std::fs::read_to_string(bench.at("forty/paper.toml")).unwrap() + REPEATED;
    let with = |printed: &str| {
        bench.write("forty/paper.toml", text.replace("[\"23.5\"] }]", printed).as_bytes());
        bench.run(&["check", "./forty"])
    };
    for (printed, wanted) in [
        (
            "[\"23.5\"] }]",
            "`again.one.length` prints the number that `t.astar0.length` prints of the same trials",
        ),
        (
            "[\"23.4\"], cell.length.same_as = \"t.astar0.length\" }]",
            "same_as: no cell `t.astar0.length` prints 23.4",
        ),
        ("[\"23.5\"], cell.length.same_as = \"t.astar0\" }]", "same_as: no cell `t.astar0` prints 23.5"),
    ] {
        let output = with(printed);
        assert!(
            output.code == Some(2) && output.err.matches(wanted).count() == 1,
            "{printed}: {}",
            output.err
        );
    }
    assert_eq!(with("[\"23.4\"] }]").code, Some(0), "another number is another claim");
    assert_eq!(with("[\"23.5\"], cell.length.same_as = \"t.astar0.length\" }]").code, Some(0));
    assert!(loaded(&bench, "forty").claim("again.one.length").is_none());
    bench.done(&["repro", "./forty"]);
    let report = std::fs::read_to_string(bench.at("target/replan/forty/paper_repro.md")).unwrap();
    let row = report.split("printed again").nth(1).unwrap();
    assert!(row.contains("details.md#t.astar0.length"), "the claim of the first table is shown: {report}");
}

#[test]
fn no_printed_number_of_a_committed_paper_is_claimed_twice_of_one_selection() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut questions = 0;
    let mut twice = Vec::new();
    for name in crate::paper::committed() {
        let folder = root.join("experiments").join(&name);
        let paper = Paper::load(&folder, &Inputs::below(vec![root.to_owned()])).unwrap();
        let mut seen = BTreeMap::new();
        for claim in paper.claims.iter().filter(|claim| claim.printed.is_some()) {
            for (role, _, settings) in claim.tests().filter(|(role, ..)| *role == TestRole::Decides) {
                let table = settings.table();
                let Some(selection) = table.get("select") else { continue };
                let question = format!("{:?} {selection} {:?}", claim.printed, table.get("statistic"));
                questions += 1;
                let first = seen.insert(question, &claim.id).filter(|first| **first != claim.id);
                twice.extend(first.map(|first| format!("{name}: `{first}` and `{}`, {role:?}", claim.id)));
            }
        }
    }
    assert!(questions > 300, "{questions}");
    assert!(twice.is_empty(), "printed once, `same_as` or a withdrawn claim:\n{}", twice.join("\n"));
}

#[test]
fn means_and_differences_that_cannot_be_computed_are_refused_where_they_stand() {
    for (from, to, wanted) in [
        (
            "difference = [\"astar\"",
            "difference = [\"astra\"",
            "table `u`: there is no column `astra` (did you mean `astar`?)",
        ),
        ("\"u.*\"", "\"t.astar0.length\"", "claim `t.astar0.length` is not judged by `mean_of`"),
        ("claims = [\"u.*\"]", "claims = []", "no claim that `mean_of` judges is named"),
        ("{ instances = 12 }", "{ instances = 0 }", "instances"),
    ] {
        let bench = compared();
        bench.edit("forty/paper.toml", from, to);
        let output = bench.run(&["check", "./forty"]);
        let message = output.err.lines().find(|line| line.contains("forty/paper.toml:")).unwrap_or_default();
        assert!(output.code == Some(2) && message.contains(wanted), "{to}: {}", output.err);
    }
}

#[test]
fn a_ninth_headline_is_refused_where_it_is_set_and_eight_open_the_chapter() {
    let bench = forty();
    let table = std::fs::read_to_string(bench.at("forty/paper.toml")).unwrap();
    let with = |headlines: usize| {
        let rows = table.matches("printed =").count();
        assert_eq!(rows, 10);
        let text = table.replacen("printed =", "cell.bends.headline = true, printed =", headlines);
        bench.write("forty/paper.toml", text.as_bytes());
        bench.run(&["check", "./forty"])
    };
    let output = with(9);
    let wanted =
        "the paper has 9 headline claims; at most 8 are accepted, so `t.astar4.bends` is one too many";
    assert!(output.code == Some(2) && output.err.contains(wanted), "{}", output.err);
    assert!(output.err.contains("forty/paper.toml:19:"), "{}", output.err);
    assert_eq!(with(8).code, Some(0));
    bench.done(&["repro", "./forty", "--all"]);
    let report = std::fs::read_to_string(bench.at("target/replan/forty/paper_repro.md")).unwrap();
    let claims = report.split("| claim |").nth(1).unwrap().split("\n\n").next().unwrap();
    let listed = claims.lines().filter(|line| line.starts_with("| [")).collect::<Vec<_>>();
    assert_eq!(listed.len(), 8, "{report}");
    assert!(listed.iter().all(|line| line.contains(".bends)")), "{listed:?}");
}

/// The paper of forty numbers with one claim in place of its table, about a study that sweeps the weight.
fn swept(claim: &str) -> Bench {
    let bench = forty();
    bench.edit(
        "forty/maps.toml",
        "[[contender]]\nlabel = \"Weighted\"",
        "[[sweep]]\nkey = \"weight\"\nstage = \"astar\"\nvalues = [1, 2, 3, 5]\n\n[[contender]]\nlabel = \"Weighted\"",
    );
    bench.edit("forty/maps.toml", "weight = 2, ties = \"fifo\"", "weight = 1, ties = \"lifo\"");
    bench.write(
        "forty/paper.toml",
        format!("[source]\ntitle = \"t\"\n[[claim]]\nid = \"c\"\nat = \"1\"\n{claim}").as_bytes(),
    );
    bench
}

#[test]
fn a_claim_asks_for_a_part_of_a_sweep() {
    let trials = |sweep: &str| {
        let bench = swept(&format!(
            "[claim.check.share]\nhits = \"solved\"\naccepted = [0.0, 0.5]\nselect = {{ study = \"maps\", problems = \"0\", contender = \"A*\", \
             sweep = {sweep} }}\n"
        ));
        let output = bench.done(&["repro", "./forty", "--all"]);
        let line = output.lines().find(|line| line.starts_with("c ")).unwrap();
        line.split_whitespace()
            .find_map(|word| word.strip_prefix("12/").or(word.split_once('/').map(|(_, all)| all)))
            .unwrap()
            .to_owned()
    };
    for (sweep, points) in [
        ("\"weight=2\"", 1),
        ("\"weight<=2\"", 2),
        ("\"weight<2\"", 1),
        ("\"weight>1,weight<=3\"", 2),
        ("\"weight >= 2\"", 3),
        ("[\"weight=1\", \"weight>3\"]", 2),
    ] {
        assert_eq!(trials(sweep), (12 * points).to_string(), "{sweep}");
    }
    let none = swept(
        "[claim.check.share]\nhits = \"solved\"\naccepted = [0.0, 0.5]\nselect = { study = \"maps\", problems = \"0\", contender = \"A*\", sweep = \
         [\"weight=1\", \"weight>5\"] }\n",
    );
    let output = none.run(&["check", "./forty"]).err;
    let wanted = "study `maps` has no sweep `weight>5`; it has weight=1, weight=2, weight=3, weight=5";
    assert!(output.contains(wanted) && output.contains("paper.toml:9:"), "{output}");
}

#[test]
fn success_along_a_part_of_a_sweep_is_computed_of_that_part() {
    let bench = swept(
        "[claim.check.lower]\nselect = { study = \"maps\", problems = \"3\", contender = \"A*\", against = \"Weighted\", sweep = \"weight<=3\" }\n",
    );
    bench.done(&["repro", "./forty", "--all"]);
    let output = bench.done(&["show", "./forty", "c"]);
    assert!(output.contains("at 0 of 3 points"), "{output}");
}

#[test]
fn a_selection_that_selects_nothing_is_refused_with_the_names_there_are() {
    let share = "[claim.check.share]\nhits = \"solved\"\naccepted = [0.0, 0.5]\nselect = { study = \"maps\", problems = \"0\" }\n";
    let bench = swept(share);
    let wanted =
        "paper.toml:9:10: `select` names no contender, so it selects nothing; study `maps` has A*, Weighted";
    let output = bench.run(&["check", "./forty"]).err;
    assert!(output.contains(wanted), "{output}");
    // What a task tries in the place of contenders has names too.
    let study = "paper = 'forty'\nquestion = 'q'\nseed = 1\nbudget = { expansions = 1 }\ntask = 'formula_error'\n\
                 task_settings = { samples = 5, reach = 0.5, range_cm = 5.0 }\n[[problems]]\nlabel = '0'\nfamily = 'random_polyhedra'\n\
                 settings = { side_cm = 60, step_cm = 1, count = [1, 1], size_cm = [7, 16], shapes = ['box'], clear_cm = 1, queries = \
                 [{ start = [4, 5, 6], goal = [56, 54, 50] }] }\n";
    bench.write("forty/maps.toml", study.as_bytes());
    let output = bench.run(&["check", "./forty"]).err;
    assert!(output.contains("it selects nothing; study `maps` has Printed distance"), "{output}");
    bench.edit("forty/paper.toml", "problems = \"0\"", "problems = \"0\", contender = \"Printed\"");
    let output = bench.run(&["check", "./forty"]).err;
    assert!(
        output.contains(
            "has no contender `Printed` (did you mean `Printed distance`?); it has Printed distance"
        ),
        "{output}"
    );
    bench.edit("forty/paper.toml", "\"Printed\"", "\"Printed distance\"");
    assert_eq!(bench.run(&["check", "./forty"]).code, Some(0));
}

#[test]
fn a_table_that_the_audit_wrote_as_claims_is_accepted_and_each_number_is_not_testable_yet() {
    let bench = Bench::new();
    let written = include_str!("../../src/audit/tests/it/claims/table.toml");
    let own = written.replace("table1", "table2").replace("Table 1", "Table 2");
    let paper = std::fs::read_to_string(bench.at("mini/paper.toml")).unwrap();
    bench.write("mini/paper.toml", (paper + &own).as_bytes());
    bench.edit("mini/paper.toml", "tables = 1", "tables = 2");
    bench.done(&["check", "./mini"]);
    bench.done(&["run", "./mini"]);
    let output = bench.done(&["judge", "./mini"]);
    for claim in ["table2.a_star.cost", "table2.improved_a_star.time", "table2.d_star.time"] {
        let line = output.lines().find(|line| line.starts_with(claim));
        assert!(line.is_some_and(|line| line.contains("not testable")), "{claim}: {output}");
    }
}
