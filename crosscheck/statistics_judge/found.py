"""What a criterion finds."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from statistics_judge.classes import OPEN
from statistics_judge.intervals import Interval
from statistics_judge.records import Paper
from statistics_judge.selection import Cases, select

# A bootstrap over fewer instances says nothing firm.
FEWEST_INSTANCES = 10


@dataclass(frozen=True)
class Estimate:
    """Our number: with its interval, how many independent instances it rests on, cases solved and asked.

    Few instances are no reason to doubt an interval that is exact.
    """

    value: float
    n: int
    interval: Interval | None = None
    solved: tuple[int, int] | None = None
    exact: bool = False


@dataclass(frozen=True)
class Found:
    """What a criterion found; `possible` is what it might find if chance alone moved the intervals."""

    outcome: str | None
    possible: frozenset[str | None]
    estimate: Estimate | None = None
    existential: bool = False
    powerless: bool = False
    few: bool = False
    censored: frozenset[bool] = field(default_factory=lambda: frozenset([False]))


def certain(
    outcome: str | None,
    estimate: Estimate | None = None,
    *,
    existential: bool = False,
    powerless: bool = False,
) -> Found:
    """What nothing random moves."""
    return Found(outcome, frozenset([outcome]), estimate, existential, powerless)


def too_few() -> Found:
    """Undecided, without a number of ours."""
    return certain(OPEN)


def outcomes(of: Callable[[float, float], str | None], interval: Interval) -> frozenset[str | None]:
    """What a function of both ends says, wherever within Monte-Carlo error they lie."""
    ends = [(end.least, end.at, end.most) for end in interval]
    return frozenset(of(low, high) for low, high in itertools.product(*ends) if low <= high)


def hangs(
    outcome: str | None, possible: frozenset[str | None], others: list[frozenset[str | None]]
) -> frozenset[bool]:
    """Whether an outcome hangs on what is not known, by what `others` say; both where chance decides that."""
    always = any(not (one & possible) for one in others)
    never = all(one | possible == {outcome} for one in others)
    return frozenset(answer for answer, ruled_out in ((True, never), (False, always)) if not ruled_out)


@dataclass
class Asked:
    """A criterion's settings in a claim."""

    paper: Paper
    claim: dict[str, Any]
    settings: dict[str, Any]
    session: int
    seed: str

    def cases(self, **other: str) -> Cases:
        """The cases that it looks at."""
        return select(self.paper, {**self.settings["select"], **other}, self.session)
