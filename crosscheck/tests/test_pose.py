"""What is asked about a robot in a scene, read from its files, and what a paper's folder is refused for."""

import shutil
from pathlib import Path

import mujoco
import numpy as np
import pyarrow as pa
import pytest

from judge.gaps import Gaps
from judge.kinematics import continued, determinant, frames, refined, straight_tip, straight_tool
from judge.located import Fault, Written
from judge.mjcf import mjcf
from judge.model import compiled
from judge.paths import PUSH_M, drawn_paths, pushed
from judge.picture import View, png, scene_hash, shown_scene
from judge.pose import pose_case
from judge.questions import LIMIT, NEAR, NEAR_M, NEAREST_M, PIERCING, RANDOM, SINGULAR, block, questions
from judge.report import Shown, picture
from judge.robots import Model
from judge.scenes import SHAPES, read_cell
from judge.specs import Case, Places, Spec
from judge.stored import Stored, obstacle, read_workspace
from judge.tables import angles_of

ROOT = Path(__file__).parents[2]
JUDGED = Places(ROOT / "tests/it/crosscheck", ROOT, ROOT / "data/runs/none")
SIZES = {"random": 200, "random_frames": 20, "random_distances": 10} | {
    "near_contact": 40,
    "singular": 20,
    "piercing": 10,
    "drawn_paths": 2,
}


@pytest.fixture(scope="module")
def up6() -> Case:
    return Spec(JUDGED).case("up6-in-room")


@pytest.fixture(scope="module")
def measured(up6: Case) -> Gaps:
    return Gaps(up6.model)


def beyond(model: Model, q_rad: np.ndarray) -> np.ndarray:
    """How many joints of each configuration are beyond their limits."""
    low, high = np.array([row.limits_rad for row in model.rows]).T
    return ((q_rad < low) | (q_rad > high)).sum(axis=1)


def test_questions_are_what_their_kind_means(measured: Gaps) -> None:
    model = measured.model
    blocks = questions(measured, SIZES, np.random.SeedSequence(11))
    asked = {block["kind"][0].as_py(): angles_of(block, 6) for block in blocks}
    gaps = measured.many(asked[NEAR])
    least = np.array([gaps[:, measured.group(group)].min(axis=1) for group in measured.groups()])
    nearest = np.take_along_axis(least, np.abs(least).argmin(axis=0)[None], axis=0)[0]
    assert ((np.abs(nearest) > NEAREST_M / 2) & (np.abs(nearest) < NEAR_M * 1.001)).all()
    assert (nearest < 0).sum() >= 10 <= (nearest > 0).sum()
    free = [measured.is_free(q_rad) for q_rad in asked[NEAR]]
    assert free == (gaps.min(axis=1) > 0).tolist()
    assert len(asked[SINGULAR]) == 20
    assert (np.abs(determinant(model, asked[SINGULAR])) < 1e-9).all()
    assert (np.abs(determinant(model, asked[RANDOM])) > 1e-3).sum() > 100
    assert len(asked[PIERCING]) >= 2
    assert measured.pierced(asked[PIERCING]).all()
    assert beyond(model, asked[LIMIT]).tolist().count(1) == 24
    assert not beyond(model, asked[RANDOM]).any()
    again = questions(measured, SIZES, np.random.SeedSequence(11))
    assert all(one.equals(other) for one, other in zip(blocks, again, strict=True))


def test_frames_worked_out_from_rows_are_those_of_mujoco(up6: Case) -> None:
    judged = compiled(mujoco.MjModel.from_xml_string(mjcf(up6.model, {})))
    for q_rad in np.random.default_rng(3).uniform(-2, 2, (20, 6)):
        judged.data.qpos[:] = q_rad
        mujoco.mj_kinematics(judged.model, judged.data)
        ours = frames(up6.model, q_rad[None])[0, 1:]
        for frame, name in zip(ours, judged.frames, strict=True):
            assert frame[:3, 3] == pytest.approx(judged.data.body(name).xpos, abs=1e-12)
            assert frame[:3, :3].ravel() == pytest.approx(judged.data.body(name).xmat, abs=1e-12)


def test_a_stored_path_is_followed_on_the_straight_line_of_the_tool(
    up6: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    stops = np.array([[0.1, -0.9, 0.2, -0.1, 0.8, 0.0], [0.12, -0.91, 0.21, -0.08, 0.79, 0.02]])
    finer = refined(up6.model, "tool", stops, 4, "p")
    assert finer.shape == (5, 6)
    tool = frames(up6.model, finer)[:, -1]
    line = tool[0, :3, 3] + np.linspace(0, 1, 5)[:, None] * (tool[-1, :3, 3] - tool[0, :3, 3])
    assert np.abs(tool[:, :3, 3] - line).max() < 1e-9
    assert np.abs(finer - np.linspace(stops[0], stops[1], 5)).max() < 1e-3
    turned = [tool[step + 1, :3, :3] @ tool[step, :3, :3].T for step in range(4)]
    assert all(np.abs(turn - turned[0]).max() < 1e-8 for turn in turned)
    # Outwards the arm soon ends, and no posture is made up.
    assert np.isnan(straight_tool(up6.model, stops[:1], stops[1:], 60.0)).all()
    monkeypatch.setattr("judge.kinematics.straight_tool", lambda *_: np.full((1, 6), np.nan))
    with pytest.raises(Fault, match="step 1 of path `p` cannot be followed"):
        refined(up6.model, "tool", stops, 4, "p")


def test_a_planar_tip_goes_straight_and_the_elbow_stays_on_its_side() -> None:
    planar = ROOT / "experiments/planar"
    model, straight = read_workspace(planar, {"study": "tip_line", "problems": "case 1 tip line"}, "arm")
    assert (straight, len(model.stills), model.rows[0].a_m) == ("tip", 4, 0.3)
    start, end = np.array([[0.3, -0.9]]), np.array([[0.35 + 2 * np.pi, -0.8]])
    middle = straight_tip(model, start, end, 0.5)
    tips = frames(model, np.vstack([start, middle, end]))[:, -1, :3, 3]
    assert tips[1] == pytest.approx((tips[0] + tips[2]) / 2, abs=1e-12)
    assert middle[0, 1] < 0
    assert continued(start, end) == pytest.approx(np.array([[0.35, -0.8]]))


def test_a_free_path_that_is_pushed_meets_an_obstacle_and_one_in_contact_is_not_pushed(
    measured: Gaps,
) -> None:
    paths = drawn_paths(measured, 4, np.random.SeedSequence(5))
    assert len(paths) == 4
    assert all(measured.is_free(q_rad) for path in paths for q_rad in path.stops_rad)
    met = [(path, found) for path in paths if (found := pushed(measured, path))]
    assert len(met) >= 2
    for path, found in met:
        assert measured.pairs[found.pair].still is not None
        assert measured.of(found.path.stops_rad[found.stop], [found.pair])[0] <= -PUSH_M / 2
        assert measured.of(path.stops_rad[found.stop], [found.pair])[0] > 0
        assert pushed(measured, found.path) is None


def test_errors_on_purpose_change_what_they_name_and_nothing_else(measured: Gaps) -> None:
    model = measured.model
    assert model.stretched(1e-3).rows[1].a_m == pytest.approx(0.571)
    still = next(index for index, still in enumerate(model.stills) if still.name == "box")
    q_rad, by_m = np.array([0.3, -0.8, 0.1, 0.2, 0.7, 0.0]), np.array([0.0, 0.005, 0.0])
    every = range(len(measured.pairs))
    moved = measured.of(q_rad, every, (still, by_m))
    assert moved == pytest.approx(Gaps(model.shifted(still, by_m)).of(q_rad, every), abs=1e-7)
    changed = np.abs(moved - measured.of(q_rad, every)) > 1e-9
    assert (changed == (measured.stills == still)).all()


def test_a_scene_is_read_with_what_is_under_the_arm() -> None:
    base, stills = read_cell(JUDGED.folder / "room.toml")
    assert base[:3, 3].tolist() == [0.0, 0.0, 0.0]
    assert [still.name for still in stills] == ["floor", "box", "ball", "post", "wedge"]
    assert stills[0].points_m[0].tolist() == [0.0, 0.0, -0.1]
    # Sides of 300, 400 and 400 mm, turned by 20 degrees.
    corners = stills[1].points_m
    assert np.ptp(corners[:, 0]) == pytest.approx(0.3 * np.cos(0.349066) + 0.4 * np.sin(0.349066), abs=1e-6)


@pytest.mark.parametrize(
    ("entry", "volume"),
    [
        ({"shape": "box", "center": [1, 2, 3], "size": [2, 3, 4]}, 24.0),
        ({"shape": "octahedron", "center": [0, 0, 0], "radius": 3}, 36.0),
        ({"shape": "wedge", "center": [0, 1, 0], "size": [2, 3, 4]}, 12.0),
        ({"shape": "pyramid", "base_center": [0, 0, 1], "side": 3, "height": 2}, 6.0),
        (
            {
                "shape": "prism",
                "axis": "x",
                "center": [0, 0, 0],
                "radius": 2,
                "height": 5,
                "sides": 4,
                "turn_rad": 0.3,
            },
            40.0,
        ),
        (
            {
                "shape": "planes",
                "planes": [
                    {"normal": [2 * sign * (axis == way) for axis in range(3)], "offset": 2.0}
                    for way in range(3)
                    for sign in (1, -1)
                ],
            },
            8.0,
        ),
    ],
)
def test_a_shape_has_its_volume(entry: dict, volume: float) -> None:
    from scipy.spatial import ConvexHull

    assert ConvexHull(SHAPES[entry["shape"]](entry)).volume == pytest.approx(volume)


def test_a_square_in_the_plane_has_sides_of_the_diameter_along_the_axes() -> None:
    corners = obstacle("o", "square", np.array([10.0, 20.0]), 5.0).points_m
    assert (np.ptp(corners, axis=0) == pytest.approx([0.1, 0.1, 0.1])) and corners[
        :, 0
    ].min() == pytest.approx(0.05)


def test_a_model_is_written_with_the_numbers_of_its_files(up6: Case) -> None:
    text = mjcf(up6.model, {"zero": np.zeros(6)})
    for part in (
        '<body name="link_3" pos="0.13 0.0 0.0" axisangle="1 0 0 -1.5707963267948966">',
        '<joint name="joint_5" axis="0 0 1" range="-2.356194490192345 2.356194490192345"/>',
        '<geom name="part:turret" type="capsule" fromto="-0.15 0.0 0.0 0.0 0.0 0.0" size="0.14" contype="0"',
        '<pair geom1="part:elbow" geom2="part:base" margin="0" gap="0"/>',
        '<key name="zero" qpos="0.0 0.0 0.0 0.0 0.0 0.0"/>',
    ):
        assert part in text, part


@pytest.fixture
def paper(tmp_path: Path) -> Places:
    folder = tmp_path / "judged"
    shutil.copytree(JUDGED.folder, folder, ignore=shutil.ignore_patterns("urdf"))
    return Places(folder, ROOT, JUDGED.runs)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("singular = 5", "single = 5", ":13:1: unknown key `single`; accepted: drawn_paths"),
        ("singular = 5", "", ":8:1: missing key `singular`"),
        ("singular = 5", 'singular = "five"', ':13:1: `singular` is "five"; accepted: integer'),
        ("singular = 5", "singular = -5", ":13:1: `singular` is -5; accepted: 0 to 1000000"),
        ('straight = "tool"', 'straight = "arm"', ':28:1: `straight` is "arm"; accepted: "tool", "joints"'),
        (
            'file = "room.toml"',
            'file = "hall.toml"',
            ":32:1: input file `hall.toml` does not exist; looked for",
        ),
        (
            'key = "zero"',
            'key = "one"',
            ":19:1: there is no keyframe `one`; case `up6-in-room` has zero, path 1",
        ),
        ("seed = 7", "seed 7", "crosscheck.toml: "),
    ],
)
def test_a_faulty_spec_is_refused_at_its_line(
    paper: Places, tmp_path: Path, old: str, new: str, message: str
) -> None:
    spec = paper.folder / "crosscheck.toml"
    spec.write_text(spec.read_text().replace(old, new))
    with pytest.raises(Fault) as caught:
        pose_case(paper, "up6-in-room", tmp_path)
    assert f"{spec.parent}/crosscheck.toml" in str(caught.value)
    assert message in str(caught.value)
    assert caught.value.code == 2


def test_keys_in_lists_of_tables_have_their_place(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text("[[a]]\nb = 1\n[[a.c]]\nd = 2\n[[a]]\n[[a.c]]\n  d = { e = 3 }\n")
    written = Written(path)
    assert written.place(("a", 0, "c", 0, "d")) == (4, 1)
    assert written.place(("a", 1, "c", 0, "d", "e")) == (7, 3)


def test_a_picture_of_an_unchanged_scene_stays_and_another_is_drawn_again(
    paper: Places, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pose_case(paper, "up6-in-room", tmp_path)
    shown, drawn = Shown(tmp_path, tmp_path, is_check=False), []

    def draw(model: Path, to: Path, key: str, view: View, scene: str) -> bool:
        drawn.append(key)
        to.write_bytes(png(np.zeros((2, 2, 3), dtype=np.uint8), scene))
        return True

    monkeypatch.setattr("judge.report.is_drawn", draw)
    model = tmp_path / "up6-in-room/scene.xml"
    for _ in range(2):
        assert picture(Spec(paper), shown, model).startswith("![")
    assert drawn == ["zero"]
    before = shown_scene(tmp_path / "scene_mujoco.png")
    assert before == scene_hash(model, [0.0] * 6, View(150.0, -25.0, 1.0))
    model.write_text(model.read_text().replace('fromto="-0.15 ', 'fromto="-0.16 '))
    picture(Spec(paper), shown, model)
    assert drawn == ["zero", "zero"]
    assert shown_scene(tmp_path / "scene_mujoco.png") != before


def test_a_picture_that_cannot_be_drawn_is_not_passed_off_as_a_new_one(
    paper: Places, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pose_case(paper, "up6-in-room", tmp_path)
    monkeypatch.setattr("judge.report.is_drawn", lambda *_: False)
    shown, model = Shown(tmp_path, tmp_path, is_check=False), tmp_path / "up6-in-room/scene.xml"
    assert picture(Spec(paper), shown, model).startswith("No picture: it could not be drawn")
    (tmp_path / "scene_mujoco.png").write_bytes(b"older")
    assert "\n\nThe picture is of an earlier run: it could not be drawn" in picture(Spec(paper), shown, model)
    assert (tmp_path / "scene_mujoco.png").read_bytes() == b"older"


def test_a_stored_step_that_stands_still_is_left_out(up6: Case) -> None:
    path = Stored("p", np.array([[0.0] * 6, [0.0] * 6, [0.1] * 6]))
    assert len(refined(up6.model, "joints", path.stops_rad, 4, path.name)) == 5


def test_a_kind_of_which_nothing_is_found_goes_with_the_others() -> None:
    none, some = block("none", np.empty((0, 6))), block("some", np.zeros((1, 6)))
    assert pa.concat_tables([none, some]).num_rows == 1
