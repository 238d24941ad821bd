"""The table of verdicts: from what was found of a claim under every interpretation."""

from dataclasses import dataclass

from statistics_judge.classes import SIGN, SPEAKS

# Of ten results, so many must speak one way where others do not.
TENTHS = 9

# Verdicts by how much evidence they take, either way, the least first.
STRENGTH = (
    ("inconclusive",),
    ("not_testable",),
    ("depends",),
    ("attainable",),
    ("fitted",),
    ("supported", "not_supported"),
    ("right_in_direction",),
    ("reproduced", "not_reproduced"),
    ("impossible",),
)
FOR = ("reproduced", "right_in_direction", "supported", "attainable", "fitted")
AGAINST = ("not_supported", "not_reproduced", "impossible")


@dataclass(frozen=True)
class Results:
    """The outcomes that count, what the default and the second seed say (1, 0, -1), and what bears on it."""

    outcomes: list[str]
    default: int
    second: int
    chosen: str | None = None
    states_size: bool = False
    unvaried: bool = False

    def counts(self) -> tuple[int, int, int]:
        """How many hold, are open and contradict."""
        ways = [SPEAKS[outcome] for outcome in self.outcomes]
        return ways.count(1), ways.count(0), ways.count(-1)

    def sign_alone(self) -> bool:
        """Whether a stated size is missed by a result that holds."""
        return self.states_size and SIGN in self.outcomes

    def verdict(self) -> tuple[str, str]:
        """The verdict by the first line that applies, and that line."""
        holds, left, fails = self.counts()
        kinds = set(self.outcomes)
        for outcome, line in (("impossible", "proved"), ("not_testable", "lacking")):
            if kinds == {outcome}:
                return outcome, line
        met = self.met()
        if met:
            return self.of_chosen(met)
        if self.default and self.second == -self.default:
            return "inconclusive", "seed"
        every = len(self.outcomes)
        for way, speak in ((1, holds), (-1, fails)):
            agree = self.default == self.second == way
            if speak and (speak == every or (agree and 10 * speak >= TENTHS * every)):
                return self.firm(way), "all" if speak == every else "nine"
        for way, speak, contrary in ((1, holds, fails), (-1, fails, holds)):
            # A second seed that speaks the opposite way has decided before.
            if not contrary and speak > left and self.default == way:
                return ("supported" if way == 1 else "not_supported"), "more"
        return ("depends", "both") if holds and fails else ("inconclusive", "short")

    def of_chosen(self, met: str) -> tuple[str, str]:
        """The verdict of what can be met."""
        holds, _, fails = self.counts()
        if not holds:
            is_refused = fails == len(self.outcomes) > 0
            return ("not_reproduced", "all") if is_refused else ("inconclusive", "no example")
        if met == "fitted" and self.second == -1:
            return "inconclusive", "refused"
        return met, "met"

    def met(self) -> str | None:
        """What is met at best: where inputs were chosen for the claim, or for some result that holds."""
        words = {"fitted": "fitted", "searched": "attainable", "existence": "attainable"}
        found = {outcome for outcome in self.outcomes if outcome in ("fitted", "attainable")}
        if self.chosen:
            found.add(words[self.chosen])
        return min(found, default=None)

    def firm(self, way: int) -> str:
        """The verdict where results speak one way."""
        if way == -1:
            return "not_supported" if self.unvaried else "not_reproduced"
        if self.unvaried:
            return "supported"
        return "right_in_direction" if self.sign_alone() else "reproduced"


def of_meanings(meanings: list[str]) -> str:
    """The verdict of a sentence that means one of its parts: the weakest, unless they speak both ways."""
    kinds = set(meanings)
    if kinds & set(FOR) and kinds & set(AGAINST):
        return "depends"
    if "not_testable" in kinds and len(kinds) > 1:
        return "inconclusive"
    rank = {verdict: place for place, same in enumerate(STRENGTH) for verdict in same}
    return min(meanings, key=rank.__getitem__, default="inconclusive")
