"""Judges a paper's claims anew, and holds what verdicts.toml says against that."""

import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from statistics_judge import across, classes, estimates, means, medians, printed_cells, shares, sizes
from statistics_judge.found import FEWEST_INSTANCES, Asked, Estimate, Found
from statistics_judge.records import Paper, Reals, Study
from statistics_judge.selection import groups_of, is_drawn, labels, select

CRITERIA: dict[str, Callable[[Asked], Found]] = {
    "equals": shares.equals,
    "exists": medians.exists,
    "least_of": medians.least_of,
    "lower": sizes.lower,
    "mean_of": means.mean_of,
    "on_every": shares.on_every,
    "one_instance": printed_cells.one_instance,
    "prints_as": printed_cells.prints_as,
    "row_one_instance": printed_cells.row_one_instance,
    "share": shares.share_within,
    "table_means": means.table_means,
    "trend": sizes.trend,
    "within": sizes.within,
}

# Sessions of a clock that it takes to say anything.
SESSIONS = 3

Classes = frozenset[str | None]


@dataclass(frozen=True)
class Recomputed:
    """A finding: the classes that it may have, one unless chance decides, and our number."""

    criterion: str
    classes: Classes
    estimate: Estimate | None = None
    # Whether nothing is drawn, as far as groups, instances and seeds show.
    is_undrawn: bool = False


@dataclass
class Claim:
    """A claim: its findings, those of rules left open, and what it takes to combine them."""

    id: str
    findings: list[Recomputed | None]
    names: list[str]
    untestable: bool
    parts: tuple[str, list[str]] | None
    meant: bool = True


@dataclass
class Compared:
    """What a comparison gives."""

    estimates: int = 0
    intervals: int = 0
    classes: int = 0
    across: int = 0
    # Rows of the defaults in estimates.parquet: those computed again, and the others by the reason.
    rows: int = 0
    left_out: Counter[str] = field(default_factory=Counter)
    near: list[str] = field(default_factory=list)
    differ: list[str] = field(default_factory=list)


def recomputed(paper: Paper) -> list[Claim]:
    """Every claim of a paper, judged anew."""
    return [of_claim(paper, claim) for claim in paper.claims]


def of_claim(paper: Paper, claim: dict[str, Any]) -> Claim:
    """One claim: rules, then criteria that decide, then those that are shown, each by name."""
    findings: list[Recomputed | None] = []
    names = sorted(claim.get("rule", {}))
    findings += [None] * len(names)
    for name, settings in sorted(claim.get("check", {}).items()):
        found = of_criterion(paper, claim, name, settings, decides=True)
        findings.append(replace(found, is_undrawn=is_undrawn(paper, settings)))
        names.append(name)
    for name, tables in sorted(claim.get("shows", {}).items()):
        for settings in tables:
            found = of_criterion(paper, claim, name, settings, decides=False)
            findings.append(replace(found, is_undrawn=is_undrawn(paper, settings)))
            names.append(name)
    parts = next(((kind, claim[kind]) for kind in classes.PARTS if claim.get(kind)), None)
    if parts and parts[0] == "cells" and names:
        # A row with criteria of its own is judged by them.
        parts = None
    return Claim(claim["id"], findings, names, "untestable" in claim, parts, is_meant(paper, claim))


def is_fitted(paper: Paper, claim: dict[str, Any], fitted_to: set[str]) -> bool:
    """Whether a study is fitted to the claim's number, to its row or table, or to both cells of a difference."""
    if "difference" in claim and all(
        is_fitted(paper, paper.claim(cell), fitted_to) for cell in claim["difference"]
    ):
        return True
    alike = {
        other["id"]
        for other in paper.claims
        if all(claim.get(key) == other.get(key) for key in ("printed", "check", "shows"))
    }
    places = [
        (one["id"], place["claims"])
        for one in paper.claims
        for place in one.get("check", {}).get("table_means", {}).get("in", [])
    ]
    wholes = [(row["id"], row.get("cells", [])) for row in paper.claims] + places
    alike |= {whole for whole, cells in wholes if alike & set(cells)}
    return bool(alike & fitted_to)


def of_criterion(
    paper: Paper, claim: dict[str, Any], name: str, settings: dict[str, Any], *, decides: bool
) -> Recomputed:
    """One criterion's finding with its class."""
    criterion = CRITERIA[name]

    def find(session: int) -> Found:
        seed = f"{paper.id} {claim['id']} {name} {session}"
        return criterion(Asked(paper, claim, settings, session, seed))

    found = find(1)
    if not (decides and is_meant(paper, claim)):
        return Recomputed(name, frozenset([None]), found.estimate)
    studies = [paper.studies[of] for of in studies_of(settings)]
    is_cut = any(select(paper, of, 1).cut_left_out for of in selections_of(settings))
    clock = None
    if reads_clock(paper, settings):
        if not paper.ours:
            # A sentence about the authors' times: our clock does not test it.
            return Recomputed(name, frozenset(["not_testable"]), found.estimate)
        clock = lacks_sessions(min(study.sessions for study in studies), find)
    possible = frozenset(
        outcome
        and classes.of_finding(
            outcome,
            searched=any(study.spec.get("searched", False) for study in studies),
            fitted=is_fitted(
                paper, claim, {one for study in studies for one in study.spec.get("fitted_to", [])}
            ),
            existential=found.existential,
            powerless=found.powerless,
            censored=censored or is_cut,
            few=is_few(name, settings, found),
            clock=bool(clock),
            not_run=is_not_run(paper, claim, studies),
        )
        for outcome, censored in itertools.product(found.possible, found.censored)
    )
    return Recomputed(name, possible, found.estimate)


def is_meant(paper: Paper, claim: dict[str, Any]) -> bool:
    """Whether a claim is meant under the interpretations that it is judged under."""
    return all(paper.taken[choice] in options for choice, options in claim.get("holds_when", {}).items())


def is_not_run(paper: Paper, claim: dict[str, Any], studies: list[Study]) -> bool:
    """Whether the paper may mean an option that cannot be run, of a choice that these studies inherit."""
    premises = claim.get("holds_when", {})
    for choice in across.choices(paper):
        lost = [
            name
            for name, option in choice.options.items()
            if "cannot_run" in option and choice.is_meant(name)
        ]
        lost = [name for name in lost if name in premises.get(choice.id, [name])]
        of_claims = any(key in option for option in choice.options.values() for key in ("metric", "digits"))
        if lost and (of_claims or any(choice.id in study.inherited for study in studies)):
            return True
    return False


def is_few(name: str, settings: dict[str, Any], found: Found) -> bool:
    """Whether an interval that is not exact rests on too few instances."""
    resampled = (
        name in ("lower", "mean_of", "share", "trend", "within")
        and settings.get("statistic") != "ratio_of_groups"
    )
    ours = found.estimate
    if found.few:
        return True
    return resampled and ours is not None and not ours.exact and ours.n < FEWEST_INSTANCES


def selections_of(settings: dict[str, Any]) -> list[dict[str, Any]]:
    """Where only whole instances count, the selections of a criterion, one a row."""
    of = settings.get("select", {})
    if not of.get("whole_instances", False):
        return []
    rows = settings.get("rows", [{}])
    return [{**of, **{key: row[key] for key in ("contender", "against") if key in row}} for row in rows]


def studies_of(settings: dict[str, Any]) -> list[str]:
    """The studies whose trials a criterion looks at."""
    if "select" in settings:
        return [settings["select"]["study"]]
    return [place["study"] for place in settings["in"]]


def is_undrawn(paper: Paper, settings: dict[str, Any]) -> bool:
    """Whether a criterion looks at single instances of problems that are not drawn, and at single seeds."""
    places = [settings["select"]] if "select" in settings else settings["in"]
    known = [paper.studies[place["study"]] for place in places]
    groups = [
        (study, group)
        for study, place in zip(known, places, strict=True)
        for group in groups_of(study, place.get("problems", []))
    ]
    if any(is_drawn(study, group) for study, group in groups):
        return False
    every = {one["label"] for study in known for one in study.spec["contender"]}
    named = set(texts(settings)) & every or every
    of_groups = [(study, study.rows(group, label)) for study, group in groups for label in named]
    return not any(study.instance[rows].any() or study.repeat[rows].any() for study, rows in of_groups)


def texts(value: Any) -> Iterator[str]:  # noqa: ANN401
    """Every text in some settings."""
    if isinstance(value, str):
        yield value
    for one in value.values() if isinstance(value, dict) else value if isinstance(value, list) else []:
        yield from texts(one)


def reads_clock(paper: Paper, settings: dict[str, Any]) -> bool:
    """Whether a criterion rests on our own clock."""
    name = settings.get("metric") or settings.get("select", {}).get("metric")
    return name is not None and paper.metric(name).clock


def lacks_sessions(stored: int, find: Callable[[int], Found]) -> bool:
    """Whether a clock has too few sessions, or they disagree."""
    if stored < SESSIONS:
        return True
    return len({find(session).outcome for session in range(1, stored + 1)}) > 1


def compare(paper: Paper, claims: list[Claim], verdicts: dict[str, Any]) -> Compared:
    """What verdicts.toml and estimates.parquet say, held against what was recomputed."""
    compared = Compared()
    if not compare_claims(paper, claims, verdicts, compared):
        return compared
    for line in across.differences(paper, verdicts):
        if line is None:
            compared.across += 1
        else:
            compared.differ.append(line)
    compare_rows(paper, claims, compared)
    return compared


def compare_claims(paper: Paper, claims: list[Claim], verdicts: dict[str, Any], compared: Compared) -> bool:
    """The claims under the default interpretation; whether verdicts.toml has the claims of paper.toml."""
    if verdicts["interpretation"] != paper.taken:
        compared.differ.append(
            f"{paper.id}: verdicts.toml was judged under other interpretations than the default"
        )
        return False
    stored = {one["claim"]: one for one in verdicts.get("claim", [])}
    if list(stored) != [claim.id for claim in claims]:
        compared.differ.append(
            f"{paper.id}: verdicts.toml has other claims than paper.toml, or in another order"
        )
        return False
    known = [compare_findings(paper.id, claim, stored[claim.id], compared) for claim in claims]
    alone = {claim.id: whole(claim, possible) for claim, possible in zip(claims, known, strict=True)}
    for claim, possible in zip(claims, known, strict=True):
        compare_claim(paper.id, claim, stored[claim.id], (possible, alone), compared)
    return True


def compare_rows(paper: Paper, claims: list[Claim], compared: Compared) -> None:
    """The default interpretation's rows of estimates.parquet."""
    known = {claim.id: claim for claim in claims}

    def finds(of: Paper, claim: dict[str, Any], name: str) -> Estimate | None:
        studies = studies_of(claim["check"][name])
        judged = known[claim["id"]]
        if all(of.studies[study] is paper.studies[study] for study in studies):
            found = judged.findings[judged.names.index(name)]
            return found.estimate if found else None
        return of_criterion(of, claim, name, claim["check"][name], decides=False).estimate

    for found in estimates.compared(paper, finds):
        row, own = found.row, found.own
        if found.left_out is not None:
            compared.left_out[found.left_out] += 1
            continue
        compared.rows += 1
        if found.values is not None:
            lines = list_differences(found.values, row["values"])
        else:
            interval = None if row["low"] is None else [row["low"], row["high"]]
            stored = {"value": row["value"], "n": row["n"], "interval": interval}
            if own is not None and own.solved is not None:
                stored["solved"] = [row["solved"], row["total"]]
            lines = differences(own, None if row["value"] is None else stored, Compared())
        compared.differ += [f"{found.where}: {line}" for line in lines]


def list_differences(own: Reals, stored: list[float]) -> Iterator[str]:
    """What differs between the numbers of all instances."""
    if len(own) != len(stored):
        yield f"it has {len(stored)} instances; recomputed there are {len(own)}"
    elif not np.allclose(np.sort(own), np.sort(stored), rtol=1e-9, atol=1e-12):
        yield "its value is another on some instance"


def whole(claim: Claim, possible: list[Classes]) -> Classes:
    """The classes that a claim may have, from those of its findings."""
    return each(lambda found: classes.combined(filter(None, found), claim.untestable), possible)


def each(of: Callable[[list], str], possible: Iterable[Classes]) -> Classes:
    """What a function says of every choice among possible classes."""
    # What is certain is one choice; few are not.
    return frozenset(of(list(choice)) for choice in itertools.product(*possible))


def compare_findings(paper: str, claim: Claim, stored: dict[str, Any], compared: Compared) -> list[Classes]:
    """The findings of one claim; gives the classes that each may have."""
    findings = stored.get("finding", [])
    names = [finding["criterion"] for finding in findings]
    extra = (["none"] if claim.untestable else []) + ([claim.parts[0]] if claim.parts else [])
    if names != claim.names + extra:
        compared.differ.append(
            f"{paper}: `{claim.id}` has findings {names}; {claim.names + extra} are asked for"
        )
        return [frozenset([finding.get("outcome")]) for finding in findings[: len(claim.names)]]
    known = []
    for place, (own, finding) in enumerate(zip(claim.findings, findings, strict=False)):
        if own is None:
            known.append(frozenset([finding.get("outcome")]))
            continue
        where = f"{paper}: `{claim.id}`, finding {place + 1} ({own.criterion})"
        estimate = own.estimate
        if estimate and own.is_undrawn and "interval" not in (finding.get("ours") or {}):
            # Nothing is drawn, so that no other instance could be.
            estimate = replace(estimate, interval=None)
        for line in differences(estimate, finding.get("ours"), compared):
            compared.differ.append(f"{where}: {line}")
        compare_class(where, finding.get("outcome"), own.classes, compared)
        known.append(own.classes)
    return known


def compare_claim(
    paper: str,
    claim: Claim,
    stored: dict[str, Any],
    known: tuple[list[Classes], dict[str, Classes]],
    compared: Compared,
) -> None:
    """The class of one claim, and that of its parts."""
    possible, alone = known
    if claim.parts:
        kind, ids = claim.parts
        of_parts: Classes = frozenset([None])
        if claim.meant:
            of_parts = each(classes.PARTS[kind], [alone[part] for part in labels(ids)])
        finding = stored["finding"][-1] if stored.get("finding") else {}
        compare_class(f"{paper}: `{claim.id}` ({kind})", finding.get("outcome"), of_parts, compared)
        possible = [*possible, of_parts]
    # Findings are those under the default interpretation; the verdict over all interpretations is another question.
    compare_class(f"{paper}: `{claim.id}`", stored["outcome"], whole(claim, possible), compared)


def compare_class(where: str, stored: str | None, possible: Classes, compared: Compared) -> None:
    """One class."""
    named = " or ".join(sorted(str(one or "none") for one in possible))
    if stored not in possible:
        compared.differ.append(f"{where}: its outcome is {stored or 'none'}; recomputed it is {named}")
        return
    compared.classes += 1
    if len(possible) > 1:
        compared.near.append(f"{where}: Monte-Carlo error decides whether its outcome is {named}")


def differences(own: Estimate | None, stored: dict[str, Any] | None, compared: Compared) -> Iterator[str]:
    """What differs between our number and the stored one."""
    if own is None or stored is None:
        if (own is None) != (stored is None):
            has, finds = ("no", "one") if stored is None else ("a", "none")
            yield f"verdicts.toml has {has} number; recomputed there is {finds}"
        return
    if abs(own.value - stored["value"]) <= 1e-9 * max(abs(own.value), 1.0) or own.value == stored["value"]:
        compared.estimates += 1
    else:
        yield f"its value is {stored['value']!r}; recomputed it is {own.value!r}"
    if own.n != stored["n"]:
        yield f"it rests on n = {stored['n']}; recomputed on {own.n}"
    solved = None if own.solved is None else list(own.solved)
    if solved != stored.get("solved"):
        yield f"solved are {stored.get('solved')}; recomputed they are {solved}"
    yield from interval_differences(own, stored.get("interval"), compared)


def interval_differences(own: Estimate, stored: list[float] | None, compared: Compared) -> Iterator[str]:
    """What differs between our interval and the stored one."""
    if own.interval is None or stored is None:
        if (own.interval is None) != (stored is None):
            ends = own.interval and [end.at for end in own.interval]
            yield f"its interval is {stored}; recomputed it is {ends}"
        return
    if all(end.allows(number) for end, number in zip(own.interval, stored, strict=True)):
        compared.intervals += 1
        return
    low, high = own.interval
    yield (
        f"its interval is [{stored[0]!r}, {stored[1]!r}]; recomputed it is [{low.at!r}, {high.at!r}], "
        f"and chance allows a low end in [{low.least!r}, {low.most!r}] "
        f"and a high end in [{high.least!r}, {high.most!r}]"
    )
