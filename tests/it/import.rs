//! Results that others recorded: what becomes of a table or a log, and what is refused.

use crate::paper::Bench;
use polars::prelude::DataFrame;
use std::fs;
use study::elsewhere::Table;
use study::parquet::FrameReader;

/// A benchmark log as OMPL 1.6 writes it, with a run that timed out, an approximate solution, and progress over time.
pub const LOG: &str = include_str!("import/benchmark.log");

/// Two rows as pandas 3 writes them, with a column of categories, one of dates, and numbers of single precision and of 8 bits.
pub const SNAPPY: &[u8] = include_bytes!("import/pandas.snappy.parquet");
/// The same, packed by gzip.
const GZIP: &[u8] = include_bytes!("import/pandas.gzip.parquet");

const COLUMNS: &str = "group = { is = \"maps\" }\ninstance = \"map\"\ncontender = { column = \"planner\" }\n\
                       [status]\ncolumn = \"ok\"\nmeans = { solved = [\"1\"], no_path = [\"0\"] }\n\
                       [metric]\nexpansions = { column = \"n\" }\n";

const RESULTS: &str = "map,planner,ok,n\nb,A*,1,9\na,A*,1,7\nb,Ours,0,\na,Ours,1,3\n";

fn trials(bench: &Bench, file: &str) -> DataFrame {
    FrameReader::open(fs::File::open(bench.at(file)).unwrap()).unwrap().frame().unwrap()
}

/// The cells of a column, as text.
fn cells(frame: &DataFrame, column: &str) -> Vec<String> {
    let column = frame.column(column).unwrap();
    (0..frame.height()).map(|row| column.get(row).unwrap().to_string().replace('"', "")).collect()
}

#[test]
fn rows_of_a_table_become_trials_of_unknown_seed_whose_instances_are_paired_by_name() {
    let bench = Bench::empty();
    bench.write("columns.toml", COLUMNS.as_bytes());
    bench.write("results.csv", RESULTS.as_bytes());
    bench.done(&["import", "results.csv", "--from", "csv", "--columns", "columns.toml", "--out", "there"]);
    let frame = trials(&bench, "there/results.trials.parquet");
    assert_eq!(cells(&frame, "contender"), ["A*", "Ours", "A*", "Ours"]);
    assert_eq!(cells(&frame, "instance"), ["0", "0", "1", "1"], "map b comes first");
    assert_eq!(cells(&frame, "expansions"), ["9", "null", "7", "3"]);
    assert_eq!(cells(&frame, "status"), ["solved", "no_path", "solved", "solved"]);
    assert_eq!(cells(&frame, "seed"), ["null"; 4]);
    let manifest = fs::read_to_string(bench.at("there/results.manifest.toml")).unwrap();
    assert!(manifest.contains("elsewhere = \"results.csv (sha256 "), "{manifest}");
    // What leaves as Parquet comes back the same.
    let columns = COLUMNS
        .replace("{ is = \"maps\" }", "{ column = \"group\" }")
        .replace("\"map\"", "\"instance\"")
        .replace("\"planner\"", "\"contender\"")
        .replace("\"ok\"", "\"status\"")
        .replace("[\"1\"]", "[\"solved\"]")
        .replace("[\"0\"]", "[\"no_path\"]")
        .replace("\"n\"", "\"expansions\"");
    bench.write("again.toml", columns.as_bytes());
    let file = "there/results.trials.parquet";
    bench.done(&["import", file, "--from", "parquet", "--columns", "again.toml", "--out", "again"]);
    assert!(trials(&bench, "again/results-trials.trials.parquet").equals_missing(&frame));
}

#[test]
fn a_parquet_file_of_pandas_is_read_but_for_columns_of_dates_and_one_that_is_cut_off_is_refused() {
    let bench = Bench::empty();
    let columns = "group = { column = \"suite\" }\ninstance = \"map\"\ncontender = { column = \"planner\" }\n\
                   [status]\ncolumn = \"ok\"\nmeans = { solved = [\"true\"], no_path = [\"false\"] }\n\
                   [metric]\npath_length_cm = { column = \"length_cm\" }\nexpansions = { column = \"expanded\" }\n";
    bench.write("columns.toml", columns.as_bytes());
    let import = |bytes: &[u8]| {
        bench.write("results.parquet", bytes);
        let from =
            ["import", "results.parquet", "--from", "parquet", "--columns", "columns.toml", "--out", "there"];
        bench.run(&from)
    };
    for bytes in [SNAPPY, GZIP] {
        let output = import(bytes);
        assert_eq!(output.code, Some(0), "{}", output.err);
        let frame = trials(&bench, "there/results.trials.parquet");
        assert_eq!(cells(&frame, "contender"), ["A*", "Ours"]);
        assert_eq!(cells(&frame, "status"), ["solved", "no_path"]);
        assert_eq!(cells(&frame, "expansions"), ["3", "null"]);
        let lengths = frame.column("path_length_cm").unwrap().f64().unwrap();
        assert_eq!(lengths.get(0), Some(0.123_456_79), "in the digits of single precision");
        fs::remove_dir_all(bench.at("there")).unwrap();
    }
    for end in (0..SNAPPY.len()).step_by(5) {
        bench.write("cut.parquet", &SNAPPY[..end]);
        let error = Table::read_parquet(&bench.at("cut.parquet")).unwrap_err().to_string();
        assert!(error.contains("cut.parquet: is no Parquet file that can be read"), "{end} bytes: {error}");
    }
    bench.edit("columns.toml", "column = \"suite\"", "column = \"day\"");
    let output = import(SNAPPY);
    assert_eq!(output.code, Some(2));
    assert!(
        output.err.contains("column `day` holds neither texts nor numbers nor booleans"),
        "{}",
        output.err
    );
}

#[test]
fn a_parquet_file_that_claims_more_values_than_it_has_rows_is_refused() {
    let bench = Bench::empty();
    let file = bench.at("results.parquet");
    let mut claims = 0;
    // The number -1 in place of each byte of the first pages and of the end of the pages, where columns are described.
    for at in (0..400).chain(900..1000) {
        let mut bytes = SNAPPY.to_vec();
        bytes[at] = 1;
        fs::write(&file, bytes).unwrap();
        if let Err(error) = Table::read_parquet(&file) {
            let message = error.to_string();
            assert!(message.contains("results.parquet: is no Parquet file that can be read"), "{message}");
            claims +=
                u32::from(message.contains("a column or page claims -1 values or bytes; at most 2 can be"));
        }
    }
    assert!(claims >= 7, "{claims} of six pages and a column");
}

#[test]
fn a_log_of_ompl_is_compared_and_gated() {
    let bench = Bench::empty();
    bench.write("bench.log", LOG.as_bytes());
    bench.done(&["import", "bench.log", "--from", "ompl-log", "--out", "a"]);
    let frame = trials(&bench, "a/bench.trials.parquet");
    assert_eq!(
        cells(&frame, "status"),
        ["solved", "solved", "solved", "solved", "time_spent", "time_spent"],
        "an approximate solution reaches no goal"
    );
    assert_eq!(frame.column("own_wall_ns").unwrap().f64().unwrap().get(0), Some(1.5e9));
    assert_eq!(cells(&frame, "samples"), ["900", "120", "1000", "130", "950", "90"]);
    let slower = LOG.replace("; 0.25; ", "; 2.5; ").replace("120; 200;", "1200; 200;");
    bench.write("bench.log", slower.as_bytes());
    bench.done(&["import", "bench.log", "--from", "ompl-log", "--out", "b"]);
    let output = bench.run(&["compare", "a", "b", "--markdown"]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    assert!(output.out.contains("recorded elsewhere, with unknown seeds"), "{}", output.out);
    let gated = bench.run(&["compare", "a", "b", "--gate", "solved -1%"]);
    assert!(gated.out.contains("gate solved -1%: bench: geometric_PRM: "), "{}{}", gated.out, gated.err);
    let within =
        bench.done(&["compare", "a", "--contenders", "geometric_RRTConnect", "geometric_PRM", "--markdown"]);
    assert!(within.contains("own_time_ms") && within.contains("recorded elsewhere"), "{within}");
    let between = bench.done(&["compare", "a", "b", "--gate", "own_time_ms +5%"]);
    let words = between.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("each run has one session of the clock"), "{between}");
}

#[test]
fn a_log_that_is_cut_off_or_of_another_form_is_refused_with_its_line_and_leaves_nothing() {
    let bench = Bench::empty();
    let lines: Vec<&str> = LOG.lines().collect();
    let mut refused = 0;
    for cut in 0..lines.len() {
        bench.write("bench.log", (lines[..cut].join("\n") + "\n").as_bytes());
        let output = bench.run(&["import", "bench.log", "--from", "ompl-log", "--out", "there"]);
        assert_eq!(output.code, Some(2), "{cut}: {}{}", output.out, output.err);
        let place = format!("bench.log: line {}: ", cut + 1);
        let is_empty = cut == 0 && output.err.contains("line 1: ");
        assert!(output.err.contains(&place) || is_empty, "{cut}: {}", output.err);
        assert!(!bench.at("there").exists());
        refused += 1;
    }
    assert!(refused > 40);
    for (from, to, message) in [
        ("120; 200; 3120.5", "120; 200", "line 30: `120; 200; 6; 0.25; ` stands where a run with 5 values"),
        ("3 runs\n120", "many runs\n120", "line 29: `many runs` stands where `N runs` is expected"),
        ("status|Unknown", "outcome|Unknown", "no `status|…` names the statuses"),
        ("; 6; 0.25; ", "; 66; 0.25; ", "line 30, column `status`: `66` means no status"),
        ("; 6; 0.25; ", "; 6; soon; ", "line 30, column `time`: `soon` is no number"),
    ] {
        assert!(LOG.contains(from), "{from}");
        bench.write("bench.log", LOG.replacen(from, to, 1).as_bytes());
        let output = bench.run(&["import", "bench.log", "--from", "ompl-log", "--out", "there"]);
        assert_eq!(output.code, Some(2), "{from}: {}", output.out);
        assert!(output.err.contains(message), "{from}: {}", output.err);
        assert!(!bench.at("there").exists());
    }
}

#[test]
fn a_table_or_a_mapping_that_does_not_fit_is_refused_at_its_place() {
    let bench = Bench::empty();
    for (results, columns, message) in [
        (
            RESULTS,
            COLUMNS.replace("\"map\"", "\"mapp\""),
            "there is no column `mapp` (did you mean `map`?); there are map, planner, ok, n",
        ),
        (
            RESULTS,
            COLUMNS.replace("expansions", "expansion"),
            "columns.toml:8:1: there is no column of records `expansion`",
        ),
        (RESULTS, COLUMNS.replace("no_path", "nopath"), "there is no status `nopath`"),
        (
            RESULTS,
            COLUMNS.replace("[\"0\"]", "[\"no\"]"),
            "line 4, column `ok`: `0` means no status; no, 1 do",
        ),
        ("map,planner,ok,n\nb,A*,1,9.5\n", COLUMNS.to_owned(), "line 2, column `n`: 9.5 is no count"),
        (
            "map,planner,ok,n\nb,A*,1\n",
            COLUMNS.to_owned(),
            "results.csv: line 2: has 3 cells; 4 are accepted",
        ),
        ("map,planner,ok,n\n", COLUMNS.to_owned(), "holds no row below its heads"),
        (
            "map,planner,ok,n\nb,A*,1,9\nb,A*,1,8\n",
            COLUMNS.to_owned(),
            "line 3 is the same trial as line 2: `A*` on instance `b` of `maps`, repeat 0",
        ),
        ("map,planner,ok,n\nb,A*,1,9\n,A*,1,8\n", COLUMNS.to_owned(), "line 3: the instance has no name"),
        ("map,planner,ok,n\nb,,1,9\n", COLUMNS.to_owned(), "line 2: the contender has no name"),
        (
            "map,planner,ok,n\nb,A*,1,9\na,A*,1,\"8\n",
            COLUMNS.to_owned(),
            "line 3: a `\"` that opens a cell has no other that ends it",
        ),
    ] {
        bench.write("results.csv", results.as_bytes());
        bench.write("columns.toml", columns.as_bytes());
        let output = bench.run(&[
            "import",
            "results.csv",
            "--from",
            "csv",
            "--columns",
            "columns.toml",
            "--out",
            "there",
        ]);
        assert_eq!(output.code, Some(2), "{message}: {}{}", output.out, output.err);
        assert!(output.err.contains(message), "{message}\nis not in\n{}", output.err);
        assert!(!bench.at("there").exists(), "{message}");
    }
}

#[test]
fn a_database_of_planner_arena_is_named_in_every_format() {
    let bench = Bench::empty();
    bench.write("columns.toml", COLUMNS.as_bytes());
    bench.write("arena.db", b"SQLite format 3\0\x10\0\x01\x01\0\x40\x20\x20");
    for from in ["csv", "parquet", "ompl-log"] {
        let output =
            bench.run(&["import", "arena.db", "--from", from, "--columns", "columns.toml", "--out", "there"]);
        assert_eq!(output.code, Some(2), "{from}: {}", output.out);
        assert!(
            output.err.contains("arena.db: is an SQLite database, as Planner Arena has"),
            "{}",
            output.err
        );
        assert!(!bench.at("there").exists());
    }
}

const STUDY: &str = "paper = \"own\"\nquestion = \"Fewer?\"\nseed = 1\n[budget]\nexpansions = 1\n\
                     [[problems]]\nlabel = \"maps\"\nfamily = \"recorded\"\ninstances = 2\nsettings = { unit = \"map\" }\n\
                     [[contender]]\nlabel = \"A*\"\nplanner = \"recorded\"\n[[contender]]\nlabel = \"Ours\"\nplanner = \"recorded\"\n";

const PAPER: &str = "[source]\ntitle = \"T\"\nauthors = \"N. N.\"\n[prints]\ntables = 0\n\
                     [[inventory]]\nitem = \"section 1\"\nsays = \"s\"\nclaims = [\"fewer\"]\n\
                     [[claim]]\nid = \"fewer\"\nat = \"section 1\"\nsays = \"fewer\"\n[claim.check.lower]\n\
                     select = { study = \"results\", problems = \"maps\", contender = \"Ours\", against = \"A*\", metric = \"expansions\" }\n";

#[test]
fn results_that_are_not_those_of_the_study_are_refused_and_a_study_without_them_says_what_to_do() {
    let bench = Bench::empty();
    bench.write("own/results.toml", STUDY.as_bytes());
    bench.write("own/paper.toml", PAPER.as_bytes());
    bench.write("columns.toml", COLUMNS.as_bytes());
    let left = bench.run(&["run", "./own"]);
    assert_eq!(left.code, Some(4), "{}", left.err);
    assert!(left.err.contains("`replan import` writes them"), "{}", left.err);
    let import = |results: &str, into: &str| {
        bench.write("results.csv", results.as_bytes());
        bench.run(&["import", "results.csv", "--from", "csv", "--columns", "columns.toml", "--into", into])
    };
    for (results, into, message) in [
        (RESULTS.to_owned(), "./own/result", "there is no study `result` (did you mean `results`?)"),
        (RESULTS.replace("Ours", "Theirs"), "./own/results", "there is no contender `Theirs`"),
        (
            RESULTS.to_owned() + "c,A*,1,4\n",
            "./own/results",
            "instance `c` of `maps` is number 3, repeat 0; the study has 2",
        ),
        (RESULTS.replace("b,Ours,0,\n", ""), "./own/results", "a trial that failed is a row with a status"),
    ] {
        let output = import(&results, into);
        assert_eq!(output.code, Some(2), "{message}: {}{}", output.out, output.err);
        assert!(output.err.contains(message), "{message}\nis not in\n{}", output.err);
        assert!(!bench.at("target/replan/own/data/runs/own/results.manifest.toml").exists());
    }
    assert_eq!(import(RESULTS, "./own/results").code, Some(0));
    // The records are the study's: nothing is stale, not even where everything is to run again.
    for again in [&["run", "./own"][..], &["run", "./own", "--fresh"]] {
        let output = bench.run(again);
        assert_eq!(output.code, Some(0), "{again:?}: {}", output.err);
    }
    let frame = trials(&bench, "target/replan/own/data/runs/own/results.trials.parquet");
    assert_eq!(cells(&frame, "expansions"), ["9", "null", "7", "3"]);
}
