"""Gaps between a robot and what it may touch, and what they are needed for: free and pierced configurations.

MuJoCo measures a robot whose capsules are thinned to their axes, so that a gap is known also where a capsule is
in contact: the distance of its axis minus its radius. Where an axis is in a solid, depths mean little.
"""

from collections.abc import Iterable
from dataclasses import replace

import mujoco
import numpy as np
import numpy.typing as npt
from scipy.spatial import ConvexHull

from judge.kinematics import frames
from judge.mjcf import mjcf
from judge.model import PART, STILL, Judged, compiled
from judge.robots import Model, Numbers, Pair
from judge.scenes import Still

THIN_M = 1e-7
FAR_M = 100.0
"""Pairs farther apart than this would be said to be this far: no robot is."""


class Gaps:
    """A robot among obstacles that can be measured."""

    def __init__(self, model: Model) -> None:
        """Compile the model with thin capsules."""
        self.model, self.pairs = model, model.pairs()
        thin = replace(model, parts=tuple(replace(part, radius_m=THIN_M) for part in model.parts))
        self.judged: Judged = compiled(mujoco.MjModel.from_xml_string(mjcf(thin, {})))
        self.whole: Judged = compiled(mujoco.MjModel.from_xml_string(mjcf(model, {})))
        self.geoms = [self.pair_geoms(pair) for pair in self.pairs]
        self.widths = [self.pair_width(pair) for pair in self.pairs]
        self.stills = np.array([-1 if pair.still is None else pair.still for pair in self.pairs])
        self.ends = np.zeros(6)

    def pair_geoms(self, pair: Pair) -> tuple[int, int]:
        """The geoms of a pair."""
        parts = [PART + self.model.parts[part].name for part in (pair.part, pair.other) if part is not None]
        stills = [] if pair.still is None else [STILL + self.model.stills[pair.still].name]
        one, other = (self.judged.model.geom(name).id for name in parts + stills)
        return one, other

    def pair_width(self, pair: Pair) -> float:
        """What the pair's parts are wider than the thinned ones, together."""
        parts = [self.model.parts[part] for part in (pair.part, pair.other) if part is not None]
        return sum(part.radius_m - THIN_M for part in parts)

    def of(self, q_rad: Numbers, pairs: Iterable[int], shift: tuple[int, Numbers] | None = None) -> Numbers:
        """The gaps of some pairs, metres; with `shift`, where one still thing is elsewhere by so much."""
        model, data = self.judged.model, self.judged.data
        data.qpos[:] = q_rad
        mujoco.mj_kinematics(model, data)
        if shift is not None:
            still, by_m = shift
            data.geom_xpos[model.geom(STILL + self.model.stills[still].name).id] += by_m
        measured = [
            mujoco.mj_geomDistance(model, data, *self.geoms[pair], FAR_M, self.ends) - self.widths[pair]
            for pair in pairs
        ]
        return np.array(measured)

    def many(self, rows_rad: Numbers) -> Numbers:
        """The gaps of all pairs for each configuration."""
        every = range(len(self.pairs))
        return np.array([self.of(q_rad, every) for q_rad in rows_rad]).reshape(len(rows_rad), len(self.pairs))

    def is_free(self, q_rad: Numbers) -> bool:
        """Whether MuJoCo finds no contact."""
        model, data = self.whole.model, self.whole.data
        data.qpos[:] = q_rad
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        return not (np.asarray(data.contact.dist) <= 0.0).any()

    def group(self, still: int) -> npt.NDArray[np.int64]:
        """The pairs of one still thing; of the robot with itself for -1."""
        return np.flatnonzero(self.stills == still)

    def groups(self) -> list[int]:
        """What can be touched: still things, and -1 for the robot itself."""
        return sorted(set(self.stills.tolist()), key=lambda still: (still < 0, still))

    def pierced(self, rows_rad: Numbers) -> npt.NDArray[np.bool_]:
        """Whether the axis of a capsule goes through an obstacle that both its ends are outside of, for each."""
        placed = frames(self.model, rows_rad)
        found = np.zeros(len(rows_rad), dtype=np.bool_)
        for index, pair in enumerate(self.pairs):
            if pair.still is None or self.model.stills[pair.still].shape == "plane":
                continue
            part, still = self.model.parts[pair.part], self.model.stills[pair.still]
            ends = np.array([[*end, 1.0] for end in part.ends_m]) @ placed[:, part.link].transpose(0, 2, 1)
            both = outside(still, ends[:, :, :3].reshape(-1, 3)).reshape(-1, 2).all(axis=1)
            inner = -self.widths[index]
            for row in np.flatnonzero(both & ~found):
                found[row] = self.of(rows_rad[row], [index])[0] <= inner
        return found


def outside(still: Still, points: Numbers) -> npt.NDArray[np.bool_]:
    """Which points are outside a solid."""
    if still.shape == "mesh":
        planes = ConvexHull(still.points_m).equations
        return np.asarray((points @ planes[:, :3].T + planes[:, 3] > 0).any(axis=1))
    start, end = still.points_m[0], still.points_m[-1]
    way = end - start
    along = np.clip((points - start) @ way / max(way @ way, 1e-300), 0.0, 1.0)
    apart = points - start - along[:, None] * way
    return np.asarray(np.linalg.norm(apart, axis=1) > still.radius_m)
