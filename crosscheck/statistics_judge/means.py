"""Criteria of printed means: mean_of for one of them, table_means for a table of them."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import stats

from statistics_judge import across
from statistics_judge.classes import FAILS, HOLDS, SIGN
from statistics_judge.found import Asked, Estimate, Found, certain, outcomes, too_few
from statistics_judge.intervals import CHUNK, LEVEL, OWN, End, Interval, percentile, sums_by_unit
from statistics_judge.records import Places, Reals
from statistics_judge.selection import Cases
from statistics_judge.sizes import printed

# Fewest instances on either side of which a mean is taken to be normal.
FEWEST_NORMAL = 30
# A probability as near to its limit as this share may fall on either side.
NEAR = 1e-9


def of_units(cases: Cases) -> tuple[Places, Reals]:
    """The units that have a number, by name, and the mean number of each: with another contender, its excess."""
    numbers = cases.values if cases.against is None else cases.values - cases.bases
    known = ~np.isnan(numbers)
    total, count = sums_by_unit(cases.unit[known], cases.units, numbers[known], np.ones(int(known.sum())))
    has = count > 0
    return cases.names[has], total[has] / count[has]


def rounded(asked: Asked, claim: dict[str, Any]) -> tuple[float, float]:
    """Between which numbers a claim's true one lies; that of a difference of two printed numbers too."""

    def ends(one: dict[str, Any]) -> tuple[float, float]:
        (low, _), (high, _) = printed(asked.paper, one).ends()
        return float(low), float(high)

    if "difference" not in claim:
        return ends(claim)
    above, below = (ends(asked.paper.claim(of)) for of in claim["difference"])
    return above[0] - below[1], above[1] - below[0]


def predicted(values: Reals, count: int, seed: str) -> Interval:
    """Where the mean of so many more instances lies."""
    if (values == values[0]).all():
        return End.exact(float(values[0])), End.exact(float(values[0]))
    units, mean = len(values), float(values.mean())
    if min(units, count) < FEWEST_NORMAL:
        rng = np.random.default_rng(list(seed.encode()))
        parts = []
        for _ in range(OWN // CHUNK):
            theirs, ours = (values[rng.integers(0, units, (CHUNK, of))].mean(axis=1) for of in (count, units))
            parts.append(mean + np.sqrt(units / (units - 1)) * (theirs - ours))
        found = percentile(np.concatenate(parts))
        assert found is not None
        return found
    half = stats.t.isf((1 - LEVEL) / 2, units - 1) * values.std(ddof=1) * np.sqrt(1 / count + 1 / units)
    return End.exact(mean - half), End.exact(mean + half)


def of_values(asked: Asked, values: Reals) -> tuple[Interval, frozenset[str | None], str]:
    """The interval of the printed mean, the outcomes that it may have, and the one that it has."""
    interval = predicted(values, asked.settings["instances"], asked.seed)
    least, most = rounded(asked, asked.claim)
    spread = stats.t.isf((1 - LEVEL) / 2, len(values) - 1) * stats.sem(values)
    cell = printed(asked.paper, asked.claim).value
    signs = [(values.mean() + way * spread) * cell for way in (-1, 1)]
    refused = SIGN if "against" in asked.settings["select"] and min(signs) > 0 else FAILS

    def outcome(low: float, high: float) -> str:
        return HOLDS if low <= most and least <= high else refused

    return interval, outcomes(outcome, interval), outcome(*(end.at for end in interval))


def mean_of(asked: Asked) -> Found:
    """The printed number could be the mean of so many instances like ours."""
    cases = asked.cases()
    _, values = of_units(cases)
    if len(values) < 2:
        return replace(too_few(), censored=frozenset([bool(cases.unended.any())]))
    interval, possible, outcome = of_values(asked, values)
    is_agreed = bool((values == values[0]).all())
    estimate = Estimate(float(values.mean()), len(values), interval, cases.solved_of_all(), exact=is_agreed)
    found = replace(certain(outcome, estimate), possible=possible)
    return replace(found, censored=frozenset([hangs_on_unended(asked, cases, values, outcome)]))


def hangs_on_unended(asked: Asked, cases: Cases, values: Reals, outcome: str) -> bool:
    """Whether cases that did not end could turn what was found; whatever is refused may be on either side."""
    if not cases.unended.any():
        return False
    far = np.abs(values).max() * len(values)
    for end in (-far if cases.against is not None else 0.0, far):
        given = cases.given(np.full(len(cases.own), end))
        if cases.against is not None:
            given.bases = np.where(cases.unended, 0.0, cases.bases)
        if of_values(asked, of_units(given)[1])[2] != outcome:
            return True
    return outcome != HOLDS


@dataclass
class Cell:
    """A printed mean that shares its instances with others."""

    name: str
    value: float
    rounded: tuple[float, float]
    instances: int
    units: dict[int, float]
    cases: Cases


def rows_of(asked: Asked) -> dict[tuple[str, str, int], list[Cell]]:
    """The cells of a table by row: those that share a study, problems and a number of instances."""
    rows: dict[tuple[str, str, int], list[Cell]] = {}
    for place in asked.settings["in"]:
        for name in place["claims"]:
            claim = asked.paper.claim(name)
            if "untestable" in claim or "difference" in claim:
                continue
            own = Asked(asked.paper, claim, claim["check"]["mean_of"], asked.session, asked.seed)
            cases, count = own.cases(), own.settings["instances"]
            units = dict(zip(*(one.tolist() for one in of_units(cases)), strict=True))
            cell = Cell(name, printed(asked.paper, claim).value, rounded(own, claim), count, units, cases)
            rows.setdefault((place["study"], str(own.settings["select"]["problems"]), count), []).append(cell)
    return rows


def table_means(asked: Asked) -> Found:
    """The printed means of a table, taken together, could be those of so many instances like ours."""
    rows = rows_of(asked)
    cells = [cell for row in rows.values() for cell in row]
    probabilities = [of_row(row) for row in rows.values()]
    is_cut = any(bool(cell.cases.unended.any()) for cell in cells)
    if any(p is None for p in probabilities):
        return replace(too_few(), few=True, censored=frozenset([is_cut]))
    p = fisher([p for p in probabilities if p is not None])
    judged = min(1.0, p * interpretations(asked))
    limit = asked.settings["refused_below"]
    possible = frozenset(HOLDS if judged * share >= limit else FAILS for share in (1 - NEAR, 1.0, 1 + NEAR))
    solved = [cell.cases.solved_of_all() for cell in cells]
    total = (sum(one for one, _ in solved), sum(all_ for _, all_ in solved))
    estimate = Estimate(p, min(cell.cases.units for cell in cells), None, total)
    found = replace(certain(HOLDS if judged >= limit else FAILS, estimate), possible=possible)
    return replace(found, censored=frozenset([is_cut]), powerless=is_powerless(asked, list(rows.values())))


def shared_units(row: list[Cell]) -> Reals:
    """The numbers of the units that have all cells of a row, a line each."""
    whole = sorted(set.intersection(*(set(cell.units) for cell in row)))
    return np.array([[cell.units[unit] for cell in row] for unit in whole]).reshape(len(whole), len(row))


def row_test(row: list[Cell]) -> tuple[Reals, Reals, list[Cell], list[Cell]] | None:
    """Our numbers in each cell that moves, by unit, their covariance with rounding, those cells, and the others.

    None of too few units.
    """
    drawn = shared_units(row)
    if not len(drawn):
        return None
    moves = (drawn != drawn[0]).any(axis=0)
    moving = [cell for cell, is_moving in zip(row, moves, strict=True) if is_moving]
    exact = [cell for cell, is_moving in zip(row, moves, strict=True) if not is_moving]
    if len(drawn) < len(moving) + FEWEST_NORMAL:
        return None
    drawn = drawn[:, moves]
    half = np.array([(cell.rounded[1] - cell.rounded[0]) / 2 for cell in moving])
    scale = 1 / row[0].instances + 1 / len(drawn)
    covariance = np.atleast_2d(np.cov(drawn, rowvar=False)) * scale if moving else np.zeros((0, 0))
    return drawn, covariance + np.diag(half**2 / 3), moving, exact


def above(statistic: float, cells: int, units: int) -> float:
    """The probability of a T² as large."""
    return float(stats.f.sf(statistic * (units - cells) / (cells * (units - 1)), cells, units - cells))


def of_row(row: list[Cell]) -> float | None:
    """The probability of a row as far from ours; none of too few instances."""
    known = row_test(row)
    if known is None:
        return None
    drawn, covariance, moving, exact = known
    if any(not cell.rounded[0] <= next(iter(cell.units.values())) <= cell.rounded[1] for cell in exact):
        return 0.0
    if not moving:
        return 1.0
    apart = np.array([cell.value for cell in moving]) - drawn.mean(axis=0)
    return above(float(apart @ np.linalg.solve(covariance, apart)), len(moving), len(drawn))


def is_powerless(asked: Asked, rows: list[list[Cell]]) -> bool:
    """Whether even a table whose cells are all off by their own size would not have been refused."""
    found = []
    for known in map(row_test, rows):
        assert known is not None
        drawn, covariance, moving, _ = known
        if moving:
            mean = drawn.mean(axis=0)
            found.append(above(float(mean @ np.linalg.solve(covariance, mean)), len(moving), len(drawn)))
    judged = min(1.0, fisher(found) * interpretations(asked))
    return bool(found) and judged >= asked.settings["refused_below"]


def fisher(probabilities: list[float]) -> float:
    """Independent probabilities taken together."""
    if min(probabilities) == 0.0:
        return 0.0
    return float(stats.chi2.sf(-2 * np.log(probabilities).sum(), 2 * len(probabilities)))


def interpretations(asked: Asked) -> int:
    """How many interpretations the paper may mean that the studies tell apart; 1 if other claims chose among them."""
    studies = asked.paper.studies.values()
    calibration = {name for study in studies for name in study.spec.get("fitted_to", [])}
    if calibration and asked.claim["id"] not in calibration:
        return 1
    touched = {
        choice for place in asked.settings["in"] for choice in asked.paper.studies[place["study"]].inherited
    }
    voting = [
        sum(choice.votes({choice.id: name}) for name in choice.options)
        for choice in across.choices(asked.paper)
        if choice.id in touched
    ]
    return math.prod(max(1, count) for count in voting)
