"""Problems of MotionBenchMaker as text for main.cc, as VAMP's problem_tar_to_pkl_json.py and problem_dict_to_vamp take them.

The arguments are the archive and the names of the joints. Cylinders are capsules, but boxes in the set `box`. Needs numpy and PyYAML.
"""

import math
import re
import sys
import tarfile
from typing import Any

import numpy as np
import yaml

LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def pose(given: dict[str, Any]) -> np.ndarray:
    """The matrix of a position and a quaternion."""
    quaternion = np.array(given.get("orientation", [0, 0, 0, 1]), dtype=float)
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = given["position"]
    return matrix


def angles(matrix: np.ndarray) -> list[float]:
    """The turns about the fixed axes x, y and z."""
    across = math.hypot(matrix[0, 0], matrix[1, 0])
    pitch = math.atan2(-matrix[2, 0], across)
    if across > 4 * np.finfo(float).eps:
        return [math.atan2(matrix[2, 1], matrix[2, 2]), pitch, math.atan2(matrix[1, 0], matrix[0, 0])]
    return [math.atan2(-matrix[1, 2], matrix[1, 1]), pitch, 0.0]


def solid(given: dict[str, Any], folder: str) -> list[Any]:
    """An obstacle as a line: its kind, place, turns and sizes."""
    base = pose(given["pose"]) if "pose" in given else np.eye(4)
    matrix = base @ pose(given["primitive_poses"][0])
    kind, sizes = given["primitives"][0]["type"], given["primitives"][0]["dimensions"]
    place = list(matrix[:3, 3])
    if kind == "sphere":
        return ["sphere", *place, sizes[0]]
    place += angles(matrix)
    if kind == "box":
        return ["box", *place, *(side / 2 for side in sizes)]
    length, radius = sizes
    if folder.startswith("box"):
        return ["box", *place, radius, radius, length / 2]
    return ["capsule", *place, radius, length]


def main(archive: str, *joints: str) -> None:
    """Writes the problems by folder and number."""
    scenes: dict[tuple[str, int], Any] = {}
    requests: dict[tuple[str, int], Any] = {}
    with tarfile.open(archive) as tar:
        for member in tar:
            if member.isfile():
                _, folder, name = member.name.split("/")
                of = scenes if "scene" in name else requests
                number = int(re.findall(r"\d+", name)[0])
                of[folder, number] = yaml.load(tar.extractfile(member), Loader=LOADER)
    for folder, number in sorted(scenes):
        print("problem", f"{folder}/{number}")
        for given in scenes[folder, number]["world"]["collision_objects"]:
            print(*solid(given, folder))
        request = requests[folder, number]
        state = request["start_state"]["joint_state"]
        start = dict(zip(state["name"], state["position"], strict=True))
        held = request["goal_constraints"][0]["joint_constraints"]
        goal = {joint["joint_name"]: joint["position"] for joint in held}
        for word, ends in (("start", start), ("goal", goal)):
            print(word, *(ends[joint] for joint in joints))


if __name__ == "__main__":
    main(*sys.argv[1:])
