use super::super::class::Polarity;
use super::super::class::Verdict::{
    self, Attainable, Impossible, NotReproduced, Reproduced, Undecided, Untestable,
};
use super::combine::{combined, confirmed, flips};
use super::count::{Group, VotingChoices};
use super::glance::{Glance, Sight};
use super::hangs::summary;
use super::stored::{Exploration, ExploredClaim, ExploredResult, Now, results};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use study::Choice;
use study::spec::OptionSpec;

fn groups(classes: &[Verdict]) -> Vec<Group> {
    let group = |(interpretation, class): (usize, &Verdict)| Group {
        interpretation,
        interpretations: vec![interpretation],
        class: *class,
    };
    classes.iter().enumerate().map(group).collect()
}

/// So many of each class.
fn many(classes: &[(usize, Verdict)]) -> Vec<Verdict> {
    classes.iter().flat_map(|(count, class)| std::iter::repeat_n(*class, *count)).collect()
}

/// Every pair of classes.
fn pairs() -> impl Iterator<Item = [Verdict; 2]> {
    Verdict::ALL.into_iter().flat_map(|one| Verdict::ALL.into_iter().map(move |two| [one, two]))
}

#[test]
fn two_results_decide_only_where_both_speak_one_way() {
    for pair in pairs() {
        let all = combined(&pair, false);
        assert_eq!(all, combined(&[pair[1], pair[0]], false), "{pair:?}: the order does not count");
        let expected = match pair.map(Verdict::polarity) {
            [Polarity::For, Polarity::For] => pair[0].max(pair[1]),
            [Polarity::Against, Polarity::Against] if pair == [Impossible; 2] => Impossible,
            [Polarity::Against, Polarity::Against] => NotReproduced,
            _ if pair == [Untestable; 2] => Untestable,
            _ => Undecided,
        };
        assert_eq!(all, expected, "{pair:?}");
    }
    assert_eq!(combined(&[], false), Undecided);
}

#[test]
fn nine_tenths_decide_against_what_is_open_and_nothing_does_against_what_speaks_the_other_way() {
    for [most, rest] in pairs().filter(|[most, rest]| most.polarity() != rest.polarity()) {
        let of = |count| combined(&many(&[(count, most), (1, rest)]), false);
        let is_open = most.polarity() == Polarity::Open || rest.polarity() != Polarity::Open;
        let expected = if is_open { Polarity::Open } else { most.polarity() };
        assert_eq!(of(9).polarity(), expected, "nine {most:?}, one {rest:?}");
        assert_eq!(of(8), Undecided, "eight {most:?}, one {rest:?}");
        assert!(of(9) != Impossible, "{rest:?} is no proof");
    }
}

#[test]
fn of_two_results_the_stronger_witness_makes_an_existential_claim() {
    for pair in pairs() {
        let witnesses = pair.into_iter().filter(|class| class.polarity() == Polarity::For);
        let expected = witnesses.min().unwrap_or_else(|| combined(&pair, false));
        assert_eq!(combined(&pair, true), expected, "{pair:?}");
    }
}

#[test]
fn one_witness_makes_an_existential_claim_and_none_leaves_it_open() {
    assert_eq!(combined(&many(&[(43, Undecided), (1, Attainable)]), true), Attainable);
    assert_eq!(combined(&many(&[(43, Undecided), (1, Attainable)]), false), Undecided);
    assert_eq!(combined(&many(&[(44, Undecided)]), true), Undecided);
}

#[test]
fn noise_among_a_hundred_readings_does_not_flip_a_class() {
    let found = groups(&many(&[(60, Reproduced), (3, NotReproduced), (37, Reproduced)]));
    assert_eq!(flips(&found).iter().map(|flip| flip.interpretation).collect::<Vec<_>>(), [60, 61, 62]);
    let by_second = |second: Option<Verdict>| combined(&confirmed(&found, |_| second), false);
    assert_eq!(by_second(Some(Reproduced)), Reproduced);
    assert_eq!(by_second(Some(Undecided)), Reproduced);
    assert_eq!(by_second(None), Reproduced);
    // What turns twice is no noise.
    assert_eq!(by_second(Some(NotReproduced)), Undecided);
    // Nor is noise what many interpretations show: unconfirmed they leave it open.
    let found = groups(&many(&[(30, Reproduced), (20, NotReproduced)]));
    assert_eq!(combined(&confirmed(&found, |_| None), false), Undecided);
}

#[test]
fn what_stands_alone_against_most_must_be_confirmed_whichever_way_it_speaks() {
    let found = groups(&many(&[(1, Reproduced), (19, NotReproduced)]));
    assert_eq!(flips(&found).iter().map(|flip| flip.interpretation).collect::<Vec<_>>(), [0]);
    assert_eq!(combined(&confirmed(&found, |_| None), false), NotReproduced);
    assert_eq!(combined(&confirmed(&found, |_| Some(Reproduced)), false), Undecided);
    assert!(flips(&groups(&many(&[(9, NotReproduced), (3, Undecided)]))).is_empty());
}

/// Choices with these defaults.
fn choices(defaults: &[(&str, &str)]) -> VotingChoices {
    let choice = |(id, default): &(&str, &str)| Choice {
        id: (*id).to_owned(),
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

/// A class under the interpretation at `place`.
fn result((place, class): (usize, &Verdict)) -> ExploredResult {
    ExploredResult {
        interpretations: vec![place],
        class: *class,
        sight: Sight::Looked,
        value: None,
        interval: None,
        n: 1,
        results: place.to_string(),
    }
}

/// What a claim hangs on that holds with two options together and fails under the default and one of them alone; `alone` is
/// its class under the other alone, which does not count.
fn hangs_on(alone: Verdict) -> String {
    let choices = choices(&[("corners", "allow"), ("ties", "fifo")]);
    let interpretation = |options: &[(&str, &str)]| {
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect()
    };
    let forbid = ("corners", "forbid");
    let lifo = ("ties", "lifo");
    let classes = [NotReproduced, alone, NotReproduced, Reproduced];
    let results = classes.iter().enumerate().map(result).collect();
    let claim = ExploredClaim { results, ..ExploredClaim::default() };
    let first = Exploration {
        interpretations: vec![
            interpretation(&[]),
            interpretation(&[forbid]),
            interpretation(&[lifo]),
            interpretation(&[forbid, lifo]),
        ],
        claims: BTreeMap::from([("fewer".to_owned(), claim)]),
        ..Exploration::default()
    };
    let counted: Vec<Group> =
        groups(&classes).into_iter().filter(|group| group.interpretation != 1).collect();
    let votes: Vec<Verdict> = counted.iter().map(|group| group.class).collect();
    summary(&choices, &first, "fewer", &counted, &votes, Undecided, false)
}

#[test]
fn a_claim_hangs_on_an_axis_alone_only_if_its_option_alone_decides() {
    assert_eq!(hangs_on(Reproduced), "hangs on corners: reproduced if forbid (1 of 3)");
    for alone in [NotReproduced, Undecided] {
        assert_eq!(
            hangs_on(alone),
            "hangs on corners and others: reproduced under 1 of 3 (allow 0 of 2, forbid 1 of 1)"
        );
    }
}

#[test]
fn a_claim_does_not_hang_on_an_axis_whose_options_bring_the_same_alone() {
    let of = |options: &[(&str, &str)]| -> BTreeMap<String, String> {
        options.iter().map(|(id, option)| ((*id).to_owned(), (*option).to_owned())).collect()
    };
    let rim = ("sets", "rim");
    let never = ("update", "never");
    // The sets part what counts as well as the update does; by themselves they change nothing.
    let interpretations = vec![of(&[]), of(&[rim]), of(&[never]), of(&[rim, never])];
    let said_of = |sets_alone: &str| {
        let mut results: Vec<ExploredResult> =
            [Reproduced, Reproduced, NotReproduced, NotReproduced].iter().enumerate().map(result).collect();
        results[1].results = sets_alone.to_owned();
        let claim = ExploredClaim { results, ..ExploredClaim::default() };
        let first = Exploration {
            interpretations: interpretations.clone(),
            claims: BTreeMap::from([("fewer".to_owned(), claim)]),
            ..Exploration::default()
        };
        let mut choices = choices(&[("sets", "all"), ("update", "lowered")]);
        for (choice, other) in choices.choices.iter_mut().zip(["rim", "never"]) {
            let cited = OptionSpec { practice: Some("a handbook".to_owned()), ..OptionSpec::default() };
            let names = [choice.default.clone(), other.to_owned()];
            choice.options = names.map(|name| (name, Arc::new(cited.clone()))).into();
        }
        let counted = [(0, Reproduced), (3, NotReproduced)];
        let counted = counted.map(|(interpretation, class)| Group {
            interpretation,
            interpretations: vec![interpretation],
            class,
        });
        summary(&choices, &first, "fewer", &counted, &[Reproduced, NotReproduced], Undecided, false)
    };
    // They move no result, or move it and not its class.
    for sets_alone in ["0", "1"] {
        assert_eq!(said_of(sets_alone), "hangs on update: reproduced if lowered (1 of 2)", "{sets_alone}");
    }
}

#[test]
fn a_claim_does_not_hang_on_one_axis_where_another_brings_the_same_result() {
    let of = |id: &str, option: &str| BTreeMap::from([(id.to_owned(), option.to_owned())]);
    let classes = [NotReproduced, Reproduced, Reproduced];
    let claim = ExploredClaim {
        results: classes.iter().enumerate().map(result).collect(),
        ..ExploredClaim::default()
    };
    let first = Exploration {
        interpretations: vec![BTreeMap::new(), of("shape", "triangle"), of("hops", "swept")],
        claims: BTreeMap::from([("free".to_owned(), claim)]),
        ..Exploration::default()
    };
    let choices = choices(&[("shape", "circle"), ("hops", "ends")]);
    let said_of =
        |interpretations: Vec<usize>| {
            let counted =
                [(vec![0], NotReproduced), (interpretations, Reproduced)].map(|(interpretations, class)| {
                    Group { interpretation: interpretations[0], interpretations, class }
                });
            summary(&choices, &first, "free", &counted, &[NotReproduced, Reproduced], Undecided, false)
        };
    assert_eq!(said_of(vec![1]), "hangs on shape: reproduced if triangle (1 of 2)");
    let of_both = said_of(vec![1, 2]);
    assert!(of_both.contains(" and others: reproduced under 1 of 2"), "{of_both}");
}

#[test]
fn an_axis_of_many_options_does_not_win_by_parting_few_results_each() {
    // Six results: each under an order of its own, two sides, and one exception to what the side says.
    let of = |(order, side): (&str, &str)| -> BTreeMap<String, String> {
        let own = [("order", order), ("side", side)].into_iter().filter(|(_, option)| *option != "a");
        own.map(|(id, option)| (id.to_owned(), option.to_owned())).collect()
    };
    let orders = [("a", "a"), ("b", "a"), ("c", "a"), ("d", "b"), ("e", "b"), ("f", "b"), ("f", "a")];
    let classes = [Reproduced, Reproduced, Reproduced, NotReproduced, NotReproduced, Reproduced];
    // Alone, the order of the exception does not bring it.
    let all = [&classes[..], &[NotReproduced]].concat();
    let results = all.iter().enumerate().map(result).collect();
    let claim = ExploredClaim { results, ..ExploredClaim::default() };
    let first = Exploration {
        interpretations: orders.into_iter().map(of).collect(),
        claims: BTreeMap::from([("fewer".to_owned(), claim)]),
        ..Exploration::default()
    };
    let choices = choices(&[("order", "a"), ("side", "a")]);
    let said = summary(&choices, &first, "fewer", &groups(&classes), &classes, Undecided, false);
    assert_eq!(said, "hangs on side and others: reproduced under 4 of 6 (a 3 of 3, b 1 of 3)");
}

/// Of so many instances, whose trials these are.
fn glance(class: Verdict, n: usize, results: &str) -> Glance {
    Glance {
        class,
        sight: Sight::Looked,
        existential: false,
        ours: Some((0.0, None, n)),
        results: results.to_owned(),
        studies: BTreeSet::new(),
    }
}

#[test]
fn readings_that_only_more_instances_tell_apart_are_two_results() {
    let few = glance(NotReproduced, 30, "few");
    let other = glance(NotReproduced, 30, "other");
    let shorter = glance(Reproduced, 500, "shorter");
    let equal = glance(NotReproduced, 500, "equal");
    let seen = [
        (0, &few, Some(&shorter)),
        (1, &few, Some(&equal)),
        (2, &few, None),
        (3, &other, None),
        (4, &few, Some(&equal)),
        (5, &few, Some(&shorter)),
    ];
    let found: Vec<_> =
        results(&seen).into_iter().map(|one| (one.interpretations, one.class, one.n)).collect();
    // What more instances did not look at stays with the first that few instances do not tell from it.
    let expected =
        [(vec![0, 2, 5], Reproduced, 500), (vec![1, 4], NotReproduced, 500), (vec![3], NotReproduced, 30)];
    assert_eq!(found, expected);
    let names: BTreeSet<String> = results(&seen).into_iter().map(|one| one.results).collect();
    assert_eq!(names.len(), 3, "two results have one name: {names:?}");
}
