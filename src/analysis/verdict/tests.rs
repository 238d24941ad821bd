use super::*;
use crate::analysis::verdict_rule::Column;

/// A claim of this verdict, a part of a sentence or a theorem if so wanted.
fn judged(verdict: Verdict, is_part: bool, is_theorem: bool) -> ClaimVerdict {
    let text =
        "claim = 'a'\nat = 'here'\nverdict = 'reproduced'\noutcome = 'holds'\ninterpretation = 'default'";
    let one: ClaimVerdict = toml::from_str(text).unwrap();
    let text = |is: bool| is.then(|| "so".to_owned());
    ClaimVerdict { verdict, part_of: text(is_part), theorem: text(is_theorem), ..one }
}

/// Claims as they stand in a file.
fn verdicts(claims: Vec<ClaimVerdict>) -> Verdicts {
    let text = "paper = 'a'\ncommand = ''\nquick = false\ninterpretation = {}\nmeanings = ''";
    Verdicts { claims, ..toml::from_str(text).unwrap() }
}

#[test]
fn of_any_two_claims_those_count_that_are_no_parts_and_no_theorems() {
    let kinds = [[false, false], [false, true], [true, false], [true, true]];
    let all =
        Verdict::ALL.into_iter().flat_map(|one| kinds.map(|[part, theorem]| judged(one, part, theorem)));
    let all: Vec<ClaimVerdict> = all.collect();
    for (one, two) in all.iter().flat_map(|one| all.iter().map(move |two| (one, two))) {
        let tally = verdicts(vec![one.clone(), two.clone()]).tally();
        let is_whole = |claim: &&ClaimVerdict| claim.part_of.is_none() && claim.theorem.is_none();
        let whole: Vec<&ClaimVerdict> = [one, two].into_iter().filter(is_whole).collect();
        assert_eq!(tally.iter().sum::<usize>(), whole.len(), "{one:?} {two:?}");
        for (place, column) in Column::ALL.into_iter().enumerate() {
            let count = whole.iter().filter(|claim| claim.verdict.column() == column).count();
            assert_eq!(tally[place], count, "{column:?}: {one:?} {two:?}");
        }
    }
}

#[test]
fn a_theorem_is_violated_by_what_contradicts_it_and_by_its_sign_alone() {
    for outcome in Outcome::ALL {
        let broken = [Outcome::Fails, Outcome::Proved, Outcome::SignOnly].contains(&outcome);
        for is_theorem in [true, false] {
            let one = ClaimVerdict { outcome, ..judged(Verdict::Inconclusive, false, is_theorem) };
            let violated = verdicts(vec![one]).violated().len();
            assert_eq!(violated, usize::from(broken && is_theorem), "{outcome:?} {is_theorem}");
        }
    }
}

#[test]
fn a_seed_that_moves_nothing_says_so_in_place_of_its_outcome() {
    let one = |is_seedless| {
        let beside = vec!["same under all 3".to_owned()];
        ClaimVerdict {
            second: Some(Outcome::Holds),
            is_seedless,
            beside,
            ..judged(Verdict::Reproduced, false, false)
        }
    };
    assert_eq!(one(false).beside_with_seed().unwrap(), "same under all 3; second seed: holds");
    assert_eq!(one(true).beside_with_seed().unwrap(), "same under all 3; the seed moves nothing");
    for (p, words) in [(0.108_21, "holds, p = 0.108"), (3e-9, "holds, p below 0.0001")] {
        let joint = ClaimVerdict { second_p: Some(p), ..one(false) };
        assert_eq!(joint.beside_with_seed().unwrap(), format!("same under all 3; second seed: {words}"));
    }
}
