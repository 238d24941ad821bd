"""Criteria that look for the least and for one that meets: exists and least_of."""

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from statistics_judge.classes import FAILS, HOLDS, OPEN, SIGN
from statistics_judge.found import Asked, Estimate, Found, certain, hangs, outcomes
from statistics_judge.intervals import End, Interval, bootstrap, median
from statistics_judge.records import Places, Reals, Study
from statistics_judge.selection import CUT, groups_of, is_drawn, labels, matched, posed
from statistics_judge.sizes import printed

# Numbers whose ratio is nearer to one are equal.
EQUAL = 1e-9
# Fewest seeds of two contenders that draw of which medians decide.
FEWEST_SEEDS = 4
# What leaves out some of a contender's trials.
NARROWED = ("query", "sweep")


def least_of(asked: Asked) -> Found:
    """Some contenders' medians over seeds, failures infinite, are below those of others on every problem."""
    settings, of = asked.settings, asked.settings["select"]
    study = asked.paper.studies[of["study"]]
    # Problems of which none could be posed say nothing.
    every = groups_of(study, of["problems"])
    pairs = list(itertools.product(labels(settings["lower"]), labels(settings["higher"])))
    groups = [group for group in every if could_be_posed(study, group, pairs)] or every
    compared = compare(asked, groups, pairs, (np.inf, np.inf))
    estimate = None
    if compared:
        # Of equally large ones the last.
        worst = max(reversed(compared), key=lambda found: found.value)
        interval = worst.interval
        assert interval is not None
        from_, to = (end.mapped(lambda r: 100 * r) for end in interval)
        known = None if np.isinf([from_.at, to.at]).any() else (from_, to)
        estimate = Estimate(100 * worst.value, worst.n, known)
    if len(compared) < len(pairs) * len(groups):
        return certain(OPEN, estimate)
    limit = 1 - settings.get("by_percent", 0.0) / 100

    def outcome(greatest_low: float, greatest_high: float) -> str:
        if greatest_high < limit:
            return HOLDS
        if greatest_low < limit:
            return OPEN
        return SIGN if greatest_high < 1 else FAILS

    def outcome_of(compared: list[Estimate]) -> tuple[str, frozenset[str | None]]:
        ends = [found.interval for found in compared if found.interval is not None]
        whole = greatest(low for low, _ in ends), greatest(high for _, high in ends)
        return outcome(whole[0].at, whole[1].at), outcomes(outcome, whole)

    main, possible = outcome_of(compared)
    is_cut = any(unended(asked, group, label) for group in groups for pair in pairs for label in pair)
    # 0 for the claim and infinite against it, then the other way round.
    ways = ((0.0, np.inf), (np.inf, 0.0)) if is_cut else ()
    ends = [outcome_of(compare(asked, groups, pairs, way))[1] for way in ways]
    few = any(has_few_seeds(asked, group, label) for group in groups for pair in pairs for label in pair)
    return Found(main, possible, estimate, censored=hangs(main, possible, ends), few=few)


def could_be_posed(study: Study, group: str, pairs: list[tuple[str, str]]) -> bool:
    """Whether a problem could be posed to some contender, or nothing ran on it."""
    rows = np.concatenate([study.rows(group, label) for pair in pairs for label in pair])
    return len(rows) == 0 or bool((study.status[rows] != "invalid_problem").any())


def has_few_seeds(asked: Asked, group: str, contender: str) -> bool:
    """Whether a contender that draws, or one on a problem that was drawn, has too few seeds."""
    found = side(asked, group, contender, np.inf)
    study = asked.paper.studies[asked.settings["select"]["study"]]
    least = 1 if is_drawn(study, group) else 2
    return found is not None and least <= found.n < FEWEST_SEEDS


def compare(
    asked: Asked, groups: list[str], pairs: list[tuple[str, str]], given: tuple[float, float]
) -> list[Estimate]:
    """Every comparison that was measured, trials without an end being given this on either side."""
    return [found for *_, found in compared_on(asked, groups, pairs, given)]


def compared_on(
    asked: Asked, groups: list[str], pairs: list[tuple[str, str]], given: tuple[float, float]
) -> Iterator[tuple[str, str, str, Estimate]]:
    """The same, each with its problem and both contenders."""
    for group in groups:
        for one, other in pairs:
            low, high = side(asked, group, one, given[0]), side(asked, group, other, given[1])
            if low is not None and high is not None:
                yield group, one, other, ratio(low, high)


def compared_pairs(asked: Asked, given: tuple[float, float]) -> Iterator[tuple[str, str, str, Estimate]]:
    """Every comparison that was measured, on all problems."""
    settings, of = asked.settings, asked.settings["select"]
    pairs = list(itertools.product(labels(settings["lower"]), labels(settings["higher"])))
    return compared_on(asked, groups_of(asked.paper.studies[of["study"]], of["problems"]), pairs, given)


def unended(asked: Asked, group: str, contender: str) -> bool:
    """Whether some trial of a contender did not come to an end."""
    of = asked.settings["select"]
    study = asked.paper.studies[of["study"]]
    return bool(np.isin(study.status[posed(study, group, contender, of)], CUT).any())


def greatest(ends: Iterable[End]) -> End:
    """The greatest of several ends."""
    listed = list(ends)
    return End(*(max(getattr(end, of) for end in listed) for of in ("at", "least", "most")))


def side(asked: Asked, group: str, contender: str, given: float) -> Estimate | None:
    """The median of one contender on one problem, computed once for all claims that compare it."""
    of = asked.settings["select"]
    known = asked.paper.studies[of["study"]].known
    key = (
        group,
        contender,
        asked.paper.metric(of["metric"]).name,
        asked.session,
        given,
        *(str(of.get(key)) for key in NARROWED),
    )
    if key not in known:
        known[key] = measured_side(asked, group, contender, of, given)
    return known[key]


def measured_side(
    asked: Asked, group: str, contender: str, of: dict[str, Any], given: float
) -> Estimate | None:
    """The median over seeds, failures infinite, what did not end as given; an interval over seeds."""
    study, metric = asked.paper.studies[of["study"]], asked.paper.metric(of["metric"])
    rows = posed(study, group, contender, of)
    values = study.values(metric, asked.session)[rows]
    if metric.clock:
        rows, values = rows[~np.isnan(values)], values[~np.isnan(values)]
    missing = np.where(np.isin(study.status[rows], CUT), given, np.inf)
    values = np.where(metric.given(study.status[rows]) & ~np.isnan(values), values, missing)
    if len(values) == 0:
        return None
    units = values
    if metric.clock and len(values) == 1:
        units = np.array(study.repeats(int(rows[0]), metric, asked.session))
    seed = f"{study.name} {group} {contender} {metric.name}"
    interval = bootstrap(median(np.arange(len(units)), units), len(units), seed)
    own = End.exact(float(values[0]))
    return Estimate(middle(values), len(values), interval or (own, own))


def middle(values: Reals) -> float:
    """The median, of infinite numbers too."""
    ordered = np.sort(values)
    return float(ordered[(len(ordered) - 1) // 2] / 2 + ordered[len(ordered) // 2] / 2)


def over(above: float, below: float) -> float:
    """A ratio; two zeros and two failures are equal, and so are sums of the same steps in another order."""
    if above == below or abs(above - below) <= EQUAL * abs(below) < np.inf:
        return 1.0
    return np.inf if below == 0 else above / below


def ratio(one: Estimate, other: Estimate) -> Estimate:
    """One median over another; its interval from the ends of both."""
    assert one.interval is not None and other.interval is not None
    (a, b), (c, d) = one.interval, other.interval
    interval: Interval = (
        End(over(a.at, d.at), over(a.least, d.most), over(a.most, d.least)),
        End(over(b.at, c.at), over(b.least, c.most), over(b.most, c.least)),
    )
    return Estimate(over(one.value, other.value), max(one.n, other.n), interval)


def exists(asked: Asked) -> Found:
    """Some stored trial meets the printed number, on a problem where the given claims are met."""
    if asked.settings.get("differ"):
        return differs(asked)
    cell = printed(asked.paper, asked.claim)
    values, selected = eligible(asked, asked.settings["contenders"])
    values = values[~selected]
    met = [value for value in values if cell.agrees(value)]
    outcome = HOLDS if met else OPEN
    if len(values) == 0:
        return certain(outcome, existential=True)
    shown = met[0] if met else values[np.argmin(np.abs(values - cell.value))]
    return certain(outcome, Estimate(float(shown), len(values)), existential=True)


def eligible(asked: Asked, contenders: str | list[str]) -> tuple[Reals, np.ndarray]:
    """The numbers of these contenders where all given claims are met, and whether their map was searched for."""
    values, problems, selected = seen(asked, {**asked.settings, "contenders": contenders})
    kept = np.ones(len(values), dtype=bool)
    for name in asked.settings.get("given", []):
        claim = asked.paper.claim(name)
        other, meets = seen(asked, claim["check"]["exists"]), printed(asked.paper, claim)
        there = {problem for value, problem in zip(other[0], other[1], strict=True) if meets.agrees(value)}
        kept &= np.array([problem in there for problem in problems], dtype=bool)
    return values[kept], selected[kept]


def seen(asked: Asked, settings: dict[str, Any]) -> tuple[Reals, list[tuple], np.ndarray]:
    """Every number that a claim is looked for among, its problem, and whether that was searched for."""
    metric, against = asked.paper.metric(settings["metric"]), settings.get("against")
    values: list[Reals] = []
    problems: list[tuple] = []
    selected: list[bool] = []
    for place in settings["in"]:
        study = asked.paper.studies[place["study"]]
        if against is not None and departs(study, against):
            continue
        measured = study.values(metric, asked.session)
        query, names = study.query
        for group in groups_of(study, place["problems"]):
            for contender in labels(settings["contenders"]):
                if departs(study, contender):
                    continue
                rows = solved_rows(study.rows(group, contender), study.solved)
                number = measured[rows]
                if against is not None and against != contender:
                    bases = solved_rows(study.rows(group, against), study.solved)
                    rows, bases = matched(study, rows, bases)
                    number = saved(measured[bases], measured[rows])
                elif against is not None:
                    number = saved(number, number)
                known = ~np.isnan(number)
                values.append(number[known])
                for row in rows[known]:
                    problems.append((study.name, group, int(study.instance[row]), names[query[row]]))
                    selected.append(place.get("selected", False))
    return np.concatenate(values) if values else np.array([]), problems, np.array(selected, dtype=bool)


def departs(study: Study, contender: str) -> bool:
    """Whether a contender ran under another interpretation than the defaults, where alone its trials count."""
    own = next((own for own in study.spec["contender"] if own["label"] == contender), {})
    return any(study.taken[choice] != option for choice, option in own.get("departs", {}).items())


def solved_rows(rows: Places, solved: np.ndarray) -> Places:
    """Those that were solved."""
    return rows[solved[rows]]


def saved(base: Reals, own: Reals) -> Reals:
    """What is saved in per cent; NaN where the other number is not above 0."""
    return np.divide(100 * (base - own), base, out=np.full(len(base), np.nan), where=base > 0)


def medians_of_sets(asked: Asked) -> Iterator[tuple[str, float | None]]:
    """The median on each problem of each set; none without trials."""
    settings = asked.settings
    study, metric = asked.paper.studies[settings["in"][0]["study"]], asked.paper.metric(settings["metric"])
    measured, cut = study.values(metric, asked.session), np.isin(study.status, CUT)
    for group in (group for groups in settings["differ"] for group in groups):
        rows = posed(study, group, labels(settings["contenders"])[0], {})
        # Failures are infinite; what did not end is left out, and so are trials that were not timed.
        rows = rows[~cut[rows] & ~(metric.clock & np.isnan(measured[rows]))]
        given = metric.given(study.status[rows]) & ~np.isnan(measured[rows])
        yield group, middle(np.where(given, measured[rows], np.inf)) if len(rows) else None


def differs(asked: Asked) -> Found:
    """A metric is not the same on all problems of each set."""
    settings = asked.settings
    study, contender = asked.paper.studies[settings["in"][0]["study"]], labels(settings["contenders"])[0]
    cut = np.isin(study.status, CUT)
    groups = [group for of in settings["differ"] for group in of]
    is_cut = any(cut[posed(study, group, contender, {})].any() for group in groups)
    known = dict(medians_of_sets(asked))
    differ = 0
    for of in settings["differ"]:
        medians = [known[group] for group in of]
        first = medians[0]
        if first is not None and None not in medians:
            differ += any(one is not None and one != first and abs(one - first) > 1e-9 for one in medians)
    outcome = {0: FAILS, len(settings["differ"]): HOLDS}.get(differ, SIGN)
    return replace(certain(outcome, existential=True), censored=frozenset([is_cut]))
