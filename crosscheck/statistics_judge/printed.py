"""Printed numbers: which true values print as the digits say."""

from dataclasses import dataclass
from decimal import Decimal


@dataclass(frozen=True)
class Printed:
    """A printed number and how its digits end: rounded, truncated, or unknown, which is either."""

    text: str
    digits: str

    @property
    def number(self) -> Decimal:
        """The number that the digits say."""
        return Decimal(self.text.replace("\N{MINUS SIGN}", "-"))

    @property
    def value(self) -> float:
        """The same as a float."""
        return float(self.number)

    def ends(self) -> tuple[tuple[Decimal, bool], tuple[Decimal, bool]]:
        """The least and the greatest number that prints so, each with whether it does itself."""
        number, exponent = self.number, self.number.as_tuple().exponent
        unit = Decimal(1).scaleb(int(exponent))
        rounded = ((number - unit / 2, True), (number + unit / 2, True))
        if self.digits == "rounded":
            return rounded
        if number > 0:
            cut = ((number, True), (number + unit, False))
        elif number < 0:
            cut = ((number - unit, False), (number, True))
        else:
            cut = ((number - unit, False), (number + unit, False))
        if self.digits == "truncated":
            return cut
        return min(rounded[0], cut[0], key=lambda end: end[0]), max(
            rounded[1], cut[1], key=lambda end: end[0]
        )

    def agrees(self, value: float) -> bool:
        """Whether a number prints so; within a billionth of half the last place of an end it is that end."""
        (low, has_low), (high, has_high) = self.ends()
        half = Decimal(1).scaleb(int(self.number.as_tuple().exponent)) / 2
        exact = Decimal(value)
        slack = half * Decimal("1e-9") + 4 * Decimal(2) ** -52 * abs(exact)

        def is_above(end: Decimal, closed: bool) -> bool:
            return exact > (end - slack if closed else end + slack)

        def is_below(end: Decimal, closed: bool) -> bool:
            return exact < (end + slack if closed else end - slack)

        return is_above(low, has_low) and is_below(high, has_high)
