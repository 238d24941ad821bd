use super::*;
use Polarity::{Against, For, Open};

const WAYS: [Polarity; 3] = [For, Open, Against];

/// So many results that hold, are open and contradict, with what the default and the second seed say.
fn results(outcomes: &[Outcome], default: Polarity, second: Polarity) -> Results<'_> {
    let chosen = None;
    let states_size = false;
    let is_unvaried = false;
    Results { outcomes, default, second, chosen, states_size, is_unvaried }
}

fn outcomes([holds, open, fails]: [usize; 3]) -> Vec<Outcome> {
    let many = |outcome, count| std::iter::repeat_n(outcome, count);
    many(Outcome::Holds, holds).chain(many(Outcome::Open, open)).chain(many(Outcome::Fails, fails)).collect()
}

fn verdict_of(counts: [usize; 3], default: Polarity, second: Polarity) -> (Verdict, Line) {
    results(&outcomes(counts), default, second).verdict()
}

/// Every triple up to 20, every default that such results can have, and every second seed.
fn all(mut look: impl FnMut([usize; 3], Polarity, Polarity)) {
    for holds in 0..=20 {
        for open in 0..=20 {
            for fails in 0..=20 {
                for (default, count) in [(For, holds), (Open, open), (Against, fails)] {
                    for second in WAYS.into_iter().filter(|_| count > 0) {
                        look([holds, open, fails], default, second);
                    }
                }
            }
        }
    }
}

fn mirrored(verdict: Verdict) -> Verdict {
    match verdict {
        Verdict::Reproduced => Verdict::NotReproduced,
        Verdict::NotReproduced => Verdict::Reproduced,
        Verdict::Supported => Verdict::NotSupported,
        Verdict::NotSupported => Verdict::Supported,
        same => same,
    }
}

#[test]
fn the_mirror_image_of_a_triple_gets_the_mirrored_verdict() {
    let mut seen = std::collections::BTreeSet::new();
    all(|[holds, open, fails], default, second| {
        let (verdict, line) = verdict_of([holds, open, fails], default, second);
        let (other, other_line) = verdict_of([fails, open, holds], default.mirrored(), second.mirrored());
        assert_eq!(
            (other, other_line),
            (mirrored(verdict), line),
            "{holds}/{open}/{fails} {default:?} {second:?}"
        );
        seen.insert(verdict);
    });
    let expected = [
        Verdict::Reproduced,
        Verdict::Supported,
        Verdict::Depends,
        Verdict::Inconclusive,
        Verdict::NotSupported,
        Verdict::NotReproduced,
    ];
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), expected, "one-sided sample");
}

#[test]
fn one_more_open_result_never_strengthens_a_verdict() {
    all(|[holds, open, fails], default, second| {
        let [before, after] =
            [open, open + 1].map(|open| verdict_of([holds, open, fails], default, second).0);
        // What speaks both ways stays so: open results cannot hide it.
        assert!(
            after.strength() <= before.strength(),
            "{holds}/{open}/{fails} {default:?} {second:?}: {before:?} {after:?}"
        );
    });
}

#[test]
fn nothing_searched_fitted_or_existential_is_ever_for_the_claim() {
    let mut met = 0;
    all(|counts, default, second| {
        let plain = outcomes(counts);
        for chosen in [Chosen::Fitted, Chosen::Searched, Chosen::Existence] {
            let one = Results { chosen: Some(chosen), ..results(&plain, default, second) };
            assert_ne!(one.verdict().0.column(), Column::For, "{counts:?} {default:?} {second:?} {chosen:?}");
            met += usize::from(one.verdict().1 == Line::Met);
        }
        for weak in [Outcome::Fitted, Outcome::Attainable].into_iter().filter(|_| counts[0] > 0) {
            let some: Vec<Outcome> = std::iter::once(weak).chain(plain.iter().copied().skip(1)).collect();
            assert_ne!(results(&some, default, second).verdict().0.column(), Column::For, "{some:?}");
        }
    });
    assert!(met > 1000, "one-sided sample: {met}");
}

#[test]
fn a_choice_that_was_not_varied_caps_a_verdict_at_supported_and_not_supported() {
    all(|counts, default, second| {
        let plain = outcomes(counts);
        let one = Results { is_unvaried: true, ..results(&plain, default, second) };
        let (verdict, line) = results(&plain, default, second).verdict();
        let expected = match verdict {
            Verdict::Reproduced => Verdict::Supported,
            Verdict::NotReproduced => Verdict::NotSupported,
            same => same,
        };
        assert_eq!(one.verdict(), (expected, line), "{counts:?} {default:?} {second:?}");
    });
}

/// A line of the table on a small paper: results, the default, the second seed, the verdict and its line.
#[test]
fn each_line_of_the_table_says_what_it_says() {
    for (counts, default, second, verdict, line) in [
        ([72, 0, 0], For, Open, Verdict::Reproduced, Line::All),
        ([1, 0, 0], For, For, Verdict::Reproduced, Line::All),
        ([9, 0, 1], For, For, Verdict::Reproduced, Line::Nine),
        ([9, 1, 0], For, For, Verdict::Reproduced, Line::Nine),
        ([9, 0, 1], For, Open, Verdict::Depends, Line::Both),
        ([9, 1, 0], For, Open, Verdict::Supported, Line::More),
        ([9, 1, 0], Open, Open, Verdict::Inconclusive, Line::Short),
        ([72, 0, 0], For, Against, Verdict::Inconclusive, Line::SeedDecides),
        ([0, 0, 13], Against, For, Verdict::Inconclusive, Line::SeedDecides),
        ([93, 11, 0], For, Open, Verdict::Supported, Line::More),
        ([0, 10, 51], Against, Against, Verdict::NotSupported, Line::More),
        ([0, 0, 60], Against, Open, Verdict::NotReproduced, Line::All),
        ([1, 0, 60], Against, Against, Verdict::NotReproduced, Line::Nine),
        ([50, 0, 9], For, For, Verdict::Depends, Line::Both),
        ([32, 8, 21], Against, For, Verdict::Inconclusive, Line::SeedDecides),
        ([6, 5, 0], For, For, Verdict::Supported, Line::More),
        ([5, 5, 0], For, For, Verdict::Inconclusive, Line::Short),
        ([2, 12, 0], For, For, Verdict::Inconclusive, Line::Short),
        ([0, 84, 7], Open, Open, Verdict::Inconclusive, Line::Short),
        ([0, 4, 0], Open, Open, Verdict::Inconclusive, Line::Short),
        ([0, 0, 0], Open, Open, Verdict::Inconclusive, Line::Short),
    ] {
        assert_eq!(verdict_of(counts, default, second), (verdict, line), "{counts:?} {default:?} {second:?}");
    }
}

#[test]
fn a_proof_and_what_the_paper_leaves_out_decide_only_under_every_interpretation() {
    use Outcome::{Fails, Holds, Lacking, Proved};
    for (found, verdict, line) in [
        (&[Proved, Proved][..], Verdict::Impossible, Line::Proved),
        (&[Proved, Fails], Verdict::NotReproduced, Line::All),
        (&[Proved, Holds], Verdict::Depends, Line::Both),
        (&[Lacking, Lacking], Verdict::NotTestable, Line::Lacking),
        (&[Lacking, Outcome::Open], Verdict::Inconclusive, Line::Short),
    ] {
        let default = found[0].polarity();
        assert_eq!(results(found, default, Open).verdict(), (verdict, line), "{found:?}");
    }
}

#[test]
fn what_can_be_met_is_met_by_one_result_and_refused_only_by_all() {
    for (counts, second, chosen, verdict, line) in [
        ([1, 43, 0], Open, Chosen::Existence, Verdict::Attainable, Line::Met),
        ([1, 0, 43], Against, Chosen::Searched, Verdict::Attainable, Line::Met),
        ([4, 1, 3], For, Chosen::Fitted, Verdict::Fitted, Line::Met),
        ([20, 0, 0], Against, Chosen::Fitted, Verdict::Inconclusive, Line::Refused),
        ([0, 0, 9], Against, Chosen::Existence, Verdict::NotReproduced, Line::All),
        ([0, 1, 9], Against, Chosen::Searched, Verdict::Inconclusive, Line::NoExample),
        ([0, 7, 0], Open, Chosen::Fitted, Verdict::Inconclusive, Line::NoExample),
    ] {
        let plain = outcomes(counts);
        let default = plain[0].polarity();
        let one = Results { chosen: Some(chosen), ..results(&plain, default, second) };
        assert_eq!(one.verdict(), (verdict, line), "{counts:?} {chosen:?}");
    }
}

#[test]
fn the_sign_alone_is_right_in_direction_only_where_a_size_is_stated() {
    let found = [Outcome::Holds, Outcome::SignOnly];
    for (states_size, verdict) in [(true, Verdict::RightInDirection), (false, Verdict::Reproduced)] {
        let one = Results { states_size, ..results(&found, For, Open) };
        assert_eq!(one.verdict().0, verdict, "states a size: {states_size}");
    }
}

#[test]
fn a_sentence_that_means_one_of_its_parts_depends_where_they_speak_both_ways_and_else_is_the_weakest() {
    use Verdict::{
        Attainable, Depends, Impossible, Inconclusive, NotReproduced, NotTestable, Reproduced, Supported,
    };
    for (meanings, verdict) in [
        (&[Reproduced, NotReproduced][..], Depends),
        (&[Attainable, NotReproduced, Inconclusive], Depends),
        (&[Reproduced, Supported], Supported),
        (&[Reproduced, Inconclusive], Inconclusive),
        (&[NotReproduced, Impossible], NotReproduced),
        (&[NotReproduced, Depends], Depends),
        (&[NotTestable, NotTestable], NotTestable),
        (&[NotTestable, Reproduced], Inconclusive),
        (&[], Inconclusive),
    ] {
        assert_eq!(of_meanings(meanings), verdict, "{meanings:?}");
    }
}

#[test]
fn every_verdict_stands_in_one_column_of_the_overview() {
    let names: Vec<Vec<&str>> = Column::ALL
        .map(|column| {
            Verdict::ALL.iter().filter(|one| one.column() == column).map(|one| one.name()).collect()
        })
        .into();
    assert_eq!(
        names,
        [
            vec!["reproduced", "right in direction", "supported"],
            vec!["attainable", "fitted"],
            vec!["depends"],
            vec!["inconclusive"],
            vec!["not supported", "not reproduced", "impossible"],
            vec!["not testable"],
        ]
    );
}
