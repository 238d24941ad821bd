"""Problems out of an archive (.tar) of MoveIt's scenes and requests, as a study of family `joint_problems` poses them.

`DIR/scene0001.yaml` and `DIR/request0001.yaml` are one problem; folders and numbers are taken in order. Lengths are
metres, quaternions x, y, z, w.

Source: the message definitions `PlanningScene` and `MotionPlanRequest` of `moveit_msgs`.
"""

import re
import tarfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from scipy.spatial.transform import Rotation

from judge.kinematics import continued
from judge.located import Fault, Stale
from judge.robots import Model, Numbers
from judge.scenes import Still, box, support
from judge.stored import Stored
from judge.urdf import Chain, framed, parsed

SIDES = 24
"""Sides of the prism around a cylinder."""
MEMBER = re.compile(r"(?:(.*)/)?(scene|request)([^/]*)\.ya?ml")
OBJECT = {"id", "pose", "primitives", "primitive_poses", "operation", "type", "header"}
"""What an object of a scene may have."""

Problem = tuple[str, dict[str, Any], dict[str, Any]]
"""The name of a problem's folder, its scene and its request."""


def read_problem(path: Path, begins: str, index: int) -> Problem:
    """The problem of this number among the folders of an archive whose names begin so."""
    if path.suffix != ".tar":
        raise Fault(f"{path}: problems are judged out of an archive; accepted: a file that ends with .tar")
    with tarfile.open(path) as archive:
        found: dict[tuple[str, str], dict[str, tarfile.TarInfo]] = {}
        for member in archive:
            match = MEMBER.fullmatch(member.name)
            if match and (match[1] or "").rsplit("/", 1)[-1].startswith(begins):
                found.setdefault((match[1] or "", match[3]), {})[match[2]] = member
        folder, number = sorted(found)[index]
        parts = [archive.extractfile(found[folder, number][part]) for part in ("scene", "request")]
        scene, request = (yaml.load(part, yaml.CSafeLoader) for part in parts if part is not None)
    return folder.rsplit("/", 1)[-1], scene, request


def around(settings: dict[str, Any], problem: Problem, robot: str) -> tuple[Still, ...]:
    """What stands around a robot in a problem, with numbers after its names: those of objects need not differ."""
    folder, scene, _ = problem
    named = settings.get("robot_name", robot)
    if plain(scene["robot_model_name"]) != plain(named):
        raise Fault(f"the scene is of the robot `{scene['robot_model_name']}`; `{named}` is accepted")
    are_closed = settings.get("cylinders", "prisms") == "capsules"
    are_boxes = are_closed and "boxes_in" in settings and folder.startswith(settings["boxes_in"])
    _, floor, block = support(settings["support"])
    stills = floor + block
    for thing in scene["world"]["collision_objects"]:
        if unread := [key for key, value in thing.items() if key not in OBJECT and value]:
            raise Fault(f"object `{thing['id']}` has `{unread[0]}`, which is not read; primitives are accepted")
        at = pose(thing.get("pose", {}))
        for form, place in zip(thing["primitives"], thing["primitive_poses"], strict=True):
            stills += solids(str(thing["id"]), form, at @ pose(place), closed=are_closed, boxed=are_boxes)
    return tuple(
        Still(f"{still.name} {number}", still.shape, still.points_m, still.radius_m)
        for number, still in enumerate(stills, 1)
    )


def plain(name: str) -> str:
    """A robot's name without what files write differently."""
    return name.replace("_", "").replace("-", "").lower()


def pose(entry: dict[str, Any]) -> Numbers:
    """A pose as a frame."""
    turn = Rotation.from_quat(numbers(entry.get("orientation", (0, 0, 0, 1)))).as_matrix()
    return framed(numbers(entry.get("position", (0, 0, 0))), turn)


def numbers(values: Any) -> Numbers:  # noqa: ANN401
    """Numbers; YAML takes `1e-5` for a word."""
    return np.array([float(value) for value in values])


def solids(name: str, form: dict[str, Any], at: Numbers, *, closed: bool, boxed: bool) -> Iterator[Still]:
    """What stands for a primitive: for a cylinder a prism, with a ball at each end if it is closed, or a box."""
    sizes, (turn, middle) = numbers(form["dimensions"]), (at[:3, :3], at[:3, 3])
    if form["type"] == "sphere":
        yield Still(name, "sphere", middle[None], sizes[0])
    elif form["type"] == "box":
        yield Still(name, "mesh", box(middle, sizes, turn))
    elif form["type"] == "cylinder" and boxed:
        yield Still(name, "mesh", box(middle, np.array([2 * sizes[1], 2 * sizes[1], sizes[0]]), turn))
    elif form["type"] == "cylinder":
        length, radius = sizes
        angles, wide = 2 * np.pi * np.arange(SIDES) / SIDES, radius / np.cos(np.pi / SIDES)
        ends = middle + np.outer([-0.5, 0.5], length * turn[:, 2])
        rim = wide * np.stack([np.cos(angles), np.sin(angles)], axis=1) @ turn[:, :2].T
        yield Still(name, "mesh", (ends[:, None] + rim).reshape(-1, 3))
        if closed:
            yield from (Still(name, "sphere", end[None], radius) for end in ends)
    else:
        raise Fault(f"object `{name}` is a {form['type']}; box, cylinder and sphere are accepted")


def stepped(model: Model, path: Stored, step: float) -> Stored:
    """The path with a stop wherever the joint that moves most has gone one more step."""
    is_endless = [row.is_endless for row in model.rows]
    stops = [path.stops_rad[:1]]
    for start, end in zip(path.stops_rad, path.stops_rad[1:], strict=False):
        way = np.where(is_endless, continued(start, end), end) - start
        parts = max(1, int(np.ceil(np.abs(way).max() / step)))
        stops += [start + way * np.arange(1, parts)[:, None] / parts, end[None]]
    return Stored(path.name, np.vstack(stops), path.instance)


def check_ends(model: Model, robot: Path, problem: Problem, path: Stored) -> None:
    """Refuse a path that does not lead from the request's start to its first goal."""
    request = problem[2]
    start, goal = request["start_state"]["joint_state"], request["goal_constraints"][0]["joint_constraints"]
    ends = [
        dict(zip(start["name"], start["position"], strict=True)),
        {joint["joint_name"]: joint["position"] for joint in goal},
    ]
    names = [joint.name for joint in Chain(robot, parsed(robot)).joints]
    is_endless = [row.is_endless for row in model.rows]
    for end, stop in zip(ends, path.stops_rad[[0, -1]], strict=True):
        asked = numbers(end[name] for name in names)
        asked = np.where(is_endless, continued(stop, asked), asked)
        if np.abs(asked - stop).max() > 1e-9:
            raise Stale(f"path `{path.name}` ends at {stop.tolist()}; the request has {asked.tolist()}")
