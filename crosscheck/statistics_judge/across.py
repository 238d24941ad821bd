"""The class of a claim across interpretations, from a paper's stored exploration and that on its second seed."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from statistics_judge.classes import SPEAKS, WEIGHT
from statistics_judge.records import Paper
from statistics_judge.shared_out import shares

# Of ten results that speak or leave open, so many must speak.
TENTHS = 9

# Interpretations under which nothing was seen of a claim.
UNSEEN = ("unexplored", "unmeant")

Options = dict[str, str]


@dataclass
class Choice:
    """A choice of a paper."""

    id: str
    default: str
    fitted: bool
    bounds: tuple[float, float] | None
    options: dict[str, dict[str, Any]]

    def option(self, interpretation: Options) -> str:
        """The option that an interpretation takes here."""
        return interpretation.get(self.id, self.default)

    def votes(self, interpretation: Options) -> bool:
        """Whether the option can be run and the paper may mean it."""
        name = self.option(interpretation)
        return self.is_meant(name) and "cannot_run" not in self.options[name]

    def is_meant(self, name: str) -> bool:
        """Whether an option cites the paper or a practice, or is a number within sourced bounds."""
        if any(self.is_cited(option) for option in self.options.values()):
            return self.is_cited(self.options[name])
        return name == self.default

    def is_cited(self, option: dict[str, Any]) -> bool:
        """Whether one option has a source."""
        if "paper" in option or "practice" in option:
            return True
        return self.bounds is not None and "value" in option and within(option["value"], self.bounds)


@dataclass
class Result:
    """What was found about a claim under the interpretations that count of those that give one result."""

    interpretations: list[int]
    stored: str
    vote: str


@dataclass
class Counted:
    """The interpretations that count for a claim."""

    results: list[Result]
    looked: int
    not_looked_at: int
    incompatible: int
    none_compatible: bool
    existential: bool


def within(value: float, bounds: tuple[float, float]) -> bool:
    """Whether a number lies between two, both included."""
    return bounds[0] <= value <= bounds[1]


def choices(paper: Paper) -> list[Choice]:
    """The choices of a paper; what an option that is no probe does not cite, its choice may."""
    found = []
    for choice in paper.choices:
        bounds = choice.get("bounds")
        ends = (bounds["least"], bounds["greatest"]) if bounds else None
        source = {key: choice[key] for key in ("paper", "practice") if key in choice}
        options = {
            name: option if {"paper", "practice", "probe"} & option.keys() else {**source, **option}
            for name, option in choice["option"].items()
        }
        found.append(Choice(choice["id"], choice["default"], choice.get("fitted", False), ends, options))
    return found


class Across:
    """A paper's exploration, held against its verdicts."""

    def __init__(self, paper: Paper, verdicts: dict[str, Any]) -> None:
        """Read what is stored."""
        self.paper, self.choices = paper, choices(paper)
        self.first, self.second = paper.explorations
        note = verdicts.get("explored", {})
        # Whether a spec has changed since is for the hashes of replan; its word is taken for it.
        self.stale = [set(note.get(key, [])) for key in ("stale", "second_stale")]
        self.verdicts = {one["claim"]: one for one in verdicts.get("claim", [])}
        self.default = {
            name: one["across"]["default"] if "across" in one else one["verdict"]
            for name, one in self.verdicts.items()
        }
        self.calibration = {
            name for study in paper.studies.values() for name in study.spec.get("fitted_to", [])
        }

    def result(self, exploration: dict[str, Any], claim: str, place: int) -> dict[str, Any] | None:
        """What an exploration found about a claim under one of its interpretations."""
        return exploration["claims"].get(claim, {"at": {}})["at"].get(place)

    def second_class(self, claim: str) -> str | None:
        """The class under the defaults on the second seed."""
        if self.second is None or claim in self.stale[1]:
            return None
        found = self.result(self.second, claim, 0)
        return found["class"] if found and found["sight"] == "looked" else None

    def expected(self, claim: str) -> dict[str, Any] | None:
        """What verdicts.toml should say of a claim across interpretations; none if it should say nothing."""
        if self.first is None or claim in self.stale[0] or "theorem" in self.verdicts[claim]:
            return None
        counted = self.counted(claim)
        if counted.looked < 2:
            return None
        self.confirm(claim, counted.results)
        votes = [one.vote for one in counted.results]
        found = combined(votes, counted.existential)
        ways = [SPEAKS[vote] for vote in votes]
        return {
            "class": found,
            "said": self.said(claim, counted, found),
            "counted": len(votes),
            "looked": counted.looked,
            "holds": ways.count(1),
            "open": ways.count(0),
            "fails": ways.count(-1),
            "unconfirmed": sum(one.vote != one.stored for one in counted.results),
            "not_looked_at": counted.not_looked_at,
            "incompatible": counted.incompatible,
            "none_compatible": counted.none_compatible,
        }

    def counted(self, claim: str) -> Counted:
        """The interpretations that vote and are compatible, with equal results once."""
        assert self.first is not None
        interpretations = self.first["interpretations"]
        voting = [at for at, one in enumerate(interpretations) if all(choice.votes(one) for choice in self.choices)]
        judged = self.compatible(voting, *self.calibrating(claim))
        none_compatible = bool(voting) and not judged
        judged = voting if none_compatible else judged
        found = Counted([], 0, 0, len(voting) - len(judged), none_compatible, existential=False)
        stored = self.first["claims"].get(claim)
        if stored is None:
            return Counted([], 0, 0, 0, none_compatible=False, existential=False)
        found.existential = stored.get("existential", False)
        for one in stored["results"]:
            own = [at for at in one["interpretations"] if at in judged]
            # The default run stands for the default interpretation, whatever the exploration had of it.
            kept = own if one["sight"] == "looked" else [at for at in own if at == 0]
            seen = kept if one["sight"] != "unmeant" else []
            found.looked += len(seen)
            found.not_looked_at += len(own) - len(seen)
            if seen:
                now = self.default[claim] if 0 in own else one["class"]
                found.results.append(Result(seen, now, now))
        found.results.sort(key=lambda one: one.interpretations[0])
        return found

    def calibrating(self, claim: str) -> tuple[list[str], list[str]]:
        """The claims that make an interpretation incompatible for a claim; and itself, its parts and its sentence."""
        kinds = ("all_of", "any_of", "means_one_of", "cells")
        parts = {
            one["id"]: {part for kind in kinds for part in one.get(kind, [])} for one in self.paper.claims
        }
        whole = next((name for name, of in parts.items() if claim in of), None)
        known = self.calibration - self.stale[0]
        own = known & ({claim, whole} | parts[claim])
        return sorted(known - own), sorted(own)

    def compatible(self, voting: list[int], others: list[str], own: list[str]) -> list[int]:
        """The interpretations that contradict no other calibration claim; of those alike but for fits the best.

        Axes are fitted to the claim as well: best is where all hold or stay open, then where most hold.
        """
        fits: dict[int, tuple[bool, int]] = {}
        for at in voting:
            of_others, of_own = self.fit(at, others), self.fit(at, own)
            if of_others is not None:
                fits[at] = (of_own is not None, of_others + (of_own or 0))
        alike: dict[tuple[str, ...], tuple[bool, int]] = {}
        for at, fit in fits.items():
            alike[self.unfitted(at)] = max(fit, alike.get(self.unfitted(at), fit))
        return [at for at, fit in fits.items() if fit == alike[self.unfitted(at)]]

    def fit(self, place: int, calibration: list[str]) -> int | None:
        """How many calibration claims hold under an interpretation; none if one is contradicted or has no power."""
        assert self.first is not None
        holds = 0
        for claim in calibration:
            found = self.result(self.first, claim, place)
            if found is None or found["sight"] in UNSEEN:
                continue
            full = self.default.get(claim) if place == 0 else None
            way = SPEAKS[full or found["class"]]
            if way < 0 or (found["sight"] == "powerless" and full is None):
                return None
            holds += way > 0
        return holds

    def unfitted(self, place: int) -> tuple[str, ...]:
        """The options of an interpretation where nothing is fitted."""
        assert self.first is not None
        return tuple(choice.option(self.first["interpretations"][place]) for choice in self.choices if not choice.fitted)

    def confirm(self, claim: str, results: list[Result]) -> None:
        """Leaves open what speaks against most results and does not do so on the second seed."""
        assert self.first is not None
        for one in flips(results):
            again = None
            if self.second is not None and claim not in self.stale[1]:
                interpretation = self.first["interpretations"][one.interpretations[0]]
                if interpretation in self.second["interpretations"]:
                    again = self.result(self.second, claim, self.second["interpretations"].index(interpretation))
            if again is None or SPEAKS[again["class"]] != SPEAKS[one.stored]:
                one.vote = "undecided"

    def said(self, claim: str, counted: Counted, found: str) -> str:
        """What stands beside the class."""
        votes = [SPEAKS[one.vote] for one in counted.results]
        holds, fails, left, every = votes.count(1), votes.count(-1), votes.count(0), len(votes)
        tail = f", open under {left}" if left else ""
        if every == 1:
            return "asked under the defaults alone" if self.is_of_defaults(claim) else "no choice moves it"
        if counted.existential and holds:
            first = counted.results[votes.index(1)]
            tail = f", {self.name(first)} among them" if self.departs(first) else ""
            return f"met under {holds} of {every}{tail}"
        if holds and fails:
            weakest = max((one.vote for one in counted.results if SPEAKS[one.vote] == 1), key=WEIGHT.index)
            return self.hangs(claim, counted.results, weakest, SPEAKS)
        for speaks, verb, way in ((holds, "holds", 1), (fails, "fails", -1)):
            if speaks:
                firm = SPEAKS[found] == way
                tail = tail if firm else f" only, open under {left}"
                by_class = self.by_class(claim, counted.results) if firm and way == 1 else ""
                return f"{verb} under {speaks} of {every}{tail}{by_class}"
        return f"open under {left} of {every}"

    def is_of_defaults(self, claim: str) -> bool:
        """Whether some interpretation changes trials, and none of the studies that the claim looks at has any."""
        assert self.first is not None
        changing = (option for choice in self.choices for option in choice.options.values())
        if not any(option.get(key) for option in changing for key in ("problem", "stage", "contender")):
            return False
        looked_at = set(self.first["claims"][claim]["studies"])
        for study in self.paper.studies.values():
            names = {study.name, self.paper.stands_for.get(study.name)}
            if names & looked_at and study.inherited:
                return False
        return bool(looked_at)

    def by_class(self, claim: str, results: list[Result]) -> str:
        """What the class hangs on where no result speaks against the claim, but not all for it alike."""
        holding = sorted({one.vote for one in results if SPEAKS[one.vote] == 1}, key=WEIGHT.index)
        if len(holding) < 2:
            return ""
        side = {vote: (vote == holding[0]) - (vote in holding[1:]) for vote in SPEAKS}
        return f"; the class {self.hangs(claim, results, holding[0], side)}"

    def departs(self, result: Result) -> bool:
        """Whether the first interpretation of a result is another than the default."""
        assert self.first is not None
        return bool(self.first["interpretations"][result.interpretations[0]])

    def name(self, result: Result) -> str:
        """The first interpretation of a result by what differs from the defaults."""
        assert self.first is not None
        interpretation = self.first["interpretations"][result.interpretations[0]]
        return ", ".join(f"{choice} = {option}" for choice, option in sorted(interpretation.items())) or "the default"

    def alone(self, claim: str, choice: Choice, option: str) -> dict[str, Any] | None:
        """What was found under an option, all else at its default."""
        assert self.first is not None
        interpretations = self.first["interpretations"]
        one = {choice.id: option}
        return self.result(self.first, claim, interpretations.index(one)) if one in interpretations else None

    def moves(self, claim: str, choice: Choice) -> bool:
        """Whether some voting option alone gives other results than the defaults, or was not looked at."""
        assert self.first is not None
        base = self.result(self.first, claim, 0)
        voting = [name for name in choice.options if name != choice.default and choice.votes({choice.id: name})]
        if base is None or not voting:
            return True
        for found in (self.alone(claim, choice, name) for name in voting):
            if found is None or found.get("sight") in UNSEEN:
                return True
            if any(found.get(key) != base.get(key) for key in ("results", "class")):
                return True
        return False

    def decides(self, claim: str, choice: Choice, split: dict[str, list[int]], side: dict[str, int]) -> bool:
        """Whether each option with results brings its side alone, as far as that was looked at."""
        for option, (holds, fails) in split.items():
            found = self.alone(claim, choice, option) if option != choice.default and holds + fails else None
            if found is not None and (side[found["class"]] == 1) != (holds > 0):
                return False
        return True

    def is_clean(self, choice: Choice, results: list[Result], side: dict[str, int]) -> bool:
        """Whether no option has interpretations on both sides, all interpretations of each result counted."""
        assert self.first is not None
        sides: dict[str, set[int]] = {}
        for one in results:
            for place in one.interpretations if side[one.vote] else []:
                sides.setdefault(choice.option(self.first["interpretations"][place]), set()).add(side[one.vote])
        return all(len(found) == 1 for found in sides.values())

    def hangs(self, claim: str, results: list[Result], name: str, side: dict[str, int]) -> str:
        """The choice whose options best part results on one side (1), called `name`, from the other (-1)."""
        assert self.first is not None
        splits = []
        for choice in (choice for choice in self.choices if self.moves(claim, choice)):
            split: dict[str, list[int]] = {}
            for one in results:
                counts = split.setdefault(choice.option(self.first["interpretations"][one.interpretations[0]]), [0, 0])
                if side[one.vote]:
                    counts[side[one.vote] < 0] += 1
            splits.append((sum(map(max, split.values())), choice, dict(sorted(split.items()))))
        holds, fails = (sum(side[one.vote] == way for one in results) for way in (1, -1))
        found, every = name.replace("_", " "), len(results)
        for _, choice, split in splits:
            if self.is_clean(choice, results, side) and self.decides(claim, choice, split, side):
                where = " or ".join(option for option, counts in split.items() if counts[0])
                return f"hangs on {choice.id}: {found} if {where} ({holds} of {every})"
        # Many options part few results by chance: each costs one.
        parting = [one for one in splits if one[0] > max(holds, fails)]
        if not parting:
            return f"hangs on several interpretations: {found} under {holds} of {every}"
        _, choice, split = max(parting, key=lambda one: one[0] - len(one[2]))
        return f"hangs on {choice.id} and others: {found} under {holds} of {every} ({shares(split)})"


def flips(results: list[Result]) -> list[Result]:
    """The results that speak against what most say; of as many, against the first."""
    ways = [SPEAKS[one.stored] for one in results]
    holds, fails = ways.count(1), ways.count(-1)
    if not (holds and fails):
        return []
    most = 1 if holds > fails or (holds == fails and ways[0] != -1) else -1
    return [one for one, way in zip(results, ways, strict=True) if way == -most]


def combined(votes: list[str], existential: bool) -> str:
    """The class of several results, one vote each."""
    of = {way: sorted((one for one in votes if SPEAKS[one] == way), key=WEIGHT.index) for way in (1, 0, -1)}
    if existential and of[1]:
        return of[1][0]
    speaks = of[1] or of[-1]
    if of[1] and of[-1]:
        return "undecided"
    if not speaks:
        return "untestable" if votes and set(votes) == {"untestable"} else "undecided"
    if len(speaks) * 10 < TENTHS * (len(speaks) + len(of[0])):
        return "undecided"
    if of[1]:
        return of[1][-1]
    return "impossible" if set(votes) == {"impossible"} else "not_reproduced"


def differences(paper: Paper, verdicts: dict[str, Any]) -> Iterator[str | None]:
    """For every claim that was explored nothing, or what verdicts.toml says otherwise than is recomputed."""
    own = Across(paper, verdicts)
    if own.first is None and own.second is None:
        return
    for claim, stored in own.verdicts.items():
        expected, said = own.expected(claim), stored.get("across")
        where = f"{paper.id}: `{claim}` across interpretations"
        if (expected is None) != (said is None):
            has = "nothing" if said is None else "something"
            yield f"{where}: verdicts.toml says {has}; recomputed it is {expected and expected['said']}"
        elif expected is not None and said is not None:
            wrong = [key for key, value in expected.items() if said.get(key, False) != value]
            for key in wrong:
                yield f"{where}: `{key}` is {said.get(key)!r}; recomputed it is {expected[key]!r}"
            if not wrong:
                yield None
        if stored.get("second") != own.second_class(claim):
            yield (
                f"{where}: its class on the second seed is {stored.get('second')}; "
                f"recomputed it is {own.second_class(claim)}"
            )
