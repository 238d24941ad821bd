"""Intervals: exact ones, and bootstrap ones with what Monte-Carlo error allows another bootstrap to give.

The ends of a percentile interval from B resamples are quantiles of B random numbers: order statistics, whose
place in the distribution of resamples follows a beta distribution. How many of our own resamples lie below
such an end is therefore beta-binomial, and between which of ours it lies is known but for a probability of
ALARM. No normal approximation is made, and no share of the interval's width assumed.
"""

import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import stats

from statistics_judge.records import Places, Reals

LEVEL = 0.95
# Resamples of the stored intervals.
STORED = 2000
# Our own.
OWN = 8000
# The probability that an end which nothing but chance moves is outside what is allowed.
ALARM = 1e-5
# Resamples are drawn so many at a time.
CHUNK = 100

Weights = npt.NDArray[np.int64]


@dataclass(frozen=True)
class End:
    """One end of an interval: ours, and the least and the most that the stored one can be."""

    at: float
    least: float
    most: float

    @staticmethod
    def exact(at: float) -> "End":
        """An end that nothing random moves."""
        return End(at, at, at)

    def mapped(self, of: Callable[[float], float]) -> "End":
        """What a function that rises or falls everywhere makes of it."""
        return End(of(self.at), *sorted((of(self.least), of(self.most))))

    def allows(self, stored: float) -> bool:
        """Whether the stored end can be what it is, up to rounding."""
        slack = 1e-9 * max(1.0, abs(self.at)) if np.isfinite(self.at) else 0.0
        return self.least - slack <= stored <= self.most + slack


Interval = tuple[End, End]


def clopper_pearson(hits: int, trials: int) -> Interval:
    """The exact interval of a share."""
    tail = (1 - LEVEL) / 2
    low = 0.0 if hits == 0 else float(stats.beta.ppf(tail, hits, trials - hits + 1))
    high = 1.0 if hits == trials else float(stats.beta.ppf(1 - tail, hits + 1, trials - hits))
    return End.exact(low), End.exact(high)


def agreed(hits: Reals, chances: Reals, most: float) -> Interval | None:
    """The interval of a share on which all instances agree, whatever they are drawn from; none for other instances.

    At the tail's level no more than a beta quantile of all instances differ from those seen, by hits or by misses
    throughout. A share weighs draws by their chances, so the most that one can have over the mean widens it.
    """
    if (hits * chances[0] != hits[0] * chances).any():
        return None
    share = float(hits[0] / chances[0])
    wide = may_differ(len(chances)) * most / float(chances.mean())
    return End.exact(max(share - share * wide, 0.0)), End.exact(min(share + (1 - share) * wide, 1.0))


def may_differ(units: int) -> float:
    """The most of all units that may differ, at the tail's level, where so many agree."""
    return float(stats.beta.isf((1 - LEVEL) / 2, 1, units))


def agreed_ratio(own: Reals, base: Reals) -> Interval | None:
    """The interval of a ratio of sums that every unit has; none for other units.

    In units that differ the number above may be off by the larger of the unit's two.
    """
    if len(own) < 2 or base.sum() <= 0 or (base < 0).any():
        return None
    ratio = float(own.sum() / base.sum())
    if (np.abs(own - ratio * base) > 1e-9 * np.abs(ratio * base)).any():
        return None
    half = may_differ(len(own)) * float(base.max() / base.mean()) * max(abs(ratio), 1.0)
    low = ratio - half if ratio < 0 else max(ratio - half, 0.0)
    return End.exact(low), End.exact(ratio + half)


def agreed_between(values: Reals, least: float, most: float) -> Interval | None:
    """The interval of the mean of numbers within bounds on which all units agree; none for others."""
    if (values != values[0]).any():
        return None
    value, wide = float(values[0]), may_differ(len(values))
    return End.exact(value - wide * (value - least)), End.exact(value + wide * (most - value))


def predictive(instances: Reals) -> Interval | None:
    """Order statistics between which one more instance lies; none where the extremes do not reach the level."""
    outside = 0
    while 2 * (outside + 1) / (len(instances) + 1) <= 1 - LEVEL + 1e-12:
        outside += 1
    if outside == 0:
        return None
    ordered = np.sort(instances)
    return End.exact(float(ordered[outside - 1])), End.exact(float(ordered[-outside]))


def hull(intervals: list[Interval]) -> Interval:
    """From the least low end of several intervals to the greatest high one."""
    lows, highs = zip(*intervals, strict=True)
    low = End(*(min(getattr(end, of) for end in lows) for of in ("at", "least", "most")))
    return low, End(*(max(getattr(end, of) for end in highs) for of in ("at", "least", "most")))


def bootstrap(statistic: Callable[[Weights], Reals], units: int, seed: str) -> Interval | None:
    """The percentile interval over units; `statistic` takes how often each unit is drawn, a row a resample.

    None below two units, or if no resample has a value (NaN).
    """
    if units < 2:
        return None
    drawn = np.concatenate([statistic(weights) for weights in resamples(units, seed)])
    return percentile(drawn)


def resamples(units: int, seed: str) -> Iterator[Weights]:
    """How often each unit is drawn in each of our resamples, some resamples at a time."""
    rng = np.random.default_rng(list(seed.encode()))
    rows = units * np.arange(CHUNK)[:, None]
    for _ in range(OWN // CHUNK):
        drawn = rng.integers(0, units, (CHUNK, units)) + rows
        yield np.bincount(drawn.ravel(), minlength=CHUNK * units).reshape(CHUNK, units)


def weighted_share(hits: Reals, chances: Reals, most: float, seed: str) -> Interval:
    """The interval of a share, whatever units are drawn from: Gaffke's bounds by simulation.

    The units and one more, with the most chances that one can have, are weighted by spacings of uniform
    numbers; that one is a hit throughout at the upper end, a miss throughout at the lower.
    """
    rng = np.random.default_rng(list(seed.encode()))
    lows, highs = [], []
    for _ in range(OWN // CHUNK):
        weights = rng.exponential(size=(CHUNK, len(hits) + 1))
        above, more = weights[:, :-1] @ hits, weights[:, -1] * most
        below = weights[:, :-1] @ chances + more
        lows.append(above / below)
        highs.append((above + more) / below)
    tail = (1 - LEVEL) / 2
    low, high = (np.sort(np.concatenate(ends)) for ends in (lows, highs))
    return quantile(low, tail, STORED), quantile(high, 1 - tail, STORED)


def percentile(drawn: Reals) -> Interval | None:
    """The interval between the outer quantiles of resampled numbers."""
    tail = (1 - LEVEL) / 2
    known = np.sort(drawn[~np.isnan(drawn)])
    if len(known) == 0:
        return None
    compared = max(1, round(STORED * len(known) / len(drawn)))
    return quantile(known, tail, compared), quantile(known, 1 - tail, compared)


def quantile(ordered: Reals, share: float, stored: int) -> End:
    """The type-7 quantile of ordered numbers, and where that of `stored` other ones of their kind can lie."""
    count = len(ordered)
    first, last = ranks(count, share, stored)
    at = type7(ordered, share)
    return End(at, float(ordered[max(first, 0)]), float(ordered[min(last, count - 1)]))


@functools.cache
def ranks(count: int, share: float, stored: int) -> tuple[int, int]:
    """Between which of `count` resamples, from 0, the quantile of `stored` other ones lies."""
    place = (stored - 1) * share
    below, above = int(np.floor(place)) + 1, int(np.ceil(place)) + 1
    first = stats.betabinom.ppf(ALARM / 2, count, below, stored - below + 1)
    last = stats.betabinom.ppf(1 - ALARM / 2, count, above, stored - above + 1)
    return int(first) - 1, int(last)


def type7(ordered: Reals, share: float) -> float:
    """The type-7 quantile; infinite numbers stay what they are."""
    place = (len(ordered) - 1) * share
    low, high = ordered[int(np.floor(place))], ordered[int(np.ceil(place))]
    return float(low if low == high else low + (high - low) * (place - np.floor(place)))


def sums_by_unit(unit: Places, units: int, *numbers: Reals) -> list[Reals]:
    """The sum of numbers over the cases of each unit."""
    return [np.bincount(unit, weights=of, minlength=units).astype(np.float64) for of in numbers]


def ratio_of_sums(above: Reals, below: Reals) -> Callable[[Weights], Reals]:
    """The sum of one number a unit over that of another; NaN where that is not positive."""

    def statistic(weights: Weights) -> Reals:
        top, bottom = weights @ above, weights @ below
        return np.divide(top, bottom, out=np.full(len(top), np.nan), where=bottom > 0)

    return statistic


def median(unit: Places, values: Reals) -> Callable[[Weights], Reals]:
    """The median over the cases of the units drawn; infinite numbers count."""
    return share_below(unit, values, 0.5)


def share_below(unit: Places, values: Reals, share: float) -> Callable[[Weights], Reals]:
    """The number that a share of the cases of the units drawn lie below; infinite numbers count."""
    order = np.argsort(values, kind="stable")
    ordered, owner = values[order], unit[order]

    def statistic(weights: Weights) -> Reals:
        up_to = np.cumsum(weights[:, owner], axis=1)
        total = up_to[:, -1]
        place = (total - 1) * share
        low, high = (
            ordered[np.minimum((up_to < rank[:, None]).sum(axis=1), len(ordered) - 1)]
            for rank in (np.floor(place) + 1, np.ceil(place) + 1)
        )
        part = place - np.floor(place)
        # Infinity times nothing is no number.
        known = np.where(part > 0, high, low)
        with np.errstate(invalid="ignore"):
            between = low * (1 - part) + known * part
        return np.where(total > 0, np.where(low == known, low, between), np.nan)

    return statistic


def deviation(unit: Places, units: int, values: Reals) -> Callable[[Weights], Reals]:
    """The standard deviation over the cases of the units drawn."""
    centred = values - values.mean()
    count, total, squares = sums_by_unit(unit, units, np.ones(len(values)), centred, centred**2)

    def statistic(weights: Weights) -> Reals:
        n, s, q = weights @ count, weights @ total, weights @ squares
        spread = np.maximum(q - np.divide(s**2, n, out=np.zeros(len(n)), where=n > 0), 0)
        return np.sqrt(np.divide(spread, n - 1, out=np.full(len(n), np.nan), where=n > 1))

    return statistic


def slope(unit: Places, units: int, x: Reals, y: Reals) -> Callable[[Weights], Reals]:
    """The slope of the least-squares line through the cases of the units drawn."""
    x, y = x - x.mean(), y - y.mean()
    sums = sums_by_unit(unit, units, np.ones(len(x)), x, y, x * x, x * y)

    def statistic(weights: Weights) -> Reals:
        n, sx, sy, sxx, sxy = (weights @ of for of in sums)
        spread = sxx - sx * sx / n
        joint = sxy - sx * sy / n
        is_spread = spread > 1e-12 * np.maximum(sxx, 1e-300)
        return np.divide(joint, spread, out=np.full(len(n), np.nan), where=is_spread)

    return statistic


def band(curves: Reals, seed: str, ends: tuple[float, float]) -> list[Interval]:
    """The simultaneous (sup-t) band of the mean of curves within `ends`, one a row."""
    units = len(curves)
    drawn = np.concatenate([weights @ curves / units for weights in resamples(units, seed)])
    mean, errors = curves.mean(axis=0), drawn.std(axis=0, ddof=1)
    moved = errors > 0
    greatest = (np.abs(drawn - mean)[:, moved] / errors[moved]).max(axis=1, initial=0.0)
    multiplier = quantile(np.sort(greatest), LEVEL, STORED)
    # The relative error of a standard deviation of either bootstrap, as far out as ALARM says.
    apart = stats.norm.ppf(1 - ALARM / 2) * np.sqrt(1 / (2 * STORED) + 1 / (2 * OWN))
    found = []
    for middle, error, values in zip(mean, errors, curves.T, strict=True):
        if allowing := agreed_between(values, *ends):
            found.append(allowing)
            continue
        half = End(
            multiplier.at * error,
            multiplier.least * error * (1 - apart),
            multiplier.most * error * (1 + apart),
        )
        low = End(middle - half.at, middle - half.most, middle - half.least)
        found.append((low, End(middle + half.at, middle + half.least, middle + half.most)))
    return found
