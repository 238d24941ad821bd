"""Certificates of `replan audit`: the real ones are verified, and wrong ones are refused."""

from __future__ import annotations

import copy
import json
import random
from fractions import Fraction
from pathlib import Path

import pytest

from certificates import Refused, verify

FILES = sorted((Path(__file__).parent / "certificates").glob("*.json"))
SEED = 21
# Prose proves nothing, so changing it breaks nothing; `kinds`, `not_above`, and the like are used by index.
PROSE = {"premises", "name"}


def certificates() -> list[dict]:
    return [json.loads(path.read_text(encoding="utf-8")) for path in FILES]


def is_refused(certificate: object) -> bool:
    try:
        verify(certificate)
    except Refused:
        return True
    return False


def test_there_is_a_certificate_of_every_check_that_proves() -> None:
    from certificates.verify import RULES

    assert {certificate["check"] for certificate in certificates()} == set(RULES)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_the_certificates_of_the_program_are_verified(path: Path) -> None:
    verify(json.loads(path.read_text(encoding="utf-8")))


def leaves(value: object, path: tuple = ()) -> list[tuple]:
    """The paths to every value in a document that is no list or table, prose left out."""
    if isinstance(value, dict):
        return [
            leaf for key, inner in value.items() if key not in PROSE for leaf in leaves(inner, (*path, key))
        ]
    if isinstance(value, list):
        return [leaf for index, inner in enumerate(value) for leaf in leaves(inner, (*path, index))]
    return [path]


def changed(value: object, rng: random.Random) -> object:
    """Another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + rng.choice([-1, 1])
    if value is None:
        return "1"
    try:
        return str(Fraction(value) + rng.choice([-1, 1, Fraction(1, 2), 10]))
    except (ValueError, TypeError):
        return {"[": "(", "(": "[", "]": ")", ")": "]"}.get(value, f"{value}?")


def mutated(certificate: dict, rng: random.Random) -> tuple[tuple, dict]:
    """The certificate with one value changed, and where."""
    wrong = copy.deepcopy(certificate)
    path = rng.choice(leaves(wrong))
    inner = wrong
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = changed(inner[path[-1]], rng)
    return path, wrong


def test_certificates_with_a_wrong_step_or_span_are_refused() -> None:
    rng = random.Random(SEED)
    refused = 0
    for certificate in certificates():
        for _ in range(60):
            path, wrong = mutated(certificate, rng)
            if path[0] in ("steps", "numbers", "format", "check") and path[-1] != "digits":
                assert is_refused(wrong), (
                    f"seed {SEED}: {certificate['check']}: {path} was changed and is believed"
                )
                refused += 1
    assert refused > 500


def test_most_changes_of_what_is_given_are_refused() -> None:
    """What is given is a premise; another may be as true of the same steps (an end that does not bind)."""
    rng = random.Random(SEED)
    refused = believed = 0
    for certificate in certificates():
        for _ in range(60):
            path, wrong = mutated(certificate, rng)
            if path[0] == "given":
                is_wrong = is_refused(wrong)
                refused, believed = refused + is_wrong, believed + (not is_wrong)
    assert refused > believed, f"seed {SEED}: {refused} refused and {believed} believed"


def test_numbers_that_data_can_print_have_no_certificate() -> None:
    """The digits are replaced by a possible print, with the right span: no steps can prove that."""
    grim = next(c for c in certificates() if c["check"] == "grim" and c["given"]["step"] == "2/5")
    possible = copy.deepcopy(grim)
    possible["numbers"][0] |= {"printed": "33.2", "span": ["(", "331/10", "333/10", ")"]}
    for below in range(80, 86):
        possible["steps"] = [{"step": "2/5", "below": str(below), "above": str(below + 1)}]
        assert is_refused(possible)


def test_steps_left_out_are_missed() -> None:
    dropped = 0
    for certificate in certificates():
        for index in range(len(certificate["steps"])):
            wrong = copy.deepcopy(certificate)
            del wrong["steps"][index]
            assert is_refused(wrong), f"{certificate['check']} without step {index}"
            dropped += 1
    assert dropped > 20


@pytest.mark.parametrize("text", ["{}", "[]", "null", '"x"', '{"format": "replan audit certificate 1"}'])
def test_what_is_no_certificate_is_refused(text: str) -> None:
    assert is_refused(json.loads(text))
