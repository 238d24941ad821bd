"""The second judge of the statistics: small cases, and verdicts made wrong on purpose."""

from __future__ import annotations

import copy
import json
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow.parquet as pq
import pytest

from statistics_judge import classes
from statistics_judge.estimates import explored as cut
from statistics_judge.found import Found
from statistics_judge.judge import CRITERIA, Claim, Compared, compare_claims, compare_rows, is_few, recomputed
from statistics_judge.medians import over
from statistics_judge.printed import Printed
from statistics_judge.printed_cells import as_far, level_rank
from statistics_judge.records import Metric, Paper
from statistics_judge.shares import share
from statistics_judge.sizes import of_change, on_bounds, ratio

ROOT = Path(__file__).parents[2]
REQUEST = ROOT / "target/replan/crosscheck/statistics.json"


def test_few_draws_say_nothing_firm_of_a_share_unless_its_interval_is_exact() -> None:
    def is_firm(hits: list[float], chances: list[float]) -> bool:
        found = Found(None, frozenset(), share(np.array(hits), np.array(chances), max(chances), "a test"))
        return not is_few("share", {}, found)

    assert is_firm([1.0, 0.0, 1.0], [1.0] * 3), "one chance each"
    assert is_firm([4.0] * 3, [4.0] * 3), "all agree at an end"
    assert not is_firm([3.0] * 9, [4.0] * 9), "all agree between the ends"
    assert is_firm([3.0] * 10, [4.0] * 10)
    assert not is_firm([3.0, 2.0, 4.0], [4.0] * 3), "a bootstrap"


@pytest.mark.parametrize(
    ("text", "digits", "inside", "outside"),
    [
        ("14.65", "rounded", [14.645, 14.65, 14.655], [14.6449, 14.6551]),
        ("14.65", "truncated", [14.65, 14.6599, 14.65 - 1e-14], [14.6499, 14.66]),
        ("14.65", "unknown", [14.645, 14.6599], [14.6449, 14.66]),
        ("-0.5", "truncated", [-0.5, -0.59], [-0.6, -0.49]),
        ("0.0", "unknown", [-0.09, 0.09], [-0.1, 0.1]),
        ("69", "rounded", [68.5, 69.5], [68.4, 69.6]),
    ],
)
def test_printed_digits_stand_for_what_prints_so(
    text: str, digits: str, inside: list[float], outside: list[float]
) -> None:
    printed = Printed(text, digits)
    assert [printed.agrees(value) for value in inside + outside] == [True] * len(inside) + [False] * len(
        outside
    )


def test_a_row_like_the_draws_is_near_and_an_opposite_one_far() -> None:
    ours = np.array([[m + i * 7 % 21 - 10.0 for m in (10, 50, 90)] for i in range(40)])
    assert as_far(np.array([12.0, 47.0, 93.0]), ours) > 25
    assert as_far(np.array([90.0, 50.0, 10.0]), ours) == 0
    assert level_rank(np.array([99.0, 99.0, 99.0]), ours) == pytest.approx(2 / 41)


def test_zeros_and_failures_are_equal_to_themselves() -> None:
    assert [over(0, 0), over(np.inf, np.inf), over(1, np.inf), over(1, 0)] == [1, 1, 0, np.inf]
    # Sums of the same steps in another order.
    assert over(0.3 + 0.2 + 0.1, 0.1 + 0.2 + 0.3) == 1


def test_rounding_alone_is_no_change_meets_a_margin_and_lies_on_a_bound() -> None:
    one, other = 0.1 + 0.2 + 0.3, 0.3 + 0.2 + 0.1
    for quotient in (one / other, other / one):
        change = 100 * (quotient - 1)
        assert change != 0
        assert of_change(change, change, 0.0, False) == of_change(change, change, 0.0, True) == classes.FAILS
    # A fifth less is a fifth less, though 0.8 - 1 is not -0.2.
    fifth = 100 * (8 / 10 - 1)
    assert fifth > -20
    assert of_change(fifth, fifth, 20.0, False) == classes.HOLDS
    assert of_change(-19.9, -19.9, 20.0, False) == classes.SIGN
    assert on_bounds(one, 0.0, other) == other
    assert on_bounds(other, one, 1.0) == one
    assert on_bounds(one + 1e-6, 0.0, other) == one + 1e-6


def test_a_mean_of_ratios_weighs_every_instance_alike() -> None:
    # Ratios 2, 1/2 and 5/10, of two cases; an instance with nothing to divide by is left out.
    bases, values = np.array([1.0, 40.0, 4.0, 6.0, 0.0]), np.array([2.0, 20.0, 3.0, 2.0, 7.0])
    cases = SimpleNamespace(unit=np.array([0, 1, 2, 2, 3]))
    of_ratios, of_means = (ratio(cases, bases, values, "a test", of_instances=way) for way in (True, False))
    assert of_ratios and of_means
    assert (of_ratios[0], of_ratios[2]) == (pytest.approx(1), 3)
    assert (of_means[0], of_means[2]) == (pytest.approx(34 / 51), 4)


def test_what_lowers_an_outcome_raises_none() -> None:
    holds = classes.of_finding
    assert holds(classes.HOLDS) == "holds"
    assert holds(classes.HOLDS, fitted=True) == "fitted"
    assert holds(classes.HOLDS, fitted=True, searched=True) == "attainable"
    assert holds(classes.SIGN, existential=True) == classes.SIGN
    assert holds(classes.SIGN, fitted=True) == holds(classes.SIGN, searched=True) == classes.OPEN
    assert holds(classes.FAILS, powerless=True) == classes.FAILS
    for cap in ("powerless", "censored", "clock", "not_run"):
        assert holds(classes.HOLDS, **{cap: True}) == classes.OPEN
    for cap in ("censored", "clock", "not_run"):
        assert holds(classes.FAILS, **{cap: True}) == classes.OPEN


def test_parts_combine_by_the_way_they_speak() -> None:
    good, fitted, bad, never, no, lacking = (
        "holds", "fitted", "contradicted", "impossible", "open", "not_testable"
    )  # fmt: skip
    for parts, together, any_one, meant in [
        ([good, fitted], fitted, good, fitted),
        ([good, no], no, good, no),
        ([good, bad], bad, good, no),
        ([never, bad], never, bad, bad),
        ([lacking, lacking], lacking, lacking, lacking),
        ([lacking, no], no, no, no),
        ([no, bad], bad, no, no),
    ]:
        found = classes.all_of(parts), classes.any_of(parts), classes.means_one_of(parts)
        assert found == (together, any_one, meant), parts
    assert classes.combined([good, lacking, bad], False) == bad
    assert classes.combined([good, fitted], True) == lacking
    assert classes.combined([], False) == no


@pytest.fixture(scope="module")
def metrics() -> list[Metric]:
    if not REQUEST.is_file():
        pytest.fail(f"{REQUEST}: no such file; `replan crosscheck --statistics` writes it")
    return [Metric(**metric) for metric in json.loads(REQUEST.read_text(encoding="utf-8"))["metrics"]]


Judged = list[tuple[Paper, list[Claim], dict]]

# Recomputing these takes most of a minute, and the others have findings by every criterion.
TAKE_LONG = ("theta", "zhang")


def explored(name: str) -> Path:
    """What `replan crosscheck --statistics` gives the judge of a paper's explorations."""
    return ROOT / f"target/replan/crosscheck/{name}.explored.json"


@pytest.fixture(scope="module")
def judged(metrics: list[Metric]) -> Judged:
    """Papers with what is recomputed of them and what is stored; `replan crosscheck --statistics` compares all."""
    found = []
    for path in sorted(ROOT.glob("experiments/*/paper.toml")):
        if path.parent.name in TAKE_LONG:
            continue
        paper = Paper(path.parent, ROOT / "data/runs" / path.parent.name, metrics, explored(path.parent.name))
        found.append((paper, recomputed(paper), stored(paper)))
    return found


def stored(paper: Paper) -> dict:
    return tomllib.loads((paper.runs / "verdicts.toml").read_text(encoding="utf-8"))


def differences(paper: Paper, claims: list[Claim], verdicts: dict) -> list[str]:
    found = Compared()
    compare_claims(paper, claims, verdicts, found)
    return found.differ


def wrong_value(finding: dict) -> None:
    finding["ours"]["value"] = finding["ours"]["value"] * 1.0001 + 1e-6


def wrong_n(finding: dict) -> None:
    finding["ours"]["n"] += 1


def wrong_solved(finding: dict) -> None:
    finding["ours"]["solved"][0] -= 1


def wrong_interval(finding: dict) -> None:
    # That of a quarter as many units.
    value, (low, high) = finding["ours"]["value"], finding["ours"]["interval"]
    finding["ours"]["interval"] = [value + 2 * (low - value) - 1e-6, value + 2 * (high - value) + 1e-6]


def wrong_outcome(finding: dict) -> None:
    finding["outcome"] = "fitted" if finding["outcome"] != "fitted" else "holds"


WRONG: dict[str, tuple[Callable[[dict], None], Callable[[dict], bool], str]] = {
    "value": (wrong_value, lambda finding: "ours" in finding, "its value is"),
    "n": (wrong_n, lambda finding: "ours" in finding, "it rests on n"),
    "solved": (wrong_solved, lambda finding: "solved" in finding.get("ours", {}), "solved are"),
    "interval": (wrong_interval, lambda finding: "interval" in finding.get("ours", {}), "its interval is"),
    "outcome": (wrong_outcome, lambda finding: finding.get("outcome") is not None, "its outcome is"),
}

# What some criteria do not give.
WITHOUT = {
    ("exists", "solved"),
    ("exists", "interval"),
    ("least_of", "solved"),
    ("prints_as", "interval"),
    ("row_one_instance", "interval"),
    ("table_means", "interval"),
}


@dataclass
class Spoiled:
    """One thing made wrong in every finding of every paper, and where it is noticed."""

    what: str
    by_criterion: dict[str, set[str]]
    noticed: set[str]


@pytest.fixture(scope="module", params=WRONG)
def spoiled(judged: Judged, request: pytest.FixtureRequest) -> Spoiled:
    """All criteria at once: a paper is compared once for each thing that is made wrong."""
    spoil, applies, message = WRONG[request.param]
    made = Spoiled(request.param, {criterion: set() for criterion in CRITERIA}, set())
    for paper, claims, verdicts in judged:
        wrong = copy.deepcopy(verdicts)
        for claim in wrong["claim"]:
            for place, finding in enumerate(claim.get("finding", []), start=1):
                criterion = finding["criterion"]
                if criterion in CRITERIA and applies(finding):
                    spoil(finding)
                    where = f"{paper.id}: `{claim['claim']}`, finding {place} ({criterion}): "
                    made.by_criterion[criterion].add(where)
        lines = differences(paper, claims, wrong)
        made.noticed |= {line.partition(message)[0] for line in lines if message in line}
    return made


@pytest.mark.parametrize("criterion", CRITERIA)
def test_a_criterion_made_wrong_is_noticed(spoiled: Spoiled, criterion: str) -> None:
    made = spoiled.by_criterion[criterion]
    assert (not made) == ((criterion, spoiled.what) in WITHOUT), f"{len(made)} spoiled"
    assert made - spoiled.noticed == set()


def test_a_claim_of_parts_and_a_claim_made_wrong_are_noticed(judged: Judged) -> None:
    kinds = set()
    for paper, claims, verdicts in judged:
        wrong, wrong_parts = copy.deepcopy(verdicts), copy.deepcopy(verdicts)
        for claim, stored, parts in zip(claims, wrong["claim"], wrong_parts["claim"], strict=True):
            wrong_outcome(stored)
            if claim.parts:
                wrong_outcome(parts["finding"][-1])
        said = differences(paper, claims, wrong)
        said_of_parts = differences(paper, claims, wrong_parts)
        for claim in claims:
            assert any(line.startswith(f"{paper.id}: `{claim.id}`:") for line in said), claim.id
            if claim.parts:
                kinds.add(claim.parts[0])
                assert any(
                    f"`{claim.id}`" in line and f"({claim.parts[0]})" in line for line in said_of_parts
                ), claim.id
    assert kinds == set(classes.PARTS)


def test_findings_that_are_missing_and_other_claims_are_noticed(judged: Judged) -> None:
    paper, claims, verdicts = judged[0]
    wrong = copy.deepcopy(verdicts)
    wrong["claim"][0]["finding"].pop(0)
    assert any("has findings" in line for line in differences(paper, claims, wrong))
    wrong = copy.deepcopy(verdicts)
    wrong["claim"].pop()
    assert any("has other claims" in line for line in differences(paper, claims, wrong))


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("karaman", 18),
        # Ratios of medians, and the numbers found on sets of problems: parts, of a study that another one stands for.
        ("planar", 250),
    ],
)
def test_an_altered_number_of_estimates_parquet_is_noticed(
    tmp_path: Path, metrics: list[Metric], name: str, least: int
) -> None:
    runs = tmp_path / name
    shutil.copytree(ROOT / "data/runs" / name, runs)
    paper = Paper(ROOT / "experiments" / name, runs, metrics, explored(name))
    claims = recomputed(paper)

    def rows_compared() -> Compared:
        found = Compared()
        compare_rows(paper, claims, found)
        return found

    sound = rows_compared()
    assert sound.differ == []
    assert sound.rows >= least
    assert sound.left_out.total() > 0
    table = pq.read_table(runs / "estimates.parquet")
    altered = [
        None if value is None else value * (1 + 1e-6) + 1e-6 for value in table.column("value").to_pylist()
    ]
    at = table.column_names.index("value")
    pq.write_table(table.set_column(at, "value", [altered]), runs / "estimates.parquet")
    wrong = rows_compared().differ
    # What is infinite stays so.
    finite = sum(value is not None and np.isfinite(value) for value in altered)
    assert least <= len(wrong) <= min(sound.rows, finite)
    assert all("its value is" in line for line in wrong), wrong


def test_an_exploration_sees_its_first_instances_alone(metrics: list[Metric]) -> None:
    # The values as estimates.parquet has them are those of 40 and 120 instances a group.
    paper = Paper(ROOT / "experiments/zhang", ROOT / "data/runs/zhang", metrics, explored("zhang"))
    papers = [paper, cut(paper, has_more=False), cut(paper, has_more=True)]
    studies = [one.studies["ensemble"] for one in papers]
    rows = [study.rows("simple cells 10 %", "A*") for study in studies]
    assert [len(np.unique(studies[0].instance[own])) for own in rows] == [200, 40, 120]


def test_the_command_ends_with_3_where_something_differs(tmp_path: Path, metrics: list[Metric]) -> None:
    runs = tmp_path / "movingai_sample"
    shutil.copytree(ROOT / "data/runs/movingai_sample", runs)
    paper = {
        "experiments": str(ROOT / "experiments/movingai_sample"),
        "runs": str(runs),
        "explored": str(explored("movingai_sample")),
    }
    request = tmp_path / "request.json"
    request.write_text(
        json.dumps({"metrics": [vars(of) for of in metrics], "papers": [paper]}), encoding="utf-8"
    )

    def ask() -> subprocess.CompletedProcess:
        command = [sys.executable, "-m", "statistics_judge", str(request)]
        return subprocess.run(command, cwd=ROOT / "crosscheck", capture_output=True, text=True, check=False)

    assert ask().returncode == 0, ask().stderr
    verdicts = runs / "verdicts.toml"
    text = verdicts.read_text(encoding="utf-8")
    assert "\nvalue = 1.0\n" in text
    verdicts.write_text(text.replace("\nvalue = 1.0\n", "\nvalue = 0.9\n", 1), encoding="utf-8")
    said = ask()
    assert said.returncode == 3, said.stderr
    assert "1 differ" in said.stdout, said.stdout
    assert "its value is 0.9; recomputed it is 1.0" in said.stdout, said.stdout
