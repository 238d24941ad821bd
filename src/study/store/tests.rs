use super::KeptTraces;
use super::describe::{Described, described};
use super::read::{Instances, Stored, quoted};
use super::table::{self, DESCRIPTION};
use super::traces::{self, GROUP_VALUES, TraceReader};
use super::write::GroupWriter;
use super::{Staged, remove_temporaries, write_whole};
use crate::column;
use crate::key::{InstanceKey, InterpretationKey, KeyColumns, Owner, SweepKey, SweepValue, Text, TrialKey};
use crate::parquet::{FrameReader, write_frame};
use crate::record::{Kept, PreprocessingRow, Row, Status, Timing, Values};
use base::hash::sha256;
use engine::planner::{Trace, Value};
use polars::prelude::DataFrame;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Cursor;
use std::path::PathBuf;
use std::sync::Arc;

fn keys() -> KeyColumns {
    let sweeps = ["weight", "samples", "kind", "lazy"];
    KeyColumns {
        posed: Vec::new(),
        sweeps: sweeps.map(|key| (Text::from(key), Text::from("a_planner"))).into(),
        choices: vec!["corners".into(), "ties".into()],
    }
}

fn on(instance: u32) -> Arc<InstanceKey> {
    let option = |id: &str, option: &str| (Text::from(id), Text::from(option));
    let interpretation =
        InterpretationKey::new(vec![option("corners", "cut"), option("ties", "fifo/lifo,a=b")]);
    Arc::new(InstanceKey { group: "a group".into(), sweep: SweepKey::default(), instance, interpretation })
}

fn trial(instance: u32, query: Option<&str>) -> TrialKey {
    let sweep = SweepKey::new(vec![
        ("weight".into(), SweepValue::Real(1.5)),
        ("samples".into(), SweepValue::Whole(100)),
        ("kind".into(), SweepValue::Text("12".into())),
        ("lazy".into(), SweepValue::Flag(instance == 0)),
    ]);
    TrialKey {
        on: on(instance),
        query: query.map(Text::from),
        contender: "A*".into(),
        sweep,
        repeat: instance + 3,
    }
}

fn rows() -> Vec<Row> {
    let row = |instance, query, reason: Option<&str>, values: &[(&'static str, Value)]| Row {
        key: trial(instance, query),
        seed: Some(u64::MAX),
        status: if reason.is_some() { Status::NoPath } else { Status::Solved },
        reason: reason.map(str::to_owned),
        values: values.iter().copied().collect::<Values>(),
    };
    let measured = [("path_cost_cells", Value::Real(0.1 + 0.2)), ("opened", Value::Count(7))];
    vec![
        row(0, None, None, &measured),
        row(0, Some("2"), Some("none"), &measured[1..]),
        row(1, Some("2"), None, &[]),
    ]
}

/// So many traces: the first ones of instances, the others of trials.
fn kept(count: u32) -> Vec<Kept> {
    let of = |number: u32| match number {
        0..5 => Owner::Instance(on(number)),
        _ => Owner::Trial(trial(number, None)),
    };
    let values = |number: u32| (0..number % 9).map(|value| f64::from(value) / 3.0).collect();
    let trace = |number| Trace { name: "path".to_owned(), width: 1, values: values(number) };
    (0..count).map(|number| Kept { owner: of(number), trace: trace(number) }).collect()
}

fn to_parquet(frame: DataFrame) -> Vec<u8> {
    let mut bytes = Vec::new();
    let entries = table::description(&frame, &keys());
    write_frame(&mut bytes, frame, entries).unwrap();
    bytes
}

fn stored(frame: DataFrame) -> Stored {
    Stored::open(PathBuf::from("a.parquet"), to_parquet(frame)).unwrap()
}

#[test]
fn typed_keys_and_values_come_back_from_parquet_as_they_were() {
    let rows = rows();
    let instances = &mut Instances::default();
    let trials = table::trials(&rows, &keys(), &["path_cost_cells", "opened", "closed"], None);
    let kinds = ["sweep_weight", "sweep_samples", "sweep_kind", "sweep_lazy", "choice_ties"]
        .map(|name| trials.column(name).unwrap().dtype().to_string());
    assert_eq!(kinds, ["f64", "i64", "str", "bool", "str"]);
    assert_eq!(trials.column("query").unwrap().null_count(), 1, "unknown is null");
    assert_eq!(trials.column("path_cost_cells").unwrap().null_count(), 2, "unmeasured is null");
    let back = stored(trials).trials(instances).unwrap();
    assert_eq!(back, rows);
    assert!(Arc::ptr_eq(&back[0].key.on, &back[1].key.on), "labels are copied");
    let preprocessing = vec![PreprocessingRow {
        key: on(1),
        kind: "k".into(),
        seed: 3,
        reason: None,
        values: Values::default(),
    }];
    assert_eq!(
        stored(table::preprocessing(&preprocessing, &keys(), &BTreeSet::new()))
            .preprocessing(instances)
            .unwrap(),
        preprocessing
    );
    let trace = |values: Vec<f64>| Trace { name: "path".to_owned(), width: 1, values };
    let kept = vec![
        Kept { owner: Owner::Instance(on(1)), trace: trace(vec![]) },
        Kept { owner: Owner::Trial(trial(1, None)), trace: trace(vec![0.5, -0.0]) },
    ];
    assert_eq!(stored(table::traces(&kept, &keys(), None)).traces(instances).unwrap(), kept);
    let time = |session| Timing { trial: trial(0, None), session, clock_repeat: 4, plan_wall_ns: 99 };
    let times = vec![time(1), time(2)];
    assert_eq!(stored(table::times(&times, &keys())).times(instances).unwrap(), times);
}

#[test]
fn every_column_of_a_file_is_described_in_its_metadata() {
    let columns: Vec<&'static str> = column::COLUMNS.iter().map(|column| column.name).collect();
    let frame = table::trials(&rows(), &keys(), &columns, None);
    let names: Vec<String> = frame.columns().iter().map(|column| column.name().to_string()).collect();
    let bytes = to_parquet(frame);
    let reader = FrameReader::open(Cursor::new(bytes)).unwrap();
    let found: Vec<Described> = serde_json::from_str(reader.entry(DESCRIPTION).unwrap()).unwrap();
    assert_eq!(found.iter().map(|column| &column.name).collect::<Vec<_>>(), names.iter().collect::<Vec<_>>());
    let of = |name: &str| found.iter().find(|column| column.name == name).unwrap();
    assert_eq!(of("path_length_cm").unit.as_deref(), Some("cm"));
    assert_eq!(
        (of("opened").unit.as_deref(), &*of("opened").about),
        (None, "nodes ever put on an open list, both sides")
    );
    assert_eq!(
        of("sweep_weight").about,
        "value of the setting `weight` of `a_planner`, which the study sweeps"
    );
    assert_eq!(of("choice_ties").about, "option taken of the choice `ties`");
    let nothing = BTreeSet::new();
    for frame in [
        table::preprocessing(&[], &keys(), &nothing),
        table::traces(&[], &keys(), None),
        table::times(&[], &keys()),
    ] {
        for column in frame.columns() {
            assert!(described(column.name(), &keys()).is_some(), "{} is not described", column.name());
        }
    }
    assert_eq!(described("sweep_other", &keys()), None);
}

#[test]
fn measured_columns_are_distinguished_from_those_of_keys_by_their_names() {
    for column in column::COLUMNS {
        let is_key = ["sweep_", "choice_"].iter().any(|prefix| column.name.starts_with(prefix));
        let described = described(column.name, &KeyColumns::default()).unwrap();
        assert!(!is_key && described.about == column.about, "{}", column.name);
    }
}

/// The file of `kept` in groups of at most so many numbers.
fn in_groups(kept: &[Kept], most: usize) -> Vec<u8> {
    let keys = keys();
    let sweep = traces::sweep_of(kept);
    let weight = |kept: &Kept| kept.trace.values.len();
    let frame = |kept: &[Kept]| table::traces(kept, &keys, sweep.as_ref());
    let mut file = GroupWriter::new(Vec::new(), &keys, (weight, most), frame);
    for kept in kept {
        file.add(kept.clone()).unwrap();
    }
    file.finish().unwrap()
}

#[test]
fn only_the_groups_that_are_wanted_are_read_and_one_at_a_time_by_who_takes_them() {
    let all = kept(40);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.traces.parquet");
    fs::write(&path, in_groups(&all, 7)).unwrap();
    let hashes = |hash| BTreeMap::from([("traces".to_owned(), hash)]);
    let sound = hashes(sha256(&fs::read(&path).unwrap()));
    let stored = KeptTraces::stored(folder.path(), "a", &sound).unwrap();
    assert_eq!(stored.in_memory(), 0, "no group is read before one is needed");
    let (first, last) = (&all[0], &all[39]);
    assert_eq!(stored.owned_by(&last.owner).collect::<Vec<_>>(), [&last.trace]);
    assert_eq!(stored.in_memory(), 1);
    assert_eq!(stored.owners().unwrap(), all.iter().map(|kept| &kept.owner).collect::<Vec<_>>());
    let mut stored = stored;
    for kept in &all {
        assert_eq!(stored.take(&kept.owner).unwrap(), std::slice::from_ref(&kept.trace));
        assert_eq!(stored.in_memory(), 1);
    }
    assert!(KeptTraces::stored(folder.path(), "a", &hashes("0".repeat(64))).is_err());
    let stored = KeptTraces::stored(folder.path(), "a", &sound).unwrap();
    fs::write(&path, "no Parquet").unwrap();
    assert_eq!((stored.owned_by(&first.owner).count(), stored.damage().is_err()), (0, true));
}

#[test]
fn traces_are_written_and_read_group_by_group() {
    let kept = kept(40);
    let keys = keys();
    let written = |most: usize| in_groups(&kept, most);
    assert!(written(GROUP_VALUES) == to_parquet(table::traces(&kept, &keys, None)));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.traces.parquet");
    let mut sizes = Vec::new();
    for most in [1, 7, 50, GROUP_VALUES] {
        fs::write(&path, written(most)).unwrap();
        let mut reader = TraceReader::open(&path).unwrap();
        assert!(reader.has_trials().unwrap());
        for (place, own) in kept.iter().enumerate() {
            assert_eq!(reader.peek().unwrap(), Some(own), "{place} of groups of {most}");
            assert_eq!(reader.take().as_ref(), Some(own));
        }
        assert_eq!(reader.peek().unwrap(), None);
        sizes.push(written(most).len());
    }
    assert!(sizes.is_sorted_by(|one, other| one > other), "groups are not what was written: {sizes:?}");
}

#[test]
fn a_cell_begins_no_formula_at_any_separator_of_a_spreadsheet() {
    for (text, cell) in [
        ("=1+1", "'=1+1"),
        ("＝1+1", "'＝1+1"),
        ("\t=1", "'\t'=1"),
        ("\r-1", "\"'\r'-1\""),
        ("a;@SUM(A1)", "a;'@SUM(A1)"),
        ("a;\"=1", "\"a;\"\"'=1\""),
        ("a\n+1", "\"a\n'+1\""),
        ("a\",\"=1", "\"a\"\",\"\"=1\""),
        ("A*-b=c", "A*-b=c"),
        ("weights 1; 2", "weights 1; 2"),
    ] {
        assert_eq!(quoted(text), cell, "{text:?}");
    }
}

#[test]
fn staged_files_are_all_put_in_place_or_none_is() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    write_whole(&at("a"), b"old").unwrap();
    fs::create_dir(at("c")).unwrap();
    let mut staged = Staged::default();
    staged.add(&at("a"), b"new").unwrap();
    staged.add(&at("b"), b"new").unwrap();
    let error = staged.add(&at("c"), b"new").unwrap_err().to_string();
    assert!(error.ends_with("c: writing the file: is a directory"), "{error}");
    drop(staged);
    let names = || {
        let mut names: Vec<_> =
            fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    assert_eq!((fs::read(at("a")).unwrap(), names()), (b"old".to_vec(), vec!["a".into(), "c".into()]));
    fs::write(at("s.trials.parquet.77.tmp"), b"half").unwrap();
    fs::write(at("other.77.tmp"), b"half").unwrap();
    remove_temporaries(folder.path(), "s");
    assert_eq!(names(), ["a", "c", "other.77.tmp"]);
}
