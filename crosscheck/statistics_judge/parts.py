"""The parts of numbers as estimates.parquet has them: contenders compared, cells, points of a sweep, values found."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from statistics_judge.found import Asked, Estimate
from statistics_judge.means import rows_of, shared_units
from statistics_judge.medians import compared_pairs, eligible, medians_of_sets
from statistics_judge.printed_cells import drawn_rows, of_draws
from statistics_judge.records import Reals
from statistics_judge.selection import labels
from statistics_judge.sizes import curves, of_band


@dataclass(frozen=True)
class Part:
    """A part by its name: a number, or the numbers of all instances."""

    name: str
    estimate: Estimate | None = None
    values: Reals | None = None


def ratios_of_medians(asked: Asked) -> list[Part]:
    """Each contender over each other on each problem."""
    return [
        Part(f"{one} against {other}, {group}", found)
        for group, one, other, found in compared_pairs(asked, (np.inf, np.inf))
    ]


def cells(asked: Asked) -> list[Part]:
    """The mean of each cell of a table over the units that have its whole row."""
    found = []
    for row in rows_of(asked).values():
        drawn = shared_units(row)
        found += [
            Part(cell.name, Estimate(float(mean), len(drawn)))
            for cell, mean in zip(row, drawn.mean(axis=0), strict=True)
        ]
    return found


def points(asked: Asked) -> list[Part]:
    """The mean difference at each point of a sweep, with its band."""
    cases = asked.cases()
    if asked.settings["select"].get("metric"):
        return []
    drawn = curves(cases, other=False, own=False)
    if len(drawn) < 2:
        return []
    intervals = of_band(asked, drawn)
    return [
        Part(point, Estimate(float(mean), len(drawn), interval))
        for point, mean, interval in zip(cases.points, drawn.mean(axis=0), intervals, strict=True)
    ]


def values_found(asked: Asked) -> list[Part]:
    """Each number that a claim is looked for among, and how often it was seen; of sets the median of each problem."""
    if asked.settings.get("differ"):
        return [
            Part(group, Estimate(median, 0)) for group, median in medians_of_sets(asked) if median is not None
        ]
    found = []
    for label in labels(asked.settings["contenders"]):
        values, searched = eligible(asked, label)
        seen = Counter(zip(values.tolist(), searched.tolist(), strict=True))
        found += [Part(label, Estimate(value, count)) for (value, _), count in sorted(seen.items())]
    return found


def each_instance(asked: Asked) -> list[Part]:
    """The number of every instance."""
    values = of_draws(asked.cases(), asked.settings.get("statistic", "mean"))
    return [Part("", values=values[~np.isnan(values)])]


def rows_of_instances(asked: Asked) -> list[Part]:
    """The numbers of all instances in each cell of a row."""
    ours, _ = drawn_rows(asked, solved=False)
    return [Part(f"cell {place + 1}", values=column) for place, column in enumerate(ours.T)]


# What computes the parts of a statistic, and the criterion that asks for it.
OF_STATISTIC: dict[str, tuple[str, Callable[[Asked], list[Part]]]] = {
    "difference solved along a sweep 1": ("lower", points),
    "each instance 1": ("one_instance", each_instance),
    "means of a table 1": ("table_means", cells),
    "ratios of medians 1": ("least_of", ratios_of_medians),
    "rows of instances 1": ("row_one_instance", rows_of_instances),
    "values found 2": ("exists", values_found),
}
