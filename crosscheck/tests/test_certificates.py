"""Certificates of `replan audit`: the real ones are verified, and wrong ones are refused."""

from __future__ import annotations

import copy
import json
from fractions import Fraction
from math import isqrt
from pathlib import Path

import pytest

from certificates import Refused, verify
from certificates.counting import are_met

FILES = sorted((Path(__file__).parent / "certificates").glob("*.json"))
# Prose proves nothing, so changing it breaks nothing.
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


def has(check: str, of: str, *names: object) -> object:
    """Whether a certificate of the check has these fields, or these values of fields, in a part of it."""

    def fits(certificate: dict) -> bool:
        part = certificate[of][0] if isinstance(certificate[of], list) else certificate[of]
        fields = [item for pair in part.items() for item in (pair[0], pair)]
        return certificate["check"] == check and all(name in fields for name in names)

    return fits


# Every kind of step, and every premise that changes what has to be shown.
KINDS = [
    has("grim", "steps", "below"),
    has("grim", "steps", "outside"),
    has("grim", "given", ("is_count", True)),
    has("grim", "numbers", ("significant", 6)),
    has("grimmer", "given", ("printed_ends", [2, 3])),
    has("grimmer", "given", ("is_error", True)),
    has("seed_spread", "steps", "not_met"),
    has("debit", "steps", "variances"),
    has("quantile", "given", ("rule", "linear")),
    has("quantile", "given", ("rule", "any")),
    has("quantile", "given", ("share", "1")),
    has("order", "given", ("ranks", ["1/2", "3/4"])),
    has("order", "given", ("ranks", [None, "1"])),
    has("sd_range", "steps", "most"),
    has("sd_range", "steps", "least"),
    has("sd_range", "steps", "at_most"),
    has("shares_sum", "steps", "misses"),
    has("shares_sum", "steps", "counts"),
    has("sum_of_means", "given", ("cut", None)),
    has("sum_of_means", "given", ("cut", "1")),
    has("total_over_mean", "given", ("n", None)),
    has("total_over_mean", "given", ("n", "40")),
    has("ratio", "given", ("forms", ["a/b"])),
    has("reduction", "given", ("forms", ["100(a-b)/a"])),
    has("reduction", "given", ("forms", ["100(a-b)/b"])),
    has("speedup", "given", ("forms", ["a/b", "a/b-1"])),
    has("lattice", "given", ("diagonal", None), ("displacement", None)),
    has("lattice", "given", ("displacement", ["3", "5"])),
    has("lattice", "given", ("diagonal", "7/5")),
    has("path_bound", "given", ("moves", "any")),
    has("path_bound", "given", ("moves", "eight")),
    has("path_bound", "given", ("moves", "four")),
    has("interval", "steps", ("end", "low"), ("lies", "above")),
    has("interval", "steps", ("end", "low"), ("lies", "below")),
    has("interval", "steps", ("end", "high"), ("lies", "above")),
    has("expansions", "steps", "outside_by"),
    has("clock", "steps", "below"),
    has("rises", "steps", "more_at_most"),
    has("ratio_label", "steps", "bound"),
    has("turn_sum", "steps", "sums_deg"),
]


@pytest.mark.parametrize("kind", KINDS, ids=range(len(KINDS)))
def test_there_is_a_certificate_of_every_kind_of_step_and_premise(kind: object) -> None:
    assert any(kind(certificate) for certificate in certificates())


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


def changes(value: object) -> list:
    """Other values of the same kind, and of another."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value - 1, value + 1]
    if value is None:
        return ["0", "1", "100"]
    try:
        number = Fraction(value)
    except ValueError:
        brackets = {"[": "(", "(": "[", "]": ")", ")": "]"}
        return [brackets[value]] if value in brackets else [f"{value}?", *WORDS]
    others = {number - 1, number + 1, number + Fraction(1, 2), number + 10, number / 2} - {number}
    return [*(str(other) for other in others), None]


# Every word that some field can have: how digits end, divisors, moves, rules.
WORDS = ["any", "nearest", "half up", "half even", "truncation", "floor", "ceiling"]
WORDS += ["sample", "population", "either", "four", "eight", "linear", "high", "low", "below", "above"]


def mutated() -> list[tuple[str, tuple, dict]]:
    """Every certificate with one value changed, in every way: its check and the place as well."""
    found = []
    for certificate in certificates():
        for path in leaves(certificate):
            value = certificate
            for key in path:
                value = value[key]
            for change in changes(value):
                wrong = copy.deepcopy(certificate)
                inner = wrong
                for key in path[:-1]:
                    inner = inner[key]
                inner[path[-1]] = change
                if change != value:
                    found.append((kind_of(certificate), path, wrong))
    return found


# Fields that can change and leave a proof: of the changed claim, which the checker proves anew.
PROVED_ANEW = {
    # An end that does not bind.
    "grim": {"least", "most"},
    "grimmer": {"least", "most"},
    "seed_spread": {"least", "most"},
    # A number beyond the ends is there for any n and grain.
    "grim outside": {"n", "grain"},
    # Without ends that bind, counts are whole for any n.
    "grim of a count": {"least", "most", "n"},
    # All moves are tried again.
    "lattice": {"diagonal", "displacement"},
    # The same multiples belong to more values, or to another quantile.
    "quantile": {"n", "share"},
    # The least and the greatest value follow no rule.
    "quantile at an end": {"n", "share", "rule"},
    # Another quantile below the same one.
    "order": {"ranks"},
    # The bound of one divisor is also that of either.
    "sd_range": {"divisor"},
    # The tails are summed again; the other end is missed as well.
    "interval": {"k", "n", "tail", "whole", "end"},
}


def kind_of(certificate: dict) -> str:
    """The check, and whether it is about ends, for which other premises count."""
    check, given = certificate["check"], certificate["given"]
    if check == "grim":
        is_outside = "outside" in certificate["steps"][0]
        return "grim outside" if is_outside else "grim of a count" if given["is_count"] else check
    return "quantile at an end" if check == "quantile" and given["share"] in ("0", "1") else check


def test_no_change_of_any_value_is_believed_but_of_premises_that_are_proved_anew() -> None:
    believed = set()
    every = mutated()
    for kind, path, wrong in every:
        if not is_refused(wrong):
            believed.add((kind, path[1] if path[0] == "given" else path[-1]))
    allowed = {(kind, field) for kind, fields in PROVED_ANEW.items() for field in fields}
    assert believed == allowed
    assert len(every) > 4000


def is_printable(check: str, wrong: dict) -> bool:
    """Whether data print the numbers of a certificate: all are written out, by no rule of the checker."""
    given = {
        key: value if value is None or isinstance(value, list | bool | dict) else Fraction(value)
        for key, value in wrong["given"].items()
    }
    ends = [[Fraction(end) for end in number["span"][1:3]] for number in wrong["numbers"]]
    closed = [(number["span"][0] == "[", number["span"][3] == "]") for number in wrong["numbers"]]

    def prints(at: int, value: Fraction) -> bool:
        (low, high), (is_low, is_high) = ends[at], closed[at]
        return low < value < high or (is_low and value == low) or (is_high and value == high)

    if check == "grim":
        # A count is the sum of the values, a share or mean their sum over n.
        over = 1 if given["is_count"] else given["n"]
        most = int(ends[0][1] * over / given["grain"]) + 2
        means = (k * given["grain"] / over for k in range(most))
        times = given["n"] / over
        least, greatest = (None if given[end] is None else given[end] * times for end in ("least", "most"))
        return any(
            prints(0, mean)
            for mean in means
            if (least is None or mean >= least) and (greatest is None or mean <= greatest)
        )
    step, diagonal = given["step"], given["diagonal"]
    for straight in range(20):
        for count in range(20):
            root = Fraction(isqrt(2 * count * count * 10**24), 10**12)
            length = step * (straight + (root if diagonal is None else count * diagonal))
            if prints(0, length) and ends_meet(straight, count, given["displacement"]):
                return True
    return False


def ends_meet(straight: int, diagonal: int, displacement: list | None) -> bool:
    """Whether some directions of the moves lead over the displacement: all sums of signs are tried."""
    if displacement is None:
        return True
    x, y = map(int, displacement)
    by_axis = [
        (s_x, s_y)
        for across in range(straight + 1)
        for s_x in range(-across, across + 1, 2)
        for s_y in range(across - straight, straight - across + 1, 2)
    ]
    signs = range(-diagonal, diagonal + 1, 2)
    return any(x - s_x in signs and y - s_y in signs for s_x, s_y in by_axis)


def test_what_is_proved_anew_of_changed_premises_is_true() -> None:
    asked = {"grim": 0, "lattice": 0}
    for _, _, wrong in mutated():
        check = wrong["check"]
        if check in asked and not is_refused(wrong):
            assert not is_printable(check, wrong), wrong
            asked[check] += 1
    assert min(asked.values()) > 10, asked


def test_the_search_for_values_finds_exactly_those_that_occur() -> None:
    for n, width in [(2, 9), (3, 8), (4, 6), (5, 5), (7, 3)]:
        met = {(0, 0)}
        for _ in range(n):
            met = {(s + x, q + x * x) for s, q in met for x in range(width + 1)}
        for total in range(n * width + 1):
            for squared in range(n * width * width + 1):
                found = are_met(n, total, squared, [0, width])
                assert found == ((total, squared) in met), (n, width, total, squared)


def test_numbers_that_data_can_print_have_no_certificate() -> None:
    """The digits are replaced by a possible print, with the right span: no steps can prove that."""
    grim = next(c for c in certificates() if c["check"] == "grim" and c["steps"][0].get("step") == "2/5")
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
