"""The second judge of verdicts: what is stored agrees, and wrong combinations are noticed."""

from __future__ import annotations

import copy
import tomllib
from pathlib import Path
from typing import Any

import pytest

from statistics_judge.across import Across, Choice, Counted, Result, choices, differences, flips
from statistics_judge.depends import Sides
from statistics_judge.medians import departs
from statistics_judge.records import Paper, Study
from statistics_judge.shared_out import shares
from statistics_judge.table import Results, of_meanings

ROOT = Path(__file__).parents[2]
# What `replan crosscheck --statistics` gives the judge.
GIVEN = ROOT / "target/replan/crosscheck"
EXPLORED = [path.parent.name for path in sorted(ROOT.glob("data/runs/*/estimates.parquet"))]


def paper(name: str, explored: Path | None = None) -> Paper:
    given = explored or GIVEN / f"{name}.explored.json"
    return Paper(ROOT / "experiments" / name, ROOT / "data/runs" / name, [], given)


def stored(of: Paper) -> dict[str, Any]:
    return tomllib.loads((of.runs / "verdicts.toml").read_text(encoding="utf-8"))


def different(of: Paper, verdicts: dict[str, Any]) -> list[str]:
    return [line for line in differences(of, verdicts) if line is not None]


@pytest.mark.parametrize("name", EXPLORED)
def test_what_is_stored_across_readings_agrees(name: str) -> None:
    of = paper(name)
    lines = list(differences(of, stored(of)))
    assert len(lines) > 10
    assert [line for line in lines if line is not None] == []


def test_some_paper_is_explored() -> None:
    assert EXPLORED


def another(value: bool | int | str | None) -> bool | int | str:
    """A value other than this."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    return "inconclusive" if value != "inconclusive" else "reproduced"


OWN = ["verdict", "beside", "depends_on"]
KEYS = [
    "counted",
    "looked",
    "holds",
    "open",
    "fails",
    "unconfirmed",
    "not_looked_at",
    "incompatible",
]


@pytest.mark.parametrize("name", EXPLORED)
@pytest.mark.parametrize("key", [*OWN, *KEYS])
def test_a_combination_made_wrong_is_noticed_wherever_it_stands(name: str, key: str) -> None:
    of = paper(name)
    verdicts = stored(of)
    explored = [claim for claim in verdicts["claim"] if key in OWN or "across" in claim]
    for claim in explored:
        place = claim if key in OWN else claim["across"]
        place[key] = another(place.get(key))
    lines = different(of, verdicts)
    for claim in explored:
        assert any(f"`{claim['claim']}`" in line and f"`{key}`" in line for line in lines), claim["claim"]
    assert len(lines) == len(explored)


@pytest.mark.parametrize("name", EXPLORED)
def test_a_combination_that_is_missing_and_a_second_outcome_made_wrong_are_noticed(name: str) -> None:
    of = paper(name)
    verdicts = stored(of)
    wrong = copy.deepcopy(verdicts)
    # Where no explored option votes, no claim says anything across interpretations.
    claim = next((claim for claim in wrong["claim"] if "across" in claim), None)
    assert claim is not None or name == "vamp"
    if claim is not None:
        del claim["across"]
        assert any("verdicts.toml says nothing" in line for line in different(of, wrong))
    wrong = copy.deepcopy(verdicts)
    claim = next((claim for claim in wrong["claim"] if "second" in claim), None)
    assert (claim is not None) == (of.explorations[1] is not None)
    if claim is None:
        return
    claim["second"] = "holds" if claim["second"] != "holds" else "open"
    assert any("on the second seed" in line for line in different(of, wrong))


@pytest.mark.parametrize("name", EXPLORED)
def test_an_exploration_that_was_changed_no_longer_agrees(name: str, tmp_path: Path) -> None:
    """An outcome is turned in what was explored, where all results of a claim say the same."""
    text = (GIVEN / f"{name}.explored.json").read_text(encoding="utf-8")
    turned = text.replace('"outcome":"holds"', '"outcome":"contradicted"')
    assert turned != text
    explored = tmp_path / "explored.json"
    explored.write_text(turned, encoding="utf-8")
    of = paper(name, explored)
    assert different(of, stored(of))


def test_a_vote_made_a_probe_changes_what_is_counted() -> None:
    of = paper(EXPLORED[-1])
    choice, name = next(
        (choice, name)
        for choice in of.choices
        for name, option in choice["option"].items()
        if "practice" in option and name != choice["default"]
    )
    choice["option"][name].pop("practice")
    choice["option"][name].pop("paper", None)
    choice = next(one for one in choices(of) if one.id == choice["id"])
    assert not choice.votes({choice.id: name})
    assert different(of, stored(of))


def test_a_choice_that_is_called_calibrated_and_is_not_is_noticed() -> None:
    of = paper("theta")
    verdicts = stored(of)
    settled = [claim for claim in verdicts["claim"] if "blocking = draws" in claim.get("calibrated", [])]
    assert len(settled) > 100
    settled[0]["calibrated"] = ["border = spared"]
    settled[1]["calibrated"] = ["blocking = independent"]
    lines = different(of, verdicts)
    for claim in settled[:2]:
        assert any(f"`{claim['claim']}`" in line and "`calibrated`" in line for line in lines)


GOOD, FITTED, NO, BAD, NEVER, LACKING = (
    "holds",
    "fitted",
    "open",
    "contradicted",
    "impossible",
    "not_testable",
)


@pytest.mark.parametrize(
    ("outcomes", "second", "chosen", "verdict"),
    [
        ([GOOD] * 3, 0, None, "reproduced"),
        ([GOOD, FITTED], 0, None, "fitted"),
        ([GOOD, FITTED], -1, None, "inconclusive"),
        ([GOOD] * 9 + [NO], 1, None, "reproduced"),
        ([GOOD] * 9 + [BAD], 1, None, "reproduced"),
        ([GOOD] * 9 + [NO], 0, None, "supported"),
        ([GOOD] * 8 + [NO] * 2, 1, None, "supported"),
        ([GOOD] * 3, -1, None, "inconclusive"),
        ([BAD] * 8 + [NO] * 2, -1, None, "not_supported"),
        ([BAD] * 9 + [GOOD], -1, None, "not_reproduced"),
        ([GOOD] * 5 + [BAD] * 2, 1, None, "depends"),
        ([GOOD] + [NO] * 2, 1, None, "inconclusive"),
        ([NEVER] * 2, 0, None, "impossible"),
        ([NEVER, BAD], 0, None, "not_reproduced"),
        ([LACKING] * 2, 0, None, "not_testable"),
        ([LACKING, NO], 0, None, "inconclusive"),
        ([GOOD] + [NO] * 43, 0, "existence", "attainable"),
        ([BAD] * 4, 0, "searched", "not_reproduced"),
        ([BAD] * 4 + [NO], 0, "searched", "inconclusive"),
        ([], 0, None, "inconclusive"),
    ],
)
def test_results_make_the_verdict_that_the_table_says(
    outcomes: list[str], second: int, chosen: str | None, verdict: str
) -> None:
    default = {GOOD: 1, FITTED: 1, BAD: -1, NEVER: -1}.get(outcomes[0], 0) if outcomes else 0
    assert Results(outcomes, default, second, chosen).verdict()[0] == verdict


def test_a_missed_size_and_a_choice_that_was_not_varied_weaken_a_verdict() -> None:
    sign = [GOOD, "right_in_direction"]
    assert Results(sign, 1, 1, states_size=True).verdict()[0] == "right_in_direction"
    assert Results(sign, 1, 1).verdict()[0] == "reproduced"
    assert Results([GOOD] * 2, 1, 1, unvaried=True).verdict()[0] == "supported"
    assert Results([BAD] * 2, -1, -1, unvaried=True).verdict()[0] == "not_supported"


def test_meanings_depend_where_they_speak_both_ways_and_else_are_the_weakest() -> None:
    for meanings, verdict in [
        (["reproduced", "not_reproduced"], "depends"),
        (["attainable", "not_supported"], "depends"),
        (["reproduced", "supported"], "supported"),
        (["not_reproduced", "inconclusive"], "inconclusive"),
        (["not_testable", "reproduced"], "inconclusive"),
        (["not_testable"] * 2, "not_testable"),
    ]:
        assert of_meanings(meanings) == verdict, meanings


def test_what_speaks_against_most_is_a_flip_and_of_as_many_what_speaks_against_the_default() -> None:
    def of(*votes: str) -> list[int]:
        return [
            one.interpretations[0]
            for one in flips([Result([at], vote, vote) for at, vote in enumerate(votes)])
        ]

    assert of(GOOD, BAD, GOOD) == [1]
    assert of(GOOD, BAD, BAD) == [0]
    assert of(BAD, GOOD) == [1]
    assert of(NO, BAD, GOOD) == [1]
    assert of(GOOD, NO) == []


def wording_of(options: list[str], votes: list[str]) -> tuple[str, str | None]:
    """What stands beside the verdict, in one line, of results under these options of two choices, `a` by default."""
    across = Across.__new__(Across)
    across.choices = [Choice(name, "a", fitted=False, bounds=None, options={}) for name in ("order", "side")]
    interpretations = [
        {choice: one for choice, one in zip(("order", "side"), both, strict=True) if one != "a"}
        for both in options
    ]
    at = {place: {"interpretations": [place], "class": vote} for place, vote in enumerate(votes)}
    across.first = {
        "interpretations": interpretations,
        "claims": {"fewer": {"results": list(at.values()), "at": at}},
    }
    counted = Counted(
        [Result([place], vote, vote) for place, vote in enumerate(votes)],
        len(votes),
        0,
        0,
        none_compatible=False,
    )
    way = {GOOD: 1, BAD: -1}.get(votes[0], 0)
    results = Results(votes, way, way)
    words, on = across.wording("fewer", counted, results, results.verdict()[1])
    return "; ".join(words), on


ALL = [one + two for one in "abc" for two in "abc"]


def test_a_planted_rule_is_named_with_one_option_or_with_two() -> None:
    one = wording_of(ALL, [BAD if both[0] == "b" else GOOD for both in ALL])
    assert one == ("6/0/3 for/open/against; contradicted only if order = b (3 of 3)", "order")
    held = wording_of(ALL, [GOOD if both[1] == "a" else BAD for both in ALL])
    assert held == ("3/0/6 for/open/against; holds only if side = a (3 of 3)", "side")
    two = wording_of(ALL, [BAD if both == "bc" else GOOD for both in ALL])
    expected = "8/0/1 for/open/against; contradicted only if order = b and side = c (1 of 1)"
    assert two == (expected, "order and side")


def test_a_combination_names_the_axis_that_separates_best() -> None:
    found = wording_of(ALL, [BAD if (both[0] == "b") == (both[1] == "b") else GOOD for both in ALL])
    expected = (
        "4/0/5 for/open/against; order matters most: 2 of 3 against with a, 2 of 3 with c, 1 of 3 with b"
    )
    assert found == (expected, "several choices")


def test_an_option_under_which_most_results_are_on_the_other_side_is_no_reason() -> None:
    choices = {"order": "abacbac", "side": "aababac"}
    takes = {choice: options.__getitem__ for choice, options in choices.items()}
    takes["idle"] = "aaaaaba".__getitem__
    sides = Sides(takes, [[place] for place in range(7)], [-1, 1, 1, -1, -1, -1, -1])
    assert sides.rule(1, -1) is None


def test_exceptions_are_named_by_what_they_share_or_one_by_one() -> None:
    shared = wording_of(ALL, [NO if both[0] == "c" and both[1] != "a" else GOOD for both in ALL])
    assert shared[0] == "7/2/0 for/open/against; all 2 exceptions have order = c"
    apart = wording_of(ALL, [NO if both in ("bb", "cc") else GOOD for both in ALL])
    names = "order = b, side = b · order = c, side = c"
    assert apart[0] == f"7/2/0 for/open/against; exceptions: {names}"


def test_a_contender_departs_where_an_option_of_its_own_is_not_the_default() -> None:
    contenders = [
        {"label": "plain"},
        {"label": "other", "departs": {"hurry": "b"}},
        {"label": "same", "departs": {"hurry": "a"}},
    ]
    study = Study(Path("room.toml"), {"contender": contenders}, Path())
    study.taken = {"hurry": "a", "idle": "a"}
    assert [departs(study, one["label"]) for one in contenders] == [False, True, False]


def test_many_options_with_all_of_their_results_on_one_side_are_counted() -> None:
    few = {"a": [1, 0], "b": [2, 1], "c": [0, 0]}
    assert shares(few) == "1 of 1 against with a, 2 of 3 with b"
    many = {**{name: [1, 0] for name in "defgh"}, "b": [2, 1]}
    assert shares(many) == "2 of 3 against with b, all with each of 5 more"
    both = {**many, **{name: [0, 2] for name in "ijklmn"}}
    assert shares(both) == "2 of 3 against with b, none with each of 6 more, all with each of 5 more"
    listed = ", ".join(f"1 of 1 with {name}" for name in "efgh")
    assert shares({name: [1, 0] for name in "defgh"}) == f"1 of 1 against with d, {listed}"
