"""The outcome of a finding, of several findings on one claim, and of a claim of parts."""

from collections.abc import Callable, Iterable

# What a criterion finds.
HOLDS, SIGN, OPEN, FAILS = "holds", "right_in_direction", "open", "contradicted"

# Of findings on one claim the last in this order decides.
WEIGHT = (HOLDS, "fitted", "attainable", SIGN, OPEN, "not_testable", FAILS, "impossible")
SPEAKS = {
    **dict.fromkeys(WEIGHT[:4], 1),
    **dict.fromkeys((OPEN, "not_testable"), 0),
    **dict.fromkeys((FAILS, "impossible"), -1),
}

# What explorations of older versions call outcomes.
OLDER = {
    "reproduced": HOLDS,
    "direction_only": SIGN,
    "undecided": OPEN,
    "untestable": "not_testable",
    "not_reproduced": FAILS,
}


def stored_outcome(result: dict) -> str:
    """The outcome of a stored result."""
    found = result.get("outcome") or result["class"]
    return OLDER.get(found, found)


def of_finding(
    outcome: str,
    *,
    searched: bool = False,
    fitted: bool = False,
    existential: bool = False,
    powerless: bool = False,
    censored: bool = False,
    few: bool = False,
    clock: bool = False,
    not_run: bool = False,
) -> str:
    """The outcome of what a criterion found.

    `clock`: it rests on a clock with few or contrary sessions.
    `not_run`: the paper may mean an option that cannot be run.
    """
    if censored or few or clock or not_run:
        return OPEN
    if outcome == HOLDS and (searched or existential):
        outcome = "attainable"
    elif outcome == HOLDS and fitted:
        outcome = "fitted"
    elif outcome == SIGN and (searched or fitted):
        outcome = OPEN
    return OPEN if powerless and SPEAKS[outcome] > 0 else outcome


def combined(outcomes: Iterable[str], untestable: bool) -> str:
    """The outcome of several findings on one claim."""
    found = [*outcomes, *(["not_testable"] if untestable else [])]
    return max(found, key=WEIGHT.index, default=OPEN)


def all_of(parts: list[str]) -> str:
    """The outcome of a sentence that says all of its parts: against before open before for."""
    return _extreme(parts, min(map(SPEAKS.__getitem__, parts), default=0), max)


def any_of(parts: list[str]) -> str:
    """The outcome of a sentence that says some one of its parts: for before open before against."""
    return _extreme(parts, max(map(SPEAKS.__getitem__, parts), default=0), min)


def means_one_of(parts: list[str]) -> str:
    """The outcome of a sentence that means one of its parts: theirs if they speak one way."""
    ways = {SPEAKS[part] for part in parts}
    if len(ways) != 1:
        return OPEN
    # Against: the strongest of them, since it is not known which is meant.
    return any_of(parts) if ways == {-1} else all_of(parts)


def _extreme(parts: list[str], way: int, pick: Callable[..., str]) -> str:
    among = [part for part in parts if SPEAKS[part] == way]
    if way == 0:
        return "not_testable" if among and set(among) == {"not_testable"} else OPEN
    return pick(among, key=WEIGHT.index)


PARTS = {"all_of": all_of, "any_of": any_of, "means_one_of": means_one_of, "cells": all_of}
