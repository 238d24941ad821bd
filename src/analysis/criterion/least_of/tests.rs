use super::*;

fn compared(ends: [f64; 2]) -> Number {
    let interval = Some(Interval::new(ends[0], ends[1]));
    Number { value: Some(ends[0].midpoint(ends[1])), interval, ..Number::default() }
}

#[test]
fn what_lies_above_the_margin_for_certain_is_no_longer_undecided() {
    let half = 0.5;
    let any = 1.0;
    for (ends, limit, expected) in [
        ([0.40, 0.45], half, Outcome::Holds),
        ([0.45, 0.55], half, Outcome::Open),
        ([0.51, 0.53], half, Outcome::SignOnly),
        // Nowhere near one half, and not even certainly less: contradicted, not inconclusive.
        ([0.94, 1.03], half, Outcome::Fails),
        ([1.0, 1.0], any, Outcome::Fails),
        ([0.98, 1.02], any, Outcome::Open),
    ] {
        assert_eq!(outcome(&[&compared(ends)], limit), expected, "{ends:?} against {limit}");
    }
    let mixed = [compared([0.40, 0.45]), compared([1.01, 1.02])];
    assert_eq!(outcome(&[&mixed[0], &mixed[1]], half), Outcome::Fails);
    let broken = Number { above: 1, ..compared([0.40, 0.45]) };
    assert_eq!(outcome(&[&broken], half), Outcome::Fails, "a theorem that does not hold is no open question");
}

#[test]
fn zeros_and_failures_are_equal_to_themselves() {
    assert_eq!([ratio(0.0, 0.0), ratio(f64::INFINITY, f64::INFINITY), ratio(1.0, 2.0)], [1.0, 1.0, 0.5]);
    assert_eq!([ratio(1.0, f64::INFINITY), ratio(1.0, 0.0)], [0.0, f64::INFINITY]);
}

#[test]
fn sums_of_the_same_steps_in_another_order_are_equal() {
    let steps = [0.1, 0.2, 0.3];
    let sum = |sum: f64, step: &f64| sum + step;
    let (forth, back) = (steps.iter().fold(0.0, sum), steps.iter().rfold(0.0, sum));
    assert!(back < forth, "{back} and {forth}: nothing is tried");
    assert_eq!([ratio(back, forth), ratio(forth, back)], [1.0, 1.0]);
    let found = outcome(&[&compared([ratio(back, forth); 2])], 1.0);
    assert_eq!(found, Outcome::Fails, "equal is not less");
}
