"""The second judge of the statistics: small cases, and verdicts made wrong on purpose."""

from __future__ import annotations

import copy
import json
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from statistics_judge import classes
from statistics_judge.found import Found
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
    slope,
)
from statistics_judge.judge import CRITERIA, Claim, compare, is_few, recomputed
from statistics_judge.medians import over
from statistics_judge.printed import Printed
from statistics_judge.printed_cells import as_far, level_rank
from statistics_judge.records import Metric, Paper
from statistics_judge.shares import share
from statistics_judge.sizes import of_change, on_bounds

ROOT = Path(__file__).parents[2]
REQUEST = ROOT / "target/replan/crosscheck/statistics.json"
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
            found = share(hits, chances, "a test")
            assert found is not None
            assert found.interval is not None
            assert [end.at for end in found.interval] == pytest.approx(expected, abs=1e-12)
    uneven = np.array([6.0] * 4 + [2.25] * 16)
    low = agreed(uneven, uneven)
    assert low is not None
    assert low[0].at == pytest.approx(1 - 2 * (1 - 0.025**0.05), abs=1e-12)
    assert agreed(np.array([1.0, 1.0]), np.array([2.0, 3.0])) is None


def test_draws_that_agree_between_the_ends_allow_for_those_that_differ() -> None:
    found = agreed(np.full(20, 3.0), np.full(20, 4.0))
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


def test_few_draws_say_nothing_firm_of_a_share_unless_its_interval_is_exact() -> None:
    def is_firm(hits: list[float], chances: list[float]) -> bool:
        found = Found(None, frozenset(), share(np.array(hits), np.array(chances), "a test"))
        return not is_few("share", {}, found)

    assert is_firm([1.0, 0.0, 1.0], [1.0] * 3), "one chance each"
    assert is_firm([4.0] * 3, [4.0] * 3), "all agree at an end"
    assert not is_firm([3.0] * 9, [4.0] * 9), "all agree between the ends"
    assert is_firm([3.0] * 10, [4.0] * 10)
    assert not is_firm([3.0, 2.0, 4.0], [4.0] * 3), "a bootstrap"


def test_one_more_draw_needs_39_draws() -> None:
    assert predictive(np.arange(38.0)) is None
    for draws, outside in [(39, 1), (78, 1), (79, 2), (200, 5)]:
        found = predictive(np.arange(float(draws)))
        assert found is not None
        assert [end.at for end in found] == [outside - 1, draws - outside]


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
    # 80 draws of 80 agree: as few as 95.5 % may (0.955 ** 80 = 0.025), and the others lie at an end.
    assert found[6][0].at == pytest.approx(3.0 - 0.0451 * 10.0, abs=1e-3)
    assert found[6][1].at == pytest.approx(3.0 + 0.0451 * 20.0, abs=1e-3)


def test_no_value_is_no_resample() -> None:
    assert percentile(np.array([np.nan, np.nan]), 2000) is None
    assert bootstrap(ratio_of_sums(np.ones(1), np.ones(1)), 1, "one unit") is None


@pytest.mark.parametrize(
    ("text", "digits", "inside", "outside"),
    [
        ("14.65", "rounded", [14.645, 14.65, 14.655], [14.6449, 14.6551]),
        ("14.65", "truncated", [14.65, 14.6599, 14.65 - 1e-14], [14.6499, 14.66]),
        ("14.65", "unknown", [14.645, 14.6599], [14.6449, 14.66]),
        ("-0.5", "truncated", [-0.5, -0.59], [-0.6, -0.49]),
        ("0.0", "unknown", [-0.09, 0.09], [-0.1, 0.1]),
        ("69", "rounded", [68.5, 69.5], [68.4, 69.6]),
    ],
)
def test_printed_digits_stand_for_what_prints_so(
    text: str, digits: str, inside: list[float], outside: list[float]
) -> None:
    printed = Printed(text, digits)
    assert [printed.agrees(value) for value in inside + outside] == [True] * len(inside) + [False] * len(
        outside
    )


def test_a_row_like_the_draws_is_near_and_an_opposite_one_far() -> None:
    ours = np.array([[m + i * 7 % 21 - 10.0 for m in (10, 50, 90)] for i in range(40)])
    assert as_far(np.array([12.0, 47.0, 93.0]), ours) > 25
    assert as_far(np.array([90.0, 50.0, 10.0]), ours) == 0
    assert level_rank(np.array([99.0, 99.0, 99.0]), ours) == pytest.approx(2 / 41)


def test_zeros_and_failures_are_equal_to_themselves() -> None:
    assert [over(0, 0), over(np.inf, np.inf), over(1, np.inf), over(1, 0)] == [1, 1, 0, np.inf]
    # Sums of the same steps in another order.
    assert over(0.3 + 0.2 + 0.1, 0.1 + 0.2 + 0.3) == 1


def test_rounding_alone_is_no_change_meets_a_margin_and_lies_on_a_bound() -> None:
    one, other = 0.1 + 0.2 + 0.3, 0.3 + 0.2 + 0.1
    for ratio in (one / other, other / one):
        change = 100 * (ratio - 1)
        assert change != 0
        assert of_change(change, change, 0.0, False) == of_change(change, change, 0.0, True) == classes.FAILS
    # A fifth less is a fifth less, though 0.8 - 1 is not -0.2.
    fifth = 100 * (8 / 10 - 1)
    assert fifth > -20
    assert of_change(fifth, fifth, 20.0, False) == classes.HOLDS
    assert of_change(-19.9, -19.9, 20.0, False) == classes.SIGN
    assert on_bounds(one, 0.0, other) == other
    assert on_bounds(other, one, 1.0) == one
    assert on_bounds(one + 1e-6, 0.0, other) == one + 1e-6


def test_what_lowers_a_class_raises_none() -> None:
    holds = classes.of_finding
    assert holds(classes.HOLDS) == "reproduced"
    assert holds(classes.HOLDS, fitted=True) == "fitted"
    assert holds(classes.HOLDS, fitted=True, searched=True) == "attainable"
    assert holds(classes.SIGN, existential=True) == "direction_only"
    assert holds(classes.FAILS, powerless=True) == "not_reproduced"
    for cap in ("powerless", "censored", "clock"):
        assert holds(classes.HOLDS, **{cap: True}) == "undecided"
    assert holds(classes.FAILS, censored=True) == holds(classes.FAILS, clock=True) == "undecided"


def test_parts_combine_by_the_way_they_speak() -> None:
    good, fitted, bad, never, no, lacking = (
        "reproduced", "fitted", "not_reproduced", "impossible", "undecided", "untestable"
    )  # fmt: skip
    for parts, together, any_one, meant in [
        ([good, fitted], fitted, good, fitted),
        ([good, no], no, good, no),
        ([good, bad], bad, good, no),
        ([never, bad], never, bad, bad),
        ([lacking, lacking], lacking, lacking, lacking),
        ([lacking, no], no, no, no),
        ([no, bad], bad, no, no),
    ]:
        found = classes.all_of(parts), classes.any_of(parts), classes.means_one_of(parts)
        assert found == (together, any_one, meant), parts
    assert classes.combined([good, lacking, bad], False) == bad
    assert classes.combined([good, fitted], True) == lacking
    assert classes.combined([], False) == no


@pytest.fixture(scope="module")
def metrics() -> list[Metric]:
    if not REQUEST.is_file():
        pytest.fail(f"{REQUEST}: no such file; `replan crosscheck --statistics` writes it")
    return [Metric(**metric) for metric in json.loads(REQUEST.read_text(encoding="utf-8"))["metrics"]]


Judged = list[tuple[Paper, list[Claim], dict]]


@pytest.fixture(scope="module")
def judged(metrics: list[Metric]) -> Judged:
    """Every paper with what is recomputed of it and what is stored."""
    found = []
    for path in sorted(ROOT.glob("experiments/*/paper.toml")):
        paper = Paper(path.parent, ROOT / "data/runs" / path.parent.name, metrics)
        found.append((paper, recomputed(paper), stored(paper)))
    return found


def stored(paper: Paper) -> dict:
    return tomllib.loads((paper.runs / "verdicts.toml").read_text(encoding="utf-8"))


def wrong_value(finding: dict) -> None:
    finding["ours"]["value"] = finding["ours"]["value"] * 1.0001 + 1e-6


def wrong_n(finding: dict) -> None:
    finding["ours"]["n"] += 1


def wrong_solved(finding: dict) -> None:
    finding["ours"]["solved"][0] -= 1


def wrong_interval(finding: dict) -> None:
    # That of a quarter as many units.
    value, (low, high) = finding["ours"]["value"], finding["ours"]["interval"]
    finding["ours"]["interval"] = [value + 2 * (low - value) - 1e-6, value + 2 * (high - value) + 1e-6]


def wrong_class(finding: dict) -> None:
    finding["verdict"] = "fitted" if finding["verdict"] != "fitted" else "reproduced"


WRONG: dict[str, tuple[Callable[[dict], None], Callable[[dict], bool], str]] = {
    "value": (wrong_value, lambda finding: "ours" in finding, "its value is"),
    "n": (wrong_n, lambda finding: "ours" in finding, "it rests on n"),
    "solved": (wrong_solved, lambda finding: "solved" in finding.get("ours", {}), "solved are"),
    "interval": (wrong_interval, lambda finding: "interval" in finding.get("ours", {}), "its interval is"),
    "class": (wrong_class, lambda finding: finding.get("verdict") is not None, "its class is"),
}

# What some criteria do not give.
WITHOUT = {
    ("exists", "solved"),
    ("exists", "interval"),
    ("least_of", "solved"),
    ("prints_as", "interval"),
    ("row_one_draw", "interval"),
}


def findings(verdicts: dict, criterion: str) -> Iterator[tuple[str, dict]]:
    for claim in verdicts["claim"]:
        for finding in claim.get("finding", []):
            if finding["criterion"] == criterion:
                yield claim["claim"], finding


def test_what_is_stored_agrees(judged: Judged) -> None:
    for paper, claims, verdicts in judged:
        said = compare(paper, claims, verdicts)
        assert said.differ == [], paper.id


@pytest.mark.parametrize("what", WRONG)
@pytest.mark.parametrize("criterion", CRITERIA)
def test_a_criterion_made_wrong_is_noticed(judged: Judged, criterion: str, what: str) -> None:
    spoil, applies, message = WRONG[what]
    spoiled = 0
    for paper, claims, verdicts in judged:
        wrong = copy.deepcopy(verdicts)
        named = set()
        for claim, finding in findings(wrong, criterion):
            if applies(finding):
                spoil(finding)
                named.add(claim)
        said = compare(paper, claims, wrong).differ
        spoiled += len(named)
        for claim in named:
            assert any(f"`{claim}`, finding" in line and message in line for line in said), (claim, said)
    assert (spoiled == 0) == ((criterion, what) in WITHOUT), f"{spoiled} spoiled"


def test_a_claim_of_parts_and_a_claim_made_wrong_are_noticed(judged: Judged) -> None:
    kinds = set()
    for paper, claims, verdicts in judged:
        wrong, wrong_parts = copy.deepcopy(verdicts), copy.deepcopy(verdicts)
        for claim, stored, parts in zip(claims, wrong["claim"], wrong_parts["claim"], strict=True):
            wrong_class(stored)
            if claim.parts:
                wrong_class(parts["finding"][-1])
        said = compare(paper, claims, wrong).differ
        said_of_parts = compare(paper, claims, wrong_parts).differ
        for claim in claims:
            assert any(line.startswith(f"{paper.id}: `{claim.id}`:") for line in said), claim.id
            if claim.parts:
                kinds.add(claim.parts[0])
                assert any(
                    f"`{claim.id}`" in line and f"({claim.parts[0]})" in line for line in said_of_parts
                ), claim.id
    assert kinds == set(classes.PARTS)


def test_findings_that_are_missing_and_other_claims_are_noticed(judged: Judged) -> None:
    paper, claims, verdicts = judged[0]
    wrong = copy.deepcopy(verdicts)
    wrong["claim"][0]["finding"].pop(0)
    assert any("has findings" in line for line in compare(paper, claims, wrong).differ)
    wrong = copy.deepcopy(verdicts)
    wrong["claim"].pop()
    assert any("has other claims" in line for line in compare(paper, claims, wrong).differ)


def test_the_command_ends_with_3_where_something_differs(tmp_path: Path, metrics: list[Metric]) -> None:
    runs = tmp_path / "movingai_sample"
    shutil.copytree(ROOT / "data/runs/movingai_sample", runs)
    paper = {"experiments": str(ROOT / "experiments/movingai_sample"), "runs": str(runs)}
    request = tmp_path / "request.json"
    request.write_text(
        json.dumps({"metrics": [vars(of) for of in metrics], "papers": [paper]}), encoding="utf-8"
    )

    def ask() -> subprocess.CompletedProcess:
        command = [sys.executable, "-m", "statistics_judge", str(request)]
        return subprocess.run(command, cwd=ROOT / "crosscheck", capture_output=True, text=True, check=False)

    assert ask().returncode == 0, ask().stderr
    verdicts = runs / "verdicts.toml"
    text = verdicts.read_text(encoding="utf-8")
    assert "\nvalue = 1.0\n" in text
    verdicts.write_text(text.replace("\nvalue = 1.0\n", "\nvalue = 0.9\n", 1), encoding="utf-8")
    said = ask()
    assert said.returncode == 3, said.stderr
    assert "1 differ" in said.stdout, said.stdout
    assert "its value is 0.9; recomputed it is 1.0" in said.stdout, said.stdout
