"""Holds the numbers of estimates.parquet under the default interpretation against what the stored trials give.

An exploration keeps the first instances of each problem group and the first seeds of each contender. The default run
has the same trials, so that its first instances give the same numbers. What is not compared is counted by the reason:
the clock, what cases without an end might have given, counts alone, and instances that are not stored.
"""

import copy
import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import pyarrow.parquet as pq

from statistics_judge.found import Asked, Estimate
from statistics_judge.intervals import Interval
from statistics_judge.parts import OF_STATISTIC, Part
from statistics_judge.records import Paper, Reals

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


def left_out(row: dict[str, Any]) -> str | None:
    """Why a row is not compared; none if it is."""
    if row["sessions"]:
        return "rest on the clock"
    if row["ends"] != "measured":
        return "are of cases as if they had ended"
    if row["value"] is None and not row["values"]:
        return "have counts alone"
    return None


def criterion_of(claim: dict[str, Any], row: dict[str, Any]) -> str | None:
    """The criterion of a claim that asks for the number of a row; none if several may."""
    names = [name for name in ASKED_BY.get(row["statistic"], ()) if name in claim.get("check", {})]
    return names[0] if len(names) == 1 else None


def explored(paper: Paper, *, has_more: bool) -> Paper:
    """The paper with the trials alone that its exploration keeps."""
    kept = {**paper.explore.get("instances", {})}
    kept |= paper.explore.get("more_instances", {}) if has_more else {}
    of_exploration = copy.copy(paper)
    studies = {
        name: study.first(kept.get(name), paper.explore.get("repeats", {}).get(name))
        for name, study in paper.studies.items()
    }
    # A study is explored by the trials of the one that stands for it.
    of_exploration.studies = studies | {other: studies[name] for name, other in paper.stands_for.items()}
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
    """Whether the trials behind a row are stored: as many instances are."""
    kept = paper.explore.get("more_instances" if row["has_more_instances"] else "instances", {})
    stands_in = {other: name for name, other in paper.stands_for.items()}
    names = [stands_in.get(name, name) for name in row["study"].split(", ")]
    return all(paper.studies[name].has_instances(kept.get(name, 0)) for name in names)


@dataclass(frozen=True)
class Row:
    """A row of the table with what the trials give in its place, or why it is not compared."""

    where: str
    row: dict[str, Any]
    own: Estimate | None = None
    values: Reals | None = None
    left_out: str | None = None


def compared(paper: Paper, finds: Finds) -> Iterator[Row]:
    """Each row with what the trials give."""
    papers = [explored(paper, has_more=has_more) for has_more in (False, True)]
    all_rows = itertools.groupby(rows(paper), lambda row: row["answer"])
    for answer in (list(answer) for _, answer in all_rows):
        first = answer[0]
        of_row = papers[first["has_more_instances"]]
        # Claims that ask the same share a row.
        claim = next((one for one in paper.claims if one["id"] in first["claim"].split(", ")), {})
        more = ", with more instances" if first["has_more_instances"] else ""
        where = (
            f"{paper.id}: estimates.parquet, `{claim.get('id', first['claim'])}` ({first['statistic']}{more})"
        )
        reasons = [left_out(row) for row in answer]
        if not has_trials(paper, first):
            reasons = ["rest on instances that are not stored"] * len(answer)
        kept = [row for row, reason in zip(answer, reasons, strict=True) if reason is None]
        yield from (Row(where, row, left_out=why) for row, why in zip(answer, reasons, strict=True) if why)
        if not kept:
            continue
        name, parts_of = OF_STATISTIC.get(first["statistic"], ("", None))
        settings = claim.get("check", {}).get(name)
        whole = criterion_of(claim, first)
        if parts_of is not None and settings is not None:
            asked = Asked(of_row, claim, settings, 1, f"{paper.id} {where}")
            yield from of_parts(where, kept, parts_of(asked))
            continue
        for row in kept:
            if whole is None or row["part"]:
                yield Row(where, row, left_out=f"are of `{row['statistic']}`{' by part' * bool(row['part'])}")
                continue
            found = finds(of_row, claim, whole)
            yield Row(where, row, found and as_stored(whole, found))


def of_parts(where: str, stored: list[dict[str, Any]], own: list[Part]) -> Iterator[Row]:
    """The rows of parts beside ours, both in the order of their names and numbers."""
    stored = sorted(stored, key=lambda row: (row["part"], row["value"] or 0.0, row["outside"]))
    own = sorted(own, key=lambda part: (part.name, part.estimate.value if part.estimate else 0.0))
    for row, part in itertools.zip_longest(stored, own):
        if row is None:
            row = {**dict.fromkeys(stored[0]), "part": part.name, "values": []}
        at = f"{where}, {row['part']}" if row["part"] else where
        if part is None or part.name != row["part"]:
            yield Row(at, row)
            continue
        found = part.estimate
        if found is not None and not row["n"]:
            # Medians of sets are stored without their trials.
            found = replace(found, n=0)
        yield Row(at, row, found, part.values)
