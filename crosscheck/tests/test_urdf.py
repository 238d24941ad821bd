"""URDF robots with their SRDF files: frames are those of MuJoCo's own reader, and pairs those that the file leaves."""

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest

from judge.answers import Questions, answer
from judge.gaps import Gaps
from judge.kinematics import between, frames, jacobian
from judge.located import Fault
from judge.mjcf import mjcf
from judge.model import compiled
from judge.paths import drawn_paths, pushed
from judge.questions import at_limits
from judge.robots import Model
from judge.scenes import Still
from judge.specs import Places, Spec
from judge.urdf import read_urdf

ROOT = Path(__file__).parents[2]
UR5 = ROOT / "data/robots/ur5.urdf"
SRDF = """<robot name="ur5"><group name="arm"/>
<disable_collisions link1="shoulder" link2="base" reason="Adjacent"/>
<disable_collisions link1="upper_arm" link2="forearm"/></robot>"""
LINKS = ("base", "shoulder", "upper_arm", "forearm", "forearm 2", "forearm 3", "wrist_1", "wrist_2")


def ur5(folder: Path, urdf: str = "", srdf: str = SRDF) -> Model:
    """The robot of a changed URDF file, or of the one that is shipped."""
    paths = folder / "ur5.urdf", folder / "ur5.srdf"
    paths[0].write_text(urdf or UR5.read_text())
    paths[1].write_text(srdf)
    return read_urdf(*paths, "ur5", np.eye(4), ())


@pytest.mark.parametrize("name", ["ur5", "lift"])
def test_frames_are_those_of_mujocos_own_reader_of_urdf(tmp_path: Path, name: str) -> None:
    stored = json.loads((ROOT / f"tests/it/crosscheck/urdf/{name}.json").read_text())
    (tmp_path / "any.srdf").write_text(f'<robot name="{name}"/>')
    folder = "data/robots" if name == "ur5" else "tests/it/crosscheck/urdf"
    model = read_urdf(ROOT / folder / f"{name}.urdf", tmp_path / "any.srdf", name, np.eye(4), ())
    tools = frames(model, np.array(stored["angles_rad"]))[:, -1]
    found = np.concatenate([tools[:, :3, 3], tools[:, :3, :3].reshape(-1, 9)], axis=1)
    assert np.abs(found - np.array(stored["frames"])).max() < 1e-12


def test_pairs_are_all_of_different_links_but_those_of_the_srdf_file(tmp_path: Path) -> None:
    model = ur5(tmp_path)
    judged = compiled(mujoco.MjModel.from_xml_string(mjcf(model, {})))
    found = {tuple(pair.name.split("|")) for pair in judged.pairs}
    owner = {name: name.split(" ")[0] for name in LINKS}
    pairs = {(a, b) for a in LINKS for b in LINKS if a < b and owner[a] != owner[b]}
    may = {
        ("base", "shoulder"),
        ("forearm", "upper_arm"),
        ("forearm 2", "upper_arm"),
        ("forearm 3", "upper_arm"),
    }
    assert found == pairs - may
    assert not model.parts[0].exposed


def test_a_joint_that_turns_without_end_has_no_limit_and_takes_the_shorter_way_round(tmp_path: Path) -> None:
    text = UR5.read_text().replace('joint_1" type="revolute"', 'joint_1" type="continuous"')
    model = ur5(tmp_path, text)
    judged = mujoco.MjModel.from_xml_string(mjcf(model, {}))
    assert judged.jnt_limited.tolist() == [0, 1, 1, 1, 1, 1]
    start, end = np.full((1, 6), 3.0), np.full((1, 6), -3.0)
    middle = between(model, "joints", start, end, 0.5)
    assert middle[0] == pytest.approx([np.pi, 0, 0, 0, 0, 0])


SLIDE = """<robot name="slide"><link name="base"/><link name="ball"><collision><geometry><sphere radius="0.1"/>
</geometry></collision></link><joint name="rail" type="prismatic"><parent link="base"/><child link="ball"/>
<origin xyz="0.2 0 0"/><axis xyz="2 0 0"/><limit lower="-0.3" upper="0.6"/></joint></robot>"""


def slide(folder: Path) -> Model:
    """A ball on a rail along x, with another ball in its way."""
    paths = folder / "slide.urdf", folder / "slide.srdf"
    paths[0].write_text(SLIDE)
    paths[1].write_text('<robot name="slide"/>')
    return read_urdf(*paths, "slide", np.eye(4), (Still("ball", "sphere", np.array([[1.0, 0.0, 0.0]]), 0.2),))


def test_a_joint_that_slides_has_its_limits_and_gaps_in_metres(tmp_path: Path) -> None:
    model = slide(tmp_path)
    judged = compiled(mujoco.MjModel.from_xml_string(mjcf(model, {})))
    places = np.array([[-0.3 - 1e-9], [-0.3 + 1e-9], [0.5 - 1e-6], [0.5 + 1e-6], [0.6 - 1e-9], [0.6 + 1e-9]])
    every = np.ones(len(places), dtype=np.bool_)
    found = answer(judged, Questions(places, every, every, every))
    assert found.limits["joint_1"].tolist() == [True, False, False, False, False, True]
    assert found.touch["ball|ball"].tolist() == [False, False, False, True, True, True]
    assert found.gaps["ball|ball"][1] == pytest.approx(0.8, abs=1e-8)
    assert found.frames["tool.x"] == pytest.approx(0.2 + places[:, 0], abs=1e-12)
    assert Gaps(model).of(places[4], [0])[0] == pytest.approx(-0.1, abs=1e-6)
    rows = at_limits(model, np.random.default_rng(1))
    assert rows[:, 0] == pytest.approx([-0.3, -0.3, -0.4, 0.6, 0.6, 0.7], abs=1e-8)


def test_a_path_of_a_joint_that_slides_goes_straight_and_can_be_pushed_into_what_stands_there(
    tmp_path: Path,
) -> None:
    model = slide(tmp_path)
    assert between(model, "joints", np.array([[-0.2]]), np.array([[0.4]]), 0.5)[0] == pytest.approx([0.1])
    assert jacobian(model, frames(model, np.zeros((1, 1))), 1)[0, :, 0] == pytest.approx([1, 0, 0, 0, 0, 0])
    measured = Gaps(model)
    paths = drawn_paths(measured, 2, np.random.SeedSequence(5))
    assert len(paths) == 2
    assert max(path.stops_rad.max() for path in paths) < 0.5
    moved = pushed(measured, paths[0])
    assert moved is not None
    assert moved.path.stops_rad.max() > 0.5


@pytest.mark.parametrize(
    ("urdf", "srdf", "message"),
    [
        (('name="ur5"', 'name="ur9"'), ("", ""), "the file is of the robot `ur5`; `ur9` is accepted"),
        (("", ""), ("disable_coll", "enable_coll"), "`enable_collisions` is not read"),
        (("", ""), ("</robot>", ""), "ur5.srdf: no element found"),
        (
            ('6" type="revolute"', '6" type="planar"'),
            ("", ""),
            "`joint_6` is planar; revolute, continuous, prismatic",
        ),
        (('type="revolute"', 'type="fixed"'), ("", ""), "no joint moves"),
        (
            ("<limit lower", '<mimic joint="joint_2"/><limit lower'),
            ("", ""),
            "`joint_1` follows another by `mimic`",
        ),
        (('<cylinder radius="0.075"', "<mesh"), ("", ""), "the solid `base` is a mesh"),
    ],
)
def test_what_is_not_judged_is_refused_by_name(
    tmp_path: Path, urdf: tuple[str, str], srdf: tuple[str, str], message: str
) -> None:
    with pytest.raises(Fault, match=message):
        ur5(tmp_path, UR5.read_text().replace(*urdf), SRDF.replace(*srdf))


def test_a_spec_names_the_srdf_file_of_a_urdf_robot(tmp_path: Path) -> None:
    spec = (ROOT / "tests/it/crosscheck/crosscheck.toml").read_text()
    urdf = spec.replace("motoman_up6.toml", "ur5.urdf").replace('body = "capsules"', 'body = "urdf"')
    (tmp_path / "room.toml").write_text((ROOT / "tests/it/crosscheck/room.toml").read_text())
    (tmp_path / "ur5.srdf").write_text(SRDF)
    (tmp_path / "crosscheck.toml").write_text(urdf)
    places = Places(tmp_path, ROOT, tmp_path)
    with pytest.raises(Fault, match="a URDF robot is judged with `srdf` and the body `urdf`"):
        Spec(places).case("up6-in-room")
    (tmp_path / "crosscheck.toml").write_text(
        urdf.replace('straight = "tool"', 'straight = "tool"\nsrdf = "ur5.srdf"')
    )
    model = Spec(places).case("up6-in-room").model
    assert "base|shoulder" not in model.pair_names()
    assert "base|forearm" in model.pair_names()
