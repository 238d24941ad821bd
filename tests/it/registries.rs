//! Holds every registry to its folder: each file with an entry is registered under its own name, in order.

use crate::source::{File, files};
use engine::planner;
use replan::analysis::{criterion, metric, rule};
use replan::render::figure;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use study::paper::{Claim, Paper, TestRole};
use study::{column, family, planner as outside, preprocessing, task};

/// A registry as tests see it: its folder below `src`, the names it lists, and the names that its `find` gives back.
struct Registry {
    folder: &'static str,
    names: Vec<&'static str>,
    found: Vec<Option<&'static str>>,
}

macro_rules! registry {
    ($folder:literal, $module:ident) => {{
        let names: Vec<&'static str> = $module::REGISTRY.iter().map(|entry| entry.name).collect();
        let found = names.iter().map(|name| $module::find(name).map(|entry| entry.name)).collect();
        assert!($module::find("no such thing").is_none());
        Registry { folder: $folder, names, found }
    }};
}

fn registries() -> Vec<Registry> {
    vec![
        registry!("engine/planner", planner),
        registry!("study/family", family),
        registry!("study/planner", outside),
        registry!("study/preprocessing", preprocessing),
        registry!("study/task", task),
        registry!("analysis/criterion", criterion),
        registry!("analysis/rule", rule),
        registry!("render/figure", figure),
    ]
}

/// Its package, unless that is the root, and its modules.
fn place(file: &File) -> String {
    let package = Some(file.package().to_owned()).filter(|package| package != "replan");
    package.into_iter().chain(file.modules()).collect::<Vec<_>>().join("/")
}

#[test]
fn every_file_with_an_entry_is_registered_under_its_own_name_and_nothing_else_is() {
    let files = files();
    for Registry { folder, names, .. } in registries() {
        let in_folder: Vec<String> = files
            .iter()
            .filter(|file| file.code.contains("pub static ENTRY: Entry"))
            .filter_map(|file| place(file).strip_prefix(&format!("{folder}/")).map(str::to_owned))
            .collect();
        assert_eq!(names, in_folder, "{folder}: the registry, then the files with an entry");
    }
}

#[test]
fn registries_are_in_order_and_every_entry_is_found_by_its_name() {
    for Registry { folder, names, found } in registries() {
        assert!(!names.is_empty(), "{folder} is empty");
        assert!(names.windows(2).all(|pair| pair[0] < pair[1]), "{folder}: {names:?}");
        assert_eq!(found, names.iter().copied().map(Some).collect::<Vec<_>>(), "{folder}");
    }
}

#[test]
fn no_entry_lies_outside_a_registry() {
    let folders: Vec<&str> = registries().iter().map(|registry| registry.folder).collect();
    // The audit holds its own.
    let files = files();
    for file in files.iter().filter(|file| file.package() != "audit" && file.code.contains("static ENTRY")) {
        let place = place(file);
        let folder = place.rsplit_once('/').map_or("", |(folder, _)| folder);
        assert!(folders.contains(&folder), "{}: no registry is known there", file.path.display());
    }
}

#[test]
fn a_column_and_a_metric_mean_one_thing_each() {
    let columns: Vec<&str> = column::COLUMNS.iter().map(|column| column.name).collect();
    let metrics: Vec<&str> = metric::METRICS.iter().map(|metric| metric.name).collect();
    for (what, names) in [("column", columns), ("metric", metrics)] {
        let distinct: BTreeSet<&str> = names.iter().copied().collect();
        let twice: Vec<&&str> =
            distinct.iter().filter(|n| names.iter().filter(|m| m == n).count() > 1).collect();
        assert!(names.len() > 20 || what == "metric", "{} columns", names.len());
        assert!(twice.is_empty(), "{what} {twice:?} stands twice");
    }
}

#[test]
fn what_stands_below_a_figure_says_of_how_many() {
    for entry in replan::render::figure::REGISTRY {
        let says = |what: &str| entry.statistic.contains(what);
        // Of every pair found, the panels' titles say how many there are.
        let is_reported = says("{n}")
            || says("{interpretations}")
            || entry.statistic.starts_with("One ")
            || entry.statistic.starts_with("Single trials")
            || says("Every pair");
        assert!(is_reported, "{}: {}", entry.name, entry.statistic);
        let words = entry.statistic.split_whitespace().count();
        assert!(
            words <= 20,
            "{}: {words} words leave a caption little room: {}",
            entry.name,
            entry.statistic
        );
    }
}

/// The criteria that decide and the rules of every committed paper, with how many claims have each.
fn used_criteria() -> BTreeMap<String, usize> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut used = BTreeMap::new();
    for name in crate::paper::committed() {
        let folder = root.join("experiments").join(name);
        let inputs = study::Inputs::below(vec![folder.clone(), root.to_owned()]);
        let paper = Paper::load(&folder, &inputs).unwrap();
        for (how, name, _) in paper.claims.iter().flat_map(Claim::tests) {
            *used.entry(name.to_owned()).or_default() += usize::from(how != TestRole::Shown);
        }
    }
    used
}

#[test]
fn criteria_and_kinds_of_figure_stay_few() {
    assert!(criterion::REGISTRY.len() <= 13, "{} criteria", criterion::REGISTRY.len());
    assert!(figure::REGISTRY.len() <= 9, "{} kinds of figure", figure::REGISTRY.len());
}

#[test]
fn no_criterion_or_rule_serves_one_claim_alone() {
    let used = used_criteria();
    assert!(used.values().sum::<usize>() > 200, "the papers' claims are not found: {used:?}");
    let names = criterion::REGISTRY.iter().chain(rule::REGISTRY).map(|entry| entry.name);
    let few: Vec<&str> = names.filter(|name| used.get(*name).is_none_or(|claims| *claims < 2)).collect();
    assert!(few.is_empty(), "asked by fewer than two claims of the committed papers: {few:?}");
}

#[test]
fn the_second_judge_knows_the_families_in_which_something_is_drawn() {
    let text = std::fs::read_to_string("crosscheck/statistics_judge/selection.py").unwrap();
    let (_, from) = text.split_once("DRAWN = frozenset(").unwrap();
    let (listed, _) = from.split_once(')').unwrap();
    let known: Vec<&str> = listed.split('"').skip(1).step_by(2).collect();
    let drawn = study::family::REGISTRY.iter().filter(|entry| entry.is_drawn).map(|entry| entry.name);
    assert_eq!(known, drawn.collect::<Vec<_>>());
}

#[test]
fn every_column_is_a_metric_unless_a_clock_gives_it() {
    let is_clock = |name: &str| name.ends_with("_wall_ns");
    let (clocks, others): (Vec<&str>, Vec<&str>) =
        column::COLUMNS.iter().map(|column| column.name).partition(|name| is_clock(name));
    let lost: Vec<&&str> = others.iter().filter(|name| metric::find(name).is_none()).collect();
    assert!(lost.is_empty() && others.len() > 50, "{lost:?} of {}", others.len());
    assert!(clocks.iter().all(|name| metric::find(name).is_none()), "{clocks:?}");
}
