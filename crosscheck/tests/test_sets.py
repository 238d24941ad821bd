"""Problems of a set: what stands around the robot, the path that is asked about, and what is refused."""

import shutil
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from judge.answers import answer_model
from judge.chapter import Frame, chapter
from judge.compare import compare_all
from judge.located import Fault, Stale
from judge.report import samples
from judge.sets import read_problem, solids
from judge.specs import Places, Spec

ROOT = Path(__file__).parents[2]
SET = ROOT / "tests/it/crosscheck/set"
FIXTURES = Path(__file__).parent / "fixtures"
FOLDED = np.array([[1.1, 0.0], [1.1, 2.0], [-1.1, 2.0], [-1.1, 0.0]])
"""A path of the problem in folder `box_nod`, which comes first."""


def runs(folder: Path, start: float = 1.1, status: str = "solved") -> Places:
    """The set's folder, with a path of each problem as a run stores it."""
    keys = {"group": ["nods"] * 2, "instance": [0, 1], "query": [None] * 2, "repeat": [0, 0]}
    values = [FOLDED.copy(), FOLDED * 12 / 11]
    values[0][0, 0] = start
    paths = {"name": ["path"] * 2, "width": [2, 2], "values": [path.ravel().tolist() for path in values]}
    pq.write_table(pa.table(keys | paths), folder / "nod.traces.parquet")
    pq.write_table(pa.table(keys | {"status": [status] * 2}), folder / "nod.trials.parquet")
    return Places(SET, ROOT, folder, folder)


def test_a_case_is_the_robot_among_the_obstacles_of_the_problem_of_its_path(tmp_path: Path) -> None:
    spec = Spec(runs(tmp_path))
    assert spec.names() == ["nod-1", "nod-2"]
    boxed, closed = map(spec.case, spec.names())
    shapes = [(still.name, still.shape) for still in boxed.model.stills]
    assert shapes == [("floor 1", "plane"), ("ball 2", "sphere"), ("shelf 3", "mesh"), ("shelf 4", "mesh")]
    shapes = [(still.name, still.shape) for still in closed.model.stills[2:]]
    assert shapes == [
        ("shelf 3", "mesh"),
        ("shelf 4", "sphere"),
        ("shelf 5", "sphere"),
        ("shelf 6", "mesh"),
    ]
    # The shelf's z lies along x: its cylinder reaches from 0.2 to 0.6.
    assert [still.points_m[0].tolist() for still in closed.model.stills[3:5]] == [
        pytest.approx([0.2, 0.1, 1.75]),
        pytest.approx([0.6, 0.1, 1.75]),
    ]
    box, prism, wall = (still.points_m for still in (boxed.model.stills[2], *closed.model.stills[2::3][:2]))
    assert (box.min(axis=0), box.max(axis=0)) == (
        pytest.approx([0.2, 0, 1.65]),
        pytest.approx([0.6, 0.2, 1.85]),
    )
    off = np.linalg.norm(prism[:, 1:] - [0.1, 1.75], axis=1)
    assert (len(off), off) == (48, pytest.approx(np.full(48, 0.1 / np.cos(np.pi / 24))))
    assert wall.mean(axis=0) == pytest.approx([0.9, 0.1, 1.85])
    (path,) = boxed.paths
    assert (path.name, path.instance, len(path.stops_rad)) == ("nods/0/0", 0, 58 + 64 + 58 + 1)
    assert np.abs(np.diff(path.stops_rad, axis=0)).max() <= np.deg2rad(2) + 1e-12


def test_what_is_no_path_of_the_stored_problem_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Stale, match=r"path `nods/0/0` ends at \[1.2, 0.0\]; the request has \[1.1, 0.0\]"):
        Spec(runs(tmp_path, start=1.2)).case("nod-1")
    with pytest.raises(Stale, match="kept no trace `path` of a solved trial of problems `nods`"):
        Spec(runs(tmp_path, status="rejected")).case("nod-1")


@pytest.mark.parametrize(
    ("written", "changed", "message"),
    [
        ('family = "joint_problems"', 'family = "joint_queries"', "accepted: joint_problems"),
        ('"srdf"\nstep', '"all"\nstep', "`self_contact` is `all` there; accepted: srdf"),
        ("Nodding_Arm", "Panda", "the scene is of the robot `nodding-arm`; `Panda` is accepted"),
        ('problems = "set.tar"', 'problems = "nod.srdf"', "accepted: a file that ends with .tar"),
        ('problems = "set.tar"', 'problems = "gone.tar"', "input file `gone.tar` does not exist"),
    ],
)
def test_a_set_that_is_not_judged_is_refused(
    tmp_path: Path, written: str, changed: str, message: str
) -> None:
    folder = tmp_path / "set"
    shutil.copytree(SET, folder)
    study = (folder / "nod.toml").read_text()
    assert written in study
    (folder / "nod.toml").write_text(study.replace(written, changed))
    with pytest.raises(Fault, match=message):
        Spec(Places(folder, ROOT, tmp_path, runs(tmp_path).again)).case("nod-1")


def test_problems_are_numbered_among_the_folders_whose_names_begin_so() -> None:
    assert [read_problem(SET / "set.tar", "", index)[0] for index in (0, 1)] == ["box_nod", "can_nod"]
    assert read_problem(SET / "set.tar", "can", 0)[0] == "can_nod"


def test_a_primitive_of_another_kind_is_refused() -> None:
    with pytest.raises(Fault, match="object `roof` is a cone; box, cylinder and sphere are accepted"):
        list(solids("roof", {"type": "cone", "dimensions": [1, 1]}, np.eye(4), closed=False, boxed=False))


def test_both_sides_agree_on_a_sample_which_is_one_row_of_the_chapter(tmp_path: Path) -> None:
    folders = []
    for name in ("nod-1", "nod-2"):
        folders.append(tmp_path / name)
        shutil.copytree(FIXTURES / name, folders[-1])
        for model in folders[-1].glob("*.xml"):
            answer_model(model)
    (outcome,) = compare_all(folders)
    assert outcome.is_agreed, outcome.listed()
    assert [control.is_caught for control in outcome.controls] == [True] * 3
    assert [control.listed for control in outcome.controls][2] == 2
    asked = {(line.question, line.kind): line for line in outcome.lines}
    assert asked["planners", "random"].asked == 40
    assert 0 < (asked["planners", "random"].in_contact or 0) < 40
    assert asked["contact", "paths"].in_contact == 0 < asked["contact", "paths"].asked
    # Of a pushed path only what was pushed is asked about again.
    assert (asked["contact", "pushed path"].asked, asked["contact", "pushed path"].in_contact) == (50, 14)
    notes = samples(Spec(runs(tmp_path)))
    text = chapter([outcome], Frame("set", "viewer", "No picture.", notes))
    assert "drawn by the seed 8: nod 2 of 2." in text
    assert "2 cases (a robot in a scene)" in text
    assert "| nod | 2 |" in text
    # What one problem's answers differ in stands in the row of the set.
    frame = pq.read_table(folders[1] / "replan.gaps.parquet")
    place = frame.column_names.index("upper|ball 2")
    moved = frame.set_column(place, "upper|ball 2", pa.array(frame["upper|ball 2"].to_numpy() - 1.0))
    pq.write_table(moved, folders[1] / "replan.gaps.parquet")
    (outcome,) = compare_all(folders)
    assert not outcome.is_agreed
    assert any(difference.startswith("nod-2, contact of upper|ball 2") for difference in outcome.differences)
