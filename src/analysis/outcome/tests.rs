use super::*;

/// Every pair of outcomes.
fn pairs() -> impl Iterator<Item = [Outcome; 2]> {
    Outcome::ALL.into_iter().flat_map(|one| Outcome::ALL.into_iter().map(move |two| [one, two]))
}

#[test]
fn of_any_two_findings_a_proof_wins_then_what_is_against_then_what_is_open_then_the_weakest() {
    for pair in pairs() {
        let all = combined(pair, false);
        assert_eq!(all, combined([pair[1], pair[0]], false), "{pair:?}: the order does not count");
        assert!(pair.contains(&all), "{pair:?}: nothing is made up");
        let least = pair.into_iter().map(Outcome::polarity).min().unwrap();
        assert_eq!(all.polarity(), least, "{pair:?}");
        if pair.contains(&Outcome::Proved) {
            assert_eq!(all, Outcome::Proved, "{pair:?}");
        }
        if least == Polarity::For {
            assert_eq!(all, pair[0].max(pair[1]), "{pair:?}: the weaker of two for it");
        }
    }
}

#[test]
fn what_the_paper_leaves_out_yields_to_what_speaks_against_it_and_to_nothing_else() {
    for outcome in Outcome::ALL {
        let expected = if outcome.polarity() == Polarity::Against { outcome } else { Outcome::Lacking };
        assert_eq!(combined([outcome], true), expected, "{outcome:?}");
    }
    assert_eq!(combined([], true), Outcome::Lacking);
    assert_eq!(combined([], false), Outcome::Open, "what was only checked for possibility");
}

#[test]
fn a_sentence_of_two_parts_takes_the_least_or_the_greatest_of_them() {
    for pair in pairs() {
        let polarities = pair.map(Outcome::polarity);
        let all = all_of(&pair);
        let any = any_of(&pair);
        assert_eq!(all.polarity(), polarities[0].min(polarities[1]), "all of {pair:?}");
        assert_eq!(any.polarity(), polarities[0].max(polarities[1]), "any of {pair:?}");
        for (whole, takes) in [(all, Outcome::max as fn(_, _) -> _), (any, Outcome::min)] {
            if polarities == [Polarity::For; 2] {
                assert_eq!(whole, takes(pair[0], pair[1]), "{pair:?}");
            }
        }
        let lacking = pair == [Outcome::Lacking; 2];
        assert_eq!(
            all == Outcome::Lacking,
            lacking
                || (
                    all.polarity(),
                    polarities.contains(&Polarity::For),
                    pair.contains(&Outcome::Lacking),
                    pair.contains(&Outcome::Open)
                ) == (Polarity::Open, true, true, false),
            "{pair:?}"
        );
    }
    assert_eq!([all_of(&[]), any_of(&[])], [Outcome::Open; 2]);
}

#[test]
fn parts_of_which_one_is_meant_decide_nothing_unless_they_speak_one_way() {
    for pair in pairs() {
        let [one, two] = pair.map(Outcome::polarity);
        let meant = one_meant(&pair);
        let expected = if one == two { one } else { Polarity::Open };
        assert_eq!(meant.polarity(), expected, "{pair:?}");
        if one == two && one == Polarity::For {
            assert_eq!(meant, pair[0].max(pair[1]), "the weaker of two for it: {pair:?}");
        }
        let is_proved = pair == [Outcome::Proved; 2];
        assert_eq!(meant == Outcome::Proved, is_proved, "impossible only if each is: {pair:?}");
    }
}

const OUTCOMES: [Outcome; 5] =
    [Outcome::Holds, Outcome::SignOnly, Outcome::Open, Outcome::Fails, Outcome::Proved];

/// Every combination of what lowers an outcome.
fn caps() -> impl Iterator<Item = Caps> {
    let clocks = [
        None,
        Some(Sessions::TooFew),
        Some(Sessions::Disagree),
        Some(Sessions::Agree),
        Some(Sessions::OfAnother),
    ];
    (0..=255_u8).flat_map(move |bits| {
        let has = move |bit: u8| bits >> bit & 1 == 1;
        clocks.into_iter().map(move |clock| Caps {
            searched: has(0),
            fitted: has(1),
            existential: has(2),
            powerless: has(3),
            censored: has(4),
            without_premises: has(5),
            few: has(6),
            not_run: has(7),
            clock,
        })
    })
}

#[test]
fn nothing_raises_an_outcome_and_nothing_turns_its_sign() {
    for outcome in OUTCOMES {
        let bare = of_finding(outcome, Caps::default()).unwrap();
        for caps in caps() {
            let Some(verdict) = of_finding(outcome, caps) else {
                assert!(caps.without_premises, "{outcome:?} {caps:?}");
                continue;
            };
            assert!(verdict == bare || verdict.polarity() == Polarity::Open || verdict > bare, "{caps:?}");
            let turned = (verdict.polarity(), bare.polarity());
            let opposite = [(Polarity::For, Polarity::Against), (Polarity::Against, Polarity::For)];
            assert!(!opposite.contains(&turned), "{outcome:?} {caps:?}");
        }
    }
}

/// What a cap makes of what holds, of what holds in sign alone, and of what fails.
const CAPPED: [(Caps, [Outcome; 3]); 13] = {
    use Outcome::{Attainable, Fails, Fitted, Holds, Lacking, Open, SignOnly};
    const NONE: Caps = Caps {
        searched: false,
        fitted: false,
        existential: false,
        powerless: false,
        censored: false,
        few: false,
        clock: None,
        without_premises: false,
        not_run: false,
    };
    const OPEN: [Outcome; 3] = [Open; 3];
    [
        (NONE, [Holds, SignOnly, Fails]),
        (Caps { searched: true, ..NONE }, [Attainable, Open, Fails]),
        (Caps { existential: true, ..NONE }, [Attainable, SignOnly, Fails]),
        (Caps { fitted: true, ..NONE }, [Fitted, Open, Fails]),
        (Caps { fitted: true, searched: true, ..NONE }, [Attainable, Open, Fails]),
        (Caps { powerless: true, ..NONE }, [Open, Open, Fails]),
        (Caps { censored: true, ..NONE }, OPEN),
        (Caps { few: true, ..NONE }, OPEN),
        (Caps { not_run: true, ..NONE }, OPEN),
        (Caps { clock: Some(Sessions::TooFew), ..NONE }, OPEN),
        (Caps { clock: Some(Sessions::Disagree), ..NONE }, OPEN),
        (Caps { clock: Some(Sessions::Agree), ..NONE }, [Holds, SignOnly, Fails]),
        (Caps { clock: Some(Sessions::OfAnother), ..NONE }, [Lacking; 3]),
    ]
};

#[test]
fn each_cap_does_what_it_says() {
    for (caps, expected) in CAPPED {
        let found = |outcome| of_finding(outcome, caps).unwrap();
        let measured = [Outcome::Holds, Outcome::SignOnly, Outcome::Fails].map(found);
        assert_eq!(measured, expected, "{caps:?}");
        let is_of_another = caps.clock == Some(Sessions::OfAnother);
        let open = if is_of_another { Outcome::Lacking } else { Outcome::Open };
        assert_eq!(found(Outcome::Open), open, "{caps:?}");
        assert_eq!(found(Outcome::Proved), Outcome::Proved, "no measurement lowers a proof: {caps:?}");
    }
    let elsewhere = Caps { without_premises: true, ..Caps::default() };
    for outcome in OUTCOMES {
        assert_eq!(of_finding(outcome, elsewhere), None, "{outcome:?} counts where the claim is meant");
    }
}
