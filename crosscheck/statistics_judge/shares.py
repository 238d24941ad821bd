"""Criteria that count: equals, on_every and share."""

from dataclasses import replace

import numpy as np

from statistics_judge.classes import FAILS, HOLDS, OPEN
from statistics_judge.found import FEWEST_INSTANCES, Asked, Estimate, Found, certain, hangs, outcomes
from statistics_judge.intervals import agreed, clopper_pearson, hull, sums_by_unit, weighted_share
from statistics_judge.records import Flags, Places, Reals
from statistics_judge.selection import Cases, groups_of, is_drawn, labels

# Numbers no farther apart are equal.
EQUAL = 1e-9


def share(hits: Reals, chances: Reals, most: float, seed: str) -> Estimate | None:
    """A share by units with chances, `most` at most: exact where each has one or all agree at an end.

    Else it is that of the units and one more, a hit throughout or a miss throughout, weighted at random.
    """
    asked = chances > 0
    hits, chances = hits[asked], chances[asked]
    if not asked.any():
        return None
    value, most = float(hits.sum() / chances.sum()), max(most, float(chances.max()))
    if most <= 1 and (chances == 1).all():
        return Estimate(value, len(hits), clopper_pearson(int(hits.sum()), int(chances.sum())), exact=True)
    if len(hits) < 2:
        return Estimate(value, len(hits), None)
    allowing = agreed(hits, chances, most)
    if allowing:
        return Estimate(value, len(hits), allowing, exact=value in (0.0, 1.0))
    return Estimate(value, len(hits), weighted_share(hits, chances, most, seed))


def counted(cases: Cases, asked: Flags, hit: Flags, seed: str) -> Estimate | None:
    """The share of cases asked that are hit, by units."""
    unit = cases.unit[asked]
    hits, chances = sums_by_unit(unit, cases.units, hit[asked].astype(float), np.ones(len(unit)))
    return share(hits, chances, most_cases(cases), seed)


def most_cases(cases: Cases) -> float:
    """The most cases of any unit."""
    return float(np.bincount(cases.unit).max(initial=0))


def with_cases(estimate: Estimate | None, solved: tuple[int, int]) -> Estimate | None:
    """The estimate with how many cases were solved."""
    return estimate and replace(estimate, solved=solved)


def equals(asked: Asked) -> Found:
    """Every number is that of an oracle or of the other contender."""
    cases = asked.cases()
    if "truth" in asked.settings:
        truth = cases.raw(asked.paper.metric(asked.settings["truth"]))
        own = cases.raw(asked.paper.metric(asked.settings["select"]["metric"]))
        known = ~np.isnan(truth)
        own = np.where(np.isnan(own), np.inf, own)
    else:
        truth, own, known = cases.bases, cases.values, cases.paired
    apart = np.abs(own - truth)
    same = apart <= asked.settings.get("within", 0.0) + 1e-9 * np.abs(truth)
    estimate = with_cases(counted(cases, known, same, asked.seed), (int(same[known].sum()), int(known.sum())))
    if not known.any():
        return certain(OPEN, estimate)
    cut = cases.might_be_solved & ~(known & np.isfinite(own))
    found = certain(HOLDS if same[known].all() else FAILS, estimate)
    # That something is wrong hangs on what did not end only if nothing else is.
    is_wrong = bool((~same & known & ~cut).any())
    few = found.outcome == HOLDS and needs_draws(cases, labels(asked.settings["select"]["problems"]))
    return replace(found, censored=frozenset([not is_wrong and bool(cut.any())]), few=few)


def on_every(asked: Asked) -> Found:
    """It holds on every case: one counterexample ends it, as do equalities alone on enough cases; some leave it open.

    A case without an end might be the counterexample; paths that are refused have one where it is to be at
    most so much.
    """
    cases, that = asked.cases(), asked.settings["that"]
    says, spoken = directions(cases, that, asked.settings.get("bound", 0.0))
    estimate = with_cases(counted(cases, spoken, says > 0, asked.seed), cases.solved_of_all())
    kept, equal, broken = (int((says[spoken] == way).sum()) for way in (1, 0, -1))
    if kept + equal + broken == 0:
        return certain(OPEN, estimate)
    if broken > 0:
        # One counterexample is enough.
        return certain(FAILS, estimate)
    outcome = FAILS if kept == 0 else OPEN if equal else HOLDS
    cut = bool(counterexamples(cases, that).any())
    few = outcome != OPEN and needs_draws(cases, labels(asked.settings["select"]["problems"]))
    return replace(certain(outcome, estimate), censored=frozenset([cut]), few=few)


def counterexamples(cases: Cases, that: str) -> Flags:
    """Cases that might be counterexamples and are not known to be none."""
    if that != "solved":
        return cases.might_be_solved
    own, base = cases.cut()
    return (own & (base | cases.base_solved)) | (base & ~cases.own_solved)


def needs_draws(cases: Cases, problems: list[str]) -> bool:
    """Whether groups that are drawn have too few instances for what holds on each of them to be firm.

    Those that were searched for show what can be.
    """
    if cases.study.spec.get("searched", False):
        return False
    names = groups_of(cases.study, problems)
    drawn = [place for place, name in enumerate(names) if is_drawn(cases.study, name)]
    return bool(drawn) and len(np.unique(cases.unit[np.isin(cases.group, drawn)])) < FEWEST_INSTANCES


def directions(cases: Cases, that: str, bound: float) -> tuple[Reals, Flags]:
    """How each case speaks (1 for, 0 equal, -1 against), and whether it is asked."""
    if that == "solved":
        return np.where(cases.own_solved, 1.0, -1.0), cases.base_solved & ~cases.cut()[0]
    if that == "lower":
        gap = cases.values - cases.bases
        return np.where(gap < -EQUAL, 1.0, np.where(gap > EQUAL, -1.0, 0.0)), cases.paired
    if that == "at_most_times":
        return np.where(cases.values <= bound * cases.bases + EQUAL, 1.0, -1.0), cases.paired
    if that == "above":
        return np.where(cases.values > bound + EQUAL, 1.0, -1.0), ~np.isnan(cases.values)
    returned = np.isin(cases.study.status[cases.own], ["solved", "rejected"])
    if that == "accepted":
        return np.where(cases.own_solved, 1.0, -1.0), returned
    if that != "at_most":
        raise ValueError(f"on_every: that = {that!r} is not known here")
    assert cases.metric is not None
    value = cases.raw(cases.metric)
    return np.where(value <= bound + EQUAL, 1.0, -1.0), returned & ~np.isnan(value)


def share_within(asked: Asked) -> Found:
    """A share lies within bounds."""
    cases, settings = asked.cases(), asked.settings
    hits, chances = by_unit(asked, cases)
    of_instances = ("lower_throughout", "solved_more", "solved_more_throughout", "solved_at_least")
    few = {**dict.fromkeys(of_instances, 1.0), "events": 0.0}
    most = few.get(settings["hits"], most_cases(cases))
    estimate = with_cases(share(hits, chances, most, asked.seed), cases.solved_of_all())
    if "accepted" not in settings:
        return certain(None, estimate)
    if estimate is None or estimate.interval is None:
        return certain(OPEN, estimate)
    least, greatest = settings["accepted"]

    def outcome(low: float, high: float) -> str:
        if least <= low and high <= greatest:
            return HOLDS
        return FAILS if high < least or low > greatest else OPEN

    low, high = estimate.interval
    main = Found(outcome(low.at, high.at), outcomes(outcome, estimate.interval), estimate)
    ends = []
    lost = unknown(asked, cases)
    if lost.any() and settings["hits"] == "events":
        # How many there would have been is not known even as a bound.
        return replace(main, censored=frozenset([True]))
    if lost.any():
        # All that the share may be: from no hit of these to hits alone.
        ways = [share(*by_unit(asked, cases, given), most, asked.seed + " filled") for given in (False, True)]
        intervals = [found.interval for found in ways if found is not None and found.interval is not None]
        ends = [outcomes(outcome, hull(intervals))] if len(intervals) == 2 else []
    return replace(main, censored=hangs(main.outcome, main.possible, ends))


def unknown(asked: Asked, cases: Cases) -> Flags:
    """Cases that might be hits and are not known to be."""
    kind = asked.settings["hits"]
    if kind in ("marked", "events"):
        return cases.unended & (hits_of(asked, cases)[1] == 0)
    if kind in ("above", "lower", "higher", "lower_throughout"):
        return cases.might_be_solved
    # What the other contender solves is none of its failures.
    return cases.unended & ~cases.base_solved if kind == "cured" else cases.unended


def by_unit(asked: Asked, cases: Cases, given: bool | None = None) -> tuple[Reals, Reals]:
    """Hits and chances of each unit; cases of which nothing is known are left out, or all hits or misses."""
    kind = asked.settings["hits"]
    if kind == "solved_more":
        return solves_more(cases, given, np.zeros(len(cases.own), dtype=np.int64))
    if kind == "solved_more_throughout":
        return solves_more(cases, given, cases.study.sweep[0][cases.own])
    hits, chances = hits_of(asked, cases)
    if given is not None:
        lost = unknown(asked, cases)
        hits, chances = np.where(lost, float(given), hits), np.where(lost, 1.0, chances)
    hits, chances = sums_by_unit(cases.unit, cases.units, hits, chances)
    if kind in ("lower_throughout", "solved_at_least"):
        least = asked.settings["bound"] * chances - EQUAL if kind == "solved_at_least" else chances
        return ((hits >= least) & (chances > 0)).astype(float), (chances > 0).astype(float)
    return hits, chances


def solves_more(cases: Cases, given: bool | None, point: Places) -> tuple[Reals, Reals]:
    """Whether more cases of each unit are solved than by the other contender at every point that it has.

    What did not end is solved by this one alone, or by the other alone, if that is given.
    """
    assert cases.base is not None
    own = cases.ended_as(cases.own, given is True).astype(float)
    base = cases.ended_as(cases.base, given is False).astype(float)
    pairs, at = np.unique(np.stack([cases.unit, point]), axis=1, return_inverse=True)
    [more] = sums_by_unit(at.ravel(), pairs.shape[1], own - base)
    missed, count = sums_by_unit(pairs[0], cases.units, (more <= 0).astype(float), np.ones(pairs.shape[1]))
    return ((missed == 0) & (count > 0)).astype(float), (count > 0).astype(float)


def hits_of(asked: Asked, cases: Cases) -> tuple[Reals, Reals]:
    """Hits and chances of each case."""
    settings, kind = asked.settings, asked.settings["hits"]
    status = cases.study.status[cases.own]
    gap = np.where(cases.paired, cases.values - cases.bases, np.nan)
    columns = [cases.study.column(name)[cases.own] for name in settings.get("columns", [])]
    if kind == "events":
        events, chances = columns[0], cases.study.column(settings["per"])[cases.own]
        known = ~np.isnan(events) & ~np.isnan(chances)
        return np.where(known, events, 0), np.where(known, chances, 0)
    always = np.ones(len(status), dtype=bool)
    if kind in ("solved", "solved_at_least"):
        hit, known = status == "solved", always
    elif kind == "rejected":
        hit, known = status == "rejected", np.isin(status, ["solved", "rejected"])
    elif kind == "marked":
        hit = np.stack(columns).min(axis=0) > 0
        known = ~np.isnan(np.stack(columns)).any(axis=0)
    elif kind == "above":
        hit, known = cases.values > settings["bound"] + EQUAL, ~np.isnan(cases.values)
    elif kind in ("lower", "lower_throughout"):
        hit, known = gap < -EQUAL, cases.paired
    elif kind == "higher":
        hit, known = gap > EQUAL, cases.paired
    elif kind == "cured":
        hit, known = cases.own_solved, ~cases.base_solved & ~cases.cut()[1]
    else:
        raise ValueError(f"share: hits = {kind!r} is not known here")
    return (hit & known).astype(float), known.astype(float)
