"""Rules for counts, means and deviations: why no whole numbers give what is printed."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, comb, floor, isqrt

from certificates.spans import Span, need, point


def fraction(text: str | None) -> Fraction | None:
    """An exact number as certificates write it; none for null."""
    if text is None:
        return None
    need(isinstance(text, str), f"{text!r} is no exact number in quotes")
    value = Fraction(text)
    need(str(value) == text, f"{text!r} is not written as {value}")
    return value


def integer(text: str | None) -> int | None:
    """A whole number as certificates write it; none for null."""
    value = fraction(text)
    need(value is None or value.denominator == 1, f"{text!r} is no whole number")
    return None if value is None else int(value)


def positive(text: str) -> Fraction:
    """An exact number above 0."""
    value = fraction(text)
    need(value is not None and value > 0, f"{text!r} is not above 0")
    return value


def check_gap(span: Span, step: Fraction, said: dict) -> None:
    """That no multiple of `step` is in `span`: two that follow each other lie on either side."""
    need(set(said) == {"step", "below", "above"}, "a gap has other fields")
    need(positive(said["step"]) == step, f"the step is {step}")
    below, above = integer(said["below"]), integer(said["above"])
    need(above == below + 1, "multiples that do not follow each other")
    low, high = below * step, above * step
    is_below = low < span.low or (low == span.low and not span.low_closed)
    is_above = high > span.high or (high == span.high and not span.high_closed)
    need(is_below and is_above, f"{low} or {high} is printed so")


def grim(spans: list[Span], given: dict, steps: list) -> None:
    """No multiple of the step is printed so, within the ends."""
    n, grain = integer(given["n"]), positive(given["grain"])
    need(n > 0 and isinstance(given["is_count"], bool), "n or is_count is wrong")
    need(len(spans) == 1 and len(steps) == 1, "one number and one step are needed")
    # A count is the sum of the values, a share or mean their sum over n.
    times, step = (n, grain) if given["is_count"] else (1, grain / n)
    ends = [None if given[end] is None else fraction(given[end]) * times for end in ("least", "most")]
    span = spans[0].cut(*ends)
    if set(steps[0]) == {"outside"}:
        need([fraction(end) for end in steps[0]["outside"]] == ends, f"the ends are {ends}")
        need(span.is_empty(), "the number is not outside of the ends")
    else:
        check_gap(span, step, steps[0])


def clock(spans: list[Span], given: dict, steps: list) -> None:
    """No multiple of the tick is printed so."""
    need(len(spans) == 1 and len(steps) == 1, "one number and one step are needed")
    check_gap(spans[0], positive(given["step"]), steps[0])


def quantile(spans: list[Span], given: dict, steps: list) -> None:
    """No rule's multiples of the grain are printed so."""
    n, share, grain = integer(given["n"]), fraction(given["share"]), positive(given["grain"])
    need(n > 0 and 0 <= share <= 1 and len(spans) == 1, "n, share or numbers are wrong")
    need(given["rule"] in ("linear", "any"), "there is no such rule")
    if share in (0, 1):
        denominators = {1}
    else:
        offsets = [1 - share]
        denominators = set()
        if given["rule"] == "any":
            offsets += [Fraction(0), Fraction(1, 2), share, (share + 1) / 3, share / 4 + Fraction(3, 8)]
            # Rules 1 and 3 take a value; rule 2 takes the middle of two where n p is whole.
            denominators = {1, 2} if (n * share).denominator == 1 else {1}
        denominators |= {(n * share + offset).denominator for offset in offsets}
    need(len(steps) == len(denominators), "the rules are not all looked at")
    for denominator, said in zip(sorted(denominators), steps, strict=True):
        check_gap(spans[0], grain / denominator, said)


def squares(n: int, total: int, least: int | None, most: int | None) -> tuple[int, int | None]:
    """The least and the greatest sum of squares of n whole numbers with this total; none is unbounded."""
    base, rest = divmod(total, n)
    if (least is not None and base < least) or (most is not None and base + (rest > 0) > most):
        return 1, 0
    even = base**2 * (n - rest) + (base + 1) ** 2 * rest
    if least is None and most is None:
        return even, None
    # One end alone implies the other: all values but one stand at it.
    least, most = (
        total - (n - 1) * most if least is None else least,
        total - (n - 1) * least if most is None else most,
    )
    if least == most:
        return even, even
    high, between = divmod(total - n * least, most - least)
    spread = high * most**2
    if high < n:
        spread += (least + between) ** 2 + (n - high - 1) * least**2
    return even, spread


def are_met(n: int, total: int, squared: int, ends: list[int | None]) -> bool:
    """Whether n whole numbers between the ends have this total and sum of squares: all are searched."""
    reach = isqrt(squared)
    low = -reach if ends[0] is None else max(ends[0], -reach)
    high = reach if ends[1] is None else min(ends[1], reach)
    return search(n, total, squared, low, high, {})


def search(n: int, total: int, squared: int, low: int, high: int, known: dict) -> bool:
    """The same for numbers from low to high, the largest first."""
    least, most = squares(n, total, low, high)
    if squared < least or squared > most or (squared - total) % 2:
        return False
    if squared in (least, most):
        return True
    if n == 2:
        apart = 2 * squared - total**2
        return isqrt(apart) ** 2 == apart
    if n == 4 and total % 2 == 0 and seven_shaped(squared - (total // 2) ** 2):
        return False
    at = (n, total, squared, high)
    if at not in known:
        need(len(known) < 200_000, "the search for values takes too long to verify")
        # No value is further from the mean than this.
        reach = isqrt((n * squared - total**2) * (n - 1))
        first, last = min(high, (total + reach) // n), -(-total // n)
        known[at] = any(
            search(n - 1, total - x, squared - x * x, low, x, known) for x in range(first, last - 1, -1)
        )
    return known[at]


def seven_shaped(c: int) -> bool:
    """Whether a number has the form 4^k (8 m + 7), which no sum of three squares has (Legendre)."""
    while c and c % 4 == 0:
        c //= 4
    return c % 8 == 7


def least(said: Fraction | None, at: int | None, spans: list[Span], grain: Fraction) -> int | None:
    """What no value is below, in grains: by what is said, and by the least value if it is printed."""
    found = [] if said is None else [ceil(said / grain)]
    found += [] if at is None else [spans[at].times(1 / grain).integers()[0]]
    return max(found, default=None)


def most(said: Fraction | None, at: int | None, spans: list[Span], grain: Fraction) -> int | None:
    """What no value is above, in grains."""
    found = [] if said is None else [floor(said / grain)]
    found += [] if at is None else [spans[at].times(1 / grain).integers()[1]]
    return min(found, default=None)


def grimmer(spans: list[Span], given: dict, steps: list) -> None:
    """For no total of the values is there a sum of squares that the deviation allows."""
    n, grain = integer(given["n"]), positive(given["grain"])
    need(n > 0 and isinstance(given["is_error"], bool), "n or is_error is wrong")
    printed_ends = given["printed_ends"]
    # The least and the greatest value stand behind the mean, in this order, where they are printed.
    places = list(range(2, 2 + sum(at is not None for at in printed_ends)))
    need(
        len(printed_ends) == 2 and len(spans) == 2 + len(places),
        "deviation, mean and printed ends are needed",
    )
    need([at for at in printed_ends if at is not None] == places, "the printed ends are other numbers")
    inner = [
        least(fraction(given["least"]), printed_ends[0], spans, grain),
        most(fraction(given["most"]), printed_ends[1], spans, grain),
    ]
    divisors = [integer(divisor) for divisor in given["divisors"]]
    need(
        bool(divisors) and set(divisors) <= {n - 1, n} and min(divisors) > 0,
        "the divisors are not n - 1 or n",
    )
    first, last = spans[1].times(n / grain).integers()
    first = first if inner[0] is None else max(first, inner[0] * n)
    last = last if inner[1] is None else min(last, inner[1] * n)
    need(len(steps) == max(0, last - first + 1), "the totals are not all looked at")
    if spans[0].cut(Fraction(0), None).is_empty():
        return
    variance = spans[0].squared().times((n if given["is_error"] else 1) / grain**2)
    for total, said in zip(range(first, last + 1), steps, strict=True):
        need(set(said) == {"sum", "windows", "least", "most", "not_met"}, "a step has other fields")
        need(integer(said["sum"]) == total, f"the total is {total}")
        windows = [variance.times(Fraction(d)).plus(point(Fraction(total**2, n))) for d in divisors]
        need(said["windows"] == [window.written() for window in windows], "the sums of squares are others")
        fewest, highest = squares(n, total, *inner)
        need(
            (integer(said["least"]), integer(said["most"])) == (fewest, highest),
            "the least or the most is another",
        )
        plausible = set()
        for window in windows:
            low, high = window.integers()
            low = max(low, fewest)
            low += (low - total) % 2
            plausible |= set(range(low, (high if highest is None else min(high, highest)) + 1, 2))
        need(said["not_met"] == [str(q) for q in sorted(plausible)], "the sums of squares left are others")
        for squared in plausible:
            need(not are_met(n, total, squared, inner), f"a sum of squares is met: {squared}")


def debit(spans: list[Span], given: dict, steps: list) -> None:
    """For no count that prints the mean is there a deviation that is printed so."""
    need(len(spans) == 2, "deviation and mean are needed")
    n, whole = integer(given["n"]), positive(given["whole"])
    divisors = [integer(divisor) for divisor in given["divisors"]]
    need(n > 1 and bool(divisors) and set(divisors) <= {n - 1, n}, "n or the divisors are wrong")
    first, last = spans[1].times(n / whole).integers()
    counts = range(max(first, 0), min(last, n) + 1)
    need(len(steps) == len(counts), "the counts are not all looked at")
    squared, is_none = spans[0].squared(), spans[0].cut(Fraction(0), None).is_empty()
    for count, said in zip(counts, steps, strict=True):
        variances = [whole**2 * Fraction(count * (n - count), n) / divisor for divisor in divisors]
        need(said == {"count": str(count), "variances": [str(v) for v in variances]}, "a variance is another")
        need(is_none or not any(squared.contains(v) for v in variances), f"{count} of {n} is printed so")


def interval(spans: list[Span], given: dict, steps: list) -> None:
    """An end of Clopper and Pearson's interval is not printed so: tails are summed exactly."""
    k, n, tail, whole = (
        integer(given["k"]),
        integer(given["n"]),
        positive(given["tail"]),
        positive(given["whole"]),
    )
    need(
        0 <= k <= n and n > 0 and tail < Fraction(1, 2) and len(spans) == 2 and len(steps) == 1,
        "k, n or tail is wrong",
    )
    end, lies = steps[0]["end"], steps[0]["lies"]
    need(
        set(steps[0]) == {"end", "lies"} and end in ("low", "high") and lies in ("above", "below"),
        "a step is wrong",
    )
    span = spans[0] if end == "low" else spans[1]
    at = (span.high if lies == "above" else span.low) / whole
    true_end = {("low", 0): Fraction(0), ("high", n): Fraction(1)}.get((end, k))
    if true_end is not None:
        need(true_end > at if lies == "above" else true_end < at, f"the {end} end is {true_end}")
        return
    if at <= 0 or at >= 1:
        need(at <= 0 if lies == "above" else at >= 1, f"the {end} end does not lie {lies} {at}")
        return
    counts = range(k, n + 1) if end == "low" else range(k + 1)
    p, q, d = at.numerator, at.denominator - at.numerator, at.denominator
    chance = Fraction(sum(comb(n, i) * p**i * q ** (n - i) for i in counts), d**n)
    # The tail at the lower end rises with the share, and that at the upper end falls.
    is_above = chance < tail if end == "low" else chance > tail
    is_below = chance > tail if end == "low" else chance < tail
    need(is_above if lies == "above" else is_below, f"the {end} end does not lie {lies} what is printed")


RULES = {
    "grim": (grim, {"n", "grain", "is_count", "least", "most"}),
    "clock": (clock, {"step"}),
    "quantile": (quantile, {"n", "share", "grain", "rule"}),
    "grimmer": (grimmer, {"n", "grain", "least", "most", "printed_ends", "divisors", "is_error"}),
    "seed_spread": (grimmer, {"n", "grain", "least", "most", "printed_ends", "divisors", "is_error"}),
    "debit": (debit, {"n", "whole", "divisors"}),
    "interval": (interval, {"k", "n", "tail", "whole"}),
}
