use super::*;

fn compared(ends: [f64; 2]) -> Compared {
    let ratio = ends[0].midpoint(ends[1]);
    let medians = [ratio, 1.0];
    Compared { name: "a".to_owned(), medians, ratio, ends, n: 20, inclusion: Inclusion::Open, keeps: true }
}

#[test]
fn what_lies_above_the_margin_for_certain_is_no_longer_undecided() {
    let (half, any) = (0.5, 1.0);
    for (ends, limit, expected) in [
        ([0.40, 0.45], half, Verdict::Reproduced),
        ([0.45, 0.55], half, Verdict::Undecided),
        ([0.51, 0.53], half, Verdict::DirectionOnly),
        // Nowhere near one half, and not even certainly less: contradicted, not undecided.
        ([0.94, 1.03], half, Verdict::NotReproduced),
        ([1.0, 1.0], any, Verdict::NotReproduced),
        ([0.98, 1.02], any, Verdict::Undecided),
    ] {
        assert_eq!(verdict(&[compared(ends)], limit), expected, "{ends:?} against {limit}");
    }
    let mixed = [compared([0.40, 0.45]), compared([1.01, 1.02])];
    assert_eq!(verdict(&mixed, half), Verdict::NotReproduced);
    let broken = Compared { keeps: false, ..compared([0.40, 0.45]) };
    assert_eq!(verdict(&[broken], half), Verdict::Undecided);
}

#[test]
fn a_straddling_interval_says_how_many_seeds_would_decide_it() {
    // Half width 0.05 from 20 seeds, 0.01 from the limit: 25 times as many.
    let straddling = Compared { ratio: 0.49, ..compared([0.44, 0.54]) };
    let said = needed(&straddling, 0.5).unwrap();
    assert!(said.contains("about 500 seeds, not 20"), "{said}");
    assert!(needed(&compared([0.40, 0.45]), 0.5).is_none());
}

#[test]
fn zeros_and_failures_are_equal_to_themselves() {
    assert_eq!([ratio(0.0, 0.0), ratio(f64::INFINITY, f64::INFINITY), ratio(1.0, 2.0)], [1.0, 1.0, 0.5]);
    assert_eq!([ratio(1.0, f64::INFINITY), ratio(1.0, 0.0)], [0.0, f64::INFINITY]);
}
