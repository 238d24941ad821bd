"""Trials that did not come to an end: what they would have given is not known."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statistics_judge import shares, sizes
from statistics_judge.classes import FAILS, HOLDS
from statistics_judge.found import Found, hangs
from statistics_judge.selection import Cases

SPENT, NONE = "budget_spent", "no_path"
Ends = list[tuple[float | str, float | str]]


def asked(ends: Ends, settings: dict[str, Any]) -> SimpleNamespace:
    """A claim about one draw for each of these ends of both contenders."""
    status = [end if isinstance(end, str) else "solved" for pair in ends for end in pair]
    values = np.array([np.nan if isinstance(end, str) else end for pair in ends for end in pair])
    study = SimpleNamespace(
        status=np.array(status), solved=np.array(status) == "solved", values=lambda metric, session: values
    )
    place = np.arange(len(ends))
    metric = SimpleNamespace(better="lower", name="cost")
    cases = Cases(study, metric, 1, "B", 2 * place, 2 * place + 1, place, np.zeros(len(ends), dtype=int))
    return SimpleNamespace(cases=lambda: cases, settings=settings, seed="a test")


def firm(found: Found) -> bool:
    """Whether an outcome does not hang on what did not end."""
    return found.censored == {False}


@pytest.mark.parametrize(
    ("statistic", "accepted", "outcome"),
    [("mean", [90, 110], HOLDS), ("deviation", [5, 15], HOLDS), ("mean", [0, 40], FAILS)],
)
def test_a_statistic_of_one_contender_hangs_on_what_did_not_end(
    statistic: str, accepted: list[float], outcome: str
) -> None:
    ends: Ends = [(90.0, 1.0), (110.0, 1.0)] * 15
    settings = {"statistic": statistic, "accepted": accepted}
    whole, cut = (sizes.within(asked(ends + more, settings)) for more in ([], [(SPENT, 1.0)]))
    assert (whole.outcome, cut.outcome, firm(whole)) == (outcome, outcome, True)
    # However far away the one is, the mean of the others keeps it above 40.
    assert firm(cut) == (outcome == FAILS)


def test_means_that_would_miss_on_either_side_may_be_met_between() -> None:
    ends: Ends = [(90.0, 1.0)] * 30
    settings = {"statistic": "mean", "accepted": [100, 120]}
    assert firm(sizes.within(asked(ends, settings)))
    assert not firm(sizes.within(asked(ends + [(SPENT, 1.0)] * 5, settings)))


def test_a_counterexample_is_one_whatever_else_did_not_end_and_equal_cases_are_none() -> None:
    equal, cut, wrong = (5.0, 5.0), (SPENT, 5.0), (6.0, 5.0)
    for criterion, settings in [(shares.on_every, {"that": "lower"}), (shares.equals, {})]:
        assert firm(criterion(asked([equal] * 9, settings)))
        assert not firm(criterion(asked([equal] * 9 + [cut], settings)))
        found = criterion(asked([equal] * 9 + [cut, wrong], settings))
        assert (found.outcome, firm(found)) == (FAILS, True)


def test_what_chance_decides_hangs_both_ways() -> None:
    one, two = frozenset([HOLDS]), frozenset([HOLDS, FAILS])
    assert hangs(HOLDS, one, []) == hangs(HOLDS, one, [one]) == {False}
    assert hangs(HOLDS, one, [frozenset([FAILS])]) == {True}
    assert hangs(HOLDS, one, [two]) == {True, False}
