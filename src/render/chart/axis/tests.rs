use super::*;

fn labels(axis: &Axis, length_pt: f64, sideways: bool) -> Vec<String> {
    axis.ticks(length_pt, sideways)
        .into_iter()
        .map(|tick| tick.label)
        .filter(|label| !label.is_empty())
        .collect()
}

#[test]
fn ticks_are_round_numbers_inside_the_axis() {
    let cases = [
        (0.0, 1.0, 150.0, vec!["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]),
        (-1.0, 1.0, 110.0, vec!["−1.0", "−0.5", "0.0", "0.5", "1.0"]),
        (13.1, 17.9, 150.0, vec!["14", "15", "16", "17"]),
        (0.0, 21_000.0, 150.0, vec!["0", "5000", "10\u{2009}000", "15\u{2009}000", "20\u{2009}000"]),
    ];
    for (low, high, length_pt, expected) in cases {
        let axis = Axis::linear("x", low, high).unwrap();
        assert_eq!(labels(&axis, length_pt, true), expected, "{low} to {high}");
    }
}

#[test]
fn tick_labels_never_run_into_each_other() {
    for length_pt in (40..400).map(f64::from) {
        for (low, high) in [(0.0, 1.0), (-1234.5, 8e6), (0.001, 0.0042), (99_999.0, 100_001.0)] {
            let axis = Axis::linear("x", low, high).unwrap();
            let ticks = axis.ticks(length_pt, true);
            let half = |tick: &Tick| Type::regular(TextSize::TICK).width_pt(&tick.label) / 2.0;
            for pair in ticks.windows(2) {
                let apart = (axis.share(pair[1].at) - axis.share(pair[0].at)) * length_pt;
                let clear = apart >= half(&pair[0]) + half(&pair[1]) + 5.0;
                assert!(clear || length_pt < 110.0, "{low} to {high} on {length_pt}: {ticks:?}");
            }
            assert!(
                ticks.iter().all(|tick| (-1e-9..=1.0 + 1e-9).contains(&axis.share(tick.at))),
                "{ticks:?}"
            );
        }
    }
}

#[test]
fn a_short_log_axis_names_2_and_5_beside_the_decades() {
    let wide = Axis::log("x", 1.0, 1e6).unwrap();
    assert_eq!(labels(&wide, 200.0, true), ["1", "10", "100", "1000", "10⁴", "10⁵", "10⁶"]);
    let narrow = Axis::log("x", 0.5, 20.0).unwrap();
    assert_eq!(labels(&narrow, 200.0, true), ["0.5", "1", "2", "5", "10", "20"]);
    assert!((wide.share(1e3) - 0.5).abs() < 1e-12);
}

#[test]
fn numbers_have_true_minus_signs_and_no_negative_zero() {
    let cases = [
        (-2.5, 1, "−2.5"),
        (-0.04, 1, "0.0"),
        (1500.0, 0, "1500"),
        (-1_234_567.0, 0, "−1\u{2009}234\u{2009}567"),
    ];
    for (value, decimals, expected) in cases {
        assert_eq!(number(value, decimals), expected);
    }
}

#[test]
fn ends_that_cannot_be_drawn_are_refused_with_what_would_be() {
    for (low, high) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let message = Axis::linear("length / m", low, high).unwrap_err().to_string();
        assert!(
            message.contains("`length / m`") && message.contains("rise between finite ends"),
            "{message}"
        );
    }
    assert!(Axis::log("n", 0.0, 1.0).unwrap_err().to_string().contains("above 0"));
}

#[test]
fn a_reversed_axis_mirrors_shares() {
    let axis = Axis::linear("x", 0.0, 4.0).unwrap();
    let mirrored = Axis::linear("x", 0.0, 4.0).unwrap().reversed();
    assert_eq!(axis.share(1.0), 0.25);
    assert_eq!(mirrored.share(1.0), 0.75);
    assert_eq!(mirrored.ticks(100.0, true).len(), axis.ticks(100.0, true).len());
}

#[test]
fn an_axis_over_values_holds_them_all_even_if_there_is_one_or_none() {
    for values in [vec![3.0], vec![], vec![f64::INFINITY, 2.0, 5.0], vec![0.0]] {
        let axis = Axis::over("x", values.iter().copied());
        for value in values.into_iter().filter(|value| value.is_finite()) {
            assert!((0.0..=1.0).contains(&axis.share(value)), "{value} on {axis:?}");
        }
        assert!(axis.ends()[0] < axis.ends()[1]);
    }
}

#[test]
fn plotters_puts_values_where_shares_put_them_and_its_key_points_are_ticks() {
    let linear = |low, high| Axis::linear("x", low, high).unwrap();
    let log = Axis::log("x", 0.5, 20.0).unwrap();
    for axis in
        [linear(-0.5, 0.5), linear(0.2, 1.4), log.clone(), log.reversed(), Axis::names("", ["a", "b"])]
    {
        let points = axis.key_points(11);
        assert!((2..=30).contains(&points.len()), "{axis:?}: {points:?}");
        for value in points {
            for (from, to) in [(1000, 9000), (9000, 1000)] {
                let exact = f64::from(from) + axis.share(value) * f64::from(to - from);
                let found = axis.map(&value, (from, to));
                assert!((f64::from(found) - exact).abs() <= 0.5, "{axis:?} puts {value} at {found}");
            }
        }
    }
    assert_eq!(linear(-0.5, 0.5).key_points(2), [-0.5, 0.0, 0.5], "ends are not lost to rounding");
    assert_eq!(
        linear(0.0, 1.0).map(&f64::INFINITY, (0, 100)),
        i32::MAX,
        "far off the frame, not on its edge"
    );
}
