"""Holds the numbers of estimates.parquet under the default interpretation against what the stored trials give.

An exploration keeps the first instances of each problem group and the first seeds of each contender. The default run
has the same trials, so that its first instances give the same numbers. Not compared: parts of a number, what cases
without an end might have given, the second seed, and studies that another study stands for.
"""

import copy
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pyarrow.parquet as pq

from statistics_judge.found import Estimate
from statistics_judge.intervals import Interval
from statistics_judge.records import Paper

# The criteria that ask for a statistic of all instances.
ASKED_BY = {
    "equal trials 1": ("equals",),
    "every case 1": ("on_every",),
    "means 1": ("mean_of",),
    "overall 1": ("lower", "within"),
    "share 1": ("share",),
    "slope 1": ("trend",),
}

Finds = Callable[[Paper, dict[str, Any], str], Estimate | None]


def rows(paper: Paper) -> Iterator[dict[str, Any]]:
    """The rows of the default interpretation on the first seed."""
    path = paper.runs / "estimates.parquet"
    if not path.is_file():
        return
    for row in pq.read_table(path).to_pylist():
        if 0 in row["interpretations"] and not row["is_second_seed"]:
            yield row


def is_whole(row: dict[str, Any]) -> bool:
    """Whether a row is a whole number as measured, that does not rest on the clock."""
    return not row["part"] and row["ends"] == "measured" and row["value"] is not None and not row["sessions"]


def criterion_of(claim: dict[str, Any], row: dict[str, Any]) -> str | None:
    """The criterion of a claim that asks for the number of a row; none if several may."""
    names = [name for name in ASKED_BY.get(row["statistic"], ()) if name in claim.get("check", {})]
    return names[0] if len(names) == 1 else None


def explored(paper: Paper, *, has_more: bool) -> Paper:
    """The paper with the trials alone that its exploration keeps."""
    kept = {**paper.explore.get("instances", {})}
    kept |= paper.explore.get("more_instances", {}) if has_more else {}
    of_exploration = copy.copy(paper)
    of_exploration.studies = {
        name: study.first(kept.get(name), paper.explore.get("repeats", {}).get(name))
        for name, study in paper.studies.items()
    }
    return of_exploration


def as_stored(criterion: str, own: Estimate) -> Estimate:
    """Our number as the table has it: by how much a contender is lower, not by how much it is more."""
    if criterion == "mean_of":
        # Its interval is that about the printed mean, which is no number of the table.
        return replace(own, interval=None)
    if criterion == "equals":
        # Its cases are the equal ones, of those that are compared.
        return replace(own, solved=None)
    if criterion != "lower" or own.interval is None:
        return own
    low, high = (end.mapped(lambda number: 0.0 - number) for end in own.interval)
    interval: Interval = (high, low)
    return replace(own, value=0.0 - own.value, interval=interval)


def has_trials(paper: Paper, row: dict[str, Any]) -> bool:
    """Whether the trials behind a row are stored: no other study stands for theirs, and as many instances are."""
    kept = paper.explore.get("more_instances" if row["has_more_instances"] else "instances", {})
    names = row["study"].split(", ")
    stands = set(names) & {*paper.stands_for, *paper.stands_for.values()}
    return not stands and all(paper.studies[name].has_instances(kept.get(name, 0)) for name in names)


def compared(paper: Paper, finds: Finds) -> Iterator[tuple[str, dict[str, Any], Estimate | None] | None]:
    """Each row with what the trials give and where it stands; none for a row that is not computed again."""
    papers = [explored(paper, has_more=has_more) for has_more in (False, True)]
    for row in rows(paper):
        of_row = papers[row["has_more_instances"]]
        # Claims that ask the same share a row.
        claim = next((one for one in paper.claims if one["id"] in row["claim"].split(", ")), {})
        name = criterion_of(claim, row)
        if name is None or not is_whole(row) or not has_trials(paper, row):
            yield None
            continue
        more = ", with more instances" if row["has_more_instances"] else ""
        where = f"{paper.id}: estimates.parquet, `{claim['id']}` ({name}{more})"
        found = finds(of_row, claim, name)
        yield where, row, found and as_stored(name, found)
