"""The configurations that are asked about: drawn at random, and sought where two codes are likely to differ.

A block of questions is a table with one row a configuration: why it is asked about (`kind`), the path it is on
(`path`, by its place), the joint angles (`q1`, `q2`, ...), and whether `frames`, `gaps` and `limits` are asked
for besides contact.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa

from judge.gaps import Gaps
from judge.kinematics import determinant
from judge.robots import Model, Numbers

RANDOM, NEAR, SINGULAR, PIERCING = "random", "within 1 mm of contact", "singular", "axis pierces an obstacle"
LIMIT, PATH, PUSHED = "joint limits", "paths", "pushed path"
KINDS = (RANDOM, NEAR, SINGULAR, PIERCING, LIMIT, PATH, PUSHED)

NEAR_M = 1e-3
"""How near to contact the adversarial configurations are."""
NEAREST_M = 2e-6
"""The nearest of them; nearer ones would be within the tolerance."""
DRAWS = 40
"""Draws per wanted configuration after which a search ends."""
HALVINGS = 60
DETERMINED = (2, 6)
"""Numbers of joints whose Jacobian has a determinant: those of a place in the plane, and of a pose."""
BEYOND_RAD = (1e-9, 0.1)
"""How far beyond a limit the limit questions go, and how near to it."""

Flags = npt.NDArray[np.bool_] | bool
Rows = npt.NDArray[np.int64]
Stream = np.random.Generator


def block(
    kind: str,
    q_rad: Numbers,
    *,
    path: int = 0,
    frames: Flags = False,
    gaps: Flags = False,
    limits: Flags = False,
) -> pa.Table:
    """Questions of one kind; flags are for all of them or one for each."""
    rows = len(q_rad)
    columns: dict[str, Any] = {
        "kind": pa.array([kind] * rows, pa.string()),
        "path": np.full(rows, path, dtype=np.int64),
    }
    columns |= {f"q{joint + 1}": np.ascontiguousarray(q_rad[:, joint]) for joint in range(q_rad.shape[1])}
    flags = {"frames": frames, "gaps": gaps, "limits": limits}
    return pa.table(columns | {name: np.full(rows, flag) for name, flag in flags.items()})


def drawn(model: Model, stream: Stream, rows: int) -> Numbers:
    """Configurations within the limits."""
    low, high = np.array([row.limits_rad for row in model.rows]).T
    return stream.uniform(low, high, (rows, len(model.rows)))


def questions(measured: Gaps, sizes: dict[str, int], seed: np.random.SeedSequence) -> list[pa.Table]:
    """Every configuration that is not on a path."""
    model, streams = measured.model, [np.random.default_rng(child) for child in seed.spawn(5)]
    rows, joints = np.arange(sizes["random"]), len(model.rows)
    found = [
        block(
            RANDOM,
            drawn(model, streams[0], len(rows)),
            frames=rows < sizes["random_frames"],
            gaps=rows < sizes["random_distances"],
        )
    ]
    sought = {NEAR: near_contact(measured, sizes["near_contact"], streams[1])}
    sought[SINGULAR] = singular(model, sizes["singular"], streams[2])
    for kind, configurations in sought.items():
        found.append(block(kind, configurations.reshape(-1, joints), frames=True, gaps=True))
    found.append(block(PIERCING, piercing(measured, sizes["piercing"], streams[3]).reshape(-1, joints)))
    if sizes["random"] > 0 and model.has_limits:
        found.append(block(LIMIT, at_limits(model, streams[4]), limits=True))
    return found


def near_contact(measured: Gaps, count: int, stream: Stream) -> Numbers:
    """For each thing that can be touched in turn, a configuration whose gap to it is a drawn one.

    Half of them are in contact; those for which none is found are left out.
    """
    draws = drawn(measured.model, stream, max(count, 1) * 4)
    gaps, groups, found = measured.many(draws), measured.groups(), []
    if not groups:
        return np.empty((0, draws.shape[1]))
    for index in range(count):
        own = measured.group(groups[index % len(groups)])
        size_m = NEAREST_M * (NEAR_M / NEAREST_M) ** stream.random()
        target_m = size_m if stream.random() < 0.5 else -size_m
        inside = gaps[:, own].min(axis=1) < target_m
        if inside.all() or not inside.any():
            continue
        ends = [draws[stream.choice(np.flatnonzero(side))] for side in (~inside, inside)]
        beyond = partial(gap_beyond, measured, own, target_m)
        q_rad = crossing(ends[0], ends[1], beyond)
        if abs(beyond(q_rad)) < NEAREST_M / 4:
            found.append(q_rad)
    return np.array(found)


def gap_beyond(measured: Gaps, pairs: Rows, target_m: float, q_rad: Numbers) -> float:
    """How far the least gap of some pairs is above a drawn one."""
    return float(measured.of(q_rad, pairs).min()) - target_m


def crossing(start: Numbers, end: Numbers, value: Callable[[Numbers], float]) -> Numbers:
    """Where a value, not negative at the start and negative at the end, changes sign on the line between."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if value(start + (end - start) * middle) >= 0.0:
            low = middle
        else:
            high = middle
    return start + (end - start) * low


def singular(model: Model, count: int, stream: Stream) -> Numbers:
    """Where the Jacobian's determinant changes sign on a straight joint line; nowhere if it has none."""
    if len(model.rows) not in DETERMINED:
        return np.empty((0, len(model.rows)))
    start, end = (drawn(model, stream, count * DRAWS) for _ in range(2))
    sign = np.sign(determinant(model, start))
    changes = np.flatnonzero(sign * determinant(model, end) < 0)[:count]
    start, end, sign = start[changes], end[changes], sign[changes]
    low, high = np.zeros(len(changes)), np.ones(len(changes))
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = sign * determinant(model, start + (end - start) * middle[:, None]) >= 0
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return start + (end - start) * low[:, None]


def piercing(measured: Gaps, count: int, stream: Stream) -> Numbers:
    """Configurations in which the axis of a capsule goes through an obstacle."""
    found = np.empty((0, len(measured.model.rows)))
    for _ in range(DRAWS):
        draws = drawn(measured.model, stream, count)
        found = np.vstack([found, draws[measured.pierced(draws)]])
        if len(found) >= count:
            break
    return found[:count]


def at_limits(model: Model, stream: Stream) -> Numbers:
    """Each joint just inside, just outside and well outside each of its limits, the others drawn."""
    near, far = BEYOND_RAD
    rows = drawn(model, stream, 6 * len(model.rows))
    for joint, row in enumerate(model.rows):
        low, high = row.limits_rad
        angles = [low + near, low - near, low - far, high - near, high + near, high + far]
        rows[6 * joint : 6 * joint + 6, joint] = angles
    return rows
