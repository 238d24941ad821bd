"""replan's kept answers to questions about a six-axis arm in a room, and MuJoCo's to the same."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from judge.answers import answer_model
from judge.chapter import Frame, chapter, table
from judge.compare import Outcome, compare_case, promise_broken
from judge.located import Fault

FIXTURES = Path(__file__).parent / "fixtures"
KEPT = FIXTURES / "up6-in-room"
FRAME = Frame("judged", "viewer", "No picture.", [])


@pytest.fixture(scope="module")
def answered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("answered") / "up6-in-room"
    shutil.copytree(KEPT, folder)
    for model in folder.glob("*.xml"):
        answer_model(model)
    return folder


@pytest.fixture
def case(answered: Path, tmp_path: Path) -> Path:
    folder = tmp_path / answered.name
    shutil.copytree(answered, folder)
    return folder


def edit(path: Path, column: str, change: Callable[[np.ndarray], None]) -> None:
    """Change the cells of one column of a table."""
    found = pq.read_table(path)
    cells = found[column].to_numpy().copy()
    change(cells)
    place = found.column_names.index(column)
    pq.write_table(found.set_column(place, column, pa.array(cells)), path)


def flipped(row: int) -> Callable[[np.ndarray], None]:
    """Turn one truth around."""

    def change(cells: np.ndarray) -> None:
        cells[row] = not cells[row]

    return change


def raised(row: int, by: float) -> Callable[[np.ndarray], None]:
    """Add to one number."""

    def change(cells: np.ndarray) -> None:
        cells[row] += by

    return change


def rows_of(case: Path, kind: str) -> list[int]:
    """The rows of one kind of configuration."""
    kinds = pq.read_table(case / "scene.questions.parquet")["kind"].to_pylist()
    return [row for row, found in enumerate(kinds) if found == kind]


def test_both_sides_agree_on_a_robot_that_slides_and_every_error_on_purpose_is_noticed(
    tmp_path: Path,
) -> None:
    folder = tmp_path / "gantry-in-room"
    shutil.copytree(FIXTURES / folder.name, folder)
    for model in folder.glob("*.xml"):
        answer_model(model)
    outcome = compare_case(folder)
    assert outcome.is_agreed, outcome.listed()
    assert [control.is_caught for control in outcome.controls] == [True] * 3
    asked = {(line.question, line.kind): line for line in outcome.lines}
    for kind in ("random", "within 1 mm of contact"):
        assert 0 < (asked["contact", kind].in_contact or 0) < asked["contact", kind].asked, kind
    assert asked["limit", "joint limits"].asked == 24
    assert asked["frame", "paths"].asked > 0
    # A slide that is longer by a tenth of a millimetre is noticed in gaps and frames alike.
    for part, column in (("gaps", "hand|box"), ("frames", "link_3.x")):
        edit(folder / f"replan.{part}.parquet", column, raised(1, 1e-4))
        assert not compare_case(folder).is_agreed, part


def test_both_sides_agree_and_every_error_on_purpose_is_noticed(case: Path) -> None:
    outcome = compare_case(case)
    assert outcome.is_agreed, outcome.listed()
    assert [control.is_caught for control in outcome.controls] == [True] * 3
    # The sample is worth drawing: both outcomes, adversarial and singular poses, pierced obstacles.
    asked = {line.kind: line for line in outcome.lines if line.question == "contact"}
    for kind in ("random", "within 1 mm of contact", "singular"):
        assert 0 < (asked[kind].in_contact or 0) < asked[kind].asked, kind
    assert asked["axis pierces an obstacle"].in_contact == asked["axis pierces an obstacle"].asked
    assert "DIFFER" not in table([outcome])
    text = chapter([outcome], FRAME)
    assert "**MuJoCo agrees with every answer" in text
    assert text.endswith("\nNothing differs.\n")


@pytest.mark.parametrize(
    ("listed", "differ", "file", "column", "change"),
    [
        ("distance of wrist|ball", 1, "scene.gaps", "wrist|ball", raised(2, 2e-6)),
        ("distance of base|finger", 1, "scene.gaps", "base|finger", raised(2, np.nan)),
        ("frame of tool", 1, "scene.frames", "tool.zx", raised(5, 2e-9)),
        ("frame of tool", 1, "replan.frames", "tool.zx", raised(5, 2e-9)),
        ("limit of joint_4", 1, "scene.limits", "joint_4", flipped(7)),
        ("planners of the whole robot", 1, "replan.planners", "free", flipped(3)),
    ],
)
def test_a_wrong_answer_of_either_side_is_listed_with_both_values(
    case: Path, listed: str, differ: int, file: str, column: str, change: Callable[[np.ndarray], None]
) -> None:
    edit(case / f"{file}.parquet", column, change)
    outcome = compare_case(case)
    assert len(outcome.differences) == differ
    assert listed in outcome.differences[0]
    assert ": ours " in outcome.differences[0]
    assert ", MuJoCo " in outcome.differences[0]
    assert table([outcome]).count("DIFFER") == differ
    text = chapter([outcome], FRAME)
    assert f"**MuJoCo DIFFERS: {differ} answers, 0 paths" in text
    assert f"- up6-in-room, {listed}" in text


def test_a_pair_that_one_side_lets_through_is_listed_and_planners_are_held_to_it(case: Path) -> None:
    gaps = pq.read_table(case / "replan.gaps.parquet")
    free = next(
        row for row in rows_of(case, "random") if min(column[row].as_py() for column in gaps.columns) > 0.01
    )
    edit(case / "scene.touch.parquet", "finger|box", flipped(free))
    found = compare_case(case).differences
    assert [item.split(", ")[1] for item in found] == [
        "contact of finger|box",
        "planners of the whole robot",
    ]


@pytest.mark.parametrize(("file", "column"), [("scene.touch", "finger|box"), ("replan.gaps", "finger|box")])
def test_a_path_that_is_not_free_for_either_side_is_named(case: Path, file: str, column: str) -> None:
    row = rows_of(case, "paths")[5]
    edit(case / f"{file}.parquet", column, flipped(row) if file == "scene.touch" else raised(row, -9.0))
    outcome = compare_case(case)
    assert len(outcome.blocked) == 1
    assert outcome.blocked[0].startswith("path `drawn 1` touches finger|box at [")


@pytest.mark.parametrize("promise", ["nothing", "scene", "contact"])
def test_a_promise_is_broken_by_the_contacts_that_it_is_about(promise: str) -> None:
    expected = {"nothing": [False, False], "scene": [True, False], "contact": [True, True]}
    assert [promise_broken(promise, is_outer) for is_outer in (True, False)] == expected[promise]


@pytest.mark.parametrize("who", ["scene.touch", "replan.gaps"])
def test_a_pushed_path_that_one_side_lets_through_fails_the_case(case: Path, who: str) -> None:
    pushed = json.loads((case / "case.json").read_text())["pushed"]
    change = flipped(pushed["row"]) if who == "scene.touch" else raised(pushed["row"], 1.0)
    edit(case / f"{who}.parquet", pushed["pair"], change)
    assert missed(case) == ["path `drawn 1` pushed, " + pushed["pair"].replace("|", " on ")]


def missed(case: Path) -> list[str]:
    """The controls that go unnoticed."""
    outcome: Outcome = compare_case(case)
    assert not outcome.is_agreed
    assert "NOT NOTICED" in table([outcome])
    assert any("control not noticed" in item for item in outcome.listed())
    return [control.what for control in outcome.missed]


@pytest.mark.parametrize(
    ("wrong", "part", "asks"), [("longer_link", "frames", "frames"), ("shifted_obstacle", "touch", None)]
)
def test_an_error_on_purpose_that_goes_unnoticed_fails_the_case(
    case: Path, wrong: str, part: str, asks: str | None
) -> None:
    # MuJoCo answers as if nothing were wrong: for the right model, the rows that were asked.
    questions = pq.read_table(case / "scene.questions.parquet")
    every = np.flatnonzero(questions[asks].to_numpy()) if asks else np.arange(questions.num_rows)
    rows = pq.read_table(case / f"{wrong}.questions.parquet")["row"].to_numpy()
    right = pq.read_table(case / f"scene.{part}.parquet").take(np.searchsorted(every, rows))
    pq.write_table(right, case / f"{wrong}.{part}.parquet")
    told = json.loads((case / "case.json").read_text())
    assert missed(case) == [told["stretched" if asks else "shifted"]]


def test_answers_that_are_missing_or_do_not_fit_are_refused_by_name(case: Path) -> None:
    path = case / "scene.touch.parquet"
    whole, found = path.read_bytes(), pq.read_table(path)
    pq.write_table(found.slice(0, 9), path)
    assert "has 9 rows" in refusal(case)
    pq.write_table(found.drop_columns(["finger|box"]), path)
    assert "no column `finger|box`" in refusal(case)
    path.write_bytes(whole[:200])
    assert "scene.touch.parquet: answers cannot be read" in refusal(case)
    path.unlink()
    assert "scene.touch.parquet: answers cannot be read" in refusal(case)


def refusal(case: Path) -> str:
    """Why the answers are refused, which is no fault of the input."""
    with pytest.raises(Fault) as caught:
        compare_case(case)
    assert caught.value.code == 3
    return str(caught.value)
