"""The intervals of the second judge: exact ones, bootstraps, and units that all agree."""

from __future__ import annotations

import numpy as np
import pytest

from statistics_judge.intervals import (
    End,
    agreed,
    agreed_between,
    agreed_ratio,
    band,
    bootstrap,
    clopper_pearson,
    deviation,
    median,
    percentile,
    predictive,
    ratio_of_sums,
    share_below,
    slope,
)
from statistics_judge.shares import share

SEED = 11


def test_exact_intervals_are_those_that_r_prints() -> None:
    # R: binom.test(3, 4), binom.test(0, 10), binom.test(7, 20).
    for hits, trials, low, high in [
        (3, 4, 0.1941204, 0.9936905),
        (0, 10, 0, 0.3084971),
        (7, 20, 0.1539092, 0.5921885),
    ]:
        found = [end.at for end in clopper_pearson(hits, trials)]
        assert found == pytest.approx([low, high], abs=1e-7)


def test_draws_that_agree_at_an_end_leave_a_root_of_the_tail() -> None:
    for n in (2, 10, 20):
        root = 0.025 ** (1 / n)
        chances = np.full(n, 7.0)
        for hits, expected in ((chances, [root, 1]), (0 * chances, [0, 1 - root])):
            found = share(hits, chances, 7.0, "a test")
            assert found is not None
            assert found.interval is not None
            assert [end.at for end in found.interval] == pytest.approx(expected, abs=1e-12)
    uneven = np.array([6.0] * 4 + [2.25] * 16)
    low = agreed(uneven, uneven, float(uneven.max()))
    assert low is not None
    assert low[0].at == pytest.approx(1 - 2 * (1 - 0.025**0.05), abs=1e-12)
    assert agreed(np.array([1.0, 1.0]), np.array([2.0, 3.0]), 3.0) is None


def test_draws_that_agree_between_the_ends_allow_for_those_that_differ() -> None:
    found = agreed(np.full(20, 3.0), np.full(20, 4.0), 4.0)
    differ = 1 - 0.025**0.05
    assert found is not None
    assert [end.at for end in found] == pytest.approx([0.75 - 0.75 * differ, 0.75 + 0.25 * differ], abs=1e-12)


def test_ratios_and_differences_that_agree_allow_for_draws_that_differ() -> None:
    differ = 1 - 0.025**0.05
    for own, base, expected in [
        (4.0, 8.0, [0.5 - differ, 0.5 + differ]),
        (6.0, 2.0, [3 - 3 * differ, 3 + 3 * differ]),
        (0.0, 2.0, [0.0, differ]),
    ]:
        found = agreed_ratio(np.full(20, own), np.full(20, base))
        assert found is not None
        assert [end.at for end in found] == pytest.approx(expected, abs=1e-12)
    assert agreed_ratio(np.array([1.0, 1.0]), np.array([2.0, 3.0])) is None
    assert agreed_ratio(np.array([1.0]), np.array([2.0])) is None
    curves = np.column_stack([np.full(20, 40.0), np.arange(20.0)])
    (low, high), moved = band(curves, "agreed", (-100, 100))
    assert [low.at, high.at] == pytest.approx([40 - 140 * differ, 40 + 60 * differ], abs=1e-9)
    assert agreed_between(curves[:, 1], -100, 100) is None
    assert moved[0].at < 9.5 < moved[1].at


def test_one_more_draw_needs_39_draws() -> None:
    assert predictive(np.arange(38.0)) is None
    for instances, outside in [(39, 1), (78, 1), (79, 2), (200, 5)]:
        found = predictive(np.arange(float(instances)))
        assert found is not None
        assert [end.at for end in found] == [outside - 1, instances - outside]


def another_interval(sample: np.ndarray, rng: np.random.Generator, level: float = 0.95) -> list[float]:
    """An interval of the mean as a program of another make computes it."""
    means = sample[rng.integers(0, len(sample), (2000, len(sample)))].mean(axis=1)
    return list(np.quantile(means, [(1 - level) / 2, (1 + level) / 2]))


def test_an_interval_agrees_with_other_bootstraps_and_not_with_wrong_ones() -> None:
    rng = np.random.default_rng(SEED)
    refused = 0
    for run in range(20):
        sample = rng.gamma(2.0, size=100)
        own = bootstrap(ratio_of_sums(sample, np.ones(100)), 100, f"run {run}")
        assert own is not None

        def agrees(ends: list[float], own: tuple[End, End] = own) -> bool:
            return all(end.allows(stored) for end, stored in zip(own, ends, strict=True))

        for _ in range(20):
            assert agrees(another_interval(sample, rng)), f"seed {SEED}, run {run}"
        # Another level; twice as many units; an end that is a seventh of the width too low.
        low, high = another_interval(sample, rng)
        assert not agrees(another_interval(sample, rng, 0.85)), f"seed {SEED}, run {run}"
        assert not agrees(another_interval(np.repeat(sample, 2), rng)), f"seed {SEED}, run {run}"
        refused += not agrees([low - 0.15 * (high - low), high])
    assert refused >= 18, f"seed {SEED}: {refused} of 20"


def test_statistics_of_resamples_are_those_of_the_cases_drawn() -> None:
    rng = np.random.default_rng(SEED)
    unit = np.array([0, 0, 1, 2, 2, 2, 3])
    x, y = rng.normal(size=7), rng.normal(size=7)
    y_failed = np.where(np.arange(7) == 3, np.inf, y)
    weights = rng.multinomial(4, [0.25] * 4, size=200)
    found = [of(weights) for of in (median(unit, y_failed), deviation(unit, 4, y), slope(unit, 4, x, y))]
    for row, times in enumerate(weights):
        drawn = np.repeat(np.arange(7), times[unit])
        ordered = np.sort(y_failed[drawn])
        middle = ordered[(len(drawn) - 1) // 2] / 2 + ordered[len(drawn) // 2] / 2
        assert found[0][row] == pytest.approx(middle)
        for below in (0.25, 0.75, 0.95):
            own = share_below(unit, y, below)(times[None, :])[0]
            assert own == pytest.approx(np.quantile(y[drawn], below)), f"seed {SEED}, row {row}"
        if len(drawn) > 1:
            assert found[1][row] == pytest.approx(np.std(y[drawn], ddof=1))
        if np.ptp(x[drawn]) > 0:
            assert found[2][row] == pytest.approx(np.polyfit(x[drawn], y[drawn], 1)[0])


def test_a_simultaneous_band_is_wider_than_an_interval_and_allows_for_draws_that_differ_where_all_agree() -> (
    None
):
    rng = np.random.default_rng(SEED)
    curves = np.column_stack([rng.normal(size=(80, 6)), np.full(80, 3.0)])
    found = band(curves, "band", (-7.0, 23.0))
    alone = bootstrap(ratio_of_sums(curves[:, 0], np.ones(80)), 80, "alone")
    assert alone is not None
    assert found[0][1].at - found[0][0].at > 1.2 * (alone[1].at - alone[0].at)
    # 80 instances of 80 agree: as few as 95.5 % may (0.955 ** 80 = 0.025), and the others lie at an end.
    assert found[6][0].at == pytest.approx(3.0 - 0.0451 * 10.0, abs=1e-3)
    assert found[6][1].at == pytest.approx(3.0 + 0.0451 * 20.0, abs=1e-3)


def test_no_value_is_no_resample() -> None:
    assert percentile(np.array([np.nan, np.nan])) is None
    assert bootstrap(ratio_of_sums(np.ones(1), np.ones(1)), 1, "one unit") is None
