"""What stands still around a robot, and where the robot's base stands, as scene files give them.

Cells are written in millimetres, scenes of polyhedra in centimetres with their support in millimetres; everything
here is in metres. The world's z points up.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import combinations, product
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from judge.located import Fault, Written

Numbers = npt.NDArray[np.float64]
MM, CM = 1e-3, 1e-2


@dataclass(frozen=True)
class Still:
    """A mesh by its corners, a sphere by its middle, a capsule by its ends, a plane by a point and its normal."""

    name: str
    shape: Literal["mesh", "sphere", "capsule", "plane"]
    points_m: Numbers
    radius_m: float = 0.0

    def moved(self, by_m: Numbers) -> "Still":
        """The same elsewhere."""
        points = self.points_m + by_m
        if self.shape == "plane":
            points[1] = self.points_m[1]
        return replace(self, points_m=points)


Scene = tuple[Numbers, tuple[Still, ...]]
"""The base's frame in the world, and what stands around it."""


def turn_about_z(angle_rad: float) -> Numbers:
    """A rotation about the vertical."""
    sine, cosine = np.sin(angle_rad), np.cos(angle_rad)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def box(middle: Numbers, sides: Numbers, turn: Numbers | None = None) -> Numbers:
    """The eight corners of a box."""
    half = np.array(list(product((-0.5, 0.5), repeat=3))) * sides
    return middle + (half if turn is None else half @ turn.T)


def support(table: dict[str, Any]) -> tuple[Numbers, list[Still], list[Still]]:
    """The base's frame, the floor and the block under the base, each if there is one."""
    base = np.eye(4)
    base[:3, :3] = turn_about_z(np.deg2rad(table["yaw_deg"]))
    base[:3, 3] = np.array(table["base_mm"], dtype=float) * MM
    height = table["base_mm"][2] if table["under"] == "floor" else table.get("floor_mm")
    if height is None:
        return base, [], []
    floor = [Still("floor", "plane", np.array([[0.0, 0.0, height * MM], [0.0, 0.0, 1.0]]))]
    if table["under"] != "pedestal":
        return base, floor, []
    sides = np.array([*table["sides_mm"], table["base_mm"][2] - height]) * MM
    middle = base[:3, 3] - np.array([0.0, 0.0, sides[2] / 2])
    return base, floor, [Still("pedestal", "mesh", box(middle, sides, base[:3, :3]))]


def read_cell(path: Path) -> Scene:
    """The cell in the file at `path`: what is under the base first, then the obstacles, kind by kind."""
    table = Written(path).table
    base, floor, block = support(table["support"])
    stills = floor + block + [cell_box(entry) for entry in table.get("box", [])]
    for entry in table.get("sphere", []):
        middle = np.array([entry["center_mm"]], dtype=float) * MM
        stills.append(Still(entry["name"], "sphere", middle, entry["radius_mm"] * MM))
    for entry in table.get("capsule", []):
        ends = np.array([entry["from_mm"], entry["to_mm"]], dtype=float) * MM
        stills.append(Still(entry["name"], "capsule", ends, entry["radius_mm"] * MM))
    for entry in table.get("convex", []):
        stills.append(Still(entry["name"], "mesh", np.array(entry["vertices_mm"], dtype=float) * MM))
    return base, tuple(stills)


def cell_box(entry: dict[str, Any]) -> Still:
    """One `[[box]]` of a cell."""
    low, high = (np.array(entry[key], dtype=float) * MM for key in ("min_mm", "max_mm"))
    turn = turn_about_z(np.deg2rad(entry.get("yaw_deg", 0.0)))
    return Still(entry["name"], "mesh", box((low + high) / 2, high - low, turn))


def read_polyhedra(path: Path) -> Scene:
    """The scene of convex solids in the file at `path`: the obstacles, the block under the base, the floor."""
    table = Written(path).table
    if "support" not in table:
        raise Fault(f"{path}: the scene has no table `[support]`, so that no arm stands in it")
    base, floor, block = support(table["support"])
    solids = [
        Still(f"obstacle {number}", "mesh", SHAPES[entry["shape"]](entry) * CM)
        for number, entry in enumerate(table.get("obstacle", []), 1)
    ]
    return base, (*solids, *block, *floor)


def middle_of(entry: dict[str, Any], key: str = "center") -> Numbers:
    """The middle of an obstacle."""
    return np.array(entry[key], dtype=float)


def cuboid(entry: dict[str, Any]) -> Numbers:
    """A box along the axes."""
    return box(middle_of(entry), np.array(entry["size"], dtype=float))


def prism(entry: dict[str, Any]) -> Numbers:
    """A prism over a regular polygon; its first corner is `turn_rad` from the axis after its own."""
    axis, half = "xyz".index(entry["axis"]), entry["height"] / 2
    angles = entry["turn_rad"] + 2 * np.pi * np.arange(entry["sides"]) / entry["sides"]
    corners = np.zeros((2, entry["sides"], 3))
    corners[:, :, axis] = [[-half], [half]]
    corners[:, :, (axis + 1) % 3] = entry["radius"] * np.cos(angles)
    corners[:, :, (axis + 2) % 3] = entry["radius"] * np.sin(angles)
    return np.asarray(middle_of(entry) + corners.reshape(-1, 3))


def octahedron(entry: dict[str, Any]) -> Numbers:
    """A regular octahedron with its corners along the axes."""
    return np.asarray(middle_of(entry) + entry["radius"] * np.vstack([np.eye(3), -np.eye(3)]))


def wedge(entry: dict[str, Any]) -> Numbers:
    """The lower half of a box, cut from its top edge at low x to its bottom edge at high x."""
    half = np.array(entry["size"], dtype=float) / 2
    profile = [(-1, -1), (1, -1), (-1, 1)]
    corners = np.array([(x, y, z) for x, z in profile for y in (-1, 1)])
    return np.asarray(middle_of(entry) + half * corners)


def pyramid(entry: dict[str, Any]) -> Numbers:
    """A pyramid over a square along the axes."""
    half = entry["side"] / 2
    corners = [(x * half, y * half, 0.0) for x in (-1, 1) for y in (-1, 1)]
    return np.asarray(middle_of(entry, "base_center") + np.array([*corners, (0.0, 0.0, entry["height"])]))


def vertices(entry: dict[str, Any]) -> Numbers:
    """The convex hull of points."""
    return np.array(entry["points"], dtype=float)


def planes(entry: dict[str, Any]) -> Numbers:
    """The corners of what lies behind every plane: where three planes meet and none is in front."""
    normals = np.array([plane["normal"] for plane in entry["planes"]], dtype=float)
    lengths = np.linalg.norm(normals, axis=1)
    offsets = np.array([plane["offset"] for plane in entry["planes"]]) / lengths
    normals /= lengths[:, None]
    corners = []
    for three in map(list, combinations(range(len(normals)), 3)):
        if abs(np.linalg.det(normals[three])) > 1e-9:
            corner = np.linalg.solve(normals[three], offsets[three])
            if (normals @ corner <= offsets + 1e-9).all():
                corners.append(corner)
    return np.array(corners)


SHAPES: dict[str, Callable[[dict[str, Any]], Numbers]] = {
    "box": cuboid,
    "prism": prism,
    "octahedron": octahedron,
    "wedge": wedge,
    "pyramid": pyramid,
    "vertices": vertices,
    "planes": planes,
}
