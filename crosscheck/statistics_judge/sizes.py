"""Criteria of sizes over instances: lower, trend and within."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from statistics_judge.classes import FAILS, HOLDS, OPEN, SIGN
from statistics_judge.found import FEWEST_INSTANCES, Asked, Estimate, Found, hangs, outcomes, too_few
from statistics_judge.intervals import (
    End,
    Interval,
    agreed_ratio,
    band,
    bootstrap,
    deviation,
    hull,
    median,
    ratio_of_sums,
    share_below,
    slope,
    sums_by_unit,
)
from statistics_judge.printed import Printed
from statistics_judge.records import Paper, Reals
from statistics_judge.selection import Cases, groups_of, is_drawn

# Ratios nearer to 1 are no difference.
NO_DIFFERENCE = 1e-3
# Sums of the same steps in another order are equal up to this share of them.
EQUAL = 1e-9
# Which share of the cases lies below a quantile.
QUANTILES = {"lower_quartile": 0.25, "median": 0.5, "upper_quartile": 0.75, "ninety_fifth_percentile": 0.95}

# Statistics that hold two contenders against each other.
PAIRED = ("ratio", "mean_of_ratios", "reduction_percent")

Outcome = Callable[[float, float], str]


def ratio(
    cases: Cases, bases: Reals, values: Reals, seed: str, *, of_instances: bool = False
) -> tuple[float, Interval, int] | None:
    """The sum of one contender's numbers over that of the other's, over the cases that have both.

    Or the mean of that over the instances where the other's sum is above 0.
    """
    kept = ~np.isnan(bases) & ~np.isnan(values)
    names, unit = np.unique(cases.unit[kept], return_inverse=True)
    own, base = sums_by_unit(unit, len(names), values[kept], bases[kept])
    if of_instances:
        own = own[base > 0] / base[base > 0]
        base = np.ones(len(own))
    interval = agreed_ratio(own, base) or bootstrap(ratio_of_sums(own, base), len(own), seed)
    return interval and (float(own.sum() / base.sum()), interval, len(own))


def filled(cases: Cases) -> list[tuple[Reals, Reals]]:
    """Both numbers of every case, the censored ones farther apart than all that were seen together.

    A side that ended without a path counts against itself; one that did not end might be the better.
    """
    censored, paired, ended = cases.censored, cases.paired, ~cases.unended
    if not censored.any() or not paired.any():
        return []
    middle = cases.bases[paired].mean()
    most = max(np.abs(cases.values - cases.bases)[paired].max(), abs(middle)) * paired.sum()
    better = cases.metric.better if cases.metric else "neither"
    worse = {"lower": 1, "higher": -1, "neither": 0}[better]
    found = []
    for unknown in (1, -1):
        way = np.full(len(censored), unknown)
        if worse:
            way[ended & np.isnan(cases.values) & ~np.isnan(cases.bases)] = worse
            way[ended & ~np.isnan(cases.values) & np.isnan(cases.bases)] = -worse
        ends = np.maximum(middle + way * most, 0)
        bases = np.where(paired, cases.bases, np.where(censored, middle, np.nan))
        found.append((bases, np.where(paired, cases.values, np.where(censored, ends, np.nan))))
    return found


def otherwise(cases: Cases, statistic: str, seed: str, of: Callable[[Interval], Interval]) -> list[Interval]:
    """The intervals of a statistic when cases without a number had any that they may have had."""
    if statistic in PAIRED:
        is_mean = statistic == "mean_of_ratios"
        found = [ratio(cases, *numbers, seed + " filled", of_instances=is_mean) for numbers in filled(cases)]
        return [of(one[1]) for one in found if one is not None]
    seen = cases.values[~np.isnan(cases.values)]
    if not cases.unended.any() or len(seen) == 0:
        return []
    least, far, middle = min(0.0, seen.min()), np.abs(seen).max() * len(seen), seen.mean()
    ends = {
        "deviation": [(middle, middle), (far, far)],
        **{name: [(least, least), (np.inf, np.inf)] for name in QUANTILES},
        "ratio_of_groups": [(least, np.inf), (np.inf, least)],
    }.get(statistic, [(least, least), (far, far)])
    found = []
    for first, second in ends:
        given = np.where(cases.group == cases.group[0], first, second)
        found.append(of_all(cases.given(given), statistic, seed + " filled"))
    anything = (End.exact(-np.inf), End.exact(np.inf))
    return [anything if one is None else one[1] for one in found]


def turned(outcome: Outcome, main: Found, others: list[Interval]) -> frozenset[bool]:
    """Whether what cases without a number may have given turns an outcome.

    What they may make of it reaches from one interval to the other, and to what was found.
    """
    own = main.estimate.interval if main.estimate else None
    whole = [hull([*others, *([own] if own else [])])] if others else []
    return hangs(main.outcome, main.possible, [outcomes(outcome, one) for one in [*others, *whole]])


def reduction(ratio: Interval) -> Interval:
    """By how many per cent a ratio is below 1."""
    low, high = ratio
    return high.mapped(lambda r: 100 * (1 - r)), low.mapped(lambda r: 100 * (1 - r))


def itself(ratio: Interval) -> Interval:
    """The ratio."""
    return ratio


def change(ratio: Interval) -> Interval:
    """By how many per cent a ratio is above 1."""
    low, high = ratio
    return low.mapped(lambda r: 100 * (r - 1)), high.mapped(lambda r: 100 * (r - 1))


def lower(asked: Asked) -> Found:
    """One contender is lower than another, or higher, by so much at least."""
    cases = asked.cases()
    is_higher, by = asked.settings.get("is") == "higher", asked.settings.get("by_percent", 0.0)
    if cases.metric is None:
        return along_sweep(asked, cases, is_higher)
    found = ratio(cases, cases.bases, cases.values, asked.seed)
    if found is None:
        return too_few()

    def outcome(low: float, high: float) -> str:
        return of_change(low, high, by, is_higher)

    if not by and np.all(np.abs(cases.values - cases.bases)[cases.paired] <= EQUAL):
        # A strict comparison that ties on every case is contradicted.
        def outcome(low: float, high: float) -> str:
            del low, high
            return FAILS

    interval = change(found[1])
    estimate = Estimate(100 * (found[0] - 1), found[2], interval, cases.solved_of_all())
    main = Found(outcome(*(end.at for end in interval)), outcomes(outcome, interval), estimate)
    censored = turned(outcome, main, otherwise(cases, "ratio", asked.seed, change))
    return Found(main.outcome, main.possible, estimate, censored=censored)


def of_change(low: float, high: float, by: float, is_higher: bool) -> str:
    """What an interval of changes in per cent says of a claim that it goes one way, by so much at least."""
    ends = (low, high) if is_higher else (-high, -low)
    near, far = (snapped(snapped(end, by, 100), 0.0, 100) for end in ends)
    if near > 0:
        return HOLDS if near >= by else OPEN if far >= by else SIGN
    if far < 0 or near == far == 0 or far < by:
        return FAILS
    return OPEN


def snapped(number: float, limit: float, size: float) -> float:
    """A number, or a limit from which rounding alone parts it, of sums of this size."""
    return limit if abs(number - limit) <= size * EQUAL else number


def along_sweep(asked: Asked, cases: Cases, is_higher: bool) -> Found:
    """The share of solved queries is higher, or lower, all along a sweep at once."""
    drawn = curves(cases, other=False, own=False)
    if len(drawn) < 2:
        return too_few()

    def directions_of(intervals: list[Interval]) -> list[str]:
        # As it is, as wide, and as narrow, as the band can be.
        ways = (("at", "at"), ("least", "most"), ("most", "least"))
        return [all_along(intervals, is_higher, *ends) for ends in ways]

    intervals = of_band(asked, drawn)
    directions = directions_of(intervals)
    ways = (True, False) if cases.unended.any() else ()
    ends = [frozenset(directions_of(of_band(asked, curves(cases, other=way, own=not way)))) for way in ways]
    mean = drawn.mean(axis=0)
    place = int(np.argmin(mean if is_higher else -mean))
    estimate = Estimate(float(mean[place]), len(drawn), intervals[place], cases.solved_of_all())
    possible = frozenset(directions)
    return Found(directions[0], possible, estimate, censored=hangs(directions[0], possible, ends))


def of_band(asked: Asked, drawn: Reals) -> list[Interval]:
    """The simultaneous band of curves, a line an instance."""
    return band(drawn, asked.seed, (-100, 100))


def curves(cases: Cases, *, other: bool, own: bool) -> Reals:
    """How many points more of an instance's queries are solved than by the other contender, along the sweep.

    What did not end is solved by the other, or by the contender itself, only if so wanted.
    """
    places, names = cases.study.pooled
    assert cases.base is not None
    found = []
    for point in cases.points:
        at = places[cases.own] == names.index(point)
        solved = [
            cases.ended_as(rows[at], wanted) for rows, wanted in ((cases.own, own), (cases.base, other))
        ]
        gain = solved[0].astype(float) - solved[1].astype(float)
        total, count = sums_by_unit(cases.unit[at], cases.units, gain, np.ones(int(at.sum())))
        found.append(np.divide(100 * total, count, out=np.full(cases.units, np.nan), where=count > 0))
    drawn = np.stack(found, axis=1)
    return drawn[~np.isnan(drawn).any(axis=1)]


def all_along(intervals: list[Interval], is_higher: bool, of_low: str, of_high: str) -> str:
    """What a band says of a claim that one contender solves more, or less, all along."""
    ends = [(getattr(low, of_low), getattr(high, of_high)) for low, high in intervals]
    near = [low if is_higher else -high for low, high in ends]
    far = [high if is_higher else -low for low, high in ends]
    if min(near) > 0:
        return HOLDS
    return FAILS if min(far) < 0 else SIGN if max(near) > 0 else OPEN


def trend(asked: Asked) -> Found:
    """A metric, or what is saved, grows along a column."""
    cases = asked.cases()
    x, y = cases.study.column(asked.settings["over"])[cases.own], cases.numbers
    kept = ~np.isnan(x) & ~np.isnan(y)
    names, unit = np.unique(cases.unit[kept], return_inverse=True)
    x, y = x[kept], y[kept]
    if len(names) < 2 or np.ptp(x) == 0:
        return too_few()
    interval = bootstrap(slope(unit, len(names), x, y), len(names), asked.seed)
    assert interval is not None
    sign = 1 if asked.settings["rising"] else -1

    def outcome(low: float, high: float) -> str:
        if low <= 0 <= high:
            return OPEN
        return HOLDS if sign * low > 0 else FAILS

    estimate = Estimate(float(np.polyfit(x, y, 1)[0]), len(names), interval, cases.solved_of_all())
    main = Found(outcome(*(end.at for end in interval)), outcomes(outcome, interval), estimate)
    return replace(main, censored=bent(asked, cases, main, outcome))


def bent(asked: Asked, cases: Cases, main: Found, outcome: Outcome) -> frozenset[bool]:
    """Whether cases without an end bend a slope: given numbers below or above all that were seen together.

    One whose place is not known may stand anywhere.
    """
    x, y = cases.study.column(asked.settings["over"])[cases.own], cases.numbers
    seen = ~np.isnan(x) & ~np.isnan(y)
    might = cases.might_be_solved
    if (might & np.isnan(x)).any():
        return frozenset([True])
    lost = might & ~seen
    ends = []
    least, most = min(0.0, y[seen].min()), np.abs(y[seen]).max() * seen.sum()
    for rising in (True, False):
        far = np.where((x > x[seen].mean()) == rising, most, least)
        kept = seen | lost
        names, unit = np.unique(cases.unit[kept], return_inverse=True)
        of = slope(unit, len(names), x[kept], np.where(lost, far, y)[kept])
        interval = bootstrap(of, len(names), asked.seed + " filled")
        assert interval is not None
        ends.append(outcomes(outcome, interval))
    return hangs(main.outcome, main.possible, ends if lost.any() else [])


def within(asked: Asked) -> Found:
    """The interval of a statistic lies within a margin about the printed number, or within bounds."""
    cases, statistic = asked.cases(), asked.settings["statistic"]
    found = of_all(cases, statistic, asked.seed)
    if found is None or not np.isfinite(found[1][0].at):
        return replace(too_few(), censored=frozenset([bool(cases.unended.any())]))
    value, interval, n = found
    least, most, printed = accepted(asked)
    middle = (least + most) / 2 if printed is None else printed
    none = {"reduction_percent": 0.0, "ratio": 1.0, "mean_of_ratios": 1.0, "ratio_of_groups": 1.0}.get(
        statistic
    )

    def outcome(low: float, high: float) -> str:
        low, high = (on_bounds(end, least, most) for end in (low, high))
        if least <= low and high <= most:
            return HOLDS
        if low <= most and least <= high:
            return OPEN
        # A claim of some difference, and the interval wholly on the same side of none as it.
        if none is None or (printed is None and least <= none <= most):
            return FAILS
        equal = 100 * EQUAL if none == 0 else NO_DIFFERENCE
        is_above, is_below = low > none + equal, high < none - equal
        return SIGN if (is_above and middle > none) or (is_below and not middle > none) else FAILS

    estimate = Estimate(value, n, interval, cases.solved_of_all())
    main = Found(outcome(*(end.at for end in interval)), outcomes(outcome, interval), estimate)
    of = reduction if statistic == "reduction_percent" else itself
    censored = turned(outcome, main, otherwise(cases, statistic, asked.seed, of))
    few = statistic == "ratio_of_groups" and has_few_draws(asked, cases)
    return replace(main, censored=censored, few=few)


def has_few_draws(asked: Asked, cases: Cases) -> bool:
    """Whether one of two groups has too few instances, but for one in which nothing is drawn."""
    names = groups_of(cases.study, asked.settings["select"]["problems"])
    for place, name in enumerate(names):
        instances = len(np.unique(cases.unit[cases.group == place]))
        if instances < FEWEST_INSTANCES and (instances != 1 or is_drawn(cases.study, name)):
            return True
    return False


def on_bounds(number: float, *bounds: float) -> float:
    """A number, or a bound from which rounding alone parts it."""
    for bound in bounds:
        number = snapped(number, bound, max(abs(bound), 1.0))
    return number


def of_all(cases: Cases, statistic: str, seed: str) -> tuple[float, Interval, int] | None:
    """A statistic of all instances, its interval, and how many instances it rests on."""
    if statistic in PAIRED:
        is_mean = statistic == "mean_of_ratios"
        found = ratio(cases, cases.bases, cases.values, seed, of_instances=is_mean)
        if found is None or statistic != "reduction_percent":
            return found
        return 100 * (1 - found[0]), reduction(found[1]), found[2]
    if statistic == "ratio_of_groups":
        return ratio_of_groups(cases, seed)
    values, share = cases.values, QUANTILES.get(statistic)
    if share is not None:
        values = np.where(cases.own_solved, values, np.inf)
    kept = ~np.isnan(values)
    names, unit = np.unique(cases.unit[kept], return_inverse=True)
    values, units = values[kept], len(names)
    if units < 2:
        return None
    if share is not None:
        of = share_below(unit, values, share)
        value = of(np.ones((1, units), dtype=int))[0]
    elif statistic == "deviation":
        value, of = values.std(ddof=1), deviation(unit, units, values)
    else:
        total, count = sums_by_unit(unit, units, values, np.ones(len(values)))
        value, of = values.mean(), ratio_of_sums(total, count)
    interval = bootstrap(of, units, seed)
    return interval and (float(value), interval, units)


def ratio_of_groups(cases: Cases, seed: str) -> tuple[float, Interval, int] | None:
    """The median on the first group over that on the second; its interval from the ends of both."""
    if len(cases.own) == 0:
        return None
    sides: list[tuple[float, Interval]] = []
    for mask in (cases.group == cases.group[0], cases.group != cases.group[0]):
        names, unit = np.unique(cases.unit[mask], return_inverse=True)
        values = cases.values[mask]
        known = ~np.isnan(values)
        if not known.any():
            return None
        middle = float(np.median(values[known]))
        interval = bootstrap(median(unit[known], values[known]), len(names), f"{seed} {len(sides)}")
        sides.append((middle, interval or (End.exact(middle), End.exact(middle))))
    (above, (a, b)), (below, (c, d)) = sides
    if below <= 0:
        return None
    low, high = divided(a, d), divided(b, c)
    return above / below, (low, high), cases.units


def divided(above: End, below: End) -> End:
    """One end over another."""
    return End(above.at / below.at, above.least / below.most, above.most / below.least)


def accepted(asked: Asked) -> tuple[float, float, float | None]:
    """The least and the greatest number accepted, and the printed one if a margin is about it."""
    settings = asked.settings
    if "accepted" in settings:
        return settings["accepted"][0], settings["accepted"][1], None
    if "printed_ratio" in settings:
        above, below = (printed(asked.paper, asked.paper.claim(of)).value for of in settings["printed_ratio"])
        middle = above / below
    else:
        middle = printed(asked.paper, asked.claim).value
    margin = settings.get("margin", abs(middle) * settings.get("margin_percent", 0.0) / 100)
    return middle - margin, middle + margin, middle


def printed(paper: Paper, claim: dict) -> Printed:
    """A claim's printed number."""
    return Printed(claim["printed"], claim.get("digits", paper.digits))
