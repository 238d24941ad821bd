"""Paths that a study kept, and the plane in which it poses an arm: read from its Parquet files and its spec."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from alike import whole

from judge.located import Fault, Stale, Written
from judge.robots import Model, Numbers, Part, Row
from judge.scenes import CM, Still

NO_KEY = {"name", "width", "columns", "values"}
"""What traces have besides the key of the trial that they are of."""
LINK_RADIUS_M = 1e-7
"""The radius of a link that has no width, a tenth of the tolerance."""
HALF_HEIGHT_M = 0.05
"""How far what stands in the plane reaches above and below it."""


@dataclass(frozen=True)
class Stored:
    """A path by name: one configuration a row; and the number of its instance."""

    name: str
    stops_rad: Numbers
    instance: int = 0


def slug(label: str) -> str:
    """A label in lower case, with everything but letters and digits turned into dashes."""
    spelled = label.lower().replace("*", "-star").replace("+", "-plus")
    return "-".join(re.findall("[a-z0-9]+", spelled))


def read_paths(paths: dict[str, Any], runs: Path, joints: int, again: Path | None = None) -> list[Stored]:
    """The traces of solved trials that an entry of the spec names, in the order of the file; of `again` if given."""
    study = paths["study"]
    traces, trials = read((again or runs) / f"{study}.traces.parquet"), read(runs / f"{study}.trials.parquet")
    keys = [name for name in traces.column_names if name not in NO_KEY]
    status = trials.select([*keys, "status"]).to_pylist()
    group = paths["problems"]
    known = {key_of(row, keys) for row in status if (row["status"], row["group"]) == ("solved", group)}
    # A group may also hold paths of a bare point, which are narrower.
    least, described = paths["first_joint"] + joints, traces.select([*keys, "name", "width"]).to_pylist()
    found = []
    for place, row in enumerate(described):
        if row["name"] == paths["trace"] and row["width"] >= least and key_of(row, keys) in known:
            points = np.array(traces["values"][place].as_py(), dtype=float).reshape(-1, row["width"])
            if len(points) > 1:
                found.append(Stored(path_name(row, keys), angles(points, paths, joints), row["instance"]))
    if not found:
        message = (
            f"{runs / study}.traces.parquet: the stored run kept no trace `{paths['trace']}` "
            f"of a solved trial of problems `{paths['problems']}`"
        )
        raise Stale(message)
    return found


def key_of(row: dict[str, Any], keys: list[str]) -> tuple[Any, ...]:
    """The key of the trial that a row is of."""
    return tuple(row[key] for key in keys)


def read(path: Path) -> pa.Table:
    """A Parquet file of a stored run."""
    try:
        return pq.read_table(path)
    except (OSError, pa.ArrowInvalid) as error:
        raise Stale(f"{path}: {error}; `replan run` stores the run") from error


def path_name(row: dict[str, Any], keys: list[str]) -> str:
    """The trial by the parts of its key that are there, without choices."""
    parts = [row[key] for key in keys if not key.startswith("choice_")]
    return "/".join(slug(part) if isinstance(part, str) else str(part) for part in parts if part is not None)


def angles(points: Numbers, paths: dict[str, Any], joints: int) -> Numbers:
    """The joint angles of every point of a trace."""
    first = paths["first_joint"]
    values = points[:, first : first + joints]
    return np.deg2rad(values) if paths["unit"] == "deg" else values


def read_group(folder: Path, paths: dict[str, Any], family: str) -> dict[str, Any]:
    """The settings of a study's problem group of this family.

    They are those that the group itself is given: the options of choices do not change them here.
    """
    written = Written(folder / f"{paths['study']}.toml")
    shared = Written(folder / "paper.toml").table
    problems = whole(written.table, shared)["problems"]
    groups = {group["label"]: (index, group) for index, group in enumerate(problems)}
    if paths["problems"] not in groups:
        raise Fault(f"{written.path}: there is no group `{paths['problems']}`; there are {', '.join(groups)}")
    index, group = groups[paths["problems"]]
    place = ("problems", index, "family")
    if group["family"] != family:
        raise written.fault(
            place, f"problems of the family `{group['family']}` are not judged here; accepted: {family}"
        )
    settings: dict[str, Any] = group["settings"]
    return settings


def read_workspace(folder: Path, paths: dict[str, Any], name: str) -> tuple[Model, str]:
    """The planar arm of a study's problem group in the plane z = 0, and what goes straight on its hops."""
    settings = read_group(folder, paths, "arm_workspace")
    rows = tuple(Row(0.0, length * CM, 0.0, 0.0, (-np.pi, np.pi)) for length in settings["links_cm"])
    parts = tuple(
        Part(f"link {link}", link, ((-row.a_m, 0.0, 0.0), (0.0, 0.0, 0.0)), LINK_RADIUS_M)
        for link, row in enumerate(rows, 1)
    )
    model = Model(name, np.eye(4), rows, 0.0, parts, (), obstacles(settings), has_limits=False)
    return model, "tip" if settings["hop_check"] == "tip_line" else "joints"


def obstacles(settings: dict[str, Any]) -> tuple[Still, ...]:
    """What stands in a workspace: discs as balls, polygons as prisms."""
    middles, radius = settings["obstacles_cm"], settings["obstacle_diameter_cm"] / 2
    shapes = settings.get("shapes_in_turn") or settings["obstacle_shapes"]
    return tuple(
        obstacle(f"obstacle {index + 1}", shapes[index % len(shapes)], np.array(middle, dtype=float), radius)
        for index, middle in enumerate(middles)
    )


def obstacle(name: str, shape: str, middle_cm: Numbers, radius_cm: float) -> Still:
    """One obstacle; corners of polygons are on the circle of the diameter but for a square's, which are on its box."""
    if shape == "circle":
        return Still(name, "sphere", np.array([[*middle_cm, 0.0]]) * CM, radius_cm * CM)
    sides, turn_rad, reach = POLYGONS[shape]
    angles = turn_rad + 2 * np.pi * np.arange(sides) / sides
    corners = (middle_cm + reach * radius_cm * np.stack([np.cos(angles), np.sin(angles)], axis=1)) * CM
    both = [[*corner, height] for corner in corners for height in (-HALF_HEIGHT_M, HALF_HEIGHT_M)]
    return Still(name, "mesh", np.array(both))


POLYGONS = {
    "square": (4, np.pi / 4, np.sqrt(2.0)),
    "square_inscribed": (4, np.pi / 4, 1.0),
    "hexagon": (6, 0.0, 1.0),
    "hexagon_turned": (6, np.pi / 2, 1.0),
    "triangle": (3, np.pi / 2, 1.0),
    "triangle_turned": (3, -np.pi / 2, 1.0),
}
"""Corners, the first one's direction, and how far corners are from the middle, in radii."""
