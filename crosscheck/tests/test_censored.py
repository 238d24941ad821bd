"""Trials that did not come to an end: what they would have given is not known."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statistics_judge import printed_cells, shares, sizes
from statistics_judge.classes import FAILS, HOLDS
from statistics_judge.found import Found, hangs
from statistics_judge.judge import is_few, selections_of
from statistics_judge.printed import Printed
from statistics_judge.records import Metric
from statistics_judge.selection import Cases, matched, select

SPENT, NONE, REFUSED = "budget_spent", "no_path", "rejected"
Ends = list[tuple[float | str, float | str]]
COST = Metric("cost", "cost", 1.0, None, "lower", clock=False, status=False)


def asked(ends: Ends, settings: dict[str, Any]) -> SimpleNamespace:
    """A claim about one instance for each of these ends of both contenders."""
    status = [end if isinstance(end, str) else "solved" for pair in ends for end in pair]
    values = np.array([np.nan if isinstance(end, str) else end for pair in ends for end in pair])
    study = SimpleNamespace(
        status=np.array(status),
        solved=np.array(status) == "solved",
        values=lambda metric, session: values,
        column=lambda name: np.repeat(np.arange(float(len(ends))), 2),
        groups=["g", "h"],
        spec={"problems": [{"label": "g", "family": "grid_map"}, {"label": "h", "family": "random_cells"}]},
    )
    place = np.arange(len(ends))
    metric = COST
    cases = Cases(study, metric, 1, "B", 2 * place, 2 * place + 1, place, np.zeros(len(ends), dtype=int))
    settings = {"select": {"problems": ["g"]}, **settings}
    return SimpleNamespace(cases=lambda **other: cases, settings=settings, seed="a test", paper=None)


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


def test_one_solves_more_of_an_instance_unless_what_the_other_left_unended_is_solved() -> None:
    of = asked([(1.0, SPENT), (1.0, 1.0), (NONE, 1.0)], {"hits": "solved_more"})
    for given, expected in [(None, [1, 0, 0]), (True, [1, 0, 0]), (False, [0, 0, 0])]:
        hits, chances = shares.by_unit(of, of.cases(), given)
        assert (list(hits), list(chances)) == (expected, [1, 1, 1])


def test_an_instance_solves_at_least_so_much_of_its_cases() -> None:
    ends: Ends = [(1.0, NONE), (NONE, NONE), (SPENT, NONE), (1.0, NONE), (1.0, NONE)]
    of = asked(ends, {"hits": "solved_at_least", "bound": 0.75})
    cases = of.cases()
    cases.unit, cases.units = np.array([0, 0, 1, 1, 1]), 2
    for given, expected in [(None, [0, 0]), (True, [0, 1]), (False, [0, 0])]:
        hits, chances = shares.by_unit(of, cases, given)
        assert (list(hits), list(chances)) == (expected, [1, 1])


def test_one_solves_more_throughout_only_if_it_does_at_every_point() -> None:
    of = asked(
        [(1.0, NONE), (1.0, NONE), (1.0, NONE), (1.0, 1.0), (1.0, SPENT)], {"hits": "solved_more_throughout"}
    )
    cases = of.cases()
    cases.unit, cases.units = np.array([0, 0, 1, 1, 2]), 3
    cases.study.sweep = (np.repeat([0, 1, 0, 1, 0], 2), ["n=1", "n=2"])
    for given, expected in [(None, [1, 0, 1]), (False, [1, 0, 0])]:
        hits, chances = shares.by_unit(of, cases, given)
        assert (list(hits), list(chances)) == (expected, [1, 1, 1])


def test_what_is_cured_is_a_share_of_failures_that_ended() -> None:
    of = asked(
        [(1.0, NONE), (NONE, REFUSED), (1.0, 1.0), (1.0, SPENT), (SPENT, 1.0), (SPENT, NONE)],
        {"hits": "cured"},
    )
    for given, expected in [
        (None, ([1, 0, 0, 0, 0, 0], [1, 1, 0, 0, 0, 1])),
        (True, ([1, 0, 0, 1, 0, 1], [1, 1, 0, 1, 0, 1])),
    ]:
        hits, chances = shares.by_unit(of, of.cases(), given)
        assert (list(hits), list(chances)) == expected


def test_what_chance_decides_hangs_both_ways() -> None:
    one, two = frozenset([HOLDS]), frozenset([HOLDS, FAILS])
    assert hangs(HOLDS, one, []) == hangs(HOLDS, one, [one]) == {False}
    assert hangs(HOLDS, one, [frozenset([FAILS])]) == {True}
    assert hangs(HOLDS, one, [two]) == {True, False}


@pytest.mark.parametrize("hits", ["lower", "lower_throughout"])
@pytest.mark.parametrize("lost", [(SPENT, 5.0), (REFUSED, 5.0), (NONE, 5.0), (5.0, NONE)])
def test_a_share_of_what_both_solve_hangs_on_what_did_not_end_alone(
    hits: str, lost: tuple[float | str, float | str]
) -> None:
    settings = {"hits": hits, "accepted": [0.9, 1.0]}
    lower: Ends = [(4.0, 5.0)] * 40
    for more, is_firm in (([], True), ([(NONE, NONE)] * 9, True), ([lost] * 9, SPENT not in lost)):
        found = shares.share_within(asked(lower + more, settings))
        assert (found.outcome, firm(found)) == (HOLDS, is_firm), more


def test_a_share_of_solved_trials_hangs_on_what_did_not_end_alone() -> None:
    settings = {"hits": "solved", "accepted": [0.0, 0.5]}
    ends: Ends = [(5.0, 5.0), (NONE, 5.0), (NONE, 5.0), (NONE, 5.0)] * 20
    assert firm(shares.share_within(asked(ends, settings)))
    assert firm(shares.share_within(asked([*ends, (SPENT, 5.0)], settings)))
    assert not firm(shares.share_within(asked(ends + [(SPENT, 5.0)] * 40, settings)))


def test_every_case_that_both_solve_hangs_on_what_did_not_end_alone() -> None:
    for criterion, settings, case in [
        (shares.on_every, {"that": "lower"}, (4.0, 5.0)),
        (shares.on_every, {"that": "at_most_times", "bound": 2.0}, (4.0, 5.0)),
        (shares.equals, {}, (5.0, 5.0)),
    ]:
        for lost, is_firm in (((REFUSED, 5.0), True), ((5.0, NONE), True), ((SPENT, 5.0), False)):
            found = criterion(asked([case] * 9 + [lost], settings))
            assert (found.outcome, firm(found)) == (HOLDS, is_firm), (settings, lost)


def test_a_slope_hangs_on_what_did_not_end_where_that_could_bend_it() -> None:
    rise: Ends = [(100.0 - place, 100.0) for place in range(40)]
    settings = {"over": "x", "rising": True}
    whole, cut, few = (
        sizes.trend(asked(rise + more, settings)) for more in ([], [(SPENT, 1.0)] * 40, [(SPENT, 1.0)])
    )
    assert [found.outcome for found in (whole, cut, few)] == [HOLDS] * 3
    assert [firm(found) for found in (whole, cut, few)] == [True, False, True]


def one_instance(monkeypatch: pytest.MonkeyPatch, ends: Ends, printed: str, statistic: str) -> Found:
    """What one printed number finds among instances of the contender alone."""
    monkeypatch.setattr(printed_cells, "printed", lambda paper, claim: Printed(printed, "rounded"))
    one = asked(ends, {"statistic": statistic})
    one.cases().against = None
    one.claim = {}
    return printed_cells.one_instance(one)


@pytest.mark.parametrize(("printed", "outcome"), [("50", HOLDS), ("101", FAILS)])
def test_one_draw_hangs_on_draws_that_might_lie_beyond_it(
    monkeypatch: pytest.MonkeyPatch, printed: str, outcome: str
) -> None:
    ends: Ends = [(float(place), 1.0) for place in range(100)]
    whole = one_instance(monkeypatch, ends, printed, "mean")
    cut = one_instance(monkeypatch, ends + [(SPENT, 1.0)] * 5, printed, "mean")
    assert (whole.outcome, cut.outcome, firm(whole)) == (outcome, outcome, True)
    # Five that lie above all others reach what is beyond them, and move no end past the middle.
    assert firm(cut) == (outcome == HOLDS)


def test_one_draw_of_a_share_hangs_on_what_might_be_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    none: Ends = [(NONE, 1.0)] * 60
    assert firm(one_instance(monkeypatch, none, "100", "solved_percent"))
    assert not firm(one_instance(monkeypatch, none + [(SPENT, 1.0)] * 60, "100", "solved_percent"))


def row(monkeypatch: pytest.MonkeyPatch, ends: Ends, refused_below: float, statistics: list[str]) -> Found:
    """What one printed row finds among instances of the contender alone."""
    monkeypatch.setattr(printed_cells, "printed", lambda paper, claim: Printed("50", "rounded"))
    claims = ["a claim"] * len(statistics)
    rows = [{"contender": "A", "claims": claims, "statistics": statistics}]
    one = asked(ends, {"rows": rows, "refused_below": refused_below})
    one.cases().against = None
    one.paper = SimpleNamespace(claim=lambda name: {})
    return printed_cells.row_one_instance(one)


def test_a_row_hangs_on_what_did_not_end_and_needs_draws_of_which_one_could_be_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ends: Ends = [(float(place), 1.0) for place in range(100)]
    whole = row(monkeypatch, ends, 0.05, ["least", "greatest"])
    cut = row(monkeypatch, [*ends, (SPENT, 1.0)], 0.05, ["least", "greatest"])
    assert (whole.outcome, firm(whole), firm(cut)) == (HOLDS, True, False)
    assert not whole.few
    few = row(monkeypatch, ends[:39], 0.05, ["mean"]), row(monkeypatch, ends[:40], 0.05, ["mean"])
    assert [is_few("row_one_instance", {}, found) for found in few] == [True, False]


def test_two_groups_need_ten_draws_each_unless_nothing_is_drawn() -> None:
    def few(first: int, second: int) -> bool:
        one = asked([(5.0, 1.0)] * (first + second), {"statistic": "ratio_of_groups", "accepted": [0.5, 2.0]})
        one.settings["select"] = {"problems": ["g", "h"]}
        one.cases().group = np.repeat([0, 1], [first, second])
        return sizes.within(one).few

    # Of the first a single instance is all there is, of the second it is one of many.
    assert [few(1, 10), few(1, 1), few(2, 10), few(10, 9)] == [False, True, True, True]


def test_what_did_not_end_is_neither_solved_nor_not() -> None:
    def solved(*more: tuple[float | str, float | str]) -> Found:
        return shares.on_every(asked([(1.0, 1.0)] * 20 + list(more), {"that": "solved"}))

    assert [solved().outcome, solved((NONE, 1.0)).outcome] == [HOLDS, FAILS]
    for case, is_firm in (((SPENT, 1.0), False), ((NONE, SPENT), False), ((1.0, SPENT), True)):
        assert (solved(case).outcome, firm(solved(case))) == (HOLDS, is_firm), case


def test_one_path_that_is_refused_contradicts_that_every_path_is_accepted() -> None:
    def found(end: float | str) -> tuple[str, bool]:
        one = shares.on_every(asked([(1.0, 1.0)] * 20 + [(NONE, 1.0), (end, 1.0)], {"that": "accepted"}))
        return one.outcome, firm(one)

    assert [found(end) for end in (1.0, NONE, SPENT)] == [(HOLDS, True), (HOLDS, True), (HOLDS, False)]
    assert found(REFUSED)[0] == FAILS


def test_what_holds_on_each_of_few_draws_of_a_problem_that_is_drawn_is_not_firm() -> None:
    def few(instances: int, group: str) -> bool:
        one = asked([(4.0, 5.0)] * instances, {"that": "lower", "select": {"problems": [group]}})
        return shares.on_every(one).few

    assert [few(1, "h"), few(9, "h"), few(10, "h"), few(1, "g")] == [True, True, False, False]
    searched = asked([(4.0, 5.0)], {"that": "lower", "select": {"problems": ["h"]}})
    searched.cases().study.spec["searched"] = True
    assert not shares.on_every(searched).few


def test_pairs_that_agree_bound_no_others() -> None:
    settings = {"statistic": "ratio", "accepted": [0.5, 1.5]}
    assert firm(sizes.within(asked([(5.0, 5.0)] * 80, settings)))
    assert not firm(sizes.within(asked([(5.0, 5.0)] * 40 + [(SPENT, 5.0)] * 40, settings)))


def test_what_prints_alike_hangs_on_what_did_not_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(printed_cells, "printed", lambda paper, claim: Printed("5", "rounded"))

    def prints(value: float, *more: tuple[float | str, float | str]) -> Found:
        one = asked([(value, 1.0)] * 20 + list(more), {})
        one.claim = {}
        return printed_cells.prints_as(one)

    for value, outcome in ((5.0, HOLDS), (9.0, FAILS)):
        whole, cut = prints(value), prints(value, (SPENT, 1.0))
        assert (whole.outcome, firm(whole), firm(cut)) == (outcome, True, False)


def drawn(status: list[str], *, family: str, repeats: int = 1) -> tuple[SimpleNamespace, dict[str, Any]]:
    """A paper with one group, of instances of two queries or two seeds each, and a selection of it."""
    count = len(status)
    place = np.arange(count)
    study = SimpleNamespace(
        status=np.array(status),
        solved=np.array(status) == "solved",
        values=lambda metric, session: np.ones(count),
        rows=lambda group, contender: place,
        instance=place // 2,
        repeat=place % repeats,
        query=(place % 2, ["0", "1"]),
        sweep=(np.zeros(count, dtype=int), [""]),
        sweeps_called=lambda groups, written: [""],
        pooled_points=lambda points: points,
        groups=["g"],
        spec={"problems": [{"label": "g", "family": family}]},
    )
    paper = SimpleNamespace(studies={"s": study}, metric=lambda name: COST)
    return paper, {"study": "s", "problems": ["g"], "contender": "A", "metric": "cost"}


def test_what_a_search_counts_holds_where_its_path_is_refused_and_what_a_path_has_does_not() -> None:
    status = np.array(["solved", REFUSED, NONE, SPENT])
    assert COST.given(status).tolist() == [True, False, False, False]
    assert replace(COST, of_search=True).given(status).tolist() == [True, True, False, False]


@pytest.mark.parametrize(("lost", "is_cut"), [("solved", False), (NONE, False), (SPENT, True)])
def test_draws_that_might_have_been_whole_are_not_forgotten(lost: str, is_cut: bool) -> None:
    paper, of = drawn(["solved"] * 7 + [lost], family="random_cells")
    cases = select(paper, {**of, "whole_instances": True}, 1)
    assert (cases.units, cases.cut_left_out) == (4 if lost == "solved" else 3, is_cut)
    assert selections_of({"select": of}) == []
    rows = [{"contender": "A", "claims": []}, {"contender": "B", "against": "A", "claims": []}]
    whole = selections_of({"select": {**of, "whole_instances": True}, "rows": rows})
    assert [(one["contender"], one.get("against")) for one in whole] == [("A", None), ("B", "A")]


def test_seeds_on_a_problem_that_is_drawn_are_no_draws_of_it() -> None:
    for family, units in (("random_cells", 4), ("grid_map", 8)):
        paper, of = drawn(["solved"] * 8, family=family, repeats=2)
        assert select(paper, of, 1).units == units, family


def test_a_contender_with_one_seed_stands_beside_each_seed_of_the_other() -> None:
    # Two instances: trials 0 and 4 of a contender without seeds, the others of one with three.
    posed, repeat = np.repeat([0, 1], 4), np.tile([0, 0, 1, 2], 2)
    study = SimpleNamespace(posed=posed, repeat=repeat, case=3 * posed + repeat)
    one, many = np.array([0, 4]), np.array([1, 2, 3, 5, 6, 7])
    pairs = [[own.tolist() for own in matched(study, *sides)] for sides in ((one, many), (many, one))]
    assert pairs[0] == pairs[1][::-1] == [[0, 0, 0, 4, 4, 4], many.tolist()]
    assert [own.tolist() for own in matched(study, many, many[1:])] == [many[1:].tolist()] * 2
    assert matched(study, one, many[:0])[0].tolist() == []


def test_a_side_that_did_not_end_might_have_been_the_better_one() -> None:
    settings = {"statistic": "ratio", "accepted": [0.0, 0.7]}
    for end, is_firm in ((NONE, True), (SPENT, False)):
        found = sizes.within(asked([(50.0, 100.0)] * 30 + [(50.0, end)] * 3, settings))
        assert (found.outcome, firm(found)) == (HOLDS, is_firm), end
