//! `replan-export` from outside: what it writes of the project's own runs is what their records hold.

use polars::prelude::DataFrame;
use rusqlite::Connection;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use study::elsewhere::{Imported, Mapping, Table, read_log};
use study::parquet::FrameReader;
use study::store::Staged;
use tempfile::TempDir;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn export(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_replan-export")).args(arguments).current_dir(root()).output().unwrap()
}

/// The folder that `paper` was exported to.
fn exported(paper: &str, format: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let done = export(&[paper, "--to", format, "--out", folder.path().to_str().unwrap()]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    folder
}

fn stored(study: &str) -> DataFrame {
    let path = root().join(format!("data/runs/baselines/{study}.trials.parquet"));
    FrameReader::open(File::open(path).unwrap()).unwrap().frame().unwrap()
}

const STUDIES: [&str; 3] = ["cell", "grids", "scenes"];

#[test]
fn an_arena_has_a_run_for_each_trial_with_its_numbers() {
    let folder = exported("baselines", "planner-arena");
    let arena = Connection::open(folder.path().join("plannerarena.db")).unwrap();
    let runs: i64 = arena.query_row("SELECT count(*) FROM runs", [], |row| row.get(0)).unwrap();
    let trials: usize = STUDIES.iter().map(|study| stored(study).height()).sum();
    assert_eq!(runs as usize, trials);
    let ours: f64 = STUDIES
        .iter()
        .filter_map(|study| {
            Some(stored(study).column("path_cost_cells").ok()?.f64().ok()?.iter().flatten().sum::<f64>())
        })
        .sum();
    let theirs: f64 =
        arena.query_row("SELECT total(path_cost_cells) FROM runs", [], |row| row.get(0)).unwrap();
    assert!(ours > 0.0 && (ours - theirs).abs() < 1e-9 * ours, "{ours} and {theirs}");
    let solved: i64 = arena
        .query_row(
            "SELECT count(*) FROM runs JOIN enums ON enums.name = 'status' AND enums.value = runs.status \
             WHERE enums.description = 'Exact solution' AND runs.solved = 1",
            [],
            |row| row.get(0),
        )
        .unwrap();
    let is_solved = |study: &&str| {
        stored(study)
            .column("status")
            .unwrap()
            .str()
            .unwrap()
            .iter()
            .filter(|cell| *cell == Some("solved"))
            .count()
    };
    assert_eq!(solved as usize, STUDIES.iter().map(is_solved).sum::<usize>());
    let problems = |study: &&str| {
        let frame = stored(study);
        let [groups, queries] = ["group", "query"].map(|key| frame.column(key).unwrap().str().unwrap());
        groups.iter().zip(queries.iter()).collect::<BTreeSet<_>>().len()
    };
    let experiments: i64 = arena.query_row("SELECT count(*) FROM experiments", [], |row| row.get(0)).unwrap();
    assert_eq!(
        experiments as usize,
        STUDIES.iter().map(problems).sum::<usize>(),
        "a query is a problem of its own"
    );
    let orphans = "SELECT count(*) FROM runs WHERE plannerid NOT IN (SELECT id FROM plannerConfigs) \
                   OR experimentid NOT IN (SELECT id FROM experiments)";
    assert_eq!(arena.query_row(orphans, [], |row| row.get::<_, i64>(0)).unwrap(), 0);
}

/// What a log says of each planner: its runs by the names of their properties.
fn parsed(text: &str) -> BTreeMap<String, Vec<BTreeMap<String, String>>> {
    let start = text.lines().position(|line| line.ends_with(" planners")).unwrap();
    let mut lines = text.lines().skip(start + 1);
    let mut planners = BTreeMap::new();
    while let Some(planner) = lines.next() {
        assert_eq!(lines.next(), Some("0 common properties"));
        let count = |line: Option<&str>| line.unwrap().split(' ').next().unwrap().parse::<usize>().unwrap();
        let properties = count(lines.next());
        let names: Vec<String> =
            (0..properties).map(|_| lines.next().unwrap().rsplit_once(' ').unwrap().0.to_owned()).collect();
        let runs = count(lines.next());
        let run = |line: &str| {
            let cells: Vec<&str> = line.split("; ").collect();
            assert_eq!(cells.len(), properties + 1, "{line}");
            names.iter().cloned().zip(cells.into_iter().map(str::to_owned)).collect()
        };
        let runs = (0..runs).map(|_| run(lines.next().unwrap())).collect();
        assert_eq!(lines.next(), Some("."));
        planners.insert(planner.to_owned(), runs);
    }
    planners
}

#[test]
fn logs_have_a_run_for_each_trial_and_leave_out_what_was_not_measured() {
    let folder = exported("baselines", "ompl-log");
    let logs =
        fs::read_dir(folder.path()).unwrap().map(|entry| fs::read_to_string(entry.unwrap().path()).unwrap());
    let mut runs = 0;
    let mut missing = 0;
    for log in logs {
        assert!(log.starts_with("replan version "), "{log}");
        for run in parsed(&log).into_values().flatten() {
            runs += 1;
            missing += usize::from(run["time"].is_empty());
            assert!(run["status"].parse::<u8>().unwrap() < 10);
        }
    }
    let trials: usize = STUDIES.iter().map(|study| stored(study).height()).sum();
    assert_eq!(runs, trials);
    assert!(missing > 0 && missing < runs, "{missing} of {runs} runs have no time");
}

#[test]
fn one_parquet_file_has_the_trials_of_all_studies_and_the_columns_of_each() {
    let folder = exported("baselines", "parquet");
    let read = |name: &str| FrameReader::open(File::open(folder.path().join(name)).unwrap()).unwrap();
    let mut reader = read("trials.parquet");
    let described: Vec<serde_json::Value> = serde_json::from_str(reader.entry("columns").unwrap()).unwrap();
    let trials = reader.frame().unwrap();
    for study in STUDIES {
        let own = stored(study);
        let mask =
            trials.column("study").unwrap().str().unwrap().iter().map(|name| name == Some(study)).collect();
        let part = trials.filter(&mask).unwrap();
        for column in own.columns() {
            let found = part.column(column.name()).unwrap();
            assert!(found.cast(column.dtype()).unwrap().equals_missing(column), "{study}: {}", column.name());
        }
    }
    let names: Vec<&str> = described.iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names.len(), trials.width());
    let statistics = read("statistics.parquet").frame().unwrap();
    assert!(
        statistics.height() > 20 && statistics.column("mean_low").unwrap().null_count() < statistics.height()
    );
}

#[test]
fn a_trace_for_posthoc_opens_and_expands_as_the_search_did() {
    let folder = exported("zhang", "posthoc");
    let files: Vec<PathBuf> =
        fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(files.len() > 5, "{files:?}");
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let (head, events) = text.split_once("\nevents:\n").unwrap();
        assert!(head.starts_with("version: 1.4.0\n"));
        let event = |line: &str| {
            serde_json::from_str::<serde_json::Value>(line.strip_prefix("  - ").unwrap()).unwrap()
        };
        let events: Vec<serde_json::Value> = events.lines().map(event).collect();
        let mut open = Vec::new();
        for event in &events {
            match event["type"].as_str().unwrap() {
                "generating" => open.push(&event["id"]),
                "expanding" => assert!(open.contains(&&event["id"]), "{}: {event}", file.display()),
                kind => assert!(["source", "destination", "solution"].contains(&kind), "{kind}"),
            }
        }
        assert!(open.len() > 1, "{}", file.display());
    }
}

#[test]
fn names_that_sql_or_a_log_could_take_for_more_come_back_as_they_are() {
    let names = [
        "Robert'); DROP TABLE runs;--",
        "a \"quoted\" one; 2",
        "na\u{ef}ve \u{540d}",
        ".",
        "3 planners",
        "NULL",
    ];
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let rows = names.map(|name| format!("\"{}\",1\n", name.replace('"', "\"\"")));
    fs::write(at("results.csv"), format!("planner,map\n{}", rows.concat())).unwrap();
    let columns = "group = { is = \"maps'; --\" }\ninstance = \"map\"\ncontender = { column = \"planner\" }\n\
                   [status]\ncolumn = \"map\"\nmeans = { solved = [\"1\"] }\n";
    fs::write(at("columns.toml"), columns).unwrap();
    let mapping = Mapping::read(&at("columns.toml")).unwrap();
    let run = imported(folder.path(), &Table::read_csv(&at("results.csv")).unwrap(), &mapping);
    let out = exported(run.to_str().unwrap(), "planner-arena");
    let arena = Connection::open(out.path().join("plannerarena.db")).unwrap();
    let mut query = arena.prepare("SELECT name FROM plannerConfigs ORDER BY id").unwrap();
    let found: Vec<String> = query.query_map([], |row| row.get(0)).unwrap().map(Result::unwrap).collect();
    assert_eq!(found.into_iter().collect::<BTreeSet<_>>(), names.map(str::to_owned).into());
    let group: String = arena.query_row("SELECT name FROM experiments", [], |row| row.get(0)).unwrap();
    assert_eq!(group, "results/maps'; --");
    let out = exported(run.to_str().unwrap(), "ompl-log");
    let log = fs::read_dir(out.path()).unwrap().next().unwrap().unwrap().path();
    let planners = parsed(&fs::read_to_string(log).unwrap());
    assert_eq!(planners.into_keys().collect::<BTreeSet<_>>(), names.map(str::to_owned).into());
}

/// A stored run of a table, below `folder`; `columns` says which are keys and metrics.
fn imported(folder: &Path, table: &Table, mapping: &Mapping) -> PathBuf {
    let mut staged = Staged::default();
    let run = folder.join("run");
    Imported::new(table, mapping)
        .unwrap()
        .stage_alone(&mut staged, &run, "results", "a test".to_owned())
        .unwrap();
    staged.put().unwrap();
    run
}

#[test]
fn labels_that_are_long_or_spelled_alike_have_a_file_each() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let long = "corridor ".repeat(60);
    let labels = [format!("{long} one"), format!("{long} two"), "a b".to_owned(), "a-b".to_owned()];
    let rows = labels.iter().map(|label| format!("{label},1\n")).collect::<Vec<_>>().concat();
    fs::write(at("results.csv"), format!("suite,map\n{rows}")).unwrap();
    let columns = "group = { column = \"suite\" }\ninstance = \"map\"\ncontender = { is = \"A*\" }\n";
    fs::write(at("columns.toml"), columns).unwrap();
    let mapping = Mapping::read(&at("columns.toml")).unwrap();
    let run = imported(folder.path(), &Table::read_csv(&at("results.csv")).unwrap(), &mapping);
    let out = exported(run.to_str().unwrap(), "ompl-log");
    let logs: Vec<String> = fs::read_dir(out.path())
        .unwrap()
        .map(|entry| fs::read_to_string(entry.unwrap().path()).unwrap())
        .collect();
    assert_eq!(logs.len(), labels.len());
    for label in labels {
        let head = format!("\nExperiment results/{}\n", label.replace(' ', "_"));
        assert_eq!(logs.iter().filter(|log| log.contains(&head)).count(), 1, "{label}");
    }
    let out = exported(run.to_str().unwrap(), "planner-arena");
    let arena = Connection::open(out.path().join("plannerarena.db")).unwrap();
    let groups: i64 = arena.query_row("SELECT count(*) FROM experiments", [], |row| row.get(0)).unwrap();
    assert_eq!(groups, 4);
}

#[test]
fn a_log_comes_back_with_every_trial_its_end_and_its_numbers() {
    let out = exported("baselines", "ompl-log");
    let folder = tempfile::tempdir().unwrap();
    let columns = folder.path().join("columns.toml");
    let keys = "group = { is = \"\" }\ninstance = \"run\"\ncontender = { column = \"planner\" }\n";
    fs::write(&columns, format!("{keys}[metric]\npath_cost_cells = {{ column = \"path_cost_cells\" }}\n"))
        .unwrap();
    let log = read_log(&out.path().join("grids-cells.log")).unwrap();
    let more = Mapping::read(&columns).unwrap();
    let mapping = Mapping::of_log("cells", log.statuses, |head| log.table.has(head), Some(more));
    let run = imported(folder.path(), &log.table, &mapping);
    let back = FrameReader::open(File::open(run.join("results.trials.parquet")).unwrap());
    let back = back.unwrap().frame().unwrap();
    let ours = stored("grids");
    assert_eq!(back.height(), ours.height());
    let numbers = |frame: &DataFrame, contender: &str| {
        let names = frame.column("contender").unwrap().str().unwrap();
        let own = frame.filter(&names.iter().map(|name| name == Some(contender)).collect()).unwrap();
        let statuses = own.column("status").unwrap().str().unwrap();
        let solved = statuses.iter().filter(|status| *status == Some("solved")).count();
        let costs: Vec<Option<f64>> = own.column("path_cost_cells").unwrap().f64().unwrap().iter().collect();
        (solved, costs)
    };
    let names = ours.column("contender").unwrap().str().unwrap();
    let contenders: BTreeSet<&str> = names.iter().flatten().collect();
    assert!(contenders.len() > 2, "{contenders:?}");
    for contender in contenders {
        let (solved, costs) = numbers(&back, contender);
        assert_eq!(
            (solved, &costs),
            (numbers(&ours, contender).0, &numbers(&ours, contender).1),
            "{contender}"
        );
        assert!(solved > 0 && costs.iter().flatten().count() >= solved, "{contender}");
    }
    assert!(back.column("own_wall_ns").unwrap().null_count() < back.height());
}

#[test]
fn what_cannot_be_exported_leaves_nothing_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for (arguments, code, message) in [
        (["nowhere", "--to", "planner-arena"], 2, "`nowhere` holds no stored run"),
        (["gallery", "--to", "xlsx"], 2, "[possible values: csv, parquet, ompl-log, planner-arena, posthoc"),
        (["fu2018", "--to", "ro-crate"], 2, "--date <DAY>"),
        (["fu2018", "--to", "posthoc"], 2, "`fu2018` has no stored search on a grid"),
    ] {
        let output = export(&[&arguments[..], &["--out", out.to_str().unwrap()]].concat());
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{err}");
        assert!(err.contains(message), "{err}");
        assert!(!out.exists(), "{arguments:?}");
    }
}
