use super::*;
use crate::analysis::effect::{mean, solved_by_all};
use crate::analysis::metric;
use crate::study::record::Status;

/// Crowded maps, some without a path; a clock; a line of sight; a contender under a reading of its own.
fn crowded() -> String {
    STUDY
        .replace("blocked_share = 0.2,", "blocked_share = 0.45,")
        .replace("[explore]", "[timing]\nproblems = 12\nrepeats = 2\n[explore]")
        + "
[[contender]]
label = 'Tidied'
planner = 'astar'
settings = { weight = 1, ties = 'fifo' }
then = [{ stage = 'delete_inflections', settings = { line_of_sight = 'exact_interior' } }]
[[contender]]
label = 'Closed'
departs = { meeting = 'closed' }
planner = 'bidirectional'
settings = { weight = 'falling', meeting = 'both_closed', side = 'alternate', ties = 'fifo' }
[[reading]]
id = 'sight'
why = 'w'
default = 'exact'
option.exact = { stage.delete_inflections = { line_of_sight = 'exact_interior' } }
option.bresenham = { stage.delete_inflections = { line_of_sight = 'bresenham' } }
[[reading]]
id = 'meeting'
why = 'w'
default = 'any'
option.any = { metric = { met_by = 'opened' } }
option.closed = { metric = { met_by = 'opened' } }
"
}

const COUNTED: &str = "
[[claim]]
id = 'often'
at = 'x'
says = 's'
untestable = 'u'
[claim.check.how_often]
metric = 'path_cost_cells'
contender = 'Improved'
against = 'A*'
sets = [{ label = 'all', study = 's', problems = ['maps'] }]
[claim.check.ordering]
study = 's'
problems = ['maps']
metric = 'plan_time_us'
lower = 'Tidied'
higher = 'Improved'
on = 'average'
[claim.check.refused_by_option]
study = 's'
problems = ['maps']
contender = 'Tidied'
reading = 'sight'
[[claim]]
id = 'all'
at = 'x'
says = 's'
check.share_beyond = { metric = 'path_cost_cells', contender = 'A*', every = true, sets = [{ study = 's', problems = ['maps'], above = 13.6 }] }
[[claim]]
id = 'some'
at = 'x'
says = 's'
check.share_beyond = { metric = 'path_cost_cells', contender = 'A*', every = true, sets = [{ study = 's', problems = ['maps'], above = 18.0 }] }
[[claim]]
id = 'base'
at = 'x'
printed = '14.65'
check.attained = { metric = 'path_cost_cells', contenders = ['A*'], in = [{ study = 's', problems = ['maps'], selected = true }] }
[[claim]]
id = 'met'
at = 'x'
printed = '7'
check.attained = { metric = 'bends', contenders = ['Closed'], in = [{ study = 's', problems = ['maps'] }] }
";

#[test]
fn what_was_not_solved_enters_no_mean() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), COUNTED, &crowded(), |_, evidence| {
        let run = evidence.run("s").unwrap();
        let (groups, labels) = (["maps".to_owned()], ["A*", "Improved"].map(str::to_owned));
        let rows = run.rows("maps", "A*");
        let opened = |rows: &[&crate::study::record::Row]| {
            rows.iter().map(|row| row.value("opened").unwrap()).sum::<f64>() / rows.len() as f64
        };
        let solved: Vec<_> = rows.iter().copied().filter(|row| row.status == Status::Solved).collect();
        assert!(
            solved.len() > 10 && rows.len() > solved.len(),
            "one-sided: {} of {}",
            solved.len(),
            rows.len()
        );
        let common = solved_by_all(run, &groups, &labels);
        let found = mean(run, &common["A*"], "A*", metric::find("opened").unwrap()).unwrap();
        assert!((found.value - opened(&solved)).abs() < 1e-9, "{} is not {}", found.value, opened(&solved));
        assert!((opened(&rows) - opened(&solved)).abs() > 0.01, "floods would not have shown");
    });
}

#[test]
fn shares_are_what_counting_rows_gives() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), COUNTED, &crowded(), |_, evidence| {
        let run = evidence.run("s").unwrap();
        let cost = |label: &str| run.changes("maps", label, None, metric::find("path_cost_cells").unwrap());
        let pairs: Vec<(f64, f64)> = cost("A*").into_iter().zip(cost("Improved")).collect();
        let above = pairs.iter().filter(|(a, b)| b - a > 1e-9).count();
        assert!((1..pairs.len()).contains(&above), "one-sided: {above} of {}", pairs.len());
        let said = finding(evidence, "often", "how_often").because;
        let expected = format!(
            "all, {} maps: higher on {:.1} %",
            pairs.len(),
            100.0 * above as f64 / pairs.len() as f64
        );
        assert!(said[1].starts_with(&expected), "{said:?} is not {expected}");
        let judged = |claim: &str| finding(evidence, claim, "share_beyond");
        assert_eq!(judged("all").verdict, Some(Verdict::Reproduced), "{:?}", judged("all").because);
        let some = judged("some");
        assert_eq!(some.verdict, Some(Verdict::NotReproduced));
        assert!(some.trial.is_some() && cost("A*").iter().any(|cost| *cost > 18.0), "{:?}", some.because);
    });
}

#[test]
fn one_session_of_a_clock_settles_nothing_and_untestable_outweighs_what_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), COUNTED, &crowded(), |_, evidence| {
        let clock = finding(evidence, "often", "ordering");
        assert_eq!(clock.verdict, Some(Verdict::Undecided), "{:?}", clock.because);
        assert!(clock.ours.unwrap().what.contains("(µs)"));
        assert_eq!(judge(evidence).unwrap().claim("often").unwrap().verdict, Verdict::Untestable);
    });
}

#[test]
fn refused_paths_are_counted_under_the_option_that_led_to_them() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), COUNTED, &crowded(), |_, evidence| {
        let refused = |option: &str| {
            let points = evidence.paper.studies[0].trial_points().unwrap().into_iter();
            let views =
                points.filter(|point| point.choices()["sight"] == option).map(|point| evidence.under(point));
            let count = |view: Evidence<'_>| {
                let rows = view.run("s").unwrap().rows("maps", "Tidied").into_iter();
                rows.filter(|row| row.status == Status::Rejected).count()
            };
            views.map(count).sum::<usize>()
        };
        let said = finding(evidence, "often", "refused_by_option").because;
        assert!(refused("bresenham") > 0 && refused("exact") == 0, "{said:?}");
        for (line, option) in said.iter().zip(["bresenham", "exact"]) {
            assert!(line.starts_with(&format!("sight={option}: {} of", refused(option))), "{line}");
        }
    });
}

#[test]
fn selected_maps_count_for_nothing_and_a_contender_of_another_reading_says_so() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), COUNTED, &crowded(), |_, evidence| {
        let base = finding(evidence, "base", "attained");
        assert_eq!((base.verdict, base.ours), (Some(Verdict::Undecided), None));
        assert!(base.because[1].contains("do not count"), "{:?}", base.because);
        let met = finding(evidence, "met", "attained");
        assert_eq!(met.reading.as_deref(), Some("meeting=closed"), "{:?}", met.because);
        assert_eq!(judge(evidence).unwrap().claim("met").unwrap().reading, "meeting=closed");
    });
}

const LENGTH: &str = "
[[claim]]
id = 'length'
at = 'x'
printed = '14.65'
check.straight_line = { start = [22.0, 15.0], goal = [26.0, 28.0] }
[[claim]]
id = 'turn'
at = 'x'
printed = '229.17'
check.turn_needs_length = { size = [30, 30], start = [22, 15], goal = [26, 28], turn = 'turn', against = 'length', metric = 'turn_exterior_deg', exterior = 'turn_exterior_deg', longest = 17.0 }
[[claim]]
id = 'turn.shorter'
at = 'x'
says = 's'
check.turn_needs_length = { size = [30, 30], start = [22, 15], goal = [26, 28], turn = 'turn', against = 'length', shorter = true, metric = 'turn_exterior_deg', exterior = 'turn_exterior_deg', longest = 17.0 }
";

#[test]
fn a_turn_sum_needs_its_length_whatever_is_claimed_beside() {
    let folder = tempfile::tempdir().unwrap();
    with_run(folder.path(), LENGTH, &STUDY.replace("60\n", "2\n"), |_, evidence| {
        let alone = finding(evidence, "turn", "turn_needs_length");
        assert_eq!(alone.verdict, None);
        assert!(alone.because[0].contains("at least 16.0375 (+9.5 % from 14.65)"), "{:?}", alone.because);
        let shorter = finding(evidence, "turn.shorter", "turn_needs_length");
        assert_eq!(shorter.verdict, Some(Verdict::Impossible));
        assert!(shorter.because.last().unwrap().contains("the printed ends"), "{:?}", shorter.because);
    });
}
