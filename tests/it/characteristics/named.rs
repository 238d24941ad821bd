//! What an outcome names beside itself: ties, refused paths, what was left out, what is possible, and its power.

use super::censored::{judged, pairs};
use super::synthetic::End::{self, At, NoPath, Rejected, Spent, Unposed};
use super::synthetic::{Made, Sample, Synthetic};

#[test]
fn a_strict_comparison_that_ties_on_every_case_is_contradicted_with_a_bound() {
    let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
    let found = |settings: &str, all: &[(usize, End, End)]| {
        let one = judged("lower", &format!("{selection}\n{settings}"), Made::Plainly, pairs(all));
        (one.outcome.name(), one.findings[0].because.join("; "))
    };
    for settings in ["", "is = \"higher\""] {
        let (outcome, because) = found(settings, &[(40, At(5.0), At(5.0))]);
        // One side of the exact interval of 0 of 40: 1 - 0.025^(1/40) = 8.8 %.
        let bound = "every case ties: at most 8.8 % of instances could differ";
        assert!(outcome == "contradicted" && because.contains(bound), "{outcome}: {because}");
    }
    let (outcome, because) = found("", &[(39, At(5.0), At(5.0)), (1, At(4.0), At(5.0))]);
    assert!(outcome == "open" && !because.contains("ties"), "one case differs: {outcome}: {because}");
    assert_eq!(found("", &[(9, At(5.0), At(5.0))]).0, "open", "too few instances");
    assert_eq!(found("by_percent = 10", &[(20, At(5.0), At(5.0))]).0, "open", "no strict comparison");
}

#[test]
fn what_ties_on_every_case_is_contradicted_where_enough_cases_are_drawn() {
    let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
    let found = |cases: usize| {
        let all = pairs(&[(cases, At(5.0), At(5.0))]);
        let one = judged("on_every", &format!("{selection}\nthat = \"lower\""), Made::Plainly, all);
        (one.outcome.name(), one.findings[0].because.join("; "))
    };
    let (outcome, because) = found(40);
    let bound = "every case ties: at most 8.8 % of instances could differ";
    assert!(outcome == "contradicted" && because.contains(bound), "{outcome}: {because}");
    for few in [1, 9] {
        assert_eq!(found(few).0, "open", "{few} instances");
    }
    assert_eq!(found(10).0, "contradicted");
}

#[test]
fn what_ties_on_some_cases_and_is_never_the_contrary_is_open_and_names_the_ties() {
    let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
    let all = [(30, At(4.0), At(5.0)), (7, At(5.0), At(5.0))];
    let one = judged("on_every", &format!("{selection}\nthat = \"lower\""), Made::Plainly, pairs(&all));
    assert_eq!(one.outcome.name(), "open");
    let settles = one.findings[0].settles.as_deref().unwrap();
    assert_eq!(settles, "no more instances: 7 tie, and the claim is strict");
}

#[test]
fn paths_that_the_verifier_refuses_are_named_where_they_keep_a_claim_open() {
    let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
    let all = [(30, At(4.9), At(5.0)), (3, At(5.2), At(5.0)), (20, Rejected, At(5.0))];
    let one = judged("lower", selection, Made::Plainly, pairs(&all));
    let settles = one.findings[0].settles.as_deref().unwrap();
    assert!(one.outcome.name() == "open" && settles.contains("it refuses 20"), "{settles}");
}

#[test]
fn one_path_that_the_verifier_refuses_contradicts_that_it_accepts_every_path() {
    let class_after = |more: (usize, End, End)| {
        let settings = "select = { OF, contender = \"A\" }\nthat = \"accepted\"";
        let all = [(30, At(4.0), At(5.0)), (10, NoPath, At(5.0)), more];
        judged("on_every", settings, Made::Plainly, pairs(&all)).outcome.name()
    };
    let ends = [At(6.0), NoPath, Spent, Rejected].map(|end| class_after((1, end, At(5.0))));
    assert_eq!(ends, ["holds", "holds", "open", "contradicted"]);
}

#[test]
fn a_saving_whose_interval_covers_most_per_cents_is_no_match() {
    let one = |spread: f64| {
        let mut sample = Sample::default();
        for instance in 0..80 {
            sample.instance();
            sample.trial("A", At(10.0 + spread * f64::from(instance % 8)));
            sample.trial("B", At(100.0));
        }
        let selection = "select = { OF, contender = \"A\", against = \"B\", metric = \"path_cost_cells\" }";
        let claim = format!(
            "[[claim]]\nid = \"asked\"\nat = \"here\"\nprinted = \"50\"\n[claim.check.one_instance]\n{}",
            selection.replace("OF", "study = \"drawn\", problems = [\"map\"]")
        );
        Synthetic::new(&claim, Made::Plainly).judgement(sample.records(), &[])
    };
    // 10 to 94 of 100: savings from 6 to 90 per cent; then 10 to 66.
    let (wide, narrow) = (one(12.0), one(8.0));
    assert_eq!([wide.outcome.name(), narrow.outcome.name()], ["open", "holds"]);
    assert!(wide.findings[0].because.join("; ").contains("no power"), "{:?}", wide.findings);
    let power = "power: a printed value below 34.00 or above 90.00 would have been refused";
    assert_eq!(narrow.findings[0].because.last().map(String::as_str), Some(power));
}

#[test]
fn a_match_says_which_printed_values_would_have_been_refused() {
    let selection = "select = { OF, contender = \"A\", metric = \"path_cost_cells\" }";
    let all = [(30, At(-1.0), At(1.0)), (30, At(1.0), At(1.0))];
    let within = |margin: &str| {
        let settings = format!("{selection}\nstatistic = \"mean\"\nmargin = {margin}");
        judged("within", &settings, Made::Plainly, pairs(&all)).findings[0].because.clone()
    };
    let says_power = |because: &[String]| because.iter().any(|message| message.starts_with("power: "));
    let met = within("0.5");
    let open = within("0.1");
    assert!(says_power(&met) && !says_power(&open), "{met:?} {open:?}");
    let ends: Vec<f64> = met.last().unwrap().split(' ').filter_map(|word| word.parse().ok()).collect();
    let half = ends[1] - 0.5;
    assert!(
        ends.len() == 2 && (0.2..0.3).contains(&half),
        "the interval's half width and the margin: {ends:?}"
    );
}

#[test]
fn our_clock_says_nothing_of_the_authors_times_and_decides_questions_of_our_own() {
    let selection = "select = { study = \"drawn\", problems = \"map\", contender = \"A\", against = \"B\", metric = \"plan_time_ms\" }";
    let claim = format!("[[claim]]\nid = \"asked\"\nat = \"here\"\n[claim.check.lower]\n{selection}\n");
    let records = || {
        let mut sample = Sample::default();
        for _ in 0..40 {
            sample.instance();
            for (label, time) in [("A", 1e6), ("B", 2e6)] {
                sample.trial(label, At(1.0));
                (1..=3).for_each(|session| sample.clock(session, time));
            }
        }
        sample.records()
    };
    let mut paper = Synthetic::new(&claim, Made::Timed);
    assert_eq!(paper.judgement(records(), &[]).verdict.name(), "reproduced");
    paper.of_others();
    let judged = paper.judgement(records(), &[]);
    assert_eq!((judged.outcome.name(), judged.verdict.name()), ("not testable", "not testable"));
    assert!(judged.findings[0].because.last().unwrap().contains("our clock does not test it"), "{judged:?}");
    // Where a paper leaves something open, the clock was read under the defaults alone.
    let choice = "[[choice]]\nid = \"name\"\nwhy = \"it is open\"\ndefault = \"a\"\npaper = \"here\"\n\
                  [choice.option]\na = { metric = { name = \"opened\" } }\nb = { metric = { name = \"closed\" } }\n";
    let says = |text: &str| {
        let judged = Synthetic::new(text, Made::Timed).judgement(records(), &[]);
        judged.findings[0].because.iter().any(|line| line == "the clock was read under the defaults alone")
    };
    assert_eq!([says(&claim), says(&(claim.clone() + choice))], [false, true]);
}

#[test]
fn a_problem_that_cannot_be_posed_is_left_out_of_what_holds_on_each_and_is_named() {
    let found = |criterion: &str, settings: &str| {
        let mut sample = Sample::default();
        for (group, ends) in [("map", [At(50.0), At(100.0)]), ("other", [Unposed, Unposed])] {
            for _ in 0..10 {
                sample.instance_on(group);
                sample.trial("A", ends[0]);
                sample.trial("B", ends[1]);
            }
        }
        let one = judged(criterion, settings, Made::Plainly, sample);
        (one.outcome.name(), one.findings[0].because.join("; "))
    };
    let select = |more: &str| {
        format!(
            "select = {{ study = \"drawn\", problems = [\"map\", \"other\"], metric = \"path_cost_cells\"{more} }}\n"
        )
    };
    let least = |one: &str, other: &str| select("") + &format!("lower = \"{one}\"\nhigher = [\"{other}\"]");
    let against = |one: &str, other: &str| select(&format!(", contender = \"{one}\", against = \"{other}\""));
    let group = "left out, for it cannot be posed: other";
    let problems = "no problem could be posed in 10 of 20";
    for (one, other, outcome) in [("A", "B", "holds"), ("B", "A", "contradicted")] {
        let lower = against(one, other) + "that = \"lower\"";
        let share = against(one, other) + "hits = \"lower\"\naccepted = [0.6, 1.0]";
        for (criterion, settings, reported) in [
            ("least_of", least(one, other), group),
            ("on_every", lower, problems),
            ("share", share, problems),
        ] {
            let (found, because) = found(criterion, &settings);
            let is_reported = because.contains(reported);
            assert!(found == outcome && is_reported, "{criterion}: {one} below {other}: {found}: {because}");
        }
    }
}

#[test]
fn a_rule_that_refuses_nothing_says_what_is_possible_and_asks_for_no_instances() {
    let claim = "[[claim]]\nid = \"asked\"\nat = \"here\"\nprinted = \"14.65\"\n\
                 [claim.rule.lattice_length]\nstart = [22, 15]\ngoal = [26, 28]\n";
    let judged = Synthetic::new(claim, Made::Plainly).judgement(Sample::default().records(), &[]);
    assert_eq!(judged.beside, ["possible: 9 + 4√2, cut off"]);
    assert_eq!((judged.verdict.name(), judged.findings[0].outcome), ("inconclusive", None));
    let settles = judged.findings[0].settles.as_deref().unwrap();
    assert_eq!(settles, "the paper's own input: arithmetic alone can only refuse, and did not");
}
