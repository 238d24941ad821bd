use super::super::outcome::Outcome::{self, Fails, Holds, Open, SignOnly};
use super::super::verdict_rule::{Chosen, Results, Verdict};
use super::combine::{confirmed, flips};
use super::count::{Counted, Group, VotingChoices};
use super::glance::{Glance, Sight};
use super::stored::{Exploration, ExploredClaim, ExploredResult, Now, results};
use super::tested::by_option;
use super::wording::View;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use study::Choice;
use study::spec::OptionSpec;

fn groups(outcomes: &[Outcome]) -> Vec<Group> {
    let group = |(interpretation, outcome): (usize, &Outcome)| Group {
        interpretation,
        interpretations: vec![interpretation],
        outcome: *outcome,
    };
    outcomes.iter().enumerate().map(group).collect()
}

/// So many of each outcome.
fn many(outcomes: &[(usize, Outcome)]) -> Vec<Outcome> {
    outcomes.iter().flat_map(|(count, outcome)| std::iter::repeat_n(*outcome, *count)).collect()
}

/// The verdict of these results, each confirmed on the second seed by `second`.
fn verdict(found: &[Group], second: Option<Outcome>) -> Verdict {
    let outcomes = confirmed(found, |_| second);
    let default = found[0].outcome.polarity();
    let chosen = None;
    let states_size = false;
    let is_unvaried = false;
    let second = default;
    Results { outcomes: &outcomes, default, second, chosen, states_size, is_unvaried }.verdict().0
}

#[test]
fn noise_among_a_hundred_readings_does_not_turn_a_verdict() {
    let found = groups(&many(&[(60, Holds), (3, Fails), (37, Holds)]));
    assert_eq!(flips(&found).iter().map(|flip| flip.interpretation).collect::<Vec<_>>(), [60, 61, 62]);
    for second in [Some(Holds), Some(Open), None] {
        assert_eq!(confirmed(&found, |_| second).iter().filter(|one| **one == Open).count(), 3, "{second:?}");
        assert_eq!(verdict(&found, second), Verdict::Reproduced, "{second:?}");
    }
    assert_eq!(confirmed(&found, |_| Some(Fails)).iter().filter(|one| **one == Fails).count(), 3);
    // What turns twice is no noise, and neither is what many interpretations show.
    let found = groups(&many(&[(30, Holds), (20, Fails)]));
    assert_eq!(verdict(&found, Some(Fails)), Verdict::Depends);
    assert_eq!(verdict(&found, None), Verdict::Supported);
}

#[test]
fn what_stands_alone_against_most_must_be_confirmed_whichever_way_it_speaks() {
    let found = groups(&many(&[(1, Holds), (8, Fails)]));
    assert_eq!(flips(&found).iter().map(|flip| flip.interpretation).collect::<Vec<_>>(), [0]);
    assert_eq!(confirmed(&found, |_| None)[0], Open);
    assert_eq!(confirmed(&found, |_| Some(Holds))[0], Holds);
    assert!(flips(&groups(&many(&[(9, Fails), (3, Open)]))).is_empty());
}

/// Choices with these defaults.
fn choices(defaults: &[(&str, &str)]) -> VotingChoices {
    let choice = |(id, default): &(&str, &str)| Choice {
        id: (*id).to_owned(),
        title: None,
        why: String::new(),
        default: (*default).to_owned(),
        fitted: false,
        bounds: None,
        options: BTreeMap::new(),
        touches_trials: true,
        place: None,
    };
    let choices = defaults.iter().map(choice).collect();
    VotingChoices { choices, calibration: BTreeSet::new(), now: Now::default() }
}

/// An outcome under the interpretation at `place`.
fn result((place, outcome): (usize, &Outcome)) -> ExploredResult {
    ExploredResult {
        interpretations: vec![place],
        outcome: *outcome,
        sight: Sight::Looked,
        value: None,
        interval: None,
        n: 1,
        farthest: None,
        refused: 0.0,
        results: place.to_string(),
        more: None,
        power: None,
    }
}

/// What an exploration found of `fewer` under interpretations that take these options of `choices`, each with its outcome; every option is
/// cited.
struct Planted {
    choices: VotingChoices,
    first: Exploration,
    groups: Vec<Group>,
}

impl Planted {
    fn new(defaults: &[(&str, &str)], found: &[(&[&str], Outcome)]) -> Self {
        let mut choices = choices(defaults);
        let mut interpretations = Vec::new();
        for (options, _) in found {
            let mut interpretation = BTreeMap::new();
            for (choice, option) in choices.choices.iter_mut().zip(*options) {
                let cited = OptionSpec { practice: Some("a handbook".to_owned()), ..OptionSpec::default() };
                choice.options.insert((*option).to_owned(), Arc::new(cited));
                if *option != choice.default {
                    interpretation.insert(choice.id.clone(), (*option).to_owned());
                }
            }
            interpretations.push(interpretation);
        }
        let outcomes: Vec<Outcome> = found.iter().map(|(_, outcome)| *outcome).collect();
        let results = outcomes.iter().enumerate().map(result).collect();
        let claim = ExploredClaim { results, ..ExploredClaim::default() };
        let claims = BTreeMap::from([("fewer".to_owned(), claim)]);
        let first = Exploration { interpretations, claims, ..Exploration::default() };
        Self { choices, first, groups: groups(&outcomes) }
    }

    /// What stands beside the verdict, and on what it depends.
    fn wording(&self) -> (String, Option<String>) {
        self.wording_where(None)
    }

    /// The same of a claim whose inputs were chosen so.
    fn wording_where(&self, chosen: Option<Chosen>) -> (String, Option<String>) {
        let outcomes: Vec<Outcome> = self.groups.iter().map(|group| group.outcome).collect();
        let looked = self.groups.iter().map(|group| group.interpretations.len()).sum();
        let counted = Counted { groups: self.groups.clone(), looked, ..Counted::default() };
        let default = outcomes[0].polarity();
        let states_size = false;
        let is_unvaried = false;
        let results =
            Results { outcomes: &outcomes, default, second: default, chosen, states_size, is_unvaried };
        let (_, line) = results.verdict();
        let view = View {
            choices: &self.choices,
            first: Some(&self.first),
            id: "fewer",
            counted: &counted,
            results: &results,
        };
        let found = view.wording(line);
        (found.beside.join("; "), found.depends_on)
    }
}

#[test]
fn a_joint_test_names_the_options_that_fit_and_those_that_fit_with_no_other() {
    let found: [(&[&str], Outcome); 6] = [
        (&["draws", "spared", "start", "one"], Holds),
        (&["draws", "cleared", "goal", "one"], Holds),
        (&["draws", "counted", "goal", "one"], Fails),
        (&["count", "spared", "start", "one"], Fails),
        (&["count", "counted", "start", "one"], Fails),
        (&["draws", "cleared", "start", "other"], Fails),
    ];
    // The claim does not look at what the choice of a planner touches.
    let defaults = [("blocking", "draws"), ("border", "spared"), ("smoothing", "start"), ("planner", "one")];
    let mut planted = Planted::new(&defaults, &found);
    let far = |place: usize| Some(format!("cell {place}: printed 2, ours 1 (+3.0 σ)"));
    for (place, result) in planted.first.claims.get_mut("fewer").unwrap().results.iter_mut().enumerate() {
        result.farthest = far(place);
    }
    let by_options = |planted: &Planted| {
        let results = &planted.first.claims["fewer"].results;
        let values = results.iter().zip([0.4, 0.3, 0.02, 0.01, 0.03, 0.04]);
        let results: Vec<_> = values.map(|(result, value)| (value, result)).collect();
        let all = &planted.choices.choices;
        let touching = all.iter().filter(|choice| choice.id != "planner").map(|own| (own.id.as_str(), own));
        by_option(&planted.choices, &touching.collect(), &planted.first, &results, 4)
    };
    let both = [
        "fits: blocking = draws, border = cleared or spared, with every option of smoothing",
        "refuses: blocking = count, border = counted (p at most 0.030, and 0.120 after correcting for 4 interpretations)",
        "against blocking = count: p at most 0.030 (0.120 after correcting); farthest off is cell 4: printed 2, ours 1 (+3.0 σ)",
        "against border = counted: p at most 0.030 (0.120 after correcting); farthest off is cell 4: printed 2, ours 1 (+3.0 σ)",
    ];
    assert_eq!(by_options(&planted), both);
    // What a test refuses under probes alone says nothing of what the paper may mean.
    for (choice, option) in [(0, "count"), (1, "counted")] {
        planted.choices.choices[choice].options.insert(option.to_owned(), Arc::new(OptionSpec::default()));
    }
    assert_eq!(by_options(&planted), Vec::<String>::new());
}

#[test]
fn results_of_two_sizes_are_called_the_same_in_direction_alone() {
    let with = |rest: Outcome| product(|corners, _| if corners == "b" { rest } else { Holds }).wording().0;
    assert_eq!(with(Holds), "same under all 9");
    assert_eq!(with(SignOnly), "same direction under all 9");
}

/// Two choices whose outcomes `of` says for every combination of their three options.
fn product(of: impl Fn(&str, &str) -> Outcome) -> Planted {
    let names = ["a", "b", "c"];
    let both: Vec<[&str; 2]> = names.iter().flat_map(|one| names.map(|two| [*one, two])).collect();
    let found: Vec<(&[&str], Outcome)> = both.iter().map(|pair| (&pair[..], of(pair[0], pair[1]))).collect();
    Planted::new(&[("corners", "a"), ("ties", "a")], &found)
}

#[test]
fn a_planted_rule_of_one_option_is_named_from_either_side() {
    let against = product(|corners, _| if corners == "b" { Fails } else { Holds });
    let expected = "6/0/3 for/open/against; contradicted only if corners = b (3 of 3)";
    assert_eq!(against.wording(), (expected.to_owned(), Some("corners".to_owned())));
    let held = product(|_, ties| if ties == "a" { Holds } else { Fails });
    let expected = "3/0/6 for/open/against; holds only if ties = a (3 of 3)";
    assert_eq!(held.wording(), (expected.to_owned(), Some("ties".to_owned())));
}

#[test]
fn of_two_exact_options_the_one_under_which_fewer_interpretations_stand_is_named() {
    // Every result with corners b has ties b. Ties b stands under one more interpretation, of a result on no side.
    let found: [(&[&str], Outcome); 5] = [
        (&["a", "a"], Holds),
        (&["c", "a"], Holds),
        (&["b", "b"], Fails),
        (&["c", "b"], Open),
        (&["a", "c"], Holds),
    ];
    let planted = Planted::new(&[("corners", "a"), ("ties", "a")], &found);
    assert_eq!(planted.wording().1.as_deref(), Some("corners"));
    // The order of the choices does not decide.
    let swapped = found.map(|(options, outcome)| ([options[1], options[0]], outcome));
    let swapped: Vec<(&[&str], Outcome)> =
        swapped.iter().map(|(all, outcome)| (&all[..], *outcome)).collect();
    let planted = Planted::new(&[("ties", "a"), ("corners", "a")], &swapped);
    assert_eq!(planted.wording().1.as_deref(), Some("corners"));
}

#[test]
fn a_planted_rule_of_two_options_is_named_where_neither_alone_is_exact() {
    let both = product(|corners, ties| if corners == "b" && ties == "c" { Fails } else { Holds });
    // One of nine results is not a tenth: nine tenths would be reproduced with an exception.
    let expected = "8/0/1 for/open/against; contradicted only if corners = b and ties = c (1 of 1)";
    assert_eq!(both.wording(), (expected.to_owned(), Some("corners and ties".to_owned())));
}

#[test]
fn a_combination_decides_where_results_on_both_sides_have_the_option_that_one_side_shares() {
    // The two that contradict share corners; with a third choice no pair of options is exact.
    let found: [(&[&str], Outcome); 7] = [
        (&["a", "a", "a"], Holds),
        (&["b", "a", "a"], Holds),
        (&["b", "b", "a"], Fails),
        (&["b", "a", "b"], Fails),
        (&["b", "b", "b"], Holds),
        (&["a", "b", "a"], Holds),
        (&["a", "a", "b"], Holds),
    ];
    let planted = Planted::new(&[("corners", "a"), ("ties", "a"), ("side", "a")], &found);
    let expected = "5/0/2 for/open/against; contradicted only if corners = b (2 of 4)";
    assert_eq!(planted.wording(), (expected.to_owned(), Some("several choices".to_owned())));
}

#[test]
fn where_the_sides_share_no_option_a_combination_decides_and_the_best_axis_is_named() {
    let either = product(|corners, ties| if (corners == "b") == (ties == "b") { Fails } else { Holds });
    let (words, on) = either.wording();
    assert_eq!(on.as_deref(), Some("several choices"), "{words}");
    assert!(
        words.contains("corners matters most: 2 of 3 against with a, 2 of 3 with c, 1 of 3 with b"),
        "{words}"
    );
}

#[test]
fn nothing_depends_on_an_axis_that_moves_nothing_alone() {
    let mut idle = product(|_, ties| if ties == "b" { Fails } else { Holds });
    // The corners give the same result alone; those that count happen to part by them as well.
    for place in [3, 6] {
        idle.first.claims.get_mut("fewer").unwrap().results[place].results = "0".to_owned();
    }
    idle.groups.retain(|group| [0, 4].contains(&group.interpretation));
    assert_eq!(idle.wording().1.as_deref(), Some("ties"));
}

#[test]
fn an_example_lists_no_option_that_cannot_move_the_claim_unless_it_is_a_witness() {
    let mut idle = product(|corners, _| if corners == "b" { Holds } else { Fails });
    // Other ties give the same result alone.
    for place in [1, 2] {
        idle.first.claims.get_mut("fewer").unwrap().results[place].results = "0".to_owned();
    }
    idle.groups.retain(|group| [0, 5].contains(&group.interpretation));
    let met = |chosen| idle.wording_where(Some(chosen)).0;
    assert_eq!(met(Chosen::Searched), "met under 1 of 2, corners = b among them");
    assert_eq!(met(Chosen::Existence), "met under 1 of 2, corners = b, ties = c among them");
}

#[test]
fn a_result_stands_under_all_of_its_readings_and_not_under_the_first_alone() {
    let mut planted = product(|corners, ties| if corners == "a" && ties == "a" { Fails } else { Holds });
    let group = |interpretations: Vec<usize>, outcome| Group {
        interpretation: interpretations[0],
        interpretations,
        outcome,
    };
    // The other corners bring it alone, and so do other ties.
    planted.groups = vec![group(vec![0], Fails), group(vec![1, 3], Holds)];
    assert_eq!(planted.wording().1.as_deref(), Some("corners and ties"));
    planted.groups = vec![group(vec![0], Fails), group(vec![3], Holds)];
    assert_eq!(planted.wording().1.as_deref(), Some("corners"));
}

#[test]
fn an_option_under_which_most_results_are_on_the_other_side_is_no_reason() {
    // Both that contradict have the default side, and so have most that hold.
    let found: [(&[&str], Outcome); 7] = [
        (&["a", "a", "a"], Holds),
        (&["b", "a", "a"], Fails),
        (&["a", "b", "a"], Fails),
        (&["b", "b", "a"], Holds),
        (&["c", "a", "a"], Holds),
        (&["a", "a", "b"], Holds),
        (&["c", "c", "a"], Holds),
    ];
    let planted = Planted::new(&[("corners", "a"), ("ties", "a"), ("side", "a")], &found);
    assert_eq!(planted.wording().1.as_deref(), Some("several choices"));
}

#[test]
fn a_size_that_is_missed_is_named_also_where_a_choice_was_not_varied() {
    let planted = Planted::new(&[("corners", "a")], &[(&["a"], Outcome::SignOnly)]);
    let outcomes = [Outcome::SignOnly];
    let counted = Counted { groups: planted.groups.clone(), looked: 1, ..Counted::default() };
    let [default, second] = [outcomes[0].polarity(); 2];
    let (chosen, states_size, is_unvaried) = (None, true, true);
    let results = Results { outcomes: &outcomes, default, second, chosen, states_size, is_unvaried };
    let line = results.verdict().1;
    let first = Some(&planted.first);
    let view = View { choices: &planted.choices, first, id: "fewer", counted: &counted, results: &results };
    assert_eq!(view.wording(line).beside, ["the sign alone"]);
}

#[test]
fn exceptions_are_named_by_what_they_share_or_one_by_one() {
    let open = product(|corners, ties| if corners == "c" && ties != "a" { Open } else { Holds });
    assert_eq!(open.wording().0, "7/2/0 for/open/against; all 2 exceptions have corners = c");
    let apart = product(|corners, ties| if corners == ties && corners != "a" { Open } else { Holds });
    let expected = "7/2/0 for/open/against; exceptions: corners = b, ties = b · corners = c, ties = c";
    assert_eq!(apart.wording().0, expected);
}

/// Of so many instances, whose trials these are.
fn glance(outcome: Outcome, n: usize, results: &str) -> Glance {
    Glance {
        outcome,
        sight: Sight::Looked,
        ours: Some((0.0, None, n)),
        farthest: None,
        refused: 0.0,
        results: results.to_owned(),
        studies: BTreeSet::new(),
        power: None,
    }
}

#[test]
fn readings_that_only_more_instances_tell_apart_are_two_results() {
    let few = glance(Fails, 30, "few");
    let other = glance(Fails, 30, "other");
    let shorter = glance(Holds, 500, "shorter");
    let equal = glance(Fails, 500, "equal");
    let seen = [
        (0, &few, Some(&shorter)),
        (1, &few, Some(&equal)),
        (2, &few, None),
        (3, &other, None),
        (4, &few, Some(&equal)),
        (5, &few, Some(&shorter)),
    ];
    let found: Vec<_> =
        results(&seen).into_iter().map(|one| (one.interpretations, one.outcome, one.n)).collect();
    let expected = [
        (vec![0, 5], Holds, 500),
        (vec![1, 4], Fails, 500),
        // What more instances did not look at keeps the outcome of its few.
        (vec![2], Fails, 30),
        (vec![3], Fails, 30),
    ];
    assert_eq!(found, expected);
    let found = results(&seen);
    let alike = |one: usize, other: usize| found[one].is_as_far_as_seen(&found[other]);
    assert!(alike(0, 2) && alike(2, 1) && !alike(0, 1) && !alike(2, 3));
}
