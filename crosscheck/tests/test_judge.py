"""The judge on a two-link arm whose answers can be worked out by hand."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pyarrow.parquet as pq
import pytest

from judge.answers import Answers, Questions, answer, answer_model
from judge.model import load
from judge.picture import View, ball_around, draw, name_obstacles, png
from judge.tables import read_questions

FIXTURES = Path(__file__).parent / "fixtures"
MINI = FIXTURES / "mini.xml"
PAIRS = {
    "upper|floor", "upper|box", "upper|ball", "fore|floor", "fore|box", "fore|ball", "base|fore",
}  # fmt: skip


@pytest.fixture(scope="module")
def answers() -> Answers:
    judged = load(MINI)
    q_rad, asked = read_questions(MINI, len(judged.joints))
    return answer(judged, Questions(q_rad, asked["frames"], asked["gaps"], asked["limits"]))


def test_pairs_are_those_of_masks_and_explicit_ones_and_no_part_that_the_scene_cannot_touch() -> None:
    judged = load(MINI)
    assert {pair.name for pair in judged.pairs} == PAIRS
    assert judged.frames == ("link_1", "link_2", "tool")


def test_contact_is_where_the_arm_reaches(answers: Answers) -> None:
    touched = [
        {name for name, column in answers.touch.items() if column[row]}
        for row in range(len(answers.touch["fore|box"]))
    ]
    # Stretched it ends at 0.5 + 0.02, the ball begins at 0.55; upright its fore link pierces the box.
    assert touched[:3] == [set(), set(), {"fore|box"}]


def test_distances_are_those_worked_out_by_hand(answers: Answers) -> None:
    assert answers.gaps["fore|ball"][0] == pytest.approx(0.03, abs=1e-9)
    assert answers.gaps["upper|floor"][0] == pytest.approx(0.48, abs=1e-9)
    # The elbow is at (0, 0.3), the fore link goes on to (0.2, 0.3): 0.1 below the box.
    assert answers.gaps["fore|box"][1] == pytest.approx(0.08, abs=1e-6)
    assert answers.gaps["base|fore"][0] == pytest.approx(np.hypot(0.3, 0.1) - 0.07, abs=1e-9)


def test_frames_are_those_of_the_rows(answers: Answers) -> None:
    assert answers.frames["link_2.x"].tolist() == pytest.approx([0.5, 0.2], abs=1e-12)
    assert answers.frames["link_2.y"].tolist() == pytest.approx([0.0, 0.3], abs=1e-12)
    # The tool's z was twisted from z to -y, 0.1 long.
    assert answers.frames["tool.y"][0] == pytest.approx(-0.1, abs=1e-12)
    assert answers.frames["link_2.yz"][0] == pytest.approx(-1.0, abs=1e-12)


def test_a_joint_is_beyond_its_limit_from_the_limit_on(answers: Answers) -> None:
    assert answers.limits["joint_1"].tolist() == [False, False, True]
    assert answers.limits["joint_2"].tolist() == [False, False, True]


def test_answers_are_written_beside_the_model(tmp_path: Path) -> None:
    folder = tmp_path / "case"
    folder.mkdir()
    for name in ("mini.xml", "mini.questions.parquet"):
        shutil.copy(FIXTURES / name, folder / name)
    assert answer_model(folder / "mini.xml") == "case/mini"
    heights = {
        part: pq.read_table(folder / f"mini.{part}.parquet").num_rows for part in ("touch", "gaps", "limits")
    }
    assert heights == {"touch": 4, "gaps": 2, "limits": 3}


def test_a_capsule_that_pierces_a_mesh_of_eight_vertices_is_in_contact_wherever_it_pierces() -> None:
    judged = load(MINI)
    rows = np.array([[angle, 0.0] for angle in np.linspace(np.pi / 2 - 0.15, np.pi / 2 + 0.15, 301)])
    none = np.zeros(len(rows), dtype=np.bool_)
    touch = answer(judged, Questions(rows, none, none, none)).touch
    assert touch["fore|box"].all()


def test_the_camera_looks_at_the_middle_of_what_is_there() -> None:
    judged = load(MINI)
    mujoco.mj_forward(judged.model, judged.data)
    (x, y, _), radius = ball_around(judged.model, judged.data)
    # From the elbow's ball about (-0.02, ...) to the ball's far side at 0.75; up to the box's corner balls.
    assert -0.2 < x - 0.3 < 0.1
    assert 0.1 < y < 0.4
    assert 0.5 < radius < 1.0


def test_every_obstacle_says_its_name_and_no_name_covers_another() -> None:
    judged = load(MINI)
    mujoco.mj_forward(judged.model, judged.data)
    judged.data.geom_xpos[judged.model.geom("still:ball").id] = judged.data.geom_xpos[
        judged.model.geom("still:box").id
    ]
    scene = mujoco.MjvScene(judged.model, maxgeom=100)
    camera, everything = mujoco.MjvCamera(), int(mujoco.mjtCatBit.mjCAT_ALL)
    mujoco.mjv_defaultFreeCamera(judged.model, camera)
    mujoco.mjv_updateScene(judged.model, judged.data, mujoco.MjvOption(), None, camera, everything, scene)
    name_obstacles(judged.model, judged.data, scene)
    labels = {shape.label: shape.pos for shape in scene.geoms[: scene.ngeom] if shape.label}
    assert set(labels) == {"box", "ball"}
    assert labels["ball"][2] > labels["box"][2] + 0.01


def test_a_png_has_its_size_and_no_clock() -> None:
    pixels = np.zeros((2, 3, 3), dtype=np.uint8)
    assert png(pixels, "a") == png(pixels, "a") != png(pixels, "b")
    assert png(pixels, "a")[16:24] == (3).to_bytes(4, "big") + (2).to_bytes(4, "big")


def test_a_renderer_that_fails_leaves_an_older_picture_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: object) -> None:
        raise RuntimeError("no display")

    monkeypatch.setattr("judge.picture.mujoco.Renderer", failing)
    picture = tmp_path / "scene.png"
    picture.write_bytes(b"older")
    with pytest.raises(RuntimeError, match="no display"):
        draw(MINI, picture, "zero", View(135.0, -25.0, 1.0), "0" * 64)
    assert picture.read_bytes() == b"older"


@pytest.mark.parametrize(
    ("renderer", "key", "complaint"), [("nonsense", "zero", "MUJOCO_GL"), ("disable", "one", "one")]
)
def test_the_command_line_fails_with_the_reason_last_and_without_a_picture(
    tmp_path: Path, renderer: str, key: str, complaint: str
) -> None:
    picture = tmp_path / "scene.png"
    words = [sys.executable, "-m", "judge", "draw", str(MINI), str(picture), "--key", key]
    said = subprocess.run(
        words,
        capture_output=True,
        text=True,
        check=False,
        cwd=FIXTURES.parents[1],
        env={**os.environ, "MUJOCO_GL": renderer},
    )
    assert said.returncode != 0
    # The caller passes on the last line.
    assert complaint in said.stderr.strip().splitlines()[-1]
    assert not picture.exists()
