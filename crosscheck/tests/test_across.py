"""The second judge of classes across interpretations: what is stored agrees, and wrong combinations are noticed."""

from __future__ import annotations

import copy
import gzip
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pytest

from statistics_judge.across import Across, Choice, Counted, Result, choices, combined, differences, flips
from statistics_judge.medians import departs
from statistics_judge.records import Paper, Study
from statistics_judge.shared_out import shares

ROOT = Path(__file__).parents[2]
EXPLORED = [path.parent.name for path in sorted(ROOT.glob("data/runs/*/explored.toml.gz"))]


def paper(name: str, runs: Path | None = None) -> Paper:
    return Paper(ROOT / "experiments" / name, runs or ROOT / "data/runs" / name, [])


def stored(of: Paper) -> dict[str, Any]:
    return tomllib.loads((of.runs / "verdicts.toml").read_text(encoding="utf-8"))


def said(of: Paper, verdicts: dict[str, Any]) -> list[str]:
    return [line for line in differences(of, verdicts) if line is not None]


@pytest.mark.parametrize("name", EXPLORED)
def test_what_is_stored_across_readings_agrees(name: str) -> None:
    of = paper(name)
    lines = list(differences(of, stored(of)))
    assert len(lines) > 10
    assert [line for line in lines if line is not None] == []


def test_some_paper_is_explored() -> None:
    assert EXPLORED


def another(value: bool | int | str) -> bool | int | str:
    """A value other than this."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    return "undecided" if value != "undecided" else "reproduced"


KEYS = [
    "class",
    "said",
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
@pytest.mark.parametrize("key", KEYS)
def test_a_combination_made_wrong_is_noticed_wherever_it_stands(name: str, key: str) -> None:
    of = paper(name)
    verdicts = stored(of)
    explored = [claim for claim in verdicts["claim"] if "across" in claim]
    for claim in explored:
        claim["across"][key] = another(claim["across"][key])
    lines = said(of, verdicts)
    for claim in explored:
        assert any(f"`{claim['claim']}`" in line and f"`{key}`" in line for line in lines), claim["claim"]
    assert len(lines) == len(explored)


@pytest.mark.parametrize("name", EXPLORED)
def test_a_combination_that_is_missing_and_a_second_class_made_wrong_are_noticed(name: str) -> None:
    of = paper(name)
    verdicts = stored(of)
    wrong = copy.deepcopy(verdicts)
    claim = next(claim for claim in wrong["claim"] if "across" in claim)
    # What the default run says stays where it is.
    claim["verdict"] = claim.pop("across")["default"]
    assert any("verdicts.toml says nothing" in line for line in said(of, wrong))
    wrong = copy.deepcopy(verdicts)
    claim = next(claim for claim in wrong["claim"] if "second" in claim)
    claim["second"] = another(claim["second"])
    assert any("on the second seed" in line for line in said(of, wrong))


@pytest.mark.parametrize("name", EXPLORED)
def test_an_exploration_that_was_changed_no_longer_agrees(name: str, tmp_path: Path) -> None:
    """A class is turned in what was explored, where all results of a claim say the same."""
    runs = tmp_path / name
    runs.mkdir()
    stored_run = ROOT / "data/runs" / name
    for pattern in ("*.toml.gz", "verdicts.toml", "*.manifest.toml"):
        for file in stored_run.glob(pattern):
            shutil.copy(file, runs / file.name)
    text = gzip.decompress((runs / "explored.toml.gz").read_bytes()).decode()
    turned = text.replace('class = "reproduced"', 'class = "not_reproduced"')
    assert turned != text
    (runs / "explored.toml.gz").write_bytes(gzip.compress(turned.encode()))
    of = paper(name, runs)
    assert said(of, stored(of))


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
    choice = next(choice for choice in choices(of) if choice.id == choice["id"])
    assert not choice.votes({choice.id: name})
    assert said(of, stored(of))


GOOD, FITTED, NO, BAD, NEVER, LACKING = (
    "reproduced",
    "fitted",
    "undecided",
    "not_reproduced",
    "impossible",
    "untestable",
)


def test_classes_combine_as_the_rules_say() -> None:
    for votes, existential, expected in [
        ([GOOD] * 3, False, GOOD),
        ([GOOD, FITTED], False, FITTED),
        ([GOOD, FITTED], True, GOOD),
        ([GOOD] * 9 + [NO], False, GOOD),
        ([GOOD] * 8 + [NO], False, NO),
        ([BAD] * 9 + [LACKING], False, BAD),
        ([BAD] * 8 + [NO], False, NO),
        ([NEVER] * 2, False, NEVER),
        ([NEVER, BAD], False, BAD),
        ([NEVER] * 9 + [NO], False, BAD),
        ([GOOD] * 40 + [BAD], False, NO),
        ([NO] * 43 + [GOOD], True, GOOD),
        ([LACKING] * 2, False, LACKING),
        ([LACKING, NO], False, NO),
        ([], False, NO),
    ]:
        assert combined(votes, existential) == expected, votes


def test_what_speaks_against_most_is_a_flip_and_of_as_many_what_speaks_against_the_default() -> None:
    def of(*votes: str) -> list[int]:
        return [one.interpretations[0] for one in flips([Result([at], vote, vote) for at, vote in enumerate(votes)])]

    assert of(GOOD, BAD, GOOD) == [1]
    assert of(GOOD, BAD, BAD) == [0]
    assert of(BAD, GOOD) == [1]
    assert of(NO, BAD, GOOD) == [1]
    assert of(GOOD, NO) == []


def test_a_class_that_a_default_raises_hangs_on_it_though_the_claim_holds_either_way() -> None:
    across = Across.__new__(Across)
    across.choices = [Choice(name, "a", fitted=False, bounds=None, options={}) for name in ("idle", "hurry")]
    interpretations = [{}, {"hurry": "b"}, {"idle": "b"}]

    def said(*votes: str) -> str:
        results = [{"interpretations": [at], "class": vote} for at, vote in enumerate(votes)]
        at = dict(enumerate(results))
        across.first = {"interpretations": interpretations, "claims": {"best": {"results": results, "at": at}}}
        found = [Result([at], vote, vote) for at, vote in enumerate(votes)]
        counted = Counted(found, len(found), 0, 0, none_compatible=False, existential=False)
        return across.said("best", counted, combined(list(votes), existential=False))

    assert said(GOOD, GOOD, GOOD) == "holds under 3 of 3"
    assert said(GOOD, FITTED, GOOD) == (
        "holds under 3 of 3; the class hangs on hurry: reproduced if a (2 of 3)"
    )
    assert said(GOOD, BAD, GOOD) == "hangs on hurry: reproduced if a (2 of 3)"
    assert said(FITTED, GOOD, FITTED) == (
        "holds under 3 of 3; the class hangs on hurry: reproduced if b (1 of 3)"
    )


def test_an_axis_of_many_options_does_not_win_by_parting_few_results_each() -> None:
    across = Across.__new__(Across)
    across.choices = [Choice(name, "a", fitted=False, bounds=None, options={}) for name in ("order", "side")]
    # The last is looked at alone, and not counted.
    options = ["aa", "ba", "ca", "db", "eb", "fb", "fa"]
    votes = [GOOD, GOOD, GOOD, BAD, BAD, GOOD, BAD]
    interpretations = [
        {choice: one for choice, one in zip(("order", "side"), both, strict=True) if one != "a"}
        for both in options
    ]
    at = {place: {"interpretations": [place], "class": vote} for place, vote in enumerate(votes)}
    across.first = {"interpretations": interpretations, "claims": {"fewer": {"results": list(at.values()), "at": at}}}
    found = [Result([place], vote, vote) for place, vote in enumerate(votes[:6])]
    counted = Counted(found, 6, 0, 0, none_compatible=False, existential=False)
    said = across.said("fewer", counted, NO)
    assert said == "hangs on side and others: reproduced under 4 of 6 (a 3 of 3, b 1 of 3)"


def test_a_contender_departs_where_an_option_of_its_own_is_not_the_default() -> None:
    contenders = [
        {"label": "plain"},
        {"label": "other", "departs": {"hurry": "b"}},
        {"label": "same", "departs": {"hurry": "a"}},
    ]
    study = Study(Path("room.toml"), {"contender": contenders}, Path())
    study.taken = {"hurry": "a", "idle": "a"}
    assert [departs(study, one["label"]) for one in contenders] == [False, True, False]


def test_many_options_that_have_all_of_their_results_are_counted() -> None:
    few = {"a": [1, 0], "b": [2, 1], "c": [0, 0]}
    assert shares(few) == "a 1 of 1, b 2 of 3"
    many = {**{name: [1, 0] for name in "defgh"}, "b": [2, 1]}
    assert shares(many) == "b 2 of 3; all under each of 5 more"
    assert shares({name: [1, 0] for name in "defgh"}) == "d 1 of 1, e 1 of 1, f 1 of 1, g 1 of 1, h 1 of 1"
