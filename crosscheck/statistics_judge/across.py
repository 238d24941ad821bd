"""The verdict of a claim over all interpretations, from what a paper's stored numbers amount to."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

from statistics_judge.classes import OPEN, SPEAKS, stored_outcome
from statistics_judge.depends import Sides
from statistics_judge.records import Paper
from statistics_judge.table import Results, of_meanings

# Exceptions, or choices of a kind, that are listed one by one.
LISTED = 3

# An exception with more options is counted and not listed.
OPTIONS = 2

# Per cents that an interval covers from which on it refuses next to nothing.
NO_POWER = 80.0

# Settings of criteria that state a size.
SIZES = ("by_percent", "margin", "margin_percent", "printed_ratio", "accepted")

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
    refused: list[int] = field(default_factory=list)
    calibrated: dict[str, str] = field(default_factory=dict)


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
        self.default = {name: one["outcome"] for name, one in self.verdicts.items()}
        self.calibration = {
            name for study in paper.studies.values() for name in study.spec.get("fitted_to", [])
        }

    def result(self, exploration: dict[str, Any], claim: str, place: int) -> dict[str, Any] | None:
        """What an exploration found about a claim under one of its interpretations."""
        return exploration["claims"].get(claim, {"at": {}})["at"].get(place)

    def second_outcome(self, claim: str) -> str | None:
        """The outcome under the defaults on the second seed."""
        if self.second is None or claim in self.stale[1]:
            return None
        if not self.second["claims"].get(claim, {}).get("studies"):
            # Arithmetic on what is printed looks at no trial: no seed can move it.
            return None
        found = self.result(self.second, claim, 0)
        return stored_outcome(found) if found and found["sight"] == "looked" else None

    def expected(self, claim: str) -> dict[str, Any]:
        """What verdicts.toml should say of a claim; under `across` nothing, if the default alone counts."""
        stored = self.verdicts[claim]
        is_seedless = stored.get("is_seedless", False)
        counted = Counted([], 0, 0, 0, none_compatible=False)
        if self.first is not None and claim not in self.stale[0] and "theorem" not in stored:
            counted = self.counted(claim)
        is_explored = counted.looked > 1
        # Which choices touch the claim is replan's word; that each of these is settled is computed.
        calibrated = [
            f"{choice} = {option}"
            for choice, option in counted.calibrated.items()
            if f"{choice} = {option}" in stored.get("calibrated", [])
        ]
        if not is_explored:
            own = self.default[claim]
            counted = Counted([Result([0], own, own)], 1, 0, 0, none_compatible=False)
        if is_explored and not is_seedless:
            self.confirm(claim, counted.results)
        default, second = 0, SPEAKS[self.second_outcome(claim) or OPEN]
        if any(0 in one.interpretations for one in counted.results):
            default = SPEAKS[self.default[claim]]
        # Which interpretations touch a claim, and whether a seed does, is for replan's registries: its word counts.
        results = Results(
            [one.vote for one in counted.results],
            default,
            default if is_seedless else second,
            stored.get("chosen"),
            self.states_size(claim),
            bool(stored.get("not_varied")),
        )
        verdict, line = results.verdict()
        beside, on = self.wording(claim, counted, results, line)
        possible = self.possible(claim)
        unvaried = [
            listed("calibrated", calibrated),
            listed("choices not varied", stored.get("not_varied", [])),
        ]
        unvaried = [] if line in ("proved", "lacking") else unvaried
        beside = [one for one in (*([possible] if possible else beside), *unvaried) if one]
        found = {
            "verdict": verdict,
            "beside": beside,
            "depends_on": on,
            "calibrated": calibrated,
            "across": None,
        }
        if is_explored:
            found["across"] = self.across_of(counted, results)
        return found

    def across_of(self, counted: Counted, results: Results) -> dict[str, Any]:
        """The counts across interpretations."""
        holds, left, fails = results.counts()
        return {
            "counted": len(counted.results),
            "looked": counted.looked,
            "holds": holds,
            "open": left,
            "fails": fails,
            "unconfirmed": sum(one.vote != one.stored for one in counted.results),
            "not_looked_at": counted.not_looked_at,
            "incompatible": counted.incompatible,
            "none_compatible": counted.none_compatible,
        }

    def states_size(self, claim: str) -> bool:
        """Whether a claim, or a part of it, states a size that can be missed."""
        whole = self.paper.claim(claim)
        kinds = ("all_of", "any_of", "means_one_of", "cells")
        parts = [self.paper.claim(part) for kind in kinds for part in whole.get(kind, [])]
        for one in (whole, *parts):
            asked = [*one.get("check", {}).values(), *one.get("rule", {}).values()]
            asked += [settings for tables in one.get("shows", {}).values() for settings in tables]
            if "printed" in one or any(size in settings for settings in asked for size in SIZES):
                return True
        return False

    def possible(self, claim: str) -> str | None:
        """What arithmetic found possible, where nothing else was found."""
        findings = self.verdicts[claim].get("finding", [])
        if any("outcome" in finding for finding in findings):
            return None
        lines = (line for finding in findings for line in finding["because"])
        return next((line for line in lines if line.startswith("possible: ")), None)

    @cached_property
    def voting(self) -> list[int]:
        """The places of the interpretations that the paper may mean and that can be run."""
        assert self.first is not None
        interpretations = self.first["interpretations"]
        return [
            at for at, one in enumerate(interpretations) if all(choice.votes(one) for choice in self.choices)
        ]

    def counted(self, claim: str) -> Counted:
        """The interpretations that vote and are compatible, with equal results once."""
        assert self.first is not None
        voting = self.voting
        others, own = self.calibrating(claim)
        judged = self.compatible(voting, others, own)
        none_compatible = bool(voting) and not judged
        judged = voting if none_compatible else judged
        found = Counted([], 0, 0, len(voting) - len(judged), none_compatible)
        looked = [at for at in voting if all(self.is_looked_at(one, at) for one in (*others, *own))]
        found.calibrated = self.options_left(judged, looked)
        stored = self.first["claims"].get(claim)
        if stored is None:
            return Counted([], 0, 0, 0, none_compatible=False)
        most = self.paper.explore.get("refused_above_percent")
        refused = [most is not None and 100 * one.get("refused", 0) > most for one in stored["results"]]
        stand = any(not one for one in refused)
        with_more = {
            one["results"]
            for one, is_refused in zip(stored["results"], refused, strict=True)
            if one["more"] is not None
            and not (stand and is_refused)
            and any(at in judged for at in one["interpretations"])
        }
        for one, is_refused in zip(stored["results"], refused, strict=True):
            own = [at for at in one["interpretations"] if at in judged]
            # Few instances that do not tell it from a result of more: no result of its own.
            if one["more"] is None and one["results"] in with_more and 0 not in one["interpretations"]:
                found.not_looked_at += len(own)
                continue
            # Where all are refused, none can be set apart.
            if is_refused and not all(refused):
                found.refused += own
                continue
            # The default run stands for the default interpretation, whatever the exploration had of it.
            is_looked = one["sight"] == "looked" and not self.is_powerless(claim, one)
            kept = own if is_looked else [at for at in own if at == 0]
            seen = kept if one["sight"] != "unmeant" else []
            found.looked += len(seen)
            found.not_looked_at += len(own) - len(seen)
            if seen:
                now = self.default[claim] if 0 in own else stored_outcome(one)
                found.results.append(Result(seen, now, now))
        found.results.sort(key=lambda one: one.interpretations[0])
        return found

    def is_looked_at(self, claim: str, place: int) -> bool:
        """Whether a claim was looked at under an interpretation."""
        assert self.first is not None
        found = self.result(self.first, claim, place)
        return found is not None and found["sight"] == "looked"

    def options_left(self, judged: list[int], looked: list[int]) -> dict[str, str]:
        """By choice, the one option that all compatible interpretations take, where every other was calibrated."""
        left = {}
        for choice in self.choices:
            taken = {self.taken(choice, at) for at in judged}
            others = {name for name in choice.options if choice.votes({choice.id: name})} - taken
            if len(taken) == 1 and others and others <= {self.taken(choice, at) for at in looked}:
                left[choice.id] = taken.pop()
        return left

    def is_powerless(self, claim: str, result: dict[str, Any]) -> bool:
        """Whether a saving of one more instance, stored for a claim, could have refused next to nothing."""
        asked = self.paper.claim(claim).get("check", {}).get("one_instance", {})
        ends = result.get("interval")
        is_saving = "against" in asked.get("select", {})
        is_for = SPEAKS[stored_outcome(result)] > 0
        return is_for and is_saving and ends is not None and ends[1] - ends[0] >= NO_POWER

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
            way = SPEAKS[full or stored_outcome(found)]
            if way < 0 or (found["sight"] in ("powerless", "few") and full is None):
                return None
            holds += way > 0
        return holds

    def unfitted(self, place: int) -> tuple[str, ...]:
        """The options of an interpretation where nothing is fitted."""
        assert self.first is not None
        return tuple(
            choice.option(self.first["interpretations"][place])
            for choice in self.choices
            if not choice.fitted
        )

    def confirm(self, claim: str, results: list[Result]) -> None:
        """Leaves open what speaks against most results and does not do so on the second seed."""
        assert self.first is not None
        for one in flips(results):
            again = None
            if self.second is not None and claim not in self.stale[1]:
                interpretation = self.first["interpretations"][one.interpretations[0]]
                if interpretation in self.second["interpretations"]:
                    again = self.result(
                        self.second, claim, self.second["interpretations"].index(interpretation)
                    )
            if again is None or SPEAKS[stored_outcome(again)] != SPEAKS[one.stored]:
                one.vote = OPEN

    def wording(
        self, claim: str, counted: Counted, results: Results, line: str
    ) -> tuple[list[str], str | None]:
        """What stands beside the verdict, the counts first, and on what it depends."""
        holds, left, fails = results.counts()
        every = len(results.outcomes)
        counts = f"{holds}/{left}/{fails} for/open/against" if every > 1 else None
        more: list[str | None] = []
        on = None
        match line:
            case "met" if every > 1:
                return [f"met under {holds} of {every}{self.met(claim, counted, results)}"], None
            case "proved" | "lacking" | "all" | "met":
                is_same = counted.looked > 1 and not results.unvaried
                what = "same" if len(set(results.outcomes)) < 2 else "same direction"
                same = [f"{what} under all {counted.looked}"] if is_same else []
                is_sign = results.unvaried and line == "all" and results.sign_alone()
                return [*same, *(["the sign alone"] if is_sign else [])], None
            case "no example" if results.chosen != "existence":
                return [f"met under none of {every}"], None
            case "no example":
                return [f"no example found{f' under {every}' if every > 1 else ''}"], None
            case "refused":
                return ["the second seed contradicts what was fitted"], None
            case "seed":
                ways = {1: "holds", 0: "is open", -1: "contradicts"}
                more = [
                    f"the seed decides: the first {ways[results.default]}, the second {ways[results.second]}"
                ]
            case "nine" | "more":
                way = 1 if holds > fails else -1
                more = ["the sign alone" if way == 1 and results.sign_alone() else None]
                more.append(self.exceptions(claim, counted, way))
            case "both":
                on, rule = self.rule(claim, counted)
                more = [rule]
        return [one for one in (counts, *more) if one], on

    def met(self, claim: str, counted: Counted, results: Results) -> str:
        """The first interpretation that meets a claim, if it is not the default."""
        first = next(one for one in counted.results if SPEAKS[one.vote] == 1)
        # A witness needs all options that its contender ran under.
        departs = ", ".join(self.departs(claim, first, lists_all=results.chosen == "existence"))
        return f", {departs} among them" if departs else ""

    def sides(self, claim: str, counted: Counted, sides: list[int]) -> Sides:
        """The results that count, on these sides."""
        choices = {
            choice.id: partial(self.taken, choice) for choice in self.choices if self.moves(claim, choice)
        }
        return Sides(choices, [one.interpretations for one in counted.results], sides)

    def taken(self, choice: Choice, place: int) -> str:
        """The option of a choice that the interpretation at a place takes."""
        assert self.first is not None
        return choice.option(self.first["interpretations"][place])

    def exceptions(self, claim: str, counted: Counted, way: int) -> str | None:
        """The results that do not speak as most do: what they share, or their names."""
        if counted.looked < 2:
            return None
        sides = self.sides(claim, counted, [-1 if SPEAKS[one.vote] == way else 1 for one in counted.results])
        apart = [one for one in counted.results if SPEAKS[one.vote] != way]
        if not apart:
            return None
        rule = sides.rule(1)
        if rule:
            start = "the exception has" if len(apart) == 1 else f"all {len(apart)} exceptions have"
            return f"{start} {rule.wording()}"
        departs = [self.departs(claim, one) for one in apart]
        short = [one for one in departs if len(one) <= OPTIONS]
        names = [", ".join(one) or "the defaults" for one in short[:LISTED]]
        names += [f"{len(apart) - len(names)} more"] if len(apart) > len(names) else []
        return f"exceptions: {' · '.join(names)}"

    def rule(self, claim: str, counted: Counted) -> tuple[str, str]:
        """On what it depends which way results speak, and in which words."""
        sides = self.sides(claim, counted, [-SPEAKS[one.vote] for one in counted.results])
        rule = sides.rule(1, -1)
        words = None
        if rule:
            verb = "contradicted" if rule.side == 1 else "holds"
            words = f"{verb} only if {rule.wording()} ({rule.hits} of {rule.covered})"
            if rule.is_exact:
                return " and ".join(choice for choice, _ in rule.options), words
        best = sides.separating()
        if best is not None:
            words = f"{best[0]} matters most: {best[1]}"
        return "several choices", words or "no option separates them"

    def departs(self, claim: str, result: Result, *, lists_all: bool = False) -> list[str]:
        """The options of a result's first interpretation that are not the defaults.

        Those of choices that can move the claim; all of them if none of these differs.
        """
        assert self.first is not None
        options = sorted(self.first["interpretations"][result.interpretations[0]].items())
        moving = {choice.id for choice in self.choices if self.moves(claim, choice)}
        listed = [one for one in options if lists_all or one[0] in moving] or options
        return [f"{choice} = {option}" for choice, option in listed]

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
        voting = [
            name for name in choice.options if name != choice.default and choice.votes({choice.id: name})
        ]
        if base is None or not voting:
            return True
        for found in (self.alone(claim, choice, name) for name in voting):
            if found is None or found.get("sight") in UNSEEN:
                return True
            both_have_more = None not in (found["more"], base["more"])
            if found["results"] != base["results"] or (both_have_more and found["more"] != base["more"]):
                return True
        return False


def listed(what: str, choices: list[str]) -> str | None:
    """The first of some choices, and how many more there are; nothing if there are none."""
    more = f" and {len(choices) - LISTED} more" if len(choices) > LISTED else ""
    return f"{what}: {', '.join(choices[:LISTED])}{more}" if choices else None


def flips(results: list[Result]) -> list[Result]:
    """The results that speak against what most say; of as many, against the first."""
    ways = [SPEAKS[one.stored] for one in results]
    holds, fails = ways.count(1), ways.count(-1)
    if not (holds and fails):
        return []
    most = 1 if holds > fails or (holds == fails and ways[0] != -1) else -1
    return [one for one, way in zip(results, ways, strict=True) if way == -most]


def differences(paper: Paper, verdicts: dict[str, Any]) -> Iterator[str | None]:
    """For every claim nothing, or what verdicts.toml says otherwise than is recomputed."""
    own = Across(paper, verdicts)
    found = {claim: own.expected(claim) for claim in own.verdicts}
    for claim, stored in own.verdicts.items():
        expected = {**found[claim], **meant(paper.claim(claim), found)}
        where = f"{paper.id}: `{claim}`"
        stored = {"beside": [], "calibrated": [], **stored}
        # Which printed values would be refused under an interpretation is not recomputed.
        stored["beside"] = [line for line in stored["beside"] if not line.startswith("power under ")]
        keys = ("verdict", "beside", "depends_on", "calibrated")
        wrong = [key for key in keys if stored.get(key) != expected[key]]
        for key in wrong:
            yield f"{where}: `{key}` is {stored.get(key)!r}; recomputed it is {expected[key]!r}"
        across, on_file = expected["across"], stored.get("across")
        if (across is None) != (on_file is None):
            has = "nothing" if on_file is None else "something"
            yield f"{where}: verdicts.toml says {has} across interpretations; recomputed it is {across}"
        elif across is not None and on_file is not None:
            several = [key for key, value in across.items() if on_file.get(key, False) != value]
            for key in several:
                yield f"{where} across: `{key}` is {on_file.get(key)!r}; recomputed it is {across[key]!r}"
            wrong += several
        second = own.second_outcome(claim)
        if stored.get("second") != second:
            on_file = stored.get("second")
            yield f"{where}: its outcome on the second seed is {on_file}; recomputed it is {second}"
        elif not wrong:
            yield None


def meant(claim: dict[str, Any], found: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The verdict of a sentence that means one of its parts, with what stands beside it."""
    ids = claim.get("means_one_of", [])
    if not ids or "untestable" in claim or any(claim.get(key) for key in ("check", "rule", "shows")):
        return {}
    parts = [found[part] for part in ids]
    verdict = of_meanings([part["verdict"] for part in parts])
    meanings = [f"`{name}` {in_words(part)}" for name, part in zip(ids, parts, strict=True)]
    weakest = next((part for part in parts if part["verdict"] == verdict), {})
    on = (weakest.get("depends_on") or "what is meant") if verdict == "depends" else None
    return {"verdict": verdict, "beside": [f"meanings: {', '.join(meanings)}"], "depends_on": on}


def in_words(one: dict[str, Any]) -> str:
    """A verdict in words."""
    words = one["verdict"].replace("_", " ")
    return f"{words} on {one['depends_on']}" if one["depends_on"] else words
