"""Criteria that hold printed cells against our instances: one_instance, prints_as and row_one_instance."""

import functools
from dataclasses import replace
from typing import Any

import numpy as np

from statistics_judge.classes import FAILS, HOLDS, OPEN, SIGN
from statistics_judge.found import Asked, Estimate, Found, certain, outcomes, too_few
from statistics_judge.intervals import bootstrap, predictive, sums_by_unit
from statistics_judge.records import Places, Reals
from statistics_judge.selection import Cases, labels
from statistics_judge.shares import needs_draws
from statistics_judge.sizes import printed

# Points of a share that an interval covers from which on next to nothing could be refused.
NO_POWER = 80.0


def of_draws(cases: Cases, statistic: str) -> Reals:
    """What each unit gives: of the metric, or of what is saved in per cent; NaN where it has no number."""
    if statistic == "solved_percent":
        return solved_percent(cases.unit, cases.own_solved, cases.units)
    numbers = cases.numbers
    known = ~np.isnan(numbers)
    unit, numbers = cases.unit[known], numbers[known]
    found = np.full(cases.units, np.nan)
    if statistic == "mean":
        total, count = sums_by_unit(unit, cases.units, numbers, np.ones(len(unit)))
        return np.divide(total, count, out=found, where=count > 0)
    of = {"least": np.fmin, "greatest": np.fmax}[statistic]
    of.at(found, unit, numbers)
    return found


def solved_percent(unit: Places, solved: np.ndarray, units: int) -> Reals:
    """The share of each unit's cases that are solved, in per cent; NaN where it has none."""
    hits, count = sums_by_unit(unit, units, solved.astype(float), np.ones(len(unit)))
    return np.divide(100 * hits, count, out=np.full(units, np.nan), where=count > 0)


def one_instance(asked: Asked) -> Found:
    """The printed number lies where one more instance of ours would."""
    cases, cell = asked.cases(), printed(asked.paper, asked.claim)
    statistic = asked.settings.get("statistic", "mean")
    values = of_draws(cases, statistic)
    values = np.array([cell.value if cell.agrees(value) else value for value in values[~np.isnan(values)]])
    interval = predictive(values)
    if interval is None:
        return too_few()
    low, high = (end.at for end in interval)
    mean = float(values.mean())
    estimate = Estimate(mean, len(values), interval, cases.solved_of_all())
    about = bootstrap(lambda weights: weights @ values / len(values), len(values), asked.seed)
    assert about is not None

    def of_mean(least: float, most: float) -> str:
        """Both are savings, or both are losses."""
        is_sign = cases.against is not None and min(least * cell.value, most * cell.value) > 0
        return SIGN if is_sign else FAILS

    if low <= cell.value <= high:
        outcome, possible = HOLDS, frozenset([HOLDS])
    else:
        outcome, possible = of_mean(*(end.at for end in about)), outcomes(of_mean, about)
    is_percent = statistic == "solved_percent" or cases.against is not None
    powerless = is_percent and high - low >= NO_POWER
    found = replace(certain(outcome, estimate, powerless=powerless), possible=possible)
    return replace(found, censored=frozenset([hangs_on_unended(cases, statistic, cell.value, outcome)]))


def hangs_on_unended(cases: Cases, statistic: str, printed_value: float, outcome: str) -> bool:
    """Whether draws without a number, of which something did not end, could turn what one more instance says.

    Those of which something did not end are taken to lie below all others, then above, as far as it can move
    them; solved queries count as none of these, then as all.
    """
    if not cases.unended.any():
        return False
    values = of_draws(cases, statistic)
    cut = sums_by_unit(cases.unit, cases.units, cases.unended.astype(float))[0] > 0
    # A least number is not raised by one more, nor a greatest one lowered.
    below = np.where(cut & (np.isnan(values) | (statistic != "greatest")), -np.inf, values)
    above = np.where(cut & (np.isnan(values) | (statistic != "least")), np.inf, values)
    if statistic == "solved_percent":
        below = values
        above = solved_percent(cases.unit, cases.own_solved | cases.unended, cases.units)
    ends = [predictive(one[~np.isnan(one)]) for one in (below, above)]
    if ends[0] is None or ends[1] is None:
        return False
    (low, low_top), (high_foot, high) = ends[0], ends[1]
    if outcome == HOLDS:
        return not (high_foot.at <= printed_value <= low_top.at)
    return low.at <= printed_value <= high.at


def prints_as(asked: Asked) -> Found:
    """A number that is the same in every trial prints as the paper's."""
    cases, cell = asked.cases(), printed(asked.paper, asked.claim)
    values = cases.values[~np.isnan(cases.values)]
    if len(values) == 0:
        return certain(OPEN)
    low, high = float(values.min()), float(values.max())
    agree = [cell.agrees(low), cell.agrees(high)]
    (least, _), (most, _) = cell.ends()
    outcome = OPEN
    if all(agree):
        outcome = HOLDS
    elif not any(agree) and (float(least) > high or float(most) < low):
        outcome = FAILS
    found = certain(outcome, Estimate(low, len(values), None, cases.solved_of_all()))
    few = outcome == HOLDS and needs_draws(cases, labels(asked.settings["select"]["problems"]))
    cut = outcome != OPEN and bool(cases.unended.any())
    return replace(found, censored=frozenset([cut]), few=few)


def row_one_instance(asked: Asked) -> Found:
    """A printed row, or several of one instance, is as near to our mean row as our own instances are."""
    rows = [cell for row in asked.settings["rows"] for cell in printed_row(asked, row)]
    theirs, (ours, cases) = np.array(rows), drawn_rows(asked, solved=False)
    instances = len(ours)
    if instances < 3:
        return too_few()
    refused_below = asked.settings["refused_below"]
    outcome, rank = placed(theirs, ours, refused_below)
    found = certain(outcome, Estimate(rank, instances, None, cases[0].solved_of_all()))
    cut = any(one.unended.any() for one in cases)
    if cut and not any("statistics" in row for row in asked.settings["rows"]):
        filled, _ = drawn_rows(asked, solved=True)
        sides = [ours.mean() < theirs.mean(), filled.mean() < theirs.mean()]
        cut = placed(theirs, filled, refused_below)[0] != outcome or sides[0] != sides[1]
    # The least two-sided rank is 2 / (n + 1): of fewer instances no row could be refused.
    return replace(found, censored=frozenset([cut]), few=instances < int(2 / refused_below))


def printed_row(asked: Asked, row: dict[str, Any]) -> list[float]:
    """The numbers that a row prints."""
    return [printed(asked.paper, asked.paper.claim(of)).value for of in row["claims"]]


def placed(theirs: Reals, ours: Reals, refused_below: float) -> tuple[str, float]:
    """Whether a row is an ordinary one among our instances, and its rank: the lesser of shape and level."""
    rank = min((as_far(theirs, ours) + 1) / (len(ours) + 1), level_rank(theirs, ours))
    return (HOLDS if rank >= refused_below else FAILS), rank


def drawn_rows(asked: Asked, *, solved: bool) -> tuple[Reals, list[Cases]]:
    """The cells of all rows, of every instance that has them all, with the cases of each row.

    Where solved queries are counted, what did not end is solved only if so wanted.
    """
    cells, looked_at = [], []
    for row in asked.settings["rows"]:
        other = {key: row[key] for key in ("contender", "against") if key in row}
        cases = asked.cases(**other)
        columns = [of_draws(cases, of) for of in row.get("statistics", [])] or along_sweep(cases, solved)
        cells.append(np.stack(columns, axis=1))
        looked_at.append(cases)
    known = [~np.isnan(drawn).any(axis=1) for drawn in cells]
    names = [cases.names[kept] for cases, kept in zip(looked_at, known, strict=True)]
    whole = functools.reduce(np.intersect1d, names)
    kept = [drawn[np.isin(cases.names, whole)] for drawn, cases in zip(cells, looked_at, strict=True)]
    return np.concatenate(kept, axis=1), looked_at


def along_sweep(cases: Cases, solved: bool) -> list[Reals]:
    """The share of each unit's queries that is solved, in per cent, at each point of the sweep.

    What did not end is solved only if so wanted.
    """
    places, names = cases.study.pooled
    found = []
    for point in cases.points:
        at = places[cases.own] == names.index(point)
        hit = cases.own_solved | (cases.unended & solved)
        found.append(solved_percent(cases.unit[at], hit[at], cases.units))
    return found


def distance(row: Reals, others: Reals, instances: int) -> float:
    """How far a row is from the mean of others, in standard deviations a cell, root mean square.

    A cell at which the others agree has the spread of one query in ten of one instance in all.
    """
    spread = np.maximum(others.std(axis=0, ddof=1), 10 / np.sqrt(instances))
    return float(np.sqrt(np.mean(((row - others.mean(axis=0)) / spread) ** 2)))


def as_far(row: Reals, ours: Reals) -> int:
    """Instances that are at least as far from the mean of the others as the row is from the mean of all."""
    instances = len(ours)
    limit = distance(row, ours, instances) * (1 - 1e-12)
    return sum(distance(ours[i], np.delete(ours, i, axis=0), instances) >= limit for i in range(instances))


def level_rank(row: Reals, ours: Reals) -> float:
    """The two-sided rank of the row's mean among those of our instances, the row counted in."""
    levels, level = ours.mean(axis=1), row.mean()
    slack = 1e-12 * max(1.0, abs(level))
    below, above = int((levels <= level + slack).sum()), int((levels >= level - slack).sum())
    return min(1.0, 2 * (min(below, above) + 1) / (len(levels) + 1))
