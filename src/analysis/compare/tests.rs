use super::*;
use base::seed;
use engine::planner::Value;
use rand::RngExt as _;
use std::sync::Arc;
use study::key::{InstanceKey, SweepKey, TrialKey};
use study::record::{Batch, PreprocessingRow, Values};
use study::store::Records;

fn manifest(seed: u64) -> Manifest {
    Manifest { study: "s".to_owned(), seed, interpretations: vec![Vec::new()], ..Manifest::default() }
}

/// A run of one contender on `group`, an instance a number; no path where there is none.
fn run(seed: u64, group: &str, contender: &str, expansions: &[Option<u64>]) -> StoredRun {
    let mut batch = Batch::default();
    for (instance, count) in (0..).zip(expansions) {
        let on = Arc::new(InstanceKey {
            group: group.into(),
            sweep: SweepKey::default(),
            instance,
            interpretation: InterpretationKey::default(),
        });
        let kind = String::new();
        let values = Values::default();
        let drawn = seed::derive(seed, &[&instance.to_string()]);
        batch.preprocessing.push(PreprocessingRow {
            key: on.clone(),
            kind,
            seed: drawn,
            reason: None,
            values,
        });
        let values = count.map(|count| ("expansions", Value::Count(count))).into_iter().collect();
        let status = if count.is_some() { Status::Solved } else { Status::BudgetSpent };
        let key =
            TrialKey { on, query: None, contender: contender.into(), sweep: SweepKey::default(), repeat: 0 };
        batch.rows.push(Row { key, seed: Some(0), status, reason: None, values });
    }
    let records = Records { batch, times: Vec::new() };
    StoredRun {
        name: format!("run-{seed}"),
        studies: BTreeMap::from([("s".to_owned(), (manifest(seed), records))]),
    }
}

/// What `instances` maps cost, the second run's `percent` more of it and 5 % to and fro.
fn costs(instances: usize, percent: f64) -> [Vec<Option<u64>>; 2] {
    let stream = &mut seed::stream(seed::derive(11, &["costs"]));
    let of_map = |_| {
        let base: f64 = 1000.0 + 4000.0 * stream.random::<f64>();
        let other = base * (1.0 + percent / 100.0) * (1.0 + 0.1 * (stream.random::<f64>() - 0.5));
        (Some(base as u64), Some(other as u64))
    };
    let (first, second) = (0..instances).map(of_map).unzip();
    [first, second]
}

fn compared(runs: &[StoredRun; 2], gates: &[&str]) -> Comparison {
    let gates = gates.iter().map(|text| Gate::parse(text).unwrap()).collect();
    compare(&Sides::Runs([&runs[0], &runs[1]]), &CompareOptions { gates, ..CompareOptions::default() })
        .unwrap()
}

fn change<'c>(of: &'c Comparison, metric: &str) -> &'c Change {
    of.changes.iter().find(|change| change.metric == metric).unwrap()
}

#[test]
fn a_planner_made_worse_is_caught_and_an_equal_one_passes() {
    for (percent, outcome, word) in [(8.0, Outcome::Worse, Word::Worse), (0.0, Outcome::NotWorse, Word::Open)]
    {
        let [first, second] = costs(60, percent);
        let found = compared(&[run(1, "g", "A", &first), run(1, "g", "A", &second)], &["expansions +2%"]);
        assert_eq!(found.gates[0].outcome, outcome, "{percent} %: {:?}", found.gates);
        let change = change(&found, "expansions");
        assert_eq!((change.word, change.pairs, change.instances), (word, 60, 60));
        let measured = change.mean_change_percent.unwrap();
        let [low, high] = measured.interval.unwrap();
        assert!(low < percent && percent < high && high - low < 3.0, "{measured:?}");
        assert!(found.notes.is_empty() && found.only.is_empty(), "{:?}", found.notes);
    }
}

#[test]
fn what_is_the_same_is_equal_and_no_gate_speaks_of_few_instances() {
    let costs: Vec<Option<u64>> = (0..8).map(|instance| Some(10 + instance)).collect();
    let found = compared(&[run(1, "g", "A", &costs), run(1, "g", "A", &costs)], &["expansions +0%"]);
    let change = change(&found, "expansions");
    assert_eq!((change.word, change.wins, change.ties, change.losses), (Word::Equal, 0, 8, 0));
    assert_eq!(change.improvement_percent.unwrap(), Measured { value: 50.0, interval: Some([50.0, 50.0]) });
    assert_eq!((found.gates[0].outcome, found.gates[0].more_instances), (Outcome::CannotTell, Some(2)));
}

#[test]
fn a_problem_that_is_lost_is_a_loss_and_keeps_a_gate_open() {
    let first: Vec<Option<u64>> = (0..30).map(|instance| Some(100 + instance)).collect();
    let faster = |instance: usize, cost: &Option<u64>| cost.filter(|_| instance >= 18).map(|cost| cost - 50);
    let second: Vec<Option<u64>> =
        first.iter().enumerate().map(|(instance, cost)| faster(instance, cost)).collect();
    let found =
        compared(&[run(1, "g", "A", &first), run(1, "g", "A", &second)], &["expansions +2%", "solved -1%"]);
    let solved = &found.solved[0];
    assert_eq!((solved.both, solved.first_only, solved.second_only, solved.neither), (12, 18, 0, 0));
    assert_eq!(solved.lost.as_deref(), Some("s/g/0/a"));
    let expansions = change(&found, "expansions");
    assert_eq!((expansions.wins, expansions.losses, expansions.one_sided), (12, 18, [18, 0]));
    assert_eq!(expansions.mean_change.unwrap().value, -50.0, "of those that both solve");
    assert_eq!(expansions.median_change.unwrap().value, f64::INFINITY, "most are lost");
    assert_eq!(change(&found, SOLVED).mean_change.unwrap().value, -60.0, "points");
    let outcomes: Vec<Outcome> = found.gates.iter().map(|gate| gate.outcome).collect();
    assert_eq!(outcomes, [Outcome::CannotTell, Outcome::Worse]);
    assert!(found.gates[0].level > 0.974 && found.gates[0].level < 0.976, "two lines are looked at together");
}

#[test]
fn what_only_one_side_has_is_listed_apart() {
    let costs: Vec<Option<u64>> = (0..20).map(|instance| Some(10 + instance)).collect();
    let only_on = |runs: &[StoredRun; 2]| -> Vec<(usize, String, usize)> {
        compared(runs, &[]).only.into_iter().map(|only| (only.side, only.what, only.trials)).collect()
    };
    let base = || run(1, "g", "A", &costs);
    let other = |side, what: &str, trials| (side, what.to_owned(), trials);
    let b = run(1, "g", "B", &costs);
    assert_eq!(only_on(&[base(), b]), [other(0, "contender `A`", 20), other(1, "contender `B`", 20)]);
    let h = run(1, "h", "A", &costs);
    assert_eq!(only_on(&[base(), h]), [other(0, "problem group `g`", 20), other(1, "problem group `h`", 20)]);
    let fewer = run(1, "g", "A", &costs[..12]);
    assert_eq!(only_on(&[base(), fewer]), [other(0, "instances, queries, sweep points or seeds of `A`", 8)]);
    let mut gone = run(1, "g", "A", &costs);
    gone.studies = BTreeMap::from([("t".to_owned(), gone.studies.remove("s").unwrap())]);
    assert_eq!(only_on(&[base(), gone]), [other(0, "the study", 20), other(1, "the study", 20)]);
}

#[test]
fn runs_of_other_seeds_are_compared_and_said_to_be() {
    let [first, second] = costs(40, 0.0);
    let found = compared(&[run(1, "g", "A", &first), run(2, "g", "A", &second)], &[]);
    assert_eq!(change(&found, "expansions").pairs, 40);
    assert!(
        found.notes[0].starts_with("s: 80 of 80 pairs") || found.notes[0].starts_with("s: 40 of 40 pairs"),
        "{:?}",
        found.notes
    );
    assert!(found.notes[0].contains("other seeds (the runs' are 1 and 2)"), "{:?}", found.notes);
}

#[test]
fn two_contenders_of_one_run_are_paired_instance_by_instance() {
    let [first, second] = costs(40, 20.0);
    let mut both = run(1, "g", "A", &first);
    let b = run(1, "g", "B", &second).studies.remove("s").unwrap();
    both.studies.get_mut("s").unwrap().1.batch.rows.extend(b.1.batch.rows);
    let found = compare(&Sides::Contenders(&both, ["A", "B"]), &CompareOptions::default()).unwrap();
    let change = change(&found, "expansions");
    assert_eq!((change.contender.as_str(), change.word, change.losses), ("B against A", Word::Worse, 40));
    let error = compare(&Sides::Contenders(&both, ["A", "C"]), &CompareOptions::default()).unwrap_err();
    assert_eq!(error, "--contenders: there is no stored trial of a contender `C`; there are A, B");
}

#[test]
fn cells_hold_failures_in_their_medians_alone() {
    let costs: Vec<Option<u64>> = (0..21).map(|instance| (instance < 12).then_some(10 + instance)).collect();
    let cells = cells(&run(1, "g", "A", &costs));
    let cell = cells.iter().find(|cell| cell.metric == "expansions").unwrap();
    assert_eq!((cell.trials, cell.solved, cell.instances, cell.measured), (21, 12, 21, 12));
    assert_eq!((cell.mean.unwrap().value, cell.median.unwrap().value), (15.5, 20.0));
    assert_eq!(cell.median.unwrap().interval.unwrap()[1], f64::INFINITY);
}
