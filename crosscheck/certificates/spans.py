"""Spans of true values: what a printed number stands for under a reading of its digits."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, floor

NUMBER = re.compile(r"(-?)(\d+)(?:\.(\d+))?")


class RefusedError(Exception):
    """The certificate proves nothing; the message says why."""


@dataclass(frozen=True)
class Span:
    """The values between two ends; an end is a member if it is closed."""

    low: Fraction
    low_closed: bool
    high: Fraction
    high_closed: bool

    def contains(self, x: Fraction) -> bool:
        """Whether `x` is a member."""
        above = self.low < x or (self.low_closed and self.low == x)
        return above and (x < self.high or (self.high_closed and self.high == x))

    def is_empty(self) -> bool:
        """Whether there is no member."""
        return self.low > self.high or (self.low == self.high and not (self.low_closed and self.high_closed))

    def integers(self) -> tuple[int, int]:
        """The first and the last whole number; the first is above the last if there is none."""
        first, last = ceil(self.low), floor(self.high)
        if not self.low_closed and first == self.low:
            first += 1
        if not self.high_closed and last == self.high:
            last -= 1
        return first, last

    def times(self, factor: Fraction) -> Span:
        """Every member times a factor above 0."""
        return replace(self, low=self.low * factor, high=self.high * factor)

    def plus(self, other: Span) -> Span:
        """The sums of a member of each."""
        return Span(
            self.low + other.low,
            self.low_closed and other.low_closed,
            self.high + other.high,
            self.high_closed and other.high_closed,
        )

    def over(self, other: Span) -> Span:
        """The quotients of members by members of another span, which does not hold 0."""
        if other.high < 0:
            return self.negated().over(other.negated())
        need(other.low > 0, "a quotient is not bounded")
        least, most = (other.low, other.low_closed), (other.high, other.high_closed)
        by, is_low = least if self.low < 0 else most
        over, is_high = most if self.high < 0 else least
        # 0 over anything is 0, whether or not the divisor's end is a member.
        return Span(
            self.low / by,
            self.low_closed and (is_low or self.low == 0),
            self.high / over,
            self.high_closed and (is_high or self.high == 0),
        )

    def negated(self) -> Span:
        """Every member with the other sign."""
        return Span(-self.high, self.high_closed, -self.low, self.low_closed)

    def meets(self, other: Span) -> bool:
        """Whether the two have a member in common."""
        low, low_closed = max((self.low, not self.low_closed), (other.low, not other.low_closed))
        high, high_closed = min((self.high, self.high_closed), (other.high, other.high_closed))
        return not Span(low, not low_closed, high, high_closed).is_empty()

    def cut(self, least: Fraction | None, most: Fraction | None) -> Span:
        """The members that are not outside of the ends given."""
        span = self
        if least is not None and least > span.low:
            span = replace(span, low=least, low_closed=True)
        if most is not None and most < span.high:
            span = replace(span, high=most, high_closed=True)
        return span

    def squared(self) -> Span:
        """The squares of the members that are not negative."""
        span = self.cut(Fraction(0), None)
        return replace(span, low=span.low**2, high=span.high**2)

    def written(self) -> list[str]:
        """As certificates write it."""
        return [
            "[" if self.low_closed else "(",
            str(self.low),
            str(self.high),
            "]" if self.high_closed else ")",
        ]


def point(at: Fraction) -> Span:
    """The span of one value."""
    return Span(at, True, at, True)


def need(holds: bool, why: str) -> None:
    """Refuses the certificate unless `holds`."""
    if not holds:
        raise RefusedError(why)


def printed(text: str, digits: str, significant: int | None) -> Span:
    """What `text` stands for if its digits end as `digits` says; `significant` of them count, if so said."""
    parts = NUMBER.fullmatch(text)
    need(parts is not None, f"{text!r} is no printed number")
    sign, whole, decimals = parts.groups(default="")
    if significant is not None:
        need(type(significant) is int and not decimals.endswith("0"), "the zeros left out are none")
        more = significant - len((whole + decimals).lstrip("0") or "0" + decimals)
        need(more >= 0, f"{text} has more than {significant} digits")
        # What 15 digits do not hold is read as typed.
        fits = len((whole + decimals).lstrip("0")) + more <= 15 and len(decimals) + more <= 15
        decimals += "0" * more if fits else ""
    units = int(whole + decimals) * (-1 if sign else 1)
    half = Fraction(1, 2 * 10 ** len(decimals))
    centre, even = 2 * units, units % 2 == 0
    down, up = (centre, True), (centre, True)
    ends = {
        "any": ((centre - 2, False), (centre + 2, False)),
        "nearest": ((centre - 1, True), (centre + 1, True)),
        "half up": ((centre - 1, units > 0), (centre + 1, units < 0)),
        "half even": ((centre - 1, even), (centre + 1, even)),
        "floor": (down, (centre + 2, False)),
        "ceiling": ((centre - 2, False), up),
        "truncation": (
            down if units > 0 else (centre - 2, False),
            up if units < 0 else (centre + 2, False),
        ),
        "nearest or truncation": (
            (centre - 1, True) if units > 0 else (centre - 2, False),
            (centre + 1, True) if units < 0 else (centre + 2, False),
        ),
    }
    need(digits in ends, f"digits cannot end by {digits!r}")
    (low, low_closed), (high, high_closed) = ends[digits]
    return Span(low * half, low_closed, high * half, high_closed)
