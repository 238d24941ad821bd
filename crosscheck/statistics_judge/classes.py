"""The class of a finding, of several findings on one claim, and of a claim of parts."""

from collections.abc import Callable, Iterable

# What a criterion finds.
HOLDS, SIGN, OPEN, FAILS = "holds", "the sign alone holds", "open", "fails"

# Of findings on one claim the last in this order decides.
WEIGHT = (
    "reproduced",
    "fitted",
    "attainable",
    "direction_only",
    "undecided",
    "untestable",
    "not_reproduced",
    "impossible",
)
SPEAKS = {
    **dict.fromkeys(WEIGHT[:4], 1),
    **dict.fromkeys(("undecided", "untestable"), 0),
    **dict.fromkeys(("not_reproduced", "impossible"), -1),
}


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
    """The class of what a criterion found.

    `clock`: it rests on a clock with few or contrary sessions.
    `not_run`: the paper may mean an option that cannot be run.
    """
    if censored or few or clock or not_run:
        return "undecided"
    plain = {HOLDS: "reproduced", SIGN: "direction_only", OPEN: "undecided", FAILS: "not_reproduced"}[outcome]
    if plain == "reproduced" and (searched or existential):
        plain = "attainable"
    elif plain == "reproduced" and fitted:
        plain = "fitted"
    return "undecided" if powerless and SPEAKS[plain] > 0 else plain


def combined(classes: Iterable[str], untestable: bool) -> str:
    """The class of several findings on one claim."""
    found = [*classes, *(["untestable"] if untestable else [])]
    return max(found, key=WEIGHT.index, default="undecided")


def all_of(parts: list[str]) -> str:
    """The class of a sentence that says all of its parts: against before open before for."""
    return _extreme(parts, min(map(SPEAKS.__getitem__, parts), default=0), max)


def any_of(parts: list[str]) -> str:
    """The class of a sentence that says some one of its parts: for before open before against."""
    return _extreme(parts, max(map(SPEAKS.__getitem__, parts), default=0), min)


def means_one_of(parts: list[str]) -> str:
    """The class of a sentence that means one of its parts: theirs if they speak one way."""
    ways = {SPEAKS[part] for part in parts}
    if len(ways) != 1:
        return "undecided"
    # Against: the strongest of them, since it is not known which is meant.
    return any_of(parts) if ways == {-1} else all_of(parts)


def _extreme(parts: list[str], way: int, pick: Callable[..., str]) -> str:
    among = [part for part in parts if SPEAKS[part] == way]
    if way == 0:
        return "untestable" if among and set(among) == {"untestable"} else "undecided"
    return pick(among, key=WEIGHT.index)


PARTS = {"all_of": all_of, "any_of": any_of, "means_one_of": means_one_of, "cells": all_of}
