use super::*;

/// A claim of this class, a part of a sentence or a theorem if so wanted.
fn judged(verdict: Verdict, is_part: bool, is_theorem: bool) -> ClaimVerdict {
    let text = "claim = 'a'\nat = 'here'\nverdict = 'reproduced'\nreading = 'default'";
    let one: ClaimVerdict = toml::from_str(text).unwrap();
    let said = |is: bool| is.then(|| "so".to_owned());
    ClaimVerdict { verdict, part_of: said(is_part), theorem: said(is_theorem), ..one }
}

#[test]
fn of_any_two_claims_those_count_that_are_no_parts_and_no_theorems() {
    let kinds = [[false, false], [false, true], [true, false], [true, true]];
    let all =
        Verdict::ALL.into_iter().flat_map(|one| kinds.map(|[part, theorem]| judged(one, part, theorem)));
    let all: Vec<ClaimVerdict> = all.collect();
    let text = "paper = 'a'\ncommand = ''\nquick = false\nreading = {}\nmeanings = ''";
    let mut verdicts: Verdicts = toml::from_str(text).unwrap();
    for (one, two) in all.iter().flat_map(|one| all.iter().map(move |two| (one, two))) {
        verdicts.claims = vec![one.clone(), two.clone()];
        let tally = verdicts.tally();
        let is_whole = |claim: &&ClaimVerdict| claim.part_of.is_none() && claim.theorem.is_none();
        let whole: Vec<&ClaimVerdict> = [one, two].into_iter().filter(is_whole).collect();
        assert_eq!((tally[0], tally[1..].iter().sum()), (whole.len(), whole.len()), "{one:?} {two:?}");
        for (place, class) in Verdict::ALL.into_iter().enumerate() {
            let count = whole.iter().filter(|claim| claim.verdict == class).count();
            assert_eq!(tally[place + 1], count, "{class:?}: {one:?} {two:?}");
        }
        let is_violated = |claim: &&ClaimVerdict| {
            let broken = [Verdict::NotReproduced, Verdict::Impossible, Verdict::DirectionOnly];
            claim.theorem.is_some() && broken.contains(&claim.verdict)
        };
        let violated = [one, two].into_iter().filter(is_violated).count();
        assert_eq!(verdicts.violated().len(), violated, "{one:?} {two:?}");
    }
}
