"""The options that all results on one side share, and which axis separates the sides best."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass

from statistics_judge.shared_out import shares

# An axis with the option that an interpretation, by its place, takes on it.
Take = Callable[[int], str]


@dataclass(frozen=True)
class Rule:
    """Options that all results on a side share, with how many are on that side and how many have them."""

    options: tuple[tuple[str, str], ...]
    side: int
    hits: int
    covered: int
    is_exact: bool

    def wording(self) -> str:
        """The options in words."""
        return " and ".join(f"{axis} = {option}" for axis, option in self.options)


@dataclass
class Sides:
    """Results, each with its interpretations and its side (1 or -1; 0 on neither), and axes that can move them."""

    axes: dict[str, Take]
    results: list[list[int]]
    sides: list[int]

    def on(self, side: int) -> list[list[int]]:
        """The results on a side."""
        return [places for places, own in zip(self.results, self.sides, strict=True) if own == side]

    def rule(self, *sides: int) -> Rule | None:
        """The smallest exact rule of one of these sides, or one option that all on a side share."""
        singles, pairs = [], []
        for side in sides:
            shared = self.shared(side)
            singles += [(side, (one,)) for one in shared]
            pairs += [(side, both) for both in itertools.combinations(shared, 2)]
        for rules, is_exact in ((singles, True), (pairs, True), (singles, False)):
            found = [one for one in rules if self.is_meant(*one, is_exact=is_exact)]
            if found:
                side, options = min(found, key=lambda one: self.interpretations(one[1]))
                covered = sum(self.has_some(places, options) for places in self.results)
                return Rule(options, side, len(self.on(side)), covered, is_exact)
        return None

    def is_meant(self, side: int, options: tuple[tuple[str, str], ...], *, is_exact: bool) -> bool:
        """Whether no result on the other side, or at most half of them, has these options."""
        others = self.on(-side)
        having = sum(self.has_some(places, options) for places in others)
        return having == 0 if is_exact else 2 * having <= len(others)

    def shared(self, side: int) -> list[tuple[str, str]]:
        """The options that every interpretation on a side takes."""
        places = [place for one in self.on(side) for place in one]
        taken = {axis: {option(place) for place in places} for axis, option in self.axes.items()}
        return [(axis, *options) for axis, options in taken.items() if len(options) == 1]

    def has_some(self, places: list[int], options: tuple[tuple[str, str], ...]) -> bool:
        """Whether some of these interpretations has the options."""
        return any(self.has(place, options) for place in places)

    def has(self, place: int, options: tuple[tuple[str, str], ...]) -> bool:
        """Whether an interpretation has the options."""
        return all(self.axes[axis](place) == option for axis, option in options)

    def interpretations(self, options: tuple[tuple[str, str], ...]) -> int:
        """How many interpretations have the options."""
        return sum(self.has(place, options) for places in self.results for place in places)

    def separating(self) -> tuple[str, str] | None:
        """The axis whose options separate the sides best, and its counts."""
        splits = []
        for axis, option in self.axes.items():
            split: dict[str, list[int]] = {}
            for places, side in zip(self.results, self.sides, strict=True):
                counts = split.setdefault(option(places[0]), [0, 0])
                if side:
                    counts[side < 0] += 1
            splits.append((sum(map(max, split.values())), axis, dict(sorted(split.items()))))
        most = max(len(self.on(1)), len(self.on(-1)))
        # Many options part few results by chance: each costs one.
        parting = [one for one in splits if one[0] > most]
        if not parting:
            return None
        _, axis, split = max(parting, key=lambda one: one[0] - len(one[2]))
        return axis, shares(split)
