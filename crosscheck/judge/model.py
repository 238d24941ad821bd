"""A compiled model, and what in it may touch."""

from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

PART, STILL = "part:", "still:"


@dataclass(frozen=True)
class Geoms:
    """Two geoms that may touch."""

    name: str
    geoms: tuple[int, int]


@dataclass(frozen=True)
class Judged:
    """A compiled model with the names by which it is asked about."""

    model: mujoco.MjModel
    data: mujoco.MjData
    pairs: tuple[Geoms, ...]
    frames: tuple[str, ...]
    joints: tuple[str, ...]


def load(path: Path) -> Judged:
    """Compile the model at `path`."""
    return compiled(mujoco.MjModel.from_xml_path(str(path)))


def compiled(model: mujoco.MjModel) -> Judged:
    """A compiled model with its names."""
    joints = tuple(model.joint(index).name for index in range(model.njnt))
    bodies = (model.body(index).name for index in range(model.nbody))
    frames = tuple(name for name in bodies if name == "tool" or is_moving_link(name))
    return Judged(model, mujoco.MjData(model), pairs(model), frames, joints)


def is_moving_link(name: str) -> bool:
    """Whether a body is the frame of a link that moves: `link_0` is the base."""
    return name.startswith("link_") and name != "link_0"


def pairs(model: mujoco.MjModel) -> tuple[Geoms, ...]:
    """Every pair that MuJoCo tests: by masks between bodies that are not welded, and explicit ones."""
    found = [masked for one in range(model.ngeom) for masked in partners(model, one)]
    found += [(int(model.pair_geom1[index]), int(model.pair_geom2[index])) for index in range(model.npair)]
    return tuple(Geoms(pair_name(model, geoms), geoms) for geoms in found)


def partners(model: mujoco.MjModel, one: int) -> list[tuple[int, int]]:
    """The geoms that the masks let touch geom `one`, as pairs with `one` first."""
    weld = model.body_weldid
    others = np.flatnonzero(model.geom_conaffinity & model.geom_contype[one])
    apart = [other for other in others if weld[model.geom_bodyid[other]] != weld[model.geom_bodyid[one]]]
    return [(one, int(other)) for other in apart]


def pair_name(model: mujoco.MjModel, geoms: tuple[int, int]) -> str:
    """The pair's name: a part before a still thing, parts in alphabetical order, without prefixes."""
    names = sorted(model.geom(geom).name for geom in geoms)
    return "|".join(name.removeprefix(PART).removeprefix(STILL) for name in names)
