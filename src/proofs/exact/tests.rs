use super::*;
use rand::RngExt as _;

fn span(text: &str, digits: Digits) -> Span {
    Print { printed: text.parse().unwrap(), digits }.span()
}

#[test]
fn a_span_holds_exactly_the_values_that_each_rounding_prints_so() {
    // The oracle rounds integers: v in thousandths, printed to tenths.
    let oracle = |v: i64, digits: Digits| -> i64 {
        let down = v.div_euclid(100);
        let rest = v.rem_euclid(100);
        let up = down + i64::from(rest > 0);
        let away = if v >= 0 { down + 1 } else { down };
        let nearest = |tie: i64| match rest.cmp(&50) {
            std::cmp::Ordering::Less => down,
            std::cmp::Ordering::Equal => tie,
            std::cmp::Ordering::Greater => down + 1,
        };
        match digits {
            Digits::HalfUp => nearest(away),
            Digits::HalfEven => nearest(if down % 2 == 0 { down } else { down + 1 }),
            Digits::Floor => down,
            Digits::Ceiling => up,
            _ => {
                if v >= 0 {
                    down
                } else {
                    up
                }
            }
        }
    };
    let ways = [Digits::HalfUp, Digits::HalfEven, Digits::Floor, Digits::Ceiling, Digits::Truncated];
    for v in -700..=700_i64 {
        for digits in ways {
            for units in -8..=8_i64 {
                let print = Print { printed: Printed::from_units(units, 1), digits };
                let is_member = print.span().contains(Exact::new(i128::from(v), 1000));
                assert_eq!(is_member, oracle(v, digits) == units, "{v} as {units} by {digits:?}");
                let any = Print { digits: Digits::Any, ..print };
                assert!(!is_member || any.span().contains(Exact::new(i128::from(v), 1000)));
            }
        }
    }
}

#[test]
fn whole_numbers_at_open_ends_are_left_out() {
    assert_eq!(span("3", Digits::Any).integers(), (3, 3));
    assert_eq!(span("0.5", Digits::Any).integers(), (1, 0));
    assert_eq!(span("0.9", Digits::Any).integers(), (1, 0));
    assert_eq!(span("0.9", Digits::Ceiling).integers(), (1, 0));
    assert_eq!(span("1.0", Digits::Ceiling).integers(), (1, 1));
    assert_eq!(span("-1.5", Digits::Rounded).times(whole(2)).unwrap().integers(), (-3, -3));
    assert_eq!(span("33.3", Digits::Any).has_multiple_of(Exact::new(100, 250)), Some(false));
    assert_eq!(span("33.2", Digits::Any).has_multiple_of(Exact::new(100, 250)), Some(true));
}

#[test]
fn a_quotient_is_what_dividing_members_gives_whatever_the_signs() {
    let ends = [-3, -2, 0, 1, 4].map(|end| Exact::new(end, 2));
    let spans = |is_closed: bool| -> Vec<Span> {
        let pairs = ends.iter().flat_map(|low| ends.iter().map(move |high| (*low, *high)));
        let of = |(low, high)| Span { low, low_closed: is_closed, high, high_closed: true };
        pairs.filter(|(low, high)| low < high || is_closed && low == high).map(of).collect()
    };
    let mut bounded = 0;
    for (a, b) in spans(true).into_iter().flat_map(|a| spans(false).into_iter().map(move |b| (a, b))) {
        let Some(quotient) = a.over(&b) else {
            assert!(b.low <= whole(0) && b.high >= whole(0), "{a:?} over {b:?}");
            continue;
        };
        // Near an end that is no member, a fraction of a thousandth inside.
        let inside = |span: &Span, i: i128| {
            let step = (span.high - span.low) / whole(1000);
            span.low + step * whole(if i == 0 && !span.low_closed { 1 } else { 100 * i })
        };
        let all = (0..=10).flat_map(|i| (0..=10).map(move |j| inside(&a, i) / inside(&b, j)));
        let all: Vec<Exact> = all.collect();
        assert!(all.iter().all(|x| quotient.contains(*x)), "{a:?} over {b:?} is {quotient:?}");
        let near =
            |end: Exact| all.iter().any(|x| *x - end < Exact::new(1, 50) && end - *x < Exact::new(1, 50));
        assert!(near(quotient.low) && near(quotient.high), "{a:?} over {b:?} is {quotient:?}");
        bounded += 1;
    }
    assert!(bounded >= 30, "{bounded}");
}

#[test]
fn a_root_above_is_the_least_of_its_kind() {
    for (a, scale, root) in
        [(whole(2), 100, "1.42"), (whole(4), 10, "2"), (Exact::new(1, 3), 1000, "0.578"), (whole(0), 1, "0")]
    {
        assert_eq!(root_above(a, scale), parse(root));
    }
}

#[test]
fn decimals_and_fractions_are_read_exactly() {
    for (text, value) in
        [("1/64", Some(Exact::new(1, 64))), ("0.25", Some(Exact::new(1, 4))), ("-3", Some(whole(-3)))]
    {
        assert_eq!(parse(text), value, "{text}");
    }
    for text in ["", "1/0", "1/2/3", "x", "1e3"] {
        assert_eq!(parse(text), None, "{text}");
    }
}

#[test]
fn numbers_too_long_for_exact_arithmetic_are_none_and_not_a_panic() {
    let long = Exact::new(i128::MAX, 3);
    assert_eq!(
        (mul(long, long), add(long, Exact::new(i128::MAX, 7)), div(long, whole(0))),
        (None, None, None)
    );
}

#[test]
fn what_64_bits_give_is_what_128_bits_give() {
    let mut stream = base::seed::stream(11);
    let mut draw = || {
        let [above, below] = [0, 1].map(|_| stream.random::<i64>() >> stream.random_range(0..63));
        Exact::new(i128::from(above), i128::from(below.unsigned_abs().max(1)))
    };
    let mut short = 0;
    for _ in 0..20_000 {
        let (a, b) = (draw(), draw());
        let divided = if b == whole(0) { None } else { a.checked_div(&b) };
        assert_eq!(
            [add(a, b), sub(a, b), mul(a, b), div(a, b)],
            [a.checked_add(&b), a.checked_sub(&b), a.checked_mul(&b), divided],
            "{a} and {b}"
        );
        short += u32::from(in_64_bits(a, b, Ratio::checked_mul).is_some());
    }
    assert!((2_000..18_000).contains(&short), "one-sided sample: {short} of 20 000 products fit");
}
