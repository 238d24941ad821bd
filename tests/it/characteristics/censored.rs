//! Trials that did not come to an end: what they would have given decides, so nothing is decided unless it does not matter.

use super::synthetic::End::{At, NoPath, Rejected, Spent};
use super::synthetic::{End, Made, SWEEP, Sample, Synthetic};
use replan::analysis::verdict::ClaimVerdict;

/// The outcome of a claim by `criterion` after `records`.
fn class(criterion: &str, settings: &str, made: Made, records: Sample) -> &'static str {
    judged(criterion, settings, made, records).outcome.name()
}

/// How many instances our number rests on.
fn instances(criterion: &str, settings: &str, records: Sample) -> usize {
    judged(criterion, settings, Made::Plainly, records).findings[0].ours.as_ref().unwrap().n
}

/// What is found of a claim by `criterion` after `records`.
pub fn judged(criterion: &str, settings: &str, made: Made, records: Sample) -> ClaimVerdict {
    let selection = "study = \"drawn\", problems = [\"map\"]";
    let settings = settings.replace("OF", selection);
    let cells = ["low", "high"]
        .map(|id| format!("[[claim]]\nid = \"{id}\"\nat = \"here\"\nprinted = \"7\"\nuntestable = \"it\"\n"));
    let claim = format!(
        "[[claim]]\nid = \"asked\"\nat = \"here\"\nprinted = \"0\"\n[claim.check.{criterion}]\n{settings}\n{}",
        cells.concat()
    );
    Synthetic::new(&claim, made).judgement(records.records(), &[])
}

/// An instance for each of these pairs of ends of A and B.
pub fn pairs(all: &[(usize, End, End)]) -> Sample {
    let mut sample = Sample::default();
    for (count, own, other) in all {
        for _ in 0..*count {
            sample.instance();
            sample.trial("A", *own);
            sample.trial("B", *other);
        }
    }
    sample
}

#[test]
fn budgets_that_are_spent_do_not_make_a_median_infinite() {
    let class_after = |all: &[(usize, End, End)]| {
        let settings = "select = { OF, metric = \"path_cost_cells\" }\nlower = \"A\"\nhigher = [\"B\"]";
        class("least_of", settings, Made::Plainly, pairs(all))
    };
    let rest = (9, At(50.0), At(100.0));
    assert_eq!(class_after(&[(30, NoPath, At(100.0)), rest]), "contradicted");
    assert_eq!(class_after(&[(30, Spent, At(100.0)), rest]), "open");
    assert_eq!(class_after(&[(30, At(50.0), Spent), rest]), "open", "nor does it count for a claim");
    assert_eq!(class_after(&[(2, Spent, At(100.0)), rest, rest]), "holds", "whatever they would have given");
    assert_eq!(class_after(&[(2, Spent, At(50.0)), (20, At(100.0), At(50.0))]), "contradicted");
}

#[test]
fn along_a_sweep_what_did_not_end_might_have_been_solved() {
    let class_after = |own: End, other: End| {
        let mut sample = Sample::default();
        for _ in 0..12 {
            sample.instance();
            for (query, value) in (0..5).flat_map(|query| SWEEP.map(|value| (query, value))) {
                sample.query("A", Some(query), Some(value), if query == 0 { At(1.0) } else { own });
                sample.query("B", Some(query), Some(value), if query == 0 { At(1.0) } else { other });
            }
        }
        let settings = "is = \"higher\"\nselect = { OF, contender = \"A\", against = \"B\" }";
        class("lower", settings, Made::Swept, sample)
    };
    assert_eq!([class_after(At(1.0), NoPath), class_after(NoPath, At(1.0))], ["holds", "contradicted"]);
    assert_eq!([class_after(At(1.0), Spent), class_after(Spent, At(1.0))], ["open"; 2]);
}

#[test]
fn a_statistic_of_one_contender_hangs_on_what_did_not_end() {
    let within = |statistic: &str, accepted: &str, all: &[(usize, End)]| {
        let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
        let settings = format!("{selection}\nstatistic = \"{statistic}\"\naccepted = {accepted}");
        let all: Vec<_> = all.iter().map(|(count, end)| (*count, *end, At(1.0))).collect();
        class("within", &settings, Made::Plainly, pairs(&all))
    };
    let some = (15, At(90.0));
    let others = (15, At(110.0));
    for (statistic, accepted) in [("mean", "[90.0, 110.0]"), ("deviation", "[5.0, 15.0]")] {
        assert_eq!(within(statistic, accepted, &[some, others]), "holds", "{statistic}");
        assert_eq!(within(statistic, accepted, &[some, others, (1, Spent)]), "open", "{statistic}");
    }
    let median = |spent| within("median", "[80.0, 120.0]", &[some, others, (spent, Spent)]);
    assert_eq!([median(0), median(2), median(20)], ["holds", "holds", "open"]);
    // Below or above: neither is within what is accepted, and what lies between may be.
    let far = |spent| within("mean", "[100.0, 120.0]", &[(30, At(90.0)), (spent, Spent)]);
    assert_eq!([far(0), far(5)], ["contradicted", "open"]);
    assert_eq!(within("mean", "[0.0, 40.0]", &[some, others, (1, Spent)]), "contradicted");
}

#[test]
fn a_side_that_did_not_end_might_have_been_the_better_one() {
    let class_after =
        |criterion: &str, settings: &str, usual: (usize, End, End), other: (usize, End, End)| {
            let selection =
                "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
            class(criterion, &format!("{selection}\n{settings}"), Made::Plainly, pairs(&[usual, other]))
        };
    let less = (30, At(50.0), At(100.0));
    let more = (30, At(100.0), At(50.0));
    for (end, class) in [(NoPath, "holds"), (Spent, "open")] {
        let own = (40, end, At(50.0));
        let other = (3, At(50.0), end);
        assert_eq!(class_after("lower", "is = \"lower\"", less, other), class, "the other one: {end:?}");
        assert_eq!(class_after("lower", "is = \"higher\"", more, own), class, "its own: {end:?}");
        let ratio = class_after("within", "statistic = \"ratio\"\naccepted = [0.0, 0.7]", less, other);
        assert_eq!(ratio, class, "{end:?}");
    }
}

#[test]
fn a_ratio_of_two_groups_hangs_on_what_did_not_end() {
    let ratio = |spent: usize| {
        let mut sample = Sample::default();
        for (group, value) in [("map", 100.0), ("other", 50.0)] {
            for instance in 0..30 {
                sample.instance_on(group);
                sample.trial("A", if instance < spent { Spent } else { At(value) });
            }
        }
        let selection = "select = { study = \"drawn\", problems = [\"map\", \"other\"], contender = \"A\", metric = \"path_cost_cells\" }";
        let settings = format!("{selection}\nstatistic = \"ratio_of_groups\"\naccepted = [1.5, 2.5]");
        class("within", &settings, Made::Plainly, sample)
    };
    assert_eq!([ratio(0), ratio(2), ratio(20)], ["holds", "holds", "open"]);
}

#[test]
fn equal_cases_and_one_that_did_not_end_are_no_counterexample() {
    let class_after = |all: &[(usize, End, End)]| {
        let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
        class("on_every", &format!("{selection}\nthat = \"lower\""), Made::Plainly, pairs(all))
    };
    let equal = (10, At(5.0), At(5.0));
    let cut = (1, Spent, At(5.0));
    let broken = (1, At(6.0), At(5.0));
    assert_eq!([class_after(&[equal]), class_after(&[equal, broken, cut])], ["contradicted"; 2]);
    assert_eq!(
        [class_after(&[equal, cut]), class_after(&[(9, At(5.0), At(5.0))])],
        ["open"; 2],
        "so few equal cases may be chance"
    );
}

#[test]
fn what_is_wrong_is_wrong_however_many_others_did_not_end() {
    let class_after = |all: &[(usize, End, End)]| {
        let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
        class("equals", selection, Made::Plainly, pairs(all))
    };
    let same = (12, At(5.0), At(5.0));
    let cut = (2, Spent, At(5.0));
    let wrong = (1, At(6.0), At(5.0));
    assert_eq!([class_after(&[same]), class_after(&[same, cut])], ["holds", "open"]);
    assert_eq!([class_after(&[same, wrong]), class_after(&[same, wrong, cut])], ["contradicted"; 2]);
}

#[test]
fn a_claim_about_cases_that_both_solve_hangs_on_what_did_not_end_and_says_what_is_outside_of_it() {
    let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
    for (criterion, settings, case) in [
        ("share", "hits = \"lower\"\naccepted = [0.9, 1.0]", (40, At(4.0), At(5.0))),
        ("share", "hits = \"lower_throughout\"\naccepted = [0.9, 1.0]", (40, At(4.0), At(5.0))),
        ("on_every", "that = \"lower\"", (40, At(4.0), At(5.0))),
        ("on_every", "that = \"at_most_times\"\nbound = 2.0", (40, At(4.0), At(5.0))),
        ("equals", "", (40, At(5.0), At(5.0))),
    ] {
        let found = |more: (usize, End, End)| {
            let one =
                judged(criterion, &format!("{selection}\n{settings}"), Made::Plainly, pairs(&[case, more]));
            (one.outcome.name(), one.findings[0].because.join("; "))
        };
        let name = format!("{criterion}: {settings}");
        let ended = [(9, NoPath, NoPath), (9, Rejected, At(5.0)), (9, NoPath, At(5.0)), (9, At(4.0), NoPath)];
        let half_ended = [(9, Spent, NoPath), (9, NoPath, Spent), (9, Spent, Rejected)];
        for lost in ended.into_iter().chain(half_ended) {
            let (outcome, because) = found(lost);
            assert_eq!(outcome, "holds", "{name}: {lost:?}");
            let expected = "9 more cases are outside of the claim: not solved by both";
            assert!(because.contains(expected), "{name}: {lost:?}: {because}");
        }
        let (outcome, because) = found((9, Spent, Spent));
        assert!(outcome == "open" && !because.contains("outside"), "{name}: {because}");
    }
    let above = |more: End| {
        let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
        let settings = format!("{selection}\nhits = \"above\"\nbound = 3.0\naccepted = [0.9, 1.0]");
        class("share", &settings, Made::Plainly, pairs(&[(40, At(4.0), At(1.0)), (9, more, At(1.0))]))
    };
    assert_eq!([above(NoPath), above(Rejected), above(Spent)], ["holds", "holds", "open"]);
}

#[test]
fn the_share_of_failures_that_another_cures_counts_failures_alone_and_hangs_on_what_did_not_end() {
    let class_after = |more: (usize, End, End)| {
        let settings =
            "select = { OF, contender = \"A\", against = \"B\" }\nhits = \"cured\"\naccepted = [0.7, 0.9]";
        let failures = [(80, At(4.0), NoPath), (20, NoPath, Rejected)];
        class("share", settings, Made::Plainly, pairs(&[failures[0], failures[1], more]))
    };
    for solved in [(90, At(4.0), At(5.0)), (90, NoPath, At(5.0)), (90, Spent, At(5.0))] {
        assert_eq!(class_after(solved), "holds", "{solved:?}: what the other solves is none of its failures");
    }
    assert_eq!(
        [
            class_after((90, NoPath, NoPath)),
            class_after((90, Spent, NoPath)),
            class_after((90, At(4.0), Spent))
        ],
        ["contradicted", "open", "open"]
    );
}

#[test]
fn one_contender_solves_more_throughout_only_where_it_does_at_every_point_of_the_sweep() {
    let class_after = |hits: &str, last: End| {
        let mut sample = Sample::default();
        for _ in 0..40 {
            sample.instance();
            for value in SWEEP {
                for query in 0..2 {
                    let is_last = value == SWEEP[SWEEP.len() - 1];
                    sample.query("A", Some(query), Some(value), if is_last { last } else { At(1.0) });
                    sample.query(
                        "B",
                        Some(query),
                        Some(value),
                        if is_last && query == 0 { At(1.0) } else { NoPath },
                    );
                }
            }
        }
        let settings = format!(
            "select = {{ OF, contender = \"A\", against = \"B\" }}\nhits = \"{hits}\"\naccepted = [0.8, 1.0]"
        );
        class("share", &settings, Made::Swept, sample)
    };
    let throughout = |last: End| class_after("solved_more_throughout", last);
    assert_eq!(
        [throughout(At(1.0)), throughout(NoPath), throughout(Spent)],
        ["holds", "contradicted", "open"]
    );
    assert_eq!(class_after("solved_more", NoPath), "holds", "over all points together it does");
}

#[test]
fn an_instance_solves_at_least_a_share_of_its_queries_unless_that_hangs_on_what_did_not_end() {
    let of = |last: End| {
        let mut sample = Sample::default();
        for _ in 0..40 {
            sample.instance();
            for query in 0..5 {
                sample.query("A", Some(query), None, if query == 0 { last } else { At(1.0) });
            }
        }
        let settings = "select = { OF, contender = \"A\" }\nhits = \"solved_at_least\"\nbound = 0.9\naccepted = [0.8, 1.0]";
        class("share", settings, Made::Plainly, sample)
    };
    assert_eq!([of(At(1.0)), of(NoPath), of(Spent)], ["holds", "contradicted", "open"]);
}

#[test]
fn a_row_of_numbers_and_a_trend_hang_on_what_did_not_end() {
    let drawn = |spent: usize| {
        let mut sample = Sample::default();
        for instance in 0..60 {
            sample.instance();
            sample.trial("A", At(7.0 + f64::from(instance % 7 - 3)));
            sample.with("optimal_cost_cells", f64::from(instance % 7));
        }
        for _ in 0..spent {
            sample.instance();
            sample.trial("A", Spent);
        }
        sample
    };
    let selection = "select = { OF, metric = \"path_cost_cells\" }";
    let rows =
        "[{ contender = \"A\", statistics = [\"least\", \"greatest\"], claims = [\"low\", \"high\"] }]";
    let row = |spent| {
        class(
            "row_one_instance",
            &format!("{selection}\nrows = {rows}\nrefused_below = 0.05"),
            Made::Plainly,
            drawn(spent),
        )
    };
    assert_eq!([row(0), row(1)], ["holds", "open"]);
    let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
    let trend = |spent| {
        let settings = format!("{selection}\nover = \"optimal_cost_cells\"\nrising = true");
        class("trend", &settings, Made::Plainly, drawn(spent))
    };
    assert_eq!([trend(0), trend(1)], ["holds", "open"], "nor is it known where along it");
}

#[test]
fn a_trend_over_cases_that_both_solve_does_not_hang_on_one_that_a_side_cannot_solve() {
    let trend = |other: End| {
        let mut sample = Sample::default();
        for instance in 0..60 {
            let place = f64::from(instance % 7);
            sample.instance();
            sample.trial("A", At(7.0 + place));
            sample.with("optimal_cost_cells", place);
            sample.trial("B", At(20.0));
        }
        sample.instance();
        sample.trial("A", Spent);
        sample.trial("B", other);
        let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
        let settings = format!("{selection}\nover = \"optimal_cost_cells\"\nrising = false");
        class("trend", &settings, Made::Plainly, sample)
    };
    assert_eq!([trend(NoPath), trend(Rejected), trend(At(20.0))], ["holds", "holds", "open"]);
}

#[test]
fn rows_of_one_instance_are_joined_by_the_instance() {
    // Of every second instance one row lacks a number: joined by their order the two would seem apart.
    let mut sample = Sample::default();
    for instance in 0..120 {
        sample.instance();
        let cost = 7.0 + f64::from(instance % 11 - 5);
        sample.trial("A", if instance % 2 == 0 { At(cost) } else { NoPath });
        sample.trial("B", if instance % 3 == 0 { NoPath } else { At(cost) });
    }
    let row = |label: &str, claim: &str| {
        format!("{{ contender = \"{label}\", statistics = [\"mean\"], claims = [\"{claim}\"] }}")
    };
    let rows = format!("rows = [{}, {}]\nrefused_below = 0.05", row("A", "low"), row("B", "high"));
    let settings = format!("select = {{ OF, metric = \"path_cost_cells\" }}\n{rows}");
    let both = instances("row_one_instance", &settings, sample);
    assert_eq!(both, 40, "instances that have both: neither odd nor a multiple of 3");
}

#[test]
fn one_instance_of_what_was_drawn_is_one_of_many() {
    let least = |instances: usize| {
        let settings = "select = { OF, metric = \"path_cost_cells\" }\nlower = \"A\"\nhigher = [\"B\"]";
        class("least_of", settings, Made::Plainly, pairs(&[(instances, At(5.0), At(10.0))]))
    };
    assert_eq!([least(1), least(3), least(4)], ["open", "open", "holds"]);
    let ratio = |instances: [usize; 2]| {
        let mut sample = Sample::default();
        for (group, count, value) in [("map", instances[0], 100.0), ("other", instances[1], 50.0)] {
            for _ in 0..count {
                sample.instance_on(group);
                sample.trial("A", At(value));
            }
        }
        let selection = "select = { study = \"drawn\", problems = [\"map\", \"other\"], contender = \"A\", metric = \"path_cost_cells\" }";
        class(
            "within",
            &format!("{selection}\nstatistic = \"ratio_of_groups\"\naccepted = [0.1, 9.0]"),
            Made::Plainly,
            sample,
        )
    };
    assert_eq!([ratio([1, 1]), ratio([1, 30]), ratio([30, 9])], ["open"; 3]);
    assert_eq!(ratio([30, 10]), "holds");
}

#[test]
fn what_did_not_end_might_have_had_marks() {
    let class = |hits: &str, spent: u32| {
        let mut sample = Sample::default();
        for instance in 0..100 {
            sample.instance();
            sample.trial("A", if instance < spent { Spent } else { At(1.0) });
            if instance >= spent {
                sample.with("optimal_cost_cells", 0.0);
                sample.with("expansions", 1.0);
            }
        }
        let selection = "select = { OF, contender = \"A\" }";
        let settings = format!("{selection}\nhits = {hits}\naccepted = [0.0, 0.1]");
        class("share", &settings, Made::Plainly, sample)
    };
    let marked = "\"marked\"\ncolumns = [\"optimal_cost_cells\"]";
    let events = "\"events\"\ncolumns = [\"optimal_cost_cells\"]\nper = \"expansions\"";
    assert_eq!([class(marked, 0), class(marked, 1), class(marked, 50)], ["holds", "holds", "open"]);
    assert_eq!([class(events, 0), class(events, 1)], ["holds", "open"]);
}

#[test]
fn what_did_not_end_is_neither_solved_nor_not() {
    let class_after = |all: &[(usize, End, End)]| {
        let selection = "select = { OF, contender = \"A\", against = \"B\" }";
        class("on_every", &format!("{selection}\nthat = \"solved\""), Made::Plainly, pairs(all))
    };
    let both = (20, At(1.0), At(1.0));
    assert_eq!([class_after(&[both]), class_after(&[both, (1, NoPath, At(1.0))])], ["holds", "contradicted"]);
    assert_eq!(class_after(&[both, (5, Spent, At(1.0))]), "open", "it might have been solved");
    assert_eq!(class_after(&[both, (5, NoPath, Spent)]), "open", "the other might have solved it");
    assert_eq!(class_after(&[both, (5, At(1.0), Spent)]), "holds", "whatever the other would have done");
}

#[test]
fn instances_that_might_have_been_whole_are_not_forgotten() {
    let pair = |one: End, other: End| {
        let mut sample = Sample::default();
        for instance in 0..40 {
            sample.instance();
            sample.query("A", Some(0), None, if instance == 0 { other } else { At(1.0) });
            sample.query("A", Some(1), None, if instance == 0 { one } else { At(1.0) });
        }
        let selection =
            "select = { OF, contender = \"A\", metric = \"path_cost_cells\", whole_instances = true }";
        class(
            "within",
            &format!("{selection}\nstatistic = \"mean\"\naccepted = [0.0, 2.0]"),
            Made::Plainly,
            sample,
        )
    };
    let class_after = |lost: End| pair(lost, At(1.0));
    assert_eq!([class_after(At(1.0)), class_after(NoPath), class_after(Spent)], ["holds", "holds", "open"]);
    assert_eq!(pair(Spent, NoPath), "holds", "it could not have been whole");
}

#[test]
fn one_instance_of_which_a_query_did_not_end_may_give_any_number() {
    let class_after = |statistic: &str, lost: End| {
        let mut sample = Sample::default();
        for instance in 0..100 {
            sample.instance();
            sample.query("A", Some(0), None, At(40.0 + f64::from(instance % 5)));
            sample.query("A", Some(1), None, if lost.is_at() { At(42.0) } else { lost });
        }
        let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
        class("one_instance", &format!("{selection}\nstatistic = \"{statistic}\""), Made::Plainly, sample)
    };
    // What is printed, 0, lies below every instance: a greatest number that is not known is no lower.
    for (statistic, cut) in [("mean", "open"), ("least", "open"), ("greatest", "contradicted")] {
        assert_eq!(
            [class_after(statistic, At(1.0)), class_after(statistic, Spent)],
            ["contradicted", cut],
            "{statistic}"
        );
    }
}

#[test]
fn what_prints_alike_and_pairs_that_agree_hang_on_what_did_not_end() {
    let prints = |value: f64, lost: End| {
        let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
        class("prints_as", selection, Made::Plainly, pairs(&[(20, At(value), At(1.0)), (1, lost, At(1.0))]))
    };
    assert_eq!([prints(0.0, NoPath), prints(0.0, Spent)], ["holds", "open"]);
    assert_eq!([prints(9.0, NoPath), prints(9.0, Spent)], ["contradicted", "open"]);
    let ratio = |lost: End| {
        let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
        let settings = format!("{selection}\nstatistic = \"ratio\"\naccepted = [0.5, 1.5]");
        class("within", &settings, Made::Plainly, pairs(&[(40, At(5.0), At(5.0)), (40, lost, At(5.0))]))
    };
    assert_eq!([ratio(At(5.0)), ratio(Spent)], ["holds", "open"], "those that agree bound no others");
}

#[test]
fn what_holds_on_each_of_few_instances_of_a_problem_that_is_drawn_is_not_firm() {
    let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
    let prints = "select = { OF, contender = \"B\", metric = \"path_cost_cells\" }";
    for (criterion, settings) in [
        ("on_every", format!("{selection}\nthat = \"lower\"")),
        ("equals", selection.to_owned()),
        ("prints_as", prints.to_owned()),
    ] {
        let own = if criterion == "equals" { 0.0 } else { -1.0 };
        let class =
            |instances, made| class(criterion, &settings, made, pairs(&[(instances, At(own), At(0.0))]));
        let plainly = [1, 9, 10].map(|instances| class(instances, Made::Plainly));
        assert_eq!(plainly, ["open", "open", "holds"], "{criterion}");
        assert_eq!(class(1, Made::Searched), "attainable", "{criterion}");
    }
}

#[test]
fn seeds_on_a_problem_that_is_drawn_are_no_instances_of_it() {
    let mut sample = Sample::default();
    for instance in 0..12 {
        sample.instance();
        for seed in 0..30 {
            sample.seed("A", seed, At(f64::from(instance)));
        }
    }
    let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
    let settings = format!("{selection}\nstatistic = \"mean\"\naccepted = [0.0, 12.0]");
    assert_eq!(instances("within", &settings, sample), 12);
}

#[test]
fn a_contender_with_one_seed_stands_beside_each_seed_of_the_other() {
    let class_of = |many: &str, one: &str, [first, rest, other]: [f64; 3]| {
        let mut sample = Sample::default();
        for _ in 0..12 {
            sample.instance();
            sample.trial(one, At(other));
            for seed in 0..3 {
                sample.seed(many, seed, At(if seed == 0 { first } else { rest }));
            }
        }
        let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
        class("on_every", &format!("{selection}\nthat = \"lower\""), Made::Plainly, sample)
    };
    assert_eq!([class_of("A", "B", [1.0, 2.0, 5.0]), class_of("B", "A", [9.0, 8.0, 5.0])], ["holds"; 2]);
    // What the first seed alone would say is not what all say.
    let turned = [class_of("A", "B", [1.0, 9.0, 5.0]), class_of("B", "A", [9.0, 1.0, 5.0])];
    assert_eq!(turned, ["contradicted"; 2]);
}
